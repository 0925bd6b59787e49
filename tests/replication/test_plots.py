"""The figures: labelled axes with units, one's own points, the same bytes, and what is refused."""

import csv
import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import StepPatch
from running import coldspray, state

from replication import plots
from replication.audit.record import Record
from replication.cases import BETA_3, BETA_5, changed
from replication.error.ladder import converge, ladder
from replication.fit import fit, read_measurements
from replication.models.motion import history
from replication.models.sheet import run
from replication.report.figures import draw_figures
from replication.sweep import compute, read_plan
from spreadsheets.styles import CURVES

SVG = "{http://www.w3.org/2000/svg}"
ROOT = Path(__file__).parents[2]
MEASURED = ROOT / "docs" / "fit.csv"
"""Eleven velocities with depths and uncertainties."""

TIMES = [0.0, 5e-9, 1e-8, 2e-8]
TIMED = "time [ns],depth [um],velocity [m/s]\n5,2.5,461\n10,4.4,380\n20,7.3,140\n"
STEPPED = "step [ns],depth [um]\n0.4,7.663\n0.2,7.669\n"
DRAWN = 'radius = { distribution = "uniform", lower = "9 um", upper = "11 um" }'
PLANS = {
    "one": 'velocity = { from = "300 m/s", to = "700 m/s", points = 9 }',
    "two": 'radius = { from = "1 um", to = "100 um", points = 41, scale = "log" }\nbeta = [3, 5]',
    "map": 'velocity = { from = "300 m/s", to = "700 m/s", points = 9 }\n'
    'radius = { from = "1 um", to = "100 um", points = 8, scale = "log" }',
    "still": 'step = { from = "0.1 ns", to = "1 ns", points = 8 }\n'
    'stop_velocity = { from = "0 m/s", to = "1 m/s", points = 8 }',
    "draws": f"{DRAWN}\nbeta = [3, 5]",
    "certain": 'stop_velocity = { distribution = "uniform", lower = "0 m/s", upper = "1 m/s" }',
}
SETTINGS = {"two": 'outputs = ["sheet_depth"]', "draws": "samples = 200", "certain": "samples = 9"}


def plan_file(folder: Path, name: str) -> Path:
    file = folder / f"{name}.toml"
    file.write_text(f"[sweep]\n{SETTINGS.get(name, '')}\n[inputs]\n{PLANS[name]}\n", "utf-8")
    return file


def own(folder: Path, name: str, text: str) -> Path:
    (folder / name).write_text(text, "utf-8")
    return folder / name


def drawn_history(folder: Path) -> Figure:
    depth, velocity = [0.0] * 4, [0.0] * 4
    history(TIMES, **BETA_5.motion, depth=depth, speed=velocity)
    file = own(folder, "own.csv", TIMED)
    points = plots.read_points(file, plots.TIME, (plots.DEPTH, plots.SPEED))
    return plots.plot_history(BETA_5, TIMES, depth, velocity, "history", points)


def drawn_sheet(folder: Path) -> Figure:
    file = own(folder, "own.csv", TIMED)
    points = plots.read_points(file, plots.TIME, (plots.DEPTH, plots.SPEED))
    return plots.plot_sheet(run(BETA_3), "sheet", points)


def drawn_ladder(folder: Path) -> Figure:
    file = own(folder, "own.csv", STEPPED)
    points = plots.read_points(file, plots.STEP, (plots.ERROR, plots.DEPTH))
    return plots.plot_converge(BETA_5, converge(BETA_5, ladder(2e-10, 6)), "converge", points)


def drawn_fit(folder: Path) -> Figure:
    measurements = read_measurements(MEASURED, BETA_5)
    return plots.plot_fit(measurements, fit(BETA_5, measurements), "fit", MEASURED.name)


def drawn_fit_of_radii(folder: Path) -> Figure:
    file = own(folder, "radii.csv", "v [m/s],radius [um],depth [um]\n500,11,7.6\n500,5,3.5\n")
    measurements = read_measurements(file, BETA_5)
    return plots.plot_fit(measurements, fit(BETA_5, measurements), "fit")


