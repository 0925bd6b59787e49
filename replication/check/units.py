"""Whether the six numbers and the cells agree, and the units by which they do.

The numbers have to obey D = 2R, 2GM/pi = rho_t, HM/pi = R_t, M = 4/3 pi R^3 rho_p, R_t = beta Y_t
and c = e = dt, whatever units the columns and cells are in. Where one is broken by a power of ten,
a unit is to blame; the one statement is sought that mends all.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations

from reference.units import same_dimension, to_si
from replication.check.fit import TableFit
from replication.check.responses import Influence, Item, unit_power
from replication.check.roles import Inputs
from replication.check.six import VARIANTS, start_of_row
from replication.check.table import SchemeTable
from replication.check.words import COLUMNS, INPUT_UNITS

_ALIKE = 1e-9
"""The decimal logarithm of a ratio up to which what formulas give is equal."""
_VAGUE = math.log10(1.01)
"""Of numbers without formulas: inputs that are typed beside them may have few digits."""
_TOLD = 0.3
"""A number of which the digits admit a larger part to be wrong is not told at all."""
_MOST_CHANGES = 6
"""So many units that nobody states may have to be found together."""


@dataclass(frozen=True)
class Magnitude:
    """A positive number times powers of units that may be unknown: the number's logarithm.

    `error` is how far that may be off by the digits of what it follows from.
    """

    log: float
    units: Mapping[Item, float] = field(default_factory=dict)
    error: float = 0.0

    def __mul__(self, other: "Magnitude") -> "Magnitude":
        items = dict.fromkeys((*self.units, *other.units))  # in an order that every run has
        powers = {i: self.units.get(i, 0.0) + other.units.get(i, 0.0) for i in items}
        error = self.error + other.error
        return Magnitude(self.log + other.log, {i: n for i, n in powers.items() if n}, error)

    def __pow__(self, power: float) -> "Magnitude":
        powers = {i: n * power for i, n in self.units.items()}
        return Magnitude(self.log * power, powers, self.error * abs(power))

    def __truediv__(self, other: "Magnitude") -> "Magnitude":
        return self * other**-1


def _pure_number(value: float | None, error: float = 0.0) -> Magnitude:
    """A number without a unit and its relative error; its logarithm is NaN if it has none.

    A number that may be wrong by a good part of itself is not told.
    """
    told = value is not None and 0 < value < math.inf and error < _TOLD
    log = math.log10(value) if told and value is not None else math.nan
    return Magnitude(log, error=math.log10(1 + error) if told else math.inf)


def _unit_of(item: Item) -> Magnitude:
    return Magnitude(0.0, {item: 1.0})


def _of_source(source: Influence) -> Magnitude:
    """The quantity in a cell, or typed into a formula."""
    return _pure_number(source.value) * _unit_of(source.item)


@dataclass(frozen=True)
class Balance:
    """Two sides that should be equal: the one over the other, with the units that it contains.

    `slack` is how far the logarithm of their ratio may be from 0, or from a power of ten.
    """

    name: str
    ratio: Magnitude
    slack: float

    @property
    def terms(self) -> Mapping[Item, float]:
        """The units, with their powers."""
        return self.ratio.units

    def residual(self, powers: Mapping[Item, float]) -> float:
        """The logarithm of the ratio, which is 0 if the equation holds; `powers` are the units'."""
        return self.ratio.log + sum(n * powers.get(i, 0.0) for i, n in self.terms.items())

    def holds(self, powers: Mapping[Item, float]) -> bool:
        """Whether both sides are equal, as far as their digits tell."""
        return abs(self.residual(powers)) < self.slack


def equations(table: SchemeTable, fitted: TableFit, inputs: Inputs) -> list[Balance]:
    """The equations between the six numbers and the cells that can be written down."""
    six, errors = fitted.six, fitted.errors
    X, W, A, T = (
        _unit_of(("column", role))
        for role in ("depth", start_of_row(table)[0], "deceleration", "time")
    )
    if "deceleration" not in table.lines:
        A = W**2 / X
    by_time = fitted.ways.get("depth") is VARIANTS["velocity times time"]
    step = math.nan if by_time else six.c  # then the depth grows by no step
    c, e = _pure_number(step, errors.c) * X / W, _pure_number(abs(six.e), errors.e) * W / A
    t = _pure_number(fitted.time, fitted.time_error) * T
    sides = {"c = e": (c, e)} if "deceleration" in table.lines else {}
    if {"velocity_initial", "velocity_final"} <= table.lines.keys():
        ends = (_unit_of(("column", role)) for role in ("velocity_initial", "velocity_final"))
        sides["v = v"] = (next(ends), next(ends))
    sides |= _of_step(table, inputs, c, e, t)
    velocity = inputs.cells.get("velocity")
    if velocity is not None and velocity.powers:
        sides["V"] = (_pure_number(six.V, errors.V) * W, _of_source(velocity))
    G = _pure_number(six.G, errors.G) * A / (W * X) ** 2
    H = _pure_number(six.H, errors.H) * A / X**2
    sides |= _of_force(inputs, _pure_number(six.D, errors.D) * X, G, H)
    least = _ALIKE if fitted.probe is not None else _VAGUE
    ratios = {name: left / right for name, (left, right) in sides.items()}
    balances = [Balance(name, ratio, max(least, ratio.error)) for name, ratio in ratios.items()]
    return [eq for eq in balances if math.isfinite(eq.ratio.log + eq.slack)]


