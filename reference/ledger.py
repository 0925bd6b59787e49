"""The ledger: every number that the report prints, loaded, placed in the text and checked.

Everything that can be wrong with an entry is an error when the ledger is loaded: an entry that the
report does not contain, a duplicate id, an unknown unit, text that is no number, a computation that
does not exist or whose units do not fit, inputs that are missing or that go round in a circle.
"""

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, partial
from graphlib import CycleError, TopologicalSorter
from importlib import resources
from typing import Any

from reference.computations import COMPUTATIONS, SAME, Computation
from reference.enclosure import Function
from reference.printed import Interval, Printed, Rounding, parse
from reference.units import UnitError, same_dimension, to_si

__all__ = ["KINDS", "Claim", "Inferred", "Ledger", "LedgerError", "Place", "load"]

KINDS = (
    "input",
    "result",
    "approximation",
    "order of magnitude",
    "bound",
    "comparison",
    "range",
    "quoted",
    "constant",
    "blank",
)
_INFERRED = "inferred:"


class LedgerError(ValueError):
    """Something in the ledger is wrong; the message names the entry and what would be right."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where a number stands: line and characters of the text, section, equation, table cell."""

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


@dataclass(frozen=True, slots=True)
class Claim:
    """One printed number, and what is claimed of it.

    `interval` holds the values, in `unit`, that agree with the claim (None for a blank cell);
    `inputs` names for each input of the computation the entries whose product it is; `given` is
    the reason why nothing in the report decides the number; `assumes` what its computation takes
    for granted; `like` the claim that it must print like.
    """

    id: str
    title: str
    text: str
    kind: str
    unit: str
    place: Place
    quote: str
    printed: Printed | None
    interval: Interval | None
    computation: Computation | None
    row: int | None
    inputs: Mapping[str, tuple[str, ...]]
    readings: Mapping[str, Computation]
    given: str | None
    chosen: bool
    relation: str | None
    as_printed_inputs: bool
    assumes: str | None = None
    like: str | None = None

    @property
    def functions(self) -> dict[str, Function]:
        """The computation as printed ("") and each other reading, of arithmetic and inputs."""
        if self.computation is None:
            return {}
        named = {"": self.computation, **self.readings}
        fixed = {} if self.row is None else {"row": self.row}
        return {name: partial(entry.function, **fixed) for name, entry in named.items()}

    @property
    def si(self) -> Fraction:
        """The factor from the claim's unit to SI."""
        return to_si(self.unit)

    @property
    def target(self) -> Interval:
        """The values, in SI, that agree with the claim, which is no blank cell."""
        assert self.interval is not None
        return self.interval.scaled(self.si)

    def as_input(self, loose: bool = False) -> Interval:
        """The values, in SI, that this number may stand for where another claim rests on it.

        What the author chose is what he printed; what is measured or computed is a rounding; an
        approximation has the fewest digits that its text allows. `loose` allows that of all.
        """
        assert self.printed is not None
        exact = self.interval is not None and self.interval.lower == self.interval.upper
        if exact or (self.chosen and not loose):
            return Interval.point(self.printed.value * self.si)
        about = loose or self.kind == "approximation"
        printed = self.printed.about() if about and self.printed.quantum else self._rounded()
        return printed.scaled(self.si)

    def reprinted(self, printed: Printed) -> Interval:
        """The values, in the claim's unit, that would agree with it if it were printed so.

        Of a claim without a relation, which is decided by more than its number.
        """
        if self.interval is not None and self.interval.lower == self.interval.upper:
            return Interval.point(printed.value)
        if self.kind == "approximation":
            return printed.about()
        return printed.interval(_rounding(self.place.cell))

    def _rounded(self) -> Interval:
        assert self.printed is not None
        return self.printed.interval(_rounding(self.place.cell))


@dataclass(frozen=True, slots=True)
class Inferred:
    """An input that the report does not print, to be inferred from the numbers that it does."""

    id: str
    title: str
    symbol: str
    unit: str
    nominal: Fraction
    nominal_source: str
    search: tuple[Fraction, Fraction]
    resolution: Fraction
    evidence: tuple[str, ...]
    header: tuple[str, ...]
    mass: str
    results: tuple[str, ...]
    handbook: Mapping[str, Printed]


