"""The public models: they take numbers, arrays, Series, and xarray and dask arrays alike.

For arrays Numba compiles the same functions that compute a single case. Inputs broadcast, Series
are aligned by label, and dask arrays stay lazy. All elements of an input are checked at once: a
ValueError names the first bad one by its index, or by its label in a Series. Plain numbers need
neither NumPy nor Numba. Everything is in SI units.
"""

import inspect
import math
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache, partial, wraps
from itertools import repeat
from typing import Any

from reference.scheme import Scheme
from reference.signals import postponed_signals
from replication.models import crater, depth, estimates, impact, inverse, motion, sheet
from replication.models.impact import (
    GREATEST_INPUT,
    LEAST_INPUT,
    InputError,
    check_magnitudes,
    check_positive,
    check_products,
    least_usual,
)

Model = Callable[..., Any]

PIECE = 125_000
"""Final depths in a piece of work; two or more pieces are shared among the cores. A piece takes 1.4
to 5 ms, and starting the threads 0.2 to 2 ms: sharing less work often loses time. A million cases
still keep eight cores busy."""

_DOC = """

Inputs, where it takes them: velocity V [m/s] at impact, radius R [m], particle_density rho_p and
target_density rho_t [kg/m^3], resistance R_t [Pa]; at_velocity v and stop_velocity [m/s]; at_depth
x and the final depth X [m].

Each is a number, an array, a pandas Series, or an xarray or dask array; they broadcast, and the
result is of their kind. Raises ValueError, naming the first element that is out of range, where the
model by itself would give NaN; TypeError for input that is not real numbers.
"""
"""Added to the docstring of each public model of motion."""

_DOC_OF_ESTIMATES = """

Each input is a number, an array, a pandas Series, or an xarray or dask array; they broadcast, and
the result is of their kind. Raises ValueError, naming the first element that is not above zero, or
is too large or too small to compute with; TypeError for input that is not real numbers.
"""
"""Added to the docstring of each public estimate, which says itself what its inputs are."""


def _for_anything(
    model: Model, range_check: Callable[..., None] = check_products, doc: str = _DOC
) -> Model:
    """Return the public form of a model: checked, and for numbers, arrays and other containers."""
    signature = inspect.signature(model)
    least = tuple(map(least_usual, signature.parameters))

    @wraps(model)
    def function(*values: Any, **named: Any) -> Any:
        if _are_plain(values) and (not named or _are_plain(named.values())):
            result = model(*values, **named)
            if result == result:  # not NaN
                return result
        elif not named and _are_lines(values, len(least)):
            try:
                return _each(model, *values, least=least)
            except _UnusualError:  # the first bad element, if there is one, is named below
                pass
        bound = signature.bind(*values, **named)
        bound.apply_defaults()
        compute = partial(_computed, model, partial(_each, model), range_check)
        return _contained(compute, bound.arguments, (float,))

    return _public(function, model, doc)


def _solving(model: Model, name: str) -> Model:
    """Return the public form of a model that solves for the input of this name."""
    signature = inspect.signature(model)

    @wraps(model)
    def function(*values: Any, **named: Any) -> Any:
        if _are_plain(values) and (not named or _are_plain(named.values())):
            result = model(*values, **named)
            if LEAST_INPUT <= result <= GREATEST_INPUT:
                return result
        bound = signature.bind(*values, **named)
        return _contained(partial(_solved, model, name), bound.arguments, (float,))

    return _public(function, model, _DOC)


def _estimating(model: Model) -> Model:
    """Return the public form of an estimate, whose inputs are not those of an impact."""
    return _for_anything(model, check_magnitudes, _DOC_OF_ESTIMATES)


