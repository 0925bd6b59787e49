"""The figures by which a reader judges the comparisons that the report makes in words."""

import pytest

from reference.ledger import load
from replication.audit.remarks import REMARKS, figures
from replication.audit.results import Results

LEDGER = load()
RESULTS = Results(LEDGER)


def test_every_remark_has_its_figures_and_no_figure_is_for_another_claim() -> None:
    remarks = [claim.id for claim in LEDGER.claims.values() if claim.kind == "remark"]
    assert remarks == list(REMARKS), "in the order of the report"
    assert figures(RESULTS, LEDGER.claims["depth-beta-5"]) == []


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
        ("velocity-effect", "rise between them", 26.2),
        ("codes-overestimate", "CTH's X/R over the observed one, less 1", 100 * (0.41 / 0.298 - 1)),
        ("large-difference", "X/R of the model over the observed one, beta = 3", 0.91 / 0.3),
        ("velocity-distribution", "velocity at which the exact X/R is 0.3, beta = 5", 221.5),
        ("smaller-faster", "velocity of the smallest particle of the 521-m/s data by Eq. 1", 1700),
        ("smaller-faster", "velocity of the smallest particle of the 521-m/s data by drag on a "
         "sphere", 521 * 2.2**0.5),
        ("profile-consistent", "X/R of that profile for a mean particle", 2 / 11),
        ("closest-approach", "X/R less the observed one, Autodyne", 0.52 - 0.298),
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
