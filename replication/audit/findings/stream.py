"""Findings on the particle stream: sizes, velocities, and what was observed (sections 2 and 4)."""

from math import pi, sqrt
from statistics import NormalDist, fmean

from replication.audit.findings.evidence import (
    at_least,
    at_most,
    calculated,
    concerning,
    conclude,
    equals,
    prints,
)
from replication.audit.particle_sizes import Law, diameter_power, velocity_by_size
from replication.audit.record import Finding
from replication.audit.results import Results, case, exact_ratio
from replication.models.crater import normalized_depth_from_volume_ratio, volume_ratio

GAUSSIAN = sqrt(2 / pi)
"""The mean deviation of a normal distribution over its standard deviation."""


@concerning(
    "volume-ratio-line", "similar-data-ratio", "velocity-521", "velocity-606", "a1-initial-velocity"
)
def compared_velocity(results: Results) -> Finding:
    """The model was run at another velocity than the data have."""
    text = results.text
    ratios = {
        name: exact_ratio(case(results, 5, velocity=results[name]))
        for name in ("velocity-521", "velocity-606", "velocity-403")
    }
    first = prints(
        "first", "0.728", ratios["velocity-521"], "1",
        f"exact X/R at {text('velocity-521')} m/s, beta = 5",
    )  # fmt: skip
    second = prints(
        "second", "0.854", ratios["velocity-606"], "1",
        f"exact X/R at {text('velocity-606')} m/s, beta = 5",
    )  # fmt: skip
    least = prints(
        "least", "0.557", ratios["velocity-403"], "1",
        f"exact X/R at {text('velocity-403')} m/s, beta = 5",
    )  # fmt: skip
    y_5, y_3 = results.exact("ratio-beta-5"), results.exact("ratio-beta-3")
    volume_high = prints(
        "volume_high", "0.28", y_5**2 * (3 - y_5) / 4, "1", "CV/PV at the printed X/R for beta = 5"
    )
    volume_low = prints(
        "volume_low", "0.43", y_3**2 * (3 - y_3) / 4, "1", "CV/PV at the printed X/R for beta = 3"
    )
    step = calculated("0.28", y_5**2 * (3 - y_5) / 4)
    V, y = text("a1-initial-velocity"), text("ratio-beta-5")
    return conclude(
        "compared-velocity",
        "method",
        title=f"The observed ratio is a minimum at {text('velocity-521')} and "
        f"{text('velocity-606')} m/s, the computed one that of a mean particle at {V} m/s",
        statement=f"CV/PV of {text('volume-ratio-line')} was read at an average of "
        f"{text('velocity-521')} m/s, and {text('similar-data-ratio')} is a bound for the data at "
        f"{text('velocity-606')} m/s; both lie below all particles but one of their data. The "
        f"model was run for the mean particle at {V} m/s. At {text('velocity-521')} and "
        f"{text('velocity-606')} m/s the exact X/R for beta = 5 is {first} and {second}. Even at "
        f"{text('velocity-403')} m/s, where no particle stuck, it is {least}, above any X/R that "
        f"prints {text('observed-ratio')}. So the disagreement does not come from the choice of "
        f"{V} m/s; how the model compares with the mean crater is open: the text gives only the "
        f"smallest; the others are in Figure 1. The model's X/R of {y} and {text('ratio-beta-3')} "
        f"would be CV/PV = {volume_high} and {volume_low}.",
        by_hand=f"CV/PV = y^2 (3 - y)/4 at y = {y} is {y}^2 * (3 - {y})/4 = {step}.",
        settle="The velocities of the single particles.",
        status="explained",
        evidence=(first, second, least, volume_high, volume_low),
        steps=(step,),
    )  # fmt: skip


def mean_deviation_by_drag(results: Results) -> float:
    """Return the mean |(d/d_0)^(-1/2) - 1| V [m/s] for normal d > 0, by the midpoint rule."""
    normal = NormalDist(1.0, results["diameter-deviation"] / results["mean-diameter"])
    sizes = [(k + 0.5) / 10_000 for k in range(20_000)]
    mean = fmean((abs(d**-0.5 - 1) for d in sizes), weights=map(normal.pdf, sizes))
    return mean * results["a1-initial-velocity"]


