"""What `coldspray check` says of right and of spoiled workbooks, for a person to read.

    python tests/foreign/said.py > tests/foreign/said.txt

makes the file anew that `tests/replication/test_check_said.py` compares. Whoever changes what the
program says reads what that changes there, line by line, before keeping it. Numbers are shown with
seven digits at most, so that no machine's last digits are in it.
"""

import re
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent.parent))

from foreign import faults, layouts, writers
from foreign.drawn import drawn
from foreign.layouts import BY_HAND, Content, Foreign, Place, changed, plain

from replication.cases import BETA_3, BETA_5
from replication.check import show
from replication.check.diff import diff
from replication.check.record import check_record, diff_record
from replication.check.workbook import check
from replication.models.impact import Impact
from spreadsheets.foreign import WorkbookError

COARSE = replace(BETA_5, step=5e-10)
"""The report's other step: 53 rows, so that many workbooks take little time."""
Cells = Mapping[str, Content]


# ---- the workbooks


def right(layout: Callable[..., Foreign]) -> Iterator[str]:
    yield from whole(layout(BETA_5))


def right_beta_3() -> Iterator[str]:
    for layout in (layouts.table_a1, layouts.french, layouts.one_velocity, layouts.pasted):
        yield from whole(layout(BETA_3))


def right_drawn() -> Iterator[str]:
    for seed in (1, 3, 4, 7, 8, 11):
        yield from whole(drawn(seed, COARSE))


SPOILED = (
    "table_a1", "french", "sideways", "one_velocity", "no_time", "german", "velocity_at_end",
    "merged_heads", "natural_units", "no_deceleration", "named_everything", "named_constants",
)  # fmt: skip
"""Layouts that faults are planted in, each in three or those that can have it."""


def planted(plant: Callable[..., faults.Planted | None]) -> Iterator[str]:
    """One fault in two layouts, another two for the next fault."""
    number, done = faults.FAULTS.index(plant), 0
    for i in range(len(SPOILED)):
        f = made(SPOILED[(5 * number + i) % len(SPOILED)])
        if plant is faults.operation_order and any("^" in str(c) for c in f.cells.values()):
            continue  # which may differ in the last digit from machine to machine
        values = Values(f)
        spoiled = plant(f, values)
        if spoiled is not None:
            done += 1
            yield from said(f"in {f.name}", spoiled.workbook, f, values, spoiled.wrong)
        if done == 2:
            return


def plainly(cells: Mapping[str, Cells], impact: Impact = COARSE) -> Iterator[str]:
    """A plain sheet with some cells changed."""
    for title, change in cells.items():
        yield from said(title, changed(plain(impact), change), plain(impact))


