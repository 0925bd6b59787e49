"""Files that are written whole or not at all, each by itself; and archives that may be damaged."""

import os
import re
import signal
import zipfile
import zlib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from errno import EACCES, EBUSY, EINVAL, EISDIR, ENOTDIR
from lzma import LZMAError
from pathlib import Path
from threading import current_thread, main_thread

UNREADABLE = (
    zipfile.BadZipFile, zlib.error, LZMAError, EOFError, OSError, RuntimeError, ValueError,
)  # fmt: skip
"""What `zipfile` raises for an archive that is damaged, or packed in a way it does not know."""


def check_target(path: Path) -> Path:
    """The file that writing to `path` will make or replace, links followed.

    Raises OSError, naming the path, for what is no regular file and for a folder that is not there.
    """
    with suppress(FileNotFoundError):
        path.stat()  # a link that leads to itself
    target = path.resolve()
    if target.is_dir():
        raise IsADirectoryError(EISDIR, "is a folder; give a file", str(path))
    if target.exists() and not target.is_file():
        raise OSError(EINVAL, "is not a regular file", str(path))
    if target.exists() and not os.access(target, os.W_OK):
        raise PermissionError(EACCES, "is write-protected", str(path))
    if not target.parent.is_dir():
        raise FileNotFoundError(2, "the folder to write to does not exist", str(path.parent))
    return target


@contextmanager
def draft_of(path: Path) -> Iterator[Path]:
    """A file beside `path` to write to; it takes that name if the block ends well, or goes.

    A draft that a killed run left is removed first; a run that is still writing its own then ends
    with an error, so that no file mixes two runs. Raises OSError, naming the path.
    """
    target = check_target(path)
    draft = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        for left in target.parent.iterdir():
            if re.fullmatch(rf"\.{re.escape(target.name)}\.\d+\.part", left.name):
                left.unlink(missing_ok=True)
        yield draft
        try:
            with draft.open("r+b") as written:
                os.fsync(written.fileno())  # a crash must not leave a name without its content
            draft.replace(target)
        except FileNotFoundError as error:
            raise OSError(EBUSY, "another run is writing this file") from error
    except OSError as error:
        # A full disk is told without a name; of several drafts, the one that fails gives its own.
        if error.errno is None or error.filename not in (None, str(draft)):
            raise
        raise type(error)(error.errno, error.strerror, str(path)) from error
    finally:
        draft.unlink(missing_ok=True)


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file by way of a draft beside it. Raises OSError, naming the path."""
    with draft_of(path) as draft:
        draft.write_bytes(content)


def check_folder(folder: Path, names: Iterable[str]) -> None:
    """Raise OSError, naming the path, where files of these names could not be written.

    The names may lead into folders below; none of the folders need be there yet.
    """
    for path in (folder / name for name in names):
        # The nearest folder that is there; a link is there, wherever it leads.
        nearest = next(parent for parent in path.parents if os.path.lexists(parent))
        if not nearest.is_dir():
            raise NotADirectoryError(ENOTDIR, "is not a folder; give a folder", str(nearest))
        if not os.access(nearest, os.W_OK):
            raise PermissionError(EACCES, "cannot be written to", str(nearest))
        if nearest == path.parent:
            check_target(path)


def write_folder(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write files by name into a folder, made if needed. Raises OSError.

    They take their names one by one when all are drafted; an interruption waits until all have.
    Where one cannot take its name, those before it have.
    """
    check_folder(folder, files)
    with ExitStack() as undisturbed, ExitStack() as drafts:
        for name, content in files.items():
            path = folder / name
            for parent in reversed(path.parents):
                if not parent.exists():
                    parent.mkdir()
                    drafts.callback(_remove_if_empty, parent)
            drafts.enter_context(draft_of(path)).write_bytes(content)
        undisturbed.enter_context(_signals_wait())


@contextmanager
def _signals_wait() -> Iterator[None]:
    """Hold back what would end the program; only its main thread hears of signals."""
    if current_thread() is not main_thread():
        yield
        return
    heard: list[int] = []
    before = {}
    for name in ("SIGINT", "SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)  # Windows has no hangup
        if number is not None and signal.getsignal(number) not in (signal.SIG_IGN, None):
            before[number] = signal.signal(number, lambda number, _: heard.append(number))
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        for number in heard[:1]:
            signal.raise_signal(number)


def _remove_if_empty(folder: Path) -> None:
    with suppress(OSError):
        folder.rmdir()
