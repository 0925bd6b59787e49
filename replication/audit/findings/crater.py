"""The observed craters, the velocities they belong to, and how the model's depths stand to them."""

import math
from fractions import Fraction
from statistics import NormalDist

from replication.audit.entries import rounding
from replication.audit.findings.known import Computed, Known, model_ratio
from replication.models import crater, stream

__all__ = ["EVIDENCE"]


def _observed_digits(known: Known) -> Computed:
    line = known.number("volume-ratio-line")
    least, greatest = rounding(known.ledger, "volume-ratio")
    from_line = float(crater.depth_from_volume_ratio(line))
    return {
        "line": from_line,
        "line_depth": from_line * known.number("observed-depth-diameter") / 2,
        "least": float(crater.depth_from_volume_ratio(float(least))),
        "greatest": float(crater.depth_from_volume_ratio(float(greatest))),
        "check": _volume_ratio(known.exact("observed-depth-ratio")),
        "check_line": _volume_ratio(Fraction(round(from_line, 3)).limit_denominator(1000)),
    }


def _volume_ratio(y: Fraction) -> Fraction:
    """CV/PV at X/R = y (Eqs. 2 and 3), exactly."""
    return y * y * (3 - y) / 4


def _profile_depth(known: Known) -> Computed:
    depth, radius = known.exact("profile-depth"), known.exact("mean-diameter") / 2
    volume_ratio = _volume_ratio(depth / radius)
    return {
        "ratio": depth / radius,
        "volume_ratio": volume_ratio,
        "fraction": known.exact("volume-ratio") / volume_ratio,
        "diameter": 2 * depth / known.exact("observed-depth-ratio"),
    }


def _too_high(known: Known) -> Computed:
    excess = "excess over the observed value"
    return {
        "ratio_3": known.computed("excess-beta-3"),
        "ratio_5": known.computed("excess-beta-5"),
        "excess_3": known.computed("excess-beta-3", excess),
        "excess_5": known.computed("excess-beta-5", excess),
    }


def _compared_velocity(known: Known) -> Computed:
    speeds = (521, 606, 403)
    return {
        **{f"at_{s}": model_ratio(velocity=known.number(f"velocity-{s}")) for s in speeds},
        "volume_high": _volume_ratio(known.exact("ratio-beta-5")),
        "volume_low": _volume_ratio(known.exact("ratio-beta-3")),
    }


def _scatter(known: Known) -> Computed:
    mean, velocity = known.number("mean-diameter"), known.number("a1-initial-velocity")
    power = -3 * known.exact("eq1-power")  # mass goes with the cube of the diameter
    scatter = abs(float(power)) * known.number("diameter-deviation") / mean * velocity
    ends = {"fast": "particle-size-least", "slow": "particle-size-greatest"}
    of_data = known.number("figure-1-velocity")
    speeds = {
        name: float(stream.particle_velocity(of_data, known.number(d) ** 3, mean**3))
        for name, d in ends.items()
    }
    return {"scatter": scatter, "mean_deviation": scatter * _MEAN, "power": power, **speeds}


_MEAN = math.sqrt(2 / math.pi)
"""Mean deviation of a Gaussian over its standard deviation."""


def _faster_particles(known: Known) -> Computed:
    deviation = known.number("velocity-deviation")
    above = known.number("stream-velocity-450") - known.number("velocity-403")
    gaussian = {"standard": deviation, "mean": deviation / _MEAN}
    return {name: NormalDist(0, sigma).cdf(-above) for name, sigma in gaussian.items()}


EVIDENCE = {
    "observed-digits": _observed_digits,
    "profile-depth": _profile_depth,
    "two-times-too-high": _too_high,
    "compared-velocity": _compared_velocity,
    "equation-1-scatter": _scatter,
    "faster-particles": _faster_particles,
}
