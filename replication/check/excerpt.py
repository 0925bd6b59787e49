"""A few rows typed off the report, with too few digits to be fitted: compared with the report's."""

import math

from replication.check.examination import Examination
from replication.check.six import Step, run_scheme
from replication.check.taken import OTHER_STEP, is_report, report_inputs, report_six
from replication.models.impact import STOP_VELOCITY

_CLOSE = 1e-3
"""Relative uncertainty of the report's rows: it prints its mass, say, with three digits."""
_STEP = 0.2
"""Relative difference up to which typed times tell a step; the report's differ by a factor 2.5."""
_MOST_WRONG = 0.25
"""If more of the numbers are not the report's, its rows are not meant."""
_KNOWN = ("velocity", "resistance")


def judge_excerpt(exam: Examination) -> bool:
    """Compare rows with those of the report's case whose inputs cells hold; False if there is none.

    Each number is compared by itself, to its own digits: so those after a wrong one are not
    accused, although the digits of a row are too few to calculate the next one.
    """
    steps = _rows_meant(exam)
    if steps is None:
        return False
    wrong, count = [], 0
    for role in exam.table.lines:
        unit = 10.0 ** exam.units.get(role, 0.0)
        for k, step in enumerate(steps, 1):
            value = exam.table.number(role, k)
            if value is None:
                continue
            wanted = getattr(step, role) / unit if role != "time" else k * _step(exam) / unit
            wanted = wanted * exam.fitted.sign if role == "deceleration" else wanted
            count += 1
            if abs(value - wanted) > exam.table.lines[role].rounding(wanted) + _CLOSE * abs(wanted):
                wrong.append((role, k, wanted))
    if len(wrong) > _MOST_WRONG * count:
        return False
    for role, k, wanted in wrong:
        text = "the number is not that of the report's row"
        exam.add("typed number", [exam.table.place(role, k)], wanted, text)
    return True


def _rows_meant(exam: Examination) -> list[Step] | None:
    """The rows of the report's case, if a table has no formulas, and too few digits for a fit."""
    table, inputs = exam.table, exam.inputs
    if exam.fitted.probe is not None or math.isfinite(exam.fitted.six.G) or not table.whole:
        return None
    size = "radius" if "radius" in inputs else "diameter"
    known = [inputs[role] for role in (*_KNOWN, size) if role in inputs]
    if len(known) < 3 or not all(is_report(entry.role, entry.si) for entry in known):
        return None
    if any(line.computed for line in table.lines.values()) or not _step(exam):
        return None
    return run_scheme(report_six(inputs["resistance"].si, _step(exam)), STOP_VELOCITY)


def _step(exam: Examination) -> float:
    """The report's step that typed times, or else the depths, tell; 0 if they tell none [s]."""
    steps = (*report_inputs()["step"], OTHER_STEP)
    time = exam.fitted.time
    own = exam.fitted.six.c * 10.0 ** exam.units.get("depth", 0.0)
    if time is not None:
        own = time * 10.0 ** exam.units.get("time", 0.0)
    return next((s for s in steps if math.isclose(own, s, rel_tol=_STEP)), 0.0)
