"""Conjectures are checked against the ledger when they are loaded."""

import tomllib
from copy import deepcopy
from fractions import Fraction
from importlib import resources
from typing import Any

import pytest

from reference.conjectures import load, read
from reference.exact import Reals
from reference.ledger import LedgerError
from reference.ledger import load as load_ledger
from reference.slips import equation_16, equation_16_ratio

DOCUMENT = tomllib.loads(
    (resources.files("reference.report") / "conjectures.toml").read_text("utf-8")
)


def wrong(section: str, number: int = 0, **changes: Any) -> dict[str, Any]:
    document = deepcopy(DOCUMENT)
    document[section][number] |= changes
    return document


@pytest.mark.parametrize(
    ("document", "message"),
    [
        (wrong("quantity", unit="kg"), "is in m/s"),
        (wrong("quantity", entries=["no-such"]), "no number 'no-such'"),
        (wrong("quantity", search=["600", "700"]), "outside the search"),
        (wrong("family", function="equation_99"), "no function 'equation_99'"),
        (wrong("family", slip=[{"name": "x", "set": {"y": "1"}}]), "no place 'y'"),
        (wrong("family", slip=[{"name": "x", "set": {"k_1": "no-such"}}]), "no number 'no-such'"),
        (wrong("joint", claims=["no-such"]), "no claim 'no-such'"),
        (wrong("joint", 1, kept=["no-such"]), "no number 'no-such'"),
        (wrong("joint", ratio={"function": "x", "differs": "y"}), "no ratio 'x'"),
    ],
)
def test_what_is_wrong_is_named(document: dict[str, Any], message: str) -> None:
    with pytest.raises(LedgerError, match=message):
        read(document, load_ledger())


def test_every_slip_has_a_reason() -> None:
    assert all(slip.reason for family in load().families for slip in family.slips)


def test_the_ratio_is_that_of_two_values_of_equation_16() -> None:
    ar = Reals(30)
    inputs = [Fraction(x) for x in ("2/3", "8900", "7850", "0.557", "1.046")]
    one, other, velocity = Fraction("9.13e9"), Fraction("7.6e9"), Fraction(500)

    def depth(resistance: Fraction) -> Any:
        return equation_16(ar, *map(ar.number, [*inputs, resistance, velocity, Fraction(1, 2)]))

    common = ar.number(inputs[4] * inputs[2] * velocity**2)
    ratio = equation_16_ratio(ar, common, ar.number(one), ar.number(other))
    assert abs(depth(other) / depth(one) - ratio) < 1e-28
