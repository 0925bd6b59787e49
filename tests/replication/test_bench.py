"""Work-precision: what is measured, how it is compared, what is printed. Never how fast it is."""

import csv
import json
import math
import time
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from replication.bench.arrays import ARRAYS, SHEET_ARRAYS
from replication.bench.cases import CASES, Case, build
from replication.bench.measure import Stopwatch, Timing, time_limit
from replication.bench.methods import SHEETS, STEPS
from replication.bench.pareto import HALF_ULP, Point, choices, error_for, fastest, front
from replication.bench.peers import MPMATH, SCIPY, TOLERANCES, mpmath_tasks, scipy_tasks
from replication.bench.run import Bench, Result, Trial, bench, tasks
from replication.bench.task import Task
from replication.reports.bench_figure import image
from replication.reports.bench_text import bench_text

Command = Callable[..., tuple[int, str, str]]


def point(error: float, seconds: float, method: str = "a") -> Point:
    return Point(method, "setting", "depth", 1, error, Timing(seconds, seconds, 1, 1))


GAP = Point("a", "setting", "depth", 1, gap="not done in 1 s")

SVG = "{http://www.w3.org/2000/svg}"

POINTS = st.lists(
    st.builds(point, st.floats(0, 1), st.floats(1e-9, 1e3), st.sampled_from("ab")) | st.just(GAP)
)


@given(POINTS)
def test_nothing_measured_beats_the_front(points: list[Point]) -> None:
    found = front(points)
    assert GAP not in found
    for one in points:
        if not one.gap:
            assert any(f.seconds <= one.seconds and f.met <= one.met for f in found)
    for one in found:
        assert not any(
            p.seconds <= one.seconds
            and p.met <= one.met
            and (p.seconds, p.met) != (one.seconds, one.met)
            for p in points
        )


@given(POINTS)
def test_along_the_front_more_time_buys_less_error(points: list[Point]) -> None:
    found = front(points)
    assert [p.seconds for p in found] == sorted(p.seconds for p in found)
    assert all(a.met > b.met for a, b in pairwise(found))


@given(POINTS, st.integers(1, 15))
def test_a_ratio_compares_the_fastest_that_are_good_enough(
    points: list[Point], digits: int
) -> None:
    allowed = error_for(digits)
    for choice in choices(points, "a", "b"):
        if choice.digits != digits:
            continue
        able = {
            name: [p.seconds for p in points if p.method == name and p.met <= allowed]
            for name in "ab"
        }
        if able["a"] and able["b"]:
            assert choice.ratio == min(able["b"]) / min(able["a"])
        else:
            assert choice.ratio is None
        best = min(able["a"] + able["b"], default=None)
        assert (choice.best and choice.best.seconds) == best


@given(st.floats(0, HALF_ULP))
def test_luck_below_half_an_ulp_earns_nothing(error: float) -> None:
    lucky, honest = point(error, 2.0), point(HALF_ULP, 1.0)
    assert front([lucky, honest]) == [honest]
    assert fastest([lucky, honest], error_for(15)) == honest


@pytest.fixture(scope="module")
def beta_5() -> Case:
    return build("beta-5")


def errors(case: Case, method: str, measure: str) -> list[float]:
    todo = [task for task in tasks(case) if (task.method, task.measure) == (method, measure)]
    return [task.error(task.run()) for task in todo]


def test_the_exact_history_is_exact(beta_5: Case) -> None:
    # Times were found from depths; back from the double that is a time, the depth must be the same.
    motion = beta_5.motion
    assert beta_5.times[0] == 0
    assert beta_5.depths[0] == 0
    for k in (1, 50, 99):
        again = motion.depth_at_time(float(beta_5.times[k]))
        assert abs(again / beta_5.depths[k] - 1) < 1e-30
    assert abs(beta_5.depths[-1] / motion.final_depth - 1) < 1e-30


@pytest.mark.parametrize("measure", ["depth", "history"])
@pytest.mark.parametrize("method", SHEETS.values())
def test_the_sheet_converges(beta_5: Case, method: str, measure: str) -> None:
    found = errors(beta_5, method, measure)
    assert len(found) == len(STEPS)
    # To within its stopping rule: a step more or less.
    assert found[-1] < 1e-5 < 1e-3 < found[0]


