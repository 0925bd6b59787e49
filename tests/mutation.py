"""How many wrong versions of the core the tests notice: a seeded sample of mutants, and its score.

    python tests/mutation.py --sample 160 --seed 1 [reference/printed.py replication/audit ...]

Each mutant is one small change of one module: another comparison, operator, number or condition. On
a copy of the project run the module's examples and the tests called like it, then the tests that
import it, then those that import what imports it; the first failure ends it. A mutant that none
notices is printed with its change: it does no harm, or a test is missing.
"""

import argparse
import ast
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

from test_arrows import EVERY, ROOT, module_of
from test_arrows import ours as read_imports

CORE = ("reference", "replication/models", "replication/audit", "replication/check")
ours = cache(read_imports)
LIMIT = 600
"""Seconds of a processor for tests; a mutant that takes longer is noticed, too."""

_COMPARISONS = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt,
                ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
                ast.In: ast.NotIn, ast.NotIn: ast.In}  # fmt: skip
_OPERATORS = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
              ast.Pow: ast.Mult}  # fmt: skip


def places(tree: ast.Module) -> list[tuple[ast.AST, str, object]]:
    """Every node that can be changed, with what of it is to become what.

    How a class or function is declared is left: nothing is computed by a `frozen=True`.
    """
    nodes = list(ast.walk(tree))
    declared = [
        part
        for node in nodes
        for part in (*getattr(node, "decorator_list", ()), *getattr(node, "keywords", ()))
        if isinstance(node, ast.ClassDef | ast.FunctionDef)
    ]
    left = {node for part in declared for node in ast.walk(part)}
    return [(node, *change) for node in nodes if node not in left and (change := _change(node))]


def mutant(source: str, number: int) -> tuple[str, str]:
    """A module with a change at one of its places, and what the change is."""
    tree = ast.parse(source)
    node, name, value = places(tree)[number]
    before = ast.unparse(node)
    setattr(node, name, value)
    first, then = (text.partition("\n")[0] for text in (before, ast.unparse(node)))
    return ast.unparse(tree), f"line {node.lineno}: {first}  becomes  {then}"


def _change(node: ast.AST) -> tuple[str, object] | None:
    """What of a node is to become what."""
    match node:
        case ast.Compare(ops=[operation]) if type(operation) in _COMPARISONS:
            return "ops", [_COMPARISONS[type(operation)]()]
        case ast.BinOp(op=operation) if type(operation) in _OPERATORS:
            return "op", _OPERATORS[type(operation)]()
        case ast.BoolOp(op=operation):
            return "op", ast.Or() if isinstance(operation, ast.And) else ast.And()
        case ast.IfExp() | ast.If():
            return "test", ast.UnaryOp(ast.Not(), node.test)
        case ast.Constant(value=bool() as value):
            return "value", not value
        case ast.Constant(value=int() | float() as value):
            return "value", value + 1
    return None


def tests_of(module: Path) -> list[Path]:
    """The module's examples and its tests, those that are likely to notice soonest first."""
    name, mine = module_of(module), {module.stem, module.parent.name}
    importers = {module_of(path) for path in EVERY if name in ours(path)}
    files = sorted((ROOT / "tests").rglob("test_*.py"))
    own = [path for path in files if path.stem.removeprefix("test_") in mine]
    near = [path for path in files if name in ours(path)]
    far = [path for path in files if importers & ours(path)]
    return list(dict.fromkeys([module, *own, *near, *far]))


def survives(module: Path, text: str, seed: int) -> bool:
    """Whether all tests pass on a copy with this text in the place of a module."""
    options = ("-x", "-q", "-n0", "-p", "no:cacheprovider", f"--hypothesis-seed={seed}")
    tests = [path.relative_to(ROOT) for path in tests_of(module)]
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "project"
        shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(".*", "*.egg-info"))
        (copy / module.relative_to(ROOT)).write_text(text, "utf-8")
        here = os.environ | {"PYTHONPATH": str(copy)}
        command = [sys.executable, "-m", "pytest", *options, *tests]
        done = subprocess.run(command, cwd=copy, env=here, capture_output=True)
        return done.returncode in (0, 5)  # 5: there is none


def main() -> None:
    """Run a sample and print its score."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--sample", type=int, default=160)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--processes", type=int, default=os.cpu_count())
    parser.add_argument("modules", nargs="*", default=CORE, help="such as reference/units.py")
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT))  # of each process that starts here
    core = [m for m in EVERY if any(m.is_relative_to(ROOT / name) for name in options.modules)]
    sources = {module: module.read_text("utf-8") for module in core}
    everything = [(m, k) for m in core for k in range(len(places(ast.parse(sources[m]))))]
    chosen = random.Random(options.seed).sample(everything, min(options.sample, len(everything)))
    print(f"{len(chosen)} of {len(everything)} mutants, seed {options.seed}", flush=True)
    killed = 0
    with ThreadPoolExecutor(options.processes) as pool:
        modules = sorted({module for module, _ in chosen})
        if not all(pool.map(lambda m: survives(m, sources[m], options.seed), modules)):
            parser.exit(2, "A test fails without a mutant: nothing to learn.\n")
        mutants = [(module, *mutant(sources[module], number)) for module, number in chosen]
        alive = pool.map(lambda m: survives(m[0], m[1], options.seed), mutants)
        for done, ((module, _, change), lives) in enumerate(zip(mutants, alive, strict=True), 1):
            killed += not lives
            if lives:
                print(f"{module.relative_to(ROOT)}, {change}")
            print(f"{done} of {len(chosen)}: {killed} noticed", flush=True)
    print(f"{killed} of {len(chosen)} mutants noticed ({100 * killed / len(chosen):.1f} %)")


if __name__ == "__main__":
    main()
