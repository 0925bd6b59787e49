"""What a user would take otherwise: SciPy's integrators and mpmath, written as a user would."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import numpy.typing as npt

from replication.bench.cases import Case
from replication.bench.task import Task
from replication.impact import Impact

__all__ = ["MPMATH", "SCIPY", "mpmath_tasks", "scipy_tasks"]

SCIPY = ("RK45", "DOP853", "LSODA", "Radau")
TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 3e-14)
"""Relative ones; SciPy takes none below 2.2e-14."""

MPMATH = ("mpmath quad", "mpmath odefun")
DIGITS = 15

FOREVER = 1.0
"""Seconds to integrate for if rest does not come: 38 million times the report's impact."""


def scipy_tasks(case: Case) -> list[Task]:
    """`solve_ivp` at every tolerance, ended by an event at rest; the history by its `t_eval`."""
    tasks = []
    for method in SCIPY:
        for tolerance in TOLERANCES:
            depth, history = _solvers(case, method, tolerance)
            setting = f"rtol {tolerance:g}"
            tasks += [
                Task(method, setting, "depth", depth, case.depth_error),
                Task(method, setting, "history", history, case.history_error),
            ]
    return tasks


def _solvers(case: Case, method: str, tolerance: float) -> tuple[Callable[[], Any], ...]:
    from scipy.integrate import solve_ivp

    impact = case.impact
    motion = _equation(impact)
    options = {
        "method": method,
        "rtol": tolerance,
        "atol": (tolerance * impact.radius, tolerance * impact.velocity),
        "events": _at_rest(),
    }

    def solve(**more: Any) -> Any:
        with np.errstate(all="ignore"):  # of a trial step that went too far, and is rejected
            found = solve_ivp(motion, (0.0, FOREVER), (0.0, impact.velocity), **options, **more)
        if found.status != 1:
            raise ArithmeticError(f"never at rest: {found.message}")
        return found

    def depth() -> float:
        return float(solve().y_events[0][0, 0])

    def history() -> npt.NDArray[np.float64]:
        found = solve(t_eval=case.times)
        depths = np.full(case.times.shape, found.y_events[0][0, 0])  # the depth after rest
        depths[: found.t.size] = found.y[0]
        return depths

    return depth, history


def _equation(impact: Impact) -> Callable[[float, Any], tuple[float, float]]:
    """Eqs. 12-13 with both branches, their constants multiplied out beforehand."""
    radius = impact.radius
    drag = 3 * impact.target_density / (8 * impact.particle_density * radius)
    push = 3 * impact.target_resistance / (4 * impact.particle_density * radius)

    def motion(_: float, state: Any) -> tuple[float, float]:
        x, v = state.tolist()  # Python's floats are several times faster than NumPy's scalars
        y = x / radius
        share = y * (2 - y) if y < 1 else 1.0
        return v, -(drag * v * v + push) * share

    return motion


def _at_rest() -> Any:
    def rest(_: float, state: Any) -> Any:
        return state[1]

    # Attributes of the function are how SciPy is told that an event ends the integration.
    vars(rest).update(terminal=True, direction=-1)
    return rest


def mpmath_tasks(case: Case) -> list[Task]:
    """15 digits: the separated equation by quadrature, the differential one by Taylor series."""
    from reference.trajectory import Integration, Trajectory

    inputs = [Fraction(value) for value in case.impact.motion.values()]
    tasks = []
    for name, route in zip(MPMATH, (Trajectory, Integration), strict=True):

        def depth(route: Any = route) -> float:
            return float(route(*inputs, digits=DIGITS).final_depth)

        def history(route: Any = route) -> list[float]:
            motion = route(*inputs, digits=DIGITS)
            return [float(motion.depth_at_time(time)) for time in case.times.tolist()]

        setting = f"{DIGITS} digits"
        tasks += [
            Task(name, setting, "depth", depth, case.depth_error),
            Task(name, setting, "history", history, case.history_error),
        ]
    return tasks
