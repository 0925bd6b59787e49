"""The units of areas, pressures and forces that columns beside the table show and its rows read."""

import math
from dataclasses import replace

from reference.units import same_dimension, to_si
from replication.check.cells import feeding
from replication.check.examination import Examination
from replication.check.fit import Force
from replication.check.roles import Inputs
from replication.check.six import REPORT, Six, start_of_row
from replication.check.table import Line
from replication.check.taken import mass_of
from replication.check.words import times_too

_CLOSE = 1e-6
"""The decimal logarithm of a ratio up to which a column is its quantity but for a power of ten."""
_SHARES = ((0.05, 0.5), (0.15, 0.5), (0.05, 1.3))
"""The depths, over D, and velocities, over that of equal drag and resistance, that are tried."""


def units_beside(exam: Examination, inputs: Inputs) -> None:
    """Report heads beside the table that give another unit than their numbers have.

    The area is pi (D x - x²), the pressure M/pi (G u² + H), and the force M a. Nothing is said
    where the units of the table are not stated, or where one of them is wrong already.
    """
    fitted, table = exam.fitted, exam.table
    usual = all(fitted.ways.get(role) is way for role, way in REPORT.items() if role in fitted.ways)
    told = any(d.kind == "unit" for d in exam.differences)
    if fitted.probe is None or fitted.force is None or told or not (usual and exam.firm):
        return
    index = table.rows[fitted.probe.k]
    for line in feeding(table):
        if line.unit is None or not line.sure or line.unit_place is None:
            continue
        own = replace(fitted.force, place=line.place(index), sign=1.0, e=None)
        off = _head_power_off(exam, inputs, line, own)
        if off:
            cells = [line.place(i) for k, i in sorted(table.rows.items()) if k >= 1]
            text = f"the head gives {line.unit}, but in that unit the numbers are {times_too(off)}"
            exam.add("unit", [line.unit_place, *cells], None, text, line.unit)


def _head_power_off(exam: Examination, inputs: Inputs, line: Line, own: Force) -> int:
    """By which power of ten the numbers of a column are too large for its unit; 0 if by none."""
    right = next(
        (
            (kind, times)
            for kind, unit, times in _quantities(exam, inputs)
            if same_dimension(line.unit or "", unit)
        ),
        None,
    )
    if right is None:
        return 0
    constant = _constant_factor(own, exam.fitted.six, right[0])
    if constant is None:
        return 0
    off = math.log10(constant / right[1] * float(to_si(line.unit or "")))
    return round(off) if abs(off - round(off)) < _CLOSE else 0


def _quantities(exam: Examination, inputs: Inputs) -> list[tuple[str, str, float]]:
    """The quantities whose size is known: kind, SI unit, and factor to SI units."""
    X, W = (exam.units.get(name, 0.0) for name in ("depth", start_of_row(exam.table)[0]))
    A = exam.units.get("deceleration", 2 * W - X)
    known = [("area", "m2", math.pi * 10.0 ** (2 * X))]
    mass, radius, density = (exam.inputs.get(r) for r in ("mass", "radius", "particle_density"))
    stated = any(
        role in inputs.cells and inputs.cells[role].item in inputs.stated
        for role in ("mass", "particle_density")
    )
    if not (exam.firm_speed and stated and radius is not None):
        return known
    M = mass.si if mass is not None else mass_of(radius.si, density.si) if density else math.nan
    known.append(("pressure", "Pa", M / math.pi * 10.0 ** (A - 2 * X)))
    known.append(("force", "N", M * 10.0**A))
    return known


def _constant_factor(own: Force, six: Six, kind: str) -> float | None:
    """The factor of a column to its quantity by the six numbers; None if it is another quantity."""
    if not (six.G > 0 and six.H > 0 and 0 < six.D < math.inf):
        return None
    ratios = []
    for depth, speed in _SHARES:
        x, u = depth * six.D, speed * math.sqrt(six.H / six.G)
        area, pressure = six.D * x - x * x, six.G * u * u + six.H
        wanted = {"area": area, "pressure": pressure, "force": area * pressure}[kind]
        ratios.append(abs(own(x, u)) / wanted)
    same = all(math.isclose(ratio, ratios[0], rel_tol=1e-7) for ratio in ratios)
    return ratios[0] if same and 0 < ratios[0] < math.inf else None
