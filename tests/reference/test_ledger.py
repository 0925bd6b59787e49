"""The report's ledger is complete and in place; a malformed one is refused by name."""

import re
import tomllib
from collections import Counter
from collections.abc import Iterable
from copy import deepcopy
from dataclasses import replace
from fractions import Fraction as F
from typing import Any, get_args

import pytest

from reference.arithmetic import Reals
from reference.entries import Kind, LedgerError
from reference.ledger import Claim, Convention, Ledger, load, read, shown
from reference.printed import Rounding

LEDGER = load()
CLAIMS = list(LEDGER.claims.values())

# The real ledger


NUMBER = re.compile(
    r"\d+|\b(?:one|two|three|four|five|six|seven|eight|nine|ten|half|halves|thirds?|quarters?"
    r"|sixths?|several|twice|thrice|double|dozen|hundred|thousand|million)\b",
    re.IGNORECASE,
)


def uncovered(
    text: str, claims: Iterable[Claim] = (), furniture: Iterable[str] = ()
) -> list[tuple[int, str]]:
    """Digits and number words of a text, with their lines, that no claim and no furniture has."""
    spans = [(claim.place.start, claim.place.end) for claim in claims]
    spans += [match.span() for pattern in furniture for match in re.finditer(pattern, text)]
    taken = {at for span in spans for at in range(*span)}
    return [
        (text.count("\n", 0, match.start()) + 1, match[0])
        for match in NUMBER.finditer(text)
        if not taken.issuperset(range(*match.span()))
    ]


FURNITURE = [piece.pattern for piece in LEDGER.furniture]


def test_nothing_that_the_report_prints_is_left_out() -> None:
    assert uncovered(LEDGER.text, CLAIMS, FURNITURE) == []
    assert LEDGER.report.title in LEDGER.text


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.id)
def test_a_claim_stands_where_its_quote_does_and_nowhere_else(claim: Claim) -> None:
    before, text, after = re.split("[⟦⟧]", claim.quote)
    start, end = claim.place.start, claim.place.end
    assert LEDGER.text[start:end] == claim.text == text
    assert LEDGER.text[start - len(before) : end + len(after)] == before + text + after
    assert LEDGER.text.count(before + text + after) == 1
    assert LEDGER.text.count("\n", 0, start) + 1 == claim.place.line
    # Without it, its words would be uncovered.
    others = [another for another in CLAIMS if another is not claim]
    left = [(line, word.lower()) for line, word in uncovered(LEDGER.text, others, FURNITURE)]
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


@pytest.mark.parametrize("piece", LEDGER.furniture, ids=lambda piece: piece.pattern)
def test_every_piece_of_furniture_is_needed_and_hides_no_claim(piece: Any) -> None:
    assert piece.reason
    others = [pattern for pattern in FURNITURE if pattern != piece.pattern]
    assert uncovered(LEDGER.text, CLAIMS, others)
    spans = [match.span() for match in re.finditer(piece.pattern, LEDGER.text)]
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
    assert set(printed) | set(LEDGER.blank) | labels == set(table)
    assert all(table[cell] == text for cell, text in printed.items())
    assert all(table[cell] == "" for cell in LEDGER.blank)
    assert len(LEDGER.blank) == 24 + 6 + 1


USUAL, ROUNDED = Convention(), Convention(choices_exact=False)


@pytest.mark.parametrize(
    ("name", "convention", "expected"),
    [
        ("flow-stress", USUAL, "7E+8"),
        ("flow-stress", ROUNDED, "[6.995E+8, 7.005E+8)"),
        ("flow-stress", replace(ROUNDED, rounding=Rounding.CUT), "[7E+8, 7.01E+8)"),
        ("a-step", USUAL, "2E-10"),
        ("a-step", ROUNDED, "[1.5E-10, 2.5E-10)"),
        ("time-step", USUAL, "2E-10"),  # repeats a choice
        ("strain-rate-length", USUAL, "[0.000015, 0.000025)"),
        ("volume-ratio", USUAL, "[0.055, 0.065)"),
        ("a1-radius", USUAL, "[0.00001095, 0.00001105)"),
        ("a1-radius", replace(USUAL, rounding=Rounding.EVEN), "[0.00001095, 0.00001105]"),
        ("a1-radius", replace(USUAL, header_exact=True), "0.000011"),
        ("a1-initial-velocity", USUAL, "500"),  # a choice and in the header
        ("a1-initial-velocity", ROUNDED, "[499.5, 500.5)"),
        ("a1-initial-velocity", replace(ROUNDED, header_exact=True), "500"),
        ("observed-third", ROUNDED, "1/3"),
        ("eq5-power-target", ROUNDED, "2"),
        ("sphere-length-ratio", ROUNDED, "2/3"),
        ("copper-yield-bound", ROUNDED, "1E+8"),
    ],
)
def test_what_a_number_stands_for_as_an_input(
    name: str, convention: Convention, expected: str
) -> None:
    assert str(LEDGER.claims[name].as_input(convention)) == expected


