"""`import coldspray`: the public names, and what they look like at a prompt."""

import subprocess
import sys
import tomllib
from importlib import import_module
from pathlib import Path

import pytest

import coldspray
import replication
from replication.__main__ import program
from replication.audit.record import Record


def test_it_has_the_names_of_replication_and_a_version() -> None:
    assert set(coldspray.__all__) == {*replication.__all__, "__version__"}
    assert set(coldspray.__all__) <= set(dir(coldspray))
    for name in replication.__all__:
        assert getattr(coldspray, name) is getattr(replication, name)


def test_it_has_no_other_names() -> None:
    with pytest.raises(AttributeError, match="has no attribute 'final_dept'"):
        getattr(coldspray, "final_dept")  # noqa: B009 - type checkers know that it is not there


@pytest.mark.parametrize("module", ["coldspray", "replication"])
def test_it_runs_as_the_command(module: str) -> None:
    command = [sys.executable, "-m", module, "--version"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout == f"coldspray {coldspray.__version__}\n"


def test_the_installed_program_is_the_same() -> None:
    project = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text("utf-8"))
    module, _, name = project["project"]["scripts"]["coldspray"].partition(":")
    assert getattr(import_module(module), name) is program


def test_a_case_is_shown_as_the_call_that_makes_it() -> None:
    assert repr(coldspray.BETA_3) == (
        "Impact(velocity=500.0, radius=1.1e-05, particle_density=8900.0, target_density=7850.0, "
        "beta=3.0, flow_stress=700000000.0)"
    )


def test_a_step_of_ones_own_is_shown() -> None:
    case = coldspray.Impact(**coldspray.BETA_5.motion, step=1e-9)
    assert repr(case).endswith(", resistance=3500000000.0, step=1e-09)")


def test_a_sheet_is_shown_by_its_results() -> None:
    assert repr(coldspray.run(coldspray.BETA_5)) == (
        "<published sheet, 131 steps of 2e-10 s: 7.66956 um, X/R 0.697232>"
    )


def test_a_notebook_shows_a_sheet_with_units_and_its_last_row() -> None:
    shown = coldspray.run(coldspray.BETA_5)._repr_html_()
    assert "<th>deceleration [m/s^2]</th>" in shown
    assert "<th>131</th>" in shown
    assert len(shown) < 10_000


def test_the_audit_is_shown_in_a_line(record: Record) -> None:
    counts = record.summary
    assert repr(record).startswith(
        f"<audit of {sum(counts.values())} entries: {counts['reproduced']} reproduced, "
    )
    assert len(repr(record)) < 300


def test_a_claim_is_shown_with_its_verdict(record: Record) -> None:
    claim = record.claim("frank-zook-rha")
    assert repr(claim) == "<claim frank-zook-rha: 0.278, not reproduced>"


def test_an_unknown_id_is_answered_with_similar_ones(record: Record) -> None:
    with pytest.raises(KeyError, match="there is no claim 'depth-beta-4'; did you mean depth-beta"):
        record.claim("depth-beta-4")
