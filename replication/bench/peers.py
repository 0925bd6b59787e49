"""What a user would take otherwise, written as a user would.

SciPy's `solve_ivp` finds rest by an event. All others are told when rest comes, and integrate up to
there: nothing that they lack is held against them. All have depth over R and velocity over V, in
units of R / V of time: y' = u and u' = -(b u^2 + c) A(y) (Eqs. 12-13).
"""

import math
from collections.abc import Callable, Iterator
from functools import cache, partial
from typing import Any

import numpy as np

from replication.bench.cases import Case
from replication.bench.methods import STEPS, Task, columns, many

TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 3e-14)
"""Relative and absolute; SciPy takes no relative one below 2.2e-14."""


def peer_tasks(case: Case) -> Iterator[Task]:
    """Every peer at a ladder of settings."""
    drivers = {f"solve_ivp {name}": partial(_solve_ivp, name) for name in SCIPY}
    for name, driver in (drivers | {"odeint, Numba": _odeint, "dop853, Numba": _dop853}).items():
        for tolerance in TOLERANCES:
            yield from _both(name, f"rtol {tolerance:g}", case, partial(driver, tolerance))
    for steps in (100, 200, 400, 800, 1600, 6400):
        yield from _both("RK4, Numba", f"{steps} steps", case, partial(_rk4, steps))
    for tolerance in (1e-6, 1e-10, 2.2e-16):
        yield from _both("heyoka", f"tol {tolerance:g}", case, partial(_heyoka, tolerance))
    yield from _loops(case)


SCIPY = ("RK45", "DOP853", "LSODA", "Radau")


def _both(method: str, setting: str, case: Case, solve: Callable[..., Any]) -> Iterator[Task]:
    """Final depth and history by what gives y at times, for b and c."""
    impact = case.impact
    b = 3 * impact.target_density / (8 * impact.particle_density)
    c = 3 * impact.target_resistance / (4 * impact.particle_density * impact.velocity**2)
    times = case.times * impact.velocity / impact.radius

    def depth() -> float:
        return impact.radius * float(solve(b, c, times[[0, -1]])[-1])

    def history() -> Any:
        return impact.radius * np.asarray(solve(b, c, times))

    compiled = not method.startswith("solve_ivp")
    yield Task(method, setting, "depth", depth, case.depth_error, compiled)
    yield Task(method, setting, "history", history, case.history_error, compiled)


def _solve_ivp(method: str, tolerance: float, b: float, c: float, times: Any) -> Any:
    from scipy.integrate import solve_ivp

    def motion(_: float, state: Any) -> tuple[float, float]:
        y, u = state.tolist()  # Python's floats are several times faster than NumPy's scalars
        return u, -(b * u * u + c) * (y * (2 - y) if y < 1 else 1.0)

    def rest(_: float, state: Any) -> Any:
        return state[1]

    vars(rest).update(terminal=True, direction=-1)  # which is how SciPy is told
    options: Any = {"method": method, "rtol": tolerance, "atol": tolerance, "events": rest}
    if len(times) > 2:
        options["t_eval"] = times
    with np.errstate(all="ignore"):  # of a trial step that went too far, and is rejected
        solved = solve_ivp(motion, (0.0, 2 * times[-1]), (0.0, 1.0), **options)
    if solved.status != 1:
        raise ArithmeticError(f"never at rest: {solved.message}")
    depths = np.full(len(times), solved.y_events[0][0, 0])  # the depth after rest
    if len(times) > 2:
        depths[: solved.t.size] = solved.y[0]
    return depths


def _odeint(tolerance: float, b: float, c: float, times: Any) -> Any:
    from scipy.integrate import odeint

    options: Any = {"tfirst": True, "rtol": tolerance, "atol": tolerance, "mxstep": 100_000}
    return odeint(_equation()[0], (0.0, 1.0), times, args=(b, c), **options)[:, 0]


def _dop853(tolerance: float, b: float, c: float, times: Any) -> Any:
    from scipy.integrate import ode

    solver = ode(_equation()[0]).set_f_params(b, c)
    solver.set_integrator("dop853", rtol=tolerance, atol=tolerance, nsteps=100_000)
    solver.set_initial_value((0.0, 1.0), 0.0)
    return [0.0, *(solver.integrate(time)[0] for time in times[1:].tolist())]


