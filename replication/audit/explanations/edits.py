"""Printed texts that are one slip of a typist away from another."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from reference.printed import Printed, parse

__all__ = ["KINDS", "Edit", "edits"]

KINDS = (
    "digits swapped",
    "digit doubled",
    "digit changed",
    "digit dropped",
    "digit inserted",
    "decimal point moved",
    "exponent off by one",
)
"""From the likeliest slip to the least likely one, as edits are ranked."""


@dataclass(frozen=True, slots=True)
class Edit:
    """A text one slip away from a printed one."""

    text: str
    kind: str
    printed: Printed


_EXPONENT = re.compile(r"(?P<lead>[Ee]|10\^\{?)(?P<number>[-+]?\d+)")


def edits(text: str) -> list[Edit]:
    """Every text one edit away that still is a number, and another one; none stands twice.

    The base of a power of ten is no digit; number words and texts without digits have no edits.

    >>> [edit.text for edit in edits("0.278") if edit.kind in ("digits swapped", "digit doubled")]
    ['0.728', '0.287', '0.2278', '0.2778', '0.2788']
    >>> [edit.text for edit in edits("3E+08") if edit.kind == "exponent off by one"]
    ['3E+07', '3E+09']
    """
    found: dict[str, Edit] = {}
    for kind in KINDS:
        for other in _EDITS[kind](text):
            if other not in found and (printed := _number(other)) and _differs(printed, text):
                found[other] = Edit(other, kind, printed)
    return list(found.values())


def _number(text: str) -> Printed | None:
    """The text as a number, if it is one."""
    try:
        return parse(text)
    except ValueError:
        return None


def _differs(printed: Printed, text: str) -> bool:
    original = _number(text)
    return original is not None and (printed.value, printed.quanta) != (
        original.value, original.quanta,
    )  # fmt: skip


def _digits(text: str) -> list[int]:
    """Where the digits of the mantissa stand; an exponent has edits of its own."""
    power = _EXPONENT.search(text)
    return [k for k, c in enumerate(text) if c.isdigit() and (power is None or k < power.start())]


def _swapped(text: str) -> Iterator[str]:
    places = _digits(text)
    for k in places:
        if k + 1 in places:
            yield text[:k] + text[k + 1] + text[k] + text[k + 2 :]


def _doubled(text: str) -> Iterator[str]:
    return (text[:k] + text[k] + text[k:] for k in _digits(text))


def _changed(text: str) -> Iterator[str]:
    return (text[:k] + d + text[k + 1 :] for k in _digits(text) for d in "0123456789")


def _dropped(text: str) -> Iterator[str]:
    return (text[:k] + text[k + 1 :] for k in _digits(text))


def _inserted(text: str) -> Iterator[str]:
    ends = sorted({end for k in _digits(text) for end in (k, k + 1)})
    return (text[:k] + d + text[k:] for k in ends for d in "0123456789")


def _moved(text: str) -> Iterator[str]:
    """The decimal point one place to the left or right."""
    point = text.find(".")
    if point < 0:
        return
    if point > 1 and text[point - 1].isdigit():
        yield text[: point - 1] + "." + text[point - 1] + text[point + 1 :]
    if text[point + 2 : point + 3].isdigit():
        yield text[:point] + text[point + 1] + "." + text[point + 2 :]


def _shifted(text: str) -> Iterator[str]:
    """The exponent one less and one more, written as wide as it was."""
    for match in _EXPONENT.finditer(text):
        number = match["number"]
        for other in (int(number) - 1, int(number) + 1):
            sign = "+" if number[0] == "+" and other >= 0 else ""
            shown = f"{sign}{other:0{len(number) - len(sign)}d}"
            yield text[: match.start("number")] + shown + text[match.end("number") :]


_EDITS = {
    "digits swapped": _swapped,
    "digit doubled": _doubled,
    "digit changed": _changed,
    "digit dropped": _dropped,
    "digit inserted": _inserted,
    "decimal point moved": _moved,
    "exponent off by one": _shifted,
}
