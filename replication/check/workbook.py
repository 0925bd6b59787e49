"""A whole workbook against the report's sheet: every table in it, and what goes beyond tables."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from reference.units import same_dimension
from replication.check.findings import NO_FAULT, Difference, rank
from replication.check.inputs import find, numbers_beside
from replication.check.judge import Verdict, judge
from replication.check.lines import LEAST, Line, address, headed, lines, runs
from replication.check.printed import Held, held, report_inputs
from replication.check.table import tables
from replication.check.words import COLUMNS, INPUTS, count
from replication.text import with_unit
from spreadsheets.foreign import Position, read
from spreadsheets.recalculation import Calculation, calculate
from spreadsheets.references import Area, parse

_STALE = 1e-14
"""Relative distance beyond which a stored value is stale: LibreOffice saves 15 digits."""


@dataclass(frozen=True)
class Check:
    """What `coldspray check` has found out about a workbook."""

    path: Path
    calculation: Calculation
    verdicts: tuple[Verdict, ...]
    differences: tuple[Difference, ...]
    held: tuple[Held, ...]

    @property
    def faults(self) -> list[Difference]:
        """The differences that make the workbook another than the report's sheet."""
        return [d for d in self.differences if d.kind not in NO_FAULT]

    @property
    def causes(self) -> list[Difference]:
        """The faults without printed numbers that are not met, which follow from something."""
        return [d for d in self.faults if d.kind != "printed number"]

    @property
    def first(self) -> Difference | None:
        """The fault from which, in order of calculation, the rest follow."""
        return min(self.causes or self.faults, key=lambda d: d.rank, default=None)

    @property
    def summary(self) -> dict[str, int]:
        """How many differences of each kind."""
        return dict(Counter(d.kind for d in self.differences))


def check(path: Path, mapping: Mapping[str, str] | None = None) -> Check:
    """Check somebody's workbook of the scheme.

    `mapping` gives columns and inputs by name where they are not to be found: name -> range.
    Raises WorkbookError for a file that cannot be read; ValueError where no table of the scheme is
    found, or a cell could be two things, with what would help.
    """
    calculation = calculate(read(path))
    given, cells = _mapped(mapping or {}, calculation)
    report = report_inputs()
    try:
        found = tables(calculation, given)
        if not found:
            raise ValueError(_nothing(calculation))
        beside = list(numbers_beside(calculation, found))
        settings = [find(table, calculation, beside, cells, report) for table in found]
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error
    verdicts = [judge(setting, calculation, report) for setting in settings]
    holds = [
        number
        for v in verdicts
        for number in held(v.setting, calculation, len(verdicts) == 1, v.ends, report)
    ]
    differences = [
        *(d for v in verdicts for d in v.differences),
        *_stale(calculation, verdicts),
        *_unmet(holds, calculation, verdicts[0]),
        *_uncalculated(calculation),
    ]
    # Tables side by side see each other's cells; inputs in no cell share the table's first.
    once = {
        (d.place, d.kind, d.explanation if d.kind == "other input" else ""): d
        for d in reversed(differences)
    }.values()
    ordered = tuple(sorted(once, key=lambda d: d.rank))
    return Check(path, calculation, tuple(verdicts), ordered, tuple(holds))


def _mapped(
    mapping: Mapping[str, str], calculation: Calculation
) -> tuple[list[Line], dict[str, Position]]:
    """The columns and the cells that the user named."""
    columns: list[Line] = []
    cells: dict[str, Position] = {}
    for given, where in mapping.items():
        area = _area(given, where, calculation)
        if given in INPUTS and area.cells == 1:
            cells[given] = area.corner
        elif given in ("velocity", *COLUMNS) and 1 in (
            area.bottom - area.top + 1,
            area.right - area.left + 1,
        ):
            across = area.top == area.bottom
            alike = (line for line in lines(calculation) if line.sheet == area.sheet)
            blank = next((line.left_out for line in alike if line.across == across), ())
            number, first = (area.top, area.left) if across else (area.left, area.top)
            line = Line(area.sheet, number, 1, (), across, given=given, left_out=blank)
            places = [place for place in area.places() if line.index(place) is not None]
            values = tuple(calculation.number(place) for place in places)
            if sum(value is not None for value in values) < LEAST:
                raise ValueError(f"--map {given}={where}: it holds fewer than {LEAST} numbers")
            line = replace(line, first=line.index(places[0]) or first, values=values)
            columns.append(_measuring(headed(line, calculation)))
        else:
            wanted = "one cell" if given in INPUTS else "one column or one row"
            raise ValueError(f"--map {given}={where}: give {wanted}")
    return columns, cells


def _measuring(line: Line) -> Line:
    """The line. Raises ValueError if the unit in its head is that of something else."""
    wanted = COLUMNS["velocity_initial" if line.given == "velocity" else str(line.given)]
    if line.unit and not same_dimension(line.unit, wanted):
        raise ValueError(
            f"--map {line.given}: the head of these cells gives {line.unit}, a unit of something "
            f"else; it should be {wanted} or a multiple of it"
        )
    return line


