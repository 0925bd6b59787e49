"""Every approach to the normalized depth X/R that the report takes, side by side."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from reference.ledger import Ledger
from replication.audit.entries import value
from replication.audit.verdict import Assessment
from replication.cases import CASES
from replication.models import crater
from replication.models.depth import final_depth
from replication.models.impact import Impact

__all__ = ["Approach", "approaches"]


@dataclass(frozen=True, slots=True)
class Approach:
    """One normalized depth X/R [1].

    `kind` is what it comes from. `computed` is ours, None for a code whose input and output the
    report does not give; `printed` is the text of the report for it, "" if there is none, and
    `claim` the ledger's name of what is printed.
    """

    kind: str
    name: str
    computed: float | None
    printed: str = ""
    claim: str | None = None

    @property
    def recomputable(self) -> bool:
        """Whether the report gives what it takes to compute it."""
        return self.computed is not None


def approaches(ledger: Ledger, assessments: Mapping[str, Assessment]) -> list[Approach]:
    """All of them: observed, the sheet, its exact solution, Frank and Zook, the two hydrocodes."""
    return [
        *_observed(ledger, assessments),
        *_assessed(assessments, "sheet", "ratio-beta-3", "beta = 3"),
        *_assessed(assessments, "sheet", "ratio-beta-5", "beta = 5"),
        *(Approach("exact", f"beta = {case.beta:g}", _exact(case)) for case in CASES.values()),
        *_assessed(assessments, "Frank-Zook", "frank-zook-rha", "armor"),
        *_assessed(assessments, "Frank-Zook", "frank-zook-stainless", "stainless steel"),
        _quoted(ledger, "hydrocode", "cth-ratio", "CTH"),
        _quoted(ledger, "hydrocode", "autodyne-ratio", "Autodyne"),
    ]


def _observed(ledger: Ledger, assessments: Mapping[str, Assessment]) -> Iterator[Approach]:
    line, text = "volume-ratio-line", ledger.claims["volume-ratio-line"].text
    depth = float(crater.depth_from_volume_ratio(float(value(ledger, line))))
    yield Approach("observed", f"CV/PV = {text}, the line in Figure 1", depth)
    yield from _assessed(
        assessments,
        "observed",
        "observed-depth-ratio",
        f"CV/PV = {ledger.claims['volume-ratio'].text}, as taken for Eq. 4",
    )


def _assessed(
    assessments: Mapping[str, Assessment], kind: str, claim: str, name: str
) -> Iterator[Approach]:
    """What the audit computed for a claim, by each of its readings."""
    assessment = assessments[claim]
    printed = assessment.claim.text
    assert assessment.reading is not None
    first = f"{name}, as printed" if assessment.others else name
    yield Approach(kind, first, assessment.reading.computed, printed, claim)
    for other in assessment.others:
        yield Approach(kind, f"{name}, {other.name}", other.computed, printed, claim)


def _exact(case: Impact) -> float:
    return float(final_depth(**case.motion)) / case.radius


def _quoted(ledger: Ledger, kind: str, claim: str, name: str) -> Approach:
    return Approach(kind, name, None, ledger.claims[claim].text, claim)
