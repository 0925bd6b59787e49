"""Geometry of a sphere that is pressed into a flat surface (Eqs. 2-4 and 12)."""

import math


def volume(radius: float) -> float:
    """Particle volume PV = 4/3 pi R^3 [m^3] (Eq. 3); radius R [m].

    >>> f"{volume(11e-6) * 1e18:.0f}"
    '5575'
    """
    return 4 / 3 * math.pi * radius * radius * radius


def cap_volume(depth: float, radius: float) -> float:
    """Crater volume CV = 1/3 pi X^2 (3R - X) [m^3] (Eq. 2); X and R [m], 0 <= X <= R.

    >>> cap_volume(1.0, 1.0) / volume(1.0)
    0.5
    """
    return 1 / 3 * math.pi * depth * depth * (3 * radius - depth)


def volume_ratio(normalized_depth: float) -> float:
    """CV/PV [1] of a crater of normalized depth y = X/R [1]: y^2 (3 - y) / 4 (Eqs. 2-3).

    >>> f"{volume_ratio(0.298):.4f}"
    '0.0600'
    """
    return normalized_depth * normalized_depth * (3 - normalized_depth) / 4


def normalized_depth_from_volume_ratio(ratio: float) -> float:
    """Normalized depth y = X/R [1] of a crater of volume ratio CV/PV [1] (inverse of Eqs. 2-3).

    The root of y^2 (3 - y) / 4 = ratio in [0, 1]: y = 2t (t + sqrt 3) / (1 + t^2) with t = tan(h)
    and sin(3h)^2 = ratio, a form without cancellation for shallow craters; one Newton step on y/2
    removes most of the rounding error. NaN for a ratio outside 0 to 1/2, the range of caps up to
    half the sphere.

    >>> f"{normalized_depth_from_volume_ratio(0.06):.3f}"
    '0.298'
    """
    if not 0 < ratio <= 0.5:
        return 0.0 if ratio == 0 else math.nan
    t = math.tan(math.asin(math.sqrt(ratio)) / 3)
    z = t * (t + SQRT_3) / (1 + t * t)
    z -= (z * z * (3 - 2 * z) - ratio) / (6 * z * (1 - z))
    return 2 * z


SQRT_3 = math.sqrt(3)


def crater_depth(volume_ratio: float, radius: float = 1.0) -> float:
    """Depth X [m] of a crater of volume ratio CV/PV [1], by a sphere of radius R [m] (Eqs. 2-3).

    Up to X = R the crater is a cap of the sphere; a deeper one continues as a cylinder, as Eq. 13
    takes the contact area to do. For a radius of 1 it is the normalized depth X/R. The relative
    error is below 1e-15.

    >>> crater_depth(0.5), crater_depth(2.0)
    (1.0, 3.0)
    >>> f"{crater_depth(0.06, 11e-6) * 1e6:.1f}"
    '3.3'
    """
    deep = volume_ratio > 0.5
    y = (1 + 4 * volume_ratio) / 3 if deep else normalized_depth_from_volume_ratio(volume_ratio)
    return radius * y


def crater_volume_ratio(depth: float, radius: float = 1.0) -> float:
    """Volume ratio CV/PV [1] of a crater of depth X [m], by a sphere of radius R [m] (Eqs. 2-3).

    The inverse of `crater_depth`: beyond X = R the crater continues as a cylinder. For a radius of
    1, the depth is the normalized depth X/R. The relative error is below 1e-15.

    >>> f"{crater_volume_ratio(3.3e-6, 11e-6):.3f}"
    '0.061'
    >>> crater_volume_ratio(1.0), crater_volume_ratio(3.0)
    (0.5, 2.0)
    """
    y = depth / radius
    return (3 * y - 1) / 4 if y > 1 else volume_ratio(y)


def contact_diameter(normalized_depth: float, diameter: float) -> float:
    """Diameter 2a [m] of the contact circle at normalized depth y [1]: a^2 = Dx - x^2 (Eq. 12).

    diameter D [m].

    >>> f"{contact_diameter(1 / 3, 22e-6) * 1e6:.1f}"
    '16.4'
    """
    return diameter * math.sqrt(normalized_depth * (2 - normalized_depth))
