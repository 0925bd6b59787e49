"""The live workbook of the report, or of one case: its plan, its values by key, and its file.

The models compute the values without any knowledge of the formulas. A value and the formula that
must give it meet in one cell, which the plan's `where` names for each key.
"""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import MAX_PREC, ROUND_HALF_UP, Context, Decimal
from fractions import Fraction
from itertools import chain
from typing import Any

from reference.ledger import Convention, Ledger, load
from reference.printed import Interval, Printed
from reference.scheme import Scheme
from reference.units import to_si
from replication.audit.assessment import Verdict
from replication.audit.record import Record
from replication.cases import BETA_3, BETA_5
from replication.error import COARSE, DIGITS, NOTES, OFF_STOP, too_long
from replication.error import warnings as doubts_about
from replication.error.ladder import error_order, ladder
from replication.models import crater, depth, estimates, inverse
from replication.models.impact import Impact, particle_mass
from replication.models.sheet import Row, Sheet, deceleration, run
from replication.text import with_unit
from spreadsheets import emit
from spreadsheets.plan import NOT_AVAILABLE, NOT_COMPUTED, ShownValue, WorkbookPlan
from spreadsheets.sheets import messages, workbook_plan
from spreadsheets.sheets.audit import AS_PRINTED, LIVE_VERDICTS, OTHERWISE, AuditResult
from spreadsheets.sheets.case import CaseSheet, prepared_rows
from spreadsheets.sheets.convergence import LEVELS, NO_ORDER, SMALL, run_inputs
from spreadsheets.sheets.figures import FIGURE_5_POINTS
from spreadsheets.sheets.inputs import NO_NUMBER, YOURS, InputLine, input_lines
from spreadsheets.sheets.solve import MEASURED
from spreadsheets.sheets.table_a1 import ABOVE, DECIMALS, NO_DIFFERENCE, TABLE_ROWS
from spreadsheets.verify import rounding_bound

SERIES_BELOW = 1e-8
"""The workbook takes ln(1 + x) and e^x - 1 as series of two terms for x below this; the third term,
at most x^3/3, is then less than half of the last digit of the first."""

UM3_PER_M3 = 1e18

SAME_WITHIN = 1e-12
"""Numbers that differ by this share are the same to the workbook. Programs that round a conversion
of units differently stay below it; a change that somebody types is above it."""


@dataclass(frozen=True)
class Workbook:
    """A workbook before it is a file.

    warnings: about runs that cannot be trusted. rounding: the largest `rounding_bound` of its runs.
    """

    plan: WorkbookPlan
    values: Mapping[str, ShownValue]
    warnings: Sequence[str]
    rounding: float

    def to_bytes(self) -> bytes:
        """Return the bytes of the .xlsx file."""
        return emit.to_bytes(self.plan, self.values)

    @property
    def cells(self) -> dict[str, dict[str, ShownValue]]:
        """What every cell must show, by sheet and address."""
        return emit.cell_values(self.plan, self.values)


def build_workbook(
    impact: Impact | None = None,
    scheme: Scheme | str = Scheme.PUBLISHED,
    rows: int | None = None,
    record: Record | None = None,
    *,
    ledger: Ledger | None = None,
) -> Workbook:
    """Build the workbook of an impact; without one, the report's own.

    The report's own has both of its cases, and what concerns only the report: the sheets with its
    longer time step, the check of Table A-1, and the audit. scheme: a `Scheme`, or its text. rows:
    how many to prepare after row 0; by default twice as many as the longest case takes. record: the
    finished audit, which is made if it is needed but not given. Each input is rounded to a value
    that its cell can hold. Raises ValueError for an input outside of its limits, or too few rows.

    >>> book = build_workbook(BETA_5)
    >>> place = book.plan.where["depth_um"]
    >>> place[0], f"{book.values['depth_um']:.2f}"
    ('Sheet beta 5', '7.67')
    """
    ledger, scheme, audited = ledger or load(), Scheme(scheme), None
    impacts = {"low": BETA_3, "high": BETA_5} if impact is None else {"case": impact}
    cases = [_case_sheet(slug, of_case, scheme) for slug, of_case in impacts.items()]
    typed = _typed_inputs(input_lines(cases, report=impact is None), impacts, ledger)
    si = {line.name: _si(number, line.unit) for line, number in typed.items()}
    # The cases are run with the inputs in their cells, and share all of these but beta.
    shared = {line.attribute: si[line.name] for line in typed if line.attribute not in ("", "beta")}
    computed = [run(replace(of_case, **shared), scheme) for of_case in impacts.values()]
    count = prepared_rows(max(sheet.steps for sheet in computed), rows)
    if impact is None:
        from replication.audit.audit import audit

        audited = result_of(record or audit(), scheme, ledger)
        cases += [replace(case, name=f"{case.name} coarse", coarse=True) for case in cases]
        coarse = [replace(sheet.impact, step=si["dt_coarse"]) for sheet in computed]
        computed += [run(of_case, scheme) for of_case in coarse]
    runs = [
        (replace(case, steps=sheet.steps, rows=count), sheet)
        for case, sheet in zip(cases, computed, strict=True)
    ]
    plan = workbook_plan(ledger, [case for case, _ in runs], audited)
    values = dict(_keyed(_values(ledger, runs, typed, si)))
    if audited is not None:
        values |= live_verdicts(ledger, plan, values, audited)
    warnings = [
        f"{case.name}: {doubt}"
        for case, sheet in runs
        if not case.coarse
        for kind, doubt in doubts_about(sheet).items()
        if kind not in NOTES
    ]
    bounds = [
        rounding_bound(s.steps, s.impact.velocity, s.rows[-1].time, s.final_depth) for s in computed
    ]
    return Workbook(plan, values, warnings, max(bounds))


