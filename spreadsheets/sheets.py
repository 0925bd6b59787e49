"""Plan of the whole workbook, and of all sheets but those of `cases.py`.

`Overview`, the first, lists the results, whether they can be trusted, what the audit found, and the
other sheets. `Audit` lists every claim of the ledger, with a live verdict if a cell computes it.
`Figure 3`, `Figure 5` and `Convergence` are charts, with the numbers behind them.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from itertools import zip_longest
from textwrap import wrap

from reference.ledger import Claim, Ledger
from spreadsheets.cases import (
    SCHEMES,
    CaseSheet,
    case_sheet,
    claims_in_table,
    inputs_of,
    inputs_sheet,
    table_a1,
)
from spreadsheets.plan import (
    HOME,
    MESSAGES,
    NOT_COMPUTED,
    TABLES,
    Cell,
    Curve,
    Rule,
    SheetPlan,
    WorkbookPlan,
    filled,
    filled_in,
    formula,
    guarded,
    place_of,
    printed,
    recorded,
    unit_text,
)

PROGRAM = f"coldspray {version('coldspray')}"

AS_PRINTED, OTHERWISE = "as printed", "not as printed"
KINDS = ((AS_PRINTED, "as_printed"), (OTHERWISE, "otherwise"), (NOT_COMPUTED, "none"))
"""Each live verdict, and the ending of the name of the cell that counts it."""


@dataclass(frozen=True, slots=True)
class Findings:
    """What the workbook shows of a finished audit, as texts and numbers.

    counts: number of entries by verdict. verdicts, explanations: by claim. failing: claims that do
    not follow from what the report says. differing: claims that public sources contradict.
    """

    headline: str
    counts: Mapping[str, int]
    verdicts: Mapping[str, str]
    explanations: Mapping[str, str]
    failing: Sequence[str]
    differing: Sequence[str]


def workbook_plan(
    ledger: Ledger, pages: Sequence[CaseSheet], findings: Findings | None = None
) -> WorkbookPlan:
    """Plan the workbook for one or two cases; `Table A-1` and `Figure 5` show the last of them.

    With `findings` it is the report's own workbook, and also has what concerns only the report;
    `pages` must then contain the same cases with the coarser step, too. Raises ValueError if the
    ledger names a cell for a claim, and that cell has no formula.
    """
    report, cases = findings is not None, [page for page in pages if not page.coarse]
    table = table_a1(ledger, cases[-1], report)
    sheets = [inputs_sheet(ledger, cases, report), table]
    sheets += [_table_a1_check(ledger, table)] if report else []
    sheets += [case_sheet(ledger, page) for page in pages]
    sheets += [_figure_3(cases), _figure_5(cases[-1]), _convergence(cases)]
    words = [{**case.words, "third": ledger.value("observed-third")} for case in cases]
    sheets += [_formulas(ledger, name, words) for name in ("Frank-Zook", "Crater", "Resistance")]
    sheets += [_audit(ledger, findings)] if findings else []
    about = {name: getattr(ledger.report, name) for name in ("title", "author", "year")}
    properties = filled_in(TABLES["properties"], {**about, "program": PROGRAM})
    overview = _overview(ledger, pages, sheets, findings)
    plan = WorkbookPlan(sheets=(overview, *sheets), properties=properties)
    for claim in ledger.claims.values() if report else ():
        if claim.workbook and not plan.cells.get(place_of(claim.workbook), Cell()).formula:
            reason = f"the workbook computes nothing in {claim.workbook}"
            raise ValueError(f"claim {claim.id!r}: {reason}")
    return plan


def _table_heads(page: SheetPlan, table: str, right: str = "") -> None:
    """Add the heads of a table of `Overview`, after a blank row."""
    heads = page.entry["heads"][table]
    page.row += 1
    page.heads("ABCDEF", heads + [""] * (6 - len(heads)), right)


def _overview(
    ledger: Ledger, pages: Sequence[CaseSheet], sheets: Sequence[SheetPlan],
    findings: Findings | None,
) -> SheetPlan:  # fmt: skip
    """Plan the first sheet; `sheets` are the others, to which it links."""
    report, scheme = ledger.report, pages[0].scheme
    page = SheetPlan.begun(HOME)
    title = filled(TABLES["properties"]["title"], {"title": report.title})
    page.put(A=Cell(title, "title"))
    page.say(
        f"After the report by {report.author} ({report.year}). Written by {PROGRAM}; "
        f"{scheme} scheme: {SCHEMES[scheme]}.",
        style="body",
    )
    if findings is not None:
        page.say(findings.headline, style="headline", width=140)
    _results(page, ledger, pages)
    if findings is not None:
        _failures(page, ledger, findings)
        page.page_break = page.row
    _table_heads(page, "sheets")
    for sheet in sheets:
        link = Cell(sheet.name, "link", link=(sheet.name, "A1"))
        page.put(A=link, B=Cell(sheet.entry["shows"]))
    _table_heads(page, "how_to_read")
    for style, meaning in page.entry["how_to_read"].items():
        page.put(A=Cell("1.23", f"{style} sample"), B=Cell(meaning, "text"))
    page.print_area = f"A1:F{page.row - 1}"
    return page


def _results(page: SheetPlan, ledger: Ledger, cases: Sequence[CaseSheet]) -> None:
    """Add the final depth of every case, the state of its run, and the counts of inputs."""
    _table_heads(page, "results", right="BCDE")
    for case in cases:
        key, sheet, suffix = f"overview.{case.part}", f"'{case.name}'!", case.suffix
        look = {"style": "result", "shown": "0.0000"}
        in_um = {"unit": "um", "like": f"{case.part}.depth_um"}
        depth, ratio = case.words["depth_claim"], case.words["ratio_claim"]
        # A sheet keeps its name if beta is changed: the state then begins with the beta in use.
        beta = "" if case.resistance_given else f'IF({sheet}I2="","",{sheet}I1&": ")&'
        page.rules += case.rules(f"F{page.row}")
        page.put(
            A=Cell(case.name, "link", link=(case.name, "A1")),
            B=formula(f"{key}.depth_um", f"=depth_um{suffix}", **in_um, **look),
            D=formula(f"{key}.normalized_depth", f"=normalized_depth{suffix}", **look),
            F=formula(f"{key}.message", f"={beta}message{suffix}", "state"),
            C=printed(ledger, depth, "um") if depth else None,
            E=printed(ledger, ratio) if ratio else None,
        )
    for name, label in page.entry["counts"].items():
        page.rules.append(Rule(f"B{page.row}", f"={name}>0", "warning"))
        count = formula(f"overview.{name}", f"={name}", "result")
        page.put(A=Cell(label, "link", link=("Inputs", "A1")), B=count)


def _failures(page: SheetPlan, ledger: Ledger, findings: Findings) -> None:
    """Add the claims that fail, each with its explanation, and the counts of all verdicts."""
    for table, names in (("failing", findings.failing), ("differing", findings.differing)):
        _table_heads(page, table, right="BC")
        for name in names:
            claim = ledger.claims[name]
            first, *more = wrap(findings.explanations[name], 100)
            cells = {"A": Cell(claim.title), "B": printed(ledger, name), "D": Cell(first, "text")}
            if claim.workbook:
                reference = "='{}'!{}".format(*place_of(claim.workbook))
                shown = "0.0" if ledger.value(name) > 100 else "0.0000"
                cells["C"] = formula(f"overview.{name}", reference, "result", shown=shown)
            page.put(**cells)
            for line in more:
                page.put(D=Cell(line, "text"))
    _table_heads(page, "verdicts", right="BDE")
    counted = [(verdict, count) for verdict, count in findings.counts.items() if count]
    for (verdict, count), kind in zip_longest(counted, KINDS[: len(counted)]):
        cells = {"A": Cell(verdict, "link", link=("Audit", "A1")), "B": recorded(float(count))}
        if kind:
            cells["D"] = Cell(kind[0], "number")
            cells["E"] = formula(f"overview.audit_{kind[1]}", f"=audit_{kind[1]}", "result")
        page.put(**cells)
    page.say(page.entry["about_verdicts"])


def _formulas(ledger: Ledger, name: str, words: Sequence[Mapping[str, object]]) -> SheetPlan:
    """Plan a sheet of closed formulas: notes and one table. Keys begin with the sheet's name."""
    page, part = SheetPlan.begun(name), name.lower().replace("-", "_")
    page.widths = {c: width for c, (_, width) in zip("ABCDEF", TABLES["lines"], strict=True)}
    page.row += 1
    page.headed = "A", page.row, page.row
    page.lines(ledger, part, TABLES[part], words)
    return page


