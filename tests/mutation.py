"""Measure how many wrong versions of the core the tests notice, in a seeded sample of mutants.

    python tests/mutation.py --sample 160 --seed 1 [reference/printed.py replication/audit ...]

A mutant is one small change of one module. Half of them are of the family "conditions": another
comparison or operator, "and" for "or", a condition negated. The others are of the family "values":
a constant one more or less, min for max, two arguments exchanged, a call left out, None returned.

A mutant is tested in a copy of the project: first by the module's examples and the tests of its
name, then by those that import it, then by those that import one of its importers, until one fails.
One that no test notices is printed with its change: either it does no harm, or a test is missing.
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
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

from test_arrows import EVERY, ROOT, module_of
from test_arrows import ours as read_imports

CORE = ("reference", "replication/models", "replication/audit", "replication/check")
ours = cache(read_imports)
LIMIT = 600
"""Processor time [s] for each process; a mutant that takes longer counts as noticed."""

_COMPARISONS = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt,
                ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
                ast.In: ast.NotIn, ast.NotIn: ast.In}  # fmt: skip
_OPERATORS = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
              ast.Pow: ast.Mult}  # fmt: skip
_OPPOSITES = {"min": "max", "max": "min", "any": "all", "all": "any"}

Change = tuple[str, object]
"""An attribute of a node and its new value."""

Family = Callable[[ast.AST], list[Change]]


def conditions(node: ast.AST) -> list[Change]:
    """Return the changes of a node's comparison, operator or condition."""
    match node:
        case ast.Compare(ops=[*operations]):
            return [
                ("ops", [*operations[:k], _COMPARISONS[type(old)](), *operations[k + 1 :]])
                for k, old in enumerate(operations)
            ]
        case ast.BinOp(op=operation) if type(operation) in _OPERATORS:
            return [("op", _OPERATORS[type(operation)]())]
        case ast.BoolOp(op=operation):
            return [("op", ast.Or() if isinstance(operation, ast.And) else ast.And())]
        case ast.IfExp() | ast.If() | ast.While():
            return [("test", ast.UnaryOp(ast.Not(), node.test))]
    return []


def values(node: ast.AST) -> list[Change]:
    """Return the changes of a node's value: a constant, a function's name, arguments, a call."""
    match node:
        case ast.Constant(value=bool() as value):
            return [("value", not value)]
        case ast.Constant(value=int() | float() as value):
            return [("value", value + 1), ("value", value - 1)]
        case ast.Call(func=ast.Name(id=name)) if name in _OPPOSITES:
            return [("func", ast.Name(_OPPOSITES[name]))]
        case ast.Call(args=[first, second, *rest]):
            return [("args", [second, first, *rest])]
        case ast.Expr(value=ast.Call()):
            return [("value", ast.Constant(None))]
        case ast.Return(value=value) if value is not None:
            return [("value", ast.Constant(None))]
    return []


FAMILIES = (conditions, values)


def places(tree: ast.Module, family: Family) -> list[tuple[ast.AST, str, object]]:
    """Return every change of a family in a module, each with its node.

    Decorators and keywords of a class or function stay: a `frozen=True` computes nothing.
    """
    nodes = list(ast.walk(tree))
    declared = [
        part
        for node in nodes
        for part in (*getattr(node, "decorator_list", ()), *getattr(node, "keywords", ()))
        if isinstance(node, ast.ClassDef | ast.FunctionDef)
    ]
    kept = {node for part in declared for node in ast.walk(part)}
    return [(node, *change) for node in nodes if node not in kept for change in family(node)]


def mutant(source: str, family: Family, number: int) -> tuple[str, str]:
    """Return a module's source with one change of a family, and a description of it."""
    tree = ast.parse(source)
    node, name, value = places(tree, family)[number]
    before = ast.unparse(node)
    setattr(node, name, value)
    first, then = (text.partition("\n")[0] for text in (before, ast.unparse(node)))
    return ast.unparse(tree), f"line {getattr(node, 'lineno', 0)}: {first}  becomes  {then}"


def tests_of(module: Path) -> list[Path]:
    """Return the module itself, for its examples, and its tests, the likeliest to fail first."""
    name, namesakes = module_of(module), {module.stem, module.parent.name}
    importers = {module_of(path) for path in EVERY if name in ours(path)}
    files = sorted((ROOT / "tests").rglob("test_*.py"))
    own = [path for path in files if path.stem.removeprefix("test_") in namesakes]
    direct = [path for path in files if name in ours(path)]
    indirect = [path for path in files if importers & ours(path)]
    return list(dict.fromkeys([module, *own, *direct, *indirect]))


def survives(module: Path, text: str, seed: int) -> bool:
    """Return whether all tests pass in a copy of the project with this source for a module."""
    options = ("-x", "-q", "-n0", "-p", "no:cacheprovider", f"--hypothesis-seed={seed}")
    tests = [path.relative_to(ROOT) for path in tests_of(module)]
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "project"
        shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(".git", ".venv", ".*cache*"))
        (copy / module.relative_to(ROOT)).write_text(text, "utf-8")
        environment = os.environ | {"PYTHONPATH": str(copy)}
        command = [sys.executable, "-m", "pytest", *options, *tests]
        done = subprocess.run(command, cwd=copy, env=environment, capture_output=True)
        return done.returncode in (0, 5)  # 5: there are no tests


def main() -> None:
    """Test a sample of mutants and print its score."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--sample", type=int, default=160)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("modules", nargs="*", default=CORE, help="such as reference/units.py")
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT))  # inherited by each test process
    core = [m for m in EVERY if any(m.is_relative_to(ROOT / name) for name in options.modules)]
    sources = {module: module.read_text("utf-8") for module in core}
    draw, chosen = random.Random(options.seed), []
    for family in FAMILIES:
        counts = {m: len(places(ast.parse(source), family)) for m, source in sources.items()}
        every = [(m, family, k) for m, count in counts.items() for k in range(count)]
        print(f"{len(every)} mutants of the family {family.__name__!r}", flush=True)
        chosen += draw.sample(every, min(options.sample // len(FAMILIES), len(every)))
    killed = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        modules = sorted({module for module, *_ in chosen})
        if not all(pool.map(lambda m: survives(m, sources[m], options.seed), modules)):
            parser.exit(2, "A test fails without a mutant, so nothing can be measured.\n")
        mutants = [(m, *mutant(sources[m], family, number)) for m, family, number in chosen]
        alive = pool.map(lambda m: survives(m[0], m[1], options.seed), mutants)
        for done, ((module, _, change), lives) in enumerate(zip(mutants, alive, strict=True), 1):
            killed += not lives
            if lives:
                print(f"{module.relative_to(ROOT)}, {change}")
            print(f"{done} of {len(chosen)}: {killed} noticed", flush=True)
    print(f"{killed} of {len(chosen)} mutants noticed ({100 * killed / len(chosen):.1f} %)")


if __name__ == "__main__":
    main()