def result_of(record: Record, scheme: Scheme, ledger: Ledger) -> AuditResult:
    """Return what the workbook shows of the audit, with the verdicts under the given scheme."""
    convention = Convention(scheme=scheme)
    verdicts, explanations = {}, {}
    for claim in record.claims:
        verdicts[claim.id], explanations[claim.id] = claim.verdict, claim.explanation
        for judgement in claim.as_printed.judgements if claim.as_printed else ():
            if judgement.convention == convention:
                verdicts[claim.id] = judgement.verdict
        if scheme is not Scheme.PUBLISHED and ledger.claims[claim.id].by_scheme:
            explanations[claim.id] = f"With the published scheme: {claim.explanation}"
    counts = Counter(verdicts.values())
    return AuditResult(
        headline=record.headline,
        counts={verdict.value: counts[verdict] for verdict in Verdict},
        verdicts=verdicts,
        explanations=explanations,
        failing=[name for name, verdict in verdicts.items() if verdict.is_failure],
        differing=[name for name, verdict in verdicts.items() if verdict == Verdict.DIFFERS],
    )


def _si(typed: float, unit: str) -> float:
    """Convert a typed number to SI units with a single rounding, as the cell in use does."""
    factor = to_si(unit)
    return typed * float(factor) if factor >= 1 else typed / float(1 / factor)


def _typed(si: float, unit: str) -> float:
    """Return the number to type so that the cell in use holds an SI value, or the nearest to it."""
    nearest = float(Fraction(si) / to_si(unit))
    candidates = nearest, math.nextafter(nearest, math.inf), math.nextafter(nearest, -math.inf)
    return next((typed for typed in candidates if _si(typed, unit) == si), nearest)


def _typed_inputs(
    blocks: Mapping[str, Sequence[InputLine]], impacts: Mapping[str, Impact], ledger: Ledger
) -> dict[InputLine, float]:
    """Return the number to type into each input's cell. Raises ValueError outside of its limits."""
    typed = {}
    for line in chain.from_iterable(blocks.values()):
        if line.attribute:
            # Only beta belongs to one case; all other inputs are the same in all cases.
            impact = impacts[line.case] if line.case else next(iter(impacts.values()))
            number = _typed(getattr(impact, line.attribute), line.unit)
        else:
            number = line.of_report(ledger)
        least, most = line.limits
        if not least <= number <= most:
            meaning = line.meaning or ledger.title(line.source)
            span = with_unit(f"{least:,.10g} to {most:,.10g}", line.unit)
            raise ValueError(f"the workbook takes {span} for the {meaning}, not {number!r}")
        typed[line] = number
    return typed


def _case_sheet(slug: str, impact: Impact, scheme: Scheme) -> CaseSheet:
    """Return the sheet of a case, whose length is not known yet."""
    beta, name, label = impact.beta, "Sheet", messages.AS_GIVEN
    if beta is not None:
        # Spreadsheet programs round the decimal that they show, half away from zero, and write a
        # number that they join to a text with 15 digits.
        rounded = Decimal(repr(beta)).quantize(Decimal("1e-6"), ROUND_HALF_UP, Context(MAX_PREC))
        name, label = f"Sheet beta {beta:.4g}", f"β = {float(rounded):.15g}"
    return CaseSheet(
        name=name,
        slug=slug,
        label=label,
        scheme=scheme,
        beta="3" if beta == BETA_3.beta else "5",
        is_reports=impact in (BETA_3, BETA_5),
        resistance_given=beta is None,
    )


