"""Findings on section 3's comparison with the model of Frank and Zook (Eqs. 14 to 17)."""

from fractions import Fraction
from math import expm1, log, log1p

from reference.arithmetic import Arithmetic, Number
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
from replication.audit.record import Finding
from replication.audit.results import DENSITY, DERIVED, Results, case, exact_ratio

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


def least_rise(audit: Results, convention: Convention) -> Fraction:
    """Return the proven least `rise` over all inputs that print like the report's."""
    box = {name: audit.judge.rounded(entry, convention).ends for name, entry in RISE.items()}
    return enclose(rise, box).ends[0]


def drag(audit: Results) -> Fraction:
    """k_t rho_t V^2 [Pa], the drag in Eq. 16's logarithm, at the inputs as printed."""
    return audit.exact("fz-kt") * audit.exact(DENSITY) * audit.exact("a1-initial-velocity") ** 2


def inertia(audit: Results, length_ratio: str = "sphere-length-ratio") -> Fraction:
    """L/D rho_p/rho_t + k_1 [1] of Eq. 16 at the inputs as printed; the claim gives L/D."""
    densities = audit.exact("a1-density") / audit.exact(DENSITY)
    return audit.exact(length_ratio) * densities + audit.exact("fz-k1")


def derived_ratio(
    audit: Results, R_t: Fraction, length_ratio: str = "sphere-length-ratio"
) -> float:
    """X/R [1] from Eqs. 14 and 15 at the target resistance R_t [Pa]."""
    return float(inertia(audit, length_ratio) / audit.exact("fz-kt")) * log1p(drag(audit) / R_t)


def greatest_rise(audit: Results) -> Fraction:
    """Return the greatest ratio of two X/R that print like the two of section 3, less one."""
    armor, steel = (audit.ledger.claims[f"frank-zook-{name}"] for name in ("rha", "stainless"))
    return steel.target().ends[1] / armor.target().ends[0] - 1


RESULTS = ("depth-beta-3", "depth-beta-5", "ratio-beta-3", "ratio-beta-5")
"""The final depths of the report's model, and their X/R."""


def derived_over_printed(audit: Results) -> Fraction:
    """Return the derived over the printed right side of Eq. 16; 0 if that is not one number."""
    factor = audit.judge.assess_equation("eq16").factor
    return Fraction(0) if factor is None else 1 / factor


@concerning("frank-zook-rha", "frank-zook-stainless", "eq16")
def headline(audit: Results) -> Finding:
    """The sentence with which every output begins."""
    factor = equals(
        "factor",
        "2",
        derived_over_printed(audit),
        "1",
        "derived right side of Eq. 16 over the printed one",
    )
    apart = least_rise(audit, Convention(choices_exact=False)) - greatest_rise(audit)
    evidence = (
        proves(
            "model",
            {*audit.verdicts("a1-"), *map(audit.verdict, RESULTS)} == {Verdict.REPRODUCED},
            "Table A-1, both final depths and their X/R are reproduced",
        ),
        proves(
            "pair",
            audit.verdicts("frank-zook-") == {Verdict.NOT_REPRODUCED},
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
        statement="With the target density that Table A-1 implies, the model's own numbers "
        "reproduce to the last printed digit; the two Frank-Zook values do not and cannot both be "
        f"right; Eq. 16 as printed is too small by a factor of {factor}.",
        status="explained",
        evidence=evidence,
    )


@concerning(
    "frank-zook-rha", "frank-zook-stainless", "fz-resistance-rha", "fz-resistance-stainless"
)
def frank_zook_pair(audit: Results) -> Finding:
    """Section 3 changes only R_t between its two X/R, but R_t alone moves them further apart."""
    text, exact = audit.text, audit.exact
    armor, steel = text("frank-zook-rha"), text("frank-zook-stainless")
    R_t, R_low = exact("fz-resistance-rha"), exact("fz-resistance-stainless")
    falls = prints(
        "falls", "16.8", 1 - R_low / R_t, "percent",
        "by how much R_t falls from the one value to the other",
    )  # fmt: skip
    least = at_least(
        "least", "17.7", least_rise(audit, Convention()), "percent",
        "proven least rise of X/R, the R_t tried for stainless steel exact",
    )  # fmt: skip
    least_rounded = at_least(
        "least_rounded", "16.9", least_rise(audit, Convention(choices_exact=False)), "percent",
        "proven least rise of X/R, all inputs rounded",
    )  # fmt: skip
    nominal = prints(
        "nominal", "17.9", log1p(drag(audit) / R_low) / log1p(drag(audit) / R_t) - 1, "percent",
        "rise of X/R at the inputs as printed",
    )  # fmt: skip
    printed = prints(
        "printed", "6.8", exact("frank-zook-stainless") / exact("frank-zook-rha") - 1, "percent",
        "rise of X/R as printed",
    )  # fmt: skip
    most = at_most(
        "most",
        "7.21",
        greatest_rise(audit),
        "percent",
        "greatest rise of two numbers that print so",
    )
    z = prints(
        "z", "2.053", drag(audit), "GPa", "k_t rho_t V^2 at the inputs as printed and 7850 kg/m^3"
    )
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
        f"{least_rounded} %. So at least one of the two numbers is misprinted, miscalculated, or "
        "comes from other inputs than those printed.",
        by_hand=f"With z = k_t rho_t V^2 = {z} GPa the ratio is ln(1 + "
        f"{z}/{text('fz-resistance-stainless', 'GPa')}) / ln(1 + "
        f"{z}/{text('fz-resistance-rha', 'GPa')}) = {ratio}. The greatest ratio of two numbers "
        f"that print so is 0.2975/0.2775 = {greatest}.",
        settle="The calculation from which the two values were taken, or R_t as it was used in "
        "each.",
        status="open",
        evidence=(falls, least, least_rounded, nominal, printed, most, z),
        steps=(ratio, greatest),
    )


