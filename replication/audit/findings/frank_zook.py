"""Findings on section 3's comparison with the model of Frank and Zook (Eqs. 14 to 17)."""

from fractions import Fraction
from math import cbrt, log, log1p

from reference.arithmetic import Arithmetic, Floats, Number
from reference.enclosure import enclose
from reference.ledger import Convention
from replication.audit.assessment import Verdict
from replication.audit.findings.evidence import (
    above,
    at_least,
    at_most,
    calculated,
    concerning,
    conclude,
    equals,
    prints,
    proves,
)
from replication.audit.inference import DENSITY
from replication.audit.record import Finding
from replication.audit.results import DERIVED, Results, case, density_taken, exact_ratio

RISE = {
    "k_t": "fz-kt",
    "rho_t": DENSITY,
    "V": "a1-initial-velocity",
    "R_t": "fz-resistance-rha",
    "R_low": "fz-resistance-stainless",
}
"""The entries that give the inputs of `rise`."""


def rise(
    ar: Arithmetic, k_t: Number, rho_t: Number, V: Number, R_t: Number, R_low: Number
) -> Number:
    """(X/R at R_low)/(X/R at R_t) - 1 [1] by Eq. 16: what multiplies its logarithm cancels.

    k_t [1], rho_t [kg/m^3], V [m/s], R_t and R_low [Pa]. Over intervals it is a proof.
    """
    z = k_t * rho_t * V * V
    return ar.log(1 + z / R_low) / ar.log(1 + z / R_t) - 1


def least_rise(results: Results, convention: Convention) -> Fraction:
    """Return the proven least `rise` over all inputs that print like the report's."""
    box = {name: results.judge.rounded(entry, convention).ends for name, entry in RISE.items()}
    return enclose(rise, box).ends[0]


def drag(results: Results) -> Fraction:
    """k_t rho_t V^2 [Pa], the drag in Eq. 16's logarithm, at the inputs as printed."""
    return (
        results.exact("fz-kt") * results.exact(DENSITY) * results.exact("a1-initial-velocity") ** 2
    )


def inertia(results: Results, length_ratio: str = "sphere-length-ratio") -> Fraction:
    """L/D rho_p/rho_t + k_1 [1] of Eq. 16 at the inputs as printed; the claim gives L/D."""
    densities = results.exact("a1-density") / results.exact(DENSITY)
    return results.exact(length_ratio) * densities + results.exact("fz-k1")


def derived_ratio(
    results: Results, R_t: Fraction, length_ratio: str = "sphere-length-ratio"
) -> float:
    """X/R [1] from Eqs. 14 and 15 at the target resistance R_t [Pa]."""
    return float(inertia(results, length_ratio) / results.exact("fz-kt")) * log1p(
        drag(results) / R_t
    )


def common_velocity(results: Results) -> float:
    """Return the velocity [m/s] up to which Eq. 16 raises X/R by more than the print allows.

    The rise is the least for the greatest k_t and for the two R_t closest together, and it falls
    as the velocity grows: so it holds below this velocity.
    """
    rounded = Convention(choices_exact=False)
    k_t = results.judge.rounded("fz-kt", rounded).ends[1]
    R_t = results.judge.rounded("fz-resistance-rha", rounded).ends[0]
    R_low = results.judge.rounded("fz-resistance-stainless", rounded).ends[1]
    least, greatest, floats = Fraction(100), Fraction(10**5), Floats()
    for _ in range(50):  # to 1e-10 m/s
        middle = (least + greatest) / 2
        values = [float(value) for value in (k_t, results.exact(DENSITY), middle, R_t, R_low)]
        if rise(floats, *values) > greatest_rise(results):
            least = middle
        else:
            greatest = middle
    return float(least)


def greatest_rise(results: Results) -> Fraction:
    """Return the greatest ratio of two X/R that print like the two of section 3, less one."""
    armor, steel = (results.ledger.claims[f"frank-zook-{name}"] for name in ("rha", "stainless"))
    return steel.target().ends[1] / armor.target().ends[0] - 1


RESULTS = ("depth-beta-3", "depth-beta-5", "ratio-beta-3", "ratio-beta-5")
"""The final depths of the report's model, and their X/R."""


def derived_over_printed(results: Results) -> Fraction:
    """Return the derived over the printed right side of Eq. 16; 0 if that is not one number."""
    factor = results.judge.assess_equation("eq16").factor
    return Fraction(0) if factor is None else 1 / factor


