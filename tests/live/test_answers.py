"""What the worker of docs/live answers, without a browser."""

import importlib.util
import json
import subprocess
import sys
from math import ulp
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from reference.ledger import load
from replication import BETA_5, Impact, final_depth, run
from replication.audit.record import Record
from replication.cases import changed
from replication.report.document import audit_document
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
    assert answer["approaches"][-1]["normalized_depth"] == float(load().value("observed-ratio"))


def case(answers: ModuleType, given: dict[str, str]) -> Impact:
    return changed(BETA_5, {name: answers._number(name, text) for name, text in given.items()})


def test_a_short_sheet_has_no_row_twice(answers: ModuleType) -> None:
    sheet = asked(answers, ask="model", inputs={"step": "4 ns", "measured_depth": "3"})["sheet"]
    assert [row[0] for row in (*sheet["first"], *sheet["last"])] == list(range(sheet["steps"] + 1))
