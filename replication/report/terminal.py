"""Text for a terminal: what the proofs of claims and equations, and the summary, have in common."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from replication.audit.record import Finding
from replication.report.prose import Prose
from replication.text import Table, columns, prose, table_text


class Terminal(NamedTuple):
    """Lays out text of so many columns. `strong`: headings are emphasized."""

    prose: Prose
    width: int
    strong: bool

    def filled(self, text: str, indent: str = "") -> str:
        """Wrap a paragraph; its later lines are indented more."""
        return prose(text, self.width, indent, indent and indent + "  ")

    def emphasized(self, text: str) -> str:
        """Mark a text as strong, if this is wanted."""
        return f"\x1b[1m{text}\x1b[0m" if self.strong else text

    def heading(self, title: str, name: str) -> str:
        """Write the title of an entry and its id."""
        return self.emphasized(self.filled(f"{capital(self.prose(title))} ({name})"))

    def columns(self, rows: Sequence[tuple[str, ...]]) -> str:
        """Write rows in columns."""
        return columns([tuple(map(self.prose, row)) for row in rows], self.width)

    def grid(self, table: Table) -> str:
        """Write a table below its caption."""
        heads, *rows = (tuple(map(self.prose, row)) for row in (table.heads, *table.rows))
        caption = self.emphasized(self.filled(self.prose(table.caption)))
        return f"{caption}\n{table_text(Table('', heads, rows), self.width)}"

    def grids(self, shown: Sequence[Table]) -> Iterator[str]:
        """Yield tables, each after an empty line."""
        for table in shown:
            yield from ("", self.grid(table))

    def titles(self, findings: Sequence[Finding]) -> Iterator[str]:
        """Yield the titles of findings below a heading, if there are any."""
        if findings:
            yield from ("", self.emphasized("Findings on it"))
        for finding in findings:
            yield self.filled(self.prose(finding.title), "  ")


def capital(text: str) -> str:
    """Return a text that begins with a capital letter, unless that is a symbol's.

    >>> capital("depth"), capital("β")
    ('Depth', 'β')
    """
    return text[:1].upper() + text[1:] if text[:1].isascii() else text
