"""Unpack the parts of a workbook's file and parse their XML, within bounds.

Workbooks (.xlsx, .ods) are zip archives of XML files, their parts. Every file is treated as
hostile: the bytes that come out of the archive are counted, not those that it declares; document
types are refused, hence all entities; and no piece of XML is kept that nobody asked for.
"""

import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path, PurePosixPath
from posixpath import join, normpath
from typing import Any
from xml.etree import ElementTree as ET

from spreadsheets.safely import UNREADABLE

MAX_UNPACKED = 192 * 2**20
"""Bytes that all parts unpack to; the largest sheet within the limits has some 40 MB."""
MAX_PARTS = 10_000
_MAX_LISTING = 2 * 2**20
"""Bytes of the list of parts at the end of an archive; 10,000 parts need half of it."""
MAX_EVENTS = 3_000_000
"""Pieces of XML (elements, texts, comments) in all parts: a cell has at most eight."""
MAX_TREE = 200_000
"""Elements that are kept at the same time: those of one row, or of a part that is read whole."""
MAX_DEPTH = 100
"""Levels of XML elements within each other: a sheet has six."""
_MAX_PIECE = 2**20
"""Bytes of one tag or comment. The parser reads what is unfinished again with every chunk."""
_CHUNK = 2**16


class WorkbookError(ValueError):
    """A file is refused or cannot be read as a workbook. The message is one line."""


def damaged(what: str) -> WorkbookError:
    """An error for a file that breaks the rules of its format; `what` says how and where."""
    return WorkbookError(f"is damaged: {what}; a spreadsheet program may be able to repair it")


def too_much(what: str) -> WorkbookError:
    """An error for a file that is larger than this program reads; `what` says what it has."""
    return WorkbookError(f"is refused: {what}")


def open_archive(path: Path) -> zipfile.ZipFile:
    """Open a zip archive, after a look at the size of its list of parts.

    Raises WorkbookError if that is too long, and one of UNREADABLE if this is no zip archive.
    """
    with path.open("rb") as file:
        size = file.seek(0, 2)
        file.seek(max(0, size - 2**16 - 22))
        tail = file.read()
    end = tail.rfind(b"PK\5\6")
    # A list beyond four gigabytes is in another place, and this says -1.
    if end >= 0 and int.from_bytes(tail[end + 12 : end + 16], "little") > _MAX_LISTING:
        raise too_much(f"it holds more than {MAX_PARTS:,} parts")
    return zipfile.ZipFile(path)


class Package:
    """The parts of one file, by their names; these count the same in capital and small letters."""

    def __init__(self, archive: zipfile.ZipFile) -> None:
        members = archive.infolist()
        if len(members) > MAX_PARTS:
            raise too_much(f"it holds more than {MAX_PARTS:,} parts")
        if any(member.flag_bits & 1 for member in members):
            raise WorkbookError("has parts with a password; save it without one")
        self.archive = archive
        self.parts: dict[str, zipfile.ZipInfo] = {}
        for member in members:
            self.parts.setdefault(_part_key(member.filename), member)
        self.bytes_left, self.events_left = MAX_UNPACKED, MAX_EVENTS

    def __contains__(self, part: str) -> bool:
        return _part_key(part) in self.parts

    def relations(self, part: str) -> dict[str, tuple[str, str]]:
        """The parts that a part refers to, each with its kind, by the identity of the reference."""
        path = PurePosixPath(part)
        listing = f"{path.parent}/_rels/{path.name}.rels".removeprefix("./")
        if listing not in self:
            return {}
        related = {}
        for relation in self.tree(listing):
            if relation.get("TargetMode") != "External":
                keys = ("Id", "Type", "Target")
                identity, kind, target = (attribute(relation, key, listing) for key in keys)
                # A target may start at the root with "/", or go up with "..".
                name = normpath(join("/", path.parent, target.replace("\\", "/"))).lstrip("/")
                related[identity] = kind.rpartition("/")[2], name
        return related

    def tree(self, part: str) -> ET.Element:
        """Read a whole part as XML."""
        return self._parsed(part, _Builder(self, {}))

    def stream(self, part: str, **takers: Callable[[ET.Element], object]) -> None:
        """Read a part as XML; give each element of these names to its taker, and keep nothing."""
        self._parsed(part, _Builder(self, takers))

    def chunks(self, part: str) -> Iterator[bytes]:
        """Unpack a part, counting the bytes that come out."""
        try:
            with self.archive.open(self.parts[_part_key(part)]) as stream:
                while chunk := stream.read(_CHUNK):
                    self.bytes_left -= len(chunk)
                    if self.bytes_left < 0:
                        raise too_much(f"it unpacks to more than {MAX_UNPACKED >> 20} MB")
                    yield chunk
        except WorkbookError:
            raise
        except UNREADABLE as error:
            raise damaged(f"its part {part} cannot be unpacked: {error}") from error

    def _parsed(self, part: str, builder: "_Builder") -> ET.Element:
        if part not in self:
            raise damaged(f"it refers to its part {part}, which is not there")
        parser = ET.XMLParser(target=builder)
        unfinished = 0
        try:
            for chunk in self.chunks(part):
                left = self.events_left
                parser.feed(chunk)
                unfinished = 0 if self.events_left < left else unfinished + len(chunk)
                if unfinished > _MAX_PIECE and hasattr(parser, "flush"):
                    # Newer parsers wait for more of a long piece, even if its end is there already.
                    parser.flush()
                    unfinished = 0 if self.events_left < left else unfinished
                if unfinished > _MAX_PIECE:
                    raise too_much(f"a tag, comment or blank of its part {part} has more than 1 MB")
            return parser.close()
        except WorkbookError:
            raise
        except (ET.ParseError, LookupError, ValueError) as error:  # the last two for an encoding
            raise damaged(f"its part {part} is not valid XML: {error}") from error


