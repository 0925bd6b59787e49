"""The ledger: every number and equation that the report prints, placed in its text and checked.

Everything that can be wrong with an entry is an error when the ledger is loaded: a quote that the
report does not contain, a duplicate id, an unknown unit, text that is no number, a computation that
does not exist or whose units do not fit, inputs that are missing or that go round in a circle.
"""

import re
import tomllib
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from fractions import Fraction
from functools import cache, cached_property, lru_cache, reduce
from graphlib import CycleError, TopologicalSorter
from importlib import resources
from operator import mul
from typing import Any, TypeVar

from msgspec.structs import asdict, replace

from reference.arithmetic import Arithmetic, Number
from reference.computations import COMPUTATIONS, EXPONENT, SAME, Computation, Formulas
from reference.derivations import DERIVATIONS, Sides
from reference.entries import (
    ClaimEntry,
    Document,
    EquationEntry,
    Inferred,
    LedgerError,
    Place,
    Slip,
    Source,
    converted,
    naming,
    place_of,
)
from reference.equations import EquationError, Node, read_equation
from reference.printed import Interval, Printed, Rounding, parse
from reference.units import Dimension, raised, same_dimension, to_si, unit_dimension

INFERRED = "inferred:"
"""What stands before the id of an input that the report does not print."""

Anything = TypeVar("Anything")

Function = Callable[..., Number | Fraction]
"""Of an arithmetic and the inputs by name; a Fraction where the value is known exactly."""


def shown(text: str) -> str:
    r"""Printed text as a page shows it, without the marks of LaTeX.

    >>> shown(r"9.13 \times 10^9"), shown(r"\frac{1}{2}"), shown("~ 0.3"), shown("m^{1/2}")
    ('9.13 × 10⁹', '1/2', '~0.3', 'm^(1/2)')
    """
    text = re.sub(r"\\frac\{(\d+)\}\{(\d+)\}", r"\1/\2", text).replace(r"\times", "×")
    text = re.sub(r"\^\{(-?\d+)\}", r"^\1", text)
    text = re.sub(r"\^\{([^{}]*)\}", r"^(\1)", text)
    return re.sub(r"~\s+", "~", raised(text))


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


class Claim(ClaimEntry, frozen=True, kw_only=True, dict=True, eq=False):
    """One printed number: its table of the file, and what follows from it.

    `computations` has the computation as printed under the name "", and each other reading;
    `inputs` names for each input of them the entries whose product it is; `given` is the reason why
    nothing in the report decides the number; `chosen` says that the author set it, here or where
    this claim repeats it; `bound` is the number that a relation compares with; `within` the id of
    the equation that the number is a constant of.
    """

    text: str
    place: Place
    printed: Printed | None
    computations: Mapping[str, Computation]
    inputs: Mapping[str, tuple[str, ...]]
    within: str | None
    chosen: bool
    bound: Fraction | None = None

    @property
    def shown(self) -> str:
        """Its text as a page shows it, without the marks of LaTeX."""
        return shown(self.text)

    @cached_property
    def si(self) -> Fraction:
        """The factor from the claim's unit to SI."""
        return to_si(self.unit)

    @property
    def number(self) -> Printed:
        """What it prints. Raises LedgerError for a remark."""
        if self.printed is None:
            raise LedgerError(f"claim {self.id!r} prints no number")
        return self.printed

    @cached_property
    def value(self) -> Fraction:
        """The number as printed, in SI. Raises LedgerError for a remark."""
        return self.number.value * self.si

    @property
    def is_exact(self) -> bool:
        """Whether the text is the value itself under every convention."""
        return self.exact or self.kind == "constant"

    def interval(self, rounding: Rounding = Rounding.AWAY) -> Interval:
        """The values, in its unit, that agree with the claim. Raises LedgerError for a remark."""
        if self.bound is not None:
            above, closed = self.relation in (">", ">="), self.relation in ("<=", ">=")
            low, high = (self.bound, None) if above else (None, self.bound)
            return Interval(low, high, closed, closed)
        if self.is_exact:
            return Interval.point(self.number.value)
        is_about = self.kind == "approximation"
        return self.number.about() if is_about else self.number.interval(rounding)

    def target(self, rounding: Rounding = Rounding.AWAY) -> Interval:
        """`interval` in SI."""
        return self._targets[rounding]

    @cached_property
    def _targets(self) -> Mapping[Rounding, Interval]:
        return {rounding: self.interval(rounding).scaled(self.si) for rounding in Rounding}

    def as_input(self, convention: Convention) -> Interval:
        """The values, in SI, that this number may stand for where another claim rests on it."""
        in_header = self.cell is not None and self.cell.startswith("B")
        if (
            self.is_exact
            or self.number.quantum == 0
            or self.bound is not None
            or (self.chosen and convention.choices_exact)
            or (in_header and convention.header_exact)
        ):
            return Interval.point(self.value)
        return self.target(convention.rounding)

    @property
    def computation(self) -> Computation | None:
        """What computes it as printed."""
        return self.computations.get("")

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

    @cached_property
    def uses(self) -> list[str]:
        """The printed equations that it is computed with, sorted."""
        return sorted({e for c in self.computations.values() for e in c.equations})