@concerning("frank-zook-rha", "frank-zook-stainless", "eq16")
def headline(results: Results) -> Finding:
    """The sentence with which files begin and the text on a terminal ends."""
    factor = equals(
        "factor",
        "2",
        derived_over_printed(results),
        "1",
        "derived right side of Eq. 16 over the printed one",
    )
    apart = least_rise(results, Convention(choices_exact=False)) - greatest_rise(results)
    evidence = (
        proves(
            "model",
            {*results.verdicts("a1-"), *map(results.verdict, RESULTS)} == {Verdict.REPRODUCED},
            "Table A-1, both final depths and their X/R are reproduced",
        ),
        proves(
            "pair",
            results.verdicts("frank-zook-") == {Verdict.NOT_REPRODUCED},
            "neither Frank-Zook value follows from Eq. 16 as printed",
        ),
        above(
            "apart", "0", apart, "1",
            "least ratio of the two values by Eq. 16, proven, minus the greatest ratio of two "
            "numbers that print as these",
        ),
        factor,
    )  # fmt: skip
    return conclude(
        "headline",
        "headline",
        title="What the audit found",
        statement="With a target density inferred from eight cells of Table A-1, and the sphere's "
        "mass in place of the printed one, the model's own numbers reproduce to the last printed "
        "digit; the two Frank-Zook values do not and, if computed at one velocity and with one "
        "pair of densities, cannot both be right; "
        f"Eq. 16 as printed is too small by a factor of {factor}.",
        status="explained",
        evidence=evidence,
    )


@concerning(
    "frank-zook-rha", "frank-zook-stainless", "fz-resistance-rha", "fz-resistance-stainless"
)
def frank_zook_pair(results: Results) -> Finding:
    """Section 3 changes only R_t between its two X/R, but R_t alone moves them further apart."""
    text, exact = results.text, results.exact
    armor, steel = text("frank-zook-rha"), text("frank-zook-stainless")
    R_t, R_low = exact("fz-resistance-rha"), exact("fz-resistance-stainless")
    falls = prints(
        "falls", "16.8", 1 - R_low / R_t, "percent",
        "by how much R_t falls from the one value to the other",
    )  # fmt: skip
    least = at_least(
        "least", "17.7", least_rise(results, Convention()), "percent",
        "proven least rise of X/R, the R_t tried for stainless steel exact",
    )  # fmt: skip
    least_rounded = at_least(
        "least_rounded", "16.9", least_rise(results, Convention(choices_exact=False)), "percent",
        "proven least rise of X/R, all inputs rounded",
    )  # fmt: skip
    nominal = prints(
        "nominal", "17.9", log1p(drag(results) / R_low) / log1p(drag(results) / R_t) - 1, "percent",
        "rise of X/R at the inputs as printed",
    )  # fmt: skip
    printed = prints(
        "printed", "6.8", exact("frank-zook-stainless") / exact("frank-zook-rha") - 1, "percent",
        "rise of X/R as printed",
    )  # fmt: skip
    most = at_most(
        "most",
        "7.21",
        greatest_rise(results),
        "percent",
        "greatest rise of two numbers that print so",
    )
    z = prints(
        "z", "2.053", drag(results), "GPa",
        f"k_t rho_t V^2 at the inputs as printed and {density_taken(results)}",
    )  # fmt: skip
    limit = at_least(
        "limit", "2975", common_velocity(results), "m/s",
        f"velocity below which this holds, both R_t and k_t rounded, {density_taken(results)}",
    )  # fmt: skip
    density = equals("density", "7850", exact(DENSITY), "kg/m^3", "target density taken there")
    ratio = calculated("1.179", log1p(2.053 / (R_low / 10**9)) / log1p(2.053 / (R_t / 10**9)))
    greatest = calculated("1.072", 0.2975 / 0.2775)
    return conclude(
        "frank-zook-pair",
        "inconsistent pair",
        title=f"{armor} and {steel} cannot both follow from the printed inputs",
        statement="Between the two values the report changes only R_t, which falls by "
        f"{falls} %. By Eq. 16 X/R must then rise by at least {least} %; as printed it rises by "
        f"{printed} %, with rounding by {most} % at most. Whatever multiplies the logarithm "
        "cancels from the ratio: L/D, k_1, any constant factor, and whether X is divided by R or "
        "by D. This holds for all inputs that print like the report's; if "
        f"{text('fz-resistance-stainless')} Pa is itself rounded, X/R must still rise by "
        f"{least_rounded} %. The velocity need not be the printed one: for any velocity below "
        f"{limit} m/s, at {density} kg/m^3 and with both resistances rounded, X/R must rise by "
        "more than the printed numbers can. So, if they were computed at one velocity and with one "
        "pair of densities, at least one of the two numbers is misprinted, miscalculated, or "
        "comes from other inputs than those printed.",
        by_hand=f"With z = k_t rho_t V^2 = {z} GPa the ratio is ln(1 + "
        f"{z}/{text('fz-resistance-stainless', 'GPa')}) / ln(1 + "
        f"{z}/{text('fz-resistance-rha', 'GPa')}) = {ratio}. The greatest ratio of two numbers "
        f"that print so is 0.2975/0.2775 = {greatest}.",
        settle="The calculation from which the two values were taken, or R_t as it was used in "
        "each.",
        status="open",
        evidence=(falls, least, least_rounded, nominal, printed, most, z, limit, density),
        steps=(ratio, greatest),
    )


