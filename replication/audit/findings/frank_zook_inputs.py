"""The finding on what would give the two printed values of Frank and Zook's model (section 3)."""

from fractions import Fraction
from math import expm1, log, log1p
from typing import NamedTuple

from reference.enclosure import enclose
from reference.ledger import Convention
from replication.audit.assessment import Verdict
from replication.audit.findings.evidence import (
    at_least,
    at_most,
    calculated,
    concerning,
    conclude,
    equals,
    prints,
    proves,
)
from replication.audit.findings.frank_zook import derived_ratio, drag, inertia
from replication.audit.inference import DENSITY
from replication.audit.record import Evidence, Finding
from replication.audit.results import DERIVED, Results, density_taken
from replication.audit.slips import EVERY_DENSITY
from replication.text import number


def input_needed(results: Results, claim: str, entry: str) -> Fraction:
    """Return the middle of the values (SI) of an input with which Eqs. 14 and 15 give a claim."""
    solutions = results.explainer.solutions(results.ledger.claims[claim], DERIVED, entry)
    return sum(solutions.inner[0], Fraction(0)) / 2


def nearest_resistance(results: Results, grid: Fraction) -> Fraction:
    """Return the R_t [Pa] on a grid whose derived X/R comes nearest to the observed one."""
    observed = results["observed-depth-ratio"]
    return min(
        (grid * k for k in range(1, 200)),
        key=lambda R_t: abs(derived_ratio(results, R_t) - observed),
    )


def typed_without_brackets(results: Results, rho_t: Fraction, R_t: Fraction) -> float:
    """X/R [1], twice Eq. 16, with "/2*k_t" in a cell, which multiplies by k_t.

    Target density rho_t [kg/m^3] and resistance R_t [Pa].
    """
    k_t, V = exact_of(results, "fz-kt", "a1-initial-velocity")
    L_D, rho_p, k_1 = exact_of(results, "sphere-length-ratio", "a1-density", "fz-k1")
    return float((L_D * rho_p / rho_t + k_1) * k_t) * log1p(k_t * rho_t * V**2 / R_t)


def density_on_k_1(results: Results, R_t: Fraction) -> float:
    """X/R [1], twice Eq. 16, with the density ratio on k_1 in place of L/D; R_t [Pa]."""
    L_D, rho_p, k_1, k_t = exact_of(results, "sphere-length-ratio", "a1-density", "fz-k1", "fz-kt")
    bracket = L_D + k_1 * rho_p / results.exact(DENSITY)
    return float(bracket / k_t) * log1p(drag(results) / R_t)


def densities_that_give(results: Results, claim: str) -> tuple[float, float]:
    """Return the densities [kg/m^3] between which `typed_without_brackets` prints as the claim."""
    least, greatest = results.ledger.claims[claim].target().ends
    return _density_that_gives(results, float(least)), _density_that_gives(results, float(greatest))


def _density_that_gives(results: Results, ratio: float) -> float:
    """Return the target density [kg/m^3] at which `typed_without_brackets`, which grows, is so."""
    R_t = results.exact("fz-resistance-rha")
    low, high = Fraction(7000), Fraction(9000)
    for _ in range(40):  # to 2e-9 kg/m^3
        middle = (low + high) / 2
        if typed_without_brackets(results, middle, R_t) < ratio:
            low = middle
        else:
            high = middle
    return float(low)


def exact_of(results: Results, *names: str) -> list[Fraction]:
    """Return the values (SI) of several entries."""
    return [results.exact(name) for name in names]


TARGETS = ("rha", "stainless")
"""The endings of the ids of the two Frank-Zook values: armor, and stainless steel."""


class DerivedNumbers(NamedTuple):
    """What Eqs. 14 and 15 give for stainless steel."""

    derived: Evidence
    off: Evidence
    least_exact: Evidence
    least_admitted: Evidence


def derived_for_stainless(results: Results) -> DerivedNumbers:
    """Return X/R from Eqs. 14 and 15, and how small other inputs that print alike make it."""
    judge, stainless = results.judge, results.ledger.claims["frank-zook-stainless"]
    function = results.ledger.function(stainless, reading=DERIVED)
    usual = judge.inputs_as_rounded(stainless, Convention())
    admitted = {
        **judge.inputs_as_rounded(stainless, Convention(choices_exact=False)),
        "a1-initial-velocity": usual["a1-initial-velocity"],
        DENSITY: judge.rounded(DENSITY, Convention(header_exact=True)).ends,
    }
    X_R = results.computed("frank-zook-stainless", DERIVED)
    derived = prints(
        "derived", "0.300", X_R, "1", "X/R from Eqs. 14 and 15, the R_t tried for stainless steel"
    )
    off = prints(
        "off", "1", X_R / results.exact("frank-zook-stainless") - 1, "percent",
        "that over the printed value, less one",
    )  # fmt: skip
    least_exact = at_least(
        "least_exact", "0.2987", enclose(function, usual).ends[0], "1",
        "proven least X/R with that R_t exact",
    )  # fmt: skip
    least_admitted = at_least(
        "least_admitted", "0.2979", enclose(function, admitted).ends[0], "1",
        f"proven least X/R with that R_t rounded, {results.text('a1-initial-velocity')} m/s exact, "
        "and a density that the header as printed admits",
    )  # fmt: skip
    return DerivedNumbers(derived, off, least_exact, least_admitted)


