"""`coldspray check` and `diff`: how workbooks are read, what is reported, and how well."""

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from foreign import rates, said, writers
from foreign.drawn import drawn
from foreign.layouts import DEPTH, Foreign, made
from hypothesis import HealthCheck, assume, example, given, settings
from hypothesis import strategies as st
from kept import calls, kept
from openpyxl import load_workbook
from pages import HTML, sound
from running import coldspray
from workbooks import usable

from reference.scheme import Scheme
from replication.audit.record import Record
from replication.cases import BETA_5
from replication.check.diff import KINDS as KINDS_OF_DIFF
from replication.check.diff import Tolerance, diff
from replication.check.examination import KINDS
from replication.check.scheme import BRAKES, REPORT, Case, Rule, march
from replication.check.show import check_record, diff_record, html, text
from replication.check.words import COLUMNS, INPUTS
from replication.check.workbook import check
from replication.models import sheet as midpoint
from replication.models.impact import Impact
from replication.workbook import build

Edits = list[tuple[int, object]]


def written(f: Foreign, folder: Path) -> Path:
    return writers.with_openpyxl(f, folder / f"{f.name}.xlsx")


@pytest.mark.parametrize(("scheme", "brake"), [*zip(Scheme, BRAKES, strict=False)])
def test_the_rules_give_the_sheet_double_for_double(scheme: str, brake: Rule) -> None:
    impact = replace(BETA_5, velocity=812.3, radius=7.3e-6)  # it ends beyond the radius
    run = march(Case(**impact.motion, step=impact.step), REPORT | {"brake": brake})
    for role, column in run.items():
        rows = midpoint.run(impact, scheme).rows[role == "velocity_final" :]
        assert [*column.values()] == [getattr(row, role) for row in rows]


def test_json_has_the_promised_keys_and_every_digit(tmp_path: Path) -> None:
    f = made("french", BETA_5)
    f.cells[f.where[DEPTH, 40]] = 3.7e-6  # a number over a formula
    arguments = ("check", written(f, tmp_path), "--map", "target-density=Données!C5")
    status, out, err = coldspray(*arguments, "--json")
    record = json.loads(out)
    assert (status, err) == (1, "")
    assert coldspray(*arguments) == (1, f"{text(record)}\n", "")
    assert {"differences", "summary", "first"} <= record.keys()
    keys = {"sheet", "cell", "kind", "expected", "found", "explanation"}
    assert all(keys <= entry.keys() for entry in record["differences"])
    assert {entry["kind"] for entry in record["differences"]} <= set(KINDS) == {
        "stale value", "typed number", "odd formula", "typed constant", "operation order",
        "other scheme", "other input", "unit", "printed number", "not calculated",
    }  # fmt: skip
    assert sum(record["summary"].values()) == len(record["differences"])
    first = record["first"]
    assert first in record["differences"]
    assert (first["sheet"], first["cell"]) == ("Calcul pas à pas", "G61")
    assert first["kind"] == "typed number"
    right = midpoint.run(BETA_5).rows[40]
    assert (first["found"], first["expected"]) == (3.7e-6, right.depth)
    (taken,) = record["taken"]
    assert taken["columns"].keys() <= COLUMNS.keys()
    assert taken["inputs"].keys() <= INPUTS.keys()
    assert taken["inputs"]["target_density"]["by"] == "--map"


@pytest.fixture
def emitted(record: Record, tmp_path: Path) -> Path:
    """The report's workbook, as `coldspray workbook` writes it."""
    path = tmp_path / "emitted.xlsx"
    path.write_bytes(build(record=record).to_bytes())
    return path


@pytest.mark.parametrize("saved_by", ["us", "LibreOffice"])
def test_our_own_workbook_is_clean(saved_by: str, emitted: Path, tmp_path: Path) -> None:
    if saved_by == "LibreOffice":
        usable("libreoffice")
        (emitted,) = writers.with_libreoffice([emitted], tmp_path)
    result = check(emitted)
    assert result.first is None
    sheets = {exam.table.sheet: exam for exam in result.examinations}
    assert {"Table A-1", "Sheet beta 3", "Sheet beta 5", "Sheet beta 3 coarse"} <= sheets.keys()
    for sheet in ("Sheet beta 3", "Sheet beta 5"):
        places = {name: value.place for name, value in sheets[sheet].inputs.items()}
        assert places.pop("resistance") is None
        assert {place and place[0] for place in places.values()} == {"Inputs"}


def test_our_own_workbook_without_stored_values_has_none(emitted: Path, tmp_path: Path) -> None:
    """Our workbook stores a value for every formula, also where that is an empty text."""
    load_workbook(emitted).save(tmp_path / "saved.xlsx")
    saved = check_record(check(tmp_path / "saved.xlsx"))
    assert any(d["explanation"].startswith("all 13,") for d in saved["differences"])
    assert "formulas: no value is stored" not in text(check_record(check(emitted)))
    notes = diff_record(diff(emitted, tmp_path / "saved.xlsx"))["notes"]
    assert [": for all 13," in note for note in notes] == [True]


