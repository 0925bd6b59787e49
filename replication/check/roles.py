"""What each input is, by how the six numbers respond to it; and whether its unit agrees.

Every cell and every typed number that a row rests on is made one percent larger, and the table is
fitted again. The exponents tell what it is:

    target density G^1       resistance H^1       mass, particle density G^-1 H^-1
    step c^1 e^1             radius, diameter D^1, mostly with G^-3 H^-3      velocity V^1

Labels only tell beta from flow stress and name things. The numbers then have to agree:
D = 2R, 2GM/pi = rho_t, HM/pi = R_t, M = 4/3 pi R^3 rho_p, R_t = beta Y_t, c = e = dt. Where they
differ by a power of ten, a unit is to blame; the one statement is sought that mends all.
"""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from reference.units import same_dimension, to_si
from replication.check.fit import Fit, numbers_with
from replication.check.six import first_speed, start_of_row
from replication.check.table import Table
from replication.check.words import COLUMNS, INPUTS, input_roles, is_unit, unit_in
from spreadsheets.evaluate import Evaluator, LiteralKey, Scalar
from spreadsheets.foreign import Position

FAMILIES = {
    "size": ("radius", "diameter"), "inertia": ("mass", "particle_density"),
    "strength": ("resistance", "beta", "flow_stress"), "target": ("target_density",),
    "step": ("step",), "speed": ("velocity",),
}  # fmt: skip
"""The inputs that respond alike."""
PLAIN = frozenset({0.0, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 0.5, 0.25, 0.75, 1.5})
"""Numbers that formulas hold by themselves; a power of ten is another."""
_NUDGE = 1.01
_MANY = 400
"""So many sources of a row are looked at."""
CLOSE = 4e-10
"""The logarithm of a ratio up to which two numbers agree: 1e-9."""
_SIDEWAYS = 4
"""How far from a number its label may stand."""

Item = tuple[str, object]
"""What has a unit: a column, by its role, or a cell."""


@dataclass(frozen=True)
class Source:
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


@dataclass(frozen=True)
class Input:
    """An input: its value in SI units, its cell, if any, and how it was recognized."""

    role: str
    si: float
    place: Position | None
    how: str
    label: str = ""
    unit: str | None = None
    value: float = math.nan


@dataclass
class Inputs:
    """All that a table rests on.

    `cells` are the typed inputs by role, `derived` the formulas that compute one of them, `sources`
    all that was found. `powers` are decimal logarithms of the units, by item; `stated` says which
    of them the workbook states, and whether surely.
    """

    sources: list[Source]
    cells: dict[str, Source] = field(default_factory=dict)
    derived: dict[str, Source] = field(default_factory=dict)
    powers: dict[Item, float] = field(default_factory=dict)
    stated: dict[Item, bool] = field(default_factory=dict)
    labels: dict[Position, tuple[str, str | None]] = field(default_factory=dict)
    how: dict[str, str] = field(default_factory=dict)

    def label(self, source: Source) -> tuple[str, str | None]:
        """The label of a cell, or the name of a number, and the unit that it states."""
        if source.cell is None:
            return source.name, None
        return self.labels.get(source.cell, ("", None))

    def si(self, role: str) -> float | None:
        """An input in SI units, from its typed cell or else from its formula."""
        source = self.cells.get(role) or self.derived.get(role)
        if source is None:
            return None
        return float(source.value * 10.0 ** self.powers.get(source.item, 0.0))


# ---- labels


