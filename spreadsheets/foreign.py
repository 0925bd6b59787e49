"""Read the cells of somebody else's workbook: formulas and stored values, within bounds.

Every file is treated as hostile. It is read as a stream by a parser that refuses document types
(hence all entities) and counts the bytes that it unpacks; nothing in the file is run, looked up or
followed. openpyxl does not read it: openpyxl fills merged and linked ranges cell by cell, so that a
file of a kilobyte keeps it busy for hours, and it gives either formulas or stored values, not both.
"""

import math
import re
import shutil
import subprocess
import zipfile
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import product
from pathlib import Path, PurePosixPath
from posixpath import join, normpath
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple
from xml.etree import ElementTree as ET

from openpyxl.formula.tokenizer import TokenizerError
from openpyxl.formula.translate import Translator, TranslatorError
from openpyxl.utils.cell import coordinate_to_tuple, get_column_letter, range_boundaries

from spreadsheets import separated
from spreadsheets.engines import address, office, run_program
from spreadsheets.safely import UNREADABLE

Position = tuple[str, int, int]
"""Sheet, row and column, both counted from 1."""

Value = float | str | bool

MAX_FILE = 64 * 2**20
MAX_UNPACKED = 192 * 2**20
"""Bytes of a file, packed and unpacked; the largest sheet within the limits has some 40 MB."""
MAX_ENTRIES = 10_000
MAX_CELLS = 400_000
MAX_FORMULAS = 60_000
"""A sheet of the scheme has some 800 cells; with a step of 1 ps it has 160,000."""
MAX_ELEMENTS = 4_000_000
"""XML elements of a part of the file: a sheet has at most four for a cell with a formula."""
MAX_DEPTH = 100
"""Levels of XML elements within each other: a sheet has six."""
LAST_ROW, LAST_COLUMN = 1_048_576, 16_384
MAX_TEXT = 32_767
"""Characters that a cell may have in Excel."""
MAX_FORMULA = 8_192
"""Characters that a formula may have in Excel."""
CONVERT_LIMIT_S = 120
_MEMORY = 4 * 2**30
"""Bytes that LibreOffice may address: four gigabytes; it needs less than two to start."""
_ODS_RESOLUTION = 1e-20
"""LibreOffice writes numbers below 1e-4 with 20 decimals: a mass in kg has some ten digits."""
_OLE_START = bytes.fromhex("D0CF11E0A1B11AE1")
"""How .xls files begin, and encrypted workbooks of every kind."""

_LIMITS = f"this program reads up to {MAX_CELLS:,} cells and {MAX_FORMULAS:,} formulas"
_TOO_MUCH = f"is refused: it unpacks to too many bytes; {_LIMITS}"
_WANTED = "give an .xlsx or .xlsm file without a password"


class WorkbookError(ValueError):
    """A file is refused or cannot be read as a workbook. The message is one line."""


def _damaged(what: str) -> WorkbookError:
    """An error for a file that breaks the rules of its format; `what` says how and where."""
    return WorkbookError(f"is damaged: {what}; a spreadsheet program may be able to repair it")


class Cell(NamedTuple):
    """The formula of a cell, with its "=", and its stored value; either is None if absent.

    `error`: the value is an error, not a text that spells one. `array`: the formula is an array
    formula, which the cell shares with others.
    """

    formula: str | None
    value: Value | None
    error: bool = False
    array: bool = False


@dataclass(frozen=True)
class Book:
    """A workbook: its worksheets in order, each with its cells by (row, column); and its names.

    `columns` maps the columns of tables, written as in formulas, such as "Steps[x]", to their
    cells. `notes` tell the user what is left out. Stored numbers are exact to within `resolution`.
    """

    path: Path
    sheets: Mapping[str, Mapping[tuple[int, int], Cell]]
    names: Mapping[str, str]
    notes: tuple[str, ...] = ()
    resolution: float = 0.0
    columns: Mapping[str, str] = field(default_factory=dict)

    def __getitem__(self, position: Position) -> Cell:
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

    def cells(self) -> Iterator[tuple[Position, Cell]]:
        """Every cell that is not blank."""
        for sheet, cells in self.sheets.items():
            for (row, column), cell in cells.items():
                yield (sheet, row, column), cell


_BLANK = Cell(None, None)


