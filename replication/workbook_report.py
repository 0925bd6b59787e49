"""The values, by key, of the sheets that only the report's workbook has."""

import math
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

from reference.ledger import load
from reference.printed import Interval, parse
from replication.analysis.convergence import ladder
from replication.models.depth import final_depth, normalized_depth
from replication.models.impact import Impact
from replication.models.sheet import Sheet, run
from replication.workbook_values import pressure_ratio, sheet_values
from spreadsheets.plan import Value
from spreadsheets.sheets.audit import FAILED, REPRODUCED
from spreadsheets.sheets.audit_cells import CELLS
from spreadsheets.sheets.convergence import CURRENT, LEVELS, NO_ORDER
from spreadsheets.sheets.figure_5 import POINTS
from spreadsheets.sheets.inputs import INPUTS, REPORT_INPUTS
from spreadsheets.sheets.table_check import DIGITS, compared_cells

__all__ = ["report_values"]

_LAST_DIGITS = {"low": "10.0", "high": "7.67"}
"""The final depths as printed [µm]: how far they were rounded."""


def report_values(
    values: Mapping[str, Value],
    sheets: Mapping[str, Sheet],
    coarse: Mapping[str, Sheet],
    coarse_rows: int,
) -> dict[str, Value]:
    """What to add to `values`, those of every workbook of the same `sheets`.

    `coarse` holds the same cases with the coarser step, on sheets of so many prepared rows.
    """
    held: dict[str, Any] = _inputs()
    for slug, sheet in coarse.items():
        held |= _coarse(slug, sheet, sheets[slug], coarse_rows)
    held |= _figure_5(sheets["high"].impact)
    held |= _convergence({slug: sheet.impact for slug, sheet in sheets.items()})
    held |= _table_check(values)
    held |= _equations(sheets)
    held |= _audit({**values, **held})
    return {key: value if isinstance(value, str) else float(value) for key, value in held.items()}


def _inputs() -> dict[str, Any]:
    held: dict[str, Any] = {}
    for name in REPORT_INPUTS:
        number = INPUTS[name].si
        held |= {name: number, f"{name}.report": number, f"{name}.check": 1}
    return {f"inputs.{what}": value for what, value in held.items()}


def _coarse(slug: str, sheet: Sheet, fine: Sheet, rows: int) -> dict[str, Any]:
    fine_um = fine.final_depth * 1e6
    change = sheet.final_depth * 1e6 - fine_um
    digit = float(parse(_LAST_DIGITS[slug]).quantum)
    beside = {
        "fine_depth_um": fine_um,
        "change_um": change,
        "last_digit": digit,
        "change_digits": change / digit,
    }
    part = f"{slug}_coarse"
    return sheet_values(part, sheet, rows) | {f"{part}.{k}": v for k, v in beside.items()}


def _figure_5(impact: Impact) -> dict[str, Any]:
    low, high, last = INPUTS["V_from"].si, INPUTS["V_to"].si, POINTS - 1
    held: dict[str, Any] = {}
    for point in range(POINTS):
        there = replace(impact, velocity=low + (high - low) * point / last)
        densities = there.particle_density, there.target_density
        depth = float(normalized_depth(there.velocity, *densities, there.target_resistance))
        held |= {
            f"figure_5.point[{point}]": point,
            f"figure_5.velocity[{point}]": there.velocity,
            f"figure_5.c[{point}]": 4
            * densities[0]
            / (3 * densities[1])
            * math.log1p(pressure_ratio(there)),
            f"figure_5.normalized_depth[{point}]": depth,
            f"figure_5.depth_um[{point}]": depth * there.radius * 1e6,
        }
    return held


def _convergence(impacts: Mapping[str, Impact]) -> dict[str, Any]:
    steps = ladder(impacts["low"].step, LEVELS)
    held: dict[str, Any] = {f"step[{k}]": step for k, step in enumerate(steps)}
    held |= {f"step_ns[{k}]": step * 1e9 for k, step in enumerate(steps)}
    for slug, impact in impacts.items():
        held |= {f"{slug}.{what}": v for what, v in _levels(impact, steps).items()}
    return {f"convergence.{what}": value for what, value in held.items()}


def _levels(impact: Impact, steps: list[float]) -> dict[str, Any]:
    materials = impact.particle_density, impact.target_density, impact.target_resistance
    rest = float(final_depth(impact.velocity, impact.radius, *materials)) * 1e6
    held: dict[str, Any] = {"rest_um": rest, "rest_live_um": rest, "message": CURRENT}
    errors = []
    for k, step in enumerate(steps):
        sheet = run(replace(impact, step=step))
        depth = sheet.final_depth * 1e6
        errors.append(depth - rest)
        held |= {f"steps[{k}]": sheet.steps, f"depth_um[{k}]": depth}
        held |= {f"error[{k}]": errors[k], f"size[{k}]": abs(errors[k])}
    ratios = [math.log(a / b) for a, b in pairwise(steps)]
    for k, ((coarse, fine), ratio) in enumerate(zip(pairwise(errors), ratios, strict=True), 1):
        defined = coarse * fine > 0
        held[f"order[{k}]"] = math.log(coarse / fine) / ratio if defined else NO_ORDER
    return held


