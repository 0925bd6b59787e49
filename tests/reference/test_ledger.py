"""The ledger is complete, and agrees with the report and with itself."""

import re
from collections import Counter
from collections.abc import Iterable
from fractions import Fraction as F
from graphlib import TopologicalSorter
from typing import Any, get_args

import msgspec
import pytest

from reference.ledger import Claim, Convention, Kind, Lines, as_shown, load, read_lines
from reference.printed import Rounding
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
    if claim.kind == "remark":
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
    for claim in (c for c in CLAIMS if c.kind != "remark"):
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


CONVENTIONS = (
    Convention(),
    Convention(rounding=Rounding.EVEN),
    Convention(header_exact=True),
    Convention(choices_exact=False),
    Convention(choices_exact=False, header_exact=True),
    Convention(choices_exact=False, rounding=Rounding.CUT),
)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        pytest.param(
            "flow-stress",  # the author's choice, printed as 700 MPa
            ("7E+8", "7E+8", "7E+8", *["[6.995E+8, 7.005E+8)"] * 2, "[7E+8, 7.01E+8)"),
            id="a choice",
        ),
        pytest.param(
            "a-step",  # 0.2 ns
            ("2E-10", "2E-10", "2E-10", *["[1.5E-10, 2.5E-10)"] * 2, "[2E-10, 3E-10)"),
            id="a choice of one digit",
        ),
        pytest.param(
            "time-step",
            ("2E-10", "2E-10", "2E-10", *["[1.5E-10, 2.5E-10)"] * 2, "[2E-10, 3E-10)"),
            id="a choice, repeated",
        ),
        pytest.param("strain-rate-length", ("[0.000015, 0.000025)",) * 6, id="about 20 um"),
        pytest.param("volume-ratio", ("[0.055, 0.065)",) * 6, id="about 0.06"),
        pytest.param(
            "a1-radius",  # 1.10E-05, in the header of Table A-1
            (
                "[0.00001095, 0.00001105)", "[0.00001095, 0.00001105]", "0.000011",
                "[0.00001095, 0.00001105)", "0.000011", "[0.000011, 0.0000111)",
            ),
            id="in the header",
        ),
        pytest.param(
            "a1-initial-velocity",  # 500
            ("500", "500", "500", "[499.5, 500.5)", "500", "[500, 501)"),
            id="a choice in the header",
        ),
        pytest.param("observed-third", ("1/3",) * 6, id="a word"),
        pytest.param("eq5-power-target", ("2",) * 6, id="a constant"),
        pytest.param("sphere-length-ratio", ("2/3",) * 6, id="a fraction"),
        pytest.param("copper-yield-bound", ("1E+8",) * 6, id="a bound"),
    ],
)  # fmt: skip
def test_the_values_that_a_number_may_have_as_an_input(
    name: str, expected: tuple[str, ...]
) -> None:
    actual = [str(LEDGER.claims[name].as_input(convention)) for convention in CONVENTIONS]
    assert actual == list(expected)


@pytest.mark.parametrize(
    ("name", "least", "greatest", "reason"),
    [
        (
            "a1-initial-velocity", F(50), F(3000),
            "from a tenth of the report's velocity to six times it",
        ),
        (
            "inferred:target-density", F(1000), F(23000),
            "from water to osmium, the densest metal",
        ),
        (
            "mean-diameter", F("2.2E-6"), F("2.2E-4"),
            "from a tenth to ten times the printed value",
        ),
        ("initial-depth", F(-1), F(1), "from -1 to 1, as zero is printed"),
    ],
)  # fmt: skip
def test_the_range_in_which_another_value_is_searched(
    name: str, least: F, greatest: F, reason: str
) -> None:
    assert LEDGER.search(name) == (least, greatest, reason)


def test_a_remark_prints_no_number() -> None:
    with pytest.raises(ValueError, match=r"^claim 'coarse-step-remark' prints no number$"):
        LEDGER.value("coarse-step-remark")


def test_exponents_are_shown_as_superscripts() -> None:
    assert as_shown(r"10^{-3}") == "10⁻³"


# Copies with a misprint, which leave the ledger as it is


def test_a_misprint_changes_the_number_and_what_is_compared_with_it() -> None:
    copy = LEDGER.misprint("observed-depth-ratio", "0.289")
    assert copy.claims["observed-depth-ratio"].value == F("0.289")
    assert LEDGER.misprint("cth-pressure", "6").claims["cth-pressure"].bound == 6
    assert LEDGER.misprinted == {}


