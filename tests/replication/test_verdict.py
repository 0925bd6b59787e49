"""A verdict names its conventions and has witnesses; the target density is what the table tells."""

import math
import random
from collections.abc import Iterator
from fractions import Fraction as F
from functools import cache
from itertools import pairwise
from typing import Any

import pytest
from kept import calls

from reference.enclosure import satisfying
from reference.ledger import Convention, load
from replication.audit import verdict, wording
from replication.audit.explain import Explainer
from replication.audit.inference import Inference
from replication.audit.record import Record, SlipRecord
from replication.audit.replica import REPLICA, replica
from replication.audit.verdict import Assessment, Judge, Judgement, Verdict
from replication.models import sheet
from replication.models.impact import Impact

LEDGER = load()
JUDGE = Judge(LEDGER)


def test_no_inputs_drawn_at_random_leave_what_is_called_proven() -> None:
    draw = random.Random(2006)
    for claim in map(LEDGER.claims.__getitem__, ("frank-zook-rha", "frank-zook-stainless")):
        for reading in JUDGE.assess(claim).readings:
            model = REPLICA[claim.computations[reading.name].name]
            for judgement in reading.judgements:
                box = JUDGE.box(claim, judgement.convention)
                for _ in range(50):
                    at = {
                        key: float(draw.choice([low, high, low + (high - low) * F(draw.random())]))
                        for key, (low, high) in box.items()
                    }
                    value = F(model(**{key: at[entry] for key, (entry,) in claim.inputs.items()}))
                    slack = value / 10**14  # some roundings of a double
                    assert judgement.ends[0] - slack <= value <= judgement.ends[1] + slack


# Witnesses


def witnesses() -> Iterator[tuple[str, str, Judgement]]:
    for claim in LEDGER.claims.values():
        if claim.computation is not None and not claim.computation.restates:
            for reading in JUDGE.assess(claim).readings:
                for judgement in reading.judgements:
                    if judgement.witness is not None:
                        yield claim.id, reading.name, judgement


def test_a_witness_prints_like_the_report_and_gives_the_number() -> None:
    result = list(witnesses())
    assert len(result) > 10
    for name, reading, judgement in result:
        claim, convention, witness = LEDGER.claims[name], judgement.convention, judgement.witness
        assert witness is not None
        for entry in claim.stated:
            assert LEDGER.claims[entry].as_input(convention).contains(witness[entry]), (name, entry)
        computation = claim.computations[reading]
        inputs = {}
        for key, entries in claim.inputs.items():
            inputs[key] = 1.0
            for entry in entries:
                inputs[key] *= float(witness[entry])
        settings: dict[str, object] = {"row": claim.row} if computation.by_row else {}
        if computation.by_scheme:
            settings["scheme"] = "centered" if convention.centered else "published"
        value = F(replica(computation.name, inputs, **settings))
        margin = abs(value) * F(1, 10**12)  # a double may fall a rounding short of an end
        target = claim.target(convention.rounding)
        assert not target.excludes(value - margin, value + margin), name
        for entry in claim.inferred:
            inference = JUDGE.inference(entry, centered=convention.centered)
            constraints, box = inference.joint(convention, {entry: (witness[entry],) * 2})
            there = {name: (witness.get(name, low), witness.get(name, high))
                     for name, (low, high) in box.items()}  # fmt: skip
            assert satisfying(constraints, there)[0] is True, name


def test_a_number_of_unclear_digits_says_which_were_taken(record: Record) -> None:
    (said,) = [text for text in record.claim("a1-velocity-initial-1").assumes if "digits" in text]
    assert said == "all digits of 500 taken as significant; the verdict does not depend on that"


# What the table tells of the target density, and what it does not; a bad witness is named

DENSITY = "inferred:target-density"
CELLS = {f"a1-{column}-{row}": (column.replace("-", "_"), row)
         for column in ("deceleration", "velocity-final") for row in range(1, 5)}  # fmt: skip


@cache
def inference(centered: bool = False) -> Inference:
    return Inference(LEDGER, DENSITY, centered=centered)


def impact(**changed: Any) -> Impact:
    own = {name: float(LEDGER.value(f"a1-{claim}")) for name, claim in (
        ("velocity", "initial-velocity"), ("radius", "radius"), ("particle_density", "density"),
        ("resistance", "resistance"))}  # fmt: skip
    return Impact(
        **{**own, "target_density": 7850.0, "step": 2e-10, "stop_velocity": 1.0, **changed}
    )


def cells(case: Impact, centered: bool = False) -> dict[str, float]:
    rows = sheet.run(case, "centered" if centered else "published").rows
    return {name: getattr(rows[row], column) for name, (column, row) in CELLS.items()}


