"""What is true of a workbook, and whether an answer of `coldspray check` says it.

Truth comes from how a workbook was made, never from what a program said about it.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from foreign.layouts import Foreign, Place, letters
from running import coldspray


@dataclass(frozen=True)
class Truth:
    """The status; of a fault the kinds and cells that name it; of a refusal, words of its line.

    More than one kind only where the manual lets a fault be called by two; no kind: any. More than
    one cell where a fault is in several, or is the disagreement of several. A cell is written B5 if
    it is on the first sheet, else Sheet!B5. `or_refused`: the line of status 2 that names the cell
    is right, too, as where a text in an input leaves no table.
    """

    status: int = 0
    kinds: tuple[str, ...] = ()
    cells: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    or_refused: bool = False


CLEAN = Truth()


def fault(kinds: str | tuple[str, ...], *cells: str, or_refused: bool = False) -> Truth:
    """A fault of a kind (or one of some kinds) in a cell (or in any of some)."""
    return Truth(1, (kinds,) if isinstance(kinds, str) else kinds, cells, or_refused=or_refused)


def refused(*words: str) -> Truth:
    """No workbook of the scheme, or none that can be checked: status 2, in a line with words."""
    return Truth(2, words=words)


EITHER = ("other scheme", "odd formula")
"""What a wrong formula in all rows of a column is called: the scheme has a name, or has none."""


def full(place: Place) -> str:
    """A cell with its sheet, as `Truth` writes it."""
    return f"{place[0]}!{letters(place[2])}{place[1]}"


@dataclass(frozen=True)
class Answer:
    """What `coldspray check --json` answers: its status, the document, or the line of an error."""

    status: int
    record: Mapping[str, Any]
    line: str = ""

    @property
    def first(self) -> Mapping[str, Any]:
        """The first difference, empty if there is none."""
        return self.record.get("first") or {}


def ask(path: Path, given: Mapping[str, str] | None = None) -> Answer:
    """Run `coldspray check` on a file, in this process."""
    options = [f"--map={name}={cells}" for name, cells in (given or {}).items()]
    status, out, err = coldspray("check", path, *options, "--json")
    return Answer(status, json.loads(out) if out else {}, err.strip())


def outcome(truth: Truth, answer: Answer, book: Foreign) -> str:
    """`right`, or in which way the answer is wrong.

    Right books: `accused`, `not checked`. Faults: `missed`, `not checked`, `misplaced` (another
    cell), `misnamed` (another kind in the right cell). Refusals: `accused`, `called clean`.
    """
    if answer.status == 2:
        named = any(cell.rpartition("!")[2] in answer.line for cell in truth.cells)
        said = truth.status == 2 and all(word in answer.line for word in truth.words)
        return "right" if said or (truth.or_refused and named) else "not checked"
    if truth.status == 2:
        return "accused" if answer.status else "called clean"
    if truth.status == 0 or answer.status == 0:
        return ("right" if answer.status == truth.status else
                "accused" if answer.status else "missed")  # fmt: skip
    sheet = next((at[0] for at in book.cells), "")
    cells = {cell if "!" in cell else f"{sheet}!{cell}" for cell in truth.cells}
    if f"{answer.first.get('sheet')}!{answer.first.get('cell')}" not in cells:
        return "misplaced"
    return (
        "right" if answer.first["kind"] in (truth.kinds or [answer.first["kind"]]) else "misnamed"
    )


def told(answer: Answer) -> str:
    """An answer in a line, for the message of a test that fails."""
    if answer.status == 2:
        return f"2, {answer.line}"
    first = answer.first
    place = (
        f": {first['sheet']}!{first['cell']}, {first['kind']}, {first['explanation']}"
        if first
        else ""
    )
    return f"{answer.status}{place}"
