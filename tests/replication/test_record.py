"""The record of the audit: whole, as its schema says, the same wherever it is made; its curves."""

import json
import os
import re
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from fractions import Fraction as F
from itertools import pairwise, product
from math import log
from pathlib import Path
from statistics import NormalDist

import jsonschema
import mpmath
import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.ledger import load
from reference.motion import Trajectory
from reference.printed import parse
from replication.audit import comparison
from replication.audit.audit import audit
from replication.audit.record import Figure, Level, Record, filled, schema
from replication.cases import BETA_5, CASES
from replication.models import depth
from replication.models.impact import Impact
from replication.models.sheet import SCHEMES, run
from replication.text import json_text

LEDGER = load()


def test_the_record_is_what_its_schema_says_and_nothing_less(record: Record) -> None:
    document = json.loads(json_text(record))
    validator = jsonschema.Draft202012Validator(schema())
    validator.validate(document)
    small = {**document, "claims": [], "curves": [], "findings": [], "ladders": []}
    validator.validate(small)
    for key in small:
        assert not validator.is_valid({k: v for k, v in small.items() if k != key}), key
    for key in document["claims"][0]:
        spoiled = {k: v for k, v in document["claims"][0].items() if k != key}
        assert not validator.is_valid({**small, "claims": [spoiled]}), key
        wrong = {**spoiled, key: True}  # no key is a truth value
        assert not validator.is_valid({**small, "claims": [wrong]}), key


def test_the_record_comes_back_from_its_json(record: Record) -> None:
    again = msgspec.json.decode(json_text(record).encode(), type=Record)
    assert json_text(again) == json_text(record)
    assert again.claim("depth-beta-5") == record.claim("depth-beta-5")


# What is checked by hand

LINE = re.compile(r"^(?P<left>.+) = (?P<right>[-\d.]+)$")


