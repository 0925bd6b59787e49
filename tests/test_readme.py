"""The README's examples: every ```console block is run, every promise about files is true."""

import doctest
import re
import shlex
from pathlib import Path

import pytest
from running import coldspray

from replication.power import measured

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
