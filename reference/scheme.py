"""The two schemes of the sheet: the report does not say at which velocity it takes the drag."""

from enum import StrEnum
from typing import NoReturn


class Scheme(StrEnum):
    """A reading of the appendix: at which velocity of a time step the sheet takes the drag.

    The deceleration of a row is taken at the depth in the middle of the step. PUBLISHED takes it at
    the velocity with which the step begins, as Table A-1 has no column of middle velocities: this
    is first order in the step, though the report calls it a mid-point approximation. CENTERED takes
    it at the velocity in the middle, predicted by half a step, and is second order.

    A scheme is also the text that users write, as in `--scheme centered`:

    >>> Scheme("centered") is Scheme.CENTERED, Scheme.PUBLISHED == "published"
    (True, True)
    >>> Scheme("upwind")
    Traceback (most recent call last):
    ValueError: there is no scheme 'upwind': choose one of published, centered
    >>> Scheme.CENTERED.order
    2
    """

    PUBLISHED = "published"
    CENTERED = "centered"

    @classmethod
    def _missing_(cls, value: object) -> NoReturn:
        raise ValueError(f"there is no scheme {value!r}: choose one of {', '.join(cls)}")

    @property
    def order(self) -> int:
        """The order of the final depth's error in the time step."""
        return 1 if self is Scheme.PUBLISHED else 2

    @property
    def drag_at(self) -> str:
        """The velocity of a row that sets its drag: "initial" or "middle"."""
        return "initial" if self is Scheme.PUBLISHED else "middle"