INPUTS: dict[str, Cells] = {
    "nothing changed": {},
    "densities swapped": {"B2": 7850, "E1": 8900},
    "radius and diameter swapped": {"B1": 22e-6, "B4": "=B1/2"},
    "impact velocity of another case": {"B5": 403},
    "impact velocity in km/s": {"B5": 0.5},
    "radius in um": {"B1": 11},
    "radius in mm": {"B1": 0.011},
    "density in g/cm3": {"B2": 8.9},
    "target density in g/cm3": {"E1": 7.85},
    "time step in ns": {"E2": 0.5},
    "flow stress in MPa": {"H2": 700},
    "label of the density in g/cm3, the formulas take kg/m3": {"A2": "Density [g/cm³] ="},
    "label of the radius in mm, the formulas take m": {"A1": "R [mm] ="},
    "label of the target density in g/cm3, its formulas converting": {
        "D1": "target density [g/cm³]", "E1": 7.85,
        "E9:": "=(0.5*$E$1*1000*C{r}^2+$B$6)*PI()*($B$4*D{r}-D{r}^2)/$B$3"},
    "resistance typed": {"B6": 3.5e9},
    "resistance typed, of other digits": {"B6": 3.6e9},
    "resistance without beta and flow stress": {"B6": 3.5e9, "G1": None, "G2": None,
                                                "H1": None, "H2": None},
    "resistance of constants": {"B6": "=5*7e8", "G1": None, "G2": None, "H1": None, "H2": None},
    "resistance of blank cells": {"B6": "=J1*J2", "G1": None, "G2": None, "H1": None, "H2": None},
    "resistance of other cells": {"B6": "=J1*J2"},
    "resistance a sum": {"B6": "=H1+H2"},
    "resistance in kPa": {"B6": "=H1*H2/1000"},
    "beta 4": {"H1": 4},
    "beta 3": {"H1": 3},
    "beta 2.9": {"H1": 2.9},
    "resistance near that of beta 3": {"B6": 2.2e9, "G1": None, "G2": None, "H1": None, "H2": None},
    "resistance in MPa": {"B6": "=5*700", "G1": None, "G2": None, "H1": None, "H2": None},
    "beta and flow stress swapped": {"G1": "Yt", "G2": "beta"},
    "flow stress 403 MPa": {"H2": 403e6},
    "mass without a third": {"B3": "=4*PI()*B1^3*B2"},
    "mass of the target's density": {"B3": "=4/3*PI()*B1^3*E1"},
    "mass with the square of the radius": {"B3": "=4/3*PI()*B1^2*B2"},
    "mass with pi 3.14": {"B3": "=4/3*3.14*B1^3*B2"},
    "mass of the diameter": {"B3": "=4/3*PI()*B4^3*B2"},
    "mass in g": {"B3": "=4/3*PI()*B1^3*B2*1000"},
    "mass typed, the right digits": {"B3": 4.96e-11},
    "mass typed, another": {"B3": 5.1e-11},
    "mass typed, no density": {"B3": 4.96e-11, "A2": None, "B2": None},
    "mass typed, another, no density": {"B3": 5.1e-11, "A2": None, "B2": None},
    "mass of the radius alone, no density": {
        "B3": "=4/3*PI()*B1^3*8900", "A2": None, "B2": None},
    "mass of zero": {"B3": "=0*B2"},
    "resistance of beta alone": {"B6": "=H1*7E8", "G2": None, "H2": None},
    "impact velocity typed into two rows": {"C8": 500, "C9": 500},
    "diameter the radius": {"B4": "=B1"},
    "diameter typed": {"B4": 22e-6},
    "diameter typed, another": {"B4": 20e-6},
    "other velocity and radius": {"B5": 450, "B1": 10e-6},
    "target density 8000": {"E1": 8000},
    "time step 1 ns": {"E2": 1e-9},
    "time step 0.4 ns": {"E2": 4e-10},
    "time step 0.2 ns, with the rows for 0.5 ns": {"E2": 2e-10},
    "time step in ns, which its label says and the formulas convert": {
        "D2": "dt [ns]", "E2": 0.5, "A10:": "=A{p}+$E$2*1E-9", "A9": "=$E$2*1E-9",
        "D9": "=C9*$E$2*1E-9/2", "D10:": "=D{p}+C{r}*$E$2*1E-9", "F9:": "=C{r}-E{r}*$E$2*1E-9"},
    "unit of the time step between its label and its number": {
        "C2": "dt", "D2": "ns", "E2": 0.5, "A10:": "=A{p}+$E$2*1E-9", "A9": "=$E$2*1E-9",
        "D9": "=C9*$E$2*1E-9/2", "D10:": "=D{p}+C{r}*$E$2*1E-9", "F9:": "=C{r}-E{r}*$E$2*1E-9"},
    "labels at the right of the numbers": {
        "A1": None, "A2": None, "A5": None, "C1": "R", "C2": "Density particle", "C5": "V"},
    "label above its number, a unit below": {"D1": None, "D2": None, "E1": "density of target",
        "E2": 7850, "E3": "kg/m³", "L4": "dt", "L5": 5e-10, "L6": "s",
        "A9:": "=A{p}+$L$5", "D9": "=C9*$L$5/2", "D10:": "=D{p}+C{r}*$L$5",
        "E9:": "=(0.5*$E$2*C{r}^2+$B$6)*PI()*($B$4*D{r}-D{r}^2)/$B$3", "F9:": "=C{r}-E{r}*$L$5"},
    "no labels": {f"{letter}{row}": None for letter in "ADG" for row in range(1, 7)},
    "another radius labelled, which nothing reads": {"J1": "particle radius", "K1": 12e-6},
    "half the time step typed into the first row": {"D9": "=D8+C9*0.00000000025"},
    "the stop typed into a guard, though it has a cell": {
        "D3": "stop velocity", "E3": 1, "C10:": '=IF(F{p}<1,"",F{p})'},
    "time step labelled by a word unknown": {"D2": "tau"},
    "stop velocity in a cell": {"D3": "stop velocity", "E3": 1},
    "stop velocity in a cell, 50 m/s": {"D3": "stop velocity", "E3": 50},
    "impact velocity typed into the first row": {"C8": 500},
    "impact velocity typed into two rows, another": {"C8": 450, "C9": 450},
    "resistance in the rows, not of its cell": {
        "B6": 2.1e9, "G1": None, "G2": None, "H1": None, "H2": None,
        "E9:": "=(0.5*$E$1*C{r}^2+3.5E9)*PI()*($B$4*D{r}-D{r}^2)/$B$3"},
    "target density in the rows, not of its cell": {
        "E9:": "=(0.5*7850*C{r}^2+$B$6)*PI()*($B$4*D{r}-D{r}^2)/$B$3"},
    "time step in the rows, not of its cell": {"D10:": "=D{p}+C{r}*0.0000000005"},
    "radius negative": {"B1": -11e-6},
    "radius zero": {"B1": 0},
    "impact velocity a text": {"B5": "500 m/s"},
    "impact velocity blank": {"B5": None},
    "density a text": {"B2": "8900 kg/m3"},
}  # fmt: skip

