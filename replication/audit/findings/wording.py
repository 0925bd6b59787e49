"""What the report says twice, or of the wrong equation."""

import re
from fractions import Fraction

from reference.exact import centerline_stress
from reference.ledger import Ledger
from replication.audit.findings.known import Computed, Known

__all__ = ["EVIDENCE"]


def _wrong_reference(known: Known) -> Computed:
    density, velocity = known.exact("inferred:target-density"), known.exact("a1-initial-velocity")
    strength = known.exact("a1-resistance")
    return {
        "stress": r"\Sigma" in _equation(known.ledger, "1"),
        "difference": centerline_stress(density, velocity, strength)
        - _equation_5(known, density, velocity, strength),
        "times": _times(known.ledger, "equation 1 reduces"),
        "caption": _times(known.ledger, "500-m/s steel"),
    }


def _minimum_velocity(known: Known) -> Computed:
    return {
        "section_2": _times(
            known.ledger, "would certainly be higher than 403 m/s, but less than 521 m/s"
        ),
        "section_4": _times(known.ledger, "only faster-than-average particles were adhering"),
    }


def _times(ledger: Ledger, words: str) -> Fraction:
    """How often the report says so, line breaks aside."""
    return Fraction(" ".join(ledger.text.split()).count(words))


def _equation(ledger: Ledger, number: str) -> str:
    """The text of one numbered equation."""
    text: str = next(
        text
        for text, found in re.findall(r"\$\$(.*?)\\quad \((\d+)\)", ledger.text, re.DOTALL)
        if found == number
    )
    return text


def _equation_5(known: Known, density: Fraction, u: Fraction, strength: Fraction) -> Fraction:
    """Right side of Eq. 5, with the factor and the power that the report prints there."""
    factor, power = known.exact("eq5-factor-target"), known.exact("eq5-power-target")
    return factor * density * u ** int(power) + strength


EVIDENCE = {"wrong-reference": _wrong_reference, "minimum-velocity": _minimum_velocity}
