"""One impact, to any precision: the report's sheet, and the exact motion (Eqs. 12 and 13).

`sheet_rows` is the scheme of the report's appendix in any arithmetic. `Trajectory` separates
Eq. 13: its energy integral gives the velocity and the depth in closed form. The time is the
integral of dx/v, by quadrature with x = X (1 - s^2), which removes the square-root singularity at
rest. All quantities are in SI units.
"""

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from reference.arithmetic import Arithmetic, Number, Reals
from reference.scheme import Scheme


class Row(NamedTuple):
    """One time step of the sheet: the columns of Table A-1 except the time, in SI units."""

    velocity_initial: Number
    depth: Number
    deceleration: Number
    velocity_final: Number


def sheet_rows(
    ar: Arithmetic,
    velocity: Number,
    radius: Number,
    particle_density: Number,
    target_density: Number,
    resistance: Number,
    step: Number,
    mass: Number | None = None,
    scheme: Scheme = Scheme.PUBLISHED,
    stop_velocity: Number | None = None,
    most_rows: int = 5000,
) -> Iterator[Row]:
    """Yield the rows of the appendix's scheme after row 0 (Eqs. A-1 to A-3).

    The depth is V dt/2 in the first row and increases by v dt in every later one, where v is the
    row's initial velocity. The deceleration is taken at that depth and that velocity or, in the
    centered scheme, at that depth and the velocity half a step later. The mass is the sphere's
    unless another is given. The last row is the first whose final velocity is certainly below the
    stop velocity. Raises ArithmeticError after `most_rows`, by default 40 times the report's.
    """
    if mass is None:
        # pi R^2 over the sphere's mass, reduced: an interval for R then widens it only once.
        area_over_mass = 3 / (4 * radius * particle_density)
    else:
        area_over_mass = ar.pi * radius * radius / mass

    is_centered = scheme is Scheme.CENTERED
    inertial, strength = target_density / 2 * area_over_mass, resistance * area_over_mass
    half_step, per_radius, unity = step / 2, 1 / radius, ar.number(1)

    def deceleration(x: Number, v: Number) -> Number:
        # Eqs. 12-13: the contact area over pi R^2 is 2y - y^2 up to y = x/R = 1, and 1 beyond.
        return (inertial * v**2 + strength) * ar.contact_share(ar.least(x * per_radius, unity))

    x, v = velocity * half_step, velocity
    for _ in range(most_rows):
        a = deceleration(x, v)
        if is_centered:
            a = deceleration(x, v - a * half_step)
        v_final = v - a * step
        yield Row(v, x, a, v_final)
        v = v_final
        below = stop_velocity is not None and ar.below(v, stop_velocity)
        if below:
            return
        if below is None:  # only those inputs of a box go on that have not reached the stop
            v = ar.greatest(v, stop_velocity)
        x = x + v * step
    raise ArithmeticError(f"the sheet does not end in {most_rows} rows")


def sheet_depth(ar: Arithmetic, scheme: Scheme, stop_velocity: Number, **inputs: Number) -> Number:
    """Return the depth [m] in the first row whose final velocity is below the stop velocity [m/s].

    In interval arithmetic it is the hull of the depths in all rows that may be that row. The other
    inputs are those of `sheet_rows`.
    """
    rows = sheet_rows(ar, scheme=scheme, stop_velocity=stop_velocity, **inputs)
    return ar.hull(
        [row.depth for row in rows if ar.below(row.velocity_final, stop_velocity) is not False]
    )


