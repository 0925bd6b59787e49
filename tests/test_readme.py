"""The README's examples and numbers, links in the documents, and `docs/recheck.py`."""

import copy
import doctest
import json
import re
import runpy
import shlex
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Callable
from contextlib import chdir
from fractions import Fraction
from math import ceil
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from running import coldspray

from reference.scheme import Scheme
from replication import BETA_3, BETA_5, final_depth, run, stop_time
from replication.audit.record import Record
from replication.power import measured_rates
from replication.report.document import audit_document
from replication.report.words import MEANINGS, TAKEN_EXACTLY, counted_briefly
from replication.text import json_text

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text("utf-8")
QUESTIONS = (ROOT / "docs" / "questions.md").read_text("utf-8")
EQUATION_16 = {"eq16", "eq16-denominator", "eq16-offset", "eq16-power"}
EXAMPLES = [
    (command, output)
    for page in (README, QUESTIONS)
    for block in re.findall(r"```console\n(.*?)```", page, re.DOTALL)
    for command, output in re.findall(
        r"^\$ coldspray (.*)\n((?:(?!\$ ).*\n)*)", block, re.MULTILINE
    )
]


@pytest.mark.parametrize(("command", "output"), EXAMPLES, ids=[c for c, _ in EXAMPLES])
def test_example_prints_what_the_page_says(command: str, output: str, tmp_path: Path) -> None:
    """In a folder of its own, as some write files; it has the data of `docs/`."""
    (tmp_path / "docs").symlink_to(ROOT / "docs")
    with chdir(tmp_path):
        status, printed, _ = coldspray(*shlex.split(command))
    assert status == 0
    head, _, tail = output.partition("...\n")
    assert printed.startswith(head)
    assert printed.endswith(tail)


@pytest.mark.parametrize("command", re.findall(r"^\|.*\| `coldspray (.*?)` \|", QUESTIONS, re.M))
def test_every_question_is_answered_by_its_command(command: str, tmp_path: Path) -> None:
    """In a folder of its own, as some write files; it has the data of `docs/`."""
    (tmp_path / "docs").mkdir()
    for data in (ROOT / "docs").glob("*.csv"):
        shutil.copy(data, tmp_path / "docs")
    shutil.copytree(ROOT / "docs" / "sweeps", tmp_path / "docs" / "sweeps")
    with chdir(tmp_path):
        assert coldspray(*shlex.split(command))[0] == 0
    for figure in tmp_path.glob("*.svg"):
        assert texts_of(figure) == texts_of(ROOT / "docs" / "plots" / figure.name)


def texts_of(figure: Path) -> list[str]:
    """Return what a figure says: titles, labels, and the numbers at its axes."""
    texts = ET.parse(figure).iter("{http://www.w3.org/2000/svg}text")
    return ["".join(text.itertext()) for text in texts]


def test_there_are_examples_and_those_in_python_run() -> None:
    assert len(EXAMPLES) >= 4
    results = doctest.testfile(str(ROOT / "README.md"), module_relative=False)
    assert results.attempted > 0
    assert results.failed == 0


def test_the_two_commands_are_those_that_users_were_promised() -> None:
    assert "python -m pip install . && coldspray audit" in README
    assert "python -m pip install -e '.[test]' && python -m pytest" in README
    assert "python -m pip install --quiet -e '.[test]'" in (ROOT / ".ci" / "run").read_text()


def test_the_rates_are_those_measured() -> None:
    rates = measured_rates()
    hidden = f"{rates.invisible} ({rates.invisible / rates.planted:.0%}) leave".replace("%", " %")
    text = " ".join(README.split())
    assert f"Of {rates.planted}, drawn with seed {rates.seed}, it notices {rates.detected};" in text
    assert f"the other {hidden} all numbers that it relates in agreement." in text
    assert f"It also rewrites {rates.controls} numbers and equations" in text
    assert f"| of the {rates.visible} that can be noticed |" in text
    heads = (
        "noticed", "the true text is named", "it is named first", "another entry is named first",
        f"**false alarms**, of {rates.controls} harmless rewritings",
    )  # fmt: skip
    for head, (_, _, share, interval) in zip(heads, rates.rates().rows, strict=True):
        assert f"| {head} | {share} | {interval} |" in text
    whys = Counter(missed.why for missed in rates.not_first)
    faults, alike, pair, _ = [count for _, count in whys.most_common()]
    assert f"Of the {whys.total()} that are not named first, {faults} stand in Eq. 16," in text
    assert {m.entry for m in rates.not_first if "both faults" in m.why} <= EQUATION_16
    assert f"For {alike} another text of the same entry agrees as well, and for {pair} two" in text


