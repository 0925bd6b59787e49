"""Fit the resistance, or a factor of it, to depths that were measured at several velocities.

The model is the closed form of Eqs. 12-13. What is least is the sum of the squares of the depths'
residuals, each over its uncertainty if the data have that.
"""

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

from replication.cases import INPUTS, OTHER_FACTOR, other_factor
from replication.columns import Column, bad_rows, column_of, not_among, read_columns
from replication.models.depth import elasticities, final_depth
from replication.models.impact import Impact, InputError
from replication.user_input import advice, printable, quoted, typed_unit

FITTABLE = ("resistance", *OTHER_FACTOR)
"""What can be fitted."""

HEADS = {
    "velocity": (
        "velocity", "impact velocity", "v", "v0", "v 0", "v i",
        "geschwindigkeit", "aufprallgeschwindigkeit", "auftreffgeschwindigkeit",
        "vitesse", "vitesse d'impact", "vitesse d’impact",
    ),
    "depth": (
        "depth", "penetration depth", "final depth", "x", "penetration",
        "tiefe", "eindringtiefe", "profondeur", "profondeur de pénétration", "pénétration",
    ),
    "normalized_depth": ("normalized depth", "depth over radius", "x/r"),
    "uncertainty": (
        "uncertainty", "depth uncertainty", "uncertainty of depth", "u(depth)", "u(x)", "sigma",
        "standard deviation", "std", "sd", "stdev", "std dev", "std. dev.", "depth std", "depth sd",
        "error", "depth error", "error of depth", "standard error", "err", "±", "+/-", "+-",
        "unsicherheit", "messunsicherheit", "fehler", "messfehler", "standardabweichung",
        "incertitude", "erreur", "écart-type",
    ),
    "radius": (
        "radius", "particle radius", "r",
        "partikelradius", "teilchenradius", "rayon", "rayon des particules",
    ),
    "diameter": (
        "diameter", "particle diameter", "d", "dia", "dia.", "particle dia", "particle dia.",
        "durchmesser", "partikeldurchmesser", "teilchendurchmesser",
        "diamètre", "diamètre des particules",
    ),
    "particle_density": ("particle density", "partikeldichte", "teilchendichte"),
    "target_density": ("target density", "zieldichte", "dichte des ziels"),
}  # fmt: skip
"""The names by which columns are known, also in German and French; the first is the usual one.

They are what is measured, and inputs that may differ by row.
"""

_UNITS = INPUTS | {"depth": "m", "normalized_depth": "1", "diameter": "m"}


@dataclass(frozen=True, slots=True)
class Measurement:
    """A measured depth X [m] at the inputs of its impact (SI, all but the resistance).

    `uncertainty` is its standard deviation [m], if known; `line` is that of the file.
    """

    velocity: float
    radius: float
    particle_density: float
    target_density: float
    depth: float
    uncertainty: float | None = None
    line: int = 0

    @property
    def impact(self) -> tuple[float, float, float, float]:
        """The inputs of `final_depth` before the resistance."""
        return self.velocity, self.radius, self.particle_density, self.target_density


@dataclass(frozen=True, slots=True)
class Fit:
    """The fitted quantity in SI units, its standard error, and the residuals of the depths [m].

    With uncertainties, these give the standard error; without, the scatter of the residuals does,
    and a single point gives None. A residual is the measured depth minus the fitted one.
    `chi_square` is the sum of the squares of the residuals over their uncertainties, for `points` -
    1 degrees of freedom, and None without uncertainties. `resistance` is R_t [Pa], whatever factor
    of it is the quantity.
    """

    quantity: str
    value: float
    standard_error: float | None
    resistance: float
    residuals: tuple[float, ...]
    chi_square: float | None

    @property
    def points(self) -> int:
        """Number of measurements."""
        return len(self.residuals)


def read_measurements(path: Path, impact: Impact) -> list[Measurement]:
    """Read measurements from a file of columns (`replication.columns`), by the names in `HEADS`.

    It must have columns of the velocity, and of the depth or the normalized depth X/R; an
    uncertainty is that of the column it has, in per cent a share of the depth. Of a diameter the
    radius is half. Inputs that it does not have are the case's, and further columns are ignored:
    `measurement_columns` says which. Raises OSError, or ValueError that names the file and the
    line.
    """
    return measurements_in(measurement_columns(read_columns(path)), impact)


def measurement_columns(columns: Sequence[Column]) -> dict[str, Column]:
    """Return those columns of a file that have measurements, by the key of their names in `HEADS`.

    Raises ValueError that names the file if some are missing, or say the same twice.
    """
    by_name = {name: column_of(columns, names) for name, names in HEADS.items()}
    known = {name: column for name, column in by_name.items() if column}
    file = columns[0].file
    for first, second in (("depth", "normalized_depth"), ("radius", "diameter")):
        if first in known and second in known:
            words = second.replace("_", " ")
            raise ValueError(f"{file} has both a {first} and a {words}: leave one of them out")
    missing = [] if "velocity" in known else ["velocity"]
    if "depth" not in known and "normalized_depth" not in known:
        missing.append("depth")
    if missing:
        rest = {column.name: column for column in not_among(columns, known.values())}
        named = "; ".join(_to_be_named(name, rest) for name in missing)
        has = ", ".join([quoted(column.head) for column in columns][:6])
        no_columns = " and no column ".join(repr(name) for name in missing)
        raise ValueError(f"{file} has no column {no_columns}: {named} (it has {has})")
    return known


