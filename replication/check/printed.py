"""The report's numbers: its inputs, and those of its numbers that a workbook holds."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction

from reference.ledger import Claim, load
from replication.check.inputs import Setting
from replication.check.table import Table
from replication.check.words import result_of
from spreadsheets.foreign import Position
from spreadsheets.recalculation import Calculation

_INPUTS = {
    "velocity": ("a1-initial-velocity",),
    "radius": ("a1-radius",),
    "diameter": ("a1-diameter",),
    "particle_density": ("a1-density",),
    "beta": ("depth-beta-5-beta", "depth-beta-3-beta"),
    "flow_stress": ("flow-stress",),
    "step": ("a-step", "coarse-step"),
    "stop_velocity": ("a-stop-velocity",),
    "mass": ("a1-mass",),
}
_HEADER = {
    "radius": "a1-radius", "particle_density": "a1-density", "mass": "a1-mass",
    "diameter": "a1-diameter", "velocity": "a1-initial-velocity", "resistance": "a1-resistance",
}  # fmt: skip
_CASES = ("beta-5", "beta-3")
"""As the betas above; Table A-1 is the first."""
_ROWS = 5
"""Rows that Table A-1 prints, the impact among them."""


@dataclass(frozen=True)
class Held:
    """A number that the report prints and a cell holds. `found` is in the claim's unit."""

    claim: Claim
    place: Position
    found: float
    met: bool


def report_inputs() -> dict[str, tuple[float, ...]]:
    """The report's inputs in SI, for both betas and steps; its target density as inferred."""
    ledger = load()
    values = {}
    for role, names in _INPUTS.items():
        claims = [ledger.claims[name] for name in names]
        values[role] = tuple(float(c.printed.value * c.si) for c in claims if c.printed)
    values["resistance"] = tuple(beta * values["flow_stress"][0] for beta in values["beta"])
    values["target_density"] = (float(ledger.inferred["target-density"].nominal),)
    return values


def held(
    setting: Setting, calculation: Calculation, alone: bool, ends: bool,
    report: Mapping[str, tuple[float, ...]],
) -> Iterator[Held]:  # fmt: skip
    """The printed numbers that a table of one of the report's cases holds, each judged.

    `alone`: it is the only table, so labelled results are its own; `ends`: it goes to the stop.
    """
    stated = ("velocity", "radius", "particle_density", "step")
    cases = [case for case, resistance in zip(_CASES, report["resistance"], strict=True)
             if math.isclose(resistance, setting.case.resistance, rel_tol=1e-9)]  # fmt: skip
    alike = (
        math.isclose(setting.inputs[role].si, report[role][0], rel_tol=1e-9) for role in stated
    )
    if not cases or not all(alike):
        return
    case = cases[0]
    table_a1 = case == _CASES[0]
    for role, name in _HEADER.items():
        own = setting.derived.get(role) or setting.inputs.get(role)
        value = calculation.number(own.place) if own else None
        if own and own.place and value is not None and (table_a1 or role != "resistance"):
            yield _judged(name, own.place, Fraction(value) * own.factor)
    for k in range(_ROWS if table_a1 else 0):
        for role, column in setting.rows.columns.items():
            name = f"a1-{role.replace('_', '-')}-{k}"
            if name in load().claims and k in column:
                yield _judged(name, setting.table.place(role, k), Fraction(column[k]))
    yield from _results(setting, calculation, case, alone, ends)


def _results(
    setting: Setting, calculation: Calculation, case: str, alone: bool, ends: bool
) -> Iterator[Held]:
    """The final depth, in a cell labelled so or in the last row, and that over the radius."""
    cells = dict(_labelled(calculation, setting.table)) if alone else {}
    depth = setting.rows("depth", setting.table.steps)
    if ends and depth is not None and "depth" not in cells:
        last = setting.table.place("depth", setting.table.steps)
        yield _judged(f"depth-{case}", last, Fraction(depth))
    for kind, place in cells.items():
        value = calculation.number(place) or 0.0
        if not ends and place in calculation.formulas:
            continue  # it is not the final depth that the formulas give so far
        if kind == "depth" and depth and value:
            power = 3 * round(math.log10(abs(depth / value)) / 3)  # its unit may be another
            yield _judged(f"depth-{case}", place, Fraction(value) * Fraction(10) ** power)
        elif kind == "ratio":
            yield _judged(f"ratio-{case}", place, Fraction(value))


def _labelled(calculation: Calculation, table: Table) -> Iterator[tuple[str, Position]]:
    """Cells beside or below a label that says final depth, or depth over radius."""
    lines = (*table.lines.values(), *table.helpers)
    for (sheet, row, column), text in calculation.values.items():
        kind = result_of(text) if isinstance(text, str) else None
        if kind is not None:
            for down, right in ((0, 1), (0, 2), (1, 0)):
                place = (sheet, row + down, column + right)
                inside = any(line.covers(place) for line in lines)
                if calculation.number(place) is not None and not inside:
                    yield kind, place
                    break


def _judged(name: str, place: Position, value: Fraction) -> Held:
    claim = load().claims[name]
    return Held(claim, place, float(value / claim.si), claim.target().contains(value))
