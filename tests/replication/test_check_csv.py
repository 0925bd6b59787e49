"""`check` reads the rows that somebody's own program wrote as text."""

import math
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from replication.cases import BETA_3, BETA_5
from replication.check.show import check_record, check_text
from replication.check.workbook import check_workbook
from replication.models.impact import Impact
from replication.models.sheet import run

COLUMNS = {
    "time": ("time [ns]", 1e9),
    "velocity_initial": ("velocity [m/s]", 1.0),
    "depth": ("depth [um]", 1e6),
    "deceleration": ("deceleration [m/s^2]", 1.0),
    "velocity_final": ("final velocity [m/s]", 1.0),
}
SHORT = ("time", "velocity_initial", "depth")
DEEP = Impact(
    velocity=700, radius=1e-5, particle_density=8900, target_density=4000, beta=3,
    flow_stress=7e8, step=4e-10,
)  # fmt: skip
"""It comes to rest one and a half radii deep."""

Numbers = list[float | None]


def sheet(impact: Impact, names: Sequence[str] = tuple(COLUMNS)) -> list[Numbers]:
    """The rows of the report's sheet in the units of the heads."""
    return [
        [None if (v := getattr(row, name)) is None else v * COLUMNS[name][1] for name in names]
        for row in run(impact).rows
    ]


def csv(
    rows: Sequence[Numbers], names: Sequence[str] = tuple(COLUMNS), form: str = ".8g",
    separator: str = ",", decimal: str = ".", above: str = "",
) -> str:  # fmt: skip
    """The text of a table with heads."""
    lines = [separator.join(COLUMNS[name][0] for name in names)]
    lines += [
        separator.join("" if v is None else format(v, form).replace(".", decimal) for v in row)
        for row in rows
    ]
    return above + "".join(f"{line}\n" for line in lines)


def told(content: str | bytes, folder: Path, suffix: str = ".csv") -> str:
    """The line and column of the first difference, with its kind; or "clean"."""
    path = folder / f"mine{suffix}"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    first = check_record(check_workbook(path))["first"]
    return f"{first['where']}: {first['kind']}" if first else "clean"


@pytest.mark.parametrize("form", ["", ".12g", ".8g", ".6g", ".5g", ".4g", ".6e", ".3e", ".3f"])
@pytest.mark.parametrize("impact", [BETA_3, BETA_5], ids=["beta-3", "beta-5"])
def test_the_sheet_is_clean_whatever_its_digits(impact: Impact, form: str, tmp_path: Path) -> None:
    assert told(csv(sheet(impact), form=form), tmp_path) == "clean"


@pytest.mark.parametrize("names", [
    SHORT, ("velocity_initial", "depth"), ("depth", "time", "velocity_initial"),
    ("time", "depth", "velocity_final"), ("time", "velocity_initial", "depth", "velocity_final"),
    ("deceleration", "velocity_initial", "depth"),
])  # fmt: skip
@pytest.mark.parametrize("form", ["", ".6g"])
def test_fewer_columns_in_any_order_are_clean(
    names: Sequence[str], form: str, tmp_path: Path
) -> None:
    assert told(csv(sheet(BETA_5, names), names, form), tmp_path) == "clean"


@pytest.mark.parametrize("form", ["", ".6g"])
def test_other_inputs_that_the_file_does_not_give_are_clean(form: str, tmp_path: Path) -> None:
    assert told(csv(sheet(DEEP), form=form), tmp_path) == "clean"


def bare(table: str) -> str:
    """The table without its heads."""
    return table.split("\n", 1)[1]


SIMPLE = csv(sheet(BETA_5, SHORT), SHORT)


