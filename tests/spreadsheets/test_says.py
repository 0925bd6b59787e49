"""What the workbook says once somebody works with it: in real engines, with typed inputs."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from workbooks import usable

from reference.ledger import load
from spreadsheets.engines import Values
from spreadsheets.plan import NOT_COMPUTED, Value
from spreadsheets.sheets import OTHERWISE

KEPT = Path(__file__).with_name("says.txt").read_text("utf-8").split("\n$ ")[1:]
TYPED = {case.partition("\n")[0]: case.partition("\n")[2].strip() for case in KEPT}
"""What is typed, by the name of the input and in its unit -> what then stands where."""
FOR_ALL = (
    "nothing", "V_impact = nothing", "R_p = eleven", "HB_ratio = nothing",
    "dt_s = 0.05, dt_coarse = 0.05", "dt_s = 40.0", "V_impact = 0.5", "beta_high = 4.0",
    "from = report, V_impact = 600.0, rho_t = 0.0, beta_high = 4.0",
)  # fmt: skip
"""What every program is given; the fastest is given all."""

SHOWN = re.compile(
    r"(overview|inputs|low|high|low_coarse|high_coarse|convergence|figure_\d)\.(?!.*(typed|row))[^\[]*"
    r"|audit\.(.*\.verdict|none)"
)
COUNTED = re.compile(r".*\b(trust|steps|\w*unusable|\w*changed|\w*none|same\.\w+)")


def number_or_text(text: str) -> float | str | None:
    return float(text) if re.match(r"-?\d", text) else None if text == "nothing" else text


FAILING = {"frank-zook-rha", "frank-zook-stainless"}
"""What is not as printed with the report's own inputs."""


@dataclass(frozen=True)
class Page:
    """A recalculated workbook, read by key."""

    emitted: Any
    result: Values

    def __getitem__(self, key: str) -> Value:
        sheet, address = self.emitted.book.plan.where[key]
        return self.result[sheet].get(address, "")

    def verdicts(self, verdict: str) -> set[str]:
        return {name for name in self.computed if self[f"audit.{name}.verdict"] == verdict}

    @property
    def computed(self) -> list[str]:
        return [claim.id for claim in load().claims.values() if claim.workbook]

    def told(self, usual: Page | None) -> str:
        """Each text, and what it is told of; but for numbers, and what is as usual."""
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
    request: pytest.FixtureRequest,
    emitted: Any,
    tmp_path_factory: pytest.TempPathFactory,
) -> dict[str, Page]:
    """The workbook with each of these typed, recalculated."""
    folder = tmp_path_factory.mktemp("typed")
    names = list(TYPED) if request.param == "formualizer" else FOR_ALL
    paths = []
    for number, name in enumerate(names):
        typed = dict(re.findall(r"(\w+) = ?([^,]*)", name))
        keys = {n: f"inputs.{n}" if n == "from" else f"inputs.{n}.typed" for n in typed}
        values = {keys[n]: number_or_text(text) for n, text in typed.items()}
        paths.append(emitted.typed(values, folder / f"{number}.xlsx"))
    result = usable(request.param).recalculate_many(paths)
    return {name: Page(emitted, values) for name, values in zip(names, result, strict=True)}


def test_what_the_workbook_says(pages: dict[str, Page]) -> None:
    """One test for each program, which recalculates all the files once."""
    report = pages["nothing"]
    for name, page in pages.items():
        assert [*page.errors][:3] == [], name
        assert page.told(None if page is report else report) == TYPED[name], name
        # What is not computed is called so, and not wrong.
        assert page.verdicts(OTHERWISE) <= FAILING or not page["inputs.unusable"], name
        assert page["audit.none"] == len(page.verdicts(NOT_COMPUTED)), name
        about_craters = name in ("CV_PV = 0.6", "HB_ratio = nothing")
        assert page["high.depth_um"] == report["high.depth_um"] or not about_craters
    # The switch brings the report's inputs back.
    switched = pages[FOR_ALL[-1]]
    another = {f"inputs.{name}.typed" for name in ("V_impact", "rho_t", "beta_high")}
    of_switch = {"inputs.from", "inputs.taken", "inputs.message"}
    for key in report.emitted.book.values.keys() - another - of_switch:
        assert switched[key] == report[key], key


def test_blank_inputs_leave_no_error_and_no_false_verdict(emitted: Any, tmp_path: Path) -> None:
    """Every sixth input is left blank, so that each formula lacks one of its own here or there."""
    names, paths = [key for key in emitted.book.values if key.endswith(".typed")], []
    for first in range(6):
        blank = dict.fromkeys(names[first::6])
        paths.append(emitted.typed(blank, tmp_path / f"{first}.xlsx"))
    for first, result in enumerate(usable("formualizer").recalculate_many(paths)):
        page = Page(emitted, result)
        assert [*page.errors] == []
        assert page.verdicts(OTHERWISE) <= FAILING
        assert page["inputs.unusable"] == len(names[first::6])
