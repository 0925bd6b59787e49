"""The exact motion by two routes that share nothing but the inputs."""

from collections.abc import Callable
from fractions import Fraction
from functools import cache
from typing import Any

import mpmath
import pytest

from reference import exact
from reference.trajectory import Integration, Trajectory

SHALLOW = (Fraction(500), Fraction(11, 10**6), Fraction(8900), Fraction(7850), Fraction(35 * 10**8))
DEEP = (Fraction(1500), Fraction(11, 10**6), Fraction(8900), Fraction(7850), Fraction(21 * 10**8))
CASES = {"ends below the radius": SHALLOW, "crosses the radius": DEEP}

FORTY_DIGITS = mpmath.mpf(10) ** -40

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


@cache
def routes(case: str) -> tuple[Trajectory, Integration]:
    return Trajectory(*CASES[case]), Integration(*CASES[case])


@pytest.mark.parametrize("quantity", QUANTITIES)
@pytest.mark.parametrize("case", CASES)
def test_both_routes_agree_to_40_digits_of_50(case: str, quantity: str) -> None:
    separated, integrated = routes(case)
    one = QUANTITIES[quantity](separated, separated)
    other = QUANTITIES[quantity](integrated, separated)
    assert abs(one / separated.context.convert(other) - 1) < FORTY_DIGITS


@pytest.mark.parametrize("case", CASES)
def test_final_depth_is_the_root_of_the_cubic(case: str) -> None:
    motion, _ = routes(case)
    reals = exact.Reals(60)
    expected = exact.final_depth(reals, *(reals.number(value) for value in CASES[case]))
    assert abs(motion.final_depth / motion.context.convert(expected) - 1) < FORTY_DIGITS
    y = motion.final_depth / motion.radius
    work = float(y * y - y**3 / 3 if y < 1 else y - mpmath.mpf(1) / 3)
    velocity, _, particle, target, resistance = (float(value) for value in CASES[case])
    # The work by quadrature over the velocity, not by its logarithm; fifteen digits of doubles.
    quadrature = mpmath.quad(
        lambda v: 4 * particle / 3 * v / (target * v * v / 2 + resistance), [0, velocity]
    )
    assert work == pytest.approx(float(quadrature), rel=1e-14)


@pytest.mark.parametrize("case", CASES)
def test_velocity_depth_and_time_undo_each_other(case: str) -> None:
    motion, _ = routes(case)
    for share in (Fraction(1, 1000), Fraction(1, 3), Fraction(999, 1000)):
        depth = motion.final_depth * motion.reals.number(share)
        velocity = motion.velocity_at_depth(depth)
        assert abs(motion.depth_at_velocity(velocity) / depth - 1) < FORTY_DIGITS
        time = motion.time_to_depth(depth)
        assert abs(motion.depth_at_time(time) / depth - 1) < FORTY_DIGITS


def test_the_motion_crosses_the_radius_smoothly() -> None:
    motion, _ = routes("crosses the radius")
    assert motion.final_depth > motion.radius
    step = motion.radius * motion.context.mpf(10) ** -20
    before, at, after = (
        motion.velocity_at_depth(motion.radius + shift) for shift in (-step, 0, step)
    )
    # One slope on both sides: the second difference is of second order.
    assert before > at > after
    assert abs(before - 2 * at + after) < at * motion.context.mpf(10) ** -38


def test_ends() -> None:
    motion, _ = routes("ends below the radius")
    assert abs(motion.velocity_at_depth(0) / motion.velocity - 1) < FORTY_DIGITS
    assert motion.time_to_depth(0) == 0
    assert motion.velocity_at_depth(motion.final_depth) == 0
    assert motion.depth_at_time(10 * motion.stop_time()) == motion.final_depth
    with pytest.raises(ValueError, match="never gets to a depth"):
        motion.velocity_at_depth(2 * motion.final_depth)
    with pytest.raises(ValueError, match="never gets to a depth"):
        motion.time_to_depth(2 * motion.final_depth)


@pytest.mark.parametrize(
    "case",
    [
        (Fraction(1, 10**9), *SHALLOW[1:]),
        (Fraction(10**5), *SHALLOW[1:]),
        (*SHALLOW[:4], Fraction(1)),
        (*SHALLOW[:4], Fraction(10**15)),
        (*SHALLOW[:2], Fraction(89, 10000), Fraction(8900), SHALLOW[4]),
        (*SHALLOW[:2], Fraction(8900), Fraction(89, 10000), SHALLOW[4]),
    ],
    ids=["slow", "hypervelocity", "soft", "hard", "light particle", "light target"],
)
def test_more_digits_change_nothing(case: tuple[Fraction, ...]) -> None:
    few, many = Trajectory(*case, digits=30), Trajectory(*case, digits=60)
    for one, other in (
        (few.final_depth, many.final_depth),
        (few.stop_time(), many.stop_time()),
    ):
        assert abs(many.context.convert(one) / other - 1) < mpmath.mpf(10) ** -28


def test_no_global_precision_is_changed() -> None:
    before = mpmath.mp.dps, mpmath.iv.dps
    Trajectory(*SHALLOW).stop_time()
    assert (mpmath.mp.dps, mpmath.iv.dps) == before
