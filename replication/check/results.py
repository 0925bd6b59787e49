"""Results beside the tables: which row each one equals, and whether that is the last."""

import math
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from reference.ledger import Claim, load
from reference.units import same_dimension, to_si
from replication.check.ends import NEAR_END, OTHER_STOP
from replication.check.examination import NO_FAULT, Departure, Examination, near
from replication.check.labels import label_of
from replication.check.responses import is_plain
from replication.check.table import LEAST, cell_name
from replication.check.taken import report_case, report_inputs
from replication.check.words import (
    number_in,
    power_of_ten,
    result_named,
    times_too,
    title,
    unit_name,
)
from replication.text import with_unit
from spreadsheets.evaluate import Evaluator, formula_text
from spreadsheets.foreign import Position
from spreadsheets.scalars import Area

_LIST = 4
"""So far left of a result the number of its row may stand."""
_ANOTHER_ROW = re.compile(
    r"\d *(?:[nµu]?s|sec\w*)\b|"
    r"\b(?:steps?|schritte?|rows?|zeile|first|half|lost|previous|before|prior|penultimate)\b",
    re.IGNORECASE,
)
"""Words in a label by which a depth may belong to another row than the last."""
_PERCENT = re.compile(r"%|percent|prozent", re.IGNORECASE)
_DIAMETER = re.compile(r"diam|durchm|/ *\(?(?:2|d\b)|twice", re.IGNORECASE)


@dataclass(frozen=True)
class Result:
    """A cell that equals the depth of a row, or that over the radius, up to a power of ten."""

    place: Position
    exam: Examination
    k: int
    ratio: bool
    power: int
    over_diameter: bool = False


def results(exams: Sequence[Examination], evaluator: Evaluator) -> Iterator[Result]:
    """The formulas beside the tables that read depths, each with the row that it equals."""
    lined: set[Position] = set()
    for exam in exams:
        lined |= set(exam.table.places)
        for line in exam.table.helpers:
            lined |= {line.place(i) for i in line.values}
    depths = [(exam, _depth_cells(exam)) for exam in exams]
    known: dict[Position, Result] = {}
    for place in sorted(evaluator.formulas, key=lambda p: evaluator.order.get(p, 0)):
        value = evaluator.values.get(place)
        if place in lined or type(value) is not float or not 0 < abs(value) < math.inf:
            continue
        areas = evaluator.areas(place)
        for exam, cells in depths:
            rows = _rows_read(areas, exam, cells, known)
            result = _equals(place, value, exam, rows) if rows else None
            if result is not None:
                known[place] = result
                yield result
                break


def _depth_cells(exam: Examination) -> list[dict[Position, int]]:
    """The rows of the cells of the depths, and of each line beside that has them in another unit.

    That may be the radius: X/R.
    """
    table = exam.table
    depths = {p: k for p, (role, k) in table.places.items() if role == "depth"}
    lines = [depths]
    rows = {index: k for k, index in table.rows.items()}
    for line in table.helpers:
        numbers = {rows[i]: value for i, value in line.values.items() if i in rows}
        pairs = [(value, table.number("depth", k)) for k, value in numbers.items()]
        ratios = [value / x for value, x in pairs if x]
        if len(ratios) >= LEAST and ratios[0] and all(near(r, ratios[0]) for r in ratios):
            lines.append({line.place(table.rows[k]): k for k in numbers})
    return lines


def _rows_read(
    areas: Sequence[Area], exam: Examination, lines: Sequence[Mapping[Position, int]],
    known: Mapping[Position, Result],
) -> list[int]:  # fmt: skip
    """The rows whose depths a formula may show, by what it reads: the likely ones first.

    It reads one depth, or a range of them, or another result.
    """
    single = {
        cells[a.corner] for a in areas if a.cells == 1 for cells in lines if a.corner in cells
    }
    if single:
        return list(single) if len(single) == 1 else []
    through = [known[a.corner] for a in areas if a.cells == 1 and a.corner in known]
    own = [result.k for result in through if result.exam is exam]
    if own:
        return own
    wide = [a for a in areas if a.cells > 1]
    ranges = {k for a in wide for cells in lines for place, k in cells.items() if a.covers(place)}
    return sorted(ranges, reverse=True)


def _equals(place: Position, value: float, exam: Examination, rows: Sequence[int]) -> Result | None:
    for k in rows:
        x = exam.table.number("depth", k)
        if not x:
            continue
        X = exam.units.get("depth", 0.0)
        radius = exam.inputs.get("radius")
        for ratio, over, times in (
            (False, False, 1.0), (True, False, radius.si if radius else math.nan),
            (True, True, 2 * radius.si if radius else math.nan),
        ):  # fmt: skip
            wanted = x if not ratio else x * 10.0**X / times
            quotient = value / wanted if wanted == wanted and wanted else math.nan
            if quotient > 0:
                power = math.log10(quotient)
                if abs(power - round(power)) < 1e-9 and abs(power) < 13:
                    return Result(place, exam, k, ratio, round(power), over)
    return None