def test_values_in_units_ranges_to_search_and_texts_to_show() -> None:
    assert LEDGER.value("flow-stress") == 700 * 10**6
    assert LEDGER.value("inferred:target-density") == 7850
    assert LEDGER.search("a1-initial-velocity")[:2] == (50, 3000)
    assert LEDGER.search("inferred:target-density")[:2] == (1000, 23000)
    assert LEDGER.search("mean-diameter")[:2] == (F(22, 10**7), F(22, 10**5))
    assert LEDGER.search("initial-depth")[:2] == (-1, 1)
    assert shown(r"10^{-3}") == "10⁻³"
    assert LEDGER.claims["fz-resistance-rha"].shown == "9.13 × 10⁹"
    with pytest.raises(LedgerError, match="no number 'coarse-step-remark'"):
        LEDGER.value("coarse-step-remark")
    with pytest.raises(LedgerError, match="prints no number"):
        _ = LEDGER.claims["coarse-step-remark"].value


def test_inputs_come_from_products_groups_and_inference() -> None:
    claim = LEDGER.claims["depth-beta-3"]
    assert claim.inputs["resistance"] == ("depth-beta-3-beta", "flow-stress")
    assert claim.inferred == ["inferred:target-density"]
    assert set(claim.stated) | set(claim.inferred) == set(claim.entries)
    reals = Reals(20)
    row = LEDGER.claims["a1-depth-1"]
    numbers = {name: reals.number(LEDGER.value(name)) for name in row.entries}
    numbers["a-step"] = reals.number(F(4, 10**10))
    assert float(LEDGER.function(row)(reals, **numbers)) == pytest.approx(1e-7)


def test_public_sources_are_read_from_their_words() -> None:
    sources = LEDGER.sources
    assert sources["304-modulus"].says == "193 to 200"
    assert str(sources["304-modulus"].interval) == "[1.925E+11, 2.005E+11)"
    assert sources["copper-density"].value == 8890
    for source in sources.values():
        assert source.address.startswith("http"), source.id
        assert source.applies, source.id


# Copies with a misprint


def test_a_misprint_reaches_all_that_reads_the_number() -> None:
    copy = LEDGER.misprint("observed-depth-ratio", "0.289")
    assert copy.claims["observed-depth-ratio"].printed.value == F("0.289")
    assert copy.claims["frank-zook-below-observed"].bound == F("0.289")
    assert LEDGER.claims["frank-zook-below-observed"].bound == F("0.298")
    assert LEDGER.misprint("cth-pressure", "6").claims["cth-pressure"].bound == 6
    with pytest.raises(ValueError, match="cannot read"):
        LEDGER.misprint("observed-depth-ratio", "deep")
    with pytest.raises(KeyError):
        LEDGER.misprint("no-such", "1")


def test_a_misprinted_constant_is_in_its_equation_and_only_there() -> None:
    copy = LEDGER.misprint("eq3-factor", "5/3")
    assert copy.printed_text("eq3") == r"PV = 5/3 \pi R^3"
    assert copy.sides["eq3"] == LEDGER.read(r"PV = 5/3 \pi R^3")
    assert {k for k in LEDGER.sides if copy.sides[k] != LEDGER.sides[k]} == {"eq3"}
    again = copy.misprint("eq3", r"PV = 4/3 \pi R^3")
    assert again.sides == LEDGER.sides
    unreadable = LEDGER.misprint("eq3", "PV = (")
    assert unreadable.sides == LEDGER.sides
    assert LEDGER.misprinted == {}


# A small ledger, and what can be wrong with it

TEXT = """ A Small Report

 14. ABSTRACT About 3 things.

1. Balls

A ball is 22 mm wide, so its radius is 11 mm.

$$ D = 2R, \\quad (1)$$

Its volume is 5575 mm^3. Steps of 2 s make a time of 6 s in row three.

It falls less than 40 m. It falls farther than that.

 Appendix. More

R =\t11

Its edge is 11 mm.
"""


def claim(name: str, quote: str, kind: str = "input", unit: str = "mm", **more: Any) -> Any:
    own = {} if "computed_by" in more or kind == "constant" else {"given": "choice"}
    return {"id": name, "title": name, "quote": quote, "kind": kind, "unit": unit, **own, **more}


