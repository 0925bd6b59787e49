"""What the worker of docs/live answers, without a browser."""

import importlib.util
import json
import re
import subprocess
import sys
from fractions import Fraction
from math import ulp
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from running import coldspray

from reference.ledger import load
from replication import BETA_5, Impact, final_depth, frank_zook_depth, run
from replication.audit.record import Record
from replication.cases import changed
from replication.report.document import audit_document
from replication.solve import solve_printed
from replication.text import json_text

LIVE = Path(__file__).resolve().parents[2] / "docs/live"


@pytest.fixture(scope="module")
def answers() -> ModuleType:
    spec = importlib.util.spec_from_file_location("answers", LIVE / "answers.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def stored(record: Record) -> dict[str, Any]:
    """The stored audit as a browser's JavaScript gives it back: 2.0 has become 2."""
    text = json_text(audit_document(record))
    document: dict[str, Any] = json.loads(text, parse_float=without_point)
    return document


def without_point(text: str) -> float:
    return int(float(text)) if float(text).is_integer() else float(text)


def asked(answers: ModuleType, **question: Any) -> dict[str, Any]:
    answer: dict[str, Any] = json.loads(answers.answer(json.dumps(question)))
    return answer


def test_nothing_is_imported_that_the_page_does_not_have() -> None:
    program = f"""
import sys
before = set(sys.modules)
sys.path.insert(0, {str(LIVE)!r})
import answers
new = [sys.modules[name] for name in set(sys.modules) - before]
files = [module.__file__ for module in new if getattr(module, "__file__", None)]
places = [file.replace("\\\\", "/").split("/site-packages/") for file in files]
print(*sorted({{place[1].split("/")[0] for place in places if len(place) > 1}}))
"""
    command = [sys.executable, "-c", program]
    ended = subprocess.run(command, capture_output=True, text=True, check=True)
    # flint and msgspec import these where they are installed, and do without them on the page.
    optional = {"mpmath", "typing_extensions.py"}
    assert set(ended.stdout.split()) - optional == {"flint", "msgspec"}


@pytest.mark.parametrize("kind", ["claim", "equation", "finding"])
def test_a_proof_gives_what_is_stored(
    answers: ModuleType, stored: dict[str, Any], kind: str
) -> None:
    for document in stored[f"{kind}s"][:30]:
        proof = asked(answers, ask="proof", kind=kind, id=document["id"], stored=document)
        assert proof["differs"] == []


def test_the_readme_counts_the_entries(stored: dict[str, Any]) -> None:
    claims, equations, findings = (stored[f"{kind}s"] for kind in ("claim", "equation", "finding"))
    entries = len(claims) + len(equations) + len(findings)
    proven = sum(claim["enclosure"] is not None for claim in claims)
    words = (LIVE / "README.md").read_text("utf-8")
    assert (
        f"{entries} entries: {len(claims)} claims, {len(equations)} equations, "
        f"{len(findings)} findings." in words
    )
    assert f"\n{proven} are proven again, " in words


def claim(stored: dict[str, Any], name: str) -> dict[str, Any]:
    (document,) = (claim for claim in stored["claims"] if claim["id"] == name)
    return dict(document)


def test_a_changed_verdict_is_shown_with_both_values(
    answers: ModuleType, stored: dict[str, Any]
) -> None:
    forged = claim(stored, "frank-zook-rha") | {"verdict": "reproduced"}
    proof = asked(answers, ask="proof", kind="claim", id="frank-zook-rha", stored=forged)
    assert proof["differs"] == [{
        "where": "verdict", "stored": '"reproduced"', "here": '"not reproduced"',
        "last_digits": False,
    }]  # fmt: skip


@pytest.mark.parametrize(("steps", "is_last_digit"), [(1, True), (8, True), (9, False)])
def test_a_difference_in_the_last_digits_is_told_from_others(
    answers: ModuleType, stored: dict[str, Any], steps: int, is_last_digit: bool
) -> None:
    document = claim(stored, "frank-zook-rha")
    document["computed"] += steps * ulp(document["computed"])
    proof = asked(answers, ask="proof", kind="claim", id="frank-zook-rha", stored=document)
    (difference,) = proof["differs"]
    assert (difference["where"], difference["last_digits"]) == ("computed", is_last_digit)


def test_a_key_that_is_missing_is_a_difference(answers: ModuleType, stored: dict[str, Any]) -> None:
    document = claim(stored, "frank-zook-rha")
    del document["enclosure"]
    proof = asked(answers, ask="proof", kind="claim", id="frank-zook-rha", stored=document)
    assert [d["where"] for d in proof["differs"]] == ["enclosure"]


@pytest.mark.parametrize(
    "given", [{}, {"velocity": "620 m/s"}, {"radius": "25 um", "beta": "3"}, {"step": "2 ns"}]
)
def test_the_model_answers_as_the_package_does(answers: ModuleType, given: dict[str, str]) -> None:
    answer = asked(answers, ask="model", inputs={**given, "measured_depth": "3.3 um"})
    impact = case(answers, given)
    sheet = run(impact)
    assert answer["depth"] == final_depth(**impact.motion)
    assert (answer["sheet"]["depth"], answer["sheet"]["steps"]) == (sheet.final_depth, sheet.steps)
    shown = [*answer["sheet"]["first"], *answer["sheet"]["last"]]
    assert all(tuple(row) == sheet.rows[k] for k, *row in shown)
    assert answer["curve"][-1] == [answer["stop_time"], answer["depth"]]
    assert answer["approaches"]["rows"][-1]["text"] == "0.3"


def case(answers: ModuleType, given: dict[str, str]) -> Impact:
    return changed(BETA_5, {name: answers._number(name, text) for name, text in given.items()})


def modelled(answers: ModuleType, **given: str) -> dict[str, Any]:
    """The answer for the report's case with these inputs."""
    return asked(answers, ask="model", inputs={"measured_depth": "3.3 um", **given})


ABSENT = ("jinja2", "matplotlib", "numba", "numpy", "openpyxl", "pandas", "scipy", "xlsxwriter")


@pytest.mark.parametrize(
    ("given", "part", "expected"),
    [
        ({}, "resistance", 3.5e9),
        ({"measured_depth": "3.3 mm"}, "resistance", 3.5e9),
        ({"measured_depth": "1e-300 m"}, "resistance", 3.5e9),
        ({"radius": "1e-6 um"}, "resistance", 3.5e9),
        ({"radius": "1e-200 um"}, "refused",
         "particle mass is 0.0: it must be a number above zero"),
        ({"flow_stress": "0.0 MPa"}, "refused",
         "Flow stress is 0.0 MPa: it must be greater than zero"),
        ({"velocity": "fast"}, "refused",
         "Impact velocity: 'fast' is not a finite number with or without a unit, such as '1 m/s'"),
    ],
)  # fmt: skip
def test_no_answer_needs_a_library_that_the_page_does_not_have(
    answers: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    given: dict[str, str],
    part: str,
    expected: object,
) -> None:
    for name in ABSENT:
        monkeypatch.setitem(sys.modules, name, None)
    assert modelled(answers, **given)[part] == expected


@pytest.mark.parametrize(
    ("depth", "message"),
    [
        ("1e-300 m", "Measured depth is 9.09e-296 times the radius, too far to compute with"),
        ("0 um", "Measured depth is 0 um: it must be greater than zero"),
        ("deep", "Measured depth: 'deep' is not a finite number with or without a unit, "
         "such as '1 m'"),
    ],
)  # fmt: skip
def test_a_measured_depth_that_cannot_be_used_is_said(
    answers: ModuleType, depth: str, message: str
) -> None:
    answer = modelled(answers, measured_depth=depth)
    assert answer["inverse"] == {"refused": message}


def test_messages_name_inputs_as_the_page_labels_them(answers: ModuleType) -> None:
    page = (LIVE / "index.html").read_text("utf-8")
    labels = dict(re.findall(r'<label for="(\w+)">(.*?)</label>', page))
    assert {*labels} == {*answers.LABELS}
    assert all(labels[name].startswith(words) for name, words in answers.LABELS.items())


@pytest.mark.parametrize("depth", ["3.3 um", "2 um", "0.04 um", "12.00 um"])
def test_a_proven_range_is_never_shown_narrower(answers: ModuleType, depth: str) -> None:
    interval = solve_printed(BETA_5, "resistance", {"depth": depth}).interval
    assert interval is not None
    shown = modelled(answers, measured_depth=depth)["inverse"]["range"].removesuffix(" GPa")
    low, high = (Fraction(end) * 10**9 for end in shown.split(" to "))
    assert low <= Fraction(interval[0]) <= Fraction(interval[1]) <= high


def test_zeros_that_may_be_no_digits_have_a_range_of_their_own(answers: ModuleType) -> None:
    inverse = modelled(answers, measured_depth="3300 nm")["inverse"]
    assert inverse["range"] == "17.821 to 17.832 GPa"
    assert inverse["fewest_digits"] == modelled(answers)["inverse"]["range"]


def test_the_range_of_a_claim_is_never_shown_narrower(
    answers: ModuleType, stored: dict[str, Any]
) -> None:
    document = claim(stored, "frank-zook-rha")
    proof = asked(answers, ask="proof", kind="claim", id="frank-zook-rha", stored=document)
    low, high = map(Fraction, proof["range"].split(" to "))
    assert low <= Fraction(document["enclosure_exact"][0])
    assert high >= Fraction(document["enclosure_exact"][1])


@pytest.mark.parametrize(
    "given",
    [
        {}, {"step": "100 ns"}, {"velocity": "1e9 m/s", "step": "1 ns"}, {"velocity": "0.5 m/s"},
        {"particle_density": "8.9 kg/m^3"}, {"radius": "11 m", "step": "1 ms"},
    ],
)  # fmt: skip
def test_the_warnings_are_those_of_the_command_line(
    answers: ModuleType, given: dict[str, str]
) -> None:
    typed = [f"--{name.replace('_', '-')}={text}" for name, text in given.items()]
    status, printed, _ = coldspray("sheet", "--json", "--quiet", *typed)
    assert status == 0
    record = json.loads(printed)
    answer = modelled(answers, **given)
    # Only the page computes the resistance for a measured depth, too.
    of_case = [words for words in answer["warnings"] if not words.startswith("the resistance")]
    assert list(map(unnamed, of_case)) == list(map(unnamed, record["warnings"]))
    assert [words.removeprefix("the sheet: ") for words in answer["notes"]] == record["notes"]


def unnamed(warning: str) -> str:
    """A warning without the name of its input, which is an option there and a label here."""
    warning = warning.removeprefix("the sheet: ")
    return re.sub("^(--[a-z-]+|Impact velocity|Particle radius|Particle density) is ", "", warning)


def test_a_point_of_the_sheet_is_in_the_middle_of_its_step(answers: ModuleType) -> None:
    sheet = run(BETA_5)
    points = modelled(answers)["sheet"]["points"]
    marked = [sheet.rows[0], *sheet.rows[3::3], sheet.rows[-1]]
    assert points == [[max(0.0, row.time - 1e-10), row.depth] for row in marked]


@pytest.mark.parametrize("step", ["0.2 ns", "0.45 ns", "4 ns", "100 ns"])
def test_no_point_is_drawn_twice(answers: ModuleType, step: str) -> None:
    points = modelled(answers, step=step)["sheet"]["points"]
    assert len({tuple(point) for point in points}) == len(points)


def test_the_approaches_say_of_what_they_are(answers: ModuleType) -> None:
    rows = modelled(answers, velocity="450 m/s")["approaches"]["rows"]
    shown = {row["name"]: row["text"] for row in rows}
    ledger = load()
    for name, claim_id in (
        ("armor", "fz-resistance-rha"),
        ("stainless", "fz-resistance-stainless"),
    ):
        own = frank_zook_depth(
            450.0, 11e-6, 8900.0, 7850.0, float(ledger.value(claim_id)), 2 / 3,
            float(ledger.value("fz-k1")), float(ledger.value("fz-kt")),
        )  # fmt: skip
        (text,) = (text for row, text in shown.items() if row.startswith(f"Frank and Zook: {name}"))
        assert float(text) == pytest.approx(own / 11e-6, rel=5e-4)  # four digits are shown
    assert shown["your measured depth"] == "0.3000"
    assert shown["the report’s experiment (section 2), whatever the inputs here"] == "0.3"


def test_the_step_that_is_advised_is_long_enough(answers: ModuleType) -> None:
    refusal = modelled(answers, radius="11 m")["sheet"]["refused"]
    assert refusal == "more than 4000 rows: take a step of at least 6520 ns"
    assert "steps" in modelled(answers, radius="11 m", step="6520 ns")["sheet"]


def test_a_short_sheet_has_no_row_twice(answers: ModuleType) -> None:
    sheet = asked(answers, ask="model", inputs={"step": "4 ns", "measured_depth": "3"})["sheet"]
    assert [row[0] for row in (*sheet["first"], *sheet["last"])] == list(range(sheet["steps"] + 1))
