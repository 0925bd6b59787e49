"""The report's Excel sheet, row by row (appendix, Eqs. A-1 to A-3; both branches of Eq. 13).

Two variants: "published" takes a row's deceleration at the row's middle depth but at its *initial*
velocity, which makes the scheme first order for all its name; "centered" takes it at the middle
velocity too, predicted by half a step, and is second order.

The order of every operation is part of the result: the workbook's formulas use the same one, so
that both give the same double in every cell. Products of three are written out (`x * x`, never a
power), and a row's time is `k * dt`, not a running sum.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from replication import closed_form
from replication.impact import Impact

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt
    import pandas as pd

__all__ = ["MAX_STEPS", "SCHEMES", "Row", "Sheet", "run"]

SCHEMES = ("published", "centered")

MAX_STEPS = 1_000_000
"""More steps than this do not fit an Excel worksheet (1,048,576 rows) with its head."""


class Row(NamedTuple):
    """One row of the sheet; names as in the JSON that `coldspray sheet` prints.

    time [s], velocity_initial [m/s], depth x [m], deceleration [m/s^2] (printed positive), and
    velocity_final [m/s], which is None (a blank cell) in row 0, the impact itself.
    """

    time: float
    velocity_initial: float
    depth: float
    deceleration: float
    velocity_final: float | None


@dataclass(frozen=True, slots=True)
class Sheet:
    """The rows of one case and what the report reads off the last of them."""

    impact: Impact
    rows: tuple[Row, ...]
    scheme: str = "published"

    @property
    def steps(self) -> int:
        """Time steps taken: rows without row 0."""
        return len(self.rows) - 1

    @property
    def final_depth(self) -> float:
        """x of the last row [m]: the report's final penetration depth."""
        return self.rows[-1].depth

    @property
    def normalized_depth(self) -> float:
        """X/R [1]."""
        return self.final_depth / self.impact.radius

    @property
    def warnings(self) -> list[str]:
        """Signs that the step is too long for the motion, each with by how much."""
        last, impact = self.rows[-1], self.impact
        found = []
        if last.velocity_final is not None and last.velocity_final < -impact.stop_velocity:
            share = 100 * -last.velocity_final / impact.velocity
            found.append(
                f"the last step reverses the velocity to {last.velocity_final:.4g} m/s, "
                f"{share:.2g} % of the impact velocity"
            )
        rest = float(closed_form.final_depth(**impact.motion))
        # The report prints three digits; half a unit of the third is at least 5e-4.
        if last.depth > rest * (1 + 5e-4):
            found.append(
                f"the depth exceeds that of the exact solution at rest, {rest:.6g} m, "
                f"by {100 * (last.depth / rest - 1):.3g} %"
            )
        return found

    def arrays(self) -> "dict[str, npt.NDArray[np.float64]]":
        """The columns, each of shape (steps + 1,), float64; the blank of row 0 is NaN."""
        import numpy as np

        columns = zip(*self.rows, strict=True)
        return {
            name: np.array(column, dtype=np.float64)
            for name, column in zip(Row._fields, columns, strict=True)
        }

    def frame(self) -> "pd.DataFrame":
        """The sheet as a pandas frame, indexed by row number, columns in SI units."""
        import pandas as pd

        return pd.DataFrame(self.arrays()).rename_axis("row")


def run(impact: Impact, scheme: str = "published") -> Sheet:
    """Run the report's sheet for one impact, down to the first row that is below the stop velocity.

    `scheme` is one of `SCHEMES`. Raises ValueError when more than `MAX_STEPS` rows would be needed,
    found before the first is computed, from the exact time to the stop velocity.

    >>> from replication.impact import BETA_5
    >>> sheet = run(BETA_5)
    >>> sheet.steps, f"{sheet.final_depth * 1e6:.2f}"
    (131, '7.67')
    """
    if scheme not in SCHEMES:
        raise ValueError(f"there is no scheme {scheme!r}: choose one of {', '.join(SCHEMES)}")
    _refuse_too_many_steps(impact)
    return Sheet(impact, tuple(_rows(impact, scheme == "centered")), scheme)


def _refuse_too_many_steps(impact: Impact) -> None:
    if impact.velocity < impact.stop_velocity or _few_steps(impact):
        return
    time = closed_form.stop_time(**impact.motion, stop_velocity=impact.stop_velocity)
    steps = time / impact.step
    if not steps <= MAX_STEPS:
        raise ValueError(
            f"the sheet would take about {steps:.4g} steps of {impact.step!r} s down to "
            f"{impact.stop_velocity!r} m/s, more than {MAX_STEPS:,}: take a larger step"
        )


def _few_steps(impact: Impact) -> bool:
    """Whether even the stop velocity would reach a depth beyond the final one in `MAX_STEPS`.

    That spares nearly every sheet the exact time, which costs half as much as the rows. The final
    depth is at most R up to c = 2/3, and R (1/3 + c) beyond.
    """
    pressure = 0.5 * impact.target_density * impact.velocity * impact.velocity
    work = impact.particle_density * math.log1p(pressure / impact.target_resistance)
    c = 4 * work / (3 * impact.target_density)
    return impact.radius * (1 + c) <= MAX_STEPS * impact.step * impact.stop_velocity


def _rows(impact: Impact, centered: bool) -> Iterator[Row]:
    dt, v_stop = impact.step, impact.stop_velocity
    x, v = 0.0, impact.velocity
    yield Row(0.0, v, 0.0, 0.0, None)
    k = 0
    while v >= v_stop:
        k += 1
        if k > 1.1 * MAX_STEPS:  # the exact motion is slower than its estimate by a percent at most
            raise ValueError(f"the sheet does not end in {MAX_STEPS:,} steps: take a larger step")
        # The half step to start: x is half a step behind the velocity that closes the row.
        x = v * (dt / 2) if k == 1 else x + v * dt
        a = deceleration(impact, x, v)
        if centered:
            a = deceleration(impact, x, v - a * (dt / 2))
        v_final = v - a * dt
        yield Row(k * dt, v, x, a, v_final)
        v = v_final


def deceleration(impact: Impact, x: float, v: float) -> float:
    """Deceleration [m/s^2] at depth x [m] and velocity v [m/s], positive (Eqs. 12-13, A-1 to A-3).

    >>> from replication.impact import BETA_5
    >>> f"{deceleration(BETA_5, 5e-8, 500.0):.2E}"
    '3.11E+08'
    """
    r = impact.radius
    area_over_pi = impact.diameter * x - x * x if x < r else r * r
    stress = 0.5 * impact.target_density * v * v + impact.target_resistance
    return stress * math.pi * area_over_pi / impact.mass
