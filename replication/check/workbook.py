"""Check a whole workbook against the report's sheet: every table, and what stands beside them."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from reference.units import same_dimension
from replication.check.delimited import column_at, read_any
from replication.check.difference import counted
from replication.check.examination import NO_FAULT, AnotherModelError, Departure, Examination
from replication.check.idle import idle_inputs, numbers_apart, typed_beside, unused_formulas
from replication.check.judge import examine
from replication.check.labels import cell_names, label_of
from replication.check.repair import Slipped, Still, moving, slipped, still_cells, with_dollars
from replication.check.results import PrintedCell, judge_results, printed_cells
from replication.check.rows import fit_table
from replication.check.stale import stale
from replication.check.table import (
    LEAST,
    Line,
    SchemeTable,
    cell_name,
    moving_pair,
    runs,
    tables,
)
from replication.check.words import (
    COLUMNS,
    INPUT_UNITS,
    column_roles,
    input_roles,
    is_unit,
    share,
)
from replication.user_input import advice, quoted
from replication.user_input import place as named
from spreadsheets.evaluate import Evaluator, Shape, parse_formula, shape_key
from spreadsheets.foreign import Book, Position, without_zeros
from spreadsheets.scalars import Area, Error

_MOST_TABLES = 40
"""So many tables of one workbook are judged."""
_FEW_READ = 100
"""So many cells behind an error are looked at for a text."""
_MOST_BLANK = 3
"""So many blank cells are named that formulas read."""


@dataclass(frozen=True)
class Checked:
    """The result of `coldspray check` for a workbook.

    `others` says for each table of another model beside those of the report's why it is one.
    """

    evaluator: Evaluator
    examinations: tuple[Examination, ...]
    differences: tuple[Departure, ...]
    numbers: tuple[PrintedCell, ...]
    others: tuple[str, ...] = ()

    @property
    def faults(self) -> list[Departure]:
        """The differences that make the workbook depart from the report's sheet."""
        return [d for d in self.differences if d.kind not in NO_FAULT]

    @property
    def causes(self) -> list[Departure]:
        """The faults apart from printed numbers that are not met, which follow from others."""
        return [d for d in self.faults if d.kind != "printed number"]

    @property
    def first(self) -> Departure | None:
        """The first fault in order of calculation."""
        return min(self.causes or self.faults, key=lambda d: d.rank, default=None)


def check_workbook(path: Path, given: Mapping[str, str] | None = None) -> Checked:
    """Check somebody's workbook of the scheme.

    `given` has the ranges of columns and inputs that cannot be recognized, by name. Raises
    WorkbookError for a file that cannot be read; ValueError, saying what would help, if there is no
    table of the scheme or if all tables follow another model.
    """
    book = read_any(path)
    with named(str(path)):
        return check_book(book, given or {})


def check_book(book: Book, given: Mapping[str, str]) -> Checked:
    """Check a book that was read; see `check`."""
    evaluator, texts = _with_texts_as_numbers(book)
    lost = list(slipped(evaluator))
    if lost:
        book = with_dollars(evaluator.book, lost)
        evaluator, texts = _with_texts_as_numbers(_without_values(book))
    columns, cells = _mapped(given, evaluator)
    candidates = tables(evaluator, columns)[:_MOST_TABLES]
    still = None
    if not candidates and not given:
        evaluator, texts, candidates, still = _set_moving(evaluator, texts)
    if not candidates:
        raise ValueError(_nothing(evaluator))
    names = cell_names(evaluator)
    fits = [fit_table(table) for table in candidates]
    candidates = [table for table, _ in fits]
    idle = numbers_apart(evaluator, fits)
    exams: list[Examination] = []
    others: list[str] = []
    for table, fitted in fits:
        own = idle_inputs(idle, table, names)
        typed = typed_beside(idle, table) + unused_formulas(idle, table)
        try:
            exams.append(examine(table, fitted, names, cells, own, typed))
        except AnotherModelError as error:
            others.append(str(error))
    if not exams:
        raise ValueError(others[0])
    judge_results(exams, evaluator)
    for slip in lost:
        _tell_lost(exams, slip)
    if still is not None:
        _tell_still(exams, still)
    return _collected(evaluator, exams, texts, others)


def _set_moving(
    evaluator: Evaluator, texts: dict[Position, str]
) -> tuple[Evaluator, dict[Position, str], list[SchemeTable], Still | None]:
    """The workbook with a cell filled without which no row moves, its tables, and the cell."""
    for still in still_cells(evaluator):
        book = _without_values(moving(evaluator.book, still))
        trial, again = _with_texts_as_numbers(book)
        if (candidates := tables(trial, {})[:_MOST_TABLES]) and any(
            still.place in table.places for table in candidates
        ):
            return trial, again, candidates, still
    return evaluator, texts, [], None


