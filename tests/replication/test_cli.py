"""The command line: what it prints, where, and with which exit status."""

import argparse
import csv
import io
import json
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from running import coldspray
from workbooks import Fake, rewritten, stored

from replication import workbook
from replication.audit.record import Record
from replication.cli import COMMANDS, main
from replication.cli.parser import parse_command_line
from replication.report.document import schema_text
from spreadsheets.engines import Engine


@pytest.mark.parametrize(
    ("arguments", "keys"),
    [
        (["depth"], {"inputs", "depth", "normalized_depth", "beyond_radius"}),
        (["sheet"], {"inputs", "rows", "final_depth", "normalized_depth", "steps"}),
        (["history"], {"inputs", "time", "depth", "velocity", "stop_time"}),
        (
            ["converge", "--digits", "3"],
            {"inputs", "levels", "limit", "exact", "exact_at_stop", "digits"},
        ),
        (
            ["solve", "velocity", "--depth", "3.3 um"],
            {"inputs", "quantity", "value", "interval", "depth", "normalized_depth", "condition"},
        ),
        (["stability", "--random", "500"], {"cases", "random"}),
        (
            ["claims", "depth-beta-5"],
            {"id", "where", "printed", "unit", "interval", "computed", "enclosure", "verdict"}
            | {"assumes", "explanation"},
        ),
        (["claims", "eq16"], {"id", "where", "text", "verdict", "constants", "explanation"}),
        (
            ["power", "--sample", "1"],
            {"seed", "planted", "invisible", "visible", "detected", "accused_wrongly", "repaired"}
            | {"repaired_first", "by_kind", "by_edit", "unnoticed"},
        ),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_json_is_one_document_with_the_promised_keys(arguments: list[str], keys: set[str]) -> None:
    status, out, err = coldspray(*arguments, "--json")
    assert (status, err) == (0, "")
    assert keys <= set(json.loads(out))


@pytest.mark.parametrize(
    ("arguments", "name", "keys"),
    [
        (
            ["sheet"],
            "rows",
            {"time", "velocity_initial", "depth", "deceleration", "velocity_final"},
        ),
        (["converge"], "levels", {"step", "steps", "depth", "error", "order"}),
    ],
    ids=["sheet", "converge"],
)
def test_every_row_of_the_json_has_the_promised_keys(
    arguments: list[str], name: str, keys: set[str]
) -> None:
    rows = json.loads(coldspray(*arguments, "--json")[1])[name]
    assert all(keys <= set(row) for row in rows)


def test_the_first_level_has_no_order() -> None:
    assert json.loads(coldspray("converge", "--json")[1])["levels"][0]["order"] is None


def both(*arguments: object) -> tuple[dict[str, Any], list[dict[str, str]]]:
    """Return the JSON document that a command prints, and the rows of its CSV."""
    rows = csv.DictReader(coldspray(*arguments, "--csv")[1].splitlines())
    return json.loads(coldspray(*arguments, "--json")[1]), list(rows)


def test_csv_is_the_json_with_all_digits() -> None:
    record, rows = both("sheet")
    assert [float(row["depth"]) for row in rows] == [row["depth"] for row in record["rows"]]
    record, rows = both("history", "--points", 5)
    for name in ("time", "depth", "velocity"):
        assert [float(row[name]) for row in rows] == record[name]
        assert len(record[name]) == 5
    assert record["time"][-1] == record["stop_time"]
    assert record["velocity"][0] == 500.0
    record, rows = both("converge", "--levels", 3)
    assert [float(row["error"]) for row in rows] == [level["error"] for level in record["levels"]]
    assert float(rows[0]["stop_rule"]) == record["levels"][0]["budget"]["stop_rule"]


REFUSED_SETTINGS = {
    "NUMBA_DISABLE_JIT=1": (
        "coldspray sweep: arrays need Numba's compiler: unset NUMBA_DISABLE_JIT\n"
    ),
    "NUMBA_NUM_THREADS=abc": (
        "coldspray sweep: Environment variable 'NUMBA_NUM_THREADS' is defined but its "
        "associated value 'abc' could not be parsed. Correct or unset it\n"
    ),
    "NUMBA_NUM_THREADS=0": (
        "coldspray bench: an environment variable NUMBA_...: Number of threads specified must be "
        "> 0. Correct or unset it\n"
    ),
}
"""What is said of settings of Numba's that it cannot use; the reasons are its own."""


@pytest.mark.parametrize(
    ("setting", "arguments"),
    [
        ("PYTHONIOENCODING=cp1252", "claims a1-density --json"),
        ("NUMBA_DISABLE_JIT=1", "sweep plan"),
        ("NUMBA_NUM_THREADS=abc", "sweep plan"),
        ("NUMBA_NUM_THREADS=0", "bench"),
    ],
)
def test_the_surroundings_change_no_promise(setting: str, arguments: str, tmp_path: Path) -> None:
    """JSON is UTF-8 in any locale; settings with which Numba cannot compile are named in a line."""
    (tmp_path / "plan").write_text("[inputs]\nvelocity = [400.0, 500.0]\n")
    name, value = setting.split("=")
    command = [sys.executable, "-m", "replication", *arguments.split()]
    done = subprocess.run(
        command, cwd=tmp_path, env=os.environ | {name: value}, capture_output=True, check=False
    )
    if arguments.startswith("claims"):
        json.loads(done.stdout.decode("utf-8"))
        assert b"\\u00" in done.stdout
    else:
        assert done.returncode == 2
        assert done.stderr.decode() == REFUSED_SETTINGS[setting]


def test_a_write_protected_file_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Replacing it would take only permission to write to its folder."""
    plan, output = tmp_path / "plan.toml", tmp_path / "cases.csv"
    plan.write_text("[inputs]\nvelocity = 500.0\n")
    output.write_text("kept")
    # Root may write to any file.
    monkeypatch.setattr(os, "access", lambda path, _: Path(path) != output)
    status, _, err = coldspray("sweep", plan, "-o", output)
    assert (status, output.read_text()) == (2, "kept")
    assert err == f"coldspray sweep: {output}: is write-protected\n"


def test_claims_are_listed() -> None:
    heads, *listing = coldspray("claims")[1].splitlines()
    records = json.loads(coldspray("claims", "--json")[1])
    assert heads.split() == ["id", "printed", "kind", "line"]
    assert [line.split()[0] for line in listing] == [record["id"] for record in records]


@pytest.mark.parametrize(
    ("typed", "same"), [("7,67", "7.67"), ("Eq. 16", "eq16"), ("eq A-3", "eqA-3")]
)
def test_a_claim_or_equation_is_named_as_people_write_it(typed: str, same: str) -> None:
    status, out, err = coldspray("claims", typed)
    assert (status, err) == (0, "")
    assert out == coldspray("claims", same)[1]


@pytest.mark.parametrize("command", COMMANDS)
def test_the_example_of_the_help_is_accepted_and_its_files_are_there(command: str) -> None:
    program, name, *arguments = shlex.split(COMMANDS[command].EXAMPLE)
    assert (program, name) == ("coldspray", command)
    assert parse_command_line(COMMANDS, [name, *arguments]).command == command
    for argument in arguments:
        assert not argument.startswith("docs/") or (Path(__file__).parents[2] / argument).exists()


@pytest.mark.parametrize(
    ("encoding", "newline", "columns"), [("utf-8", "\n", "80"), ("cp1252", "\r\n", "20")]
)
def test_the_schema_is_the_same_bytes_everywhere(
    encoding: str, newline: str, columns: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is a file of ASCII, so that neither Python's version nor an encoding changes it."""
    printed = io.BytesIO()
    monkeypatch.setenv("COLUMNS", columns)
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(printed, encoding, newline=newline))
    assert main(["audit", "--schema"]) == 0
    assert printed.getvalue() == schema_text().encode("ascii")


def test_audit_writes_its_files_and_a_summary_of_one_screen(
    tmp_path: Path, record: Record, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "new" / "out"
    status, out, err = coldspray("audit", "--out", folder)
    assert (status, err) == (0, "")
    names = {path.name for path in folder.iterdir()}
    assert names == {
        "audit.json", "audit.html", "audit.md", "audit.csv", "workbook.xlsx", "hard-cases.txt",
        "figures",
    }  # fmt: skip
    assert len(out.splitlines()) <= 46
    assert "3 not reproduced" in out
    ending = " ".join(out.split())
    assert ending.endswith("Eq. 16 as printed is too small by a factor of 2.")  # the headline
    assert "audit.html" in out
    assert "\x1b" not in out
    monkeypatch.setattr("replication.audit.audit.audit", lambda progress: record)
    status, out, _ = coldspray("audit", "--out", folder, "--exit-code", "--json")
    assert status == 1
    assert json.loads(out) == json.loads((folder / "audit.json").read_text("utf-8"))
    (folder / "workbook.xlsx").write_text("changed")
    assert coldspray("audit", "--out", folder)[0] == 2
    assert (folder / "workbook.xlsx").read_text() == "changed"
    assert coldspray("audit", "--out", folder, "--quiet", "--force") == (0, "", "")


def test_a_closed_pipe_is_no_error() -> None:
    """Its status is none of the program's own: what was not read might have been a difference."""
    process = [sys.executable, "-m", "replication", "sheet", "--step", "1e-12", "--csv"]
    buffered = {**os.environ, "PYTHONUNBUFFERED": ""}  # or Python drops what the pipe does not take
    with subprocess.Popen(process, stdout=-1, stderr=-1, text=True, env=buffered) as running:
        assert running.stdout is not None
        assert running.stderr is not None
        assert running.stdout.readline().startswith("time,")
        running.stdout.close()
        assert running.stderr.read() == ""
    assert running.returncode == 128 + 13


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize(
    ("stream", "arguments"),
    [("stdout", arguments) for arguments in ("--help", "--version", "depth --help", "depth")]
    + [("stderr", arguments) for arguments in ("depth --velocity x", "check nothing.xlsx")],
)
def test_a_full_disk_gets_one_line_and_status_2(
    stream: str, arguments: str, unbuffered: str
) -> None:
    """The status also holds if standard error cannot be written."""
    command = [sys.executable, "-m", "replication", *arguments.split()]
    environment = {**os.environ, "PYTHONUNBUFFERED": unbuffered}
    with Path("/dev/full").open("w") as full:
        streams: dict[str, Any] = {"stdout": -1, "stderr": -1, stream: full}
        done = subprocess.run(command, **streams, text=True, env=environment, check=False)
    assert done.returncode == 2
    if stream == "stdout":
        assert re.fullmatch(r"coldspray( depth)?: No space left on device\n", done.stderr)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_a_warning_that_cannot_be_written_changes_no_result(unbuffered: str) -> None:
    command = [sys.executable, "-m", "replication", "depth", "--velocity", "1e-4"]
    environment = {**os.environ, "PYTHONUNBUFFERED": unbuffered}
    warned = subprocess.run(command, capture_output=True, text=True, check=True)
    assert warned.stderr.startswith("coldspray depth: warning: --velocity is 0.0001 m/s")
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            command, stdout=-1, stderr=full, text=True, env=environment, check=False
        )
    assert (done.returncode, done.stdout) == (0, warned.stdout)


def test_the_version() -> None:
    assert re.fullmatch(r"coldspray \d+\.\d+\.\d+\n", coldspray("--version")[1])


def test_without_arguments_the_help_lists_every_command() -> None:
    status, out, err = coldspray()
    assert (status, err) == (0, "")
    assert out == coldspray("--help")[1]
    assert re.findall(r"^    (\w+)", out, re.M) == list(COMMANDS)


@pytest.mark.parametrize("command", COMMANDS)
def test_help_ends_with_an_example_that_the_command_reads(command: str) -> None:
    out = coldspray(command, "--help")[1]
    example = out.partition("\nexample: ")[2]
    program, *arguments = shlex.split(example)
    assert program == "coldspray"
    assert parse_command_line(COMMANDS, arguments).command == command
    assert "--json" in out


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_takes_quiet(command: str) -> None:
    parser = argparse.ArgumentParser()
    COMMANDS[command].add_options(parser)
    assert "--quiet" in parser._option_string_actions


@pytest.mark.parametrize(
    ("command", "acts"),
    [
        ("depth", False),
        ("solve", False),
        ("history", False),
        ("sheet", True),
        ("converge", True),
    ],
)
def test_help_lists_only_inputs_that_act(command: str, acts: bool) -> None:
    """Depth and history do not step in time. They still take a step, to be called as others are."""
    out = coldspray(command, "--help")[1]
    assert "--radius X" in out
    assert "(beta-5: 1.1e-05)" in out
    for option in ("--step X", "--stop-velocity X"):
        assert (option in out) is acts
    assert coldspray("depth", "--step", "1 ns")[0] == 0


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (
            ["depth", "--step", "1 ns", "--step", "2 ns"],
            "coldspray depth: argument --step: it is given twice (see coldspray depth --help)",
        ),
        (
            ["sheet", "--json", "--json"],
            "coldspray sheet: argument --json: it is given twice (see coldspray sheet --help)",
        ),
        (
            ["sweeep", "x.toml"],
            "coldspray: there is no command 'sweeep': did you mean sweep? (see coldspray --help)",
        ),
        (
            ["depth", "--velocty", "450"],
            "coldspray depth: unrecognized arguments: --velocty 450; did you mean --velocity? "
            "(see coldspray depth --help)",
        ),
        (
            ["depth", "--radius", "11 Um"],
            "coldspray depth: --radius: unknown unit 'Um': did you mean um?",
        ),
        (
            ["claims", "depth-bta-5"],
            "coldspray claims: there is no claim 'depth-bta-5', and none prints that; did you mean "
            "depth-beta-5 or depth-beta-3 or depth-beta-5-beta?",
        ),
        (
            ["claims", "eq16", "--verdict", "reproduced"],
            "coldspray claims: --verdict selects from a list: leave it out to prove eq16",
        ),
        (
            ["claims", "--verdict", "wrong"],
            "coldspray claims: argument --verdict: there is no verdict 'wrong': choose one of "
            "reproduced, reproduced within input rounding, not reproduced, undecided, consistent, "
            "inconsistent, agrees with public sources, differs from public sources, remark, "
            "quantified, not checkable (see coldspray claims --help)",
        ),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_what_was_probably_meant(arguments: list[str], line: str) -> None:
    assert coldspray(*arguments) == (2, "", f"{line}\n")


@pytest.fixture
def terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take stdout for a terminal of 80 columns."""
    monkeypatch.setattr("replication.cli.output.is_terminal", lambda: True)
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.delenv("NO_COLOR", raising=False)


@pytest.mark.usefixtures("terminal")
def test_verdicts_are_coloured_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    out = coldspray("claims", "eq16")[1]
    assert "Eq. 16: \x1b[31mnot reproduced\x1b[0m\n" in out
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b" not in coldspray("claims", "eq16")[1]


@pytest.mark.usefixtures("terminal")
@pytest.mark.parametrize(
    "arguments",
    [
        ["converge"],
        ["sheet", "--step", "4 ns"],
        ["depth", "--models", "--particle-strength", "90 MPa"],
        ["solve", "target-density", "--depth", "9 um", "--rounded"],
        ["history", "--points", "3"],
        ["claims"],
        ["claims", "eq16"],
        ["claims", "frank-zook-rha"],
        ["power", "--sample", "1"],
        ["stability", "--random", "10"],
        pytest.param(["bench", "--quick", "--limit", "1 ms", "--quiet"], marks=pytest.mark.slow),
    ],
    ids=" ".join,
)
def test_a_terminal_of_80_columns_breaks_no_line(arguments: list[str]) -> None:
    out = re.sub(r"\x1b\[\d+m", "", coldspray(*arguments)[1])
    assert max(map(len, out.splitlines())) <= 80


@pytest.mark.usefixtures("terminal")
def test_nearly_every_claim_takes_one_line_of_80_columns() -> None:
    rows = len(json.loads(coldspray("claims", "--json")[1]))
    assert len(coldspray("claims")[1].splitlines()) < 1.1 * rows


@pytest.mark.usefixtures("terminal")
def test_no_id_is_broken_on_a_terminal_of_80_columns(record: Record) -> None:
    """The table of misprints has whole equations in it: too wide, it becomes a list."""
    out = coldspray("claims", "eq16")[1]
    for repair in record.equations[16].repairs:
        for name in repair.failing:
            assert f"({name})" in out


# `coldspray workbook`

Run = Callable[..., tuple[int, str, str]]
OWN = ("--step", "1 ns")
"""A case that is not the report's: its workbook needs no audit, and few rows."""


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Run:
    monkeypatch.chdir(tmp_path)
    return lambda *arguments: coldspray("workbook", *arguments)


def test_it_writes_over_its_own_file_only(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "workbook.xlsx"
    assert run(*OWN)[:2] == (0, "Written: workbook.xlsx\n")
    first = path.read_bytes()
    assert run("--step", "2 ns")[0] == 0  # it is coldspray's own file, though of another case
    assert path.read_bytes() != first
    whole = path.read_bytes()
    assert rewritten(whole, lambda _, part: part) == whole  # so only the seal can tell
    for content in (
        rewritten(whole, lambda _, part: part.replace(b"<v>2.0</v>", b"<v>2.1</v>")),
        rewritten(whole, lambda _, part: part.replace(b'width="8.7', b'width="9.7')),
        rewritten(whole, lambda _, part: part.replace(b"coldspray-sha256", b"coldspray-sha257")),
        whole[: len(whole) // 2],
        b"notes",
        b"",
    ):
        assert content != whole
        path.write_bytes(content)
        for more in ((), ("--verify",)):
            status, out, err = run(*OWN, *more)
            assert (status, out) == (2, "")
            assert "workbook.xlsx: this file is not as coldspray wrote it" in err
            assert err.count("\n") == 1
            assert path.read_bytes() == content
    assert run(*OWN, "--force")[0] == 0
    assert path.read_bytes() == first


def test_a_longer_sheet_as_the_sheet_advises(run: Run, tmp_path: Path) -> None:
    run(*OWN, "--beta", "4")
    cells = stored(tmp_path / "workbook.xlsx")["Sheet beta 4"]
    said = " ".join(str(cells.get(f"A{row}", "")) for row in range(4, 8)).strip()
    assert said.endswith("prepares N, up to 20000, with the same options and --rows N.")
    assert run(*OWN, "--beta", "4", "--rows", "300", "-o", "longer.xlsx")[0] == 0
    longer = tmp_path / "longer.xlsx"
    assert len(stored(longer, formulas=True)["Sheet beta 4"]) > 300 * 7
    depth = workbook.build_workbook(workbook.BETA_5).plan.where["depth_um"][1]
    assert stored(longer)["Sheet beta 4"][depth] == cells[depth]


def deeper(sheet: str, address: str, value: Any) -> Any:
    """Return the value of an engine that adds 1e-12 to the depths in column D of the sheet."""
    depth = sheet == "Sheet beta 5" and address.startswith("D") and isinstance(value, float)
    return value + 1e-12 if depth else value


@pytest.mark.slow
def test_a_workbook_verifies_in_every_engine(run: Run) -> None:
    """The report's workbook is verified cell by cell in `tests/spreadsheets/test_workbook.py`."""
    unverified = json.loads(run("--json", "-o", "report.xlsx")[1])
    assert unverified["file"] == "report.xlsx"
    assert (unverified["passed"], unverified["engines"]) == (None, [])
    assert unverified["warnings"] == []  # that its last steps end below zero is expected
    status, out, _ = run("--verify", "--json", *OWN)
    record = json.loads(out)
    assert (status, record["passed"]) == (0, True)
    assert 1e-15 < record["long_double_bound"] < 1e-12
    outcomes = {result["engine"]: result["outcome"] for result in record["engines"]}
    assert list(outcomes) == ["ironcalc", "formualizer", "libreoffice", "gnumeric"]
    assert outcomes["ironcalc"] == outcomes["formualizer"] == "verified"
    for result in record["engines"]:
        assert result["wrong"] == []
        assert result["outcome"] == "missing" or result["cells"] > 1000


def test_a_line_for_each_engine_and_status_1_for_differences_and_echoes(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def check(engines: list[Engine], *options: str) -> tuple[int, str, str]:
        monkeypatch.setattr("spreadsheets.engines.ENGINES", tuple(engines))
        return run("--verify", *OWN, *options)

    right, absent, echo = Fake(), Fake(reason="Absent: install it."), Fake(told=lambda *_: 41.0)
    broken = Fake(failure="out of luck")
    status, out, err = check([right, absent])
    assert (status, err) == (0, "")
    assert out.startswith("Written: workbook.xlsx\n\nengine ")
    assert out.endswith("1 of 1 engines on this machine give the values of the workbook\n")
    status, more, _ = check([Fake(deeper), echo, broken, right])
    assert status == 1
    for line in (
        r"fake 1\.0 +verified +\d\.\d\d +\d{4} +\d+ +0",
        r"fake +missing +0 +0 +0",
        "fake: Absent: install it[.]",
        r"fake 1\.0 +differs .*",
        r"fake: Sheet beta 5!D\d+: expected \S+, found \S+",
        r"fake: and \d+ more",
        r"fake 1\.0 +echoes +0 +0 +0",
        "fake: It verifies nothing: it gives stored values back, right or wrong[.]",
        r"fake 1\.0 +failed +0 +0 +0",
        "fake: out of luck",
        "1 of 4 engines on this machine give the values of the workbook",
    ):
        assert re.search(f"^{line}$", out + more, re.M), line
    status, out, _ = check([Fake(deeper)], "--json")
    (result,) = json.loads(out)["engines"]
    assert (status, len(result["wrong"]) > 20) == (1, True)
    assert set(result["wrong"][0]) == {"sheet", "cell", "expected", "found"}
    assert check([echo], "--quiet") == check([broken], "--quiet") == (1, "", "")
