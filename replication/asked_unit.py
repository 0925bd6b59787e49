"""Ask whether a column is in another unit than its head says: then its numbers are as expected."""

from collections.abc import Callable, Sequence

from reference.units import to_si
from replication.columns import Column
from replication.user_input import number_parts, quoted, read_number, typed_unit

LENGTH_UNITS: tuple[str, ...] = ("um", "nm", "mm", "cm", "m")
TIME_UNITS: tuple[str, ...] = ("ns", "us", "ps", "ms", "s")
SHARE_UNITS: tuple[str, ...] = ("%", "1")
"""Units of penetration depths, of times, and of normalized depths: those that are usual first."""

FAR = 100.0
"""How far beyond what it is drawn with a column without a unit may reach: units differ by factors
of 1000, and somebody's own points go on for at least a tenth of the way."""


def unit_asked(
    column: Column, row: int, units: Sequence[str], is_expected: Callable[[float], bool]
) -> str:
    """Return the question whether the number of a row is in another unit, and how to write that.

    It is the first of `units` in which the number [SI] is expected; without one the text is "".

    >>> cells = {"texts": ("500", "4.4"), "lines": (2, 3)}
    >>> unit_asked(Column("my.csv", "x", "x", "", **cells), 1, LENGTH_UNITS, lambda x: x < 1e-5)
    "is it in um? Then write 'x [um]'"
    """
    parts = number_parts(column.plain_texts[row])
    if parts is None:
        return ""
    number, typed = parts
    own = typed or column.unit or "1"
    for unit in units:
        if to_si(unit) != to_si(own) and is_expected(read_number(number, unit, unit)):
            meant = f"{number} {unit}" if typed else f"{_bare_head(column)} [{unit}]"
            question = "is it no percentage" if unit == "1" else f"is it in {unit}"
            return f"{question}? Then write {quoted(meant)}"
    return ""


def ask_if_far(
    column: Column, numbers: Sequence[float], scale: float, what: str, units: Sequence[str]
) -> None:
    """Raise ValueError with a question, `unit_asked`, if a column without a unit reaches too far.

    numbers: those of the column [SI], which are drawn with some that reach to `scale`, which is
    `what`.
    """
    row = max(range(len(numbers)), key=numbers.__getitem__)
    if numbers[row] <= FAR * scale or column.unit or typed_unit(column.plain_texts[row]):
        return
    if asked := unit_asked(column, row, units, lambda value: value <= FAR * scale):
        times = f"{numbers[row] / scale:.3g} times {what}"
        where = f"{column.file}, line {column.lines[row]}"
        raise ValueError(f"{where}: {quoted(column.head)} is {times}: {asked}")


def _bare_head(column: Column) -> str:
    """Return the head of a column without its unit, in capitals as it is."""
    start = column.head[: len(column.name)]
    return start if start.lower() == column.name else column.name