@pytest.mark.parametrize("content", [
    pytest.param(csv(sheet(BETA_5), separator=";", decimal=","), id="semicolons and commas"),
    pytest.param(csv(sheet(BETA_5), separator="\t"), id="tabs"),
    pytest.param(csv(sheet(BETA_5), separator="\t", decimal=","), id="tabs and commas"),
    pytest.param(csv(sheet(BETA_5, SHORT), SHORT, separator="   "), id="blanks"),
    pytest.param("\ufeff" + SIMPLE, id="a byte order mark"),
    pytest.param(("\ufeff" + SIMPLE).encode("utf-16"), id="UTF-16"),
    pytest.param(SIMPLE.replace("[um]", "[µm]").encode("cp1252"), id="a Western micro sign"),
    pytest.param(SIMPLE.replace("\n", "\r\n"), id="line ends of Windows"),
    pytest.param("# made today\n" + SIMPLE, id="a comment"),
    pytest.param("# " + SIMPLE, id="heads in a comment"),
    pytest.param("sep=;\n" + SIMPLE.replace(",", ";"), id="sep= of Excel"),
    pytest.param("\n".join(",".join(f'"{cell}"' for cell in line.split(","))
                           for line in SIMPLE.splitlines()), id="quoted cells"),
    pytest.param("My impact\nmade by hand\n\n" + SIMPLE, id="a preamble"),
    pytest.param("velocity [m/s],500\nradius [um],11\n\n" + SIMPLE, id="inputs above"),
    pytest.param("".join(f"{k if k else 'row'},{line}\n"
                         for k, line in enumerate(SIMPLE.splitlines())), id="row numbers"),
    pytest.param(SIMPLE.replace("[", "").replace("]", "").replace(" ", "_"), id="underscores"),
    pytest.param(bare(SIMPLE), id="no heads"),
    pytest.param(csv(sheet(BETA_5)).replace(",\n", ",nan\n"), id="nan where there is no number"),
])  # fmt: skip
def test_usual_ways_to_write_a_table_are_read(content: str | bytes, tmp_path: Path) -> None:
    assert told(content, tmp_path) == "clean"


@pytest.mark.parametrize(("name", "head"), [
    ("depth", "depth [um]"), ("velocity_initial", "velocity [m/s]"),
])  # fmt: skip
@pytest.mark.parametrize("form", ["", ".6g"])
def test_a_wrong_number_is_named_by_line_and_column(
    name: str, head: str, form: str, tmp_path: Path
) -> None:
    rows = sheet(BETA_5, SHORT)
    value = rows[40][SHORT.index(name)]
    assert value is not None
    rows[40][SHORT.index(name)] = value * 1.01
    expected = f"line 42, column '{head}': typed number"
    assert told(csv(rows, SHORT, form), tmp_path) == expected


def scheme(impact: Impact, **changes: bool) -> list[Numbers]:
    """The rows of a program of its own that follows the report's scheme but for some changes."""
    V, R, dt = impact.velocity, impact.radius, impact.step
    M = 4 / 3 * math.pi * R**3 * impact.particle_density
    rows: list[Numbers] = [[0.0, V, 0.0, 0.0, None]]
    x, v, k = 0.0, V, 0
    while v >= 1:
        k += 1
        x += v * dt if k > 1 or changes.get("whole_step") else v * dt / 2
        area = R * R if x >= R and not changes.get("shrinking") else 2 * R * x - x * x
        drag_at = V if changes.get("impact_drag") else v

        def brake(u: float, area: float = area) -> float:
            stress = impact.target_density * u * u / 2 + impact.beta * impact.flow_stress
            return stress * math.pi * area / M

        a = brake(drag_at)
        if changes.get("centered"):
            a = brake(v - a * dt / 2)
        rows.append([k * dt * 1e9, v, x * 1e6, a, v - a * dt])
        v -= a * dt
    return rows


@pytest.mark.parametrize("form", ["", ".6g"])
@pytest.mark.parametrize(("impact", "change", "line", "words"), [
    (BETA_5, "whole_step", 3, "no half step"),
    (BETA_5, "impact_drag", 4, "drag, or has it at the impact velocity"),
    (BETA_5, "centered", 3, "centered"),
    (DEEP, "shrinking", 2, "area beyond the radius"),
])  # fmt: skip
def test_another_scheme_is_named_with_its_first_row(
    impact: Impact, change: str, line: int, words: str, form: str, tmp_path: Path
) -> None:
    rows = scheme(impact, **{change: True})
    if change == "shrinking":
        line += next(k for k, row in enumerate(rows) if (row[2] or 0.0) > impact.radius * 1e6)
    path = tmp_path / "mine.csv"
    path.write_text(csv(rows, form=form))
    first = check_record(check_workbook(path))["first"]
    assert (first["kind"], first["where"].split(",")[0]) == ("other scheme", f"line {line}")
    assert words in first["explanation"]


TEXTBOOK = ("time", "depth", "velocity_initial", "deceleration")
SLOW = Impact(
    velocity=80, radius=3e-5, particle_density=2700, target_density=7850, beta=2,
    flow_stress=5e8, step=1e-9,
)  # fmt: skip


