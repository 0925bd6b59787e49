"""What the ledger may ask for by name: each computation with the units of its inputs and result.

A claim of the ledger names one of these as what computes it. The functions take the report's
equations as printed (`Formulas`) and inputs in SI units; where the report prints the formula, it is
the printed one that is evaluated, its constants included. A result that is exact in rational
numbers is a Fraction.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import islice

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
class Formulas:
    """The report's equations as printed, in an arithmetic."""

    ar: Arithmetic
    sides: Sides

    def right(self, equation: str, **values: Number) -> Number:
        """The last side of an equation, for values of its symbols."""
        return evaluate(self.sides[equation][-1], self.ar, values)


_TAKEN = {
    "m": "radius diameter length depth",
    "m/s": "velocity stop_velocity",
    "s": "step",
    "kg/m^3": "particle_density target_density",
    "Pa": "resistance flow_stress elastic_modulus",
    "1": "length_ratio volume_ratio normalized_depth k_1 k_t q beta goodier walker_anderson"
    " brinell",
    SAME: "value numerator denominator each",
    EXPONENT: "power",
}
_UNITS = {name: unit for unit, names in _TAKEN.items() for name in names.split()}
"""The unit of an input, the same wherever one of this name is taken."""


@dataclass(frozen=True, slots=True)
class Computation:
    """A function of the reference, and the units by which its inputs and result are checked.

    `summary` says what it computes. `takes` names its inputs, with a space between; "each" stands
    for any number of inputs with any names. `equations` are the printed ones that it evaluates.
    What `restates` only repeats or counts what the report prints elsewhere. `by_row`: it takes the
    number of a row of the sheet (1 is the first time step); `by_scheme`: it runs the sheet, in
    either of the two schemes that fit the report's words.
    """

    name: str
    summary: str
    unit: str
    takes: str
    function: Callable[..., Number | Fraction]
    equations: tuple[str, ...] = ()
    restates: bool = False
    by_row: bool = False
    by_scheme: bool = False

    @property
    def inputs(self) -> Mapping[str, str]:
        """Each input with its unit."""
        return {name: _UNITS[name] for name in self.takes.split()}


SYMBOLS = {
    "length_ratio": "L", "particle_density": "rho_p", "target_density": "rho_t", "k_1": "k_1",
    "k_t": "k_t", "resistance": "R_t", "velocity": "V", "elastic_modulus": "E_t",
    "flow_stress": "Y_t",
}  # fmt: skip
"""The symbol of an equation that an input stands for."""

_IMPACT = "velocity radius particle_density target_density resistance"
_SHEET = f"{_IMPACT} step"
_FRANK_ZOOK = "length_ratio particle_density target_density resistance velocity k_1 k_t"
_STEEL = "elastic_modulus flow_stress"
_BETAS = "goodier walker_anderson brinell"


def _symbols(inputs: Mapping[str, Number]) -> dict[str, Number]:
    return {SYMBOLS[name]: value for name, value in inputs.items()}


def _crater(of: Formulas, volume_ratio: Number) -> Number:
    # CV/PV = y^2 (3 - y) / 4 = (3/4) (y^2 - y^3/3)
    return of.ar.cap_root(4 * volume_ratio / 3)


def _contact_diameter(of: Formulas, normalized_depth: Number, diameter: Number) -> Number:
    area = of.right("eq12", D=diameter, x=normalized_depth * diameter / 2)
    return 2 * of.ar.power(area / of.ar.pi, Fraction(1, 2))


def _goodier_beta(of: Formulas, q: Number, power: Fraction) -> Number:
    unity = of.ar.number(1)
    return of.right("eq8", a=unity, q=q, n=power) / of.right("eq9", a=unity, R_t=unity)


def _walker_anderson_alpha(of: Formulas, **steel: Number) -> Number:
    return of.right("eq11", **_symbols(steel))


def _particle_mass(of: Formulas, radius: Number, particle_density: Number) -> Number:
    return of.right("eq3", R=radius) * particle_density


def _deceleration_at_start(
    of: Formulas, velocity: Number, radius: Number, depth: Number, **inputs: Number
) -> Number:
    density, resistance = inputs["target_density"], inputs["resistance"]
    force = of.right("eq6", rho_t=density, v=velocity, R_t=resistance) * of.right(
        "eqA-3", D=2 * radius, x=depth
    )
    return force / _particle_mass(of, radius, inputs["particle_density"])


def _final_sheet_depth(of: Formulas, centered: bool = False, **inputs: Number) -> Number:
    rows = sheet_rows(of.ar, centered=centered, **inputs)
    return sheet_depth(of.ar, rows, inputs["stop_velocity"])


def _cell(column: str, unit: str, summary: str) -> Computation:
    """One column of the sheet, in a given row."""

    def cell(of: Formulas, row: int, centered: bool = False, **inputs: Number) -> Number:
        rows = sheet_rows(of.ar, centered=centered, **inputs)
        return getattr(next(islice(rows, row - 1, None)), column)

    return Computation(f"row_{column}", summary, unit, _SHEET, cell, by_row=True, by_scheme=True)


def _frank_zook_as_printed(of: Formulas, **inputs: Number) -> Number:
    # L is given in diameters
    unit = {"D": of.ar.number(1), "R": of.ar.number(Fraction(1, 2))}
    return of.right("eq16", **_symbols(inputs), **unit)


def _frank_zook_derived(
    of: Formulas, velocity: Number, resistance: Number, k_1: Number, k_t: Number, **inputs: Number
) -> Number:
    particle_density, target_density = inputs["particle_density"], inputs["target_density"]
    # (L rho_p + k_1 rho_t D) v dv/dx = -(k_t rho_t v^2 + R_t), integrated from V to rest, over R
    inertia = inputs["length_ratio"] * particle_density / target_density + k_1
    return inertia / k_t * of.ar.log(1 + k_t * target_density * velocity**2 / resistance)


