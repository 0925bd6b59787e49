"""What the ledger may ask for by name: each computation with the units of its inputs and result.

A claim of the ledger names one of these as what computes it. The functions take an arithmetic, the
report's equations as printed (`Sides`), and inputs in SI units; where the report prints the
formula, it is the printed one that is evaluated, its constants included. A result that is exact in
rational numbers is a Fraction.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from inspect import signature
from itertools import islice
from typing import Any

from reference.arithmetic import Arithmetic, Number
from reference.derivations import Sides
from reference.equations import evaluate
from reference.motion import sheet_depth, sheet_rows
from reference.units import unit_dimension

SAME = "same"
"""In place of a unit: whatever the unit is, inputs and result share its dimension."""

EXPONENT = "exponent"
"""In place of a unit: a number that the equation has as an exponent, given as a Fraction."""


@dataclass(frozen=True, slots=True)
class Computation:
    """A function of the reference, and the units by which its inputs and result are checked.

    `inputs` maps each input's name to its unit; the name "each" stands for any number of inputs
    with any names. `equations` are the printed ones that it evaluates. What `restates` only repeats
    or counts what the report prints elsewhere. `by_row`: it takes the number of a row of the sheet
    (1 is the first time step); `by_scheme`: it runs the sheet, in either of the two schemes that
    fit the report's words.
    """

    function: Callable[..., Number | Fraction]
    unit: str
    inputs: Mapping[str, str]
    equations: tuple[str, ...] = ()
    restates: bool = False
    by_row: bool = False
    by_scheme: bool = False

    @property
    def name(self) -> str:
        """The name by which the ledger asks for it."""
        return self.function.__name__

    @property
    def any_number(self) -> bool:
        """Whether it takes any number of inputs."""
        return "each" in self.inputs

    @property
    def summary(self) -> str:
        """What it computes: the first line of its docstring."""
        return (self.function.__doc__ or "").partition("\n")[0]


COMPUTATIONS: dict[str, Computation] = {}


def _computes(unit: str, /, *equations: str, **inputs: str) -> Callable[[Any], Any]:
    def register(function: Any) -> Any:
        takes = signature(function).parameters
        restates = function.__name__ in ("same_as", "count")
        entry = Computation(
            function, unit, inputs, equations, restates, "row" in takes, "centered" in takes
        )
        COMPUTATIONS[function.__name__] = entry
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
SYMBOLS = {
    "length_ratio": "L",
    "particle_density": "rho_p",
    "target_density": "rho_t",
    "k_1": "k_1",
    "k_t": "k_t",
    "resistance": "R_t",
    "velocity": "V",
    "elastic_modulus": "E_t",
    "flow_stress": "Y_t",
}
"""The symbol of an equation that an input stands for."""


# Restatements and plain arithmetic


@_computes(SAME, value=SAME)
def same_as(ar: Arithmetic, printed: Sides, value: Number) -> Number:
    """the same quantity where the report prints it elsewhere"""
    return value


@_computes("1", each=SAME)
def count(ar: Arithmetic, printed: Sides, **values: Number) -> Fraction:
    """how many numbers the report lists"""
    return Fraction(len(values))


@_computes(SAME, value=SAME)
def half(ar: Arithmetic, printed: Sides, value: Number) -> Number:
    """half of the printed number"""
    return value / 2


@_computes("1", numerator=SAME, denominator=SAME)
def ratio(ar: Arithmetic, printed: Sides, numerator: Number, denominator: Number) -> Number:
    """ratio of two printed numbers"""
    return numerator / denominator


@_computes("1", numerator=SAME, denominator=SAME)
def excess(ar: Arithmetic, printed: Sides, numerator: Number, denominator: Number) -> Number:
    """by how many times the second of two printed numbers the first exceeds it"""
    return numerator / denominator - 1


@_computes("m", "diameter", diameter="m")
def radius_of(ar: Arithmetic, printed: Sides, diameter: Number) -> Number:
    """radius of a sphere of that diameter"""
    return diameter / _diameter(ar, printed, ar.number(1))


@_computes("m", "diameter", radius="m")
def diameter_of(ar: Arithmetic, printed: Sides, radius: Number) -> Number:
    """diameter of a sphere of that radius"""
    return _diameter(ar, printed, radius)


def _diameter(ar: Arithmetic, printed: Sides, radius: Number) -> Number:
    return evaluate(printed["diameter"][1], ar, {"R": radius})


# The geometry of the crater, Eqs. 2-4 and 12


@_computes("1", length_ratio="1")
def sphere_length_ratio(ar: Arithmetic, printed: Sides, length_ratio: Number) -> Number:
    """L/D of a cylinder with the sphere's diameter and mass, from that of one around the sphere"""
    # (4/3) pi R^3 over pi R^2 2R
    return length_ratio * 2 / 3


