"""A formula for blocks of numbers, applied to whatever holds them."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from math import isfinite
from typing import Any

import numpy as np

from replication.closed_form.checked import checked, require_finite, safe
from replication.closed_form.containers import Formula, lifted

__all__ = ["elementwise"]


def elementwise(
    formula: Formula, inputs: Mapping[str, Any], block: int = 16384, never: str = ""
) -> Any:
    """The formula of broadcast inputs, element by element.

    `formula` gets floats or one-dimensional float64 arrays of at most `block` elements, so that
    what it allocates stays in the cache. Raises ValueError for the first element that is out of
    range, or whose result is no finite number; `never` says what that means.
    """

    def numeric(**inputs: Any) -> Any:
        arrays = checked(inputs)
        if all(array.ndim == 0 for array in arrays.values()):
            with np.errstate(all="ignore"):
                result = formula(*(np.float64(array) for array in arrays.values()))
        else:
            result = _in_blocks(formula, list(arrays.values()), block)
        require_finite(arrays, result, never)
        return result

    if all(type(x) is float and safe(name, x) for name, x in inputs.items()):
        # One case: to make arrays of its numbers would take longer than the formula.
        with suppress(ZeroDivisionError, OverflowError):  # which `numeric` explains
            result = float(formula(*inputs.values()))
            if isfinite(result):
                return result
    return lifted(numeric, inputs)


def _in_blocks(formula: Formula, arrays: Sequence[Any], block: int) -> Any:
    # Having seen so large a piece come and go, glibc keeps what a block frees for the next one
    # instead of giving it back to the system (mallopt, M_TRIM_THRESHOLD): twice as fast.
    np.empty(1 << 20)
    flags: Any = [*[["readonly"]] * len(arrays), ["writeonly", "allocate"]]
    blocks = np.nditer(
        [*arrays, None],
        flags=["external_loop", "buffered", "zerosize_ok"],
        op_flags=flags,
        op_dtypes=[float] * (len(arrays) + 1),
        buffersize=block,
    )
    with blocks, np.errstate(all="ignore"):
        for *values, result in blocks:
            result[...] = formula(*values)
        return blocks.operands[-1]
