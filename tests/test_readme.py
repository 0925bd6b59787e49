"""The README's examples and numbers, links in the documents, and `docs/recheck.py`."""

import copy
import doctest
import json
import re
import runpy
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from kept import kept
from running import coldspray

from replication.audit.record import Record
from replication.power import measured
from replication.report.document import audit_document
from replication.text import json_text

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text("utf-8")
EXAMPLES = [
    (command, output)
    for block in re.findall(r"```console\n(.*?)```", README, re.DOTALL)
    for command, output in re.findall(
        r"^\$ coldspray (.*)\n((?:(?!\$ ).*\n)*)", block, re.MULTILINE
    )
]


@pytest.mark.parametrize(("command", "output"), EXAMPLES, ids=[c for c, _ in EXAMPLES])
def test_example_prints_what_the_readme_says(command: str, output: str) -> None:
    status, printed, _ = coldspray(*shlex.split(command))
    assert status == 0
    head, _, tail = output.partition("...\n")
    assert printed.startswith(head)
    assert printed.endswith(tail)


def test_there_are_examples_and_those_in_python_run() -> None:
    assert len(EXAMPLES) >= 4
    results = doctest.testfile(str(ROOT / "README.md"), module_relative=False)
    assert results.attempted > 0
    assert results.failed == 0


def test_the_two_commands_are_those_that_users_were_promised() -> None:
    assert "python -m pip install . && coldspray audit" in README
    assert "python -m pip install -e '.[test]' && python -m pytest" in README
    assert "python -m pip install --quiet -e '.[test]'" in (ROOT / ".ci" / "run").read_text()


def test_the_rates_are_those_measured() -> None:
    rates = measured()
    shares = (rates.repaired, rates.repaired_first, rates.accused_wrongly)
    named, first, accused = (f"{100 * share / rates.visible:.1f} %" for share in shares)
    hidden = f"{rates.invisible} ({rates.invisible / rates.planted:.0%}) leave".replace("%", " %")
    text = " ".join(README.split())
    assert f"Of {rates.planted}, drawn with seed {rates.seed}, it notices {rates.detected};" in text
    assert f"the other {hidden} all numbers that it relates in agreement." in text
    assert f"For the {rates.visible} it names the true text in {named}, first in {first}," in text
    assert f"and another entry first in {accused}." in text


def test_times_are_those_of_the_whole_table() -> None:
    (block,) = re.findall(r"```text\n(.*?)```", README, re.DOTALL)
    whole = (ROOT / "docs" / "bench" / "bench.txt").read_text("utf-8").splitlines()
    assert {line.rstrip() for line in block.splitlines()} <= {line.rstrip() for line in whole}


@pytest.mark.parametrize(
    "document",
    ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/check.md", "docs/sweeps/README.md"],
)
def test_links_and_paths_lead_somewhere(document: str) -> None:
    text = (ROOT / document).read_text("utf-8")
    for target in re.findall(r"\]\((?!https?:|#)([^)]+)\)", text):
        assert ((ROOT / document).parent / target).exists(), target
    for path in re.findall(r"`((?:reference|replication|spreadsheets|tests)/[\w/.]*)`", text):
        assert (ROOT / path).exists(), path


# The program that checks an audit by its file alone

PROGRAM = ROOT / "docs" / "recheck.py"
differences = runpy.run_path(str(PROGRAM))["differences"]
Audit = dict[str, Any]


@pytest.fixture(scope="module")
def audit(record: Record) -> Audit:
    return dict(json.loads(json_text(audit_document(record))))


@kept("replication/kept.txt", "An audit tampered with, and what is said of its file")
def test_what_is_changed_is_noticed(question: str, answer: str, audit: Audit) -> None:
    another = copy.deepcopy(audit)
    parts = {part: {entry["id"]: entry for entry in another[part]}
             for part in ("claims", "equations")}  # fmt: skip
    exec(question, {**parts, "summary": another["summary"], "counts": another["counts"]})
    assert "; ".join(differences(another)) == answer


@pytest.mark.parametrize(
    ("changed", "status"),
    [
        (lambda text: text, 0),
        (lambda text: text.replace('"reproduced"', '"not reproduced"', 1), 1),
        *((lambda _, text=text: text, 2) for text in ("{}", "no JSON", "[1]")),
    ],
)
def test_the_program(
    changed: Callable[[str], str], status: int, audit: Audit, tmp_path: Path
) -> None:
    file = tmp_path / "audit.json"
    file.write_text(changed(json.dumps(audit)), "utf-8")
    command = [sys.executable, "-I", PROGRAM, file]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == status
    assert "Traceback" not in done.stderr
    assert len(done.stderr.splitlines()) == (status == 2)
    if status == 0:
        assert done.stdout == f"{len(audit['claims'])} claims, 0 differences\n"
