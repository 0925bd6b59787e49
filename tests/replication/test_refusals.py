"""What the commands refuse: exit status 2, nothing on stdout, no file, and one line on stderr.

Each line says what was wrong, where, and what would be right.
"""

from pathlib import Path

import pytest
from running import promised

INPUTS = (
    "choose one of velocity, radius, particle_density, target_density, beta, flow_stress, "
    "resistance, step, stop_velocity"
)
NAMES = (
    "choose one of time, velocity_initial, depth, deceleration, velocity_final, velocity, radius, "
    "diameter, particle_density, target_density, mass, beta, flow_stress, resistance, step, "
    "stop_velocity"
)
COMMANDS = (
    "choose one of audit, claims, workbook, sheet, depth, crater, solve, fit, history, converge, "
    "stability, sweep, bench, check, diff, power"
)
SHEETS = (
    "the sheets are 'Overview', 'Inputs', 'Table A-1', 'Sheet beta 5', "
    "'Figures 3 and 5', 'Convergence', 'Crater', 'Resistance and Frank-Zook'"
)


def short(value: object) -> str:
    """Return the name of a case of a test: its arguments, cut off."""
    return " ".join(value)[:40] if isinstance(value, list) else ""


def refusal(folder: Path, arguments: list[str]) -> str:
    """Run a command, check that it refuses to do its work, and return what it says of it."""
    status, _, err = promised(folder, *arguments)
    assert status == 2
    command, said = f"coldspray {arguments[0]}: ", err.removesuffix("\n")
    assert said.startswith(command)
    return said.removeprefix(command)


def at(line: int | None, message: str) -> str:
    """Return the message on a line of `case.toml`, or on the file as a whole."""
    return f"case.toml: {message}" if line is None else f"case.toml, line {line}: {message}"


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["--"], "coldspray: there is no command '--': " + COMMANDS + " (see coldspray --help)"),
        (
            ["dept"],
            ("coldspray: there is no command 'dept': did you mean depth? (see coldspray --help)"),
        ),
        (
            ["--velocity", "3"],
            "coldspray: '--velocity' comes before a command: begin with that, such as depth "
            "(see coldspray --help)",
        ),
        (
            ["depth", "--velocity", "−5"],
            ("coldspray depth: --velocity is -5.0: it must be a finite number greater than zero"),
        ),
        (
            ["depth", "--speed", "3"],
            (
                "coldspray depth: unrecognized arguments: --speed 3; did you mean --case? "
                "(see coldspray depth --help)"
            ),
        ),
        (
            ["depth", "--"],
            "coldspray depth: unrecognized arguments: -- (see coldspray depth --help)",
        ),
        (
            ["--", "depth", "--"],
            "coldspray: there is no command '--': " + COMMANDS + " (see coldspray --help)",
        ),
        (
            ["depth", "--case-file=--"],
            "coldspray: '--case-file=--': two dashes are not a value (see coldspray --help)",
        ),
        (
            ["claims", "depth-beta-4"],
            (
                "coldspray claims: there is no claim 'depth-beta-4', and none prints that; did "
                "you mean depth-beta-5 or depth-beta-3 or depth-beta-5-beta?"
            ),
        ),
        (
            ["workbook", "--output=--"],
            "coldspray: '--output=--': two dashes are not a value (see coldspray --help)",
        ),
        (
            ["audit", "--out=--"],
            "coldspray: '--out=--': two dashes are not a value (see coldspray --help)",
        ),
        (
            [5000 * "c"],
            "coldspray: there is no command '"
            + 60 * "c"
            + "'...: "
            + COMMANDS
            + " (see coldspray --help)",
        ),
    ],
    ids=short,
)
def test_a_command_line_is_refused(arguments: list[str], line: str, hostile: Path) -> None:
    assert promised(hostile, *arguments) == (2, "", f"{line}\n")


