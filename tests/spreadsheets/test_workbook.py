"""Real engines compute the same double as Python in every cell, whatever is typed as input."""

import math
import re
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from itertools import chain
from pathlib import Path
from random import Random
from typing import Any

import pytest
from workbooks import FASTEST, stored, usable

from reference.ledger import load
from reference.scheme import Scheme
from reference.units import to_si
from replication import workbook
from replication.audit.record import Record
from replication.cases import BETA_5
from replication.models.depth import final_depth
from replication.models.impact import Impact
from replication.models.sheet import run
from replication.workbook import Workbook, live_verdicts, result_of
from spreadsheets import emit
from spreadsheets.conversion import converted
from spreadsheets.engines import Engine, office
from spreadsheets.plan import ShownValue
from spreadsheets.sheets import report_cases
from spreadsheets.sheets.inputs import input_lines
from spreadsheets.verify import compare, tolerances

LEDGER = load()
GIVEN = replace(BETA_5, beta=None, flow_stress=None, resistance=2.5e9)
ODD = replace(BETA_5, step=3.3e-10, radius=7.3e-6, flow_stress=1.234e8, beta=4.567)
CASES: dict[str, tuple[Impact | None, str] | tuple[Impact, str, int]] = {
    "report": (None, "published"),
    "report, centered": (None, "centered"),
    "beyond the radius": (replace(BETA_5, velocity=800.0), "published"),
    "resistance given": (GIVEN, "published"),
    "fewer steps than Table A-1": (replace(BETA_5, step=1e-8), "published"),
    "fewer rows than Table A-1": (replace(BETA_5, step=1e-8), "published", 3),
    "no step at all": (replace(BETA_5, stop_velocity=600.0), "centered"),
    "too long a step": (replace(BETA_5, step=4e-8), "published"),
    "numbers that no unit makes round": (ODD, "centered"),
    "beta of sixteen digits": (replace(BETA_5, beta=4.567890123456789, step=1e-9), "published"),
    # Below about 0.0944 m/s the workbook computes ln(1 + x) by its series.
    **{
        f"slow, {v} m/s": (replace(BETA_5, velocity=v, stop_velocity=v / 2), "published")
        for v in (1e-4, 0.09, 0.0944, 0.1, 1.0, 30.0)
    },
}


IN_EVERY_PROGRAM = ["report", "report, centered", "resistance given", "slow, 0.09 m/s"]
"""Cases for every program; all are for the fastest."""


@pytest.fixture(scope="session")
def file_of(build: Callable[..., Workbook], emit_to: Any, emitted: Any) -> Callable[[str], Any]:
    """Return a function that writes the workbook of one of the cases, once."""
    return cache(lambda name: emitted if name == "report" else emit_to(build(*CASES[name])))


def check_recalculated(engine: Engine, file_of: Callable[[str], Any], names: Sequence[str]) -> None:
    """Assert that an engine gives the values of these workbooks, within the tolerances."""
    files = [file_of(name) for name in names]
    new = [file for file in files if engine.name not in file.unchanged]
    for file, values in zip(new, engine.recalculate_many([f.path for f in new]), strict=True):
        file.unchanged[engine.name] = values
    for name, file in zip(names, files, strict=True):
        bound = file.book.rounding if engine.long_doubles else 0.0
        allowed = tolerances(file.book.plan, file.book.cells, bound)
        assert compare(file.book.cells, file.unchanged[engine.name], allowed) == [], name


def test_recalculated_values_are_pythons_doubles(
    engine: Engine, file_of: Callable[[str], Any]
) -> None:
    """Gnumeric computes in long doubles: its values are within the rounding bound."""
    names = list(CASES) if engine.name == FASTEST else IN_EVERY_PROGRAM
    check_recalculated(engine, file_of, names)


@pytest.mark.slow
def test_all_recalculated_values_are_pythons_doubles(
    engine: Engine, file_of: Callable[[str], Any]
) -> None:
    check_recalculated(engine, file_of, list(CASES))


def test_file_holds_the_plan_and_its_values(emitted: Any) -> None:
    assert compare(emitted.book.cells, stored(emitted.path)) == []
    content = stored(emitted.path, formulas=True)
    formulas = {at: cell.formula for at, cell in emitted.book.plan.cells.items() if cell.formula}
    assert {(s, a): f for s, cells in content.items() for a, f in cells.items()} == formulas


# Random inputs, typed into the emitted file

