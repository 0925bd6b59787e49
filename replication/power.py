"""The power of the audit: how many misprints it notices that are planted in copies of the ledger.

A planted misprint is one edit of one printed number or equation. It is visible if it leaves some
number, repetition or equation in disagreement with the rest of the report; this is decided in
doubles, independently of the audit's proofs. The audit then judges what depends on the edit.

The controls are harmless rewritings: the same number or equation, written in another way. A verdict
that one of them changes is a false alarm.
"""

import math
import random
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from importlib import resources
from statistics import NormalDist
from typing import NamedTuple

import msgspec

from reference.ledger import INFERRED, Ledger
from replication.audit.audit import Audit
from replication.audit.explain import dependents, edits_of
from replication.audit.record import Repair
from replication.audit.rewritings import rewritings_of
from replication.audit.verdict import disagreeing
from replication.text import Table


class Plant(NamedTuple):
    """A planted text: the claim or equation, its true and its planted text, the kind of edit."""

    entry: str
    true: str
    text: str
    edit: str


class PlantCounts(msgspec.Struct, kw_only=True):
    """How many misprints were planted, how many of them are visible, and what the audit noticed.

    `detected`: something fails because of the misprint; `accused_wrongly`: the first repair that
    the audit lists changes another entry; `repaired`: the true text is among the listed repairs;
    `repaired_first`: it is the first of them. `controls` and `false_alarms`: how many harmless
    rewritings were tried, and how many of them changed a verdict.
    """

    planted: int = 0
    invisible: int = 0
    visible: int = 0
    detected: int = 0
    accused_wrongly: int = 0
    repaired: int = 0
    repaired_first: int = 0
    controls: int = 0
    false_alarms: int = 0

    def add(self, more: "PlantCounts") -> None:
        """Add other counts to these."""
        for name in PlantCounts.__struct_fields__:
            setattr(self, name, getattr(self, name) + getattr(more, name))


class MisprintJudged(NamedTuple):
    """The outcome of a planted misprint: what fails only because of it, and the counts for it.

    `first` is the first repair that the audit lists, if there is one. `why` says why that is not
    the true text; it is empty if it is, and if nothing fails.
    """

    failing: set[str]
    counts: PlantCounts
    first: Repair | None = None
    why: str = ""


class NotFirst(msgspec.Struct, kw_only=True):
    """A visible misprint whose true text is not named first: what is, and why.

    `first_entry` and `first_text` are the first repair; both are empty if there is none.
    """

    entry: str
    true: str
    text: str
    edit: str
    first_entry: str
    first_text: str
    why: str


class Power(PlantCounts, kw_only=True):
    """The counts of a sample, in all, by kind of entry and by kind of edit.

    Beside them stands what is unnoticed, and what is noticed and not repaired first.
    """

    seed: int
    by_kind: dict[str, PlantCounts] = msgspec.field(default_factory=dict)
    by_edit: dict[str, PlantCounts] = msgspec.field(default_factory=dict)
    unnoticed: list[dict[str, str]] = msgspec.field(default_factory=list)
    not_first: list[NotFirst] = msgspec.field(default_factory=list)

    def rates(self) -> Table:
        """Return the rates of the whole sample, with the 95 % interval of each (Wilson's)."""
        shares = [
            ("visible misprints noticed", self.detected, self.visible),
            ("the true text is named", self.repaired, self.visible),
            ("it is named first", self.repaired_first, self.visible),
            ("another entry is named first", self.accused_wrongly, self.visible),
            ("harmless rewritings that change a verdict", self.false_alarms, self.controls),
        ]
        rows = [(name, f"{k} of {n}", percent(k, n), interval(k, n)) for name, k, n in shares]
        return Table("Rates", ("", "cases", "percent", "95 % interval"), rows)

    def reasons(self) -> Table:
        """Return why the true text is not named first: how often, and in which entries."""
        entries: dict[str, Counter[str]] = {}
        for missed in self.not_first:
            entries.setdefault(missed.why, Counter())[missed.entry] += 1
        rows = [
            (why, f"{names.total()} of {self.visible}", ", ".join(
                f"`{name}`" if count == 1 else f"`{name}` ({count} times)"
                for name, count in sorted(names.items(), key=lambda pair: (-pair[1], pair[0]))
            ))
            for why, names in sorted(entries.items(), key=lambda pair: (-pair[1].total(), pair[0]))
        ]  # fmt: skip
        caption = "Why the true text is not named first"
        return Table(caption, ("", "cases", "where the misprint is"), rows)

    def table(self) -> Table:
        """Return rates in percent of the visible misprints, by kind of entry and of edit."""
        groups: dict[str, PlantCounts] = {"all": self}
        for word, parts in (("in", self.by_kind), ("by", self.by_edit)):
            groups |= {f"{word} {name}": parts[name] for name in sorted(parts)}
        heads = (
            "", "planted", "visible", "noticed", "text named", "named first", "accused wrongly",
            "rewritten", "false alarms",
        )  # fmt: skip
        rows = [
            (
                name, str(counts.planted), str(counts.visible),
                percent(counts.detected, counts.visible),
                percent(counts.repaired, counts.visible),
                percent(counts.repaired_first, counts.visible),
                percent(counts.accused_wrongly, counts.visible),
                str(counts.controls), percent(counts.false_alarms, counts.controls),
            )
            for name, counts in groups.items()
        ]  # fmt: skip
        return Table("Rates in percent", heads, rows)


