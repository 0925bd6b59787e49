"""What the page asks of Python, in the reader's browser: proofs again, and the model for a case.

The worker imports this file and calls `answer` with texts of JSON. Nothing is computed here: all
numbers come from the project's packages, which are the same files as anywhere.
"""

import json
from collections.abc import Iterator, Mapping
from decimal import ROUND_CEILING
from fractions import Fraction
from math import ulp
from typing import Any

from reference.ledger import load
from replication import error
from replication.audit.audit import Audit
from replication.audit.findings import finding
from replication.cases import BETA_5, INPUTS, changed, modelled
from replication.cli.case import EXPECTED, doubt, range_in_words
from replication.models import motion
from replication.models.depth import final_depth
from replication.models.impact import Impact, InputError
from replication.models.sheet import Row, Sheet, run
from replication.report.document import claim_document, equation_document
from replication.solve import solve_printed
from replication.text import between, json_text, number, quantity, rounded
from replication.user_input import place, read_number

Table = dict[str, Any]

MOST_ROWS = 4000
"""A sheet with more rows is not run here: on a slow machine it would take half a second."""

MOST_POINTS = 60
"""Marks of the sheet in the figure: with more of them they would hide the curve."""

LAST_DIGITS = 8
"""Units in the last place by which doubles may differ as two C libraries round otherwise.

Logarithms and powers of two libraries are one or two apart, and a number comes of a few of them.
"""

CURVE = 100
"""Parts of the exact curve; at the figure's width each is some five pixels long."""

LABELS = {
    "velocity": "Impact velocity",
    "radius": "Particle radius",
    "particle_density": "Particle density",
    "target_density": "Target density",
    "beta": "β",
    "flow_stress": "Flow stress",
    "step": "Step of the sheet",
    "measured_depth": "Measured depth",
}
"""What a message calls an input: as the label of its field on the page does."""

audit = Audit(load())


def answer(question: str) -> str:
    """Answer one question, both JSON: {"ask": "proof", "kind", "id", "stored"} or {"ask": "model"}.

    A case that cannot be computed is an answer, {"refused": why}.
    """
    asked = json.loads(question)
    if asked["ask"] == "proof":
        return json_text(proof(asked["kind"], asked["id"], asked["stored"]))
    try:
        return json_text(model(asked["inputs"]))
    except ValueError as wrong:
        return json_text({"refused": str(wrong)})


# Proofs again


def proof(kind: str, name: str, stored: Table) -> Table:
    """Prove a claim, an equation or a finding anew, and compare it with its stored document.

    `range` is the proven range, rounded outward, with its unit; null where nothing was proven by
    one, as for words of the report.
    """
    here = json.loads(json_text(_document(kind, name)))
    enclosure, unit = here.get("enclosure"), here.get("unit", "1")
    return {
        "verdict": here.get("verdict", "its numbers hold" if here.get("holds") else "fails"),
        "computed": here.get("computed"), "unit": unit, "printed": here.get("printed"),
        "range": enclosure and quantity(between(enclosure, 5), unit),
        "differs": list(_differences("", stored, here)),
    }  # fmt: skip


def _document(kind: str, name: str) -> Any:
    if kind == "claim":
        return claim_document(audit.claim(name))
    if kind == "equation":
        return equation_document(audit.equation(name))
    return finding(audit, name)


def _differences(where: str, stored: Any, here: Any) -> Iterator[Table]:
    """Yield each place where two documents differ, with both values.

    `last_digits` says that they are doubles at most `LAST_DIGITS` apart.
    """
    if isinstance(stored, dict) and isinstance(here, dict):
        for key in dict.fromkeys((*stored, *here)):
            both = stored.get(key, "absent"), here.get(key, "absent")
            yield from _differences(f"{where} {key}".strip(), *both)
    elif isinstance(stored, list) and isinstance(here, list) and len(stored) == len(here):
        for k, (before, now) in enumerate(zip(stored, here, strict=True)):
            name = now.get("name", k + 1) if isinstance(now, dict) else k + 1
            yield from _differences(f"{where} {name}", before, now)
    elif stored != here or isinstance(stored, bool) != isinstance(here, bool):
        close = isinstance(here, float) and isinstance(stored, int | float)
        close = close and abs(stored - here) <= LAST_DIGITS * ulp(here)
        values = {"stored": json.dumps(stored), "here": json.dumps(here)}
        yield {"where": where, **values, "last_digits": close}


# The model, live


def model(given: Mapping[str, str]) -> Table:
    """Compute one impact by the exact motion, the sheet and the other models of the report.

    `given` are texts with units, such as "11 um": inputs of a case, and the depth that was
    measured. Lengths in m, times in s. Raises ValueError for a text or a case that is not usable.
    """
    inputs = {name: text for name, text in given.items() if name != "measured_depth"}
    impact = _impact({name: _number(name, text) for name, text in inputs.items()})
    stop = motion.stop_time(**impact.motion)
    times = [stop * k / CURVE for k in range(CURVE + 1)]
    depths, speeds = [0.0] * len(times), [0.0] * len(times)
    motion.history(times, **impact.motion, depth=depths, speed=speeds)
    depth = final_depth(**impact.motion)
    sheet = _sheet(impact, stop)
    inverse = _resistance(impact, given["measured_depth"])
    return {
        "resistance": impact.target_resistance,
        "depth": depth, "normalized_depth": depth / impact.radius, "stop_time": stop,
        "curve": list(zip(times, depths, strict=True)),
        "sheet": _rows_and_points(sheet) if isinstance(sheet, Sheet) else {"refused": sheet},
        "approaches": _approaches(impact, depth, inverse.get("depth")),
        "inverse": inverse,
        **_doubts(impact, sheet, inverse.get("resistance")),
    }  # fmt: skip


