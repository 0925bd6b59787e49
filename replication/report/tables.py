"""Tables of a record and its claims, shared by HTML page, Markdown and terminal.

Their texts are plain, with ids between backticks: `Prose` typesets them.
"""

import re
from collections.abc import Iterable, Mapping
from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN
from fractions import Fraction

from reference.ledger import Claim, Ledger
from reference.scheme import Scheme
from replication.audit import record as r
from replication.audit.assessment import Comparison, ConfirmedRange, Reading
from replication.audit.comparison import SHARES
from replication.audit.inference import DENSITY
from replication.report.prose import Named, plain_quotation
from replication.report.words import measured, printed_with_unit, shown_range
from replication.text import Table, between, number, quantity, rounded
from spreadsheets.sheets import cells_of_claims

NO_VALUE = "no value"
"""Shown for a quantity that cannot be computed from misprinted inputs."""


def facts(record: r.ClaimRecord, names: Mapping[str, Named]) -> list[tuple[str, str]]:
    """Return what is known of a claim, beside verdict and explanation, as labels and texts."""
    claim, first, error = record.claim, record.as_printed, record.error_in_last_digit
    inputs = (
        " × ".join(f"`{name}` {names[name].value}" for name in entries)
        for entries in claim.inputs.values()
    )
    others = zip(record.assessment.readings[1:], record.scopes[1:], strict=True)
    cell = cells_of_claims().get(claim.id)
    texts = {
        "rounds to it": claim.printed
        and quantity(str(claim.interval()).replace("E", "e"), claim.unit),
        "computed": measured(record.computed, claim.unit, 10),
        "to 25 digits": first and first.reference,
        "proven range": first and between(first.judgements[0].ends),
        "off by": error is not None
        and record.verdict.needs_explanation
        and f"{number(error, 3)} units of the last printed digit",
        "computed from": first and ", ".join(inputs),
        "for instance (SI)": first and _values(first.judgements[0].witness or {}),
        "other readings": "; ".join(_reading(*pair, claim.unit) for pair in others),
        "assumed": "; ".join(record.assumes),
        "would still agree": record.confirmed_range and _still_agrees(record.confirmed_range),
        "public sources": "; ".join(map(_source, record.sources)),
        "workbook cell": cell and f"`{cell}`",
    }
    return [(label, text.removesuffix(".")) for label, text in texts.items() if text]


def _reading(reading: Reading, scope: str, unit: str) -> str:
    usual = reading.judgements[0]
    value, proven = measured(reading.computed, unit, 10), between(usual.ends)
    witness = f" For instance (SI) {_values(usual.witness)}." if usual.witness else ""
    return f"{reading.name}: {value}, {reading.verdict}, proven range {proven}. {scope}{witness}"


def _still_agrees(confirmed: ConfirmedRange) -> str:
    range_ = quantity(between(confirmed.interval, 6, inward=True), confirmed.unit)
    return f"{range_}, by {', '.join(f'`{name}`' for name in confirmed.claims)}"


def _source(comparison: Comparison) -> str:
    source = comparison.source
    says = quantity(source.says, source.unit)
    return f"{source.title}, {source.address}, prints {says} ({source.applies})"


def _values(values: Mapping[str, Fraction]) -> str:
    return ", ".join(f"`{name}` {number(value, 10)}" for name, value in values.items())


MAIN = (
    "depth-beta-3", "depth-beta-5", "ratio-beta-5", "observed-depth-ratio", "goodier-beta",
    "walker-anderson-beta",
)  # fmt: skip
"""The ids of the report's main results."""


def main_results(record: r.Record) -> Table:
    """Return the report's main results, as printed and as computed.

    A verdict that is the same for all stands in the title. A number that is computed from another
    main result, as printed and not as computed, says so.
    """
    shown = [c for c in record.claims if c.id in MAIN and c.computed is not None]
    rows = [
        (_title(record, c.claim), printed_with_unit(c.claim), measured(c.computed, c.claim.unit))
        for c in shown
    ]
    verdicts = dict.fromkeys(c.verdict for c in shown)
    if len(verdicts) == 1:
        title = f"The {len(shown)} main results: {next(iter(verdicts))}"
        return Table(title, ("number", "printed", "computed"), rows)
    judged = [(*row, c.verdict) for row, c in zip(rows, shown, strict=True)]
    return Table("Main results", ("number", "printed", "computed", "verdict"), judged)