def _to_be_named(name: str, rest: Mapping[str, Column]) -> str:
    """Return which column is to be renamed to this, with its unit, if one has a similar name."""
    usual = {"velocity": "m/s", "depth": "um"}[name]
    if not (similar := get_close_matches(name, rest, n=1)):
        return f"it needs one such as '{name} [{usual}]'"
    column = rest[similar[0]]
    unit = f" [{column.unit}]" if column.unit else ""
    return f"rename {quoted(column.head)} to '{name}{unit}'"


def measurements_in(known: Mapping[str, Column], impact: Impact) -> list[Measurement]:
    """Return the measurements that `measurement_columns` have, as `read_measurements` does."""
    measured = "depth" if "depth" in known else "normalized_depth"
    numbers = {
        name: column.numbers(_UNITS[name]) for name, column in known.items() if name in _UNITS
    }
    if "uncertainty" in known:
        numbers["uncertainty"] = uncertainties_in(
            known["uncertainty"], known[measured], numbers[measured], _UNITS[measured]
        )
    case = {name: impact.motion[name] for name in HEADS if name in impact.motion}
    measurements, errors = [], []
    for k, line in enumerate(known["velocity"].lines):
        try:
            for name, column in known.items():
                _check_positive(numbers[name][k], name, column, k)
        except ValueError as error:
            errors.append((line, error))
            continue
        row = case | {name: values[k] for name, values in numbers.items()}
        if "diameter" in row:
            row["radius"] = row.pop("diameter") / 2
        if "normalized_depth" in row:
            row["depth"] = row.pop("normalized_depth") * row["radius"]
            if "uncertainty" in row:
                row["uncertainty"] *= row["radius"]
        measurements.append(Measurement(**row, line=line))
    if errors:
        raise bad_rows(errors)
    return measurements


def uncertainties_in(
    uncertainty: Column, depth: Column, depths: Sequence[float], unit: str
) -> list[float]:
    """Return the uncertainties of depths in their SI unit, "m", or "1" for normalized depths.

    A percentage is that share of the depth in its line (`is_share`). Raises ValueError that names
    the file.
    """
    if is_share(uncertainty, depth):
        shares = uncertainty.numbers("1")
        return [share * value for share, value in zip(shares, depths, strict=True)]
    _check_uncertainty(uncertainty, depth)
    return uncertainty.numbers(unit)


_PERCENT = ("%", "percent")


def is_share(uncertainty: Column, depth: Column) -> bool:
    """Return whether uncertainties are percentages, and the depths are none.

    Beside normalized depths in per cent an uncertainty in per cent is as they are, of the radius.
    """
    units = {uncertainty.unit or unit for unit in map(typed_unit, uncertainty.plain_texts)}
    return units <= {*_PERCENT} and depth.unit not in _PERCENT


def note_of_share(uncertainty: Column | None, depth: Column | None) -> list[str]:
    """Return a note if uncertainties are taken as shares of the depths; none otherwise."""
    if uncertainty is None or depth is None or not is_share(uncertainty, depth):
        return []
    head = quoted(uncertainty.head)
    return [f"{uncertainty.file}: {head} is taken as a share of the depth in its line"]


def _check_uncertainty(uncertainty: Column, depth: Column) -> None:
    """Raise ValueError if uncertainties are plain numbers beside depths with a unit.

    They would be metres, and are meant in the unit of the depths.
    """
    unit = "" if depth.unit == "1" else depth.unit
    if unit and not uncertainty.unit and not all(map(typed_unit, uncertainty.plain_texts)):
        head = quoted(uncertainty.head)
        raise ValueError(
            f"{uncertainty.file}, column {head}: has no unit, beside {quoted(depth.head)}: write "
            f"'{uncertainty.head} [{unit}]' if it is in {unit}, or '{uncertainty.head} [%]'"
        )


def _check_positive(value: float, name: str, column: Column, row: int) -> None:
    """Raise ValueError if a number of a column is not above zero; it is shown as it was typed."""
    if not 0 < value < math.inf:
        where = f"{column.file}, line {column.lines[row]}: {name.replace('_', ' ')}"
        typed = f"{column.texts[row]} {'' if column.unit == '1' else column.unit}".strip()
        raise ValueError(f"{where} is {printable(typed)}: it must be a number greater than zero")


