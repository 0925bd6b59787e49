"""The comparisons that the report makes in words, each with the figures to judge it by.

A remark is no number, so it gets no verdict but "remark, quantified": a function of its id computes
what a reader needs to decide whether "slightly", "more pronounced" or "the same" is well said. With
a misprint planted in the report a figure may have no value; it is None then.
"""

from collections.abc import Callable
from dataclasses import replace
from math import isfinite

from reference.ledger import Claim
from reference.scheme import Scheme
from replication.audit.record import Figure
from replication.audit.results import DERIVED, Results, case, exact_ratio
from replication.models import depth, sheet
from replication.models.impact import InputError
from replication.text import quantity

BETAS = (3, 5)


def figures(results: Results, claim: Claim) -> list[Figure]:
    """Return the figures for a claim of the kind "remark"; none for any other claim."""
    return REMARKS[claim.id](results) if claim.kind == "remark" else []


def figure(means: str, unit: str, compute: Callable[[], float]) -> Figure:
    """Return a figure with the computed number, in the unit; None if it has no finite value."""
    try:
        value = float(compute())
    except (ArithmeticError, InputError, LookupError, ValueError):
        return Figure(means=means, value=None, unit=unit)
    return Figure(means=means, value=value if isfinite(value) else None, unit=unit)


def coarse_step(results: Results) -> list[Figure]:
    """Section 3: the results "did not change significantly" with a time step of 0.5 ns."""

    def final_depth(beta: int, scheme: Scheme, step: str) -> float:
        return sheet.run(case(results, beta, step=results[step]), scheme).final_depth

    shown = []
    for beta in BETAS:
        for scheme in Scheme:
            case_words = f"beta = {beta}, drag at the {scheme.drag_at} velocity"
            for step in ("a-step", "coarse-step"):
                step_words = quantity(results.ledger.claims[step].shown, "ns")
                shown.append(
                    figure(
                        f"final depth at {step_words}, {case_words}", "um",
                        lambda b=beta, s=scheme, dt=step: final_depth(b, s, dt) * 1e6,
                    )
                )  # fmt: skip
            shown.append(
                figure(
                    f"change, {case_words}", "percent",
                    lambda b=beta, s=scheme: 100 * (
                        final_depth(b, s, "coarse-step") / final_depth(b, s, "a-step") - 1
                    ),
                )
            )  # fmt: skip
    return shown


def profile_consistent(results: Results) -> list[Figure]:
    """Section 2: a depth of 3.3 um "is consistent with" a profile a little over 2 um deep."""
    mean = results["mean-diameter"] / 2
    needed = results["profile-depth"] / results["observed-depth-ratio"]
    return [
        figure(
            "X/R of that profile for a mean particle", "1", lambda: results["profile-depth"] / mean
        ),
        figure("X/R observed", "1", lambda: results["observed-depth-ratio"]),
        figure(
            "diameter of a particle for which the profile has that X/R", "um",
            lambda: 2 * needed * 1e6,
        ),
    ]  # fmt: skip


def smaller_faster(results: Results) -> list[Figure]:
    """Section 2: "the smaller particles have a higher velocity than the mean", by Eq. 1."""
    return [
        figure(
            f"velocity by Eq. 1 of the {which} particle of the 521-m/s data", "m/s",
            lambda claim=claim: results["velocity-521"]
            * (results["mean-diameter"] / results[claim]) ** 1.5,
        )
        for which, claim in (("smallest", "particle-size-least"), ("largest", "particle-size-greatest"))
    ]  # fmt: skip


def large_difference(results: Results) -> list[Figure]:
    """Section 3: "there is a large difference" between the model and the observations."""
    return [
        figure(
            f"X/R of the model over the observed one, beta = {beta}", "1",
            lambda beta=beta: results[f"ratio-beta-{beta}"] / results["observed-ratio"],
        )
        for beta in BETAS
    ]  # fmt: skip


def closest_approach(results: Results) -> list[Figure]:
    """Section 3: Frank and Zook's "comes closer" to the data "than the other approaches tested"."""
    observed = results["observed-depth-ratio"]

    def apart(means: str, compute: Callable[[], float]) -> Figure:
        return figure(f"X/R less the observed one, {means}", "1", lambda: compute() - observed)

    shown = []
    for target, words in (("rha", "armor"), ("stainless", "stainless steel")):
        claim = f"frank-zook-{target}"
        shown += [
            apart(f"Frank and Zook, {words}, printed", lambda c=claim: results[c]),
            apart(f"Frank and Zook, {words}, Eq. 16", lambda c=claim: results.computed(c)),
            apart(
                f"Frank and Zook, {words}, Eqs. 14 and 15",
                lambda c=claim: results.computed(c, DERIVED),
            ),
        ]
    for beta in BETAS:
        shown.append(
            apart(f"model, beta = {beta}, exact", lambda b=beta: exact_ratio(case(results, b)))
        )
    shown.append(apart("Autodyne", lambda: results["autodyne-ratio"]))
    shown.append(apart("CTH", lambda: results["cth-ratio"]))
    return shown


