"""Fixtures: the engines, workbooks, their files, and files into which somebody typed."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from zipfile import ZIP_STORED

import pytest
from workbooks import rewritten, usable

from replication import workbook
from replication.audit.record import Record
from replication.cases import BETA_5
from replication.workbook import Workbook
from spreadsheets import engines
from spreadsheets.engines import Engine, SheetValues
from spreadsheets.plan import ShownValue

Typed = float | str | None
"""What is typed into a cell: a number, a text, an error such as "#DIV/0!", or nothing (None)."""


@pytest.fixture(scope="session", params=[engine.name for engine in engines.ENGINES])
def engine(request: pytest.FixtureRequest) -> Engine:
    """Each engine in turn."""
    return usable(request.param)


@pytest.fixture(scope="session")
def build(record: Record) -> Callable[..., Workbook]:
    """`workbook.build_workbook` with a finished audit, which all workbooks share."""
    return partial(workbook.build_workbook, record=record)


@pytest.fixture(scope="session")
def published(build: Callable[..., Workbook]) -> Workbook:
    """The report's workbook."""
    return build()


@pytest.fixture(scope="session")
def centered(build: Callable[..., Workbook]) -> Workbook:
    """The report's workbook with the centered scheme."""
    return build(scheme="centered")


@pytest.fixture(scope="session")
def own(build: Callable[..., Workbook]) -> Workbook:
    """The workbook of a case that is not the report's."""
    return build(replace(BETA_5, velocity=600.0))


@pytest.fixture(params=["published", "centered", "own"])
def book(request: pytest.FixtureRequest) -> Workbook:
    """Each of these three workbooks in turn."""
    chosen: Workbook = request.getfixturevalue(request.param)
    return chosen


@dataclass(frozen=True)
class Page:
    """A recalculated workbook, read by key."""

    book: Workbook
    result: SheetValues

    def __getitem__(self, key: str) -> ShownValue:
        sheet, address = self.book.plan.where[key]
        return self.result[sheet].get(address, "")

    @property
    def errors(self) -> dict[tuple[str, str], ShownValue]:
        """The errors that are not #N/A, by place."""
        return {
            (sheet, address): value
            for sheet, cells in self.result.items()
            for address, value in cells.items()
            if isinstance(value, str) and re.match(r"#(?!N/A)|Err:", value)
        }


@dataclass(frozen=True)
class Emitted:
    """A workbook and its file."""

    book: Workbook
    path: Path
    unchanged: dict[str, SheetValues] = field(default_factory=dict)
    """What each engine gave for the file as it was written, by the engine's name."""

    def typed(self, contents: Mapping[str, Typed], path: Path) -> Path:
        """Copy the file with contents typed into cells, given by key.

        All other stored values remain, so that they are out of date until an engine recalculates.
        """
        places = {self.book.plan.where[key]: content for key, content in contents.items()}
        sheets = [sheet.name for sheet in self.book.plan.sheets]

        def type_into(part: str, content: bytes) -> bytes:
            for (sheet, address), typed in places.items():
                if part == f"xl/worksheets/sheet{sheets.index(sheet) + 1}.xml":
                    content = _type(content.decode(), address, typed).encode()
            return content

        path.write_bytes(rewritten(self.path.read_bytes(), type_into, ZIP_STORED))
        return path

    def recalculated(
        self, engine: Engine, contents: Sequence[Mapping[str, Typed]], folder: Path
    ) -> list[Page]:
        """Return the workbook as an engine recalculates it after each of these is typed.

        The workbook as it was written is recalculated once by each engine.
        """
        first = [{}] if {} in contents and engine.name not in self.unchanged else []
        paths = [
            self.typed(typed, folder / f"{engine.name}-{number}.xlsx")
            for number, typed in enumerate([*first, *filter(None, contents)])
        ]
        values = iter(engine.recalculate_many(paths) if paths else [])
        if first:
            self.unchanged[engine.name] = next(values)
        return [
            Page(self.book, next(values) if typed else self.unchanged[engine.name])
            for typed in contents
        ]


def _type(content: str, address: str, typed: Typed) -> str:
    result = re.search(rf'<c r="{address}"( s="\d+")?[^>]*>.*?</c>', content)
    assert result is not None
    start = f'<c r="{address}"{result[1]}'
    if typed is None:
        cell = f"{start}/>"
    elif isinstance(typed, float):
        cell = f"{start}><v>{typed!r}</v></c>"
    elif typed.startswith("#"):
        cell = f'{start} t="e"><v>{typed}</v></c>'
    else:
        cell = f'{start} t="inlineStr"><is><t>{typed}</t></is></c>'
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
def emitted(published: Workbook, emit_to: Callable[[Workbook], Emitted]) -> Emitted:
    """The report's workbook as a file."""
    return emit_to(published)