def _title(record: r.Record, claim: Claim) -> str:
    """Return a claim's title, and which main result as printed it is computed from, if any."""
    used = [other.claim for other in record.claims if other.id in {*claim.input_ids} & {*MAIN}]
    printed = " and ".join(map(printed_with_unit, used))
    return f"{claim.title}, from the printed {printed}" if used else claim.title


def not_as_printed(record: r.Record) -> Table:
    """Return what is printed and what follows instead, for each claim that fails or is undecided.

    Each reading of an equation has a column.
    """
    failing = [claim for claim in record.claims if claim.verdict.needs_explanation]
    constants = (entry.assessment.constants for entry in record.equations)
    needed = {name: constant.needed for own in constants for name, constant in own.items()}
    as_printed = "computed as printed"
    names = (reading.name for claim in failing for reading in claim.assessment.readings)
    *_, last = heads = tuple(dict.fromkeys([as_printed, *filter(None, names)]))
    rows = []
    for claim in failing:
        digits = significant_digits(claim.claim.text)
        texts = {
            reading.name or as_printed: f"{reading.computed:#.{digits}g}"
            for reading in claim.assessment.readings
        }
        if claim.id in needed:
            texts[last] = " or ".join(needed[claim.id])
            if last == as_printed:
                texts[last] = f"derived: {texts[last]}"
        own = (texts.get(head, "") for head in heads)
        rows.append((f"`{claim.id}`", printed_with_unit(claim.claim), *own))
    return Table("What does not come out as printed", ("number", "printed", *heads), rows)


def significant_digits(text: str) -> int:
    """Count the significant digits of a printed number.

    >>> significant_digits("0.0550"), significant_digits(">= 2680"), significant_digits("7.6E9")
    (3, 4, 2)
    """
    mantissa = re.split(r"[eE×\\]", text)[0]
    return len(re.sub(r"\D", "", mantissa).lstrip("0")) or 1


def explanation_tables(record: r.ClaimRecord, names: Mapping[str, Named]) -> list[Table]:
    """Return the explanations tried for a claim that fails, and the figures that judge a remark.

    `names` have the assumed value of the target density, at which slips are computed.
    """
    figures = [(f.means, measured(f.value, f.unit, 4) or NO_VALUE) for f in record.figures]
    slips = [(s.name, str(s.departures), measured(s.value, "1", 5), s.fits) for s in record.slips]
    inputs = []
    for entry in dict.fromkeys(solved.entry for solved in record.back_solved):
        by_reading = [solved for solved in record.back_solved if solved.entry == entry]
        first, needed = by_reading[0], map(_needed, by_reading)
        search = f"{between(first.search, 4)}: {first.search_reason}"
        inputs.append((f"`{entry}`", measured(first.as_printed, first.unit), *needed, search))
    readings = dict.fromkeys(solved.reading or "as printed" for solved in record.back_solved)
    heads = ("input", "printed", *(f"needed, {reading}" for reading in readings), "searched")
    changed = "Proven values of one input that would give the number, all others as printed"
    at_density = f"X/R at {names[DENSITY].value}" if slips else "X/R"
    tables = (
        Table("The figures to judge it by", ("what", "computed"), figures),
        Table(changed, heads, inputs),
        repairs(record.repairs, record.id),
        Table(_slips_title(record), ("Eq. 16 with", "slips", at_density, "prints so"), slips),
    )
    return [shown for shown in tables if shown.rows]


def _slips_title(record: r.ClaimRecord) -> str:
    """Say how large the family of slips is, and how many of it would fit by accident."""
    tried = record.slips_tried
    if tried is None:
        return ""
    return (
        "Slips in Eq. 16 that give it for some admitted density: "
        f"{len(record.slips)} of {tried.members:,} different values ({tried.forms:,} forms); "
        f"{tried.expected:.1f} would by accident"
    )


def _needed(solved: r.BackSolved) -> str:
    if not solved.intervals:
        return "undecided" if solved.proof == r.Proof.UNDECIDED else "none"
    ends = ", ".join(between(ends, 6, inward=True) for ends in solved.intervals)
    beyond = " or beyond" if solved.proof == r.Proof.TO_AN_END else ""
    return quantity(ends, solved.unit) + beyond


