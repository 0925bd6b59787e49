"""The report's ledger is complete and in place; a malformed one is refused by name."""

import re
import tomllib
from collections import Counter
from collections.abc import Callable
from copy import deepcopy
from dataclasses import replace
from fractions import Fraction
from importlib import resources
from typing import Any

import pytest

from reference.ledger import KINDS, Claim, Ledger, LedgerError, load, read
from reference.printed import Interval

LEDGER = load()
CLAIMS = list(LEDGER.claims.values())
PRINTED = [claim for claim in CLAIMS if claim.kind != "blank"]
DOCUMENT = tomllib.loads((resources.files("reference.report") / "ledger.toml").read_text("utf-8"))

Document = dict[str, Any]


# The real ledger


def test_nothing_that_the_report_prints_is_left_out() -> None:
    assert LEDGER.uncovered() == []


def test_it_is_the_report_that_was_handed_down() -> None:
    assert LEDGER.title == "Modeling Impacts for Cold-Gas Dynamic Spray"
    assert LEDGER.author == "W. S. de Rosset"
    assert LEDGER.year == 2006
    assert LEDGER.title in LEDGER.text
    assert load() is LEDGER


@pytest.mark.parametrize("claim", PRINTED, ids=lambda claim: claim.id)
def test_a_claim_stands_where_its_quote_does(claim: Claim) -> None:
    before, text, after = re.split("[⟦⟧]", claim.quote)
    start, end = claim.place.start, claim.place.end
    assert LEDGER.text[start:end] == claim.text == text
    assert LEDGER.text[start - len(before) : end + len(after)] == before + text + after
    assert LEDGER.text.count(before + text + after) == 1
    lines = LEDGER.text.split("\n")
    assert sum(len(line) + 1 for line in lines[: claim.place.line - 1]) <= start
    assert start <= sum(len(line) + 1 for line in lines[: claim.place.line])


@pytest.mark.parametrize("claim", PRINTED, ids=lambda claim: claim.id)
def test_no_claim_can_be_dropped_unnoticed(claim: Claim) -> None:
    """Its number is then uncovered, word by word, unless another claim stands there too."""
    others = {key: other for key, other in LEDGER.claims.items() if key != claim.id}
    found = replace(LEDGER, claims=others).uncovered()
    same_words = any(other.place.start == claim.place.start for other in others.values())
    words = re.findall(r"\d+", claim.text) or re.split("[ -]", claim.text.lower())
    words = [word for word in words if word != "times"]
    if claim.kind == "comparison" or same_words:
        assert found == []
    else:
        assert [(line, word.lower()) for line, word in found] == [
            (claim.place.line, word) for word in words
        ]


def test_words_are_shared_only_where_the_report_makes_one_number_of_two() -> None:
    starts = Counter(claim.place.start for claim in PRINTED)
    shared = {claim.id for claim in PRINTED if starts[claim.place.start] > 1}
    assert shared == {"coarse-step-beta-3", "coarse-step-beta-5", "excess-beta-3", "excess-beta-5"}


def leaves() -> list[str]:
    """Claims of numbers that nothing rests on, is compared with, or is inferred from."""
    used = {name for claim in CLAIMS for names in claim.inputs.values() for name in names}
    for entry in LEDGER.inferred.values():
        used |= {entry.mass, *entry.evidence, *entry.header, *entry.results}
    used |= {e[k] for e in DOCUMENT["claim"] for k in ("against", "prints_like") if k in e}
    starts = Counter(claim.place.start for claim in CLAIMS)
    return [
        claim.id
        for claim in PRINTED
        if claim.id not in used and claim.kind != "comparison" and starts[claim.place.start] == 1
    ]


@pytest.mark.parametrize("name", leaves()[::3])
def test_a_ledger_read_without_one_entry_is_incomplete(name: str) -> None:
    kept = [entry for entry in DOCUMENT["claim"] if entry["id"] != name]
    assert len(kept) == len(DOCUMENT["claim"]) - 1
    incomplete = read({**DOCUMENT, "claim": kept}, LEDGER.text)
    assert {line for line, _ in incomplete.uncovered()} == {LEDGER.claims[name].place.line}


