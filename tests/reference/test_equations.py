"""The printed equations are read, calculated, checked and shown as they stand in the report."""

import re
from fractions import Fraction as F
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st
from kept import kept, said

from reference.arithmetic import Floats, Rationals
from reference.equations import (
    MATHML,
    Node,
    dimension,
    evaluate,
    read_expression,
    rendered,
)
from reference.ledger import load

LEDGER = load()
VALUES = {
    name: F(7 + 3 * k, 5 + 2 * k) if name != "n" else F(2) for k, name in enumerate(LEDGER.symbols)
}
"""A number above 1 for every symbol; n is an exponent."""


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


# How text is read

LETTERS = {letter: letter for letter in "abdx"} | {r"\pi": "pi"}


@kept("reference/kept.txt", "Expressions: as they are shown, and their value for a = 5, b = 7")
def test_what_is_read_and_where_brackets_stand(question: str, answer: str) -> None:
    def shown() -> str:
        node = read_expression(question, LETTERS)
        text = rendered(node, {name: written for written, name in LETTERS.items()})
        return f"{text} = {value(node, a=5.0, b=7.0, x=2.0):.12g}"

    assert said(shown) == answer


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


@kept("reference/kept.txt", "Expressions: what they measure")
def test_dimensions_of_expressions(question: str, answer: str) -> None:
    tree = read_expression(question, LEDGER.written)
    assert said(lambda: dimension(tree, LEDGER.dimensions)) == answer