def label_of(place: Position, evaluator: Evaluator) -> tuple[str, str | None, bool]:
    """The label of a cell, its unit if one is stated, and whether that is sure.

    The label stands left of the number or above it; a text further left names a row.
    """
    sheet, row, column = place
    values, formulas = evaluator.values, evaluator.formulas

    def text(r: int, c: int) -> str | None:
        value = values.get((sheet, r, c))
        typed = isinstance(value, str) and (sheet, r, c) not in formulas
        return str(value) if typed and str(value).strip() else None

    candidates: list[str] = []
    unit: str | None = None
    right = text(row, column + 1)
    if right and (own := is_unit(right)):
        unit = own
    left = text(row, column - 1)
    above = text(row - 1, column)
    for near in (left, above):
        if near and not is_unit(near):
            candidates.append(near)
    for distance in range(2, _SIDEWAYS + 1):
        for r, c in ((row, column - distance), (row - distance, column)):
            further = text(r, c)
            if further and not is_unit(further) and (r == row or above and is_unit(above)):
                candidates.append(further)
    beyond = values.get((sheet, row, column - 2))
    if unit is None and left and (own := is_unit(left)) and type(beyond) is not float:
        unit = own
    if unit is None and above and (own := is_unit(above)):
        unit = own
    sure = unit is not None
    if right and not candidates and not is_unit(right):
        candidates.append(right)
    named = [c for c in candidates if input_roles(c, unit)]
    label = (named or candidates or [""])[0]
    if unit is None and label and label in (left, above, right):
        unit = unit_in(label)
        sure = bool(unit and re.search(r"[\[(].+[\])]|\bin \S+$| / |/\S+$|, ", label))
    return label, unit, sure


def cell_names(evaluator: Evaluator) -> dict[Position, str]:
    """The defined names of single cells."""
    from spreadsheets.evaluate import parse, shape_key

    first = next(iter(evaluator.book.sheets))
    names = {}
    for name, meaning in evaluator.book.names.items():
        text = f"={meaning.removeprefix('=')}"
        shape = parse(text, first, evaluator.book, shape_key(text, 1, 1))
        if len(shape.references) == 1 and not shape.literals:
            area = shape.references[0].at(1, 1)
            if area.cells == 1 and all(shape.references[0].fixed):
                names[area.sheet, area.top, area.left] = name.rpartition("!")[2]
    return names


# ---- sources


def trace(
    table: Table, fitted: Fit
) -> tuple[dict[Position, bool], dict[LiteralKey, tuple[float, Position | None]]]:
    """The cells outside the lines that the table rests on, and the numbers typed into formulas.

    Of each cell it is said whether it is computed; of each number, which cell holds it.
    """
    evaluator, probe = table.evaluator, fitted.probe
    starts = [table.place(role, k) for role in table.lines for k in (0, 1) if k in table.rows]
    if probe is not None:
        starts += list(probe.state.values())
    inside = set(table.places)
    for line in table.helpers:
        inside |= {line.place(i) for i in line.values}
    cells: dict[Position, bool] = {}
    numbers: dict[LiteralKey, tuple[float, Position | None]] = {}
    waiting = [p for p in starts if p in evaluator.formulas]
    seen = set(waiting)
    own_rows = {table.rows.get(table_k) for _, table_k in (table.places[p] for p in starts)}
    while waiting and len(seen) < _MANY:
        place = waiting.pop()
        shape = evaluator.formulas[place]
        for index, value in enumerate(shape.literals):
            numbers[(*place, index)] = value, place
        for name, values in shape.names.items():
            for index, value in enumerate(values):
                numbers[name, index] = value, None
        for area in evaluator.areas(place):
            if area.cells > 64:
                continue
            for cell in area.places():
                if cell in inside:
                    along = cell[2] if table.across else cell[1]
                    if cell not in table.places and along in own_rows and cell not in seen:
                        seen.add(cell)
                        if cell in evaluator.formulas:
                            waiting.append(cell)
                    continue
                if type(evaluator.values.get(cell)) is float:
                    cells[cell] = cell in evaluator.formulas
                if cell in evaluator.formulas and cell not in seen:
                    seen.add(cell)
                    waiting.append(cell)
    return cells, numbers


def is_plain(value: float) -> bool:
    """Whether a formula may hold a number by itself: a small one, a power of ten, or pi."""
    if value in PLAIN or abs(value - math.pi) < 0.01:
        return True
    power = math.log10(abs(value)) if value else 0.0
    return abs(power - round(power)) < 1e-12


