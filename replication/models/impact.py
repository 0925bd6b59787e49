"""`Impact`: the checked inputs of one particle hitting one target."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

DEFAULT_STEP, STOP_VELOCITY = 2e-10, 1.0
"""The report's time step [s], and the velocity [m/s] below which its sheet stops."""

MAY_BE_ZERO = frozenset({"time", "at_depth", "at_velocity", "stop_velocity", "particle_strength"})

LEAST_INPUT, GREATEST_INPUT = 1e-40, 1e40
"""`check_products` accepts all inputs in this range, as its products have at most six factors."""


class InputError(ValueError):
    """An invalid input, or invalid value computed from inputs: its name and what is wrong with it.

    For an array it also has the element's index, for a pandas Series its label.

    >>> print(InputError("radius", "is -1.0: it must not be", (0, 3)))
    radius[0, 3] is -1.0: it must not be
    """

    def __init__(self, name: str, problem: str, index: tuple[Any, ...] = ()) -> None:
        super().__init__(name, problem, index)
        self.name, self.problem, self.index = name, problem, index

    def __str__(self) -> str:
        place = f"[{', '.join(map(str, self.index))}]" if self.index else ""
        return f"{self.name}{place} {self.problem}"


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Impact:
    """One case of section 3 and the appendix: all inputs of the spreadsheet.

    velocity V [m/s], radius R [m], particle_density rho_p [kg/m^3], target_density rho_t [kg/m^3],
    step dt [s], stop_velocity [m/s]; the target resistance R_t [Pa] either as `resistance` or as
    the product of `beta` [1] and `flow_stress` Y_t [Pa] (Eq. 7). Raises ValueError naming an input
    that is not finite, not positive (the stop velocity may be zero), missing, given twice, or
    outside of the range of `check_products`.

    >>> Impact(velocity=500, radius=11e-6, particle_density=8900, target_density=7850,
    ...        beta=5, flow_stress=700e6).target_resistance
    3500000000.0
    """

    velocity: float
    radius: float
    particle_density: float
    target_density: float
    beta: float | None = None
    flow_stress: float | None = None
    resistance: float | None = None
    step: float = DEFAULT_STEP
    stop_velocity: float = STOP_VELOCITY

    def __post_init__(self) -> None:
        product = (self.beta is not None, self.flow_stress is not None)
        if self.resistance is not None and any(product):
            raise ValueError("resistance is beta times flow_stress: give it or those two, not both")
        if self.resistance is None and not all(product):
            raise ValueError("give either resistance, or both beta and flow_stress")
        inputs: dict[str, float] = {}
        for field in fields(self):
            name, value = field.name, getattr(self, field.name)
            if value is None and field.default is None:
                continue
            try:
                if isinstance(value, str | bytes | bool):
                    raise TypeError(f"not {value!r}")
                inputs[name] = float(value)
            except (TypeError, ValueError, OverflowError) as error:
                raise InputError(name, f"must be one number, in SI units: {error}") from error
            object.__setattr__(self, name, inputs[name])
        check_positive(inputs)
        check_products(**self.motion, step=self.step)

    def __repr__(self) -> str:
        """The call that makes this case: without what is not given, or is the report's."""
        given = {field.name: getattr(self, field.name) for field in fields(self)
                 if getattr(self, field.name) != field.default}  # fmt: skip
        return f"Impact({', '.join(f'{name}={value!r}' for name, value in given.items())})"

    @property
    def target_resistance(self) -> float:
        """R_t = beta Y_t (Eq. 7) [Pa], or the resistance as given."""
        if self.beta is not None and self.flow_stress is not None:
            return self.beta * self.flow_stress
        assert self.resistance is not None
        return self.resistance

    @property
    def motion(self) -> dict[str, float]:
        """The inputs of Eq. 13: the arguments of `depth.final_depth`, in order."""
        return {
            "velocity": self.velocity,
            "radius": self.radius,
            "particle_density": self.particle_density,
            "target_density": self.target_density,
            "resistance": self.target_resistance,
        }

    @property
    def diameter(self) -> float:
        """D = 2R [m] (below Eq. 12)."""
        return 2 * self.radius

    @property
    def mass(self) -> float:
        """M = (4/3) pi R^3 rho_p [kg], multiplied in the order of the workbook's formula."""
        return particle_mass(self.radius, self.particle_density)


