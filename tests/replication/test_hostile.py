"""No input of a user ends in a traceback, a hang or half a file.

The exit status is 0, 1 or 2. At status 2 nothing is printed on standard output, no file is written,
and standard error has one short line without control characters.
"""

import io
import json
import os
import re
import resource
import shlex
import signal
import subprocess
import sys
import zipfile
from contextlib import chdir
from functools import cache, partial
from pathlib import Path
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from kept import spelled
from running import coldspray

from replication.cases import INPUTS
from replication.sweep import read_plan
from spreadsheets.safely import write_folder


def state(folder: Path) -> dict[str, bytes | None]:
    """Return the content of every file in a folder; None for what is not a regular file."""
    return {
        str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None
        for path in folder.rglob("*")
    }


def check(folder: Path, *arguments: str) -> tuple[int, str]:
    """Run a command in a folder, check the promises above, and return its status and its output."""
    before = state(folder)
    with chdir(folder):
        status, out, err = coldspray(*arguments)
    assert status in (0, 1, 2)
    assert "Traceback" not in err
    for line in err.splitlines():
        assert len(line) <= 400
        assert line.isprintable()
    if status == 2:
        assert out == ""
        assert err.endswith("\n")
        assert len(err.splitlines()) == 1
        assert state(folder) == before
    elif arguments[0] != "stability":  # some of its cases have such numbers
        assert not re.search(r"\b(?:nan|inf(?:inity)?)\b", out.lower())
    return status, err + out


SAID = Path(__file__).with_name("said.txt").read_text("utf-8")
EXAMPLES = [part.splitlines() for part in re.sub("\n+#.*", "", SAID).split("\n$ coldspray")[1:]]


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda lines: lines[0])
def test_what_the_commands_say(example: list[str], folder: Path) -> None:
    command, *said = example
    if refused := "".join(said[-1:]).startswith("coldspray"):
        case, said = said[:-1], said[-1:]
        (folder / "case.toml").write_text(spelled("\n".join(case)), "utf-8")
    status, text = check(folder, *shlex.split(spelled(command)))
    assert status == 2 * refused
    printed = "\n".join(line.rstrip() for line in text.splitlines())
    assert re.fullmatch(re.escape("\n".join(said)).replace(r"\.\.\.", ".*"), printed)


# Files for the commands

FILES = {
    "deep.toml": "[impact]\nradius = " + 5000 * "[",
    "empty.toml": "",
    "own.toml": '[impact]\nvelocity = 450\nradius = "22 um"\nbeta = 3.0\n',
    "plan.csv": "[inputs]",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    own = tmp_path_factory.mktemp("hostile")
    for name, text in FILES.items():
        (own / name).write_text(text, "utf-8")
    (own / "large.toml").write_bytes(b"#" * (2**20 + 1))
    (own / "binary.toml").write_bytes(b"\xff\xfe\0")
    (own / "loop.xlsx").symlink_to("loop.xlsx")
    (own / "loop.toml").symlink_to("loop.toml")
    (own / "loop").symlink_to("loop")
    (own / "link.xml").symlink_to("own.xlsx")
    os.mkfifo(own / "pipe.csv")
    with chdir(own):
        assert coldspray("workbook", "--velocity", "500", "--quiet", "-o", "own.xlsx")[0] == 0
    # Broken copies of that workbook: cut off, with entities or deep nesting, or expanding too far.
    whole = (own / "own.xlsx").read_bytes()
    (own / "zero.xlsx").write_bytes(b"")
    (own / "cut.xlsx").write_bytes(whole[: len(whole) // 2])
    with zipfile.ZipFile(own / "nothing.xlsx", "w"):
        pass
    entity = b'<!DOCTYPE a [<!ENTITY b "' + b"c" * 100 + b'">]><a>' + b"&b;" * 100 + b"</a>"
    parts = zipfile.ZipFile(io.BytesIO(whole))
    for name, content, times in (
        ("entity.xlsx", entity, 1),
        ("deep.xlsx", 100_000 * b"<a>", 1),
        ("bomb.xlsx", b" " * 2**19, 1000),
    ):
        with zipfile.ZipFile(own / name, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            for part in parts.namelist():
                sheet = part == "xl/worksheets/sheet1.xml"
                with archive.open(part, "w") as file:
                    file.writelines([content] * times if sheet else [parts.read(part)])
    return own


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
        [*FILES, "large.toml", "loop", ".", "..", "", "/dev/zero", "beta-3", "centered"]
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


@pytest.mark.parametrize("command", ["depth", "sheet", "history", "claims"])
@given(st.data())
def test_any_arguments(command: str, folder: Path, data: st.DataObject) -> None:
    """Random arguments, for commands that end soon and write nothing."""
    check(folder, *data.draw(arguments(command)))


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
def test_any_case_file(folder: Path, document: bytes) -> None:
    (folder / "any.toml").write_bytes(document)
    check(folder, "depth", "--json", "--case-file", "any.toml")


@given(DOCUMENTS)
def test_any_plan(folder: Path, document: bytes) -> None:
    (folder / "any.toml").write_bytes(document)
    try:
        count = read_plan(folder / "any.toml").count
    except ValueError:
        count = 0
    if count <= 10_000:  # more cases are allowed, but take too long here
        (folder / "any.csv").unlink(missing_ok=True)
        check(folder, "sweep", "any.toml", "-o", "any.csv", "--quiet")


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
    command = [sys.executable, "-m", "replication", *arguments]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, preexec_fn=LIMITED)
    assert (done.returncode, done.stdout) == (2, "")
    assert re.fullmatch(rf"coldspray {arguments[0]}: \S+: File too large\n", done.stderr)
    assert state(tmp_path) == before


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
