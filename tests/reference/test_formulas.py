"""Equations and computations are read, evaluated, checked and shown as the report prints them."""

import re
from fractions import Fraction as F
from inspect import signature
from math import prod
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from kept import kept, said

from reference.arithmetic import Floats, Reals
from reference.enclosure import enclose
from reference.equations import MATHML, Node, dimension, evaluate, read_expression, rendered
from reference.formulas import FUNCTIONS
from reference.ledger import Claim, load
from reference.scheme import Scheme
from reference.units import unit_dimension

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


@kept("reference/kept.txt", "Expressions: as they are shown, and their value for a = 5, b = 7")
def test_what_is_read_and_where_brackets_stand(question: str, answer: str) -> None:
    def shown() -> str:
        node = read_expression(question, LETTERS)
        text = rendered(node, {name: written for written, name in LETTERS.items()})
        return f"{text} = {value(node, a=5.0, b=7.0, x=2.0):.12g}"

    assert said(shown) == answer


@kept("reference/kept.txt", "Expressions: what they measure")
def test_dimensions_of_expressions(question: str, answer: str) -> None:
    tree = read_expression(question, LEDGER.written)
    assert said(lambda: dimension(tree, LEDGER.dimensions)) == answer


# Each computation of the ledger: its inputs, its units, its value

COMPUTED = [claim for claim in LEDGER.claims.values() if claim.is_computed]


def test_every_computation_is_a_formula_or_a_function_and_computes_something() -> None:
    computations = LEDGER.computations
    assert len(computations) == len(LEDGER.computation)
    assert FUNCTIONS.keys() == {name for name, own in computations.items() if own.formula is None}
    for name, function in FUNCTIONS.items():
        names = signature(function).parameters
        assert computations[name].by_row == ("row" in names)
        assert computations[name].by_scheme == ("scheme" in names)
    assert not [own for own in computations.values() if own.summary.endswith(".")]
    used = {own.name for claim in LEDGER.claims.values() for own in claim.computations.values()}
    assert computations.keys() == used


def in_other_units(unit: str) -> float:
    """The factor to units that are 1/2 kg, 1/3 m and 1/5 s."""
    powers = unit_dimension(unit).powers
    return prod(size ** float(power) for size, power in zip((2, 3, 5), powers, strict=True))


@pytest.mark.parametrize("claim", LEDGER.claims.values(), ids=lambda claim: claim.id)
def test_a_computation_takes_the_claims_inputs_and_gives_its_unit(claim: Claim) -> None:
    """With every input in other units, the result is the same quantity in these units."""
    point = {name: float(LEDGER.value(name)) for name in claim.entries}
    changed = {name: x * in_other_units(LEDGER.unit(name)) for name, x in point.items()}
    for reading, own in claim.computations.items():
        texts = [text for premise in own.premises.values() for text in premise.put.values()]
        named = set(re.findall(r"\w+", " ".join([own.formula or "", *texts])))
        assert own.formula is None or named >= claim.inputs.keys()
        function = LEDGER.function(claim, reading=reading)
        expected = float(function(Floats(), **point)) * in_other_units(claim.unit)
        assert float(function(Floats(), **changed)) == pytest.approx(expected, rel=1e-9, abs=0)


@pytest.mark.parametrize("claim", COMPUTED, ids=lambda claim: claim.id)
def test_reals_lie_within_narrow_intervals(claim: Claim) -> None:
    ar = Reals(50)
    point = {name: LEDGER.value(name) for name in claim.entries}
    for reading in claim.computations:
        for scheme in Scheme if claim.by_scheme else (Scheme.PUBLISHED,):
            function = LEDGER.function(claim, reading=reading, scheme=scheme)
            real = function(ar, **{name: ar.number(x) for name, x in point.items()})
            value = real if isinstance(real, F) else F(*real.as_integer_ratio())
            low, high = enclose(function, {name: (x, x) for name, x in point.items()}).ends
            assert low <= value <= high
            # Of 30 digits, the sheet's many rows and the verified root's margin leave 15.
            assert high - low <= abs(value) * F(1, 10**15)
