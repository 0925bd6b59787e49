"""Sweeps: many cases planned in a TOML file, computed in blocks, written as CSV or Parquet.

The values of an input come from a list, a range, a distribution, or Eq. 1. All of them lie within
the `bounds` of their source, even after rounding, so that invalid inputs are found before the run.
"""

import hashlib
import itertools
import math
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from statistics import NormalDist
from typing import Any

import numpy as np
import numpy.typing as npt

from reference.scheme import Scheme
from replication.cases import BETA_5, CASES, INPUTS
from replication.models import arrays
from replication.models.estimates import particle_velocity
from replication.models.impact import Impact, InputError, check_positive, particle_mass
from replication.user_input import (
    KeyedError,
    advice,
    check_keys,
    place,
    quoted,
    read_number,
    read_numbers,
    tables_of,
    within,
)
from spreadsheets.safely import check_target, draft_of

FloatArray = npt.NDArray[np.float64]

BLOCK = 65_536
"""Number of cases computed together; also a row group in Parquet, so it determines the bytes."""

MAX_CASES, MAX_POINTS = 10**12, 10**7
"""The most cases of a plan (days of work for many cores) and points of a range (held in memory)."""

CASE_RESULTS = {"depth": "m", "normalized_depth": "1", "beyond_radius": ""}
"""The results of every case, with their SI units (none for a truth value)."""

EXTRAS = {"stop_time": "s", "sheet_depth": "m", "sheet_steps": "1"}
"""The optional results, with their SI units."""

# The sources of an input's values

LEAST_SHARE = 2.0**-53
"""The smallest of the uniform numbers; the largest is 1 minus this."""


