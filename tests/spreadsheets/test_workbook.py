"""The workbook against Python: every cell the same double, in real engines, whatever is typed."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from workbooks import stored, usable

from reference.arithmetic import Reals
from reference.ledger import load
from reference.motion import sheet_rows
from reference.units import to_si
from replication import workbook
from replication.audit.record import Record
from replication.cases import BETA_5
from replication.error.ladder import exact_motion
from replication.models.depth import final_depth
from replication.models.impact import Impact
from replication.models.sheet import run
from replication.workbook import Workbook, findings_of, live_verdicts
from spreadsheets import emit
from spreadsheets.engines import OF_FUNCTIONS, Engine, compare, tolerances
from spreadsheets.plan import Value
from spreadsheets.sheets.inputs import INPUTS

LEDGER = load()
GIVEN = replace(BETA_5, beta=None, flow_stress=None, resistance=2.5e9)
ODD = replace(BETA_5, step=3.3e-10, radius=7.3e-6, flow_stress=1.234e8, beta=4.567)
CASES: dict[str, tuple[Impact | None, str]] = {
    "report": (None, "published"),
    "report, centered": (None, "centered"),
    "beyond the radius": (replace(BETA_5, velocity=800.0), "published"),
    "resistance given": (GIVEN, "published"),
    "fewer steps than Table A-1": (replace(BETA_5, step=1e-8), "published"),
    "no step at all": (replace(BETA_5, stop_velocity=600.0), "centered"),
    "too long a step": (replace(BETA_5, step=4e-8), "published"),
    "numbers that no unit makes round": (ODD, "centered"),
    "beta of sixteen digits": (replace(BETA_5, beta=4.567890123456789, step=1e-9), "published"),
}


@pytest.fixture(scope="module")
def files(build: Callable[..., Workbook], emit_to: Any) -> dict[str, Any]:
    return {name: emit_to(build(*case)) for name, case in CASES.items()}


def test_recalculated_values_are_pythons_doubles(engine: Engine, files: dict[str, Any]) -> None:
    """In Gnumeric's long doubles they are within the bound."""
    result = engine.recalculate_many([file.path for file in files.values()])
    for (name, file), values in zip(files.items(), result, strict=True):
        bound = file.book.rounding if engine.long_doubles else 0.0
        allowed = tolerances(file.book.plan, file.book.cells, bound)
        assert compare(file.book.cells, values, allowed) == [], name


def test_file_holds_the_plan_and_its_values(emitted: Any) -> None:
    assert compare(emitted.book.cells, stored(emitted.path)) == []
    content = stored(emitted.path, formulas=True)
    formulas = {place: cell.formula for place, cell in emitted.book.plan.cells() if cell.formula}
    assert {(s, a): f for s, cells in content.items() for a, f in cells.items()} == formulas


# Random inputs, typed into the emitted file

MATERIALS = (
    "q_Y", "E_t", "HB_ratio", "S_clear", "Y_copper", "L_typ", "k_1", "k_t", "R_t_RHA", "R_t_lower",
    "CV_PV", "d_min", "d_max", "D_mean", "observed_ratio", "V_to",
)  # fmt: skip
"""Inputs that belong to no case: each is typed as 0.8 to 1.25 times the report's."""


def random_cases(seed: int) -> tuple[Impact, Impact]:
    """Two cases for the report's workbook, with a step that needs one to all of its rows."""
    draw = Random(seed).uniform
    while True:
        low = Impact(
            velocity=draw(200.0, 1500.0),
            radius=draw(1e-6, 2e-5),
            particle_density=draw(1e3, 2e4),
            target_density=draw(1e3, 2e4),
            # A label joins beta to a text, where Gnumeric may show digits of a long double: eighths
            # are the same in all.
            beta=round(draw(8, 64)) / 8,
            flow_stress=draw(1e8, 2e9),
            stop_velocity=draw(0.0, 20.0),
        )
        # The mean velocity is about half that of the impact: about twice so many steps until rest.
        step = final_depth(*low.motion.values()) / low.velocity / draw(0.5, 180.0)
        cases = replace(low, step=step), replace(low, step=step, beta=round(draw(8, 64)) / 8)
        longest = (run(replace(case, step=dt)).steps for case in cases for dt in (step, 5e-10))
        if max(longest) <= 400:
            return cases


