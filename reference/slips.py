"""Slips: what the author may have computed in place of Eq. 16, each as a function in its own right.

The audit tries them on a number that Eq. 16 does not give, and asserts none of them. Those that
say nothing else take the factor 2 that Eqs. 14 and 15 give and that Eq. 16 as printed lacks.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from reference.arithmetic import Arithmetic, Number
from reference.computations import COMPUTATIONS, Computation


@dataclass(frozen=True)
class Slip:
    """A slip: computing a claim that uses `equation` by something else, or with other inputs.

    `inputs` maps inputs of the computation to the claims that replace their own.
    """

    name: str
    reason: str
    computation: Computation
    inputs: Mapping[str, str] = field(default_factory=dict)
    equation: str = "eq16"

    def __reduce__(self) -> tuple[Callable[[str], "Slip"], tuple[str]]:
        """Pickle by name, as functions are."""
        return named, (self.name,)


class Case(NamedTuple):
    """The inputs of Eq. 16, by its symbols; `L_D` is L/D."""

    L_D: Number
    rho_p: Number
    rho_t: Number
    k_1: Number
    k_t: Number
    V: Number
    R_t: Number

    def inertia(self) -> Number:
        """What Eq. 16 divides by k_t [1]."""
        return self.L_D * self.rho_p / self.rho_t + self.k_1

    def log(self, ar: Arithmetic, factor: Number) -> Number:
        """ln(1 + factor rho_t V^2/R_t) [1]: in Eq. 16 the factor is k_t, in Eq. 5 it is 1/2."""
        return ar.log(1 + factor * self.rho_t * self.V**2 / self.R_t)


def of_inputs(function: Callable[[Arithmetic, Case], Number]) -> Computation:
    """Return a function of a case as a computation, with the names of inputs in the ledger."""

    def of_names(
        ar: Arithmetic,
        length_ratio: Number,
        particle_density: Number,
        target_density: Number,
        k_1: Number,
        k_t: Number,
        velocity: Number,
        resistance: Number,
    ) -> Number:
        densities = particle_density, target_density
        return function(ar, Case(length_ratio, *densities, k_1, k_t, velocity, resistance))

    return Computation(of_names)


def radius_for_diameter(ar: Arithmetic, c: Case) -> Number:
    return (2 * c.L_D * c.rho_p / c.rho_t + c.k_1) / (2 * c.k_t) * c.log(ar, c.k_t)


def density_ratio_inverted(ar: Arithmetic, c: Case) -> Number:
    return (c.L_D * c.rho_t / c.rho_p + c.k_1) / c.k_t * c.log(ar, c.k_t)


def k_1_left_out(ar: Arithmetic, c: Case) -> Number:
    return c.L_D * c.rho_p / c.rho_t / c.k_t * c.log(ar, c.k_t)


def density_ratio_on_k_1(ar: Arithmetic, c: Case) -> Number:
    return (c.L_D + c.k_1) * c.rho_p / (c.rho_t * c.k_t) * c.log(ar, c.k_t)


def k_1_and_k_t_exchanged(ar: Arithmetic, c: Case) -> Number:
    return (c.L_D * c.rho_p / c.rho_t + c.k_t) / c.k_1 * c.log(ar, c.k_1)


def half_in_the_logarithm(ar: Arithmetic, c: Case) -> Number:
    return c.inertia() / c.k_t * ar.log(1 + c.rho_t * c.V**2 / (2 * c.R_t))


def half_in_both_places(ar: Arithmetic, c: Case) -> Number:
    return 2 * c.inertia() * ar.log(1 + c.rho_t * c.V**2 / (2 * c.R_t))


def no_k_t_in_the_logarithm(ar: Arithmetic, c: Case) -> Number:
    return c.inertia() / c.k_t * c.log(ar, 1)


def no_k_t_in_the_denominator(ar: Arithmetic, c: Case) -> Number:
    return c.inertia() * c.log(ar, c.k_t)


def rho_p_in_the_logarithm(ar: Arithmetic, c: Case) -> Number:
    return c.inertia() / c.k_t * ar.log(1 + c.k_t * c.rho_p * c.V**2 / c.R_t)


def logarithm_to_base_10(ar: Arithmetic, c: Case) -> Number:
    return c.inertia() / c.k_t * c.log(ar, c.k_t) / ar.log(ar.number(10))


def no_logarithm(ar: Arithmetic, c: Case) -> Number:
    return c.inertia() / c.k_t * (c.k_t * c.rho_t * c.V**2 / c.R_t)


def twice_the_depth(ar: Arithmetic, c: Case) -> Number:
    return 2 * c.inertia() / c.k_t * c.log(ar, c.k_t)


_DERIVED = COMPUTATIONS["frank_zook_derived"]
_AS_PRINTED = COMPUTATIONS["frank_zook_as_printed"]

SLIPS = (
    Slip(
        "L/D = 1",
        "the cylinder around the sphere, which the report mentions first",
        _DERIVED,
        {"length_ratio": "circumscribed-length-ratio"},
    ),
    Slip(
        "L/R in Eq. 16 as printed",
        "radius for diameter, and no factor 2",
        of_inputs(radius_for_diameter),
    ),
    Slip(
        "density ratio inverted",
        "rho_t/rho_p for rho_p/rho_t",
        of_inputs(density_ratio_inverted),
    ),
    Slip("k_1 left out", "a term left out; Eq. 13 has none", of_inputs(k_1_left_out)),
    Slip(
        "density ratio on k_1, too",
        "a bracket in the wrong place",
        of_inputs(density_ratio_on_k_1),
    ),
    Slip(
        "k_1 and k_t exchanged",
        "the fitting parameters in each other's place",
        of_inputs(k_1_and_k_t_exchanged),
    ),
    Slip(
        "1/2 for k_t in the logarithm",
        "Eq. 5 has 1/2 where Eq. 14 has k_t",
        of_inputs(half_in_the_logarithm),
    ),
    Slip(
        "1/2 for k_t in both places",
        "Eq. 5 has 1/2 where Eq. 14 has k_t",
        of_inputs(half_in_both_places),
    ),
    Slip("no k_t in the logarithm", "a factor left out", of_inputs(no_k_t_in_the_logarithm)),
    Slip("no k_t in the denominator", "a factor left out", of_inputs(no_k_t_in_the_denominator)),
    Slip("rho_p in the logarithm", "one density for the other", of_inputs(rho_p_in_the_logarithm)),
    Slip(
        "logarithm to base 10",
        "LOG for LN in a spreadsheet",
        of_inputs(logarithm_to_base_10),
    ),
    Slip(
        "no logarithm",
        "its argument less one: the first term of the series",
        of_inputs(no_logarithm),
    ),
    Slip(
        "521 m/s",
        "the average velocity of Figure 1, from which 0.298 comes",
        _DERIVED,
        {"velocity": "velocity-521"},
    ),
    Slip(
        "606 m/s",
        "the average velocity of the second data set",
        _DERIVED,
        {"velocity": "velocity-606"},
    ),
    Slip(
        "606 m/s in Eq. 16 as printed",
        "the average velocity of the second data set, and no factor 2",
        _AS_PRINTED,
        {"velocity": "velocity-606"},
    ),
    Slip(
        "twice the depth in radii",
        "radius for diameter once too often",
        of_inputs(twice_the_depth),
    ),
)
"""The slips, in the order in which the audit lists them."""


def named(name: str) -> Slip:
    """Return the slip of this name."""
    return {slip.name: slip for slip in SLIPS}[name]
