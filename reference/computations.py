"""The computations: how the numbers that the report prints follow from others, in any arithmetic.

One function computes one quantity. It takes the arithmetic `ar`, the inputs in SI units, by the
names that a claim's `rests_on` in the ledger gives them, and whichever of these it names:

    eq      the printed equations, of which `equations` lists those that it evaluates: where the
            report prints a formula, the printed one is evaluated, with its printed constants, so
            that a misprint planted in it acts on all that is computed from it
    row     the number of the row in Table A-1
    scheme  the scheme of the sheet
    power   an exponent, which stays exact: a Fraction in every arithmetic

It returns a number of the arithmetic, or a Fraction if the value is known exactly. Its docstring is
a phrase that the audit puts into sentences.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, reduce
from inspect import signature
from itertools import islice

from reference.arithmetic import Arithmetic, Function, Number
from reference.equations import Equations
from reference.motion import Row, sheet_depth, sheet_rows
from reference.scheme import Scheme
from reference.units import unit_dimension


@dataclass(frozen=True)
class Computation:
    """A computation: its function, and what else the ledger and the audit ask of it.

    `equations` are the ids of the printed equations that it evaluates. `restates` says that it only
    repeats or counts what the report prints elsewhere. With `by_definition` it scales,
    multiplies or selects printed numbers: its result can only fail if one of these is misprinted.
    """

    function: Function
    equations: tuple[str, ...] = ()
    restates: bool = False
    by_definition: bool = False

    @property
    def name(self) -> str:
        """The name by which the ledger's claims refer to it."""
        return self.function.__name__

    @property
    def summary(self) -> str:
        """What it computes, as a phrase."""
        return self.function.__doc__ or ""

    @cached_property
    def settings(self) -> frozenset[str]:
        """Which of `eq`, `row` and `scheme` it takes.

        A `power` is an input like others; `Ledger.function` alone keeps it exact.
        """
        return frozenset(signature(self.function).parameters) & {"eq", "row", "scheme"}

    @property
    def by_row(self) -> bool:
        """Whether it takes a row of the sheet."""
        return "row" in self.settings

    @property
    def by_scheme(self) -> bool:
        """Whether it runs the sheet, in either of its schemes."""
        return "scheme" in self.settings


COMPUTATIONS: dict[str, Computation] = {}
"""Every computation, by the name of its function."""


def computation(
    *equations: str, restates: bool = False, by_definition: bool = False
) -> Callable[[Function], Function]:
    """Enter a function into COMPUTATIONS, with the ids of the equations that it evaluates."""

    def enter(function: Function) -> Function:
        name = function.__name__
        COMPUTATIONS[name] = Computation(function, equations, restates, by_definition)
        return function

    return enter


# What repeats, counts or compares printed numbers


@computation(restates=True)
def same_as(ar: Arithmetic, value: Number) -> Number:
    """the same quantity where the report prints it elsewhere"""
    return value


@computation(restates=True)
def count(ar: Arithmetic, **values: Number) -> Fraction:
    """how many numbers the report lists"""
    return Fraction(len(values))


@computation(by_definition=True)
def half(ar: Arithmetic, value: Number) -> Number:
    """half of the printed number"""
    return value / 2


@computation()
def ratio(ar: Arithmetic, numerator: Number, denominator: Number) -> Number:
    """ratio of two printed numbers"""
    return numerator / denominator


@computation()
def excess(ar: Arithmetic, numerator: Number, denominator: Number) -> Number:
    """by how many times the second of two printed numbers the first exceeds it"""
    return numerator / denominator - 1


@computation()
def strain_rate(ar: Arithmetic, velocity: Number, length: Number) -> Number:
    """impact velocity over a typical dimension, section 3"""
    return velocity / length


# The sphere


@computation("diameter", by_definition=True)
def radius_of(ar: Arithmetic, eq: Equations, diameter: Number) -> Number:
    """radius of a sphere of that diameter"""
    return diameter / eq["diameter"](ar, R=1)