@pytest.mark.parametrize("number", range(len(DOCUMENT["furniture"])))
def test_every_piece_of_furniture_is_needed(number: int) -> None:
    furniture = LEDGER.furniture[:number] + LEDGER.furniture[number + 1 :]
    assert replace(LEDGER, furniture=furniture).uncovered()


def test_furniture_hides_no_claim() -> None:
    for pattern, reason in LEDGER.furniture:
        assert reason
        for match in re.finditer(pattern, LEDGER.text):
            for claim in PRINTED:
                apart = claim.place.end <= match.start() or match.end() <= claim.place.start
                assert apart or claim.kind == "comparison", (claim.id, pattern)


def test_claims_are_in_the_order_of_the_report_and_the_table_last() -> None:
    running = [claim.place.start for claim in CLAIMS if claim.place.cell is None]
    assert running == sorted(running)
    cells = [claim.place.cell for claim in CLAIMS if claim.place.cell]
    assert [claim.place.cell for claim in CLAIMS[-len(cells) :]] == cells
    assert cells == sorted(cells, key=lambda cell: (int(cell[1:]), cell[0]))


@pytest.mark.parametrize(
    ("name", "section", "equation", "cell"),
    [
        ("eq1-power", "section 2", "1", None),
        ("observed-depth-ratio", "section 2", "4", None),
        ("fz-kt", "section 3", "17", None),
        ("summary-ratio", "section 6", None, None),
        ("a-step", "appendix", None, None),
        ("a1-deceleration-2", "appendix", None, "E10"),
        ("a1-blank-B12", "appendix", None, "B12"),
    ],
)
def test_places_can_be_found_by_a_reader(
    name: str, section: str, equation: str | None, cell: str | None
) -> None:
    place = LEDGER.claims[name].place
    assert (place.section, place.equation, place.cell) == (section, equation, cell)
    assert (f"Eq. {equation}" if equation else cell or section) in str(place)


def test_every_kind_is_used() -> None:
    assert {claim.kind for claim in CLAIMS} == set(KINDS)


# Table A-1


def table() -> dict[str, str]:
    """The report's table, cell by cell, from its tabs."""
    _, _, after = LEDGER.text.rpartition("Table A-1. Rigid body penetration.\n\n")
    lines = after.split("\n")[:12]
    return {
        f"{column}{row}": cell
        for row, line in enumerate(lines, 1)
        for column, cell in zip("ABCDEF", (line + "\t" * 6).split("\t"), strict=False)
    }


def test_every_cell_of_the_table_has_exactly_one_claim() -> None:
    claimed = Counter(claim.place.cell for claim in CLAIMS if claim.place.cell)
    labels = {"A1", "A2", "A3", "A4", "A5", "A6", "A7", "C7", "D7", "E7", "F7"}
    assert set(claimed) == set(table()) - labels
    assert set(claimed.values()) == {1}
    assert all(re.search("[A-Za-z]", table()[cell]) for cell in labels)


def test_the_claims_of_the_table_print_the_table() -> None:
    printed = {claim.place.cell: claim.text for claim in CLAIMS if claim.place.cell}
    assert printed == {cell: table()[cell].strip() for cell in printed}
    rows = LEDGER.text.rstrip().split("\n")[-5:]
    for number, line in enumerate(rows, 8):
        joined = "\t".join(printed[f"{column}{number}"] for column in "ABCDEF")
        assert joined.rstrip("\t") == line.rstrip("\t")


def test_blank_cells_say_that_they_are() -> None:
    blanks = [claim for claim in CLAIMS if claim.kind == "blank"]
    assert len(blanks) == 24 + 6 + 1
    for claim in blanks:
        assert claim.id == f"a1-blank-{claim.place.cell}"
        assert (claim.text, claim.printed, claim.interval, claim.inputs) == ("", None, None, {})


# What a claim's kind makes of its text