@_computes("m^3", "eq3", diameter="m")
def sphere_volume(ar: Arithmetic, printed: Sides, diameter: Number) -> Number:
    """volume of a sphere of that diameter, Eq. 3"""
    return evaluate(printed["eq3"][1], ar, {"R": diameter / 2})


@_computes("1", volume_ratio="1")
def crater_normalized_depth(ar: Arithmetic, printed: Sides, volume_ratio: Number) -> Number:
    """X/R at the given CV/PV, from Eqs. 2 and 3"""
    # CV/PV = y^2 (3 - y) / 4 = (3/4) (y^2 - y^3/3)
    return ar.cap_root(4 * volume_ratio / 3)


@_computes("m", volume_ratio="1", diameter="m")
def crater_depth(ar: Arithmetic, printed: Sides, volume_ratio: Number, diameter: Number) -> Number:
    """X at the given CV/PV and particle diameter, from Eqs. 2 and 3"""
    return crater_normalized_depth(ar, printed, volume_ratio) * diameter / 2


@_computes("1", volume_ratio="1")
def crater_depth_over_diameter(ar: Arithmetic, printed: Sides, volume_ratio: Number) -> Number:
    """X/D at the given CV/PV, from Eqs. 2 and 3"""
    return crater_normalized_depth(ar, printed, volume_ratio) / 2


@_computes("m", "eq12", normalized_depth="1", diameter="m")
def contact_diameter(
    ar: Arithmetic, printed: Sides, normalized_depth: Number, diameter: Number
) -> Number:
    """diameter of the contact circle at depth x, from Eq. 12"""
    depth = normalized_depth * diameter / 2
    area = evaluate(printed["eq12"][1], ar, {"D": diameter, "x": depth})
    return 2 * ar.power(area / ar.pi, Fraction(1, 2))


# Target resistance, Eqs. 7-11


@_computes("Pa", beta="1", flow_stress="Pa")
def target_resistance(ar: Arithmetic, printed: Sides, beta: Number, flow_stress: Number) -> Number:
    """R_t = beta Y_t, Eq. 7"""
    return beta * flow_stress


@_computes("1")
def force_power(ar: Arithmetic, printed: Sides) -> Fraction:
    """the power of a length that makes a force of a stress, for Eq. 8"""
    return (unit_dimension("N") / unit_dimension("Pa")).powers[1]


@_computes("1", "eq8", "eq9", q="1", power=EXPONENT)
def goodier_beta(ar: Arithmetic, printed: Sides, q: Number, power: Fraction) -> Number:
    """beta from q (2a)^n = pi a^2 beta Y_t, Eqs. 8 and 9"""
    units = {"a": ar.number(1), "R_t": ar.number(1)}
    force = evaluate(printed["eq8"][1], ar, {**units, "q": q, "n": power})
    return force / evaluate(printed["eq9"][1], ar, units)


@_computes("1", "eq11", elastic_modulus="Pa", flow_stress="Pa")
def walker_anderson_alpha(ar: Arithmetic, printed: Sides, **inputs: Number) -> Number:
    """extent of the plastic zone, Eq. 11"""
    return evaluate(printed["eq11"][1], ar, {SYMBOLS[name]: x for name, x in inputs.items()})


@_computes("1", "eq10", "eq11", elastic_modulus="Pa", flow_stress="Pa")
def walker_anderson_beta(ar: Arithmetic, printed: Sides, **inputs: Number) -> Number:
    """beta from Eqs. 10 and 11"""
    alpha = walker_anderson_alpha(ar, printed, **inputs)
    return evaluate(printed["eq10"][1], ar, {"alpha": alpha})


