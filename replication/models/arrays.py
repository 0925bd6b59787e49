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
from typing import TYPE_CHECKING, Any

from replication.models import crater, depth, frank_zook, impact, motion, sheet, stream
from replication.models.impact import MAY_BE_ZERO, InputError, check, check_range

if TYPE_CHECKING:
    import numpy as np

Model = Callable[..., Any]
Inputs = Mapping[str, Any]

LEAST, GREATEST = 1e-40, 1e40
"""Inputs within these form nothing that `check_range` refuses: six at most make a product."""

PIECE = 25_000
"""Of two pieces of so many elements and more, each core takes some in turn. A piece takes a
millisecond, ten times what it takes to hand out, and what it needs stays in the core's cache."""


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
        numbers = _numbers(inputs)
        if set(map(type, numbers.values())) == {float}:
            _check(numbers)
            result = model(*numbers.values())
        else:
            result = _each(ufunc(model), numbers)
        _require_finite(result, numbers, bounded, at_most)
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


def _histories(**inputs: Any) -> Any:
    numbers = _numbers(inputs)
    time, *case = numbers.values()
    # The time is checked by the result, which is NaN where it is negative or not finite.
    _check({name: value for name, value in numbers.items() if name != "time"})
    if set(map(type, case)) != {float} or (type(time) is not float and time.ndim != 1):
        results = _by_rows(_history_loop, numbers, (float, float))
    elif type(time) is float:
        depth, speed = [0.0], [0.0]
        motion.history(*[[time], *case, depth, speed])
        results = depth[0], speed[0]
    else:
        results = _history(time, case)
    _require_finite(results[0], numbers)
    return results


def _history(time: Any, case: Sequence[float]) -> Any:
    import numpy as np

    results = np.empty_like(time), np.empty_like(time)
    compiled(motion.history)(time, *case, *results)
    return results


def _history_loop(rows: Any, depth: Any, speed: Any) -> None:
    """Rows of a time and a case; rows of the same case that follow each other share its series."""
    first = 0
    while first < len(rows):
        _, V, R, rho_p, rho_t, R_t = rows[first]
        last = first + 1
        while (
            last < len(rows)
            and rows[last, 1] == V
            and rows[last, 2] == R
            and (rho_p == rows[last, 3] and rho_t == rows[last, 4] and R_t == rows[last, 5])
        ):
            last += 1
        part = slice(first, last)
        motion.history(rows[part, 0], V, R, rho_p, rho_t, R_t, depth[part], speed[part])
        first = last


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
    cases = _numbers(inputs)
    _check(cases)
    if set(map(type, cases.values())) == {float}:
        depths, steps = sheet.last_row(*[*cases.values(), centered])
        if steps <= sheet.MAX_STEPS and depths < math.inf:
            return depths, steps
    else:
        depths, steps = _by_rows(_sheet_loop, {**cases, "centered": float(centered)}, (float, int))
    for index, case in _elements(steps > sheet.MAX_STEPS, cases):
        problem = sheet.too_many_steps(case["step"], case["stop_velocity"])
        raise ElementError("the sheet", problem, index)
    import numpy as np

    for index, case in _elements(np.isinf(depths), cases):
        raise ElementError("the sheet", sheet.out_of_range(case["step"]), index)
    return depths, steps


def _sheet_loop(rows: Any, depth: Any, steps: Any) -> None:
    for k in range(len(rows)):
        V, R, rho_p, rho_t, R_t, dt, v_stop, centered = rows[k]
        depth[k], steps[k] = sheet.last_row(V, R, rho_p, rho_t, R_t, dt, v_stop, centered > 0)


# What is refused


def _numbers(inputs: Inputs) -> dict[str, Any]:
    return {name: x if type(x) is float else _real(name, x) for name, x in inputs.items()}