@concerning(
    "eq1",
    "eq1-power",
    "mean-diameter",
    "diameter-deviation",
    "velocity-deviation",
    "particle-size-least",
    "particle-size-greatest",
)
def equation_1_scatter(results: Results) -> Finding:
    """Eq. 1 has the particle's mass, but not its area."""
    text, exact = results.text, results.exact
    V, spread = exact("a1-initial-velocity"), exact("diameter-deviation") / exact("mean-diameter")
    by_mass, by_drag = diameter_power(results, Law.EQ_1), diameter_power(results, Law.DRAG)
    smallest, largest = (
        velocity_by_size(results, results["figure-1-velocity"], results[size], Law.EQ_1)
        for size in ("particle-size-least", "particle-size-greatest")
    )
    mass_ratio = 1 + 3 * spread**2
    power = equals("power", "1.5", by_mass, "1", "power of the diameter in Eq. 1, turned")
    drag_power = equals("drag_power", "0.5", by_drag, "1", "the same by drag on a sphere")
    eq1_standard = prints(
        "eq1_standard", "191", by_mass * spread * V, "m/s",
        "standard deviation of V by Eq. 1, to first order",
    )  # fmt: skip
    eq1_mean = prints(
        "eq1_mean", "152", GAUSSIAN * (by_mass * spread * V), "m/s", "the same as a mean deviation"
    )
    drag_standard = prints(
        "drag_standard", "63.6", by_drag * spread * V, "m/s",
        "standard deviation of V by drag on a sphere, to first order",
    )  # fmt: skip
    drag_mean = prints(
        "drag_mean", "50.8", GAUSSIAN * (by_drag * spread * V), "m/s",
        "the same as a mean deviation",
    )  # fmt: skip
    gaussian = prints(
        "gaussian", "0.798", GAUSSIAN, "1",
        "mean deviation of a Gaussian over its standard deviation",
    )  # fmt: skip
    drag_exact = prints(
        "drag_exact", "56", mean_deviation_by_drag(results), "m/s",
        "mean deviation by the same law, not linearized",
    )  # fmt: skip
    fast = prints("fast", "1700", smallest, "m/s", "velocity of the smallest particle by Eq. 1")
    mean_mass = prints(
        "mean_mass", "1.194", mass_ratio, "1",
        "mean mass of Gaussian sizes over the mass of the mean diameter",
    )  # fmt: skip
    fast_mean = prints(
        "fast_mean", "1858", smallest * sqrt(mass_ratio), "m/s",
        "velocity of the smallest particle by Eq. 1 with that mean mass",
    )  # fmt: skip
    slow_mean = prints(
        "slow_mean", "358", largest * sqrt(mass_ratio), "m/s",
        "velocity of the largest particle by Eq. 1 with that mean mass",
    )  # fmt: skip
    slow = prints("slow", "327", largest, "m/s", "velocity of the largest particle by Eq. 1")
    steps = (calculated("63.6", by_drag * spread * V), calculated("51", 0.798 * 63.6))
    velocity, deviation = text("a1-initial-velocity"), text("velocity-deviation")
    return conclude(
        "equation-1-scatter",
        "formula",
        title="Eq. 1 leaves out the particle's area; with it, sizes alone give about the stated "
        "scatter of slow particles",
        statement="The report says itself that Eq. 1 does not agree well with experiments on "
        "copper and aluminum. One reason: a constant drag coefficient gives a sphere that is much "
        "slower than the gas v in proportion to (area/mass)^(1/2), so to the diameter to the power "
        f"-{drag_power}; nearer to the gas's speed the size matters less. Eq. 1 has the mass "
        f"alone: the diameter to the power -{power}. To first order the printed sizes, "
        f"{text('mean-diameter')} and {text('diameter-deviation')} um, then scatter the velocity "
        f"at {velocity} m/s by {drag_standard} m/s, a mean deviation of {drag_mean} m/s: the "
        f"report's \"about a {deviation}-m/s mean deviation\". By Eq. 1 these are {eq1_standard} "
        f"and {eq1_mean} m/s, and the ends of the data, {text('particle-size-least')} and "
        f"{text('particle-size-greatest')} um, would fly at {fast} and {slow} m/s in a stream of "
        f"{text('velocity-521')} m/s, if m_o is the mass of the mean diameter; with the mean mass "
        f"of Gaussian sizes, {fast_mean} and {slow_mean}. That {deviation} was computed so is an "
        "inference: it may have been measured, the speed of the gas is not known, and the law "
        f"without linearization gives a mean deviation of {drag_exact} m/s from {velocity}.",
        by_hand=f"0.5 * {text('diameter-deviation')}/{text('mean-diameter')} * {velocity} = "
        f"{steps[0]}; the mean deviation of a Gaussian is {gaussian} of its standard deviation: "
        f"{gaussian} * 63.6 = {steps[1]}.",
        settle="Where the deviation was taken from; measured velocities against size (reference 6 "
        "of the report).",
        status="open",
        evidence=(
            power, drag_power, eq1_standard, eq1_mean, drag_standard, drag_mean, gaussian,
            drag_exact, fast, mean_mass, fast_mean, slow_mean, slow,
        ),
        steps=steps,
    )  # fmt: skip


