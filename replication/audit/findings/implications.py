"""What follows from the report's own equations and numbers, and the report does not say."""

from math import expm1, log, sqrt

from replication.audit.crosschecks import brinell_factors
from replication.audit.findings.evidence import calculated, concerning, conclude, prints
from replication.audit.findings.resistance import johnson_cook_copper, resistances
from replication.audit.inference import DENSITY
from replication.audit.record import Finding
from replication.audit.results import Results


def threshold(results: Results, R_t: float, Y_p: float) -> float:
    """Velocity [m/s] above which the particle penetrates at all, by Eq. 5 with u = 0.

    The stress rho_p v^2/2 + Y_p of the particle must exceed the target's resistance R_t [Pa];
    Y_p [Pa] is the particle's strength.
    """
    return sqrt(2 * (R_t - Y_p) / results["a1-density"])


@concerning(
    "eq5", "copper-yield", "a1-resistance", "ratio-beta-3", "ratio-beta-5", "observed-ratio"
)
def no_penetration(results: Results) -> Finding:
    """By Eq. 5, before it is reduced to a rigid particle, the copper does not penetrate at all."""
    text = results.text
    R_t = {beta: float(value) for beta, value in resistances(results).items()}
    Y_p, Y_fast, V = (
        results["copper-yield"],
        johnson_cook_copper(results),
        results["a1-initial-velocity"],
    )
    pressure = results["a1-density"] * V**2 / 2
    stress = prints(
        "stress", "1.20", pressure + Y_p, "GPa",
        f"rho_p V^2/2 + Y_p of the copper at {text('a1-initial-velocity')} m/s",
    )  # fmt: skip
    low = prints("low", "2.1", R_t[3], "GPa", "R_t for beta = 3")
    high = prints("high", "3.5", R_t[5], "GPa", "R_t for beta = 5")
    threshold_3 = prints(
        "threshold_3", "672", threshold(results, R_t[3], Y_p), "m/s",
        "velocity above which the copper penetrates, beta = 3",
    )  # fmt: skip
    threshold_5 = prints(
        "threshold_5", "875", threshold(results, R_t[5], Y_p), "m/s", "the same, beta = 5"
    )
    fast = prints(
        "fast", "536", Y_fast, "MPa",
        "Johnson-Cook flow stress of copper at strain 1 and "
        f"{results.ledger.claims['strain-rate'].text} per second",
    )  # fmt: skip
    fast_3 = prints(
        "fast_3", "593", threshold(results, R_t[3], Y_fast), "m/s",
        "velocity above which copper of that strength penetrates, beta = 3",
    )  # fmt: skip
    fast_5 = prints(
        "fast_5", "816", threshold(results, R_t[5], Y_fast), "m/s", "the same, beta = 5"
    )
    steps = (
        calculated("1.20", 8.9 * 0.5**2 / 2 + 0.09),
        calculated("672", sqrt(2 * (2.1 - 0.09) * 10**9 / 8900)),
        calculated("875", sqrt(2 * (3.5 - 0.09) * 10**9 / 8900)),
    )
    velocity = text("a1-initial-velocity")
    return conclude(
        "no-penetration",
        "method",
        title="With the strength quoted for copper, Eq. 5 lets the particle penetrate only above "
        f"{threshold_3} or {threshold_5} m/s",
        statement="Eq. 5 lets the particle deform: it penetrates (u > 0) only if its stress, "
        "rho_p v^2/2 + Y_p, exceeds the target's resistance R_t. With the yield strength that the "
        f"report quotes for copper, {text('copper-yield')} MPa, that stress is {stress} GPa at "
        f"{velocity} m/s; R_t is {low} GPa for beta = 3 and {high} GPa for beta = 5. So by Eq. 5 "
        f"the particle penetrates only above {threshold_3} or {threshold_5} m/s. With the "
        f"{fast} MPa that Johnson and Cook's law gives at strain one and 10^7 per second, far "
        f"beyond its fit, the threshold is {fast_3} or {fast_5} m/s. The report itself takes "
        "a particle stronger than R_t, as its rigid model needs. The rigid particle gives "
        f"X/R = {text('ratio-beta-3')} and {text('ratio-beta-5')}, the deforming one of Eq. 5 none "
        f"at all, and {text('observed-ratio')} is observed. This puts figures to the report's "
        '"most likely attributable to the rigid body assumption".',
        by_hand=f"8.9 * 0.5^2/2 + 0.09 = {steps[0]} GPa; (2 * (2.1 - 0.09) * 10^9/8900)^(1/2) = "
        f"{steps[1]} and (2 * (3.5 - 0.09) * 10^9/8900)^(1/2) = {steps[2]} m/s.",
        settle="The strength of a copper particle at such strain rates, and of the steel's grains.",
        status="explained",
        evidence=(stress, low, high, threshold_3, threshold_5, fast, fast_3, fast_5),
        steps=steps,
    )