class Equation(EquationEntry, frozen=True, kw_only=True, eq=False):
    """One printed equation: its table of the file, and where it stands."""

    place: Place


class Ledger(Document, frozen=True, kw_only=True, dict=True, eq=False):
    """All claims and equations in the order of the report, the inferred inputs, and the text.

    `constants` are the claims inside every equation, `blank` the cells that Table A-1 leaves blank,
    `misprinted` the texts that stand in the place of the report's, by the id of the claim or
    equation.
    """

    text: str
    claims: dict[str, Claim]
    equations: dict[str, Equation]
    constants: dict[str, list[str]]
    sources: dict[str, Source]
    blank: tuple[str, ...]
    misprinted: Mapping[str, str] = {}

    # The printed equations

    @cached_property
    def written(self) -> Mapping[str, str]:
        """How the report writes its symbols, and their names."""
        return {text: name for name, symbol in self.symbols.items() for text in symbol.written}

    @cached_property
    def dimensions(self) -> Mapping[str, Dimension]:
        """The dimension of every symbol."""
        return {name: unit_dimension(symbol.unit) for name, symbol in self.symbols.items()}

    def constants_of(self, equation: str) -> list[str]:
        """The claims that are constants of an equation, in its order."""
        return [] if equation in self.misprinted else self.constants[equation]

    def printed_text(self, name: str, constants: Mapping[str, Fraction] = {}) -> str:
        """The text of a claim, or of an equation, with other constants in it if they are given."""
        if name in self.claims:
            return self.claims[name].text
        if name in self.misprinted:
            return self.misprinted[name]
        place = self.equations[name].place
        at, text = place.start, ""
        for claim in map(self.claims.__getitem__, self.constants_of(name)):
            own = constants.get(claim.id)
            shown = claim.text if own is None else rf"\frac{{{own.numerator}}}{{{own.denominator}}}"
            text += self.text[at : claim.place.start] + shown
            at = claim.place.end
        return text + self.text[at : place.end]

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

    def title(self, name: str) -> str:
        """What an entry is, in words."""
        equation = self.equations.get(name)
        return equation.title if equation else self._input(name).title

    def unit(self, name: str) -> str:
        """The unit of an input."""
        return self._input(name).unit

    def _input(self, name: str) -> Claim | Inferred:
        if name.startswith(INFERRED):
            return _known("inferred input", name.removeprefix(INFERRED), self.inferred)
        claim = _known("number", name, self.claims)
        if claim.printed is None:
            raise LedgerError(f"there is no number {name!r}: what it prints is in words")
        return claim

    def value(self, name: str) -> Fraction:
        """An entry's value as printed, or the nominal one of an inferred input, in SI.

        >>> float(load().value("flow-stress"))
        700000000.0
        """
        entry = self._input(name)
        return entry.nominal * to_si(entry.unit) if isinstance(entry, Inferred) else entry.value

    def search(self, name: str) -> tuple[Fraction, Fraction, str]:
        """The least and the greatest value of an entry, in SI, to search, and why these."""
        key = self._input(name).quantity
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
        computation, sides = claim.computations[reading], self.sides
        settings: dict[str, Any] = {
            key: self.value(claim.inputs[key][0])
            for key, unit in computation.inputs.items()
            if unit == EXPONENT
        }
        inputs = {key: names for key, names in claim.inputs.items() if key not in settings}
        if computation.by_row:
            settings["row"] = claim.row
        if computation.by_scheme:
            settings["centered"] = centered

        def of_entries(ar: Arithmetic, **entries: Number) -> Number | Fraction:
            value = entries.__getitem__
            own = {key: reduce(mul, map(value, names)) for key, names in inputs.items()}
            return computation.function(Formulas(ar, sides), **own, **settings)

        return of_entries

    # Copies with a misprint

    def misprint(self, name: str, text: str) -> "Ledger":
        """A copy with other text in the place of a claim's or an equation's.

        Raises ValueError if a claim's text is no number.
        """
        claims, equation = self.claims, name
        if name not in self.equations:
            claims = dict(claims)
            claims[name] = replace(claims[name], text=text, printed=parse(text))
            for claim in [c for c in claims.values() if name in (c.id, c.against)]:
                claims[claim.id] = replace(claim, bound=_bound(claim, claims))
            equation = claims[name].within or ""
        misprinted = {**self.misprinted, name: text}
        copy = replace(self, claims=claims, misprinted=misprinted)
        # What no text decides, and all other equations, are as they were.
        copy.__dict__.update(written=self.written, dimensions=self.dimensions)
        again = {equation: copy._sides_of(self.equations[equation])} if equation else {}
        copy.__dict__["sides"] = {**self.sides, **again}
        return copy


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
    document, sources = (tomllib.loads(_file(name)) for name in ("ledger.toml", "sources.toml"))
    return read(document, _file(document["report"]["text"]), sources["source"])


