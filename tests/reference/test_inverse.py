"""The inverses in many digits against the exact motion, and their proven intervals."""

from fractions import Fraction as F

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference.arithmetic import Duals, NoRootError, Number, Reals
from reference.intervals import Intervals
from reference.inverse import INVERSES, enclosed
from reference.motion import Trajectory

NAMES = ("velocity", "radius", "particle_density", "target_density", "resistance")
RANGES = ((1e-3, 1e5), (1e-9, 1.0), (1.0, 1e5), (1.0, 1e5), (1e3, 1e13))


@st.composite
def cases(draw: st.DrawFn) -> dict[str, F]:
    """Draw the inputs of an impact, uniformly distributed in the logarithm."""
    shares = [draw(st.floats(0, 1)) for _ in RANGES]
    numbers = (low * (high / low) ** x for x, (low, high) in zip(shares, RANGES, strict=True))
    return dict(zip(NAMES, map(F, numbers), strict=True))


def exact(x: Number) -> F:
    """Return an mpmath number as a fraction."""
    return F(*x.as_integer_ratio())


def value(name: str, given: dict[str, F], digits: int = 60) -> F:
    reals = Reals(digits)
    numbers = {key: reals.number(x) for key, x in given.items()}
    return exact(INVERSES[name](reals, **numbers))


@pytest.mark.parametrize("name", INVERSES)
@given(case=cases())
@settings(max_examples=40, deadline=None)
def test_the_exact_motion_ends_at_the_depth_that_was_asked_for(
    name: str, case: dict[str, F]
) -> None:
    """The depth has 16 digits, as a measured one has few; close to a limit there may be no root."""
    depth = F(float(Trajectory(**case, digits=60).final_depth))
    inputs = {key: x for key, x in case.items() if key != name} | {"depth": depth}
    ends = enclosed(name, {key: (x, x) for key, x in inputs.items()})
    try:
        solution = value(name, inputs)
    except NoRootError:
        assert name == "target_density"
        assert ends is None
        return
    reached = exact(Trajectory(**{**case, name: solution}, digits=60).final_depth)
    assert abs(reached / depth - 1) < F(1, 10**50)
    assert ends is not None
    assert ends[0] <= solution <= ends[1]
    if name != "target_density":  # its digits are lost close to the limit
        assert ends[1] / ends[0] - 1 < F(1, 10**20)


@pytest.mark.parametrize("name", INVERSES)
@given(case=cases(), wide=st.floats(1e-6, 0.5), shares=st.lists(st.floats(0, 1), min_size=5))
@settings(max_examples=40, deadline=None)
def test_an_interval_contains_the_value_for_each_choice_in_the_box(
    name: str, case: dict[str, F], wide: float, shares: list[float]
) -> None:
    depth = F(float(Trajectory(**case, digits=30).final_depth))
    middle = {key: x for key, x in case.items() if key != name} | {"depth": depth}
    box = {key: (x, x * (1 + F(wide))) for key, x in middle.items()}
    choice = {
        key: low + (high - low) * F(share)
        for (key, (low, high)), share in zip(box.items(), shares, strict=False)
    }
    ends = enclosed(name, box)
    try:
        solution = value(name, choice)
    except NoRootError:
        assert ends is None or ends[0] == 0
        return
    assert ends is not None
    assert ends[0] <= solution <= ends[1]


def test_an_interval_of_monotone_inputs_is_sharp() -> None:
    """A larger depth, particle density or radius needs another resistance: ends are at corners."""
    box = {
        "depth": (F("3.25e-6"), F("3.35e-6")), "velocity": (F("499.5"), F("500.5")),
        "radius": (F("10.95e-6"), F("11.05e-6")), "particle_density": (F("8895"), F("8905")),
        "target_density": (F("7845"), F("7855")),
    }  # fmt: skip
    most = {key: ends[key != "depth"] for key, ends in box.items()}
    most["target_density"] = box["target_density"][0]  # of a dense target less resistance suffices
    least = {key: sum(ends) - most[key] for key, ends in box.items()}
    ends = enclosed("resistance", box)
    assert ends is not None
    assert [float(end) for end in ends] == [float(value("resistance", x)) for x in (least, most)]