@pytest.mark.parametrize("command", ["depth", "sweep"])
@pytest.mark.parametrize(
    "content",
    [
        3000 * "[a." + "b" + 3000 * "]",
        "velocity 450",
        "[inputs",
        "\0",
        '[impact]\nradius = "\\ud800"',
    ],
    ids=["nested", "no equals sign", "open bracket", "null", "surrogate"],
)
def test_what_is_no_toml_is_refused(command: str, content: str, hostile: Path) -> None:
    """The reason is that of Python's own parser, whose words depend on its version."""
    (hostile / "case.toml").write_text(content, "utf-8")
    file = ["--case-file", "case.toml"] if command == "depth" else ["case.toml", "-o", "out.csv"]
    assert refusal(hostile, [command, *file]).startswith("case.toml: is not a TOML file: ")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ["depth", "--case", "beta-4"],
            "there is no case 'beta-4': did you mean beta-5 or beta-3?",
        ),
        (["depth", "--case", ""], "there is no case '': choose one of beta-3, beta-5"),
        (["workbook", "--case", ""], "there is no case '': choose one of beta-3, beta-5"),
        (
            ["depth", "--velocity", "nan"],
            ("--velocity: 'nan' is not a finite number with or without a unit, such as '1 m/s'"),
        ),
        (
            ["depth", "--velocity=-inf"],
            ("--velocity: '-inf' is not a finite number with or without a unit, such as '1 m/s'"),
        ),
        (
            ["depth", "--velocity", "0"],
            "--velocity is 0.0: it must be a finite number greater than zero",
        ),
        (
            ["depth", "--radius=-1 um"],
            "--radius is -1e-06: it must be a finite number greater than zero",
        ),
        (
            ["depth", "--radius", "eleven"],
            ("--radius: 'eleven' is not a finite number with or without a unit, such as '1 m'"),
        ),
        (["depth", "--radius", "11 MPa"], "--radius: '11 MPa': MPa does not measure what m does"),
        (
            ["depth", "--radius", "11 parsnips"],
            ("--radius: unknown unit 'parsnips': take one such as um, ns, m/s, kg/m^3, MPa or ksi"),
        ),
        (
            ["depth", "--radius", "-3 dBm"],
            "--radius: unknown unit 'dBm': take one such as um, ns, m/s, kg/m^3, MPa or ksi",
        ),
        (
            ["depth", "--radius", "1e999999999 um"],
            (
                "--radius: '1e999999999 um' is not a finite number with or without a unit, "
                "such as '1 m'"
            ),
        ),
        (
            ["depth", "--velocity", "500,5"],
            (
                "--velocity: '500,5': write a decimal comma as a point, and thousands without "
                "a comma"
            ),
        ),
        (["depth", "--beta", "5 m"], "--beta: '5 m': give no unit"),
        (["depth", "--beta", "0"], "--beta is 0.0: it must be a finite number greater than zero"),
        (
            ["depth", "--particle-density=-8900"],
            "--particle-density is -8900.0: it must be a finite number greater than zero",
        ),
        (
            ["depth", "--target-density", "0 g/cm^3"],
            "--target-density is 0.0: it must be a finite number greater than zero",
        ),
        (
            ["depth", "--flow-stress", "0"],
            "--flow-stress is 0.0: it must be a finite number greater than zero",
        ),
        (["depth", "--step", "0"], "--step is 0.0: it must be a finite number greater than zero"),
        (
            ["depth", "--stop-velocity=-1"],
            "--stop-velocity is -1.0: it must be a finite number, zero or more",
        ),
        (
            ["depth", "--resistance", "0"],
            "--resistance is 0.0: nothing would bring the particle to rest",
        ),
        (
            ["depth", "--resistance", "1e9", "--beta", "3"],
            (
                "--resistance stands instead of --beta and --flow-stress: give it or those "
                "two, not both"
            ),
        ),
        (
            ["depth", "--beta", "1e300", "--flow-stress", "1e300"],
            "target resistance is inf: doubles carry 1e-250 to 1e250 safely",
        ),
        (["depth", "--radius", "1e150"], "particle mass is inf: it must be a number above zero"),
        (["depth", "--radius", "1e-150"], "particle mass is 0.0: it must be a number above zero"),
        (
            [
                "depth",
                "--velocity",
                "1e100",
                "--particle-density",
                "1e100",
                "--target-density",
                "1",
                "--beta",
                "1",
                "--flow-stress",
                "1",
                "--radius",
                "1e-50",
            ],
            "kinetic energy density over target resistance is 5e+299: doubles carry 1e-250 to "
            "1e250 safely",
        ),
        (["depth", "--case-file", "absent.toml"], "absent.toml: No such file or directory"),
        (["depth", "--case-file", "."], ".: Is a directory"),
        (["depth", "--case-file", "/dev/zero"], "/dev/zero is a device, not a file"),
        (["depth", "--case-file", "loop.toml"], "loop.toml: Too many levels of symbolic links"),
        (["depth", "--case-file", "deep.toml"], "deep.toml: is nested too deep"),
        (["depth", "--case-file", "large.toml"], "large.toml is larger than 1,048,576 bytes"),
        (
            ["depth", "--case-file", "binary.toml"],
            "binary.toml: is not a TOML file: it is not UTF-8 text",
        ),
    ],
    ids=short,
)
def test_an_input_is_refused(arguments: list[str], message: str, hostile: Path) -> None:
    assert refusal(hostile, arguments) == message


