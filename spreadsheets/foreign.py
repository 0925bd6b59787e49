"""Read the cells of somebody else's workbook: formulas and stored values, within bounds.

Every file is treated as hostile. It is read as a stream (`package.py` unpacks and parses it), what
it holds is counted before it is kept, and nothing in it is run, looked up or followed. openpyxl
does not read it: openpyxl fills merged and linked ranges cell by cell, so that a file of a kilobyte
keeps it busy for hours, and it gives either formulas or stored values, not both.
"""

import math
import re
import zipfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime
from functools import cached_property
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple
from xml.etree import ElementTree as ET

from openpyxl.formula.tokenizer import TokenizerError
from openpyxl.formula.translate import Translator, TranslatorError
from openpyxl.utils.cell import (
    column_index_from_string,
    coordinate_to_tuple,
    get_column_letter,
    range_boundaries,
)

from spreadsheets.conversion import FORMATS, converted
from spreadsheets.engines import address, in_quotes
from spreadsheets.package import (
    Package,
    attribute,
    damaged,
    name_of,
    open_archive,
    too_much,
)
from spreadsheets.package import WorkbookError as WorkbookError  # for those who call `read`
from spreadsheets.safely import UNREADABLE

Position = tuple[str, int, int]
"""Sheet, row and column, both counted from 1."""

Value = float | str | bool

MAX_FILE = 64 * 2**20
"""Bytes of a file."""
MAX_CELLS = 250_000
MAX_FORMULAS = 60_000
"""A sheet of the scheme has some 800 cells; with a step of 1 ps it has 160,000."""
MAX_FORMULA_TEXT = 4_000_000
"""Characters of all formulas together: a formula of the scheme has some forty."""
LAST_ROW, LAST_COLUMN = 1_048_576, 16_384
MAX_TEXT = 32_767
"""Characters that a cell may have in Excel."""
MAX_FORMULA = 8_192
"""Characters that a formula may have in Excel."""
_MAX_NUMBER = 1_000
"""Characters of a number: written out, the largest double has 309 digits."""
_ODS_RESOLUTION = 1e-20
"""LibreOffice writes numbers below 1e-4 with 20 decimals: a mass in kg has some ten digits."""
_OLE_START = bytes.fromhex("D0CF11E0A1B11AE1")
"""How .xls files begin, and encrypted workbooks of every kind."""
_EPOCHS = {False: datetime(1899, 12, 30), True: datetime(1904, 1, 1)}
"""Day 0 of dates as numbers; the first is right from March 1900 on, as Excel counts."""

_FEW = 3
"""So few formulas may store 0 because they are calculated, or are stale; more were never."""

_LIMITS = f"this program reads up to {MAX_CELLS:,} cells and {MAX_FORMULAS:,} formulas"
_WANTED = "give an .xlsx or .xlsm file without a password"


class StoredCell(NamedTuple):
    """The formula of a cell, with its "=", and its stored value; either is None if absent.

    `error`: the value is an error, not a text that spells one. `array`: the first row and column
    and the last ones of the cells that an array formula, or a what-if table, fills together; the
    formula of a what-if table is =TABLE(row input, column input), as Excel shows it.
    """

    formula: str | None
    value: Value | None
    error: bool = False
    array: tuple[int, int, int, int] | None = None