# The audit, and the check of Table A-1, which repeats its live verdicts

_HEAD_ROW = 11

DIGITS = 4
"""Decimals of a difference; rounding makes 0 of 3 times 0.2 ns minus 0.6 ns."""


def _verdict_colors(cells: str) -> list[Rule]:
    """Return the rules that color the live verdicts in these cells of one column."""
    first = cells.partition(":")[0]
    styles = {AS_PRINTED: "good", OTHERWISE: "warning", NOT_COMPUTED: "changed"}
    return [Rule(cells, f'=${first}="{words}"', style) for words, style in styles.items()]


def _audit(ledger: Ledger, findings: Findings) -> SheetPlan:
    """Plan the sheet of all claims; the ledger names the cell that computes a claim."""
    last = _HEAD_ROW + len(ledger.claims)
    verdicts = f"F{_HEAD_ROW + 1}:F{last}"
    page = SheetPlan.begun("Audit")
    page.print_area, page.filtered = f"A1:I{last}", f"A{_HEAD_ROW}:L{last}"
    page.row = 6
    page.put(A=Cell("Live verdicts", "block"))
    for verdict, ending in KINDS:
        expression = f'=COUNTIF({verdicts},"{verdict}")'
        count = formula(f"audit.{ending}", expression, "message", name=f"audit_{ending}")
        page.put(A=Cell(verdict, "text"), B=count)
    page.row = _HEAD_ROW
    page.table("CEHI", "B")
    for claim in ledger.claims.values():
        page.put(**_claim_row(ledger, claim, findings, page.row))
    page.rules = _verdict_colors(verdicts)
    return page


