"""The report's equations, to any precision, written from the report, not the replica.

Every function takes an arithmetic first: `Reals` (mpmath numbers, 50 digits unless told otherwise)
or `reference.intervals.Intervals` (between Arb's balls), so that a formula stands here once and
serves both. Neither leaves a global precision changed. Quantities are in SI units.
"""

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any, NamedTuple, Protocol

import mpmath

__all__ = [
    "Arithmetic",
    "Number",
    "Reals",
    "Row",
    "cap_volume",
    "centerline_stress",
    "contact_share",
    "crater_normalized_depth",
    "final_depth",
    "frank_zook_diameters",
    "midpoint",
    "particle_velocity",
    "sheet_depth",
]

Number = Any
"""A number of the arithmetic in use: a real (mpmath has no types) or an interval."""


class Arithmetic(Protocol):
    """What the formulas need of numbers, beyond the operators and functions of `context`."""

    def __hash__(self) -> int:
        """As of any object: what was computed in an arithmetic is kept by it."""

    @property
    def context(self) -> Any:
        """Functions of numbers: log, sqrt, exp; and pi, zero and one."""

    def number(self, value: Fraction | int) -> Number:
        """The rational in this arithmetic."""

    def least(self, x: Number, bound: Number) -> Number:
        """min(x, bound)."""

    def greatest(self, x: Number, bound: Number) -> Number:
        """max(x, bound)."""

    def increasing(self, function: Callable[[Any], Any], x: Number) -> Number:
        """The value of a function that is nowhere decreasing."""

    def cap_root(self, c: Number) -> Number:
        """The y in [0, 1] with y^2 - y^3/3 = c; c in [0, 2/3]."""

    def may_be_below(self, x: Number, bound: Number) -> bool:
        """Whether x < bound is possible."""

    def is_below(self, x: Number, bound: Number) -> bool:
        """Whether x < bound is certain."""

    def hull(self, numbers: list[Number]) -> Number:
        """A number that stands for all of them."""


class Reals:
    """mpmath numbers of a given number of decimal digits.

    >>> print(Reals(30).context.pi)
    3.14159265358979323846264338328
    """

    def __init__(self, digits: int = 50) -> None:
        self.context = mpmath.MPContext()
        self.context.dps = digits

    def number(self, value: Fraction | int) -> Number:
        return self.context.mpf(value.numerator) / value.denominator

    def least(self, x: Number, bound: Number) -> Number:
        return min(x, bound)

    def greatest(self, x: Number, bound: Number) -> Number:
        return max(x, bound)

    def increasing(self, function: Callable[[Any], Any], x: Number) -> Number:
        return function(x)

    def cap_root(self, c: Number) -> Number:
        # With y = s sqrt(c) the root s stays in [1, 1.23], however small c is.
        root = self.context.sqrt(c)
        return root * self.context.findroot(lambda s: s * s - root * s**3 / 3 - 1, (1, 1.2))

    def may_be_below(self, x: Number, bound: Number) -> bool:
        return bool(x < bound)

    is_below = may_be_below

    def hull(self, numbers: list[Number]) -> Number:
        (only,) = numbers
        return only


def contact_share(ar: Arithmetic, y: Number) -> Number:
    """Contact area over pi R^2 [1] at normalized depth y = x/R (Eqs. 12-13): 2y - y^2, 1 beyond."""
    return ar.increasing(_share_up_to_one, ar.least(y, ar.context.one))


def _share_up_to_one(y: Any) -> Any:
    return y * (2 - y)


def cap_volume(depth: Fraction, radius: Fraction) -> Fraction:
    """Volume of the crater over pi, the integral of 2 R x - x^2 from 0 to depth, exactly.

    By Simpson's rule, which is exact for a quadratic: independent of Eq. 2, which it checks.

    >>> cap_volume(Fraction(2), Fraction(1))
    Fraction(4, 3)
    """

    def area(x: Fraction) -> Fraction:
        return 2 * radius * x - x * x

    return depth * (area(Fraction(0)) + 4 * area(depth / 2) + area(depth)) / 6


def crater_normalized_depth(ar: Arithmetic, volume_ratio: Number) -> Number:
    """X/R [1] at which the crater has the given share of the particle's volume (Eqs. 2-4).

    CV/PV = y^2 (3 - y) / 4 = (3/4) (y^2 - y^3/3).

    >>> ar = Reals(20)
    >>> print(crater_normalized_depth(ar, ar.number(Fraction(6, 100))))
    0.29803390509065251777
    """
    return ar.cap_root(4 * volume_ratio / 3)


