"""What the report says in words of its results, each with the figures to judge it by.

A remark is no number, so it gets no verdict but "remark, quantified": a function of its id computes
what a reader needs to decide whether "slightly", "more pronounced" or "the same" is well said. The
first figure is the one that tells most. A remark that says again what another says has no figures
of its own. With a misprint planted in the report a figure may have no value; it is None then.
"""

from collections.abc import Callable
from itertools import product
from math import erfc, isfinite, log1p, pi, sqrt
from statistics import NormalDist
from typing import Any

from reference.ledger import Claim
from reference.scheme import Scheme
from replication.audit.comparison import BETAS
from replication.audit.findings.resistance import johnson_cook_copper, resistances
from replication.audit.findings.sheet import depth_by_sheet
from replication.audit.findings.stream import GAUSSIAN
from replication.audit.record import Figure
from replication.audit.results import DERIVED, Results, case, exact_ratio
from replication.models import sheet
from replication.models.crater import contact_diameter, volume_ratio
from replication.models.estimates import penetration_threshold
from replication.models.impact import InputError
from replication.models.inverse import velocity_for_depth


def figures(results: Results, claim: Claim) -> list[Figure]:
    """Return the figures for a claim of the kind "remark"; none for a claim that has none."""
    return REMARKS[claim.id](results) if claim.id in REMARKS else []


def quantified(means: str, unit: str, compute: Callable[..., float], *arguments: Any) -> Figure:
    """Return a figure with the computed number, in the unit; None if it has no finite value."""
    try:
        value = float(compute(*arguments))
    except (ArithmeticError, InputError, LookupError, ValueError):
        return Figure(means=means, value=None, unit=unit)
    return Figure(means=means, value=value if isfinite(value) else None, unit=unit)


def percent_beyond(deviations: float) -> float:
    """Return how many percent of a normal distribution lie above its mean by so many deviations.

    By the complement of the error function, which keeps its digits far from the mean.
    """
    return 50 * erfc(deviations / sqrt(2))


DEVIATIONS = (("mean", GAUSSIAN), ("standard", 1.0))
"""How the velocities' deviation can be meant, and that of a normal distribution over its standard.

The report says "mean"; the second is how the word is mostly used.
"""


def percent_of_stream(results: Results, slow: str, fast: str, deviation: float) -> float:
    """Return how many percent of a stream are faster than `fast`, `slow` being its average.

    As many are slower than `slow` if `fast` is the average; both are claims. The deviation that
    the report states is that of a normal distribution, as a multiple of its standard deviation.
    """
    distance = results[fast] - results[slow]
    return percent_beyond(distance / results["velocity-deviation"] * deviation)


def percent_more(value: float, than: float) -> float:
    """Return by how many percent a value exceeds another."""
    return 100 * (value / than - 1)


LAWS = (("Eq. 1", "eq1-power"), ("drag on a sphere", ""))
"""Two laws of a particle's velocity by its size, and the claim that prints the power, if any."""


EXTREMES = (("smallest", "particle-size-least"), ("largest", "particle-size-greatest"))
"""The extreme particles of Figure 1, and the claims that print their diameters."""


def stream_velocity(results: Results, stream: str, size: str, power: str) -> float:
    """Velocity [m/s] of a particle of this size in a stream with this average, both by claim.

    It is proportional to the mass to a power, by Eq. 1 (whose power a claim prints), or to the
    diameter to the power -1/2, by drag on a sphere.
    """
    faster: float = (results["mean-diameter"] / results[size]) ** by_diameter(results, power)
    return results[stream] * faster


def by_diameter(results: Results, power: str) -> float:
    """Return the power of 1/diameter to which a law makes the velocity proportional."""
    return 3 * results[power] if power else 0.5


# Section 2


def eq1_agreement(results: Results) -> list[Figure]:
    """Section 2: Eq. 1 is in "not good quantitative agreement" with experiments."""

    def deviation(power: str) -> float:
        sizes = results["diameter-deviation"] / results["mean-diameter"]
        return by_diameter(results, power) * sizes * results["a1-initial-velocity"] * GAUSSIAN

    stated = "mean deviation of the velocity that section 4 states"
    means = "mean deviation at 500 m/s by {}, to first order in the printed sizes"
    return [
        *(quantified(means.format(law), "m/s", deviation, power) for law, power in LAWS),
        quantified(stated, "m/s", results.__getitem__, "velocity-deviation"),
    ]


