"""The sheet `Inputs`: every physical number, typed in the report's units, with what is made of it.

Yellow cells are typed; beside each stand the value in use in SI units, what the report has, and
within what limits a number is taken. What follows from the inputs stands apart, below.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from reference.ledger import INFERRED, Ledger
from reference.units import to_si
from spreadsheets.plan import (
    NOT_COMPUTED,
    Cell,
    Rule,
    SheetPlan,
    formula,
    guarded,
    lines_of,
    printed,
    recorded,
    tables,
    text,
    unit_text,
)
from spreadsheets.sheets.steps import CaseSheet

REPORT = "report"
"""What the switch says to take the report's inputs; with any other text, the user's are taken."""


@dataclass(frozen=True, slots=True)
class Input:
    """A number that is typed: its defined name, symbol, unit, and the limits of what is taken.

    source: the id of the claim that prints it, or of an inferred input. attribute: what it is of an
    impact, if it belongs to a case.
    """

    name: str
    symbol: str
    source: str
    unit: str
    limits: tuple[float, float]
    meaning: str = ""
    attribute: str = ""

    def of_report(self, ledger: Ledger) -> float:
        """The report's number in this unit.

        >>> from reference.ledger import load
        >>> INPUTS["dt_s"].of_report(load()), INPUTS["R_p"].of_report(load())
        (0.2, 11.0)
        """
        return float(ledger.value(self.source) / to_si(self.unit))


COARSE = "dt_coarse"
"""The input that only the report's own workbook has."""


def _entry(name: str, symbol: str, source: str, unit: str = "1", **more: Any) -> Input:
    limits = more.pop("limits", tables()["limits"][unit])
    return Input(name, symbol, source, unit, tuple(limits), **more)


_BLOCKS = {
    block: [_entry(name, **entry) for name, entry in entries.items()]
    for block, entries in tables()["inputs"].items()
}
INPUTS = {entry.name: entry for block in _BLOCKS.values() for entry in block}
"""Every input that does not differ between the cases, by its name."""

_SCIENTIFIC = "0.0####E+00"

_SAME, _INFERRED, _YOURS = "the report’s", "as inferred", "yours"
_BAD = ("too small", "too large", "no number")
MESSAGES = {
    "unusable": "CHECK THE INPUTS: column E tells which number cannot be used, and why.",
    "report": "In use: the report’s inputs. What you typed is set aside.",
    "changed": "In use: your inputs. Column E tells which of them are not the report’s.",
    "same": "In use: the report’s inputs.",
}


def inputs_of(cases: Sequence[CaseSheet], report: bool) -> dict[str, list[Input]]:
    """The inputs of a workbook of these cases, in blocks; `report`: it is the report's own."""
    given = "target resistance, given instead of β and Y_t"
    stress = "target resistance over flow stress, {}"
    betas = [
        _entry(
            case.named("beta"), "β", f"depth-beta-{case.beta}-beta",
            meaning=stress.format(case.name), attribute="beta",
        )
        for case in cases
    ]  # fmt: skip
    blocks = {**_BLOCKS, "Target resistance": [INPUTS["Y_t"], *betas]}
    if cases[0].resistance_given:
        own = _entry("R_t", "R_t", "a1-resistance", "Pa", meaning=given, attribute="resistance")
        blocks["Target resistance"] = [own]
    if not report:
        blocks["Impact"] = [entry for entry in blocks["Impact"] if entry.name != COARSE]
    return blocks


def sheet(ledger: Ledger, cases: Sequence[CaseSheet], report: bool) -> SheetPlan:
    """The sheet for these cases, which share every input but the target resistance."""
    page = SheetPlan(name="Inputs")
    page.title("Inputs")
    page.say(
        "Type into the yellow cells, in the unit beside them; every sheet follows. On orange: an "
        "input that the report never prints, inferred from Table A-1."
    )
    page.row = 9
    page.table("inputs", "CFHIKL", "C")
    first = page.row
    for block, entries in inputs_of(cases, report).items():
        page.put(A=text(block, "block"))
        for entry in entries:
            page.put(**_input(ledger, entry, page.row))
        page.row += 1
    checks = f"E{first}:E{page.row}"
    _status(page, checks)
    page.put(A=text("What follows from them", "block"))
    _derived(page, ledger, cases)
    page.row += 1
    page.put(A=text("Constants", "block"))
    # Programs differ in the digits of their own pi, so it stands in a cell.
    for name, meaning, value, unit in (
        ("pi_", "circumference over diameter, π", math.pi, "1"),
        ("ksi_Pa", "1000 pound-force per square inch", float(to_si("ksi")), "Pa"),
        # Beyond these the command warns, too.
        ("travel_most", "a step may pass this share of the radius", "inputs.travel_most", "1"),
        ("excess_most", "the sheet may exceed the exact depth by", "inputs.excess_most", "1"),
    ):
        number, named = recorded(value, name=name, unit=unit), text(name, "unit")
        page.put(B=text(meaning), F=number, G=unit_text(unit), M=named)
    page.print_area = f"A1:J{page.row - 1}"
    bad = ",".join(f'$E{first}="{word}"' for word in _BAD)
    page.rules = [
        Rule(checks, f"=OR({bad})", "warning"),
        Rule(checks, f'=$E{first}="{_YOURS}"', "changed"),
        Rule("A7", "=inputs_unusable>0", "warning"),
    ]
    return page


