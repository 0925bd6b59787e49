"""What is wrong with one table, cell by cell: each difference with its kind, place and cause.

Every cell is compared with what the cells before it give, so a wrong one is found where it stands
and what follows from it is not accused. A column in which most cells follow another rule than the
report's is one difference, named by that rule.
"""

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from statistics import median

from replication.check.difference import (
    NO_FAULT,
    Difference,
    power_of_ten,
    quantity,
    scaled,
    title,
    titles,
    unit_text,
)
from replication.check.inputs import NEAR, Input, Setting, agreement, braked, solve
from replication.check.irregular import irregular, types
from replication.check.scheme import (
    ADVANCES,
    BRAKES,
    ENDINGS,
    REPORT,
    STARTS,
    Case,
    Rule,
    Rules,
    march,
    orders,
    with_input,
)
from replication.check.lines import address
from replication.check.words import COLUMNS
from spreadsheets.foreign import Position
from spreadsheets.recalculation import Calculation

__all__ = ["Verdict", "judge", "rank"]

_LIMIT = 20_000
"""Rows that a run computed for comparison may have."""

Report = Mapping[str, tuple[float, ...]]
Text = float | str | None


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


def judge(setting: Setting, calculation: Calculation, report: Report) -> Verdict:
    """Every difference between a table and the report's sheet, but for its printed numbers."""
    judged = _Judge(setting, calculation, report)
    judged.units()
    judged.inputs()
    if setting.digits is None:
        judged.cell_by_cell()
    else:
        judged.as_rounded(setting.digits)
    judged.stop()
    return judged.verdict()


def rank(place: Position, setting: Setting, calculation: Calculation) -> tuple[float, ...]:
    """When a cell is calculated: the inputs first, then row by row, then what rests on the table."""
    table = setting.table
    if place in table.places:
        role, k = table.places[place]
        return (1, k, 9 if role == "time" else list(COLUMNS).index(role))
    for line in table.helpers:
        if line.covers(place):
            return (1, (place[2] if line.across else place[1]) - table.zero, 2.5)
    order = calculation.order.get(place, -1)
    return (0 if place in setting.read or order < 0 else 2, order)