def sources(table: Table, fitted: Fit) -> list[Source]:
    """Everything that the table rests on, with its exponents."""
    evaluator = table.evaluator
    cells, numbers = trace(table, fitted)
    if fitted.probe is None:
        return [Source(p, None, float(evaluator.values[p]), {}, c) for p, c in cells.items()]  # type: ignore[arg-type]
    start = first_speed(table)
    cone = evaluator.cone([start], ()) if start else frozenset()

    def numbers_at(
        replaced: Mapping[Position, Scalar], literals: Mapping[LiteralKey, float]
    ) -> dict[str, float]:
        result = numbers_with(fitted, table, replaced, literals)
        if start is not None:
            value = evaluator.value(start, replaced, literals, cone)
            result["V"] = value if type(value) is float else math.nan
        return result

    base = numbers_at({}, {})

    def exponents(now: Mapping[str, float]) -> dict[str, float]:
        powers = {}
        for name, value in base.items():
            ratio = now.get(name, math.nan) / value if value else math.nan
            if ratio > 0 and math.isfinite(ratio):
                powers[name] = math.log(ratio) / math.log(_NUDGE)
        return powers

    found = []
    for place, computed in cells.items():
        value = float(evaluator.values[place])  # type: ignore[arg-type]
        if value and math.isfinite(value * _NUDGE):
            powers = exponents(numbers_at({place: value * _NUDGE}, {}))
            found.append(Source(place, None, value, powers, computed))
    for key, (value, holder) in numbers.items():
        if not is_plain(value) and unit_power(math.log10(abs(value)), 1e-7) is None:
            powers = exponents(numbers_at({}, {key: value * _NUDGE}))
            found.append(Source(holder, key, value, powers))
    return found


# ---- which is which


def recognize(
    table: Table, fitted: Fit, given: Mapping[str, Position], names: Mapping[Position, str],
    idle: Iterable[Position],
) -> Inputs:  # fmt: skip
    """The inputs of a table; `given` are the cells that the user named, `idle` cells unread."""
    evaluator = table.evaluator
    inputs = Inputs(sources(table, fitted))
    roles_by_label: dict[Position, frozenset[str]] = {}
    for source in inputs.sources:
        if source.place is not None and source.literal is None:
            _label(source.place, evaluator, names, inputs, roles_by_label)
    typed = [s for s in inputs.sources if s.literal is None and not s.computed]
    numbers = [s for s in inputs.sources if s.literal is not None]
    formulas = [s for s in inputs.sources if s.literal is None and s.computed]
    for family, members in FAMILIES.items():
        some = [s for s in typed if s.family == family] or _one_of_each(numbers, family)
        made = [s for s in formulas if s.family == family]
        _assign(family, members, some, made, inputs, roles_by_label, fitted, evaluator)
    taken = {s.cell for s in (*inputs.cells.values(), *inputs.derived.values())}
    for source in (*typed, *formulas):  # by label alone: what its formula does is to be judged
        roles = roles_by_label.get(source.place or ("", 0, 0), frozenset())
        if source.place not in taken and len(roles) == 1 and not _is_factor(source):
            (role,) = roles
            where = inputs.derived if source.computed else inputs.cells
            if role not in inputs.cells and role not in inputs.derived:
                where[role] = source
                inputs.how[role] = "label"
    for place in idle:
        value = evaluator.values.get(place)
        if type(value) is not float:
            continue
        _label(place, evaluator, names, inputs, roles_by_label)
        roles = roles_by_label[place]
        if len(roles) == 1:
            (role,) = roles
            known = inputs.cells.get(role)
            if (known is None or known.cell is None) and role not in inputs.derived:
                inputs.cells[role] = Source(place, None, value, {}, place in evaluator.formulas)
                inputs.how[role] = "unread"
    for role, place in given.items():
        value = evaluator.values.get(place)
        known = next((s for s in inputs.sources if s.place == place and s.literal is None), None)
        _label(place, evaluator, names, inputs, roles_by_label)
        source = known or Source(place, None, float(value), {}, place in evaluator.formulas)  # type: ignore[arg-type]
        inputs.derived.pop(role, None)
        inputs.cells[role] = source
        inputs.how[role] = "--map"
    return inputs


def _one_of_each(numbers: Sequence[Source], family: str) -> list[Source]:
    """The typed numbers of a family, where no cell holds any: each value once."""
    some = {s.value: s for s in numbers if s.family == family}
    return list(some.values()) if len(some) <= 2 else []


def _is_factor(source: Source, family: str = "") -> bool:
    """Whether a cell holds a conversion factor or pi. A beta may be any small number but 1."""
    power = math.log10(abs(source.value))
    if family == "strength":
        return abs(power - round(power)) < 1e-12
    return is_plain(source.value)