# The values, sheet by sheet. They are trees: the names of its branches, joined by dots, are the key
# of a value. A list is a column of cells, and None stands for no cell. The key of a quantity, which
# is the defined name of its cell, has no dots.

Tree = dict[str, Any]
Runs = Sequence[tuple[CaseSheet, Sheet]]
"""The sheet of each case in the plan, with the run that it shows."""


def _values(
    ledger: Ledger, runs: Runs, typed: Mapping[InputLine, float], si: Mapping[str, float]
) -> Tree:
    """Return every value but the live verdicts; `si` has the inputs in SI units, by name."""
    fine = [(case, sheet) for case, sheet in runs if not case.coarse]
    first, last = fine[0][1].impact, fine[-1][1].impact
    values = _inputs(ledger, fine, typed, si)
    for case, sheet in runs:
        values |= _case_values(case, sheet, si)
    for case in (case for case, _ in runs if case.coarse):
        values |= _comparison(case, values)
    values |= _overview(runs, values) | _table(*fine[-1])
    for case, sheet in fine:
        values |= _figure_3_curve(case, sheet)
    return (
        values
        | {"figure_5": _figure_5(last, si), "convergence": _convergence(fine, values)}
        | _frank_zook(last, si)
        | _crater(first, si, float(ledger.value("observed-third")))
        | _resistance(fine, si)
        | _solve(ledger, fine)
    )


def _inputs(
    ledger: Ledger, runs: Runs, typed: Mapping[InputLine, float], si: Mapping[str, float]
) -> Tree:
    """Return the values of the sheet Inputs: typed, in use, and what follows from them."""
    first = runs[0][1].impact
    changed = {line.name for line, number in typed.items() if number != line.of_report(ledger)}
    values: Tree = {
        "pi_": math.pi,
        "ksi_Pa": to_si("ksi"),
        "L_most": inverse.LARGEST_LOGARITHM,
        "series_below": SERIES_BELOW,
        "um3_per_m3": UM3_PER_M3,
        "same_within": SAME_WITHIN,
        "travel_most": COARSE,
        "excess_most": DIGITS,
        "off_stop_most": OFF_STOP,
        "D_p": first.diameter,
        "M_p": first.mass,
        "half_step": first.step / 2 * 1e9,
        "mean_radius": si["D_mean"] / 2 * 1e6,
        "inputs_from": "yours",
        "inputs_changed": len(changed),
        "inputs_unusable": 0,
        "inputs.choice": "yours",
        "inputs.no_choice": "",
        "inputs.chosen": "yours",
        "inputs.unlike": "",
        "inputs.message": (message := messages.CHANGED if changed else messages.UNCHANGED),
        **_said_of(messages.INPUTS_SAY, message),
        **{case.resistance: sheet.impact.target_resistance for case, sheet in runs},
    }
    for line, number in typed.items():
        name = line.name
        check = YOURS if name in changed else line.whose
        values[name] = si[name]
        values |= {
            f"{name}.typed": number,
            f"{name}.taken": number,
            f"{name}.check": check,
            f"{name}.whose": check,
            **_within_limits(name, number),
        }
    return values


def _within_limits(key: str, number: float | None) -> Tree:
    """Return the cells that check a number, which is within its limits, or none is typed."""
    if number is None:
        not_available = dict.fromkeys(("number", "below", "above", "accepted"), NOT_AVAILABLE)
        checks: Tree = {**not_available, "fault": NO_NUMBER}
    else:
        checks = {"number": number, "below": "", "above": "", "fault": "", "accepted": number}
    return {f"{key}.{end}": value for end, value in checks.items()}


