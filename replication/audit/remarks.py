"""What the report says in words of its results, each with the figures to judge it by.

A remark is no number, so it gets no verdict but "remark, quantified": a function of its id computes
what a reader needs to decide whether "slightly", "more pronounced" or "the same" is well said. The
first figure is the one that tells most. A remark that says again what another says has no figures
of its own. With a misprint planted in the report a figure may have no value; it is None then.
"""

from collections.abc import Callable
from fractions import Fraction
from math import erfc, isfinite, log1p, pi, sqrt
from statistics import NormalDist

from reference.ledger import Claim
from reference.printed import decimal_text
from reference.scheme import Scheme
from reference.units import to_si
from replication.audit.comparison import BETAS
from replication.audit.findings.resistance import johnson_cook_copper, resistances
from replication.audit.findings.sheet import depth_by_sheet
from replication.audit.findings.stream import GAUSSIAN
from replication.audit.particle_sizes import Law, diameter_power, velocity_by_size
from replication.audit.record import Figure
from replication.audit.results import DERIVED, Results, case, exact_ratio, of_beta
from replication.models import sheet
from replication.models.crater import contact_diameter, volume_ratio
from replication.models.estimates import penetration_threshold
from replication.models.inverse import velocity_for_depth


def figures(results: Results, claim: Claim) -> list[Figure]:
    """Return the figures for a claim of the kind "remark"; none for a claim that has none."""
    return REMARKS[claim.id](results) if claim.id in REMARKS else []


def quantified(means: str, unit: str, compute: Callable[[], float]) -> Figure:
    """Return a figure with the computed number, in the unit; None if it has no finite value."""
    try:
        value = float(compute())
    except (ArithmeticError, LookupError, ValueError):
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


EXTREMES = (("smallest", "particle-size-least"), ("largest", "particle-size-greatest"))
"""The extreme particles of Figure 1, and the claims that print their diameters."""


def velocity_in_stream(results: Results, stream: str, size: str, law: Law) -> float:
    """Velocity [m/s] of a particle of this size in a stream with this average, both by claim."""
    return velocity_by_size(results, results[stream], results[size], law)


# Section 2


def eq1_agreement(results: Results) -> list[Figure]:
    """Section 2: Eq. 1 is in "not good quantitative agreement" with experiments."""

    def deviation(law: Law) -> float:
        sizes = results["diameter-deviation"] / results["mean-diameter"]
        power = float(diameter_power(results, law))
        return power * sizes * results["a1-initial-velocity"] * GAUSSIAN

    def by_law(law: Law) -> Figure:
        means = (
            f"mean deviation at {results.text('a1-initial-velocity')} m/s by {law}, to first order "
            "in the printed sizes"
        )
        return quantified(means, "m/s", lambda: deviation(law))

    stated = "mean deviation of the velocity that section 4 states"
    return [
        *map(by_law, Law),
        quantified(stated, "m/s", lambda: results["velocity-deviation"]),
    ]


def smaller_faster(results: Results) -> list[Figure]:
    """Section 2: "the smaller particles have a higher velocity than the mean", by Eq. 1."""

    def velocity(which: str, size: str, law: Law) -> Figure:
        data = f"the {results.text('velocity-521')}-m/s data"
        return quantified(
            f"velocity of the {which} particle of {data} by {law}", "m/s",
            lambda: velocity_in_stream(results, "velocity-521", size, law),
        )  # fmt: skip

    return [velocity(which, size, law) for which, size in EXTREMES for law in Law]


def clustered_small(results: Results) -> list[Figure]:
    """Section 2: of the data points more are "clustered at the lower end of the range"."""
    ends = results.exact("particle-size-least"), results.exact("particle-size-greatest")
    middle = (ends[0] + ends[1]) / 2
    least, greatest = (results.text(f"particle-size-{end}") for end in ("least", "greatest"))

    def share(of_range: float) -> float:
        low, high = map(float, ends)
        below = NormalDist(results["mean-diameter"], results["diameter-deviation"]).cdf
        return 100 * (below(of_range) - below(low)) / (below(high) - below(low))

    return [
        quantified(
            f"share of the powder's particles of {least} to {greatest} um that are below "
            f"{decimal_text(middle / to_si('um'))} um, their sizes Gaussian as printed",
            "percent", lambda: share(float(middle)),
        ),
        quantified(
            f"the same below the mean of {results.text('mean-diameter')} um", "percent",
            lambda: share(results["mean-diameter"]),
        ),
    ]  # fmt: skip


