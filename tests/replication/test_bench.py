"""Work-precision: what is measured, how it is compared, what is printed. Never how fast it is."""

import csv
import json
import math
import sys
import time
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from importlib.util import find_spec
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from replication.bench import run
from replication.bench.cases import CASES, MEASURES, Case, build
from replication.bench.methods import OURS, SOLVERS, STEPS, Task, _taylor, tasks
from replication.bench.report import figure, texts
from replication.bench.run import DIGITS, Point, bench, error_for, mark_front, met, ratio, trial

Command = Callable[..., tuple[int, str, str]]
HALF_ULP = 2.0**-53


def point(
    error: float | None, seconds: float | None, method: str = "closed form", **more: Any
) -> Point:
    times = {"best": seconds, "median": seconds and 1.5 * seconds, "repeats": 7, "calls": 10}
    head = {"method": method, "setting": "setting", "measure": "depth", "cases": 1, "error": error}
    return head | {"compile": None, **times, "gap": None, "front": False} | more


GAP = point(None, None, "RK45", gap="takes 7 s, more than 5 s", repeats=None, calls=None)

POINTS = st.lists(
    st.builds(
        point, st.floats(0, 1), st.floats(1e-9, 1e3), st.sampled_from(["closed form", "RK45"])
    )
    | st.builds(GAP.copy)
)


@given(POINTS)
def test_nothing_measured_beats_the_front(points: list[Point]) -> None:
    mark_front(points)
    front = sorted((p for p in points if p["front"]), key=lambda p: p["best"])
    for p in points:
        if not p["gap"]:
            assert any(f["best"] <= p["best"] and met(f) <= met(p) for f in front)
            better = (f for f in front if p["best"] <= f["best"] and met(p) <= met(f))
            assert all((p["best"], met(p)) == (f["best"], met(f)) for f in better)
    assert all(a["best"] < b["best"] and met(a) > met(b) for a, b in pairwise(front))
    assert not any(p["gap"] for p in front)


@given(points=POINTS, digits=st.sampled_from(DIGITS))
def test_a_choice_is_the_fastest_of_each_side_that_is_good_enough(
    points: list[Point], digits: int
) -> None:
    choice = ratio(points, False, "depth", digits)
    for side, ours in (("ours", True), ("peer", False)):
        able = [p for p in points if met(p) <= error_for(digits) and (p["method"] in OURS) == ours]
        assert choice[side] == min((p["best"] for p in able), default=None)


@given(st.floats(0, HALF_ULP))
def test_luck_below_half_an_ulp_earns_nothing(error: float) -> None:
    lucky, honest = point(error, 2.0), point(HALF_ULP, 1.0, setting="honest")
    mark_front([lucky, honest])
    assert (lucky["front"], honest["front"]) == (False, True)
    assert ratio([lucky, honest], False, "depth", 15)["fastest"] == "closed form, honest"


@pytest.fixture(scope="module")
def beta_5() -> Case:
    return build("beta-5")


def errors(case: Case, method: str, measure: str) -> list[float]:
    asked = [task for task in tasks(case) if (task.method, task.measure) == (method, measure)]
    return [case.error(task.measure, task.run(), task.stop) for task in asked]


def test_the_exact_history_is_exact(beta_5: Case) -> None:
    # Times were found from depths; back from the double that is a time, the depth must be the same.
    motion = beta_5.motion
    assert beta_5.times[0] == beta_5.depths[0] == 0
    for k in (1, 50, 99):
        again = motion.depth_at_time(float(beta_5.times[k]))
        assert abs(again / beta_5.depths[k] - 1) < 1e-30
    assert abs(beta_5.depths[-1] / motion.final_depth - 1) < 1e-30


@pytest.mark.parametrize("scheme", ["published", "centered"])
def test_the_sheet_converges(scheme: str, beta_5: Case) -> None:
    name = f"sheet, {scheme}"
    depth, history, many = (
        errors(beta_5, *asked)
        for asked in ((name, "depth"), (name, "history"), (f"{name}, many", "depth"))
    )
    for ladder in (depth, history):
        assert len(ladder) == len(STEPS)
        # To within its stopping rule: a step more or less.
        assert ladder[-1] < 2e-5 < 1e-3 < ladder[0]
    assert many == sorted(many, reverse=True)
    # The fastest of the cases takes a tenth fewer steps, and its error is the greatest.
    assert many[2] == pytest.approx(depth[2], abs=2e-4)


