"""The models for whatever holds numbers: the same functions, compiled by Numba for arrays.

A function here takes plain numbers, or NumPy arrays, lists, pandas Series, xarray and dask arrays,
which broadcast (Series are matched by label, dask arrays stay lazy). What it is given is checked
once, before anything is computed: a ValueError names the first bad element by its index, or by its
label in a Series. Plain numbers need neither NumPy nor Numba. All in SI units.
"""

import inspect
import math
from collections.abc import Callable, Mapping, Sequence
from functools import cache, wraps
from typing import TYPE_CHECKING, Any

from replication.models import crater, depth, frank_zook, impact, motion, sheet, stream
from replication.models.impact import MAY_BE_ZERO, InputError, check, check_range

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

__all__ = ["depth_at_velocity", "final_depth", "history", "normalized_depth", "run_many",
           "stop_time", "time_to_depth", "ufunc", "velocity_at_depth"]  # fmt: skip

Model = Callable[..., Any]
Inputs = Mapping[str, Any]

SAFE = (1e-40, 1e40)
"""Inputs within these form nothing that `check_range` refuses: six at most make a product."""

LARGE = 20_000
"""So many cases are shared out over the cores: starting threads takes as long as some thousand."""


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


def _for_anything(model: Model, at_most: str = "") -> Model:
    """The model for whatever holds numbers; `at_most` says what its first input must not exceed."""
    signature = inspect.signature(model)
    count, (low, high) = len(signature.parameters), SAFE

    @wraps(model)
    def function(*values: Any, **named: Any) -> Any:
        if len(values) == count:
            for value in values:
                if type(value) is not float or not low <= value <= high:
                    break
            else:
                result = model(*values)
                if result == result:  # not NaN
                    return result
        inputs = _bound(signature, *values, **named)

        def compute(**inputs: Any) -> Any:
            checked = _checked(inputs)
            plain = all(isinstance(value, float) for value in checked.values())
            results = model(*checked.values()) if plain else _spread(ufunc(model), checked)
            _require_finite(results, checked, at_most)
            return results

        return _contained(compute, inputs, (float,))

    return function


def _bound(signature: inspect.Signature, *values: Any, **named: Any) -> dict[str, Any]:
    bound = signature.bind(*values, **named)
    bound.apply_defaults()
    return bound.arguments


normalized_depth = _for_anything(depth.normalized_depth)
final_depth = _for_anything(depth.final_depth)
depth_at_velocity = _for_anything(depth.depth_at_velocity, "the impact velocity")
velocity_at_depth = _for_anything(depth.velocity_at_depth, "the final depth")
time_to_depth = _for_anything(motion.time_to_depth, "the final depth")
stop_time = _for_anything(motion.stop_time, "the impact velocity")


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


def _histories(**inputs: Any) -> tuple[Any, Any]:
    time, *cases = _checked(inputs).values()
    if all(isinstance(value, float) for value in (time, *cases)):
        at_rest = [0.0], [0.0]
        motion.history([time], *cases, *at_rest)
        return at_rest[0][0], at_rest[1][0]
    import numpy as np

    results = _series_by_series(np.asarray(time), cases)
    for result in results:
        _require_finite(result, inputs)
    return results


def _series_by_series(time: Any, cases: Sequence[Any]) -> tuple[Any, Any]:
    """Histories, for times of any shape, with one walk through its Taylor series a case."""
    import numpy as np

    kernel = ufunc(motion.history)
    if time.ndim == 1 and all(isinstance(value, float) for value in cases):
        results: tuple[Any, Any] = kernel(time, *cases)
        return results
    # Axes along which only the time changes are moved to the end and made one.
    whole = np.broadcast(time, *cases).shape
    varied = np.broadcast(*cases).shape
    varied = (1,) * (len(whole) - len(varied)) + varied
    axes = sorted(range(len(whole)), key=lambda axis: varied[axis] == 1)
    kept = sum(size > 1 for size in varied)
    times = np.broadcast_to(time, whole).transpose(axes)
    moved = times.shape
    times = times.reshape(*moved[:kept], math.prod(moved[kept:]))
    cases = [np.broadcast_to(value, varied).transpose(axes).reshape(moved[:kept]) for value in cases]
    results = _spread(kernel, {str(k): value for k, value in enumerate([times, *cases])}, core=1)
    back = np.argsort(axes)
    return tuple(result.reshape(moved).transpose(back)[()] for result in results)  # type: ignore[return-value]


