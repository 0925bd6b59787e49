"""The report's Excel sheet, row by row (appendix, Eqs. A-1 to A-3; both branches of Eq. 13).

A row's deceleration is taken at the row's middle depth, and at its *initial* velocity or, in the
centered scheme, at the middle velocity that half a step predicts: see `reference.scheme.Scheme`.

The order of operations matters: the workbook's formulas use the same one, so that both give the
same double in every cell. Squares and cubes are written as products (`x * x`, not a power), and a
row's time is `k * dt`, not a running sum.
"""

import html
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from reference.scheme import Scheme
from replication.models.impact import Impact, InputError, particle_mass

if TYPE_CHECKING:
    import pandas as pd


MAX_STEPS = 1_000_000
"""A sheet that needs more steps is refused; Excel has 1,048,576 rows."""


class Row(NamedTuple):
    """One row of the sheet; the names are those of the JSON that `coldspray sheet` prints.

    time [s], velocity_initial [m/s], depth x [m], deceleration [m/s^2] (printed as positive), and
    velocity_final [m/s], which is None (a blank cell) in row 0, the impact itself.
    """

    time: float
    velocity_initial: float
    depth: float
    deceleration: float
    velocity_final: float | None


UNITS = {
    "time": "s",
    "velocity_initial": "m/s",
    "depth": "m",
    "deceleration": "m/s^2",
    "velocity_final": "m/s",
}
"""The SI unit of each field of a row."""


@dataclass(frozen=True, slots=True, repr=False)
class Sheet:
    """The rows of one case, and the results that the report reads from the last one."""

    impact: Impact
    rows: tuple[Row, ...]  # up to a million
    scheme: Scheme = Scheme.PUBLISHED

    def __repr__(self) -> str:
        depth = f"{self.final_depth * 1e6:.6g} um, X/R {self.normalized_depth:.6g}"
        return f"<{self.scheme} sheet, {self.steps} steps of {self.impact.step:g} s: {depth}>"

    def _repr_html_(self) -> str:
        """The sheet as notebooks show it: its first and last rows, with units."""
        heads = [f"{name} [{unit}]" for name, unit in UNITS.items()]
        table = self.frame().set_axis(heads, axis="columns").to_html(max_rows=12)
        return f"<p>{html.escape(repr(self)[1:-1])}</p>{table}"

    @property
    def steps(self) -> int:
        """Number of time steps: all rows but row 0."""
        return len(self.rows) - 1

    @property
    def final_depth(self) -> float:
        """x of the last row [m]: the report's final penetration depth."""
        return self.rows[-1].depth

    @property
    def normalized_depth(self) -> float:
        """X/R [1]."""
        return self.final_depth / self.impact.radius

    def frame(self) -> "pd.DataFrame":
        """Return the sheet as a pandas frame indexed by row, in SI units; row 0's blank is NaN."""
        import pandas as pd

        return pd.DataFrame(self.rows, dtype="float64").rename_axis("row")


def run(impact: Impact, scheme: str = Scheme.PUBLISHED) -> Sheet:
    """Run the report's sheet for one impact, up to the first row below the stop velocity.

    The scheme, a `Scheme` or its text, is "published" if a row's drag is taken at its initial
    velocity v, or "centered" if at its middle velocity, v - a dt/2 with the deceleration a at x and
    v (appendix, Eqs. A-1 to A-3). Raises TypeError if `impact` is not an `Impact`, and ValueError
    for another scheme, or if more than `MAX_STEPS` rows are needed or the last row leaves the range
    of doubles.

    >>> from replication.cases import BETA_5
    >>> sheet = run(BETA_5)
    >>> sheet.steps, f"{sheet.final_depth * 1e6:.2f}"
    (131, '7.67')
    """
    if not isinstance(impact, Impact):
        raise TypeError(f"give an Impact, such as BETA_5, not {impact!r}")
    scheme = Scheme(scheme)
    dt, v_stop = impact.step, impact.stop_velocity
    touch = Row(0.0, impact.velocity, 0.0, 0.0, None)
    below = _rows(
        scheme is Scheme.CENTERED, impact.velocity, impact.radius, impact.particle_density,
        impact.target_density, impact.target_resistance, dt, v_stop,
    )  # fmt: skip
    rows = touch, *map(Row._make, below)
    _, v, x, a, v_final = rows[-1]
    if (v if v_final is None else v_final) >= v_stop:
        raise refusal(math.nan, dt, v_stop)
    if not math.isfinite(x + a + (v_final or 0.0)):  # only the last row can overflow
        raise refusal(math.inf, dt, v_stop)
    return Sheet(impact, rows, scheme)


