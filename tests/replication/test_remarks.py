"""The figures by which a reader judges what the report says of its results in words."""

import re
from functools import cache
from math import log, pi

import pytest

from reference.ledger import load
from replication.audit import comparison
from replication.audit.audit import Audit
from replication.audit.findings import findings
from replication.audit.remarks import REMARKS, figures
from replication.audit.results import Results

LEDGER = load()
RESULTS = Results(LEDGER)
SUM, DRAG = 2 / 3 * 8900 / 7850 + 0.557, 1.046 * 7850 * 500**2
"""L/D rho_p/rho_t + k_1 [1] and k_t rho_t V^2 [Pa] of Eq. 16."""


REMARKED = [claim for claim in LEDGER.claims.values() if claim.kind == "remark"]


def test_every_remark_has_its_figures_and_no_figure_is_for_another_claim() -> None:
    own = [claim.id for claim in REMARKED if claim.same_as is None]
    assert own == list(REMARKS), "in the order of the report"
    assert {claim.same_as for claim in REMARKED} - {None} <= set(REMARKS)
    assert figures(RESULTS, LEDGER.claims["depth-beta-5"]) == []


COMPARATIVE = re.compile(
    r"""\b(?: more | most | less | least | greater | larger | largest | smaller | smallest | higher
    | highest | lower | lowest | deep(?:er)? | shallow\w* | low | high | faster | slow(?:er)?
    | clos(?:e|er|est) | better | worse | over-?estimat\w* | \w*agree\w* | consistent
    | \w*significant\w* | slightly | much | far | large | increase\w* | decrease\w* | same
    | similar | pronounced | twice | times | exceed\w* | excess | several | deviat\w* | surpris\w*
    | \w*accura\w* | differen\w* | discrepancy | disparity | compar\w* | explain | accounts?
    | fortuitous | little | few | relatively | good | strong\w* | extreme\w* )\b""",
    re.VERBOSE | re.IGNORECASE,
)
"""Words that compare or grade."""

NO_REMARK = {
    "of others, or of cold spray in general": (
        "Most of the successful spray", "is consistent with this hypothesis", "deep enough to",
        "similar to that formed", "is high enough to supply", "deep penetration of the target. (Of",
        "cannot be so high as", "at the lowest velocity", "very little information",
        "In most cases, the", "will decrease the farther", "appears to be stronger than",
        "responsible for this increase", "high-density, low-", "“shallowing”",
        "has a larger radius of curvature", "Because of the shallowing", "a very high\n\nvelocity",
        "that produces deep penetration", "a strong frictional",
    ),
    "announced, or about how the report is written": (
        "reasons for the disagreement are", "What is more interesting", "to test its accuracy",
        "were the same for all",
        "With several reasonable", "for the discrepancy are", "low-impact-velocity",
        "even for low-velocity", "Similar data for", "However, the same authors",
        "to agree with experimental", "how close the", "Of even more concern",
        "As a point of comparison", "Several possible causes for the over-estimation",
        "for comparing with", "able to predict accurately", "One of the most intriguing",
        "Several possible explanations for the discrepancy", "is not surprising, therefore",
        "Several attempts", "in a more complicated", "value of X/R accurately",
        "a term that accounts", "suffers from the same", "predictions for low-velocity",
        "takes into account", "from more sophisticated",
    ),
    "about hydrocodes in general": (
        "This high-powered", "are the most important", "differentiate computational",
        "become so large",
    ),
    "beside a number or a remark of the same sentence": (
        "the smaller particles have a higher", "and the larger particles have a smaller",
        "with more of the data", "CV/PV greater than 0.06.  Both", "ratio greater than 0.06, it",
        "that is higher than the minimum", "of the smaller particles have", "in excess of this",
        "but less than 521", "is a little over 2", "5.6- μm standard deviation", "is three times",
        "made by several 20", "diameter less than 20", "two different appearances",
        "are extremely high and", "or greater are produced", "This disparity is most likely",
        "the strength difference", "some of the difference. If", "over two times too high",
        "scale smaller than 1", "for times greater than", "have a relatively larger contact",
        "operation, the smaller", "than the larger ones", "50-m/s mean deviation",
        "increases, larger", "for different size", "explain the difference", "buried less than",
        "a little over one", "velocity is less than 1",
    ),
    "an assumption or a cause of which the report gives nothing to compute": (
        "not change significantly until", "but most of the deformation", "to a large extent",
        "the other is more clear", "are most likely single", "amount of increase is",
        "This may be fortuitous", "stream is low, then only the smaller, faster particles",
        "deposition efficiency will increase", "efficiency was low at", "a strain rate similar to",
        "resistance would also increase", "due in large part", "a shallow crater has",
        "is not surprising, considering", "strengths that are similar", "giving a high value",
        "might be different for different", "be substantially different", "is much less than",
        "is high enough to make", "term is large", "axial stress times",
        "The same procedure", "first few time",
    ),
}  # fmt: skip
"""Words of the report that compare or grade and are no remark, by the reason."""