def run_many(
    velocity: Any,
    radius: Any,
    particle_density: Any,
    target_density: Any,
    resistance: Any,
    step: Any = 2e-10,
    stop_velocity: Any = 1.0,
    scheme: str = "published",
) -> tuple[Any, Any]:
    """Final depth X [m] and number of steps of the sheet, for cases that broadcast.

    The same doubles as `sheet.run`, case by case. Raises ValueError naming the first element that
    is out of range or needs more than `sheet.MAX_STEPS` rows.

    >>> depth, steps = run_many(500.0, 11e-6, 8900.0, 7850.0, [2.1e9, 3.5e9])
    >>> [f"{x * 1e6:.2f}" for x in depth], steps.tolist()
    (['10.03', '7.67'], [178, 131])
    """
    inputs = locals()
    centered = inputs.pop("scheme") == "centered"
    sheet.check_scheme(scheme)

    def compute(**inputs: Any) -> tuple[Any, Any]:
        checked = _checked(inputs)
        depths, steps = _spread(ufunc(_last_row), {**checked, "centered": centered})
        _require_few(steps, checked)
        return depths[()], steps[()]

    results: tuple[Any, Any] = _contained(compute, inputs, (float, int))
    return results


def _last_row(
    velocity: float,
    radius: float,
    particle_density: float,
    target_density: float,
    resistance: float,
    step: float,
    stop_velocity: float,
    centered: bool,
    depth: "npt.NDArray[np.float64]",
    steps: "npt.NDArray[np.int64]",
) -> None:
    motion = velocity, radius, particle_density, target_density, resistance
    depth[0], steps[0] = sheet.last_row(*motion, step, stop_velocity, centered)


# What is refused


def _checked(inputs: Inputs) -> dict[str, Any]:
    """The inputs as floats and float64 arrays, all of them finite and in range."""
    checked = {name: _real(name, value) for name, value in inputs.items()}
    if not all(_safe(name, value) for name, value in checked.items()):
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


def _safe(name: str, value: Any) -> bool:
    """Whether all elements lie in `SAFE` or, where that is allowed, are zero."""
    low, high = (0.0 if name in MAY_BE_ZERO else SAFE[0]), SAFE[1]
    if isinstance(value, float):
        return low <= value <= high and (value > 0 or name != "resistance")
    return value.size == 0 or bool(low <= value.min() and value.max() <= high)


def _refuse_first(inputs: Inputs) -> None:
    """Refuse the first element that `check` or `check_range` refuses."""
    import numpy as np

    low, high = SAFE
    arrays = np.broadcast_arrays(*inputs.values())
    doubtful = np.any([~((low <= array) & (array <= high)) for array in arrays], axis=0)
    for place in np.argwhere(doubtful):
        index = tuple(map(int, place))
        case = {name: float(array[index]) for name, array in zip(inputs, arrays, strict=True)}
        try:
            check(case)
            names = inspect.signature(check_range).parameters
            check_range(**{name: value for name, value in case.items() if name in names})
        except InputError as error:
            if error.name in inputs:
                raise _element(error.name, error.problem, index, inputs) from None
            values = ", ".join(f"{name} {value!r}" for name, value in case.items())
            raise ElementError(error.name, f"{error.problem} (with {values})", index) from None


def _element(name: str, problem: str, index: tuple[int, ...], inputs: Inputs) -> ElementError:
    """The error of an element, its index in the broadcast shape, by that in its own array."""
    import numpy as np

    shape = np.shape(inputs[name])
    own = index[len(index) - len(shape) :]
    own = tuple(i if size > 1 else 0 for i, size in zip(own, shape, strict=True))
    return ElementError(name, problem, own)


