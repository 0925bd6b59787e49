"""`check` on rows of which one thing is wrong, or that only look wrong, made by integrators here."""

import math
from pathlib import Path

import pytest

from replication.check.show import check_record
from replication.check.workbook import check_workbook

V, R, RHO_P, RHO_T, STRENGTH, DT = 500.0, 11e-6, 8900.0, 7850.0, 3.5e9, 2e-10
M = 4 / 3 * math.pi * R**3 * RHO_P
HEADS = ("time [ns]", "velocity [m/s]", "depth [um]", "deceleration [m/s^2]")
FORMS = (".1f", ".3f", ".5f", ".6e")

Rows = list[list[float]]


def brake(x: float, v: float) -> float:
    """The deceleration by the report's equation, at depths below the radius."""
    return (RHO_T * v * v / 2 + STRENGTH) * math.pi * (2 * R * x - x * x) / M


def sheet(dt: float = DT, stop: float = 1.0) -> Rows:
    """Time, velocity at the start, depth and deceleration of the report's rows, row 0 first."""
    rows, x, v, k = [[0.0, V, 0.0, 0.0]], 0.0, V, 0
    while v >= stop:
        k += 1
        x += v * dt if k > 1 else v * dt / 2
        a = brake(x, v)
        rows.append([k * dt * 1e9, v, x * 1e6, a])
        v -= a * dt
    return rows


def text(rows: Rows, columns: int = 3, forms: tuple[str, ...] = FORMS, above: str = "") -> str:
    """The rows as CSV, with their first columns."""
    lines = [",".join(HEADS[:columns])]
    lines += [",".join(format(v, f) for v, f in zip(row, forms, strict=False)) for row in
              (row[:columns] for row in rows)]  # fmt: skip
    return above + "\n".join(lines) + "\n"


def changed(rows: Rows, k: int, column: int, value: float) -> Rows:
    """The rows with another number in one place."""
    return [[value if (i, j) == (k, column) else v for j, v in enumerate(row)]
            for i, row in enumerate(rows)]  # fmt: skip


def faults(content: str, folder: Path) -> list[tuple[int, str, object]]:
    """The line, the head and the expected value of each fault."""
    path = folder / "mine.csv"
    path.write_text(content)
    record = check_record(check_workbook(path))
    return [
        (int(d["where"].split()[1].rstrip(",")), d["where"].partition("'")[2].rstrip("'"),
         d["expected"])
        for d in record["differences"] if d["kind"] not in ("not calculated", "other input")
    ]  # fmt: skip


# ---- row 0, the impact


@pytest.mark.parametrize(("column", "value", "expected"), [
    (1, 400.0, 500.0), (1, 510.0, 500.0), (1, 0.0, 500.0), (2, 1.0, 0.0), (2, 0.02, 0.0),
    (3, 5e8, 0.0), (3, -3e8, 0.0),
])  # fmt: skip
def test_a_wrong_number_in_the_row_of_the_impact_is_named(
    column: int, value: float, expected: float, tmp_path: Path
) -> None:
    rows = changed(sheet(), 0, column, value)
    assert faults(text(rows, 4), tmp_path) == [(2, HEADS[column], expected)]


@pytest.mark.parametrize(("column", "value"), [
    (1, V - brake(V * DT / 2, V) * DT / 2), (1, V + brake(V * DT / 2, V) * DT / 2),
    (2, -V * DT / 2 * 1e6), (2, 1e-5), (3, brake(V * DT / 2, V)), (3, brake(V * DT / 4, V)),
])  # fmt: skip
def test_other_ways_to_fill_the_row_of_the_impact_are_clean(
    column: int, value: float, tmp_path: Path
) -> None:
    rows = changed(sheet(), 0, column, value)
    assert faults(text(rows, 4), tmp_path) == []


def test_a_wrong_velocity_and_depth_of_the_impact_are_both_named(tmp_path: Path) -> None:
    rows = changed(changed(sheet(), 0, 1, 5.0), 0, 2, 1.0)
    assert faults(text(rows), tmp_path) == [(2, HEADS[1], 500.0), (2, HEADS[2], 0.0)]
