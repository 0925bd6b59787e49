"""The ledger's computations, in any arithmetic, and its derivations of the printed equations.

A computation's formula is written in the report's notation. It uses the names of its inputs and of
its premises, which are sides of printed equations: where the report prints a formula, the printed
one is evaluated, with its constants. Inputs are in SI units. Exponents, and results that are known
exactly, are Fractions.

A derivation compares the printed equation with what must follow from its premises. Both are
quotients of polynomials, and they are equal for all values of the symbols or they are not. An
integration is checked by differentiating the printed solution. Premises are geometry (a plane cuts
a sphere), Newton's and Bernoulli's laws, and earlier equations of the report where it says that it
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
from reference.scheme import Scheme
from reference.units import unit_dimension

Names = Mapping[str, str]
"""The names of symbols and premises, by the texts that stand for them."""


class Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A table of a TOML file; an unknown key is an error."""


class Side(Entry, frozen=True, kw_only=True):
    """A side of an equation (by index), or its derivative by the symbol `slope`.

    `put` maps symbols to the expressions that replace them.
    """

    side: int = -1
    put: dict[str, str] = {}
    slope: str | None = None


class Premise(Side, frozen=True):
    """A side of an equation that a computation or a derivation starts from."""

    equation: str


class Condition(Side, frozen=True):
    """A condition under which an equation follows from its premises: what its side `equals`."""

    says: str
    equals: str


class Equation(Entry, frozen=True, eq=False):
    """An [[equation]] of the ledger, with its place in the report."""

    id: str
    title: str
    quote: str
    kind: Literal["derived", "definition", "taken over"]
    follows_from: str
    checks: list[Condition] = []
    premises: dict[str, Premise] = {}
    place: Place = Place()


class Computation(Entry, frozen=True, eq=False):
    """A [[computation]] of the ledger; one without a formula is a function in FUNCTIONS."""

    name: str
    summary: str
    formula: str | None = None
    premises: dict[str, Premise] = {}
    restates: bool = False
    by_row: bool = False
    by_scheme: bool = False


def _value(text: str, names: Names, ar: Any, known: Mapping[str, Any]) -> Any:
    """Return an expression's value; a known name keeps its value, which may be an exponent's."""
    return known[text] if text in known else evaluate(read_expression(text, names), ar, known)


def _side(
    entry: Side, sides: tuple[Node, ...], names: Names, ar: Any, known: Mapping[str, Any]
) -> Number:
    """Return a side of an equation, or its derivative, at the `known` values of the symbols."""
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
    """Return a computation as a function of an arithmetic and of inputs with these names."""
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


def _cell(column: str, ar: Any, row: int, scheme: Scheme, **inputs: Number) -> Number:
    rows = sheet_rows(ar, scheme=scheme, **inputs)
    return getattr(next(islice(rows, row - 1, None)), column)


FUNCTIONS: Mapping[str, Function] = {
    "count": lambda _, **values: Fraction(len(values)),
    "force_power": lambda _: (unit_dimension("N") / unit_dimension("Pa")).powers[1],
    "least_beta": lambda ar, **betas: reduce(ar.least, betas.values()),
    "greatest_beta": lambda ar, **betas: reduce(ar.greatest, betas.values()),
    **{f"row_{column}": partial(_cell, column) for column in Row._fields},
    "final_sheet_depth": sheet_depth,
}
"""The computations that cannot be written in the report's notation."""


# Derivations


class Check(msgspec.Struct, frozen=True):
    """The outcome of one condition of a derivation: what must hold, and whether it does.

    `factor` is the printed over the derived side where they differ by a constant number.
    """

    says: str
    holds: bool
    factor: Fraction | None = None


def derive(equation: Equation, sides: Sides, written: Names) -> Iterator[Check]:
    """Yield the outcome of every check of an equation, given the sides of all equations.

    `written` maps the texts of the report's symbols to their names. Raises ZeroDivisionError,
    ValueError or EquationError if a printed side is no quotient of polynomials.
    """
    ar = RationalFunctions(sorted({*written.values()} - {"pi"}))
    names = {**written, **{key: key for key in equation.premises}}
    for check in equation.checks:
        relation, bound = check.equals[0], check.equals[1:]
        if relation in "<>":  # tried in doubles, with every symbol at 1 that is not put in
            ones = dict.fromkeys(ar.symbols, 1.0)
            excess = _side(check, sides[equation.id], names, Floats(), ones) - float(bound)
            yield Check(check.says, excess < 0 if relation == "<" else excess > 0)
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
