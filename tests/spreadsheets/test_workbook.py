"""The workbook against Python: every cell the same double, in real engines, before and after edits.

Gnumeric is left out: it computes in long doubles, so its last digits are others by design.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from replication import workbook
from replication.cases import BETA_3, BETA_5
from replication.models.depth import final_depth
from replication.models.impact import Impact
from replication.workbook import REPORT, Cases
from spreadsheets import emit
from spreadsheets.compare import Difference, compare
from spreadsheets.engines import Engine, engine
from spreadsheets.plan import Value, WorkbookPlan
from spreadsheets.readback import read
from spreadsheets.sheets.results import NO_STOP, out_of_rows
from spreadsheets.sheets.table_a1 import PRINTED

DOUBLES = ("ironcalc", "formualizer", "libreoffice")

GIVEN = replace(BETA_5, beta=None, flow_stress=None, resistance=2.5e9)
CASES: dict[str, Cases] = {
    "report": REPORT,
    "beyond the radius": {"Sheet": replace(BETA_5, velocity=800.0)},
    "resistance given": {"Sheet": GIVEN},
    "two resistances": {"Soft": replace(GIVEN, resistance=1e9), "Hard": GIVEN},
    "fewer steps than Table A-1": {"Sheet": replace(BETA_5, step=1e-8)},
    "no step at all": {"Sheet": replace(BETA_5, stop_velocity=600.0)},
}


@pytest.fixture(params=DOUBLES)
def exact_engine(request: pytest.FixtureRequest, usable: Callable[[str], Engine]) -> Engine:
    return usable(request.param)


def differences(
    plan: WorkbookPlan, values: dict[str, Value], cases: Cases, path: Path, program: Engine
) -> list[Difference]:
    tolerances = dict.fromkeys(plan.transcendental, workbook.relative_tolerance(cases))
    return compare(emit.cell_values(plan, values), program.recalculate(path), tolerances)


@pytest.mark.parametrize("cases", CASES.values(), ids=CASES)
def test_recalculated_values_are_pythons_doubles(
    cases: Cases, exact_engine: Engine, tmp_path: Path
) -> None:
    path = tmp_path / "workbook.xlsx"
    plan, values = workbook.build(cases)
    emit.write(path, plan, values)
    assert differences(plan, values, cases, path, exact_engine) == []


def test_file_holds_the_plan_and_its_values(tmp_path: Path) -> None:
    path = tmp_path / "workbook.xlsx"
    workbook.write(path)
    plan, values = workbook.build()
    held = read(path)
    assert compare(emit.cell_values(plan, values), held.values) == []
    formulas = {place: cell.formula for place, cell in plan.cells() if cell.formula}
    assert {(s, a): f for s, cells in held.formulas.items() for a, f in cells.items()} == formulas


def edited(cases: Cases, rows_of: Cases, path: Path) -> tuple[WorkbookPlan, dict[str, Value]]:
    """A workbook emitted for `rows_of` whose inputs a user changed to `cases`: nothing else new.

    Returns its plan and the values that a recalculation must give.
    """
    plan, stale = workbook.build(rows_of)
    fresh = workbook.values(cases, rows_of)
    inputs = {cell.key for _, cell in plan.cells() if cell.key and not cell.formula}
    emit.write(path, plan, stale | {key: fresh[key] for key in inputs})
    return plan, fresh


@pytest.mark.parametrize(
    "change",
    [{"velocity": 420.0}, {"velocity": 120.0}, {"step": 1e-10}, {"radius": 2e-5}],
    ids=str,
)
def test_an_edited_workbook_follows_its_inputs(
    change: dict[str, float], exact_engine: Engine, tmp_path: Path
) -> None:
    """The run ends earlier (the velocities) or extends into the blank rows (the others)."""
    cases = {name: replace(case, **change) for name, case in REPORT.items()}
    path = tmp_path / "edited.xlsx"
    plan, values = edited(cases, REPORT, path)
    assert differences(plan, values, cases, path, exact_engine) == []


def test_a_workbook_that_runs_out_of_rows_says_so(exact_engine: Engine, tmp_path: Path) -> None:
    path = tmp_path / "short.xlsx"
    plan, values = workbook.build()
    emit.write(path, plan, values | {"inputs.dt_s": 5e-11})
    found = exact_engine.recalculate(path)

    def at(key: str) -> Value:
        sheet, address = plan.where[key]
        return found[sheet][address]

    assert at("low.message") == out_of_rows(400)
    for result in ("final_depth", "depth_um", "normalized_depth", "steps", "stop_time"):
        assert at(f"low.{result}") == NO_STOP
    assert at("contents.low.depth_um") == NO_STOP


DRAWN = st.builds(
    Impact,
    velocity=st.floats(50.0, 1500.0),
    radius=st.floats(1e-6, 5e-5),
    particle_density=st.floats(1e3, 2e4),
    target_density=st.floats(1e3, 2e4),
    beta=st.floats(1.0, 8.0),
    flow_stress=st.floats(1e8, 2e9),
    stop_velocity=st.floats(0.0, 20.0),
)


def with_step(impact: Impact, count: float) -> Impact:
    """The impact with a step that takes it to rest in about twice `count` steps."""
    depth = final_depth(
        impact.velocity,
        impact.radius,
        impact.particle_density,
        impact.target_density,
        impact.target_resistance,
    )
    return replace(impact, step=float(depth) / impact.velocity / count)


@settings(max_examples=15, deadline=None)
@given(impact=DRAWN, count=st.floats(1.0, 100.0))
def test_any_case_recalculates_to_pythons_doubles(
    impact: Impact, count: float, tmp_path_factory: pytest.TempPathFactory
) -> None:
    cases = {"Sheet": with_step(impact, count)}
    path = tmp_path_factory.mktemp("drawn") / "workbook.xlsx"
    plan, values = workbook.build(cases)
    emit.write(path, plan, values)
    assert differences(plan, values, cases, path, engine("ironcalc")) == []


def displayed(value: Value, number_format: str) -> str:
    """A number as a cell of that format shows it, for the two formats of Table A-1."""
    if number_format == "0.00E+00":
        return f"{value:.2E}"
    assert number_format == "General"
    return f"{value:g}".upper()


def test_table_a1_shows_what_the_report_prints() -> None:
    plan, values = workbook.build()
    (sheet,) = (sheet for sheet in plan.sheets if sheet.name == "Table A-1")
    for row, texts in enumerate(PRINTED, 1):
        for column, printed in zip("ABCDEF", texts, strict=True):
            cell = sheet.cells.get(f"{column}{row}")
            shown = ""
            if cell is not None:
                key, style = cell.key, cell.number_format
                shown = displayed(values[key], style) if key else cell.text
            assert shown == printed, f"{column}{row}"


def test_results_of_the_report() -> None:
    values = workbook.values()
    assert (values["low.steps"], values["high.steps"]) == (178.0, 131.0)
    assert f"{values['contents.low.depth_um']:.1f}" == "10.0"
    assert f"{values['contents.high.depth_um']:.2f}" == "7.67"


def test_a_resistance_that_is_given_is_an_input() -> None:
    plan, values = workbook.build({"Sheet": GIVEN})
    sheet, address = plan.where["inputs.R_t"]
    cells = next(page for page in plan.sheets if page.name == sheet).cells
    assert cells[address].style == "input"
    assert not cells[address].formula
    assert not {"inputs.beta", "inputs.Y_t"} & values.keys()


def test_printed_results_stand_beside_the_reports_own_cases_only() -> None:
    def texts(cases: Cases) -> set[str]:
        return {cell.text for (s, _), cell in workbook.build(cases)[0].cells() if s == "Contents"}

    assert {"10.0", "0.91", "7.67", "0.70"} <= texts(REPORT)
    assert not {"7.67", "0.70"} & texts({"Sheet": replace(BETA_5, velocity=501.0)})


def test_a_workbook_too_short_for_the_case_is_refused() -> None:
    cases = {name: replace(case, step=5e-11) for name, case in REPORT.items()}
    with pytest.raises(ValueError, match="needs 711 steps, and the workbook has 400 rows"):
        workbook.values(cases, REPORT)


def test_cases_that_cannot_share_a_workbook_are_refused() -> None:
    with pytest.raises(ValueError, match="not in velocity"):
        workbook.build({"A": BETA_3, "B": replace(BETA_5, velocity=400.0)})
    with pytest.raises(ValueError, match="not in flow_stress"):
        workbook.build({"A": BETA_3, "B": GIVEN})
    with pytest.raises(ValueError, match="one or two cases, not 0"):
        workbook.build({})
