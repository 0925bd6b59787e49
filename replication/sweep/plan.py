"""`Plan`: which cases a sweep consists of, in which order, and the inputs of each."""

import itertools
import math
from dataclasses import dataclass

import numpy as np

from replication.case import INPUTS
from replication.impact import Impact
from replication.sweep.draws import Floats, Random, uniform
from replication.sweep.sources import ByMass, Listed, Source, Spaced

__all__ = ["BLOCK", "EXTRAS", "MAX_CASES", "Plan"]

BLOCK = 65_536
"""Cases that are computed together, and in Parquet form a row group. Part of the file's bytes."""

MAX_CASES = 10**12

EXTRAS = ("stop_time", "sheet_depth", "sheet_steps")
"""Results that are computed only if asked for."""


@dataclass(frozen=True, slots=True)
class Plan:
    """The cases of a sweep.

    `sources` has every input, in the order that the file gives them: the first varies slowest, and
    of each combination there are `samples` cases, each with random numbers of its own by `seed`.
    `extras` are of `EXTRAS`; `digest` is the SHA-256 of the file.
    """

    sources: dict[str, Source]
    samples: int
    seed: int
    extras: tuple[str, ...]
    digest: str

    def __post_init__(self) -> None:
        if self.count > MAX_CASES:
            raise ValueError(f"{self.count} cases are more than {MAX_CASES:.0e}: take fewer points")
        self._refuse_cases_out_of_range()

    @property
    def grid(self) -> dict[str, Listed | Spaced]:
        """The sources that are gone through value by value, the slowest first."""
        return {
            name: source
            for name, source in self.sources.items()
            if isinstance(source, Listed | Spaced)
        }

    @property
    def count(self) -> int:
        """Number of cases."""
        return self.samples * math.prod(source.count for source in self.grid.values())

    @property
    def results(self) -> tuple[str, ...]:
        """What is computed of each case."""
        return ("depth", "normalized_depth", "beyond_radius", *self.extras)

    @property
    def blocks(self) -> int:
        """Number of blocks."""
        return -(-self.count // BLOCK)

    def inputs(self, first: int, count: int) -> dict[str, Floats]:
        """The inputs of the cases from `first` on, each of shape (count,), SI, in INPUTS' order."""
        cases = np.arange(first, first + count)
        values = self._grid_values(cases // self.samples)
        for stream, name in enumerate(INPUTS):
            source = self.sources.get(name)
            if isinstance(source, Random):
                values[name] = source.quantile(uniform(self.seed, stream, first, count))
        velocity = self.sources["velocity"]
        if isinstance(velocity, ByMass):
            values["velocity"] = velocity.at(values["radius"], values["particle_density"])
        if "resistance" not in values:
            values["resistance"] = values["beta"] * values["flow_stress"]
        return {name: values[name] for name in INPUTS if name in values}

    def _grid_values(
        self, position: "np.ndarray[tuple[int], np.dtype[np.int64]]"
    ) -> dict[str, Floats]:
        values = {}
        for name, source in reversed(self.grid.items()):
            position, own = np.divmod(position, source.count)
            values[name] = source.at(own)
        return values

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
        radii, densities = np.array([self._bounds("radius"), self._bounds("particle_density")])
        with np.errstate(divide="ignore", over="ignore"):  # a velocity of 0 or infinity is refused
            fast, slow = source.at(radii, densities).tolist()
        return slow, fast