_ALL = [
    # Restatements and plain arithmetic
    Computation("same_as", "the same quantity where the report prints it elsewhere",
                SAME, "value", lambda of, value: value, restates=True),
    Computation("count", "how many numbers the report lists",
                "1", "each", lambda of, **values: Fraction(len(values)), restates=True),
    Computation("half", "half of the printed number", SAME, "value", lambda of, value: value / 2),
    Computation("ratio", "ratio of two printed numbers", "1", "numerator denominator",
                lambda of, numerator, denominator: numerator / denominator),
    Computation("excess",
                "by how many times the second of two printed numbers the first exceeds it",
                "1", "numerator denominator",
                lambda of, numerator, denominator: numerator / denominator - 1),
    Computation("radius_of", "radius of a sphere of that diameter", "m", "diameter",
                lambda of, diameter: diameter / of.right("diameter", R=of.ar.number(1)),
                ("diameter",)),
    Computation("diameter_of", "diameter of a sphere of that radius", "m", "radius",
                lambda of, radius: of.right("diameter", R=radius), ("diameter",)),
    # The geometry of the crater, Eqs. 2-4 and 12
    Computation("sphere_length_ratio",  # (4/3) pi R^3 over pi R^2 2R
                "L/D of a cylinder with the sphere's diameter and mass, from that of one around the"
                " sphere",
                "1", "length_ratio", lambda of, length_ratio: length_ratio * 2 / 3),
    Computation("sphere_volume", "volume of a sphere of that diameter, Eq. 3", "m^3", "diameter",
                lambda of, diameter: of.right("eq3", R=diameter / 2), ("eq3",)),
    Computation("crater_normalized_depth", "X/R at the given CV/PV, from Eqs. 2 and 3",
                "1", "volume_ratio", _crater),
    Computation("crater_depth", "X at the given CV/PV and particle diameter, from Eqs. 2 and 3",
                "m", "volume_ratio diameter",
                lambda of, volume_ratio, diameter: _crater(of, volume_ratio) * diameter / 2),
    Computation("crater_depth_over_diameter", "X/D at the given CV/PV, from Eqs. 2 and 3",
                "1", "volume_ratio", lambda of, volume_ratio: _crater(of, volume_ratio) / 2),
    Computation("contact_diameter", "diameter of the contact circle at depth x, from Eq. 12",
                "m", "normalized_depth diameter", _contact_diameter, ("eq12",)),
    # Target resistance, Eqs. 7-11
    Computation("target_resistance", "R_t = beta Y_t, Eq. 7", "Pa", "beta flow_stress",
                lambda of, beta, flow_stress: of.right("eq7", beta=beta, Y_t=flow_stress),
                ("eq7",)),
    Computation("force_power", "the power of a length that makes a force of a stress, for Eq. 8",
                "1", "", lambda of: (unit_dimension("N") / unit_dimension("Pa")).powers[1]),
    Computation("goodier_beta", "beta from q (2a)^n = pi a^2 beta Y_t, Eqs. 8 and 9",
                "1", "q power", _goodier_beta, ("eq8", "eq9")),
    Computation("walker_anderson_alpha", "extent of the plastic zone, Eq. 11",
                "1", _STEEL, _walker_anderson_alpha, ("eq11",)),
    Computation("walker_anderson_beta", "beta from Eqs. 10 and 11", "1", _STEEL,
                lambda of, **steel: of.right("eq10", alpha=_walker_anderson_alpha(of, **steel)),
                ("eq10", "eq11")),
    Computation("least_beta", "the least of the three estimates of beta",
                "1", _BETAS, lambda of, **betas: reduce(of.ar.least, betas.values())),
    Computation("greatest_beta", "the greatest of the three estimates of beta",
                "1", _BETAS, lambda of, **betas: reduce(of.ar.greatest, betas.values())),
    Computation("strain_rate", "impact velocity over a typical dimension, section 3",
                "1/s", "velocity length", lambda of, velocity, length: velocity / length),
    # The sheet: the appendix and Table A-1
    Computation("particle_mass", "mass of the sphere, Eq. 3 times the density",
                "kg", "radius particle_density", _particle_mass, ("eq3",)),
    Computation("row_time", "time that closes the row, k dt",
                "s", "step", lambda of, row, step: row * step, by_row=True),
    _cell("velocity_initial", "m/s", "velocity at the start of the row's time step"),
    _cell("depth", "m", "depth in the row, half a step behind its final velocity"),
    _cell("deceleration", "m/s^2", "deceleration in the row, Eqs. A-1 to A-3 over the mass"),
    _cell("velocity_final", "m/s", "velocity at the end of the row's time step"),
    Computation("deceleration_at_start",
                "deceleration at the depth of the start, where the contact area vanishes",
                "m/s^2", f"{_IMPACT} depth", _deceleration_at_start, ("eqA-3",)),
    Computation("final_sheet_depth", "depth in the sheet's last row",
                "m", f"{_SHEET} stop_velocity", _final_sheet_depth, by_scheme=True),
    # Frank and Zook, Eqs. 14-17
    Computation("frank_zook_as_printed", "the right side of Eq. 16, taken as X/R as it is printed",
                "1", _FRANK_ZOOK, _frank_zook_as_printed, ("eq16",)),
    Computation("frank_zook_derived", "X/R that follows from Eqs. 14 and 15",
                "1", _FRANK_ZOOK, _frank_zook_derived),
]  # fmt: skip
COMPUTATIONS = {computation.name: computation for computation in _ALL}
