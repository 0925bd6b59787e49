r"""The report's equations, read from its text as they are printed.

Each side of an equation is read into a tree of `Node`s. The same tree is evaluated in any
arithmetic (`evaluate`), checked for consistent dimensions (`dimension`), and shown as text or
MathML (`rendered`), so that all of this is done with what the report prints.

A product written without a space binds more tightly than a fraction bar; one written with a space,
or with a sign of multiplication, binds as tightly as the bar, from left to right. So "2E_t/3Y_t" is
(2 E_t)/(3 Y_t), "1/3 \pi X^2" is (1/3) pi X^2, and "L/D \rho_p/\rho_t" is ((L/D) rho_p)/rho_t.
"""

import re
from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import lru_cache, reduce
from operator import add, mul
from typing import Any

import msgspec

from reference.arithmetic import InexactError, Rationals
from reference.units import Dimension, DimensionError


class EquationError(ValueError):
    """The text cannot be read as an equation; the message says where it stops making sense."""


class NoValueError(EquationError, ArithmeticError):
    """The equation cannot be evaluated: a symbol has no value, or an exponent no rational one."""


class Node(msgspec.Struct, frozen=True):
    """An expression.

    Its `kind` is "number" (with its `value`, and its text as `name`), "symbol" (with its `name`),
    or the operation on its `parts`: "sum", "negative", "product", "quotient", "power", or one of
    LOGARITHMS.
    """

    kind: str
    parts: tuple["Node", ...] = ()
    name: str = ""
    value: Fraction = Fraction(0)


Sides = Mapping[str, tuple[Node, ...]]
"""The sides of every printed equation, by the equation's id."""


LOGARITHMS = ("ln", "log")
"""The named functions of the report, natural and to base 10; log stands in misprints of ln."""


_OPERATORS = {
    "+": ("sum", 1), "-": ("sum", 1), "/": ("quotient", 2), " ": ("product", 2),
    "": ("product", 3), "^": ("power", 4),
}  # fmt: skip
"""The kind of node that each operator makes, and how tightly it binds.

A product is written with a space or without one.
"""
_FACTORS = {"number", "symbol", "function", "fraction"}


class _Reader:
    """A parser of one expression, by the precedence of its operators."""

    def __init__(self, text: str, symbols: Mapping[str, str]) -> None:
        self.text, self.symbols, self.at = text, symbols, 0
        longest_first = sorted(symbols, key=len, reverse=True)  # "k_t" before "k"
        token = (
            r"(?P<space>(?:\s|\\quad|&)*)(?:"
            rf"(?P<symbol>{'|'.join([*map(re.escape, longest_first), '(?!)'])})"
            r"|(?P<number>\d+(?:\.\d+)?)"
            rf"|(?P<function>\\(?:{'|'.join(LOGARITHMS)})(?![a-zA-Z]))"
            r"|(?P<fraction>\\frac(?![a-zA-Z]))"
            r"|(?P<times>\\(?:times|cdot)(?![a-zA-Z])|[*×·])"
            r"|(?P<sign>[-\N{MINUS SIGN}+/^(){}])"
            r"|(?P<end>\Z)|(?P<unreadable>.))"
        )
        self.tokens = list(re.finditer(token, text))

    @property
    def next(self) -> tuple[str, str, bool]:
        """The kind and the text of the next token, and whether there is a space before it."""
        token = self.tokens[self.at]
        kind = str(token.lastgroup)
        text = "-" if token[kind] == "\N{MINUS SIGN}" else token[kind]
        return kind, text, bool(token["space"])

    def error(self) -> EquationError:
        """Return the error that the next token cannot stand there."""
        rest = self.text[self.tokens[self.at].end("space") :]
        problem = f"cannot read {rest!r}" if rest else "something is missing"
        return EquationError(f"{problem} at the end of {self.text!r}")

    def within(self, opening: str, closing: str) -> Node:
        self.expect(opening)
        node = self.expression()
        self.expect(closing)
        return node

    def expect(self, sign: str) -> None:
        if self.next[:2] != ("sign", sign):
            raise EquationError(f"{sign!r} is missing in {self.text!r}")
        self.at += 1

    def expression(self, binding: int = 0) -> Node:
        """Read an expression up to the first operator that binds no more tightly than `binding`."""
        if binding == 0 and self.next[:2] == ("sign", "-"):
            self.at += 1
            left = Node("negative", (self.expression(1),))
        else:
            left = self.operand("(")
        while (operator := self.operator()) is not None and _OPERATORS[operator][1] > binding:
            kind, tightness = _OPERATORS[operator]
            self.at += self.next[0] in ("sign", "times") and self.next[1] != "("
            right = self.operand("{(") if operator == "^" else self.expression(tightness)
            if operator == "-":
                right = Node("negative", (right,))
            chained = kind in ("sum", "product") and left.kind == kind
            left = Node(kind, (*(left.parts if chained else (left,)), right))
        return left

    def operator(self) -> str | None:
        """Return the next operator, which is a product before a factor; None if there is none."""
        kind, text, spaced = self.next
        if kind in _FACTORS or text == "(":
            return " " if spaced else ""
        if kind == "times":
            return " "
        return text if text in ("+", "-", "/") or (text == "^" and not spaced) else None

    def operand(self, brackets: str) -> Node:
        """Read an expression in brackets that open with one of these signs, or a single factor."""
        kind, text, spaced = self.next
        if spaced and "{" in brackets:  # no space stands before an exponent
            raise self.error()
        if text and text in brackets:
            return self.within(text, {"(": ")", "{": "}"}[text])
        if kind not in _FACTORS:
            raise self.error()
        self.at += 1
        if kind == "number":
            return Node("number", name=text, value=Fraction(text))
        if kind == "symbol":
            return Node("symbol", name=self.symbols[text])
        if kind == "function":
            return Node(text[1:], (self.expression(_OPERATORS[""][1]),))
        return Node("quotient", (self.within("{", "}"), self.within("{", "}")))


