"""Check a whole workbook against the report's sheet: every table, and what stands beside them."""

import math
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import dropwhile, product
from pathlib import Path

from reference.ledger import Claim, load
from reference.units import same_dimension, to_si
from replication.check.examination import NO_FAULT, Difference, Examination, near
from replication.check.inputs import find, label_of, numbers_beside, read_by, report_inputs
from replication.check.judge import judge
from replication.check.results import has_input, misread
from replication.check.table import LEAST, Line, Result, address, lines, runs, tables
from replication.check.twins import meant
from replication.check.words import (
    COLUMNS,
    INPUTS,
    column_roles,
    count,
    input_roles,
    is_unit,
    number_in,
    share,
)
from replication.reading import place as named
from replication.reading import quoted
from replication.text import with_unit
from spreadsheets.foreign import Position, read
from spreadsheets.recalculation import Area, Calculation, calculate, parse

_STALE = 1e-14
"""Relative deviation above which a stored value is stale: LibreOffice saves 15 digits."""


@dataclass(frozen=True)
class PrintedCell:
    """A cell with a number that the report prints; `found` is its value in the claim's unit."""

    claim: Claim
    place: Position
    found: float
    met: bool

    def unmet(self, exam: Examination) -> Difference:
        """Return the difference for a number that is not as printed."""
        claim, rank = self.claim, (3, *exam.rank(self.place))
        printed, interval = (
            with_unit(str(text), claim.unit) for text in (claim.shown, claim.interval())
        )
        text = f"the report prints {printed} for {claim.title} ({claim.place}), "
        text += f"which stands for values in {interval}"
        value = exam.calculation.number(self.place)
        return Difference("printed number", (self.place,), printed, value, text, rank)


@dataclass(frozen=True)
class Check:
    """The result of `coldspray check` for a workbook."""

    calculation: Calculation
    examinations: tuple[Examination, ...]
    differences: tuple[Difference, ...]
    numbers: tuple[PrintedCell, ...]

    @property
    def faults(self) -> list[Difference]:
        """The differences that make the workbook depart from the report's sheet."""
        return [d for d in self.differences if d.kind not in NO_FAULT]

    @property
    def causes(self) -> list[Difference]:
        """The faults apart from printed numbers that are not met, which follow from others."""
        return [d for d in self.faults if d.kind != "printed number"]

    @property
    def first(self) -> Difference | None:
        """The first fault in order of calculation; one of last digits only if there is no other."""
        faults = self.causes or self.faults
        return min(faults, key=lambda d: (d.kind == "operation order", d.rank), default=None)


def check(path: Path, mapping: Mapping[str, str] | None = None) -> Check:
    """Check somebody's workbook of the scheme.

    `mapping` gives the ranges of columns and inputs that cannot be recognized, by name. Raises
    WorkbookError for a file that cannot be read; ValueError, saying what would help, if there is no
    table of the scheme or if it is not clear what a cell is.
    """
    calculation = calculate(read(path))
    given, cells = _mapped(mapping or {}, calculation)
    with named(str(path)):
        read_tables = tables(calculation, given)
        if not read_tables:
            raise ValueError(_nothing(calculation))
        beside = list(numbers_beside(calculation, read_tables))
        reads = [read_by(table.places, calculation) for table in read_tables]
        examinations = [
            find(table, beside, cells, reads[n], set().union(*reads[:n], *reads[n + 1 :]))
            for n, table in enumerate(read_tables)
        ]
    repeating = meant(examinations, beside)
    for number, exam in enumerate(examinations):
        judge(exam, repeating.get(number))
    misread(examinations)
    sheets = [exam.table.sheet for exam in examinations]
    # Several tables may share the cell of an input or a result.
    every = (number for exam in examinations for number in _printed_cells(exam, sheets))
    numbers = {(number.claim.id, number.place): number for number in every}.values()
    beside_tables = [
        *_stale(calculation, examinations),
        *(number.unmet(examinations[0]) for number in numbers if not number.met),
        *_uncalculated(calculation),
        *_without_numbers(calculation, examinations[0]),
    ]
    # Tables side by side may report the same cell, so only the first of them does. All inputs that
    # no cell holds are placed at the table's first cell; their explanations tell them apart.
    reported: set[tuple[Position, str, str]] = set()
    once: list[Difference] = []
    for group in (*(exam.differences for exam in examinations), beside_tables):
        keys = [(d.place, d.kind, d.explanation if d.kind == "other input" else "") for d in group]
        once += [d for d, key in zip(group, keys, strict=True) if key not in reported]
        reported.update(keys)
    once.reverse()  # among equal ranks, differences beside the tables come first
    ordered = tuple(sorted(once, key=lambda d: d.rank))
    return Check(calculation, tuple(examinations), ordered, tuple(numbers))


