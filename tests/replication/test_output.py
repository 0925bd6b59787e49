"""What the commands print: whole texts, each in a file of `printed/` that a person has read.

Texts fit 80 columns, as nothing here is a terminal. Warnings are beside the arguments.
"""

import re
from pathlib import Path

import pytest
from running import promised

PRINTED = Path(__file__).with_name("printed")
FIT = str(Path(__file__).parents[2] / "docs" / "fit.csv")


def check(folder: Path, file: str, arguments: list[str], warnings: list[str]) -> None:
    """Check that a command prints what is in a file, with these warnings on stderr."""
    status, out, err = promised(folder, *arguments)
    assert status == 0
    assert err.splitlines() == [f"coldspray {arguments[0]}: warning: {line}" for line in warnings]
    assert out == (PRINTED / file).read_text("utf-8")


COARSE = "a step at the impact velocity covers 0.182 of the radius: keep it to 0.1 at most"
SHALLOW = (
    "the depth falls short of the exact one at the stop velocity, 7.67491 um, by 1.69 %: "
    "take a shorter step"
)
AT_STOP = [
    "the depth exceeds the exact one at the stop velocity, 0 um: the run begins at the stop "
    "velocity",
    "the stop velocity 1.0 m/s ends the run before rest: 99.3 % of the exact depth is still to "
    "come",
]
SLOW = "--velocity is 0.5 m/s: from 1 to 100000 m/s is expected"
NO_STEPS = "the velocity 0.5 m/s is below the stop velocity 1.0 m/s: no steps"


@pytest.mark.parametrize(
    ("file", "arguments", "warnings"),
    [
        ("depth.txt", ["depth"], []),
        (
            "depth-own.json",
            [
                *("depth", "--case-file", "own.toml", "--json"),
                *("--resistance", "98 ksi", "--velocity", "2 km/s"),
            ],
            [],
        ),
        (
            "depth-without-units.txt",
            ["depth", "--radius", "11", "--flow-stress", "700", "--particle-density", "8.9"],
            [
                '--radius is 11 m: from 1e-09 to 1 m is expected; did you mean "11 um"?',
                "--particle-density is 8.9 kg/m^3: from 23 to 23000 kg/m^3 is expected; "
                'did you mean "8.9 g/cm^3"?',
                "--flow-stress is 700 Pa: from 10000 to 1e+12 Pa is expected; "
                'did you mean "700 MPa"?',
            ],
        ),
        ("sheet-4-ns.txt", ["sheet", "--step", "4 ns"], [COARSE, SHALLOW]),
        ("sheet-4-ns.csv", ["sheet", "--step", "4 ns", "--csv", "--quiet"], []),
        ("sheet-no-steps.txt", ["sheet", "--velocity", "0.5"], [SLOW, NO_STEPS]),
        ("sheet-no-steps.json", ["sheet", "--velocity", "0.5", "--json"], []),
        ("sheet-at-stop.csv", ["sheet", "--velocity", "1", "--csv"], AT_STOP),
        ("depth-models.txt", ["depth", "--models", "--k-1", "0.5"], []),
        (
            "depth-frank-zook.txt",
            ["depth", "--model", "frank-zook", "--frank-zook-resistance", "7.6 GPa"],
            [],
        ),
        ("depth-frank-zook.json", ["depth", "--model", "frank-zook-printed", "--json"], []),
        ("depth-strength.txt", ["depth", "--particle-strength", "90 MPa", "--velocity", "1e3"], []),
        ("crater.txt", ["crater", "--volume-ratio", "0.06"], []),
        ("crater-deep.json", ["crater", "--normalized-depth", "3", "--json"], []),
        ("solve.txt", ["solve", "velocity", "--depth", "3.3 um"], []),
        (
            "solve-rounded.txt",
            ["solve", "beta", "--depth", "3.3 um", "--rounded", "--flow-stress", "700 MPa"],
            [],
        ),
        (
            "solve-rounded.json",
            [
                *("solve", "target-density", "--depth", "8.28 um", "--rounded", "--json"),
                *("--velocity", "500"),
            ],
            [],
        ),
        ("fit.txt", ["fit", FIT], []),
        ("fit-beta.csv", ["fit", FIT, "--quantity", "beta", "--csv"], []),
        ("history-3.txt", ["history", "--points", "3"], []),
        ("history-times.txt", ["history", "--times", "0,5 ns, 1 us"], []),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_case(file: str, arguments: list[str], warnings: list[str], hostile: Path) -> None:
    check(hostile, file, arguments, warnings)


@pytest.mark.parametrize(
    ("file", "arguments"),
    [
        ("converge.txt", []),
        ("converge-centered.txt", ["--scheme", "centered", "--digits", "3", "--quiet"]),
        ("converge-5-levels.txt", ["--scheme", "centered", "--levels", "5", "--step", "0.2 ns"]),
        ("converge-meaningless.txt", ["--steps", "100 ns,50 ns"]),
        ("converge-no-steps.txt", ["--steps", "4 ns,2 ns,1 ns", "--velocity", "0.5", "--quiet"]),
        ("converge-no-ratio.txt", ["--steps", "0.4 ns,0.2 ns,0.15 ns", "--quiet"]),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_the_error(file: str, arguments: list[str], hostile: Path) -> None:
    """That the first of many steps are long is expected: notes below the result say so."""
    check(hostile, file, ["converge", *arguments], [])


@pytest.mark.parametrize(
    "name",
    [
        "frank-zook-rha", "depth-beta-5", "a1-depth-1", "eq2-power", "coarse-step-remark",
        "yield-strength", "eq16", "eq1",
    ],
)  # fmt: skip
def test_the_proof_of_a_claim_or_an_equation(name: str, hostile: Path) -> None:
    check(hostile, f"claims-{name}.txt", ["claims", name], [])


@pytest.mark.parametrize(
    ("file", "arguments"),
    [
        ("claims-500.txt", ["500"]),
        ("claims-not-reproduced.txt", ["--verdict", "not reproduced"]),
        ("claims-7.67.json", ["7.67", "--json"]),
        ("claims-2-not-reproduced.json", ["2", "--verdict", "not reproduced", "--json"]),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_lists_of_claims(file: str, arguments: list[str], hostile: Path) -> None:
    check(hostile, file, ["claims", *arguments], [])


def test_the_hard_cases(hostile: Path) -> None:
    """The last digits depend on the machine's C library: its errors in ulp are left out here."""
    status, out, err = promised(hostile, "stability", "--random", "1")
    assert (status, err) == (0, "")
    without = re.sub(r"  [-+]\d\.\d\d {2,}", "  ulp  ", out.partition("\nClosed form over 1 ")[0])
    assert without == (PRINTED / "stability.txt").read_text("utf-8")


@pytest.mark.slow
def test_planted_misprints(hostile: Path) -> None:
    check(hostile, "power-60.txt", ["power", "--sample", "60", "--seed", "1"], [])