def test_a_misprint_of_a_constant_changes_its_equation_and_no_other() -> None:
    copy = LEDGER.misprint("eq3-factor", "5/3")
    assert copy.printed_text("eq3") == r"PV = 5/3 \pi R^3"
    assert copy.sides["eq3"] == LEDGER.read(r"PV = 5/3 \pi R^3")
    assert [name for name in LEDGER.sides if copy.sides[name] != LEDGER.sides[name]] == ["eq3"]
    assert copy.misprint("eq3", r"PV = 4/3 \pi R^3").sides == LEDGER.sides


def test_an_equation_that_cannot_be_read_keeps_its_sides() -> None:
    assert LEDGER.misprint("eq3", "PV = (").sides == LEDGER.sides


def test_a_misprint_must_be_a_number_of_a_known_entry() -> None:
    with pytest.raises(ValueError, match=r"^cannot read 'deep' as a printed number$"):
        LEDGER.misprint("observed-depth-ratio", "deep")
    with pytest.raises(KeyError, match="no-such"):
        LEDGER.misprint("no-such", "1")


def test_constants_can_be_put_into_an_equation() -> None:
    assert LEDGER.constants_of("eq11") == ["eq11-numerator", "eq11-denominator", "eq11-power"]
    numerator = LEDGER.printed_text("eq11", {"eq11-numerator": F(5, 2)})
    assert numerator == r"\alpha = (\frac{5}{2}E_t/3Y_t)^{1/3}"
    power = LEDGER.printed_text("eq11", {"eq11-power": F(5, 2)})
    assert power == r"\alpha = (2E_t/3Y_t)^{\frac{5}{2}}"


# How the entries of the files agree with each other


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.id)
def test_a_claim_has_what_its_kind_and_its_computations_need(claim: Claim) -> None:
    decided = (claim.computed_by is None) != (claim.given is None)
    assert decided or claim.within or claim.kind == "remark"
    assert claim.computations or not claim.inputs
    assert claim.relation or claim.kind not in ("bound", "order of magnitude")
    assert (claim.relation is None) == (claim.bound is None)
    assert claim.quantity is None or claim.quantity in LEDGER.quantities
    assert {computation.by_row for computation in claim.computations.values()} <= {
        claim.row is not None
    }
    assert all(claim.id in LEDGER.claims[name].input_ids for name in claim.shown_by)
    assert all(LEDGER.value(name) is not None for name in claim.input_ids)


def test_claims_do_not_rest_on_each_other_in_a_circle() -> None:
    rests_on = {claim.id: claim.stated for claim in CLAIMS}
    assert [*TopologicalSorter(rests_on).static_order()]


def test_inferred_inputs_and_sources_name_existing_entries() -> None:
    for inferred in LEDGER.inferred.values():
        own = (inferred.mass, inferred.radius, inferred.density, *inferred.header)
        assert LEDGER.claims.keys() >= {*own, *inferred.evidence}
        assert LEDGER.quantities[inferred.quantity].unit == inferred.unit
    for source in LEDGER.sources.values():
        assert 1 <= len(source.numbers) <= 2
        assert source.address.startswith("http")
        assert source.applies
        assert all(same_dimension(LEDGER.unit(name), source.unit) for name in source.claims)


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ({"quote": "⟦1⟧", "what": {"title": "one"}}, "missing required field `kind`"),
        (
            {"quote": "⟦1⟧", "what": {"title": "one", "kind": "result", "units": "m"}},
            "contains unknown field `units`",
        ),
        (
            {"quote": "⟦1⟧", "what": {"title": "one", "kind": "guess"}},
            "Invalid enum value 'guess'",
        ),
    ],
)
def test_a_wrong_key_is_refused_with_the_claims_id(lines: dict[str, Any], message: str) -> None:
    with pytest.raises(msgspec.ValidationError, match=f"^ledger.toml: my-claim: .*{message}"):
        read_lines("my-claim", Lines(**lines), Claim)


def test_a_wrong_line_is_refused() -> None:
    with pytest.raises(msgspec.ValidationError, match="unknown field `reason`"):
        msgspec.convert({"quote": "⟦1⟧", "what": {}, "reason": "any"}, Lines)


BASIS = {"computed_by", "rests_on", "readings", "assumes", "same_as", "given", "shown_by"}


@pytest.mark.parametrize("name", LEDGER.claim)
def test_what_decides_a_number_stands_in_its_basis(name: str) -> None:
    lines = LEDGER.claim[name]
    assert lines.what.keys() & BASIS == set()
    assert lines.basis.keys() <= BASIS


def test_a_power_misprinted_as_zero_is_audited() -> None:
    from replication.audit.audit import Audit

    audit = Audit(load().misprint("eq16-power", "0"), every_convention=False)
    assert all(audit.judge.assess(claim) for claim in audit.ledger.claims.values())