def smaller_faster(results: Results) -> list[Figure]:
    """Section 2: "the smaller particles have a higher velocity than the mean", by Eq. 1."""
    return [
        quantified(
            f"velocity of the {which} particle of the 521-m/s data by {law}", "m/s",
            stream_velocity, results, "velocity-521", size, power,
        )
        for (which, size), (law, power) in product(EXTREMES, LAWS)
    ]  # fmt: skip


def clustered_small(results: Results) -> list[Figure]:
    """Section 2: of the data points more are "clustered at the lower end of the range"."""

    def share(of_range: Callable[[float, float], float]) -> float:
        least, greatest = results["particle-size-least"], results["particle-size-greatest"]
        below = NormalDist(results["mean-diameter"], results["diameter-deviation"]).cdf
        return (
            100
            * (below(of_range(least, greatest)) - below(least))
            / (below(greatest) - below(least))
        )

    return [
        quantified(
            "share of the powder's particles of 10 to 30 um that are below 20 um, their sizes "
            "Gaussian as printed",
            "percent", share, lambda least, greatest: (least + greatest) / 2,
        ),
        quantified(
            "the same below the mean of 22 um", "percent", share,
            lambda _, __: results["mean-diameter"],
        ),
    ]  # fmt: skip


def regardless_of_size(results: Results) -> list[Figure]:
    """Section 2: a minimum CV/PV "regardless of the particle size"; the model has one, too."""

    def crater(beta: int) -> float:
        return volume_ratio(exact_ratio(case(results, beta, velocity=results["velocity-521"])))

    means = "CV/PV of the model at 521 m/s, the same for every size, beta = {}"
    return [
        *(quantified(means.format(beta), "1", crater, beta) for beta in BETAS),
        quantified("least CV/PV of the data", "1", results.__getitem__, "volume-ratio-line"),
    ]


def certainly_higher(results: Results) -> list[Figure]:
    """Section 2: as none stuck at 403 m/s, the minimum velocity "would certainly be higher"."""
    return [
        quantified(
            f"velocity of the smallest particle, 10 um, in the stream of 403 m/s by {law}", "m/s",
            stream_velocity, results, "velocity-403", "particle-size-least", power,
        )
        for law, power in LAWS
    ]  # fmt: skip


def surprisingly_shallow(results: Results) -> list[Figure]:
    """Section 2: a depth of 3.3 um for a particle of 22 um is "surprisingly shallow"."""

    def over_diameter() -> float:
        return 100 * results["observed-depth"] / results["observed-depth-diameter"]

    def over_model(beta: int) -> float:
        return results["observed-depth"] / results[f"depth-beta-{beta}"]

    means = "the observed over the printed depth of the model, beta = {}"
    return [
        quantified("observed depth over the particle's diameter", "percent", over_diameter),
        *(quantified(means.format(beta), "1", over_model, beta) for beta in BETAS),
    ]


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


# Section 3


def larger_grain(results: Results) -> list[Figure]:
    """Section 3: a grain "can be much larger" than a particle: it encloses several craters.

    The report gives no size of a grain. The least circle around three equal ones that touch is
    1 + 2/3^(1/2) times as wide as one of them.
    """
    diameter = "crater-particle-diameter"

    def crater() -> float:
        wide = contact_diameter(results["observed-third"], results[diameter])
        return wide / results[diameter]

    def around_three() -> float:
        return (1 + 2 / sqrt(3)) * crater()

    third = "a particle of 20 um pressed in by a third of its radius"
    return [
        quantified(
            "diameter of a grain around three craters side by side, over a particle's", "1",
            around_three,
        ),
        quantified(f"diameter of the crater of {third}, over the particle's", "1", crater),
    ]  # fmt: skip


def copper_stronger(results: Results) -> list[Figure]:
    """Section 3: a rigid particle needs a strength "greater than the target resistance"."""

    def resistance(beta: int) -> float:
        return float(resistances(results)[beta]) / 1e9

    return [
        quantified("strength quoted for copper", "GPa", lambda: results["copper-yield"] / 1e9),
        *(quantified(f"target resistance, beta = {b}", "GPa", resistance, b) for b in BETAS),
    ]


def particle_stronger(results: Results) -> list[Figure]:
    """Section 3: a particle's strength "may be much higher" than that of bulk copper."""

    def multiple(beta: int) -> float:
        return float(resistances(results)[beta]) / results["copper-yield"]

    means = "target resistance over the strength quoted for copper, beta = {}"
    return [quantified(means.format(beta), "1", multiple, beta) for beta in BETAS]


