"""What would explain a number that does not follow: nothing here is asserted, all is tried."""

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from fractions import Fraction
from functools import cache, cached_property
from itertools import pairwise, product
from string import digits

from reference.arithmetic import Floats
from reference.enclosure import Solutions, enclose, solve
from reference.ledger import INFERRED, Claim, Convention, Ledger
from reference.printed import parse
from reference.units import to_si
from replication.audit.record import BackSolvedRecord, Proof, RepairRecord, Shown, SlipRecord
from replication.audit.verdict import Judge, follows, restates

# A quick look

_CLOSE = Fraction(1, 10**9)
"""How near a double must come to an exact number, such as 2/3; relative."""


Values = Mapping[str, Fraction]
"""Other values of some entries than printed, in SI."""


def agrees(ledger: Ledger, claim: Claim, changed: Values, reading: str = "") -> bool:
    """Whether a claim with a computation agrees, some entries changed."""
    if claim.computations[reading].restates:
        return restates(ledger, claim)
    target, inputs = claim.target(), {}
    for name in claim.entries:
        inputs[name] = float(changed[name] if name in changed else ledger.value(name))
    try:
        value = Fraction(ledger.function(claim, reading=reading)(Floats(), **inputs))
    except (ArithmeticError, ValueError, TypeError):
        return False  # in doubles these inputs have no result, or only a complex one
    if target.is_point and target.lower is not None:
        return abs(value - target.lower) <= _CLOSE * abs(target.lower)
    return target.contains(value)


def disagreeing(ledger: Ledger, names: Iterable[str], changed: Values) -> set[str]:
    """Those of the claims that do not agree, some entries changed."""
    claims = (ledger.claims[name] for name in names)
    return {c.id for c in claims if c.computation is not None and not agrees(ledger, c, changed)}


def dependents(ledger: Ledger, name: str) -> set[str]:
    """The claims whose verdict may change with an entry or an equation, itself among them.

    A claim that rests on an inferred input also depends on the evidence for it, and on all that
    this rests on; an input that other claims confirm depends on them.
    """
    within = ledger.equation_of(name)
    direct = {
        claim.id
        for claim in ledger.claims.values()
        if name in (claim.id, claim.against, *claim.entries) or within in claim.uses
    }
    for key, inferred in ledger.inferred.items():
        if direct & set(inferred.evidence):
            unknown = INFERRED + key
            direct |= {c.id for c in ledger.claims.values() if unknown in c.entries}
    return direct | {c.id for c in ledger.claims.values() if direct & set(c.shown_by)}


# Explanations


