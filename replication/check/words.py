"""Understand what people write: heads of columns, labels of inputs, and units and numbers in them.

A text is read in two ways: as a symbol, if it is nothing but that ("R_t", "dx/dt"), and by the
words in it ("target resistance"); `words.toml` lists both. Units stand in brackets, after "in" or
"/", or in a cell of their own.
"""

import math
import re
import tomllib
import unicodedata
from collections.abc import Callable, Sized
from decimal import Decimal
from fractions import Fraction
from functools import cache
from importlib import resources

from reference.units import is_known, same_dimension, to_si
from replication.check.difference import counted
from replication.text import with_unit

_WORDS: dict[str, dict[str, str]] = tomllib.loads(
    resources.files("replication.check").joinpath("words.toml").read_text("utf-8")
)
COLUMNS = _WORDS["columns"]
"""The columns of the scheme, in the order of a row, and their SI units."""
INPUT_UNITS = _WORDS["inputs"]
"""The inputs that a cell beside the table may hold, and their SI units."""
_MEASURES = {**COLUMNS, **INPUT_UNITS}

_MAX_LABEL = 80
"""The most characters of a text that are read."""


@cache
def _plain_text(text: str) -> str:
    """Return a text in small letters and plain digits, without marks, double blanks or "(SI)"."""
    text = unicodedata.normalize("NFKC", text[:_MAX_LABEL]).casefold().replace("−", "-")
    bare = re.sub(r"\s+", " ", re.sub(r"[=:;^]+|\*\*", "", text)).strip()
    return re.sub(r" (?:in )?[\[(]?si(?: units?| unit[ée]s?)?[\])]?$", "", bare)


@cache
def is_unit(text: str) -> str | None:
    """Return the unit that a text consists of, as `reference.units` reads it, or None.

    >>> is_unit("µm"), is_unit("(kg/m³)"), is_unit("m/s2"), is_unit("-"), is_unit("depth")
    ('um', 'kg/m3', 'm/s2', '1', None)
    """
    text = unicodedata.normalize("NFKC", text[:_MAX_LABEL]).strip().replace("−", "-")
    if text.startswith(("[", "(")) and text.endswith(("]", ")")):
        text = text[1:-1].strip()
    text = text.lower() if re.fullmatch("[CM]M|KG|[A-Z]+/[A-Z]+[23]?", text) else text
    text = re.sub("[μµ]", "u", text).replace("·", "*").replace("pa", "Pa")
    text = re.sub(r"\bsec\b", "s", text)
    text = re.sub(r"\bmils\b", "mil", text)
    text = "1" if text in ("-", "–", "—") else text
    return text if is_known(text) else None


@cache
def unit_in(text: str) -> str | None:
    """Return the unit that a head or label names, or None.

    >>> unit_in("Eindringtiefe [µm]"), unit_in("v1 / (m/s)"), unit_in("t in s"), unit_in("dx/dt")
    ('um', 'm/s', 's', None)
    >>> unit_in("Density, g/cm3"), unit_in("m/kg")
    ('g/cm3', 'kg')
    """
    text = unicodedata.normalize("NFKC", text[:_MAX_LABEL]).strip().rstrip("=: ").strip()
    if re.fullmatch(r"[atuvxATUVX]\w? ?\(N(?:[+-]1)?\)", text):
        return None  # N counts the steps: v(N), v(N+1)
    pieces = [
        *reversed(re.findall(r"[\[(]([^\[\]()]+)[\])]", text)),
        *re.findall(r"\b(?:in|en)\s+(\S+)$", text),
        *(part.replace(" / ", "/") for part in text.split(",")[:0:-1]),
        *re.findall(r"[ ,]([^ _,]{2,})$", text),  # a single letter there is a symbol: "Weg s"
        *(text.partition(mark)[2] for mark in (" / ", "/", ",")),
        *re.findall(r"[^ _]{2,}$", text),
    ]
    return next((unit for piece in pieces if (unit := is_unit(piece))), None)


def _symbol(text: str) -> str:
    """Return a text without its unit; the rest may be a symbol.

    >>> _symbol("v1 / (m/s)"), _symbol("Time"), _symbol("Rₜ [Pa]"), _symbol("x/m")
    ('v1', 'time', 'rt', 'x')
    """
    plain = _plain_text(text)
    if unit_in(text) is None:
        return plain
    bare = re.sub(r"\s*(?:[\[(][^\[\]()]*[\])]|\bin \S+|,? \S+)$", "", plain).rstrip(" /")
    return bare if bare and bare != plain else plain.partition("/")[0].strip()


def _symbols(table: str, text: str) -> list[str]:
    """Return the names of the entries of a table whose symbol is the whole text."""
    return _entries_in(table, _symbol(text), re.fullmatch)