def rates_far_higher(results: Results) -> list[Figure]:
    """Section 3: strain rates of the impact are "far higher" than split-Hopkinson bars reach."""

    def rate() -> float:
        return results["strain-rate-velocity"] / results["strain-rate-length"]

    def times() -> float:
        (_, greatest) = results.ledger.sources["hopkinson-rates"].numbers
        return rate() / float(greatest.value)

    return [
        quantified(
            "strain rate of the impact over 10,000 per second, up to which a public source says "
            "that these bars are generally used",
            "1", times,
        ),
        quantified("strain rate, velocity over diameter as printed", "1/s", rate),
    ]  # fmt: skip


def strength_rises(results: Results) -> list[Figure]:
    """Section 3: copper's strength can be expected to "increase with increasing strain rate"."""

    def times() -> float:
        slow = results["copper-johnson-cook"] + results["copper-johnson-cook-hardening"]
        return johnson_cook_copper(results) / slow

    law = "Johnson and Cook's law for copper"
    return [
        quantified(f"flow stress at 10^7 over that at 1 per second by {law}", "1", times),
        quantified(
            f"flow stress at 10^7 per second and strain 1 by {law}, far beyond its fit", "MPa",
            lambda: johnson_cook_copper(results) / 1e6,
        ),
    ]  # fmt: skip


def coarse_step(results: Results) -> list[Figure]:
    """Section 3: the results "did not change significantly" with a time step of 0.5 ns."""

    def micrometers(beta: int, scheme: Scheme, step: str) -> float:
        return depth_by_sheet(results, beta, scheme, step) * 1e6

    def change(beta: int, scheme: Scheme) -> float:
        coarse, fine = (micrometers(beta, scheme, step) for step in ("coarse-step", "a-step"))
        return percent_more(coarse, fine)

    shown = []
    for beta, scheme in product(BETAS, Scheme):
        words = f"beta = {beta}, drag at the {scheme.drag_at} velocity"
        shown.append(quantified(f"change, {words}", "percent", change, beta, scheme))
        for step in ("a-step", "coarse-step"):
            means = f"final depth at {results.text(step)} ns, {words}"
            shown.append(quantified(means, "um", micrometers, beta, scheme, step))
    return shown


def large_difference(results: Results) -> list[Figure]:
    """Section 3: "there is a large difference" between the model and the observations."""

    def over_observed(beta: int) -> float:
        return results[f"ratio-beta-{beta}"] / results["observed-ratio"]

    means = "X/R of the model over the observed one, beta = {}"
    return [quantified(means.format(beta), "1", over_observed, beta) for beta in BETAS]


def rigid_attribution(results: Results) -> list[Figure]:
    """Section 3: the disparity is "most likely attributable to the rigid body assumption"."""

    def least_velocity(beta: int) -> float:
        return penetration_threshold(
            particle_strength=results["copper-yield"],
            resistance=float(resistances(results)[beta]),
            particle_density=results["a1-density"],
        )

    means = (
        "velocity below which copper of the quoted strength does not penetrate, Eq. 5, beta = {}"
    )
    return [quantified(means.format(beta), "m/s", least_velocity, beta) for beta in BETAS]


def attempts_no_better(results: Results) -> list[Figure]:
    """Section 3: attempts with a particle that deforms "did no better"; none of them is given."""

    def apart(beta: int) -> float:
        return results[f"ratio-beta-{beta}"] - results["observed-ratio"]

    means = "X/R of the rigid model less the observed one, as printed, beta = {}"
    return [quantified(means.format(beta), "1", apart, beta) for beta in BETAS]


def frank_zook_below_observed(results: Results) -> list[Figure]:
    """Section 3: Frank and Zook's X/R is "slightly less" than that of section 2."""

    def below(compute: Callable[..., float], *arguments: Any) -> float:
        return percent_more(compute(*arguments), results["observed-depth-ratio"])

    armor, observed = "frank-zook-rha", f"over the observed {results.text('observed-depth-ratio')}"
    return [
        quantified(
            f"X/R as printed {observed}, less 1", "percent", below, results.__getitem__, armor
        ),
        quantified(
            f"X/R derived from Eqs. 14 and 15 {observed}, less 1", "percent",
            below, results.computed, armor, DERIVED,
        ),
        quantified(
            f"X/R by Eq. 16 as printed {observed}, less 1", "percent",
            below, results.computed, armor,
        ),
    ]  # fmt: skip


