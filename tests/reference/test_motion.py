"""The exact motion: its ends and its digits; `test_models.py` compares the models with it."""

from fractions import Fraction as F
from itertools import product

import mpmath
import pytest

from reference.motion import Trajectory

SHALLOW = (F(500), F(11, 10**6), F(8900), F(7850), F(35 * 10**8))
DEEP = (F(1500), F(11, 10**6), F(8900), F(7850), F(21 * 10**8))
CASES = {"ends below the radius": SHALLOW, "crosses the radius": DEEP}
CLOSE = mpmath.mpf(10) ** -25


@pytest.mark.parametrize("case", CASES)
def test_ends_of_the_motion(case: str) -> None:
    motion = Trajectory(*CASES[case], digits=30)
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
    for short, long in ((few.final_depth, many.final_depth), (few.stop_time(), many.stop_time())):
        assert abs(many.context.convert(short) / long - 1) < mpmath.mpf(10) ** -28