def drawn_sweep(name: str, data: Path | None = None) -> Callable[[Path], Figure]:
    def draw(folder: Path) -> Figure:
        plan = read_plan(plan_file(folder, name))
        plots.check_sweep(plan.axes, plan.samples, plan.is_drawn)
        points = data and plots.sweep_points(plan.axes, plan.is_drawn)(data)
        results = compute(plan, 0, plan.count)
        return plots.plot_sweep(results, plan.axes, plan.is_drawn, name, points)

    return draw


FIGURES: dict[str, tuple[Callable[[Path], Figure], int]] = {
    "history": (drawn_history, 6),
    "sheet": (drawn_sheet, 6),
    "converge": (drawn_ladder, 2),
    "fit": (drawn_fit, 22),
    "fit-of-radii": (drawn_fit_of_radii, 4),
    "sweep-one": (drawn_sweep("one", MEASURED), 22),
    "sweep-two": (drawn_sweep("two"), 0),
    "sweep-map": (drawn_sweep("map"), 0),
    "sweep-still": (drawn_sweep("still"), 0),
    "sweep-draws": (drawn_sweep("draws", MEASURED), 11),
}
"""How each figure is drawn, and how many of one's own points are in it, in all its panels."""


@pytest.fixture(scope="module")
def figures(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Figure]:
    folder = tmp_path_factory.mktemp("figures")
    return {name: draw(folder) for name, (draw, _) in FIGURES.items()}


@pytest.fixture(scope="module")
def drawings(figures: dict[str, Figure]) -> dict[str, bytes]:
    return {name: plots.content(figure) for name, figure in figures.items()}


def shown(drawing: bytes) -> list[str]:
    """Return the texts of an SVG."""
    return ["".join(text.itertext()) for text in ET.fromstring(drawing).iter(f"{SVG}text")]


@pytest.mark.parametrize("name", FIGURES)
def test_axes_are_labelled_with_units(name: str, figures: dict[str, Figure]) -> None:
    panels = figures[name].axes
    labels = [panel.get_ylabel() for panel in panels] + [panels[-1].get_xlabel()]
    assert [re.fullmatch(r"\S.* \[\S+\]", label) is not None for label in labels] == [True] * len(
        labels
    )


def test_titles_are_typeset(tmp_path: Path) -> None:
    """In them the symbols of the report have their subscripts, as in the figures of the audit."""
    file = tmp_path / "x.svg"
    assert coldspray("history", "--points", "2", "--plot", file)[0] == 0
    title = "V 500 m/s, R 11 µm, ρₚ 8900, ρₜ 7850 kg/m³, Rₜ 5 × 700 MPa"
    assert title in shown(file.read_bytes())


@pytest.mark.parametrize(("name", "count"), [(name, count) for name, (_, count) in FIGURES.items()])
def test_every_point_of_ones_own_is_drawn(
    name: str, count: int, drawings: dict[str, bytes]
) -> None:
    groups = [g for g in ET.fromstring(drawings[name]).iter(f"{SVG}g") if g.get("id") == "data"]
    assert sum(len(list(group.iter(f"{SVG}use"))) for group in groups) == count


def test_an_uncertainty_is_a_visible_bar_of_its_length_on_both_sides(
    figures: dict[str, Figure],
) -> None:
    lines = [line for line in MEASURED.read_text("utf-8").splitlines() if line[0].isdigit()]
    measured = [tuple(map(float, line.split(","))) for line in lines]
    ends = [(depth - uncertain, depth + uncertain) for _, depth, uncertain in measured]
    (bars,) = figures["fit"].axes[0].collections
    assert isinstance(bars, LineCollection)
    assert [tuple(bar[:, 1]) for bar in bars.get_segments()] == [pytest.approx(end) for end in ends]
    assert min(bars.get_linewidth()) > 0.5


@pytest.mark.parametrize("name", ["history", "sweep-map", "sweep-draws", "fit"])
def test_the_same_numbers_give_the_same_bytes(
    name: str, drawings: dict[str, bytes], tmp_path: Path
) -> None:
    with mpl.rc_context({"font.size": 20, "svg.hashsalt": None}):  # the user's own style
        again = plots.content(FIGURES[name][0](tmp_path))
    assert again == drawings[name]