def last_row(
    velocity: float, radius: float, particle_density: float, target_density: float,
    resistance: float, step: float, stop_velocity: float, centered: bool, depth: Any, steps: Any,
) -> None:  # fmt: skip
    """Fill in the depth x [m] of the sheet's last row and its number: depth[0] and steps[0].

    They are NaN and `MAX_STEPS` + 1 if more than `MAX_STEPS` rows are needed. The inputs are those
    of `run_many`.
    """
    x, v, k = 0.0, velocity, 0
    motion = velocity, radius, particle_density, target_density, resistance
    for row in _rows(centered, *motion, step, stop_velocity):
        k, x, v = k + 1, row[2], row[4]
    depth[0], steps[0] = (math.nan, MAX_STEPS + 1) if v >= stop_velocity else (x, k)


def _rows(
    centered: bool, V: float, R: float, rho_p: float, rho_t: float, R_t: float, dt: float,
    v_stop: float,
) -> Iterator[tuple[float, float, float, float, float]]:  # fmt: skip
    """Yield the rows from row 1 on, with the fields of `Row`.

    If more than `MAX_STEPS` rows are needed, the last one yielded is not below the stop velocity.
    If that is certain from the start, no row is yielded.
    """
    k, x, v, M = 0, 0.0, V, particle_mass(R, rho_p)
    # A row reduces the velocity by a dt at most, a being the deceleration at V and area pi R^2.
    if (V - v_stop) / deceleration(R, V, R, M, rho_t, R_t) / dt > MAX_STEPS:
        k = MAX_STEPS
    while k < MAX_STEPS and v >= v_stop:
        k += 1
        # The first step is a half step, so that x lags half a step behind the final velocity.
        x = v * (dt / 2) if k == 1 else x + v * dt
        a = deceleration(x, v, R, M, rho_t, R_t)
        if centered:
            a = deceleration(x, v - a * (dt / 2), R, M, rho_t, R_t)
        v_final = v - a * dt
        yield k * dt, v, x, a, v_final
        v = v_final


def deceleration(x: float, v: float, R: float, M: float, rho_t: float, R_t: float) -> float:
    """Deceleration [m/s^2] at depth x [m] and velocity v [m/s], positive (Eqs. 12-13, A-1 to A-3).

    R particle radius [m], M its mass [kg], rho_t target density [kg/m^3], R_t resistance [Pa].

    >>> f"{deceleration(5e-8, 500.0, 11e-6, 4.962e-11, 7850.0, 3.5e9):.2E}"
    '3.11E+08'
    """
    area_over_pi = 2 * R * x - x * x if x < R else R * R
    stress = 0.5 * rho_t * v * v + R_t
    return stress * math.pi * area_over_pi / M


def refusal(depth: float, step: float, stop_velocity: float) -> InputError:
    """Return the error for a step that is much too long, or much too short (the depth is NaN)."""
    problem = f"leaves the range of doubles in a step of {step!r} s: take a smaller step"
    if math.isnan(depth):
        steps = f"more than {MAX_STEPS:,} steps of {step!r} s"
        problem = f"takes {steps} down to {stop_velocity!r} m/s: take a larger step"
    return InputError("the sheet", problem)
