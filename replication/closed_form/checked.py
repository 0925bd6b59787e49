"""What is refused of arrays of cases, by element: at the door, and of the result."""

from collections.abc import Mapping
from itertools import product
from typing import Any

import numpy as np

from replication.impact import BEYOND, derived, within

__all__ = ["ElementError", "checked", "first_true", "require_finite"]

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
    if all(array.size for array in arrays.values()):
        ends = {name: _ends(name, array) for name, array in arrays.items()}
        motion = [name for name in MOTION if name in ends]
        # All that is formed is monotone in each input: the ends stand for the rest.
        for corner in product(*(dict.fromkeys(ends[name]) for name in motion)):
            if not all(map(within, *_formed(dict(zip(motion, corner, strict=True))))):
                _refuse_what_is_formed({name: arrays[name] for name in motion})
                break
    return arrays


def _real(name: str, value: Any) -> Any:
    if np.ma.isMaskedArray(value):
        raise TypeError(f"{name} is a masked array: give the cases that are not masked")
    if np.iscomplexobj(value):
        raise TypeError(f"{name} is complex: real numbers are wanted")
    return np.asarray(value, dtype=float)


def _ends(name: str, array: Any) -> tuple[float, float]:
    """The least and the greatest, if all elements are such as the input may have."""
    low, high = (array.min(), array.max()) if array.ndim else (array, array)
    if not (_above(name, low) and high < np.inf):
        least = "zero or more" if name in MAY_BE_ZERO else "greater than zero"
        index = first_true(~(_above(name, array) & (array < np.inf)))
        value = float(array[index])
        raise ElementError(
            f"{name}{{place}} is {value!r}: it must be a finite number {least}", index
        )
    return float(low), float(high)


def _above(name: str, value: Any) -> Any:
    return value >= 0 if name in MAY_BE_ZERO else value > 0


def _formed(motion: Mapping[str, Any]) -> tuple[Any, Any]:
    values = derived(**motion)
    return values.keys(), values.values()


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
    if np.max(result, initial=0.0) < np.inf:
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