def constants(equation: r.EquationRecord, ledger: Ledger) -> Table:
    """Return the constants of an equation, with the values that would pass all of its checks."""
    rows = [
        (
            f"`{name}`",
            ledger.claims[name].shown,
            constant.verdict,
            ", ".join(constant.needed) or "none of those tried",
        )
        for name, constant in equation.assessment.constants.items()
    ]
    heads = ("constant", "printed", "verdict", "values that pass every check")
    return Table("Its factors, powers and offsets, each with all others as printed", heads, rows)


def repairs(listed: Iterable[r.Repair], claim: str = "") -> Table:
    """Return the misprints that would make a claim or equation agree.

    A claim, named by its id, is not listed among those that still fail: where another reading of
    its equation agrees, it fails only as printed.
    """
    rows = []
    for repair in listed:
        failing = ", ".join(f"`{name}`" for name in repair.failing if name != claim) or "nothing"
        texts = f"`{repair.entry}`", plain_quotation(repair.original), plain_quotation(repair.text)
        rows.append((*texts, repair.kind, repair.reading or "as printed", failing))
    heads = ("text of", "printed", "instead", "edit", "read", "what else still fails")
    caption = "Misprints that would give it: one edit of the text, all else as printed"
    return Table(caption, heads, rows)


def evidence(finding: r.Finding) -> Table:
    """Return the numbers of a finding, with two digits more than it states.

    A number that stands in its text is shown as it stands there, any other by what it means.
    """
    text = " ".join((finding.title, finding.statement, finding.by_hand))
    standing = set(re.findall(r"\d+(?:\.\d+)?(?:/\d+)?", text))
    rows = []
    for piece in finding.evidence:
        is_stated = piece.asserted.lstrip("<=> ") in standing
        shown = quantity(piece.asserted, piece.unit) if is_stated else piece.means
        value = computed(piece)
        rows.append((shown, value if piece.holds else f"{value}: NOT AS STATED"))
    return Table("The numbers of this text, with two more digits", ("stated", "computed"), rows)


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
    digits = significant_digits(piece.asserted) + 2
    return quantity(rounded(Fraction(piece.computed), digits, safe), piece.unit)


def proven(records: Iterable[r.ClaimRecord]) -> Table:
    """Return the computed cells of Table A-1 to ten digits, with their proven ranges."""
    rows = []
    for record in records:
        claim, first = record.claim, record.as_printed
        if first is not None:
            value, range_ = measured(first.computed, claim.unit, 10), first.judgements[0].ends
            rows.append((claim.title, claim.cell or "", value, between(range_)))
    return Table("Cells of Table A-1", ("what", "cell", "computed", "proven range"), rows)


def approach_table(record: r.Record) -> Table:
    """Return X/R by every approach."""
    rows = [
        (f"{a.kind}: {a.name}",
         "not recomputable" if a.computed is None else number(a.computed, 5),
         f"{a.shown} `{a.claim}`" if a.claim else "")
        for a in record.approaches
    ]  # fmt: skip
    return Table("Normalized depth X/R", ("approach", "computed", "printed"), rows)


def ladder_table(record: r.Record) -> Table:
    """Return the sheet's final depth: a row for each time step, a column for case and scheme."""
    columns = dict.fromkeys((level.beta, level.scheme) for level in record.ladders)
    rows: dict[float, list[str]] = {}
    for level in record.ladders:
        text = f"{level.depth * 1e6:.6f} ({level.error * 1e9:+.3f})"
        rows.setdefault(level.step, [f"{number(level.step * 1e9)} ns"]).append(text)
    heads = (f"beta = {beta:g}, {Scheme(scheme).drag_at} velocity" for beta, scheme in columns)
    caption = "Final depth of the sheet [um] (error [nm]), by the velocity at which drag is taken"
    return Table(caption, ("time step", *heads), [tuple(row) for row in rows.values()])


def sensitivity_table(case: r.Sensitivity) -> Table:
    """Return how the depth of a case changes over the range of each input."""
    rows = [
        (e.input.replace("_", " "), f"{case.elasticities[e.input]:+.3f}", shown_range(e),
         " to ".join(f"{depth * 1e6:.3f}" for depth in e.depths),
         " to ".join(dict.fromkeys(f"{ratio:.4f}" for ratio in e.ratios)), e.why)
        for e in case.stated
    ]  # fmt: skip
    heads = ("input", "d ln X / d ln input", "range", "X [um]", "X/R", "source of the range")
    return Table(f"Derivatives and stated ranges, beta = {case.beta:g}", heads, rows)


def scatter_table(record: r.Record) -> Table:
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
