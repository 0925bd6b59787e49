"""The live workbook of the report, or of one case: its values by key, its file, its verification.

The values come from the models, computed without any knowledge of the formula texts; a value and
the formula that must give it meet in one cell. The plan's `where` tells which cell holds a key.
"""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from reference.ledger import Ledger, load
from reference.printed import Interval, Printed, Rounding
from reference.units import to_si
from replication.cases import BETA_3, BETA_5
from replication.error import COARSE, DEEP
from replication.error import warnings as doubts_about
from replication.models import crater, depth, frank_zook, resistance, stream
from replication.models.impact import Impact, particle_mass
from replication.models.sheet import SCHEMES, Row, Sheet, deceleration, run
from replication.text import with_unit
from spreadsheets import emit
from spreadsheets.plan import NOT_COMPUTED, Value, WorkbookPlan, place_of
from spreadsheets.sheets import audit, figures, inputs, steps, table_a1, workbook_plan
from spreadsheets.sheets.audit import Findings

if TYPE_CHECKING:
    from replication.audit.record import Record


@dataclass(frozen=True)
class Workbook:
    """A workbook before it is a file.

    warnings: about runs that are not to be trusted. rounding: `rounding_bound` of its sheets.
    """

    plan: WorkbookPlan
    values: Mapping[str, Value]
    warnings: Sequence[str]
    rounding: float

    def to_bytes(self) -> bytes:
        """The bytes of the .xlsx file."""
        return emit.to_bytes(self.plan, self.values)

    @property
    def cells(self) -> dict[str, dict[str, Value]]:
        """What every cell must show, by sheet and address."""
        return emit.cell_values(self.plan, self.values)


def build(
    case: Impact | None = None,
    scheme: str = "published",
    rows: int | None = None,
    record: "Record | None" = None,
    *,
    ledger: Ledger | None = None,
) -> Workbook:
    """The workbook of a case; or, of none, the report's own.

    That has both cases of the report, and what is about the report alone: the sheets with its other
    time step, the check of Table A-1, and the audit. scheme: one of `SCHEMES`. rows: those to
    prepare after row 0, by default twice as many as the longest case takes. record: the finished
    audit, made where it is needed and not given. A number that the cell of its unit cannot hold to
    the last bit is taken as the nearest that it can.

    Raises ValueError where a number is outside of what the workbook takes, and where a case takes
    more steps than there are rows.

    >>> book = build(BETA_5)
    >>> place = book.plan.where["case.depth_um"]
    >>> place[0], f"{book.values['case.depth_um']:.2f}"
    ('Sheet beta 5', '7.67')
    """
    if scheme not in SCHEMES:
        raise ValueError(f"there is no scheme {scheme!r}: choose one of {', '.join(SCHEMES)}")
    builder = _Builder(case, scheme, rows, ledger or load())
    if case is not None:
        return builder.workbook(None)
    if record is None:
        from replication.audit.audit import audit

        record = audit()
    return builder.workbook(findings_of(record, scheme, builder.ledger))


def rounding_bound(sheet: Sheet) -> float:
    """How far a sheet in doubles may lie from exact arithmetic, relative to a column's largest.

    In n rows of the impact velocity V, the final depth X and the duration T, with u = 2^-53:

    - what enters is rounded: at most 26 u of the deceleration a (16 of them by the mass);
    - a row takes 12 operations to a dt, relative errors of u each, and a subtraction from v: so
      the rows add at most (n + 38) u V to the velocity, since the a dt add up to V;
    - a row adds v dt to x: at most (n + 3) u X in all;
    - an error in v moves x by T times itself, in X by T V / X as much as in V; an error in x turns
      a, whose rise with x is at most a/x, by as much; the resistance damps both;
    - in a both stand, squared velocity and area, with factors of at most 4.

    So no column is off by more than 4 (2n + 41) max(1, T V / X) u of its largest number. Results
    take fewer than the 41 operations that are counted beside the rows.

    >>> f"{rounding_bound(run(BETA_5)):.1e}"
    '2.3e-13'
    """
    n, final = sheet.steps, sheet.rows[-1]
    stretch = final.time * sheet.impact.velocity / final.depth if final.depth else 1.0
    return 4 * (2 * n + 41) * max(1.0, stretch) * 2.0**-53