@pytest.mark.parametrize(
    ("ending", "start"), [(".svg", b"<?xml"), (".png", b"\x89PNG"), (".PDF", b"%PDF")]
)
def test_each_form_is_undated(ending: str, start: bytes, tmp_path: Path) -> None:
    content, again = (plots.content(drawn_history(tmp_path), ending) for _ in range(2))
    assert content.startswith(start)
    assert content == again
    assert b"CreationDate" not in content
    assert b"dc:date" not in content


# What the figures show


def test_a_case_has_one_color_everywhere(record: Record) -> None:
    """On the page, in the workbook (which takes CURVES itself) and in all figures."""
    page = ET.fromstring(draw_figures(record)["figure-3"])
    filled = [element.get("fill") for element in page.iter(f"{SVG}circle")]
    assert set(filled) == {CURVES["3"].color}
    assert plots.look_of(BETA_3).color == CURVES["3"].color
    assert plots.look_of(changed(BETA_5, {"velocity": 400.0})).color == CURVES["5"].color
    others = {plots.look_of(changed(BETA_5, {"beta": 4.0})), plots.look_of(
        changed(BETA_5, {"resistance": 3.5e9})
    )}  # fmt: skip
    assert {look.color for look in others}.isdisjoint(look.color for look in CURVES.values())


def test_curves_can_be_told_apart_in_gray() -> None:
    looks = [*plots.BY_BETA.values(), *plots.OTHER_LOOKS]
    assert len({look.marker for look in looks}) == len(looks)
    assert len({str(look.line) for look in plots.OTHER_LOOKS[:4]}) == 4


def test_several_values_of_an_input_have_a_look_each(figures: dict[str, Figure]) -> None:
    lines = figures["sweep-two"].axes[0].get_lines()
    assert [line.get_label() for line in lines] == [
        "beta 3", "beta 3, the sheet", "beta 5", "beta 5, the sheet"
    ]  # fmt: skip
    assert [line.get_color() for line in lines[::2]] == [CURVES["3"].color, CURVES["5"].color]


def test_curves_of_one_beta_differ(tmp_path: Path) -> None:
    file = own(
        tmp_path, "v.toml", '[inputs]\nvelocity = [400, 500]\nradius = ["1 um", "2 um", "3 um"]'
    )
    plan = read_plan(file)
    figure = plots.plot_sweep(compute(plan, 0, plan.count), plan.axes, plan.is_drawn)
    lines = figure.axes[0].get_lines()
    assert len({line.get_color() for line in lines}) == len(lines) == 2
    assert list(lines[0].get_xdata()) == [1.0, 2.0, 3.0]  # the radii, of which there are more


def test_own_depths_become_errors(figures: dict[str, Figure]) -> None:
    """The exact depth of the report's beta 5 is 7.674932926028623 um: less 7.663 and 7.669 um."""
    (marks,) = (line for line in figures["converge"].axes[0].get_lines() if line.get_gid())
    expected = np.array([7.674932926028623 - 7.663, 7.674932926028623 - 7.669]) * 1e3
    np.testing.assert_allclose(np.asarray(marks.get_ydata(), float), expected, rtol=1e-9)
    assert list(marks.get_xdata()) == pytest.approx([0.4, 0.2])


def test_draws_that_give_one_number_are_one_bar_of_area_one_around_it(tmp_path: Path) -> None:
    """At which velocity a sheet stops does not change the exact depth."""
    for panel, expected in zip(
        drawn_sweep("certain")(tmp_path).axes, (7.6749, 0.6977), strict=True
    ):
        (bar,) = panel.patches
        assert isinstance(bar, StepPatch)
        (height,), (left, right), _ = bar.get_data()
        assert height * (right - left) == pytest.approx(1, rel=1e-12)
        assert (left + right) / 2 == pytest.approx(expected, abs=5e-5)


def test_quantiles_are_those_of_the_draws() -> None:
    """Of 0, 1, ..., 100 um, the quantiles of 5, 50 and 95 percent are 5, 50 and 95 um."""
    depth = np.arange(101) * 1e-6
    results = {"depth": depth, "normalized_depth": depth / 50e-6, "beta": np.full(101, 5.0)}
    panel = plots.plot_sweep(results, {}, drawn=True).axes[0]
    assert panel.get_legend_handles_labels()[1] == ["5, 50, 95"]
    assert [line.get_xdata()[0] for line in panel.get_lines()] == pytest.approx([5, 50, 95])


