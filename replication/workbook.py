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
from replication.models import crater, depth, estimates
from replication.models.impact import Impact, particle_mass
from replication.models.sheet import Row, Sheet, deceleration, run
from replication.text import with_unit
from spreadsheets import cases, emit, sheets
from spreadsheets.cases import CaseSheet, Input
from spreadsheets.plan import MESSAGES, NOT_COMPUTED, Value, WorkbookPlan, place_of
from spreadsheets.sheets import Findings
from spreadsheets.verify import rounding_bound


@dataclass(frozen=True)
class Workbook:
    """A workbook before it is a file.

    warnings: about runs that cannot be trusted. rounding: the largest `rounding_bound` of its runs.
    """

    plan: WorkbookPlan
    values: Mapping[str, Value]
    warnings: Sequence[str]
    rounding: float

    def to_bytes(self) -> bytes:
        """Return the bytes of the .xlsx file."""
        return emit.to_bytes(self.plan, self.values)

    @property
    def cells(self) -> dict[str, dict[str, Value]]:
        """What every cell must show, by sheet and address."""
        return emit.cell_values(self.plan, self.values)


def build(
    case: Impact | None = None,
    scheme: str = "published",
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

    >>> book = build(BETA_5)
    >>> place = book.plan.where["case.depth_um"]
    >>> place[0], f"{book.values['case.depth_um']:.2f}"
    ('Sheet beta 5', '7.67')
    """
    ledger, findings = ledger or load(), None
    impacts = {"low": BETA_3, "high": BETA_5} if case is None else {"case": case}
    pages = [_case_sheet(slug, impact, scheme) for slug, impact in impacts.items()]
    typed = _typed_inputs(cases.inputs_of(pages, report=case is None), impacts, ledger)
    si = {entry.name: _si(number, entry.unit) for entry, number in typed.items()}
    # The cases are run with the inputs in their cells, and share all of these but beta.
    shared = {
        entry.attribute: si[entry.name] for entry in typed if entry.attribute not in ("", "beta")
    }
    computed = [run(replace(impact, **shared), scheme) for impact in impacts.values()]
    count = cases.prepared_rows(max(sheet.steps for sheet in computed), rows)
    if case is None:
        from replication.audit.audit import audit

        findings = findings_of(record or audit(), scheme, ledger)
        pages += [replace(page, name=f"{page.name} coarse", coarse=True) for page in pages]
        coarse = [replace(sheet.impact, step=si["dt_coarse"]) for sheet in computed]
        computed += [run(impact, scheme) for impact in coarse]
    runs = [
        (replace(page, steps=sheet.steps, rows=count), sheet)
        for page, sheet in zip(pages, computed, strict=True)
    ]
    plan = sheets.workbook_plan(ledger, [page for page, _ in runs], findings)
    values = dict(_keyed(_values(ledger, runs, typed, si)))
    if findings is not None:
        values |= live_verdicts(ledger, plan, values, findings)
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


def findings_of(record: Record, scheme: str, ledger: Ledger) -> Findings:
    """Return what the workbook shows of the audit, with the verdicts under the given scheme."""
    convention = Convention(scheme=Scheme(scheme))
    verdicts, explanations = {}, {}
    for claim in record.claims:
        verdicts[claim.id], explanations[claim.id] = claim.verdict, claim.explanation
        for judgement in claim.as_printed.judgements if claim.as_printed else ():
            if judgement.convention == convention:
                verdicts[claim.id] = judgement.verdict
        if scheme != "published" and ledger.claims[claim.id].by_scheme:
            explanations[claim.id] = f"With the published scheme: {claim.explanation}"
    counts = Counter(verdicts.values())
    return Findings(
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
    blocks: Mapping[str, Sequence[Input]], impacts: Mapping[str, Impact], ledger: Ledger
) -> dict[Input, float]:
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


def _case_sheet(slug: str, impact: Impact, scheme: str) -> CaseSheet:
    """Return the sheet of a case, whose length is not known yet."""
    beta, name, label = impact.beta, "Sheet", MESSAGES["as_given"]
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
# of a value. A list is a column of cells, and None stands for no cell.

Tree = dict[str, Any]
Runs = Sequence[tuple[CaseSheet, Sheet]]
"""The sheet of each case in the plan, with the run that it shows."""


def _values(
    ledger: Ledger, runs: Runs, typed: Mapping[Input, float], si: Mapping[str, float]
) -> Tree:
    """Return every value but the live verdicts; `si` has the inputs in SI units, by name."""
    inputs = _inputs(ledger, runs, typed, si)
    pages = {page.part: _case_values(page, sheet, si) for page, sheet in runs}
    for page in (page for page, _ in runs if page.coarse):
        values, fine = pages[page.part], pages[page.slug]["depth_um"]
        over = values["depth_um"] / fine if fine else NOT_COMPUTED
        values |= {"fine_depth_um": fine, "over_fine": over}
    runs = [(page, sheet) for page, sheet in runs if not page.coarse]
    first, (last_page, last) = runs[0][1].impact, runs[-1]
    results = ("depth_um", "normalized_depth", "message")
    table = pages[last_page.part]
    columns = [name for name in table["row"] if name not in ("index", "depth_um")]
    rows = {name: table["row"][name][: cases.TABLE_ROWS] for name in columns}
    return {
        "inputs": inputs,
        "overview": {
            "inputs_changed": inputs["changed"],
            "inputs_unusable": 0,
            **{part: {key: page[key] for key in results} for part, page in pages.items()},
        },
        "table": {name: table[name] for name in cases.ABOVE_TABLE} | {"row": rows},
        "figure_3": {page.slug: _figure_3_curve(page, sheet) for page, sheet in runs},
        "figure_5": _figure_5(last.impact, si),
        "convergence": _convergence(runs, inputs),
        "frank_zook": _frank_zook(last.impact, si),
        "crater": _crater(first, si, float(ledger.value("observed-third"))),
        "resistance": _resistance(runs, si),
        **pages,
    }


def _inputs(
    ledger: Ledger, runs: Runs, typed: Mapping[Input, float], si: Mapping[str, float]
) -> Tree:
    first = runs[0][1].impact
    constants = {
        "pi_": math.pi,
        "ksi_Pa": to_si("ksi"),
        "travel_most": COARSE,
        "excess_most": DIGITS,
        "off_stop_most": OFF_STOP,
    }
    derived = {
        "D_p": first.diameter,
        "M_p": first.mass,
        "half_step": first.step / 2 * 1e9,
        "mean_radius": si["D_mean"] / 2 * 1e6,
    }
    resistances = {
        f"R_t{page.input_suffix}": sheet.impact.target_resistance for page, sheet in runs
    }
    changed = {entry.name for entry, number in typed.items() if number != entry.of_report(ledger)}
    values: Tree = {f"{name}.check": "" for name in (*constants, *derived, *resistances)}
    values |= constants | {
        "from": "yours",
        "taken": "yours",
        "choice": "",
        "unusable": 0,
        "changed": len(changed),
        "message": MESSAGES["changed" if changed else "unchanged"],
        **derived,
    }
    values |= {f"{name}.written": number for name, number in constants.items()}
    for entry, number in typed.items():
        name = entry.name
        unchanged = "as inferred" if name == "rho_t" else "the report’s"
        check = "yours" if name in changed else unchanged
        values |= {name: si[name], f"{name}.typed": number, f"{name}.check": check}
    return values | resistances


def _case_values(page: CaseSheet, sheet: Sheet, si: Mapping[str, float]) -> Tree:
    impact, final = sheet.impact, sheet.rows[-1]
    trust, message = _run_state(sheet)
    v, at_rest = impact.velocity, _without_steps(impact)
    at_stop = _without_steps(impact, to_stop=True)
    rest, stop = at_rest["normalized_depth"], at_stop["normalized_depth"]
    travel = impact.step * v / impact.radius
    return {
        **impact.motion,
        **{name: getattr(impact, name) for name in ("mass", "diameter", "step", "stop_velocity")},
        **{name: getattr(sheet, name) for name in ("steps", "final_depth", "normalized_depth")},
        "label": page.label,
        "renamed": None if page.resistance_given else "",
        "row": _row_columns(sheet, page.rows),
        "message": message,
        "trust": trust,
        "stopped": 1,
        "depth_um": sheet.final_depth * 1e6,
        "stop_time": final.time,
        "final_velocity": v if final.velocity_final is None else final.velocity_final,
        "excess": sheet.normalized_depth / si["observed_ratio"],
        **{name: at_rest[name] for name in ("pressure", "c")},
        **{f"exact_{name}": at_rest[name] for name in ("normalized_depth", "depth_um")},
        "travel": travel,
        "too_long": too_long(travel),
        "over_exact": sheet.normalized_depth / rest,
        **{f"stop_{name}": at_stop[name] for name in ("pressure", "c", "normalized_depth")},
        "stop_share": stop / rest,
        "over_stop": sheet.normalized_depth / stop if stop else NOT_COMPUTED,
    }


def _figure_3_curve(page: CaseSheet, sheet: Sheet) -> Tree:
    """Return a curve of Figure 3 in ns and µm; after the stop, the last row is repeated."""
    rows = [sheet.rows[min(k, sheet.steps)] for k in range(page.rows + 1)]
    return {
        "time": [row.time * 1e9 for row in rows],
        "depth": [row.depth * 1e6 for row in rows],
        "message": f"{page.label}: {_run_state(sheet)[1]}",
    }


def _figure_5(impact: Impact, si: Mapping[str, float]) -> Tree:
    low, high, last = si["V_from"], si["V_to"], sheets.POINTS - 1
    velocities = [low + (high - low) * point / last for point in range(sheets.POINTS)]
    points = [_without_steps(replace(impact, velocity=velocity)) for velocity in velocities]
    columns = {key: [point[key] for point in points] for key in points[0]}
    return {"message": MESSAGES["all_points"], "velocity": velocities, **columns}


def _convergence(runs: Runs, inputs: Tree) -> Tree:
    """Return the ladder of time steps: depths [um] and their errors against the depth at rest [um].

    With it come the inputs of these runs, and those in use.
    """
    of_runs = {name: inputs[name] for name in sheets.run_inputs([page for page, _ in runs])}
    values: Tree = {"message": MESSAGES["current"]}
    for page, sheet in runs:
        time_steps = ladder(sheet.impact.step, sheets.LEVELS)
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
            "order": [None, *(sheets.NO_ORDER if order is None else order for order in orders)],
            "state": [_run_state(level)[1] for level in levels],
        }
    return values | {"run": of_runs, "in_use": of_runs, "same": dict.fromkeys(of_runs, 1)}


def _frank_zook(impact: Impact, si: Mapping[str, float]) -> Tree:
    ratio, k_t = estimates.sphere_length_ratio(), si["k_t"]
    v, target = impact.velocity, impact.target_density
    values: Tree = {"length_ratio": ratio}
    for which, name in (("rha", "R_t_RHA"), ("lower", "R_t_lower")):
        r_t = si[name]
        arguments = ratio, impact.particle_density, target, si["k_1"], k_t, r_t, v
        values[which] = {
            "resistance": r_t,
            "pressure": k_t * target * v * v / r_t,
            "as_printed": estimates.frank_zook_as_printed(*arguments),
            "derived": estimates.frank_zook_derived(*arguments),
        }
    return values


def _crater(impact: Impact, si: Mapping[str, float], third: float) -> Tree:
    radius = si["D_mean"] / 2
    volume = crater.volume(radius)
    volume_um3 = volume * 1e6 * 1e6 * 1e6
    contact = crater.contact_diameter(third, si["D_mean"])
    values: Tree = {
        "particle_volume": volume,
        "particle_volume_um3": volume_um3,
        "on_line": si["CV_PV_line"] * volume_um3,
        "third": third,
        "contact_diameter": contact,
        "contact_diameter_um": contact * 1e6,
    }
    for which, name in (("least", "CV_PV"), ("line", "CV_PV_line")):
        y = crater.depth_from_volume_ratio(si[name])
        x = y * radius
        volume = crater.cap_volume(x, radius)
        values[which] = {
            "normalized_depth": y,
            "over_diameter": y / 2,
            "depth": x,
            "depth_um": x * 1e6,
            "volume": volume,
            "volume_um3": volume * 1e6 * 1e6 * 1e6,
            "ratio": crater.volume_ratio(y),
        }
    for which, size in (("smallest", "d_min"), ("largest", "d_max")):
        mass = particle_mass(si[size] / 2, impact.particle_density)
        velocity = estimates.particle_velocity(impact.velocity, mass, impact.mass)
        values |= {f"{which}_mass": mass, f"{which}_velocity": velocity}
    return values


def _resistance(runs: Runs, si: Mapping[str, float]) -> Tree:
    alpha = estimates.walker_anderson_alpha(si["E_t"], si["Y_steel"])
    betas = {
        "goodier_beta": estimates.goodier_beta(si["q_Y"]),
        "walker_anderson_beta": estimates.walker_anderson_beta(alpha),
        "brinell_beta": si["HB_ratio"],
    }
    grains = {name: si[f"S_{name}"] / 1e6 for name in ("feathery", "clear", "bulk")}
    mean = (grains["feathery"] + grains["clear"]) / 2
    values: Tree = betas | {
        "alpha": alpha,
        "least_beta": min(betas.values()),
        "greatest_beta": max(betas.values()),
        **grains,
        "mean_grain": mean,
        "clear_over_bulk": grains["clear"] / grains["bulk"],
        "grain_over_bulk": mean / grains["bulk"],
        "strain_rate": estimates.strain_rate(si["V_impact"], si["L_typ"]),
    }
    for page, sheet in runs:
        impact, r_t = sheet.impact, sheet.impact.target_resistance
        stress = estimates.centerline_stress(impact.target_density, impact.velocity, r_t)
        values[page.slug] = {
            "target_resistance": r_t,
            "centerline_stress": stress,
            "over_copper": stress / si["Y_copper"],
        }
    return values


def _keyed(tree: Any, key: str = "") -> Iterator[tuple[str, Value]]:
    """Yield the values of a tree with their keys.

    >>> dict(_keyed({"low": {"steps": 85, "time": [0.0, 2e-10]}}))
    {'low.steps': 85.0, 'low.time[0]': 0.0, 'low.time[1]': 2e-10}
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
    ledger: Ledger, plan: WorkbookPlan, values: Mapping[str, Value], findings: Findings
) -> dict[str, Value]:
    """Return the live verdicts, by key, on the values of the cells that compute claims.

    With them come the sheets that show them: the check of Table A-1, the counts, and the results
    that `Overview` repeats.
    """
    audit: Tree = {}
    table: Tree = {}
    for claim in ledger.claims.values():
        if not claim.workbook:
            continue
        value = values[plan.cells[place_of(claim.workbook)].key]
        audit[claim.id] = {"computed": value, "verdict": _live_verdict(value, claim.interval())}
        if claim.place.cell and claim.printed:
            difference = _difference(value, claim.printed, exact=claim.is_exact)
            table[claim.place.cell] = audit[claim.id] | {"difference": difference}
    verdicts = [judged["verdict"] for judged in audit.values()]
    counts = {ending: verdicts.count(verdict) for verdict, ending in sheets.KINDS}
    overview = {f"audit_{ending}": count for ending, count in counts.items()}
    for name in (*findings.failing, *findings.differing):
        if name in audit:
            overview[name] = audit[name]["computed"]
    return dict(_keyed({"audit": audit | counts, "overview": overview, "table_check": table}))