def _part_key(part: str) -> str:
    """The name of a part as names are compared."""
    return part.replace("\\", "/").lstrip("/").lower()


class _Builder(ET.TreeBuilder):
    """Build the XML tree of a part; if there are takers, only the elements that they take."""

    def __init__(self, package: Package, takers: dict[str, Callable[[ET.Element], object]]) -> None:
        super().__init__()
        self.package, self.takers = package, takers
        self.open: list[ET.Element] = []
        self.kept = 0
        self.taken_from = 0 if not takers else MAX_DEPTH + 1
        """The level of the outermost element that is kept."""

    def _count(self) -> None:
        self.package.events_left -= 1
        if self.package.events_left < 0:
            raise too_much(f"it has more than {MAX_EVENTS:,} pieces of XML")

    def doctype(self, *_: object) -> None:
        raise too_much("its XML declares a document type, which no workbook needs")

    def comment(self, *_: Any) -> Any:
        self._count()

    def pi(self, *_: Any) -> Any:
        self._count()

    def data(self, text: Any) -> None:
        self._count()
        if len(self.open) > self.taken_from:
            super().data(text)

    def start(self, tag: Any, attributes: Any) -> ET.Element:
        self._count()
        element = super().start(tag, attributes)
        self.open.append(element)
        if len(self.open) > MAX_DEPTH:
            raise damaged(f"its XML is nested more than {MAX_DEPTH} levels deep")
        if len(self.open) <= self.taken_from and name_of(element) in self.takers:
            self.taken_from, self.kept = len(self.open) - 1, 0
        self.kept += 1
        if self.kept > MAX_TREE and len(self.open) > self.taken_from:
            raise too_much(f"one of its rows, or a list, has more than {MAX_TREE:,} pieces")
        return element

    def end(self, tag: Any) -> ET.Element:
        element = super().end(tag)
        self.open.pop()
        if self.takers and len(self.open) <= self.taken_from:
            if len(self.open) == self.taken_from:
                self.taken_from = MAX_DEPTH + 1
                self.takers[name_of(element)](element)
            element.clear()
            if self.open:
                del self.open[-1][-1]
        return element


def name_of(element: ET.Element) -> str:
    """The name of an element without its namespace."""
    return element.tag.rpartition("}")[2]


def attribute(element: ET.Element, key: str, part: str) -> str:
    """An attribute of an element, which it must have."""
    if (value := element.get(key)) is None:
        raise damaged(f"a <{name_of(element)}> of its part {part} has no {key!r}")
    return value
