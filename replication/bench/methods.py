"""The cases that are timed, this project's methods, and what a user would take otherwise.

The latter are written as a user would. SciPy's `solve_ivp` finds rest by an event. The other
solvers are told when rest comes, and integrate up to there: nothing that they lack is held against
them. All have depth over R and velocity over V, in units of R / V of time: y' = u and
u' = -(b u^2 + c) A(y) (Eqs. 12-13). A solver takes its setting, b, c and times, and gives y there.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, partial
from itertools import product
from typing import Any, Literal

import numba
import numpy as np
import numpy.typing as npt

from reference.arithmetic import Number
from reference.motion import Trajectory
from replication.cases import BETA_5, changed
from replication.error.hard_cases import HARD_CASES
from replication.error.ladder import exact_motion
from replication.models import arrays, motion
from replication.models.impact import Impact
from replication.models.sheet import SCHEMES, run

Function = Callable[..., Any]
njit: Callable[[Function], Function] = numba.njit  # which has no types

Measure = Literal["depth", "history"]
MEASURES: dict[Measure, str] = {"depth": "final depth", "history": "history"}
"""What is asked of a method, and the title of that."""

CASES = {
    "beta-5": "the report's beta-5",
    "beta-3": "the report's beta-3",
    "crossing": "depth just above R",
    "shallow": "slow, 1 m/s",
    "hypervelocity": "hypervelocity, 1e4 m/s",
}
"""Names for the command line, and which of the hard cases they are."""

POINTS = 101
"""Times of a history, first and last included."""


@dataclass(frozen=True, slots=True)
class Case:
    """One case with its exact motion.

    `times` [s], shape (POINTS,), run from the impact to rest; `depths` [m] are the exact ones.
    """

    name: str
    impact: Impact
    motion: Trajectory
    times: npt.NDArray[np.float64]
    depths: tuple[Number, ...]

    def columns(self, count: int) -> list[Any]:
        """The inputs of so many cases, their velocities within 10 % of this one in the middle."""
        spread = 0.1 * (count > 1) * np.linspace(-1, 1, count)
        velocity, *others = (np.full(count, value) for value in self.impact.motion.values())
        return [velocity * (1 + spread), *others]

    def error(self, measure: Measure, answer: Any, stop: float = 0.0) -> float:
        """The worst relative error of depths [m], measured down to a velocity [m/s], 0 for rest.

        Of a "depth", these are the final ones of `columns`, of which eleven are compared; of a
        "history", those at `times`, relative to the depth at rest; where there is a row for each of
        `columns`, the middle one is. Of several results, as of depth and velocity, the first is.
        """
        computed = np.atleast_1d(answer[0] if isinstance(answer, tuple) else answer)
        if measure == "depth":
            some = np.unique(np.linspace(0, len(computed) - 1, 11, dtype=int))
            velocities = self.columns(len(computed))[0][some].tolist()
            motions = [exact_motion(replace(self.impact, velocity=v)) for v in velocities]
            exact = wholes = [motion.depth_at_velocity(stop) for motion in motions]
            computed = computed[some]
        else:
            end = self.motion.depth_at_velocity(stop)
            exact = [depth for depth in self.depths if stop == 0 or depth <= end]
            wholes = [self.motion.final_depth] * len(exact)
            computed = (computed if computed.ndim == 1 else computed[len(computed) // 2])[
                : len(exact)
            ]
        terms = zip(map(self.motion.context.mpf, computed.tolist()), exact, wholes, strict=True)
        return float(np.max([float(abs(depth - true) / whole) for depth, true, whole in terms]))


def build(name: str) -> Case:
    """One of `CASES`. Raises ValueError for another name.

    >>> case = build("beta-5")
    >>> f"{case.times[-1] * 1e9:.3f} ns", f"{case.error('depth', 7.67e-6):.1e}"
    ('26.079 ns', '6.4e-04')
    """
    if name not in CASES:
        raise ValueError(f"there is no case {name!r} to time: choose of {', '.join(CASES)}")
    impact = changed(BETA_5, HARD_CASES[CASES[name]])
    motion = exact_motion(impact)
    times, depths = zip(*(_instant(motion, k) for k in range(POINTS)), strict=True)
    return Case(name, impact, motion, np.array(times), depths)


def _instant(motion: Trajectory, k: int) -> tuple[float, Number]:
    """The k-th time as a double, and the exact depth at that very double.

    Time is found for a depth, a single quadrature, where depth for a time would take a dozen.
    Depths X (1 - s^2) with s falling evenly are about evenly spaced in time. What rounding the time
    to a double leaves out, 1e-16 of the motion, one Taylor step makes up for but for 1e-32.
    """
    s = motion.reals.number(Fraction(POINTS - 1 - k, POINTS - 1))
    depth = motion.final_depth * (1 - s * s)
    exact = motion.time_to_depth(depth)
    time = float(exact)
    return time, depth + motion.velocity_at_depth(depth) * (motion.context.mpf(time) - exact)


# The methods

STEPS = (16.0, 4.0, 1.0, 1 / 4, 1 / 16, 1 / 64)
"""Of the sheet, over that of the case."""

_BASES = ("closed form", "Taylor series", *(f"sheet, {scheme}" for scheme in SCHEMES))
OURS = {"Taylor series, plain Python", *_BASES, *(f"{method}, many" for method in _BASES)}


@dataclass(frozen=True, slots=True)
class Task:
    """A method at a setting: `run` answers what `measure` asks, down to a velocity `stop` [m/s].

    A run does `cases` cases at once. Where it is `compiled`, the first run takes that long, too.
    """

    method: str
    setting: str
    measure: Measure
    run: Callable[[], Any]
    stop: float = 0.0
    cases: int = 1
    compiled: bool = False


def tasks(case: Case) -> Iterator[Task]:
    """Every method at every setting: this project's, solvers of the equation, and bare loops."""
    given, stop = tuple(case.impact.motion.values()), case.impact.stop_velocity
    steps = [(step, f"{step * 1e9:.5g} ns") for step in (case.impact.step * f for f in STEPS)]
    for scheme, (step, setting) in product(SCHEMES, steps):
        name, impact = f"sheet, {scheme}", replace(case.impact, step=step)
        yield Task(name, setting, "depth", partial(_rows, impact, scheme, None), stop)
        yield Task(name, setting, "history", partial(_rows, impact, scheme, case.times), stop)
        sheets = partial(arrays.run_many, step=step, stop_velocity=stop, scheme=scheme)
        yield _many(name, setting, case, sheets, 1001, stop)
    yield Task("closed form", "no steps", "depth", partial(arrays.final_depth, *given))
    yield _many("closed form", "no steps", case, arrays.final_depth, 100_001)
    series = partial(Task, setting="order 20", measure="history")
    yield series("Taylor series, plain Python", run=partial(_plain_history, case.times, given))
    alone = partial(arrays.history, case.times, *given)
    yield series("Taylor series", run=alone, compiled=True)
    columns = [column[:, None] for column in case.columns(1001)]
    many = partial(arrays.history, case.times, *columns)
    yield series("Taylor series, many", run=many, cases=1001, compiled=True)

    for method, (form, levels, solve) in SOLVERS.items():
        for level in levels:
            yield from _solver(case, method, form.format(level), partial(solve, level))
    yield _many("closed form, Numba loop", "no steps", case, _depth_loop, 100_001)
    for step, setting in steps:
        name, loop = "sheet, Numba loop", partial(_sheet_loop, step, stop)
        yield _many(name, setting, case, loop, 1001, stop)
        alone = partial(loop, *case.columns(1))
        yield Task(name, setting, "depth", alone, stop, compiled=True)


