"""Geometry of a sphere that is pressed into a flat surface (Eqs. 2-4 and 12)."""

from typing import Any

import numpy as np

__all__ = ["cap_volume", "contact_diameter", "depth_from_volume_ratio", "volume", "volume_ratio"]


def volume(radius: Any) -> Any:
    """Particle volume PV = 4/3 pi R^3 [m^3] (Eq. 3); radius R [m], any shape.

    >>> f"{volume(11e-6) * 1e18:.0f}"
    '5575'
    """
    return 4 / 3 * np.pi * radius * radius * radius


def cap_volume(depth: Any, radius: Any) -> Any:
    """Crater volume CV = 1/3 pi X^2 (3R - X) [m^3] (Eq. 2); X, R [m] broadcast, 0 <= X <= R.

    >>> float(cap_volume(1.0, 1.0) / volume(1.0))
    0.5
    """
    return 1 / 3 * np.pi * depth * depth * (3 * radius - depth)


def volume_ratio(normalized_depth: Any) -> Any:
    """CV/PV [1] of a crater of normalized depth y = X/R [1]: y^2 (3 - y) / 4 (Eqs. 2-3).

    >>> f"{volume_ratio(0.298):.4f}"
    '0.0600'
    """
    return normalized_depth * normalized_depth * (3 - normalized_depth) / 4


def depth_from_volume_ratio(ratio: Any) -> Any:
    """Normalized depth y = X/R [1] of a crater of volume ratio CV/PV [1] (inverse of Eqs. 2-3).

    The root of y^2 (3 - y) / 4 = ratio in [0, 1], in the form that does not cancel for shallow
    craters; ratio of any shape, 0 to 1/2 (elsewhere the crater is no cap of the sphere: NaN).

    >>> f"{depth_from_volume_ratio(0.06):.3f}"
    '0.298'
    """
    ratio = np.where((ratio >= 0) & (ratio <= 0.5), ratio, np.nan)
    angle = np.arcsin(np.sqrt(ratio)) / 3
    return (4 * np.sin(angle) * np.sin(angle + np.pi / 3))[()]


def contact_diameter(normalized_depth: Any, diameter: Any) -> Any:
    """Diameter 2a [m] of the contact circle at normalized depth y [1]: a^2 = Dx - x^2 (Eq. 12).

    diameter D [m]; both broadcast.

    >>> f"{contact_diameter(1 / 3, 22e-6) * 1e6:.1f}"
    '16.4'
    """
    return diameter * np.sqrt(normalized_depth * (2 - normalized_depth))
