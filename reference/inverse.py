"""Which input gives a final depth, in any arithmetic: to any precision, and as a proven interval.

The integral of Eq. 13 (`reference.motion`), solved for each of its inputs. With y = X/R and the
area integral W(y), of the contact area over pi R^2 from 0 to y, an impact that ends at depth X has

    W(y) = (4 rho_p / 3 rho_t) L, L = ln(1 + rho_t V^2 / 2 R_t).

`Reals` give a value to any precision, `Intervals` an enclosure of all values for inputs in a box.
All quantities are in SI units; the inputs are those of `Trajectory`, and `depth` is X.
"""

from collections.abc import Callable, Mapping
from fractions import Fraction

from reference.arithmetic import Arithmetic, Number
from reference.enclosure import Box, Ends, enclose


def area_integral(ar: Arithmetic, y: Number) -> Number:
    """Return W(y) [1]: y^2 - y^3/3 up to y = 1, and y - 1/3 beyond.

    >>> from reference.arithmetic import Rationals
    >>> area_integral(Rationals(), Fraction(3, 10)), area_integral(Rationals(), Fraction(2))
    (Fraction(81, 1000), Fraction(5, 3))
    """
    radius = ar.number(1)  # not y - least(y, 1), which is wide for an interval of y
    return ar.cap_volume(ar.least(y, radius)) + (ar.greatest(y, radius) - 1)


def depth_of_area_integral(ar: Arithmetic, c: Number) -> Number:
    """Return the y [1] at which W(y) = c."""
    at_radius = ar.number(Fraction(2, 3))
    return ar.cap_root(ar.least(c, at_radius)) + (ar.greatest(c, at_radius) - at_radius)


def _logarithm(
    ar: Arithmetic, depth: Number, radius: Number, particle_density: Number, target_density: Number
) -> Number:
    """Return L [1] of the impact that ends at this depth."""
    return 3 * area_integral(ar, depth / radius) / 4 * (target_density / particle_density)


def resistance(
    ar: Arithmetic, depth: Number, velocity: Number, radius: Number, particle_density: Number,
    target_density: Number,
) -> Number:  # fmt: skip
    """Return R_t [Pa] = rho_t V^2 / 2 (e^L - 1)."""
    p = ar.expm1(_logarithm(ar, depth, radius, particle_density, target_density))
    return target_density * velocity**2 / (2 * p)


def velocity(
    ar: Arithmetic, depth: Number, radius: Number, particle_density: Number,
    target_density: Number, resistance: Number,
) -> Number:  # fmt: skip
    """Return V [m/s], where V^2 = 2 R_t (e^L - 1) / rho_t."""
    p = ar.expm1(_logarithm(ar, depth, radius, particle_density, target_density))
    return ar.power(2 * resistance * p / target_density, Fraction(1, 2))


def radius(
    ar: Arithmetic, depth: Number, velocity: Number, particle_density: Number,
    target_density: Number, resistance: Number,
) -> Number:  # fmt: skip
    """Return R [m] = X / y; y does not depend on R."""
    p = target_density * velocity**2 / (2 * resistance)
    c = 4 * particle_density / (3 * target_density) * ar.log1p(p)
    return depth / depth_of_area_integral(ar, c)


def particle_density(
    ar: Arithmetic, depth: Number, velocity: Number, radius: Number, target_density: Number,
    resistance: Number,
) -> Number:  # fmt: skip
    """Return rho_p [kg/m^3] = (3/4) W rho_t / ln(1 + rho_t V^2 / 2 R_t)."""
    p = target_density * velocity**2 / (2 * resistance)
    return 3 * area_integral(ar, depth / radius) * target_density / (4 * ar.log1p(p))


def target_density(
    ar: Arithmetic, depth: Number, velocity: Number, radius: Number, particle_density: Number,
    resistance: Number,
) -> Number:  # fmt: skip
    """Return rho_t [kg/m^3] = rho_p L / (3/4) W, where (e^L - 1) / L = m / (3/4) W.

    m = rho_p V^2 / 2 R_t is (3/4) W in a target without density. If m is not greater than (3/4) W,
    there is no solution, and NoRootError is raised; over intervals 0 stands for what has none.
    """
    ratio = 3 * area_integral(ar, depth / radius) / 4
    most = particle_density * velocity**2 / (2 * resistance)
    return particle_density * ar.exp_mean_root(most / ratio) / ratio


INVERSES: Mapping[str, Callable[..., Number]] = {
    "resistance": resistance,
    "velocity": velocity,
    "radius": radius,
    "particle_density": particle_density,
    "target_density": target_density,
}
"""The inverses, by the name of the input that they return."""


def enclosed(name: str, box: Box) -> Ends | None:
    """Return proven ends (SI) of an input: all its values that give a depth, for inputs in a box.

    `name` is a key of INVERSES, or "beta" or "flow_stress" (R_t = beta Y_t, Eq. 7); the box has the
    depth and all other inputs, and may have beta and flow_stress in place of the resistance. None
    if there is no solution anywhere in the box; a lower end of 0 (of a target density) says that
    there is none in a part of it.

    >>> box = {"velocity": "500", "radius": "11e-6", "particle_density": "8900",
    ...        "target_density": "7850"}
    >>> box = {key: (Fraction(text), Fraction(text)) for key, text in box.items()}
    >>> depth = Fraction("3.25e-6"), Fraction("3.35e-6")  # prints 3.3 um
    >>> [f"{float(end) / 1e9:.1f}" for end in enclosed("resistance", {**box, "depth": depth})]
    ['17.3', '18.4']
    """

    def function(ar: Arithmetic, **inputs: Number) -> Number:
        if name in ("beta", "flow_stress"):
            factor = inputs.pop("flow_stress" if name == "beta" else "beta")
            return resistance(ar, **inputs) / factor
        if "beta" in inputs:
            inputs["resistance"] = inputs.pop("beta") * inputs.pop("flow_stress")
        return INVERSES[name](ar, **inputs)

    low, high = enclose(function, box).ends
    return (max(low, Fraction(0)), high) if high > 0 else None