def findings_of(record: "Record", scheme: str, ledger: Ledger) -> Findings:
    """What the audit tells the workbook, with the verdicts under its scheme."""
    from replication.audit.verdict import Verdict

    usual = (Rounding.AWAY.value, "exact", "rounded", scheme)
    verdicts = {claim.id: str(claim.verdict) for claim in record.claims}
    explanations = {claim.id: claim.explanation for claim in record.claims}
    for name in explanations if scheme != SCHEMES[0] else ():
        if ledger.claims[name].by_scheme:
            explanations[name] = f"With the {SCHEMES[0]} scheme: {explanations[name]}"
    for claim in record.claims:
        for judged in claim.otherwise:
            if (judged.rounding, judged.choices, judged.header, judged.scheme) == usual:
                verdicts[claim.id] = str(judged.verdict)
    counts = Counter(verdicts.values())
    return Findings(
        headline=record.headline,
        counts={verdict: counts[verdict] for verdict in record.summary},
        verdicts=verdicts,
        explanations=explanations,
        failing=[name for name, verdict in verdicts.items() if Verdict(verdict).is_failure],
        differing=[name for name, verdict in verdicts.items() if verdict == Verdict.DIFFERS],
    )


def _si(typed: float, unit: str) -> float:
    """A number of a cell in SI, rounded once."""
    factor = to_si(unit)
    return typed * float(factor) if factor >= 1 else typed / float(1 / factor)


def _typed(si: float, unit: str) -> float:
    """The number to type so that the cell holds this SI value, or the nearest that it can hold.

    >>> _typed(2e-10, "ns"), _typed(11e-6, "um")
    (0.2, 11.0)
    """
    nearest = float(Fraction(si) / to_si(unit))
    around = nearest, math.nextafter(nearest, math.inf), math.nextafter(nearest, -math.inf)
    return next((typed for typed in around if _si(typed, unit) == si), nearest)


_CASE_INPUTS = {
    "V_impact": "velocity",
    "R_p": "radius",
    "rho_p": "particle_density",
    "rho_t": "target_density",
    "dt_s": "step",
    "v_stop": "stop_velocity",
    "Y_t": "flow_stress",
    "R_t": "resistance",
}
"""Inputs that come from the cases -> the attributes of an Impact."""

_TABLE = ("radius", "particle_density", "mass", "diameter", "velocity", "resistance")
"""What Table A-1 prints above its rows."""


