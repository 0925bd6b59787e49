"""The equations against other routes: quadrature, another integrator, rationals, the table."""

from decimal import Decimal, localcontext
from fractions import Fraction
from itertools import islice
from typing import Any

import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference import exact
from reference.computations import COMPUTATIONS
from reference.enclosure import evaluate
from reference.exact import Reals
from reference.intervals import Intervals

CASE = {
    "velocity": Fraction(500),
    "radius": Fraction("1.1e-5"),
    "particle_density": Fraction(8900),
    "target_density": Fraction(7850),
    "resistance": Fraction(3_500_000_000),
}
STEP = Fraction("2e-10")
PI = Fraction("3.14159265358979323846264338327950288419716939937510582097494")
ARMOR = {
    "length_ratio": Fraction(2, 3),
    "particle_density": Fraction(8900),
    "target_density": Fraction(7850),
    "k_1": Fraction("0.557"),
    "k_t": Fraction("1.046"),
    "resistance": Fraction("9.13e9"),
    "velocity": Fraction(500),
}


def numbers(ar: Reals, inputs: dict[str, Fraction], **changes: Fraction) -> dict[str, Any]:
    return {name: ar.number(value) for name, value in {**inputs, **changes}.items()}


def close(one: Any, other: Any, digits: int) -> bool:
    return bool(abs(one - other) <= abs(other) * mpmath.mpf(10) ** -digits)


# Eq. 13


def area_by_the_chord(ar: Reals, x: Any, radius: Any) -> Any:
    """Eq. 12 and Eq. 13 as printed: pi (D x - x^2) up to R, pi R^2 beyond."""
    return ar.context.pi * (2 * radius * x - x * x if x < radius else radius * radius)


@pytest.mark.parametrize("share", [0, "1/7", "1/2", "99/100", 1, "101/100", 5])
def test_contact_area_is_eq_12_then_constant(share: str | int) -> None:
    ar = Reals(50)
    y = ar.number(Fraction(share))
    expected = area_by_the_chord(ar, y, ar.context.one) / ar.context.pi
    assert abs(exact.contact_share(ar, y) - expected) <= ar.context.mpf(10) ** -48


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"resistance": Fraction(2_100_000_000)},
        {"velocity": Fraction(100)},
        {"target_density": Fraction(2700)},
        {"velocity": Fraction(1000)},
        {"resistance": Fraction(300_000_000)},
        {"particle_density": Fraction(19300), "target_density": Fraction(2700)},
    ],
    ids=["beta 5", "beta 3", "slow", "light target", "fast", "soft, x > R", "tungsten, x > R"],
)
def test_final_depth_spends_the_energy(changes: dict[str, Fraction]) -> None:
    """Work done against the force, by quadrature in x, is what the velocity loses, by quadrature.

    From Eq. 13: the integral of A dx up to the depth is that of M v dv / (rho_t v^2/2 + R_t).
    """
    ar = Reals(40)
    case = numbers(ar, CASE, **changes)
    depth, radius = exact.final_depth(ar, **case), case["radius"]
    mass = case["particle_density"] * ar.context.pi * (2 * radius) ** 3 / 6
    knots = [0, min(depth, radius), depth]
    swept = ar.context.quad(lambda x: area_by_the_chord(ar, x, radius), knots)
    lost = ar.context.quad(
        lambda v: mass * v / (case["target_density"] * v**2 / 2 + case["resistance"]),
        [0, case["velocity"] / 2, case["velocity"]],
    )
    assert close(swept, lost, 35)


def test_the_cases_lie_on_both_sides_of_the_radius() -> None:
    ar = Reals(20)
    shallow = exact.final_depth(ar, **numbers(ar, CASE))
    deep = exact.final_depth(ar, **numbers(ar, CASE, resistance=Fraction(300_000_000)))
    assert shallow < ar.number(CASE["radius"]) < deep


