"""Findings on the report's spreadsheet: how its scheme can be read, and what its columns hold."""

import math
from collections.abc import Mapping
from fractions import Fraction
from typing import NamedTuple

from reference.enclosure import find_solutions
from reference.printed import Rounding, decimal_text
from reference.scheme import Scheme
from reference.units import to_si
from replication.audit.assessment import Verdict
from replication.audit.explain import SHEET_BUDGET
from replication.audit.findings.evidence import (
    calculated,
    concerning,
    conclude,
    equals,
    prints,
    proves,
)
from replication.audit.inference import DENSITY
from replication.audit.record import Evidence, Finding
from replication.audit.results import Results, case, density_taken
from replication.models import depth, sheet


def observed_order(results: Results, scheme: Scheme) -> float:
    """Return the observed order of the error at one instant, from two time steps, for beta = 5.

    At 10 ns the particle is still fast, so that the stop rule has no influence. The steps are the
    report's and its half.
    """
    instant, errors = 10e-9, []
    for parts in (1, 2):
        impact = case(results, 5, step=results["a-step"] / parts)
        row = sheet.run(impact, scheme).rows[round(instant / impact.step)]
        assert row.velocity_final is not None
        # The row's depth is that half a step before its final velocity.
        reached = row.depth + row.velocity_final * impact.step / 2
        errors.append(reached - depth.depth_at_velocity(row.velocity_final, **impact.motion))
    return math.log2(errors[0] / errors[1])


def first_difference(results: Results) -> int:
    """Return the first row in which the schemes' decelerations differ in three digits."""
    plain, middle = (sheet.run(case(results, 5), scheme).rows for scheme in Scheme)
    for number, (row, row_middle) in enumerate(zip(plain, middle, strict=False)):
        if f"{row.deceleration:.2E}" != f"{row_middle.deceleration:.2E}":
            return number
    raise ValueError("the two schemes print the same decelerations in every row")


def least_middle_density(results: Results) -> Fraction:
    """Return the least target density with which drag at the middle velocity gives that depth."""
    claim = results.ledger.claims["depth-beta-5"]
    printed = {name: results.ledger.value(name) for name in claim.stated}
    function = results.ledger.function(claim, scheme=Scheme.CENTERED)
    admitted = results.judge.inference(DENSITY, scheme=Scheme.CENTERED).outer.ends
    solutions = find_solutions(function, DENSITY, admitted, claim.target(), SHEET_BUDGET, printed)
    return solutions.outer[0][0]


def depth_by_sheet(results: Results, beta: int, scheme: Scheme, step: str = "a-step") -> float:
    """Return the sheet's final depth [m] for a beta of the report; the claim gives the step."""
    return sheet.run(case(results, beta, step=results[step]), scheme).final_depth


class OrderNumbers(NamedTuple):
    """How accurate the two schemes are, and whether both give Table A-1."""

    plain: Evidence
    middle: Evidence
    table: Evidence


def orders_of_schemes(results: Results) -> OrderNumbers:
    """Return the observed order of both schemes, and whether both give every cell of Table A-1."""
    half = decimal_text(results.exact("a-step") / 2 / to_si("ns"))
    steps = f"{results.text('a-step')} to {half} ns"
    plain = prints(
        "order_plain", "1.0", observed_order(results, Scheme.PUBLISHED), "1",
        f"observed order of the time-step error, drag at the initial velocity, {steps}",
    )  # fmt: skip
    middle = prints(
        "order_middle", "2.0", observed_order(results, Scheme.CENTERED), "1",
        f"observed order of the time-step error, drag at the middle velocity, {steps}",
    )  # fmt: skip
    cells = [
        claim
        for claim in results.ledger.claims.values()
        if claim.is_computed and claim.id.startswith(("a1-deceleration-", "a1-velocity-"))
    ]
    table = proves(
        "table",
        {
            judgement.verdict
            for claim in cells
            for reading in results.judge.assess(claim).readings
            for judgement in reading.judgements
            if judgement.convention.rounding is Rounding.AWAY
        }
        == {Verdict.REPRODUCED},
        "every cell of Table A-1 is reproduced by both",
    )
    return OrderNumbers(plain, middle, table)


