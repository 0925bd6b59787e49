"""Possible explanations of a number that does not follow from the report.

Other inputs and misprints are tried, and those that would give the number are listed (`slips` tries
slips of the author's). The audit asserts none of them.
"""

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from fractions import Fraction
from functools import cache, cached_property, partial
from itertools import pairwise, product
from string import digits

from reference.derivations import derived_from, premises_of
from reference.enclosure import SolutionSet, find_solutions
from reference.ledger import INFERRED, Claim, Ledger
from reference.printed import parse
from reference.units import to_si
from replication.audit.crosschecks import CROSS_CHECKS, compared_with
from replication.audit.ranking import forms_beside, rank
from replication.audit.record import BackSolved, Proof, Repair
from replication.audit.verdict import (
    Judge,
    Replacements,
    comes_out,
    disagreeing,
    follows,
    is_contradicted,
)


def dependents(ledger: Ledger, name: str) -> set[str]:
    """Return the claims whose verdicts may change with a claim or an equation, itself included.

    A claim that rests on an inferred input depends on the evidence for that input, and on all that
    the evidence rests on. An input that other claims confirm depends on those claims, and a number
    that is compared with others depends on them.
    """
    within = ledger.equation_of(name)
    direct = {
        claim.id
        for claim in ledger.claims.values()
        if name in (claim.id, *claim.input_ids) or within in claim.uses
    }
    changed = {name}
    for key, inferred in ledger.inferred.items():
        if direct & set(inferred.evidence):
            unknown = INFERRED + key
            changed.add(unknown)
            direct |= {c.id for c in ledger.claims.values() if unknown in c.input_ids}
    direct |= {claim for claim in CROSS_CHECKS if not changed.isdisjoint(compared_with(claim))}
    return direct | {c.id for c in ledger.claims.values() if direct & set(c.shown_by)}


# Explanations


