"""Sentences and tables about a record and its claims, shared by HTML page, Markdown and terminal.

They are plain text with ids between backticks. `Prose` then typesets Greek letters, subscripts and
powers in them, and turns ids into references.
"""

import re
import unicodedata
from collections.abc import Callable, Iterable, Mapping
from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN
from fractions import Fraction
from html import escape
from html.entities import html5
from typing import NamedTuple

from reference.ledger import shown
from reference.scheme import Scheme
from reference.units import superscript
from replication.audit import record as r
from replication.audit.comparison import SHARES
from replication.cases import INPUTS
from replication.text import Table, between, number, powers_of_ten, quantity, rounded


class Named(NamedTuple):
    """What an id between backticks refers to: its title, its anchor on the page, its value."""

    title: str
    anchor: str = ""
    value: str = ""


NO_VALUE = "no value"
"""Shown for a quantity that cannot be computed from misprinted inputs."""


def printed(claim: r.ClaimRecord) -> str:
    """Return what the report prints: a number with its unit, or the words of a remark."""
    return quantity(shown(claim.printed), claim.unit)


def measured(value: float | None, unit: str, digits: int = 6) -> str:
    """Return a computed number with its unit, or an empty text if there is none.

    >>> measured(7.669556888793411, "um"), measured(None, "um")
    ('7.66956 µm', '')
    """
    return "" if value is None else quantity(number(value, digits), unit)


_SCALES = {"radius": (1e6, "um"), "flow_stress": (1e-6, "MPa")}


def shown_range(effect: r.Effect) -> str:
    """Return the range of an effect's input in the customary unit of that input.

    >>> effect = r.Effect(input="radius", low=8.2e-6, high=1.38e-5, ratios=[], depths=[], why="")
    >>> shown_range(effect)
    '8.2 to 13.8 µm'
    """
    scale, unit = _SCALES.get(effect.input, (1.0, INPUTS[effect.input]))
    return quantity(between((effect.low * scale, effect.high * scale), 4), unit)


def names_of(record: r.Record) -> dict[str, Named]:
    """Return what each id of a record refers to."""
    equations = {
        e.id: Named(f"Eq. {e.number}" if e.number else e.title, f"equation-{e.id}")
        for e in record.equations
    }
    inferred = {
        f"inferred:{i.id}": Named(i.title, f"inferred-{i.id}", measured(i.assumed, i.unit))
        for i in record.inferred
    }
    claims = {c.id: Named(c.title, f"claim-{c.id}", printed(c)) for c in record.claims}
    return equations | inferred | claims


def facts(claim: r.ClaimRecord, names: Mapping[str, Named]) -> list[tuple[str, str]]:
    """Return what is known of a claim, beside verdict and explanation, as labels and texts."""
    unit, error, choice = claim.unit, claim.error_in_last_digit, claim.shown_by
    inputs = (
        " × ".join(f"`{name}` {names[name].value}" for name in entries)
        for entries in claim.rests_on.values()
    )
    readings = (
        f"{reading.name}: {measured(reading.computed, unit, 10)}, {reading.verdict}, "
        f"proven range {between(reading.enclosure)}. {reading.holds}"
        + (f" For instance (SI) {_values(reading.witness)}." if reading.witness else "")
        for reading in claim.readings
    )
    sources = (
        f"{s.title}, {s.address}, prints {quantity(s.says, s.unit)} ({s.applies})"
        for s in claim.sources
    )
    texts = {
        "rounds to it": quantity((claim.interval_text or "").replace("E", "e"), unit),
        "computed": measured(claim.computed, unit, 10),
        "to 25 digits": claim.reference,
        "proven range": claim.enclosure and between(claim.enclosure),
        "off by": error is not None
        and claim.verdict.is_open
        and f"{number(error, 3)} units of the last printed digit",
        "computed from": claim.computed is not None and ", ".join(inputs),
        "for instance (SI)": claim.witness and _values(claim.witness),
        "other readings": "; ".join(readings),
        "assumed": "; ".join(claim.assumes),
        "would still agree": choice
        and f"{quantity(between(choice.interval, 6, inward=True), choice.unit)}, by "
        + ", ".join(f"`{name}`" for name in choice.claims),
        "public sources": "; ".join(sources),
        "workbook cell": claim.workbook and f"`{claim.workbook}`",
    }
    return [(label, text.removesuffix(".")) for label, text in texts.items() if text]


def _values(values: Mapping[str, float]) -> str:
    return ", ".join(f"`{name}` {number(value, 10)}" for name, value in values.items())


