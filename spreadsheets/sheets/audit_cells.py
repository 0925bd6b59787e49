"""Which cell of the workbook computes which claim of the ledger, by key."""

from collections.abc import Mapping

__all__ = ["CELLS", "SCALES"]

_ROWS = {
    f"a1-{claim}-{row}": f"table.row[{row}].{what}"
    for row in range(5)
    for claim, what in (
        ("time", "time"),
        ("velocity-initial", "velocity_initial"),
        ("depth", "depth"),
        ("deceleration", "deceleration"),
        ("velocity-final", "velocity_final"),
    )
    if (row, claim) != (0, "velocity-final")
}
_OBSERVED = "crater.least.normalized_depth"

CELLS: Mapping[str, str] = {
    "particle-volume": "crater.volume_um3",
    "observed-depth-ratio": _OBSERVED,
    "observed-depth": "crater.least.depth_um",
    "goodier-beta": "resistance.goodier_beta",
    "walker-anderson-alpha": "resistance.alpha",
    "walker-anderson-beta": "resistance.walker_anderson_beta",
    "brinell-beta": "resistance.brinell_beta",
    "beta-range-least": "resistance.least_beta",
    "beta-range-greatest": "resistance.greatest_beta",
    "observed-third": _OBSERVED,
    "contact-diameter-bound": "crater.contact_diameter_um",
    "strength-multiple": "resistance.clear_over_bulk",
    "strain-rate": "resistance.strain_rate",
    "coarse-step-beta-3": "low_coarse.depth_um",
    "coarse-step-beta-5": "high_coarse.depth_um",
    "depth-beta-3": "low.depth_um",
    "depth-beta-5": "high.depth_um",
    "ratio-beta-3": "low.normalized_depth",
    "ratio-beta-5": "high.normalized_depth",
    "observed-ratio": _OBSERVED,
    "sphere-length-ratio": "frank_zook.length_ratio",
    "frank-zook-rha": "frank_zook.RHA.as_printed",
    "frank-zook-stainless": "frank_zook.lower.as_printed",
    "discussion-ratio-beta-3": "low.normalized_depth",
    "discussion-ratio-beta-5": "high.normalized_depth",
    "discussion-observed": _OBSERVED,
    "general-ratio": _OBSERVED,
    "general-third": _OBSERVED,
    "general-sixth": _OBSERVED,
    "summary-ratio": _OBSERVED,
    "eq2-factor": "equations.eq2.factor",
    "eq2-power": "equations.eq2.power",
    "eq2-offset": "equations.eq2.offset",
    "eq3-factor": "equations.eq3.factor",
    "eq3-power": "equations.eq3.power",
    "eq12-power-depth": "equations.contact.power",
    "eqa3-power-depth": "equations.contact.power",
    "eq16-denominator": "equations.eq16.denominator",
    "eq16-offset": "equations.eq16.offset",
    "excess-beta-3": "equations.low.excess",
    "excess-beta-5": "equations.high.excess",
    "particle-radius": "equations.radius_um",
    "a-half-step": "inputs.half_step",
    "a1-radius": "table.radius",
    "a1-mass": "table.mass",
    "a1-diameter": "table.diameter",
    "a1-resistance": "table.resistance",
    **_ROWS,
}
"""Claim id -> key of the cell."""

SCALES: Mapping[str, str] = {
    "a-half-step": "*1000000000",
    "general-sixth": "/2",
}
"""Claim id -> what brings the cell to the claim's unit: s to ns, radii to diameters."""
