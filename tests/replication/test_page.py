"""The page: complete, well-formed, readable by a screen reader, and closed to anything outside."""

import re
from base64 import b64encode
from collections import Counter
from hashlib import sha256
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree as ET

import html5lib
import pytest
from hypothesis import given
from hypothesis import strategies as st

from replication.audit import Verdict, audit
from replication.reports.failing import failing
from replication.reports.figures import FIGURES, draw
from replication.reports.figures.svg import tidy
from replication.reports.files import write_audit
from replication.reports.gauge import gauge
from replication.reports.glossary import KINDS, VERDICTS
from replication.reports.html import page
from replication.reports.records import audit_record
from replication.text import number

HTML = "{http://www.w3.org/1999/xhtml}"
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page")
    write_audit(path)
    return path


@pytest.fixture(scope="module")
def record() -> dict:
    return audit_record(audit())


@pytest.fixture(scope="module")
def text(folder: Path) -> str:
    return (folder / "audit.html").read_text("utf-8")


@pytest.fixture(scope="module")
def root(text: str) -> ET.Element:
    return html5lib.HTMLParser(strict=True).parse(text)


def ids(root: ET.Element) -> list[str]:
    return [e.get("id") for e in root.iter() if e.get("id") is not None]


def test_there_is_no_script_and_no_style_but_the_one_that_the_policy_names(
    root: ET.Element,
) -> None:
    assert not list(root.iter(f"{HTML}script"))
    attributes = {name for element in root.iter() for name in element.attrib}
    assert "style" not in attributes
    assert not [name for name in attributes if name.startswith("on")]
    (style,) = root.iter(f"{HTML}style")
    (policy,) = (m.get("content") for m in root.iter(f"{HTML}meta") if m.get("http-equiv"))
    digest = b64encode(sha256((style.text or "").encode()).digest()).decode()
    assert policy.split("; ")[:2] == ["default-src 'none'", f"style-src 'sha256-{digest}'"]


def test_nothing_comes_from_outside(root: ET.Element, text: str) -> None:
    for element in root.iter():
        assert "src" not in element.attrib
        assert element.get("href", "#").startswith("#")
    assert "@import" not in text
    assert not re.search(r"url\((?!#)", text)


def test_ids_are_unique_and_every_reference_leads_to_one(root: ET.Element, text: str) -> None:
    found = Counter(ids(root))
    assert [name for name, count in found.items() if count > 1] == []
    links = {e.get("href")[1:] for e in root.iter() if e.get("href")}
    labels = {n for e in root.iter() for n in e.get("aria-labelledby", "").split()}
    drawn = set(re.findall(r"url\(#([^)]+)\)", text))
    assert links | labels | drawn <= set(found)


def test_headings_are_in_order(root: ET.Element) -> None:
    levels = [
        int(e.tag[-1]) for e in root.iter() if re.fullmatch(rf"{re.escape(HTML)}h[1-6]", e.tag)
    ]
    assert levels.count(1) == 1
    assert levels[0] == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))


def test_landmarks_tables_and_pictures_have_names(root: ET.Element) -> None:
    for tag in ("header", "nav", "main"):
        assert len(list(root.iter(f"{HTML}{tag}"))) == 1
    for table in root.iter(f"{HTML}table"):
        assert table.find(f"{HTML}caption") is not None
        assert all(head.get("scope") for head in table.iter(f"{HTML}th"))
    for picture in root.iter(f"{SVG}svg"):
        assert picture.get("role") == "img"
        title = picture.find(f"{SVG}title")
        assert title is not None
        assert title.text


def test_every_claim_and_finding_stands_there_and_each_leads_to_the_other(
    root: ET.Element, record: dict
) -> None:
    found = set(ids(root))
    assert {f"claim-{claim['id']}" for claim in record["claims"]} <= found
    assert {f"finding-{finding['id']}" for finding in record["findings"]} <= found
    for article in root.iter(f"{HTML}article"):
        kind, _, name = article.get("id", "").partition("-")
        targets = {a.get("href") for a in article.iter(f"{HTML}a")}
        if kind == "finding":
            (of,) = (f["claims"] for f in record["findings"] if f["id"] == name)
            assert {f"#claim-{claim}" for claim in of} <= targets
        for finding in record["findings"]:
            if kind == "claim" and name in finding["claims"]:
                assert f"#finding-{finding['id']}" in targets


def test_every_computed_claim_has_its_picture_and_its_proof(root: ET.Element, record: dict) -> None:
    articles = {e.get("id"): e for e in root.iter(f"{HTML}article")}
    for claim in record["claims"]:
        if claim["computed"] is None:
            continue
        article = articles[f"claim-{claim['id']}"]
        words = "".join(article.itertext())
        assert claim["reference"] in words
        assert number(claim["computed"], 10) in words
        details = next(article.iter(f"{HTML}details"))
        assert ("open" in details.attrib) == (claim["verdict"] != "reproduced")
        assert [e.get("class") for e in article.iter(f"{SVG}svg")] == ["gauge"]


def test_hashes_are_those_of_the_files_beside(folder: Path, text: str) -> None:
    assert sha256((folder / "workbook.xlsx").read_bytes()).hexdigest() in text
    assert sha256((folder / "workbook.xlsx").read_bytes()).hexdigest() in (
        folder / "audit.md"
    ).read_text("utf-8")


def test_a_text_of_the_ledger_cannot_become_markup(record: dict) -> None:
    hostile = "<script>alert(1)</script>"
    claims = [{**claim, "title": hostile} for claim in record["claims"]]
    assert hostile not in page({**record, "claims": claims}, draw(record))