BETA_5 = {"velocity": F(500), "radius": F("11e-6"), "particle_density": F(8900)}
BETA_5 |= {"target_density": F(7850)}


@pytest.mark.parametrize(
    ("name", "factor", "ends"),
    [
        # By hand: X/R from 0.295455 to 0.304545, W from 0.078696 to 0.083333, e^L - 1 from 0.053438
        # to 0.056673, so R_t from 17.314 to 18.362 GPa.
        pytest.param("beta", {"flow_stress": F("7e8")}, (24.734, 26.232), id="beta"),
        pytest.param("flow_stress", {"beta": F(5)}, (3.4628e9, 3.6725e9), id="flow stress"),
    ],
)
def test_factors_of_the_resistance(
    name: str, factor: dict[str, F], ends: tuple[float, float]
) -> None:
    box = {key: (x, x) for key, x in {**BETA_5, **factor}.items()}
    enclosure = enclosed(name, {**box, "depth": (F("3.25e-6"), F("3.35e-6"))})
    assert enclosure is not None
    assert [float(end) for end in enclosure] == pytest.approx(ends, rel=5e-5)


@pytest.mark.parametrize(
    ("depths", "none", "some"),
    [
        pytest.param(("8.2e-6", "8.25e-6"), False, False, id="all less deep"),
        pytest.param(("8.2e-6", "8.3e-6"), False, True, id="some deeper"),
        pytest.param(("8.28e-6", "8.3e-6"), True, False, id="all deeper"),
    ],
)
def test_a_target_without_density_limits_the_depth(
    depths: tuple[str, str], none: bool, some: bool
) -> None:
    """With CV/PV = 8900 500^2 / (2 3.5e9) = 0.31786, X/R is 0.7521 and X 8.273 um at most."""
    box = {key: (x, x) for key, x in BETA_5.items() if key != "target_density"}
    box |= {"resistance": (F("35e8"), F("35e8")), "depth": (F(depths[0]), F(depths[1]))}
    ends = enclosed("target_density", box)
    assert (ends is None) == none
    assert (ends is not None and ends[0] == 0) == some


def test_the_mean_exponential_of_zero_is_one_and_none_is_less() -> None:
    """(e^x - 1)/x rises from 1 at x = 0: so 1 has the root 0, and a number below it has none."""
    reals = Reals(60)
    assert abs(reals.exp_mean_root(reals.number(1))) < 1e-55
    with pytest.raises(NoRootError):
        reals.exp_mean_root(reals.number(1 - F(1, 10**50)))


@pytest.mark.parametrize("k", [F(1) + F(1, 10**12), F(3, 2), F(10), F(10) ** 60])
def test_the_root_of_a_mean_exponential(k: F) -> None:
    """Lambert's function and the verified interval agree; the slope is a difference quotient."""
    reals, intervals = Reals(60), Intervals(60)
    root = reals.exp_mean_root(reals.number(k))
    assert abs(reals.expm1(root) / root / reals.number(k) - 1) < 1e-55
    low, high = intervals.ends(intervals.exp_mean_root(intervals.number(k)))
    assert low <= exact(root) <= high
    duals, h = Duals(reals), F(1, 10**25)
    slope = duals.exp_mean_root(duals.variable(reals.number(k), "k")).slopes["k"]
    above, below = (reals.exp_mean_root(reals.number(k * (1 + s * h))) for s in (1, -1))
    quotient = (above - below) / (2 * reals.number(k * h))
    assert abs(quotient / slope - 1) < 1e-20
    x_low, x_high = intervals.ends(intervals.exp_mean_slope(intervals.number(exact(root))))
    assert x_low <= exact(1 / slope) <= x_high


def test_a_mean_exponential_below_one_has_no_root() -> None:
    reals, intervals = Reals(30), Intervals(30)
    with pytest.raises(NoRootError, match=r"^\(e\^x - 1\) / x is at least 1$"):
        reals.exp_mean_root(reals.number(F(9, 10)))
    below = intervals.interval(F(1, 2), F(9, 10))
    assert intervals.ends(intervals.exp_mean_root(below)) == (0, 0)
