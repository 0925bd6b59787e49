"""The models for whatever holds numbers: the same functions, compiled by Numba for arrays.

A function here takes plain numbers, or NumPy arrays, lists, pandas Series, xarray and dask arrays,
which broadcast (Series are matched by label, dask arrays stay lazy). What it is given is checked,
once a batch: a ValueError names the first bad element by its index, or by its label in a Series.
Plain numbers need neither NumPy nor Numba. All in SI units.
"""

import inspect
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, partial, wraps
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from replication.models import crater, depth, frank_zook, impact, motion, sheet, stream
from replication.models.impact import MAY_BE_ZERO, InputError, check, check_range

if TYPE_CHECKING:
    import numpy as np

__all__ = ["ElementError", "depth_at_velocity", "final_depth", "history", "normalized_depth",
           "run_many", "stop_time", "time_to_depth", "ufunc", "velocity_at_depth"]  # fmt: skip

Model = Callable[..., Any]
Inputs = Mapping[str, Any]

LEAST, GREATEST = 1e-40, 1e40
"""Inputs within these form nothing that `check_range` refuses: six at most make a product."""

LARGE = 20_000
"""So many cases are shared out over the cores: to start threads takes as long as some thousand."""


class ElementError(InputError):
    """An `InputError` of one element of an array.

    >>> print(ElementError("radius", "is 0.0: it must not be", (0, 3)))
    radius[0, 3] is 0.0: it must not be
    """

    def __init__(self, name: str, problem: str, index: tuple[Any, ...]) -> None:
        super().__init__(name, problem)
        self.args, self.index = (name, problem, index), index

    def __str__(self) -> str:
        place = f"[{', '.join(map(str, self.index))}]" if self.index else ""
        return f"{self.name}{place} {self.problem}"


def _for_anything(model: Model, bounded: str = "", at_most: str = "") -> Model:
    """The model for whatever holds numbers; it gives NaN where an input exceeds what it may."""
    signature = inspect.signature(model)
    count = len(signature.parameters)

    @wraps(model)
    def function(*values: Any, **named: Any) -> Any:
        if len(values) == count:
            for value in values:
                if type(value) is not float or not LEAST <= value <= GREATEST:
                    break
            else:
                result = model(*values)
                if result == result:  # not NaN
                    return result
        bound = signature.bind(*values, **named)
        bound.apply_defaults()
        return _contained(compute, bound.arguments, (float,))

    def compute(**inputs: Any) -> Any:
        checked = _checked(inputs)
        plain = set(map(type, checked.values())) == {float}
        values = list(checked.values())
        result = model(*values) if plain else _spread(ufunc(model), values)
        _require_finite(result, checked, bounded, at_most)
        return result

    return function


normalized_depth = _for_anything(depth.normalized_depth)
final_depth = _for_anything(depth.final_depth)
depth_at_velocity = _for_anything(
    depth.depth_at_velocity, "at_velocity", at_most="the impact velocity"
)
velocity_at_depth = _for_anything(depth.velocity_at_depth, "at_depth", at_most="the final depth")
time_to_depth = _for_anything(motion.time_to_depth, "at_depth", at_most="the final depth")
stop_time = _for_anything(motion.stop_time, "stop_velocity", at_most="the impact velocity")


def history(
    time: Any,
    velocity: Any,
    radius: Any,
    particle_density: Any,
    target_density: Any,
    resistance: Any,
) -> Any:
    """Depth [m] and velocity [m/s] at times [s] after touch; time broadcasts against the cases.

    Both are within 1e-14 of the final depth and of the impact velocity; from the stop time on they
    are the final depth and 0. Raises ValueError naming the first element that is out of range.

    >>> depth, speed = history([0.0, 1e-8, 1.0], 500.0, 11e-6, 8900.0, 7850.0, 3.5e9)
    >>> [f"{x * 1e6:.4f}" for x in depth], [f"{v:.2f}" for v in speed]
    (['0.0000', '4.5634', '7.6749'], ['500.00', '378.56', '0.00'])
    """
    inputs = locals()
    return _contained(_histories, inputs, (float, float))


def _histories(time: Any, **inputs: Any) -> tuple[Any, Any]:
    time = _real("time", time)  # which the result checks: NaN where it is negative or not finite
    cases = list(_checked(inputs).values())
    if set(map(type, cases)) != {float}:
        results = _case_by_case(time, cases)
    elif type(time) is float:
        depths, speeds = [0.0], [0.0]
        motion.history(*[[time], *cases, depths, speeds])
        results = depths[0], speeds[0]
    else:
        results = ufunc(motion.history)(time.ravel(), *cases)
        results = tuple(result.reshape(time.shape)[()] for result in results)
    _require_finite(results[0], {"time": time, **inputs})
    return results