def read_expression(text: str, symbols: Mapping[str, str]) -> Node:
    r"""Read one side of an equation. Raises EquationError for a text that is none.

    `symbols` maps each text that stands for a symbol to the symbol's name.

    >>> rendered(read_expression(r"2E_t/3Y_t", {"E_t": "E", "Y_t": "Y"}), {"E": "E", "Y": "Y"})
    '(2 E)/(3 Y)'
    """
    return _read_expression(text, tuple(symbols.items()))


@lru_cache(2048)
def _read_expression(text: str, symbols: tuple[tuple[str, str], ...]) -> Node:
    """Cached, as the audit tries the same misprint for every claim that uses the equation."""
    reader = _Reader(text, dict(symbols))
    node = reader.expression()
    if reader.next[0] != "end":
        raise reader.error()
    return node


def read_equation(text: str, symbols: Mapping[str, str]) -> tuple[Node, ...]:
    r"""Read the sides of an equation, except an empty one, as where the report omits the first.

    >>> len(read_equation(r"F_r = \pi a^2 R_t", {w: w for w in ("F_r", r"\pi", "a", "R_t")}))
    2
    """
    if "=" not in text:
        raise EquationError(f"{text!r} has no equals sign")
    sides = (side.rstrip(" &,.\n") for side in text.split("="))
    return tuple(read_expression(side, symbols) for side in sides if side)


def evaluate(node: Node, ar: Any, values: Mapping[str, Any]) -> Any:
    r"""Return the value of an expression in an arithmetic, given the values of its symbols in SI.

    A Fraction or an integer among the values is converted to the arithmetic. A symbol in an
    exponent needs a Fraction.
    Raises NoValueError for a symbol without a value, and for an exponent that is not rational.

    >>> from reference.arithmetic import Reals
    >>> expression = read_expression(r"7/3 \ln(\alpha)", {r"\alpha": "alpha"})
    >>> print(evaluate(expression, Reals(15), {"alpha": Reals(15).number(2)}))
    1.61734342130654
    """
    if node.kind == "symbol":
        known = ar.pi if node.name == "pi" else values.get(node.name)
        if known is None:
            raise NoValueError(f"the symbol {node.name} has no value here")
        return ar.number(known) if type(known) in _EXACT else known
    if node.kind == "number":
        return ar.number(node.value)
    if node.kind == "power":
        base, power = node.parts[0], _exponent(node.parts[1], values)
        if base.kind == "power":  # (b^p)^q = b^(p q), as every base here is positive
            base, power = base.parts[0], power * _exponent(base.parts[1], values)
        return ar.power(evaluate(base, ar, values), power)
    return _OPERATIONS[node.kind](ar, *[evaluate(part, ar, values) for part in node.parts])


_EXACT = (Fraction, int)
_OPERATIONS: Mapping[str, Callable[..., Any]] = {
    "negative": lambda _, x: -x,
    "sum": lambda _, *terms: reduce(add, terms),
    "product": lambda _, *factors: reduce(mul, factors),
    "quotient": lambda _, x, y: x / y,
    "ln": lambda ar, x: ar.log(x),
    "log": lambda ar, x: ar.log(x) / ar.log(ar.number(10)),
}


def _exponent(node: Node, values: Mapping[str, Any]) -> Fraction:
    """Return the value of an exponent, whose symbols must have Fractions as values."""
    known = {name: value for name, value in values.items() if isinstance(value, Fraction)}
    try:
        return Fraction(evaluate(node, Rationals(), known))
    except (EquationError, InexactError) as error:
        raise NoValueError("an exponent is no rational number") from error