MATERIALS = (
    "q_Y", "E_t", "HB_ratio", "S_clear", "Y_copper", "L_typ", "k_1", "k_t", "R_t_RHA", "R_t_lower",
    "CV_PV", "d_min", "d_max", "D_mean", "observed_ratio", "V_to",
)  # fmt: skip
"""Inputs that belong to no case; each is typed as 0.8 to 1.25 times the report's number."""


def random_cases(seed: int) -> tuple[Impact, Impact]:
    """Return two cases for the report's workbook, with a time step for which its rows suffice."""
    draw = Random(seed).uniform
    while True:
        low = Impact(
            velocity=draw(200.0, 1500.0),
            radius=draw(1e-6, 2e-5),
            particle_density=draw(1e3, 2e4),
            target_density=draw(1e3, 2e4),
            # A label contains beta, of which Gnumeric may show the digits of a long double. Eighths
            # look the same in all engines.
            beta=round(draw(8, 64)) / 8,
            flow_stress=draw(1e8, 2e9),
            stop_velocity=draw(0.0, 20.0),
        )
        # The mean velocity is about half the impact velocity, which doubles the number of steps.
        step = final_depth(**low.motion) / low.velocity / draw(0.5, 180.0)
        cases = replace(low, step=step), replace(low, step=step, beta=round(draw(8, 64)) / 8)
        longest = (run(replace(case, step=dt)).steps for case in cases for dt in (step, 5e-10))
        if max(longest) <= 400:
            return cases


def typed_inputs(
    build: Callable[..., Workbook], seed: int, monkeypatch: pytest.MonkeyPatch
) -> tuple[dict[str, ShownValue], float]:
    """Return the values of the report's workbook after random numbers are typed, and its bound.

    They are the values of a workbook written for a report with these cases and numbers, except for
    texts that say whether an input is the report's, and for runs that are not live.
    """
    draw, ledger = Random(seed + 1).uniform, LEDGER
    entries = chain.from_iterable(input_lines(report_cases(), report=True).values())
    for source in [entry.source for entry in entries if entry.name in MATERIALS]:
        number = float(LEDGER.value(source) / to_si(LEDGER.claims[source].unit))
        ledger = ledger.misprint(source, f"{number * draw(0.8, 1.25):.3f}")
    for name, case in zip(("BETA_3", "BETA_5"), random_cases(seed), strict=True):
        monkeypatch.setattr(workbook, name, case)
    book = build(rows=400, ledger=ledger)
    not_live = re.compile(
        r"convergence\.(?!in_use)|.*\.(check|whose|renamed)|(overview\.)?inputs_changed"
        r"|inputs\.message|(is|says)_(changed|unchanged|renamed\w*)|other_beta\w*"
    )
    live = {key: value for key, value in book.values.items() if not not_live.match(key)}
    return live, book.rounding


@pytest.mark.parametrize(
    "seeds",
    [[1]] + [pytest.param(range(k, k + 27), marks=pytest.mark.slow) for k in (2, 29)],
)
def test_typed_inputs_recalculate_to_pythons_doubles(
    engine: Engine,
    emitted: Any,
    build: Callable[..., Workbook],
    record: Record,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    seeds: Sequence[int],
) -> None:
    plan, audited = emitted.book.plan, result_of(record, Scheme.PUBLISHED, LEDGER)
    expected = [typed_inputs(build, seed, monkeypatch) for seed in seeds]
    typed = [{k: v for k, v in of.items() if k.endswith(".typed")} for of, _ in expected]
    paths = [emitted.typed(cells, tmp_path / f"{n}.xlsx") for n, cells in enumerate(typed)]
    for (right, bound), result in zip(expected, engine.recalculate_many(paths), strict=True):
        assert right.keys() <= plan.where.keys()
        assert len(right) > 0.9 * len(plan.where)
        values = {key: result[s].get(at, "") for key, (s, at) in plan.where.items()} | right
        values |= live_verdicts(LEDGER, plan, values, audited)
        cells = emit.cell_values(plan, values)
        allowed = tolerances(plan, cells, bound if engine.long_doubles else 0.0)
        assert compare(cells, result, allowed) == []


