"""The finding on the target density, which only Table A-1 tells (section 3 and the appendix)."""

from fractions import Fraction
from typing import NamedTuple

from reference.ledger import Convention
from reference.printed import Rounding
from reference.scheme import Scheme
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
from replication.audit.inference import DENSITY, Admission
from replication.audit.record import Evidence, Finding
from replication.audit.results import Results


class AdmittedNumbers(NamedTuple):
    """The densities that Table A-1 admits, with the drag at either velocity."""

    least: Evidence
    greatest: Evidence
    centered_least: Evidence
    centered_greatest: Evidence


def densities_admitted(results: Results) -> AdmittedNumbers:
    """Return the densities that the table admits, header as printed but the sphere's mass."""
    plain = results.judge.inference(DENSITY)
    middle = results.judge.inference(DENSITY, scheme=Scheme.CENTERED)
    least = prints(
        "least", "7839.6", plain.inner.ends[0], "kg/m^3",
        "least density that the table admits, header as printed but the sphere's mass",
    )  # fmt: skip
    greatest = prints(
        "greatest", "7863.3", plain.inner.ends[1], "kg/m^3",
        "greatest density that the table admits, header as printed but the sphere's mass",
    )  # fmt: skip
    centered_least = prints(
        "centered_least", "7842.5", middle.inner.ends[0], "kg/m^3",
        "least density, drag at the middle velocity",
    )  # fmt: skip
    centered_greatest = prints(
        "centered_greatest", "7864.3", middle.inner.ends[1], "kg/m^3",
        "greatest density, drag at the middle velocity",
    )  # fmt: skip
    return AdmittedNumbers(least, greatest, centered_least, centered_greatest)


class CutNumbers(NamedTuple):
    """The densities that Table A-1 would admit if its digits were cut off."""

    least: Evidence
    greatest: Evidence
    odd: Evidence


def densities_if_cut(results: Results) -> CutNumbers:
    """Return the densities that give most cells with their digits cut off, and the other cells."""
    cut = results.judge.inference(DENSITY, rounding=Rounding.CUT)
    least = prints(
        "cut_least", "7887", cut.inner.ends[0], "kg/m^3",
        "least density that gives all cells but these, digits cut off",
    )  # fmt: skip
    greatest = prints(
        "cut_greatest", "7897", cut.inner.ends[1], "kg/m^3",
        "greatest density that gives all cells but these, digits cut off",
    )  # fmt: skip
    odd = equals(
        "cut_odd", "2", len(cut.odd), "1",
        "cells that no density gives together with the others, digits cut off",
    )  # fmt: skip
    return CutNumbers(least, greatest, odd)


class BoundNumbers(NamedTuple):
    """The proven bounds of the target density, some inputs rounded."""

    least: Evidence
    greatest: Evidence


def bounds_header_rounded(results: Results) -> BoundNumbers:
    """Return the bounds with the header of Table A-1 rounded."""
    header_rounded = results.judge.rounded(DENSITY, Convention()).ends
    least = at_least(
        "possible_least", "7759", header_rounded[0], "kg/m^3",
        "proven lower bound, header as rounded",
    )  # fmt: skip
    greatest = at_most(
        "possible_greatest", "7925", header_rounded[1], "kg/m^3",
        "proven upper bound, header as rounded",
    )  # fmt: skip
    return BoundNumbers(least, greatest)


def bounds_all_rounded(results: Results) -> BoundNumbers:
    """Return the bounds with the header of Table A-1 and the author's choices rounded."""
    all_rounded = results.judge.rounded(DENSITY, Convention(choices_exact=False)).ends
    least = at_least(
        "rounded_least", "7686", all_rounded[0], "kg/m^3",
        "proven lower bound, header and choices as rounded",
    )  # fmt: skip
    greatest = at_most(
        "rounded_greatest", "7999", all_rounded[1], "kg/m^3",
        "proven upper bound, header and choices as rounded",
    )  # fmt: skip
    return BoundNumbers(least, greatest)


