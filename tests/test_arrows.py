"""Check which package imports which: in the source, not in what happens to be loaded."""

import ast
import subprocess
import sys
from collections.abc import Iterable, Iterator
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
ROOMS = ("reference", "replication", "spreadsheets")
EVERY = sorted(path for room in ROOMS for path in (ROOT / room).rglob("*.py"))

FLOORS: tuple[set[str], ...] = (
    {"reference"},
    {"models"},
    {"spreadsheets", "page", "user_input", "text", "separated"},
    {"cases", "columns"},
    {"asked_unit", "error", "fit", "solve"},
    {"audit", "misfit"},
    {"workbook", "power", "plots"},
    {"bench", "sweep", "check", "report"},
    {"cli"},
    {"__main__", ""},
)
"""The packages, those in `replication` by their own names: each imports from lower floors only."""

ONLY = {
    "spreadsheets": {"reference"},
    "audit": {"reference", "models", "user_input", "text"},
    "": {"audit", "cases", "models"},  # the homes of the public names of `replication`
}
"""Packages that may import fewer than all lower floors, and which."""


def module_of(path: Path) -> str:
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


MODULES = {module_of(path) for path in EVERY}


def imports(nodes: Iterable[ast.AST]) -> Iterator[str]:
    """Yield the modules of this project, and the other packages, that these nodes import."""
    for node in nodes:
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "relative imports hide where they lead"
            assert node.module is not None
            for alias in node.names:
                name = f"{node.module}.{alias.name}"
                yield name if name in MODULES else node.module


def room(module: str) -> str:
    package, _, rest = module.partition(".")
    return rest.partition(".")[0] if package == "replication" else package


def ours(path: Path) -> set[str]:
    """Return the modules of this project that a file imports anywhere; each must exist."""
    imported = imports(ast.walk(ast.parse(path.read_text("utf-8"))))
    own = {name for name in imported if name.partition(".")[0] in ROOMS}
    assert own <= MODULES, path
    return own


def test_sources_are_found() -> None:
    assert {"reference.ledger", "replication.models.sheet", "spreadsheets.plan"} <= MODULES


def test_the_public_module_only_passes_names_on() -> None:
    assert {name.partition(".")[0] for name in ours(ROOT / "coldspray.py")} == {"replication"}


def test_the_sheet_knows_no_closed_form() -> None:
    path = ROOT / "replication" / "models" / "sheet.py"
    assert ours(path) == {"reference.scheme", "replication.models.impact"}


@pytest.mark.parametrize("path", EVERY, ids=module_of)
def test_arrows_run_down(path: Path) -> None:
    own = room(module_of(path))
    (level,) = (level for level, rooms in enumerate(FLOORS) if own in rooms)
    below = ONLY.get(own, set().union(*FLOORS[:level]))
    assert {room(name) for name in ours(path)} <= below | {own}


def test_the_models_share_nothing_that_computes_with_the_reference() -> None:
    """They share the names of the schemes, and how a signal waits. Were it more, they could no
    longer be a check on it."""
    models = (ROOT / "replication" / "models").glob("*.py")
    shared = {name for path in models for name in ours(path) if room(name) == "reference"}
    assert shared == {"reference.scheme", "reference.signals"}


def test_no_circles_between_modules() -> None:
    """Imports inside functions count, too: they hide a circle, but do not break it."""
    TopologicalSorter({module_of(path): ours(path) for path in EVERY}).prepare()


HEAVY = {
    "dask", "flint", "formualizer", "heyoka", "ironcalc", "jinja2", "matplotlib", "mpmath", "numba",
    "numpy", "openpyxl", "pandas", "pint", "pyarrow", "scipy", "tqdm", "uno", "xarray",
    "xlsxwriter",
}  # fmt: skip
LOADED = "import atexit, sys; atexit.register(lambda: print(*sys.modules, file=sys.stderr)); "


COMMANDS = [("replication.cli", f"main(['{n}'])") for n in ("--help", "depth", "sheet", "history")]


@pytest.mark.parametrize(
    ("module", "use"), [("spreadsheets.engines", "ENGINES"), ("coldspray", "BETA_5"), *COMMANDS]
)
def test_what_is_light_loads_no_heavy_library(module: str, use: str) -> None:
    program = f"{LOADED}import {module}; {module}.{use}"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, check=True)
    loaded = set(done.stderr.decode().split())
    assert module in loaded
    assert not loaded & HEAVY
