"""`coldspray workbook --verify`: a table or one JSON document, and a status that can be trusted."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from replication import workbook
from replication.cli import main
from spreadsheets.engines import Engine, engine
from spreadsheets.engines.base import Cell, Value

Run = Callable[..., tuple[int, str, str]]


@dataclass
class Fake(Engine):
    """IronCalc, but that it adds to the depths (column D of the sheet), or cannot be used."""

    added: float = 0.0
    echoes: bool = False
    reason: str | None = None
    name = "fake"

    def missing(self) -> str | None:
        return self.reason

    def _version(self) -> str:
        return "1.0"

    def _cells(self, path: Path) -> Iterator[Cell]:
        for sheet, cells in engine("ironcalc").recalculate(path).items():
            for address, value in cells.items():
                yield sheet, address, self._told(sheet, address, value)

    def _told(self, sheet: str, address: str, value: Value) -> Value:
        if sheet == "planted" and self.echoes:
            return 41.0
        depth = sheet == "Sheet" and address.startswith("D") and isinstance(value, float)
        return value + self.added if depth else value


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Run:
    """Return a function that runs the command with other engines than those of this machine."""
    monkeypatch.chdir(tmp_path)

    def command(engines: list[Engine], *options: str) -> tuple[int, str, str]:
        monkeypatch.setattr(workbook, "ENGINES", tuple(engines))
        status = main(["workbook", "--verify", "--step", "1 ns", *options])
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return command


def test_report_verifies_in_every_engine(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "report.xlsx"
    assert main(["workbook", "--verify", "--json", "-o", str(path)]) == 0
    record = json.loads(capsys.readouterr().out)
    assert path.exists()
    assert (record["file"], record["passed"]) == (str(path), True)
    outcomes = {found["engine"]: found["outcome"] for found in record["engines"]}
    assert list(outcomes) == ["ironcalc", "formualizer", "libreoffice", "gnumeric"]
    assert outcomes["ironcalc"] == outcomes["formualizer"] == "verified"
    for found in record["engines"]:
        for sheet in found["sheets"]:
            assert sheet["unexplained"] == []
            assert sheet["differ"] == sheet["explained"] + sheet["unbounded"]
            assert found["engine"] == "gnumeric" or sheet["differ"] == 0
    cells = {sheet["sheet"]: sheet["cells"] for sheet in record["engines"][0]["sheets"]}
    assert cells["Sheet beta 5"] > 2500


def test_a_table_for_each_engine(run: Run) -> None:
    status, out, err = run([Fake(), Fake(reason="It is not installed: install it.")])
    assert (status, err) == (0, "")
    assert out.startswith("Written: workbook.xlsx\n\nfake 1.0: verified, ")
    assert re.search(r"^  Sheet +\d{4} +0 +0 +\d +\d$", out, re.MULTILINE)
    assert "\nfake: missing\n  It is not installed: install it.\n" in out
    assert out.endswith("1 of 1 engines on this machine give the values of the workbook\n")


def test_differences_are_shown_and_status_1(run: Run) -> None:
    status, out, _ = run([Fake(added=1e-12), Fake()])
    assert status == 1
    assert "fake 1.0: differs" in out
    assert re.search(r"^  Sheet!D\d+: expected \S+, found \S+ \(\d+ ulp\)$", out, re.MULTILINE)
    assert re.search(r"^  and \d+ more$", out, re.MULTILINE)
    assert "1 of 2 engines on this machine" in out
    record = json.loads(run([Fake(added=1e-12)], "--json")[1])
    (sheet,) = (s for s in record["engines"][0]["sheets"] if s["sheet"] == "Sheet")
    assert len(sheet["unexplained"]) == sheet["differ"] > 20
    assert set(sheet["unexplained"][0]) == {"cell", "expected", "found", "ulps"}


def test_an_echo_is_status_1(run: Run) -> None:
    status, out, _ = run([Fake(echoes=True)])
    assert status == 1
    assert "fake 1.0: echoes\n  It verifies nothing" in out


def test_quiet_leaves_the_status(run: Run) -> None:
    assert run([Fake()], "--quiet") == (0, "", "")
    assert run([Fake(added=1.0)], "--quiet") == (1, "", "")


def test_without_any_engine_nothing_is_written(run: Run, tmp_path: Path) -> None:
    status, out, err = run([Fake(reason="Absent.")])
    assert (status, out) == (2, "")
    assert "no spreadsheet engine here: run pip install ironcalc formualizer" in err
    assert list(tmp_path.iterdir()) == []


def test_json_wants_verify(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["workbook", "--json"]) == 2
    assert "--verify" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
