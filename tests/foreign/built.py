"""The workbook of a stranger's plan, right or with one slip, and what is true of it."""

import copy
import math
import random
from collections.abc import Iterable
from dataclasses import dataclass, field, replace

from foreign import writers
from foreign.layouts import BRAKE, DEPTH, END, START, TIME, Foreign, Place, letters
from foreign.slips import BEYOND, ROWS, Slip, kinds
from foreign.strangers import UNITS, Plan, draw
from foreign.truth import CLEAN, Truth, full
from foreign.vocabulary import FOREIGN, KNOWN, syllables


@dataclass
class Stranger:
    """A workbook with its stored values, and what is true of it."""

    plan: Plan
    slip: Slip | None
    book: Foreign
    truth: Truth
    values: writers.Values = field(default_factory=dict)


def build(plan: Plan, slip: Slip | None = None) -> Stranger | None:
    """Make the workbook of a plan; None if the slip changes nothing that could be seen."""
    right = _Builder(plan, None).stranger()
    if plan.style["second"] < 2 and plan.references != "names":
        _add_another(right, plan.seed)
    right.values = writers.calculated(right.book)
    if plan.digits is not None:
        _paste(right, plan.digits)
    if slip is None:
        return right
    if slip.name.startswith(("typed", "stale")) and slip.name != "typed constant":
        return _overwritten(right, slip)
    wrong = _Builder(plan, slip).stranger()
    added = {at: c for at, c in right.book.cells.items() if at not in wrong.book.cells}
    wrong.book.cells |= added
    wrong.values = writers.calculated(wrong.book)
    return wrong if _visible(right, wrong) else None


def _add_another(right: Stranger, seed: int) -> None:
    """Another right table with inputs of its own on sheets of its own."""
    plan = replace(draw(seed + 700_000, pasted=False), references="absolute")
    another = _Builder(plan, None).stranger().book
    sheets = {at[0] for at in another.cells}
    if sheets & {at[0] for at in right.book.cells}:
        return
    right.book.cells |= another.cells


def _paste(right: Stranger, digits: int) -> None:
    """Leave only numbers in the table, with few digits, and not all of the inputs."""
    cells, plan = right.book.cells, right.plan
    for at, text in list(cells.items()):
        value = right.values.get(at)
        if isinstance(text, str) and text.startswith("="):
            cells[at] = float(f"{value:.{digits}g}") if isinstance(value, float) else value
    kept = plan.style["inputs"] % 3
    for name, place in list(right.book.inputs.items()):
        if plan.inside and name == "velocity":
            continue
        if kept == 0 or (kept == 1 and name in ("radius", "target_density", "step")):
            del right.book.inputs[name]
            row, column = place[1], place[2]
            label = (row - 1, column) if plan.flat else (row, column - 1)
            for at in (label, (row, column), (row, column + 1), (row, column + 2)):
                if not (plan.flat and at[1] > column):
                    cells.pop((place[0], *at), None)
    right.values = {}


def _overwritten(right: Stranger, slip: Slip) -> Stranger | None:
    """A number typed over a formula, or a stored value that is not what the formula gives."""
    r = random.Random(f"value {right.plan.seed}")
    at = right.book.where[slip.column, slip.row or 1]
    value = right.values.get(at, right.book.cells[at])
    if not isinstance(value, float):
        return None
    wrong = replace(right, slip=slip, book=copy.deepcopy(right.book), values=dict(right.values))
    wrong.truth = _Builder(right.plan, slip).truth({})
    # A pasted number must be wrong by more than its digits and those of its neighbours leave open.
    factor = 1 + r.choice((1, -1)) * 10 ** r.uniform(-1.5 if right.plan.digits else -2.5, -0.5)
    match slip.name:
        case "typed":
            wrong.book.cells[at] = float(f"{value * factor:.{right.plan.digits or 5}g}")
        case "typed, right digits":
            wrong.book.cells[at] = float(f"{value:.{r.choice((6, 10, 17))}g}")
        case "stale":
            wrong.values[at] = value * factor
        case _:
            wrong.values[at] = value * (1 + r.choice((1, -1)) * 10 ** r.uniform(-10, -6))
    if slip.name.startswith("typed"):
        wrong.values = writers.calculated(wrong.book) if right.values else {}
    return wrong


