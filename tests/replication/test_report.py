"""The audit's record and files are complete, exact, reproducible and accessible."""

import csv
import io
import json
import os
import pickle
import re
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction as F
from hashlib import sha256
from importlib import metadata
from itertools import pairwise
from math import inf, nextafter
from pathlib import Path
from statistics import NormalDist
from xml.etree import ElementTree as ET

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace as change
from pages import HTML, SVG, sound

from reference.arithmetic import Floats
from reference.equations import evaluate, read_expression
from reference.ledger import Ledger, load
from reference.printed import Interval, parse
from replication import report
from replication import text as texts
from replication.audit import comparison
from replication.audit.audit import LIBRARIES, Audit, provenance
from replication.audit.findings import findings_on
from replication.audit.inference import DENSITY
from replication.audit.record import Record
from replication.audit.remarks import figures
from replication.audit.results import Results
from replication.cases import BETA_5
from replication.models.depth import final_depth
from replication.report import contents, html
from replication.report.document import (
    audit_document,
    claim_document,
    equation_document,
    schema_text,
)
from replication.report.figures import draw_figures
from replication.report.prose import HTML as PAGE
from replication.report.prose import MARKDOWN, TERMINAL, Named, Prose
from replication.report.tables import explanation_tables, main_results
from replication.report.words import (
    ABOUT_SENSITIVITY,
    ABOUT_SOURCES,
    CONVENTIONS,
    USUAL_CONDITIONS,
    approaches_in_words,
    blank_cells,
    counted_briefly,
    if_choices_are_rounded,
    inferred,
    names_of,
    scatter_in_words,
)
from replication.text import json_text
from spreadsheets.styles import CURVES

LEDGER = load()
SCHEMA = json.loads(schema_text())


def test_the_record_is_what_its_schema_says_and_nothing_less(record: Record) -> None:
    document = json.loads(json_text(audit_document(record)))
    validator = jsonschema.Draft202012Validator(SCHEMA)
    validator.validate(document)
    small = {**document, "claims": [], "curves": [], "findings": [], "ladders": []}
    validator.validate(small)
    for key in small:
        assert not validator.is_valid({k: v for k, v in small.items() if k != key}), key
    claim = document["claims"][0]
    spoiled = [{k: v for k, v in claim.items() if k != key} for key in claim]
    spoiled += [{**claim, key: True} for key in claim]  # no key holds a bool
    spoiled += [{**claim, "unknown": 1}, {**claim, "verdict": "maybe"}]
    for wrong in spoiled:
        assert not validator.is_valid({**small, "claims": [wrong]}), wrong


def test_one_claim_and_one_equation_are_those_of_the_whole_audit(record: Record) -> None:
    fresh = Audit(LEDGER)
    whole = audit_document(record)
    claims, equations = (
        {entry["id"]: entry for entry in whole[part]} for part in ("claims", "equations")
    )
    assert claim_document(fresh.claim("frank-zook-rha")) == claims["frank-zook-rha"]
    assert equation_document(fresh.equation("eq16")) == equations["eq16"]
    for unknown in (fresh.claim, fresh.equation):
        with pytest.raises(KeyError):
            unknown("eq17")


def test_a_record_can_be_pickled(record: Record) -> None:
    again = pickle.loads(pickle.dumps(record))
    assert audit_document(again) == audit_document(record)


def test_the_schema_describes_every_object_in_lines_without_an_indent() -> None:
    for name, part in SCHEMA["$defs"].items():
        assert part["title"] == name
        assert part["description"] == " ".join(part["description"].split())


def test_an_equation_for_a_terminal(audit: Audit) -> None:
    text = report.equation_proof(
        audit.equation("eq16"), findings_on(audit, "eq16"), audit.judge, 100
    )
    lines = text.splitlines()
    assert lines[:3] == [
        "Eq. 16, depth by Frank and Zook (eq16)",
        "section 3, line 137, Eq. 16: not reproduced",
        "X/R = ((L/D ρₚ/ρₜ + k₁)/2kt)ln(1+kₜ ρₜ V²/Rₜ)",
    ]
    assert any(
        re.fullmatch(r"2 before kₜ in Eq\. 16 \(eq16-denominator\) +2 +not reproduced +1", line)
        for line in lines
    )
    assert lines[-1] == "  Eq. 16 prints 2 kₜ; for X/R it must be kₜ"