def _public(function: Model, model: Model, doc: str) -> Model:
    """Give the public form of a model its documentation and its signature."""
    function.__doc__ = f"{inspect.getdoc(model)}{doc}"
    # The model's annotations say float, but this function takes more.
    parameters = inspect.signature(model).parameters.values()
    of_anything = [p.replace(annotation=p.empty) for p in parameters]
    function.__signature__ = inspect.Signature(of_anything)  # type: ignore[attr-defined]
    function.__module__ = __name__  # where pickle looks for it
    return function


normalized_depth = _for_anything(depth.normalized_depth)
final_depth = _for_anything(depth.final_depth)
depth_at_velocity = _for_anything(depth.depth_at_velocity)
velocity_at_depth = _for_anything(depth.velocity_at_depth)
time_to_depth = _for_anything(motion.time_to_depth)
stop_time = _for_anything(motion.stop_time)

resistance_for_depth = _solving(inverse.resistance_for_depth, "resistance")
velocity_for_depth = _solving(inverse.velocity_for_depth, "velocity")
radius_for_depth = _solving(inverse.radius_for_depth, "radius")
particle_density_for_depth = _solving(inverse.particle_density_for_depth, "particle_density")
target_density_for_depth = _solving(inverse.target_density_for_depth, "target_density")

crater_depth = _estimating(crater.crater_depth)
crater_volume_ratio = _estimating(crater.crater_volume_ratio)
goodier_beta = _estimating(estimates.goodier_beta)
walker_anderson_alpha = _estimating(estimates.walker_anderson_alpha)
walker_anderson_beta = _estimating(estimates.walker_anderson_beta)
penetration_threshold = _estimating(estimates.penetration_threshold)
constant_pressure_depth = _estimating(estimates.constant_pressure_depth)
_frank_zook = {
    "derived": _estimating(estimates.frank_zook_depth),
    "printed": _estimating(estimates.frank_zook_depth_as_printed),
}


def frank_zook_depth(
    velocity: Any, radius: Any, particle_density: Any, target_density: Any, resistance: Any,
    length_ratio: Any, k_1: Any, k_t: Any, form: str = "derived",
) -> Any:  # fmt: skip
    """Final depth X [m] of a noneroding penetrator by Frank and Zook (Eqs. 14-17).

    The form "derived" is what follows from Eqs. 14 and 15. The form "printed" is Eq. 16, which is
    half of that: it is the depth over the diameter, but is printed as X/R. Inputs are those of
    `final_depth`, but the resistance is fitted to this model (Eq. 17); length_ratio L/D [1], 2/3
    for a sphere; fitting parameters k_1 and k_t [1]. They broadcast. The relative error is below
    2e-15. Raises ValueError naming the first element that is out of range.

    >>> impact = (500.0, 11e-6, 8900.0, 7850.0, 9.13e9, 2 / 3, 0.557, 1.046)
    >>> f"{frank_zook_depth(*impact) / 11e-6:.3f}"
    '0.255'
    >>> f"{frank_zook_depth(*impact, form='printed') / 11e-6:.3f}"
    '0.127'
    """
    if form not in [*_frank_zook]:  # a list, as a dictionary would need a form that hashes
        raise ValueError(f"there is no form {form!r}: choose one of {', '.join(_frank_zook)}")
    impact = velocity, radius, particle_density, target_density, resistance
    return _frank_zook[form](*impact, length_ratio, k_1, k_t)


