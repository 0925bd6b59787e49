"""What an audit derives from a ledger: verdicts and explanations, and values to compute with."""

from fractions import Fraction
from functools import cache, partial

from reference.ledger import READ_AS_PRINTED, Ledger, claims_of_case
from reference.printed import decimal_text
from reference.units import to_si
from replication.audit.assessment import Reading, Verdict
from replication.audit.explain import Explainer
from replication.audit.inference import DENSITY
from replication.audit.slips import slips_tried
from replication.audit.verdict import Judge
from replication.models import depth
from replication.models.estimates import constant_pressure_depth
from replication.models.impact import Impact
from replication.text import number

DERIVED = "derived from Eqs. 14 and 15"
"""The name of the reading of Eq. 16 that does not take it as printed."""


class Results:
    """A ledger and what is derived from it, such as verdicts; each result is computed once."""

    def __init__(self, ledger: Ledger, *, every_convention: bool = True) -> None:
        self.ledger = ledger
        self.judge = Judge(ledger, every_convention=every_convention)
        self.explainer = Explainer(self.judge)
        self.slips = cache(partial(slips_tried, self.judge))

    def exact(self, name: str) -> Fraction:
        """Return a claim's printed, an inferred input's assumed, or a source's value, in SI."""
        sources = self.ledger.sources
        return sources[name].value if name in sources else self.judge.value(name)

    def __getitem__(self, name: str) -> float:
        """Return the value that `exact` gives, as a double."""
        return float(self.exact(name))

    def text(self, name: str, unit: str | None = None) -> str:
        """Return the number of a claim or a source as it is printed, or as a decimal in a unit.

        >>> from reference.ledger import load
        >>> results = Results(load())
        >>> results.text("a1-resistance"), results.text("a1-resistance", "GPa")
        ('3.50E+09', '3.5')
        """
        if unit is not None:
            return decimal_text(self.exact(name) / to_si(unit))
        sources = self.ledger.sources
        return sources[name].says if name in sources else self.ledger.claims[name].shown

    def last_digit(self, claim: str) -> Fraction:
        """Return the unit of a claim's last printed digit, in SI."""
        return self.ledger.claims[claim].number.quantum * self.ledger.claims[claim].si

    def computed(self, claim: str, reading: str = READ_AS_PRINTED) -> float:
        """Return what the models compute for a claim by one of its readings, in SI."""
        return self.reading(claim, reading).computed * float(self.ledger.claims[claim].si)

    def verdict(self, name: str) -> Verdict:
        """Return the verdict on a claim or an equation."""
        if name in self.ledger.equations:
            return self.judge.assess_equation(name).verdict
        return self.judge.assess(self.ledger.claims[name]).verdict

    def verdicts(self, prefix: str) -> set[Verdict]:
        """Return the verdicts on all computed claims whose ids begin so."""
        claims = self.ledger.claims.values()
        computed = (c.id for c in claims if c.is_computed and c.id.startswith(prefix))
        return {self.verdict(name) for name in computed}

    def reading(self, claim: str, name: str = READ_AS_PRINTED) -> Reading:
        """Return one reading of a claim. Raises ArithmeticError if it has no value."""
        for reading in self.judge.assess(self.ledger.claims[claim]).readings:
            if reading.name == name:
                return reading
        raise ArithmeticError(f"{claim} has no value")


def case(results: Results, beta: int, /, **changed: float) -> Impact:
    """Return the report's case with this beta, some of its inputs changed (SI)."""
    inputs = {name: results[claim] for name, claim in claims_of_case(beta).items()}
    if "resistance" in changed:
        del inputs["beta"], inputs["flow_stress"]
    return Impact(**{**inputs, **changed})


def of_beta(results: Results, beta: int) -> str:
    """Return the beta of one of the report's cases in words, as the report prints it.

    >>> from reference.ledger import load
    >>> of_beta(Results(load()), 5)
    'beta = 5'
    """
    return f"beta = {results.text(f'depth-beta-{beta}-beta')}"


def density_taken(results: Results) -> str:
    """Return the target density with which the audit computes, in words.

    >>> from reference.ledger import load
    >>> density_taken(Results(load()))
    '7850 kg/m^3'
    """
    return f"{number(results.exact(DENSITY))} kg/m^3"


def exact_ratio(impact: Impact) -> float:
    """Return the exact final X/R [1] of the model (Eqs. 12-13)."""
    return depth.final_depth(**impact.motion) / impact.radius


def constant_pressure_ratio(impact: Impact) -> float:
    """Return the final X/R [1] at the constant pressure R_t: Eq. 13 without the target's inertia.

    >>> from reference.ledger import load
    >>> f"{constant_pressure_ratio(case(Results(load()), 5)):.3f}"
    '0.752'
    """
    density, resistance = impact.particle_density, impact.target_resistance
    return constant_pressure_depth(impact.velocity, 1.0, density, resistance)
