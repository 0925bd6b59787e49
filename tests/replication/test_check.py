"""`coldspray check`: what is true of workbooks is said of them.

The truth comes from how each workbook was made; see `tests/foreign`. All go through the command.
"""

import json
from itertools import islice
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from foreign import messages, rates, writers
from foreign.built import build
from foreign.byhand import BY_HAND, made
from foreign.drawn import drawn
from foreign.edits import Case
from foreign.files import FILES, FOLDER
from foreign.layouts import DEPTH, Foreign
from foreign.rates import Known
from foreign.spoiled import SECTIONS
from foreign.strangers import draw
from foreign.truth import Truth, ask, fault, outcome, told
from foreign.words import other_impact
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from openpyxl import load_workbook
from pages import HTML, sound
from running import coldspray
from workbooks import usable

from replication.cases import BETA_5
from replication.check.responses import Item
from replication.check.units import Magnitude
from replication.models import sheet as midpoint
from replication.models.impact import Impact

Edits = list[tuple[int, object]]


def written(f: Foreign, folder: Path) -> Path:
    return writers.with_openpyxl(f, folder / f"{f.name}.xlsx")


def says(truth: Truth, path: Path, book: Foreign, **given: str) -> None:
    """Fail unless the truth is said of a workbook, and show what is said."""
    answer = ask(path, given)
    assert (outcome(truth, answer, book), told(answer)) == ("right", told(answer))


# ---- the corpus

NOT_FOUND = {
    "depths that fall, under a head in an unknown language": "tables are sought where depths grow",
    "Tabelle1!G4, Tabelle1!D35, Tabelle1!D59 of random-117": "another of the three is first",
    "Sheet!C14, Sheet!C4, Sheet!E46 of merged-heads": "another of the three is first",
    "what is called final depth, but is not": "a depth between two rows may be meant",
    "densities in two units, the mass by the wrong one": "nothing reads the right density",
}
"""What `docs/check.md` lists as not found, or not in the right place, with the reason."""


def marks_of(section: str, title: str) -> list[pytest.MarkDecorator]:
    """Slow groups; and what is not found, which must be taken from the list when it is."""
    marks = [pytest.mark.slow] * (section in ("newcomers", "tables", "arbitrary"))
    if title in NOT_FOUND:
        marks.append(pytest.mark.xfail(reason=NOT_FOUND[title], strict=True))
    return marks


CASES = [
    pytest.param(each, id=f"{section}: {each.title}", marks=marks_of(section, each.title))
    for section, cases in SECTIONS.items()
    for each in cases
]


@pytest.mark.parametrize("changed", CASES)
def test_what_was_changed_is_named_or_is_no_fault(changed: Case, tmp_path: Path) -> None:
    path = tmp_path / "book.xlsx"
    book = changed.written(path)
    says(changed.truth, path, book, **changed.given)


@pytest.mark.parametrize("name", FILES)
def test_a_kept_file_is_answered_rightly(name: str, tmp_path: Path) -> None:
    book = Foreign(name, BETA_5, {("Model", 1, 1): ""})
    says(FILES[name], FOLDER / f"{name}.xlsx", book)


def test_a_setting_that_rounds_numbers_is_named_once() -> None:
    notes = ask(FOLDER / "precision-as-displayed.xlsx").record["notes"]
    assert len([note for note in notes if "precision as displayed" in note]) == 1


@pytest.mark.parametrize("layout", BY_HAND)
def test_a_right_layout_is_clean_and_its_columns_are_known(layout: str, tmp_path: Path) -> None:
    f = made(layout, BETA_5)
    answer = ask(written(f, tmp_path))
    assert told(answer) == "0"
    columns = [table["columns"].keys() for table in answer.record["taken"]]
    roles = {role for role, _ in f.where}
    assert any(roles <= known for known in columns)


@pytest.mark.parametrize("seed", rates.DRAWN[:6])
def test_a_drawn_layout_is_clean_with_any_inputs(seed: int, tmp_path: Path) -> None:
    assert told(ask(written(drawn(seed, other_impact(seed)), tmp_path))) == "0"


@pytest.mark.parametrize("book", list(rates.other_models()), ids=lambda book: book.name)
def test_another_model_is_not_judged(book: Known, tmp_path: Path) -> None:
    says(book.truth, book.written(tmp_path / "book.xlsx"), book.book)


STRANGERS = range(20, 32)
"""Seeds of the strangers that are checked always; `rates.py` measures as many as one likes."""


@pytest.mark.parametrize("seed", STRANGERS)
def test_no_right_stranger_is_accused(seed: int, tmp_path: Path) -> None:
    """Status 2 is allowed where it says why; how often it is, `rates.py` counts."""
    (right,) = rates.strangers([seed])
    answer = ask(right.written(tmp_path / "book.xlsx"))
    assert answer.status in (0, 2), told(answer)


