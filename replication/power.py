"""The power of the audit: misprints planted in copies of the ledger, and what it notices of them.

A plant is one edit of one printed number or equation. It is visible if, with everything else as
printed, some number, restatement or equation no longer agrees; that is found in doubles, by another
route than the audit's proofs. Then the audit judges what depends on it.
"""

import random
from collections.abc import Callable, Iterable, Iterator
from importlib import resources
from typing import NamedTuple

import msgspec

from reference.ledger import INFERRED, Ledger
from replication.audit.audit import Audit
from replication.audit.explain import dependents, disagreeing, edits_of
from replication.text import Table


class Plant(NamedTuple):
    """One misprint: the entry or equation, its true text, the planted one, the kind of edit."""

    entry: str
    true: str
    text: str
    edit: str


class Counts(msgspec.Struct, kw_only=True):
    """How many plants there were, how many of them are visible, and what became of these.

    `detected`: something fails because of them; `accused_wrongly`: the first repair that the audit
    names changes another entry; `repaired`: the true text is among the repairs that it names;
    `repaired_first`: it is the first of them.
    """

    planted: int = 0
    invisible: int = 0
    visible: int = 0
    detected: int = 0
    accused_wrongly: int = 0
    repaired: int = 0
    repaired_first: int = 0

    def add(self, more: "Counts") -> None:
        """Count these, too."""
        for name in Counts.__struct_fields__:
            setattr(self, name, getattr(self, name) + getattr(more, name))


class Power(Counts, kw_only=True):
    """The counts of a sample, whole and by kind of entry and of edit; what passed unnoticed."""

    seed: int
    by_kind: dict[str, Counts] = msgspec.field(default_factory=dict)
    by_edit: dict[str, Counts] = msgspec.field(default_factory=dict)
    unnoticed: list[dict[str, str]] = msgspec.field(default_factory=list)

    def table(self) -> Table:
        """Rates in percent of what is visible: all, by kind of entry, by kind of edit."""
        groups: dict[str, Counts] = {"all": self}
        for word, parts in (("in", self.by_kind), ("by", self.by_edit)):
            groups |= {f"{word} {name}": parts[name] for name in sorted(parts)}
        rates = {
            "noticed": "detected", "text named": "repaired", "named first": "repaired_first",
            "accused wrongly": "accused_wrongly",
        }  # fmt: skip
        rows = [
            (name, str(counts.planted), str(counts.visible), *(
                f"{100 * getattr(counts, key) / counts.visible:.1f}" if counts.visible else "-"
                for key in rates.values()))
            for name, counts in groups.items()
        ]  # fmt: skip
        return Table("Rates in percent", ("", "planted", "visible", *rates), rows)


def measured() -> Power:
    """What `coldspray power --json` last measured for this report; a test measures it again.

    >>> measured().planted
    500
    """
    file = resources.files("replication") / "power.json"
    return msgspec.json.decode(file.read_bytes(), type=Power)


def plants(ledger: Ledger) -> Iterator[Plant]:
    """Every plant: all edits of all printed numbers and equations."""
    for name in (*ledger.claims, *ledger.equations):
        for text, kind in edits_of(ledger, name):
            yield Plant(name, ledger.printed_text(name), text, kind)


def trial(truth: Audit, plant: Plant) -> tuple[set[str], Counts]:
    """Judge everything that depends on one plant, and compare with the report as printed.

    Gives what fails only because of the plant, and the counts for this one.
    """
    ledger = truth.ledger.misprint(plant.entry, plant.text)
    audit = Audit(ledger, every_convention=False)
    claims, wrong = dependents(truth.ledger, plant.entry), set()
    inside = ledger.equation_of(plant.entry)
    for name in ledger.equations if inside else ():  # its own, and those derived from it
        assessed = audit.equation(name, constants=False)
        # One that fails in the report, too, must fail in another way.
        if assessed.verdict.is_failure and assessed.checks != truth.equation(name).checks:
            wrong.add(name)
    claims |= {claim.id for claim in ledger.claims.values() if claim.within in wrong}
    failing = wrong | {
        name
        for name in claims
        if audit.assessment(ledger.claims[name]).verdict.is_doubtful
        and not truth.assessment(truth.ledger.claims[name]).verdict.is_doubtful
    }
    repairs = audit.explainer.ranked(sorted(failing))
    true = [(repair.entry, repair.text) == (plant.entry, plant.true) for repair in repairs]
    visible = bool(failing) or _visible(truth, ledger, claims)
    return failing, Counts(
        planted=1,
        invisible=not visible,
        visible=visible,
        detected=bool(failing),
        accused_wrongly=any(repair.entry != plant.entry for repair in repairs[:1]),
        repaired=any(true),
        repaired_first=any(true[:1]),
    )


def _visible(truth: Audit, ledger: Ledger, claims: set[str]) -> bool:
    """Whether some claim no longer agrees, by doubles, at any value of the inferred inputs.

    The audit of the misprint has no part in this; the values are those that the report admits.
    """
    names = [INFERRED + name for name in truth.ledger.inferred]
    ends = {name: truth.judge.inference(name).inner.ends for name in names}
    parts = 24  # for the density they are 1 kg/m^3 wide
    values = [{name: truth.ledger.value(name) for name in names}] + [
        {name: low + (high - low) * k / parts for name, (low, high) in ends.items()}
        for k in range(parts + 1)
    ]
    return all(
        disagreeing(ledger, claims, inferred) - disagreeing(truth.ledger, claims, inferred)
        for inferred in values
    )


def power(
    ledger: Ledger, sample: int, seed: int, progress: Callable[[Iterable[Plant]], Iterable[Plant]]
) -> Power:
    """Plant a seeded sample of misprints, each in a copy of the ledger, and count what is noticed.

    `progress` wraps the plants as they are worked through.
    """
    everything = list(plants(ledger))
    chosen = random.Random(seed).sample(everything, min(sample, len(everything)))
    truth, result = Audit(ledger, every_convention=False), Power(seed=seed)
    for plant in progress(chosen):
        failing, counts = trial(truth, plant)
        kind = ledger.claims[plant.entry].kind if plant.entry in ledger.claims else "equation"
        result.add(counts)
        result.by_kind.setdefault(kind, Counts()).add(counts)
        result.by_edit.setdefault(plant.edit, Counts()).add(counts)
        if counts.visible and not failing:
            result.unnoticed.append(plant._asdict())
    return result
