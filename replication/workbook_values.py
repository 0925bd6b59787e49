"""The values of the workbook's cells, by key, from the models and the report's printed inputs."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from replication.models import crater, frank_zook, resistance, stream
from replication.models.depth import final_depth, normalized_depth
from replication.models.impact import Impact
from replication.models.sheet import Row, Sheet
from spreadsheets.plan import Value
from spreadsheets.sheets.inputs import ALL_VALID, INPUTS, REPORT_INPUTS
from spreadsheets.sheets.results import STOPPED
from spreadsheets.sheets.table_a1 import ROWS

__all__ = ["pressure_ratio", "sheet_values", "values_by_key"]

_HEADER = {
    "radius": "radius",
    "particle_density": "particle_density",
    "mass": "mass",
    "diameter": "diameter",
    "velocity": "velocity",
    "resistance": "target_resistance",
}
"""What Table A-1 prints above its rows -> the attribute of an Impact."""

_HEADER_BESIDE = {name: name for name in ("target_density", "step", "stop_velocity")}
"""What the sheets of all rows show besides."""

_SHARED_INPUTS = {
    "V_impact": "velocity",
    "R_p": "radius",
    "rho_p": "particle_density",
    "rho_t": "target_density",
    "dt_s": "step",
    "v_stop": "stop_velocity",
    "D_p": "diameter",
    "M_p": "mass",
}


def values_by_key(sheets: Mapping[str, Sheet], rows: int) -> dict[str, Value]:
    """Every value of the workbook; `sheets` by slug ("low" and "high", or "case").

    `rows` counts the prepared rows after row 0. The sheets share every input but the resistance.
    """
    last = list(sheets.values())[-1]
    parts: dict[str, dict[str, Any]] = {
        "inputs": _inputs(sheets),
        "table": _header(last.impact, _HEADER) | _rows(last, ROWS - 1),
        "frank_zook": _frank_zook(last.impact),
        "crater": _crater(last.impact),
        "resistance": _resistance(sheets),
        "figure_3": _figure_3(sheets, rows),
    }
    held = {f"{part}.{what}": v for part, values in parts.items() for what, v in values.items()}
    for slug, sheet in sheets.items():
        of_sheet = sheet_values(slug, sheet, rows)
        held |= of_sheet
        for what in ("depth_um", "normalized_depth"):
            held[f"contents.{slug}.{what}"] = of_sheet[f"{slug}.{what}"]
    return {key: _plain(value) for key, value in held.items()}


def sheet_values(part: str, sheet: Sheet, rows: int) -> dict[str, Any]:
    """The values of a sheet of so many prepared rows, under keys that begin with `part`."""
    impact = sheet.impact
    title: dict[str, Any] = {"title.step": impact.step}
    if impact.resistance is None:
        title["title.beta"] = impact.beta
    held = _header(impact, _HEADER | _HEADER_BESIDE) | title | _result(sheet)
    held |= _rows(sheet, rows) | _beside_rows(sheet, rows)
    return {f"{part}.{what}": _plain(value) for what, value in held.items()}


def pressure_ratio(impact: Impact) -> float:
    """Dynamic pressure over target resistance, rho_t V^2 / 2 R_t [1]."""
    v = impact.velocity
    return impact.target_density * v * v / 2 / impact.target_resistance


def _plain(value: Any) -> Value:
    """Python's own type for what may be NumPy's."""
    return value if isinstance(value, str) else float(value)


def _inputs(sheets: Mapping[str, Sheet]) -> dict[str, Any]:
    by_case = {"Y_t", "beta_low", "beta_high", *_SHARED_INPUTS, *REPORT_INPUTS}
    held: dict[str, Any] = {n: entry.si for n, entry in INPUTS.items() if n not in by_case}
    held["half_step"] = next(iter(sheets.values())).impact.step / 2
    for slug, sheet in sheets.items():
        impact, suffix = sheet.impact, "" if slug == "case" else f"_{slug}"
        held |= _header(impact, _SHARED_INPUTS) | {f"R_t{suffix}": impact.target_resistance}
        if impact.resistance is None:
            held |= {f"beta{suffix}": impact.beta, "Y_t": impact.flow_stress}
    typed = {name for name in held if name not in ("D_p", "half_step")}
    if "Y_t" in held:
        typed -= {"R_t", "R_t_low", "R_t_high"}
    checks = {f"{name}.check": 1 for name in typed}
    reports = {f"{name}.report": INPUTS[name].si for name in typed if name in INPUTS}
    return held | checks | reports | {"ok": 1, "message": ALL_VALID}


def _figure_3(sheets: Mapping[str, Sheet], rows: int) -> dict[str, Any]:
    """The curves in ns and µm; after the stop they hold the last row."""
    held = {}
    for slug, sheet in sheets.items():
        for k in range(rows + 1):
            row = sheet.rows[min(k, sheet.steps)]
            held[f"{slug}.time[{k}]"] = row.time * 1e9
            held[f"{slug}.depth[{k}]"] = row.depth * 1e6
    return held


def _header(impact: Impact, attributes: Mapping[str, str]) -> dict[str, Any]:
    return {what: getattr(impact, attribute) for what, attribute in attributes.items()}


def _rows(sheet: Sheet, rows: int) -> dict[str, Any]:
    """The cells of every row but the final velocity of row 0; blank ("") below the stop."""
    blank = dict.fromkeys(Row._fields, "")
    return {
        f"row[{k}].{what}": value
        for k in range(rows + 1)
        for what, value in (sheet.rows[k]._asdict() if k <= sheet.steps else blank).items()
        if value is not None
    }


def _beside_rows(sheet: Sheet, rows: int) -> dict[str, Any]:
    """A row's number, and its depth in µm."""
    held: dict[str, Any] = {}
    for k in range(rows + 1):
        in_use = k <= sheet.steps
        held[f"row[{k}].index"] = k if in_use else ""
        held[f"row[{k}].depth_um"] = sheet.rows[k].depth * 1e6 if in_use else ""
    return held