def history(
    time: Any, velocity: Any, radius: Any, particle_density: Any, target_density: Any,
    resistance: Any,
) -> Any:  # fmt: skip
    """Depth [m] and velocity [m/s] of Eqs. 12-13 at times [s] after touch.

    The other inputs are those of `final_depth`; times broadcast against them. Errors are below
    1e-14 of the final depth and of the impact velocity. So close to rest fewer digits of a velocity
    hold: eight where it has fallen to a millionth of the impact velocity (the time as a double says
    no more; `velocity_at_depth` and `time_to_depth` do). From the stop time on, the results are the
    final depth and 0. Raises ValueError naming the first element that is out of range.

    >>> depth, speed = history([0.0, 1e-8, 1.0], 500.0, 11e-6, 8900.0, 7850.0, 3.5e9)
    >>> [f"{x * 1e6:.4f}" for x in depth], [f"{v:.2f}" for v in speed]
    (['0.0000', '4.5634', '7.6749'], ['500.00', '378.56', '0.00'])
    """
    inputs = locals()
    case = velocity, radius, particle_density, target_density, resistance
    if _is_line(time) and _are_plain(case):
        depth, speed = time.copy(), time.copy()
        try:
            compiled(motion.history, True)(time, *case, depth, speed)
        except ValueError:  # a bad time, which is named below
            pass
        else:
            return depth, speed
    compute = partial(_computed, partial(_filled, motion.history), _histories)
    return _contained(compute, inputs, (float, float))


def _are_plain(values: Iterable[Any]) -> bool:
    """Return whether all values are floats that need no further check (for the fast paths)."""
    for value in values:
        if type(value) is not float or not LEAST_INPUT <= value <= GREATEST_INPUT:
            return False
    return True


def _is_line(time: Any) -> bool:
    """Return whether this is a one-dimensional array that compiled code can take unchanged."""
    if type(time).__name__ != "ndarray" or time.ndim != 1:
        return False
    return bool(time.dtype.char == "d" and time.dtype.isnative and time.flags.carray)


def _are_lines(values: Sequence[Any], count: int) -> bool:
    """Return whether these are so many arrays of one length that compiled code takes unchanged."""
    return len(values) == count and all(map(_is_line, values)) and len(set(map(len, values))) == 1


def _filled(model: Model, first: float, *values: Any) -> tuple[float, Any]:
    """Return both results, for one case, of a model that fills them in; a history's at one time."""
    depth, second = [0.0], [0]
    model([first] if model is motion.history else first, *values, depth, second)
    return depth[0], second[0]


def _histories(*values: Any) -> Any:
    """Return histories; an axis along which only the time varies shares one set of series."""
    import numpy as np

    given = list(map(np.asarray, values))
    rank = max(array.ndim for array in given)
    # Give all of them the same axes, and a last one of length 1.
    time, *cases = (x.reshape((1,) * (rank - x.ndim) + x.shape + (1,)) for x in given)
    shared = [k for k in range(rank + 1) if all(case.shape[k] == 1 for case in cases)]
    axis = max(shared, key=time.shape.__getitem__)
    time, *cases = (array.swapaxes(axis, -1) for array in (time, *cases))
    results = _each(motion.history, time, *(case[..., 0] for case in cases))
    return tuple(result.swapaxes(axis, -1)[..., 0] for result in results)


def run_many(
    velocity: Any, radius: Any, particle_density: Any, target_density: Any, resistance: Any,
    step: Any = impact.DEFAULT_STEP, stop_velocity: Any = impact.STOP_VELOCITY,
    scheme: str = Scheme.PUBLISHED,
) -> Any:  # fmt: skip
    """Final depth X [m] and number of steps of the report's sheet, for cases that broadcast.

    Inputs are those of `final_depth`, step [s] and stop_velocity [m/s]; `scheme` is as for `run`.
    Each result is the same double as that of `run`. Raises ValueError naming the first element
    that is out of range or needs more than `sheet.MAX_STEPS` rows.

    >>> depth, steps = run_many(500.0, 11e-6, 8900.0, 7850.0, [2.1e9, 3.5e9])
    >>> [f"{x * 1e6:.2f}" for x in depth], steps.tolist()
    (['10.03', '7.67'], [178, 131])
    """
    inputs = locals()
    centered = Scheme(inputs.pop("scheme")) is Scheme.CENTERED
    compute = partial(
        _computed,
        lambda *case: _filled(sheet.last_row, *case, centered),
        lambda *cases: _each(sheet.last_row, *cases, centered),
    )
    return _contained(compute, inputs, (float, int))