def _table_a1_check(ledger: Ledger, table: SheetPlan) -> SheetPlan:
    """Plan the comparison of each number that Table A-1 prints with the one computed."""
    page = SheetPlan.begun("Table A-1 check")
    page.row = 6
    page.table("DEFH", "B")
    first, in_audit = page.row, {name: row for row, name in enumerate(ledger.claims, _HEAD_ROW + 1)}
    for address, claim in claims_in_table(ledger).items():
        assert claim.printed is not None
        row, key, computed = page.row, f"table_check.{address}", f"='{table.name}'!{address}"
        difference = f"ROUND((E{row}-D{row})/H{row},{DIGITS})"
        if claim.is_exact:
            difference = f"E{row}-D{row}"
        difference = f'=IF(ISNUMBER(E{row}),{difference},"–")'
        shown, live = table.cells[address].shown, f"='Audit'!F{in_audit[claim.id]}"
        page.put(
            A=Cell(address, "link", link=(table.name, address)),
            B=Cell(claim.title),
            C=unit_text(claim.unit),
            D=recorded(float(claim.printed.value), claim=claim.id, shown=shown),
            E=formula(f"{key}.computed", computed, shown="0.0000000000000000E+00", unit=claim.unit),
            F=formula(f"{key}.difference", difference, "result", shown="0.0000"),
            G=formula(f"{key}.verdict", live, "text"),
            H=recorded(float(claim.printed.quantum), shown="0E+00"),
        )
    page.rules = _verdict_colors(f"G{first}:G{page.row - 1}")
    return page


