"""Fits against SciPy's curve_fit and against known data, and the files of measurements."""

import math
import random
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import curve_fit

from replication import BETA_5, Impact, final_depth
from replication.fit import Measurement, fit, read_measurements

EXAMPLE = Path(__file__).parents[2] / "docs" / "fit.csv"
CASE = (BETA_5.radius, BETA_5.particle_density, BETA_5.target_density)
RIGID = replace(BETA_5, beta=None, flow_stress=None, resistance=3.5e9)
VELOCITIES = [300.0, 350.0, 400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0]


def measured(resistance: float, scatter: float, weighted: bool) -> list[Measurement]:
    """Return depths of the model with noise, as a share of the depth."""
    generator = random.Random(7)
    measurements = []
    for velocity in VELOCITIES:
        depth = final_depth(velocity, *CASE, resistance)
        noise = 1 + scatter * generator.gauss()
        sigma = scatter * depth if weighted else None
        measurements.append(Measurement(velocity, *CASE, depth * noise, sigma))
    return measurements


@pytest.mark.parametrize("weighted", [False, True])
@pytest.mark.parametrize("scatter", [0.02, 0.2])
@pytest.mark.parametrize("resistance", [1e6, 3.5e9, 1e12])
def test_a_fit_is_that_of_curve_fit(resistance: float, scatter: float, weighted: bool) -> None:
    """`curve_fit` has its own start, slopes by differences, and the logarithm in micrometres."""
    data = measured(resistance, scatter, weighted)

    def micrometres(velocity: "np.ndarray", log_resistance: float) -> "np.ndarray":
        return np.asarray(final_depth(velocity, *CASE, math.exp(log_resistance)) * 1e6)

    depths = [m.depth * 1e6 for m in data]
    sigma = [m.uncertainty * 1e6 for m in data if m.uncertainty is not None] or None
    start = math.log(resistance * 1.1)
    best, covariance = curve_fit(
        micrometres, VELOCITIES, depths, [start], sigma, absolute_sigma=weighted
    )
    fitted = fit(BETA_5, data)
    # Where the sum is least it is flat: it tells half of the digits, and its slope by differences
    # as many. A thousandth of the standard error is more than that.
    expected = math.exp(best[0])
    error = expected * math.sqrt(covariance[0, 0])
    assert fitted.value == pytest.approx(expected, abs=1e-3 * error)
    assert fitted.standard_error == pytest.approx(error, rel=1e-3)
    assert fitted.points == len(VELOCITIES)
    for m, residual in zip(data, fitted.residuals, strict=True):
        assert residual == m.depth - final_depth(m.velocity, *CASE, fitted.resistance)
    assert (fitted.chi_square is not None) == weighted


@pytest.mark.parametrize("resistance", [1.0, 1e6, 3.5e9, 1e15])
@pytest.mark.parametrize("weighted", [False, True])
def test_depths_of_the_model_give_its_resistance_again(resistance: float, weighted: bool) -> None:
    data = measured(resistance, 0.0, False)
    if weighted:
        data = [replace(m, uncertainty=1e-8 * (k + 1)) for k, m in enumerate(data)]
    assert fit(BETA_5, data).value == pytest.approx(resistance, rel=1e-13)


def test_beta_and_the_flow_stress_are_the_resistance_over_the_other_one() -> None:
    data = measured(3.5e9, 0.02, True)
    resistance, beta, stress = (fit(BETA_5, data, q) for q in ("resistance", "beta", "flow_stress"))
    assert beta.value == resistance.value / 700e6
    assert stress.value == resistance.value / 5
    for part in (beta, stress):
        assert part.resistance == resistance.value
        assert part.residuals == resistance.residuals
        assert part.standard_error is not None
        assert resistance.standard_error is not None
        relative = resistance.standard_error / resistance.value
        assert part.standard_error / part.value == pytest.approx(relative, rel=1e-15)


def test_one_point_is_met_and_only_an_uncertainty_gives_an_error() -> None:
    """By the condition: d ln R_t = -1.915 d ln X for X = 7.674933 um in the case of beta = 5."""
    depth = final_depth(**BETA_5.motion)
    alone = fit(BETA_5, [Measurement(500.0, *CASE, depth)])
    assert alone.standard_error is None
    known = fit(BETA_5, [Measurement(500.0, *CASE, depth, 0.01 * depth)])
    assert known.standard_error is not None
    assert known.standard_error / known.value == pytest.approx(0.01915, abs=5e-6)
    assert alone.value == pytest.approx(3.5e9, rel=1e-13)