def _table_check(values: Mapping[str, Value]) -> dict[str, Any]:
    held: dict[str, Any] = {}
    for address, key in _TABLE.items():
        printed = parse(_PRINTED[address])
        number, digit = float(printed.value), float(printed.quantum)
        computed = values[key]
        difference: Value = "–"
        if isinstance(computed, float):
            difference = round((computed - number) / digit, DIGITS)
        parts = {"printed": number, "computed": computed, "last_digit": digit}
        parts["difference"] = difference
        held |= {f"table_check.{address}.{what}": value for what, value in parts.items()}
    return held


def _equations(sheets: Mapping[str, Sheet]) -> dict[str, Any]:
    """The equations' constants: volumes over pi and areas over pi are rational, so exact here."""
    quarter, half, one, two = Fraction(1, 4), Fraction(1, 2), Fraction(1), Fraction(2)
    sphere_factor = _cap(2 * one, one)
    impact = sheets["high"].impact
    particle, target = impact.particle_density, impact.target_density
    diameter, k_1 = impact.diameter, INPUTS["k_1"].si
    inertia = float(sphere_factor) / 2 * particle / target + k_1
    work = (float(sphere_factor) / 2 * diameter * particle + k_1 * target * diameter) / 2
    lacking = {x: 2 * x - (1 - (1 - x) ** 2) for x in (quarter, half)}
    radius = INPUTS["D_mean"].si / 2
    held: dict[str, Any] = {
        "eq2.quarter": _cap(quarter, one),
        "eq2.half": _cap(half, one),
        "eq2.radius": _cap(one, one),
        "eq2.factor": _cap(one, one) / 2,
        "eq2.power": math.log2(_cap(half, one) / (3 - half) * (3 - quarter) / _cap(quarter, one)),
        "eq2.offset": 3 * _cap(one, one) + 1,
        "eq3.factor": sphere_factor,
        "eq3.double": _cap(2 * two, two),
        "eq3.power": math.log2(_cap(2 * two, two) / sphere_factor),
        "contact.quarter": lacking[quarter],
        "contact.half": lacking[half],
        "contact.power": math.log2(lacking[half] / lacking[quarter]),
        "eq16.inertia": inertia,
        "eq16.depth": work,
        "eq16.denominator": inertia * target * impact.radius / work,
        "eq16.diameters": inertia * target * diameter / work,
        # At V = 0 the term beside the offset vanishes, and so does the logarithm.
        "eq16.offset": 1,
        "radius": radius,
        "radius_um": radius * 1e6,
    }
    for slug, sheet in sheets.items():
        held[f"{slug}.excess"] = sheet.normalized_depth / INPUTS["observed_ratio"].si
    return {f"equations.{what}": float(value) for what, value in held.items()}


def _cap(depth: Fraction, radius: Fraction) -> Fraction:
    """Volume of the cap over pi, the antiderivative of 2Rx - x^2."""
    return radius * depth**2 - depth**3 / 3


_PRINTED = {address: text for address, _, _, text in compared_cells()}
_HEADER = ("radius", "particle_density", "mass", "diameter", "velocity", "resistance")
_TABLE = {f"B{row}": f"table.{what}" for row, what in enumerate(_HEADER, start=1)}
_TABLE |= {
    f"{column}{8 + row}": f"table.row[{row}].{what}"
    for row in range(5)
    for column, what in (
        ("A", "time"),
        ("C", "velocity_initial"),
        ("D", "depth"),
        ("E", "deceleration"),
        ("F", "velocity_final"),
    )
    if f"{column}{8 + row}" in _PRINTED
}
"""Address in Table A-1 -> key of the number there."""

_IN_UNIT = {"a-half-step": 1e9, "general-sixth": 0.5}
"""From SI to the unit of a claim whose cell is in another."""


def _audit(values: Mapping[str, Value]) -> dict[str, Any]:
    """Interval, computed value and verdict of each claim that a cell computes.

    The verdict is that of doubles; whether it is the proven one, a test asks.
    """
    claims = load().claims
    held: dict[str, Any] = {}
    for name, key in CELLS.items():
        interval = claims[name].interval
        assert interval is not None
        for end in ("lower", "upper"):
            if (number := getattr(interval, end)) is not None:
                held[f"audit.{name}.{end}"] = float(number)
        computed = values[key]
        if isinstance(computed, float) and name in _IN_UNIT:
            computed *= _IN_UNIT[name]
        held[f"audit.{name}.computed"] = computed
        held[f"audit.{name}.verdict"] = REPRODUCED if _inside(computed, interval) else FAILED
    return held


def _inside(value: Value, interval: Interval) -> bool:
    """Whether a double lies between the interval's ends, themselves taken as doubles."""
    if not isinstance(value, float):
        return False
    if interval.lower is not None and interval.lower == interval.upper:
        # Exact text, such as 2/3, which no double is: to nine digits.
        return abs(Fraction(value) - interval.lower) * 10**9 <= abs(interval.lower)
    lower, upper = (
        None if end is None else Fraction(float(end)) for end in (interval.lower, interval.upper)
    )
    rounded = Interval(lower, upper, interval.lower_closed, interval.upper_closed)
    return rounded.contains(Fraction(value))