def _case_values(case: CaseSheet, sheet: Sheet, si: Mapping[str, float]) -> Tree:
    """Return the values of the sheet of a case: its inputs, rows, results, and their state."""
    impact = sheet.impact
    repeated = {
        **impact.motion,
        **{name: getattr(impact, name) for name in ("mass", "diameter", "step", "stop_velocity")},
        "row": _row_columns(sheet, case.rows),
        "renamed": None if case.resistance_given else "",
    }
    quantities = {"label": case.label, **_results(sheet, si), **_exact(impact), **_state(sheet)}
    if case.coarse:
        quantities["longer"] = longer = impact.step > si["dt_s"]
        quantities |= _state_and_words("finer", not longer, messages.NOT_COARSER)
    if not case.resistance_given:
        quantities["other_beta"] = False
        quantities |= _state_and_words("renamed", False, messages.KEEPS_NAME)
    named = {f"{name}{case.suffix}": value for name, value in quantities.items()}
    return {case.part: repeated, **named}


def _results(sheet: Sheet, si: Mapping[str, float]) -> Tree:
    final = sheet.rows[-1]
    velocity = final.velocity_final
    return {
        "rows_used": len(sheet.rows),
        "stopped": 1,
        "final_depth": sheet.final_depth,
        "depth_um": sheet.final_depth * 1e6,
        "normalized_depth": sheet.normalized_depth,
        "steps": sheet.steps,
        "stop_time": final.time,
        "final_velocity": sheet.impact.velocity if velocity is None else velocity,
        "excess": sheet.normalized_depth / si["observed_ratio"],
    }


def _exact(impact: Impact) -> Tree:
    """Return the depths without time steps, at rest and at the stop velocity."""
    at_rest, at_stop = _without_steps(impact), _without_steps(impact, to_stop=True)
    terms = {"pressure": "p", "ln": "ln", "c": "c", "h": "h", "normalized_depth": "X_R"}
    return {
        **{f"{name}_rest": at_rest[key] for key, name in terms.items()},
        **{f"{name}_stop": at_stop[key] for key, name in terms.items()},
        "X_rest": at_rest["depth_um"],
        "stop_share": at_stop["normalized_depth"] / at_rest["normalized_depth"],
    }


def _state(sheet: Sheet) -> Tree:
    """Return what tells whether a run can be trusted, and the message that says so."""
    impact, kinds = sheet.impact, doubts_about(sheet).keys()
    rest = _without_steps(impact)["normalized_depth"]
    stop = _without_steps(impact, to_stop=True)["normalized_depth"]
    travel = impact.step * impact.velocity / impact.radius
    over_rest = sheet.normalized_depth / rest
    conditions = {
        "too_long": too_long(travel),
        "too_deep": over_rest > 1 + DIGITS,
        "off_stop": abs(sheet.normalized_depth - stop) > OFF_STOP * stop,
    }
    no_steps = sheet.steps == 0
    doubts = sum(conditions.values()) + no_steps
    message = _message(sheet)
    return {
        "travel": travel,
        "over_rest": over_rest,
        "over_stop": sheet.normalized_depth / stop if stop else NOT_AVAILABLE,
        **conditions,
        "doubts": doubts,
        "sound": 0 if doubts else 1,
        "reverses": "reversed" in kinds,
        "early": stop / rest < 1 - DIGITS,
        "trust": 0 if doubts else 1,
        "message": message,
        "says_run": message,
        **_said_of(messages.RUN_SAYS, message),
    }


def _said_of(choices: Mapping[str, str], message: str) -> Tree:
    """Return which of these words the message is, by name, and the words of this one only."""
    values: Tree = {}
    for name, words in choices.items():
        values |= _state_and_words(name, words == message, words)
    return values


def _state_and_words(name: str, holds: bool, words: str) -> Tree:
    """Return a state and what is said of it, which is nothing unless it holds."""
    return {f"is_{name}": holds, f"says_{name}": words if holds else ""}


def _message(sheet: Sheet) -> str:
    """Return what the workbook says of a run."""
    kinds = doubts_about(sheet).keys()
    if not kinds - {"reversed", "short"}:
        if "reversed" in kinds:
            return messages.REVERSED
        return messages.EARLY if "short" in kinds else messages.COMPLETE
    if sheet.steps == 0:
        return messages.NO_STEPS
    if sheet.steps == 1:
        return messages.ONE_STEP
    return messages.STEP_TOO_LONG if "coarse" in kinds else messages.DOUBTFUL


def _comparison(case: CaseSheet, values: Tree) -> Tree:
    """Compare the depth of a sheet with the coarser step with that of the finer one."""
    fine, depth_um = values[f"depth_um{case.input_suffix}"], values[f"depth_um{case.suffix}"]
    return {
        f"fine_depth_um{case.suffix}": fine,
        f"over_fine{case.suffix}": depth_um / fine if fine else NOT_AVAILABLE,
    }