@pytest.mark.parametrize(
    ("content", "line", "message"),
    [
        ("[impact]\nradius = " + 5000 * "9", None, "holds a whole number of more than 4300 digits"),
        ("velocity = 450", 1, "'velocity' is not a table: begin with a line [impact]"),
        ("[impact]\n[more]", 2, "there is no 'more' here: choose one of impact"),
        (
            "[impact]\nvelocty = 450",
            2,
            "there is no 'velocty' here: did you mean velocity or stop_velocity?",
        ),
        (
            '[impact]\nradius = "x"',
            2,
            "radius: 'x' is not a finite number with or without a unit, such as '1 m'",
        ),
        (
            "[impact]\nradius = [1]",
            2,
            "radius: '[1]' is not a finite number with or without a unit, such as '1 m'",
        ),
        (
            "[impact]\nradius = -1.0",
            2,
            "radius is -1.0: it must be a finite number greater than zero",
        ),
        (
            "[impact]\nradius = nan",
            2,
            "radius: 'nan' is not a finite number with or without a unit, such as '1 m'",
        ),
        (
            "[impact]\nradius = 1e99999999999",
            2,
            "radius: 'inf' is not a finite number with or without a unit, such as '1 m'",
        ),
        ("[impact]\nradius = " + 500 * "{a=" + "1" + 500 * "}", None, "is nested too deep"),
        ('[impact]\n"\\u001b[31m" = 1', 2, "there is no '\\x1b[31m' here: " + INPUTS),
        (
            "[impact]\n" + 5000 * "k" + " = 1",
            2,
            "there is no '" + 60 * "k" + "'... here: " + INPUTS,
        ),
    ],
    ids=short,
)
def test_a_case_file_is_refused(
    content: str, line: int | None, message: str, hostile: Path
) -> None:
    (hostile / "case.toml").write_text(content, "utf-8")
    assert refusal(hostile, ["depth", "--case-file", "case.toml"]) == at(line, message)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ["sheet", "--velocity", "nan"],
            ("--velocity: 'nan' is not a finite number with or without a unit, such as '1 m/s'"),
        ),
        (
            ["sheet", "--step", "1e-18"],
            (
                "the sheet takes more than 1,000,000 steps of 1e-18 s down to 1.0 m/s: take a "
                "larger step"
            ),
        ),
        (
            ["sheet", "--radius", "11"],
            (
                "the sheet takes more than 1,000,000 steps of 2e-10 s down to 1.0 m/s: take a "
                "larger step; --radius is 11 m: from 1e-09 to 1 m is expected; did you mean "
                '"11 um"?'
            ),
        ),
        (
            ["sheet", "--step", "1.8e308"],
            "--step: '1.8e308' is not a finite number that a double can hold",
        ),
        (
            ["sheet", "--scheme", "upwind"],
            (
                "argument --scheme: there is no scheme 'upwind': choose one of published, "
                "centered (see coldspray sheet --help)"
            ),
        ),
        (
            ["sheet", "--csv", "--json"],
            "argument --json: not allowed with argument --csv (see coldspray sheet --help)",
        ),
        (
            ["history", "--points", "1"],
            (
                "argument --points: give a whole number from 2 to 1,000,000, not '1' (see "
                "coldspray history --help)"
            ),
        ),
        (
            ["history", "--times", "0,-1 ns"],
            "--times, value 2: '-1 ns' is negative: give a time of zero or more",
        ),
        (
            ["depth", "--models", "--model", "rigid"],
            "argument --model: not allowed with argument --models (see coldspray depth --help)",
        ),
        (
            ["history", "--times", "0,5,10 ns"],
            "--times: '5' has no unit, and others have one: write \"0 ns,5 ns,10 ns\"",
        ),
        (
            ["converge", "--steps", "0.4 ns, 0.2"],
            "--steps: '0.2' has no unit, and others have one: write \"0.4 ns,0.2 ns\"",
        ),
        (
            ["history", "--times", "soon"],
            (
                "--times, value 1: 'soon' is not a finite number with or without a unit, such "
                "as '1 s'"
            ),
        ),
        (
            ["history", "--times", "0,,1"],
            ("--times, value 2: '' is not a finite number with or without a unit, such as '1 s'"),
        ),
        (
            ["history", "--times", "inf"],
            (
                "--times, value 1: 'inf' is not a finite number with or without a unit, such "
                "as '1 s'"
            ),
        ),
        (["history", "--times", "1e300"], "--times, value 1: '1e300' is not between 0 and 1e250 s"),
        (
            ["history", "--times", "1e999 s"],
            "--times, value 1: '1e999 s' is not a finite number that a double can hold",
        ),
        (
            ["history", "--json", "--csv"],
            ("argument --csv: not allowed with argument --json (see coldspray history --help)"),
        ),
        (
            ["history", "--points", "3", "--times", "0"],
            ("argument --times: not allowed with argument --points (see coldspray history --help)"),
        ),
    ],
    ids=short,
)
def test_options_of_sheet_and_history_are_refused(
    arguments: list[str], message: str, hostile: Path
) -> None:
    assert refusal(hostile, arguments) == message


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ["converge", "--scheme", "upwind"],
            (
                "argument --scheme: there is no scheme 'upwind': choose one of published, "
                "centered (see coldspray converge --help)"
            ),
        ),
        (
            ["converge", "--steps", "1 ns"],
            "convergence needs two steps or more, each shorter than the one before",
        ),
        (
            ["converge", "--steps", "1 ns,1 ns"],
            "convergence needs two steps or more, each shorter than the one before",
        ),
        (
            ["converge", "--steps", "1 ns,2 ns"],
            "convergence needs two steps or more, each shorter than the one before",
        ),
        (
            [
                "converge",
                "--steps",
                "41,40,39,38,37,36,35,34,33,32,31,30,29,28,27,26,25,24,23,22,21,20,19,18,17,16,15,14,13,12,11,10,9,8,7,6,5,4,3,2,1",
            ],
            "--steps: give at most 40 values, not 41",
        ),
        (
            ["converge", "--steps", "1 ns,x"],
            ("--steps, value 2: 'x' is not a finite number with or without a unit, such as '1 s'"),
        ),
        (
            ["converge", "--levels", "1"],
            (
                "argument --levels: give a whole number from 2 to 40, not '1' (see coldspray "
                "converge --help)"
            ),
        ),
        (
            ["converge", "--digits", "0"],
            (
                "argument --digits: give a whole number from 1 to 15, not '0' (see coldspray "
                "converge --help)"
            ),
        ),
        (
            ["converge", "--digits", "6"],
            (
                "no refinement gives 6 digits: stopping at 1.0 m/s alone leaves out 2.05e-11 "
                "m, more than 5e-12 m; lower the stop velocity"
            ),
        ),
        (
            ["converge", "--digits", "9", "--stop-velocity", "0"],
            "9 digits need more than 1,000,000 steps",
        ),
        (
            ["converge", "--digits", "15", "--step", "1e-300"],
            "--step is 1e-300: doubles carry 1e-250 to 1e250 safely",
        ),
        (["converge", "--step", "1e308"], "--step is 1e+308: doubles carry 1e-250 to 1e250 safely"),
        (
            ["converge", "--levels", "40", "--step", "1e-18"],
            (
                "the sheet takes more than 1,000,000 steps of 1.6e-17 s down to 1.0 m/s: take "
                "a larger step"
            ),
        ),
        (
            ["stability", "--random", "0"],
            (
                "argument --random: give a whole number from 1 to 10,000,000, not '0' (see "
                "coldspray stability --help)"
            ),
        ),
        (
            ["stability", "--seed", "-1"],
            (
                "argument --seed: give a whole number from 0 to 9,223,372,036,854,775,808, not "
                "'-1' (see coldspray stability --help)"
            ),
        ),
        (
            ["power", "--seed", "18446744073709551616"],
            (
                "argument --seed: give a whole number from 0 to 18,446,744,073,709,551,615, "
                "not '18446744073709551616' (see coldspray power --help)"
            ),
        ),
        (
            ["bench", "--repeat", "-1"],
            (
                "argument --repeat: give a whole number from 1 to 10,000, not '-1' (see "
                "coldspray bench --help)"
            ),
        ),
        (
            ["bench", "--case", "beta-4"],
            "there is no case 'beta-4' to time: did you mean beta-5 or beta-3?",
        ),
        (["bench", "--quick", "--limit=-1 s"], "a limit of -1 s: it must be greater than zero"),
        (["bench", "--limit", "3 m"], "--limit: '3 m': m does not measure what s does"),
        (
            ["bench", "--json", "--csv"],
            "argument --csv: not allowed with argument --json (see coldspray bench --help)",
        ),
        (
            ["bench", "--limit", "inf"],
            "--limit: 'inf' is not a finite number with or without a unit, such as '1 s'",
        ),
        (
            ["bench", "--quick", "--limit", "1e99999"],
            ("--limit: '1e99999' is not a finite number with or without a unit, such as '1 s'"),
        ),
        (
            ["bench", "--quick", "--limit", "nan"],
            "--limit: 'nan' is not a finite number with or without a unit, such as '1 s'",
        ),
    ],
    ids=short,
)
def test_options_of_what_measures_are_refused(
    arguments: list[str], message: str, hostile: Path
) -> None:
    assert refusal(hostile, arguments) == message


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["workbook", "--step", "1 ns", "--rows", "20"], "20 rows will not do: give 26 to 20,000"),
        (
            ["workbook", "--step", "1 ns", "--rows", "20001"],
            "20,001 rows will not do: give 26 to 20,000",
        ),
        (
            ["workbook", "--velocity", "0.5", "--rows", "0"],
            (
                "argument --rows: give a whole number from 1 to 1,048,576, not '0' (see "
                "coldspray workbook --help)"
            ),
        ),
        (
            ["workbook", "--step", "0.001 ns"],
            "the workbook would need 26,039 rows, more than 20,000: take a larger step",
        ),
        (
            ["workbook", "--step", "1 ns", "--scheme", "best"],
            (
                "argument --scheme: there is no scheme 'best': choose one of published, "
                "centered (see coldspray workbook --help)"
            ),
        ),
        (
            ["workbook", "--resistance", "1", "--step", "1 ns"],
            (
                "the workbook takes 100,000 to 1e+15 Pa for the target resistance, given "
                "instead of β and Y_t, not 1.0"
            ),
        ),
        (
            ["workbook", "--radius", "2"],
            ("the workbook takes 0.0001 to 1,000,000 um for the particle radius R, not 2000000.0"),
        ),
        (
            ["workbook", "--step", "1e-20"],
            "the workbook takes 1e-06 to 1,000,000 ns for the time step, not 1e-11",
        ),
        (
            ["workbook", "--beta", "1e25"],
            (
                "the workbook takes 0.0001 to 10,000 for the target resistance over flow "
                "stress, Sheet beta 1e+25, not 1e+25"
            ),
        ),
        (
            ["workbook", "--velocity", "1e7"],
            ("the workbook takes 1e-06 to 1,000,000 m/s for the impact velocity, not 10000000.0"),
        ),
        (
            ["workbook", "--step", "1 ns", "-o", "own.ods"],
            "own.ods: a workbook's name ends in .xlsx",
        ),
        (["workbook", "--step", "1 ns", "-o", "."], ".: this is a folder; give a file"),
        (
            ["workbook", "--step", "1 ns", "-o", "absent/workbook.xlsx"],
            "absent: the folder to write to does not exist",
        ),
        (
            ["workbook", "--step", "1 ns", "-o", "loop.xlsx"],
            "loop.xlsx: Too many levels of symbolic links",
        ),
        (
            ["workbook", "--step", "1 ns", "-o", "/dev/full"],
            "/dev/full: this is not a regular file",
        ),
        (["audit", "--out", "empty.toml"], "empty.toml: this is not a folder; give a folder"),
        (["audit", "--out", "loop"], "loop: this is not a folder; give a folder"),
        (["audit", "--out", "/dev/full"], "/dev/full: this is not a folder; give a folder"),
        (
            ["audit", "--out", ""],
            "argument --out: give a path, not '' (see coldspray audit --help)",
        ),
    ],
    ids=short,
)
def test_what_cannot_be_a_workbook_is_not_written(
    arguments: list[str], message: str, hostile: Path
) -> None:
    assert refusal(hostile, arguments) == message


