"""Comparing two maps of values: exact by default, every difference named."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from spreadsheets.compare import Difference, Values, compare, ulps_apart


def test_one_ulp_is_a_difference_and_empty_text_none() -> None:
    values: Values = {"S": {"A1": 1.0, "A2": "text", "A3": True}}
    assert compare(values, {"S": {**values["S"], "B1": ""}}) == []
    found = compare(values, {"S": {**values["S"], "A1": math.nextafter(1.0, 2.0)}})
    assert found == [Difference("S", "A1", 1.0, math.nextafter(1.0, 2.0))]
    assert str(found[0]) == "S!A1: expected 1.0, found 1.0000000000000002 (1 ulp)"


def test_only_named_cells_are_allowed_a_distance() -> None:
    expected, found = {"S": {"A1": 10.0, "A2": 10.0}}, {"S": {"A1": 10.1, "A2": 10.1}}
    (left,) = compare(expected, found, {("S", "A1"): 0.2})
    assert left.cell == "A2"
    assert len(compare(expected, found, {("S", "A1"): 0.05})) == 2  # it is not relative


@pytest.mark.parametrize(("want", "got"), [(0.0, None), (1.0, "1.0"), ("#N/A", 1.0), ("a", "b")])
def test_kinds_are_not_mixed(want: float | str, got: float | str | None) -> None:
    found = {"S": {} if got is None else {"A1": got}}
    (left,) = compare({"S": {"A1": want}}, found, {("S", "A1"): 9.0})
    assert (left.expected, left.found, left.ulps) == (want, got, None)


def test_surplus_cells_and_sheets_are_differences() -> None:
    left = compare({"S": {}}, {"S": {"B1": 1.0}, "T": {"A1": "x"}})
    assert [(d.sheet, d.cell, d.expected) for d in left] == [("S", "B1", None), ("T", "A1", None)]


@given(st.floats(allow_nan=False, allow_infinity=False, max_value=1e308))
def test_neighbors_are_one_ulp_apart(number: float) -> None:
    above = math.nextafter(number, math.inf)
    assert ulps_apart(number, above) == ulps_apart(above, number) == 1
    assert ulps_apart(-5e-324, 5e-324) == 2