@pytest.mark.parametrize("resistance", ["3.5e9", "3e8"])
def test_final_depth_is_where_a_runge_kutta_integration_of_eq_13_stops(resistance: str) -> None:
    """v^2 left at the final depth is the integrator's error: halving its step leaves a 16th."""
    ar = Reals(30)
    case = numbers(ar, CASE, resistance=Fraction(resistance))
    depth, radius = exact.final_depth(ar, **case), case["radius"]
    mass = case["particle_density"] * ar.context.pi * (2 * radius) ** 3 / 6

    def slope(x: Any, w: Any) -> Any:  # of w = v^2, as v dv/dx is half of it
        stress = case["target_density"] * w / 2 + case["resistance"]
        return -2 * stress * area_by_the_chord(ar, x, radius) / mass

    def left_over(steps: int) -> Any:
        x, w = ar.context.zero, case["velocity"] ** 2
        for leg in (min(depth, radius), max(depth - radius, ar.context.zero)):
            h = leg / steps
            for _ in range(steps):
                k1 = slope(x, w)
                k2 = slope(x + h / 2, w + h / 2 * k1)
                k3 = slope(x + h / 2, w + h / 2 * k2)
                k4 = slope(x + h, w + h * k3)
                x, w = x + h, w + h * (k1 + 2 * k2 + 2 * k3 + k4) / 6
        return w

    assert 12 < left_over(50) / left_over(100) < 20


def c_of_one() -> dict[str, Fraction]:
    """Inputs whose c is ln(1 + 1/resistance), with radius 1."""
    return {
        "velocity": Fraction(1),
        "radius": Fraction(1),
        "particle_density": Fraction(3),
        "target_density": Fraction(2),
        "resistance": Fraction(1),
    }


def depth_for(ar: Reals, c: Any) -> Any:
    """Depth over radius at a given c: 4/3 * density ratio * ln(1 + 1/r), here 2 ln(1 + 1/r)."""
    case = numbers(ar, c_of_one())
    case["resistance"] = 1 / ar.context.expm1(c / 2)
    return exact.final_depth(ar, **case)


def test_the_depth_is_continuous_at_the_radius() -> None:
    ar = Reals(50)
    tiny = ar.context.mpf(10) ** -30
    limit = ar.number(Fraction(2, 3))
    at = depth_for(ar, limit)
    assert close(at, ar.context.one, 24)
    # dy/dc is 1 / (2y - y^2) = 1 on both sides of y = 1.
    assert close((depth_for(ar, limit + tiny) - at) / tiny, ar.context.one, 10)
    assert close((at - depth_for(ar, limit - tiny)) / tiny, ar.context.one, 10)


@pytest.mark.parametrize("exponent", [-4, -10, -20])
def test_a_tiny_c_gives_its_square_root(exponent: int) -> None:
    ar = Reals(60)
    c = ar.context.mpf(10) ** exponent
    # y = sqrt(c) (1 + sqrt(c)/6 + 5c/72 + ...), so after two terms the error is below c/10
    assert abs(depth_for(ar, c) / ar.context.sqrt(c) - 1 - ar.context.sqrt(c) / 6) < c / 10


@pytest.mark.parametrize("c", [1, 20, 100])
def test_a_great_c_adds_one_radius_per_unit(c: int) -> None:
    ar = Reals(60)
    assert close(depth_for(ar, ar.number(c)), ar.number(Fraction(3 * c + 1, 3)), 45)


def test_a_particle_at_rest_stays_where_it_is() -> None:
    ar = Reals(30)
    assert exact.final_depth(ar, **numbers(ar, CASE, velocity=Fraction(0))) == 0


@settings(deadline=None, max_examples=30)
@given(c=st.fractions(Fraction(1, 10**6), Fraction(2, 3), max_denominator=10**6))
def test_the_root_agrees_with_the_trigonometric_one(c: Fraction) -> None:
    ar = Reals(50)
    mp = ar.context
    h = mp.asin(mp.sqrt(3 * ar.number(c)) / 2) / 3
    assert close(ar.cap_root(ar.number(c)), 4 * mp.sin(h) * mp.sin(h + mp.pi / 3), 45)