class ResistanceNumbers(NamedTuple):
    """Which resistance would give the value for stainless steel."""

    grid: Evidence
    corner: Evidence
    needed: Evidence
    nearest: Evidence
    after: Evidence
    back: Evidence


def resistances_for_stainless(results: Results) -> ResistanceNumbers:
    """Return the R_t that gives the value for stainless steel, and how it may have been found."""
    X_R = results.computed("frank-zook-stainless", DERIVED)
    z, sum_, k_t = drag(results), inertia(results), results.exact("fz-kt")
    digit = results.last_digit("fz-resistance-stainless")
    grid = equals("grid", "0.1", digit, "GPa", "unit of the last digit of that R_t")
    corner = proves(
        "corner",
        {
            judgement.verdict
            for judgement in results.reading("frank-zook-stainless", DERIVED).judgements
            if judgement.convention == Convention(choices_exact=False)
        }
        == {Verdict.WITHIN_ROUNDING},
        "with that R_t rounded, some inputs that print like the report's give the printed value",
    )
    needed = prints(
        "needed", "7.69", input_needed(results, "frank-zook-stainless", "fz-resistance-stainless"),
        "GPa",
        "R_t that gives the printed value, derived form",
    )  # fmt: skip
    R_nearest = nearest_resistance(results, digit)
    nearest = prints(
        "nearest", "7.7", R_nearest, "GPa",
        f"R_t on a grid of {number(digit / 10**9)} GPa whose X/R is nearest to the observed one",
    )  # fmt: skip
    after = prints(
        "next", "0.2966", derived_ratio(results, R_nearest), "1",
        f"X/R with an R_t {number(digit / 10**9)} GPa higher",
    )  # fmt: skip
    three_digits = Fraction(f"{X_R:.2e}")
    back = prints(
        "back", "7.603", z / expm1(three_digits * k_t / sum_), "GPa",
        f"R_t that gives X/R = {float(three_digits):.3f}, derived form",
    )  # fmt: skip
    return ResistanceNumbers(grid, corner, needed, nearest, after, back)


class ArmorNumbers(NamedTuple):
    """What the value for armor would need."""

    resistance: Evidence
    velocity: Evidence
    derived: Evidence
    never: Evidence


def needed_for_armor(results: Results) -> ArmorNumbers:
    """Return the inputs that would give the value for armor, and what the printed ones give."""
    resistance = prints(
        "rha_resistance", "8.28", input_needed(results, "frank-zook-rha", "fz-resistance-rha"),
        "GPa", "R_t that gives the value for armor, derived form",
    )  # fmt: skip
    velocity = prints(
        "rha_velocity", "525", input_needed(results, "frank-zook-rha", "a1-initial-velocity"),
        "m/s", "V that gives the value for armor, derived form",
    )  # fmt: skip
    derived = prints(
        "rha_derived", "0.255", results.computed("frank-zook-rha", DERIVED), "1",
        "X/R from Eqs. 14 and 15, R_t of armor",
    )  # fmt: skip
    never = proves(
        "never",
        {
            judgement.verdict
            for reading in results.judge.assess(results.ledger.claims["frank-zook-rha"]).readings
            for judgement in reading.judgements
            if judgement.convention.choices_exact
        }
        == {Verdict.NOT_REPRODUCED},
        "the value for armor is in no form and under no convention of rounding, choices exact",
    )
    return ArmorNumbers(resistance, velocity, derived, never)


class FamilyNumbers(NamedTuple):
    """The family of slips, and how many of it give the two values, in fact and by accident."""

    forms: Evidence
    members: Evidence
    fit_rha: Evidence
    fit_stainless: Evidence
    chance_rha: Evidence
    chance_stainless: Evidence
    fit_both: Evidence