def _file(name: str) -> str:
    return (resources.files("reference.report") / name).read_text("utf-8")


def claims_of_case(beta: int) -> dict[str, str]:
    """The claims that print the inputs of the report's case with this beta.

    >>> claims_of_case(5)["beta"]
    'depth-beta-5-beta'
    """
    # The target density is printed nowhere: the audit infers what Table A-1 admits.
    strength = {"beta": f"depth-beta-{beta}-beta", "flow_stress": "flow-stress"}
    return {**load().groups["impact"], **strength}


def read(
    document: Mapping[str, Any], text: str, sources: Sequence[Mapping[str, Any]] = ()
) -> Ledger:
    """Build and check a ledger from its parsed TOML, the report's text, and the public sources.

    Raises LedgerError, which names the entry, what is wrong with it and what would be right.
    """
    tables = converted(document, Document, "ledger.toml")
    if not tables.claim_entries:
        raise LedgerError("the ledger is empty: it has no [[claim]]")
    names = Counter(entry.id for entry in (*tables.equation_entries, *tables.claim_entries))
    if twice := next((name for name, times in names.items() if times > 1), None):
        raise LedgerError(f"{twice!r} stands in the ledger twice")
    equations: dict[str, Equation] = {}
    for equation in tables.equation_entries:
        with naming(f"equation {equation.id!r}"):
            if equation.kind == "derived" and equation.id not in DERIVATIONS:
                raise ValueError("nothing in reference/derivations.py derives it")
            place = place_of(text, equation.quote)
            equations[equation.id] = Equation(**asdict(equation), place=place)
    claims: dict[str, Claim] = {}
    for entry in tables.claim_entries:
        with naming(f"claim {entry.id!r}"):
            claims[entry.id] = _claim(entry, tables, text, equations)
    claims = dict(sorted(_completed(claims).items(), key=lambda item: item[1].place.order))
    ledger = Ledger(
        **{name: getattr(tables, name) for name in tables.__struct_fields__},
        text=text,
        claims=claims,
        equations=equations,
        constants={e: [c.id for c in claims.values() if c.within == e] for e in equations},
        sources={source.id: source for source in converted(sources, list[Source], "sources.toml")},
        blank=tuple(cell for cells in tables.table["blank"] for cell in _cells(cells)),
    )
    _check(ledger)
    return ledger


