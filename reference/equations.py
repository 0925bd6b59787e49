r"""The report's equations, read from its text as they are printed.

An equation becomes a tree (`Node`), so that what the report prints is what is computed, checked and
shown: in numbers of any arithmetic (`evaluate`), in dimensions (`dimension`), as text or MathML
(`rendered`).

How the text is read: a product written without a space binds before a fraction bar, one with a
space after it. So "2E_t/3Y_t" is (2 E_t)/(3 Y_t), "1/3 \pi X^2" is (1/3) pi X^2, and
"L/D \rho_p/\rho_t" is (L/D)(rho_p/rho_t).
"""

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache, reduce
from operator import add, mul
from typing import Any

from reference.arithmetic import Number


class EquationError(ValueError):
    """Text that cannot be read as an equation; says where it ends to make sense."""


@dataclass(frozen=True, slots=True)
class Node:
    """A part of an equation.

    `kind` is "number" (with `value`), "symbol" (with `name`), or what is done with `parts`: "sum",
    "negative", "product", "quotient", "power", "ln", "log". `span` tells from which character to
    which it is written in the equation.
    """

    kind: str
    parts: tuple["Node", ...] = ()
    name: str = ""
    value: Fraction = Fraction(0)
    span: tuple[int, int] = field(default=(0, 0), compare=False)


@cache
def _token(written: tuple[str, ...]) -> re.Pattern[str]:
    """What an expression is made of, with the symbols as they are written."""
    longest_first = sorted(written, key=len, reverse=True)  # "k_t" before "k"
    return re.compile(
        r"(?P<space>(?:\s|\\quad|&)+)"
        r"|(?P<number>\d+(?:\.\d+)?)"
        r"|(?P<function>\\(?:ln|log)(?![a-zA-Z]))"
        r"|(?P<fraction>\\frac(?![a-zA-Z]))"
        r"|(?P<sign>[-+/^(){}])"
        rf"|(?P<symbol>{'|'.join(map(re.escape, longest_first))})"
    )