class Explainer:
    """Explanations for the failing claims of one ledger."""

    def __init__(self, judge: Judge) -> None:
        self.judge, self.ledger = judge, judge.ledger
        self._repairs_by = cache(self._edited)  # a culprit is looked for among the same edits

    @cached_property
    def _taken(self) -> list[Values]:
        """The values of the inferred inputs: as the ledger has them, and as assumed."""
        return [{}, self.judge.assumed] if self.judge.moved else [{}]

    # Single inputs

    def back_solved(self, claim: Claim) -> list[BackSolvedRecord]:
        """For every reading of a claim, the values of each entry alone with which it agrees."""
        ledger, records = self.ledger, []
        for reading, name in product(claim.computations, claim.entries):
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
                BackSolvedRecord(
                    reading=reading,
                    entry=name,
                    title=ledger.title(name),
                    unit=unit,
                    printed=float(self.judge.value(name) / si),
                    intervals=intervals,
                    search=search,
                    search_reason=ledger.search(name)[2],
                    proof=proof,
                )
            )
        return records

    def solutions(self, claim: Claim, reading: str, name: str) -> Solutions:
        """The values of an entry (SI), the others as printed, with which a reading agrees."""
        others = {entry: self.judge.value(entry) for entry in claim.entries if entry != name}
        function = self.ledger.function(claim, reading=reading)
        low, high, _ = self.ledger.search(name)
        budget = SHEET_BUDGET if claim.by_whole_sheet else _BUDGET
        return solve(function, name, (low, high), claim.target(), budget, others)

    def shown(self, chosen: Claim) -> Shown | None:
        """The values around a chosen number for which the claims that confirm it agree.

        Where they begin to disagree is found by bisection, in doubles. None if no claim confirms
        the number, or if one disagrees with the number itself.
        """
        if not chosen.shown_by or not self._is_shown(chosen, chosen.value):
            return None
        ends = []
        for far in self.ledger.search(chosen.id)[:2]:
            good, bad = chosen.value, far
            for _ in range(_BISECTIONS):
                middle = (good + bad) / 2
                good, bad = (middle, bad) if self._is_shown(chosen, middle) else (good, middle)
            ends.append(float(good / chosen.si))
        return Shown(claims=list(chosen.shown_by), interval=(ends[0], ends[1]), unit=chosen.unit)

    def _is_shown(self, chosen: Claim, value: Fraction) -> bool:
        """Whether all claims that confirm a number agree with this value of it (SI)."""
        ledger, changed = self.ledger, {**self.judge.assumed, chosen.id: value}
        return all(agrees(ledger, ledger.claims[name], changed) for name in chosen.shown_by)

    # Misprints

    def repairs(self, name: str) -> list[RepairRecord]:
        """Texts one edit away with which a claim or an equation agrees; the likeliest first.

        A repair with which fewer claims fail comes before one with which more do; of equal ones the
        likelier typing error comes first. A constant is repaired together with its equation.
        """
        name = self.ledger.equation_of(name) or name
        return self._repairs(name, self._suspects(name))

    def _repairs(self, name: str, entries: Iterable[str]) -> list[RepairRecord]:
        """The edits of these entries that make a claim or an equation agree, best first."""
        kinds = (*NUMBER_EDITS, *EQUATION_EDITS)
        repairs = [repair for entry in entries for repair in self._repairs_by(name, entry)]
        repairs.sort(key=lambda r: (
            r.reading, len(r.failing), r.entry != name, kinds.index(r.kind), r.entry, r.text,
        ))  # fmt: skip
        return repairs[:_SHOWN]

    def _edited(self, name: str, entry: str) -> list[RepairRecord]:
        repairs = []
        for text, kind in edits_of(self.ledger, entry):
            changed = self.ledger.misprint(entry, text)
            if (reading := self._agreeing(name, entry, changed)) is not None:
                repairs.append(
                    RepairRecord(
                        entry=entry,
                        title=self.ledger.title(entry),
                        reading=reading,
                        printed=self.ledger.printed_text(entry),
                        text=text,
                        kind=kind,
                        failing=sorted(self._failing(entry, changed)),
                    )
                )
        return repairs

    def _suspects(self, name: str) -> set[str]:
        """Where a misprint may be: in it, in its entries, in its equations and their constants."""
        ledger = self.ledger
        if name in ledger.equations:
            premises = ledger.equations[name].premises.values()
            suspects = equations = {name, *(premise.equation for premise in premises)}
        else:
            claim = ledger.claims[name]
            equations = set(claim.uses)
            beside = {key for key in (claim.against, claim.within) if key}
            suspects = {name, *claim.stated} | beside | equations
            for unknown in self.judge.moved.intersection(claim.entries):
                # Its evidence does not admit the nominal value: what it rests on may be misprinted.
                evidence = ledger.inferred[unknown.removeprefix(INFERRED)].evidence
                suspects |= {entry for piece in evidence for entry in ledger.claims[piece].stated}
        return suspects | {c for e in equations for c in ledger.constants_of(e)}

    def _agreeing(self, name: str, entry: str, changed: Ledger) -> str | None:
        """The first reading of a claim or equation that agrees in a ledger with a changed entry.

        A number that nothing computes has to agree with its sources and with what confirms it.
        """
        within = changed.equation_of(name)
        if within is not None:
            return "" if follows(changed, within) else None
        claim, sources = changed.claims[name], changed.sources_of(name)
        if claim.computation is not None:
            pairs = product(claim.computations, self._taken)
            return next((r for r, taken in pairs if agrees(changed, claim, taken, r)), None)
        if entry != name or not self._is_shown(claim, claim.value):
            return None
        sourced = not sources or any(claim.target().meets(s.interval) for s in sources)
        return "" if sourced else None

    def _failing(self, entry: str, changed: Ledger) -> set[str]:
        """All claims and equations that fail with the edit, also those that it does not touch."""
        touched, within = dependents(self.ledger, entry), self.ledger.equation_of(entry)
        failing = min((disagreeing(changed, touched, taken) for taken in self._taken), key=len)
        if within is not None:
            touched.add(within)
            failing |= set() if follows(changed, within) else {within}
        return (self._failing_now - touched) | failing

    @cached_property
    def _failing_now(self) -> set[str]:
        claims = disagreeing(self.ledger, self.ledger.claims, self.judge.assumed)
        return claims | {name for name in self.ledger.equations if not follows(self.ledger, name)}

    # One culprit for all that fails

    def ranked(self, names: Collection[str]) -> list[RepairRecord]:
        """The repairs that may explain all that fails at once, the best first.

        If one misprint is behind several failures, it stands in an entry that all of them rest on:
        only such entries are searched, and the repairs are ordered as by `repairs`. If no entry is
        common to all, the repairs of the claim that is quickest to compute are given. An input that
        fails only because claims that rest on it do is left out: it says no more than they do.
        """
        claims = self.ledger.claims
        doubted = {c.id for c in claims.values() if c.computation is None and c.shown_by}
        names = [name for name in names if name not in doubted]
        if not names:
            return []
        quickest = min(names, key=self._cost)
        suspects = [self._suspects(name) for name in names]
        common = set.intersection(*suspects) or suspects[0]
        repairs = self._repairs(quickest, common & self._suspects(quickest))
        return repairs if repairs or len(names) == 1 else self.ranked([quickest])

    def _cost(self, name: str) -> tuple[int, str]:
        """What claims are sorted by: the quickest to compute first, whole sheets last."""
        claim = self.ledger.claims.get(name)
        if claim is None or claim.computation is None or claim.computation.restates:
            return 2 if self.ledger.equation_of(name) else 0, name
        return 1 + 2 * claim.by_scheme + claim.by_whole_sheet, name

    def culprit(self, names: Collection[str]) -> RepairRecord | None:
        """The one repair with which all these claims agree, if there is one."""
        repairs = self.ranked(names) if len(names) > 1 else []
        return repairs[0] if repairs and not repairs[0].failing else None

    # Slips

    def slips(self, claim: Claim) -> list[SlipRecord]:
        """The claim computed with each slip that the ledger knows of its equations."""
        target, rounded, records = claim.target(), Convention(choices_exact=False), []
        for slip in (slip for slip in self.ledger.slip if slip.equation in claim.uses):
            ledger = self.ledger
            if slip.text is not None:
                ledger = ledger.misprint(slip.equation, slip.text)
            inputs = {key: name for key, name in slip.inputs.items() if key in claim.inputs}
            changed = claim.resting_on(**inputs)
            function = ledger.function(changed)
            value, fits = None, ""
            with suppress(ArithmeticError):  # no value, or no bounded one, of misprinted inputs
                at_print = enclose(function, self.judge.printed(changed)).ends
                value, fits = float(at_print[0] / claim.si), "not excluded within rounding"
                if target.encloses(*at_print):
                    fits = "as printed"
                elif target.excludes(*enclose(function, self.judge.box(changed, rounded)).ends):
                    fits = ""
            records.append(SlipRecord(name=slip.name, reason=slip.reason, value=value, fits=fits))
        return records