def test_thirty_digits_agree_with_sixty() -> None:
    few, many = Reals(30), Reals(60)
    for resistance in (CASE["resistance"], Fraction(300_000_000)):
        one = exact.final_depth(few, **numbers(few, CASE, resistance=resistance))
        other = exact.final_depth(many, **numbers(many, CASE, resistance=resistance))
        assert close(many.context.mpf(one), other, 27)
        assert not close(many.context.mpf(one), other, 45)
    rows = [
        next(islice(exact.midpoint(ar, **numbers(ar, CASE), step=ar.number(STEP)), 99, None))
        for ar in (few, many)
    ]
    for one, other in zip(*rows, strict=True):
        assert close(many.context.mpf(one), other, 26)


# The crater


@pytest.mark.parametrize("depth", ["0", "1/3", "1", "3/2", "2"])
@pytest.mark.parametrize("radius", ["1", "11/5"])
def test_cap_volume_is_eq_2(depth: str, radius: str) -> None:
    r = Fraction(radius)
    x = Fraction(depth) * r
    assert exact.cap_volume(x, r) == x**2 * (3 * r - x) / 3


def test_cap_volume_is_the_integral_of_the_contact_area() -> None:
    ar = Reals(30)
    radius, depth = ar.number(2), ar.number(Fraction(5, 4))
    shares = ar.context.quad(lambda x: exact.contact_share(ar, x / radius), [0, depth])
    expected = exact.cap_volume(Fraction(5, 4), Fraction(2))
    assert close(radius**2 * shares, ar.number(expected), 27)


@pytest.mark.parametrize("ratio", ["1e-12", "0.055", "0.06", "0.065", "1/4", "1/2"])
def test_the_crater_depth_solves_its_cubic(ratio: str) -> None:
    ar = Reals(50)
    y = exact.crater_normalized_depth(ar, ar.number(Fraction(ratio)))
    share = y**2 * (3 - y) / 4  # CV/PV from Eqs. 2 and 3, with X = y R
    assert close(share, ar.number(Fraction(ratio)), 45)
    assert 0 < y <= 1


# The sheet


def rows_in_rationals(count: int, **inputs: Fraction) -> list[tuple[Fraction, ...]]:
    """The appendix, sentence by sentence, from the whole sphere's mass and the chord's area."""
    v, dt, radius = inputs["velocity"], inputs["step"], inputs["radius"]
    mass = Fraction(4, 3) * PI * radius**3 * inputs["particle_density"]
    x, rows = Fraction(0), []
    for k in range(1, count + 1):
        x += v * (dt / 2 if k == 1 else dt)
        area = PI * (2 * radius * x - x**2)
        a = (inputs["target_density"] * v**2 / 2 + inputs["resistance"]) * area / mass
        rows.append((k * dt, v, x, a, v - a * dt))
        v -= a * dt
    return rows


def test_the_first_rows_are_those_of_rational_arithmetic() -> None:
    ar = Reals(40)
    case = {**CASE, "step": STEP}
    rows = islice(exact.midpoint(ar, **numbers(ar, case)), 6)
    for row, expected in zip(rows, rows_in_rationals(6, **case), strict=True):
        for value, rational in zip(row, expected, strict=True):
            assert close(value, ar.number(rational), 37)


def test_every_row_follows_from_the_one_before_in_decimal_arithmetic() -> None:
    """All 131 rows, in Python's decimals of 40 digits, down to the stop velocity."""
    ar = Reals(40)
    with localcontext(prec=40):
        pi = Decimal(PI.numerator) / Decimal(PI.denominator)
        v, dt, r = Decimal(500), Decimal("2e-10"), Decimal("1.1e-5")
        mass, x = Decimal(4) / 3 * pi * r**3 * 8900, -v * dt / 2
        for row in exact.midpoint(ar, **numbers(ar, {**CASE, "step": STEP})):
            x += v * dt
            v -= (7850 * v * v / 2 + Decimal("3.5e9")) * pi * (2 * r * x - x * x) / mass * dt
            assert close(row.velocity_final, ar.context.mpf(str(v)), 30)
            if v < 1:
                break
        assert close(row.depth, ar.context.mpf(str(x)), 35)


