"""Measure how well `coldspray check` does on workbooks that it has not made.

`python tests/foreign/rates.py [SEED]` prints the tables of docs/check.md; a seed draws strangers
that nobody has seen. `tests/replication/test_check.py` measures smaller samples.
"""

import itertools
import shutil
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
# The project must come first: folders of tests have the names of its packages.
sys.path.insert(0, str(Path(__file__).parents[2]))

from foreign import writers
from foreign.built import Stranger, build
from foreign.byhand import BY_HAND, made
from foreign.drawn import drawn
from foreign.faults import FAULTS
from foreign.layouts import Foreign
from foreign.models import MODELS
from foreign.slips import slips
from foreign.strangers import draw
from foreign.truth import CLEAN, Answer, Truth, ask, outcome, refused, told
from foreign.words import other_impact, with_unknown_words

from replication.cases import BETA_3, BETA_5

CASES = (BETA_5, BETA_3)
DRAWN = range(24)
FIXED = ("printed-digits", "table-a1", "guarded", "named-constants")
"""Layouts that hold the report's inputs, or its rows, by design."""


@dataclass(frozen=True)
class Known:
    """A workbook of which the truth is known: its stored values, and what is true of it."""

    name: str
    book: Foreign
    truth: Truth
    values: writers.Values = field(default_factory=dict)

    def written(self, path: Path) -> Path:
        """Write it as Excel does, with its values; without, as scripts do."""
        if self.values:
            return writers.with_xlsxwriter(self.book, path, self.values)
        return writers.with_openpyxl(self.book, path)


# ---- the workbooks


def kept() -> Iterator[Foreign]:
    """Every layout by hand, with the report's two cases."""
    return (made(layout, impact) for impact in CASES for layout in BY_HAND)


def drawn_layouts(seeds: Iterable[int] = DRAWN) -> Iterator[Foreign]:
    return (drawn(seed, CASES[seed % 2]) for seed in seeds)


def other_inputs() -> Iterator[Foreign]:
    """Layouts by hand and drawn, with inputs over decades."""
    layouts = [name for name in BY_HAND if name not in FIXED]
    yield from (made(layout, other_impact(i)) for i, layout in enumerate(layouts))
    yield from (drawn(seed, other_impact(seed)) for seed in range(100, 124))


def unknown_words() -> Iterator[Foreign]:
    """Layouts by hand and drawn, with the report's inputs and words of random letters."""
    books = itertools.chain((made(layout, BETA_5) for layout in BY_HAND), drawn_layouts())
    return (with_unknown_words(f, i) for i, f in enumerate(books))


def both() -> Iterator[Foreign]:
    return (with_unknown_words(f, i) for i, f in enumerate(other_inputs()))


def some_layouts() -> Iterator[Foreign]:
    """The layouts in which faults are planted: by hand, of the report's case, and a few drawn."""
    return itertools.chain((made(layout, BETA_5) for layout in BY_HAND), drawn_layouts(DRAWN[:6]))


GROUPS: dict[str, Callable[[], Iterator[Foreign]]] = {
    "layouts by hand": kept, "drawn layouts": drawn_layouts, "other inputs": other_inputs,
    "unknown words": unknown_words, "unknown words and other inputs": both,
}  # fmt: skip
TO_SPOIL = {**GROUPS, "layouts by hand": some_layouts}


def right_ones(group: str) -> Iterator[Known]:
    """The right workbooks of a group."""
    return (Known(f.name, f, CLEAN) for f in GROUPS[group]())


@cache
def _calculated(group: str) -> list[tuple[Foreign, writers.Values]]:
    return [(f, writers.calculated(f)) for f in TO_SPOIL[group]()]


def planted(group: str, faults: Iterable[str] = tuple(FAULTS), every: int = 1) -> Iterator[Known]:
    """Each fault in every so many workbooks of a group, if they can have it; faults take turns."""
    for number, fault in enumerate(faults):
        for f, values in _calculated(group)[number % every :: every]:
            spoiled = FAULTS[fault](f, values)
            if spoiled is not None:
                stored = values | spoiled.wrong if spoiled.wrong else {}
                yield Known(f"{fault} in {f.name}", spoiled.workbook, spoiled.truth, stored)


def strangers(seeds: Iterable[int]) -> Iterator[Known]:
    """Right workbooks of strangers."""
    for seed in seeds:
        right = build(draw(seed))
        assert right is not None
        yield Known(right.plan.name, right.book, CLEAN, _stored(right))


def _stored(stranger: Stranger) -> writers.Values:
    """The stored values; every fourth workbook has none, as scripts write them."""
    stale = stranger.slip is not None and stranger.slip.name.startswith("stale")
    return stranger.values if stale or stranger.plan.seed % 4 else {}


def spoiled_strangers(seeds: Iterable[int], each: int) -> Iterator[Known]:
    """Workbooks of strangers with one fault, a few of each; the kinds of faults take turns."""
    planned: Counter[str] = Counter()
    for seed in seeds:
        plan, done = draw(seed), 0
        # The rarest kinds come first, so that each is measured.
        for slip in sorted(slips(plan), key=lambda slip: planned[slip.name]):
            spoiled = build(plan, slip) if done < each else None
            if spoiled is not None:
                planned[slip.name] += 1
                done += 1
                name = f"{slip.name} in {plan.name}"
                yield Known(name, spoiled.book, spoiled.truth, _stored(spoiled))