def test_every_comparison_of_the_text_is_an_entry_or_said_to_be_none() -> None:
    text = LEDGER.text
    flat = re.sub(r"\s+", " ", text)
    for phrase in (phrase for phrases in NO_REMARK.values() for phrase in phrases):
        assert flat.count(re.sub(r"\s+", " ", phrase)) == 1, phrase
        assert COMPARATIVE.search(phrase), phrase
    spans = [claim.place for claim in LEDGER.claims.values() if claim.place.cell is None]
    known = [(place.start, place.end) for place in spans]
    for phrases in NO_REMARK.values():
        patterns = (r"\s+".join(map(re.escape, phrase.split())) for phrase in phrases)
        known += [match.span() for p in patterns for match in re.finditer(p, text)]
    words = [match.span() for match in COMPARATIVE.finditer(text)]
    left = [(a, b) for a, b in words if not any(low < b and a < high for low, high in known)]
    assert [text[max(0, a - 30) : b + 30] for a, b in left] == []


@pytest.mark.parametrize("name", REMARKS)
def test_figures_have_values(name: str) -> None:
    shown = figures(RESULTS, LEDGER.claims[name])
    assert shown
    assert all(figure.value is not None for figure in shown)
    assert len({figure.means for figure in shown}) == len(shown)


@pytest.mark.parametrize(
    ("name", "means", "value"),
    [
        # By scaling, Eqs. 12 and 13 have no length but R: y = x/R, and time in units of R/V.
        ("size-effect", "X/R of the sheet, beta = 5, particles of 10 um", 0.6966),
        ("size-effect", "X/R of the sheet, beta = 5, particles of 30 um", 0.6974),
        ("velocity-effect", "rise of the exact X/R from 400 to 500 m/s", 26.2),
        ("codes-overestimate", "CTH's X/R over the observed one, less 1", 100 * (0.41 / 0.298 - 1)),
        ("large-difference", "X/R of the model over the observed one, beta = 3", 0.91 / 0.3),
        ("velocity-distribution", "velocity at which the exact X/R is 0.3, beta = 5", 221.5),
        ("smaller-faster", "velocity of the smallest particle of the 521-m/s data by Eq. 1", 1700),
        ("smaller-faster", "velocity of the smallest particle of the 521-m/s data by drag on a "
         "sphere", 521 * 2.2**0.5),
        ("profile-consistent", "X/R of that profile for a mean particle", 2 / 11),
        ("closest-approach", "X/R less the observed one, Autodyne", 0.52 - 0.298),
        ("frank-zook-below-observed", "X/R as printed over the observed 0.298, less 1",
         100 * (0.278 / 0.298 - 1)),
        ("frank-zook-below-observed", "X/R derived from Eqs. 14 and 15 over the observed 0.298, "
         "less 1", 100 * (SUM / 1.046 * log(1 + DRAG / 9.13e9) / 0.298 - 1)),
        ("strength-difference", "share of the distance to the observed X/R that R_t = 7.6 GPa "
         "closes, as printed", 95),
        ("larger-grain", "diameter of a grain around three craters side by side, over a "
         "particle's", (1 + 2 / 3**0.5) * (2 / 3 - 1 / 9) ** 0.5),
        ("rates-far-higher", "strain rate of the impact over 10,000 per second, up to which a "
         "public source says that these bars are generally used", 500 / 20e-6 / 1e4),
        ("strength-rises", "flow stress at 10^7 over that at 1 per second by Johnson and Cook's "
         "law for copper", 1 + 0.025 * log(1e7)),
        ("flat-surface", "X/R if the contact is as wide as the sphere from the start, beta = 5",
         4 * 8900 / (3 * 7850) * log(1 + 7850 * 500**2 / 7e9)),
        ("elastic-rebound", "depth over R by which the model's crater springs back at most (Hertz, "
         "rigid particle), beta = 5", 0.75 * pi * 3.5 / 200 * (2 * 0.69772 - 0.69772**2) ** 0.5),
        ("clustered-small", "share of the powder's particles of 10 to 30 um that are below 20 um, "
         "their sizes Gaussian as printed", 37.96),
        # Normal distributions beyond 85/50 and 183/50 standard, or (2/pi)^(1/2) = 0.7979 as many.
        ("slower-incipient", "share of the stream of 606 m/s slower than 521 m/s, 50 m/s taken as "
         "standard deviation", 4.457),
        ("slower-incipient", "share of the stream of 606 m/s slower than 521 m/s, 50 m/s taken as "
         "mean deviation", 8.749),
        ("slower-incipient", "share of the stream of 704 m/s slower than 521 m/s, 50 m/s taken as "
         "standard deviation", 0.01261),
        ("slower-incipient", "share of the stream of 704 m/s slower than 521 m/s, 50 m/s taken as "
         "mean deviation", 0.1750),
        ("faster-only", "share faster by 50 m/s or more, taken as mean deviation", 21.25),
        ("faster-only", "share faster by 50 m/s or more, taken as standard deviation", 15.87),
        ("too-few", "share faster than 450 m/s about 400 m/s, 50 m/s taken as standard deviation",
         15.87),
        ("attempts-no-better", "X/R of the rigid model less the observed one, as printed, beta = "
         "5", 0.70 - 0.3),
        ("larger-adhere", "largest particle that flies at 521 m/s in the stream of 606 m/s, by "
         "drag on a sphere", 22 * (606 / 521) ** 2),
        ("larger-adhere", "largest particle that flies at 521 m/s in the stream of 403 m/s, by "
         "Eq. 1", 22 * (403 / 521) ** (2 / 3)),
        ("rigid-attribution", "velocity below which copper of the quoted strength does not "
         "penetrate, Eq. 5, beta = 3", (2 * (2.1e9 - 90e6) / 8900) ** 0.5),
        ("eq1-agreement", "mean deviation at 500 m/s by Eq. 1, to first order in the printed "
         "sizes", 1.5 * 5.6 / 22 * 500 * (2 / pi) ** 0.5),
    ],
)  # fmt: skip
def test_some_figures_computed_apart(name: str, means: str, value: float) -> None:
    shown = {figure.means: figure.value for figure in figures(RESULTS, LEDGER.claims[name])}
    assert shown[means] == pytest.approx(value, rel=2e-3, abs=0)


