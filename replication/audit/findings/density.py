"""The target density, which the report never prints."""

from fractions import Fraction

from replication.audit.findings.known import Computed, Known
from replication.audit.inference import infer

__all__ = ["EVIDENCE"]


def _target_density(known: Known) -> Computed:
    inference = infer(known.ledger, "target-density")
    least, greatest = inference.inner.ends
    possible_least, possible_greatest = inference.possible.ends
    verdicts = {name: verdict for name, (_, verdict) in inference.handbook.items()}
    return {
        "least": least,
        "greatest": greatest,
        "carbon": inference.inner.contains(Fraction(7850)),
        "armor": inference.inner.contains(Fraction(7860)),
        "depths": inference.with_results == inference.inner,
        "excluded_793": verdicts["304 stainless steel, as 7.93 g/cm3"] == "excluded",
        "excluded_80": verdicts["304 stainless steel, as 8.0 g/cm3"] == "excluded",
        "exact_79": not inference.outer.excludes(Fraction(7900), Fraction(7900)),
        "possible_least": possible_least,
        "possible_greatest": possible_greatest,
        "mass_greatest": inference.with_mass.ends[1],
    }


EVIDENCE = {"target-density": _target_density}
