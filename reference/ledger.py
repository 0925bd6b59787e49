"""The ledger: every number and equation that the report prints, placed in its text.

What each key of the files of `reference/report` means is said at their heads. Reading them checks
what each entry must have and that its quote stands in the report once; that entries fit each other
(names, units, kinds) is held by the tests of the shipped files.
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
from reference.equations import EquationError, Node, Sides, read_equation
from reference.formulas import Computation, Entry, Equation, function_of
from reference.printed import Interval, Place, Printed, Rounding, parse, place_of
from reference.units import Dimension, raised, to_si, unit_dimension

INFERRED = "inferred:"
"""What stands before the id of an input that the report does not print."""

Kind = Literal[
    "input", "result", "approximation", "order of magnitude", "bound", "comparison", "range",
    "quoted", "constant", "remark",
]  # fmt: skip


def shown(text: str) -> str:
    r"""Printed text as a page shows it, without the marks of LaTeX.

    >>> shown(r"9.13 \times 10^9"), shown(r"\frac{1}{2}"), shown("~ 0.3"), shown("m^{1/2}")
    ('9.13 × 10⁹', '1/2', '~0.3', 'm^(1/2)')
    """
    text = re.sub(r"\\frac\{(\d+)\}\{(\d+)\}", r"\1/\2", text).replace(r"\times", "×")
    text = re.sub(r"\^\{(-?\d+)\}", r"^\1", text)
    text = re.sub(r"\^\{([^{}]*)\}", r"^(\1)", text)
    return re.sub(r"~\s+", "~", raised(text))


class Inferred(Entry, frozen=True):
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
    evidence: list[str]


class Symbol(Entry, frozen=True):
    """What a symbol of the equations means, how the report writes it, and how a page shows it."""

    written: list[str]
    shown: str
    unit: str
    means: str
    value: str | None = None


class Quantity(Entry, frozen=True):
    """A physical quantity: the range of it that is searched, in its unit, and why this one."""

    unit: str
    search: tuple[Fraction, Fraction]
    reason: str


class Slip(Entry, frozen=True):
    """What the author may have computed instead: another text of an equation, or other inputs."""

    name: str
    reason: str
    equation: str
    text: str | None = None
    inputs: Mapping[str, str] = {}


class Source(Entry, frozen=True):
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


class Report(Entry, frozen=True):
    """What is audited."""

    text: str
    title: str
    author: str
    year: int


class Convention(msgspec.Struct, frozen=True):
    """How printed text is read where the report does not say how it was printed.

    `choices_exact`: what the author chose (500 m/s, 700 MPa, 0.2 ns) is the value itself, not a
    rounding of it. `header_exact`: so are the numbers above the rows of Table A-1. `centered`: the
    sheet takes the drag at the velocity in the middle of a row, not at its start.
    """

    rounding: Rounding = Rounding.AWAY
    choices_exact: bool = True
    header_exact: bool = False
    centered: bool = False


class ClaimEntry(Entry, frozen=True):
    """A [[claim]] of the file: one printed number, and what the ledger says about it."""

    id: str
    title: str
    quote: str
    kind: Kind
    unit: str = "1"
    computed_by: str | None = None
    rests_on: Mapping[str, str] = {}
    readings: Mapping[str, str] = {}
    same_as: str | None = None
    given: str | None = None
    shown_by: Sequence[str] = ()
    relation: Literal["<", "<=", ">", ">="] | None = None
    against: str | None = None
    assumes: str | None = None
    exact: bool = False
    cell: str | None = None
    row: int | None = None
    quantity: str | None = None
    workbook: str | None = None


class TimeSteps(Entry, frozen=True):
    """The [time_steps]: rows of Table A-1 as printed, and what the claims in a column share."""

    rows: Mapping[str, str]
    columns: Mapping[str, Mapping[str, Any]]

    @property
    def claims(self) -> Iterator[ClaimEntry]:
        """A claim for each cell that prints a number."""
        for step, (row, printed) in enumerate(self.rows.items(), 1):
            cells = dict(zip(ascii_uppercase, printed.split("\t"), strict=False))
            for letter, column in self.columns.items():
                marked = {**cells, letter: f"⟦{cells[letter]}⟧"}
                own = {
                    "id": f"{column['id']}-{step}", "title": f"{column['title']}, row {step}",
                    "quote": "\t".join(marked.values()), "cell": f"{letter}{row}", "row": step,
                }  # fmt: skip
                yield msgspec.convert({**column, **own}, ClaimEntry)


def in_header(cell: str | None) -> bool:
    """Whether a cell is one of those above the rows of Table A-1; they are all in column B."""
    return cell is not None and cell.startswith("B")


class Claim(ClaimEntry, frozen=True, kw_only=True, dict=True, eq=False):
    """A claim as it stands in the report.

    `given` is the key of a reason why nothing computes it, `why` that reason in words;
    `computations` has the computation as printed under the name "", and each other reading;
    `inputs` names for each input of the computations the entries whose product it is; `within` the
    equation that the number is a constant of; `chosen` says that the author set it, here or where
    this claim repeats it; `bound` is the number that a relation compares with.
    """

    text: str
    place: Place
    why: str | None
    computations: Mapping[str, Computation]
    inputs: Mapping[str, tuple[str, ...]]
    within: str | None
    chosen: bool = False
    bound: Fraction | None = None

    @cached_property
    def printed(self) -> Printed | None:
        """The printed number; None for a comparison or a remark."""
        return None if self.kind in ("comparison", "remark") else parse(self.text)

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
        """The printed number. Raises ValueError for a comparison or a remark."""
        if self.printed is None:
            raise ValueError(f"claim {self.id!r} prints no number")
        return self.printed

    @cached_property
    def value(self) -> Fraction:
        """The number as printed, in SI. Raises ValueError for a remark."""
        return self.number.value * self.si

    @property
    def is_exact(self) -> bool:
        """Whether the text is the value itself under every convention."""
        return self.exact or self.kind == "constant"

    def interval(self, rounding: Rounding = Rounding.AWAY) -> Interval:
        """The values, in its unit, that agree with the claim. Raises ValueError for a remark."""
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
        return self.interval(rounding).scaled(self.si)

    def as_input(self, convention: Convention) -> Interval:
        """The values, in SI, that this number may stand for where another claim rests on it."""
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
        """What computes the claim as printed, if anything does."""
        return self.computations.get("")

    @cached_property
    def entries(self) -> list[str]:
        """The entries that it rests on, sorted."""
        return sorted({name for names in self.inputs.values() for name in names})

    @property
    def inferred(self) -> list[str]:
        """The entries that it rests on and that the report does not print."""
        return [name for name in self.entries if name.startswith(INFERRED)]

    @property
    def stated(self) -> list[str]:
        """The entries that it rests on and that the report prints."""
        return [name for name in self.entries if not name.startswith(INFERRED)]

    def resting_on(self, **inputs: str) -> "Claim":
        """The claim with other entries for some of its inputs."""
        entries = {key: (name,) for key, name in inputs.items()}
        return replace(self, inputs={**self.inputs, **entries})

    @cached_property
    def by_scheme(self) -> bool:
        """Whether it depends on the scheme of the sheet."""
        return any(computation.by_scheme for computation in self.computations.values())

    @property
    def by_whole_sheet(self) -> bool:
        """Whether it is computed by all rows of the sheet, which takes long."""
        return self.by_scheme and self.row is None

    @cached_property
    def uses(self) -> list[str]:
        """The printed equations that it is computed with, sorted."""
        premises = (computation.premises for computation in self.computations.values())
        return sorted({premise.equation for each in premises for premise in each.values()})


class Ledger(Entry, frozen=True, dict=True, eq=False):
    """The whole of ledger.toml, with all claims and equations in the order of the report.

    `misprinted` are the texts that stand in the place of the report's, by the id of the claim or
    equation.
    """

    report: Report
    reasons: dict[str, str]
    blank: list[str]
    groups: dict[str, dict[str, str]]
    inferred: dict[str, Inferred]
    symbols: dict[str, Symbol]
    quantities: dict[str, Quantity]
    incidental: list[dict[Literal["pattern", "reason"], str]]
    equation: list[Equation]
    claim: list[ClaimEntry]
    time_steps: TimeSteps
    slip: list[Slip]
    computation: list[Computation]
    misprinted: Mapping[str, str] = {}

    @cached_property
    def text(self) -> str:
        """The report."""
        return _file(self.report.text)

    @cached_property
    def sources(self) -> Mapping[str, Source]:
        """The public sources, by id."""
        sources = tables("sources.toml", dict[Literal["source"], list[Source]])["source"]
        return {source.id: source for source in sources}

    def sources_of(self, name: str) -> list[Source]:
        """The public sources for a claim or an inferred input."""
        return [source for source in self.sources.values() if name in source.claims]

    @cached_property
    def computations(self) -> Mapping[str, Computation]:
        """What computes claims, by name."""
        return {computation.name: computation for computation in self.computation}

    @cached_property
    def equations(self) -> Mapping[str, Equation]:
        """The printed equations, by id."""
        return {
            equation.id: replace(equation, place=place_of(self.text, equation.quote))
            for equation in self.equation
        }

    @cached_property
    def claims(self) -> Mapping[str, Claim]:
        """The claims, by id."""
        texts, claims = self.misprinted, {**self._claims}
        for name in texts.keys() & claims.keys():
            claims[name] = replace(claims[name], text=texts[name])
        for name, claim in claims.items():
            if name in texts or claim.against in texts:
                claims[name] = replace(claim, bound=_bound(claim, claims))
        return claims

    @cached_property
    def _claims(self) -> Mapping[str, Claim]:
        """The claims as the report prints them."""
        entries = (*self.claim, *self.time_steps.claims)
        placed = sorted(map(self._placed, entries), key=lambda claim: claim.place.start)
        claims = {claim.id: claim for claim in placed}
        return {
            name: replace(claim, chosen=_is_chosen(claim, claims), bound=_bound(claim, claims))
            for name, claim in claims.items()
        }

    def _placed(self, claim: ClaimEntry) -> Claim:
        if claim.cell:  # our sheet of that name has it in the same cell
            claim = replace(claim, workbook=f"Table A-1!{claim.cell}")
        if claim.same_as:
            claim = replace(claim, computed_by="same_as", rests_on={"value": claim.same_as})
        readings = {"": claim.computed_by, **claim.readings}
        place, rests_on = place_of(self.text, claim.quote, claim.cell), dict(claim.rests_on)
        group = rests_on.pop("group", None)
        inputs = {**self.groups[group], **rests_on} if group else rests_on
        places = ((equation.id, equation.place) for equation in self.equations.values())
        around = (name for name, at in places if at.start <= place.start < at.end)
        return Claim(
            **msgspec.structs.asdict(claim),
            why=claim.given and self.reasons[claim.given],
            text=self.text[place.start : place.end],
            place=place,
            computations={key: self.computations[name] for key, name in readings.items() if name},
            inputs={key: tuple(names.split(" * ")) for key, names in inputs.items()},
            within=next(around, None),
        )

    # The printed equations

    @cached_property
    def written(self) -> Mapping[str, str]:
        """How the report writes its symbols, and their names."""
        return {text: name for name, symbol in self.symbols.items() for text in symbol.written}

    @cached_property
    def dimensions(self) -> Mapping[str, Dimension]:
        """The dimension of every symbol."""
        return {name: unit_dimension(symbol.unit) for name, symbol in self.symbols.items()}

    def equation_of(self, name: str) -> str | None:
        """The equation with this id, or that the number with this id is a constant of."""
        return name if name in self.equations else self.claims[name].within

    def constants_of(self, equation: str) -> list[str]:
        """The claims that are constants of an equation, in its order."""
        if equation in self.misprinted:
            return []
        return [claim.id for claim in self.claims.values() if claim.within == equation]

    def printed_text(self, name: str, constants: Mapping[str, Fraction] = {}) -> str:
        """The text of a claim, or of an equation, with other constants in it if they are given."""
        if name in self.claims:
            return self.claims[name].text
        if name in self.misprinted:
            return self.misprinted[name]
        place = self.equations[name].place
        at, text = place.start, ""
        for constant in self.constants_of(name):
            claim, own = self.claims[constant], self.claims[constant].text
            if (value := constants.get(constant)) is not None:
                own = rf"\frac{{{value.numerator}}}{{{value.denominator}}}"
            text += self.text[at : claim.place.start] + own
            at = claim.place.end
        return text + self.text[at : place.end]

    @cached_property
    def sides(self) -> Sides:
        """The sides of every equation.

        Where a misprint makes one unreadable, they are those that the report prints. Raises
        EquationError if even these cannot be read.
        """
        sides = {**self._sides}
        for name in filter(None, map(self.equation_of, self.misprinted)):
            with suppress(EquationError):
                sides[name] = self.read(self.printed_text(name))
        return sides

    @cached_property
    def _sides(self) -> Sides:
        """The sides as the report prints them."""
        places = {name: equation.place for name, equation in self.equations.items()}
        return {name: self.read(self.text[at.start : at.end]) for name, at in places.items()}

    def read(self, text: str) -> tuple[Node, ...]:
        """The sides of an equation of this report, given as text. Raises EquationError."""
        return read_equation(text, self.written)

    # The entries as inputs

    def title(self, name: str) -> str:
        """What an entry is, in words."""
        equation = self.equations.get(name)
        return equation.title if equation else self._input(name).title

    def unit(self, name: str) -> str:
        """The unit of an input."""
        return self._input(name).unit

    def _input(self, name: str) -> Claim | Inferred:
        unknown = name.startswith(INFERRED)
        return self.inferred[name.removeprefix(INFERRED)] if unknown else self.claims[name]

    def value(self, name: str) -> Fraction:
        """An entry's value as printed, or the nominal one of an inferred input, in SI."""
        entry = self._input(name)
        return entry.nominal * to_si(entry.unit) if isinstance(entry, Inferred) else entry.value

    def search(self, name: str) -> tuple[Fraction, Fraction, str]:
        """The least and the greatest value of an entry, in SI, to search, and why these."""
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

    def function(self, claim: Claim, *, reading: str = "", centered: bool = False) -> Function:
        """A claim's computation as a function of an arithmetic and of the claim's entries by name.

        An entry that stands in several inputs is one variable.
        """
        computation = claim.computations[reading]
        settings: dict[str, Any] = {}
        if computation.by_row:
            settings["row"] = claim.row
        if computation.by_scheme:
            settings["centered"] = centered
        inputs = dict(claim.inputs)
        if "power" in inputs:  # an exponent stays exact
            settings["power"] = self.value(*inputs.pop("power"))
        compute = function_of(computation, self.sides, (*inputs, *settings))

        def of_entries(ar: Arithmetic, **entries: Number) -> Number | Fraction:
            value = entries.__getitem__
            known = {key: reduce(mul, map(value, names)) for key, names in inputs.items()}
            return compute(ar, **known, **settings)

        return of_entries

    # Copies with a misprint

    def misprint(self, name: str, text: str) -> "Ledger":
        """A copy with other text in the place of a claim's or an equation's.

        The claims that it does not touch stay the same objects. Raises ValueError if a claim's text
        is no number, KeyError for an unknown name.
        """
        if self.equation_of(name) != name:
            parse(text)
        copy = replace(self, misprinted={**self.misprinted, name: text})
        # What no misprint changes is worked out once.
        for same in ("text", "sources", "equations", "written", "dimensions", "_claims", "_sides"):
            copy.__dict__[same] = getattr(self, same)
        return copy


