"""The record as a page and as Markdown: one arrangement, two templates."""

import re
from base64 import b64encode
from collections.abc import Callable, Mapping, Sequence
from hashlib import sha256
from importlib import resources
from typing import TYPE_CHECKING, Any

from replication.audit.record import FindingRecord, Record, SourceRecord
from replication.report import facts as told
from replication.report.facts import Arranged, Table
from replication.report.figures import Drawing
from replication.report.prose import Named, Prose, quoted
from replication.text import number

if TYPE_CHECKING:
    from jinja2 import Environment

__all__ = ["counted", "environment", "markdown", "page"]

SECTIONS = {
    "summary": "Summary",
    "open": "What does not follow",
    "findings": "Findings, the heaviest first",
    "approaches": "All approaches side by side",
    "sheet": "The sheet and the exact motion",
    "sensitivity": "What the depth depends on",
    "scatter": "What scatter does",
    "inferred": "The target density, inferred",
    "equations": "The equations",
    "table-a-1": "Table A-1",
    "computed": "Numbers computed anew",
    "remarks": "Remarks, with figures",
    "sources": "Numbers compared with public sources",
    "repeated": "Numbers that repeat or are chosen",
    "undecided": "Numbers that nothing in the report decides",
    "symbols": "Symbols",
    "provenance": "Provenance",
}


def page(record: Record, drawings: Sequence[Drawing]) -> str:
    """The page: no script, nothing from outside, its style named in its content policy by hash."""
    style = (resources.files("replication.report") / "page.css").read_text("utf-8")
    prose = Prose(record.symbols, told.names_of(record))
    template = environment(prose.html, escaping=True).get_template("page.html.j2")
    return template.render(
        _context(record),
        drawings={drawing.name: drawing for drawing in drawings},
        style=style,
        style_hash=b64encode(sha256(style.encode()).digest()).decode(),
    )


def markdown(record: Record) -> str:
    """The same as Markdown, without the figures."""
    prose = Prose(record.symbols, told.names_of(record))
    template = environment(prose.markdown, escaping=False).get_template("page.md.j2")
    return re.sub(r"\n{3,}", "\n\n", template.render(_context(record)).lstrip())