def read(path: Path) -> Book:
    """Read an .xlsx or .xlsm file; an .xls, .xlsb or .ods file by way of LibreOffice; or a .csv.

    A text file of separated values (`separated`) is one sheet, "CSV", whose rows are its lines.

    Raises WorkbookError, naming the file, if it is not a workbook, is damaged, or exceeds a limit
    of this module; OSError if it cannot be opened.
    """
    try:
        return _read(path)
    except WorkbookError as error:
        raise WorkbookError(f"{path}: {error}") from error


def _read(path: Path) -> Book:
    if not path.is_file():
        kind = "this is a folder" if path.is_dir() else "this is not a regular file"
        if not path.exists():
            kind = "this link leads nowhere" if path.is_symlink() else "there is no such file"
        raise WorkbookError(kind)
    if path.stat().st_size > MAX_FILE:
        raise WorkbookError(f"has more than {MAX_FILE >> 20} MB; {_LIMITS}")
    if _is_xlsx(path):
        with zipfile.ZipFile(path) as archive:
            return _Reader(archive, path).book()
    if path.suffix.lower() in separated.SUFFIXES:
        return _of_text(path)
    if path.suffix.lower() not in (".xls", ".xlsb", ".ods"):
        with path.open("rb") as file:
            start = file.read(len(_OLE_START))
        fault = "this is not a workbook"
        if start == _OLE_START:
            fault = "has a password, or is an .xls file by another name"
        elif start.startswith(b"PK") and not zipfile.is_zipfile(path):
            raise _damaged("its end is cut off or changed")
        raise WorkbookError(f"{fault}; {_WANTED}")
    with (
        TemporaryDirectory(prefix="coldspray-") as folder,
        zipfile.ZipFile(_converted(path, Path(folder))) as archive,
    ):
        book = _Reader(archive, path).book()
    note = f"{path.suffix} file read by way of LibreOffice, which may have recalculated it"
    resolution = _ODS_RESOLUTION if path.suffix.lower() == ".ods" else 0.0
    return replace(book, notes=(note, *book.notes), resolution=resolution)


def _of_text(path: Path) -> Book:
    """Return the one sheet of a text file of separated values."""
    try:
        values = separated.cells_of(path.read_bytes(), MAX_CELLS)
    except ValueError as error:
        raise WorkbookError(str(error)) from error
    return Book(path, {"CSV": {place: Cell(None, value) for place, value in values.items()}}, {})


def _is_xlsx(path: Path) -> bool:
    try:
        with zipfile.ZipFile(path) as archive:
            return any(name.endswith("workbook.xml") for name in archive.namelist()[:MAX_ENTRIES])
    except UNREADABLE:
        return False


def _converted(path: Path, folder: Path) -> Path:
    """Save a workbook as .xlsx with LibreOffice, within bounds of time, memory and disk.

    It runs in a new profile, where macros are off.
    """
    if (soffice := office()) is None:
        ways = "by way of LibreOffice, which is not installed; save it as .xlsx"
        raise WorkbookError(f"{path.suffix} files are read {ways}")
    if zipfile.is_zipfile(path):
        with zipfile.ZipFile(path) as archive:  # LibreOffice has no limit on what it unpacks
            reader = _Reader(archive, path)
            for part in reader.parts:
                deque(reader.chunks(part), maxlen=0)
    source = shutil.copyfile(path, folder / f"workbook{path.suffix.lower()}")
    command = [
        soffice, "--headless", "--norestore",
        f"-env:UserInstallation={(folder / 'profile').as_uri()}",
        "--convert-to", "xlsx", "--outdir", str(folder / "out"), str(source),
    ]  # fmt: skip
    for _ in range(2):  # the first run in a new profile may only ask to be started again
        try:
            run_program(command, CONVERT_LIMIT_S, _limited)
        except subprocess.TimeoutExpired as error:
            reason = f"LibreOffice did not open it within {CONVERT_LIMIT_S} s"
            raise WorkbookError(reason) from error
        if (folder / "out" / "workbook.xlsx").is_file():
            return folder / "out" / "workbook.xlsx"
    raise WorkbookError("LibreOffice cannot open it")


def _limited() -> None:
    """Limit the memory and the size of files of the process that calls this."""
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    resource.setrlimit(resource.RLIMIT_FSIZE, (MAX_FILE, MAX_FILE))


_Tables = list[tuple[str, dict[str, int]]]
"""The tables of a sheet: the name of each in small letters, and its columns by their heads."""

