"""Files that are written whole or not at all."""

import os
import re
import shutil
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from errno import EBUSY, EINVAL, EISDIR, ENOENT, ENOTDIR
from pathlib import Path


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
        raise OSError(EINVAL, "is no regular file", str(path))
    if not target.parent.is_dir():
        raise FileNotFoundError(2, "the folder to write to does not exist", str(path.parent))
    return target


@contextmanager
def draft_of(path: Path) -> Iterator[Path]:
    """A file beside `path` to write to; it takes that name if the block ends well, or goes.

    A draft that an earlier run left, because it was killed, goes first; if that run is still at it,
    it ends with an error, not with a file of two runs. Raises OSError, naming the path.
    """
    target = check_target(path)
    draft = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        for left in target.parent.iterdir():
            if re.fullmatch(rf"\.{re.escape(target.name)}\.\d+\.part", left.name):
                left.unlink(missing_ok=True)
        yield draft
        try:
            _to_disk(draft)
            draft.replace(target)
        except FileNotFoundError as error:
            raise OSError(EBUSY, "another run is writing this file") from error
    except OSError as error:
        if error.errno is None:
            raise
        raise type(error)(error.errno, error.strerror, str(path)) from error
    finally:
        draft.unlink(missing_ok=True)


def _to_disk(file: Path) -> None:
    """A crash must not leave a name without what is in the file."""
    with file.open("r+b") as written:
        os.fsync(written.fileno())


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file by way of a draft beside it. Raises OSError, naming the path."""
    with draft_of(path) as draft:
        draft.write_bytes(content)


def check_folder(folder: Path, names: Iterable[str]) -> None:
    """Raise OSError, naming the path, where files of these names could not be written.

    The names may lead into folders below; none of the folders need be there yet.
    """
    for path in (folder / name for name in names):
        there = _existing(path.parent)
        if not there.is_dir():
            raise NotADirectoryError(ENOTDIR, "is no folder; give a folder", str(there))
        if path.parent.is_dir():
            check_target(path)
    with _beside(folder):
        pass


def _existing(folder: Path) -> Path:
    """The folder, or the nearest above it that is there; a link is there, wherever it leads."""
    for path in (folder, *folder.absolute().parents):
        with suppress(FileNotFoundError, NotADirectoryError):
            path.lstat()
            return path
    raise FileNotFoundError(ENOENT, "is not there", str(folder))


@contextmanager
def _beside(folder: Path) -> Iterator[Path]:
    """A folder for drafts, on the same disk. Raises OSError, naming what cannot be written to.

    As with `draft_of`, one that an earlier run left goes first, wherever that run began it.
    """
    there = _existing(folder)
    name = folder.resolve().name
    try:
        for place in {there, _existing(folder.resolve().parent)}:
            for left in place.glob(".*.part"):
                if re.fullmatch(rf"\.{re.escape(name)}\.\d+\.part", left.name) and left.is_dir():
                    shutil.rmtree(left, ignore_errors=True)
        drafts = there / f".{name}.{os.getpid()}.part"
        drafts.mkdir()
    except OSError as error:
        problem = f"cannot be written to: {error.strerror}"
        raise type(error)(error.errno, problem, str(there)) from error
    try:
        yield drafts
    except FileNotFoundError as error:
        raise OSError(EBUSY, "another run is writing to this folder", str(folder)) from error
    except OSError as error:
        error.filename = error.filename or str(folder)  # a full disk is told without a name
        raise
    finally:
        shutil.rmtree(drafts, ignore_errors=True)


def write_folder(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write files by name into a folder, made if needed.

    They are made beside the folder first and moved in when all are done. Raises OSError.
    """
    check_folder(folder, files)
    with _beside(folder) as temporary:
        for name, content in files.items():
            draft = temporary / name
            draft.parent.mkdir(parents=True, exist_ok=True)
            draft.write_bytes(content)
            _to_disk(draft)
        for name in files:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (temporary / name).replace(folder / name)
