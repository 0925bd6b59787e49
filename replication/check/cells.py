"""Each cell of a table, by what the cells before it give and by what its column is."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction

from replication.check.difference import power_of_ten, title
from replication.check.findings import Findings, joined
from replication.check.inputs import NEAR
from replication.check.irregular import irregular
from replication.check.recognize import named
from replication.check.scheme import (
    ADVANCES,
    BRAKES,
    ENDINGS,
    REPORT,
    STARTS,
    Case,
    Rules,
    march,
    orders,
)  # fmt: skip
from spreadsheets.foreign import Position

__all__ = ["as_rounded", "each_cell", "order"]


def each_cell(f: Findings) -> None:
    """Every cell that is not what those before it give, and every cell unlike its column."""
    lines = (*f.table.lines.values(), *f.table.helpers)
    odd = {p: why for line in lines for p, why in irregular(line, f.table, f.calculation)}
    accused = f.accused
    for role, column in f.setting.rows.columns.items():
        for k in range(f.table.steps + 1):
            place, expected = f.table.place(role, k), _expected(f, role, k)
            if place in odd:
                kind, text = odd.pop(place)
                if error := f.calculation.error(place):
                    kind, text = "odd formula", f"{text}; it gives {error}"
                elif reason := f.calculation.uncomputed.get(place):
                    kind, text = "odd formula", f"{text}; it is not computed here: {reason}"
            elif place not in accused and _fails(f, role, k, expected):
                kind, text = _lone(f, role, k, expected)
            else:
                continue
            shown, found = f.shown(role, expected), column.get(k)
            if found and expected and math.isclose(found, expected, rel_tol=1e-9):
                text += "; it gives the right value here"
            f.add(kind, [place], shown, f.held(place), text)
    for place, (kind, text) in odd.items():
        f.add(kind, [place], None, f.held(place), text)
    f.differences = list(joined(f.differences, f.table.across))


def _expected(f: Findings, role: str, k: int) -> float | None:
    """What a cell should hold by the rules that its table follows."""
    rows = f.setting.rows
    if role == "time":
        before = rows.columns["time"].get(k - 1, (k - 1) * f.case.step)
        return before + f.case.step if k else None
    if role == "velocity_final" and k == 0:
        return f.case.velocity
    if role.startswith("velocity") and k > (role == "velocity_initial"):
        if role == "velocity_initial" and "velocity_final" in rows.columns:
            return rows("velocity_final", k - 1)
        row = k if role == "velocity_final" else k - 1
        if "deceleration" in rows.columns:
            return f.rules.end.value(f.case, rows, row)
        a, v = f.rules.brake.value(f.case, rows, row), rows("velocity_initial", row)
        return None if a is None or v is None else v - a * f.case.step
    return f.rules.value(role, f.case, rows, k)


def _fails(f: Findings, role: str, k: int, expected: float | None) -> bool:
    """Whether a cell is not what it should hold."""
    column = f.setting.rows.columns[role]
    found = column.get(k)
    if found is None:
        inside = bool(column) and min(column) < k < max(column)
        return _breaks(f, f.table.place(role, k)) or (
            inside and not f.calculation.error(f.table.place(role, k))
        )
    if expected is None:
        return False
    size = abs(expected)
    if role.startswith("velocity"):
        size = max(size, abs(f.setting.rows("velocity_initial", max(k - 1, 0)) or 0.0))
    return abs(found - expected) > NEAR * size


def _breaks(f: Findings, place: Position) -> bool:
    """Whether a cell gives an error that comes from no other cell of the table."""
    formula = f.calculation.formulas.get(place)
    if formula is None or not f.calculation.error(place):
        return False
    read = (cell for area in formula.areas if area.cells == 1 for cell in [area.corner])
    return not any(cell != place and f.calculation.error(cell) for cell in read)


def _lone(f: Findings, role: str, k: int, expected: float | None) -> tuple[str, str]:
    """The kind of a cell that alone is not what the cells before it give."""
    place = f.table.place(role, k)
    found, typed = (
        f.setting.rows.columns[role].get(k),
        place not in f.calculation.formulas,
    )
    what = f"{title(role)} of row {k} is not what the cells before it give"
    if error := f.calculation.error(place):
        return (
            "odd formula",
            f"{title(role)} of row {k} gives {error}, as do all cells that read it",
        )
    if found is None:
        return (
            "typed number" if typed else "odd formula",
            f"no number in {title(role)} of row {k}",
        )
    if role == "time" and k == 1 and found == 0:
        return "other scheme", "the times are those at the beginning of the rows"
    if role == "depth" and k == 1 and not typed:
        return "other scheme", "the first depth is neither half a step nor a whole one"
    power = power_of_ten(found / expected) if expected else None
    if power:
        return "unit", f"{what}: a factor of 1e{abs(power)}"
    return "typed number" if typed else "odd formula", what


def order(f: Findings) -> None:
    """Columns whose last digits no order of the report's operations gives."""
    factors = {own.factor for own in (*f.setting.inputs.values(), *f.setting.derived.values())}
    if any(f.setting.powers.values()) or factors != {Fraction(1)} or f.rules != REPORT:
        return  # converting units costs last digits, too
    accused = f.accused
    for role in ("depth", "deceleration", "velocity_final"):
        column = f.setting.rows.columns.get(role, {})
        rows = [k for k in column if k and f.table.place(role, k) not in accused
                and f.table.place(role, k) in f.calculation.formulas]  # fmt: skip
        differ = rows and min((_differing(f, role, rows, m) for m in _masses(f)), key=len)
        if differ:
            found = column[differ[0]]
            wanted = min(_ordered(f, role, differ[0], f.case), key=lambda v: abs(v - found))
            cells = [f.table.place(role, k) for k in differ]
            ulps = round(abs(wanted - found) / math.ulp(wanted))
            text = (
                f"{len(differ)} of {len(rows)} cells of {title(role)} differ in the last digits, "
                f"this one by {ulps} ulp: the formula calculates in another order, on which no "
                "printed digit depends"
            )
            f.add("operation order", cells, f.shown(role, wanted), f.held(cells[0]), text)


