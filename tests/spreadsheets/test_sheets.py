"""What the sheets hold, before any file exists: formulas, printed texts, addresses, layout."""

import re
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from itertools import chain

import pytest
from openpyxl.formula.tokenizer import Token, Tokenizer

from reference.ledger import Ledger, load
from reference.units import written
from replication.audit.record import Record
from replication.cases import BETA_5
from replication.report.document import claim_document
from replication.workbook import Workbook
from spreadsheets.emit import MARGINS, TITLE_HEIGHT, takes_two_lines
from spreadsheets.plan import Cell, SheetPlan
from spreadsheets.sheets import cells_of_claims
from spreadsheets.sheets.audit import AS_PRINTED, OTHERWISE
from spreadsheets.sheets.case import prepared_rows
from spreadsheets.styles import CURVES, STYLES
from spreadsheets.verify import inexact

LEDGER = load()

FUNCTIONS = {
    "ABS", "AND", "ASIN", "COUNT", "COUNTIF", "EXP", "IF", "IFERROR", "INDEX", "ISNUMBER", "LN",
    "MAX", "MIN", "NA", "ROUND", "SIN", "SQRT",
}  # fmt: skip
"""Functions that Excel 2010 has and every engine computes alike; none is volatile."""

MATHEMATICAL = {
    "0", "0.5", "1", "2", "3", "4", "6", "7", "9", "21", "1000000", "1000000000",
    "1000000000000000",
}  # fmt: skip
"""Numbers of the printed equations (1/2, 4/3, 7/3), counts, and powers of ten for units."""


def formulas(book: Workbook) -> dict[tuple[str, str], str]:
    """Return the formulas of a workbook by place."""
    return {place: cell.formula for place, cell in book.plan.cells.items() if cell.formula}


def sheet(book: Workbook, name: str) -> SheetPlan:
    """Return a sheet of a workbook."""
    (wanted,) = (plan for plan in book.plan.sheets if plan.name == name)
    return wanted


# Formulas


def test_formulas_are_ones_that_every_program_reads(book: Workbook) -> None:
    """Known functions and names, no physical number, no long text."""
    names = {cell.key for cell in book.plan.cells.values() if cell.named}
    for place, formula in formulas(book).items():
        bare = re.sub(r'"[^"]*"|\'[^\']*\'!', "", formula)
        bare = re.sub(r"\$?\b[A-Z]{1,2}\$?\d+\b", "", bare)
        assert set(re.findall(r"([A-Z]+)\(", bare)) <= FUNCTIONS, place
        assert set(re.findall(r"\b[A-Za-z]\w*\b(?!\()", bare)) <= names, place
        numbers = re.sub(r"[A-Za-z]\w*", "", bare)
        assert set(re.findall(r"[\d.]+", numbers)) <= MATHEMATICAL, (place, formula)
        assert all(len(text) < 256 for text in re.findall(r'"([^"]*)"', formula))


def test_only_equation_11_has_a_power(published: Workbook) -> None:
    """Programs compute powers in different ways, but it prints a cube root."""
    powers = [place for place, formula in formulas(published).items() if "^" in formula]
    assert powers == [published.plan.where["alpha"]]


def test_formulas_are_short_enough_to_be_read(book: Workbook) -> None:
    for place, formula in formulas(book).items():
        text = re.sub(r'"[^"]*"', '""', formula)  # a message counts as one word
        assert len(text) <= 200, (place, formula)


def shapes(book: Workbook) -> dict[str, tuple[str, str]]:
    """Return a place of each formula: those that differ only in the numbers of rows are one."""
    texts = {re.sub(r"\d+", "1", text): (at, text) for at, text in formulas(book).items()}
    return {text: place for place, text in texts.values()}


