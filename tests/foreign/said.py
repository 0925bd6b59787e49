"""What `coldspray check` says of right and of spoiled workbooks, for a person to read.

    python tests/foreign/said.py > tests/foreign/said.txt

makes the file anew that `tests/replication/test_check_said.py` compares. Whoever changes what the
program says reads what that changes there, line by line, before keeping it. Numbers are shown with
seven digits at most, so that no machine's last digits are in it.
"""

import math
import random
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
from replication.check.diff import Comparison, Tolerance, diff
from replication.check.examination import KINDS
from replication.check.scheme import KNOWN, REPORT, Case, march
from replication.check.show import check_record, diff_record
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
    for layout in (
        layouts.table_a1, layouts.french, layouts.one_velocity, layouts.pasted,
        layouts.no_deceleration,
    ):  # fmt: skip
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
    "target density in g/cm3, labelled so, not converted": {
        "D1": "target density [g/cm³]", "E1": 7.85},
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
    "mass in g, labelled kg": {"A3": "M [kg] =", "B3": "=4/3*PI()*B1^3*B2*1000"},
    "mass in mg, labelled kg, no density": {
        "A2": None, "B2": None, "A3": "M [kg] =", "B3": 4.96e-5},
    "mass in mg, no density": {"A2": None, "B2": None, "B3": 4.96e-5},
    "mass labelled twice": {"J1": "mass", "K1": 5e-11},
    "diameter in um, no radius": {"A1": None, "B1": None, "B4": 22, "B3": 4.962e-11},
    "diameter in um, labelled m, no radius": {
        "A1": None, "B1": None, "A4": "D [m]", "B4": 22, "B3": "=PI()/6*B4^3*B2"},
    "diameter 24 um, no radius": {"A1": None, "B1": None, "B4": 24e-6, "B3": "=PI()/6*B4^3*B2"},
    "two resistances read": {"J1": "Rt", "K1": 3.6e9, "B6": "=H1*H2+0*K1"},
    "two resistances read, no beta": {"J1": "Rt", "K1": 3.6e9, "B6": "=3.5E9+0*K1", "G1": None,
                                      "H1": None, "G2": None, "H2": None},
    "two time steps, one for the times": {"D3": "time step", "E3": 1e-9, "A9:": "=A{p}+$E$3"},
    "two radii read, near to each other": {"J1": "R", "K1": 11.00001e-6, "B4": "=B1+K1"},
    "two radii read, one to no effect": {"J1": "R", "K1": 12e-6, "B4": "=2*B1+0*K1"},
    "target density zero": {"E1": 0},
    "target density negative": {"E1": -7850},
    "impact velocity zero": {"B5": 0},
    "impact velocity negative": {"B5": -500},
    "time step negative": {"E2": -5e-10},
    "beta zero": {"H1": 0},
    "beta negative": {"H1": -5},
    "beta and its flow stress of others": {"H1": 4, "H2": 8.75e8},
    "flow stress in ksi": {"G2": "Yt [ksi]", "H2": 101.5264, "B6": "=H1*H2*6894757"},
    "flow stress in ksi, its factor of few digits": {
        "G2": "Yt [ksi]", "H2": 101.5264, "B6": "=H1*H2*6.895E6"},
    "radius in inches": {"A1": "R [in] =", "B1": 0.000433, "B4": "=2*B1*0.0254",
                         "B3": "=4/3*PI()*(B1*0.0254)^3*B2"},
    "radius in um, its label, its formulas converting": {
        "A1": "R [µm] =", "B1": 11, "B4": "=2*B1*1E-6", "B3": "=4/3*PI()*(B1*1E-6)^3*B2"},
    "impact velocity in km/s, labelled so": {"A5": "V [km/s]", "B5": 0.5, "C8": "=B5*1000"},
    "impact velocity in km/s, labelled so, not converted": {"A5": "V [km/s]", "B5": 0.5},
    "resistance in GPa, labelled so": {
        "A6": "Rt [GPa]", "B6": "=H1*H2/1E9",
        "E9:": "=(0.5*$E$1*C{r}^2+$B$6*1E9)*PI()*($B$4*D{r}-D{r}^2)/$B$3"},
    "resistance in GPa, labelled so, not converted": {"A6": "Rt [GPa]", "B6": "=H1*H2/1E9"},
    "target density in the rows of another input": {
        "E9:": "=(0.5*8000*C{r}^2+$B$6)*PI()*($B$4*D{r}-D{r}^2)/$B$3"},
    "time step in the rows, twice that of its cell": {"D10:": "=D{p}+C{r}*0.000000001"},
    "radius in half of the rows": {
        f"E{row}": f"=(0.5*$E$1*C{row}^2+$B$6)*PI()*(2*0.000011*D{row}-D{row}^2)/$B$3"
        for row in range(9, 61, 2)},
    "radius in a few of the rows": {
        f"E{row}": f"=(0.5*$E$1*C{row}^2+$B$6)*PI()*(2*0.000011*D{row}-D{row}^2)/$B$3"
        for row in range(20, 61, 9)},
    "stop velocity typed into guards, another than its cell": {
        "D3": "stop velocity", "E3": 1, "C10:": '=IF(F{p}<2,"",F{p})'},
    "stop velocity zero": {"D3": "stop velocity", "E3": 0},
    "stop velocity in two cells": {"D3": "stop velocity", "E3": 1, "G3": "stop velocity", "H3": 2},
    "pi in a cell": {"G3": "pi", "H3": 3.14159265358979, "E9:": "=(0.5*$E$1*C{r}^2+$B$6)"
                     "*$H$3*($B$4*D{r}-D{r}^2)/$B$3", "B3": "=4/3*H3*B1^3*B2"},
    "labels above the numbers": {
        "A1": None, "A2": None, "A5": None, "J1": "R", "K1": "rho_p", "L1": "V",
        "J2": 11e-6, "K2": 8900, "L2": 500, "B1": "=J2", "B2": "=K2", "B5": "=L2"},
    "labels of two cells, units two cells to the right": {
        "A1": "R", "C1": "m", "A2": "density", "C2": "kg/m3", "D2": "step", "F2": "s"},
    "labels of another input beside": {"A1": "R | particle", "A2": "copper", "D1": "steel"},
}  # fmt: skip