def not_as_printed(record: r.Record) -> Table:
    """Return what is printed and what follows instead, for each claim that fails or is undecided.

    Each reading of an equation has a column.
    """
    claims = [claim for claim in record.claims if claim.verdict.is_open]
    needed = {c.claim: c.needed for equation in record.equations for c in equation.constants}
    as_printed = "computed as printed"
    readings = (reading.name for claim in claims for reading in claim.readings)
    *_, last = heads = tuple(dict.fromkeys([as_printed, *readings]))
    rows = []
    for claim in claims:
        values = {as_printed: claim.computed, **{x.name: x.computed for x in claim.readings}}
        texts = {name: f"{value:#.{significant(claim.printed)}g}"
                 for name, value in values.items() if value is not None}  # fmt: skip
        if claim.id in needed:
            texts[last] = "derived: " * (last == as_printed) + " or ".join(needed[claim.id])
        rows.append((f"`{claim.id}`", printed(claim), *(texts.get(head, "") for head in heads)))
    return Table("What does not come out as printed", ("number", "printed", *heads), rows)


def significant(text: str) -> int:
    """Count the significant digits of a printed number.

    >>> significant("0.0550"), significant(">= 2680"), significant("7.6E9")
    (3, 4, 2)
    """
    mantissa = re.split(r"[eE×\\]", text)[0]
    return len(re.sub(r"\D", "", mantissa).lstrip("0")) or 1


def tried(claim: r.ClaimRecord) -> list[Table]:
    """Return the explanations tried for a claim that fails, and the figures that judge a remark."""
    figures = [(f.means, measured(f.value, f.unit, 5) or NO_VALUE) for f in claim.figures]
    slips = [(s.name, str(s.departures), measured(s.value, "1", 4), s.fits) for s in claim.slips]
    inputs = []
    for entry in dict.fromkeys(solved.entry for solved in claim.back_solved):
        by_reading = [solved for solved in claim.back_solved if solved.entry == entry]
        first, needed = by_reading[0], map(_needed, by_reading)
        search = f"{between(first.search, 4)}: {first.search_reason}"
        inputs.append((f"`{entry}`", measured(first.printed, first.unit), *needed, search))
    readings = dict.fromkeys(solved.reading or "as printed" for solved in claim.back_solved)
    heads = ("input", "printed", *(f"needed, {reading}" for reading in readings), "searched")
    changed = "Proven values of one input that would give the number, all others as printed"
    tables = (
        Table("The figures to judge it by", ("what", "computed"), figures),
        Table(changed, heads, inputs),
        repairs(claim.repairs, claim.id),
        Table(_slips_title(claim), ("Eq. 16 with", "slips", "gives", "fits"), slips),
    )
    return [shown for shown in tables if shown.rows]


def _slips_title(claim: r.ClaimRecord) -> str:
    """Say how large the family of slips is, and how many of it would fit by accident."""
    tried = claim.slips_tried
    if tried is None:
        return ""
    return (
        f"Slips in Eq. 16 that give it: {len(claim.slips)} of {tried.members:,} tried; "
        f"{tried.expected:.1f} would by accident"
    )


def _needed(solved: r.BackSolvedRecord) -> str:
    if not solved.intervals:
        return "undecided" if solved.proof == r.Proof.UNDECIDED else "none"
    ends = ", ".join(between(ends, 6, inward=True) for ends in solved.intervals)
    beyond = " or beyond" if solved.proof == r.Proof.TO_AN_END else ""
    return quantity(ends, solved.unit) + beyond


def repairs(records: Iterable[r.RepairRecord], claim: str = "") -> Table:
    """Return the misprints that would make a claim or equation agree.

    A claim, named by its id, is not listed among those that still fail: where another reading of
    its equation agrees, it fails only as printed.
    """
    rows = []
    for repair in records:
        failing = ", ".join(f"`{name}`" for name in repair.failing if name != claim) or "nothing"
        texts = f"`{repair.entry}`", quoted(repair.printed), quoted(repair.text)
        rows.append((*texts, repair.kind, repair.reading or "as printed", failing))
    heads = ("text of", "printed", "instead", "edit", "read", "what else still fails")
    caption = "Misprints that would give it: one edit of the text, all else as printed"
    return Table(caption, heads, rows)


def evidence(finding: r.Finding) -> Table:
    """Return the numbers of a finding, as stated and as computed."""
    rows = [
        (x.means, quantity(x.asserted, x.unit), computed(x) + ": NOT AS STATED" * (not x.holds))
        for x in finding.evidence
    ]
    return Table("The finding's numbers, recomputed", ("what", "stated", "computed"), rows)


