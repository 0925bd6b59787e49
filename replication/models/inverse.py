"""The inverse questions: which resistance, velocity, radius or density gives a final depth.

By Eqs. 12-13 the final depth X = R y of an impact satisfies

    CV/PV = (rho_p / rho_t) L, L = ln(1 + p), p = rho_t V^2 / 2 R_t

with CV/PV, the crater's volume over the particle's, a function of y alone (`crater`). So y does not
depend on the particle's size, and X = R y gives the radius; L = (rho_t / rho_p) CV/PV gives
p = e^L - 1, and with it the resistance or the velocity; CV/PV is proportional to the particle's
density. Each of these has exactly one solution for every depth.

The target's density is in p and in front of the logarithm. As it falls to 0, the depth rises to
the one at the constant pressure R_t, where CV/PV = m = rho_p V^2 / 2 R_t. A deeper crater has no
solution, and any other has exactly one: L solves (e^L - 1) / L = m / (CV/PV) = k, whose left side
rises from 1 on.
"""

import math

from replication.models.crater import crater_volume_ratio
from replication.models.depth import normalized_depth
from replication.models.estimates import constant_pressure_depth
from replication.models.impact import InputError, check_in_doubles, check_products

LARGEST_LOGARITHM = 600.0
"""A logarithm L beyond which e^L is treated as infinite: of inputs in range it is 576 at most."""


def resistance_for_depth(
    depth: float, velocity: float, radius: float, particle_density: float, target_density: float
) -> float:
    """Target resistance R_t [Pa] at which the final depth is X (Eqs. 12-13).

    R_t = rho_t V^2 / 2 (e^L - 1), L = (rho_t / rho_p) CV/PV. With R_t = beta Y_t (Eq. 7) it gives
    beta for a flow stress, and the flow stress for a beta. An infinite result stands for one that
    no double can hold.

    >>> f"{resistance_for_depth(3.3e-6, 500.0, 11e-6, 8900.0, 7850.0) / 1e9:.1f}"
    '17.8'
    """
    logarithm = crater_volume_ratio(depth, radius) * (target_density / particle_density)
    p = _pressure_over_resistance(logarithm)
    return target_density * velocity * velocity / (2 * p) if p > 0 else math.inf


def velocity_for_depth(
    depth: float, radius: float, particle_density: float, target_density: float, resistance: float
) -> float:
    """Impact velocity V [m/s] at which the final depth is X (Eqs. 12-13).

    V^2 = (2 R_t / rho_t) (e^L - 1), L = (rho_t / rho_p) CV/PV.

    >>> f"{velocity_for_depth(3.3e-6, 11e-6, 8900.0, 7850.0, 3.5e9):.1f}"
    '221.5'
    """
    logarithm = crater_volume_ratio(depth, radius) * (target_density / particle_density)
    # Roots first, as the product of what is under them may overflow.
    p = _pressure_over_resistance(logarithm)
    return math.sqrt(2 * resistance / target_density) * math.sqrt(p)


def radius_for_depth(
    depth: float, velocity: float, particle_density: float, target_density: float,
    resistance: float,
) -> float:  # fmt: skip
    """Particle radius R [m] at which the final depth is X (Eqs. 12-13): X / y.

    >>> f"{radius_for_depth(3.3e-6, 500.0, 8900.0, 7850.0, 3.5e9) * 1e6:.2f}"
    '4.73'
    """
    y = normalized_depth(velocity, particle_density, target_density, resistance)
    return depth / y if y > 0 else math.inf


def particle_density_for_depth(
    depth: float, velocity: float, radius: float, target_density: float, resistance: float
) -> float:
    """Particle density rho_p [kg/m^3] at which the final depth is X (Eqs. 12-13).

    rho_p = rho_t (CV/PV) / ln(1 + rho_t V^2 / 2 R_t).

    >>> f"{particle_density_for_depth(3.3e-6, 500.0, 11e-6, 7850.0, 3.5e9):.0f}"
    '1930'
    """
    p = target_density * velocity * velocity / (2 * resistance)
    if p == 0:
        return math.inf
    return crater_volume_ratio(depth, radius) / math.log1p(p) * target_density


def target_density_for_depth(
    depth: float, velocity: float, radius: float, particle_density: float, resistance: float
) -> float:
    """Target density rho_t [kg/m^3] at which the final depth is X (Eqs. 12-13), if there is one.

    A denser target stops the particle earlier. There is exactly one solution for a depth less than
    `constant_pressure_depth`, which a target without density would have, and none for any other: in
    an array its place is NaN, and for plain numbers a ValueError says why. Close to that limit the
    density becomes small and its relative error large, as the depth hardly depends on it.

    >>> f"{target_density_for_depth(7.674933e-6, 500.0, 11e-6, 8900.0, 3.5e9):.0f}"
    '7850'
    """
    ratio = crater_volume_ratio(depth, radius)
    most = particle_density * velocity * velocity / (2 * resistance)
    if not 0 < ratio < most:
        return math.nan
    excess = (most - ratio) / ratio
    return particle_density * (_logarithm(excess) / ratio) if excess < math.inf else math.inf


