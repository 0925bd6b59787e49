"""What people call things: heads of columns and labels of inputs, in English, German and French.

A text is read in two ways: as a symbol, if it is nothing else ("R_t", "dx/dt"), and by the words
in it ("target resistance"). Units stand in brackets, after "in" or "/", or in a cell of their own.
"""

import math
import re
import unicodedata
from collections.abc import Iterable
from fractions import Fraction
from functools import cache

from reference.units import UnitError, same_dimension, to_si
from replication.text import with_unit

COLUMNS = {
    "time": "s",
    "velocity_initial": "m/s",
    "depth": "m",
    "deceleration": "m/s^2",
    "velocity_final": "m/s",
}
"""The columns of the sheet, in the order of a row, and what they measure."""

INPUTS = {
    "velocity": "m/s",
    "radius": "m",
    "diameter": "m",
    "particle_density": "kg/m^3",
    "target_density": "kg/m^3",
    "mass": "kg",
    "beta": "1",
    "flow_stress": "Pa",
    "resistance": "Pa",
    "step": "s",
    "stop_velocity": "m/s",
}
"""What a cell beside the table may hold, and what it measures."""

_MAX_LABEL = 80


@cache
def _plain(text: str) -> str:
    """A text without case, accents of typing (sub- and superscripts), marks and double blanks."""
    text = unicodedata.normalize("NFKC", text[:_MAX_LABEL]).casefold().replace("−", "-")
    bare = re.sub(r"\s+", " ", re.sub(r"[=:;^]+|\*\*", "", text)).strip()
    return re.sub(r" (?:in )?[\[(]?si(?: units?| unit[ée]s?)?[\])]?$", "", bare)


_ATOM = r"(?:micron|sec|[numµμck]?m|[pnumµμ]?s|[pnumµμk]?g|[kMG]?[Pp]a|[km]?psi|ksi|N|dyn)"
_FACTOR = rf"\(?{_ATOM}(?:(?:\^|\*\*)?-?[1-4])?"
_EXPRESSION = re.compile(rf"(?:1/)?{_FACTOR}(?:[ */·]{_FACTOR}\)?){{0,3}}\)?")


@cache
def is_unit(text: str) -> str | None:
    """The unit that a text is, as `reference.units` writes it; None if it is something else.

    >>> is_unit("µm"), is_unit("(kg/m³)"), is_unit("m/s2"), is_unit("-"), is_unit("depth")
    ('um', 'kg/m^3', 'm/s^2', '1', None)
    """
    text = unicodedata.normalize("NFKC", text[:_MAX_LABEL]).strip().replace("−", "-")
    if text.startswith(("[", "(")) and text.endswith(("]", ")")):
        text = text[1:-1].strip()
    if text in ("-", "1", "–", "—"):
        return "1"
    if len(text) > 16 or not _EXPRESSION.fullmatch(text):
        return None
    text = text.replace("μ", "u").replace("µ", "u").replace("·", "*").replace("pa", "Pa")
    text = re.sub(r"[()]", "", text)
    text = re.sub(r"(?<=[A-Za-z])(-?[1-4])", r"^\1", text)
    try:
        to_si(text)
    except UnitError:
        return None
    return text


@cache
def unit_in(text: str) -> str | None:
    """The unit that a head or label names.

    >>> unit_in("Eindringtiefe [µm]"), unit_in("v1 / (m/s)"), unit_in("t in s"), unit_in("dx/dt")
    ('um', 'm/s', 's', None)
    """
    text = text[:_MAX_LABEL].strip().rstrip("=: ").strip()
    pieces = [
        *reversed(re.findall(r"[\[(]([^\[\]()]+)[\])]", text)),
        *re.findall(r"\b(?:in|en)\s+(\S+)$", text),
        *(text.partition(mark)[2] for mark in (" / ", "/", ", ")),
        *re.findall(r"[^ _]{2,}$", text),  # a single letter there is a symbol: "Weg s"
    ]
    return next((unit for piece in pieces if (unit := is_unit(piece))), None)