@concerning("volume-ratio", "a1-resistance", "a1-density", "a1-initial-velocity")
def energy_balance(results: Results) -> Finding:
    """The observed crater takes a small part of the particle's energy."""
    text = results.text
    energy = results["a1-density"] * results["a1-initial-velocity"] ** 2 / 2
    work = {b: results["volume-ratio"] * float(R_t) for b, R_t in resistances(results).items()}
    kinetic = prints(
        "kinetic", "1.11", energy, "GPa", "kinetic energy over the particle's volume, rho_p V^2/2"
    )
    share_3 = prints(
        "share_3", "11", work[3] / energy, "percent",
        "share of it that a crater of the observed CV/PV takes at R_t, beta = 3",
    )  # fmt: skip
    share_5 = prints("share_5", "19", work[5] / energy, "percent", "the same, beta = 5")
    smallest, largest = map(float, results.ledger.claims["volume-ratio"].target().ends)
    least = prints(
        "least", "10", smallest * float(resistances(results)[3]) / energy, "percent",
        "the least share with any CV/PV that prints so, beta = 3",
    )  # fmt: skip
    most = prints(
        "most", "20", largest * float(resistances(results)[5]) / energy, "percent",
        "the greatest, beta = 5",
    )  # fmt: skip
    steps = (
        calculated("11", 100 * 0.06 * 2.1 / 1.1125),
        calculated("19", 100 * 0.06 * 3.5 / 1.1125),
    )
    ratio = text("volume-ratio")
    return conclude(
        "energy-balance",
        "method",
        title=f"A crater of CV/PV = {ratio} pressed at R_t would take {share_3} to {share_5} % of "
        f"the energy at {text('a1-initial-velocity')} m/s",
        statement=f"A particle at {text('a1-initial-velocity')} m/s has a kinetic energy of "
        f"{kinetic} GPa times its volume. A crater of CV/PV = {ratio}, pressed at the constant "
        f"resistance R_t, takes {share_3} % of that for beta = 3 and {share_5} % for beta = 5: its "
        f"volume times R_t. With any CV/PV that prints so it is {least} to {most} %. That ratio is "
        f"the smallest observed, at {text('velocity-521')} and {text('velocity-606')} m/s. Some "
        "four fifths of the energy are left; the model has no term for them (the deformation of "
        "the particle would be one).",
        by_hand=f"100 * 0.06 * 2.1/1.1125 = {steps[0]} %, 100 * 0.06 * 3.5/1.1125 = {steps[1]} %.",
        settle="Nothing is open.",
        status="explained",
        evidence=(kinetic, share_3, share_5, least, most),
        steps=steps,
    )