def density_where(cell: str, value: float, centered: bool) -> float:
    """By bisection in the models' doubles."""
    low, high = 7000.0, 9000.0
    for _ in range(60):
        middle = (low + high) / 2
        lower = cells(impact(target_density=middle), centered)[cell] < value
        low, high = (middle, high) if lower else (low, middle)
    return low


@pytest.mark.parametrize("centered", [False, True])
def test_the_table_admits_a_stretch_that_single_cells_end(centered: bool) -> None:
    own = inference(centered)
    assert own.agreeing == tuple(CELLS)
    assert own.odd == ()
    (low, high), (outer_low, outer_high) = own.inner.ends, own.outer.ends
    assert outer_low <= low < high <= outer_high
    assert high - low > (outer_high - outer_low) * (1 - F(1, 10**9))
    # Where these two begin to print otherwise.
    assert float(low) == pytest.approx(
        density_where("a1-deceleration-2", 929.5e6, centered), rel=1e-9
    )
    assert float(high) == pytest.approx(
        density_where("a1-deceleration-1", 311.5e6, centered), rel=1e-9
    )


def test_what_more_is_known_narrows_it_and_rounding_widens_it() -> None:
    own = inference()
    with_mass = own.with_mass.ends
    assert [float(end) for end in with_mass] == pytest.approx([7825.14, 7848.857], abs=0.01)
    ranges = [own.inner, own.admitted(Convention()), own.admitted(Convention(choices_exact=False))]
    for narrow, wide in pairwise(ranges):
        assert wide.ends[0] <= narrow.ends[0] < narrow.ends[1] <= wide.ends[1]
    assert own.admitted(Convention(header_exact=True)) == own.outer


@pytest.mark.parametrize("choices_exact", [True, False])
def test_no_table_drawn_at_random_leaves_what_is_called_possible(choices_exact: bool) -> None:
    convention = Convention(choices_exact=choices_exact)
    possible = inference().admitted(convention)
    draw, kept = random.Random(304), []
    low, high = map(float, possible.ends)

    def drawn(name: str) -> float:
        ends = [float(end) for end in inference().rounded(name, convention)]
        return draw.choice([*ends, draw.uniform(*ends)])

    for _ in range(120):
        velocity, particle, mass, resistance, step = map(drawn, (
            "a1-initial-velocity", "a1-density", "a1-mass", "a1-resistance", "a-step"))  # fmt: skip
        radius = math.cbrt(3 * mass / (4 * math.pi * particle))
        for k in range(-20, 61):
            density = low + (high - low) * k / 40
            case = impact(velocity=velocity, radius=radius, particle_density=particle,
                          resistance=resistance, step=step, target_density=density)  # fmt: skip
            shown = {"a1-diameter": 2 * radius, "a1-radius": radius, **cells(case)}
            if all(LEDGER.claims[n].target().contains(F(v)) for n, v in shown.items()):
                kept.append(density)
    assert low <= min(kept) < max(kept) <= high
    assert max(kept) - min(kept) > 0.5 * (high - low)


def serves(convention: Convention, point: dict[str, F]) -> bool | None:
    """Whether the evidence can hold at a point, other inputs within their rounding."""
    density = point.pop(DENSITY)
    constraints, box = inference().joint(convention, {DENSITY: (density, density)})
    return satisfying(constraints, {**box, **{name: (x, x) for name, x in point.items()}})[0]


def test_a_number_that_contradicts_the_evidence_is_not_said_to_lie_outside_its_range() -> None:
    """Some density gives 2.17E+09 in row 4, but not the other cells."""
    ledger = LEDGER.misprint("a1-deceleration-4", "2.17E+09")
    judge, claim = Judge(ledger, every_convention=False), ledger.claims["a1-deceleration-4"]
    assessed = judge.assess(claim)
    judgement = assessed.readings[0].judgements[0]
    assert judgement.verdict is Verdict.NOT_REPRODUCED
    assert judgement.against_evidence
    assert not claim.interval().excludes(*judgement.ends)
    said = wording.explanation(judge, claim, assessed)
    assert "no inputs that give this number also give the numbers" in said
    assert "all of it" not in said
    assert "none of it" not in said


# Other numbers than the report's


@cache
def judge(name: str, text: str) -> Judge:
    """What judges the report with a misprint."""
    return Judge(LEDGER.misprint(name, text))


def judged(name: str, text: str, claim: str) -> Assessment:
    return judge(name, text).assess(judge(name, text).ledger.claims[claim])


def slips(name: str, text: str) -> list[SlipRecord]:
    """Other readings of an equation, tried for a claim that is misprinted."""
    return Explainer(judge(name, text)).slips(judge(name, text).ledger.claims[name])


test_what_evidence_allows_and_how_misprints_are_judged = calls(
    "replication/kept.txt", "Evidence, and misprints judged", vars(verdict) | globals()
)
