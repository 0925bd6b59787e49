"""One name, one thing: a reader who searches for a name finds one thing that it stands for."""

import ast
from collections import defaultdict
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
ROOMS = ("reference", "replication", "spreadsheets")

SHARED = {
    "add_options": "every command has it",
    "run": "every command has it; of the sheet it is a public name",
    "HELP": "every command has it",
    "EXAMPLE": "every command has it",
}
"""The names that stand for the same thing in several modules of one room, and why."""

FOR_ARRAYS = ROOT / "replication" / "models" / "arrays.py"
"""What is computed here for arrays has the name of what other modules compute for one case."""


def _assigned(node: ast.stmt) -> Iterator[str]:
    """The names of constants and of aliases of types that a statement binds."""
    targets = node.targets if isinstance(node, ast.Assign) else []
    targets = [node.target] if isinstance(node, ast.AnnAssign) else targets
    for target in targets:
        yield from (part.id for part in ast.walk(target) if isinstance(part, ast.Name))


def _defined(node: ast.stmt) -> Iterator[str]:
    """The name of a function or a class, or those that an assignment binds."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        yield node.name
    yield from _assigned(node)


def _several(rooms: Sequence[str], only_assigned: bool) -> dict[str, list[str]]:
    """The public names that several modules define, each with the modules.

    If `only_assigned`, one of the modules at least assigns it: functions of two rooms are twins.
    """
    homes, assigned = defaultdict(list), set()
    for path in (path for room in rooms for path in sorted((ROOT / room).rglob("*.py"))):
        if path != FOR_ARRAYS:
            for node in ast.parse(path.read_text("utf-8")).body:
                assigned |= set(_assigned(node))
                for name in dict.fromkeys(_defined(node)):
                    homes[name].append(str(path.relative_to(ROOT)))
    return {
        name: paths
        for name, paths in homes.items()
        if len(set(paths)) > 1 and not name.startswith("_") and name not in SHARED
        if name in assigned or not only_assigned
    }


@pytest.mark.parametrize("room", ROOMS)
def test_a_public_name_stands_for_one_thing_in_a_room(room: str) -> None:
    """The rooms compute the same quantities apart, so twins of two rooms have one name."""
    assert _several([room], only_assigned=False) == {}


def test_a_constant_or_an_alias_of_a_type_stands_for_one_thing_in_the_whole_project() -> None:
    assert _several(ROOMS, only_assigned=True) == {}
