"""Results beside the tables: each should show the last row of the table that its label names."""

import math
import re
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from statistics import median

from reference.units import to_si
from replication.check.examination import Examination, near
from replication.check.inputs import report_inputs
from replication.check.judge import stops_elsewhere
from replication.check.table import NEAR_END, Result, address
from replication.check.words import (
    input_roles,
    number_in,
    power_of_ten,
    quantity,
    result_of,
    times_too,
    title,
    unit_power,
    unit_text,
)
from spreadsheets.foreign import Position, Value

_ANOTHER_ROW = re.compile(
    r"\d *(?:[nµu]?s|sec\w*)\b|"
    r"\b(?:steps?|schritte?|rows?|zeile|first|half|lost|previous|before|prior|penultimate)\b",
    re.IGNORECASE,
)
"""Words in a label by which a depth may belong to another row than the last."""
_PERCENT = re.compile(r"%|percent|prozent", re.IGNORECASE)
_RADIUS = re.compile(r"/ *r\b|radi", re.IGNORECASE)
_DIAMETER = re.compile(r"diam|durchm|/ *\(?(?:2|d\b)|twice", re.IGNORECASE)

_NEARBY = 10
"""How far from a result a number may stand that says which table the result belongs to."""


def misread(tables: Sequence[Examination]) -> None:
    """Report results that do not show the last row of their table.

    A table whose stop is accused is left alone. So are a result that reads two tables, which may be
    their difference, and a list without a table named for each of its cells, which may show rows.
    """
    for exam in tables:
        _judge_columns(exam)
    calculation, wrong = tables[0].calculation, set[Position]()
    results = {result.place: result for exam in tables for result in exam.table.labelled}
    named = _named_inputs(tables, results.values()) if len(tables) > 1 else {}
    for place in sorted(results, key=lambda place: calculation.order.get(place, -1)):
        if place not in wrong and _accuse(tables, results[place], named.get(place, {})):
            wrong |= calculation.needing({place})


def _judge_columns(exam: Examination) -> None:
    """Report columns beside the table that show x or x/R in another unit than their heads say.

    Columns of rounded numbers are left alone.
    """
    for line in exam.table.helpers:
        head = line.head or ""
        ratio = result_of(head) == "ratio"
        stated = _stated_power(head, line.unit, ratio)
        shows_depth = "depth" in line.roles and stated is not None
        if any(map(str.isdigit, head)) or not (ratio or shows_depth):
            continue  # such as "x * 10^6"
        rows = range(1, exam.table.steps + 1)
        shown = {k: number for k in rows if (number := line.at(exam.table.zero + k))}
        depths = {k: x for k in shown if (x := exam.rows("depth", k))}
        factors = [shown[k] / x * (exam.case.radius if ratio else 1.0) for k, x in depths.items()]
        factor = median(factors) if factors else 0.0
        cells = [line.place(exam.table.zero + k) for k in depths]
        read = set[Position]().union(*map(exam.calculation.corners, cells))
        is_rounded = sum(near(value, factor) for value in factors) <= 0.5 * len(factors)
        if is_rounded or read & exam.accused:
            continue
        power = power_of_ten(factor)
        if _says_radius(head) and near(factor, 0.5):
            text = "the column is the depth over the diameter, not over the radius"
            exam.add("odd formula", cells, None, text)
        elif power is not None and (slip := power + (stated or 0)):
            text = f"the column is {times_too(slip)} for its head: a unit is not converted"
            exam.add("unit", cells, None, text)


def _stated_power(text: str, unit: str | None, is_ratio: bool) -> int | None:
    """Return the power of ten of the unit that a label or head states; -2 for percent."""
    return -2 if is_ratio and _PERCENT.search(text) else unit_power(unit)


def _says_radius(text: str) -> bool:
    """Whether a label or head names x over the radius, not over the diameter."""
    return bool(_RADIUS.search(text)) and not _DIAMETER.search(text)


