"""The sheets `Figure 3`, `Figure 5` and `Convergence`: charts, and the numbers behind them."""

from collections.abc import Sequence

from spreadsheets.plan import (
    MESSAGES,
    NOT_COMPUTED,
    Cell,
    Rule,
    SheetPlan,
    filled,
    formula,
    guarded,
    recorded,
    text,
)
from spreadsheets.sheets.steps import FIRST_ROW, CaseSheet


def figure_3(cases: Sequence[CaseSheet]) -> SheetPlan:
    """Depth against time, one curve for each case."""
    first, series, written = 7, [], []
    page = SheetPlan.begun("Figure 3")
    page.single_cells()
    for at, (columns, case) in enumerate(zip(("PQ", "RS"), cases, strict=False), start=3):
        time, depth = columns[0], columns[1]
        key, there = f"figure_3.{case.slug}", f"'{case.name}'!"
        message = f'={there}I1&": "&message{case.suffix}'
        page.cells[f"A{at}"] = formula(f"{key}.message", message, "message")
        page.rules += case.rules(f"A{at}")
        page.row = first - 3
        page.put(**{time: text(case.name, "block")})
        page.heads(columns, ("Time", "Depth"), columns, ("ns", "µm"))
        for column, what, source, shown, like in (
            (time, "time", "B{}*1000000000", "0.00", ""),
            (depth, "depth", "G{}", "0.0000", f"{case.part}.depth_um"),
        ):
            before = ["0", *(f"{column}{first + k}" for k in range(case.rows))]
            running = (
                f"=IF(ISNUMBER({there}A{row}),{there}{source.format(row)},{last})"
                for row, last in enumerate(before, FIRST_ROW)
            )
            page.column(
                f"{column}{first}", f"{key}.{what}", running, number_format=shown, column=like
            )
        x, y = (f"{column}{first}:{column}{first + case.rows}" for column in (time, depth))
        series.append(((case.name, "I1"), x, y))
        reached = f"{{{case.slug}.depth_um:.4g}} µm after {{{key}.time[{case.rows}]:.3g}} ns"
        written.append(f"{case.label} reaches {reached}")
    page.draw(series, ", ".join(written))
    return page


POINTS = 21
"""Velocities of Figure 5, both ends included."""


def figure_5(case: CaseSheet) -> SheetPlan:
    """Normalized depth against velocity for one case; the report's is that of beta = 5."""
    page, first, last = SheetPlan.begun("Figure 5"), 7, 7 + POINTS - 1
    columns = page.entry["columns"]
    missing = f"COUNT(T{first}:T{last})<{POINTS}"
    page.single_cells(missing=missing)
    page.rules = [Rule("A3", f"={missing}", "warning")]
    page.row = first - 2
    heads, units = ([entry[what] for entry in columns.values()] for what in ("head", "unit"))
    page.heads("".join(columns), heads, "".join(columns), units)
    for point in range(POINTS):
        page.cells[f"P{first + point}"] = Cell(number=float(point), style="number")
    for column, entry in columns.items():
        if "formula" in entry:
            page.column(
                f"{column}{first}",
                f"figure_5.{entry['key']}",
                (
                    guarded(filled(entry["formula"], case.words | {"row": row, "last": last}))
                    for row in range(first, last + 1)
                ),
                number_format=entry.get("shown", "0.0000"),
                transcendental=column in "STU",
            )
    low, high = (
        f"{{figure_5.normalized_depth[{k}]:.3g}} at {{figure_5.velocity[{k}]:.4g}} m/s"
        for k in (0, POINTS - 1)
    )
    series = [((case.name, "I1"), f"Q{first}:Q{last}", f"T{first}:T{last}")]
    page.draw(series, f"{case.label}, from {low} to {high}")
    return page


LEVELS = 8
"""Steps of the ladder, each half of the one before; the fifth is the step dt_s as written."""

RUN_INPUTS = ("V_impact", "R_p", "rho_p", "rho_t", "dt_s", "v_stop")
"""The inputs, besides the target resistance, that the ladder's runs were made with."""

NO_ORDER = "–"


