"""`coldspray depth` by the models of the report, the threshold of Eq. 5, and `coldspray crater`."""

import json
from pathlib import Path
from typing import Any

import pytest
from running import coldspray

from replication.cases import DEPTH_MODELS


def record(*arguments: str) -> dict[str, Any]:
    """Return the JSON that a command prints."""
    status, out, err = coldspray(*arguments, "--json")
    assert (status, err) == (0, "")
    return dict(json.loads(out))


@pytest.mark.parametrize(
    ("model", "normalized_depth"),
    [
        # From the report's equations by hand, with the inputs that it prints.
        ("rigid", 0.6977),
        ("constant-pressure", 0.7521),  # CV/PV = 8900 * 500^2 / 7E9 = 0.3179
        ("frank-zook", 0.2545),  # (2/3 * 8900/7850 + 0.557) / 1.046 * ln(1 + 0.22485)
        ("frank-zook-printed", 0.1273),  # half of it
    ],
)
def test_the_reports_case_gives_the_reports_numbers(model: str, normalized_depth: float) -> None:
    by_model = record("depth", "--model", model)
    assert by_model["normalized_depth"] == pytest.approx(normalized_depth, abs=5e-5)
    assert by_model["model"] == model
    assert {"inputs", "depth", "normalized_depth", "beyond_radius"} <= set(by_model)


def test_side_by_side_they_are_the_same_as_one_by_one() -> None:
    models = record("depth", "--models")["models"]
    assert [result["model"] for result in models] == list(DEPTH_MODELS)
    for result in models:
        alone = record("depth", "--model", result["model"])
        assert result["depth"] == alone["depth"]
        assert result["sources"] == alone["sources"]


def test_a_resistance_of_the_case_is_not_frank_and_zooks() -> None:
    rigid, _, frank_zook, _ = record("depth", "--models", "--resistance", "7.6 GPa")["models"]
    assert (rigid["inputs"]["resistance"], rigid["sources"]["resistance"]) == (7.6e9, "given")
    assert frank_zook["inputs"]["resistance"] == 9.13e9
    assert frank_zook["sources"]["resistance"].startswith("fz-resistance-rha: section 3, line ")
    both = record("depth", "--models", "--frank-zook-resistance", "7.6 GPa")["models"]
    assert [result["inputs"]["resistance"] for result in both] == [3.5e9, 3.5e9, 7.6e9, 7.6e9]


def test_a_resistance_given_to_one_model_is_its_own() -> None:
    result = record("depth", "--model", "frank-zook", "--frank-zook-resistance", "7.6 GPa")
    assert result["normalized_depth"] == pytest.approx(0.3001, abs=5e-5)  # 0.2545 * 1.1789
    assert result["sources"]["resistance"] == "given"


def test_each_input_of_its_own_acts_and_is_said_to_be_given() -> None:
    plain = record("depth", "--model", "frank-zook")
    for option, name in (("--k-1", "k_1"), ("--k-t", "k_t"), ("--length-ratio", "length_ratio")):
        result = record("depth", "--model", "frank-zook", option, "0.9")
        assert (result["inputs"][name], result["sources"][name]) == (0.9, "given")
        assert result["depth"] != plain["depth"]


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ("--k-1 0.5", "--k-1 is no input of the model rigid: add --model frank-zook or --models"),
        ("--model frank-zook --beta 3", "--beta has no say in the model frank-zook, whose "
         "resistance is its own: give --frank-zook-resistance"),
        ("--model frank-zook --resistance 8e9 --frank-zook-resistance 7e9",
         "--resistance has no say in the model frank-zook, whose resistance is its own: give "
         "--frank-zook-resistance"),
        ("--models --k-t 0", "--k-t: k_t is 0.0: it must be a finite number greater than zero"),
        ("--models --k-t 1GPa", "--k-t: '1GPa': give no unit"),
        ("--particle-strength -1", "--particle-strength: particle_strength is -1.0: it must be a "
         "finite number, zero or more"),
    ],
)  # fmt: skip
def test_inputs_that_no_model_takes_are_refused(arguments: str, line: str) -> None:
    assert coldspray("depth", *arguments.split()) == (2, "", f"coldspray depth: {line}\n")


@pytest.mark.parametrize("option", ["--step", "--stop-velocity"])
@pytest.mark.parametrize(
    "arguments",
    [
        ("depth",),
        ("history", "--points", "2", "--csv"),
        ("solve", "beta", "--depth", "3um"),
        ("fit", "docs/fit.csv"),
    ],
    ids=lambda arguments: arguments[0],
)
def test_what_acts_only_in_time_steps_is_said_to_have_no_say(
    arguments: tuple[str, ...], option: str
) -> None:
    """A case may be overridden in every command; one that overrides in vain is told so."""
    plain, given = coldspray(*arguments), coldspray(*arguments, option, "1")
    assert plain == (0, given[1], "")
    assert given[2] == (
        f"coldspray {arguments[0]}: warning: {option} has no say here: it acts only where time is "
        "stepped, as in `sheet`\n"
    )
    assert coldspray(*arguments, option, "-1")[0] == 2  # and is still checked