def _case_by_case(time: Any, cases: Sequence[Any]) -> Any:
    """Histories with one Taylor series a case for the longest axis along which no case changes."""
    import numpy as np

    shape = np.broadcast(time, *cases).shape
    arrays = [np.broadcast_to(case, (1,) * (len(shape) - np.ndim(case)) + np.shape(case))
              for case in cases]  # fmt: skip
    varied = np.broadcast(*arrays).shape
    axis = max(range(len(shape)), key=lambda axis: shape[axis] if varied[axis] == 1 else 0)
    times = np.broadcast_to(time, shape)
    if varied[axis] != 1:
        times, axis = times[..., None], len(shape)
    else:
        arrays = [array.take(0, axis) for array in arrays]
    results = _spread(ufunc(motion.history), [np.moveaxis(times, axis, -1), *arrays], core=1)
    return tuple(np.moveaxis(result, -1, axis).reshape(shape) for result in results)


def run_many(
    velocity: Any,
    radius: Any,
    particle_density: Any,
    target_density: Any,
    resistance: Any,
    step: Any = 2e-10,
    stop_velocity: Any = 1.0,
    scheme: str = "published",
) -> Any:
    """Final depth X [m] and number of steps of the sheet, for cases that broadcast.

    The same doubles as `sheet.run`, case by case. Raises ValueError naming the first element that
    is out of range or needs more than `sheet.MAX_STEPS` rows.

    >>> depth, steps = run_many(500.0, 11e-6, 8900.0, 7850.0, [2.1e9, 3.5e9])
    >>> [f"{x * 1e6:.2f}" for x in depth], steps.tolist()
    (['10.03', '7.67'], [178, 131])
    """
    inputs = locals()
    sheet.check_scheme(inputs.pop("scheme"))
    return _contained(partial(_sheets, scheme == "centered"), inputs, (float, int))


def _sheets(centered: bool, **inputs: Any) -> Any:
    checked = _checked(inputs)
    depths, steps = _spread(ufunc(_last_row), [*checked.values(), centered])
    for index, case in _elements(steps > sheet.MAX_STEPS, checked):
        problem = sheet.too_many_steps(case["step"], case["stop_velocity"])
        raise ElementError("the sheet", problem, index)
    return depths[()], steps[()]


def _last_row(
    velocity: float,
    radius: float,
    particle_density: float,
    target_density: float,
    resistance: float,
    step: float,
    stop_velocity: float,
    centered: bool,
    depth: Any,
    steps: Any,
) -> None:
    motion = velocity, radius, particle_density, target_density, resistance
    depth[0], steps[0] = sheet.last_row(*motion, step, stop_velocity, centered)


# What is refused


def _checked(inputs: Inputs) -> dict[str, Any]:
    """The inputs as floats and float64 arrays, all of them finite and in range."""
    checked, safe = {}, True
    for name, value in inputs.items():
        number: Any = value if type(value) is float else _real(name, value)
        least = 0.0 if name in MAY_BE_ZERO else LEAST
        if type(number) is float:
            safe = safe and least <= number <= GREATEST
        elif number.size:
            safe = safe and least <= number.min() and number.max() <= GREATEST
        checked[name] = number
    if not safe:
        _refuse_first(checked)
    return checked


def _real(name: str, value: Any) -> Any:
    if isinstance(value, float | int):
        return float(value)
    import numpy as np

    if isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"{name} is a masked array: give the cases that are not masked")
    array = np.asarray(value)
    if array.dtype.kind == "c":
        raise TypeError(f"{name} is complex: real numbers are wanted")
    return array.astype(float, copy=False)


def _refuse_first(inputs: Inputs) -> None:
    """Refuse the first element that `check` or `check_range` refuses."""
    import numpy as np

    arrays = np.broadcast_arrays(*inputs.values())
    doubtful = np.any([~((array >= LEAST) & (array <= GREATEST)) for array in arrays], axis=0)
    formed = inspect.signature(check_range).parameters
    for index, case in _elements(doubtful, inputs):
        try:
            check(case)
            check_range(**{name: value for name, value in case.items() if name in formed})
        except InputError as error:
            raise _placed(error, index, inputs, case) from None