def _tell_still(exams: Sequence[Examination], still: Still) -> None:
    """Report the cell without which no row moves."""
    for exam in exams:
        if still.place in exam.table.places:
            blank = still.value is None
            kind = "odd formula" if blank else "typed number"
            what = "the cell is blank" if blank else "a zero is typed here"
            text = f"{what}: no row moves; checked as if {still.formula} stood here"
            cells, rank = (still.place,), exam.rank(still.place)
            exam.ends = False  # its depths are those that were meant
            exam.differences.append(Departure(kind, cells, still.formula, still.value, text, rank))
            return


def _without_values(book: Book) -> Book:
    """The book without the stored values of its formulas, which follow from what is mended."""
    return replace(
        book,
        sheets={
            name: {
                at: c._replace(value=None, error=False) if c.formula else c
                for at, c in cells.items()
            }
            for name, cells in book.sheets.items()
        },
    )


def _tell_lost(exams: Sequence[Examination], slip: Slipped) -> None:
    """Report a reference that lacks its $, if a table rests on the cells."""
    for exam in exams:
        lined = set(exam.table.places)
        for line in exam.table.helpers:
            lined |= {line.place(i) for i in line.values}
        if slip.cells[0] in lined or slip.cells[-1] in lined:
            meant = cell_name(slip.meant, slip.meant[0] != slip.cells[0][0])
            text = f"the reference to {meant} lacks its $: it slips away from that cell, row by row"
            expected = slip.formulas[slip.cells[0]]
            exam.add("odd formula", slip.cells, expected, text)
            exam.ends = False  # its depths are those that were meant
            return


def _collected(
    evaluator: Evaluator, exams: Sequence[Examination], texts: Mapping[Position, str],
    others: Sequence[str],
) -> Checked:  # fmt: skip
    numbers = {(n.claim.id, n.place): n for n in printed_cells(exams, evaluator)}.values()
    beside = [
        *_told_texts(evaluator, exams, texts),
        *_stale(evaluator, exams),
        *(
            n.unmet(exams[0])
            for n in numbers
            if not n.met and (n.typed or not _faulty(exams, n.place))
        ),
        *_uncalculated(evaluator),
        *_without_numbers(evaluator),
    ]
    # Tables may share the cell of an input or a result: only the first of them reports it.
    reported: set[tuple[Position, str]] = set()
    once: list[Departure] = []
    for group in (*(exam.differences for exam in exams), beside):
        once += [d for d in group if (d.place, d.kind) not in reported]
        reported.update((d.place, d.kind) for d in group)
    ordered = tuple(sorted(once, key=lambda d: d.rank))
    return Checked(evaluator, tuple(exams), ordered, tuple(numbers), tuple(others))


def _faulty(exams: Sequence[Examination], place: Position) -> bool:
    """Whether the table that a final depth ends has faults, from which it follows."""
    return any(
        d.kind not in NO_FAULT for exam in exams if place in exam.table.places
        for d in exam.differences
    )  # fmt: skip


# ---- evaluation, and numbers stored as texts


def _with_texts_as_numbers(book: Book) -> tuple[Evaluator, dict[Position, str]]:
    """The book evaluated, with the typed texts that formulas take for numbers."""
    evaluator = Evaluator(without_zeros(book))
    read = {
        (a.sheet, a.top, a.left) for p in evaluator.formulas for a in evaluator.areas(p)
        if a.cells == 1
    }  # fmt: skip
    texts = {
        place: value
        for place in read - evaluator.formulas.keys()
        if isinstance(value := evaluator.values.get(place), str) and _numbers_in(value)
    }
    if not texts:
        return evaluator, {}
    taken: dict[Position, float] = {}
    for place, text in sorted(texts.items()):
        trials = []
        for number in _numbers_in(text):
            trial = Evaluator(evaluator.book, {**taken, place: number})
            off = sum(1 for p in trial.formulas if not _near_stored(trial, p))
            trials.append((off + len(trial.reasons), number))
        taken[place] = min(trials)[1]
    return Evaluator(evaluator.book, taken), texts


def _near_stored(evaluator: Evaluator, place: Position) -> bool:
    stored, value = evaluator.book[place].value, evaluator.values.get(place)
    if type(stored) is float and type(value) is float:
        return abs(stored - value) <= 1e-9 * abs(value)
    return True


