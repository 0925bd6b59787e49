"""A difference between a workbook and the report's sheet, and all that is known about one table."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from replication.check import difference
from replication.check.fit import RightForce, TableFit
from replication.check.roles import Input
from replication.check.six import Six
from replication.check.table import SchemeTable
from replication.check.words import COLUMNS
from replication.models.impact import STOP_VELOCITY
from spreadsheets.foreign import Position, Value
from spreadsheets.scalars import Error

DEPARTURE_KINDS = (
    "stale value", "typed number", "odd formula", "typed constant", "other scheme", "other input",
    "unit", "printed number", "not calculated",
)  # fmt: skip
NO_FAULT = frozenset({"other input", "not calculated"})
"""Kinds that are reported without making a workbook faulty."""


def near(a: float | Fraction, b: float) -> bool:
    """Whether two numbers agree to nine digits."""
    return math.isclose(a, b, rel_tol=1e-9)


class AnotherModelError(ValueError):
    """A table follows another model than the report's. The message says which formula tells."""


@dataclass(frozen=True)
class Departure(difference.Difference):
    """One way in which a workbook departs from the report's sheet.

    `rank` sorts differences in the order in which their cells are calculated.
    """

    rank: tuple[float, ...] = ()


@dataclass
class Examination:
    """Everything known about one table.

    `fitted` holds its six numbers in the units of its columns, `intended` those in SI units that
    its inputs should give. `units` are the decimal logarithms of the units of its columns; `firm`
    says that the workbook states the unit of the depths, or of the radius, and `firm_speed` that it
    states that of the velocities. `inputs`
    are all inputs that are known, `read` all cells outside the table that it rests on. `corrected`
    is an input whose number is in another unit, with its right value. `right_depth` [m] is the
    final depth of the report's scheme with the intended inputs. `stop_row` is the row of the stop
    where rows after it are spare or at rest. `following` are cells that are right by what wrong
    cells should hold. `cut_short`: the rows are the first ones
    of a case of the report, as in an excerpt. `other_inputs` says which inputs are not the
    report's, of rows without formulas, each in a few words.
    """

    table: SchemeTable
    fitted: TableFit
    inputs: dict[str, Input] = field(default_factory=dict)
    units: dict[str, float] = field(default_factory=dict)
    firm: bool = False
    firm_speed: bool = False
    read: frozenset[Position] = frozenset()
    intended: Six | None = None
    stop_velocity: float = STOP_VELOCITY
    right_depth: float | None = None
    ends: bool = True
    stop_row: int | None = None
    cut_short: bool = False
    corrected: tuple[str, float] | None = None
    following: frozenset[Position] = frozenset()
    differences: list[Departure] = field(default_factory=list)
    other_inputs: list[str] = field(default_factory=list)

    def on_own_sheets(self, place: Position) -> bool:
        """Whether a cell is on the sheet of the table, or on one from which it reads.

        A label elsewhere may speak of another table.
        """
        return place[0] in {self.table.sheet, *(sheet for sheet, _, _ in self.read)}

    @property
    def last(self) -> int:
        """The number of the row in which the particle stops, or the last."""
        return self.table.steps if self.stop_row is None else self.stop_row

    @property
    def final_depth(self) -> float | None:
        """The depth in the last row [m]."""
        value = self.table.number("depth", self.last)
        return None if value is None else float(value * 10.0 ** self.units.get("depth", 0.0))

    def right_force(self, off: float | None = None) -> RightForce:
        """The force that the inputs give, as far as cells hold them.

        `off` says how a wrong one is off.
        """
        known = {
            role: entry.si for role, entry in self.inputs.items()
            if entry.place is not None or entry.how == "follows"
        }  # fmt: skip
        density, strength = known.get("target_density"), known.get("resistance")
        D = (
            2 * known["radius"] * 10.0 ** -self.units.get("depth", 0.0)
            if "radius" in known
            else None
        )
        start = "velocity_initial" if "velocity_initial" in self.table.lines else "velocity_final"
        ratio = None
        if density and strength:
            ratio = density / (2 * strength) * 10.0 ** (2 * self.units.get(start, 0.0))
        return RightForce(ratio, D, density, strength, off)

    @property
    def scheme(self) -> str:
        """The names of the ways that are not the report's."""
        names = [way.name if way else "unknown" for way in self.fitted.odd]
        return " and ".join(names) or "the report's"

    def add(
        self, kind: str, cells: Sequence[Position], expected: Value | None, text: str,
        content: Value | None = None,
    ) -> None:  # fmt: skip
        """Add a difference; the first of its cells is the one to look at.

        If `content` is not given, it is the value of that cell.
        """
        value = self.table.evaluator.values.get(cells[0]) if content is None else content
        value = str(value) if isinstance(value, Error) else value
        entry = Departure(kind, tuple(cells), expected, value, text, self.rank(cells[0]))
        self.differences.append(entry)

    def cells(self, role: str, first: int) -> list[Position]:
        """The cells of a column from a row to the last one."""
        return [self.table.place(role, k) for k in sorted(self.table.rows) if k >= first]

    def rank(self, place: Position) -> tuple[float, ...]:
        """A key in order of calculation: inputs, the rows one by one, then results."""
        if place in self.table.places:
            role, k = self.table.places[place]
            return (1, k, 9 if role == "time" else list(COLUMNS).index(role))
        order = self.table.evaluator.order.get(place, -1)
        for line in self.table.helpers:
            along = place[2] if line.across else place[1]
            if place == line.place(along) and along in line.values:
                rows = {index: k for k, index in self.table.rows.items()}
                return (1, rows.get(along, 0), 2.5, order)
        return (0 if place in self.read or order < 0 else 2, order)
