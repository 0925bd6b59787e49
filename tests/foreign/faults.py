"""Faults to plant in a foreign workbook; and where, and as which kind, each should be found."""

import copy
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from foreign.byhand import BY_HAND, made
from foreign.layouts import BRAKE, DEPTH, END, START, Foreign, Place, decimal, letters
from foreign.truth import CLEAN, Truth, full

from replication.cases import BETA_3, BETA_5

Values = Mapping[Place, Any]


@dataclass
class Planted:
    """A workbook with a fault, what is then true, and stored values that are wrong."""

    truth: Truth
    workbook: Foreign
    wrong: dict[Place, Any] = field(default_factory=dict)


def accusing(kind: str | tuple[str, ...], cells: Iterable[Place]) -> Truth:
    """The truth of a fault in any of some cells; without a kind, that there is none."""
    kinds = (kind,) if isinstance(kind, str) else kind
    return Truth(1, kinds, tuple(map(full, cells))) if kind else CLEAN


Plant = Callable[[Foreign, Values], Planted | None]
FAULTS: dict[str, Plant] = {}
"""Each plants its fault in a workbook with these values, or returns None if it cannot."""


def fault(
    name: str, kind: str | tuple[str, ...], near: int = 1, *, stored: bool = False
) -> Callable[..., None]:
    """Register a function that returns changed contents of cells, or changed `stored` values.

    The fault should be found in the first `near` of these cells.
    """

    def register(changes: Callable[[Foreign, Values], Mapping[Place, Any] | None]) -> None:
        def plant(f: Foreign, values: Values) -> Planted | None:
            changed = changes(f, values) or {}
            changed = {p: content for p, content in changed.items() if content != f.cells.get(p)}
            if not changed:
                return None
            g = copy.deepcopy(f)
            g.cells |= {} if stored else changed
            truth = accusing(kind, tuple(changed)[:near])
            return Planted(truth, g, changed if stored else {})

        FAULTS[name] = plant

    return register


def in_column(
    name: str, kind: str, role: str, steps: Iterable[int],
    change: Callable[[Foreign, str, Any], object], near: int = 1, *, stored: bool = False,
) -> None:  # fmt: skip
    """Register a fault in a column, in some steps or all: how it changes a formula or its value."""

    def changes(f: Foreign, values: Values) -> Mapping[Place, Any]:
        return {p: change(f, t, values.get(p)) for p, t in _formulas(f, role, *steps).items()}

    fault(name, kind, near, stored=stored)(changes)


def ref(place: Place, dollar: str = "") -> str:
    """The reference to a cell within its sheet; with a dollar, the absolute one."""
    return f"{dollar}{letters(place[2])}{dollar}{place[1]}"


def _formulas(f: Foreign, role: str, *steps: int) -> dict[Place, str]:
    """The formulas of a column in some steps, or in all."""
    places = [f.where.get((role, k)) for k in steps or range(1, f.steps + 1)]
    texts = {place: f.cells.get(place) for place in places if place}
    return {p: t for p, t in texts.items() if isinstance(t, str) and t.startswith("=")}


def _names(f: Foreign, place: Place) -> list[str]:
    """The defined names of a cell."""
    cell = ref(place, "$")
    return [name for name, meaning in f.names.items() if meaning.rpartition("!")[2] == cell]


def _typed(f: Foreign, text: str, _: object) -> str:
    """A formula with the value of an input typed in place of a reference to its cell."""
    references = []
    for role, place in f.inputs.items():
        if role not in ("beta", "stop_velocity"):
            cell = ref(place, "$")
            as_cell = [cell, f"{place[0]}!{cell}", f"'{place[0]}'!{cell}"]
            references += [(name, f.cells[place]) for name in (*as_cell, *_names(f, place))]
    for reference, value in sorted(references, key=lambda entry: -len(entry[0])):
        pattern = rf"(?<![\w$!']){re.escape(reference)}(?![\w$])"
        if re.search(pattern, text):
            small = f"{float(value):.15f}".rstrip("0").rstrip(".")
            return re.sub(pattern, small if "e" in repr(value) else repr(value), text)
    return text


in_column("stale value", "stale value", BRAKE, [60], lambda _f, _, v: v * (1 + 1e-11), stored=True)
in_column("typed number", "typed number", DEPTH, [40], lambda _f, _, v: float(f"{v * 1.005:.6g}"))


@fault("typed number, right value", "typed number")
def _(f: Foreign, values: Values) -> Mapping[Place, Any]:
    """The right number typed over a formula: wrong as soon as an input changes."""
    role = END if (END, 77) in f.where else START
    return {place: values[place] for place in _formulas(f, role, 77)}


