"""What is known of one table: its inputs, the scheme that its rows follow, its differences."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

from replication.check.scheme import BRAKES, PARTS, REPORT, Case, Rows, Rule
from replication.check.table import Line, Table, address, span
from replication.check.words import COLUMNS, count, power_of_ten, scaled
from spreadsheets.foreign import Position, Value

KINDS = (
    "stale value", "typed number", "odd formula", "typed constant", "operation order",
    "other scheme", "other input", "unit", "printed number", "not calculated",
)  # fmt: skip
NO_FAULT = frozenset({"other input", "not calculated"})
"""Kinds that are said, and leave a workbook clean."""

NEAR = 1e-12
"""Relative distance below which a cell follows a rule. A rule rounds some twenty times, 2e-15 at
worst; a file saved with 15 digits adds 3e-14; a constant typed with ten digits is beyond."""

Change = Callable[[Case], Case] | Mapping[str, Rule]
"""What a difference makes of the report's sheet: another case, or other rules for some parts; none
at all where only the stop is another."""


def near(a: float | Fraction, b: float) -> bool:
    """Whether two numbers are the same to nine digits."""
    return math.isclose(a, b, rel_tol=1e-9)


@dataclass(frozen=True)
class Difference:
    """One way in which a workbook parts from the report's sheet.

    `cells` are all that it concerns, the first of them the one to look at. `rank` orders
    differences as their cells are calculated. `effect` is the final depth [m] that this difference
    alone would give, by the `change` that it makes.
    """

    kind: str
    cells: tuple[Position, ...]
    expected: Value | None
    found: Value | None
    explanation: str
    rank: tuple[float, ...]
    change: Change | None = field(default=None, compare=False)
    effect: float | None = None

    @property
    def place(self) -> Position:
        """The cell to look at."""
        return self.cells[0]

    def record(self) -> dict[str, Any]:
        """As JSON has it; `cells` is the range that it concerns, `count` how many cells."""
        sheets, rows, columns = (set(each) for each in zip(*self.cells, strict=True))
        area = (max(rows) - min(rows) + 1) * (max(columns) - min(columns) + 1)
        cells = span(cell[1:] for cell in self.cells)
        if len(self.cells) != area or len(sheets) > 1:
            cells = f"{address(self.place)} and {count(len(self.cells) - 1, 'cell')} more"
        values = self.expected, self.found
        expected, found = (str(x).upper() if isinstance(x, bool) else x for x in values)
        return {
            "sheet": self.place[0], "cell": address(self.place), "kind": self.kind,
            "expected": expected, "found": found, "explanation": self.explanation,
            "cells": cells, "count": len(self.cells), "final_depth": self.effect,
        }  # fmt: skip


@dataclass(frozen=True)
class Input:
    """One input: its value in SI, its cell (None if no cell holds it) and how it is known.

    `roles` is what its label allows, `unit` what the workbook says, `factor` what the cell's number
    was multiplied by.
    """

    role: str
    si: float
    place: Position | None
    how: str
    label: str = ""
    unit: str | None = None
    factor: Fraction = Fraction(1)
    roles: frozenset[str] = frozenset()


@dataclass
class Examination:
    """What is known of a table; more of it as it is judged.

    `rows` are those of the table with the case and the rules that they follow, `intended` is the
    case that they should: the two differ where a cell for mass, diameter or resistance does not
    hold what its own inputs give. `powers` of ten lie between its columns and SI units. `negative`:
    decelerations are negative in the workbook. `read` are all cells outside the table that it
    reads; `derived` those that hold mass, diameter or resistance; `unread` labelled inputs that it
    does not read. `right_depth` [m] is that of the report's scheme with the table's inputs, None if
    it does not end. `differing` counts the cells that differ from that run, causes and consequences
    alike.
    """

    table: Table
    inputs: Mapping[str, Input]
    rows: Rows
    intended: Case
    powers: Mapping[str, int]
    negative: bool
    read: frozenset[Position] = frozenset()
    derived: Mapping[str, Input] = field(default_factory=dict)
    unread: tuple[Input, ...] = ()
    differences: list[Difference] = field(default_factory=list)
    right_depth: float | None = None
    differing: int = 0

    def __post_init__(self) -> None:
        self.calculation = self.table.calculation

    @property
    def case(self) -> Case:
        """The case that the rows follow."""
        return self.rows.case

    def following(self, case: Case) -> "Examination":
        """The same table whose rows follow another case."""
        return replace(self, rows=replace(self.rows, case=case))

    def followed(self, part: str, rule: Rule, numbers: Iterable[int]) -> Iterator[bool | None]:
        """Whether each of some rows follows a rule; None where cells are missing."""
        rows = replace(self.rows, rules=REPORT | {part: rule})
        near = NEAR if self.table.digits is None else 10.0 ** (2 - self.table.digits)
        for k in numbers:
            role, at = rows.shows(part, k)
            wanted, value = rows.wanted(role, at), rows(role, at)
            if wanted is None or value is None:
                yield None
                continue
            size = abs(wanted)
            if role.startswith("velocity"):
                speed = abs(rows("velocity_initial", k) or 0.0)
                # Where no column holds the deceleration, the velocities' own rounding is in it.
                size = speed if part == "end" else abs(speed - wanted) + 1e-2 * speed
            yield abs(value - wanted) <= near * size

    def follows(self, part: str, rule: Rule, k: int) -> bool | None:
        """Whether a row follows a rule; None where cells are missing."""
        return next(self.followed(part, rule, [k]))

    def share(self, part: str, rule: Rule) -> float:
        """Which share of its rows follows a rule."""
        each = self.followed(part, rule, range(PARTS[part][1], self.table.steps + 1))
        judged = [good for good in each if good is not None]
        return sum(judged) / len(judged) if judged else 0.0

    def agreement(self, rules: Sequence[Rule] = BRAKES[:2]) -> float:
        """Which share of the rows brakes as its depth and velocity say, by the best of rules."""
        return max(self.share("brake", rule) for rule in rules)

    @property
    def final_depth(self) -> float | None:
        """The depth in the last row [m]."""
        return self.rows("depth", self.table.steps)

    def power_shown(self, kind: str, value: float, k: int) -> int | None:
        """The power of ten times which a value is the depth of row k, or its ratio to the radius.

        None if it is not.
        """
        depth = self.rows("depth", k) or 0.0
        over = self.case.radius if kind == "ratio" else 1.0
        return power_of_ten(value * over / depth) if depth > 0 else None

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
        expected: Value | None,
        text: str,
        found: Value | None = None,
        change: Change | None = None,
    ) -> None:
        """Add a difference that concerns some cells, the first of them the one to look at.

        What is `found` is what that cell holds, unless something else is given.
        """
        shown = self.calculation.values.get(cells[0]) if found is None else found
        fault = kind, tuple(cells), expected, shown, text, self.rank(cells[0]), change
        self.differences.append(Difference(*fault))

    def line(self, part: str) -> Line:
        """The column that shows a part of the scheme."""
        return self.table.lines[self.rows.shows(part, 1)[0]]

    @property
    def start(self) -> Position:
        """The cell of the first velocity."""
        return self.table.place(self.table.speed, min(self.rows.columns[self.table.speed]))

    def cells(self, role: str, first: int) -> list[Position]:
        """The cells of a column from a row on."""
        return [self.table.place(role, k) for k in range(first, max(first, self.table.steps) + 1)]

    def shown(self, role: str, value: float | None) -> float | None:
        """A value in SI as its column holds it, in the column's unit and with its sign."""
        if value is None:
            return None
        sign = -1.0 if role == "deceleration" and self.negative else 1.0
        return sign * scaled(value, Fraction(10) ** -self.powers[role])

    def rank(self, place: Position) -> tuple[float, ...]:
        """When a cell is calculated: inputs, then row by row, then what rests on the table."""
        if place in self.table.places:
            role, k = self.table.places[place]
            return (1, k, 9 if role == "time" else list(COLUMNS).index(role))
        for line in self.table.helpers:
            if line.covers(place):
                return (1, (line.index(place) or 0) - self.table.zero, 2.5)
        order = self.calculation.order.get(place, -1)
        return (0 if place in self.read or order < 0 else 2, order)