def strength_difference(results: Results) -> list[Figure]:
    """Section 3: the strength of stainless steel "might account for some of the difference"."""

    def share(compute: Callable[..., float], *arguments: Any) -> float:
        armor, steel = (compute(f"frank-zook-{name}", *arguments) for name in ("rha", "stainless"))
        return 100 * (steel - armor) / (results["observed-depth-ratio"] - armor)

    R_t = results.text("fz-resistance-stainless", "GPa")
    means = f"share of the distance to the observed X/R that R_t = {R_t} GPa closes, {{}}"
    return [
        quantified(means.format("as printed"), "percent", share, results.__getitem__),
        quantified(means.format("Eqs. 14 and 15"), "percent", share, results.computed, DERIVED),
        quantified(means.format("Eq. 16 as printed"), "percent", share, results.computed),
    ]


CODES = (("Autodyne", "autodyne-ratio"), ("CTH", "cth-ratio"))
"""The hydrocodes, and the claims that print their X/R."""


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


# Section 4


def same_calculation(results: Results) -> list[Figure]:
    """Section 4: Autodyne "was used for the same calculation"; its inputs over the model's."""

    def over(autodyne: str, model: str) -> float:
        return results[autodyne] / results[model]

    pairs = (
        ("flow stress of the steel", "autodyne-steel-yield", "flow-stress"),
        ("strength of the copper", "autodyne-copper-yield", "copper-yield"),
        ("diameter of the particle", "autodyne-diameter", "mean-diameter"),
    )
    return [
        quantified(f"{what}, Autodyne's over that of the model's text", "1", over, *claims)
        for what, *claims in pairs
    ]


def codes_overestimate(results: Results) -> list[Figure]:
    """Section 4: "more sophisticated codes also over-estimate the depth of penetration"."""

    def excess(claim: str) -> float:
        return percent_more(results[claim], results["observed-depth-ratio"])

    means = "{}'s X/R over the observed one, less 1"
    return [quantified(means.format(code), "percent", excess, claim) for code, claim in CODES]


def flat_surface(results: Results) -> list[Figure]:
    """Section 4: if particles hit with a flat surface, the depth "will decrease".

    A particle of the same mass whose contact has the area pi R^2 from the start stops at X/R =
    (4 rho_p/3 rho_t) ln(1 + rho_t V^2/2R_t).
    """

    def flat(beta: int) -> float:
        x = case(results, beta)
        drag = x.target_density * x.velocity**2 / (2 * x.target_resistance)
        return 4 * x.particle_density / (3 * x.target_density) * log1p(drag)

    def sphere(beta: int) -> float:
        return exact_ratio(case(results, beta))

    wide, round_ = "X/R if the contact is as wide as the sphere from the start", "exact X/R"
    return [
        *(quantified(f"{wide}, beta = {beta}", "1", flat, beta) for beta in BETAS),
        *(
            quantified(f"{round_} of the sphere, beta = {beta}", "1", sphere, beta)
            for beta in BETAS
        ),
    ]


def elastic_rebound(results: Results) -> list[Figure]:
    """Section 4: the depth of a crater "relaxes to a lower value" when the particle is removed.

    By Hertz a contact of radius a under the mean pressure R_t springs back by 3 pi a R_t/4E', where
    E' = E/(1 - nu^2). Here E' is the report's modulus E, as without contraction across, nu = 0: of
    all nu this makes it largest.
    """

    def rebound(beta: int) -> float:
        x = case(results, beta)
        depth = exact_ratio(x)
        pressure = x.target_resistance / results["elastic-modulus"]
        return 3 * pi / 4 * pressure * sqrt(2 * depth - depth**2)

    def apart(beta: int) -> float:
        return exact_ratio(case(results, beta)) - results["observed-depth-ratio"]

    back = "depth over R by which the model's crater springs back at most (Hertz, rigid particle)"
    return [
        *(quantified(f"{back}, beta = {beta}", "1", rebound, beta) for beta in BETAS),
        *(quantified(f"exact X/R less the observed one, beta = {b}", "1", apart, b) for b in BETAS),
    ]


def deeper_craters(results: Results) -> list[Figure]:
    """Section 4: smaller particles "produce deeper craters in relation to their diameters"."""

    def ratio(size: str, power: str) -> float:
        velocity = stream_velocity(results, "velocity-521", size, power)
        return exact_ratio(case(results, 5, velocity=velocity))

    return [
        quantified(
            f"exact X/R of the {which} particle of the 521-m/s data, velocity by {law}, beta = 5",
            "1", ratio, size, power,
        )
        for (which, size), (law, power) in product(EXTREMES, LAWS)
    ]  # fmt: skip