def computed(piece: r.Evidence) -> str:
    """Return a finding's computed number, with two digits more than the stated one.

    A number that must exceed a bound is rounded down, one that must stay below is rounded up.

    >>> piece = r.Evidence(
    ...     name="", means="", unit="1", asserted=">= 1.147", computed=1.1475699, holds=True
    ... )
    >>> computed(piece)
    '1.14756'
    """
    if piece.computed is None:
        return NO_VALUE
    if isinstance(piece.computed, bool):
        return "yes" if piece.computed else "no"
    safe = {">": ROUND_FLOOR, "<": ROUND_CEILING}.get(piece.asserted[:1], ROUND_HALF_EVEN)
    digits = significant(piece.asserted) + 2
    return quantity(rounded(Fraction(piece.computed), digits, safe), piece.unit)


def proven(claims: Iterable[r.ClaimRecord]) -> Table:
    """Return the computed cells of Table A-1 to ten digits, with their proven ranges."""
    rows = [
        (c.title, c.cell or "", measured(c.computed, c.unit, 10), between(c.enclosure))
        for c in claims
        if c.enclosure is not None
    ]
    return Table("Cells of Table A-1", ("what", "cell", "computed", "proven range"), rows)


def approaches(record: r.Record) -> Table:
    """Return X/R by every approach."""
    rows = [
        (f"{a.kind}: {a.name}",
         "not recomputable" if a.computed is None else number(a.computed, 5),
         f"{a.printed} `{a.claim}`" if a.claim else "")
        for a in record.approaches
    ]  # fmt: skip
    return Table("Normalized depth X/R", ("approach", "computed", "printed"), rows)


def ladders(record: r.Record) -> Table:
    """Return the sheet's final depth: a row for each time step, a column for case and scheme."""
    columns = dict.fromkeys((level.beta, level.scheme) for level in record.ladders)
    rows: dict[float, list[str]] = {}
    for level in record.ladders:
        text = f"{level.depth * 1e6:.6f} ({level.error * 1e9:+.3f})"
        rows.setdefault(level.step, [f"{number(level.step * 1e9)} ns"]).append(text)
    heads = (f"beta = {beta:g}, {Scheme(scheme).drag_at} velocity" for beta, scheme in columns)
    caption = "Final depth of the sheet [um] (error [nm]), by the velocity at which drag is taken"
    return Table(caption, ("time step", *heads), [tuple(row) for row in rows.values()])


def sensitivity(case: r.Sensitivity) -> Table:
    """Return how the depth of a case changes over the range of each input."""
    rows = [
        (e.input.replace("_", " "), f"{case.elasticities[e.input]:+.3f}", shown_range(e),
         " to ".join(f"{depth * 1e6:.3f}" for depth in e.depths),
         " to ".join(dict.fromkeys(f"{ratio:.4f}" for ratio in e.ratios)), e.why)
        for e in case.stated
    ]  # fmt: skip
    heads = ("input", "d ln X / d ln input", "range", "X [um]", "X/R", "source of the range")
    return Table(f"Derivatives and stated ranges, beta = {case.beta:g}", heads, rows)


def scatter(record: r.Record) -> Table:
    """Return the scatter of velocity and X/R over the particles of the stream, by three laws."""
    shares = [f"V and X/R that {number(100 * share)} % do not exceed" for share in SHARES]
    rows = []
    for law in record.scatter:
        pairs = zip(law.velocities, law.ratios, strict=True)
        quantiles = (f"{v:.0f} m/s, {ratio:.3f}" for v, ratio in pairs)
        deviations = (f"{x:.1f} m/s" for x in (law.standard_deviation, law.mean_deviation))
        rows.append((law.law, *deviations, *quantiles))
    caption = "Velocity V and X/R of the stream's particles; deviations from sizes to first order"
    return Table(caption, ("law", "standard deviation", "mean deviation", *shares), rows)


# Typesetting


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


def quoted(text: str) -> str:
    r"""Convert a quotation from the report's LaTeX to plain text.

    >>> quoted(r"then $\beta = ⟦3^2⟧$, where $k_t\rho_t \leq \ln(2)$")
    'then β = ⟦3²⟧, where k_t ρ_t ≤ ln(2)'
    """
    text = re.sub(r"(?<=\w)(?=\\)", " ", shown(text))

    def sign(command: re.Match[str]) -> str:  # HTML names letters as LaTeX does
        name = command[1]
        return _COMMANDS.get(name, html5.get(f"{name};", name))

    return " ".join(re.sub(r"[$&]", "", re.sub(r"\\([A-Za-z]+)", sign, text)).split())
