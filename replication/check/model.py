"""Whether a table follows the report's model at all, or another one."""

import math
from collections.abc import Sequence
from dataclasses import replace

from replication.check.cells import formula_at, predicted
from replication.check.delimited import column_at, where
from replication.check.examination import AnotherModelError, Examination
from replication.check.responses import FAMILIES, trace
from replication.check.roles import Inputs
from replication.check.rows import MOST
from replication.check.six import REPORT, VARIANTS, end_of_row, start_of_row
from replication.check.table import SchemeTable, cell_name
from replication.check.taken import report_inputs
from replication.check.units import Balance
from replication.check.words import input_roles, title
from spreadsheets.foreign import Position

_LEAST_KNOWN = 3
"""So many kinds of inputs must be known where the formulas are not the report's."""
_ROUGH = 0.02
"""A row of numbers belongs to the model if it gives its deceleration to two percent."""
_LARGE = 1e9
"""A number in place of a blank cell, so large that a force that reads it is another one."""
_FEW_ROWS = 6
"""Of fewer rows without formulas it cannot be said that they follow another model."""


def refuse_other_model(exam: Examination, inputs: Inputs, balances: Sequence[Balance]) -> None:
    """Raise AnotherModelError if the formulas are not the report's, and the inputs are not either.

    Formulas that are not the report's are a fault if the rest of the table is: if two of the
    equations between its numbers and cells hold, or if its inputs are known.
    """
    fitted = exam.fitted
    if blank_inputs(exam):
        return
    for role, source in inputs.cells.items():
        if source.cell in exam.read and source.value <= 0 and role != "stop_velocity":
            where = cell_name(source.cell, True)
            raise AnotherModelError(
                f"{where}: {title(role)} is {source.value:g}: no impact has that"
            )
    _refuse_zero(inputs)
    if fitted.probe is None:
        _refuse_numbers(exam, inputs, balances)
        return
    wrong = [role for role, way in fitted.ways.items() if way is not REPORT[role]]
    force = fitted.ways.get("deceleration", REPORT["deceleration"])
    if not wrong or force is REPORT["deceleration"]:
        return
    hold = {eq.name for eq in balances if eq.holds(inputs.powers)}
    strong = len(hold & {"D", "mass", "diameter", "G", "H", "resistance"})
    if strong >= (1 if fitted.centered else 2) or ("D" in hold and force is None):
        return  # the contact area is that of the sphere whose radius a cell holds
    known, report = _known_families(inputs)
    if known >= _LEAST_KNOWN and (strong or report > 1):
        return
    raise AnotherModelError(
        _sentence(exam, wrong[0] if "deceleration" not in wrong else "deceleration")
    )


def _refuse_numbers(exam: Examination, inputs: Inputs, balances: Sequence[Balance]) -> None:
    """Raise AnotherModelError if rows without formulas do not follow the report's scheme."""
    fitted = exam.fitted
    is_typed = not any(line.computed for line in exam.table.lines.values())
    if is_typed and fitted.followed <= MOST:
        raise AnotherModelError(other_method(exam.table))
    if is_typed and not fitted.told and fitted.ways["depth"] is VARIANTS["explicit Euler"]:
        raise AnotherModelError(maybe_other_method(exam.table, "explicit Euler"))
    if not (_rows_agree(exam) and _steps_agree(balances, inputs)):
        raise AnotherModelError(_sentence(exam, "deceleration"))


def _refuse_zero(inputs: Inputs) -> None:
    """Raise AnotherModelError if a cell is zero that the label calls an input of the rows."""
    for source in inputs.sources:
        label, unit = inputs.label(source)
        roles = input_roles(label, unit) if label and source.cell and not source.value else ()
        if len(roles) == 1 and "stop_velocity" not in roles:
            where = cell_name(source.cell, True) if source.cell else ""
            (role,) = roles
            raise AnotherModelError(f"{where}: {title(role)} is 0: no impact has that")


def zero_of_blank(exam: Examination, inputs: Inputs) -> Position | None:
    """A formula that the label calls an input, and that is zero as it reads a blank cell."""
    evaluator = exam.table.evaluator
    for source in inputs.sources:
        label, unit = inputs.label(source)
        named = bool(label) and len(input_roles(label, unit)) == 1
        if (
            source.cell not in evaluator.formulas
            or source.cell is None
            or source.value
            or not named
        ):
            continue
        read = (area.corner for area in evaluator.areas(source.cell) if area.cells == 1)
        if any(cell not in evaluator.formulas and evaluator.values.get(cell) is None
               for cell in read):  # fmt: skip
            return source.cell
    return None


def blank_inputs(exam: Examination) -> list[Position]:
    """The blank cells that the force reads as the density or the resistance of the target.

    Without them the force lacks one of its parts; it has another value if numbers stand there.
    """
    fitted = exam.fitted
    if fitted.force is None and fitted.probe is not None:
        return _blank_force(exam)
    lacks = (VARIANTS["no drag"], VARIANTS["no resistance"])
    if fitted.force is None or fitted.ways.get("deceleration") not in lacks:
        return []
    blank = sorted(trace(exam.table, fitted).blank)
    depth, speed = (fitted.force.probe.base[s] for s in (fitted.force.x, fitted.force.u))

    def value(cells: Sequence[Position]) -> float:
        assert fitted.force is not None
        return replace(fitted.force, cells=dict.fromkeys(cells, _LARGE))(depth, speed)

    filled = value(blank)
    if fitted.force(depth, speed) == filled:
        return []
    return [place for place in blank if value([p for p in blank if p != place]) != filled]