def test_verdicts_are_counted_as_the_audit_counts_them(record: Record) -> None:
    table = re.findall(r"^\| ([a-z, ]+) \| (\d+) \| (.*) \|$", README, re.MULTILINE)
    assert {verdict: int(count) for verdict, count, _ in table} == record.summary
    assert {verdict: meaning for verdict, _, meaning in table} == MEANINGS
    counts, text = record.counts, " ".join(README.split())
    assert (
        f"**{counted_briefly(counts)}** For one of these {counts.independent} to fail, any of "
        "several printed numbers, or the equation that computes it, would have to be wrong."
    ) in text
    assert (
        f"The other {counts.reproduced - counts.independent} that are reproduced tell less: "
        f"{counts.constants} are factors and powers in equations, {counts.by_definition} only "
        "scale, multiply or pick printed numbers"
    ) in text
    assert f"{counts.repeats} are 0.298 rounded again, and {counts.evidence} are the cells" in text
    assert (
        f"The {counts.entries} entries are {counts.numbers} numbers and {counts.remarks} remarks "
        "in words"
    ) in text
    below = record.claim("frank-zook-below-observed").figures
    assert (
        f'"slightly less" than 0.298 is {-below[0].value:.1f} % as printed, and '
        f"{-below[1].value:.1f} % as derived."
    ) in text
    assert f"`audit.html` has all {len(record.findings)} findings" in text
    assert counts.equations_failing == 1
    assert (
        f"Of {counts.equations} equations, {counts.equations_derived} follow from those before "
        "them or from mechanics, and one (Eq. 16) does not."
    ) in text


CARDINALS = {8: "eight", 10: "ten"}


def test_the_top_says_what_the_headline_rests_on(record: Record) -> None:
    top = " ".join(README.partition("## Two commands")[0].split())
    inferred = record.inferred[0]
    mass = record.claim(inferred.entry.mass).claim.shown
    assert f"inferred from {CARDINALS[len(inferred.evidence)]} cells of Table A-1" in top
    assert inferred.assumed > inferred.with_printed_mass[1]
    impossible = f"{TAKEN_EXACTLY}, {inferred.assumed:.0f} kg/m³ is impossible"
    assert f"({mass} kg, with which, {impossible})" in top
    most = f"no more than {ceil(inferred.with_printed_mass[1])} kg/m³ is possible"
    assert f"With the mass as printed, {TAKEN_EXACTLY}, {most}," in " ".join(README.split())


def test_the_slips_are_those_of_the_family(record: Record) -> None:
    armor, steel = (record.claim(f"frank-zook-{name}") for name in ("rha", "stainless"))
    assert armor.slips_tried is not None
    assert steel.slips_tried is not None
    at_taken = sum(armor.claim.target().contains(Fraction(slip.value)) for slip in armor.slips)
    assert at_taken == 1
    assert not {slip.name for slip in armor.slips} & {slip.name for slip in steel.slips}
    assert (
        f"with {armor.slips_tried.members} values, {len(armor.slips)} print it for some density "
        f"that Table A-1 admits (one at 7850), and {armor.slips_tried.expected:.1f} would by "
        f"accident; {len(steel.slips)} print 0.297, where {steel.slips_tried.expected:.1f} would; "
        "none prints both."
    ) in " ".join(README.split())


def test_what_does_not_follow_is_the_audit_s_table(record: Record) -> None:
    for name in ("rha", "stainless"):
        claim = record.claim(f"frank-zook-{name}")
        computed = (f"{reading.computed:.3f}" for reading in claim.assessment.readings)
        assert f"| {claim.claim.shown} | {' | '.join(computed)} |" in README
    sources = record.inferred[0].sources
    of_304 = [c for c in sources if c.source.id.startswith("304-")]
    assert len(of_304) == 10
    assert "The nine other numbers that the cited sources print for 304" in " ".join(README.split())
    others = record.counts.equations - record.counts.equations_derived - 1
    assert f"The other {CARDINALS[others]} are definitions" in " ".join(README.split())


def test_times_are_those_of_the_whole_table() -> None:
    (block,) = re.findall(r"```text\n(.*?)```", README, re.DOTALL)
    whole = (ROOT / "docs" / "bench" / "bench.txt").read_text("utf-8").splitlines()
    assert {line.rstrip() for line in block.splitlines()} <= {line.rstrip() for line in whole}