CELLS: dict[str, Cells] = {
    **{f"{content!r} in {cell}": {cell: content}
       for content, cells in (
           ("abc", "A8 A9 A20 C9 C20 C60 D9 D20 D60 E20 E60 F9 F20"), (True, "A9 D20 E20 F60"),
           (None, "A9 A20 C8 C9 C60 D9 D20 E9 E20 E60 F9 F20 F61"), ("=1/0", "D20 B4"),
           ("=NoName*2", "E20"), ("=D20+1", "D20"), ("=NA()", "F20"), ("=[1]S!A1", "D20"),
           (400, "C9 C20 E20"), (1e308, "E20"), (-1, "D20"), (0, "D20 F20"), (" ", "F9"),
           ("=1/0", "D9 E9 F60 A9 A60"), ("=[1]S!A1", "E60"), (1e120, "C20"), ("abc", "C8 D8 E8"),
           (None, "E60 A60 D60"), (0.0, "A9 C9 E9 F9"), (True, "C9 E9 F9"), ("", "D20"))
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
    "four rows gone": {f"{letter}{row}": None for letter in "ACDEF" for row in range(20, 24)},
    "times of three shapes": {
        f"A{row}": (f"=A{row - 1}+$E$2", f"=$E$2+A{row - 1}", f"=A{row - 1}+1*$E$2")[row % 3]
        for row in range(9, 61)},
    "times by the number of the row, typed": {
        f"A{row}": f"={row - 8}*$E$2" for row in range(9, 61)},
    "times by the number of the row, one wrong": {
        f"A{row}": f"={row - 8 + (row == 30)}*$E$2" for row in range(9, 61)},
    "a velocity of every other row typed": {f"F{row}": 300 for row in range(10, 60, 2)},
    "formulas of 90 and of 91 characters": {
        f"E{row}": f"=0.{'0' * zeros}+(0.5*$E$1*C{row}^2+$B$6)*PI()*($B$4*D{row}-D{row}^2)/$B$3"
        for row, zeros in ((20, 38), (40, 39))},
    "a counter beside, an error in it": {
        "H8": 0, "H9:": "=H{p}+1", "H30": "=1/0"},
    "a typed counter beside, without times, a text in it": {
        **{f"A{row}": None for row in range(7, 62)}, **{f"H{row}": row - 8 for row in range(8, 61)},
        "H30": "abc"},
    "energies beside, one typed, another reading it": {
        "H7": "energy", "H8": 0, "H9:": "=0.5*$B$3*C{r}^2", "I9:": "=H{r}*2", "H30": 1e-6,
        "I40": "=H40*3", "D45": 6e-6},
    "the area beside, one of another formula": {
        "H7": "area", "H9:": "=PI()*($B$4*D{r}-D{r}^2)", "H30": "=PI()*($B$4*D30+D30^2)",
        "E9:": "=(0.5*$E$1*C{r}^2+$B$6)*H{r}/$B$3"},
    "the area beside, a text in it": {
        "H7": "area", "H9:": "=PI()*($B$4*D{r}-D{r}^2)", "H30": "abc",
        "E9:": "=(0.5*$E$1*C{r}^2+$B$6)*H{r}/$B$3"},
    "the area beside, a blank in it": {
        "H7": "area", "H9:": "=PI()*($B$4*D{r}-D{r}^2)", "H30": None,
        "E9:": "=(0.5*$E$1*C{r}^2+$B$6)*H{r}/$B$3"},
    "the area beside, without x²": {
        "H7": "area", "H9:": "=PI()*$B$4*D{r}", "E9:": "=(0.5*$E$1*C{r}^2+$B$6)*H{r}/$B$3"},
    "the area beside, pi typed": {
        "H7": "area", "H9:": "=3.1416*($B$4*D{r}-D{r}^2)",
        "E9:": "=(0.5*$E$1*C{r}^2+$B$6)*H{r}/$B$3"},
    "a label of the final depth, two cells to the right": {"J3": "final depth", "L3": "=D60"},
    "a label of the final depth in um, below": {"J3": "final depth", "J4": "=D60*1E6"},
    "labels of both results": {
        "J3": "final depth", "K3": "=D60*1E6", "J4": "x/R", "K4": "=D60/B1", "J5": "x/R",
        "K5": "=K3"},
    "a label of the final depth, no number beside": {"J3": "final depth", "K3": "see below"},
    "a label of the ratio, zero": {"J4": "x/R", "K4": 0, "J5": "final depth", "K5": 0},
    "results of rows that do not end": {
        **{f"{letter}50:": None for letter in "ACDEF"}, "J3": "final depth", "K3": "=D49*1E6",
        "J4": "x/R", "K4": "=D49/B1"},
    "results typed": {"J3": "final depth [µm]", "K3": 7.67, "J4": "x/R", "K4": 0.697},
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
    "zeros after the end, no heads": {
        **{f"{c}{row}": 0 for c in "CDEF" for row in range(61, 66)},
        **{f"{letter}7": None for letter in "ACDEF"}},
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
    yield from said(
        "a hair beyond the radius", plain(replace(COARSE, velocity=712.0)), plain(COARSE)
    )
    yield from said("60 rows of 4 ps", plain(replace(COARSE, step=4e-12), 60), plain(COARSE))
    for step, rows in ((7e-9, None), (4e-11, None), (6e-12, 30)):
        f = plain(replace(BETA_5, step=step), rows)
        yield from said(f"steps of {step:g} s", f, plain(COARSE))
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


def halves() -> Iterator[str]:
    """What exactly half of the rows do: of 52 rows, or of those after the first of 51."""
    half, whole, shorter = range(10, 60, 2), plain(COARSE), plain(COARSE, 51)
    doubled = force(drag="$E$1*C{r}^2")
    typed = force(drag="0.5*7850*C{r}^2")
    for title, f, cells in (
        ("times of two shapes", shorter, {f"A{r}": f"=$E$2+A{r - 1}" for r in half}),
        ("times typed", shorter, {f"A{r}": (r - 8) * 5e-10 for r in half}),
        ("drag without 1/2", whole, {f"E{r}": doubled.format(r=r) for r in (*half, 60)}),
        ("drag without 1/2, and one row more", whole,
         {f"E{r}": doubled.format(r=r) for r in (9, *half, 60)}),
        ("the target density typed", shorter, {f"E{r}": typed.format(r=r) for r in range(34, 60)}),
        ("the target density typed, but for one row", shorter,
         {f"E{r}": typed.format(r=r) for r in range(35, 60)}),
        ("velocities not those before", whole, {f"C{r}": f"=F{r - 1}*1.001" for r in (*half, 60)}),
    ):  # fmt: skip
        yield from said(title, changed(replace(f, cells=dict(f.cells)), cells), plain(COARSE))


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
    case = Case(**BETA_5.motion, step=BETA_5.step)
    report = march(case)
    for part, rules in KNOWN.items():
        f = layouts.six_digits(BETA_5)
        rows = march(case, replace(REPORT, **{part: rules[1]}), steps=f.steps)
        for (role, k), place in f.where.items():
            if isinstance(content := f.cells[place], float) and report.get(role, {}).get(k):
                unit = 10.0 ** round(math.log10(content / report[role][k]))
                f.cells[place] = float(f"{rows[role][k] * unit:.6g}")
        yield from said(f"six digits of {rules[1].name}", f, layouts.six_digits(BETA_5))
    f = layouts.six_digits(BETA_5)
    for role, k in ((layouts.DEPTH, 60), (layouts.START, 61), (layouts.BRAKE, 131)):
        f.cells.pop(f.where[role, k])
    yield from said("blank cells among six digits", f, layouts.six_digits(BETA_5))
    f = layouts.pasted(COARSE)
    for place in [place for (role, _), place in f.where.items() if role == layouts.TIME]:
        del f.cells[place]
    del f.cells[f.where[layouts.DEPTH, 30]]
    yield from said("a blank depth where no times stand", f, layouts.pasted(COARSE))
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
    f = Foreign("steady", COARSE)
    f.line("Sheet1", "A1", "t [s]", "x [m]", "v [m/s]")
    for row in range(2, 30):
        f.line("Sheet1", f"A{row}", row * 1e-9, row * 5e-7, 500.0)
    yield from said("a steady motion", f)
    f = Foreign("decay", COARSE)
    for row in range(1, 20):
        f.line("Sheet1", f"A{row}", 100 * 0.9**row, 50 * 0.9**row, -5 * 0.9**row)
    f.cells["Sheet1", 20, 1] = 200.0
    yield from said("what decays, and jumps up at the end", f)
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
    f = layouts.table_a1(BETA_5)
    layouts.moved(f, lambda r: r + 4 * (r >= 50), lambda c: c)
    yield from said("four blank rows that the formulas step over", f)
    for above in (6, 7):
        f = plain(COARSE)
        layouts.moved(f, lambda r, below=above - 1: r + below * (r >= 8), lambda c: c)  # type: ignore[misc]
        yield from said(f"heads {above} rows above the numbers", f)
    f = layouts.pasted(COARSE)
    for row, value in ((1, 11e-6), (2, 12e-6)):
        f.line("Sheet1", f"H{row}", "particle radius (m)", value)
    yield from said("two radii beside bare numbers", f, layouts.pasted(COARSE))
    for row in (3, 20):
        f = layouts.sideways(COARSE)
        f.cells["Sheet 1", 13, row] = 1e-6
        yield from said(f"a depth in column {layouts.letters(row)} of a table to the right", f)
    f = layouts.named_constants(BETA_3)
    f.cells["Sheet", 202, 6] = 700
    yield from said("700 typed below the end, all inputs names", f, layouts.named_constants(BETA_3))


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
        ("depth", "B1:B6"), ("depth", "E8:E61"), ("depth", "D:D"), ("depth", "D8:D900"),
        ("depth", "D10:D40"), ("radius", "B4:B5"), ("velocity", "B5"), ("step", "H1"),
        ("stop_velocity", "H1"), ("beta", "H2"), ("mass", "B1"), ("depth", "A9:F9"),
        ("depth", 61 * "D"),
    ):  # fmt: skip
        yield from said(f"--map {name}={where}", plain(COARSE), plain(COARSE), given={name: where})


CONTENTS: tuple[Content, ...] = (
    None, 0, -1, 3, 1e-6, 1e15, 450, True, "x", "v [mm]", "dt", "(m)", "µm", "0,5", "=1/0",
    "=2+3", "={c}*2", "={c}-{c}", "=1000*{c}",
)  # fmt: skip
"""What is written over cells drawn at random; {c} is another cell of the sheet."""


def at_random() -> Iterator[str]:
    """Drawn layouts with contents written over one input or head and over two other cells."""
    for seed in range(100, 126):
        r = random.Random(seed)
        f = drawn(seed, COARSE) if seed % 4 else made(SPOILED[seed // 4 % len(SPOILED)])
        like = replace(f, cells=dict(f.cells))
        outside = [place for place in f.cells if place not in f.where.values()]
        told = []
        for places in (outside, list(f.cells), list(f.where.values())):
            here, another = r.choice(places), r.choice(places)
            there = f"'{another[0]}'!{layouts.letters(another[2])}{another[1]}"
            content = r.choice(CONTENTS)
            if isinstance(content, str):
                content = content.format(c=there)
            told.append(f"{content!r} in {here[0]}!{layouts.letters(here[2])}{here[1]}")
            if content is None:
                f.cells.pop(here, None)
            else:
                f.cells[here] = content
        yield from said(f"{f.name}: {', '.join(told)}", f, like)


def pages() -> Iterator[str]:
    """The sheets as the page draws them, and the file for machines that run tests."""
    yield from page(changed(plain(COARSE), CELLS["three faults, of three kinds"]))
    f = layouts.french(COARSE)
    f.cells |= {f.where[layouts.DEPTH, 30]: 1e-6, ("Données", 4, 3): 9000}
    yield from page(f)
    f = changed(plain(COARSE), {f"F{row}": 300 for row in range(10, 60, 2)})
    f.name = "larger than what is drawn"
    for i in range(1, 421):
        f.put("Sheet1", f"A{80 + i}", f"note {i}")
    for i in range(10, 60):
        f.cells["Sheet1", 1 + i % 3, i] = True
    f.cells["Sheet1", 300, 50] = "=1+1"
    f.put("More", "A1", "nothing to see")
    yield from page(f, {("Sheet1", 300, 50): 3.0})


def page(f: Foreign, wrong: writers.Values | None = None) -> Iterator[str]:
    """Which rows and columns the page draws, what it marks there; then the other file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "book.xlsx")
        if wrong:
            values = writers.calculated(f, Path(folder, "plain.xlsx"))
            writers.with_xlsxwriter(f, path, values, wrong)
        else:
            writers.with_openpyxl(f, path)
        result = check(path)
    record = check_record(result) | {"file": "FILE"}
    yield f"* {f.name}"
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


def named() -> Iterator[str]:
    """What --map says where two sheets could be meant; names that are no numbers."""
    f = layouts.no_words(COARSE)
    for (_, row, column), content in list(f.cells.items()):
        f.cells["Second", row, column] = content
    yield from said("--map of one of two sheets", f, given={"depth": "AC510:AC561"})
    yield from said("--map of the second sheet", f, given={"depth": "Second!AC510:AC561"})
    f = layouts.named_constants(BETA_5)
    f.names |= {"far": "1E999", "tau": "0.0000000002", "half": "0.5", "Rt_": "3.6E9"}
    yield from said("names beside", f, layouts.named_constants(BETA_5))


def stored() -> Iterator[str]:
    """Values stored that the formulas do not give."""
    for title, wrong in STORED.items():
        f = changed(plain(COARSE), {"J1": "=B1>0", "J2": '="a"&"b"', "J3": "=D60*2", "J4": "=1/0"})
        f.name = "plain, with results"
        values, last = Values(f), layouts.place("Sheet1", "F60")
        values.update({last: values[last]})
        told = {
            layouts.place("Sheet1", cell): by(float(values[layouts.place("Sheet1", cell)]))
            if callable(by) else by
            for cell, by in wrong.items()
        }  # fmt: skip
        yield from said(title, f, f, values, told)


STORED: dict[str, Mapping[str, Any]] = {
    "numbers of a block": {f"D{row}": 1e-6 for row in range(20, 30)},
    "a number, two apart": {"D20": 1e-6, "D22": 1e-6},
    "a text, a truth value, an error": {"D20": "abc", "D30": True, "D40": "#N/A"},
    "other truth values, texts, errors": {"J1": False, "J2": "ac", "J4": 3.0},
    "a result beside": {"J3": 1e-5},
    "an input that follows": {"B3": 5e-11},
    "last digits of a depth": {"D30": lambda v: v * (1 + 6e-15)},
    "more than the last digits of a depth": {"D60": lambda v: v * (1 + 4e-14)},
    "what rounding leaves of a velocity": {"F60": lambda v: v + 2e-12},
    "more than rounding leaves of a velocity": {"F60": lambda v: v + 2e-11},
    "rounding in what reads a column": {"J3": lambda v: v * (1 + 5e-14)},
}
"""Cells, and what is stored in them or made of what they give."""


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
    "a row inserted among the others": lambda f: layouts.moved(
        f, lambda r: r + (r >= 30), lambda c: c),
    "rows and columns inserted, and an input": lambda f: layouts.moved(
        changed(f, {"E2": 4e-10}), lambda r: r + 2 * (r >= 3) + (r >= 40), lambda c: c + (c >= 3)),
    "functions in small letters": lambda f: changed(f, {"B3": "=4/3*pi()*B1^3*B2"}),
    "other numbers, names and lengths of formulas": lambda f: changed(
        f, {"B3": "=5/3*PI()*B1^3*B2", "B4": "=2*B1+0", "B6": "=SUM(H1)*H2"}),
    "formulas that read other cells, blank ones, too": lambda f: changed(
        f, {"B4": "=2*B2", "B6": "=H1*H3", "E20": force().format(r=20).replace("$B$3", "B$3")}),
    "a reference to a blank cell that is now a note": lambda f: changed(f, {"J9": "note"}),
    "texts over texts, a truth value over a number": lambda f: changed(
        f, {"A1": "radius", "A2": "rho", "D1": "rho", "E2": True}),
    "two blocks elsewhere": lambda f: changed(
        f, {"G1": None, "H1": None, "G2": None, "H2": None, "J4": "beta", "K4": 5, "J5": "Yt",
            "K5": 7e8, "B6": "=K4*K5", "D1": None, "E1": None, "J8": "target density", "K8": 7850,
            "E9:": "=(0.5*$K$8*C{r}^2+$B$6)*PI()*($B$4*D{r}-D{r}^2)/$B$3"}),
    "lines of notes": lambda f: changed(f, {f"M{row}": f"line {row}" for row in (3, 4, 5, 9, 11)}),
    "more than is shown": lambda f: changed(f, {f"D{row}": row * 1e-7 for row in range(10, 60, 3)}),
    "every number of a column typed": lambda f: changed(
        f, {f"A{row}": (row - 8) * 5e-10 for row in range(9, 61)}),
    "last digits alone": lambda f: changed(f, {"B2": 8900 * (1 + 3e-15)}),
}  # fmt: skip

NOTES = (("one", "two", "three", "four", "five"), ("zero", "two", "three and more", "five", "six"),
         ("one",), ("alpha", "one", "beta", "three", "four", "five", "gamma"))  # fmt: skip
"""Notes below each other, as they become others."""


def noted(notes: tuple[str, ...], numbers: int) -> Foreign:
    """A plain sheet, and another with notes beside numbers."""
    f = plain(COARSE, 5)
    for row, note in enumerate(notes, 3):
        f.line("Notes", f"B{row}", note, *(row * n for n in range(1, numbers + 1)), f"({note})")
    return f


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


def compared_otherwise() -> Iterator[str]:
    """The other way round, with the options that it has, and where lines come and go."""
    with tempfile.TemporaryDirectory() as folder:

        def file(name: str, f: Foreign) -> Path:
            return writers.with_openpyxl(f, Path(folder, f"{name}.xlsx"))

        def told(title: str, result: Comparison) -> Iterator[str]:
            record = diff_record(result)
            yield f"* {title} -> {int(not record['clean'])}"
            yield from (f"  {_shown(line)}" for line in show.text(record).split("\n")[1:] if line)

        before = file("a", plain(COARSE))
        for title in ("notes beside", "a sheet more", "a row inserted among the others",
                      "a column inserted", "two blocks elsewhere", "an input"):  # fmt: skip
            f = plain(COARSE)
            CHANGES[title](f)
            yield from told(f"{title}, the other way round", diff(file("b", f), before))
        after = file("b", changed(plain(COARSE), {"B5": 500.02, "D60": "=D59+C60*$E$2*1.0001"}))
        for title, allowed in (
            ("4 digits", Tolerance(digits=4)), ("5 digits", Tolerance(digits=5)),
            ("1e-4 of the number", Tolerance(relative=1e-4)),
            ("1e12 ulp", Tolerance(ulp=10**12)), ("1e9 ulp", Tolerance(ulp=10**9)),
        ):  # fmt: skip
            yield from told(f"within {title}", diff(before, after, allowed=allowed))
        yield from told("values only", diff(before, after, values_only=True))
        for i, notes in enumerate(NOTES):
            for numbers in (0, 2):
                old, new = file("a", noted(notes, numbers)), file("b", noted(NOTES[i - 1], numbers))
                yield from told(f"notes {i + 1} with {numbers} numbers", diff(old, new))


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
        another = [entry for entry in taken if entry not in usual] + [f"no {role}" for role in gone]
        if another:
            yield f"  taken: {', '.join(another)}"


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
    holds = (
        f"{_shown(line)}{_apart(d['found'], d['expected'])}; " if (line := show.contents(d)) else ""
    )
    return f"{d['cell']}{cells}, {d['kind']}: {holds}{_shown(d['explanation'])}{effect}"


def _apart(result: object, expected: object) -> str:
    """How far apart two numbers are that look the same here."""
    if not isinstance(result, float) or not isinstance(expected, float) or result == expected:
        return ""
    off = result / expected - 1 if expected else 1.0
    return f" ({off:+.0e} of it)" if _number(result) == _number(expected) else ""


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
    "plain sheet: half of the rows": halves,
    "plain sheet: the stop": stops,
    "last digits": last_digits,
    "numbers without formulas": digits,
    "several tables, and none": several,
    "what is where, as the user says": given,
    "spoiled at random": at_random,
    "names, and several sheets": named,
    "stored values": stored,
    "in full": in_full,
    "the page, and the file for machines that run tests": pages,
    "two workbooks side by side": compared,
    "two workbooks, in other ways": compared_otherwise,
}


def section(name: str) -> str:
    """A section of the file."""
    return "\n".join([f"## {name}", *SECTIONS[name](), "", ""])


if __name__ == "__main__":
    print(__doc__)
    for name in SECTIONS:
        print(section(name), end="")