def test_a_case_from_a_file_may_have_what_has_no_say(tmp_path: Path) -> None:
    file = tmp_path / "own.toml"
    file.write_text("[impact]\nbeta = 4.0\nstep = '1 ns'\n", "utf-8")
    assert coldspray("depth", "--case-file", file)[2] == ""


@pytest.mark.parametrize(
    ("strength", "threshold"),
    [
        ("90 MPa", 875.38),  # sqrt(2 (3500 - 90) 10^6 / 8900)
        ("0", 886.86),  # sqrt(7e9 / 8900)
        ("3.5 GPa", 0.0),  # as strong as the target resists: every velocity penetrates
    ],
)
def test_a_threshold_is_a_velocity_beside_the_depth(strength: str, threshold: float) -> None:
    result = record("depth", "--particle-strength", strength)
    assert result["penetration_threshold"] == pytest.approx(threshold, abs=5e-3)
    assert result["depth"] == record("depth")["depth"]
    assert record("depth")["penetration_threshold"] is None


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--particle-strength", "9 GPa"], "threshold none: every velocity penetrates By Eq. 5 a "
         "particle of strength Y_p 9 GPa penetrates at any, as Y_p is not below the case's "
         "resistance R_t 3.5 GPa. The depth"),
        (["--model", "frank-zook", "--particle-strength", "90 MPa"], "the case's resistance "
         "R_t 3.5 GPa only above this velocity; 500 m/s is not above it."),
        (["--model", "frank-zook", "--resistance", "2 GPa", "--particle-strength", "90 MPa"],
         "R_t 9.13 GPa fz-resistance-rha"),
    ],
)  # fmt: skip
def test_the_threshold_is_said_in_words(arguments: list[str], words: str) -> None:
    assert words in " ".join(coldspray("depth", *arguments)[1].split())


# `coldspray crater`


@pytest.mark.parametrize(
    ("arguments", "normalized_depth", "volume_ratio"),
    [
        (["--normalized-depth", "0.3"], 0.3, 0.06075),  # 0.09 * 2.7 / 4
        (["--depth", "3 um", "--radius", "6 um"], 0.5, 0.15625),  # 0.25 * 2.5 / 4
        (["--volume-ratio", "0.06075"], 0.3, 0.06075),
        (["--volume-ratio", "0.5"], 1.0, 0.5),  # the half sphere
        (["--volume-ratio", "2"], 3.0, 2.0),  # and a cylinder of two radii, 6/4 of PV
    ],
)
def test_a_crater_by_its_depth_or_its_volume(
    arguments: list[str], normalized_depth: float, volume_ratio: float
) -> None:
    crater = record("crater", *arguments)
    some_ulp = 1e-15
    assert crater["normalized_depth"] == pytest.approx(normalized_depth, rel=some_ulp)
    assert crater["volume_ratio"] == pytest.approx(volume_ratio, rel=some_ulp)
    assert crater["beyond_radius"] == (normalized_depth > 1)


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ("--depth 0", "--depth: '0' is not between 1e-40 and 1e40 m"),
        ("--volume-ratio 0.1um", "--volume-ratio: '0.1um': give no unit"),
        ("--depth 1um --radius 1e99", "--radius: '1e99' is not between 1e-40 and 1e40 m"),
        ("", "one of the arguments --depth --normalized-depth --volume-ratio is required (see "
         "coldspray crater --help)"),
    ],
)  # fmt: skip
def test_a_crater_that_cannot_be(arguments: str, line: str) -> None:
    assert coldspray("crater", *arguments.split()) == (2, "", f"coldspray crater: {line}\n")


@pytest.mark.parametrize(
    ("arguments", "warning"),
    [
        ("crater --depth 50", "--depth is 50 m: from 1e-09 to 1 m is expected; did you mean "
         '"50 um"?'),
        ("depth --particle-strength 90", "--particle-strength is 90 Pa: from 10000 to 1e+12 Pa is "
         'expected; did you mean "90 MPa"?'),
    ],
)  # fmt: skip
def test_a_number_whose_unit_was_left_out_is_warned_of(arguments: str, warning: str) -> None:
    status, _, err = coldspray(*arguments.split())
    assert (status, err) == (0, f"coldspray {arguments.split()[0]}: warning: {warning}\n")