def fit(impact: Impact, measurements: Sequence[Measurement], quantity: str = "resistance") -> Fit:
    """Return the least-squares fit of the resistance, "beta" or the "flow_stress" to measurements.

    Of the case only the other factor is used (R_t = beta Y_t, Eq. 7): the flow stress for beta, and
    beta for the flow stress. Raises ValueError if the case does not have it, if there is no
    measurement, or if some, but not all, have an uncertainty.

    >>> from replication.cases import BETA_5
    >>> depths = {400.0: 6.1e-6, 450.0: 6.9e-6, 500.0: 7.6e-6}
    >>> case = BETA_5.radius, BETA_5.particle_density, BETA_5.target_density
    >>> fitted = fit(BETA_5, [Measurement(v, *case, x) for v, x in depths.items()], "beta")
    >>> f"{fitted.value:.2f} +- {fitted.standard_error:.2f}"
    '5.02 +- 0.04'
    """
    factor = check_factor(impact, quantity)
    if not measurements:
        raise ValueError("there is no measurement to fit")
    uncertainties = [m.uncertainty for m in measurements if m.uncertainty is not None]
    if uncertainties and len(uncertainties) < len(measurements):
        raise ValueError("some measurements have an uncertainty and others not: give all or none")
    # Without uncertainties all weigh the same: any length does that makes a residual about 1.
    scale = math.fsum(m.depth for m in measurements) / len(measurements)
    resistance = _least_squares(measurements, uncertainties or [scale] * len(measurements))
    residuals = tuple(m.depth - final_depth(*m.impact, resistance) for m in measurements)
    slopes = [depth_slope(m, resistance) for m in measurements]
    chi_square = error = None
    if uncertainties:
        pairs = list(zip(residuals, slopes, uncertainties, strict=True))
        chi_square = math.fsum((residual / sigma) ** 2 for residual, _, sigma in pairs)
        error = 1 / math.sqrt(math.fsum((slope / sigma) ** 2 for _, slope, sigma in pairs))
    elif len(measurements) > 1:
        freedom = len(measurements) - 1
        error = math.hypot(*residuals) / math.sqrt(freedom) / math.hypot(*slopes)
    value = resistance / factor
    standard_error = None if error is None else error * value
    return Fit(quantity, value, standard_error, resistance, residuals, chi_square)


def check_factor(impact: Impact, quantity: str) -> float:
    """Return by what the resistance is divided to give the quantity; ValueError if it is unknown.

    >>> from replication.cases import BETA_5
    >>> check_factor(BETA_5, "beta")
    700000000.0
    """
    if quantity not in FITTABLE:
        raise ValueError(f"cannot fit {quoted(quantity)}: {advice(quantity, FITTABLE)}")
    return other_factor(impact, quantity) if quantity in OTHER_FACTOR else 1.0


def depth_slope(measurement: Measurement, resistance: float) -> float:
    """Return dX / d ln R_t [m], which is negative."""
    velocity, _, *densities = measurement.impact
    by_input = elasticities(velocity, densities[0], densities[1], resistance)
    return final_depth(*measurement.impact, resistance) * by_input["resistance"]


def _least_squares(measurements: Sequence[Measurement], uncertainties: Sequence[float]) -> float:
    """Return the resistance [Pa] with the least sum of squares.

    Every depth decreases with the resistance, so every minimum lies between the least and the
    greatest of the resistances that the measurements give singly; the bounds are a little wider, so
    that none of them is a bound. There may be several minima if the data are far apart: the search
    starts from the ends and from the median.
    """
    from scipy.optimize import least_squares

    single = sorted(_own_resistance(m) for m in measurements)

    def residuals(log_resistance: "Sequence[float]") -> list[float]:
        R_t = math.exp(log_resistance[0])
        pairs = zip(measurements, uncertainties, strict=True)
        return [(final_depth(*m.impact, R_t) - m.depth) / sigma for m, sigma in pairs]

    def slopes(log_resistance: "Sequence[float]") -> list[list[float]]:
        R_t = math.exp(log_resistance[0])
        pairs = zip(measurements, uncertainties, strict=True)
        return [[depth_slope(m, R_t) / sigma] for m, sigma in pairs]

    bounds = math.log(single[0]) - 1, math.log(single[-1]) + 1
    # The tolerances are those of doubles: a step below them changes nothing.
    options = {"jac": slopes, "bounds": bounds, "xtol": 1e-15, "ftol": 1e-15, "gtol": 1e-15}
    starts = {single[0], single[len(single) // 2], single[-1]}
    fits = [least_squares(residuals, [math.log(start)], **options) for start in sorted(starts)]
    return math.exp(min(fits, key=lambda result: result.cost).x[0])


def own_resistance(measurement: Measurement) -> float | None:
    """Return the resistance [Pa] that a measurement gives by itself; None if no double holds it."""
    with suppress(ValueError):
        return _own_resistance(measurement)
    return None


def _own_resistance(measurement: Measurement) -> float:
    """Return the resistance that a measurement gives by itself; errors name its line."""
    from replication.models import arrays

    try:
        return float(arrays.resistance_for_depth(measurement.depth, *measurement.impact))
    except InputError as error:
        where = f"line {measurement.line}: " if measurement.line else ""
        radii = f"the depth is {measurement.depth / measurement.radius:.3g} times the radius"
        if measurement.line and measurement.depth > 1e3 * measurement.radius:
            unit = "does the depth's head lack a unit, such as 'depth [um]'?"
            raise ValueError(f"{where}{radii}: {unit}") from error
        raise ValueError(f"{where}{radii}: {error}") from error
