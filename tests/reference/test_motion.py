"""The sheet in rational arithmetic, and the exact motion against its differential equation."""

from collections.abc import Callable
from fractions import Fraction as F
from functools import cache
from itertools import islice, product
from typing import Any

import mpmath
import pytest

from reference.arithmetic import Rationals, Reals
from reference.intervals import Intervals
from reference.motion import Trajectory, sheet_depth, sheet_rows

INPUTS = ("velocity", "radius", "particle_density", "target_density", "resistance")
SHALLOW = (F(500), F(11, 10**6), F(8900), F(7850), F(35 * 10**8))
DEEP = (F(1500), F(11, 10**6), F(8900), F(7850), F(21 * 10**8))
CASES = {"ends below the radius": SHALLOW, "crosses the radius": DEEP}
STEP = F(2, 10**10)

# The sheet


def rows_by_hand(count: int, centered: bool, case: tuple[F, ...], step: F) -> list[tuple[F, ...]]:
    """The appendix, sentence by sentence, from the chord's area and the whole sphere's mass.

    pi cancels from area over mass.
    """
    v, radius, particle, target, resistance = case
    mass_over_pi = F(4, 3) * radius**3 * particle
    x, rows = F(0), []
    for k in range(1, count + 1):
        x += v * (step / 2 if k == 1 else step)
        area_over_pi = 2 * radius * x - x**2 if x < radius else radius**2
        middle = v
        if centered:
            first = (target * v**2 / 2 + resistance) * area_over_pi / mass_over_pi
            middle = v - first * step / 2
        a = (target * middle**2 / 2 + resistance) * area_over_pi / mass_over_pi
        rows.append((v, x, a, v - a * step))
        v -= a * step
    return rows


@pytest.mark.parametrize("centered", [False, True])
@pytest.mark.parametrize("case", CASES)
def test_the_first_rows_are_those_of_rational_arithmetic(case: str, centered: bool) -> None:
    count = 3 if centered else 5  # the fractions' digits double twice, or once, with every row
    step = STEP if case == "ends below the radius" else 20 * STEP  # crosses it in these rows
    rows = islice(sheet_rows(Rationals(), *CASES[case], step=step, centered=centered), count)
    assert [tuple(row) for row in rows] == rows_by_hand(count, centered, CASES[case], step)


@pytest.mark.parametrize("centered", [False, True])
def test_the_sheet_ends_below_the_stop_velocity_and_nears_the_exact_depth(centered: bool) -> None:
    ar, errors = Reals(30), []
    case = [ar.number(value) for value in SHALLOW]
    exact = ar.context.convert(Trajectory(*SHALLOW, digits=30).final_depth)
    for parts in (1, 4):
        step, stop = ar.number(STEP / parts), ar.number(F(1, parts))
        rows = list(sheet_rows(ar, *case, step=step, stop_velocity=stop, centered=centered))
        assert rows[-1].velocity_final < stop <= rows[-1].velocity_initial
        inputs = dict(zip(INPUTS, case, strict=True))
        assert sheet_depth(ar, centered, stop, step=step, **inputs) == rows[-1].depth
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
            case = dict(zip(INPUTS, inputs, strict=True))
            return ar.ends(sheet_depth(ar, False, ar.number(stop), step=ar.number(STEP), **case))

    low, high = depth(speeds, strengths)
    for speed, strength in product(speeds, strengths):
        inner = depth((speed, speed), (strength, strength))
        assert low < inner[0] <= inner[1] < high


# The exact motion


@cache
def exact(case: str) -> Trajectory:
    return Trajectory(*CASES[case], digits=30)


CLOSE = mpmath.mpf(10) ** -25


def slope(function: Callable[[Any], Any], x: Any, step: Any) -> Any:
    """The derivative by differences of sixth order: to 20 digits for a step of 1e-4."""
    weights = {1: F(3, 4), 2: F(-3, 20), 3: F(1, 60)}
    return sum(
        w.numerator * (function(x + k * step) - function(x - k * step)) / w.denominator / step
        for k, w in weights.items()
    )


@pytest.mark.parametrize("share", [F(1, 50), F(1, 3), F(7, 10), F(19, 20)])
@pytest.mark.parametrize("case", CASES)
def test_velocity_and_time_solve_the_equation_of_motion(case: str, share: F) -> None:
    """Eq. 13 as M v dv/dx = -(rho_t v^2 / 2 + R_t) A, and dt/dx = 1/v; with the ends below, all."""
    motion = exact(case)
    _, radius, particle, target, resistance = map(motion.reals.number, CASES[case])
    depth = motion.final_depth * motion.reals.number(share)
    step = motion.final_depth / 10**5
    v = motion.velocity_at_depth(depth)
    area = 2 * radius * depth - depth**2 if depth < radius else radius**2  # over pi
    mass = 4 * radius**3 * particle / 3  # over pi
    force = (target * v**2 / 2 + resistance) * area
    gained = slope(lambda x: motion.velocity_at_depth(x) ** 2 / 2, depth, step)
    assert abs(mass * gained / force + 1) < mpmath.mpf(10) ** -20
    assert abs(slope(motion.time_to_depth, depth, step) * v - 1) < mpmath.mpf(10) ** -20


@pytest.mark.parametrize("case", CASES)
def test_ends_of_the_motion(case: str) -> None:
    motion = exact(case)
    for share in (F(1, 1000), F(1, 3), F(999, 1000)):
        depth = motion.final_depth * motion.reals.number(share)
        assert abs(motion.depth_at_velocity(motion.velocity_at_depth(depth)) / depth - 1) < CLOSE
    assert abs(motion.velocity_at_depth(0) / motion.velocity - 1) < CLOSE
    assert motion.time_to_depth(0) == 0
    assert motion.stop_time(1) == motion.time_to_depth(motion.depth_at_velocity(1))
    assert motion.stop_time(1) < motion.stop_time()
    assert motion.velocity_at_depth(motion.final_depth) == 0
    for share, function in product((2, F(-1, 9)), (motion.velocity_at_depth, motion.time_to_depth)):
        with pytest.raises(ValueError, match="never gets to a depth"):
            function(motion.reals.number(share) * motion.final_depth)
    with pytest.raises(ValueError, match="never has a velocity of 1501"):
        motion.depth_at_velocity(1501)


EXTREMES = {
    "slow": (0, F(1, 10**9)), "hypervelocity": (0, F(10**5)), "soft": (4, F(1)),
    "hard": (4, F(10**15)), "light particle": (2, F(89, 10**4)), "light target": (3, F(89, 10**4)),
}  # fmt: skip


@pytest.mark.parametrize("extreme", EXTREMES)
def test_more_digits_change_nothing(extreme: str) -> None:
    place, value = EXTREMES[extreme]
    case = [*SHALLOW[:place], value, *SHALLOW[place + 1 :]]
    few, many = Trajectory(*case, digits=30), Trajectory(*case, digits=60)
    for first, two in ((few.final_depth, many.final_depth), (few.stop_time(), many.stop_time())):
        assert abs(many.context.convert(first) / two - 1) < mpmath.mpf(10) ** -28
