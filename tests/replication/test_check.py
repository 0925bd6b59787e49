"""`coldspray check` on single workbooks: what it takes for what, what it says, how it ends."""

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import html5lib
import pytest
from foreign import layouts, writers
from foreign.drawn import drawn
from foreign.layouts import BRAKE, DEPTH, END, START, TIME, Column, Foreign
from foreign.writers import require_libreoffice
from hypothesis import HealthCheck, assume, example, given, settings
from hypothesis import strategies as st

from replication.cases import BETA_3, BETA_5
from replication.check.examination import KINDS
from replication.check.inputs import report_inputs
from replication.check.scheme import BRAKES, REPORT, Case, march
from replication.check.show import check_record, safe, text
from replication.check.words import COLUMNS, INPUTS
from replication.check.workbook import check
from replication.models import sheet as midpoint
from replication.models.impact import Impact

Run = Callable[..., tuple[int, str, str]]


def written(f: Foreign, folder: Path) -> Path:
    return writers.with_openpyxl(f, folder / f"{f.name}.xlsx")


@pytest.fixture
def spoiled(tmp_path: Path) -> Path:
    """A workbook with one number typed over a formula."""
    f = layouts.french(BETA_5)
    f.cells[f.where[DEPTH, 40]] = 3.7e-6
    return written(f, tmp_path)


# ---- the rules against the models


@pytest.mark.parametrize(("scheme", "brake"), [("published", BRAKES[0]), ("centered", BRAKES[1])])
@given(
    velocity=st.floats(50, 900), radius=st.floats(2e-6, 3e-5), step=st.floats(1e-10, 2e-9),
    beta=st.floats(1, 9),
)  # fmt: skip
@settings(max_examples=40, deadline=None)
def test_the_rules_give_the_sheet_double_for_double(
    scheme: str, brake: object, velocity: float, radius: float, step: float, beta: float
) -> None:
    impact = Impact(
        velocity=velocity, radius=radius, particle_density=8900, target_density=7850,
        resistance=beta * 7e8, step=step,
    )  # fmt: skip
    case = Case(
        velocity, radius, 8900.0, 7850.0, impact.target_resistance, step, impact.stop_velocity
    )
    run = march(case, replace(REPORT, brake=brake))
    sheet = midpoint.run(impact, scheme)
    for role in ("velocity_initial", "depth", "deceleration", "velocity_final"):
        column = [getattr(row, role) for row in sheet.rows]
        assert [run[role].get(k) for k in range(len(column))] == column


def test_the_report_s_inputs_are_those_of_its_cases() -> None:
    report = report_inputs()
    for case, impact in enumerate((BETA_5, BETA_3)):
        assert report["resistance"][case] == impact.target_resistance
        for role in ("velocity", "radius", "particle_density", "target_density", "step"):
            assert report[role][0] == getattr(impact, role)


# ---- what is said


def test_json_has_the_promised_keys_and_every_digit(coldspray: Run, spoiled: Path) -> None:
    status, out, err = coldspray("check", spoiled, "--json")
    record = json.loads(out)
    assert (status, err) == (1, "")
    assert coldspray("check", spoiled) == (1, f"{text(record)}\n", "")
    assert {"differences", "summary", "first"} <= record.keys()
    keys = {"sheet", "cell", "kind", "expected", "found", "explanation"}
    assert all(keys <= entry.keys() for entry in record["differences"])
    assert {entry["kind"] for entry in record["differences"]} <= set(KINDS)
    assert sum(record["summary"].values()) == len(record["differences"])
    first = record["first"]
    assert first in record["differences"]
    assert (first["sheet"], first["cell"]) == ("Calcul pas à pas", "G61")
    assert first["kind"] == "typed number"
    right = midpoint.run(BETA_5).rows[40]
    assert (first["found"], first["expected"]) == (3.7e-6, right.depth)
    assert record["taken"][0]["columns"].keys() <= COLUMNS.keys()
    assert record["taken"][0]["inputs"].keys() <= INPUTS.keys()


def test_the_kinds_are_the_promised_ones() -> None:
    assert set(KINDS) == {
        "stale value", "typed number", "odd formula", "typed constant", "operation order",
        "other scheme", "other input", "unit", "printed number", "not calculated",
    }  # fmt: skip


@pytest.mark.parametrize("layout", [layouts.natural_units, layouts.no_time])
def test_errors_that_follow_from_an_absurd_number_are_not_accused(
    layout: Callable[[Impact], Foreign], tmp_path: Path
) -> None:
    """The motion leaves the range of doubles, so the formulas after it give errors by right."""
    f = layout(BETA_5)
    f.cells[f.where[DEPTH, 60]] = 700.0
    errors = [d for d in check(written(f, tmp_path)).differences if "gives #" in d.explanation]
    assert errors == []


