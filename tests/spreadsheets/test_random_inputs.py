"""Random inputs typed into the emitted file, recalculated, and compared with Python's own run.

The file is the report's, with every stored value still that of the report's inputs: only the input
cells change, as when a person types into them.
"""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from replication import workbook
from replication.models.depth import final_depth
from replication.models.impact import Impact
from replication.models.sheet import run
from replication.workbook import REPORT, Cases
from spreadsheets import emit
from spreadsheets.compare import Difference, compare
from spreadsheets.engines import Engine, Recalculated
from spreadsheets.engines.package import worksheets
from spreadsheets.plan import Value, WorkbookPlan
from spreadsheets.replica import has_long_doubles
from spreadsheets.sheets.case import prepared_rows
from spreadsheets.sheets.inputs import INPUTS as SHEET_INPUTS
from spreadsheets.verify import verify

INPUTS = {
    "V_impact": "velocity",
    "R_p": "radius",
    "rho_p": "particle_density",
    "rho_t": "target_density",
    "dt_s": "step",
    "v_stop": "stop_velocity",
    "Y_t": "flow_stress",
}
"""Inputs that both cases share, by the names of their cells."""


@dataclass(frozen=True, repr=False)
class Emitted:
    """The report's workbook, as it was written."""

    path: Path
    plan: WorkbookPlan

    def typed(self, cases: Cases, path: Path) -> Path:
        """A copy with the inputs of other cases in its input cells and nothing else new."""
        low, high = cases.values()
        inputs = {name: getattr(low, attribute) for name, attribute in INPUTS.items()}
        inputs |= {"beta_low": low.beta, "beta_high": high.beta}
        with zipfile.ZipFile(self.path) as old, zipfile.ZipFile(path, "w") as new:
            part = worksheets(old)["Inputs"]
            for other in old.namelist():
                text = old.read(other)
                new.writestr(other, self._with(inputs, text) if other == part else text)
        return path

    def _with(self, inputs: dict[str, float], part: bytes) -> bytes:
        text = part.decode()
        for name, value in inputs.items():
            sheet, address = self.plan.where[f"inputs.{name}"]
            assert sheet == "Inputs"
            constant = rf'(<c r="{address}"[^>]*><v>)[^<]*'
            text, found = re.subn(constant, rf"\g<1>{value!r}", text)
            assert found == 1
        return text.encode()

    def values(self, cases: Cases) -> dict[str, dict[str, Value]]:
        """What every cell must show for these cases."""
        _, values = workbook.build(cases, REPORT)
        return emit.cell_values(self.plan, values)

    def differences(self, cases: Cases, found: Recalculated) -> list[Difference]:
        tolerances = dict.fromkeys(self.plan.transcendental, workbook.relative_tolerance(cases))
        differences = compare(self.values(cases), found, tolerances)
        # The ladder of steps is that of the written case; the sheet says that it is not live.
        return [difference for difference in differences if difference.sheet != "Convergence"]


@pytest.fixture(scope="module")
def emitted(tmp_path_factory: pytest.TempPathFactory) -> Emitted:
    path = tmp_path_factory.mktemp("emitted") / "report.xlsx"
    plan, values = workbook.build()
    emit.write(path, plan, values)
    return Emitted(path, plan)


def random_cases(seed: int) -> Cases:
    """Two cases for the report's workbook, with a step that needs one to all of its rows."""
    draw = Random(seed).uniform
    while True:
        low = Impact(
            velocity=draw(200.0, 1500.0),
            radius=draw(1e-6, 2e-5),
            particle_density=draw(1e3, 2e4),
            target_density=draw(1e3, 2e4),
            beta=draw(1.0, 8.0),
            flow_stress=draw(1e8, 2e9),
            stop_velocity=draw(0.0, 20.0),
        )
        depth = final_depth(**low.motion)
        # The mean velocity is about half that of the impact: about twice so many steps until rest.
        low = replace(low, step=float(depth) / low.velocity / draw(0.5, 180.0))
        cases = dict(zip(REPORT, (low, replace(low, beta=draw(1.0, 8.0))), strict=True))
        if fits(cases, None) and fits(cases, SHEET_INPUTS["dt_coarse"].si):
            return cases


def fits(cases: Cases, step: float | None) -> bool:
    """Whether the rows prepared for the report's own cases, at that step, are enough."""

    def runs(those: Cases) -> list[Impact]:
        return [c if step is None else replace(c, step=step) for c in those.values()]

    steps = [max(run(impact).steps for impact in runs(those)) for those in (cases, REPORT)]
    return steps[0] <= prepared_rows(steps[1])


SEEDS = st.integers(0, 2**32)
"""Hypothesis draws a seed only: left to draw the inputs, it prefers round numbers and few steps."""

FIXED = settings(derandomize=True, deadline=None, database=None, phases=[Phase.generate])
"""The same cases on every run; to make a failing one smaller would take minutes."""


@pytest.mark.parametrize("name", ["ironcalc", "formualizer"])
@settings(FIXED, max_examples=50)
@given(cases=SEEDS.map(random_cases))
def test_typed_inputs_recalculate_to_pythons_doubles(
    name: str,
    cases: Cases,
    emitted: Emitted,
    usable: Callable[[str], Engine],
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    path = emitted.typed(cases, tmp_path_factory.mktemp("typed") / "typed.xlsx")
    found = usable(name).recalculate(path)
    assert emitted.differences(cases, found) == []
    for slug, case in zip(("low", "high"), cases.values(), strict=True):
        alone = run(case)
        for key, value in (("final_depth", alone.final_depth), ("steps", alone.steps)):
            sheet, address = emitted.plan.where[f"{slug}.{key}"]
            assert found[sheet][address] == value


@pytest.mark.slow
@settings(FIXED, max_examples=2)
@given(seeds=st.lists(SEEDS, min_size=26, max_size=26, unique=True))
def test_libreoffice_recalculates_typed_inputs_to_pythons_doubles(
    seeds: Sequence[int],
    emitted: Emitted,
    usable: Callable[[str], Engine],
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    """Twenty-six files to a start of the office; a seed may stand in both lists."""
    drawn = [random_cases(seed) for seed in seeds]
    libreoffice, folder = usable("libreoffice"), tmp_path_factory.mktemp("typed")
    paths = [emitted.typed(cases, folder / f"{number}.xlsx") for number, cases in enumerate(drawn)]
    for cases, found in zip(drawn, libreoffice.recalculate_many(paths), strict=True):
        assert emitted.differences(cases, found) == []


@pytest.mark.slow
@pytest.mark.skipif(not has_long_doubles(), reason="NumPy has no 80-bit long doubles here")
@settings(FIXED, max_examples=8)
@given(cases=SEEDS.map(random_cases))
def test_gnumeric_recalculates_typed_inputs_to_its_long_doubles(
    cases: Cases,
    emitted: Emitted,
    usable: Callable[[str], Engine],
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    path = emitted.typed(cases, tmp_path_factory.mktemp("typed") / "typed.xlsx")
    tolerances = dict.fromkeys(emitted.plan.transcendental, workbook.relative_tolerance(cases))
    (check,) = verify(path, emitted.values(cases), tolerances, [usable("gnumeric")])
    assert check.sheets
    unexplained = {each.sheet: each.unexplained[:3] for each in check.sheets if each.unexplained}
    assert set(unexplained) <= {"Convergence"}, unexplained  # its ladder is not live
