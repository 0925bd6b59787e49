"""What has been found out about one table so far: its setting, its scheme, its differences."""

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from replication.check.inputs import Setting
from replication.check.scheme import Case, Rule, Rules
from replication.check.table import Line, runs
from replication.check.words import COLUMNS, scaled
from spreadsheets.foreign import Position

KINDS = (
    "stale value", "typed number", "odd formula", "typed constant", "operation order",
    "other scheme", "other input", "unit", "printed number", "not calculated",
)  # fmt: skip
NO_FAULT = frozenset({"other input", "not calculated"})
"""Kinds that are said, and leave a workbook clean."""

Text = float | str | None


@dataclass(frozen=True)
class Difference:
    """One way in which a workbook parts from the report's sheet, at one place.

    `cells` are all that it concerns, the first of them `place`. `rank` orders differences as their
    cells are calculated. `effect` is the final depth [m] that this difference alone would give,
    `change` what it makes of the report's scheme: another case or other rules.
    """

    place: Position
    kind: str
    expected: Text
    found: Text
    explanation: str
    cells: tuple[Position, ...]
    rank: tuple[float, ...]
    effect: float | None = None
    change: Callable[[Case], Case] | Mapping[str, Rule] | None = field(default=None, compare=False)


def rank(place: Position, setting: Setting) -> tuple[float, ...]:
    """When a cell is calculated: inputs first, then row by row, then what rests on the table."""
    table = setting.table
    if place in table.places:
        role, k = table.places[place]
        return (1, k, 9 if role == "time" else list(COLUMNS).index(role))
    for line in table.helpers:
        if line.covers(place):
            return (1, (line.index(place) or 0) - table.zero, 2.5)
    order = table.calculation.order.get(place, -1)
    return (0 if place in setting.read or order < 0 else 2, order)


class Verdict:
    """What is found out about one table.

    `setting` becomes what the workbook really does, as that is learnt. `right_depth` [m] is that of
    the report's scheme with the table's inputs, None if it does not end. `differing` counts the
    cells that differ from that run, causes and consequences alike.
    """

    def __init__(self, setting: Setting) -> None:
        self.setting, self.table = setting, setting.table
        self.calculation = setting.table.calculation
        self.differences: list[Difference] = []
        self.right_depth: float | None = None
        self.differing = 0

    @property
    def final_depth(self) -> float | None:
        """The depth in the last row [m]."""
        return self.setting.rows("depth", self.table.steps)

    @property
    def rules(self) -> Rules:
        """The scheme that the rows follow."""
        return self.setting.rows.rules

    @property
    def ends(self) -> bool:
        """Whether the rows go down to the stop."""
        return not any(d.kind == "not calculated" for d in self.differences)

    @property
    def accused(self) -> set[Position]:
        """The cells that a fault concerns already."""
        faults = (d for d in self.differences if d.kind not in NO_FAULT)
        return {cell for fault in faults for cell in fault.cells}

    def add(
        self,
        kind: str,
        cells: Sequence[Position],
        expected: Text,
        text: str,
        found: Text = None,
        change: Callable[[Case], Case] | Mapping[str, Rule] | None = None,
    ) -> None:
        """Add a difference that concerns some cells, the first of them the one to look at.

        What is `found` is what that cell holds, unless something else is given.
        """
        held = self.calculation.values.get(cells[0])
        if found is None and held is not None:
            found = str(held).upper() if isinstance(held, bool) else held
        if isinstance(expected, float) and not math.isfinite(expected):
            expected = None
        order = rank(cells[0], self.setting)
        self.differences.append(
            Difference(cells[0], kind, expected, found, text, tuple(cells), order, None, change)
        )

    def cells(self, role: str, first: int, last: int | None = None) -> list[Position]:
        """The cells of a column from a row on."""
        last = self.table.steps if last is None else last
        return [self.table.place(role, k) for k in range(first, max(first, last) + 1)]

    def shown(self, role: str, value: float | None) -> float | None:
        """A value in SI as its column holds it, in the column's unit and with its sign."""
        if value is None:
            return None
        sign = -1.0 if role == "deceleration" and self.setting.negative else 1.0
        return sign * scaled(value, Fraction(10) ** -self.setting.powers[role])

    def literals(self, line: Line) -> set[float]:
        """The numbers typed into a column's formulas."""
        formulas = (line.formula(self.table.zero + k) for k in range(self.table.steps + 1))
        return {abs(number) for formula in formulas if formula for number in formula.literals}


def joined(found: Sequence[Difference], across: bool) -> Iterator[Difference]:
    """Differences of single cells; those of neighbours with the same kind and cause as one."""
    at = {d.place: d for d in found}
    number = r"\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"
    causes = {p: (d.kind, re.sub(number, "#", d.explanation)) for p, d in at.items()}
    for run in runs(causes, across):
        yield replace(at[run[0]], cells=tuple(run))
