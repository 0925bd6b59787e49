"""What failed or surprising claims teach. The evidence is computed anew with every audit."""

from dataclasses import dataclass
from fractions import Fraction

from reference.enclosure import explore
from reference.exact import Arithmetic, Number
from reference.ledger import Ledger
from reference.printed import Interval
from replication.audit.inference import Inference, infer
from replication.audit.verdict import Assessment
from replication.text import number, outward

__all__ = ["Finding", "findings"]


@dataclass(frozen=True, slots=True)
class Finding:
    """One lesson: what kind it is, the claims it touches, and the numbers that show it."""

    id: str
    title: str
    kind: str
    claims: tuple[str, ...]
    evidence: str


def findings(ledger: Ledger, assessments: dict[str, Assessment]) -> list[Finding]:
    """All findings, the weightiest first."""
    return [
        _equation_16(assessments),
        _frank_zook_pair(ledger),
        _target_density(infer(ledger, "target-density")),
        _coarse_step(assessments),
    ]


def _equation_16(assessments: dict[str, Assessment]) -> Finding:
    armor, stainless = assessments["frank-zook-rha"], assessments["frank-zook-stainless"]
    assert armor.reading is not None
    assert stainless.reading is not None
    return Finding(
        id="equation-16",
        title="Eq. 16 prints X/R before what Eqs. 14 and 15 give for X/D",
        kind="formula",
        claims=("eq16-denominator", "frank-zook-rha", "frank-zook-stainless"),
        evidence=(
            f"As printed it gives {number(armor.reading.computed, 4)} and "
            f"{number(stainless.reading.computed, 4)} for 0.278 and 0.297. Solved from Eqs. 14 "
            f"and 15, X/R is twice that, {number(armor.others[0].computed, 4)} and "
            f"{number(stainless.others[0].computed, 4)}: the 2 before k_t belongs to X/D. So the "
            f"printed values stem from the derived form or another, not from Eq. 16 as printed."
        ),
    )


def _log_ratio(
    ar: Arithmetic, armor: Number, stainless: Number, k_t: Number, target_density: Number,
    velocity: Number,
) -> Number:  # fmt: skip
    """X/R at one target resistance over X/R at the other: all else in Eq. 16 cancels."""
    drag = k_t * target_density * velocity**2
    return ar.context.log(1 + drag / stainless) / ar.context.log(1 + drag / armor)


def _frank_zook_pair(ledger: Ledger) -> Finding:
    lower, upper = (ledger.claims[f"frank-zook-{name}"] for name in ("rha", "stainless"))
    printed = _ratio(lower.interval, upper.interval)
    inputs = {"armor": "fz-resistance-rha", "stainless": "fz-resistance-stainless",
              "k_t": "fz-kt", "velocity": "a1-initial-velocity"}  # fmt: skip
    intervals = {key: ledger.claims[name].as_input() for key, name in inputs.items()}
    intervals["target_density"] = infer(ledger, "target-density").outer
    found = explore(_log_ratio, {k: _ends(v) for k, v in intervals.items()}, printed)
    outcome = "no one set of inputs gives both" if found.never else "one set can give both"
    return Finding(
        id="frank-zook-pair",
        title="0.278 and 0.297 do not belong together",
        kind="inconsistent pair",
        claims=(lower.id, upper.id),
        evidence=(
            f"Between the two only R_t changes, so everything in Eq. 16 but the logarithm cancels "
            f"from their ratio, the left side and any constant factor too. The printed pair has "
            f"the ratio {outward(*_ends(printed))}; inputs that print like the report's give "
            f"{outward(found.lower, found.upper)}: {outcome}."
        ),
    )


def _ratio(below: Interval | None, above: Interval | None) -> Interval:
    assert below is not None
    assert above is not None
    (low, high), (lower, upper) = _ends(below), _ends(above)
    return Interval(lower / high, upper / low)


def _ends(interval: Interval) -> tuple[Fraction, Fraction]:
    assert interval.lower is not None
    assert interval.upper is not None
    return interval.lower, interval.upper


def _target_density(inference: Inference) -> Finding:
    entry = inference.entry
    listed = {
        admits: [f"{name} {number(value)}" for name, (value, a) in inference.handbook.items()
                 if a is admits]
        for admits in (True, False)
    }  # fmt: skip
    low, high = _ends(inference.inner)
    return Finding(
        id="target-density",
        title="The target density is printed nowhere; Table A-1 excludes that of 304 stainless",
        kind="unstated input",
        claims=entry.evidence,
        evidence=(
            f"With the header of Table A-1 as printed, its accelerations and velocities admit "
            f"{number(low, 8)} to {number(high, 8)} {entry.unit} and nothing else. Inside: "
            f"{'; '.join(listed[True])}. Outside: {'; '.join(listed[False])}. The audit computes "
            f"with {number(entry.nominal)} and checks that no verdict depends on the choice."
        ),
    )


def _coarse_step(assessments: dict[str, Assessment]) -> Finding:
    (change_3, before_3, after_3), (change_5, before_5, after_5) = (
        _depths(assessments, beta) for beta in (3, 5)
    )
    return Finding(
        id="coarse-step",
        title="At 0.5 ns the final depth prints differently in its third digit",
        kind="method",
        claims=("coarse-step-beta-3", "coarse-step-beta-5", "depth-beta-3", "depth-beta-5"),
        evidence=(
            f"From 0.2 to 0.5 ns the final depth changes by {number(change_3, 3)} um for beta = 3, "
            f"from {before_3:.1f} to {after_3:.1f} as printed, and by {number(change_5, 3)} um "
            f"({100 * change_5 / before_5:.2f} %) for beta = 5, from {before_5:.2f} to "
            f"{after_5:.2f}. Both agree to two digits; whether the change is significant depends "
            f"on the third, which is printed."
        ),
    )


def _depths(assessments: dict[str, Assessment], beta: int) -> tuple[float, float, float]:
    """Change of the final depth, and the depth at the published and at the coarse step [um]."""
    change = assessments[f"coarse-step-beta-{beta}"].reading
    depth = assessments[f"depth-beta-{beta}"].reading
    assert change is not None
    assert depth is not None
    return change.computed, depth.computed, depth.computed + change.computed