def test_the_sheet_s_history_is_compared_down_to_where_the_sheet_ends(beta_5: Case) -> None:
    held = np.minimum(beta_5.times, 2e-8)
    depths = [float(depth) for depth in beta_5.depths]
    late = np.interp(held, beta_5.times, depths)
    assert beta_5.history_error(late) > 1e-2
    # Until there only the straight lines between the exact depths are off.
    assert beta_5.history_error(late, until=2e-8) < 1e-3
    assert errors(beta_5, SHEETS["centered"], "history")[-1] < 1e-8


@pytest.mark.parametrize("scheme", SHEETS)
def test_many_sheets_converge_as_one_does(beta_5: Case, scheme: str) -> None:
    todo = [task for task in tasks(beta_5) if task.method == SHEET_ARRAYS[scheme]]
    one = [task for task in tasks(beta_5) if task.method == SHEETS[scheme]]
    assert [task.setting for task in todo] == [t.setting for t in one if t.measure == "depth"]
    found = [task.error(task.run()) for task in todo[:4]]
    assert found == sorted(found, reverse=True)
    # The fastest of the cases takes a tenth fewer steps, and its error is the greatest.
    assert found[2] == pytest.approx(errors(beta_5, SHEETS[scheme], "depth")[2], abs=2e-4)


