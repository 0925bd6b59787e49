"""Write each file completely or not at all; and name the errors that damaged archives raise."""

import os
import re
import signal
import zipfile
import zlib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from errno import EACCES, EBUSY, EEXIST, EINVAL, EISDIR, ENOTDIR
from lzma import LZMAError
from pathlib import Path
from threading import current_thread, main_thread

UNREADABLE = (
    zipfile.BadZipFile, zlib.error, LZMAError, EOFError, OSError, RuntimeError, ValueError,
)  # fmt: skip
"""What `zipfile` raises for an archive that is damaged or compressed by an unknown method."""


def check_target(path: Path) -> Path:
    """Return the file that writing to `path` would create or replace, after following links.

    Raises OSError, naming the path, if that is not a regular file or its folder does not exist.
    """
    with suppress(FileNotFoundError):
        path.stat()  # raises OSError for a link that leads to itself
    target = path.resolve()
    if target.is_dir():
        raise IsADirectoryError(EISDIR, "this is a folder; give a file", str(path))
    if target.exists() and not target.is_file():
        raise OSError(EINVAL, "this is not a regular file", str(path))
    if target.exists() and not os.access(target, os.W_OK):
        raise PermissionError(EACCES, "is write-protected", str(path))
    if not target.parent.is_dir():
        raise FileNotFoundError(2, "the folder to write to does not exist", str(path.parent))
    return target


def check_own(path: Path, mark: bytes) -> None:
    """Raise OSError, naming the path, if writing to it would replace what we have not written.

    Our own files have `mark` within their first kilobyte; an empty file may be replaced, too.
    """
    target = check_target(path)
    if target.exists():
        with target.open("rb") as file:
            start = file.read(1024)
        if start and mark not in start:
            problem = "this file was written by something else; give another name, or remove it"
            raise FileExistsError(EEXIST, problem, str(path))


@contextmanager
def draft_of(path: Path) -> Iterator[Path]:
    """Yield a draft beside `path`: renamed to `path` if the block succeeds, deleted if it fails.

    A draft that a killed run left behind is deleted first. If that run is in fact still writing, it
    ends with an error, so that no file mixes two runs. Raises OSError, naming the path.
    """
    target = check_target(path)
    draft = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        for file in target.parent.iterdir():
            if re.fullmatch(rf"\.{re.escape(target.name)}\.\d+\.part", file.name):
                file.unlink(missing_ok=True)
        yield draft
        try:
            with draft.open("r+b") as written:
                # After a crash, the name must not stand for a file whose content was never stored.
                os.fsync(written.fileno())
            draft.replace(target)
        except FileNotFoundError as error:
            raise OSError(EBUSY, "another run is writing this file") from error
    except OSError as error:
        # The error of a full disk names no file. An error that names another file is not about
        # this draft: where several drafts are open, it comes from one of the others.
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
    """Raise OSError, naming the path, if files of these names could not be written in a folder.

    The names may contain subfolders. Neither the folder nor its subfolders need exist yet.
    """
    for path in (folder / name for name in names):
        # The nearest parent that exists; a link counts as existing, wherever it leads.
        nearest = next(parent for parent in path.parents if os.path.lexists(parent))
        if not nearest.is_dir():
            raise NotADirectoryError(ENOTDIR, "this is not a folder; give a folder", str(nearest))
        if not os.access(nearest, os.W_OK):
            raise PermissionError(EACCES, "cannot be written to", str(nearest))
        if nearest == path.parent:
            check_target(path)


def write_folder(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write files, given by name, into a folder, which is created if needed. Raises OSError.

    When all drafts are complete, they are renamed one by one; an interruption waits until that is
    done. If a draft cannot be renamed, those before it keep their new names.
    """
    check_folder(folder, files)
    with ExitStack() as signals, ExitStack() as drafts:
        for name, content in files.items():
            path = folder / name
            for parent in reversed(path.parents):
                if not parent.exists():
                    parent.mkdir()
                    drafts.callback(_remove_if_empty, parent)
            drafts.enter_context(draft_of(path)).write_bytes(content)
        signals.enter_context(_postponed_signals())


@contextmanager
def _postponed_signals() -> Iterator[None]:
    """Postpone signals that would end the program until the block ends.

    Only the main thread can do so; in any other thread nothing is postponed.
    """
    if current_thread() is not main_thread():
        yield
        return
    received: list[int] = []
    handlers = {}
    for name in ("SIGINT", "SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)  # Windows has no SIGHUP
        if number is not None and signal.getsignal(number) not in (signal.SIG_IGN, None):
            handlers[number] = signal.signal(number, lambda number, _: received.append(number))
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        for number in received[:1]:
            signal.raise_signal(number)


def _remove_if_empty(folder: Path) -> None:
    with suppress(OSError):
        folder.rmdir()
