"""Write a plan and its values as an .xlsx file: live formulas, each stored with its value.

The same plan and values give the same parts on every machine and on every day, and the same bytes
with the same version of zlib. The file contains the SHA-256 digest of its parts, so that a file
that somebody changed is not taken for our own.

Cells with formulas are locked, without a password, and nothing else is: neither inputs and blank
cells, nor formats, rows and columns.
"""

import math
import re
import zipfile
from collections.abc import Mapping
from errno import EEXIST
from functools import cache
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from typing import Any

from reference.units import written
from spreadsheets.plan import Cell, Chart, SheetPlan, ShownValue, WorkbookPlan
from spreadsheets.safely import UNREADABLE, check_target
from spreadsheets.styles import CURVES, RULES, STYLES

_ARIAL = {"font_name": "Arial", "font_size": 10}


def cell_values(
    plan: WorkbookPlan, values: Mapping[str, ShownValue]
) -> dict[str, dict[str, ShownValue]]:
    """Return what every cell of the workbook shows, texts included, by sheet and address.

    Raises ValueError unless `values` has exactly the keys of the plan and every number is finite.
    """
    for problem, keys in (
        ("missing", plan.where.keys() - values.keys()),
        ("surplus", values.keys() - plan.where.keys()),
    ):
        if keys:
            raise ValueError(f"{len(keys)} {problem} value(s), the first is {min(keys)!r}")
    shown: dict[str, dict[str, ShownValue]] = {sheet.name: {} for sheet in plan.sheets}
    for (sheet, address), cell in plan.cells.items():
        constant = cell.text if cell.number is None else cell.number
        value = values[cell.key] if cell.key else constant
        if isinstance(value, float) and not math.isfinite(value):
            where = f"{cell.key} ({sheet}!{address})"
            raise ValueError(f"{where} is {value}: not a number a cell can hold")
        if cell.key or value != "":
            shown[sheet][address] = value
    return shown


def check_writable(path: Path, *, force: bool = False) -> None:
    """Raise OSError unless a workbook can be written to `path`.

    An existing file may be replaced only if it `is_own`, or with `force`.
    """
    target = check_target(path)
    if target.exists() and not force and not is_own(target):
        problem = "this file is not as coldspray wrote it; rename it, or give --force"
        raise FileExistsError(EEXIST, problem, str(path))


_SEAL, _SEALED, _UNSEALED = "coldspray-sha256", "docProps/custom.xml", "0" * 64

_CORRECTIONS = (
    # XlsxWriter names Excel as the program, and gives dates, which would differ in every run.
    ("docProps/app.xml", rb">Microsoft Excel<", rb">coldspray<"),
    ("docProps/app.xml", rb"<AppVersion>.*?</AppVersion>", rb""),
    ("docProps/core.xml", rb"<dcterms:(created|modified).*?</dcterms:\1>", rb""),
    # Unless told otherwise, LibreOffice draws a smooth curve through the points.
    ("xl/charts/", rb"</c:yVal>", rb'</c:yVal><c:smooth val="0"/>'),
    # XlsxWriter stores the value "" of a formula without the type that marks a text.
    ("xl/worksheets/", rb'(<c r="\w+" s="\d+")(><f>[^<]*</f><v></v>)', rb'\1 t="str"\2'),
    # All columns after Z are unlocked as Z is; XlsxWriter would look at each of them in each row.
    (
        "xl/worksheets/",
        rb'(max="26" width="[\d.]+" style="(\d+)"[^>]*/>)</cols>',
        rb'\1<col min="27" max="16384" width="9.140625" style="\2"/></cols>',
    ),
)
"""Changes to what XlsxWriter writes: start of a part's name, pattern and replacement."""


def is_own(path: Path) -> bool:
    """Whether a file is a workbook that `to_bytes` made: its parts have the digest that it stores.

    How the parts are compressed does not matter, as it depends on the version of zlib.
    """
    try:
        parts = _archive_parts(path.read_bytes())
    except UNREADABLE:
        return False
    return _SEALED in parts and _sealed(parts) == parts


