"""Faults to plant in a foreign workbook, and where and as what each ought to be found."""

import copy
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from foreign.layouts import BRAKE, BY_HAND, DEPTH, END, START, Foreign, Place, letters, made

Values = dict[Place, Any]


@dataclass
class Planted:
    """A spoiled workbook: the kind that ought to be named, at which cell, or one of some cells."""

    fault: str
    kind: str
    workbook: Foreign
    cells: tuple[Place, ...]
    wrong: Values = field(default_factory=dict)
    status: int = 1


def ref(place: Place) -> str:
    return f"{letters(place[2])}{place[1]}"


def _changed(
    f: Foreign, fault: str, kind: str, changes: Mapping[Place, str | float],
    cells: Sequence[Place] = (), status: int = 1,
) -> Planted:  # fmt: skip
    """A copy with other contents; it ought to be named at one of `cells`, or the first changed."""
    g = copy.deepcopy(f)
    g.cells |= changes
    return Planted(fault, kind, g, tuple(cells) or (next(iter(changes)),), status=status)


def _formula(f: Foreign, role: str, k: int) -> str | None:
    place = f.where.get((role, k))
    content = f.cells.get(place) if place else None
    return content if isinstance(content, str) and content.startswith("=") else None


def stale_value(f: Foreign, values: Values) -> Planted | None:
    """One stored value is not what its formula gives."""
    if _formula(f, BRAKE, 60) is None:
        return None
    place = f.where[BRAKE, 60]
    wrong: Values = {place: values[place] * (1 + 1e-11)}
    return Planted("stale value", "stale value", f, (place,), wrong)


def typed_number(f: Foreign, values: Values) -> Planted | None:
    """A number over a formula, half a percent off."""
    if _formula(f, DEPTH, 40) is None:
        return None
    place = f.where[DEPTH, 40]
    typed = float(f"{values[place] * 1.005:.6g}")
    return _changed(f, "typed number", "typed number", {place: typed})


def typed_right_number(f: Foreign, values: Values) -> Planted | None:
    """The right number over a formula: wrong as soon as an input changes."""
    role = END if (END, 77) in f.where else START
    if _formula(f, role, 77) is None:
        return None
    place = f.where[role, 77]
    return _changed(f, "typed number, right value", "typed number", {place: values[place]})


def odd_formula(f: Foreign, _: Values) -> Planted | None:
    """A formula copied without its references moving: it reads the row before."""
    text = _formula(f, DEPTH, 52)
    before = _formula(f, DEPTH, 51)
    if text is None or before is None or text == before:
        return None
    return _changed(f, "odd formula", "odd formula", {f.where[DEPTH, 52]: before})


def odd_sign(f: Foreign, _: Values) -> Planted | None:
    """One formula with another factor in it."""
    text = _formula(f, BRAKE, 33)
    if text is None:
        return None
    odd = {f.where[BRAKE, 33]: f"=({text[1:]})*1.01"}
    return _changed(f, "odd formula, factor", "odd formula", odd)


def _constants(f: Foreign) -> list[tuple[str, str, str]]:
    """Inputs as a formula may name them: role, its reference, its value as typed."""
    result = []
    for role, place in f.inputs.items():
        cell, value = f"${letters(place[2])}${place[1]}", f"{f.cells[place]!r}"
        names = [name for name, meaning in f.names.items() if meaning.rpartition("!")[2] == cell]
        references = [cell, f"{place[0]}!{cell}", f"'{place[0]}'!{cell}", *names]
        result += [(role, reference, value) for reference in references]
    return sorted(result, key=lambda entry: -len(entry[1]))


def _typed(f: Foreign, text: str) -> str | None:
    for role, reference, value in _constants(f):
        if role in ("beta", "stop_velocity"):
            continue
        pattern = rf"(?<![\w$!']){re.escape(reference)}(?![\w$])"
        if re.search(pattern, text):
            number = f"{float(value):.15f}".rstrip("0").rstrip(".") if "e" in value else value
            return re.sub(pattern, number, text)
    return None


def typed_constant(f: Foreign, _: Values) -> Planted | None:
    """An input's value in place of its cell, in one formula."""
    text = _formula(f, BRAKE, 45)
    changed = _typed(f, text) if text else None
    if changed is None:
        return None
    typed = {f.where[BRAKE, 45]: changed}
    return _changed(f, "typed constant, one cell", "typed constant", typed)


def typed_column(f: Foreign, _: Values) -> Planted | None:
    """An input's value in place of its cell, in a whole column."""
    texts = {f.where[BRAKE, k]: text for k in range(1, f.steps + 1)
             if (text := _formula(f, BRAKE, k))}  # fmt: skip
    typed = {place: changed for place, text in texts.items() if (changed := _typed(f, text))}
    return _changed(f, "typed constant, column", "typed constant", typed) if typed else None