class Explainer:
    """Finds possible explanations for the failing claims of one ledger."""

    def __init__(self, judge: Judge) -> None:
        self.judge, self.ledger = judge, judge.ledger
        self._repairs_by = cache(self._edited)  # several failing claims try the same edits
        self._forms = cache(partial(forms_beside, judge.ledger))

    @cached_property
    def _alternatives(self) -> list[Replacements]:
        """The values of the inferred inputs to try: the nominal and the assumed ones."""
        return [{}, self.judge.assumed] if self.judge.moved else [{}]

    # Single inputs

    def back_solved(self, claim: Claim) -> list[BackSolved]:
        """Return, for every reading and input, the values of this input that give the number."""
        ledger, records = self.ledger, []
        for reading, name in product(claim.computations, claim.input_ids):
            entry = ledger.claims.get(name)
            if entry is not None and entry.is_exact and not entry.quantity:
                continue
            solutions, unit = self.solutions(claim, reading, name), ledger.unit(name)
            proof = Proof.TO_AN_END if solutions.reaches_an_end else Proof.INSIDE
            if not solutions.inner:
                proof = Proof.UNDECIDED if solutions.outer else Proof.NONE
            si, spans = to_si(unit), (solutions.search, *solutions.inner)
            search, *intervals = [(float(low / si), float(high / si)) for low, high in spans]
            records.append(
                BackSolved(
                    reading=reading,
                    entry=name,
                    title=ledger.title(name),
                    unit=unit,
                    as_printed=float(self.judge.value(name) / si),
                    intervals=intervals,
                    search=search,
                    search_reason=ledger.search(name)[2],
                    proof=proof,
                )
            )
        return records

    def solutions(self, claim: Claim, reading: str, name: str) -> SolutionSet:
        """Return the values (SI) of an entry, the others as printed, for which a reading agrees."""
        others = {entry: self.judge.value(entry) for entry in claim.input_ids if entry != name}
        function = self.ledger.function(claim, reading=reading)
        low, high, _ = self.ledger.search(name)
        budget = SHEET_BUDGET if claim.by_whole_sheet else _BUDGET
        return find_solutions(function, name, (low, high), claim.target(), budget, others)

    # Misprints

    def repairs(self, name: str) -> list[Repair]:
        """Return the one-edit corrections that make a claim or an equation agree, likeliest first.

        `replication.audit.ranking` says which are likelier. A constant is repaired together with
        its equation.
        """
        name = self.ledger.equation_of(name) or name
        return self._repairs(name, self._suspects(name))

    def _repairs(self, name: str, entries: Iterable[str]) -> list[Repair]:
        """Return the edits of these entries that make a claim agree, likeliest first."""
        kinds = (*NUMBER_EDITS, *EQUATION_EDITS)
        repairs = [repair for entry in entries for repair in self._repairs_by(name, entry)]
        repairs.sort(key=lambda r: rank(self.ledger, r, self._forms(r.entry), kinds, name))
        return repairs[:_SHOWN]

    def _edited(self, name: str, entry: str) -> list[Repair]:
        repairs = []
        for text, kind in edits_of(self.ledger, entry):
            changed = self.ledger.misprint(entry, text)
            if (reading := self._agreeing(name, entry, changed)) is not None:
                repairs.append(
                    Repair(
                        entry=entry,
                        title=self.ledger.title(entry),
                        reading=reading,
                        original=self.ledger.printed_text(entry),
                        text=text,
                        kind=kind,
                        failing=sorted(self._failing(entry, changed)),
                    )
                )
        return repairs

    def _suspects(self, name: str) -> set[str]:
        """Return what may be misprinted: it, its inputs, its equations and their constants.

        A number that is compared with others may fail by a misprint in one of these.
        """
        ledger = self.ledger
        if name in ledger.equations:
            suspects = equations = {name, *premises_of(name)}
        else:
            claim = ledger.claims[name]
            equations = set(claim.uses)
            beside = {claim.within} if claim.within else set()
            compared = ledger.claims.keys() & compared_with(name)
            suspects = {name, *claim.stated} | beside | equations | compared
            for unknown in self.judge.moved.intersection(claim.input_ids):
                # Its evidence excludes the nominal value, so what that rests on may be misprinted.
                evidence = ledger.inferred[unknown.removeprefix(INFERRED)].evidence
                suspects |= {entry for piece in evidence for entry in ledger.claims[piece].stated}
        return suspects | {c for equation in equations for c in ledger.constants_of(equation)}

    def _agreeing(self, name: str, entry: str, changed: Ledger) -> str | None:
        """Return the first reading of a claim or equation that agrees once an entry is changed.

        A number without a computation agrees if the claims that confirm it do, and its sources, and
        the numbers that it is compared with.
        """
        within = changed.equation_of(name)
        if within is not None:
            return "" if follows(changed, within) else None
        claim = changed.claims[name]
        if claim.computation is not None:
            pairs = product(claim.computations, self._alternatives)
            return next((r for r, values in pairs if comes_out(changed, claim, values, r)), None)
        own = entry == name and self.judge.is_confirmed(claim, claim.value)
        related = own or entry in compared_with(name)
        return "" if related and not is_contradicted(changed, name) else None

    def _failing(self, entry: str, changed: Ledger) -> set[str]:
        """Return all claims and equations that fail once an entry is changed."""
        touched, within = dependents(self.ledger, entry), self.ledger.equation_of(entry)
        options = (disagreeing(changed, touched, values) for values in self._alternatives)
        failing = min(options, key=len)
        if within is not None:
            equations = derived_from(within)
            touched |= equations
            failing |= {name for name in equations if not follows(changed, name)}
        compared = touched.intersection(CROSS_CHECKS)
        failing |= {name for name in compared if is_contradicted(changed, name)}
        return (self._failing_now - touched) | failing

    @cached_property
    def _failing_now(self) -> set[str]:
        """All claims and equations that fail in the ledger as it is."""
        claims = disagreeing(self.ledger, self.ledger.claims, self.judge.assumed)
        claims |= {name for name in CROSS_CHECKS if is_contradicted(self.ledger, name)}
        return claims | {name for name in self.ledger.equations if not follows(self.ledger, name)}

    # One misprint behind several failures

    def ranked(self, names: Collection[str]) -> list[Repair]:
        """Return the repairs that may explain several failures at once, likeliest first.

        A misprint behind all of them is in an entry that all depend on, so only such entries are
        tried. If these give no repair, those of the claim that is quickest to compute are returned.
        An input that fails only because the claims computed from it do is left out.
        """
        claims = self.ledger.claims
        confirmed = {c.id for c in claims.values() if c.computation is None and c.shown_by}
        names = [name for name in names if name not in confirmed]
        if not names:
            return []
        quickest = min(names, key=self._cost)
        repairs = self._repairs(quickest, set.intersection(*map(self._suspects, names)))
        return repairs if repairs or len(names) == 1 else self.ranked([quickest])

    def _cost(self, name: str) -> tuple[int, str]:
        """Return a key that sorts claims by the time to compute them, whole sheets last."""
        claim = self.ledger.claims.get(name)
        if claim is None or not claim.is_computed:
            return 2 if self.ledger.equation_of(name) else 0, name
        return 1 + 2 * claim.by_scheme + claim.by_whole_sheet, name

    def culprit(self, names: Collection[str]) -> Repair | None:
        """Return the one repair with which nothing fails, if several claims fail now."""
        repairs = self.ranked(names) if len(names) > 1 else []
        return repairs[0] if repairs and not repairs[0].failing else None


