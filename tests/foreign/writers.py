"""Write foreign workbooks to files, as different programs do."""

import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path

from foreign.layouts import Foreign, Place

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


def written(f: Foreign, path: Path, values: Values | None, wrong: Values | None) -> Path:
    """Write a file with the stored values, some of them `wrong`; if none are wrong, without any."""
    return with_xlsxwriter(f, path, (values or {}) | wrong) if wrong else with_openpyxl(f, path)


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