def _symbol(text: str) -> str:
    """The text without its unit: what is left may be a symbol.

    >>> _symbol("v1 / (m/s)"), _symbol("Time"), _symbol("Rₜ [Pa]"), _symbol("x/m")
    ('v1', 'time', 'rt', 'x')
    """
    plain = _plain(text)
    if unit_in(text) is None:
        return plain
    bare = re.sub(r"\s*(?:[\[(][^\[\]()]*[\])]|\bin \S+|,? \S+)$", "", plain).rstrip(" /")
    return bare if bare and bare != plain else plain.partition("/")[0].strip()


_NO_COLUMN = (
    r"energ|énerg|\be_?kin|force|kraft|area|fläche|flaeche|surface|\baire\b|stress|spannung|contrainte"
    r"|pressure|druck|pression|\bx/[rd]\b|\bratio\b|normal|momentum|impuls|erreur|error|fehler"
    r"|\bmid|_mid|mean|averag|mittl|mittel|moyen|milieu|resist|widerstand|densit|dichte|squared|quadrat|carré|\(x\)|^[δ∆]"
)
_COLUMN_WORDS = {
    "deceleration": r"d[eé]c[eé]l|acc[eé]l|verz[öo]e?ger|beschleun|brems|d2x/dt2|dv/dt|ẍ|freinage"
    r"|^-?a\b",
    "velocity": r"velocit|speed|geschw|vitesse|\bvel\b|dx/dt|ẋ|^[vu]\b",
    "time": r"\btime|zeit(?!schritt)|temps|dur[ée]e|\btps\b|^t\b",
    "depth": r"depth|tiefe|profond|penetra|p[ée]n[ée]tra|eindring|enfonce|displacement|\bweg\b"
    r"|position|^x\b|\bx$",
}
_INDEX = r"(?:_[a-z0-9]{1,7}|[a-z0-9])?"
_COLUMN_SYMBOLS = {
    "deceleration": rf"[-|]*(?:a{_INDEX}|ẍ|d2x/dt2|dv/dt|x_?ddot)\|?(?:\(t\))?",
    "velocity": rf"(?:v|u){_INDEX}(?:\(t\))?|x_?dot|dxdt",
    "time": rf"t{_INDEX}",
    "depth": rf"(?:x|s|z|h|p){_INDEX}(?:\(t\))?",
}
_INITIAL = (
    r"ini[tz]|start|begin|anfang|\balt|\bold|vorher|avant|d[ée]but|before|prev|^.?_?(?:i|a|old)$"
)
_FINAL = (
    r"final|finale|\bend|ende|\bneu|\bnew|nach|apr[eè]s|after|next|\bfin\b|nouv|^.?_?(?:f|e|new)$"
)


@cache
def column_roles(head: str) -> frozenset[str]:
    """The columns that a head may stand over; "other" for a quantity that is none of them.

    >>> sorted(column_roles("dx/dt initial")), sorted(column_roles("Eindringtiefe [µm]"))
    (['velocity_initial'], ['depth'])
    >>> sorted(column_roles("v")), sorted(column_roles("A(x)")), sorted(column_roles("foo"))
    (['velocity_final', 'velocity_initial'], ['other'], [])
    """
    plain, symbol = _plain(head), _symbol(head)
    role = next((r for r, p in _COLUMN_SYMBOLS.items() if re.fullmatch(p, symbol)), None)
    if role is None and re.search(_NO_COLUMN, plain):
        return frozenset({"other"})
    if role is None:
        role = next((r for r, p in _COLUMN_WORDS.items() if re.search(p, plain)), None)
    unit = unit_in(head)
    if role is None or (unit and not same_dimension(unit, COLUMNS.get(role, "m/s"))):
        return frozenset()
    if role != "velocity":
        return frozenset({role})
    initial, final = re.search(_INITIAL, symbol), re.search(_FINAL, symbol)
    if bool(initial) == bool(final):
        return frozenset({"velocity_initial", "velocity_final"})
    return frozenset({"velocity_initial" if initial else "velocity_final"})


