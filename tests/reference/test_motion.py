"""The sheet in rational arithmetic, and the exact motion by two routes that share the inputs."""

from collections.abc import Callable
from fractions import Fraction as F
from functools import cache, cached_property
from itertools import islice
from typing import Any

import mpmath
import pytest

from reference.arithmetic import Rationals, Reals
from reference.intervals import Intervals
from reference.motion import Trajectory, contact_share, final_depth, sheet_depth, sheet_rows

SHALLOW = (F(500), F(11, 10**6), F(8900), F(7850), F(35 * 10**8))
DEEP = (F(1500), F(11, 10**6), F(8900), F(7850), F(21 * 10**8))
CASES = {"ends below the radius": SHALLOW, "crosses the radius": DEEP}
STEP = F(2, 10**10)

# The sheet


def rows_by_hand(count: int, centered: bool, case: tuple[F, ...]) -> list[tuple[F, ...]]:
    """The appendix, sentence by sentence, from the chord's area and the whole sphere's mass.

    pi cancels from area over mass.
    """
    v, radius, particle, target, resistance = case
    mass_over_pi = F(4, 3) * radius**3 * particle
    x, rows = F(0), []
    for k in range(1, count + 1):
        x += v * (STEP / 2 if k == 1 else STEP)
        area_over_pi = 2 * radius * x - x**2 if x < radius else radius**2
        middle = v
        if centered:
            first = (target * v**2 / 2 + resistance) * area_over_pi / mass_over_pi
            middle = v - first * STEP / 2
        a = (target * middle**2 / 2 + resistance) * area_over_pi / mass_over_pi
        rows.append((v, x, a, v - a * STEP))
        v -= a * STEP
    return rows


@pytest.mark.parametrize("centered", [False, True])
@pytest.mark.parametrize("case", CASES)
def test_the_first_rows_are_those_of_rational_arithmetic(case: str, centered: bool) -> None:
    count = 3 if centered else 5  # the fractions' digits double twice, or once, with every row
    rows = islice(sheet_rows(Rationals(), *CASES[case], step=STEP, centered=centered), count)
    assert [tuple(row) for row in rows] == rows_by_hand(count, centered, CASES[case])


def test_a_given_mass_takes_the_place_of_the_spheres() -> None:
    ar = Reals(30)
    case = [ar.number(value) for value in SHALLOW]
    own = 4 * ar.pi * case[1] ** 3 / 3 * case[2]
    plain, heavy = (
        next(sheet_rows(ar, *case, step=ar.number(STEP), mass=mass)).deceleration
        for mass in (None, 2 * own)
    )
    assert abs(plain / heavy - 2) < 1e-28


@pytest.mark.parametrize("centered", [False, True])
def test_the_sheet_ends_below_the_stop_velocity_and_nears_the_exact_depth(centered: bool) -> None:
    ar, errors = Reals(30), []
    case = [ar.number(value) for value in SHALLOW]
    exact = final_depth(ar, *case)
    for parts in (1, 4):
        step, stop = ar.number(STEP / parts), ar.number(F(1, parts))
        rows = list(sheet_rows(ar, *case, step=step, stop_velocity=stop, centered=centered))
        assert rows[-1].velocity_final < stop <= rows[-1].velocity_initial
        assert sheet_depth(ar, iter(rows), stop) == rows[-1].depth
        errors.append(abs(rows[-1].depth - exact))
    assert errors[1] < errors[0] < 500 * STEP / 2


def test_a_box_of_sheets_holds_the_sheets_at_its_corners() -> None:
    ar, stop = Intervals(30), F(1)
    speeds, strengths = (F(499), F(501)), (F(349 * 10**7), F(35 * 10**8))

    def depth(speed: tuple[F, F], strength: tuple[F, F]) -> tuple[F, F]:
        with ar.working():
            inputs = [
                ar.interval(*ends) for ends in (speed, *((x, x) for x in SHALLOW[1:4]), strength)
            ]
            limit = ar.number(stop)
            rows = sheet_rows(ar, *inputs, step=ar.number(STEP), stop_velocity=limit)
            return ar.ends(sheet_depth(ar, rows, limit))

    low, high = depth(speeds, strengths)
    for speed in speeds:
        for strength in strengths:
            inner = depth((speed, speed), (strength, strength))
            assert low < inner[0] <= inner[1] < high