def test_the_rows_are_those_of_table_a_1() -> None:
    ar = Reals(30)
    table = [
        ("2.00E-10", "5.00E+02", "5.00E-08", "3.11E+08", "5.00E+02"),
        ("4.00E-10", "5.00E+02", "1.50E-07", "9.30E+08", "5.00E+02"),
        ("6.00E-10", "5.00E+02", "2.50E-07", "1.54E+09", "4.99E+02"),
        ("8.00E-10", "4.99E+02", "3.50E-07", "2.15E+09", "4.99E+02"),
    ]
    rows = islice(exact.midpoint(ar, **numbers(ar, CASE), step=ar.number(STEP)), 4)
    printed = [tuple(f"{float(value):.2E}" for value in row) for row in rows]
    assert printed == table


def test_the_contact_area_stays_constant_beyond_the_radius() -> None:
    ar = Reals(30)
    case = numbers(ar, CASE, resistance=Fraction(300_000_000), step=STEP)
    deep = [row for row in islice(exact.midpoint(ar, **case), 400) if row.depth > case["radius"]]
    assert len(deep) > 10
    for row in deep:
        stress = case["target_density"] * row.velocity_initial**2 / 2 + case["resistance"]
        # pi R^2 over the mass is 3 / (4 R rho_p)
        expected = stress * 3 / (4 * case["radius"] * case["particle_density"])
        assert close(row.deceleration, expected, 27)


def test_the_centered_variant_takes_the_velocity_half_a_step_on() -> None:
    ar = Reals(40)
    inputs = numbers(ar, {**CASE, "step": STEP})
    rows = islice(exact.midpoint(ar, **inputs, centered=True), 50)
    mass = inputs["particle_density"] * ar.context.pi * (2 * inputs["radius"]) ** 3 / 6
    for row in rows:
        area = area_by_the_chord(ar, row.depth, inputs["radius"])

        def force(v: Any, area: Any = area) -> Any:
            return (inputs["target_density"] * v**2 / 2 + inputs["resistance"]) * area

        half_on = row.velocity_initial - force(row.velocity_initial) / mass * inputs["step"] / 2
        assert close(row.deceleration, force(half_on) / mass, 37)
        v_final = row.velocity_initial - row.deceleration * inputs["step"]
        assert close(row.velocity_final, v_final, 37)


def test_a_given_mass_replaces_the_sphere_s() -> None:
    ar = Reals(40)
    inputs = numbers(ar, {**CASE, "step": STEP})
    sphere = inputs["particle_density"] * ar.context.pi * (2 * inputs["radius"]) ** 3 / 6
    for factor in (1, 2):
        own = next(exact.midpoint(ar, **inputs))
        given = next(exact.midpoint(ar, **inputs, mass=sphere * factor))
        assert close(own.deceleration, given.deceleration * factor, 37)


def test_the_rows_end_with_the_first_that_is_certain_to_be_below() -> None:
    stop = Fraction(1)
    for ar, width in ((Reals(30), Fraction(0)), (Intervals(30), Fraction(5))):
        inputs = numbers(ar, {**CASE, "step": STEP})
        if width:
            inputs["velocity"] = ar.interval(500 - width, 500 + width)
        *rows, last = exact.midpoint(ar, **inputs, stop_velocity=ar.number(stop))
        assert ar.is_below(last.velocity_final, ar.number(stop))
        assert not any(ar.is_below(row.velocity_final, ar.number(stop)) for row in rows)
        undecided = [row for row in rows if ar.may_be_below(row.velocity_final, ar.number(stop))]
        assert bool(undecided) == bool(width)


def fake_rows(ar: Any, *velocities: tuple[int, int]) -> Any:
    """Rows whose depth is their number and whose final velocity lies between the two numbers."""
    zero = ar.number(0)
    for k, (low, high) in enumerate(velocities, 1):
        v = ar.number(low) if low == high else ar.interval(Fraction(low), Fraction(high))
        yield exact.Row(zero, zero, ar.number(k), zero, v)


def test_the_sheet_stops_with_the_first_row_below_the_stop_velocity() -> None:
    ar = Reals(20)
    rows = fake_rows(ar, (5, 5), (2, 2), (1, 1), (0, 0))
    assert exact.sheet_depth(ar, rows, ar.number(1)) == 4


def test_over_intervals_every_row_counts_that_may_be_the_first() -> None:
    ar = Intervals(20)
    rows = fake_rows(ar, (5, 6), (1, 4), (0, 3), (-2, 2), (-3, 0))
    assert ar.ends(exact.sheet_depth(ar, rows, ar.number(1))) == (3, 5)


