"""The inputs of a table as its formulas take them, as they should be, and the report's."""

import math
from fractions import Fraction
from functools import cache

from reference.ledger import claims_of_case, load
from replication.check.examination import AnotherModelError, Examination, near
from replication.check.fit import TableFit
from replication.check.roles import Input, Inputs
from replication.check.six import Six, start_of_row
from replication.check.words import INPUT_UNITS, as_known, digits_of, times_too, title, with_si_unit

OTHER_STEP = 5e-10
"""The report's second time step [s]; the first one is among its printed inputs."""
_NO_BETA = 1e3
"""No beta is so large; a flow stress in Pa is larger."""
_FULL = 15
"""A number with so many digits is not rounded."""
_MASS_DIGITS = 4
"""So many digits are shown of a mass that is expected."""
_DIGITS = 3
"""A mass is typed with so many digits at least."""
SAME = 1e-6
"""Relative difference up to which a number that was solved is one that was typed."""
FEW_DIGITS = 0.05
"""Rows whose digits admit larger errors do not tell by themselves which case they belong to."""
_FAR = 3.0
"""Two steps that differ by so many times what their digits admit are two."""
_ALIKE = 3
"""So many other inputs must be the report's where one is called a thousand times too large."""


@cache
def report_inputs() -> dict[str, tuple[float, ...]]:
    """The report's inputs in SI units; two of beta and resistance, the first those of Table A-1."""
    values: dict[str, list[float]] = {}
    for beta in (5, 3):
        case = {name: float(load().value(claim)) for name, claim in claims_of_case(beta).items()}
        case["resistance"] = case["beta"] * case["flow_stress"]
        case["diameter"] = 2 * case["radius"]
        case["mass"] = mass_of(case["radius"], case["particle_density"])
        for name, value in case.items():
            known = values.setdefault(name, [])
            if value not in known:
                known.append(value)
    return {name: tuple(known) for name, known in values.items()}


def mass_of(radius: float, density: float) -> float:
    """M = (4/3) pi R^3 rho_p [kg]."""
    return 4 / 3 * math.pi * radius**3 * density


def report_six(resistance: float, step: float) -> Six:
    """The six numbers of one of the report's cases, in SI units."""
    report = report_inputs()
    M = report["mass"][0]
    G, H = math.pi * report["target_density"][0] / (2 * M), math.pi * resistance / M
    return Six(G, H, report["diameter"][0], step, step, report["velocity"][0])


def report_case(six: Six | None, fitted: TableFit) -> str | None:
    """The report's case that six numbers in SI units belong to, whatever the step; None if none.

    They may differ by what the digits of the rows admit; what these do not tell is no case.
    """
    if six is None:
        return None
    close = max(SAME, *fitted.errors)
    if close > FEW_DIGITS:
        return None
    for beta, resistance in zip((5, 3), report_inputs()["resistance"], strict=True):
        wanted = report_six(resistance, six.c)._replace(e=six.e)
        if all(math.isclose(a, b, rel_tol=close) for a, b in zip(six, wanted, strict=True)):
            return f"beta-{beta}"
    return None


