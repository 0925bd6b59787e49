"""No input of a user ends in a traceback, a hang or half a file.

`promised` in `running.py` has what is promised. `test_refusals.py` has what is refused, and why.
"""

import json
import os
import re
import resource
import signal
import subprocess
import sys
from contextlib import chdir, suppress
from errno import ENOSPC
from functools import cache, partial
from pathlib import Path
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from running import coldspray, promised, state

from replication.cases import INPUTS
from replication.sweep import read_plan
from spreadsheets.safely import check_folder, draft_of, write_folder

# Random arguments and files


@cache
def flags(command: str) -> list[str]:
    """Return the options of a command, from its help."""
    return sorted(set(re.findall(r"--[a-z-]+", coldspray(command, "--help")[1])))


NUMBERS = st.one_of(
    st.floats().map(repr),
    st.integers().map(str),
    st.sampled_from(
        ["1e308", "5e-324", "-0", "1_0", "0x1", "١", "1e", ".", "∞", "½", "1,5", "--1"]
    ),
)
UNITS = st.sampled_from(
    ["", " ", "um", " m/s", "kg/m^3", " Pa", "ns", "m^9", "%", "dBm", "degC", "µm"]
)
VALUES = st.one_of(
    NUMBERS,
    st.tuples(NUMBERS, UNITS).map("".join),
    st.text(max_size=50),
    st.sampled_from(
        [
            "deep.toml",
            "empty.toml",
            "own.toml",
            "plan.csv",
            "large.toml",
            "loop",
            ".",
            "..",
            "",
            "/dev/zero",
            "beta-3",
            "centered",
        ]
    ),
    st.characters().map(lambda character: character * 1000),
)


@st.composite
def arguments(draw: st.DrawFn, command: str) -> list[str]:
    own = [command]
    for flag in draw(st.lists(st.sampled_from(flags(command)), max_size=4)):
        value = draw(VALUES)
        own += draw(st.sampled_from([[flag, value], [f"{flag}={value}"], [flag], [value]]))
    return own


@pytest.mark.parametrize(
    "command", ["depth", "crater", "solve", "fit", "sheet", "history", "claims"]
)
@given(st.data())
def test_any_arguments(command: str, hostile: Path, data: st.DataObject) -> None:
    """Random arguments, for commands that end soon and write nothing."""
    promised(hostile, *data.draw(arguments(command)))


def toml(value: object) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f'"{k}" = {toml(v)}' for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value, ensure_ascii=False).replace("NaN", "nan").replace("Infinity", "inf")


CHARACTERS = st.characters(exclude_categories=["Cs"])
ATOMS = st.one_of(
    *(st.floats(), st.integers(), st.booleans(), st.text(CHARACTERS, max_size=20)),
    st.tuples(NUMBERS, UNITS).map("".join),
)
KEYS = st.sampled_from([
    *INPUTS, "from", "to", "points", "scale", "distribution", "mean", "deviation", "lower", "upper",
    "average_mass", "average_velocity", "other",
])  # fmt: skip
TREES = st.recursive(
    ATOMS, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=4)
)
DOCUMENTS = st.one_of(
    st.binary(max_size=200),
    st.text(max_size=200).map(lambda text: text.encode("utf-8", "surrogatepass")),
    st.tuples(st.sampled_from(["impact", "inputs"]), st.dictionaries(KEYS, TREES, max_size=4)).map(
        lambda pair: "\n".join([
            f"[{pair[0]}]", *(f"{key} = {toml(value)}" for key, value in pair[1].items()),
        ]).encode()
    ),
)  # fmt: skip


@given(DOCUMENTS)
@example(b"\xef\xbb\xbf[impact]\nradius = 1e-6")
@example(b"[impact]\nradius = " + b"9" * 4299)
def test_any_case_file(hostile: Path, document: bytes) -> None:
    (hostile / "any.toml").write_bytes(document)
    promised(hostile, "depth", "--json", "--case-file", "any.toml")


