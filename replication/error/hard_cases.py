"""The hard cases: sheet, closed form and reference side by side, or the error message.

Also compares the closed form with the reference over random cases that span all sensible ranges.
"""

import math
import random
import sys
from collections.abc import Iterator, Mapping
from typing import Any

from flint import arb, ctx

from replication.cases import BETA_5, changed
from replication.error import warnings
from replication.error.ladder import exact_motion
from replication.models.depth import final_depth
from replication.models.sheet import run
from replication.text import aligned, columns, prose


def _half_buried(factor: float) -> dict[str, float]:
    # With rho_t = 2 rho_p, ln(1 + p) = 1 and p = rho_t V^2 / 2 R_t, the area integral is 2/3, so
    # y = 1.
    resistance = 8000.0 * 500.0 * 500.0 / 2 / math.expm1(1.0) * factor
    return {"particle_density": 4000.0, "target_density": 8000.0, "resistance": resistance}


def _shallow(velocity: float) -> dict[str, float]:
    # All slow impacts last equally long. The stop velocity is V/500, as in the report's cases.
    return {"velocity": velocity, "stop_velocity": velocity / 500}


HARD_CASES: Mapping[str, dict[str, float]] = {
    "the report's beta-5": {},
    "the report's beta-3": {"beta": 3.0},
    "depth just below R": _half_buried(1 + 1e-9),
    "depth at R": _half_buried(1.0),
    "depth just above R": _half_buried(1 - 1e-9),
    "shallow, 1e-9 m/s": _shallow(1e-9),
    "shallow, 1e-3 m/s": _shallow(1e-3),
    "slow, 1 m/s": _shallow(1.0),
    "hypervelocity, 1e4 m/s": {"velocity": 1e4},
    "hypervelocity, 1e5 m/s": {"velocity": 1e5},
    "resistance 1 Pa, step 2 ns": {"resistance": 1.0, "step": 2e-9},
    "resistance 1 Pa, stop at 100 m/s": {"resistance": 1.0, "stop_velocity": 100.0},
    "resistance 1e6 Pa": {"resistance": 1e6},
    "resistance 1e12 Pa": {"resistance": 1e12},
    "resistance 1e15 Pa": {"resistance": 1e15},
    "resistance 1e15 Pa, fine step": {"resistance": 1e15, "step": 2e-13},
    "density ratio 1e-6": {"particle_density": 8900e-6, "target_density": 8900.0},
    "density ratio 1e-6, fine step": {
        "particle_density": 8900e-6, "target_density": 8900.0, "step": 2e-13,
    },
    "density ratio 1e6": {"particle_density": 8900.0, "target_density": 8900e-6},
    "radius 1e-12 m": {"radius": 1e-12, "step": 2e-17},
    "radius 1e-12 m, report's step": {"radius": 1e-12},
    "radius 1e3 m": {"radius": 1e3, "step": 2e-2},
    "radius 1e3 m, report's step": {"radius": 1e3},
    "mass underflows, radius 1e-110 m": {"radius": 1e-110},
    "mass overflows, radius 1e110 m": {"radius": 1e110},
    "mass subnormal, radius 1e-104 m": {"radius": 1e-104, "step": 2e-109},
    "V^2 overflows, 1e160 m/s": {"velocity": 1e160},
    "V^2 underflows, 1e-170 m/s": _shallow(1e-170),
    "below the stop velocity": {"velocity": 0.5},
    "at the stop velocity": {"velocity": 1.0},
    "stop velocity 0": {"stop_velocity": 0.0},
    "step longer than the impact": {"step": 1e-7},
    "step half the impact": {"step": 1.3e-8},
    "step far too short": {"step": 1e-18},
    **{
        f"{name.replace('_', ' ')} {word}": {name: value}
        for name in (*BETA_5.motion, "step")
        for word, value in (("0", 0.0), ("-1", -1.0), ("NaN", math.nan), ("infinite", math.inf))
    },
    "radius squared underflows": {"radius": 1e-170, "particle_density": 1e302},
    "dynamic pressure below 1e-250": _shallow(1e-130),
}  # fmt: skip
"""For each hard case, named by what makes it hard, the inputs that differ from beta-5's."""


def outcome(name: str) -> dict[str, Any]:
    """Return the sheet, the closed form and the exact depth of a hard case; depths in m.

    `refused` is the error message if the inputs are refused, `sheet_refused` if only the sheet is.
    `reference` is the exact depth to 20 digits, `ulps` the closed form's error in units in the last
    place, `sheet_error` the sheet's error relative to the exact depth. What could not be computed
    is None. Inputs that are not finite are given as text.
    """
    changes = HARD_CASES[name]
    result: dict[str, Any] = {
        "name": name,
        "changes": {key: x if math.isfinite(x) else str(x) for key, x in changes.items()},
        **dict.fromkeys(("refused", "sheet_refused"), ""),
        **dict.fromkeys(("steps", "sheet", "sheet_error", "closed_form", "reference", "ulps")),
        "warnings": [],
    }
    try:
        impact = changed(BETA_5, changes)
    except ValueError as error:
        return result | {"refused": str(error)}
    motion, depth = exact_motion(impact), final_depth(**impact.motion)
    exact = motion.final_depth
    result |= {"closed_form": depth, "reference": motion.context.nstr(exact, 20, min_fixed=-5)}
    result["ulps"] = _ulps(depth, impact.motion)
    try:
        sheet = run(impact)
    except ValueError as error:
        return result | {"sheet_refused": str(error)}
    result |= {"steps": sheet.steps, "sheet": sheet.final_depth}
    result["sheet_error"] = sheet.final_depth / float(exact) - 1
    return result | {"warnings": list(warnings(sheet).values())}