def test_data_that_no_resistance_fits_have_a_best_one_all_the_same() -> None:
    """Depths a million times apart: minima at either end are compared."""
    data = [Measurement(500.0, *CASE, depth) for depth in (1e-9, 1e-3, 1e-3)]
    fitted = fit(BETA_5, data)
    deep = fit(BETA_5, data[1:])
    mean = sum(m.depth for m in data) / 3
    assert final_depth(500.0, *CASE, fitted.value) == pytest.approx(mean, rel=1e-9)
    assert fitted.value > deep.value


@pytest.mark.parametrize(
    ("impact", "data", "quantity", "message"),
    [
        (BETA_5, [], "resistance", "there is no measurement to fit"),
        (BETA_5, [Measurement(500.0, *CASE, 1e-6)], "velocity",
         "cannot fit 'velocity': choose one of resistance, beta, flow_stress"),
        (RIGID, [Measurement(500.0, *CASE, 1e-6)], "beta",
         "the beta is the resistance over the flow stress: give the flow stress"),
        (BETA_5, [Measurement(500.0, *CASE, 1e-6, 1e-8), Measurement(500.0, *CASE, 1e-6)],
         "resistance", "some measurements have an uncertainty and others not: give all or none"),
        (BETA_5, [Measurement(500.0, *CASE, 1.0, line=7)], "resistance",
         "line 7: the depth is 9.09e+04 times the radius: does the depth's head lack a unit, such "
         "as 'depth [um]'?"),
    ],
)  # fmt: skip
def test_what_cannot_be_fitted(
    impact: Impact, data: list[Measurement], quantity: str, message: str
) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        fit(impact, data, quantity)


# Files


def example() -> str:
    """Return the example's text: depths of the model with noise, rounded as a microscope's."""
    generator = random.Random(2006)
    lines = [
        "# Made by the model, not measured: R_t = 3.5 GPa, normal noise of the given uncertainty,",
        "# copper spheres of radius 11 um (8900 kg/m^3) on steel (7850 kg/m^3).",
        "velocity [m/s],depth [um],uncertainty [um]",
    ]
    for velocity in range(300, 701, 40):
        depth = final_depth(float(velocity), *CASE, 3.5e9) * 1e6
        sigma = round(0.03 * depth, 2)
        lines.append(f"{velocity},{depth + sigma * generator.gauss():.2f},{sigma:.2f}")
    return "\n".join(lines) + "\n"


def test_the_example_is_made_by_the_model_and_gives_its_resistance_within_its_error() -> None:
    assert EXAMPLE.read_text("utf-8") == example()
    fitted = fit(BETA_5, read_measurements(EXAMPLE, BETA_5))
    assert fitted.standard_error is not None
    assert fitted.chi_square is not None
    # Two standard errors, and the 1 and 99 % of chi square with ten degrees of freedom.
    assert abs(fitted.value - 3.5e9) < 2 * fitted.standard_error
    assert 2.6 < fitted.chi_square < 23.2