def _require_finite(result: Any, inputs: Inputs, at_most: str = "") -> None:
    """Refuse the first element that is no finite number; NaN is an input beyond its bound."""
    if isinstance(result, float):
        if math.isfinite(result):
            return
    elif result.size == 0 or result.max() < math.inf:
        return
    import numpy as np

    index = tuple(map(int, np.argwhere(~np.isfinite(result))[0]))
    value = float(np.asarray(result)[index])
    if not (at_most and math.isnan(value)):
        raise ElementError("the result", f"is {value!r}: no double can hold it", index)
    name = "stop_velocity" if "stop_velocity" in inputs else next(iter(inputs))
    given = float(np.broadcast_to(inputs[name], np.shape(result))[index])
    raise _element(name, f"is {given!r}: it must not exceed {at_most}", index, inputs)


def _require_few(steps: Any, inputs: Inputs) -> None:
    import numpy as np

    bad = steps > sheet.MAX_STEPS
    if bad.any():
        index = tuple(map(int, np.argwhere(bad)[0]))
        step, stop = (
            float(np.broadcast_to(inputs[name], bad.shape)[index])
            for name in ("step", "stop_velocity")
        )
        raise ElementError("the sheet", sheet.too_many_steps(step, stop), index)


# How it is computed


def _spread(function: Any, inputs: Inputs, core: int = 0) -> Any:
    """A ufunc of the inputs; of many cases, by all cores.

    Threads of Python's own, as the ufuncs let go of its lock: Numba's may not be started by two
    threads at once, and are lost by a fork. Only the main thread starts any, so that nothing is
    shared out twice where a caller such as dask has threads. `core` counts the last axes of the
    first input that belong to one case.
    """
    import os
    import threading
    from concurrent.futures import ThreadPoolExecutor

    import numba
    import numpy as np

    values = list(inputs.values())
    shape = np.broadcast(*values[1:] if core else values).shape
    cores = min(numba.config.NUMBA_NUM_THREADS, os.cpu_count() or 1)
    alone = cores == 1 or threading.current_thread() is not threading.main_thread()
    if math.prod(shape) * (values[0].shape[-1] if core else 1) < LARGE or alone:
        return function(*values)
    axis = shape.index(max(shape))
    first = np.broadcast_to(values[0], shape + np.shape(values[0])[len(shape) :] if core else shape)
    views = [first, *(np.broadcast_to(value, shape) for value in values[1:])]
    edges = np.linspace(0, shape[axis], 8 * cores + 1, dtype=int).tolist()
    cuts = [(slice(None),) * axis + (slice(*ends),) for ends in zip(edges, edges[1:], strict=False)]
    outputs = [np.empty(first.shape, kind) for kind in function.types[0].partition("->")[2]]

    def compute(cut: tuple[slice, ...]) -> None:
        function(*(view[cut] for view in views), out=tuple(output[cut] for output in outputs))

    with ThreadPoolExecutor(cores) as pool:
        list(pool.map(compute, cuts))
    return outputs[0] if len(outputs) == 1 else tuple(outputs)


@cache
def ufunc(model: Model) -> "np.ufunc":
    """A model as a NumPy ufunc: its own code, compiled; without a check of its inputs.

    Compiled once and kept on disk; where no folder can be written, compiled in every process.
    """
    from types import FunctionType

    _make_known()
    root = FunctionType(model.__code__, model.__globals__, model.__name__)
    # Numba keeps what it has compiled as long as one file stays the same; a model uses others.
    root.__qualname__ = f"{model.__name__}_{_digest()}"
    try:
        return _compiled(root, model, cache=True)
    except (RuntimeError, OSError):
        return _compiled(root, model, cache=False)


def _compiled(root: Model, model: Model, cache: bool) -> "np.ufunc":
    import numba

    if model is motion.history:
        signature, layout = "void(f8[:],f8,f8,f8,f8,f8,f8[:],f8[:])", "(t),(),(),(),(),()->(t),(t)"
        compiled = numba.guvectorize([signature], layout, cache=cache)(root)
    elif model is _last_row:
        signature, layout = f"void({'f8,' * 7}b1,f8[:],i8[:])", f"{'(),' * 7}()->(),()"
        compiled = numba.guvectorize([signature], layout, cache=cache)(root)
    else:
        inputs = ",".join(["f8"] * len(inspect.signature(model).parameters))
        compiled = numba.vectorize([f"f8({inputs})"], cache=cache)(root)
    return compiled.ufunc


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