def _accuse(tables: Sequence[Examination], result: Result, named: Mapping[str, float]) -> bool:
    """Report a result that is wrong, and return whether it is.

    `named` are the inputs by which its label names its table.
    """
    read = [exam for exam in tables if exam.table.gives_depth(result.place)]
    read = read or [exam for exam in tables if result.place in exam.table.readers]
    if len(read) != 1 or (result.where == "listed" and not named):
        return False
    if result.where == "beyond" and len(tables) == 1:
        return False  # it may be something else on purpose
    (exam,) = read
    if stops_elsewhere(exam) or result.place in exam.calculation.unknown:
        return False
    meant = [table for table in tables if all(has_input(table, *pair) for pair in named.items())]
    in_row = [other.place for other in exam.table.labelled if other.label == result.label]
    if result.where == "beyond" and sum(map(exam.table.gives_depth, in_row)) == 1:
        result = result._replace(where="first")  # it is the only one of its table in this row
    unlike = next((role for role in named if not has_input(exam, role, named[role])), None)
    fault = _fault(exam, result, unlike, meant[0] if len(meant) == 1 else exam)
    if fault:
        kind, expected, text, found = fault
        exam.add(kind, [result.place], expected, text, found)
    return fault is not None


def _fault(
    exam: Examination, result: Result, unlike: str | None, meant: Examination
) -> tuple[str, Value | None, str, Value | None] | None:
    """Return what is wrong with a result: kind, expected value, explanation and found value.

    The result reads the table of `exam`, its label means that of `meant`; `unlike` is an input in
    which the label contradicts the table that is read. None if nothing is wrong.
    """
    kind, place, unit, label, where = result
    what = "the final depth" if kind == "depth" else "the depth over the radius"
    depths, last = exam.rows.columns["depth"], exam.table.steps
    value, formula = exam.calculation.number(place) or 0.0, exam.calculation.book[place].formula
    label_text = str(exam.calculation.values[label])
    is_ratio = kind == "ratio" and where != "beyond"
    # The row that it shows, and the power of ten by which; None if it is rounded or not a depth.
    powers = ((k, exam.power_shown(kind, value, k)) for k in sorted(depths, reverse=True))
    rows = ((k, power) for k, power in powers if power is not None)
    row, power = next(rows, (None, 0)) if exam.table.gives_depth(place) else (None, 0)
    last_cell = meant.table.place("depth", meant.table.steps)
    expected = address(last_cell, last_cell[0] != place[0])
    if row is None:
        says_radius = is_ratio and _says_radius(label_text)
        if says_radius and value and near(value * 2 * exam.case.radius, exam.final_depth or 0.0):
            text = "the number is the depth over the diameter, not over the radius"
            return "odd formula", 2 * value, text, None
        says_last = says_radius or (kind == "depth" and result_of(label_text) == "depth")
        if says_last and where == "first" and formula and not _is_about(exam, kind, value, unit):
            text = f"{what} is not that of the last row of the table"
            return "odd formula", expected, text, formula
        return None
    is_near = row >= last - NEAR_END or "MAX(" in (formula or "").upper()
    is_near = is_near or result_of(label_text) not in ("any depth", None)
    if row != last and (_ANOTHER_ROW.search(label_text) or not is_near):
        return None
    if depths[row] == max(depths.values()) and "last" in exam.table.readers[place]:
        row = last  # another row has the largest depth only because the table has gone wrong
    if unlike and meant is not exam:
        taken, named = (quantity(_number(table, unlike), unlike) for table in (exam, meant))
        text = f"{what} reads the table where {title(unlike)} is {taken}; its label says {named}"
        return "odd formula", expected, text, formula
    if row != last:
        text = f"{what} reads row {row} of the table, not {last}, its last"
        return "odd formula", expected, text, formula
    stated = _stated_power(label_text, unit, is_ratio)
    if kind == "ratio" and (slip := power + (stated or 0)):
        return "unit", None, f"{what} is {times_too(slip)}: a unit is not converted", None
    if kind == "depth" and stated not in (None, -power):
        in_unit = unit_text("depth", -power)
        text = f"the label gives {what} in {unit}, but the number is in {in_unit}"
        return "unit", in_unit, text, unit
    return None


