"""The ledger is complete, and agrees with the report and with itself."""

import re
from collections import Counter
from collections.abc import Iterable
from fractions import Fraction as F
from graphlib import TopologicalSorter
from typing import Any, get_args

import msgspec
import pytest
from kept import calls, kept

from reference.formulas import Condition
from reference.ledger import Claim, Convention, Kind, load, shown
from reference.printed import Rounding, place_of
from reference.units import same_dimension

LEDGER = load()
CLAIMS = list(LEDGER.claims.values())


NUMBER = re.compile(
    r"\d+|\b(?:one|two|three|four|five|six|seven|eight|nine|ten|half|halves|thirds?|quarters?"
    r"|sixths?|several|twice|thrice|double|dozen|hundred|thousand|million)\b",
    re.IGNORECASE,
)


def uncovered(
    text: str, claims: Iterable[Claim] = (), incidental: Iterable[str] = ()
) -> list[tuple[int, str]]:
    """The digits and number words of a text, with their lines, that no claim or pattern covers."""
    spans = [(claim.place.start, claim.place.end) for claim in claims]
    spans += [match.span() for pattern in incidental for match in re.finditer(pattern, text)]
    taken = {at for span in spans for at in range(*span)}
    return [
        (text.count("\n", 0, match.start()) + 1, match[0])
        for match in NUMBER.finditer(text)
        if not taken.issuperset(range(*match.span()))
    ]


INCIDENTAL = [piece["pattern"] for piece in LEDGER.incidental]


def test_nothing_that_the_report_prints_is_left_out() -> None:
    assert uncovered(LEDGER.text, CLAIMS, INCIDENTAL) == []
    assert LEDGER.report.title in LEDGER.text


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.id)
def test_a_claim_stands_where_its_quote_does_and_nowhere_else(claim: Claim) -> None:
    before, text, after = re.split("[⟦⟧]", claim.quote)
    start, end = claim.place.start, claim.place.end
    assert LEDGER.text[start:end] == claim.text == text
    assert LEDGER.text[start - len(before) : end + len(after)] == before + text + after
    assert LEDGER.text.count("\n", 0, start) + 1 == claim.place.line
    # Without this claim, exactly its words would be uncovered.
    others = [another for another in CLAIMS if another is not claim]
    left = [(line, word.lower()) for line, word in uncovered(LEDGER.text, others, INCIDENTAL)]
    words = re.findall(r"\d+", text) or re.split("[ -]", text.lower().removesuffix(" times"))
    if claim.kind in ("comparison", "remark"):
        assert left == []
    else:
        assert left == [(claim.place.line, word) for word in words]


def test_no_two_claims_share_a_word_and_they_come_in_order() -> None:
    assert set(Counter(claim.place.start for claim in CLAIMS).values()) == {1}
    running = [claim.place.start for claim in CLAIMS if claim.place.cell is None]
    cells = [claim.place.cell for claim in CLAIMS if claim.place.cell]
    assert running == sorted(running)
    assert [claim.place.cell for claim in CLAIMS[-len(cells) :]] == cells
    assert cells == sorted(cells, key=lambda cell: (int(cell[1:]), cell[0]))
    assert {claim.kind for claim in CLAIMS} == set(get_args(Kind))


@pytest.mark.parametrize("piece", LEDGER.incidental, ids=lambda piece: piece["pattern"])
def test_every_incidental_pattern_is_needed_and_hides_no_claim(piece: Any) -> None:
    assert piece["reason"]
    others = [pattern for pattern in INCIDENTAL if pattern != piece["pattern"]]
    assert uncovered(LEDGER.text, CLAIMS, others)
    spans = [match.span() for match in re.finditer(piece["pattern"], LEDGER.text)]
    for claim in (c for c in CLAIMS if c.kind not in ("comparison", "remark")):
        assert all(claim.place.end <= a or b <= claim.place.start for a, b in spans), claim.id


