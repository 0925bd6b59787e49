"""Every finding: its numbers hold, its words are the report's, and a misprint takes it away."""

import re
from math import exp, log, pi, sqrt

import pytest

from reference.ledger import Ledger, load
from reference.units import to_si
from replication.audit import findings as package
from replication.audit.audit import Audit
from replication.audit.findings import FINDINGS, finding, findings, findings_on
from replication.audit.findings.evidence import (
    above,
    at_least,
    at_most,
    equals,
    prints,
    proves,
    refutes,
)
from replication.audit.record import Evidence, Finding, Record
from replication.audit.results import Results

LEDGER = load()


@pytest.fixture(scope="module")
def made(audit: Audit) -> dict[str, Finding]:
    """The findings on the report by id, the headline among them."""
    return {finding.id: finding for finding in findings(audit)}


IDS = [find.function.__name__.replace("_", "-") for find in FINDINGS]


def test_a_finding_has_the_name_of_its_function(made: dict[str, Finding]) -> None:
    assert list(made) == IDS
    assert len(set(IDS)) == len(IDS)


def test_one_finding_is_that_of_all(audit: Audit, made: dict[str, Finding]) -> None:
    assert finding(audit, "two-schemes") == made["two-schemes"]
    with pytest.raises(KeyError):
        finding(audit, "two schemes")


@pytest.mark.parametrize("name", IDS)
def test_every_number_of_a_finding_holds(name: str, made: dict[str, Finding]) -> None:
    finding = made[name]
    assert [number.name for number in finding.evidence if not number.holds] == []
    assert finding.evidence
    assert finding.holds
    names = [number.name for number in finding.evidence]
    assert len(set(names)) == len(names)
    assert all(to_si(number.unit) for number in finding.evidence)


def plain(text: str) -> str:
    return re.sub(r"[\s$~]", "", text.replace("μ", "u").replace("- um", "-um")).lower()


@pytest.mark.parametrize("name", IDS)
def test_what_a_finding_quotes_stands_in_the_report(name: str, made: dict[str, Finding]) -> None:
    finding = made[name]
    whole = " ".join((finding.title, finding.statement, finding.by_hand, finding.settle))
    report = plain(LEDGER.text)
    assert [quote for quote in re.findall(r'"(.*?)"', whole) if plain(quote) not in report] == []
    assert not re.search("[{}`]", whole)


@pytest.mark.parametrize("name", IDS)
def test_a_finding_names_entries_and_says_what_would_settle_it(
    name: str, made: dict[str, Finding]
) -> None:
    finding = made[name]
    assert LEDGER.claims.keys() | LEDGER.equations.keys() >= set(finding.claims)
    assert finding.claims
    assert finding.settle or finding.kind == "headline"


NO_EVIDENCE = re.compile(
    r"""[Ee]q(?:uation|s?\.)\ \d+(?:\ (?:and|to)\ \d+)? | Table\ A-1 | \b304\b | A240
    | (?:reference|[Ss]ection|[Ff]igure|[Rr]ow)\ \d+ | beta\ =\ [35] | ".*?"
    | \^\(?-?\d(?:/\d)?\)? | (?<=[(/])\d(?=[\ /)a-zA-Z]) | \d(?=/\d) | (?<=/)\d
    | \d(?=\ [-+]\ | \ (?:k_t|R_t|rho_|ln)) | (?<=[a-z])_\d""",
    re.VERBOSE,
)
"""Digits that claim nothing: a place in the report, an alloy, a standard, a case, words of the
report, and the coefficients and exponents of a formula in symbols."""

NUMBER = re.compile(r"\d+(?:\.\d+)?(?:×10[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+|E[-+]?\d+)?(?:/\d+)?")


@pytest.mark.parametrize("name", IDS)
def test_every_number_in_a_statement_is_evidence_or_printed(
    name: str, made: dict[str, Finding]
) -> None:
    """A number that stands in the text alone, and is computed nowhere, would be found here."""
    finding, results = made[name], Results(LEDGER)
    known = {str(number) for number in finding.evidence}
    known |= {shown for claim in LEDGER.claims.values() for shown in NUMBER.findall(claim.shown)}
    known |= {text for s in LEDGER.sources.values() for text in NUMBER.findall(s.says)}
    pressures = (c.id for c in LEDGER.claims.values() if c.unit in ("Pa", "MPa"))
    known |= {results.text(claim, "GPa") for claim in pressures}
    for text in (finding.title, finding.statement, finding.settle):
        assert [n for n in NUMBER.findall(NO_EVIDENCE.sub("", text)) if n not in known] == []


