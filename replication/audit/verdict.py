"""The verdicts: whether a printed number or equation follows from the rest of the report."""

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from functools import cache, cached_property, partial
from itertools import islice
from math import prod
from typing import Any

from msgspec.structs import replace

from reference.arithmetic import Floats, InexactError, Rationals, Reals
from reference.derivations import Check, derive
from reference.enclosure import Box, Ends, Satisfiability, enclose, satisfying
from reference.equations import EquationError, dimension
from reference.ledger import INFERRED, READ_AS_PRINTED, Claim, Convention, Ledger, Source, in_header
from reference.printed import Interval, Rounding
from reference.scheme import Scheme
from reference.units import Dimension, DimensionError
from replication.audit.assessment import (
    Assessment,
    Comparison,
    ConfirmedRange,
    EquationAssessment,
    Ground,
    JudgedConstant,
    Judgement,
    Reading,
    Standing,
    Verdict,
)
from replication.audit.crosschecks import CROSS_CHECKS
from replication.audit.inference import Admission, Inference
from replication.audit.replica import replica

_REALS, _RATIONALS = Reals(50), Rationals()


def standing(ledger: Ledger, claim: Claim) -> Standing | None:
    """Return what it tells that a computed number is reproduced; None for any other claim."""
    if not claim.is_computed or claim.computation is None or claim.within is not None:
        return None
    if any(claim.id in inferred.evidence for inferred in ledger.inferred.values()):
        return Standing.EVIDENCE
    if claim.computation.by_definition:
        return Standing.BY_DEFINITION
    for earlier in ledger.claims.values():
        if earlier is claim:
            return Standing.INDEPENDENT
        same = earlier.computation is claim.computation and earlier.row == claim.row
        if same and _roots(ledger, earlier) == _roots(ledger, claim):
            return Standing.REPEATS
    raise KeyError(claim.id)


def _roots(ledger: Ledger, claim: Claim) -> dict[str, tuple[str, ...]]:
    """Return a claim's inputs, each entry as it was first printed."""
    return {
        name: tuple(_first_printed(ledger, entry) for entry in entries)
        for name, entries in claim.inputs.items()
    }


def _first_printed(ledger: Ledger, entry: str) -> str:
    """Return the entry that an entry repeats, or itself."""
    claim = ledger.claims.get(entry)
    while claim is not None and claim.same_as is not None:
        claim = ledger.claims[claim.same_as]
    return entry if claim is None else claim.id


def _compare(claim: Claim, source: Source) -> tuple[bool, str]:
    """Return whether a claim agrees with a public source, and in which words.

    "300" may have one, two or three significant digits: it differs only if no reading agrees.
    """
    if claim.target().meets(source.interval):
        return True, "agrees"
    printed = claim.printed
    if printed is not None and claim.bound is None and not claim.is_exact:
        for digits in printed.quanta:
            if printed.interval(quantum=digits).scaled(claim.si).meets(source.interval):
                return True, f"agrees if only some digits of {claim.shown} are significant"
    return False, "differs"


def is_consistent(ledger: Ledger, claim: Claim) -> bool:
    """Return whether a claim that restates agrees with the number it repeats, or with the count.

    It agrees with a number if some value prints like both or, for a bound, prints like that number
    and satisfies the bound.
    """
    if "value" not in claim.inputs:
        return claim.target().contains(Fraction(len(claim.inputs)))
    (name,) = claim.inputs["value"]
    # A choice or an exact number is one value; a bound or an "about" has an interval of its own.
    loose = claim.bound is not None or claim.kind == "approximation"
    interval = claim.target() if loose else claim.as_input(Convention())
    return interval.meets(ledger.claims[name].as_input(Convention()))


def _cross_checked(ledger: Ledger, name: str) -> Assessment:
    """Return the verdict on a number that is compared with others, which only limit it."""
    try:
        checked = CROSS_CHECKS[name].compare(ledger)
    except (ArithmeticError, ValueError) as error:  # an input has no meaning
        return Assessment(Verdict.INCONSISTENT, Ground.NO_VALUE, no_value=str(error))
    if checked.with_sources:
        verdict = Verdict.AGREES if checked.passes else Verdict.DIFFERS
    else:
        verdict = Verdict.CONSISTENT if checked.passes else Verdict.INCONSISTENT
    return Assessment(verdict, Ground.COMPARISON, compared=checked.says)