@fault("odd formula", "odd formula")
def _(f: Foreign, _: Values) -> Mapping[Place, Any]:
    """A formula copied without moving its references: it reads the row before."""
    return dict(zip(_formulas(f, DEPTH, 52), _formulas(f, DEPTH, 51).values(), strict=True))


in_column("odd formula, factor", "odd formula", BRAKE, [33], lambda _f, t, _: f"=({t[1:]})*1.01")
in_column("typed constant, one cell", "typed constant", BRAKE, [45], _typed)
in_column("typed constant, column", "typed constant", BRAKE, [], _typed, near=2)


@fault("another order of operations", "")
def _(f: Foreign, _: Values) -> Mapping[Place, Any] | None:
    """The same product in another order, which changes last digits: that is no fault."""
    product = r"=(-?\(.*?\))\*PI\(\)\*(\(.*\))/([^/()]+)"
    texts = _formulas(f, BRAKE)
    if not f.si or not all(re.fullmatch(product, text) for text in texts.values()):
        return None
    return {p: re.sub(product, r"=\1/\3*(\2*PI())", text) for p, text in texts.items()}


@fault("no half step", "other scheme")
def _(f: Foreign, _: Values) -> Mapping[Place, Any]:
    """The first step as long as the others."""
    texts = _formulas(f, DEPTH, 1).items()
    old, new = "/2", ""
    if not any(old in text for _, text in texts):
        old, new = f"*{decimal(f.impact.step / 2)}", f"*{decimal(f.impact.step)}"
    return {place: text.replace(old, new, 1) for place, text in texts}


@fault("middle velocity", "other scheme", near=3)
def _(f: Foreign, _: Values) -> Mapping[Place, Any] | None:
    """The drag at the velocity in the middle of the step."""
    texts = _formulas(f, BRAKE)
    if {"A(x)", "force"} & set(f.cells.values()) or not f.si or (START, 1) not in f.where:
        return None
    step = decimal(f.impact.step)
    if place := f.inputs.get("step"):
        step = next(iter(_names(f, place)), ref(place, "$"))
    changes = {}
    for k, (place, text) in enumerate(texts.items(), 1):
        guarded = re.fullmatch(r"(=IF\(ISNUMBER\(\w+\),)(.*)(,\"\"\))", text)
        before, inner, after = guarded.groups() if guarded else ("=", text[1:], "")
        sign = "+" if inner.startswith("-") else "-"
        v = ref(f.where[START, k])
        middle = f"({v}{sign}({inner})*{step}/2)"
        changes[place] = before + re.sub(rf"(?<![\w$]){v}(?!\d)", middle, inner) + after
    return changes


@fault("explicit Euler", "other scheme", near=3)
def _(f: Foreign, _: Values) -> Mapping[Place, Any] | None:
    """The depth grows by the velocity of the row before.

    In row 2 the difference is still small, so it shows in row 2 or 3.
    """
    changes = {}
    for k, (place, text) in enumerate(_formulas(f, DEPTH, *range(2, f.steps + 1)).items(), 2):
        if (START, k) not in f.where:
            return None
        now, before = ref(f.where[START, k]), ref(f.where[START, k - 1])
        changes[place] = re.sub(rf"(?<![\w$]){now}(?!\d)", before, text)
    return changes


in_column("drag without 1/2", "other scheme", BRAKE, [],
          lambda _f, t, _: t.replace("0.5*", "", 1), near=2)  # fmt: skip


def early_stop(f: Foreign, _: Values) -> Planted | None:
    """The last nine rows are missing; cells that read the last row now read the new last one."""
    if not _formulas(f, DEPTH, 40) or f.name in ("guarded", "side-by-side"):
        return None
    if f.impact not in (BETA_3, BETA_5):
        return None  # an excerpt, for all that anybody can tell
    g = copy.deepcopy(f)
    gone = {place for (_, k), place in f.where.items() if k > f.steps - 9}
    g.where = {key: place for key, place in f.where.items() if place not in gone}
    last, now = (f.where[DEPTH, k] for k in (f.steps, f.steps - 9))
    gone |= _beside(f, f.steps - 8, f.steps)
    g.cells = {p: f"={ref(now)}" if c == f"={ref(last)}" else c
               for p, c in f.cells.items() if p not in gone}  # fmt: skip
    role = END if (END, 40) in f.where else START
    cells = (f.where[role, f.steps - 9],)
    return Planted(accusing("other scheme", cells), g)


FAULTS["stop at another velocity"] = early_stop


def _across(f: Foreign) -> bool:
    """Whether the table runs to the right."""
    return f.where[DEPTH, 1][1] == f.where[DEPTH, 2][1]