def _masses(f: Findings) -> Iterator[float]:
    """The mass as its cell has it; without a cell, as any order of its product gives it."""
    low = high = f.case.mass
    yield low
    if "mass" not in f.setting.derived:
        for _ in range(4):
            low, high = math.nextafter(low, 0.0), math.nextafter(high, math.inf)
            yield from (low, high)


def _differing(f: Findings, role: str, rows: Sequence[int], mass: float) -> list[int]:
    """The rows whose value no order gives."""
    case, column = replace(f.case, own_mass=mass), f.setting.rows.columns[role]
    return [k for k in rows if column[k] not in (_ordered(f, role, k, case) or {column[k]})]


def _ordered(f: Findings, role: str, k: int, case: Case) -> set[float]:
    rows = f.setting.rows
    x, v = rows("depth", k), rows("velocity_initial", k)
    if role == "deceleration":
        return set() if x is None or v is None else orders(case, x, v)
    value = f.rules.value(role, case, rows, k)
    return set() if value is None else {value}


def as_rounded(f: Findings, digits: int) -> None:
    """Judge typed and rounded numbers by whole runs, of the scheme that fits them best."""
    parts = {"brake": BRAKES, "start": STARTS, "advance": ADVANCES, "end": ENDINGS}
    others = [replace(REPORT, **{part: rule}) for part in parts for rule in parts[part][1:]]
    schemes = [REPORT, *others]
    # Some rules need another brake to go with them: by themselves they give no rows.
    able = [rules for rules in schemes if _run(f, rules)["depth"].keys() >= {f.table.steps}]
    f.rules = min(able, key=lambda rules: len(list(_misprints(f, rules, digits))))
    named(f)
    for place, expected, text in _misprints(f, f.rules, digits):
        f.add("typed number", [place], expected, f.held(place), text)


def _run(f: Findings, rules: Rules) -> dict[str, dict[int, float]]:
    return march(f.case, rules, until=f.table.steps, limit=f.table.steps)


def _misprints(f: Findings, rules: Rules, digits: int) -> Iterator[tuple[Position, float, str]]:
    """Numbers that do not round as a scheme's do."""
    run = _run(f, rules)
    for role in set(run) & set(f.table.lines):
        for k, value in run[role].items():
            found, wanted = f.table.number(role, k), f.shown(role, value)
            if found is None or wanted is None or (k == 0 and role == "velocity_final"):
                continue
            last = 10.0 ** (math.floor(math.log10(abs(wanted))) + 1 - digits) if wanted else 0.0
            if abs(found - wanted) > last * (0.5 + 1e-9):
                text = f"{title(role)} of row {k} is not what the scheme gives"
                yield f.table.place(role, k), float(f"{wanted:.{digits}g}"), text
