"""What `coldspray check` and `coldspray diff` say about right and spoiled workbooks.

    python tests/foreign/said.py > tests/foreign/said.txt

writes the file that `tests/replication/test_check.py` compares. `cases.txt` lists how most of the
workbooks are spoiled. If you change what the program says, read every line that changes in
`said.txt` before you keep it. Numbers have at most seven digits, so that the file is the same on
every machine.
"""

import math
import re
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import cache, partial
from pathlib import Path
from typing import Any, NamedTuple

sys.path.insert(0, str(Path(__file__).parents[1]))
# The project must come first: folders of tests have the names of its packages.
sys.path.insert(0, str(Path(__file__).parents[2]))

from foreign import layouts, writers
from foreign.drawn import drawn
from foreign.faults import FAULTS
from foreign.layouts import BY_HAND, Foreign, made

from replication.cases import BETA_5
from replication.check import show
from replication.check.diff import Tolerance, diff
from replication.check.examination import KINDS
from replication.check.scheme import KNOWN, REPORT, Case, march
from replication.check.show import check_record, diff_record
from replication.check.workbook import Check, check
from spreadsheets.foreign import WorkbookError

COARSE = replace(BETA_5, step=5e-10)
"""The report's other step: 53 rows, so that many workbooks take little time."""
Edits = list[tuple[str, str]]
"""Changes to a workbook: a cell, or a word that `cases.txt` explains, and its text."""


class Book(NamedTuple):
    """A workbook to check, its --map options, its stored values, and those that are wrong."""

    f: Foreign
    given: Mapping[str, str] | None = None
    values: writers.Values | None = None
    wrong: writers.Values | None = None


# ---- the workbooks


def cases() -> dict[str, dict[str, Edits]]:
    """The cases of `cases.txt`, by section and title."""
    sections: dict[str, dict[str, Edits]] = {}
    for block in Path(__file__).with_name("cases.txt").read_text("utf-8").split("\n## ")[1:]:
        name, *lines = block.splitlines()
        sections[name] = {}
        for line in filter(None, lines):
            title, *edits = line.split(" | ")
            if line.startswith("| "):
                title, edits = line[2:], line[2:].split(" | ")
            sections[name][title] = [_edit(edit) for edit in edits]
    return sections


def _edit(text: str) -> tuple[str, str]:
    """Split a change into a cell (of a sheet whose name may have blanks) or word, and a text."""
    cell = re.match(r"(?!map|before|stored)(((?! =).)+!)?[A-Z]+\d+(:\d*)*(?= |$)", text)
    word = cell[0] if cell else text.partition(" ")[0]
    return word, text[len(word) + 1 :]


def start(edits: Edits) -> Foreign:
    """The right workbook that a case starts from, with its own rows and inputs."""
    given = dict(edits)
    layout = given.get("layout", "plain")
    impact = BETA_5 if layout in BY_HAND else COARSE
    if layout.startswith("random-"):
        return drawn(int(layout.partition("-")[2]), impact)
    inputs = {name: float(given[name]) for name in ("velocity", "radius", "beta", "step")
              if name in given}  # fmt: skip
    return made(layout, replace(impact, **inputs), int(given.get("rows", 0)))


def edited(f: Foreign, edits: Edits) -> Foreign:
    """The workbook after all changes, made one after the other."""
    for word, text in edits:
        first, _, rest = text.partition(" ")
        if re.search(r"[A-Z]\d", word):
            layouts.change(f, word, text)
        elif word == "insert":
            layouts.insert(f, first, int(rest))
        elif word == "move":
            layouts.move(f, first, *map(int, rest.split()))
        elif word in ("rename", "copy"):
            kept = f.cells if word == "copy" else {}
            f.cells = kept | {(first, r, c): content for (_, r, c), content in f.cells.items()}
        elif word == "name":
            f.names[first] = rest
    return f


def book(edits: Edits) -> Book:
    """A case as a workbook."""
    f = edited(start(edits), edits)
    false = dict(_edit(text) for word, text in edits if word == "stored")
    wrong = {
        place: v for cell, text in false.items() for place, v in layouts.contents(f, cell, text)
    }
    given = dict(text.split("=", 1) for word, text in edits if word == "map")
    return Book(f, given, writers.calculated(f) if wrong else {}, wrong)


SPOILED = (
    "table-a1", "french", "sideways", "one-velocity", "no-time", "german", "velocity-at-end",
    "merged-heads", "natural-units", "no-deceleration", "named-everything", "named-constants",
)  # fmt: skip
"""Layouts in which faults are planted, each fault in two that can have it."""


@cache
def to_spoil(name: str) -> tuple[Foreign, writers.Values]:
    f = made(name, BETA_5)
    return f, writers.calculated(f)


