"""A plan and its values -> one .xlsx file: live formulas, each stored with its computed value.

The same plan and values give the same bytes wherever and whenever they are written. The file
carries the SHA-256 of its parts, so that one that somebody changed is never taken for our own.
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
from spreadsheets.plan import Cell, SheetPlan, Value, WorkbookPlan, tables
from spreadsheets.safely import UNREADABLE, check_target

_ARIAL = {"font_name": "Arial", "font_size": 10}


def cell_values(plan: WorkbookPlan, values: Mapping[str, Value]) -> dict[str, dict[str, Value]]:
    """What every cell of the workbook shows, by sheet and address, texts included.

    Raises ValueError unless `values` has exactly the keys of the plan and every number is finite.
    """
    for problem, keys in (
        ("missing", plan.where.keys() - values.keys()),
        ("surplus", values.keys() - plan.where.keys()),
    ):
        if keys:
            raise ValueError(f"{len(keys)} {problem} value(s), the first is {min(keys)!r}")
    shown: dict[str, dict[str, Value]] = {}
    for sheet in plan.sheets:
        of_sheet = shown[sheet.name] = {}
        for address, cell in sheet.cells.items():
            number = cell.text if cell.number is None else cell.number
            value = values[cell.key] if cell.key else number
            if isinstance(value, float) and not math.isfinite(value):
                where = f"{cell.key} ({sheet.name}!{address})"
                raise ValueError(f"{where} is {value}: not a number a cell can hold")
            if cell.key or value != "":
                of_sheet[address] = value
    return shown


def check(path: Path, *, force: bool = False) -> None:
    """Raise OSError where nothing can be written, or a file stands that is not `is_own`.

    `force` admits any file.
    """
    target = check_target(path)
    if target.exists() and not force and not is_own(target):
        problem = "this file is not as coldspray wrote it; rename it, or give --force"
        raise FileExistsError(EEXIST, problem, str(path))


_SEAL, _SEALED, _UNSEALED = "coldspray-sha256", "docProps/custom.xml", "0" * 64

_CORRECTIONS = (
    # XlsxWriter claims to be Excel, and gives dates, of which none is true.
    ("docProps/app.xml", rb">Microsoft Excel<", rb">coldspray<"),
    ("docProps/app.xml", rb"<AppVersion>.*?</AppVersion>", rb""),
    ("docProps/core.xml", rb"<dcterms:(created|modified).*?</dcterms:\1>", rb""),
    # Where nothing is said, LibreOffice draws a smooth curve through the points.
    ("xl/charts/", rb"</c:yVal>", rb'</c:yVal><c:smooth val="0"/>'),
    # XlsxWriter stores the value "" of a formula without the type of a text.
    ("xl/worksheets/", rb'(<c r="\w+" s="\d+")(><f>[^<]*</f><v></v>)', rb'\1 t="str"\2'),
)
"""What is changed in the parts of the file: the start of a part's name, a pattern, and a text."""


def is_own(path: Path) -> bool:
    """Whether a file is, byte for byte, a workbook that `to_bytes` made here.

    Its parts, packed again, must give it; what another version of zlib packed counts as changed.
    """
    content = path.read_bytes()
    try:
        parts = _parts(content)
    except UNREADABLE:
        return False
    return _SEALED in parts and _sealed(parts) == content


