"""Read a text file as rows of cells, whatever its encoding, separator and decimal mark are.

`fit` and `--data` read their columns so, and `check` the rows that a program wrote. Separators are
commas, semicolons, tabs, bars or blanks; decimal marks are points or commas. A first line such as
`sep=;`, which Excel writes, says the separator. Lines that begin with a mark of comments have no
cells; but the heads of columns may stand in the last of them above the numbers.
"""

import csv
import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence

Rows = dict[int, list[str]]
"""The cells of the lines that have some, by the number of the line."""

COMMENTS = ("#", "%", "//")
_SEPARATORS = ("\t", ";", ",", "|", " ")
_NUMBER = re.compile(r"[-+]?(?:\d+[.,]?\d*|[.,]\d+)(?:[Ee][-+]?\d{1,3})?")
_FORTRAN = re.compile(r"(?<=[\d.,])[Dd](?=[-+]?\d{1,3}$)")
"""How Fortran marks the exponent of a double."""
_GROUPED = re.compile(r"[-+]?\d{1,3}(?:(?P<mark>[.,])\d{3})(?:(?P=mark)\d{3})*(?!(?P=mark))[.,]\d*")
"""A number with marks of thousands, and another mark before its decimals."""
_HEAD = re.compile(r"[^\s\[(]+\s*(?:\[[^\]]*\]|\([^)]*\))?")
"""A head among others that blanks separate: a name and maybe a unit in brackets."""


def file_text(content: bytes) -> str:
    """Return the text of a file: UTF-8, UTF-16 with its mark, or as Windows writes it in the West.

    Raises ValueError if it is no text.

    >>> file_text("µm".encode("cp1252")), file_text("µm".encode("utf-16"))
    ('µm', 'µm')
    """
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        encoding = "utf-16"
    elif b"\0" in content:
        raise ValueError("is not text: give rows of numbers as CSV")
    else:
        encoding = "utf-8-sig"
    try:
        return content.decode(encoding)
    except UnicodeDecodeError as error:
        if encoding == "utf-16":
            raise ValueError("is not text: give rows of numbers as CSV in UTF-8") from error
        return content.decode("cp1252", errors="replace")


def stated_separator(lines: Sequence[str]) -> str | None:
    """Return the separator that the first line states, as `sep=;` does, or None."""
    stated = re.fullmatch(r"\s*sep=(.)\s*", lines[0], re.IGNORECASE) if lines else None
    return stated[1] if stated else None


def separated_rows(
    lines: Sequence[str], worth: Callable[[Rows, str], tuple[int, ...]]
) -> tuple[Rows, str]:
    """Return the rows by the separator that is stated, or else is worth most, and that separator.

    `worth` judges the rows that a separator gives. Raises ValueError if a line is no CSV.
    """
    stated = stated_separator(lines)
    candidates = (stated,) if stated else _SEPARATORS
    best: tuple[tuple[int, ...], Rows, str] | None = None
    problem: ValueError | None = None
    for separator in candidates:
        try:
            rows = dict(line_cells(lines, separator))
        except ValueError as error:
            problem = problem or error
            continue
        score = worth(rows, separator)
        if best is None or score > best[0]:
            best = score, rows, separator
    if best is None:
        assert problem is not None
        raise problem
    return best[1], best[2]


def line_cells(lines: Sequence[str], separator: str) -> Iterator[tuple[int, list[str]]]:
    """Yield the cells of each line that is not blank, no comment, and states no separator."""
    stated = stated_separator(lines)
    kept = ("" if line.lstrip().startswith(COMMENTS) else line for line in lines)
    if separator == " ":
        kept = (line.expandtabs(1).strip() for line in kept)
    for line, cells in _csv_rows(kept, separator):
        while cells and not cells[-1]:
            cells.pop()
        if cells and not (stated and line == 1):
            yield line, cells


def _csv_rows(lines: Iterable[str], separator: str) -> Iterator[tuple[int, list[str]]]:
    """Yield the rows of CSV without blanks around cells, each with the number of its last line.

    Raises ValueError that names the line.
    """
    reader = csv.reader(lines, delimiter=separator, skipinitialspace=True)
    try:
        for row in reader:
            yield reader.line_num, [cell.strip() for cell in row]
    except csv.Error as error:
        raise ValueError(f"line {reader.line_num} is not CSV: {error}") from error


def cell_number(text: str) -> float | None:
    """Return the number that a cell is, with either decimal mark, or None.

    >>> [cell_number(text) for text in ("1,5e-3", "1.234,5", "1,234.5", "-2.D+01", "v1")]
    [0.0015, 1234.5, 1234.5, -20.0, None]
    """
    plain = plain_number(text)
    if not _NUMBER.fullmatch(plain):
        return None
    value = float(plain.replace(",", "."))
    return value if math.isfinite(value) else None


def plain_number(text: str) -> str:
    """Return the text of a number without marks of thousands, with an ordinary minus, and e for D.

    >>> plain_number("1.234,5"), plain_number("\N{MINUS SIGN}4,5 um"), plain_number("5.1D+00")
    ('1234,5', '-4,5 um', '5.1e+00')
    """
    plain = re.sub("[\u00a0\u202f']", "", text.strip()).replace("\u2212", "-")
    plain = _FORTRAN.sub("e", plain)
    if match := _GROUPED.match(plain):
        plain = plain.replace(match["mark"], "")
    return plain


def heads_by_blanks(line: str) -> list[str]:
    """Return the heads in a line that separates them by blanks, each with its unit in brackets.

    >>> heads_by_blanks("velocity [m/s] depth [um]")
    ['velocity [m/s]', 'depth [um]']
    """
    return _HEAD.findall(line)


def commented_heads(
    lines: Sequence[str], first: int, width: int, separator: str
) -> tuple[int, list[str]] | None:
    """Return the heads in the comment above line `first`, and its line, if it has `width` words."""
    for line in range(first - 1, 0, -1):
        text = lines[line - 1].strip()
        if text and not text.startswith(COMMENTS):
            return None
        bare = text.lstrip("#%/").strip()
        heads = [cell.strip() for cell in next(csv.reader([bare], delimiter=separator), [])]
        if separator == " " or len(heads) < 2:
            heads = heads_by_blanks(bare)
        if len(heads) == width and all(cell_number(head) is None for head in heads):
            return line, heads
    return None