@pytest.mark.parametrize("saved_by", ["us", "LibreOffice"])
def test_our_own_workbook_is_clean(saved_by: str, tmp_path: Path) -> None:
    from replication import workbook

    path = tmp_path / "own.xlsx"
    path.write_bytes(workbook.build().to_bytes())
    if saved_by == "LibreOffice":
        require_libreoffice()
        (path,) = writers.with_libreoffice([path], tmp_path)
    result = check(path)
    assert result.first is None
    sheets = {f.table.sheet: f for f in result.examinations}
    assert {"Table A-1", "Sheet beta 3", "Sheet beta 5", "Sheet beta 3 coarse"} <= sheets.keys()
    for sheet in ("Sheet beta 3", "Sheet beta 5"):
        inputs = sheets[sheet].inputs
        cells = {name: own.place and own.place[0] for name, own in inputs.items()}
        assert set(cells.values()) <= {"Inputs", None}
        assert [name for name, where in cells.items() if where is None] == ["resistance"]


def test_a_velocity_in_the_middle_of_its_row_is_not_that_at_its_end(tmp_path: Path) -> None:
    f, s = Foreign("middle", BETA_5), "run"
    f.line(s, "A1", "V0", "R", "rho_p", "rho_t", "Rt", "dt", "m")
    f.line(s, "A2", 500, 11e-6, 8900, 7850, 3.5e9, 2e-10, "=C2*4/3*PI()*B2^3")
    force = "(0.5*D$2*%s^2+E$2)*PI()*(2*B$2*C{r}-C{r}^2)/G$2"
    f.table(s, 6, [
        Column(TIME, "A", "t", 0, "=A{p}+F$2"),
        Column(START, "B", "v", "=A2", "=B{p}-E{p}*F$2", "=B6"),
        Column(DEPTH, "C", "x", 0, "=C{p}+B{r}*F$2", "=B{r}*F$2/2"),
        Column("", "D", "v_half", None, f"=B{{r}}-{force % 'B{r}'}*F$2/2"),
        Column(BRAKE, "E", "a", None, f"={force % 'D{r}'}"),
    ], steps=130)  # fmt: skip
    result = check(written(f, tmp_path))
    (examination,) = result.examinations
    assert END not in examination.table.lines
    assert examination.rows.rules.name == "centered"
    assert result.first.place == (s, 7, 5)


def by_hand(rows: int = 131, **changes: str | float | None) -> Foreign:
    """A plain sheet whose mass, diameter and resistance are formulas, with some cells changed."""
    return layouts.changed(layouts.plain(BETA_5, rows), changes)


def in_column(f: Foreign, letter: str, old: str, new: str) -> Foreign:
    """The workbook with something else in the formulas of one column, below its first rows."""
    _, _, column = layouts.place("", f"{letter}1")
    for (sheet, row, at), content in f.cells.items():
        if at == column and isinstance(content, str):
            f.cells[sheet, row, at] = content.replace(old, new)
    return f


def test_a_velocity_of_the_next_row_is_named_there(tmp_path: Path) -> None:
    f = in_column(layouts.one_velocity(BETA_5), "C", "*$B$2", "*$B$2*2")
    first = check(written(f, tmp_path)).first
    assert (first.place, first.expected) == (f.where[START, 2], None)
    assert "every step is 2 times that" in first.explanation


@pytest.mark.parametrize(
    ("layout", "lengths", "speeds", "brakes"),
    [(layouts.natural_units, 1e6, 1e-3, 1e-12), (layouts.centimetres, 1e2, 1e2, 1e2)],
)
def test_what_is_expected_is_told_in_the_units_of_its_column(
    tmp_path: Path, layout: Callable[..., Foreign], lengths: float, speeds: float, brakes: float
) -> None:
    row = midpoint.run(BETA_5).rows[40]
    expected = {DEPTH: row.depth * lengths, START: row.velocity_initial * speeds,
                BRAKE: row.deceleration * brakes}  # fmt: skip
    for part, number in expected.items():
        f = layout(BETA_5)
        f.cells[f.where[part, 40]] = 1.0
        first = check(written(f, tmp_path)).first
        assert (first.place, first.expected) == (f.where[part, 40], pytest.approx(number, 1e-12))


def test_a_mass_of_constants_keeps_its_last_digits(tmp_path: Path) -> None:
    f = by_hand(
        A1=None, B1=None, A2=None, B2=None, B3="=4/3*PI()*0.000011^3*8900", B4="=2*0.000011"
    )
    assert check(written(f, tmp_path)).first is None