def is_contradicted(ledger: Ledger, name: str) -> bool:
    """Return whether all public sources for a number contradict it, or what it is compared with.

    It is compared with other numbers only where no public source prints it.
    """
    if sources := ledger.sources_of(name):
        return not any(_compare(ledger.claims[name], source)[0] for source in sources)
    return name in CROSS_CHECKS and _cross_checked(ledger, name).verdict.is_doubtful


class Judge:
    """Judges the claims of one ledger, and computes only once what several of them need.

    With `every_convention` a claim is judged under all conventions, else under the usual one only.
    """

    def __init__(self, ledger: Ledger, *, every_convention: bool = True) -> None:
        self.ledger, self.every_convention = ledger, every_convention
        # Cached by this object and not by the functions, so that the results are freed with it.
        self._inferences = cache(partial(Inference, ledger))
        self.assess_equation = cache(partial(assess_equation, ledger))
        self.assess = cache(self._assess)
        self.confirmed_range = cache(self._confirmed_range)
        self.sources = cache(self._sources)

    def inference(
        self, name: str, *, scheme: Scheme = Scheme.PUBLISHED, rounding: Rounding = Rounding.AWAY
    ) -> Inference:
        """Infer an unprinted input under one of the schemes, with the evidence so rounded."""
        return self._inferences(name, scheme=scheme, rounding=rounding)

    @cached_property
    def assumed(self) -> Mapping[str, Fraction]:
        """The value (SI) taken for every inferred input: the nominal one if the evidence admits it.

        If not, it is the middle of the admitted values.
        """
        values = {}
        for name in (INFERRED + key for key in self.ledger.inferred):
            inner, nominal = self.inference(name).inner, self.ledger.value(name)
            values[name] = nominal if inner.contains(nominal) else sum(inner.ends, Fraction(0)) / 2
        return values

    @property
    def moved(self) -> set[str]:
        """The inferred inputs that are not assumed at their nominal value."""
        return {name for name, value in self.assumed.items() if value != self.ledger.value(name)}

    def value(self, name: str) -> Fraction:
        """Return the printed or, for an inferred input, the assumed value of an entry, in SI."""
        return self.assumed[name] if name in self.assumed else self.ledger.value(name)

    def _assess(self, claim: Claim) -> Assessment:
        """Return the verdict on a claim.

        What the report computes or repeats is computed or compared again, and a constant of an
        equation is judged with the equation. Only where that decides nothing, public sources do,
        or the claims that are computed from the number, or what limits it.
        """
        if claim.kind == "remark":
            return Assessment(Verdict.REMARK, Ground.WORDS)
        if claim.restates:
            is_met = is_consistent(self.ledger, claim)
            verdict = Verdict.CONSISTENT if is_met else Verdict.INCONSISTENT
            return Assessment(verdict, Ground.REPETITION)
        if claim.is_computed:
            return self._recomputed(claim)
        constant = self.constant(claim)
        if constant is not None and constant.verdict != Verdict.NOT_CHECKABLE:
            return Assessment(constant.verdict, Ground.EQUATION)
        if sources := self.sources(claim.id):
            is_printed = any(source.agrees for source in sources)
            verdict = Verdict.AGREES if is_printed else Verdict.DIFFERS
            return Assessment(verdict, Ground.SOURCES)
        if claim.shown_by:
            is_met = self.confirmed_range(claim) is not None
            verdict = Verdict.CONSISTENT if is_met else Verdict.INCONSISTENT
            return Assessment(verdict, Ground.OTHERS)
        if claim.id in CROSS_CHECKS:
            return _cross_checked(self.ledger, claim.id)
        if claim.given == "definition":
            return Assessment(Verdict.CONSISTENT, Ground.DEFINITION)
        ground = Ground.NOTHING if constant is None else Ground.EQUATION
        return Assessment(Verdict.NOT_CHECKABLE, ground)

    def constant(self, claim: Claim) -> JudgedConstant | None:
        """Return the judgement on a claim as a constant of its equation; None if it is none."""
        return self.assess_equation(claim.within).constants.get(claim.id) if claim.within else None

    def _recomputed(self, claim: Claim) -> Assessment:
        """Return the verdict on a claim that the report computes.

        It is "not reproduced", with the reason, if the computation has no value for the inputs as
        printed.
        """
        try:
            readings = tuple(self._reading(claim, name) for name in claim.computations)
        except ArithmeticError as error:
            no_value = str(error) or "it divides by zero"  # of which `mpmath` says nothing
            return Assessment(Verdict.NOT_REPRODUCED, Ground.NO_VALUE, no_value=no_value)
        verdict = readings[0].verdict
        told = standing(self.ledger, claim) if verdict is Verdict.REPRODUCED else None
        return Assessment(verdict, Ground.COMPUTATION, readings, standing=told)

    def _reading(self, claim: Claim, name: str) -> Reading:
        reference = self._by_formulas(claim, name)
        if self.ledger.misprinted:  # the models know nothing of a misprint in an equation
            computed = float(reference)
        else:
            computed = float(Fraction(self.modelled(claim, name)) / claim.si)
        digits = str(_REALS.context.nstr(reference, 25))
        judgements = islice(self._judgements(claim, name), None if self.every_convention else 1)
        in_unit = tuple(
            replace(judgement, ends=(judgement.ends[0] / claim.si, judgement.ends[1] / claim.si))
            for judgement in judgements
        )
        return Reading(name, claim.computations[name].summary, computed, digits, in_unit)

    def _by_formulas(self, claim: Claim, reading: str) -> Any:
        """Return the value by the ledger's formulas for the inputs as printed, in the claim's unit.

        It is a number of `mpmath` with 50 digits.
        """
        function = self.ledger.function(claim, reading=reading)
        value = function(_REALS, **{e: _REALS.number(self.value(e)) for e in claim.input_ids})
        exact = _REALS.number(value) if isinstance(value, Fraction) else value
        return exact / _REALS.number(claim.si)

    def modelled(
        self, claim: Claim, reading: str = READ_AS_PRINTED, scheme: Scheme = Scheme.PUBLISHED
    ) -> float:
        """Return the models' value of a claim for its inputs as printed, in SI."""
        computation = claim.computations[reading]
        inputs = {key: float(prod(map(self.value, names))) for key, names in claim.inputs.items()}
        settings: dict[str, object] = {"row": claim.row} if computation.by_row else {}
        if computation.by_scheme:
            settings["scheme"] = scheme
        return replica(computation.name, inputs, **settings)

    def _judgements(self, claim: Claim, reading: str) -> Iterator[Judgement]:
        """Yield a judgement for every convention that may matter, the usual first; ends in SI."""
        box = self.inputs_as_printed(claim)
        for scheme in Scheme if claim.by_scheme else (Scheme.PUBLISHED,):
            inferred = {e: self.inference(e, scheme=scheme).inner.ends for e in claim.inferred}
            at_print = admitted = self._range(claim, reading, scheme, box)
            if inferred:
                admitted = self._range(claim, reading, scheme, {**box, **inferred})
            for rounding in Rounding:
                convention, target = Convention(rounding, scheme=scheme), claim.target(rounding)
                if target.excludes(*at_print):
                    conventions = _input_conventions(self.ledger, claim, convention)
                    yield from map(partial(self._search, claim, reading), conventions)
                elif target.encloses(*admitted):
                    yield Judgement(convention, Verdict.REPRODUCED, admitted)
                elif target.encloses(*at_print):
                    # Only some admitted values give it, and the evidence does not tell which holds.
                    witness = {entry: self.value(entry) for entry in claim.input_ids}
                    yield Judgement(convention, Verdict.WITHIN_ROUNDING, admitted, witness)
                else:
                    yield Judgement(convention, Verdict.UNDECIDED, admitted)

    def _search(self, claim: Claim, reading: str, convention: Convention) -> Judgement:
        """Judge a claim that the inputs as printed do not give, by all inputs that print like them.

        Those must also give the numbers from which an input is inferred.
        """
        target = claim.target(convention.rounding)
        function = self.ledger.function(claim, reading=reading, scheme=convention.scheme)
        box = self.inputs_as_rounded(claim, convention)
        ends = enclose(function, box).ends
        if target.excludes(*ends):
            return Judgement(convention, Verdict.NOT_REPRODUCED, ends)
        budget = _BUDGET // 10 if claim.by_whole_sheet else _BUDGET
        constraints = [(function, target)]
        witnessed = set(claim.input_ids)
        for entry in claim.inferred:
            inference = self.inference(entry, scheme=convention.scheme)
            constraints, box = inference.joint(convention, box, constraints)
            if inference.entry.radius in witnessed - box.keys():  # computed from the mass
                witnessed.add(inference.entry.mass)
        outcome, point = satisfying(constraints, box, budget)
        witness = point and {entry: x for entry, x in point.items() if entry in witnessed}
        against_evidence = bool(claim.inferred) and outcome is Satisfiability.REFUTED
        return Judgement(convention, _VERDICTS[outcome], ends, witness, against_evidence)

    # Public sources, and choices that other claims confirm

    def admission(self, source: Source) -> Admission:
        """Return whether the evidence for an inferred input admits a public source's value."""
        (name,) = source.claims
        return self.inference(name).admits(source.value, source.interval)

    def _sources(self, name: str) -> list[Comparison]:
        """Return the public sources for a claim or an inferred input, each compared with it."""
        records = []
        for source in self.ledger.sources_of(name):
            if name.startswith(INFERRED):
                admission = self.admission(source)
                matches, outcome = admission is Admission.ADMITTED, f"is {admission.value}"
            else:
                matches, outcome = _compare(self.ledger.claims[name], source)
            records.append(Comparison(source, matches, outcome))
        return records

    def _confirmed_range(self, chosen: Claim) -> ConfirmedRange | None:
        """Return the range around a chosen number for which the claims that confirm it agree.

        Its ends are found by bisection, in doubles. It is None if no claim confirms the number, or
        if one of them disagrees with it.
        """
        if not chosen.shown_by or not self.is_confirmed(chosen, chosen.value):
            return None
        ends = []
        for limit in self.ledger.search(chosen.id)[:2]:
            good, bad = chosen.value, limit
            for _ in range(_BISECTIONS):
                middle = (good + bad) / 2
                good, bad = (middle, bad) if self.is_confirmed(chosen, middle) else (good, middle)
            ends.append(float(good / chosen.si))
        return ConfirmedRange(chosen.shown_by, (ends[0], ends[1]), chosen.unit)

    def is_confirmed(self, chosen: Claim, value: Fraction) -> bool:
        """Return whether all claims that confirm a number agree with this value (SI) of it."""
        ledger, changed = self.ledger, {**self.assumed, chosen.id: value}
        return all(comes_out(ledger, ledger.claims[name], changed) for name in chosen.shown_by)

    # The inputs of a claim

    def relevant(self, claim: Claim) -> list[str]:
        """Return the inferred inputs of a claim, less those proven not to influence its value."""
        inferred = {entry: self.inference(entry).inner.ends for entry in claim.inferred}
        if not inferred:
            return []
        box = {**self.inputs_as_printed(claim), **inferred}
        idle = enclose(self.ledger.function(claim), box).idle
        return [entry for entry in claim.inferred if entry not in idle]

    def inputs_as_printed(self, claim: Claim) -> Box:
        """Return the inputs of a claim as printed or, where they are inferred, as assumed."""
        return {entry: (self.value(entry),) * 2 for entry in claim.input_ids}

    def inputs_as_rounded(self, claim: Claim, convention: Convention) -> Box:
        """Return the ranges of a claim's inputs, each as `rounded` has it."""
        return {entry: self.rounded(entry, convention).ends for entry in claim.input_ids}

    def rounded(self, entry: str, convention: Convention) -> Interval:
        """Return the values of an input (SI) that print like it, or that its evidence admits."""
        if entry in self.ledger.claims:
            return self.ledger.claims[entry].as_input(convention)
        return self.inference(entry, scheme=convention.scheme).admitted(convention)

    def _range(self, claim: Claim, reading: str, scheme: Scheme, box: Box) -> Ends:
        """Return a proven range of a claim's values, in SI.

        It is one exact value if every input that has influence is one value, and the result is
        rational: only then can it be proven to lie exactly on an end of a printed interval.
        """
        function = self.ledger.function(claim, reading=reading, scheme=scheme)
        range_, computation = enclose(function, box), claim.computations[reading]
        decided = all(claim.target(rounding).decides(*range_.ends) for rounding in Rounding)
        # Fractions grow too long over a whole sheet, and in rows that square twice (centered).
        squares_twice = scheme is Scheme.CENTERED
        long = computation.by_scheme and (not computation.by_row or (squares_twice and decided))
        if long or any(box[entry][0] != box[entry][1] for entry in box.keys() - range_.idle):
            return range_.ends
        try:
            exact = Fraction(function(_RATIONALS, **{key: low for key, (low, _) in box.items()}))
        except InexactError:
            return range_.ends
        return exact, exact