def test_quantiles_have_the_dashes_of_their_histogram(tmp_path: Path) -> None:
    """So that those of beta 3 and 5 differ in gray."""
    file = own(
        tmp_path, "draws.toml", "[sweep]\nsamples = 20\n[inputs]\nbeta = [3, 5]\n"
        "velocity = {distribution = 'normal', mean = 500, deviation = 50}",
    )  # fmt: skip
    plan = read_plan(file)
    panel = plots.plot_sweep(compute(plan, 0, plan.count), plan.axes, plan.is_drawn).axes[0]
    dashes = [line.get_linestyle() for line in panel.get_lines()]
    assert dashes == [*3 * ["-"], *3 * ["--"]]
    assert [patch.get_linestyle() for patch in panel.patches] == ["-", "--"]


def test_the_sheet_is_marked_at_its_rows(figures: dict[str, Figure]) -> None:
    """Of 178 steps every sixth is marked, and the last."""
    marks = figures["sheet"].axes[0].get_lines()[1]
    rows = run(BETA_3).rows
    assert marks.get_label() == "the sheet, one row of 6, each in the middle of its step"
    expected = [row.depth * 1e6 for row in [*rows[::6], rows[-1]]]
    assert list(marks.get_ydata()) == expected


def test_the_depths_of_a_coarse_sheet_are_drawn_where_the_motion_has_them() -> None:
    """The first depth, V dt / 2, is that of half a step; at the row's time it would be half of it.

    Near the touch x'' = -w^2 x, so that x = V t (1 - (w t)^2 / 6 + ...). For beta 5 w^2 is
    6.24e15 / s^2, and at 0.5 ns the difference is 2.6e-4 of V t.
    """
    axes = plots.plot_sheet(run(replace(BETA_5, step=1e-9))).axes
    (_, depths), (_, speeds) = (panel.get_lines()[:2] for panel in axes)
    time, depth = (
        [float(x) for x in data[:2]] for data in (depths.get_xdata(), depths.get_ydata())
    )
    assert (time[0], depth[0]) == (0.0, 0.0)
    assert time[1] == pytest.approx(0.5)
    exact = [0.0]
    history([time[1] * 1e-9], **BETA_5.motion, depth=exact, speed=[0.0])
    assert depth[1] == pytest.approx(exact[0] * 1e6, rel=3e-4)
    assert list(speeds.get_xdata())[1] == pytest.approx(1.0)


def test_a_map_without_contours_says_so(drawings: dict[str, bytes]) -> None:
    """Neither the step nor the stop velocity acts on the exact depth."""
    assert "about 7.67493 everywhere" in shown(drawings["sweep-still"])


def test_the_curve_of_a_fit_goes_a_twentieth_beyond_the_velocities(tmp_path: Path) -> None:
    """Of their range, or of the velocity where there is only one."""
    for rows, ends in (("500,7.6\n500,7.7\n", (475, 525)), ("400,6\n500,7.7\n", (395, 505))):
        file = own(tmp_path, "own.csv", f"v [m/s],depth [um]\n{rows}")
        measurements = read_measurements(file, BETA_5)
        curve = (
            plots.plot_fit(measurements, fit(BETA_5, measurements), "fit").axes[0].get_lines()[0]
        )
        drawn = list(curve.get_xdata())
        assert (drawn[0], drawn[-1]) == pytest.approx(ends)


def test_a_fit_names_its_result(drawings: dict[str, bytes]) -> None:
    measurements = read_measurements(MEASURED, BETA_5)
    result = fit(BETA_5, measurements)
    assert result.standard_error is not None
    # The standard error is 0.059 GPa: two digits of it are three decimals.
    words = f"fitted resistance {result.value / 1e9:.3f} ± {result.standard_error / 1e9:.3f} GPa"
    assert words in shown(drawings["fit"])


# At the command line


