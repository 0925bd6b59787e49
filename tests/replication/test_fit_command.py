"""`coldspray fit`: files of measurements at the command line. The fits are in `test_fit.py`."""

import json
from pathlib import Path

import pytest
from running import coldspray

from replication import BETA_5
from replication.fit import fit, read_measurements

EXAMPLE = Path(__file__).parents[2] / "docs" / "fit.csv"


@pytest.mark.parametrize("typed", ["resistance", "beta", "flow-stress"])
def test_json_has_the_promised_keys_and_the_fit_of_python(typed: str) -> None:
    status, out, err = coldspray("fit", EXAMPLE, "--quantity", typed, "--json")
    record, quantity = json.loads(out), typed.replace("-", "_")
    expected = fit(BETA_5, read_measurements(EXAMPLE, BETA_5), quantity)
    assert (status, err) == (0, "")
    assert record["quantity"] == quantity
    assert record["value"] == expected.value
    assert record["standard_error"] == expected.standard_error
    assert record["residuals"] == list(expected.residuals)
    assert record["points"] == 11


def test_the_other_factor_is_the_cases() -> None:
    values = [
        json.loads(coldspray("fit", EXAMPLE, "--quantity", "beta", *more, "--json")[1])
        for more in ((), ("--flow-stress", "350 MPa"))
    ]
    assert values[1]["value"] == 2 * values[0]["value"]  # a power of two: no rounding
    assert values[1]["inputs"]["flow_stress"] == 350e6