def judge_results(exams: Sequence[Examination], evaluator: Evaluator) -> None:
    """Report results that show another row than the last, or another unit than their label."""
    all_results = list(results(exams, evaluator))
    wrong: set[Position] = set()
    for result in all_results:
        exam = result.exam
        if any(d.explanation.startswith(OTHER_STOP) for d in exam.differences):
            continue
        read = {(a.sheet, a.top, a.left) for a in evaluator.areas(result.place) if a.cells == 1}
        accused = {d.place for d in exam.differences if d.kind not in NO_FAULT}
        if read & (wrong | accused):
            wrong.add(result.place)
            continue
        if any(r.place in read and r.over_diameter for r in all_results):
            continue  # it shows another result, which is judged
        _typed_radius(result, evaluator)
        label, unit, sure = label_of(result.place, evaluator)
        fault = _fault(result, all_results, label, unit, sure)
        if fault is not None:
            kind, expected, text = fault
            if result.k != exam.last and (source := _shown_by(result, all_results, evaluator)):
                wrong.add(result.place)
                result = source
                text = _taken_from(source)
            formula = evaluator.formulas[result.place]
            shown = formula_text(formula.key, result.place[1], result.place[2])
            exam.add(kind, [result.place], expected, text, shown if kind == "odd formula" else unit)
            wrong.add(result.place)


def _typed_radius(result: Result, evaluator: Evaluator) -> None:
    """Report the radius, or the diameter, typed into X/R, where its cell should be read."""
    exam, shape = result.exam, evaluator.formulas[result.place]
    for role in ("radius", "diameter") if result.ratio else ():
        entry = exam.inputs.get(role)
        if entry is None or entry.place is None or is_plain(entry.value):
            continue
        for number in shape.literals:
            if not is_plain(number) and power_of_ten(number / entry.value) is not None:
                where = cell_name(entry.place, entry.place[0] != result.place[0])
                text = f"{title(role)} is typed as {number:.10g}, where {where} should be read"
                shown = formula_text(shape.key, result.place[1], result.place[2])
                exam.add("typed constant", [result.place], where, text, shown)
                return


Fault = tuple[str, str | None, str]
"""What is wrong with a result: its kind, what is expected, and a sentence."""


def _fault(
    result: Result, all_results: Sequence[Result], label: str, unit: str | None, sure: bool
) -> Fault | None:
    """What is wrong with a result; None if nothing."""
    table = result.exam.table
    named = result_named(label) if label else None
    last = result.exam.last
    x, final = table.number("depth", result.k), table.number("depth", last)
    if result.k != last and x != final:
        return _other_row(result, all_results, label, named)
    if result.exam.cut_short and named == "depth" and not result.ratio:
        text = f"the label says the final depth, but the rows end at step {last}, before the stop"
        return "odd formula", None, text
    if result.over_diameter:
        wrong = result.power == 0 and named == "ratio" and not _DIAMETER.search(label)
        text = "the number is the depth over the diameter, not over the radius"
        return ("odd formula", None, text) if wrong else None
    if result.ratio:
        wanted = 2 if _PERCENT.search(label) or unit in ("%", "percent") else 0
        text = f"{_what(result)} is {times_too(result.power - wanted)}: a unit is not converted"
        return ("unit", None, text) if named == "ratio" and result.power != wanted else None
    if named == "ratio" and not unit and _tells_ratio(result.exam):
        return (
            "odd formula",
            None,
            "the label says the depth over the radius, but the number is the depth",
        )
    return _other_unit(result, unit) if unit and sure else None


def _what(result: Result) -> str:
    return "the depth over the radius" if result.ratio else "the final depth"


def _other_row(
    result: Result, all_results: Sequence[Result], label: str, named: str | None
) -> Fault | None:
    """The fault of a result that shows another row than the last; None if it may well do so."""
    exam, last = result.exam, result.exam.last
    same_row = any(r.k == last and r.place[:2] == result.place[:2] for r in all_results)
    if same_row or re.search(rf"(?<!\d){result.k}(?!\d)", label) or _says_row(result):
        return None
    close = last - NEAR_END <= result.k < last or named in ("depth", "ratio")
    shows_last = any(
        r.k == last and r.exam is exam and r.ratio == result.ratio for r in all_results
    )
    if not close or _ANOTHER_ROW.search(label) or (shows_last and named is None):
        return None
    cell = exam.table.place("depth", last)
    return "odd formula", cell_name(cell, cell[0] != result.place[0]), _taken_from(result)


def _taken_from(result: Result) -> str:
    """Say from which row a result is taken."""
    taken = f"{_what(result)} is taken from step {result.k} of the table"
    return f"{taken}; its last step is {result.exam.last}"


def _shown_by(result: Result, all_results: Sequence[Result], evaluator: Evaluator) -> Result | None:
    """The result that another one takes its depth from; None if that reads the table itself."""
    read = {a.corner for a in evaluator.areas(result.place) if a.cells == 1}
    return next((r for r in all_results if r.place in read and r.k == result.k), None)