_VERDICTS = {
    Satisfiability.SHOWN: Verdict.WITHIN_ROUNDING,
    Satisfiability.REFUTED: Verdict.NOT_REPRODUCED,
    Satisfiability.UNDECIDED: Verdict.UNDECIDED,
}
"""The verdict by whether inputs that print like the report's can give the number."""

_BUDGET = 100
"""The most boxes that a search tries; a tenth of it for whole sheets, which take 10 ms each."""

_BISECTIONS = 40
"""This many narrow the search to 1e-12 of its width, which is finer than any page shows."""


def _input_conventions(ledger: Ledger, claim: Claim, usual: Convention) -> list[Convention]:
    """Return the conventions on inputs that may matter for a claim, the usual one first.

    If the result of a sheet is taken as cut off, its inputs are exact: Table A-1 comes from the
    same sheet and is not cut off, so it cannot tell which rounded inputs would do. For a result of
    the whole sheet the author's choices are exact: if beta = 5 were rounded to its one digit, any
    depth would do.
    """
    if claim.by_scheme and usual.rounding is Rounding.CUT:
        return [replace(usual, header_exact=True)]
    claims = [ledger.claims[entry] for entry in claim.stated]
    rests_on_choice = any(entry.chosen for entry in claims) and not claim.by_whole_sheet
    rests_on_header = bool(claim.inferred) or any(in_header(entry.cell) for entry in claims)
    return [
        replace(usual, choices_exact=choices, header_exact=header)
        for choices in ((True, False) if rests_on_choice else (True,))
        for header in ((False, True) if rests_on_header else (False,))
    ]