def test_the_sheet_s_history_is_compared_down_to_where_the_sheet_ends(beta_5: Case) -> None:
    held = np.minimum(beta_5.times, 2e-8)
    depths = [float(depth) for depth in beta_5.depths]
    late = np.interp(held, beta_5.times, depths)
    assert beta_5.error("history", late) > 1e-2
    # Until there only the straight lines between the exact depths are off.
    velocity = float(beta_5.motion.velocity_at_depth(beta_5.motion.depth_at_time(2e-8)))
    assert beta_5.error("history", late, stop=velocity) < 1e-3


EXACT = {
    **dict.fromkeys(("closed form", "closed form, many"), 4 * 2.0**-52),
    **dict.fromkeys((name for name in OURS if name.startswith("Taylor")), 1e-14),
    "Taylor series, many": 1e-14,
    "closed form, Numba loop, many": 1e-14,
}
"""These have no ladder of settings, and cross the radius as if it were not there."""

FINE = {
    **{name: ("rtol 1e-10", 1e-8) for name, (form, *_) in SOLVERS.items() if "rtol" in form},
    "RK4, Numba": ("400 steps", 1e-10),
    **({"heyoka": ("tol 1e-10", 1e-9)} if find_spec("heyoka") else {}),
}


@pytest.mark.parametrize("name", ["beta-5", "crossing", "hypervelocity"])
def test_methods_find_the_exact_answers(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("replication.bench.cases.POINTS", 11)
    case = build(name)
    # Nothing smooths the kink of Eq. 13 at x = R for a method that steps over it.
    kink = 1.0 if name == "beta-5" else 1e4
    met = set()
    for task in tasks(case):
        setting, bound = FINE.get(task.method, ("", 0.0))
        bound = EXACT.get(task.method, bound * kink)
        if task.method in EXACT or task.setting == setting:
            assert case.error(task.measure, task.run(), task.stop) < bound, task.method
            met.add(task.method)
    assert met == {*EXACT, *FINE}


@pytest.mark.parametrize("many", ["", ", many"])
def test_the_bare_loop_of_the_sheet_is_the_sheet(many: str, beta_5: Case) -> None:
    bare = errors(beta_5, f"sheet, Numba loop{many}", "depth")
    assert bare == pytest.approx(errors(beta_5, f"sheet, published{many}", "depth"), rel=1e-9)


@pytest.fixture
def measure(beta_5: Case) -> Callable[..., Point]:
    def to_the_end(task: Task, repeat: int = 1, limit: float = 1.0) -> Point:
        point, *_ = trial(beta_5, task, repeat, limit)
        return point

    return to_the_end


TASK = Task("a", "b", "depth", lambda: 7.67e-6)


def test_what_fails_or_takes_too_long_is_a_gap_with_its_reason(
    beta_5: Case, measure: Callable[..., Point], monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail() -> float:
        raise ArithmeticError("never at rest")

    assert measure(replace(TASK, run=fail))["gap"] == "never at rest"
    assert measure(replace(TASK, run=lambda: math.nan))["gap"] == "the answer is not finite"
    slow = measure(replace(TASK, run=lambda: time.sleep(0.02) or 0.0), limit=0.01)
    assert slow["gap"].startswith("takes 0.02")
    assert slow["gap"].endswith("s, more than 0.01 s")
    assert (slow["best"], slow["error"], met(slow)) == (None, None, math.inf)
    monkeypatch.setitem(sys.modules, "heyoka", None)
    _taylor.cache_clear()
    task = next(task for task in tasks(beta_5) if task.method == "heyoka")
    assert measure(task)["gap"] == "not installed: python -m pip install 'coldspray[bench]'"
    _taylor.cache_clear()


def test_a_point_has_times_a_case(measure: Callable[..., Point]) -> None:
    alone = measure(replace(TASK, compiled=True), repeat=3)
    assert (alone["repeats"], alone["gap"]) == (3, None)
    assert alone["error"] == pytest.approx(6.4e-4, rel=0.01)
    assert 0 < alone["best"] <= alone["median"]
    assert alone["compile"] is not None
    assert measure(TASK)["compile"] is None


def test_a_time_is_that_of_a_batch_over_its_calls_and_cases(
    measure: Callable[..., Point], monkeypatch: pytest.MonkeyPatch
) -> None:
    def timed(run: Callable[[], Any], number: int) -> float:
        run()
        return 1e-3 * number

    monkeypatch.setattr(run.timeit, "timeit", timed)
    four = measure(replace(TASK, cases=4))
    assert (four["calls"], four["best"], four["median"]) == (5, 2.5e-4, 2.5e-4)


def test_tasks_take_turns_and_an_interrupted_run_closes_its_progress(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    turns: list[str] = []

    def turn(name: str) -> float:
        if turns.count(name) == 6:
            raise KeyboardInterrupt
        turns.append(name)
        time.sleep(0.01)  # longer than a batch: one call each
        return 0.0

    class Bar(run.tqdm):  # type: ignore[type-arg]
        def close(self) -> None:
            turns.append("closed")
            super().close()

    both = [replace(TASK, run=partial(turn, name)) for name in "ab"]
    monkeypatch.setattr(run, "tasks", lambda _: both)
    monkeypatch.setattr(run, "tqdm", Bar)
    (case,) = bench(["beta-5"], repeat=3)["cases"]
    assert "".join(turns[:10]) == "aabb" + "ab" * 3  # warmed up, then in turn
    assert [point["repeats"] for point in case["points"]] == [3, 3]
    with pytest.raises(KeyboardInterrupt):
        bench(["beta-5"])
    assert turns[turns.index("closed") :].count("a") == 1
    assert turns[-1] == "closed"


@pytest.fixture
def run_of_fakes() -> dict[str, Any]:
    fine, coarse, history = {"setting": "0.2 ns"}, {"setting": "rtol 1e-06"}, {"measure": "history"}
    points = [
        point(7e-4, 1e-4, "sheet, published", **fine),
        point(7e-4, 1.2e-4, "sheet, published", **fine, **history),
        point(1e-16, 1e-5, compile=0.25),
        point(1e-15, 2e-4, "Taylor series", **history),
        point(1e-16, 1e-7, "closed form, many", cases=10),
        point(2e-9, 4e-3, "DOP853", setting="rtol 1e-08"),
        point(2e-7, 3e-3, "DOP853", **coarse),
        GAP | {"method": "DOP853"} | coarse | history,
        point(2e-6, 4e-5, "RK4", **history),
    ]
    mark_front(points)
    asked = [(many, measure, n) for many in (False, True) for measure in MEASURES for n in DIGITS]
    ratios = [ratio(points, *question) for question in asked]
    case = {"name": "beta-5", "depth": 7.67e-6, "points": points, "ratios": ratios}
    machine = {"processor": "abacus", "cores": 1}
    return {"machine": machine, "repeat": 7, "limit": 5.0, "cases": [case]}


def test_the_table_says_it_all(run_of_fakes: dict[str, Any]) -> None:
    lines = texts(run_of_fakes)["bench.txt"].splitlines()
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
    once = texts(run_of_fakes | {"repeat": 1})["bench.txt"]
    assert "best and median of 1 repeat that" in once


def test_cases_that_differ_in_their_answer_are_named(run_of_fakes: dict[str, Any]) -> None:
    (case,) = run_of_fakes["cases"]
    other = case | {"name": "beta-3", "ratios": [dict(ratio) for ratio in case["ratios"]]}
    other["ratios"][0] |= {"fastest": "RK4, 100 steps", "peer": 1e-6, "ratio": 0.1}
    text = texts(run_of_fakes | {"cases": [case, other]})["bench.txt"]
    assert (
        "  final depth, 1 digit: closed form (beta-5), RK4 (beta-3), 1 to 10 us; the others' best "
        "takes 300 times as long\n"
    ) in text


def test_figures_are_the_same_bytes_and_name_every_method(run_of_fakes: dict[str, Any]) -> None:
    (case,) = run_of_fakes["cases"]
    drawn = figure(case, "svg")
    assert drawn == figure(case, "svg")
    shown = {
        element.text for element in ET.fromstring(drawn).iter("{http://www.w3.org/2000/svg}text")
    }
    assert {point["method"] for point in case["points"]} <= shown
    assert figure(case, "png").startswith(b"\x89PNG")


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
    assert list(rows[0]) == ["case", *case["points"][0]]
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