def brake(impact: Impact, x: float, v: float) -> float:
    """The deceleration by the report's equation."""
    R = impact.radius
    M = 4 / 3 * math.pi * R**3 * impact.particle_density
    area = math.pi * (R * R if x >= R else 2 * R * x - x * x)
    return (impact.target_density * v * v / 2 + impact.beta * impact.flow_stress) * area / M


def explicit_euler(impact: Impact) -> list[Numbers]:
    """Depth, velocity and deceleration of one moment in one row; both move on by the old ones."""
    rows: list[Numbers] = []
    t, x, v = 0.0, 0.0, impact.velocity
    while v > 0:
        a = brake(impact, x, v)
        rows.append([t * 1e9, x * 1e6, v, a])
        t, x, v = t + impact.step, x + v * impact.step, v - a * impact.step
    return rows


def runge_kutta(impact: Impact, within: int = 1) -> list[Numbers]:
    """The classical method of fourth order, with some steps `within` each row."""
    rows: list[Numbers] = []
    x, v, h, k = 0.0, impact.velocity, impact.step / within, 0
    while v > 0:
        if k % within == 0:
            rows.append([k * h * 1e9, x * 1e6, v])
        u1, a1 = v, brake(impact, x, v)
        u2, a2 = v - h / 2 * a1, brake(impact, x + h / 2 * u1, v - h / 2 * a1)
        u3, a3 = v - h / 2 * a2, brake(impact, x + h / 2 * u2, v - h / 2 * a2)
        u4, a4 = v - h * a3, brake(impact, x + h * u3, v - h * a3)
        x += h / 6 * (u1 + 2 * u2 + 2 * u3 + u4)
        v -= h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
        k += 1
    return rows


INPUTS = pytest.mark.parametrize(
    "impact", [BETA_5, BETA_3, DEEP, SLOW], ids=["beta-5", "beta-3", "deep", "slow"]
)


@INPUTS
@pytest.mark.parametrize("form", [".12g", pytest.param(".6g", marks=pytest.mark.slow)])
@pytest.mark.parametrize(("names", "above"), [
    (TEXTBOOK, ""), (TEXTBOOK[:3], ""), (TEXTBOOK[:3], "radius [um],{}\n"),
], ids=["braked", "bare", "the radius above"])  # fmt: skip
def test_explicit_euler_is_named_once_and_no_number_is_accused(
    impact: Impact, form: str, names: Sequence[str], above: str, tmp_path: Path
) -> None:
    path = tmp_path / "mine.csv"
    rows = [row[: len(names)] for row in explicit_euler(impact)]
    head = above.format(impact.radius * 1e6)
    path.write_text(csv(rows, names, form, above=head))
    record = check_record(check_workbook(path))
    faults = [d for d in record["differences"]
              if d["kind"] not in ("not calculated", "other input")]  # fmt: skip
    line = 4 if above else 3
    assert [(d["kind"], d["where"]) for d in faults] == [
        ("other scheme", f"line {line}, column 'depth [um]'")
    ]
    assert faults[0]["explanation"].startswith("explicit Euler")
    # Six digits tell the radius to three percent or better.
    radius = record["taken"][0]["inputs"]["radius"]["value"]
    assert radius == pytest.approx(impact.radius, rel=0.03 if form == ".6g" else 1e-5)


@INPUTS
@pytest.mark.parametrize("form", [".6g", pytest.param("", marks=pytest.mark.slow)])
@pytest.mark.parametrize("within", [1, 8], ids=["Runge-Kutta", "as good as exact"])
def test_rows_of_a_better_method_are_found_and_not_judged(
    impact: Impact, form: str, within: int, tmp_path: Path
) -> None:
    names = ("time", "depth", "velocity_initial")
    with pytest.raises(ValueError, match="the rows follow another method than the report's sheet"):
        told(csv(runge_kutta(impact, within), names, form), tmp_path)


@pytest.mark.parametrize(("power", "form"), [(1, ".12g"), (3, ".6g")])
def test_rows_that_mostly_follow_no_such_force_are_not_judged(
    power: int, form: str, tmp_path: Path
) -> None:
    rows: list[Numbers] = []
    x, v = 0.0, 500.0
    for k in range(30):
        rows.append([k * 0.2, x * 1e6, v])
        x += v * 2e-10
        v -= 2e-10 * 4e10 * v * (v / 500) ** (power - 1) * (x / 5e-6) ** 2
    with pytest.raises(ValueError, match="most rows do not follow the report's scheme"):
        told(csv(rows, ("time", "depth", "velocity_initial"), form), tmp_path)


