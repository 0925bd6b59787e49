"""Which scheme a table follows: rule by rule, by what most of its rows do."""

import math
from collections.abc import Iterator
from dataclasses import replace
from statistics import median

from replication.check.findings import Findings
from replication.check.inputs import agreement, filled, follows, share, solve
from replication.check.scheme import (
    ADVANCES,
    BRAKES,
    ENDINGS,
    PARTS,
    REPORT,
    STARTS,
    Rules,
    march,
)  # fmt: skip
from replication.check.words import power_of_ten, quantity, times_too, title
from spreadsheets.foreign import Position

_FACTORS = (
    (2.0, "2"), (0.5, "1/2"), (math.pi, "pi"), (1 / math.pi, "1/pi"), (4.0, "4"), (0.25, "1/4"),
    (8.0, "8"), (0.125, "1/8"), (4 / 3, "4/3"), (0.75, "3/4"), (3.0, "3"), (1 / 3, "1/3"),
)  # fmt: skip


_UNKNOWN = "other scheme", "these cells follow no scheme that this program knows"


def _near(a: float, b: float) -> bool:
    return math.isclose(a, b, rel_tol=1e-9)


def choose(f: Findings) -> None:
    """The rules that most rows follow, and a difference for each that is not the report's."""
    chosen = {"start": next((r for r in STARTS if follows(f.setting, "start", r, 1)), STARTS[0])}
    unknown = []
    for part, rules in (("advance", ADVANCES), ("brake", BRAKES), ("end", ENDINGS)):
        if part == "end" and "deceleration" not in f.table.lines:
            continue  # the brake is known by it
        shares = {rules[0]: share(f.setting, part, rules[0])}
        if shares[rules[0]] < 0.9:
            shares |= {rule: share(f.setting, part, rule) for rule in rules[1:]}
        best = max(shares, key=lambda rule: shares[rule])
        if shares[best] < 0.5:
            unknown.append(part)
        else:
            chosen[part] = best
    own, beyond = BRAKES[0], next(r for r in BRAKES if r.name == "area beyond the radius")
    if "brake" in chosen and not _reaches_radius(f):
        # What the area is beyond the radius does not matter to a sheet that should not get there.
        rest = [share(f.setting, "brake", rule) for rule in (own, chosen["brake"])]
        deeper = share(f.setting, "brake", beyond)
        if deeper > rest[0] and deeper >= rest[1]:
            chosen["brake"] = replace(beyond, says="")
    f.rules = replace(REPORT, **chosen)
    for part in unknown:
        _unknown(f, part)
    named(f)


def _reaches_radius(f: Findings) -> bool:
    """Whether the sheet, if it were right, would get as deep as the particle's radius."""
    return max(march(f.intended)["depth"].values()) >= f.intended.radius


def named(f: Findings) -> None:
    """A difference for each rule that is not the report's."""
    for part, rule in f.rules.others():
        own, role, (fills, first) = REPORT.part(part), _column(f, part), PARTS[part]
        differ = (k for k in range(first, f.table.steps) if not follows(f.setting, part, own, k))
        first = next(differ, first)
        wanted = own.value(f.case, f.setting.rows, first) if role == fills else None
        cells = f.cells(role, first, first if part == "start" else None)
        f.add("other scheme", cells, f.shown(role, wanted), f"{rule.name}: {rule.says}")


def _column(f: Findings, part: str) -> str:
    """The column that shows a part of the scheme."""
    candidates = (PARTS[part][0], "velocity_final", "velocity_initial")
    return next(role for role in candidates if role in f.table.lines)


def _unknown(f: Findings, part: str) -> None:
    """A column that follows no rule known here: say what else would explain it."""
    role = _column(f, part)
    first = PARTS[part][1]
    wanted = REPORT.part(part).value(f.case, f.setting.rows, first)
    kind, text = _cause(f, part, role)
    f.add(kind, f.cells(role, first), f.shown(role, wanted), text)


def _cause(f: Findings, part: str, role: str) -> tuple[str, str]:
    pairs = [_increment(f, part, k) for k in range(PARTS[part][1], f.table.steps + 1)]
    ratios = [found / wanted for found, wanted in filter(None, pairs) if wanted]
    middle = median(ratios) if ratios else 0.0
    if middle and sum(_near(ratio, middle) for ratio in ratios) >= 0.5 * len(ratios):
        return _factor(f, part, middle, role)
    if part == "brake":
        return _stresses(f, role) or _UNKNOWN
    return _UNKNOWN


def _increment(f: Findings, part: str, k: int) -> tuple[float, float] | None:
    """What a row adds to the one before, and what it would add by the report's rule."""
    rows = f.setting.rows
    starts = {"brake": 0.0, "advance": rows("depth", k - 1), "end": rows("velocity_initial", k)}
    start, found = starts[part], filled(part, rows, f.case, k)
    wanted = REPORT.part(part).value(f.case, rows, k)
    if start is None or found is None or wanted is None:
        return None
    return found - start, wanted - start


def _factor(f: Findings, part: str, ratio: float, role: str) -> tuple[str, str]:
    """What a column is that is a constant times what it should be."""
    what = "force" if part == "brake" else "step"
    literals = f.literals(role)
    if power := power_of_ten(ratio):
        return "unit", f"every {what} is {times_too(power)}: a unit is not converted"
    for number in literals:
        if part == "brake" and _near(number / math.pi, ratio):
            return "typed constant", f"pi is typed as {number:g}"
        if part != "brake" and _near(number / f.case.step, ratio):
            return "typed constant", f"the time step is typed as {number:g}"
    named = next((name for value, name in _FACTORS if _near(value, ratio)), f"{ratio:.6g}")
    return "other scheme", f"every {what} is {named} times that of the report's scheme"


def _stresses(f: Findings, role: str) -> tuple[str, str] | None:
    """Whether another target density or resistance explains all decelerations."""
    tried = solve(f.setting.rows, f.case)
    setting = f.setting.with_case(replace(f.case, **tried))
    if agreement(setting, 1e-8) < 0.5:
        return None
    said, kind = [], "other scheme"
    for name, value in tried.items():
        own = getattr(f.case, name)
        typed = [n for n in f.literals(role) if math.isclose(n, value, rel_tol=1e-7)]
        if not math.isclose(own, value, rel_tol=1e-7):
            kind = "typed constant" if typed else kind
            value = typed[0] if typed else float(f"{value:.8g}")
            said.append(f"{title(name)} {quantity(value, name)}, not {quantity(own, name)}")
    f.setting = setting
    where = "stands in these formulas" if kind == "typed constant" else "would give every row"
    return (kind, f"{' and '.join(said)}, {where}") if said else None


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
        f.add("typed number", [place], expected, text)


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