def _label(
    place: Position, evaluator: Evaluator, names: Mapping[Position, str], inputs: Inputs,
    roles: dict[Position, frozenset[str]],
) -> None:  # fmt: skip
    """Read the label of a cell, and the unit that it states."""
    if place in roles:
        return
    label, unit, sure = label_of(place, evaluator)
    found = input_roles(label, unit) if label else frozenset()
    if not found and place in names:
        found = input_roles(names[place], unit)
        label = label or names[place]
    roles[place] = found
    inputs.labels[place] = label, unit
    if unit is not None:
        inputs.stated["cell", place] = sure


def _assign(
    family: str, members: Sequence[str], typed: Sequence[Source], made: Sequence[Source],
    inputs: Inputs, roles: Mapping[Position, frozenset[str]], fitted: Fit, evaluator: Evaluator,
) -> None:  # fmt: skip
    """Give the cells of a family their roles."""

    def own(source: Source) -> frozenset[str]:
        if source.name:
            return input_roles(source.name, None) & set(members)
        return roles.get(source.cell or ("", 0, 0), frozenset()) & set(members)

    def put(where: dict[str, Source], role: str, source: Source) -> None:
        if role not in where:
            where[role] = source
            inputs.how[role] = "label" if role in own(source) else "response"

    cells = sorted(typed, key=lambda s: (not own(s), is_plain(s.value), len(s.powers) == 0))
    cells = [s for s in cells if own(s) or not _is_factor(s, family) or len(typed) == 1]
    if family in ("target", "step", "speed"):
        for source in cells:
            put(inputs.cells, members[0], source)
        if not cells and made:
            put(inputs.derived, members[0], made[0])
        return
    if family == "size":
        for source in cells:
            put(inputs.cells, _size(source, own(source), inputs, fitted), source)
        for source in made:
            if _rests_on(source, inputs.cells.get("radius"), evaluator) or "diameter" in own(
                source
            ):
                if _is_alias(source, cells):
                    continue
                put(
                    inputs.derived,
                    "diameter"
                    if "radius" in inputs.cells
                    else _size(source, own(source), inputs, fitted),
                    source,
                )
            elif not cells:
                put(inputs.derived, _size(source, own(source), inputs, fitted), source)
        return
    if family == "inertia":
        radius = inputs.cells.get("radius") or inputs.cells.get("diameter")
        for source in made:
            if radius is not None and _rests_on(source, radius, evaluator):
                if not _is_alias(source, cells):
                    put(inputs.derived, "mass", source)
        cubed = radius is not None and radius.powers.get("H", 0.0) < -1.5
        for source in cells:
            label = own(source)
            role = next(iter(label)) if len(label) == 1 else (
                "particle_density" if cubed or "mass" in inputs.derived else "mass")  # fmt: skip
            put(inputs.cells, role, source)
        return
    if len(cells) == 1 and made and not own(cells[0]):
        cells += _without_effect(made, inputs, evaluator)
    several = len(cells) > 1
    for source in sorted(cells, key=lambda s: s.value):
        label = own(source)
        if len(label) == 1:
            role = next(iter(label))
        elif not several:
            role = "resistance"
        else:
            others = {r for s in cells if s is not source for r in own(s)}
            role = "beta" if "beta" not in inputs.cells and "beta" not in others and (
                source.value < 1e3) else "flow_stress"  # fmt: skip
        put(inputs.cells, role, source)
    if several or {"beta", "flow_stress"} & inputs.cells.keys():
        for source in made:
            if not _is_alias(source, cells) or "resistance" in own(source):
                put(inputs.derived, "resistance", source)
    elif made and not cells:
        put(inputs.derived, "resistance", made[0])
    elif made:
        for source in made:
            if "resistance" in own(source) and "resistance" not in inputs.cells:
                put(inputs.derived, "resistance", source)


def _without_effect(made: Sequence[Source], inputs: Inputs, evaluator: Evaluator) -> list[Source]:
    """The typed cell that a formula for the resistance reads without any effect: in a sum, say.

    Where a product of beta and flow stress was meant, a beta that is added vanishes.
    """
    for source in made:
        assert source.place is not None
        read = {(a.sheet, a.top, a.left) for a in evaluator.areas(source.place) if a.cells == 1}
        still = [
            s for s in inputs.sources
            if s.cell in read and not s.computed and all(abs(p) < 1e-3 for p in s.powers.values())
            and 1 < s.value < 1e3
        ]  # fmt: skip
        if len(still) == 1:
            return still
    return []


