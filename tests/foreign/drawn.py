"""Layouts drawn at random: their heads, units, order, places and helper columns."""

import random
from dataclasses import asdict
from typing import Any

from foreign.layouts import (
    BRAKE,
    DEPTH,
    END,
    START,
    TIME,
    Foreign,
    Table,
    letters,
    place,
)
from openpyxl.utils.cell import absolute_coordinate

from replication.models.impact import Impact

HELPERS = {"area": "A(x)", "energy": "E_kin", "n": "n"}

HEADS = {
    "time": (
        ("t", ""),
        ("Time", ""),
        ("time", "()"),
        ("Zeit", "[]"),
        ("temps", "()"),
        ("t", "[]"),
        ("t", "/"),
        ("Zeit", ""),
    ),
    "velocity_initial": (
        ("v_i", ""),
        ("dx/dt initial", ""),
        ("initial velocity", "()"),
        ("Anfangsgeschwindigkeit", "[]"),
        ("vitesse initiale", "()"),
        ("v alt", ""),
        ("speed at start", ","),
        ("v_start", "[]"),
    ),
    "depth": (
        ("x", ""),
        ("depth", "()"),
        ("Eindringtiefe", "[]"),
        ("profondeur de pénétration", "()"),
        ("penetration", ""),
        ("x", "in"),
        ("Tiefe", ""),
        ("enfoncement", "[]"),
    ),
    "deceleration": (
        ("a", ""),
        ("d²x/dt²", ""),
        ("deceleration", "()"),
        ("Verzögerung", "[]"),
        ("décélération", "()"),
        ("Bremsung", ""),
        ("acceleration", ""),
        ("a", "[]"),
    ),
    "velocity_final": (
        ("v_f", ""),
        ("dx/dt final", ""),
        ("final velocity", "()"),
        ("Endgeschwindigkeit", "[]"),
        ("vitesse finale", "()"),
        ("v neu", ""),
        ("speed at end", ","),
        ("v_end", "[]"),
    ),
}
"""Words, and how a unit follows them."""

UNITS = {
    "time": (("s", ""), ("ns", "1000000000"), ("µs", "1000000")),
    "depth": (("m", ""), ("µm", "1000000"), ("mm", "1000"), ("nm", "1000000000")),
    "deceleration": (("m/s²", ""), ("m/s^2", ""), ("km/s2", "0.001")),
}
"""Units of columns, each with the factor that brings a number in SI into it."""

LABELS = {
    "radius": ("R", "particle radius", "Radius", "rayon", "R_p", "Partikelradius"),
    "particle_density": (
        "density of particle",
        "rho_p",
        "Dichte Kupfer",
        "masse volumique Cu",
        "ρp",
    ),
    "target_density": ("density of target", "rho_t", "Dichte Stahl", "masse volumique cible", "ρt"),
    "velocity": ("V", "impact velocity", "Auftreffgeschwindigkeit", "vitesse d'impact", "v0"),
    "resistance": ("R_t", "target resistance", "Zielwiderstand", "résistance de la cible", "Rt"),
    "step": ("dt", "time step", "Zeitschritt", "pas de temps", "Δt"),
}

INPUT_UNITS = {
    "radius": (("m", ""), ("µm", "*0.000001"), ("mm", "/1000")),
    "particle_density": (("kg/m³", ""), ("g/cm³", "*1000"), ("kg/m3", "")),
    "target_density": (("kg/m³", ""), ("g/cm³", "*1000"), ("kg/m3", "")),
    "velocity": (("m/s", ""), ("km/s", "*1000")),
    "resistance": (("Pa", ""), ("GPa", "*1000000000"), ("MPa", "*1000000")),
    "step": (("s", ""), ("ns", "/1000000000"), ("ps", "/1000000000000")),
}
"""Units of inputs, each with what brings its number into SI."""


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
    table = Table(f, sheet, (left if across else top) + first, 0, f.steps, across)
    lines = {name: str(top + i * gap) if across else letters(left + i * gap)
             for i, name in enumerate(names)}  # fmt: skip
    for name, line in lines.items():
        words, how = r.choice(HEADS[name]) if name in HEADS else (HELPERS[name], "")
        unit = units[name][0] if name in units else ""
        f.cells[table.place(line, -first)] = (
            _headed(words, how, unit) if with_units == "head" else words
        )
        if with_units == "row" and unit:
            f.cells[table.place(line, 1 - first)] = unit
    negative = r.random() < 0.2
    for name, line in lines.items():
        rows = [
            _contents(
                lines, across, units, si, own(table.zero + k), own(table.zero + k - 1), negative
            )
            for k, own in ((k, letters if across else str) for k in (0, 1, 2))
        ]
        zero, first_, rest = (row[name][min(k, len(row[name]) - 1)] for k, row in enumerate(rows))
        table.column(line, "", name if name in order else "", zero, rest, first=first_)
    return f


def _headed(words: str, how: str, unit: str) -> str:
    """A head with its unit."""
    match how:
        case "()":
            return f"{words} ({unit})"
        case "[]":
            return f"{words} [{unit}]"
        case "/":
            return f"{words}/({unit})" if "/" in unit else f"{words}/{unit}"
        case "in":
            return f"{words} in {unit}"
        case ",":
            return f"{words}, {unit}"
    return words


def _contents(
    lines: dict[str, str], across: bool, units: dict[str, tuple[str, str]], si: dict[str, str],
    this: str, before: str, negative: bool,
) -> dict[str, tuple[Any, ...]]:  # fmt: skip
    """The contents of each line in a row: in row 0, in row 1, and in the rows that follow."""

    def cell(name: str, row: str = this) -> str:
        return f"{row}{lines[name]}" if across else f"{lines[name]}{row}"

    def inner(name: str, row: str = this) -> str:
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
        START: (start, start, f"={cell(END, before)}"),
        DEPTH: (0.0, outer(DEPTH, f"{moved}/2"), outer(DEPTH, f"{inner(DEPTH, before)}+{moved}")),
        "area": (None, f"=PI()*{area}"),
        BRAKE: (0.0, outer(BRAKE, f"{minus}{force}/{si['mass']}")),
        END: (None, f"={v}{plus}{inner(BRAKE)}*{si['step']}"),
        "energy": (energy, energy),
        "n": (0.0, 1.0, float),
    }
    if TIME in lines:
        contents[TIME] = (0.0, outer(TIME, f"{inner(TIME, before)}+{si['step']}"))
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