class _Builder:
    """Computes the values of one workbook. A case is known by its slug: low and high, or case."""

    def __init__(self, case: Impact | None, scheme: str, rows: int | None, ledger: Ledger) -> None:
        self.scheme, self.ledger = scheme, ledger
        self.cases = {"low": BETA_3, "high": BETA_5} if case is None else {"case": case}
        self.pages = {slug: self._page(slug, impact) for slug, impact in self.cases.items()}
        blocks = inputs.inputs_of(list(self.pages.values()), report=case is None)
        self.entries = {entry.name: entry for block in blocks.values() for entry in block}
        self.typed = {name: self._to_type(entry) for name, entry in self.entries.items()}
        self.changed = {n for n, e in self.entries.items() if self.typed[n] != e.of_report(ledger)}
        self.si = {name: _si(self.typed[name], e.unit) for name, e in self.entries.items()}
        # The cases with the numbers that their cells hold.
        held = {of: self.si[name] for name, of in _CASE_INPUTS.items() if name in self.si}
        self.impacts = {slug: replace(impact, **held) for slug, impact in self.cases.items()}
        self.first, self.last = (list(self.impacts.values())[k] for k in (0, -1))
        self.sheets = {slug: run(impact, scheme) for slug, impact in self.impacts.items()}
        self.coarse: dict[str, Sheet] = {}
        for slug, impact in self.impacts.items() if case is None else ():
            self.coarse[slug] = run(replace(impact, step=self.si[inputs.COARSE]), scheme)
        self.rows = steps.prepared_rows(max(s.steps for s in self.sheets.values()), rows)
        self.ladder = [self.first.step * 2.0 ** (4 - k) for k in range(figures.LEVELS)]
        self.levels = {slug: _levels(i, self.ladder, scheme) for slug, i in self.impacts.items()}

    def _page(self, slug: str, impact: Impact) -> steps.CaseSheet:
        """What the plan must know of a case's sheet, but for its length."""
        beta = "3" if impact.beta == BETA_3.beta else "5"
        own = {BETA_3: "3", BETA_5: "5"}.get(impact, "")
        return steps.CaseSheet(
            name="Sheet" if impact.beta is None else f"Sheet beta {impact.beta:.4g}",
            slug=slug,
            label=_label(impact),
            steps=0,
            rows=0,
            scheme=self.scheme,
            beta_claim=f"depth-beta-{beta}-beta",
            depth_claim=own and f"depth-beta-{own}",
            ratio_claim=own and f"ratio-beta-{own}",
            resistance_given=impact.resistance is not None,
        )

    def _to_type(self, entry: inputs.Input) -> float:
        """The number to type into an input's cell. Raises ValueError outside of its limits."""
        name, limits = entry.name, entry.limits
        if name in _CASE_INPUTS:
            case = next(iter(self.cases.values()))
            number = _typed(getattr(case, _CASE_INPUTS[name]), entry.unit)
        elif name.startswith("beta"):
            number = self.cases[name.partition("_")[2] or "case"].beta or 0.0
        else:
            number = entry.of_report(self.ledger)
        if not limits.least <= number <= limits.most:
            what = entry.meaning or self.ledger.title(entry.source)
            most = with_unit(f"{limits.most:,.10g}", entry.unit)
            raise ValueError(
                f"the workbook takes {limits.least:,.10g} to {most} for the {what}, not {number!r}"
            )
        return number

    def workbook(self, findings: Findings | None) -> Workbook:
        """Plan and values."""
        longer = [_flags(case) for slug, case in self.cases.items() if slug == "case"]
        longer += [f"--scheme {self.scheme}"] * (self.scheme != SCHEMES[0])
        longer.append(f"--rows {min(10 * self.rows, steps.MAX_ROWS)}")
        command = " ".join(["coldspray workbook", *longer]) if self.rows < steps.MAX_ROWS else ""
        more: dict[str, Any] = {"rows": self.rows, "longer": command}
        cases, coarse = (
            [replace(self.pages[slug], steps=sheet.steps, **more) for slug, sheet in runs.items()]
            for runs in (self.sheets, self.coarse)
        )
        plan = workbook_plan(
            self.ledger,
            cases,
            [replace(page, coarse=True, name=f"{page.name} coarse") for page in coarse],
            findings,
        )
        values = {
            key: value if isinstance(value, str) else float(value) for key, value in self._values()
        }
        if findings is not None:
            values |= live_verdicts(self.ledger, plan, values, findings)
        warnings = [
            f"{self.pages[slug].name}: {doubt.text}"
            for slug, sheet in self.sheets.items()
            for doubt in doubts_about(sheet)
        ]
        rounding = max(map(rounding_bound, (*self.sheets.values(), *self.coarse.values())))
        return Workbook(plan, values, warnings, rounding)

    # The values, sheet by sheet

    def _values(self) -> Iterator[tuple[str, Any]]:
        parts: dict[str, Any] = {
            "inputs": self._inputs(),
            "table": self._table(),
            "figure_3": self._figure_3(),
            "figure_5": self._figure_5(),
            "convergence": self._convergence(),
            "frank_zook": self._frank_zook(),
            "crater": self._crater(),
            "resistance": self._resistance(),
            "overview": self._overview(),
        }
        for slug, sheet in self.sheets.items():
            parts[slug] = self._sheet(slug, sheet)
        for slug, sheet in self.coarse.items():
            fine = self.sheets[slug].final_depth * 1e6
            over = sheet.final_depth * 1e6 / fine if fine else NOT_COMPUTED
            against = {"fine_depth_um": fine, "over_fine": over}
            parts[f"{slug}_coarse"] = self._sheet(slug, sheet) | against
        for part, held in parts.items():
            for what, value in dict(held).items():
                yield f"{part}.{what}", value

    def _inputs(self) -> Iterator[tuple[str, Any]]:
        for name in self.entries:
            yield name, self.si[name]
            yield f"{name}.typed", self.typed[name]
            own = "as inferred" if name == "rho_t" else "the report’s"
            yield f"{name}.check", "yours" if name in self.changed else own
        yield from {
            "from": "yours",
            "unusable": 0,
            "changed": len(self.changed),
            "message": inputs.MESSAGES["changed" if self.changed else "same"],
            "D_p": self.first.diameter,
            "M_p": self.first.mass,
            "half_step": self.first.step / 2 * 1e9,
            "mean_radius": self.si["D_mean"] / 2 * 1e6,
            "travel_most": COARSE,
            "excess_most": DEEP,
        }.items()
        for slug, impact in self.impacts.items():
            if impact.resistance is None:
                yield self.pages[slug].named("R_t"), impact.target_resistance

    def _overview(self) -> Iterator[tuple[str, Any]]:
        yield from {"inputs_changed": len(self.changed), "inputs_unusable": 0}.items()
        for slug, sheet in self.sheets.items():
            yield f"{slug}.depth_um", sheet.final_depth * 1e6
            yield f"{slug}.normalized_depth", sheet.normalized_depth
            yield f"{slug}.message", _state(sheet)[1]

    def _table(self) -> dict[str, Any]:
        sheet, given = list(self.sheets.values())[-1], _given(self.last)
        return {name: given[name] for name in _TABLE} | dict(_row_values(sheet, table_a1.ROWS - 1))

    def _sheet(self, slug: str, sheet: Sheet) -> dict[str, Any]:
        impact, final = sheet.impact, sheet.rows[-1]
        held = _given(impact) | dict(_row_values(sheet, self.rows))
        for k in range(self.rows + 1):
            used = k <= sheet.steps
            held[f"row[{k}].index"] = k if used else ""
            held[f"row[{k}].depth_um"] = sheet.rows[k].depth * 1e6 if used else ""
        trust, message = _state(sheet)
        v, exact = impact.velocity, depth.normalized_depth(*_materials(impact))
        if impact.resistance is None:
            held |= {"label": self.pages[slug].label, "renamed": ""}
        return held | {
            "message": message,
            "trust": trust,
            "stopped": 1,
            "final_depth": sheet.final_depth,
            "depth_um": sheet.final_depth * 1e6,
            "normalized_depth": sheet.normalized_depth,
            "steps": sheet.steps,
            "stop_time": final.time,
            "final_velocity": v if final.velocity_final is None else final.velocity_final,
            "excess": sheet.normalized_depth / self.si["observed_ratio"],
            **_work(impact),
            "exact_normalized_depth": exact,
            "exact_depth_um": depth.final_depth(*impact.motion.values()) * 1e6,
            "travel": impact.step * v / impact.radius,
            "over_exact": sheet.normalized_depth / exact,
        }

    def _figure_3(self) -> Iterator[tuple[str, Any]]:
        """The curves in ns and µm; after the stop they hold the last row."""
        for slug, sheet in self.sheets.items():
            for k in range(self.rows + 1):
                row = sheet.rows[min(k, sheet.steps)]
                yield f"{slug}.time[{k}]", row.time * 1e9
                yield f"{slug}.depth[{k}]", row.depth * 1e6
            yield f"{slug}.message", f"{self.pages[slug].label}: {_state(sheet)[1]}"

    def _figure_5(self) -> Iterator[tuple[str, Any]]:
        low, high = self.si["V_from"], self.si["V_to"]
        yield "message", figures.COMPLETE
        for point in range(figures.POINTS):
            there = replace(self.last, velocity=low + (high - low) * point / (figures.POINTS - 1))
            yield f"velocity[{point}]", there.velocity
            yield f"normalized_depth[{point}]", depth.normalized_depth(*_materials(there))
            yield f"depth_um[{point}]", depth.final_depth(*there.motion.values()) * 1e6
            for what, value in _work(there).items():
                yield f"{what}[{point}]", value

    def _convergence(self) -> Iterator[tuple[str, Any]]:
        """The ladder of the cases as written, with inputs that are as yet those in use."""
        for k, step in enumerate(self.ladder):
            yield f"step[{k}]", step
            yield f"step_ns[{k}]", step * 1e9
        of_runs = {name: self.si[name] for name in figures.RUN_INPUTS}
        for slug, impact in self.impacts.items():
            of_runs[self.pages[slug].named("R_t")] = impact.target_resistance
            for what, value in self.levels[slug].items():
                yield f"{slug}.{what}", value
        for name, value in of_runs.items():
            yield from {f"run.{name}": value, f"in_use.{name}": value, f"same.{name}": 1}.items()
        yield "message", figures.CURRENT

    def _frank_zook(self) -> Iterator[tuple[str, Any]]:
        impact, ratio, k_t = self.last, frank_zook.sphere_length_ratio(), self.si["k_t"]
        v, target = impact.velocity, impact.target_density
        yield "length_ratio", ratio
        for which, name in (("rha", "R_t_RHA"), ("lower", "R_t_lower")):
            r_t = self.si[name]
            arguments = ratio, impact.particle_density, target, self.si["k_1"], k_t, r_t, v
            yield f"{which}.resistance", r_t
            yield f"{which}.pressure", k_t * target * v * v / r_t
            yield f"{which}.as_printed", frank_zook.depth_as_printed(*arguments)
            yield f"{which}.derived", frank_zook.depth_derived(*arguments)

    def _crater(self) -> Iterator[tuple[str, Any]]:
        impact, third = self.first, float(self.ledger.value("observed-third"))
        volume = crater.volume(impact.radius)
        contact = crater.contact_diameter(third, impact.diameter)
        yield from {
            "volume": volume,
            "volume_um3": _cubed(volume),
            "on_line": self.si["CV_PV_line"] * _cubed(volume),
            "third": third,
            "contact_diameter": contact,
            "contact_diameter_um": contact * 1e6,
        }.items()
        for which, name in (("least", "CV_PV"), ("line", "CV_PV_line")):
            y = crater.depth_from_volume_ratio(self.si[name])
            x = y * impact.radius
            cap = crater.cap_volume(x, impact.radius)
            yield f"{which}.normalized_depth", y
            yield f"{which}.over_diameter", y / 2
            yield f"{which}.depth", x
            yield f"{which}.depth_um", x * 1e6
            yield f"{which}.volume", cap
            yield f"{which}.volume_um3", _cubed(cap)
            yield f"{which}.ratio", crater.volume_ratio(y)
        sizes = self.si["d_min"], impact.diameter, self.si["d_max"]
        for which, size in zip(("smallest", "average", "largest"), sizes, strict=True):
            mass = particle_mass(size / 2, impact.particle_density)
            yield f"{which}_mass", mass
            velocity = stream.particle_velocity(impact.velocity, mass, impact.mass)
            yield f"{which}_velocity", velocity

    def _resistance(self) -> dict[str, Any]:
        alpha = resistance.walker_anderson_alpha(self.si["E_t"], self.si["Y_steel"])
        betas = {
            "goodier_beta": resistance.goodier_beta(self.si["q_Y"]),
            "walker_anderson_beta": resistance.walker_anderson_beta(alpha),
            "brinell_beta": resistance.brinell_beta(self.si["HB_ratio"]),
        }
        feathery, clear, bulk = (self.si[f"S_{w}"] / 1e6 for w in ("feathery", "clear", "bulk"))
        mean = (feathery + clear) / 2
        held = betas | {
            "alpha": alpha,
            "least_beta": min(betas.values()),
            "greatest_beta": max(betas.values()),
            "feathery": feathery,
            "clear": clear,
            "bulk": bulk,
            "mean_grain": mean,
            "clear_over_bulk": clear / bulk,
            "grain_over_bulk": mean / bulk,
            "strain_rate": stream.strain_rate(self.first.velocity, self.si["L_typ"]),
        }
        for slug, impact in self.impacts.items():
            r_t = impact.target_resistance
            stress = resistance.centerline_stress(impact.target_density, impact.velocity, r_t)
            held[f"{slug}.target_resistance"] = r_t
            held[f"{slug}.centerline_stress"] = stress
            held[f"{slug}.over_copper"] = stress / self.si["Y_copper"]
        return held


