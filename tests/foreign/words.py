"""Workbooks whose words nobody knows, and impacts far from the report's."""

import copy
import random
import re

from foreign.layouts import Foreign
from foreign.vocabulary import syllables

from replication.models.impact import Impact
from replication.models.sheet import run

UNIT = (
    r"(?:[kmµunp]?m(?:/n?s(?:²|\^2|2|\))?|²|2)?|[µnpm]?s|\(?m/s2?\)?|k?m/s(?:²|\^2|2)?|"
    r"µm/ns²|cm/s2?|[GM]?Pa|[km]?g(?:/(?:m³|m3|m\^3|cm³|cm3))?|dyn/cm2|g/cm³|mN|N|J)"
)
WITH_UNIT = re.compile(rf"(.*?)(\s*(?:\[|\(|/ ?|, | in ){UNIT}[\])]*)")


def with_unknown_words(f: Foreign, seed: int) -> Foreign:
    """The workbook with a word of random letters in place of each text and name; units stay."""
    r = random.Random(f"words {seed}")
    g = copy.deepcopy(f)
    for at, content in f.cells.items():
        if not isinstance(content, str) or content.startswith("="):
            continue
        with_unit = WITH_UNIT.fullmatch(content)
        if with_unit:
            g.cells[at] = syllables(r) + with_unit[2]
        elif not re.fullmatch(UNIT, content):
            g.cells[at] = syllables(r)
    for number, (name, meaning) in enumerate(f.names.items()):
        own = f"w{number}_"
        g.names[own] = meaning
        del g.names[name]
        used = re.compile(rf"(?<![\w.'!]){re.escape(name)}(?![\w(.!'])")
        for at, content in g.cells.items():
            if isinstance(content, str) and content.startswith("="):
                g.cells[at] = used.sub(own, content)
    return g


def other_impact(seed: int, steps: int = 130) -> Impact:
    """An impact whose inputs are drawn over decades, with a step that gives so many rows or so."""
    r = random.Random(f"impact {seed}")

    def between(least: float, most: float) -> float:
        return float(f"{least * (most / least) ** r.random():.3g}")

    while True:
        inputs = {
            "velocity": between(80, 2000), "radius": between(5e-7, 1e-3),
            "particle_density": between(1000, 20000), "target_density": between(1000, 20000),
            "beta": between(1.5, 6), "flow_stress": between(1e7, 3e9),
        }  # fmt: skip
        long = run(Impact(**inputs, step=0.005 * inputs["radius"] / inputs["velocity"]))
        impact = Impact(**inputs, step=float(f"{long.rows[-1].time / steps:.2g}"))
        sheet = run(impact)
        # Most layouts have the formula for a depth below the radius alone.
        if 0.05 < sheet.normalized_depth < 0.95 and 95 < sheet.steps < 180:
            return impact
