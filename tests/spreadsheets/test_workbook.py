"""Real engines compute the same double as Python in every cell, whatever is typed as input."""

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random
from typing import Any

import msgspec
import pytest
from workbooks import stored, usable

from reference.ledger import load
from reference.units import to_si
from replication import workbook
from replication.audit.record import Record
from replication.cases import BETA_5
from replication.models.depth import final_depth
from replication.models.impact import Impact
from replication.models.sheet import run
from replication.workbook import Workbook, findings_of, live_verdicts
from spreadsheets import emit
from spreadsheets.engines import Engine, Values
from spreadsheets.plan import NOT_COMPUTED, TABLES, Value
from spreadsheets.sheets import OTHERWISE
from spreadsheets.verify import compare, tolerances

LEDGER = load()
GIVEN = replace(BETA_5, beta=None, flow_stress=None, resistance=2.5e9)
ODD = replace(BETA_5, step=3.3e-10, radius=7.3e-6, flow_stress=1.234e8, beta=4.567)
CASES: dict[str, tuple[Impact | None, str]] = {
    "report": (None, "published"),
    "report, centered": (None, "centered"),
    "beyond the radius": (replace(BETA_5, velocity=800.0), "published"),
    "resistance given": (GIVEN, "published"),
    "fewer steps than Table A-1": (replace(BETA_5, step=1e-8), "published"),
    "no step at all": (replace(BETA_5, stop_velocity=600.0), "centered"),
    "too long a step": (replace(BETA_5, step=4e-8), "published"),
    "numbers that no unit makes round": (ODD, "centered"),
    "beta of sixteen digits": (replace(BETA_5, beta=4.567890123456789, step=1e-9), "published"),
    # Below about 0.0944 m/s the workbook computes ln(1 + x) by its series.
    **{
        f"slow, {v} m/s": (replace(BETA_5, velocity=v, stop_velocity=v / 2), "published")
        for v in (1e-4, 0.09, 0.0944, 0.1, 1.0, 30.0)
    },
}


@pytest.fixture(scope="module")
def files(build: Callable[..., Workbook], emit_to: Any) -> dict[str, Any]:
    return {name: emit_to(build(*case)) for name, case in CASES.items()}


def test_recalculated_values_are_pythons_doubles(engine: Engine, files: dict[str, Any]) -> None:
    """Gnumeric computes in long doubles: its values are within the rounding bound."""
    result = engine.recalculate_many([file.path for file in files.values()])
    for (name, file), values in zip(files.items(), result, strict=True):
        bound = file.book.rounding if engine.long_doubles else 0.0
        allowed = tolerances(file.book.plan, file.book.cells, bound)
        assert compare(file.book.cells, values, allowed) == [], name


def test_file_holds_the_plan_and_its_values(emitted: Any) -> None:
    assert compare(emitted.book.cells, stored(emitted.path)) == []
    content = stored(emitted.path, formulas=True)
    formulas = {at: cell.formula for at, cell in emitted.book.plan.cells.items() if cell.formula}
    assert {(s, a): f for s, cells in content.items() for a, f in cells.items()} == formulas


# Random inputs, typed into the emitted file

MATERIALS = (
    "q_Y", "E_t", "HB_ratio", "S_clear", "Y_copper", "L_typ", "k_1", "k_t", "R_t_RHA", "R_t_lower",
    "CV_PV", "d_min", "d_max", "D_mean", "observed_ratio", "V_to",
)  # fmt: skip
"""Inputs that belong to no case; each is typed as 0.8 to 1.25 times the report's number."""


