"""Compiled models: the same doubles as plain ones, errors by element, containers, threads."""

import inspect
import math
import os
import pickle
import shutil
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from multiprocessing import get_all_start_methods
from pathlib import Path
from typing import Any

import dask
import dask.array
import numpy as np
import pandas as pd
import pytest
import xarray
from hypothesis import given, settings
from hypothesis import strategies as st

import replication
from reference.scheme import Scheme
from replication.cases import BETA_5
from replication.models import arrays, crater, depth, estimates, impact, inverse, motion, sheet
from replication.models.arrays import history, run_many, ufunc
from replication.models.impact import Impact

CASE = (500.0, 11e-6, 8900.0, 7850.0, 3.5e9)
FUNCTIONS: dict[str, tuple[float, ...]] = {
    "final_depth": CASE,
    "normalized_depth": (CASE[0], *CASE[2:]),
    "depth_at_velocity": (100.0, *CASE),
    "velocity_at_depth": (4e-6, *CASE),
    "time_to_depth": (4e-6, *CASE),
    "stop_time": (*CASE, 1.0),
    "history": (5e-9, *CASE),
    "run_many": (*CASE, 2e-9, 1.0),
    "resistance_for_depth": (3.3e-6, *CASE[:4]),
    "velocity_for_depth": (3.3e-6, *CASE[1:]),
    "radius_for_depth": (3.3e-6, CASE[0], *CASE[2:]),
    "particle_density_for_depth": (3.3e-6, *CASE[:2], *CASE[3:]),
    "target_density_for_depth": (3.3e-6, *CASE[:3], CASE[4]),
    "crater_depth": (0.06, 11e-6),
    "crater_volume_ratio": (3.3e-6, 11e-6),
    "frank_zook_depth": (*CASE[:4], 9.13e9, 2 / 3, 0.557, 1.046),
    "goodier_beta": (2.77,),
    "walker_anderson_alpha": (200e9, 215e6),
    "walker_anderson_beta": (8.5,),
    "penetration_threshold": (90e6, 3.5e9, 8900.0),
    "constant_pressure_depth": (*CASE[:3], CASE[4]),
}
CASES = 100_000


def impact_of(*case: float, **more: float) -> Impact:
    return Impact(**dict(zip((*BETA_5.motion, "step"), case, strict=False)), **more)


def as_tuple(results: Any) -> tuple[Any, ...]:
    return results if isinstance(results, tuple) else (results,)


# Plain and compiled


def drawn(count: int, *ranges: tuple[float, float]) -> list[np.ndarray]:
    """Return columns of random numbers, uniformly distributed in the logarithm."""
    generator = np.random.default_rng(2006)
    return [np.exp(generator.uniform(np.log(low), np.log(high), count)) for low, high in ranges]


MOTION = ((1e-6, 1e5), (1e-9, 1), (1, 1e5), (1, 1e5), (1e3, 1e13))
MODELS: dict[Callable[..., Any], tuple[tuple[float, float], ...]] = {
    depth.final_depth: MOTION,
    depth.normalized_depth: (MOTION[0], *MOTION[2:]),
    depth.depth_at_velocity: ((1e-9, 1e2), (1e2, 1e5), *MOTION[1:]),
    depth.velocity_at_depth: ((1e-18, 1e-12), (1, 1e5), (1e-6, 1), *MOTION[2:]),
    motion.time_to_depth: ((1e-18, 1e-12), (1, 1e5), (1e-6, 1), *MOTION[2:]),
    motion.stop_time: (*MOTION, (1e-9, 1e-6)),
    impact.particle_mass: MOTION[1:3],
    estimates.particle_velocity: (MOTION[0], (1e-15, 1e-6), (1e-15, 1e-6)),
    inverse.resistance_for_depth: ((1e-12, 1e1), *MOTION[:4]),
    inverse.velocity_for_depth: ((1e-12, 1e1), *MOTION[1:]),
    inverse.radius_for_depth: ((1e-12, 1e1), MOTION[0], *MOTION[2:]),
    inverse.particle_density_for_depth: ((1e-12, 1e1), *MOTION[:2], *MOTION[3:]),
    inverse.target_density_for_depth: ((1e-12, 1e1), *MOTION[:3], MOTION[4]),
    crater.crater_depth: ((1e-9, 1e3), MOTION[1]),
    crater.crater_volume_ratio: ((1e-12, 1e1), MOTION[1]),
    estimates.frank_zook_depth: (*MOTION, (0.1, 10), (0.1, 10), (0.1, 10)),
    estimates.frank_zook_depth_as_printed: (*MOTION, (0.1, 10), (0.1, 10), (0.1, 10)),
    estimates.goodier_beta: ((1e-3, 1e3),),
    estimates.walker_anderson_alpha: ((1e6, 1e12), (1e6, 1e12)),
    estimates.walker_anderson_beta: ((1e-3, 1e3),),
    estimates.penetration_threshold: (MOTION[4], MOTION[4], MOTION[2]),
    estimates.constant_pressure_depth: (*MOTION[:3], MOTION[4]),
}
"""All models of numbers that the public functions or sweeps compile, with ranges of inputs."""