_SPACES = re.compile(r"(?<=\d)[ \u00a0\u202f](?=\d{3})")


def _numbers_in(text: str) -> list[float]:
    """The numbers that a text may stand for, with a decimal comma or marks of thousands.

    >>> _numbers_in("7 850"), _numbers_in("1,1E-5"), _numbers_in("8,900"), _numbers_in("R")
    ([7850.0], [1.1e-05], [8900.0, 8.9], [])
    """
    plain = _SPACES.sub("", text.strip())
    number = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[Ee][-+]?\d{1,3})?")
    candidates = [plain] if "," not in plain else []
    if re.fullmatch(r"[-+]?\d{1,3}(,\d{3})+(\.\d+)?", plain):
        candidates.append(plain.replace(",", ""))
    if plain.count(",") == 1 and "." not in plain:
        candidates.append(plain.replace(",", "."))
    return [float(each) for each in candidates if number.fullmatch(each)]


def _told_texts(
    evaluator: Evaluator, exams: Sequence[Examination], texts: Mapping[Position, str]
) -> Iterator[Departure]:
    """Report numbers that are stored as texts in cells that the tables read."""
    read = set().union(*(exam.read for exam in exams), *(exam.table.places for exam in exams))
    for place, text in sorted(texts.items()):
        if place in read or any(e.place == place for exam in exams for e in exam.inputs.values()):
            says = "a number stored as text: not every program calculates with it"
            value = evaluator.values.get(place)
            yield Departure("typed number", (place,), value, repr(text), says, exams[0].rank(place))


# ---- the user's --map, and the message where no table is found

_LINES = ("velocity", *COLUMNS)
"""Names of columns or rows for `--map`; a "velocity" is that at either end of a step."""


def _mapped(
    mapping: Mapping[str, str], evaluator: Evaluator
) -> tuple[dict[str, Line], dict[str, Position]]:
    """Return the columns (or rows) and the cells that the user named."""
    columns: dict[str, Line] = {}
    cells: dict[str, Position] = {}
    for name, where in mapping.items():
        area = _area(name, where, evaluator)
        if name in INPUT_UNITS and area.cells == 1 and name not in columns:
            cells[name] = (area.sheet, area.top, area.left)
            if type(evaluator.values.get(cells[name])) is not float:
                raise ValueError(
                    f"--map {name}: the cell {cell_name(cells[name], True)} holds no number"
                )
        elif name in _LINES and (area.top == area.bottom or area.left == area.right):
            columns[name] = _named_line(name, where, area, evaluator)
        else:
            wanted = "one column or one row" if name in _LINES else "one cell"
            raise ValueError(f"--map {name}={where}: give {wanted}")
    return columns, cells


def _named_line(name: str, where: str, area: Area, evaluator: Evaluator) -> Line:
    """Return the column or row that the user named. Raises ValueError if it cannot be that."""
    across = area.top == area.bottom and area.left != area.right
    number = area.top if across else area.left
    values = {
        (p[2] if across else p[1]): value
        for p in evaluator.used(area).places()
        if type(value := evaluator.values.get(p)) is float
    }
    if len(values) < LEAST:
        raise ValueError(f"--map {name}={where}: it holds fewer than {LEAST} numbers")
    line = Line(evaluator, area.sheet, across, number, values, name)
    wanted = COLUMNS["velocity_initial" if name == "velocity" else name]
    if line.unit and not same_dimension(line.unit, wanted):
        gives = f"the head of these cells gives {line.unit}"
        raise ValueError(f"--map {name}: {gives}, a unit of something else than {wanted}")
    return line


def _area(name: str, where: str, evaluator: Evaluator) -> Area:
    """Return the range that --map gives. Raises ValueError if there is no single one."""
    book = evaluator.book
    if name not in (*_LINES, *INPUT_UNITS):
        meant = advice(name, dict.fromkeys([*COLUMNS, *INPUT_UNITS]))
        raise ValueError(f"--map {name[:40]!r} is not a known name; {meant}")
    areas: list[Area] = []
    for sheet in book.sheets:
        shape = parse_formula(f"={where}", sheet, book, shape_key(f"={where}", 1, 1))
        if len(shape.references) == 1 and not shape.literals:
            area = shape.references[0]._replace(crossing=False).at(1, 1)
            if area not in areas:
                areas.append(area)
    if len(areas) > 1:  # no sheet is named: the only one with numbers there is meant
        numbers = [p for p, value in evaluator.values.items() if type(value) is float]
        areas = [area for area in areas if any(map(area.covers, numbers))] or areas[:1]
    if len(areas) != 1:
        what = "several sheets hold numbers there: " if areas else ""
        known = ", ".join(map(repr, list(book.sheets)[:8]))
        such = "give a range such as Sheet1!D8:D139; the sheets are"
        raise ValueError(f"--map {name}={where[:60]}: {what}{such} {known}")
    return areas[0]