def _many(name: str, setting: str, case: Case, work: Function, count: int, stop: float = 0) -> Task:
    work = partial(work, *case.columns(count))
    return Task(f"{name}, many", setting, "depth", work, stop, count, compiled=True)


def _rows(impact: Impact, scheme: str, times: Any) -> Any:
    """The depths of the rows between which the times lie, on straight lines; or the last.

    The scheme's x stands in the middle of its row, half a step before the time printed there.
    """
    rows = run(impact, scheme).rows
    if times is None:
        return rows[-1].depth
    middles = [0.0, *(row.time - impact.step / 2 for row in rows[1:])]
    return np.interp(times, middles, [row.depth for row in rows])


def _plain_history(times: Any, given: tuple[float, ...]) -> list[float]:
    depth, speed = [0.0] * len(times), [0.0] * len(times)
    motion.history(times.tolist(), *given, depth=depth, speed=speed)  # type: ignore[misc]
    return depth


def _solver(case: Case, method: str, setting: str, solve: Function) -> Iterator[Task]:
    """Final depth and history by what gives y at times, for b and c."""
    impact, R = case.impact, case.impact.radius
    b = 3 * impact.target_density / (8 * impact.particle_density)
    c = 3 * impact.target_resistance / (4 * impact.particle_density * impact.velocity**2)
    times = case.times * impact.velocity / R
    ends = times[[0, -1]]
    task = partial(Task, method, setting, compiled=not method.startswith("solve_ivp"))
    yield task("depth", lambda: R * float(solve(b, c, ends)[-1]))
    yield task("history", lambda: R * np.asarray(solve(b, c, times)))


# Solvers of the equation


@njit
def _acceleration(y: Any, u: Any, b: Any, c: Any) -> Any:
    return -(b * u * u + c) * (y * (2 - y) if y < 1 else 1.0)


@njit
def _slope(_: Any, state: Any, b: Any, c: Any) -> Any:
    return np.array((state[1], _acceleration(state[0], state[1], b, c)))