def arithmetic(text: str) -> float:
    """The value of a line as it stands on the page."""
    raised = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")
    text = re.sub(r"×10([⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda power: "e" + power[1].translate(raised), text)
    text = text.replace("·", "*").replace("^", "**").replace("ln", "log")
    assert re.fullmatch(r"(?:log|[\de.+*/() -])+", text), text
    return float(eval(text, {"log": log}))  # only digits, signs and log are left


def test_every_line_by_hand_is_calculated_again(record: Record) -> None:
    by_hand = [claim.by_hand.removesuffix(".") for claim in record.claims if claim.by_hand]
    lines = [line for text in by_hand for line in text.split("; ")]
    assert len(lines) == 6
    for line in lines:
        match = LINE.match(line)
        assert match is not None, line
        interval = parse(match["right"]).interval()
        value = F(arithmetic(match["left"]))
        # The last line multiplies numbers that stand there with five digits.
        slack = value / 10**4 if line is lines[2] or line is lines[5] else 0
        assert interval.meets(type(interval)(value - slack, value + slack)), line


def test_numbers_and_symbols_are_marked_as_such(record: Record) -> None:
    formulas = [equation.mathml for equation in record.equations]
    formulas += [claim.mathml for claim in record.claims if claim.mathml]
    for formula in formulas:
        for tag, text in re.findall(
            r"<(m[ni])>([^<]+)</m[ni]>", re.sub("<msub>.*?</msub>", "", formula)
        ):
            assert (tag == "mn") == text[0].isdigit(), text


def test_what_no_source_has_or_more_than_one_is_refused_by_name() -> None:
    for sources in ((), 2 * (Figure(means="", value=1.0, unit="m"),)):
        with pytest.raises(TypeError, match=f"Figure.unit: {len(sources)} sources"):
            filled(Figure, *sources, means="depth", value=2.0)


def test_a_misprint_that_fails_by_another_equation_shows_that_equation() -> None:
    """Eq. 11 alone gives alpha; beta takes two equations, so that no single one shows it."""
    spoiled = audit(LEDGER.misprint("yield-strength", "251"))
    alpha, beta = (spoiled.claim(f"walker-anderson-{name}") for name in ("alpha", "beta"))
    assert alpha.verdict == beta.verdict == "not reproduced"
    assert alpha.by_hand is not None
    assert arithmetic(alpha.by_hand.removesuffix(".").rpartition(" = ")[0]) == pytest.approx(
        alpha.computed, rel=1e-3
    )
    assert beta.by_hand is None


# The same bytes

ELSEWHERE = (
    {"PYTHONHASHSEED": "0", "TZ": "UTC", "LC_ALL": "C", "OMP_NUM_THREADS": "1"},
    {"PYTHONHASHSEED": "7", "TZ": "Asia/Kathmandu", "LC_ALL": "C.UTF-8", "PYTHONOPTIMIZE": "1"},
)


@pytest.mark.slow
def test_an_audit_elsewhere_has_the_same_bytes(tmp_path: Path) -> None:
    folders = []
    for number, environment in enumerate(ELSEWHERE):
        folder = tmp_path / str(number) / "here"
        folder.mkdir(parents=True)
        command = [sys.executable, "-m", "replication", "audit", "--quiet", "--out", "out"]
        subprocess.run(command, cwd=folder, env={**os.environ, **environment}, check=True)
        folders.append({p.relative_to(folder): p.read_bytes() for p in folder.rglob("*.*")})
    first, second = folders
    assert {path.name for path in first} >= {
        "audit.json", "audit.html", "audit.md", "audit.csv", "workbook.xlsx", "hard-cases.txt",
    }  # fmt: skip
    assert [str(path) for path in first if first[path] != second.get(path)] == []
    assert set(first) == set(second)


# What the depth depends on, and what scatter does to it

INPUTS = ("velocity", "radius", "particle_density", "target_density", "beta", "flow_stress")


def ratio(impact: Impact) -> float:
    return depth.final_depth(**impact.motion) / impact.radius


IMPACTS = st.builds(
    Impact,
    velocity=st.floats(1, 5000),
    radius=st.floats(1e-7, 1e-2),
    particle_density=st.floats(500, 25000),
    target_density=st.floats(500, 25000),
    beta=st.floats(1, 8),
    flow_stress=st.floats(1e7, 5e9),
)


@given(IMPACTS, st.sampled_from(INPUTS))
def test_elasticities_are_the_slopes_of_the_reference(impact: Impact, name: str) -> None:
    if abs(ratio(impact) - 1) < 1e-6:
        return  # the second derivative jumps at y = 1, so that differences across it are coarser
    h = Fraction(1, 10**12)

    def log_depth(share: Fraction) -> mpmath.mpf:
        inputs = {key: Fraction(getattr(impact, key)) for key in INPUTS}
        inputs[name] *= 1 + share
        resistance = inputs.pop("beta") * inputs.pop("flow_stress")
        return mpmath.log(Trajectory(**inputs, resistance=resistance, digits=50).final_depth)

    with mpmath.workdps(50):
        slope = (log_depth(h) - log_depth(-h)) / 2 * h.denominator
    # The difference is off by its h^2, the closed form by rounding, most where q - 1 cancels.
    assert comparison._elasticities(impact)[name] == pytest.approx(
        float(slope), rel=1e-9, abs=1e-12
    )


def test_quantiles_of_each_law(record: Record) -> None:
    laws = {law.law.partition(":")[0]: law for law in record.scatter}
    sizes = NormalDist(22, 5.6)
    for law, power in (("Eq. 1", 1.5), ("drag on a sphere", 0.5)):
        points = laws[law]
        for share, velocity, own in zip(
            points.shares, points.velocities, points.ratios, strict=True
        ):
            size = sizes.inv_cdf(1 - share)
            assert velocity == pytest.approx(500 * (22 / size) ** power, rel=1e-14)
            assert own == ratio(replace(BETA_5, velocity=velocity))
        small = 22 - 1e-4, 22 + 1e-4  # the law's own slope at the mean size
        faster, slower = (500 * (22 / size) ** power for size in small)
        slope = (faster - slower) / (small[1] - small[0])
        assert laws[law].standard_deviation == pytest.approx(slope * 5.6, rel=1e-9)


def test_each_step_of_the_sheets_error_is_half_of_the_last(record: Record) -> None:
    ladders = {(beta, scheme): list[Level]() for beta, scheme in product((3.0, 5.0), SCHEMES)}
    for level in record.ladders:
        ladders[level.beta, level.scheme].append(level)
    for (beta, scheme), levels in ladders.items():
        assert BETA_5.step in [level.step for level in levels]
        assert all(fine.step == coarse.step / 2 for coarse, fine in pairwise(levels))
        for level in levels:
            sheet = run(replace(CASES[f"beta-{beta:.0f}"], step=level.step), scheme)
            assert (level.depth, level.steps) == (sheet.final_depth, sheet.steps)


def test_figure_5_is_drawn_from_end_to_end(record: Record) -> None:
    ledger, curve = load(), record.velocity_curve
    ends = ("figure-5-velocity-least", "figure-5-velocity-greatest")
    assert [curve.velocity[0], curve.velocity[-1]] == [float(ledger.value(end)) for end in ends]