def typed_inputs(build: Callable[..., Workbook], seed: int) -> tuple[dict[str, Value], float]:
    """What the report's workbook must hold, by key, once random numbers were typed into it.

    It is what the workbooks hold that are written for such a case and a report with such numbers,
    but for what they tell apart from those typed, such as whose an input is. And their bound.
    """
    draw, ledger = Random(seed + 1).uniform, LEDGER
    for source in (INPUTS[name].source for name in MATERIALS):
        number = float(LEDGER.value(source) / to_si(LEDGER.claims[source].unit))
        ledger = ledger.misprint(source, f"{number * draw(0.8, 1.25):.3f}")
    values: dict[str, Value] = {}
    bounds = []
    for slug, case in zip(("low", "high"), random_cases(seed), strict=True):
        fine, coarse = (
            build(replace(case, step=step), rows=400, ledger=ledger) for step in (case.step, 5e-10)
        )
        for key, value in coarse.values.items():
            values |= {f"{slug}_coarse{key[4:]}": value} if key.startswith("case.") else {}
        for key, value in fine.values.items():
            key = re.sub(r"(?<![^.])case(?=\.)", slug, key)
            values[re.sub(r"^(.*\.)?(beta|R_t)(?=$|\.)", rf"\1\2_{slug}", key)] = value
        bounds += [fine.rounding, coarse.rounding]
    told = re.compile(
        r"convergence\.(?!in_use)|.*\.(check|renamed)|inputs\.(changed|message)"
        r"|overview\.(inputs_changed|\w+\.message)"
    )
    return {key: value for key, value in values.items() if not told.match(key)}, max(bounds)


SEEDS = st.integers(0, 2**32)
"""Hypothesis draws a seed only: left to draw the inputs, it prefers round numbers and few steps."""

FIXED = settings(derandomize=True, deadline=None, database=None, phases=[Phase.generate])
"""The same cases on every run; to make a failing one smaller would take minutes."""


def check_typed(
    seeds: list[int],
    engine: Engine,
    emitted: Any,
    build: Callable[..., Workbook],
    record: Record,
    folder: Path,
) -> None:
    plan, findings = emitted.book.plan, findings_of(record, "published", LEDGER)
    expected = [typed_inputs(build, seed) for seed in seeds]
    typed = [{k: v for k, v in of.items() if k.endswith(".typed")} for of, _ in expected]
    paths = [emitted.typed(cells, folder / f"{n}.xlsx") for n, cells in enumerate(typed)]
    for (right, bound), result in zip(expected, engine.recalculate_many(paths), strict=True):
        assert right.keys() <= plan.where.keys()
        assert len(right) > 0.9 * len(plan.where)
        values = {key: result[s].get(at, "") for key, (s, at) in plan.where.items()} | right
        values |= live_verdicts(LEDGER, plan, values, findings)
        cells = emit.cell_values(plan, values)
        allowed = tolerances(plan, cells, bound if engine.long_doubles else 0.0)
        assert compare(cells, result, allowed) == []


def test_typed_inputs_recalculate_to_pythons_doubles(
    engine: Engine, emitted: Any, build: Callable[..., Workbook], record: Record, tmp_path: Path
) -> None:
    check_typed([1, 2], engine, emitted, build, record, tmp_path)


@pytest.mark.slow
@settings(FIXED, max_examples=2)
@given(seeds=st.lists(SEEDS, min_size=26, max_size=26, unique=True))
def test_many_typed_inputs_recalculate_to_pythons_doubles(
    engine: Engine,
    emitted: Any,
    build: Callable[..., Workbook],
    record: Record,
    tmp_path_factory: pytest.TempPathFactory,
    seeds: list[int],
) -> None:
    check_typed(seeds, engine, emitted, build, record, tmp_path_factory.mktemp("typed"))


# Slow impacts


SLOW = [
    replace(BETA_5, velocity=v, stop_velocity=v / 2) for v in (1e-4, 0.09, 0.0944, 0.1, 1.0, 30.0)
]


@pytest.fixture(scope="module")
def slow_files(emit_to: Any) -> list[Any]:
    return [emit_to(workbook.build(impact)) for impact in SLOW]