def _said(case: CaseSheet, values: Tree) -> str:
    """Return the label of a case with the state of its run."""
    return f"{case.label}: {values[f'message{case.suffix}']}"


def _overview(runs: Runs, values: Tree) -> Tree:
    names = "inputs_changed", "inputs_unusable"
    shown: Tree = {name: values[name] for name in names}
    for case, _ in runs:
        shown[case.part] = {
            "depth_um": values[f"depth_um{case.suffix}"],
            "exact_um": values[f"X_rest{case.suffix}"],
            "normalized_depth": values[f"normalized_depth{case.suffix}"],
            "message": _said(case, values),
        }
    curves = {case.slug: {"message": _said(case, values)} for case, _ in runs if not case.coarse}
    return {"overview": shown, "figure_3": curves}


def _table(case: CaseSheet, sheet: Sheet) -> Tree:
    """Return the cells of Table A-1, which are the first rows of a case."""
    impact = sheet.impact
    above = {**impact.motion, "mass": impact.mass, "diameter": impact.diameter}
    columns = _row_columns(sheet, case.rows)
    rows = {
        name: cells[:TABLE_ROWS]
        for name, cells in columns.items()
        if name not in ("index", "depth_um")
    }
    return {"table": {name: above[name] for name in ABOVE} | {"row": rows}}


def _figure_3_curve(case: CaseSheet, sheet: Sheet) -> Tree:
    """Return a curve of Figure 3 in ns and µm; after the stop, the last row is repeated."""
    rows = [sheet.rows[min(k, sheet.steps)] for k in range(case.rows + 1)]
    key = f"figure_3.{case.slug}"
    return {
        f"{key}.time": [row.time * 1e9 for row in rows],
        f"{key}.depth": [row.depth * 1e6 for row in rows],
    }


def _figure_5(impact: Impact, si: Mapping[str, float]) -> Tree:
    low, high, last = si["V_from"], si["V_to"], FIGURE_5_POINTS - 1
    velocities = [low + (high - low) * point / last for point in range(FIGURE_5_POINTS)]
    points = [_without_steps(replace(impact, velocity=velocity)) for velocity in velocities]
    columns = {key: [point[key] for point in points] for key in points[0]}
    return {"message": messages.ALL_POINTS, "velocity": velocities, **columns}


def _convergence(runs: Runs, inputs: Tree) -> Tree:
    """Return the ladder of time steps: depths [um] and their errors against the depth at rest [um].

    With it come the inputs of these runs, and those in use.
    """
    of_runs = {}
    for name in run_inputs([case for case, _ in runs]):
        of_runs[name] = inputs[name] * SMALL[name][0] if name in SMALL else inputs[name]
    values: Tree = {"message": messages.CURRENT, "says": messages.CURRENT, "all_same": 1}
    for case, sheet in runs:
        time_steps = ladder(sheet.impact.step, LEVELS)
        rest = depth.final_depth(**sheet.impact.motion) * 1e6
        levels = [run(replace(sheet.impact, step=step), sheet.scheme) for step in time_steps]
        depths = [level.final_depth * 1e6 for level in levels]
        errors = [reached - rest for reached in depths]
        steps = [level.steps for level in levels]
        orders = map(error_order, errors, errors[1:], steps)
        values[case.slug] = {
            "rest_um": rest,
            "step": time_steps,
            "step_ns": [step * 1e9 for step in time_steps],
            "steps": steps,
            "depth_um": depths,
            "error": errors,
            "size": list(map(abs, errors)),
            "order": [None, *(NO_ORDER if order is None else order for order in orders)],
            "state": list(map(_message, levels)),
        }
    return values | {"run": of_runs, "in_use": of_runs, "same": dict.fromkeys(of_runs, 1)}


def _frank_zook(impact: Impact, si: Mapping[str, float]) -> Tree:
    """Return the depths by Frank and Zook, for the armor and for the lower resistance."""
    ratio, k_1, k_t = estimates.sphere_length_ratio(), si["k_1"], si["k_t"]
    v, particle, target = impact.velocity, impact.particle_density, impact.target_density
    armor, lower = si["R_t_RHA"], si["R_t_lower"]
    drag = k_t * target * v * v
    of_armor = ratio, particle, target, k_1, k_t, armor, v
    of_lower = ratio, particle, target, k_1, k_t, lower, v
    return {
        "L_D": ratio,
        "frank_zook": {"R_t_RHA": armor, "R_t_lower": lower},
        "z_RHA": drag / armor,
        "ln_RHA": math.log1p(drag / armor),
        "X_R_RHA": estimates.frank_zook_as_printed(*of_armor),
        "X_R_RHA_derived": estimates.frank_zook_derived(*of_armor),
        "z_lower": drag / lower,
        "ln_lower": math.log1p(drag / lower),
        "X_R_lower": estimates.frank_zook_as_printed(*of_lower),
        "X_R_lower_derived": estimates.frank_zook_derived(*of_lower),
    }