@given(DOCUMENTS)
def test_any_plan(hostile: Path, document: bytes) -> None:
    (hostile / "any.toml").write_bytes(document)
    try:
        count = read_plan(hostile / "any.toml").count
    except ValueError:
        count = 0
    if count <= 10_000:  # more cases are allowed, but take too long here
        (hostile / "any.csv").unlink(missing_ok=True)
        promised(hostile, "sweep", "any.toml", "-o", "any.csv", "--quiet")


# Full disks and killed runs


LIMITED = partial(resource.setrlimit, resource.RLIMIT_FSIZE, (20_000, 20_000))
"""Limit the size of a process's files [bytes], so that writing fails as on a full disk."""


@pytest.mark.parametrize(
    ("arguments", "target"),
    [
        (["workbook", "--velocity", "500", "--force", "-o", "target.xlsx"], "target.xlsx"),
        (["sweep", "plan.toml", "-o", "target.csv"], "target.csv"),
        (["sweep", "plan.toml", "-o", "new.parquet"], "target.csv"),
        pytest.param(["audit", "--out", "."], "audit.json", marks=pytest.mark.slow),
    ],
    ids=["workbook", "csv", "parquet", "audit"],
)
def test_a_full_disk(arguments: list[str], target: str, tmp_path: Path) -> None:
    plan = "[inputs]\nradius = {from=1e-6, to=2e-6, points=2000}\n"
    (tmp_path / "plan.toml").write_text(plan)
    (tmp_path / target).write_text("as it was")
    before = state(tmp_path)
    # Without -B, Python would leave bytecode cut off at the limit beside our modules, and every
    # later run would end by it.
    command = [sys.executable, "-B", "-m", "replication", *arguments]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, preexec_fn=LIMITED)
    assert (done.returncode, done.stdout) == (2, "")
    assert re.fullmatch(rf"coldspray {arguments[0]}: \S+: File too large\n", done.stderr)
    assert state(tmp_path) == before


def full(monkeypatch: pytest.MonkeyPatch, after: int) -> None:
    """Let the disk be full once this many files have been stored."""
    store, stored = os.fsync, list[int]()

    def fsync(file: int) -> None:
        stored.append(file)
        if len(stored) > after:
            raise OSError(ENOSPC, os.strerror(ENOSPC))
        store(file)

    monkeypatch.setattr(os, "fsync", fsync)