def test_bound_is_far_above_what_gnumeric_shows_and_catches_a_planted_error(
    emitted: Any, tmp_path: Path
) -> None:
    """The planted errors are three times the bound, relative to the largest number of a column."""
    (page,) = emitted.recalculated(usable("gnumeric"), [{}], tmp_path)
    book, result = emitted.book, page.result
    assert compare(book.cells, result, tolerances(book.plan, book.cells)) != []
    assert compare(book.cells, result, tolerances(book.plan, book.cells, book.rounding / 20)) == []
    allowed = tolerances(book.plan, book.cells, book.rounding)
    for key, largest in (
        ("high.row.velocity_final[130]", 500.0),
        ("high.row.depth[60]", 7.67e-6),
        ("final_velocity_high", 500.0),
        ("depth_um_high", 7.67),
        ("overview.low.depth_um", 10.03),
        ("PV_m3", 5.6e-15),
        ("M_p", 5e-11),
    ):
        sheet, at = book.plan.where[key]
        wrong = result[sheet][at] + 3 * book.rounding * largest
        (left,) = compare(book.cells, {**result, sheet: {**result[sheet], at: wrong}}, allowed)
        assert (left.sheet, left.cell) == (sheet, at)


def test_numbers_that_a_cell_cannot_hold_are_the_nearest() -> None:
    """No step in ns, divided by 1e9, may give exactly the double that was asked for."""

    def reachable(step: float) -> list[float]:
        typed = step * 1e9
        return [t / 1e9 for t in (math.nextafter(typed, 0), typed, math.nextafter(typed, 1e9))]

    step = next(s for s in (n * 1e-13 for n in range(1000, 9000)) if s not in reachable(s))
    values = workbook.build_workbook(replace(BETA_5, step=step)).values
    content = float(values["dt_s"])
    assert abs(content - step) <= math.ulp(step)
    assert values["dt_s.typed"] / 1e9 == content
    assert values["final_depth"] == run(replace(BETA_5, step=content)).final_depth


# A resistance that is given


def check_label(engine: Engine, given: Any, folder: Path) -> None:
    """Assert that a run says whose resistance it takes, before and after the switch."""
    typed = [{"inputs.choice": choice} for choice in ("yours", "report")]
    pages = given.recalculated(engine, typed, folder)
    for page, label in zip(pages, ("R_t as given", "R_t as in the report"), strict=True):
        assert page["label"] == label
        assert page["figure_3.case.message"] == f"{label}: {page['message']}"


def test_a_given_resistance_is_called_so_until_that_of_the_report_is_taken(
    file_of: Callable[[str], Any], tmp_path: Path
) -> None:
    check_label(usable(FASTEST), file_of("resistance given"), tmp_path)


@pytest.mark.slow
def test_a_given_resistance_is_called_so_in_every_program(
    engine: Engine, file_of: Callable[[str], Any], tmp_path: Path
) -> None:
    check_label(engine, file_of("resistance given"), tmp_path)


# Saved as .ods


def test_the_inputs_of_the_runs_keep_their_digits_in_20_decimals(own: Workbook) -> None:
    """LibreOffice writes no more into an .ods file; a word rests on twelve digits of each."""
    runs = {key: x for key, x in own.values.items() if key.startswith("convergence.run.")}
    assert len(runs) > 10
    for key, value in runs.items():
        assert isinstance(value, float), key
        assert abs(float(f"{value:.20f}") - value) <= 1e-13 * value, key


@pytest.mark.slow
@pytest.mark.parametrize(
    "case",
    [None, replace(BETA_5, radius=1.234567890123e-9, step=1.2345678901e-14)],
    ids=["report", "tiny"],
)
def test_its_words_stay_true_when_it_was_saved_as_ods(
    case: Impact | None, build: Callable[..., Workbook], tmp_path: Path
) -> None:
    engine, book = usable("libreoffice"), build(case)
    path = tmp_path / "book.xlsx"
    path.write_bytes(book.to_bytes())
    command = [
        str(office()), "--headless", "--norestore",
        f"-env:UserInstallation={(tmp_path / 'profile').as_uri()}",
        "--convert-to", "ods", "--outdir", str(tmp_path), str(path),
    ]  # fmt: skip
    for _ in range(2):  # the first run in a new profile may only ask to be started again
        if not (tmp_path / "book.ods").exists():
            subprocess.run(command, capture_output=True, check=False)
    again = converted(tmp_path / "book.ods", tmp_path, 1_000_000)
    before, after = engine.recalculate_many([path, again])
    for sheet, cells in before.items():
        for address, value in cells.items():
            if isinstance(value, str):
                assert after[sheet].get(address, "") == value, (sheet, address)