def _entries_in(table: str, text: str, fits: Callable[[str, str], object] = re.search) -> list[str]:
    """Return the names of the entries of a table whose words stand in a text."""
    return [name for name, pattern in _WORDS[table].items() if fits(pattern, text)]


@cache
def column_roles(head: str) -> frozenset[str]:
    """Return the columns that a head may stand over; "other" for any other quantity.

    >>> sorted(column_roles("dx/dt initial")), sorted(column_roles("Eindringtiefe [µm]"))
    (['velocity_initial'], ['depth'])
    >>> sorted(column_roles("v")), sorted(column_roles("A(x)")), sorted(column_roles("foo"))
    (['velocity_final', 'velocity_initial'], ['other'], [])
    """
    named = _symbols("column_symbols", head) or _entries_in("column_words", _plain_text(head))
    role, unit = next(iter(named), None), unit_in(head)
    if role is None or (
        role != "other" and unit and not same_dimension(unit, COLUMNS.get(role, "m/s"))
    ):
        # After an underscore only the end of a unit may have been read: a_m_s2.
        measured = unit in (None, "1") or "_" in head
        known = measured or any(same_dimension(str(unit), each) for each in COLUMNS.values())
        return frozenset(() if known else {"other"})
    if role != "velocity":
        return frozenset({role})
    ends = _entries_in("velocities", _symbol(head))
    return frozenset(
        f"velocity_{end}" for end in (ends if len(ends) == 1 else _WORDS["velocities"])
    )


@cache
def input_roles(label: str, unit: str | None) -> frozenset[str]:
    """Return the inputs that a label may name, given the unit beside it, if any.

    >>> sorted(input_roles("Rt =", None)), sorted(input_roles("Dichte Ziel", "g/cm^3"))
    (['resistance'], ['target_density'])
    >>> sorted(input_roles("Density =", None))
    ['particle_density', 'target_density']
    """
    unit = unit or unit_in(label)
    roles = _symbols("input_symbols", label)
    if not roles:
        groups = set(_entries_in("groups", _plain_text(label)))
        roles = [
            role
            for role, (wanted, unwanted) in _INPUT_WORDS.items()
            if groups >= wanted and not groups & unwanted
        ]
        # Only a density is ambiguous: without particle or target in its label it may be either.
        roles = [role for role in roles if role.endswith("density")] or roles[:1]
    return frozenset(r for r in roles if unit is None or same_dimension(unit, INPUT_UNITS[r]))


_INPUT_WORDS: dict[str, tuple[set[str], set[str]]] = {
    "particle_density": ({"density"}, {"target"}),
    "target_density": ({"density"}, {"particle"}),
    "stop_velocity": ({"stop", "slow"}, set()),
    "velocity": ({"speed"}, {"stop"}),
    "step": ({"step"}, {"number"}),
    "resistance": ({"resistance"}, set()),
    "beta": ({"beta"}, {"choice"}),
    "flow_stress": ({"stress"}, {"copper"}),
    "radius": ({"radius"}, {"apart"}),
    "diameter": ({"diameter"}, {"apart"}),
    "mass": ({"mass"}, {"volumic"}),
}
"""The groups of words that a label of each input has, all of them, and those that it has not."""


@cache
def result_named(label: str) -> str | None:
    """Return "depth" if a label names the final depth, "ratio" for that over the radius, or None.

    "any depth" is a depth that is not said to be the final one.

    >>> [result_named(label) for label in ("Endtiefe [µm]", "X/R", "Depth [m]", "radius")]
    ['depth', 'ratio', 'any depth', None]
    >>> result_named("X (beta 3), um"), result_named("x [m]"), result_named("Final depth / D")
    ('any depth', None, None)
    """
    beta = rf"[\[(,]?\s*{_BETA}{_NUMBER}[\])]?"
    bare = re.sub(beta, "", label[:_MAX_LABEL], flags=re.IGNORECASE)
    plain = re.sub(_BETWEEN_WORDS, " ", re.sub(_QUANTITY, "", _plain_text(bare)))
    spoken = re.findall(r"[^\W\d]\w*|\d[\d.]*|[^\s\w.,:()\[\]]", plain)
    words = [_entries_in("results", word, re.fullmatch) for word in spoken]
    units = [same_dimension(is_unit(word) or "1", "m") for word in spoken]
    said = {name for names in words for name in names}
    if all(map(any, zip(words, units, strict=True))):
        ratio = any(
            "depth" in a and "over" in b and "radius" in c
            for a, b, c in zip(words, words[1:], words[2:], strict=False)
        )
        if "normalized" in said or (ratio and words.count(["radius"]) == 1):
            return "ratio"
        if not said & {"over", "radius", "percent"} and (
            "last depth" in said or said >= {"last", "depth"}
        ):
            return "depth"
    # The report calls the final depth X, and that of every row x.
    final = bare.startswith("X") and _symbol(bare) == "x"
    return next(iter(_symbols("result_symbols", bare)), "any depth" if final else None)