def test_the_middle_of_the_arrays_is_the_case(beta_5: Case) -> None:
    depths, histories = (t for t in tasks(beta_5) if t.method == ARRAYS)
    middle = depths.run()[depths.cases // 2]
    assert beta_5.depth_error(middle) < 4 * 2.0**-52
    assert histories.run().shape == (histories.cases, len(beta_5.times))


@pytest.mark.parametrize("measure", ["depth", "history"])
@pytest.mark.parametrize("method", SCIPY)
def test_scipy_converges(beta_5: Case, method: str, measure: str) -> None:
    todo = [
        task for task in scipy_tasks(beta_5) if (task.method, task.measure) == (method, measure)
    ]
    assert len(todo) == len(TOLERANCES)
    coarse, fine = todo[0], todo[5]
    assert fine.setting == "rtol 1e-10"
    # The tolerance is a step's; the errors of a few hundred steps add up.
    assert fine.error(fine.run()) < 1e-8 < 1e-4 < coarse.error(coarse.run())


def test_the_closed_form_and_mpmath_need_no_ladder(beta_5: Case) -> None:
    # Depths to 4 ulp, of 2^-52 each at most; histories to the 1e-13 that `history` promises.
    assert max(errors(beta_5, "closed form", "depth")) < 4 * 2.0**-52
    assert max(errors(beta_5, "closed form, arrays", "depth")) < 4 * 2.0**-52
    assert max(errors(beta_5, "closed form", "history")) < 1e-13
    assert max(errors(beta_5, "closed form, arrays", "history")) < 1e-13
    todo = {(task.method, task.measure): task for task in mpmath_tasks(beta_5)}
    for key in ((MPMATH[0], "depth"), (MPMATH[1], "depth"), (MPMATH[1], "history")):
        assert todo[key].error(todo[key].run()) < 1e-14


@pytest.mark.parametrize("name", ["crossing", "shallow", "hypervelocity"])
def test_scipy_follows_the_hard_cases(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("replication.bench.cases.POINTS", 6)
    case = build(name)
    for task in scipy_tasks(case):
        if (task.method, task.setting) == ("DOP853", "rtol 1e-10"):
            assert task.error(task.run()) < 1e-8


def point_of(task: Task, repeat: int = 1, limit: float = 1.0) -> Point:
    trial = Trial(task, repeat, limit)
    for _ in range(1 + repeat):
        trial.visit()
    return trial.point


def test_what_takes_too_long_is_a_gap(beta_5: Case) -> None:
    slowest = scipy_tasks(beta_5)[-2]
    assert (slowest.method, slowest.setting) == ("Radau", "rtol 3e-14")  # ten thousand evaluations
    found = point_of(slowest, limit=0.001)
    assert (found.error, found.timing) == (None, None)
    assert found.gap == "not done in 0.001 s"
    assert found.seconds == found.met == math.inf


def test_what_fails_is_a_gap_with_its_reason() -> None:
    def fail() -> float:
        raise ArithmeticError("never at rest")

    broken = Task("a", "b", "depth", fail, abs)
    assert point_of(broken).gap == "never at rest"
    assert point_of(replace(broken, run=lambda: math.nan)).gap == "the answer is not finite"


def test_tasks_take_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    turns: list[str] = []

    def task(name: str) -> Task:
        def run() -> float:
            turns.append(name)
            time.sleep(0.01)  # longer than a batch: one call each
            return 0.0

        return Task(name, "", "depth", run, abs)

    monkeypatch.setattr("replication.bench.run.tasks", lambda _: [task("a"), task("b")])
    (result,) = bench(["beta-5"], repeat=3).results
    assert "".join(turns) == "aabb" + "ab" * 3  # warmed up, then in turn
    assert [point.timing and point.timing.repeats for point in result.points] == [3, 3]


def test_an_interrupted_run_closes_its_progress(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt() -> float:
        raise KeyboardInterrupt

    closed: list[str] = []

    @contextmanager
    def watch(visits: Sequence[Trial], name: str) -> Iterator[Sequence[Trial]]:
        try:
            yield visits
        finally:
            closed.append(name)

    broken = Task("a", "", "depth", interrupt, abs)
    monkeypatch.setattr("replication.bench.run.tasks", lambda _: [broken])
    with pytest.raises(KeyboardInterrupt):
        bench(["beta-5"], watch=watch)
    assert closed == ["beta-5"]


def test_a_time_limit_ends_a_loop_and_leaves_interrupts_alone() -> None:
    def forever() -> None:
        while True:
            time.sleep(0)

    with pytest.raises(TimeoutError, match=r"not done in 0\.01 s"), time_limit(0.01):
        forever()
    with pytest.raises(KeyboardInterrupt), time_limit(60.0):
        raise KeyboardInterrupt
    with time_limit(60.0):
        pass


def test_a_stopwatch_repeats_and_divides_by_cases() -> None:
    watch = Stopwatch(lambda: 7, repeat=3, limit=5.0)
    for _ in range(5):
        watch.batch()
    assert (watch.answer, watch.timing.repeats) == (7, 3)
    assert 0 < watch.timing.best <= watch.timing.median
    assert watch.timing.per(4).best == watch.timing.best / 4


@pytest.fixture
def run_of_fakes(beta_5: Case) -> Bench:
    def fake(method: str, setting: str, measure: str, error: float, seconds: float) -> Point:
        timing = Timing(seconds, 1.5 * seconds, 7, 10)
        return Point(method, setting, measure, 1, error, timing)  # type: ignore[arg-type]

    points = [
        fake("sheet, published", "0.2 ns", "depth", 7e-4, 1e-4),
        fake("sheet, published", "0.2 ns", "history", 7e-4, 1.2e-4),
        fake("closed form", "no steps", "depth", 1e-16, 1e-5),
        fake("closed form", "no steps", "history", 1e-15, 2e-4),
        replace(fake("closed form, arrays", "10 cases", "depth", 1e-16, 1e-7), cases=10),
        fake("DOP853", "rtol 1e-08", "depth", 2e-9, 4e-3),
        fake("DOP853", "rtol 1e-06", "depth", 2e-7, 3e-3),
        Point("DOP853", "rtol 1e-06", "history", 1, gap="not done in 5 s"),
        fake("RK45", "rtol 1e-06", "history", 2e-6, 4e-3),
    ]
    return Bench({"processor": "abacus", "cores": 1}, 7, 5.0, (Result(beta_5, tuple(points)),))


def test_the_table_says_it_all(run_of_fakes: Bench) -> None:
    lines = bench_text(run_of_fakes).splitlines()
    assert lines[0] == "processor abacus, cores 1"
    rows = {line.split("  ")[0]: line.split() for line in lines[4:]}
    assert rows["closed form"][4:] == ["1.0e-16", "10", "15", "*", "1.0e-15", "200", "300", "*"]
    assert rows["DOP853"][3:] == ["2.0e-07", "3000", "4500", "-"]
    assert "- DOP853, rtol 1e-06, history: not done in 5 s" in lines
    assert rows["6"] == ["6", "DOP853,", "rtol", "1e-06", "300", "3e+04", "-", "-", "-"]
    answers = lines.index("What should I use for N digits?") + 1
    assert lines[answers:] == [
        "  final depth, 1 to 8 digits: closed form; SciPy takes 300 to 400 times as long",
        "  final depth, 10 to 15 digits: closed form; SciPy cannot",
        "  history, 1 to 2 digits: sheet, published; SciPy takes 33.3 times as long",
        "  history, 3 to 4 digits: closed form; SciPy takes 20 times as long",
        "  history, 6 to 14 digits: closed form; SciPy cannot",
        "  history, 15 digits: none of these",
        "  final depth of many cases, 1 to 8 digits: closed form, arrays; "
        "SciPy takes 3e+04 to 4e+04 times as long",
        "  final depth of many cases, 10 to 15 digits: closed form, arrays; SciPy cannot",
        "  history of many cases, 1 to 2 digits: sheet, published; SciPy takes 33.3 times as long",
        "  history of many cases, 3 to 4 digits: closed form; SciPy takes 20 times as long",
        "  history of many cases, 6 to 14 digits: closed form; SciPy cannot",
        "  history of many cases, 15 digits: none of these",
    ]
    assert "best and median of 1 repeat that" in bench_text(replace(run_of_fakes, repeat=1))


def test_figures_are_the_same_bytes_and_show_every_method(run_of_fakes: Bench) -> None:
    (result,) = run_of_fakes.results
    drawn = image(result, "svg")
    assert drawn == image(result, "svg")
    texts = {element.text for element in ET.fromstring(drawn).iter(f"{SVG}text")}
    assert {"sheet, published", "closed form", "DOP853", "RK45"} <= texts
    assert image(result, "png").startswith(b"\x89PNG")
    # Of the two methods without a history, one has no point and says why; the other has no gap.
    notes = [text for text in texts if text and text.startswith("not drawn")]
    assert notes == ["not drawn: DOP853, rtol 1e-06 (not done in 5 s)"]


def test_a_failed_setting_breaks_the_line(run_of_fakes: Bench) -> None:
    def path(points: list[Point]) -> str:
        drawn = ET.fromstring(image(Result(run_of_fakes.results[0].case, tuple(points)), "svg"))
        blue = (e for e in drawn.iter(f"{SVG}path") if "stroke: #0072b2" in e.get("style", ""))
        return next(d for d in (e.get("d", "") for e in blue) if "L" in d and "C" not in d)

    ladder = [point(10.0**-k, 10.0**k, "DOP853") for k in range(4)]
    assert path(ladder).count("M") == 1
    ladder.insert(2, replace(GAP, method="DOP853"))
    assert path(ladder).count("M") == 2


def test_a_quick_run_prints_json_and_writes_every_file(tmp_path: Path, coldspray: Command) -> None:
    status, out, err = coldspray(
        *("bench", "--quick", "--limit", "0.05 s", "--json", "--out", tmp_path),
        *("--case", "beta-5", "--case", "beta-5"),
    )
    assert (status, err) == (0, "")
    record = json.loads(out)
    assert list(record) == ["machine", "repeat", "limit", "cases"]
    assert {"processor", "cores", "system", "python", "numpy", "scipy"} <= set(record["machine"])
    (case,) = record["cases"]
    assert list(case) == ["name", "inputs", "depth", "times", "points", "ratios"]
    assert {point["method"] for point in case["points"]} >= {*SHEETS.values(), *SCIPY, *MPMATH}
    assert all((point["error"] is None) == bool(point["gap"]) for point in case["points"])
    assert any(point["gap"] for point in case["points"])
    assert json.loads((tmp_path / "bench.json").read_text("utf-8")) == record
    with (tmp_path / "bench.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["front"] == "true" for row in rows] == [p["front"] for p in case["points"]]
    assert {row["front"] for row in rows} == {"true", "false"}
    assert {path.name for path in tmp_path.iterdir()} == {
        *("bench.txt", "bench.json", "bench.csv", "bench-beta-5.svg", "bench-beta-5.png")
    }


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--case", "beta-4"], f"no case 'beta-4' to time: choose of {', '.join(CASES)}"),
        (["--repeat", "0"], "0 repeats: one or more are wanted"),
        (["--limit=-1 s"], "a limit of -1 s: it must be greater than zero"),
        (["--limit", "3 m"], "m"),
        (["--json", "--csv"], "argument --csv: not allowed with argument --json"),
    ],
)
def test_bad_options_get_one_line(arguments: list[str], message: str, coldspray: Command) -> None:
    status, out, err = coldspray("bench", *arguments)
    assert (status, out, len(err.splitlines())) == (2, "", 1)
    assert message in err
