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

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cache, reduce
from itertools import islice
from typing import Any

import msgspec

from reference.arithmetic import Arithmetic, Dual, Duals, Floats, Number, Ratios
from reference.entries import Computation, Condition, Equation, Side
from reference.equations import Node, Sides, evaluate, read_expression
from reference.motion import Row, sheet_depth, sheet_rows
from reference.units import unit_dimension

Names = Mapping[str, str]
"""How symbols and premises are written, and what they are called."""

Term = Callable[[Any, Mapping[str, Any]], Any]
"""What a text of the ledger says, in an arithmetic, of values by name."""


def _term(text: str, names: Names) -> Term:
    """A text, read once; a Fraction that is only named stays one, as exponents must."""
    if text in names.values():
        return lambda _, known: known[text]
    node = read_expression(text, names)
    return lambda ar, known: evaluate(node, ar, known)


def _side(own: Side, names: Names) -> Callable[[Sequence[Node], Any, Mapping[str, Any]], Number]:
    """A side of an equation, or its slope, with something put in for its symbols.

    Those for which nothing is put in have their known values.
    """
    put = {symbol: _term(text, names) for symbol, text in own.put.items()}

    def value(sides: Sequence[Node], ar: Any, known: Mapping[str, Any]) -> Number:
        side, values = sides[own.side], {**known, **{s: term(ar, known) for s, term in put.items()}}
        if own.slope is None:
            return evaluate(side, ar, values)
        duals = Duals(ar)
        numbers = {name: Dual(value) for name, value in values.items()}
        numbers[own.slope] = duals.variable(values[own.slope], own.slope)
        return evaluate(side, duals, numbers).slopes.get(own.slope, ar.number(0))

    return value


# Computations


def computing(computation: Computation, sides: Sides, names: Iterable[str]) -> Term:
    """A computation, given the sides of all equations, as a function of inputs with these names."""
    if computation.formula is None:
        function = FUNCTIONS[computation.name]
        return lambda ar, inputs: function(ar, **inputs)
    own = {r"\pi": "pi", **{key: key for key in (*names, *computation.premises)}}
    premises = [(key, _side(premise, own), sides[premise.equation])
                for key, premise in computation.premises.items()]  # fmt: skip
    formula = _term(computation.formula, own)

    def value(ar: Arithmetic, inputs: Mapping[str, Any]) -> Number | Fraction:
        known = dict(inputs)
        for key, premise, equation in premises:
            known[key] = premise(equation, ar, known)
        return formula(ar, known)

    return value


def _crater(ar: Arithmetic, volume_ratio: Number) -> Number:
    # CV/PV = y^2 (3 - y) / 4 = (3/4) (y^2 - y^3/3)
    return ar.cap_root(4 * volume_ratio / 3)


def _final_sheet_depth(ar: Arithmetic, centered: bool, **inputs: Number) -> Number:
    rows = sheet_rows(ar, centered=centered, **inputs)
    return sheet_depth(ar, rows, inputs["stop_velocity"])


def _cell(column: str) -> Callable[..., Number]:
    """One column of the sheet, in a given row."""

    def cell(ar: Arithmetic, row: int, centered: bool, **inputs: Number) -> Number:
        rows = sheet_rows(ar, centered=centered, **inputs)
        return getattr(next(islice(rows, row - 1, None)), column)

    return cell


FUNCTIONS: Mapping[str, Callable[..., Number | Fraction]] = {
    "count": lambda _, **values: Fraction(len(values)),
    "crater_normalized_depth": _crater,
    "crater_depth": lambda ar, volume_ratio, diameter: _crater(ar, volume_ratio) * diameter / 2,
    "crater_depth_over_diameter": lambda ar, volume_ratio: _crater(ar, volume_ratio) / 2,
    "force_power": lambda _: (unit_dimension("N") / unit_dimension("Pa")).powers[1],
    "least_beta": lambda ar, **betas: reduce(ar.least, betas.values()),
    "greatest_beta": lambda ar, **betas: reduce(ar.greatest, betas.values()),
    **{f"row_{column}": _cell(column) for column in Row._fields},
    "final_sheet_depth": _final_sheet_depth,
}
"""Computations that the report's notation does not say."""


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
    own, field = sides[equation.id], Ratios(sorted({*written.values()} - {"pi"}))
    symbols = field.symbols
    for check, premises, printed_side, derived_term in _derivation(
        equation, tuple(written.items())
    ):
        if derived_term is None:
            yield Check(check.says, _is_so(check, own[check.side], symbols))
            continue
        known = {**symbols, **{key: premise(sides[name], field, symbols)
                               for key, name, premise in premises}}  # fmt: skip
        printed, derived = printed_side(own, field, symbols), derived_term(field, known)
        holds = bool(printed == derived)
        factor = None if holds or derived == 0 else field.constant(printed / derived)
        yield Check(check.says, holds, factor)


@cache
def _derivation(equation: Equation, written: tuple[tuple[str, str], ...]) -> list[Any]:
    """Of every check: itself, its premises, the printed side, and what this must be equal to."""
    names = {**dict(written), **{key: key for key in equation.premises}}
    read = []
    for check in equation.checks:
        named = {key: own for key, own in equation.premises.items() if key in check.equals}
        premises = [(key, own.equation, _side(own, names)) for key, own in named.items()]
        derived = None if check.equals[0] in "<>" else _term(check.equals, names)
        read.append((check, premises, _side(check, names), derived))
    return read


def _is_so(check: Condition, side: Node, symbols: Iterable[str]) -> bool:
    """Whether a side is above or below a number, at the numbers put in and all others at 1."""
    put = {symbol: float(text) for symbol, text in check.put.items()}
    value = evaluate(side, Floats(), {**dict.fromkeys(symbols, 1.0), **put})
    bound = float(check.equals[1:])
    return bool(value < bound if check.equals[0] == "<" else value > bound)