def _visible(right: Stranger, wrong: Stranger) -> bool:
    """Whether a wrong formula can be told from the right one, and its table still has numbers.

    A typed constant and a wrong statement of a unit change no value.
    """
    assert wrong.slip
    texts = {at for at, c in wrong.book.cells.items() if right.book.cells.get(at) != c}
    if not texts:
        return False
    places = [at for at in right.book.where.values() if at in right.values]
    if not all(isinstance(wrong.values.get(at), float) for at in places):
        return False
    if wrong.slip.name in ("typed constant", "label", "head", "beyond the stop"):
        return True
    return any(_apart(right.values[at], wrong.values.get(at)) for at in texts if at in right.values)


def _apart(a: object, b: object) -> bool:
    """Whether two values differ by more than a millionth."""
    return not (isinstance(a, float) and isinstance(b, float)
                and math.isclose(a, b, rel_tol=1e-6))  # fmt: skip


class _Builder:
    """The cells of one workbook. Its methods return texts of formulas in SI units."""

    def __init__(self, plan: Plan, slip: Slip | None) -> None:
        self.plan, self.slip = plan, slip
        self.r = random.Random(f"cells {plan.seed}")
        names = ["Sheet1", "Tabelle1", "calc", "Hárok1", "run 7", "シート1", "x"]
        self.sheet = self.r.choice(names)
        self.input_sheet = self.sheet if plan.inputs_at != "sheet" else self.r.choice(["In", "p q"])
        self.book = Foreign(plan.name, plan.impact, si=False)
        self.cell_of: dict[str, Place] = {}
        self.touched: dict[str, set[Place]] = {}
        self.steps = plan.steps
        self.rows = self.steps + plan.spare
        if slip and slip.name == "beyond the stop":
            self.rows += BEYOND
        gap = 2 if plan.style["gap"] == 0 else 1
        self.left = 1 + plan.style["left"] % 5
        self.top = self._height() + 3 + plan.style["top"]
        start = self.left if plan.across else self.top
        heads = 2 if plan.unit_of_column == "row" else 1
        self.origin = start + heads  # the row or column of the impact
        first = self.top if plan.across else self.left
        self.line = {name: first + i * gap for i, name in enumerate(plan.columns)}
        if plan.inside:
            self.cell_of["velocity"] = self.book.inputs["velocity"] = self.at(START, 0)

    def _height(self) -> int:
        """How many rows the inputs take above the table."""
        if self.plan.inputs_at != "above":
            return 0
        return 3 if self.plan.flat else len(self.plan.given) + 5

    def stranger(self) -> Stranger:
        self._put_inputs()
        self._put_heads()
        for name in self.plan.columns:
            for k in range(0 if self.plan.zero else 1, self.rows + 1):
                self._put_row(name, k)
        results = self._put_results()
        self._put_notes()
        return Stranger(self.plan, self.slip, self.book, self.truth(results))

    # words

    def word(self, name: str) -> str:
        """The words for an input or a column."""
        match self.plan.words:
            case "known":
                return self.r.choice(KNOWN[name])
            case "foreign":
                return self.r.choice(FOREIGN[name])
            case "letters":
                return syllables(self.r)
        return ""

    def unit(self, name: str) -> str:
        """The name of the unit that the workbook states."""
        unit = self.plan.units[name].name
        slip = self.slip
        if slip and (slip.name, slip.given or slip.column) in (("label", name), ("head", name)):
            power = self.plan.units[name].power
            different = [u.name for u in UNITS[name] if u.power not in (power, None)]
            return random.Random(f"unit {self.plan.seed}").choice(different)
        return unit

    # inputs

    def _input_place(self, i: int) -> tuple[int, int]:
        plan = self.plan
        if plan.inputs_at == "beside" and not plan.across:
            row, column = 2, max(self.line.values()) + 3
        elif plan.inputs_at == "below" or plan.inputs_at == "beside":
            down = max(self.line.values()) if plan.across else self.origin + self.rows
            row, column = down + 4, 2
        else:
            row, column = 2, 1 + plan.style["left"] % 3
        return (row + 1, column + i) if plan.flat else (row + i, column + 1)

    def _put_inputs(self) -> None:
        plan = self.plan
        derived = {"diameter": plan.diameter_cell, "mass": plan.mass == "cell",
                   "resistance": plan.resistance_cell}  # fmt: skip
        names = (*plan.given, *(name for name, has in derived.items() if has))
        if plan.style["pi"] == 0:
            names = (*names, "pi")
        at = {name: (self.input_sheet, *self._input_place(i)) for i, name in enumerate(names)}
        for name in names:
            self._put_label(name, at[name])
        for name in plan.given:
            self._put_number(name, at[name])
        if "pi" in names:
            self.cell_of["pi"] = at["pi"]
        formulas = {"diameter": self._diameter_formula, "mass": self._mass_formula,
                    "resistance": self._resistance_formula, "pi": lambda: "PI()"}  # fmt: skip
        for name in names[len(plan.given) :]:
            self.book.cells[at[name]] = f"={formulas[name]()}"
            self.cell_of[name] = at[name]
        if plan.references == "names":
            for name, place in self.cell_of.items():
                address = f"'{place[0]}'!{_ref(place, '$')}"
                self.book.names[self._defined_name(name)] = address

    def _put_label(self, name: str, at: Place) -> None:
        """The words and the unit of an input, or of what follows from inputs."""
        plan, (sheet, row, column) = self.plan, at
        self.touched[name] = {at}
        label = (sheet, row - 1, column) if plan.flat else (sheet, row, column - 1)
        words, unit = (
            self.word(name),
            self.unit(name) if name in plan.given else UNITS[name][0].name,
        )
        if plan.unit_beside_input == "none":
            unit = ""
        if words and unit and (plan.unit_beside_input == "label" or plan.flat):
            words = f"{words} [{unit}]"
        elif unit and not plan.flat:
            self.book.cells[sheet, row, column + 1] = unit
            self.touched[name].add((sheet, row, column + 1))
        if words:
            self.book.cells[label] = words
            self.touched[name].add(label)

    def _put_number(self, name: str, at: Place) -> None:
        """The number of an input, and in a cell beside what it is in SI units."""
        plan, (sheet, row, column) = self.plan, at
        self.book.cells[at] = plan.numbers[name]
        self.book.inputs[name] = self.cell_of[name] = at
        if plan.converted and plan.units[name].power != 0 and not plan.flat:
            si = (sheet, row, column + 2)
            self.book.cells[si] = f"={_ref(at, '')}{self._to_si(name, wrong=True)}"
            self.cell_of[f"{name} in SI"] = si
            self.touched[name].add(si)

    def _defined_name(self, name: str) -> str:
        short = {"step": "dt_", "radius": "Rad_", "diameter": "Dia_", "velocity": "Vel_"}
        base = short.get(name, f"q_{name.replace(' ', '_')}")
        return f"z{[*self.cell_of].index(name)}_" if self.plan.words == "letters" else base

    def _to_si(self, name: str, *, wrong: bool = False) -> str:
        """What follows a number in the unit of an input or a column to convert it."""
        unit = self.plan.units[name]
        power = unit.power
        if power is None:
            return f"*{unit.si!r}"
        slip = self.slip
        if wrong and slip and slip.name == "conversion" and slip.given == name:
            power += 3 if power < 0 else -1
        return _times(power, self.plan.style["power"])

    def _wrong(self, name: str, k: int | None = None) -> bool:
        """Whether the slip of that name is to be made in row k."""
        slip = self.slip
        return slip is not None and slip.name == name and slip.row in (None, k)

    def given(self, name: str, column: str = "", k: int = 0) -> str:
        """An input in SI units, as a formula reads it."""
        slip, plan = self.slip, self.plan
        here = slip and slip.given == name and slip.column == column and column
        own = self.cell_of.get(f"{name} in SI")
        at = own or self.cell_of[name]
        suffix = "" if own or name not in plan.given else self._to_si(name)
        if name == "velocity" and plan.inside:
            suffix = self._factor(START)
        if here and slip and slip.name == "typed constant" and slip.row in (None, k):
            number = plan.numbers[name] * (plan.units[name].si if own else 1.0)
            return _bracketed(_plain(float(f"{number:.15g}")), suffix)
        if here and slip and slip.name == "lost $" and k > 1:
            moved = (at[0], at[1], at[2] + k - 1) if plan.across else (at[0], at[1] + k - 1, at[2])
            return _bracketed(_ref(moved, ""), suffix)
        return _bracketed(self._reference(name if own is None else f"{name} in SI", at), suffix)

    def _reference(self, name: str, at: Place) -> str:
        if self.plan.references == "names":
            return self._defined_name(name)
        prefix = "" if at[0] == self.sheet else f"'{at[0]}'!"
        if self.plan.references == "mixed":
            row, column = ("", "$") if self.plan.across else ("$", "")
            return f"{prefix}{column}{letters(at[2])}{row}{at[1]}"
        return prefix + _ref(at, "$")

    def radius(self, column: str = "", k: int = 0) -> str:
        if "radius" in self.plan.given:
            return self.given("radius", column, k)
        return f"({self.given('diameter', column, k)}/2)"

    def diameter(self, column: str = "", k: int = 0) -> str:
        if "diameter" in self.cell_of:
            return self.given("diameter", column, k)
        return f"2*{self.given('radius', column, k)}"

    def resistance(self, column: str = "", k: int = 0) -> str:
        if "resistance" in self.cell_of:
            return self.given("resistance", column, k)
        return f"{self.given('beta', column, k)}*{self.given('flow_stress', column, k)}"

    def pi(self) -> str:
        return self.given("pi") if "pi" in self.cell_of else "PI()"

    def _diameter_formula(self) -> str:
        factor = "1*" if self._wrong("diameter the radius") else "2*"
        return f"{factor}{self.given('radius')}"

    def _resistance_formula(self) -> str:
        sign = "+" if self._wrong("resistance a sum") else "*"
        return f"{self.given('beta')}{sign}{self.given('flow_stress')}"

    def _mass_formula(self, column: str = "", k: int = 0) -> str:
        pi = "3.14" if self._wrong("mass: 3.14") else self.pi()
        power = 2 if self._wrong("mass: square") else 3
        rho = self.given("particle_density", column, k)
        if "diameter" in self.plan.given and self.plan.style["mass"] % 2:
            whole = pi if self._wrong("mass: no third") else f"{pi}/6"
            return f"{rho}*{whole}*{self.given('diameter', column, k)}^{power}"
        third = "4" if self._wrong("mass: no third") else "4/3"
        R = self.radius(column, k)
        forms = (f"{third}*{pi}*{R}^{power}*{rho}", f"{rho}*{third}*{pi}*{R}^{power}")
        return forms[self.plan.style["mass"] % len(forms)]

    # the table

    def at(self, name: str, k: int) -> Place:
        line = self.line[name]
        if self.plan.across:
            return self.sheet, line, self.origin + k
        return self.sheet, self.origin + k, line

    def _put_heads(self) -> None:
        heads = 2 if self.plan.unit_of_column == "row" else 1
        shown = 0 if self.plan.zero else 1
        for name in self.plan.columns:
            words, unit = self.word(name), self.unit(name)
            if self.plan.unit_of_column == "none":
                unit = ""
            if heads == 1 and unit and words:
                words = (f"{words} ({unit})", f"{words} [{unit}]", f"{words}, {unit}")[
                    self.plan.style["head"] % 3
                ]
            self.touched[name] = {self.at(name, shown), self.at(name, 1)}
            if words:
                self.book.cells[self.at(name, shown - heads)] = words
                self.touched[name].add(self.at(name, shown - heads))
            if heads == 2 and unit:
                self.book.cells[self.at(name, shown - 1)] = unit
                self.touched[name].add(self.at(name, shown - 1))

    def ref(self, name: str, k: int) -> str:
        """The reference to a cell of the table."""
        _, row, column = self.at(name, k)
        if self.plan.style["dollar"] == 0:
            return f"{letters(column)}${row}" if self.plan.across else f"${letters(column)}{row}"
        return f"{letters(column)}{row}"

    def value(self, name: str, k: int) -> str:
        """A cell of the table in SI units."""
        return _bracketed(self.ref(name, k), self._factor(name))

    def _factor(self, name: str) -> str:
        """What follows a number of a column to convert it to SI units."""
        return _times(self.plan.units[name].power or 0, self.plan.style["power"])

    def _put_row(self, name: str, k: int) -> None:
        cell = self.at(name, k)
        content = self._content(name, k)
        if content is not None:
            self.book.cells[cell] = content
            if name in (TIME, START, DEPTH, BRAKE, END) and k <= self.steps:
                self.book.where[name, k] = cell

    def _content(self, name: str, k: int) -> str | float | None:
        """What a cell of the table holds."""
        slip, plan = self.slip, self.plan
        if k == 0:
            return self._impact(name)
        row = k
        if slip and slip.name == "row before" and (slip.column, slip.row) == (name, k):
            row = k - 1  # copied without moving its references
        if name == "count":
            text = f"{self.ref('count', row - 1)}+1" if k > 1 or plan.zero else ""
            if not text:
                return 1.0
        else:
            text = self._in_unit(name, row)
        if plan.guard and not (k == 1 and name in ("count", START, DEPTH)):
            text = self._guarded(name, text, row)
        return f"={text}"

    def _guarded(self, name: str, text: str, k: int) -> str:
        """The formula with a guard that leaves the rows after the stop blank."""
        if self.plan.guard == "count" and name != "count":
            return f'IF(ISNUMBER({self.ref("count", k)}),{text},"")'
        if k == 1:
            return text
        # A blank text counts as zero, so that it is below the stop velocity.
        low = _bracketed(f"N({self.ref(END, k - 1)})", self._factor(END))
        blank = "NA()" if self.plan.style["blank"] % 3 == 0 else '""'
        return f"IF({low}<{self.given('stop_velocity')},{blank},{text})"

    def _impact(self, name: str) -> str | float | None:
        """What the row of the impact shows."""
        own = "=" + self._to_unit(START, self.given("velocity"))
        if self.plan.inside and name == START:
            return self.plan.numbers["velocity"]
        blank = self.plan.style["first"] % 2
        match name:
            case "count" | "time" | "depth":
                return 0.0
            case "velocity_initial":
                return own
            case "velocity_final":
                return (
                    own if self.plan.velocities == "end" or self.plan.style["first"] % 3 else None
                )
            case "deceleration":
                return None if blank else 0.0
            case "ratio":
                return 0.0
        return None

    def _to_unit(self, name: str, text: str) -> str:
        power = self.plan.units[name].power or 0
        return f"({text}){_times(-power, self.plan.style['power'])}" if power else text

    def _in_unit(self, name: str, k: int) -> str:
        """The formula of a column in step k, in its unit."""
        if name == START:
            return self._start(k)
        formulas = {
            TIME: self._time, DEPTH: self._depth, "area": self._pi_area, BRAKE: self._deceleration,
            "pressure": self._pressure, "force": self._force, "change": self._change,
            END: self._end, "ratio": self._ratio, "energy": self._energy,
        }  # fmt: skip
        return self._to_unit(name, formulas[name](k))

    def _change(self, k: int) -> str:
        return f"{self.value(BRAKE, k)}*{self.step('change', k)}"

    def _ratio(self, k: int) -> str:
        return f"{self.value(DEPTH, k)}/{self.radius()}"

    def _energy(self, k: int) -> str:
        mass = self.given("mass") if "mass" in self.cell_of else f"({self._mass_formula()})"
        return f"0.5*{mass}*{self._velocity(k)}^2"

    def _pi_area(self, k: int) -> str:
        return self._area(k) if self._wrong("no pi", k) else f"{self.pi()}*{self._area(k)}"

    def step(self, column: str, k: int) -> str:
        return self.given("step", column, k)

    def _time(self, k: int) -> str:
        dt, way = self.step(TIME, k), self.plan.style["time"] % 4
        if way == 1 and "count" in self.plan.columns:
            return f"{self.ref('count', k)}*{dt}"
        if way == 2 and not self.plan.across:
            return f"(ROW()-{self.origin})*{dt}"
        if k == 1 and not self.plan.zero:
            return f"1*{dt}"
        return f"{self.value(TIME, k - 1)}+{dt}"

    def _velocity(self, k: int) -> str:
        """The velocity at the beginning of step k."""
        return self.value(END, k - 1) if self.plan.velocities == "end" else self.value(START, k)

    def _start(self, k: int) -> str:
        if k == 1:
            shown = self.plan.zero and self.plan.style["first"] % 4 == 0
            own = self._to_unit(START, self.given("velocity"))
            return self.ref(START, 0) if shown else own
        if self.plan.velocities == "both":
            return self.ref(END, k - 1)
        return self._to_unit(START, self._slower(START, k - 1, k))

    def _end(self, k: int) -> str:
        return self._slower(END, k, k)

    def _slower(self, column: str, k: int, row: int) -> str:
        """The velocity at the end of step k, in a cell of that row."""
        sign = "+" if self.plan.negative else "-"
        if self._wrong("plus", row):
            sign = "-" if sign == "+" else "+"
        half = "/2" if self._wrong_in("half a step", column, row) else ""
        v = self._velocity(k)
        if self._wrong_in("column beside", column, row):
            v = self.value(DEPTH, k)
        if "change" in self.plan.columns:
            return f"{v}{sign}{self.value('change', k)}{half}"
        dt, a = self.step(column, row), f"({self._deceleration(k)})"
        if BRAKE in self.plan.columns:
            a = self.value(BRAKE, k)
        product = f"{a}*{dt}" if self.plan.style["end"] % 2 else f"{dt}*{a}"
        return f"{v}{sign}{product}{half}"

    def _wrong_in(self, name: str, column: str, k: int) -> bool:
        return self.slip is not None and self.slip.column == column and self._wrong(name, k)

    def _depth(self, k: int) -> str:
        v, dt = self._velocity(k), self.step(DEPTH, k)
        if self.plan.summed:
            first, factor = _ref(self.at(START, 1), "$"), self._factor(START)
            return f"{dt}*(SUM({first}:{self.ref(START, k)}){factor}-{first}{factor}/2)"
        if k > 1 and self._wrong("explicit Euler"):
            v = self._velocity(k - 1)
        if self._wrong_in("column beside", DEPTH, k):
            v = self.value(BRAKE, k - 1)
        whole = f"{v}*{dt}" if self.plan.style["depth"] % 2 else f"{dt}*{v}"
        half = (f"{v}*{dt}/2", f"{v}*({dt}/2)", f"0.5*{dt}*{v}", f"{v}/2*{dt}", f"{dt}*{v}*0.5")[
            self.plan.style["half"] % 5
        ]
        if k == 1:
            text = whole if self._wrong("no half step", 1) else half
            before = self.plan.zero and self.plan.style["half"] > 6
            return f"{self.value(DEPTH, 0)}+{text}" if before else text
        if self._wrong_in("half a step", DEPTH, k):
            whole = f"{whole}/2"
        sign = "-" if self._wrong_in("minus", DEPTH, k) else "+"
        return f"{self.value(DEPTH, k - 1)}{sign}{whole}"

    def _area(self, k: int) -> str:
        """The contact area over pi, in brackets."""
        column = self.plan.shown("area")
        x, D, R = self.value(DEPTH, k), self.diameter(column, k), self.radius(column, k)
        if self._wrong("radius for diameter", k):
            D = R
        sign = "+" if self._wrong("plus x²", k) else "-"
        way = self.plan.style["area"]
        inner = f"{D}*{x}{sign}{x}^2" if way % 2 else f"{x}*({D}{sign}{x})"
        if self._wrong("no x²", k):
            inner = f"{D}*{x}"
        if self.plan.beyond:
            return f"IF({x}<{R},{inner},{R}^2)"
        return f"({inner})"

    def _pressure(self, k: int, velocity: str = "") -> str:
        column = self.plan.shown("pressure")
        v, rho = velocity or self._velocity(k), self.given("target_density", column, k)
        square = (f"{v}^2", f"{v}*{v}", f"POWER({v},2)", f"{v}^2")[self.plan.style["square"] % 4]
        if self._wrong("cube of the velocity", k):
            square = f"{v}^3"
        half, by = "0.5*", "/2"
        if self._wrong("no 1/2", k):
            half, by = "", ""
        if self._wrong("another number", k):
            half, by = "0.6*", "/3"
        drag = (f"{half}{rho}*{square}", f"{rho}*{square}{by}")[
            self.plan.style["pressure"] % 4 // 2
        ]
        if self._wrong("no resistance", k):
            return drag
        R_t = self.resistance(column, k)
        if self._wrong("minus resistance", k):
            return f"{drag}-{R_t}"
        return f"{R_t}+{drag}" if self.plan.style["pressure"] > 8 else f"{drag}+{R_t}"

    def _force(self, k: int, velocity: str = "") -> str:
        columns = self.plan.columns
        stress = self.value("pressure", k) if "pressure" in columns and not velocity else (
            f"({self._pressure(k, velocity)})")  # fmt: skip
        if "area" in columns:
            return f"{stress}*{self.value('area', k)}"
        pi = "" if self._wrong("no pi", k) else f"{self.pi()}*"
        return f"{stress}*{pi}{self._area(k)}"

    def _deceleration(self, k: int) -> str:
        column = self.plan.shown(BRAKE)
        M = self.given("mass", column, k) if "mass" in self.cell_of else (
            f"({self._mass_formula(column, k)})")  # fmt: skip
        force = self.value("force", k) if "force" in self.plan.columns else self._force(k)
        if self.slip and self.slip.name == "centered":
            middle = f"({self._velocity(k)}-{self._force(k)}/{M}*{self.step('', k)}/2)"
            force = self._force(k, middle)
        twice = "2*" if self._wrong("twice", k) else ""
        minus = "-" if self.plan.negative else ""
        return f"{minus}{twice}{force}/{M}"

    # results and notes

    def _put_results(self) -> dict[str, Place]:
        """Final depth and X/R, with words that are known, on the sheet of the table."""
        plan = self.plan
        if not plan.has_result:
            return {}
        rows = [self.at(name, k) for name in plan.columns for k in (0, self.rows)]
        column = max(c for _, _, c in [*rows, *self.book.cells]) + 3
        last = self.steps - (1 if self._wrong("result of the row before") else 0)
        # A largest depth of rows that end with #N/A is #N/A.
        way = plan.style["result"] % 3 if plan.guard != "velocity" else 0
        cells = f"{self.ref(DEPTH, 1)}:{self.ref(DEPTH, self.rows)}".replace("$", "")
        text = self.ref(DEPTH, last)
        if way == 1 and last == self.steps:
            text = f"MAX({cells})"
        elif way == 2:
            text = f"INDEX({cells},COUNT({cells}){'' if last == self.steps else '-1'})"
        unit = plan.units[DEPTH].name
        over = self.diameter() if self._wrong("result over the diameter") else self.radius()
        depth, ratio = (self.sheet, 2, column), (self.sheet, 3, column)
        self.book.cells[self.sheet, 2, column - 1] = f"final depth [{unit}]"
        self.book.cells[depth] = f"={text}"
        self.book.cells[self.sheet, 3, column - 1] = "X/R"
        si = _bracketed(_ref(depth, ""), _times(plan.units[DEPTH].power or 0, plan.style["power"]))
        self.book.cells[ratio] = f"={si}/({over})"
        return {"depth": depth, "ratio": ratio}

    def _put_notes(self) -> None:
        """A title, a date, a note below, a sheet more: what stands around."""
        plan, cells = self.plan, self.book.cells
        bottom = max(row for sheet, row, _ in cells if sheet == self.sheet)
        if plan.style["notes"] % 3 == 0:
            cells[self.sheet, bottom + 3, 1] = self.word("note") or "12/3"
        if plan.style["notes"] % 4 == 0 and plan.style["top"] > 2 and plan.words != "none":
            cells[self.sheet, 1, 1] = self.word("title")
        if plan.style["second"] == 7:
            cells["zz", 1, 1] = self.word("title") or "3"
            for i in range(2, 9):
                cells["zz", i, 1] = float(i)
                cells["zz", i, 2] = f"=A{i}^2/7"

    # what is true

    def truth(self, results: dict[str, Place]) -> Truth:
        if self.slip is None:
            return CLEAN
        cells = tuple(map(full, self._accused(self.slip, results)))
        return Truth(1, kinds(self.slip), cells)

    def _accused(self, slip: Slip, results: dict[str, Place]) -> Iterable[Place]:
        """The cells in which a slip can be seen."""
        if slip.name in ("label", "conversion", "head"):
            return self.touched[slip.given or slip.column]
        if slip.name.startswith("result"):
            return (results["ratio" if "diameter" in slip.name else "depth"],)
        if slip.column not in self.line:
            return (self.cell_of[slip.column],)
        rows: Iterable[int] = (slip.row,) if slip.row else ROWS.get(slip.name, (1, 2, 3))
        if slip.name == "beyond the stop":
            rows = range(self.steps, self.rows + 1)
        return (self.at(slip.column, k) for k in rows)


def _ref(at: Place, dollar: str) -> str:
    return f"{dollar}{letters(at[2])}{dollar}{at[1]}"


def _bracketed(text: str, suffix: str) -> str:
    return f"({text}{suffix})" if suffix else text


def _plain(number: float) -> str:
    """A number as one types it into a formula."""
    text = repr(number)
    return text.replace("e", "E") if "e" in text else text.removesuffix(".0")


def _times(power: int, way: int) -> str:
    """What multiplies by a power of ten, in one of the ways of writing that."""
    if power == 0:
        return ""
    ways = (
        f"*1E{power}",
        f"/1{'0' * -power}" if power < 0 else f"*1{'0' * power}",
        f"*10^{power}" if power > 0 else f"*10^({power})",
        f"*0.{'0' * (-power - 1)}1" if power < 0 else f"/0.{'0' * (power - 1)}1",
    )
    return ways[way % 4]