def _status(page: SheetPlan, checks: str) -> None:
    """The switch, and how many inputs differ from the report's or cannot be used."""
    unusable = "+".join(f'COUNTIF({checks},"{word}")' for word in _BAD)
    said = {name: f'"{words}"' for name, words in MESSAGES.items()}
    message = (
        f'=IF(inputs_unusable>0,{said["unusable"]},IF(inputs_from="{REPORT}",{said["report"]},'
        f"IF(inputs_changed>0,{said['changed']},{said['same']})))"
    )
    changed = f'=COUNTIF({checks},"{_YOURS}")'
    page.cells |= {
        "B4": text("Inputs to take: yours, or the report’s"),
        "C4": Cell(key="inputs.from", style="input", name="inputs_from", choices=("yours", REPORT)),
        "B5": text("Inputs in use that are not the report’s"),
        "C5": formula("inputs.changed", changed, "result", name="inputs_changed"),
        "B6": text("Inputs that cannot be used"),
        "C6": formula("inputs.unusable", f"={unusable}", "result", name="inputs_unusable"),
        "A7": formula("inputs.message", message, "message"),
    }


def _input(ledger: Ledger, entry: Input, row: int) -> dict[str, Cell]:
    inferred = entry.source.startswith(INFERRED)
    typed, in_use, own, least, most = (f"{column}{row}" for column in "CFHKL")
    same = _INFERRED if inferred else _SAME
    factor, none, key = _factor(entry.unit), f'"{NOT_COMPUTED}"', f"inputs.{entry.name}"
    taken = f"IF({typed}<{least},{none},IF({typed}>{most},{none},{typed}{factor}))"
    taken = f'=IF(inputs_from="{REPORT}",{own}{factor},IF(ISNUMBER({typed}),{taken},{none}))'
    good = f'IF(inputs_from="{REPORT}","{same}",IF({typed}={own},"{same}","{_YOURS}"))'
    bad = f'IF(ISNUMBER({typed}),IF({typed}<{least},"{_BAD[0]}","{_BAD[1]}"),"{_BAD[2]}")'
    style, shown = "inferred" if inferred else "input", _SCIENTIFIC if factor else "General"
    si = _SI.get(entry.unit, entry.unit)
    cells = {
        "A": text(entry.symbol, "text"),
        "B": text(entry.meaning or ledger.title(entry.source)),
        "C": Cell(key=f"{key}.typed", style=style, unit=entry.unit, limits=entry.limits),
        "D": unit_text(entry.unit),
        "E": formula(f"{key}.check", f"=IF(ISNUMBER({in_use}),{good},{bad})", "text"),
        "F": formula(key, taken, name=entry.name, unit=si, number_format=shown),
        "G": unit_text(si),
        "H": recorded(entry.of_report(ledger)),
        "I": text("nowhere", "recorded"),
        "J": text("inferred from Table A-1", "unit"),
        "K": recorded(entry.limits[0]),
        "L": recorded(entry.limits[1]),
        "M": text(entry.name, "unit"),
    }
    return cells if inferred else cells | _as_printed(ledger, entry.source, entry.unit)


def _as_printed(ledger: Ledger, claim: str, unit: str) -> dict[str, Cell]:
    place = str(ledger.claims[claim].place)
    return {"I": printed(ledger, claim, unit), "J": text(place, "unit")}


_SI = {"um": "m", "ns": "s", "MPa": "Pa", "GPa": "Pa", "ksi": "Pa"}
"""The unit in which a value is in use, where it is not that in which it is typed."""


def _factor(unit: str) -> str:
    """What brings a number to SI: a division by a power of ten, where that is exact.

    >>> _factor("ns"), _factor("MPa"), _factor("m/s")
    ('/1000000000', '*1000000', '')
    """
    if unit not in _SI:
        return ""
    factor = to_si(unit)
    return "*ksi_Pa" if unit == "ksi" else f"*{factor}" if factor > 1 else f"/{1 / factor}"


def _derived(page: SheetPlan, ledger: Ledger, cases: Sequence[CaseSheet]) -> None:
    """The rows of what follows from the inputs."""
    words = [
        {
            "R_t": case.named("R_t"),
            "sheet": case.name,
            "beta": case.named("beta"),
            "claim": "a1-resistance" if case.slug == "high" else "",
        }
        for case in cases
    ]
    for line in lines_of("derived", *words):
        if isinstance(line, str) or (cases[0].resistance_given and line.key == "R_t"):
            continue
        in_si = line.unit not in _SI
        value = formula(
            f"inputs.{line.key}", guarded(line.formula), unit=line.unit,
            name=line.key if in_si else "", number_format=_SCIENTIFIC if in_si else "General",
        )  # fmt: skip
        cells = {"A": text(line.symbol, "text"), "B": text(line.meaning), "F": value}
        more = _as_printed(ledger, line.claim, line.unit) if line.claim else {}
        page.put(**cells, G=unit_text(line.unit), **more)
