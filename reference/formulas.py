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
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import islice
from typing import Any

from reference.arithmetic import Arithmetic, Dual, Duals, Floats, Number, Ratios
from reference.entries import Computation, Condition, Equation, Side
from reference.equations import Node, Sides, evaluate, read_expression
from reference.motion import Row, sheet_depth, sheet_rows
from reference.units import unit_dimension

Names = Mapping[str, str]
"""How symbols and premises are written, and what they are called."""


def _value(text: str, ar: Any, known: Mapping[str, Any], names: Names) -> Any:
    """What a text of the ledger says; a Fraction that is named stays one, as exponents must."""
    return known[text] if text in known else evaluate(read_expression(text, names), ar, known)


def _side(
    own: Side, sides: Sequence[Node], ar: Any, known: Mapping[str, Any], names: Names
) -> Number:
    """A side of an equation, or its slope, with something put in for its symbols.

    Those for which nothing is put in have their known values.
    """
    put = {symbol: _value(text, ar, known, names) for symbol, text in own.put.items()}
    side, values = sides[own.side], {**known, **put}
    if own.slope is None:
        return evaluate(side, ar, values)
    duals = Duals(ar)
    numbers = {name: Dual(value) for name, value in values.items()}
    numbers[own.slope] = duals.variable(values[own.slope], own.slope)
    return evaluate(side, duals, numbers).slopes.get(own.slope, ar.number(0))


# Computations


def compute(
    computation: Computation, ar: Arithmetic, sides: Sides, inputs: Mapping[str, Any]
) -> Number | Fraction:
    """The value of a computation, given the sides of all equations, for inputs by name."""
    if computation.formula is None:
        return FUNCTIONS[computation.name](ar, **inputs)
    names = {r"\pi": "pi", **{key: key for key in (*inputs, *computation.premises)}}
    known = dict(inputs)
    for key, own in computation.premises.items():
        known[key] = _side(own, sides[own.equation], ar, known, names)
    return _value(computation.formula, ar, known, names)


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


@dataclass(frozen=True, slots=True)
class Check:
    """One step of a derivation: what must hold, and whether it does.

    `factor` is the number by which the printed side differs from the derived one, where it is
    nothing but a number.
    """

    says: str
    holds: bool
    factor: Fraction | None = None


def derive(
    equation: Equation, sides: Sides, written: Mapping[str, str], symbols: Iterable[str]
) -> Iterator[Check]:
    """Every check of one equation, given the sides of all, one by one.

    `written` maps what the report writes to a symbol's name. Raises ZeroDivisionError, ValueError
    or EquationError where what is printed makes no sense there.
    """
    field = Ratios([symbol for symbol in symbols if symbol != "pi"])
    names, known = {**written, **{key: key for key in equation.premises}}, field.symbols
    for check in equation.checks:
        if check.equals[0] in "<>":
            yield Check(check.says, _is_so(check, sides[equation.id][check.side], field))
            continue
        named = {key: own for key, own in equation.premises.items() if key in check.equals}
        premises = {
            key: _side(own, sides[own.equation], field, known, names) for key, own in named.items()
        }
        printed = _side(check, sides[equation.id], field, known, names)
        derived = _value(check.equals, field, {**known, **premises}, names)
        holds = printed == derived
        factor = None if holds or derived == 0 else (printed / derived).constant
        yield Check(check.says, holds, factor)


def _is_so(check: Condition, side: Node, field: Ratios) -> bool:
    """Whether a side is above or below a number, at the numbers put in and all others at 1."""
    put = {symbol: float(text) for symbol, text in check.put.items()}
    value = evaluate(side, Floats(), {**dict.fromkeys(field.symbols, 1.0), **put})
    bound = float(check.equals[1:])
    return bool(value < bound if check.equals[0] == "<" else value > bound)
