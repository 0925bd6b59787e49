"""A formula for blocks of numbers, applied to whatever holds them: the door of `closed_form`."""

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np

__all__ = ["checked", "elementwise", "lifted", "require_finite"]

Formula = Callable[..., Any]

MAY_BE_ZERO = {"time", "at_depth", "at_velocity", "stop_velocity"}


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
                result = np.float64(formula(*(float(array) for array in arrays.values())))
        else:
            result = _in_blocks(formula, list(arrays.values()), block)
        require_finite(arrays, result, never)
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


def checked(inputs: Mapping[str, Any]) -> dict[str, Any]:
    """The inputs as float64 arrays, all of them finite and in range."""
    arrays = {name: np.asarray(value, dtype=float) for name, value in inputs.items()}
    for name, array in arrays.items():
        if array.size == 0:
            continue
        low, high = (array.min(), array.max()) if array.ndim else (float(array),) * 2
        if not (_above(name, low) and high < np.inf):
            least = "zero or more" if name in MAY_BE_ZERO else "greater than zero"
            index = _first(~(_above(name, array) & (array < np.inf)))
            raise ValueError(f"{_element(name, array, index)}: it must be a finite number {least}")
    return arrays


def _above(name: str, value: Any) -> Any:
    return value >= 0 if name in MAY_BE_ZERO else value > 0


def require_finite(arrays: Mapping[str, Any], result: Any, never: str = "") -> None:
    """Refuse the first element that is no finite number, with its inputs and what that means."""
    if np.max(result, initial=0.0) < np.inf:
        return
    bad = ~np.isfinite(result)
    index = _first(bad)
    found = (
        _element(name, np.broadcast_to(array, bad.shape), index) for name, array in arrays.items()
    )
    raise ValueError(f"{', '.join(found)}: {never or 'the result is beyond the range of doubles'}")


def _first(bad: Any) -> tuple[int, ...]:
    return tuple(int(i) for i in np.unravel_index(np.argmax(bad), np.shape(bad)))


def _element(name: str, array: Any, index: tuple[int, ...]) -> str:
    place = f"[{', '.join(map(str, index))}]" if index else ""
    return f"{name}{place} is {float(array[index])!r}"


def lifted(numeric: Formula, inputs: Mapping[str, Any], outputs: int = 1) -> Any:
    """What `numeric` gives for NumPy arrays, for the containers of other libraries too.

    They are recognized by their type, so that none is imported before it is in use.
    """
    libraries = set().union(*map(_libraries, map(type, inputs.values())))
    for library, lift in _LIFTS.items():
        if library in libraries:
            return lift(numeric, inputs, outputs)
    return numeric(**inputs)


@cache
def _libraries(kind: type) -> frozenset[str]:
    return frozenset(parent.__module__.partition(".")[0] for parent in kind.__mro__)


def _xarray(numeric: Formula, inputs: Mapping[str, Any], outputs: int) -> Any:
    import xarray

    return xarray.apply_ufunc(
        lambda *values: numeric(**dict(zip(inputs, values, strict=True))),
        *inputs.values(),
        output_core_dims=[[]] * outputs,
        dask="parallelized",
        output_dtypes=[float] * outputs,
    )


def _dask(numeric: Formula, inputs: Mapping[str, Any], outputs: int) -> Any:
    import dask.array

    apply: Formula = dask.array.apply_gufunc
    results = ",".join(["()"] * outputs)
    return apply(
        lambda *values: numeric(**dict(zip(inputs, values, strict=True))),
        f"{','.join(['()'] * len(inputs))}->{results}",
        *inputs.values(),
        output_dtypes=float if outputs == 1 else [float] * outputs,
    )


def _pandas(numeric: Formula, inputs: Mapping[str, Any], outputs: int) -> Any:
    import pandas as pd

    frame = pd.DataFrame(dict(inputs))
    results = numeric(**{name: frame[name].to_numpy() for name in inputs})
    if outputs == 1:
        return pd.Series(results, index=frame.index)
    return tuple(pd.Series(result, index=frame.index) for result in results)


_LIFTS = {"xarray": _xarray, "dask": _dask, "pandas": _pandas}
"""A container may hold those after it."""