@pytest.mark.parametrize(
    ("name", "interval"),
    [
        ("depth-beta-5", "[7.665, 7.675]"),
        ("a1-mass", "[4.955E-11, 4.965E-11)"),
        ("a1-time-3", "[5.5E-10, 6.5E-10)"),
        ("a1-depth-0", "0"),
        ("eq2-factor", "1/3"),
        ("eq5-power-target", "2"),
        ("sphere-length-ratio", "2/3"),
        ("observed-ratio", "[0.25, 0.35]"),
        ("observed-third", "[7/24, 5/12]"),
        ("outlier-volume", "[7450, 7550]"),
        ("profile-depth", "(2, inf)"),
        ("copper-yield-bound", "(-inf, 100)"),
        ("strain-rate", "[1E+7, inf)"),
        ("cth-pressure", "(-inf, 5]"),
        ("frank-zook-below-observed", "(-inf, 0.298)"),
        ("coarse-step-beta-3", "[9.95, 10.05]"),
        ("coarse-step-beta-5", "[7.665, 7.675]"),
    ],
)
def test_the_values_that_agree_with_a_claim(name: str, interval: str) -> None:
    assert str(LEDGER.claims[name].interval) == interval


@pytest.mark.parametrize(
    ("name", "loose", "expected"),
    [
        ("flow-stress", False, "7E+8"),
        ("flow-stress", True, "[6.5E+8, 7.5E+8]"),
        ("strain-rate-length", False, "[0.000015, 0.000025]"),
        ("volume-ratio", False, "[0.055, 0.065]"),
        ("a1-radius", False, "[0.00001095, 0.00001105)"),
        ("observed-third", False, "1/3"),
        ("observed-third", True, "1/3"),
        ("a-step", False, "2E-10"),
        ("a-step", True, "[1.5E-10, 2.5E-10]"),
        ("mean-diameter", False, "[0.0000215, 0.0000225]"),
    ],
)
def test_the_values_that_a_number_stands_for_as_an_input(
    name: str, loose: bool, expected: str
) -> None:
    assert str(LEDGER.claims[name].as_input(loose)) == expected


@pytest.mark.parametrize("name", ["initial-depth", "eq5-power-target", "a1-depth-0"])
@pytest.mark.parametrize("loose", [False, True])
def test_an_exact_number_is_exact_as_an_input(name: str, loose: bool) -> None:
    claim = LEDGER.claims[name]
    assert claim.as_input(loose) == claim.interval.scaled(claim.si)


def test_claims_in_si() -> None:
    assert LEDGER.claims["particle-volume"].si == Fraction(1, 10**18)
    assert LEDGER.claims["flow-stress"].si == 10**6
    assert LEDGER.claims["observed-ratio"].si == 1


def test_inputs_come_from_products_groups_and_inference() -> None:
    inputs = LEDGER.claims["depth-beta-3"].inputs
    assert inputs["resistance"] == ("depth-beta-3-beta", "flow-stress")
    assert inputs["target_density"] == ("inferred:target-density",)
    assert inputs["stop_velocity"] == ("a-stop-velocity",)


def test_the_inferred_density() -> None:
    (density,) = LEDGER.inferred.values()
    assert (density.id, density.nominal, density.unit) == ("target-density", 7850, "kg/m^3")
    assert density.search[0] < density.nominal < density.search[1]
    assert density.resolution == Fraction(1, 1000)
    assert density.nominal in [printed.value for printed in density.handbook.values()]
    assert all(name in LEDGER.claims for name in density.evidence)


# A small ledger

TEXT = """ A Small Report

 14. ABSTRACT About 3 things.

1. Balls

A ball is 22 mm wide, so its radius is 11 mm.

Its volume is 5575 mm^3. Steps of 2 s make a time of 6 s in row three.

It falls less than 40 m. It falls farther than that.

 Appendix. More

Table A-1.

R =\t11

Its edge is 11 mm.
"""