def _crater(impact: Impact, si: Mapping[str, float], third: float) -> Tree:
    """Return the values of the sheet Crater, block by block."""
    radius = si["D_mean"] / 2
    particle_volume = crater.volume(radius)
    observed = crater.normalized_depth_from_volume_ratio(si["CV_PV"])
    observed_depth = observed * radius
    observed_volume = crater.cap_volume(observed_depth, radius)
    on_line = crater.normalized_depth_from_volume_ratio(si["CV_PV_line"])
    line_depth = on_line * radius
    line_volume = crater.cap_volume(line_depth, radius)
    contact = crater.contact_diameter(third, si["D_mean"])
    least_mass = particle_mass(si["d_min"] / 2, impact.particle_density)
    greatest_mass = particle_mass(si["d_max"] / 2, impact.particle_density)
    return {
        "PV_m3": particle_volume,
        "PV_um3": particle_volume * UM3_PER_M3,
        "h_crater": math.asin(math.sqrt(si["CV_PV"])) / 3,
        "X_R_crater": observed,
        "X_D_crater": observed / 2,
        "X_crater": observed_depth,
        "X_crater_um": observed_depth * 1e6,
        "CV_crater": observed_volume,
        "CV_crater_um3": observed_volume * UM3_PER_M3,
        "CV_PV_again": crater.volume_ratio(observed),
        "CV_line_um3": si["CV_PV_line"] * (particle_volume * UM3_PER_M3),
        "h_line": math.asin(math.sqrt(si["CV_PV_line"])) / 3,
        "X_R_line": on_line,
        "X_D_line": on_line / 2,
        "X_line": line_depth,
        "X_line_um": line_depth * 1e6,
        "CV_line": line_volume,
        "CV_line_again_um3": line_volume * UM3_PER_M3,
        "CV_PV_line_again": crater.volume_ratio(on_line),
        "y_contact": third,
        "contact": contact,
        "contact_um": contact * 1e6,
        "m_min": least_mass,
        "V_min": estimates.particle_velocity(impact.velocity, least_mass, impact.mass),
        "m_max": greatest_mass,
        "V_max": estimates.particle_velocity(impact.velocity, greatest_mass, impact.mass),
    }


def _resistance(runs: Runs, si: Mapping[str, float]) -> Tree:
    alpha = estimates.walker_anderson_alpha(si["E_t"], si["Y_steel"])
    betas = {
        "beta_G": estimates.goodier_beta(si["q_Y"]),
        "beta_WA": estimates.walker_anderson_beta(alpha),
        "beta_B": si["HB_ratio"],
    }
    grains = {name: si[f"S_{name}"] / 1e6 for name in ("feathery", "clear", "bulk")}
    mean = (grains["feathery"] + grains["clear"]) / 2
    values: Tree = betas | {
        "alpha": alpha,
        "beta_least": min(betas.values()),
        "beta_greatest": max(betas.values()),
        **{f"S_{name}_MPa": strength for name, strength in grains.items()},
        "S_mean": mean,
        "clear_over_bulk": grains["clear"] / grains["bulk"],
        "mean_over_bulk": mean / grains["bulk"],
        "strain_rate": estimates.strain_rate(si["V_impact"], si["L_typ"]),
    }
    for case, sheet in runs:
        impact, r_t = sheet.impact, sheet.impact.target_resistance
        stress = estimates.centerline_stress(impact.target_density, impact.velocity, r_t)
        values |= {
            f"resistance.{case.resistance}": r_t,
            f"stress{case.input_suffix}": stress,
            f"stress_over_copper{case.input_suffix}": stress / si["Y_copper"],
        }
    return values