@pytest.mark.parametrize(
    ("number", "holds"),
    [
        (prints("x", "7.66", 7.6649e-6, "um", "within rounding"), True),
        (prints("x", "7.66", 7.6651e-6, "um", "beyond rounding"), False),
        (equals("x", "2", 2, "1", "the same"), True),
        (equals("x", "2", 2.0000001, "1", "not the same"), False),
        (at_least("x", "1.147", 1.147001, "1", "more"), True),
        (at_least("x", "1.147", 1.146999, "1", "less"), False),
        (at_most("x", "1.073", 1.072, "1", "less"), True),
        (at_most("x", "1.073", 1.074, "1", "more"), False),
        (above("x", "2", 2.1, "1", "more"), True),
        (above("x", "2", 2, "1", "the same"), False),
        (proves("x", outcome=True, means="proven"), True),
        (proves("x", outcome=False, means="not proven"), False),
        (refutes("x", outcome=False, means="refuted"), True),
        (refutes("x", outcome=True, means="not refuted"), False),
    ],
    ids=lambda case: f"{case.asserted} {case.means}" if isinstance(case, Evidence) else "",
)
def test_evidence_holds_only_as_its_text_says(number: Evidence, holds: bool) -> None:
    assert number.holds is holds


RHO, KSI = 7850, 6894757.293168
Z = 1.046 * RHO * 500**2
"""k_t rho_t V^2 of Eq. 16 [Pa]."""
COPPER_FAST = (90e6 + 292e6) * (1 + 0.025 * log(1e7))
"""Johnson and Cook's flow stress of copper at strain 1 and 10^7 per second [Pa]."""


def apart(length_ratio: float, R_t: float, k_t: float = 1.046) -> float:
    """X/R from Eqs. 14 and 15, written down here once more; k_t divides the bracket."""
    return (length_ratio * 8900 / RHO + 0.557) / k_t * log(1 + Z / R_t)


@pytest.mark.parametrize(
    ("name", "number", "value"),
    [
        ("frank-zook-pair", "nominal", log(1 + Z / 7.6e9) / log(1 + Z / 9.13e9) - 1),
        ("frank-zook-values", "multiplied", apart(2 / 3, 9.13e9, 1 / 1.046)),
        ("frank-zook-values", "multiplied_other", apart(2 / 3, 7.6e9, 1 / 1.046)),
        ("frank-zook-values", "on_k_1",
         (2 / 3 + 0.557 * 8900 / RHO) / 1.046 * log(1 + Z / 7.6e9)),
        ("sphere-equivalent", "equal_rha", apart(1, 9.13e9) * (2 / 3) ** (1 / 3)),
        ("sphere-equivalent", "equal_stainless", apart(1, 7.6e9) * (2 / 3) ** (1 / 3)),
        ("sphere-equivalent", "long_rha", apart(1, 9.13e9)),
        ("sphere-equivalent", "long_stainless", apart(1, 7.6e9)),
        ("no-penetration", "stress", 8900 * 500**2 / 2 + 90e6),
        ("no-penetration", "threshold_3", sqrt(2 * (2.1e9 - 90e6) / 8900)),
        ("no-penetration", "threshold_5", sqrt(2 * (3.5e9 - 90e6) / 8900)),
        ("no-penetration", "fast_3", sqrt(2 * (2.1e9 - COPPER_FAST) / 8900)),
        ("no-penetration", "fast_5", sqrt(2 * (3.5e9 - COPPER_FAST) / 8900)),
        ("energy-balance", "share_3", 0.06 * 2.1e9 / (8900 * 500**2 / 2)),
        ("energy-balance", "share_5", 0.06 * 3.5e9 / (8900 * 500**2 / 2)),
        ("hardness-again", "least", 3 * 98 * KSI),
        ("hardness-again", "greatest", 3 * 110 * KSI),
        ("hardness-again", "above_it", 3.5e9 / (3 * 110 * KSI)),
        ("half-buried", "velocity", sqrt(2 * 3.5e9 / RHO * (exp(RHO / (2 * 8900)) - 1))),
        ("equation-1-scatter", "drag_mean", 0.5 * 5.6 / 22 * 500 * sqrt(2 / pi)),
        ("cth-pressure", "time", 12.5e-6 * 500 / (2 * (4569 + 1.490 * 248.3) ** 2)),
        ("cth-pressure", "edge", 12.5e-6 * 500 / (4569 + 1.490 * 248.3)),
    ],
)  # fmt: skip
def test_numbers_of_findings_computed_apart(
    name: str, number: str, value: float, made: dict[str, Finding]
) -> None:
    (piece,) = (piece for piece in made[name].evidence if piece.name == number)
    computed = piece.computed * float(to_si(piece.unit))
    assert computed == pytest.approx(value, rel=1e-3 if name == "cth-pressure" else 1e-12)


def test_the_velocity_below_which_the_pair_is_impossible(made: dict[str, Finding]) -> None:
    """Both R_t and k_t rounded: at the limit the least rise is the greatest that prints so."""
    (limit,) = (p.computed for p in made["frank-zook-pair"].evidence if p.name == "limit")
    drags = (1.0465 * RHO * velocity**2 for velocity in (limit - 0.01, limit + 0.01))
    slower, faster = (log(1 + z / 7.65e9) / log(1 + z / 9.125e9) for z in drags)
    assert faster < 0.2975 / 0.2775 < slower