# Checks in doubles, which find an explanation or the range of a chosen number

_CLOSE = Fraction(1, 10**9)
"""The largest relative difference at which a double agrees with an exact number, such as 2/3."""

Replacements = Mapping[str, Fraction]
"""Values of some entries (SI) in place of the printed ones."""


def comes_out(
    ledger: Ledger, claim: Claim, changed: Replacements, reading: str = READ_AS_PRINTED
) -> bool:
    """Return whether a claim is what its computation gives, in doubles, some entries changed."""
    if claim.restates:
        return is_consistent(ledger, claim)
    target, values = claim.target(), {name: ledger.value(name) for name in claim.input_ids}
    inputs = {name: float(changed.get(name, value)) for name, value in values.items()}
    try:
        value = Fraction(ledger.function(claim, reading=reading)(Floats(), **inputs))
    except (ArithmeticError, ValueError, TypeError):
        return False  # these inputs give no result, or only a complex one
    if target.is_point and target.lower is not None:
        return abs(value - target.lower) <= _CLOSE * abs(target.lower)
    return target.contains(value)


def disagreeing(ledger: Ledger, names: Iterable[str], changed: Replacements) -> set[str]:
    """Return which of the claims disagree with their computations, some entries changed."""
    claims = (ledger.claims[name] for name in names)
    computed = (claim for claim in claims if claim.computation is not None)
    return {claim.id for claim in computed if not comes_out(ledger, claim, changed)}