def take_inputs(exam: Examination, inputs: Inputs) -> None:
    """Note the inputs in SI units: from cells, from typed numbers, or solved from the fit."""
    for role in INPUT_UNITS:
        source = inputs.cells.get(role) or inputs.derived.get(role)
        if source is None:
            continue
        label, unit = inputs.label(source)
        how = "formulas" if source.cell is None else inputs.how.get(role, "response")
        value = _in_si(source.value, inputs.powers.get(source.item, 0.0))
        exam.inputs[role] = Input(role, value, source.cell, how, label, unit, source.value)
    six, errors = six_in_si(exam), exam.fitted.errors
    for role, value, error in (
        ("step", six.c, errors.c), ("velocity", six.V, errors.V), ("radius", six.D / 2, errors.D),
    ):  # fmt: skip
        known = role in exam.inputs or (role == "radius" and "diameter" in exam.inputs)
        told = 0 < value < math.inf and error <= FEW_DIGITS
        if not known and told and (role != "step" or _times_agree(exam)):
            exam.inputs[role] = Input(role, value, None, "rows", error=error)
    if "diameter" in exam.inputs and "radius" not in exam.inputs:
        half = exam.inputs["diameter"].si / 2
        exam.inputs["radius"] = Input("radius", half, None, "follows", "diameter")
    if "resistance" not in exam.inputs and {"beta", "flow_stress"} <= exam.inputs.keys():
        product = exam.inputs["beta"].si * exam.inputs["flow_stress"].si
        exam.inputs["resistance"] = Input(
            "resistance", product, None, "follows", "beta and flow stress"
        )
    if exam.fitted.probe is None:
        _as_in_report(exam, six)
    _solve_rest(exam, six)


def _times_agree(exam: Examination) -> bool:
    """Whether the times, if there are any, grow by the step of the depths, in some unit."""
    fitted, units = exam.fitted, exam.units
    if fitted.time is None or not (fitted.time > 0 and fitted.six.c > 0):
        return True
    unit = units.get("depth", 0.0) - units.get(start_of_row(exam.table)[0], 0.0)
    off = math.log10(fitted.time / fitted.six.c) + units.get("time", 0.0) - unit
    close = max(SAME, _FAR * (fitted.time_error + fitted.errors.c))
    return abs(off - round(off)) <= math.log10(1 + close)


def _in_si(value: float, power: float) -> float:
    """A number in SI units, rounded once where the unit is a power of ten."""
    if power == round(power) and math.isfinite(value):
        return float(Fraction(repr(value)) * Fraction(10) ** round(power))
    return float(value * 10.0**power)


def six_in_si(exam: Examination) -> Six:
    """The six numbers of a table in SI units.

    Raises AnotherModelError if one of them is beyond the range of doubles.
    """
    return _converted(exam, exam.fitted.six, 1)


def six_in_columns(exam: Examination, six: Six) -> Six:
    """Six numbers in SI units in those of the columns of a table; errors as in `six_in_si`."""
    return _converted(exam, six, -1)


def _converted(exam: Examination, six: Six, way: int) -> Six:
    """Six numbers in SI units if `way` is 1, or out of them if it is -1."""
    X = way * exam.units.get("depth", 0.0)
    W = way * exam.units.get(start_of_row(exam.table)[0], 0.0)
    shown = exam.units.get("deceleration")
    A = 2 * W - X if shown is None else way * shown
    try:
        return Six(
            six.G * 10.0 ** (A - 2 * W - 2 * X), six.H * 10.0 ** (A - 2 * X), six.D * 10.0**X,
            six.c * 10.0 ** (X - W), six.e * 10.0 ** (W - A), six.V * 10.0**W,
        )  # fmt: skip
    except OverflowError as error:
        raise AnotherModelError("its numbers are beyond those that a double can hold") from error


def _as_in_report(exam: Examination, six: Six) -> None:
    """Take the report's inputs for those that no cell holds, if the rows agree with one case."""
    report, inputs = report_inputs(), exam.inputs
    if (case := report_case(six, exam.fitted)) is None:
        return
    close = max(SAME, exam.fitted.errors.c)
    resistance = report["resistance"][0 if case == "beta-5" else 1]
    values = {role: report[role][0] for role in (
        "velocity", "radius", "particle_density", "target_density")}  # fmt: skip
    for step in (*report["step"], OTHER_STEP):
        if math.isclose(six.c, step, rel_tol=close):
            values["step"] = step
    for role, value in (values | {"resistance": resistance}).items():
        if role not in inputs or inputs[role].how == "rows":
            inputs[role] = Input(role, value, None, "report")