def percent(k: int, n: int) -> str:
    """Return k of n in percent, with one decimal; "-" of none.

    >>> percent(372, 408), percent(0, 0)
    ('91.2', '-')
    """
    return f"{100 * k / n:.1f}" if n else "-"


def interval(k: int, n: int) -> str:
    """Return the 95 % interval of a share, k of n, in percent, by Wilson's formula; "-" of none.

    >>> interval(372, 408), interval(0, 500)
    ('88.0 to 93.6', '0.0 to 0.8')
    """
    if not n:
        return "-"
    low, high = wilson(k, n)
    return f"{100 * low:.1f} to {100 * high:.1f}"


def wilson(k: int, n: int) -> tuple[float, float]:
    """Return the ends of Wilson's 95 % interval of a share, k of n.

    They are the shares p that lie 1.96 of their own standard deviations from k/n: the roots of
    (p - k/n)^2 = z^2 p (1 - p) / n. (SciPy has it, too, but takes a second to import.)

    >>> [f"{end:.3f}" for end in wilson(372, 408)]
    ['0.880', '0.936']
    """
    z = NormalDist().inv_cdf(0.975)
    middle, half = k + z * z / 2, z * math.sqrt(k * (n - k) / n + z * z / 4)
    # No share is below 0 or above 1, where rounding could put an end.
    return max(0.0, (middle - half) / (n + z * z)), min(1.0, (middle + half) / (n + z * z))


def measured_rates() -> Power:
    """Return the stored output of `coldspray power --json`; a slow test measures it again.

    >>> measured_rates().planted
    500
    """
    file = resources.files("replication") / "power.json"
    return msgspec.json.decode(file.read_bytes(), type=Power)


def plants(ledger: Ledger) -> Iterator[Plant]:
    """Yield every possible misprint: all edits of all printed numbers and equations."""
    for name in (*ledger.claims, *ledger.equations):
        for text, kind in edits_of(ledger, name):
            yield Plant(name, ledger.printed_text(name), text, kind)


def controls(ledger: Ledger) -> Iterator[Plant]:
    """Yield every harmless rewriting of all printed numbers and equations."""
    for name in (*ledger.claims, *ledger.equations):
        for text, kind in rewritings_of(ledger, name):
            yield Plant(name, ledger.printed_text(name), text, kind)


def is_false_alarm(truth: Audit, control: Plant) -> bool:
    """Return whether a harmless rewriting changes the verdict on anything that depends on it.

    The constants of an equation that is rewritten as a whole have no place of their own in its new
    text; they are not judged.
    """
    ledger = truth.ledger.misprint(control.entry, control.text)
    audit = Audit(ledger, every_convention=False)
    equation = ledger.equation_of(control.entry)
    constants = truth.ledger.constants_of(equation) if equation == control.entry else []
    names = dependents(truth.ledger, control.entry).difference(constants)
    return any(
        audit.judge.assess(ledger.claims[name]).verdict
        != truth.judge.assess(truth.ledger.claims[name]).verdict
        for name in names
    ) or any(
        audit.judge.assess_equation(name, constants=False).verdict
        != truth.judge.assess_equation(name, constants=False).verdict
        for name in (ledger.equations if equation else ())
    )