# Checks


class _UnusualError(Exception):
    """Among the inputs is one that is not `_in_range`, or a result is NaN or infinite."""


def _computed(
    plain: Model, many: Model, range_check: Callable[..., None] = check_products, **inputs: Any
) -> Any:
    """Check the inputs, compute by the plain model or for arrays by `many`, check the results."""
    numbers = _numbers(inputs)
    compute = plain if _are_floats(numbers) else many
    if not _in_range(numbers):
        _refuse(numbers, range_check)
    results = compute(*numbers.values())
    first = results[0] if isinstance(results, tuple) else results
    finite = math.isfinite(first) if isinstance(first, float) else first.max(initial=0.0) < math.inf
    if not finite:
        _refuse(numbers, range_check, first)
    return results


def _solved(model: Model, name: str, **inputs: Any) -> Any:
    """Check the inputs, solve for the input of this name, and check its values.

    In an array a place without a solution is NaN.
    """
    numbers = _numbers(inputs)
    single = _are_floats(numbers)
    usual = _in_range(numbers)
    if not usual:
        _refuse(numbers, lambda **_: None)
    values = model(*numbers.values()) if single else _each(model, *numbers.values())
    if not (usual and _in_range({name: values})):
        _refuse_solutions(numbers, name, values, single)
    return values


def _numbers(inputs: Mapping[str, Any]) -> dict[str, Any]:
    """Return the inputs as floats and arrays of doubles that broadcast; raise an error if not."""
    numbers = {name: x if type(x) is float else _real(name, x) for name, x in inputs.items()}
    if not _are_floats(numbers):
        _common_shape(numbers)
    return numbers


def _are_floats(numbers: Mapping[str, Any]) -> bool:
    return set(map(type, numbers.values())) == {float}


def _in_range(numbers: Mapping[str, Any]) -> bool:
    """Return whether no product of these numbers can leave the range of doubles."""
    return all(
        _is_within(number, least_usual(name), GREATEST_INPUT) for name, number in numbers.items()
    )


def _is_within(number: Any, least: float, greatest: float) -> bool:
    """Return whether a number, or each of an array, lies between these, and so is not NaN."""
    if type(number) is float:
        return least <= number <= greatest
    flags = number.flags
    if flags.c_contiguous and flags.aligned:
        line = number.reshape(-1)  # a view
        line.flags.writeable = False  # the one kind of array that it is compiled for
        return bool(compiled(impact.are_within)(line, least, greatest))
    return bool(least <= number.min(initial=greatest) and number.max(initial=least) <= greatest)


def _common_shape(arrays: Mapping[str, Any]) -> tuple[int, ...]:
    """Return the shape to which the arrays broadcast; raise ValueError if they do not."""
    import numpy as np

    shapes = {name: np.shape(array) for name, array in arrays.items()}
    try:
        return np.broadcast_shapes(*shapes.values())
    except ValueError as error:
        those = ", ".join(f"{name} {shape}" for name, shape in shapes.items() if shape)
        raise ValueError(f"arrays of these shapes do not broadcast: {those}") from error


def _real(name: str, value: Any) -> Any:
    """Return a value as a float or an array of doubles; raise TypeError if it cannot be one."""
    if isinstance(value, float | int):
        try:
            return float(value)
        except OverflowError as error:
            raise TypeError(f"{name} must hold real numbers, in SI units: {error}") from error
    import numpy as np

    if isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"{name} is a masked array: give the cases that are not masked")
    try:
        array = np.asarray(value)
        others = (str, bytes, np.datetime64, np.timedelta64)
        odd = [x for x in array.flat if isinstance(x, others)] if array.dtype == object else []
        if array.dtype.kind in "biufO" and not odd:
            return array.astype(float, copy=False) if array.ndim else float(array)
    except (TypeError, ValueError, OverflowError) as error:
        raise TypeError(f"{name} must hold real numbers, in SI units: {error}") from error
    what = repr(odd[0]) if odd else array.dtype
    raise TypeError(f"{name} must hold real numbers, in SI units, not {what}")