def codes_overestimate(results: Results) -> list[Figure]:
    """Section 4: "more sophisticated codes also over-estimate the depth of penetration"."""
    return [
        figure(
            f"{code}'s X/R over the observed one, less 1", "percent",
            lambda claim=claim: 100 * (results[claim] / results["observed-depth-ratio"] - 1),
        )
        for code, claim in (("CTH", "cth-ratio"), ("Autodyne", "autodyne-ratio"))
    ]  # fmt: skip


def deeper_craters(results: Results) -> list[Figure]:
    """Section 4: smaller particles "produce deeper craters in relation to their diameters"."""
    shown = []
    for which, claim in (("smallest", "particle-size-least"), ("largest", "particle-size-greatest")):
        size = results["mean-diameter"] / results[claim]
        for law, power in (("Eq. 1", 1.5), ("drag on a sphere", 0.5)):
            shown.append(
                figure(
                    f"exact X/R of the {which} particle of the 521-m/s data, velocity by {law}, "
                    "beta = 5", "1",
                    lambda size=size, power=power: exact_ratio(
                        case(results, 5, velocity=results["velocity-521"] * size**power)
                    ),
                )
            )  # fmt: skip
    return shown


def size_effect(results: Results) -> list[Figure]:
    """Section 4: "the value of X/R for different size particles was the same"."""
    sizes = ("particle-size-least", "mean-diameter", "particle-size-greatest")

    def in_sheet(size: str) -> float:
        return sheet.run(case(results, 5, radius=results[size] / 2)).normalized_depth

    shown = [
        figure(
            f"X/R of the sheet, beta = 5, particles of {results.text(size)} um", "1",
            lambda size=size: in_sheet(size),
        )
        for size in sizes
    ]  # fmt: skip
    exact = "exact X/R, beta = 5, particles of any size: R cancels from Eqs. 12 and 13"
    return [*shown, figure(exact, "1", lambda: exact_ratio(case(results, 5)))]


def velocity_effect(results: Results) -> list[Figure]:
    """Section 4: the "effect of particle velocity on X/R is more pronounced"."""
    least, greatest = "figure-5-velocity-least", "figure-5-velocity-greatest"

    def ratio(velocity: str) -> float:
        return exact_ratio(case(results, 5, velocity=results[velocity]))

    return [
        figure(f"exact X/R at {results.text(least)} m/s, beta = 5", "1", lambda: ratio(least)),
        figure(f"exact X/R at {results.text(greatest)} m/s, beta = 5", "1", lambda: ratio(greatest)),
        figure("rise between them", "percent", lambda: 100 * (ratio(greatest) / ratio(least) - 1)),
    ]


def velocity_distribution(results: Results) -> list[Figure]:
    """Section 4: "velocity distribution effects cannot explain the difference"."""

    def needed() -> float:
        """Velocity [m/s] at which the exact X/R for beta = 5 is the observed one."""
        y, impact = results["observed-ratio"], case(results, 5)
        return depth.velocity_for(y, impact)

    deviation = results["velocity-deviation"]
    return [
        figure("velocity at which the exact X/R is 0.3, beta = 5", "m/s", needed),
        figure(
            "its distance from the average of 521 m/s, in stated deviations", "1",
            lambda: (results["velocity-521"] - needed()) / deviation,
        ),
    ]  # fmt: skip


def rising_resistance(results: Results) -> list[Figure]:
    """Section 4: a target resistance that grows with the strain rate lowers the depth."""
    impact = case(results, 5)
    doubled = replace(impact, beta=2 * impact.beta) if impact.beta else impact
    return [
        figure("exact X/R, beta = 5", "1", lambda: exact_ratio(impact)),
        figure("exact X/R at twice that resistance", "1", lambda: exact_ratio(doubled)),
    ]


REMARKS: dict[str, Callable[[Results], list[Figure]]] = {
    "profile-consistent": profile_consistent,
    "smaller-faster": smaller_faster,
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