@concerning("eq16", "eq16-denominator", "frank-zook-rha", "frank-zook-stainless")
def equation_16(results: Results) -> Finding:
    """Eq. 16 prints X/R, but its right side is X/D."""
    text, exact = results.text, results.exact
    observed = exact("observed-depth-ratio")
    as_printed = {t: results.computed(f"frank-zook-{t}") for t in ("rha", "stainless")}
    derived = {t: results.computed(f"frank-zook-{t}", DERIVED) for t in ("rha", "stainless")}
    (needed,) = results.judge.assess_equation("eq16").constants["eq16-denominator"].needed
    factor = equals(
        "factor",
        "2",
        derived_over_printed(results),
        "1",
        "derived right side of Eq. 16 over the printed one",
    )
    must = equals(
        "must", "1", Fraction(needed), "1",
        "multiple of k_t that makes Eq. 16 follow from Eqs. 14 and 15",
    )  # fmt: skip
    printed_rha = prints(
        "printed_rha", "0.127", as_printed["rha"], "1", "Eq. 16 as printed, R_t of armor"
    )
    printed_stainless = prints(
        "printed_stainless", "0.150", as_printed["stainless"], "1",
        "Eq. 16 as printed, the R_t tried for stainless steel",
    )  # fmt: skip
    derived_rha = prints(
        "derived_rha", "0.255", derived["rha"], "1", "X/R from Eqs. 14 and 15, R_t of armor"
    )
    derived_stainless = prints(
        "derived_stainless", "0.300", derived["stainless"], "1",
        "X/R from Eqs. 14 and 15, the R_t tried for stainless steel",
    )  # fmt: skip
    above_rha = prints(
        "above_rha", "9", exact("frank-zook-rha") / derived["rha"] - 1, "percent",
        "by how much the printed value exceeds the derived one, R_t of armor",
    )  # fmt: skip
    below_stainless = prints(
        "below_stainless", "1.0", 1 - exact("frank-zook-stainless") / derived["stainless"],
        "percent", "by how much it falls short of it, stainless steel",
    )  # fmt: skip
    far_printed = prints(
        "far_printed", "0.171", observed - as_printed["rha"], "1",
        "greatest distance of Eq. 16 as printed from the observed X/R",
    )  # fmt: skip
    far_autodyne = prints(
        "far_autodyne", "0.22", exact("autodyne-ratio") - observed, "1",
        "distance of Autodyne's X/R from the observed one",
    )  # fmt: skip
    far_cth = prints(
        "far_cth", "0.112", exact("cth-ratio") - observed, "1",
        "distance of CTH's X/R from the observed one",
    )  # fmt: skip
    far_derived = prints(
        "far_derived", "0.043", observed - derived["rha"], "1",
        "greatest distance of the derived form from the observed X/R",
    )  # fmt: skip
    k_t, R_t = exact("fz-kt"), exact("fz-resistance-rha") / 10**9
    sum_ = calculated("1.313", inertia(results))
    half = calculated("0.127", 1.3128 / (2 * k_t) * log(1 + 2.0528 / R_t))
    two = text("eq16-denominator")
    return conclude(
        "equation-16",
        "formula",
        title=f"Eq. 16 prints {two} k_t; for X/R it must be k_t",
        statement="Eqs. 14 and 15 say (L rho_p + k_1 rho_t D) v dv/dx = -(k_t rho_t v^2 + R_t). "
        "Integrated from V to rest, X = (L rho_p + k_1 rho_t D) ln(1 + k_t rho_t V^2 / R_t) / (2 "
        "k_t rho_t). Divided by D, that is the right side of Eq. 16 to the letter; its left side "
        "divides by R. So Eq. 16 as printed gives half of the depth that Eqs. 14 and 15 give: "
        f"{printed_rha} and {printed_stainless} instead of {derived_rha} and {derived_stainless}. "
        f"The report prints {text('frank-zook-rha')} and {text('frank-zook-stainless')}, "
        f"{above_rha} % more and {below_stainless} % less than the derived ones, so the author "
        "probably used something near the derived form. That this approach comes closer to the "
        f"observed {text('observed-depth-ratio')} than the others tested is true of the derived "
        f"form (at most {far_derived} off). As printed (up to {far_printed} off), it beats the "
        f"model and Autodyne ({far_autodyne}), which the author ran, but not CTH ({far_cth}), "
        "whose depth he took from figures of others.",
        by_hand="Take V so small that ln(1 + q) is q. Then the work R_t X must equal (L rho_p + "
        "k_1 rho_t D) V^2/2, so X/D = (L/D rho_p/rho_t + k_1) rho_t V^2 / (2 R_t): the "
        f"{two} belongs to X/D, and X/R is twice that. In numbers: {text('sphere-length-ratio')} * "
        f"{text('a1-density', 'kg/m^3')}/{text('carbon-steel-density')} + {text('fz-k1')} = "
        f"{sum_}; Eq. 16 as printed is 1.3128/(2 * {text('fz-kt')}) * ln(1 + "
        f"2.0528/{text('fz-resistance-rha', 'GPa')}) = {half}.",
        settle="Frank and Zook's own formula (reference 16 of the report): whether P/D stands on "
        "its left side.",
        status="explained",
        evidence=(
            factor, must, printed_rha, printed_stainless, derived_rha, derived_stainless,
            above_rha, below_stainless, far_printed, far_autodyne, far_cth, far_derived,
        ),
        steps=(sum_, half),
    )  # fmt: skip