_BETA = r"(?:(?:\bb[eê]ta|[βΒ])[\s_]*[=:]?|\bb\s*=)\s*"
_BETWEEN_WORDS = r"(?<=\w)-(?=\w)|(?<=[^\W\d_]{3})_(?=\w)|(?<=\w)_(?=[^\W\d_]{3})"
_NUMBER = r"\d+(?:[.,]\d+)?"
_QUANTITY = rf"(?:\b(?:v_?0?|[dδ∆]t|(?:time )?step) ?)?{_NUMBER} ?(?:[kmcµu]?m/s|[pnµum]?s)\b"


@cache
def number_in(text: str) -> tuple[str | None, float]:
    """Return the beta, velocity or time step (in SI units) in a text, or the number it begins with.

    The number is NaN if there is none, or if there are several velocities or steps.

    >>> number_in("X/R (β = 5)"), number_in("Final depth, b=3"), number_in("V = 400 m/s: depth")
    (('beta', 5.0), ('beta', 3.0), ('velocity', 400.0))
    >>> number_in("2"), number_in("X (B3)")
    ((None, 2.0), (None, nan))
    """
    text = text[:_MAX_LABEL]
    if beta := re.search(f"{_BETA}({_NUMBER})", text, re.IGNORECASE):
        return "beta", float(beta[1].replace(",", "."))
    quantities = {
        (role, float(number.replace(",", ".")) * float(to_si(named)))
        for number, unit in re.findall(rf"({_NUMBER}) ?([^\s\d,;:()\[\]]+)", text)
        for role in ("velocity", "step")
        if same_dimension(named := is_unit(unit) or "1", INPUT_UNITS[role])
    }
    if quantities:
        return quantities.pop() if len(quantities) == 1 else (None, math.nan)
    number = re.match(rf"\s*({_NUMBER})", text)
    return None, float(number[1].replace(",", ".")) if number else math.nan


# ---- how this program writes names, numbers and units


def title(role: str) -> str:
    """Return the name of a column or an input as a sentence has it."""
    return _WORDS["titles"].get(role) or f"the {role.replace('_', ' ')}"


def with_si_unit(value: float, role: str, digits: int = 10) -> str:
    """Return a value in SI units as text of so many digits, with its unit.

    >>> with_si_unit(11e-6, "radius"), with_si_unit(5.0, "beta")
    ('1.1e-05 m', '5')
    """
    return with_unit(f"{value:.{digits}g}", _MEASURES[role])


def unit_name(role: str, power: int) -> str:
    """Return the unit of a column or input that is a power of ten of the SI unit.

    >>> unit_name("depth", -6), unit_name("depth", 0), unit_name("radius", 5)
    ('um', 'm', '1e5 m')
    """
    unit = _MEASURES[role]
    named = [text for text in _WORDS["units"][unit].split() if to_si(text) == Fraction(10) ** power]
    return unit if power == 0 else next(iter(named), f"1e{power} {unit}")


def power_of_ten(ratio: float) -> int | None:
    """Return the exponent if a ratio is a power of ten, else None.

    >>> power_of_ten(1e-6), power_of_ten(1.0), power_of_ten(2.0)
    (-6, 0, None)
    """
    if not 0 < ratio < math.inf:
        return None
    power = math.log10(ratio)
    return round(power) if abs(power - round(power)) < 1e-9 else None


def times_too(power: int) -> str:
    """Say by which power of ten a number is too large or too small.

    >>> times_too(-3), times_too(1)
    ('1e3 times too small', '10 times too large')
    """
    size = f"1e{abs(power)}" if abs(power) > 2 else str(10 ** abs(power))
    return f"{size} times too {'large' if power > 0 else 'small'}"


def digits_of(value: float) -> tuple[int, int]:
    """Return the number of digits of a typed number, and the power of ten of the last one.

    >>> digits_of(0.0254), digits_of(3000.0)
    ((3, -4), (1, 3))
    """
    number = Decimal(repr(value)).normalize().as_tuple()
    return len(number.digits), int(number.exponent)


def share(some: Sized, of: Sized, what: str) -> str:
    """Say how many of some things, such as "2 of 4 formulas".

    >>> share("ab", "abcd", "formula"), share("ab", "ab", "formula"), share("a", "a", "formula")
    ('2 of 4 formulas', 'all 2 formulas', '1 of 1 formula')
    """
    if len(some) == len(of) > 1:
        return f"all {counted(len(of), what)}"
    return f"{len(some):,} of {counted(len(of), what)}"
