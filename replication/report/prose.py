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
_POWER = re.compile(r"\^(\([^()]*\))")


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
        return self._set(sentence, str, _lowered, lambda text: f"^{text}", self._name)

    def markdown(self, sentence: str) -> str:
        """For Markdown, where a bar would end a table's cell."""

        def reference(name: str) -> str:
            known = name in self.names
            return f"{self.markdown(self.names[name].title)} (`{name}`)" if known else f"`{name}`"

        return self._set(sentence, _escaped, _lowered, lambda text: f"^{text}", reference)

    def html(self, sentence: str) -> "Markup":
        """For a page: subscripts, powers and links as elements."""
        from markupsafe import Markup

        return Markup(  # noqa: S704  (every part is escaped)
            self._set(
                sentence, _typographic, "{}<sub>{}</sub>".format,
                lambda text: f"<sup>{text.strip('()')}</sup>", self._link,
            )
        )  # fmt: skip

    def _set(
        self,
        sentence: str,
        escaped: Callable[[str], str],
        lower: Callable[[str, str], str],
        raised: Callable[[str], str],
        reference: Callable[[str], str],
    ) -> str:
        def symbol(match: re.Match[str]) -> str:
            base, below = self._spelled[match[1]]
            return lower(base, below) if below else base

        def part(k: int, text: str) -> str:
            if k % 2:
                return reference(text)
            text = _SIGN.sub(_sign, text)
            text = self._pattern.sub(symbol, escaped(powers_of_ten(text)))
            return _POWER.sub(lambda power: raised(power[1]), text)

        return "".join(part(k, text) for k, text in enumerate(sentence.split("`")))

    def _name(self, name: str) -> str:
        return f"{self.text(self.names[name].title)} ({name})" if name in self.names else name

    def _link(self, name: str) -> str:
        if name not in self.names:
            return f"<code>{escape(name)}</code>"
        title, anchor, _ = self.names[name]
        inner = self.html(title)
        return f'<a href="#{anchor}">{inner}</a>' if anchor else str(inner)


def _sign(match: re.Match[str]) -> str:
    return _SIGNS.get(match[0]) or superscript(match[0][1:])


def _word(letter: str) -> str:
    """The name of a Greek letter, as a sentence spells it."""
    word = unicodedata.name(letter).rpartition(" ")[2]
    return word.capitalize() if letter.isupper() else word.lower()


def _lowered(base: str, below: str) -> str:
    return base + below.translate(_LOWERED)


def _typographic(text: str) -> str:
    """Escaped for HTML, with curly quotes and with numbers that stay with their names and units."""
    text = escape(re.sub('"([^"]*)"', r"“\1”", text).replace("'", "’"), quote=False)
    return _TOGETHER.sub("\N{NO-BREAK SPACE}", text)


_TOGETHER = re.compile(
    r"(?:(?<=\bEq\.)|(?<=\bEqs\.)|(?<=\bTable)|(?<=\bFigure)) (?=[\dA])"
    r"|(?<=\d) (?=%|[µmnkMG]?(?:m|s|g|Pa|si)\b)"
)


def _escaped(text: str) -> str:
    return text.replace("|", "\\|").replace("<", "&lt;")


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