_BISECTIONS = 40
"""They narrow the search to 1e-12 of its width, which is finer than any page shows."""

_BUDGET = 250
"""Most parts of a search: k_t, on which the depth hardly depends, takes some 200 of them."""

SHEET_BUDGET = 25
"""The same for whole sheets, each of which takes 10 ms, or 100 ms where it takes long to stop."""

_SHOWN = 20
"""So many repairs of one claim are kept, the likeliest first."""


# Texts that are one typing error away from a printed number or equation

EQUATION_EDITS = (
    "number dropped", "symbol changed", "sign changed", "function changed", "fraction turned over",
)  # fmt: skip
"""Kinds of edits of an equation. Its numbers are claims, which are edited as all other numbers."""

_LEADING_ZERO = re.compile(r"~?\s*0\d")
_EXPONENT = re.compile(r"(?P<lead>[Ee]|10\^\{?)(?P<number>[-+]?\d+)")


def edits_of(ledger: Ledger, name: str) -> Iterator[tuple[str, str]]:
    """Every text one edit away from a claim's or an equation's, with the kind of the edit."""
    if name in ledger.equations:
        yield from equation_edits(ledger, name)
    elif ledger.claims[name].printed is not None:
        yield from edits(ledger.claims[name].text)


def edits(text: str) -> Iterator[tuple[str, str]]:
    """Every text one edit of a number away that is another, with the edit's kind; none twice.

    The base of a power of ten is no digit, and no number begins with a zero before a digit.

    >>> [text for text, kind in edits("0.278") if kind in ("digits swapped", "digit doubled")]
    ['2.078', '0.728', '0.287', '0.2278', '0.2778', '0.2788']
    >>> [text for text, kind in edits("3E+08") if kind == "exponent changed"]
    ['3E+07', '3E+09', '3E-08']
    """
    seen, original = {text}, _number(text)
    for kind, edit in _EDITS.items():
        for edited in edit(text):
            if edited in seen or _LEADING_ZERO.match(edited):
                continue
            seen.add(edited)
            if _number(edited) not in (None, original):
                yield edited, kind


