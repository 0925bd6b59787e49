"""Which room may import which: read from the source, not from what happens to be loaded."""

import ast
import subprocess
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
ROOMS = ("reference", "replication", "spreadsheets")
EVERY = sorted(path for room in ROOMS for path in (ROOT / room).rglob("*.py"))

FLOORS: tuple[set[str], ...] = (
    {"models", "reading", "text"},
    {"cases"},
    {"error"},
    {"audit"},
    {"workbook", "power"},
    {"bench", "sweep", "check", "report"},
    {"cli"},
    {"__main__"},
)
"""The rooms of `replication`, from the ground up: each imports from lower floors only."""

PUBLIC = {"audit", "cases", "models"}
"""What `replication` itself hands on as its public names."""


def module_of(path: Path) -> str:
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


MODULES = {module_of(path) for path in EVERY}


def imports(path: Path) -> Iterator[str]:
    """Our modules, and other packages, that a file imports anywhere in it."""
    yield from _names(ast.walk(ast.parse(path.read_text("utf-8"))))


def _names(nodes: Iterable[ast.AST]) -> Iterator[str]:
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
    """`reference`, `spreadsheets`, or the part of `replication` that a module belongs to."""
    package, _, rest = module.partition(".")
    return rest.partition(".")[0] if package == "replication" else package


def floor(name: str) -> int:
    (level,) = (level for level, names in enumerate(FLOORS) if name in names)
    return level


def ours(path: Path) -> set[str]:
    return {name for name in imports(path) if name in MODULES}


def test_sources_are_found_and_imports_lead_to_modules() -> None:
    assert {"reference.ledger", "replication.models.sheet", "spreadsheets.plan"} <= MODULES
    for path in EVERY:
        lost = {n for n in imports(path) if n.partition(".")[0] in ROOMS} - MODULES
        assert not lost, path


@pytest.mark.parametrize(
    ("package", "allowed"),
    [
        ("reference", {"reference"}),
        ("spreadsheets", {"spreadsheets", "reference"}),
        ("replication.models", {"models"}),
        ("replication.audit", {"reference", "audit", "models", "text"}),
    ],
)
def test_what_a_package_may_import_of_ours(package: str, allowed: set[str]) -> None:
    inside = [path for path in EVERY if f"{module_of(path)}.".startswith(f"{package}.")]
    assert len(inside) > 5
    for path in inside:
        assert {room(name) for name in ours(path)} <= allowed, path


def test_the_sheet_knows_no_closed_form() -> None:
    path = ROOT / "replication" / "models" / "sheet.py"
    assert ours(path) == {"replication.models.impact"}


@pytest.mark.parametrize("path", EVERY, ids=module_of)
def test_arrows_inside_replication_run_down(path: Path) -> None:
    own, below = module_of(path), {name for name in ours(path) if name.startswith("replication.")}
    if own == "replication":
        assert {room(name) for name in below} <= PUBLIC
    elif own.startswith("replication."):
        level, others = floor(room(own)), {room(name) for name in below} - {room(own)}
        assert all(floor(name) < level for name in others), (own, others)


def at_the_top(path: Path) -> set[str]:
    """Our modules that are loaded as the file is, not where they are used."""
    tree = ast.parse(path.read_text("utf-8"))
    outer = [node for node in tree.body if isinstance(node, ast.Import | ast.ImportFrom)]
    return set(_names(outer)) & MODULES


def test_no_circles_between_modules() -> None:
    waiting = {module_of(path): at_the_top(path) for path in EVERY}
    while waiting:
        ready = {name for name, needed in waiting.items() if not needed & set(waiting)}
        assert ready, f"these import each other: {sorted(waiting)}"
        for name in ready:
            del waiting[name]


HEAVY = {
    "dask", "flint", "formualizer", "heyoka", "ironcalc", "jinja2", "matplotlib", "mpmath", "numba",
    "numpy", "openpyxl", "pandas", "pint", "pyarrow", "scipy", "tqdm", "uno", "xarray",
    "xlsxwriter",
}  # fmt: skip
LOADED = "import atexit, sys; atexit.register(lambda: print(*sys.modules, file=sys.stderr)); "


COMMANDS = [("replication.cli", f"main(['{n}'])") for n in ("--help", "depth", "sheet", "history")]


@pytest.mark.parametrize(("module", "use"), [("spreadsheets.engines", "ENGINES"), *COMMANDS])
def test_what_is_light_loads_no_heavy_library(module: str, use: str) -> None:
    program = f"{LOADED}import {module}; {module}.{use}"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, check=True)
    loaded = set(done.stderr.decode().split())
    assert module in loaded
    assert not loaded & HEAVY