@dataclass(frozen=True)
class Book:
    """A workbook: its worksheets in order, each with its cells by (row, column); and its names.

    `columns` maps the columns of tables, written as in formulas, such as "Steps[x]", to their
    cells. `notes` tell the user what is left out. Stored numbers are exact to within `resolution`.
    `hidden` has the hidden rows of each sheet. `date1904`: day 0 of its dates is 1 January 1904.
    `as_displayed`: its numbers are rounded as they are shown. Of a text file `heads` has the head
    of each column, `top` is the line of the highest one, and `digits` has how each number is
    printed: its number of digits, and the power of ten of the last one.
    """

    path: Path
    sheets: Mapping[str, Mapping[tuple[int, int], StoredCell]]
    names: Mapping[str, str]
    notes: tuple[str, ...] = ()
    resolution: float = 0.0
    columns: Mapping[str, str] = field(default_factory=dict)
    hidden: Mapping[str, frozenset[int]] = field(default_factory=dict)
    date1904: bool = False
    as_displayed: bool = False
    digits: Mapping[str, Mapping[tuple[int, int], tuple[int, int]]] = field(default_factory=dict)
    heads: Mapping[int, str] | None = None
    top: int = 0

    @property
    def is_text(self) -> bool:
        """Whether it was read from a text file, in which cells have lines and columns."""
        return self.heads is not None

    def __getitem__(self, position: Position) -> StoredCell:
        sheet, row, column = position
        return self.sheets[sheet].get((row, column), _BLANK)

    @cached_property
    def called(self) -> dict[str, str]:
        """Each name of a sheet by the same in capitals: formulas may write it either way."""
        return {name.upper(): name for name in self.sheets}

    @cached_property
    def meanings(self) -> dict[str, str]:
        """What defined names and columns of tables stand for, by their names in capitals."""
        return {name.upper(): cells for name, cells in {**self.columns, **self.names}.items()}

    @cached_property
    def size(self) -> dict[str, tuple[int, int]]:
        """The last row and the last column that each sheet uses."""
        return {
            name: (max((r for r, _ in cells), default=0), max((c for _, c in cells), default=0))
            for name, cells in self.sheets.items()
        }

    def cells(self) -> Iterator[tuple[Position, StoredCell]]:
        """Every cell that is not blank."""
        for sheet, cells in self.sheets.items():
            for (row, column), cell in cells.items():
                yield (sheet, row, column), cell


_BLANK = StoredCell(None, None)


def without_zeros(book: Book) -> Book:
    """The book without stored values, if its program stored 0 for every formula; else unchanged."""
    stored = [cell.value for _, cell in book.cells() if cell.formula is not None]
    if len(stored) <= _FEW or any(type(value) is not float or value != 0 for value in stored):
        return book
    note = "every formula stores 0, as some programs write it: none is calculated"
    sheets = {
        sheet: {at: c._replace(value=None) if c.formula else c for at, c in cells.items()}
        for sheet, cells in book.sheets.items()
    }
    return replace(book, sheets=sheets, notes=(*book.notes, note))


def read(path: Path) -> Book:
    """Read an .xlsx or .xlsm file; an .xls, .xlsb or .ods file by way of LibreOffice; or a .csv.

    Raises WorkbookError, naming the file, if it is not a workbook, is damaged, or exceeds a limit
    of this module; OSError if it cannot be opened.
    """
    try:
        return _read_book(path)
    except WorkbookError as error:
        raise WorkbookError(f"{path}: {error}") from error


def _read_book(path: Path) -> Book:
    if not path.is_file():
        kind = "this is a folder" if path.is_dir() else "this is not a regular file"
        if not path.exists():
            kind = "this link leads nowhere" if path.is_symlink() else "there is no such file"
        raise WorkbookError(kind)
    if path.stat().st_size > MAX_FILE:
        raise WorkbookError(f"has more than {MAX_FILE >> 20} MB; {_LIMITS}")
    if _is_xlsx(path):
        with open_archive(path) as archive:
            return _BookReader(Package(archive), path).book()
    if path.suffix.lower() not in FORMATS:
        with path.open("rb") as file:
            start = file.read(len(_OLE_START))
        fault = "this is not a workbook"
        if start == _OLE_START:
            fault = "has a password, or is an .xls file by another name"
        elif start.startswith(b"PK") and not zipfile.is_zipfile(path):
            raise damaged("its end is cut off or changed")
        raise WorkbookError(f"{fault}; {_WANTED}")
    with (
        TemporaryDirectory(prefix="coldspray-") as folder,
        open_archive(converted(path, Path(folder), MAX_CELLS)) as archive,
    ):
        book = _BookReader(Package(archive), path).book()
    note = f"{path.suffix} file read by way of LibreOffice, which may have recalculated it"
    resolution = _ODS_RESOLUTION if path.suffix.lower() == ".ods" else 0.0
    return replace(book, notes=(note, *book.notes), resolution=resolution)


