"""Write the finished record as files, and as text for a terminal. Nothing is computed here."""

import re
from collections.abc import Mapping, Sequence
from functools import cache
from hashlib import sha256
from string import ascii_lowercase
from textwrap import fill
from typing import Any

import msgspec

from reference.ledger import INFERRED, Ledger, in_header
from replication import page
from replication.audit.record import ClaimRecord, Finding, Record, Verdict
from replication.power import measured
from replication.report import words
from replication.report.figures import draw
from replication.report.words import HTML, MARKDOWN, TERMINAL, Named, Prose, quoted
from replication.text import Table, between, columns, json_text, number, quantity, rows_csv

FILES = (
    "audit.html", "audit.md", "audit.json", "audit.csv", "hard-cases.txt", "workbook.xlsx",
    "figures/x.svg",
)  # fmt: skip
"""Names of files that must be writable in the audit's folder."""


def contents(record: Record, beside: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return every file of the folder by name; the record names those `beside` it with hashes."""
    hashes = {name: sha256(content).hexdigest() for name, content in beside.items()}
    provenance = record.provenance | {"sha256": record.provenance["sha256"] | hashes}
    record = msgspec.structs.replace(record, provenance=provenance)
    drawings = draw(record)
    texts = {
        "audit.html": html(record, drawings),
        "audit.md": markdown(record),
        "audit.csv": _csv(record),
        **{f"figures/{name}.svg": drawing for name, drawing in drawings.items()},
        "audit.json": json_text(record),
    }
    return {**beside, **{name: text.encode() for name, text in texts.items()}}


_COLUMNS = (
    "id", "where", "printed", "unit", "kind", "interval_lower", "interval_upper", "computed",
    "enclosure_lower", "enclosure_upper", "verdict", "error_in_last_digit", "title", "explanation",
    "holds", "restates",
)  # fmt: skip


def _csv(record: Record) -> str:
    """Write one row for each claim; fields that do not apply are empty."""
    rows = []
    for claim in record.claims:
        row = {name: getattr(claim, name, None) for name in _COLUMNS}
        for name in ("interval", "enclosure"):
            row[f"{name}_lower"], row[f"{name}_upper"] = getattr(claim, name) or (None, None)
        rows.append(row)
    return rows_csv(rows)


def html(record: Record, drawings: Mapping[str, str]) -> str:
    """Write the page, with the figures; it has no scripts and loads nothing from outside."""
    parts = _arranged(record) | {"drawings": drawings, "head": page.head("replication.report")}
    return _filled("page.html.j2", Prose(HTML, record.symbols, parts["names"]), parts)


def markdown(record: Record) -> str:
    """Write the same as Markdown, without the figures."""
    parts = _arranged(record)
    return _filled("page.md.j2", Prose(MARKDOWN, record.symbols, parts["names"]), parts)


def _filled(name: str, prose: Prose, parts: Mapping[str, Any]) -> str:
    """Fill a template of this folder; outside HTML, reduce several empty lines to one."""
    from markupsafe import Markup

    finished = Markup if prose.form is HTML else str  # `prose` has escaped the sentence
    filters = {
        "capital": lambda text: text[:1].upper() + text[1:] if text[:1].isascii() else text,
        "number": number,
        "printed": words.printed,
        # A macro returns Markup: str() keeps jinja2 from escaping in it what `prose` escapes.
        "prose": cache(lambda sentence: finished(prose(str(sentence)))),
        "quoted": quoted,
        "slug": lambda text: text.replace(",", "").replace(" ", "-"),
    }
    text = page.filled("replication.report", name, parts, filters).lstrip()
    return text if prose.form is HTML else re.sub(r"\n{3,}", "\n\n", text)


def _arranged(record: Record) -> dict[str, Any]:
    """Return what page and Markdown need: the record, its claims by section, and helpers."""
    groups, names = _groups(record), words.names_of(record)
    by_hand_first = sorted(record.findings, key=lambda finding: not finding.by_hand)
    concerned = {name for finding in record.findings for name in finding.claims}
    sources = {claim.id: claim.sources for claim in record.claims}
    sources |= {f"{INFERRED}{i.id}": i.sources for i in record.inferred if i.sources}
    return {
        "record": record,
        "groups": groups,
        "names": names,
        "quantity": quantity,
        "tables": words,
        "between": between,
        "equation_of": {c.claim: e for e in record.equations for c in e.constants},
        # The findings that concern mostly what does not come out as printed.
        "on_open": [
            finding
            for finding in record.findings
            if 2 * sum(name in groups["open"] for name in finding.claims) >= len(finding.claims)
        ],
        "touching": {name: [f for f in by_hand_first if name in f.claims] for name in concerned},
        "sources": {name: records for name, records in sources.items() if records},
        "table": _table_a_1(groups["table-a-1"]),
        "power": measured(),
    }


def _groups(record: Record) -> dict[str, dict[str, ClaimRecord]]:
    """Sort the claims into the sections of the page; each is in one section only."""
    constants = {c.claim for equation in record.equations for c in equation.constants}
    by_verdict = {
        Verdict.REPRODUCED: "computed", Verdict.CONSISTENT: "repeated", Verdict.AGREES: "sources",
        Verdict.DIFFERS: "sources", Verdict.REMARK: "remarks", Verdict.NOT_CHECKABLE: "undecided",
    }  # fmt: skip
    names = ("open", "equations", "table-a-1", *dict.fromkeys(by_verdict.values()))
    groups: dict[str, dict[str, ClaimRecord]] = {name: {} for name in names}
    for claim in record.claims:
        name = by_verdict.get(claim.verdict, "open")
        if name != "open" and claim.id in constants:
            name = "equations"
        elif name != "open" and claim.cell:
            name = "table-a-1"
        groups[name][claim.id] = claim
    return groups


def _table_a_1(claims: dict[str, ClaimRecord]) -> dict[str, Any]:
    """Arrange Table A-1 as printed, with a letter for each verdict and its conventions."""
    cells = {str(claim.cell): claim for claim in claims.values()}
    notes = {c.id: (c.verdict, c.holds or c.explanation) for c in claims.values()}
    letters = dict(zip(dict.fromkeys(notes.values()), ascii_lowercase, strict=False))
    below = [cell for cell in cells if not in_header(cell)]
    heads = {cell[0]: cells[cell].title.partition(",")[0] for cell in below}
    columns, rows = sorted(heads), sorted({int(cell[1:]) for cell in below})
    return {
        "header": [claim for cell, claim in cells.items() if in_header(cell)],
        "heads": [heads[column] for column in columns],
        # A cell without a claim in this section is blank, or fails and is shown further up.
        "rows": [[cells.get(c + str(row), c + str(row)) for c in columns] for row in rows],
        "letters": letters,
        "marks": {name: letters[note] for name, note in notes.items()},
        "assumed": "; ".join(dict.fromkeys(a for c in claims.values() for a in c.assumes)),
    }


# For a terminal

MAIN = (
    "depth-beta-3", "depth-beta-5", "ratio-beta-5", "observed-depth-ratio", "goodier-beta",
    "walker-anderson-beta",
)  # fmt: skip
"""The ids of the report's main results."""

FINDINGS = 3
"""The number of findings that fit on one screen."""


def summary(record: Record, width: int, strong: bool = False) -> str:
    """Write the audit on one screen: headline, counts, what fails, main results, findings."""
    main = [
        (c.title, words.printed(c), words.measured(c.computed, c.unit), c.verdict)
        for c in record.claims
        if c.id in MAIN and c.computed is not None
    ]
    context = {
        "record": record,
        "not_as_printed": words.not_as_printed(record),
        "main": Table("Main results", ("number", "printed", "computed", "verdict"), main),
        "shown": FINDINGS,
    }
    by_title = TERMINAL._replace(known="{title}")
    prose = Prose(by_title, record.symbols, words.names_of(record))
    return _terminal(prose, context, width, strong)


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
    names = {name: Named(e.title) for name, e in ledger.equations.items()}
    for name, inferred in ledger.inferred.items():
        value = words.measured(float(inferred.nominal), inferred.unit)
        names[f"{INFERRED}{name}"] = Named(inferred.title, value=value)
    for name, entry in ledger.claims.items():
        names[name] = Named(entry.title, value=quantity(entry.shown, entry.unit))
    context = {
        "record": None,
        "claim": claim,
        "facts": words.facts(claim, names),
        "tables": words.tried(claim),
        "findings": [finding.title for finding in findings],
    }
    symbols = (symbol.shown for symbol in ledger.symbols.values())
    return _terminal(Prose(TERMINAL, symbols, names), context, width, strong)


def _terminal(prose: Prose, context: Mapping[str, Any], width: int, strong: bool) -> str:
    def filled(text: str, indent: str = "") -> str:
        hanging = indent and indent + "  "
        return fill(
            text, width, initial_indent=indent, subsequent_indent=hanging,
            break_on_hyphens=False, break_long_words=False,
        )  # fmt: skip

    def table(rows: Sequence[tuple[str, ...]]) -> str:
        return columns([tuple(map(prose, row)) for row in rows], width)

    bold = "\x1b[1m{}\x1b[0m" if strong else "{}"
    helpers = {"fill": filled, "columns": table, "strong": bold.format}
    return _filled("terminal.txt.j2", prose, {**context, **helpers}).rstrip("\n")
