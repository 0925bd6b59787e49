"""What rounding leaves of differences between nearly equal products; of numbers and of arrays."""

from typing import Any

import numpy as np

__all__ = ["left_of_pressure", "left_of_product"]


def left_of_pressure(V: Any, rho_t: Any, twice_R_t: Any, p: Any) -> Any:
    """rho_t V^2 - 2 R_t p, of nearly equal products: the leading bits multiply exactly."""
    V_high, rho_high = _high(V, 36), _high(rho_t, 36)
    R_high, p_high = _high(twice_R_t), _high(p)
    square = V_high * V_high
    rest = V + V_high
    rest *= V - V_high
    rest *= rho_t
    rest += square * (rho_t - rho_high)
    rest -= twice_R_t * (p - p_high)
    rest -= (twice_R_t - R_high) * p_high
    square *= rho_high
    square -= R_high * p_high
    rest += square
    return rest


def left_of_product(a: Any, b: Any, c: Any, d: Any) -> Any:
    """a b - c d, of nearly equal products, in the same way."""
    a_high, b_high, c_high, d_high = _high(a), _high(b), _high(c), _high(d)
    rest = a * (b - b_high)
    rest += (a - a_high) * b_high
    rest -= c * (d - d_high)
    rest -= (c - c_high) * d_high
    a_high *= b_high
    a_high -= c_high * d_high
    rest += a_high
    return rest


def _high(a: Any, dropped: int = 27) -> Any:
    """Doubles without their last bits, 27 or 36 of the 53."""
    if isinstance(a, float):  # for one number, Veltkamp's product takes a tenth of the view's time
        product = (2.0**dropped + 1) * a
        return product - (product - a)
    return (a.view(np.int64) & np.int64(-1 << dropped)).view(np.float64)