class _Reader:
    """Reads one expression; `symbols` maps what the report writes to a symbol's name."""

    def __init__(self, text: str, symbols: Mapping[str, str], offset: int) -> None:
        self.text, self.symbols, self.offset = text, symbols, offset
        self.starts: list[int] = []
        self.tokens = list(self._tokens())
        self.place = 0

    def _tokens(self) -> Iterator[tuple[str, str]]:
        token, at = _token(tuple(self.symbols)), 0
        while at < len(self.text):
            match = token.match(self.text, at)
            if not match:
                raise EquationError(f"cannot read {self.text[at:]!r} in the equation {self.text!r}")
            self.starts.append(at)
            kind, at = str(match.lastgroup), match.end()
            yield kind, self.symbols[match[0]] if kind == "symbol" else match[0]

    def node(self, kind: str, first: int, *parts: Node, **more: Any) -> Node:
        """A node written from the token `first` to the last one taken."""
        last = self.place - 1
        while self.tokens[last][0] == "space":
            last -= 1
        end = self.starts[last + 1] if last + 1 < len(self.starts) else len(self.text)
        return Node(kind, parts, span=(self.offset + self.starts[first], self.offset + end), **more)

    def whole(self) -> Node:
        node = self.sum()
        if self.place < len(self.tokens):
            rest = "".join(text for _, text in self.tokens[self.place :])
            raise EquationError(f"cannot read {rest!r} at the end of {self.text!r}")
        return node

    def skip_space(self) -> bool:
        start = self.place
        while self.place < len(self.tokens) and self.tokens[self.place][0] == "space":
            self.place += 1
        return self.place > start

    def peek(self) -> tuple[str, str]:
        return self.tokens[self.place] if self.place < len(self.tokens) else ("end", "")

    def take(self, text: str) -> bool:
        """Whether this sign comes next, spaces before it aside; it is then taken."""
        start = self.place
        self.skip_space()
        if self.peek() == ("sign", text):
            self.place += 1
            return True
        self.place = start
        return False

    def expect(self, text: str) -> None:
        if not self.take(text):
            raise EquationError(f"{text!r} is missing in the equation {self.text!r}")

    def sum(self) -> Node:
        self.skip_space()
        first = self.place
        terms = [self.negative() if self.take("-") else self.product()]
        while True:
            if self.take("+"):
                terms.append(self.product())
            elif self.take("-"):
                terms.append(self.negative())
            else:
                return terms[0] if len(terms) == 1 else self.node("sum", first, *terms)

    def negative(self) -> Node:
        first = self.place - 1
        return self.node("negative", first, self.product())

    def product(self) -> Node:
        """Factors with spaces between them, or fraction bars, from left to right."""
        self.skip_space()
        first = self.place
        node = self.tight()
        while True:
            if self.take("/"):
                self.skip_space()
                node = self.node("quotient", first, node, self.tight())
                continue
            start = self.place
            self.skip_space()
            if not self.begins_factor():
                self.place = start
                return node
            node = self.multiplied(first, node, self.tight())

    def begins_factor(self) -> bool:
        kind, text = self.peek()
        return kind in ("number", "symbol", "function", "fraction") or (kind, text) == ("sign", "(")

    def tight(self) -> Node:
        """Factors without spaces between them."""
        first = self.place
        node = self.power()
        while self.begins_factor():
            node = self.multiplied(first, node, self.power())
        return node

    def multiplied(self, first: int, left: Node, right: Node) -> Node:
        factors = left.parts if left.kind == "product" else (left,)
        return self.node("product", first, *factors, right)

    def power(self) -> Node:
        first = self.place
        base = self.atom()
        if self.peek() != ("sign", "^"):
            return base
        self.place += 1
        if self.take("{"):
            exponent = self.sum()
            self.expect("}")
        else:
            exponent = self.atom()
        return self.node("power", first, base, exponent)

    def atom(self) -> Node:
        kind, text = self.peek()
        first, self.place = self.place, self.place + 1
        if kind == "number":
            return self.node("number", first, value=Fraction(text))
        if kind == "symbol":
            return self.node("symbol", first, name=text)
        if kind == "function":
            self.skip_space()
            return self.node(text[1:], first, self.power())
        if kind == "fraction":
            return self.node("quotient", first, self.braced(), self.braced())
        if (kind, text) == ("sign", "("):
            node = self.sum()
            self.expect(")")
            return node
        raise EquationError(f"the equation {self.text!r} breaks off or has {text!r} out of place")

    def braced(self) -> Node:
        self.expect("{")
        node = self.sum()
        self.expect("}")
        return node


def read_expression(text: str, symbols: Mapping[str, str], offset: int = 0) -> Node:
    r"""One side of an equation. Raises EquationError for what cannot be read.

    `symbols` maps what the report writes to a symbol's name; `offset` is the place of the text in
    the whole equation.

    >>> symbols_in(read_expression(r"(2E_t/3Y_t)^{1/3}", {"E_t": "E_t", "Y_t": "Y_t"}))
    ['E_t', 'Y_t']
    """
    return _Reader(text, symbols, offset).whole()


def read_equation(text: str, symbols: Mapping[str, str]) -> tuple[Node, ...]:
    r"""The sides of an equation; a first one that the report leaves out is left out here.

    >>> len(read_equation(r"F_r = \pi a^2 R_t", {w: w for w in ("F_r", r"\pi", "a", "R_t")}))
    2
    """
    sides = [match for match in re.finditer(r"[^=]+", text) if match[0].strip(" &,.\n")]
    if "=" not in text:
        raise EquationError(f"{text!r} has no equals sign")
    return tuple(read_expression(side[0].rstrip(" &,.\n"), symbols, side.start()) for side in sides)


def replaced(node: Node, span: tuple[int, int], value: Fraction) -> Node:
    """The expression with another number where it has the part that is written at the span."""
    if node.span == span:
        return Node("number", value=value, span=span)
    if not node.span[0] <= span[0] < span[1] <= node.span[1]:
        return node
    return replace(node, parts=tuple(replaced(part, span, value) for part in node.parts))