class NumbersOf304(NamedTuple):
    """Which of the densities that public sources print for 304 are possible."""

    excluded: Evidence
    chosen: Evidence
    all_printed: Evidence
    as_rounded: Evidence
    with_rounded_header: Evidence


def densities_of_304(results: Results) -> NumbersOf304:
    """Count the densities that the cited sources print for 304, by what admits them."""
    judge, sources = results.judge, results.ledger.sources
    excluded = proves(
        "excluded",
        admits(results, "304-density-sheet", Admission.EXCLUDED)
        and admits(results, "304-density-mill", Admission.EXCLUDED),
        "0.289 lb/in^3 and 8.03 g/cm^3 are proven impossible, header and choices as rounded",
    )
    chosen = proves(
        "chosen", admits(results, "304-density-793", Admission.CHOICES_ROUNDED),
        "7.93 g/cm^3 is possible only if the velocity or the step is rounded, too; drag at the "
        "initial velocity",
    )  # fmt: skip
    printed_for_304 = [source for name, source in sources.items() if "304-density-" in name]
    admissions = [judge.admission(source) for source in printed_for_304]
    all_printed = equals(
        "numbers_304", "10", len(printed_for_304), "1",
        "densities of 304 that the cited sources print",
    )  # fmt: skip
    as_rounded = equals(
        "as_rounded", "2", admissions.count(Admission.AS_ROUNDED), "1",
        "of them admitted as numbers of one or two digits: 7.9 and 8 g/cm^3",
    )  # fmt: skip
    with_rounded_header = equals(
        "with_rounded_header", "4", admissions.count(Admission.HEADER_ROUNDED), "1",
        "of them possible only with a rounded header: 7896 kg/m^3, 0.285, 0.286 and 0.29 lb/in^3",
    )  # fmt: skip
    return NumbersOf304(excluded, chosen, all_printed, as_rounded, with_rounded_header)


def admits(results: Results, source: str, admission: Admission) -> bool:
    """Return whether the evidence admits the density of a public source just so."""
    return results.judge.admission(results.ledger.sources[source]) is admission