@pytest.mark.parametrize(
    ("finding", "name"),
    [
        ("frank-zook-pair", "limit"),
        ("frank-zook-values", "from"),
        ("frank-zook-values", "below"),
    ],
)
def test_the_bounds_of_a_proof_are_rounded_to_the_safe_side(
    finding: str, name: str, made: dict[str, Finding]
) -> None:
    """What holds below a bound holds below a smaller one; what holds from one, from a greater."""
    (bound,) = (piece for piece in made[finding].evidence if piece.name == name)
    stated = float(bound.asserted.lstrip("<>= "))
    assert stated in (2975, 7764.3, 7849.7)
    safe = bound.computed <= stated if name == "from" else bound.computed >= stated
    assert safe


def test_multiplied_by_k_t_it_prints_0278_for_all_that_the_printed_mass_admits() -> None:
    header = (2 / 3 * 8900, 0.557 * 1.046)
    at = ((7764.2, False), (7764.3, True), (7825.1, True), (7848.9, True), (7849.72, True))
    for density, prints_so in (*at, (7849.73, False)):
        value = (header[0] / density * 1.046 + header[1]) * log(
            1 + 1.046 * density * 500**2 / 9.13e9
        )
        assert (0.2775 <= value < 0.2785) == prints_so


@pytest.mark.parametrize(
    ("claim", "figures"),
    [
        ("outlier-volume", [f"{(6 * 7500 / pi) ** (1 / 3):.1f} µm"]),
        ("autodyne-time", [f"{40e3 * 22 / 10_000:.0f} ns", f"{88 / 26.079:.1f} times"]),
        ("brinell-ratio", [f"{123 * 9.80665 / 505:.2f}", f"{9.80665 / 3.5:.1f} to",
                           f"{9.80665e6 / (500 * KSI / 1000):.2f}, which rounds"]),
    ],
)  # fmt: skip
def test_what_can_be_compared_is_computed_apart(
    claim: str, figures: list[str], audit: Audit
) -> None:
    explanation = audit.claim(claim).explanation
    assert [figure for figure in figures if figure not in explanation] == []


MISPRINTS = [
    ("frank-zook-rha", "0.255", {"equation-16", "frank-zook-pair", "frank-zook-values"}),
    ("volume-ratio-line", "0.085", {"observed-digits"}),
    ("fz-resistance-rha", "9.31E9", {"two-resistances"}),
    ("autodyne-steel-yield", "430", {"unlike-strengths"}),
    ("diameter-deviation", "6.5", {"equation-1-scatter"}),
    ("yield-strength", "251", {"beta-and-flow-stress"}),
    ("copper-yield", "19", {"rigid-strength"}),
    ("coarse-step", "0.6", {"two-schemes"}),
    ("cth-velocity", "800", {"cth-pressure"}),
    ("sphere-length-ratio", "1/3", {"sphere-equivalent"}),
    ("a1-mass", "4.69E-11", {"target-density"}),
]


@pytest.fixture(scope="module")
def spoiled() -> dict[str, Finding]:
    """The findings on a report with all of the misprints at once."""
    ledger: Ledger = LEDGER
    for claim, text, _ in MISPRINTS:
        ledger = ledger.misprint(claim, text)
    return {finding.id: finding for finding in findings(Results(ledger))}


@pytest.mark.parametrize(("claim", "text", "names"), MISPRINTS)
def test_a_finding_whose_evidence_is_misprinted_no_longer_holds(
    claim: str, text: str, names: set[str], spoiled: dict[str, Finding]
) -> None:
    assert [name for name in names if spoiled[name].holds] == []


def test_the_headline_of_a_misprinted_report_is_another(spoiled: dict[str, Finding]) -> None:
    assert not spoiled["headline"].holds


def test_numbers_that_a_misprint_leaves_without_a_value_do_not_hold() -> None:
    ledger = LEDGER.misprint("fz-resistance-rha", "0")
    finding = {f.id: f for f in findings(Results(ledger))}["equation-16"]
    assert not finding.holds
    assert {number.computed for number in finding.evidence} == {None}


def test_the_record_has_all_findings_and_begins_with_the_headline(
    record: Record, made: dict[str, Finding]
) -> None:
    assert [finding.id for finding in record.findings] == IDS[1:]
    assert record.headline == made["headline"].statement


def test_a_claim_names_the_findings_on_it() -> None:
    on_pair = findings_on(Results(LEDGER), "fz-resistance-rha")
    assert [finding.id for finding in on_pair] == ["frank-zook-pair", "two-resistances"]


def test_an_error_in_a_finding_on_the_report_itself_is_not_hidden(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def broken(_: Results) -> Finding:
        raise ZeroDivisionError

    monkeypatch.setattr(package, "FINDINGS", (broken,))
    with pytest.raises(ZeroDivisionError):
        findings(Results(LEDGER))


def test_an_audit_of_a_misprinted_report_keeps_its_findings() -> None:
    spoiled = Audit(LEDGER.misprint("copper-yield", "19"), every_convention=False)
    assert len(spoiled.record().findings) == len(FINDINGS) - 1
