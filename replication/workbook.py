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
from spreadsheets.sheets.inputs import InputLine, input_lines
from spreadsheets.sheets.solve import MEASURED
from spreadsheets.sheets.table_a1 import ABOVE, DECIMALS, NO_DIFFERENCE, TABLE_ROWS
from spreadsheets.verify import rounding_bound


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
    case: Impact | None = None,
    scheme: Scheme | str = Scheme.PUBLISHED,
    rows: int | None = None,
    record: Record | None = None,
    *,
    ledger: Ledger | None = None,
) -> Workbook:
    """Build the workbook of a case; without a case, the report's own.

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
    impacts = {"low": BETA_3, "high": BETA_5} if case is None else {"case": case}
    pages = [_case_sheet(slug, impact, scheme) for slug, impact in impacts.items()]
    typed = _typed_inputs(input_lines(pages, report=case is None), impacts, ledger)
    si = {entry.name: _si(number, entry.unit) for entry, number in typed.items()}
    # The cases are run with the inputs in their cells, and share all of these but beta.
    shared = {
        entry.attribute: si[entry.name] for entry in typed if entry.attribute not in ("", "beta")
    }
    computed = [run(replace(impact, **shared), scheme) for impact in impacts.values()]
    count = prepared_rows(max(sheet.steps for sheet in computed), rows)
    if case is None:
        from replication.audit.audit import audit

        audited = result_of(record or audit(), scheme, ledger)
        pages += [replace(page, name=f"{page.name} coarse", coarse=True) for page in pages]
        coarse = [replace(sheet.impact, step=si["dt_coarse"]) for sheet in computed]
        computed += [run(impact, scheme) for impact in coarse]
    runs = [
        (replace(page, steps=sheet.steps, rows=count), sheet)
        for page, sheet in zip(pages, computed, strict=True)
    ]
    plan = workbook_plan(ledger, [page for page, _ in runs], audited)
    values = dict(_keyed(_values(ledger, runs, typed, si)))
    if audited is not None:
        values |= live_verdicts(ledger, plan, values, audited)
    warnings = [
        f"{page.name}: {doubt}"
        for page, sheet in runs
        if not page.coarse
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
    for entry in chain.from_iterable(blocks.values()):
        if entry.attribute:
            # The name of a beta ends with its case; all other inputs are the same in all cases.
            case = impacts.get(entry.name.rpartition("_")[2]) or next(iter(impacts.values()))
            number = _typed(getattr(case, entry.attribute), entry.unit)
        else:
            number = entry.of_report(ledger)
        least, most = entry.limits
        if not least <= number <= most:
            meaning = entry.meaning or ledger.title(entry.source)
            span = with_unit(f"{least:,.10g} to {most:,.10g}", entry.unit)
            raise ValueError(f"the workbook takes {span} for the {meaning}, not {number!r}")
        typed[entry] = number
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
    fine = [(page, sheet) for page, sheet in runs if not page.coarse]
    first, last = fine[0][1].impact, fine[-1][1].impact
    values = _inputs(ledger, fine, typed, si)
    for page, sheet in runs:
        values |= _case_values(page, sheet, si)
    for page in (page for page, _ in runs if page.coarse):
        values |= _comparison(page, values)
    values |= _overview(runs, values) | _table(*fine[-1])
    for page, sheet in fine:
        values |= _figure_3_curve(page, sheet)
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
    changed = {entry.name for entry, number in typed.items() if number != entry.of_report(ledger)}
    values: Tree = {
        "pi_": math.pi,
        "ksi_Pa": to_si("ksi"),
        "L_most": inverse.LARGEST_LOGARITHM,
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
        **{page.resistance: sheet.impact.target_resistance for page, sheet in runs},
    }
    for entry, number in typed.items():
        name = entry.name
        unchanged = "as inferred" if name == "rho_t" else "the report’s"
        check = "yours" if name in changed else unchanged
        values[name] = si[name]
        values |= {f"{name}.{key}": number for key in ("typed", "number", "taken", "accepted")}
        values |= {f"{name}.{key}": check for key in ("check", "whose")}
        values |= {f"{name}.{key}": "" for key in ("below", "above", "fault")}
    return values


def _case_values(page: CaseSheet, sheet: Sheet, si: Mapping[str, float]) -> Tree:
    """Return the values of the sheet of a case: its inputs, rows, results, and their state."""
    impact = sheet.impact
    repeated = {
        **impact.motion,
        **{name: getattr(impact, name) for name in ("mass", "diameter", "step", "stop_velocity")},
        "row": _row_columns(sheet, page.rows),
        "renamed": None if page.resistance_given else "",
    }
    quantities = {"label": page.label, **_results(sheet, si), **_exact(impact), **_state(sheet)}
    if page.coarse:
        quantities["longer"] = longer = impact.step > si["dt_s"]
        quantities |= _state_and_words("finer", not longer, messages.NOT_COARSER)
    if not page.resistance_given:
        quantities["other_beta"] = False
        quantities |= _state_and_words("renamed", False, messages.KEEPS_NAME)
    named = {f"{name}{page.suffix}": value for name, value in quantities.items()}
    return {page.part: repeated, **named}


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


def _comparison(page: CaseSheet, values: Tree) -> Tree:
    """Compare the depth of a sheet with the coarser step with that of the finer one."""
    fine, depth_um = values[f"depth_um{page.input_suffix}"], values[f"depth_um{page.suffix}"]
    return {
        f"fine_depth_um{page.suffix}": fine,
        f"over_fine{page.suffix}": depth_um / fine if fine else NOT_AVAILABLE,
    }


def _said(page: CaseSheet, values: Tree) -> str:
    """Return the label of a case with the state of its run."""
    return f"{page.label}: {values[f'message{page.suffix}']}"


def _overview(runs: Runs, values: Tree) -> Tree:
    names = "inputs_changed", "inputs_unusable"
    shown: Tree = {name: values[name] for name in names}
    for page, _ in runs:
        shown[page.part] = {
            "depth_um": values[f"depth_um{page.suffix}"],
            "exact_um": values[f"X_rest{page.suffix}"],
            "normalized_depth": values[f"normalized_depth{page.suffix}"],
            "message": _said(page, values),
        }
    curves = {page.slug: {"message": _said(page, values)} for page, _ in runs if not page.coarse}
    return {"overview": shown, "figure_3": curves}


def _table(page: CaseSheet, sheet: Sheet) -> Tree:
    """Return the cells of Table A-1, which are the first rows of a case."""
    impact = sheet.impact
    above = {**impact.motion, "mass": impact.mass, "diameter": impact.diameter}
    columns = _row_columns(sheet, page.rows)
    rows = {
        name: cells[:TABLE_ROWS]
        for name, cells in columns.items()
        if name not in ("index", "depth_um")
    }
    return {"table": {name: above[name] for name in ABOVE} | {"row": rows}}


def _figure_3_curve(page: CaseSheet, sheet: Sheet) -> Tree:
    """Return a curve of Figure 3 in ns and µm; after the stop, the last row is repeated."""
    rows = [sheet.rows[min(k, sheet.steps)] for k in range(page.rows + 1)]
    key = f"figure_3.{page.slug}"
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
    for name in run_inputs([page for page, _ in runs]):
        of_runs[name] = inputs[name] * SMALL[name][0] if name in SMALL else inputs[name]
    values: Tree = {"message": messages.CURRENT, "says": messages.CURRENT, "all_same": 1}
    for page, sheet in runs:
        time_steps = ladder(sheet.impact.step, LEVELS)
        rest = depth.final_depth(**sheet.impact.motion) * 1e6
        levels = [run(replace(sheet.impact, step=step), sheet.scheme) for step in time_steps]
        depths = [level.final_depth * 1e6 for level in levels]
        errors = [reached - rest for reached in depths]
        steps = [level.steps for level in levels]
        orders = map(error_order, errors, errors[1:], steps)
        values[page.slug] = {
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
    ratio, k_t = estimates.sphere_length_ratio(), si["k_t"]
    v, target = impact.velocity, impact.target_density
    values: Tree = {"L_D": ratio, "frank_zook": {}}
    for steel in ("RHA", "lower"):
        r_t = si[f"R_t_{steel}"]
        z = k_t * target * v * v / r_t
        arguments = ratio, impact.particle_density, target, si["k_1"], k_t, r_t, v
        values["frank_zook"][f"R_t_{steel}"] = r_t
        values |= {
            f"z_{steel}": z,
            f"ln_{steel}": math.log1p(z),
            f"X_R_{steel}": estimates.frank_zook_as_printed(*arguments),
            f"X_R_{steel}_derived": estimates.frank_zook_derived(*arguments),
        }
    return values


def _crater(impact: Impact, si: Mapping[str, float], third: float) -> Tree:
    radius = si["D_mean"] / 2
    volume = crater.volume(radius)
    volume_um3 = volume * 1e6 * 1e6 * 1e6
    contact = crater.contact_diameter(third, si["D_mean"])
    values: Tree = {
        "PV_m3": volume,
        "PV_um3": volume_um3,
        "CV_line_um3": si["CV_PV_line"] * volume_um3,
        "y_contact": third,
        "contact": contact,
        "contact_um": contact * 1e6,
    }
    for which, name in (("crater", "CV_PV"), ("line", "CV_PV_line")):
        y = crater.normalized_depth_from_volume_ratio(si[name])
        x = y * radius
        volume = crater.cap_volume(x, radius)
        volume_key = {"crater": "CV_crater_um3", "line": "CV_line_again_um3"}[which]
        values |= {
            f"h_{which}": math.asin(math.sqrt(si[name])) / 3,
            f"X_R_{which}": y,
            f"X_D_{which}": y / 2,
            f"X_{which}": x,
            f"X_{which}_um": x * 1e6,
            f"CV_{which}": volume,
            volume_key: volume * 1e6 * 1e6 * 1e6,
            f"{name}_again": crater.volume_ratio(y),
        }
    for which, size in (("min", "d_min"), ("max", "d_max")):
        mass = particle_mass(si[size] / 2, impact.particle_density)
        velocity = estimates.particle_velocity(impact.velocity, mass, impact.mass)
        values |= {f"m_{which}": mass, f"V_{which}": velocity}
    return values


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
    for page, sheet in runs:
        impact, r_t = sheet.impact, sheet.impact.target_resistance
        stress = estimates.centerline_stress(impact.target_density, impact.velocity, r_t)
        values |= {
            f"resistance.{page.resistance}": r_t,
            f"stress{page.input_suffix}": stress,
            f"stress_over_copper{page.input_suffix}": stress / si["Y_copper"],
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
        "solve.depth.accepted": typed,
        "solve.ratio": "",
        "solve.ratio.accepted": "",
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
    for page, sheet in runs:
        impact, s = sheet.impact, page.input_suffix
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
        # To nine digits, since no double is exactly 2/3.
        (exact, _) = interval.ends
        conditions["above"] = abs(number - exact) * 10**9 <= abs(exact)
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
