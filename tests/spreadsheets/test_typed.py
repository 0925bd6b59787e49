"""What the workbook says after something is typed into it: nothing false, in several programs."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from workbooks import FASTEST, usable

from spreadsheets.engines import Engine
from spreadsheets.plan import NOT_AVAILABLE, NOT_COMPUTED, ShownValue
from spreadsheets.sheets.messages import (
    CHANGED,
    COMPLETE,
    CURRENT,
    DOUBTFUL,
    EARLY,
    IGNORED,
    INPUTS_SAY,
    KEEPS_NAME,
    NO_BETA,
    NO_CHOICE,
    NO_RUN,
    NO_STEPS,
    NOT_COARSER,
    NOT_SOLVED,
    ONE_STEP,
    OUT_OF_BOTH,
    OUT_OF_ROWS,
    POINTS_MISSING,
    REVERSED,
    RUN_SAYS,
    STALE,
    STEP_TOO_LONG,
    UNCHANGED,
    UNUSABLE,
)

SUFFIXES = ("_low", "_high", "_low_coarse", "_high_coarse")


@dataclass(frozen=True)
class Said:
    """What the workbook must say: the messages of its four runs, and what else is not as usual.

    typed: contents of cells by key; an input's is its name, in the unit of its cell. changed: how
    many inputs in use are not the report's. labels, notes: of the runs that have other ones.
    """

    typed: Mapping[str, float | str | None]
    runs: Sequence[str]
    changed: int
    stale: bool = True
    labels: Mapping[str, str] = field(default_factory=dict)
    notes: Mapping[str, str] = field(default_factory=dict)
    also: Mapping[str, ShownValue] = field(default_factory=dict)

    @property
    def cells(self) -> dict[str, float | str | None]:
        """What is typed, by the key of its cell."""
        return {name if "." in name else f"{name}.typed": text for name, text in self.typed.items()}


BOTH_COARSE = {"_low_coarse": NOT_COARSER, "_high_coarse": NOT_COARSER}
HIGH = {"_high": KEEPS_NAME, "_high_coarse": KEEPS_NAME}
USUAL = (COMPLETE, REVERSED, COMPLETE, COMPLETE)

SCENARIOS = {
    "nothing": Said({}, USUAL, 0, stale=False),
    "no number of rows suffices": Said(
        {"dt_s": 0.05, "dt_coarse": 0.05}, [OUT_OF_ROWS] * 4, 2, notes=BOTH_COARSE
    ),
    "one step": Said(
        {"dt_s": 40.0}, (ONE_STEP, ONE_STEP, COMPLETE, COMPLETE), 1, notes=BOTH_COARSE
    ),
    "a step too long": Said(
        {"dt_s": 12.0}, (STEP_TOO_LONG, STEP_TOO_LONG, COMPLETE, COMPLETE), 1, notes=BOTH_COARSE,
        also={"steps_low": 3.0, "steps_high": 3.0},
    ),
    # Δt V/R is 0.1, the longest step that is not too long, and in doubles a little more.
    "the longest step": Said(
        {"V_impact": 400.0, "R_p": 8.0, "dt_s": 2.0}, [REVERSED] * 4, 3, notes=BOTH_COARSE,
        also={"travel_low": 0.1 + 2**-56, "too_long_low": 0.0},
    ),
    "another stop": Said({"v_stop": 2.0}, [COMPLETE] * 4, 1, also={"steps_high": 130.0}),
    "a stop long before rest": Said({"v_stop": 100.0}, [EARLY] * 4, 1),
    "a stop just below the impact": Said(
        {"v_stop": 499.9}, (DOUBTFUL, DOUBTFUL, ONE_STEP, ONE_STEP), 1
    ),
    "an impact below the stop": Said(
        {"V_impact": 0.5}, [NO_STEPS] * 4, 1,
        also={"steps_low": 0.0, "depth_um_low": 0.0, "over_stop_low": NOT_AVAILABLE},
    ),
    "an impact at the stop": Said({"V_impact": 1.0}, [ONE_STEP] * 4, 1),
    "another beta": Said(
        {"beta_high": 4.0}, (COMPLETE, COMPLETE, COMPLETE, REVERSED), 1,
        labels={"_high": "β = 4", "_high_coarse": "β = 4"}, notes=HIGH,
        also={"steps_high": 149.0, "steps_high_coarse": 60.0},
    ),
    "the same resistance by other numbers": Said(
        {"Y_t": 350.0, "beta_low": 6.0, "beta_high": 10.0}, USUAL, 3,
        labels=dict(zip(SUFFIXES, ["β = 6", "β = 10"] * 2, strict=True)),
        notes=dict.fromkeys(SUFFIXES, KEEPS_NAME),
    ),
    "a small slow particle": Said(
        {"V_impact": 20.0, "rho_p": 2700.0, "R_p": 2.5, "dt_s": 2.5},
        (REVERSED, ONE_STEP, REVERSED, REVERSED), 4, notes=BOTH_COARSE,
    ),
    "a coarse step that is finer": Said(
        {"dt_coarse": 0.1}, USUAL, 1, stale=False, notes=BOTH_COARSE
    ),
    "a coarse step too long": Said(
        {"dt_coarse": 20.0}, (COMPLETE, REVERSED, STEP_TOO_LONG, STEP_TOO_LONG), 1, stale=False
    ),
    "another mean particle": Said({"D_mean": 30.0}, USUAL, 1, stale=False),
    "a radius that is almost the report's": Said(
        {"R_p": 11.05}, (COMPLETE, COMPLETE, REVERSED, REVERSED), 1
    ),
    "a long rod's inputs": Said(
        {"V_impact": 2000.0, "rho_p": 19300.0, "rho_t": 2700.0, "Y_t": 50.0, "dt_s": 1.0},
        (OUT_OF_BOTH, OUT_OF_BOTH, OUT_OF_ROWS, OUT_OF_ROWS), 5, notes=BOTH_COARSE,
    ),
    "a choice that is none": Said(
        {"inputs.choice": "mine", "V_impact": 600.0}, (COMPLETE, REVERSED, REVERSED, COMPLETE), 1,
        also={"inputs.no_choice": NO_CHOICE, "inputs_from": "yours"},
    ),
    "the report's inputs": Said(
        {"inputs.choice": "report", "V_impact": 600.0, "rho_t": 0.0, "beta_high": "four"},
        USUAL, 0, stale=False, also={"inputs_from": "report", "inputs.message": IGNORED},
    ),
}  # fmt: skip

IN_EVERY_PROGRAM = [
    "nothing", "no number of rows suffices", "another beta", "the report's inputs",
]  # fmt: skip
"""Scenarios for every program; all are for the fastest."""


def test_what_the_workbook_says_of_numbers_that_can_be_used(
    engine: Engine, emitted: Any, tmp_path: Path
) -> None:
    """For each program in one test, since it recalculates all files at once."""
    check_words(engine, emitted, IN_EVERY_PROGRAM, tmp_path)


@pytest.mark.slow
def test_what_the_workbook_says_in_every_scenario(emitted: Any, tmp_path: Path) -> None:
    check_words(usable(FASTEST), emitted, list(SCENARIOS), tmp_path)


def check_words(engine: Engine, emitted: Any, names: Sequence[str], tmp_path: Path) -> None:
    pages = emitted.recalculated(engine, [SCENARIOS[name].cells for name in names], tmp_path)
    for name, page in zip(names, pages, strict=True):
        said = SCENARIOS[name]
        for run, s in zip(said.runs, SUFFIXES, strict=True):
            label = said.labels.get(s, "β = 3" if "low" in s else "β = 5")
            assert page[f"label{s}"] == label, (name, s)
            assert page[f"message{s}"] == run, (name, s)
            assert page[f"overview.{s[1:]}.message"] == f"{label}: {run}", (name, s)
            assert page[f"{s[1:]}.renamed"] == said.notes.get(s, ""), (name, s)
            finished = run not in (OUT_OF_ROWS, OUT_OF_BOTH)
            assert (page[f"depth_um{s}"] == NOT_AVAILABLE) != finished, (name, s)
            said_in_cells = {page[f"says_{part}{s}"] for part in RUN_SAYS} - {"", NOT_AVAILABLE}
            assert said_in_cells == {run}, (name, s)
            assert page[f"trust{s}"] == float(run in (COMPLETE, EARLY, REVERSED)), (name, s)
        message = CHANGED if said.changed else UNCHANGED
        expected = {
            "inputs_changed": float(said.changed),
            "inputs_unusable": 0.0,
            "inputs.message": message,
            "convergence.message": STALE if said.stale else CURRENT,
            **said.also,
        }
        assert {key: page[key] for key in expected} == expected, name
        assert page.errors == {}, name
    # With the switch, the workbook is again that of the report's inputs.
    usual, switched = (pages[names.index(name)] for name in ("nothing", "the report's inputs"))
    typed = {
        f"{n}.{end}" for n in ("V_impact", "rho_t", "beta_high") for end in ("typed", "number")
    }
    of_choice = {
        "inputs.choice", "inputs.chosen", "inputs_from", "inputs.message", "is_ignored",
        "is_unchanged", "says_ignored", "says_unchanged",
    }  # fmt: skip
    keys = emitted.book.values.keys() - typed - of_choice
    assert {key: switched[key] for key in keys} == {key: usual[key] for key in keys}


# Inputs that cannot be used

UNUSABLE_INPUTS: Mapping[str, tuple[float | str | None, str]] = {
    "blank": (None, "no number"),
    "zero": (0.0, "too small"),
    "negative": (-1.0, "too small"),
    "text": ("eleven", "no number"),
    "error": ("#DIV/0!", "no number"),
    "huge": (1e300, "too large"),
    "tiny": (1e-300, "too small"),
}
"""What is typed, by its kind, and what column E says of it."""

CAN_BE_USED = {("v_stop", "zero"), ("v_stop", "tiny")}


def check_unusable(page: Any, usual: Any, bad: Mapping[str, str]) -> None:
    """Assert that nothing that depends on an unusable input shows a number or says more.

    bad: the kind of what is typed, by input. All cells that do not depend on one are as usual.
    """
    plan = page.book.plan
    reached = plan.dependents([plan.where[f"{name}.typed"] for name in bad])
    keys = {plan.cells[place].key for place in reached if plan.cells[place].formula}
    wrong = {key: page[key] for key in keys if page[key] not in allowed(key, page, bad)}
    assert wrong == {}
    others = {key for key, cell in ((c.key, c) for c in plan.cells.values()) if cell.formula} - keys
    assert {k: page[k] for k in others if page[k] != usual[k]} == {}
    typed = {plan.where[f"{name}.typed"] for name in bad}
    assert page.errors.keys() <= typed


def allowed(key: str, page: Any, bad: Mapping[str, str]) -> set[ShownValue]:
    """Return what a cell may show that depends on an unusable input."""
    name, _, ending = key.rpartition(".")
    if name in bad:
        return allowed_beside(ending, *UNUSABLE_INPUTS[bad[name]])
    if key.startswith("is_") and key.removeprefix("is_") in INPUTS_SAY:
        return {float(key == "is_unusable")}
    if key.startswith("trust") or ending == "inputs_changed":
        return {0.0}
    if ending == "inputs_unusable":
        return {float(len(bad))}
    if ending.startswith("audit_"):  # the counts of live verdicts
        words = {"audit_as_printed": "as printed", "audit_otherwise": "not as printed"}
        word = words.get(ending, NOT_COMPUTED)
        shown = [page[f"audit.{claim}.verdict"] for claim in page.book.plan.claims]
        return {float(shown.count(word))}
    if key.startswith("label"):
        return {NO_BETA}
    if re.match(r"overview\.\w+\.message|figure_3\.\w+\.message", key):
        part = name.partition(".")[2]
        return {f"{page[f'label_{part}']}: {page[f'message_{part}']}"}
    said = {
        "inputs.message": UNUSABLE,
        "says_unusable": UNUSABLE,
        "convergence.message": STALE,
        "figure_5.message": POINTS_MISSING,
        "solve.message": NOT_SOLVED,
        "verdict": NOT_COMPUTED,
        "difference": "–",
        "renamed": "",
    }
    if key.startswith("message"):
        return {NO_RUN}
    if text := said.get(key, said.get(ending)):
        return {text}
    # Rows are blank; everything else that is computed is not available.
    return {NOT_AVAILABLE, ""}


def allowed_beside(ending: str, typed: float | str | None, fault: str) -> set[ShownValue]:
    """Return what a cell may show in the row of an input that cannot be used, by its key's end."""
    if ending in ("number", "taken") and isinstance(typed, float):
        return {typed}
    if ending in ("check", "fault"):
        return {fault}
    sides = {"below": "too small", "above": "too large"}
    if ending in sides and fault in sides.values():
        return {fault if fault == sides[ending] else ""}
    return {NOT_AVAILABLE}


