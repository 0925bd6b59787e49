"""What failed or surprising claims teach. The evidence is computed anew with every audit."""

import math
from dataclasses import dataclass
from fractions import Fraction

from reference.enclosure import explore
from reference.exact import Arithmetic, Number
from reference.ledger import Ledger
from reference.printed import Interval
from replication.audit.entries import rounding, value
from replication.audit.inference import Inference, infer
from replication.audit.verdict import Assessment
from replication.text import inward, number, outward

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
            f"With the work done on the way in, Eqs. 14 and 15 give X = (L rho_p + k_1 rho_t D) "
            f"ln(1 + k_t rho_t V^2 / R_t) / (2 k_t rho_t). Divided by D this is the right side of "
            f"Eq. 16; divided by R, as its left side says, it is twice that. As printed it gives "
            f"{armor.reading.computed:.3f} and {stainless.reading.computed:.3f}, as "
            f"derived {armor.others[0].computed:.3f} and "
            f"{stainless.others[0].computed:.3f}, for 0.278 and 0.297: neither form gives "
            f"0.278, and only the derived one comes near 0.297."
        ),
    )


def _log_ratio(ar: Arithmetic, drag: Number, armor: Number, stainless: Number) -> Number:
    """X/R at one target resistance over X/R at the other; drag is k_t rho_t V^2, all in Pa."""
    return ar.context.log(1 + drag / stainless) / ar.context.log(1 + drag / armor)


def _frank_zook_pair(ledger: Ledger) -> Finding:
    lower, upper = (ledger.claims[f"frank-zook-{name}"] for name in ("rha", "stainless"))
    printed = _ratio(lower.interval, upper.interval)
    names = {"armor": "fz-resistance-rha", "stainless": "fz-resistance-stainless"}
    strengths = {key: rounding(ledger, name, loose=True) for key, name in names.items()}
    drag = _drag(ledger)
    found = explore(_log_ratio, {"drag": drag, **strengths}, printed)
    # Octave by octave, as the ratio's two logarithms both vanish with the drag.
    octaves = [(_PAIR_BOUND / 2 ** (k + 1), _PAIR_BOUND / 2**k) for k in range(_PAIR_OCTAVES)]
    never = all(explore(_log_ratio, {"drag": ends, **strengths}, printed).never for ends in octaves)
    outcome = "no one set of inputs gives both" if never else "one set may give both"
    velocity = value(ledger, "a1-initial-velocity")
    fastest = float(velocity) * math.sqrt(_PAIR_BOUND / drag[1])
    return Finding(
        id="frank-zook-pair",
        title="0.278 and 0.297 do not belong together",
        kind="inconsistent pair",
        claims=(lower.id, upper.id),
        evidence=(
            f"Between the two only R_t changes, so everything in Eq. 16 but the logarithm cancels "
            f"from their ratio, the left side and any constant factor too. The printed pair has "
            f"the ratio {outward(*_ends(printed))}. With k_t rho_t V^2 in "
            f"{outward(drag[0] / 10**9, drag[1] / 10**9, 4)} GPa, as the report's inputs and any "
            f"possible target density have it, the ratio is {outward(found.lower, found.upper)}; "
            f"at lower velocities it is higher, and up to {int(fastest)} m/s it is "
            f"{'proven' if never else 'not proven'} to stay above the printed one: {outcome}."
        ),
    )


_PAIR_BOUND = Fraction(60 * 10**9)
_PAIR_OCTAVES = 12
"""The drags of which `explore` proves that they cannot give the pair; no results themselves."""


def _drag(ledger: Ledger) -> tuple[Fraction, Fraction]:
    """Least and greatest k_t rho_t V^2 [Pa] of inputs that print like the report's."""
    k_t, velocity = rounding(ledger, "fz-kt"), rounding(ledger, "a1-initial-velocity")
    density = _ends(infer(ledger, "target-density").possible)
    low, high = (k_t[end] * density[end] * velocity[end] ** 2 for end in (0, 1))
    return low, high


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
    words: dict[str, list[str]] = {verdict: [] for _, verdict in inference.handbook.values()}
    for name, (printed, verdict) in inference.handbook.items():
        words[verdict].append(f"{name} ({number(printed.value)})")
    listed = ". ".join(f"{verdict.capitalize()}: {', '.join(n)}" for verdict, n in words.items())
    low, high = _ends(inference.inner)
    return Finding(
        id="target-density",
        title=(
            "The target density is printed nowhere; Table A-1 admits "
            f"{number(low, 5)} to {number(high, 5)} {entry.unit}"
        ),
        kind="unstated input",
        claims=entry.evidence,
        evidence=(
            f"With the header of Table A-1 exactly as printed, its accelerations and velocities "
            f"admit {inward(*_ends(inference.inner), 8)} {entry.unit} (with the printed mass in "
            f"place of the computed one {inward(*_ends(inference.with_mass), 8)}), and "
            f"{inward(*_ends(inference.with_results), 8)} serves both final depths as well. If "
            f"radius, particle density and resistance may be anything that prints like the header, "
            f"densities as far apart as {inward(*_ends(inference.attained))} give the table; of "
            f"those from {number(entry.search[0])} to "
            f"{number(entry.search[1])} none outside {outward(*_ends(inference.possible))} does. "
            f"Handbook values are rounded, too (7.8 g/cm3 is 7750 to 7850). {listed}. The audit "
            f'computes with {number(entry.nominal)}, and every verdict "reproduced" holds for all '
            f"densities that the table admits."
        ),
    )


def _coarse_step(assessments: dict[str, Assessment]) -> Finding:
    (before_3, after_3), (before_5, after_5) = (_depths(assessments, beta) for beta in (3, 5))
    return Finding(
        id="coarse-step",
        title="At 0.5 ns one of the two final depths prints differently",
        kind="method",
        claims=("coarse-step-beta-3", "coarse-step-beta-5", "depth-beta-3", "depth-beta-5"),
        evidence=(
            f"From 0.2 to 0.5 ns the depth changes by {100 * (after_3 / before_3 - 1):.2f} % for "
            f"beta = 3, from {before_3:.1f} to {after_3:.1f} um as printed, and by "
            f"{100 * (after_5 / before_5 - 1):.2f} % for beta = 5, from {before_5:.2f} to "
            f"{after_5:.2f} um. The report does not say what it calls significant; a printed digit "
            f"changes only for beta = 5."
        ),
    )


def _depths(assessments: dict[str, Assessment], beta: int) -> tuple[float, float]:
    """Final depth at the published and at the coarse step [um]."""
    published = assessments[f"depth-beta-{beta}"].reading
    coarse = assessments[f"coarse-step-beta-{beta}"].reading
    assert published is not None
    assert coarse is not None
    return published.computed, coarse.computed