@pytest.mark.parametrize("form", ["", ".8g"])
@pytest.mark.parametrize(("changes", "said"), [
    ({}, []),
    ({"step": 5e-10}, []),
    ({"velocity": 450.0}, ["the impact velocity 450 m/s"]),
    ({"radius": 2e-5}, ["the radius 2e-05 m"]),
    ({"step": 3e-10}, ["the time step 3e-10 s"]),
    ({"velocity": 450.0, "beta": 4.0, "target_density": 7900.0},
     ["the impact velocity 450 m/s", "the target density 0.8876", "the target resistance 3146",
      "the rows tell only the ratios of both densities and the resistance"]),
])  # fmt: skip
def test_other_inputs_that_right_rows_show_are_said(
    changes: dict[str, float], said: list[str], form: str, tmp_path: Path
) -> None:
    path = tmp_path / "mine.csv"
    path.write_text(csv(sheet(replace(BETA_5, **changes)), form=form))
    record = check_record(check_workbook(path))
    kinds = {"other input": 1 + (len(said) > 1)} if said else {}
    scheme = "the report's scheme" if said else "the report's sheet"
    assert (record["clean"], record["summary"]) == (True, kinds)
    assert record["verdict"].startswith(f"Clean: {scheme}, row by row, to its digits")
    assert [text for text in said if text not in record["verdict"]] == []


def test_the_program_of_these_tests_is_right_without_changes(tmp_path: Path) -> None:
    assert told(csv(scheme(DEEP)), tmp_path) == "clean"


def test_every_place_in_a_text_file_is_where(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a difference, a column, and a printed number of the report that the rows hold."""
    monkeypatch.chdir(tmp_path)
    path = Path("mine.csv")
    path.write_text(csv(scheme(BETA_5, centered=True)))
    record = check_record(check_workbook(path))
    columns = record["taken"][0]["columns"].values()
    for entry in [*record["differences"], *columns, *record["claims"]]:
        assert re.search(r"\bline", entry["where"]), entry
    assert record["claims"]
    assert all("line" not in claim for claim in record["claims"])
    assert max(map(len, check_text(record).splitlines())) > 80
    assert max(map(len, check_text(record, 80).splitlines())) <= 80


@pytest.mark.parametrize(("content", "message"), [
    ("", "holds no table"),
    ("one, two\nthree\n", "of its lines none consist of two or more numbers"),
    ("time,depth\n0,0\n1,2\n", "of its lines only 2 consist of two or more numbers"),
    (b"\x00\x01\x02" * 20, "is not text"),
    ("a,b\n" + "".join(f"{k},{(k * 7919) % 101}\n" for k in range(40)), "no table of depth"),
    ("h,v\n" + "".join(f"{k},{300 - 9.81 * k}\n" for k in range(20)), "no table of depth"),
    ('a,b\n1,"' + "x" * 200_000 + "\n", "is not CSV"),
], ids=["empty", "words", "two rows", "binary", "noise", "thrown", "open quote"])  # fmt: skip
def test_what_holds_no_table_is_refused(content: str | bytes, message: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=message) as error:
        told(content, tmp_path)
    assert "\n" not in str(error.value)


def test_a_single_number_with_far_more_digits_than_its_column_is_named(tmp_path: Path) -> None:
    lines = csv(sheet(BETA_5, SHORT), SHORT, ".5f").splitlines()
    time, velocity, _ = lines[41].split(",")
    lines[41] = f"{time},{velocity},3.8000000001"
    assert told("\n".join(lines), tmp_path) == "line 42, column 'depth [um]': typed number"


def test_text_and_json_name_lines_and_cells(tmp_path: Path) -> None:
    rows = sheet(BETA_5, SHORT)
    rows[40][2] = 3.8
    path = tmp_path / "mine.csv"
    path.write_text(csv(rows, SHORT))
    record = check_record(check_workbook(path))
    assert (record["first"]["sheet"], record["first"]["cell"]) == ("mine", "C42")
    assert "  line 42, column 'depth [um]', wrong number" in check_text(record)
    assert "column 'velocity [m/s]', lines 2 to 133" in check_text(record)