_THIS_ROW = re.compile(
    r"(?P<table>[^\W\d][\w.]*)?\[(?:\[#This Row\],\s*\[(?P<long>(?:[^\[\]']|'.)+)\]"
    r"|@\[?(?P<short>(?:[^\[\]']|'.)+)\]?)\]"
)
"""How a formula refers to a cell in its own row of a table: Steps[@x], [[#This Row],[x]]."""

_NOTES = {
    "vbaProject.bin": "it holds macros: they are not run",
    "/externalLinks/": "it has links to other files: they are not followed",
}


class _Reader:
    """Read the parts of one file, within one budget of bytes, cells and formulas."""

    def __init__(self, archive: zipfile.ZipFile, path: Path) -> None:
        if len(archive.namelist()) > MAX_ENTRIES:
            raise WorkbookError(f"is refused: it holds more than {MAX_ENTRIES:,} parts")
        if any(part.flag_bits & 1 for part in archive.infolist()):
            raise WorkbookError(f"has parts with a password; {_WANTED}")
        self.archive, self.path = archive, path
        self.parts = {name.lstrip("/"): name for name in archive.namelist()}
        self.left = MAX_UNPACKED
        self.cells = self.formulas = self.filled = 0
        self.columns: dict[str, str] = {}

    def book(self) -> Book:
        """Read the whole workbook."""
        mains = (to for kind, to in self.relations("").values() if kind == "officeDocument")
        main = next(mains, "xl/workbook.xml")
        tree, related = self.tree(main), self.relations(main)
        strings = next((to for kind, to in related.values() if kind == "sharedStrings"), None)
        texts: list[str] = []
        if strings is not None:
            self.tree(strings, _Tree(si=lambda string: texts.append(_text(string))))
        sheets: dict[str, dict[tuple[int, int], Cell]] = {}
        listed = tree.findall("{*}sheets/{*}sheet")
        names = [_attribute(sheet, "name", main) for sheet in listed]
        if len({name.upper() for name in names}) < len(names):
            raise _damaged("two of its sheets have the same name")
        for sheet, name in zip(listed, names, strict=True):
            identity = (value for key, value in sheet.attrib.items() if key.endswith("}id"))
            kind, part = related.get(next(identity, ""), ("", ""))
            if not part:
                raise _damaged(f"its sheet {name!r} has no part of the file")
            if kind == "worksheet":
                cells = _Sheet(self, name, texts, self.tables(name, part))
                self.tree(part, _Tree(row=cells.take_row))
                sheets[name] = cells.filled()
        if not sheets:
            raise WorkbookError("has no worksheet")
        notes = [note for part, note in _NOTES.items() if any(part in name for name in self.parts)]
        meanings: dict[str, str] = {}
        for entry in tree.iterfind("{*}definedNames/{*}definedName"):
            name, scope = _attribute(entry, "name", main), entry.get("localSheetId")
            if entry.text and not name.startswith("_xlnm."):
                if scope is not None:  # a name of one sheet is written 'Sheet'!name
                    number = _whole_number(scope, f"the sheet of the name {name!r}", len(names))
                    name = f"'{names[number]}'!{name}"
                meanings[name] = entry.text[:MAX_FORMULA]
        return Book(self.path, sheets, meanings, tuple(notes), columns=self.columns)

    def tables(self, sheet: str, sheet_part: str) -> _Tables:
        """Read the tables of a sheet."""
        tables, quoted = [], sheet.replace("'", "''")
        for kind, part in self.relations(sheet_part).values():
            if kind != "table" or part not in self.parts:
                continue
            tree = self.tree(part)
            name, ref = (_attribute(tree, key, part) for key in ("displayName", "ref"))
            left, top, _, bottom = _corners(ref, f"the table {name!r}")
            heads, totals = (
                _whole_number(tree.get(key, default), f"{key} of {name!r}")
                for key, default in (("headerRowCount", "1"), ("totalsRowCount", "0"))
            )
            columns = {
                _attribute(column, "name", part): number
                for number, column in enumerate(tree.iterfind("{*}tableColumns/*"), left)
            }
            tables.append((name.lower(), columns))
            for head, number in columns.items():
                escaped, letter = re.sub(r"[\[\]#'@]", r"'\g<0>", head), get_column_letter(number)
                cells = f"'{quoted}'!${letter}${top + heads}:${letter}${bottom - totals}"
                self.columns[f"{name}[{escaped}]"] = cells
        return tables

    def relations(self, part: str) -> dict[str, tuple[str, str]]:
        """The parts that a part refers to, each with its kind, by the identity of the reference."""
        path = PurePosixPath(part)
        rels = f"{path.parent}/_rels/{path.name}.rels".removeprefix("./")
        if rels not in self.parts:
            return {}
        related = {}
        for relation in self.tree(rels):
            if relation.get("TargetMode") != "External":
                keys = ("Id", "Type", "Target")
                identity, kind, target = (_attribute(relation, key, rels) for key in keys)
                # A target may start at the root with "/", or go up with "..".
                part_name = normpath(join("/", path.parent, target)).lstrip("/")
                related[identity] = kind.rpartition("/")[2], part_name
        return related

    def tree(self, part: str, tree: "_Tree | None" = None) -> ET.Element:
        """Parse a part as XML, into this tree if one is given."""
        if part not in self.parts:
            raise _damaged(f"it refers to its part {part}, which is not there")
        parser = ET.XMLParser(target=tree or _Tree())
        try:
            for chunk in self.chunks(part):
                parser.feed(chunk)
            return parser.close()
        except WorkbookError:
            raise
        except (ET.ParseError, LookupError, ValueError) as error:  # the last two for an encoding
            raise _damaged(f"its part {part} is not valid XML: {error}") from error

    def chunks(self, part: str) -> Iterator[bytes]:
        """Unpack a part, counting the bytes that come out, not those that the archive declares."""
        try:
            with self.archive.open(self.parts[part]) as stream:
                while chunk := stream.read(2**16):
                    self.left -= len(chunk)
                    if self.left < 0:
                        raise WorkbookError(_TOO_MUCH)
                    yield chunk
        except WorkbookError:
            raise
        except UNREADABLE as error:
            raise _damaged(f"its part {part} cannot be unpacked: {error}") from error


