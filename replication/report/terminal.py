"""What `coldspray audit` and `coldspray claims` print for a person."""

import re
from collections.abc import Iterable, Sequence
from itertools import zip_longest
from textwrap import fill, wrap
from typing import Any

from reference.findings import load
from reference.ledger import INFERRED, Claim, Ledger
from replication.audit.record import ClaimRecord, Record
from replication.audit.wording import quantity
from replication.report import facts as told
from replication.report.prose import Named, Prose
from replication.report.render import counted, environment
from replication.text import number

MAIN = (
    "depth-beta-3", "depth-beta-5", "ratio-beta-5", "observed-depth-ratio", "goodier-beta",
    "walker-anderson-beta",
)  # fmt: skip
"""The report's main results, by id."""

FINDINGS = 3
"""How many findings one screen has room for."""


def summary(record: Record, width: int, strong: bool = False) -> str:
    """The audit on one screen: what it found, the counts, all that fails, the main results."""
    rows = [
        (claim.title, told.printed(claim), quantity(number(claim.computed), claim.unit),
         claim.verdict)
        for claim in record.claims
        if claim.id in MAIN and claim.computed is not None
    ]  # fmt: skip
    return _rendered(
        Prose(record.symbols, {}),
        width,
        strong,
        record=record,
        counted=counted(record),
        verdicts=told.VERDICTS,
        failing=_by_title(record, told.failing(record)),
        main=told.Table("Main results", ("number", "printed", "computed", "verdict"), rows),
        shown=FINDINGS,
    )


def _by_title(record: Record, table: told.Table) -> told.Table:
    """The table with claims by their titles alone."""
    rows = [(record.claim(row[0].strip("`")).title, *row[1:]) for row in table.rows]
    return table._replace(rows=rows)


def proof(claim: ClaimRecord, ledger: Ledger, width: int, strong: bool = False) -> str:
    """One claim with all that its verdict rests on; the ledger names what it refers to."""
    names = (
        {name: Named(e.title) for name, e in ledger.equations.items()}
        | {f"{INFERRED}{name}": Named(e.title, "", quantity(number(e.nominal), e.unit))
           for name, e in ledger.inferred.items()}
        | {name: Named(c.title, "", quantity(c.shown, c.unit))
           for name, c in ledger.claims.items()}
    )  # fmt: skip
    return _rendered(
        Prose((symbol.shown for symbol in ledger.symbols.values()), names),
        width,
        strong,
        record=None,
        claim=claim,
        printed=told.printed,
        facts=told.facts(claim, names),
        tables=told.tried(claim),
        findings=[
            finding.title
            for finding in load().values()
            if claim.id in finding.claims and finding.kind != "headline"
        ],
    )


def _rendered(prose: Prose, width: int, strong: bool, **context: Any) -> str:
    def filled(text: str, indent: str = "") -> str:
        return fill(
            text, width, initial_indent=indent, subsequent_indent=indent + "  " * bool(indent),
            break_on_hyphens=False, break_long_words=False,
        )  # fmt: skip

    def table(rows: Sequence[tuple[str, ...]]) -> str:
        return columns([tuple(map(prose.text, row)) for row in rows], width)

    template = environment(prose.text, escaping=False).get_template("terminal.txt.j2")
    bold = "\x1b[1m{}\x1b[0m" if strong else "{}"
    text = template.render(context, fill=filled, columns=table, strong=bold.format)
    return re.sub(r"\n{3,}", "\n\n", text.strip("\n"))


def columns(rows: Sequence[tuple[str, ...]], width: int) -> str:
    """Rows as columns within a width; what is too long goes on in the next line.

    The columns give way that make the fewest lines of it. A word is broken only where the width
    leaves no choice.

    >>> print(columns([("a", "one two three"), ("bc", "four")], 14))
    a   one two
        three
    bc  four
    """
    texts = list(zip(*rows, strict=True))
    words = [max(len(word) for cell in column for word in cell.split() or [""]) for column in texts]
    # A head goes on in the next line before a cell below it does, and that before a word is broken.
    below = [max([word, *map(len, column[1:])]) for word, column in zip(words, texts, strict=True)]
    widths = [max(map(len, column)) for column in texts]
    lengths = [[len(cell) for cell in row] for row in rows]

    def narrowed(column: int) -> tuple[int, int]:
        """About how many lines there are with this column narrower; of equals, the widest."""
        trial = [max(width - (k == column), 1) for k, width in enumerate(widths)]
        lines = (max(-(-n // w) for n, w in zip(row, trial, strict=True)) for row in lengths)
        return sum(lines), -widths[column]

    for least in (below, words, [1] * len(words)):
        while sum(widths) + 2 * (len(widths) - 1) > width:
            room = [k for k, end in enumerate(least) if widths[k] > end]
            if not room:
                break
            widths[min(room, key=narrowed)] -= 1
    lines = []
    for row in rows:
        cells = [
            wrap(cell, max(w, 1), break_on_hyphens=False) or [""]
            for cell, w in zip(row, widths, strict=True)
        ]
        lines += [
            "  ".join(f"{part:{w}}" for part, w in zip(parts, widths, strict=True)).rstrip()
            for parts in zip_longest(*cells, fillvalue="")
        ]
    return "\n".join(lines)


def ledger_table(claims: Iterable[Claim], width: int) -> str:
    """The ledger, a line for each claim."""
    rows = [(c.id, quantity(c.shown, c.unit), c.kind, str(c.place)) for c in claims]
    return columns(rows, width)