def _solve_rest(exam: Examination, six: Six) -> None:
    """Solve inputs that no cell holds from the six numbers.

    These give the ratios of both densities and the resistance. If no cell holds any of the three,
    the report's particle density is taken where it leads to the report's target density.
    """
    inputs, radius = exam.inputs, exam.inputs.get("radius")
    error = exam.fitted.errors.of_force
    if radius is None or not (six.G > 0 and six.H > 0 and error < math.inf):
        return
    volume = mass_of(radius.si, 1.0)
    M = None
    if "mass" in inputs:
        M = inputs["mass"].si
    elif "particle_density" in inputs:
        M = volume * inputs["particle_density"].si
    elif "target_density" in inputs:
        M = math.pi * inputs["target_density"].si / (2 * six.G)
    elif "resistance" in inputs:
        M = math.pi * inputs["resistance"].si / six.H
    else:
        density, target = (report_inputs()[role][0] for role in (
            "particle_density", "target_density"))  # fmt: skip
        errors = exam.fitted.errors
        close = max(SAME, errors.G + 3 * errors.D)
        own = 2 * six.G * volume * density / math.pi
        if close > FEW_DIGITS or not math.isclose(own, target, rel_tol=close):
            return
        M = volume * density
    solved = {
        "particle_density": M / volume, "target_density": 2 * six.G * M / math.pi,
        "resistance": six.H * M / math.pi,
    }  # fmt: skip
    for role, value in solved.items():
        inputs.setdefault(role, Input(role, value, None, "rows", error=error))


def compare_with_report(exam: Examination, inputs: Inputs) -> None:
    """Report inputs that are not the report's, which is no fault.

    It is one if all others are the report's, and this one is it but for a power of ten.
    """
    report = report_inputs()
    _swapped_labels(exam)
    _mass_of_rows(exam)
    typed = [
        role for role, entry in exam.inputs.items()
        if entry.place and role in report and role != "stop_velocity"
        and (role in inputs.cells or role not in inputs.derived or _of_numbers(exam, role))
    ]  # fmt: skip
    others = [role for role in typed if not is_report(role, exam.inputs[role].si)]
    accused = {d.place for d in exam.differences}
    for role in others:
        entry = exam.inputs[role]
        assert entry.place is not None
        if entry.place in accused:
            continue
        known = (*report[role], OTHER_STEP) if role == "step" else report[role]
        off = next(filter(None, (_input_power_off(entry, value) for value in known)), 0)
        is_slip = off % 3 == 0 or off % 2 == 0  # a unit ten times another one is unusual
        alone = len(others) == 1 and len(typed) - 1 >= _ALIKE
        weak = role == "flow_stress" and entry.si < _NO_BETA and len(typed) - len(others) >= _ALIKE
        if off and is_slip and (alone or weak):
            taken = with_si_unit(entry.si, role)
            text = f"the formulas take {title(role)} as {taken}, {times_too(off)}"
            exam.add("unit", [entry.place], entry.value / 10.0**off, text)
            exam.corrected = (role, entry.si / 10.0**off)
            continue
        shown = " or ".join(with_si_unit(value, role) for value in report[role])
        exam.other_inputs.append(f"{title(role)} {with_si_unit(entry.si, role)}")
        text = f"{title(role)} is {with_si_unit(entry.si, role)}, in the report {shown}"
        exam.add("other input", [entry.place], None, text)