@computation("diameter", by_definition=True)
def diameter_of(ar: Arithmetic, eq: Equations, radius: Number) -> Number:
    """diameter of a sphere of that radius"""
    return eq["diameter"](ar, R=radius)


@computation(by_definition=True)
def sphere_length_ratio(ar: Arithmetic, length_ratio: Number) -> Number:
    """L/D of a cylinder with the sphere's diameter and mass, from that of one around the sphere"""
    return length_ratio * 2 / 3  # (4/3) pi R^3 over pi R^2 2R


@computation("eq3")
def sphere_volume(ar: Arithmetic, eq: Equations, diameter: Number) -> Number:
    """volume of a sphere of that diameter, Eq. 3"""
    return eq["eq3"](ar, R=diameter / 2)


@computation("eq3")
def particle_mass(
    ar: Arithmetic, eq: Equations, radius: Number, particle_density: Number
) -> Number:
    """mass of the sphere, Eq. 3 times the density"""
    return eq["eq3"](ar, R=radius) * particle_density


# The crater


@computation()
def crater_normalized_depth(ar: Arithmetic, volume_ratio: Number) -> Number:
    """X/R at the given CV/PV, from Eqs. 2 and 3"""
    return ar.cap_root(4 * volume_ratio / 3)  # CV/PV = y^2 (3 - y)/4 = (3/4) (y^2 - y^3/3), y = X/R


@computation()
def crater_depth_by_diameter(ar: Arithmetic, volume_ratio: Number, diameter: Number) -> Number:
    """X at the given CV/PV and particle diameter, from Eqs. 2 and 3"""
    return crater_normalized_depth(ar, volume_ratio) * diameter / 2


@computation(by_definition=True)
def crater_depth_over_diameter(ar: Arithmetic, volume_ratio: Number) -> Number:
    """X/D at the given CV/PV, from Eqs. 2 and 3"""
    return crater_normalized_depth(ar, volume_ratio) / 2


@computation("eq12")
def contact_diameter(
    ar: Arithmetic, eq: Equations, normalized_depth: Number, diameter: Number
) -> Number:
    """diameter of the contact circle at depth x, from Eq. 12"""
    area = eq["eq12"](ar, D=diameter, x=normalized_depth * diameter / 2)
    return 2 * ar.power(area / ar.pi, Fraction(1, 2))


# The resistance of the target


@computation("eq7", by_definition=True)
def target_resistance(ar: Arithmetic, eq: Equations, beta: Number, flow_stress: Number) -> Number:
    """R_t = beta Y_t, Eq. 7"""
    return eq["eq7"](ar, beta=beta, Y_t=flow_stress)


@computation(by_definition=True)
def force_power(ar: Arithmetic) -> Fraction:
    """the power of a length that makes a force of a stress, for Eq. 8"""
    return (unit_dimension("N") / unit_dimension("Pa")).powers[1]


@computation("eq8", "eq9")
def goodier_beta(ar: Arithmetic, eq: Equations, q: Number, power: Fraction) -> Number:
    """beta from q (2a)^n = pi a^2 beta Y_t, Eqs. 8 and 9"""
    return eq["eq8"](ar, a=1, q=q, n=power) / eq["eq9"](ar, a=1, R_t=1)


@computation("eq11")
def walker_anderson_alpha(
    ar: Arithmetic, eq: Equations, elastic_modulus: Number, flow_stress: Number
) -> Number:
    """extent of the plastic zone, Eq. 11"""
    return eq["eq11"](ar, E_t=elastic_modulus, Y_t=flow_stress)


@computation("eq10", "eq11")
def walker_anderson_beta_of_target(
    ar: Arithmetic, eq: Equations, elastic_modulus: Number, flow_stress: Number
) -> Number:
    """beta from Eqs. 10 and 11"""
    return eq["eq10"](ar, alpha=eq["eq11"](ar, E_t=elastic_modulus, Y_t=flow_stress))