# ---- the user's --map, and the message where no table is found

_LINES = ("velocity", *COLUMNS)
"""Names of columns or rows for `--map`; a "velocity" is that at either end of a step."""


def _mapped(
    mapping: Mapping[str, str], calculation: Calculation
) -> tuple[list[Line], dict[str, Position]]:
    """Return the columns (or rows) and the cells that the user named."""
    columns: list[Line] = []
    cells: dict[str, Position] = {}
    for given, where in mapping.items():
        area = _area(given, where, calculation)
        if given in INPUTS and area.cells == 1:
            cells[given] = area.corner
        elif given in _LINES and (area.top == area.bottom or area.left == area.right):
            columns.append(_named_line(given, where, area, calculation))
        else:
            wanted = "one column or one row" if given in _LINES else "one cell"
            raise ValueError(f"--map {given}={where}: give {wanted}")
    return columns, cells


def _named_line(given: str, where: str, area: Area, calculation: Calculation) -> Line:
    """Return the column or row that the user named. Raises ValueError if it cannot be that."""
    across = area.top == area.bottom
    direction = (area.sheet, across)
    alike = (line for line in lines(calculation) if (line.sheet, line.across) == direction)
    blank = next((line.left_out for line in alike), ())  # they all leave out the same
    number = area.top if across else area.left
    line = Line(calculation, area.sheet, across, blank, number, given=given)
    cells = [(at, calculation.number(p)) for p in area.places() if (at := line.index(p))]
    # A whole column includes its heads, which are not meant.
    cells = list(dropwhile(lambda cell: cell[1] is None, cells))
    values = tuple(value for _, value in cells)
    if sum(value is not None for value in values) < LEAST:
        raise ValueError(f"--map {given}={where}: it holds fewer than {LEAST} numbers")
    line = replace(line, first=cells[0][0], values=values).headed()
    wanted = COLUMNS["velocity_initial" if given == "velocity" else given]
    if line.unit and not same_dimension(line.unit, wanted):
        gives = f"the head of these cells gives {line.unit}"
        raise ValueError(f"--map {given}: {gives}, a unit of something else than {wanted}")
    return line


def _area(given: str, where: str, calculation: Calculation) -> Area:
    """Return the range that --map gives. Raises ValueError if there is no single one."""
    book = calculation.book
    if given not in (*_LINES, *INPUTS):
        known = ", ".join(dict.fromkeys([*COLUMNS, *INPUTS]))
        raise ValueError(f"--map {given[:40]!r} is not a known name; choose one of {known}")
    read = (parse(f"={where}", (sheet, 1, 1), book).areas for sheet in book.sheets)
    areas = list(dict.fromkeys(named_areas[0] for named_areas in read if len(named_areas) == 1))
    if len(areas) > 1:  # no sheet is named: the only one with numbers there is meant
        numbers = [place for place, value in calculation.values.items() if isinstance(value, float)]
        areas = [area for area in areas if any(map(area.covers, numbers))] or areas[:1]
    if len(areas) != 1:
        what = "several sheets hold numbers there: " if areas else ""
        known = ", ".join(map(repr, list(book.sheets)[:8]))
        such = "give a range such as Sheet1!D8:D139; the sheets are"
        raise ValueError(f"--map {given}={where[:60]}: {what}{such} {known}")
    rows, _ = book.size[areas[0].sheet]
    return areas[0]._replace(bottom=min(areas[0].bottom, max(rows, areas[0].top)))


def _nothing(calculation: Calculation) -> str:
    """Return the message that there is no table, with the likely reason and what to do."""
    nothing, values = "no table of depth and velocity is found", calculation.values
    texts = (value for value in values.values() if isinstance(value, str))
    typed = sum(any(map(str.isdigit, text)) and not any(map(str.isalpha, text)) for text in texts)
    if typed > max(100, len(calculation.formulas)):
        return f"{nothing}; {typed:,} cells hold numbers as text: convert them to numbers"
    wrong = [place for place in calculation.formulas if calculation.error(place)]
    first = min(wrong, key=calculation.order.__getitem__, default=None)
    spoiling = set(map(calculation.source, calculation.corners(first)))
    instead = sorted(_labelled_texts(calculation) | (spoiling & calculation.spoiling))
    for place in instead:
        nothing += f"; {address(place, True)} holds the text {str(values[place])[:40]!r}"
    uncomputed = sorted(calculation.unknown & calculation.uncomputed.keys())[:1]
    for place in uncomputed:
        nothing += f"; {address(place, True)} is not computed: {calculation.uncomputed[place]}"
    if first:
        errors = f"errors in {count(len(wrong), 'formula')}, {address(first, True)} first"
        return f"{nothing}; {errors}: {calculation.error(first)}"
    if instead:
        return f"{nothing}: type a number there"
    if uncomputed:
        return f"{nothing}: correct it, or save the workbook with a program that computes it"
    such = "--map depth=Sheet1!D8:D139 --map velocity=Sheet1!C8:C139"
    return f"{nothing}: say where they are, such as {such}"


