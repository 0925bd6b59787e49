"""`check` on rows made by integrators here: one thing in them is wrong, or only looks wrong."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest

from replication.check.show import check_page, check_record, check_text
from replication.check.workbook import check_workbook

V, R, RHO_P, RHO_T, STRENGTH, DT = 500.0, 11e-6, 8900.0, 7850.0, 3.5e9, 2e-10
M = 4 / 3 * math.pi * R**3 * RHO_P
HEADS = ("time [ns]", "velocity [m/s]", "depth [um]", "deceleration [m/s^2]")
FORMS = (".1f", ".3f", ".5f", ".6e")

Rows = list[list[float]]


def brake(x: float, v: float) -> float:
    """The deceleration by the report's equation, at depths below the radius."""
    return (RHO_T * v * v / 2 + STRENGTH) * math.pi * (2 * R * x - x * x) / M


def sheet(dt: float = DT, stop: float = 1.0, centered: bool = False) -> Rows:
    """Time, velocity at the start, depth and deceleration of the report's rows, row 0 first."""
    rows, x, v, k = [[0.0, V, 0.0, 0.0]], 0.0, V, 0
    while v >= stop:
        k += 1
        x += v * dt if k > 1 else v * dt / 2
        a = brake(x, v)
        for _ in range(9 if centered else 0):
            a = brake(x, v - a * dt / 2)
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


# ---- times


@pytest.mark.parametrize(("form", "value"), [
    (".1f", 12.2), (".1f", 12.1), (".2f", 12.02), (".6f", 12.00001), (".4g", 12.03),
])  # fmt: skip
def test_a_time_is_known_to_half_a_unit_of_its_last_digit(
    form: str, value: float, tmp_path: Path
) -> None:
    rows = changed(sheet(), 60, 0, value)
    ((line, head, expected),) = faults(text(rows, 3, (form, *FORMS[1:])), tmp_path)
    assert (line, head, expected) == (62, HEADS[0], pytest.approx(12.0))


def with_times(time: Callable[[int], float], dt: float = DT) -> Rows:
    """Right rows with other times."""
    return [[time(k), *row[1:]] for k, row in enumerate(sheet(dt))]


def test_times_that_are_late_from_a_row_on_are_named_once(tmp_path: Path) -> None:
    rows = with_times(lambda k: 0.2 * (k + (k >= 60)))
    assert faults(text(rows), tmp_path) == [(62, HEADS[0], pytest.approx(12.0))]


def test_a_time_of_the_impact_that_the_others_do_not_give_is_named(tmp_path: Path) -> None:
    assert faults(text(changed(sheet(), 0, 0, 3.0)), tmp_path) == [(2, HEADS[0], 0.0)]


def test_times_that_grow_by_another_step_than_the_depths_are_named(tmp_path: Path) -> None:
    ((line, head, _),) = faults(text(with_times(lambda k: 0.21 * k), 3, (".2f", ".6f", ".8f")),
                                tmp_path)  # fmt: skip
    assert (line, head) == (3, HEADS[0])


def single(k: int) -> float:
    """The time of row k as a program in single precision adds it up."""
    import numpy as np

    total = np.float32(0)
    for _ in range(k):
        total += np.float32(0.2)
    return float(total)


@pytest.mark.parametrize(("time", "dt", "form"), [
    (lambda k: max(0.0, 0.2 * k - 0.1), DT, ".1f"),
    (lambda k: max(0.0, 0.2 * k - 0.2), DT, ".1f"),
    (lambda k: 0.2 * k + 0.07, DT, ".1f"),
    (lambda k: math.floor(2 * k) / 10, DT, ".1f"),
    (lambda k: k / 3, 1e-9 / 3, ".1f"),
    (lambda k: k / 4, 2.5e-10, ".1f"),
    (lambda k: max(0.0, 0.33 * k - 0.165), 3.3e-10, ".2f"),
    (lambda k: 0.2000213 * k, 2.000213e-10, ".2f"),
    (lambda k: 0.0567891 * k, 5.67891e-11, ".1f"),
    (lambda k: 0.2 * k, DT, ".4e"),
    (lambda k: 0.2 * k, DT, ""),
    (single, DT, ".4f"),
    (single, DT, ".6g"),
], ids=["half a step before", "a step before", "delayed", "cut off", "thirds", "ties", "half ties",
        "a digit more", "coarse", "exponents", "all digits", "single precision",
        "single precision, six digits"])  # fmt: skip
def test_other_ways_to_count_times_are_clean(
    time: Callable[[int], float], dt: float, form: str, tmp_path: Path
) -> None:
    rows = text(with_times(time, dt), 3, (form, ".6f", ".8f"))
    assert faults(rows, tmp_path) == []


# ---- other methods, printed with few digits