def symbols_in(node: Node) -> list[str]:
    """The names of its symbols, sorted."""
    names = {name for part in node.parts for name in symbols_in(part)}
    return sorted(names | ({node.name} if node.kind == "symbol" else set()))


def evaluate(node: Node, ar: Any, values: Mapping[str, Number]) -> Number:
    r"""The value of an expression in an arithmetic, for values of its symbols in SI units.

    >>> from reference.arithmetic import Reals
    >>> expression = read_expression(r"7/3 \ln(\alpha)", {r"\alpha": "alpha"})
    >>> print(evaluate(expression, Reals(15), {"alpha": Reals(15).number(2)}))
    1.61734342130654
    """

    def value(node: Node) -> Number:
        if node.kind == "number":
            return ar.number(node.value)
        if node.kind == "power":
            return _power(node, ar, values, value)
        if node.kind != "symbol":
            return _OPERATIONS[node.kind](ar, *map(value, node.parts))
        if node.name == "pi":
            return ar.pi
        if node.name not in values:
            raise EquationError(f"the symbol {node.name} has no value here")
        return values[node.name]

    return value(node)


_OPERATIONS: Mapping[str, Callable[..., Number]] = {
    "negative": lambda _, x: -x,
    "sum": lambda _, *terms: reduce(add, terms),
    "product": lambda _, *factors: reduce(mul, factors),
    "quotient": lambda _, x, y: x / y,
    "ln": lambda ar, x: ar.log(x),
    "log": lambda ar, x: ar.log(x) / ar.log(ar.number(10)),
}


def _power(node: Node, ar: Any, values: Mapping[str, Number], value: Callable[[Node], Any]) -> Any:
    base, exponent = node.parts
    power = _exponent(exponent, values)
    if base.kind == "power":  # (b^p)^q = b^(p q), as every base here is positive
        base, power = base.parts[0], power * _exponent(base.parts[1], values)
    if power.denominator == 1 and power > 0:
        return value(base) ** int(power)
    return ar.power(value(base), power)


def _exponent(node: Node, values: Mapping[str, Number]) -> Fraction:
    """An exponent: a number, or a symbol whose value is given as a Fraction."""
    match node.kind:
        case "number":
            return node.value
        case "symbol" if isinstance(values.get(node.name), Fraction):
            return Fraction(values[node.name])
        case "negative":
            return -_exponent(node.parts[0], values)
        case "quotient":
            return _exponent(node.parts[0], values) / _exponent(node.parts[1], values)
    raise EquationError("an exponent is not a number")


class DimensionError(ValueError):
    """Quantities of different kinds are added, or one that is no pure number is an argument."""


@dataclass(frozen=True, slots=True)
class Dimension:
    """Powers of kilogram, metre and second."""

    powers: tuple[Fraction, ...] = (Fraction(0), Fraction(0), Fraction(0))

    def __mul__(self, other: "Dimension") -> "Dimension":
        pairs = zip(self.powers, other.powers, strict=True)
        return Dimension(tuple(a + b for a, b in pairs))

    def __truediv__(self, other: "Dimension") -> "Dimension":
        pairs = zip(self.powers, other.powers, strict=True)
        return Dimension(tuple(a - b for a, b in pairs))

    def __pow__(self, exponent: Fraction | int) -> "Dimension":
        return Dimension(tuple(power * exponent for power in self.powers))

    def __str__(self) -> str:
        named = zip(("kg", "m", "s"), self.powers, strict=True)
        return " ".join(f"{n}^{p}" if p != 1 else n for n, p in named if p) or "a pure number"