def test_the_changelog_has_what_the_audit_computes(record: Record) -> None:
    """X/R by Frank and Zook, as printed and as derived, and the densities, to the last digit."""
    text = " ".join((ROOT / "CHANGELOG.md").read_text("utf-8").split())
    pair = [record.claim(f"frank-zook-{target}") for target in ("rha", "stainless")]
    for reading in (0, 1):
        shown = [f"{claim.assessment.readings[reading].computed:.5f}" for claim in pair]
        assert f" | {shown[0]} | {shown[1]} | " in text
    (density,) = [i for i in record.inferred if i.scheme is Scheme.PUBLISHED]
    spheres, printed = density.interval, density.with_printed_mass
    assert "from {:.3f} to {:.3f} kg/m³ with the mass".format(*map(float, spheres)) in text
    assert "from {:.3f} to {:.3f} with the printed mass".format(*map(float, printed)) in text


def test_the_changelog_has_the_depths_and_times_of_the_models() -> None:
    """When one of them moves, the changelog of the new version says so."""
    text = (ROOT / "CHANGELOG.md").read_text("utf-8")
    rows = re.findall(r"^\| (.+) \| ([\d.]+) [µn][ms] \| ([\d.]+) [µn][ms] \|$", text, re.MULTILINE)
    cases = (BETA_3, BETA_5)
    stops = [float(stop_time(**case.motion)) for case in cases]
    computed = {
        "final depth of the sheet, 0.2 ns": [run(case).final_depth * 1e6 for case in cases],
        "the same, drag at the middle velocity": [
            run(case, scheme="centered").final_depth * 1e6 for case in cases
        ],
        "final depth at rest, without time steps": [
            float(final_depth(**case.motion)) * 1e6 for case in cases
        ],
        "time until rest": [stop * 1e9 for stop in stops],
    }
    assert {name: [float(number) for number in numbers] for name, *numbers in rows} == {
        name: [float(f"{value:.7g}") for value in values] for name, values in computed.items()
    }


@pytest.mark.parametrize(
    "document",
    ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/check.md", "docs/corrections.md",
     "docs/design.md", "docs/questions.md", "docs/sweeps/README.md"],
)  # fmt: skip
def test_links_and_paths_lead_somewhere(document: str) -> None:
    text = (ROOT / document).read_text("utf-8")
    for target in re.findall(r"\]\((?!https?:|#)([^)]+)\)", text):
        assert ((ROOT / document).parent / target).exists(), target
    for path in re.findall(r"`((?:reference|replication|spreadsheets|tests)/[\w/.]*)`", text):
        assert (ROOT / path).exists(), path


def test_the_samples_of_the_design_give_what_they_say() -> None:
    failed, tried = doctest.testfile(str(ROOT / "docs" / "design.md"), module_relative=False)
    assert (failed, tried > 5) == (0, True)


# The program that checks an audit by its file alone

PROGRAM = ROOT / "docs" / "recheck.py"
differences = runpy.run_path(str(PROGRAM))["differences"]
Audit = dict[str, Any]


@pytest.fixture(scope="module")
def document(record: Record) -> Audit:
    return dict(json.loads(json_text(audit_document(record))))


@pytest.fixture
def tampered(document: Audit) -> Audit:
    """A copy to tamper with."""
    return copy.deepcopy(document)


def entry(document: Audit, part: str, name: str) -> Audit:
    """Return a claim or an equation of an audit, by its id."""
    entries: list[Audit] = document[part]
    return {own["id"]: own for own in entries}[name]


DOUBLES = "2158539843907765/281474976710656 to 8635931933562063/1125899906842624"
"""The range of depth-beta-5 in doubles that contain it. With 40 digits, the sheet's rows give
7.66867402968701549 to 7.67024837738899965."""


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        pytest.param(
            "enclosure_exact", ["7/1", "71/10"],
            [
                "its range says 'not reproduced', not 'reproduced'",
                f"{DOUBLES} does not contain 7 to 71/10",
                "the computed 7.669556888793411 is not within 7.0 to 7.1",
            ],
            id="a range below the number",
        ),
        pytest.param(
            "enclosure_exact", ["7/1", "767/100"],
            [
                "its range says 'neither', not 'reproduced'",
                f"{DOUBLES} does not contain 7 to 767/100",
            ],
            id="a range that reaches below the number",
        ),
        pytest.param(
            "interval_exact", ["7/1", "8/1"], ["7.67 does not stand for 7 to 8"],
            id="other values that print so",
        ),
        pytest.param(
            "interval_exact", ["1533/200", "3071/400"],
            ["7.67 does not stand for 1533/200 to 3071/400"], id="7.665 to 7.6775",
        ),
        pytest.param(
            "computed", 7.9,
            ["the computed 7.9 is not within 7.668674029687016 to 7.670248377389"],
            id="another value",
        ),
        pytest.param(
            "printed", "7.68",
            [
                "7.68 does not stand for 1533/200 to 307/40",
                "its range says 'not reproduced', not 'reproduced'",
                "its range says 'not reproduced', not 'reproduced within input rounding' (cut off)",
            ],
            id="another text",
        ),
    ],
)  # fmt: skip
def test_a_changed_depth_is_noticed(
    key: str, value: object, said: list[str], tampered: Audit
) -> None:
    entry(tampered, "claims", "depth-beta-5")[key] = value
    assert list(differences(tampered)) == [f"depth-beta-5: {sentence}" for sentence in said]