def _claim_row(ledger: Ledger, claim: Claim, findings: Findings, row: int) -> dict[str, Cell]:
    """Return a claim's row; if a cell computes it, with a live verdict and the printed interval."""
    cells = {
        "A": Cell(claim.id),
        "B": Cell(claim.title, wrap=True),
        "C": printed(ledger, claim.id, claim.unit, wrap=True),
        "D": unit_text(claim.unit),
        "G": Cell(findings.verdicts[claim.id], "text", wrap=True),
        "J": Cell(str(claim.place), "unit"),
        "L": Cell(findings.explanations[claim.id], "unit"),
    }
    if not claim.workbook:
        return cells | {"F": Cell("–", "text")}
    # Fixed decimals for most numbers, powers of ten for those that would be long.
    size = 0 if claim.printed is None else abs(claim.printed.value)
    shown = "0.0000E+00" if claim.place.cell or size >= 10**5 else "0.0000"
    key, place, interval = f"audit.{claim.id}", place_of(claim.workbook), claim.interval()
    for column, end in (("H", interval.lower), ("I", interval.upper)):
        if end is not None:
            cells[column] = recorded(float(end), shown=shown, claim=claim.id)
    return cells | {
        "E": formula(f"{key}.computed", "='{}'!{}".format(*place), shown=shown, unit=claim.unit),
        "F": formula(f"{key}.verdict", _live_verdict(claim, row), "text"),
        "K": Cell(claim.workbook, "link", link=place),
    }


def _live_verdict(claim: Claim, row: int) -> str:
    """Return the live verdict: whether E lies between H and I, which are open or closed ends."""
    interval, tests = claim.interval(), []
    if interval.is_point:
        # To nine digits, since no double is 2/3 and programs round it differently.
        tests = [f"ABS(E{row}-H{row})*1000000000<=ABS(H{row})"]
    else:
        if interval.upper is not None:
            tests += [f"E{row}{'<=' if interval.upper_closed else '<'}I{row}"]
        if interval.lower is not None:
            tests += [f"E{row}{'>=' if interval.lower_closed else '>'}H{row}"]
    verdict = f'"{AS_PRINTED}"'
    for test in tests:
        verdict = f'IF({test},{verdict},"{OTHERWISE}")'
    return f'=IF(ISNUMBER(E{row}),{verdict},"{NOT_COMPUTED}")'


# Charts, with the numbers behind them


def _figure_3(cases: Sequence[CaseSheet]) -> SheetPlan:
    """Plan the chart of depth against time, one curve for each case."""
    curves, written = [], []
    page = SheetPlan.begun("Figure 3")
    page.single_cells()
    for row, (columns, case) in enumerate(zip(("PQ", "RS"), cases, strict=False), start=3):
        key = f"figure_3.{case.slug}"
        message = f"='{case.name}'!I1&\": \"&message{case.suffix}"
        page.cells[f"A{row}"] = formula(f"{key}.message", message, "message")
        page.rules += case.rules(f"A{row}")
        page.row = 4
        page.put(**{columns[0]: Cell(case.name, "block")})
        entries = page.entry["columns"].values()
        page.grid(dict(zip(columns, entries, strict=True)), key, case.words, case.rows + 1)
        x, y = (f"{column}7:{column}{page.row - 1}" for column in columns)
        curves.append(Curve((case.name, "I1"), x, y))
        end = f"{{{case.slug}.depth_um:.4g}} µm after {{{key}.time[{case.rows}]:.3g}} ns"
        written.append(f"{case.label} reaches {end}")
    page.curves, page.written = curves, ", ".join(written)
    return page


POINTS = 21
"""Number of velocities in Figure 5, including both ends."""


