"""Layouts drawn at random: their heads, units, order, places and helper columns."""

import random
import re
import tomllib
from dataclasses import asdict
from pathlib import Path

from foreign.layouts import (
    BRAKE,
    DEPTH,
    END,
    START,
    TIME,
    Foreign,
    Table,
    add_column,
    letters,
    place,
)
from openpyxl.utils.cell import absolute_coordinate

from replication.models.impact import Impact

HELPERS = {"area": "A(x)", "energy": "E_kin", "n": "n"}
TABLES = tomllib.loads(Path(__file__).with_name("drawn.toml").read_text("utf-8"))
HEADS, UNITS, LABELS, INPUT_UNITS = TABLES.values()


def drawn(seed: int, impact: Impact) -> Foreign:
    """The workbook of a seed: all of it is drawn, except what it calculates."""
    r = random.Random(seed)
    f = Foreign(f"random-{seed}", impact, si=False)
    sheet = r.choice(["Sheet1", "Tabelle1", "Feuil1", "sim", "my sheet", "v=500"])
    data = sheet if r.random() < 0.7 else "Inputs"
    across = r.random() < 0.2
    top, left = r.randrange(12, 30), r.randrange(1, 5)
    with_units = r.choice(["head", "row", "none"])
    simple = with_units == "none"
    si = _inputs(f, r, data, simple)
    prefix = "" if data == sheet else f"{data}!"
    si = {name: cell.replace("$", f"{prefix}$", 1) for name, cell in si.items()}
    order = [TIME, START, DEPTH, BRAKE, END]
    if r.random() < 0.3:
        order.remove(TIME)
    if r.random() < 0.4:
        r.shuffle(order)
    helpers = [h for h in HELPERS if r.random() < 0.3]
    names = order + helpers
    if "n" in helpers and r.random() < 0.5:
        names = ["n", *[name for name in names if name != "n"]]
    gap = 2 if r.random() < 0.15 else 1
    units = {role: r.choice(UNITS[role]) if role in UNITS and not simple
             else UNITS.get(role, [("m/s", "")])[0] for role in order}  # fmt: skip
    first = 2 if with_units == "row" else 1
    table = Table((left if across else top) + first, 0, f.steps, across, own=True)
    lines = {name: str(top + i * gap) if across else letters(left + i * gap)
             for i, name in enumerate(names)}  # fmt: skip
    for name, line in lines.items():
        head = r.choice(HEADS[name]) if name in HEADS else HELPERS[name]
        unit = units[name][0] if name in units else ""
        if with_units != "head":
            head = re.sub(r" \(UNIT\)| \[UNIT\]|/UNIT| in UNIT|, UNIT", "", head)
        bracketed = f"({unit})" if "/UNIT" in head and "/" in unit else unit
        f.cells[table.place(sheet, line, -first)] = head.replace("UNIT", bracketed)
        if with_units == "row" and unit:
            f.cells[table.place(sheet, line, 1 - first)] = unit
    for name, texts in _contents(lines, across, units, si, negative=r.random() < 0.2).items():
        add_column(f, sheet, table, lines[name], "", name if name in order else "", *texts)
    return f


def _contents(
    lines: dict[str, str], across: bool, units: dict[str, tuple[str, str]], si: dict[str, str],
    negative: bool,
) -> dict[str, tuple[str, ...]]:  # fmt: skip
    """The contents of each line: in row 0, in the rows that follow, and in row 1 if special."""

    def cell(name: str, row: str = "{r}") -> str:
        return f"{row}{lines[name]}" if across else f"{lines[name]}{row}"

    def inner(name: str, row: str = "{r}") -> str:
        """A formula for the value of a cell in SI units."""
        factor = units[name][1]
        return f"{cell(name, row)}/{factor}" if factor else cell(name, row)

    def outer(name: str, text: str) -> str:
        """A formula for a value in the unit of a line."""
        factor = units[name][1]
        return f"=({text})*{factor}" if factor else f"={text}"

    minus, plus = ("-", "+") if negative else ("", "-")
    v, x, moved = cell(START), inner(DEPTH), f"{cell(START)}*{si['step']}"
    area = f"(2*{si['radius']}*({x})-({x})^2)"
    contact = cell("area") if "area" in lines else f"PI()*{area}"
    force = f"(0.5*{si['target_density']}*{v}^2+{si['resistance']})*{contact}"
    start, energy = f"={si['velocity']}", f"=0.5*{si['mass']}*{v}^2"
    contents = {
        START: (start, f"={cell(END, '{p}')}", start),
        DEPTH: ("0", outer(DEPTH, f"{inner(DEPTH, '{p}')}+{moved}"), outer(DEPTH, f"{moved}/2")),
        "area": ("", f"=PI()*{area}"),
        BRAKE: ("0", outer(BRAKE, f"{minus}{force}/{si['mass']}")),
        END: ("", f"={v}{plus}{inner(BRAKE)}*{si['step']}"),
        "energy": (energy, energy),
        "n": ("{k}", "{k}"),
    }
    if TIME in lines:
        contents[TIME] = ("0", outer(TIME, f"{inner(TIME, '{p}')}+{si['step']}"))
    return {name: contents[name] for name in lines}


def _inputs(f: Foreign, r: random.Random, sheet: str, simple: bool) -> dict[str, str]:
    """Write the inputs, and return for each the absolute reference to its value in SI units."""
    row, col = r.randrange(1, 3), r.randrange(1, 8)
    beside = r.random() < 0.5
    flat = not beside and r.random() < 0.4 and not simple
    order = list(LABELS)
    r.shuffle(order)
    values = asdict(f.impact) | {"resistance": f.impact.target_resistance}
    si = {}

    def at(i: int) -> tuple[str, str]:
        """The cell of a label, and the cell that it labels."""
        if flat:
            return f"{letters(col + i)}{row}", f"{letters(col + i)}{row + 1}"
        return f"{letters(col)}{row + i}", f"{letters(col + 1)}{row + i}"

    for i, name in enumerate(order):
        unit, conversion = INPUT_UNITS[name][0] if simple else r.choice(INPUT_UNITS[name])
        factor = float(conversion[1:] or 1)
        own = values[name] * factor if conversion[:1] == "/" else values[name] / factor
        (label, cell), text = at(i), r.choice(LABELS[name])
        f.put(sheet, label, text if simple or beside else f"{text} [{unit}]")
        if beside and not simple:
            f.put(sheet, f"{letters(col + 2)}{row + i}", unit)
        f.put(sheet, cell, float(f"{own:.12g}"))
        f.inputs[name] = place(sheet, cell)
        absolute = absolute_coordinate(cell)
        si[name] = f"({absolute}{conversion})" if conversion else absolute
    label, mass = at(7)
    f.put(sheet, label, "mass [kg]")
    f.put(sheet, mass, f"={si['particle_density']}*4/3*PI()*{si['radius']}^3")
    return si | {"mass": absolute_coordinate(mass)}
