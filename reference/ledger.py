"""The ledger: every number and equation that the report prints, placed in its text and checked.

Everything that can be wrong with an entry is an error when the ledger is loaded: a quote that the
report does not contain, a duplicate id, an unknown unit, text that is no number, a computation that
does not exist or whose units do not fit, inputs that are missing or that go round in a circle.
"""

import re
import tomllib
from collections import Counter
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, cached_property, lru_cache, reduce
from graphlib import CycleError, TopologicalSorter
from importlib import resources
from operator import mul
from typing import Any, Literal

import msgspec

from reference.arithmetic import Arithmetic, Number
from reference.computations import COMPUTATIONS, EXPONENT, SAME, Computation
from reference.derivations import DERIVATIONS, Sides
from reference.equations import Dimension, EquationError, Node, read_equation
from reference.printed import Interval, Printed, Rounding, decimal_text, parse
from reference.units import raised, same_dimension, to_si, unit_dimension

INFERRED = "inferred:"
"""What stands before the id of an input that the report does not print."""

Function = Callable[..., Number | Fraction]
"""Of an arithmetic and the inputs by name; a Fraction where the value is known exactly."""


class LedgerError(ValueError):
    """Something in the ledger is wrong; the message names the entry and what would be right."""


def shown(text: str) -> str:
    r"""Printed text as a page shows it, without the marks of LaTeX.

    >>> shown(r"9.13 \times 10^9"), shown(r"\frac{1}{2}"), shown("~ 0.3"), shown("m^{1/2}")
    ('9.13 × 10⁹', '1/2', '~0.3', 'm^(1/2)')
    """
    text = re.sub(r"\\frac\{(\d+)\}\{(\d+)\}", r"\1/\2", text).replace(r"\times", "×")
    text = re.sub(r"\^\{(-?\d+)\}", r"^\1", text)
    text = re.sub(r"\^\{([^{}]*)\}", r"^(\1)", text)
    return re.sub(r"~\s+", "~", raised(text))


# The tables of ledger.toml, whose head says what each key means.

Kind = Literal[
    "input",
    "result",
    "approximation",
    "order of magnitude",
    "bound",
    "comparison",
    "range",
    "quoted",
    "constant",
    "remark",
]
Relation = Literal["<", "<=", ">", ">="]


