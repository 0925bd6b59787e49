"""Write foreign workbooks to files, as different programs do."""

import shutil
import subprocess
import tempfile
import zipfile
from collections.abc import Sequence
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

from foreign.layouts import Foreign, Place, letters

Values = dict[Place, float | str | bool]


def with_openpyxl(f: Foreign, path: Path) -> Path:
    """Write formulas without stored values, as scripts do."""
    from openpyxl import Workbook
    from openpyxl.workbook.defined_name import DefinedName

    book = Workbook()
    book.remove(book.active)
    for (sheet, row, column), content in f.cells.items():
        if sheet not in book.sheetnames:
            book.create_sheet(sheet)
        book[sheet].cell(row, column, content)
    for name, meaning in f.names.items():
        book.defined_names[name] = DefinedName(name, attr_text=meaning)
    book.save(path)
    return path


def barely(f: Foreign, path: Path) -> Path:
    """Write only the parts that a file must have, without stored values: ten times as fast."""
    sheets = list(dict.fromkeys(sheet for sheet, _, _ in f.cells)) or ["Sheet1"]
    names = "".join(f"<definedName name={quoteattr(name)}>{escape(meaning)}</definedName>"
                    for name, meaning in f.names.items())  # fmt: skip
    listed = "".join(f'<sheet name={quoteattr(sheet)} sheetId="{i}" r:id="rId{i}"/>'
                     for i, sheet in enumerate(sheets, 1))  # fmt: skip
    related = "".join(f'<Relationship Id="rId{i}" Type="{RELATED}/worksheet" '
                      f'Target="worksheets/sheet{i}.xml"/>'
                      for i, _ in enumerate(sheets, 1))  # fmt: skip
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("[Content_Types].xml", CONTENT_TYPES)
        archive.writestr("_rels/.rels", _relationships(
            f'<Relationship Id="rId1" Type="{RELATED}/officeDocument" Target="xl/workbook.xml"/>'
        ))  # fmt: skip
        archive.writestr("xl/_rels/workbook.xml.rels", _relationships(related))
        inner = f"<sheets>{listed}</sheets><definedNames>{names}</definedNames>"
        head = f'<workbook xmlns="{MAIN}" xmlns:r="{RELATED}">'
        archive.writestr("xl/workbook.xml", f"{head}{inner}</workbook>")
        for i, sheet in enumerate(sheets, 1):
            archive.writestr(f"xl/worksheets/sheet{i}.xml", _worksheet(f, sheet))
    return path


MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
RELATED = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"
SHEET_TYPE = "application/vnd.openxmlformats-officedocument.spreadsheetml"
CONTENT_TYPES = (
    f'<Types xmlns="{PACKAGE}/content-types">'
    '<Default Extension="rels" '
    'ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    f'<Default Extension="xml" ContentType="{SHEET_TYPE}.worksheet+xml"/>'
    f'<Override PartName="/xl/workbook.xml" ContentType="{SHEET_TYPE}.sheet.main+xml"/></Types>'
)


def _relationships(text: str) -> str:
    return f'<Relationships xmlns="{PACKAGE}/relationships">{text}</Relationships>'


def _worksheet(f: Foreign, sheet: str) -> str:
    """The part of a sheet: its cells, row by row."""
    rows: dict[int, list[tuple[int, str | float]]] = {}
    for (own, row, column), content in f.cells.items():
        if own == sheet:
            rows.setdefault(row, []).append((column, content))
    text = ""
    for row, cells in sorted(rows.items()):
        inner = "".join(_cell(row, *cell) for cell in sorted(cells, key=lambda cell: cell[0]))
        text += f'<row r="{row}">{inner}</row>'
    return f'<worksheet xmlns="{MAIN}"><sheetData>{text}</sheetData></worksheet>'


def _cell(row: int, column: int, content: str | float) -> str:
    at = f'<c r="{letters(column)}{row}"'
    if isinstance(content, bool):
        return f'{at} t="b"><v>{content:d}</v></c>'
    if isinstance(content, str) and content.startswith("="):
        return f"{at}><f>{escape(content[1:])}</f></c>"
    if isinstance(content, str):
        return f'{at} t="inlineStr"><is><t xml:space="preserve">{escape(content)}</t></is></c>'
    return f"{at}><v>{content!r}</v></c>"


def calculated(f: Foreign) -> Values:
    """The value of each formula, by an engine that the program under test does not use."""
    from spreadsheets.engines import Formualizer, address

    with tempfile.TemporaryDirectory() as folder:
        result = Formualizer().recalculate(with_openpyxl(f, Path(folder, "plain.xlsx")))
    cells = ((place, result[place[0]], address(*place[1:])) for place in f.cells)
    return {place: values[cell] for place, values, cell in cells if cell in values}


def with_xlsxwriter(f: Foreign, path: Path, values: Values) -> Path:
    """Write formulas with their values, all 17 digits of them, as Excel does."""
    import xlsxwriter

    with xlsxwriter.Workbook(path) as book:
        sheets = {}
        for (sheet, row, column), content in f.cells.items():
            if sheet not in sheets:
                sheets[sheet] = book.add_worksheet(sheet)
            at = row - 1, column - 1
            if isinstance(content, str) and content.startswith("="):
                value = values.get((sheet, row, column), "")
                exact = Exact(value) if isinstance(value, float) else value
                sheets[sheet].write_formula(*at, content, value=exact)
            elif isinstance(content, str):
                sheets[sheet].write_string(*at, content)
            else:
                sheets[sheet].write_number(*at, Exact(content))
        for name, meaning in f.names.items():
            book.define_name(name, f"={meaning}")
    return path


class Exact(float):
    """A float that is written with all its digits, not with the 16 of XlsxWriter."""

    def __format__(self, _: str) -> str:
        return repr(float(self))

    __str__ = float.__repr__


def with_libreoffice(paths: Sequence[Path], folder: Path, kind: str = "xlsx") -> list[Path]:
    """The same workbooks, calculated and saved by LibreOffice in a single run."""
    soffice = shutil.which("soffice")
    assert soffice is not None
    profile = f"-env:UserInstallation={(folder / 'profile').as_uri()}"
    command = [soffice, "--headless", "--norestore", profile, "--convert-to", kind, "--outdir",
               str(folder / "out"), *map(str, paths)]  # fmt: skip
    for _ in range(2):
        subprocess.run(command, check=False, capture_output=True, timeout=300)
        if all((folder / "out" / f"{path.stem}.{kind}").is_file() for path in paths):
            break
    return [folder / "out" / f"{path.stem}.{kind}" for path in paths]
