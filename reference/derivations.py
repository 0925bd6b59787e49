"""What each printed equation follows from, carried out exactly, check by check of the ledger.

A check compares two quotients of polynomials, made from the equation as it is printed and from what
it must follow from: they are equal for all values of the symbols or they are not. To integrate, a
printed solution is differentiated and put in. Premises are geometry (a plane cuts a sphere),
Newton's law, Bernoulli's, and earlier equations of the report where it says that it uses them.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from reference.arithmetic import Dual, Duals, Floats, Number, Ratio, Ratios
from reference.equations import Node, Sides, evaluate, read_expression
from reference.ledger import Condition, Ledger, Side


@dataclass(frozen=True, slots=True)
class Check:
    """One step of a derivation: what must hold, and whether it does.

    `factor` is the number by which the printed side differs from the derived one, where it is
    nothing but a number.
    """

    says: str
    holds: bool
    factor: Fraction | None = None


def derive(ledger: Ledger, name: str, sides: Sides) -> Iterator[Check]:
    """Every check of one equation, given the sides of all, one by one.

    Raises ZeroDivisionError, ValueError or EquationError where what is printed makes no sense
    there.
    """
    equation, field = ledger.equations[name], Ratios([s for s in ledger.symbols if s != "pi"])
    names = (*ledger.written.items(), *((key, key) for key in equation.premises))

    def value(text: str, known: Mapping[str, Ratio]) -> Number:
        return evaluate(_read(text, names), field, known)

    def side_of(number: str, own: Side) -> Number:
        side = sides[number][own.side]
        put = {symbol: value(text, field.symbols) for symbol, text in own.put.items()}
        values = {**field.symbols, **put}
        return (
            _slope(side, own.slope, values, field) if own.slope else evaluate(side, field, values)
        )

    for check in equation.checks:
        if check.equals[0] in "<>":
            yield Check(check.says, _is_so(check, sides[name][check.side], field))
            continue
        named = {key: own for key, own in equation.premises.items() if key in check.equals}
        premises = {key: side_of(own.equation, own) for key, own in named.items()}
        printed = side_of(name, check)
        derived = value(check.equals, {**field.symbols, **premises})
        holds = printed == derived
        factor = None if holds or derived == 0 else (printed / derived).constant
        yield Check(check.says, holds, factor)


@lru_cache(512)
def _read(text: str, written: tuple[tuple[str, str], ...]) -> Node:
    return read_expression(text, dict(written))


def _is_so(check: Condition, side: Node, field: Ratios) -> bool:
    """Whether a side is above or below a number, at the numbers put in and all others at 1."""
    put = {symbol: float(text) for symbol, text in check.put.items()}
    value = evaluate(side, Floats(), {**dict.fromkeys(field.symbols, 1.0), **put})
    bound = float(check.equals[1:])
    return bool(value < bound if check.equals[0] == "<" else value > bound)


def _slope(side: Node, by: str, values: Mapping[str, Ratio], field: Ratios) -> Number:
    """The derivative of a side by one of its symbols."""
    duals = Duals(field)
    numbers = {name: Dual(ratio) for name, ratio in values.items()}
    numbers[by] = duals.variable(values[by], by)
    return evaluate(side, duals, numbers).slopes.get(by, field.number(0))