def _area(given: str, where: str, calculation: Calculation) -> Area:
    """The range that --map gives."""
    book = calculation.book
    sheets = {name.upper(): name for name in book.sheets}
    if given not in ("velocity", *COLUMNS, *INPUTS):
        known = ", ".join(dict.fromkeys([*COLUMNS, *INPUTS]))
        raise ValueError(f"--map {given[:40]!r} is not a known name; choose one of {known}")
    names = {name.upper(): meaning for name, meaning in book.names.items()}
    read = (parse(f"={where}", (sheet, 1, 1), sheets, names).areas for sheet in book.sheets)
    areas = list(dict.fromkeys(found[0] for found in read if len(found) == 1))
    if len(areas) > 1:  # no sheet is named: the one with numbers there is meant
        numbers = [place for place, value in calculation.values.items() if isinstance(value, float)]
        areas = [area for area in areas if any(map(area.covers, numbers))] or areas[:1]
    if len(areas) > 1:
        raise ValueError(
            f"--map {given}={where}: several sheets hold numbers there: name one, such as "
            f"--map {given}={address(areas[0].corner, True)}"
        )
    if not areas:
        known = ", ".join(repr(name) for name in list(sheets.values())[:8])
        raise ValueError(
            f"--map {given}={where[:60]!r}: give a range such as Sheet1!D8:D139; "
            f"the sheets are {known}"
        )
    rows = max((r for r, _ in book.sheets[areas[0].sheet]), default=1)
    return areas[0]._replace(bottom=min(areas[0].bottom, max(rows, areas[0].top)))


def _nothing(calculation: Calculation) -> str:
    """That no table is found, with what there is and what to do."""
    texts = (value for value in calculation.values.values() if isinstance(value, str))
    typed = sum(any(map(str.isdigit, text)) and not any(map(str.isalpha, text)) for text in texts)
    if typed > 100:
        return (
            f"no table of depth and velocity is found; {typed:,} cells hold numbers as text, with "
            "which nothing can be calculated: convert them to numbers"
        )
    wrong = [place for place in calculation.order if calculation.error(place)]
    if wrong:
        return (
            f"no table of depth and velocity is found; {count(len(wrong), 'formula')} give errors, "
            f"{address(wrong[0], True)} first: {calculation.error(wrong[0])}"
        )
    numbers = Counter(p[0] for p, value in calculation.values.items() if isinstance(value, float))
    where = ", ".join(f"{n:,} on {sheet[:40]!r}" for sheet, n in numbers.most_common(3)) or "none"
    return (
        f"no table of depth and velocity is found among its numbers ({where}): say where they are, "
        "such as --map depth=Sheet1!D8:D139 --map velocity=Sheet1!C8:C139"
    )


def _rank(
    place: Position, verdicts: Iterable[Verdict], calculation: Calculation
) -> tuple[float, ...]:
    """When a cell is calculated, by the table that it belongs to."""
    ranks = [rank(place, verdict.setting, calculation) for verdict in verdicts]
    return next((r for r in ranks if r[0] < 2), ranks[0])


def _stale(calculation: Calculation, verdicts: Sequence[Verdict]) -> Iterator[Difference]:
    """Stored values that their formulas do not give.

    In a column the largest number counts: what is left of 500 m/s at the end has its rounding, and
    so has a cell that reads it.
    """
    tables = [verdict.setting.table for verdict in verdicts]
    lines = [line for table in tables for line in (*table.lines.values(), *table.helpers)]

    def is_stale(place: Position) -> bool:
        stored, value = calculation.book[place].value, calculation.values.get(place)
        if place in calculation.uncomputed or stored is None or stored == value:
            return False
        if not (isinstance(stored, float) and isinstance(value, float)):
            return True
        off = abs(stored - value)
        return off > _STALE * abs(value) and not any(
            off <= _STALE * max(abs(number) for number in line.values if number is not None)
            for line in lines
            if line.covers(place)
            or any(
                area.covers(line.place(at))
                for area in calculation.formulas[place].areas
                for at in (line.first + 1, line.last)
            )
        )

    shapes = {place: f.shape for place, f in calculation.formulas.items() if is_stale(place)}
    for run in runs(shapes, tables[0].across):
        more = f", nor are those in {count(len(run) - 1, 'cell')} after it" if len(run) > 1 else ""
        yield Difference(
            run[0], "stale value", _text(calculation.values.get(run[0])),
            _text(calculation.book[run[0]].value),
            f"the stored value is not what the formula gives{more}", tuple(run),
            _rank(run[0], verdicts, calculation),
        )  # fmt: skip


def _text(value: object) -> float | str | None:
    return value if isinstance(value, float | str) or value is None else str(value)


def _unmet(
    holds: Sequence[Held], calculation: Calculation, verdict: Verdict
) -> Iterator[Difference]:
    """Printed numbers that the workbook holds, and holds otherwise."""
    for number in holds:
        if not number.met:
            claim = number.claim
            yield Difference(
                number.place, "printed number", claim.text, number.found,
                f"the report prints {with_unit(claim.shown, claim.unit)}, {claim.title} "
                f"({claim.place}), which stands for values in {claim.interval()}",
                (number.place,), (3, *rank(number.place, verdict.setting, calculation)),
            )  # fmt: skip


def _uncalculated(calculation: Calculation) -> Iterator[Difference]:
    """Formulas without a stored value, and those that are not computed here."""
    reasons: dict[str, list[Position]] = {}
    nothing = "no value is stored for them, as by a program that does not calculate; they are computed here"  # noqa: E501
    reasons[nothing] = [
        place
        for place in calculation.formulas
        if calculation.book[place].value is None and calculation.values.get(place) != ""
    ]
    for place, why in calculation.uncomputed.items():
        reason = f"not computed here, their stored values are taken: {why}"
        reasons.setdefault(reason, []).append(place)
    for reason, places in reasons.items():
        if not places:
            continue
        formulas = f"{len(places):,} of {count(len(calculation.formulas), 'formula')}"
        formula = calculation.book[places[0]].formula
        yield Difference(
            places[0], "not calculated", None, formula, f"{formulas}: {reason}", tuple(places), (9,)
        )