SMALL: Document = {
    "report": {"text": "small.txt", "title": "A Small Report", "author": "Nobody", "year": 1999},
    "reasons": {"choice": "chosen"},
    "groups": {"size": {"diameter": "width"}},
    "inferred": {
        "density": {
            "title": "density",
            "symbol": "rho",
            "unit": "kg/m^3",
            "search": ["1", "10"],
            "resolution": "1/10",
            "nominal": "5/2",
            "nominal_source": "guess",
            "mass": "volume",
            "header": ["volume"],
            "results": ["time"],
            "evidence": ["volume"],
            "handbook": [{"name": "book", "value": "2.5"}],
        }
    },
    "furniture": [{"pattern": r" 14\. ABSTRACT|1\. Balls|A-1|\^3", "reason": "heading"}],
    "claim": [
        {
            "id": "width",
            "title": "width",
            "quote": "ball is ⟦22⟧ mm wide",
            "unit": "mm",
            "kind": "input",
            "given": "choice",
        },
        {
            "id": "radius",
            "title": "radius",
            "quote": "radius is ⟦11⟧ mm",
            "unit": "mm",
            "kind": "result",
            "computed_by": "half",
            "rests_on": {"value": "width"},
        },
        {
            "id": "volume",
            "title": "volume",
            "quote": "is ⟦5575⟧ mm",
            "unit": "mm^3",
            "kind": "result",
            "computed_by": "sphere_volume",
            "rests_on": {"group": "size"},
        },
        {
            "id": "step",
            "title": "step",
            "quote": "Steps of ⟦2⟧ s",
            "unit": "s",
            "kind": "input",
            "given": "choice",
        },
        {
            "id": "time",
            "title": "time",
            "quote": "a time of ⟦6⟧ s",
            "unit": "s",
            "kind": "result",
            "row": 3,
            "computed_by": "row_time",
            "rests_on": {"step": "step"},
        },
        {
            "id": "row",
            "title": "row",
            "quote": "in row ⟦three⟧",
            "kind": "quoted",
            "given": "choice",
        },
        {
            "id": "fall",
            "title": "fall",
            "quote": "less than ⟦40⟧ m",
            "unit": "m",
            "kind": "bound",
            "relation": "<",
            "given": "choice",
        },
        {
            "id": "farther",
            "title": "farther",
            "quote": "falls ⟦farther⟧ than",
            "unit": "m",
            "kind": "comparison",
            "relation": ">",
            "against": "fall",
            "computed_by": "same_as",
            "rests_on": {"value": "fall"},
        },
        {
            "id": "cell",
            "title": "radius in the table",
            "quote": "R =\t⟦11⟧",
            "unit": "mm",
            "kind": "input",
            "cell": "B1",
            "computed_by": "same_as",
            "rests_on": {"value": "radius"},
        },
        {
            "id": "edge",
            "title": "edge",
            "quote": "edge is ⟦11⟧ mm",
            "unit": "mm",
            "kind": "approximation",
            "given": "choice",
        },
        {"id": "blank", "title": "blank", "kind": "blank", "cells": "C1:D2"},
    ],
}


def small(**changes: Any) -> Ledger:
    return read({**deepcopy(SMALL), **changes}, TEXT)


def test_the_small_ledger_is_read() -> None:
    ledger = small()
    assert list(ledger.claims) == [
        *("width", "radius", "volume", "step", "time", "row", "fall", "farther", "edge"),
        *("cell", "blank-C1", "blank-D1", "blank-C2", "blank-D2"),
    ]
    assert ledger.uncovered() == [(3, "3")]
    assert ledger.claims["volume"].inputs == {"diameter": ("width",)}
    assert ledger.claims["time"].row == 3
    assert ledger.claims["row"].unit == "1"
    assert ledger.claims["width"].given == "chosen"
    assert ledger.claims["radius"].given is None
    assert ledger.claims["farther"].interval == Interval(Fraction(40), None, False, False)
    assert ledger.inferred["density"].nominal == Fraction(5, 2)
    assert ledger.furniture == ((r" 14\. ABSTRACT|1\. Balls|A-1|\^3", "heading"),)


