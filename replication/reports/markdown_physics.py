"""Approaches, sensitivity, scatter, figures and provenance in Markdown, from the audit's record."""

from collections.abc import Iterator, Sequence
from typing import Any

from replication.reports.comparison import shown_range
from replication.text import number, pipe_table

__all__ = ["physics", "provenance"]


def physics(record: dict[str, Any]) -> list[str]:
    """The sections on normalized depth, each with its figure, and the figures of the motion."""
    return [
        "## All approaches side by side",
        _figure("comparison", "Normalized depth by every approach"),
        _approaches(record["approaches"]),
        "CTH and Autodyne are quoted: the report gives neither their input nor their output.",
        "## What the depth depends on",
        _figure("sensitivity", "What each input does to the exact depth, beta = 5"),
        "Of the exact solution: percent of depth for one percent of the input, analytic, and the "
        "depth over what the report or its evidence states for that input.",
        *(_sensitivity(case, one) for case, one in record["sensitivity"].items()),
        "## What scatter does",
        *_scatter(record["scatter"]),
        "## The sheet and the exact motion",
        _figure("figure-3", "Penetration depth against time"),
        _figure("figure-5", "Normalized depth against impact velocity"),
        _figure("convergence", "Error against time step, published and centered scheme"),
    ]


def provenance(made: dict[str, Any]) -> list[str]:
    """What the audit was made with, and the hashes of what it was made from and goes with it."""
    versions = ", ".join(f"{name} {version}" for name, version in made["versions"].items())
    hashes = pipe_table(("file", "SHA-256"), ((k, f"`{v}`") for k, v in made["sha256"].items()))
    return [
        "## Provenance",
        f"Made by `{made['command']}` under Python {made['python']} with {versions}.",
        hashes,
    ]


def _figure(name: str, words: str) -> str:
    return f"![{words}](figures/{name}.svg)"


def _approaches(approaches: list[dict[str, Any]]) -> str:
    rows = (
        (
            f"{one['kind']}: {one['name']}",
            number(one["computed"], 5) if one["recomputable"] else "not recomputable",
            one["printed"] and f"{one['printed']} (`{one['claim']}`)",
        )
        for one in approaches
    )
    return pipe_table(("X/R by", "computed", "printed"), rows)


def _sensitivity(case: str, one: dict[str, Any]) -> str:
    rows = (
        (
            effect["input"].replace("_", " "),
            f"{one['elasticities'][effect['input']]:+.3f}",
            shown_range(effect),
            _to([depth * 1e6 for depth in effect["depths"]], 3),
            _to(effect["ratios"], 4),
            effect["why"],
        )
        for effect in one["stated"]
    )
    heads = (case, "d ln X / d ln input", "stated range", "X [µm]", "X/R", "the range is")
    return pipe_table(heads, rows)


def _scatter(scatter: dict[str, Any]) -> Iterator[str]:
    of = scatter["standard_deviations"]
    yield (
        f"The diameter has a standard deviation of {number(of['diameter'] * 1e6, 3)} µm. The "
        f"velocity’s mean deviation is taken as the mean absolute one of a normal distribution: a "
        f"standard deviation of {number(of['velocity'], 3)} m/s (were 50 m/s the standard "
        f"deviation itself, the velocity’s part would be a fifth smaller). The deviation below is "
        f"half of what the middle 68 % span."
    )
    heads = ("quantity", "median", "90 % lie in", "deviation", "by linear propagation")
    for case, streams in scatter["streams"].items():
        for stream in streams:
            rows = (_spread(stream, *what) for what in _QUANTITIES)
            yield f"{case}, {stream['way']}:\n\n" + pipe_table(heads, rows)
    higher = 100 * (scatter["mean_mass_ratio"] ** 0.5 - 1)
    yield (
        "By Eq. 1, with the average size as that of average mass (with the mean of the masses all "
        f"velocities are {higher:.0f} % higher), beta = 5: "
        + "; ".join(
            f"{number(one['diameter'] * 1e6, 3)} µm at an average of "
            f"{number(one['average_velocity'], 4)} m/s goes {number(one['velocity'], 4)} m/s, "
            f"X/R {number(one['ratio'], 3)}"
            for one in scatter["particles"]
        )
        + "."
    )


_QUANTITIES = (
    ("velocity", "V [m/s]", 1.0, 0),
    ("depth", "X [µm]", 1e6, 2),
    ("ratio", "X/R", 1.0, 3),
)


def _spread(
    stream: dict[str, Any], what: str, head: str, scale: float, decimals: int
) -> tuple[str, ...]:
    spread = stream[what]
    low, _, median, _, high = (quantile * scale for quantile in spread["quantiles"])
    return (
        head,
        f"{median:.{decimals}f}",
        _to((low, high), decimals),
        f"{100 * spread['deviation'] * scale / median:.0f} %",
        f"{100 * spread['first_order']:.0f} %",
    )


def _to(ends: Sequence[float], decimals: int) -> str:
    low, high = ends
    return f"{low:.{decimals}f} to {high:.{decimals}f}"