@cache
def _digest() -> str:
    """Of the source of all models."""
    import hashlib
    from pathlib import Path

    files = sorted(Path(__file__).parent.glob("*.py"))
    return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:16]


# The containers of other libraries, told by their types, so that none is imported before it is used


def _contained(compute: Model, inputs: Inputs, types: Sequence[type]) -> Any:
    """What `compute` gives for numbers and NumPy arrays, for containers too; a result for a type."""
    libraries = {name: _libraries(type(value)) for name, value in inputs.items()}
    for name, found in libraries.items():
        if "pint" in found:
            raise TypeError(f"{name} has units: give its magnitude in SI units")
    used = frozenset().union(*libraries.values())
    # Of these, each may hold those after it.
    for library, contained in (("xarray", _xarray), ("dask", _dask), ("pandas", _pandas)):
        if library in used:
            return contained(compute, inputs, types)
    return compute(**inputs)


@cache
def _libraries(kind: type) -> frozenset[str]:
    return frozenset(parent.__module__.partition(".")[0] for parent in kind.__mro__)


def _xarray(compute: Model, inputs: Inputs, types: Sequence[type]) -> Any:
    import xarray

    results = xarray.apply_ufunc(
        lambda *values: _contained(compute, dict(zip(inputs, values, strict=True)), types),
        *inputs.values(),
        output_core_dims=[[]] * len(types),
        dask="allowed",
        keep_attrs=False,  # the result has neither the units nor the name of an input
    )
    return results.rename(None) if len(types) == 1 else tuple(r.rename(None) for r in results)


def _dask(compute: Model, inputs: Inputs, types: Sequence[type]) -> Any:
    import dask.array

    da: Any = dask.array  # it is partly typed
    arrays = [da.asarray(value) for value in inputs.values()]
    axes = [range(array.ndim)[::-1] for array in arrays]  # counted from the last, as they broadcast
    pairs = [item for pair in zip(arrays, axes, strict=True) for item in pair]
    _, arrays = da.core.unify_chunks(*pairs, warn=False)
    return da.apply_gufunc(
        lambda *values: compute(**dict(zip(inputs, values, strict=True))),
        f"{','.join(['()'] * len(inputs))}->{','.join(['()'] * len(types))}",
        *arrays,
        output_dtypes=types[0] if len(types) == 1 else list(types),
    )


def _pandas(compute: Model, inputs: Inputs, types: Sequence[type]) -> Any:
    import pandas as pd

    series = {name: value for name, value in inputs.items() if isinstance(value, pd.Series)}
    if not series:
        raise TypeError("of pandas a Series is wanted for each input: take columns of a DataFrame")
    index = next(iter(series.values())).index
    columns = {name: _matched(name, value, index) for name, value in inputs.items()}
    try:
        results = compute(**columns)
    except ElementError as error:
        labels = tuple(index[place] for place in error.index)
        raise ElementError(error.name, error.problem, labels) from None
    if len(types) == 1:
        return pd.Series(results, index)
    return tuple(pd.Series(result, index) for result in results)


def _matched(name: str, value: Any, index: Any) -> Any:
    """An input beside a Series with these labels: numbers in the order of the labels."""
    import numpy as np
    import pandas as pd

    if not isinstance(value, pd.Series):
        if np.shape(value) not in ((), (len(index),)):
            raise TypeError(
                f"{name} is a {type(value).__name__} of shape {np.shape(value)}: beside a Series "
                f"give a Series, a single number, or an array of {len(index)}"
            )
        return value
    for label in index.symmetric_difference(value.index, sort=False)[:1]:
        raise ValueError(f"{name} and other inputs must have the same labels: {label} is in one")
    return value.reindex(index).to_numpy()