def _known(what: str, name: str, known: Mapping[str, Anything]) -> Anything:
    """What the ledger calls by this name."""
    if name not in known:
        near = get_close_matches(name, known, 1)
        hint = f"; is it {near[0]!r}?" if near else ""
        raise LedgerError(f"there is no {what} {name!r}{hint}")
    return known[name]


def _cells(cells: str) -> Iterator[str]:
    match = re.fullmatch(r"([A-F])(\d+):([A-F])(\d+)", cells)
    if match is None:
        raise LedgerError(f"[table] blank: {cells!r} is no range of cells such as C1:F6")
    first, top, last, bottom = match.groups()
    for row in range(int(top), int(bottom) + 1):
        yield from (f"{column}{row}" for column in "ABCDEF" if first <= column <= last)


# Claims


def _claim(
    entry: ClaimEntry, tables: Document, text: str, equations: Mapping[str, Equation]
) -> Claim:
    """One claim, as far as its own entry tells."""
    place = place_of(text, entry.quote, entry.cell)
    words = text[place.start : place.end]
    around = (e.id for e in equations.values() if e.place.start <= place.start < e.place.end)
    within = next(around, None)
    to_si(entry.unit)
    if entry.kind in ("bound", "order of magnitude", "comparison") and entry.relation is None:
        raise ValueError(f"kind {entry.kind!r} needs a relation: <, <=, > or >=")
    decided = (entry.computed_by is None) != (entry.given is None)
    if not (decided or within or entry.kind == "remark"):
        raise ValueError("needs either computed_by or given")
    if entry.quantity is not None:
        _known("quantity", entry.quantity, tables.quantities)
    readings = {"": entry.computed_by, **entry.readings} if entry.computed_by else {}
    rests_on = dict(entry.rests_on)
    if (group := rests_on.pop("group", None)) is not None:
        rests_on = {**_known("group", group, tables.groups), **rests_on}
    if rests_on and not readings:
        raise ValueError("rests_on needs computed_by")
    given = None if entry.given is None else _known("reason", entry.given, tables.reasons)
    return Claim(
        **{**asdict(entry), "given": given},
        text=words,
        place=place,
        printed=None if entry.kind in ("comparison", "remark") else parse(words),
        computations={
            key: _known("computation", name, COMPUTATIONS) for key, name in readings.items()
        },
        inputs={key: tuple(names.split(" * ")) for key, names in rests_on.items()},
        within=within,
        chosen=entry.given == "choice",
    )


def _completed(claims: Mapping[str, Claim]) -> dict[str, Claim]:
    """Claims with what they take from others: the number compared with, whose choice it is."""
    graph = TopologicalSorter({claim.id: claim.entries for claim in claims.values()})
    try:
        order = [claims[name] for name in graph.static_order() if name in claims]
    except CycleError as error:
        raise LedgerError(f"claims rest on each other: {' on '.join(error.args[1])}") from error
    completed: dict[str, Claim] = {}
    for claim in order:
        repeated = claim.entries if claim.computation is COMPUTATIONS["same_as"] else []
        chosen = any(completed[name].chosen for name in repeated if name in completed)
        with naming(f"claim {claim.id!r}"):
            bound = _bound(claim, claims)
        completed[claim.id] = replace(claim, chosen=claim.chosen or chosen, bound=bound)
    return completed