def particle_mass(radius: float, particle_density: float) -> float:
    """M = (4/3) pi R^3 rho_p [kg] (Eq. 3 times the density); R [m], rho_p [kg/m^3].

    >>> f"{particle_mass(11e-6, 8900.0):.2E}"
    '4.96E-11'
    """
    return particle_density * 4 / 3 * math.pi * radius * radius * radius


def check_positive(inputs: Mapping[str, float]) -> None:
    """Raise InputError for the first input that is not finite, or not positive where it must be.

    >>> check_positive({"velocity": 500.0, "radius": -1.0})
    Traceback (most recent call last):
    replication.models.impact.InputError: radius is -1.0: it must be a finite number greater than \
zero
    """
    for name, value in inputs.items():
        if not (0 < value < math.inf or (value == 0 and name in MAY_BE_ZERO)):
            if value == 0 and name == "resistance":
                problem = "is 0.0: nothing would bring the particle to rest"
                raise InputError("target resistance", problem)
            least = ", zero or more" if name in MAY_BE_ZERO else " greater than zero"
            raise InputError(name, f"is {value!r}: it must be a finite number{least}")


def check_products(
    velocity: float = 1.0, particle_density: float = 1.0, target_density: float = 1.0,
    resistance: float = 1.0, radius: float = 1.0, step: float = 1.0, **_: float,
) -> None:  # fmt: skip
    """Raise InputError where squares, products or ratios of the inputs (SI) leave 1e-250 to 1e250.

    Within that range no formula of the models overflows, underflows or divides by zero. Further
    inputs, such as a time, are accepted and ignored, as no such product contains them. An input
    that a model does not take is left out: 1 changes no product.
    """
    mass = particle_mass(radius, particle_density)
    if not 0 < mass < math.inf:
        raise InputError("particle mass", f"is {mass!r}: it must be a number above zero")
    # beta times the flow stress may have underflowed to 0.
    check_in_doubles("target resistance", resistance)
    check_in_doubles("step", step)
    check_in_doubles("radius squared", radius * radius)
    check_in_doubles("velocity squared", velocity * velocity)
    check_in_doubles("particle density", particle_density)
    check_in_doubles("target density", target_density)
    pressure = 0.5 * target_density * velocity * velocity
    check_in_doubles("dynamic pressure", pressure)
    check_in_doubles("dynamic pressure over target resistance", pressure / resistance)
    ratio = particle_density / target_density
    # The depth over the radius is at most some 800 times this ratio, and histories square it.
    check_in_doubles("ratio of the densities squared", ratio * ratio)
    check_in_doubles("kinetic energy density over target resistance", pressure / resistance * ratio)


def least_usual(name: str) -> float:
    """Return the least value of an input of this name with which no product has to be checked.

    >>> least_usual("velocity"), least_usual("at_velocity")
    (1e-40, 0.0)
    """
    return 0.0 if name in MAY_BE_ZERO else LEAST_INPUT


def are_within(values: Sequence[float], least: float, greatest: float) -> bool:
    """Return whether each of the values lies between these two, and so none is NaN.

    >>> are_within([1.0, 2.0], 1.0, 2.0), are_within([1.0, math.nan], 1.0, 2.0)
    (True, False)
    """
    within = True
    # By index and to the end: so the compiler makes it look at several values at once.
    for k in range(len(values)):
        within &= (least <= values[k]) & (values[k] <= greatest)
    return within


def check_magnitudes(**inputs: float) -> None:
    """Raise InputError for the first input that is not in range; zero may be.

    The range is `LEAST_INPUT` to `GREATEST_INPUT`. For formulas with inputs that `check_products`
    does not know, this keeps every product in range.
    """
    for name, value in inputs.items():
        if value and not LEAST_INPUT <= value <= GREATEST_INPUT:
            problem = (
                f"is {value!r}: it is computed with from {LEAST_INPUT:g} to {GREATEST_INPUT:g}"
            )
            raise InputError(name, problem)


def check_in_doubles(name: str, value: float) -> None:
    """Raise InputError unless the value is far enough from the ends of the range of doubles."""
    if not 1e-250 <= value <= 1e250:
        raise InputError(name, f"is {value!r}: doubles carry 1e-250 to 1e250 safely")