_Sides = dict[str, tuple[Magnitude, Magnitude]]


def _of_step(
    table: SchemeTable, inputs: Inputs, c: Magnitude, e: Magnitude, t: Magnitude
) -> _Sides:
    """The equations of the time step; a cell that a column does not respond to is left out."""
    step = inputs.cells.get("step") or inputs.derived.get("step")
    if step is None or (inputs.how.get("step") == "unread" and step.powers):
        return {"t = c": (t, c)}
    sides = {"c = dt": ("c", c), "e = dt": ("e", e), "t = dt": ("t", t)}
    if "deceleration" not in table.lines:
        del sides["e = dt"]
    by_cell = {
        name: (side, _of_source(step))
        for name, (symbol, side) in sides.items()
        if abs(step.powers.get(symbol, 1.0) - 1) < 0.02
    }
    return by_cell if "t = dt" in by_cell else {**by_cell, "t = c": (t, c)}


def _of_force(inputs: Inputs, D: Magnitude, G: Magnitude, H: Magnitude) -> _Sides:
    """The equations of the sphere and its mass, then those of the target."""
    cells, derived, sides = inputs.cells, inputs.derived, _Sides()
    R = _of_source(cells["radius"]) if "radius" in cells else None
    diameter = cells.get("diameter") or derived.get("diameter")
    if diameter is not None:
        sides["D"] = (D, _of_source(diameter))
        if R is not None:
            sides["diameter"] = (_of_source(diameter), _pure_number(2.0) * R)
    if R is None and diameter is not None and "radius" in derived:
        sides["radius"] = (_of_source(derived["radius"]), _of_source(diameter) / _pure_number(2.0))
        sides["D"] = (D, _pure_number(2.0) * _of_source(derived["radius"]))
        R = _of_source(derived["radius"])
    elif R is not None and "diameter" not in sides:
        sides["D"] = (D, _pure_number(2.0) * R)
    R = R or (_of_source(diameter) if diameter is not None else D) / _pure_number(2.0)
    M, mass = None, cells.get("mass") or derived.get("mass")
    if "particle_density" in cells:
        M = _pure_number(4 / 3 * math.pi) * R**3 * _of_source(cells["particle_density"])
    if mass is not None:
        if M is not None:
            sides["mass"] = (_of_source(mass), M)
        M = _of_source(mass)
    return sides | _of_target(inputs, G, H, M)


def _of_target(inputs: Inputs, G: Magnitude, H: Magnitude, M: Magnitude | None) -> _Sides:
    """The equations of the target's density and its resistance; M is the mass, if it is known."""
    cells, derived, sides = inputs.cells, inputs.derived, _Sides()
    target = cells.get("target_density") or derived.get("target_density")
    if target is not None and M is not None:
        sides["G"] = (_pure_number(2 / math.pi) * G * M, _of_source(target))
    strength, resistance = None, derived.get("resistance") or cells.get("resistance")
    beta = cells.get("beta") or derived.get("beta")
    stress = cells.get("flow_stress") or derived.get("flow_stress")
    if beta is not None and stress is not None:
        strength = _pure_number(beta.value) * _of_source(stress)
        if resistance is not None:
            sides["resistance"] = (_of_source(resistance), strength)
    strength = _of_source(resistance) if resistance is not None else strength
    if strength is not None and M is not None:
        sides["H"] = (H * M / _pure_number(math.pi), strength)
    return sides


# ---- the units by which they hold


def state_units(table: SchemeTable, inputs: Inputs) -> None:
    """Take the units that heads and labels state, if they measure the right quantity."""
    for role, line in table.lines.items():
        if line.unit and line.unit != "1" and same_dimension(line.unit, COLUMNS[role]):
            inputs.powers["column", role] = math.log10(float(to_si(line.unit)))
            inputs.stated["column", role] = line.sure
    for role, source in (*inputs.cells.items(), *inputs.derived.items()):
        _, unit = inputs.label(source)
        if unit and same_dimension(unit, INPUT_UNITS[role]) and INPUT_UNITS[role] != "1":
            inputs.powers[source.item] = math.log10(float(to_si(unit)))
        else:
            inputs.stated.pop(source.item, None)


