"""What the workbook says once somebody works with it: in real engines, with typed inputs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest
from workbooks import usable

from reference.ledger import load
from replication.cases import BETA_5
from replication.error import warnings
from replication.models.sheet import run
from spreadsheets.engines import Recalculated
from spreadsheets.plan import MESSAGES, NOT_COMPUTED, Value
from spreadsheets.sheets import AS_PRINTED, OTHERWISE

COMPLETE, REVERSED, DOUBTFUL = (MESSAGES[kind] for kind in ("complete", "reversed", "doubtful"))
NO_STEPS, OUT_OF_ROWS, INVALID = (MESSAGES[kind] for kind in ("no_steps", "out_of_rows", "invalid"))
KEPT_NAME, CURRENT, STALE = (MESSAGES[kind] for kind in ("kept_name", "current", "stale"))
RESULTS = ("final_depth", "depth_um", "normalized_depth", "steps", "stop_time")
NO_RESULT = dict.fromkeys((*(f"high.{name}" for name in RESULTS), "overview.high.depth_um"),
                          NOT_COMPUTED)  # fmt: skip


def run_says(message: str, trust: int) -> dict[str, Any]:
    """Beside the result, in front and at the chart."""
    told = dict.fromkeys(("high.message", "overview.high.message"), message)
    return {**told, "figure_3.high.message": f"β = 5: {message}", "high.trust": trust}


def unusable(entry: str, words: str, count: int = 1) -> dict[str, Any]:
    told = dict.fromkeys(("inputs.unusable", "overview.inputs_unusable"), count)
    return {**told, f"inputs.{entry}.check": words, "inputs.message": MESSAGES["unusable"]}


NO_RUN = run_says(INVALID, 0) | NO_RESULT
TYPED: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "nothing": ({}, run_says(REVERSED, 1) | {"low.message": COMPLETE, "low.trust": 2}),
    "no velocity": ({"V_impact": None}, NO_RUN | unusable("V_impact", "no number")),
    "zero": ({"rho_t": 0.0}, NO_RUN | unusable("rho_t", "too small")),
    "a text": ({"R_p": "eleven"}, NO_RUN | unusable("R_p", "no number")),
    "negative": ({"dt_s": -0.2}, NO_RUN | unusable("dt_s", "too small")),
    "seconds": ({"dt_s": 2e-10}, NO_RUN | unusable("dt_s", "too small")),
    "meters": ({"R_p": 1.1e-5}, NO_RUN | unusable("R_p", "too small")),
    "pascals": ({"Y_t": 7e8, "E_t": 2e11}, NO_RUN | unusable("Y_t", "too large", 2)),
    "grams": ({"rho_p": 8.9}, NO_RUN | unusable("rho_p", "too small")),
    "not a cap": ({"CV_PV": 0.6}, unusable("CV_PV", "too large")),
    "no hardness": ({"HB_ratio": None}, unusable("HB_ratio", "no number")),
    "few rows": ({"dt_s": 0.05, "dt_coarse": 0.05}, run_says(OUT_OF_ROWS, 0) | NO_RESULT),
    "long step": (
        {"dt_s": 40.0},
        run_says(DOUBTFUL, 0) | {"convergence.same.dt_s": 0, "convergence.same.R_p": 1},
    ),
    "half a long step": ({"dt_s": 12.0}, run_says(DOUBTFUL, 0)),
    "another stop": ({"v_stop": 2.0}, {}),
    "too slow": (
        {"V_impact": 0.5},
        run_says(NO_STEPS, 0)
        | dict.fromkeys(("low.message", "high_coarse.message"), NO_STEPS)
        | {"high.steps": 0, "high.final_depth": 0, "high_coarse.over_fine": NOT_COMPUTED},
    ),
    "as slow as the stop": (
        {"V_impact": 1.0},
        {"high.steps": 1, "overview.high.message": COMPLETE},
    ),
    "no beta": ({"beta_high": "four"}, {"overview.high.message": INVALID, "high.renamed": ""}),
    "another beta": (
        {"beta_high": 4.0},
        {"high.label": "β = 4", "high.renamed": KEPT_NAME, "low.label": "β = 3", "low.renamed": "",
         "inputs.changed": 1, "overview.inputs_changed": 1, "inputs.beta_high.check": "yours",
         "inputs.message": MESSAGES["changed"]},
    ),
    "report": (
        {"from": "report", "V_impact": 600.0, "rho_t": 0.0, "beta_high": 4.0},
        {"inputs.message": MESSAGES["reports_own"], "inputs.changed": 0, "inputs.unusable": 0},
    ),
}  # fmt: skip
"""Name -> what is typed, by the name of the input and in its unit, and what then stands where."""

FOR_ALL = (
    "nothing", "no velocity", "a text", "no hardness", "few rows", "long step", "too slow",
    "another beta", "report",
)  # fmt: skip
"""What every program is given; the fastest is given all."""

FAILING = {"frank-zook-rha", "frank-zook-stainless"}
"""What is not as printed with the report's own inputs."""