@dataclass(frozen=True, slots=True, eq=False)
class Ledger:
    """All claims in the order of the report, the inferred inputs, and the report's text."""

    title: str
    author: str
    year: int
    text: str
    claims: Mapping[str, Claim]
    inferred: Mapping[str, Inferred]
    furniture: tuple[tuple[str, str], ...]

    def uncovered(self) -> list[tuple[int, str]]:
        """Digits and number words of the text that no claim and no furniture accounts for.

        Each as line number and the word; empty for a complete ledger.
        """
        spans = [(c.place.start, c.place.end) for c in self.claims.values()]
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


@cache
def load() -> Ledger:
    """The report's ledger.

    >>> ledger = load()
    >>> claim = ledger.claims["depth-beta-5"]
    >>> claim.text, str(claim.interval), claim.unit
    ('7.67', '[7.665, 7.675]', 'um')
    """
    folder = resources.files("reference.report")
    document = tomllib.loads((folder / "ledger.toml").read_text("utf-8"))
    return read(document, (folder / document["report"]["text"]).read_text("utf-8"))


def read(document: Mapping[str, Any], text: str) -> Ledger:
    """Build and check a ledger from its parsed TOML and the report's text."""
    inferred = {k: _inferred(k, v) for k, v in document.get("inferred", {}).items()}
    entries = [single for entry in document.get("claim", []) for single in _cells(entry)]
    if not entries:
        raise LedgerError("the ledger is empty: it has no [[claim]]")
    claims: dict[str, Claim] = {}
    for entry in entries:
        claim = _Reader(entry, document, text).claim()
        if claim.id in claims:
            raise LedgerError(f"claim {claim.id!r} stands in the ledger twice")
        claims[claim.id] = claim
    claims = {c.id: _against(c, e, claims) for c, e in zip(claims.values(), entries, strict=True)}
    ordered = dict(sorted(claims.items(), key=lambda item: _order(item[1])))
    _check_inputs(ordered, inferred)
    report = document["report"]
    furniture = tuple((f["pattern"], f["reason"]) for f in document.get("furniture", []))
    return Ledger(
        report["title"], report["author"], report["year"], text, ordered, inferred, furniture
    )


def _order(claim: Claim) -> tuple[bool, int, str]:
    """By place in the text; the table, which ends it, cell by cell."""
    cell = claim.place.cell
    return (True, int(cell[1:]), cell) if cell else (False, claim.place.start, claim.id)


def _line(text: str, position: int) -> int:
    return text.count("\n", 0, position) + 1


def _rounding(cell: str | None) -> Rounding:
    # Table A-1 was printed by a spreadsheet, whose rule is known; the text by a person.
    return Rounding.HALF_AWAY if cell else Rounding.NEAREST


def _cells(entry: Mapping[str, Any]) -> list[dict[str, Any]]:
    """A blank entry stands for every cell of its range; any other for itself."""
    if "cells" not in entry or "id" not in entry:
        return [dict(entry)]
    match = re.fullmatch(r"([A-F])(\d+):([A-F])(\d+)", entry["cells"])
    if match is None:
        raise LedgerError(f"claim {entry.get('id')!r}: {entry['cells']!r} is no range of cells")
    columns = range(ord(match[1]), ord(match[3]) + 1)
    if not columns or int(match[2]) > int(match[4]):
        raise LedgerError(f"claim {entry.get('id')!r}: the cells {entry['cells']} run backwards")
    addresses = [f"{chr(c)}{r}" for r in range(int(match[2]), int(match[4]) + 1) for c in columns]
    return [{**entry, "id": f"{entry['id']}-{cell}", "cell": cell} for cell in addresses]


_KEYS = {
    "id",
    "title",
    "quote",
    "unit",
    "kind",
    "computed_by",
    "rests_on",
    "given",
    "relation",
    "against",
    "prints_like",
    "exact",
    "row",
    "readings",
    "as_printed_inputs",
    "assumes",
    "equation",
    "cell",
    "cells",
}