def _without_steps(impact: Impact, to_stop: bool = False) -> dict[str, float]:
    """Return the depth at the velocity u without time steps, and the terms of its equation.

    u is 0 (at rest), or with `to_stop` the stop velocity. `pressure` is
    p = rho_t (V^2 - u^2) / (2 R_t + rho_t u^2) [1], and c = (4 rho_p / 3 rho_t) ln(1 + p) [1].
    """
    v, radius, particle, target, r_t = impact.motion.values()
    u, reached = 0.0, depth.normalized_depth(v, particle, target, r_t)
    if to_stop:
        u = min(impact.stop_velocity, v)  # an impact below the stop velocity has depth 0
        reached = depth.depth_at_velocity(u, **impact.motion) / radius
    pressure = target * (v - u) * (v + u) / (2 * r_t + target * u * u)
    return {
        "pressure": pressure,
        "c": 4 * particle / (3 * target) * math.log1p(pressure),
        "normalized_depth": reached,
        "depth_um": radius * reached * 1e6,
    }


def _run_state(sheet: Sheet) -> tuple[int, str]:
    """Return how far a run can be trusted, and the message that says so.

    2: it is sound; 1: only its last velocity is not; 0: it must not be used.
    """
    kinds = doubts_about(sheet).keys()
    if not kinds - {"reversed", "short"}:
        if "reversed" in kinds:
            return 1, MESSAGES["reversed"]
        return 2, MESSAGES["early" if "short" in kinds else "complete"]
    doubt = "coarse" if "coarse" in kinds else "doubtful"
    return 0, MESSAGES[{0: "no_steps", 1: "one_step"}.get(sheet.steps, doubt)]


