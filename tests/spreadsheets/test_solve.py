"""The sheet Solve answers as `replication.models.inverse` and `reference.inverse` do, live."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from mpmath import mp
from workbooks import FASTEST, usable

from reference.arithmetic import Reals
from reference.inverse import INVERSES
from replication.cases import BETA_3, BETA_5
from replication.models import inverse
from replication.models.impact import Impact
from spreadsheets.engines import Engine
from spreadsheets.plan import NOT_AVAILABLE
from spreadsheets.sheets.messages import BY_DEPTH, BY_RATIO, NOT_SOLVED, TOO_DEEP

ULPS = 32 * 2.0**-52
"""Relative tolerance, as derived in `spreadsheets.verify`; the models are within a few ulp, too."""

DEPTHS = (3.3, 1e-4, 11.0, 30.0)
"""Measured depths [um]: the report's, a very shallow one, at the radius, beyond it."""

ANSWERS = {
    "resistance": "R_t_meas",
    "velocity": "V_impact_meas_{case}",
    "radius": "R_p_meas_{case}",
    "particle_density": "rho_p_meas_{case}",
}
"""The defined name of the cell that answers, by the input that it gives."""


def known(impact: Impact, depth: float, asked: str) -> dict[str, float]:
    """Return the inputs of the question: the depth [m] and all of the impact but the one asked."""
    return {"depth": depth} | {k: v for k, v in impact.motion.items() if k != asked}


def check_answers(page: Any, depth: float, asked: str) -> None:
    """Assert that the cells are what the model and the reference give, for both cases."""
    for case, impact in (("low", BETA_3), ("high", BETA_5)):
        of_model = getattr(inverse, f"{asked}_for_depth")(**known(impact, depth, asked))
        with mp.workdps(40):
            inputs = {k: mp.mpf(v) for k, v in known(impact, depth, asked).items()}
            of_reference = float(INVERSES[asked](Reals(), **inputs))
        cell = page[ANSWERS[asked].format(case=case)]
        assert cell == pytest.approx(of_model, rel=ULPS, abs=0)
        assert cell == pytest.approx(of_reference, rel=ULPS, abs=0)


def test_the_report_s_observed_depth_is_solved_for(published: Any) -> None:
    """17.8 GPa, or β = 25, for the 3.3 um of section 2, where the model takes 3.5 GPa and β = 5."""
    assert published.values["solve.depth"] == 3.3
    assert f"{published.values['R_t_meas_GPa']:.1f}" == "17.8"
    assert f"{published.values['beta_meas']:.1f}" == "25.5"


@pytest.mark.parametrize("asked", ANSWERS)
def test_a_measured_depth_is_solved_for_each_input(pages: Mapping[str, Any], asked: str) -> None:
    for depth in DEPTHS:
        check_answers(pages[f"{depth} um"], depth / 1e6, asked)


TYPED: Mapping[str, Mapping[str, float | str | None]] = {
    **{f"{depth} um": {"solve.depth": depth} for depth in DEPTHS},
    "X/R": {"solve.ratio": 0.5},
    "a text as X/R": {"solve.ratio": "a third"},
    "an error as X/R": {"solve.ratio": "#DIV/0!"},
    "no depth": {"solve.depth": None},
    "an error as depth": {"solve.depth": "#DIV/0!"},
    "a depth in m": {"solve.depth": 3.3e-6},
    "too large an X/R": {"solve.ratio": 1e5},
    "too deep": {"solve.ratio": 9000.0},
}
"""What is typed into the sheet, by what it is."""


@pytest.fixture(scope="module")
def pages(emitted: Any, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """The report's workbook after each of these is typed."""
    folder = tmp_path_factory.mktemp("solve")
    result = emitted.recalculated(usable(FASTEST), list(TYPED.values()), folder)
    return dict(zip(TYPED, result, strict=True))


def test_the_depth_comes_back(pages: Mapping[str, Any]) -> None:
    for depth in DEPTHS:
        page = pages[f"{depth} um"]
        assert page["X_back_um"] == pytest.approx(depth, rel=ULPS, abs=0)
        assert page["solve.message"] == BY_DEPTH


def test_a_typed_ratio_takes_the_place_of_the_depth(pages: Mapping[str, Any]) -> None:
    page = pages["X/R"]
    assert page["solve.message"] == BY_RATIO
    assert page["X_meas"] == 0.5 * BETA_5.radius
    check_answers(page, 0.5 * BETA_5.radius, "resistance")


MESSAGES = {
    "X/R": (BY_RATIO, "", ""),
    "a text as X/R": (BY_DEPTH, "", "no number"),
    "an error as X/R": (BY_DEPTH, "", "no number"),
    "no depth": (NOT_SOLVED, "no number", "no number"),
    "an error as depth": (NOT_SOLVED, "no number", "no number"),
    "a depth in m": (NOT_SOLVED, "too small", "no number"),
    "too large an X/R": (NOT_SOLVED, "", "too large"),
    "too deep": (TOO_DEEP, "", ""),
}
"""What the sheet says, and what it says is wrong with the depth and with X/R."""


def check_messages(pages: Mapping[str, Any]) -> None:
    """Assert that the sheet says this after each of these is typed."""
    keys = "solve.message", "solve.depth.fault", "solve.ratio.fault"
    said = {typed: tuple(pages[typed][key] for key in keys) for typed in MESSAGES}
    assert said == MESSAGES


def test_it_says_what_is_wrong_with_what_is_typed(pages: Mapping[str, Any]) -> None:
    check_messages(pages)


@pytest.mark.slow
def test_it_says_the_same_in_every_program(engine: Engine, emitted: Any, tmp_path: Path) -> None:
    result = emitted.recalculated(engine, list(TYPED.values()), tmp_path)
    pages = dict(zip(TYPED, result, strict=True))
    check_messages(pages)
    for typed, (message, *_) in MESSAGES.items():
        assert (pages[typed]["R_t_meas"] == NOT_AVAILABLE) == (message in (NOT_SOLVED, TOO_DEEP))


@pytest.mark.parametrize("typed", ["no depth", "a depth in m", "too large an X/R", "too deep"])
def test_what_cannot_be_solved_shows_no_number(pages: Mapping[str, Any], typed: str) -> None:
    page = pages[typed]
    for key in ("R_t_meas", "beta_meas", "V_impact_meas_high", "Y_t_meas_low", "X_back_um"):
        assert page[key] == NOT_AVAILABLE
    assert page.errors == {}


@pytest.mark.slow
def test_every_program_solves_for_a_ratio(engine: Engine, emitted: Any, tmp_path: Path) -> None:
    (page,) = emitted.recalculated(engine, [{"solve.ratio": 1.25}], tmp_path)
    check_answers(page, 1.25 * BETA_5.radius, "resistance")
    check_answers(page, 1.25 * BETA_5.radius, "velocity")
