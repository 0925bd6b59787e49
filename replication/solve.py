"""The inverse question for a case: which value of one input gives a final depth.

`solve` takes numbers, `solve_printed` texts: then the answer is an interval, which is proven to
contain every value that gives the depth for any inputs that print like these texts.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from replication.cases import INPUTS, OTHER_FACTOR, changed, other_factor
from replication.models import arrays, inverse
from replication.models.impact import Impact
from replication.user_input import advice, place, quoted, read_number, read_printed

QUANTITIES = {
    name: INPUTS[name]
    for name in (
        "resistance", "beta", "flow_stress", "velocity", "radius", "particle_density",
        "target_density",
    )
}  # fmt: skip
"""The inputs that can be solved for, with their SI units."""

DEPTHS = {"depth": "m", "normalized_depth": "1"}
"""The two ways to give the final depth in `solve_printed`, with their SI units."""

_INVERSES: Mapping[str, Callable[..., float]] = {
    "resistance": arrays.resistance_for_depth,
    "velocity": arrays.velocity_for_depth,
    "radius": arrays.radius_for_depth,
    "particle_density": arrays.particle_density_for_depth,
    "target_density": arrays.target_density_for_depth,
}


@dataclass(frozen=True, slots=True)
class Solution:
    """The answer to an inverse question, in SI units.

    `value` is None if no value gives the depth, and `reason` then says why. `condition` is the
    relative change of the value for one of the depth. `interval`, of printed inputs, contains all
    values for inputs that print like these, all their digits taken as significant; None if there is
    none. `fewest_digits` is the same with as few significant digits as the texts allow ("700" has
    one to three); None if they allow no fewer. `inputs` are those that the answer rests on, without
    the depth.
    """

    quantity: str
    inputs: Mapping[str, float]
    depth: float
    normalized_depth: float | None  # None for the radius, if there is no solution
    value: float | None = None
    condition: float | None = None
    interval: tuple[float, float] | None = None
    fewest_digits: tuple[float, float] | None = None
    reason: str = ""


def solve(impact: Impact, quantity: str, depth: float) -> Solution:
    """Return the value of an input of the case that gives a final depth [m].

    The quantity is one of `QUANTITIES`; what the case has for it is not used. For beta the case
    must have a flow stress, and for the flow stress a beta. Raises ValueError for another quantity,
    for a depth that is not above zero, and where numbers leave the range of doubles.

    >>> from replication.cases import BETA_5
    >>> answer = solve(BETA_5, "beta", 3.3e-6)
    >>> f"{answer.value:.1f}", f"{answer.condition:.2f}"
    ('25.5', '-1.94')
    """
    inputs = inputs_but(impact, quantity)
    sought = "resistance" if quantity in OTHER_FACTOR else quantity
    motion = {name: value for name, value in impact.motion.items() if name != sought}
    y = depth / impact.radius if quantity != "radius" else None
    answer = Solution(quantity, inputs, depth, y)
    try:
        value = _INVERSES[sought](depth, **motion)
    except inverse.NoSolutionError as error:
        return replace(answer, reason=str(error))
    case = {**impact.motion, sought: value}
    del case["radius"]
    condition = inverse.conditions(**case)[sought]
    y = arrays.normalized_depth(**case) if y is None else y
    factor = inputs[OTHER_FACTOR[quantity]] if quantity in OTHER_FACTOR else 1.0
    return replace(answer, value=value / factor, condition=condition, normalized_depth=y)


def inputs_but(impact: Impact, quantity: str) -> dict[str, float]:
    """Return the inputs of the case that an answer for the quantity rests on.

    Raises ValueError if the quantity is none of `QUANTITIES`, or an input is missing.
    """
    if quantity not in QUANTITIES:
        raise ValueError(f"cannot solve for {quoted(quantity)}: {advice(quantity, QUANTITIES)}")
    inputs = {name: value for name, value in impact.motion.items() if name != "resistance"}
    if quantity in OTHER_FACTOR:
        inputs[OTHER_FACTOR[quantity]] = other_factor(impact, quantity)
    elif quantity != "resistance":
        parts = {"beta": impact.beta, "flow_stress": impact.flow_stress}
        whole = {"resistance": impact.resistance}
        inputs |= {name: x for name, x in {**parts, **whole}.items() if x is not None}
    inputs.pop(quantity, None)
    return inputs


def solve_printed(impact: Impact, quantity: str, texts: Mapping[str, str]) -> Solution:
    """Return the answer of `solve` and a proven interval, for numbers given as printed texts.

    `texts` has the "depth" or the "normalized_depth", and may have inputs that replace the case's.
    Each stands for all values that print like it; the case's other inputs are exact. The interval
    contains the value for each choice of them. If it begins at zero, some choices have no value.
    Zeros that end an integer are taken as significant, and in `fewest_digits` as not. Raises
    ValueError as `solve` and `read_printed` do.

    >>> from replication.cases import BETA_5
    >>> answer = solve_printed(BETA_5, "resistance", {"depth": "3.3 um"})
    >>> [f"{x / 1e9:.1f}" for x in (answer.value, *answer.interval)]
    ['17.8', '17.3', '18.4']
    """
    given = [name for name in DEPTHS if name in texts]
    if len(given) != 1:
        raise ValueError("give either the depth or the normalized depth")
    if given == ["normalized_depth"] and quantity == "radius":
        raise ValueError("the normalized depth does not depend on the radius: give the depth")
    units = {**INPUTS, **DEPTHS}
    numbers, readings = {}, {}
    for name, text in texts.items():
        with place(name):
            numbers[name] = read_number(text, units[name])
            readings[name] = [interval.ends for interval in read_printed(text, units[name])]
            if min(low for low, _ in readings[name]) <= 0:
                raise ValueError(f"{quoted(text)} may be the text of zero: give more digits")
    impact = changed(impact, {name: x for name, x in numbers.items() if name not in DEPTHS})
    inputs = inputs_but(impact, quantity)
    depth = numbers["depth"] if "depth" in numbers else numbers["normalized_depth"] * impact.radius
    answer = solve(impact, quantity, depth)
    exact = {name: (Fraction(x), Fraction(x)) for name, x in inputs.items()}
    used = {name: ends for name, ends in readings.items() if name in {*inputs, *DEPTHS}}
    every = _enclosed(quantity, exact | {name: ends[0] for name, ends in used.items()})
    fewest = None
    if any(len(ends) > 1 for ends in used.values()):
        fewest = _enclosed(quantity, exact | {name: ends[-1] for name, ends in used.items()})
    return replace(answer, interval=every, fewest_digits=fewest)


def _enclosed(
    quantity: str, box: Mapping[str, tuple[Fraction, Fraction]]
) -> tuple[float, float] | None:
    """Return a proven range of the quantity over a box of the others; None if it has no value."""
    from reference.inverse import enclosed  # Arb takes a while to load

    inputs = dict(box)
    if "normalized_depth" in inputs:  # the depth of a particle of radius 1
        inputs |= {"depth": inputs.pop("normalized_depth"), "radius": (Fraction(1), Fraction(1))}
    ends = enclosed(quantity, inputs)
    if ends is None:
        return None
    return math.nextafter(float(ends[0]), 0.0), math.nextafter(float(ends[1]), math.inf)