class _Judge:
    def __init__(self, setting: Setting, calculation: Calculation, report: Report) -> None:
        self.setting, self.calculation, self.report = setting, calculation, report
        self.table = setting.table
        self.rules = REPORT
        self.found: list[Difference] = []

    @property
    def case(self) -> Case:
        return self.setting.case

    def add(
        self, kind: str, cells: Sequence[Position], expected: Text, found: Text, text: str
    ) -> None:
        order = rank(cells[0], self.setting, self.calculation)
        if isinstance(expected, float) and not math.isfinite(expected):
            expected = None
        self.found.append(Difference(cells[0], kind, expected, found, text, tuple(cells), order))

    def cells(self, role: str, first: int, last: int | None = None) -> list[Position]:
        last = self.table.steps if last is None else last
        return [self.table.place(role, k) for k in range(first, max(first, last) + 1)]

    def shown(self, role: str, value: float | None) -> float | None:
        """A value in SI as its column holds it, in the column's unit and with its sign."""
        if value is None:
            return None
        sign = -1.0 if role == "deceleration" and self.setting.negative else 1.0
        return sign * scaled(value, Fraction(10) ** -self.setting.powers[role])

    def held(self, place: Position) -> Text:
        value = self.calculation.values.get(place)
        return value if isinstance(value, float | str) else None

    # ---- units and inputs

    def units(self) -> None:
        """Units in heads that contradict the rest."""
        for role, slip in self.setting.slips.items():
            line, right = self.table.lines[role], unit_text(role, self.setting.powers[role])
            place = line.unit_place or self.table.place(role, 1)
            text = f"the head gives {title(role)} in {line.unit}, but the numbers are in {right}"
            self.add("unit", [place], right, line.unit, f"{text}, a factor of 1e{abs(slip)}")

    def inputs(self) -> None:
        """Other inputs than the report's; a single one that is a power of ten off has a wrong unit."""
        stated = {
            role: own
            for role, own in self.setting.inputs.items()
            if role in self.report and role != "mass" and own.how not in ("report", "follows")
        }
        off = {
            role: own
            for role, own in stated.items()
            if not any(math.isclose(own.si, value, rel_tol=1e-12) for value in self.report[role])
        }
        for role, own in off.items():
            nearest = min(self.report[role], key=lambda value: abs(value - own.si))
            text = f"{title(role)} is {quantity(own.si, role)}, in the report {quantity(nearest, role)}"
            if role == "target_density":
                text += ", inferred, since the report prints none"
            if own.how == "rows":
                text += "; no cell holds it, it is solved back from the rows"
            place = own.place or self.table.place("depth", 1)
            kind = "unit" if len(off) == 1 and power_of_ten(own.si / nearest) else "other input"
            found = own.si if own.place is None else self.calculation.number(own.place)
            self.add(kind, [place], scaled(nearest, 1 / own.factor), found, text)

    def calibrate(self) -> None:
        """An input that the rows take in another unit than its label says."""
        if max(self.share("brake", rule) for rule in BRAKES) >= 0.5:
            return
        powers = [sign * power for power in (3, 6, 9, 12, 1, 2) for sign in (-1, 1)]
        for role, own in self.setting.inputs.items():
            if own.place is not None and role not in ("beta", "stop_velocity", "mass"):
                for power in powers:
                    if self.shifted(own, power):
                        return

    def shifted(self, own: Input, power: int) -> bool:
        """Whether the rows agree with an input times a power of ten; if so, take it so."""
        factor = Fraction(10) ** power
        value = scaled(own.si, factor)
        if own.role == "flow_stress":
            tried = with_input(self.case, "resistance", scaled(self.case.resistance, factor))
        else:
            tried = with_input(self.case, own.role, value)
        setting = self.setting.with_case(tried)
        if agreement(setting) < 0.9:
            return False
        self.setting = setting
        assert own.place is not None
        text = (
            f"the formulas take {title(own.role)} as {quantity(value, own.role)}, not "
            f"{quantity(own.si, own.role)}: a factor of 1e{abs(power)} is missing"
        )
        right = scaled(own.si, 1 / factor / own.factor)
        self.add("unit", [own.place], right, self.calculation.number(own.place), text)
        return True

    def derived(self) -> None:
        """Mass, diameter and resistance as the workbook has them, against what they rest on."""
        known = {own.role: own for own in (*self.setting.unread, *self.setting.inputs.values())}
        resistance = self.case.resistance
        if "beta" in known and "flow_stress" in known:
            resistance = known["beta"].si * known["flow_stress"].si
        for role, wanted, of in (
            ("diameter", 2 * self.case.radius, ("radius",)),
            ("mass", self.case.mass, ("radius", "particle_density")),
            ("resistance", resistance, ("beta", "flow_stress")),
        ):
            cell = self.setting.derived.get(role)
            sources = [known[name] for name in of if name in known]
            if cell is not None and any(source.place for source in sources):
                self.derived_cell(cell, wanted, sources)

    def derived_cell(self, cell: Input, wanted: float, sources: Sequence[Input]) -> None:
        role, place = cell.role, cell.place
        assert place is not None
        number = self.calculation.number(place) or 0.0
        factor = cell.factor
        if (
            cell.unit is None
            and (power := power_of_ten(wanted / number) if number else None) is not None
        ):
            factor = Fraction(10) ** power
        held = scaled(number, factor)
        right = math.isclose(held, wanted, rel_tol=NEAR)
        rests = titles(source.role for source in sources)
        expected = scaled(wanted, 1 / factor)
        if place in self.calculation.formulas:
            power = power_of_ten(held / wanted)
            if power:
                size = "large" if power > 0 else "small"
                text = f"{title(role)} is 1e{abs(power)} times too {size} for {rests}"
                self.add("unit", [place], expected, number, f"{text}: a unit is not converted")
            elif not right:
                self.add(
                    "odd formula",
                    [place],
                    expected,
                    number,
                    f"{title(role)} is not what {rests} give",
                )
        elif self.calculated and (not right or any(s in self.setting.unread for s in sources)):
            text = f"{title(role)} is typed as a number, though it rests on {rests}: a change there changes nothing"  # noqa: E501
            self.add("typed constant", [place], expected, number, text)
        if not right or (role == "mass" and factor == 1):
            case = {"mass": {"own_mass": held}, "diameter": {"own_diameter": held},
                    "resistance": {"resistance": held}}[role]  # fmt: skip
            self.setting = self.setting.with_case(replace(self.case, **case))

    @property
    def calculated(self) -> bool:
        """Whether the table has formulas at all."""
        return any(place in self.calculation.formulas for place in self.table.places)

    # ---- which scheme it is

    def cell_by_cell(self) -> None:
        """Judge each cell by what the cells before it hold."""
        self.calibrate()
        self.derived()
        self.choose()
        self.each_cell()
        self.typed_inputs()
        self.order()

    def share(self, part: str, rule: Rule) -> float:
        """Which share of its rows follows a rule."""
        follows = [self.follows(part, rule, k) for k in range(_FIRST[part], self.table.steps + 1)]
        judged = [follow for follow in follows if follow is not None]
        return sum(judged) / len(judged) if judged else 0.0

    def follows(self, part: str, rule: Rule, k: int) -> bool | None:
        """Whether a row follows a rule; None where cells are missing."""
        rows = self.setting.rows
        wanted = rule.value(self.case, rows, k)
        found = braked(rows, self.case, k) if part == "brake" else rows(_ROLE[part], k)
        if wanted is None or found is None:
            return None
        speed = abs(rows("velocity_initial", k) or 0.0)
        size = speed if part == "end" else abs(wanted)
        # Where no column holds the deceleration, the velocities' own rounding is in it.
        rounded = part == "brake" and "deceleration" not in rows.columns
        slack = 1e-15 * speed / self.case.step if rounded else 0.0
        return abs(found - wanted) <= NEAR * size + slack

    def choose(self) -> None:
        """The rules that most rows follow, and a difference for each that is not the report's."""
        chosen = {"start": next((r for r in STARTS if self.follows("start", r, 1)), STARTS[0])}
        unknown = []
        for part, rules in (("advance", ADVANCES), ("brake", BRAKES), ("end", ENDINGS)):
            if part == "end" and "deceleration" not in self.table.lines:
                continue  # the brake is known by it
            share, best = self.share(part, rules[0]), rules[0]
            for rule in rules[1:] if share < 0.9 else ():
                other = self.share(part, rule)
                share, best = max((share, best), (other, rule), key=lambda entry: entry[0])
            chosen[part] = best if share >= 0.5 else rules[0]
            if share < 0.5:
                unknown.append(part)
        self.rules = replace(REPORT, **chosen)
        for part in unknown:
            self.unknown(part)
        self.named()

    def named(self) -> None:
        """A difference for each rule that is not the report's."""
        for part, rule in self.rules.others():
            role, first = self.column(part), _FIRST[part]
            own = REPORT.part(part)
            first = next(
                (k for k in range(first, self.table.steps) if not self.follows(part, own, k)), first
            )
            wanted = own.value(self.case, self.setting.rows, first) if role == _ROLE[part] else None
            last = first if part == "start" else None
            cells = self.cells(role, first, last)
            self.add("other scheme", cells, self.shown(role, wanted), self.held(cells[0]),
                     f"{rule.name}: {rule.says}")  # fmt: skip

    def column(self, part: str) -> str:
        """The column that shows a part of the scheme."""
        candidates = (_ROLE[part], "velocity_final", "velocity_initial")
        return next(role for role in candidates if role in self.table.lines)

    def unknown(self, part: str) -> None:
        """A column that follows no rule known here: say what else would explain it."""
        role = self.column(part)
        cells = self.cells(role, _FIRST[part])
        wanted = REPORT.part(part).value(self.case, self.setting.rows, _FIRST[part])
        kind, text = self.cause(part, role)
        self.add(kind, cells, self.shown(role, wanted), self.held(cells[0]), text)

    def cause(self, part: str, role: str) -> tuple[str, str]:
        pairs = [self.increment(part, k) for k in range(_FIRST[part], self.table.steps + 1)]
        ratios = [found / wanted for found, wanted in filter(None, pairs) if wanted]
        middle = median(ratios) if ratios else 0.0
        if middle and sum(_near(ratio, middle) for ratio in ratios) >= 0.5 * len(ratios):
            return self.factor(part, middle, role)
        if part == "brake":
            return self.stresses(role)
        return "other scheme", "these cells follow no scheme known here"

    def increment(self, part: str, k: int) -> tuple[float, float] | None:
        """What a row adds to the one before, and what it would add by the report's rule."""
        rows = self.setting.rows
        start = {"brake": 0.0, "advance": rows("depth", k - 1), "end": rows("velocity_initial", k)}[
            part
        ]
        found = braked(rows, self.case, k) if part == "brake" else rows(_ROLE[part], k)
        wanted = REPORT.part(part).value(self.case, rows, k)
        if start is None or found is None or wanted is None:
            return None
        return found - start, wanted - start

    def factor(self, part: str, ratio: float, role: str) -> tuple[str, str]:
        """What a column is that is a constant times what it should be."""
        what = "force" if part == "brake" else "step"
        literals = self.literals(role)
        if power := power_of_ten(ratio):
            size = "large" if power > 0 else "small"
            return (
                "unit",
                f"every {what} is 1e{abs(power)} times too {size}: a unit is not converted",
            )
        for number in literals:
            if part == "brake" and _near(number / math.pi, ratio):
                return "typed constant", f"pi is typed as {number:g}"
            if part != "brake" and _near(number / self.case.step, ratio):
                return "typed constant", f"the time step is typed as {number:g}"
        named = next((name for value, name in _FACTORS if _near(value, ratio)), f"{ratio:.6g}")
        return "other scheme", f"every {what} is {named} times that of the report's scheme"

    def stresses(self, role: str) -> tuple[str, str]:
        """Whether another target density or resistance explains all decelerations."""
        unknown = "other scheme", "these cells follow no scheme known here"
        solved = solve(self.setting.rows, self.case)
        if solved is None:
            return unknown
        tried = dict(zip(("target_density", "resistance"), solved, strict=True))
        setting = self.setting.with_case(replace(self.case, **tried))
        if agreement(setting, 1e-8) < 0.5:
            return unknown
        said, kind = [], "other scheme"
        for name, value in tried.items():
            own = getattr(self.case, name)
            typed = [n for n in self.literals(role) if math.isclose(n, value, rel_tol=1e-7)]
            if not math.isclose(own, value, rel_tol=1e-7):
                kind = "typed constant" if typed else kind
                value = typed[0] if typed else float(f"{value:.8g}")
                said.append(f"{title(name)} {quantity(value, name)}, not {quantity(own, name)}")
        self.setting = setting
        where = "stands in these formulas" if kind == "typed constant" else "would give every row"
        return (kind, f"{' and '.join(said)}, {where}") if said else unknown

    def literals(self, role: str) -> set[float]:
        """The numbers typed into a column's formulas."""
        places = self.cells(role, 0)
        formulas = (self.calculation.formulas.get(place) for place in places)
        return {abs(number) for formula in formulas if formula for number in formula.literals}

    # ---- each cell

    def each_cell(self) -> None:
        """Every cell that is not what those before it give, and every cell unlike its column."""
        lines = (*self.table.lines.values(), *self.table.helpers)
        odd = {p: why for line in lines for p, why in irregular(line, self.table, self.calculation)}
        accused = {cell for d in self.found if d.kind not in NO_FAULT for cell in d.cells}
        for role, column in self.setting.rows.columns.items():
            for k in range(self.table.steps + 1):
                place, expected = self.table.place(role, k), self.expected(role, k)
                if place in odd:
                    kind, text = odd.pop(place)
                    if error := self.calculation.error(place):
                        kind, text = "odd formula", f"{text}; it gives {error}"
                elif place not in accused and self.fails(role, k, expected):
                    kind, text = self.lone(role, k, expected)
                else:
                    continue
                shown, found = self.shown(role, expected), column.get(k)
                if found is not None and expected is not None and _near(found, expected):
                    text += "; it gives the right value here"
                self.add(kind, [place], shown, self.held(place), text)
        for place, (kind, text) in odd.items():
            self.add(kind, [place], None, self.held(place), text)
        self.found = list(_joined(self.found, self.table.across))

    def expected(self, role: str, k: int) -> float | None:
        """What a cell should hold by the rules that its table follows."""
        rows = self.setting.rows
        if role == "time":
            before = rows.columns["time"].get(k - 1, (k - 1) * self.case.step)
            return before + self.case.step if k else None
        if role == "velocity_final" and k == 0:
            return self.case.velocity
        if role.startswith("velocity") and k > (role == "velocity_initial"):
            if role == "velocity_initial" and "velocity_final" in rows.columns:
                return rows("velocity_final", k - 1)
            row = k if role == "velocity_final" else k - 1
            if "deceleration" in rows.columns:
                return self.rules.end.value(self.case, rows, row)
            a, v = self.rules.brake.value(self.case, rows, row), rows("velocity_initial", row)
            return None if a is None or v is None else v - a * self.case.step
        return self.rules.value(role, self.case, rows, k)

    def fails(self, role: str, k: int, expected: float | None) -> bool:
        """Whether a cell is not what it should hold."""
        column = self.setting.rows.columns[role]
        found = column.get(k)
        if found is None:
            inside = bool(column) and min(column) < k < max(column)
            return self.breaks(self.table.place(role, k)) or (
                inside and not self.calculation.error(self.table.place(role, k))
            )
        if expected is None:
            return False
        size = abs(expected)
        if role.startswith("velocity"):
            size = max(size, abs(self.setting.rows("velocity_initial", max(k - 1, 0)) or 0.0))
        return abs(found - expected) > NEAR * size

    def breaks(self, place: Position) -> bool:
        """Whether a cell gives an error that comes from no other cell of the table."""
        formula = self.calculation.formulas.get(place)
        if formula is None or not self.calculation.error(place):
            return False
        read = (cell for area in formula.areas if area.cells == 1 for cell in [area.corner])
        return not any(cell != place and self.calculation.error(cell) for cell in read)

    def lone(self, role: str, k: int, expected: float | None) -> tuple[str, str]:
        """The kind of a cell that alone is not what the cells before it give."""
        place = self.table.place(role, k)
        found, typed = (
            self.setting.rows.columns[role].get(k),
            place not in self.calculation.formulas,
        )
        what = f"{title(role)} of row {k} is not what the cells before it give"
        if error := self.calculation.error(place):
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

    def typed_inputs(self) -> None:
        """Inputs whose value stands in formulas that do not read their cell."""
        accused = {cell for d in self.found for cell in d.cells}
        typed = {role: self.literals(role) for role in self.table.lines}
        for own in (*self.setting.unread, *self.setting.inputs.values()):
            if own.place is None:
                continue
            for role in self.table.lines:
                if not typed[role] and own.role != "velocity":
                    continue
                places = self.cells(role, 0)
                cells = [
                    place
                    for k, place in enumerate(places)
                    if place not in accused and self.typed_in(own, role, k, place)
                ]
                # A number in a few formulas of many is one of their own, such as the row's.
                if len(cells) >= 0.5 * len(places) or set(cells) & set(places[:2]):
                    found = self.calculation.book[cells[0]].formula or self.held(cells[0])
                    where = address(own.place, with_sheet=own.place[0] != cells[0][0])
                    text = f"{title(own.role)} is typed into {title(role)}; {where} holds it, and a change there changes nothing here"  # noqa: E501
                    self.add("typed constant", cells, where, found, text)

    def typed_in(self, own: Input, role: str, k: int, place: Position) -> bool:
        """Whether a cell has an input's value as a number, though a cell for it exists."""
        formula = self.calculation.formulas.get(place)
        if formula is not None:
            return types(formula, own, self.calculation)
        # The impact velocity typed into the first row, while its own cell is read by nothing.
        first = own.role == "velocity" and role.startswith("velocity") and k <= 1
        return first and own in self.setting.unread and self.calculation.number(place) is not None

    # ---- last digits

    def order(self) -> None:
        """Columns whose last digits no order of the report's operations gives."""
        factors = {
            own.factor for own in (*self.setting.inputs.values(), *self.setting.derived.values())
        }
        if any(self.setting.powers.values()) or factors != {Fraction(1)} or self.rules != REPORT:
            return  # converting units costs last digits, too
        accused = {cell for d in self.found if d.kind not in NO_FAULT for cell in d.cells}
        for role in ("depth", "deceleration", "velocity_final"):
            column = self.setting.rows.columns.get(role, {})
            rows = [k for k in column if k and self.table.place(role, k) not in accused
                    and self.table.place(role, k) in self.calculation.formulas]  # fmt: skip
            differ = rows and min((self.differing(role, rows, m) for m in self.masses()), key=len)
            if differ:
                found = column[differ[0]]
                wanted = min(self.ordered(role, differ[0], self.case), key=lambda v: abs(v - found))
                cells = [self.table.place(role, k) for k in differ]
                ulps = round(abs(wanted - found) / math.ulp(wanted))
                text = (
                    f"{len(differ)} of {len(rows)} cells of {title(role)} differ in the last digits, "
                    f"this one by {ulps} ulp: the formula calculates in another order, on which no "
                    "printed digit depends"
                )
                self.add(
                    "operation order", cells, self.shown(role, wanted), self.held(cells[0]), text
                )

    def masses(self) -> Iterator[float]:
        """The mass as its cell has it; without a cell, as any order of its product gives it."""
        low = high = self.case.mass
        yield low
        if "mass" not in self.setting.derived:
            for _ in range(4):
                low, high = math.nextafter(low, 0.0), math.nextafter(high, math.inf)
                yield from (low, high)

    def differing(self, role: str, rows: Sequence[int], mass: float) -> list[int]:
        """The rows whose value no order gives."""
        case, column = replace(self.case, own_mass=mass), self.setting.rows.columns[role]
        return [k for k in rows if column[k] not in (self.ordered(role, k, case) or {column[k]})]

    def ordered(self, role: str, k: int, case: Case) -> set[float]:
        rows = self.setting.rows
        x, v = rows("depth", k), rows("velocity_initial", k)
        if role == "deceleration":
            return set() if x is None or v is None else orders(case, x, v)
        value = self.rules.value(role, case, rows, k)
        return set() if value is None else {value}

    # ---- rounded numbers

    def as_rounded(self, digits: int) -> None:
        """Judge typed and rounded numbers by whole runs, of the scheme that fits them best."""
        schemes = [REPORT, *(
            replace(REPORT, **{part: rule})
            for part, rules in (("brake", BRAKES), ("start", STARTS), ("advance", ADVANCES), ("end", ENDINGS))
            for rule in rules[1:]
        )]  # fmt: skip
        self.rules = min(schemes, key=lambda rules: len(list(self.misprints(rules, digits))))
        self.named()
        for place, expected, text in self.misprints(self.rules, digits):
            self.add("typed number", [place], expected, self.held(place), text)

    def misprints(self, rules: Rules, digits: int) -> Iterator[tuple[Position, float, str]]:
        """Numbers that do not round as a scheme's do."""
        run = march(self.case, rules, until=self.table.steps, limit=self.table.steps)
        for role in set(run) & set(self.table.lines):
            for k, value in run[role].items():
                found, wanted = self.table.number(role, k), self.shown(role, value)
                if found is None or wanted is None or (k == 0 and role == "velocity_final"):
                    continue
                last = 10.0 ** (math.floor(math.log10(abs(wanted))) + 1 - digits) if wanted else 0.0
                if abs(found - wanted) > last * (0.5 + 1e-9):
                    text = f"{title(role)} of row {k} is not what the scheme gives"
                    yield self.table.place(role, k), float(f"{wanted:.{digits}g}"), text

    # ---- the end

    def stop(self) -> None:
        """Whether the rows end with the first velocity below the stop."""
        steps, stop = self.table.steps, self.case.stop_velocity
        finals = {k: v for k in range(1, steps + 1) if (v := self.final(k)) is not None}
        below = next((k for k, v in finals.items() if v < stop), None)
        right = max(march(self.case, limit=steps + 1)["depth"])
        if not finals or below == steps or (below != steps and right == steps):
            return  # with as many rows as there should be, where they end follows from the rest
        last = finals[max(finals)]
        role = "velocity_final" if "velocity_final" in self.table.lines else "velocity_initial"
        if below is not None:
            cells = self.cells(role, below + 1)
            text = f"other stop: the rows go on after the velocity has fallen below {stop:g} m/s, to {last:.3g} m/s"  # noqa: E501
            self.add("other scheme", cells, None, self.held(cells[0]), text)
            return
        whole = max(march(self.case, self.rules, limit=_LIMIT)["depth"])
        text = f"the rows end at {last:.4g} m/s, before the stop at {stop:g} m/s"
        of = f"{whole:,} steps" if whole < _LIMIT else f"more than {_LIMIT:,} steps"
        place = self.table.place(role, steps)
        if 2 * steps < whole:
            self.add("not calculated", [place], None, None, f"{text}: {steps} of {of}")
        else:
            self.add(
                "other scheme",
                [place],
                None,
                self.held(place),
                f"other stop: {text}, {steps} of {of}",
            )

    def final(self, k: int) -> float | None:
        """The velocity at the end of a row, computed where the table ends before it shows it."""
        rows = self.setting.rows
        final = rows("velocity_final", k)
        if final is not None or k < self.table.steps:
            return final
        v, a = rows("velocity_initial", k), rows("deceleration", k)
        a = self.rules.brake.value(self.case, rows, k) if a is None else a
        return None if v is None or a is None else v - a * self.case.step

    # ---- what it comes to

    def verdict(self) -> Verdict:
        """All of it, with the final depths and the difference that explains them."""
        steps, rows = self.table.steps, self.setting.rows
        run = march(self.case, limit=_LIMIT)
        ends = run["velocity_final"].get(max(run["depth"]), math.inf) < self.case.stop_velocity
        pairs = [
            (value, rows.columns[role].get(k))
            for role in set(run) & set(rows.columns)
            for k, value in run[role].items()
        ]
        differing = sum(
            own is not None and abs(own - value) > 1e-9 * abs(value) for value, own in pairs
        )
        found = sorted((self.with_effect(d) for d in self.found), key=lambda d: d.rank)
        right = run["depth"][max(run["depth"])] if ends else None
        return Verdict(self.setting, self.rules, found, rows("depth", steps), right, differing)

    def with_effect(self, difference: Difference) -> Difference:
        """The difference with the final depth that it alone would give."""
        fixed: dict[tuple[str, int], float] = {}
        rules, until = REPORT, None
        if difference.kind == "other scheme":
            named = [
                part for part, rule in self.rules.others() if rule.says in difference.explanation
            ]
            rules = replace(rules, **{part: self.rules.part(part) for part in named})
            until = None if named else self.table.steps
        elif difference.kind in ("typed number", "odd formula", "typed constant"):
            for place in difference.cells:
                role, k = self.table.places.get(place, ("", 0))
                value = self.setting.rows.columns.get(role, {}).get(k)
                if value is not None:
                    fixed[role, k] = value
        if rules == REPORT and until is None and not fixed:
            return difference
        run = march(self.case, rules, fixed, limit=2 * self.table.steps + 100, until=until)
        return replace(difference, effect=run["depth"][max(run["depth"])])