def random_cases(seed: int) -> tuple[Impact, Impact]:
    """Return two cases for the report's workbook, with a time step for which its rows suffice."""
    draw = Random(seed).uniform
    while True:
        low = Impact(
            velocity=draw(200.0, 1500.0),
            radius=draw(1e-6, 2e-5),
            particle_density=draw(1e3, 2e4),
            target_density=draw(1e3, 2e4),
            # A label contains beta, of which Gnumeric may show the digits of a long double. Eighths
            # look the same in all engines.
            beta=round(draw(8, 64)) / 8,
            flow_stress=draw(1e8, 2e9),
            stop_velocity=draw(0.0, 20.0),
        )
        # The mean velocity is about half the impact velocity, which doubles the number of steps.
        step = final_depth(*low.motion.values()) / low.velocity / draw(0.5, 180.0)
        cases = replace(low, step=step), replace(low, step=step, beta=round(draw(8, 64)) / 8)
        longest = (run(replace(case, step=dt)).steps for case in cases for dt in (step, 5e-10))
        if max(longest) <= 400:
            return cases


def typed_inputs(
    build: Callable[..., Workbook], seed: int, monkeypatch: pytest.MonkeyPatch
) -> tuple[dict[str, Value], float]:
    """Return the values of the report's workbook after random numbers are typed, and its bound.

    They are the values of a workbook written for a report with these cases and numbers, except for
    texts that say whether an input is the report's, and for runs that are not live.
    """
    draw, ledger = Random(seed + 1).uniform, LEDGER
    sources = {name: x["source"] for of in TABLES["inputs"].values() for name, x in of.items()}
    for source in map(sources.__getitem__, MATERIALS):
        number = float(LEDGER.value(source) / to_si(LEDGER.claims[source].unit))
        ledger = ledger.misprint(source, f"{number * draw(0.8, 1.25):.3f}")
    # Sheets are named for their beta, so that the ledger's addresses do not fit.
    unaddressed = {
        name: msgspec.structs.replace(lines, workbook=None) for name, lines in ledger.claim.items()
    }
    ledger = msgspec.structs.replace(ledger, claim=unaddressed)
    for name, case in zip(("BETA_3", "BETA_5"), random_cases(seed), strict=True):
        monkeypatch.setattr(workbook, name, case)
    book = build(rows=400, ledger=ledger)
    not_live = re.compile(
        r"convergence\.(?!in_use)|.*\.(check|renamed)|inputs\.(changed|message)"
        r"|overview\.(inputs_changed|\w+\.message)"
    )
    live = {key: value for key, value in book.values.items() if not not_live.match(key)}
    return live, book.rounding


@pytest.mark.parametrize(
    "seeds",
    [range(1, 3)] + [pytest.param(range(k, k + 26), marks=pytest.mark.slow) for k in (3, 29)],
)
def test_typed_inputs_recalculate_to_pythons_doubles(
    engine: Engine,
    emitted: Any,
    build: Callable[..., Workbook],
    record: Record,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    seeds: range,
) -> None:
    plan, findings = emitted.book.plan, findings_of(record, "published", LEDGER)
    expected = [typed_inputs(build, seed, monkeypatch) for seed in seeds]
    typed = [{k: v for k, v in of.items() if k.endswith(".typed")} for of, _ in expected]
    paths = [emitted.typed(cells, tmp_path / f"{n}.xlsx") for n, cells in enumerate(typed)]
    for (right, bound), result in zip(expected, engine.recalculate_many(paths), strict=True):
        assert right.keys() <= plan.where.keys()
        assert len(right) > 0.9 * len(plan.where)
        values = {key: result[s].get(at, "") for key, (s, at) in plan.where.items()} | right
        values |= live_verdicts(LEDGER, plan, values, findings)
        cells = emit.cell_values(plan, values)
        allowed = tolerances(plan, cells, bound if engine.long_doubles else 0.0)
        assert compare(cells, result, allowed) == []
        assert "typed over" not in result["Inputs"].values()


