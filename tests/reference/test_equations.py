"""The printed equations are read, evaluated, checked and shown as the report prints them."""

import math
import re
from fractions import Fraction as F
from typing import Any
from xml.etree import ElementTree as ET

import pytest

from reference.arithmetic import Floats
from reference.equations import (
    MATHML,
    EquationError,
    Node,
    dimension,
    evaluate,
    read_equation,
    read_expression,
    rendered,
)
from reference.ledger import load
from reference.units import DimensionError

LEDGER = load()
VALUES = {
    name: F(7 + 3 * k, 5 + 2 * k) if name != "n" else F(2) for k, name in enumerate(LEDGER.symbols)
}
"""A number above 1 for every symbol; n is an exponent, and so a Fraction."""


def value(node: Node, **more: Any) -> float:
    numbers = {name: number if name == "n" else float(number) for name, number in VALUES.items()}
    return float(evaluate(node, Floats(), {**numbers, **more}))


def symbols_in(node: Node) -> set[str]:
    own = {node.name} if node.kind == "symbol" else set()
    return own.union(*map(symbols_in, node.parts))


def test_no_equation_is_left_out() -> None:
    displays = {equation.place.equation for equation in LEDGER.equations.values()}
    # Eqs. 4 and 17 print numbers only: they are claims.
    assert displays == {None, *map(str, range(1, 17)), "A-1", "A-2", "A-3"} - {"4"}


@pytest.mark.parametrize("name", LEDGER.equations)
def test_what_is_shown_reads_back_the_same(name: str) -> None:
    written = {symbol: entry.written[0] for symbol, entry in LEDGER.symbols.items()}
    for side in LEDGER.sides[name]:
        again = read_expression(rendered(side, written).replace("ln", r"\ln"), LEDGER.written)
        assert value(again) == pytest.approx(value(side), rel=1e-14)
        names = {name: entry.shown for name, entry in LEDGER.symbols.items()}
        text = rendered(side, names, MATHML)
        text = re.sub("<msub><mi>(.+?)</mi><mi>(.+?)</mi></msub>", r"<mi>\1_\2</mi>", text)
        mathml = ET.fromstring(f"<math>{text}</math>")
        shown = [leaf.text for leaf in mathml.iter("mi")]
        expected = {LEDGER.symbols[symbol].shown for symbol in symbols_in(side)}
        assert set(shown) - {"ln"} == expected
        fractions = list(mathml.iter("mfrac")) + list(mathml.iter("msup"))
        assert all(len(part) == 2 for part in fractions)


LETTERS = {letter: letter for letter in "abdx"} | {r"\pi": "pi"}
a, b, x = 5.0, 7.0, 2.0
"""The values of the letters in the expressions below."""