def _number(name: str, text: str) -> float:
    """Read an input, which must be above zero; a message names it as the page does."""
    with place(LABELS[name]):
        value = read_number(text, {**INPUTS, "measured_depth": "m"}[name])
    if value <= 0:
        raise ValueError(f"{LABELS[name]} is {text}: it must be greater than zero")
    return value


def _impact(values: Mapping[str, float]) -> Impact:
    try:
        return changed(BETA_5, values)
    except InputError as wrong:
        raise ValueError(f"{LABELS.get(wrong.name, wrong.name)} {wrong.problem}") from wrong


def _sheet(impact: Impact, stop: float) -> Sheet | str:
    """Run the sheet, or say why it was not run."""
    if stop > MOST_ROWS * impact.step:
        least = rounded(Fraction(stop) / MOST_ROWS * 10**9, 3, ROUND_CEILING)
        return f"more than {MOST_ROWS} rows: take a step of at least {float(least):g} ns"
    try:
        return run(impact)
    except InputError as wrong:
        return str(wrong)


def _rows_and_points(sheet: Sheet) -> Table:
    """Return the sheet's first rows, its end, and points for the figure.

    A row's depth belongs to the middle of its step, half a step before the row's time: the point is
    there, so that its distance from the exact curve is the error of the sheet.
    """
    every, half = -(-len(sheet.rows) // MOST_POINTS), sheet.impact.step / 2
    marked = list(sheet.rows[::every])
    if sheet.steps % every:
        marked.append(sheet.rows[-1])
    first, last = sheet.rows[:6], sheet.rows[max(6, len(sheet.rows) - 2) :]
    return {
        "steps": sheet.steps, "depth": sheet.final_depth, "every": every,
        "normalized_depth": sheet.normalized_depth,
        "points": [(max(0.0, row.time - half), row.depth) for row in marked],
        "first": _numbered(first, 0), "last": _numbered(last, len(sheet.rows) - len(last)),
    }  # fmt: skip


def _numbered(rows: tuple[Row, ...], start: int) -> list[list[float | None]]:
    return [[start + k, *row] for k, row in enumerate(rows)]


def _doubts(impact: Impact, sheet: Sheet | str, sought: float | None) -> Table:
    """Return the warnings and notes that the command line gives for this case.

    `sought` is the resistance for the measured depth [Pa], if there is one.
    """
    warnings, notes = [], []
    for name in EXPECTED:
        if (value := getattr(impact, name)) is not None:
            warnings += doubt(name, value, LABELS[name])
    if isinstance(sheet, Sheet):
        for kind, words in error.warnings(sheet).items():
            (notes if kind in error.NOTES else warnings).append(f"the sheet: {words}")
    if sought is not None:
        named = "the resistance for the measured depth"
        warnings += doubt("resistance", sought, named, typed=False)
    return {"warnings": warnings, "notes": notes}


def _approaches(impact: Impact, depth: float, measured: float | None) -> Table:
    """Return X/R by each model, as measured and as observed, and how each is named.

    `longest` is the X/R of the longest bar that is drawn: what was measured may be anything.
    """
    armor, stainless, here = (
        {"resistance": resistance}
        for resistance in (
            float(load().value("fz-resistance-rha")),
            float(load().value("fz-resistance-stainless")),
            impact.target_resistance,
        )
    )
    ratios = {
        "rigid sphere, exact": depth / impact.radius,
        "constant pressure": modelled("constant-pressure", impact).model.normalized_depth,
    }
    targets = (
        (f"armor, Rₜ = {armor['resistance'] / 1e9:g} GPa", armor),
        (f"stainless steel, Rₜ = {stainless['resistance'] / 1e9:g} GPa", stainless),
        ("this target’s Rₜ", here),
    )
    for target, own in targets:
        model = modelled("frank-zook", impact, own).model
        ratios[f"Frank and Zook: {target}"] = model.normalized_depth
    for target, own in targets[:2]:
        model = modelled("frank-zook-printed", impact, own).model
        ratios[f"Frank and Zook as Eq. 16 prints it: {target}"] = model.normalized_depth
    longest = max(1.0, *ratios.values())
    if measured is not None:
        ratios["your measured depth"] = measured / impact.radius
    # Equally many digits in all rows, but for what the report prints.
    rows = [{"name": name, "normalized_depth": ratio, "text": f"{ratio:#.4g}"}
            for name, ratio in ratios.items()]  # fmt: skip
    observed = load().claims["observed-ratio"].printed
    assert observed is not None
    report = "the report’s experiment (section 2), whatever the inputs here"
    rows.append({"name": report, "normalized_depth": float(observed.value), "text": observed.text})
    return {"rows": rows, "longest": longest}


def _resistance(impact: Impact, text: str) -> Table:
    """Return the resistance that gives a measured depth, and the proven range for its digits."""
    try:
        depth = _number("measured_depth", text)
        answer = solve_printed(impact, "resistance", {"depth": text})
    except InputError:
        times = number(depth / impact.radius, 3)
        return {"refused": f"Measured depth is {times} times the radius, too far to compute with"}
    except ValueError as wrong:
        return {"refused": str(wrong)}
    return {
        "resistance": answer.value, "depth": answer.depth,
        "range": answer.interval and range_in_words("resistance", answer.interval),
        "fewest_digits": answer.fewest_digits
        and range_in_words("resistance", answer.fewest_digits),
    }  # fmt: skip