def gives_words(formula: str) -> bool:
    """Whether a formula has a text with a letter that is neither compared nor counted.

    Such a text is what the cell says; "–" is none.
    """
    tokens = [token for token in Tokenizer(formula).items if token.type != Token.WSPACE]
    functions: list[str] = []
    for before, token, after in zip([None, *tokens], tokens, [*tokens[1:], None], strict=False):
        if token.subtype == Token.OPEN:
            functions.append(token.value)
        elif token.subtype == Token.CLOSE:
            functions.pop()
        beside = {t.value for t in (before, after) if t and t.type == Token.OP_IN}
        compared = beside & {"=", "<>", "<", ">", "<=", ">="} or functions[-1:] == ["COUNTIF("]
        has_letter = token.subtype == Token.TEXT and any(map(str.isalpha, token.value))
        if has_letter and not compared:
            return True
    return False


def conditions_in(formula: str) -> int:
    """Return how many conditions a formula tests: whether there is an error is one, too."""
    tested = ("IF(", "IFERROR(", "AND(", "OR(", "NOT(")
    return sum(token.value in tested for token in Tokenizer(formula).items)


@pytest.mark.parametrize(
    ("formula", "words", "conditions"),
    [
        ('=IF(a=1,IF(b=1,"too long",""),"")', True, 2),
        ('=IFERROR(says_a&says_b,"none")', True, 1),
        ('=IF(inputs_from="report",H12,N12)', False, 1),
        ('=COUNTIF(E11:E50,"yours")', False, 0),
        ('=IF(ISNUMBER(E2),E2-D2,"–")', False, 1),
        ('="β = "&beta', True, 0),
    ],
)
def test_which_formulas_give_words_and_what_they_test(
    formula: str, words: bool, conditions: int
) -> None:
    assert (gives_words(formula), conditions_in(formula)) == (words, conditions)


def test_no_formula_that_says_something_tests_more_than_one_condition(book: Workbook) -> None:
    """So a reader clicks from a message through short formulas, each of which he believes."""
    saying = {text: place for text, place in shapes(book).items() if gives_words(text)}
    assert len(saying) > 20
    assert {at: text for text, at in saying.items() if conditions_in(text) > 1} == {}


def test_a_condition_is_one_comparison_or_one_question(book: Workbook) -> None:
    """Or an AND of comparisons: no OR or NOT, and no sum of conditions."""
    for formula, place in shapes(book).items():
        for condition in first_arguments_of_if(formula):
            bare = re.sub(r'"[^"]*"', "", condition)
            several = re.fullmatch(r"AND\(([^()]*)\)", bare)
            for single in several[1].split(",") if several else [bare]:
                assert "AND(" not in single, (place, condition)
                comparisons = re.findall(r"<=|>=|<>|[<>=]", single)
                questions = re.findall(r"ISNUMBER\(", single)
                assert len(comparisons) + len(questions) == 1, (place, condition)


def test_the_first_condition_of_an_and_hangs_on_all_that_the_others_do(published: Workbook) -> None:
    """So it is #N/A if any of them is: programs differ in AND(0=1,#N/A)."""
    plan, reached = published.plan, {}
    for place, cell in plan.cells.items():
        if cell.key.endswith(".typed"):
            reached[cell.key] = plan.dependents([place])
    ands = [text for text in formulas(published).values() if "AND(" in text]
    assert len(ands) > 30
    for formula in ands:
        names = re.findall(r"(\w+)(?:[<>=])", formula.partition("AND(")[2])
        first, *others = (
            {key for key, places in reached.items() if plan.where[name] in places} for name in names
        )
        assert all(first >= inputs for inputs in others), formula


def first_arguments_of_if(formula: str) -> list[str]:
    """Return the text of the first argument of every IF in a formula."""
    result, depths, open_ifs = [], 0, []
    for token in Tokenizer(formula).items:
        if token.subtype == Token.OPEN:
            depths += 1
            if token.value == "IF(":
                open_ifs.append((depths, len(result)))
                result.append("")
                continue
        for depth, index in open_ifs:
            if depth == depths and token.type == Token.SEP:
                open_ifs.remove((depth, index))
                break
        else:
            for _, index in open_ifs:
                result[index] += token.value
        if token.subtype == Token.CLOSE:
            depths -= 1
    return result