def _solve_ivp(method: str, tolerance: float, b: float, c: float, times: Any) -> Any:
    from scipy.integrate import solve_ivp

    def motion(_: float, state: Any) -> tuple[float, float]:
        y, u = state.tolist()  # Python's floats are several times faster than NumPy's scalars
        return u, -(b * u * u + c) * (y * (2 - y) if y < 1 else 1.0)

    def rest(_: float, state: Any) -> Any:
        return state[1]

    vars(rest).update(terminal=True, direction=-1)  # which is how SciPy is told
    options: Any = {"method": method, "rtol": tolerance, "atol": tolerance, "events": rest}
    wanted = times if len(times) > 2 else None
    with np.errstate(all="ignore"):  # of a trial step that went too far, and is rejected
        solved = solve_ivp(motion, (0.0, 2 * times[-1]), (0.0, 1.0), t_eval=wanted, **options)
    if solved.status != 1:
        raise ArithmeticError(f"never at rest: {solved.message}")
    final = solved.y_events[0][0, 0]
    before = [] if wanted is None else solved.y[0]
    return np.append(before, [final] * (len(times) - len(before)))


def _odeint(tolerance: float, b: float, c: float, times: Any) -> Any:
    from scipy.integrate import odeint

    options: Any = {"tfirst": True, "rtol": tolerance, "atol": tolerance, "mxstep": 100_000}
    return odeint(_slope, (0.0, 1.0), times, args=(b, c), **options)[:, 0]


def _dop853(tolerance: float, b: float, c: float, times: Any) -> Any:
    from scipy.integrate import ode

    solver = ode(_slope).set_f_params(b, c)
    solver.set_integrator("dop853", rtol=tolerance, atol=tolerance, nsteps=100_000)
    solver.set_initial_value((0.0, 1.0), 0.0)
    return [0.0, *(solver.integrate(time)[0] for time in times[1:].tolist())]


@njit
def _rk4(steps: Any, b: Any, c: Any, times: Any) -> Any:
    """Runge and Kutta's method with so many steps, as many from any time to the next."""
    depths, y, u = np.zeros(times.size), 0.0, 1.0
    steps //= times.size - 1
    for k in range(1, times.size):
        h = (times[k] - times[k - 1]) / steps
        for _ in range(steps):
            a1 = _acceleration(y, u, b, c)
            u2 = u + h / 2 * a1
            a2 = _acceleration(y + h / 2 * u, u2, b, c)
            u3 = u + h / 2 * a2
            a3 = _acceleration(y + h / 2 * u2, u3, b, c)
            u4 = u + h * a3
            a4 = _acceleration(y + h * u3, u4, b, c)
            y += h / 6 * (u + 2 * u2 + 2 * u3 + u4)
            u += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
        depths[k] = y
    return depths


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
def _taylor(tolerance: float, b: float, c: float) -> list[Any]:
    """Integrators for up to y = 1, where the first one stops, and beyond."""
    try:
        import heyoka
    except ImportError as error:
        raise ValueError("not installed: python -m pip install 'coldspray[bench]'") from error
    y, u = heyoka.make_vars("y", "u")
    crosses = math.log1p(b / c) / (2 * b) > 2 / 3
    events: Any = {"t_events": [heyoka.t_event(y - 1)]} if crosses else {}
    return [
        heyoka.taylor_adaptive([(y, u), (u, -(b * u * u + c) * area)], tol=tolerance, **more)
        for area, more in ((2 * y - y * y, events), (1.0, {}))
    ]


TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 3e-14)
"""Relative and absolute; SciPy takes no relative one below 2.2e-14."""

SOLVERS: dict[str, tuple[str, Sequence[float], Function]] = {
    **{
        f"solve_ivp {name}": ("rtol {:g}", TOLERANCES, partial(_solve_ivp, name))
        for name in ("RK45", "DOP853", "LSODA", "Radau")
    },
    "odeint, Numba": ("rtol {:g}", TOLERANCES, _odeint),
    "dop853, Numba": ("rtol {:g}", TOLERANCES, _dop853),
    "RK4, Numba": ("{} steps", (100, 200, 400, 800, 1600, 6400), _rk4),
    "heyoka": ("tol {:g}", (1e-6, 1e-10, 2.2e-16), _heyoka),
}
"""How a setting is shown, the settings, and the solver."""


# Bare loops over cases, on one core, without any check


@njit
def _depth_loop(V: Any, R: Any, rho_p: Any, rho_t: Any, R_t: Any) -> Any:
    depths = np.empty(V.size)
    for i in range(V.size):
        c = 4 * rho_p[i] / (3 * rho_t[i]) * math.log1p(rho_t[i] * V[i] ** 2 / (2 * R_t[i]))
        h = math.asin(math.sqrt(3 * min(c, 2 / 3)) / 2) / 3
        y = 4 * math.sin(h) * math.sin(h + math.pi / 3) if c < 2 / 3 else c + 1 / 3
        depths[i] = R[i] * y
    return depths


@njit
def _sheet_loop(dt: float, stop: float, V: Any, R: Any, rho_p: Any, rho_t: Any, R_t: Any) -> Any:
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
