"""How many wrong versions of the core the tests notice: a seeded sample of mutants, and its score.

    python tests/mutation.py --sample 60 --seed 1

Each mutant is one small change of one module: another comparison, operator, number or condition.
The module's own examples and tests run on a copy of the project, and then, if they pass, those of
the whole core. A mutant that no test notices is printed with its change: it does no harm, or a
test is missing. Run it by hand: it takes minutes.
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
REFERENCE, AUDIT = "tests/reference/test_", "tests/replication/test_"
OWN = {
    **{f"reference/{name}.py": f"{REFERENCE}{name}.py" for name in (
        "arithmetic", "computations", "enclosure", "equations", "findings", "ledger", "motion",
        "printed", "units")},
    "reference/intervals.py": f"{REFERENCE}enclosure.py",
    "reference/derivations.py": f"{AUDIT}equations.py",
    "replication/audit/audit.py": f"{AUDIT}claims.py",
    "replication/audit/comparison.py": f"{AUDIT}comparison.py",
    "replication/audit/edits.py": f"{AUDIT}explanations.py",
    "replication/audit/equations.py": f"{AUDIT}equations.py",
    "replication/audit/explain.py": f"{AUDIT}explanations.py",
    "replication/audit/findings.py": f"{AUDIT}findings.py",
    "replication/audit/inference.py": f"{AUDIT}inference.py",
    "replication/audit/replica.py": f"{AUDIT}verdict.py",
    "replication/audit/screen.py": f"{AUDIT}explanations.py",
    "replication/audit/verdict.py": f"{AUDIT}verdict.py",
}  # fmt: skip
"""The core -> the tests that are to notice first."""

CORE = [
    "tests/reference",
    "tests/test_recheck.py",
    *sorted({p for p in OWN.values() if AUDIT in p}),
]
"""The tests that are to notice at last."""

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
            opposite = ast.Or if isinstance(operation, ast.And) else ast.And
            yield lambda n: setattr(n, "op", opposite())
        case ast.IfExp() | ast.If():
            yield lambda n: setattr(n, "test", ast.UnaryOp(ast.Not(), n.test))
        case ast.Constant(value=bool() as value):
            yield lambda n: setattr(n, "value", not value)
        case ast.Constant(value=int() | float() as value):
            yield lambda n: setattr(n, "value", value + 1)


def passes(copy: Path, tests: list[str]) -> bool:
    """Whether tests pass on the copy; those that run for ten minutes do not."""
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *tests]
    try:
        done = subprocess.run(command, cwd=copy, capture_output=True, timeout=600, check=False)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


def survives(module: str, mutant: str, copy: Path) -> bool:
    """Whether all tests pass with a mutant in the place of a module."""
    original = (copy / module).read_text("utf-8")
    (copy / module).write_text(mutant, "utf-8")
    try:
        return passes(copy, ["-n0", module, OWN[module]]) and passes(copy, CORE)
    finally:
        (copy / module).write_text(original, "utf-8")


def main() -> None:
    """Run a sample and print its score."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--sample", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("modules", nargs="*", default=list(OWN), help="such as reference/units.py")
    options = parser.parse_args()
    everything = []
    for module in options.modules:
        source = (ROOT / module).read_text("utf-8")
        everything += [(module, source, mutant) for mutant in mutants(source)]
    chosen = random.Random(options.seed).sample(everything, min(options.sample, len(everything)))
    print(f"{len(chosen)} of {len(everything)} mutants, seed {options.seed}", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "project"
        shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(".*", "*.egg-info"))
        if not passes(copy, CORE):
            parser.exit(2, "The tests fail without a mutant: nothing to learn.\n")
        killed = 0
        for number, (module, source, mutant) in enumerate(chosen, start=1):
            if survives(module, mutant, copy):
                texts = (ast.unparse(ast.parse(source)).split("\n"), mutant.split("\n"))
                print("\n".join(difflib.unified_diff(*texts, module, "mutant", "", "", 1, "")))
            else:
                killed += 1
            print(f"{number} of {len(chosen)}: {killed} noticed", flush=True)
    print(f"{killed} of {len(chosen)} mutants noticed ({100 * killed / len(chosen):.0f} %)")


if __name__ == "__main__":
    main()