class _Tree(ET.TreeBuilder):
    """The XML tree of a part; at its end, an element with a taker is given to it and emptied."""

    def __init__(self, **takers: Callable[[ET.Element], object]) -> None:
        super().__init__()
        self.takers, self.elements, self.depth = takers, 0, 0

    def doctype(self, *_: object) -> None:
        raise WorkbookError("is refused: its XML declares a document type, which no workbook needs")

    def start(self, tag: Any, attributes: Any) -> ET.Element:
        self.elements += 1
        self.depth += 1
        if self.elements > MAX_ELEMENTS:
            raise WorkbookError(_TOO_MUCH)
        if self.depth > MAX_DEPTH:
            raise _damaged(f"its XML is nested more than {MAX_DEPTH} levels deep")
        return super().start(tag, attributes)

    def end(self, tag: Any) -> ET.Element:
        self.depth -= 1
        element = super().end(tag)
        if taker := self.takers.get(_tag(element)):
            taker(element)
            element.clear()
        return element


def _tag(element: ET.Element) -> str:
    """The name of an element without its namespace."""
    return element.tag.rpartition("}")[2]


def _attribute(element: ET.Element, attribute: str, part: str) -> str:
    """An attribute of an element, which it must have."""
    if (value := element.get(attribute)) is None:
        raise _damaged(f"a <{_tag(element)}> of its part {part} has no {attribute!r}")
    return value


def _whole_number(text: str, what: str, below: int = LAST_ROW + 1) -> int:
    """Read a whole number from 0 to less than `below`; `what` says what it is, for the message."""
    if not (re.fullmatch(r"\s*\d{1,9}\s*", text) and int(text) < below):
        raise _damaged(f"{what} is {text[:20]!r} and must be a whole number below {below}")
    return int(text)


def _corners(cells: str, what: str) -> tuple[int, ...]:
    """The first column and row, and the last ones, of the range in which `what` stands."""
    try:
        return tuple(end or 1 for end in range_boundaries(cells))
    except ValueError as error:
        raise _damaged(f"{what} stands in {cells[:20]!r}, which is no range of cells") from error


def _text(string: ET.Element) -> str:
    """The text of a string in one or several pieces, without phonetic guides."""
    pieces = (piece for part in string if _tag(part) != "rPh" for piece in part.iter())
    return "".join(piece.text or "" for piece in pieces if _tag(piece) == "t")[:MAX_TEXT]


