"""Findings on the report's spreadsheet: what Table A-1 admits, and how its scheme can be read."""

import math
from fractions import Fraction

from reference.enclosure import find_solutions
from reference.ledger import Convention
from reference.printed import Rounding
from reference.scheme import Scheme
from replication.audit.assessment import Verdict
from replication.audit.explain import SHEET_BUDGET
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
from replication.audit.record import Finding
from replication.audit.results import Results, case
from replication.models import depth, sheet


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
def target_density(audit: Results) -> Finding:
    """The report never prints the target density that it computed with."""
    text, judge, sources = audit.text, audit.judge, audit.ledger.sources
    plain, middle = judge.inference(DENSITY), judge.inference(DENSITY, scheme=Scheme.CENTERED)
    cut = judge.inference(DENSITY, rounding=Rounding.CUT)
    header_rounded = judge.rounded(DENSITY, Convention()).ends
    all_rounded = judge.rounded(DENSITY, Convention(choices_exact=False)).ends
    unit = "kg/m^3"

    def admits(source: str, admission: Admission) -> bool:
        return judge.admission(sources[source]) is admission

    least = prints(
        "least", "7839.6", plain.inner.ends[0], unit,
        "least density that the table admits, header as printed but the sphere's mass",
    )  # fmt: skip
    greatest = prints(
        "greatest", "7863.3", plain.inner.ends[1], unit,
        "greatest density that the table admits, header as printed but the sphere's mass",
    )  # fmt: skip
    centered_least = prints(
        "centered_least", "7842.5", middle.inner.ends[0], unit,
        "least density, drag at the middle velocity",
    )  # fmt: skip
    centered_greatest = prints(
        "centered_greatest", "7864.3", middle.inner.ends[1], unit,
        "greatest density, drag at the middle velocity",
    )  # fmt: skip
    possible_least = at_least(
        "possible_least", "7759", header_rounded[0], unit, "proven lower bound, header as rounded"
    )
    possible_greatest = at_most(
        "possible_greatest", "7925", header_rounded[1], unit,
        "proven upper bound, header as rounded",
    )  # fmt: skip
    textbook = prints(
        "textbook", "7861", audit.exact("304-density-textbook"), unit,
        "what the textbook's table prints for 304",
    )  # fmt: skip
    named = proves(
        "named", admits("304-density-textbook", Admission.ADMITTED),
        "what the textbook's table prints for 304 is admitted",
    )  # fmt: skip
    centered_mass_greatest = prints(
        "centered_mass_greatest", "7849.84", middle.with_mass.ends[1], unit,
        "greatest density with the printed mass, drag at the middle velocity",
    )  # fmt: skip
    cut_least = prints(
        "cut_least", "7887", cut.inner.ends[0], unit,
        "least density that gives all cells but these, digits cut off",
    )  # fmt: skip
    cut_greatest = prints(
        "cut_greatest", "7897", cut.inner.ends[1], unit,
        "greatest density that gives all cells but these, digits cut off",
    )  # fmt: skip
    cut_odd = equals(
        "cut_odd", "2", len(cut.odd), "1",
        "cells that no density gives together with the others, digits cut off",
    )  # fmt: skip
    mass_greatest = prints(
        "mass_greatest", "7848.86", plain.with_mass.ends[1], unit,
        "greatest density with the printed mass",
    )  # fmt: skip
    assumed = equals(
        "assumed", "7850", audit.exact(DENSITY), unit, "density with which the audit computes"
    )
    edge = equals(
        "edge", "3.115E+08", audit.ledger.claims["a1-deceleration-1"].target().ends[1], "m/s^2",
        "greatest deceleration that prints like that of row 1",
    )  # fmt: skip
    carbon = proves(
        "carbon", admits("carbon-steel-density", Admission.ADMITTED),
        f"{audit.text('carbon-steel-density')} is admitted, header as printed but the sphere's "
        "mass",
    )  # fmt: skip
    rounded_least = at_least(
        "rounded_least", "7686", all_rounded[0], unit,
        "proven lower bound, header and choices as rounded",
    )  # fmt: skip
    rounded_greatest = at_most(
        "rounded_greatest", "7999", all_rounded[1], unit,
        "proven upper bound, header and choices as rounded",
    )  # fmt: skip
    excluded = proves(
        "excluded",
        admits("304-density-sheet", Admission.EXCLUDED)
        and admits("304-density-mill", Admission.EXCLUDED),
        "0.289 lb/in^3 and 8.03 g/cm^3 are proven impossible, header and choices as rounded",
    )
    chosen = proves(
        "chosen", admits("304-density-793", Admission.CHOICES_ROUNDED),
        "7.93 g/cm^3 is possible only if the velocity or the step is rounded, too; drag at the "
        "initial velocity",
    )  # fmt: skip
    printed_for_304 = [source for name, source in sources.items() if "304-density-" in name]
    admissions = [judge.admission(source) for source in printed_for_304]
    numbers_304 = equals(
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
    depths = proves(
        "depths",
        {audit.verdict("depth-beta-3"), audit.verdict("depth-beta-5")} == {Verdict.REPRODUCED},
        "each admitted density gives both final depths",
    )
    mass = prints(
        "mass", "4.962E-11", audit.computed("a1-mass"), "kg",
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
        f"{least} to {greatest} kg/m^3",
        statement="With the header of Table A-1 exactly as printed, but the sphere's mass for M, "
        f"its accelerations and velocities come out for {least} to {greatest} kg/m^3, and each of "
        "these gives both final depths, too. (With the drag at the middle velocity they come out "
        f"for {centered_least} to {centered_greatest}, the depths for a part of these.) The usual "
        f"{text('carbon-steel-density')} of carbon steel lies inside, and so does "
        f"{text('304-density-textbook')} lb/in^3 ({textbook}), which a textbook's table prints for "
        "304 stainless steel, the target that the report names. The cited sources print "
        f"{numbers_304} densities for 304, {text('304-density-textbook')} lb/in^3 to "
        f"{text('304-density-mill')} g/cm^3: this one lies inside, {as_rounded} more do as numbers "
        f"of one or two digits, and {with_rounded_header} only if the header is rounded, too. Now "
        "let radius, particle density and resistance (then not beta times the flow stress) be "
        "rounded, with the sphere's mass and the drag at the initial velocity. With "
        f"{text('a1-initial-velocity')} m/s and {text('a-step')} ns exact no density outside "
        f"{possible_least} to {possible_greatest} is possible, so {text('304-density-793')} g/cm^3 "
        f"is excluded. With these two rounded as well, none outside {rounded_least} to "
        f"{rounded_greatest} is (bounds that are proven, but wider than need be): "
        f"{text('304-density-793')} is possible, {text('304-density-sheet')} lb/in^3 and "
        f"{text('304-density-mill')} g/cm^3 are still excluded. With another mass than the "
        "sphere's more are possible. With the header exactly as printed, its mass included, none "
        f"above {mass_greatest} is ({centered_mass_greatest} with the drag at the middle "
        f"velocity), so not {assumed}. Were the digits of the table cut off instead of rounded, "
        f"its accelerations would ask for {cut_least} to {cut_greatest}, but {cut_odd} of its "
        f"velocities would come out for no density. The audit computes with {assumed}; what it "
        "calls reproduced holds for all densities that the table admits.",
        by_hand=f"Row 1: a = (rho_t V^2/2 + R_t) pi (D x - x^2)/M must stay below {edge} m/s^2. x "
        f"= {text('a1-depth-1')} m gives D x - x^2 = 22 * 0.05 - 0.05^2 = {steps[0]} square "
        f"micrometres, M = {mass} kg, so rho_t V^2/2 + R_t is below 3.115 * 4.962/(3.14159 * "
        f"1.0975) = {steps[1]} GPa, and rho_t below (4.4829 - 3.5)/0.125 = {steps[2]} g/cm^3.",
        settle="The density cell of the original spreadsheet.",
        status="open",
        evidence=(
            least, greatest, centered_least, centered_greatest, possible_least, possible_greatest,
            textbook, named, centered_mass_greatest, cut_least, cut_greatest, cut_odd,
            mass_greatest, assumed, edge, carbon, rounded_least, rounded_greatest, excluded, chosen,
            numbers_304, as_rounded, with_rounded_header, depths, mass, all_cells,
        ),
        steps=steps,
    )  # fmt: skip


def observed_order(audit: Results, scheme: Scheme) -> float:
    """Return the observed order of the error at one instant, from two time steps, for beta = 5.

    At 10 ns the particle is still fast, so that the stop rule has no influence. The steps are the
    report's and its half.
    """
    instant, errors = 10e-9, []
    for parts in (1, 2):
        impact = case(audit, 5, step=audit["a-step"] / parts)
        row = sheet.run(impact, scheme).rows[round(instant / impact.step)]
        assert row.velocity_final is not None
        # The row's depth is that half a step before its final velocity.
        reached = row.depth + row.velocity_final * impact.step / 2
        errors.append(reached - depth.depth_at_velocity(row.velocity_final, **impact.motion))
    return math.log2(errors[0] / errors[1])


def first_difference(audit: Results) -> int:
    """Return the first row in which the schemes' decelerations differ in three digits."""
    plain, middle = (sheet.run(case(audit, 5), scheme).rows for scheme in Scheme)
    for number, (row, row_middle) in enumerate(zip(plain, middle, strict=False)):
        if f"{row.deceleration:.2E}" != f"{row_middle.deceleration:.2E}":
            return number
    raise ValueError("the two schemes print the same decelerations in every row")


def least_middle_density(audit: Results) -> Fraction:
    """Return the least target density with which drag at the middle velocity gives that depth."""
    claim = audit.ledger.claims["depth-beta-5"]
    printed = {name: audit.ledger.value(name) for name in claim.stated}
    function = audit.ledger.function(claim, scheme=Scheme.CENTERED)
    admitted = audit.judge.inference(DENSITY, scheme=Scheme.CENTERED).outer.ends
    solutions = find_solutions(function, DENSITY, admitted, claim.target(), SHEET_BUDGET, printed)
    return solutions.outer[0][0]


def depth_by_sheet(audit: Results, beta: int, scheme: Scheme, step: str = "a-step") -> float:
    """Return the sheet's final depth [m] for a beta of the report; the claim gives the step."""
    return sheet.run(case(audit, beta, step=audit[step]), scheme).final_depth


@concerning(
    "depth-beta-3", "depth-beta-5", "coarse-step-remark", "a-half-step", "a-step", "coarse-step"
)
def two_schemes(audit: Results) -> Finding:
    """The appendix does not say at which velocity of a step the drag is taken."""
    text = audit.text
    plain, middle = Scheme.PUBLISHED, Scheme.CENTERED
    order_plain = prints(
        "order_plain", "1.0", observed_order(audit, plain), "1",
        "observed order of the time-step error, drag at the initial velocity, 0.2 to 0.1 ns",
    )  # fmt: skip
    order_middle = prints(
        "order_middle", "2.0", observed_order(audit, middle), "1",
        "observed order of the time-step error, drag at the middle velocity, 0.2 to 0.1 ns",
    )  # fmt: skip
    cells = [
        claim
        for claim in audit.ledger.claims.values()
        if claim.is_computed and claim.id.startswith(("a1-deceleration-", "a1-velocity-"))
    ]
    table = proves(
        "table",
        {
            judgement.verdict
            for claim in cells
            for reading in audit.judge.assess(claim).readings
            for judgement in reading.judgements
            if judgement.convention.rounding is Rounding.AWAY
        }
        == {Verdict.REPRODUCED},
        "every cell of Table A-1 is reproduced by both",
    )
    fine = {(b, s): depth_by_sheet(audit, b, s) for b in (3, 5) for s in Scheme}
    coarse = {(b, s): depth_by_sheet(audit, b, s, "coarse-step") for b in (3, 5) for s in Scheme}
    rest = {b: depth.final_depth(**case(audit, b).motion) for b in (3, 5)}
    plain_fine_3 = prints(
        "plain_fine_3", "10.031", fine[3, plain], "um",
        "final depth at 0.2 ns, beta = 3, drag at the initial velocity",
    )  # fmt: skip
    plain_fine_5 = prints("plain_fine_5", "7.6696", fine[5, plain], "um", "the same, beta = 5")
    plain_coarse_3 = prints(
        "plain_coarse_3", "10.017", coarse[3, plain], "um",
        "final depth at 0.5 ns, beta = 3, drag at the initial velocity",
    )  # fmt: skip
    plain_coarse_5 = prints(
        "plain_coarse_5", "7.6603", coarse[5, plain], "um", "the same, beta = 5"
    )
    middle_fine_3 = prints(
        "middle_fine_3", "10.039", fine[3, middle], "um",
        "final depth at 0.2 ns, beta = 3, drag at the middle velocity",
    )  # fmt: skip
    middle_fine_5 = prints("middle_fine_5", "7.6749", fine[5, middle], "um", "the same, beta = 5")
    middle_coarse_3 = prints(
        "middle_coarse_3", "10.039", coarse[3, middle], "um",
        "final depth at 0.5 ns, beta = 3, drag at the middle velocity",
    )  # fmt: skip
    middle_coarse_5 = prints(
        "middle_coarse_5", "7.6744", coarse[5, middle], "um", "the same, beta = 5"
    )
    change_3 = prints(
        "change_3", "0.14", 1 - coarse[3, plain] / fine[3, plain], "percent",
        "loss of depth from 0.2 to 0.5 ns, beta = 3, drag at the initial velocity",
    )  # fmt: skip
    change_5 = prints(
        "change_5", "0.12", 1 - coarse[5, plain] / fine[5, plain], "percent", "the same, beta = 5"
    )
    middle_change_5 = prints(
        "middle_change_5", "0.007", 1 - coarse[5, middle] / fine[5, middle], "percent",
        "the same, beta = 5, drag at the middle velocity",
    )  # fmt: skip
    nm_3 = prints(
        "nm_3", "14.0", fine[3, plain] - coarse[3, plain], "nm",
        "that loss, beta = 3, drag at the initial velocity",
    )  # fmt: skip
    nm_5 = prints("nm_5", "9.3", fine[5, plain] - coarse[5, plain], "nm", "that loss, beta = 5")
    reprinted = equals(
        "reprinted", "7.66", Fraction(f"{coarse[5, plain]:.2e}"), "um",
        "final depth at 0.5 ns as printed, beta = 5, drag at the initial velocity",
    )  # fmt: skip
    middle_density = prints(
        "middle_density", "7848.4", least_middle_density(audit), "kg/m^3",
        "density above which the drag at the middle velocity gives the printed depth, beta = 5",
    )  # fmt: skip
    number = first_difference(audit)
    rows = {scheme: sheet.run(case(audit, 5), scheme).rows[number] for scheme in Scheme}
    row = equals(
        "row", "12", number, "1",
        f"first row whose deceleration prints otherwise, beta = 5, {audit.assumed_density}",
    )  # fmt: skip
    row_plain = prints(
        "row_plain", "6.73E+09", rows[plain].deceleration, "m/s^2",
        "deceleration there, drag at the initial velocity",
    )  # fmt: skip
    row_middle = prints(
        "row_middle", "6.72E+09", rows[middle].deceleration, "m/s^2",
        "deceleration there, drag at the middle velocity",
    )  # fmt: skip
    short_3 = prints(
        "short_3", "8.80", rest[3] - fine[3, plain], "nm",
        "exact depth at rest minus the sheet's at 0.2 ns, beta = 3",
    )  # fmt: skip
    short_5 = prints(
        "short_5", "5.38", rest[5] - fine[5, plain], "nm",
        "exact depth at rest minus the sheet's at 0.2 ns, beta = 5",
    )  # fmt: skip
    coarse_short_5 = prints(
        "coarse_short_5", "14.6", rest[5] - coarse[5, plain], "nm",
        "exact depth at rest minus the sheet's at 0.5 ns, beta = 5",
    )  # fmt: skip
    exact_3 = prints("exact_3", "10.0395", rest[3], "um", "exact depth at rest, beta = 3")
    exact_5 = prints("exact_5", "7.6749", rest[5], "um", "exact depth at rest, beta = 5")
    density = audit.exact("carbon-steel-density")
    steps = (
        calculated("0.3736", 4 * 8900 / (3 * density) * math.log(1 + 0.98125 / 3.5)),
        calculated("0.3736", 0.6977**2 - 0.6977**3 / 3),
        calculated("7.675", 0.69772 * 11),
        calculated("13.4", 5.376 * (audit["coarse-step"] / audit["a-step"])),
        calculated("7.660", 7.6749 - 0.0146),
    )
    return conclude(
        "two-schemes",
        "method",
        title="Two schemes fit what is printed, and no printed number decides between them",
        statement="The appendix takes the depth in the middle of a time step and calls the result "
        "a mid-point approximation of the acceleration; it never says at which velocity the drag "
        "is taken. With the velocity at the start of the row the time-step error is proportional "
        f"to the step (observed order {order_plain}); with that in the middle, predicted by half a "
        f"step, to its square ({order_middle}). Where the last row falls adds a small part that "
        f"follows no order. Both print every cell of Table A-1, {text('depth-beta-3')} and "
        f"{text('depth-beta-5')} um; with the header exactly as printed, but the sphere's mass, "
        f"the second gives {text('depth-beta-5')} only for target densities above {middle_density} "
        f"kg/m^3, a part of those that the table admits. At {text('coarse-step')} ns the first "
        f"gives {plain_coarse_3} and {plain_coarse_5} um, {change_3} % and {change_5} % less than "
        f"at {text('a-step')} ns: less than one unit of the last printed digit, but with the "
        f"inputs as printed {text('depth-beta-5')} would print {reprinted}. The second gives "
        f"{middle_coarse_3} and {middle_coarse_5} um, and both print as before: read so, \"the "
        "results did not change significantly\" is plainly true. With "
        f"{text('carbon-steel-density')} kg/m^3 the first deceleration that tells the schemes "
        f"apart, printed to three digits, would be that of row {row}: {row_plain} or {row_middle} "
        "m/s^2. The table has no column of middle velocities, which speaks for the first scheme; "
        "the audit takes it unless told otherwise. The first scheme's final depths are "
        f"{short_3} and {short_5} nm short of the exact ones, {exact_3} and {exact_5} um.",
        by_hand=f"Exact for beta = 5: c = 4 * 8900/(3 * {text('carbon-steel-density')}) * ln(1 + "
        f"0.98125/3.5) = {steps[0]}, and y^2 - y^3/3 = c: 0.6977^2 - 0.6977^3/3 = {steps[1]}, so X "
        f"= 0.69772 * 11 = {steps[2]} um. If the error is proportional to the step, {short_5} nm "
        f"at {text('a-step')} ns become 5.376 * {text('coarse-step')}/{text('a-step')} = "
        f"{steps[3]} nm at {text('coarse-step')} ns; where the last row happens to fall makes it "
        f"{coarse_short_5} nm: 7.6749 - 0.0146 = {steps[4]} um.",
        settle="The formula in the acceleration column of the original spreadsheet.",
        status="open",
        evidence=(
            order_plain, order_middle, table, plain_fine_3, plain_fine_5, plain_coarse_3,
            plain_coarse_5, middle_fine_3, middle_fine_5, middle_coarse_3, middle_coarse_5,
            change_3, change_5, middle_change_5, nm_3, nm_5, reprinted, middle_density, row,
            row_plain, row_middle, short_3, short_5, coarse_short_5, exact_3, exact_5,
        ),
        steps=steps,
    )  # fmt: skip


def velocity_if_added(audit: Results) -> float:
    """Return the velocity after three rows of a sheet that adds a dt instead of subtracting it."""
    impact = case(audit, 5)
    fixed = (impact.radius, impact.mass, impact.target_density, impact.target_resistance)
    x, v = 0.0, impact.velocity
    for row in range(3):
        x += v * impact.step * (1 if row else 0.5)
        v += sheet.deceleration(x, v, *fixed) * impact.step
    return v


@concerning(
    "a1-depth-1",
    "a1-time-1",
    "a-half-step",
    "a1-deceleration-1",
    "a1-deceleration-2",
    "a1-deceleration-3",
    "a1-velocity-final-3",
)
def table_columns(audit: Results) -> Finding:
    """The columns of Table A-1 do not hold what their heads and their times suggest."""
    text = audit.text
    reached = prints(
        "exact", "1.00E-07", audit.exact("a1-initial-velocity") * audit.exact("a1-time-1"), "m",
        "V times the time of row 1",
    )  # fmt: skip
    plus = prints(
        "plus", "500.56", velocity_if_added(audit), "m/s",
        "final velocity of row 3 if the accelerations were added",
    )  # fmt: skip
    minus = prints(
        "minus", "499.44", audit.computed("a1-velocity-final-3"), "m/s",
        "final velocity of row 3 as they are subtracted",
    )  # fmt: skip
    steps = (
        calculated("0.00000005", 500 * Fraction("0.1") / 10**9),
        calculated("0.556", (Fraction("3.11") + Fraction("9.30") + Fraction("15.4")) / 50),
    )
    return conclude(
        "table-columns",
        "wording",
        title="In Table A-1 x is half a step behind its time, and the d²x/dt² column is the "
        "deceleration",
        statement=f"Row 1 has the time {text('a1-time-1')} s and x = {text('a1-depth-1')} m; at "
        f"that time the particle is {reached} m deep. The table's x belongs to the middle of the "
        "row, its final velocity to the end: a curve of x against that time, as Figure 3 may be, "
        f"lags by {text('a-half-step')} ns. The final depth is hardly affected, as the velocity is "
        "nearly zero there. The column d²x/dt² prints positive numbers, though the particle slows "
        f"down. With the sign as printed row 3 would end at {plus} m/s; the table prints "
        f"{text('a1-velocity-final-3')}, which is what subtracting gives ({minus}).",
        by_hand=f"500 * 0.1/10^9 = {steps[0]} m; (3.11 + 9.30 + 15.4) * 0.02 = {steps[1]} m/s are "
        "lost in three rows.",
        settle="Nothing is open.",
        status="explained",
        evidence=(reached, plus, minus),
        steps=steps,
    )  # fmt: skip