def test_only_what_says_a_verdict_catches_an_error(book: Workbook) -> None:
    catching = {book.plan.cells[at].key for at, text in formulas(book).items() if "IFERROR" in text}
    verdicts = (
        r"((solve|convergence)\.)?message.*|label.*|trust.*|.*\.(renamed|check|fault|verdict)"
        r"|convergence\.\w+\.order.*|inputs.*"
    )
    assert [key for key in catching if not re.fullmatch(verdicts, key)] == []


def test_the_equations_read_as_the_report_prints_them(published: Workbook) -> None:
    for key, formula in {
        "X_R_lower": "=(L_D*rho_p/rho_t+k_1)/(2*k_t)*ln_lower",  # Eq. 16
        "z_lower": "=k_t*rho_t*V_impact*V_impact/R_t_lower",
        "alpha": "=(2*E_t/(3*Y_steel))^(1/3)",  # Eq. 11
        "beta_WA": "=7/3*LN(alpha)",  # Eq. 10
        "R_t_high": "=beta_high*Y_t",  # Eq. 7
        "M_p": "=rho_p*4/3*pi_*R_p*R_p*R_p",  # Eq. 3 times the density
        "stress_high": "=rho_t*V_impact*V_impact/2+R_t_high",  # Eq. 6
        "c_rest_high": "=4*rho_p/(3*rho_t)*ln_rest_high",
    }.items():
        assert published.plan.cells[published.plan.where[key]].formula == formula


def test_cells_whose_last_digits_depend_on_the_program_are_found(published: Workbook) -> None:
    """Through cells, names, ranges and other sheets; no row of the scheme is among them."""
    plan = published.plan
    keys = {plan.cells[place].key for place in inexact(plan)}
    shown = {f"audit.{name}.computed" for name in ("observed-depth", "frank-zook-rha")}
    assert keys > shown | {"figure_5.depth_um[20]", "CV_PV_again", "over_stop_high"}
    assert not [key for key in keys if ".row." in key]


def test_what_depends_on_a_cell_is_found(published: Workbook) -> None:
    """The yield strength of copper concerns its own sheet only; the radius nearly all."""
    plan = published.plan
    keys = {plan.cells[at].key for at in plan.dependents([plan.where["Y_copper"]])}
    assert keys == {"Y_copper", "stress_over_copper_low", "stress_over_copper_high"}
    keys = {plan.cells[at].key for at in plan.dependents([plan.where["R_p"]])}
    assert keys > {"low.row.index[400]", "message_high", "figure_5.depth_um[0]", "audit_none"}


# Printed texts


def shows_its_claim(cell: Cell, ledger: Ledger) -> bool:
    """Whether a cell shows the text of its claim, with or without its unit, or its number."""
    claim = ledger.claims[cell.claim]
    if cell.number is None:
        text = re.sub("^[<>≤≥] ", "", cell.text) if claim.kind == "bound" else cell.text
        return text in (claim.shown, f"{claim.shown} {written(claim.unit)}".rstrip())
    interval = claim.interval()
    assert claim.printed is not None
    ends = [None if end is None else float(end) for end in (interval.lower, interval.upper)]
    return cell.number in (*ends, float(claim.printed.value))


def test_what_the_workbook_calls_printed_is_its_claims_text(book: Workbook) -> None:
    for place, cell in book.plan.cells.items():
        assert bool(cell.claim) == (cell.style == "printed") or cell.number is not None, place
        assert not cell.claim or shows_its_claim(cell, LEDGER), place


def test_the_inputs_have_their_units_beside_them(published: Workbook) -> None:
    """As typed and as used; a pure number has a dash, so that no unit is missing."""
    cells = sheet(published, "Inputs").cells
    rows = {cell.key: place[1:] for place, cell in cells.items() if cell.named}
    expected = {
        "V_impact": ("m/s", "m/s"), "R_p": ("µm", "m"), "rho_p": ("kg/m³", "kg/m³"),
        "k_1": ("–", "–"),
    }  # fmt: skip
    assert {
        key: (cells[f"D{rows[key]}"].text, cells[f"G{rows[key]}"].text) for key in expected
    } == expected


