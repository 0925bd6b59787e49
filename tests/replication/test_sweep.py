"""Sweeps: reading plans, drawing, results, and complete, reproducible files.

Error messages are in `test_refusals.py`.
"""

import csv
import json
import math
import os
import re
import signal
import subprocess
import sys
import termios
import time
from collections.abc import Callable
from pathlib import Path
from textwrap import dedent
from typing import Any

import numpy as np
import pyarrow.parquet
import pytest
from hypothesis import given
from hypothesis import strategies as st
from running import coldspray
from scipy import stats

from replication import sweep
from replication.cases import BETA_5
from replication.models.depth import final_depth, normalized_depth
from replication.models.impact import Impact
from replication.models.motion import stop_time
from replication.models.sheet import run
from spreadsheets.safely import write_bytes

EXAMPLES = Path(__file__).parents[2] / "docs" / "sweeps"
STREAM = """
[sweep]
samples = {samples}
seed = 1
[inputs]
radius = {{ distribution = "lognormal", mean = "11 um", deviation = "2.8 um" }}
velocity = {{ distribution = "normal", mean = "500 m/s", deviation = "50 m/s" }}
"""


def plan_of(folder: Path, text: str) -> sweep.Plan:
    file = folder / "plan.toml"
    file.write_text(text)
    return sweep.read_plan(file)


def all_of(plan: sweep.Plan) -> dict[str, np.ndarray]:
    return sweep.compute(plan, 0, plan.count)


@pytest.mark.parametrize(
    ("inputs", "warning"),
    [
        (
            "radius = 11",
            'radius is 11 m: from 1e-09 to 1 m is expected; did you mean "11 um"?',
        ),
        (
            "velocity = {from=5e5, to=6e5, points=3}",
            "velocity is 500000 m/s: from 1 to 100000 m/s is expected",
        ),
        (
            'radius = {distribution="lognormal", mean="100 um", deviation="300 um"}\n'
            "[sweep]\nsamples = 9\nseed = 1",
            "",
        ),
    ],
)
def test_an_input_that_no_impact_has_is_warned_of(
    inputs: str, warning: str, tmp_path: Path
) -> None:
    (tmp_path / "plan.toml").write_text(f"[inputs]\n{inputs}\n")
    status, _, err = coldspray("sweep", tmp_path / "plan.toml", "-o", tmp_path / "cases.csv")
    expected = f"coldspray sweep: warning: {warning}\n" if warning else ""
    assert (status, err) == (0, expected)


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


PSI = 4.4482216152605 / 0.0254**2
"""1 lbf/in^2 in Pa."""


@pytest.mark.parametrize(
    ("plan", "cases"),
    [
        pytest.param(
            """
            [inputs]
            velocity = ["400 m/s", 500.0]
            radius = {from = "1 um", to = 3e-6, points = 3}
            """,
            {
                "velocity": [400, 400, 400, 500, 500, 500],
                "radius": [1e-6, 2e-6, 3e-6, 1e-6, 2e-6, 3e-6],
                "beta": [5] * 6,
            },
            id="the last input varies fastest",
        ),
        pytest.param(
            """
            [sweep]
            case = "beta-3"
            [inputs]
            radius = "5 um"
            """,
            {"radius": [5e-6], "beta": [3], "velocity": [500], "resistance": [2.1e9]},
            id="another case",
        ),
        pytest.param(
            """
            [inputs]
            resistance = ["98 ksi", 2.1e9]
            """,
            {"resistance": [98e3 * PSI, 2.1e9]},
            id="a resistance",
        ),
        pytest.param(
            "\ufeff[inputs]", {"depth": [final_depth(**BETA_5.motion)]}, id="a byte-order mark"
        ),
        pytest.param(
            """
            [inputs]
            radius = ["5.5 um", "11 um", "22 um"]
            velocity = {average_velocity = "500 m/s", average_mass = 4.96199898868791e-11}
            """,
            {"velocity": [500 * 8**0.5, 500, 500 / 8**0.5]},
            id="Eq. 1: mass goes as the cube of the radius",
        ),
    ],
)
def test_plans_give_the_expected_cases(
    plan: str, cases: dict[str, list[float]], tmp_path: Path
) -> None:
    computed = all_of(plan_of(tmp_path, dedent(plan)))
    for name, values in cases.items():
        assert computed[name].tolist() == pytest.approx(values, rel=1e-15, abs=0)
    assert ("beta" in computed) == ("resistance =" not in plan)