@pytest.mark.parametrize(
    ("content", "line", "message"),
    [
        ("velocity = 500", 1, "'velocity' is not a table: begin with a line [inputs]"),
        ("[sweep]", None, "'inputs' is missing"),
        ("[input]", 1, "there is no 'input' here: did you mean inputs?"),
        (
            "[inputs]\nvelocty = 5",
            2,
            "[inputs]: there is no 'velocty' here: did you mean velocity or stop_velocity?",
        ),
        ("[inputs]\nradius = '5 s'", 2, "[inputs]: radius: '5 s': s does not measure what m does"),
        ("[inputs]\nradius = []", 2, "[inputs]: radius: the list is empty: give one value or more"),
        (
            "[inputs]\nradius = 2020-01-01",
            2,
            (
                "[inputs]: radius: '2020-01-01' is not a finite number with or without a unit, "
                "such as '1 m'"
            ),
        ),
        (
            "[inputs]\nradius = {from = 1, to = 2, points = 3.0}",
            2,
            (
                "[inputs]: radius: points is 3.0: it must be a whole number from 2 to "
                "10,000,000, without point or exponent"
            ),
        ),
        (
            "[inputs]\nradius = -1",
            2,
            "[inputs]: radius is -1.0: it must be a finite number greater than zero",
        ),
        (
            "[inputs]\nradius = {points = 3}",
            2,
            (
                "[inputs]: radius: give from, to and points; or distribution; or, by Eq. 1, "
                "average_mass"
            ),
        ),
        ("[inputs]\nradius = {from = 1, to = 2}", 2, "[inputs]: radius: 'points' is missing"),
        (
            "[inputs]\nradius = {from = 1, to = 2, points = 2, step = 1}",
            2,
            ("[inputs]: radius: there is no 'step' here: choose one of from, to, points, scale"),
        ),
        (
            "[inputs]\nradius = {from = 1, to = inf, points = 2}",
            2,
            (
                "[inputs]: radius: to: 'inf' is not a finite number with or without a unit, "
                "such as '1 m'"
            ),
        ),
        (
            "[inputs]\nstop_velocity = {from = 0, to = 2, points = 2, scale = 'log'}",
            2,
            "[inputs]: stop_velocity: a log scale needs from and to greater than zero",
        ),
        (
            "[inputs]\nradius = {from = 1, to = 2, points = 2, scale = 'ln'}",
            2,
            "[inputs]: radius: there is no scale 'ln': choose one of linear, log",
        ),
        (
            "[inputs]\nradius = {average_mass = 1}",
            2,
            "[inputs]: radius: only the velocity follows from the mass, by Eq. 1",
        ),
        (
            "[inputs]\nvelocity = {average_mass = 0, average_velocity = 1}",
            2,
            (
                "[inputs]: velocity: average_mass is 0.0: it must be a finite number greater "
                "than zero"
            ),
        ),
        (
            "[inputs]\nradius = 1e-110\nvelocity = {average_mass = 1, average_velocity = 1}",
            None,
            "velocity is inf: it must be a finite number greater than zero",
        ),
        (
            "[inputs]\nbeta = 3\nresistance = 1e9",
            None,
            "resistance is beta times flow_stress: give it or those two, not both",
        ),
        (
            "[inputs]\nresistance = [0, 1e9]",
            2,
            "[inputs]: target resistance is 0.0: nothing would bring the particle to rest",
        ),
        (
            "[inputs]\nradius = [1e-6, 1e110]",
            None,
            "particle mass is inf: it must be a number above zero (with radius 1e+110)",
        ),
        (
            "[sweep]\nmode = 'grid'\n[inputs]",
            2,
            (
                "[sweep]: there is no 'mode' here: choose one of case, samples, seed, scheme, "
                "outputs"
            ),
        ),
        (
            "[sweep]\ncase = 'beta-4'\n[inputs]",
            2,
            "[sweep]: there is no case 'beta-4': did you mean beta-5 or beta-3?",
        ),
        (
            "[sweep]\noutputs = ['depth']\n[inputs]",
            2,
            (
                "[sweep]: outputs must be a list of stop_time, sheet_depth, sheet_steps; the "
                "depths always come"
            ),
        ),
        (
            "[sweep]\noutputs = [[]]\n[inputs]",
            2,
            (
                "[sweep]: outputs must be a list of stop_time, sheet_depth, sheet_steps; the "
                "depths always come"
            ),
        ),
        (
            "[sweep]\nsamples = 3\n[inputs]",
            2,
            "[sweep]: samples is for distributions, and no input has one",
        ),
        (
            "[sweep]\nsamples = 10\n[inputs]\nradius = {distribution = 'gamma'}",
            4,
            (
                "[inputs]: radius: there is no distribution 'gamma': choose one of normal, "
                "lognormal, uniform, loguniform"
            ),
        ),
        (
            "[sweep]\nsamples = 10\n[inputs]\nradius = {distribution = 'normal', mean = 1}",
            4,
            "[inputs]: radius: 'deviation' is missing",
        ),
        (
            (
                "[sweep]\nsamples = 10\n[inputs]\nradius = {distribution = 'normal', mean = 1, "
                "deviation = 0}"
            ),
            4,
            "[inputs]: radius: deviation must be greater than zero",
        ),
        (
            (
                "[sweep]\nsamples = 10\n[inputs]\nradius = {distribution = 'normal', mean = 1, "
                "deviation = 1}"
            ),
            4,
            "[inputs]: radius: values down to -7.21 would be drawn: give a lower end",
        ),
        (
            (
                "[sweep]\nsamples = 10\n[inputs]\nradius = {distribution = 'uniform', lower = 2, "
                "upper = 1}"
            ),
            4,
            "[inputs]: radius: lower must be less than upper",
        ),
        (
            (
                "[sweep]\nsamples = 10\n[inputs]\nradius = {distribution = 'normal', mean = 1, "
                "deviation = 1, lower = 9}"
            ),
            4,
            (
                "[inputs]: radius: less than a millionth of the distribution is between lower "
                "and upper"
            ),
        ),
        (
            (
                "[sweep]\nsamples = 10\n[inputs]\nradius = {distribution = 'lognormal', mean = 1, "
                "deviation = 1e300}"
            ),
            4,
            "[inputs]: radius is nan: it must be a finite number greater than zero",
        ),
        (
            (
                "[sweep]\nsamples = 10\n[inputs]\nradius = {distribution = 'lognormal', mean = 1, "
                "deviation = 1e-300}"
            ),
            4,
            "[inputs]: radius: cdf() not defined when sigma is zero",
        ),
        (
            (
                "[sweep]\nsamples = 10\n[inputs]\nradius = {distribution = 'loguniform', lower = "
                "0, upper = 1}"
            ),
            4,
            "[inputs]: radius: lower must be greater than zero",
        ),
        (
            "[inputs]\nradius = {distribution = 'uniform', lower = 1, upper = 2}",
            None,
            "[sweep]: samples is missing: how many cases to draw",
        ),
        (
            (
                "[sweep]\nsamples = 0\n[inputs]\nradius = {distribution = 'uniform', lower = 1, "
                "upper = 2}"
            ),
            2,
            (
                "[sweep]: samples is 0: it must be a whole number from 1 to 1,000,000,000,000, "
                "without point or exponent"
            ),
        ),
        (
            (
                "[sweep]\nsamples = 9\nseed = -1\n[inputs]\nradius = {distribution = 'uniform', "
                "lower = 1, upper = 2}"
            ),
            3,
            (
                "[sweep]: seed is -1: it must be a whole number from 0 to "
                "18,446,744,073,709,551,615, without point or exponent"
            ),
        ),
        (
            '[sweep]\noutputs = ["sheet_depth"]\n[inputs]\nstep = [1e-9, 1e-10, 1e-15]',
            None,
            (
                "the sheet of case 2 (velocity 500.0, radius 1.1e-05, particle_density 8900.0, "
                "target_density 7850.0, beta 5.0, flow_stress 700000000.0, resistance "
                "3500000000.0, step 1e-15, stop_velocity 1.0) takes more than 1,000,000 steps "
                "of 1e-15 s down to 1.0 m/s: take a larger step"
            ),
        ),
        ("[impact]\nradius = " + 500 * "{a=" + "1" + 500 * "}", None, "is nested too deep"),
        ("[impact]\nradius = " + 5000 * "9", None, "holds a whole number of more than 4300 digits"),
        (
            "[inputs]\nradius = {from=1e-6, to=2e-6, points=0x" + 5000 * "f" + "}",
            2,
            "[inputs]: radius: points is 0x"
            + 58 * "f"
            + ("...: it must be a whole number from 2 to 10,000,000, without point or exponent"),
        ),
        (
            (
                "[sweep]\nsamples = 9223372036854775807\n[inputs]\nradius = "
                '{distribution="uniform", lower=1e-6, upper=2e-6}'
            ),
            2,
            (
                "[sweep]: samples is 9223372036854775807: it must be a whole number from 1 to "
                "1,000,000,000,000, without point or exponent"
            ),
        ),
        (
            '[sweep]\ncase = "' + 5000 * "c" + '"\n[inputs]',
            2,
            "[sweep]: there is no case '" + 60 * "c" + "'...: choose one of beta-3, beta-5",
        ),
        (
            '[sweep]\nsamples = 1\n[inputs]\nradius = {distribution="' + 5000 * "n" + '"}',
            4,
            "[inputs]: radius: there is no distribution '"
            + 60 * "n"
            + "'...: choose one of normal, lognormal, uniform, loguniform",
        ),
        (
            '[sweep]\noutputs = ["\\u0007"]\n[inputs]\nradius = 1e-6',
            2,
            (
                "[sweep]: outputs must be a list of stop_time, sheet_depth, sheet_steps; the "
                "depths always come"
            ),
        ),
        (
            "[inputs]\n" + 5000 * "k" + " = 1",
            2,
            "[inputs]: there is no '" + 60 * "k" + "'... here: " + INPUTS,
        ),
        (
            '[inputs]\nradius = {from=1e-300, to=1e300, points=3, scale="log"}',
            None,
            "particle mass is 0.0: it must be a number above zero (with radius 1e-300)",
        ),
    ],
    ids=short,
)
def test_a_plan_is_refused(content: str, line: int | None, message: str, hostile: Path) -> None:
    (hostile / "case.toml").write_text(content, "utf-8")
    assert refusal(hostile, ["sweep", "case.toml", "-o", "out.csv"]) == at(line, message)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["sweep", "plan.csv"], "plan.csv is the plan itself: give another -o"),
        (["sweep", "."], ".: Is a directory"),
        (["sweep", "absent.toml"], "absent.toml: No such file or directory"),
        (["sweep", "/dev/zero"], "/dev/zero is a device, not a file"),
        (["sweep", "empty.toml", "-o", "loop.xlsx"], "empty.toml: 'inputs' is missing"),
    ],
    ids=short,
)
def test_files_of_a_sweep_are_refused(arguments: list[str], message: str, hostile: Path) -> None:
    assert refusal(hostile, arguments) == message


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["sweep", "deep.toml", "-o", "out.csv"], "deep.toml: is nested too deep"),
        (["depth", "--case-file", "empty.toml"], "empty.toml: 'impact' is missing"),
        (["sweep", "empty.toml", "-o", "out.csv"], "empty.toml: 'inputs' is missing"),
        (["sweep", "large.toml", "-o", "out.csv"], "large.toml is larger than 1,048,576 bytes"),
        (["sweep", "loop.toml", "-o", "out.csv"], "loop.toml: Too many levels of symbolic links"),
        (["sweep", ".", "-o", "out.csv"], ".: Is a directory"),
        (["depth", "--case-file", "pipe.csv/x"], "pipe.csv/x: Not a directory"),
        (["sweep", "pipe.csv/x", "-o", "out.csv"], "pipe.csv/x: Not a directory"),
    ],
    ids=short,
)
def test_a_file_that_once_broke_it_is_refused(
    arguments: list[str], message: str, hostile: Path
) -> None:
    assert refusal(hostile, arguments) == message


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ["depth", "--radius", "5 " + 100000 * "a"],
            "--radius: '5 "
            + 38 * "a"
            + ("'... is not a finite number with or without a unit, such as '1 m'"),
        ),
        (
            ["depth", "--radius", "1 m" + 3000 * "^2"],
            (
                "--radius: '1 m^2^2^2^2^2^2^2^2^2^2^2^2^2^2^2^2^2^2^'... is not a finite "
                "number with or without a unit, such as '1 m'"
            ),
        ),
        (
            ["depth", "--radius", "1" + 400 * "0" + " um"],
            "--radius: '1"
            + 39 * "0"
            + ("'... is not a finite number with or without a unit, such as '1 m'"),
        ),
        (
            ["depth", "--velocity", 10 * "１" + "e３０９"],
            "--velocity: '" + 10 * "１" + "e３０９' is not a finite number that a double can hold",
        ),
        (
            ["depth", "--radius", "\ud800"],
            ("--radius: '\\ud800' is not a finite number with or without a unit, such as '1 m'"),
        ),
        (
            ["converge", "--digits", "1" + 400 * "0"],
            "argument --digits: give a whole number from 1 to 15, not '1"
            + 59 * "0"
            + "'... (see coldspray converge --help)",
        ),
        (["converge", "--steps", 5000 * "1,"], "--steps: give at most 40 values, not 5,001"),
        (
            ["workbook", "--rows", "1" + 400 * "0"],
            ("argument --rows: give a whole number from 1 to 1,048,576, not '1")
            + 59 * "0"
            + "'... (see coldspray workbook --help)",
        ),
        (
            ["audit", "--out", "/proc/coldspray"],
            "/proc/coldspray: this folder cannot be created: No such file or directory",
        ),
        (
            ["audit", "--out", "a\x00b"],
            "argument --out: give a path, not 'a\\x00b' (see coldspray audit --help)",
        ),
        (
            ["depth", "--\x1b[31m"],
            "unrecognized arguments: --\\x1b[31m (see coldspray depth --help)",
        ),
        (
            ["depth", "--radius", "\x1b[31m"],
            ("--radius: '\\x1b[31m' is not a finite number with or without a unit, such as '1 m'"),
        ),
        (
            ["sheet", "--beta", "1e-200", "--flow-stress", "1e-200"],
            "target resistance is 0.0: doubles carry 1e-250 to 1e250 safely",
        ),
        (
            ["depth", "--case", "a\nb\r\x07"],
            "there is no case 'a\\nb\\r\\x07': choose one of beta-3, beta-5",
        ),
        (
            ["claims", 100000 * "x"],
            "there is no claim '"
            + 60 * "x"
            + "'..., and none prints that; `coldspray claims` lists them",
        ),
        (
            ["sheet", "--scheme", "\x1b\n" + 5000 * "s"],
            "argument --scheme: there is no scheme '\\x1b\\n"
            + 58 * "s"
            + ("'...: choose one of published, centered (see coldspray sheet --help)"),
        ),
        (
            ["bench", "--case", "\x1b\n" + 5000 * "s"],
            "there is no case '\\x1b\\n"
            + 58 * "s"
            + ("'... to time: choose one of beta-5, beta-3, crossing, shallow, hypervelocity"),
        ),
        (
            ["workbook", "-o", 5000 * "n" + ".xlsx"],
            168 * "n" + "..." + 144 * "n" + ".xlsx: File name too long",
        ),
        (
            ["audit", "--out", 5000 * "n"],
            168 * "n" + "..." + 149 * "n" + ": File name too long",
        ),
        (["sweep", "\u202e\x1b[31m.toml"], "\\u202e\\x1b[31m.toml: No such file or directory"),
        (
            ["depth", *5000 * ["x"]],
            "unrecognized arguments:"
            + 72 * " x"
            + " ..."
            + 85 * "x "
            + "(see coldspray depth --help)",
        ),
    ],
    ids=short,
)
def test_a_text_that_once_broke_it_is_refused(
    arguments: list[str], message: str, hostile: Path
) -> None:
    assert refusal(hostile, arguments) == message


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ["check", "empty.toml"],
            ("empty.toml: this is not a workbook; give an .xlsx or .xlsm file without a password"),
        ),
        (
            ["check", "deep.toml"],
            ("deep.toml: this is not a workbook; give an .xlsx or .xlsm file without a password"),
        ),
        (
            ["check", "zero.xlsx"],
            ("zero.xlsx: this is not a workbook; give an .xlsx or .xlsm file without a password"),
        ),
        (
            ["check", "cut.xlsx"],
            (
                "cut.xlsx: is damaged: its end is cut off or changed; a spreadsheet program "
                "may be able to repair it"
            ),
        ),
        (
            ["check", "bomb.xlsx"],
            (
                "bomb.xlsx: is refused: a tag, comment or blank of its part "
                "xl/worksheets/sheet1.xml has more than 1 MB"
            ),
        ),
        (
            ["check", "nothing.xlsx"],
            (
                "nothing.xlsx: this is not a workbook; give an .xlsx or .xlsm file without a "
                "password"
            ),
        ),
        (
            ["check", "entity.xlsx"],
            ("entity.xlsx: is refused: its XML declares a document type, which no workbook needs"),
        ),
        (
            ["check", "deep.xlsx"],
            (
                "deep.xlsx: is damaged: its XML is nested more than 100 levels deep; a "
                "spreadsheet program may be able to repair it"
            ),
        ),
        (["check", "loop.xlsx"], "loop.xlsx: this link leads nowhere"),
        (["check", "."], ".: this is a folder"),
        (["check", "absent.xlsx"], "absent.xlsx: there is no such file"),
        (["check", "/dev/zero"], "/dev/zero: this is not a regular file"),
        (["check", "/dev/full"], "/dev/full: this is not a regular file"),
        (["check", 5000 * "n"], 168 * "n" + "..." + 149 * "n" + ": File name too long"),
        (["check", "pipe.csv/x"], "pipe.csv/x: there is no such file"),
        (["check", "\x1b[31m\n.xlsx"], "\\x1b[31m .xlsx: there is no such file"),
        (["check", "own.xlsx", "--map", ""], "--map '': give NAME=RANGE, such as depth=D8:D139"),
        (["check", "own.xlsx", "--map", "="], "--map '=': give NAME=RANGE, such as depth=D8:D139"),
        (
            ["check", "own.xlsx", "--map", "depth"],
            "--map 'depth': give NAME=RANGE, such as depth=D8:D139",
        ),
        (
            ["check", "own.xlsx", "--map", "depth="],
            "--map 'depth=': give NAME=RANGE, such as depth=D8:D139",
        ),
        (
            ["check", "own.xlsx", "--map", "depth=\x1b[31m"],
            "own.xlsx: --map depth=\\x1b[31m: give a range such as Sheet1!D8:D139; " + SHEETS,
        ),
        (
            ["check", "own.xlsx", "--map", "depth=A1:A" + 5000 * "9"],
            "own.xlsx: --map depth=A1:A"
            + 56 * "9"
            + ": give a range such as Sheet1!D8:D139; "
            + SHEETS,
        ),
        (
            ["check", "own.xlsx", "--map", "depth=A1:A1048577"],
            "own.xlsx: --map depth=A1:A1048577: give a range such as Sheet1!D8:D139; " + SHEETS,
        ),
        (
            ["check", "own.xlsx", "--map", "depth=" + 5000 * "A" + "1"],
            "own.xlsx: --map depth="
            + 60 * "A"
            + ": give a range such as Sheet1!D8:D139; "
            + SHEETS,
        ),
        (
            ["check", "own.xlsx", "--map", "x\n=B4"],
            "own.xlsx: --map 'x' is not a known name; " + NAMES,
        ),
        (
            ["check", "own.xlsx", "--map", "depht=B4"],
            "own.xlsx: --map 'depht' is not a known name; did you mean depth?",
        ),
        (
            ["check", "own.xlsx", "--map", 5000 * "k" + "=B4"],
            "own.xlsx: --map '" + 40 * "k" + "' is not a known name; " + NAMES,
        ),
        (
            ["check", "own.xlsx", "--map", "radius='no such'!B4"],
            "own.xlsx: --map radius='no such'!B4: give a range such as Sheet1!D8:D139; " + SHEETS,
        ),
        (
            ["check", "own.xlsx", "--map", "radius=B4:B3:B2"],
            "own.xlsx: --map radius=B4:B3:B2: give a range such as Sheet1!D8:D139; " + SHEETS,
        ),
        (
            ["check", "own.xlsx", "--map", "depth=D0:D9"],
            "own.xlsx: --map depth=D0:D9: give a range such as Sheet1!D8:D139; " + SHEETS,
        ),
        (
            ["check", "own.xlsx", "--html", "loop.xlsx"],
            "loop.xlsx: Too many levels of symbolic links",
        ),
        (["check", "own.xlsx", "--junit", "/dev/full"], "/dev/full: this is not a regular file"),
        (
            ["check", "own.xlsx", "--html", "x", "--junit", "x"],
            "--html and --junit each need a file of their own, not one that is read",
        ),
        (
            ["check", "own.xlsx", "--html", "absent/x"],
            "absent: the folder to write to does not exist",
        ),
        (["check", "--map"], "argument --map: expected one argument (see coldspray check --help)"),
        (
            ["diff", "own.xlsx", "cut.xlsx"],
            (
                "cut.xlsx: is damaged: its end is cut off or changed; a spreadsheet program "
                "may be able to repair it"
            ),
        ),
        (
            ["diff", "bomb.xlsx", "own.xlsx"],
            (
                "bomb.xlsx: is refused: a tag, comment or blank of its part "
                "xl/worksheets/sheet1.xml has more than 1 MB"
            ),
        ),
        (
            ["diff", "own.xlsx", "own.xlsx", "--relative", "nan"],
            (
                "argument --relative: give a number from 0 to 1, not 'nan' (see coldspray diff "
                "--help)"
            ),
        ),
        (
            ["diff", "own.xlsx", "own.xlsx", "--ulp", "1" + 400 * "0"],
            ("argument --ulp: give a whole number from 0 to 1,000,000,000, not '1")
            + 59 * "0"
            + "'... (see coldspray diff --help)",
        ),
        (
            ["diff", "own.xlsx", "own.xlsx", "--digits", "-1"],
            (
                "argument --digits: give a whole number from 1 to 17, not '-1' (see coldspray "
                "diff --help)"
            ),
        ),
        (
            ["diff", "own.xlsx"],
            "the following arguments are required: B.xlsx (see coldspray diff --help)",
        ),
        (
            ["check", "own.xlsx", "--html", "absent/page.html", "--junit", "a.xml"],
            "absent: the folder to write to does not exist",
        ),
        (
            ["check", "own.xlsx", "--html", ".", "--junit", "a.xml"],
            ".: this is a folder; give a file",
        ),
        (
            ["check", "own.xlsx", "--html", "own.xlsx"],
            "--html and --junit each need a file of their own, not one that is read",
        ),
        (
            ["check", "own.xlsx", "--junit", "link.xml"],
            "--html and --junit each need a file of their own, not one that is read",
        ),
        (
            ["check", "cut.xlsx", "--html", "page.html"],
            (
                "cut.xlsx: is damaged: its end is cut off or changed; a spreadsheet program "
                "may be able to repair it"
            ),
        ),
        (
            ["diff", "own.xlsx", "own.xlsx", "--html", "own.xlsx"],
            "--html and --junit each need a file of their own, not one that is read",
        ),
    ],
    ids=short,
)
def test_what_is_no_workbook_is_refused(arguments: list[str], message: str, hostile: Path) -> None:
    assert refusal(hostile, arguments) == message