def planted(fault: str) -> Iterator[str]:
    """Plant a fault in two layouts; the next fault goes into two others."""
    first, done = 5 * list(FAULTS).index(fault), 0
    for i in range(len(SPOILED)):
        f, values = to_spoil(SPOILED[(first + i) % len(SPOILED)])
        if fault == "operation order" and any("^" in str(c) for c in f.cells.values()):
            continue  # a power may differ in its last digit from machine to machine
        spoiled = FAULTS[fault](f, values)
        if spoiled is not None and done < 2:
            done += 1
            yield from said(f"in {f.name}", Book(spoiled.workbook, {}, values, spoiled.wrong))


def other_digits() -> Iterator[str]:
    """Results of every known scheme with six digits; and numbers as texts."""
    case = Case(**BETA_5.motion, step=BETA_5.step)
    report = march(case)
    for part, rules in KNOWN.items():
        f = made("six-digits", BETA_5)
        rows = march(case, REPORT | {part: rules[1]}, steps=f.steps)
        for (role, k), place in f.where.items():
            if isinstance(content := f.cells[place], float) and report.get(role, {}).get(k):
                unit = 10.0 ** round(math.log10(content / report[role][k]))
                f.cells[place] = float(f"{rows[role][k] * unit:.6g}")
        yield from said(f"six digits of {rules[1].name}", Book(f))
    f = made("pasted", BETA_5)
    texts = {p: f"{v:.6g}".replace(".", ",") for p, v in f.cells.items() if isinstance(v, float)}
    f.cells |= texts
    yield from said("numbers as text, with commas", Book(f))


# ---- what is said about them


def checked(book: Book) -> Check:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "book.xlsx")
        return check(writers.written(book.f, path, book.values, book.wrong), book.given)


def whole(title: str, book: Book) -> Iterator[str]:
    """Everything that a user reads about a workbook."""
    yield from _told(title, check_record(checked(book)))


def compared(title: str, edits: Edits) -> Iterator[str]:
    """What `coldspray diff` says about two workbooks."""
    given = dict(edits)
    before = edited(start(edits), [_edit(text) for word, text in edits if word == "before"])
    with tempfile.TemporaryDirectory() as folder:
        paths = [writers.with_openpyxl(f, Path(folder, f"{name}.xlsx"))
                 for f, name in ((before, "a"), (edited(start(edits), edits), "b"))]  # fmt: skip
        known = {"digits": int, "ulp": int, "relative": float}
        allowed = Tolerance(**{name: kind(given[name]) for name, kind in known.items()
                               if name in given})  # fmt: skip
        if "reverse" in given:
            paths.reverse()
        result = diff(*paths, allowed=allowed, values_only="values-only" in given)
        yield from _told(title, diff_record(result))


def _told(title: str, record: Mapping[str, Any]) -> Iterator[str]:
    yield f"* {title} -> {int(not record['clean'])}"
    lines = show.text(record).split("\n")[1:]
    lines = [line for line in lines if line and "no value is stored" not in line]
    yield from (f"  {_shown(line)}".rstrip() for line in lines)


MOST = 7
"""How many differences of a workbook are shown."""


def said(title: str, book: Book) -> Iterator[str]:
    """The answer in a few lines: status, verdict, differences, and what was taken for what.

    Of the last, only what is not as in the right workbook of the same layout.
    """
    try:
        record = check_record(checked(book))
    except (ValueError, WorkbookError) as error:
        yield f"* {title} -> 2"
        yield f"  {_shown(re.sub(r'/.*book.xlsx', 'FILE', str(error)).removeprefix('FILE: '))}"
        return
    yield f"* {title} -> {int(not record['clean'])}"
    yield f"  {_shown(record['verdict'])}"
    shown = [
        d
        for d in record["differences"]
        if d["kind"] != "printed number" and "no value is stored" not in d["explanation"]
    ]
    for d in shown[:MOST]:
        yield f"  {'first: ' if d == record['first'] else ''}{_difference(d)}"
    if len(shown) > MOST:
        yield f"  and {len(shown) - MOST} more"
    for depth in record["final_depths"]:
        own, right = (_um(depth[name]) for name in ("found", "expected"))
        why = f", by {depth['explained_by']} alone" if depth["explained_by"] else ""
        yield f"  depth {own}, right {right}{why}; {depth['differing']} cells differ"
    if claims := record["claims"]:
        unmet = [f"{c['cell']} {_number(c['found'])} for {c['printed']}"
                 for c in claims if not c["met"]]  # fmt: skip
        not_so = f"; not {', '.join(unmet)}" if unmet else ""
        yield f"  {len(claims) - len(unmet)} of {len(claims)} printed numbers{not_so}"
    before = usual(book.f.name) * len(record["taken"])
    for taken, expected in zip(_taken(record), before, strict=False):
        roles = {entry.partition(" ")[0] for entry in taken}
        missing = [role for entry in expected[1:] if (role := entry.partition(" ")[0]) not in roles]
        unusual = [entry for entry in taken if entry not in expected]
        if unusual or missing:
            yield f"  taken: {', '.join([*unusual, *(f'no {role}' for role in missing)])}"