SMALL: dict[str, Any] = {
    "report": {"text": "small.txt", "title": "A Small Report", "author": "Nobody", "year": 1999},
    "reasons": {"choice": "chosen"},
    "table": {"blank": ["C1:D2"]},
    "groups": {"size": {"diameter": "width"}},
    "inferred": {
        "density": {
            "title": "density", "symbol": "rho", "unit": "kg/m^3", "quantity": "density",
            "search": ["1", "10"], "nominal": "5/2", "nominal_source": "guess", "mass": "volume",
            "radius": "radius", "density": "volume", "header": ["volume"], "results": ["time"],
            "evidence": ["volume"],
        }
    },
    "symbols": {
        name: {"written": [name], "shown": name, "unit": "m", "means": name} for name in "DR"
    },
    "quantities": {"density": {"unit": "kg/m^3", "search": ["1", "9"], "reason": "any"}},
    "furniture": [{"pattern": r" 14\. ABSTRACT|1\. Balls|\(1\)|\^3", "reason": "heading"}],
    "equation": [{"id": "diameter", "title": "d", "quote": "$$ ⟦D = 2R⟧, \\quad",
                  "kind": "derived", "follows_from": "geometry"}],
    "slip": [{"name": "off", "reason": "any", "equation": "diameter", "text": "D = 3R"}],
    "claim": [
        claim("width", "ball is ⟦22⟧ mm wide"),
        claim("radius", "radius is ⟦11⟧ mm", "result", computed_by="half",
              rests_on={"value": "width"}),
        claim("volume", "is ⟦5575⟧ mm", "result", "mm^3", computed_by="sphere_volume",
              rests_on={"group": "size"}),
        claim("two", "D = ⟦2⟧R", "constant", "1"),
        claim("step", "Steps of ⟦2⟧ s", unit="s"),
        claim("time", "a time of ⟦6⟧ s", "result", "s", row=3, computed_by="row_time",
              rests_on={"step": "step"}),
        claim("row", "in row ⟦three⟧", "quoted", "1"),
        claim("fall", "less than ⟦40⟧ m", "bound", "m", relation="<"),
        claim("farther", "falls ⟦farther⟧ than", "comparison", "m", relation=">", against="fall",
              computed_by="same_as", rests_on={"value": "fall"}),
        claim("cell", "R =\t⟦11⟧", cell="B1", computed_by="same_as", rests_on={"value": "radius"}),
        claim("edge", "edge is ⟦11⟧ mm", "approximation"),
    ],
    "source": [{"id": "book", "title": "t", "address": "a", "quote": "⟦2.5⟧", "unit": "kg/m^3",
                "applies": "yes", "claims": ["inferred:density"]}],
}  # fmt: skip


def change(table: Any, changes: dict[str, Any]) -> None:
    for key, value in changes.items():
        if isinstance(table, list):
            change(next(own for own in table if key in (own.get("id"), own.get("name"))), value)
        elif value == "":
            del table[key]
        elif isinstance(value, dict) and key in table:
            change(table[key], value)
        else:
            table[key] = value


def small(changes: str = "") -> Ledger:
    """The small ledger, changed."""
    document = deepcopy(SMALL)
    change(document, tomllib.loads(changes))
    return read(document, TEXT, document.pop("source"))


def test_the_small_ledger_is_read() -> None:
    ledger = small()
    assert list(ledger.claims) == [
        *("width", "radius", "two", "volume", "step", "time", "row", "fall", "farther", "edge"),
        "cell",
    ]
    assert uncovered(TEXT, ledger.claims.values(), [f.pattern for f in ledger.furniture]) == [
        (3, "3")
    ]
    assert ledger.blank == ("C1", "D1", "C2", "D2")
    assert ledger.claims["volume"].inputs == {"diameter": ("width",)}
    assert str(ledger.claims["farther"].interval()) == "(40, inf)"
    assert small('inferred.density.unit = "g/cm^3"').value("inferred:density") == 2500
    own = small('claim.volume.rests_on.diameter = "edge"')
    assert own.claims["volume"].inputs == {"diameter": ("edge",)}, "an entry goes before its group"


