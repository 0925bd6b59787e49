"""Results beside the tables: each shows the last row of the table that it is said to be of."""

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
"""What the label of a depth has that may be that of another row than the last."""
_PERCENT = re.compile(r"%|percent|prozent", re.IGNORECASE)
_RADIUS = re.compile(r"/ *r\b|radi", re.IGNORECASE)
_DIAMETER = re.compile(r"diam|durchm|/ *\(?(?:2|d\b)|twice", re.IGNORECASE)

_NEARBY = 10
"""So many cells from a result at most, a number may say of which table it is."""


def misread(tables: Sequence[Examination]) -> None:
    """Results that are not those of the last row of their table, if no stop elsewhere is accused.

    One that reads two tables is a difference, and a list whose cells are not said to be of one
    table each may be of all rows.
    """
    for f in tables:
        _shown_again(f)
    calculation, wrong = tables[0].calculation, set[Position]()
    results = {result.place: result for f in tables for result in f.table.labelled}
    said = _said(tables, results.values()) if len(tables) > 1 else {}
    order = calculation.order
    for place in sorted({*calculation.formulas, *results}, key=lambda p: order.get(p, -1)):
        follows = any(area.corner in wrong for area in calculation.areas(place))
        here = results.get(place)
        if follows or (here and _is_wrong(tables, here, said.get(place, {}))):
            wrong.add(place)


def _shown_again(f: Examination) -> None:
    """Columns that show the depth in another unit, or over the radius, but not as their heads say.

    Rounded ones are left alone.
    """
    for line in f.table.helpers:
        head = line.head or ""
        ratio = result_of(head) == "ratio"
        in_unit = _stated(head, line.unit, ratio)
        shows_depth = "depth" in line.roles and in_unit is not None
        if any(map(str.isdigit, head)) or not (ratio or shows_depth):
            continue  # "x * 10^6"
        rows = range(1, f.table.steps + 1)
        shown = {k: number for k in rows if (number := line.at(f.table.zero + k))}
        depths = {k: x for k in shown if (x := f.rows("depth", k))}
        factors = [shown[k] / x * (f.case.radius if ratio else 1.0) for k, x in depths.items()]
        factor = median(factors) if factors else 0.0
        if sum(near(each, factor) for each in factors) <= 0.5 * len(factors):
            continue
        power, cells = power_of_ten(factor), [line.place(f.table.zero + k) for k in depths]
        read = {area.corner for cell in cells for area in f.calculation.areas(cell)}
        if read & f.accused:
            continue  # it follows from what is accused
        if _says_radius(head) and near(factor, 0.5):
            text = "the column is the depth over the diameter, not over the radius"
            f.add("odd formula", cells, None, text)
        elif power is not None and power != -(in_unit or 0):
            size = times_too(power + (in_unit or 0))
            text = f"the column is {size} for its head: a unit is not converted"
            f.add("unit", cells, None, text)


def _stated(text: str, unit: str | None, is_ratio: bool) -> int | None:
    """The power of ten of the unit beside a label or a head; -2 for a ratio said to be percent."""
    return -2 if is_ratio and _PERCENT.search(text) else unit_power(unit)


def _says_radius(text: str) -> bool:
    """Whether a label or a head says that something is over the radius, not the diameter."""
    return bool(_RADIUS.search(text)) and not _DIAMETER.search(text)


def _is_wrong(tables: Sequence[Examination], result: Result, named: Mapping[str, float]) -> bool:
    """Whether a result is accused; `named` are inputs of the table that it is said to be of."""
    read = [f for f in tables if f.table.gives_depth(result.place)]
    read = read or [f for f in tables if result.place in f.table.readers]
    if len(read) != 1 or (result.where == "listed" and not named):
        return False
    if result.where == "beyond" and len(tables) == 1:
        return False  # it may be another number on purpose
    (f,) = read
    if stops_elsewhere(f) or result.place in f.calculation.unknown:
        return False
    meant = [g for g in tables if all(has_input(g, *each) for each in named.items())]
    of_label = [each.place for each in f.table.labelled if each.label == result.label]
    if result.where == "beyond" and sum(map(f.table.gives_depth, of_label)) == 1:
        result = result._replace(where="first")  # the only one of its table in the row
    unlike = next((role for role in named if not has_input(f, role, named[role])), None)
    fault = _fault(f, result, unlike, meant[0] if len(meant) == 1 else f)
    if fault:
        kind, expected, text, shown = fault
        f.add(kind, [result.place], expected, text, shown)
    return fault is not None


