"""Approaches, sensitivity, scatter, figures, numerics, provenance in Markdown, from the record."""

from collections.abc import Iterator, Sequence
from typing import Any

from replication.reports.comparison import shown_range
from replication.reports.glossary import CAPTIONS
from replication.reports.numerics import WHY
from replication.reports.shown import share
from replication.text import number, pipe_table

__all__ = ["hard_cases", "physics", "provenance"]


def physics(record: dict[str, Any]) -> list[str]:
    """The sections on normalized depth and on the sheet's error, with their figures."""
    return [
        "## All approaches side by side",
        _figure("comparison", "Normalized depth by every approach"),
        _approaches(record["approaches"]),
        "CTH and Autodyne are quoted: the report gives neither their input nor their output.",
        "## What the depth depends on",
        _figure("sensitivity", "What each input does to the exact depth, beta = 5"),
        CAPTIONS["sensitivity"],
        "Of the exact solution: percent of depth for one percent of the input, analytic, and the "
        "depth over what the report or its evidence states for that input.",
        *(_sensitivity(case, one) for case, one in record["sensitivity"].items()),
        "## What scatter does",
        *_scatter(record["scatter"]),
        "## The sheet and the exact motion",
        _figure("figure-3", "Penetration depth against time"),
        _figure("figure-5", "Normalized depth against impact velocity"),
        _figure("convergence", "Error against time step, published and centered scheme"),
        CAPTIONS["convergence"],
        "## Where the error of the sheet comes from",
        "Final depth of the sheet minus the exact depth at rest, and its parts [µm]; the parts are "
        "computed each on its own and add up.",
        _budgets(record["error_budget"]),
        WHY["published"] + " The stop rule and the half step by which x trails v nearly cancel. "
        "`coldspray converge` runs the ladder of steps, `--scheme centered` the other variant.",
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
        tied, independent = (share(stream["share_below_observed"]) for stream in streams)
        yield (
            f"X/R as observed needs an impact at {number(streams[0]['velocity_for_observed'], 4)} "
            f"m/s. By Eq. 1 {tied} of the particles are that slow, with independent velocities "
            f"{independent}."
        )
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


_PARTS = ("total", "time_step", "stop_rule", "half_step", "rounding")


def _budgets(budgets: list[dict[str, Any]]) -> str:
    heads = ("beta", "step [ns]", "steps", *(part.replace("_", " ") for part in _PARTS))
    rows = (
        (
            number(b["beta"]),
            number(b["step"] * 1e9),
            str(b["steps"]),
            *(number(b[part] * 1e6, 4) for part in _PARTS),
        )
        for b in budgets
    )
    return pipe_table(heads, rows)


def hard_cases(stability: dict[str, Any]) -> list[str]:
    """How the computation itself was tested: closed, as it is not about the report."""
    heads = ("case", "steps", "sheet off by", "closed form [m]", "ulp", "reference [m]", "remarks")
    worst = stability["random"]
    inputs = ", ".join(f"{name} {value!r}" for name, value in worst["inputs"].items())
    return [
        "## How the computation was tested",
        f"This is not about the report. Over {worst['cases']} random cases (seed 1) the closed "
        f"form is at worst {worst['ulps']:.2f} ulp off, at {inputs}.",
        "<details>\n<summary>Hard cases: the sheet, the closed form (error in units of its last "
        "place) and the reference</summary>",
        pipe_table(heads, (_hard_case(case) for case in stability["cases"])),
        "</details>",
    ]


def _hard_case(case: dict[str, Any]) -> tuple[str, ...]:
    off = "" if case["sheet_error"] is None else f"{100 * case['sheet_error']:+.3g} %"
    depth = "" if case["closed_form"] is None else repr(case["closed_form"])
    ulps = "" if case["ulps"] is None else f"{case['ulps']:+.2f}"
    remarks = [r for r in (case["refused"], case["sheet_refused"], *case["warnings"]) if r]
    steps = "" if case["steps"] is None else str(case["steps"])
    return case["name"], steps, off, depth, ulps, case["reference"], "; ".join(remarks)
