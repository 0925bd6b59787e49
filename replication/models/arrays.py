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


_DOC = """

Inputs are in SI units: velocity V [m/s], radius R [m], densities rho_p and rho_t [kg/m^3], target
resistance R_t [Pa]. Each is a number, an array, a pandas Series, or an xarray or dask array; they
broadcast, and the result is of their kind. Raises ValueError, naming the first element that is out
of range, where the model by itself would give NaN.
"""


def _for_anything(model: Model, bounded: str = "", at_most: str = "") -> Model:
    """The model for whatever holds numbers; it gives NaN where an input exceeds what it may."""
    signature = inspect.signature(model)
    count = len(signature.parameters)

    @wraps(model)
    def function(*values: Any, **named: Any) -> Any:
        if len(values) == count and _are_plain(values):
            result = model(*values)
            if result == result:  # not NaN
                return result
        bound = signature.bind(*values, **named)
        bound.apply_defaults()
        return _contained(compute, bound.arguments, (float,))

    def compute(**inputs: Any) -> Any:
        numbers = _numbers(inputs)
        if _alone(numbers):
            _check(numbers)
            result = model(*numbers.values())
        else:
            (result,) = _each(ufunc(model), numbers, (float,))
        _require_finite(result, numbers, bounded, at_most)
        return result

    function.__doc__ = f"{inspect.getdoc(model)}{_DOC}"
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
    """Depth [m] and velocity [m/s] of Eqs. 12-13 at times [s] after touch.

    Inputs are those of `final_depth`; time broadcasts against them. Both are within 1e-14 of
    the final depth and of the impact velocity; from the stop time on they are the final depth and
    0. Raises ValueError naming the first element that is out of range.

    >>> depth, speed = history([0.0, 1e-8, 1.0], 500.0, 11e-6, 8900.0, 7850.0, 3.5e9)
    >>> [f"{x * 1e6:.4f}" for x in depth], [f"{v:.2f}" for v in speed]
    (['0.0000', '4.5634', '7.6749'], ['500.00', '378.56', '0.00'])
    """
    inputs = locals()
    case = velocity, radius, particle_density, target_density, resistance
    line = type(time).__name__ == "ndarray" and time.ndim == 1 and time.dtype.char == "d"
    if line and _are_plain(case):
        results = ufunc(motion.history)(time, *case)
        if results[0].dot(results[0]) < math.inf:  # none is NaN
            return results
    return _contained(_histories, inputs, (float, float))


def _are_plain(values: Sequence[Any]) -> bool:
    """Whether these are floats that need no other check: the short way for a single case."""
    for value in values:  # noqa: SIM110 - a third of the time that `all` takes
        if type(value) is not float or not LEAST <= value <= GREATEST:
            return False
    return True


def _histories(**inputs: Any) -> Any:
    numbers = _numbers(inputs)
    cases = numbers.copy()
    time = cases.pop("time")  # one that cannot be is told by its result, which is NaN
    if _alone(numbers):
        _check(cases)
        depth, speed = [0.0], [0.0]
        motion.history([time], **cases, depth=depth, speed=speed)
        results = depth[0], speed[0]
    else:
        results = _by_cases(time, cases)
    _require_finite(results[0], numbers)
    return results