_SPEED = r"velocit|speed|geschw|vitesse|\bvel\b"
_STOP = r"stop|abbruch|arr[êe]t|\bend|thresh|cut.?off|minim|limit|seuil|below|schwell"
_PARTICLE = (
    r"partic|partik|teilchen|copper|kupfer|cuivre|\bcu\b|sphere|kugel|sph[èe]re|projectil"
    r"|impactor|pulver|powder|poudre|bille"
)
_TARGET = r"target|ziel|cible|steel|stahl|acier|substrat|\bplate\b|platte|plaque|inox|304"
_STEP = (
    r"time.?step|time.?incr|increment|zeitschritt|schrittweite|pas de temps|\bpas\b|delta.?t\b"
    r"|^step|[δ∆]t"
)
_STRESS = (
    r"flow.?stress|yield|strength|flie(?:ß|ss)|streck|festigkeit|contrainte|[ée]coulement"
    r"|limite.*[ée]last"
)
_INPUT_WORDS: tuple[tuple[str, str, str], ...] = (
    # role, words it must have, words it must not have
    ("particle_density", rf"(?=.*(?:densit|dichte|volumique|rho|ρ))(?=.*(?:{_PARTICLE}))", "$^"),
    ("target_density", rf"(?=.*(?:densit|dichte|volumique|rho|ρ))(?=.*(?:{_TARGET}))", "$^"),
    ("particle_density", r"densit|dichte|volumique|^rho$|^ρ$", _TARGET),
    ("target_density", r"densit|dichte|volumique|^rho$|^ρ$", _PARTICLE),
    ("stop_velocity", rf"(?=.*(?:{_STOP}))(?=.*(?:{_SPEED}|\bv\b|below|m/s))", "$^"),
    ("velocity", _SPEED, _STOP),
    ("step", _STEP, r"half|halb|demi|number|anzahl|nombre|steps"),
    ("resistance", r"resistan|widerstand|r[ée]sistan", "$^"),
    ("beta", r"\bbeta\b|β|b[êe]ta\b", "$^"),
    ("flow_stress", _STRESS, "copper|kupfer|cuivre"),
    ("radius", r"radius|rayon|halbmesser", r"depth|tiefe|profond|/|contact|kontakt"),
    ("diameter", r"diam|durchmesser", r"contact|kontakt|depth|/"),
    ("mass", r"\bmass\b|masse\b|[a-z]masse\b", "volumique"),
)  # fmt: skip
_INPUT_SYMBOLS = {
    "radius": r"r(?:_?p|_?0|adius)?",
    "diameter": r"d(?:_?p|_?0)?",
    "mass": r"m(?:_?p|ass)?",
    "particle_density": r"(?:rho|ρ)_?(?:p|cu|k|part)",
    "target_density": r"(?:rho|ρ)_?(?:t|z|c|ss|fe|targ)",
    "velocity": r"v(?:_?0|_?i|_?imp(?:act)?|_?p)?|u_?0",
    "stop_velocity": r"v_?(?:stop|min|end|lim)",
    "step": r"(?:d|δ|∆|delta)_?t(?:_\w*)?",
    "beta": r"(?:beta?|β)(?:_\w*)?",
    "flow_stress": r"y(?:_?t|_?c)?|(?:σ|sigma)_?[yf]",
    "resistance": r"r_?t(?:arget)?",
}


@cache
def input_roles(label: str, unit: str | None) -> frozenset[str]:
    """The inputs that a label may name, given the unit beside it, if any.

    >>> sorted(input_roles("Rt =", None)), sorted(input_roles("Dichte Ziel", "g/cm^3"))
    (['resistance'], ['target_density'])
    >>> sorted(input_roles("Density =", None))
    ['particle_density', 'target_density']
    """
    unit = unit or unit_in(label)
    symbol, plain = _symbol(label), _plain(label)
    roles = [role for role, pattern in _INPUT_SYMBOLS.items() if re.fullmatch(pattern, symbol)]
    if not roles:
        roles = [
            role
            for role, wanted, unwanted in _INPUT_WORDS
            if re.search(wanted, plain) and not re.search(unwanted, plain)
        ]
        # Only a density may be that of either, where the label says of neither.
        either = [role for role in roles if role.endswith("density")]
        if roles[:1] != either[:1] or re.search(f"{_PARTICLE}|{_TARGET}", plain):
            either = []
        roles = either or roles[:1]
    return frozenset(r for r in roles if unit is None or same_dimension(unit, INPUTS[r]))