def _is_xlsx(path: Path) -> bool:
    try:
        with open_archive(path) as archive:
            return any(name.lower().endswith("workbook.xml") for name in archive.namelist())
    except WorkbookError:
        raise
    except UNREADABLE:
        return False


_Tables = list[tuple[str, dict[str, int]]]
"""The tables of a sheet: the name of each in small letters, and its columns by their heads."""

_THIS_ROW = re.compile(
    r"(?:(?<![\w.])(?P<table>[^\W\d][\w.]*+))?"
    r"\[(?:\[#This Row\],\s*\[(?P<long>(?:[^\[\]']|'.)++)\]"
    r"|@\[?(?P<short>(?:[^\[\]']|'.)++)\]?)\]"
)
"""How a formula refers to a cell in its own row of a table: Steps[@x], [[#This Row],[x]]."""

_ESCAPED = re.compile("_x([0-9A-Fa-f]{4})_")
"""How a text of the file holds a character that XML does not allow, or changes: a line break."""

_NOTES = {
    "vbaproject.bin": "it holds macros: they are not run",
    "/externallinks/": "it has links to other files: they are not followed",
}


class _BookReader:
    """Read the parts of one file, within one budget of cells and formulas."""

    def __init__(self, package: Package, path: Path) -> None:
        self.package, self.path = package, path
        self.cells = self.formulas = self.characters = self.filled = 0
        self.columns: dict[str, str] = {}
        self.date1904 = False

    def book(self) -> Book:
        """Read the whole workbook."""
        package = self.package
        mains = (to for kind, to in package.relations("").values() if kind == "officeDocument")
        main = next(mains, "xl/workbook.xml")
        tree, related = package.tree(main), package.relations(main)
        notes = [note for part, note in _NOTES.items() if any(part in p for p in package.parts)]
        self.date1904 = _is_set(tree.find("{*}workbookPr"), "date1904")
        as_displayed = not _is_set(tree.find("{*}calcPr"), "fullPrecision", "1")
        if as_displayed:
            notes.append("precision as displayed is set: its numbers are rounded as they are shown")
        strings = next((to for kind, to in related.values() if kind == "sharedStrings"), None)
        texts: list[str] = []
        if strings is not None:
            package.stream(strings, si=lambda string: texts.append(_string_text(string)))
        sheets: dict[str, dict[tuple[int, int], StoredCell]] = {}
        hidden: dict[str, frozenset[int]] = {}
        listed = tree.findall("{*}sheets/{*}sheet")
        names = [attribute(sheet, "name", main) for sheet in listed]
        if len({name.upper() for name in names}) < len(names):
            raise damaged("two of its sheets have the same name")
        for element, name in zip(listed, names, strict=True):
            identity = (value for key, value in element.attrib.items() if key.endswith("}id"))
            kind, part = related.get(next(identity, ""), ("", ""))
            if not part:
                raise damaged(f"its sheet {name!r} has no part of the file")
            if kind == "worksheet":
                sheet = _Sheet(self, name, texts, self.tables(name, part))
                package.stream(part, row=sheet.take_row)
                sheets[name], hidden[name] = sheet.complete(), frozenset(sheet.hidden)
        if not sheets:
            raise WorkbookError("has no worksheet")
        meanings = _defined_names(tree, names, main)
        return Book(
            self.path, sheets, meanings, tuple(notes), columns=self.columns, hidden=hidden,
            date1904=self.date1904, as_displayed=as_displayed,
        )  # fmt: skip

    def tables(self, sheet: str, sheet_part: str) -> _Tables:
        """Read the tables of a sheet."""
        tables = []
        for kind, part in self.package.relations(sheet_part).values():
            if kind != "table" or part not in self.package:
                continue
            tree = self.package.tree(part)
            name, ref = (attribute(tree, key, part) for key in ("displayName", "ref"))
            left, top, _, bottom = _corners(ref, f"the table {name!r}")
            heads, totals = (
                _index_number(tree.get(key, default), f"{key} of {name!r}")
                for key, default in (("headerRowCount", "1"), ("totalsRowCount", "0"))
            )
            columns = {
                _unescaped(attribute(column, "name", part)): number
                for number, column in enumerate(tree.iterfind("{*}tableColumns/*"), left)
            }
            if max(columns.values(), default=1) > LAST_COLUMN:
                raise damaged(f"the table {name[:60]!r} is wider than a sheet")
            tables.append((name.lower(), columns))
            for head, number in columns.items():
                escaped, letter = re.sub(r"[\[\]#'@]", r"'\g<0>", head), get_column_letter(number)
                cells = f"{in_quotes(sheet)}!${letter}${top + heads}:${letter}${bottom - totals}"
                self.columns[f"{name}[{escaped}]"] = cells
        return tables


