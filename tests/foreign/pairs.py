"""Pairs of workbooks, of which the second was made from the first by changes that are known."""

from dataclasses import dataclass
from pathlib import Path

from foreign import writers
from foreign.edits import (
    Edit,
    clear,
    fill,
    inserted,
    moved,
    name,
    numbers,
    put,
    renamed,
    right,
    rows,
)
from foreign.layouts import Foreign
from foreign.truth import full


@dataclass(frozen=True)
class Pair:
    """Changes that make two workbooks of one, and the status of their comparison."""

    title: str
    status: int
    before: tuple[Edit, ...] = ()
    after: tuple[Edit, ...] = ()
    options: tuple[str, ...] = ()
    layout: str = "plain"
    steps: int | None = None
    reverse: bool = False

    def books(self) -> tuple[Foreign, Foreign]:
        """The first and the second workbook."""
        books = []
        for edits in (self.before, self.after):
            f = right(self.layout, self.steps)
            for edit in edits:
                edit(f)
            books.append(f)
        return books[0], books[1]

    def written(self, folder: Path) -> list[Path]:
        paths = [writers.barely(f, folder / f"{name}.xlsx")
                 for f, name in zip(self.books(), "ab", strict=True)]  # fmt: skip
        return paths[::-1] if self.reverse else paths

    @property
    def changed(self) -> set[str]:
        """The cells that do not hold the same."""
        a, b = self.books()
        return {full(at) for at in a.cells.keys() | b.cells.keys()
                if a.cells.get(at) != b.cells.get(at)}  # fmt: skip


RESISTANCE_ELSEWHERE = (
    clear("G1", "H1", "G2", "H2"),
    put("J4", "beta", 5),
    put("J5", "Yt", 700000000.0),
    put("B6", "=K4*K5"),
)

DENSITY_ELSEWHERE = (
    clear("D1", "E1"),
    put("J8", "target density", 7850),
    fill("E9:E60", "=(0.5*$K$8*C9^2+$B$6)*PI()*($B$4*D9-D9^2)/$B$3"),
)

SLIGHTLY_OTHER = (put("B5", 500.02), put("D60", "=D59+C60*$E$2*1.0001"))


def _notes(*words: str, numbered: bool = False) -> tuple[Edit, ...]:
    """Notes on a sheet of their own: a word, two numbers if so wanted, the word in brackets."""
    return tuple(
        put(f"Notes!B{row}", word, *((row, 2 * row) if numbered else ()), f"({word})")
        for row, word in enumerate(words, 3)
    )


