"""The order with which an error falls with the step."""

import pytest

from replication.error.ladder import error_order


@pytest.mark.parametrize(
    ("coarse", "fine", "steps", "expected"),
    [
        (0.04, 0.01, 2, 2.0),  # two halvings of the error with one of the step
        (-0.04, -0.02, 9, 1.0),
        (0.0, 0.01, 9, None),  # an error of exactly zero has no logarithm
        (0.01, 0.0, 9, None),
        (0.0, 0.0, 9, None),
        (0.01, -0.01, 9, None),  # between them it was zero
        (0.04, 0.01, 1, None),  # a single step knows nothing of the target
        (None, 0.01, 9, None),
        (0.01, None, 9, None),
    ],
)
def test_an_order_is_there_if_both_errors_have_one_sign(
    coarse: float | None, fine: float | None, steps: int, expected: float | None
) -> None:
    assert error_order(coarse, fine, steps) == expected