@given(
    first=st.floats(1e-9, 1e9), last=st.floats(1e-9, 1e9), count=st.integers(2, 200),
)  # fmt: skip
def test_ranges_are_those_of_numpy(first: float, last: float, count: int) -> None:
    ends = {"from": str(first), "to": str(last), "points": count}
    for scale, expected in (("linear", np.linspace), ("log", np.geomspace)):
        source = sweep.read_source("radius", {**ends, "scale": scale})
        values = source.at(np.arange(count))
        # The exponent, at most 9, is off by two ulp (4e-15), so the value by ln 10 times that.
        np.testing.assert_allclose(values, expected(first, last, count), rtol=2e-14)
        assert (values[0], values[-1]) == (first, last)
        assert source.bounds == (values.min(), values.max()) == (min(first, last), max(first, last))


# Random numbers


@given(seed=st.integers(0, 2**64 - 1), first=st.integers(0, 10**12), count=st.integers(0, 40))
def test_a_case_has_the_same_random_number_in_any_block(seed: int, first: int, count: int) -> None:
    whole = sweep.uniform(seed, 3, first, count + 7)
    assert (sweep.uniform(seed, 3, first, count) == whole[:count]).all()
    assert (sweep.uniform(seed, 3, first + count, 7) == whole[count:]).all()
    assert ((whole >= sweep.LEAST_SHARE) & (whole <= 1 - sweep.LEAST_SHARE)).all()


def test_random_numbers_of_seeds_and_inputs_are_independent(tmp_path: Path) -> None:
    count = 100_000
    drawn = [sweep.uniform(0, stream, 0, count) for stream in (0, 1)]
    cases = plan_of(tmp_path, STREAM.format(samples=count)).inputs(0, count)
    radius, velocity = law("lognormal", 11e-6, 2.8e-6), law("normal", 500, 50)
    drawn += [radius(cases["radius"]), velocity(cases["velocity"])]  # of seed 1
    # Correlations of independent numbers are normal about 0 with deviation count^(-1/2).
    assert (abs(np.corrcoef(drawn) - np.eye(4)) < 5 / math.sqrt(count)).all()
    # Truly uniform numbers would fail this once in a million times.
    assert all(stats.kstest(shares, "uniform").pvalue > 1e-6 for shares in drawn)


def law(
    kind: str, mean: float, deviation: float, lower: float = 0, upper: float = math.inf
) -> Callable[[Any], Any]:
    """Return the cumulative distribution function of a plan's distribution, by SciPy."""
    sigma = math.sqrt(math.log1p((deviation / mean) ** 2))
    whole = {
        "uniform": lambda: stats.uniform(lower, upper - lower),
        "loguniform": lambda: stats.loguniform(lower, upper),
        "normal": lambda: stats.norm(mean, deviation),
        "lognormal": lambda: stats.lognorm(sigma, scale=mean / math.exp(sigma**2 / 2)),
    }[kind]()
    below, above = whole.cdf([lower, upper])
    return lambda values: (whole.cdf(values) - below) / (above - below)


@given(
    kind=st.sampled_from(["normal", "lognormal", "uniform", "loguniform"]),
    mean=st.floats(1e-6, 1e-4),
    deviation=st.floats(1e-7, 1e-4),
    lower=st.floats(1e-9, 1e-4),
    shares=st.lists(st.floats(sweep.LEAST_SHARE, 1 - sweep.LEAST_SHARE), min_size=2, max_size=20),
)
def test_quantiles_are_those_of_the_distribution_within_its_bounds(
    kind: str, mean: float, deviation: float, lower: float, shares: list[float]
) -> None:
    numbers = {"mean": mean, "deviation": deviation} if "normal" in kind else {}
    ends = {"lower": lower, "upper": lower + 2e-4}
    table = {key: repr(value) for key, value in (numbers | ends).items()}
    try:
        source = sweep.read_source("stop_velocity", {"distribution": kind, **table})
    except ValueError:  # less than a millionth of it would be left
        return
    shares.sort()
    values = source.at(np.array(shares))
    least, greatest = source.bounds
    assert (np.diff(values) >= -1e-14 * values[1:]).all()  # the inverse is correct to 15 digits
    assert ((values >= least) & (values <= greatest)).all()
    assert lower <= least <= greatest <= lower + 2e-4
    # If the bounds leave a millionth of the distribution, an ulp of 1e-16 becomes 1e-10.
    assert law(kind, mean, deviation, **ends)(values) == pytest.approx(shares, abs=1e-9)


# Results