class Equations:
    r"""The printed equations as functions of their symbols.

    >>> from reference.arithmetic import Floats
    >>> names = {"D": "D", "R": "R"}
    >>> Equations({"diameter": read_equation("D = 2R", names)})["diameter"](Floats(), R=1.5)
    3.0
    """

    def __init__(self, sides: Sides) -> None:
        self._sides = sides

    def __getitem__(self, name: str) -> Callable[..., Any]:
        """Return the last side of an equation as a function of an arithmetic and its symbols."""
        side = self._sides[name][-1]
        return lambda ar, **symbols: evaluate(side, ar, symbols)


class _Dimensions:
    """An arithmetic of dimensions, in which every number is dimensionless."""

    pi = Dimension()
    number = staticmethod(lambda _: Dimension())
    power = staticmethod(pow)

    def log(self, x: Dimension) -> Dimension:
        if x != Dimension():
            raise DimensionError(f"the logarithm of {x} is taken")
        return x


def dimension(node: Node, units: Mapping[str, Dimension | Fraction]) -> Dimension:
    """Return an expression's dimension from those of its symbols and the values of its exponents.

    Raises DimensionError for a sum of different dimensions or the logarithm of a dimension.
    """
    result: Dimension = evaluate(node, _Dimensions(), units)
    return result


class Notation(msgspec.Struct, frozen=True):
    """The markup of expressions; by default, plain text.

    `symbol` also formats numbers, and `row` what is to be kept together. `stroke` is how tightly a
    numerator and a denominator must bind to need no brackets.
    """

    symbol: Callable[[str], str] = str
    bracket: Callable[[str], str] = "({})".format
    fraction: Callable[[str, str], str] = "{}/{}".format
    power: Callable[[str, str], str] = "{}^{}".format
    call: Callable[[str, str], str] = "{}({})".format
    row: Callable[[str], str] = str
    plus: str = " + "
    less: str = " - "
    times: str = " "
    stroke: tuple[int, int] = (3, 4)


def _mathml_symbol(shown: str) -> str:
    """Return a number or a symbol in MathML; what follows an underscore is a subscript."""
    if shown[0].isdigit():
        return f"<mn>{shown}</mn>"
    name, _, below = shown.partition("_")
    return f"<msub><mi>{name}</mi><mi>{below}</mi></msub>" if below else f"<mi>{name}</mi>"


PLAIN = Notation()
MATHML = Notation(
    symbol=_mathml_symbol,
    bracket="<mrow><mo>(</mo>{}<mo>)</mo></mrow>".format,
    fraction="<mfrac>{}{}</mfrac>".format,
    power="<msup>{}{}</msup>".format,
    call="<mrow><mi>{}</mi><mo>(</mo>{}<mo>)</mo></mrow>".format,
    row="<mrow>{}</mrow>".format,
    plus="<mo>+</mo>",
    less="<mo>\N{MINUS SIGN}</mo>",
    times='<mo lspace="0" rspace="0.17em">\N{INVISIBLE TIMES}</mo>',  # "m dv/dt", not "mdv/dt"
    stroke=(0, 0),
)
_TIGHTNESS = {"sum": 0, "negative": 1, "product": 2, "quotient": 3, "power": 4}


def rendered(node: Node, shown: Mapping[str, str], notation: Notation = PLAIN) -> str:
    """Return an expression as text in a notation; `shown` maps each symbol's name to its text.

    >>> rendered(read_expression("x/(D + 0.5)", {"x": "x", "D": "D"}), {"x": "X", "D": "8"})
    'X/(8 + 0.5)'
    """

    def part(child: Node, least: int) -> str:
        inner = rendered(child, shown, notation)
        loose = _TIGHTNESS.get(child.kind, 5) < least
        return notation.bracket(inner) if loose else inner

    def added(term: Node) -> str:
        if term.kind == "negative":
            return notation.less + part(term.parts[0], 2)
        return notation.plus + part(term, 1)

    parts = node.parts
    match node.kind:
        case "number" | "symbol":
            return notation.symbol(node.name if node.kind == "number" else shown[node.name])
        case "negative":
            return notation.row(notation.less.strip() + part(parts[0], 2))
        case "sum":
            return notation.row(part(parts[0], 0) + "".join(map(added, parts[1:])))
        case "product":
            return notation.row(notation.times.join(part(child, 2) for child in parts))
        case "quotient":
            return notation.fraction(*map(part, parts, notation.stroke))
        case "power":
            return notation.power(part(parts[0], 5), part(parts[1], notation.stroke[1]))
    return notation.call(node.kind, part(parts[0], 0))
