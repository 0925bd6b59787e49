"""The comparisons that the report makes in words, each with the figures to judge it by.

A remark is no number, so it gets no verdict but "remark, quantified": a function of its id computes
what a reader needs to decide whether "slightly", "more pronounced" or "the same" is well said. With
a misprint planted in the report a figure may have no value; it is None then.
"""

from collections.abc import Callable
from itertools import product
from math import isfinite
from typing import Any

from reference.ledger import Claim
from reference.scheme import Scheme
from replication.audit.record import Figure
from replication.audit.results import DERIVED, Results, case, exact_ratio
from replication.models import sheet
from replication.models.impact import InputError
from replication.models.inverse import velocity_for_depth

BETAS = (3, 5)


def figures(results: Results, claim: Claim) -> list[Figure]:
    """Return the figures for a claim of the kind "remark"; none for any other claim."""
    return REMARKS[claim.id](results) if claim.kind == "remark" else []


def quantified(means: str, unit: str, compute: Callable[..., float], *arguments: Any) -> Figure:
    """Return a figure with the computed number, in the unit; None if it has no finite value."""
    try:
        value = float(compute(*arguments))
    except (ArithmeticError, InputError, LookupError, ValueError):
        return Figure(means=means, value=None, unit=unit)
    return Figure(means=means, value=value if isfinite(value) else None, unit=unit)


def coarse_step(results: Results) -> list[Figure]:
    """Section 3: the results "did not change significantly" with a time step of 0.5 ns."""

    def micrometers(beta: int, scheme: Scheme, step: str) -> float:
        return sheet.run(case(results, beta, step=results[step]), scheme).final_depth * 1e6

    def change(beta: int, scheme: Scheme) -> float:
        coarse, fine = (micrometers(beta, scheme, step) for step in ("coarse-step", "a-step"))
        return 100 * (coarse / fine - 1)

    shown = []
    for beta, scheme in product(BETAS, Scheme):
        words = f"beta = {beta}, drag at the {scheme.drag_at} velocity"
        for step in ("a-step", "coarse-step"):
            means = f"final depth at {results.text(step)} ns, {words}"
            shown.append(quantified(means, "um", micrometers, beta, scheme, step))
        shown.append(quantified(f"change, {words}", "percent", change, beta, scheme))
    return shown


def profile_consistent(results: Results) -> list[Figure]:
    """Section 2: a depth of 3.3 um "is consistent with" a profile a little over 2 um deep."""

    def of_mean_particle() -> float:
        return results["profile-depth"] / (results["mean-diameter"] / 2)

    def diameter() -> float:
        return 2 * results["profile-depth"] / results["observed-depth-ratio"] * 1e6

    return [
        quantified("X/R of that profile for a mean particle", "1", of_mean_particle),
        quantified("X/R observed", "1", results.__getitem__, "observed-depth-ratio"),
        quantified("diameter of a particle for which the profile has that X/R", "um", diameter),
    ]


def smaller_faster(results: Results) -> list[Figure]:
    """Section 2: "the smaller particles have a higher velocity than the mean", by Eq. 1."""
    return [
        quantified(
            f"velocity of the {which} particle of the 521-m/s data by {law}", "m/s",
            stream_velocity, results, size, power,
        )
        for (which, size), (law, power) in product(EXTREMES, LAWS)
    ]  # fmt: skip


EXTREMES = (("smallest", "particle-size-least"), ("largest", "particle-size-greatest"))
"""The extreme particles of Figure 1, and the claims that print their diameters."""


def stream_velocity(results: Results, size: str, power: str) -> float:
    """Velocity [m/s] of a particle of this size in the stream of 521 m/s.

    It is proportional to the mass to a power, by Eq. 1 (whose power a claim prints), or to the
    diameter to the power -1/2, by drag on a sphere.
    """
    exponent = 3 * results[power] if power else 0.5
    faster: float = (results["mean-diameter"] / results[size]) ** exponent
    return results["velocity-521"] * faster


LAWS = (("Eq. 1", "eq1-power"), ("drag on a sphere", ""))
"""Two laws of a particle's velocity by its size, and the claim that prints the power, if any."""


def large_difference(results: Results) -> list[Figure]:
    """Section 3: "there is a large difference" between the model and the observations."""

    def over_observed(beta: int) -> float:
        return results[f"ratio-beta-{beta}"] / results["observed-ratio"]

    means = "X/R of the model over the observed one, beta = {}"
    return [quantified(means.format(beta), "1", over_observed, beta) for beta in BETAS]