def regardless_of_size(results: Results) -> list[Figure]:
    """Section 2: a minimum CV/PV "regardless of the particle size"; the model has one, too."""

    def crater(beta: int) -> float:
        return volume_ratio(exact_ratio(case(results, beta, velocity=results["velocity-521"])))

    def of_model(beta: int) -> Figure:
        means = (
            f"CV/PV of the model at {results.text('velocity-521')} m/s, the same for every size, "
            f"{of_beta(results, beta)}"
        )
        return quantified(means, "1", lambda: crater(beta))

    return [
        *map(of_model, BETAS),
        quantified("least CV/PV of the data", "1", lambda: results["volume-ratio-line"]),
    ]


def certainly_higher(results: Results) -> list[Figure]:
    """Section 2: as none stuck at 403 m/s, the minimum velocity "would certainly be higher"."""
    size, stream = results.text("particle-size-least"), results.text("velocity-403")

    def velocity(law: Law) -> Figure:
        return quantified(
            f"velocity of the smallest particle, {size} um, in the stream of {stream} m/s by {law}",
            "m/s", lambda: velocity_in_stream(results, "velocity-403", "particle-size-least", law),
        )  # fmt: skip

    return list(map(velocity, Law))


def surprisingly_shallow(results: Results) -> list[Figure]:
    """Section 2: a depth of 3.3 um for a particle of 22 um is "surprisingly shallow"."""

    def over_diameter() -> float:
        return 100 * results["observed-depth"] / results["observed-depth-diameter"]

    def over_model(beta: int) -> Figure:
        means = f"the observed over the printed depth of the model, {of_beta(results, beta)}"
        depth = f"depth-beta-{beta}"
        return quantified(means, "1", lambda: results["observed-depth"] / results[depth])

    return [
        quantified("observed depth over the particle's diameter", "percent", over_diameter),
        *map(over_model, BETAS),
    ]


