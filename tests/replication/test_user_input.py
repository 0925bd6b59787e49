"""What is said of a value in a TOML file names the line on which it stands."""

import pytest

from replication.user_input import line_of

PLAN = """\
# radius = 1
[sweep]
"case" = 'beta-5'  # [inputs]
note = \'\'\'
radius = 2
[inputs]
\'\'\'

[inputs]
velocity = [
  400,  # ]
  500,
]
beta.from = 3
[inputs.radius]
from = "1 um"
"to" = "2 um"
"""


@pytest.mark.parametrize(
    ("keys", "line"),
    [
        (["sweep"], 2),
        (["sweep", "case"], 3),
        (["sweep", "note"], 4),
        (["inputs"], 9),
        (["inputs", "velocity"], 10),
        (["inputs", "beta"], 14),
        (["inputs", "beta", "from"], 14),
        (["inputs", "radius"], 15),
        (["inputs", "radius", "to"], 17),
        (["inputs", "step"], None),
        ([], None),
    ],
)
@pytest.mark.parametrize("ending", ["\n", "\r\n"])
def test_the_line_of_a_key(keys: list[str], line: int | None, ending: str) -> None:
    assert line_of(PLAN.replace("\n", ending), keys) == line


def test_a_table_within_a_list_of_tables_is_on_its_own_line() -> None:
    """Its head has all the keys; the head after it has none of them."""
    assert line_of("[[inputs]]\n[[inputs.radius]]\n[sweep]", ["inputs", "radius"]) == 2


def test_a_line_that_would_be_found_too_late_is_not_named() -> None:
    """A statement is read at most a hundred times."""
    rows = "[\n" + 1000 * "[1],\n" + "]"
    assert line_of(f"[inputs]\nstep = {rows}\nbeta = 3", ["inputs", "beta"]) is None
    long = "[\n" + 1000 * "1,\n" + "]"
    assert line_of(f"[inputs]\nstep = {long}\nbeta = 3", ["inputs", "beta"]) == 1004