def _is_chosen(claim: Claim, claims: Mapping[str, Claim]) -> bool:
    """Whether the author set the number, here or where this claim repeats it."""
    if claim.same_as:
        return _is_chosen(claims[claim.same_as], claims)
    return claim.given == "choice"


def _bound(claim: Claim, claims: Mapping[str, Claim]) -> Fraction | None:
    """The number that a claim compares with, its own or another claim's."""
    compared = claims[claim.against] if claim.against else claim
    return compared.printed.value if claim.relation and compared.printed else None


@cache
def load() -> Ledger:
    """The report's ledger.

    >>> ledger = load()
    >>> claim = ledger.claims["depth-beta-5"]
    >>> claim.text, str(claim.interval()), claim.unit
    ('7.67', '[7.665, 7.675)', 'um')
    """
    ledger: Ledger = tables("ledger.toml", Ledger)
    return ledger


def tables(file: str, kind: Any) -> Any:
    """A file of `reference/report` as structs; msgspec.ValidationError where it does not fit."""
    document = tomllib.loads(_file(file))
    return msgspec.convert(document, kind, dec_hook=lambda kind, value: kind(value))


def _file(name: str) -> str:
    return (resources.files("reference") / "report" / name).read_text("utf-8")


def claims_of_case(beta: int) -> dict[str, str]:
    """The claims that print the inputs of the report's case with this beta.

    >>> claims_of_case(5)["beta"]
    'depth-beta-5-beta'
    """
    # The target density is printed nowhere: the audit infers what Table A-1 admits.
    strength = {"beta": f"depth-beta-{beta}-beta", "flow_stress": "flow-stress"}
    return {**load().groups["impact"], **strength}