@pytest.mark.parametrize("seed", [
    pytest.param(20261304, id="one row tells the diameter"),
    pytest.param(20261368, id="no unit is stated"),
    pytest.param(51000094, id="the inputs beside it are another table's"),
    pytest.param(51000103, id="a force falls as the deceleration does"),
    pytest.param(53000039, id="it ends below 1 m/s, and nothing says where it should"),
    pytest.param(53000061, id="X/R grows as the depth does"),
    pytest.param(55000092, id="the units of three columns follow from each other"),
])  # fmt: skip
def test_right_numbers_without_formulas_are_clean(seed: int, tmp_path: Path) -> None:
    """Rows of strangers that were rounded to a few digits and pasted, with some inputs or none."""
    right = build(draw(seed, pasted=True))
    assert right is not None
    assert told(ask(written(right.book, tmp_path))) == "0"


def test_the_units_of_a_product_are_in_the_order_of_its_factors() -> None:
    """Of units that nobody states the first that fit are taken: on every run the same."""
    names = ("time", "depth", "velocity_initial", "deceleration", "velocity_final")
    items: list[Item] = [("column", name) for name in names]
    product = Magnitude(0.0)
    for item in items:
        product *= Magnitude(0.0, {item: 1.0})
    assert list(product.units) == items


@pytest.mark.slow
@pytest.mark.parametrize("group", rates.GROUPS)
def test_no_right_workbook_of_a_group_is_accused(group: str, tmp_path: Path) -> None:
    assert rates.measured(rates.right_ones(group), tmp_path).wrong == []


@pytest.mark.slow
@pytest.mark.parametrize("program", rates.WRITERS)
def test_it_does_not_matter_which_program_saved_a_workbook(program: str, tmp_path: Path) -> None:
    if program.startswith("LibreOffice"):
        usable("libreoffice")
    assert rates.saved_by(program, tmp_path).wrong == []


@pytest.mark.slow
@pytest.mark.parametrize("fault", rates.FAULTS)
def test_a_fault_planted_in_layouts_is_named_and_placed(fault: str, tmp_path: Path) -> None:
    """In those by hand, of the report's case, and in some that are drawn."""
    assert rates.measured(rates.planted("layouts by hand", [fault]), tmp_path).wrong == []


@pytest.mark.slow
def test_faults_of_strangers_are_placed_as_often_as_the_page_says(tmp_path: Path) -> None:
    """The lower end of the 95 % interval of a sample is at least 80 %, and no right one accused."""
    right = rates.measured(rates.strangers(range(1000, 1060)), tmp_path)
    assert right.counts["accused"] + right.counts["traceback"] == 0
    tally = rates.measured(islice(rates.spoiled_strangers(range(1000, 1120), 2), 200), tmp_path)
    placed = tally.counts["right"] + tally.counts["misnamed"]
    assert rates.interval(placed, tally.total)[0] >= 0.8, "\n".join(tally.wrong)


# ---- what is said


def test_messages_are_those_that_a_person_has_read() -> None:
    """`python tests/foreign/messages.py > tests/foreign/messages.txt` writes them anew."""
    said = "\n".join(messages.all_of_them()).rstrip("\n")
    assert said == messages.KEPT.read_text("utf-8").rstrip("\n")


def test_json_has_the_promised_keys_and_every_digit(tmp_path: Path) -> None:
    f = made("french", BETA_5)
    f.cells[f.where[DEPTH, 40]] = 3.7e-6  # a number over a formula
    arguments = ("check", written(f, tmp_path), "--map", "target-density=Données!C5")
    status, out, err = coldspray(*arguments, "--json")
    record = json.loads(out)
    assert (status, err) == (1, "")
    assert {"differences", "summary", "first"} <= record.keys()
    keys = {"sheet", "cell", "kind", "expected", "found", "explanation"}
    assert all(keys <= entry.keys() for entry in record["differences"])
    assert {entry["kind"] for entry in record["differences"]} <= {
        "stale value", "typed number", "odd formula", "typed constant", "other scheme",
        "other input", "unit", "printed number", "not calculated",
    }  # fmt: skip
    assert sum(record["summary"].values()) == len(record["differences"])
    first = record["first"]
    assert first in record["differences"]
    assert (first["sheet"], first["cell"]) == ("Calcul pas à pas", "G61")
    assert first["kind"] == "typed number"
    right = midpoint.run(BETA_5).rows[40]
    assert (first["found"], first["expected"]) == (3.7e-6, right.depth)


def test_the_verdict_is_the_first_line_and_the_first_fault_the_next(tmp_path: Path) -> None:
    f = made("french", BETA_5)
    f.cells[f.where[DEPTH, 40]] = 3.7e-6
    path = written(f, tmp_path)
    record = json.loads(coldspray("check", path, "--json")[1])
    lines = [line for line in coldspray("check", path)[1].splitlines() if line.strip()]
    assert record["verdict"] in lines[0]
    assert any("G61" in line for line in lines[:4])


# ---- our own workbook


@pytest.fixture
def emitted(our_own: bytes, tmp_path: Path) -> Path:
    """The report's workbook as a file, which a test may change."""
    path = tmp_path / "emitted.xlsx"
    path.write_bytes(our_own)
    return path