def dimension(
    node: Node, units: Mapping[str, Dimension], exponents: Mapping[str, Fraction] | None = None
) -> Dimension:
    """The dimension of an expression, given those of its symbols, and symbols that are exponents.

    Raises DimensionError where a sum or an argument makes no sense.
    """
    parts = [] if node.kind == "power" else [dimension(p, units, exponents) for p in node.parts]
    match node.kind:
        case "number":
            return Dimension()
        case "symbol":
            return Dimension() if node.name == "pi" else units[node.name]
        case "sum":
            if unlike := next((part for part in parts if part != parts[0]), None):
                raise DimensionError(f"{parts[0]} and {unlike} are added")
            return parts[0]
        case "negative":
            return parts[0]
        case "product":
            return reduce(mul, parts)
        case "quotient":
            return parts[0] / parts[1]
        case "power":
            base, exponent = node.parts
            return dimension(base, units, exponents) ** _exponent(exponent, exponents or {})
    if parts[0] != Dimension():
        raise DimensionError(f"the logarithm of {parts[0]} is taken")
    return Dimension()


@dataclass(frozen=True, slots=True)
class Notation:
    """How the parts of an expression are put together as text."""

    number: Callable[[str], str]
    bracket: Callable[[str], str]
    fraction: Callable[[str, str], str]
    power: Callable[[str, str], str]
    call: Callable[[str, str], str]
    row: Callable[[str], str]
    plus: str
    less: str
    minus: str
    times: str
    stroke: tuple[int, int]
    """How tightly what is over and under a fraction bar must bind to go without brackets."""


MATHML = Notation(
    number=lambda text: f"<mn>{text}</mn>",
    bracket=lambda inner: f"<mrow><mo>(</mo>{inner}<mo>)</mo></mrow>",
    fraction=lambda over, under: f"<mfrac>{over}{under}</mfrac>",
    power=lambda base, exponent: f"<msup>{base}{exponent}</msup>",
    call=lambda name, inner: f"<mrow><mi>{name}</mi><mo>(</mo>{inner}<mo>)</mo></mrow>",
    row=lambda inner: f"<mrow>{inner}</mrow>",
    plus="<mo>+</mo>",
    less="<mo>\N{MINUS SIGN}</mo>",
    minus="<mo>\N{MINUS SIGN}</mo>",
    times="<mo>\N{INVISIBLE TIMES}</mo>",
    stroke=(0, 0),
)
PLAIN = Notation(
    number=str,
    bracket=lambda inner: f"({inner})",
    fraction=lambda over, under: f"{over}/{under}",
    power=lambda base, exponent: f"{base}^{exponent}",
    call=lambda name, inner: f"{name}({inner})",
    row=str,
    plus=" + ",
    less=" - ",
    minus="-",
    times=" ",
    stroke=(3, 4),
)
_BINDING = {"sum": 0, "negative": 1, "product": 2, "quotient": 3, "power": 4}
_TIGHTEST = 5


def rendered(node: Node, shown: Mapping[str, str], notation: Notation = PLAIN) -> str:
    """The expression as text; `shown` gives what stands for a symbol.

    >>> rendered(read_expression("x/(D + 2)", {"x": "x", "D": "D"}), {"x": "X", "D": "8"})
    'X/(8 + 2)'
    """

    def part(child: Node, least: int) -> str:
        inner = rendered(child, shown, notation)
        loose = _BINDING.get(child.kind, _TIGHTEST) < least
        return notation.bracket(inner) if loose else inner

    parts = node.parts
    match node.kind:
        case "number":
            return notation.number(str(node.value))
        case "symbol":
            return shown[node.name]
        case "negative":
            return notation.row(notation.minus + part(parts[0], 2))
        case "sum":
            terms = [part(parts[0], 0)]
            for term in parts[1:]:
                negative = term.kind == "negative"
                child = part(term.parts[0] if negative else term, 2 if negative else 1)
                terms.append((notation.less if negative else notation.plus) + child)
            return notation.row("".join(terms))
        case "product":
            return notation.row(notation.times.join(part(child, 2) for child in parts))
        case "quotient":
            return notation.fraction(
                part(parts[0], notation.stroke[0]), part(parts[1], notation.stroke[1])
            )
        case "power":
            return notation.power(part(parts[0], 5), part(parts[1], notation.stroke[1]))
    return notation.call(node.kind, rendered(parts[0], shown, notation))
