"""Work-precision: what is measured, how it is compared, what is printed. Never how fast it is."""

import csv
import json
import math
import sys
import time
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from importlib.util import find_spec
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from replication.bench.cases import CASES, Case, build
from replication.bench.methods import OURS, STEPS, Task, own_tasks
from replication.bench.peers import SCIPY, _taylor, peer_tasks
from replication.bench.report import bench_text, figure
from replication.bench.run import Bench, Point, Result, Trial, bench, error_for, fastest, front

Command = Callable[..., tuple[int, str, str]]
HALF_ULP = 2.0**-53


def point(error: float, seconds: float, method: str = "closed form", **more: Any) -> Point:
    times: Any = {"best": seconds, "median": 1.5 * seconds, "repeats": 7, "calls": 10}
    return replace(Point(method, "setting", "depth", 1, error=error, **times), **more)


GAP = Point("RK45", "setting", "depth", 1, gap="takes 7 s, more than 5 s", calls=1)

SVG = "{http://www.w3.org/2000/svg}"

POINTS = st.lists(
    st.builds(
        point, st.floats(0, 1), st.floats(1e-9, 1e3), st.sampled_from(["closed form", "RK45"])
    )
    | st.just(GAP)
)


@given(POINTS)
def test_nothing_measured_beats_the_front(points: list[Point]) -> None:
    measured = [p for p in points if not p.gap]
    found = [p for p in front(points) if not p.gap]
    for p in measured:
        assert any(f.best <= p.best and f.met <= p.met for f in found)
    for f in found:
        better = (p for p in measured if p.best <= f.best and p.met <= f.met)
        assert all((p.best, p.met) == (f.best, f.met) for p in better)
    assert all(a.best <= b.best and a.met > b.met for a, b in pairwise(found))


@given(points=POINTS, digits=st.integers(1, 15))
def test_a_choice_is_the_fastest_of_each_side_that_is_good_enough(
    beta_5: Case, points: list[Point], digits: int
) -> None:
    result = Result(beta_5, tuple(points))
    for choice, ours in zip(result.choice("depth", False, digits), (True, False), strict=True):
        able = [p for p in points if p.met <= error_for(digits) and (p.method in OURS) == ours]
        assert (choice and choice.best) == min((p.best for p in able), default=None)


@given(st.floats(0, HALF_ULP))
def test_luck_below_half_an_ulp_earns_nothing(error: float) -> None:
    lucky, honest = point(error, 2.0), point(HALF_ULP, 1.0)
    assert front([lucky, honest]) == [honest]
    assert fastest([lucky, honest, None], 15) == honest


@pytest.fixture(scope="module")
def beta_5() -> Case:
    return build("beta-5")


def errors(tasks: Sequence[Task], method: str, measure: str) -> list[float]:
    todo = [task for task in tasks if (task.method, task.measure) == (method, measure)]
    return [task.error(task.run()) for task in todo]


def test_the_exact_history_is_exact(beta_5: Case) -> None:
    # Times were found from depths; back from the double that is a time, the depth must be the same.
    motion = beta_5.motion
    assert beta_5.times[0] == beta_5.depths[0] == 0
    for k in (1, 50, 99):
        again = motion.depth_at_time(float(beta_5.times[k]))
        assert abs(again / beta_5.depths[k] - 1) < 1e-30
    assert abs(beta_5.depths[-1] / motion.final_depth - 1) < 1e-30


def test_the_sheet_converges(beta_5: Case) -> None:
    tasks = list(own_tasks(beta_5))
    for name in ("sheet, published", "sheet, centered"):
        for measure in ("depth", "history"):
            found = errors(tasks, name, measure)
            assert len(found) == len(STEPS)
            # To within its stopping rule: a step more or less.
            assert found[-1] < 2e-5 < 1e-3 < found[0]
        many = errors(tasks, f"{name}, many", "depth")
        assert many == sorted(many, reverse=True)
        # The fastest of the cases takes a tenth fewer steps, and its error is the greatest.
        assert many[2] == pytest.approx(errors(tasks, name, "depth")[2], abs=2e-4)


def test_the_sheet_s_history_is_compared_down_to_where_the_sheet_ends(beta_5: Case) -> None:
    held = np.minimum(beta_5.times, 2e-8)
    depths = [float(depth) for depth in beta_5.depths]
    late = np.interp(held, beta_5.times, depths)
    assert beta_5.history_error(late) > 1e-2
    # Until there only the straight lines between the exact depths are off.
    assert beta_5.history_error(late, until=2e-8) < 1e-3


