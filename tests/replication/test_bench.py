"""The bench: what it measures, compares and prints, but not how fast anything is."""

import csv
import json
import math
import re
import sys
import time
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from importlib.util import find_spec
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from running import coldspray

from replication import BETA_5, history
from replication.bench import measure
from replication.bench.measure import (
    BENCH_CASES,
    CORRECT_DIGITS,
    MEASURES,
    STEPS,
    Case,
    Point,
    Task,
    build_case,
    tasks,
)
from replication.bench.peers import SOLVERS, crosses_radius
from replication.bench.show import accuracy_figure, texts
from replication.models.depth import final_depth


def point(error: float, seconds: float, method: str = "closed form", **more: Any) -> Point:
    task = {"method": method, "setting": "setting", "measure": "depth", "cases": 1}
    times = {"compile": None, "best": seconds, "median": 1.5 * seconds, "repeats": 7, "calls": 10}
    return task | {"error": error} | times | {"gap": None, "front": False} | more


@pytest.fixture(scope="module")
def beta_5() -> Case:
    return build_case("beta-5")


def errors(case: Case, method: str, measure: str) -> list[float]:
    asked = [task for task in tasks(case) if (task.method, task.measure) == (method, measure)]
    return [case.error(task.measure, task.run(), task.stop) for task in asked]


# The centered sheet is second order only if it is compared at its stop velocity.
@pytest.mark.parametrize(("scheme", "bound"), [("published", 2e-5), ("centered", 1e-6)])
def test_the_sheet_converges_and_the_bare_loop_gives_the_same_errors(
    scheme: str, bound: float, beta_5: Case
) -> None:
    name = f"sheet, {scheme}"
    depth, many = (errors(beta_5, method, "depth") for method in (name, f"{name}, many"))
    for ladder in (depth, errors(beta_5, name, "history")):
        assert len(ladder) == len(STEPS)
        # The stop rule, a step more or less, limits the accuracy.
        assert ladder[-1] < bound < 1e-3 < ladder[0]
    assert many == sorted(many, reverse=True)
    # The fastest impact takes a tenth fewer steps, so its error is the largest.
    assert many[2] == pytest.approx(depth[2], abs=2e-4)
    if scheme == "published":
        for suffix, sheets in (("", depth), (", many", many)):
            bare = errors(beta_5, f"sheet, Numba loop{suffix}", "depth")
            assert bare == pytest.approx(sheets, rel=1e-9, abs=0)


def test_a_sheets_history_is_compared_down_to_its_stop_velocity(beta_5: Case) -> None:
    depths = [float(depth) for depth in beta_5.depths]
    late = np.interp(np.minimum(beta_5.times, 2e-8), beta_5.times, depths)
    assert beta_5.error("history", late) > 1e-2
    # Before that velocity, only the linear interpolation is off.
    _, velocity = history(2e-8, **BETA_5.motion)
    assert beta_5.error("history", late, stop=velocity) < 1e-3


EXACT = {
    **dict.fromkeys(("closed form", "closed form, many"), 4 * 2.0**-52),
    **{f"Taylor series{name}": 1e-14 for name in ("", ", many", ", plain Python")},
    "closed form, bare function": 1e-14,
    "closed form, Numba loop, many": 1e-14,
}
"""The largest errors of methods that have no settings and lose no accuracy at y = 1."""

FINE = {
    **{name: ("rtol 1e-10", 1e-8) for name, (form, *_) in SOLVERS.items() if "rtol" in form},
    "RK4, Numba": ("400 steps", 1e-10),
    "RK6, Numba": ("400 steps", 1e-10),
    **({"heyoka": ("tol 1e-10", 1e-9)} if find_spec("heyoka") else {}),
}

INTERPRETED = (
    "(closed form|sheet, (published|centered)|.*(plain Python|bare function)|solve_ivp .*)"
)
"""Methods that compile nothing."""


