"""The faults that the workbook of a stranger can have, and what each is called."""

import random
from dataclasses import dataclass

from foreign.layouts import BRAKE, DEPTH, END, START
from foreign.strangers import Plan
from foreign.truth import EITHER


@dataclass(frozen=True)
class Slip:
    """One fault: what is wrong, in which column or of which input, and in which row if in one."""

    name: str
    column: str = ""
    row: int | None = None
    given: str = ""


ODD, SCHEME, UNIT = ("odd formula",), ("other scheme",), ("unit",)

IN_A_ROW = (
    ("plus x²", "area"), ("no x²", "area"), ("radius for diameter", "area"),
    ("no 1/2", "pressure"), ("cube of the velocity", "pressure"), ("no resistance", "pressure"),
    ("minus resistance", "pressure"), ("another number", "pressure"), ("twice", BRAKE),
    ("no pi", "area"), ("half a step", DEPTH), ("minus", DEPTH), ("row before", DEPTH),
    ("row before", BRAKE), ("column beside", DEPTH), ("plus", END), ("half a step", END),
    ("column beside", END),
)  # fmt: skip
"""Slips in a formula, each with the quantity that is wrong."""

OF_A_COLUMN = {
    "plus x²": EITHER, "no x²": EITHER, "radius for diameter": EITHER, "no 1/2": EITHER,
    "cube of the velocity": EITHER, "no resistance": EITHER, "minus resistance": EITHER,
    "twice": EITHER, "no pi": EITHER, "half a step": EITHER, "minus": EITHER, "plus": EITHER,
}  # fmt: skip
"""Those that somebody makes in all rows, and how they may then be called."""


KINDS = {
    "typed": ("typed number",), "typed, right digits": ("typed number",),
    "stale": ("stale value",), "stale, slightly": ("stale value",),
    "typed constant": ("typed constant",), "mass: 3.14": ("typed constant",),
    "no half step": SCHEME, "explicit Euler": SCHEME, "centered": SCHEME,
    "beyond the stop": SCHEME,
    "label": UNIT, "conversion": UNIT, "head": UNIT,
}  # fmt: skip
"""What slips are called that are no odd formulas."""

ROWS = {"typed constant": (1, 2), "explicit Euler": (2, 3)}
"""The first rows in which some slips in a column can be seen; others in one of the first three."""


SUMMED = (
    "typed",
    "typed, right digits",
    "stale",
    "stale, slightly",
    "typed constant",
    "lost $",
    "head",
)
"""The faults of depths that are sums."""

BEYOND = 4
"""So many rows too many are filled down."""


def kinds(slip: Slip) -> tuple[str, ...]:
    """What a slip is called."""
    if slip.row is None and slip.name in OF_A_COLUMN:
        return OF_A_COLUMN[slip.name]
    return KINDS.get(slip.name, ODD)


def slips(plan: Plan) -> list[Slip]:
    """Every fault that the workbook of a plan can have; rows and inputs are drawn."""
    r = random.Random(f"slip {plan.seed}")
    shown = {name: plan.shown(name) for name in ("area", "pressure", BRAKE, DEPTH, END)}
    n = plan.steps
    all_slips = [Slip(name, shown[where], r.randrange(3, n - 1)) for name, where in IN_A_ROW]
    all_slips += [Slip(name, shown[where]) for name, where in IN_A_ROW if name in OF_A_COLUMN]
    roles = [role for role in (START, DEPTH, BRAKE, END) if role in plan.columns]
    for name in ("typed", "typed, right digits", "stale", "stale, slightly"):
        all_slips.append(Slip(name, r.choice(roles), r.randrange(3, n - 1)))
    all_slips += [
        Slip("no half step", DEPTH, 1),
        Slip("explicit Euler", DEPTH),
        Slip("centered", BRAKE),
    ]
    readers = [(given, column) for given in plan.given for column in _readers(plan, given)]
    for row in (r.randrange(3, n - 1), None):
        given, column = r.choice(readers)
        all_slips.append(Slip("typed constant", column, row, given))
    given, column = r.choice(readers)
    all_slips.append(Slip("lost $", column, None, given))
    all_slips += [Slip(f"mass: {what}", "mass") for what in ("no third", "square", "3.14")]
    all_slips += [Slip("diameter the radius", "diameter"), Slip("resistance a sum", "resistance")]
    all_slips += [Slip("label", given=r.choice(plan.given)), Slip("head", column=DEPTH)]
    all_slips += [Slip("conversion", given=r.choice(plan.given)), Slip("beyond the stop", END)]
    all_slips += [Slip("result of the row before"), Slip("result over the diameter")]
    if plan.digits is not None:
        all_slips = [slip for slip in all_slips if slip.name == "typed"]
    if plan.summed:
        all_slips = [slip for slip in all_slips if slip.column != DEPTH or slip.name in SUMMED]
    return [slip for slip in all_slips if _possible(plan, slip)]


def _readers(plan: Plan, given: str) -> list[str]:
    """The columns whose formulas read an input."""
    radius = ["area"]
    quantities = {
        "radius": radius, "diameter": radius, "target_density": ["pressure"],
        "resistance": ["pressure"], "beta": ["pressure"], "flow_stress": ["pressure"],
        "step": [DEPTH] if "change" in plan.columns else [DEPTH, END], "mass": [BRAKE],
        "particle_density": [BRAKE] if plan.mass == "inline" else [],
    }  # fmt: skip
    hidden = given in ("beta", "flow_stress") and plan.resistance_cell
    hidden = hidden or (given == "radius" and plan.diameter_cell and not plan.beyond)
    return [] if hidden else [plan.shown(name) for name in quantities.get(given, [])]


def _possible(plan: Plan, slip: Slip) -> bool:
    """Whether the workbook can have the fault, and enough stands in it to call that a fault."""
    if slip.name in ("label", "head", "conversion"):
        return _unit_possible(plan, slip)
    if slip.name in ("centered", "explicit Euler", "column beside"):
        return plan.velocities == "both" and BRAKE in plan.columns
    if slip.name.startswith("mass: "):
        return plan.mass == "cell"
    if slip.name.startswith("result"):
        return plan.has_result
    match slip.name:
        case "beyond the stop":
            stops = "stop_velocity" in plan.given and not plan.guard and not plan.has_result
            return stops and plan.velocities == "both" and plan.inputs_at in ("above", "sheet")
        case "lost $":
            return plan.references == "absolute" and plan.inputs_at != "sheet"
        case "diameter the radius":
            return plan.diameter_cell
        case "resistance a sum":
            return plan.resistance_cell
    return True


def _unit_possible(plan: Plan, slip: Slip) -> bool:
    """Whether all units are stated, so that one that is wrong contradicts the others."""
    if plan.unit_beside_input == "none" or plan.unit_of_column == "none" or plan.words == "none":
        return False
    if slip.name == "head":
        return True
    power = plan.units[slip.given].power
    if slip.given in ("beta", "stop_velocity") or power is None:
        return False
    return plan.converted and not plan.flat and power != 0 if slip.name == "conversion" else (
        not plan.converted)  # fmt: skip
