"""What the author may have computed in place of Eq. 16: a family of slips, generated and counted.

Eq. 16 prints X/R = ((L/D rho_p/rho_t + k_1)/2kt) ln(1 + k_t rho_t V^2/R_t). Whoever types it into a
cell can slip in each of its parts: the bracket, the divisor, the logarithm, what joins the three,
the two parameters, X/R for X/D, and each number that is put in. Every part has a list of slips
below, each a small function with its name. A member of the family is Eq. 16 with one slip in each
of at most three parts, one of which is "X/R is twice X/D": both printed values need about twice of
what Eq. 16 as printed gives, whatever else was done.

A family of thousands hits any number by accident. How many hits to expect is computed from the
family's own values: each member within a factor of 1.5 of the number would hit it with a chance
that is the width of the rounding interval over the width of that range, on a logarithmic scale;
what the admitted target densities move the member adds to the width. A member that fits is
suggestive, and never a proof.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations
from math import inf, log, sqrt
from typing import Any

from reference.ledger import Claim, Ledger
from replication.audit.inference import DENSITY
from replication.audit.record import FittingSlip, SlipsTried
from replication.audit.verdict import Judge
from replication.text import number, powers_of_ten


@dataclass(frozen=True)
class Eq16Inputs:
    """The inputs of Eq. 16: L/D, k_1 and k_t [1], densities [kg/m^3], V [m/s] and R_t [Pa]."""

    L_D: float
    rho_p: float
    rho_t: float
    k_1: float
    k_t: float
    V: float
    R_t: float


@dataclass(frozen=True)
class Slip:
    """A slip in one part of Eq. 16, in words and as the function that computes the part with it."""

    part: str
    says: str
    function: Callable[..., Any]


def slip(part: str, says: str) -> Callable[[Callable[..., Any]], Slip]:
    """Make a slip of a function that computes a part of Eq. 16."""
    return lambda function: Slip(part, says, function)


# The bracket, as printed: L/D rho_p/rho_t + k_1


def bracket(x: Eq16Inputs) -> float:
    return x.L_D * x.rho_p / x.rho_t + x.k_1


@slip("bracket", "the density ratio upside down")
def density_ratio_inverted(x: Eq16Inputs) -> float:
    return x.L_D * x.rho_t / x.rho_p + x.k_1


@slip("bracket", "the square root of the density ratio, as for long rods")
def density_ratio_rooted(x: Eq16Inputs) -> float:
    return x.L_D * sqrt(x.rho_p / x.rho_t) + x.k_1


@slip("bracket", "no density ratio")
def density_ratio_left_out(x: Eq16Inputs) -> float:
    return x.L_D + x.k_1


@slip("bracket", "the density ratio on k_1 in place of L/D")
def density_ratio_on_k_1(x: Eq16Inputs) -> float:
    return x.L_D + x.k_1 * x.rho_p / x.rho_t


@slip("bracket", "the density ratio on both terms")
def density_ratio_on_both(x: Eq16Inputs) -> float:
    return (x.L_D + x.k_1) * x.rho_p / x.rho_t


@slip("bracket", "no L/D")
def length_left_out(x: Eq16Inputs) -> float:
    return x.rho_p / x.rho_t + x.k_1


@slip("bracket", "L/R for L/D")
def length_over_radius(x: Eq16Inputs) -> float:
    return 2 * x.L_D * x.rho_p / x.rho_t + x.k_1


@slip("bracket", "half of L for L")
def half_length(x: Eq16Inputs) -> float:
    return x.L_D / 2 * x.rho_p / x.rho_t + x.k_1


@slip("bracket", "D/L for L/D")
def length_ratio_inverted(x: Eq16Inputs) -> float:
    return x.rho_p / x.rho_t / x.L_D + x.k_1


@slip("bracket", "no k_1")
def k_1_left_out(x: Eq16Inputs) -> float:
    return x.L_D * x.rho_p / x.rho_t


@slip("bracket", "only k_1")
def inertia_left_out(x: Eq16Inputs) -> float:
    return x.k_1


@slip("bracket", "k_1 subtracted")
def k_1_subtracted(x: Eq16Inputs) -> float:
    return x.L_D * x.rho_p / x.rho_t - x.k_1


@slip("bracket", "k_1 as a factor")
def k_1_multiplied(x: Eq16Inputs) -> float:
    return x.L_D * x.rho_p / x.rho_t * x.k_1


@slip("bracket", "k_1/2 for k_1")
def k_1_halved(x: Eq16Inputs) -> float:
    return x.L_D * x.rho_p / x.rho_t + x.k_1 / 2


@slip("bracket", "2 k_1 for k_1, as D is 2R")
def k_1_doubled(x: Eq16Inputs) -> float:
    return x.L_D * x.rho_p / x.rho_t + 2 * x.k_1


@slip("bracket", "k_t for k_1")
def k_t_for_k_1(x: Eq16Inputs) -> float:
    return x.L_D * x.rho_p / x.rho_t + x.k_t


BRACKETS = (
    density_ratio_inverted,
    density_ratio_rooted,
    density_ratio_left_out,
    density_ratio_on_k_1,
    density_ratio_on_both,
    length_left_out,
    length_over_radius,
    half_length,
    length_ratio_inverted,
    k_1_left_out,
    inertia_left_out,
    k_1_subtracted,
    k_1_multiplied,
    k_1_halved,
    k_1_doubled,
    k_t_for_k_1,
)


# The divisor, as printed: 2 k_t


def divisor(x: Eq16Inputs) -> float:
    return 2 * x.k_t


@slip("divisor", "/2*k_t typed without brackets, which multiplies by k_t")
def multiplied_by_k_t(x: Eq16Inputs) -> float:
    return 2 / x.k_t


@slip("divisor", "no k_t in the divisor")
def k_t_left_out(_: Eq16Inputs) -> float:
    return 2.0


@slip("divisor", "k_1 for k_t in the divisor")
def k_1_for_k_t(x: Eq16Inputs) -> float:
    return 2 * x.k_1


@slip("divisor", "1/2 for k_t in the divisor, as in Eq. 5")
def half_for_k_t(_: Eq16Inputs) -> float:
    return 1.0


@slip("divisor", "k_t squared in the divisor")
def k_t_squared(x: Eq16Inputs) -> float:
    return 2 * x.k_t * x.k_t


DIVISORS = (multiplied_by_k_t, k_t_left_out, k_1_for_k_t, half_for_k_t, k_t_squared)


# The logarithm, as printed: ln(1 + k_t rho_t V^2/R_t)


def logarithm(x: Eq16Inputs) -> float:
    return log(1 + x.k_t * x.rho_t * x.V * x.V / x.R_t)


@slip("logarithm", "the logarithm to base 10: LOG for LN")
def base_10(x: Eq16Inputs) -> float:
    return log(1 + x.k_t * x.rho_t * x.V * x.V / x.R_t) / log(10)


@slip("logarithm", "no logarithm: its argument less 1")
def no_logarithm(x: Eq16Inputs) -> float:
    return x.k_t * x.rho_t * x.V * x.V / x.R_t


@slip("logarithm", "no 1 in the logarithm")
def one_left_out(x: Eq16Inputs) -> float:
    return log(x.k_t * x.rho_t * x.V * x.V / x.R_t)


@slip("logarithm", "1 - for 1 +, with the sign of the whole turned")
def one_minus(x: Eq16Inputs) -> float:
    return -log(1 - x.k_t * x.rho_t * x.V * x.V / x.R_t)


@slip("logarithm", "R_t divides 1, too: (1 + k_t rho_t V^2)/R_t")
def bracket_too_early(x: Eq16Inputs) -> float:
    return log((1 + x.k_t * x.rho_t * x.V * x.V) / x.R_t)


@slip("logarithm", "the drag upside down: R_t/(k_t rho_t V^2)")
def drag_inverted(x: Eq16Inputs) -> float:
    return log(1 + x.R_t / (x.k_t * x.rho_t * x.V * x.V))


@slip("logarithm", "no k_t in the logarithm")
def k_t_left_out_of_drag(x: Eq16Inputs) -> float:
    return log(1 + x.rho_t * x.V * x.V / x.R_t)


@slip("logarithm", "1/2 for k_t in the logarithm, as in Eq. 5")
def half_for_k_t_in_drag(x: Eq16Inputs) -> float:
    return log(1 + x.rho_t * x.V * x.V / (2 * x.R_t))


@slip("logarithm", "k_1 for k_t in the logarithm")
def k_1_in_drag(x: Eq16Inputs) -> float:
    return log(1 + x.k_1 * x.rho_t * x.V * x.V / x.R_t)


@slip("logarithm", "k_t/2 in the logarithm: the 1/2 of Eq. 5 and k_t")
def half_k_t_in_drag(x: Eq16Inputs) -> float:
    return log(1 + x.k_t * x.rho_t * x.V * x.V / (2 * x.R_t))


@slip("logarithm", "2 k_t in the logarithm, as in the divisor")
def twice_k_t_in_drag(x: Eq16Inputs) -> float:
    return log(1 + 2 * x.k_t * x.rho_t * x.V * x.V / x.R_t)


@slip("logarithm", "the particle's density in the logarithm")
def rho_p_in_drag(x: Eq16Inputs) -> float:
    return log(1 + x.k_t * x.rho_p * x.V * x.V / x.R_t)


@slip("logarithm", "V not squared")
def velocity_not_squared(x: Eq16Inputs) -> float:
    return log(1 + x.k_t * x.rho_t * x.V / x.R_t)


LOGARITHMS = (
    base_10,
    no_logarithm,
    one_left_out,
    one_minus,
    bracket_too_early,
    drag_inverted,
    k_t_left_out_of_drag,
    half_for_k_t_in_drag,
    k_1_in_drag,
    half_k_t_in_drag,
    twice_k_t_in_drag,
    rho_p_in_drag,
    velocity_not_squared,
)


# What joins them, as printed: (bracket/divisor) logarithm; and X/R for X/D


def joined(_: Eq16Inputs, first: float, below: float, log_: float) -> float:
    return first / below * log_


@slip("joined", "no brackets around the sum: only k_1 is divided, and multiplied by the logarithm")
def sum_without_brackets(x: Eq16Inputs, first: float, below: float, log_: float) -> float:
    return first - x.k_1 + x.k_1 / below * log_


@slip("joined", "the logarithm in the divisor")
def logarithm_below(_: Eq16Inputs, first: float, below: float, log_: float) -> float:
    return first / (below * log_)


@slip("joined", "no divisor")
def divisor_left_out(_: Eq16Inputs, first: float, __: float, log_: float) -> float:
    return first * log_


JOINS = (sum_without_brackets, logarithm_below, divisor_left_out)


@slip("scale", "X/R is twice X/D")
def doubled(ratio: float) -> float:
    return 2 * ratio


@slip("scale", "X/R is half of X/D")
def halved(ratio: float) -> float:
    return ratio / 2


@slip("scale", "X/R is four times X/D")
def doubled_twice(ratio: float) -> float:
    return 4 * ratio


SCALES = (doubled, halved, doubled_twice)


# The numbers put in


@slip("parameters", "k_1 and k_t exchanged")
def parameters_exchanged(x: Eq16Inputs) -> Eq16Inputs:
    return replace(x, k_1=x.k_t, k_t=x.k_1)


@slip("densities", "the particle's density for both")
def densities_of_particle(x: Eq16Inputs) -> Eq16Inputs:
    return replace(x, rho_t=x.rho_p)


@slip("densities", "the densities exchanged")
def densities_exchanged(x: Eq16Inputs) -> Eq16Inputs:
    return replace(x, rho_t=x.rho_p, rho_p=x.rho_t)


EXCHANGES = (parameters_exchanged, densities_of_particle, densities_exchanged)


VELOCITIES = (
    "velocity-403",
    "velocity-521",
    "velocity-606",
    "velocity-704",
    "stream-velocity-400",
    "stream-velocity-450",
)
RESISTANCES = ("fz-resistance-rha", "fz-resistance-stainless", "a1-resistance")
LENGTH_RATIOS = ("circumscribed-length-ratio",)
"""The claims that print another velocity, resistance or L/D, which may be put in by mistake."""


def numbers_named(ledger: Ledger, x: Eq16Inputs) -> Iterator[Slip]:
    """Yield a slip for each other velocity, resistance and L/D that the report names."""
    named = [("velocity", "V", claim, ledger.value(claim)) for claim in VELOCITIES]
    named += [("resistance", "R_t", claim, ledger.value(claim)) for claim in RESISTANCES]
    beta = "depth-beta-3-beta"
    product = ledger.value(beta) * ledger.value("flow-stress")
    named += [("resistance", "R_t", beta, product)]
    named += [("length", "L_D", claim, ledger.value(claim)) for claim in LENGTH_RATIOS]
    for part, symbol, claim, value in named:
        if float(value) != getattr(x, symbol):
            shown = powers_of_ten(number(value))
            says = f"{symbol.replace('_D', '/D')} = {shown} ({ledger.title(claim)})"
            yield Slip(part, says, partial(_put, symbol, float(value)))


def _put(symbol: str, value: float, x: Eq16Inputs) -> Eq16Inputs:
    return replace(x, **{symbol: value})


# The family

Member = tuple[Slip, ...]
"""A member of the family: Eq. 16 with slips in different parts of it."""


def family(ledger: Ledger, x: Eq16Inputs) -> list[Member]:
    """Return Eq. 16 as printed, with one or two slips, and with two slips and X/R twice X/D."""
    slips = [*BRACKETS, *DIVISORS, *LOGARITHMS, *JOINS, *SCALES, *EXCHANGES]
    slips += numbers_named(ledger, x)
    pairs = [pair for pair in combinations(slips, 2) if pair[0].part != pair[1].part]
    doubled_too = [
        (doubled, *pair) for pair in pairs if all(slip.part != doubled.part for slip in pair)
    ]
    return [(), *((slip,) for slip in slips), *pairs, *doubled_too]


def depth_with_slips(x: Eq16Inputs, member: Member) -> float:
    """Return X/R [1] by Eq. 16 with these slips.

    Raises ValueError or ArithmeticError where a logarithm has no value.
    """
    with_slip = {slip.part: slip.function for slip in member}
    for part in ("velocity", "resistance", "length", "parameters", "densities"):
        if part in with_slip:
            x = with_slip[part](x)
    value: float = with_slip.get("joined", joined)(
        x,
        with_slip.get("bracket", bracket)(x),
        with_slip.get("divisor", divisor)(x),
        with_slip.get("logarithm", logarithm)(x),
    )
    return float(with_slip["scale"](value)) if "scale" in with_slip else value


NEAR = 1.5
"""Members within this factor of a number tell how many would fit it by accident."""


def slips_tried(judge: Judge, claim: Claim) -> tuple[SlipsTried, list[FittingSlip]]:
    """Return which slips give a claim that Eq. 16 should give, and how many would by accident.

    A slip fits if it gives the number, with all other inputs as printed, for some target density
    that Table A-1 admits, with the sphere's or with the printed mass. Members that give the same
    value for every input are counted once.
    """
    x, densities = _inputs(judge, claim), _admitted(judge)
    low, high = (float(end) for end in claim.target().ends)
    middle, seen, fitting = (low + high) / 2, set[str](), list[FittingSlip]()
    near, expected = 0, 0.0
    forms = family(judge.ledger, x)
    for member in forms:
        value = _value(x, member)
        if value is None or (digits := f"{value:.12e}") in seen:
            continue
        seen.add(digits)
        if not middle / NEAR <= value <= middle * NEAR:
            continue
        near += 1
        at_ends = [_value(replace(x, rho_t=density), member) for density in densities]
        values = [value, *(end for end in at_ends if end is not None)]
        width = log(high / low) + log(max(values) / min(values))
        expected += width / (2 * log(NEAR))
        if max(values) >= low and min(values) < high:
            fitting.append(
                FittingSlip(
                    name="; ".join(slip.says for slip in member) or "Eq. 16 as printed",
                    departures=len(member),
                    value=value,
                    fits=_fits([low <= end < high for end in values]),
                )
            )
    fitting.sort(key=lambda record: (record.departures, record.name))
    return SlipsTried(forms=len(forms), members=len(seen), near=near, expected=expected), fitting


def _inputs(judge: Judge, claim: Claim) -> Eq16Inputs:
    """Return the inputs of a Frank-Zook claim as printed, in doubles."""
    values = {name: float(judge.value(*entries)) for name, entries in claim.inputs.items()}
    return Eq16Inputs(
        L_D=values["length_ratio"],
        rho_p=values["particle_density"],
        rho_t=values["target_density"],
        k_1=values["k_1"],
        k_t=values["k_t"],
        V=values["velocity"],
        R_t=values["resistance"],
    )


def _admitted(judge: Judge) -> list[float]:
    """Return the ends of the densities that Table A-1 admits: with its mass, with the sphere's."""
    inference = judge.inference(DENSITY)
    return [float(end) for end in (*inference.with_mass.ends, *inference.inner.ends)]


def _value(x: Eq16Inputs, member: Member) -> float | None:
    """Return X/R of a member; None if it has no value, or none above zero."""
    try:
        value = depth_with_slips(x, member)
    except (ArithmeticError, ValueError):
        return None
    return value if 0 < value < inf else None


EVERY_DENSITY = "for every target density that Table A-1 admits"
"""Said of a slip that gives the number at all of them."""


def _fits(gives: Sequence[bool]) -> str:
    """Say for which densities a member gives the number.

    `gives` has whether it does for the density taken, and for the ends of both admitted ranges.
    """
    if all(gives):
        return EVERY_DENSITY
    if all(gives[1:3]):
        return "for every target density that its header, with the printed mass, admits"
    if all(gives[3:]):
        return "for every target density that it admits with the sphere's mass"
    return "for some target densities that Table A-1 admits"