PAIRS = (
    Pair("nothing", 0),
    Pair("an input", 1, after=(put("B5", 450),)),
    Pair(
        "last digits, and an input", 1, after=(put("B1", 1.1000000000000044e-05), put("E1", 8000))
    ),
    Pair("a formula", 1, after=(put("D60", "=D59+C60*$E$2*1.1"),)),
    Pair("a column of formulas", 1, after=(fill("F9:F60", "=C9-E9*$E$2/2"),)),
    Pair(
        "a number over a formula, a formula over a number",
        1,
        after=(put("D30", 1e-06), put("B4", 2.2e-05), put("E1", "=7*1000")),
    ),
    Pair(
        "a text over a number, a head, a blank",
        1,
        after=(put("E2", "0.5 ns"), put("D7", "depth"), clear("A1")),
    ),
    Pair("three rows inserted", 1, after=(inserted("7", 3),)),
    Pair("a column inserted", 1, after=(inserted("D", 2),)),
    Pair("the table elsewhere", 1, after=(moved("7", 5, 4),)),
    Pair(
        "a range that ends elsewhere, both ends blank before",
        1,
        before=(put("J1", "=MAX(K1:K9)"), rows("K1:K8", lambda r: float(f"{r - 8}5"))),
        after=(
            put("J1", "=MAX(K1:K20)"),
            rows("K1:K8", lambda r: float(f"{r - 8}5")),
            put("K20", 900),
        ),
    ),
    Pair(
        "references to blank cells, changed",
        1,
        before=(
            put("J1", "=SUM(H1:H9)"),
            put("J2", "=MAX(K1:K50)"),
            put("J3", "=B1+K9"),
            put("J4", "=SUM(B:D)"),
        ),
        after=(
            put("J1", "=SUM(H1:H10)"),
            put("J2", "=MAX(K1:K6)"),
            put("J3", "=B1+K10"),
            put("J4", "=SUM(C:D)"),
        ),
    ),
    Pair(
        "references to blank cells, rows and columns inserted",
        1,
        before=(
            put("J1", "=SUM(H1:H9)"),
            put("J2", "=MAX(K1:K50)"),
            put("J3", "=B1+K9"),
            put("J4", "=SUM(B:B)"),
        ),
        after=(
            put("J1", "=SUM(H1:H9)"),
            put("J2", "=MAX(K1:K50)"),
            put("J3", "=B1+K9"),
            put("J4", "=SUM(B:B)"),
            inserted("7", 3),
            inserted("1", 2),
            inserted("C", 1),
        ),
    ),
    Pair(
        "references to blank cells, one stays behind",
        1,
        before=(put("J1", "=SUM(H1:H9)"), put("J3", "=B1+K9")),
        after=(inserted("7", 3), put("J1", "=SUM(H1:H9)"), put("J3", "=B1+K10")),
    ),
    Pair(
        "references to blank cells, the table elsewhere",
        1,
        before=(put("J3", "=B1+K9"), put("D7", "=SUM(K9:K70)")),
        after=(put("J3", "=B1+K9"), put("D7", "=SUM(K9:K70)"), moved("A7:F60", 5, 4)),
    ),
    Pair(
        "a block elsewhere",
        1,
        after=RESISTANCE_ELSEWHERE,
    ),
    Pair("notes beside", 1, after=(put("H20", "note"), put("H21", 3), put("J30", "another"))),
    Pair("a sheet more", 1, after=(put("Notes!A1", "hello"),)),
    Pair("the sheet renamed", 1, after=(renamed("Tabelle1"),)),
    Pair("a row inserted among the others", 1, after=(inserted("30", 1),)),
    Pair(
        "a row deleted, to which the next one referred",
        1,
        before=(put("J1", "=D60*1E6"),),
        after=(
            put("J1", "=D60*1E6"),
            moved("A31:F60", -1, 0),
            put("A30", "=#REF!+$E$2"),
            put("C30", "=#REF!", "=#REF!+C30*$E$2"),
        ),
    ),
    Pair(
        "rows and columns inserted, and an input",
        1,
        after=(put("E2", 4e-10), inserted("40", 1), inserted("3", 2), inserted("C", 1)),
    ),
    Pair("a column inserted and filled", 1, after=(inserted("D", 1), fill("D8:D60", "=C8*C8"))),
    Pair(
        "rows inserted, a reference that stays behind",
        1,
        after=(inserted("7", 3), put("F50", "=C49-E50*$E$2")),
    ),
    Pair(
        "sheets gone, renamed and new",
        1,
        before=(
            rows("Gone!A1:A19", lambda r: f"this {r}"),
            rows("Before!A1:A19", lambda r: f"that {r}"),
        ),
        after=(
            rows("After!A1:A19", lambda r: f"that {r}"),
            rows("New!A1:A19", lambda r: f"else {r}"),
        ),
    ),
    Pair("functions in small letters", 0, after=(put("B3", "=4/3*pi()*B1^3*B2"),)),
    Pair(
        "numbers written otherwise",
        0,
        after=(put("B3", "=4.0/3*PI()*B1^3*B2"), put("B4", "=0.2E+1*B1")),
    ),
    Pair(
        "other numbers, names and lengths of formulas",
        1,
        after=(put("B3", "=5/3*PI()*B1^3*B2"), put("B4", "=2*B1+0"), put("B6", "=SUM(H1)*H2")),
    ),
    Pair(
        "formulas that read other cells, blank ones, too",
        1,
        after=(
            put("B4", "=2*B2"),
            put("B6", "=H1*H3"),
            put("E20", "=(0.5*$E$1*C20^2+$B$6)*PI()*($B$4*D20-D20^2)/B$3"),
        ),
    ),
    Pair("a reference to a blank cell that is now a note", 1, after=(put("J9", "note"),)),
    Pair(
        "a name that stands for another cell",
        1,
        after=(name("Rp", "'de Rosset (2006)'!$D$6"),),
        layout="named-everything",
    ),
    Pair("a name more", 1, after=(name("V_x", "480"),), layout="named-constants"),
    Pair(
        "a name that stands for another number",
        1,
        after=(name("Rad", "1.2e-05"),),
        layout="named-constants",
    ),
    Pair(
        "texts over texts, a truth value over a number",
        1,
        after=(put("A1", "radius"), put("A2", "rho"), put("D1", "rho"), put("E2", True)),
    ),
    Pair(
        "two blocks elsewhere",
        1,
        after=RESISTANCE_ELSEWHERE + DENSITY_ELSEWHERE,
    ),
    Pair(
        "lines of notes",
        1,
        after=(
            rows("M3:M5", lambda r: f"line {r}"),
            rows("M9:M11", lambda r: f"line {r}", every=2),
        ),
    ),
    Pair("more than is shown", 1, after=(rows("D10:D58", lambda r: float(f"{r}e-7"), every=3),)),
    Pair("every number of a column typed", 1, after=(numbers("A9:A60", "time"),)),
    Pair("a $ lost", 1, after=(put("D60", "=D59+C60*E2"),)),
    Pair(
        "a $ lost in a column, rows inserted, and one before the row of a reference",
        1,
        after=(rows("F9:F60", lambda r: f"=C{r}-E{r}*$E2"), inserted("7", 3)),
    ),
    Pair("a number that became text", 1, after=(put("B5", "500"),)),
    Pair(
        "texts that look alike, a truth value and a text that spells it, a number",
        1,
        before=(
            put("J1", "10 µm"),
            put("J2", "TRUE"),
            put("J3", "a note"),
            put("J4", True),
            put("J5", 1),
        ),
        after=(
            put("J1", "10 μm"),
            put("J2", True),
            put("J3", "a note"),
            put("J4", "TRUE"),
            put("J5", True),
        ),
    ),
    Pair("a text that became a number", 1, before=(put("B5", "500"),), after=(put("B5", 501),)),
    Pair(
        "a number that became text, beside an inserted row",
        1,
        after=(put("B2", "8900"), inserted("5", 1)),
    ),
    Pair(
        "cells moved down beside a table",
        1,
        before=(put("J8", 0), fill("J9:J60", "=2*A9+J8")),
        after=(fill("J9:J60", "=2*A9+J8"), put("J8", 0), moved("A30:F60", 1, 0)),
    ),
    Pair(
        "the same, and a number over a formula",
        1,
        before=(fill("J9:J60", "=2*A9+J8"), put("J8", 0)),
        after=(fill("J9:J60", "=2*A9+J8"), put("J8", 0), moved("A30:F60", 1, 0), put("D50", 4e-06)),
    ),
    Pair(
        "cells moved to the right below a table",
        1,
        before=(put("A63", "some", 1, "notes", 2),),
        after=(put("A63", "some", 1, "notes", 2), moved("C63:D63", 0, 1)),
    ),
    Pair(
        "the table elsewhere, and a number over a formula",
        1,
        after=(moved("7", 3, 5), put("I40", 4e-06)),
    ),
    Pair(
        "a block elsewhere, and a formula in it",
        1,
        before=(put("G4", "ratio", "=B2/E1"), put("G5", "other", "=B1/B4")),
        after=(
            put("G4", "ratio", "=B2/E1"),
            put("G5", "other", "=B1/B4"),
            moved("G4:H5", 8, 3),
            put("K13", "=B1/(2*B4)"),
        ),
    ),
    Pair("a block elsewhere, over another", 1, after=(moved("G1:H2", 0, -3),)),
    Pair("a block elsewhere, over a number like its own", 1, after=(moved("H1:H1", 1, 0),)),
    Pair("inputs elsewhere, one of them another", 1, after=(moved("G1:H2", 3, 3), put("K4", 3))),
    Pair(
        "a number elsewhere, another in its place",
        1,
        after=(moved("H2:H2", 0, 2), put("H2", 600000000.0)),
    ),
    Pair("two inputs that changed places", 1, after=(put("B2", 7850), put("E1", 8900))),
    Pair(
        "two rows that changed places",
        1,
        after=(moved("A1:B1", 99, 0), moved("A2:B2", -1, 0), moved("A100:B100", -98, 0)),
    ),
    Pair(
        "rows that are sorted, a row moved far",
        1,
        before=(
            put("Notes!A1", "copper", 8900, "=B1>5000"),
            put("Notes!A2", "aluminium", 2700, "=B2>5000"),
            put("Notes!A3", "tungsten", 19300, "=B3>5000"),
            put("Notes!A4", "iron", 7850, "=B4>5000"),
            rows("More!A1:A9", lambda r: f"line {r}"),
        ),
        after=(
            put("Notes!A1", "iron", 7850, "=B1>5000"),
            put("Notes!A2", "tungsten", 19300, "=B2>5000"),
            put("Notes!A3", "aluminium", 2700, "=B3>5000"),
            put("Notes!A4", "copper", 8900, "=B4>5000"),
            put("More!A1", "line 9"),
            rows("More!A2:A9", lambda r: f"line {r - 1}"),
        ),
    ),
    Pair(
        "rows of a sheet that changed places",
        1,
        before=(rows("Notes!A1:A9", lambda r: f"line {r}"),),
        after=(
            rows("Notes!A1:A9", lambda r: f"line {r}"),
            put("Notes!A2", "line 7"),
            put("Notes!A7", "line 2"),
        ),
    ),
    Pair(
        "a function that no program knows, an input",
        1,
        after=(put("E2", "=NOSUCH(1)"), put("B5", 450)),
    ),
    Pair(
        "two columns that changed places",
        1,
        after=(moved("E8:E60", 0, 9), moved("F8:F60", 0, -1), moved("N8:N60", 0, -8)),
    ),
    Pair(
        "the sheet renamed, a row inserted, and an input",
        1,
        after=(put("E2", 4e-10), inserted("4", 1), renamed("Tabelle1")),
    ),
    Pair(
        "a sheet renamed and changed, another gone, another new",
        1,
        before=(
            rows("Before!A1:A19", lambda r: f"that {r}"),
            rows("Gone!A1:A9", lambda r: f"this {r}"),
        ),
        after=(
            rows("After!A1:A19", lambda r: f"that {r}"),
            put("After!B4", 5),
            put("After!A7", "else"),
            rows("New!A1:A9", lambda r: f"new {r}"),
        ),
    ),
    Pair(
        "notes beside, the other way round",
        1,
        after=(put("H20", "note"), put("H21", 3), put("J30", "another")),
        reverse=True,
    ),
    Pair("a sheet more, the other way round", 1, after=(put("Notes!A1", "hello"),), reverse=True),
    Pair(
        "a name more, the other way round",
        1,
        after=(name("V_x", "'de Rosset (2006)'!$B$6"),),
        reverse=True,
        layout="named-everything",
    ),
    Pair(
        "a row inserted among the others, the other way round",
        1,
        after=(inserted("30", 1),),
        reverse=True,
    ),
    Pair("a column inserted, the other way round", 1, after=(inserted("D", 2),), reverse=True),
    Pair(
        "two blocks elsewhere, the other way round",
        1,
        after=RESISTANCE_ELSEWHERE + DENSITY_ELSEWHERE,
        reverse=True,
    ),
    Pair("an input, the other way round", 1, after=(put("B5", 450),), reverse=True),
    Pair(
        "within 4 digits",
        1,
        after=SLIGHTLY_OTHER,
        options=("--digits=4",),
    ),
    Pair(
        "within 5 digits",
        1,
        after=SLIGHTLY_OTHER,
        options=("--digits=5",),
    ),
    Pair(
        "within 1e-4 of the number",
        1,
        after=SLIGHTLY_OTHER,
        options=("--relative=1e-4",),
    ),
    Pair(
        "within 1e9 ulp",
        1,
        after=SLIGHTLY_OTHER,
        options=("--ulp=1000000000",),
    ),
    Pair(
        "values only",
        1,
        after=SLIGHTLY_OTHER,
        options=("--values-only",),
    ),
    Pair(
        "notes 1 with 0 numbers",
        1,
        before=_notes("one", "two", "three", "four", "five"),
        after=_notes("alpha", "one", "beta", "three", "four", "five", "gamma"),
        steps=5,
    ),
    Pair(
        "notes 1 with 2 numbers",
        1,
        before=_notes("one", "two", "three", "four", "five", numbered=True),
        after=_notes("alpha", "one", "beta", "three", "four", "five", "gamma", numbered=True),
        steps=5,
    ),
    Pair(
        "notes 2 with 0 numbers",
        1,
        before=_notes("zero", "two", "three and more", "five", "six"),
        after=_notes("one", "two", "three", "four", "five"),
        steps=5,
    ),
    Pair(
        "notes 2 with 2 numbers",
        1,
        before=_notes("zero", "two", "three and more", "five", "six", numbered=True),
        after=_notes("one", "two", "three", "four", "five", numbered=True),
        steps=5,
    ),
    Pair(
        "notes 3 with 0 numbers",
        1,
        before=_notes("one"),
        after=_notes("zero", "two", "three and more", "five", "six"),
        steps=5,
    ),
    Pair(
        "notes 3 with 2 numbers",
        1,
        before=_notes("one", numbered=True),
        after=_notes("zero", "two", "three and more", "five", "six", numbered=True),
        steps=5,
    ),
    Pair(
        "notes 4 with 0 numbers",
        1,
        before=_notes("alpha", "one", "beta", "three", "four", "five", "gamma"),
        after=_notes("one"),
        steps=5,
    ),
    Pair(
        "notes 4 with 2 numbers",
        1,
        before=_notes("alpha", "one", "beta", "three", "four", "five", "gamma", numbered=True),
        after=_notes("one", numbered=True),
        steps=5,
    ),
)