def _real(name: str, value: Any) -> Any:
    if isinstance(value, float | int):
        return float(value)
    import numpy as np

    if isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"{name} is a masked array: give the cases that are not masked")
    array = np.asarray(value)
    if array.dtype.kind == "c":
        raise TypeError(f"{name} is complex: real numbers are wanted")
    return array.astype(float, copy=False) if array.ndim else float(array)


def _check(inputs: Inputs, part: Inputs | None = None) -> None:
    """Refuse the first element of the inputs that cannot be, if any is in this part of them."""
    for name, value in (inputs if part is None else part).items():
        least = 0.0 if name in MAY_BE_ZERO else LEAST
        if type(value) is float:
            safe = least <= value <= GREATEST
        else:
            safe = not value.size or (least <= value.min() and value.max() <= GREATEST)
        if not safe:
            return _refuse_first(inputs)
    return None


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


def _each(function: "np.ufunc", cases: Inputs) -> Any:
    """A ufunc of cases that broadcast, checked; of many, by all cores."""
    import numpy as np

    shape = np.broadcast(*cases.values()).shape
    axis = shape.index(max(shape))
    views = {name: np.broadcast_to(value, shape) for name, value in cases.items()}
    arrays = [name for name, value in cases.items() if type(value) is not float]
    _check(cases, {name: value for name, value in cases.items() if type(value) is float})
    result = np.empty(shape)

    def work(first: int, last: int) -> None:
        cut = (slice(None),) * axis + (slice(first, last),)
        part = {name: view[cut] for name, view in views.items()}
        _check(cases, {name: part[name] for name in arrays})
        function(*part.values(), out=result[cut])

    _by_cores(shape[axis], result.size, work)
    return result


def _by_rows(loop: Model, inputs: Inputs, types: Sequence[type]) -> tuple[Any, ...]:
    """What a loop fills in for inputs that broadcast, a row for each of their elements."""
    import numpy as np

    arrays = np.broadcast_arrays(*inputs.values())
    rows = np.stack([array.ravel() for array in arrays], axis=-1)
    results: list[Any] = [np.empty(len(rows), dtype=kind) for kind in types]

    def work(first: int, last: int) -> None:
        compiled(loop)(*(array[first:last] for array in (rows, *results)))

    _by_cores(len(rows), 10 * len(rows), work)
    return tuple(result.reshape(arrays[0].shape) for result in results)