def _blank_force(exam: Examination) -> list[Position]:
    """The blank cells without which there is no force at all."""
    fitted, blank = exam.fitted, sorted(trace(exam.table, exam.fitted).blank)
    probe = fitted.probe
    if probe is None or (fitted.brakes, 0) not in probe.state:
        return []
    place = probe.state[fitted.brakes, 0]

    def value(cells: Sequence[Position]) -> float:
        return probe.value(place, {}, dict.fromkeys(cells, _LARGE), {})

    if not fitted.brakes.startswith("decel") or value([]) != 0 or value(blank) == 0:
        return []
    return [p for p in blank if value([q for q in blank if q != p]) != value(blank)]


def _known_families(inputs: Inputs) -> tuple[int, int]:
    """How many kinds of inputs are known by label or value; how many hold the report's value."""
    known, report = 0, 0
    for family, members in FAMILIES.items():
        if family in ("step", "speed"):
            continue
        named = is_report = False
        for role in members:
            source = inputs.cells.get(role) or inputs.derived.get(role)
            if source is None:
                continue
            label, unit = inputs.label(source)
            named |= bool(label) and role in input_roles(label, unit)
            named |= inputs.how.get(role) == "--map"
            powers = [math.log10(abs(source.value) / x) for x in report_inputs().get(role, ())]
            is_report |= any(abs(p - round(p)) < 1e-9 for p in powers)
        known += named or is_report
        report += is_report
    return known, report


def other_method(table: SchemeTable) -> str:
    """Say that the rows of a table of numbers do not follow the report's scheme."""
    return (
        f"{_columns_found(table)}, but most rows do not follow the report's scheme: they come from "
        "another method or model"
    )


def maybe_other_method(table: SchemeTable, name: str) -> str:
    """Say that the digits of rows do not tell a scheme from a better method."""
    return (
        f"{_columns_found(table)}, but they start with a whole step, and the digits do not tell "
        f"whether that is {name} or another method: print more digits"
    )


def _columns_found(table: SchemeTable) -> str:
    """Say which columns are taken for a motion."""
    text = table.evaluator.book.is_text
    roles = ("time", "depth", "velocity_initial", "velocity_final")
    shown = [
        column_at(table.evaluator.book, table.lines[role].number) if text else table.area(role)
        for role in roles if role in table.lines
    ]  # fmt: skip
    here = "" if text else f" in {table.sheet!r}"
    return f"columns of depth and velocity are found{here} ({', '.join(shown)})"


_SAYS = {
    "deceleration": ("the deceleration", "is no pressure (G v² + H) on the contact area of a "
                     "sphere, D x - x²"),
    "velocity_final": ("the velocity", "does not lose the deceleration times the step"),
    "depth": ("the depth", "does not grow by a velocity times the step"),
}  # fmt: skip


def _sentence(exam: Examination, role: str) -> str:
    """Say that a table is another model, and by which cell."""
    table = exam.table
    place = table.place(role if role in table.lines else exam.fitted.brakes, min(3, table.steps))
    subject, what = _SAYS[role]
    depth, speed = table.area("depth"), table.area(start_of_row(table)[0])
    opening = f"another model: {table.sheet!r} has depths in {depth} and velocities in {speed}"
    if place in table.evaluator.formulas:
        formula = formula_at(exam, place)[:120]
        return f"{opening}, but {subject} in {cell_name(place, True)}, {formula}, {what}"
    if table.evaluator.book.is_text:
        return f"another model: the number in {where(table.evaluator.book, place)}, {what}"
    return f"{opening}, but the number in {cell_name(place, True)} {what}"


def _steps_agree(balances: Sequence[Balance], inputs: Inputs) -> bool:
    """Whether depth and velocity of a table of numbers change by the same step, in some unit."""
    rests = [(eq.residual(inputs.powers), eq.slack) for eq in balances if eq.name == "c = e"]
    return all(abs(rest - round(rest)) < slack for rest, slack in rests)


def _rows_agree(exam: Examination) -> bool:
    """Whether most rows of numbers follow from the six numbers that were fitted to them."""
    table, six = exam.table, exam.fitted.six
    if not all(math.isfinite(x) for x in six[:4]) or table.steps < _FEW_ROWS:
        return True
    role = "deceleration" if "deceleration" in table.lines else end_of_row(table)[0]
    least = 1e-3 * max(map(abs, table.lines[role].values.values()))
    rows = ((table.number(role, k), predicted(exam, role, k)) for k in table.rows if k >= 1)
    pairs = [(value, wanted) for value, wanted in rows if value is not None and wanted is not None]
    good = sum(abs(a - b) <= _ROUGH * max(abs(a), least) for a, b in pairs)
    return not pairs or good > len(pairs) / 2