def _fault(
    f: Examination, result: Result, unlike: str | None, meant: Examination
) -> tuple[str, Value | None, str, Value | None] | None:
    """What is wrong with a result, if anything: its row, its unit, or its table.

    That is `f`, and not the one `meant`; `unlike` is an input in which the two differ.
    """
    kind, place, unit, label, where = result
    what = "the final depth" if kind == "depth" else "the depth over the radius"
    depths, last = f.rows.columns["depth"], f.table.steps
    value, formula = f.calculation.number(place) or 0.0, f.calculation.book[place].formula
    says = str(f.calculation.values[label])
    is_ratio = kind == "ratio" and where != "beyond"
    # The row that it shows, and times which power of ten; none if it is rounded, or no such depth.
    powers = ((k, f.power_shown(kind, value, k)) for k in sorted(depths, reverse=True))
    rows = ((k, power) for k, power in powers if power is not None)
    row, power = next(rows, (None, 0)) if f.table.gives_depth(place) else (None, 0)
    wanted = meant.table.place("depth", meant.table.steps)
    shown = address(wanted, wanted[0] != place[0])
    if row is None:
        says_radius = is_ratio and _says_radius(says)
        if says_radius and value and near(value * 2 * f.case.radius, f.final_depth or 0.0):
            text = "the number is the depth over the diameter, not over the radius"
            return "odd formula", 2 * value, text, None
        says_last = says_radius or (kind == "depth" and result_of(says) == "depth")
        if says_last and where == "first" and formula and not _is_about(f, kind, value, unit):
            text = f"{what} is not that of the last row of the table"
            return "odd formula", shown, text, formula
        return None
    is_near = row >= last - NEAR_END or "MAX(" in (formula or "").upper()
    is_near = is_near or result_of(says) not in ("any depth", None)
    if row != last and (_ANOTHER_ROW.search(says) or not is_near):
        return None
    if depths[row] == max(depths.values()) and "last" in f.table.readers[place]:
        row = last  # the largest depth is that of another row only where the table has gone wrong
    if unlike and meant is not f:
        here, right = (quantity(_number(g, unlike), unlike) for g in (f, meant))
        text = f"{what} reads the table where {title(unlike)} is {here}; its label says {right}"
        return "odd formula", shown, text, formula
    if row != last:
        text = f"{what} reads row {row} of the table, not {last}, its last"
        return "odd formula", shown, text, formula
    named = _stated(says, unit, is_ratio)
    if kind == "ratio" and power != -(named or 0):
        size = times_too(power + (named or 0))
        return "unit", None, f"{what} is {size}: a unit is not converted", None
    if kind == "depth" and named not in (None, -power):
        in_unit = unit_text("depth", -power)
        text = f"the label gives {what} in {unit}, but the number is in {in_unit}"
        return "unit", in_unit, text, unit
    return None


def _is_about(f: Examination, kind: str, value: float, unit: str | None) -> bool:
    """Whether a value is the last depth, or its ratio to the radius, to within 1 %.

    It may be rounded, or computed between two rows. In which power of ten is not judged here.
    """
    wanted = (f.final_depth or 0.0) / (f.case.radius if kind == "ratio" else 1.0)
    ratio = value * float(to_si(unit or "1")) / wanted if wanted else 0.0
    return ratio > 0 and abs(ratio / 10.0 ** round(math.log10(ratio)) - 1) < 0.01


def _said(
    tables: Sequence[Examination], results: Iterable[Result]
) -> dict[Position, dict[str, float]]:
    """What is said of the tables that results are of: inputs by role, by the result's cell.

    A label says it itself ("X/R, beta = 3"), or each result of a list, or of a row, has a number in
    a column, or a row, of an input: numbers that tables have, each its own.
    """
    values, said = tables[0].calculation.values, defaultdict[Position, dict[str, float]](dict)
    groups = defaultdict[Position, list[Result]](list)
    for result in results:
        groups[result.label].append(result)
    for label, group in groups.items():
        said |= _said_beside(tables, group)
        role, number = number_in(str(values[label]))
        # A velocity or a step that no table has is that of a row, or a time.
        if role == "beta" or (role and any(near(_number(f, role), number) for f in tables)):
            for result in group:
                if result.where == "first" or result.place in said:
                    said[result.place][role] = number
    return said


def _said_beside(
    tables: Sequence[Examination], group: Sequence[Result]
) -> dict[Position, dict[str, float]]:
    """What numbers beside the results of a list say of their tables, if they tell them apart."""
    values, said = tables[0].calculation.values, dict[Position, dict[str, float]]()
    beside = {result.place: _numbers_beside(values, result) for result in group}
    for name in sorted({name for numbers in beside.values() for name in numbers}):
        named = {place: numbers[name] for place, numbers in beside.items() if name in numbers}
        if all(any(has_input(f, name, number) for f in tables) for number in named.values()):
            for place, number in named.items():
                said.setdefault(place, {})[name] = number
    apart = {tuple(numbers.items()) for numbers in said.values()}
    return said if len(apart) == len(said) >= 2 else {}


def _numbers_beside(values: Mapping[Position, Value], result: Result) -> dict[str, float]:
    """Numbers in the row of a listed result under heads of inputs; else in its column."""
    (sheet, row, column), (_, label_row, label_column) = result.place, result.label
    numbers = defaultdict[str, set[float]](set)
    for side in (-1, 1):
        for k in range(side, side * _NEARBY, side):
            head, cell = (sheet, row + k, label_column), (sheet, row + k, column)
            if label_row < row:
                head, cell = (sheet, label_row, column + k), (sheet, row, column + k)
            name, value = values.get(head), values.get(cell)
            if name is None and value is None:
                break  # beyond a blank stands something else
            roles = input_roles(name, None) if isinstance(name, str) else frozenset[str]()
            if isinstance(value, str):
                role, value = number_in(value)
                roles = frozenset({role}) if role else roles
            if len(roles) == 1 and isinstance(value, float) and math.isfinite(value):
                numbers[next(iter(roles))].add(value)
    return {role: values.pop() for role, values in numbers.items() if len(values) == 1}


def has_input(f: Examination, role: str, number: float) -> bool:
    """Whether a number is an input of a table, in any unit."""
    value = _number(f, role)
    return value > 0 and power_of_ten(number / value) is not None


def _number(f: Examination, role: str) -> float:
    """An input of the case that a table should follow, or beta by its resistance; else zero."""
    if role == "beta":
        stress = f.inputs.get("flow_stress")
        return f.intended.resistance / (stress.si if stress else report_inputs()["flow_stress"][0])
    return float(getattr(f.intended, role, 0.0))