def _bound(claim: Claim, claims: Mapping[str, Claim]) -> Fraction | None:
    """The number that a claim compares with, its own or another claim's."""
    compared, against = claim, claim.against
    if against is not None:
        compared = _known("number", against, claims)
        if compared.printed is None:
            raise ValueError(f"there is no number {against!r} to compare with")
        if compared.unit != claim.unit:
            raise ValueError(f"is in {claim.unit}, but {against} in {compared.unit}")
    return None if claim.relation is None or compared.printed is None else compared.printed.value


# What does not fit between entries


def _check(ledger: Ledger) -> None:
    for claim in ledger.claims.values():
        for computation in claim.computations.values():
            with naming(f"claim {claim.id!r}, {computation.name}"):
                _check_computation(claim, computation, ledger)
    slips = {slip.name: slip for slip in ledger.slips}
    tables: Sequence[tuple[str, Mapping[str, Any], Callable[[Any, Ledger], object]]] = (
        ("claim", ledger.claims, _check_shown),
        ("inferred", ledger.inferred, _check_inferred),
        ("source", ledger.sources, _check_source),
        ("symbol", ledger.symbols, lambda symbol, _: to_si(symbol.unit)),
        ("equation", ledger.equations, lambda own, _: ledger.read(ledger.printed_text(own.id))),
        ("slip", slips, _check_slip),
    )
    for kind, entries, check in tables:
        for name, entry in entries.items():
            with naming(f"{kind} {name!r}"):
                check(entry, ledger)


def _check_shown(claim: Claim, ledger: Ledger) -> None:
    for name in claim.shown_by:
        if name not in ledger.claims or claim.id not in ledger.claims[name].entries:
            raise ValueError(f"{name!r} does not rest on it")


def _check_inferred(entry: Inferred, ledger: Ledger) -> None:
    own = (entry.mass, entry.radius, entry.density)
    for name in (*entry.evidence, *entry.header, *entry.results, *own):
        _known("claim", name, ledger.claims)
    _known("quantity", entry.quantity, ledger.quantities)


def _check_source(source: Source, ledger: Ledger) -> None:
    for name in source.claims:
        if not same_dimension(ledger.unit(name), source.unit):
            raise ValueError(f"{name} is not in {source.unit}")
    if not 1 <= len(source.numbers) <= 2:
        raise ValueError("its quote marks no number, and no two, with ⟦ and ⟧")


def _check_slip(slip: Slip, ledger: Ledger) -> None:
    _known("equation", slip.equation, ledger.equations)
    if slip.text is not None:
        ledger.read(slip.text)
    for name in slip.inputs.values():
        _known("number", name, ledger.claims)


def _check_computation(claim: Claim, computation: Computation, ledger: Ledger) -> None:
    """Its row, the names of its inputs, and their units."""
    if computation.by_row != (claim.row is not None):
        raise ValueError("needs a row" if computation.by_row else "takes no row")
    expected = computation.inputs
    if "each" in expected:
        expected = dict.fromkeys(claim.inputs, expected["each"])
    if set(expected) != set(claim.inputs):
        raise ValueError(f"needs inputs {sorted(expected)}, not {sorted(claim.inputs)}")
    shared = None
    for name, unit in expected.items():
        own = " ".join(ledger.unit(part) for part in claim.inputs[name])
        if unit == SAME:
            unit = shared = shared or own
        if not same_dimension(own, "1" if unit == EXPONENT else unit):
            raise ValueError(f"input {name} is in {own}, which does not measure what {unit} does")
    result = computation.unit if computation.unit != SAME else shared or claim.unit
    if not same_dimension(claim.unit, result):
        raise ValueError(f"unit {claim.unit} does not measure what {result} does")