def _defined_names(tree: ET.Element, sheets: list[str], part: str) -> dict[str, str]:
    """The defined names, with what each stands for; one of a single sheet is 'Sheet'!name."""
    meanings: dict[str, str] = {}
    for entry in tree.iterfind("{*}definedNames/{*}definedName"):
        name, scope = attribute(entry, "name", part), entry.get("localSheetId")
        if entry.text and not name.startswith("_xlnm."):
            if scope is not None:
                number = _index_number(scope, f"the sheet of the name {name!r}", len(sheets))
                name = f"'{sheets[number]}'!{name}"
            meanings[name] = entry.text[:MAX_FORMULA]
    return meanings


def _is_set(element: ET.Element | None, key: str, default: str = "0") -> bool:
    """Whether an attribute of an element is true; `default` holds where it is absent."""
    text = default if element is None else element.get(key, default)
    return text.strip().lower() in ("1", "true", "on")


def _index_number(text: str, what: str, below: int = LAST_ROW + 1) -> int:
    """Read a whole number from 0 to less than `below`; `what` says what it is, for the message."""
    if not (re.fullmatch(r"\s*\d{1,9}\s*", text) and int(text) < below):
        raise damaged(f"{what} is {text[:20]!r} and must be a whole number below {below}")
    return int(text)


def _corners(cells: str, what: str) -> tuple[int, ...]:
    """The first column and row, and the last ones, of the range in which `what` stands."""
    try:
        return tuple(end or 1 for end in range_boundaries(cells[:40]))
    except ValueError as error:
        raise damaged(f"{what} stands in {cells[:20]!r}, which is no range of cells") from error


def _string_text(string: ET.Element) -> str:
    """The text of a string in one or several pieces, without phonetic guides."""
    pieces = (piece for part in string if name_of(part) != "rPh" for piece in part.iter())
    return _unescaped("".join(piece.text or "" for piece in pieces if name_of(piece) == "t"))


def _unescaped(text: str) -> str:
    r"""A text of the file, up to the length that Excel allows, with the characters it stands for.

    >>> _unescaped("v_x000A_[m/s]"), _unescaped("_x005F_x000A_"), _unescaped("_xD800_")
    ('v\n[m/s]', '_x000A_', '_xD800_')
    """

    def character(escape: re.Match[str]) -> str:
        code = int(escape[1], 16)
        return escape[0] if 0xD800 <= code <= 0xDFFF else chr(code)  # half a character

    return _ESCAPED.sub(character, text)[:MAX_TEXT] if "_x" in text else text[:MAX_TEXT]


class _Translator(Translator):
    """Fill a formula into other cells; openpyxl's own takes a name such as Yld1 for a cell."""

    @classmethod
    def translate_range(cls, range_str: str, rdelta: int, cdelta: int) -> str:
        _, cell = cls.strip_ws_name(range_str)  # type: ignore[no-untyped-call]
        match = cls.CELL_REF_RE.match(cell)
        if match and column_index_from_string(match[1].lstrip("$")) > LAST_COLUMN:
            return range_str
        moved = super().translate_range(range_str, rdelta, cdelta)  # type: ignore[no-untyped-call]
        return str(moved)


