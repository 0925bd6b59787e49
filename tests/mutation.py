"""How many wrong versions of the core the tests notice: a seeded sample of mutants, and its score.

    python tests/mutation.py --sample 100 --seed 1

Each mutant is one small change of one module: another comparison, operator, number or condition.
The tests that belong to the module run on a copy of the project, and then, if they pass, all of
them. A mutant that no test notices is printed with its change. Run it by hand: it takes minutes.
"""

import argparse
import ast
import difflib
import random
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parent.parent
TESTS = {
    "reference/printed.py": "tests/reference/test_printed.py",
    "reference/intervals.py": "tests/reference/test_intervals.py",
    "reference/enclosure.py": "tests/reference/test_enclosure.py",
    "reference/equations.py": "tests/reference/test_equations.py",
    "reference/derivations.py": "tests/reference/test_derivations.py",
    "replication/models": "tests/replication",
    "replication/audit/verdict.py": "tests/replication/test_verdict.py",
    "replication/audit/inference.py": "tests/replication/test_inference.py",
    "replication/check": "tests/replication",
}
"""The core -> the tests that are to notice first."""

_COMPARISONS = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt,
                ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
                ast.In: ast.NotIn, ast.NotIn: ast.In}  # fmt: skip
_OPERATORS = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
              ast.Pow: ast.Mult}  # fmt: skip


def mutants(source: str) -> Iterator[str]:
    """Every version of a module that differs from it in one place."""
    for place, node in enumerate(ast.walk(ast.parse(source))):
        for change in _changes(node):
            tree = ast.parse(source)
            target = next(n for k, n in enumerate(ast.walk(tree)) if k == place)
            change(target)
            yield ast.unparse(tree)


def _changes(node: ast.AST) -> Iterator:
    match node:
        case ast.Compare(ops=[operation]) if type(operation) in _COMPARISONS:
            yield lambda n: setattr(n, "ops", [_COMPARISONS[type(operation)]()])
        case ast.BinOp(op=operation) if type(operation) in _OPERATORS:
            yield lambda n: setattr(n, "op", _OPERATORS[type(operation)]())
        case ast.BoolOp(op=operation):
            other = ast.Or if isinstance(operation, ast.And) else ast.And
            yield lambda n: setattr(n, "op", other())
        case ast.UnaryOp(op=ast.Not()):
            yield lambda n: setattr(n, "op", ast.UAdd())
        case ast.Constant(value=bool() as value):
            yield lambda n: setattr(n, "value", not value)
        case ast.Constant(value=int() | float() as value):
            yield lambda n: setattr(n, "value", value + 1)


def survives(module: Path, mutant: str, copy: Path, tests: str) -> bool:
    """Whether all tests pass with a mutant in the place of a module."""
    original = (copy / module).read_text("utf-8")
    (copy / module).write_text(mutant, "utf-8")
    try:
        return all(_pass(copy, which) for which in (tests, "tests"))
    finally:
        (copy / module).write_text(original, "utf-8")


def _pass(copy: Path, tests: str) -> bool:
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", tests]
    try:
        done = subprocess.run(command, cwd=copy, capture_output=True, timeout=900, check=False)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


def main() -> None:
    """Run a sample and print its score."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--sample", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    everything = []
    for name, tests in TESTS.items():
        paths = sorted((ROOT / name).rglob("*.py")) if (ROOT / name).is_dir() else [ROOT / name]
        for path in paths:
            source = path.read_text("utf-8")
            original = ast.unparse(ast.parse(source))
            everything += [
                (path.relative_to(ROOT), original, mutant, tests)
                for mutant in mutants(source)
                if mutant != original
            ]
    chosen = random.Random(options.seed).sample(everything, min(options.sample, len(everything)))
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "project"
        shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(".git", ".venv", "*.egg-info"))
        killed = 0
        for number, (module, original, mutant, tests) in enumerate(chosen, start=1):
            if survives(module, mutant, copy, tests):
                lines = difflib.unified_diff(
                    original.split("\n"), mutant.split("\n"), str(module), "mutant", "", "", 1, ""
                )
                print("\n".join(lines), "\n")
            else:
                killed += 1
            print(f"{number} of {len(chosen)}: {killed} noticed", flush=True)
    print(f"{killed} of {len(chosen)} mutants noticed ({100 * killed / len(chosen):.0f} %)")


if __name__ == "__main__":
    main()