def test_bound_is_far_above_what_gnumeric_shows_and_catches_a_planted_error(emitted: Any) -> None:
    """The planted errors are three times the bound, relative to the largest number of a column."""
    book, result = emitted.book, usable("gnumeric").recalculate(emitted.path)
    assert compare(book.cells, result, tolerances(book.plan, book.cells)) != []
    assert compare(book.cells, result, tolerances(book.plan, book.cells, book.rounding / 20)) == []
    allowed = tolerances(book.plan, book.cells, book.rounding)
    for key, largest in (
        ("high.row.velocity_final[130]", 500.0),
        ("high.row.depth[60]", 7.67e-6),
        ("high.final_velocity", 500.0),
        ("high.depth_um", 7.67),
        ("overview.low.depth_um", 10.03),
        ("crater.particle_volume", 5.6e-15),
        ("inputs.M_p", 5e-11),
    ):
        sheet, at = book.plan.where[key]
        wrong = result[sheet][at] + 3 * book.rounding * largest
        (left,) = compare(book.cells, {**result, sheet: {**result[sheet], at: wrong}}, allowed)
        assert (left.sheet, left.cell) == (sheet, at)


def test_numbers_that_a_cell_cannot_hold_are_the_nearest() -> None:
    """No step in ns, divided by 1e9, may give exactly the double that was asked for."""

    def reachable(step: float) -> list[float]:
        typed = step * 1e9
        return [t / 1e9 for t in (math.nextafter(typed, 0), typed, math.nextafter(typed, 1e9))]

    step = next(s for s in (n * 1e-13 for n in range(1000, 9000)) if s not in reachable(s))
    values = workbook.build(replace(BETA_5, step=step)).values
    content = float(values["inputs.dt_s"])
    assert abs(content - step) <= math.ulp(step)
    assert values["inputs.dt_s.typed"] / 1e9 == content
    assert values["case.final_depth"] == run(replace(BETA_5, step=content)).final_depth


# What the workbook says after something is typed

KEPT = Path(__file__).with_name("says.txt").read_text("utf-8").split("\n$ ")[1:]
TYPED = {case.partition("\n")[0]: case.partition("\n")[2].strip("\n") for case in KEPT}
"""What is typed (numbers for inputs, by name and in the unit of their cells, or "over" a formula's
cell) -> the texts that then stand in the workbook, with the keys of their cells."""
FOR_ALL = (
    "nothing", "V_impact = nothing", "R_p = eleven", "HB_ratio = nothing",
    "over high.row.depth[40] = 3.9e-06",
    "dt_s = 0.05, dt_coarse = 0.05", "dt_s = 40.0", "V_impact = 0.5", "beta_high = 4.0",
    "over R_p = eleven", "from = report, over R_t_high = 2e9, over M_p = 5e-11",
    "from = report, V_impact = 600.0, rho_t = 0.0, beta_high = 4.0",
)  # fmt: skip
"""What is typed for every program; all the rest is typed only for the fastest."""

SHOWN = re.compile(
    r"(overview|inputs|low|high|low_coarse|high_coarse|convergence|figure_\d)\.(?!.*(typed|row))[^\[]*"
    r"|audit\.(.*\.verdict|none)"
)
COUNTED = re.compile(r".*\b(trust|steps|\w*unusable|\w*changed|\w*none|same\.\w+)")


FAILING = {"frank-zook-rha", "frank-zook-stainless"}
"""Claims that are not as printed with the report's own inputs."""


@dataclass(frozen=True)
class Page:
    """A recalculated workbook, read by key."""

    emitted: Any
    result: Values

    def __getitem__(self, key: str) -> Value:
        sheet, address = self.emitted.book.plan.where[key]
        return self.result[sheet].get(address, "")

    def verdicts(self, verdict: str) -> set[str]:
        computed = [claim.id for claim in LEDGER.claims.values() if claim.workbook]
        return {name for name in computed if self[f"audit.{name}.verdict"] == verdict}

    def described(self, usual: "Page | None") -> str:
        """Return each text, and number of `COUNTED`, with its cells, unless it is as usual."""
        cells: dict[str, list[str]] = {}
        for key in filter(SHOWN.fullmatch, self.emitted.book.values):
            value, number = self[key], not isinstance(self[key], str)
            shown = not number or value == 0 or COUNTED.fullmatch(key)
            if shown and (usual is None or value != usual[key]):
                cells.setdefault(f"{float(value):g}" if number else str(value), []).append(key)
        return "\n".join(f"{text}  [{', '.join(keys)}]" for text, keys in cells.items())

    @property
    def errors(self) -> Iterator[tuple[str, str, Value]]:
        for sheet, cells in self.result.items():
            for address, value in cells.items():
                if isinstance(value, str) and value.startswith(("#", "Err:")):
                    yield sheet, address, value


