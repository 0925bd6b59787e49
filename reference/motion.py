"""One impact to any precision: the report's sheet, and the motion without time steps (Eqs. 12-13).

`sheet_rows` is the appendix's scheme over any arithmetic. `Trajectory` separates Eq. 13: the energy
integral gives velocity and depth in closed form, and time by quadrature of dx/v with
x = X (1 - s^2), which removes the square root singularity at rest. SI units throughout.
"""

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from reference.arithmetic import Arithmetic, Number, Reals


class Row(NamedTuple):
    """One time step of the sheet: the columns of Table A-1 but its time, in SI units."""

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
    centered: bool = False,
    stop_velocity: Number | None = None,
    most_rows: int = 5000,
) -> Iterator[Row]:
    """The rows of the appendix's scheme after row 0 (Eqs. A-1 to A-3).

    x of the first row is V dt/2, later rows add v dt with the row's initial velocity; the
    deceleration belongs to that x and that velocity, or, in the centered variant, to that x and the
    velocity half a step on. The mass is the sphere's unless another is given. It ends with the
    first row that is certain to end below the stop velocity. Raises ArithmeticError after
    `most_rows`, by default forty times those of the report.
    """
    if mass is None:
        # pi R^2 over the sphere's mass: shorter, so that an uncertain R counts once.
        area_over_mass = 3 / (4 * radius * particle_density)
    else:
        area_over_mass = ar.pi * radius * radius / mass

    drag, push = target_density / 2 * area_over_mass, resistance * area_over_mass
    half_step, per_radius, unity = step / 2, 1 / radius, ar.number(1)

    def deceleration(x: Number, v: Number) -> Number:
        # Eqs. 12-13: the contact area over pi R^2 is 2y - y^2, and 1 beyond y = x/R = 1.
        return (drag * v**2 + push) * ar.contact_share(ar.least(x * per_radius, unity))

    x, v = velocity * half_step, velocity
    for _ in range(most_rows):
        a = deceleration(x, v)
        if centered:
            a = deceleration(x, v - a * half_step)
        v_final = v - a * step
        yield Row(v, x, a, v_final)
        v = v_final
        below = stop_velocity is not None and ar.below(v, stop_velocity)
        if below:
            return
        if below is None:  # where a box of inputs is run, only those that have not stopped go on
            v = ar.greatest(v, stop_velocity)
        x = x + v * step
    raise ArithmeticError(f"the sheet does not end in {most_rows} rows")


def sheet_depth(ar: Arithmetic, centered: bool, stop_velocity: Number, **inputs: Number) -> Number:
    """Depth [m] in the first row whose final velocity is below the stop velocity [m/s].

    In interval arithmetic: the hull over every row that may be the first. Inputs as of the rows.
    """
    rows = sheet_rows(ar, centered=centered, stop_velocity=stop_velocity, **inputs)
    return ar.hull(
        [row.depth for row in rows if ar.below(row.velocity_final, stop_velocity) is not False]
    )


class Trajectory:
    """The motion by the separated equation.

    With y = x/R and the time in units of R/V, the acceleration is -(drag u^2 + push) (2y - y^2) for
    the velocity u = v/V; the area factor is 1 beyond y = 1. `final_depth` [m] is that at rest.

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
        self.drag = self.reals.number(3 * target_density / (8 * particle_density))
        self.push = self.reals.number(3 * resistance / (4 * particle_density * velocity**2))
        self._final = self._depth_of(self.context.log1p(self.drag / self.push) / (2 * self.drag))
        self.final_depth = self.radius * self._final

    def _depth_of(self, c: Number) -> Number:
        """y after a given work c: y^2 - y^3/3 = c up to y = 1, and one y for one c beyond."""
        return self.reals.cap_root(c) if 3 * c < 2 else c + self.context.mpf(1) / 3

    def _velocity(self, short: Number) -> Number:
        """u = v/V where the depth is short of the final one by `short` radii."""
        deep = self.reals.greatest(self._final - 1, self.context.zero)
        work = short  # from there to rest, without cancellation
        if short > deep:
            y, rest = min(self._final, self.context.one), short - deep
            work = deep + rest * (2 * y - y * y - rest * (1 - y) - rest * rest / 3)
        gained = self.context.expm1(2 * self.drag * work)
        return self.context.sqrt(self.push / self.drag * gained)

    def velocity_at_depth(self, depth: Number) -> Number:
        """Velocity [m/s] at a depth [m], which must not exceed the final one."""
        return self.velocity * self._velocity(self._final * self._left(depth))

    def _left(self, depth: Number) -> Number:
        """The share of the final depth that is still ahead at a depth [m]."""
        left = 1 - self.context.convert(depth) / self.final_depth
        if not -8 * self.context.eps <= left <= 1:
            raise ValueError(f"the particle never gets to a depth of {depth} m")
        return self.reals.greatest(left, self.context.zero)

    def depth_at_velocity(self, velocity: Number) -> Number:
        """Depth [m] at which the velocity has fallen to a value [m/s]; only its square counts."""
        u = self.context.convert(velocity) / self.velocity
        if abs(u) > 1:
            raise ValueError(f"the particle never has a velocity of {velocity} m/s")
        lost = (1 - u) * (1 + u) * self.drag / (self.push + self.drag * u * u)
        return self.radius * self._depth_of(self.context.log1p(lost) / (2 * self.drag))

    def time_to_depth(self, depth: Number) -> Number:
        """Time [s] to a depth [m], which must not exceed the final one."""
        start, final = self.context.sqrt(self._left(depth)), self._final
        if start >= 1:
            return self.context.zero
        # The integrand is cut at the radius, and often enough for its steep growth.
        cuts = int(self.context.log1p(self.drag / self.push) / 2) + 1
        edges = [self.context.mpf(k) / cuts for k in range(1, cuts + 1)]
        if final > 1:
            edges.append(self.context.sqrt(1 - 1 / final))
        panels = [start, *sorted(edge for edge in edges if edge > start)]
        slowness = self.context.quad(
            lambda s: 2 * final * s / self._velocity(final * s * s), panels
        )
        return self.radius / self.velocity * slowness

    def stop_time(self, stop_velocity: Number = 0) -> Number:
        """Time [s] until the velocity has fallen to the stop velocity [m/s], 0 for rest."""
        return self.time_to_depth(self.depth_at_velocity(stop_velocity))