@pytest.mark.parametrize(
    ("name", "line", "section"),
    [
        ("width", 7, "section 1"),
        ("volume", 9, "section 1"),
        ("fall", 11, "section 1"),
        ("cell", 17, "appendix"),
        ("blank-D2", 15, "appendix"),
        ("edge", 19, "appendix"),
    ],
)
def test_the_places_of_the_small_ledger(name: str, line: int, section: str) -> None:
    place = small().claims[name].place
    assert (place.line, place.section) == (line, section)


def test_a_cell_is_named_and_a_sentence_placed() -> None:
    claims = small().claims
    assert str(claims["cell"].place) == "Table A-1, cell B1"
    assert str(claims["edge"].place).startswith("appendix, ")


def test_numbers_ahead_of_the_sections() -> None:
    things = {"title": "things", "kind": "quoted", "given": "choice"}
    abstract = {**things, "id": "abstract", "quote": "About ⟦3⟧ things", "equation": "7"}
    title = {**things, "id": "title", "quote": "⟦Two⟧ Words"}
    ledger = read({**SMALL, "inferred": {}, "claim": [abstract, title]}, "Two Words\n" + TEXT)
    assert ledger.claims["abstract"].place.section == "abstract"
    assert ledger.claims["title"].place.section == "title"
    assert str(ledger.claims["abstract"].place).endswith(", Eq. 7")
    assert list(ledger.claims) == ["title", "abstract"]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("none of it", []),
        ("onesided, attention, twofold", []),
        ("Three, halves.\nTWICE", [(1, "Three"), (1, "halves"), (2, "TWICE")]),
        ("x2y\n\n10^7", [(1, "2"), (3, "10"), (3, "7")]),
        ("one-sixth and a third", [(1, "one"), (1, "sixth"), (1, "third")]),
    ],
)
def test_digits_and_number_words_need_a_claim(text: str, found: list[tuple[int, str]]) -> None:
    assert replace(LEDGER, text=text, claims={}, furniture=()).uncovered() == found


def test_a_number_half_taken_is_not_covered() -> None:
    halves = replace(LEDGER, text="700 m", claims={}, furniture=(("7", "odd"), ("00? m", "odd")))
    assert halves.uncovered() == []
    assert replace(halves, furniture=halves.furniture[:1]).uncovered() == [(1, "700")]
    assert replace(halves, furniture=halves.furniture[1:]).uncovered() == [(1, "700")]


def test_an_entry_goes_before_its_group() -> None:
    document = deepcopy(SMALL)
    put("volume", rests_on={"group": "size", "diameter": "edge"})(document)
    assert read(document, TEXT).claims["volume"].inputs == {"diameter": ("edge",)}


# Malformed ones


def claim_of(document: Document, name: str) -> Document:
    (entry,) = [entry for entry in document["claim"] if entry["id"] == name]
    return entry


def put(name: str, **values: Any) -> Callable[[Document], None]:
    return lambda document: claim_of(document, name).update(values)


def drop(name: str, *keys: str) -> Callable[[Document], None]:
    def change(document: Document) -> None:
        for key in keys:
            del claim_of(document, name)[key]

    return change


def both(*changes: Callable[[Document], None]) -> Callable[[Document], None]:
    def change(document: Document) -> None:
        for single in changes:
            single(document)

    return change


def refused(change: Callable[[Document], None]) -> str:
    document = deepcopy(SMALL)
    change(document)
    assert document != SMALL
    with pytest.raises(LedgerError) as caught:
        read(document, TEXT)
    return str(caught.value)


