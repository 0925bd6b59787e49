"""Which room may import which: read from the source, not from what happens to be loaded."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
ROOMS = ("reference", "spreadsheets", "replication")
FORBIDDEN = {
    "reference": {"spreadsheets", "replication"},
    "spreadsheets": {"replication"},
    "replication": set(),
}
MODELS = sorted((ROOT / "replication" / "models").glob("*.py"))
NOT_FOR_MODELS = {
    "mpmath",
    "flint",
    "openpyxl",
    "xlsxwriter",
    "ironcalc",
    "formualizer",
    "spreadsheets",
    "reference",
}


def imports(path: Path) -> set[str]:
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative imports hide where they lead"
            found.add(str(node.module))
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return found


def sources(room: str) -> list[Path]:
    found = sorted((ROOT / room).rglob("*.py"))
    assert found, f"no source in {room}: the test would pass on anything"
    return found


@pytest.mark.parametrize("room", ROOMS)
def test_rooms_import_only_along_the_arrows(room: str) -> None:
    for path in sources(room):
        packages = {name.partition(".")[0] for name in imports(path)}
        assert not packages & FORBIDDEN[room], path


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.stem)
def test_models_stand_alone(path: Path) -> None:
    names = imports(path)
    assert not {name.partition(".")[0] for name in names} & NOT_FOR_MODELS
    ours = {name for name in names if name.partition(".")[0] == "replication"}
    assert all(name.startswith("replication.models") for name in ours)


def test_the_sheet_knows_no_closed_form() -> None:
    names = imports(ROOT / "replication" / "models" / "sheet.py")
    assert {name for name in names if name.startswith("replication")} == {
        "replication.models.impact",
        "replication.models.impact.Impact",
        "replication.models.impact.particle_mass",
    }


def test_models_are_found() -> None:
    assert {"impact", "sheet", "depth", "motion", "arrays"} <= {path.stem for path in MODELS}


HEAVY = {
    "pandas", "mpmath", "flint", "pint", "xlsxwriter", "openpyxl", "matplotlib", "jinja2", "scipy",
    "tqdm", "numba", "numpy", "pyarrow", "heyoka", "dask", "xarray",
}  # fmt: skip


@pytest.mark.parametrize(
    ("arguments", "unwanted"),
    [
        (["--help"], HEAVY),
        (["depth"], HEAVY),
        (["sheet"], HEAVY),
        (["history"], HEAVY),
    ],
    ids=["help", "depth", "sheet", "history"],
)
def test_light_commands_load_no_heavy_library(arguments: list[str], unwanted: set[str]) -> None:
    program = (
        "import sys\n"
        "from replication.cli import main\n"
        "try: main(sys.argv[1:])\n"
        "except SystemExit: pass\n"
        "print(*sys.modules, file=sys.stderr)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, *arguments], capture_output=True, text=True, check=True
    )
    assert not unwanted & set(done.stderr.split())