CELLS: dict[str, Cells] = {
    **{f"{content!r} in {cell}": {cell: content}
       for content, cells in (
           ("abc", "A8 A9 A20 C9 C20 C60 D9 D20 D60 E20 E60 F9 F20"), (True, "A9 D20 E20 F60"),
           (None, "A9 A20 C8 C9 C60 D9 D20 E9 E20 E60 F9 F20 F61"), ("=1/0", "D20 B4"),
           ("=NoName*2", "E20"), ("=D20+1", "D20"), ("=NA()", "F20"), ("=[1]S!A1", "D20"),
           (400, "C9 C20 E20"), (1e308, "E20"), (-1, "D20"), (0, "D20 F20"), (" ", "F9"))
       for cell in cells.split()},
    "first velocity ten times too large": {"C8": "=B5*10"},
    "depth of row 12 a thousand times too large": {"D20": "=(D19+C20*$E$2)*1000"},
    "first depth a thousand times too large": {"D9": "=D8+C9*$E$2/2*1000"},
    "first depth a third of a step": {"D9": "=D8+C9*$E$2/3"},
    "velocity of row 12 from the row before the last": {"C20": "=F18"},
    "velocity of row 12 a percent more": {"C20": "=F19*1.01"},
    "deceleration of row 12 with all inputs typed": {
        "E20": "=(0.5*7850*C20^2+3500000000)*PI()*($B$4*D20-D20^2)/$B$3"},
    "deceleration with the wrong sign of x² in row 12": {
        "E20": "=(0.5*$E$1*C20^2+$B$6)*PI()*($B$4*D20+D20^2)/$B$3"},
    "deceleration of rows 12 to 14 another": {
        "E20": "=(0.5*$E$1*C20^2+$B$6)*PI()*($B$4*D20)/$B$3",
        "E21": "=(0.5*$E$1*C21^2+$B$6)*PI()*($B$4*D21)/$B$3",
        "E22": "=(0.5*$E$1*C22^2+$B$6)*PI()*($B$4*D22)/$B$3"},
    "time of row 12 with the step typed": {"A20": "=A19+0.0000000005"},
    "times at the beginning of the rows": {"A9": 0},
    "times in ns under a head without a unit": {"A10:": "=A{p}+$E$2*1E9", "A9": "=$E$2*1E9"},
    "two faults": {"F40": 300, "E20": 5e9},
    "three faults, of three kinds": {"D20": "=D18+C20*$E$2", "E30": 6e8, "B3": "=4*PI()*B1^3*B2"},
    "a row gone": {f"{letter}20": None for letter in "ACDEF"},
}  # fmt: skip

DRAG, AREA = "0.5*$E$1*C{r}^2", "$B$4*D{r}-D{r}^2"


def force(drag: str = DRAG, area: str = AREA) -> str:
    return f"=({drag}+$B$6)*PI()*({area})/$B$3"