class _Table(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A table that may hold no other keys."""


class ClaimEntry(_Table, frozen=True):
    """A [[claim]]."""

    id: str
    title: str
    quote: str
    kind: Kind
    unit: str = "1"
    computed_by: str | None = None
    rests_on: dict[str, str] = {}
    readings: dict[str, str] = {}
    given: str | None = None
    shown_by: list[str] = []
    relation: Relation | None = None
    against: str | None = None
    assumes: str | None = None
    exact: bool = False
    cell: str | None = None
    row: int | None = None
    quantity: str | None = None
    workbook: str | None = None


class EquationEntry(_Table, frozen=True):
    """An [[equation]]."""

    id: str
    title: str
    quote: str
    kind: Literal["derived", "definition", "taken over"]
    follows_from: str


class Inferred(_Table, frozen=True):
    """An input that the report does not print, to be inferred from the numbers that it does."""

    title: str
    symbol: str
    unit: str
    quantity: str
    search: tuple[Fraction, Fraction]
    nominal: Fraction
    nominal_source: str
    mass: str
    radius: str
    density: str
    header: list[str]
    results: list[str]
    evidence: list[str]


class Symbol(_Table, frozen=True):
    """What a symbol of the equations means, how the report writes it, and how a page shows it."""

    written: list[str]
    shown: str
    unit: str
    means: str
    value: str | None = None


class Quantity(_Table, frozen=True):
    """A physical quantity: the range of it that is searched, in its unit, and why this one."""

    unit: str
    search: tuple[Fraction, Fraction]
    reason: str


class Slip(_Table, frozen=True):
    """What the author may have computed instead: another text of an equation, or other inputs."""

    name: str
    reason: str
    equation: str
    text: str | None = None
    inputs: dict[str, str] = {}


class Source(_Table, frozen=True):
    """A public source for a number that the report takes from nowhere; see sources.toml."""

    id: str
    title: str
    address: str
    quote: str
    unit: str
    applies: str
    claims: list[str]

    @property
    def numbers(self) -> list[Printed]:
        """The number that it prints, or the two ends of a range."""
        return [parse(text) for text in re.findall("⟦(.*?)⟧", self.quote)]

    @property
    def says(self) -> str:
        """The number or the range as text, without its unit."""
        return " to ".join(number.text for number in self.numbers)

    @property
    def value(self) -> Fraction:
        """The number in SI; of a range, its lower end."""
        return self.numbers[0].value * to_si(self.unit)

    @property
    def interval(self) -> Interval:
        """What agrees with it, in SI."""
        ends = [number.interval() for number in self.numbers]
        whole = Interval(ends[0].lower, ends[-1].upper, ends[0].lower_closed, ends[-1].upper_closed)
        return whole.scaled(to_si(self.unit))


class _Report(_Table, frozen=True):
    text: str
    title: str
    author: str
    year: int


class _Blank(_Table, frozen=True):
    blank: list[str]


class _Furniture(_Table, frozen=True):
    pattern: str
    reason: str


class _Document(_Table, frozen=True):
    report: _Report
    reasons: dict[str, str]
    table: _Blank
    groups: dict[str, dict[str, str]]
    inferred: dict[str, Inferred]
    symbols: dict[str, Symbol]
    quantities: dict[str, Quantity]
    furniture: list[_Furniture]
    equation: list[EquationEntry]
    claim: list[ClaimEntry]
    slip: list[Slip] = []


# What the rest of the program sees.


@dataclass(frozen=True, slots=True)
class Convention:
    """How printed text is read where the report does not say how it was printed.

    `choices_exact`: what the author chose (500 m/s, 700 MPa, 0.2 ns) is the value itself, not a
    rounding of it. `header_exact`: so are the numbers above the rows of Table A-1. `centered`: the
    sheet takes the drag at the velocity in the middle of a row, not at its start.
    """

    rounding: Rounding = Rounding.AWAY
    choices_exact: bool = True
    header_exact: bool = False
    centered: bool = False


@dataclass(frozen=True, slots=True)
class Place:
    """Where something stands: characters and line of the text, section, equation, table cell."""

    start: int
    end: int
    line: int
    section: str
    equation: str | None
    cell: str | None

    def __str__(self) -> str:
        if self.cell:
            return f"Table A-1, cell {self.cell}"
        where = f"{self.section}, line {self.line}"
        return f"{where}, Eq. {self.equation}" if self.equation else where


@dataclass(frozen=True, eq=False)
class Claim:
    """One printed number, and what is claimed of it.

    `inputs` names for each input of the computation the entries whose product it is; `given` is
    the reason why nothing in the report decides the number; `chosen` says that the author set it,
    here or where this claim repeats it; `bound` is the number that a relation compares with;
    `within` the id of the equation that the number is a constant of.
    """

    entry: ClaimEntry
    text: str
    place: Place
    printed: Printed | None
    computation: Computation | None
    inputs: Mapping[str, tuple[str, ...]]
    readings: Mapping[str, Computation]
    given: str | None
    chosen: bool
    bound: Fraction | None
    within: str | None

    @property
    def id(self) -> str:
        """What everything calls it."""
        return self.entry.id

    @property
    def title(self) -> str:
        """What the number is."""
        return self.entry.title

    @property
    def unit(self) -> str:
        """Its unit."""
        return self.entry.unit

    @property
    def shown(self) -> str:
        """Its text as a page shows it, without the marks of LaTeX."""
        return shown(self.text)

    @cached_property
    def si(self) -> Fraction:
        """The factor from the claim's unit to SI."""
        return to_si(self.unit)

    @cached_property
    def value(self) -> Fraction:
        """The number as printed, in SI. Raises LedgerError for a remark."""
        if self.printed is None:
            raise LedgerError(f"claim {self.id!r} is no number to rest on")
        return self.printed.value * self.si

    @property
    def is_exact(self) -> bool:
        """Whether the text is the value itself under every convention."""
        return self.entry.exact or self.entry.kind == "constant"

    def interval(self, rounding: Rounding = Rounding.AWAY) -> Interval:
        """The values, in its unit, that agree with the claim. Raises ValueError for a remark."""
        if self.bound is not None:
            closed = self.entry.relation in ("<=", ">=")
            if self.entry.relation in (">", ">="):
                return Interval(self.bound, None, closed, False)
            return Interval(None, self.bound, False, closed)
        if self.printed is None:
            raise ValueError(f"claim {self.id!r} prints no number")
        if self.is_exact:
            return Interval.point(self.printed.value)
        if self.entry.kind == "approximation":
            return self.printed.about()
        return self.printed.interval(rounding)

    def target(self, rounding: Rounding = Rounding.AWAY) -> Interval:
        """`interval` in SI."""
        if rounding not in self._targets:
            self._targets[rounding] = self.interval(rounding).scaled(self.si)
        return self._targets[rounding]

    @cached_property
    def _targets(self) -> dict[Rounding, Interval]:
        return {}

    def as_input(self, convention: Convention) -> Interval:
        """The values, in SI, that this number may stand for where another claim rests on it."""
        assert self.printed is not None
        in_header = self.entry.cell is not None and self.entry.cell.startswith("B")
        if (
            self.is_exact
            or self.printed.quantum == 0
            or self.bound is not None
            or (self.chosen and convention.choices_exact)
            or (in_header and convention.header_exact)
        ):
            return Interval.point(self.value)
        return self.target(convention.rounding)

    @property
    def computations(self) -> dict[str, Computation]:
        """The computation as printed, under the name "", and each other reading."""
        return {} if self.computation is None else {"": self.computation, **self.readings}

    @cached_property
    def entries(self) -> list[str]:
        """The entries that it rests on, sorted."""
        return sorted({name for names in self.inputs.values() for name in names})

    @property
    def inferred(self) -> list[str]:
        """Those of them that the report does not print."""
        return [name for name in self.entries if name.startswith(INFERRED)]

    @property
    def stated(self) -> list[str]:
        """Those of them that it prints."""
        return [name for name in self.entries if not name.startswith(INFERRED)]

    def resting_on(self, **inputs: str) -> "Claim":
        """The claim with other entries as some of its inputs."""
        return replace(self, inputs={**self.inputs, **{k: (name,) for k, name in inputs.items()}})

    @cached_property
    def by_scheme(self) -> bool:
        """Whether it depends on the scheme of the sheet."""
        return any(computation.by_scheme for computation in self.computations.values())


@dataclass(frozen=True, slots=True, eq=False)
class Equation:
    """One printed equation: where it stands and what it is derived from."""

    entry: EquationEntry
    place: Place

    @property
    def id(self) -> str:
        """What everything calls it."""
        return self.entry.id


@dataclass(frozen=True, eq=False)
class Ledger:
    """All claims and equations in the order of the report, the inferred inputs, and the text."""

    report: _Report
    text: str
    claims: Mapping[str, Claim]
    equations: Mapping[str, Equation]
    inferred: Mapping[str, Inferred]
    symbols: Mapping[str, Symbol]
    quantities: Mapping[str, Quantity]
    slips: tuple[Slip, ...]
    sources: Mapping[str, Source]
    blank: tuple[str, ...]
    furniture: tuple[tuple[str, str], ...]
    misprinted: Mapping[str, str]

    # The printed equations

    @cached_property
    def written(self) -> Mapping[str, str]:
        """How the report writes its symbols, and their names."""
        return {text: name for name, symbol in self.symbols.items() for text in symbol.written}

    @cached_property
    def dimensions(self) -> Mapping[str, Dimension]:
        """The dimension of every symbol."""
        return {name: unit_dimension(symbol.unit) for name, symbol in self.symbols.items()}

    def printed_text(self, name: str) -> str:
        """The text of a claim, or of an equation with the constants that its claims have."""
        if name in self.equations:
            return self._with_constants(self.equations[name])[0]
        return self.claims[name].text

    def _with_constants(self, equation: Equation) -> tuple[str, dict[str, tuple[int, int]]]:
        """The text of an equation, and where in it the constants of its claims stand."""
        if equation.id in self.misprinted:
            return self.misprinted[equation.id], {}
        text, at, spans = "", equation.place.start, {}
        for claim in (self.claims[name] for name in self._inside.get(equation.id, ())):
            text += self.text[at : claim.place.start]
            spans[claim.id] = (len(text), len(text) + len(claim.text))
            text, at = text + claim.text, claim.place.end
        return text + self.text[at : equation.place.end], spans

    @cached_property
    def _inside(self) -> Mapping[str, list[str]]:
        """The ids of the claims that are constants of each equation, in the order of its text."""
        inside: dict[str, list[str]] = {}
        for claim in sorted(self.claims.values(), key=lambda claim: claim.place.start):
            if claim.within is not None:
                inside.setdefault(claim.within, []).append(claim.id)
        return inside

    def constants_of(self, equation: str) -> dict[str, tuple[int, int]]:
        """The claims that are constants of an equation, and where in its text they stand."""
        return self._with_constants(self.equations[equation])[1]

    @cached_property
    def sides(self) -> Sides:
        """The sides of every equation.

        Where a misprint makes one unreadable, they are those that the report prints. Raises
        EquationError if even these cannot be read.
        """
        return {name: self._sides_of(equation) for name, equation in self.equations.items()}

    def _sides_of(self, equation: Equation) -> tuple[Node, ...]:
        try:
            return self.read(self.printed_text(equation.id))
        except EquationError:
            return self.read(self.text[equation.place.start : equation.place.end])

    def read(self, text: str) -> tuple[Node, ...]:
        """The sides of an equation of this report, given as text. Raises EquationError."""
        return _read_equation(text, tuple(self.written.items()))

    # The entries as inputs

    def entry(self, name: str) -> Claim | Inferred | EquationEntry:
        """A claim, an inferred input, or what is said of an equation."""
        if name.startswith(INFERRED):
            return self.inferred[name.removeprefix(INFERRED)]
        return self.equations[name].entry if name in self.equations else self.claims[name]

    def title(self, name: str) -> str:
        """What an entry is, in words."""
        return self.entry(name).title

    def unit(self, name: str) -> str:
        """The unit of an input."""
        return self._input(name).unit

    def _input(self, name: str) -> Claim | Inferred:
        entry = self.entry(name)
        assert not isinstance(entry, EquationEntry)
        return entry

    def value(self, name: str) -> Fraction:
        """An entry's value as printed, or the nominal one of an inferred input, in SI.

        >>> float(load().value("flow-stress"))
        700000000.0
        """
        entry = self._input(name)
        return entry.nominal * to_si(entry.unit) if isinstance(entry, Inferred) else entry.value

    def in_unit(self, name: str, unit: str) -> str:
        """An entry's value as printed, in another unit, as a decimal.

        >>> load().in_unit("fz-resistance-rha", "GPa")
        '9.13'
        """
        return decimal_text(self.value(name) / to_si(unit))

    def search(self, name: str) -> tuple[Fraction, Fraction, str]:
        """The least and the greatest value of an entry, in SI, to search, and why these."""
        entry = self._input(name)
        key = entry.quantity if isinstance(entry, Inferred) else entry.entry.quantity
        if key is None:
            value = self.value(name)
            ends = sorted((value / 10, value * 10)) if value else [Fraction(-1), Fraction(1)]
            return ends[0], ends[1], "from a tenth to ten times the printed value"
        quantity = self.quantities[key]
        low, high = (end * to_si(quantity.unit) for end in quantity.search)
        return low, high, quantity.reason

    # Claims as functions of their entries

    def function(self, claim: Claim, *, reading: str = "", centered: bool = False) -> Function:
        """A claim's computation as a function of an arithmetic and of the claim's entries by name.

        An entry that stands in several inputs is one variable.
        """
        computation = claim.computations[reading]
        settings: dict[str, Any] = {"printed": self.sides}
        if computation.by_row:
            settings["row"] = claim.entry.row
        if computation.by_scheme:
            settings["centered"] = centered
        exponents = {
            key: self.value(claim.inputs[key][0])
            for key, unit in computation.inputs.items()
            if unit == EXPONENT
        }
        inputs = {key: names for key, names in claim.inputs.items() if key not in exponents}

        def of_entries(ar: Arithmetic, **entries: Number) -> Number | Fraction:
            own = {
                key: entries[names[0]]
                if len(names) == 1
                else reduce(mul, [entries[name] for name in names])
                for key, names in inputs.items()
            }
            return computation.function(ar, **own, **exponents, **settings)

        return of_entries

    # Copies with a misprint

    def misprint(self, name: str, text: str) -> "Ledger":
        """A copy with other text in the place of a claim's or an equation's.

        Raises ValueError if a claim's text is no number.
        """
        claims, equation = self.claims, name
        if name not in self.equations:
            claims = dict(claims)
            claim, printed = claims[name], parse(text)
            claims[name] = replace(claim, text=text, printed=printed)
            if claim.bound is not None and claim.entry.against is None:
                claims[name] = replace(claims[name], bound=printed.value)
            for key, other in self.claims.items():
                if other.entry.against == name:
                    claims[key] = replace(other, bound=printed.value)
            equation = claim.within or ""
        copy = replace(self, claims=claims, misprinted={**self.misprinted, name: text})
        # What no text decides, and all other equations, are as they were.
        kept = ("written", "dimensions", "_inside")
        copy.__dict__.update({key: getattr(self, key) for key in kept})
        again = [self.equations[equation]] if equation else []
        copy.__dict__["sides"] = {**self.sides, **{e.id: copy._sides_of(e) for e in again}}
        return copy

    # Coverage

    def uncovered(self) -> list[tuple[int, str]]:
        """Digits and number words of the text that no claim and no furniture accounts for.

        Each as line number and the word; empty for a complete ledger.
        """
        spans = [(claim.place.start, claim.place.end) for claim in self.claims.values()]
        spans += [m.span() for p, _ in self.furniture for m in re.finditer(p, self.text)]
        taken = bytearray(len(self.text))
        for start, end in spans:
            taken[start:end] = b"\1" * (end - start)
        return [
            (_line(self.text, match.start()), match[0])
            for match in _NUMBER.finditer(self.text)
            if not all(taken[match.start() : match.end()])
        ]


_NUMBER = re.compile(
    r"\d+|\b(?:one|two|three|four|five|six|seven|eight|nine|ten|half|halves|thirds?|quarters?"
    r"|sixths?|several|twice|thrice|double|dozen|hundred|thousand|million)\b",
    re.IGNORECASE,
)


@lru_cache(512)
def _read_equation(text: str, written: tuple[tuple[str, str], ...]) -> tuple[Node, ...]:
    """Each text once: the same misprint of an equation is tried for all that rests on it."""
    return read_equation(text, dict(written))


@cache
def load() -> Ledger:
    """The report's ledger.

    >>> ledger = load()
    >>> claim = ledger.claims["depth-beta-5"]
    >>> claim.text, str(claim.interval()), claim.unit
    ('7.67', '[7.665, 7.675)', 'um')
    """
    folder = resources.files("reference.report")
    document, sources = (
        tomllib.loads((folder / name).read_text("utf-8"))
        for name in ("ledger.toml", "sources.toml")
    )
    text = (folder / document["report"]["text"]).read_text("utf-8")
    return read(document, text, sources["source"])


def read(
    document: Mapping[str, Any], text: str, sources: Sequence[Mapping[str, Any]] = ()
) -> Ledger:
    """Build and check a ledger from its parsed TOML, the report's text, and the public sources."""
    tables = _converted(document, _Document, "ledger.toml")
    if not tables.claim:
        raise LedgerError("the ledger is empty: it has no [[claim]]")
    names = Counter(entry.id for entry in (*tables.equation, *tables.claim))
    if twice := next((name for name, times in names.items() if times > 1), None):
        raise LedgerError(f"{twice!r} stands in the ledger twice")
    equations = {
        entry.id: Equation(entry, _place(text, f"equation {entry.id!r}", entry.quote))
        for entry in tables.equation
    }
    claims = {entry.id: _claim(entry, tables, text, equations.values()) for entry in tables.claim}
    claims = {name: _completed(claim, claims) for name, claim in claims.items()}
    ordered = dict(sorted(claims.items(), key=lambda item: _order(item[1])))
    ledger = Ledger(
        report=tables.report,
        text=text,
        claims=ordered,
        equations=equations,
        inferred=tables.inferred,
        symbols=tables.symbols,
        quantities=tables.quantities,
        slips=tuple(tables.slip),
        sources={source.id: source for source in _converted(sources, list[Source], "sources.toml")},
        blank=tuple(cell for cells in tables.table.blank for cell in _cells(cells)),
        furniture=tuple((f.pattern, f.reason) for f in tables.furniture),
        misprinted={},
    )
    _check(ledger)
    return ledger


def _converted(document: Any, kind: Any, file: str) -> Any:
    try:
        return msgspec.convert(document, kind, dec_hook=_fraction)
    except msgspec.ValidationError as error:
        raise LedgerError(f"{file}: {error}") from error


def _fraction(kind: type, value: Any) -> Any:
    if kind is Fraction and isinstance(value, str):
        return Fraction(value)
    raise NotImplementedError(kind)


def _place(text: str, who: str, quote: str, cell: str | None = None) -> Place:
    before, opened, rest = quote.partition("⟦")
    inside, closed, after = rest.partition("⟧")
    if not opened or not closed:
        raise LedgerError(f"{who}: its quote needs the printed text between ⟦ and ⟧")
    words = before + inside + after
    if (times := text.count(words)) != 1:
        raise LedgerError(f"{who}: the report has {words!r} {times} times, not once")
    start = text.index(words) + len(before)
    heading = next((h for h in reversed(_headings(text)) if h.start() <= start), None)
    numbered = next((n for s, e, n in _displays(text) if s <= start < e), None)
    return Place(start, start + len(inside), _line(text, start), _section(heading), numbered, cell)


@cache
def _headings(text: str) -> list[re.Match[str]]:
    return list(_HEADING.finditer(text))


@cache
def _displays(text: str) -> list[tuple[int, int, str]]:
    """Where the numbered equations stand, and their numbers."""
    found = re.finditer(r"\$\$(?:(?!\$\$).)*?\\quad \((?:\\text\{)?([-A\d]+)\}?\)", text, re.DOTALL)
    return [(*match.span(), match[1]) for match in found]


def _line(text: str, position: int) -> int:
    return text.count("\n", 0, position) + 1


_HEADING = re.compile(r"^ ?(?:\d+\. (?P<form>ABSTRACT)|(?P<n>\d)\. [A-Z]|Appendix\.)", re.MULTILINE)


def _section(heading: re.Match[str] | None) -> str:
    if heading is None:
        return "title"
    if heading["form"]:
        return "abstract"
    return f"section {heading['n']}" if heading["n"] else "appendix"


def _order(claim: Claim) -> tuple[bool, int, str]:
    """By place in the text; the table, which ends it, cell by cell."""
    cell = claim.place.cell
    return (True, int(cell[1:]), cell) if cell else (False, claim.place.start, claim.id)


def _cells(cells: str) -> Iterator[str]:
    match = re.fullmatch(r"([A-F])(\d+):([A-F])(\d+)", cells)
    if match is None:
        raise LedgerError(f"[table] blank: {cells!r} is no range of cells such as C1:F6")
    for row in range(int(match[2]), int(match[4]) + 1):
        for column in range(ord(match[1]), ord(match[3]) + 1):
            yield f"{chr(column)}{row}"


def _claim(entry: ClaimEntry, tables: _Document, text: str, equations: Any) -> Claim:
    """One claim, as far as its own entry tells; every message names it."""
    who = f"claim {entry.id!r}"
    place = _place(text, who, entry.quote, entry.cell)
    words = text[place.start : place.end]
    within = next(
        (e.id for e in equations if e.place.start <= place.start and place.end <= e.place.end), None
    )
    try:
        to_si(entry.unit)
        numbers = entry.kind not in ("comparison", "remark")
        printed = parse(words) if numbers else None
    except ValueError as error:
        raise LedgerError(f"{who}: {error}") from error
    readings = entry.readings.values() if entry.computed_by else ()
    _refuse_unknown(who, "computation", [entry.computed_by, *readings], COMPUTATIONS)
    if entry.kind in ("bound", "order of magnitude", "comparison") and entry.relation is None:
        raise LedgerError(f"{who}: kind {entry.kind!r} needs a relation")
    _refuse_unknown(who, "reason", [entry.given], tables.reasons)
    decided = (entry.computed_by is None) != (entry.given is None)
    if not (decided or within or entry.kind == "remark"):
        raise LedgerError(f"{who}: needs either computed_by or given")
    _refuse_unknown(who, "quantity", [entry.quantity], tables.quantities)
    return Claim(
        entry=entry,
        text=words,
        place=place,
        printed=printed,
        computation=COMPUTATIONS[entry.computed_by] if entry.computed_by else None,
        inputs=_inputs(entry, tables.groups),
        readings={name: COMPUTATIONS[key] for name, key in entry.readings.items()},
        given=None if entry.given is None else tables.reasons[entry.given],
        chosen=entry.given == "choice",
        bound=None if printed is None or entry.relation is None else printed.value,
        within=within,
    )


def _refuse_unknown(
    who: str, what: str, names: Iterable[str | None], known: Container[str]
) -> None:
    for name in names:
        if name is not None and name not in known:
            raise LedgerError(f"{who}: there is no {what} {name!r}")


def _inputs(
    entry: ClaimEntry, groups: Mapping[str, Mapping[str, str]]
) -> dict[str, tuple[str, ...]]:
    rests_on = dict(entry.rests_on)
    group = rests_on.pop("group", None)
    _refuse_unknown(f"claim {entry.id!r}", "group", [group], groups)
    if rests_on and entry.computed_by is None:
        raise LedgerError(f"claim {entry.id!r}: rests_on needs computed_by")
    merged = {**groups.get(group or "", {}), **rests_on}
    return {name: tuple(value.split(" * ")) for name, value in merged.items()}


def _completed(claim: Claim, claims: Mapping[str, Claim]) -> Claim:
    """A claim with what it takes from others: the number it compares with, whose choice it is."""
    if (name := claim.entry.against) is not None:
        if name not in claims or (other := claims[name]).printed is None:
            raise LedgerError(f"claim {claim.id!r}: there is no number {name!r} to compare with")
        if other.unit != claim.unit:
            raise LedgerError(f"claim {claim.id!r}: is in {claim.unit}, but {name} in {other.unit}")
        return replace(claim, bound=other.printed.value)
    return replace(claim, chosen=_is_chosen(claim, claims))


def _is_chosen(claim: Claim, claims: Mapping[str, Claim]) -> bool:
    for _ in claims:  # no chain is longer; circles are refused later
        if claim.computation is not COMPUTATIONS["same_as"] or claim.chosen:
            break
        claim = claims.get(claim.inputs.get("value", ("",))[0], claim)
    return claim.chosen


def _check(ledger: Ledger) -> None:
    """Refuse what does not fit between entries."""
    for claim in ledger.claims.values():
        for computation in claim.computations.values():
            _check_units(claim, computation, ledger)
        for name in claim.entry.shown_by:
            if name not in ledger.claims or claim.id not in ledger.claims[name].entries:
                raise LedgerError(f"claim {claim.id!r}: {name!r} does not rest on it")
    for name, inferred in ledger.inferred.items():
        own = (inferred.mass, inferred.radius, inferred.density)
        named = {*inferred.evidence, *inferred.header, *inferred.results, *own}
        _refuse_unknown(f"inferred {name!r}", "claim", sorted(named), ledger.claims)
        _refuse_unknown(f"inferred {name!r}", "quantity", [inferred.quantity], ledger.quantities)
    for source in ledger.sources.values():
        _check_source(source, ledger)
    _check_equations(ledger)
    try:
        TopologicalSorter({c.id: c.entries for c in ledger.claims.values()}).prepare()
    except CycleError as error:
        raise LedgerError(f"claims rest on each other: {' on '.join(error.args[1])}") from error


def _check_equations(ledger: Ledger) -> None:
    try:
        _ = ledger.sides, ledger.dimensions
        for text in (slip.text for slip in ledger.slips if slip.text is not None):
            ledger.read(text)
    except ValueError as error:
        raise LedgerError(f"[[equation]], [[slip]] or [symbols]: {error}") from error
    for equation in ledger.equations.values():
        if equation.entry.kind == "derived" and equation.id not in DERIVATIONS:
            raise LedgerError(f"equation {equation.id!r}: nothing derives it")
    for slip in ledger.slips:
        who = f"slip {slip.name!r}"
        _refuse_unknown(who, "equation", [slip.equation], ledger.equations)
        _refuse_unknown(who, "number", sorted(slip.inputs.values()), ledger.claims)


def _check_source(source: Source, ledger: Ledger) -> None:
    for name in source.claims:
        if not same_dimension(_unit_of(name, ledger, LedgerError), source.unit):
            raise LedgerError(f"source {source.id!r}: {name} is not in {source.unit}")
    if not 1 <= len(source.numbers) <= 2:
        raise LedgerError(f"source {source.id!r}: its quote marks no number with ⟦ and ⟧")


def _check_units(claim: Claim, computation: Computation, ledger: Ledger) -> None:
    def error(message: str) -> LedgerError:
        return LedgerError(f"claim {claim.id!r}, {computation.name}: {message}")

    if computation.by_row != (claim.entry.row is not None):
        raise error("needs a row" if computation.by_row else "takes no row")
    expected = dict(computation.inputs)
    if computation.any_number:
        expected = dict.fromkeys(claim.inputs, computation.inputs["each"])
    if set(expected) != set(claim.inputs):
        raise error(f"needs inputs {sorted(expected)}, not {sorted(claim.inputs)}")
    shared: dict[str, str] = {}
    for name, unit in expected.items():
        own = " ".join(_unit_of(part, ledger, error) for part in claim.inputs[name])
        unit = "1" if unit == EXPONENT else unit
        if unit == SAME:
            unit = shared.setdefault(SAME, own)
        if not same_dimension(own, unit):
            raise error(f"input {name} is in {own}, which does not measure what {unit} does")
    result = shared.get(SAME, claim.unit) if computation.unit == SAME else computation.unit
    if not same_dimension(claim.unit, result):
        raise error(f"unit {claim.unit} does not measure what {result} does")


def _unit_of(name: str, ledger: Ledger, error: Callable[[str], LedgerError]) -> str:
    if name.startswith(INFERRED) and name.removeprefix(INFERRED) in ledger.inferred:
        return ledger.unit(name)
    if name not in ledger.claims or ledger.claims[name].printed is None:
        raise error(f"there is no number {name!r} to rest on")
    return ledger.unit(name)