def _says_row(result: Result) -> bool:
    """Whether a number at the left of a result is that of its row, as in a list of some rows."""
    sheet, row, column = result.place
    values = result.exam.table.evaluator.values
    beside = (values.get((sheet, row, column - d)) for d in range(1, _LIST + 1))
    return any(type(value) is float and value == result.k for value in beside)


def _other_unit(result: Result, unit: str) -> Fault | None:
    """The fault of a depth in another unit than its label states; None if it is in that one."""
    if not result.exam.firm or not same_dimension(unit, "m") or unit == "1":
        return None
    stated = math.log10(float(to_si(unit)))
    power = result.exam.units.get("depth", 0.0) - result.power
    if abs(stated - power) <= 1e-9 or abs(stated - round(stated)) >= 1e-9:
        return None
    shown = unit_name("depth", round(power))
    text = f"the label gives {_what(result)} in {unit}, but the number is in {shown}"
    return "unit", shown, text


def _tells_ratio(exam: Examination) -> bool:
    """Whether X/R is more than X in another unit: the radius is no power of ten."""
    radius = exam.inputs.get("radius")
    if radius is None or not 0 < radius.si < math.inf:
        return False
    power = math.log10(radius.si)
    return abs(power - round(power)) > 1e-6


# ---- the report's printed final depth and X/R


@dataclass(frozen=True)
class PrintedCell:
    """A cell with a final depth or X/R of the report; `value` is that in the claim's unit."""

    claim: Claim
    place: Position
    value: float
    met: bool
    typed: bool

    def unmet(self, exam: Examination) -> Departure:
        """Return the difference for a number that is not as printed."""
        claim, rank = self.claim, (3.0, *exam.rank(self.place))
        printed, interval = (
            with_unit(str(text), claim.unit) for text in (claim.shown, claim.interval())
        )
        text = f"the report prints {printed} for {claim.title} ({claim.place}), "
        text += f"which stands for values in {interval}"
        value = exam.table.evaluator.values.get(self.place)
        return Departure("printed number", (self.place,), printed, value, text, rank)


def printed_cells(exams: Sequence[Examination], evaluator: Evaluator) -> Iterator[PrintedCell]:
    """The final depths and X/R of the report's cases that the workbook holds.

    A typed number belongs to the only table, or to that whose beta its label names.
    """
    for exam in exams:
        case = report_case(exam.intended, exam.fitted)
        if case is None:
            continue
        assert exam.intended is not None
        whole = math.isclose(exam.intended.c, report_inputs()["step"][0], rel_tol=1e-6)
        if exam.ends and whole and (depth := exam.final_depth) is not None:
            place = exam.table.place("depth", exam.last)
            yield _judged_number(f"depth-{case}", place, Fraction(depth), False)
        for place, label, unit in _labelled(evaluator):
            beta, number = number_in(label)
            if len(exams) > 1 and beta != "beta":
                continue
            if beta != "beta" or near(number, float(case[-1])):
                yield from _typed_result(exam, case, place, label, unit)


def _typed_result(
    exam: Examination, case: str, place: Position, label: str, unit: str | None
) -> Iterator[PrintedCell]:
    """A typed number as a final depth or X/R of a case, if it may be one."""
    kind, number = result_named(label), exam.table.evaluator.values[place]
    if type(number) is not float or not number:
        return
    value = Fraction(number)
    if kind == "ratio":
        yield _judged_number(f"ratio-{case}", place, value, True)
    elif kind == "depth" and unit and same_dimension(unit, "m"):
        yield _judged_number(f"depth-{case}", place, value * to_si(unit), True)
    elif kind == "depth" and exam.final_depth and value > 0:
        power = 3 * round(math.log10(exam.final_depth / number) / 3)
        yield _judged_number(f"depth-{case}", place, value * Fraction(10) ** power, True)


def _labelled(evaluator: Evaluator) -> Iterator[tuple[Position, str, str | None]]:
    """Typed numbers beside a label of a final depth or X/R, with the label and its unit."""
    for (sheet, row, column), text in list(evaluator.values.items()):
        if not isinstance(text, str) or (sheet, row, column) in evaluator.formulas:
            continue
        if result_named(text) not in ("depth", "ratio"):
            continue
        for down, right in ((0, 1), (1, 0)):
            place = (sheet, row + down, column + right)
            after = evaluator.values.get((sheet, row + 2 * down, column + 2 * right))
            value = evaluator.values.get(place)
            if type(value) is float and type(after) is float:
                break  # a list of numbers is no result
            if type(value) is float and place not in evaluator.formulas:
                label, unit, _ = label_of(place, evaluator)
                if label == text:
                    yield place, text, unit
                break


def _double(value: Fraction) -> float:
    """A number as a double; the largest ones stand for what is beyond them."""
    most = sys.float_info.max
    return float(max(-Fraction(most), min(Fraction(most), value)))


def _judged_number(name: str, place: Position, value: Fraction, typed: bool) -> PrintedCell:
    """Compare a value in SI units with the claim of this name."""
    claim = load().claims[name]
    shown = value / claim.si
    return PrintedCell(claim, place, _double(shown), claim.target().contains(value), typed)
