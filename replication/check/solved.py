"""Inputs that no cell holds and that rows of numbers give: those that are not the report's."""

import math
from collections.abc import Sequence

from replication.check.examination import NO_FAULT, Examination
from replication.check.six import Six, first_speed
from replication.check.taken import FEW_DIGITS, OTHER_STEP, SAME, report_inputs, six_in_si
from replication.check.words import title, with_si_unit
from spreadsheets.foreign import Position

_MOST_DIGITS = 10
"""So many digits are shown of a number that was solved."""
_MORE_DIGITS = 6
"""As two numbers that differ do so by more than `SAME`, so many digits more tell them apart."""
_RATIOS = "the rows tell only the ratios of both densities and the resistance"


def tell_solved(exam: Examination) -> None:
    """Report inputs that rows without formulas give and that are not the report's: no fault.

    Rows do not tell the mass: if no cell holds it, or a part of it, the target's density and its
    resistance are known only over the particle density.
    """
    if exam.fitted.probe is not None or any(d.kind not in NO_FAULT for d in exam.differences):
        return
    six, errors = six_in_si(exam), exam.fitted.errors
    of_force = max(errors.G, errors.H) + 3 * errors.D
    slack = {"velocity": errors.V, "step": errors.c, "radius": errors.D,
             "target_density": of_force, "resistance": of_force}  # fmt: skip
    for role, error in slack.items():
        entry = exam.inputs.get(role)
        if entry is None or entry.how != "rows" or error > FEW_DIGITS:
            continue
        known = (*report_inputs()[role], *([OTHER_STEP] if role == "step" else []))
        if any(_agree(exam, entry.si, value, error) for value in known):
            continue
        texts = [with_si_unit(value, role) for value in report_inputs()[role]]
        shown, printed = _unlike(texts, entry.si, error, role), " or ".join(texts)
        exam.other_inputs.append(f"{title(role)} {shown}")
        text = f"by the rows {title(role)} is {shown}, in the report {printed}"
        exam.add("other input", [_shown_in(exam, role)], None, text, entry.si)
    if not exam.inputs.keys() & {"target_density", "resistance"} and of_force <= FEW_DIGITS:
        _tell_ratios(exam, six, of_force)


def _agree(exam: Examination, value: float, wanted: float, error: float) -> bool:
    """Whether an input is the report's as far as the digits tell, in any unit if none is stated."""
    power = math.log10(value / wanted)
    off = power if exam.firm and exam.firm_speed else power - round(power)
    return abs(off) * math.log(10) <= max(SAME, error)


def _unlike(texts: Sequence[str], value: float, error: float, role: str) -> str:
    """An input as text, with as many digits as are known, or as tell it from these texts.

    >>> _unlike(["500 m/s"], 449.98765, 1e-3, "velocity")
    '450 m/s'
    >>> _unlike(["500 m/s"], 500.004, 7e-6, "velocity")
    '500.004 m/s'
    """
    text = ""
    for more in range(_MORE_DIGITS + 1):
        text = with_si_unit(_as_known(value, error, more), role, _MOST_DIGITS + more)
        if text not in texts:
            break
    return text


def _as_known(value: float, error: float, more: int = 0) -> float:
    """A number with as many digits as its relative error leaves, and some more.

    >>> _as_known(1.0999999999999986e-05, 1e-9), _as_known(449.98765, 1e-3)
    (1.1e-05, 450.0)
    """
    digits = min(_MOST_DIGITS, max(2, math.floor(-math.log10(max(error, 1e-15)))))
    return float(f"{value:.{digits + more - 1}e}")


def _shown_in(exam: Examination, role: str) -> Position:
    """The first cell in which an input shows."""
    table = exam.table
    start = first_speed(table)
    if role == "velocity" and start is not None:
        return start
    first = max(1, min(table.rows))
    column = {"radius": "depth", "step": "time" if "time" in table.lines else "depth"}.get(
        role, exam.fitted.brakes
    )
    return table.place(column, first + (role in ("step", "resistance")))


def _tell_ratios(exam: Examination, six: Six, error: float) -> None:
    """Report the target's density and resistance over the particle density.

    2 G M / pi = rho_t and H M / pi = R_t, with M = 4/3 pi R^3 rho_p.
    """
    report = report_inputs()
    cube = (six.D / 2) ** 3
    density, strength = 8 / 3 * six.G * cube, 4 / 3 * six.H * cube
    particle = report["particle_density"][0]
    printed = [(value / particle) for value in report["resistance"]]
    if not (density > 0 and strength > 0):
        return
    shown = [f"{_as_known(value, error):.10g}" for value in (density, strength)]
    phrase = (
        f"the target density {shown[0]} times the particle density, and the target resistance "
        f"{shown[1]} J/kg times it"
    )
    exam.other_inputs.append(f"{phrase} ({_RATIOS})")
    there = " or ".join(f"{value:.7g} J/kg" for value in printed)
    text = f"by the rows: {phrase}; in the report {report['target_density'][0] / particle:.7g} "
    place = _shown_in(exam, "target_density")
    exam.add("other input", [place], None, f"{text}and {there}; {_RATIOS}", density)