def right_units(
    balances: Sequence[Balance], inputs: Inputs
) -> tuple[dict[Item, float], list[Item]] | None:
    """Units by which all equations hold, and the stated ones that had to be changed.

    Units that are not stated are free. Of those that are stated, at most one is changed. None if
    no such units exist.
    """
    items = list(dict.fromkeys(item for eq in balances for item in eq.terms))
    texts = {item for item in items if item in inputs.stated and item in inputs.powers}
    free = [item for item in items if item not in inputs.stated]
    if (result := _least_changes(balances, inputs.powers, free)) is not None:
        return result, []
    mends: list[tuple[bool, bool, int, Item, dict[Item, float]]] = []
    for item in items:
        if item in texts:
            changed = _least_changes(balances, inputs.powers, [*free, item])
            if changed is not None:
                power = round(changed.get(item, 0.0) - inputs.powers.get(item, 0.0))
                # What is not stated surely is changed first; units mostly lie a thousand apart. A
                # number that is the report's states no unit by itself, so it is not changed.
                mends.append((inputs.stated[item], power % 3 != 0, len(mends), item, changed))
    if not mends:
        return None
    *_, item, changed = min(mends, key=lambda entry: entry[:3])
    same = changed.get(item, 0.0) == inputs.powers.get(item, 0.0)
    return changed, [] if same else [item]


def _least_changes(
    balances: Sequence[Balance], powers: Mapping[Item, float], free: Sequence[Item]
) -> dict[Item, float] | None:
    """Change as few free units as possible, by powers of ten, so that all equations hold."""
    left, later = _set_apart(balances, powers, free)
    for most in range(_MOST_CHANGES):
        result = _changed(left, powers, free, most)
        if result is not None:
            holds = all(_mend_own(eq, own, result) for eq, own in reversed(later))
            if holds:
                return result
            break
    for most in range(_MOST_CHANGES):  # the units set apart do not fit: all equations at once
        if (result := _changed(balances, powers, free, most)) is not None:
            return result
    return None


_Own = list[tuple[Balance, list[Item]]]


def _set_apart(
    balances: Sequence[Balance], powers: Mapping[Item, float], free: Sequence[Item]
) -> tuple[list[Balance], _Own]:
    """Set equations apart that have a free unit of their own: at the end it makes them hold.

    One that stands there squared or cubed does not: its powers of ten are even, or threes.
    """
    left, later = list(balances), _Own()
    while any(not eq.holds(powers) for eq in left):
        counts: dict[Item, int] = {}
        for eq in left:
            for item in eq.terms:
                counts[item] = counts.get(item, 0) + 1
        alone = (
            (eq, [i for i, n in eq.terms.items() if i in free and counts[i] == 1 and abs(n) == 1])
            for eq in left
        )
        entry = next(((eq, own) for eq, own in alone if own), None)
        if entry is None:
            break
        left.remove(entry[0])
        later.append(entry)
    return left, later


def _mend_own(eq: Balance, own: Sequence[Item], result: dict[Item, float]) -> bool:
    """Make an equation hold by one of its own units; whether that is possible."""
    if eq.holds(result):
        return True
    rest = eq.residual(result)
    for item in own:
        power = unit_power(-rest / eq.terms[item], eq.slack, eq.ratio.error)
        if power is not None:
            result[item] = result.get(item, 0.0) + power
            return True
    return False


def _changed(
    left: Sequence[Balance], powers: Mapping[Item, float], free: Sequence[Item], most: int
) -> dict[Item, float] | None:
    """Change so many free units, so that the equations hold; None if that cannot be done."""
    broken = [eq for eq in left if not eq.holds(powers)]
    items = [item for item in free if any(item in eq.terms for eq in left)]
    for some in combinations(items, most):
        if all(any(item in eq.terms for item in some) for eq in broken):
            changes = _whole_powers(left, powers, some)
            changed = {**powers, **{i: powers.get(i, 0.0) + n for i, n in changes.items()}}
            if len(changes) == most and all(eq.holds(changed) for eq in left):
                return changed
    return None


def _whole_powers(
    left: Sequence[Balance], powers: Mapping[Item, float], some: Sequence[Item]
) -> dict[Item, float]:
    """The powers of ten of some units by which linear equations hold; empty if they do not tell."""
    rows = [
        [*(eq.terms.get(item, 0.0) for item in some), float(-round(eq.residual(powers)))]
        for eq in left
        if any(item in eq.terms for item in some)
    ]
    for i in range(len(some)):
        pivot = max(range(i, len(rows)), key=lambda r: abs(rows[r][i]), default=-1)
        if pivot < 0 or abs(rows[pivot][i]) < 1e-9:
            return {}
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for r, row in enumerate(rows):
            factor = row[i] / rows[i][i] if r != i else 0.0
            rows[r] = [a - factor * b for a, b in zip(row, rows[i], strict=True)]
    return {item: float(round(rows[i][-1] / rows[i][i])) for i, item in enumerate(some)}
