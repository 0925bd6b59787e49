"""Everything that is proven of a function over a box is true at every point that is tried."""

from collections.abc import Callable
from fractions import Fraction as F
from itertools import product
from typing import Any

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from reference.arithmetic import Rationals
from reference.enclosure import Box, Satisfiability, bounds, enclose, find_solutions, satisfying
from reference.printed import Interval

EXACT = Rationals()
SHOWN, REFUTED, UNDECIDED = Satisfiability


def stairs(ar: Any, x: Any) -> Any:
    """0 below 1/3, 1 below 3/2, then 3: it jumps, as does the depth in the sheet's last row."""
    steps = [(0, None, F(1, 3)), (1, F(1, 3), F(3, 2)), (3, F(3, 2), None)]
    return ar.hull([
        ar.number(height)
        for height, start, end in steps
        if (start is None or ar.below(x, ar.number(start)) is not True)
        and (end is None or ar.below(x, ar.number(end)) is not False)
    ])  # fmt: skip


FUNCTIONS: dict[str, Callable[..., Any]] = {
    "line": lambda ar, x: 2 * x - 1,
    "falling": lambda ar, x: 3 / (x + 4),
    "parabola": lambda ar, x: x * x - x,
    "cubic": lambda ar, x: x**3 - 3 * x,
    "hill": lambda ar, x: 1 / (1 + x**2),
    "bent": lambda ar, x: ar.greatest(x, ar.number(0)) - x / 2,
    "flat": lambda ar, x: ar.least(x, ar.number(0)) - ar.least(x, ar.number(0)) + 1,
    "stairs": stairs,
    "saddle": lambda ar, x, y: x * y - x - y / 2,
    "rising": lambda ar, x, y: x + y * (1 + x),
}
OF_ONE = [name for name, function in FUNCTIONS.items() if function.__code__.co_argcount == 2]
MONOTONE = {"line": 1, "falling": -1}
ENDS = st.fractions(-3, 3, max_denominator=16)


@st.composite
def searches(draw: st.DrawFn) -> tuple[F, F]:
    low, high = sorted([draw(ENDS), draw(ENDS)])
    return low, high if high > low else low + 1


@st.composite
def targets(draw: st.DrawFn) -> Interval:
    low, high = sorted([draw(ENDS), draw(ENDS)])
    if low == high:
        return Interval(*draw(st.sampled_from([(low, None), (None, low), (low, low)])))
    return Interval(low, high, draw(st.booleans()), draw(st.booleans()))


def samples(low: F, high: F, count: int = 60) -> list[F]:
    return [low + (high - low) * F(k, count) for k in range(count + 1)]


def at(name: str, *point: F) -> F:
    return F(FUNCTIONS[name](EXACT, *point))


def values_over(name: str, box: Box) -> dict[tuple[F, ...], F]:
    """The values of a function at points of a box of one or two inputs, including its corners."""
    count = 60 if len(box) == 1 else 8
    points = product(*(samples(*ends, count) for ends in box.values()))
    return {point: at(name, *point) for point in points}


def box_of(name: str, *ends: tuple[F, F]) -> Box:
    return dict(zip("x" if name in OF_ONE else "xy", ends, strict=False))


@settings(max_examples=120)
@given(name=st.sampled_from(list(FUNCTIONS)), xs=searches(), ys=searches())
def test_a_range_holds_every_value_and_is_sharp_where_the_function_is_monotone(
    name: str, xs: tuple[F, F], ys: tuple[F, F]
) -> None:
    box = box_of(name, xs, ys)
    result, values = enclose(FUNCTIONS[name], box), list(values_over(name, box).values())
    assert result.ends[0] <= min(values) <= max(values) <= result.ends[1]
    if name in MONOTONE:
        assert result.signs == {"x": MONOTONE[name]}
    if result.is_monotone:  # the corners are among the points
        assert result.ends == pytest.approx((min(values), max(values)), abs=1e-20)
    if name in OF_ONE:
        assert result.signs["x"] != 1 or values == sorted(values)
        assert result.signs["x"] != -1 or values == sorted(values, reverse=True)
    assert bool(result.idle) <= (len(set(values)) == 1)


