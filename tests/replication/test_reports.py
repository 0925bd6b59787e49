"""The audit's files: complete, exact, and the same bytes on every run."""

import csv
import json
import os
import subprocess
import sys
from fractions import Fraction
from hashlib import sha256
from pathlib import Path

import pytest

from reference.ledger import load
from replication.reports.files import FILES, write_audit
from replication.reports.shown import NOTHING_OPEN, proven
from replication.text import number

CLAIM_KEYS = {
    "id", "where", "printed", "unit", "interval", "computed", "enclosure", "verdict", "assumes",
    "explanation",
}  # fmt: skip


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("audit")
    write_audit(path)
    return path


@pytest.fixture(scope="module")
def record(folder: Path) -> dict:
    return json.loads((folder / "audit.json").read_text("utf-8"))


def test_json_has_the_promised_keys(record: dict) -> None:
    assert {"schema", "summary", "claims", "findings", "provenance"} <= set(record)
    assert all(set(claim) >= CLAIM_KEYS for claim in record["claims"])


def test_every_claim_is_in_every_file(folder: Path, record: dict) -> None:
    ids = list(load().claims)
    assert [claim["id"] for claim in record["claims"]] == ids
    with (folder / "audit.csv").open(encoding="utf-8", newline="") as file:
        assert [row["id"] for row in csv.DictReader(file)] == ids
    text = (folder / "audit.md").read_text("utf-8")
    assert all(f"`{name}`" in text for name in ids)


def test_markdown_has_what_the_page_has(folder: Path, record: dict) -> None:
    lines = (folder / "audit.md").read_text("utf-8").splitlines()
    for claim in record["claims"]:
        if claim["kind"] == "blank":
            continue
        (line,) = (line for line in lines if line.startswith(f"- `{claim['id']}` {claim['title']}"))
        assert f"`{claim['quote']}`" in line
        if "proof above" in line:
            start = lines.index(f"### `{claim['id']}`: {claim['title']}")
            line = "\n".join(lines[start : start + 20])
        shown = [claim["interval_text"], claim["workbook"], *claim["assumes"]]
        shown += [f"(`{name}`)" for names in claim["rests_on"].values() for name in names]
        if claim["computed"] is not None:
            shown += [number(claim["computed"], 10), proven(claim["enclosure"])]
        for text in shown:
            assert text is None or text.replace("(`inferred:target-density`)", "") in line


def test_findings_do_not_say_that_nothing_is_open(folder: Path, record: dict) -> None:
    assert NOTHING_OPEN in {finding["settle"] for finding in record["findings"]}
    for name in ("audit.md", "audit.html"):
        text = (folder / name).read_text("utf-8")
        assert NOTHING_OPEN not in text
        assert "What would settle it" in text


def test_enclosures_hold_the_reference(record: dict) -> None:
    for claim in record["claims"]:
        if claim["computed"] is not None:
            low, high = claim["enclosure"]
            # The reference is shown to 25 digits: half a unit of the last.
            value = Fraction(claim["reference"])
            slack = abs(value) * Fraction(1, 10**24)
            assert Fraction(low) - slack <= value <= Fraction(high) + slack


def test_a_claim_is_reproduced_exactly_if_its_value_is_in_its_interval(record: dict) -> None:
    for claim in record["claims"]:
        if claim["computed"] is not None and claim["interval"][0] != claim["interval"][1]:
            low, high = claim["interval"]
            inside = (low is None or low <= claim["computed"]) and (
                high is None or claim["computed"] <= high
            )
            assert inside == (claim["verdict"] == "reproduced"), claim["id"]


def test_numbers_keep_their_digits_in_csv(folder: Path, record: dict) -> None:
    with (folder / "audit.csv").open(encoding="utf-8", newline="") as file:
        for row, claim in zip(csv.DictReader(file), record["claims"], strict=True):
            if claim["computed"] is not None:
                assert float(row["computed"]) == claim["computed"]


def test_provenance_hashes_the_report_the_ledger_and_the_workbook(
    folder: Path, record: dict
) -> None:
    import reference.report

    known = Path(reference.report.__path__[0])
    digests = record["provenance"]["sha256"]
    assert set(digests) >= {"de_rosset_2006.txt", "ledger.toml", "workbook.xlsx"}
    for name, digest in digests.items():
        path = folder / name if name == "workbook.xlsx" else known / name
        assert sha256(path.read_bytes()).hexdigest() == digest


def test_files_are_the_same_bytes_in_another_place_and_time_zone(
    folder: Path, tmp_path: Path
) -> None:
    environment = {**os.environ, "TZ": "Asia/Kathmandu", "LC_ALL": "C", "PYTHONHASHSEED": "7"}
    command = [sys.executable, "-m", "replication", "audit", "--quiet", "--out", str(tmp_path)]
    subprocess.run(command, check=True, env=environment, cwd=tmp_path)
    names = [path.relative_to(folder) for path in folder.rglob("*") if path.is_file()]
    assert sorted(map(str, names)) == sorted(FILES)
    for name in names:
        assert (tmp_path / name).read_bytes() == (folder / name).read_bytes(), name