def _solve(ledger: Ledger, runs: Runs) -> Tree:
    """Return the inputs that give the measured depth, each with all others as in use."""
    typed = float(ledger.value(MEASURED) / to_si("um"))
    x = _si(typed, "um")
    shared = runs[0][1].impact
    v, radius = shared.velocity, shared.radius
    particle, target = shared.particle_density, shared.target_density
    y = x / radius
    ratio = crater.crater_volume_ratio(y)
    logarithm = ratio * (target / particle)
    values: Tree = {
        "solve.depth": typed,
        **_within_limits("solve.depth", typed),
        "solve.ratio": "",
        **_within_limits("solve.ratio", None),
        "by_ratio": 0,
        "y_meas": y,
        "X_meas": y * radius,
        "CV_PV_meas": ratio,
        "L_meas": logarithm,
    }
    solved = logarithm < inverse.LARGEST_LOGARITHM
    values["solve.message"] = messages.BY_DEPTH if solved else messages.TOO_DEEP
    values |= {
        "solved": solved,
        **_state_and_words("for_depth", solved, messages.BY_DEPTH),
        **_state_and_words("for_ratio", False, messages.BY_RATIO),
        **_state_and_words("too_deep", not solved, messages.TOO_DEEP),
    }
    resistance = inverse.resistance_for_depth(x, v, radius, particle, target)
    back = _without_steps(
        replace(shared, beta=None, flow_stress=None, resistance=resistance if solved else 1.0)
    )
    of_resistance = {
        "exp_L": math.exp(min(logarithm, inverse.LARGEST_LOGARITHM)),
        "p_meas": math.expm1(min(logarithm, inverse.LARGEST_LOGARITHM)),
        "R_t_meas": resistance,
        "R_t_meas_GPa": resistance / 1e9,
        "p_back": back["pressure"],
        "ln_back": back["ln"],
        "c_back": back["c"],
        "h_back": back["h"],
        "X_R_back": back["normalized_depth"],
        "X_back_um": back["depth_um"],
    }
    for case, sheet in runs:
        impact, s = sheet.impact, case.input_suffix
        r_t = impact.target_resistance
        if impact.beta is not None and impact.flow_stress is not None:
            of_resistance["beta_meas"] = resistance / impact.flow_stress
            of_resistance[f"Y_t_meas{s}"] = resistance / impact.beta
            values[f"solve.Y_t{s}"] = impact.flow_stress
        velocity = inverse.velocity_for_depth(x, radius, particle, target, r_t)
        of_resistance[f"V_impact_meas{s}"] = velocity
        values |= {
            f"solve.V_impact{s}": v,
            f"solve.R_p{s}": radius,
            f"solve.rho_p{s}": particle,
            f"R_p_meas{s}": inverse.radius_for_depth(x, v, particle, target, r_t),
            f"rho_p_meas{s}": inverse.particle_density_for_depth(x, v, radius, target, r_t),
        }
    return values | (of_resistance if solved else dict.fromkeys(of_resistance, NOT_AVAILABLE))


def _keyed(tree: Any, key: str = "") -> Iterator[tuple[str, ShownValue]]:
    """Yield the values of a tree with their keys.

    >>> dict(_keyed({"steps": 85, "low": {"time": [0.0, 2e-10]}}))
    {'steps': 85.0, 'low.time[0]': 0.0, 'low.time[1]': 2e-10}
    """
    if isinstance(tree, dict):
        for name, branch in tree.items():
            yield from _keyed(branch, f"{key}.{name}" if key else name)
    elif isinstance(tree, list):
        for number, value in enumerate(tree):
            yield from _keyed(value, f"{key}[{number}]")
    elif tree is not None:
        yield key, tree if isinstance(tree, str) else float(tree)


def live_verdicts(
    ledger: Ledger, plan: WorkbookPlan, values: Mapping[str, ShownValue], audited: AuditResult
) -> dict[str, ShownValue]:
    """Return the live verdicts, by key, on the values of the cells that compute claims.

    With them come the sheets that show them: the check of Table A-1, the counts, and the results
    that `Overview` repeats.
    """
    audit: Tree = {}
    table: Tree = {}
    for claim in ledger.claims.values():
        if claim.id not in plan.claims:
            continue
        value = values[plan.cells[plan.claims[claim.id]].key]
        audit[claim.id] = {"computed": value, **_judged(value, claim.interval())}
        if claim.place.cell and claim.printed:
            difference = _difference(value, claim.printed, exact=claim.is_exact)
            table[claim.place.cell] = {
                "computed": value, "verdict": audit[claim.id]["verdict"], "difference": difference
            }  # fmt: skip
    verdicts = [judged["verdict"] for judged in audit.values()]
    counts = {name: verdicts.count(verdict) for verdict, name in LIVE_VERDICTS.items()}
    overview: Tree = dict(counts)
    for name in (*audited.failing, *audited.differing):
        if name in audit:
            overview[name] = audit[name]["computed"]
    return dict(_keyed({**counts, "audit": audit, "overview": overview, "table_check": table}))