def alone(names: Sequence[str], kinds: Sequence[str]) -> list[dict[str, str]]:
    """Return each input alone as one that cannot be used, for each of the kinds."""
    pairs = [(name, kind) for name in names for kind in kinds]
    return [{name: kind} for name, kind in pairs if (name, kind) not in CAN_BE_USED]


def check_each(engine: Engine, emitted: Any, cases: Sequence[Mapping[str, str]], at: Path) -> None:
    """Recalculate and check a workbook for each case."""
    typed = [
        {f"{name}.typed": UNUSABLE_INPUTS[kind][0] for name, kind in case.items()} for case in cases
    ]
    (usual, *pages) = emitted.recalculated(engine, [{}, *typed], at)
    for case, page in zip(cases, pages, strict=True):
        check_unusable(page, usual, case)


def names_of_inputs(emitted: Any) -> list[str]:
    """Return the names of all inputs."""
    return [key.removesuffix(".typed") for key in emitted.book.values if key.endswith(".typed")]


def every_seventh(emitted: Any) -> list[dict[str, str]]:
    """Return seven cases in which every seventh input cannot be used; each kind occurs in each."""
    names, kinds = names_of_inputs(emitted), list(UNUSABLE_INPUTS)
    cases: list[dict[str, str]] = []
    for first in range(7):
        case = {name: kinds[(first + k) % 7] for k, name in enumerate(names[first::7])}
        cases.append({n: k if (n, k) not in CAN_BE_USED else "negative" for n, k in case.items()})
    assert {name for case in cases for name in case} == set(names)
    return cases