def test_figures_stand_alone_and_are_the_ones_in_the_page(folder: Path, text: str) -> None:
    for module in FIGURES:
        path = folder / "figures" / f"{module.NAME}.svg"
        drawn = path.read_text("utf-8")
        assert drawn in text
        root = ET.fromstring(drawn)
        assert root.tag == f"{SVG}svg"
        assert all("style" not in element.attrib for element in root.iter())
        assert not list(root.iter(f"{SVG}style"))
        # Black is the color of the text around it, also where it is left out.
        assert root.get("fill") == "currentColor"
        assert "#000000" not in drawn
        assert (folder / "figures" / f"{module.NAME}.png").read_bytes().startswith(b"\x89PNG")


def test_figures_are_drawn_the_same_twice(record: dict) -> None:
    assert draw(record) == draw(record)


def test_a_figure_that_is_not_matplotlibs_is_refused() -> None:
    with pytest.raises(ValueError, match="no <metadata>"):
        tidy('<svg xmlns="http://www.w3.org/2000/svg"/>', "n", "t", "d")


numbers = st.floats(-1e6, 1e6, allow_nan=False)
positive = st.floats(1e-3, 1e3)


@given(numbers, positive, numbers)
def test_a_gauge_shows_the_value_on_its_side_of_the_band(
    low: float, width: float, value: float
) -> None:
    drawn = gauge((low, low + width), value, (value, value))
    if low <= value <= low + width:
        assert drawn.band[0] <= drawn.value <= drawn.band[1]
        assert "agrees" in drawn.words
    elif value < low:
        assert drawn.value <= drawn.band[0]
        assert "below" in drawn.words
    else:
        assert drawn.value >= drawn.band[1]
        assert "above" in drawn.words
    assert drawn.far in (0, -1 if value < low else 1)
    assert not (drawn.far and abs(value - low - width / 2) < width)


@given(numbers, numbers, st.booleans())
def test_a_gauge_of_a_bound_and_of_an_exact_number(bound: float, value: float, exact: bool) -> None:
    drawn = gauge((bound, bound) if exact else (bound, None), value, (value, value))
    assert drawn.far == 0
    assert 0 <= drawn.value <= 100
    assert drawn.band[1] == (drawn.band[0] if exact else 100.0)


def test_the_readme_shows_the_audits_own_figure(record: dict) -> None:
    shown = ET.parse(Path(__file__).parents[2] / "docs" / "comparison.svg").getroot()
    (module,) = (module for module in FIGURES if module.NAME == "comparison")
    assert shown.findtext(f"{SVG}desc") == module.describe(record)


def test_what_would_explain_a_failing_number_is_told(root: ET.Element, record: dict) -> None:
    articles = {e.get("id"): e for e in root.iter(f"{HTML}article")}
    explained = [claim for claim in record["claims"] if claim["back_solved"] or claim["misprints"]]
    assert {"frank-zook-rha", "frank-zook-stainless"} <= {claim["id"] for claim in explained}
    for claim in explained:
        words = "".join(articles[f"claim-{claim['id']}"].itertext())
        for one in claim["back_solved"]:
            assert one["title"] in words
            assert one["proof"] in words
        assert all(one["edited"] in words for one in claim["misprints"])
        assert all(one["name"] in words for one in claim["alternatives"])


def test_joint_questions_have_their_answers(root: ET.Element, record: dict) -> None:
    (section,) = (e for e in root.iter(f"{HTML}section") if e.get("id") == "joint")
    words = "".join(section.itertext())
    for one in record["joint"]:
        assert one["outcome"].capitalize() in words
        assert one["id"].replace(".", "-") in "".join(ids(section))


def test_the_summary_tells_what_fails_and_why(root: ET.Element, record: dict) -> None:
    (section,) = (e for e in root.iter(f"{HTML}section") if e.get("id") == "summary")
    table = next(section.iter(f"{HTML}table"))
    rows = ["".join(row.itertext()) for row in table.iter(f"{HTML}tr")][1:]
    targets = [a.get("href") for a in table.iter(f"{HTML}a")]
    failed = [claim for claim in record["claims"] if claim["verdict"] == "not reproduced"]
    assert targets[::2] == [f"#claim-{claim['id']}" for claim in failed]
    assert all(target.startswith("#finding-") for target in targets[1::2])
    (coarse,) = (row for row in rows if "at 0.5 ns as at 0.2 ns" in row)
    assert "7.67\xa0µm at 0.5 ns as at 0.2 ns" in coarse
    assert "7.66\xa0µm" in coarse


def test_a_failing_comparison_is_told_with_the_numbers_it_compares(record: dict) -> None:
    told = {one.claim["id"]: (one.printed, one.follows) for one in failing(record)}
    assert told["coarse-step-beta-5"] == ("7.67 um at 0.5 ns as at 0.2 ns", "7.66 um")
    assert told["frank-zook-stainless"][1].startswith("0.150; ")


def test_every_verdict_is_defined(record: dict) -> None:
    assert list(VERDICTS) == [verdict.value for verdict in Verdict]
    assert list(KINDS) == list(record["reproduced"])


def test_tex_stands_in_quotes_only(text: str) -> None:
    root = html5lib.HTMLParser(strict=True).parse(text)
    quotes = {"".join(quote.itertext()) for quote in root.iter(f"{HTML}q")}
    assert any("\\" in quote for quote in quotes)
    for element in root.iter():
        if element.tag == f"{HTML}q":
            element.clear()
    (body,) = root.iter(f"{HTML}body")
    words = "".join(body.itertext())
    assert "\\" not in words
    assert not re.search(r"\*\w[\w ]*\*", words)