_RESULTS = {
    "depth": r"(?=.*(?:final|\bend|max|total|rest))(?=.*(?:depth|tiefe|profond|penetra|\bx\b))"
    r"|endtiefe|x_?(?:final|max|end)",
    "ratio": r"^x ?/ ?r\b|normali[sz]ed|normiert|normalis[ée]|depth ?/ ?radius|bezogen",
}


@cache
def result_of(label: str) -> str | None:
    """Whether a label names the final depth ("depth") or that over the radius ("ratio").

    >>> result_of("Endtiefe [µm]"), result_of("X/R"), result_of("depth")
    ('depth', 'ratio', None)
    """
    plain = _plain(label)
    return next((r for r in ("ratio", "depth") if re.search(_RESULTS[r], plain)), None)


# What this program calls them, and numbers in their units.

_TITLES = {
    "velocity_initial": "the initial velocity", "velocity_final": "the final velocity",
    "velocity": "the impact velocity", "beta": "beta", "resistance": "the target resistance",
    "step": "the time step",
}  # fmt: skip


def title(role: str) -> str:
    """What a column or an input is called in a sentence."""
    return _TITLES.get(role) or f"the {role.replace('_', ' ')}"


def titles(roles: Iterable[str]) -> str:
    """Some of them, joined."""
    return " and ".join(map(title, roles))


def quantity(value: float, role: str) -> str:
    """A value in SI units with its unit.

    >>> quantity(11e-6, "radius"), quantity(5.0, "beta")
    ('1.1e-05 m', '5')
    """
    return with_unit(f"{value:.10g}", {**COLUMNS, **INPUTS}[role])


_NAMED = {
    "s": {-3: "ms", -6: "us", -9: "ns", -12: "ps"},
    "m": {-2: "cm", -3: "mm", -6: "um", -9: "nm"},
    "m/s": {3: "km/s", -3: "mm/s", -2: "cm/s"},
    "m/s^2": {3: "km/s^2", -2: "cm/s^2", 12: "um/ns^2"},
    "kg/m^3": {3: "g/cm^3"},
    "Pa": {3: "kPa", 6: "MPa", 9: "GPa"},
    "kg": {-3: "g", -6: "mg", -9: "ug", -12: "ng", -15: "pg"},
}


def unit_text(role: str, power: int) -> str:
    """The unit of a role that is a power of ten of the SI unit.

    >>> unit_text("depth", -6), unit_text("depth", 0), unit_text("radius", 5)
    ('um', 'm', '1e5 m')
    """
    unit = {**COLUMNS, **INPUTS}[role]
    return unit if power == 0 else _NAMED.get(unit, {}).get(power, f"1e{power} {unit}")


def power_of_ten(ratio: float) -> int | None:
    """The power of ten that a ratio is, None if it is none.

    >>> power_of_ten(1e-6), power_of_ten(1.0), power_of_ten(2.0)
    (-6, 0, None)
    """
    if not 0 < ratio < math.inf:
        return None
    power = math.log10(ratio)
    return round(power) if abs(power - round(power)) < 1e-9 else None


def times_too(power: int) -> str:
    """By which power of ten something is too large or too small.

    >>> times_too(-3)
    '1e3 times too small'
    """
    return f"1e{abs(power)} times too {'large' if power > 0 else 'small'}"


def scaled(value: float, factor: Fraction) -> float:
    """A number times a factor, as the decimal that the number was typed as; inf beyond doubles.

    >>> scaled(11.0, Fraction(1, 1_000_000)) == 11e-6
    True
    """
    if factor == 1 or not math.isfinite(value):
        return value
    try:
        return float(Fraction(repr(value)) * factor)
    except OverflowError:
        return math.copysign(math.inf, value)


def count(number: int, what: str) -> str:
    """A number of things.

    >>> count(1, "cell"), count(2, "cell")
    ('1 cell', '2 cells')
    """
    return f"{number:,} {what}" if number == 1 else f"{number:,} {what}s"