@settings(max_examples=200)
@given(name=st.sampled_from(list(FUNCTIONS)), xs=searches(), ys=searches(), target=targets())
def test_a_search_finds_a_point_or_proves_that_there_is_none(
    name: str, xs: tuple[F, F], ys: tuple[F, F], target: Interval
) -> None:
    box = box_of(name, xs, ys)
    values = list(values_over(name, box).values())
    budget = 250 if name in OF_ONE else 60
    outcome, point = satisfying([(FUNCTIONS[name], target)], box, budget)
    assert (point is not None) == (outcome is SHOWN)
    assert not (outcome is REFUTED and any(map(target.contains, values)))
    if point is not None:
        assert target.contains(at(name, *point.values()))
        assert all(low < point[key] < high for key, (low, high) in box.items()), (
            "an open end does not belong to the box"
        )
    if name == "stairs" or name not in OF_ONE:
        return
    # Only coincidences may stay undecided: a target that is a point, or that is just touched.
    deep = [x for x in values if target.encloses(x - F(1, 10**4), x + F(1, 10**4))]
    far = all(target.excludes(x - F(1, 10), x + F(1, 10)) for x in values)
    assert point is not None or not deep
    # A narrow target may lie between the values of two samples: then a point was found.
    assert outcome is not UNDECIDED or not far or target.is_point


@settings(max_examples=150)
@given(name=st.sampled_from(OF_ONE), search=searches(), target=targets())
@example("cubic", (F(0), F(1)), Interval(F(-2), F(0), False, False))  # its slope at 1 is zero
def test_inner_parts_are_solutions_and_nothing_outside_the_outer_parts_is(
    name: str, search: tuple[F, F], target: Interval
) -> None:
    result = find_solutions(FUNCTIONS[name], "x", search, target)
    for low, high in result.inner:
        assert all(target.contains(at(name, x)) for x in samples(low, high, 20)), "inner"
    for x in samples(*search):
        if not any(low <= x <= high for low, high in result.outer):
            assert not target.contains(at(name, x)), "outer"
        assert result.admits(x) <= target.contains(at(name, x))
    assert result.reaches_an_end == any(
        part[0] == search[0] or part[1] == search[1] for part in result.outer
    )
    if name not in ("stairs", "flat") and not target.is_point:
        open_ = sum(b - a for a, b in result.outer) - sum(b - a for a, b in result.inner)
        assert open_ <= (search[1] - search[0]) / 20, "what is left undecided"


MONOTONE_FROM_ZERO: dict[str, Callable[..., Any]] = {
    "line": lambda ar, x: 3 * x,
    "flat at first": lambda ar, x: x**30,
    "nearly a step": lambda ar, x: -1 / (x + ar.number(F(1, 10**9))),
    "falling": lambda ar, x: 2 / (1 + x),
    "bent": lambda ar, x: 50 * x - 49 * ar.greatest(x, ar.number(F(3, 4))),
}


@pytest.mark.parametrize("name", MONOTONE_FROM_ZERO)
def test_a_crossing_is_bracketed_to_the_digits_of_a_double(name: str) -> None:
    """Where secants are slow, too. Each end lies on its own side of the goal."""
    function, search = MONOTONE_FROM_ZERO[name], (F(0), F(2))
    low, high = sorted(F(function(EXACT, x)) for x in (F(1, 3), F(5, 4)))
    solutions = find_solutions(function, "x", search, Interval(low, high))
    ((least, greatest),), ((first, last),) = solutions.inner, solutions.outer
    assert first <= F(1, 3) <= least
    assert greatest <= F(5, 4) <= last
    assert max(least - first, last - greatest) <= F(2, 2**60)


def outcome_of(
    *limits: tuple[Any, Any, Any], budget: int = 1000, **box: tuple[F, F]
) -> Satisfiability:
    """The outcome of a search for a point; a point that is found satisfies every constraint."""
    constraints = [(function, Interval(F(low), F(high))) for function, low, high in limits]
    outcome, point = satisfying(constraints, box, budget)
    assert (outcome is SHOWN) == (point is not None)
    if point is not None:
        assert all(target.contains(f(EXACT, **point)) for f, target in constraints)
    return outcome


# Single searches, of a budget that ends them early


BOTH_SIDES = (F(-3), F(3))
LOG_ROOT_AND_RECIPROCAL: list[Callable[..., Any]] = [
    lambda ar, x: ar.log(x),
    lambda ar, x: ar.power(x, F(1, 2)),
    lambda ar, x: 1 / x,
]


def test_a_search_that_ends_at_once_leaves_everything_open() -> None:
    solutions = find_solutions(
        FUNCTIONS["parabola"], "x", BOTH_SIDES, Interval(F(2), F(6)), budget=1
    )
    assert solutions.inner == ()
    assert solutions.outer == (BOTH_SIDES,)
    assert solutions.reaches_an_end