MALFORMED: dict[str, tuple[Callable[[Document], None], str]] = {
    "no claims": (lambda d: d.update(claim=[]), "the ledger is empty"),
    "no claim table": (lambda d: d.pop("claim"), "the ledger is empty"),
    "duplicate id": (put("radius", id="width"), "claim 'width' stands in the ledger twice"),
    "duplicate blank": (put("width", id="blank-C1"), "claim 'blank-C1' stands in the ledger twice"),
    "no id": (drop("width", "id"), "claim '?': lacks id"),
    "no title, no kind": (drop("width", "title", "kind"), "claim 'width': lacks kind, title"),
    "unknown kind": (put("width", kind="guess"), "claim 'width': kind 'guess' is none of input,"),
    "unknown unit": (put("width", unit="mmm"), "claim 'width': unknown unit 'mmm'"),
    "quote not in the report": (
        put("width", quote="ball is ⟦23⟧ mm"),
        "claim 'width': the report has 'ball is 23 mm' 0 times, not once",
    ),
    "quote twice in the report": (
        put("width", quote="is ⟦11⟧ mm"),
        "claim 'width': the report has 'is 11 mm' 2 times, not once",
    ),
    "no brackets": (put("width", quote="ball is 22 mm"), "claim 'width': its quote needs"),
    "no closing bracket": (put("width", quote="is ⟦22 mm"), "claim 'width': its quote needs"),
    "no opening bracket": (put("width", quote="is 22⟧ mm"), "claim 'width': its quote needs"),
    "no quote": (drop("width", "quote"), "claim 'width': its quote needs"),
    "no number": (put("width", quote="A ⟦ball⟧ is"), "claim 'width': cannot read 'ball'"),
    "unknown computation": (
        put("radius", computed_by="halve"),
        "claim 'radius': there is no computation 'halve'",
    ),
    "unknown reading": (
        put("radius", readings={"other": "halve"}),
        "claim 'radius': there is no computation 'halve'",
    ),
    "reading of other inputs": (
        put("radius", readings={"other": "sphere_volume"}),
        "claim 'radius', sphere_volume: needs inputs ['diameter'], not ['value']",
    ),
    "missing input": (
        put("radius", rests_on={}),
        "claim 'radius', half: needs inputs ['value'], not []",
    ),
    "surplus input": (
        put("radius", rests_on={"value": "width", "more": "width"}),
        "claim 'radius', half: needs inputs ['value'], not ['more', 'value']",
    ),
    "unknown input": (
        put("radius", rests_on={"value": "breadth"}),
        "claim 'radius', half: there is no number 'breadth' to rest on",
    ),
    "unknown factor": (
        put("radius", rests_on={"value": "width * breadth"}),
        "claim 'radius', half: there is no number 'breadth' to rest on",
    ),
    "unknown inferred input": (
        put("radius", rests_on={"value": "inferred:width"}),
        "claim 'radius', half: there is no number 'inferred:width' to rest on",
    ),
    "blank input": (
        put("radius", rests_on={"value": "blank-C1"}),
        "claim 'radius', half: there is no number 'blank-C1' to rest on",
    ),
    "comparison as input": (
        put("radius", rests_on={"value": "farther"}),
        "claim 'radius', half: there is no number 'farther' to rest on",
    ),
    "input of another dimension": (
        put("time", rests_on={"step": "width"}),
        "claim 'time', row_time: input step is in mm, which does not measure what s does",
    ),
    "product of another dimension": (
        put("time", rests_on={"step": "step * width"}),
        "claim 'time', row_time: input step is in s*mm, which does not measure what s does",
    ),
    "inferred input of another dimension": (
        put("time", rests_on={"step": "inferred:density"}),
        "claim 'time', row_time: input step is in kg/m^3, which does not measure what s does",
    ),
    "inputs of several dimensions": (
        put("row", given=None, computed_by="count", rests_on={"a": "width", "b": "step"}),
        "claim 'row', count: input b is in s, which does not measure what mm does",
    ),
    "result of another dimension": (
        put("volume", unit="mm^2"),
        "claim 'volume', sphere_volume: unit mm^2 does not measure what m^3 does",
    ),
    "result of another dimension than its input": (
        put("radius", unit="s"),
        "claim 'radius', half: unit s does not measure what mm does",
    ),
    "resting on itself": (
        put("radius", rests_on={"value": "radius"}),
        "claims rest on each other: radius on radius",
    ),
    "circle": (
        both(
            put("width", given=None, computed_by="twice", rests_on={"value": "edge"}),
            put("edge", given=None, computed_by="same_as", rests_on={"value": "cell"}),
        ),
        "claims rest on each other: ",
    ),
    "unknown group": (
        put("volume", rests_on={"group": "sizes"}),
        "claim 'volume': there is no group 'sizes'",
    ),
    "both computed and given": (
        put("radius", given="choice"),
        "claim 'radius': needs either computed_by or given",
    ),
    "neither computed nor given": (
        drop("width", "given"),
        "claim 'width': needs either computed_by or given",
    ),
    "given blank": (put("blank", given="choice"), "claim 'blank-C1': needs either"),
    "unknown reason": (put("width", given="whim"), "claim 'width': there is no reason 'whim'"),
    "unknown relation": (put("fall", relation="=="), "claim 'fall': relation '==' is none of <,"),
    "comparison against nothing": (
        drop("farther", "against"),
        "claim 'farther': a comparison needs `against`",
    ),
    "comparison against an unknown claim": (
        put("farther", against="falls"),
        "claim 'farther': a comparison needs `against`",
    ),
    "comparison against a blank": (
        put("farther", against="blank-C1"),
        "claim 'farther': a comparison needs `against`",
    ),
    "comparison without relation": (
        drop("farther", "relation"),
        "claim 'farther': relation '' is none of <,",
    ),
    "comparison in another unit": (
        put("farther", against="width"),
        "claim 'farther': is in m, but width in mm",
    ),
    "printing like another unit": (
        both(drop("farther", "against"), put("farther", prints_like="width")),
        "claim 'farther': is in m, but width in mm",
    ),
    "no range": (put("blank", cells="C1"), "claim 'blank': 'C1' is no range of cells"),
    "range outside the table": (put("blank", cells="E1:G2"), "claim 'blank': 'E1:G2' is no range"),
    "row missing": (drop("time", "row"), "claim 'time', row_time: needs a row"),
    "row surplus": (put("radius", row=1), "claim 'radius', half: takes no row"),
    "evidence unknown": (
        lambda d: d["inferred"]["density"].update(evidence=["volumes"]),
        "inferred 'density': there is no claim 'volumes'",
    ),
}