@_computes("1", goodier="1", walker_anderson="1", brinell="1")
def least_beta(ar: Arithmetic, printed: Sides, **betas: Number) -> Number:
    """the least of the three estimates of beta"""
    return reduce(ar.least, betas.values())


@_computes("1", goodier="1", walker_anderson="1", brinell="1")
def greatest_beta(ar: Arithmetic, printed: Sides, **betas: Number) -> Number:
    """the greatest of the three estimates of beta"""
    return reduce(ar.greatest, betas.values())


@_computes("1/s", velocity="m/s", length="m")
def strain_rate(ar: Arithmetic, printed: Sides, velocity: Number, length: Number) -> Number:
    """impact velocity over a typical dimension, section 3"""
    return velocity / length


# The sheet: the appendix and Table A-1


@_computes("kg", "eq3", radius="m", particle_density="kg/m^3")
def particle_mass(
    ar: Arithmetic, printed: Sides, radius: Number, particle_density: Number
) -> Number:
    """mass of the sphere, Eq. 3 times the density"""
    return evaluate(printed["eq3"][1], ar, {"R": radius}) * particle_density


@_computes("s", step="s")
def row_time(ar: Arithmetic, printed: Sides, row: int, step: Number) -> Number:
    """time that closes the row, k dt"""
    return row * step


def _computes_cell(column: str, unit: str, means: str) -> None:
    """Register the computation of one column of the sheet, in a given row."""

    def cell(
        ar: Arithmetic, printed: Sides, row: int, centered: bool = False, **inputs: Number
    ) -> Number:
        rows = sheet_rows(ar, centered=centered, **inputs)
        return getattr(next(islice(rows, row - 1, None)), column)

    cell.__name__, cell.__doc__ = f"row_{column}", means
    _computes(unit, **SHEET)(cell)


_computes_cell("velocity_initial", "m/s", "velocity at the start of the row's time step")
_computes_cell("depth", "m", "depth in the row, half a step behind its final velocity")
_computes_cell("deceleration", "m/s^2", "deceleration in the row, Eqs. A-1 to A-3 over the mass")
_computes_cell("velocity_final", "m/s", "velocity at the end of the row's time step")


@_computes("m/s^2", "eqA-3", **IMPACT, depth="m")
def deceleration_at_start(
    ar: Arithmetic, printed: Sides, radius: Number, depth: Number, **inputs: Number
) -> Number:
    """deceleration at the depth of the start, where the contact area vanishes"""
    stress = inputs["target_density"] * inputs["velocity"] ** 2 / 2 + inputs["resistance"]
    area = evaluate(printed["eqA-3"][1], ar, {"D": 2 * radius, "x": depth})
    return stress * area / particle_mass(ar, printed, radius, inputs["particle_density"])


@_computes("m", stop_velocity="m/s", **SHEET)
def final_sheet_depth(
    ar: Arithmetic, printed: Sides, centered: bool = False, **inputs: Number
) -> Number:
    """depth in the sheet's last row"""
    return sheet_depth(ar, sheet_rows(ar, centered=centered, **inputs), inputs["stop_velocity"])


# Frank and Zook, Eqs. 14-17


@_computes("1", "eq16", **FRANK_ZOOK)
def frank_zook_as_printed(ar: Arithmetic, printed: Sides, **inputs: Number) -> Number:
    """the right side of Eq. 16, taken as X/R as it is printed"""
    values = {SYMBOLS[name]: x for name, x in inputs.items()}
    diameter = {"D": ar.number(1), "R": ar.number(Fraction(1, 2))}
    return evaluate(printed["eq16"][1], ar, {**values, **diameter})


@_computes("1", **FRANK_ZOOK)
def frank_zook_derived(
    ar: Arithmetic, printed: Sides, velocity: Number, resistance: Number, **inputs: Number
) -> Number:
    """X/R that follows from Eqs. 14 and 15"""
    length_ratio, k_1, k_t = inputs["length_ratio"], inputs["k_1"], inputs["k_t"]
    particle_density, target_density = inputs["particle_density"], inputs["target_density"]
    # (L rho_p + k_1 rho_t D) v dv/dx = -(k_t rho_t v^2 + R_t), integrated from V to rest, over R
    inertia = length_ratio * particle_density / target_density + k_1
    return inertia / k_t * ar.log(1 + k_t * target_density * velocity**2 / resistance)
