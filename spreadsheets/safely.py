"""Write each file completely or not at all; and name the errors that damaged archives raise."""

import os
import re
import zipfile
import zlib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from errno import EACCES, EBUSY, EEXIST, EINVAL, EISDIR, ENOENT, ENOTDIR
from hashlib import sha256
from lzma import LZMAError
from pathlib import Path

from reference.signals import postponed_signals

UNREADABLE = (
    zipfile.BadZipFile, zlib.error, LZMAError, EOFError, OSError, RuntimeError, ValueError,
)  # fmt: skip
"""What `zipfile` raises for an archive that is damaged or compressed by an unknown method."""


def check_target(path: Path) -> Path:
    """Return the file that writing to `path` would create or replace, after following links.

    Raises OSError, naming the path, if that is not a regular file, its folder does not exist, or a
    draft beside it cannot be created: that is tried.
    """
    with suppress(FileNotFoundError):
        path.stat()  # raises OSError for a link that leads to itself
    try:
        target = path.resolve()
    except FileNotFoundError as error:
        raise FileNotFoundError(ENOENT, "the current folder was deleted", str(path)) from error
    if target.is_dir():
        raise IsADirectoryError(EISDIR, "this is a folder; give a file", str(path))
    if target.exists() and not target.is_file():
        raise OSError(EINVAL, "this is not a regular file", str(path))
    if target.exists() and not os.access(target, os.W_OK):
        raise PermissionError(EACCES, "is write-protected", str(path))
    if not target.parent.is_dir():
        raise FileNotFoundError(ENOENT, "the folder to write to does not exist", str(path.parent))
    trial = _draft_of(target)
    try:
        trial.touch()
    except OSError as error:
        raise type(error)(error.errno, error.strerror, str(path)) from error
    finally:
        trial.unlink(missing_ok=True)
    return target


_LONGEST_NAME = 255 - len("..4294967295.part")
"""The longest name [bytes] of a file whose draft has a name, too; most systems allow 255."""


def _draft_of(target: Path) -> Path:
    """Return the path of this process's draft of a file: hidden, and in the same folder."""
    return target.with_name(f"{_stem_of_drafts(target)}.{os.getpid()}.part")


def _stem_of_drafts(target: Path) -> str:
    """Return how the names of all drafts of a file begin; too long a name is replaced by a hash."""
    name = os.fsencode(target.name)
    return f".{target.name if len(name) <= _LONGEST_NAME else sha256(name).hexdigest()}"


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
    draft = _draft_of(target)
    try:
        for file in target.parent.iterdir():
            if re.fullmatch(rf"{re.escape(_stem_of_drafts(target))}\.\d+\.part", file.name):
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


def write_files(files: Iterable[tuple[Path, bytes]]) -> None:
    """Write files with their contents, all or none. Raises OSError, naming the path.

    When all drafts are complete and stored, they are renamed one by one; an interruption waits
    until that is done. If a draft cannot be renamed, those before it keep their new names.
    """
    with ExitStack() as signals, ExitStack() as drafts:
        for path, content in files:
            with drafts.enter_context(draft_of(path)).open("wb") as draft:
                draft.write(content)
                draft.flush()
                os.fsync(draft.fileno())  # some disks say only now that they are full
        signals.enter_context(postponed_signals())


def check_folder(folder: Path, names: Iterable[str]) -> None:
    """Raise OSError, naming the path, if files of these names could not be written in a folder.

    The names may contain subfolders. Neither the folder nor its subfolders need exist yet: they are
    created, and removed again.
    """
    with ExitStack() as created:
        for path in (folder / name for name in names):
            # The nearest parent that exists; a link counts as existing, wherever it leads.
            nearest = next(parent for parent in path.parents if os.path.lexists(parent))
            if not nearest.is_dir():
                problem = "this is not a folder; give a folder"
                raise NotADirectoryError(ENOTDIR, problem, str(nearest))
            _create_parents(path, created)
            check_target(path)


def write_folder(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write files, given by name, into a folder, which is created if needed, as `write_files` does.

    The names may contain subfolders. Raises OSError.
    """
    check_folder(folder, files)
    with ExitStack() as created:
        for name in files:
            _create_parents(folder / name, created)
        write_files((folder / name, content) for name, content in files.items())


def _create_parents(path: Path, created: ExitStack) -> None:
    """Create the folders above a path that do not exist; `created` removes them if still empty."""
    for parent in reversed(path.parents):
        if not parent.exists():
            try:
                parent.mkdir()
            except OSError as error:
                problem = f"this folder cannot be created: {error.strerror}"
                raise type(error)(error.errno, problem, str(parent)) from error
            created.callback(_remove_if_empty, parent)


def _remove_if_empty(folder: Path) -> None:
    with suppress(OSError):
        folder.rmdir()
