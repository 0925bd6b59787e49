"""The ledger: every number and equation that the report prints, located in its text.

The comment at the head of each TOML file of `reference/report` explains its keys. Loading a file
checks that every entry has the keys it needs and that its quote occurs in the report exactly once.
The tests of the shipped files check that entries agree with each other (names, units, kinds).
"""

import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import cache, cached_property, reduce
from importlib import resources
from operator import mul
from string import ascii_uppercase
from typing import Any, Literal

import msgspec
from msgspec.structs import replace

from reference.arithmetic import Arithmetic, Function, Number
from reference.computations import COMPUTATIONS, Computation
from reference.equations import EquationError, Equations, Node, Sides, read_equation
from reference.printed import Interval, Place, Printed, Rounding, parse, place_of
from reference.scheme import Scheme
from reference.units import Dimension, raised, to_si, unit_dimension

INFERRED = "inferred:"
"""The prefix of the id of an input that the report does not print."""

READ_AS_PRINTED = ""
"""The name of the reading that takes a claim's equation as the report prints it."""

Kind = Literal[
    "input", "result", "approximation", "order of magnitude", "bound", "range",
    "quoted", "constant", "remark",
]  # fmt: skip


def as_shown(text: str) -> str:
    r"""Return printed text as it is shown to readers, without LaTeX markup.

    >>> as_shown(r"9.13 \times 10^9"), as_shown(r"\frac{1}{2}")
    ('9.13 × 10⁹', '1/2')
    >>> as_shown("~ 0.3"), as_shown("m^{1/2}")
    ('~0.3', 'm^(1/2)')
    """
    text = re.sub(r"\\frac\{(\d+)\}\{(\d+)\}", r"\1/\2", text).replace(r"\times", "×")
    text = re.sub(r"\^\{(-?\d+)\}", r"^\1", text)
    text = re.sub(r"\^\{([^{}]*)\}", r"^(\1)", text)
    return re.sub(r"~\s+", "~", raised(text))


