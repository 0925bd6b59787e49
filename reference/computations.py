"""What the ledger may ask for by name: each computation with the units of its inputs and result.

A claim of the ledger names one of these as what computes it. The functions take an arithmetic
(reals or intervals) and SI quantities; those that are exact in rational numbers return a Fraction.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from inspect import signature
from itertools import islice
from typing import Any

from reference import exact
from reference.exact import Arithmetic, Number

__all__ = ["COMPUTATIONS", "SAME", "Computation"]

SAME = "same"
"""In place of a unit: whatever the unit is, inputs and result share its dimension."""


@dataclass(frozen=True, slots=True)
class Computation:
    """A function of the reference, and the units by which its inputs and result are checked.

    `inputs` maps each input's name to its unit; the name "each" stands for any number of inputs
    with any names. A function with a parameter `row` takes the number of a row of the sheet besides
    (1 is the first time step).
    """

    function: Callable[..., Number | Fraction]
    unit: str
    inputs: Mapping[str, str]

    @property
    def name(self) -> str:
        """The name by which the ledger asks for it."""
        return self.function.__name__

    @property
    def any_number(self) -> bool:
        """Whether it takes any number of inputs."""
        return "each" in self.inputs

    @property
    def by_row(self) -> bool:
        """Whether it takes the number of a row."""
        return "row" in signature(self.function).parameters

    @property
    def summary(self) -> str:
        """What it computes: the first line of its docstring."""
        return (self.function.__doc__ or "").partition("\n")[0]


COMPUTATIONS: dict[str, Computation] = {}


def _computes(unit: str, **inputs: str) -> Callable[[Any], Any]:
    def register(function: Any) -> Any:
        COMPUTATIONS[function.__name__] = Computation(function, unit, inputs)
        return function

    return register


IMPACT = {
    "velocity": "m/s",
    "radius": "m",
    "particle_density": "kg/m^3",
    "target_density": "kg/m^3",
    "resistance": "Pa",
}
SHEET = {**IMPACT, "step": "s"}
FRANK_ZOOK = {
    "length_ratio": "1",
    "particle_density": "kg/m^3",
    "target_density": "kg/m^3",
    "k_1": "1",
    "k_t": "1",
    "resistance": "Pa",
    "velocity": "m/s",
}


# Restatements and plain arithmetic


@_computes(SAME, value=SAME)
def same_as(_: Arithmetic, value: Number) -> Number:
    """the same quantity where the report prints it elsewhere"""
    return value


@_computes(SAME, value=SAME)
def half(_: Arithmetic, value: Number) -> Number:
    """half of the printed number"""
    return value / 2


@_computes(SAME, value=SAME)
def twice(_: Arithmetic, value: Number) -> Number:
    """twice the printed number"""
    return 2 * value


@_computes("1", numerator=SAME, denominator=SAME)
def ratio(_: Arithmetic, numerator: Number, denominator: Number) -> Number:
    """ratio of two printed numbers"""
    return numerator / denominator


@_computes("1", each=SAME)
def count(_: Arithmetic, **values: Number) -> Fraction:
    """how many numbers the report lists"""
    return Fraction(len(values))


# The geometry of the crater, Eqs. 2-4 and 12


@_computes("1")
def cap_volume_factor(_: Arithmetic) -> Fraction:
    """factor of Eq. 2: the cap's volume over pi X^2 (3R - X), at X = R"""
    return exact.cap_volume(Fraction(1), Fraction(1)) / 2


@_computes("1")
def cap_volume_power(_: Arithmetic) -> Fraction:
    """power of X in Eq. 2: the cap's volume over 3R - X, compared at X = R/8 and X = R/4"""
    small, large = (exact.cap_volume(x, Fraction(1)) / (3 - x) for x in _EIGHTH_AND_QUARTER)
    return _log2(large / small)


@_computes("1")
def cap_volume_offset(_: Arithmetic) -> Fraction:
    """multiple of R in Eq. 2: the cap's volume over pi X^2 / 3, plus X, at X = R = 1"""
    return 3 * exact.cap_volume(Fraction(1), Fraction(1)) + 1


@_computes("1")
def sphere_volume_factor(_: Arithmetic) -> Fraction:
    """factor of Eq. 3: the cap's volume at X = 2R, over pi R^3"""
    return exact.cap_volume(Fraction(2), Fraction(1))


@_computes("1")
def sphere_volume_power(_: Arithmetic) -> Fraction:
    """power of R in Eq. 3: the sphere's volume at R = 2 against R = 1"""
    return _log2(
        exact.cap_volume(Fraction(4), Fraction(2)) / exact.cap_volume(Fraction(2), Fraction(1))
    )


@_computes("1")
def contact_area_power(_: Arithmetic) -> Fraction:
    """power of x in Eq. 12: D x - a^2 by Pythagoras, compared at x = R/8 and x = R/4"""
    small, large = (2 * x - (1 - (1 - x) ** 2) for x in _EIGHTH_AND_QUARTER)
    return _log2(large / small)