def convergence(cases: Sequence[CaseSheet]) -> SheetPlan:
    """The final depth at a ladder of time steps against the depth at rest."""
    first, series, written = 11, [], []
    last = first + LEVELS - 1
    page = SheetPlan.begun("Convergence", scheme=cases[0].scheme)
    page.rules = [Rule("A3", f'=$A$3="{MESSAGES["stale"]}"', "warning")]
    page.row = first - 2
    page.heads("AB", ("Time step", "Time step"), "AB", ("s", "ns"))
    for k in range(LEVELS):
        ns = f"=A{page.row}*1000000000"
        page.put(
            A=recorded(f"convergence.step[{k}]", number_format="0.00E+00"),
            B=formula(f"convergence.step_ns[{k}]", ns, number_format="0.0000"),
        )
    page.put(A=text("At rest, without steps"))
    for columns, case in zip(("CDEFG", "HIJKL"), cases, strict=False):
        _levels(page, case, columns, first)
        ends = (
            f"{{convergence.{case.slug}.size[{k}]:.2g}} µm at {{convergence.step_ns[{k}]:.3g}} ns"
            for k in (0, LEVELS - 1)
        )
        written.append(f"{case.label} from {' to '.join(ends)}")
        # Called as it was when it was computed: the head of its columns.
        whose, size = ("Convergence", f"{columns[0]}{first - 3}"), columns[3]
        series.append((whose, f"B{first}:B{last}", f"{size}{first}:{size}{last}"))
    page.row = last + 4
    _same_inputs(page, [*RUN_INPUTS, *(f"R_t{case.of}" for case in cases)])
    page.draw(series, ", ".join(written))
    return page


def _levels(page: SheetPlan, case: CaseSheet, columns: str, first: int) -> None:
    """The ladder of one case; all but the order was computed when the workbook was written.

    The error, too: it is small beside the depths, and a program of long doubles reads those anew.
    """
    part, error, entries = f"convergence.{case.slug}", columns[2], page.entry["ladder"]
    page.row = first - 2
    heads, units = ([entry[what] for entry in entries.values()] for what in ("head", "unit"))
    page.heads(columns, heads, columns, units)
    page.cells[f"{columns[0]}{first - 3}"] = text(f"{case.name}, {case.label}", "block")
    at_rest = recorded(f"{part}.rest_um", number_format=entries["depth_um"]["shown"])
    page.cells[f"{columns[1]}{first + LEVELS}"] = at_rest
    for column, (what, entry) in zip(columns, entries.items(), strict=True):
        shown = {"number_format": entry["shown"]}
        if what == "order":
            orders = (
                f"LN({error}{row - 1}/{error}{row})/LN(A{row - 1}/A{row})"
                for row in range(first + 1, first + LEVELS)
            )
            orders = (f'=IFERROR({order},"{NO_ORDER}")' for order in orders)
            page.column(
                f"{column}{first + 1}", f"{part}.order", orders, 1, **shown, transcendental=True
            )
            continue
        for k in range(LEVELS):
            page.cells[f"{column}{first + k}"] = recorded(f"{part}.{what}[{k}]", **shown)


def _same_inputs(page: SheetPlan, names: Sequence[str]) -> None:
    """The inputs of the runs beside those in use, and whether they are the same."""
    page.heads("IJKL", ("Input", "Of these runs", "In use", ""), "JK")
    first, shown = page.row, "0.0####E+00"
    for name in names:
        # To twelve digits: programs round a conversion of units in their own way.
        same = f"=IF(ABS(J{page.row}-K{page.row})*1000000000000<=ABS(J{page.row}),1,0)"
        same = guarded(same).replace(f'"{NOT_COMPUTED}"', "0")
        page.put(
            I=text(name, "text"),
            J=recorded(f"convergence.run.{name}", number_format=shown),
            K=formula(f"convergence.in_use.{name}", f"={name}", number_format=shown),
            L=formula(f"convergence.same.{name}", same, "text", number_format='"same";;"other"'),
        )
    page.single_cells(same=f"L{first}:L{page.row - 1}")
