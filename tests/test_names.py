"""One name, one thing: a reader who searches for a function or a class finds one."""

import ast
from collections import defaultdict
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent

SHARED = {
    "add_options": "every command has it",
    "run": "every command has it; of the sheet it is a public name",
    "frank_zook_depth": "for arrays and for one case",
    "history": "for arrays and for one case",
}
"""The names that stand for the same thing in several modules of one room, and why."""


@pytest.mark.parametrize("room", ["reference", "replication", "spreadsheets"])
def test_a_public_name_stands_for_one_thing_in_a_room(room: str) -> None:
    """The rooms compute the same quantities apart, so twins of two rooms have one name."""
    homes = defaultdict(list)
    for path in sorted((ROOT / room).rglob("*.py")):
        for node in ast.parse(path.read_text("utf-8")).body:
            if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_"):
                homes[node.name].append(str(path.relative_to(ROOT)))
    several = {name: paths for name, paths in homes.items() if len(paths) > 1}
    assert {name: paths for name, paths in several.items() if name not in SHARED} == {}