@pytest.mark.parametrize("fault", MALFORMED)
def test_a_malformed_ledger_is_refused_by_name(fault: str) -> None:
    change, message = MALFORMED[fault]
    assert refused(change).startswith(message)


def test_a_circle_names_all_who_stand_in_it() -> None:
    change, _ = MALFORMED["circle"]
    message = refused(change)
    assert all(name in message for name in ("width", "radius", "cell", "edge"))
    assert "volume" not in message


# Faults of which the message need only name the entry

SLIPS: dict[str, tuple[Callable[[Document], None], str]] = {
    "range of cells without an id": (drop("blank", "id"), "claim"),
    "range of no cells": (put("blank", cells="D2:C1"), "claim 'blank'"),
    "bound without relation": (drop("fall", "relation"), "claim 'fall'"),
    "given, yet resting on nothing known": (put("width", rests_on={"a": "b"}), "claim 'width'"),
    "misspelt key": (put("width", exakt=True), "claim 'width'"),
}


@pytest.mark.parametrize("fault", SLIPS)
def test_a_slip_is_refused(fault: str) -> None:
    change, entry = SLIPS[fault]
    assert refused(change).startswith(entry)


# Relations


@pytest.mark.parametrize(
    ("relation", "interval"),
    [("<", "(-inf, 40)"), ("<=", "(-inf, 40]"), (">", "(40, inf)"), (">=", "[40, inf)")],
)
def test_relations(relation: str, interval: str) -> None:
    document = deepcopy(SMALL)
    put("fall", relation=relation)(document)
    put("farther", relation=relation)(document)
    claims = read(document, TEXT).claims
    assert str(claims["fall"].interval) == str(claims["farther"].interval) == interval


def test_a_comparison_may_have_to_print_like_another_claim() -> None:
    document = deepcopy(SMALL)
    drop("farther", "against", "relation")(document)
    put("farther", prints_like="width", unit="mm", rests_on={"value": "width"})(document)
    assert str(read(document, TEXT).claims["farther"].interval) == "[21.5, 22.5]"