def _by_cases(time: Any, cases: dict[str, Any]) -> Any:
    """Histories; the times along an axis in which no case changes share the case's series."""
    import numpy as np

    times = np.asarray(time)
    many = [name for name, value in cases.items() if type(value) is not float]
    if times.ndim and all(cases[name].shape[-1] == 1 for name in many):
        cases.update({name: cases[name][..., 0] for name in many})
        return _each(ufunc(motion.history), cases, (float, float), 20, times)
    results = _each(ufunc(motion.history), cases, (float, float), 20, times[..., None])
    return tuple(result[..., 0] for result in results)


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
    """Final depth X [m] and number of steps of the report's sheet, for cases that broadcast.

    Inputs are those of `final_depth`, and step [s], stop_velocity [m/s], scheme as for `run`. The
    same doubles as `run`, case by case. Raises ValueError naming the first element that
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
    if _alone(cases):
        _check(cases)
        depths, steps = sheet.last_row(**cases, centered=centered)
        if steps <= sheet.MAX_STEPS and depths < math.inf:
            return depths, steps
    else:
        depths, steps = _each(partial(ufunc(_sheet), centered), cases, (float, int), 20)
    for index, case in _elements(steps > sheet.MAX_STEPS, cases):
        problem = sheet.too_many_steps(case["step"], case["stop_velocity"])
        raise ElementError("the sheet", problem, index)
    import numpy as np

    for index, case in _elements(np.isinf(depths), cases):
        raise ElementError("the sheet", sheet.out_of_range(case["step"]), index)
    return depths, steps


def _sheet(
    centered: bool,
    V: float,
    R: float,
    rho_p: float,
    rho_t: float,
    R_t: float,
    dt: float,
    v_stop: float,
    depth: Any,
    steps: Any,
) -> None:
    depth[0], steps[0] = sheet.last_row(V, R, rho_p, rho_t, R_t, dt, v_stop, centered)


# What is refused


def _numbers(inputs: Inputs) -> dict[str, Any]:
    return {name: x if type(x) is float else _real(name, x) for name, x in inputs.items()}


def _alone(numbers: Inputs) -> bool:
    return set(map(type, numbers.values())) == {float}


def _real(name: str, value: Any) -> Any:
    if isinstance(value, float | int):
        return float(value)
    import numpy as np

    if isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"{name} is a masked array: give the cases that are not masked")
    array = np.asarray(value)
    if array.dtype.kind == "c":
        raise TypeError(f"{name} is complex: it must be real")
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

    places = np.argwhere(bad)
    if len(places):
        arrays = {name: np.broadcast_to(value, np.shape(bad)) for name, value in inputs.items()}
    for place in places:
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


def _each(
    function: Model, inputs: Inputs, kinds: Sequence[type], weight: int = 1, time: Any = None
) -> tuple[Any, ...]:
    """What a ufunc gives for inputs that broadcast, checked: an array of each kind.

    Where there are times, their last axis is the ufunc's own. Many cases are shared out to all
    cores; by `weight`, a case is so many times the work of a final depth.
    """
    import numpy as np

    times = [] if time is None else [time]
    shape, own = (), ()
    if times:
        shape, own = time.shape[:-1], time.shape[-1:]
    if not _alone(inputs):
        shape = np.broadcast_shapes(shape, *map(np.shape, inputs.values()))
    pieces = min(math.prod(shape) * weight // PIECE, max(shape, default=0))
    if pieces < 2:
        _check(inputs)
        found = function(*times, *inputs.values())
        return found if len(kinds) > 1 else (found,)
    axis = shape.index(max(shape))
    times = [np.broadcast_to(time, shape + own) for time in times]
    views = {name: np.broadcast_to(value, shape) for name, value in inputs.items()}
    results = tuple(np.empty(shape + own, kind) for kind in kinds)

    def work(first: int, last: int) -> None:
        cut = (slice(None),) * axis + (slice(first, last),)
        part = {name: view[cut] for name, view in views.items()}
        _check(inputs, part)
        out = tuple(result[cut] for result in results)
        function(*(time[cut] for time in times), *part.values(), out=out)

    _by_cores(shape[axis], pieces, work)
    return results


def _by_cores(count: int, pieces: int, work: Callable[[int, int], None]) -> None:
    """Have the work done from 0 to count, in so many pieces, by all cores.

    By threads of Python's own, as compiled code lets go of its lock: Numba's may not be started
    from two threads at once, and do not outlive a fork. Only the main thread starts any, so that
    work is not shared out twice where a caller, such as dask, has threads.
    """
    import os
    import threading
    from concurrent.futures import ThreadPoolExecutor
    from itertools import count as counter

    import numba

    cores = min(numba.config.NUMBA_NUM_THREADS, os.cpu_count() or 1)
    helpers = cores - 1 if threading.current_thread() is threading.main_thread() else 0
    numbers = counter()  # shared: whoever is free takes the next piece

    def take() -> None:
        while (k := next(numbers)) < pieces:
            work(count * k // pieces, count * (k + 1) // pieces)

    with ThreadPoolExecutor(max(helpers, 1)) as pool:
        taken = [pool.submit(take) for _ in range(helpers)]
        take()
    for part in taken:
        part.result()


@cache
def ufunc(model: Model) -> "np.ufunc":
    """A model as a NumPy ufunc: its own code, compiled; without a check of its inputs.

    Compiled once and kept on disk; where no folder can be written to, compiled in every process.
    """
    import hashlib
    from pathlib import Path
    from types import FunctionType

    import numba
    from filelock import FileLock
    from numba import b1, f8, i8

    _make_known()
    root = FunctionType(model.__code__, model.__globals__, model.__name__)
    # Numba looks whether the file of this function has changed. It calls others: the name tells.
    sources = sorted(Path(__file__).parent.glob("*.py"))
    digest = hashlib.sha256(b"".join(source.read_bytes() for source in sources)).hexdigest()
    root.__qualname__ = f"{model.__name__}_{digest[:16]}"
    if model is motion.history:
        types, shapes = [f8[:], *[f8] * 5, f8[:], f8[:]], "(n),(),(),(),(),()->(n),(n)"
        compiler = partial(numba.guvectorize, [tuple(types)], shapes)
    elif model is _sheet:
        types, shapes = [b1, *[f8] * 7, f8[:], i8[:]], "(),(),(),(),(),(),(),()->(),()"
        compiler = partial(numba.guvectorize, [tuple(types)], shapes)
    else:
        types = [f8] * len(inspect.signature(model).parameters)
        compiler = partial(numba.vectorize, [f8(*types)])
    try:
        folder = numba.njit(cache=True)(root).stats.cache_path
        # Two processes that compile at once would keep halves that do not belong together.
        with FileLock(Path(folder) / "coldspray.lock"):
            compiled = compiler(cache=True)(root)
    except (RuntimeError, OSError):
        compiled = compiler(cache=False)(root)
    _KEPT.append(compiled)
    made: np.ufunc = compiled.ufunc
    return made


_KEPT: list[Any] = []
"""What Numba has compiled: a ufunc in it must not outlive it, as it is its code."""


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
        raise TypeError("a DataFrame is no input: give its columns, each a Series")
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