def test_a_wrong_mass_of_our_own_workbook_is_told_once_for_each_table(emitted: Path) -> None:
    book = load_workbook(emitted)
    book["Inputs"]["F55"] = "=pi_*R_p^3*rho_p"  # which five tables read
    book.save(emitted)
    checked = check(emitted)
    record = check_record(checked)
    claims = [(claim["id"], claim["cell"]) for claim in record["claims"]]
    unmet = {
        (d["sheet"], d["cell"]): d for d in record["differences"] if d["kind"] == "printed number"
    }
    assert len(claims) == len(set(claims)) > len(unmet) == record["summary"]["printed number"] > 10
    depth = unmet["Sheet beta 3", "K22"]
    assert depth["found"] == record["final_depths"][1]["found"]  # in m, as the cell has it
    assert depth["expected"] == "10.0 um"
    excerpt, *whole = record["final_depths"]
    assert (excerpt["sheet"], excerpt["found"]) == ("Table A-1", None)
    assert record["first"]["final_depth"] is None  # nor has the excerpt one by its cause
    lines = " ".join(text(record).split())
    for table in whole:
        own = f"{table['sheet']}!{table['cells']}"
        assert lines.count(f"Inputs!F55 alone explains the final depth of {own};") == 1
    wrong = "the final depth of Sheet beta 3!D10:D157 is 8.391408 um, and should"
    assert wrong in record["verdict"]
    drawn_page = html(record, checked.differences, checked.calculation)
    items = list(sound(drawn_page).iter(f"{HTML}li"))
    assert [int(item.get("value", 0)) for item in items] == [*range(1, len(items) + 1)]
    assert len(items) == len(record["differences"])
    counts = re.findall("<h2 id=.*>.*: ([0-9]+)</h2>", drawn_page)
    assert [int(number) for number in counts] == [1, len(unmet), len(items) - 1 - len(unmet)]
    said_first = f"1 difference from the report's sheet, {len(unmet)} printed numbers not met;"
    assert record["verdict"].startswith(said_first)


def test_a_text_over_an_input_of_our_own_workbook_is_named(emitted: Path) -> None:
    """Its formulas test their inputs: none gives an error, and no table is found."""
    book = load_workbook(emitted)
    book["Inputs"]["C21"] = "three"  # the beta of some tables; the others are still found
    book.save(emitted)
    checked = check(emitted)
    first, silent = checked.first, [d for d in checked.differences if d.rank == (8,)]
    assert first is not None
    assert (first.place, first.kind, first.found) == (("Inputs", 21, 3), "typed number", "'three'")
    assert {d.kind for d in silent} == {"not calculated"}
    assert {d.place for d in silent} == {("Sheet beta 3", 10, 4), ("Sheet beta 3 coarse", 10, 4)}
    book["Inputs"]["C12"] = "eleven"
    book.save(emitted)
    with pytest.raises(ValueError, match=r"Inputs!C12 holds the text 'eleven'; .* type a number"):
        check(emitted)


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
    """Also far from the report's inputs, whose values then do not tell the unit of a number."""
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
    result = check(written(made("plain", impact, rows), tmp_path_factory.mktemp("right")))
    assert result.first is None
    assert {own.how for own in result.examinations[0].inputs.values()} <= {"label", "follows"}


# ---- hostile contents


EVIL = "</td><script>alert(1)</script>\x9b31m\u202egnp.exe"


def test_the_page_draws_the_sheet_and_no_content_reaches_it_or_the_terminal(tmp_path: Path) -> None:
    """Names, heads, labels and texts that would break a terminal or a page; and one fault."""
    f = made("table-a1", BETA_5)
    f.cells = {("Sheet<1>&'x\u202e", r, c): v for (_, r, c), v in f.cells.items()}
    sheet = next(iter(f.cells))[0]
    f.cells[sheet, 7, 4] = f"x {EVIL}"
    f.cells[sheet, 2, 1] = f"Density {EVIL}"
    f.cells[sheet, 3, 8] = EVIL
    f.cells[sheet, 60, 4] = f'=LEN("{EVIL}")'
    page, junit = tmp_path / "page.html", tmp_path / "out.xml"
    status, out, _ = coldspray("check", written(f, tmp_path), "--html", page, "--junit", junit)
    assert status == 1
    assert "\\x9b31m\\u202egnp.exe" in out
    assert all(c.isprintable() or c == "\n" for c in out)
    assert [case.get("name") for case in ET.parse(junit).getroot()] == list(KINDS)
    text = page.read_text("utf-8")
    assert "\u202e" not in text
    cells = sound(text).iter(f"{HTML}td")
    classes = [td.get("class", "") for td in cells if td.get("id")]
    assert any("origin" in names and "typed-constant" not in names for names in classes)


