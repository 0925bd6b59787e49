"""What the ledger says in the report's notation: computations in any arithmetic, and derivations.

A formula has the report's symbols and names for sides of printed equations, its premises. Where the
report prints a formula, it is the printed one that is evaluated, its constants included. Inputs are
in SI units; exponents, and results that are exact in rational numbers, are Fractions.

A check of a derivation compares two quotients of polynomials, made from the equation as it is
printed and from what it must follow from: they are equal for all values of the symbols or they are
not. To integrate, a printed solution is differentiated and put in. Premises are geometry (a plane
cuts a sphere), Newton's law, Bernoulli's, and earlier equations of the report where it says that it
uses them.
"""

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from functools import partial, reduce
from itertools import islice
from typing import Any, Literal

import msgspec

from reference.arithmetic import Dual, Duals, Floats, Function, Number, RationalFunctions
from reference.equations import Node, Sides, evaluate, read_expression
from reference.motion import Row, sheet_depth, sheet_rows
from reference.printed import Place
from reference.units import unit_dimension

Names = Mapping[str, str]
"""How symbols and premises are written, and what they are called."""


class Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A table of a TOML file; keys that it does not know are refused."""


class Side(Entry, frozen=True, kw_only=True):
    """A side of an equation, or its slope by a symbol, with something put in for its symbols."""

    side: int = -1
    put: dict[str, str] = {}
    slope: str | None = None


class Premise(Side, frozen=True):
    """What another equation is derived from."""

    equation: str


class Condition(Side, frozen=True):
    """What must hold of an equation, so that it follows from its premises."""

    says: str
    equals: str


class Equation(Entry, frozen=True, eq=False):
    """An [[equation]], and where it stands."""

    id: str
    title: str
    quote: str
    kind: Literal["derived", "definition", "taken over"]
    follows_from: str
    checks: list[Condition] = []
    premises: dict[str, Premise] = {}
    place: Place = Place()


class Computation(Entry, frozen=True, eq=False):
    """A [[computation]]: what it computes, and its formula or, without one, that of FUNCTIONS."""

    name: str
    summary: str
    formula: str | None = None
    premises: dict[str, Premise] = {}
    restates: bool = False
    by_row: bool = False
    by_scheme: bool = False


def _value(text: str, names: Names, ar: Any, known: Mapping[str, Any]) -> Any:
    """The value of an expression; a known name alone stays as it is, for exact exponents."""
    return known[text] if text in known else evaluate(read_expression(text, names), ar, known)


def _side(
    entry: Side, sides: tuple[Node, ...], names: Names, ar: Any, known: Mapping[str, Any]
) -> Number:
    """A side of an equation, or its slope, at the known values and those put in for symbols."""
    side = sides[entry.side]
    put = {symbol: _value(text, names, ar, known) for symbol, text in entry.put.items()}
    values = {**known, **put}
    if entry.slope is None:
        return evaluate(side, ar, values)
    duals = Duals(ar)
    numbers = {name: Dual(value) for name, value in values.items()}
    numbers[entry.slope] = duals.variable(values[entry.slope], entry.slope)
    return evaluate(side, duals, numbers).slopes.get(entry.slope, ar.number(0))


# Computations


def function_of(computation: Computation, sides: Sides, names: Iterable[str]) -> Function:
    """A computation, given the sides of all equations, as a function of inputs with these names."""
    if computation.formula is None:
        return FUNCTIONS[computation.name]
    premises = computation.premises
    written = {r"\pi": "pi", **{key: key for key in (*names, *premises)}}
    formula = read_expression(computation.formula, written)

    def value(ar: Any, **known: Any) -> Number | Fraction:
        for key, premise in premises.items():
            known[key] = _side(premise, sides[premise.equation], written, ar, known)
        return evaluate(formula, ar, known)

    return value


def _cell(column: str, ar: Any, row: int, centered: bool, **inputs: Number) -> Number:
    rows = sheet_rows(ar, centered=centered, **inputs)
    return getattr(next(islice(rows, row - 1, None)), column)


FUNCTIONS: Mapping[str, Function] = {
    "count": lambda _, **values: Fraction(len(values)),
    "force_power": lambda _: (unit_dimension("N") / unit_dimension("Pa")).powers[1],
    "least_beta": lambda ar, **betas: reduce(ar.least, betas.values()),
    "greatest_beta": lambda ar, **betas: reduce(ar.greatest, betas.values()),
    **{f"row_{column}": partial(_cell, column) for column in Row._fields},
    "final_sheet_depth": sheet_depth,
}
"""Computations that cannot be written in the report's notation."""


# Derivations


class Check(msgspec.Struct, frozen=True):
    """One step of a derivation: what must hold, and whether it does.

    `factor` is the number by which the printed side differs from the derived one, where it is
    nothing but a number.
    """

    says: str
    holds: bool
    factor: Fraction | None = None


def derive(equation: Equation, sides: Sides, written: Names) -> Iterator[Check]:
    """Every check of one equation, given the sides of all, one by one.

    `written` maps what the report writes to a symbol's name. Raises ZeroDivisionError, ValueError
    or EquationError where what is printed makes no sense as a quotient of polynomials.
    """
    ar = RationalFunctions(sorted({*written.values()} - {"pi"}))
    names = {**written, **{key: key for key in equation.premises}}
    for check in equation.checks:
        relation, bound = check.equals[0], check.equals[1:]
        if relation in "<>":  # tried in numbers, at those put in and all others at 1
            ones = dict.fromkeys(ar.symbols, 1.0)
            value = _side(check, sides[equation.id], names, Floats(), ones)
            holds = value < float(bound) if relation == "<" else value > float(bound)
            yield Check(check.says, holds)
            continue
        premises = {
            key: _side(premise, sides[premise.equation], names, ar, ar.symbols)
            for key, premise in equation.premises.items()
            if key in check.equals
        }
        printed = _side(check, sides[equation.id], names, ar, ar.symbols)
        derived = _value(check.equals, names, ar, {**ar.symbols, **premises})
        holds = bool(printed == derived)
        factor = None if holds or derived == 0 else ar.constant(printed / derived)
        yield Check(check.says, holds, factor)