def _size(source: Source, label: frozenset[str], inputs: Inputs, fitted: Fit) -> str:
    """Whether a cell is the radius or the diameter: by D = 2R up to a power of ten, or by label."""
    if math.isfinite(fitted.six.D) and fitted.six.D > 0:
        for role, times in (("radius", 2.0), ("diameter", 1.0)):
            power = math.log10(fitted.six.D / (times * abs(source.value)))
            if abs(power - round(power)) < CLOSE and (not label or role in label):
                return role
    if len(label) == 1:
        return next(iter(label))
    if math.isfinite(fitted.six.D) and fitted.six.D > 0:
        power = math.log10(fitted.six.D / abs(source.value))
        return "diameter" if abs(power - round(power)) < 1e-3 else "radius"
    return "radius"


def _rests_on(source: Source, other: Source | None, evaluator: Evaluator) -> bool:
    """Whether the formula of a cell reads another cell, directly or not."""
    if other is None or other.place is None or source.place is None:
        return False
    read = evaluator.cone([source.place], ())
    return any(
        other.place in area.places() for cell in read for area in evaluator.areas(cell)
        if area.cells <= 64
    )  # fmt: skip


def _is_alias(source: Source, others: Sequence[Source]) -> bool:
    """Whether a formula only shows a typed cell that it responds like, perhaps in another unit."""
    for other in others:
        ratio = source.value / other.value
        alike = all(abs(p - other.powers.get(n, 0.0)) < 0.02 for n, p in source.powers.items())
        if alike and ratio > 0 and abs(math.log10(ratio) - round(math.log10(ratio))) < 1e-12:
            return True
    return False


# ---- units


@dataclass(frozen=True)
class Equation:
    """Two sides that should be equal, as logarithms: terms of units, and the rest.

    `slips` are ratios of a right equation to wrong ones that people write, with a name.
    """

    name: str
    terms: Mapping[Item, float]
    rest: float

    def residual(self, powers: Mapping[Item, float]) -> float:
        """The logarithm of the left side over the right side; 0 if they are equal."""
        return self.rest + sum(n * powers.get(item, 0.0) for item, n in self.terms.items())


