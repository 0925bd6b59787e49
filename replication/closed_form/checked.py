"""What is refused of arrays of cases, by element: at the door, and of the result."""

from collections.abc import Mapping
from math import inf
from typing import Any

import numpy as np

from replication.impact import BEYOND, derived, within

__all__ = ["ElementError", "checked", "first_true", "require_finite", "safe"]

MAY_BE_ZERO = {"time", "at_depth", "at_velocity", "stop_velocity"}
MOTION = ("velocity", "particle_density", "target_density", "resistance", "radius")


class ElementError(ValueError):
    """What is wrong with one element: a text with {place} where its index stands, and the index.

    >>> print(ElementError("velocity{place} is -1.0: it must not be", (0, 3)))
    velocity[0, 3] is -1.0: it must not be
    """

    def __init__(self, text: str, index: tuple[int, ...]) -> None:
        super().__init__(text, index)  # both, or it could not be handed to another process
        self.text, self.index = text, index

    def __str__(self) -> str:
        return self.at(f"[{', '.join(map(str, self.index))}]" if self.index else "")

    def at(self, place: str) -> str:
        """The text with another name for the place."""
        return self.text.format(place=place)


def checked(inputs: Mapping[str, Any]) -> dict[str, Any]:
    """The inputs as float64 arrays, all of them finite and in range.

    Also what the formulas form of them must be such as `Impact` takes. Raises ElementError, and
    TypeError for what are no plain real numbers.
    """
    arrays = {name: _real(name, value) for name, value in inputs.items()}
    ends = {name: _ends(name, array) for name, array in arrays.items() if array.size}
    if not all(safe(name, end) for name, both in ends.items() for end in both):
        _refuse_what_is_formed({name: arrays[name] for name in MOTION if name in arrays})
    return arrays


def safe(name: str, value: float) -> bool:
    """Whether an input may have this value, and forms nothing out of range if all others are safe.

    Six of them at most make a product or quotient, such as the pressure over the resistance.
    """
    return 1e-40 <= value <= 1e40 or (value == 0 and name in MAY_BE_ZERO)


def _real(name: str, value: Any) -> Any:
    if isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"{name} is a masked array: give the cases that are not masked")
    array = np.asarray(value)
    if array.dtype.kind == "c":
        raise TypeError(f"{name} is complex: real numbers are wanted")
    return array.astype(float, copy=False)


def _ends(name: str, array: Any) -> tuple[float, float]:
    """The least and the greatest, if all elements are such as the input may have."""
    low, high = (float(array.min()), float(array.max())) if array.ndim else (float(array),) * 2
    if not (_above(name, low) and high < inf):
        least = "zero or more" if name in MAY_BE_ZERO else "greater than zero"
        index = first_true(~(_above(name, array) & (array < inf)))
        value = float(array[index])
        raise ElementError(
            f"{name}{{place}} is {value!r}: it must be a finite number {least}", index
        )
    return low, high


def _above(name: str, value: Any) -> Any:
    return value >= 0 if name in MAY_BE_ZERO else value > 0


def _refuse_what_is_formed(motion: Mapping[str, Any]) -> None:
    """Refuse the first element for which something that the formulas form is out of range."""
    with np.errstate(all="ignore"):
        formed = derived(**motion)
    for name, values in formed.items():
        bad = ~within(name, values)
        if bad.any():
            index = first_true(bad)
            value = float(values[index])
            raise ElementError(
                f"{name}{{place}} is {value!r}: {BEYOND} ({_listed(motion, bad.shape, index)})",
                index,
            )


def require_finite(arrays: Mapping[str, Any], result: Any, never: str = "") -> None:
    """Refuse the first element that is no finite number, with its inputs and what that means."""
    if np.max(result, initial=0.0) < inf:
        return
    index = first_true(~np.isfinite(result))
    reason = never or f"the result is {float(result[index])!r}"
    raise ElementError(f"{_listed(arrays, result.shape, index, '{place}')}: {reason}", index)


def _listed(
    arrays: Mapping[str, Any], shape: tuple[int, ...], index: tuple[int, ...], place: str = ""
) -> str:
    values = {name: float(np.broadcast_to(array, shape)[index]) for name, array in arrays.items()}
    return ", ".join(f"{name}{place} is {value!r}" for name, value in values.items())


def first_true(bad: Any) -> tuple[int, ...]:
    """The index of the first element that is true."""
    return tuple(int(i) for i in np.unravel_index(np.argmax(bad), np.shape(bad)))