class TomlStruct(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A table of a TOML file; an unknown key is an error."""


class Inferred(TomlStruct, frozen=True):
    """An input that the report does not print; it is inferred from the numbers that it prints.

    `search` is the range that is searched and `nominal` the value taken where the evidence admits
    it, both in `unit`. `mass`, `radius`, `density`, `header` and `evidence` are ids of claims.
    """

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
    evidence: list[str]


class Symbol(TomlStruct, frozen=True):
    """A symbol of the equations: how the report writes it, how it is shown, and what it means."""

    written: list[str]
    shown: str
    unit: str
    means: str
    value: str | None = None


class Quantity(TomlStruct, frozen=True):
    """A physical quantity: its unit, the range of values that is searched, and the reason."""

    unit: str
    search: tuple[Fraction, Fraction]
    reason: str


class Source(TomlStruct, frozen=True):
    """A public source for a number that the report does not derive (see sources.toml)."""

    id: str
    title: str
    address: str
    quote: str
    unit: str
    applies: str
    claims: list[str]

    @property
    def numbers(self) -> list[Printed]:
        """The number that the source prints, or both ends of the range that it prints."""
        return [parse(text) for text in re.findall("⟦(.*?)⟧", self.quote)]

    @property
    def says(self) -> str:
        """The number or the range as text, without its unit."""
        return " to ".join(number.text for number in self.numbers)

    @property
    def value(self) -> Fraction:
        """The number, or the lower end of the range, in SI."""
        return self.numbers[0].value * to_si(self.unit)

    @property
    def interval(self) -> Interval:
        """The values, in SI, that agree with the source."""
        ends = [number.interval() for number in self.numbers]
        whole = Interval(ends[0].lower, ends[-1].upper, ends[0].lower_closed, ends[-1].upper_closed)
        return whole.scaled(to_si(self.unit))


class Report(TomlStruct, frozen=True):
    """The report that is audited: its text's file name and its bibliographic data."""

    text: str
    title: str
    author: str
    year: int


class Convention(msgspec.Struct, frozen=True):
    """One reading of the report where it does not say how it was rounded or computed.

    `rounding` is how values became printed text. With `choices_exact`, what the author chose
    (500 m/s, 700 MPa, 0.2 ns) is exact, not rounded; with `header_exact`, so are the numbers
    above the rows of Table A-1. `scheme` is how the sheet is computed.
    """

    rounding: Rounding = Rounding.AWAY
    choices_exact: bool = True
    header_exact: bool = False
    scheme: Scheme = Scheme.PUBLISHED


def in_header(cell: str | None) -> bool:
    """Return whether a cell is in the header of Table A-1, whose numbers are all in column B."""
    return cell is not None and cell.startswith("B")


class Equation(TomlStruct, frozen=True, eq=False):
    """A printed equation, with its place in the report; `reference.derivations` checks it."""

    id: str
    title: str
    quote: str
    kind: Literal["derived", "definition", "repeat", "taken over"]
    follows_from: str
    place: Place = Place()


class Claim(TomlStruct, frozen=True, dict=True, eq=False):
    """A claim: one printed number, with what is recorded about it and what follows from that.

    `Ledger.claims` fills in the fields from `text` on. `why` is the reason of which `given` is the
    key. `computations` has the computation `READ_AS_PRINTED`, and other readings by name. `inputs`
    maps each input of the computations to the entries whose product it is. `within` is the equation
    that the number is a constant of. `chosen` says that the author set the number, here or in the
    claim that this one repeats. `bound` is the number that a relation compares with.
    """

    id: str
    title: str
    quote: str
    kind: Kind
    unit: str = "1"
    exact: bool = False
    relation: Literal["<", "<=", ">", ">="] | None = None
    cell: str | None = None
    row: int | None = None
    quantity: str | None = None
    computed_by: str | None = None
    rests_on: Mapping[str, str | list[str]] = {}
    readings: Mapping[str, str] = {}
    assumes: str | None = None
    same_as: str | None = None
    given: str | None = None
    shown_by: Sequence[str] = ()
    text: str = ""
    place: Place = Place()
    why: str | None = None
    computations: Mapping[str, Computation] = {}
    inputs: Mapping[str, tuple[str, ...]] = {}
    within: str | None = None
    chosen: bool = False

    @cached_property
    def printed(self) -> Printed | None:
        """The printed number; None for a remark."""
        return None if self.kind == "remark" else parse(self.text)

    @property
    def shown(self) -> str:
        """The text as it is shown to readers, without LaTeX markup."""
        return as_shown(self.text)

    @cached_property
    def si(self) -> Fraction:
        """The factor from the claim's unit to SI."""
        return to_si(self.unit)

    @property
    def number(self) -> Printed:
        """The printed number. Raises ValueError for a remark."""
        if self.printed is None:
            raise ValueError(f"claim {self.id!r} prints no number")
        return self.printed

    @cached_property
    def value(self) -> Fraction:
        """The number as printed, in SI. Raises ValueError for a remark."""
        return self.number.value * self.si

    @cached_property
    def bound(self) -> Fraction | None:
        """The printed number, in its unit, if it is a bound; None for any other claim."""
        return self.number.value if self.relation else None

    @property
    def is_exact(self) -> bool:
        """Whether the text is the exact value under every convention."""
        return self.exact or self.kind == "constant"

    def interval(self, rounding: Rounding = Rounding.AWAY) -> Interval:
        """Return the values that agree with it, in its unit. Raises ValueError for a remark."""
        if self.bound is not None:
            above, closed = self.relation in (">", ">="), self.relation in ("<=", ">=")
            low, high = (self.bound, None) if above else (None, self.bound)
            return Interval(low, high, closed, closed)
        if self.is_exact:
            return Interval.point(self.number.value)
        is_about = self.kind == "approximation"
        return self.number.about() if is_about else self.number.interval(rounding)

    def target(self, rounding: Rounding = Rounding.AWAY) -> Interval:
        """Return the values, in SI, that agree with the claim. Raises ValueError for a remark."""
        return self._targets[rounding]

    @cached_property
    def _targets(self) -> Mapping[Rounding, Interval]:
        return {rounding: self.interval(rounding).scaled(self.si) for rounding in Rounding}

    def as_input(self, convention: Convention) -> Interval:
        """Return the values, in SI, that the number may have as an input of another claim."""
        if (
            self.number.quantum == 0
            or self.bound is not None
            or (self.chosen and convention.choices_exact)
            or (in_header(self.cell) and convention.header_exact)
        ):
            return Interval.point(self.value)
        return self.target(convention.rounding)

    @property
    def computation(self) -> Computation | None:
        """The computation that gives the claim as printed, if there is one."""
        return self.computations.get(READ_AS_PRINTED)

    @property
    def restates(self) -> bool:
        """Whether the claim only repeats or counts what the report prints elsewhere."""
        return self.computation is not None and self.computation.restates

    @property
    def is_computed(self) -> bool:
        """Whether a computation gives the claim that is no restatement."""
        return self.computation is not None and not self.computation.restates

    @cached_property
    def input_ids(self) -> list[str]:
        """The ids of the entries that the claim is computed from, sorted."""
        return sorted({name for names in self.inputs.values() for name in names})

    @property
    def inferred(self) -> list[str]:
        """The entries that the claim is computed from and that the report does not print."""
        return [name for name in self.input_ids if name.startswith(INFERRED)]

    @property
    def stated(self) -> list[str]:
        """The entries that the claim is computed from and that the report prints."""
        return [name for name in self.input_ids if not name.startswith(INFERRED)]

    def resting_on(self, **inputs: str) -> "Claim":
        """Return a copy of the claim in which these entries replace those of the named inputs."""
        entries = {key: (name,) for key, name in inputs.items()}
        return replace(self, inputs={**self.inputs, **entries})

    @cached_property
    def by_scheme(self) -> bool:
        """Whether the claim depends on the numerical scheme of the sheet."""
        return any(computation.by_scheme for computation in self.computations.values())

    @property
    def by_whole_sheet(self) -> bool:
        """Whether the claim is computed from all rows of the sheet, which is slow."""
        return self.by_scheme and self.row is None

    @cached_property
    def uses(self) -> list[str]:
        """The ids of the printed equations in the claim's computations, sorted."""
        computations = self.computations.values()
        return sorted({name for own in computations for name in own.equations})


class Lines(TomlStruct, frozen=True):
    """The lines of a claim or an equation in ledger.toml."""

    quote: str
    what: Mapping[str, Any]
    basis: Mapping[str, Any] = {}


class TableColumn(TomlStruct, frozen=True):
    """What the claims in a column of Table A-1 have in common; their ids begin with `id`."""

    id: str
    what: Mapping[str, Any]
    basis: Mapping[str, Any]


class TimeSteps(TomlStruct, frozen=True):
    """The table [time_steps]: the rows of Table A-1 as printed, and what columns have in common."""

    rows: Mapping[str, str]
    columns: Mapping[str, TableColumn]

    @property
    def claims(self) -> Iterator[Claim]:
        """The claims of the cells that print a number, by rows."""
        for step, (row, printed) in enumerate(self.rows.items(), 1):
            cells = dict(zip(ascii_uppercase, printed.split("\t"), strict=False))
            for letter, column in self.columns.items():
                marked = {**cells, letter: f"⟦{cells[letter]}⟧"}
                what = {
                    **column.what, "title": f"{column.what['title']}, row {step}",
                    "cell": f"{letter}{row}", "row": step,
                }  # fmt: skip
                lines = Lines("\t".join(marked.values()), what, column.basis)
                yield read_lines(f"{column.id}-{step}", lines, Claim)


def read_lines(name: str, lines: Lines, kind: type[TomlStruct]) -> Any:
    """Return the claim or the equation that these lines give.

    Raises msgspec.ValidationError, with its id, for an unknown key or a missing one.
    """
    keys = {**lines.what, **lines.basis, "id": name, "quote": lines.quote}
    try:
        return msgspec.convert(keys, kind)
    except msgspec.ValidationError as error:
        raise msgspec.ValidationError(f"ledger.toml: {name}: {error}") from error


class Ledger(TomlStruct, frozen=True, dict=True, eq=False):
    """The content of ledger.toml, with claims and equations in the order of the report.

    `misprinted` maps the id of a claim or an equation to the text that replaces the report's.
    """

    report: Report
    reasons: dict[str, str]
    blank: list[str]
    groups: dict[str, dict[str, str]]
    inferred: dict[str, Inferred]
    symbols: dict[str, Symbol]
    quantities: dict[str, Quantity]
    incidental: list[dict[Literal["pattern", "reason"], str]]
    equation: dict[str, Lines]
    claim: dict[str, Lines]
    time_steps: TimeSteps
    misprinted: Mapping[str, str] = {}

    @cached_property
    def text(self) -> str:
        """The text of the report."""
        return _file(self.report.text)

    @cached_property
    def sources(self) -> Mapping[str, Source]:
        """The public sources, by id."""
        sources = read_toml("sources.toml", dict[Literal["source"], list[Source]])["source"]
        return {source.id: source for source in sources}

    def sources_of(self, name: str) -> list[Source]:
        """Return the public sources for a claim or an inferred input."""
        return [source for source in self.sources.values() if name in source.claims]

    @cached_property
    def equations(self) -> Mapping[str, Equation]:
        """The printed equations, by id."""
        located = {}
        for name, lines in self.equation.items():
            place = place_of(self.text, lines.quote)
            located[name] = replace(read_lines(name, lines, Equation), place=place)
        return located

    @cached_property
    def claims(self) -> Mapping[str, Claim]:
        """The claims, by id."""
        located = {}
        single = (read_lines(name, lines, Claim) for name, lines in self.claim.items())
        for claim in (*single, *self.time_steps.claims):
            place = place_of(self.text, claim.quote, claim.cell)
            text = self.text[place.start : place.end]
            located[claim.id] = replace(claim, text=text, place=place)
        in_order = sorted(located.values(), key=lambda claim: claim.place.start)
        return {claim.id: self._linked(claim, located) for claim in in_order}

    def _linked(self, claim: Claim, located: Mapping[str, Claim]) -> Claim:
        """Return a claim with the entries that it names looked up."""
        original = claim
        while original.same_as:
            original = located[original.same_as]
        if claim.same_as and claim.kind != "remark":
            claim = replace(claim, computed_by="same_as", rests_on={"value": claim.same_as})
        readings = {READ_AS_PRINTED: claim.computed_by, **claim.readings}
        inputs = dict(claim.rests_on)
        if group := inputs.pop("group", None):
            inputs = {**self.groups[str(group)], **inputs}
        places = ((equation.id, equation.place) for equation in self.equations.values())
        around = (name for name, at in places if at.start <= claim.place.start < at.end)
        return replace(
            claim,
            why=claim.given and self.reasons[claim.given],
            computations={key: COMPUTATIONS[name] for key, name in readings.items() if name},
            inputs={
                key: (names,) if isinstance(names, str) else tuple(names)
                for key, names in inputs.items()
            },
            within=next(around, None),
            chosen=original.given == "choice",
        )

    # The printed equations

    @cached_property
    def written(self) -> Mapping[str, str]:
        """The names of the symbols, by the texts that the report writes for them."""
        return {text: name for name, symbol in self.symbols.items() for text in symbol.written}

    @cached_property
    def dimensions(self) -> Mapping[str, Dimension]:
        """The dimension of every symbol."""
        return {name: unit_dimension(symbol.unit) for name, symbol in self.symbols.items()}

    def equation_of(self, name: str) -> str | None:
        """Return the id of an equation itself, or of the one that a claim is a constant of."""
        return name if name in self.equations else self.claims[name].within

    def constants_of(self, equation: str) -> list[str]:
        """Return the claims that are constants of an equation, in the order of its text.

        An equation whose whole text is replaced by a misprint has none.
        """
        if equation in self.misprinted:
            return []
        return [claim.id for claim in self.claims.values() if claim.within == equation]

    def printed_text(self, name: str, constants: Mapping[str, Fraction] | None = None) -> str:
        """Return the text of a claim, or of an equation with the values `constants` put in."""
        if name in self.claims:
            return self.claims[name].text
        if name in self.misprinted:
            return self.misprinted[name]
        place = self.equations[name].place
        text = self.text[place.start : place.end]
        for constant in reversed(self.constants_of(name)):  # the last one first: it moves no other
            claim, own = self.claims[constant], self.claims[constant].text
            value = (constants or {}).get(constant)
            if value is not None:
                own = rf"\frac{{{value.numerator}}}{{{value.denominator}}}"
            start, end = claim.place.start - place.start, claim.place.end - place.start
            text = text[:start] + own + text[end:]
        return text

    @cached_property
    def sides(self) -> Sides:
        """The sides of every equation. Raises EquationError if one cannot be read."""
        return {name: self.read(self.printed_text(name)) for name in self.equations}

    def read(self, text: str) -> tuple[Node, ...]:
        """Return the sides of an equation in the report's notation. Raises EquationError."""
        return read_equation(text, self.written)

    # The entries as inputs

    def title(self, name: str) -> str:
        """Return the title of an equation, a claim or an inferred input."""
        equation = self.equations.get(name)
        return equation.title if equation else self._input(name).title

    def unit(self, name: str) -> str:
        """Return the unit of a claim or an inferred input."""
        return self._input(name).unit

    def _input(self, name: str) -> Claim | Inferred:
        is_inferred = name.startswith(INFERRED)
        return self.inferred[name.removeprefix(INFERRED)] if is_inferred else self.claims[name]

    def value(self, name: str) -> Fraction:
        """Return, in SI, the printed value of a claim or the nominal value of an inferred input."""
        stated = self._input(name)
        if isinstance(stated, Inferred):
            return stated.nominal * to_si(stated.unit)
        return stated.value

    def search(self, name: str) -> tuple[Fraction, Fraction, str]:
        """Return the range, in SI, in which to search for an entry's value, and its reason."""
        key = self._input(name).quantity
        if key is None:
            if not (value := self.value(name)):
                return Fraction(-1), Fraction(1), "from -1 to 1, as zero is printed"
            least, greatest = sorted((value / 10, value * 10))
            return least, greatest, "from a tenth to ten times the printed value"
        quantity = self.quantities[key]
        low, high = (end * to_si(quantity.unit) for end in quantity.search)
        return low, high, quantity.reason

    # Claims as functions of their entries

    def function(
        self,
        claim: Claim,
        *,
        reading: str = READ_AS_PRINTED,
        scheme: Scheme = Scheme.PUBLISHED,
        equations: Equations | None = None,
    ) -> Function:
        """Return a claim's computation, as a function of an arithmetic and of its entries by id.

        An entry that occurs in several inputs is a single variable of that function. `reading` is
        the name of one of the claim's computations. Only what runs the sheet depends on `scheme`.
        `equations` are by default those that the ledger prints.
        """
        computation, inputs = claim.computations[reading], dict(claim.inputs)
        settings: dict[str, Any] = {}
        if "eq" in computation.settings:
            settings["eq"] = equations or Equations(self.sides)
        if computation.by_row:
            settings["row"] = claim.row
        if computation.by_scheme:
            settings["scheme"] = scheme
        if "power" in inputs:  # an exponent stays exact
            settings["power"] = self.value(*inputs.pop("power"))

        def of_entries(ar: Arithmetic, **entries: Number) -> Number | Fraction:
            value = entries.__getitem__
            known = {key: reduce(mul, map(value, names)) for key, names in inputs.items()}
            return computation.function(ar, **known, **settings)

        return of_entries

    # Copies with a misprint

    def misprint(self, name: str, text: str) -> "Ledger":
        """Return a copy in which a text replaces that of a claim or an equation.

        The claims that this does not change remain the same objects, and an equation that it makes
        unreadable keeps its sides. Raises ValueError if the text of a claim is no number, and
        KeyError for an unknown name.
        """
        if (equation := self.equation_of(name)) != name:
            parse(text)
        copy = replace(self, misprinted={**self.misprinted, name: text})
        for unchanged in ("text", "sources", "equations", "written", "dimensions"):
            copy.__dict__[unchanged] = getattr(self, unchanged)
        claims, sides = dict(self.claims), dict(self.sides)
        copy.__dict__.update(claims=claims, sides=sides)
        if name in claims:
            claims[name] = replace(claims[name], text=text)
        if equation:
            with suppress(EquationError):
                sides[equation] = self.read(copy.printed_text(equation))
        return copy


@cache
def load() -> Ledger:
    """Return the report's ledger.

    >>> ledger = load()
    >>> claim = ledger.claims["depth-beta-5"]
    >>> claim.text, str(claim.interval()), claim.unit
    ('7.67', '[7.665, 7.675)', 'um')
    """
    ledger: Ledger = read_toml("ledger.toml", Ledger)
    return ledger


def read_toml(file: str, kind: Any) -> Any:
    """Read a TOML file of `reference/report`.

    Raises msgspec.ValidationError, naming the file, if it is no TOML or does not fit.
    """
    try:
        document = tomllib.loads(_file(file))
        return msgspec.convert(document, kind, dec_hook=lambda kind, value: kind(value))
    except (tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
        raise msgspec.ValidationError(f"{file}: {error}") from error


def _file(name: str) -> str:
    return (resources.files("reference") / "report" / name).read_text("utf-8")


def claims_of_case(beta: int) -> dict[str, str]:
    """Return, by input, the claims that print the inputs of the report's case with this beta.

    >>> claims_of_case(5)["beta"]
    'depth-beta-5-beta'
    """
    # The report prints no target density: the audit infers the values that Table A-1 admits.
    strength = {"beta": f"depth-beta-{beta}-beta", "flow_stress": "flow-stress"}
    return {**load().groups["impact"], **strength}
