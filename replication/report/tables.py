"""The record's tables, for the page, Markdown and the terminal alike; texts are for `Prose`."""

import re
from collections.abc import Iterable, Mapping, Sequence
from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN
from fractions import Fraction
from typing import NamedTuple

from replication.audit.record import (
    BackSolvedRecord,
    ClaimRecord,
    EvidenceRecord,
    FindingRecord,
    Record,
    RepairRecord,
)
from replication.audit.wording import quantity
from replication.report.facts import OPEN, between, printed, shown_range
from replication.report.prose import quoted
from replication.text import number, rounded


class Table(NamedTuple):
    """A table; the first cell of a row is its head."""

    caption: str
    heads: tuple[str, ...]
    rows: Sequence[tuple[str, ...]]


def failing(record: Record) -> Table:
    """The claims that do not come out as printed: what is printed, and what follows instead."""
    claims = [claim for claim in record.claims if claim.verdict in OPEN]
    needed = {c.claim: c.needed for equation in record.equations for c in equation.constants}
    names = list(dict.fromkeys(reading.name for claim in claims for reading in claim.readings))
    rows = []
    for claim in claims:
        shortened = f"#.{significant(claim.printed)}g"
        computed = "" if claim.computed is None else format(claim.computed, shortened)
        if claim.id in needed:
            computed = f"{' or '.join(needed[claim.id])} would follow"
        otherwise = {reading.name: f"{reading.computed:{shortened}}" for reading in claim.readings}
        others = (otherwise.get(name, "") for name in names)
        rows.append((f"`{claim.id}`", printed(claim), computed, *others))
    heads = ("number", "printed", "computed as printed", *names)
    return Table("What does not come out as printed", heads, rows)


def significant(text: str) -> int:
    """How many significant digits a printed number has.

    >>> significant("0.0550"), significant(">= 2680"), significant("7.6E9")
    (3, 4, 2)
    """
    mantissa = re.split(r"[eE×\\]", text)[0]
    return len(re.sub(r"\D", "", mantissa).lstrip("0")) or 1


# What was tried for a claim


def tried(claim: ClaimRecord) -> list[Table]:
    """What was tried to explain a claim that fails, and the figures that a remark is judged by."""
    figures = [(f.means, quantity(number(f.value, 5), f.unit)) for f in claim.figures]
    slips = [(s.name, s.reason, number(s.value, 3), s.fits or "no") for s in claim.slips]
    tables = (
        Table("The figures", ("what", "computed"), figures),
        _back_solved(claim.back_solved),
        repairs(claim.repairs, claim.id),
        Table("Slips the author may have made", ("slip", "what it is", "gives", "fits"), slips),
    )
    return [table for table in tables if table.rows]


def _back_solved(solved: Iterable[BackSolvedRecord]) -> Table:
    """A row for each input, a column for each reading."""
    found: dict[str, dict[str, BackSolvedRecord]] = {}
    for item in solved:
        found.setdefault(item.entry, {})[item.reading] = item
    readings = list(dict.fromkeys(reading for row in found.values() for reading in row))
    rows = []
    for entry, row in found.items():
        item = next(iter(row.values()))
        needed = (_needed(row[reading]) if reading in row else "" for reading in readings)
        search = f"{between(item.search, 4)}: {item.search_reason}"
        rows.append((f"`{entry}`", quantity(number(item.printed), item.unit), *needed, search))
    heads = (f"needed, {reading or 'as printed'}" for reading in readings)
    caption = "One input changed, all others as printed: proven values that would give the number"
    return Table(caption, ("input", "printed", *heads, "searched"), rows)


def _needed(solved: BackSolvedRecord) -> str:
    if not solved.intervals:
        return "undecided" if solved.proof == "undecided" else "none"
    ends = ", ".join(between(ends, 6, inward=True) for ends in solved.intervals)
    beyond = " or beyond" if "end of the range" in solved.proof else ""
    return quantity(ends, solved.unit) + beyond + ", prints alike" * solved.prints_alike


def repairs(records: Iterable[RepairRecord], own: str = "") -> Table:
    """The misprints that would explain a failure, of the claim with the id `own` if it is one.

    Read otherwise than printed this claim agrees; as printed it does not, which goes unsaid.
    """
    rows = [
        (
            f"`{repair.entry}`", quoted(repair.printed), quoted(repair.text), repair.kind,
            repair.reading or "as printed",
            ", ".join(f"`{name}`" for name in repair.failing if name != own) or "nothing",
        )
        for repair in records
    ]  # fmt: skip
    heads = ("text of", "printed", "instead", "edit", "read", "what else still fails")
    return Table("Misprints, one edit of the text, that would explain it", heads, rows)