# In plain Python a time takes a third of a millisecond, as it needs the whole series.
TIMES = motion.stop_time, motion.time_to_depth


@pytest.mark.parametrize(
    ("model", "count"),
    [
        *((model, CASES // 100 if model in TIMES else CASES) for model in MODELS),
        *(pytest.param(model, CASES // 10, marks=pytest.mark.slow) for model in TIMES),
    ],
    ids=lambda value: value.__name__ if callable(value) else str(value),
)
def test_compiled_is_plain_to_the_last_bit(model: Callable[..., Any], count: int) -> None:
    columns = drawn(count, *MODELS[model])
    plain = [model(*values) for values in zip(*(c.tolist() for c in columns), strict=True)]
    np.testing.assert_array_equal(ufunc(model)(*columns), plain)  # NaN, too


def test_compiled_histories_are_plain_to_the_last_bit() -> None:
    columns = drawn(2000, *MOTION)
    times = arrays.stop_time(*columns)[:, None] * np.array([0.1, 0.5, 0.9, 1.1])
    result = history(times, *(column[:, None] for column in columns))
    for k, case in enumerate(zip(*(column.tolist() for column in columns), strict=True)):
        depths, speeds = [0.0] * 4, [0.0] * 4
        motion.history(times[k].tolist(), *case, depths, speeds)
        assert (result[0][k].tolist(), result[1][k].tolist()) == (depths, speeds)


@pytest.mark.parametrize("scheme", Scheme)
@pytest.mark.parametrize("count", [CASES // 100, pytest.param(CASES, marks=pytest.mark.slow)])
def test_compiled_sheets_are_plain_to_the_last_bit(count: int, scheme: Scheme) -> None:
    # Sheets of two to hundreds of rows; some get beyond R, some start below the stop velocity.
    ranges = ((0.5, 5e3), (1e-6, 1e-4), (1e2, 2e4), (1e2, 2e4), (1e7, 1e11), (0.02, 2))
    columns = drawn(count, *ranges)
    columns[-1] *= columns[1] / columns[0]  # a step covers this share of the radius
    result = run_many(*columns, stop_velocity=0.9, scheme=scheme)
    for *row, x, k in zip(*(column.tolist() for column in (*columns, *result)), strict=True):
        rows = sheet.run(impact_of(*row, stop_velocity=0.9), scheme)
        assert (rows.final_depth, rows.steps) == run_many(*row, 0.9, scheme) == (x, k)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_results_of_many_cases_are_those_of_single_cases(name: str) -> None:
    function = getattr(arrays, name)
    # So many that they are shared among the cores; times and sheets take a hundred times as long.
    is_long = name in ("stop_time", "time_to_depth", "history", "run_many")
    count = 3000 if is_long else 300_000
    columns = [value * np.linspace(1.0, 1.05, count) for value in FUNCTIONS[name]]
    whole = as_tuple(function(*columns))
    some = [0, 1, count // 2 + 50, count - 1]
    for part in as_tuple(function(*(column[some] for column in columns))):
        assert part.shape == (4,)
    for k in some:
        alone = as_tuple(function(*(float(column[k]) for column in columns)))
        assert all(isinstance(value, float | int) for value in alone)
        assert [result[k] for result in whole] == list(alone)


@pytest.mark.parametrize("kind", [np.float64, np.float32, np.longdouble, int, object, ">f8"])
def test_the_fast_path_of_a_history_gives_the_same_results(kind: Any) -> None:
    # A one-dimensional array of doubles takes a fast path; a list, rows and other types do not. The
    # times zero and one second (touch, and long after rest) are exact in every type.
    times = np.array([1.0, 0.0, 1.0], kind)
    short = history(times.astype(float), *CASE)
    for long in (times, times.tolist(), times[::-1]):
        for result, expected in zip(history(long, *CASE), short, strict=True):
            assert result.tolist() == expected.tolist()
    rows = history(np.stack([times, times]), CASE[0], [[CASE[1]], [CASE[1]]], *CASE[2:])
    assert [row.tolist() for row in rows[0]] == [short[0].tolist()] * 2


@pytest.mark.parametrize("name", FUNCTIONS)
def test_bad_elements_are_named_by_index(name: str) -> None:
    function = getattr(arrays, name)
    for place, argument in enumerate(list(inspect.signature(function).parameters)[:7]):
        for bad in (np.nan, np.inf, -1.0):
            values: list[Any] = list(FUNCTIONS[name])
            values[place] = [[values[place], bad]]
            with pytest.raises(ValueError, match=rf"^{argument}\[0, 1\] is {bad}: it must be a"):
                function(*values)
            lines = [
                np.full(3, value) for value in FUNCTIONS[name]
            ]  # these take a path of their own
            lines[place][2] = bad
            with pytest.raises(ValueError, match=rf"^{argument}\[2\] is {bad}: it must be a"):
                function(*lines)
            values[place] = bad
            with pytest.raises(ValueError, match=rf"^{argument} is {bad}: it must be a finite"):
                function(*values)


def test_a_bad_element_of_long_lines_is_named_by_index() -> None:
    lines = [np.full(500_000, value) for value in CASE]  # shared among the cores
    lines[2][400_000] = lines[4][300_000] = -1.0
    with pytest.raises(ValueError, match=r"^resistance\[300000\] is -1.0: it must be a finite"):
        arrays.final_depth(*lines)


INPUT = st.one_of(*(st.floats(-p, p).map(lambda power: 10.0**power) for p in (40, 300)))


@given(st.tuples(INPUT, INPUT, INPUT, INPUT, INPUT))
@settings(max_examples=500, deadline=None)
def test_arrays_accept_the_same_range_as_a_single_impact(case: tuple[float, ...]) -> None:
    def refused(function: Callable[[], Any]) -> bool:
        try:
            function()
        except ValueError:
            return True
        return False

    first = refused(lambda: impact_of(*case, step=1.0))
    assert first == refused(lambda: arrays.final_depth(*case))
    assert first == refused(lambda: arrays.final_depth([case[0]], *case[1:]))
    assert first == refused(lambda: arrays.final_depth(*(np.array([value]) for value in case)))
    if all(1e-40 <= value <= 1e40 for value in case):
        assert not first


@pytest.mark.parametrize("name", replication.__all__)
def test_public_objects_can_be_pickled(name: str) -> None:
    public = getattr(replication, name)
    assert pickle.loads(pickle.dumps(public)) == public


# Containers


@pytest.mark.parametrize("name", FUNCTIONS)
def test_series_and_labeled_and_lazy_arrays(name: str) -> None:
    function: Callable[..., Any] = getattr(arrays, name)
    values = [value * np.linspace(1.0, 1.05, 500) for value in FUNCTIONS[name]]
    index = np.arange(500)[::-1]
    kinds: dict[type, Callable[[Any], Any]] = {
        pd.Series: lambda v: pd.Series(v, index),
        xarray.DataArray: lambda v: xarray.DataArray(v, dims="case"),
        dask.array.Array: lambda v: dask.array.from_array(v, 130),
        xarray.Dataset: lambda v: xarray.DataArray(v, dims="case").chunk(case=130),
    }
    for kind, made in kinds.items():
        last = [column[0] for column in values[1:][-1:]]  # a number, if there is a second input
        columns = values[: len(values) - len(last)]
        results = as_tuple(function(*map(made, columns), *last))
        expected = as_tuple(function(*columns, *last))
        for result, numbers in zip(results, expected, strict=True):
            if kind is xarray.Dataset:
                assert isinstance(result.data, dask.array.Array)
            else:
                assert isinstance(result, kind)
            assert result.dtype == numbers.dtype
            np.testing.assert_array_equal(np.asarray(result), numbers)


def test_results_keep_labels_but_not_units_and_names_of_inputs() -> None:
    velocity = xarray.DataArray([400.0, 500.0], {"case": ["a", "b"]}, name="velocity")
    velocity.attrs["units"] = "m/s"
    with xarray.set_options(keep_attrs=True):
        actual = (arrays.final_depth(velocity, *CASE[1:]), *history(1e-9, velocity, *CASE[1:]))
    for result in actual:
        assert (result.name, result.attrs) == (None, {})
        assert result.case.values.tolist() == ["a", "b"]
    grid = history(xarray.DataArray([1e-9] * 3, dims="time"), velocity, *CASE[1:])
    assert grid[0].dims == ("time", "case")


def test_lazy_arrays_in_any_chunks_and_with_other_arrays() -> None:
    velocity, radius = np.linspace(300, 900, 30), np.linspace(1e-6, 1e-4, 30)
    expected = arrays.final_depth(velocity, radius, *CASE[2:])
    lazy = dask.array.from_array(velocity, 7)
    for another in (radius, dask.array.from_array(radius, 11), radius.tolist()):
        np.testing.assert_array_equal(arrays.final_depth(lazy, another, *CASE[2:]), expected)
    table = arrays.final_depth(lazy[:, None], dask.array.from_array(radius, 4), *CASE[2:])
    assert table.shape == (30, 30)
    np.testing.assert_array_equal(np.diag(table.compute()), expected)


# Threads, processes, and folders that cannot be written to


def test_results_are_the_same_in_threads_and_in_dask() -> None:
    velocities = np.linspace(300, 900, 500_000)
    expected = arrays.final_depth(velocities, *CASE[1:])
    with ThreadPoolExecutor(8) as threads:
        for result in threads.map(lambda _: arrays.final_depth(velocities, *CASE[1:]), range(8)):
            np.testing.assert_array_equal(result, expected)
    lazy = arrays.final_depth(dask.array.from_array(velocities, 125_000), *CASE[1:])
    with dask.config.set(scheduler="threads", num_workers=8):
        np.testing.assert_array_equal(lazy.compute(), expected)


FORKED = """
import os, sys
import numpy as np
from replication.models import arrays
velocities = np.linspace(300, 900, 500_000)
rest = (11e-6, 8900.0, 7850.0, 3.5e9)
whole = arrays.final_depth(velocities, *rest)
child = os.fork()
if child == 0:
    os._exit(0 if (arrays.final_depth(velocities, *rest) == whole).all() else 1)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""


@pytest.mark.skipif("fork" not in get_all_start_methods(), reason="no fork here")
def test_a_forked_process_can_compute() -> None:
    subprocess.run([sys.executable, "-c", FORKED], check=True, timeout=300)


def test_compiled_code_is_cached_until_a_model_changes_or_compiled_anew(tmp_path: Path) -> None:
    copy, home = tmp_path / "replication" / "models", tmp_path / "home"
    shutil.copytree(Path(arrays.__file__).parent, copy, ignore=lambda *_: ["__pycache__"])
    (copy.parent / "__init__.py").touch()
    program = "from replication.models.arrays import final_depth as f; "
    program += f"print(*f([{CASE[0]}], *{CASE[1:]}))"

    def said(**environment: str) -> tuple[str, str]:
        variables = {**os.environ, "PYTHONPATH": str(tmp_path), "PYTHONWARNINGS": "error"}
        variables.pop("NUMBA_CACHE_DIR", None)
        command = [sys.executable, "-B", "-c", program]
        done = subprocess.run(
            command, capture_output=True, env=variables | environment, text=True, cwd=tmp_path
        )
        return done.stdout, done.stderr

    right = depth.final_depth(*CASE)
    assert said() == (f"{right}\n", "")
    assert list((copy / "__pycache__").glob("depth.final_depth*.nbc"))
    source = (copy / "crater.py").read_text("utf-8")
    (copy / "crater.py").write_text(source.replace("return 2 * z", "return 4 * z"), "utf-8")
    assert said() == (f"{2 * right}\n", "")
    shutil.rmtree(copy / "__pycache__")
    (copy / "__pycache__").touch()  # not even root can write there
    home.touch()
    nowhere = str(home / "cache")
    assert said(HOME=nowhere, XDG_CACHE_HOME=nowhere) == (f"{2 * right}\n", "")


TOGETHER = """
import sys
from replication.models import arrays, motion, sheet
for model in (arrays.depth.final_depth, motion.stop_time, motion.time_to_depth)[: int(sys.argv[1])]:
    arrays.ufunc(model)  # so that the processes number their functions differently
case = 500.0, 11e-6, 8900.0, 7850.0, 3.5e9
print(arrays.run_many([500.0, 500.0], *case[1:])[1], arrays.history([0.0, 1.0], *case)[1])
"""


@pytest.mark.slow
def test_processes_that_compile_at_once_share_one_cache(tmp_path: Path) -> None:
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}

    def start(compiled_before: int) -> subprocess.Popen[str]:
        command = [sys.executable, "-c", TOGETHER, str(compiled_before)]
        return subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)

    together = [start(count) for count in range(3)]
    outputs = [process.communicate()[0] for process in together]
    outputs.append(start(0).communicate()[0])  # from the cache
    assert outputs == ["[131 131] [500.   0.]\n"] * 4


@pytest.mark.parametrize(
    ("name", "inputs", "message"),
    [
        ("resistance_for_depth", (3.3e-3, 500.0, 11e-6, 8900.0, 7850.0), None),
        ("resistance_for_depth", (3.3e-6, 500.0, 1e-12, 8900.0, 7850.0), "resistance is 0.0"),
        ("target_density_for_depth", (9e-6, 500.0, 11e-6, 8900.0, 3.5e9), "target density has no"),
        ("final_depth", (500.0, 1e-300, 8900.0, 7850.0, 3.5e9), "particle mass is 0.0"),
        ("final_depth", (500.0, math.nan, 8900.0, 7850.0, 3.5e9), "radius is nan"),
        ("velocity_at_depth", (1.0, 500.0, 11e-6, 8900.0, 7850.0, 3.5e9), "at_depth is 1.0"),
    ],
)  # fmt: skip
def test_plain_numbers_need_no_numpy_even_out_of_range(
    monkeypatch: pytest.MonkeyPatch, name: str, inputs: tuple[float, ...], message: str | None
) -> None:
    function = getattr(replication, name)
    monkeypatch.setitem(sys.modules, "numpy", None)
    if message is None:
        assert function(*inputs) > 0
    else:
        with pytest.raises(ValueError, match=message):
            function(*inputs)


def test_public_names_are_loaded_when_used() -> None:
    program = (
        "import sys, replication\n"
        "assert not [name for name in sys.modules if name.startswith('replication.')]\n"
        "from replication import BETA_5, Impact, final_depth, run\n"
        f"assert final_depth(*{CASE}) == final_depth(**BETA_5.motion)\n"
        "assert run(BETA_5).steps == 131\n"
        "assert not {'numba', 'numpy', 'scipy', 'matplotlib'} & set(sys.modules)\n"
        "from replication import *\n"
        "from replication.audit import verdict\n"
        "assert callable(audit) and replication.audit is audit\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
    assert all(hasattr(replication, name) for name in replication.__all__)
    assert "[Pa]" in str(replication.stop_time.__doc__)
    with pytest.raises(AttributeError, match="no attribute 'final_dept'"):
        replication.final_dept  # noqa: B018