@computation(by_definition=True)
def least_beta(ar: Arithmetic, **betas: Number) -> Number:
    """the least of the three estimates of beta"""
    return reduce(ar.least, betas.values())


@computation(by_definition=True)
def greatest_beta(ar: Arithmetic, **betas: Number) -> Number:
    """the greatest of the three estimates of beta"""
    return reduce(ar.greatest, betas.values())


# The sheet: `inputs` are those of `reference.motion.sheet_rows`


@computation(by_definition=True)
def row_time(ar: Arithmetic, row: int, step: Number) -> Number:
    """time that closes the row, k dt"""
    return row * step


@computation(by_definition=True)
def row_velocity_initial(ar: Arithmetic, row: int, scheme: Scheme, **inputs: Number) -> Number:
    """velocity at the start of the row's time step"""  # the final one of the row before
    return _row(ar, row, scheme, **inputs).velocity_initial


@computation()
def row_depth(ar: Arithmetic, row: int, scheme: Scheme, **inputs: Number) -> Number:
    """depth in the row, half a step behind its final velocity"""
    return _row(ar, row, scheme, **inputs).depth


@computation()
def row_deceleration(ar: Arithmetic, row: int, scheme: Scheme, **inputs: Number) -> Number:
    """deceleration in the row, Eqs. A-1 to A-3 over the mass"""
    return _row(ar, row, scheme, **inputs).deceleration


@computation()
def row_velocity_final(ar: Arithmetic, row: int, scheme: Scheme, **inputs: Number) -> Number:
    """velocity at the end of the row's time step"""
    return _row(ar, row, scheme, **inputs).velocity_final


def _row(ar: Arithmetic, row: int, scheme: Scheme, **inputs: Number) -> Row:
    """Return a row of the sheet; the one after the impact is number 1."""
    return next(islice(sheet_rows(ar, scheme=scheme, **inputs), row - 1, None))


@computation("eq6", "eqA-3", "eq3", by_definition=True)
def deceleration_at_start(
    ar: Arithmetic,
    eq: Equations,
    depth: Number,
    velocity: Number,
    radius: Number,
    particle_density: Number,
    target_density: Number,
    resistance: Number,
) -> Number:
    """deceleration at the depth of the start, where the contact area vanishes"""
    stress = eq["eq6"](ar, rho_t=target_density, v=velocity, R_t=resistance)
    area = eq["eqA-3"](ar, D=2 * radius, x=depth)
    return stress * area / particle_mass(ar, eq, radius, particle_density)


@computation()
def final_sheet_depth(
    ar: Arithmetic, scheme: Scheme, stop_velocity: Number, **inputs: Number
) -> Number:
    """depth in the sheet's last row"""
    return sheet_depth(ar, scheme, stop_velocity, **inputs)


# Frank and Zook: L/D, and X/R


@computation("eq16")
def frank_zook_as_printed(
    ar: Arithmetic,
    eq: Equations,
    length_ratio: Number,
    particle_density: Number,
    target_density: Number,
    k_1: Number,
    k_t: Number,
    velocity: Number,
    resistance: Number,
) -> Number:
    """the right side of Eq. 16, taken as X/R as it is printed"""
    return eq["eq16"](
        ar,
        L=length_ratio,  # in diameters
        D=1,
        R=Fraction(1, 2),
        rho_p=particle_density,
        rho_t=target_density,
        k_1=k_1,
        k_t=k_t,
        V=velocity,
        R_t=resistance,
    )


@computation()
def frank_zook_derived(
    ar: Arithmetic,
    length_ratio: Number,
    particle_density: Number,
    target_density: Number,
    k_1: Number,
    k_t: Number,
    velocity: Number,
    resistance: Number,
) -> Number:
    """X/R that follows from Eqs. 14 and 15"""
    # (L rho_p + k_1 rho_t D) v dv/dx = -(k_t rho_t v^2 + R_t), integrated from V to rest, over R
    inertia = (length_ratio * particle_density / target_density + k_1) / k_t
    return inertia * ar.log(1 + k_t * target_density * velocity**2 / resistance)
