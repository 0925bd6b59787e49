"""What would explain a number that does not follow: nothing here is asserted, all is tried."""

from collections.abc import Collection, Iterable, Iterator, Mapping
from fractions import Fraction
from functools import cache, cached_property

from reference.arithmetic import Floats
from reference.enclosure import Solutions, enclose, holding, solve
from reference.ledger import INFERRED, Claim, Convention, Function, Ledger
from reference.printed import Interval, parse
from reference.units import to_si
from replication.audit.edits import EQUATION_EDITS, NUMBER_EDITS, edits_of
from replication.audit.record import (
    BackSolvedRecord,
    CulpritRecord,
    RepairRecord,
    Shown,
    SlipRecord,
)
from replication.audit.verdict import Judge, follows, restates

# A quick look

_FLOATS = Floats()
_CLOSE = Fraction(1, 10**9)
"""How near to exact text, such as 2/3, a double must come."""


class Screen:
    """Which claims of a ledger agree, its inferred inputs at given values (SI)."""

    def __init__(self, ledger: Ledger, assumed: Mapping[str, Fraction]) -> None:
        self.ledger, self.assumed = ledger, assumed
        self._prepared = cache(self._prepare)

    def agrees(
        self, claim: Claim, reading: str = "", changed: Mapping[str, Fraction] | None = None
    ) -> bool:
        """Whether a claim with a computation agrees, with some entries changed (SI)."""
        if claim.computations[reading].restates:
            return restates(self.ledger, claim, changed or {})
        function, values, target = self._prepared(claim, reading)
        if changed:
            values = {name: float(changed.get(name, value)) for name, value in values.items()}
        try:
            value = Fraction(function(_FLOATS, **values))
        except (ArithmeticError, ValueError, TypeError):
            return False  # no such input has a result, or only a complex one
        if target.is_point and target.lower is not None:
            return abs(value - target.lower) <= _CLOSE * abs(target.lower)
        return target.contains(value)

    def _prepare(self, claim: Claim, reading: str) -> tuple[Function, dict[str, float], Interval]:
        """What an agreement takes that no change of an entry changes."""
        known = self.assumed
        values = {
            name: float(known[name] if name in known else self.ledger.value(name))
            for name in claim.entries
        }
        return self.ledger.function(claim, reading=reading), values, claim.target()

    def failing(self, names: Iterable[str]) -> set[str]:
        """Those of the claims that do not agree."""
        claims = (self.ledger.claims[name] for name in names)
        return {c.id for c in claims if c.computation is not None and not self.agrees(c)}