def equations(table: Table, fitted: Fit, inputs: Inputs) -> list[Equation]:
    """The equations between the six numbers and the cells that can be written down."""
    six = fitted.six
    X, W, A, T = (
        ("column", role) for role in ("depth", start_of_row(table)[0], "deceleration", "time")
    )
    found: list[Equation] = []

    def log(value: float) -> float | None:
        return math.log10(value) if 0 < value < math.inf else None

    def add(name: str, terms: Sequence[tuple[Item, float]], *rest: float | None) -> None:
        if None in rest:
            return
        total: dict[Item, float] = {}
        for item, n in terms:
            total[item] = total.get(item, 0.0) + n
        found.append(Equation(name, {i: n for i, n in total.items() if n}, math.fsum(rest)))  # type: ignore[arg-type]

    def unit(source: Source) -> Item:
        return source.item

    def minus(value: float | None) -> float | None:
        return None if value is None else -value

    has_brake = "deceleration" in table.lines
    a_terms: list[tuple[Item, float]] = [(A, 1.0)] if has_brake else [(W, 2.0), (X, -1.0)]
    c, e, t = log(six.c), log(abs(six.e)), log(fitted.time or 0.0)
    if has_brake and c is not None:
        add("c = e", [(X, 1), (W, -2), (A, 1)], c, minus(e))
    if {"velocity_initial", "velocity_final"} <= table.lines.keys():
        add("v = v", [(("column", "velocity_initial"), 1), (("column", "velocity_final"), -1)], 0.0)
    step = inputs.cells.get("step") or inputs.derived.get("step")
    if step is not None and inputs.how.get("step") != "unread":
        s = minus(log(step.value))
        if abs(step.powers.get("c", 1.0) - 1) < 0.02:
            add("c = dt", [(X, 1), (W, -1), (unit(step), -1)], c, s)
        if has_brake and abs(step.powers.get("e", 1.0) - 1) < 0.02:
            add("e = dt", [(W, 1), (A, -1), (unit(step), -1)], e, s)
        if t is not None and abs(step.powers.get("t", 1.0) - 1) < 0.02:
            add("t = dt", [(T, 1), (unit(step), -1)], t, s)
    elif t is not None:
        add("t = c", [(T, 1), (X, -1), (W, 1)], t, minus(c))
    velocity = inputs.cells.get("velocity")
    if velocity is not None and velocity.powers:
        add("V", [(W, 1), (unit(velocity), -1)], log(six.V), minus(log(velocity.value)))
    D, size = log(six.D), inputs.cells.get("radius")
    diameter = inputs.cells.get("diameter") or inputs.derived.get("diameter")
    radius_terms: list[tuple[Item, float]] | None = None
    radius_rest: float | None = None
    if size is not None:
        radius_terms, radius_rest = [(unit(size), 1)], log(size.value)
        if diameter is not None and diameter.computed:
            add("diameter", [(unit(diameter), 1), (unit(size), -1)],
                log(diameter.value), minus(log(2 * size.value)))  # fmt: skip
            add("D", [(X, 1), (unit(diameter), -1)], D, minus(log(diameter.value)))
        else:
            add("D", [(X, 1), (unit(size), -1)], D, minus(log(2 * size.value)))
    elif diameter is not None:
        radius_terms, radius_rest = [(unit(diameter), 1)], log(diameter.value / 2)
        add("D", [(X, 1), (unit(diameter), -1)], D, minus(log(diameter.value)))
    elif D is not None:
        radius_terms, radius_rest = [(X, 1)], D - math.log10(2)
    mass, density = (
        (inputs.cells.get("mass") or inputs.derived.get("mass")),
        inputs.cells.get("particle_density"),
    )
    mass_terms: list[tuple[Item, float]] | None = None
    mass_rest: float | None = None
    if density is not None and radius_terms is not None and radius_rest is not None:
        mass_terms = [(i, 3 * n) for i, n in radius_terms] + [(unit(density), 1)]
        mass_rest = math.log10(4 / 3 * math.pi) + 3 * radius_rest + (log(density.value) or 0.0)
    if mass is not None:
        if mass_terms is not None and mass_rest is not None:
            add(
                "mass",
                [(unit(mass), 1), *((i, -n) for i, n in mass_terms)],
                log(mass.value),
                -mass_rest,
            )
        mass_terms, mass_rest = [(unit(mass), 1)], log(mass.value)
    target = inputs.cells.get("target_density") or inputs.derived.get("target_density")
    a = [(A, 1.0), (X, -2.0)] if has_brake else [(W, 2.0), (X, -3.0)]
    if target is not None and mass_terms is not None:
        add("G", [*a, (W, -2), *mass_terms, (unit(target), -1)],
            log(six.G), math.log10(2 / math.pi), mass_rest, minus(log(target.value)))  # fmt: skip
    resistance = inputs.derived.get("resistance") or inputs.cells.get("resistance")
    beta, stress = inputs.cells.get("beta"), inputs.cells.get("flow_stress")
    strength: list[tuple[Item, float]] | None = None
    strength_rest: float | None = None
    if beta is not None and stress is not None:
        product = log(beta.value * stress.value)
        if resistance is not None:
            add("resistance", [(unit(resistance), 1), (unit(stress), -1)],
                log(resistance.value), minus(product))  # fmt: skip
        else:
            strength, strength_rest = [(unit(stress), 1)], product
    if resistance is not None:
        strength, strength_rest = [(unit(resistance), 1)], log(resistance.value)
    if strength is not None and mass_terms is not None:
        add("H", [*a, *mass_terms, *((i, -n) for i, n in strength)],
            log(six.H), -math.log10(math.pi), mass_rest, minus(strength_rest))  # fmt: skip
    _ = a_terms
    return found


_UNUSUAL = tuple(
    math.log10(float(to_si(unit))) % 1 for unit in ("in", "lb", "psi", "lbf", "gf", "ft")
)
"""The digits of units that are no powers of ten: a cell that states no unit may have one."""


def _whole(power: float) -> bool:
    return abs(power - round(power)) < 2 * CLOSE


