"""What the author may have computed in place of Eq. 16: a family of slips, generated and counted.

Eq. 16 prints X/R = ((L/D rho_p/rho_t + k_1)/2kt) ln(1 + k_t rho_t V^2/R_t). Whoever types it into a
cell can slip in each thing that he types once: the density ratio, L/D, k_1, what the ratio
multiplies, the sign between the two terms, k_t in the divisor, the divisor's brackets, the factor,
density and power of the drag, what divides what, the 1, the logarithm, what joins them, X/R for
X/D, and each number that is put in. These are the parts; the slips in one part exclude each other,
as a thing is typed in one way only, and slips in different parts go together. Each slip below is a
small function with its name. A member of the family is Eq. 16 with one slip in each of at most
three parts, one of which is "X/R is twice X/D": both printed values need about twice of what Eq. 16
as printed gives, whatever else was done. The sign of a negative result is dropped, as a depth has
none.

A family of thousands hits any number by accident. How many hits to expect is computed from the
family's own values: each member within a factor of 1.5 of the number would hit it with a chance
that is the width of the rounding interval over the width of that range, on a logarithmic scale;
what the admitted target densities move the member adds to the width. A member that fits is
suggestive, and never a proof.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import combinations
from math import inf, log, log10, sqrt
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from reference.ledger import Claim, Ledger
from replication.audit.inference import DENSITY
from replication.audit.record import FittingSlip, SlipsTried
from replication.audit.verdict import Judge
from replication.text import number, powers_of_ten


class Eq16Inputs(Struct, frozen=True):
    """The inputs of Eq. 16: L/D, k_1 and k_t [1], densities [kg/m^3], V [m/s] and R_t [Pa]."""

    L_D: float
    rho_p: float
    rho_t: float
    k_1: float
    k_t: float
    V: float
    R_t: float


Pair = tuple[float, float]
"""Two terms that are summed, or a numerator and its denominator."""

PutIn = Callable[[Eq16Inputs], Eq16Inputs]
"""What becomes of the numbers that are put in."""

Part = Callable[[Eq16Inputs], float]
"""A part of Eq. 16 that is computed from the numbers put in."""

Sum = Callable[[float, float], float]
"""What joins the two terms in brackets."""


# The parts of Eq. 16 as printed


def as_they_are(x: Eq16Inputs) -> Eq16Inputs:
    return x


def length_over_diameter(x: Eq16Inputs) -> float:
    return x.L_D


def rho_p_over_rho_t(x: Eq16Inputs) -> float:
    return x.rho_p / x.rho_t


def k_1_itself(x: Eq16Inputs) -> float:
    return x.k_1


def k_t_itself(x: Eq16Inputs) -> float:
    return x.k_t


def ratio_on_length(length: float, densities: float, k_1: float) -> Pair:
    return length * densities, k_1


def summed(first: float, second: float) -> float:
    return first + second


def twice(k_t: float) -> float:
    return 2 * k_t


def density_of_target(x: Eq16Inputs) -> float:
    return x.rho_t


def velocity_squared(x: Eq16Inputs) -> float:
    return x.V * x.V


def drag_over_resistance(drag: float, resistance: float) -> Pair:
    return drag, resistance


def one_plus(top: float, bottom: float) -> float:
    return 1 + top / bottom


def natural_logarithm(value: float) -> float:
    return log(value)


def sum_over_divisor(add: Sum, terms: Pair, divisor: float, logarithm: float) -> float:
    return add(*terms) / divisor * logarithm


def as_it_is(ratio: float) -> float:
    return ratio


class Eq16(Struct, frozen=True):
    """Eq. 16 as it may be typed: a function for each thing that is typed once.

    Without a slip it is as printed: X/R = ((L/D rho_p/rho_t + k_1)/2kt) ln(1 + k_t rho_t V^2/R_t).
    """

    # the numbers that are put in
    velocity: PutIn = as_they_are
    resistance: PutIn = as_they_are
    length: PutIn = as_they_are
    parameters: PutIn = as_they_are
    densities: PutIn = as_they_are
    # the sum in brackets, L/D rho_p/rho_t + k_1: its two terms, and the sign between them
    length_ratio: Part = length_over_diameter
    density_ratio: Part = rho_p_over_rho_t
    k_1: Part = k_1_itself
    terms: Callable[[float, float, float], Pair] = ratio_on_length
    sign: Sum = summed
    # what divides the sum, 2 k_t
    k_t_below: Part = k_t_itself
    divisor: Callable[[float], float] = twice
    # the logarithm, ln(1 + k_t rho_t V^2/R_t)
    k_t_above: Part = k_t_itself
    density_above: Part = density_of_target
    power: Part = velocity_squared
    fraction: Callable[[float, float], Pair] = drag_over_resistance
    argument: Callable[[float, float], float] = one_plus
    logarithm: Callable[[float], float] = natural_logarithm
    # what joins the three, and X/R for X/D
    joined: Callable[[Sum, Pair, float, float], float] = sum_over_divisor
    scale: Callable[[float], float] = as_it_is

    def depth(self, x: Eq16Inputs) -> float:
        """Return X/R [1], without its sign.

        Raises ValueError or ArithmeticError where it has no value.

        >>> x = Eq16Inputs(2 / 3, 8900.0, 7850.0, k_1=0.557, k_t=1.046, V=500.0, R_t=9.13e9)
        >>> f"{Eq16().depth(x):.3f}"
        '0.127'
        """
        x = self.densities(self.parameters(self.length(self.resistance(self.velocity(x)))))
        terms = self.terms(self.length_ratio(x), self.density_ratio(x), self.k_1(x))
        divisor = self.divisor(self.k_t_below(x))
        drag = self.k_t_above(x) * self.density_above(x) * self.power(x)
        logarithm = self.logarithm(self.argument(*self.fraction(drag, x.R_t)))
        return abs(self.scale(self.joined(self.sign, terms, divisor, logarithm)))


# The slips


class Slip(Struct, frozen=True):
    """A slip in one part of Eq. 16, in words and as the function that is typed for the part.

    The part is the name of a field of `Eq16`.
    """

    part: str
    says: str
    function: Callable[..., Any]


def slip(part: str, says: str) -> Callable[[Callable[..., Any]], Slip]:
    """Make a slip of a function that computes a part of Eq. 16."""
    return lambda function: Slip(part, says, function)


# The density ratio, as printed: rho_p/rho_t


@slip("density_ratio", "the density ratio upside down")
def density_ratio_inverted(x: Eq16Inputs) -> float:
    return x.rho_t / x.rho_p


@slip("density_ratio", "the square root of the density ratio, as for long rods")
def density_ratio_rooted(x: Eq16Inputs) -> float:
    return sqrt(x.rho_p / x.rho_t)


@slip("density_ratio", "no density ratio")
def density_ratio_left_out(_: Eq16Inputs) -> float:
    return 1.0


# L/D


@slip("length_ratio", "no L/D")
def length_left_out(_: Eq16Inputs) -> float:
    return 1.0


@slip("length_ratio", "L/R for L/D")
def length_over_radius(x: Eq16Inputs) -> float:
    return 2 * x.L_D


@slip("length_ratio", "half of L for L")
def half_length(x: Eq16Inputs) -> float:
    return x.L_D / 2


@slip("length_ratio", "D/L for L/D")
def length_ratio_inverted(x: Eq16Inputs) -> float:
    return 1 / x.L_D


# k_1


@slip("k_1", "no k_1")
def k_1_left_out(_: Eq16Inputs) -> float:
    return 0.0


@slip("k_1", "k_1/2 for k_1")
def k_1_halved(x: Eq16Inputs) -> float:
    return x.k_1 / 2


@slip("k_1", "2 k_1 for k_1, as D is 2R")
def k_1_doubled(x: Eq16Inputs) -> float:
    return 2 * x.k_1


@slip("k_1", "k_t for k_1")
def k_t_for_k_1(x: Eq16Inputs) -> float:
    return x.k_t


# What the density ratio multiplies: L/D


@slip("terms", "the density ratio on k_1 in place of L/D")
def density_ratio_on_k_1(length: float, densities: float, k_1: float) -> Pair:
    return length, k_1 * densities


@slip("terms", "the density ratio on both terms")
def density_ratio_on_both(length: float, densities: float, k_1: float) -> Pair:
    return length * densities, k_1 * densities


# The sign between the two terms: +


@slip("sign", "only k_1")
def inertia_left_out(_: float, second: float) -> float:
    return second


@slip("sign", "k_1 subtracted")
def k_1_subtracted(first: float, second: float) -> float:
    return first - second


@slip("sign", "k_1 as a factor")
def k_1_multiplied(first: float, second: float) -> float:
    return first * second


# The divisor, as printed: 2 k_t


@slip("k_t_below", "no k_t in the divisor")
def k_t_left_out(_: Eq16Inputs) -> float:
    return 1.0


@slip("k_t_below", "k_1 for k_t in the divisor")
def k_1_for_k_t(x: Eq16Inputs) -> float:
    return x.k_1


@slip("k_t_below", "1/2 for k_t in the divisor, as in Eq. 5")
def half_for_k_t(_: Eq16Inputs) -> float:
    return 0.5


@slip("k_t_below", "k_t squared in the divisor")
def k_t_squared(x: Eq16Inputs) -> float:
    return x.k_t * x.k_t


@slip("divisor", "/2*k_t typed without brackets, which multiplies by k_t")
def multiplied_by_k_t(k_t: float) -> float:
    return 2 / k_t


# The drag over the resistance, as printed: k_t rho_t V^2/R_t


@slip("k_t_above", "no k_t in the logarithm")
def k_t_left_out_of_drag(_: Eq16Inputs) -> float:
    return 1.0


@slip("k_t_above", "1/2 for k_t in the logarithm, as in Eq. 5")
def half_for_k_t_in_drag(_: Eq16Inputs) -> float:
    return 0.5


@slip("k_t_above", "k_1 for k_t in the logarithm")
def k_1_in_drag(x: Eq16Inputs) -> float:
    return x.k_1


@slip("k_t_above", "k_t/2 in the logarithm: the 1/2 of Eq. 5 and k_t")
def half_k_t_in_drag(x: Eq16Inputs) -> float:
    return x.k_t / 2


@slip("k_t_above", "2 k_t in the logarithm, as in the divisor")
def twice_k_t_in_drag(x: Eq16Inputs) -> float:
    return 2 * x.k_t


@slip("density_above", "the particle's density in the logarithm")
def rho_p_in_drag(x: Eq16Inputs) -> float:
    return x.rho_p


@slip("power", "V not squared")
def velocity_not_squared(x: Eq16Inputs) -> float:
    return x.V


@slip("fraction", "the drag upside down: R_t/(k_t rho_t V^2)")
def drag_inverted(drag: float, resistance: float) -> Pair:
    return resistance, drag


# The logarithm, as printed: ln(1 + drag over resistance)


@slip("argument", "no 1 in the logarithm")
def one_left_out(top: float, bottom: float) -> float:
    return top / bottom


@slip("argument", "1 - for 1 +")
def one_minus(top: float, bottom: float) -> float:
    return 1 - top / bottom


@slip("argument", "R_t divides 1, too: (1 + k_t rho_t V^2)/R_t")
def bracket_too_early(top: float, bottom: float) -> float:
    return (1 + top) / bottom


@slip("logarithm", "the logarithm to base 10: LOG for LN")
def base_10(value: float) -> float:
    return log10(value)


@slip("logarithm", "no logarithm: its argument less 1")
def no_logarithm(value: float) -> float:
    return value - 1


# What joins them, as printed: (sum/divisor) logarithm; and X/R for X/D


@slip("joined", "no brackets around the sum: only k_1 is divided, and multiplied by the logarithm")
def sum_without_brackets(add: Sum, terms: Pair, divisor: float, logarithm: float) -> float:
    return add(terms[0], terms[1] / divisor * logarithm)


@slip("joined", "the logarithm in the divisor")
def logarithm_below(add: Sum, terms: Pair, divisor: float, logarithm: float) -> float:
    return add(*terms) / (divisor * logarithm)


@slip("joined", "no divisor")
def divisor_left_out(add: Sum, terms: Pair, _: float, logarithm: float) -> float:
    return add(*terms) * logarithm


@slip("scale", "X/R is twice X/D")
def doubled(ratio: float) -> float:
    return 2 * ratio


@slip("scale", "X/R is half of X/D")
def halved(ratio: float) -> float:
    return ratio / 2


@slip("scale", "X/R is four times X/D")
def doubled_twice(ratio: float) -> float:
    return 4 * ratio


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


TYPED = (
    density_ratio_inverted, density_ratio_rooted, density_ratio_left_out,
    length_left_out, length_over_radius, half_length, length_ratio_inverted,
    k_1_left_out, k_1_halved, k_1_doubled, k_t_for_k_1,
    density_ratio_on_k_1, density_ratio_on_both,
    inertia_left_out, k_1_subtracted, k_1_multiplied,
    k_t_left_out, k_1_for_k_t, half_for_k_t, k_t_squared,
    multiplied_by_k_t,
    k_t_left_out_of_drag, half_for_k_t_in_drag, k_1_in_drag, half_k_t_in_drag, twice_k_t_in_drag,
    rho_p_in_drag, velocity_not_squared, drag_inverted,
    one_left_out, one_minus, bracket_too_early,
    base_10, no_logarithm,
    sum_without_brackets, logarithm_below, divisor_left_out,
    doubled, halved, doubled_twice,
    parameters_exchanged, densities_of_particle, densities_exchanged,
)  # fmt: skip
"""The slips in what is typed: all but the numbers that the report names elsewhere."""


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
    slips = [*TYPED, *numbers_named(ledger, x)]
    pairs = [pair for pair in combinations(slips, 2) if pair[0].part != pair[1].part]
    doubled_too = [
        (doubled, *pair) for pair in pairs if all(slip.part != doubled.part for slip in pair)
    ]
    return [(), *((slip,) for slip in slips), *pairs, *doubled_too]


def with_slips(member: Member) -> Eq16:
    """Return Eq. 16 with these slips. Raises TypeError for a slip in a part that it has not."""
    return replace(Eq16(), **{slip.part: slip.function for slip in member})


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
        typed = with_slips(member)
        value = _value(typed, x)
        if value is None or (digits := f"{value:.12e}") in seen:
            continue
        seen.add(digits)
        if not middle / NEAR <= value <= middle * NEAR:
            continue
        near += 1
        at_ends = [_value(typed, replace(x, rho_t=density)) for density in densities]
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
    # It adds hundreds of logarithms, which C libraries round otherwise: nine decimals are the same.
    return SlipsTried(len(forms), len(seen), near, round(expected, 9)), fitting


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


def _value(typed: Eq16, x: Eq16Inputs) -> float | None:
    """Return X/R of Eq. 16 as typed; None if it has no value, or none above zero."""
    try:
        value = typed.depth(x)
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