COLUMNS: dict[str, Cells] = {
    "no half step": {"D9": "=D8+C9*$E$2"},
    "no first step": {"D9": 0},
    "depth by the row before": {"D10:": "=D{p}+C{p}*$E$2"},
    "depth by the mean of the row before": {"D10:": "=D{p}+(C{p}+F{p})/2*$E$2"},
    "depth by half steps": {"D10:": "=D{p}+C{r}*$E$2/2"},
    "depth by 1.1 steps": {"D10:": "=D{p}+C{r}*$E$2*1.1"},
    "depth by a typed step of another length": {"D10:": "=D{p}+C{r}*0.0000000004"},
    "depth without its conversion": {"D10:": "=D{p}+C{r}*$E$2*1000"},
    "depth by a square": {"D10:": "=D{p}+C{r}^2*$E$2/500"},
    "depth by the velocity at the end, force of the row before": {
        "D10:": "=D{p}+F{r}*$E$2", "E9:": force(area="$B$4*D{p}-D{p}^2")},
    "depth by the mean velocity, force of the row before": {
        "D10:": "=D{p}+(C{r}+F{r})/2*$E$2", "E9:": force(area="$B$4*D{p}-D{p}^2")},
    "no drag": {"E9:": force(drag="0*$E$1*C{r}^2")},
    "no drag, nor its density": {"E9:": "=$B$6*PI()*($B$4*D{r}-D{r}^2)/$B$3"},
    "drag without 1/2": {"E9:": force(drag="$E$1*C{r}^2")},
    "drag with the particle's density": {"E9:": force(drag="0.5*$B$2*C{r}^2")},
    "drag at the impact velocity": {"E9:": force(drag="0.5*$E$1*$B$5^2")},
    "drag at the row before": {"E9:": force(drag="0.5*$E$1*C{p}^2")},
    "drag in the middle of the step": {
        "E9:": force(drag="0.5*$E$1*(C{r}-" + force()[1:] + "*$E$2/2)^2")},
    "drag with a cube": {"E9:": force(drag="0.5*$E$1*C{r}^3/500")},
    "area without x²": {"E9:": force(area="$B$4*D{r}")},
    "area with R for D": {"E9:": force(area="$B$1*D{r}-D{r}^2")},
    "area of the whole sphere": {"E9:": force(area="$B$1^2")},
    "force of the row before": {"E9:": force(area="$B$4*D{p}-D{p}^2")},
    "force with pi 3.14": {"E9:": force().replace("PI()", "3.14")},
    "force doubled": {"E9:": force() + "*2"},
    "force of 4/3": {"E9:": force() + "*4/3"},
    "force a thousandth": {"E9:": force() + "/1000"},
    "force from row 2 on another": {"E10:": force(area="$B$4*D{r}")},
    "velocity by half steps": {"F9:": "=C{r}-E{r}*$E$2/2"},
    "velocity by energy": {"F9:": "=SQRT(MAX(C{r}^2-2*E{r}*(D{r}-D{p}),0))"},
    "velocity by double steps": {"F9:": "=C{r}-E{r}*$E$2*2"},
    "velocity grows": {"F9:": "=C{r}+E{r}*$E$2"},
    "two rules of others": {"D9": "=D8+C9*$E$2", "E9:": force(drag="$E$1*C{r}^2")},
    "negative deceleration": {"E9:": "=-" + force()[1:], "F9:": "=C{r}+E{r}*$E$2"},
    "negative deceleration, one number typed": {
        "E9:": "=-" + force()[1:], "F9:": "=C{r}+E{r}*$E$2", "E20": -7e8},
    "no column of final velocity": {"F9:": None, "F7": None, "C10:": "=C{p}-E{p}*$E$2"},
    "no column of deceleration": {
        "E9:": None, "E8": None, "E7": None, "F9:": "=C{r}-" + force()[1:] + "*$E$2"},
    "no column of deceleration, drag without 1/2": {
        "E9:": None, "E8": None, "E7": None,
        "F9:": "=C{r}-" + force(drag="$E$1*C{r}^2")[1:] + "*$E$2"},
    "no times": {"A7:": None},
    "no heads": {f"{letter}7": None for letter in "ACDEF"},
    "no heads, a deceleration at the mean velocity nearer to the depth": {
        **{f"{letter}7": None for letter in "ACDEF"},
        "E9:": force(drag="0.5*$E$1*((C{r}+F{r})/2)^2"), "H8": 0, "H9:": force(),
        "F9:": "=C{r}-H{r}*$E$2"},
    "no heads, and the depth again in um and over the radius": {
        **{f"{letter}7": None for letter in "ACDEF"},
        "G8:": "=D{r}*1E6", "H8:": "=D{r}/$B$1"},
    "no times, the step typed into the formulas": {
        "A7:": None, "D2": None, "E2": None, "D9": "=C9*0.0000000005/2",
        "D10:": "=D{p}+C{r}*0.0000000005", "F9:": "=C{r}-E{r}*0.0000000005"},
    "heads of the velocities swapped": {"C7": "dx/dt final", "F7": "dx/dt initial"},
    "heads five rows above": {
        f"{letter}{row}": None if row == 7 else head
        for letter, head in zip("ACDEF", ("t", "v1", "x", "a", "v2"), strict=True)
        for row in (7, 3) if letter not in "DE"},
    "heads of other quantities": {"A7": "energy", "E7": "force"},
    "no row of the impact": {f"{c}8": None for c in "ACDE"} | {
        "C9": "=B5", "D9": "=C9*$E$2/2", "A9": "=$E$2"},
    "zeros after the end": {f"{c}{row}": 0 for c in "CDEF" for row in range(61, 66)},
    "the last row again and again": {
        f"{c}{row}": f"={c}{row - 1}" for c in "ACDEF" for row in range(61, 66)},
    "a velocity in the middle of the step, beside the table": {
        "G7": "v_half", "G9:": "=C{r}-E{r}*$E$2/2"},
    "a mean velocity without a head": {"G9:": "=(C{r}+F{r})/2"},
    "velocities typed, rounded": {"F9:": "=ROUND(C{r}-E{r}*$E$2,6)"},
    "head of the depth in mm": {"D7": "x [mm]"},
    "head of the deceleration in km/s²": {"E7": "d²x/dt² [km/s²]"},
    "head of the time in ns": {"A7": "Time [ns]"},
    "depth in um, its head in um": {
        "D7": "x [µm]", "D9": "=C9*$E$2/2*1E6", "D10:": "=D{p}+C{r}*$E$2*1E6",
        "E9:": force(area="$B$4*D{r}*1E-6-(D{r}*1E-6)^2")},
}  # fmt: skip

