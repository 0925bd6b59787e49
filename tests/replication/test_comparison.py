"""The tables of the record besides verdicts follow what the report prints, misprints included."""

import pytest

from reference.ledger import load
from replication.audit import comparison
from replication.audit.results import Results

LEDGER = load()


@pytest.mark.parametrize("text", ["1/2", "1/3", "1"])
def test_the_scatter_by_equation_1_follows_its_printed_power(text: str) -> None:
    """A mass grows with the cube of the diameter, so the velocity falls with its power 3 n."""
    law, *_ = comparison.scatter(Results(LEDGER.misprint("eq1-power", text)))
    assert law.law == "Eq. 1: mass alone"
    numerator, _, denominator = text.partition("/")
    power = 3 * int(numerator) / int(denominator or 1)
    # 22 um with a standard deviation of 5.6 um, at 500 m/s; some roundings of doubles
    assert law.standard_deviation == pytest.approx(power * 5.6 / 22 * 500, rel=1e-14)
    slow, median, fast = law.velocities
    assert median == pytest.approx(500, rel=1e-14)
    # 1.6448536269514722 standard deviations leave out a twentieth on either side.
    off = 1.6448536269514722 * 5.6 / 22
    assert slow == pytest.approx(500 / (1 + off) ** power, rel=1e-12)
    assert fast == pytest.approx(500 / (1 - off) ** power, rel=1e-12)


@pytest.mark.parametrize(
    ("entry", "text", "expected"),
    [
        pytest.param("volume-ratio-line", "0.08", 0.08, id="another line in Figure 1"),
        pytest.param("volume-ratio", "0.03", 0.03, id="another ratio for Eq. 4"),
    ],
)
def test_the_observed_depths_follow_the_printed_volumes(
    entry: str, text: str, expected: float
) -> None:
    approaches = comparison.approaches(Results(LEDGER.misprint(entry, text)))
    (observed,) = (row for row in approaches if text in row.name)
    y = observed.computed
    assert y is not None
    assert y**2 * (3 - y) / 4 == pytest.approx(expected, rel=1e-14)  # CV/PV at X/R = y, Eqs. 2, 3
