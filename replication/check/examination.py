"""Everything known about one table: its inputs, the scheme its rows follow, its differences."""

import math
from collections.abc import Callable, Mapping, Sequence
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
"""Kinds that are reported without making a workbook faulty."""

NEAR = 1e-12
"""Relative distance up to which a cell agrees with a rule. A rule rounds some twenty times, 2e-15
at worst, and a file saved with 15 digits adds 3e-14. A constant typed with only ten digits differs
by more."""

Change = Callable[[Case], Case] | Mapping[str, Rule]
"""How a difference changes the report's sheet: a function from the intended case to a wrong one, or
other rules for some parts of the scheme (no rules at all if only the stop differs)."""


def near(a: float | Fraction, b: float) -> bool:
    """Whether two numbers agree to nine digits."""
    return math.isclose(a, b, rel_tol=1e-9)


@dataclass(frozen=True)
class Difference:
    """One way in which a workbook departs from the report's sheet.

    `cells` lists every cell concerned, the one to look at first. `rank` sorts differences in the
    order in which their cells are calculated. `effect` is the final depth [m] that this difference
    would give if it were the only one; `change` says how to compute that.
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
        """Return the JSON entry, in which `cells` is a range and `count` the number of cells."""
        sheets, rows, columns = map(set, zip(*self.cells, strict=True))
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
    """One input: its value in SI units, its cell (None if no cell holds it), how it was identified.

    `roles` are the inputs that its label may name, `unit` is the unit that the workbook states, and
    `factor` converts the cell's number to SI units.
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
    """Everything known about one table; `judge` adds to it.

    `rows` holds the table's numbers with the case and the rules that they follow, `intended` the
    case that they should follow. The two cases differ where, for example, the cell of the mass does
    not hold what radius and density give. `powers` are the powers of ten that convert each column
    to SI units; `negative` says that the workbook's decelerations are negative. `read` are all
    cells outside the table that it reads; `derived` are the inputs for mass, diameter and
    resistance; `unread` are labelled inputs that the table does not read. `right_depth` [m] is the
    final depth by the report's scheme with the intended inputs, None if that run does not end.
    `differing` counts the cells that differ from that run, causes and consequences alike.
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
        """The case that the rows actually follow."""
        return self.rows.case

    def following(self, case: Case) -> "Examination":
        """Return a copy of this examination whose rows follow another case."""
        return replace(self, rows=replace(self.rows, case=case))

    def follows(self, part: str, rule: Rule, k: int) -> bool | None:
        """Whether row k follows a rule; None if cells are missing."""
        rows = replace(self.rows, rules=REPORT | {part: rule})
        role, row = rows.shows(part, k)
        wanted, value = rows.wanted(role, row), rows(role, row)
        if wanted is None or value is None:
            return None
        tolerance = NEAR if self.table.digits is None else 10.0 ** (2 - self.table.digits)
        size = abs(wanted)
        if role.startswith("velocity"):
            speed = abs(rows("velocity_initial", k) or 0.0)
            # If no column holds the deceleration, it carries the rounding error of the velocities.
            size = speed if part == "end" else abs(speed - wanted) + 1e-2 * speed
        return abs(value - wanted) <= tolerance * size

    def share(self, part: str, rule: Rule) -> float:
        """Return the share of the complete rows that follow a rule."""
        rows = range(PARTS[part][1], self.table.steps + 1)
        judged = [good for k in rows if (good := self.follows(part, rule, k)) is not None]
        return sum(judged) / len(judged) if judged else 0.0

    def agreement(self, rules: Sequence[Rule] = BRAKES[:2]) -> float:
        """Return the share of rows whose deceleration follows the best-fitting of some rules."""
        return max(self.share("brake", rule) for rule in rules)

    @property
    def final_depth(self) -> float | None:
        """The depth in the last row [m]."""
        return self.rows("depth", self.table.steps)

    def power_shown(self, kind: str, value: float, k: int) -> int | None:
        """Return n if a value is 10^n times the depth of row k, or its "ratio" x/R; else None."""
        depth = self.rows("depth", k) or 0.0
        over = self.case.radius if kind == "ratio" else 1.0
        return power_of_ten(value * over / depth) if depth > 0 else None

    @property
    def ends(self) -> bool:
        """Whether the rows run to the stop, so that there is a final depth."""
        return not any(d.kind == "not calculated" for d in self.differences)

    @property
    def accused(self) -> set[Position]:
        """The cells of all faults found so far."""
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
        """Add a difference; the first of its cells is the one to look at.

        If `found` is not given, it is the value of that cell.
        """
        found = self.calculation.values.get(cells[0]) if found is None else found
        entry = kind, tuple(cells), expected, found, text, self.rank(cells[0]), change
        self.differences.append(Difference(*entry))

    def line(self, part: str) -> Line:
        """Return the column in which a part of the scheme can be seen."""
        return self.table.lines[self.rows.shows(part, 1)[0]]

    @property
    def start(self) -> Position:
        """The cell of the first velocity."""
        return self.table.place(self.table.speed, min(self.rows.columns[self.table.speed]))

    def cells(self, role: str, first: int) -> list[Position]:
        """Return the cells of a column from row `first` to the last row."""
        return [self.table.place(role, k) for k in range(first, max(first, self.table.steps) + 1)]

    def shown(self, role: str, value: float | None) -> float | None:
        """Convert a value from SI units to the unit and the sign of its column."""
        if value is None:
            return None
        sign = -1.0 if role == "deceleration" and self.negative else 1.0
        return sign * scaled(value, Fraction(10) ** -self.powers[role])

    def rank(self, place: Position) -> tuple[float, ...]:
        """Return a key in order of calculation: inputs, the rows one by one, then results."""
        if place in self.table.places:
            role, k = self.table.places[place]
            return (1, k, 9 if role == "time" else list(COLUMNS).index(role))
        for line in self.table.helpers:
            if line.covers(place):
                return (1, (line.index(place) or 0) - self.table.zero, 2.5)
        order = self.calculation.order.get(place, -1)
        return (0 if place in self.read or order < 0 else 2, order)