_BUDGET = 250
"""The most parts of a search; some 200 are needed for k_t, as the depth hardly depends on it."""

SHEET_BUDGET = 25
"""The most parts for whole sheets: one takes 10 ms, or 100 ms if the particle stops late."""

_SHOWN = 20
"""The most repairs that are listed for one claim."""


# Texts that differ from a printed number or equation by one typing error

EQUATION_EDITS = (
    "number dropped", "symbol changed", "sign changed", "function changed", "fraction turned over",
)  # fmt: skip
"""The kinds of edits of an equation. The numbers in it are claims, which have their own edits."""

_ODD = re.compile(r"~?\s*(?:0\d|\.)|.*\.(?!\d)")
_EXPONENT = re.compile(r"(?P<lead>[Ee]|10\^\{?)(?P<number>[-+]?\d+)")


def edits_of(ledger: Ledger, name: str) -> Iterator[tuple[str, str]]:
    """Yield every text one edit away from that of a claim or an equation, with the kind of edit."""
    if name in ledger.equations:
        yield from equation_edits(ledger, name)
    elif ledger.claims[name].printed is not None:
        yield from edits(ledger.claims[name].text)


def edits(text: str) -> Iterator[tuple[str, str]]:
    """Yield every text one edit away that is another number, with the kind of edit; none twice.

    The base of a power of ten is not edited. No text begins with a zero before a digit, and none
    begins or ends with the decimal point: a printer sees that something is missing there.

    >>> [text for text, kind in edits("0.278") if kind in ("digits swapped", "digit doubled")]
    ['2.078', '0.728', '0.287', '0.2278', '0.2778', '0.2788']
    >>> [text for text, kind in edits("3E+08") if kind == "exponent changed"]
    ['3E+07', '3E+09', '3E-08']
    """
    seen, original = {text}, _number_and_digits(text)
    for kind, edit in _EDITS.items():
        for edited in edit(text):
            if edited in seen or _ODD.match(edited):
                continue
            seen.add(edited)
            if _number_and_digits(edited) not in (None, original):
                yield edited, kind


def _number_and_digits(text: str) -> tuple[Fraction, tuple[Fraction, ...]] | None:
    """Return a text's value and the units its last digit may have; None if it is no number."""
    try:
        printed = parse(text)
    except ValueError:
        return None
    return printed.value, printed.quanta


def _digit_positions(text: str) -> list[int]:
    """Return the positions of the mantissa's digits; `_shifted` edits the exponents."""
    power = _EXPONENT.search(text)
    return [k for k, c in enumerate(text) if c.isdigit() and (power is None or k < power.start())]


