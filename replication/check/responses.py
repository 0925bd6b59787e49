"""What a table rests on, and how its numbers respond: each input is made one percent larger.

The exponents of the six numbers tell what an input is:

    target density G^1       resistance H^1       mass, particle density G^-1 H^-1
    step c^1 e^1             radius, diameter D^1, mostly with G^-3 H^-3      velocity V^1
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from reference.units import to_si
from replication.check.fit import CellNumbers, Literals, TableFit, numbers_with
from replication.check.six import first_speed
from replication.check.table import SchemeTable
from spreadsheets.foreign import Position
from spreadsheets.scalars import LiteralKey

FAMILIES = {
    "size": ("radius", "diameter"), "inertia": ("mass", "particle_density"),
    "strength": ("resistance", "beta", "flow_stress"), "target": ("target_density",),
    "step": ("step",), "speed": ("velocity",),
}  # fmt: skip
"""The inputs that respond alike."""
_PLAIN = frozenset({0.0, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 0.5, 0.25, 0.75, 1.5})
"""Numbers that formulas hold by themselves; a power of ten is another."""
_MOST_STEP = 1e-3
"""A power of ten that is typed as a step is smaller, in seconds."""
_NUDGE = 1.01
_MANY = 400
"""So many cells behind a row are looked at."""
_FEW = 64
"""Of larger ranges the cells are not looked at."""

CLOSE = 4e-10
"""The decimal logarithm of a ratio up to which two numbers agree: 1e-9."""
_UNUSUAL = tuple(
    math.log10(float(to_si(unit))) % 1 for unit in ("in", "lb", "psi", "lbf", "gf", "ft")
)
"""The digits of units that are no powers of ten: a cell that states no unit may have one."""

Item = tuple[str, object]
"""What has a unit: a column, by its role; a cell; or a number typed into a formula."""


@dataclass(frozen=True, eq=False)
class Influence:
    """A cell or a typed number that a row rests on, and the exponents of its response."""

    place: Position | None
    literal: LiteralKey | None
    value: float
    powers: Mapping[str, float]
    computed: bool = False

    @property
    def cell(self) -> Position | None:
        """The cell of the number itself; None for one that is typed into a formula."""
        return self.place if self.literal is None else None

    @property
    def item(self) -> Item:
        """What its unit is a unit of."""
        return ("number", self.literal) if self.literal is not None else ("cell", self.place)

    @property
    def name(self) -> str:
        """The defined name that stands for the number, if any."""
        return str(self.literal[0]) if self.literal is not None and len(self.literal) == 2 else ""

    @property
    def family(self) -> str | None:
        """What it may be, by its response."""
        G, H, D, c, e, t, V = (self.powers.get(n, 0.0) for n in "GHDcetV")

        def near(value: float, wanted: float) -> bool:
            return abs(value - wanted) < 0.02

        if not near(V, 0):
            return "speed" if near(V, 1) and near(D, 0) else None
        if not (near(c, 0) and near(e, 0) and near(t, 0)):
            alike = all(near(x, 0) or near(x, 1) for x in (c, e, t))
            return "step" if alike and near(D, 0) else None
        if near(D, 1):
            return "size" if G < 0.5 and H < 0.5 else None
        if not near(D, 0):
            return None
        if near(G, 1) and near(H, 0):
            return "target"
        if near(H, 1) and near(G, 0):
            return "strength"
        if near(G, -1) and near(H, -1):
            return "inertia"
        return "size" if near(G, -3) and near(H, -3) else None


def is_plain(value: float) -> bool:
    """Whether a formula may hold a number by itself: a small one, a power of ten, or pi."""
    if value in _PLAIN or abs(value - math.pi) < 0.01:
        return True
    power = math.log10(abs(value)) if value else 0.0
    return abs(power - round(power)) < 1e-12


@dataclass(frozen=True)
class Trace:
    """What a table rests on outside its lines.

    `cells` says whether they are computed; `numbers` are those typed into formulas, with the cell
    of the formula (None for the number of a name); `blank` are cells that hold nothing.
    """

    cells: Mapping[Position, bool]
    numbers: Mapping[LiteralKey, tuple[float, Position | None]]
    blank: frozenset[Position] = frozenset()


def trace(table: SchemeTable, fitted: TableFit) -> Trace:
    """Follow the formulas of the first rows and of the row that was probed."""
    evaluator, formulas = table.evaluator, table.evaluator.formulas
    starts = [table.place(role, k) for role in table.lines for k in (0, 1) if k in table.rows]
    starts += fitted.probe.state.values() if fitted.probe is not None else ()
    rows = {table.rows[table.places[place][1]] for place in starts}
    helpers = {line.place(i): i for line in table.helpers for i in line.values}
    cells: dict[Position, bool] = {}
    numbers: dict[LiteralKey, tuple[float, Position | None]] = {}
    waiting = [place for place in starts if place in formulas]
    blank: set[Position] = set()
    seen = set(waiting)
    while waiting and len(seen) < _MANY:
        place = waiting.pop()
        numbers.update(_typed_into(place, table))
        for cell in _single_cells(place, table):
            if cell in table.places or (cell in helpers and helpers[cell] not in rows):
                continue
            if cell not in helpers and type(evaluator.values.get(cell)) is float:
                cells[cell] = cell in formulas
            elif cell not in formulas and evaluator.values.get(cell) is None:
                blank.add(cell)
            if cell in formulas and cell not in seen:
                seen.add(cell)
                waiting.append(cell)
    return Trace(cells, numbers, frozenset(blank))


def _single_cells(place: Position, table: SchemeTable) -> Iterator[Position]:
    """The cells that a formula reads, but for those of large ranges."""
    for area in table.evaluator.areas(place):
        if area.cells <= _FEW:
            yield from area.places()


def _typed_into(
    place: Position, table: SchemeTable
) -> Iterator[tuple[LiteralKey, tuple[float, Position | None]]]:
    """The numbers typed into a formula and into the names that it uses."""
    shape = table.evaluator.formulas[place]
    for index, value in enumerate(shape.literals):
        yield (*place, index), (value, place)
    for name, values in shape.names.items():
        for index, value in enumerate(values):
            yield (name, index), (value, None)


def influences(table: SchemeTable, fitted: TableFit) -> list[Influence]:
    """Everything that the table rests on, with its exponents."""
    values, traced = table.evaluator.values, trace(table, fitted)
    numbers = {p: v for p in traced.cells if type(v := values[p]) is float}
    if fitted.probe is None:
        return [Influence(p, None, value, {}, traced.cells[p]) for p, value in numbers.items()]
    base = _all_numbers(table, fitted, {}, {})

    def exponents(cells: CellNumbers, literals: Literals) -> dict[str, float]:
        now = _all_numbers(table, fitted, cells, literals)
        ratios = {n: now.get(n, math.nan) / value for n, value in base.items() if value}
        good = {n: ratio for n, ratio in ratios.items() if 0 < ratio < math.inf}
        return {n: math.log(ratio) / math.log(_NUDGE) for n, ratio in good.items()}

    result = [
        Influence(p, None, value, exponents({p: value * _NUDGE}, {}), traced.cells[p])
        for p, value in numbers.items()
        if math.isfinite(value * _NUDGE) and value
    ]
    result += [Influence(p, None, 0.0, {}) for p, value in numbers.items() if not value]

    def typed(plain: bool) -> list[Influence]:
        some = ((k, *entry) for k, entry in traced.numbers.items() if is_plain(entry[0]) == plain)
        return [Influence(p, k, v, exponents({}, {k: v * _NUDGE})) for k, v, p in some if v]

    result += typed(plain=False)
    stepless = [
        symbol
        for symbol in "cet"
        if symbol in base and all(abs(s.powers.get(symbol, 0.0)) < 0.02 for s in result)
    ]
    return result + (_plain_steps(typed(plain=True), stepless) if stepless else [])


def _plain_steps(plain: Sequence[Influence], stepless: Sequence[str]) -> list[Influence]:
    """The steps among powers of ten that are typed into formulas, such as 1E-9.

    Mostly these convert a unit. Where nothing else gives a column its step, a single one is it.
    """
    steps: list[Influence] = []
    for symbol in stepless:
        own = [s for s in plain if s.value < _MOST_STEP and s.family == "step"]
        own = [s for s in own if abs(s.powers.get(symbol, 0.0) - 1) < 0.02]
        if len(own) == 1 and own[0] not in steps:
            steps += own
    return steps


def _all_numbers(
    table: SchemeTable, fitted: TableFit, cells: CellNumbers, literals: Literals
) -> dict[str, float]:
    """The six numbers and the time step, with some inputs replaced."""
    result = numbers_with(fitted, table, cells, literals)
    if (start := first_speed(table)) is not None:
        cone = table.evaluator.cone([start], ())
        value = table.evaluator.value(start, cells, literals, cone)
        result["V"] = value if type(value) is float else math.nan
    return result


def unit_power(power: float, slack: float, error: float = 0.0) -> float | None:
    """The power of ten between two units, or that of an unusual unit; None if it is neither.

    It may be off by `slack` from a power of ten. Unusual units are many, so that one is taken only
    where a power agrees with it up to the error of the digits.
    """
    near = round(power)
    if abs(power - near) <= slack + 2 * CLOSE:
        return float(near)
    close = max(1e-6, error)
    unusual = any(abs((power - u) - round(power - u)) < close for u in _UNUSUAL)
    return power if unusual else None