@pytest.mark.parametrize("y", [F(0), F(1, 7), F(99, 100), F(1), F(5)])
def test_contact_area_is_eq_12_then_constant(y: F) -> None:
    assert contact_share(Rationals(), y) == (2 * y - y**2 if y < 1 else 1)


# The exact motion, by separating Eq. 13 and by integrating it


class Integration:
    """Eq. 13 by mpmath's Taylor series, restarted where the sphere is half buried.

    It knows nothing of energy integrals; methods as those of `Trajectory`.
    """

    def __init__(self, velocity: F, radius: F, particle: F, target: F, resistance: F) -> None:
        self.reals = Reals(30)
        self.context = self.reals.context
        self.velocity, self.radius = self.reals.number(velocity), self.reals.number(radius)
        # y = x/R and u = v/V, time in units of R/V.
        self.drag = self.reals.number(3 * target / (8 * particle))
        self.push = self.reals.number(3 * resistance / (4 * particle * velocity**2))

    def _slope(self, state: list[Any], share: Any) -> list[Any]:
        return [state[1], -(self.drag * state[1] ** 2 + self.push) * share]

    @cached_property
    def _shallow(self) -> Any:
        start = [self.context.zero, self.context.one]
        return self.context.odefun(lambda _, s: self._slope(s, 2 * s[0] - s[0] ** 2), 0, start)

    @cached_property
    def _crossing(self) -> Any:
        """Time at which y = 1, or None if the particle rests before."""
        time = self.context.one
        while True:  # in small steps: far beyond, the first branch turns nonsensical
            y, u = self._shallow(time)
            if u <= 0:
                return None
            if y >= 1:
                return self._root(lambda t: self._shallow(t)[0] - 1, time * 7 / 8, time)
            time = time * 9 / 8

    @cached_property
    def _deep(self) -> Any:
        start = self._shallow(self._crossing)
        return self.context.odefun(lambda _, s: self._slope(s, 1), self._crossing, start)

    def _state(self, time: Any) -> Any:
        past = self._crossing is not None and time > self._crossing
        return self._deep(time) if past else self._shallow(time)

    def _root(self, function: Any, low: Any = None, high: Any = None) -> Any:
        if high is None:
            low, high = self.context.zero, self.context.one / 8
            falling = function(low) > 0
            while (function(high) > 0) == falling:
                low, high = high, high * 9 / 8
        return self.context.findroot(function, (low, high), solver="anderson")

    def _time(self, function: Any) -> Any:
        return self._root(lambda t: function(self._state(t))) * self.radius / self.velocity

    def stop_time(self, stop_velocity: Any = 0) -> Any:
        u = self.context.convert(stop_velocity) / self.velocity
        return self._time(lambda state: state[1] - u)

    def time_to_depth(self, depth: Any) -> Any:
        y = self.context.convert(depth) / self.radius
        return self._time(lambda state: state[0] - y)

    def depth_at_time(self, time: Any) -> Any:
        return (
            self.radius * self._state(self.context.convert(time) * self.velocity / self.radius)[0]
        )

    def depth_at_velocity(self, velocity: Any) -> Any:
        return self.depth_at_time(self.stop_time(velocity))

    def velocity_at_depth(self, depth: Any) -> Any:
        time = self.time_to_depth(depth) * self.velocity / self.radius
        return self.velocity * self._state(time)[1]

    @property
    def final_depth(self) -> Any:
        return self.depth_at_velocity(0)


