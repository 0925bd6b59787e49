"""A signal to end the program is neither lost nor met by a traceback, whenever it comes."""

import os
import random
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from reference.signals import postponed_signals
from replication.bench.measure import _next
from replication.models import arrays, estimates


@pytest.fixture
def interruptible() -> Iterator[None]:
    """Let SIGINT interrupt, which is ignored where the tests run in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def swallowed(*_: Any) -> Any:
    """Interrupt, and catch the interruption, as compilers do in code that C calls."""
    try:
        signal.raise_signal(signal.SIGINT)
    except KeyboardInterrupt:
        return "never told"
    return "told later"


def test_a_signal_waits_for_the_end_of_the_block(interruptible: None) -> None:
    done = []
    with pytest.raises(KeyboardInterrupt), postponed_signals():
        done.append(swallowed())
    assert done == ["told later"]


def test_a_signal_that_is_ignored_stays_ignored() -> None:
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with postponed_signals():
            signal.raise_signal(signal.SIGINT)
        assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_signal_while_a_model_is_compiled_acts_afterwards(
    interruptible: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(arrays, "_compiled", swallowed)
    arrays.compiled.cache_clear()
    with pytest.raises(KeyboardInterrupt):
        arrays.compiled(estimates.goodier_beta)
    arrays.compiled.cache_clear()


def test_a_signal_during_a_turn_of_the_bench_acts_afterwards(interruptible: None) -> None:
    with pytest.raises(KeyboardInterrupt):
        _next(swallowed() for _ in range(1))


INTERRUPTED_IMPORT = """
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
class Finder:
    def find_spec(self, name, *_):
        if name == sys.argv[1]:
            signal.raise_signal(signal.SIGINT)
sys.meta_path.insert(0, Finder())
from replication.__main__ import program
sys.exit(program())
"""


@pytest.mark.parametrize("module", ["reference.signals", "replication.cli", "argparse"])
def test_a_signal_during_the_imports_is_one_line(module: str) -> None:
    command = [sys.executable, "-c", INTERRUPTED_IMPORT, module]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (
        130,
        "",
        "coldspray: interrupted; no file is left in part\n",
    )


PLAN = """
[sweep]
outputs = ["sheet_depth"]
[inputs]
radius = {from = "1 um", to = "11 um", points = 200}
"""


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
@pytest.mark.parametrize(
    "arguments",
    [["sweep", "plan.toml"], ["bench", "--quick", "--limit", "0.01 s", "--out", "out"]],
    ids=["sweep", "bench"],
)
def test_a_signal_at_any_moment_of_a_run_that_compiles_ends_it(
    arguments: list[str], number: int, tmp_path: Path
) -> None:
    """The cache of compiled code is empty.

    On a busy machine a signal may still come before the program awaits it, and then kills it.
    """
    chance = random.Random(f"{arguments[0]} {number}")
    for turn in range(4):
        folder = tmp_path / str(turn)
        folder.mkdir()
        (folder / "plan.toml").write_text(PLAN)
        running = subprocess.Popen(
            [sys.executable, "-m", "replication", *arguments], cwd=folder, text=True,
            env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / f"cache {turn}")},
            stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            preexec_fn=partial(signal.signal, number, signal.SIG_DFL),
        )  # fmt: skip
        try:
            running.wait(chance.uniform(1, 6))
        except subprocess.TimeoutExpired:
            running.send_signal(number)
        _, errors = running.communicate()
        left = {path.name for path in folder.iterdir()}
        if running.returncode == 0:  # it was done before
            assert errors == ""
        elif running.returncode == -number:
            assert (errors, left) == ("", {"plan.toml"})
        else:
            assert running.returncode == 128 + number
            assert re.fullmatch(r"coldspray( \w+)?: interrupted; no file is left in part\n", errors)
            assert left == {"plan.toml"}


# A cache of compiled code that is damaged


@pytest.mark.parametrize(
    "damage", [lambda _: b"", lambda content: content[:-100]], ids=["empty", "cut"]
)
@pytest.mark.parametrize("ending", ["nbi", "nbc"])
def test_a_damaged_cache_is_compiled_anew(
    ending: str, damage: Callable[[bytes], bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import numba

    def betas() -> list[float]:
        arrays.compiled.cache_clear()
        values: list[float] = arrays.compiled(estimates.goodier_beta).ufunc([1.0, 2.0]).tolist()
        return values

    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    expected = betas()
    (file,) = tmp_path.rglob(f"*.{ending}")
    damaged = damage(file.read_bytes())
    file.write_bytes(damaged)
    assert betas() == expected
    assert file.stat().st_size > len(damaged)
    arrays.compiled.cache_clear()