def test_results_are_those_of_single_cases(tmp_path: Path) -> None:
    outputs = 'outputs = ["sheet_steps", "stop_time", "sheet_depth"]\n'
    for text in (
        f"[sweep]\n{outputs}[inputs]\n"
        'velocity = [0.5, 1, 400, 2000]\nradius = ["1 um", "11 um"]\nbeta = [0.01, 5]',
        STREAM.format(samples=f"40\n{outputs}") + "beta = [1, 3, 5]",
    ):
        cases = all_of(plan_of(tmp_path, text))
        assert list(cases)[-3:] == ["stop_time", "sheet_depth", "sheet_steps"]
        assert set(cases["beyond_radius"].tolist()) == {True, False}
        for k in range(len(cases["depth"])):
            given = (name for name in cases if name in Impact.__slots__ and name != "resistance")
            impact = Impact(**{name: float(cases[name][k]) for name in given})
            sheet, others = run(impact), {n: x for n, x in impact.motion.items() if n != "radius"}
            ratio = normalized_depth(**others)
            assert {
                name: cases[name][k] for name in (*sweep.CASE_RESULTS, *sweep.EXTRAS, "resistance")
            } == {
                "depth": final_depth(**impact.motion),
                "normalized_depth": ratio,
                "beyond_radius": ratio > 1,
                "stop_time": stop_time(**impact.motion),
                "sheet_depth": sheet.final_depth,
                "sheet_steps": sheet.steps,
                "resistance": impact.target_resistance,
            }


def test_every_documented_way_to_write_an_input_is_read(tmp_path: Path) -> None:
    manual = (EXAMPLES / "README.md").read_text("utf-8")
    ways = re.findall(r"^\| `(.+?)` \|", manual.partition("optional table")[0], re.MULTILINE)
    assert len(ways) == 6
    for way in ways:
        name = next(name for name in ("average", "um", "") if name in way)
        key = {"average": "velocity", "um": "radius", "": "beta"}[name]
        samples = "samples = 5" if "distribution" in way else ""
        assert plan_of(tmp_path, f"[sweep]\n{samples}\n[inputs]\n{key} = {way}").count >= 1


def test_every_example_runs(tmp_path: Path) -> None:
    examples = sorted(EXAMPLES.glob("*.toml"))
    assert len(examples) >= 4
    for example in examples:
        output = tmp_path / f"{example.stem}.parquet"
        assert coldspray("sweep", example, "-o", output)[::2] == (0, "")
        table = pyarrow.parquet.read_metadata(output)
        assert table.num_rows == sweep.read_plan(example).count


def test_without_pyarrow_a_sweep_says_what_to_install_and_writes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    output = tmp_path / "rows.csv"
    assert coldspray("sweep", EXAMPLES / "figure-5.toml", "-o", output) == (
        2,
        "",
        "coldspray sweep: PyArrow, which writes the rows, is not installed: "
        "python -m pip install 'coldspray[sweep]'\n",
    )
    assert not output.exists()


@pytest.mark.parametrize("suffix", ["csv", "parquet"])
def test_every_run_writes_the_same_bytes_and_parts_make_up_the_whole(
    suffix: str, tmp_path: Path
) -> None:
    plan, told = plan_of(tmp_path, STREAM.format(samples=2 * sweep.BLOCK + 17)), list[int]()
    files = [tmp_path / f"{name}.{suffix}" for name in ("whole", "again", "first", "rest")]
    for file, numbers in zip(files, (None, None, range(1), range(1, 3)), strict=True):
        sweep.write_sweep(plan, file, numbers=numbers, done=told.append)
    assert told == [sweep.BLOCK, sweep.BLOCK, 17] * 3
    contents = [file.read_bytes() for file in files]
    assert contents[0] == contents[1]
    if suffix == "csv":
        assert contents[0] == contents[2] + contents[3].partition(b"\n")[2]
        return
    whole, _, *parts = map(pyarrow.parquet.read_table, files)
    assert pyarrow.concat_tables(parts).equals(whole)
    for first, count in ((0, 1), (299, 3), (17, 583)):  # cases do not depend on their block
        cases = {
            name: column.tolist() for name, column in sweep.compute(plan, first, count).items()
        }
        assert cases == whole.slice(first, count).to_pydict()


@pytest.mark.slow
def test_memory_does_not_grow_with_the_cases(tmp_path: Path) -> None:
    program = (
        "import resource, sys; from replication.cli import main; main(sys.argv[1:]);"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)"
    )
    peaks = []
    for samples in (200_000, 1_200_000):
        plan_of(tmp_path, STREAM.format(samples=samples))
        arguments = ["sweep", tmp_path / "plan.toml", "-o", tmp_path / "o.parquet", "--quiet"]
        done = subprocess.run([sys.executable, "-c", program, *arguments], capture_output=True)
        peaks.append(int(done.stdout))
    # The columns of another million cases would take 96 MB.
    assert peaks[1] < peaks[0] + 50