def test_inputs_are_the_files_or_else_the_cases(tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text("R (um);v_m/s;Target density;x\n10;500;8000;7 um\n12;400;7000;6 um\n", "utf-8")
    first, second = read_measurements(file, BETA_5)
    assert first == Measurement(500.0, 10e-6, 8900.0, 8000.0, 7e-6, line=2)
    assert second == Measurement(400.0, 12e-6, 8900.0, 7000.0, 6e-6, line=3)


@pytest.mark.parametrize(
    "head", ["std", "sd", "error", "+/-", "±", "depth error", "u(depth)", "Depth_SD", "sigma"]
)
def test_usual_names_of_uncertainties_are_known(head: str, tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text(f"v,x [um],{head} [um]\n500,7.6,0.5\n", "utf-8")
    assert read_measurements(file, BETA_5)[0].uncertainty == 0.5e-6


@pytest.mark.parametrize(
    "heads",
    [
        "Geschwindigkeit [m/s];Tiefe [µm];Fehler [µm];Partikeldurchmesser [µm]",
        "Aufprallgeschwindigkeit in m/s;Eindringtiefe in µm;Unsicherheit in µm;Durchmesser in µm",
        "vitesse [m/s];profondeur [µm];écart-type [µm];diamètre [µm]",
        "v0 [m/s];penetration [µm];std dev [µm];D [µm]",
    ],
)
def test_heads_may_be_german_or_french(heads: str, tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_bytes(f"{heads}\r\n500;7,6;0,5;22\r\n".encode("cp1252"))
    expected = Measurement(500.0, *CASE, 7.6e-6, 0.5e-6, line=2)
    assert read_measurements(file, BETA_5) == [expected]


def test_the_unit_of_an_uncertainty_may_stand_in_its_cells(tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text("v,x [um],sd\n500,7.6,0.5 um\n", "utf-8")
    assert read_measurements(file, BETA_5)[0].uncertainty == 0.5e-6


@pytest.mark.parametrize(
    ("content", "uncertainty"),
    [
        ("v,x [um],sd [%]\n500,8,25\n", 2e-6),
        ("v,x [um],sd\n500,8,25 %\n", 2e-6),
        ("v,x/R,sd [percent],R [um]\n500,0.5,25,16\n", 2e-6),
        ("v,x/R [%],sd [%],R [um]\n500,50,25,16\n", 4e-6),  # a quarter of the radius
    ],
)
def test_a_percentage_is_a_share_of_the_depth(
    content: str, uncertainty: float, tmp_path: Path
) -> None:
    file = tmp_path / "mine.csv"
    file.write_text(content, "utf-8")
    (measurement,) = read_measurements(file, BETA_5)
    assert (measurement.depth, measurement.uncertainty) == (8e-6, uncertainty)


@pytest.mark.parametrize("head", ["diameter [um]", "D (um)", "Particle dia. [um]", "D_um"])
def test_of_a_diameter_the_radius_is_half(head: str, tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text(f"v,x/R,std,{head}\n500,0.5,0.25,8\n", "utf-8")
    (measurement,) = read_measurements(file, BETA_5)
    assert (measurement.radius, measurement.depth) == (4e-6, 2e-6)
    assert measurement.uncertainty == 1e-6


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("v,y\n1,2\n", "FILE has no column 'depth': it needs one such as 'depth [um]' (it has 'v', "
         "'y')"),
        ("v,x\n500,1e-6\n0,1e-6\n400,-1\n500,0\n",
         "FILE, line 3: velocity is 0: it must be a number greater than zero (line 4, line 5, "
         "too)"),
        ("v,x [um]\n500,-2.1\n",
         "FILE, line 2: depth is -2.1 um: it must be a number greater than zero"),
        ("v,x,sigma\n500,1e-6,0\n",
         "FILE, line 2: uncertainty is 0: it must be a number greater than zero"),
        ("v,x [um],sigma\n500,7.6,0.2\n", "FILE, column 'sigma': has no unit, beside 'x [um]': "
         "write 'sigma [um]' if it is in um, or 'sigma [%]'"),
        ("v,x [um]\n500,7.6 ± 0.2\n", "FILE, line 2, column 'x [um]': '7.6 ± 0.2' is a number "
         "and its uncertainty: put that into a column of its own, 'uncertainty [um]'"),
        ("v,x,D,R\n500,1e-6,2,1\n",
         "FILE has both a radius and a diameter: leave one of them out"),
        ("speed,deep\n1,2\n", "FILE has no column 'velocity' and no column 'depth': it needs one "
         "such as 'velocity [m/s]'; rename 'deep' to 'depth' (it has 'speed', 'deep')"),
        ("velocty [m/s],dpeth [um]\n1,2\n", "FILE has no column 'velocity' and no column 'depth': "
         "rename 'velocty [m/s]' to 'velocity [m/s]'; rename 'dpeth [um]' to 'depth [um]' (it has "
         "'velocty [m/s]', 'dpeth [um]')"),
        ("v,x [um]\n500,7.6\n400,?\n", "FILE, line 3, column 'x [um]': '?' is not a finite "
         "number with or without a unit, such as '1 um'"),
    ],
)  # fmt: skip
def test_bad_rows_are_named_by_their_line(content: str, message: str, tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text(content, "utf-8")
    with pytest.raises(ValueError, match=f"^{re.escape(message.replace('FILE', str(file)))}$"):
        read_measurements(file, BETA_5)
