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
from spreadsheets.plan import NOT_COMPUTED, Value
from spreadsheets.sheets.audit import AS_PRINTED, OTHERWISE
from spreadsheets.sheets.figures import CURRENT, STALE
from spreadsheets.sheets.inputs import INPUTS, MESSAGES
from spreadsheets.sheets.steps import (
    COMPLETE,
    DOUBTFUL,
    INVALID,
    KEPT_NAME,
    NO_STEPS,
    OUT_OF_ROWS,
    REVERSED,
)

TYPED: dict[str, dict[str, Any]] = {
    "nothing": {},
    "no velocity": {"V_impact": None},
    "zero": {"rho_t": 0.0},
    "a text": {"R_p": "eleven"},
    "negative": {"dt_s": -0.2},
    "seconds": {"dt_s": 2e-10},
    "meters": {"R_p": 1.1e-5},
    "pascals": {"Y_t": 7e8, "E_t": 2e11},
    "grams": {"rho_p": 8.9},
    "not a cap": {"CV_PV": 0.6},
    "no hardness": {"HB_ratio": None},
    "few rows": {"dt_s": 0.05, "dt_coarse": 0.05},
    "long step": {"dt_s": 40.0},
    "half a long step": {"dt_s": 12.0},
    "another stop": {"v_stop": 2.0},
    "too slow": {"V_impact": 0.5},
    "as slow as the stop": {"V_impact": 1.0},
    "no beta": {"beta_high": "four"},
    "another beta": {"beta_high": 4.0},
    "report": {"from": "report", "V_impact": 600.0, "rho_t": 0.0, "beta_high": 4.0},
}
"""Name -> what is typed, by the name of the input and in its unit."""

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
    found: Recalculated

    def __getitem__(self, key: str) -> Value:
        sheet, address = self.emitted.book.plan.where[key]
        return self.found[sheet].get(address, "")

    def verdicts(self, verdict: str) -> set[str]:
        return {name for name in self.computed if self[f"audit.{name}.verdict"] == verdict}

    @property
    def computed(self) -> list[str]:
        return [claim.id for claim in load().claims.values() if claim.workbook]

    @property
    def errors(self) -> Iterator[tuple[str, str, Value]]:
        for sheet, cells in self.found.items():
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
    for number, typed in enumerate(TYPED[name] for name in names):
        keys = {n: f"inputs.{n}" if n == "from" else f"inputs.{n}.typed" for n in typed}
        values = {keys[name]: value for name, value in typed.items()}
        paths.append(emitted.typed(values, folder / f"{number}.xlsx"))
    found = usable(request.param).recalculate_many(paths)
    return {name: Page(emitted, values) for name, values in zip(names, found, strict=True)}


def no_cell_ever_shows_an_error(pages: dict[str, Page]) -> None:
    assert {name: list(page.errors)[:3] for name, page in pages.items() if [*page.errors]} == {}


NOTHING = (
    "no velocity", "zero", "a text", "negative", "seconds", "meters", "pascals", "grams",
)  # fmt: skip
"""Where no run can be computed."""


def what_is_not_computed_is_called_so_and_not_wrong(pages: dict[str, Page]) -> None:
    for name in {*NOTHING, "not a cap", "no hardness"} & set(pages):
        page = pages[name]
        assert page.verdicts(OTHERWISE) <= FAILING, name
        assert page["audit.sphere-length-ratio.verdict"] == AS_PRINTED  # it hangs on no input
        assert page.verdicts(NOT_COMPUTED), name
        assert page["audit.none"] == page["overview.audit_none"] == len(page.verdicts(NOT_COMPUTED))


def only_what_hangs_on_an_input_goes_with_it(pages: dict[str, Page]) -> None:
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
        assert pages["not a cap"]["high.depth_um"] == pages["nothing"]["high.depth_um"]
        assert pages["not a cap"]["audit.observed-depth.verdict"] == NOT_COMPUTED


def inputs_that_cannot_be_used_are_named(pages: dict[str, Page]) -> None:
    said = {
        "no velocity": ("V_impact", "no number"), "zero": ("rho_t", "too small"),
        "a text": ("R_p", "no number"), "negative": ("dt_s", "too small"),
        "seconds": ("dt_s", "too small"), "meters": ("R_p", "too small"),
        "pascals": ("Y_t", "too large"), "grams": ("rho_p", "too small"),
        "not a cap": ("CV_PV", "too large"), "no hardness": ("HB_ratio", "no number"),
    }  # fmt: skip
    for name in said.keys() & pages.keys():
        page, (entry, words) = pages[name], said[name]
        assert page[f"inputs.{entry}.check"] == words
        assert page["inputs.message"] == MESSAGES["unusable"]
        assert page["inputs.unusable"] == page["overview.inputs_unusable"] == len(TYPED[name])


def a_run_that_is_not_computed_says_why_beside_result_chart_and_in_front(
    pages: dict[str, Page],
) -> None:
    said = {**dict.fromkeys(NOTHING, INVALID), "few rows": OUT_OF_ROWS}
    for name in said.keys() & pages.keys():
        page, message = pages[name], said[name]
        for key in ("high.message", "overview.high.message"):
            assert page[key] == message, (name, key)
        assert str(page["figure_3.high.message"]).endswith(message)
        assert page["high.trust"] == 0
        for result in ("final_depth", "depth_um", "normalized_depth", "steps", "stop_time"):
            assert page[f"high.{result}"] == NOT_COMPUTED
        assert page["overview.high.depth_um"] == NOT_COMPUTED