CONTENTS = st.one_of(
    st.none(),
    st.sampled_from([0, -1, 1e308, 5e-324, 1e15, True]),
    st.floats(allow_nan=False, allow_infinity=False),
    st.sampled_from(
        ["x", "t", "v", "R [mm]", "dt", "(m)", "=1/0", "=NA()", "=SQRT(-1)", "=1E308*10", '=""',
         "=A1", "=B4:B9", "=ROW()", "=Sheet9!A1", "=[1]S!A1", "=IF(1,2", "0,5", "µm"]
    ),
)  # fmt: skip
BASES = ("french", "table-a1", "side-by-side", "one-velocity", "printed-digits", "random-3")
EDITS = st.lists(st.tuples(st.integers(0, 9999), CONTENTS), max_size=6)


@given(name=st.sampled_from(BASES), edits=EDITS, heads=EDITS)
@example(name="random-3", edits=[(0, None), (19, 2465027.0)], heads=[])  # a step of zero
@example(
    name="french",
    edits=[(21, None), (820, 1e308), (974, -1)],  # a depth beyond doubles in um
    heads=[(205, None), (987, None)],
)
@example(name="side-by-side", edits=[(561, 5e-324)], heads=[])  # a depth without contact area
@settings(max_examples=30, deadline=None, suppress_health_check=list(HealthCheck))
def test_whatever_a_cell_holds_the_answer_is_a_record_or_one_line(
    tmp_path_factory: pytest.TempPathFactory, name: str, edits: Edits, heads: Edits
) -> None:
    f = drawn(3, BETA_5) if name == "random-3" else made(name, BETA_5)
    texts = [p for p, c in f.cells.items() if isinstance(c, str) and not c.startswith("=")]
    for places, changes in ((list(f.cells), edits), (texts, heads)):
        for at, content in changes:
            f.cells[places[at % len(places)]] = content
    path = written(f, tmp_path_factory.mktemp("fuzz"))
    message = ""
    try:
        json.dumps(check_record(check(path)), allow_nan=False)
    except ValueError as error:
        message = str(error)
    assert not message or (str(path) in message and "\n" not in message)


@kept("replication/kept.txt", "Options of diff, and the kinds of differences that they leave")
def test_options_say_what_is_compared(question: str, answer: str, tmp_path: Path) -> None:
    paths = []
    for name, formula in (("a.xlsx", "=2*B1"), ("b.xlsx", "=2*B1*(1+1E-14)")):
        f = made("table-a1", BETA_5)
        f.put("Sheet1", "B4", formula)
        paths.append(writers.with_openpyxl(f, tmp_path / name))
    status, out, err = coldspray("diff", *paths, "--json", *question.split())
    assert (status, err) == (answer != "none", "")
    assert (", ".join(json.loads(out)["summary"]) or "none") == answer


test_tolerances = calls("replication/kept.txt", "Tolerances", {"Tolerance": Tolerance})


def test_text_page_and_junit_are_those_of_check(tmp_path: Path) -> None:
    f = made("french", BETA_5)
    a = writers.with_openpyxl(f, tmp_path / "a.xlsx")
    f.put("Données", "C8", 450)
    b = writers.with_openpyxl(f, tmp_path / "b.xlsx")
    page, junit = tmp_path / "d.html", tmp_path / "d.xml"
    status, out, _ = coldspray("diff", a, b, "--html", page, "--junit", junit)
    assert status == 1
    assert "Données!C8, value\n    was 500.0, is 450.0" in out
    assert "c0-C8" in page.read_text("utf-8")
    assert all(f'name="{kind}"' in junit.read_text("utf-8") for kind in KINDS_OF_DIFF)


# What is said about some five hundred workbooks, compared with the file that a person has read

BEFORE = Path(said.__file__).with_suffix(".txt").read_text("utf-8")
DOCUMENT = (Path(__file__).parents[2] / "docs" / "check.md").read_text("utf-8")
ROWS = {name: row for rows in rates.TABLES.values() for name, row in rows.items()}


def test_the_file_has_every_section() -> None:
    heads = [line[3:] for line in BEFORE.splitlines() if line.startswith("## ")]
    assert heads == list(said.SECTIONS)


@pytest.mark.parametrize("name", said.SECTIONS)
def test_it_says_what_it_said(name: str) -> None:
    head, _, rest = said.section(name).partition("\n")
    before = BEFORE.partition(f"{head}\n")[2].partition("\n## ")[0]
    assert rest.rstrip("\n").splitlines() == before.rstrip("\n").splitlines()


@pytest.mark.slow
@pytest.mark.parametrize("name", ROWS)
def test_it_does_as_well_as_the_page_says(name: str, tmp_path: Path) -> None:
    row: Callable[[Path], rates.Row] = ROWS[name]
    if name.startswith("LibreOffice"):
        usable("libreoffice")
    line, missed = row(tmp_path)
    assert not missed
    assert line in DOCUMENT


def test_the_corpus_is_as_large_as_the_page_says() -> None:
    layouts = len(rates.workbooks("like Excel")) // 2
    assert f"{layouts} by hand" in DOCUMENT
    assert f"{len(rates.DRAWN)} drawn" in DOCUMENT