LAST_DIGITS: dict[str, tuple[str, str, str]] = {
    "depth": (layouts.DEPTH, "=G{p}+F{r}*delta_t", "=(G{p}/delta_t+F{r})*delta_t"),
    "velocity": (layouts.END, "=F{r}-H{r}*delta_t", "=F{r}*(1-H{r}*delta_t/F{r})"),
    "deceleration": (layouts.BRAKE, "*PI()*(", "*(PI()*1)*("),
}


def last_digits() -> Iterator[str]:
    """Other orders of operations; without powers, which differ from machine to machine."""
    for title, (role, old, new) in LAST_DIGITS.items():
        f = layouts.french(BETA_5)
        for k in range(2, f.steps + 1):
            place = f.where[role, k]
            names = {"r": place[1], "p": place[1] - 1}
            text = str(f.cells[place])
            f.cells[place] = text.replace(old.format(**names), new.format(**names))
        yield from said(f"of the {title}", f, layouts.french(BETA_5))
    f = layouts.french(BETA_5)
    f.put("Données", "C13", "=rayon*rayon*rayon*PI()*4/3*rho_p")
    yield from said("of the mass", f, layouts.french(BETA_5))


FAST = replace(COARSE, velocity=800.0)


def stops() -> Iterator[str]:
    """Rows that end too soon or too late, and depths beyond the radius."""
    for rows in (3, 4, 20, 26, 27, 44, 51, 52, 53, 54, 60):
        yield from said(f"{rows} rows", plain(COARSE, rows), plain(COARSE))
    yield from said("403 m/s in rows for 500", changed(plain(COARSE), {"B5": 403}), plain(COARSE))
    yield from said("521 m/s in rows for 500", changed(plain(COARSE), {"B5": 521}), plain(COARSE))
    blank = {f"{letter}55:": None for letter in "ACDEF"}
    stop = {"D3": "stop velocity", "E3": 50}
    yield from said(
        "stop at 50 m/s, where its cell says so",
        changed(plain(COARSE), blank | stop),
        plain(COARSE),
    )
    yield from said("beyond the radius, the area shrinks", plain(FAST), plain(COARSE))
    area = "IF(D{r}<$B$1,$B$4*D{r}-D{r}^2,$B$1^2)"
    yield from said("beyond the radius, as it should be",
                    changed(plain(FAST), {"E9:": force(area=area)}), plain(COARSE))  # fmt: skip
    doubled = force(drag="$E$1*C{r}^2", area=area)
    yield from said(
        "beyond the radius, drag without 1/2", changed(plain(FAST), {"E9:": doubled}), plain(COARSE)
    )