def _result(sheet: Sheet) -> dict[str, Any]:
    impact, final = sheet.impact, sheet.rows[-1]
    densities = impact.particle_density, impact.target_density
    materials = *densities, impact.target_resistance
    v = impact.velocity
    return {
        "stopped": 1,
        "message": STOPPED,
        "final_depth": sheet.final_depth,
        "depth_um": sheet.final_depth * 1e6,
        "normalized_depth": sheet.normalized_depth,
        "steps": sheet.steps,
        "stop_time": final.time,
        "final_velocity": v if final.velocity_final is None else final.velocity_final,
        "c": 4 * densities[0] / (3 * densities[1]) * math.log1p(pressure_ratio(impact)),
        "exact_normalized_depth": normalized_depth(v, *materials),
        "exact_depth_um": final_depth(v, impact.radius, *materials) * 1e6,
    }


def _frank_zook(impact: Impact) -> dict[str, Any]:
    length_ratio = frank_zook.sphere_length_ratio()
    held: dict[str, Any] = {"length_ratio": length_ratio}
    for which in ("RHA", "lower"):
        r_t = INPUTS[f"R_t_{which}"].si
        arguments = (
            length_ratio,
            impact.particle_density,
            impact.target_density,
            INPUTS["k_1"].si,
            INPUTS["k_t"].si,
            r_t,
            impact.velocity,
        )
        held[f"{which}.resistance"] = r_t
        held[f"{which}.as_printed"] = frank_zook.depth_as_printed(*arguments)
        held[f"{which}.derived"] = frank_zook.depth_derived(*arguments)
    return held


def _crater(impact: Impact) -> dict[str, Any]:
    volume, third = crater.volume(impact.radius), 1 / 3
    contact = crater.contact_diameter(third, impact.diameter)
    ratios = {"least": INPUTS["CV_PV"].si, "line": INPUTS["CV_PV_line"].si}
    held = {
        "volume": volume,
        "volume_um3": _cubic_micrometers(volume),
        "on_line": ratios["line"] * _cubic_micrometers(volume),
        "third": third,
        "contact_diameter": contact,
        "contact_diameter_um": contact * 1e6,
    }
    for which, ratio in ratios.items():
        held |= {f"{which}.{what}": v for what, v in _cap(ratio, impact.radius).items()}
    diameters = (INPUTS["d_min"].si, impact.diameter, INPUTS["d_max"].si)
    for which, diameter in zip(("smallest", "average", "largest"), diameters, strict=True):
        mass = replace(impact, radius=diameter / 2).mass
        held[f"{which}_mass"] = mass
        held[f"{which}_velocity"] = stream.particle_velocity(impact.velocity, mass, impact.mass)
    return held


def _cap(ratio: float, radius: float) -> dict[str, Any]:
    y = crater.depth_from_volume_ratio(ratio)
    volume = crater.cap_volume(y * radius, radius)
    return {
        "normalized_depth": y,
        "depth": y * radius,
        "depth_um": y * radius * 1e6,
        "volume": volume,
        "volume_um3": _cubic_micrometers(volume),
        "ratio": crater.volume_ratio(y),
    }


def _cubic_micrometers(volume: float) -> float:
    return volume * 1e6 * 1e6 * 1e6


def _resistance(sheets: Mapping[str, Sheet]) -> dict[str, Any]:
    alpha = resistance.walker_anderson_alpha(INPUTS["E_t"].si, INPUTS["Y_steel"].si)
    impact = next(iter(sheets.values())).impact
    held = {
        "goodier_beta": resistance.goodier_beta(INPUTS["q_Y"].si),
        "alpha": alpha,
        "walker_anderson_beta": resistance.walker_anderson_beta(alpha),
        "brinell_beta": resistance.brinell_beta(INPUTS["HB_ratio"].si),
        "strain_rate": stream.strain_rate(impact.velocity, INPUTS["L_typ"].si),
    }
    betas = [held[f"{route}_beta"] for route in ("goodier", "walker_anderson", "brinell")]
    held |= {"least_beta": min(betas), "greatest_beta": max(betas)}
    for slug, sheet in sheets.items():
        held |= {f"{slug}.{what}": value for what, value in _stresses(sheet.impact).items()}
    return held | _strengths()


def _stresses(impact: Impact) -> dict[str, Any]:
    r_t = impact.target_resistance
    stress = resistance.centerline_stress(impact.target_density, impact.velocity, r_t)
    return {
        "target_resistance": r_t,
        "centerline_stress": stress,
        "over_copper": stress / INPUTS["Y_copper"].si,
    }


def _strengths() -> dict[str, Any]:
    """Strengths in MPa of the grains; their inputs are in ksi, 1000 pound-force per square inch."""
    force, length = INPUTS["lbf_N"].si, INPUTS["inch_m"].si
    held = {
        which: INPUTS[f"S_{which}"].si * 1000 * force / (length * length) / 1e6
        for which in ("feathery", "clear", "bulk")
    }
    mean = (held["feathery"] + held["clear"]) / 2
    least = held["clear"] / held["bulk"]
    return held | {
        "mean_grain": mean,
        "clear_over_bulk": least,
        "grain_over_bulk": mean / held["bulk"],
    }