def family_of_slips(results: Results) -> FamilyNumbers:
    """Count the family of slips and those that give the two values."""
    tried = {name: results.slips(results.ledger.claims[f"frank-zook-{name}"]) for name in TARGETS}
    names = {name: {slip.name for slip in fitting} for name, (_, fitting) in tried.items()}
    forms = equals(
        "forms", "2532", tried["rha"][0].forms, "1", "forms of Eq. 16 in the family of slips"
    )
    members = equals(
        "members", "2086", tried["rha"][0].members, "1",
        "different values of the family of slips that is generated, for armor",
    )  # fmt: skip
    fit_rha = equals(
        "fit_rha", "4", len(names["rha"]), "1",
        "members of the family that give the armor value for some density that is admitted",
    )  # fmt: skip
    fit_stainless = equals(
        "fit_stainless", "6", len(names["stainless"]), "1",
        "members of the family that give the stainless value for some density that is admitted",
    )  # fmt: skip
    chance_rha = prints(
        "chance_rha", "3.9", tried["rha"][0].expected, "1",
        "how many members would give the armor value by accident",
    )  # fmt: skip
    chance_stainless = prints(
        "chance_stainless", "4.0", tried["stainless"][0].expected, "1",
        "how many members would give the stainless value by accident",
    )  # fmt: skip
    fit_both = equals(
        "fit_both", "0", len(names["rha"] & names["stainless"]), "1", "members that give both"
    )
    return FamilyNumbers(
        forms, members, fit_rha, fit_stainless, chance_rha, chance_stainless, fit_both
    )


class TakenNumbers(NamedTuple):
    """How many slips give the two values at the density that is taken, and one at any density."""

    rha: Evidence
    stainless: Evidence
    both_copper: Evidence


def slips_by_density(results: Results) -> TakenNumbers:
    """Count the slips that give the two values at one density; one gives armor's at any."""
    tried = {name: results.slips(results.ledger.claims[f"frank-zook-{name}"]) for name in TARGETS}
    at_taken = {
        name: sum(
            results.ledger.claims[f"frank-zook-{name}"].target().contains(Fraction(slip.value))
            for slip in fitting
        )
        for name, (_, fitting) in tried.items()
    }
    rha = equals(
        "taken_rha", "1", at_taken["rha"], "1", f"those that do at {density_taken(results)}"
    )
    stainless = equals(
        "taken_stainless", "2", at_taken["stainless"], "1", "the same, stainless steel"
    )
    (same_density,) = (
        slip for slip in tried["rha"][1] if slip.fits == EVERY_DENSITY and slip.departures == 2
    )
    both_copper = prints(
        "both_copper", "0.27785", same_density.value, "1",
        "Eq. 16 with 1/2 for k_t in the divisor and the particle's density for both, armor",
    )  # fmt: skip
    return TakenNumbers(rha, stainless, both_copper)


class SingleSlipNumbers(NamedTuple):
    """What the two single slips in the derived form give for both targets."""

    multiplied: Evidence
    multiplied_other: Evidence
    from_: Evidence
    below: Evidence
    always: Evidence
    on_k_1: Evidence
    on_k_1_other: Evidence


def single_slips(results: Results) -> SingleSlipNumbers:
    """Return X/R with "/2*k_t" typed without brackets, and with the density ratio on k_1."""
    exact = results.exact
    multiplied_rha, multiplied_stainless = (
        typed_without_brackets(results, exact(DENSITY), R_t)
        for R_t in (exact("fz-resistance-rha"), exact("fz-resistance-stainless"))
    )
    multiplied = prints(
        "multiplied", "0.278503", multiplied_rha, "1",
        "Eq. 16 with /2*k_t typed without brackets and X/R twice X/D, armor, "
        f"{density_taken(results)}",
    )  # fmt: skip
    multiplied_other = prints(
        "multiplied_other", "0.328", multiplied_stainless, "1", "the same, stainless steel"
    )
    from_density, to_density = densities_that_give(results, "frank-zook-rha")
    from_ = at_most(
        "from", "7764.3", from_density, "kg/m^3",
        "target density from which that prints as the armor value",
    )  # fmt: skip
    below = at_least(
        "below", "7849.7", to_density, "kg/m^3",
        "target density below which that prints as the armor value",
    )  # fmt: skip
    with_mass = results.judge.inference(DENSITY).with_mass.ends
    always = proves(
        "always",
        from_density < with_mass[0] and with_mass[1] < to_density,
        "it does for every density that the header of Table A-1 admits with its printed mass",
    )
    on_k_1 = prints(
        "on_k_1", "0.29674", density_on_k_1(results, exact("fz-resistance-stainless")), "1",
        "X/R twice X/D, the density ratio on k_1 in place of L/D, stainless steel",
    )  # fmt: skip
    on_k_1_other = prints(
        "on_k_1_other", "0.252", density_on_k_1(results, exact("fz-resistance-rha")), "1",
        "the same, armor",
    )  # fmt: skip
    return SingleSlipNumbers(
        multiplied, multiplied_other, from_, below, always, on_k_1, on_k_1_other
    )