def live_verdicts(
    ledger: Ledger, plan: WorkbookPlan, values: Mapping[str, Value], findings: Findings
) -> dict[str, Value]:
    """Live verdicts, and the check of Table A-1, of the doubles in the claims' cells.

    Whether a live verdict is the proven one, a test asks.
    """
    held: dict[str, Value] = {}
    for claim in audit.computed_claims(ledger):
        value = values[plan.cell(place_of(str(claim.workbook))).key]
        held[f"audit.{claim.id}.computed"] = value
        held[f"audit.{claim.id}.verdict"] = _verdict(value, claim.interval())
    verdicts = [value for key, value in held.items() if key.endswith(".verdict")]
    for text, what in audit.KINDS:
        held[f"audit.{what}"] = held[f"overview.audit_{what}"] = float(verdicts.count(text))
    for name in (*findings.failing, *findings.differing):
        if ledger.claims[name].workbook:
            held[f"overview.{name}"] = held[f"audit.{name}.computed"]
    for claim in ledger.claims.values():
        if claim.place.cell and claim.printed:
            value = values[plan.cell(("Table A-1", claim.place.cell)).key]
            held |= _checked(claim.place.cell, value, claim.printed, exact=claim.is_exact)
    return held


def _label(impact: Impact) -> str:
    """What tells a case from the other, spelled as spreadsheet programs join a number to a text."""
    return "R_t as given" if impact.beta is None else f"β = {round(impact.beta, 6):.15g}"