def _archive_parts(content: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(BytesIO(content)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def _sealed(parts: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the parts with their digest as the seal, which takes the place of an older one."""
    seal = re.sub(rb">[0-9a-f]{64}<", f">{_UNSEALED}<".encode(), parts[_SEALED], count=1)
    unsealed = {**parts, _SEALED: seal}
    digest = sha256(b"".join((*map(str.encode, unsealed), *unsealed.values()))).hexdigest()
    return {**unsealed, _SEALED: seal.replace(_UNSEALED.encode(), digest.encode())}


def _zipped(parts: Mapping[str, bytes]) -> bytes:
    """Zip the parts, without time stamps."""
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, part in parts.items():
            info = zipfile.ZipInfo(name)
            info.create_system = 3  # Unix, whatever the system is
            archive.writestr(info, part, zipfile.ZIP_DEFLATED)
    return buffer.getvalue()


def to_bytes(plan: WorkbookPlan, values: Mapping[str, ShownValue]) -> bytes:
    """Return the bytes of the .xlsx file. Raises ValueError as `cell_values` does."""
    import xlsxwriter

    shown = cell_values(plan, values)
    # Arial must be the default font, too, since column widths are counted in its digits. It is
    # copied because XlsxWriter changes the dict.
    options = {"in_memory": True, "default_format_properties": {**_ARIAL, "locked": False}}
    file = BytesIO()
    book = xlsxwriter.Workbook(file, options)

    @cache
    def style(name: str, number_format: str, wrap: bool, locked: bool) -> Any:
        name, sample, _ = name.partition(" sample")
        look = {**_ARIAL, "font_color": "#000000", **STYLES[name], "text_wrap": wrap}
        look |= {"align": "center"} if sample else {}
        return book.add_format(
            {**look, "num_format": number_format, "valign": "vcenter", "locked": locked}
        )

    unlocked = book.add_format({**_ARIAL, "locked": False})
    book.set_properties(dict(plan.properties))
    book.set_custom_property(_SEAL, _UNSEALED)
    for sheet in plan.sheets:
        worksheet = book.add_worksheet(sheet.name)
        _set_up(worksheet, sheet, unlocked)
        for address, cell in sheet.cells.items():
            look = style(cell.style, cell.shown, cell.wrap, bool(cell.formula))
            _write_cell(worksheet, address, cell, shown[sheet.name].get(address, ""), look)
            if cell.style == "title":
                worksheet.set_row(int(address[1:]) - 1, TITLE_HEIGHT)
            if takes_two_lines(sheet, address, cell):
                worksheet.set_row(int(address[1:]) - 1, 2 * sheet.row_height)
            if cell.named:
                named = f"={_absolute(sheet.name, address)}"
                if book.define_name(cell.key, named) == -1:
                    raise ValueError(f"{cell.key!r} cannot name a cell in a workbook")
        for rule in sheet.rules:
            # The format of a rule names only what it changes, so neither font nor number format.
            options = {
                "type": "formula",
                "criteria": rule.formula,
                "format": book.add_format(RULES[rule.style]),
            }
            worksheet.conditional_format(rule.cells, options)
        for chart in sheet.charts:
            drawn = chart.sheet or sheet.name
            _draw(book, worksheet, drawn, chart, shown[drawn], values)
    book.close()
    parts = _archive_parts(file.getvalue())
    corrected = {name: _corrected(name, part) for name, part in parts.items()}
    return _zipped(_sealed(corrected))


def takes_two_lines(sheet: SheetPlan, address: str, cell: Cell) -> bool:
    """Whether the text of a cell is wrapped, so that its row is twice as high.

    A width is counted in digits, and most letters are narrower than a digit.
    """
    return cell.wrap and len(cell.text) > 1.2 * sheet.widths[address[0]]


def _corrected(name: str, part: bytes) -> bytes:
    for start, pattern, replacement in _CORRECTIONS:
        if name.startswith(start):
            part = re.sub(pattern, replacement, part)
    return part


MARGINS = {"left": 0.25, "right": 0.25, "top": 0.42, "bottom": 0.32}
"""Of a printed page, in inches."""

TITLE_HEIGHT = 18
"""Height of the row of a sheet's title in points."""

_FREE = (
    "objects", "scenarios", "format_cells", "format_columns", "format_rows", "insert_columns",
    "insert_rows", "insert_hyperlinks", "delete_columns", "delete_rows", "select_locked_cells",
    "sort", "autofilter", "pivot_tables", "select_unlocked_cells",
)  # fmt: skip
"""What protection leaves free: everything but typing into locked cells."""


def _set_up(worksheet: Any, sheet: SheetPlan, unlocked: Any) -> None:
    """Set how a sheet scrolls and prints, its protection, and its column widths."""
    worksheet.protect(options=dict.fromkeys(_FREE, True))
    worksheet.hide_gridlines(2)
    if sheet.headed:
        scrolling, first, last = sheet.headed
        worksheet.freeze_panes(f"{scrolling}{last + 1}")
        worksheet.repeat_rows(first - 1, last - 1)
    # Blank cells take the format of their column; the other columns follow in `_CORRECTIONS`.
    worksheet.set_column("A:Z", None, unlocked)
    for column, width in sheet.widths.items():
        worksheet.set_column(f"{column}:{column}", width, unlocked)
    worksheet.set_default_row(sheet.row_height)
    worksheet.set_portrait() if sheet.portrait else worksheet.set_landscape()
    worksheet.set_paper(1)  # US Letter
    worksheet.set_margins(**MARGINS)
    worksheet.fit_to_pages(1, sheet.most_pages)
    worksheet.set_header('&L&"Arial"&8&F&R&"Arial"&8&A', {"margin": 0.22})
    worksheet.set_footer('&R&"Arial"&8Page &P of &N', {"margin": 0.2})
    if sheet.print_area:
        worksheet.print_area(sheet.print_area)
    if sheet.filtered:
        worksheet.autofilter(sheet.filtered)
    # Excel would mark printed numbers, which are texts, and formulas that differ by design from
    # their neighbors, and cells that are not computed.
    kinds = ("number_stored_as_text", "formula_differs", "formula_range", "eval_error")
    worksheet.ignore_errors(dict.fromkeys(kinds, "A1:XFD1048576"))


def _write_cell(worksheet: Any, address: str, cell: Cell, value: ShownValue, style: Any) -> None:
    """Write one cell; for an input, also what may be typed into it."""
    if cell.formula:
        worksheet.write_formula(address, _Expanded(cell.formula.removeprefix("=")), style, value)
    elif cell.link:
        sheet, target = cell.link
        worksheet.write_url(address, f"internal:'{sheet}'!{target}", style, cell.text)
    elif isinstance(value, str):
        write = worksheet.write_string if value else worksheet.write_blank
        write(address, value, style)
    else:
        worksheet.write_number(address, _Exact(value), style)
    # A spreadsheet program shows these words before an input is typed, and if it is refused.
    if cell.choices:
        worksheet.data_validation(address, {"validate": "list", "source": list(cell.choices)})
    elif cell.limits:
        least, most = cell.limits
        words = f"A number from {least:,.10g} to {most:,.10g} {written(cell.unit)}".rstrip() + "."
        limits = {"validate": "decimal", "criteria": "between", "minimum": least, "maximum": most}
        messages = {"input_message": words, "error_title": "Out of range", "error_message": words}
        worksheet.data_validation(address, limits | messages)


def _absolute(sheet: str, cells: str) -> str:
    """Return the absolute reference that a name or chart needs: 'Figure 5'!$B$5:$B$25."""
    return f"'{sheet}'!" + re.sub(r"([A-Z]+)(\d+)", r"$\1$\2", cells)


class _Exact(float):
    """A number that XlsxWriter writes with all its digits; of a plain float it writes only 16."""

    def __format__(self, _: str) -> str:
        return float.__repr__(self)


class _Expanded(str):
    """A formula that is to be written as it is.

    Functions newer than the file format need the prefix _xlfn. there; no formula of ours has any.
    XlsxWriter leaves a formula alone that contains this prefix, and else looks for each of some
    thirty names in it, which takes more than half of the time of writing the workbook.
    """

    __slots__ = ()

    def __contains__(self, text: str) -> bool:  # type: ignore[override]
        return text == "_xlfn." or super().__contains__(text)


# Charts; XlsxWriter stores the charted values with them.

_FONT = {"name": "Arial", "size": 10, "bold": False}
_GRID = {"visible": True, "line": {"color": "#D0D7DE", "width": 0.75}}


def _draw(
    book: Any, worksheet: Any, name: str, chart: Chart, shown: Mapping[str, ShownValue],
    values: Mapping[str, ShownValue],
) -> None:  # fmt: skip
    """Draw a chart of the cells of the sheet `name` on a worksheet; `shown` is what they show."""
    drawn = book.add_chart({"type": "scatter", "subtype": "straight"})
    for curve in chart.curves:
        look = CURVES[curve.beta]
        settings = {
            "name": f"={_absolute(*curve.name)}",
            "categories": f"={_absolute(name, curve.x)}",
            "categories_data": _charted(curve.x, shown),
            "values": f"={_absolute(name, curve.y)}",
            "values_data": _charted(curve.y, shown),
            "line": {"color": look.color, "width": 2, "dash_type": look.dash},
        }
        if chart.logarithmic or len(_charted(curve.x, shown)) <= 50:
            # There are few points: mark each of them.
            fill = {"color": look.color}
            settings["marker"] = {"type": look.marker, "size": 6, "fill": fill, "border": fill}
        drawn.add_series(settings)
    drawn.set_title({"name": chart.title, "name_font": {"name": "Arial", "size": 13}})
    axis: dict[str, Any] = {"name_font": _FONT, "num_font": _FONT, "major_gridlines": _GRID}
    axis |= {"label_position": "low"} | ({"log_base": 10} if chart.logarithmic else {})
    drawn.set_x_axis({"name": chart.x_title, **axis})
    drawn.set_y_axis({"name": chart.y_title, **axis})
    drawn.set_legend({"position": "bottom", "font": _FONT})
    drawn.set_size(dict(zip(("width", "height"), chart.size, strict=True)))
    worksheet.insert_chart(chart.at, drawn, {"description": chart.describe(values)})


def _charted(cells: str, shown: Mapping[str, ShownValue]) -> list[float | None]:
    """Return the numbers of a range in one column; None stands for a cell without a number."""
    (column, first), (_, last) = (re.findall(r"[A-Z]+|\d+", end) for end in cells.split(":"))
    in_cells = (shown.get(f"{column}{row}") for row in range(int(first), int(last) + 1))
    return [value if isinstance(value, float) else None for value in in_cells]