def _number(text: str) -> tuple[Fraction, tuple[Fraction, ...]] | None:
    """The value of a text and the places that its last digit may have, if it is a number."""
    try:
        printed = parse(text)
    except ValueError:
        return None
    return printed.value, printed.quanta


def _digits(text: str) -> list[int]:
    """Where the digits of the mantissa stand; exponents are edited by `_shifted`."""
    power = _EXPONENT.search(text)
    return [k for k, c in enumerate(text) if c.isdigit() and (power is None or k < power.start())]


def _swapped(text: str) -> Iterator[str]:
    for here, there in pairwise(_digits(text)):
        between = text[here + 1 : there]
        if between in ("", "."):
            yield text[:here] + text[there] + between + text[here] + text[there + 1 :]


def _shifted(text: str) -> Iterator[str]:
    """The exponent one less and one more, written as wide as it was, or its sign turned."""
    for match in _EXPONENT.finditer(text):
        number = match["number"]
        for exponent in (int(number) - 1, int(number) + 1, -int(number)):
            sign = "+" if match["lead"] in "Ee" and number[0] in "+-" and exponent >= 0 else ""
            width = len(number.lstrip("+-")) + len(sign or "-" * (exponent < 0))
            shown = f"{sign}{exponent:0{width - len(sign)}d}"
            yield text[: match.start("number")] + shown + text[match.end("number") :]


_WORDS = ("one two three four five", "third half", "one-sixth one-fifth", "twice thrice")


def _words(text: str) -> Iterator[str]:
    word = text.lower()
    others = (w for words in map(str.split, _WORDS) if word in words for w in words if w != word)
    return (word.capitalize() if text[0].isupper() else word for word in others)


_EDITS: Mapping[str, Callable[[str], Iterable[str]]] = {
    "digit dropped": lambda text: (text[:k] + text[k + 1 :] for k in _digits(text)),
    "digits swapped": _swapped,
    "decimal point moved": lambda text: (
        re.sub(r"(?<=.)(\d)\.", r".\1", text), re.sub(r"\.(\d)", r"\1.", text),
    ),
    "exponent changed": _shifted,
    "other word": _words,
    "digit doubled": lambda text: (text[:k] + text[k] + text[k:] for k in _digits(text)),
    "digit changed": lambda text: (
        text[:k] + digit + text[k + 1 :] for k in _digits(text) for digit in digits
    ),
    "digit inserted": lambda text: (
        text[:end] + digit + text[end:]
        for end in sorted({end for k in _digits(text) for end in (k, k + 1)})
        for digit in digits
    ),
}  # fmt: skip
NUMBER_EDITS = tuple(_EDITS)
"""Kinds of edits of a number. The fewer texts a kind has, the less likely one fits by chance."""


def equation_edits(ledger: Ledger, name: str) -> Iterator[tuple[str, str]]:
    r"""Every equation one edit away, with the kind of the edit.

    A symbol is mistaken for another of the same dimension.

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
                another
                for another, meant in written.items()
                if meant != symbol and dimensions[meant] == dimensions[symbol]
            ]
        for replacement in replacements:
            edits.setdefault(text[: match.start()] + replacement + text[match.end() :], kind)
    for match in re.finditer(r"([^\s(){}^=+/]+)/([^\s(){}^=+/]+)", text):
        turned = text[: match.start()] + f"{match[2]}/{match[1]}" + text[match.end() :]
        edits.setdefault(turned, "fraction turned over")
    return ((edited, kind) for edited, kind in edits.items() if kind)


_OPPOSITE = {"+": "-", "-": "+", r"\ln": r"\log", r"\log": r"\ln"}
