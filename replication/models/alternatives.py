"""The models of the final depth side by side, each with the inputs that it takes and no others.

`Rigid` is the report's model (Eqs. 12-13) without time steps. `ConstantPressure` leaves out the
target's inertia. `FrankZook` is the fitted model of section 3, as Eqs. 14 and 15 give it, and
`FrankZookAsPrinted` the same by Eq. 16. The names of the fields are those of the inputs. Where an
input has the same name in two models its value may still be another: the resistance of Frank and
Zook is fitted to their model.
"""

from dataclasses import asdict, dataclass

from replication.models.depth import final_depth, normalized_depth
from replication.models.estimates import (
    constant_pressure_depth,
    frank_zook_depth,
    frank_zook_depth_as_printed,
)
from replication.models.impact import check_magnitudes, check_positive


@dataclass(frozen=True, slots=True, kw_only=True)
class DepthModel:
    """What every model of the final depth takes.

    Raises ValueError as `check_positive` and `check_magnitudes` do.

    velocity V [m/s], radius R [m], particle_density rho_p [kg/m^3], resistance R_t [Pa].
    """

    velocity: float
    radius: float
    particle_density: float
    resistance: float

    def __post_init__(self) -> None:
        check_positive(asdict(self))
        check_magnitudes(**asdict(self))

    @property
    def final_depth(self) -> float:
        """X [m]."""
        raise NotImplementedError

    @property
    def normalized_depth(self) -> float:
        """X/R [1]."""
        return self.final_depth / self.radius


@dataclass(frozen=True, slots=True, kw_only=True)
class ConstantPressure(DepthModel):
    """A pressure that is R_t throughout: the work R_t CV is the particle's energy.

    >>> model = ConstantPressure(velocity=500.0, radius=11e-6, particle_density=8900.0,
    ...                          resistance=3.5e9)
    >>> f"{model.normalized_depth:.3f}"
    '0.752'
    """

    @property
    def final_depth(self) -> float:
        """X [m], by `estimates.constant_pressure_depth`."""
        return constant_pressure_depth(**asdict(self))


@dataclass(frozen=True, slots=True, kw_only=True)
class Rigid(DepthModel):
    """Eqs. 12-13, with target_density rho_t [kg/m^3]."""

    target_density: float

    @property
    def final_depth(self) -> float:
        """X [m], by `depth.final_depth`."""
        return final_depth(**asdict(self))

    @property
    def normalized_depth(self) -> float:
        """X/R [1], by `depth.normalized_depth`, which does not depend on the radius."""
        inputs = asdict(self)
        del inputs["radius"]
        return normalized_depth(**inputs)


@dataclass(frozen=True, slots=True, kw_only=True)
class FrankZook(DepthModel):
    """Eqs. 14-15, with rho_t [kg/m^3] and length_ratio L/D, k_1 and k_t, all three [1].

    >>> model = FrankZook(velocity=500.0, radius=11e-6, particle_density=8900.0,
    ...                   resistance=9.13e9, target_density=7850.0, length_ratio=2 / 3, k_1=0.557,
    ...                   k_t=1.046)
    >>> f"{model.normalized_depth:.3f}"
    '0.255'
    """

    target_density: float
    length_ratio: float
    k_1: float
    k_t: float

    @property
    def final_depth(self) -> float:
        """X [m], by `estimates.frank_zook_depth`."""
        return frank_zook_depth(**asdict(self))


@dataclass(frozen=True, slots=True, kw_only=True)
class FrankZookAsPrinted(FrankZook):
    """Eq. 16 as it is printed, which gives half the depth of Eqs. 14-15."""

    @property
    def final_depth(self) -> float:
        """X [m], by `estimates.frank_zook_depth_as_printed`."""
        return frank_zook_depth_as_printed(**asdict(self))