def closest_approach(results: Results) -> list[Figure]:
    """Section 3: Frank and Zook's "comes closer" to the data "than the other approaches tested"."""

    def apart(means: str, compute: Callable[..., float], *arguments: Any) -> Figure:
        def less_observed() -> float:
            return compute(*arguments) - results["observed-depth-ratio"]

        return quantified(f"X/R less the observed one, {means}", "1", less_observed)

    def exact(beta: int) -> float:
        return exact_ratio(case(results, beta))

    shown = []
    for target, words in (("rha", "armor"), ("stainless", "stainless steel")):
        claim, by = f"frank-zook-{target}", f"Frank and Zook, {words}"
        shown += [
            apart(f"{by}, printed", results.__getitem__, claim),
            apart(f"{by}, Eq. 16", results.computed, claim),
            apart(f"{by}, Eqs. 14 and 15", results.computed, claim, DERIVED),
        ]
    shown += [apart(f"model, beta = {beta}, exact", exact, beta) for beta in BETAS]
    for code, claim in CODES:
        shown.append(apart(code, results.__getitem__, claim))
    return shown


CODES = (("Autodyne", "autodyne-ratio"), ("CTH", "cth-ratio"))
"""The hydrocodes, and the claims that print their X/R."""


def codes_overestimate(results: Results) -> list[Figure]:
    """Section 4: "more sophisticated codes also over-estimate the depth of penetration"."""

    def excess(claim: str) -> float:
        return 100 * (results[claim] / results["observed-depth-ratio"] - 1)

    means = "{}'s X/R over the observed one, less 1"
    return [quantified(means.format(code), "percent", excess, claim) for code, claim in CODES]


def deeper_craters(results: Results) -> list[Figure]:
    """Section 4: smaller particles "produce deeper craters in relation to their diameters"."""

    def ratio(size: str, power: str) -> float:
        return exact_ratio(case(results, 5, velocity=stream_velocity(results, size, power)))

    return [
        quantified(
            f"exact X/R of the {which} particle of the 521-m/s data, velocity by {law}, beta = 5",
            "1", ratio, size, power,
        )
        for (which, size), (law, power) in product(EXTREMES, LAWS)
    ]  # fmt: skip


def size_effect(results: Results) -> list[Figure]:
    """Section 4: "the value of X/R for different size particles was the same"."""

    def in_sheet(size: str) -> float:
        return sheet.run(case(results, 5, radius=results[size] / 2)).normalized_depth

    def exact() -> float:
        return exact_ratio(case(results, 5))

    sizes = ("particle-size-least", "mean-diameter", "particle-size-greatest")
    means = "X/R of the sheet, beta = 5, particles of {} um"
    any_size = "exact X/R, beta = 5, for every size: R cancels from Eqs. 12 and 13"
    shown = [quantified(means.format(results.text(size)), "1", in_sheet, size) for size in sizes]
    return [*shown, quantified(any_size, "1", exact)]


def velocity_effect(results: Results) -> list[Figure]:
    """Section 4: the "effect of particle velocity on X/R is more pronounced"."""
    ends = ("figure-5-velocity-least", "figure-5-velocity-greatest")

    def ratio(velocity: str) -> float:
        return exact_ratio(case(results, 5, velocity=results[velocity]))

    def rise() -> float:
        return 100 * (ratio(ends[1]) / ratio(ends[0]) - 1)

    means = "exact X/R at {} m/s, beta = 5"
    shown = [quantified(means.format(results.text(end)), "1", ratio, end) for end in ends]
    return [*shown, quantified("rise between them", "percent", rise)]


def velocity_distribution(results: Results) -> list[Figure]:
    """Section 4: "velocity distribution effects cannot explain the difference"."""

    def needed() -> float:
        """Velocity [m/s] at which the exact X/R for beta = 5 is the observed one."""
        impact = case(results, 5)
        return velocity_for_depth(
            results["observed-ratio"] * impact.radius,
            impact.radius,
            impact.particle_density,
            impact.target_density,
            impact.target_resistance,
        )

    def deviations() -> float:
        return (results["velocity-521"] - needed()) / results["velocity-deviation"]

    return [
        quantified("velocity at which the exact X/R is 0.3, beta = 5", "m/s", needed),
        quantified(
            "its distance from the average of 521 m/s in stated deviations", "1", deviations
        ),
    ]


def rising_resistance(results: Results) -> list[Figure]:
    """Section 4: a target resistance that grows with the strain rate lowers the depth."""

    def ratio(times: int) -> float:
        impact = case(results, 5)
        return exact_ratio(case(results, 5, resistance=times * impact.target_resistance))

    return [
        quantified("exact X/R, beta = 5", "1", ratio, 1),
        quantified("exact X/R at twice that resistance", "1", ratio, 2),
    ]


REMARKS: dict[str, Callable[[Results], list[Figure]]] = {
    "smaller-faster": smaller_faster,
    "profile-consistent": profile_consistent,
    "coarse-step-remark": coarse_step,
    "large-difference": large_difference,
    "closest-approach": closest_approach,
    "codes-overestimate": codes_overestimate,
    "deeper-craters": deeper_craters,
    "size-effect": size_effect,
    "velocity-effect": velocity_effect,
    "velocity-distribution": velocity_distribution,
    "rising-resistance": rising_resistance,
}
"""The function that computes the figures of each remark."""