def _is_about(exam: Examination, kind: str, value: float, unit: str | None) -> bool:
    """Whether a value is the last depth, or its ratio to the radius, within 1 % in any unit.

    Such a value may be rounded, or interpolated between two rows.
    """
    wanted = (exam.final_depth or 0.0) / (exam.case.radius if kind == "ratio" else 1.0)
    ratio = value * float(to_si(unit or "1")) / wanted if wanted else 0.0
    return ratio > 0 and abs(ratio / 10.0 ** round(math.log10(ratio)) - 1) < 0.01


def _named_inputs(
    tables: Sequence[Examination], results: Iterable[Result]
) -> dict[Position, dict[str, float]]:
    """Return, for each result's cell, the inputs by which the table that it belongs to is named.

    They stand in the label ("X/R, beta = 3"), or a list or row of results has a column or row with
    an input's number for each of them.
    """
    values, named = tables[0].calculation.values, defaultdict[Position, dict[str, float]](dict)
    groups = defaultdict[Position, list[Result]](list)
    for result in results:
        groups[result.label].append(result)
    for label, group in groups.items():
        named |= _named_beside(tables, group)
        role, number = number_in(str(values[label]))
        # A velocity or a step that no table has belongs to a row, or is a time.
        if role == "beta" or (role and any(near(_number(exam, role), number) for exam in tables)):
            for result in group:
                if result.where == "first" or result.place in named:
                    named[result.place][role] = number
    return named


def _named_beside(
    tables: Sequence[Examination], group: Sequence[Result]
) -> dict[Position, dict[str, float]]:
    """Return the inputs that numbers beside each result of a list name, if all results differ."""
    values, named = tables[0].calculation.values, dict[Position, dict[str, float]]()
    beside = {result.place: _numbers_beside(values, result) for result in group}
    for role in sorted({role for numbers in beside.values() for role in numbers}):
        numbers = {place: inputs[role] for place, inputs in beside.items() if role in inputs}
        if all(any(has_input(exam, role, x) for exam in tables) for x in numbers.values()):
            for place, number in numbers.items():
                named.setdefault(place, {})[role] = number
    distinct = {tuple(numbers.items()) for numbers in named.values()}
    return named if len(distinct) == len(named) >= 2 else {}


def _numbers_beside(values: Mapping[Position, Value], result: Result) -> dict[str, float]:
    """Return the numbers under heads of inputs in the row of a result; for a row, in its column."""
    (sheet, row, column), (_, label_row, label_column) = result.place, result.label
    numbers = defaultdict[str, set[float]](set)
    for side in (-1, 1):
        for k in range(side, side * _NEARBY, side):
            head, cell = (sheet, row + k, label_column), (sheet, row + k, column)
            if label_row < row:
                head, cell = (sheet, label_row, column + k), (sheet, row, column + k)
            name, value = values.get(head), values.get(cell)
            if name is None and value is None:
                break  # what stands beyond a blank does not belong to the list
            roles = input_roles(name, None) if isinstance(name, str) else frozenset[str]()
            if isinstance(value, str):
                role, value = number_in(value)
                roles = frozenset({role}) if role else roles
            if len(roles) == 1 and isinstance(value, float) and math.isfinite(value):
                numbers[next(iter(roles))].add(value)
    return {role: values.pop() for role, values in numbers.items() if len(values) == 1}


def has_input(exam: Examination, role: str, number: float) -> bool:
    """Whether a number is the value of a table's input, in any unit."""
    value = _number(exam, role)
    return value > 0 and power_of_ten(number / value) is not None


def _number(exam: Examination, role: str) -> float:
    """Return an input of the intended case, beta as resistance over flow stress; 0 if unknown."""
    if role == "beta":
        stress = exam.inputs.get("flow_stress")
        flow_stress = stress.si if stress else report_inputs()["flow_stress"][0]
        return exam.intended.resistance / flow_stress
    return float(getattr(exam.intended, role, 0.0))
