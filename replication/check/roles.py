"""What each cell is that a table rests on: by its response; if that leaves a choice, by its label.

Labels tell beta from flow stress and name things in messages. Cells that nothing reads are inputs
only by their label.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from reference.units import same_dimension
from replication.check.fit import TableFit
from replication.check.labels import idle_numbers, label_of
from replication.check.responses import (
    CLOSE,
    FAMILIES,
    Influence,
    Item,
    influences,
    is_plain,
    unit_power,
)
from replication.check.table import SchemeTable
from replication.check.words import input_roles
from spreadsheets.evaluate import Evaluator
from spreadsheets.foreign import Position

_MOST_BETA = 1e3
"""A beta is a small number; a flow stress, in whatever unit, mostly is not."""


@dataclass(frozen=True)
class Input:
    """An input: its value in SI units, its cell, if any, and how it was recognized.

    `error` is the relative error that the digits of the rows admit, where it is solved from these.
    """

    role: str
    si: float
    place: Position | None
    how: str
    label: str = ""
    unit: str | None = None
    value: float = math.nan
    error: float = 0.0


@dataclass
class Inputs:
    """All that a table rests on.

    `cells` are the typed inputs by role, `derived` the formulas that compute one of them, `sources`
    all that was found. `powers` are decimal logarithms of the units, by item; `stated` says which
    of them the workbook states, and whether surely.
    """

    sources: list[Influence]
    cells: dict[str, Influence] = field(default_factory=dict)
    derived: dict[str, Influence] = field(default_factory=dict)
    powers: dict[Item, float] = field(default_factory=dict)
    stated: dict[Item, bool] = field(default_factory=dict)
    labels: dict[Position, tuple[str, str | None]] = field(default_factory=dict)
    how: dict[str, str] = field(default_factory=dict)

    def label(self, source: Influence) -> tuple[str, str | None]:
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


def recognize(
    table: SchemeTable, fitted: TableFit, given: Mapping[str, Position],
    names: Mapping[Position, str],
    idle: Iterable[Position],
) -> Inputs:  # fmt: skip
    """The inputs of a table; `given` are the cells that the user named, `idle` cells unread."""
    inputs = Inputs(influences(table, fitted))
    reader = _Roles(table.evaluator, names, inputs, fitted.six.D)
    reader.by_response()
    reader.by_label()
    for place in idle:
        reader.unread(place)
    for name, value in idle_numbers(table.evaluator).items():
        reader.unused(name, value)
    for role, place in given.items():
        reader.mapped(role, place)
    return inputs


@dataclass
class _Roles:
    """Finds the roles of the sources; `D` is the diameter in the unit of the depths."""

    evaluator: Evaluator
    names: Mapping[Position, str]
    inputs: Inputs
    D: float
    known: dict[Position, frozenset[str]] = field(default_factory=dict)
    parts: set[Position] = field(default_factory=set)

    def roles(self, source: Influence) -> frozenset[str]:
        """The inputs that the label of a cell, or the name of a number, may name."""
        if source.name:
            return input_roles(source.name, None)
        return self.at(source.cell) if source.cell else frozenset()

    def at(self, place: Position) -> frozenset[str]:
        """The inputs that the label of a cell may name; its unit is noted."""
        if place not in self.known:
            label, unit, sure = label_of(place, self.evaluator)
            named = input_roles(label, unit) if label else frozenset()
            if not named and place in self.names:
                named = input_roles(self.names[place], unit)
                label = label or self.names[place]
            self.known[place] = named
            self.inputs.labels[place] = label, unit
            if unit is not None:
                self.inputs.stated["cell", place] = sure
        return self.known[place]

    def put(self, where: dict[str, Influence], role: str, source: Influence) -> None:
        """Give a source a role, unless another one has it."""
        if role not in where:
            where[role] = source
            self.inputs.how[role] = "label" if role in self.roles(source) else "response"

    def by_response(self) -> None:
        """Give each family its cells: typed ones, and formulas that compute one of them."""
        every = [source for source in self.inputs.sources if source.literal is None]
        for source in every:
            self.roles(source)
        single = [source for source in every if source.value]
        assign = {"size": self.size, "inertia": self.inertia, "strength": self.strength}
        for family, members in FAMILIES.items():
            own = [source for source in single if source.family == family]
            typed = self.ordered(own, family, members) or self.numbers(family)
            made = [source for source in own if source.computed]
            if family in assign:
                assign[family](typed, made)
            else:
                for source in typed or made[:1]:
                    where = self.inputs.derived if source.computed else self.inputs.cells
                    self.put(where, members[0], source)

    def ordered(
        self, own: Sequence[Influence], family: str, members: Sequence[str]
    ) -> list[Influence]:
        """The typed cells of a family, those with a label first; without conversion factors."""
        typed = [source for source in own if not source.computed]
        named = {source: bool(self.roles(source) & set(members)) for source in typed}
        kept = [s for s in typed if named[s] or not _is_factor(s, family) or len(typed) == 1]
        return sorted(kept, key=lambda s: (not named[s], is_plain(s.value)))

    def numbers(self, family: str) -> list[Influence]:
        """The numbers of a family that are typed into formulas or names, each value once."""
        literals = (source for source in self.inputs.sources if source.literal is not None)
        some = {source.value: source for source in literals if source.family == family}
        return list(some.values()) if len(some) <= 2 else []

    def size(self, typed: Sequence[Influence], made: Sequence[Influence]) -> None:
        """Give out radius and diameter."""
        cells, derived = self.inputs.cells, self.inputs.derived
        typed, made = self.computed_radius(typed, made)
        for source in typed:
            self.put(cells, self.radius_or_diameter(source), source)
        for source in made:
            named = "diameter" in self.roles(source)
            if self.is_wrong_half(source, typed):
                derived["radius"] = source
                continue
            if named or self.rests_on(source, cells.get("radius")):
                if not _is_alias(source, typed):
                    role = "diameter" if "radius" in cells else self.radius_or_diameter(source)
                    self.put(derived, role, source)
            elif not typed:
                self.put(derived, self.radius_or_diameter(source), source)

    def is_wrong_half(self, source: Influence, typed: Sequence[Influence]) -> bool:
        """Whether a formula for the radius is not half of the only typed cell, a diameter."""
        if self.roles(source) != {"radius"} or len(typed) != 1:
            return False
        (diameter,) = typed
        power = math.log10(abs(source.value / diameter.value) * 2)
        is_diameter = self.roles(diameter) == {"diameter"} and self.rests_on(source, diameter)
        return is_diameter and abs(power - round(power)) > CLOSE

    def computed_radius(
        self, typed: Sequence[Influence], made: Sequence[Influence]
    ) -> tuple[Sequence[Influence], Sequence[Influence]]:
        """Take a radius that is computed from several cells for a typed one, without these."""
        members = {"radius", "diameter"}
        for source in made:
            parts = [s for s in typed if self.rests_on(source, s)]
            several = len(parts) > 1 and not all(self.roles(part) & members for part in parts)
            if several and self.roles(source) & members == {"radius"}:
                left = [s for s in typed if s not in parts]
                self.parts |= {part.cell for part in parts if part.cell is not None}
                return [source, *left], [s for s in made if s is not source]
        return typed, made

    def radius_or_diameter(self, source: Influence) -> str:
        """Which of both a cell is: by D = 2R up to a power of ten, or by its label."""
        label = self.roles(source) & {"radius", "diameter"}
        if 0 < self.D < math.inf:
            for role, times in (("radius", 2.0), ("diameter", 1.0)):
                power = math.log10(self.D / (times * abs(source.value)))
                if abs(power - round(power)) < CLOSE and (not label or role in label):
                    return role
        return next(iter(label)) if len(label) == 1 else "radius"

    def inertia(self, typed: Sequence[Influence], made: Sequence[Influence]) -> None:
        """Give out mass and particle density."""
        cells, derived = self.inputs.cells, self.inputs.derived
        radius = cells.get("radius") or cells.get("diameter")
        typed, made = self.converted(typed, made, radius)
        if made and all(source.cell is None for source in typed):
            self.put(derived, "mass", made[0])  # of numbers that are typed into its formula
            return
        for source in made:
            if self.rests_on(source, radius) and not _is_alias(source, typed):
                self.put(derived, "mass", source)
        cubed = radius is not None and radius.powers.get("H", 0.0) < -1.5
        of_density = cubed or "mass" in derived
        for source in typed:
            label = self.roles(source) & {"mass", "particle_density"}
            unsaid = "particle_density" if of_density else "mass"
            self.put(cells, next(iter(label)) if len(label) == 1 else unsaid, source)

    def converted(
        self, typed: Sequence[Influence], made: Sequence[Influence], radius: Influence | None
    ) -> tuple[Sequence[Influence], Sequence[Influence]]:
        """Take a particle density that is computed, as by a factor in a cell, for a typed one."""
        members = {"mass", "particle_density"}
        if any(self.roles(source) & members for source in typed):
            return typed, made
        for source in made:
            is_density = self.roles(source) & members == {"particle_density"}
            if is_density and not self.rests_on(source, radius):
                left = [s for s in typed if not self.rests_on(source, s)]
                return [source, *left], [s for s in made if s is not source]
        return typed, made

    def strength(self, typed: Sequence[Influence], made: Sequence[Influence]) -> None:
        """Give out resistance, beta and flow stress."""
        cells, derived = self.inputs.cells, self.inputs.derived
        members = set(FAMILIES["strength"])
        made = [source for source in made if not self.has_mass(source)] or made
        for source in made:  # a beta or a flow stress may be computed from other numbers
            label = self.roles(source) & {"beta", "flow_stress"}
            if len(label) == 1:
                own = [s for s in typed if self.rests_on(source, s)]
                if not any(self.roles(s) & members for s in own):
                    self.put(derived, next(iter(label)), source)
                    typed = [s for s in typed if s not in own]
        if len(typed) == 1 and made and not self.roles(typed[0]) & members:
            typed = [*typed, *self.without_effect(made)]
        stresses = [source for source in typed if self.is_stress(source)]
        for source in sorted(typed, key=lambda s: s.value):
            label = self.roles(source) & members
            others = {r for s in typed if s is not source for r in self.roles(s)}
            small = source.value < _MOST_BETA and "beta" not in cells.keys() | others
            small = small and stresses != [source]  # a beta has no unit
            unsaid = "resistance" if len(typed) == 1 else "beta" if small else "flow_stress"
            self.put(cells, next(iter(label)) if len(label) == 1 else unsaid, source)
        known = cells.keys() | derived.keys()
        product = len(typed) > 1 or known & {"beta", "flow_stress"}
        for source in made:
            if source in derived.values():
                continue
            named = "resistance" in self.roles(source)
            if (
                (product and not _is_alias(source, typed))
                or not typed
                or (named and (product or "resistance" not in cells))
            ):
                self.put(derived, "resistance", source)

    def has_mass(self, source: Influence) -> bool:
        """Whether a formula reads a mass, or what the mass rests on: it is no resistance."""
        others = (o for o in self.inputs.sources if o.family in ("inertia", "size"))
        return any(self.rests_on(source, o) for o in others)

    def is_stress(self, source: Influence) -> bool:
        """Whether the label of a cell has a unit of stress beside its words.

        A short word alone may be a unit by chance.
        """
        label, unit = self.inputs.label(source)
        return bool(label) and unit is not None and same_dimension(unit, "Pa")

    def without_effect(self, made: Sequence[Influence]) -> list[Influence]:
        """The typed cell that a formula for the resistance reads without any effect.

        Where a product of beta and flow stress was meant, a beta that is added vanishes.
        """
        for source in made:
            assert source.place is not None
            read = {area.corner for area in self.evaluator.areas(source.place) if area.cells == 1}
            still = [
                s for s in self.inputs.sources
                if s.cell in read and not s.computed and 1 < s.value < _MOST_BETA
                and all(abs(power) < 1e-3 for power in s.powers.values())
            ]  # fmt: skip
            if len(still) == 1:
                return still
        return []

    def rests_on(self, source: Influence, basis: Influence | None) -> bool:
        """Whether the formula of a cell reads another cell, directly or not."""
        if basis is None or basis.cell is None or source.place is None:
            return False
        read = self.evaluator.cone([source.place], ())
        return any(area.covers(basis.cell) for cell in read for area in self.evaluator.areas(cell))

    def by_label(self) -> None:
        """Take cells that respond as no input does for what their labels say: to be judged."""
        cells, derived = self.inputs.cells, self.inputs.derived
        taken = {source.cell for source in (*cells.values(), *derived.values())}
        single = [source for source in self.inputs.sources if source.literal is None]
        for source in sorted(single, key=lambda s: s.computed):
            roles = self.roles(source)
            plain = is_plain(source.value) and source.value != 0
            if source.cell not in taken | self.parts and len(roles) == 1 and not plain:
                (role,) = roles
                if role not in derived and self.gives_way(cells.get(role), source):
                    (derived if source.computed else cells)[role] = source
                    self.inputs.how[role] = "label"

    def gives_way(self, known: Influence | None, labelled: Influence) -> bool:
        """Whether a labelled cell may have a role: nothing has, or a number typed in its place.

        A number in a formula that reads the cell, too, does not stand in its place.
        """
        if known is None or known.cell is not None:
            return known is None
        own = self.evaluator.areas(known.place) if known.place is not None else []
        return labelled.cell is not None and not any(a.covers(labelled.cell) for a in own)

    def unread(self, place: Position) -> None:
        """Take a cell that nothing reads for the input that its label names, if none is known."""
        value, roles = self.evaluator.values.get(place), self.at(place)
        if len(roles) > 1:  # a density that is not the other one
            roles = roles - self.inputs.cells.keys()
        if type(value) is float and len(roles) == 1:
            (role,) = roles
            known = self.inputs.cells.get(role)
            if (known is None or known.cell is None) and role not in self.inputs.derived:
                is_formula = place in self.evaluator.formulas
                self.inputs.cells[role] = Influence(place, None, value, {}, is_formula)
                self.inputs.how[role] = "unread"

    def unused(self, name: str, value: float) -> None:
        """Take a name that nothing uses for the input that it calls, if no cell holds it."""
        roles = input_roles(name, None)
        if len(roles) == 1 and math.isfinite(value):
            (role,) = roles
            known = self.inputs.cells.get(role)
            typed = known is None or (known.cell is None and not known.name)
            if typed and role not in self.inputs.derived:
                self.inputs.cells[role] = Influence(None, (name.upper(), 0), value, {})
                self.inputs.how[role] = "unread"

    def mapped(self, role: str, place: Position) -> None:
        """Take a cell for the input that the user says it is."""
        value = self.evaluator.values.get(place)
        assert type(value) is float
        self.at(place)
        known = next((s for s in self.inputs.sources if s.cell == place), None)
        self.inputs.derived.pop(role, None)
        is_formula = place in self.evaluator.formulas
        self.inputs.cells[role] = known or Influence(place, None, value, {}, is_formula)
        self.inputs.how[role] = "--map"


def _is_factor(source: Influence, family: str) -> bool:
    """Whether a cell holds a conversion factor or pi. A beta may be any small number but 1."""
    power = math.log10(abs(source.value))
    if family == "strength":
        return abs(power - round(power)) < 1e-12
    return is_plain(source.value)


def _is_alias(source: Influence, others: Sequence[Influence]) -> bool:
    """Whether a formula only shows a typed cell that it responds like, perhaps in another unit."""
    for typed in others:
        ratio = source.value / typed.value
        alike = all(abs(p - typed.powers.get(n, 0.0)) < 0.02 for n, p in source.powers.items())
        if alike and ratio > 0 and unit_power(math.log10(ratio), 0.0) is not None:
            return True
    return False