def test_the_closed_form_and_the_series_need_no_ladder(beta_5: Case) -> None:
    tasks = list(own_tasks(beta_5))
    for name in ("closed form", "closed form, many"):
        assert max(errors(tasks, name, "depth")) < 4 * 2.0**-52
    for name in ("Taylor series", "Taylor series, plain Python", "Taylor series, many"):
        assert max(errors(tasks, name, "history")) < 1e-14


FINE = {
    **{f"solve_ivp {name}": ("rtol 1e-10", 1e-8) for name in SCIPY},
    "odeint, Numba": ("rtol 1e-10", 1e-8),
    "dop853, Numba": ("rtol 1e-10", 1e-8),
    "RK4, Numba": ("400 steps", 1e-10),
    **({"heyoka": ("tol 1e-10", 1e-9)} if find_spec("heyoka") else {}),
    "closed form, Numba loop, many": ("no steps", 1e-14),
}


@pytest.mark.parametrize("name", ["beta-5", "crossing", "hypervelocity"])
def test_peers_find_the_exact_answers(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("replication.bench.cases.POINTS", 11)
    tasks = list(peer_tasks(build(name)))
    assert {task.method for task in tasks} > set(FINE)
    # Nothing smooths the kink of Eq. 13 at x = R for a method that steps over it.
    kink = 1.0 if name == "beta-5" else 1e4
    for task in tasks:
        setting, bound = FINE.get(task.method, ("", 0.0))
        if task.setting == setting:
            assert task.error(task.run()) < bound * kink, task.method


def test_the_bare_loop_of_the_sheet_is_the_sheet(beta_5: Case) -> None:
    tasks = [*own_tasks(beta_5), *peer_tasks(beta_5)]
    for many in ("", ", many"):
        bare = errors(tasks, f"sheet, Numba loop{many}", "depth")
        assert bare == pytest.approx(errors(tasks, f"sheet, published{many}", "depth"), rel=1e-9)


def point_of(task: Task, repeat: int = 1, limit: float = 1.0) -> Point:
    trial = Trial(task, repeat, limit)
    for _ in range(3 + repeat):
        trial.visit()
    return trial.point


def test_what_fails_or_takes_too_long_is_a_gap_with_its_reason(
    beta_5: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail() -> float:
        raise ArithmeticError("never at rest")

    broken = Task("a", "b", "depth", fail, abs)
    assert point_of(broken).gap == "never at rest"
    assert point_of(replace(broken, run=lambda: math.nan)).gap == "the answer is not finite"
    slow = point_of(replace(broken, run=lambda: time.sleep(0.02) or 0.0), limit=0.01)
    assert slow.gap.startswith("takes 0.02")
    assert slow.gap.endswith("s, more than 0.01 s")
    assert (slow.best, slow.met) == (math.inf, math.inf)
    monkeypatch.setitem(sys.modules, "heyoka", None)
    _taylor.cache_clear()
    task = next(task for task in peer_tasks(beta_5) if task.method == "heyoka")
    assert point_of(task).gap == "not installed: python -m pip install 'coldspray[bench]'"
    _taylor.cache_clear()


def test_a_point_has_times_a_case() -> None:
    task = Task("a", "b", "depth", lambda: 1e-9, abs, compiled=True, cases=4)
    alone = point_of(replace(task, cases=1), repeat=3)
    assert (alone.repeats, alone.error) == (3, 1e-9)
    assert 0 < alone.best <= alone.median
    assert alone.compile is not None
    assert point_of(replace(task, compiled=False)).compile is None
    trial = Trial(task, 1, 1.0)
    trial.visit()
    trial.visit()
    assert trial.point.best == trial.batches[0]


def test_tasks_take_turns_and_an_interrupted_run_closes_its_progress(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    turns: list[str] = []

    def task(name: str) -> Task:
        def run() -> float:
            if turns.count(name) == 5:
                raise KeyboardInterrupt
            turns.append(name)
            time.sleep(0.01)  # longer than a batch: one call each
            return 0.0

        return Task(name, "", "depth", run, abs)

    @contextmanager
    def watch(visits: Sequence[Trial], name: str) -> Iterator[Sequence[Trial]]:
        try:
            yield visits
        finally:
            turns.append(name)

    monkeypatch.setattr("replication.bench.run.own_tasks", lambda _: [task("a")])
    monkeypatch.setattr("replication.bench.run.peer_tasks", lambda _: [task("b")])
    (result,) = bench(["beta-5"], repeat=3).results
    assert "".join(turns) == "aabb" + "ab" * 3  # warmed up, then in turn
    assert [p.repeats for p in result.points] == [3, 3]
    with pytest.raises(KeyboardInterrupt):
        bench(["beta-5"], watch=watch)
    assert turns[-1] == "beta-5"


@pytest.fixture
def run_of_fakes(beta_5: Case) -> Bench:
    points = [
        point(7e-4, 1e-4, "sheet, published", setting="0.2 ns"),
        point(7e-4, 1.2e-4, "sheet, published", setting="0.2 ns", measure="history"),
        point(1e-16, 1e-5, compile=0.25),
        point(1e-15, 2e-4, "Taylor series", measure="history"),
        point(1e-16, 1e-7, "closed form, many", cases=10),
        point(2e-9, 4e-3, "DOP853", setting="rtol 1e-08"),
        point(2e-7, 3e-3, "DOP853", setting="rtol 1e-06"),
        replace(GAP, method="DOP853", setting="rtol 1e-06", measure="history"),
        point(2e-6, 4e-5, "RK4", measure="history"),
    ]
    return Bench({"processor": "abacus", "cores": 1}, 7, 5.0, (Result(beta_5, tuple(points)),))


def test_the_table_says_it_all(run_of_fakes: Bench) -> None:
    lines = bench_text(run_of_fakes).splitlines()
    assert lines[0] == "processor abacus, cores 1"
    rows = {line.split("  ")[0]: line.split()[2:] for line in lines[4:]}
    assert rows["closed form"] == ["setting", "0.25", "1.0e-16", "10", "15", "*"]
    assert rows["DOP853"] == ["1e-06", "2.0e-07", "3000", "4500", "-"]
    assert "- DOP853, rtol 1e-06, history: takes 7 s, more than 5 s" in lines
    answers = lines.index("What should I use for N digits?") + 1
    assert lines[answers:] == [
        "  final depth, 1 to 15 digits: closed form, 10 us; the others' best takes 300 to 400 "
        "times as long; some cases are beyond the others",
        "  history, 1 to 5 digits: RK4, 40 us",
        "  history, 6 to 14 digits: Taylor series, 200 us; some cases are beyond the others",
        "  history, 15 digits: none of these",
        "  final depth of many cases, 1 to 15 digits: closed form, many, 0.1 us; the others' best "
        "takes 3e+04 to 4e+04 times as long; some cases are beyond the others",
        "  history of many cases, 1 to 5 digits: RK4, 40 us",
        "  history of many cases, 6 to 14 digits: Taylor series, 200 us; some cases are beyond the "
        "others",
        "  history of many cases, 15 digits: none of these",
    ]
    assert "best and median of 1 repeat that" in bench_text(replace(run_of_fakes, repeat=1))


def test_figures_are_the_same_bytes_and_name_every_method(run_of_fakes: Bench) -> None:
    (result,) = run_of_fakes.results
    drawn = figure(result, "svg")
    assert drawn == figure(result, "svg")
    texts = {element.text for element in ET.fromstring(drawn).iter(f"{SVG}text")}
    assert {p.method for p in result.points} <= texts
    assert figure(result, "png").startswith(b"\x89PNG")


def test_a_quick_run_prints_json_and_writes_every_file(tmp_path: Path, coldspray: Command) -> None:
    status, out, err = coldspray(
        *("bench", "--quick", "--limit", "0.05 s", "--json", "--out", tmp_path),
        *("--case", "beta-5", "--case", "beta-5"),
    )
    assert (status, err) == (0, "")
    record = json.loads(out)
    assert list(record) == ["machine", "repeat", "limit", "cases"]
    assert {"processor", "cores", "system", "python", "numpy", "numba"} <= set(record["machine"])
    (case,) = record["cases"]
    assert list(case) == ["name", "inputs", "depth", "times", "points", "ratios"]
    assert {point["method"] for point in case["points"]} >= OURS | set(FINE)
    assert all((point["error"] is None) == bool(point["gap"]) for point in case["points"])
    assert any(point["gap"] for point in case["points"])
    assert all(ratio["fastest"] for ratio in case["ratios"] if ratio["digits"] <= 13)
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
        (["--repeat", "0"], "--repeat: give a whole number from 1 to 10,000,"),
        (["--limit=-1 s"], "a limit of -1 s: it must be greater than zero"),
        (["--limit", "3 m"], "m"),
        (["--json", "--csv"], "argument --csv: not allowed with argument --json"),
    ],
)
def test_bad_options_get_one_line(arguments: list[str], message: str, coldspray: Command) -> None:
    status, out, err = coldspray("bench", *arguments)
    assert (status, out, len(err.splitlines())) == (2, "", 1)
    assert message in err