def test_every_claim_is_shown(published: Workbook) -> None:
    assert {cell.claim for cell in published.plan.cells.values()} - {""} == set(LEDGER.claims)


def test_the_workbook_of_another_report_shows_its_texts(build: Callable[..., Workbook]) -> None:
    ledger = LEDGER
    for name, text in {
        "depth-beta-5": "7.66", "copper-yield": "91", "particle-volume": "5576",
        "figure-5-velocity-least": "410", "frank-zook-rha": "0.279", "a1-mass": "4.97E-11",
        "particle-size-greatest": "31", "walker-anderson-alpha": "8.6",
    }.items():  # fmt: skip
        ledger = ledger.misprint(name, text)
    book = build(ledger=ledger)
    for place, cell in book.plan.cells.items():
        assert not cell.claim or shows_its_claim(cell, ledger), place
    beside = [cell.number for at, cell in sheet(book, "Inputs").cells.items() if at[0] == "H"]
    assert {410, 31, 91} <= {*beside}


@pytest.mark.parametrize(
    ("name", "symbol", "meanings"),
    [
        ("Crater", "2a", {"diameter of the contact circle": "", "the same": "< 20"}),
        (
            "Resistance and Frank-Zook", "S",
            {
                "strength, feathery grains": "110 ksi", "strength, clear grains": "98 ksi",
                "strength, bulk material": "~30 ksi", "mean of the two kinds of grain": "",
            },
        ),
        (
            "Resistance and Frank-Zook", "",
            {"clear grains over bulk": "several times", "mean over bulk": ""},
        ),
    ],
)  # fmt: skip
def test_printed_texts_stand_beside_their_quantities(
    published: Workbook, name: str, symbol: str, meanings: dict[str, str]
) -> None:
    at = sheet(published, name).cells.get
    lines = (tuple(at(f"{column}{row}", Cell()) for column in "ABCE") for row in range(1, 50))
    beside = {b.text: e.text for a, b, c, e in lines if c.formula and a.text == symbol}
    assert beside == meanings


def test_a_bound_is_shown_as_one(published: Workbook) -> None:
    for key, column, text in (("X_D_crater", "E", "< one-sixth"), ("excess_high", "M", "> two")):
        name, address = published.plan.where[key]
        assert sheet(published, name).cells[f"{column}{address[1:]}"].text == text


def test_the_workbook_of_another_case_prints_only_what_concerns_it(own: Workbook) -> None:
    shown = {
        cell.claim
        for (name, _), cell in own.plan.cells.items()
        if name in ("Overview", "Sheet beta 5")
    }
    assert shown == {"", "excess"}


def test_the_workbook_of_a_reports_case_prints_its_results(build: Callable[..., Workbook]) -> None:
    cells = build(BETA_5).plan.cells.values()
    assert {"depth-beta-5", "ratio-beta-5"} <= {cell.claim for cell in cells}


# The cells of claims


THROUGH_PRINT = {
    "ratio-beta-3", "ratio-beta-5", "excess", "beta-range-least", "beta-range-greatest",
}  # fmt: skip
"""Claims that the audit computes from printed results, but the workbook from computed ones."""


def test_each_cell_of_a_claim_computes_it(published: Workbook, record: Record) -> None:
    """In its unit; the live verdict agrees with the audit."""
    assert len(published.plan.claims) > 50
    for name, place in published.plan.claims.items():
        cell, judged = published.plan.cells[place], record.claim(name)
        assert cell.formula
        assert cell.unit == LEDGER.claims[name].unit, name
        expected = OTHERWISE if judged.verdict == "not reproduced" else AS_PRINTED
        assert published.values[f"audit.{name}.verdict"] == expected
        if judged.computed is not None and name not in THROUGH_PRINT:
            value = published.values[cell.key]
            assert value == pytest.approx(judged.computed, rel=1e-9, abs=0), name