def final_depth(
    ar: Arithmetic,
    velocity: Number,
    radius: Number,
    particle_density: Number,
    target_density: Number,
    resistance: Number,
) -> Number:
    """Depth at rest [m] from the energy integral of Eq. 13, whatever the time step.

    M v dv / (rho_t v^2/2 + R_t) = -A(x) dx gives y^2 - y^3/3 = c up to y = x/R = 1, and one unit
    of c for one unit of y beyond.
    """
    pressure = target_density * velocity * velocity / 2
    c = 4 * particle_density / (3 * target_density) * ar.context.log(1 + pressure / resistance)
    limit = ar.number(Fraction(2, 3))
    beyond = ar.greatest(c - limit, ar.context.zero)
    return radius * (ar.cap_root(ar.least(c, limit)) + beyond)


class Row(NamedTuple):
    """One time step of the sheet: the columns of Table A-1, in SI units."""

    time: Number
    velocity_initial: Number
    depth: Number
    deceleration: Number
    velocity_final: Number


def midpoint(
    ar: Arithmetic,
    velocity: Number,
    radius: Number,
    particle_density: Number,
    target_density: Number,
    resistance: Number,
    step: Number,
    mass: Number | None = None,
    centered: bool = False,
    stop_velocity: Number | None = None,
) -> Iterator[Row]:
    """The rows of the appendix's scheme after row 0 (Eqs. A-1 to A-3).

    x of the first row is V dt/2, later rows add v dt with the row's initial velocity; the
    deceleration belongs to that x and that velocity, or, in the centered variant, to that x and the
    velocity half a step on. The mass is the sphere's unless another is given. It ends with the
    first row that is certain to end below the stop velocity, or never if there is none.
    """
    if mass is None:
        # pi R^2 over the sphere's mass: shorter, so that an uncertain R counts once.
        area_over_mass = 3 / (4 * radius * particle_density)
    else:
        area_over_mass = ar.context.pi * radius * radius / mass

    drag, push = target_density / 2 * area_over_mass, resistance * area_over_mass
    half_step, per_radius = step / 2, 1 / radius

    def deceleration(x: Number, v: Number) -> Number:
        return (drag * v**2 + push) * contact_share(ar, x * per_radius)

    time, x, v = ar.context.zero, velocity * half_step, velocity
    while True:
        time = time + step
        a = deceleration(x, v)
        if centered:
            a = deceleration(x, v - a * half_step)
        v_final = v - a * step
        yield Row(time, v, x, a, v_final)
        v = v_final
        if stop_velocity is not None and ar.may_be_below(v, stop_velocity):
            if ar.is_below(v, stop_velocity):
                return
            # Where a box of inputs is run, only those that have not stopped go on.
            v = ar.greatest(v, stop_velocity)
        x = x + v * step


def sheet_depth(ar: Arithmetic, rows: Iterator[Row], stop_velocity: Number) -> Number:
    """Depth [m] in the first row whose final velocity is below the stop velocity [m/s].

    In interval arithmetic: the hull over every row that may be the first.
    """
    return ar.hull([r.depth for r in rows if ar.may_be_below(r.velocity_final, stop_velocity)])


def particle_velocity(
    ar: Arithmetic, average_velocity: Number, mass: Number, average_mass: Number
) -> Number:
    """V_p = V (m_o / m)^(1/2) [m/s] (Eq. 1)."""
    return average_velocity * ar.context.sqrt(average_mass / mass)


def centerline_stress(target_density: Number, velocity: Number, resistance: Number) -> Number:
    """Sigma [Pa] of Eq. 5 at u = v, where the particle's term is its strength alone (Eq. 6)."""
    return resistance + target_density * velocity**2 / 2


def frank_zook_diameters(
    ar: Arithmetic,
    length_ratio: Number,
    particle_density: Number,
    target_density: Number,
    k_1: Number,
    k_t: Number,
    resistance: Number,
    velocity: Number,
) -> Number:
    """X/D [1] from Eqs. 14 and 15, solved here for the depth in diameters.

    (L rho_p + k_1 rho_t D) v dv/dx = -(k_t rho_t v^2 + R_t); the integral of v dv / (a v^2 + b)
    from 0 to V is ln(1 + a V^2 / b) / (2 a).
    """
    inertia = length_ratio * particle_density + k_1 * target_density
    drag = k_t * target_density
    return inertia * ar.context.log(1 + drag * velocity**2 / resistance) / (2 * drag)