@pytest.mark.parametrize(
    "command", [["history", "--csv"], ["sheet", "--json"], ["converge", "--levels", "3"]]
)
def test_a_figure_changes_nothing_that_is_printed(command: list[str], tmp_path: Path) -> None:
    file = tmp_path / "figure.svg"
    assert coldspray(*command, "--plot", file) == coldspray(*command)
    assert ET.parse(file).getroot().tag == f"{SVG}svg"
    assert [path.name for path in tmp_path.iterdir()] == ["figure.svg"]


def test_a_sweep_writes_its_file_and_its_figure(tmp_path: Path) -> None:
    plan, table, figure = plan_file(tmp_path, "one"), tmp_path / "one.csv", tmp_path / "one.svg"
    status, out, err = coldspray(
        "sweep", plan, "-o", table, "--plot", figure, "--data", MEASURED, "--json"
    )
    assert (status, err, json.loads(out)["cases"]) == (0, "", 9)
    with table.open() as file:
        assert len(list(csv.DictReader(file))) == 9
    assert {"Impact velocity [m/s]", "fit.csv"} <= set(shown(figure.read_bytes()))


def test_columns_of_ones_own_points_that_are_not_drawn_are_named(tmp_path: Path) -> None:
    data = own(tmp_path, "own.csv", "t [ns],x [um],size [um],std [um]\n5,2.4,22,0.1\n")
    plotted = ("history", "--points", "2", "--plot", tmp_path / "figure.svg", "--data", data)
    note = f"{data}: columns not used: 'size [um]'"
    assert f"note: {note}" in " ".join(coldspray(*plotted)[1].split())
    assert json.loads(coldspray(*plotted, "--json")[1])["notes"] == [note]


def test_an_error_that_an_axis_shows_is_no_uncertainty(tmp_path: Path) -> None:
    data = own(tmp_path, "own.csv", "dt [ns],error [nm],depth [um],sd [um]\n1,25,7.6,0.1\n")
    points = plots.read_points(data, plots.STEP, (plots.ERROR, plots.DEPTH))
    assert points.columns[plots.ERROR] == [25e-9]
    assert points.columns[plots.UNCERTAINTY] == [0.1e-6]


@pytest.mark.parametrize(
    ("command", "content", "line"),
    [
        ("history", "time,depth\n0,0\n5,2.4\n",
         "line 3: 'time' is 1.92e+08 times the time until rest: is it in ns? Then write "
         "'time [ns]'"),
        ("sheet", "time [ns],depth\n0,0\n5,2.4\n",
         "line 3: 'depth' is 3.13e+05 times the final depth: is it in um? Then write 'depth [um]'"),
        ("converge", "dt,x [um]\n0.1,7.6\n0.2,7.7\n",
         "line 3: 'dt' is 7.67e+06 times the time until rest: is it in ns? Then write 'dt [ns]'"),
        ("fit", "v,x\n300,4.5\n",
         "line 2: 'x' is 4.09e+05 times the deepest that is fitted: is it in um? Then write "
         "'x [um]'"),
        ("sweep", "v,x\n450,6.6\n",
         "line 2: 'x' is 6e+05 times the largest radius of the plan: is it in um? Then write "
         "'x [um]'"),
    ],
)  # fmt: skip
def test_own_points_without_a_unit_that_are_far_off_are_asked_about(
    command: str, content: str, line: str, tmp_path: Path
) -> None:
    """Against the time until rest, 26.079 ns; the depths, 7.675 um, and 10.99 um in fit.csv; and
    the radius, 11 um."""
    file = tmp_path / "mine.csv"
    file.write_text(content, "utf-8")
    plan = ROOT / "docs" / "sweeps" / "figure-5.toml"
    files = {"fit": [MEASURED], "sweep": [plan, "-o", tmp_path / "mine.out.csv"]}.get(command, [])
    drawn = coldspray(command, *files, "--plot", tmp_path / "mine.svg", "--data", file)
    assert drawn == (2, "", f"coldspray {command}: {file}, {line}\n")
    assert not (tmp_path / "mine.svg").exists()