def _mass_of_rows(exam: Examination) -> None:
    """Report a mass beside rows without formulas that is not 4/3 pi R^3 rho_p.

    Rows tell no mass. If they are those of a case of the report, it is that of the radius and the
    particle density of this case, to its own digits.
    """
    mass = exam.inputs.get("mass")
    radius, density = (exam.inputs.get(role) for role in ("radius", "particle_density"))
    if mass is None or mass.place is None or radius is None or density is None:
        return
    if exam.fitted.probe is not None or density.how != "report":
        return
    wanted = mass_of(radius.si, density.si)
    digits, last = digits_of(mass.value)
    cut = 10.0**last if digits < _FULL else 0.0  # some cut digits off instead of rounding
    if abs(mass.value - wanted * mass.value / mass.si) <= cut + SAME * abs(mass.value):
        return
    shown = with_si_unit(as_known(wanted, 10.0**-_MASS_DIGITS), "mass")
    off = _input_power_off(mass, wanted)
    wrong = f"{times_too(off)}, and so " if off else ""
    text = (
        f"{title('mass')} is {wrong}not the {shown} of 4/3 pi R^3 rho_p with the radius "
        f"{with_si_unit(radius.si, 'radius')} and the particle density "
        f"{with_si_unit(density.si, 'particle_density')}, with which the rows agree"
    )
    exam.add("unit" if off else "typed number", [mass.place], wanted * mass.value / mass.si, text)


_PARTS = {
    "mass": ("radius", "diameter", "particle_density"), "resistance": ("beta", "flow_stress"),
    "diameter": ("radius",),
}  # fmt: skip
"""The inputs from which formulas compute others."""


def _swapped_labels(exam: Examination) -> None:
    """Report labels of beta and flow stress that name each other's number.

    A beta, a ratio of stresses, is no thousand, and no flow stress is below a thousand Pa.
    """
    beta, stress = exam.inputs.get("beta"), exam.inputs.get("flow_stress")
    if beta is None or stress is None or beta.place is None or stress.place is None:
        return
    if beta.si >= _NO_BETA > stress.si and "label" in (beta.how, stress.how):
        text = f"the labels of {title('beta')} and {title('flow_stress')} are swapped: beta would "
        exam.add("unit", [beta.place, stress.place], stress.value, f"{text}be {beta.si:.10g}")


def _of_numbers(exam: Examination, role: str) -> bool:
    """Whether an input is computed from typed numbers alone: it is then an input by itself."""
    parts = [exam.inputs[part] for part in _PARTS.get(role, ()) if part in exam.inputs]
    return all(part.place is None for part in parts)


def _input_power_off(entry: Input, value: float) -> int:
    """By which power of ten an input is not a value of the report; 0 if it is another number.

    A mass, which the report does not print, may be typed with few digits.
    """
    if not 0 < entry.si < math.inf:
        return 0
    if entry.role == "mass" and (digits := digits_of(entry.value)[0]) >= _DIGITS:
        value = float(f"{value:.{digits - 1}e}")
    power = math.log10(entry.si) - math.log10(value)
    return round(power) if abs(power - round(power)) < 1e-9 else 0


def is_report(role: str, value: float) -> bool:
    """Whether an input in SI units is the report's, or its second step."""
    known = (*report_inputs().get(role, ()), *([OTHER_STEP] if role == "step" else []))
    return any(near(value, each) for each in known)


def intend(exam: Examination) -> None:
    """Find the six numbers that the inputs should give, in SI units."""
    six = six_in_si(exam)
    si = {role: entry.si for role, entry in exam.inputs.items()}
    if exam.corrected is not None:
        role, value = exam.corrected
        si[role] = value
        si.pop("diameter" if role == "radius" else "", None)
    D = 2 * si["radius"] if "radius" in si else six.D
    M = None
    if "particle_density" in si and "radius" in si:
        M = mass_of(si["radius"], si["particle_density"])
    if "mass" in si and (M is None or exam.inputs["particle_density"].how == "rows"):
        M = si["mass"]
    strength = si.get("resistance")
    if {"beta", "flow_stress"} <= si.keys():
        strength = si["beta"] * si["flow_stress"]
    G = math.pi * si["target_density"] / (2 * M) if M and "target_density" in si else six.G
    H = math.pi * strength / M if M and strength else six.H
    step = si.get("step", six.c)
    exam.intended = Six(G, H, D, step, step, si.get("velocity", six.V))