# Equations, and the constants in them


def assess_equation(ledger: Ledger, name: str, *, constants: bool = True) -> EquationAssessment:
    """Return the verdict on an equation and, if `constants`, on the constants in it.

    An equation that the report derives must pass every check. A definition, and an equation that
    repeats another, is consistent if it does. If the report takes an equation from the literature,
    only its dimensions, limits and signs can be checked: it is "not checkable" if they hold.

    >>> from reference.ledger import load
    >>> assess_equation(load(), "eq16").factor
    Fraction(1, 2)
    """
    equation, checks = ledger.equations[name], tuple(_checks(ledger, name))
    holds = all(check.holds for check in checks)
    passed, failed = {
        "derived": (Verdict.REPRODUCED, Verdict.NOT_REPRODUCED),
        "definition": (Verdict.CONSISTENT, Verdict.INCONSISTENT),
        "repeat": (Verdict.CONSISTENT, Verdict.INCONSISTENT),
        "taken over": (Verdict.NOT_CHECKABLE, Verdict.NOT_REPRODUCED),
    }[equation.kind]
    records = _constants(ledger, name, holds) if constants else {}
    return EquationAssessment(equation, passed if holds else failed, checks, records)


def follows(ledger: Ledger, name: str) -> bool:
    """Return whether an equation passes every check."""
    return all(check.holds for check in _checks(ledger, name))