@concerning("frank-zook-rha", "frank-zook-stainless", "fz-resistance-stainless")
def frank_zook_values(results: Results) -> Finding:
    """What would give the two printed values."""
    text, exact = results.text, results.exact
    stainless, resistance = derived_for_stainless(results), resistances_for_stainless(results)
    armor, family = needed_for_armor(results), family_of_slips(results)
    taken, single = slips_by_density(results), single_slips(results)
    k_t = exact("fz-kt")
    assumed = equals("assumed", "7850", exact(DENSITY), "kg/m^3", "target density that is taken")
    inertia_ = prints("inertia", "1.3128", inertia(results), "1", "L/D rho_p/rho_t + k_1")
    z_ = prints("z", "2.0528", drag(results), "GPa", "k_t rho_t V^2")
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
        title=f"{text('frank-zook-stainless')} is {stainless.off} % from the derived "
        f"{stainless.derived}; what gave {text('frank-zook-rha')} is open",
        statement=f"As derived from Eqs. 14 and 15 and with {text('fz-resistance-stainless')} Pa "
        f"exactly, X/R is {stainless.derived}, not {text('frank-zook-stainless')}. It is at least "
        f"{stainless.least_exact} for all other inputs that print like the report's "
        f"({text('a1-initial-velocity')} m/s and {text('a-step')} ns exact, the mass the "
        f"sphere's). If that resistance is itself rounded, {text('frank-zook-stainless')} can be "
        f"reached; at {text('a1-initial-velocity')} m/s exactly it needs a target density that the "
        "header of Table A-1 as printed excludes, as those that it admits give "
        f"{stainless.least_admitted} or more. In the derived form {text('frank-zook-rha')} needs "
        f"R_t = {armor.resistance} GPa (printed {text('fz-resistance-rha', 'GPa')}) or V = "
        f"{armor.velocity} m/s (printed {text('a1-initial-velocity')}); no input within its "
        "rounding gives it. What slips would give is computed for a family of them, generated from "
        "each thing that is typed once: Eq. 16 with one slip or two, also two within one bracket, "
        f"each with and without the missing factor of 2. The family has {family.forms} forms with "
        f"{family.members} different values. For some density that Table A-1 admits, "
        f"{family.fit_rha} of them print {text('frank-zook-rha')} and {family.fit_stainless} print "
        f"{text('frank-zook-stainless')} (at {assumed} kg/m^3 {taken.rha} and {taken.stainless}), "
        f"where {family.chance_rha} and {family.chance_stainless} would by accident, reckoned from "
        f"how many come within a factor of three halves; {family.fit_both} print both. Two of "
        "those for armor have two departures from Eq. 16. One puts 1/2 for k_t in the divisor and "
        f"the particle's density for both densities, and gives {taken.both_copper} whatever the "
        "target density. The other is the only one that is a single slip in the derived form: "
        '"/2kt" typed into a cell as /2*k_t multiplies by k_t. With X/R twice X/D that gives '
        f"{single.multiplied} for {assumed} kg/m^3, and prints {text('frank-zook-rha')} for every "
        f"density from {single.from_} to {single.below}, so for all that the header with its "
        f"printed mass admits; for stainless steel it gives {single.multiplied_other}. With the "
        "density ratio on k_1 in place of L/D, X/R twice X/D, stainless steel gives "
        f"{single.on_k_1}, which prints {text('frank-zook-stainless')}, and armor "
        f"{single.on_k_1_other}. Two other ways to {text('frank-zook-stainless')}: on a grid of "
        f"{resistance.grid} GPa the resistance that comes nearest to the observed "
        f"{text('observed-depth-ratio')} is {resistance.nearest} GPa, and it gives "
        f"{resistance.after}; and the derived {stainless.derived}, rounded, gives back "
        f"{resistance.back} GPa, which prints {text('fz-resistance-stainless', 'GPa')}. All of "
        "this is suggestive, none of it proven.",
        by_hand=f"{factor} * ln(1 + {z_}/{text('fz-resistance-stainless', 'GPa')}) = {steps[0]}; "
        f"with {resistance.nearest} in place of {text('fz-resistance-stainless', 'GPa')} {factor} "
        f"* ln(1 + {z_}/{resistance.nearest}) = {steps[1]}; with {armor.resistance} {factor} * "
        f"ln(1 + {z_}/{armor.resistance}) = {steps[2]}.",
        settle="R_t and V as they were used, and the steps of the calculation.",
        status="open",
        evidence=(
            *stainless, *resistance, *armor, inertia_, z_, *family, *single, assumed, *taken,
        ),
        steps=steps,
    )  # fmt: skip