def test_inputs_by_row_are_not_said_to_be_common(tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text("v,x [um],radius [um]\n500,7.6,11\n500,3.5,5\n", "utf-8")
    record = json.loads(coldspray("fit", file, "--json")[1])
    assert record["inputs"] == {"particle_density": 8900.0, "target_density": 7850.0}


def test_normalized_depths_and_their_uncertainties_are_times_the_radius(tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    for head in ("X/R", "normalized depth [1]", "Normalized depth [-]"):
        file.write_text(f"v,{head},sigma,R [um]\n500,0.5,0.25,8\n", "utf-8")
        (measurement,) = read_measurements(file, BETA_5)
        assert (measurement.depth, measurement.uncertainty) == (4e-6, 2e-6)


def test_without_uncertainties_the_scatter_gives_the_error(tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text("v,x [um]\n500,7.6\n450,7\n", "utf-8")
    out = coldspray("fit", file)[1]
    assert ", by the scatter\n" in out
    assert "chi square" not in out
    file.write_text("v,x [um]\n500,7.6\n", "utf-8")
    assert "standard error  unknown: one measurement, without" in coldspray("fit", file)[1]


@pytest.mark.parametrize(
    ("content", "line"),
    [
        ("v,x [um]\n500,7.6\n400,?\n,3\n", "FILE, line 4, column 'v': the cell is empty"),
        ("v,x [um]\n500,7.6\n400,?\n300,\n", "FILE, line 3, column 'x [um]': '?' is not a "
         "finite number with or without a unit, such as '1 um' (line 4, too)"),
        ("v,x [um]\n0,7.6\n", "FILE, line 2: velocity is 0: it must be a number greater than zero"),
        ("v [MPa],x\n500,7.6\n", "FILE, column 'v [MPa]': MPa does not measure what m/s "
         "does"),
        ("v,x,X/R\n500,7.6,1\n", "FILE has both a depth and a normalized depth: leave one of them "
         "out"),
        ("v\n500\n", "FILE has no column 'depth': it needs one such as 'depth [um]' (it has 'v')"),
        ("v,x\n500,7.6\n", "FILE, line 2: the depth is 6.91e+05 times the radius: is it in um? "
         "Then write 'x [um]'"),
        ("v,x\n500,7.6 mm\n", "FILE, line 2: the depth is 691 times the radius: is it in um? Then "
         "write '7.6 um'"),
        ("v,x [mm]\n500,10\n", "FILE, line 2: the depth is 909 times the radius: is it in um? Then "
         "write 'x [um]'"),
        ("v,X/R\n500,0.6\n500,40\n500,47\n", "FILE, line 3: the depth is 40 times the radius: is "
         "it in %? Then write 'X/R [%]'"),
        ("velocty [m/s],x\n500,7.6\n", "FILE has no column 'velocity': rename 'velocty [m/s]' to "
         "'velocity [m/s]' (it has 'velocty [m/s]', 'x')"),
        ("v,x\n", "FILE: has no row of numbers below a row of heads"),
    ],
)  # fmt: skip
def test_bad_rows_are_named_by_file_line_and_column(
    content: str, line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("mine.csv").write_text(content, "utf-8")
    line = line.replace("FILE", "mine.csv")
    assert coldspray("fit", "mine.csv") == (2, "", f"coldspray fit: {line}\n")


@pytest.mark.parametrize(
    ("content", "line"),
    [
        ("v,Depth [mm]\n400,6.1\n500,7.6\n", "line 2: the depth is 555 times the radius: is "
         "it in um? Then write 'Depth [um]'"),
        ("v,x [nm]\n500,7.6\n", "line 2: the depth is 0.000691 times the radius: is it in "
         "um? Then write 'x [um]'"),
        ("v,X/R [%]\n500,0.4\n", "line 2: the depth is 0.004 times the radius: is it no "
         "percentage? Then write 'X/R [1]'"),
        ("v,x [um]\n500,7600\n500,7.6\n500,7.7\n", "line 2: the depth is 691 times the "
         "radius: unlike most others: is it a slip?"),
    ],
)  # fmt: skip
def test_a_stated_unit_is_believed_where_a_fit_can_be_computed_and_asked_about(
    content: str, line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("mine.csv").write_text(content, "utf-8")
    status, _, err = coldspray("fit", "mine.csv")
    assert status == 0
    assert err.startswith(f"coldspray fit: warning: mine.csv, {line}\n")


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ("--velocity 400", "--velocity: the file has the velocities: leave it out"),
        ("--resistance 3e9", "--resistance is what is fitted: leave it out"),
        ("--quantity beta --resistance 3e9",
         "--resistance has no say where the beta is fitted: leave it out"),
        ("--diameter 22um", "argument --diameter: give the radius, which is half: --radius "
         '"11 um" (see coldspray fit --help)'),
        ("--quantity velocity", "argument --quantity: there is no quantity 'velocity': choose one "
         "of resistance, beta, flow-stress (see coldspray fit --help)"),
    ],
)  # fmt: skip
def test_options_that_say_nothing_are_refused(arguments: str, line: str) -> None:
    assert coldspray("fit", EXAMPLE, *arguments.split()) == (2, "", f"coldspray fit: {line}\n")


@pytest.mark.parametrize(
    ("head", "option"),
    [
        ("radius [um]", "--radius"),
        ("diameter [um]", "--radius"),
        ("target density", "--target-density"),
        ("particle density", "--particle-density"),
    ],
)
def test_an_input_is_a_column_or_an_option_but_not_both(
    head: str, option: str, tmp_path: Path
) -> None:
    file = tmp_path / "mine.csv"
    file.write_text(f"v,x [um],{head}\n500,7.6,11\n", "utf-8")
    line = f"{option}: {file} has the column '{head}': leave out one of the two"
    assert coldspray("fit", file, option, "5e-6") == (2, "", f"coldspray fit: {line}\n")


def test_a_percentage_is_said_to_be_a_share(tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text("v,x [um],sd [%]\n500,7.6,3\n450,7,3\n", "utf-8")
    note = f"{file}: 'sd [%]' is taken as a share of the depth in its line"
    assert json.loads(coldspray("fit", file, "--json")[1])["notes"] == [note]


def test_a_case_without_the_other_factor_cannot_give_this_one(tmp_path: Path) -> None:
    file = tmp_path / "case.toml"
    file.write_text("[impact]\nresistance = 3e9\n", "utf-8")
    done = coldspray("fit", EXAMPLE, "--quantity", "beta", "--case-file", file)
    line = "the beta is the resistance over the flow stress: give the flow stress"
    assert done == (2, "", f"coldspray fit: {line}\n")


@pytest.mark.parametrize(
    ("heads", "warning"),
    [
        ("v [km/s],x [um]", "velocity is 500000 m/s: from 1 to 100000 m/s is expected"),
        ("v [mm/s],x [um]", "velocity is 0.5 m/s: from 1 to 100000 m/s is expected"),
    ],
)
def test_a_value_that_no_impact_has_is_named_by_its_line(
    heads: str, warning: str, tmp_path: Path
) -> None:
    file = tmp_path / "mine.csv"
    file.write_text(f"{heads}\n500,7.6\n400,6.1\n", "utf-8")
    expected = f"coldspray fit: warning: {file}, line 2: {warning}\n"
    assert expected in coldspray("fit", file)[2]


def test_a_chi_square_that_is_improbable_is_warned_of(tmp_path: Path) -> None:
    """The depth of line 7, at 420 m/s, is ten times too large: some 270 uncertainties."""
    file = tmp_path / "mine.csv"
    file.write_text(EXAMPLE.read_text("utf-8").replace("\n420,6.31,", "\n420,63.1,"), "utf-8")
    status, out, err = coldspray("fit", file)
    assert (status, out.count("\n4 ")) == (0, 1)
    assert err == (
        f"coldspray fit: warning: {file}: so large a chi square has a chance of less than 1e-99: "
        "the uncertainties do not account for the residuals, and the standard error by them means "
        "little; line 7 is off by most, 271 uncertainties\n"
    )
    assert json.loads(coldspray("fit", file, "--json")[1])["warnings"] == [
        err.removeprefix("coldspray fit: warning: ").strip()
    ]
    assert coldspray("fit", EXAMPLE)[2] == ""


def test_a_line_that_is_far_off_the_others_is_named_and_fitted(tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    depths = {300: 4.441, 350: 5.156, 400: 6.053, 450: 69.343, 500: 7.849, 550: 8.498}
    rows = "".join(f"{velocity},{depth}\n" for velocity, depth in depths.items())
    file.write_text(f"v,x [um]\n{rows}", "utf-8")
    status, _, err = coldspray("fit", file)
    assert status == 0
    assert err.startswith(
        f"coldspray fit: warning: {file}: line 5 is far off the others: 62.5 um more than they give"
    )
    assert json.loads(coldspray("fit", file, "--json")[1])["points"] == 6
    file.write_text(f"v,x [um]\n{rows.replace('69.343', '6.9343')}", "utf-8")
    assert coldspray("fit", file)[2] == ""


@pytest.mark.parametrize("rows", ["300,4.46\n", "500,7.6\n500,7.7\n500,7.8\n"])
def test_a_residual_that_is_rounding_is_printed_as_zero(rows: str, tmp_path: Path) -> None:
    """Of three depths at one velocity the mean is fitted, which is the second of these."""
    file = tmp_path / "mine.csv"
    file.write_text(f"v,x [um]\n{rows}", "utf-8")
    lines = coldspray("fit", file)[1].splitlines()
    fitted = lines[3] if rows.count("\n") == 1 else lines[4]
    assert fitted.split()[-1] == "0"


def test_columns_that_are_not_known_are_named(tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text("shot,v,x [um],size [um]\n1,500,7.6,20\n2,400,6.1,20\n", "utf-8")
    note = f"{file}: columns not used: 'shot', 'size [um]'"
    assert f"note: {note}" in " ".join(coldspray("fit", file)[1].split())
    assert json.loads(coldspray("fit", file, "--json")[1])["notes"] == [note]
    assert "note:" not in coldspray("fit", EXAMPLE)[1]