def test_a_fit_draws_further_points_that_it_does_not_fit(tmp_path: Path) -> None:
    (tmp_path / "others.csv").write_text("velocity [m/s],depth [um]\n450,7\n650,10\n")
    figure = tmp_path / "fit.svg"
    alone = coldspray("fit", MEASURED)
    drawn = coldspray("fit", MEASURED, "--plot", figure, "--data", tmp_path / "others.csv")
    assert drawn == alone
    assert {"fit.csv", "others.csv"} <= set(shown(figure.read_bytes()))
    (marks,) = ET.fromstring(figure.read_text()).iterfind(f".//{SVG}g[@id='further-data']")
    assert len(list(marks.iter(f"{SVG}use"))) == 2


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            ["history", "--plot", "figure.gif"],
            "--plot: figure.gif: a figure's name ends in .svg, .png or .pdf",
        ),
        (
            ["sheet", "--plot", "figure"],
            "--plot: figure: a figure's name ends in .svg, .png or .pdf",
        ),
        (
            ["converge", "--plot", "absent/figure.svg"],
            "absent: the folder to write to does not exist",
        ),
        (
            ["history", "--data", "own.csv"],
            "--data is drawn in the figure of --plot: give that, too",
        ),
        (
            ["history", "--plot", "f.svg", "--data", "own.csv"],
            "own.csv has no column 'time [ns]' (it has 'step [ns]', 'depth [um]')",
        ),
        (
            ["converge", "--plot", "f.svg", "--data", "speeds.csv"],
            "speeds.csv has no column 'step [ns]', and no column 'error [nm]' or 'depth [um]' (it "
            "has 'speed')",
        ),
        (
            ["sheet", "--plot", "f.svg", "--data", "speeds.csv"],
            "speeds.csv has no column 'time [ns]', and no column 'depth [um]' or 'velocity [m/s]' "
            "(it has 'speed')",
        ),
        (
            ["sheet", "--plot", "own.svg", "--data", "own.svg"],
            "--plot: own.svg is also read: write the figure to another file",
        ),
        (
            ["sweep", "three.toml", "--plot", "f.svg"],
            "--plot: three.toml: it varies velocity, radius and beta: a figure shows one or two "
            "inputs",
        ),
        (
            ["sweep", "none.toml", "--plot", "f.svg"],
            "--plot: none.toml: it varies no input: there is nothing to draw against",
        ),
        (
            ["sweep", "drawn.toml", "--plot", "f.svg"],
            "--plot: drawn.toml: it draws for 7 combinations of velocity: a figure shows at most 6 "
            "histograms",
        ),
        (
            ["sweep", "large.toml", "--plot", "f.svg"],
            "--plot: large.toml: it has 4,000,000 cases: a figure shows 1,000,000 at most",
        ),
        (
            ["sweep", "none.toml", "--data", "own.csv"],
            "--data is drawn in the figure of --plot: give that, too",
        ),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_what_cannot_be_drawn_is_refused_before_the_work(
    arguments: list[str], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name, text in {
        "own.csv": STEPPED,
        "own.svg": TIMED,
        "speeds.csv": "speed\n3\n",
        "three.toml": "[inputs]\nvelocity = [1, 2]\nradius = [1, 2]\nbeta = [3, 5]\n",
        "none.toml": "[inputs]\nvelocity = [500]\n",
        "drawn.toml": f"[sweep]\nsamples = 5\n[inputs]\nvelocity = [1, 2, 3, 4, 5, 6, 7]\n"
        f"{DRAWN}\n",
        "large.toml": "[inputs]\nvelocity = { from = 1, to = 2, points = 4_000_000 }\n",
    }.items():
        (tmp_path / name).write_text(text, "utf-8")
    before = state(tmp_path)
    status, out, err = coldspray(*arguments)
    assert (status, out, err) == (2, "", f"coldspray {arguments[0]}: {said}\n")
    assert state(tmp_path) == before


def test_a_sweep_that_fails_leaves_neither_file(tmp_path: Path) -> None:
    """The sheet of a radius of 1 m takes more than a million steps."""
    text = '[sweep]\noutputs = ["sheet_depth"]\n[inputs]\nradius = ["1 um", "1 m"]\n'
    plan = own(tmp_path, "plan.toml", text)
    status, _, err = coldspray(
        "sweep", plan, "-o", tmp_path / "o.csv", "--plot", tmp_path / "o.svg"
    )
    assert status == 2
    assert "takes more than 1,000,000 steps" in err
    assert [path.name for path in tmp_path.iterdir()] == ["plan.toml"]