def _flags(impact: Impact) -> str:
    """The options of `coldspray workbook` for a case."""
    name, base = ("beta-3", BETA_3) if impact.beta == BETA_3.beta else ("beta-5", BETA_5)
    given = {field.name: getattr(impact, field.name) for field in fields(impact)}
    return f"--case {name}" + "".join(
        f" --{key.replace('_', '-')} {value!r}"
        for key, value in given.items()
        if value is not None and value != getattr(base, key)
    )


def _given(impact: Impact) -> dict[str, Any]:
    """What a sheet shows of its case, by name; the resistance is that in use."""
    names = ("mass", "diameter", "step", "stop_velocity")
    return impact.motion | {name: getattr(impact, name) for name in names}


def _materials(impact: Impact) -> tuple[float, float, float, float]:
    return impact.velocity, impact.particle_density, impact.target_density, impact.target_resistance


def _work(impact: Impact) -> dict[str, float]:
    """Dynamic pressure over target resistance, rho_t V^2 / 2 R_t [1], and c of the closed form."""
    v, particle, target, r_t = _materials(impact)
    pressure = target * v * v / 2 / r_t
    return {"pressure": pressure, "c": 4 * particle / (3 * target) * math.log1p(pressure)}


def _state(sheet: Sheet) -> tuple[int, str]:
    """2 where nothing is to be said against a run, 1 where only its last velocity is wrong, 0."""
    kinds = [doubt.kind for doubt in doubts_about(sheet)]
    trust = 0 if set(kinds) - {"reversed"} else 1 if kinds else 2
    message = (steps.DOUBTFUL, steps.REVERSED, steps.COMPLETE)[trust]
    return trust, message if sheet.steps else steps.NO_STEPS