def _swapped(text: str) -> Iterator[str]:
    for first, second in pairwise(_digit_positions(text)):
        between = text[first + 1 : second]
        if between in ("", "."):
            yield text[:first] + text[second] + between + text[first] + text[second + 1 :]


def _shifted(text: str) -> Iterator[str]:
    """Yield the text with its exponent decreased or increased by one, or negated."""
    for match in _EXPONENT.finditer(text):
        number = match["number"]
        plus = "+" if match["lead"] in "Ee" and number[0] in "+-" else ""
        for exponent in (int(number) - 1, int(number) + 1, -int(number)):
            width = len(number.lstrip("+-")) + (exponent < 0 or plus == "+")
            edited = f"{exponent:{plus}0{width}d}"
            yield text[: match.start("number")] + edited + text[match.end("number") :]


_WORDS = ("one two three four five", "third half", "one-sixth one-fifth", "twice thrice")


def _number_words(text: str) -> Iterator[str]:
    """Yield the words that may be mistaken for a number word."""
    for words in map(str.split, _WORDS):
        if text.lower() in words:
            yield from (word.capitalize() if text[0].isupper() else word for word in words)


def _replaced(text: str, options: Callable[[str], Iterable[str]]) -> Iterator[str]:
    """Yield the text with one digit of the mantissa replaced by each of its options."""
    for k in _digit_positions(text):
        for option in options(text[k]):
            yield text[:k] + option + text[k + 1 :]


_EDITS: Mapping[str, Callable[[str], Iterable[str]]] = {
    "digit dropped": lambda text: _replaced(text, lambda _: [""]),
    "digits swapped": _swapped,
    "decimal point moved": lambda text: (
        re.sub(r"(?<=.)(\d)\.", r".\1", text), re.sub(r"\.(\d)", r"\1.", text),
    ),
    "exponent changed": _shifted,
    "other word": _number_words,
    "digit doubled": lambda text: _replaced(text, lambda old: [old + old]),
    "digit changed": lambda text: _replaced(text, lambda _: digits),
    "digit inserted": lambda text: _replaced(
        text, lambda old: [new + old for new in digits] + [old + new for new in digits]
    ),
}  # fmt: skip
NUMBER_EDITS = tuple(_EDITS)
"""The kinds of edits of a number, those with few texts first: these seldom fit by chance."""


def equation_edits(ledger: Ledger, name: str) -> Iterator[tuple[str, str]]:
    r"""Yield every equation one edit away, with the kind of edit.

    A symbol is replaced only by others of the same dimension.

    >>> from reference.ledger import load
    >>> [text for text, kind in equation_edits(load(), "diameter") if kind == "number dropped"]
    ['D = R']
    """
    text, written, dimensions = ledger.printed_text(name), ledger.written, ledger.dimensions
    edits = {text: ""}
    symbols = "|".join(re.escape(symbol) for symbol in sorted(written, key=len, reverse=True))
    tokens = re.compile(
        rf"(?P<function>\\(?:frac|quad|ln|log))|(?P<symbol>{symbols})|(?P<number>\d+)|(?P<sign>[-+])"
    )
    for match in tokens.finditer(text):
        token, kind, replacements = match[0], f"{match.lastgroup} changed", list[str]()
        if token.isdecimal():
            kind, replacements = "number dropped", [""]
        elif token in _OPPOSITE:
            replacements = [_OPPOSITE[token]]
        elif symbol := written.get(token):
            replacements = [
                spelling
                for spelling, name in written.items()
                if name != symbol and dimensions[name] == dimensions[symbol]
            ]
        for replacement in replacements:
            edits.setdefault(text[: match.start()] + replacement + text[match.end() :], kind)
    for match in re.finditer(r"([^\s(){}^=+/]+)/([^\s(){}^=+/]+)", text):
        turned = text[: match.start()] + f"{match[2]}/{match[1]}" + text[match.end() :]
        edits.setdefault(turned, "fraction turned over")
    return ((edited, kind) for edited, kind in edits.items() if kind)


_OPPOSITE = {"+": "-", "-": "+", r"\ln": r"\log", r"\log": r"\ln"}
