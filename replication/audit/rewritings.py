"""Harmless rewritings of the report's numbers and equations: other texts that say the same.

They are the controls of `coldspray power`: an audit that changes a verdict because 7.6×10^9 is
written 7.6E9, or because two factors are exchanged, raises a false alarm.
"""

import re
from collections.abc import Callable, Iterator

from msgspec.structs import replace

from reference.equations import Node, Notation, rendered
from reference.ledger import Ledger
from reference.units import superscript


def rewritings_of(ledger: Ledger, name: str) -> Iterator[tuple[str, str]]:
    r"""Yield other texts of a claim or an equation that say the same, with the kind of rewriting.

    >>> from reference.ledger import load
    >>> [text for text, kind in rewritings_of(load(), "fz-resistance-stainless")]
    ['7.6E9', '7.6e+09', '7.6×10⁹', '7.6 x 10^{9}', '7.6·10^9', ' 7.6×10^9 ']
    >>> [text for text, kind in rewritings_of(load(), "diameter") if kind == "factors exchanged"]
    ['D = R 2']
    """
    if name in ledger.equations:
        return equation_rewritings(ledger, name)
    claim = ledger.claims[name]
    if claim.printed is None:
        return iter(())
    # Within an equation a space decides how tightly a product binds.
    return number_rewritings(claim.text, spaces=not claim.within)


def number_rewritings(text: str, *, spaces: bool = True) -> Iterator[tuple[str, str]]:
    r"""Yield other texts that are read as the same number with the same digits.

    >>> [text for text, kind in number_rewritings("0.278", spaces=False)]
    ['.278', '0·278']
    >>> [text for text, kind in number_rewritings(r"\frac{1}{2}", spaces=False)]
    ['1/2']
    """
    yield from ((rewriting, "power of ten") for rewriting in _powers_of_ten(text))
    if "-" in text and not text[0].isalpha():
        yield text.replace("-", "\N{MINUS SIGN}"), "minus sign"
    if re.fullmatch(r"~? ?0\.\d+", text):
        yield text.replace("0.", ".", 1), "zero left out"
    if re.fullmatch(r"~? ?\d+\.\d+", text):
        yield text.replace(".", "·"), "raised point"
    if re.fullmatch(r"\d{4,}", text):
        yield f"{int(text):,}", "thousands"
    yield from ((rewriting, "fraction") for rewriting in _fractions(text))
    if text[0].isalpha():
        yield text[0].swapcase() + text[1:], "capital"
    if spaces:
        yield f" {text} ", "spaces"


def _powers_of_ten(text: str) -> Iterator[str]:
    """Yield the ways to write a number with an exponent, such as 7.6E9 for 7.6×10^9."""
    match = re.fullmatch(r"([\d.]+)(?:E| ?(?:×|\\times) ?10\^)([-+]?\d+)", text)
    if match:
        mantissa, power = match[1], int(match[2])
        yield f"{mantissa}E{power}"
        yield f"{mantissa}e{power:+03d}"
        yield f"{mantissa}×10{superscript(str(power))}"
        yield f"{mantissa} x 10^{{{power}}}"
        yield f"{mantissa}·10^{power}"


def _fractions(text: str) -> Iterator[str]:
    """Yield a fraction with a slash in LaTeX, and one in LaTeX with a slash."""
    if match := re.fullmatch(r"(\d+)/(\d+)", text):
        yield rf"\frac{{{match[1]}}}{{{match[2]}}}"
    if match := re.fullmatch(r"\\frac\{(\d+)\}\{(\d+)\}", text):
        yield f"{match[1]}/{match[2]}"


def equation_rewritings(ledger: Ledger, name: str) -> Iterator[tuple[str, str]]:
    """Yield other texts of an equation: the same sides, arranged or written in another way."""
    # The first spelling of each symbol; two spellings of one symbol mean the same.
    spelling = {symbol: text for text, symbol in reversed(list(ledger.written.items()))}
    printed = ledger.printed_text(name)
    no_left_side = "" if re.split(r"=", printed)[0].strip(" &") else "="

    def text_of(notation: Notation, change: Callable[[Node], Node] = lambda node: node) -> str:
        sides = [rendered(change(side), spelling, notation) for side in ledger.sides[name]]
        return no_left_side + " = ".join(sides)

    texts = {
        "fractions": text_of(_BARS),
        "slashes": text_of(_SLASHES),
        "multiplication sign": text_of(replace(_SLASHES, times=" × ")),
        "raised dot": text_of(replace(_SLASHES, times="·")),
        "times in LaTeX": text_of(replace(_BARS, times=r" \times ")),
        "factors exchanged": text_of(_SLASHES, lambda node: _turned(node, "product")),
        "terms exchanged": text_of(_SLASHES, lambda node: _turned(node, "sum")),
        "minus sign": printed.replace("-", "\N{MINUS SIGN}"),
        "spaces": re.sub(" +", "  ", printed),
    }
    return ((text, kind) for kind, text in texts.items() if text != printed)


def _turned(node: Node, kind: str) -> Node:
    """Return an expression with the parts of every sum or every product in reverse order."""
    parts = tuple(_turned(part, kind) for part in node.parts)
    return Node(node.kind, parts[::-1] if node.kind == kind else parts, node.name, node.value)


_SLASHES = Notation(power="{}^{{{}}}".format, call=r"\{}({})".format)
_BARS = Notation(
    fraction=r"\frac{{{}}}{{{}}}".format, power="{}^{{{}}}".format, call=r"\{}({})".format,
    stroke=(0, 0),
)  # fmt: skip
