"""`coldspray solve`: what it answers, with which status, and what it refuses.

That the values are right is in `test_solve.py` and `test_inverse.py`; here they go through texts.
"""

import json
from pathlib import Path
from typing import Any

import pytest
from running import coldspray

from replication import BETA_5, final_depth
from replication.cli.solve import SOUGHT_NAMES
from replication.solve import solve, solve_printed


def answer(*arguments: str, status: int = 0) -> dict[str, Any]:
    """Return the JSON that the command prints with this status."""
    ended, out, err = coldspray("solve", *arguments, "--json")
    assert (ended, err) == (status, "")
    return dict(json.loads(out))


@pytest.mark.parametrize("typed", SOUGHT_NAMES)
def test_json_has_the_promised_keys_and_the_value_of_python(typed: str) -> None:
    record, expected = (
        answer(typed, "--depth", "3.3 um"),
        solve(BETA_5, SOUGHT_NAMES[typed], 3.3e-6),
    )
    assert {"inputs", "quantity", "value", "interval", "depth", "normalized_depth"} <= set(record)
    assert record["quantity"] == SOUGHT_NAMES[typed]
    assert record["value"] == expected.value
    assert record["condition"] == expected.condition
    assert record["depth"] == 3.3e-6
    assert record["interval"] is None
    assert SOUGHT_NAMES[typed] not in record["inputs"]


def test_a_normalized_depth_is_that_times_the_radius() -> None:
    record = answer("velocity", "--normalized-depth", "0.5", "--radius", "2 um")
    assert record["depth"] == 1e-6
    case = {**BETA_5.motion, "velocity": record["value"], "radius": 2e-6}
    assert final_depth(**case) == pytest.approx(1e-6, rel=1e-14)  # some ulp, there and back


def test_rounded_takes_every_text_as_printed() -> None:
    """500 m/s by an option is 499.5 to 500.5, and exact in the case."""
    texts = {"depth": "3.3 um", "velocity": "500"}
    record = answer("resistance", "--depth", "3.3 um", "--velocity", "500", "--rounded")
    expected = solve_printed(BETA_5, "resistance", texts).interval
    assert expected is not None
    assert record["interval"] == list(expected)
    exact = answer("resistance", "--depth", "3.3 um", "--rounded")["interval"]
    # R_t is proportional to the square of the velocity.
    assert record["interval"] == pytest.approx(
        [exact[0] * 0.999**2, exact[1] * 1.001**2], rel=1e-14
    )


def test_zeros_that_end_a_whole_number_may_not_be_significant() -> None:
    """500 m/s to three digits is 499.5 to 500.5, and to one 450 to 550; the case's is exact."""
    arguments = ("resistance", "--depth", "3.3 um", "--rounded")
    exact = answer(*arguments)
    assert exact["fewest_digits"] is None  # 3.3 has two digits, and no other number
    record = answer(*arguments, "--velocity", "500")
    # R_t is proportional to the square of the velocity.
    low, high = exact["interval"]
    assert record["fewest_digits"] == pytest.approx([low * 0.9**2, high * 1.1**2], rel=1e-14)
    assert answer(*arguments, "--velocity", "500.")["fewest_digits"] is None
    said = coldspray("solve", *arguments, "--velocity", "500")[1]
    assert "fewest digits" in said
    assert "fewest digits" not in coldspray("solve", *arguments)[1]


def test_a_case_file_is_exact(tmp_path: Path) -> None:
    file = tmp_path / "case.toml"
    file.write_text("[impact]\nvelocity = 500\n", "utf-8")
    arguments = ("resistance", "--depth", "3.3 um", "--rounded")
    assert answer(*arguments, "--case-file", str(file)) == answer(*arguments)


def test_no_solution_is_status_1_with_its_reason() -> None:
    record = answer("target-density", "--depth", "9 um", status=1)
    assert (record["value"], record["interval"]) == (None, None)
    assert record["reason"].startswith("target density has no value that gives 9 um: ")
    status, out, err = coldspray("solve", "target-density", "--depth", "9 um")
    assert (status, err) == (1, "")
    assert "none: the target density has no value that gives 9 um" in out


def test_an_interval_without_a_value_in_its_middle_is_an_answer() -> None:
    record = answer("target-density", "--depth", "8.28 um", "--velocity", "500", "--rounded")
    assert record["value"] is None
    assert record["interval"][0] == 0


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ("velocity --depth um", "--depth: 'um' is not a finite number with or without a unit, such "
         "as '1 m'"),
        ("velocity --depth -1", "--depth: '-1' is not greater than zero"),
        ("velocity --normalized-depth 0", "--normalized-depth: '0' is not greater than zero"),
        ("velocity --normalized-depth 3um", "--normalized-depth: '3um': give no unit"),
        ("radius --normalized-depth 0.3",
         "--normalized-depth: it does not depend on the radius: give --depth"),
        ("velocity --depth 3um --velocity 400", "--velocity is what is solved for: leave it out"),
        ("velocity --depth 3um --velocity 400 --rounded",
         "--velocity is what is solved for: leave it out"),
        ("resistance --depth 3um --beta 4",
         "--beta has no say where the resistance is solved for: leave it out"),
        ("flow-stress --depth 3um --resistance 4e9",
         "--resistance has no say where the flow stress is solved for: leave it out"),
        ("velocity --depth 3um --rounded --radius 0.0um",
         "--radius is 0.0: it must be a finite number greater than zero"),
        ("velocity --depth 3", '--depth: the depth is 2.73e+05 times the radius: did you mean "3 '
         'um"?'),
        ("velocity --normalized-depth 3.3e3", "--normalized-depth: the depth is 3.3e+03 times the "
         'radius: did you mean --depth "3.3e3 um"?'),
        ("velocity --normalized-depth 3e4", "--normalized-depth: the depth is 3e+04 times the "
         "radius: no velocity that doubles can hold gives it"),
        ("velocity --depth 3m", "--depth: the depth is 2.73e+05 times the radius: no velocity that "
         "doubles can hold gives it"),
        ("depth --velocity 400 --depth 3um", "argument QUANTITY: it is solved for what gives a "
         "depth; the depth of a case is printed by `coldspray depth` (see coldspray solve --help)"),
        ("step --depth 3um", "argument QUANTITY: there is no quantity 'step': choose one of "
         "resistance, beta, flow-stress, velocity, radius, particle-density, target-density (see "
         "coldspray solve --help)"),
    ],
)  # fmt: skip
def test_bad_input_is_named_as_it_was_typed(arguments: str, line: str) -> None:
    assert coldspray("solve", *arguments.split()) == (2, "", f"coldspray solve: {line}\n")


def test_an_answer_that_no_impact_has_is_warned_of() -> None:
    _, out, err = coldspray("solve", "radius", "--depth", "3.3")
    assert "radius            4729683 um (4.729683027833749 m)\n" in out
    assert err == (
        "coldspray solve: warning: the radius for this depth is 4.72968302783 m: from 1e-09 to 1 m "
        "is expected\n"
    )