def test_a_claim_has_one_cell_and_the_audits_file_names_it(
    published: Workbook, record: Record
) -> None:
    own = list(chain.from_iterable(plan.claims for plan in published.plan.sheets))
    assert max(Counter(own).values()) == 1
    places = published.plan.claims
    cells = {name: f"{sheet_name}!{address}" for name, (sheet_name, address) in places.items()}
    assert cells == dict(cells_of_claims())
    documents = [claim_document(claim) for claim in record.claims]
    assert {d["id"]: d["workbook"] for d in documents if d["workbook"]} == cells
    links = {cell.text for cell in sheet(published, "Audit").cells.values()}
    assert set(cells.values()) <= links


def test_live_verdicts_under_the_centered_scheme_are_the_audits(centered: Workbook) -> None:
    for claim in LEDGER.claims.values():
        if claim.id in centered.plan.claims and claim.by_scheme:
            assert centered.values[f"audit.{claim.id}.verdict"] == AS_PRINTED, claim.id
    audit = sheet(centered, "Audit").cells
    texts = [audit[f"P{row}"].text for row in range(12, 12 + len(LEDGER.claims))]
    by_scheme = [claim.by_scheme for claim in LEDGER.claims.values()]
    assert [text.startswith("With the published scheme: ") for text in texts] == by_scheme


def test_each_number_of_table_a1_prints_as_it_does_in_the_report(published: Workbook) -> None:
    claims = [claim for claim in LEDGER.claims.values() if claim.place.cell]
    cells, values = sheet(published, "Table A-1").cells, published.values
    assert len(claims) == 30
    for claim in claims:
        cell = cells[str(claim.place.cell)]
        value, scientific = values[cell.key], cell.shown == "0.00E+00"
        assert (f"{value:.2E}" if scientific else f"{value:g}".upper()) == claim.text
        assert abs(float(values[f"table_check.{claim.place.cell}.difference"])) <= 0.5
    for address in LEDGER.blank:
        cell = cells.get(address, Cell())
        assert (cell.text, cell.key, cell.number) == ("", "", None)


# Sheets


NAMES = [
    "Overview", "Inputs", "Table A-1", "Sheet beta 3", "Sheet beta 5", "Sheet beta 3 coarse",
    "Sheet beta 5 coarse", "Figures 3 and 5", "Convergence", "Crater", "Resistance and Frank-Zook",
    "Solve", "Audit",
]  # fmt: skip


def test_the_reports_workbook_has_these_sheets(published: Workbook) -> None:
    assert [plan.name for plan in published.plan.sheets] == NAMES
    assert not [name for name in NAMES if re.search(r"[,'\[\]:*?/\\]", name) or len(name) > 31]


def test_the_workbook_of_another_case_lacks_what_concerns_only_the_report(own: Workbook) -> None:
    only = {"Sheet beta 3", "Sheet beta 3 coarse", "Sheet beta 5 coarse", "Audit"}
    assert [plan.name for plan in own.plan.sheets] == [n for n in NAMES if n not in only]


def test_a_given_resistance_takes_the_place_of_beta(build: Callable[..., Workbook]) -> None:
    given = build(replace(BETA_5, beta=None, flow_stress=None, resistance=2.5e9))
    assert not {"beta", "Y_t"} & given.values.keys()
    assert given.values["R_t"] == 2.5e9


@pytest.mark.parametrize("scheme", ["published", "centered"])
def test_the_front_sheet_names_the_scheme(request: pytest.FixtureRequest, scheme: str) -> None:
    text = sheet(request.getfixturevalue(scheme), "Overview").cells["A2"].text
    velocity = {"published": "initial", "centered": "middle"}[scheme]
    words = f"{scheme} scheme: the drag is taken at the {velocity} velocity of a row."
    assert text.endswith(words)


def test_the_front_sheet_tells_what_holds_and_links_to_it(
    published: Workbook, record: Record
) -> None:
    front = sheet(published, "Overview")
    words = " ".join(cell.text for cell in front.cells.values())
    assert record.headline in words
    for claim in record.claims:
        if claim.verdict in ("not reproduced", "inconsistent"):
            assert claim.claim.title in words
            assert claim.explanation.split(".")[0] in words
    links = {cell.text: address for address, cell in front.cells.items() if cell.link}
    for verdict, count in record.summary.items():
        if count:
            assert front.cells[f"B{links[verdict][1:]}"].number == count
    assert set(NAMES) - {"Overview"} <= set(links)
    assert "Written by coldspray" in words
    assert "Unprotect Sheet" in words


