"""Write the finished record as files, and as text for a terminal. Nothing is computed here."""

import re
from collections.abc import Mapping, Sequence
from functools import cache
from hashlib import sha256
from typing import Any

from msgspec.structs import replace

from reference.ledger import INFERRED, Ledger
from replication import page
from replication.audit.record import ClaimRecord, EquationRecord, Finding, Record
from replication.report import tables, words
from replication.report.arrangement import Arrangement
from replication.report.document import audit_document
from replication.report.figures import draw_figures
from replication.report.prose import HTML, MARKDOWN, TERMINAL, Named, Prose, plain_quotation
from replication.text import (
    Table,
    columns,
    json_text,
    number,
    quantity,
    rows_csv,
    table_text,
)
from replication.text import prose as filled

FILES = (
    "audit.html", "audit.md", "audit.json", "audit.csv", "hard-cases.txt", "workbook.xlsx",
    "figures/x.svg",
)  # fmt: skip
"""Names of files that must be writable in the audit's folder."""


def contents(record: Record, beside: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return every file of the folder by name; the record names those `beside` it with hashes."""
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
    arranged = Arrangement(record)
    prose = Prose(HTML, record.symbols, arranged.names)
    parts = {"drawings": drawings, "head": page.head("replication.report")}
    return _from_template("page.html.j2", prose, {**_common(arranged), **parts})


def markdown(record: Record) -> str:
    """Write the same as Markdown, without the figures."""
    arranged = Arrangement(record)
    prose = Prose(MARKDOWN, record.symbols, arranged.names)
    return _from_template("page.md.j2", prose, _common(arranged))


def _common(arranged: Arrangement) -> dict[str, Any]:
    """Return what page and Markdown are made of."""
    return {"record": arranged.record, "arranged": arranged, "words": words, "tables": tables}


def _from_template(name: str, prose: Prose, parts: Mapping[str, Any]) -> str:
    """Fill a template of this folder; outside HTML, reduce several empty lines to one."""
    from markupsafe import Markup

    finished = Markup if prose.form is HTML else str  # `prose` has escaped the sentence
    filters = {
        "capital": lambda text: text[:1].upper() + text[1:] if text[:1].isascii() else text,
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

FINDINGS = 3
"""The number of findings that fit on one screen."""


def summary(record: Record, width: int, strong: bool = False) -> str:
    """Write the audit on one screen: counts, what fails, main results, findings, the headline."""
    parts = {
        "record": record,
        "words": words,
        "not_as_printed": tables.not_as_printed(record),
        "main": tables.main_results(record),
        "findings": record.findings[:FINDINGS],
        "more": len(record.findings[FINDINGS:]),
    }
    by_title = TERMINAL._replace(known="{title}")
    prose = Prose(by_title, record.symbols, words.names_of(record))
    return _on_terminal("summary.txt.j2", prose, parts, width, strong)


def proof(
    claim: ClaimRecord,
    findings: Sequence[Finding],
    ledger: Ledger,
    width: int,
    strong: bool = False,
) -> str:
    """Write one claim with all that its verdict rests on, and the titles of the findings on it.

    Other entries are named by the ledger.
    """
    names = _names(ledger)
    parts = {
        "record": claim,
        "facts": tables.facts(claim, names),
        "tables": tables.explanation_tables(claim),
        "findings": findings,
    }
    return _on_terminal("claim.txt.j2", _prose(ledger, names), parts, width, strong)


def equation_proof(
    equation: EquationRecord,
    findings: Sequence[Finding],
    ledger: Ledger,
    width: int,
    strong: bool = False,
) -> str:
    """Write one equation with what its verdict rests on, and the titles of the findings on it."""
    shown = tables.constants(equation, ledger), tables.repairs(equation.repairs)
    parts = {
        "record": equation,
        "title": words.equation_title(equation),
        "tables": [table for table in shown if table.rows],
        "findings": findings,
    }
    prose = _prose(ledger, _names(ledger))
    return _on_terminal("equation.txt.j2", prose, parts, width, strong)


def _names(ledger: Ledger) -> dict[str, Named]:
    """Return what every id of the ledger refers to."""
    names = {name: Named(e.title) for name, e in ledger.equations.items()}
    for name, inferred in ledger.inferred.items():
        value = words.measured(float(inferred.nominal), inferred.unit)
        names[f"{INFERRED}{name}"] = Named(inferred.title, value=value)
    for name, entry in ledger.claims.items():
        names[name] = Named(entry.title, value=words.printed_with_unit(entry))
    return names


def _prose(ledger: Ledger, names: Mapping[str, Named]) -> Prose:
    symbols = (symbol.shown for symbol in ledger.symbols.values())
    return Prose(TERMINAL, symbols, names)


def _on_terminal(
    name: str, prose: Prose, parts: Mapping[str, Any], width: int, strong: bool
) -> str:
    def wrapped(text: str, indent: str = "") -> str:
        return filled(text, width, indent, indent and indent + "  ")

    def in_columns(rows: Sequence[tuple[str, ...]]) -> str:
        return columns([tuple(map(prose, row)) for row in rows], width)

    def grid(table: Table) -> str:
        heads, *rows = (tuple(map(prose, row)) for row in (table.heads, *table.rows))
        return table_text(Table("", heads, rows), width)

    bold = "\x1b[1m{}\x1b[0m" if strong else "{}"
    helpers = {
        "fill": wrapped, "columns": in_columns, "table_text": grid, "strong": bold.format,
    }  # fmt: skip
    return _from_template(name, prose, {**parts, **helpers}).rstrip("\n")