Depths = Mapping[tuple[int, Scheme], float]
"""The sheet's final depth [m] by beta and scheme."""


def depths_by_sheet(results: Results, step: str) -> Depths:
    """Return the final depths of both cases by both schemes; the claim gives the step."""
    return {(b, s): depth_by_sheet(results, b, s, step) for b in (3, 5) for s in Scheme}


class DepthNumbers(NamedTuple):
    """The sheet's final depths by scheme, time step and beta."""

    plain_fine_3: Evidence
    plain_fine_5: Evidence
    plain_coarse_3: Evidence
    plain_coarse_5: Evidence
    middle_fine_3: Evidence
    middle_fine_5: Evidence
    middle_coarse_3: Evidence
    middle_coarse_5: Evidence


def depths_of_schemes(results: Results, fine: Depths, coarse: Depths) -> DepthNumbers:
    """Return the final depths with a fine and a coarse time step."""
    fine_step, coarse_step = results.text("a-step"), results.text("coarse-step")
    plain, middle = Scheme.PUBLISHED, Scheme.CENTERED
    plain_fine_3 = prints(
        "plain_fine_3", "10.031", fine[3, plain], "um",
        f"final depth at {fine_step} ns, beta = 3, drag at the initial velocity",
    )  # fmt: skip
    plain_fine_5 = prints("plain_fine_5", "7.6696", fine[5, plain], "um", "the same, beta = 5")
    plain_coarse_3 = prints(
        "plain_coarse_3", "10.017", coarse[3, plain], "um",
        f"final depth at {coarse_step} ns, beta = 3, drag at the initial velocity",
    )  # fmt: skip
    plain_coarse_5 = prints(
        "plain_coarse_5", "7.6603", coarse[5, plain], "um", "the same, beta = 5"
    )
    middle_fine_3 = prints(
        "middle_fine_3", "10.039", fine[3, middle], "um",
        f"final depth at {fine_step} ns, beta = 3, drag at the middle velocity",
    )  # fmt: skip
    middle_fine_5 = prints("middle_fine_5", "7.6749", fine[5, middle], "um", "the same, beta = 5")
    middle_coarse_3 = prints(
        "middle_coarse_3", "10.039", coarse[3, middle], "um",
        f"final depth at {coarse_step} ns, beta = 3, drag at the middle velocity",
    )  # fmt: skip
    middle_coarse_5 = prints(
        "middle_coarse_5", "7.6744", coarse[5, middle], "um", "the same, beta = 5"
    )
    return DepthNumbers(
        plain_fine_3, plain_fine_5, plain_coarse_3, plain_coarse_5,
        middle_fine_3, middle_fine_5, middle_coarse_3, middle_coarse_5,
    )  # fmt: skip


class ChangeNumbers(NamedTuple):
    """What the coarse time step changes."""

    of_3: Evidence
    of_5: Evidence
    middle_5: Evidence
    nm_3: Evidence
    nm_5: Evidence
    reprinted: Evidence


def changes_by_step(results: Results, fine: Depths, coarse: Depths) -> ChangeNumbers:
    """Return the loss of depth with a coarse time step, and the depth as it would print."""
    fine_step, coarse_step = results.text("a-step"), results.text("coarse-step")
    plain, middle = Scheme.PUBLISHED, Scheme.CENTERED
    of_3 = prints(
        "change_3", "0.14", 1 - coarse[3, plain] / fine[3, plain], "percent",
        f"loss of depth from {fine_step} to {coarse_step} ns, beta = 3, drag at the initial "
        "velocity",
    )  # fmt: skip
    of_5 = prints(
        "change_5", "0.12", 1 - coarse[5, plain] / fine[5, plain], "percent", "the same, beta = 5"
    )
    middle_5 = prints(
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
        f"final depth at {coarse_step} ns as printed, beta = 5, drag at the initial velocity",
    )  # fmt: skip
    return ChangeNumbers(of_3, of_5, middle_5, nm_3, nm_5, reprinted)


