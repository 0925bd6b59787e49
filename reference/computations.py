"""What the ledger may ask for by name: each computation, in any arithmetic.

A claim of the ledger names one of these as what computes it. The functions take the report's
equations as printed (`Formulas`) and inputs in SI units; where the report prints the formula, it is
the printed one that is evaluated, its constants included. Exponents, and results that are exact in
rational numbers, are Fractions.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import islice

from reference.arithmetic import Arithmetic, Number
from reference.equations import Sides, evaluate
from reference.motion import sheet_depth, sheet_rows
from reference.units import unit_dimension


@dataclass(frozen=True, slots=True)
class Formulas:
    """The report's equations as printed, in an arithmetic."""

    ar: Arithmetic
    sides: Sides

    def right(self, equation: str, **values: Number) -> Number:
        """The last side of an equation, for values of its symbols."""
        return evaluate(self.sides[equation][-1], self.ar, values)


@dataclass(frozen=True, slots=True)
class Computation:
    """A function of the reference, of `Formulas` and of inputs by name, and what it computes.

    `equations` are the printed ones that it evaluates. What `restates` only repeats or counts what
    the report prints elsewhere. `by_row`: it takes the number of a row of the sheet (1 is the first
    time step); `by_scheme`: it runs the sheet, in either of the two schemes that fit the report's
    words.
    """

    name: str
    summary: str
    function: Callable[..., Number | Fraction]
    equations: tuple[str, ...] = ()
    restates: bool = False
    by_row: bool = False
    by_scheme: bool = False


SYMBOLS = {
    "length_ratio": "L", "particle_density": "rho_p", "target_density": "rho_t", "k_1": "k_1",
    "k_t": "k_t", "resistance": "R_t", "velocity": "V", "elastic_modulus": "E_t",
    "flow_stress": "Y_t",
}  # fmt: skip
"""The symbol of an equation that an input stands for."""

EXPONENTS = ("power",)
"""Inputs that an equation has as exponents, given as Fractions."""


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


def _cell(column: str, summary: str) -> Computation:
    """One column of the sheet, in a given row."""

    def cell(of: Formulas, row: int, centered: bool = False, **inputs: Number) -> Number:
        rows = sheet_rows(of.ar, centered=centered, **inputs)
        return getattr(next(islice(rows, row - 1, None)), column)

    return Computation(f"row_{column}", summary, cell, by_row=True, by_scheme=True)


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
                lambda of, value: value, restates=True),
    Computation("count", "how many numbers the report lists",
                lambda of, **values: Fraction(len(values)), restates=True),
    Computation("half", "half of the printed number", lambda of, value: value / 2),
    Computation("ratio", "ratio of two printed numbers",
                lambda of, numerator, denominator: numerator / denominator),
    Computation("excess",
                "by how many times the second of two printed numbers the first exceeds it",
                lambda of, numerator, denominator: numerator / denominator - 1),
    Computation("radius_of", "radius of a sphere of that diameter",
                lambda of, diameter: diameter / of.right("diameter", R=of.ar.number(1)),
                ("diameter",)),
    Computation("diameter_of", "diameter of a sphere of that radius",
                lambda of, radius: of.right("diameter", R=radius), ("diameter",)),
    # The geometry of the crater, Eqs. 2-4 and 12
    Computation("sphere_length_ratio",  # (4/3) pi R^3 over pi R^2 2R
                "L/D of a cylinder with the sphere's diameter and mass, from that of one around the"
                " sphere",
                lambda of, length_ratio: length_ratio * 2 / 3),
    Computation("sphere_volume", "volume of a sphere of that diameter, Eq. 3",
                lambda of, diameter: of.right("eq3", R=diameter / 2), ("eq3",)),
    Computation("crater_normalized_depth", "X/R at the given CV/PV, from Eqs. 2 and 3", _crater),
    Computation("crater_depth", "X at the given CV/PV and particle diameter, from Eqs. 2 and 3",
                lambda of, volume_ratio, diameter: _crater(of, volume_ratio) * diameter / 2),
    Computation("crater_depth_over_diameter", "X/D at the given CV/PV, from Eqs. 2 and 3",
                lambda of, volume_ratio: _crater(of, volume_ratio) / 2),
    Computation("contact_diameter", "diameter of the contact circle at depth x, from Eq. 12",
                _contact_diameter, ("eq12",)),
    # Target resistance, Eqs. 7-11
    Computation("target_resistance", "R_t = beta Y_t, Eq. 7",
                lambda of, beta, flow_stress: of.right("eq7", beta=beta, Y_t=flow_stress),
                ("eq7",)),
    Computation("force_power", "the power of a length that makes a force of a stress, for Eq. 8",
                lambda of: (unit_dimension("N") / unit_dimension("Pa")).powers[1]),
    Computation("goodier_beta", "beta from q (2a)^n = pi a^2 beta Y_t, Eqs. 8 and 9",
                _goodier_beta, ("eq8", "eq9")),
    Computation("walker_anderson_alpha", "extent of the plastic zone, Eq. 11",
                _walker_anderson_alpha, ("eq11",)),
    Computation("walker_anderson_beta", "beta from Eqs. 10 and 11",
                lambda of, **steel: of.right("eq10", alpha=_walker_anderson_alpha(of, **steel)),
                ("eq10", "eq11")),
    Computation("least_beta", "the least of the three estimates of beta",
                lambda of, **betas: reduce(of.ar.least, betas.values())),
    Computation("greatest_beta", "the greatest of the three estimates of beta",
                lambda of, **betas: reduce(of.ar.greatest, betas.values())),
    Computation("strain_rate", "impact velocity over a typical dimension, section 3",
                lambda of, velocity, length: velocity / length),
    # The sheet: the appendix and Table A-1
    Computation("particle_mass", "mass of the sphere, Eq. 3 times the density",
                _particle_mass, ("eq3",)),
    Computation("row_time", "time that closes the row, k dt",
                lambda of, row, step: row * step, by_row=True),
    _cell("velocity_initial", "velocity at the start of the row's time step"),
    _cell("depth", "depth in the row, half a step behind its final velocity"),
    _cell("deceleration", "deceleration in the row, Eqs. A-1 to A-3 over the mass"),
    _cell("velocity_final", "velocity at the end of the row's time step"),
    Computation("deceleration_at_start",
                "deceleration at the depth of the start, where the contact area vanishes",
                _deceleration_at_start, ("eqA-3",)),
    Computation("final_sheet_depth", "depth in the sheet's last row",
                _final_sheet_depth, by_scheme=True),
    # Frank and Zook, Eqs. 14-17
    Computation("frank_zook_as_printed", "the right side of Eq. 16, taken as X/R as it is printed",
                _frank_zook_as_printed, ("eq16",)),
    Computation("frank_zook_derived", "X/R that follows from Eqs. 14 and 15", _frank_zook_derived),
]  # fmt: skip
COMPUTATIONS = {computation.name: computation for computation in _ALL}