def _rk4(steps: int, b: float, c: float, times: Any) -> Any:
    return _equation()[1](b, c, times, steps // (len(times) - 1))


@cache
def _equation() -> tuple[Any, Any]:
    """The right side, and Runge and Kutta's method with so many steps from one time to the next."""
    from numba import njit

    def acceleration(y: Any, u: Any, b: Any, c: Any) -> Any:
        return -(b * u * u + c) * (y * (2 - y) if y < 1 else 1.0)

    a = njit(acceleration)

    def slope(_: Any, state: Any, b: Any, c: Any) -> Any:
        return np.array((state[1], a(state[0], state[1], b, c)))

    def rk4(b: Any, c: Any, times: Any, steps: Any) -> Any:
        depths, y, u = np.zeros(times.size), 0.0, 1.0
        for k in range(1, times.size):
            h = (times[k] - times[k - 1]) / steps
            for _ in range(steps):
                a1 = a(y, u, b, c)
                u2 = u + h / 2 * a1
                a2 = a(y + h / 2 * u, u2, b, c)
                u3 = u + h / 2 * a2
                a3 = a(y + h / 2 * u2, u3, b, c)
                u4 = u + h * a3
                a4 = a(y + h * u3, u4, b, c)
                y += h / 6 * (u + 2 * u2 + 2 * u3 + u4)
                u += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
            depths[k] = y
        return depths

    return njit(slope), njit(rk4)


def _heyoka(tolerance: float, b: float, c: float, times: Any) -> Any:
    first, beyond = _taylor(tolerance, b, c)
    first.time, first.state[:] = 0.0, (0.0, 1.0)
    if first.with_events:
        first.reset_cooldowns()
    depths = first.propagate_grid(times)[-1][:, 0]
    if len(depths) == len(times):
        return depths
    beyond.time, beyond.state[:] = first.time, first.state
    rest = np.concatenate([[first.time], times[len(depths) :]])
    return np.concatenate([depths, beyond.propagate_grid(rest)[-1][1:, 0]])


@cache
def _taylor(tolerance: float, b: float, c: float) -> tuple[Any, Any]:
    """Integrators for up to y = 1, where the first one stops, and beyond."""
    try:
        import heyoka
    except ImportError as error:
        raise ValueError("not installed: python -m pip install 'coldspray[bench]'") from error
    y, u = heyoka.make_vars("y", "u")
    crosses = math.log1p(b / c) / (2 * b) > 2 / 3
    events: Any = {"t_events": [heyoka.t_event(y - 1)]} if crosses else {}
    first, beyond = (
        heyoka.taylor_adaptive([(y, u), (u, -(b * u * u + c) * area)], tol=tolerance, **more)
        for area, more in ((2 * y - y * y, events), (1.0, {}))
    )
    return first, beyond


def _loops(case: Case) -> Iterator[Task]:
    """Bare loops over cases by Numba, on one core, without any check."""
    impact, stop = case.impact, case.impact.stop_velocity
    yield many("closed form, Numba loop", "no steps", impact, 0.0, 100_001, _compiled(_depths))
    for factor in STEPS:
        step = impact.step * factor
        setting = f"{step * 1e9:.5g} ns"
        sheets = partial(_compiled(_sheets), step, stop)
        yield many("sheet, Numba loop", setting, impact, stop, 1001, sheets)
        alone = partial(sheets, *(column[1:2] for column in columns(impact, 3)))
        error: Any = lambda found: case.depth_error(found[0], at_velocity=stop)  # noqa: E731
        yield Task("sheet, Numba loop", setting, "depth", alone, error, compiled=True)


@cache
def _compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    from numba import njit

    compiled: Callable[..., Any] = njit(function)
    return compiled


def _depths(V: Any, R: Any, rho_p: Any, rho_t: Any, R_t: Any) -> Any:
    depths = np.empty(V.size)
    for i in range(V.size):
        c = 4 * rho_p[i] / (3 * rho_t[i]) * math.log1p(rho_t[i] * V[i] ** 2 / (2 * R_t[i]))
        h = math.asin(math.sqrt(3 * min(c, 2 / 3)) / 2) / 3
        y = 4 * math.sin(h) * math.sin(h + math.pi / 3) if c < 2 / 3 else c + 1 / 3
        depths[i] = R[i] * y
    return depths


def _sheets(dt: float, stop: float, V: Any, R: Any, rho_p: Any, rho_t: Any, R_t: Any) -> Any:
    depths = np.empty(V.size)
    for i in range(V.size):
        v, r, x, part = V[i], R[i], 0.0, dt / 2
        mass = rho_p[i] * 4 / 3 * math.pi * r * r * r
        while v >= stop:
            x, part = x + v * part, dt
            area = 2 * r * x - x * x if x < r else r * r
            v -= (0.5 * rho_t[i] * v * v + R_t[i]) * math.pi * area / mass * dt
        depths[i] = x
    return depths