class RowNumbers(NamedTuple):
    """The first row of the sheet that tells the schemes apart."""

    number: Evidence
    plain: Evidence
    middle: Evidence


def row_that_differs(results: Results) -> RowNumbers:
    """Return the first row whose deceleration the schemes print otherwise, and both."""
    first = first_difference(results)
    rows = {scheme: sheet.run(case(results, 5), scheme).rows[first] for scheme in Scheme}
    number = equals(
        "row", "12", first, "1",
        f"first row whose deceleration prints otherwise, beta = 5, {density_taken(results)}",
    )  # fmt: skip
    plain = prints(
        "row_plain", "6.73E+09", rows[Scheme.PUBLISHED].deceleration, "m/s^2",
        "deceleration there, drag at the initial velocity",
    )  # fmt: skip
    middle = prints(
        "row_middle", "6.72E+09", rows[Scheme.CENTERED].deceleration, "m/s^2",
        "deceleration there, drag at the middle velocity",
    )  # fmt: skip
    return RowNumbers(number, plain, middle)


class ExactNumbers(NamedTuple):
    """The exact depths at rest, and how far the sheet's fall short of them."""

    short_3: Evidence
    short_5: Evidence
    coarse_short_5: Evidence
    exact_3: Evidence
    exact_5: Evidence


def short_of_exact(results: Results, fine: Depths, coarse: Depths) -> ExactNumbers:
    """Return the exact depths, and by how much the sheet's, drag at the initial velocity, fail."""
    plain = Scheme.PUBLISHED
    fine_step, coarse_step = results.text("a-step"), results.text("coarse-step")
    rest = {b: depth.final_depth(**case(results, b).motion) for b in (3, 5)}
    short_3 = prints(
        "short_3", "8.80", rest[3] - fine[3, plain], "nm",
        f"exact depth at rest minus the sheet's at {fine_step} ns, beta = 3",
    )  # fmt: skip
    short_5 = prints(
        "short_5", "5.38", rest[5] - fine[5, plain], "nm",
        f"exact depth at rest minus the sheet's at {fine_step} ns, beta = 5",
    )  # fmt: skip
    coarse_short_5 = prints(
        "coarse_short_5", "14.6", rest[5] - coarse[5, plain], "nm",
        f"exact depth at rest minus the sheet's at {coarse_step} ns, beta = 5",
    )  # fmt: skip
    exact_3 = prints("exact_3", "10.0395", rest[3], "um", "exact depth at rest, beta = 3")
    exact_5 = prints("exact_5", "7.6749", rest[5], "um", "exact depth at rest, beta = 5")
    return ExactNumbers(short_3, short_5, coarse_short_5, exact_3, exact_5)