def test_nothing_that_hangs_on_unusable_inputs_shows_a_number(
    engine: Engine, emitted: Any, tmp_path: Path
) -> None:
    check_each(engine, emitted, every_seventh(emitted)[:1], tmp_path)


@pytest.mark.slow
def test_nothing_that_hangs_on_any_unusable_input_shows_a_number(
    emitted: Any, tmp_path: Path
) -> None:
    check_each(usable(FASTEST), emitted, every_seventh(emitted), tmp_path)


@pytest.mark.slow
def test_nothing_that_hangs_on_unusable_inputs_shows_a_number_anywhere(
    engine: Engine, emitted: Any, tmp_path: Path
) -> None:
    check_each(engine, emitted, every_seventh(emitted), tmp_path)


def test_nothing_that_hangs_on_one_unusable_input_shows_a_number(
    emitted: Any, tmp_path: Path
) -> None:
    cases = alone(names_of_inputs(emitted), list(UNUSABLE_INPUTS))
    check_each(usable(FASTEST), emitted, cases[::88], tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("kind", UNUSABLE_INPUTS)
def test_each_input_and_each_kind(emitted: Any, tmp_path: Path, kind: str) -> None:
    check_each(usable(FASTEST), emitted, alone(names_of_inputs(emitted), [kind]), tmp_path)


@pytest.mark.slow
def test_each_input_in_every_program(engine: Engine, emitted: Any, tmp_path: Path) -> None:
    """One or two of the seven kinds for each input."""
    cases = alone(names_of_inputs(emitted), list(UNUSABLE_INPUTS))
    check_each(engine, emitted, cases[::6], tmp_path)
