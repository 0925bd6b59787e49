"""The sheet `Inputs`: every physical number, typed in the report's units, with what is made of it.

Yellow cells are typed; beside each stand the value in use in SI units, what the report has, and
within what limits a number is taken. What follows from the inputs stands apart, below.
"""

import math
from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

from reference.ledger import INFERRED, Ledger
from reference.units import to_si
from spreadsheets.plan import (
    NOT_COMPUTED,
    Cell,
    Rule,
    SheetPlan,
    filled_in,
    formula,
    printed,
    recorded,
    tables,
    text,
    unit_text,
)
from spreadsheets.sheets.steps import CaseSheet


class Input(NamedTuple):
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
        """The report's number in this unit."""
        return float(ledger.value(self.source) / to_si(self.unit))


_BAD = ("too small", "too large", "no number")


def inputs_of(cases: Sequence[CaseSheet], report: bool) -> dict[str, list[Input]]:
    """The inputs of a workbook of these cases, in blocks; `report`: it is the report's own."""
    left_out = {"Y_t", "beta{of}"} if cases[0].resistance_given else {"R_t"}
    left_out |= set() if report else {"dt_coarse"}
    blocks: dict[str, list[Input]] = {}
    for block, entries in tables()["inputs"].items():
        named: dict[str, Input] = {}
        for case, (name, entry) in product(cases, entries.items()):
            if name not in left_out:
                own = filled_in({"name": name, "unit": "1", **entry}, case.words)
                own["limits"] = tuple(own.get("limits", tables()["limits"][own["unit"]]))
                named[own["name"]] = Input(**own)
        blocks[block] = [*named.values()]
    return blocks


def sheet(ledger: Ledger, cases: Sequence[CaseSheet], report: bool) -> SheetPlan:
    """The sheet for these cases, which share every input but the target resistance."""
    page = SheetPlan.begun("Inputs")
    page.row = 9
    page.table("CFHIKL", "C")
    first = page.row
    for block, entries in inputs_of(cases, report).items():
        page.put(A=text(block, "block"))
        for entry in entries:
            page.put(**_input(ledger, entry, page.row))
        page.row += 1
    checks = f"E{first}:E{page.row}"
    page.single_cells(checks=checks)
    page.put(A=text("What follows from them", "block"))
    derived, words = dict(tables()["derived"]), [case.words for case in cases]
    if cases[0].resistance_given:
        del derived["target"]
    page.lines(ledger, "inputs", derived, words, "ABFGIJ", headed=False)
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
        Rule(checks, f'=$E{first}="yours"', "changed"),
        Rule("A7", "=inputs_unusable>0", "warning"),
    ]
    return page


def _input(ledger: Ledger, entry: Input, row: int) -> dict[str, Cell]:
    inferred, key = entry.source.startswith(INFERRED), f"inputs.{entry.name}"
    words = {
        "row": row,
        "factor": _factor(entry.unit),
        "same": "as inferred" if inferred else "the report’s",
        "none": NOT_COMPUTED,
    }
    texts = filled_in(tables()["input"], words)
    style, shown = (
        "inferred" if inferred else "input",
        "0.0####E+00" if words["factor"] else "General",
    )
    si = _SI.get(entry.unit, entry.unit)
    place = "inferred from Table A-1" if inferred else str(ledger.claims[entry.source].place)
    own = text("nowhere", "recorded") if inferred else printed(ledger, entry.source, entry.unit)
    return {
        "A": text(entry.symbol, "text"),
        "B": text(entry.meaning or ledger.title(entry.source)),
        "C": Cell(key=f"{key}.typed", style=style, unit=entry.unit, limits=entry.limits),
        "D": unit_text(entry.unit),
        "E": formula(f"{key}.check", texts["check"], "text"),
        "F": formula(key, texts["in_use"], name=entry.name, unit=si, number_format=shown),
        "G": unit_text(si),
        "H": recorded(entry.of_report(ledger)),
        "I": own,
        "J": text(place, "unit"),
        "K": recorded(entry.limits[0]),
        "L": recorded(entry.limits[1]),
        "M": text(entry.name, "unit"),
    }


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