def digits() -> Iterator[str]:
    """Numbers without formulas: printed digits, typed ones, those of other schemes and inputs."""
    for layout, role, k, content in (
        (layouts.printed_digits, layouts.BRAKE, 3, 1.55e9),
        (layouts.printed_digits, layouts.END, 1, 497.0),
        (layouts.printed_digits, layouts.DEPTH, 4, 3.94e-7),
        (layouts.printed_digits, layouts.BRAKE, 3, 700.0),
        (layouts.printed_digits, layouts.TIME, 2, 5e-10),
        (layouts.six_digits, layouts.DEPTH, 60, 5.5),
        (layouts.six_digits, layouts.START, 131, 1.2),
        (layouts.pasted, layouts.DEPTH, 60, 5.5e-6),
        (layouts.pasted, layouts.END, 100, 7.0),
    ):
        f = layout(BETA_5)
        f.cells[f.where[role, k]] = content
        yield from said(f"{role} {k} is {content:g} in {f.name}", f, layout(BETA_5))
    for impact in (replace(BETA_5, beta=4.2), replace(BETA_5, velocity=430.0),
                   replace(BETA_5, radius=8e-6), COARSE):  # fmt: skip
        for layout in (layouts.pasted, layouts.six_digits)[: 1 + (impact.radius == BETA_5.radius)]:
            f = layout(impact)
            inputs = (
                f"{impact.target_resistance:g} Pa, {impact.velocity:g} m/s, "
                f"{impact.radius:g} m, {impact.step:g} s"
            )
            yield from said(f"{f.name} of other inputs: {inputs}", f, layout(BETA_5))
    f = layouts.pasted(BETA_5)
    texts = {p: f"{v:.6g}".replace(".", ",") for p, v in f.cells.items() if isinstance(v, float)}
    f.cells |= texts
    yield from said("numbers as text, with commas", f)


def several() -> Iterator[str]:
    """More than one table, other sheets, and none."""
    f = layouts.side_by_side(BETA_5)
    f.cells["beta 3 and 5", 30, 10] = 400.0
    yield from said("a velocity of the right table typed", f)
    f = layouts.side_by_side(BETA_5)
    f.cells["beta 3 and 5", 3, 2] = 8.9
    yield from said("the density of both tables in g/cm3", f)
    f = plain(COARSE)
    for row in range(9, 62):
        f.put("View", f"A{row}", f"=Sheet1!C{row}")
        f.put("View", f"B{row}", f"=Sheet1!D{row}")
    yield from said("a second sheet that shows the first", f)
    f = Foreign("budget", BETA_5)
    for row in range(1, 90):
        f.put("Budget", f"A{row}", f"item {row}")
        f.put("Budget", f"B{row}", 1000.0 - row * row % 17)
    yield from said("a budget", f)
    f = layouts.no_time(BETA_5)
    f.cells["impact", 60, 5] = 1.2e-10
    yield from said("a typed area beside the table", f)
    f = layouts.no_time(BETA_5)
    for row in range(6, 6 + f.steps):
        f.cells["impact", row, 5] = str(f.cells["impact", row, 5]).replace("PI()", "3.14")
    yield from said("3.14 for pi in the areas beside the table", f)
    f = layouts.table_a1(BETA_5)
    layouts.moved(f, lambda r: r + (r >= 50) + 2 * (r >= 90), lambda c: c)
    yield from said("blank rows that the formulas step over", f)
    f = layouts.pasted(COARSE)
    for row, value in ((1, 11e-6), (2, 12e-6)):
        f.line("Sheet1", f"H{row}", "particle radius (m)", value)
    yield from said("two radii beside bare numbers", f, layouts.pasted(COARSE))
    for row in (3, 20):
        f = layouts.sideways(COARSE)
        f.cells["Sheet 1", 13, row] = 1e-6
        yield from said(f"a depth in column {layouts.letters(row)} of a table to the right", f)


def given() -> Iterator[str]:
    """What --map says."""
    columns = {"depth": "Sheet1!AC510:AC641", "velocity": "AB510:AB641", "target_density": "T503"}
    yield from said("--map of what it is", layouts.no_words(BETA_5), given=columns)
    f = changed(plain(COARSE), {f"{letter}7": None for letter in "ACDEF"})
    f.name = "plain, without heads"
    yield from said(
        "--map of the velocity at the end, no heads", f, f, given={"velocity": "F9:F60"}
    )
    for name, where in (
        ("radius", "B1"), ("radius", "B4"), ("depth", "D8:D61"), ("depth", "A8:A61"),
        ("velocity_initial", "C8:C61"), ("velocity_final", "C8:C61"), ("velocity", "F9:F61"),
        ("deceleration", "E9:E61"), ("radius", "C8:C61"), ("depth", "B1"), ("step", "A1"),
        ("deep", "D8:D61"), ("depth", "D8:D10"), ("time", "Nowhere!A1"), ("velocity", "A8:C61"),
    ):  # fmt: skip
        yield from said(f"--map {name}={where}", plain(COARSE), plain(COARSE), given={name: where})