class _Reader:
    """Reads one entry; every message names it."""

    def __init__(self, entry: Mapping[str, Any], document: Mapping[str, Any], text: str) -> None:
        self.entry, self.document, self.text = entry, document, text
        self.id = entry.get("id", "?")

    def error(self, message: str) -> LedgerError:
        return LedgerError(f"claim {self.id!r}: {message}")

    def claim(self) -> Claim:
        entry = self.entry
        missing = {"id", "title", "kind"} - set(entry)
        if missing:
            raise self.error(f"lacks {', '.join(sorted(missing))}")
        unknown = set(entry) - _KEYS
        if unknown:
            raise self.error(f"there is no key {min(unknown)!r}")
        if entry["kind"] in ("bound", "order of magnitude") and "relation" not in entry:
            raise self.error(f"kind {entry['kind']!r} needs a relation")
        if entry["kind"] not in KINDS:
            raise self.error(f"kind {entry['kind']!r} is none of {', '.join(KINDS)}")
        unit = entry.get("unit", "1")
        try:
            to_si(unit)
        except UnitError as error:
            raise self.error(str(error)) from error
        place, printed_text = self.place()
        printed = self.printed(printed_text)
        return Claim(
            id=self.id,
            title=entry["title"],
            text=printed_text,
            kind=entry["kind"],
            unit=unit,
            place=place,
            quote=entry.get("quote", ""),
            printed=printed,
            interval=None if printed is None else self.interval(printed, place),
            computation=self.computation(),
            row=entry.get("row"),
            inputs=self.inputs(),
            readings={k: self.named(v) for k, v in entry.get("readings", {}).items()},
            given=self.given(),
            chosen=entry.get("given") == "choice",
            relation=entry.get("relation"),
            as_printed_inputs=entry.get("as_printed_inputs", False),
            assumes=entry.get("assumes"),
        )

    def place(self) -> tuple[Place, str]:
        if self.entry["kind"] == "blank":
            start = self.text.rindex("Table A-1.")
            return self._at(start, start), ""
        quote = self.entry.get("quote", "")
        before, opened, rest = quote.partition("⟦")
        inside, closed, after = rest.partition("⟧")
        if not opened or not closed:
            raise self.error("its quote needs the printed text between ⟦ and ⟧")
        words = before + inside + after
        found = self.text.count(words)
        if found != 1:
            raise self.error(f"the report has {words!r} {found} times, not once")
        start = self.text.index(words) + len(before)
        return self._at(start, start + len(inside)), inside

    def _at(self, start: int, end: int) -> Place:
        headings = list(_HEADING.finditer(self.text, 0, start + 1))
        heading = headings[-1] if headings else None
        section = _section(heading)
        equation, cell = self.entry.get("equation"), self.entry.get("cell")
        line = _line(self.text, start)
        return Place(start, end, line, section, equation, cell)

    def printed(self, text: str) -> Printed | None:
        if self.entry["kind"] in ("blank", "comparison"):
            return None
        try:
            return parse(text)
        except ValueError as error:
            raise self.error(str(error)) from error

    def interval(self, printed: Printed, place: Place) -> Interval:
        if relation := self.entry.get("relation"):
            return self.related(relation, printed.value)
        if self.entry["kind"] == "constant" or self.entry.get("exact"):
            return Interval.point(printed.value)
        if self.entry["kind"] == "approximation":
            return printed.about()
        return printed.interval(_rounding(place.cell))

    def related(self, relation: str, value: Fraction) -> Interval:
        match relation:
            case ">" | ">=":
                return Interval(value, None, relation == ">=", False)
            case "<" | "<=":
                return Interval(None, value, False, relation == "<=")
        raise self.error(f"relation {relation!r} is none of <, <=, >, >=")

    def computation(self) -> Computation | None:
        name = self.entry.get("computed_by")
        return None if name is None else self.named(name)

    def named(self, name: str) -> Computation:
        if name not in COMPUTATIONS:
            raise self.error(f"there is no computation {name!r}")
        return COMPUTATIONS[name]

    def inputs(self) -> dict[str, tuple[str, ...]]:
        rests_on = dict(self.entry.get("rests_on", {}))
        group = rests_on.pop("group", None)
        groups = self.document.get("groups", {})
        if group is not None and group not in groups:
            raise self.error(f"there is no group {group!r}")
        merged = {**groups.get(group, {}), **rests_on}
        return {name: tuple(value.split(" * ")) for name, value in merged.items()}

    def given(self) -> str | None:
        key = self.entry.get("given")
        decided = self.entry.get("computed_by") is not None or self.entry["kind"] == "blank"
        if decided == (key is not None):
            raise self.error("needs either computed_by or given")
        if "computed_by" not in self.entry and "rests_on" in self.entry:
            raise self.error("rests_on needs computed_by")
        reasons: Mapping[str, str] = self.document.get("reasons", {})
        if key is not None and key not in reasons:
            raise self.error(f"there is no reason {key!r}")
        return None if key is None else reasons[key]