def test_a_misprint_leaves_a_figure_without_a_value() -> None:
    results = Results(LEDGER.misprint("mean-diameter", "0"))
    shown = figures(results, results.ledger.claims["profile-consistent"])
    assert shown[0].value is None


def test_the_power_of_eq_1_is_that_which_is_printed() -> None:
    results = Results(LEDGER.misprint("eq1-power", "1/3"))
    shown = figures(results, results.ledger.claims["smaller-faster"])
    assert shown[0].value == pytest.approx(521 * 2.2, rel=1e-12, abs=0)


def test_a_remark_that_repeats_another_says_where_its_figures_are() -> None:
    again = [claim for claim in REMARKED if claim.same_as]
    assert len(again) == 10
    for claim in again:
        assert figures(RESULTS, claim) == []
        explanation = Audit(LEDGER, every_convention=False).claim(claim.id).explanation
        assert explanation.startswith("It says again")
        assert f"`{claim.same_as}`" in explanation


MISPRINTED = {
    "a1-initial-velocity": "511", "velocity-403": "407", "velocity-521": "523",
    "velocity-606": "607", "velocity-704": "709", "velocity-deviation": "53",
    "stream-velocity-400": "401", "stream-velocity-450": "457",
    "figure-5-velocity-least": "397", "figure-5-velocity-greatest": "503",
    "particle-size-least": "11", "particle-size-greatest": "31", "mean-diameter": "23",
    "crater-particle-diameter": "19", "observed-third": "1/4",
    "depth-beta-3-beta": "3.1", "depth-beta-5-beta": "5.1", "a-step": "0.21", "coarse-step": "0.51",
    "observed-ratio": "0.29", "observed-depth-ratio": "0.297", "strain-rate": "10^6",
    "fz-resistance-stainless": "7.7×10^9", "volume-ratio-line": "0.059", "volume-ratio": "0.061",
}  # fmt: skip
"""Other texts for all numbers of the report that a label names."""
DERIVED_NUMBERS = {"576", "21"}
"""523 m/s and 53 m/s more, and the middle of 11 and 31 um."""
OF_THE_AUDIT = {"1", "100", "10,000"}
"""Not of the report: a strain and a rate of one, "less 1", and what a public source prints."""


@cache
def misprinted() -> Results:
    """The results of the report with all of these misprints."""
    ledger = LEDGER
    for name, text in MISPRINTED.items():
        ledger = ledger.misprint(name, text)
    return Results(ledger, every_convention=False)


def test_no_label_has_a_number_that_the_report_does_not_print() -> None:
    """A label names the numbers with which its figure is computed, misprints included."""
    results = misprinted()
    labels = [figure.means for remark in REMARKS.values() for figure in remark(results)]
    labels += [approach.name for approach in comparison.approaches(results)]
    known = {number for text in MISPRINTED.values() for number in NUMBER.findall(text)}
    for label in labels:
        named = set(NUMBER.findall(EQUATIONS.sub("", label)))
        assert named <= known | DERIVED_NUMBERS | OF_THE_AUDIT, label
    every = " ".join(labels)
    assert [text for text in MISPRINTED.values() if NUMBER.search(text)[0] not in every] == []


def test_no_label_of_a_finding_has_a_velocity_that_the_report_does_not_print() -> None:
    """Findings without a value are those on the report itself; quotations are of its text."""
    changed = [LEDGER.claims[name] for name in MISPRINTED]
    velocities = {claim.text for claim in changed if claim.unit == "m/s"}
    numbers = [number for made in findings(misprinted()) for number in made.evidence]
    labels = [number.means for number in numbers if number.computed is not None]
    stale = [label for label in labels if velocities & set(NUMBER.findall(label))]
    assert [label for label in stale if "the text says '" not in label] == []
    assert any("523 m/s" in label for label in labels)


NUMBER = re.compile(r"\d+(?:[.,]\d+)*")
EQUATIONS = re.compile(r"Eqs?\. \d+(?: and \d+)?|Figure \d+")