def _without_steps(impact: Impact, to_stop: bool = False) -> dict[str, float]:
    """Return the depth at the velocity u without time steps, and the terms of its equation.

    u is 0 (at rest), or with `to_stop` the stop velocity. `pressure` is
    p = rho_t (V^2 - u^2) / (2 R_t + rho_t u^2) [1], `ln` is ln(1 + p), `c` is
    (4 rho_p / 3 rho_t) ln(1 + p), and `h` the angle asin(sqrt(3c)/2)/3 with c of at most 2/3.
    """
    v, radius, r_t = impact.velocity, impact.radius, impact.target_resistance
    particle, target = impact.particle_density, impact.target_density
    u, reached = 0.0, depth.normalized_depth(v, particle, target, r_t)
    if to_stop:
        u = min(impact.stop_velocity, v)  # an impact below the stop velocity has depth 0
        reached = depth.depth_at_velocity(u, **impact.motion) / radius
    pressure = target * (v - u) * (v + u) / (2 * r_t + target * u * u)
    c = 4 * particle / (3 * target) * math.log1p(pressure)
    return {
        "pressure": pressure,
        "ln": math.log1p(pressure),
        "c": c,
        "h": math.asin(math.sqrt(3 * min(c, 2 / 3)) / 2) / 3,
        "normalized_depth": reached,
        "depth_um": radius * reached * 1e6,
    }


def _row_columns(sheet: Sheet, count: int) -> dict[str, list[float | str | None]]:
    """Return the cells of rows 0 to `count`, by column; below the stop they are blank ("")."""
    impact = sheet.impact
    columns: dict[str, Any] = dict(zip(Row._fields, zip(*sheet.rows, strict=True), strict=True))
    columns["index"] = range(len(sheet.rows))
    columns["depth_um"] = (x * 1e6 for x in columns["depth"])
    if sheet.scheme == Scheme.CENTERED:
        materials = impact.radius, impact.mass, impact.target_density, impact.target_resistance
        columns["velocity_middle"] = [None]  # row 0 has none
        for row in sheet.rows[1:]:
            x, v = row.depth, row.velocity_initial
            middle = v - deceleration(x, v, *materials) * (impact.step / 2)
            columns["velocity_middle"].append(middle)
    blank = [""] * (count - sheet.steps)
    return {name: [*column, *blank] for name, column in columns.items()}


def _judged(value: ShownValue, interval: Interval) -> Tree:
    """Return the live verdict on a double, and what it rests on, which is #N/A without a number."""
    conditions = _compared(Fraction(value if isinstance(value, float) else 0.0), interval)
    if not isinstance(value, float):
        not_available = dict.fromkeys(("number", *conditions, "prints_so"), NOT_AVAILABLE)
        return {"verdict": NOT_COMPUTED, **not_available}
    words = AS_PRINTED if all(conditions.values()) else OTHERWISE
    return {"verdict": words, "prints_so": words, "number": value, **conditions}


def _compared(number: Fraction, interval: Interval) -> dict[str, bool]:
    """Return whether a number keeps to each end of an interval, by end; ends are as doubles."""
    conditions = {}
    if interval.is_point:
        # Not to the last digit, since no double is exactly 2/3.
        (exact, _) = interval.ends
        conditions["above"] = abs(number - exact) <= Fraction(SAME_WITHIN) * abs(exact)
    else:
        if interval.lower is not None:
            low = Fraction(float(interval.lower))
            conditions["above"] = Interval(low, None, interval.lower_closed).contains(number)
        if interval.upper is not None:
            high = Fraction(float(interval.upper))
            at_most = Interval(None, high, upper_closed=interval.upper_closed)
            conditions["below"] = at_most.contains(number)
    return conditions


def _difference(value: ShownValue, printed: Printed, *, exact: bool) -> ShownValue:
    """Return computed minus printed; in units of the last printed digit unless that is exact."""
    if not isinstance(value, float):
        return NO_DIFFERENCE
    difference = value - float(printed.value)
    return difference if exact else round(difference / float(printed.quantum), DECIMALS)