_HEADING = re.compile(r"^ ?(?:\d+\. (?P<form>ABSTRACT)|(?P<n>\d)\. [A-Z]|Appendix\.)", re.MULTILINE)


def _section(heading: re.Match[str] | None) -> str:
    if heading is None:
        return "title"
    if heading["form"]:
        return "abstract"
    return f"section {heading['n']}" if heading["n"] else "appendix"


def _against(claim: Claim, entry: Mapping[str, Any], claims: Mapping[str, Claim]) -> Claim:
    """A comparison's interval comes from the claim that it compares with."""
    if claim.kind != "comparison":
        return claim
    reader = _Reader(entry, {}, "")
    name = entry.get("against", entry.get("prints_like", ""))
    if name not in claims or (other := claims[name]).printed is None:
        raise reader.error("a comparison needs `against` or `prints_like`, another claim")
    if claim.unit != other.unit:
        raise reader.error(f"is in {claim.unit}, but {name} in {other.unit}")
    if "against" in entry:
        return replace(
            claim, interval=reader.related(entry.get("relation", ""), other.printed.value)
        )
    return replace(claim, interval=other.interval, like=name)


def _check_inputs(claims: Mapping[str, Claim], inferred: Mapping[str, Inferred]) -> None:
    for entry in inferred.values():
        for name in (*entry.evidence, *entry.header, entry.mass, *entry.results):
            if name not in claims:
                raise LedgerError(f"inferred {entry.id!r}: there is no claim {name!r}")
    for claim in claims.values():
        if claim.computation is not None:
            for computation in (claim.computation, *claim.readings.values()):
                _check_units(claim, computation, claims, inferred)
    order = {c.id: [n for names in c.inputs.values() for n in names] for c in claims.values()}
    try:
        TopologicalSorter(order).prepare()
    except CycleError as error:
        raise LedgerError(f"claims rest on each other: {' on '.join(error.args[1])}") from error


def _check_units(
    claim: Claim,
    computation: Computation,
    claims: Mapping[str, Claim],
    inferred: Mapping[str, Inferred],
) -> None:
    def error(message: str) -> LedgerError:
        return LedgerError(f"claim {claim.id!r}, {computation.name}: {message}")

    if computation.by_row != (claim.row is not None):
        raise error("needs a row" if computation.by_row else "takes no row")
    expected = dict(computation.inputs)
    if computation.any_number:
        expected = dict.fromkeys(claim.inputs, computation.inputs["each"])
    if set(expected) != set(claim.inputs):
        raise error(f"needs inputs {sorted(expected)}, not {sorted(claim.inputs)}")
    shared: dict[str, str] = {}
    for name, unit in expected.items():
        found = "*".join(_unit_of(part, claims, inferred, error) for part in claim.inputs[name])
        if unit == SAME:
            unit = shared.setdefault(SAME, found)
        if not same_dimension(found, unit):
            raise error(f"input {name} is in {found}, which does not measure what {unit} does")
    result = shared.get(SAME, claim.unit) if computation.unit == SAME else computation.unit
    if not same_dimension(claim.unit, result):
        raise error(f"unit {claim.unit} does not measure what {result} does")


def _unit_of(
    name: str, claims: Mapping[str, Claim], inferred: Mapping[str, Inferred], error: Any
) -> str:
    if name.startswith(_INFERRED) and name.removeprefix(_INFERRED) in inferred:
        return inferred[name.removeprefix(_INFERRED)].unit
    if name not in claims or claims[name].printed is None:
        raise error(f"there is no number {name!r} to rest on")
    unit = claims[name].unit
    return "dimensionless" if unit == "1" else unit


def _inferred(name: str, entry: Mapping[str, Any]) -> Inferred:
    low, high = (Fraction(end) for end in entry["search"])
    return Inferred(
        id=name,
        title=entry["title"],
        symbol=entry["symbol"],
        unit=entry["unit"],
        nominal=Fraction(entry["nominal"]),
        nominal_source=entry["nominal_source"],
        search=(low, high),
        resolution=Fraction(entry["resolution"]),
        evidence=tuple(entry["evidence"]),
        header=tuple(entry["header"]),
        mass=entry["mass"],
        results=tuple(entry["results"]),
        handbook={item["name"]: parse(item["value"]) for item in entry["handbook"]},
    )