@concerning("eq16", "eq16-denominator", "frank-zook-rha", "frank-zook-stainless")
def equation_16(audit: Results) -> Finding:
    """Eq. 16 prints X/R, but its right side is X/D."""
    text, exact = audit.text, audit.exact
    observed = exact("observed-depth-ratio")
    as_printed = {t: audit.computed(f"frank-zook-{t}") for t in ("rha", "stainless")}
    derived = {t: audit.computed(f"frank-zook-{t}", DERIVED) for t in ("rha", "stainless")}
    (needed,) = audit.judge.assess_equation("eq16").constants["eq16-denominator"].needed
    factor = equals(
        "factor",
        "2",
        derived_over_printed(audit),
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
    sum_ = calculated("1.313", inertia(audit))
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


def input_needed(audit: Results, claim: str, entry: str) -> Fraction:
    """Return the middle of the values (SI) of an input with which Eqs. 14 and 15 give a claim."""
    solutions = audit.explainer.solutions(audit.ledger.claims[claim], DERIVED, entry)
    return sum(solutions.inner[0], Fraction(0)) / 2


def nearest_resistance(audit: Results, grid: Fraction) -> Fraction:
    """Return the R_t [Pa] on a grid whose derived X/R comes nearest to the observed one."""
    observed = audit["observed-depth-ratio"]
    return min(
        (grid * k for k in range(1, 200)),
        key=lambda R_t: abs(derived_ratio(audit, R_t) - observed),
    )


@concerning("frank-zook-rha", "frank-zook-stainless", "fz-resistance-stainless")
def frank_zook_values(audit: Results) -> Finding:
    """What would give the two printed values."""
    text, exact, judge = audit.text, audit.exact, audit.judge
    stainless = audit.ledger.claims["frank-zook-stainless"]
    function = audit.ledger.function(stainless, reading=DERIVED)
    usual = judge.inputs_as_rounded(stainless, Convention())
    admitted = {
        **judge.inputs_as_rounded(stainless, Convention(choices_exact=False)),
        "a1-initial-velocity": usual["a1-initial-velocity"],
        DENSITY: judge.rounded(DENSITY, Convention(header_exact=True)).ends,
    }
    z, sum_, k_t = drag(audit), inertia(audit), exact("fz-kt")
    X_R = audit.computed("frank-zook-stainless", DERIVED)
    derived = prints(
        "derived", "0.300", X_R, "1", "X/R from Eqs. 14 and 15, the R_t tried for stainless steel"
    )
    off = prints(
        "off", "1", X_R / exact("frank-zook-stainless") - 1, "percent",
        "that over the printed value, less one",
    )  # fmt: skip
    least_exact = at_least(
        "least_exact", "0.2987", enclose(function, usual).ends[0], "1",
        "proven least X/R with that R_t exact",
    )  # fmt: skip
    least_admitted = at_least(
        "least_admitted", "0.2979", enclose(function, admitted).ends[0], "1",
        "proven least X/R with that R_t rounded, 500 m/s exact, and a density that the header as "
        "printed admits",
    )  # fmt: skip
    digit = audit.last_digit("fz-resistance-stainless")
    grid = equals("grid", "0.1", digit, "GPa", "unit of the last digit of that R_t")
    corner = proves(
        "corner",
        {
            judgement.verdict
            for judgement in audit.reading("frank-zook-stainless", DERIVED).judgements
            if judgement.convention == Convention(choices_exact=False)
        }
        == {Verdict.WITHIN_ROUNDING},
        "with that R_t rounded, some inputs that print like the report's give the printed value",
    )
    needed = prints(
        "needed", "7.69", input_needed(audit, "frank-zook-stainless", "fz-resistance-stainless"),
        "GPa",
        "R_t that gives the printed value, derived form",
    )  # fmt: skip
    R_nearest = nearest_resistance(audit, digit)
    nearest = prints(
        "nearest", "7.7", R_nearest, "GPa",
        "R_t on a grid of 0.1 GPa whose X/R is nearest to the observed one",
    )  # fmt: skip
    after = prints(
        "next", "0.2966", derived_ratio(audit, R_nearest), "1", "X/R with an R_t 0.1 GPa higher"
    )
    three_digits = Fraction(f"{X_R:.2e}")
    back = prints(
        "back", "7.603", z / expm1(three_digits * k_t / sum_), "GPa",
        "R_t that gives X/R = 0.300, derived form",
    )  # fmt: skip
    rha_resistance = prints(
        "rha_resistance", "8.28", input_needed(audit, "frank-zook-rha", "fz-resistance-rha"), "GPa",
        "R_t that gives the value for armor, derived form",
    )  # fmt: skip
    rha_velocity = prints(
        "rha_velocity", "525", input_needed(audit, "frank-zook-rha", "a1-initial-velocity"), "m/s",
        "V that gives the value for armor, derived form",
    )  # fmt: skip
    rha_derived = prints(
        "rha_derived", "0.255", audit.computed("frank-zook-rha", DERIVED), "1",
        "X/R from Eqs. 14 and 15, R_t of armor",
    )  # fmt: skip
    never = proves(
        "never",
        {
            judgement.verdict
            for reading in judge.assess(audit.ledger.claims["frank-zook-rha"]).readings
            for judgement in reading.judgements
            if judgement.convention.choices_exact
        }
        == {Verdict.NOT_REPRODUCED},
        "the value for armor is in no form and under no convention of rounding, choices exact",
    )
    slips = proves(
        "slips",
        not any(slip.fits for slip in audit.explainer.slips(audit.ledger.claims["frank-zook-rha"])),
        "no slip that is tried gives the value for armor",
    )
    inertia_ = prints("inertia", "1.3128", sum_, "1", "L/D rho_p/rho_t + k_1")
    z_ = prints("z", "2.0528", z, "GPa", "k_t rho_t V^2")
    R_steel = exact("fz-resistance-stainless") / 10**9
    steps = (
        calculated("0.300", 1.3128 / k_t * log(1 + 2.0528 / R_steel)),
        calculated("0.297", 1.3128 / k_t * log(1 + 2.0528 / 7.7)),
        calculated("0.278", 1.3128 / k_t * log(1 + 2.0528 / 8.28)),
    )
    factor = f"{inertia_}/{text('fz-kt')}"
    return conclude(
        "frank-zook-values",
        "unstated input",
        title=f"{text('frank-zook-stainless')} is {off} % from the derived {derived}; "
        f"{text('frank-zook-rha')} stays unexplained",
        statement=f"As derived from Eqs. 14 and 15 and with {text('fz-resistance-stainless')} Pa "
        f"exactly, X/R is {derived}, not {text('frank-zook-stainless')}. It is at least "
        f"{least_exact} for all other inputs that print like the report's "
        f"({text('a1-initial-velocity')} m/s and {text('a-step')} ns exact, the mass the "
        f"sphere's). If that resistance is itself rounded, {text('frank-zook-stainless')} can be "
        f"reached; at {text('a1-initial-velocity')} m/s exactly it needs a target density that the "
        f"header of Table A-1 as printed excludes, as those that it admits give {least_admitted} "
        f"or more. Two possible explanations, neither of them proven: on a grid of {grid} GPa the "
        f"resistance that comes nearest to the observed {text('observed-depth-ratio')} is "
        f"{nearest} GPa, and it gives {after}; and the derived {derived}, rounded, gives back "
        f"{back} GPa, which prints {text('fz-resistance-stainless', 'GPa')}. In the derived form "
        f"{text('frank-zook-rha')} needs R_t = {rha_resistance} GPa (printed "
        f"{text('fz-resistance-rha', 'GPa')}) or V = {rha_velocity} m/s (printed "
        f"{text('a1-initial-velocity')}); no input within its rounding, and no slip that was "
        "tried, gives it. One-edit misprints that would are listed with the number; nothing speaks "
        "for any of them. It is unexplained.",
        by_hand=f"{factor} * ln(1 + {z_}/{text('fz-resistance-stainless', 'GPa')}) = {steps[0]}; "
        f"with {nearest} in place of {text('fz-resistance-stainless', 'GPa')} {factor} * ln(1 + "
        f"{z_}/{nearest}) = {steps[1]}; with {rha_resistance} {factor} * ln(1 + "
        f"{z_}/{rha_resistance}) = {steps[2]}.",
        settle="R_t and V as they were used, and the steps of the calculation.",
        status="open",
        evidence=(
            derived, off, least_exact, least_admitted, grid, corner, needed, nearest, after, back,
            rha_resistance, rha_velocity, rha_derived, never, slips, inertia_, z_,
        ),
        steps=steps,
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
def two_resistances(audit: Results) -> Finding:
    """The report gives the same target other resistances in its two models."""
    text, exact = audit.text, audit.exact
    Y_t = exact("flow-stress")
    R_3, R_5 = exact("depth-beta-3-beta") * Y_t, exact("depth-beta-5-beta") * Y_t
    low = prints("low", "2.1", R_3, "GPa", "R_t for beta = 3")
    high = prints("high", "3.5", R_5, "GPa", "R_t for beta = 5")
    fz_low = prints(
        "fz_low", "0.856", derived_ratio(audit, R_3), "1",
        "X/R from Eqs. 14 and 15 at the R_t of beta = 3",
    )  # fmt: skip
    fz_high = prints(
        "fz_high", "0.579", derived_ratio(audit, R_5), "1",
        "X/R from Eqs. 14 and 15 at the R_t of beta = 5",
    )  # fmt: skip
    model_stainless = prints(
        "model_stainless", "0.466",
        exact_ratio(case(audit, 5, resistance=audit["fz-resistance-stainless"])), "1",
        "exact X/R of the model at the R_t tried for stainless steel",
    )  # fmt: skip
    model_rha = prints(
        "model_rha", "0.424", exact_ratio(case(audit, 5, resistance=audit["fz-resistance-rha"])),
        "1", "exact X/R of the model at the R_t of armor",
    )  # fmt: skip
    inertia_ = prints("inertia", "1.3128", inertia(audit), "1", "L/D rho_p/rho_t + k_1")
    z = prints("z", "2.0528", drag(audit), "GPa", "k_t rho_t V^2")
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
def sphere_equivalent(audit: Results) -> Finding:
    """The report's two sentences on the cylinder that stands for the sphere do not fit together."""
    text, exact = audit.text, audit.exact
    around = "circumscribed-length-ratio"
    ratio = equals(
        "ratio", "2/3", exact("sphere-length-ratio") / exact(around), "1",
        "L/D of the cylinder with the sphere's diameter and mass",
    )  # fmt: skip
    long_rha = prints(
        "long_rha", "0.328", derived_ratio(audit, exact("fz-resistance-rha"), around), "1",
        "X/R from Eqs. 14 and 15 with L/D = 1, R_t of armor",
    )  # fmt: skip
    long_stainless = prints(
        "long_stainless", "0.386", derived_ratio(audit, exact("fz-resistance-stainless"), around),
        "1", "X/R from Eqs. 14 and 15 with L/D = 1, stainless steel",
    )  # fmt: skip
    step = calculated("0.667", Fraction(4, 6))
    return conclude(
        "sphere-equivalent",
        "wording",
        title="A sphere has two thirds of the mass of the cylinder with L/D = "
        f"{text(around)} around it",
        statement='"Assume that a sphere is the mass equivalent of a cylinder with L/D = 1. '
        'Therefore, the L/D ratio for the sphere equivalent is 2/3": the second sentence does not '
        f"follow from the first, but its {ratio} is right for a cylinder of the sphere's diameter "
        f"and mass. With L/D = {text(around)} in its place X/R would be {long_rha} and "
        f"{long_stainless}, neither of them printed.",
        by_hand=f"(pi/6) D^3 = (pi/4) D^2 L gives L/D = 4/6 = {step}.",
        settle="Nothing is open.",
        status="explained",
        evidence=(ratio, long_rha, long_stainless),
        steps=(step,),
    )