def in_full() -> Iterator[str]:
    """All that is printed of some."""
    yield from whole(changed(plain(COARSE), CELLS["three faults, of three kinds"]))
    yield from whole(changed(plain(COARSE), INPUTS["densities swapped"]))
    yield from whole(changed(plain(BETA_5), {"E1": 8000, "B5": 450, "B1": 10e-6}))
    yield from whole(changed(plain(BETA_5), {"D9": "=D8+C9*$E$2", "E9": 3.11e8}))
    yield from whole(changed(plain(COARSE), {f"F{row}": 300 for row in range(20, 58, 2)}))


CHANGES: dict[str, Callable[[Foreign], object]] = {
    "nothing": lambda f: None,
    "an input": lambda f: changed(f, {"B5": 450}),
    "last digits, and an input": lambda f: changed(f, {"B1": 11e-6 * (1 + 4e-15), "E1": 8000}),
    "a formula": lambda f: changed(f, {"D60": "=D59+C60*$E$2*1.1"}),
    "a column of formulas": lambda f: changed(f, {"F9:": "=C{r}-E{r}*$E$2/2"}),
    "a number over a formula, a formula over a number": lambda f: changed(
        f, {"D30": 1e-6, "B4": 22e-6, "E1": "=7*1000"}),
    "a text over a number, a head, a blank": lambda f: changed(
        f, {"E2": "0.5 ns", "D7": "depth", "A1": None}),
    "three rows inserted": lambda f: layouts.moved(f, lambda r: r + 3 * (r >= 7), lambda c: c),
    "a column inserted": lambda f: layouts.moved(f, lambda r: r, lambda c: c + 2 * (c >= 4)),
    "a block elsewhere": lambda f: changed(
        f, {"G1": None, "H1": None, "G2": None, "H2": None, "J4": "beta", "K4": 5, "J5": "Yt",
            "K5": 7e8, "B6": "=K4*K5"}),
    "notes beside": lambda f: changed(f, {"H20": "note", "H21": 3, "J30": "another"}),
    "a sheet more": lambda f: f.put("Notes", "A1", "hello"),
    "the sheet renamed": lambda f: setattr(
        f, "cells", {("Tabelle1", r, c): v for (_, r, c), v in f.cells.items()}),
}  # fmt: skip


def compared() -> Iterator[str]:
    """What `coldspray diff` says of two."""
    with tempfile.TemporaryDirectory() as folder:
        before = writers.with_openpyxl(plain(COARSE), Path(folder, "a.xlsx"))
        for title, change in CHANGES.items():
            f = plain(COARSE)
            change(f)
            record = diff_record(diff(before, writers.with_openpyxl(f, Path(folder, "b.xlsx"))))
            yield f"* {title} -> {int(not record['clean'])}"
            yield from (f"  {_shown(line)}" for line in show.text(record).split("\n")[1:] if line)


# ---- what is said of them


def made(name: str) -> Foreign:
    return next(layout for layout in BY_HAND if layout.__name__ == name)(BETA_5)


class Values(dict[Place, Any]):
    """What the formulas of a workbook give, calculated once somebody asks."""

    def __init__(self, f: Foreign) -> None:
        super().__init__()
        self.f = f

    def __missing__(self, place: Place) -> Any:
        with tempfile.TemporaryDirectory() as folder:
            self.update(writers.calculated(self.f, Path(folder, "plain.xlsx")))
        return self[place]