@concerning(
    "a1-deceleration-1",
    "a1-deceleration-2",
    "a1-deceleration-3",
    "a1-deceleration-4",
    "a1-velocity-final-1",
    "a1-velocity-final-2",
    "a1-velocity-final-3",
    "a1-velocity-final-4",
    "a1-mass",
    "depth-beta-3",
    "depth-beta-5",
)
def target_density(results: Results) -> Finding:
    """The report never prints the target density that it computed with."""
    text, judge = results.text, results.judge
    plain, middle = judge.inference(DENSITY), judge.inference(DENSITY, scheme=Scheme.CENTERED)
    admitted, cut = densities_admitted(results), densities_if_cut(results)
    header_rounded, all_rounded = bounds_header_rounded(results), bounds_all_rounded(results)
    of_304 = densities_of_304(results)
    textbook = prints(
        "textbook", "7861", results.exact("304-density-textbook"), "kg/m^3",
        "what the textbook's table prints for 304",
    )  # fmt: skip
    named = proves(
        "named", admits(results, "304-density-textbook", Admission.ADMITTED),
        "what the textbook's table prints for 304 is admitted",
    )  # fmt: skip
    centered_mass_greatest = prints(
        "centered_mass_greatest", "7849.84", middle.with_mass.ends[1], "kg/m^3",
        "greatest density with the printed mass, drag at the middle velocity",
    )  # fmt: skip
    mass_greatest = prints(
        "mass_greatest", "7848.86", plain.with_mass.ends[1], "kg/m^3",
        "greatest density with the printed mass",
    )  # fmt: skip
    assumed = equals(
        "assumed", "7850", results.exact(DENSITY), "kg/m^3", "density with which the audit computes"
    )
    edge = equals(
        "edge", "3.115E+08", results.ledger.claims["a1-deceleration-1"].target().ends[1], "m/s^2",
        "greatest deceleration that prints like that of row 1",
    )  # fmt: skip
    carbon = proves(
        "carbon", admits(results, "carbon-steel-density", Admission.ADMITTED),
        f"{text('carbon-steel-density')} is admitted, header as printed but the sphere's mass",
    )  # fmt: skip
    depths = proves(
        "depths",
        {results.verdict("depth-beta-3"), results.verdict("depth-beta-5")} == {Verdict.REPRODUCED},
        "each admitted density gives both final depths",
    )
    mass = prints(
        "mass", "4.962E-11", results.computed("a1-mass"), "kg",
        "mass of the sphere, 4/3 pi R^3 rho_p",
    )  # fmt: skip
    all_cells = proves("all", not plain.odd, "one density serves all eight cells")
    steps = (
        calculated("1.0975", Fraction("22") * Fraction("0.05") - Fraction("0.05") ** 2),
        calculated("4.483", 3.115 * 4.962 / (3.14159 * 1.0975)),
        calculated("7.863", (Fraction("4.4829") - Fraction("3.5")) / Fraction("0.125")),
    )
    return conclude(
        "target-density",
        "unstated input",
        title="The target density is printed nowhere; with the sphere's mass Table A-1 admits "
        f"{admitted.least} to {admitted.greatest} kg/m^3",
        statement="With the header of Table A-1 exactly as printed, but the sphere's mass for M, "
        f"its accelerations and velocities come out for {admitted.least} to {admitted.greatest} "
        "kg/m^3, and each of these gives both final depths, too. (With the drag at the middle "
        f"velocity they come out for {admitted.centered_least} to {admitted.centered_greatest}, "
        f"the depths for a part of these.) The usual {text('carbon-steel-density')} of carbon "
        f"steel lies inside, and so does {text('304-density-textbook')} lb/in^3 ({textbook}), "
        "which a textbook's table prints for 304 stainless steel, the target that the report "
        f"names. The cited sources print {of_304.all_printed} densities for 304, "
        f"{text('304-density-textbook')} lb/in^3 to {text('304-density-mill')} g/cm^3: this one "
        f"lies inside, {of_304.as_rounded} more do as numbers of one or two digits, and "
        f"{of_304.with_rounded_header} only if the header is rounded, too. Now let radius, "
        "particle density and resistance (then not beta times the flow stress) be rounded, with "
        "the sphere's mass and the drag at the initial velocity. With "
        f"{text('a1-initial-velocity')} m/s and {text('a-step')} ns exact no density outside "
        f"{header_rounded.least} to {header_rounded.greatest} is possible, so "
        f"{text('304-density-793')} g/cm^3 is excluded. With these two rounded as well, none "
        f"outside {all_rounded.least} to {all_rounded.greatest} is (bounds that are proven, but "
        f"wider than need be): {text('304-density-793')} is possible, {text('304-density-sheet')} "
        f"lb/in^3 and {text('304-density-mill')} g/cm^3 are still excluded. With another mass than "
        "the sphere's more are possible. With the header exactly as printed, its mass included, "
        f"none above {mass_greatest} is ({centered_mass_greatest} with the drag at the middle "
        f"velocity), so not {assumed}. Were the digits of the table cut off instead of rounded, "
        f"its accelerations would ask for {cut.least} to {cut.greatest}, but {cut.odd} of its "
        f"velocities would come out for no density. The audit computes with {assumed}; what it "
        "calls reproduced holds for all densities that the table admits.",
        by_hand=f"Row 1: a = (rho_t V^2/2 + R_t) pi (D x - x^2)/M must stay below {edge} m/s^2. x "
        f"= {text('a1-depth-1')} m gives D x - x^2 = 22 * 0.05 - 0.05^2 = {steps[0]} square "
        f"micrometres, M = {mass} kg, so rho_t V^2/2 + R_t is below 3.115 * 4.962/(3.14159 * "
        f"1.0975) = {steps[1]} GPa, and rho_t below (4.4829 - 3.5)/0.125 = {steps[2]} g/cm^3.",
        settle="The density cell of the original spreadsheet.",
        status="open",
        evidence=(
            *admitted, *header_rounded, textbook, named, centered_mass_greatest, *cut,
            mass_greatest, assumed, edge, carbon, *all_rounded, *of_304, depths, mass, all_cells,
        ),
        steps=steps,
    )  # fmt: skip
