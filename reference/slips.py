"""Equations of the report with every occurrence of a symbol apart, so that one can be mistaken.

What the author may have computed in place of what he printed is one of these functions with other
values in some places (`report/conjectures.toml` lists them). With none, it is the equation itself.
"""

from collections.abc import Callable

from reference.exact import Arithmetic, Number

__all__ = ["RATIOS", "SLIPS", "equation_16", "equation_16_ratio"]


def equation_16(
    ar: Arithmetic,
    length_ratio: Number,
    particle_density: Number,
    target_density: Number,
    k_1: Number,
    k_t: Number,
    resistance: Number,
    velocity: Number,
    multiple: Number,
    *,
    over: Number | None = None,
    under: Number | None = None,
    k_1_over: Number = 1,
    k_1_under: Number = 1,
    bar_k_t: Number | None = None,
    one: Number = 1,
    log_factor: Number = 1,
    log_k_t: Number | None = None,
    log_density: Number | None = None,
    velocity_again: Number | None = None,
    base: Number | None = None,
) -> Number:
    """X/R [1] by Eq. 16: multiple (L/D over/under + k_1) / k_t log(one + k_t rho_t V V / R_t).

    As printed the multiple is 1/2; for X/R by Eqs. 14 and 15 it is 1. Densities in kg/m^3, R_t in
    Pa, velocities in m/s; a place that is None has the value of its symbol, `base` None is e.

    >>> from fractions import Fraction as F
    >>> from reference.exact import Reals
    >>> ar = Reals(20)
    >>> inputs = (F(2, 3), 8900, 7850, F("0.557"), F("1.046"), 913 * 10**7, 500, F(1, 2))
    >>> print(equation_16(ar, *map(ar.number, map(F, inputs))))
    0.12727315048681142558
    """

    def place(occurrence: Number | None, symbol: Number) -> Number:
        return symbol if occurrence is None else occurrence

    rod = length_ratio * place(over, particle_density) / place(under, target_density)
    inertia = rod + k_1 * k_1_over / k_1_under
    drag = log_factor * place(log_k_t, k_t) * place(log_density, target_density)
    square = velocity * place(velocity_again, velocity)
    logarithm = ar.context.log(one + drag * square / resistance)
    if base is not None:
        logarithm = logarithm / ar.context.log(base)
    return multiple * inertia / place(bar_k_t, k_t) * logarithm


def equation_16_ratio(ar: Arithmetic, common: Number, one: Number, other: Number) -> Number:
    """X/R at the `other` resistance over X/R at the `one`, by Eq. 16; `common` is k_t rho_t V^2.

    All in Pa. Everything but the logarithm cancels, the left side and any constant factor too.
    """
    return ar.context.log(1 + common / other) / ar.context.log(1 + common / one)


SLIPS: dict[str, Callable[..., Number]] = {"equation_16": equation_16}
"""The functions by the names that `report/conjectures.toml` uses."""

RATIOS: dict[str, Callable[..., Number]] = {"equation_16_ratio": equation_16_ratio}
"""Quotients of two claims of one equation, by name."""
