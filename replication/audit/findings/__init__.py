"""The findings: what a failed or surprising number teaches about the report.

Each finding is one function, in the file of its subject. It computes the numbers in its text anew
from the ledger, the verdicts and the models, and returns a `Finding`; `evidence` has the parts.
`FINDINGS` has them in the order of what they change for a reader. The first, the headline, is the
sentence with which files begin and the text on a terminal ends.

To add one: write its function, name with `@concerning` the claims that it is about, and put it into
FINDINGS. The tests ask that all of its numbers hold for the report, and that its claims exist.
"""

from functools import cache

from msgspec.structs import replace

from reference.ledger import load
from replication.audit.findings.contradictions import minimum_velocity, wrong_reference
from replication.audit.findings.densities import target_density
from replication.audit.findings.evidence import FindingFunction
from replication.audit.findings.frank_zook import (
    equation_16,
    frank_zook_pair,
    headline,
    sphere_equivalent,
    two_resistances,
)
from replication.audit.findings.frank_zook_inputs import frank_zook_values
from replication.audit.findings.hydrocodes import autodyne_cells, cth_pressure, unlike_strengths
from replication.audit.findings.implications import (
    energy_balance,
    half_buried,
    hardness_again,
    no_penetration,
)
from replication.audit.findings.resistance import (
    beta_and_flow_stress,
    inertia_term,
    observed_beta,
    rigid_strength,
    strengths,
)
from replication.audit.findings.sheet import table_columns, two_schemes
from replication.audit.findings.stream import (
    compared_velocity,
    equation_1_scatter,
    faster_particles,
    observed_digits,
)
from replication.audit.record import Finding
from replication.audit.results import Results

FINDINGS: tuple[FindingFunction, ...] = (
    headline,
    frank_zook_pair,
    equation_16,
    frank_zook_values,
    target_density,
    two_schemes,
    beta_and_flow_stress,
    two_resistances,
    inertia_term,
    observed_beta,
    compared_velocity,
    half_buried,
    rigid_strength,
    no_penetration,
    energy_balance,
    strengths,
    hardness_again,
    unlike_strengths,
    autodyne_cells,
    cth_pressure,
    equation_1_scatter,
    faster_particles,
    observed_digits,
    minimum_velocity,
    table_columns,
    sphere_equivalent,
    wrong_reference,
)


def findings(results: Results) -> list[Finding]:
    """Return all findings, the headline first."""
    return [_finding(find, results) for find in FINDINGS]


def finding(results: Results, name: str) -> Finding:
    """Return one finding, by its id: its function's name, with hyphens. KeyError if there is none.

    >>> from replication.audit.audit import Audit
    >>> finding(Audit(load()), "frank-zook-pair").holds
    True
    """
    by_id = {find.function.__name__.replace("_", "-"): find for find in FINDINGS}
    return _finding(by_id[name], results)


def findings_on(results: Results, name: str) -> list[Finding]:
    """Return the findings that concern a claim or an equation, without the headline."""
    return [_finding(find, results) for find in FINDINGS[1:] if name in find.concerns]


def _finding(find: FindingFunction, results: Results) -> Finding:
    """Return a finding. With a misprint planted in the report, it may have numbers without a value.

    It is then the finding on the report itself, of which no number holds.
    """
    try:
        return find(results)
    except (ArithmeticError, LookupError, ValueError):
        if not results.ledger.misprinted:
            raise
    finding = find(_report())
    nothing = [replace(number, computed=None, holds=False) for number in finding.evidence]
    return replace(finding, evidence=nothing, holds=False)


@cache
def _report() -> Results:
    """Return the results of the report as it is printed."""
    return Results(load())
