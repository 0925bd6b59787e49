"""Sentences of the record as a reader sees them: Greek letters, subscripts, powers, references."""

import re
import unicodedata
from collections.abc import Callable, Iterable, Mapping
from html import escape
from typing import TYPE_CHECKING, NamedTuple

from reference.ledger import shown
from reference.units import superscript
from replication.text import powers_of_ten

if TYPE_CHECKING:
    from markupsafe import Markup


class Named(NamedTuple):
    """What an id between backticks names, where a page shows it, and its value as printed."""

    title: str
    anchor: str = ""
    value: str = ""


_LOWERED = str.maketrans("0123456789aehklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉ₐₑₕₖₗₘₙₒₚᵣₛₜᵤᵥₓ")
_SIGNS = {
    "<=": "≤", ">=": "≥", " * ": " · ", " - ": " − ", "-": "−", "inf": "∞", "um": "µm",
}  # fmt: skip
_SIGN = re.compile(r"<=|>=| [*-] |(?<![\w)\]])-(?=\d|\(|inf\b)|\binf\b|\bum\b|\^(?:-?\d+|n\b)")
_POWER = re.compile(r"\^(\(([^()]*)\))")


class Prose:
    """Turns the record's plain sentences into HTML, Markdown or text for a terminal.

    `symbols` are written as "ρ_t"; in a sentence the Greek letter may be spelled out. An id stands
    between backticks, and `names` tells what it names.

    >>> prose = Prose(["ρ_t", "V"], {"a1-density": Named("particle density", "claim-a1-density")})
    >>> prose.text("`a1-density`: rho_t V^2 is 2e+09 Pa, -8 %")
    'particle density (a1-density): ρₜ V² is 2×10⁹ Pa, −8 %'
    >>> print(prose.html("rho_t < `a1-density`"))
    ρ<sub>t</sub> &lt; <a href="#claim-a1-density">particle density</a>
    """

    def __init__(self, symbols: Iterable[str], names: Mapping[str, Named]) -> None:
        self.names = names
        spelled: dict[str, tuple[str, str]] = {}
        for symbol in symbols:
            base, _, below = symbol.partition("_")
            greek = not base.isascii() and len(base) == 1
            if below or greek:
                words = (_word(base), _word(base).capitalize()) if greek else (base,)
                for word in (base, *words):
                    spelled.setdefault(f"{word}_{below}".rstrip("_"), (base, below))
        longest_first = sorted(spelled, key=lambda name: (-len(name), name))
        self._spelled = spelled
        self._pattern = re.compile(
            rf"(?<![^\W\d])({'|'.join(map(re.escape, longest_first)) or '(?!)'})(?!\w)"
        )

    def text(self, sentence: str) -> str:
        """For a terminal: subscripts and powers in Unicode."""
        return self._set(sentence, _TERMINAL)

    def markdown(self, sentence: str) -> str:
        """For Markdown, where a bar would end a table's cell."""
        return self._set(sentence, _MARKDOWN)

    def html(self, sentence: str) -> "Markup":
        """For a page: subscripts, powers and links as elements."""
        from markupsafe import Markup

        return Markup(self._set(sentence, _HTML))  # noqa: S704  (every part is escaped)

    def _set(self, sentence: str, form: "_Form") -> str:
        def symbol(match: re.Match[str]) -> str:
            base, below = self._spelled[match[1]]
            return form.lowered(base, below) if below else base

        def part(k: int, text: str) -> str:
            if k % 2:
                return self._reference(text, form)
            text = _SIGN.sub(lambda sign: _SIGNS.get(sign[0]) or superscript(sign[0][1:]), text)
            text = self._pattern.sub(symbol, form.escaped(powers_of_ten(text)))
            return _POWER.sub(form.power, text)

        return "".join(part(k, text) for k, text in enumerate(sentence.split("`")))

    def _reference(self, name: str, form: "_Form") -> str:
        code = form.code.format(escape(name))
        if name not in self.names:
            return code
        title, anchor, _ = self.names[name]
        return form.known.format(title=self._set(title, form), code=code, anchor=anchor)


def _word(letter: str) -> str:
    """The name of a Greek letter, as a sentence spells it."""
    word = unicodedata.name(letter).rpartition(" ")[2]
    return word.capitalize() if letter.isupper() else word.lower()


def _typographic(text: str) -> str:
    """Escaped for HTML, with curly quotes and with numbers that stay with their names and units."""
    text = escape(re.sub('"([^"]*)"', r"“\1”", text).replace("'", "’"), quote=False)
    return _TOGETHER.sub("\N{NO-BREAK SPACE}", text)


_TOGETHER = re.compile(
    r"(?:(?<=\bEq\.)|(?<=\bEqs\.)|(?<=\bTable)|(?<=\bFigure)) (?=[\dA])"
    r"|(?<=\d) (?=%|[µmnkMG]?(?:m|s|g|Pa|si)\b)"
)


class _Form(NamedTuple):
    """How a text is escaped, a subscript and a power in brackets set, an id and what it names."""

    escaped: Callable[[str], str]
    lowered: Callable[[str, str], str]
    power: str
    code: str
    known: str


_TERMINAL = _Form(
    str, lambda base, below: base + below.translate(_LOWERED), r"^\1", "{}", "{title} ({code})"
)
_MARKDOWN = _TERMINAL._replace(
    escaped=lambda text: text.replace("|", "\\|").replace("<", "&lt;"), code="`{}`"
)
_HTML = _Form(
    _typographic, "{}<sub>{}</sub>".format, r"<sup>\2</sup>", "<code>{}</code>",
    '<a href="#{anchor}">{title}</a>',
)  # fmt: skip


def quoted(text: str) -> str:
    r"""Words of the report without the marks of LaTeX in which they were read.

    >>> quoted(r"then $\beta = ⟦3^2⟧$, where $k_t\rho_t \leq \ln(2)$")
    'then β = ⟦3²⟧, where k_t ρ_t ≤ ln(2)'
    """
    text = re.sub(r"(?<=\w)(?=\\)", " ", shown(text))
    text = re.sub(r"\\([A-Za-z]+)", lambda command: _command(command[1]), text)
    return " ".join(re.sub(r"[$&]", "", text).split())


def _command(name: str) -> str:
    if name in _COMMANDS:
        return _COMMANDS[name]
    size = "CAPITAL" if name[0].isupper() else "SMALL"
    try:
        return unicodedata.lookup(f"GREEK {size} LETTER {name}")
    except KeyError:  # a function, such as ln
        return name


_COMMANDS = {"leq": "≤ ", "geq": "≥ ", "quad": " ", "text": ""}