def other_models() -> Iterator[Known]:
    """Tables of other models, of which the scheme says nothing."""
    return (Known(f.name, f, refused()) for f in (model() for model in MODELS))


# ---- the answers


@dataclass
class Tally:
    """How the answers to some workbooks came out, and those that did not come out right."""

    counts: Counter[str] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)

    @property
    def total(self) -> int:
        return self.counts.total()

    def share(self, *names: str) -> str:
        """How many came out so, with the 95 % interval of their share (Wilson's)."""
        k = sum(self.counts[name] for name in names)
        if not self.total:
            return "-"
        low, high = interval(k, self.total)
        return f"{k} ({100 * low:.0f} to {100 * high:.0f} %)"


def interval(k: int, n: int) -> tuple[float, float]:
    """The 95 % interval of a share, k of n, by Wilson's formula."""
    from scipy.stats import binomtest

    ends = binomtest(k, n).proportion_ci(method="wilson")
    return float(ends.low), float(ends.high)


def measured(books: Iterable[Known], folder: Path) -> Tally:
    """Check workbooks, and count how the answers come out."""
    tally = Tally()
    for known in books:
        path = known.written(folder / "book.xlsx")
        try:
            answer = ask(path)
        except Exception as error:  # a traceback is the worst answer, but no reason to stop here
            answer, how = Answer(2, {}, repr(error)), "traceback"
        else:
            how = outcome(known.truth, answer, known.book)
        tally.counts[how] += 1
        if how != "right":
            tally.wrong.append(f"{known.name}: {how}; {told(answer)}")
    return tally


RIGHT = (
    "| right workbooks | number | clean (95 % interval) | accused | no verdict |\n"
    "|---|---|---|---|---|"
)
FAULTY = (
    "| faults in | number | placed (95 % interval) | and named | other cell | called clean | "
    "no verdict |\n|---|---|---|---|---|---|---|"
)


def right_row(name: str, tally: Tally) -> str:
    counts = tally.counts
    return (f"| {name} | {tally.total} | {tally.share('right')} | {counts['accused']} "
            f"| {counts['not checked'] + counts['traceback']} |")  # fmt: skip


def faulty_row(name: str, tally: Tally) -> str:
    counts = tally.counts
    silent = counts["not checked"] + counts["traceback"]
    return (f"| {name} | {tally.total} | {tally.share('right', 'misnamed')} | {counts['right']} "
            f"| {counts['misplaced']} | {counts['missed']} | {silent} |")  # fmt: skip


WRITERS = ("like Excel", "LibreOffice .xlsx", "LibreOffice .ods", "LibreOffice .xls")


def saved_by(program: str, folder: Path) -> Tally:
    """Right layouts by hand that a program has calculated and saved; few for LibreOffice."""
    books = [made(layout, BETA_5) for layout in BY_HAND]
    books = books if program in WRITERS[:2] else books[:8]
    paths = [folder / f"{number}.xlsx" for number in range(len(books))]
    for f, path in zip(books, paths, strict=True):
        if program == "like Excel":
            writers.with_xlsxwriter(f, path, writers.calculated(f))
        else:
            writers.with_openpyxl(f, path)
    if program.startswith("LibreOffice"):
        paths = writers.with_libreoffice(paths, folder, program.rpartition(".")[2])
    tally = Tally()
    for f, path in zip(books, paths, strict=True):
        answer = ask(path)
        tally.counts[outcome(CLEAN, answer, f)] += 1
        if answer.status:
            tally.wrong.append(f"{f.name} by {program}: {told(answer)}")
    return tally


def main() -> None:
    seed = int(sys.argv[1]) if sys.argv[1:] else 0
    seeds = range(seed, seed + 300)
    wrong = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        print(f"\n{RIGHT}")
        for group in GROUPS:
            wrong += _print(right_row, group, measured(right_ones(group), folder))
        wrong += _print(right_row, "strangers", measured(strangers(seeds), folder))
        for program in WRITERS:
            if shutil.which("soffice") or not program.startswith("LibreOffice"):
                wrong += _print(right_row, program, saved_by(program, folder))
        print(f"\n{FAULTY}")
        for group in GROUPS:
            every = 1 if group == "layouts by hand" else 3
            faulty = (known for known in planted(group, every=every) if known.truth.status)
            wrong += _print(faulty_row, group, measured(faulty, folder))
        wrong += _print(faulty_row, "strangers", measured(spoiled_strangers(seeds, 2), folder))
        tally = measured(other_models(), folder)
        print(f"\nOther models: {tally.counts['right']} of {tally.total} with status 2")
    print(*wrong, *tally.wrong, sep="\n", file=sys.stderr)


def _print(row: Callable[[str, Tally], str], name: str, tally: Tally) -> list[str]:
    print(row(name, tally), flush=True)
    return tally.wrong


if __name__ == "__main__":
    main()
