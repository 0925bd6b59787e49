"""Columns of numbers with units in their heads, from a text file: comma-separated values (CSV).

A file has one row of heads, then rows of numbers; `replication.separated` says how it may be
written. A head is a name and maybe a unit: `velocity [m/s]`, `depth (um)`, `depth, um` in quotation
marks, `depth/um`, `depth in um`, `depth um` and `depth_um` are all read. A row of units may stand
below the heads. Without a unit a column is in SI units.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from reference.units import is_known, same_dimension, to_si
from replication.separated import (
    Rows,
    commented_heads,
    file_text,
    heads_by_blanks,
    line_cells,
    plain_number,
    separated_rows,
)
from replication.user_input import (
    content_of,
    number_parts,
    place,
    quoted,
    read_number,
    typed_unit,
)

LARGEST_FILE = 2**26

_BRACKETS = re.compile(r"(?P<name>.*?)[\s/,]*(?:\[(?P<square>.*)\]|\((?P<round>.*)\))")
_IN = re.compile(r"(?P<name>.*\S)\s+in\s+(?P<unit>\S.*)", re.IGNORECASE)
_GAP = re.compile(r"[\s,_/]+")
_PLUS_MINUS = re.compile(r"±|\+/?-")


@dataclass(frozen=True, slots=True)
class Column:
    """A column as it stands in the file: the head, the name and unit in it, and the cells' texts.

    The name is in small letters, its words are separated by blanks. The unit is "" if the head has
    none. `lines` are the numbers of the cells' lines in the file, whose name is `file`. The decimal
    mark, `decimal`, is a point or a comma.
    """

    file: str
    head: str
    name: str
    unit: str
    texts: tuple[str, ...]
    lines: tuple[int, ...]
    decimal: str = "."

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
        with place(f"{self.file}, column {quoted(self.head)}"):  # once and not in every row
            if own and not same_dimension(own, unit):
                wanted = "a number without a unit" if unit == "1" else f"what {unit} does"
                raise ValueError(f"{own} does not measure {wanted}")
        numbers, errors = [], []
        for line, text in zip(self.lines, self.texts, strict=True):
            try:
                with place(f"{self.file}, line {line}, column {quoted(self.head)}"):
                    numbers.append(self._cell_number(text, unit, own))
            except ValueError as error:
                errors.append((line, error))
        if errors:
            raise bad_rows(errors)
        return numbers

    @property
    def plain_texts(self) -> list[str]:
        """The cells' texts with decimal points, and without marks of thousands."""
        return [self._with_point(text) for text in self.texts]

    def _with_point(self, text: str) -> str:
        plain = plain_number(text)
        return plain.replace(",", ".") if self.decimal == "," else plain

    def _cell_number(self, text: str, unit: str, own: str) -> float:
        """Return the number of a cell; its messages quote the text as it stands in the file."""
        if not text:
            raise ValueError("the cell is empty")
        if _PLUS_MINUS.search(text):
            unit_here = f" [{self.unit}]" if self.unit else ""
            raise ValueError(
                f"{quoted(text)} is a number and its uncertainty: put that into a column of its "
                f"own, 'uncertainty{unit_here}'"
            )
        plain = self._with_point(text)
        if not plain[-1:].isdigit() and own:  # it may have a unit of its own
            typed = typed_unit(plain)
            if is_known(typed) and to_si(typed) != to_si(own):
                raise ValueError(f"{quoted(text)} has another unit than the head of its column")
        return read_number(plain if number_parts(plain) else text, unit, own)


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

    The file must be text of at most 64 MiB, with a head for every column and no head twice, and at
    least one row.
    """
    content = content_of(path, LARGEST_FILE)
    with place(str(path)):
        if len(content) > LARGEST_FILE:
            raise ValueError(f"is larger than {LARGEST_FILE:,} bytes")
        rows, separator = _rows_with_heads(file_text(content).splitlines())
        if len(rows) < 2:
            raise ValueError("has no row of numbers below a row of heads")
    (head_line, heads), *body = rows.items()
    with place(f"{path}, line {head_line}"):
        _check_heads(heads)
    for line, cells in body:
        if len(cells) > len(heads):
            raise ValueError(f"{path}, line {line}: has more cells than there are heads")
    units = [""] * len(heads)
    if len(body) > 1 and _is_row_of_units(body[0][1]):
        units = [*body.pop(0)[1], *units][: len(heads)]
    decimal = "." if separator == "," else _decimal_mark(path, body)
    lines = tuple(line for line, _ in body)
    columns = []
    for k, head in enumerate(heads):
        texts = tuple(cells[k] if k < len(cells) else "" for _, cells in body)
        name, unit = name_and_unit(head)
        unit = unit or _bare_unit(units[k])
        columns.append(Column(str(path), head, name, unit, texts, lines, decimal))
    return columns


_LOOKED_AT = 1000
"""The lines of a file by which its separator is chosen."""


def _rows_with_heads(lines: Sequence[str]) -> tuple[Rows, str]:
    """Return the rows of cells, of which the first has the heads, and what separates them."""
    _, separator = separated_rows(lines[:_LOOKED_AT], _worth)
    rows = dict(line_cells(lines, separator))
    if not rows:
        return rows, separator
    first, *others = rows
    if any(map(_is_number, rows[first])):
        commented = commented_heads(lines, first, len(rows[first]), separator)
        if commented is None and all(map(_is_number, rows[first])):
            raise ValueError(
                f"line {first} has numbers, but no row of heads above it: give each column a head, "
                "such as 'velocity [m/s]'"
            )
        rows = dict([commented]) | rows if commented else rows
    elif separator == " " and others:
        rows[first] = heads_by_blanks(lines[first - 1])
    return rows, separator


def _worth(rows: Rows, separator: str) -> tuple[int, ...]:
    """How many rows of numbers a separator gives, of how many cells; else numbers among others.

    Where no row has two numbers, that which separates most heads counts: blanks are within heads.
    """
    full = cells_of_full = numbers = 0
    for cells in rows.values():
        count = sum(map(_is_number, cells))
        if count > 1:
            numbers += count
            if count == len(cells):
                full, cells_of_full = full + 1, cells_of_full + count
    heads = next(iter(rows.values()), [])
    return full, cells_of_full, numbers, 0 if separator == " " else len(heads)


def _is_number(text: str) -> bool:
    """Whether a cell is a number with either decimal mark, maybe with a unit or an uncertainty."""
    parts = number_parts(_PLUS_MINUS.split(plain_number(text))[0].replace(",", "."))
    return parts is not None and (not parts[1] or is_known(parts[1]))


def _decimal_mark(path: Path, body: Sequence[tuple[int, Sequence[str]]]) -> str:
    """Return the decimal mark of a file that does not separate cells by commas.

    Raises ValueError if some numbers have a comma and others a point: these may be marks of
    thousands, which would be a factor of a thousand.
    """
    first: dict[str, tuple[int, str]] = {}
    for line, cells in body:
        for cell in cells:
            for mark in ".,":
                if mark not in first and mark in plain_number(cell) and _is_number(cell):
                    first[mark] = line, cell
    if len(first) > 1:
        (point_line, point), (line, comma) = first["."], first[","]
        raise ValueError(
            f"{path}, line {point_line}: {quoted(point)} has a point, and {quoted(comma)} in line "
            f"{line} a comma: write all decimal marks alike, and no marks of thousands"
        )
    return next(iter(first), ".")


def _is_row_of_units(cells: Sequence[str]) -> bool:
    """Whether the row below the heads has their units, as "m/s" and "[um]"."""
    units = [_bare_unit(cell) for cell in cells if cell]
    return all(map(is_known, units)) and any(unit != "1" for unit in units)


def _bare_unit(text: str) -> str:
    """Return a unit in a cell of its own, without brackets; "1" for a dash."""
    unit = text[1:-1].strip() if text[:1] + text[-1:] in ("[]", "()") else text
    return "1" if unit == "-" else unit


def _check_heads(heads: Sequence[str]) -> None:
    """Raise ValueError if a column has no head, or that of another column."""
    for k, head in enumerate(heads):
        if not head:
            raise ValueError(f"column {k + 1} has no head")
        if head in heads[:k]:
            raise ValueError(f"two columns have the head {quoted(head)}")


def name_and_unit(head: str) -> tuple[str, str]:
    """Return the name and the unit ("" for none) in the head of a column.

    >>> name_and_unit("Impact velocity [m/s]"), name_and_unit("depth_um"), name_and_unit("dx/dt")
    (('impact velocity', 'm/s'), ('depth', 'um'), ('dx/dt', ''))
    >>> name_and_unit("Tiefe in µm"), name_and_unit("depth in")
    (('tiefe', 'µm'), ('depth', 'in'))
    """
    name, unit = head.strip(), ""
    if match := _BRACKETS.fullmatch(name):
        name, unit = match["name"], (match["square"] or match["round"] or "").strip()
        name = re.sub(r"\s+in$", "", name) if unit else name
        unit = "1" if unit == "-" else unit
    elif (match := _IN.fullmatch(name)) and is_known(match["unit"]):
        name, unit = match["name"], match["unit"]
    else:
        for gap in _GAP.finditer(head):
            if head[: gap.start()] and is_known(head[gap.end() :]):
                name, unit = head[: gap.start()], head[gap.end() :]
                break
    return " ".join(name.replace("_", " ").lower().split()), unit


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
