"""Typeset plain sentences as HTML, as Markdown or for a terminal.

A sentence is plain text with ids between backticks. `Prose` typesets Greek letters, subscripts and
powers in it, and turns ids into references. `quoted` converts a quotation from the report's LaTeX.
"""

import re
import unicodedata
from collections.abc import Callable, Iterable, Mapping
from html import escape
from html.entities import html5
from typing import NamedTuple

from reference.ledger import as_shown
from reference.units import superscript
from replication.text import powers_of_ten


class Named(NamedTuple):
    """What an id between backticks refers to: its title, its anchor on the page, its value."""

    title: str
    anchor: str = ""
    value: str = ""


_LOWERED = str.maketrans("0123456789aehklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉ₐₑₕₖₗₘₙₒₚᵣₛₜᵤᵥₓ")
_SIGNS = {
    "<=": "≤", ">=": "≥", " * ": " · ", " - ": " − ", "-": "−", "inf": "∞", "um": "µm",
}  # fmt: skip
_SIGN = re.compile(r"<=|>=| [*-] |(?<![\w)\]])-(?=\d|\(|inf\b)|\binf\b|\bum\b|\^(?:-?\d+|n\b)")
_POWER = re.compile(r"\^(\(([^()]*)\))")


def _typographic(text: str) -> str:
    """Escape a text for HTML, with curly quotes, and no line breaks within "Eq. 1" or "5 um"."""
    text = escape(re.sub('"([^"]*)"', r"“\1”", text).replace("'", "’"), quote=False)
    return _TOGETHER.sub("\N{NO-BREAK SPACE}", text)


_TOGETHER = re.compile(  # beginning with the space makes the search fast
    r" (?=[\dA])(?:(?<=\bEq\. )|(?<=\bEqs\. )|(?<=\bTable )|(?<=\bFigure ))"
    r"| (?<=\d )(?=%|[µmnkMG]?(?:m|s|g|Pa|si)\b)"
)


class Form(NamedTuple):
    """How to escape a text, and to write a subscript, a power in brackets, an id, and its title."""

    escaped: Callable[[str], str]
    lowered: Callable[[str, str], str]
    power: str
    code: str
    known: str


TERMINAL = Form(
    str, lambda base, below: base + below.translate(_LOWERED), r"^\1", "{}", "{title} ({code})"
)
MARKDOWN = TERMINAL._replace(  # a vertical bar would end a table cell
    escaped=lambda text: text.replace("|", "\\|").replace("<", "&lt;"), code="`{}`"
)
HTML = Form(
    _typographic, "{}<sub>{}</sub>".format, r"<sup>\2</sup>", "<code>{}</code>",
    '<a href="#{anchor}">{title}</a>',
)  # fmt: skip


class Prose:
    """Typesets the record's plain sentences in a form: HTML, Markdown, or text for a terminal.

    `symbols` are written like "ρ_t"; a sentence may spell the Greek letter ("rho_t"). Ids stand
    between backticks, and `names` says what they refer to.

    >>> names = {"a1-density": Named("particle density", "claim-a1-density")}
    >>> Prose(TERMINAL, ["ρ_t", "V"], names)("`a1-density`: rho_t V^2 is 2e+09 Pa, -8 %")
    'particle density (a1-density): ρₜ V² is 2×10⁹ Pa, −8 %'
    >>> Prose(HTML, ["ρ_t", "V"], names)("rho_t < `a1-density`")
    'ρ<sub>t</sub> &lt; <a href="#claim-a1-density">particle density</a>'
    """

    def __init__(self, form: Form, symbols: Iterable[str], names: Mapping[str, Named]) -> None:
        self.form, self.names = form, names
        self._symbols: dict[str, str] = {}
        for symbol in symbols:
            base, _, below = symbol.partition("_")
            spellings = [base] if below else []
            if not base.isascii() and len(base) == 1:  # a Greek letter
                word = unicodedata.name(base).rpartition(" ")[2].capitalize()
                spellings = [base, word] if base.isupper() else [base, word, word.lower()]
            for spelling in spellings:
                typeset = form.lowered(base, below) if below else base
                self._symbols.setdefault(f"{spelling}_{below}".rstrip("_"), typeset)
        longest_first = sorted(self._symbols, key=lambda name: (-len(name), name))
        self._pattern = re.compile(
            rf"(?<![^\W\d])({'|'.join(map(re.escape, longest_first)) or '(?!)'})(?![A-Za-z_\d])"
        )

    def __call__(self, sentence: str) -> str:
        parts = sentence.split("`")
        parts[::2] = map(self._text, parts[::2])
        parts[1::2] = map(self._reference, parts[1::2])
        return "".join(parts)

    def _text(self, text: str) -> str:
        text = _SIGN.sub(lambda sign: _SIGNS.get(sign[0]) or superscript(sign[0][1:]), text)
        text = self.form.escaped(powers_of_ten(text))
        text = self._pattern.sub(lambda symbol: self._symbols[symbol[1]], text)
        return _POWER.sub(self.form.power, text)

    def _reference(self, name: str) -> str:
        code = self.form.code.format(escape(name))
        if name not in self.names:
            return code
        title, anchor, _ = self.names[name]
        return self.form.known.format(title=self(title), code=code, anchor=anchor)


_COMMANDS = {"leq": "≤ ", "geq": "≥ ", "quad": " ", "text": ""}


def plain_quotation(text: str) -> str:
    r"""Convert a quotation from the report's LaTeX to plain text.

    >>> plain_quotation(r"then $\beta = ⟦3^2⟧$, where $k_t\rho_t \leq \ln(2)$")
    'then β = ⟦3²⟧, where k_t ρ_t ≤ ln(2)'
    """
    text = re.sub(r"(?<=\w)(?=\\)", " ", as_shown(text))

    def sign(command: re.Match[str]) -> str:  # HTML names letters as LaTeX does
        name = command[1]
        return _COMMANDS.get(name, html5.get(f"{name};", name))

    return " ".join(re.sub(r"[$&]", "", re.sub(r"\\([A-Za-z]+)", sign, text)).split())