REFUSED = """
claim = []  # the ledger is empty
claim.width.exakt = true  # ledger.toml: Object contains unknown field
claim.width.title = ""  # ledger.toml: Object missing required field
claim.width.kind = "guess"  # Invalid enum value 'guess' - at `claim 'width'.kind`
claim.fall.relation = "=="  # ledger.toml: Invalid enum value '=='
inferred.density.search = ["a", "b"]  # ledger.toml: Invalid literal
claim.radius.id = "width"  # 'width' stands in the ledger twice
claim.edge.id = "diameter"  # 'diameter' stands in the ledger twice
claim.width.unit = "mmm"  # claim 'width': unknown unit 'mmm'
claim.width.quote = "ball is ⟦23⟧ mm"
# claim 'width': the report has 'ball is 23 mm' 0 times, not once
claim.width.quote = "is ⟦11⟧ mm"  # claim 'width': the report has 'is 11 mm' 2 times, not once
claim.width.quote = "is 22⟧ mm"  # claim 'width': its quote needs
claim.width.quote = "is ⟦22"  # claim 'width': its quote needs
claim.width.quote = "A ⟦ball⟧ is"  # claim 'width': cannot read 'ball'
equation.diameter.quote = "⟦D = 3R⟧"
# equation 'diameter': the report has 'D = 3R' 0 times, not once
equation.diameter.id = "eq99"  # equation 'eq99': nothing in reference/derivations.py derives it
symbols.R = ""  # equation 'diameter': cannot read 'R' in the equation
symbols.R.unit = "ell"  # symbol 'R': unknown unit 'ell'
slip.off.equation = "eq9"  # slip 'off': there is no equation 'eq9'
slip.off.text = "D + 3R"  # slip 'off': 'D + 3R' has no equals sign
slip.off.inputs.a = "b"  # slip 'off': there is no number 'b'
claim.radius.computed_by = "halve"  # claim 'radius': there is no computation 'halve'
claim.radius.readings.other = "halve"  # claim 'radius': there is no computation 'halve'
claim.radius.readings.other = "sphere_volume"
# claim 'radius', sphere_volume: needs inputs ['diameter'], not ['value']
claim.radius.rests_on.value = ""  # claim 'radius', half: needs inputs
claim.radius.rests_on.value = "width * breadth"
# claim 'radius', half: there is no number 'breadth'
claim.radius.rests_on.value = "inferred:width"
# claim 'radius', half: there is no inferred input 'width'
claim.radius.rests_on.value = "farther"
# claim 'radius', half: there is no number 'farther': what it prints is in words
claim.time.rests_on.step = "step * width"
# claim 'time', row_time: input step is in s mm, which does not measure what s does
claim.row.computed_by = "count"
claim.row.given = ""
claim.row.rests_on.a = "width"
claim.row.rests_on.b = "step"
# claim 'row', count: input b is in s, which does not measure what mm does
claim.volume.unit = "mm^2"
# claim 'volume', sphere_volume: unit mm^2 does not measure what m^3 does
claim.radius.unit = "s"  # claim 'radius', half: unit s does not measure what mm does
claim.width.given = ""
claim.width.computed_by = "same_as"
claim.width.rests_on.value = "cell"
# claims rest on each other: width on radius on cell on width
claim.volume.rests_on.group = "s"  # claim 'volume': there is no
claim.radius.given = "choice"  # claim 'radius': needs either
claim.width.given = ""  # claim 'width': needs either computed_by or given
claim.width.rests_on.a = "edge"  # claim 'width': rests_on needs computed_by
claim.width.given = "whim"  # claim 'width': there is no reason 'whim'
claim.width.quantity = "q"  # claim 'width': there is no quantity 'q'
claim.fall.relation = ""  # claim 'fall': kind 'bound' needs a
claim.farther.against = "falls"  # claim 'farther': there is no number 'falls'; is it 'fall'?
claim.farther.against = "width"  # claim 'farther': is in m, but width in mm
claim.width.shown_by = ["time"]  # claim 'width': 'time' does not rest on it
table.blank = ["C1"]  # [table] blank: 'C1' is no range of cells
claim.time.row = ""  # claim 'time', row_time: needs a row
claim.radius.row = 1  # claim 'radius', half: takes no row
inferred.density.evidence = ["volumes"]  # inferred 'density': there is no claim 'volumes'
inferred.density.quantity = "q"  # inferred 'density': there is no quantity 'q'
claim.fall.row = "three"  # `claim 'fall'.row`
slip.off.text = 7  # `slip 'off'.text`
claim.width.id = ""  # `claim '0'`
source.book.claims = ["width"]  # source 'book': width is not in kg/m^3
source.book.claims = ["breadth"]  # source 'book': there is no number 'breadth'
source.book.quote = "2.5"  # source 'book': its quote marks no number
source.book.quote = "⟦1⟧ ⟦2⟧ ⟦3⟧"  # source 'book': its quote marks no number
source.book.pages = "3"  # sources.toml: Object contains unknown field
"""
"""Changes of the small ledger, and what is said of it; "" takes a key away."""


@pytest.mark.parametrize(("changes", "message"), re.findall("([^#]+)# ([^\n]+)\n", REFUSED))
def test_a_malformed_ledger_is_refused_by_name(changes: str, message: str) -> None:
    with pytest.raises(LedgerError, match=re.escape(message)):
        small(changes)