def of_higher_order(dt: float, runge_kutta: bool) -> Rows:
    """Time, velocity and depth of one moment in each row, by a method of order four or two."""
    rows, x, v, k = [], 0.0, V, 0
    while v >= 1:
        rows.append([k * dt * 1e9, v, x * 1e6])
        a1 = brake(x, v)
        if runge_kutta:
            u2, u3 = v - dt / 2 * a1, 0.0
            a2 = brake(x + dt / 2 * v, u2)
            u3 = v - dt / 2 * a2
            a3 = brake(x + dt / 2 * u2, u3)
            u4 = v - dt * a3
            a4 = brake(x + dt * u3, u4)
            x += dt / 6 * (v + 2 * u2 + 2 * u3 + u4)
            v -= dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
        else:
            x += v * dt - a1 * dt * dt / 2
            v -= a1 * dt
        k += 1
    return rows


@pytest.mark.parametrize("runge_kutta", [True, False], ids=["Runge-Kutta", "parabolas"])
@pytest.mark.parametrize("columns", [3, pytest.param(2, marks=pytest.mark.slow)])
@pytest.mark.parametrize(("dt", "forms"), [
    (2e-10, (".2f", ".1f", ".2f")), (2e-10, (".2f", ".2f", ".3f")), (5e-10, (".1f", ".1f", ".2f")),
    (1e-10, (".1f", ".1f", ".2f")),
    pytest.param(2e-11, (".2f", ".1f", ".3f"), marks=pytest.mark.slow),
])  # fmt: skip
def test_better_methods_with_few_digits_are_not_judged(
    dt: float, forms: tuple[str, ...], columns: int, runge_kutta: bool, tmp_path: Path
) -> None:
    rows = of_higher_order(dt, runge_kutta)
    rows = rows if columns == 3 else [[v, x] for _, v, x in rows]
    heads = HEADS[3 - columns : 3]
    lines = [",".join(format(v, f) for v, f in zip(row, forms[3 - columns :], strict=True))
             for row in rows]  # fmt: skip
    with pytest.raises(ValueError, match=r"another method|to be a depth"):
        faults("\n".join([",".join(heads), *lines]) + "\n", tmp_path)


# ---- inputs solved from rows


@pytest.mark.parametrize("digits", [1, 2, 3])
def test_rows_that_the_report_s_force_explains_have_no_other_input(
    digits: int, tmp_path: Path
) -> None:
    path = tmp_path / "mine.csv"
    path.write_text(text(sheet(centered=True), 3, (".2f", f".{digits}f", f".{digits + 1}f")))
    record = check_record(check_workbook(path))
    assert (record["summary"].get("other input"), "other inputs" in record["verdict"]) == (
        None,
        False,
    )
    assert "do not tell whether all inputs are the report's" in record["verdict"]


def test_an_input_is_shown_to_the_digits_that_the_rows_tell(tmp_path: Path) -> None:
    path = tmp_path / "mine.csv"
    path.write_text(text(sheet(centered=True), 3, (".2f", ".3f", ".4f")))
    record = check_record(check_workbook(path))
    radius = record["taken"][0]["inputs"]["radius"]
    assert abs(radius["value"] / R - 1) < 0.05
    assert radius["relative_error"] > 1e-3
    (line,) = (line for line in check_text(record).splitlines() if "    radius" in line)
    assert len(line.split()[2]) <= len("1.06e-05")


# ---- a stated mass


@pytest.mark.parametrize("stated", ["mass [kg],4.96e-10", "mass [kg],5.3e-11", "mass [ng],4.96"])
def test_a_mass_that_is_not_that_of_the_rows_is_named(stated: str, tmp_path: Path) -> None:
    ((line, _, expected),) = faults(text(sheet(), 4, above=f"{stated}\n"), tmp_path)
    unit = 1e12 if "ng" in stated else 1.0
    assert (line, expected) == (1, pytest.approx(M * unit))


@pytest.mark.parametrize("stated", ["mass [kg],4.96e-11", "mass [kg],5e-11", "mass [ng],49.62"])
def test_a_mass_that_is_that_of_the_rows_to_its_digits_is_clean(
    stated: str, tmp_path: Path
) -> None:
    assert faults(text(sheet(), 4, above=f"{stated}\n"), tmp_path) == []


# ---- excerpts, and rows that are missing


@pytest.mark.parametrize("last", [10, 60, 90, 129])
def test_rows_that_end_early_are_no_fault_wherever_they_end(last: int, tmp_path: Path) -> None:
    path = tmp_path / "mine.csv"
    path.write_text(text(sheet()[: last + 1], 4, (".1f", ".9f", ".10f", ".12e")))
    record = check_record(check_workbook(path))
    assert (record["clean"], record["final_depths"][0]["found"]) == (True, None)
    assert record["summary"] == {"not calculated": 1}
    assert "as far as it goes" in record["verdict"]