@cache
def usual(layout: str) -> list[list[str]]:
    """What was taken for what in the right workbook of a layout."""
    f = start([("layout", layout)])
    return list(_taken(check_record(checked(Book(f))))) if f.cells else [[]]


def _taken(record: Mapping[str, Any]) -> Iterator[list[str]]:
    for table in record["taken"]:
        yield [
            f"{table['sheet']}: {table['steps']} steps {table['direction']}, {table['scheme']}",
            *(f"{role} {c['cells']} {c['unit']} ({c['by']})"
              for role, c in table["columns"].items()),
            *(f"{role} {_number(own['value'])} in {own['cell'] or 'no cell'} ({own['by']})"
              for role, own in table["inputs"].items()),
        ]  # fmt: skip


def _difference(d: Mapping[str, Any]) -> str:
    cells = f" ({d['cells']})" if d["count"] > 1 else ""
    effect = "" if d["final_depth"] is None else f" [alone {_um(d['final_depth'])}]"
    holds = (
        f"{_shown(line)}{_apart(d['found'], d['expected'])}; " if (line := show.contents(d)) else ""
    )
    return f"{d['cell']}{cells}, {d['kind']}: {holds}{_shown(d['explanation'])}{effect}"


def _apart(result: object, expected: object) -> str:
    """How far apart two numbers are, if they look the same with seven digits."""
    if not isinstance(result, float) or not isinstance(expected, float) or result == expected:
        return ""
    off = result / expected - 1 if expected else 1.0
    return f" ({off:+.0e} of it)" if _number(result) == _number(expected) else ""


def _um(depth: float | None) -> str:
    return "unknown" if depth is None else f"{_number(depth * 1e6)} um"


def _number(value: float) -> str:
    return f"{value:.7g}"


def _shown(text: str) -> str:
    """A text with seven digits of each number, and two blanks where columns were aligned."""
    text = re.sub(
        r"(?<![\w.])\d+\.\d+(?:[eE][-+]?\d+)?(?!\w)", lambda m: _number(float(m[0])), text
    )
    return re.sub(r"(?<=\S)  +", "  ", text)


def page(title: str, book: Book) -> Iterator[str]:
    """The rows and columns that the page draws, with the cells it marks; then the JUnit file."""
    result = checked(book)
    record = check_record(result) | {"file": "FILE"}
    yield f"* {title}"
    text = show.html(record, result.differences, result.calculation)
    sheets = text.partition('<h2 id="sheets">')[2].partition("<h2")[0]
    rows: list[str] = []
    for line in sheets.split("\n"):
        if line.startswith("<h3>"):
            yield f"  sheet {line[4:-5]}"
        elif line.startswith("<thead>"):
            yield f"  columns {' '.join(re.findall(r'col.>([^<]*)<', line))}"
        elif line.startswith("<tr>"):
            cells = re.findall(r"<td(.*?)</td>", line) if "origin" in line else []
            rows += re.findall(r'row">([^<]*)', line)
            yield from (f"  row {rows[-1]}:{_shown(cell)}" for cell in cells[:8])
        elif line == "</table>":
            yield f"  rows {' '.join(rows)}"
            rows.clear()
    yield from (f"  {_shown(line)}" for line in show.junit(record, KINDS).split("\n"))


def answers(name: str) -> Iterator[str]:
    """The answers to the cases of a section."""
    for title, edits in CASES[name].items():
        if name.startswith("two workbooks"):
            yield from compared(title, edits)
        else:
            yield from {"in": whole, "the": page}.get(name.split()[0], said)(title, book(edits))


CASES = cases()
SECTIONS: dict[str, Callable[[], Iterator[str]]] = {
    **{f"planted: {fault}": partial(planted, fault) for fault in FAULTS},
    **{name: partial(answers, name) for name in CASES},
    "digits of other schemes": other_digits,
}  # fmt: skip


def section(name: str) -> str:
    """The text of a section of the file."""
    return "\n".join([f"## {name}", *SECTIONS[name](), "", ""])


if __name__ == "__main__":
    print(__doc__)
    for name in SECTIONS:
        print(section(name), end="")
