"""The scheme's order, its coarse step, its size, and what its columns hold."""

from dataclasses import replace
from fractions import Fraction

from replication.analysis.budget import exact_motion, split
from replication.analysis.convergence import converge
from replication.audit.findings.known import Computed, Known
from replication.cases import BETA_3, BETA_5
from replication.models.depth import final_depth
from replication.models.impact import Impact
from replication.models.sheet import SCHEMES, deceleration, run

__all__ = ["EVIDENCE"]


def _order(_: Known) -> Computed:
    steps = [BETA_5.step, BETA_5.step / 2]
    orders = {name: converge(BETA_5, steps, name).levels[-1].time_step_order for name in SCHEMES}
    found: dict[str, Fraction | float | bool] = {}
    for name, order in orders.items():
        assert order is not None
        found[name] = order
    for impact in (BETA_3, BETA_5):
        exact = float(final_depth(**impact.motion))
        short = exact - run(impact).final_depth
        beta = f"{impact.beta:.0f}"
        found |= {f"short_{beta}": short, f"exact_{beta}": exact, f"share_{beta}": short / exact}
    return {**found, **_last_row()}


def _last_row() -> Computed:
    sheet = run(BETA_5)
    budget, last = split(sheet), sheet.rows[-1]
    assert last.velocity_final is not None
    assert budget.stop_rule is not None
    assert budget.half_step is not None
    return {
        "row": last.velocity_initial - last.velocity_final,
        "last": last.velocity_final,
        "stop": abs(budget.stop_rule) + abs(budget.half_step),
    }


def _coarse_step(known: Known) -> Computed:
    fine = {beta: known.computed(f"depth-beta-{beta}") for beta in (3, 5)}
    coarse = {beta: known.computed(f"coarse-step-beta-{beta}") for beta in (3, 5)}
    exact = float(final_depth(**BETA_5.motion))
    y = exact / BETA_5.radius
    return {
        "change_3": coarse[3] / fine[3] - 1,
        "change_5": coarse[5] / fine[5] - 1,
        "nm_3": coarse[3] - fine[3],
        "nm_5": coarse[5] - fine[5],
        "coarse_3": coarse[3],
        "fine_5": fine[5],
        "coarse_5": coarse[5],
        "exact_coarse": coarse[5],
        "work": y * y - y**3 / 3,
        "exact": exact,
        "short": exact - fine[5],
        "rounded": _prints_all(known, replace(_ROUNDED, step=known.number("coarse-step"))),
    }


_ROUNDED = Impact(
    velocity=500.0,
    radius=1.0999919193297953e-05,
    particle_density=8904.04871729352,
    target_density=7891.4043313774155,
    resistance=3495674096.9369545,
)
"""Found by a search; what matters is what it prints, which `_prints_all` looks at."""


def _prints_all(known: Known, coarse: Impact) -> bool:
    """Whether rounded inputs print Table A-1 and, at its step and a coarser one, the same depth."""
    impact = replace(coarse, step=BETA_5.step)
    sheet = run(impact)
    shown: dict[str, float | None] = {
        "a1-radius": impact.radius,
        "a1-density": impact.particle_density,
        "a1-mass": impact.mass,
        "a1-diameter": impact.diameter,
        "a1-resistance": impact.target_resistance,
        "depth-beta-5": sheet.final_depth,
        "coarse-step-beta-5": run(coarse).final_depth,
    }
    for number, row in enumerate(sheet.rows[:5]):
        cells = {name.replace("_", "-"): cell for name, cell in row._asdict().items()}
        shown |= {f"a1-{name}-{number}": cell for name, cell in cells.items()}
    return all(known.prints(name, cell) for name, cell in shown.items() if cell is not None)


def _size_independence(known: Known) -> Computed:
    radii = {
        "small": "particle-size-least",
        "mean": "mean-diameter",
        "large": "particle-size-greatest",
    }
    found: dict[str, Fraction | float | bool] = {
        name: _sheet_ratio(replace(BETA_5, radius=known.number(diameter) / 2))
        for name, diameter in radii.items()
    }
    double = replace(BETA_5, radius=2 * BETA_5.radius, step=2 * BETA_5.step)
    found["scaled"] = _sheet_ratio(double) == _sheet_ratio(BETA_5)
    for name in ("small", "large"):
        radius = known.number(radii[name]) / 2
        found[f"{name}_3"] = _sheet_ratio(replace(BETA_3, radius=radius))
    found["tiny"] = _sheet_ratio(replace(BETA_5, radius=2e-6))
    return found


def _sheet_ratio(impact: Impact) -> float:
    return run(impact).normalized_depth


def _acceleration_sign(known: Known) -> Computed:
    x, v, dt = 0.0, BETA_5.velocity, BETA_5.step
    case = BETA_5.radius, BETA_5.mass, BETA_5.target_density, BETA_5.target_resistance
    for row in range(3):
        x += v * (dt if row else dt / 2)
        v += deceleration(x, v, *case) * dt
    printed = sum(known.exact(f"a1-deceleration-{row}") for row in (1, 2, 3))
    return {
        "printed": known.computed("a1-deceleration-1"),
        "plus": v,
        "minus": known.computed("a1-velocity-final-3"),
        "lost": printed * known.exact("a-step"),
    }


def _meaning_of_x(known: Known) -> Computed:
    half_step = split(run(BETA_5)).half_step
    assert half_step is not None
    motion = exact_motion(BETA_5, digits=20)  # a time takes quadrature, in as many digits
    return {
        "exact": float(motion.depth_at_time(motion.reals.number(known.exact("a1-time-1")))),
        "lag": known.exact("a1-initial-velocity") * known.exact("a-half-step"),
        "half_step": abs(half_step),
    }


EVIDENCE = {
    "scheme-order": _order,
    "coarse-step": _coarse_step,
    "size-independence": _size_independence,
    "acceleration-sign": _acceleration_sign,
    "meaning-of-x": _meaning_of_x,
}