def conditions(
    velocity: float, particle_density: float, target_density: float, resistance: float
) -> dict[str, float]:
    """Return the condition of each inverse: d ln input / d ln X [1], in closed form.

    It is the relative change of the input that is sought, for one of the final depth, all else
    equal. It is the inverse of `elasticities`, without cancellation for slow impacts:
    with y d(CV/PV)/dy = t CV/PV it is -t L e^L / (e^L - 1) for the resistance, minus half of that
    for the velocity, t for the particle's density, -t / (1 - (1 - e^-L) / L) for the target's, and
    1 for the radius. V [m/s], rho_p and rho_t [kg/m^3], R_t [Pa].

    >>> by_input = conditions(500.0, 8900.0, 7850.0, 3.5e9)
    >>> f"{by_input['resistance']:.3f}", f"{by_input['target_density']:.3f}"
    ('-1.915', '-14.887')
    """
    p = target_density * velocity * velocity / (2 * resistance)
    logarithm = math.log1p(p)
    y = normalized_depth(velocity, particle_density, target_density, resistance)
    t = 3 * (2 - y) / (3 - y) if y < 1 else 3 * y / (3 * y - 1)
    by_resistance = -t * logarithm * (1 + p) / p
    share = -math.expm1(-logarithm) * _slope(logarithm)
    return {
        "velocity": -by_resistance / 2, "radius": 1.0, "particle_density": t,
        "target_density": -t / share, "resistance": by_resistance,
    }  # fmt: skip


class NoSolutionError(InputError):
    """No value of the input that is sought gives the depth, however large or small it is."""


def check_solution(name: str, value: float, **inputs: float) -> None:
    """Raise InputError unless a solution and its inputs are within the range of the models.

    `value` is the input `name` that an inverse found. Raises NoSolutionError if it is NaN since
    there is no solution.

    >>> check_solution("target_density", math.nan, depth=9e-6, velocity=500.0, radius=11e-6,
    ...                particle_density=8900.0, resistance=3.5e9)
    Traceback (most recent call last):
    replication.models.inverse.NoSolutionError: target density has no value that gives 9 um: \
without any, at the constant pressure R_t, the depth is 8.273 um
    """
    if "radius" in inputs:
        y = inputs["depth"] / inputs["radius"]
        check_in_doubles("depth over radius squared", y * y)
    if name == "target_density":
        energy = inputs["particle_density"] * inputs["velocity"] * inputs["velocity"]
        check_in_doubles("particle density times velocity squared", energy)
        check_in_doubles("this over target resistance", energy / inputs["resistance"])
    if name == "target_density" and math.isnan(value):
        names = ("velocity", "radius", "particle_density", "resistance")
        most = constant_pressure_depth(*(inputs[name] for name in names))
        depth = inputs["depth"]
        problem = f"has no value that gives {depth * 1e6:.8g} um: without any, at the constant"
        words = name.replace("_", " ")
        raise NoSolutionError(words, f"{problem} pressure R_t, the depth is {most * 1e6:.4g} um")
    if not 0 < value < math.inf:
        problem = f"is {value!r} for this depth: doubles carry 1e-250 to 1e250 safely"
        raise InputError(name, problem)
    check_products(**inputs, **{name: value})


def _pressure_over_resistance(logarithm: float) -> float:
    """Return p = e^L - 1, infinite where it might overflow: Python raises an error there."""
    return math.expm1(logarithm) if logarithm < LARGEST_LOGARITHM else math.inf


def _logarithm(excess: float) -> float:
    """Return the L > 0 with (e^L - 1) / L = k, given k - 1 > 0.

    Newton's method for ln((e^L - 1) / L) = ln k. The left side lies between L/2 and L, so that
    2 ln k is at or above the root; and its slope rises from 1/2 to 1, so that from there every step
    ends at or above the root, too, nearer to it. The first step that is not downwards is due to
    rounding, and the end.
    """
    goal = math.log1p(excess)
    upper = 2 * goal
    while True:
        lower = upper - (_log_mean(upper) - goal) / _slope(upper)
        if not 0 < lower < upper:
            return upper
        upper = lower


def _log_mean(logarithm: float) -> float:
    """Return ln((e^L - 1) / L): the logarithm of the mean of e^t for t from 0 to L > 0."""
    if logarithm < 1:
        return math.log1p(logarithm * _mean_excess(logarithm))
    return logarithm + math.log(-math.expm1(-logarithm) / logarithm)


def _slope(logarithm: float) -> float:
    """Return the derivative of `_log_mean`, 1 + 1/(e^L - 1) - 1/L, which is between 1/2 and 1."""
    if logarithm < 1:
        excess = _mean_excess(logarithm)
        return 1 - excess / (1 + logarithm * excess)
    return -1 / math.expm1(-logarithm) - 1 / logarithm


def _mean_excess(logarithm: float) -> float:
    """Return ((e^L - 1) / L - 1) / L = 1/2 + L/6 + L^2/24 + ..., for L < 1.

    The first term that is left out, L^17/19!, is less than 1e-17.
    """
    total = 0.0
    for k in range(18, 1, -1):
        total = (1 + logarithm * total) / k
    return total