def _parts(content: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(BytesIO(content)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def _sealed(parts: dict[str, bytes]) -> bytes:
    """Zip these parts without time stamps, with their digest as the seal."""
    parts[_SEALED] = re.sub(rb">[0-9a-f]{64}<", f">{_UNSEALED}<".encode(), parts[_SEALED], count=1)
    digest = sha256(b"".join((*map(str.encode, parts), *parts.values()))).hexdigest()
    parts[_SEALED] = parts[_SEALED].replace(_UNSEALED.encode(), digest.encode())
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, part in parts.items():
            info = zipfile.ZipInfo(name)
            info.create_system = 3  # the same on every system
            archive.writestr(info, part, zipfile.ZIP_DEFLATED)
    return buffer.getvalue()


def to_bytes(plan: WorkbookPlan, values: Mapping[str, Value]) -> bytes:
    """The bytes of the .xlsx file. Raises as `cell_values` does."""
    import xlsxwriter

    shown = cell_values(plan, values)
    # The font of all cells, since column widths are counted in digits of the default one; a copy,
    # since XlsxWriter writes into it.
    options = {"in_memory": True, "default_format_properties": dict(_ARIAL)}
    file = BytesIO()
    book = xlsxwriter.Workbook(file, options)

    @cache
    def style(name: str, number_format: str, wrap: bool) -> Any:
        name, sample, _ = name.partition(" sample")
        look = {**_ARIAL, "font_color": "#000000", **tables()["styles"][name], "text_wrap": wrap}
        look |= {"align": "center"} if sample else {}
        return book.add_format({**look, "num_format": number_format, "valign": "vcenter"})

    book.set_properties(dict(plan.properties))
    book.set_custom_property(_SEAL, _UNSEALED)
    for sheet in plan.sheets:
        page = book.add_worksheet(sheet.name)
        # By itself, it searches each formula for functions newer than Excel 2010: half of the time.
        page._prepare_formula = lambda formula: formula[1:]
        _set_up(page, sheet)
        for address, cell in sheet.cells.items():
            look = style(cell.style, cell.shown, cell.wrap)
            _write_cell(page, address, cell, shown[sheet.name].get(address, ""), look)
            # Widths are counted in digits; most letters are narrower.
            if cell.wrap and len(cell.text) > 1.2 * sheet.widths[address[0]]:
                page.set_row(int(address[1:]) - 1, 30)
            if cell.name:
                named = f"={_absolute(sheet.name, address)}"
                if book.define_name(cell.name, named) == -1:
                    raise ValueError(f"{cell.name!r} cannot name a cell in a workbook")
        for rule in sheet.rules:
            # A format for a rule has the properties that it changes, and no font or number format.
            look = book.add_format(tables()["rules"][rule.style])
            options = {"type": "formula", "criteria": rule.formula, "format": look}
            page.conditional_format(rule.cells, options)
        if sheet.curves:
            _draw(book, page, sheet, sheet.description(values))
    book.close()
    parts = _parts(file.getvalue())
    for start, pattern, words in _CORRECTIONS:
        parts |= {
            name: re.sub(pattern, words, parts[name]) for name in parts if name.startswith(start)
        }
    return _sealed(parts)


def _set_up(page: Any, sheet: SheetPlan) -> None:
    """Scrolling, column widths and print set-up."""
    page.hide_gridlines(2)
    if sheet.headed:
        scrolling, first, last = sheet.headed
        page.freeze_panes(f"{scrolling}{last + 1}")
        page.repeat_rows(first - 1, last - 1)
    for column, width in sheet.widths.items():
        page.set_column(f"{column}:{column}", width)
    page.set_landscape()
    page.set_paper(1)  # US Letter
    page.set_margins(left=0.3, right=0.3, top=0.7, bottom=0.6)
    page.fit_to_pages(1, 0)
    page.set_header('&L&"Arial"&10&F&R&"Arial"&10&A')
    page.set_footer('&R&"Arial"&10Page &P of &N')
    if sheet.print_area:
        page.print_area(sheet.print_area)
    if sheet.page_break:
        page.set_h_pagebreaks([sheet.page_break])
    if sheet.filtered:
        page.autofilter(sheet.filtered)
    # Texts that the report prints are texts, and formulas differ from their neighbors by design.
    everywhere = "A1:XFD1048576"
    kinds = ("number_stored_as_text", "formula_differs", "formula_range")
    page.ignore_errors(dict.fromkeys(kinds, everywhere))


def _write_cell(page: Any, address: str, cell: Cell, value: Value, style: Any) -> None:
    """A formula, a text, a number, or an input, with what may be typed into it."""
    if cell.formula:
        page.write_formula(address, cell.formula, style, value)
    elif cell.link:
        sheet, target = cell.link
        page.write_url(address, f"internal:'{sheet}'!{target}", style, cell.text)
    elif isinstance(value, str):
        write = page.write_string if value else page.write_blank
        write(address, value, style)
    else:
        page.write_number(address, _Exact(value), style)
    # What a spreadsheet program asks of a typed input, and says before and after.
    if cell.choices:
        page.data_validation(address, {"validate": "list", "source": list(cell.choices)})
    elif cell.limits:
        least, most = cell.limits
        words = f"A number from {least:,.10g} to {most:,.10g} {written(cell.unit)}".rstrip() + "."
        limits = {"validate": "decimal", "criteria": "between", "minimum": least, "maximum": most}
        messages = {"input_message": words, "error_title": "Out of range", "error_message": words}
        page.data_validation(address, limits | messages)


def _absolute(sheet: str, cells: str) -> str:
    """Cells as a name or a chart refers to them: 'Figure 5'!$B$5:$B$25."""
    return f"'{sheet}'!" + re.sub(r"([A-Z]+)(\d+)", r"$\1$\2", cells)


class _Exact(float):
    """A number that XlsxWriter stores with all its digits; by itself, it writes 16 of them."""

    def __format__(self, _: str) -> str:
        return float.__repr__(self)


# Charts; XlsxWriter stores the charted values with them.

_FONT = {"name": "Arial", "size": 10, "bold": False}
_GRID = {"visible": True, "line": {"color": "#D0D7DE", "width": 0.75}}


def _draw(book: Any, page: Any, sheet: SheetPlan, description: str) -> None:
    """Draw the chart of a sheet on its page."""
    chart = sheet.entry["chart"]
    logarithmic = chart.get("logarithmic", False)
    drawn = book.add_chart({"type": "scatter", "subtype": "straight"})
    for curve, look in zip(sheet.curves, tables()["curves"], strict=False):
        settings = {
            "name": f"={_absolute(*curve.name)}",
            "categories": f"={_absolute(sheet.name, curve.x)}",
            "values": f"={_absolute(sheet.name, curve.y)}",
            "line": {"color": look["color"], "width": 2, "dash_type": look["dash"]},
        }
        first, last = map(int, re.findall(r"\d+", curve.x))
        if logarithmic or last - first < 50:
            # Few points: show where they are.
            fill = {"color": look["color"]}
            settings["marker"] = {"type": look["marker"], "size": 6, "fill": fill, "border": fill}
        drawn.add_series(settings)
    drawn.set_title({"name": chart["title"], "name_font": {"name": "Arial", "size": 13}})
    axis: dict[str, Any] = {"name_font": _FONT, "num_font": _FONT, "major_gridlines": _GRID}
    axis |= {"label_position": "low"} | ({"log_base": 10} if logarithmic else {})
    drawn.set_x_axis({"name": chart["x_title"], **axis})
    drawn.set_y_axis({"name": chart["y_title"], **axis})
    drawn.set_legend({"position": "bottom", "font": _FONT})
    drawn.set_size(dict(zip(("width", "height"), chart["size"], strict=True)))
    page.insert_chart(chart["at"], drawn, {"description": description})