def _cubed(volume: float) -> float:
    return volume * 1e6 * 1e6 * 1e6


def _row_values(sheet: Sheet, rows: int) -> Iterator[tuple[str, Any]]:
    """The cells of so many rows but the final velocity of row 0; blank ("") below the stop."""
    impact = sheet.impact
    for k in range(rows + 1):
        used = k <= sheet.steps
        for name in Row._fields:
            value = getattr(sheet.rows[k], name) if used else ""
            if value is not None and (k, name) != (0, "velocity_final"):
                yield f"row[{k}].{name}", value
        if k and sheet.scheme == "centered":
            middle: float | str = ""
            if used:
                v, x = sheet.rows[k].velocity_initial, sheet.rows[k].depth
                materials = impact.mass, impact.target_density, impact.target_resistance
                a = deceleration(x, v, impact.radius, *materials)
                middle = v - a * (impact.step / 2)
            yield f"row[{k}].velocity_middle", middle


def _levels(impact: Impact, ladder: Sequence[float], scheme: str) -> dict[str, Any]:
    """Final depths at steps, each half of the one before, against the depth at rest, in um."""
    rest = depth.final_depth(*impact.motion.values()) * 1e6
    held: dict[str, Any] = {"rest_um": rest}
    errors = []
    for k, step in enumerate(ladder):
        sheet = run(replace(impact, step=step), scheme)
        reached = sheet.final_depth * 1e6
        errors.append(reached - rest)
        held |= {f"steps[{k}]": sheet.steps, f"depth_um[{k}]": reached}
        held |= {f"error[{k}]": errors[k], f"size[{k}]": abs(errors[k])}
    for k, (above, here) in enumerate(pairwise(errors), 1):
        defined = min(above, here) > 0 or max(above, here) < 0
        held[f"order[{k}]"] = math.log(above / here) / math.log(2) if defined else figures.NO_ORDER
    return held