def operation_order(f: Foreign, _: Values) -> Planted | None:
    """The same product from its other end, which changes last digits."""
    changes = {}
    for k in range(1, f.steps + 1):
        text = _formula(f, BRAKE, k)
        match = re.fullmatch(r"=(-?\(.*?\))\*PI\(\)\*(\(.*\))/([^/()]+)", text or "")
        if match is None or not f.si:
            return None
        changes[f.where[BRAKE, k]] = f"={match[1]}/{match[3]}*({match[2]}*PI())"
    return _changed(f, "operation order", "operation order", changes, list(changes))


def no_half_step(f: Foreign, _: Values) -> Planted | None:
    """The first step as long as the others."""
    text = _formula(f, DEPTH, 1)
    if text is None:
        return None
    for half, whole in (("/2", ""), ("*0.0000000001", "*0.0000000002")):
        if text.count(half) >= 1:
            changed = text.replace(half, whole, 1)
            return _changed(f, "no half step", "other scheme", {f.where[DEPTH, 1]: changed})
    return None


def middle_velocity(f: Foreign, _: Values) -> Planted | None:
    """The drag at the velocity in the middle of the step."""
    helped = {"A(x)", "force"} & set(f.cells.values())
    if helped or not f.si:
        return None
    changes = {}
    for k in range(1, f.steps + 1):
        text = _formula(f, BRAKE, k)
        if text is None or (START, k) not in f.where:
            return None
        guarded = re.fullmatch(r"(=IF\(ISNUMBER\(\w+\),)(.*)(,\"\"\))", text)
        before, inner, after = guarded.groups() if guarded else ("=", text[1:], "")
        sign = "+" if inner.startswith("-") else "-"
        v = ref(f.where[START, k])
        middle = f"({v}{sign}({inner})*{_step(f)}/2)"
        changed = re.sub(rf"(?<![\w$]){v}(?!\d)", middle, inner)
        changes[f.where[BRAKE, k]] = f"{before}{changed}{after}"
    return _changed(f, "middle velocity", "other scheme", changes, list(changes)[:3])


def _step(f: Foreign) -> str:
    if "step" not in f.inputs:
        return "0.0000000002"
    place = f.inputs["step"]
    for name, meaning in f.names.items():
        if meaning.rpartition("!")[2] == f"${letters(place[2])}${place[1]}":
            return name
    return f"${letters(place[2])}${place[1]}"


def explicit_euler(f: Foreign, _: Values) -> Planted | None:
    """The depth moves on by the velocity of the row before."""
    changes = {}
    for k in range(2, f.steps + 1):
        text = _formula(f, DEPTH, k)
        if text is None or (START, k) not in f.where:
            return None
        now, before = ref(f.where[START, k]), ref(f.where[START, k - 1])
        changed = re.sub(rf"(?<![\w$]){now}(?!\d)", before, text)
        if changed == text:
            return None
        changes[f.where[DEPTH, k]] = changed
    # In row 2 the velocity of the row before is still nearly the same: row 2 or 3 shows it.
    return _changed(f, "explicit Euler", "other scheme", changes, list(changes)[:3])


def drag_without_half(f: Foreign, _: Values) -> Planted | None:
    """The factor 1/2 of the drag left out."""
    changes = {}
    for k in range(1, f.steps + 1):
        text = _formula(f, BRAKE, k)
        if text is None or "0.5*" not in text:
            return None
        changes[f.where[BRAKE, k]] = text.replace("0.5*", "", 1)
    return _changed(f, "drag without 1/2", "other scheme", changes)


def early_stop(f: Foreign, _: Values) -> Planted | None:
    """The last nine rows are missing."""
    if _formula(f, DEPTH, 40) is None or f.name in ("guarded", "side-by-side"):
        return None
    g = copy.deepcopy(f)
    for (role, k), place in f.where.items():
        if k > f.steps - 9:
            del g.cells[place]
            del g.where[role, k]
    for place in _beside(f, f.steps - 8, f.steps):
        g.cells.pop(place, None)
    for place, content in list(g.cells.items()):  # results that read the last row read the new one
        last = f.where[DEPTH, f.steps]
        if isinstance(content, str) and content == f"={ref(last)}":
            g.cells[place] = f"={ref(f.where[DEPTH, f.steps - 9])}"
    role = END if (END, 40) in f.where else START
    last = f.where[role, f.steps - 9]
    return Planted("stop at another velocity", "other scheme", g, (last,))


def _beside(f: Foreign, first: int, last: int) -> list[Place]:
    """Helpers in the same rows (or columns) of the table."""
    sheet, row, _ = f.where[DEPTH, 1]
    across = f.where[DEPTH, 2][1] == row
    low, high = f.where[DEPTH, first], f.where[DEPTH, last]
    along = 2 if across else 1
    return [
        p for p in f.cells if p[0] == sheet and low[along] <= p[along] <= high[along]
        and p not in f.inputs.values()
    ]  # fmt: skip