def evidence(finding: FindingRecord) -> Table:
    """The numbers of a finding, as asserted and as computed."""
    rows = [
        (
            piece.means,
            quantity(piece.asserted, piece.unit),
            computed(piece) + ("" if piece.holds else ": NOT AS STATED"),
        )
        for piece in finding.evidence
    ]
    return Table("The finding's numbers, computed anew", ("what", "stated", "computed"), rows)


def computed(piece: EvidenceRecord) -> str:
    """What was computed for a finding, to two digits more than asserted; a bound, safely rounded.

    >>> piece = EvidenceRecord(
    ...     name="", means="", unit="1", asserted=">= 1.147", computed=1.1475699, holds=True
    ... )
    >>> computed(piece)
    '1.14756'
    """
    if piece.computed is None:
        return "no value"
    if isinstance(piece.computed, bool):
        return "yes" if piece.computed else "no"
    safe = {">": ROUND_FLOOR, "<": ROUND_CEILING}.get(piece.asserted[:1], ROUND_HALF_EVEN)
    digits = significant(piece.asserted) + 2
    return quantity(rounded(Fraction(piece.computed), digits, safe), piece.unit)


# Beside the claims


def proven(cells: Mapping[str, ClaimRecord]) -> Table:
    """The cells of Table A-1 that are computed, with all digits that matter."""
    rows = [
        (claim.title, cell, quantity(number(claim.computed, 10), claim.unit),
         between(claim.enclosure or ()))
        for cell, claim in cells.items()
        if claim.computed is not None
    ]  # fmt: skip
    return Table("Cells of Table A-1", ("what", "cell", "computed", "proven range"), rows)


def approaches(record: Record) -> Table:
    """Every approach to X/R."""
    rows = [
        (
            f"{a.kind}: {a.name}",
            "not recomputable" if a.computed is None else number(a.computed, 5),
            f"{a.printed} `{a.claim}`" if a.claim else "",
        )
        for a in record.approaches
    ]
    return Table("Normalized depth X/R", ("approach", "computed", "printed"), rows)


def ladders(record: Record) -> Table:
    """The sheet at other time steps: a row for each, a column for each case and scheme."""
    schemes = {"published": "initial", "centered": "middle"}
    columns = list(dict.fromkeys((level.beta, level.scheme) for level in record.ladders))
    rows: dict[float, list[str]] = {}
    for level in record.ladders:
        text = f"{level.depth * 1e6:.6f} ({level.error * 1e9:+.3f})"
        rows.setdefault(level.step, [f"{number(level.step * 1e9)} ns"]).append(text)
    heads = (f"beta = {beta:g}, {schemes[scheme]} velocity" for beta, scheme in columns)
    caption = "Final depth of the sheet [um], its error [nm], by the velocity that the drag takes"
    return Table(caption, ("time step", *heads), [tuple(row) for row in rows.values()])


def sensitivity(record: Record) -> list[Table]:
    """For each case, what its inputs' own ranges do to the depth."""
    heads = ("input", "d ln X / d ln input", "range", "X [um]", "X/R", "the range is")
    return [
        Table(
            f"Derivatives and stated ranges, beta = {case.beta:g}",
            heads,
            [
                (
                    effect.input.replace("_", " "),
                    f"{case.elasticities[effect.input]:+.3f}",
                    shown_range(effect),
                    " to ".join(f"{depth * 1e6:.3f}" for depth in effect.depths),
                    " to ".join(dict.fromkeys(f"{ratio:.4f}" for ratio in effect.ratios)),
                    effect.why,
                )
                for effect in case.stated
            ],
        )
        for case in record.sensitivity
    ]


def scatter(record: Record) -> Table:
    """The stream of particles by three laws."""
    shares = (
        f"V and X/R that {number(100 * point.share)} % do not exceed"
        for point in record.scatter[0].points
    )
    rows = [
        (
            law.law, f"{law.standard_deviation:.1f} m/s", f"{law.mean_deviation:.1f} m/s",
            *(f"{point.velocity:.0f} m/s, {point.ratio:.3f}" for point in law.points),
        )
        for law in record.scatter
    ]  # fmt: skip
    heads = ("law", "standard deviation", "mean deviation", *shares)
    return Table("Velocity and X/R over the particles of the stream", heads, rows)