def _verdict(value: Value, interval: Interval) -> str:
    """Whether a double lies between the interval's ends, themselves taken as doubles."""
    if not isinstance(value, float):
        return NOT_COMPUTED
    ends = interval.lower, interval.upper
    if interval.is_point:
        # Exact text, such as 2/3, which no double is: to nine digits.
        (exact, _) = interval.ends
        inside = abs(Fraction(value) - exact) * 10**9 <= abs(exact)
    else:
        low, high = (None if end is None else Fraction(float(end)) for end in ends)
        rounded = Interval(low, high, interval.lower_closed, interval.upper_closed)
        inside = rounded.contains(Fraction(value))
    return audit.AS_PRINTED if inside else audit.OTHERWISE


def _checked(address: str, value: Value, printed: Printed, *, exact: bool) -> dict[str, Value]:
    """The check of one number of Table A-1; blank where the table has fewer rows."""
    held: dict[str, Value] = {"computed": value, "difference": "–", "verdict": NOT_COMPUTED}
    if isinstance(value, float):
        difference = value - float(printed.value)
        if not exact:
            difference = round(difference / float(printed.quantum), table_a1.DIGITS)
        same = difference == 0 if exact else abs(difference) <= 0.5
        verdict = table_a1.SAME_TEXT if same else table_a1.OTHER_TEXT
        held |= {"difference": difference, "verdict": verdict}
    return {f"table_check.{address}.{what}": number for what, number in held.items()}