def random_cases(count: int, seed: int) -> Iterator[dict[str, float]]:
    """Yield the inputs (SI) of `count` random cases, uniformly distributed in the logarithm."""
    ranges = {
        "velocity": (1e-9, 1e5),
        "radius": (1e-12, 1e3),
        "particle_density": (1e-1, 1e5),
        "target_density": (1e-1, 1e5),
        "resistance": (1.0, 1e15),
    }
    logs = [(name, math.log(low), math.log(high)) for name, (low, high) in ranges.items()]
    steps = [(name, low, high - low) for name, low, high in logs]
    # Importing NumPy's generator would take longer than computing all cases.
    draw, exp = random.Random(seed).random, math.exp  # noqa: S311 - not for secrets
    for _ in range(count):
        yield {name: exp(low + width * draw()) for name, low, width in steps}


def worst_of(count: int, seed: int) -> dict[str, Any]:
    """Return the closed form's greatest error over `count` random cases, and that case's inputs.

    The keys are `cases`, the error in `ulps`, `inputs`, and `skipped`, the number of cases left out
    because their depth is not a normal double.
    """
    worst, inputs, skipped = 0.0, dict[str, float](), 0
    with ctx.workprec(_BITS):
        for case in random_cases(count, seed):
            V, R, rho_p, rho_t, R_t = case.values()
            depth = final_depth(V, R, rho_p, rho_t, R_t)
            if not sys.float_info.min <= depth < math.inf:
                skipped += 1
            elif abs(_about_ulps(depth, V, R, rho_p, rho_t, R_t)) > abs(worst) - _MARGIN:
                error = _ulps(depth, case)
                if abs(error) > abs(worst):
                    worst, inputs = error, case
    return {"cases": count, "skipped": skipped, "ulps": worst, "inputs": inputs}


_BITS, _MARGIN = 96, 1e-6
"""With so many bits, `_about_ulps` is this close to `_ulps`: its residual is right to 2^-90 of W,
which is 2^-36 ulp, and its slope to 2^-50 of itself."""


def _about_ulps(depth: float, V: float, R: float, rho_p: float, rho_t: float, R_t: float) -> float:
    """Return what `_ulps` returns, nearly: only the residual is computed with many digits.

    It has few operations, since it is nearly all that is computed of most of the random cases.
    """
    v, y = arb(V), depth / R
    work = arb(4 * rho_p) / rho_t * (v * v * rho_t / (2 * R_t)).log1p()  # 3 W
    x = arb(depth) / R
    if y < 1:
        return float(x * x * (3 - x) - work) / (3 * y * (2 - y)) * (R / math.ulp(depth))
    return float(3 * x - 1 - work) / 3 * (R / math.ulp(depth))


@ctx.workdps(40)
def _ulps(depth: float, case: dict[str, float]) -> float:
    """Return the error of a depth in ulp, from its residual in the energy integral, by Arb.

    One Newton step turns the residual into a distance, as curvature is negligible over a few ulp.
    """
    velocity, radius, particle, target, resistance = map(arb, case.values())
    pressure = target * velocity * velocity / (2 * resistance)
    area_integral = 4 * particle / (3 * target) * pressure.log1p()
    y = depth / radius
    if area_integral <= arb(2) / 3:
        distance = (y * y - y * y * y / 3 - area_integral) / (2 * y - y * y)
    else:
        distance = y - (area_integral + arb(1) / 3)
    return float(distance * radius / math.ulp(depth))


def record(count: int, seed: int) -> dict[str, Any]:
    """Return all hard cases and the worst random one: the JSON of `coldspray stability`."""
    return {"cases": list(map(outcome, HARD_CASES)), "random": worst_of(count, seed)}


def hard_cases_text(record: dict[str, Any], width: int = 10_000) -> str:
    """Return the hard cases as a table, with notes below it and the worst of the random cases.

    Where the table is wider than `width`, the sheet and the closed form have one each. The notes
    are wrapped to it.
    """
    rows: list[tuple[str, ...]] = [
        ("case", "steps", "sheet X/m", "off by", "closed form X/m", "ulp", "exact X/m")
    ]
    notes = []
    for case in record["cases"]:
        sheet, closed = ("-", "refused", ""), ("", "", "")
        if case["steps"] is not None:
            off = f"{100 * case['sheet_error']:+.3g} %"
            sheet = str(case["steps"]), f"{case['sheet']:.9g}", off
        if case["reference"]:
            closed = f"{case['closed_form']:.9g}", f"{case['ulps']:+.2f}", case["reference"]
        rows.append((case["name"], *sheet, *closed))
        refusal = case["refused"] or case["sheet_refused"]
        said = [f"refused: {refusal}"] if refusal else case["warnings"]
        notes += [prose(f"{case['name']}: {words}", width, hanging="  ") for words in said]
    worst = record["random"]
    inputs = ", ".join(f"{name} {value!r}" for name, value in worst["inputs"].items())
    closing = (
        f"Closed form over {worst['cases']} random cases ({worst['skipped']} without a normal "
        f"double for an answer): at worst {worst['ulps']:.2f} ulp, at {inputs}."
    )
    table = aligned(rows)
    if max(map(len, table)) > width:
        sheets, exact = [row[:4] for row in rows], [(row[0], *row[4:]) for row in rows]
        table = [columns(sheets, width), "", columns(exact, width)]
    return "\n".join([*table, "", *notes, "", prose(closing, width)])
