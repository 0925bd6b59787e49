"""What a function of NumPy arrays gives for the containers of other libraries."""

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from itertools import chain
from typing import Any

import numpy as np

from replication.closed_form.checked import ElementError

__all__ = ["lifted"]

Formula = Callable[..., Any]


def lifted(numeric: Formula, inputs: Mapping[str, Any], types: Sequence[type] = (float,)) -> Any:
    """What `numeric` gives for NumPy arrays, for pandas, xarray and dask too; a result for a type.

    They are recognized by their type, so that none is imported before it is in use. Raises
    TypeError for quantities with units of their own.
    """
    kinds = {name: _libraries(value.__class__) for name, value in inputs.items()}
    for name, libraries in kinds.items():
        if "pint" in libraries:
            raise TypeError(f"{name} has units: give its magnitude in SI units")
    for library, lift in _LIFTS.items():
        if any(library in libraries for libraries in kinds.values()):
            return lift(numeric, inputs, types)
    return numeric(**inputs)


@cache
def _libraries(kind: type) -> frozenset[str]:
    return frozenset(parent.__module__.partition(".")[0] for parent in kind.__mro__)


def _xarray(numeric: Formula, inputs: Mapping[str, Any], types: Sequence[type]) -> Any:
    import xarray

    def within(*values: Any) -> Any:
        return lifted(numeric, dict(zip(inputs, values, strict=True)), types)

    results = xarray.apply_ufunc(
        within,
        *inputs.values(),
        output_core_dims=[[]] * len(types),
        dask="allowed",
        keep_attrs=False,  # the result has neither the units nor the name of an input
    )
    return results.rename(None) if len(types) == 1 else tuple(r.rename(None) for r in results)


def _dask(numeric: Formula, inputs: Mapping[str, Any], types: Sequence[type]) -> Any:
    import dask.array

    da: Any = dask.array  # it is partly typed
    arrays = [da.asarray(value) for value in inputs.values()]
    axes = [range(array.ndim)[::-1] for array in arrays]  # counted from the last, as they broadcast
    _, arrays = da.core.unify_chunks(*chain(*zip(arrays, axes, strict=True)), warn=False)
    return da.apply_gufunc(
        lambda *values: numeric(**dict(zip(inputs, values, strict=True))),
        f"{','.join(['()'] * len(inputs))}->{','.join(['()'] * len(types))}",
        *arrays,
        output_dtypes=types[0] if len(types) == 1 else list(types),
    )


def _pandas(numeric: Formula, inputs: Mapping[str, Any], types: Sequence[type]) -> Any:
    import pandas as pd

    series = {name: value for name, value in inputs.items() if isinstance(value, pd.Series)}
    index = _common_index(series)
    for name, value in inputs.items():
        if name not in series and np.shape(value) not in ((), (len(index),)):
            raise TypeError(
                f"{name} is a {type(value).__name__} of shape {np.shape(value)}: beside a Series "
                f"give a Series, a single number, or an array of {len(index)}"
            )
    columns = {name: value.reindex(index).to_numpy() for name, value in series.items()}
    try:
        results = numeric(**{**inputs, **columns})
    except ElementError as error:
        # That of a number beside the Series has no index.
        label = "".join(f"[{index[place]}]" for place in error.index)
        raise ValueError(error.at(label)) from error
    if len(types) == 1:
        return pd.Series(results, index)
    return tuple(pd.Series(result, index) for result in results)


def _common_index(series: Mapping[str, Any]) -> Any:
    """The labels of all, which each must have; in the first one's order."""
    if not series:
        raise TypeError("of pandas a Series is wanted for each input: take columns of a DataFrame")
    index = next(iter(series.values())).index
    for one in series.values():
        index = index.union(one.index, sort=False) if not index.equals(one.index) else index
    for name, one in series.items():
        missing = index.difference(one.index, sort=False)
        if len(missing):
            raise ValueError(f"{name} has nothing for the label {missing[0]}, which others have")
    return index


_LIFTS: dict[str, Formula] = {"xarray": _xarray, "dask": _dask, "pandas": _pandas}
"""A container may hold those after it."""