def test_the_audit_lists_every_claim(published: Workbook) -> None:
    rows = range(12, 12 + len(LEDGER.claims))
    audit = sheet(published, "Audit")
    assert [audit.cells[f"A{row}"].text for row in rows] == [*LEDGER.claims]
    assert audit.filtered == f"A11:P{rows[-1]}"


def test_links_lead_to_cells_and_every_sheet_leads_home(published: Workbook) -> None:
    cells = published.plan.cells
    assert all(cell.link in cells for cell in cells.values() if cell.link)
    for plan in published.plan.sheets[1:]:
        assert ("Overview", "A1") in [cell.link for cell in plan.cells.values()]


def test_inputs_stand_apart_and_refuse_what_is_a_factor_of_a_million_off(
    published: Workbook,
) -> None:
    """The column of inputs has nothing else, so that pasting into it breaks no formula."""
    for address, cell in sheet(published, "Inputs").cells.items():
        if address[0] == "C" and int(address[1:]) > 9:
            assert cell.limits
            assert not cell.formula
            factor = {"um": 1e-6, "ns": 1e-9, "MPa": 1e6, "GPa": 1e9}.get(cell.unit, -1.0)
            (least, most), number = cell.limits, published.values[cell.key]
            assert least <= number <= most, cell.key
            assert not least <= number * factor <= most, cell.key


def test_no_key_stands_twice_even_if_case_is_ignored(book: Workbook) -> None:
    """Excel does not distinguish names that differ only in case; a name is a key."""
    keys = [cell.key.casefold() for cell in book.plan.cells.values() if cell.key]
    assert max(Counter(keys).values()) == 1


def test_names_look_like_no_cell_or_column(book: Workbook) -> None:
    names = [cell.key for cell in book.plan.cells.values() if cell.named]
    assert len(names) > 100
    assert [name for name in names if re.fullmatch(r"(?i)[a-z]{1,3}\d*|r\d*c?\d*|c\d*", name)] == []


@pytest.mark.parametrize(
    ("steps", "rows"),
    [(0, 100), (1, 200), (99, 200), (100, 200), (131, 300), (178, 400), (9000, 18000)],
)
def test_twice_the_steps_are_prepared(steps: int, rows: int) -> None:
    assert prepared_rows(steps) == rows


def test_too_many_rows_are_refused() -> None:
    message = "^the workbook would need 20,001 rows, more than 20,000: take a larger step$"
    with pytest.raises(ValueError, match=message):
        prepared_rows(20001)


# Layout


def width(plan: SheetPlan, first: str, last: str) -> int:
    """Return the width of columns in pixels at 100 %; a column without a width has the default."""
    columns = map(chr, range(ord(first), ord(last) + 1))
    return sum(int(plan.widths.get(column, 8.43) * 7 + 5) for column in columns)


def test_printed_type_is_at_least_6_5_points(book: Workbook) -> None:
    """Of 10 points, scaled so that columns and rows fit their pages of letter paper.

    A pixel is 1/96 inch; the row of the title is higher, and so is one in which a text takes two
    lines. Every page but the first repeats the heads.
    """
    beside, above = MARGINS["left"] + MARGINS["right"], MARGINS["top"] + MARGINS["bottom"]
    for plan in book.plan.sheets:
        area = plan.print_area or " ".join(plan.cells)
        columns, rows = re.findall("[A-Z]+", area), [*map(int, re.findall(r"\d+", area))]
        across, down = (8.5, 11) if plan.portrait else (11, 8.5)
        assert 10 * (across - beside) * 96 / width(plan, min(columns), max(columns)) >= 6.5, (
            plan.name
        )
        wrapped = {at[1:] for at, cell in plan.cells.items() if takes_two_lines(plan, at, cell)}
        heads = plan.headed[2] - plan.headed[1] + 1 if plan.headed else 0
        lines = max(rows) + len(wrapped) + heads * (plan.most_pages - 1)
        height = (TITLE_HEIGHT + (lines - 1) * plan.row_height) / plan.most_pages
        assert 10 * (down - above) * 72 / height >= 6.5, plan.name