def _require_finite(result: Any, inputs: Inputs, bounded: str = "", at_most: str = "") -> None:
    if math.isfinite(result) if isinstance(result, float) else result.max(initial=0.0) < math.inf:
        return
    import numpy as np

    _refuse_first(inputs)
    for index, case in _elements(~np.isfinite(result), inputs):
        error = InputError("the result", "is beyond what a double can hold")
        if bounded:
            error = InputError(bounded, f"is {case[bounded]!r}: it must not exceed {at_most}")
        raise _placed(error, index, inputs, case)


def _elements(bad: Any, inputs: Inputs) -> Iterator[tuple[tuple[int, ...], dict[str, float]]]:
    """Index and inputs of every element that is bad."""
    import numpy as np

    arrays = {name: np.broadcast_to(value, np.shape(bad)) for name, value in inputs.items()}
    for place in np.argwhere(bad):
        index = tuple(map(int, place))
        yield index, {name: float(array[index]) for name, array in arrays.items()}


def _placed(
    error: InputError, index: tuple[int, ...], inputs: Inputs, case: Mapping[str, float]
) -> ElementError:
    """The error of an element: of an input, with its index in that input's own array."""
    import numpy as np

    if error.name not in inputs:
        values = ", ".join(f"{name} {value!r}" for name, value in case.items())
        return ElementError(error.name, f"{error.problem} (with {values})", index)
    shape = np.shape(inputs[error.name])
    own = index[len(index) - len(shape) :]
    own = tuple(i if size > 1 else 0 for i, size in zip(own, shape, strict=True))
    return ElementError(error.name, error.problem, own)


# How it is computed


def _spread(function: "np.ufunc", values: Sequence[Any], core: int = 0) -> Any:
    """A ufunc of values that broadcast; of many, by all cores.

    By threads of Python's own, as the ufuncs let go of its lock: Numba's may not be started from
    two threads at once, and do not outlive a fork. Only the main thread starts any, so that work is
    not shared out twice where a caller, such as dask, has threads. `core` is the number of the
    first value's last axes that belong to one case.
    """
    import os
    import threading
    from concurrent.futures import ThreadPoolExecutor

    import numba
    import numpy as np

    shape = np.broadcast(*values[core:]).shape
    whole = shape + np.shape(values[0])[len(shape) :] if core else shape
    cores = min(numba.config.NUMBA_NUM_THREADS, os.cpu_count() or 1)
    alone = cores == 1 or threading.current_thread() is not threading.main_thread()
    if alone or math.prod(whole) < LARGE or max(shape, default=1) == 1:
        return function(*values)
    axis = shape.index(max(shape))
    views = [np.broadcast_to(values[0], whole), *(np.broadcast_to(v, shape) for v in values[1:])]
    outputs = tuple(np.empty(whole, kind) for kind in function.types[0].partition("->")[2])
    edges = np.linspace(0, shape[axis], 8 * cores + 1, dtype=int).tolist()

    def compute(ends: tuple[int, int]) -> None:
        cut = (slice(None),) * axis + (slice(*ends),)
        function(*(view[cut] for view in views), out=tuple(output[cut] for output in outputs))

    with ThreadPoolExecutor(cores) as pool:
        list(pool.map(compute, pairwise(edges)))
    return outputs if len(outputs) > 1 else outputs[0]


_SEVERAL_RESULTS = {
    motion.history: ("void(f8[:],f8,f8,f8,f8,f8,f8[:],f8[:])", "(t),(),(),(),(),()->(t),(t)"),
    _last_row: (f"void({'f8,' * 7}b1,f8[:],i8[:])", f"{'(),' * 7}()->(),()"),
}
"""Types and shapes of functions that fill in their last arguments."""


@cache
def ufunc(model: Model) -> "np.ufunc":
    """A model as a NumPy ufunc: its own code, compiled; without a check of its inputs.

    Compiled once and kept on disk; where no folder can be written to, compiled in every process.
    """
    import hashlib
    from pathlib import Path
    from types import FunctionType

    import numba

    _make_known()
    root = FunctionType(model.__code__, model.__globals__, model.__name__)
    # Numba looks whether the file of this function has changed. It calls others: the name tells.
    sources = sorted(Path(__file__).parent.glob("*.py"))
    digest = hashlib.sha256(b"".join(source.read_bytes() for source in sources)).hexdigest()
    root.__qualname__ = f"{model.__name__}_{digest[:16]}"
    if model in _SEVERAL_RESULTS:
        types, shapes = _SEVERAL_RESULTS[model]
        compiler = partial(numba.guvectorize, [types], shapes)
    else:
        inputs = ",".join(["f8"] * len(inspect.signature(model).parameters))
        compiler = partial(numba.vectorize, [f"f8({inputs})"])
    try:
        made: np.ufunc = compiler(cache=True)(root).ufunc
    except (RuntimeError, OSError):
        made = compiler(cache=False)(root).ufunc
    return made