@concerning(
    "strength-clear", "strength-feathery", "brinell-beta", "depth-beta-5-beta", "flow-stress"
)
def hardness_again(results: Results) -> Finding:
    """Beta = 3 turns the strength from hardness back into a hardness."""
    text = results.text
    three = results.exact("brinell-beta")
    clear, feathery = (results.exact(f"strength-{grain}") for grain in ("clear", "feathery"))
    R_5 = resistances(results)[5]
    least = prints(
        "least", "2.0", three * clear, "GPa", "three times the tensile strength of clear grains"
    )
    greatest = prints(
        "greatest", "2.3", three * feathery, "GPa", "three times that of feathery grains"
    )
    of_304, of_steels = brinell_factors(results.ledger)
    factor_304 = prints(
        "factor_304", "2.39", of_304, "1", "hardness over tensile strength, a sheet of 304"
    )
    factor_steels = prints(
        "factor_steels", "2.84", max(of_steels), "1", "the same, the greatest rule for steels"
    )
    hard_least = prints("hard_least", "1.6", of_304 * clear, "GPa", "hardness of clear grains then")
    hard_greatest = prints(
        "hard_greatest", "2.2", max(of_steels) * feathery, "GPa", "of feathery grains"
    )
    taken = prints("taken", "3.5", R_5, "GPa", "R_t for beta = 5")
    above_it = prints(
        "above_it", "1.5", R_5 / (three * feathery), "1", "that over the greater hardness"
    )
    steps = (
        calculated("2.0", 3 * clear / 10**9),
        calculated("2.3", 3 * feathery / 10**9),
        calculated("1.5", 3.5 / 2.275),
    )
    return conclude(
        "hardness-again",
        "method",
        title=f"Beta = 3 gives about the hardness back, {least} to {greatest} GPa if it was "
        f"converted by three; beta = 5 is {above_it} times as much",
        statement="The strengths of the grains were converted from Knoop hardness, which for "
        f"steels is some {text('brinell-ratio')} times the tensile strength. To multiply them by "
        f"beta = {text('brinell-beta')} undoes the conversion: {text('strength-clear')} and "
        f"{text('strength-feathery')} ksi become {least} and {greatest} GPa. The report prints "
        "neither the hardness nor the factor of the conversion; by public sources it may have been "
        f"{factor_304} (304) to {factor_steels} (steels), and the hardness {hard_least} to "
        f"{hard_greatest} GPa. If a hardness is the target's resistance, as the report supposes "
        "for beta = "
        f"{text('brinell-beta')}, then R_t is known without a strength and without beta; and "
        f"{taken} GPa, for beta = {text('depth-beta-5-beta')}, is {above_it} times the greater "
        "one. Hardness is measured slowly, so at the strain rates of an impact it may be exceeded.",
        by_hand=f"3 * {text('strength-clear')} ksi = {steps[0]} GPa, 3 * "
        f"{text('strength-feathery')} ksi = {steps[1]} GPa; 3.5/2.275 = {steps[2]}.",
        settle="The Knoop hardnesses as they were measured.",
        status="explained",
        evidence=(
            least,
            greatest,
            factor_304,
            factor_steels,
            hard_least,
            hard_greatest,
            taken,
            above_it,
        ),
        steps=steps,
    )


@concerning("velocity-704", "ratio-beta-5", "depth-beta-5-beta")
def half_buried(results: Results) -> Finding:
    """At the fourth velocity of the experiments the model buries the particle by half."""
    text = results.text
    rho_p, rho_t = results["a1-density"], results[DENSITY]
    R_t = float(resistances(results)[5])
    # y = X/R = 1 at c = (4 rho_p/3 rho_t) ln(1 + rho_t V^2/2R_t) = 2/3
    at_radius = sqrt(2 * R_t / rho_t * expm1(rho_t / (2 * rho_p)))
    velocity = prints(
        "velocity", "703", at_radius, "m/s", "impact velocity at which the exact X is R, beta = 5"
    )
    p = prints("p", "0.554", expm1(rho_t / (2 * rho_p)), "1", "rho_t V^2/2R_t at which X is R")
    density = results["carbon-steel-density"]
    steps = (
        calculated("0.667", 4 * 8900 / (3 * density) * log(1.5543)),
        calculated("703", sqrt(2 * 0.5543 * 3.5e9 / density)),
    )
    rho = text("carbon-steel-density")
    return conclude(
        "half-buried",
        "method",
        title=f"For beta = 5 the model buries the sphere to its radius at {velocity} m/s, the "
        f"fourth velocity of the experiments being {text('velocity-704')}",
        statement=f"Without time steps, X/R = 1 is reached at {velocity} m/s for beta = 5: by the "
        f"model a mean particle of the fourth stream, {text('velocity-704')} m/s, is half buried. "
        'The report says of a section in its reference 1 only that it "shows a crater profile '
        'whose depth is a little over 2" um, and does not say what was seen in that stream.',
        by_hand=f"X = R needs 4 * 8900/(3 * {rho}) * ln(1 + p) = 2/3: with p = 0.5543 it is "
        f"{steps[0]}; V = (2 p R_t/rho_t)^(1/2) = (2 * 0.5543 * 3.5 * 10^9/{rho})^(1/2) = "
        f"{steps[1]} m/s ({p} rounded).",
        settle="The crater depths of that stream (reference 1 of the report).",
        status="explained",
        evidence=(velocity, p),
        steps=steps,
    )