@_computes("1")
def sphere_length_ratio(_: Arithmetic) -> Fraction:
    """L/D of the cylinder with the sphere's diameter and volume: pi R^2 L = PV"""
    return exact.cap_volume(Fraction(2), Fraction(1)) / 2


@_computes("m^3", diameter="m")
def sphere_volume(ar: Arithmetic, diameter: Number) -> Number:
    """volume of a sphere of that diameter, Eq. 3"""
    return ar.context.pi * diameter**3 / 6


@_computes("1", volume_ratio="1")
def crater_normalized_depth(ar: Arithmetic, volume_ratio: Number) -> Number:
    """X/R at the given CV/PV, from Eqs. 2 and 3"""
    return exact.crater_normalized_depth(ar, volume_ratio)


@_computes("m", volume_ratio="1", diameter="m")
def crater_depth(ar: Arithmetic, volume_ratio: Number, diameter: Number) -> Number:
    """X at the given CV/PV and particle diameter, from Eqs. 2 and 3"""
    return crater_normalized_depth(ar, volume_ratio) * diameter / 2


@_computes("1", volume_ratio="1")
def crater_depth_over_diameter(ar: Arithmetic, volume_ratio: Number) -> Number:
    """X/D at the given CV/PV, from Eqs. 2 and 3"""
    return crater_normalized_depth(ar, volume_ratio) / 2


@_computes("m", normalized_depth="1", diameter="m")
def contact_diameter(ar: Arithmetic, normalized_depth: Number, diameter: Number) -> Number:
    """diameter of the contact circle at depth x, from Eq. 12"""
    return diameter * ar.context.sqrt(1 - (1 - normalized_depth) ** 2)


_EIGHTH_AND_QUARTER = (Fraction(1, 8), Fraction(1, 4))


def _log2(power_of_two: Fraction) -> Fraction:
    """The integer n with 2^n = x; anything else is no pure power and an error."""
    n = power_of_two.numerator.bit_length() - power_of_two.denominator.bit_length()
    if power_of_two != Fraction(2) ** n:
        raise ArithmeticError(f"{power_of_two} is not a power of two")
    return Fraction(n)


# Target resistance, Eqs. 7-11


@_computes("Pa", beta="1", flow_stress="Pa")
def target_resistance(_: Arithmetic, beta: Number, flow_stress: Number) -> Number:
    """R_t = beta Y_t, Eq. 7"""
    return beta * flow_stress


@_computes("1", q="1")
def goodier_beta(ar: Arithmetic, q: Number) -> Number:
    """beta from q (2a)^2 = pi a^2 beta Y_t, Eqs. 8 and 9"""
    return 4 * q / ar.context.pi


@_computes("1", elastic_modulus="Pa", flow_stress="Pa")
def walker_anderson_alpha(ar: Arithmetic, elastic_modulus: Number, flow_stress: Number) -> Number:
    """alpha = (2 E_t / 3 Y_t)^(1/3), Eq. 11"""
    return ar.context.exp(ar.context.log(2 * elastic_modulus / flow_stress / 3) / 3)


@_computes("1", elastic_modulus="Pa", flow_stress="Pa")
def walker_anderson_beta(ar: Arithmetic, elastic_modulus: Number, flow_stress: Number) -> Number:
    """beta = (7/3) ln(alpha), Eqs. 10 and 11"""
    return 7 * ar.context.log(2 * elastic_modulus / flow_stress / 3) / 9


BETAS = {"q": "1", "elastic_modulus": "Pa", "flow_stress": "Pa", "hardness_ratio": "1"}


@_computes("1", **BETAS)
def least_beta(ar: Arithmetic, hardness_ratio: Number, **inputs: Number) -> Number:
    """the least of the three estimates of beta"""
    return ar.least(hardness_ratio, ar.least(*_two_betas(ar, **inputs)))


@_computes("1", **BETAS)
def greatest_beta(ar: Arithmetic, hardness_ratio: Number, **inputs: Number) -> Number:
    """the greatest of the three estimates of beta"""
    one, other = _two_betas(ar, **inputs)
    return ar.greatest(hardness_ratio, ar.greatest(one, other))


def _two_betas(
    ar: Arithmetic, q: Number, elastic_modulus: Number, flow_stress: Number
) -> tuple[Number, Number]:
    return goodier_beta(ar, q), walker_anderson_beta(ar, elastic_modulus, flow_stress)


@_computes("1/s", velocity="m/s", length="m")
def strain_rate(_: Arithmetic, velocity: Number, length: Number) -> Number:
    """impact velocity over a typical dimension, section 3"""
    return velocity / length


# The sheet: the appendix and Table A-1


@_computes("kg", radius="m", particle_density="kg/m^3")
def particle_mass(ar: Arithmetic, radius: Number, particle_density: Number) -> Number:
    """mass of the sphere, Eq. 3 times the density"""
    return sphere_volume(ar, 2 * radius) * particle_density


@_computes("s", step="s")
def row_time(_: Arithmetic, row: int, step: Number) -> Number:
    """time that closes the row, k dt"""
    return row * step