@pytest.mark.parametrize(
    ("text", "shown", "expected"),
    [
        ("2a/3b", "(2 a)/(3 b)", 2 * a / (3 * b)),
        ("2 a/3 b", "(2 a)/3 b", 2 * a / 3 * b),
        ("a / b / 2", "a/b/2", a / b / 2),
        ("a/b a/b", "(a/b a)/b", a / b * a / b),
        ("a/(b + 1) 2", "a/(b + 1) 2", a / (b + 1) * 2),
        ("-a b", "-a b", -a * b),
        ("a - b", "a - b", a - b),
        ("2(a + b)", "2 (a + b)", 2 * (a + b)),
        ("a^2b", "a^2 b", a**2 * b),
        ("a^{2} b", "a^2 b", a**2 * b),
        ("a^2 b", "a^2 b", a**2 * b),
        ("(a b)^2", "(a b)^2", (a * b) ** 2),
        ("(a^2)^{1/2}", "(a^2)^(1/2)", a),
        ("a^{-1}", "a^(-1)", 1 / a),
        ("a (-b)", "a (-b)", -a * b),
        ("a - b (a + b)", "a - b (a + b)", a - b * (a + b)),
        ("a - (b - x) + (-a + b)", "a - (b - x) + (-a + b)", a - (b - x) + (-a + b)),
        ("-(a - b)", "-(a - b)", b - a),
        ("a/(b a)", "a/(b a)", a / (b * a)),
        (r"\frac{1}{2} a", "1/2 a", a / 2),
        (r"\frac{a + b}{a b}", "(a + b)/(a b)", (a + b) / (a * b)),
        (r"\frac{a b}{2}", "(a b)/2", a * b / 2),
        (r"\ln(a)", "ln(a)", math.log(a)),
        (r"\ln(a + b)", "ln(a + b)", math.log(a + b)),
        (r"\ln a b", "ln(a) b", math.log(a) * b),
        (r"2\ln(a)^2", "2 ln(a^2)", 2 * math.log(a**2)),
        (r"\log(a)", "log(a)", math.log10(a)),
        (r"a &+ \quad b", "a + b", a + b),
        ("1.5 a", "1.5 a", 1.5 * a),
        ("a/0.5", "a/0.5", a / 0.5),
        (r"\pi a", r"\pi a", math.pi * a),
    ],
)
def test_an_expression_is_read_as_it_is_printed(text: str, shown: str, expected: float) -> None:
    node = read_expression(text, LETTERS)
    assert rendered(node, {name: written for written, name in LETTERS.items()}) == shown
    # A few roundings of doubles.
    assert value(node, a=a, b=b, x=x) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a + c", "cannot read 'c' at the end of 'a + c'"),
        ("a +", "something is missing at the end of 'a +'"),
        ("(a + b", "')' is missing in '(a + b'"),
        ("a)", "cannot read ')' at the end of 'a)'"),
        (r"\frac{a}", r"'{' is missing in '\\frac{a}'"),
        (r"\ln", r"something is missing at the end of '\\ln'"),
        ("a^", "something is missing at the end of 'a^'"),
        ("a ^2", "cannot read '^2' at the end of 'a ^2'"),
        ("a^ 2", "cannot read '2' at the end of 'a^ 2'"),
        ("", "something is missing at the end of ''"),
        (r"\lnx(a)", r"cannot read '\\lnx(a)' at the end of '\\lnx(a)'"),
        (r"\crater(a)", r"cannot read '\\crater(a)' at the end of '\\crater(a)'"),
    ],
)
def test_what_cannot_be_read_is_refused(text: str, message: str) -> None:
    with pytest.raises(EquationError, match=f"^{re.escape(message)}$"):
        read_expression(text, LETTERS)


@pytest.mark.parametrize("text", ["a^{x}", "a^{(a + b)}", r"a^{\ln(2)}", "a^{2^{1/2}}"])
def test_an_exponent_must_be_a_rational_number(text: str) -> None:
    node = read_expression(text, LETTERS)
    with pytest.raises(EquationError, match=r"^an exponent is no rational number$"):
        value(node, a=a, b=b, x=x)


def test_a_symbol_without_a_value_is_named() -> None:
    node = read_expression("a + d", LETTERS)
    with pytest.raises(EquationError, match=r"^the symbol d has no value here$"):
        value(node, a=a)


def test_an_equation_has_two_sides_or_more() -> None:
    assert [side.name for side in read_equation("a = b = a,", LETTERS)] == ["a", "b", "a"]
    with pytest.raises(EquationError, match=r"^'a \+ b' has no equals sign$"):
        read_equation("a + b", LETTERS)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (r"\rho_t v^2", "kg m^-1 s^-2"),
        ("(D/v)^{1/2}", "s^1/2"),
        ("-x/D", "a pure number"),
    ],
)
def test_an_expression_measures_something(text: str, expected: str) -> None:
    node = read_expression(text, LEDGER.written)
    assert str(dimension(node, LEDGER.dimensions)) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x + R^2", "m and m^2 are added"),
        (r"\ln(V/R_t)", "the logarithm of kg^-1 m^2 s is taken"),
        (r"\rho_t v^2 + R_t/D", "kg m^-1 s^-2 and kg m^-2 s^-2 are added"),
    ],
)
def test_what_measures_nothing_is_refused(text: str, message: str) -> None:
    node = read_expression(text, LEDGER.written)
    with pytest.raises(DimensionError, match=f"^{re.escape(message)}$"):
        dimension(node, LEDGER.dimensions)
