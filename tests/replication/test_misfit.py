"""What speaks against a fit: data of the model with noise, of which some are displaced."""

import math
import random
from dataclasses import replace

import numpy as np
import pytest

from replication import BETA_5, final_depth
from replication.fit import Measurement, fit
from replication.misfit import chance_of_chi_square, far_off, worst

CASE = (BETA_5.radius, BETA_5.particle_density, BETA_5.target_density)
RESISTANCE = 3.5e9
VELOCITIES = [300.0, 350.0, 400.0, 450.0, 500.0, 550.0, 600.0, 650.0]


def made(scatter: float, displaced: float, weighted: bool) -> list[Measurement]:
    """Return depths of the model with noise, a share of them; of the fourth times `displaced`."""
    generator = random.Random(3)
    depths = [final_depth(v, *CASE, RESISTANCE) for v in VELOCITIES]
    noisy = [x * (1 + scatter * generator.gauss()) for x in depths]
    noisy[3] *= displaced
    sigmas = [scatter * x if weighted else None for x in depths]
    rows = zip(VELOCITIES, noisy, sigmas, strict=True)
    return [Measurement(v, *CASE, x, sigma) for v, x, sigma in rows]


@pytest.mark.parametrize("scatter", [0.0, 1e-6, 0.02])
def test_nothing_speaks_against_data_of_the_model_with_noise(scatter: float) -> None:
    data = made(scatter, 1.0, weighted=False)
    assert far_off(BETA_5, fit(BETA_5, data), data) is None
    weighted = [replace(m, uncertainty=(scatter or 0.02) * m.depth) for m in data]
    chance = chance_of_chi_square(fit(BETA_5, weighted))
    assert chance is not None
    assert chance > 0.001


@pytest.mark.parametrize("displaced", [10.0, 0.1, 1.5])
def test_a_displaced_depth_is_far_off_and_the_others_give_the_resistance(displaced: float) -> None:
    data = made(0.02, displaced, weighted=False)
    outlier = far_off(BETA_5, fit(BETA_5, data), data)
    assert outlier is not None
    assert outlier.number == 3
    assert (outlier.excess > 0) == (displaced > 1)
    assert outlier.without == fit(BETA_5, [m for m in data if m is not data[3]])
    assert outlier.without.standard_error is not None
    assert abs(outlier.without.value - RESISTANCE) < 3 * outlier.without.standard_error


def test_of_three_depths_one_can_be_far_off_but_not_of_two() -> None:
    """Two depths of the model, of any resistance at all, leave a third no room."""
    exact = made(0.0, 1.0, weighted=False)
    three = [exact[0], replace(exact[3], depth=1.2 * exact[3].depth), exact[7]]
    outlier = far_off(BETA_5, fit(BETA_5, three), three)
    assert outlier is not None
    assert outlier.number == 1
    assert far_off(BETA_5, fit(BETA_5, three[:2]), three[:2]) is None


def test_deviations_are_the_externally_studentized_residual() -> None:
    """By the textbook's formula, r / (s_(i) sqrt(1 - h)), where the model is as good as linear."""
    data = made(1e-6, 1 + 1e-4, weighted=False)
    fitted = fit(BETA_5, data)
    outlier = far_off(BETA_5, fitted, data)
    assert outlier is not None
    up, down = (
        np.array([final_depth(v, *CASE, RESISTANCE * factor) for v in VELOCITIES])
        for factor in (1.001, 0.999)
    )
    slopes, residuals = up - down, np.array(fitted.residuals)
    leverage = slopes**2 / np.sum(slopes**2)
    rest = np.sum(residuals**2) - residuals**2 / (1 - leverage)
    studentized = residuals / np.sqrt(rest / (len(data) - 2) * (1 - leverage))
    assert outlier.deviations == pytest.approx(np.max(np.abs(studentized)), rel=1e-3)


def test_a_displaced_depth_makes_chi_square_improbable_and_is_off_by_most() -> None:
    data = made(0.02, 1.5, weighted=True)
    fitted = fit(BETA_5, data)
    chance = chance_of_chi_square(fitted)
    assert chance is not None
    assert chance < 1e-6
    number, off = worst(fitted, data)
    assert number == 3
    assert data[3].uncertainty is not None
    assert off == abs(fitted.residuals[3]) / data[3].uncertainty
    assert far_off(BETA_5, fitted, data) is None  # its uncertainties say how far it may be off


def test_a_single_measurement_has_no_chi_square_to_judge() -> None:
    data = made(0.02, 1.0, weighted=True)[:1]
    assert chance_of_chi_square(fit(BETA_5, data)) is None
    without = [replace(m, uncertainty=None) for m in made(0.02, 1.5, weighted=True)[2:4]]
    assert far_off(BETA_5, fit(BETA_5, without), without) is None


def test_of_two_degrees_of_freedom_the_chance_is_an_exponential() -> None:
    fitted = fit(BETA_5, made(0.02, 1.0, weighted=True)[:3])
    assert fitted.chi_square is not None
    chance = math.exp(-fitted.chi_square / 2)
    assert chance_of_chi_square(fitted) == pytest.approx(chance, rel=1e-12)