class Trajectory:
    """The exact motion, from the separated Eq. 13.

    With y = x/R, u = v/V and time in units of R/V, the acceleration is
    du/dt = -(inertial u^2 + strength) A(y): the stress is an inertial part, rho_t v^2 / 2, and the
    target's strength, R_t. The contact area over pi R^2 is A(y) = 2y - y^2 up to y = 1, and 1
    beyond; its integral from 0 to y is called the area integral. `final_depth` [m] is the depth at
    rest. A depth or a velocity that the particle never has raises ValueError.

    >>> motion = Trajectory(*map(Fraction, ("500", "11e-6", "8900", "7850", "35e8")), digits=20)
    >>> print(motion.context.nstr(motion.final_depth * 10**6, 12))
    7.67493292603
    >>> print(motion.context.nstr(motion.stop_time() * 10**9, 12))
    26.0792337824
    """

    def __init__(
        self,
        velocity: Fraction,
        radius: Fraction,
        particle_density: Fraction,
        target_density: Fraction,
        resistance: Fraction,
        *,
        digits: int = 50,
    ) -> None:
        self.reals = Reals(digits + 20)  # guard digits
        self.context = self.reals.context
        self.velocity, self.radius = self.reals.number(velocity), self.reals.number(radius)
        self.inertial = self.reals.number(3 * target_density / (8 * particle_density))
        self.strength = self.reals.number(3 * resistance / (4 * particle_density * velocity**2))
        self._final = self._depth_of(
            self.context.log1p(self.inertial / self.strength) / (2 * self.inertial)
        )
        self.final_depth = self.radius * self._final

    def _depth_of(self, c: Number) -> Number:
        """Return y where the area integral is c.

        The root of y^2 - y^3/3 = c up to y = 1 (c = 2/3), else c + 1/3.
        """
        return self.reals.cap_root(c) if 3 * c < 2 else c + self.context.mpf(1) / 3

    def _velocity(self, left: Number) -> Number:
        """Return u = v/V at the depth that is `left` radii short of the final depth."""
        beyond = self.reals.greatest(self._final - 1, self.context.zero)  # radii with A = 1
        area_integral = left  # from this depth to the final one, in a form without cancellation
        if left > beyond:
            y, rest = min(self._final, self.context.one), left - beyond
            area_integral = beyond + rest * (2 * y - y * y - rest * (1 - y) - rest * rest / 3)
        gained = self.context.expm1(2 * self.inertial * area_integral)
        return self.context.sqrt(self.strength / self.inertial * gained)

    def velocity_at_depth(self, depth: Number) -> Number:
        """Return the velocity [m/s] at a depth [m]."""
        return self.velocity * self._velocity(self._final * self._left(depth))

    def _left(self, depth: Number) -> Number:
        """Return the fraction of the final depth that is left at a depth [m]."""
        left = 1 - self.context.convert(depth) / self.final_depth
        if not -8 * self.context.eps <= left <= 1:  # the final depth itself may be rounded
            raise ValueError(f"the particle never gets to a depth of {depth} m")
        return self.reals.greatest(left, self.context.zero)

    def depth_at_velocity(self, velocity: Number) -> Number:
        """Return the depth [m] at which the velocity has fallen to a value [m/s]."""
        u = self.context.convert(velocity) / self.velocity
        if abs(u) > 1:
            raise ValueError(f"the particle never has a velocity of {velocity} m/s")
        lost = (1 - u) * (1 + u) * self.inertial / (self.strength + self.inertial * u * u)
        return self.radius * self._depth_of(self.context.log1p(lost) / (2 * self.inertial))

    def time_to_depth(self, depth: Number) -> Number:
        """Return the time [s] to reach a depth [m]."""
        start, final = self.context.sqrt(self._left(depth)), self._final
        if start >= 1:
            return self.context.zero
        # More panels for a steeper integrand, and an edge at y = 1, where A(y) is not smooth.
        count = int(self.context.log1p(self.inertial / self.strength) / 2) + 1
        edges = [self.context.mpf(k) / count for k in range(1, count + 1)]
        if final > 1:
            edges.append(self.context.sqrt(1 - 1 / final))
        panels = [start, *sorted(edge for edge in edges if edge > start)]
        time = self.context.quad(lambda s: 2 * final * s / self._velocity(final * s * s), panels)
        return self.radius / self.velocity * time

    def stop_time(self, stop_velocity: Number = 0) -> Number:
        """Return the time [s] until the velocity has fallen to the stop velocity [m/s]."""
        return self.time_to_depth(self.depth_at_velocity(stop_velocity))