def test_slow_impacts_keep_their_digits(engine: Engine, slow_files: list[Any]) -> None:
    """Down to 1e-4 m/s; and where the series takes over from the logarithm, near 1e-8."""
    result = engine.recalculate_many([file.path for file in slow_files])
    for impact, file, values in zip(SLOW, slow_files, result, strict=True):
        motion = exact_motion(impact)
        y = motion.final_depth / motion.context.mpf(impact.radius)
        for key, exact in (("c", y**2 - y**3 / 3), ("exact_normalized_depth", y)):
            sheet, address = file.book.plan.where[f"case.{key}"]
            assert abs(values[sheet][address] / exact - 1) < OF_FUNCTIONS, (impact.velocity, key)


# The bound for long doubles


def test_bound_is_far_above_what_gnumeric_shows_and_catches_a_planted_error(
    emitted: Any,
) -> None:
    gnumeric, book = usable("gnumeric"), emitted.book
    result = gnumeric.recalculate(emitted.path)
    assert compare(book.cells, result, tolerances(book.plan, book.cells)) != []
    allowed = tolerances(book.plan, book.cells, book.rounding)
    assert compare(book.cells, result, allowed) == []
    assert compare(book.cells, result, tolerances(book.plan, book.cells, book.rounding / 20)) == []
    for key, size in planted(book):
        sheet, address = book.plan.where[key]
        wrong = {**result, sheet: {**result[sheet], address: result[sheet][address] + size}}
        (left,) = compare(book.cells, wrong, allowed)
        assert (left.sheet, left.cell) == (sheet, address)


def planted(book: Workbook) -> Iterator[tuple[str, float]]:
    """Errors of three times the bound: of the largest of a column, or of the number alone."""
    for key, largest in (
        ("high.row[130].velocity_final", 500.0),
        ("high.row[60].depth", 7.67e-6),
        ("high.final_velocity", 500.0),
        ("high.depth_um", 7.67),
        ("overview.low.depth_um", 10.03),
        ("crater.volume", 5.6e-15),
        ("inputs.M_p", 5e-11),
    ):
        yield key, 3 * book.rounding * largest


@settings(max_examples=20, deadline=None)
@given(seed=SEEDS)
def test_rounding_stays_below_its_bound(seed: int) -> None:
    """The sheet in doubles against the same in 40 digits."""
    for case in random_cases(seed):
        sheet = run(case)
        rows = exact_rows(case, sheet.steps)
        for column in ("velocity_initial", "depth", "deceleration"):
            doubles = [getattr(row, column) for row in sheet.rows[1:]]
            largest = max(abs(number) for number in doubles)
            exact = [getattr(row, column) for row in rows]
            off = max(abs(a - b) for a, b in zip(doubles, exact, strict=True))
            assert off <= workbook.rounding_bound(sheet) * largest


def exact_rows(case: Impact, steps: int) -> list[Any]:
    assert case.beta is not None
    assert case.flow_stress is not None
    inputs = {name: Fraction(value) for name, value in case.motion.items()}
    inputs |= {"resistance": Fraction(case.beta) * Fraction(case.flow_stress)}
    reals = Reals(40)
    numbers = {name: reals.number(value) for name, value in inputs.items()}
    rows = sheet_rows(reals, **numbers, step=reals.number(Fraction(case.step)))
    return list(islice(rows, steps))


# What the models and the audit say of the same


def test_numbers_that_a_cell_cannot_hold_are_the_nearest() -> None:
    """A step in ns, divided by 1e9, is not always the double that was asked for."""
    step = next(s for s in (n * 1e-13 for n in range(1000, 9000)) if s not in reachable(s))
    values = workbook.build(replace(BETA_5, step=step)).values
    content = float(values["inputs.dt_s"])
    assert abs(content - step) <= math.ulp(step)
    assert values["inputs.dt_s.typed"] / 1e9 == content
    assert values["case.final_depth"] == run(replace(BETA_5, step=content)).final_depth


def reachable(step: float) -> list[float]:
    typed = step * 1e9
    return [t / 1e9 for t in (math.nextafter(typed, 0), typed, math.nextafter(typed, math.inf))]