def _figure_5(case: CaseSheet) -> SheetPlan:
    """Plan the chart of normalized depth against velocity; the report's own is for beta = 5."""
    page, first, last = SheetPlan.begun("Figure 5"), 7, 7 + POINTS - 1
    missing = f"COUNT(T{first}:T{last})<{POINTS}"
    page.single_cells(missing=missing)
    page.rules = [Rule("A3", f"={missing}", "warning")]
    page.row = first - 2
    page.grid(page.entry["columns"], "figure_5", {**case.words, "last": last}, POINTS, guarded)
    low, high = (
        f"{{figure_5.normalized_depth[{k}]:.3g}} at {{figure_5.velocity[{k}]:.4g}} m/s"
        for k in (0, POINTS - 1)
    )
    curves = [Curve((case.name, "I1"), f"Q{first}:Q{last}", f"T{first}:T{last}")]
    page.curves, page.written = curves, f"{case.label}, from {low} to {high}"
    return page


LEVELS = 8
"""Number of time steps, each half of the one before; the fifth is dt_s as written."""


def run_inputs(cases: Sequence[CaseSheet]) -> list[str]:
    """Return the names of all numbers on which the runs depend: inputs, derived numbers and π."""
    blocks = inputs_of(cases, report=False).values()
    typed = [entry.name for block in blocks for entry in block if entry.attribute]
    return list(
        dict.fromkeys([*typed, "D_p", "M_p", "pi_", *(f"R_t{case.input_suffix}" for case in cases)])
    )


NO_ORDER = "–"
"""Stands for an order that is undefined."""


def _convergence(cases: Sequence[CaseSheet]) -> SheetPlan:
    """Plan the errors of the final depth at eight time steps, and the inputs of these runs."""
    curves, written = [], []
    page = SheetPlan.begun("Convergence", scheme=cases[0].scheme)
    page.rules = [Rule("A3", f'=$A$3="{MESSAGES["stale"]}"', "warning")]
    page.row = 8
    page.heads("HIJK", ("Input", "Of these runs", "In use", ""), "IJ")
    first, shown = page.row, "0.0####E+00"
    for name in run_inputs(cases):
        # To twelve digits, since programs differ in how they round a conversion of units.
        same = f"=IF(ABS(I{page.row}-J{page.row})*1000000000000<=ABS(I{page.row}),1,0)"
        same = guarded(same).replace(f'"{NOT_COMPUTED}"', "0")
        page.put(
            H=Cell(name, "text"),
            I=recorded(f"convergence.run.{name}", shown=shown),
            J=formula(f"convergence.in_use.{name}", f"={name}", shown=shown),
            K=formula(f"convergence.same.{name}", same, "text", shown='"same";;"other"'),
        )
    page.single_cells(same=f"K{first}:K{page.row - 1}")
    page.row = 36
    for case in cases:
        key, label = f"convergence.{case.slug}", f"A{page.row}"
        # The label is a text, not a formula: it names the case as it was when the runs were made.
        page.put(A=Cell(f"{case.name}, {case.label}", "block"))
        page.grid(page.entry["columns"], key, {"no_order": NO_ORDER}, LEVELS)
        x, y = (f"{column}{page.row - LEVELS}:{column}{page.row - 1}" for column in "BF")
        curves.append(Curve(("Convergence", label), x, y))
        at_rest = recorded(f"{key}.rest_um", shown=page.entry["columns"]["D"]["shown"])
        page.put(A=Cell("At rest, without steps"), D=at_rest)
        page.row += 1
        ends = (
            f"{{{key}.size[{k}]:.2g}} µm at {{{key}.step_ns[{k}]:.3g}} ns" for k in (0, LEVELS - 1)
        )
        written.append(f"{case.label} from {' to '.join(ends)}")
    page.print_area = f"A1:K{page.row - 2}"
    page.curves, page.written = curves, ", ".join(written)
    return page