class _Sheet:
    """Collect the cells of a worksheet, row by row."""

    def __init__(self, reader: _Reader, name: str, texts: list[str], tables: _Tables) -> None:
        self.reader, self.name, self.texts, self.tables = reader, name, texts, tables
        self.cells: dict[tuple[int, int], Cell] = {}
        self.masters: dict[str, tuple[str, str]] = {}
        self.arrays: list[tuple[tuple[int, ...], str]] = []
        self.row = self.column = 0

    @property
    def address(self) -> str:
        """The address of the cell that is being read."""
        return address(self.row, self.column)

    def take_row(self, row: ET.Element) -> None:
        """Read the cells of a row."""
        number = row.get("r", str(self.row + 1))
        self.row, self.column = _whole_number(number, f"the number of a row of {self.name!r}"), 0
        for cell in row:
            self.column += 1
            if given := cell.get("r", "")[:20]:
                try:
                    self.row, self.column = coordinate_to_tuple(given)
                except ValueError:
                    self.column = 0
            if not (0 < self.row <= LAST_ROW and 0 < self.column <= LAST_COLUMN):
                raise _damaged(f"no cell of {self.name!r} can be at {given!r}")
            kind, parts = cell.get("t", "n"), {_tag(part): part for part in cell}
            element = parts.get("f")
            formula = None if element is None else self.formula(element)
            if formula and self.tables:
                formula = _THIS_ROW.sub(self.in_this_row, formula)
            value = self.value(kind, parts)
            if formula is not None or value is not None:
                self.reader.cells += 1
                self.reader.formulas += formula is not None
                if self.reader.cells > MAX_CELLS or self.reader.formulas > MAX_FORMULAS:
                    raise WorkbookError(f"is refused: it has too many cells; {_LIMITS}")
                array = element is not None and element.get("t") in ("array", "dataTable")
                self.cells[self.row, self.column] = Cell(formula, value, kind == "e", array)

    def formula(self, element: ET.Element) -> str | None:
        """The formula of a cell; one that it shares with another is translated to this cell."""
        text = (element.text or "")[: MAX_FORMULA + 1]
        kind = element.get("t")
        if kind == "shared":
            index = element.get("si", "")
            if text:
                self.masters[index] = text, self.address
            elif index in self.masters:
                master, origin = self.masters[index]
                try:
                    return str(Translator(f"={master}", origin).translate_formula(self.address))
                except (TokenizerError, TranslatorError) as error:
                    where = f"the formula that {self.name}!{self.address} shares with {origin}"
                    raise _damaged(f"{where} cannot be read") from error
        if kind == "array" and text:
            cells = element.get("ref", self.address)
            self.arrays.append((_corners(cells, f"an array formula of {self.name!r}"), f"={text}"))
        return f"={text}" if text else None

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
            return (_text(parts["is"]) if "is" in parts else "") or None
        text = (parts["v"].text if "v" in parts else None) or ""
        if not text:  # an empty text is the value of a formula, but a blank cell otherwise
            return "" if kind == "str" and parts.keys() >= {"f", "v"} else None
        match kind:
            case "s":
                what = f"the number of the shared text in {self.name}!{self.address}"
                return self.texts[_whole_number(text, what, len(self.texts))] or None
            case "b":
                return text.strip() not in ("0", "false")
            case "e" | "str" | "d":
                return text[:MAX_TEXT]
        try:
            number = float(text)
        except ValueError as error:
            reason = f"{self.name}!{self.address} holds {text[:20]!r}, which is no number"
            raise _damaged(reason) from error
        # Some writers store nan or inf, which no engine reads: it counts as no value.
        return number if math.isfinite(number) else None

    def filled(self) -> dict[tuple[int, int], Cell]:
        """The cells, with the formula of an array in every cell that it fills."""
        last_row, last_column = map(max, zip((1, 1), *self.cells, strict=True))
        for (left, top, right, bottom), text in self.arrays:
            rows = range(top, min(bottom, last_row) + 1)
            columns = range(left, min(right, last_column) + 1)
            self.reader.filled += len(rows) * len(columns)
            if self.reader.filled > MAX_CELLS:
                raise WorkbookError(f"is refused: array formulas fill too many cells; {_LIMITS}")
            for place in product(rows, columns):
                if cell := self.cells.get(place):
                    self.cells[place] = cell._replace(formula=text, array=True)
        return self.cells