def warnings_are_those_of_the_command(pages: dict[str, Page]) -> None:
    """At 40 ns all three; at 12 ns the step is too coarse though the depth is not beyond."""
    said = {
        "nothing": ["reversed"],
        "long step": ["reversed", "coarse", "deep"],
        "half a long step": ["reversed", "coarse"],
    }
    for name in said.keys() & pages.keys():
        kinds, page, step = said[name], pages[name], float(TYPED[name].get("dt_s", 0.2)) / 1e9
        assert [doubt.kind for doubt in warnings(run(replace(BETA_5, step=step)))] == kinds
        message = REVERSED if kinds == ["reversed"] else DOUBTFUL
        for key in ("high.message", "overview.high.message"):
            assert page[key] == message
        assert page["figure_3.high.message"] == f"β = 5: {message}"
        assert page["high.trust"] == (1 if kinds == ["reversed"] else 0)
    assert (pages["nothing"]["low.message"], pages["nothing"]["low.trust"]) == (COMPLETE, 2)


def a_run_without_steps_is_not_called_complete(pages: dict[str, Page]) -> None:
    page = pages["too slow"]
    for key in ("low.message", "high.message", "high_coarse.message", "overview.high.message"):
        assert page[key] == NO_STEPS
    assert page["figure_3.high.message"] == f"β = 5: {NO_STEPS}"
    assert (page["high.steps"], page["high.final_depth"], page["high.trust"]) == (0, 0, 0)
    assert page["high_coarse.over_fine"] == NOT_COMPUTED
    if "as slow as the stop" in pages:
        page = pages["as slow as the stop"]
        assert (page["high.steps"], page["overview.high.message"]) == (1, COMPLETE)


def the_ladder_says_whose_it_is(pages: dict[str, Page]) -> None:
    """Whatever input was changed: the depth at rest alone would not tell a step or a stop."""
    for name, page in pages.items():
        same = name in ("nothing", "report", "not a cap", "no hardness")
        assert page["convergence.message"] == (CURRENT if same else STALE), name
    assert pages["long step"]["convergence.same.dt_s"] == 0
    assert pages["long step"]["convergence.same.R_p"] == 1


def names_follow_beta(pages: dict[str, Page]) -> None:
    page = pages["another beta"]
    assert page["high.label"] == "β = 4"
    assert page["high.renamed"] == KEPT_NAME
    assert page["low.label"] == "β = 3"
    assert page["low.renamed"] == ""
    assert str(page["figure_3.high.message"]).startswith("β = 4: ")
    assert str(page["overview.high.message"]).startswith("β = 4: ")
    if "no beta" in pages:
        assert pages["no beta"]["overview.high.message"] == INVALID
        assert pages["no beta"]["high.renamed"] == ""
    assert page["inputs.changed"] == page["overview.inputs_changed"] == 1
    assert page["inputs.beta_high.check"] == "yours"
    assert page["inputs.message"] == MESSAGES["changed"]


def the_switch_brings_the_reports_inputs_back(pages: dict[str, Page]) -> None:
    page, report = pages["report"], pages["nothing"]
    other = {f"inputs.{name}.typed" for name in TYPED["report"]} | {"inputs.from", "inputs.message"}
    for key in page.emitted.book.values:
        assert key in other or page[key] == report[key], key
    assert page["high.final_depth"] == report["high.final_depth"]
    assert page["inputs.message"] == MESSAGES["report"]
    assert page["inputs.changed"] == page["inputs.unusable"] == 0
    assert page["high.message"] == report["high.message"]


def test_what_the_workbook_says(pages: dict[str, Page]) -> None:
    """One test for each program, which recalculates all the files once."""
    no_cell_ever_shows_an_error(pages)
    what_is_not_computed_is_called_so_and_not_wrong(pages)
    only_what_hangs_on_an_input_goes_with_it(pages)
    inputs_that_cannot_be_used_are_named(pages)
    a_run_that_is_not_computed_says_why_beside_result_chart_and_in_front(pages)
    warnings_are_those_of_the_command(pages)
    a_run_without_steps_is_not_called_complete(pages)
    the_ladder_says_whose_it_is(pages)
    names_follow_beta(pages)
    the_switch_brings_the_reports_inputs_back(pages)


def test_blank_inputs_leave_no_error_and_no_false_verdict(emitted: Any, tmp_path: Path) -> None:
    """Every sixth input is left blank, so that each formula lacks one of its own here or there."""
    names, paths = [*INPUTS, "beta_low", "beta_high"], []
    for first in range(6):
        blank = {f"inputs.{name}.typed": None for name in names[first::6]}
        paths.append(emitted.typed(blank, tmp_path / f"{first}.xlsx"))
    for first, found in enumerate(usable("formualizer").recalculate_many(paths)):
        page = Page(emitted, found)
        assert [*page.errors] == []
        assert page.verdicts(OTHERWISE) <= FAILING
        assert page["inputs.unusable"] == len(names[first::6])