_ROLE = {"start": "depth", "advance": "depth", "brake": "deceleration", "end": "velocity_final"}
_FIRST = {"start": 1, "advance": 2, "brake": 1, "end": 1}
_FACTORS = (
    (2.0, "2"), (0.5, "1/2"), (math.pi, "pi"), (1 / math.pi, "1/pi"), (4.0, "4"), (0.25, "1/4"),
    (8.0, "8"), (0.125, "1/8"), (4 / 3, "4/3"), (0.75, "3/4"), (3.0, "3"), (1 / 3, "1/3"),
)  # fmt: skip


def _near(a: float, b: float) -> bool:
    return math.isclose(a, b, rel_tol=1e-9)


def _joined(found: Iterable[Difference], across: bool) -> Iterator[Difference]:
    """Neighbouring cells of one line with the same kind and cause, as one difference."""
    line, along = (1, 2) if across else (2, 1)
    runs: list[list[Difference]] = []
    for d in sorted(found, key=lambda d: (d.kind, d.place[0], d.place[line], d.place[along])):
        last = runs[-1][-1] if runs else None
        if last and (last.kind, _like(last)) == (d.kind, _like(d)):
            end = last.cells[-1]
            if (end[0], end[line], end[along] + 1) == (d.place[0], d.place[line], d.place[along]):
                runs[-1].append(d)
                continue
        runs.append([d])
    for run in runs:
        yield replace(run[0], cells=tuple(cell for d in run for cell in d.cells))


def _like(difference: Difference) -> str:
    """The explanation without its numbers."""
    return re.sub(r"\d+(?:\.\d+)?(?:[eE][-+]?\d+)?", "#", difference.explanation)