def test_a_library_that_is_not_installed_is_left_out_of_the_provenance(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """An audit in a browser has no library that writes workbooks."""
    installed = metadata.version

    def version(name: str) -> str:
        if name == "XlsxWriter":
            raise metadata.PackageNotFoundError(name)
        return installed(name)

    monkeypatch.setattr(metadata, "version", version)
    assert provenance()["versions"].keys() == {*LIBRARIES} - {"XlsxWriter"}


def arithmetic(text: str) -> float:
    """Evaluate arithmetic as it is typeset on the page."""
    raised = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")

    def in_brackets(number: re.Match[str]) -> str:
        return f"({number[1]} × 10^{{{number[2].translate(raised)}}})"

    text = re.sub(r"([\d.]+)×10([⁰¹²³⁴⁵⁶⁷⁸⁹]+)", in_brackets, text)
    text = re.sub(r"\^([\d.]+)", r"^{\1}", text).replace("ln", r"\ln")
    return float(evaluate(read_expression(text, {}), Floats(), {}))


def test_every_line_by_hand_is_calculated_again(record: Record) -> None:
    by_hand = [claim.worked.by_hand.removesuffix(".") for claim in record.claims if claim.worked]
    lines = [line for text in by_hand for line in text.split("; ")]
    assert len(lines) == 6
    for line in lines:
        left, _, right = line.rpartition(" = ")
        value = F(arithmetic(left))
        # The last line of each claim multiplies numbers that were rounded to five digits.
        slack = value / 10**4 if line in (lines[2], lines[5]) else 0
        assert parse(right).interval().meets(Interval(value - slack, value + slack)), line


def test_a_cell_of_table_a_1_that_fails_is_not_called_blank() -> None:
    ledger = LEDGER.misprint("a1-depth-1", "56.00E-08")
    record = Audit(ledger, every_convention=False).record()
    page = contents(record, {})["audit.html"].decode()
    table = page.partition("Rows of Table A-1")[2].partition("</table>")[0]
    assert re.findall("<td>(.*?)</td>", table) == ["blank", "above"]


def lacking(name: str, text: str) -> Counter[str]:
    """What an audit can compute besides the verdicts, but not with this misprint."""
    return computed_of(LEDGER) - computed_of(LEDGER.misprint(name, text))


def computed_of(ledger: Ledger) -> Counter[str]:
    """Count what is computed of a ledger besides the verdicts."""
    results = Results(ledger, every_convention=False)
    remark = ledger.claims["coarse-step-remark"]
    return Counter({
        "approaches": sum(a.computed is not None for a in comparison.approaches(results)),
        "figures": sum(figure.value is not None for figure in figures(results, remark)),
        "effects": sum(len(case.stated) for case in comparison.sensitivity(results)),
        "scatter": len(comparison.scatter(results)),
        "curves": len(comparison.curves(results)),
        "velocities": len(comparison.velocity_curve(results).velocity),
        "ladders": len(comparison.ladders(results)),
    })  # fmt: skip


@pytest.mark.parametrize(
    ("name", "text", "missing"),
    [
        (
            "a1-initial-velocity", "0",
            {"approaches": 6, "figures": 12, "effects": 12, "scatter": 3, "curves": 2,
             "ladders": 28},
        ),
        ("coarse-step", "0", {"figures": 8}),
        ("mean-diameter", "2", {"scatter": 2}),
        ("velocity-deviation", "500", {"effects": 2, "scatter": 1}),
        ("volume-ratio-line", "0.68", {"approaches": 1}),
        ("beta-range-least", "0", {"effects": 2}),
        ("figure-5-velocity-least", "0", {"velocities": 1}),
    ],
)  # fmt: skip
def test_what_inputs_without_a_meaning_leave_uncomputed(
    name: str, text: str, missing: dict[str, int]
) -> None:
    assert lacking(name, text) == missing


@pytest.mark.parametrize(
    ("misprints", "drawings"),
    [
        ({"a1-initial-velocity": "0"}, {"comparison", "figure-5"}),
        (
            {"coarse-step": "0", "mean-diameter": "2", "velocity-deviation": "500",
             "volume-ratio-line": "0.68", "beta-range-least": "0", "figure-5-velocity-least": "0"},
            {"comparison", "sensitivity", "figure-3", "figure-5", "convergence"},
        ),
    ],
    ids=["velocity", "others"],
)  # fmt: skip
def test_inputs_without_a_meaning_end_no_audit(
    misprints: dict[str, str], drawings: set[str]
) -> None:
    ledger: Ledger = LEDGER
    for name, text in misprints.items():
        ledger = ledger.misprint(name, text)
    spoiled = Audit(ledger, every_convention=False).record()
    assert draw_figures(spoiled).keys() == drawings
    files = contents(spoiled, {})
    sound(files["audit.html"].decode())
    jsonschema.validate(json.loads(files["audit.json"]), SCHEMA)


def test_a_misprint_that_fails_by_another_equation_shows_that_equation() -> None:
    """Eq. 11 alone gives alpha, but beta takes two equations: no single one shows it."""
    spoiled = Audit(LEDGER.misprint("yield-strength", "251"), every_convention=False)
    alpha, beta = (spoiled.claim(f"walker-anderson-{name}") for name in ("alpha", "beta"))
    assert alpha.verdict == beta.verdict == "not reproduced"
    assert alpha.worked is not None
    by_hand = alpha.worked.by_hand.removesuffix(".").rpartition(" = ")[0]
    assert arithmetic(by_hand) == pytest.approx(alpha.computed, rel=1e-3)
    assert beta.worked is None


@pytest.mark.slow
def test_an_audit_elsewhere_has_the_same_bytes(tmp_path: Path) -> None:
    folders = []
    for environment in (
        {"PYTHONHASHSEED": "0", "TZ": "UTC", "LC_ALL": "C", "OMP_NUM_THREADS": "1"},
        {"PYTHONHASHSEED": "7", "TZ": "Asia/Kathmandu", "LC_ALL": "C.UTF-8", "PYTHONOPTIMIZE": "1"},
    ):
        folder = tmp_path / environment["PYTHONHASHSEED"]
        folder.mkdir()
        command = [sys.executable, "-m", "replication", "audit", "--quiet", "--out", "out"]
        subprocess.run(command, cwd=folder, env={**os.environ, **environment}, check=True)
        folders.append({str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*.*")})
    first, second = folders
    assert "out/audit.json" in first
    assert {path for path in {*first, *second} if first.get(path) != second.get(path)} == set()


# Scatter of the particles, and the curve of Figure 5


def test_quantiles_of_each_law(record: Record) -> None:
    laws = {law.law.partition(":")[0]: law for law in record.scatter}
    sizes = NormalDist(22, 5.6)
    for law, power in (("Eq. 1", 1.5), ("drag on a sphere", 0.5)):
        points = laws[law]
        sized = [500 * (22 / sizes.inv_cdf(1 - share)) ** power for share in points.shares]
        assert points.velocities == pytest.approx(sized, rel=1e-14)
        impacts = [replace(BETA_5, velocity=v) for v in points.velocities]
        assert points.ratios == [final_depth(**i.motion) / i.radius for i in impacts]
        near = 22 - 1e-4, 22 + 1e-4  # to differentiate the law numerically at the mean size
        faster, slower = (500 * (22 / size) ** power for size in near)
        slope = (faster - slower) / (near[1] - near[0])
        assert laws[law].standard_deviation == pytest.approx(slope * 5.6, rel=1e-9)


def test_figure_5_is_drawn_from_end_to_end(record: Record) -> None:
    drawn = record.velocity_curve.velocity
    ends = [float(LEDGER.value(f"figure-5-velocity-{end}")) for end in ("least", "greatest")]
    assert [drawn[0], drawn[-1]] == ends


# The files

MATH = "{http://www.w3.org/1998/Math/MathML}math"
BESIDE = {"workbook.xlsx": b"PK"}


@pytest.fixture(scope="module")
def files(record: Record) -> dict[str, bytes]:
    return contents(record, BESIDE)


@pytest.fixture(scope="module")
def root(files: dict[str, bytes]) -> ET.Element:
    return sound(files["audit.html"].decode())


def by_id(root: ET.Element, name: str) -> ET.Element:
    (element,) = (e for e in root.iter() if e.get("id") == name)
    return element


def words(element: ET.Element) -> str:
    return " ".join("".join(element.itertext()).split())


def standing_open(element: ET.Element) -> Iterator[str]:
    """Yield the texts of an element that a reader sees without unfolding anything."""
    folded = element.tag == f"{HTML}details" and element.get("open") is None
    if element.tag in (f"{SVG}title", f"{SVG}desc"):
        return
    if element.text and not folded:
        yield element.text
    for child in element:
        if not folded or child.tag == f"{HTML}summary":
            yield from standing_open(child)
        if child.tail and not folded:
            yield child.tail


def test_fewer_than_ten_thousand_words_stand_open(root: ET.Element) -> None:
    """What proves, lists or repeats is folded; a third more stood open before it was."""
    (header,), (main,) = root.iter(f"{HTML}header"), root.iter(f"{HTML}main")
    open_words = " ".join((*standing_open(header), *standing_open(main))).split()
    assert 5_000 < len(open_words) < 10_000
    assert len(words(main).split()) < 22_500


def test_the_answer_stands_together_and_what_fails_comes_first(
    root: ET.Element, record: Record
) -> None:
    (first,) = (e for e in root.iter() if e.get("class") == "first")
    ids = [e.get("id") for e in first.iter() if e.get("id") in ("failing", "main-results")]
    assert ids == ["failing", "main-results"]
    assert len(list(first.iter(f"{SVG}svg"))) == 1
    assert "The 6 main results: reproduced" in words(first)
    for name in ("depth-beta-3", "depth-beta-5", "frank-zook-rha", "frank-zook-stainless"):
        assert record.claim(name).claim.text in words(first)


def test_the_page_leads_with_what_could_have_failed(root: ET.Element, record: Record) -> None:
    (summary,) = (e for e in root.iter(f"{HTML}section") if e.get("id") == "summary")
    assert words(summary).startswith(f"Summary {counted_briefly(record.counts)} ")


def test_the_x_r_of_a_slip_is_at_the_density_that_is_assumed(record: Record) -> None:
    names = names_of(record)
    elsewhere = {**names, DENSITY: names[DENSITY]._replace(value="7900 kg/m^3")}
    for name in ("frank-zook-rha", "frank-zook-stainless"):
        slips, moved = (
            explanation_tables(record.claim(name), known)[-1] for known in (names, elsewhere)
        )
        assert (slips.heads[2], moved.heads[2]) == ("X/R at 7850 kg/m³", "X/R at 7900 kg/m^3")


def test_how_many_densities_of_public_sources_table_a_1_admits(record: Record) -> None:
    low, high = record.inferred[0].interval
    values = [float(source.value) for source in LEDGER.sources_of(DENSITY)]
    admitted = sum(low <= value <= high for value in values)
    sentence = (
        f"Of the {len(values)} values that public sources print, Table A-1 admits {admitted} "
        "without a further condition."
    )
    assert inferred(record.inferred).endswith(sentence)


def test_what_the_report_states_of_the_scatter(record: Record) -> None:
    assert scatter_in_words(record).startswith(
        "The report states the standard deviation of the particle diameter, 5.6 µm, and the mean "
        "deviation of the particle velocity, about 50 m/s."
    )


def test_page_and_markdown_say_what_a_section_is_about(
    files: dict[str, bytes], record: Record
) -> None:
    sentences = (
        CONVENTIONS, USUAL_CONDITIONS, ABOUT_SENSITIVITY, ABOUT_SOURCES, blank_cells(record),
        scatter_in_words(record), approaches_in_words(record),
    )  # fmt: skip
    for form, name in ((PAGE, "audit.html"), (MARKDOWN, "audit.md")):
        prose, text = Prose(form, record.symbols, names_of(record)), files[name].decode()
        assert [sentence for sentence in sentences if prose(sentence) not in text] == []


def test_a_ratio_of_the_printed_depth_says_so(record: Record) -> None:
    """The depth above it is 7.66956 um, of which X/R would be 0.697232 and not 7.67/11."""
    rows = {head: computed for head, _, computed in main_results(record).rows}
    assert rows["X/R, beta = 5, from the printed 7.67 µm"] == f"{7.67 / 11:.6f}"


def test_a_single_number_that_comes_out_is_one(record: Record) -> None:
    assert ", this comes out: 0.297 as derived from" in if_choices_are_rounded(record)


def test_one_color_and_mark_for_each_case_in_every_figure(files: dict[str, bytes]) -> None:
    for name in ("comparison", "figure-3", "convergence"):
        drawing = files[f"figures/{name}.svg"].decode()
        assert all(f'fill="{look.color}"' in drawing for look in CURVES.values()), name
    comparison = ET.fromstring(files["figures/comparison.svg"])
    drawn = Counter((e.tag, e.get("fill")) for e in comparison.iter())
    # Three approaches and the legend; the marks are a circle and a square.
    assert drawn[f"{SVG}circle", CURVES["3"].color] == 4
    assert drawn[f"{SVG}rect", CURVES["5"].color] == 4


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("chromium") is None, reason="needs the browser chromium")
def test_the_first_screen_has_the_answer(files: dict[str, bytes], tmp_path: Path) -> None:
    """Both tables and the whole figure on 1280 x 800; what fails on a telephone."""
    sync_api = pytest.importorskip("playwright.sync_api")
    page_file = tmp_path / "audit.html"
    page_file.write_bytes(files["audit.html"])
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"))
        for width, height, ends in (
            (1280, 800, ("#summary table:has(#main-results)", "#summary svg")),
            (375, 812, ("#summary table:has(#failing)",)),
        ):
            page = browser.new_page(viewport={"width": width, "height": height})
            page.goto(page_file.as_uri())
            for selector in ends:
                box = page.locator(selector).first.bounding_box()
                assert box["y"] + box["height"] <= height, selector
                assert box["x"] + box["width"] <= width, selector
        browser.close()


def test_headings_landmarks_tables_and_pictures_are_named(root: ET.Element) -> None:
    assert next(root.iter(f"{HTML}html")).get("lang") == "en"
    heads = [e.tag for e in root.iter() if re.fullmatch(rf"{re.escape(HTML)}h[1-6]", e.tag)]
    levels = [int(tag[-1]) for tag in heads]
    assert (levels[0], levels.count(1)) == (1, 1)
    assert all(after <= before + 1 for before, after in pairwise(levels))
    assert all(len(list(root.iter(f"{HTML}{tag}"))) == 1 for tag in ("header", "nav", "main"))
    for table in root.iter(f"{HTML}table"):
        assert table.find(f"{HTML}caption") is not None
        assert all(head.get("scope") for head in table.iter(f"{HTML}th"))
    for picture in root.iter(f"{SVG}svg"):
        assert picture.get("role") == "img"
        assert all(picture.findtext(f"{SVG}{part}") for part in ("title", "desc"))


def test_everything_stands_on_the_page_once(root: ET.Element, record: Record) -> None:
    ids = {e.get("id") for e in root.iter()}
    assert {f"claim-{claim.id}" for claim in record.claims} <= ids
    assert {f"finding-{finding.id}" for finding in record.findings} <= ids
    assert {f"equation-{equation.id}" for equation in record.equations} <= ids
    for claim in record.claims:
        if claim.as_printed is not None and not claim.claim.cell:
            text = words(by_id(root, f"claim-{claim.id}"))
            assert claim.as_printed.reference in text
            straight = text.replace("\xa0", " ").translate(str.maketrans("’“”", '\'""'))
            usual = not any(reading.otherwise for reading in claim.assessment.readings[:1])
            assert (claim.scope.removesuffix(".") in straight) == (
                claim.verdict.needs_explanation or not usual
            )
    targets = {a.get("href") for a in by_id(root, "sources").iter(f"{HTML}a")}
    compared = {c.source.address for claim in record.claims for c in claim.sources}
    assert compared <= targets


def test_what_fails_can_be_checked_by_hand(root: ET.Element, record: Record) -> None:
    failing = [claim for claim in record.claims if claim.verdict.needs_explanation]
    assert {"frank-zook-rha", "frank-zook-stainless", "eq16-denominator"} <= {c.id for c in failing}
    summary = words(by_id(root, "summary"))
    for claim in failing:
        card = by_id(root, f"claim-{claim.id}")
        assert list(card.iter(MATH))
        assert "By hand." in words(card)
        for solved in claim.back_solved:
            assert f"{solved.title} " in words(card).replace("’", "'") or "_" in solved.title
    assert all(text in summary for text in ("0.127", "0.255", "0.150", "0.300"))


def test_the_answer_comes_first_in_files_and_last_on_a_terminal(
    root: ET.Element, files: dict[str, bytes], record: Record
) -> None:
    start = words(next(root.iter(f"{HTML}header"))).replace("’", "'").replace("\xa0", " ")
    for text in (start, files["audit.md"].decode()):
        assert record.headline in text[:500]
    assert report.summary(record, 1000).endswith(f"\n{record.headline}")


def test_symbols_are_typeset(files: dict[str, bytes], root: ET.Element, record: Record) -> None:
    for element in root.iter():
        if element.tag in (f"{HTML}q", f"{HTML}code"):  # sources as printed, and names of cells
            element.clear()
    (body,) = root.iter(f"{HTML}body")
    for text in (words(body), files["audit.md"].decode(), report.summary(record, 80)):
        assert "\\" not in text
        plain = re.sub(r"`[^`]*`", "", text)
        assert not re.search(r"\b(?:rho|beta|alpha|Sigma)\b|[A-Za-z]_[a-z1]\b|\^\d| \* ", plain)


def test_a_text_of_the_ledger_cannot_become_markup(record: Record) -> None:
    hostile = "<script>alert(1)</script>"
    claims = [change(c, claim=change(c.claim, title=hostile)) for c in record.claims]
    assert hostile not in html(change(record, claims=claims), draw_figures(record))


def test_figures_take_ink_and_paper_of_the_page(files: dict[str, bytes]) -> None:
    drawn = {name: text.decode() for name, text in files.items() if name.startswith("figures/")}
    assert len(drawn) == 5
    shown = Path(__file__).parents[2] / "docs" / "comparison.svg"  # shown in the README
    assert shown.read_text("utf-8") == drawn["figures/comparison.svg"]
    for text in drawn.values():
        assert text.strip() in files["audit.html"].decode()
        root = ET.fromstring(text)
        assert root.get("fill") == "currentColor"
        assert "#000000" not in text
        assert not [e for e in root.iter() if "style" in e.attrib or e.tag == f"{SVG}style"]


@pytest.mark.parametrize(
    ("name", "words"),
    [
        (
            "comparison",
            "0 | 0.2 | 0.4 | 0.6 | 0.8 | 1 | Normalized depth X/R | sheet: β = 3 | sheet: β ="
            " 5 | exact: β = 3 | exact: β = 5 | constant pressure: β = 3 | constant pressure:"
            " β = 5 | Frank-Zook: armor, | Eq. 16 as printed | Frank-Zook: armor, | Eqs. 14 "
            "and 15 | Frank-Zook: stainless steel, | Eq. 16 as printed | Frank-Zook: "
            "stainless steel, | Eqs. 14 and 15 | hydrocode: CTH | hydrocode: Autodyne | "
            "computed, β = 3 | computed, β = 5 | computed, Frank and Zook | hollow: as the report "
            "prints or quotes it | observed, 0.293 to 0.298",
        ),
        (
            "sensitivity",
            "6 | 7 | 8 | 9 | 10 | Depth X [µm] | radius | 8.2 to 13.8 µm | β | 3 to 5 | "
            "velocity | 450 to 550 m/s | flow stress | 675.6 to 758.5 MPa | target density | "
            "7759 to 7925 kg/m³ | particle density | 8895 to 8905 kg/m³ | −1.954 | +1.954 | "
            "+2.365 | −0.798 | +0.805 | +0.143 | −0.314 | +0.006 | −0.005 | −0.003 | +0.003 |"
            " input at its low end | at its high end | change [µm]",
        ),
        (
            "figure-3",
            "0 | 10 | 20 | 30 | 40 | 0 | 2 | 4 | 6 | 8 | 10 | Time [ns] | Penetration depth "
            "[µm] | 10.0307 µm, | printed 10.0 | 7.6696 µm, | printed 7.67 | exact | the "
            "sheet, every eighth row, β = 3 | the sheet, every eighth row, β = 5",
        ),
        (
            "figure-5",
            "400 | 420 | 440 | 460 | 480 | 500 | 0 | 0.1 | 0.2 | 0.3 | 0.4 | 0.5 | 0.6 | 0.7 "
            "| 0.8 | Impact velocity [m/s] | Normalized depth X/R | exact | the sheet, β = 5 "
            "| observed, 0.298",
        ),
        (
            "convergence",
            "0.05 | 0.1 | 0.2 | 0.4 | 0.8 | 1.6 | 3.2 | 0.01 | 0.1 | 1 | 10 | 100 | Time step"
            " [ns] | Error of the final depth [nm] | drag at the initial velocity, β = 3 | "
            "drag at the middle velocity, β = 3 | drag at the initial velocity, β = 5 | drag "
            "at the middle velocity, β = 5",
        ),
    ],
)
def test_what_the_figures_say(name: str, words: str, files: dict[str, bytes]) -> None:
    root = ET.fromstring(files[f"figures/{name}.svg"])
    assert " | ".join(str(text.text) for text in root.iter(f"{SVG}text")) == words


def points(element: ET.Element) -> list[tuple[float, float]]:
    """The ends of what an element of an SVG draws; of a text and a circle its place."""
    at = element.attrib
    if element.tag == f"{SVG}polyline":
        return [(float(x), float(y)) for x, y in (p.split(",") for p in at["points"].split())]
    x, y = float(at.get("x", at.get("cx", 0))), float(at.get("y", at.get("cy", 0)))
    return [(x, y), (x + float(at.get("width", 0)), y + float(at.get("height", 0)))]


@pytest.mark.parametrize(
    ("name", "axis", "legend"),
    [
        ("comparison", "Normalized depth X/R", "computed, β = 3"),
        ("sensitivity", "Depth X [µm]", "input at its low end"),
        ("figure-3", "", ""),
        ("figure-5", "", ""),
        ("convergence", "Time step [ns]", "drag at the initial velocity, β = 3"),
    ],
)
def test_all_is_drawn_within_the_figure_and_a_legend_not_over_the_bars(
    name: str, axis: str, legend: str, files: dict[str, bytes]
) -> None:
    root = ET.fromstring(files[f"figures/{name}.svg"])
    width, height = float(root.attrib["width"]), float(root.attrib["height"])
    for element in root:
        for x, y in points(element):
            assert (0 <= x <= width, 0 <= y <= height) == (True, True), element.attrib
    down = {str(text.text): float(text.attrib["y"]) for text in root.iter(f"{SVG}text")}
    if legend:
        assert down[legend] > down[axis]


def test_the_middle_velocity_has_dashed_lines_and_hollow_marks(files: dict[str, bytes]) -> None:
    """So that the two schemes differ in gray; the marks of the report's own are filled."""
    root = ET.fromstring(files["figures/convergence.svg"])
    shapes = [*root.iter(f"{SVG}circle"), *root.iter(f"{SVG}rect")]
    hollow = {center(shape) for shape in shapes if shape.get("fill") == "none"}
    legend = [text for text in root.iter(f"{SVG}text") if str(text.text).startswith("drag")]
    assert len(legend) == 4
    for text in legend:
        ((x, y), _) = points(text)
        assert ((x - 15, y - 4) in hollow) == ("middle" in str(text.text))
    for line in root.iter(f"{SVG}polyline"):
        assert {point in hollow for point in points(line)} == {
            line.get("stroke-dasharray") is not None
        }


def center(shape: ET.Element) -> tuple[float, float]:
    """The center of a circle or a square of an SVG, to the decimals that it prints."""
    if shape.tag == f"{SVG}circle":
        return float(shape.attrib["cx"]), float(shape.attrib["cy"])
    half = float(shape.get("width", 0)) / 2
    return float(shape.get("x", 0)) + half, float(shape.get("y", 0)) + half


@pytest.mark.skipif(shutil.which("chromium") is None, reason="needs the browser chromium")
def test_it_prints_on_28_sheets(files: dict[str, bytes], tmp_path: Path) -> None:
    source, target = tmp_path / "audit.html", tmp_path / "audit.pdf"
    source.write_bytes(files["audit.html"])
    command = ["chromium", "--headless", "--no-sandbox", f"--print-to-pdf={target}", str(source)]
    subprocess.run(command, check=True, capture_output=True, timeout=120)
    assert 10 < len(re.findall(rb"/Type /Page\b", target.read_bytes())) <= 28


# The other files


def test_the_page_in_the_documentation_is_what_the_audit_says(files: dict[str, bytes]) -> None:
    """To renew it, run `coldspray audit` and copy its audit.md up to the provenance."""
    document = (Path(__file__).parents[2] / "docs" / "audit.md").read_text("utf-8")
    assert files["audit.md"].decode().partition("\n## Provenance")[0] == document


def test_json_is_the_record_and_each_claim_a_line_of_the_csv_with_all_digits(
    files: dict[str, bytes], record: Record
) -> None:
    document = json.loads(files["audit.json"])
    digest = document["provenance"]["sha256"].pop("workbook.xlsx")
    assert digest == sha256(BESIDE["workbook.xlsx"]).hexdigest()
    assert document == json.loads(json_text(audit_document(record)))
    rows = list(csv.DictReader(io.StringIO(files["audit.csv"].decode())))
    for row, claim in zip(rows, record.claims, strict=True):
        assert row["id"] == claim.id
        assert row["computed"] == ("" if claim.computed is None else repr(claim.computed))
        if claim.as_printed:
            low, high = claim.as_printed.judgements[0].ends
            ends = float(row["enclosure_lower"]), float(row["enclosure_upper"])
            assert ends == pytest.approx((float(low), float(high)), rel=2**-52, abs=0)
            assert ends[0] <= low
            assert high <= ends[1]


# The terminal


@pytest.mark.parametrize("width", [50, 80, 120])
def test_the_summary_fits_the_terminal_and_cuts_nothing(record: Record, width: int) -> None:
    text = report.summary(record, width)
    assert max(map(len, text.splitlines())) <= width
    flat = " ".join(text.split())
    prose = Prose(TERMINAL, record.symbols, {})
    assert all(prose(f.title) in flat for f in record.findings[: report.FINDINGS_ON_SCREEN])
    if width >= 80:
        assert re.search(r"armor +0\.278 +0\.127 +0\.255$", text, re.MULTILINE)
        assert re.search(r"stainless steel +0\.297 +0\.150 +0\.300", text)


@given(st.lists(st.tuples(*3 * [st.text("ab c", max_size=12)]), min_size=1, max_size=5),
       st.integers(12, 40))  # fmt: skip
def test_columns_keep_every_word_within_the_width(rows: list[tuple[str, ...]], width: int) -> None:
    text = texts.columns(rows, width)
    assert max(map(len, text.split("\n"))) <= width
    assert Counter("".join(text.split())) == Counter("".join("".join(map("".join, rows)).split()))


NEAR_DECIMALS = st.builds(
    lambda whole, power, ulps: float(f"{whole}e{power}") * (1 + ulps * 2.0**-52),
    st.integers(1, 10**6), st.integers(-9, 3), st.integers(-30, 30),
)  # fmt: skip
# A subnormal double has fewer digits than a range shows.
ENDS = st.floats(-1e12, 1e12, allow_subnormal=False) | NEAR_DECIMALS


@given(ENDS, ENDS, st.integers(3, 12))
def test_shortened_ranges_stay_true(first: float, another: float, digits: int) -> None:
    low, high = map(F, sorted((first, another)))
    slack = F(1, 2**51)  # for an end that differs from a decimal number by roundoff
    outer, inner = (
        [F(end) for end in texts.between((low, high), digits, inward=inward).split(" to ")]
        for inward in (False, True)
    )
    if low < high:
        assert outer[0] <= low + slack * abs(low)
        assert outer[-1] >= high - slack * abs(high)
        assert inner[0] >= low - slack * abs(low)
        assert inner[-1] <= high + slack * abs(high)
    assert texts.between((first, nextafter(first, inf)), 12).count(" to ") <= 1


@given(st.text())
def test_prose_in_html_is_always_closed(text: str) -> None:
    prose = Prose(PAGE, ["ρ_t", "V"], {"a": Named("<title>", "claim-a")})
    assert not re.sub(r"</?(?:sub|sup|code)>|<a href=\"#claim-a\">|</a>", "", prose(text)).count(
        "<"
    )