def _labelled_texts(calculation: Calculation) -> set[Position]:
    """Return the typed texts that formulas read and whose labels name an input.

    Formulas may guard themselves against texts and give no error; then only the label tells.
    """
    formulas, values = calculation.formulas, calculation.values
    read = {area.corner for formula in formulas.values() for area in formula.areas}
    return {
        place
        for place in read - formulas.keys()
        if isinstance(text := values.get(place), str) and not is_unit(text)
        if input_roles(*label_of(place, calculation))
    }


def _without_numbers(calculation: Calculation, exam: Examination) -> Iterator[Difference]:
    """Report each sheet where the formulas below the head of a depth give no numbers.

    Report, too, the texts in cells of inputs, one of which such formulas may read; `exam` is any
    table, by which they are ranked.
    """
    silent: dict[str, Difference] = {}
    for (sheet, row, column), text in calculation.values.items():
        if isinstance(text, str) and not is_unit(text) and column_roles(text) == {"depth"}:
            below = ((sheet, row + k, column) for k in range(1, 3 * LEAST))
            cells = [place for place in below if place in calculation.formulas]
            if len(cells) > LEAST and {*map(calculation.number, cells)} == {None}:
                error = calculation.error(cells[0])
                kind, says = "not calculated", f"below {quoted(text)} no formula gives a number"
                if error == "#VALUE!":  # a text stands where a number should be
                    kind, says = "odd formula", f"below {quoted(text)} formulas give {error}"
                says += ": no table is found there"
                difference = Difference(kind, (cells[0],), None, error, says, (8,))
                silent.setdefault(sheet, difference)
    for place in sorted(_labelled_texts(calculation)) if silent else ():
        says = "it is a text, not a number: nothing that reads it can be checked"
        shown = repr(calculation.values[place])
        yield Difference("typed number", (place,), None, shown, says, exam.rank(place))
    yield from silent.values()


# ---- the report's printed numbers

_HEADER = {
    "radius": "a1-radius", "particle_density": "a1-density", "mass": "a1-mass",
    "diameter": "a1-diameter", "velocity": "a1-initial-velocity", "resistance": "a1-resistance",
}  # fmt: skip
_CASES = ("beta-5", "beta-3")
"""The cases as ids of claims name them, in the order of `report_inputs`; Table A-1 is the first."""
_GREATEST = Fraction(sys.float_info.max)


def _printed_cells(exam: Examination, sheets: Sequence[str]) -> Iterator[PrintedCell]:
    """Yield the numbers of the report that a table holds, if it is one of the report's cases.

    `sheets` are those of all tables. Labelled results belong to the only table, or to the only one
    on their sheet.
    """
    report = report_inputs()
    # With other inputs than the report's no number can be as printed.
    impact = load().groups["impact"].keys() & exam.inputs.keys()
    given = [(exam.inputs[role].si, report[role][0]) for role in impact]
    alike = [near(exam.case.resistance, resistance) for resistance in report["resistance"]]
    if not any(alike) or not all(near(*pair) for pair in given):
        return
    case = _CASES[alike.index(True)]
    table_a1 = case == _CASES[0]
    for role, name in _HEADER.items():
        entry = exam.derived.get(role) or exam.inputs.get(role)
        value = exam.calculation.number(entry.place) if entry else None
        if entry and entry.place and value is not None and (table_a1 or role != "resistance"):
            yield _judged(name, entry.place, Fraction(value) * entry.factor)
    printed_rows = range(len(load().time_steps.rows) + 1)  # the impact among them
    for k, (role, column) in product(printed_rows if table_a1 else (), exam.rows.columns.items()):
        name = f"a1-{role.replace('_', '-')}-{k}"
        if name in load().claims and k in column:
            yield _judged(name, exam.table.place(role, k), Fraction(column[k]))
    sheet = exam.table.sheet if sheets.count(exam.table.sheet) == 1 else None
    results = [
        result
        for result in exam.table.results
        if len(sheets) == 1 or (result.place[0] == sheet and _is_own(exam, result))
    ]
    yield from _results(exam, case, results)


