"""Columns of numbers with units in their heads, from a text file: comma-separated values (CSV).

A file has one row of heads, then rows of numbers. Cells are separated by commas, semicolons or
tabs, whichever the heads are separated by. A head is a name and maybe a unit: `velocity [m/s]`,
`depth (um)`, `depth, um` in quotation marks, `depth/um`, `depth um` and `depth_um` are all read.
Without a unit a column is in SI units. Empty rows, and rows that begin with `#`, are skipped.
"""

import csv
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from reference.units import UnitError, unit_dimension
from replication.user_input import content_of, place, quoted, read_number

LARGEST_FILE = 2**26

_BRACKETS = re.compile(r"(?P<name>.*?)[\s/,]*(?:\[(?P<square>.*)\]|\((?P<round>.*)\))")
_SEPARATOR = re.compile(r"[\s,_/]+")
_PLUS_MINUS = re.compile(r"±|\+/?-")


@dataclass(frozen=True, slots=True)
class Column:
    """A column as it stands in the file: the head, the name and unit in it, and the cells' texts.

    The name is in small letters, its words are separated by blanks. The unit is "" if the head has
    none. `lines` are the numbers of the cells' lines in the file, whose name is `file`.
    """

    file: str
    head: str
    name: str
    unit: str
    texts: tuple[str, ...]
    lines: tuple[int, ...]

    def numbers(self, unit: str) -> list[float]:
        """Return the cells as numbers in SI units; `unit` is an SI unit of what is expected.

        Raises ValueError that names the file, the head, and the line of the first cell that is no
        number, and those of further ones.

        >>> cells = {"texts": ("500", ""), "lines": (2, 3)}
        >>> Column("my.csv", "v [m/s]", "v", "m/s", **cells).numbers("m/s")
        Traceback (most recent call last):
        ValueError: my.csv, line 3, column 'v [m/s]': the cell is empty
        """
        own = "" if self.unit == unit == "1" else self.unit  # "X/R [1]" and "X/R [-]" have none
        with place(f"{self.file}, column {quoted(self.head)}"):
            read_number(f"1 {own}", unit)  # its unit, once and not in every row
        numbers, errors = [], []
        for line, text in zip(self.lines, self.texts, strict=True):
            try:
                with place(f"{self.file}, line {line}, column {quoted(self.head)}"):
                    if not text:
                        raise ValueError("the cell is empty")
                    if _PLUS_MINUS.search(text):
                        unit_here = f" [{self.unit}]" if self.unit else ""
                        raise ValueError(
                            f"{quoted(text)} is a number and its uncertainty: put that into a "
                            f"column of its own, 'uncertainty{unit_here}'"
                        )
                    numbers.append(read_number(f"{text} {own}".strip(), unit))
            except ValueError as error:
                errors.append((line, error))
        if errors:
            raise bad_rows(errors)
        return numbers


def bad_rows(errors: Sequence[tuple[int, ValueError]]) -> ValueError:
    """Return one error of one line for those of several lines: the first, and the other lines.

    >>> bad_rows([(3, ValueError("line 3: no number")), (7, ValueError()), (9, ValueError())])
    ValueError('line 3: no number (line 7, line 9, too)')
    """
    (_, first), *others = errors
    lines = [f"line {line}" for line, _ in others[:5]]
    more = [f"{len(others) - 5} more"] if len(others) > 5 else []
    return ValueError(f"{first} ({', '.join(lines + more)}, too)" if others else str(first))


def read_columns(path: Path) -> list[Column]:
    """Read the columns of a file. Raises OSError, or ValueError that names the file and the line.

    The file must be UTF-8 text of at most 64 MiB, with a head for every column and no head twice,
    and at least one row.
    """
    content = content_of(path, LARGEST_FILE)
    with place(str(path)):
        rows = list(_numbered_rows(_decoded(content)))
        if len(rows) < 2:
            raise ValueError("has no row of numbers below a row of heads")
    (head_line, heads), *body = rows
    while heads and not heads[-1]:
        heads.pop()
    with place(f"{path}, line {head_line}"):
        for k, head in enumerate(heads):
            if not head:
                raise ValueError(f"column {k + 1} has no head")
            if head in heads[:k]:
                raise ValueError(f"two columns have the head {quoted(head)}")
    for line, cells in body:
        if any(cells[len(heads) :]):
            raise ValueError(f"{path}, line {line}: has more cells than there are heads")
    lines = tuple(line for line, _ in body)
    columns = []
    for k, head in enumerate(heads):
        texts = tuple(cells[k] if k < len(cells) else "" for _, cells in body)
        columns.append(Column(str(path), head, *name_and_unit(head), texts, lines))
    return columns