def _checks(ledger: Ledger, name: str) -> Iterator[Check]:
    """Yield the checks of an equation, the dimensions last, as they are seldom what is wrong."""
    try:
        ledger.read(ledger.printed_text(name))  # else the sides are the report's
        yield from derive(name, ledger.sides, ledger.written)
    except (ZeroDivisionError, KeyError, ValueError) as error:
        yield Check(f"it can be derived: {error}", holds=False)
    known: dict[str, Dimension | Fraction] = {**ledger.dimensions}
    known |= {key: ledger.value(s.value) for key, s in ledger.symbols.items() if s.value}
    says = "both sides have the same dimensions"
    try:
        units = [dimension(side, known) for side in ledger.sides[name]]
        yield Check(says, all(unit == units[0] for unit in units))
    except (DimensionError, EquationError) as error:
        yield Check(f"{says}: {error}", holds=False)


def _constants(ledger: Ledger, name: str, holds: bool) -> dict[str, JudgedConstant]:
    """Judge each constant of an equation by the values in its place that pass every check.

    It is reproduced if only the printed value does, not reproduced if only other values do. In a
    definition or a repeated equation the printed value is consistent instead. In an equation that
    is taken over it is not checkable if only the quoted law itself decides it.
    """
    as_printed = {claim: ledger.value(claim) for claim in ledger.constants_of(name)}
    kind = ledger.equations[name].kind

    def passing(
        claim: str, corrected: Mapping[str, Fraction], *, quoted: bool = True
    ) -> list[Fraction]:
        """Return the values of a constant that pass every check, given corrected constants.

        Without `quoted`, checks that quote the law itself are left out.
        """
        tried = sorted(
            {*_USUAL, *(as_printed[claim] * factor for factor in (1, 2, Fraction(1, 2)))}
        )
        texts = {value: ledger.printed_text(name, {**corrected, claim: value}) for value in tried}
        checks = {v: _checks(ledger.misprint(name, text), name) for v, text in texts.items()}
        return [
            v for v, own in checks.items() if all(c.holds for c in own if quoted or not c.quotes)
        ]

    needed = {claim: passing(claim, {}) for claim in as_printed}
    repairs = [] if holds else [claim for claim, values in needed.items() if values]
    if len(repairs) == 1:
        # The other constants are judged with this one corrected.
        (culprit,) = repairs
        corrected = {culprit: needed[culprit][0]}
        needed |= {claim: passing(claim, corrected) for claim in as_printed if claim != culprit}
    constants = {}
    for claim, values in needed.items():
        verdict = Verdict.NOT_REPRODUCED if values else Verdict.UNDECIDED
        if as_printed[claim] in values:
            decided = len(values) == 1
            if kind == "taken over":
                decided = len(passing(claim, {}, quoted=False)) == 1
            repeats = kind in ("definition", "repeat")
            passed = Verdict.CONSISTENT if repeats else Verdict.REPRODUCED
            verdict = passed if decided else Verdict.NOT_CHECKABLE
        constants[claim] = JudgedConstant(claim=claim, verdict=verdict, needed=[*map(str, values)])
    return constants


_USUAL = tuple(map(Fraction, ("1/4", "1/3", "1/2", "2/3", "1", "4/3", "3/2", "2", "7/3", "3", "4")))
"""Common constants of physical equations, each tried in the place of a printed constant."""
