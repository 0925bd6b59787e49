"""What the evidence is computed from: the ledger's numbers, the verdicts, the report's cases."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from reference.ledger import Ledger
from replication.audit.entries import value
from replication.audit.verdict import Assessment, Reading
from replication.cases import BETA_5
from replication.models.depth import final_depth

__all__ = ["Computed", "Known", "model_ratio"]

Computed = Mapping[str, Fraction | float | bool]
"""Evidence by name, in SI units."""


@dataclass(frozen=True, slots=True)
class Known:
    """The ledger and the verdicts on its claims."""

    ledger: Ledger
    assessments: Mapping[str, Assessment]

    def exact(self, name: str) -> Fraction:
        """An entry as printed, in SI."""
        return value(self.ledger, name)

    def number(self, name: str) -> float:
        """An entry as printed, in SI, as a double."""
        return float(self.exact(name))

    def reading(self, claim: str, other: str = "") -> Reading:
        """The reading of a claim that its verdict comes from, or another by its name."""
        assessment = self.assessments[claim]
        readings = [r for r in (assessment.reading, *assessment.others) if r is not None]
        return next(reading for reading in readings if reading.name == other)

    def computed(self, claim: str, other: str = "") -> float:
        """What a reading makes of a claim, in SI."""
        return self.reading(claim, other).computed * float(self.ledger.claims[claim].si)

    def prints(self, claim: str, computed: float) -> bool:
        """Whether a number, in SI, agrees with what a claim prints."""
        return self.ledger.claims[claim].target.contains(Fraction(computed))


def model_ratio(**changed: float) -> float:
    """The model's exact X/R [1] for beta = 5, with some inputs of the motion changed."""
    motion = {**BETA_5.motion, **changed}
    return float(final_depth(**motion)) / motion["radius"]