class _Sheet:
    """Collect the cells of a worksheet, row by row."""

    def __init__(self, reader: _BookReader, name: str, texts: list[str], tables: _Tables) -> None:
        self.reader, self.name, self.texts, self.tables = reader, name, texts, tables
        self.cells: dict[tuple[int, int], StoredCell] = {}
        self.hidden: set[int] = set()
        self.masters: dict[str, tuple[str, str]] = {}
        self.translators: dict[str, _Translator] = {}
        self.waiting: dict[str, list[tuple[int, int]]] = {}
        self.arrays: list[tuple[tuple[int, ...], str]] = []
        self.row = self.column = 0

    @property
    def address(self) -> str:
        """The address of the cell that is being read."""
        return address(self.row, self.column)

    def take_row(self, row: ET.Element) -> None:
        """Read the cells of a row."""
        number = row.get("r", str(self.row + 1))
        self.row, self.column = _index_number(number, f"the number of a row of {self.name!r}"), 0
        if _is_set(row, "hidden"):
            self.hidden.add(self.row)
        for cell in row:
            self.column += 1
            if given := cell.get("r", "")[:20]:
                try:
                    self.row, self.column = coordinate_to_tuple(given)
                except ValueError:
                    self.column = 0
            if not (0 < self.row <= LAST_ROW and 0 < self.column <= LAST_COLUMN):
                raise damaged(f"no cell of {self.name!r} can be at {given!r}")
            self.take_cell(cell)

    def take_cell(self, cell: ET.Element) -> None:
        """Read one cell."""
        kind, parts = cell.get("t", "n"), {name_of(part): part for part in cell}
        element = parts.get("f")
        formula = None if element is None else self.formula(element)
        value = self.value(kind, parts)
        if formula is None and value is None:
            return
        self.reader.cells += 1
        self.reader.formulas += formula is not None
        if self.reader.cells > MAX_CELLS or self.reader.formulas > MAX_FORMULAS:
            raise too_much(f"it has too many cells; {_LIMITS}")
        self.cells[self.row, self.column] = StoredCell(formula, value, kind == "e")

    def formula(self, element: ET.Element) -> str | None:
        """The formula of a cell; one that it shares with another is filled into this cell."""
        text = (element.text or "").strip().removeprefix("=").lstrip()[: MAX_FORMULA + 1]
        kind, index = element.get("t"), element.get("si", "")
        if kind == "shared" and text:
            self.masters[index] = f"={text}", self.address
            self.translators.pop(index, None)
        elif kind == "shared" and index in self.masters:
            text = self.shared(index).removeprefix("=")
        elif kind == "shared":  # the cell that has the formula may come later
            self.waiting.setdefault(index, []).append((self.row, self.column))
            return "="
        elif kind == "dataTable":
            inputs = [element.get(key, "")[:20] for key in ("r1", "r2")]
            if not _is_set(element, "dt2D"):
                inputs = [inputs[0], ""] if _is_set(element, "dtr") else ["", inputs[0]]
            text = f"TABLE({','.join(inputs)})"
        if not text:
            return None
        formula = self.counted(f"={text}")
        if kind in ("array", "dataTable"):
            cells, what = element.get("ref", self.address), f"an array formula of {self.name!r}"
            self.arrays.append((_corners(cells, what), formula))
        return formula

    def counted(self, formula: str) -> str:
        """A formula in the cell that is being read, with its cells of tables as addresses."""
        if self.tables and "[" in formula:
            formula = _THIS_ROW.sub(self.in_this_row, formula)
        self.reader.characters += len(formula)
        if self.reader.characters > MAX_FORMULA_TEXT:
            raise too_much(f"its formulas have more than {MAX_FORMULA_TEXT:,} characters")
        return formula

    def shared(self, index: str) -> str:
        """A shared formula, filled into the cell that is being read."""
        master, origin = self.masters[index]
        try:
            if index not in self.translators:
                self.translators[index] = _Translator(master, origin)
            return str(self.translators[index].translate_formula(self.address))
        except (TokenizerError, TranslatorError, IndexError, ValueError) as error:
            where = f"the formula that {self.name}!{self.address} shares with {origin}"
            raise damaged(f"{where} cannot be read") from error

    def in_this_row(self, match: re.Match[str]) -> str:
        """The address of a cell in its own row of a table, the sheet's first if none is named.

        A reference to a table of another sheet is left unchanged.
        """
        head = re.sub(r"'(.)", r"\1", match["long"] or match["short"])
        table = (match["table"] or "").lower()
        tables = (columns for name, columns in self.tables if table in ("", name))
        column = next(tables, {}).get(head)
        return f"${get_column_letter(column)}{self.row}" if column else match[0]

    def value(self, kind: str, parts: Mapping[str, ET.Element]) -> Value | None:
        """The stored value of a cell, by its kind and its child elements."""
        if kind == "inlineStr":
            return (_string_text(parts["is"]) if "is" in parts else "") or None
        text = (parts["v"].text if "v" in parts else None) or ""
        if not text:  # an empty text is the value of a formula, but a blank cell otherwise
            return "" if kind == "str" and parts.keys() >= {"f", "v"} else None
        match kind:
            case "s":
                what = f"the number of the shared text in {self.name}!{self.address}"
                return self.texts[_index_number(text, what, len(self.texts))] or None
            case "b":
                return text.strip() not in ("0", "false")
            case "str":
                return _unescaped(text)
            case "e":
                return text[:MAX_TEXT]
            case "d":
                return _day_number(text, self.reader.date1904)
        try:
            number = float(text if len(text) <= _MAX_NUMBER and "_" not in text else "too long")
        except ValueError as error:
            reason = f"{self.name}!{self.address} holds {text[:20]!r}, which is no number"
            raise damaged(reason) from error
        # Some writers store nan or inf, which no engine reads: it counts as no value.
        return number if math.isfinite(number) else None

    def complete(self) -> dict[tuple[int, int], StoredCell]:
        """The cells, with the formula that it shares in every cell that was read before it."""
        for index, places in self.waiting.items():
            if index not in self.masters:
                ends = f"{self.name}!{address(*places[0])} to {address(*places[-1])}"
                raise damaged(f"the formulas that {ends} share have no first cell")
            for self.row, self.column in places:
                formula = self.counted(self.shared(index))
                place = self.row, self.column
                self.cells[place] = self.cells[place]._replace(formula=formula)
        last_row, last_column = map(max, zip((1, 1), *self.cells, strict=True))
        for (left, top, right, bottom), text in self.arrays:
            rows = range(top, min(bottom, last_row) + 1)
            columns = range(left, min(right, last_column) + 1)
            self.reader.filled += len(rows) * len(columns)
            if self.reader.filled > MAX_CELLS:
                raise too_much(f"array formulas fill too many cells; {_LIMITS}")
            area = top, left, bottom, right
            for place in product(rows, columns):
                if cell := self.cells.get(place):
                    self.cells[place] = cell._replace(formula=text, array=area)
        return self.cells


def _day_number(text: str, date1904: bool) -> Value:
    """A date as the number of days that it is in a workbook; the text if it is no date.

    >>> _day_number("2024-02-17T12:00:00", False), _day_number("2024-02-16", True)
    (45339.5, 43876.0)
    >>> _day_number("16. 2. 24", False)
    '16. 2. 24'
    """
    try:
        moment = datetime.fromisoformat(text.strip()).replace(tzinfo=None)
    except ValueError:
        return text[:MAX_TEXT]
    since = moment - _EPOCHS[date1904]
    days = since.days + (since.seconds + since.microseconds / 1e6) / 86_400
    return days if date1904 or days >= 61 else days - 1  # Excel has a 29 February 1900
