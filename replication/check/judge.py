"""What is wrong with one table, cell by cell: each difference with its kind, place and cause.

Every cell is compared with what the cells before it give, so a wrong one is found where it stands
and what follows from it is not accused. A column in which most cells follow another rule than the
report's is one difference, named by that rule.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from replication.check.cells import each_cell, order
from replication.check.findings import Difference, Findings
from replication.check.givens import calibrate, derived, other_inputs, typed_inputs, units
from replication.check.inputs import Setting
from replication.check.recognize import as_rounded, choose
from replication.check.scheme import REPORT, Rules, march
from spreadsheets.recalculation import Calculation

_LIMIT = 20_000
"""Rows that a run computed for comparison may have."""


@dataclass
class Verdict:
    """What was found out about one table; depths in m.

    `right_depth` is that of the report's scheme with the table's inputs, None if it does not end.
    `differing` counts the cells that differ from that run, causes and consequences alike.
    """

    setting: Setting
    rules: Rules
    differences: list[Difference]
    final_depth: float | None
    right_depth: float | None
    differing: int

    @property
    def ends(self) -> bool:
        """Whether the rows go down to the stop."""
        return not any(d.kind == "not calculated" for d in self.differences)


def judge(
    setting: Setting, calculation: Calculation, report: Mapping[str, tuple[float, ...]]
) -> Verdict:
    """Every difference between a table and the report's sheet, but for its printed numbers.

    `report` are the report's values of each input, in SI.
    """
    f = Findings(setting, calculation, report)
    units(f)
    if setting.digits is None:
        calibrate(f)
        derived(f)
    other_inputs(f)
    if setting.digits is None:
        choose(f)
        each_cell(f)
        typed_inputs(f)
        order(f)
    else:
        as_rounded(f, setting.digits)
    _stop(f)
    return _verdict(f)


def _stop(f: Findings) -> None:
    """Whether the rows end with the first velocity below the stop."""
    steps, stop = f.table.steps, f.case.stop_velocity
    finals = {k: v for k in range(1, steps + 1) if (v := _final(f, k)) is not None}
    below = next((k for k, v in finals.items() if v < stop), None)
    right = max(march(f.intended, limit=steps + 1)["depth"])
    if not finals or below == steps or (below != steps and right == steps):
        return  # with as many rows as there should be, where they end follows from the rest
    last = finals[max(finals)]
    role = "velocity_final" if "velocity_final" in f.table.lines else "velocity_initial"
    if below is not None:
        cells = f.cells(role, below + 1)
        text = f"other stop: the rows go on after the velocity has fallen below {stop:g} m/s, to {last:.3g} m/s"  # noqa: E501
        f.add("other scheme", cells, None, text)
        return
    run = march(f.case, f.rules, limit=_LIMIT)["velocity_final"]
    whole = max(run, default=0)
    if whole <= steps or (run[whole] >= stop and whole < _LIMIT):
        return  # the rules that the rows follow do not lead to the stop by themselves
    text = f"the rows end at {last:.4g} m/s, before the stop at {stop:g} m/s"
    of = f"{whole:,} steps" if whole < _LIMIT else f"more than {_LIMIT:,} steps"
    place = f.table.place(role, steps)
    # With other inputs than the report's the rows prepared for those run out, and an excerpt has
    # few; but who leaves off shortly before the report does stops at another velocity.
    changed = any(difference.kind == "other input" for difference in f.differences)
    if changed or 2 * steps < whole:
        f.add("not calculated", [place], None, f"{text}: {steps} of {of}")
    else:
        f.add("other scheme", [place], None, f"other stop: {text}, {steps} of {of}")


def _final(f: Findings, k: int) -> float | None:
    """The velocity at the end of a row, computed where the table ends before it shows it."""
    final = f.setting.rows("velocity_final", k)
    return f.slowed(k) if final is None and k == f.table.steps else final


def _verdict(f: Findings) -> Verdict:
    """All of it, with the final depths and the difference that explains them."""
    steps, rows = f.table.steps, f.setting.rows
    run = march(f.intended, limit=_LIMIT)
    ends = run["velocity_final"].get(max(run["depth"]), math.inf) < f.intended.stop_velocity
    pairs = [
        (value, run[role].get(k))
        for role in set(run) & set(rows.columns)
        for k, value in rows.columns[role].items()
        if k in run[role] or k > max(run["depth"])
    ]
    differing = sum(right is None or abs(own - right) > 1e-9 * abs(right) for own, right in pairs)
    found = sorted((_with_effect(f, d) for d in f.differences), key=lambda d: d.rank)
    right = run["depth"][max(run["depth"])] if ends else None
    return Verdict(f.setting, f.rules, found, rows("depth", steps), right, differing)


def _with_effect(f: Findings, difference: Difference) -> Difference:
    """The difference with the final depth that it alone would give."""
    fixed: dict[tuple[str, int], float] = {}
    rules, case = REPORT, f.intended
    if not f.rules.brake.says:
        rules = replace(rules, brake=f.rules.brake)
    if difference.kind == "other scheme":
        named = [part for part, rule in f.rules.others() if rule.says in difference.explanation]
        rules = replace(rules, **{part: f.rules.part(part) for part in named})
    elif difference.place in f.spoils:
        case = f.spoils[difference.place](case)
    elif difference.kind in ("typed number", "odd formula", "typed constant"):
        for place in difference.cells:
            role, k = f.table.places.get(place, ("", 0))
            value = f.setting.rows.columns.get(role, {}).get(k)
            if value is not None:
                fixed[role, k] = value
    else:
        return difference
    depths = march(case, rules, fixed, limit=f.table.steps, until=f.table.steps)["depth"]
    return replace(difference, effect=depths.get(f.table.steps))