@concerning(
    "depth-beta-3", "depth-beta-5", "coarse-step-remark", "a-half-step", "a-step", "coarse-step"
)
def two_schemes(results: Results) -> Finding:
    """The appendix does not say at which velocity of a step the drag is taken."""
    text, orders = results.text, orders_of_schemes(results)
    fine, coarse = depths_by_sheet(results, "a-step"), depths_by_sheet(results, "coarse-step")
    reached, change = (
        depths_of_schemes(results, fine, coarse),
        changes_by_step(results, fine, coarse),
    )
    row, at_rest = row_that_differs(results), short_of_exact(results, fine, coarse)
    middle_density = prints(
        "middle_density", "7848.4", least_middle_density(results), "kg/m^3",
        "density above which the drag at the middle velocity gives the printed depth, beta = 5",
    )  # fmt: skip
    density = results.exact("carbon-steel-density")
    steps = (
        calculated("0.3736", 4 * 8900 / (3 * density) * math.log(1 + 0.98125 / 3.5)),
        calculated("0.3736", 0.6977**2 - 0.6977**3 / 3),
        calculated("7.675", 0.69772 * 11),
        calculated("13.4", 5.376 * (results["coarse-step"] / results["a-step"])),
        calculated("7.660", 7.6749 - 0.0146),
    )
    return conclude(
        "two-schemes",
        "method",
        title="Two schemes fit what is printed, and no printed number decides between them",
        statement="The appendix takes the depth in the middle of a time step and calls the result "
        "a mid-point approximation of the acceleration; it never says at which velocity the drag "
        "is taken. With the velocity at the start of the row the time-step error is proportional "
        f"to the step (observed order {orders.plain}); with that in the middle, predicted by half "
        f"a step, to its square ({orders.middle}). Where the last row falls adds a small part that "
        f"follows no order. Both print every cell of Table A-1, {text('depth-beta-3')} and "
        f"{text('depth-beta-5')} um; with the header exactly as printed, but the sphere's mass, "
        f"the second gives {text('depth-beta-5')} only for target densities above {middle_density} "
        f"kg/m^3, a part of those that the table admits. At {text('coarse-step')} ns the first "
        f"gives {reached.plain_coarse_3} and {reached.plain_coarse_5} um, {change.of_3} % and "
        f"{change.of_5} % less than at {text('a-step')} ns: less than one unit of the last printed "
        f"digit, but with the inputs as printed {text('depth-beta-5')} would print "
        f"{change.reprinted}. The second gives {reached.middle_coarse_3} and "
        f'{reached.middle_coarse_5} um, and both print as before: read so, "the results did not '
        f"change significantly\" is plainly true. With {text('carbon-steel-density')} kg/m^3 the "
        "first deceleration that tells the schemes apart, printed to three digits, would be that "
        f"of row {row.number}: {row.plain} or {row.middle} m/s^2. The table has no column of "
        "middle velocities, which speaks for the first scheme; the audit takes it unless told "
        f"otherwise. The first scheme's final depths are {at_rest.short_3} and {at_rest.short_5} "
        f"nm short of the exact ones, {at_rest.exact_3} and {at_rest.exact_5} um.",
        by_hand=f"Exact for beta = 5: c = 4 * 8900/(3 * {text('carbon-steel-density')}) * ln(1 + "
        f"0.98125/3.5) = {steps[0]}, and y^2 - y^3/3 = c: 0.6977^2 - 0.6977^3/3 = {steps[1]}, so X "
        f"= 0.69772 * 11 = {steps[2]} um. If the error is proportional to the step, "
        f"{at_rest.short_5} nm at {text('a-step')} ns become 5.376 * "
        f"{text('coarse-step')}/{text('a-step')} = {steps[3]} nm at {text('coarse-step')} ns; "
        f"where the last row happens to fall makes it {at_rest.coarse_short_5} nm: 7.6749 - 0.0146 "
        f"= {steps[4]} um.",
        settle="The formula in the acceleration column of the original spreadsheet.",
        status="open",
        evidence=(*orders, *reached, *change, middle_density, *row, *at_rest),
        steps=steps,
    )  # fmt: skip


def velocity_if_added(results: Results) -> float:
    """Return the velocity after three rows of a sheet that adds a dt instead of subtracting it."""
    impact = case(results, 5)
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
def table_columns(results: Results) -> Finding:
    """The columns of Table A-1 do not hold what their heads and their times suggest."""
    text = results.text
    reached = prints(
        "exact", "1.00E-07", results.exact("a1-initial-velocity") * results.exact("a1-time-1"), "m",
        "V times the time of row 1",
    )  # fmt: skip
    plus = prints(
        "plus", "500.56", velocity_if_added(results), "m/s",
        "final velocity of row 3 if the accelerations were added",
    )  # fmt: skip
    minus = prints(
        "minus", "499.44", results.computed("a1-velocity-final-3"), "m/s",
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