def _row_columns(sheet: Sheet, count: int) -> dict[str, list[float | str | None]]:
    """Return the cells of rows 0 to `count`, by column; below the stop they are blank ("")."""
    impact = sheet.impact
    columns: dict[str, Any] = dict(zip(Row._fields, zip(*sheet.rows, strict=True), strict=True))
    columns["index"] = range(len(sheet.rows))
    columns["depth_um"] = (x * 1e6 for x in columns["depth"])
    if sheet.scheme == "centered":
        materials = impact.radius, impact.mass, impact.target_density, impact.target_resistance
        columns["velocity_middle"] = [None]  # row 0 has none
        for row in sheet.rows[1:]:
            x, v = row.depth, row.velocity_initial
            middle = v - deceleration(x, v, *materials) * (impact.step / 2)
            columns["velocity_middle"].append(middle)
    blank = [""] * (count - sheet.steps)
    return {name: [*column, *blank] for name, column in columns.items()}


def _live_verdict(value: Value, interval: Interval) -> str:
    """Return the live verdict on a double; the ends of the interval are taken as doubles, too."""
    if not isinstance(value, float):
        return NOT_COMPUTED
    if interval.is_point:
        # To nine digits, since no double is exactly 2/3.
        (exact, _) = interval.ends
        inside = abs(Fraction(value) - exact) * 10**9 <= abs(exact)
    else:
        ends = interval.lower, interval.upper
        low, high = (None if end is None else Fraction(float(end)) for end in ends)
        in_doubles = Interval(low, high, interval.lower_closed, interval.upper_closed)
        inside = in_doubles.contains(Fraction(value))
    return sheets.AS_PRINTED if inside else sheets.OTHERWISE


def _difference(value: Value, printed: Printed, *, exact: bool) -> Value:
    """Return computed minus printed; in units of the last printed digit unless that is exact."""
    if not isinstance(value, float):
        return "–"  # the table has fewer rows
    difference = value - float(printed.value)
    return difference if exact else round(difference / float(printed.quantum), sheets.DIGITS)
