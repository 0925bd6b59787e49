"""Write the finished record as files, and as text for a terminal. Nothing is computed here."""

import re
from collections.abc import Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from reference.ledger import INFERRED, Ledger
from reference.units import to_si
from replication.audit.assessment import Verdict
from replication.audit.record import ClaimRecord, EquationRecord, Finding, Record
from replication.audit.verdict import Judge
from replication.report import tables, words
from replication.report.prose import HTML, MARKDOWN, TERMINAL, Named, Prose, plain_quotation
from replication.report.terminal import Terminal, capital
from replication.text import json_text, number, quantity, rows_csv

if TYPE_CHECKING:
    from replication.report.arrangement import Arrangement

FILES = (
    "audit.html", "audit.md", "audit.json", "audit.csv", "hard-cases.txt", "workbook.xlsx",
    "figures/x.svg",
)  # fmt: skip
"""Names of files that must be writable in the audit's folder."""


def contents(record: Record, beside: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return every file of the folder by name; the record names those `beside` it with hashes."""
    from hashlib import sha256

    from replication.report.document import audit_document
    from replication.report.figures import draw_figures

    hashes = {name: sha256(content).hexdigest() for name, content in beside.items()}
    provenance = record.provenance | {"sha256": record.provenance["sha256"] | hashes}
    record = replace(record, provenance=provenance)
    drawings, document = draw_figures(record), audit_document(record)
    texts = {
        "audit.html": html(record, drawings),
        "audit.md": markdown(record),
        "audit.csv": _csv(document["claims"]),
        **{f"figures/{name}.svg": drawing for name, drawing in drawings.items()},
        "audit.json": json_text(document),
    }
    return {**beside, **{name: text.encode() for name, text in texts.items()}}


_COLUMNS = (
    "id", "where", "printed", "unit", "kind", "interval_lower", "interval_upper", "computed",
    "enclosure_lower", "enclosure_upper", "verdict", "error_in_last_digit", "title", "explanation",
    "holds", "restates",
)  # fmt: skip


def _csv(claims: Sequence[Mapping[str, Any]]) -> str:
    """Write one row for each claim of `audit.json`; fields that do not apply are empty."""
    rows = []
    for claim in claims:
        row = {name: claim.get(name) for name in _COLUMNS}
        for name in ("interval", "enclosure"):
            row[f"{name}_lower"], row[f"{name}_upper"] = claim[name] or (None, None)
        rows.append(row)
    return rows_csv(rows)


def html(record: Record, drawings: Mapping[str, str]) -> str:
    """Write the page, with the figures; it has no scripts and loads nothing from outside."""
    from replication import page
    from replication.report.arrangement import Arrangement

    arranged = Arrangement(record)
    prose = Prose(HTML, record.symbols, arranged.names)
    parts = {"drawings": drawings, "head": page.head("replication.report")}
    return _from_template("page.html.j2", prose, {**_common(arranged), **parts})


def markdown(record: Record) -> str:
    """Write the same as Markdown, without the figures."""
    from replication.report.arrangement import Arrangement

    arranged = Arrangement(record)
    prose = Prose(MARKDOWN, record.symbols, arranged.names)
    return _from_template("page.md.j2", prose, _common(arranged))


def _common(arranged: "Arrangement") -> dict[str, Any]:
    """Return what page and Markdown are made of."""
    return {"record": arranged.record, "arranged": arranged, "words": words, "tables": tables}


def _from_template(name: str, prose: Prose, parts: Mapping[str, Any]) -> str:
    """Fill a template of this folder; outside HTML, reduce several empty lines to one."""
    from markupsafe import Markup

    from replication import page

    finished = Markup if prose.form is HTML else str  # `prose` has escaped the sentence
    filters = {
        "capital": capital,
        "number": number,
        "printed_with_unit": words.printed_with_unit,
        # A macro returns Markup: str() keeps jinja2 from escaping in it what `prose` escapes.
        "prose": cache(lambda sentence: finished(prose(str(sentence)))),
        "plain_quotation": plain_quotation,
        "quantity": quantity,
        "slug": lambda text: text.replace(",", "").replace(" ", "-"),
    }
    text = page.from_template("replication.report", name, parts, filters).lstrip()
    return text if prose.form is HTML else re.sub(r"\n{3,}", "\n\n", text)


# For a terminal

FINDINGS_ON_SCREEN = 3
"""The number of findings that fit on one screen."""


def summary(record: Record, width: int, strong: bool = False) -> str:
    """Write the audit on one screen: counts, what fails, main results, findings, the headline."""
    parts = {
        "record": record,
        "words": words,
        "verdicts": Verdict,
        "not_as_printed": tables.not_as_printed(record),
        "main": tables.main_results(record),
        "findings": record.findings[:FINDINGS_ON_SCREEN],
        "more": len(record.findings[FINDINGS_ON_SCREEN:]),
    }
    by_title = TERMINAL._replace(known="{title}")
    prose = Prose(by_title, record.symbols, words.names_of(record))
    writer = Terminal(prose, width, strong)
    helpers = {
        "fill": writer.filled,
        "grid": writer.grid,
        "judged": writer.judged,
        "strong": writer.emphasized,
    }
    return _from_template("summary.txt.j2", prose, {**parts, **helpers}).rstrip("\n")


def proof(
    claim: ClaimRecord,
    findings: Sequence[Finding],
    judge: Judge,
    width: int,
    strong: bool = False,
) -> str:
    """Write one claim with all that its verdict rests on, and the titles of the findings on it.

    Other entries are named by the ledger of the claim's judge.
    """
    names = _names(judge)
    writer = Terminal(_prose(judge.ledger, names), width, strong)
    stated, quote = claim.claim, writer.prose(plain_quotation(claim.claim.quote))
    parts = [
        writer.heading(stated.title, claim.id),
        writer.judged(f"{words.printed_with_unit(stated)}, {stated.place}:", claim.verdict),
        writer.filled(f'"{quote.replace("⟦", "").replace("⟧", "")}"'),
        "",
        writer.filled(writer.prose(f"{claim.explanation} {claim.scope}")),
    ]
    if claim.worked:
        by_hand = writer.prose(claim.worked.by_hand)
        formula = writer.prose(claim.worked.formula)
        parts += ["", writer.filled(formula), writer.filled(f"By hand: {by_hand}")]
    if facts := tables.facts(claim, names):
        parts += ["", writer.columns(facts)]
    shown = tables.explanation_tables(claim, names)
    return "\n".join([*parts, *writer.grids(shown), *writer.titles(findings)])


def equation_proof(
    equation: EquationRecord,
    findings: Sequence[Finding],
    judge: Judge,
    width: int,
    strong: bool = False,
) -> str:
    """Write one equation with what its verdict rests on, and the titles of the findings on it."""
    writer = Terminal(_prose(judge.ledger, _names(judge)), width, strong)
    shown = tables.constants(equation, judge.ledger), tables.repairs(equation.repairs)
    parts = [
        writer.heading(words.equation_title(equation), equation.id),
        writer.judged(f"{equation.equation.place}:", equation.verdict),
        writer.filled(writer.prose(plain_quotation(equation.text))),
        "",
        writer.filled(writer.prose(equation.explanation)),
    ]
    full = [table for table in shown if table.rows]
    return "\n".join([*parts, *writer.grids(full), *writer.titles(findings)])


def _names(judge: Judge) -> dict[str, Named]:
    """Return what every id of the judge's ledger refers to."""
    ledger = judge.ledger
    names = {name: Named(e.title) for name, e in ledger.equations.items()}
    for name, inferred in ledger.inferred.items():
        assumed = float(judge.value(INFERRED + name) / to_si(inferred.unit))
        value = words.measured(assumed, inferred.unit)
        names[INFERRED + name] = Named(inferred.title, value=value)
    for name, entry in ledger.claims.items():
        names[name] = Named(entry.title, value=words.printed_with_unit(entry))
    return names


def _prose(ledger: Ledger, names: Mapping[str, Named]) -> Prose:
    symbols = (symbol.shown for symbol in ledger.symbols.values())
    return Prose(TERMINAL, symbols, names)