def test_a_range_with_its_ends_exchanged_contains_nothing(tampered: Audit) -> None:
    entry(tampered, "claims", "depth-beta-5")["enclosure"] = [7.67, 7.66]
    (said,) = differences(tampered)
    assert said.startswith("depth-beta-5: ")
    assert " does not contain " in said


def test_a_changed_verdict_under_another_convention_is_noticed(tampered: Audit) -> None:
    entry(tampered, "claims", "a1-depth-2")["otherwise"][0]["verdict"] = "reproduced"
    assert list(differences(tampered)) == [
        "a1-depth-2: its range says 'not reproduced', not 'reproduced' (cut off)"
    ]


def test_a_changed_verdict_by_another_reading_is_noticed(tampered: Audit) -> None:
    entry(tampered, "claims", "frank-zook-rha")["readings"][0]["verdict"] = "reproduced"
    assert list(differences(tampered)) == [
        "frank-zook-rha: its range says 'not reproduced', not 'reproduced'"
    ]


def test_a_number_that_others_repeat_cannot_be_changed_alone(tampered: Audit) -> None:
    entry(tampered, "claims", "velocity-606")["interval_exact"] = ["607", "608"]
    assert list(differences(tampered)) == [
        "similar-data-velocity: is 'consistent', not inconsistent",
        "sticking-velocity-606: is 'consistent', not inconsistent",
    ]


def test_a_choice_outside_its_range_is_noticed(tampered: Audit) -> None:
    entry(tampered, "claims", "flow-stress")["shown_by"]["interval"] = [600, 650]
    assert list(differences(tampered)) == ["flow-stress: is 'consistent', not inconsistent"]


def test_a_source_that_does_not_agree_is_noticed(tampered: Audit) -> None:
    entry(tampered, "claims", "yield-strength")["sources"][0]["agrees"] = False
    assert list(differences(tampered)) == [
        "yield-strength: is 'agrees with public sources', not differs from public sources"
    ]


def test_a_constant_that_would_do_is_noticed(tampered: Audit) -> None:
    entry(tampered, "equations", "eq16")["constants"][0]["needed"] = ["2"]
    (said,) = differences(tampered)
    assert said == "eq16-denominator: is 'not reproduced', not reproduced"


def test_a_verdict_on_a_remark_is_noticed(tampered: Audit) -> None:
    entry(tampered, "claims", "coarse-step-remark")["verdict"] = "consistent"
    assert list(differences(tampered)) == [
        "coarse-step-remark: has a verdict and no interval",
        "summary: 64 claims are said to be 'consistent', 65 are",
        "summary: 42 claims are said to be 'remark, quantified', 41 are",
    ]


def test_changed_counts_are_noticed(tampered: Audit) -> None:
    tampered["counts"]["reproduced"] = 90
    assert list(differences(tampered)) == ["counts: 90 are said to be reproduced"]


def test_a_changed_summary_is_noticed(tampered: Audit) -> None:
    tampered["summary"]["reproduced"] += 1
    assert list(differences(tampered)) == ["summary: 78 claims are said to be 'reproduced', 77 are"]


@pytest.mark.parametrize(
    ("changed", "status"),
    [
        (lambda text: text, 0),
        (lambda text: text.replace('"reproduced"', '"not reproduced"', 1), 1),
        *((lambda _, text=text: text, 2) for text in ("{}", "no JSON", "[1]")),
    ],
)
def test_the_program(
    changed: Callable[[str], str], status: int, document: Audit, tmp_path: Path
) -> None:
    file = tmp_path / "audit.json"
    file.write_text(changed(json.dumps(document)), "utf-8")
    command = [sys.executable, "-I", PROGRAM, file]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == status
    assert "Traceback" not in done.stderr
    assert len(done.stderr.splitlines()) == (status == 2)
    if status == 0:
        assert done.stdout == f"{len(document['claims'])} claims, 0 differences\n"
