"""Fixtures: the engines, workbooks, their files, and files into which somebody typed."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import pytest
from workbooks import rewritten, usable

from replication import workbook
from replication.audit.record import Record
from replication.workbook import Workbook
from spreadsheets import engines
from spreadsheets.engines import Engine


@pytest.fixture(scope="session", params=[engine.name for engine in engines.ENGINES])
def engine(request: pytest.FixtureRequest) -> Engine:
    """Each engine in turn."""
    return usable(request.param)


@pytest.fixture(scope="session")
def build(record: Record) -> Callable[..., Workbook]:
    """`workbook.build` with a finished audit, which all workbooks share."""
    return partial(workbook.build, record=record)


@dataclass(frozen=True)
class Emitted:
    """A workbook and its file."""

    book: Workbook
    path: Path

    def typed(self, numbers: Mapping[str, float | str | None], path: Path) -> Path:
        """Copy the file with numbers, texts or nothing (None) typed into cells, given by key.

        All other stored values remain, so that they are out of date until an engine recalculates.
        """
        places = {self.book.plan.where[key]: number for key, number in numbers.items()}
        sheets = [sheet.name for sheet in self.book.plan.sheets]

        def type_into(part: str, content: bytes) -> bytes:
            for (sheet, address), number in places.items():
                if part == f"xl/worksheets/sheet{sheets.index(sheet) + 1}.xml":
                    content = _type(content.decode(), address, number).encode()
            return content

        path.write_bytes(rewritten(self.path.read_bytes(), type_into))
        return path


def _type(content: str, address: str, number: float | str | None) -> str:
    result = re.search(rf'<c r="{address}"( s="\d+")?[^>]*>.*?</c>', content)
    assert result is not None
    start = f'<c r="{address}"{result[1]}'
    if number is None:
        cell = f"{start}/>"
    elif isinstance(number, str):
        cell = f'{start} t="inlineStr"><is><t>{number}</t></is></c>'
    else:
        cell = f"{start}><v>{number!r}</v></c>"
    return content.replace(result[0], cell)


@pytest.fixture(scope="session")
def emit_to(tmp_path_factory: pytest.TempPathFactory) -> Callable[[Workbook], Emitted]:
    """Return a function that writes a workbook to a file."""

    def written(book: Workbook) -> Emitted:
        path = tmp_path_factory.mktemp("emitted") / "workbook.xlsx"
        path.write_bytes(book.to_bytes())
        return Emitted(book, path)

    return written


@pytest.fixture(scope="session")
def emitted(build: Callable[..., Workbook], emit_to: Callable[[Workbook], Emitted]) -> Emitted:
    """The report's workbook as a file."""
    return emit_to(build())