@concerning("velocity-deviation", "stream-velocity-400", "stream-velocity-450", "velocity-403")
def faster_particles(results: Results) -> Finding:
    """How many particles of the slow stream are as fast as those that stick."""
    text, exact = results.text, results.exact
    fast, deviation = exact("stream-velocity-450"), exact("velocity-deviation")
    from_403 = (fast - exact("velocity-403")) / deviation
    from_400 = (fast - exact("stream-velocity-400")) / deviation
    beyond = NormalDist().cdf
    standard = prints(
        "standard", "17", beyond(float(-from_403)), "percent",
        "share of faster particles, taken as standard deviation",
    )  # fmt: skip
    mean = prints(
        "mean", "23", beyond(-from_403 * GAUSSIAN), "percent",
        "share of faster particles, taken as mean deviation",
    )  # fmt: skip
    standard_400 = prints(
        "standard_400", "16", beyond(float(-from_400)), "percent",
        f"the same share about {text('stream-velocity-400')} m/s",
    )  # fmt: skip
    mean_400 = prints(
        "mean_400", "21", beyond(-from_400 * GAUSSIAN), "percent",
        f"the same about {text('stream-velocity-400')} m/s, taken as mean deviation",
    )  # fmt: skip
    ratio = prints("ratio", "0.94", from_403, "1", "distance in deviations")
    ratio_400 = equals(
        "ratio_400", "1", from_400, "1", f"the same from {text('stream-velocity-400')} m/s"
    )
    step = calculated("0.94", from_403)
    v_400, v_403, v_450 = (
        text(name) for name in ("stream-velocity-400", "velocity-403", "stream-velocity-450")
    )
    spread = text("velocity-deviation")
    return conclude(
        "faster-particles",
        "method",
        title=f"With the stated scatter {standard_400} to {mean} % of the {v_400}-m/s stream is "
        f"faster than {v_450} m/s",
        statement="Section 4 gives the velocities as Gaussian with a deviation of about "
        f"{spread} m/s and says of the stream of {v_400} m/s that particles of {v_450} m/s \"did "
        "not adhere or were too few in number to be observed\". With that distribution, "
        f"{standard_400} % about {v_400} m/s and {standard} % about the average of {v_403} m/s fly "
        f"faster than {v_450} m/s if {spread} m/s is the standard deviation, {mean_400} and {mean} "
        "% if it is the mean deviation. Unless that is too few to be observed, such particles did "
        "not adhere.",
        by_hand=f"({v_450} - {v_403})/{spread} = {step} standard deviations; a table of the normal "
        "distribution gives the share beyond.",
        settle="Nothing is open.",
        status="explained",
        evidence=(standard, mean, standard_400, mean_400, ratio, ratio_400),
        steps=(step,),
    )  # fmt: skip


@concerning(
    "observed-depth-ratio", "observed-depth", "volume-ratio", "volume-ratio-line", "profile-depth"
)
def observed_digits(results: Results) -> Finding:
    """The observed X/R is printed with more digits than the ratio of volumes has."""
    text, exact = results.text, results.exact
    ends = results.ledger.claims["volume-ratio"].target().ends
    line_ratio = normalized_depth_from_volume_ratio(results["volume-ratio-line"])
    profile_ratio = results["profile-depth"] / (results["mean-diameter"] / 2)
    line = prints("line", "0.293", line_ratio, "1", "X/R from the line of Figure 1")
    line_depth = prints(
        "line_depth", "3.2", line_ratio * (results["observed-depth-diameter"] / 2), "um",
        "depth from the line of Figure 1",
    )  # fmt: skip
    least = at_least(
        "least", "0.284", normalized_depth_from_volume_ratio(float(ends[0])), "1",
        "least X/R of a CV/PV that prints so",
    )  # fmt: skip
    greatest = at_most(
        "greatest", "0.311", normalized_depth_from_volume_ratio(float(ends[1])), "1",
        "greatest X/R of a CV/PV that prints so",
    )  # fmt: skip
    profile = prints(
        "profile", "0.18", profile_ratio, "1", "X/R of the profile for the mean particle"
    )
    profile_volume = prints(
        "profile_volume", "0.023", volume_ratio(profile_ratio), "1", "CV/PV of that depth"
    )
    y = exact("observed-depth-ratio")
    steps = (
        calculated("0.0600", y**2 * (3 - y) / 4),
        calculated("0.0580", 0.2927**2 * (3 - 0.2927) / 4),
    )
    ratio, printed = text("volume-ratio"), text("observed-depth-ratio")
    return conclude(
        "observed-digits",
        "rounding",
        title=f"X/R = {printed} keeps three digits of a CV/PV that has one",
        statement=f"Eq. 4 solves Eqs. 2 and 3 for CV/PV = {ratio} and prints {printed}, which is "
        f"right for {ratio} exactly. But {ratio} is one digit, and Figure 1, to which the report "
        f"refers there, has its line at {text('volume-ratio-line')}. With that X/R is {line} and "
        f"the depth of a {text('mean-diameter')}-um particle {line_depth} um, not "
        f"{text('observed-depth')}; with any CV/PV that prints {ratio} X/R is between {least} and "
        f"{greatest}. The later \"{text('general-ratio')}\" claims no more than that. The crater "
        f"profile \"a little over {text('profile-depth')} um\" deep, called consistent, would be "
        f"X/R above {profile} and CV/PV above {profile_volume} for the mean particle; the size of "
        "its own is not given.",
        by_hand=f"X/R = y solves y^2 (3 - y)/4 = CV/PV: {printed}^2 * (3 - {printed})/4 = "
        f"{steps[0]}; 0.2927^2 * (3 - 0.2927)/4 = {steps[1]}.",
        settle="CV/PV of the line to more digits.",
        status="explained",
        evidence=(line, line_depth, least, greatest, profile, profile_volume),
        steps=steps,
    )  # fmt: skip
