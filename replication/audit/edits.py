"""Texts that are one slip of a typist away from a printed number or equation."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from fractions import Fraction
from itertools import pairwise
from string import digits

from reference.ledger import Ledger
from reference.printed import parse
from reference.units import Dimension

EQUATION_EDITS = (
    "number dropped",
    "symbol changed",
    "sign changed",
    "function changed",
    "fraction turned over",
)
"""Kinds of edits of an equation; its numbers are claims, with edits of their own."""

_LEADING_ZERO = re.compile(r"~?\s*0\d")
_EXPONENT = re.compile(r"(?P<lead>[Ee]|10\^\{?)(?P<number>[-+]?\d+)")


def edits_of(ledger: Ledger, name: str) -> Iterator[tuple[str, str]]:
    """Every text one edit away from a claim's or an equation's, with the kind of the edit."""
    text = ledger.printed_text(name)
    if name in ledger.equations:
        return equation_edits(text, ledger.written, ledger.dimensions)
    return edits(text) if ledger.claims[name].printed is not None else iter(())


def edits(text: str) -> Iterator[tuple[str, str]]:
    """Every text one edit of a number away that is another, with the edit's kind; none twice.

    The base of a power of ten is no digit, and no number begins with a zero before a digit.

    >>> [text for text, kind in edits("0.278") if kind in ("digits swapped", "digit doubled")]
    ['2.078', '0.728', '0.287', '0.2278', '0.2778', '0.2788']
    >>> [text for text, kind in edits("3E+08") if kind == "exponent changed"]
    ['3E+07', '3E+09', '3E-08']
    """
    seen = {text}
    original = _number(text)
    for kind, edit in _EDITS.items():
        for edited in edit(text):
            if edited in seen or _LEADING_ZERO.match(edited):
                continue
            seen.add(edited)
            if _number(edited) not in (None, original):
                yield edited, kind


def _number(text: str) -> tuple[Fraction, tuple[Fraction, ...]] | None:
    """The value of a text and the places that its last digit may have, if it is a number."""
    try:
        printed = parse(text)
    except ValueError:
        return None
    return printed.value, printed.quanta


def _digits(text: str) -> list[int]:
    """Where the digits of the mantissa stand; an exponent has edits of its own."""
    power = _EXPONENT.search(text)
    return [k for k, c in enumerate(text) if c.isdigit() and (power is None or k < power.start())]


def _swapped(text: str) -> Iterator[str]:
    places = _digits(text)
    for here, there in pairwise(places):
        if there - here == 1 or text[here + 1 : there] == ".":
            yield (
                text[:here] + text[there] + text[here + 1 : there] + text[here] + text[there + 1 :]
            )


def _inserted(text: str) -> Iterator[str]:
    ends = sorted({end for k in _digits(text) for end in (k, k + 1)})
    return (text[:k] + digit + text[k:] for k in ends for digit in digits)


def _moved(text: str) -> Iterator[str]:
    """The decimal point one place to the left or right."""
    point = text.find(".")
    if point < 0:
        return
    if point > 1 and text[point - 1].isdigit():
        yield text[: point - 1] + "." + text[point - 1] + text[point + 1 :]
    if text[point + 1 : point + 2].isdigit():
        yield text[:point] + text[point + 1] + "." + text[point + 2 :]


def _shifted(text: str) -> Iterator[str]:
    """The exponent one less and one more, written as wide as it was, or its sign turned."""
    for match in _EXPONENT.finditer(text):
        number = match["number"]
        for exponent in (int(number) - 1, int(number) + 1, -int(number)):
            sign = "+" if match["lead"] in "Ee" and number[0] in "+-" and exponent >= 0 else ""
            width = len(number.lstrip("+-")) + len(sign or "-" * (exponent < 0))
            shown = f"{sign}{exponent:0{width - len(sign)}d}"
            yield text[: match.start("number")] + shown + text[match.end("number") :]


_WORDS = (
    ("one", "two", "three", "four", "five"),
    ("third", "half"),
    ("one-sixth", "one-fifth"),
    ("twice", "thrice"),
)


def _words(text: str) -> Iterator[str]:
    own = text.lower()
    others = (word for words in _WORDS if own in words for word in words if word != own)
    return (word.capitalize() if text[0].isupper() else word for word in others)


_EDITS: Mapping[str, Callable[[str], Iterator[str]]] = {
    "digit dropped": lambda text: (text[:k] + text[k + 1 :] for k in _digits(text)),
    "digits swapped": _swapped,
    "decimal point moved": _moved,
    "exponent changed": _shifted,
    "other word": _words,
    "digit doubled": lambda text: (text[:k] + text[k] + text[k:] for k in _digits(text)),
    "digit changed": lambda text: (
        text[:k] + digit + text[k + 1 :] for k in _digits(text) for digit in digits
    ),
    "digit inserted": _inserted,
}
NUMBER_EDITS = tuple(_EDITS)
"""Kinds of edits of a number. The fewer texts a kind has, the less likely one fits by chance."""


def equation_edits(
    text: str, written: Mapping[str, str], dimensions: Mapping[str, Dimension]
) -> Iterator[tuple[str, str]]:
    r"""Every equation one edit away, with the kind of the edit.

    `written` maps what the report writes to a symbol's name; a symbol is mistaken for another of
    the same dimension.

    >>> from reference.ledger import load
    >>> ledger = load()
    >>> [text for text, kind in equation_edits("D = 2R", ledger.written, ledger.dimensions)
    ...  if kind == "number dropped"]
    ['D = R']
    """
    edits: dict[str, str] = {}
    symbols = "|".join(re.escape(name) for name in sorted(written, key=len, reverse=True))
    tokens = re.compile(
        rf"(?P<command>\\(?:frac|quad|ln|log))|(?P<symbol>{symbols})|(?P<number>\d+)|(?P<sign>[-+])"
    )
    for match in tokens.finditer(text):
        for replacement, kind in _replacements(match, written, dimensions):
            edits.setdefault(text[: match.start()] + replacement + text[match.end() :], kind)
    for match in re.finditer(r"([^\s(){}^=+/]+)/([^\s(){}^=+/]+)", text):
        turned = text[: match.start()] + f"{match[2]}/{match[1]}" + text[match.end() :]
        edits.setdefault(turned, "fraction turned over")
    edits.pop(text, None)
    return iter(edits.items())


def _replacements(
    match: re.Match[str], written: Mapping[str, str], dimensions: Mapping[str, Dimension]
) -> Iterable[tuple[str, str]]:
    text = match[0]
    if match["number"]:
        yield "", "number dropped"
    elif match["sign"]:
        yield "+" if text == "-" else "-", "sign changed"
    elif text in (r"\ln", r"\log"):
        yield r"\log" if text == r"\ln" else r"\ln", "function changed"
    elif match["symbol"]:
        own = dimensions[written[text]]
        for mistaken, name in written.items():
            if name != written[text] and dimensions[name] == own:
                yield mistaken, "symbol changed"