def _refuse(
    numbers: Mapping[str, Any], range_check: Callable[..., None], result: Any = 0.0
) -> None:
    """Raise InputError for the first element that fails a check or has no finite result, if any."""
    for index, value, case in _doubtful(numbers, result):
        try:
            check_positive(case)
            range_check(**case)
            if not math.isfinite(value):
                raise _without_result(case, value)
        except InputError as error:
            raise _at_place(error, index, case, numbers) from None


def _refuse_solutions(numbers: Mapping[str, Any], name: str, result: Any, single: bool) -> None:
    """Raise InputError for the first element, if any, whose solution leaves the range of models."""
    for index, value, case in _doubtful(numbers, result, of_solutions=True):
        try:
            inverse.check_solution(name, value, **case)
        except inverse.NoSolutionError:
            if single:
                raise
        except InputError as error:
            raise _at_place(error, index, case, numbers) from None


def _doubtful(
    numbers: Mapping[str, Any], result: Any, of_solutions: bool = False
) -> Iterator[tuple[tuple[int, ...], float, dict[str, float]]]:
    """Yield index, result and inputs of each element that has to be checked by itself.

    Those are elements with an input outside of `LEAST_INPUT` to `GREATEST_INPUT`, or whose result
    is not finite; of solutions, which are inputs themselves, outside of that range, too.
    """
    if _are_floats({**numbers, "the result": result}):
        yield (), result, dict(numbers)  # one case is checked in any event, and needs no NumPy
        return
    import numpy as np

    arrays = np.broadcast_arrays(result, *numbers.values())
    odd = ~np.isfinite(arrays[0])
    if of_solutions:  # of usual inputs NaN can only mean that there is none
        odd = _unusual(arrays[:1]) & ~np.isnan(arrays[0])
    for place in np.argwhere(_unusual(arrays[1:]) | odd).tolist():
        index = tuple(place)
        value, *values = (float(array[index]) for array in arrays)
        yield index, value, dict(zip(numbers, values, strict=True))


def _unusual(arrays: Sequence[Any]) -> Any:
    """Return where any of the arrays leaves the range in which no product has to be checked."""
    import numpy as np

    return np.any(
        [~((array >= LEAST_INPUT) & (array <= GREATEST_INPUT)) for array in arrays], axis=0
    )


def _at_place(
    error: InputError, index: tuple[int, ...], case: Mapping[str, float], numbers: Mapping[str, Any]
) -> InputError:
    """Return an element's error with its index, and with its inputs if it is not one of them."""
    name, problem = error.name, error.problem
    if name in numbers:  # give the index in that input's own array
        shape = getattr(numbers[name], "shape", ())
        places = zip(index[len(index) - len(shape) :], shape, strict=True)
        index = tuple(i if size > 1 else 0 for i, size in places)
    elif name != "the sheet":
        problem += f" (with {', '.join(f'{key} {x!r}' for key, x in case.items())})"
    return InputError(name, problem, index)


def _without_result(case: Mapping[str, float], result: float) -> InputError:
    """Return the error for a case within range that has no finite result."""
    if "step" in case:
        return sheet.refusal(result, case["step"], case["stop_velocity"])
    for name in ("at_velocity", "at_depth", "stop_velocity"):
        if name in case:
            most = "final depth" if name == "at_depth" else "impact velocity"
            return InputError(name, f"is {case[name]!r}: it must not exceed the {most}")
    return InputError("the result", "is beyond what a double can hold")


# Compiling and computing