@pytest.mark.parametrize("columns", [3, 4])
@pytest.mark.parametrize("form", [".4f", ".9f"])
@pytest.mark.parametrize(("gone", "says"), [
    ([50], "a row is missing after line 51"), ([120, 121], "2 rows are missing after line 121"),
])  # fmt: skip
def test_rows_that_are_left_out_are_named(
    gone: list[int], says: str, form: str, columns: int, tmp_path: Path
) -> None:
    rows = [row for k, row in enumerate(sheet()) if k not in gone]
    path = tmp_path / "mine.csv"
    path.write_text(text(rows, columns, (".1f", form, form, ".7e")))
    record = check_record(check_workbook(path))
    faulty = [d for d in record["differences"] if d["kind"] != "not calculated"]
    assert [(d["where"].split(",")[0], d["explanation"]) for d in faulty] == [
        (f"line {gone[0] + 2}", says)
    ]
    assert record["taken"][0]["steps"] == 131
    assert "ends at the right depth" in record["verdict"]


@pytest.mark.parametrize("columns", [3, 4])
@pytest.mark.parametrize("k", [1, 50, 131])
def test_a_row_that_stands_twice_is_named(k: int, columns: int, tmp_path: Path) -> None:
    rows = sheet()
    path = tmp_path / "mine.csv"
    path.write_text(text([*rows[: k + 1], *rows[k:]], columns))
    record = check_record(check_workbook(path))
    assert [d["explanation"] for d in record["differences"]] == [
        f"a row stands twice (line {k + 3})"
    ]
    assert record["taken"][0]["steps"] == 131


def test_a_row_that_is_blank_is_left_out_openly(tmp_path: Path) -> None:
    lines = text(sheet(), 4).splitlines()
    lines[51] = ""
    assert faults("\n".join(lines), tmp_path) == []


# ---- what stands above the table, and words


STATED = "# R = 11 um\n# rho_p = 8900 kg/m3; rho_t = {} kg/m3\n# beta: 5, Y: 700 MPa\n"


@pytest.mark.parametrize(("density", "expected"), [(7850, []), (7580, [HEADS[3]])])
def test_inputs_that_comments_state_are_read(
    density: int, expected: list[str], tmp_path: Path
) -> None:
    content = text(sheet(), 4, above=STATED.format(density))
    assert [head for _, head, _ in faults(content, tmp_path)] == expected
    inputs = check_record(check_workbook(tmp_path / "mine.csv"))["taken"][0]["inputs"]
    assert {name: inputs[name]["where"] for name in ("radius", "target_density", "beta")} == {
        "radius": "line 1, cell 2", "target_density": "line 2, cell 5", "beta": "line 3, cell 2"
    }  # fmt: skip


def test_what_is_not_read_above_the_table_is_said(tmp_path: Path) -> None:
    path = tmp_path / "mine.csv"
    path.write_text(text(sheet(), above="# my impact\n# drag coefficient = 0.5\n"))
    record = check_record(check_workbook(path))
    assert (record["clean"], record["notes"]) == (
        True, ["line 2 is not read: drag coefficient = 0.5"]
    )  # fmt: skip


def test_the_text_speaks_of_a_file_and_not_of_cells(tmp_path: Path) -> None:
    path = tmp_path / "mine.csv"
    path.write_text(text(changed(sheet(), 40, 2, 3.8), above="radius [um],11\n"))
    checked = check_workbook(path)
    record = check_record(checked)
    shown = check_text(record)
    page = check_page(record, checked.differences, checked.evaluator)
    assert "<h3>The file: 131 steps" in page
    assert "line 43, column 'depth [um]', wrong number" in shown
    assert "line 1, cell 2" in shown
    assert [word for word in ("sheet 'mine'", "no cell", "typed", "formula") if word in shown] == []


def test_rows_that_all_are_beyond_the_radius_tell_no_diameter(tmp_path: Path) -> None:
    """Half of the first step is longer than the radius; nothing contradicts the one stated."""
    radius, dt = 5.661e-4, 1.3e-6
    mass, strength = 4 / 3 * math.pi * radius**3 * 10100, 1.15 * 24.6e6
    rows, x, v = [[0.0, 1100.0, 0.0, 0.0]], 1100 * dt / 2, 1100.0
    while v >= 1:
        a = (8970 * v * v / 2 + strength) * math.pi * radius**2 / mass
        rows.append([len(rows) * dt * 1e9, v, x * 1e6, a])
        v -= a * dt
        x += v * dt
    above = "radius [um],566.1\nparticle density [kg/m3],10100\ntarget density [kg/m3],8970\n"
    above += "beta,1.15\nflow stress [MPa],24.6\n"
    assert faults(text(rows, 4, (".0f", ".4f", ".3f", ".6e"), above), tmp_path) == []