def _beside(f: Foreign, first: int, last: int) -> set[Place]:
    """All cells in some rows (or columns) of the table, except inputs."""
    low, high = f.where[DEPTH, first], f.where[DEPTH, last]
    along = 2 if _across(f) else 1
    return {
        p for p in f.cells if p[0] == low[0] and low[along] <= p[along] <= high[along]
        and p not in f.inputs.values()
    }  # fmt: skip


def _replaced(f: Foreign, pattern: str, to: str) -> Mapping[Place, Any]:
    """Rewrite the first formula outside the table that matches a pattern."""
    steps = [k for role, k in f.where if role == DEPTH]
    rows = _beside(f, min(steps), max(steps)) | set(f.where.values())
    texts = {p: c for p, c in f.cells.items() if isinstance(c, str) and p not in rows}
    # A row below the table may repeat its formulas; the drag's 0.5 tells it.
    formulas = {p: t for p, t in texts.items() if t.startswith("=") and "0.5*" not in t}
    changed = ((p, re.sub(pattern, to, text)) for p, text in formulas.items())
    return dict(next(([entry] for entry in changed if entry[1] != f.cells[entry[0]]), []))


for _name, _kind, _pattern, _to in (
    ("mass formula, pi typed", "typed constant", r"(4/3\*)PI\(\)|PI\(\)(/6)", r"\g<1>3.14\2"),
    ("wrong mass formula", "odd formula", r"4/3\*PI\(\)|PI\(\)/6", "4*PI()"),
    ("wrong diameter formula", "odd formula", r"^=2\*(\$?[A-Z]+\$?\d+)$", r"=\1"),
):
    fault(_name, _kind)(lambda f, _, p=_pattern, to=_to: _replaced(f, p, to))


@fault("wrong resistance formula", "odd formula")
def _(f: Foreign, _: Values) -> Mapping[Place, Any] | None:
    """The resistance is a sum where it should be a product."""
    if not {"beta", "flow_stress"} <= set(f.inputs) or f.name == "side-by-side":
        return None
    return _replaced(f, r"^=([A-Za-z_$]+\d*)\*([A-Za-z_$]+\d*)$", r"=\1+\2")


UNITS = (("µm", "mm"), ("(m)", "(mm)"), ("[m]", "[mm]"), ("in m", "in mm"), (" / m", " / mm"),
         ("nm", "µm"), ("mm", "µm"))  # fmt: skip


@fault("unit in a head", "unit")
def _(f: Foreign, _: Values) -> Mapping[Place, Any] | None:
    """A head that says millimetres over metres, or micrometres."""
    sheet, row, column = f.where[DEPTH, 1]
    for back in range(2, 5):
        head = (sheet, row, column - back) if _across(f) else (sheet, row - back, column)
        text = str(f.cells.get(head, ""))
        if text == "m":
            return {head: "mm"}
        for old, new in () if text.startswith("=") else UNITS:
            if re.search(rf"{re.escape(old)}(?!\w)", text):
                return {head: re.sub(rf"{re.escape(old)}(?!\w)", new, text)}
    return None


@fault("unit of an input", "unit")
def _(f: Foreign, _: Values) -> Mapping[Place, Any] | None:
    """A radius a thousand times too large, as if its cell were in millimetres."""
    place = f.inputs.get("radius")
    if place is None or not _formulas(f, DEPTH, 3) or f.impact not in (BETA_3, BETA_5):
        return None  # of other inputs nobody can tell
    return {place: float(f"{f.cells[place] * 1000:.12g}")}


def other_velocity(f: Foreign, _: Values) -> Planted | None:
    """Another impact velocity than the report's; all else is right."""
    place = f.inputs.get("velocity")
    if place is None or not _formulas(f, DEPTH, 3) or f.name == "guarded":
        return None
    if f.impact not in (BETA_3, BETA_5):
        return None
    g = made(f.name, replace(f.impact, velocity=450.0)) if f.name in BY_HAND else f
    if g.cells[g.inputs["velocity"]] != 450.0:
        return None  # its velocity is typed in another unit
    return Planted(CLEAN, g)


FAULTS["other input"] = other_velocity


@fault("misprint", ("printed number", "typed number", "odd formula"))
def _(f: Foreign, _: Values) -> Mapping[Place, Any] | None:
    """A final depth typed beside the table, with two digits swapped."""
    if f.impact != BETA_5 or f.name in ("side-by-side", "printed-digits"):
        return None
    for (sheet, row, column), text in f.cells.items():
        if str(text).startswith(("Endtiefe", "Final depth")):
            return {(sheet, row, column + 1): 7.76 if "µm" in str(text) else 7.76e-6}
    sheet, _, _ = f.where[DEPTH, 1]
    row = max(p[1] for p in f.cells if p[0] == sheet) + 3
    return {(sheet, row, 3): 7.76, (sheet, row, 2): "final depth (µm)"}
