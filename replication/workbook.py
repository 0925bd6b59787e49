"""The live workbook of one or two cases: what it holds, and its file.

The values come from the models, computed without any knowledge of the formula texts; a value and
the formula that must give it meet in one cell. The plan's `where` tells which cell holds a key.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from functools import cache
from pathlib import Path

from replication.cases import BETA_3, BETA_5
from replication.models.impact import Impact
from replication.models.sheet import Sheet, run
from replication.workbook_report import report_values
from replication.workbook_values import pressure_ratio, values_by_key
from spreadsheets import emit
from spreadsheets.engines import ENGINES
from spreadsheets.plan import Value, WorkbookPlan
from spreadsheets.sheets import workbook_plan
from spreadsheets.sheets.case import CaseSheet, prepared_rows
from spreadsheets.sheets.contents import coarse_name
from spreadsheets.sheets.inputs import INPUTS
from spreadsheets.verify import EngineCheck, verify

__all__ = [
    "REPORT",
    "Cases",
    "build",
    "relative_tolerance",
    "report_plan",
    "to_bytes",
    "values",
    "write",
    "write_verified",
]

Cases = Mapping[str, Impact]
"""Sheet name -> case: one case, or two that differ in nothing but beta or the resistance."""

REPORT: Cases = {"Sheet beta 3": BETA_3, "Sheet beta 5": BETA_5}
"""The report's own two cases. Under these names, with whatever inputs, a workbook has the sheets
that are about the report alone: its figures, its other time step, and the audit."""

_PRINTED = {BETA_3: ("10.0", "0.91"), BETA_5: ("7.67", "0.70")}


def to_bytes(cases: Cases = REPORT) -> bytes:
    """The workbook of these cases, as the bytes of its file. Raises as `build` does."""
    return emit.to_bytes(*build(cases))


def write(path: Path, cases: Cases = REPORT) -> None:
    """Write the workbook of these cases to `path` (.xlsx). Raises as `build` does."""
    emit.write(path, *build(cases))


def write_verified(path: Path, cases: Cases = REPORT) -> list[EngineCheck]:
    """Write the workbook and recalculate it in every engine of this machine.

    Raises as `build` does, and ValueError when there is no engine at all; nothing is written then.
    """
    if all(engine.missing() for engine in ENGINES):
        raise ValueError("no spreadsheet engine here: run pip install ironcalc formualizer")
    plan, values = build(cases)
    emit.write(path, plan, values)
    tolerances = dict.fromkeys(plan.transcendental, relative_tolerance(cases))
    return verify(path, emit.cell_values(plan, values), tolerances, ENGINES)


def values(cases: Cases = REPORT, written_for: Cases | None = None) -> dict[str, Value]:
    """The value of every key of the workbook. Raises as `build` does."""
    return build(cases, written_for)[1]


def build(
    cases: Cases = REPORT, written_for: Cases | None = None
) -> tuple[WorkbookPlan, dict[str, Value]]:
    """The plan of the workbook and its values by key.

    With `written_for`, of a workbook with as many rows as those cases need: one that was written
    for them and whose inputs were then changed. Raises ValueError unless there are one or two cases
    that share every input but beta or the resistance, and when a case needs more steps than
    `prepared_rows` admits, or than there are rows.

    >>> plan, values = build()
    >>> plan.where["high.depth_um"], f"{values['high.depth_um']:.2f}"
    (('Sheet beta 5', 'K22'), '7.67')
    """
    _require_shared_inputs(list(cases.values()))
    slugs = ("case",) if len(cases) == 1 else ("low", "high")
    sheets = {slug: run(one) for slug, one in zip(slugs, cases.values(), strict=True)}
    names = dict(zip(slugs, cases, strict=True))
    sizing = list((cases if written_for is None else written_for).values())
    fine = _case_sheets(names, sheets, _rows(sizing))
    if list(cases) != list(REPORT):
        return workbook_plan(fine), values_by_key(sheets, fine[0].rows)
    step = INPUTS["dt_coarse"].si
    again = {slug: run(replace(s.impact, step=step)) for slug, s in sheets.items()}
    rows = _rows([replace(impact, step=step) for impact in sizing])
    coarse = _case_sheets(names, again, rows, coarse=True)
    plan = workbook_plan(fine, coarse)
    values = values_by_key(sheets, fine[0].rows)
    return plan, values | report_values(values, sheets, again, coarse[0].rows)


@cache
def report_plan() -> WorkbookPlan:
    """The plan of the report's own workbook: which cell holds what."""
    return build()[0]


def _rows(impacts: Sequence[Impact]) -> int:
    """The rows that every sheet of a workbook for these cases has, after row 0."""
    return prepared_rows(max(run(impact).steps for impact in impacts))


def _case_sheets(
    names: Mapping[str, str], sheets: Mapping[str, Sheet], rows: int, *, coarse: bool = False
) -> list[CaseSheet]:
    """What the plan must know of these cases' sheets, of so many rows each."""
    longest = max(sheet.steps for sheet in sheets.values())
    if longest > rows:
        raise ValueError(f"the case needs {longest} steps, and the workbook has {rows} rows")
    return [
        CaseSheet(
            name=coarse_name(names[slug]) if coarse else names[slug],
            slug=slug,
            steps=sheet.steps,
            rows=rows,
            resistance_given=sheet.impact.resistance is not None,
            printed=_PRINTED.get(sheet.impact, ("", "")),
            coarse=coarse,
        )
        for slug, sheet in sheets.items()
    ]


def relative_tolerance(cases: Cases = REPORT) -> float:
    """How far a transcendental cell may lie from its stored value, relative to it.

    >>> f"{relative_tolerance():.1e}"
    '7.8e-15'
    """
    # A function result is within one ulp in any C library, and flips the last digit of each
    # operation after it. The longest chain is the crater's: ASIN, SIN, SIN and twelve products,
    # with condition numbers of at most 2, so less than 32 ulp of 2^-52. Where the sheet takes
    # LN(1 + p), its value is log1p(p): forming 1 + p adds half an ulp of 1 to the logarithm.
    slowest = INPUTS["V_from"].si  # of Figure 5
    impacts = [replace(one, velocity=min(one.velocity, slowest)) for one in cases.values()]
    logarithm = min(math.log1p(pressure_ratio(impact)) for impact in impacts)
    return 32 * 2**-52 + 2**-53 / logarithm


def _require_shared_inputs(impacts: Sequence[Impact]) -> None:
    if not 1 <= len(impacts) <= 2:
        raise ValueError(f"a workbook holds one or two cases, not {len(impacts)}")
    first, last = _shared(impacts[0]), _shared(impacts[-1])
    unlike = [name for name in first if first[name] != last[name]]
    if unlike:
        raise ValueError(f"the two cases may differ in beta or resistance, not in {unlike[0]}")


def _shared(impact: Impact) -> dict[str, object]:
    inputs = asdict(impact)
    del inputs["beta"], inputs["resistance"]
    return inputs
