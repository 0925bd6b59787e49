"""The verdict on each printed equation, and on the constants in it."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction

from reference.derivations import Check, Sides, derive
from reference.equations import EquationError, dimension
from reference.ledger import Equation, Ledger
from reference.units import DimensionError
from replication.audit.verdict import Verdict


@dataclass(frozen=True, slots=True)
class Constant:
    """What the checks of its equation say of one printed constant.

    `needed` are the values, of those tried, with which every check holds; `settled` says that no
    other value than the printed one passes, or that another one must stand there.
    """

    claim: str
    verdict: Verdict
    needed: tuple[Fraction, ...]

    @property
    def settled(self) -> bool:
        """Whether the checks decide it."""
        return self.verdict is not Verdict.NOT_CHECKABLE


@dataclass(frozen=True, slots=True)
class EquationAssessment:
    """The verdict on an equation with the checks that it comes from.

    `factor` is the number by which the printed equation differs from the derived one, None where it
    does not, or differs in more than a number.
    """

    equation: Equation
    verdict: Verdict
    checks: tuple[Check, ...]
    constants: Mapping[str, Constant]

    @property
    def factor(self) -> Fraction | None:
        """Printed over derived, where that is a number other than 1."""
        return next((check.factor for check in self.checks if check.factor is not None), None)


def assess_equation(ledger: Ledger, name: str, *, constants: bool = True) -> EquationAssessment:
    """The verdict on one equation, and, if they are asked for, on its constants.

    One that the report derives must pass every check; of one that it takes over only dimensions,
    limits and signs can be checked, and it stays "not checkable" where they hold.

    >>> from reference.ledger import load
    >>> assess_equation(load(), "eq16").factor
    Fraction(1, 2)
    """
    equation = ledger.equations[name]
    try:
        ledger.read(ledger.printed_text(name))
    except EquationError as error:
        check = Check(str(error), holds=False)
        return EquationAssessment(equation, Verdict.NOT_REPRODUCED, (check,), {})
    sides = ledger.sides
    checks = (_dimensions(ledger, name, sides), *_derivation(ledger, name, sides))
    holds = all(check.holds for check in checks)
    passed, failed = {
        "derived": (Verdict.REPRODUCED, Verdict.NOT_REPRODUCED),
        "definition": (Verdict.CONSISTENT, Verdict.INCONSISTENT),
        "taken over": (Verdict.NOT_CHECKABLE, Verdict.NOT_REPRODUCED),
    }[equation.kind]
    judged = _constants(ledger, name, sides, holds) if constants else {}
    return EquationAssessment(equation, passed if holds else failed, checks, judged)


def follows(ledger: Ledger, name: str) -> bool:
    """Whether an equation passes every check: no more of its verdict, in less time."""
    try:
        ledger.read(ledger.printed_text(name))
    except EquationError:
        return False
    return _follows(ledger, name, ledger.sides)


def _follows(ledger: Ledger, name: str, sides: Sides) -> bool:
    """The same for these sides. Dimensions come last: seldom is nothing else wrong."""
    derived = all(check.holds for check in _derivation(ledger, name, sides))
    return derived and _dimensions(ledger, name, sides).holds


def _dimensions(ledger: Ledger, name: str, sides: Sides) -> Check:
    exponents = {
        key: ledger.value(symbol.value)
        for key, symbol in ledger.symbols.items()
        if symbol.value is not None
    }
    says = "both sides have the same dimensions"
    try:
        own = [dimension(side, ledger.dimensions, exponents) for side in sides[name]]
    except (DimensionError, EquationError) as error:
        return Check(f"{says}: {error}", holds=False)
    return Check(says, all(unit == own[0] for unit in own))


def _derivation(ledger: Ledger, name: str, sides: Sides) -> Iterator[Check]:
    try:
        yield from derive(name, sides, ledger.symbols)
    except (EquationError, ZeroDivisionError, KeyError, ValueError) as error:
        yield Check(f"it can be derived: {error}", holds=False)


def _constants(ledger: Ledger, name: str, sides: Sides, holds: bool) -> dict[str, Constant]:
    claims = ledger.constants_of(name)

    def passing(claim: str, given: Mapping[str, Fraction]) -> tuple[Fraction, ...]:
        """The values of a constant with which every check holds, another one given."""
        return tuple(
            value
            for value in _candidates(ledger.value(claim))
            if _follows(ledger, name, mended({**given, claim: value}))
        )

    def mended(constants: Mapping[str, Fraction]) -> Sides:
        return {**sides, name: ledger.read(ledger.printed_text(name, constants))}

    needed = {claim: passing(claim, {}) for claim in claims}
    repairs = [] if holds else [claim for claim, values in needed.items() if values]
    if len(repairs) == 1:
        # The others are judged with the one number put right.
        (culprit,) = repairs
        right = {culprit: needed[culprit][0]}
        needed |= {claim: passing(claim, right) for claim in claims if claim != culprit}
    constants = {}
    for claim, values in needed.items():
        if values == (ledger.value(claim),):
            verdict = Verdict.REPRODUCED
        elif values and ledger.value(claim) not in values:
            verdict = Verdict.NOT_REPRODUCED
        elif not values:
            verdict = Verdict.UNDECIDED
        else:
            verdict = Verdict.NOT_CHECKABLE
        constants[claim] = Constant(claim, verdict, values)
    return constants


_USUAL = tuple(map(Fraction, ("1/4", "1/3", "1/2", "2/3", "1", "4/3", "3/2", "2", "7/3", "3", "4")))
"""Constants that equations of physics have; a printed one is told apart from all of these."""


def _candidates(printed: Fraction) -> list[Fraction]:
    return sorted({*_USUAL, printed, 2 * printed, printed / 2})