def test_a_sheet_gone_wrong_is_known_by_its_formulas(tmp_path: Path) -> None:
    first = check(written(by_hand(E2=2e-4), tmp_path)).first
    assert (first.place, first.kind) == (("Sheet1", 2, 5), "unit")
    heads = {f"{letter}7": None for letter in "ACDEF"}
    first = check(written(by_hand(**heads, E14="abc"), tmp_path)).first
    assert (first.place, first.kind) == (("Sheet1", 14, 5), "typed number")


def test_a_step_whose_label_says_nothing_is_known_by_the_times(tmp_path: Path) -> None:
    rows = midpoint.run(replace(BETA_5, step=3e-10)).steps
    result = check(written(by_hand(rows, D2="tau", E2=3e-10), tmp_path))
    assert result.examinations[0].inputs["step"].place == ("Sheet1", 2, 5)


@given(
    velocity=st.floats(100, 1500), radius=st.floats(1e-6, 3e-4), densities=st.floats(2e3, 2e4),
    strength=st.floats(3e7, 5e9), share=st.floats(2e-3, 1e-2),
)  # fmt: skip
@settings(max_examples=12, deadline=None)
@example(velocity=500, radius=11e-6, densities=8000, strength=3.5e9, share=1.8e-4)  # 4 ps
@example(velocity=100, radius=11e-5, densities=2000, strength=3e7, share=8e-3)
def test_a_right_sheet_of_other_inputs_is_clean(
    tmp_path_factory: pytest.TempPathFactory,
    velocity: float, radius: float, densities: float, strength: float, share: float,
) -> None:  # fmt: skip
    """Far from the report's, too, where its values do not tell which unit a number has."""
    velocity, radius, densities, strength, step = (
        float(f"{number:.3g}")
        for number in (velocity, radius, densities, strength, share * radius / velocity)
    )
    impact = Impact(
        velocity=velocity, radius=radius, particle_density=densities, target_density=densities,
        beta=1.5, flow_stress=strength, step=step,
    )  # fmt: skip
    rows = min(midpoint.run(impact).steps, 20)
    assume(rows > 5)
    result = check(written(layouts.plain(impact, rows), tmp_path_factory.mktemp("right")))
    assert result.first is None
    assert {own.how for own in result.examinations[0].inputs.values()} <= {"label", "follows"}


# ---- where it cannot tell


def test_what_is_where_can_be_said(coldspray: Run, tmp_path: Path) -> None:
    f = layouts.no_words(BETA_5)
    path = written(f, tmp_path)
    given = ["depth=Sheet1!AC510:AC641", "velocity=AB510:AB641", "target-density=T503"]
    arguments = [word for text in given for word in ("--map", text)]
    status, out, _ = coldspray("check", path, "--json", *arguments)
    (taken,) = json.loads(out)["taken"]
    assert status == 0
    assert taken["columns"]["depth"] == {
        "cells": "AC510:AC641", "head": None, "unit": "m", "by": "--map",
    }  # fmt: skip
    assert taken["inputs"]["target_density"]["by"] == "--map"


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("depth", "give NAME=RANGE"),
        ("depth=E21:E152", "a unit of something else"),
        ("depth=" + "(" * 99, "a range such as"),
    ],
)
def test_a_map_that_cannot_be_is_explained(
    coldspray: Run, tmp_path: Path, given: str, words: str
) -> None:
    path = written(layouts.french(BETA_5), tmp_path)
    status, out, err = coldspray("check", path, "--map", given)
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert words in err


# ---- hostile contents


EVIL = "</td><script>alert(1)</script>\x9b31m\u202egnp.exe"


@pytest.fixture
def evil(tmp_path: Path) -> Path:
    """Names, heads, labels and texts made to break a terminal or a page; one fault to show."""
    f = layouts.table_a1(BETA_5)
    f.cells = {("Sheet<1>&'x\u202e", r, c): v for (_, r, c), v in f.cells.items()}
    sheet = next(iter(f.cells))[0]
    f.cells[sheet, 7, 4] = f"x {EVIL}"
    f.cells[sheet, 2, 1] = f"Density {EVIL}"
    f.cells[sheet, 3, 8] = EVIL
    f.cells[sheet, 60, 4] = f'=LEN("{EVIL}")'
    return written(f, tmp_path)


def test_nothing_in_a_workbook_reaches_the_terminal(coldspray: Run, evil: Path) -> None:
    status, out, _ = coldspray("check", evil)
    assert status == 1
    assert "\\x9b31m\\u202egnp.exe" in out
    assert all(c.isprintable() or c == "\n" for c in out)