def test_of_two_files_none_is_replaced_if_the_disk_is_full_at_the_second(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rows = Path(__file__).parents[2] / "docs" / "rows.csv"
    (tmp_path / "rows.csv").write_bytes(rows.read_bytes())
    (tmp_path / "a.html").touch()
    (tmp_path / "b.xml").touch()
    full(monkeypatch, after=1)
    _, _, err = promised(tmp_path, "check", "rows.csv", "--html", "a.html", "--junit", "b.xml")
    assert err == "coldspray check: b.xml: No space left on device\n"


@pytest.mark.parametrize(
    ("module", "work", "arguments", "message"),
    [
        ("audit.audit", "audit", ["audit"], "coldspray-audit: this folder cannot be created: "),
        ("audit.audit", "audit", ["audit", "--out", "/proc/no"], "/proc/no: this folder cannot be"),
        (
            "workbook",
            "build_workbook",
            ["workbook"],
            "workbook.xlsx: the current folder was deleted",
        ),
        (
            "workbook",
            "build_workbook",
            ["workbook", "-o", "/proc/no.xlsx"],
            "/proc/no.xlsx: No such file",
        ),
        ("sweep", "write_sweep", ["sweep", "PLAN"], "plan.csv: the current folder was deleted"),
        ("bench.measure", "bench", ["bench", "--out", "b"], "b: this folder cannot be created: "),
        (
            "check.workbook",
            "check_workbook",
            ["check", "x", "--html", "y"],
            "y: the current folder was del",
        ),
        (
            "bench.measure",
            "bench",
            ["bench", "--quick"],
            "Numba cannot compile in a current folder",
        ),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_what_cannot_be_written_is_refused_before_the_work(
    module: str, work: str, arguments: list[str], message: str,
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    """The current folder was deleted; and no file can be created in /proc, not even by root."""
    monkeypatch.setattr(f"replication.{module}.{work}", None)  # calling it is a TypeError
    (tmp_path / "plan.toml").write_text("[inputs]\nradius = 1e-6\n")
    gone = tmp_path / "gone"
    gone.mkdir()
    with chdir(gone):
        gone.rmdir()
        plan = str(tmp_path / "plan.toml")
        status, out, err = coldspray(*[plan if x == "PLAN" else x for x in arguments])
    assert (status, out) == (2, "")
    assert err.startswith(f"coldspray {arguments[0]}: {message}")
    assert err.count("\n") == 1


def test_a_folder_that_was_tried_is_not_left(tmp_path: Path) -> None:
    check_folder(tmp_path / "a" / "b", ["c", "d/e"])
    assert state(tmp_path) == {}


@pytest.mark.parametrize("length", [1, 230, 238, 239, 244, 250, 255])
def test_a_file_whose_name_is_long_is_written(length: int, tmp_path: Path) -> None:
    """A name has up to 255 bytes, and so has that of its draft; what was left of one goes."""
    path = tmp_path / ("ü" * (length // 2) + "n" * (length % 2))
    with suppress(KeyboardInterrupt), draft_of(path) as draft:
        left = draft.with_name(draft.name.replace(f".{os.getpid()}.", ".12."))
        left.write_text("half")
        raise KeyboardInterrupt
    write_folder(tmp_path, {path.name: b"new"})
    assert state(tmp_path) == {path.name: b"new"}


KILLED = """
import os, signal, sys
from pathlib import Path
from spreadsheets.safely import write_bytes, write_folder
left = int(sys.argv[1])
def hook(event, arguments):
    global left
    if event in ("open", "os.rename", "os.mkdir", "os.remove", "os.rmdir"):
        left -= 1
        if left == 0:
            os.kill(os.getpid(), signal.SIGKILL)
sys.addaudithook(hook)
"""
WRITERS = {
    "write_bytes(Path('a'), b'new')": ["a"],
    "write_folder(Path('.'), {'a': b'new', 'b': b'new', 'c/d': b'new'})": ["a", "b", "c/d"],
}


@pytest.mark.parametrize("writer", WRITERS, ids=["file", "folder"])
def test_a_run_that_is_killed_leaves_whole_files(writer: str, tmp_path: Path) -> None:
    """Kill a run at its first file operation, at its second, and so on, until one run completes."""
    (tmp_path / "c").mkdir()
    for moment in range(1, 60):
        for name in WRITERS[writer]:
            (tmp_path / name).write_bytes(b"old")
        command = [sys.executable, "-c", KILLED + writer, str(moment)]
        done = subprocess.run(command, cwd=tmp_path, check=False)
        contents = {(tmp_path / name).read_bytes() for name in WRITERS[writer]}
        if done.returncode == 0:
            break
        assert done.returncode == -signal.SIGKILL
        assert contents <= {b"old", b"new"}
    assert contents == {b"new"}
    assert {name for name in state(tmp_path) if Path(name).parts[0].startswith(".")} == set()
    assert 4 < moment < 59


def test_what_a_killed_run_left_goes_and_nothing_else(tmp_path: Path) -> None:
    own, foreign = ".a.12.part", [".a.part", ".other.12.part", ".as.1.part"]
    for name in (own, *foreign):
        (tmp_path / name).write_text("half")
    write_folder(tmp_path, {"a": b"new"})
    assert {path.name for path in tmp_path.iterdir()} == {"a", *foreign}


def test_a_folder_that_cannot_be_filled_is_as_it_was(tmp_path: Path) -> None:
    with pytest.raises(TypeError):
        write_folder(tmp_path / "out", {"c/d": b"new", "e": None})
    assert state(tmp_path) == {}


def test_of_two_runs_to_one_folder_the_one_that_lost_its_drafts_says_so(tmp_path: Path) -> None:
    class Slow(dict[str, bytes]):
        def items(self) -> Any:
            yield "a", b"slow"
            write_folder(tmp_path, {"a": b"fast"})

    with pytest.raises(OSError, match="another run is writing this file") as lost:
        write_folder(tmp_path, Slow(a=b""))
    assert lost.value.filename == str(tmp_path / "a")
    assert state(tmp_path) == {"a": b"fast"}