@concerning(
    "fz-resistance-rha",
    "fz-resistance-stainless",
    "a1-resistance",
    "ratio-beta-3",
    "ratio-beta-5",
    "frank-zook-rha",
    "frank-zook-stainless",
)
def two_resistances(results: Results) -> Finding:
    """The report gives the same target other resistances in its two models."""
    text, exact = results.text, results.exact
    Y_t = exact("flow-stress")
    R_3, R_5 = exact("depth-beta-3-beta") * Y_t, exact("depth-beta-5-beta") * Y_t
    low = prints("low", "2.1", R_3, "GPa", "R_t for beta = 3")
    high = prints("high", "3.5", R_5, "GPa", "R_t for beta = 5")
    fz_low = prints(
        "fz_low", "0.856", derived_ratio(results, R_3), "1",
        "X/R from Eqs. 14 and 15 at the R_t of beta = 3",
    )  # fmt: skip
    fz_high = prints(
        "fz_high", "0.579", derived_ratio(results, R_5), "1",
        "X/R from Eqs. 14 and 15 at the R_t of beta = 5",
    )  # fmt: skip
    model_stainless = prints(
        "model_stainless", "0.466",
        exact_ratio(case(results, 5, resistance=results["fz-resistance-stainless"])), "1",
        "exact X/R of the model at the R_t tried for stainless steel",
    )  # fmt: skip
    model_rha = prints(
        "model_rha", "0.424",
        exact_ratio(case(results, 5, resistance=results["fz-resistance-rha"])), "1",
        "exact X/R of the model at the R_t of armor",
    )  # fmt: skip
    inertia_ = prints("inertia", "1.3128", inertia(results), "1", "L/D rho_p/rho_t + k_1")
    z = prints("z", "2.0528", drag(results), "GPa", "k_t rho_t V^2")
    R_t = exact("a1-resistance") / 10**9
    step = calculated("0.579", 1.3128 / exact("fz-kt") * log(1 + 2.0528 / R_t))
    return conclude(
        "two-resistances",
        "inconsistent pair",
        title="By Eqs. 14 and 15, Frank and Zook come closer mostly because of their target "
        "resistance",
        statement=f"For impacts into stainless steel the report uses R_t = {low} and {high} GPa in "
        f"its model, and {text('fz-resistance-stainless', 'GPa')} and, as a first estimate, "
        f"armor's {text('fz-resistance-rha', 'GPa')} GPa in Frank and Zook's. With the model's "
        f"resistances Eqs. 14 and 15 give X/R = {fz_low} and {fz_high}; with Frank and Zook's the "
        f"model gives {model_stainless} and {model_rha} (exact). So, by Eqs. 14 and 15, most of "
        "the gap between the two comes from the resistance given to each. The report does say that "
        "R_t cannot be determined from first principles.",
        by_hand=f"{inertia_}/{text('fz-kt')} * ln(1 + {z}/{text('a1-resistance', 'GPa')}) = "
        f"{step}.",
        settle="One value of R_t for this target, measured.",
        status="explained",
        evidence=(low, high, fz_low, fz_high, model_stainless, model_rha, inertia_, z),
        steps=(step,),
    )  # fmt: skip


