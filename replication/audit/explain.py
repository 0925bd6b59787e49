"""What would explain a number that does not follow: nothing here is asserted, all is tried."""

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property

from reference.derivations import PREMISES
from reference.enclosure import Solutions, enclose, holding, solve
from reference.entries import Slip
from reference.ledger import INFERRED, Claim, Convention, Ledger
from reference.printed import parse
from replication.audit.edits import EQUATION_EDITS, NUMBER_EDITS, edits_of
from replication.audit.equations import follows
from replication.audit.record import CulpritRecord, RepairRecord, SlipRecord
from replication.audit.screen import Screen, dependents
from replication.audit.verdict import Judge


@dataclass(frozen=True, slots=True)
class BackSolved:
    """The values of one entry, the others as printed, for which a claim would agree; in SI.

    `prints_alike` says that some of them print like the entry does.
    """

    reading: str
    entry: str
    solutions: Solutions
    reason: str
    prints_alike: bool


class Explainer:
    """Explanations for the failing claims of one ledger."""

    def __init__(self, judge: Judge) -> None:
        self.judge, self.ledger = judge, judge.ledger
        self._solved: dict[str, list[BackSolved]] = {}
        self._repairs_by = cache(lambda name, entry: list(self._repairs(name, entry)))
        self.slips = cache(self._slips)

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

    def back_solved(self, claim: Claim) -> list[BackSolved]:
        """Each entry that the claim rests on, alone, for every reading of the claim."""
        if claim.id not in self._solved:
            self._solved[claim.id] = [
                self._back_solved(claim, reading, name)
                for reading in claim.computations
                for name in claim.entries
                if self._may_vary(name)
            ]
        return self._solved[claim.id]

    def _may_vary(self, name: str) -> bool:
        if name.startswith(INFERRED):
            return True
        claim = self.ledger.claims[name]
        return not claim.is_exact or claim.quantity is not None

    def _back_solved(self, claim: Claim, reading: str, name: str) -> BackSolved:
        low, high, reason = self.ledger.search(name)
        others = {entry: self.judge.value(entry) for entry in claim.entries if entry != name}
        function = holding(self.ledger.function(claim, reading=reading), others)
        solutions = solve(function, name, (low, high), claim.target(), _BUDGET)
        alike = False
        if not name.startswith(INFERRED):
            own = self.ledger.claims[name].as_input(Convention(choices_exact=False))
            alike = any(not own.excludes(*part) for part in solutions.inner)
        return BackSolved(reading, name, solutions, reason, alike)

    def admitted(self, name: str, claims: Sequence[str]) -> tuple[Fraction, Fraction] | None:
        """The least and greatest value of an entry, around the printed one, that suits some claims.

        Found by bisection, in doubles: where the claims begin to disagree. None if they disagree
        with the printed value itself.
        """

        def suits(value: Fraction) -> bool:
            results = (self.ledger.claims[claim] for claim in claims)
            return all(self.screen.agrees(result, "", {name: value}) for result in results)

        printed = self.ledger.value(name)
        if not suits(printed):
            return None
        ends = []
        for far in self.ledger.search(name)[:2]:
            good, bad = printed, far
            for _ in range(_BISECTIONS):
                middle = (good + bad) / 2
                good, bad = (middle, bad) if suits(middle) else (good, middle)
            ends.append(good)
        return ends[0], ends[1]

    # Misprints

    def repairs(self, name: str) -> list[RepairRecord]:
        """Texts one edit away with which a claim or an equation agrees; the likeliest first.

        A repair that leaves fewer claims failing comes before one that puts others wrong; of equal
        ones the likelier slip of a typist comes first.
        """
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
            equations = [name, *PREMISES.get(name, ())]
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
            if self._is_ruled_out(claim, entry, values[entry]):
                return None
        agreeing = (r for r in claim.computations for s in screens if s.agrees(claim, r, values))
        return next(agreeing, None)

    def _is_ruled_out(self, claim: Claim, entry: str, value: Fraction) -> bool:
        """Whether it was proven already, by solving for the entry, that no reading agrees."""
        if self.judge.moved or claim.id not in self._solved:
            return False
        found = [s.solutions for s in self._solved[claim.id] if s.entry == entry]
        return bool(found) and not any(solutions.may_admit(value) for solutions in found)

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
        found = self._sorted(quickest, [e for e in self._suspects(quickest) if e in common])
        return found if found or len(names) == 1 else self.ranked([quickest])

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

    def _slips(self, claim: Claim) -> list[SlipRecord]:
        """What the slips of the claim's equations make of it."""
        return [self._tried(claim, s) for s in self.ledger.slips if s.equation in claim.uses]

    def _tried(self, claim: Claim, slip: Slip) -> SlipRecord:
        ledger = self.ledger
        if slip.text is not None:
            ledger = ledger.misprint(slip.equation, slip.text)
        replaced = {key: name for key, name in slip.inputs.items() if key in claim.inputs}
        changed = claim.resting_on(**replaced)
        function = ledger.function(changed)
        at_print = enclose(function, self.judge.printed(changed)).ends
        target, rounded = claim.target(), Convention(choices_exact=False)
        fits = "as printed" if target.encloses(*at_print) else ""
        everywhere = enclose(function, self.judge.box(changed, rounded)[1]).ends
        if not fits and not target.excludes(*everywhere):
            fits = "not excluded within rounding"
        value = float(at_print[0] / claim.si)
        return SlipRecord(name=slip.name, reason=slip.reason, value=value, fits=fits)


_BISECTIONS = 40
"""Down to 1e-12 of the search, beyond what any page shows."""

_BUDGET = 250
"""Parts of a search: k_t, on which the depth hardly depends, takes some 200 of them."""

_SHOWN = 20
"""So many repairs of one claim are kept, the likeliest first."""