def judge_misprint(truth: Audit, plant: Plant) -> MisprintJudged:
    """Judge everything that depends on a planted misprint, and compare with the true report."""
    ledger = truth.ledger.misprint(plant.entry, plant.text)
    audit, claims = Audit(ledger, every_convention=False), dependents(truth.ledger, plant.entry)
    # Its own equation may fail, or one derived from that.
    equations = ledger.equations if ledger.equation_of(plant.entry) else ()
    failing = new_failures(truth, audit, claims, equations)
    repairs = audit.explainer.ranked(sorted(failing))
    is_true = [(repair.entry, repair.text) == (plant.entry, plant.true) for repair in repairs]
    visible = bool(failing) or _is_visible(truth, ledger, claims)
    counts = PlantCounts(
        planted=1,
        invisible=not visible,
        visible=visible,
        detected=bool(failing),
        accused_wrongly=any(repair.entry != plant.entry for repair in repairs[:1]),
        repaired=any(is_true),
        repaired_first=any(is_true[:1]),
    )
    first = next(iter(repairs), None)
    missed = failing and not counts.repaired_first
    return MisprintJudged(
        failing, counts, first, why_not_first(truth, plant, repairs) if missed else ""
    )


def why_not_first(truth: Audit, plant: Plant, repairs: Sequence[Repair]) -> str:
    """Return why the first repair of a misprint is not the true text."""
    true = [r for r in repairs if (r.entry, r.text) == (plant.entry, plant.true)]
    equation = truth.ledger.equation_of(plant.entry)
    if not true:
        if equation and truth.judge.assess_equation(equation).verdict.is_failure:
            return "the equation fails in the true report, too, and no edit mends both faults"
        return "no listed edit gives the true text"
    first = repairs[0]
    if len(first.failing) < len(true[0].failing):
        return "another edit happens to leave less that fails"
    if first.entry == plant.entry:
        return "another text of the same entry agrees as well"
    return "two entries disagree, and the other one is taken for wrong"


def new_failures(
    truth: Audit, audit: Audit, claims: Iterable[str], equations: Iterable[str]
) -> set[str]:
    """Return which of these entries fail in an audit of a misprint and do not fail in the truth.

    Constants of a failing equation are judged with it.
    """
    wrong = set()
    for name in equations:
        assessed = audit.judge.assess_equation(name, constants=False)
        # An equation that fails in the true report, too, must fail in another way.
        if (
            assessed.verdict.is_failure
            and assessed.checks != truth.judge.assess_equation(name).checks
        ):
            wrong.add(name)
    constants = {claim.id for claim in audit.ledger.claims.values() if claim.within in wrong}
    return wrong | {
        name
        for name in constants.union(claims)
        if audit.judge.assess(audit.ledger.claims[name]).verdict.is_doubtful
        and not truth.judge.assess(truth.ledger.claims[name]).verdict.is_doubtful
    }


def _is_visible(truth: Audit, ledger: Ledger, claims: set[str]) -> bool:
    """Return whether some claim, computed in doubles, now disagrees at all inferred inputs' values.

    The values are those that the true report admits: the audit of the misprint has no part in this.
    """
    names = [INFERRED + name for name in truth.ledger.inferred]
    ends = {name: truth.judge.inference(name).inner.ends for name in names}
    parts = 24  # of 1 kg/m^3 each for the target density
    values = [{name: truth.ledger.value(name) for name in names}] + [
        {name: low + (high - low) * k / parts for name, (low, high) in ends.items()}
        for k in range(parts + 1)
    ]
    return all(
        disagreeing(ledger, claims, inferred) - disagreeing(truth.ledger, claims, inferred)
        for inferred in values
    )


def measure_power(
    ledger: Ledger, sample: int, seed: int, progress: Callable[[Iterable[Plant]], Iterable[Plant]]
) -> Power:
    """Plant random samples of misprints and of harmless rewritings, one text at a time.

    Of each there are at most `sample`. Returns the counts of what the audit notices. `progress`
    wraps the iteration over the planted texts, such as in a progress bar.
    """

    def drawn(everything: list[Plant]) -> list[Plant]:
        return random.Random(seed).sample(everything, min(sample, len(everything)))

    misprints, harmless = drawn(list(plants(ledger))), set(drawn(list(controls(ledger))))
    truth, result = Audit(ledger, every_convention=False), Power(seed=seed)
    for plant in progress([*misprints, *sorted(harmless)]):
        if plant in harmless:
            counts = PlantCounts(controls=1, false_alarms=is_false_alarm(truth, plant))
        else:
            failing, counts, first, why = judge_misprint(truth, plant)
            if counts.visible and not failing:
                result.unnoticed.append(plant._asdict())
            if why:
                entry, text = (first.entry, first.text) if first else ("", "")
                shown = NotFirst(**plant._asdict(), first_entry=entry, first_text=text, why=why)
                result.not_first.append(shown)
        kind = ledger.claims[plant.entry].kind if plant.entry in ledger.claims else "equation"
        by_kind = result.by_kind.setdefault(kind, PlantCounts())
        for total in (result, by_kind, result.by_edit.setdefault(plant.edit, PlantCounts())):
            total.add(counts)
    return result