def environment(prose: Callable[[str], str], escaping: bool) -> "Environment":
    """Where the templates are found, and their filters."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader("replication.report", ""),
        autoescape=escaping,  # noqa: S701  (the page is escaped; the others are no HTML)
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {
        "capital": lambda text: text[:1].upper() + text[1:] if text[:1].isascii() else text,
        "number": number,
        "printed": told.printed,
        "prose": prose,
        "quoted": quoted,
        "slug": lambda text: text.replace(",", "").replace(" ", "-"),
    }
    return environment


def _context(record: Record) -> dict[str, Any]:
    """What the templates show: the record, and its parts in the order in which they stand."""
    groups, names = Arranged.of(record), told.names_of(record)
    sections = {id_: title for id_, title in SECTIONS.items() if id_ != "open" or groups.open}
    return {
        "record": record,
        "groups": groups,
        "sections": list(sections.items()),
        "titles": sections,
        "verdicts": told.VERDICTS,
        "none": [verdict for verdict in told.VERDICTS if not record.summary[verdict]],
        "counted": counted(record),
        "failing": told.failing(record, groups.open),
        "facts": lambda claim: told.facts(claim, names),
        "tables": told.tables,
        "repairs": told.repairs,
        "evidence": _evidence,
        "between": told.between,
        "quantity": told.quantity,
        "equation_of": {c.claim: e for e in record.equations for c in e.constants},
        "touching": _touching(record),
        "assumed": "; ".join(
            dict.fromkeys(text for claim in groups.cells.values() for text in claim.assumes)
        ),
        "proven": _proven(groups, names),
        "approaches": _approaches(record),
        "ladders": _ladders(record),
        "sensitivity": _sensitivity(record),
        "scatter": _scatter(record),
        "compared": _compared(record),
        "compared_ids": {claim.id: claim for claim in groups.compared},
        "names": names,
    }


def counted(record: Record) -> str:
    """The counts in words, the independent checks first."""
    counts = record.counts
    failing = sum(equation.verdict == "not reproduced" for equation in record.equations)
    return (
        f"{counts.calculations} independent checks come out as printed; they cover "
        f"{counts.reproduced} of the {counts.numbers} numbers that the report prints. "
        f"{counts.failing} numbers do not follow from what it says. Of its {counts.equations} "
        f"equations {counts.equations_derived} follow from those before them or from mechanics, "
        f"{failing} does not, and the others are definitions or taken from the literature."
    )


def _touching(record: Record) -> dict[str, list[FindingRecord]]:
    """The findings that name a claim, by its id; those with a check by hand first."""
    touching: dict[str, list[FindingRecord]] = {}
    for finding in sorted(record.findings, key=lambda finding: not finding.by_hand):
        for claim in finding.claims:
            touching.setdefault(claim, []).append(finding)
    return touching


def _evidence(finding: FindingRecord) -> Table:
    rows = [
        (
            e.means,
            told.quantity(e.asserted, e.unit),
            told.evidence(e) + ("" if e.holds else ": NOT AS STATED"),
        )
        for e in finding.evidence
    ]
    return Table(
        "As the finding states them, and as computed", ("what", "stated", "computed"), rows
    )


def _proven(groups: Arranged, names: Mapping[str, Named]) -> Table:
    """The cells of Table A-1 that are computed, with all digits that matter."""
    rows = [
        (
            claim.title,
            str(claim.cell),
            told.quantity(number(claim.computed or 0.0, 10), claim.unit),
            str(dict(told.facts(claim, names))["proven range"]),
        )
        for claim in groups.cells.values()
        if claim.computed is not None
    ]
    return Table("Cells of Table A-1", ("what", "cell", "computed", "proven range"), rows)


def _approaches(record: Record) -> Table:
    rows = [
        (
            f"{a.kind}: {a.name}",
            "not recomputable" if a.computed is None else number(a.computed, 5),
            f"{a.printed} `{a.claim}`" if a.claim else "",
        )
        for a in record.approaches
    ]
    return Table("Normalized depth X/R", ("approach", "computed", "printed"), rows)


def _ladders(record: Record) -> Table:
    """A row for each time step, a column for each case and scheme."""
    schemes = {"published": "initial", "centered": "middle"}
    columns = list(dict.fromkeys((level.beta, level.scheme) for level in record.ladders))
    found = {(level.step, level.beta, level.scheme): level for level in record.ladders}
    rows = [
        (
            f"{number(step * 1e9)} ns",
            *(
                f"{found[step, *column].depth * 1e6:.6f} ({found[step, *column].error * 1e9:+.3f})"
                for column in columns
            ),
        )
        for step in dict.fromkeys(level.step for level in record.ladders)
    ]
    heads = [f"beta = {beta:g}, {schemes[scheme]} velocity" for beta, scheme in columns]
    caption = (
        "Final depth of the sheet [um] and its error [nm], by the velocity at which drag is taken"
    )
    return Table(caption, ("time step", *heads), rows)


def _sensitivity(record: Record) -> list[Table]:
    heads = ("input", "d ln X / d ln input", "range", "X [um]", "X/R", "the range is")
    return [
        Table(
            f"Derivatives and stated ranges, beta = {number(case.beta)}",
            heads,
            [
                (
                    effect.input.replace("_", " "),
                    f"{case.elasticities[effect.input]:+.3f}",
                    told.shown_range(effect),
                    _span([f"{depth * 1e6:.3f}" for depth in effect.depths]),
                    _span([f"{ratio:.4f}" for ratio in effect.ratios]),
                    effect.why,
                )
                for effect in case.stated
            ],
        )
        for case in record.sensitivity
    ]


def _span(ends: Sequence[str]) -> str:
    return " to ".join(dict.fromkeys(ends))


def _scatter(record: Record) -> Table:
    shares = [point.share for point in record.scatter[0].points]
    heads = (
        "law", "standard deviation", "mean deviation",
        *(f"V and X/R that {number(100 * share)} % do not exceed" for share in shares),
    )  # fmt: skip
    rows = [
        (
            law.law,
            f"{law.standard_deviation:.1f} m/s",
            f"{law.mean_deviation:.1f} m/s",
            *(f"{point.velocity:.0f} m/s, {point.ratio:.3f}" for point in law.points),
        )
        for law in record.scatter
    ]
    return Table("Velocity and X/R over the particles of the stream", heads, rows)


def _compared(record: Record) -> list[tuple[str, list[tuple[SourceRecord, str]]]]:
    """What public sources print for a claim or an inferred input, and what comes of comparing."""
    outcomes = {True: "agrees", False: "differs", None: ""}
    claims = [
        (claim.id, [(source, outcomes[source.agrees]) for source in claim.sources])
        for claim in record.claims
        if claim.sources
    ]
    inferred = [
        (f"inferred:{one.id}", [(each.source, f"is {each.verdict}") for each in one.sources])
        for one in record.inferred
        if one.sources
    ]
    return claims + inferred
