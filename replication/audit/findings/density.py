"""The target density, which the report never prints."""

from replication.audit.findings.known import Computed, Known, known_interval
from replication.audit.inference import infer

__all__ = ["EVIDENCE"]


def _target_density(known: Known) -> Computed:
    inference = infer(known.ledger, "target-density")
    least, greatest = known_interval(inference.inner)
    possible_least, possible_greatest = known_interval(inference.possible)
    verdicts = {name: verdict for name, (_, verdict) in inference.handbook.items()}
    return {
        "least": least,
        "greatest": greatest,
        "carbon": verdicts["plain carbon steel"] == "admitted",
        "excluded": verdicts["304 stainless steel, as 8.0 g/cm3"] == "excluded",
        "possible_least": possible_least,
        "possible_greatest": possible_greatest,
        "mass_greatest": known_interval(inference.with_mass)[1],
    }


EVIDENCE = {"target-density": _target_density}
