"""What the page asks of Python, in the reader's browser: proofs again, and the model for a case.

The worker imports this file and calls `answer` with texts of JSON. Nothing is computed here: all
numbers come from the project's packages, which are the same files as anywhere.
"""

import json
from collections.abc import Iterator, Mapping
from math import ulp
from typing import Any

from reference.ledger import load
from replication.audit.audit import Audit
from replication.audit.findings import finding
from replication.cases import BETA_5, INPUTS, changed, modelled
from replication.models import motion
from replication.models.depth import final_depth
from replication.models.impact import Impact, InputError
from replication.models.sheet import Row, run
from replication.report.document import claim_document, equation_document
from replication.solve import solve_printed
from replication.text import json_text
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
    except ValueError as error:
        return json_text({"refused": str(error)})


# Proofs again


def proof(kind: str, name: str, stored: Table) -> Table:
    """Prove a claim, an equation or a finding anew, and compare it with its stored document.

    `enclosure` is null where nothing was proven by one, as for words of the report.
    """
    here = json.loads(json_text(_document(kind, name)))
    return {
        "verdict": here.get("verdict", "its numbers hold" if here.get("holds") else "fails"),
        "computed": here.get("computed"), "enclosure": here.get("enclosure"),
        "unit": here.get("unit", ""), "differs": list(_differences("", stored, here)),
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
    impact = changed(BETA_5, {name: _number(name, text) for name, text in inputs.items()})
    stop = motion.stop_time(**impact.motion)
    times = [stop * k / CURVE for k in range(CURVE + 1)]
    depths, speeds = [0.0] * len(times), [0.0] * len(times)
    motion.history(times, **impact.motion, depth=depths, speed=speeds)
    depth = final_depth(**impact.motion)
    return {
        "resistance": impact.target_resistance,
        "depth": depth, "normalized_depth": depth / impact.radius, "stop_time": stop,
        "curve": list(zip(times, depths, strict=True)),
        "sheet": _sheet(impact, stop),
        "approaches": _approaches(impact, depth),
        "inverse": _resistance(impact, given["measured_depth"]),
    }  # fmt: skip


def _number(name: str, text: str) -> float:
    with place(name.replace("_", " ")):
        return read_number(text, INPUTS[name])


def _sheet(impact: Impact, stop: float) -> Table:
    """Return the sheet's first rows, its end, and points for the figure; or why it was not run."""
    if stop > MOST_ROWS * impact.step:
        least = f"{stop / MOST_ROWS * 1e9:.3g} ns"
        return {"refused": f"more than {MOST_ROWS} rows: take a step of at least {least}"}
    try:
        sheet = run(impact)
    except InputError as error:
        return {"refused": str(error)}
    every = -(-len(sheet.rows) // MOST_POINTS)
    shown = sheet.rows[::every]
    points = [(row.time, row.depth) for row in (*shown, sheet.rows[-1])]
    first, last = sheet.rows[:6], sheet.rows[max(6, len(sheet.rows) - 2) :]
    return {
        "steps": sheet.steps, "depth": sheet.final_depth, "every": every,
        "normalized_depth": sheet.normalized_depth, "points": points,
        "first": _numbered(first, 0), "last": _numbered(last, len(sheet.rows) - len(last)),
    }  # fmt: skip


def _numbered(rows: tuple[Row, ...], start: int) -> list[list[float | None]]:
    return [[start + k, *row] for k, row in enumerate(rows)]


def _approaches(impact: Impact, depth: float) -> list[Table]:
    """Return X/R by each model and as observed, and how each is named."""
    resistance = {"resistance": impact.target_resistance}
    frank_zook = modelled("frank-zook", impact).model
    with_own = modelled("frank-zook", impact, resistance).model
    as_printed = modelled("frank-zook-printed", impact).model
    constant = modelled("constant-pressure", impact).model
    observed = float(load().value("observed-ratio"))
    own = f"Rₜ = {frank_zook.resistance / 1e9:g} GPa, as in the report"
    named = (
        ("rigid sphere, exact", depth / impact.radius),
        ("constant pressure", constant.normalized_depth),
        (f"Frank and Zook, {own}", frank_zook.normalized_depth),
        (f"Frank and Zook as Eq. 16 prints it, {own}", as_printed.normalized_depth),
        ("Frank and Zook, with this target’s Rₜ", with_own.normalized_depth),
        ("observed, section 2", observed),
    )
    return [{"name": name, "normalized_depth": value} for name, value in named]


def _resistance(impact: Impact, text: str) -> Table:
    """Return the resistance that gives a measured depth, and the proven range for its digits."""
    try:
        answer = solve_printed(impact, "resistance", {"depth": text})
    except ValueError as error:
        return {"refused": str(error)}
    return {"resistance": answer.value, "interval": answer.interval, "depth": answer.depth}