def wrong_head(f: Foreign, _: Values) -> Planted | None:
    """A head that says millimetres over metres, or micrometres."""
    place = f.where[DEPTH, 1]
    across = f.where[DEPTH, 2][1] == place[1]
    for back in range(1, 4):
        here = (place[0], place[1], place[2] - back - 1) if across else (
            place[0], place[1] - back - 1, place[2])  # fmt: skip
        text = f.cells.get(here)
        if isinstance(text, str) and not text.startswith("="):
            for old, new in (("µm", "mm"), ("(m)", "(mm)"), ("[m]", "[mm]"), ("in m", "in mm"),
                             (" / m", " / mm"), ("nm", "µm"), ("mm", "µm")):  # fmt: skip
                said = re.compile(re.escape(old) + r"(?!\w)")
                if said.search(text) or (text == old.strip("()[]") == "m"):
                    changed = said.sub(new, text) if said.search(text) else "mm"
                    return _changed(f, "unit in a head", "unit", {here: changed})
    return None


def wrong_unit_input(f: Foreign, _: Values) -> Planted | None:
    """The radius a thousand times too large, as if its cell were in millimetres."""
    place = f.inputs.get("radius")
    if place is None:
        return None
    value = f.cells[place]
    if not isinstance(value, float | int) or _formula(f, DEPTH, 3) is None:
        return None
    return _changed(f, "unit of an input", "unit", {place: float(f"{value * 1000:.12g}")})


def _beside_table(f: Foreign) -> dict[Place, str]:
    """Formulas that stand outside the rows of the table."""
    steps = [k for role, k in f.where if role == DEPTH]
    rows = {*_beside(f, min(steps), max(steps)), *f.where.values()}
    formulas = {p: c for p, c in f.cells.items() if isinstance(c, str) and c.startswith("=")}
    # A stray row below a table has the drag's 0.5 in it.
    return {p: text for p, text in formulas.items() if p not in rows and "0.5*" not in text}


def _changed_formulas(f: Foreign, fault: str, pattern: str, to: str) -> Planted | None:
    """The formulas beside the table that follow a pattern, otherwise; the first is named."""
    texts = {p: re.sub(pattern, to, text) for p, text in _beside_table(f).items()}
    changes = {place: text for place, text in texts.items() if text != f.cells[place]}
    return (
        _changed(f, fault, "odd formula", dict([next(iter(changes.items()))])) if changes else None
    )


def wrong_pi(f: Foreign, _: Values) -> Planted | None:
    """The mass with three digits of pi."""
    return _changed_formulas(
        f, "wrong mass formula, pi", r"(4/3\*)PI\(\)|PI\(\)(/6)", r"\g<1>3.14\2"
    )


def wrong_mass(f: Foreign, _: Values) -> Planted | None:
    """The mass with the square of the radius or without a third."""
    return _changed_formulas(f, "wrong mass formula", r"4/3\*PI\(\)|PI\(\)/6", "4*PI()")


def wrong_diameter(f: Foreign, _: Values) -> Planted | None:
    """The diameter is the radius."""
    return _changed_formulas(f, "wrong diameter formula", r"^=2\*(\$?[A-Z]+\$?\d+)$", r"=\1")


def wrong_resistance(f: Foreign, _: Values) -> Planted | None:
    """The resistance is a sum where it should be a product."""
    if not {"beta", "flow_stress"} <= set(f.inputs) or f.name == "side-by-side":
        return None
    return _changed_formulas(
        f, "wrong resistance formula", r"^=([A-Za-z_$]+\d*)\*([A-Za-z_$]+\d*)$", r"=\1+\2"
    )


def other_velocity(f: Foreign, _: Values) -> Planted | None:
    """Not the report's impact velocity, all else right."""
    place = f.inputs.get("velocity")
    if place is None or _formula(f, DEPTH, 3) is None or f.name == "guarded":
        return None
    g = made(f.name, replace(f.impact, velocity=450.0)) if f.name in BY_HAND else f
    if g.cells[g.inputs["velocity"]] != 450.0:
        return None  # its velocity is typed in another unit
    return Planted("other input", "other input", g, (g.inputs["velocity"],), status=0)


def misprint(f: Foreign, _: Values) -> Planted | None:
    """A final depth typed beside the table, with two digits swapped."""
    if f.impact.beta != 5 or f.name in ("side-by-side", "printed-digits"):
        return None
    labels = [p for p, t in f.cells.items() if str(t).startswith(("Endtiefe", "Final depth"))]
    if labels:
        sheet, row, column = labels[0]
        unit = 1 if "µm" in str(f.cells[labels[0]]) else 1e-6
        changes: dict[Place, str | float] = {(sheet, row, column + 1): 7.76 * unit}
    else:
        sheet, _, _ = f.where[DEPTH, 1]
        row, column = max(p[1] for p in f.cells if p[0] == sheet) + 3, 2
        changes = {(sheet, row, column + 1): 7.76, (sheet, row, column): "final depth (µm)"}
    return _changed(f, "misprint", "printed number", changes)


FAULTS: tuple[Callable[[Foreign, Values], Planted | None], ...] = (
    stale_value, typed_number, typed_right_number, odd_formula, odd_sign, typed_constant,
    typed_column, operation_order, no_half_step, middle_velocity, explicit_euler,
    drag_without_half, early_stop, wrong_pi, wrong_mass, wrong_diameter, wrong_resistance,
    wrong_head, wrong_unit_input, other_velocity, misprint,
)  # fmt: skip