def larger_adhere(results: Results) -> list[Figure]:
    """Section 4: in a faster stream "larger particles will have sufficient velocity to adhere"."""

    def diameter(stream: str, power: str) -> float:
        faster = results[stream] / results["velocity-521"]
        size: float = results["mean-diameter"] * faster ** (1 / by_diameter(results, power))
        return size * 1e6

    streams = ("velocity-403", "velocity-606")
    return [
        quantified(
            f"largest particle that flies at 521 m/s in the stream of {results.text(stream)} m/s, "
            f"by {law}",
            "um", diameter, stream, power,
        )
        for stream, (law, power) in product(streams, LAWS)
    ]  # fmt: skip


def slower_incipient(results: Results) -> list[Figure]:
    """Section 4: in fast streams "the slower particles" are those that just stick."""
    means = "share of the stream of {} m/s slower than 521 m/s, 50 m/s taken as {} deviation"
    streams = ("velocity-606", "velocity-704")
    return [
        quantified(
            means.format(results.text(stream), kind), "percent",
            percent_of_stream, results, "velocity-521", stream, deviation,
        )
        for stream, (kind, deviation) in product(streams, DEVIATIONS)
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
        return percent_more(ratio(ends[1]), ratio(ends[0]))

    means = "exact X/R at {} m/s, beta = 5"
    shown = [quantified(means.format(results.text(end)), "1", ratio, end) for end in ends]
    return [quantified("rise of the exact X/R from 400 to 500 m/s", "percent", rise), *shown]


def too_few(results: Results) -> list[Figure]:
    """Section 4: particles of 450 m/s may have been "too few in number to be observed"."""
    means = "share faster than 450 m/s about {} m/s, 50 m/s taken as {} deviation"
    averages = ("stream-velocity-400", "velocity-403")
    return [
        quantified(
            means.format(results.text(average), kind), "percent",
            percent_of_stream, results, average, "stream-velocity-450", deviation,
        )
        for average, (kind, deviation) in product(averages, DEVIATIONS)
    ]  # fmt: skip


def faster_only(results: Results) -> list[Figure]:
    """Section 4: at 521 m/s "only faster-than-average particles were adhering"."""

    def ratio(deviations: int) -> float:
        velocity = results["velocity-521"] + deviations * results["velocity-deviation"]
        return exact_ratio(case(results, 5, velocity=velocity))

    return [
        quantified(
            "share of the stream that is faster than its average", "percent", percent_beyond, 0
        ),
        *(
            quantified(
                f"share faster by 50 m/s or more, taken as {kind} deviation",
                "percent", percent_beyond, deviations,
            )
            for kind, deviations in DEVIATIONS
        ),
        quantified("exact X/R at 521 m/s, beta = 5", "1", ratio, 0),
        quantified("exact X/R at 571 m/s, beta = 5", "1", ratio, 1),
    ]  # fmt: skip


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
    "eq1-agreement": eq1_agreement,
    "clustered-small": clustered_small,
    "regardless-of-size": regardless_of_size,
    "certainly-higher": certainly_higher,
    "surprisingly-shallow": surprisingly_shallow,
    "profile-consistent": profile_consistent,
    "larger-grain": larger_grain,
    "copper-stronger": copper_stronger,
    "particle-stronger": particle_stronger,
    "rates-far-higher": rates_far_higher,
    "strength-rises": strength_rises,
    "coarse-step-remark": coarse_step,
    "large-difference": large_difference,
    "rigid-attribution": rigid_attribution,
    "attempts-no-better": attempts_no_better,
    "frank-zook-below-observed": frank_zook_below_observed,
    "strength-difference": strength_difference,
    "closest-approach": closest_approach,
    "same-calculation": same_calculation,
    "codes-overestimate": codes_overestimate,
    "flat-surface": flat_surface,
    "elastic-rebound": elastic_rebound,
    "deeper-craters": deeper_craters,
    "larger-adhere": larger_adhere,
    "slower-incipient": slower_incipient,
    "size-effect": size_effect,
    "velocity-effect": velocity_effect,
    "too-few": too_few,
    "faster-only": faster_only,
    "velocity-distribution": velocity_distribution,
    "rising-resistance": rising_resistance,
}
"""The function that computes the figures of each remark, but for those that repeat another."""