@pytest.fixture(scope="module", params=["ironcalc", "formualizer", "libreoffice"])
def pages(
    request: pytest.FixtureRequest, emitted: Any, tmp_path_factory: pytest.TempPathFactory
) -> dict[str, Page]:
    """The recalculated workbook, by what was typed."""
    folder = tmp_path_factory.mktemp("typed")
    names = list(TYPED) if request.param == "formualizer" else FOR_ALL
    paths = []
    for number, name in enumerate(names):
        values: dict[str, float | str | None] = {}
        for over, n, text in re.findall(r"(over )?(\S+) = ?([^,]*)", name):
            key = f"inputs.{n}" if over or n == "from" else f"inputs.{n}.typed"
            key = n if "." in n else key
            typed = float(text) if re.match(r"-?\d", text) else text
            values[key] = None if text == "nothing" else typed
        paths.append(emitted.typed(values, folder / f"{number}.xlsx"))
    result = usable(request.param).recalculate_many(paths)
    return {name: Page(emitted, values) for name, values in zip(names, result, strict=True)}


def test_what_the_workbook_says(pages: dict[str, Page]) -> None:
    """For each program in one test, since it recalculates all files at once."""
    report = pages["nothing"]
    for name, page in pages.items():
        in_row = "row" in name and name.endswith("text")  # makes errors of the rows below it
        assert bool([*page.errors]) == in_row, name
        assert page.described(None if page is report else report) == TYPED[name], name
        # What is not computed is not called wrong.
        assert page.verdicts(OTHERWISE) <= FAILING or not page["inputs.unusable"], name
        assert page["audit.none"] == len(page.verdicts(NOT_COMPUTED)), name
        about_craters = name in ("CV_PV = 0.6", "HB_ratio = nothing")
        assert page["high.depth_um"] == report["high.depth_um"] or not about_craters
    # With the switch, the workbook is again that of the report's inputs.
    switched = pages[FOR_ALL[-1]]
    another = {f"inputs.{name}.typed" for name in ("V_impact", "rho_t", "beta_high")}
    of_switch = {"inputs.from", "inputs.taken", "inputs.message"}
    for key in report.emitted.book.values.keys() - another - of_switch:
        assert switched[key] == report[key], key


def test_a_given_resistance_is_called_so_until_that_of_the_report_is_taken(
    engine: Engine, files: dict[str, Any], tmp_path: Path
) -> None:
    given, switched = files["resistance given"], {"inputs.from": "report"}
    typed = {
        "yours": ("R_t as given", {}),
        "report": ("R_t as in the report", switched),
        "over": ("R_t as given", switched | {"inputs.R_t": 2e9}),
    }
    paths = [given.typed(cells, tmp_path / f"{k}.xlsx") for k, (_, cells) in typed.items()]
    for (words, _), result in zip(typed.values(), engine.recalculate_many(paths), strict=True):
        page = Page(given, result)
        assert page["case.label"] == words
        assert page["figure_3.case.message"] == f"{words}: {page['case.message']}"


def test_blank_inputs_leave_no_error_and_no_false_verdict(emitted: Any, tmp_path: Path) -> None:
    """Every sixth input is left blank, beginning in turn with each of the first six."""
    names, paths = [key for key in emitted.book.values if key.endswith(".typed")], []
    for first in range(6):
        blank = dict.fromkeys(names[first::6])
        paths.append(emitted.typed(blank, tmp_path / f"{first}.xlsx"))
    for first, result in enumerate(usable("formualizer").recalculate_many(paths)):
        page = Page(emitted, result)
        assert [*page.errors] == []
        assert page.verdicts(OTHERWISE) <= FAILING
        assert page["inputs.unusable"] == len(names[first::6])