def test_the_page_draws_the_sheet_and_runs_nothing(
    coldspray: Run, evil: Path, tmp_path: Path
) -> None:
    page = tmp_path / "page.html"
    coldspray("check", evil, "--html", page, "--quiet")
    text = page.read_text("utf-8")
    assert "default-src 'none'; style-src 'sha256-" in text
    assert "<script" not in text
    assert "\u202e" not in text
    assert "style=" not in text
    tree = html5lib.HTMLParser(strict=True).parse(text)
    cells = tree.iter("{http://www.w3.org/1999/xhtml}td")
    classes = [td.get("class", "") for td in cells if td.get("id")]
    assert any("origin" in names and "typed-constant" not in names for names in classes)
    links = set(re.findall(r'href="#([^"]+)"', text))
    assert links <= set(re.findall(r'id="([^"]+)"', text))


def test_a_junit_file_has_a_test_for_each_kind(coldspray: Run, evil: Path, tmp_path: Path) -> None:
    coldspray("check", evil, "--junit", tmp_path / "out.xml", "--quiet")
    suite = ET.parse(tmp_path / "out.xml").getroot()
    assert [case.get("name") for case in suite] == list(KINDS)
    failed = [case.get("name") for case in suite if case.find("failure") is not None]
    assert len(failed) == int(suite.get("failures", "-1")) > 0
    assert suite.get("skipped") == "1"


def test_files_are_written_whole_or_not_at_all(
    coldspray: Run, spoiled: Path, tmp_path: Path
) -> None:
    before = spoiled.read_bytes()
    link = tmp_path / "link.xml"
    link.symlink_to(spoiled)
    for arguments in (
        ["--html", tmp_path / "no" / "page.html", "--junit", tmp_path / "a.xml"],
        ["--html", tmp_path / "same", "--junit", tmp_path / "same"],
        ["--html", tmp_path, "--junit", tmp_path / "a.xml"],
        ["--html", spoiled],
        ["--junit", link],
    ):
        status, out, err = coldspray("check", spoiled, *arguments)
        assert (status, out, err.count("\n")) == (2, "", 1)
    link.unlink()
    assert spoiled.read_bytes() == before
    (tmp_path / "junk.xlsx").write_bytes(b"junk")
    assert coldspray("check", tmp_path / "junk.xlsx", "--html", tmp_path / "b.html")[0] == 2
    assert sorted(p.name for p in tmp_path.iterdir()) == ["french.xlsx", "junk.xlsx"]


def test_one_line_and_no_escape_is_left_of_any_text() -> None:
    assert safe("a\r\nb\x1b[31m\x00\u2028\u202e\ud800") == r"a\r\nb\x1b[31m\x00\u2028\u202e\ud800"
    assert safe("x" * 99, 10) == "xxxxxxx..."


CONTENTS = st.one_of(
    st.none(),
    st.sampled_from([0, -1, 1e308, 5e-324, 1e15, True]),
    st.floats(allow_nan=False, allow_infinity=False),
    st.sampled_from(
        ["x", "t", "v", "R [mm]", "dt", "(m)", "=1/0", "=NA()", "=SQRT(-1)", "=1E308*10", '=""',
         "=A1", "=B4:B9", "=ROW()", "=Sheet9!A1", "=[1]S!A1", "=IF(1,2", "0,5", "µm"]
    ),
)  # fmt: skip
BASES = {f.name: f for f in (
    layouts.french(BETA_5), layouts.table_a1(BETA_5), layouts.side_by_side(BETA_5),
    layouts.one_velocity(BETA_5), layouts.printed_digits(BETA_5), drawn(3, BETA_5),
)}  # fmt: skip


@given(
    name=st.sampled_from(sorted(BASES)),
    edits=st.lists(st.tuples(st.integers(0, 9999), CONTENTS), min_size=1, max_size=6),
    heads=st.lists(st.tuples(st.integers(0, 9999), CONTENTS), max_size=2),
)
@example(name="random-3", edits=[(0, None), (19, 2465027.0)], heads=[])  # a step of zero
@settings(max_examples=30, deadline=None, suppress_health_check=list(HealthCheck))
def test_whatever_a_cell_holds_the_answer_is_a_record_or_one_line(
    tmp_path_factory: pytest.TempPathFactory,
    name: str, edits: list[tuple[int, object]], heads: list[tuple[int, object]],
) -> None:  # fmt: skip
    base = BASES[name]
    f = Foreign("fuzz", BETA_5, cells=dict(base.cells), names=base.names)
    texts = [p for p, c in base.cells.items() if isinstance(c, str) and not c.startswith("=")]
    for places, changes in ((list(base.cells), edits), (texts, heads)):
        for at, content in changes:
            place = places[at % len(places)]
            if content is None:
                f.cells.pop(place, None)
            else:
                f.cells[place] = content  # type: ignore[assignment]
    path = written(f, tmp_path_factory.mktemp("fuzz"))
    message = ""
    try:
        json.dumps(check_record(check(path)), allow_nan=False)
    except ValueError as error:
        message = str(error)
    assert not message or (str(path) in message and "\n" not in message)