def test_a_wide_box_does_not_run_for_ever(monkeypatch: pytest.MonkeyPatch) -> None:
    """Inputs known to 20%: each row's bounds lie farther apart, but the rows must end."""
    endless = exact.midpoint

    def limited(*arguments: Any, **inputs: Any) -> Any:
        for count, row in enumerate(endless(*arguments, **inputs)):
            assert count < 1000, "it should have ended by now; the report's sheet has 131 rows"
            yield row

    monkeypatch.setattr(exact, "midpoint", limited)
    case = {**CASE, "step": STEP, "stop_velocity": Fraction(1)}
    box = {name: (value, value) for name, value in case.items()}
    wide = {key: (case[key] * 4 / 5, case[key] * 6 / 5) for key in ("radius", "velocity")}
    function = COMPUTATIONS["sheet_depth"].function
    low, high = evaluate(function, {**box, **wide})
    for radius in wide["radius"]:
        for velocity in wide["velocity"]:
            corner = {"radius": (radius, radius), "velocity": (velocity, velocity)}
            inner = evaluate(function, {**box, **corner})
            assert low <= inner[0] <= inner[1] <= high


# Frank and Zook


@pytest.mark.parametrize(
    "changes",
    [{}, {"resistance": Fraction("7.6e9")}, {"k_1": Fraction(0)}, {"velocity": Fraction(2000)}],
)
def test_frank_zook_is_the_integral_of_eqs_14_and_15(changes: dict[str, Fraction]) -> None:
    """From dv/dt = -Y/(L rho_p) and v = dx/dt: X/D by quadrature over v, with D = 1."""
    ar = Reals(40)
    case = numbers(ar, ARMOR, **changes)

    def inverse_slope(v: Any) -> Any:
        # L rho_p v dv/dx = -(k_t rho_t v^2 + R_t + k_1 rho_t D v dv/dx)
        inertia = case["length_ratio"] * case["particle_density"] + (
            case["k_1"] * case["target_density"]
        )
        return inertia * v / (case["k_t"] * case["target_density"] * v * v + case["resistance"])

    depth = ar.context.quad(inverse_slope, [0, case["velocity"] / 2, case["velocity"]])
    assert close(exact.frank_zook_diameters(ar, **case), depth, 35)


def test_frank_zook_armor_in_doubles() -> None:
    # Eq. 16 by hand: (2/3 * 8900/7850 + 0.557) / 2.092 * ln(1 + 1.046 * 7850 * 500^2 / 9.13e9)
    ar = Reals(30)
    assert abs(exact.frank_zook_diameters(ar, **numbers(ar, ARMOR)) - 0.127) < 0.001


# Contexts


def test_no_global_precision_is_read_or_changed() -> None:
    before = mpmath.mp.dps, mpmath.mp.prec
    depths = []
    for digits in (15, 70):
        with mpmath.workdps(digits):
            ar = Reals(50)
            depths.append(exact.final_depth(ar, **numbers(ar, CASE)))
    assert depths[0] == depths[1]
    assert (mpmath.mp.dps, mpmath.mp.prec) == before
    assert Reals(50).context.dps == 50
    assert Reals().context.dps == 50
    assert Reals(30).context is not Reals(30).context


@pytest.mark.parametrize(
    ("a", "b"), [(1, 2), (2, 1), (-1, 1), (0, 0), (Fraction(1, 3), Fraction(1, 2))]
)
def test_reals_order_numbers(a: Fraction, b: Fraction) -> None:
    ar = Reals(20)
    x, y = ar.number(a), ar.number(b)
    assert ar.least(x, y) == ar.number(min(a, b))
    assert ar.greatest(x, y) == ar.number(max(a, b))
    assert ar.may_be_below(x, y) == ar.is_below(x, y) == (a < b)
    assert ar.hull([x]) == x


def test_a_rational_is_rounded_once() -> None:
    ar = Reals(20)
    third = ar.number(Fraction(1, 3))
    assert abs(Fraction(*third.as_integer_ratio()) - Fraction(1, 3)) < Fraction(1, 10**20)
    assert ar.number(7) == 7
