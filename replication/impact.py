"""`Impact`: the inputs of one particle hitting one target, validated once, in SI units."""

import math
from dataclasses import dataclass, fields
from typing import Any

__all__ = ["BETA_3", "BETA_5", "BEYOND", "CASES", "Impact", "checked", "derived", "within"]

BEYOND = "doubles carry 1e-250 to 1e250 safely"
"""Why what is not `within` is refused."""

_MAY_BE_ZERO = {"stop_velocity", "resistance"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Impact:
    """One case of the report's sections 3 and A: what a row of its spreadsheet depends on.

    velocity V [m/s], radius R [m], particle_density rho_p [kg/m^3], target_density rho_t [kg/m^3],
    step dt [s], stop_velocity [m/s]; the target resistance R_t [Pa] either as `resistance` or as
    the product of `beta` [1] and `flow_stress` Y_t [Pa] (Eq. 7). The step and the stop velocity
    default to the appendix's 0.2 ns and 1 m/s.

    Raises ValueError naming the input that is not finite, not positive (the stop velocity may be
    zero), missing, or given twice; and where mass, resistance or dynamic pressure leave the range
    of doubles.

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
    step: float = 2e-10
    stop_velocity: float = 1.0

    def __post_init__(self) -> None:
        self._require_one_resistance()
        for field in fields(self):
            value = getattr(self, field.name)
            if value is not None:
                object.__setattr__(self, field.name, checked(field.name, value))
        if self.target_resistance == 0:
            raise ValueError("target resistance is 0.0: nothing would bring the particle to rest")
        for name, value in derived(**self.motion).items():
            checked(name, value)
            if not within(name, value):
                raise ValueError(f"{name} is {value!r}: {BEYOND}")

    def _require_one_resistance(self) -> None:
        product = (self.beta is not None, self.flow_stress is not None)
        if self.resistance is not None and any(product):
            raise ValueError("resistance stands instead of beta and flow_stress: give one or other")
        if self.resistance is None and not all(product):
            raise ValueError("give either resistance, or both beta and flow_stress")

    @property
    def target_resistance(self) -> float:
        """R_t = beta Y_t (Eq. 7) [Pa], or the resistance as given."""
        if self.resistance is not None:
            return self.resistance
        assert self.beta is not None
        assert self.flow_stress is not None
        return self.beta * self.flow_stress

    @property
    def motion(self) -> dict[str, float]:
        """What Eq. 13 depends on, as arguments of the closed form and the reference, in order."""
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
        """M = (4/3) pi R^3 rho_p [kg], multiplied in the order that the workbook's cell uses.

        >>> f"{BETA_5.mass:.2E}"
        '4.96E-11'
        """
        return float(_mass(self.radius, self.particle_density))


def _mass(r: Any, particle_density: Any) -> Any:
    return particle_density * 4 / 3 * math.pi * r * r * r


def derived(
    velocity: Any, particle_density: Any, target_density: Any, resistance: Any, radius: Any = 1.0
) -> dict[str, Any]:
    """What the formulas form out of the inputs, by name; of numbers or of arrays. SI units.

    >>> f"{derived(500.0, 8900.0, 7850.0, 3.5e9)['dynamic pressure']:.3e}"
    '9.812e+08'
    """
    pressure = 0.5 * target_density * velocity * velocity
    return {
        "target resistance": resistance,
        "particle mass": _mass(radius, particle_density),
        "radius squared": radius * radius,
        "velocity squared": velocity * velocity,
        "particle density": particle_density,
        "target density": target_density,
        "dynamic pressure": pressure,
        "dynamic pressure over target resistance": pressure / resistance,
        "ratio of the densities": particle_density / target_density,
        "work": pressure / resistance * particle_density / target_density,
    }


def within(name: str, value: Any) -> Any:
    """Whether what is `derived` under a name is in range: a number, or each of an array."""
    if name == "particle mass":  # a factor of nothing else; it need only be a number
        return (value > 0) & (value < math.inf)
    return (value >= 1e-250) & (value <= 1e250)


def checked(name: str, value: float) -> float:
    """The number, if an input of this name may have it: finite, positive or, for some, zero.

    >>> checked("radius", -1.0)
    Traceback (most recent call last):
    ValueError: radius is -1.0: it must be a finite number greater than zero
    """
    number = float(value)
    least = "zero or more" if name in _MAY_BE_ZERO else "greater than zero"
    if not math.isfinite(number) or number < 0 or (number == 0 and name not in _MAY_BE_ZERO):
        raise ValueError(f"{name} is {number!r}: it must be a finite number {least}")
    return number


def _report_case(beta: float) -> Impact:
    # The report prints no target density. 7850 kg/m^3 is the handbook value of plain carbon steel
    # that Table A-1 admits; the audit infers the interval and tests hold this value inside it.
    return Impact(
        velocity=500.0,
        radius=11e-6,
        particle_density=8900.0,
        target_density=7850.0,
        beta=beta,
        flow_stress=700e6,
    )


BETA_3 = _report_case(3.0)
BETA_5 = _report_case(5.0)
CASES = {"beta-3": BETA_3, "beta-5": BETA_5}
