"""The printed equations are read, calculated, checked and shown as they stand in the report."""

import math
import re
from fractions import Fraction as F
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.arithmetic import Floats, Rationals
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
"""A number above 1 for every symbol; n is an exponent."""
PI = math.pi


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


# How spaces bind

READ = {
    "2a/3b": 2 * 5 / (3 * 7),
    "2 a/3 b": 2 * 5 / 3 * 7,
    "a / b / 2": 5 / 7 / 2,
    "a/b a/b": (5 / 7) ** 2,
    "a/(b + 1) 2": 5 / 8 * 2,
    "-a b": -35,
    "a - b": -2,
    "2(a + b)": 24,
    "a^2b": 25 * 7,
    "a^{2} b": 25 * 7,
    "(a^2)^{1/2}": 5,
    "a^{-1}": 0.2,
    r"\frac{1}{2} a": 2.5,
    r"\frac{a + b}{a b}": 12 / 35,
    r"\ln(a)": math.log(5),
    r"\ln a b": math.log(5) * 7,
    r"2\ln(a)^2": 2 * math.log(25),  # the power belongs to what the logarithm is taken of
    r"\log(a)": math.log10(5),
    "a &+ \\quad b": 12,
    "1.5 a": 7.5,
    r"\pi a": PI * 5,
}


@pytest.mark.parametrize("text", READ)
def test_how_text_is_read(text: str) -> None:
    names = {"a": "a", "b": "b", r"\pi": "pi"}
    node = read_expression(text, names)
    assert value(node, a=5.0, b=7.0) == pytest.approx(READ[text], rel=1e-14)


SHOWN = {
    "a^2 b": "a^2 b",
    "(a b)^2": "(a b)^2",
    "(a^2)^{1/2}": "(a^2)^(1/2)",
    "a (-b)": "a (-b)",
    "a - b (a + b)": "a - b (a + b)",
    "a/(b a)": "a/(b a)",
    r"\frac{a b}{2}": "(a b)/2",
    r"\ln(a + b)": "ln(a + b)",
}


@pytest.mark.parametrize("text", SHOWN)
def test_brackets_stand_where_they_are_needed_and_nowhere_else(text: str) -> None:
    names = {"a": "a", "b": "b"}
    assert rendered(read_expression(text, names), names) == SHOWN[text]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a + c", "cannot read 'c'"),
        ("a +", "something is missing"),
        ("(a + b", r"'\)' is missing"),
        ("a)", r"cannot read '\)' at the end"),
        (r"\frac{a}", "'{' is missing"),
        (r"\ln", "something is missing"),
        ("a^", "something is missing"),
        ("a ^2", r"cannot read '\^2' at the end"),
        ("a^ 2", "cannot read '2' at the end"),
        ("", "something is missing"),
        (r"\lnx(a)", "cannot read"),
    ],
)
def test_what_is_no_expression_is_refused(text: str, message: str) -> None:
    with pytest.raises(EquationError, match=message):
        read_expression(text, {"a": "a", "b": "b"})


def test_what_is_no_equation_is_refused() -> None:
    names = {"a": "a", "b": "b"}
    with pytest.raises(EquationError, match="no equals sign"):
        read_equation("a + b", names)
    assert [side.name for side in read_equation("a = b = a,", names)] == ["a", "b", "a"]
    for exponent in ("x", "(a + b)", r"\ln(2)", "2^{1/2}"):
        with pytest.raises(EquationError, match="not a number"):
            value(read_expression(f"a^{{{exponent}}}", {**names, "x": "x"}), a=1.0, x=2.0)
    with pytest.raises(EquationError, match="c has no value"):
        value(Node("symbol", name="c"))


@st.composite
def trees(draw: st.DrawFn, depth: int = 4) -> Node:
    kinds = ["number", "symbol"] + ["sum", "product", "quotient", "negative", "power"] * (depth > 0)
    kind = draw(st.sampled_from(kinds))
    if kind == "number":
        return Node("number", value=F(draw(st.integers(1, 9))))
    if kind == "symbol":
        return Node("symbol", name=draw(st.sampled_from(["x", "rho_t"])))
    count = {"sum": 3, "product": 2, "quotient": 2, "negative": 1, "power": 1}[kind]
    parts = [draw(trees(depth - 1)) for _ in range(count)]
    if kind == "power":
        parts.append(Node("number", value=F(draw(st.integers(1, 3)))))
    return Node(kind, tuple(parts))


@given(trees())
def test_any_expression_reads_back_as_it_is_shown(tree: Node) -> None:
    names = {"x": "x", "rho_t": r"\rho_t"}
    at = {"x": F(3, 7), "rho_t": F(11, 5)}
    again = read_expression(
        rendered(tree, names), {written: name for name, written in names.items()}
    )
    try:
        expected = evaluate(tree, Rationals(), at)
    except ZeroDivisionError:
        return
    assert evaluate(again, Rationals(), at) == expected
    ET.fromstring(rendered(tree, names, MATHML))


def test_a_number_is_replaced_where_it_is_written() -> None:
    for claim, expected in (
        ("eq11-numerator", r"\alpha = (\frac{5}{2}E_t/3Y_t)^{1/3}"),
        ("eq11-power", r"\alpha = (2E_t/3Y_t)^{\frac{5}{2}}"),
    ):
        assert claim in LEDGER.constants_of("eq11")
        assert LEDGER.printed_text("eq11", {claim: F(5, 2)}) == expected


# Dimensions


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x + R^2", r"m and m\^2 are added"),
        (r"\ln(V/R_t)", "the logarithm of .* is taken"),
        (r"\rho_t v^2 + R_t/D", "are added"),
    ],
)
def test_nonsense_is_seen_by_its_dimensions(text: str, message: str) -> None:
    with pytest.raises(DimensionError, match=message):
        dimension(read_expression(text, LEDGER.written), LEDGER.dimensions)


@pytest.mark.parametrize(
    ("text", "expected"),
    [(r"\rho_t v^2", "kg m^-1 s^-2"), ("(D/v)^{1/2}", "s^1/2"), ("-x/D", "a pure number")],
)
def test_dimensions_of_expressions(text: str, expected: str) -> None:
    assert str(dimension(read_expression(text, LEDGER.written), LEDGER.dimensions)) == expected