def dependents(ledger: Ledger, name: str) -> set[str]:
    """The claims whose verdict may change with an entry or an equation, itself among them.

    Claims that depend on an inferred input depend on its evidence, and on all that this rests on;
    an input that others show to be right depends on them.
    """
    within = ledger.claims[name].within if name in ledger.claims else name
    direct = {
        claim.id
        for claim in ledger.claims.values()
        if claim.id == name
        or name in claim.entries
        or claim.against == name
        or within in claim.uses
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
        self.solutions = cache(self._solutions)
        self._repairs_by = cache(lambda name, entry: list(self._repairs(name, entry)))
        self.slips = cache(lambda claim: list(self._slips(claim)))

    def _screens(self, ledger: Ledger) -> list[Screen]:
        """Quick looks at a ledger, inferred inputs as assumed, or as the ledger takes them."""
        nominal = {name: self.ledger.value(name) for name in self.judge.assumed}
        each = [nominal, self.judge.assumed] if self.judge.moved else [self.judge.assumed]
        return [Screen(ledger, assumed) for assumed in each]

    @cached_property
    def _as_printed(self) -> list[Screen]:
        return self._screens(self.ledger)

    @property
    def screen(self) -> Screen:
        """A quick look at the ledger as it stands."""
        return self._as_printed[-1]

    # Single inputs

    def back_solved(self, claim: Claim) -> list[BackSolvedRecord]:
        """For every reading of a claim, the values of each entry alone with which it agrees."""
        return [
            self._back_solved(claim, reading, name)
            for reading in claim.computations
            for name in claim.entries
            if name.startswith(INFERRED) or self._may_vary(self.ledger.claims[name])
        ]

    @staticmethod
    def _may_vary(claim: Claim) -> bool:
        return not claim.is_exact or claim.quantity is not None

    def _back_solved(self, claim: Claim, reading: str, name: str) -> BackSolvedRecord:
        unit, solutions = self.ledger.unit(name), self.solutions(claim, reading, name)
        proof = "proven inside, and none beyond"
        if not solutions.outer:
            proof = "proven: none in the range does"
        elif not solutions.inner:
            proof = "undecided"
        elif solutions.reaches_an_end:
            proof = "proven, up to an end of the range"
        alike = False
        if not name.startswith(INFERRED):
            own = self.ledger.claims[name].as_input(Convention(choices_exact=False))
            alike = any(not own.excludes(*part) for part in solutions.inner)
        si = to_si(unit)
        intervals, (search,) = (
            [(float(low / si), float(high / si)) for low, high in parts]
            for parts in (solutions.inner, [solutions.search])
        )
        return BackSolvedRecord(
            reading=reading,
            entry=name,
            title=self.ledger.title(name),
            unit=unit,
            printed=float(self.judge.value(name) / si),
            intervals=intervals,
            search=search,
            search_reason=self.ledger.search(name)[2],
            proof=proof,
            prints_alike=alike,
        )

    def _solutions(self, claim: Claim, reading: str, name: str) -> Solutions:
        """The values of an entry (SI), the others as printed, with which a reading agrees."""
        others = {entry: self.judge.value(entry) for entry in claim.entries if entry != name}
        function = holding(self.ledger.function(claim, reading=reading), others)
        low, high, _ = self.ledger.search(name)
        return solve(function, name, (low, high), claim.target(), _BUDGET)

    def shown(self, chosen: Claim) -> Shown | None:
        """The values around a chosen number for which what it shows comes out as printed.

        Found by bisection, in doubles: where those claims begin to disagree. None if the number
        shows nothing, or if they disagree with it itself.
        """
        claims = [self.ledger.claims[name] for name in chosen.shown_by]

        def suits(value: Fraction) -> bool:
            return all(self.screen.agrees(claim, "", {chosen.id: value}) for claim in claims)

        if not claims or not suits(chosen.value):
            return None
        ends = []
        for far in self.ledger.search(chosen.id)[:2]:
            good, bad = chosen.value, far
            for _ in range(_BISECTIONS):
                middle = (good + bad) / 2
                good, bad = (middle, bad) if suits(middle) else (good, middle)
            ends.append(float(good / chosen.si))
        return Shown(claims=list(chosen.shown_by), interval=(ends[0], ends[1]), unit=chosen.unit)

    # Misprints

    def repairs(self, name: str) -> list[RepairRecord]:
        """Texts one edit away with which a claim or an equation agrees; the likeliest first.

        A repair that leaves fewer claims failing comes before one that puts others wrong; of equal
        ones the likelier slip of a typist comes first. A constant is mended with its equation.
        """
        name = (name in self.ledger.claims and self.ledger.claims[name].within) or name
        return self._sorted(name, self._suspects(name))

    def _sorted(self, name: str, entries: Iterable[str]) -> list[RepairRecord]:
        """The edits of some entries with which a claim or an equation agrees."""
        kinds = (*NUMBER_EDITS, *EQUATION_EDITS)
        return sorted(
            (repair for entry in entries for repair in self._repairs_by(name, entry)),
            key=lambda r: (
                r.reading, len(r.failing), r.entry != name, kinds.index(r.kind), r.entry, r.text,
            ),
        )[:_SHOWN]  # fmt: skip

    def _repairs(self, name: str, entry: str) -> Iterator[RepairRecord]:
        for text, kind in edits_of(self.ledger, entry):
            reading = self._mends(name, entry, text)
            if reading is not None:
                yield RepairRecord(
                    entry=entry,
                    title=self.ledger.title(entry),
                    reading=reading,
                    printed=self.ledger.printed_text(entry),
                    text=text,
                    kind=kind,
                    failing=sorted(self._failing(entry, text)),
                )

    def _suspects(self, name: str) -> list[str]:
        """The claim or equation itself, its entries, and what its equations hold."""
        if name in self.ledger.equations:
            premises = self.ledger.equations[name].premises.values()
            equations = dict.fromkeys([name, *(premise.equation for premise in premises)])
            return [*equations, *(c for e in equations for c in self.ledger.constants_of(e))]
        claim = self.ledger.claims[name]
        entries = claim.stated
        for unknown in (entry for entry in claim.entries if entry in self.judge.moved):
            # Its evidence has moved it: what the evidence rests on may be wrong.
            for evidence in self.ledger.inferred[unknown.removeprefix(INFERRED)].evidence:
                entries += [
                    e for e in self.ledger.claims[evidence].entries if e in self.ledger.claims
                ]
        against = [claim.against] if claim.against else []
        within = [claim.within] if claim.within else []
        constants = [c for e in claim.uses for c in self.ledger.constants_of(e)]
        return list(dict.fromkeys([name, *entries, *against, *within, *claim.uses, *constants]))

    def _mends(self, name: str, entry: str, text: str) -> str | None:
        """The reading of the claim or equation that agrees with the edit, None if none does."""
        within = name if name in self.ledger.equations else self.ledger.claims[name].within
        if within is not None:
            return "" if follows(self.ledger.misprint(entry, text), within) else None
        claim, screens, values = self.ledger.claims[name], self._as_printed, {}
        if claim.computation is None:
            return self._suits(claim, text) if entry == name else None
        of_equation = entry in self.ledger.equations or self.ledger.claims[entry].within
        if entry in (name, claim.against) or of_equation:
            changed = self.ledger.misprint(entry, text)
            claim, screens = changed.claims[name], self._screens(changed)
        else:
            values[entry] = parse(text).value * self.ledger.claims[entry].si
        agreeing = (r for r in claim.computations for s in screens if s.agrees(claim, r, values))
        return next(agreeing, None)

    def _suits(self, claim: Claim, text: str) -> str | None:
        """Whether another text of a number that nothing computes suits what rests on it."""
        changed = self.ledger.misprint(claim.id, text).claims[claim.id]
        sources = [s for s in self.ledger.sources.values() if claim.id in s.claims]
        if sources and not any(changed.target().meets(source.interval) for source in sources):
            return None
        value = {claim.id: changed.value}
        shown = (self.ledger.claims[result] for result in claim.shown_by)
        return "" if all(self.screen.agrees(result, "", value) for result in shown) else None

    def _failing(self, entry: str, text: str) -> set[str]:
        """The claims and equations that fail with the edit; those it does not touch, as before."""
        changed = self.ledger.misprint(entry, text)
        touched = dependents(self.ledger, entry)
        others = self._failing_now - touched
        failing = others | min((s.failing(touched) for s in self._screens(changed)), key=len)
        within = entry if entry in self.ledger.equations else self.ledger.claims[entry].within
        if within is None:
            return failing | self._bad_equations
        own = set() if follows(changed, within) else {within}
        return failing | (self._bad_equations - {within}) | own

    @cached_property
    def _failing_now(self) -> set[str]:
        return self.screen.failing(self.ledger.claims)

    @cached_property
    def _bad_equations(self) -> set[str]:
        return {name for name in self.ledger.equations if not follows(self.ledger, name)}

    # One culprit for all that fails

    def ranked(self, names: Collection[str]) -> list[RepairRecord]:
        """The repairs that may explain all that fails at once, the best first.

        If one misprint is behind several failures, it stands in an entry that all of them rest on:
        only such entries are searched. The fewer claims a repair leaves failing, the better; of
        equal ones the likelier slip of a typist comes first. If no entry is common to all, the
        repairs of the claim that is quickest to compute are given. An input that is doubted only
        because of the claims that rest on it says no more than they do.
        """
        names = [name for name in names if not self._is_only_shown(name)]
        if not names:
            return []
        quickest = min(names, key=self._cost)
        suspects = [set(self._suspects(name)) for name in names]
        common = set.intersection(*suspects) or suspects[0]
        repairs = self._sorted(quickest, [e for e in self._suspects(quickest) if e in common])
        return repairs if repairs or len(names) == 1 else self.ranked([quickest])

    def _is_only_shown(self, name: str) -> bool:
        claim = self.ledger.claims.get(name)
        return claim is not None and claim.computation is None and bool(claim.shown_by)

    def _cost(self, name: str) -> tuple[int, str]:
        """How long a claim takes to compute: whole sheets last, repetitions first."""
        if name in self.ledger.equations:
            return 2, name
        claim = self.ledger.claims[name]
        if claim.computation is None or claim.computation.restates:
            return 0 if claim.within is None else 2, name
        return 1 + 2 * claim.by_scheme + (claim.by_scheme and claim.row is None), name

    def culprit(self, names: Collection[str]) -> CulpritRecord | None:
        """The one repair that makes everything agree that fails, if there is one."""
        repairs = self.ranked(names) if len(names) > 1 else []
        if not repairs or repairs[0].failing:
            return None
        return CulpritRecord(repair=repairs[0], explains=list(names))

    # Slips

    def _slips(self, claim: Claim) -> Iterator[SlipRecord]:
        """What the slips of the claim's equations make of it."""
        target, rounded = claim.target(), Convention(choices_exact=False)
        for slip in (slip for slip in self.ledger.slip if slip.equation in claim.uses):
            ledger = self.ledger
            if slip.text is not None:
                ledger = ledger.misprint(slip.equation, slip.text)
            replaced = {key: name for key, name in slip.inputs.items() if key in claim.inputs}
            changed = claim.resting_on(**replaced)
            function = ledger.function(changed)
            at_print = enclose(function, self.judge.printed(changed)).ends
            fits = "as printed" if target.encloses(*at_print) else ""
            everywhere = enclose(function, self.judge.box(changed, rounded)[1]).ends
            if not fits and not target.excludes(*everywhere):
                fits = "not excluded within rounding"
            value = float(at_print[0] / claim.si)
            yield SlipRecord(name=slip.name, reason=slip.reason, value=value, fits=fits)


_BISECTIONS = 40
"""Down to 1e-12 of the search, beyond what any page shows."""

_BUDGET = 250
"""Parts of a search: k_t, on which the depth hardly depends, takes some 200 of them."""

_SHOWN = 20
"""So many repairs of one claim are kept, the likeliest first."""
