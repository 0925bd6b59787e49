"""Text for a terminal: what the proofs of claims and equations, and the summary, have in common."""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from replication.audit.assessment import Verdict
from replication.audit.record import Finding
from replication.report.prose import Prose
from replication.text import Table, columns, prose, table_text

_GREEN, _YELLOW, _RED = "\x1b[32m", "\x1b[33m", "\x1b[31m"
COLOURS: Mapping[Verdict, str] = {
    Verdict.REPRODUCED: _GREEN,
    Verdict.CONSISTENT: _GREEN,
    Verdict.AGREES: _GREEN,
    Verdict.WITHIN_ROUNDING: _YELLOW,
    Verdict.UNDECIDED: _YELLOW,
    Verdict.DIFFERS: _YELLOW,
    Verdict.NOT_REPRODUCED: _RED,
    Verdict.INCONSISTENT: _RED,
}
"""The verdicts that have a colour."""


class Terminal(NamedTuple):
    """Lays out text of so many columns.

    With `strong` headings are emphasized, and verdicts that end a line have a colour.
    """

    prose: Prose
    width: int
    strong: bool

    def filled(self, text: str, indent: str = "") -> str:
        """Wrap a paragraph; its later lines are indented more."""
        return prose(text, self.width, indent, indent and indent + "  ")

    def emphasized(self, text: str) -> str:
        """Mark a text as strong, if this is wanted."""
        return f"\x1b[1m{text}\x1b[0m" if self.strong else text

    def judged(self, text: str, verdict: Verdict) -> str:
        """Write a paragraph that ends with a verdict."""
        return self._coloured(self.filled(f"{text} {verdict}"), verdict)

    def _coloured(self, line: str, verdict: Verdict) -> str:
        """Colour the verdict that a line ends with; one that is broken over two lines has none."""
        if self.strong and verdict in COLOURS and line.endswith(f" {verdict}"):
            return f"{line.removesuffix(verdict)}{COLOURS[verdict]}{verdict}\x1b[0m"
        return line

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
        lines = table_text(Table("", heads, rows), self.width).splitlines()
        # Colours have no width: they are put in when the columns stand.
        for verdict in {cell for row in table.rows for cell in row if isinstance(cell, Verdict)}:
            lines = [
                self._coloured(line, verdict) if line.endswith(f"  {verdict}") else line
                for line in lines
            ]
        return "\n".join([caption, *lines])

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