@_computes("m/s", **SHEET)
def row_velocity_initial(ar: Arithmetic, row: int, **inputs: Number) -> Number:
    """velocity at the start of the row's time step"""
    return _row(ar, row, **inputs).velocity_initial


@_computes("m", **SHEET)
def row_depth(ar: Arithmetic, row: int, **inputs: Number) -> Number:
    """depth in the row, half a step behind its final velocity"""
    return _row(ar, row, **inputs).depth


@_computes("m/s^2", **SHEET)
def row_deceleration(ar: Arithmetic, row: int, **inputs: Number) -> Number:
    """deceleration in the row, Eqs. A-1 to A-3 over the mass"""
    return _row(ar, row, **inputs).deceleration


@_computes("m/s", **SHEET)
def row_velocity_final(ar: Arithmetic, row: int, **inputs: Number) -> Number:
    """velocity at the end of the row's time step"""
    return _row(ar, row, **inputs).velocity_final


@_computes("m/s^2", **IMPACT)
def deceleration_at_touch(
    ar: Arithmetic,
    velocity: Number,
    radius: Number,
    particle_density: Number,
    target_density: Number,
    resistance: Number,
) -> Number:
    """deceleration at x = 0, where D x - x^2 vanishes"""
    x = ar.number(0)
    stress = target_density * velocity**2 / 2 + resistance
    area = ar.context.pi * (2 * radius * x - x * x)
    return stress * area / particle_mass(ar, radius, particle_density)


@_computes("m", stop_velocity="m/s", **SHEET)
def sheet_depth(ar: Arithmetic, stop_velocity: Number, **inputs: Number) -> Number:
    """depth in the sheet's last row"""
    rows = exact.midpoint(ar, stop_velocity=stop_velocity, **inputs)
    return exact.sheet_depth(ar, rows, stop_velocity)


@_computes("1", stop_velocity="m/s", **SHEET)
def sheet_normalized_depth(ar: Arithmetic, radius: Number, **inputs: Number) -> Number:
    """X/R in the sheet's last row"""
    return sheet_depth(ar, radius=radius, **inputs) / radius


@_computes("1", stop_velocity="m/s", observed="1", **SHEET)
def sheet_over_observed(ar: Arithmetic, observed: Number, **inputs: Number) -> Number:
    """X/R in the sheet's last row over the observed X/R"""
    return sheet_normalized_depth(ar, **inputs) / observed


@_computes("1", stop_velocity="m/s", observed="1", **SHEET)
def sheet_excess_over_observed(ar: Arithmetic, **inputs: Number) -> Number:
    """by how many times the observed X/R the sheet's exceeds it"""
    return sheet_over_observed(ar, **inputs) - 1


def _row(ar: Arithmetic, row: int, **inputs: Number) -> exact.Row:
    rows = exact.midpoint(ar, **inputs)
    return next(islice(rows, row - 1, None))


# Frank and Zook, Eqs. 14-17


@_computes("1", **FRANK_ZOOK)
def frank_zook_as_printed(ar: Arithmetic, **inputs: Number) -> Number:
    """the right side of Eq. 16, taken as X/R as it is printed"""
    return exact.frank_zook_diameters(ar, **inputs)


@_computes("1", **FRANK_ZOOK)
def frank_zook_derived(ar: Arithmetic, **inputs: Number) -> Number:
    """X/R that follows from Eqs. 14 and 15: twice the right side of Eq. 16, which is X/D"""
    return 2 * exact.frank_zook_diameters(ar, **inputs)


@_computes("1")
def frank_zook_denominator(_: Arithmetic) -> Fraction:
    """multiple of k_t under the fraction bar, if Eq. 16 is to give X/R by Eqs. 14 and 15"""
    return _frank_zook_multiple(length=_DIAMETER / 2)


@_computes("1")
def frank_zook_denominator_for_diameters(_: Arithmetic) -> Fraction:
    """multiple of k_t under the fraction bar, if Eq. 16 is to give X/D by Eqs. 14 and 15"""
    return _frank_zook_multiple(length=_DIAMETER)


_DIAMETER = Fraction(3, 100)


def _frank_zook_multiple(length: Fraction) -> Fraction:
    """The multiple, from the work done at a vanishing velocity, where only R_t resists.

    There Eqs. 14 and 15 give (L rho_p + k_1 rho_t D) V^2 / 2 = R_t X, and Eq. 16 gives for X over
    the length ((L/D) (rho_p/rho_t) + k_1) rho_t V^2 / (multiple R_t). Any numbers serve.
    """
    rod, particle, target = Fraction(7, 100), Fraction(8900), Fraction(7850)
    k_1, resistance, velocity_squared = Fraction(557, 1000), Fraction(913, 100), Fraction(1)
    work = (rod * particle + k_1 * target * _DIAMETER) * velocity_squared / 2
    depth = work / resistance
    inertia = rod / _DIAMETER * particle / target + k_1
    return inertia * target * velocity_squared / (resistance * depth / length)


@_computes("1")
def frank_zook_offset(ar: Arithmetic) -> Number:
    """argument of the logarithm of Eq. 16 at V = 0, where there is no depth"""
    return ar.context.exp(ar.number(0))