@pytest.mark.parametrize("name", ["beta-5", "crossing", "hypervelocity"])
def test_methods_find_the_exact_depths(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("replication.bench.measure.HISTORY_POINTS", 11)
    case = build_case(name)
    # The solvers step over the kink of Eq. 13 at x = R, and lose accuracy there.
    kink = 1.0 if name == "beta-5" else 1e4
    met = set()
    for task in tasks(case):
        setting, bound = FINE.get(task.method, ("", 0.0))
        bound = EXACT.get(task.method, bound * kink)
        if task.method in EXACT or task.setting == setting:
            assert case.error(task.measure, task.run(), task.stop) < bound, task.method
            met.add(task.method)
    assert met == {*EXACT, *FINE}


@pytest.mark.parametrize("density", [785.0, 7850.0, 78500.0])
def test_a_depth_beyond_the_radius_crosses_it(density: float) -> None:
    """In the bench's terms, y'' = -(b y'^2 + c) (2 y - y^2) with y' = 1 at y = 0."""
    for velocity in range(100, 2100, 50):
        impact = replace(BETA_5, velocity=float(velocity), target_density=density)
        b = 3 * density / (8 * impact.particle_density)
        c = 3 * impact.target_resistance / (4 * impact.particle_density * velocity**2)
        assert crosses_radius(b, c) == (final_depth(**impact.motion) > impact.radius), velocity


def tried(case: Case, task: Task, repeat: int = 1, limit: float = 1.0) -> Point:
    point, *_ = measure.measured_points(case, task, repeat, limit)
    return point


TASK = Task("a", "b", "depth", lambda: 7.67e-6)


def test_a_task_that_fails_or_takes_too_long_is_a_gap_with_a_reason(
    beta_5: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail() -> float:
        raise ArithmeticError("never at rest")

    assert tried(beta_5, replace(TASK, run=fail))["gap"] == "never at rest"
    assert tried(beta_5, replace(TASK, run=lambda: math.nan))["gap"] == "the answer is not finite"
    slow = tried(beta_5, replace(TASK, run=lambda: time.sleep(0.02) or 0.0), limit=0.01)
    assert re.fullmatch(r"takes \S+ s, more than 0\.01 s", slow["gap"])
    assert (slow["best"], slow["error"], measure.met(slow)) == (None, None, math.inf)
    monkeypatch.setitem(sys.modules, "heyoka", None)
    case = build_case("beta-3")  # for which no integrator is kept
    task = next(task for task in tasks(case) if task.method == "heyoka")
    reason = "not installed: python -m pip install 'coldspray[bench]'"
    assert tried(case, task)["gap"] == reason


def test_times_are_per_call_and_per_case(beta_5: Case, monkeypatch: pytest.MonkeyPatch) -> None:
    seconds = iter([0.251, 0.001, *(5 * 1e-3 * k for k in (4, 1, 2))])

    def timed(run: Callable[[], Any], number: int) -> float:
        run()
        return next(seconds)

    monkeypatch.setattr(measure.timeit, "timeit", timed)
    point = tried(beta_5, replace(TASK, cases=4, run=lambda: [7.67e-6] * 4), repeat=3)
    assert (point["repeats"], point["calls"], point["compile"]) == (3, 5, None)
    assert (point["best"], point["median"]) == (2.5e-4, 5e-4)
    assert point["error"] > 0.1  # of the cases with other velocities
    seconds = iter([0.251, 0.001, 1.0])
    alone = tried(beta_5, replace(TASK, compiled=True))
    assert (alone["compile"], alone["gap"]) == (0.25, None)
    assert alone["error"] == pytest.approx(6.4e-4, rel=0.01)


def test_tasks_take_turns_and_an_interrupted_run_closes_its_progress_bar(
    beta_5: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    turns: list[str] = []

    def turn(name: str) -> float:
        if turns.count(name) == 6:
            raise KeyboardInterrupt
        turns.append(name)
        time.sleep(0.01)  # longer than a batch: one call each
        return 0.0

    class Bar(measure.tqdm):  # type: ignore[type-arg]
        def close(self) -> None:
            turns.append("closed")
            super().close()

    both = [replace(TASK, run=partial(turn, name)) for name in "ab"]
    for name, instead in (
        ("tasks", lambda _: both),
        ("build_case", lambda _: beta_5),
        ("tqdm", Bar),
    ):
        monkeypatch.setattr(measure, name, instead)
    (case,) = measure.bench(["beta-5"], repeat=3)["cases"]
    assert "".join(turns[:10]) == "aabb" + "ab" * 3  # warmed up, then in turn
    assert [point["repeats"] for point in case["points"]] == [3, 3]
    with pytest.raises(KeyboardInterrupt):
        measure.bench(["beta-5"])
    assert turns[turns.index("closed") :].count("a") == 1
    assert turns[-1] == "closed"


def test_the_table_of_two_made_up_runs() -> None:
    coarse, history = {"setting": "rtol 1e-06"}, {"measure": "history"}
    gap = dict.fromkeys(("error", "best", "median", "repeats", "calls"))
    gap |= {"gap": "takes 7 s, more than 5 s"}
    points = [
        point(7e-4, 1e-4, "sheet, published"),
        point(7e-4, 1.2e-4, "sheet, published", **history),
        point(1e-16, 1.23456e-5, compile=0.25),
        point(1e-17, 5e-5, "Taylor series"),  # as good as the closed form: less is luck
        point(1e-15, 2e-4, "Taylor series", **history),
        point(1e-16, 1e-7, "closed form, many", cases=10),
        point(2e-7, 3e-3, "DOP853", **coarse),
        point(1.0, 1.0, "DOP853") | gap | coarse | history,
        point(2e-9, 4e-3, "DOP853", setting="rtol 1e-08"),
        point(3e-7, 2e-4, "DOP853", setting="rtol 1e-08", measure="history"),
        point(8e-6, 4e-5, "RK4", **history),
    ]
    measure.mark_front(points)
    rows = [
        measure.fastest(points, *asked)
        for asked in product((False, True), MEASURES, CORRECT_DIGITS)
    ]
    case = {"name": "beta-5", "depth": 7.67e-6, "points": points, "fastest": rows}
    machine = {"processor": "abacus", "cores": 1}
    settings = [
        measure.loosest([points], "DOP853", name, digits)
        for name, digits in product(MEASURES, (4, 6, 8))
    ]
    run = {"machine": machine, "repeat": 7, "limit": 5.0, "cases": [case], "settings": settings}
    another = case | {"name": "beta-3", "fastest": [dict(row) for row in case["fastest"]]}
    another["fastest"][0] |= {"method": "RK4, 100 steps", "best": 1e-6}
    runs = (run, run | {"repeat": 1, "cases": [case, another]})
    told = "\n".join(texts(record)["bench.txt"] for record in runs)
    assert told == Path(__file__).with_name("bench.txt").read_text("utf-8")


@pytest.mark.parametrize(
    ("digits", "expected"),
    [
        (4, ("1e-4", 3e-4)),  # at once in the first case, and just so in the second
        (6, ("1e-6", 5e-4)),
        (8, ("1e-12", 9e-4)),  # the second case is a gap at 1e-8, which gives no digits
        (10, (None, None)),
    ],
)
def test_the_loosest_setting_gives_the_digits_in_every_case(
    digits: int, expected: tuple[str | None, float | None]
) -> None:
    settings = ("1e-4", "1e-6", "1e-8", "1e-12")
    reference = point(1e-15, 1e-6, "other", setting="1e-4")
    first, second = (
        [reference, *(point(error, time, "solver", setting=setting)
                  for setting, error, time in zip(settings, errors, times, strict=True))]
        for errors, times in (
            ((1e-9, 1e-9, 1e-10, 1e-12), (1e-4, 2e-4, 3e-4, 4e-4)),
            ((5e-5, 4e-7, 1e-9, 3e-10), (3e-4, 5e-4, 7e-4, 9e-4)),
        )
    )  # fmt: skip
    second[3] |= {"gap": "takes 7 s", "error": None, "best": None}
    answer = measure.loosest([first, second], "solver", "depth", digits)
    assert (answer["setting"], answer["best"]) == expected


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ([], (list(BENCH_CASES), 7, 5.0)),
        (["--quick"], (["beta-5"], 1, 1.0)),
        (["--quick", "--limit", "300 ms", "--repeat", "2"], (["beta-5"], 2, 0.3)),
    ],
)
def test_what_is_measured_and_for_how_many_seconds_at_most(
    options: list[str], expected: tuple[list[str], int, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = []

    def bench(names: list[str], repeat: int, limit: float, quiet: bool | None) -> None:
        asked.append((names, repeat, limit))
        raise ValueError("enough")

    monkeypatch.setattr(measure, "bench", bench)
    assert coldspray("bench", *options)[0] == 2
    assert asked == [expected]


@pytest.mark.slow
def test_a_quick_run_prints_json_and_writes_every_file(tmp_path: Path) -> None:
    status, out, err = coldspray(
        *("bench", "--quick", "--limit", "0.05 s", "--json", "--out", tmp_path),
        *("--case", "beta-5", "--case", "beta-5"),
    )
    assert (status, err) == (0, "")
    record = json.loads(out)
    assert list(record) == ["machine", "repeat", "limit", "cases", "settings"]
    assert len(record["settings"]) == 9 * 2 * 5  # solvers, quantities, numbers of digits
    assert {"processor", "cores", "system", "python", "numpy", "numba"} <= set(record["machine"])
    (case,) = record["cases"]
    assert list(case) == ["name", "inputs", "depth", "times", "points", "fastest"]
    assert {point["method"] for point in case["points"]} >= {
        *(*EXACT, *FINE, "sheet, published", "sheet, centered, many", "sheet, Numba loop")
    }
    assert all((point["error"] is None) == bool(point["gap"]) for point in case["points"])
    assert any(point["gap"] for point in case["points"])
    for point in case["points"]:
        plain = re.fullmatch(INTERPRETED, point["method"]) is not None
        assert point["gap"] or (point["compile"] is None) == plain, point["method"]
    assert all(row["method"] for row in case["fastest"] if row["digits"] <= 13)
    assert json.loads((tmp_path / "bench.json").read_text("utf-8")) == record
    with (tmp_path / "bench.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == ["case", *case["points"][0]]
    assert [row["front"] == "true" for row in rows] == [p["front"] for p in case["points"]]
    assert {row["front"] for row in rows} == {"true", "false"}
    drawn = (tmp_path / "bench-beta-5.svg").read_bytes()
    assert drawn == accuracy_figure(case)
    shown = {text.text for text in ET.fromstring(drawn).iter("{http://www.w3.org/2000/svg}text")}
    assert {point["method"] for point in case["points"] if not point["gap"]} <= shown
    assert {path.name for path in tmp_path.iterdir()} == {
        *("bench.txt", "bench.json", "bench.csv", "bench-beta-5.svg")
    }