def profile_consistent(results: Results) -> list[Figure]:
    """Section 2: a depth of 3.3 um "is consistent with" a profile a little over 2 um deep."""

    def of_mean_particle() -> float:
        return results["profile-depth"] / (results["mean-diameter"] / 2)

    def diameter() -> float:
        return 2 * results["profile-depth"] / results["observed-depth-ratio"] * 1e6

    return [
        quantified("X/R of that profile for a mean particle", "1", of_mean_particle),
        quantified("X/R observed", "1", lambda: results["observed-depth-ratio"]),
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

    third = (
        f"a particle of {results.text(diameter)} um pressed in by a "
        f"{results.text('observed-third')} of its radius"
    )
    return [
        quantified(
            "diameter of a grain around three craters side by side, over a particle's", "1",
            around_three,
        ),
        quantified(f"diameter of the crater of {third}, over the particle's", "1", crater),
    ]  # fmt: skip


def copper_stronger(results: Results) -> list[Figure]:
    """Section 3: a rigid particle needs a strength "greater than the target resistance"."""

    def resistance(beta: int) -> Figure:
        means = f"target resistance, {of_beta(results, beta)}"
        return quantified(means, "GPa", lambda: float(resistances(results)[beta]) / 1e9)

    return [
        quantified("strength quoted for copper", "GPa", lambda: results["copper-yield"] / 1e9),
        *map(resistance, BETAS),
    ]


def particle_stronger(results: Results) -> list[Figure]:
    """Section 3: a particle's strength "may be much higher" than that of bulk copper."""

    def multiple(beta: int) -> Figure:
        means = f"target resistance over the strength quoted for copper, {of_beta(results, beta)}"
        return quantified(
            means, "1", lambda: float(resistances(results)[beta]) / results["copper-yield"]
        )

    return list(map(multiple, BETAS))


def rates_far_higher(results: Results) -> list[Figure]:
    """Section 3: strain rates of the impact are "far higher" than split-Hopkinson bars reach."""
    (_, greatest) = results.ledger.sources["hopkinson-rates"].numbers

    def rate() -> float:
        return results["strain-rate-velocity"] / results["strain-rate-length"]

    return [
        quantified(
            f"strain rate of the impact over {greatest.text} per second, up to which a public "
            "source says that these bars are generally used",
            "1", lambda: rate() / float(greatest.value),
        ),
        quantified("strain rate, velocity over diameter as printed", "1/s", rate),
    ]  # fmt: skip


def strength_rises(results: Results) -> list[Figure]:
    """Section 3: copper's strength can be expected to "increase with increasing strain rate"."""
    rate, law = results.ledger.claims["strain-rate"].text, "Johnson and Cook's law for copper"

    def times() -> float:
        slow = results["copper-johnson-cook"] + results["copper-johnson-cook-hardening"]
        return johnson_cook_copper(results) / slow

    return [
        quantified(f"flow stress at {rate} over that at 1 per second by {law}", "1", times),
        quantified(
            f"flow stress at {rate} per second and strain 1 by {law}, far beyond its fit", "MPa",
            lambda: johnson_cook_copper(results) / 1e6,
        ),
    ]  # fmt: skip


def coarse_step(results: Results) -> list[Figure]:
    """Section 3: the results "did not change significantly" with a time step of 0.5 ns."""
    return [
        figure
        for beta in BETAS
        for scheme in Scheme
        for figure in _coarse_and_fine(results, beta, scheme)
    ]


def _coarse_and_fine(results: Results, beta: int, scheme: Scheme) -> list[Figure]:
    """Return the change of the final depth with a coarse time step, and both depths."""
    words = f"{of_beta(results, beta)}, drag at the {scheme.drag_at} velocity"

    def micrometers(step: str) -> float:
        return depth_by_sheet(results, beta, scheme, step) * 1e6

    def at_step(step: str) -> Figure:
        means = f"final depth at {results.text(step)} ns, {words}"
        return quantified(means, "um", lambda: micrometers(step))

    def change() -> float:
        return percent_more(micrometers("coarse-step"), micrometers("a-step"))

    return [
        quantified(f"change, {words}", "percent", change),
        at_step("a-step"),
        at_step("coarse-step"),
    ]


def large_difference(results: Results) -> list[Figure]:
    """Section 3: "there is a large difference" between the model and the observations."""

    def over_observed(beta: int) -> Figure:
        means = f"X/R of the model over the observed one, {of_beta(results, beta)}"
        ratio = f"ratio-beta-{beta}"
        return quantified(means, "1", lambda: results[ratio] / results["observed-ratio"])

    return list(map(over_observed, BETAS))


def rigid_attribution(results: Results) -> list[Figure]:
    """Section 3: the disparity is "most likely attributable to the rigid body assumption"."""

    def threshold(beta: int) -> float:
        return penetration_threshold(
            particle_strength=results["copper-yield"],
            resistance=float(resistances(results)[beta]),
            particle_density=results["a1-density"],
        )

    def least_velocity(beta: int) -> Figure:
        means = (
            "velocity below which copper of the quoted strength does not penetrate, Eq. 5, "
            f"{of_beta(results, beta)}"
        )
        return quantified(means, "m/s", lambda: threshold(beta))

    return list(map(least_velocity, BETAS))


def attempts_no_better(results: Results) -> list[Figure]:
    """Section 3: attempts with a particle that deforms "did no better"; none of them is given."""

    def apart(beta: int) -> Figure:
        means = (
            f"X/R of the rigid model less the observed one, as printed, {of_beta(results, beta)}"
        )
        ratio = f"ratio-beta-{beta}"
        return quantified(means, "1", lambda: results[ratio] - results["observed-ratio"])

    return list(map(apart, BETAS))


def frank_zook_below_observed(results: Results) -> list[Figure]:
    """Section 3: Frank and Zook's X/R is "slightly less" than that of section 2."""
    armor, observed = "frank-zook-rha", f"over the observed {results.text('observed-depth-ratio')}"

    def below(form: str, ratio: Callable[[], float]) -> Figure:
        return quantified(
            f"X/R {form} {observed}, less 1", "percent",
            lambda: percent_more(ratio(), results["observed-depth-ratio"]),
        )  # fmt: skip

    return [
        below("as printed", lambda: results[armor]),
        below("derived from Eqs. 14 and 15", lambda: results.computed(armor, DERIVED)),
        below("by Eq. 16 as printed", lambda: results.computed(armor)),
    ]


def strength_difference(results: Results) -> list[Figure]:
    """Section 3: the strength of stainless steel "might account for some of the difference"."""
    R_t = results.text("fz-resistance-stainless", "GPa")

    def share(form: str, ratio: Callable[[str], float]) -> Figure:
        def percent() -> float:
            armor, steel = ratio("frank-zook-rha"), ratio("frank-zook-stainless")
            return 100 * (steel - armor) / (results["observed-depth-ratio"] - armor)

        means = f"share of the distance to the observed X/R that R_t = {R_t} GPa closes, {form}"
        return quantified(means, "percent", percent)

    return [
        share("as printed", lambda claim: results[claim]),
        share("Eqs. 14 and 15", lambda claim: results.computed(claim, DERIVED)),
        share("Eq. 16 as printed", lambda claim: results.computed(claim)),
    ]


def closest_approach(results: Results) -> list[Figure]:
    """Section 3: Frank and Zook's "comes closer" to the data "than the other approaches tested"."""

    def apart(approach: str, ratio: Callable[[], float]) -> Figure:
        return quantified(
            f"X/R less the observed one, {approach}", "1",
            lambda: ratio() - results["observed-depth-ratio"],
        )  # fmt: skip

    def by_frank_zook(target: str, claim: str) -> list[Figure]:
        return [
            apart(f"Frank and Zook, {target}, printed", lambda: results[claim]),
            apart(f"Frank and Zook, {target}, Eq. 16", lambda: results.computed(claim)),
            apart(
                f"Frank and Zook, {target}, Eqs. 14 and 15",
                lambda: results.computed(claim, DERIVED),
            ),
        ]

    def by_model(beta: int) -> Figure:
        approach = f"model, {of_beta(results, beta)}, exact"
        return apart(approach, lambda: exact_ratio(case(results, beta)))

    return [
        *by_frank_zook("armor", "frank-zook-rha"),
        *by_frank_zook("stainless steel", "frank-zook-stainless"),
        *map(by_model, BETAS),
        apart("Autodyne", lambda: results["autodyne-ratio"]),
        apart("CTH", lambda: results["cth-ratio"]),
    ]


# Section 4


def same_calculation(results: Results) -> list[Figure]:
    """Section 4: Autodyne "was used for the same calculation"; its inputs over the model's."""

    def over(what: str, autodyne: str, model: str) -> Figure:
        means = f"{what}, Autodyne's over that of the model's text"
        return quantified(means, "1", lambda: results[autodyne] / results[model])

    return [
        over("flow stress of the steel", "autodyne-steel-yield", "flow-stress"),
        over("strength of the copper", "autodyne-copper-yield", "copper-yield"),
        over("diameter of the particle", "autodyne-diameter", "mean-diameter"),
    ]


def codes_overestimate(results: Results) -> list[Figure]:
    """Section 4: "more sophisticated codes also over-estimate the depth of penetration"."""

    def excess(code: str, claim: str) -> Figure:
        return quantified(
            f"{code}'s X/R over the observed one, less 1", "percent",
            lambda: percent_more(results[claim], results["observed-depth-ratio"]),
        )  # fmt: skip

    return [excess("Autodyne", "autodyne-ratio"), excess("CTH", "cth-ratio")]


def flat_surface(results: Results) -> list[Figure]:
    """Section 4: if particles hit with a flat surface, the depth "will decrease".

    A particle of the same mass whose contact has the area pi R^2 from the start stops at X/R =
    (4 rho_p/3 rho_t) ln(1 + rho_t V^2/2R_t).
    """

    def flat_ratio(beta: int) -> float:
        x = case(results, beta)
        drag = x.target_density * x.velocity**2 / (2 * x.target_resistance)
        return 4 * x.particle_density / (3 * x.target_density) * log1p(drag)

    def flat(beta: int) -> Figure:
        means = "X/R if the contact is as wide as the sphere from the start"
        return quantified(f"{means}, {of_beta(results, beta)}", "1", lambda: flat_ratio(beta))

    def sphere(beta: int) -> Figure:
        means = f"exact X/R of the sphere, {of_beta(results, beta)}"
        return quantified(means, "1", lambda: exact_ratio(case(results, beta)))

    return [*map(flat, BETAS), *map(sphere, BETAS)]


def elastic_rebound(results: Results) -> list[Figure]:
    """Section 4: the depth of a crater "relaxes to a lower value" when the particle is removed.

    By Hertz a contact of radius a under the mean pressure R_t springs back by 3 pi a R_t/4E', where
    E' = E/(1 - nu^2). Here E' is the report's modulus E, as without contraction across, nu = 0: of
    all nu this makes it largest.
    """

    def back(beta: int) -> float:
        x = case(results, beta)
        depth = exact_ratio(x)
        pressure = x.target_resistance / results["elastic-modulus"]
        return 3 * pi / 4 * pressure * sqrt(2 * depth - depth**2)

    def rebound(beta: int) -> Figure:
        means = (
            "depth over R by which the model's crater springs back at most (Hertz, rigid "
            f"particle), {of_beta(results, beta)}"
        )
        return quantified(means, "1", lambda: back(beta))

    def apart(beta: int) -> Figure:
        return quantified(
            f"exact X/R less the observed one, {of_beta(results, beta)}", "1",
            lambda: exact_ratio(case(results, beta)) - results["observed-depth-ratio"],
        )  # fmt: skip

    return [*map(rebound, BETAS), *map(apart, BETAS)]


def deeper_craters(results: Results) -> list[Figure]:
    """Section 4: smaller particles "produce deeper craters in relation to their diameters"."""

    def ratio(size: str, law: Law) -> float:
        velocity = velocity_in_stream(results, "velocity-521", size, law)
        return exact_ratio(case(results, 5, velocity=velocity))

    def crater(which: str, size: str, law: Law) -> Figure:
        means = (
            f"exact X/R of the {which} particle of the {results.text('velocity-521')}-m/s data, "
            f"velocity by {law}, {of_beta(results, 5)}"
        )
        return quantified(means, "1", lambda: ratio(size, law))

    return [crater(which, size, law) for which, size in EXTREMES for law in Law]


def larger_adhere(results: Results) -> list[Figure]:
    """Section 4: in a faster stream "larger particles will have sufficient velocity to adhere"."""

    def diameter(stream: str, law: Law) -> float:
        faster = results[stream] / results["velocity-521"]
        size: float = results["mean-diameter"] * faster ** float(1 / diameter_power(results, law))
        return size * 1e6

    def largest(stream: str, law: Law) -> Figure:
        means = (
            f"largest particle that flies at {results.text('velocity-521')} m/s in the stream of "
            f"{results.text(stream)} m/s, by {law}"
        )
        return quantified(means, "um", lambda: diameter(stream, law))

    return [largest(stream, law) for stream in ("velocity-403", "velocity-606") for law in Law]


def slower_incipient(results: Results) -> list[Figure]:
    """Section 4: in fast streams "the slower particles" are those that just stick."""

    def share(stream: str, kind: str, deviation: float) -> Figure:
        means = (
            f"share of the stream of {results.text(stream)} m/s slower than "
            f"{results.text('velocity-521')} m/s, {results.text('velocity-deviation')} m/s taken "
            f"as {kind} deviation"
        )
        return quantified(
            means, "percent", lambda: percent_of_stream(results, "velocity-521", stream, deviation)
        )

    streams = ("velocity-606", "velocity-704")
    return [share(stream, kind, factor) for stream in streams for kind, factor in DEVIATIONS]


def size_effect(results: Results) -> list[Figure]:
    """Section 4: "the value of X/R for different size particles was the same"."""
    beta = of_beta(results, 5)

    def ratio(size: str) -> float:
        return sheet.run(case(results, 5, radius=results[size] / 2)).normalized_depth

    def in_sheet(size: str) -> Figure:
        means = f"X/R of the sheet, {beta}, particles of {results.text(size)} um"
        return quantified(means, "1", lambda: ratio(size))

    any_size = f"exact X/R, {beta}, for every size: R cancels from Eqs. 12 and 13"
    return [
        in_sheet("particle-size-least"),
        in_sheet("mean-diameter"),
        in_sheet("particle-size-greatest"),
        quantified(any_size, "1", lambda: exact_ratio(case(results, 5))),
    ]


def velocity_effect(results: Results) -> list[Figure]:
    """Section 4: the "effect of particle velocity on X/R is more pronounced"."""
    least, greatest = "figure-5-velocity-least", "figure-5-velocity-greatest"

    def ratio(velocity: str) -> float:
        return exact_ratio(case(results, 5, velocity=results[velocity]))

    def at_velocity(velocity: str) -> Figure:
        means = f"exact X/R at {results.text(velocity)} m/s, {of_beta(results, 5)}"
        return quantified(means, "1", lambda: ratio(velocity))

    return [
        quantified(
            f"rise of the exact X/R from {results.text(least)} to {results.text(greatest)} m/s",
            "percent", lambda: percent_more(ratio(greatest), ratio(least)),
        ),
        at_velocity(least),
        at_velocity(greatest),
    ]  # fmt: skip


def too_few(results: Results) -> list[Figure]:
    """Section 4: particles of 450 m/s may have been "too few in number to be observed"."""
    fast = "stream-velocity-450"

    def share(average: str, kind: str, deviation: float) -> Figure:
        means = (
            f"share faster than {results.text(fast)} m/s about {results.text(average)} m/s, "
            f"{results.text('velocity-deviation')} m/s taken as {kind} deviation"
        )
        return quantified(
            means, "percent", lambda: percent_of_stream(results, average, fast, deviation)
        )

    averages = ("stream-velocity-400", "velocity-403")
    return [share(average, kind, factor) for average in averages for kind, factor in DEVIATIONS]


def faster_only(results: Results) -> list[Figure]:
    """Section 4: at 521 m/s "only faster-than-average particles were adhering"."""
    average = results.exact("velocity-521")

    def faster(kind: str, deviation: float) -> Figure:
        means = (
            f"share faster by {results.text('velocity-deviation')} m/s or more, taken as {kind} "
            "deviation"
        )
        return quantified(means, "percent", lambda: percent_beyond(deviation))

    def ratio(velocity: Fraction) -> Figure:
        return quantified(
            f"exact X/R at {decimal_text(velocity)} m/s, {of_beta(results, 5)}", "1",
            lambda: exact_ratio(case(results, 5, velocity=float(velocity))),
        )  # fmt: skip

    return [
        quantified(
            "share of the stream that is faster than its average", "percent",
            lambda: percent_beyond(0),
        ),
        *(faster(kind, deviation) for kind, deviation in DEVIATIONS),
        ratio(average),
        ratio(average + results.exact("velocity-deviation")),
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
        quantified(
            f"velocity at which the exact X/R is {results.text('observed-ratio')}, "
            f"{of_beta(results, 5)}",
            "m/s", needed,
        ),
        quantified(
            f"its distance from the average of {results.text('velocity-521')} m/s in stated "
            "deviations",
            "1", deviations,
        ),
    ]  # fmt: skip


def rising_resistance(results: Results) -> list[Figure]:
    """Section 4: a target resistance that grows with the strain rate lowers the depth."""

    def ratio(times: int) -> float:
        impact = case(results, 5)
        return exact_ratio(case(results, 5, resistance=times * impact.target_resistance))

    return [
        quantified(f"exact X/R, {of_beta(results, 5)}", "1", lambda: ratio(1)),
        quantified("exact X/R at twice that resistance", "1", lambda: ratio(2)),
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