def state_units(table: Table, inputs: Inputs) -> None:
    """Take the units that heads and labels state, if they measure the right quantity."""
    for role, line in table.lines.items():
        item: Item = ("column", role)
        if line.unit and line.unit != "1" and same_dimension(line.unit, COLUMNS[role]):
            inputs.powers[item] = math.log10(float(to_si(line.unit)))
            inputs.stated[item] = line.sure
    for role, source in (*inputs.cells.items(), *inputs.derived.items()):
        item = source.item
        _, unit = inputs.label(source)
        if unit and same_dimension(unit, INPUTS[role]) and INPUTS[role] != "1":
            inputs.powers[item] = math.log10(float(to_si(unit)))
        else:
            inputs.stated.pop(item, None)


def mended(
    found: Sequence[Equation], inputs: Inputs, slack: float
) -> tuple[dict[Item, float], list[Item]] | None:
    """Units by which all equations hold, and the stated ones that had to be changed.

    Units that are not stated are free. Of those that are stated, at most one is changed. None if
    no such units exist.
    """
    powers = dict(inputs.powers)
    items = list(dict.fromkeys(item for eq in found for item in eq.terms))
    free = [item for item in items if item not in inputs.stated]
    if (result := _solve(found, powers, free, slack)) is not None:
        return result, []
    order = sorted((i for i in items if i in inputs.stated), key=lambda i: inputs.stated[i])
    mends = []
    for item in order:
        changed = _solve(found, powers, [*free, item], slack)
        if changed is not None:
            power = changed.get(item, 0.0) - powers.get(item, 0.0)
            mends.append((inputs.stated[item], round(abs(power)) % 3 != 0, item, changed))
    if not mends:
        return None
    _, _, item, changed = min(mends, key=lambda entry: entry[:2])
    return changed, [item]


def _solve(
    found: Sequence[Equation], powers: Mapping[Item, float], free: Sequence[Item], slack: float
) -> dict[Item, float] | None:
    """Change as few free units as possible, by powers of ten, so that all equations hold."""
    left, later = list(found), []
    while True:  # an equation with a free unit of its own can always be made to hold
        counts: dict[Item, int] = {}
        for eq in left:
            for item in eq.terms:
                counts[item] = counts.get(item, 0) + 1
        private = ((eq, [i for i in eq.terms if i in free and counts[i] == 1]) for eq in left)
        own = next(((eq, alone) for eq, alone in private if alone), None)
        if own is None or all(abs(eq.residual(powers)) < slack for eq in left):
            break
        left.remove(own[0])
        later.append(own)
    for most in range(6):
        if (result := _changed(left, dict(powers), list(free), most, slack)) is not None:
            for eq, alone in reversed(later):
                rest = eq.residual(result)
                if abs(rest) < slack:
                    continue
                for item in alone:
                    power = unit_power(-rest / eq.terms[item], slack)
                    if power is not None:
                        result[item] = result.get(item, 0.0) + power
                        break
                else:
                    return None
            return result
    return None


def unit_power(power: float, slack: float) -> float | None:
    """The power of ten between two units, or that of an unusual unit; None if it is neither."""
    near = round(power)
    if abs(power - near) <= slack + 2 * CLOSE:
        return float(near)
    unusual = any(abs((power - u) - round(power - u)) < 1e-6 for u in _UNUSUAL)
    return power if unusual else None


def _changed(
    left: Sequence[Equation], powers: dict[Item, float], free: list[Item], most: int, slack: float
) -> dict[Item, float] | None:
    wrong = [eq for eq in left if abs(eq.residual(powers)) >= slack]
    if not wrong:
        return powers
    # An equation with a single free unit leaves no choice, so that it comes first.
    broken = min(wrong, key=lambda eq: sum(item in eq.terms for item in free))
    if most == 0:
        return None
    rest = broken.residual(powers)
    for item in free:
        n = broken.terms.get(item)
        if not n:
            continue
        power = -rest / n
        if abs(power - round(power)) > slack + 2 * CLOSE or not round(power):
            continue
        changed = {**powers, item: powers.get(item, 0.0) + round(power)}
        result = _changed(left, changed, [i for i in free if i != item], most - 1, slack)
        if result is not None:
            return result
    return None