def _decoded(content: bytes) -> str:
    if len(content) > LARGEST_FILE:
        raise ValueError(f"is larger than {LARGEST_FILE:,} bytes")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise ValueError("is not UTF-8 text: save it as CSV in UTF-8") from error


def _numbered_rows(text: str) -> Iterator[tuple[int, list[str]]]:
    """Yield the rows that are not skipped, each with the number of its last line."""
    lines = text.splitlines(keepends=True)
    first = next((line for line in lines if line.strip() and line.lstrip()[0] != "#"), "")
    bare = re.sub('"[^"]*"', "", first)
    for line, cells in csv_rows(lines, max(",;\t", key=bare.count)):
        if any(cells) and not cells[0].startswith("#"):
            yield line, cells


def csv_rows(lines: Iterable[str], separator: str) -> Iterator[tuple[int, list[str]]]:
    """Yield the rows of CSV without blanks around cells, each with the number of its last line.

    Raises ValueError that names the line.
    """
    reader = csv.reader(lines, delimiter=separator, skipinitialspace=True)
    try:
        for row in reader:
            yield reader.line_num, [cell.strip() for cell in row]
    except csv.Error as error:
        raise ValueError(f"line {reader.line_num} is not CSV: {error}") from error


def name_and_unit(head: str) -> tuple[str, str]:
    """Return the name and the unit ("" for none) in the head of a column.

    >>> name_and_unit("Impact velocity [m/s]"), name_and_unit("depth_um"), name_and_unit("dx/dt")
    (('impact velocity', 'm/s'), ('depth', 'um'), ('dx/dt', ''))
    """
    name, unit = head, ""
    if match := _BRACKETS.fullmatch(head.strip()):
        name, unit = match["name"], (match["square"] or match["round"] or "").strip()
        unit = "1" if unit == "-" else unit
    else:
        for gap in _SEPARATOR.finditer(head):
            if head[: gap.start()] and _is_unit(head[gap.end() :]):
                name, unit = head[: gap.start()], head[gap.end() :]
                break
    return " ".join(name.replace("_", " ").lower().split()), unit


def _is_unit(text: str) -> bool:
    try:
        unit_dimension(text)
    except UnitError:
        return False
    return True


def not_among(columns: Iterable[Column], used: Iterable[Column]) -> list[Column]:
    """Return the columns that are not among those used."""
    heads = {column.head for column in used}
    return [column for column in columns if column.head not in heads]


def note_of_unused(columns: Sequence[Column], used: Iterable[Column]) -> list[str]:
    """Return a note that names the columns that are not among those used; none if all are.

    >>> mine = [Column("my.csv", head, head, "", (), ()) for head in ("v", "x", "shot")]
    >>> note_of_unused(mine, mine[:2])
    ["my.csv: columns not used: 'shot'"]
    """
    heads = [quoted(column.head) for column in not_among(columns, used)]
    more = [f"and {len(heads) - 12} more"] if len(heads) > 12 else []
    text = f"columns not used: {', '.join(heads[:12] + more)}"
    return [f"{columns[0].file}: {text}"] if heads else []


def column_of(columns: Sequence[Column], names: Sequence[str]) -> Column | None:
    """Return the column that has one of these names, if any. Raises ValueError if two have.

    >>> column_of(columns=[Column("my.csv", "V", "v", "", (), ())], names=["velocity", "v"]).head
    'V'
    """
    columns = [column for column in columns if column.name in names]
    if len(columns) > 1:
        heads = " and ".join(quoted(column.head) for column in columns[:2])
        raise ValueError(
            f"{columns[0].file}: {heads} both may be the {names[0]}: rename one of them"
        )
    return columns[0] if columns else None
