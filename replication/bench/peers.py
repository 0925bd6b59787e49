"""The alternatives to this project's methods, written as a user would write them.

Solvers work with y = x/R, u = v/V and time in units of R/V: y' = u and u' = -(b u^2 + c) A(y)
(Eqs. 12-13). A solver takes its setting, b, c and times, and returns y at these times. SciPy's
`solve_ivp` finds rest by an event; the others integrate up to the given time of rest.
"""

import math
from collections.abc import Callable, Sequence
from functools import cache, partial
from typing import Any

import numba
import numpy as np

Kernel = Callable[..., Any]
njit: Callable[[Kernel], Kernel] = numba.njit  # Numba's own has no type hints


@njit
def _acceleration(y: Any, u: Any, b: Any, c: Any) -> Any:
    return -(b * u * u + c) * (y * (2 - y) if y < 1 else 1.0)


@njit
def _motion_slope(_: Any, state: Any, b: Any, c: Any) -> Any:
    return np.array((state[1], _acceleration(state[0], state[1], b, c)))


def _solve_ivp(method: str, tolerance: float, b: float, c: float, times: Any) -> Any:
    from scipy.integrate import solve_ivp

    def motion(_: float, state: Any) -> tuple[float, float]:
        y, u = state.tolist()  # Python's floats are several times faster than NumPy's scalars
        return u, -(b * u * u + c) * (y * (2 - y) if y < 1 else 1.0)

    def rest(_: float, state: Any) -> Any:
        return state[1]

    vars(rest).update(terminal=True, direction=-1)  # SciPy reads these attributes
    options: Any = {"method": method, "rtol": tolerance, "atol": tolerance, "events": rest}
    wanted = times if len(times) > 2 else None
    with np.errstate(all="ignore"):  # from trial steps that are rejected
        solved = solve_ivp(motion, (0.0, 2 * times[-1]), (0.0, 1.0), t_eval=wanted, **options)
    if solved.status != 1:
        raise ArithmeticError(f"never at rest: {solved.message}")
    final = solved.y_events[0][0, 0]
    before = [] if wanted is None else solved.y[0]
    return np.append(before, [final] * (len(times) - len(before)))


def _odeint(tolerance: float, b: float, c: float, times: Any) -> Any:
    from scipy.integrate import odeint

    options: Any = {"tfirst": True, "rtol": tolerance, "atol": tolerance, "mxstep": 100_000}
    return odeint(_motion_slope, (0.0, 1.0), times, args=(b, c), **options)[:, 0]


def _dop853(tolerance: float, b: float, c: float, times: Any) -> Any:
    from scipy.integrate import ode

    solver = ode(_motion_slope).set_f_params(b, c)
    solver.set_integrator("dop853", rtol=tolerance, atol=tolerance, nsteps=100_000)
    solver.set_initial_value((0.0, 1.0), 0.0)
    return [0.0, *(solver.integrate(time)[0] for time in times[1:].tolist())]


def _runge_kutta(*rows: tuple[float, ...]) -> Kernel:
    """Return the explicit method of a Butcher tableau, with equal steps between the times.

    The arguments are the rows of its matrix but the first, which is empty, and then its weights.
    """
    stages, weights = len(rows), np.array(rows[-1])
    inner = np.array([(*row, *[0.0] * (stages - len(row))) for row in ((), *rows[:-1])])

    @njit
    def solve(steps: Any, b: Any, c: Any, times: Any) -> Any:
        depths, y, u = np.zeros(times.size), 0.0, 1.0
        dy, du = np.zeros(stages), np.zeros(stages)
        steps //= times.size - 1
        for k in range(1, times.size):
            h = (times[k] - times[k - 1]) / steps
            for _ in range(steps):
                for i in range(stages):
                    x, v = y, u
                    for j in range(i):
                        x += h * inner[i, j] * dy[j]
                        v += h * inner[i, j] * du[j]
                    dy[i], du[i] = v, _acceleration(x, v, b, c)
                for i in range(stages):
                    y += h * weights[i] * dy[i]
                    u += h * weights[i] * du[i]
            depths[k] = y
        return depths

    return solve


_RK4 = _runge_kutta((1 / 2,), (0, 1 / 2), (0, 0, 1), (1 / 6, 1 / 3, 1 / 3, 1 / 6))
_RK6 = _runge_kutta(  # Butcher, 1964
    (1 / 3,), (0, 2 / 3), (1 / 12, 1 / 3, -1 / 12), (-1 / 16, 9 / 8, -3 / 16, -3 / 8),
    (0, 9 / 8, -3 / 8, -3 / 4, 1 / 2), (9 / 44, -9 / 11, 63 / 44, 18 / 11, 0, -16 / 11),
    (11 / 120, 0, 27 / 40, 27 / 40, -4 / 15, -4 / 15, 11 / 120),
)  # fmt: skip


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


def crosses_radius(b: float, c: float) -> bool:
    """Return whether y exceeds 1: by Eq. 13 without time, y^2 - y^3/3 is 2/3 there."""
    return math.log1p(b / c) / (2 * b) > 2 / 3


@cache
def _taylor(tolerance: float, b: float, c: float) -> list[Any]:
    """Return an integrator that stops at y = 1, and one for the motion beyond."""
    try:
        import heyoka
    except ImportError as error:
        raise ValueError("not installed: python -m pip install 'coldspray[bench]'") from error
    y, u = heyoka.make_vars("y", "u")
    events: Any = {"t_events": [heyoka.t_event(y - 1)]} if crosses_radius(b, c) else {}
    return [
        heyoka.taylor_adaptive([(y, u), (u, -(b * u * u + c) * area)], tol=tolerance, **more)
        for area, more in ((2 * y - y * y, events), (1.0, {}))
    ]


TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 3e-14)
"""Relative and absolute tolerances; SciPy accepts no relative one below 2.2e-14."""

SOLVERS: dict[str, tuple[str, Sequence[float], Kernel]] = {
    **{
        f"solve_ivp {name}": ("rtol {:g}", TOLERANCES, partial(_solve_ivp, name))
        for name in ("RK45", "DOP853", "LSODA", "Radau")
    },
    "odeint, Numba": ("rtol {:g}", TOLERANCES, _odeint),
    "dop853, Numba": ("rtol {:g}", TOLERANCES, _dop853),
    "RK4, Numba": ("{} steps", (100, 200, 400, 800, 1600, 6400), _RK4),
    "RK6, Numba": ("{} steps", (100, 200, 400), _RK6),
    "heyoka": ("tol {:g}", (1e-6, 1e-10, 2.2e-16), _heyoka),
}
"""For each method: the format of a setting, the settings, and the solver."""


# A bare function, and bare loops over cases on one core, without any checks


def bare_depth(V: float, R: float, rho_p: float, rho_t: float, R_t: float) -> float:
    c = 4 * rho_p / (3 * rho_t) * math.log1p(rho_t * V**2 / (2 * R_t))
    h = math.asin(math.sqrt(3 * min(c, 2 / 3)) / 2) / 3
    y = 4 * math.sin(h) * math.sin(h + math.pi / 3) if c < 2 / 3 else c + 1 / 3
    return R * y


_bare_depth = njit(bare_depth)


@njit
def depth_loop(V: Any, R: Any, rho_p: Any, rho_t: Any, R_t: Any) -> Any:
    depths = np.empty(V.size)
    for i in range(V.size):
        depths[i] = _bare_depth(V[i], R[i], rho_p[i], rho_t[i], R_t[i])
    return depths


@njit
def sheet_loop(dt: float, stop: float, V: Any, R: Any, rho_p: Any, rho_t: Any, R_t: Any) -> Any:
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