def _by_cores(count: int, size: int, work: Callable[[int, int], None]) -> None:
    """Have the work done from 0 to count, in pieces by all cores if its size is worth it.

    By threads of Python's own, as compiled code lets go of its lock: Numba's may not be started
    from two threads at once, and do not outlive a fork. Only the main thread starts any, so that
    work is not shared out twice where a caller, such as dask, has threads.
    """
    import os
    import threading
    from concurrent.futures import ThreadPoolExecutor

    import numba

    cores = min(numba.config.NUMBA_NUM_THREADS, os.cpu_count() or 1)
    pieces = min(size // PIECE, count)
    if cores == 1 or pieces < 2 or threading.current_thread() is not threading.main_thread():
        work(0, count)
        return
    edges = [count * k // pieces for k in range(pieces + 1)]
    with ThreadPoolExecutor(cores) as pool:
        list(pool.map(work, edges[:-1], edges[1:]))


def ufunc(model: Model) -> "np.ufunc":
    """A model as a NumPy ufunc: its own code, compiled; without a check of its inputs."""
    made: np.ufunc = compiled(model).ufunc
    return made


@cache
def compiled(model: Model) -> Any:
    """What Numba makes of a model, or of a loop. A ufunc in it must not outlive it: it is its code.

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
    time = numba.types.Array(numba.f8, 1, "A", readonly=True)
    several_results = {
        motion.history: (time, *[numba.f8] * 5, numba.f8[::1], numba.f8[::1]),
        _history_loop: (numba.f8[:, :], numba.f8[::1], numba.f8[::1]),
        _sheet_loop: (numba.f8[:, :], numba.f8[::1], numba.i8[::1]),
    }
    if model in several_results:
        compiler = partial(numba.njit, numba.void(*several_results[model]), nogil=True)
    else:
        inputs = [numba.f8] * len(inspect.signature(model).parameters)
        compiler = partial(numba.vectorize, [numba.f8(*inputs)])
    try:
        return compiler(cache=True)(root)
    except (RuntimeError, OSError):
        return compiler(cache=False)(root)


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
    """What `compute` gives for numbers and arrays, for containers too: a result for each type."""
    library = _library(frozenset(map(type, inputs.values())))
    if not library:
        return compute(**inputs)
    if library == "pint":
        names = (name for name in inputs if _library(frozenset({type(inputs[name])})) == "pint")
        raise TypeError(f"{next(names)} has units: give its magnitude in SI units")

    def within(*values: Any) -> Any:
        return _contained(compute, dict(zip(inputs, values, strict=True)), types)

    return _CONTAINED[library](within, inputs, types)


@cache
def _library(kinds: frozenset[type]) -> str:
    """The library of these types that is to be asked first: each may hold those after it."""
    found = {base.__module__.partition(".")[0] for kind in kinds for base in kind.__mro__}
    return next((library for library in ("pint", *_CONTAINED) if library in found), "")


def _xarray(within: Model, inputs: Inputs, types: Sequence[type]) -> Any:
    import xarray

    # The result has neither the units nor the name of an input.
    options: Any = {"output_core_dims": [[]] * len(types), "dask": "allowed", "keep_attrs": False}
    results = xarray.apply_ufunc(within, *inputs.values(), **options)
    return results.rename(None) if len(types) == 1 else tuple(r.rename(None) for r in results)


def _dask(within: Model, inputs: Inputs, types: Sequence[type]) -> Any:
    import dask.array

    da: Any = dask.array  # it is partly typed
    arrays = [da.asarray(value) for value in inputs.values()]
    axes = [range(array.ndim)[::-1] for array in arrays]  # counted from the last, as they broadcast
    pairs = [item for pair in zip(arrays, axes, strict=True) for item in pair]
    _, arrays = da.core.unify_chunks(*pairs, warn=False)
    shapes = f"{','.join(['()'] * len(arrays))}->{','.join(['()'] * len(types))}"
    kinds = list(types) if len(types) > 1 else types[0]
    return da.apply_gufunc(within, shapes, *arrays, output_dtypes=kinds)


def _pandas(within: Model, inputs: Inputs, types: Sequence[type]) -> Any:
    import pandas as pd

    series = [value for value in inputs.values() if isinstance(value, pd.Series)]
    if not series:
        raise TypeError("of pandas a Series is wanted for each input: take columns of a DataFrame")
    index = series[0].index
    try:
        results = within(*(_matched(name, value, index) for name, value in inputs.items()))
    except ElementError as error:
        labels = tuple(index[place] for place in error.index)
        raise ElementError(error.name, error.problem, labels) from None
    if len(types) == 1:
        return pd.Series(results, index)
    return tuple(pd.Series(result, index) for result in results)


def _matched(name: str, value: Any, index: Any) -> Any:
    """An input beside a Series with these labels: its numbers in their order."""
    import numpy as np
    import pandas as pd

    if isinstance(value, pd.Series):
        for label in index.symmetric_difference(value.index, sort=False)[:1]:
            raise ValueError(f"{name} must have the labels of the first Series, so {label} too")
        return value.reindex(index).to_numpy()
    if np.shape(value) not in ((), (len(index),)):
        raise TypeError(
            f"{name} is a {type(value).__name__} of shape {np.shape(value)}: beside a Series "
            f"give a Series, a single number, or an array of {len(index)}"
        )
    return value


_CONTAINED: dict[str, Model] = {"xarray": _xarray, "dask": _dask, "pandas": _pandas}