def _each(model: Model, *values: Any, least: tuple[float, ...] = ()) -> Any:
    """Return the compiled model's results for values that broadcast, on all cores if it pays.

    The times of histories are a last axis of their own. Where the `least` value of each input is
    given, raises _UnusualError if an input or a result is unusual; each piece is checked when it is
    computed.

    The work is shared among Python threads, which run at the same time because compiled code
    releases Python's lock. Numba's own threads cannot be started from two threads at once and do
    not survive a fork. Only the main thread shares out work: a caller with threads of its own, such
    as dask, has done so already.
    """
    import threading

    import numpy as np

    function = ufunc(model)
    first, *others = map(np.shape, values)
    times = first[-1:] if model is motion.history else ()
    shape = np.broadcast_shapes(first[: len(first) - len(times)], *others)
    # A time, a sheet or a history takes as long as some hundred depths.
    weight = 100 if model.__module__ in (motion.__name__, sheet.__name__) else 1
    pieces = min(math.prod(shape) * weight // PIECE, max(shape, default=0))
    if pieces < 2 or threading.current_thread() is not threading.main_thread():
        return _evaluated(function, values, least)
    from concurrent.futures import ThreadPoolExecutor

    import numba

    axis = shape.index(max(shape))
    views = [np.broadcast_to(values[0], shape + times)]
    views += [np.broadcast_to(value, shape) for value in values[1:]]
    results = [np.empty(shape + times, kind) for kind in function.types[0].partition("->")[2]]

    def work(*parts: Any) -> None:
        _evaluated(function, parts[: len(views)], least, out=parts[len(views) :])

    cut = [np.array_split(array, pieces, axis) for array in (*views, *results)]
    with ThreadPoolExecutor(numba.config.NUMBA_NUM_THREADS) as pool:
        list(pool.map(work, *cut))  # raises the error of a piece, if any
    return tuple(results) if len(results) > 1 else results[0]


def _evaluated(
    function: Any, values: Sequence[Any], least: tuple[float, ...] = (), **options: Any
) -> Any:
    """Call a ufunc without NumPy's warnings: its results are checked, and errors named by place.

    They are checked here, as the values are, if the `least` of each value is given.
    """
    import numpy as np

    if not all(map(_is_within, values, least, repeat(GREATEST_INPUT))):
        raise _UnusualError
    with np.errstate(all="ignore"):
        results = function(*values, **options)
    if least and not _is_within(results, -math.inf, sys.float_info.max):
        raise _UnusualError
    return results


def ufunc(model: Model) -> Any:
    """Return a model compiled as a NumPy ufunc, which does not check its inputs."""
    return compiled(model).ufunc


@cache
def compiled(model: Model, alone: bool = False) -> Any:
    """Compile a model as a ufunc, or `motion.history` for single cases if it is to be `alone`.

    Alone it is a microsecond faster to call. `impact.are_within` takes one array in a row. The
    compiled code is stored on disk, if there is a folder that can be written to. That takes some
    seconds, once. A signal that would end the program acts when it is done: the compiler catches
    some of the errors raised within it.
    """
    with postponed_signals():
        return _compiled(model, alone)


def _compiled(model: Model, alone: bool) -> Any:
    import hashlib
    from pathlib import Path
    from types import FunctionType

    numba = import_numba()
    from filelock import FileLock
    from numba import b1, f8, i8, types, void

    _make_known()
    line = types.Array(f8, 1, "C", readonly=True)
    compilers = {
        motion.history: partial(
            numba.guvectorize,
            [(f8[:], *[f8] * 5, f8[:], f8[:])],
            "(n),(),(),(),(),()->(n),(n)",
        ),
        sheet.last_row: partial(
            numba.guvectorize,
            [(*[f8] * 7, b1, f8[:], i8[:])],
            "(),(),(),(),(),(),(),()->(),()",
        ),
        impact.are_within: partial(numba.njit, [b1(line, f8, f8)], nogil=True),
    }
    numbers = [f8] * len(inspect.signature(model).parameters)
    compiler = compilers.get(model, partial(numba.vectorize, [f8(*numbers)]))
    if alone:
        signature = void(f8[::1], *[f8] * 5, f8[::1], f8[::1])
        compiler = partial(numba.njit, [signature], nogil=True)
    root = FunctionType(model.__code__, model.__globals__, model.__name__)
    # Numba looks only for changes to the model's own file. The hash covers all that it calls.
    sources = sorted(Path(__file__).parent.glob("*.py"))
    digest = hashlib.sha256(b"".join(source.read_bytes() for source in sources)).hexdigest()
    root.__qualname__ = f"{model.__name__}_{compiler.func.__name__}_{digest[:16]}"
    try:
        folder = Path(numba.njit(cache=True)(root).stats.cache_path)
        # Without a lock, two processes compiling at once could store files that do not match.
        with FileLock(folder / "coldspray.lock"):
            try:
                return compiler(cache=True)(root)
            except Exception:  # a damaged file of pickled code may raise any error
                for file in folder.glob(f"*{root.__qualname__}-*.nb[ic]"):
                    file.unlink()
                return compiler(cache=True)(root)
    except (RuntimeError, OSError):
        return compiler(cache=False)(root)


def import_numba() -> Any:
    """Return the module numba. Raises ValueError if it cannot compile in this environment."""
    import warnings
    from pathlib import Path

    try:
        Path.cwd()
    except FileNotFoundError as error:
        problem = "Numba cannot compile in a current folder that was deleted: change to another"
        raise ValueError(problem) from error
    with postponed_signals(), warnings.catch_warnings():
        warnings.filterwarnings("error", "Environment variable", RuntimeWarning)
        try:
            import numba
        except RuntimeWarning as warning:  # it has several lines, the first says which variable
            raise ValueError(f"{str(warning).splitlines()[0]} Correct or unset it") from warning
        except ValueError as error:  # its message does not name the variable, NUMBA_NUM_THREADS
            named = f"an environment variable NUMBA_...: {error} Correct or unset it"
            raise ValueError(named) from error
    if numba.config.DISABLE_JIT:
        raise ValueError("arrays need Numba's compiler: unset NUMBA_DISABLE_JIT")
    return numba


@cache
def _make_known() -> None:
    """Let Numba compile the functions that models call, with arrays in place of lists."""
    import numpy as np
    from numba.extending import overload, register_jitable

    for module in (crater, depth, estimates, impact, inverse, motion, sheet):
        for function in vars(module).values():
            if inspect.isfunction(function) and function is not motion.zeros:
                register_jitable(function)
    overload(math.cbrt)(lambda x: lambda x: np.cbrt(x))  # noqa: ARG005
    overload(motion.zeros)(lambda rows, columns: lambda rows, columns: np.zeros((rows, columns)))  # noqa: ARG005


# Containers of other libraries, recognized by type names so that no unused library is imported


def _contained(compute: Model, inputs: Mapping[str, Any], types: Sequence[type]) -> Any:
    """Return the results of `compute`, of these types, in containers like those of the inputs."""
    library = _library(frozenset(map(type, inputs.values())))
    if not library:
        return compute(**inputs)
    if library == "pint":
        raise TypeError(f"{_of('pint', inputs)[0]} has units: give its magnitude in SI units")

    def within(*values: Any) -> Any:
        return _contained(compute, dict(zip(inputs, values, strict=True)), types)

    return _CONTAINED[library](within, inputs, types)


@cache
def _library(kinds: frozenset[type]) -> str:
    """Return the library among these types whose containers may hold those of the others, or ""."""
    libraries = {base.__module__.partition(".")[0] for kind in kinds for base in kind.__mro__}
    return next((library for library in ("pint", *_CONTAINED) if library in libraries), "")


def _of(library: str, inputs: Mapping[str, Any]) -> list[str]:
    """Return the names of the inputs whose type is from this library."""
    return [name for name, x in inputs.items() if _library(frozenset({type(x)})) == library]


def _xarray(within: Model, inputs: Mapping[str, Any], types: Sequence[type]) -> Any:
    import xarray

    if names := _of("pandas", inputs):
        raise TypeError(f"{names[0]} is a pandas object: beside an xarray array give its values")
    for name, value in inputs.items():
        if isinstance(value, xarray.Dataset):
            raise TypeError(f"{name} is a Dataset: give its variables, each a DataArray")
    # The result must not take over the units or the name of an input.
    options: Any = {"output_core_dims": [[]] * len(types), "dask": "allowed", "keep_attrs": False}
    results = xarray.apply_ufunc(within, *inputs.values(), **options)

    def unnamed(result: Any) -> Any:  # only a DataArray has a name
        return result if isinstance(result, xarray.Variable) else result.rename(None)

    return unnamed(results) if len(types) == 1 else tuple(map(unnamed, results))


def _dask(within: Model, inputs: Mapping[str, Any], types: Sequence[type]) -> Any:
    import dask.array
    import numpy as np

    da: Any = dask.array  # its type hints are incomplete
    labelled = _of("pandas", inputs)  # dask arrays have no labels to align them by
    arrays = [da.asarray(np.asarray(x) if name in labelled else x) for name, x in inputs.items()]
    unknown = [name for name, x in zip(inputs, arrays, strict=True) if math.isnan(sum(x.shape))]
    if unknown and sum(array.ndim > 0 for array in arrays) > 1:
        raise ValueError(
            f"{unknown[0]} has chunks of unknown length: take .to_dask_array(lengths=True)"
        )
    if not unknown:
        _common_shape(dict(zip(inputs, arrays, strict=True)))
    # Number the axes from the last one, as in broadcasting.
    pairs = [item for array in arrays for item in (array, range(array.ndim)[::-1])]
    _, arrays = da.core.unify_chunks(*pairs, warn=False)
    shapes = f"{','.join(['()'] * len(arrays))}->{','.join(['()'] * len(types))}"
    kinds = list(types) if len(types) > 1 else types[0]

    def in_chunk(*values: Any) -> Any:
        try:
            return within(*values)
        except InputError as error:
            raise InputError(error.name, f"of its chunk {error.problem}", error.index) from error

    return da.apply_gufunc(in_chunk, shapes, *arrays, output_dtypes=kinds)


def _pandas(within: Model, inputs: Mapping[str, Any], types: Sequence[type]) -> Any:
    import numpy as np
    import pandas as pd

    index: Any = next((x.index for x in inputs.values() if isinstance(x, pd.Series)), None)
    numbers = dict(inputs)
    for name in _of("pandas", inputs):
        value = inputs[name]
        if isinstance(value, pd.DataFrame):
            raise TypeError(f"{name} is a DataFrame: give its columns, each a Series")
        if isinstance(value, pd.Series):
            for label in index.symmetric_difference(value.index, sort=False)[:1]:
                raise ValueError(f"{name} must have the labels of the first Series, so {label} too")
            repeated = value.index[value.index.duplicated()]
            if len(repeated) and not value.index.equals(index):
                raise ValueError(f"{name} has more than one value for the label {repeated[0]}")
            value = value.reindex(index)
        numbers[name] = np.asarray(value)
    if index is None:
        return within(*numbers.values())
    if (shape := _common_shape(numbers)) != index.shape:
        raise ValueError(f"beside a Series of {len(index)} values arrays must not make it {shape}")
    try:
        results = within(*numbers.values())
    except InputError as error:
        labels = tuple(index[place] for place in error.index)
        raise InputError(error.name, error.problem, labels) from None
    if len(types) == 1:
        return pd.Series(results, index)
    return tuple(pd.Series(result, index) for result in results)


_CONTAINED: dict[str, Model] = {"xarray": _xarray, "dask": _dask, "pandas": _pandas}