def uniform(seed: int, stream: int, first: int, count: int) -> FloatArray:
    """Return uniform random numbers in (0, 1) for the cases from `first` on, shape (count,).

    Each depends only on the seed, the stream (one for each input) and the number of the case. The
    generator Philox gives four words for each value of its counter; the upper 52 bits of a word,
    plus one half, are scaled to a number.

    >>> bool((uniform(1, 0, 0, 10)[7:] == uniform(1, 0, 7, 3)).all())
    True
    """
    philox = np.random.Philox(key=np.array([seed, stream], dtype=np.uint64), counter=first // 4)
    words = philox.random_raw(first % 4 + count)[first % 4 :]
    return ((words >> np.uint64(12)).astype(np.float64) + 0.5) * (2 * LEAST_SHARE)


@dataclass(frozen=True, slots=True)
class InputValues:
    """The values of one input, all within `bounds`.

    For a list of `count` values, `at` returns those at positions counted from 0. For a
    distribution, `count` is None, and `at` returns its quantiles for probabilities between 0 and 1.
    """

    bounds: tuple[float, float]
    at: Callable[[npt.NDArray[Any]], FloatArray]
    count: int | None = None


@dataclass(frozen=True, slots=True)
class Plan:
    """The cases of a sweep.

    `sources` has every input, in the file's order: the first varies slowest. Each combination of
    listed values has `samples` cases, drawn with `seed`. If the velocity follows from the mass, by
    Eq. 1, it is not in `sources`, and `by_mass` has the average_velocity V [m/s] and average_mass
    m_o [kg]. `extras` are names of `EXTRAS`; `digest` is the SHA-256 of the file. Raises ValueError
    if a combination of inputs leaves the range that `Impact` allows.
    """

    sources: dict[str, InputValues]
    by_mass: Mapping[str, float] | None
    samples: int
    seed: int
    scheme: Scheme
    extras: tuple[str, ...]
    digest: str

    def __post_init__(self) -> None:
        if self.count > MAX_CASES:
            raise ValueError(f"has more than {MAX_CASES:,} cases: split it into several plans")
        # All quantities that `Impact` checks are monotone in each input, so the ends suffice.
        bounds = {name: dict.fromkeys(source.bounds) for name, source in self.sources.items()}
        for corner in itertools.product(*bounds.values()):
            case = dict(zip(bounds, corner, strict=True))
            if law := self.by_mass:
                mass = particle_mass(case["radius"], case["particle_density"])
                # If the mass underflows to zero, `Impact` must refuse the velocity.
                case["velocity"] = particle_velocity(mass=mass, **law) if mass else math.inf
            try:
                Impact(**case)
            except ValueError as error:
                ends = [f"{name} {case[name]!r}" for name in bounds if len(bounds[name]) > 1]
                where = f" (with {', '.join(ends)})" if ends else ""
                name = error.name if isinstance(error, InputError) else ""
                keys = ("inputs", name) if name in self.sources else ()
                raise KeyedError(f"{error}{where}", keys) from error

    @property
    def grid(self) -> dict[str, int]:
        """The number of values of each listed input, the slowest first."""
        return {name: source.count for name, source in self.sources.items() if source.count}

    @property
    def axes(self) -> dict[str, int]:
        """The number of values of each listed input that has several, the slowest first."""
        return {name: count for name, count in self.grid.items() if count > 1}

    @property
    def is_drawn(self) -> bool:
        """Whether any input is drawn at random."""
        return any(source.count is None for source in self.sources.values())

    @property
    def constants(self) -> dict[str, float]:
        """The inputs [SI] that are the same in all cases."""
        only = {name: source for name, source in self.sources.items() if source.count == 1}
        return {name: source.bounds[0] for name, source in only.items()}

    @property
    def count(self) -> int:
        """Number of cases."""
        return self.samples * math.prod(self.grid.values())

    @property
    def blocks(self) -> int:
        """Number of blocks."""
        return -(-self.count // BLOCK)

    @property
    def columns(self) -> dict[str, str]:
        """The SI unit of each column, inputs before results (none for a truth value)."""
        given = {*self.sources, "velocity", "resistance"}
        inputs = {name: unit for name, unit in INPUTS.items() if name in given}
        return inputs | CASE_RESULTS | {name: EXTRAS[name] for name in self.extras}

    def inputs(self, first: int, count: int) -> dict[str, FloatArray]:
        """Return the inputs (SI) of `count` cases from `first` on, in the order of `INPUTS`."""
        values: dict[str, FloatArray] = {}
        position = np.arange(first, first + count) // self.samples
        for name, size in reversed(self.grid.items()):
            position, index = np.divmod(position, size)
            values[name] = self.sources[name].at(index)
        for stream, name in enumerate(INPUTS):
            if name in self.sources and name not in values:
                values[name] = self.sources[name].at(uniform(self.seed, stream, first, count))
        if law := self.by_mass:
            mass = arrays.ufunc(particle_mass)(values["radius"], values["particle_density"])
            args = law["average_velocity"], mass, law["average_mass"]
            values["velocity"] = arrays.ufunc(particle_velocity)(*args)
        if "resistance" not in values:
            values["resistance"] = values["beta"] * values["flow_stress"]
        return {name: values[name] for name in INPUTS if name in values}


def compute(plan: Plan, first: int, count: int) -> dict[str, npt.NDArray[Any]]:
    """Compute `count` cases from number `first` on; return inputs and results (SI) by column.

    Each column has the shape (count,). A case has the same results whatever cases are computed with
    it. Raises ValueError naming the case that the sheet refuses.
    """
    inputs = plan.inputs(first, count)
    motion: dict[str, Any] = {name: inputs[name] for name in BETA_5.motion}
    without_radius = {name: values for name, values in motion.items() if name != "radius"}
    ratio = arrays.normalized_depth(**without_radius)
    results = {
        "depth": motion["radius"] * ratio,
        "normalized_depth": ratio,
        "beyond_radius": ratio > 1,
    }
    if "stop_time" in plan.extras:
        results["stop_time"] = arrays.stop_time(**motion)
    if {"sheet_depth", "sheet_steps"} & set(plan.extras):
        try:
            motion |= {name: inputs[name] for name in ("step", "stop_velocity")}
            sheets = arrays.run_many(**motion, scheme=plan.scheme)
        except InputError as error:
            number = error.index[0]
            given = ", ".join(f"{name} {float(value[number])!r}" for name, value in inputs.items())
            case = f"case {first + number} ({given})"
            raise ValueError(f"{error.name} of {case} {error.problem}") from error
        results |= dict(zip(("sheet_depth", "sheet_steps"), sheets, strict=True))
    return {name: (inputs | results)[name] for name in plan.columns}


# Reading and checking the TOML file (format: docs/sweeps/README.md)

TomlTable = dict[str, Any]


def read_plan(path: Path) -> Plan:
    """Read a plan from a TOML file.

    Raises OSError, or a ValueError that names the file, the line, the table, the key and what is
    allowed.
    """
    with tables_of(path, ["inputs"], ["sweep"]) as (tables, content):
        settings, table = tables.get("sweep", {}), tables["inputs"]
        ways = [value for value in table.values() if isinstance(value, dict)]
        with within("sweep"), place("[sweep]"):
            check_keys(settings, [], ["case", "samples", "seed", "scheme", "outputs"])
            name = _named(settings, "case", "beta-5", CASES)
            scheme = Scheme(_named(settings, "scheme", Scheme.PUBLISHED, Scheme))
            asked = settings.get("outputs", [])
            if not isinstance(asked, list) or any(extra not in [*EXTRAS] for extra in asked):
                problem = f"outputs must be a list of {', '.join(EXTRAS)}; the depths always come"
                raise KeyedError(problem, ("outputs",))
            samples, seed = _sampling(settings, any("distribution" in way for way in ways))
        with within("inputs"), place("[inputs]"):
            sources, by_mass = _sources(table, CASES[name])
        extras = tuple(name for name in EXTRAS if name in asked)
        digest = hashlib.sha256(content).hexdigest()
        return Plan(sources, by_mass, samples, seed, scheme, extras, digest)


def _named(table: TomlTable, key: str, default: str, known: Iterable[str]) -> str:
    """Return the name that a key has, which must be a known one."""
    name, names = table.get(key, default), list(map(str, known))
    if name not in names:
        raise KeyedError(f"there is no {key} {quoted(name)}: {advice(str(name), names)}", (key,))
    return str(name)


def _sampling(settings: TomlTable, drawn: bool) -> tuple[int, int]:
    """Return how many cases to draw, and the seed."""
    if not drawn:
        for key in ("samples", "seed"):
            if key in settings:
                raise KeyedError(f"{key} is for distributions, and no input has one", (key,))
        return 1, 0
    if "samples" not in settings:
        raise ValueError("samples is missing: how many cases to draw")
    seed = _whole_number("seed", settings.get("seed", 0), 0, 2**64 - 1)
    return _whole_number("samples", settings["samples"], 1, MAX_CASES), seed


def _sources(
    table: TomlTable, case: Impact
) -> tuple[dict[str, InputValues], dict[str, float] | None]:
    """Return the sources of all inputs: those of the table in its order, others from the case."""
    check_keys(table, [], INPUTS)
    replaced = ("beta", "flow_stress") if "resistance" in table else ("resistance",)
    rest = {name: getattr(case, name) for name in INPUTS if name not in (*table, *replaced)}
    sources, by_mass = {}, None
    for name, value in (rest | table).items():
        with within(name), place(name):
            if isinstance(value, dict) and "average_mass" in value:
                by_mass = _by_mass(name, value)
            else:
                sources[name] = read_source(name, value)
    for name, source in sources.items():
        for number in source.bounds:
            with within(name):
                check_positive({name: number})
    return sources, by_mass


def read_source(name: str, value: Any) -> InputValues:
    """Read the source of an input, which may still be out of range. Raises ValueError.

    >>> read_source("radius", {"from": "1 um", "to": "5 um", "points": 3}).bounds
    (1e-06, 5e-06)
    """
    if not isinstance(value, dict):
        items = value if isinstance(value, list) else [value]
        if not items:
            raise ValueError("the list is empty: give one value or more")
        values = np.array([read_number(str(item), INPUTS[name]) for item in items])
    elif "distribution" in value:
        return _drawn(value, INPUTS[name])
    elif "from" in value:
        values = _spaced(value, INPUTS[name])
    else:
        raise ValueError("give from, to and points; or distribution; or, by Eq. 1, average_mass")
    return InputValues((float(values.min()), float(values.max())), values.take, len(values))


def _spaced(table: TomlTable, unit: str) -> FloatArray:
    """Return the values of a range."""
    check_keys(table, ["from", "to", "points"], ["scale"])
    scale = _named(table, "scale", "linear", ("linear", "log"))
    ends = {key: table[key] for key in ("from", "to")}
    first, last = read_numbers(ends, dict.fromkeys(ends, unit)).values()
    count = _whole_number("points", table["points"], 2, MAX_POINTS)
    if scale == "linear":
        values = np.linspace(first, last, count)
    elif min(first, last) > 0:
        values = 10.0 ** np.linspace(math.log10(first), math.log10(last), count)
    else:
        raise ValueError("a log scale needs from and to greater than zero")
    values[[0, -1]] = first, last
    return values.clip(min(first, last), max(first, last))


def _drawn(table: TomlTable, unit: str) -> InputValues:
    """Read a distribution."""
    kind = _named(table, "distribution", "", ("normal", "lognormal", "uniform", "loguniform"))
    log, shape, ends = kind.startswith("log"), ["mean", "deviation"], ["lower", "upper"]
    wanted, allowed = (shape, ends) if kind.endswith("normal") else (ends, [])
    check_keys(table, ["distribution", *wanted], allowed)
    given = {key: value for key, value in table.items() if key != "distribution"}
    numbers = read_numbers(given, dict.fromkeys(given, unit))
    for key in ("deviation", *(wanted if log else [])):
        if numbers.get(key, 1.0) <= 0:
            raise KeyedError(f"{key} must be greater than zero", (key,))
    lower, upper = numbers.get("lower", 0.0 if log else -math.inf), numbers.get("upper", math.inf)
    if lower >= upper:
        raise ValueError("lower must be less than upper")
    return _distribution(lower, upper, log, numbers.get("mean"), numbers.get("deviation", 0.0))


def _distribution(
    lower: float, upper: float, log: bool, mean: float | None, deviation: float
) -> InputValues:
    """Return the distribution of a quantity or, if `log`, of its logarithm, by its quantiles.

    It is normal if there is a mean, else uniform. It is truncated at lower and upper, as if values
    outside were drawn again.
    """
    from scipy.special import ndtri

    low, high, normal = lower, upper, None
    if log:
        low, high = (math.log(end) if end > 0 else -math.inf for end in (lower, upper))
    if mean is not None:
        if log:
            ratio = deviation / mean
            variance = math.log1p(ratio * ratio)
            mean, deviation = math.log(mean) - variance / 2, math.sqrt(variance)
        normal = NormalDist(mean, deviation)
        low, high = normal.cdf(low), normal.cdf(high)
        if high - low < 1e-6:
            raise ValueError("less than a millionth of the distribution is between lower and upper")

    def quantile(share: FloatArray) -> FloatArray:
        values = low + (high - low) * share
        if normal:  # rounding must not make a share 1
            values = normal.mean + normal.stdev * ndtri(np.minimum(values, 1 - LEAST_SHARE))
        with np.errstate(over="ignore"):  # the result is infinity, which is then refused
            return np.clip(np.exp(values) if log else values, lower, upper)

    least, greatest = quantile(np.array([LEAST_SHARE, 1 - LEAST_SHARE])).tolist()
    # SciPy's inverse of the normal distribution is correct to 15 digits; the last need not rise.
    wide = (least - 1e-14 * abs(least), greatest + 1e-14 * abs(greatest))
    least, greatest = np.clip(wide, lower, upper).tolist()
    if least < 0:
        raise ValueError(f"values down to {least:.3g} would be drawn: give a lower end")
    return InputValues((least, greatest), quantile)


def _by_mass(name: str, table: TomlTable) -> dict[str, float]:
    """Read the velocity and the mass of the average particle, for Eq. 1."""
    if name != "velocity":
        raise ValueError("only the velocity follows from the mass, by Eq. 1")
    units = {"average_velocity": "m/s", "average_mass": "kg"}
    check_keys(table, units)
    numbers = read_numbers(table, units)
    check_positive(numbers)
    return numbers


def _whole_number(key: str, value: Any, least: int, greatest: int) -> int:
    if type(value) is not int or not least <= value <= greatest:
        raise KeyedError(
            f"{key} is {quoted(value)}: it must be a whole number from {least} to {greatest:,}, "
            "without point or exponent",
            (key,),
        )
    return value


# Writing the file of the cases, completely or not at all


def write_sweep(
    plan: Plan,
    path: Path,
    *,
    numbers: range | None = None,
    done: Callable[[int], object] = lambda _: None,
) -> None:
    """Compute the blocks with these numbers (default: all) and write them to one file.

    The path's suffix is .csv or .parquet. `done` is called with the number of cases of each block.
    The same plan and numbers give the same bytes. Raises as `check_output` and `compute` do, and
    then leaves no file.
    """
    import pyarrow as pa

    check_output(path)
    types = {"beyond_radius": pa.bool_(), "sheet_steps": pa.int64()}
    fields = [
        pa.field(name, types.get(name, pa.float64()), nullable=False, metadata={"unit": unit})
        for name, unit in plan.columns.items()
    ]
    schema = pa.schema(fields, metadata=sweep_provenance(plan))
    numbers = range(plan.blocks) if numbers is None else numbers
    with (
        draft_of(path) as draft,
        draft.open("wb") as file,  # Python's own file, as its errors have an errno
        _writer(path.suffix.lower(), file, plan, schema) as writer,
        ThreadPoolExecutor(1) as pool,  # writes a block while the next is computed
    ):
        written = pool.submit(lambda: None)
        for number in numbers:
            first = number * BLOCK
            count = min(BLOCK, plan.count - first)
            table = pa.table(compute(plan, first, count), schema)
            written.result()
            written = pool.submit(writer.write_table, table)
            done(count)
        written.result()


def _writer(suffix: str, file: Any, plan: Plan, schema: Any) -> Any:
    if suffix == ".csv":
        from pyarrow.csv import CSVWriter, WriteOptions

        heads = (f"{name} [{unit}]" if unit else name for name, unit in plan.columns.items())
        file.write(f"{','.join(heads)}\n".encode("ascii"))
        return CSVWriter(file, schema, write_options=WriteOptions(include_header=False))
    from pyarrow.parquet import ParquetWriter

    # Dictionaries do not pay: results hardly repeat, and inputs compress well without them.
    return ParquetWriter(file, schema, compression="zstd", use_dictionary=False)


def sweep_provenance(plan: Plan) -> dict[str, str]:
    """Return the origin of a file: the program's version and the SHA-256 of the TOML file."""
    return {"coldspray": version("coldspray"), "sweep_sha256": plan.digest}


def check_output(path: Path) -> None:
    """Raise ValueError for another suffix or if PyArrow is missing; OSError as `check_target`."""
    if path.suffix.lower() not in (".csv", ".parquet"):
        raise ValueError(f"{path}: the file's name must end in .csv or .parquet")
    if find_spec("pyarrow") is None:
        raise ValueError(
            "PyArrow, which writes the rows, is not installed: "
            "python -m pip install 'coldspray[sweep]'"
        )
    check_target(path)