@concerning("circumscribed-length-ratio", "sphere-length-ratio")
def sphere_equivalent(results: Results) -> Finding:
    """The report's two sentences on the cylinder that stands for the sphere do not fit together."""
    text, exact = results.text, results.exact
    around = "circumscribed-length-ratio"
    R_armor, R_steel = exact("fz-resistance-rha"), exact("fz-resistance-stainless")
    # A cylinder with L = d has the sphere's mass if (pi/4) d^3 = (pi/6) D^3. Eq. 16 then gives
    # X/d with its L/D, and X/R = 2 (X/d) (d/D).
    narrower = cbrt(2 / 3)
    ratio = equals(
        "ratio", "2/3", exact("sphere-length-ratio") / exact(around), "1",
        "L/D of the cylinder with the sphere's diameter and mass",
    )  # fmt: skip
    diameter = prints(
        "diameter", "0.874", narrower, "1",
        "diameter of a cylinder with L/D = 1 and the sphere's mass, over the sphere's",
    )  # fmt: skip
    equal_rha = prints(
        "equal_rha", "0.286", derived_ratio(results, R_armor, around) * narrower, "1",
        "X/R from Eqs. 14 and 15 for that cylinder, R_t of armor",
    )  # fmt: skip
    equal_stainless = prints(
        "equal_stainless", "0.338", derived_ratio(results, R_steel, around) * narrower, "1",
        "X/R from Eqs. 14 and 15 for that cylinder, stainless steel",
    )  # fmt: skip
    heavier = prints(
        "heavier", "1.5", 1 / exact("sphere-length-ratio"), "1",
        "mass of the cylinder with L/D = 1 around the sphere, over the sphere's",
    )  # fmt: skip
    long_rha = prints(
        "long_rha", "0.328", derived_ratio(results, R_armor, around), "1",
        "X/R from Eqs. 14 and 15 for the cylinder around the sphere, R_t of armor",
    )  # fmt: skip
    long_stainless = prints(
        "long_stainless", "0.386", derived_ratio(results, R_steel, around), "1",
        "X/R from Eqs. 14 and 15 for the cylinder around the sphere, stainless steel",
    )  # fmt: skip
    steps = (calculated("0.667", Fraction(4, 6)), calculated("0.874", (4 / 6) ** (1 / 3)))
    return conclude(
        "sphere-equivalent",
        "wording",
        title="A cylinder of the sphere's mass has L/D = "
        f"{text('sphere-length-ratio')} at its diameter, or L/D = {text(around)} at a smaller one",
        statement='"Assume that a sphere is the mass equivalent of a cylinder with L/D = 1. '
        'Therefore, the L/D ratio for the sphere equivalent is 2/3": the second sentence does not '
        f"follow from the first. Its {ratio} is right for a cylinder of the sphere's diameter and "
        f"mass. Read as it stands, the first means a cylinder with L/D = {text(around)} and the "
        f"sphere's mass, whose diameter is {diameter} of the sphere's: Eqs. 14 and 15 then give "
        f"X/R = {equal_rha} and {equal_stainless}. The cylinder with L/D = {text(around)} around "
        f"the sphere has {heavier} times its mass and gives {long_rha} and {long_stainless}. None "
        "of the four is printed.",
        by_hand=f"(pi/6) D^3 = (pi/4) D^2 L gives L/D = 4/6 = {steps[0]}; (pi/6) D^3 = (pi/4) "
        f"d^3 gives d/D = (4/6)^(1/3) = {steps[1]}.",
        settle="Nothing is open.",
        status="explained",
        evidence=(
            ratio, diameter, equal_rha, equal_stainless, heavier, long_rha, long_stainless,
        ),
        steps=steps,
    )  # fmt: skip