def test_heads_stand_over_what_they_name_on_the_side_of_its_text(book: Workbook) -> None:
    """Those of numbers on the right, those of texts on the left; in column A all on the left."""
    for plan in book.plan.sheets:
        for address, head in plan.cells.items():
            if head.text and head.style in ("head right", "head unit"):
                below = plan.cells.get(f"{address[0]}{int(address[1:]) + 1}")
                if below and below.style != "block":
                    aligned = STYLES[below.style].get("align") == "right"
                    assert (head.style == "head right") == aligned, (plan.name, address)


def test_what_follows_a_blank_row_has_a_head(book: Workbook) -> None:
    for plan in book.plan.sheets:
        first = {int(re.sub(r"\D", "", at)): cell for at, cell in reversed(plan.cells.items())}
        for row, cell in first.items():
            if row - 1 not in first and row > 1:
                assert cell.style in ("head", "head unit", "block", "note", "link"), (
                    plan.name,
                    row,
                )


@pytest.mark.parametrize(
    ("name", "head"),
    [
        ("Audit", "The audit’s verdict"),
        ("Inputs", "Check"),
        ("Table A-1", "Difference"),
        ("Overview", "State of the run"),
    ],
)
def test_verdicts_and_checks_stand_on_the_first_screen(
    published: Workbook, name: str, head: str
) -> None:
    """Of 1366 pixels, less the row numbers and the scroll bar."""
    plan = sheet(published, name)
    heads = [address for address, cell in plan.cells.items() if cell.text == head]
    assert width(plan, "A", heads[0][0]) <= 1366 - 60


def test_curves_differ_in_more_than_color() -> None:
    looks = CURVES.values()
    assert len({look.dash for look in looks}) == len({look.marker for look in looks}) == 2


@pytest.mark.parametrize(
    ("name", "count"), [("Overview", 1), ("Figures 3 and 5", 2), ("Convergence", 1)]
)
def test_charts_have_titles_with_units_and_numbers_to_draw(
    published: Workbook, name: str, count: int
) -> None:
    charts = sheet(published, name).charts
    assert len(charts) == count
    for chart in charts:
        assert "[" in chart.x_title
        assert "[" in chart.y_title
        for curve in chart.curves:
            assert bool(published.plan.cells[curve.name].formula) == (name != "Convergence")
            for cells in (curve.x, curve.y):
                first, last = cells.split(":")
                rows = range(int(first[1:]), int(last[1:]) + 1)
                shown = published.cells[chart.sheet or name]
                assert all(isinstance(shown[f"{first[0]}{row}"], float) for row in rows)


@pytest.mark.parametrize(
    ("name", "number", "description"),
    [
        (
            "Figures 3 and 5",
            0,
            "Line chart: depth x in µm against time in ns, one curve for each case, the first solid"
            " and the second dashed. As written, β = 3 reaches 10.03 µm after 35.6 ns, β = 5"
            " reaches 7.67 µm after 26.2 ns.",
        ),
        (
            "Figures 3 and 5",
            1,
            "Line chart: normalized depth X/R at rest against impact velocity in m/s. As written,"
            " for β = 5, from 0.553 at 400 m/s to 0.698 at 500 m/s.",
        ),
        (
            "Convergence",
            0,
            "Line chart with logarithmic axes: size of the error of the final depth in µm against"
            " the time step in ns, the first case solid, the second dashed. For β = 3 from 0.17 µm"
            " at 3.2 ns to 0.0011 µm at 0.025 ns, β = 5 from 0.12 µm at 3.2 ns to 0.00068 µm at"
            " 0.025 ns.",
        ),
    ],
)
def test_charts_are_described_in_words(
    published: Workbook, name: str, number: int, description: str
) -> None:
    assert sheet(published, name).charts[number].describe(published.values) == description