def record_of(f: Foreign, given: Mapping[str, str], values: Values | None = None,
              wrong: writers.Values | None = None) -> dict[str, Any] | str:  # fmt: skip
    """What is found out about a workbook; or why nothing is."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "book.xlsx")
        if wrong:
            writers.with_xlsxwriter(f, path, values or {}, wrong)
        else:
            writers.with_openpyxl(f, path)
        try:
            return check_record(check(path, given))
        except (ValueError, WorkbookError) as error:
            return str(error).removeprefix(f"{path}: ").replace(str(path), "FILE")


def whole(f: Foreign) -> Iterator[str]:
    """All that a user reads about a workbook."""
    record = record_of(f, {})
    assert isinstance(record, dict)
    yield f"* {f.name} -> {int(not record['clean'])}"
    lines = show.text(record).split("\n")[1:]
    yield from (f"  {_shown(line)}".rstrip() for line in lines if line)


MOST = 7
"""Differences of one workbook that are shown."""


def said(
    title: str, f: Foreign, like: Foreign | None = None, values: Values | None = None,
    wrong: writers.Values | None = None, given: Mapping[str, str] | None = None,
) -> Iterator[str]:  # fmt: skip
    """The answer in few lines: status, verdict, every difference, what was taken for what.

    Of this only what is otherwise in a workbook that it is `like`.
    """
    record = record_of(f, given or {}, values, wrong)
    if isinstance(record, str):
        yield from (f"* {title} -> 2", f"  {_shown(record)}")
        return
    yield f"* {title} -> {int(not record['clean'])}"
    yield f"  {_shown(record['verdict'])}"
    told = [
        d
        for d in record["differences"]
        if d["kind"] != "printed number" and "no value is stored" not in d["explanation"]
    ]
    for d in told[:MOST]:
        yield f"  {'first: ' if d == record['first'] else ''}{_difference(d)}"
    if len(told) > MOST:
        yield f"  and {len(told) - MOST} more"
    for depth in record["final_depths"]:
        own, right = (_um(depth[name]) for name in ("found", "expected"))
        why = f", by {depth['explained_by']} alone" if depth["explained_by"] else ""
        yield f"  depth {own}, right {right}{why}; {depth['differing']} cells differ"
    if claims := record["claims"]:
        unmet = [f"{c['cell']} {_number(c['found'])} for {c['printed']}"
                 for c in claims if not c["met"]]  # fmt: skip
        not_so = f"; not {', '.join(unmet)}" if unmet else ""
        yield f"  {len(claims) - len(unmet)} of {len(claims)} printed numbers{not_so}"
    before = _taken(like) if like else [[]]
    for taken, usual in zip(_taken_of(record), before * len(record["taken"]), strict=False):
        here = {entry.partition(" ")[0] for entry in taken}
        gone = [role for entry in usual[1:] if (role := entry.partition(" ")[0]) not in here]
        other = [entry for entry in taken if entry not in usual] + [f"no {role}" for role in gone]
        if other:
            yield f"  taken: {', '.join(other)}"


_RIGHT: dict[tuple[str, Impact], list[list[str]]] = {}


def _taken(f: Foreign) -> list[list[str]]:
    """What is taken for what in a right workbook."""
    if (f.name, f.impact) not in _RIGHT:
        record = record_of(f, {})
        assert isinstance(record, dict)
        _RIGHT[f.name, f.impact] = list(_taken_of(record))
    return _RIGHT[f.name, f.impact]


def _taken_of(record: Mapping[str, Any]) -> Iterator[list[str]]:
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
    holds = f"{_shown(line)}{_apart(d['found'], d['expected'])}; " if (line := show.held(d)) else ""
    return f"{d['cell']}{cells}, {d['kind']}: {holds}{_shown(d['explanation'])}{effect}"


def _apart(found: object, expected: object) -> str:
    """How far apart two numbers are that look the same here."""
    if not isinstance(found, float) or not isinstance(expected, float) or found == expected:
        return ""
    off = found / expected - 1 if expected else 1.0
    return f" ({off:+.0e} of it)" if _number(found) == _number(expected) else ""


def _um(depth: float | None) -> str:
    return "unknown" if depth is None else f"{_number(depth * 1e6)} um"


def _number(value: float) -> str:
    return f"{value:.7g}"


def _shown(text: str) -> str:
    """A text with seven digits of each number, and blanks that no longer depend on their number."""
    text = re.sub(
        r"(?<![\w.])\d+\.\d+(?:[eE][-+]?\d+)?(?!\w)", lambda m: _number(float(m[0])), text
    )
    return re.sub(r"(?<=\S)  +", "  ", text)


SECTIONS: dict[str, Callable[[], Iterator[str]]] = {
    **{f"right: {layout.__name__}": partial(right, layout) for layout in BY_HAND},
    "right: beta 3": right_beta_3,
    "right: drawn": right_drawn,
    **{f"planted: {plant.__name__}": partial(planted, plant) for plant in faults.FAULTS},
    "plain sheet: inputs": partial(plainly, INPUTS),
    "plain sheet: cells": partial(plainly, CELLS),
    "plain sheet: columns": partial(plainly, COLUMNS),
    "plain sheet: the stop": stops,
    "last digits": last_digits,
    "numbers without formulas": digits,
    "several tables, and none": several,
    "what is where, as the user says": given,
    "in full": in_full,
    "two workbooks side by side": compared,
}


def section(name: str) -> str:
    """A section of the file."""
    return "\n".join([f"## {name}", *SECTIONS[name](), "", ""])


if __name__ == "__main__":
    print(__doc__)
    for name in SECTIONS:
        print(section(name), end="")