def test_the_table_cell_by_cell() -> None:
    _, _, after = LEDGER.text.rpartition("Table A-1. Rigid body penetration.\n\n")
    table = {
        f"{column}{row}": cell.strip()
        for row, line in enumerate(after.split("\n")[:12], 1)
        for column, cell in zip("ABCDEF", (line + "\t" * 6).split("\t"), strict=False)
    }
    printed = {claim.place.cell: claim.text for claim in CLAIMS if claim.place.cell}
    labels = {cell for cell, text in table.items() if re.search("[A-DF-Za-z]", text)}
    assert labels == {*(f"A{row}" for row in range(1, 8)), *(f"{column}7" for column in "CDEF")}
    assert {cell: text for cell, text in table.items() if cell not in labels and text} == printed
    assert {cell for cell, text in table.items() if not text} == set(LEDGER.blank)
    assert len(LEDGER.blank) == 24 + 6 + 1


@kept("reference/kept.txt", "Inputs: the values that they may have; with ties to even; with the"
      " header exact; with choices rounded; these with the header exact, or cut off")  # fmt: skip
def test_the_values_that_a_number_may_have_as_an_input(question: str, answer: str) -> None:
    conventions = (
        Convention(),
        Convention(rounding=Rounding.EVEN),
        Convention(header_exact=True),
        Convention(choices_exact=False),
        Convention(choices_exact=False, header_exact=True),
        Convention(choices_exact=False, rounding=Rounding.CUT),
    )
    claim = LEDGER.claims[question]
    assert "; ".join(str(claim.as_input(convention)) for convention in conventions) == answer


test_what_single_calls_give = calls(
    "reference/kept.txt",
    "The ledger, and copies with a misprint, which leave it as it is",
    {"F": F, "LEDGER": LEDGER, "shown": shown, "place_of": place_of},
)


# How the entries of the files agree with each other


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.id)
def test_a_claim_has_what_its_kind_and_its_computations_need(claim: Claim) -> None:
    decided = (claim.computed_by is None) != (claim.given is None)
    assert decided or claim.within or claim.kind == "remark"
    assert claim.computations or not claim.inputs
    assert claim.relation or claim.kind not in ("bound", "order of magnitude", "comparison")
    assert (claim.relation is None) == (claim.bound is None)
    assert claim.against is None or LEDGER.claims[claim.against].unit == claim.unit
    assert claim.quantity is None or claim.quantity in LEDGER.quantities
    assert {computation.by_row for computation in claim.computations.values()} <= {
        claim.row is not None
    }
    assert all(claim.id in LEDGER.claims[name].entries for name in claim.shown_by)
    assert all(LEDGER.value(name) is not None for name in claim.entries)


def test_claims_do_not_rest_on_each_other_in_a_circle() -> None:
    rests_on = {claim.id: claim.stated for claim in CLAIMS}
    assert [*TopologicalSorter(rests_on).static_order()]


def test_equations_inferred_inputs_sources_and_slips_name_existing_entries() -> None:
    assert all(own.checks for own in LEDGER.equations.values() if own.kind == "derived")
    for entry in LEDGER.inferred.values():
        own = (entry.mass, entry.radius, entry.density, *entry.header)
        assert LEDGER.claims.keys() >= {*own, *entry.evidence}
        assert LEDGER.quantities[entry.quantity].unit == entry.unit
    for source in LEDGER.sources.values():
        assert 1 <= len(source.numbers) <= 2
        assert source.address.startswith("http")
        assert source.applies
        assert all(same_dimension(LEDGER.unit(name), source.unit) for name in source.claims)
    for slip in LEDGER.slip:
        assert slip.equation in LEDGER.equations
        assert slip.reason
        assert slip.text is None or LEDGER.read(slip.text)
        assert LEDGER.claims.keys() >= set(slip.inputs.values())


def test_a_misspelt_key_is_refused() -> None:
    with pytest.raises(msgspec.ValidationError, match="reasons"):
        msgspec.convert({"says": "any", "equals": "R", "reasons": "any"}, Condition)


def test_a_power_misprinted_as_zero_is_audited() -> None:
    from replication.audit.audit import Audit

    audit = Audit(load().misprint("eq16-power", "0"), every_convention=False)
    assert all(audit.judge.assess(claim) for claim in audit.ledger.claims.values())