QUANTITIES: dict[str, Callable[[Any, Any], Any]] = {
    "final depth": lambda motion, at: motion.final_depth,
    "stop time": lambda motion, at: motion.stop_time(),
    "time to 1 m/s": lambda motion, at: motion.stop_time(1),
    "velocity at a depth": lambda motion, at: motion.velocity_at_depth(at.final_depth * 7 / 10),
    "velocity at a small depth": lambda motion, at: motion.velocity_at_depth(at.final_depth / 50),
    "time to a depth": lambda motion, at: motion.time_to_depth(at.final_depth * 7 / 10),
    "depth at a velocity": lambda motion, at: motion.depth_at_velocity(200),
    "depth at a time": lambda motion, at: motion.depth_at_time(at.stop_time() / 3),
}
CLOSE = mpmath.mpf(10) ** -25


@cache
def routes(case: str) -> tuple[Trajectory, Integration]:
    return Trajectory(*CASES[case], digits=30), Integration(*CASES[case])


@pytest.mark.parametrize("case", CASES)
def test_both_routes_agree_to_25_digits_of_30(case: str) -> None:
    separated, integrated = routes(case)
    for name, quantity in QUANTITIES.items():
        one, two = quantity(separated, separated), quantity(integrated, separated)
        assert abs(one / separated.context.convert(two) - 1) < CLOSE, name


@pytest.mark.parametrize("case", CASES)
def test_the_final_depth_spends_the_energy(case: str) -> None:
    """The work of the force by quadrature in x is what the velocity loses, by quadrature in v."""
    ar = Reals(40)
    velocity, radius, particle, target, resistance = (ar.number(x) for x in CASES[case])
    depth = final_depth(ar, velocity, radius, particle, target, resistance)
    swept = ar.context.quad(
        lambda x: ar.pi * (2 * radius * x - x * x if x < radius else radius * radius),
        [0, min(depth, radius), depth],
    )
    mass = particle * ar.pi * (2 * radius) ** 3 / 6
    lost = ar.context.quad(
        lambda v: mass * v / (target * v**2 / 2 + resistance), [0, velocity / 2, velocity]
    )
    assert abs(swept / lost - 1) < 1e-35
    assert abs(routes(case)[0].final_depth / routes(case)[0].context.convert(depth) - 1) < CLOSE


@pytest.mark.parametrize("case", CASES)
def test_velocity_depth_and_time_undo_each_other(case: str) -> None:
    motion, _ = routes(case)
    for share in (F(1, 1000), F(1, 3), F(999, 1000)):
        depth = motion.final_depth * motion.reals.number(share)
        assert abs(motion.depth_at_velocity(motion.velocity_at_depth(depth)) / depth - 1) < CLOSE
        assert abs(motion.depth_at_time(motion.time_to_depth(depth)) / depth - 1) < CLOSE


def test_ends_of_the_motion() -> None:
    motion, _ = routes("ends below the radius")
    assert abs(motion.velocity_at_depth(0) / motion.velocity - 1) < CLOSE
    assert motion.time_to_depth(0) == 0
    assert motion.velocity_at_depth(motion.final_depth) == 0
    assert motion.depth_at_time(10 * motion.stop_time()) == motion.final_depth
    for beyond in (motion.velocity_at_depth, motion.time_to_depth):
        with pytest.raises(ValueError, match="never gets to a depth"):
            beyond(2 * motion.final_depth)
    with pytest.raises(ValueError, match="never has a velocity of 501"):
        motion.depth_at_velocity(501)
    with pytest.raises(ValueError, match="before the impact"):
        motion.depth_at_time(-1)


@pytest.mark.parametrize(
    "changed",
    [
        {0: F(1, 10**9)},
        {0: F(10**5)},
        {4: F(1)},
        {4: F(10**15)},
        {2: F(89, 10**4)},
        {3: F(89, 10**4)},
    ],
    ids=["slow", "hypervelocity", "soft", "hard", "light particle", "light target"],
)
def test_more_digits_change_nothing(changed: dict[int, F]) -> None:
    case = [changed.get(k, value) for k, value in enumerate(SHALLOW)]
    few, many = Trajectory(*case, digits=30), Trajectory(*case, digits=60)
    for one, two in ((few.final_depth, many.final_depth), (few.stop_time(), many.stop_time())):
        assert abs(many.context.convert(one) / two - 1) < mpmath.mpf(10) ** -28