@cache
def _make_known() -> None:
    """Have Numba compile what the models call, with arrays for the coefficients of series."""
    import numpy as np
    from numba.extending import overload, register_jitable

    for module in (crater, depth, frank_zook, impact, motion, sheet, stream):
        for function in vars(module).values():
            if inspect.isfunction(function) and function is not motion.series:
                register_jitable(function)
    length = motion.ORDER + 1
    overload(motion.series)(lambda: lambda: np.zeros(length))


# Containers of other libraries, told by their types, so that none is imported before it is in use


def _contained(compute: Model, inputs: Inputs, types: Sequence[type]) -> Any:
    """What `compute` gives for arrays, for containers too: a result for each type."""
    library = _library(frozenset(map(type, inputs.values())))
    if not library:
        return compute(**inputs)
    if library == "pint":
        names = (name for name in inputs if _library(frozenset({type(inputs[name])})) == "pint")
        raise TypeError(f"{next(names)} has units: give its magnitude in SI units")
    results = _CONTAINED[library](compute, inputs, types)
    return results if len(types) > 1 else results[0]


@cache
def _library(kinds: frozenset[type]) -> str:
    """The library of these types that is to be asked first: each may hold those after it."""
    found = {base.__module__.partition(".")[0] for kind in kinds for base in kind.__mro__}
    return next((library for library in ("pint", *_CONTAINED) if library in found), "")


def _xarray(compute: Model, inputs: Inputs, types: Sequence[type]) -> tuple[Any, ...]:
    import xarray

    def within(*values: Any) -> Any:
        return _contained(compute, dict(zip(inputs, values, strict=True)), types)

    # The result has neither the units nor the name of an input.
    options: Any = {"output_core_dims": [[]] * len(types), "dask": "allowed", "keep_attrs": False}
    results = xarray.apply_ufunc(within, *inputs.values(), **options)
    return tuple(r.rename(None) for r in (results if len(types) > 1 else [results]))


def _dask(compute: Model, inputs: Inputs, types: Sequence[type]) -> tuple[Any, ...]:
    import dask.array

    def within(*values: Any) -> Any:
        return compute(**dict(zip(inputs, values, strict=True)))

    da: Any = dask.array  # it is partly typed
    arrays = [da.asarray(value) for value in inputs.values()]
    axes = [range(array.ndim)[::-1] for array in arrays]  # counted from the last, as they broadcast
    pairs = [item for pair in zip(arrays, axes, strict=True) for item in pair]
    _, arrays = da.core.unify_chunks(*pairs, warn=False)
    shapes = f"{','.join(['()'] * len(arrays))}->{','.join(['()'] * len(types))}"
    kinds = list(types) if len(types) > 1 else types[0]
    results = da.apply_gufunc(within, shapes, *arrays, output_dtypes=kinds)
    return tuple(results) if len(types) > 1 else (results,)


def _pandas(compute: Model, inputs: Inputs, types: Sequence[type]) -> tuple[Any, ...]:
    import numpy as np
    import pandas as pd

    series = [value for value in inputs.values() if isinstance(value, pd.Series)]
    if not series:
        raise TypeError("of pandas a Series is wanted for each input: take columns of a DataFrame")
    index, columns = series[0].index, {}
    for name, value in inputs.items():
        columns[name] = value
        if isinstance(value, pd.Series):
            for label in index.symmetric_difference(value.index, sort=False)[:1]:
                raise ValueError(f"{name} must have the labels of the first Series, so {label} too")
            columns[name] = value.reindex(index).to_numpy()
        elif np.shape(value) not in ((), (len(index),)):
            raise TypeError(
                f"{name} is a {type(value).__name__} of shape {np.shape(value)}: beside a Series "
                f"give a Series, a single number, or an array of {len(index)}"
            )
    try:
        results = compute(**columns)
    except ElementError as error:
        labels = tuple(index[place] for place in error.index)
        raise ElementError(error.name, error.problem, labels) from None
    return tuple(pd.Series(r, index) for r in (results if len(types) > 1 else [results]))


_CONTAINED: dict[str, Model] = {"xarray": _xarray, "dask": _dask, "pandas": _pandas}