def test_the_command_writes_units_all_digits_and_provenance(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    file = EXAMPLES / "figure-5.toml"
    plan = sweep.read_plan(file)
    cases = {name: column.tolist() for name, column in all_of(plan).items()}
    assert coldspray("sweep", file) == (0, "Written: figure-5.csv (101 cases)\n", "")
    rows = list(csv.DictReader(Path("figure-5.csv").read_text().splitlines()))
    assert list(rows[0])[:2] == ["velocity [m/s]", "radius [m]"]
    assert list(rows[0])[-3:] == ["beyond_radius", "sheet_depth [m]", "sheet_steps [1]"]
    for name, column in zip(rows[0], cases.values(), strict=True):
        assert [json.loads(row[name]) for row in rows] == column
    assert coldspray("sweep", file, "--quiet") == (0, "", "")
    record = json.loads(coldspray("sweep", file, "--json", "-o", "five.PARQUET")[1])
    assert (record["file"], record["cases"]) == ("five.PARQUET", 101)
    assert record["columns"]["depth"] == "m"
    documented = (EXAMPLES / "README.md").read_text("utf-8")
    assert all(f"`{key}`" in documented for key in record)
    table = pyarrow.parquet.read_table("five.PARQUET")
    assert table.to_pydict() == cases
    fields = {field.name: (str(field.type), field.metadata[b"unit"]) for field in table.schema}
    assert fields["velocity"] == ("double", b"m/s")
    assert fields["normalized_depth"] == ("double", b"1")
    assert fields["beyond_radius"] == ("bool", b"")
    assert fields["sheet_steps"] == ("int64", b"1")
    assert table.schema.metadata[b"sweep_sha256"].decode() == record["sweep_sha256"] == plan.digest
    assert re.fullmatch(rb"\d+\.\d+\.\d+", table.schema.metadata[b"coldspray"])


def command(folder: Path, samples: int) -> list[object]:
    """Write a plan of this many cases and return the command that runs it."""
    plan_of(folder, STREAM.format(samples=samples))
    files = ["sweep", folder / "plan.toml", "-o", folder / "out.csv"]
    return [sys.executable, "-m", "replication", *files]


def test_a_progress_bar_is_shown_on_a_terminal(tmp_path: Path) -> None:
    screen, terminal = os.openpty()
    termios.tcsetwinsize(terminal, (24, 90))
    subprocess.run(command(tmp_path, 100), stdout=-3, stderr=terminal, check=True)
    os.close(terminal)
    assert "100/100" in os.read(screen, 65536).decode()
    os.close(screen)


@pytest.mark.parametrize(
    ("send", "number"),
    [
        (os.killpg, signal.SIGINT),
        pytest.param(os.kill, signal.SIGHUP, marks=pytest.mark.slow),
        (os.kill, signal.SIGTERM),
    ],
)
def test_an_interrupted_sweep_leaves_nothing(
    send: Callable[[int, int], None], number: int, tmp_path: Path
) -> None:
    def listening() -> (
        None
    ):  # a shell's background jobs ignore SIGINT, and those of nohup ignore SIGHUP
        for ignored in (signal.SIGINT, signal.SIGHUP):
            signal.signal(ignored, signal.SIG_DFL)

    process = subprocess.Popen(
        command(tmp_path, 4000 * sweep.BLOCK), stderr=-1, start_new_session=True,
        preexec_fn=listening,
    )  # fmt: skip
    while not any(draft.stat().st_size > 100_000 for draft in tmp_path.glob(".out.csv.*.part")):
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)
    send(process.pid, number)
    _, err = process.communicate(timeout=60)
    assert err == b"coldspray sweep: interrupted; no file is left in part\n"
    assert process.returncode == 128 + number
    assert names(tmp_path) == ["plan.toml"]


def test_a_draft_is_on_the_disk_before_it_is_renamed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    synced: list[list[str]] = []
    monkeypatch.setattr("os.fsync", lambda _: synced.append(names(tmp_path)))
    write_bytes(tmp_path / "out.csv", b"whole")
    assert synced == [[f".out.csv.{os.getpid()}.part"]]
    assert names(tmp_path) == ["out.csv"]


@pytest.mark.slow
def test_dask_writes_the_same_cases(tmp_path: Path) -> None:
    plan = plan_of(tmp_path, STREAM.format(samples=1000))
    sweep.write_sweep(plan, tmp_path / "here.parquet")
    command = [sys.executable, "-W", "error", EXAMPLES / "on_dask.py", tmp_path / "plan.toml"]
    for _ in range(2):  # the second run finds the part of the first
        subprocess.run([*command, tmp_path / "parts"], check=True, capture_output=True)
    (part,) = (tmp_path / "parts" / plan.digest).iterdir()
    assert part.read_bytes() == (tmp_path / "here.parquet").read_bytes()