def _nothing(evaluator: Evaluator) -> str:
    """Return the message that there is no table, with the likely reason and what to do."""
    nothing, values = "no table of depth and velocity is found", evaluator.values
    if evaluator.book.is_text:
        if pair := moving_pair(evaluator):
            depth, speed = (column_at(evaluator.book, line.number) for line in pair)
            return (
                f"{depth} is found to be a depth and {speed} its velocity, but the rows follow "
                "another method than the report's sheet, in which the depth grows from row to row "
                "by the velocity times the step"
            )
        such = "heads such as time [ns], velocity [m/s], depth [um]"
        return f"{nothing}: give columns of these in steps of a constant time, with {such}"
    texts = [value for value in values.values() if type(value) is str]
    typed = sum(any(map(str.isdigit, t)) and not any(map(str.isalpha, t)) for t in texts)
    if typed > max(100, len(evaluator.formulas)):
        return f"{nothing}; {typed:,} cells hold numbers as text: convert them to numbers"
    wrong = [
        p for p in evaluator.formulas if isinstance(values.get(p), Error) and values[p] != "#N/A"
    ]
    first = min(wrong, key=lambda p: evaluator.order.get(p, 0), default=None)
    instead = sorted(_labelled_texts(evaluator) | _spoiling(evaluator, first))
    for place in instead:
        nothing += f"; {cell_name(place, True)} holds the text {str(values[place])[:40]!r}"
    for place in _labelled_blanks(evaluator):
        nothing += f"; {cell_name(place, True)} is blank, though formulas read it"
    for place in sorted(evaluator.unknown)[:1]:
        nothing += f"; {cell_name(place, True)} is not computed: {evaluator.reasons[place]}"
    if first:
        errors = f"errors in {counted(len(wrong), 'formula')}, {cell_name(first, True)} first"
        return f"{nothing}; {errors}: {values[first]}"
    if instead:
        return f"{nothing}: type a number there"
    if evaluator.unknown:
        return f"{nothing}: correct it, or save the workbook with a program that computes it"
    such = "--map depth=Sheet1!D8:D139 --map velocity=Sheet1!C8:C139"
    return f"{nothing}: if there is one, say where, as with {such}"


def _spoiling(evaluator: Evaluator, first: Position | None) -> set[Position]:
    """Return the typed texts that make the first formula with an error give it."""
    read = list(evaluator.precedents(first)) if first else []
    typed = set[Position]()
    for place in read:  # which grows by what formulas that repeat a text read
        if type(evaluator.values.get(place)) is str:
            if place not in evaluator.formulas:
                typed.add(place)
            elif len(read) < _FEW_READ:
                read += evaluator.precedents(place)
    return typed


def _labelled_texts(evaluator: Evaluator) -> set[Position]:
    """Return the typed texts that formulas read and whose labels name an input."""
    read = {
        (a.sheet, a.top, a.left) for p in evaluator.formulas for a in evaluator.areas(p)
        if a.cells == 1
    }  # fmt: skip
    places = set()
    for place in read - evaluator.formulas.keys():
        text = evaluator.values.get(place)
        if type(text) is str and not is_unit(text):
            label, unit, _ = label_of(place, evaluator)
            if label and label != text and input_roles(label, unit):
                places.add(place)
    return places


def _texts_for_numbers(evaluator: Evaluator) -> set[Position]:
    """Return the typed texts that give a formula an error, where its like read numbers."""
    alike: dict[Shape, list[Position]] = {}
    for place, shape in evaluator.formulas.items():
        alike.setdefault(shape, []).append(place)
    values, typed = evaluator.values, set[Position]()
    for shape, cells in alike.items():
        good = [place for place in cells if type(values.get(place)) is float]
        wrong = [place for place in cells if isinstance(values.get(place), Error)]
        for ref in shape.references if good and wrong else ():
            read = [ref.at(*place[1:]).corner for place in good]
            if all(type(values.get(cell)) is float for cell in read):
                texts = (ref.at(*place[1:]).corner for place in wrong)
                typed |= {cell for cell in texts if type(values.get(cell)) is str}
    return typed - evaluator.formulas.keys()