@pytest.mark.parametrize(
    ("name", "target", "search", "budget", "expected"),
    [
        pytest.param(
            "cubic", Interval(F(-5, 2), F(-49, 20)), BOTH_SIDES, 2, UNDECIDED, id="a narrow target"
        ),
        pytest.param("cubic", Interval(F(2), F(6)), BOTH_SIDES, 0, UNDECIDED, id="no budget"),
        pytest.param("cubic", Interval(F(50), F(60)), BOTH_SIDES, 1, REFUTED, id="far off"),
        pytest.param(
            "parabola",
            Interval(F(5, 2), F(3)),
            (F(1), F(2)),
            2,
            REFUTED,
            id="above a monotone range",
        ),
    ],
)
def test_what_a_small_budget_decides(
    name: str, target: Interval, search: tuple[F, F], budget: int, expected: Satisfiability
) -> None:
    assert satisfying([(FUNCTIONS[name], target)], {"x": search}, budget) == (expected, None)


def cube_of_the_cube_root(ar: Any, x: Any) -> Any:
    """x itself, but no interval arithmetic knows it: 1/3 is only enclosed."""
    return ar.power(x, F(1, 3)) ** 3


def test_a_value_on_an_end_that_is_irrational_on_the_way_stays_undecided() -> None:
    third = {"x": (F(1, 3), F(1, 3))}
    constraint = (cube_of_the_cube_root, Interval(F(1, 3), None))
    assert satisfying([constraint], third) == (UNDECIDED, None)
    solutions = find_solutions(cube_of_the_cube_root, "x", (F(1, 3), F(1)), Interval(F(0), F(1, 3)))
    assert solutions.inner == ()
    assert solutions.outer[0][0] == F(1, 3)


@pytest.mark.parametrize("function", LOG_ROOT_AND_RECIPROCAL)
def test_where_a_function_is_undefined_the_rest_is_searched(function: Callable[..., Any]) -> None:
    outcome, _ = satisfying([(function, Interval(None, F(9)))], {"x": (F(-1), F(1))})
    assert outcome is SHOWN


def test_a_constant_depends_on_nothing() -> None:
    result = enclose(lambda ar, x: F(1, 3), {"x": (F(0), F(1))})
    assert (result.ends, result.idle) == ((F(1, 3), F(1, 3)), {"x"})


def test_a_saddle_that_is_monotone_in_a_corner() -> None:
    """x y - x - y/2 has the slopes y - 1 and x - 1/2, which are positive there."""
    result = enclose(FUNCTIONS["saddle"], {"x": (F(2), F(3)), "y": (F(2), F(4))})
    assert result.ends == (2 * 2 - 2 - 1, 3 * 4 - 3 - 2)
    assert (result.signs, result.idle) == ({"x": 1, "y": 1}, set())


@pytest.mark.parametrize(
    ("function", "ends", "expected"),
    [
        # About the middle: 1/4, and the slope 1 - 2 x of at most 1/5 times a half width of 1/10.
        (lambda ar, x: x * (1 - x), (F(2, 5), F(3, 5)), (F(23, 100), F(27, 100))),
        # By the factors alone, whatever their relation: the slope 2 x gives -2 to 2.
        (lambda ar, x: x * x, (F(-1), F(1)), (F(-1), F(1))),
    ],
    ids=["middle", "factors"],
)
def test_where_nothing_is_monotone_the_narrower_of_two_bounds_holds(
    function: Callable[..., Any], ends: tuple[F, F], expected: tuple[F, F]
) -> None:
    """The bound of interval arithmetic, and that of the slopes about the middle of the box."""
    result = enclose(function, {"x": ends})
    assert result.signs == {"x": 0}
    assert result.ends == pytest.approx(expected, abs=1e-20)


def test_bounds_that_nothing_narrows_are_those_of_the_box() -> None:
    constraint = (lambda ar, x, y: x * y, Interval(F(-1, 2), F(1, 2)))
    assert bounds([constraint], "x", {"x": (F(-2), F(2)), "y": (F(-1), F(1))}) == (-2, 2)


def test_several_constraints_are_met_at_once_or_proven_to_exclude_each_other() -> None:
    square = {"x": (F(0), F(3)), "y": (F(0), F(3))}
    total, product_ = (lambda ar, x, y: x + y), (lambda ar, x, y: x * y)
    assert outcome_of((total, 4, 5), (product_, 4, 9), **square) is SHOWN
    assert outcome_of((total, 0, 1), (FUNCTIONS["saddle"], 3, 9), **square) is REFUTED
    weighted, difference = (lambda ar, x, y: x + 2 * y), (lambda ar, x, y: x - y)
    narrow = (weighted, F(29, 10), F(291, 100)), (difference, F(-3, 2), F(-149, 100))
    assert outcome_of(*narrow, x=(F(-3), F(3)), y=(F(0), F(9)), budget=1) is SHOWN