@dataclass(frozen=True)
class Page:
    """A recalculated workbook, read by key."""

    emitted: Any
    result: Recalculated

    def __getitem__(self, key: str) -> Value:
        sheet, address = self.emitted.book.plan.where[key]
        return self.result[sheet].get(address, "")

    def verdicts(self, verdict: str) -> set[str]:
        return {name for name in self.computed if self[f"audit.{name}.verdict"] == verdict}

    @property
    def computed(self) -> list[str]:
        return [claim.id for claim in load().claims.values() if claim.workbook]

    @property
    def errors(self) -> Iterator[tuple[str, str, Value]]:
        for sheet, cells in self.result.items():
            for address, value in cells.items():
                if isinstance(value, str) and value.startswith(("#", "Err:")):
                    yield sheet, address, value


@pytest.fixture(scope="module", params=["ironcalc", "formualizer", "libreoffice"])
def pages(
    request: pytest.FixtureRequest,
    emitted: Any,
    tmp_path_factory: pytest.TempPathFactory,
) -> dict[str, Page]:
    """The workbook with each of these typed, recalculated."""
    folder = tmp_path_factory.mktemp("typed")
    names = list(TYPED) if request.param == "formualizer" else FOR_ALL
    paths = []
    for number, typed in enumerate(TYPED[name][0] for name in names):
        keys = {n: f"inputs.{n}" if n == "from" else f"inputs.{n}.typed" for n in typed}
        values = {keys[name]: value for name, value in typed.items()}
        paths.append(emitted.typed(values, folder / f"{number}.xlsx"))
    result = usable(request.param).recalculate_many(paths)
    return {name: Page(emitted, values) for name, values in zip(names, result, strict=True)}


def test_what_the_workbook_says(pages: dict[str, Page]) -> None:
    """One test for each program, which recalculates all the files once."""
    report = pages["nothing"]
    for name, page in pages.items():
        said = TYPED[name][1]
        assert [*page.errors][:3] == [], name
        assert {key: page[key] for key in said} == said, name
        # Whatever input was changed: the depth at rest alone would not tell a step or a stop.
        same = name in ("nothing", "report", "not a cap", "no hardness")
        assert page["convergence.message"] == (CURRENT if same else STALE), name
        if said.get("inputs.unusable"):  # what is not computed is called so, and not wrong
            missing = page.verdicts(NOT_COMPUTED)
            assert page.verdicts(OTHERWISE) <= FAILING, name
            assert page["audit.sphere-length-ratio.verdict"] == AS_PRINTED  # it hangs on no input
            assert missing
            assert page["audit.none"] == page["overview.audit_none"] == len(missing)
    # Only what hangs on an input goes with it.
    assert pages["no hardness"].verdicts(NOT_COMPUTED) == {
        "brinell-beta", "beta-range-least", "beta-range-greatest",
    }  # fmt: skip
    few = pages["few rows"]
    assert few["audit.a1-mass.verdict"] == few["audit.particle-volume.verdict"] == AS_PRINTED
    assert few.verdicts(NOT_COMPUTED) == {
        "depth-beta-3", "depth-beta-5", "ratio-beta-3", "ratio-beta-5", "excess",
        "discussion-ratio-beta-3", "discussion-ratio-beta-5",
    }  # fmt: skip
    if "pascals" in pages:
        assert pages["pascals"]["audit.goodier-beta.verdict"] == AS_PRINTED
        assert pages["pascals"]["audit.walker-anderson-alpha.verdict"] == NOT_COMPUTED
        assert pages["not a cap"]["high.depth_um"] == report["high.depth_um"]
        assert pages["not a cap"]["audit.observed-depth.verdict"] == NOT_COMPUTED
    for key in ("figure_3.high.message", "overview.high.message"):
        assert str(pages["another beta"][key]).startswith("β = 4: ")
    # The switch brings the report's inputs back.
    another = {*(f"inputs.{name}.typed" for name in TYPED["report"][0]), "inputs.from"}
    for key in report.emitted.book.values:
        assert key in another | {"inputs.message"} or pages["report"][key] == report[key], key


def test_doubts_are_those_of_the_command() -> None:
    """Where the workbook, above, doubts its run: as it reverses, or for more."""
    for step, kinds in (
        (0.2e-9, ["reversed"]),
        (12e-9, ["reversed", "coarse"]),  # though the depth is not beyond
        (40e-9, ["reversed", "coarse", "deep"]),
    ):
        assert list(warnings(run(replace(BETA_5, step=step)))) == kinds


def test_blank_inputs_leave_no_error_and_no_false_verdict(emitted: Any, tmp_path: Path) -> None:
    """Every sixth input is left blank, so that each formula lacks one of its own here or there."""
    names, paths = [key for key in emitted.book.values if key.endswith(".typed")], []
    for first in range(6):
        blank = dict.fromkeys(names[first::6])
        paths.append(emitted.typed(blank, tmp_path / f"{first}.xlsx"))
    for first, result in enumerate(usable("formualizer").recalculate_many(paths)):
        page = Page(emitted, result)
        assert [*page.errors] == []
        assert page.verdicts(OTHERWISE) <= FAILING
        assert page["inputs.unusable"] == len(names[first::6])
