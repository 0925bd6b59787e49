"""A plan and its values -> one .xlsx file: live formulas, each stored with its computed value.

The same plan and values give the same bytes wherever and whenever they are written.
"""

import math
from collections.abc import Mapping
from datetime import datetime
from io import BytesIO
from pathlib import Path
from typing import Any

from spreadsheets.charts import draw
from spreadsheets.plan import Cell, Limits, SheetPlan, Value, WorkbookPlan
from spreadsheets.safely import write_bytes
from spreadsheets.styles import STYLES

__all__ = ["cell_values", "to_bytes", "write"]

_CREATED = datetime(2006, 1, 1)
"""A fixed date, the report's year: XlsxWriter would take the clock."""


def cell_values(plan: WorkbookPlan, values: Mapping[str, Value]) -> dict[str, dict[str, Value]]:
    """What every cell of the workbook shows, by sheet and address, texts included.

    Raises ValueError unless `values` has exactly the keys of the plan and every number is finite.
    """
    _check(plan, values)
    shown: dict[str, dict[str, Value]] = {sheet.name: {} for sheet in plan.sheets}
    for (sheet, address), cell in plan.cells():
        if cell.key or cell.text:
            shown[sheet][address] = values[cell.key] if cell.key else cell.text
    return shown


def write(path: Path, plan: WorkbookPlan, values: Mapping[str, Value]) -> None:
    """Write the workbook to `path`, whole or not at all. Raises as `cell_values` does."""
    write_bytes(path, to_bytes(plan, values))


def to_bytes(plan: WorkbookPlan, values: Mapping[str, Value]) -> bytes:
    """The bytes of the .xlsx file."""
    import xlsxwriter

    _check(plan, values)
    buffer = BytesIO()
    book = xlsxwriter.Workbook(buffer, {"in_memory": True})
    formats = _Formats(book)
    book.set_properties({**_properties(plan), "created": _CREATED})
    exact = _exact_worksheet()
    for sheet in plan.sheets:
        page = book.add_worksheet(sheet.name, exact)
        _set_up(page, sheet)
        _fill(page, sheet, values, formats)
        _define_names(book, sheet)
        for chart in sheet.charts:
            draw(book, page, sheet.name, chart)
    book.close()
    return buffer.getvalue()


def _check(plan: WorkbookPlan, values: Mapping[str, Value]) -> None:
    missing = sorted(plan.where.keys() - values.keys())
    surplus = sorted(values.keys() - plan.where.keys())
    for what, keys in (("missing", missing), ("surplus", surplus)):
        if keys:
            raise ValueError(f"{len(keys)} {what} value(s), the first is {keys[0]!r}")
    for key, value in values.items():
        if isinstance(value, float) and not math.isfinite(value):
            sheet, address = plan.where[key]
            raise ValueError(f"{key} ({sheet}!{address}) is {value}: not a number a cell can hold")


def _properties(plan: WorkbookPlan) -> dict[str, str]:
    names = ("title", "author", "subject", "keywords", "comments")
    return {name: getattr(plan, name) for name in names}


class _Formats:
    """One format object for each style and number format in use."""

    def __init__(self, book: Any) -> None:
        self._book = book
        self._made: dict[tuple[str, str], Any] = {}

    def __call__(self, style: str, number_format: str = "General") -> Any:
        if (style, number_format) not in self._made:
            properties = {**STYLES[style], "num_format": number_format}
            self._made[style, number_format] = self._book.add_format(properties)
        return self._made[style, number_format]

    def rule(self, style: str) -> Any:
        """A format for a rule: the properties it changes, without a font or number format."""
        return self._book.add_format(STYLES[style])


def _set_up(page: Any, sheet: SheetPlan) -> None:
    """Scrolling, column widths and print set-up."""
    page.hide_gridlines(2)
    if sheet.frozen:
        page.freeze_panes(sheet.frozen)
    for column, width in sheet.widths.items():
        page.set_column(f"{column}:{column}", width)
    page.set_landscape()
    page.set_paper(1)  # US Letter
    page.set_margins(left=0.5, right=0.5, top=0.75, bottom=0.75)
    page.fit_to_pages(1, 0)
    page.set_header('&L&"Arial"&9&F&R&"Arial"&9&A')
    page.set_footer('&R&"Arial"&9Page &P of &N')
    if sheet.print_area:
        page.print_area(sheet.print_area)
    if sheet.repeated_rows:
        first, last = sheet.repeated_rows
        page.repeat_rows(first - 1, last - 1)


def _fill(page: Any, sheet: SheetPlan, values: Mapping[str, Value], formats: _Formats) -> None:
    for address, cell in sheet.cells.items():
        _write_cell(page, address, cell, values, formats(cell.style, cell.number_format))
    for rule in sheet.rules:
        options = {"type": "formula", "criteria": rule.formula, "format": formats.rule(rule.style)}
        page.conditional_format(rule.cells, options)


def _write_cell(
    page: Any, address: str, cell: Cell, values: Mapping[str, Value], style: Any
) -> None:
    if cell.link:
        sheet, target = cell.link
        page.write_url(address, f"internal:'{sheet}'!{target}", style, cell.text)
    elif cell.text:
        page.write_string(address, cell.text, style)
    elif cell.formula:
        page.write_formula(address, cell.formula, style, values[cell.key])
    elif cell.key:
        page.write_number(address, values[cell.key], style)
    else:
        page.write_blank(address, None, style)
    if cell.limits:
        page.data_validation(address, _validation(cell, cell.limits))


def _validation(cell: Cell, limits: Limits) -> dict[str, Any]:
    """What a spreadsheet program asks of a typed number, and says before and after."""
    unit = "" if cell.unit == "1" else f", in {cell.unit}"
    settings: dict[str, Any] = {
        "validate": "decimal",
        "input_title": cell.name,
        "input_message": f"A number {limits.words}{unit}.",
        "error_title": "Out of range",
        "error_message": f"{cell.name} is a number {limits.words}{unit}.",
    }
    if limits.most is None:
        return settings | {"criteria": ">=" if limits.closed else ">", "value": limits.least}
    # A validation knows no half-open range: the check beside the cell refuses the lower end.
    return settings | {"criteria": "between", "minimum": limits.least, "maximum": limits.most}


def _define_names(book: Any, sheet: SheetPlan) -> None:
    for address, cell in sheet.cells.items():
        if cell.name:
            column, row = address.rstrip("0123456789"), address.lstrip("ABCDEFGHIJKLMNOPQRSTUVWXYZ")
            if book.define_name(cell.name, f"='{sheet.name}'!${column}${row}") == -1:
                raise ValueError(f"{cell.name!r} cannot name a cell in a workbook")


def _exact_worksheet() -> type[Any]:
    """A worksheet that stores numbers with all their digits, and "" as the text that it is.

    XlsxWriter writes a plain number with 16 digits, which a quarter of all doubles do not survive,
    and gives a formula whose value is "" no type, which makes the value a number without digits.
    """
    from xlsxwriter.worksheet import Worksheet

    class ExactWorksheet(Worksheet):  # type: ignore[misc]
        def _xml_number_element(self, number: float, attributes: Any = ()) -> None:
            places = "".join(f' {key}="{value}"' for key, value in attributes)
            self.fh.write(f"<c{places}><v>{float(number)!r}</v></c>")

        def _xml_formula_element(self, formula: str, result: Any, attributes: Any = ()) -> None:
            if result == "":
                attributes = [*attributes, ("t", "str")]
            super()._xml_formula_element(formula, result, attributes)

    return ExactWorksheet
