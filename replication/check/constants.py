"""Numbers typed into formulas where the cell of an input should be read."""

import math
from collections.abc import Sequence

from replication.check.cells import formula_at
from replication.check.examination import Examination
from replication.check.fit import Probe
from replication.check.labels import label_of
from replication.check.responses import FAMILIES, Influence, is_plain
from replication.check.roles import Inputs
from replication.check.table import cell_name
from replication.check.words import input_roles, title
from spreadsheets.evaluate import Evaluator
from spreadsheets.foreign import Position
from spreadsheets.scalars import Error, LiteralKey, Scalar

_TESTED_BY = {
    "step": ("c = dt", "e = dt", "t = dt", "c = e", "t = c"), "target": ("G",), "strength": ("H",),
    "size": ("D", "G", "H", "mass"), "inertia": ("G", "H"), "speed": ("V",),
}  # fmt: skip
"""The equations that a typed number breaks if it is not that of the cell."""


def typed_constants(
    exam: Examination, inputs: Inputs, beside: Sequence[Position], broken: dict[str, str]
) -> None:
    """Report numbers typed into formulas of the rows where a cell holds that input.

    `beside` are numbers that the table does not read; `broken` are the equations that do not hold,
    of which this explains some.
    """
    told: set[tuple[Position, str]] = set()
    for source in inputs.sources:
        family = source.family
        if source.literal is None or source.place is None or family is None:
            continue  # a name that stands for a number is an input by itself
        cell: tuple[str, Position | str] | None = _cell_for(
            source, family, inputs, beside, exam.table.evaluator
        )
        if cell is None:
            continue
        role, place = cell
        cells = _cells_with(exam, source.place) or [source.place]
        if (cells[0], role) not in told:
            told.add((cells[0], role))
            where = (
                place if isinstance(place, str) else cell_name(place, place[0] != exam.table.sheet)
            )
            text = f"{title(role)} is typed as {source.value:.10g}, where {where} should be read"
            exam.add("typed constant", cells, where, text, formula_at(exam, cells[0]))
            for name in _TESTED_BY[family]:
                broken.pop(name, None)


def typed_stops(exam: Examination, inputs: Inputs) -> None:
    """Report a stop velocity that is typed into formulas, though a cell that nothing reads has it.

    It is a number that ends the rows: with a larger one, just above a velocity of the row, the
    formula gives no number. An error, as that of too large a power, is no end.
    """
    probe, stop = exam.fitted.probe, inputs.cells.get("stop_velocity")
    if probe is None or stop is None or inputs.how.get("stop_velocity") != "unread":
        return
    if stop.cell is not None and not exam.on_own_sheets(stop.cell):
        return
    where = cell_name(stop.cell, stop.cell[0] != exam.table.sheet) if stop.cell else stop.name
    speeds = [v for (role, _), v in probe.base.items() if role.startswith("velocity") and v > 0]
    for (role, offset), place in probe.state.items():
        shape = exam.table.evaluator.formulas.get(place)
        if offset or role == "time" or shape is None:
            continue
        for index, value in enumerate(shape.literals):
            if value > 0 and any(_ends_below(probe, place, (*place, index), v) for v in speeds):
                cells = _cells_with(exam, place)
                text = f"{title('stop_velocity')} is typed as {value:.10g}, where {where} should "
                exam.add("typed constant", cells, where, f"{text}be read")
                break


def _ends_below(probe: Probe, place: Position, key: LiteralKey, speed: float) -> bool:
    """Whether a number typed into a formula ends the rows at velocities below it.

    It must do so at half the velocity, too: a power that overflows does not.
    """
    speeds = {state: v for state, v in probe.base.items() if state[0].startswith("velocity")}
    for part in (1.0, 0.5):
        state = {name: part * v for name, v in speeds.items()}
        below, above = (
            probe.scalar(place, state, {}, {key: times * part * speed}) for times in (0.99, 1.01)
        )
        if type(below) is not float or not _is_end(above):
            return False
    return True


def _is_end(value: Scalar) -> bool:
    """Whether a formula that gives this ends the rows: a text, a blank, or #N/A for a chart."""
    return value == "#N/A" or not isinstance(value, Error | float)


def _cells_with(exam: Examination, place: Position) -> list[Position]:
    """All cells of a column that have the formula of a cell; or the one cell beside the table."""
    table, formulas = exam.table, exam.table.evaluator.formulas
    for line in (*table.lines.values(), *table.helpers):
        if line.place(place[2] if line.across else place[1]) == place:
            cells = [line.place(i) for _, i in sorted(table.rows.items())]
            return [cell for cell in cells if formulas.get(cell) is formulas[place]]
    return [place]


def _cell_for(
    source: Influence, family: str, inputs: Inputs, beside: Sequence[Position],
    evaluator: Evaluator,
) -> tuple[str, Position | str] | None:  # fmt: skip
    """The role and the cell, or the name, of what a typed number repeats; None if there is none.

    It is a cell that the rows read but to which the part with the typed number does not respond; or
    a cell that nothing reads, with such a label or with that very number.
    """
    needed = [name for name, power in source.powers.items() if abs(power) > 0.02]
    for role in FAMILIES[family]:
        known = inputs.cells.get(role)
        if known is None or (known.cell is None and not known.name):
            continue
        alike = _digits_alike(source.value, known.value)
        sole = role == "resistance" and _is_sole(source, inputs)
        single = sole or family in ("target", "step", "speed")
        if inputs.how.get(role) == "unread":
            if alike or single:
                return role, known.place or known.name
        elif any(abs(known.powers.get(name, 0.0)) < 0.02 for name in needed) and (
            family != "inertia" and (family != "size" or alike)
        ):
            return role, known.cell or known.name
    for place in beside:
        value = evaluator.values.get(place)
        if type(value) is float and _is_same(value, source.value) and not is_plain(value):
            label, unit = inputs.labels.get(place, ("", None))
            roles = input_roles(label, unit) if label else frozenset(FAMILIES[family])
            if wanted := [role for role in FAMILIES[family] if role in roles or not roles]:
                return wanted[0], place
    return _unread_formula(source, family, inputs, beside, evaluator)


def _unread_formula(
    source: Influence, family: str, inputs: Inputs, beside: Sequence[Position], evaluator: Evaluator
) -> tuple[str, Position | str] | None:
    """The one formula beside that computes the mass, or the resistance, and that nothing reads."""
    role = {"inertia": "mass", "strength": "resistance"}.get(family)
    if role is None or not _is_sole(source, inputs) or inputs.derived.get(role):
        return None
    named = []
    for place in beside:
        if place in evaluator.formulas:
            label, unit, _ = label_of(place, evaluator)
            if label and input_roles(label, unit) == {role}:
                named.append(place)
    return (role, named[0]) if len(named) == 1 else None


def _is_same(value: float, typed: float) -> bool:
    """Whether a typed number is a value, which formulas may give with other last digits."""
    return math.isclose(value, typed, rel_tol=1e-12)


def _is_sole(source: Influence, inputs: Inputs) -> bool:
    """Whether nothing else that the rows rest on responds as a typed number does."""
    return all(s is source or s.family != source.family for s in inputs.sources)


def _digits_alike(a: float, b: float) -> bool:
    """Whether two numbers are the same but for a power of ten, or one is twice the other."""
    if not a or not b or a / b <= 0:
        return False
    powers = (math.log10(a / b * times) for times in (1.0, 2.0, 0.5))
    return any(abs(power - round(power)) < 1e-9 for power in powers)