@pytest.mark.parametrize("saved_by", ["us", pytest.param("LibreOffice", marks=pytest.mark.slow)])
def test_our_own_workbook_is_clean(saved_by: str, emitted: Path, tmp_path: Path) -> None:
    if saved_by == "LibreOffice":
        usable("libreoffice")
        (emitted,) = writers.with_libreoffice([emitted], tmp_path)
    answer = ask(emitted)
    assert told(answer) == "0"
    sheets = {table["sheet"] for table in answer.record["taken"]}
    assert {"Table A-1", "Sheet beta 3", "Sheet beta 5", "Sheet beta 3 coarse"} <= sheets


@pytest.mark.slow
def test_our_own_workbook_without_stored_values_is_said_to_have_none(
    emitted: Path, tmp_path: Path
) -> None:
    """Our workbook stores a value for every formula, also where that is an empty text."""
    load_workbook(emitted).save(tmp_path / "saved.xlsx")
    saved, ours = (
        [d for d in ask(path).record["differences"] if "no value is stored" in d["explanation"]]
        for path in (tmp_path / "saved.xlsx", emitted)
    )
    assert [d["kind"] for d in saved] == ["not calculated"]
    assert ours == []


def test_a_wrong_mass_of_our_own_workbook_is_the_first_fault(emitted: Path) -> None:
    book = load_workbook(emitted)
    book["Inputs"]["F55"] = "=pi_*R_p^3*rho_p"  # which five tables read
    book.save(emitted)
    answer = ask(emitted)
    first = answer.first
    assert (first["sheet"], first["cell"], first["kind"]) == ("Inputs", "F55", "odd formula")
    named = [(d["sheet"], d["cell"]) for d in answer.record["differences"]]
    assert named.count(("Inputs", "F55")) == 1


@pytest.mark.parametrize(("cell", "text"), [
    pytest.param("C21", "three", id="the beta of some tables"),
    pytest.param("C12", "eleven", id="the radius of all", marks=pytest.mark.slow),
])  # fmt: skip
def test_a_text_over_an_input_of_our_own_workbook_is_named(
    cell: str, text: str, emitted: Path
) -> None:
    """Its formulas test their inputs: none gives an error, and tables show nothing."""
    book = load_workbook(emitted)
    book["Inputs"][cell] = text
    book.save(emitted)
    truth = fault("typed number", f"Inputs!{cell}", or_refused=True)
    says(truth, emitted, Foreign("our own", BETA_5))


# ---- any inputs, any contents


@pytest.mark.parametrize("seed", range(6))
def test_a_right_sheet_of_other_inputs_is_clean(seed: int, tmp_path: Path) -> None:
    """Also far from the report's inputs, whose values then do not tell the unit of a number."""
    assert told(ask(written(made("plain", other_impact(seed)), tmp_path))) == "0"


@pytest.mark.parametrize("inputs", [
    pytest.param({"velocity": 500, "radius": 11e-6, "step": 4e-12}, id="4 ps"),
    pytest.param({"velocity": 100, "radius": 11e-5, "step": 8.8e-9}, id="a light sphere"),
])  # fmt: skip
def test_an_excerpt_of_twenty_rows_is_clean(inputs: dict[str, float], tmp_path: Path) -> None:
    impact = Impact(particle_density=8000, target_density=2000, beta=1.5, flow_stress=3e8, **inputs)
    assert told(ask(written(made("plain", impact, 20), tmp_path))) == "0"


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
    assert "x\\u202e'!D" in out  # the sheet's name
    assert all(c.isprintable() or c == "\n" for c in out)
    kinds = [case.get("name") for case in ET.parse(junit).getroot()]
    assert {"stale value", "typed number", "odd formula", "unit"} <= set(kinds)
    text = page.read_text("utf-8")
    assert "\u202e" not in text
    cells = sound(text).iter(f"{HTML}td")
    assert any(td.get("id", "").endswith("-D60") for td in cells)


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
@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
def test_whatever_a_cell_holds_the_answer_is_a_record_or_one_line(
    tmp_path_factory: pytest.TempPathFactory, name: str, edits: Edits, heads: Edits
) -> None:
    f = drawn(3, BETA_5) if name == "random-3" else made(name, BETA_5)
    texts = [p for p, c in f.cells.items() if isinstance(c, str) and not c.startswith("=")]
    for places, changes in ((list(f.cells), edits), (texts, heads)):
        for at, content in changes:
            f.cells[places[at % len(places)]] = content  # type: ignore[assignment]
    path = written(f, tmp_path_factory.mktemp("fuzz"))
    answer = ask(path)
    assert bool(answer.record) == (answer.status in (0, 1))
    assert not answer.line or (str(path) in answer.line and "\n" not in answer.line)


# ---- the page of the manual

DOCUMENT = (Path(__file__).parents[2] / "docs" / "check.md").read_text("utf-8")


def test_the_manual_has_the_tables_that_are_measured() -> None:
    assert rates.RIGHT in DOCUMENT
    assert rates.FAULTY in DOCUMENT
