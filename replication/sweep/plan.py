"""`Plan`: which cases a sweep consists of, in which order, and the inputs and results of each."""

import itertools
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from replication.cases import BETA_5, INPUTS
from replication.models import arrays
from replication.models.impact import Impact, particle_mass
from replication.models.stream import particle_velocity
from replication.sweep.sources import ByMass, Floats, Listed, Random, Source, Spaced, uniform

BLOCK = 65_536
"""Cases that are computed together, and in Parquet form a row group. Part of the file's bytes."""

MAX_CASES = 10**12
"""Days of work for many cores."""

RESULTS: dict[str, tuple[str, type]] = {
    "depth": ("m", float),
    "normalized_depth": ("1", float),
    "beyond_radius": ("", bool),
    "stop_time": ("s", float),
    "sheet_depth": ("m", float),
    "sheet_steps": ("1", int),
}
"""What is computed of a case: SI unit (none for a truth value) and type."""

EXTRAS = ("stop_time", "sheet_depth", "sheet_steps")
"""Results that are computed only if asked for."""

Block = dict[str, npt.NDArray[Any]]


@dataclass(frozen=True, slots=True)
class Plan:
    """The cases of a sweep.

    `sources` has every input, in the order that the file gives them: the first varies slowest, and
    of each combination there are `samples` cases, each with random numbers of its own by `seed`.
    `extras` are of `EXTRAS`; `digest` is the SHA-256 of the file. Raises ValueError where an input
    or a combination of them would leave the range that `Impact` allows.
    """

    sources: dict[str, Source]
    samples: int
    seed: int
    extras: tuple[str, ...]
    digest: str

    def __post_init__(self) -> None:
        if self.count > MAX_CASES:
            raise ValueError(f"has more than {MAX_CASES:,} cases: split it into several plans")
        self._refuse_cases_out_of_range()

    @property
    def grid(self) -> dict[str, Listed | Spaced]:
        """The sources that are gone through value by value, the slowest first."""
        sources = self.sources.items()
        return {name: value for name, value in sources if isinstance(value, Listed | Spaced)}

    @property
    def count(self) -> int:
        """Number of cases."""
        return self.samples * math.prod(source.count for source in self.grid.values())

    @property
    def blocks(self) -> int:
        """Number of blocks."""
        return -(-self.count // BLOCK)

    @property
    def columns(self) -> dict[str, tuple[str, type]]:
        """The columns in order, inputs then results: SI unit (none for a truth value) and type."""
        names = [name for name in INPUTS if name in self.sources or name == "resistance"]
        results = ("depth", "normalized_depth", "beyond_radius", *self.extras)
        inputs: dict[str, tuple[str, type]] = {name: (INPUTS[name], float) for name in names}
        return inputs | {name: RESULTS[name] for name in results}

    def inputs(self, first: int, count: int) -> dict[str, Floats]:
        """The inputs of the cases from `first` on, each of shape (count,), SI, in INPUTS' order."""
        values: dict[str, Floats] = {}
        position = np.arange(first, first + count) // self.samples
        for name, source in reversed(self.grid.items()):
            position, own = np.divmod(position, source.count)
            values[name] = source.at(own)
        for stream, name in enumerate(INPUTS):
            drawn = self.sources.get(name)
            if isinstance(drawn, Random):
                values[name] = drawn.quantile(uniform(self.seed, stream, first, count))
        velocity = self.sources["velocity"]
        if isinstance(velocity, ByMass):
            mass = arrays.ufunc(particle_mass)(values["radius"], values["particle_density"])
            law = arrays.ufunc(particle_velocity)
            values["velocity"] = law(velocity.average_velocity, mass, velocity.average_mass)
        if "resistance" not in values:
            values["resistance"] = values["beta"] * values["flow_stress"]
        return {name: values[name] for name in INPUTS if name in values}

    def _refuse_cases_out_of_range(self) -> None:
        """All that `Impact` checks is monotone in each input: the ends stand for the rest."""
        bounds = {name: self._bounds(name) for name in self.sources}
        varying = {name: ends for name, ends in bounds.items() if ends[0] != ends[1]}
        fixed = {name: ends[0] for name, ends in bounds.items()}
        for corner in itertools.product(*varying.values()):
            ends = dict(zip(varying, corner, strict=True))
            try:
                Impact(**{**fixed, **ends})
            except ValueError as error:
                where = ", ".join(f"{name} {value!r}" for name, value in ends.items())
                raise ValueError(f"{error} (with {where})" if ends else str(error)) from error

    def _bounds(self, name: str) -> tuple[float, float]:
        source = self.sources[name]
        if not isinstance(source, ByMass):
            return source.bounds
        ends = zip(self._bounds("radius"), self._bounds("particle_density"), strict=True)
        light, heavy = (particle_mass(*end) for end in ends)
        fast, slow = (
            particle_velocity(source.average_velocity, mass, source.average_mass)
            if mass
            else math.inf  # which is refused
            for mass in (light, heavy)
        )
        return slow, fast


def compute(plan: Plan, first: int, count: int) -> Block:
    """Inputs and results of `count` cases from number `first` on, by column, SI.

    The inputs, depth at rest [m], normalized_depth [1], beyond_radius, and the extras of the plan,
    each of shape (count,): the same for a case whatever is computed beside it. Raises ValueError
    naming the case that the sheet refuses.
    """
    inputs = plan.inputs(first, count)
    motion: dict[str, Any] = {name: inputs[name] for name in BETA_5.motion}
    ratio = arrays.normalized_depth(**{n: x for n, x in motion.items() if n != "radius"})
    results = {
        "depth": inputs["radius"] * ratio,
        "normalized_depth": ratio,
        "beyond_radius": ratio > 1,
    }
    if "stop_time" in plan.extras:
        results["stop_time"] = arrays.stop_time(**motion)
    if {"sheet_depth", "sheet_steps"} & set(plan.extras):
        try:
            stepping: Any = {name: inputs[name] for name in ("step", "stop_velocity")}
            sheets = arrays.run_many(**motion, **stepping)
        except arrays.ElementError as error:
            number = error.index[0]
            given = ", ".join(f"{name} {float(value[number])!r}" for name, value in inputs.items())
            case = f"case {first + number} ({given})"
            raise ValueError(f"{error.name} of {case} {error.problem}") from error
        results |= dict(zip(("sheet_depth", "sheet_steps"), sheets, strict=True))
    return {name: (inputs | results)[name] for name in plan.columns}