def _results(exam: Examination, case: str, results: Sequence[Result]) -> Iterator[PrintedCell]:
    """Yield the final depth, from labelled cells or else from the last row, and the ratios X/R."""
    last, depth = exam.table.place("depth", exam.table.steps), exam.final_depth
    if exam.ends and depth is not None and all(result.kind != "depth" for result in results):
        yield _judged(f"depth-{case}", last, Fraction(depth))
    for kind, place, unit in (result[:3] for result in results if result.where == "first"):
        value = exam.calculation.number(place) or 0.0
        if place in exam.calculation.unknown or (
            not exam.ends and place in exam.calculation.formulas
        ):
            continue  # the formulas do not give the final depth yet, or nothing at all
        if kind == "ratio" and not exam.table.gives_depth(place) and _is_another_ratio(exam, place):
            continue
        if kind == "ratio" or unit:
            yield _judged(f"{kind}-{case}", place, Fraction(value) * to_si(unit or "1"))
        elif depth and value:
            power = 3 * round(math.log10(abs(depth / value)) / 3)  # its unit is not known
            yield _judged(f"depth-{case}", place, Fraction(value) * Fraction(10) ** power)


def _is_own(exam: Examination, result: Result) -> bool:
    """Whether a result on a table's sheet is neither labelled nor computed as another table's."""
    role, number = number_in(str(exam.calculation.values[result.label]))
    of_table = result.place not in exam.calculation.formulas or exam.table.gives_depth(result.place)
    return of_table and (role is None or has_input(exam, role, number))


def _is_another_ratio(exam: Examination, place: Position) -> bool:
    """Whether an X/R that does not follow from the table may be another one of the report."""
    value = Fraction(exam.calculation.number(place) or 0.0)
    numbers = (claim for claim in load().claims.values() if claim.printed and claim.unit == "1")
    printed = (claim.target() for claim in numbers if "X/R" in claim.title)
    return place in exam.calculation.formulas or any(each.contains(value) for each in printed)


def _judged(name: str, place: Position, value: Fraction) -> PrintedCell:
    """Compare a value in SI units with the claim of this name."""
    claim = load().claims[name]
    # In the claim's unit a number may exceed the range of doubles.
    shown = max(-_GREATEST, min(value / claim.si, _GREATEST))
    return PrintedCell(claim, place, float(shown), claim.target().contains(value))


# ---- stored values


def _stale(calculation: Calculation, examinations: Sequence[Examination]) -> Iterator[Difference]:
    """Report stored values that differ from what their formulas give.

    In a column the deviation is compared with the largest number: what is left of 500 m/s at the
    end carries the rounding of 500 m/s, and so does a cell that reads it.
    """
    tables = [exam.table for exam in examinations]
    columns = [line for table in tables for line in table.every_line]

    def is_stale(place: Position) -> bool:
        stored, value = calculation.book[place].value, calculation.values.get(place)
        if place in calculation.uncomputed or stored is None or stored == value:
            return False
        if not (isinstance(stored, float) and isinstance(value, float)):
            return not (calculation.book[place].error and calculation.error(place))
        off = abs(stored - value)
        if off <= max(calculation.book.resolution, _STALE * abs(value)):
            return False
        for line in columns:
            ends = (line.place(at) for at in (line.first + 1, line.last))
            read = any(area.covers(end) for end in ends for area in calculation.areas(place))
            if (read or line.covers(place)) and off <= _STALE * max(map(abs, line.numbers)):
                return False
        return True

    formulas = calculation.formulas.items()
    shapes = {place: formula.shape for place, formula in formulas if is_stale(place)}
    for run in runs(shapes, tables[0].across):
        stored, value = calculation.book[run[0]].value, calculation.values.get(run[0])
        ranks = [exam.rank(run[0]) for exam in examinations]
        rank = next((r for r in ranks if r[0] < 2), ranks[0])  # in the table that it belongs to
        text = "the stored value is not what the formula gives"
        yield Difference("stale value", tuple(run), value, stored, text, rank)


def _uncalculated(calculation: Calculation) -> Iterator[Difference]:
    """Report formulas without a stored value, and those that this program does not compute."""
    reasons: dict[str, list[Position]] = {}
    for place in calculation.formulas:
        if calculation.book[place].value is None:
            reasons.setdefault("no value is stored; they are computed here", []).append(place)
    for place, why in calculation.uncomputed.items():
        stored = calculation.book[place].value is not None
        taken = "their stored values are taken" if stored else "nor is a value stored"
        reason = f"not computed here, {taken}: {why}"
        reasons.setdefault(reason, []).append(place)
    for reason, places in reasons.items():
        formula = calculation.book[places[0]].formula
        text = f"{share(places, calculation.formulas, 'formula')}: {reason}"
        yield Difference("not calculated", tuple(places), None, formula, text, (9,))