def _labelled_blanks(evaluator: Evaluator) -> list[Position]:
    """Return the blank cells that formulas read and whose labels name an input."""
    read = {
        (a.sheet, a.top, a.left) for p in evaluator.formulas for a in evaluator.areas(p)
        if a.cells == 1
    }  # fmt: skip
    blank = []
    for place in sorted(read - evaluator.formulas.keys()):
        if evaluator.values.get(place) is None:
            label, unit, _ = label_of(place, evaluator)
            if label and input_roles(label, unit):
                blank.append(place)
    return blank[:_MOST_BLANK]


def _without_numbers(evaluator: Evaluator) -> Iterator[Departure]:
    """Report each sheet where the formulas below the head of a depth give no numbers.

    Report, too, the texts in cells of inputs, one of which such formulas may read.
    """
    silent: dict[str, Departure] = {}
    for (sheet, row, column), text in evaluator.values.items():
        if type(text) is str and not is_unit(text) and column_roles(text) == {"depth"}:
            below = [(sheet, row + k, column) for k in range(1, 3 * LEAST)]
            cells = [place for place in below if place in evaluator.formulas]
            numbers = [place for place in cells if type(evaluator.values.get(place)) is float]
            if len(cells) > LEAST and not numbers:
                value = evaluator.values.get(cells[0])
                kind, says = "not calculated", f"below {quoted(text)} no formula gives a number"
                if value == "#VALUE!":  # a text stands where a number should be
                    kind, says = "odd formula", f"below {quoted(text)} formulas give {value}"
                says += ": no table is found there"
                content = str(value) if isinstance(value, Error) else None
                silent.setdefault(sheet, Departure(kind, (cells[0],), None, content, says, (8.0,)))
    for place in (
        sorted(_labelled_texts(evaluator) | _texts_for_numbers(evaluator)) if silent else ()
    ):
        says = "it is a text, not a number: nothing that reads it can be checked"
        shown = repr(evaluator.values[place])
        # It comes before all faults of what reads it.
        yield Departure("typed number", (place,), None, shown, says, (-1.0,))
    yield from silent.values()


# ---- stored values


def _stale(evaluator: Evaluator, exams: Sequence[Examination]) -> Iterator[Departure]:
    """Report stored values that differ from what their formulas give."""
    columns = [line for exam in exams for line in exam.table.lines.values()]
    largest = {
        line.place(i): max(map(abs, line.values.values())) for line in columns for i in line.values
    }
    shapes: dict[Position, object] = {
        place: evaluator.formulas[place]
        for place in stale(evaluator)
        if not _is_rounding(evaluator, place, largest.get(place, 0.0))
    }
    for run in runs(shapes, exams[0].table.across):
        stored, value = evaluator.book[run[0]].value, evaluator.values.get(run[0])
        ranks = [exam.rank(run[0]) for exam in exams]
        rank = next((r for r in ranks if r[0] < 2), ranks[0])  # in the table that it belongs to
        stored, value = (str(x) if isinstance(x, Error) else x for x in (stored, value))
        text = "the stored value is not what the formula gives"
        yield Departure("stale value", tuple(run), value, stored, text, rank)


def _is_rounding(evaluator: Evaluator, place: Position, largest: float) -> bool:
    """Whether a stored value is off by the rounding of the largest number of its column.

    What is left of 500 m/s at the end of a column carries the rounding of 500 m/s.
    """
    stored, value = evaluator.book[place].value, evaluator.values.get(place)
    if type(stored) is not float or type(value) is not float:
        return False
    return abs(stored - value) <= 1e-14 * largest


def _uncalculated(evaluator: Evaluator) -> Iterator[Departure]:
    """Report formulas without a stored value, and those that this program does not compute."""
    reasons: dict[str, list[Position]] = {}
    for place in evaluator.formulas:
        if evaluator.book[place].value is None:
            why = "no value is stored to compare with; they are computed here"
            reasons.setdefault(why, []).append(place)
    for place, why in evaluator.reasons.items():
        stored = evaluator.book[place].value is not None
        taken = "their stored values are taken" if stored else "nor is a value stored"
        reasons.setdefault(f"not computed here, {taken}: {why}", []).append(place)
    for reason, places in reasons.items():
        formula = evaluator.book[places[0]].formula
        text = f"{share(places, evaluator.formulas, 'formula')}: {reason}"
        yield Departure("not calculated", tuple(places), None, formula, text, (9.0,))
