"""Files that are written whole or not at all."""

import os
from errno import EINVAL, EISDIR
from pathlib import Path

__all__ = ["check_target", "write_bytes"]


def check_target(path: Path) -> Path:
    """The file that writing to `path` will make or replace, links followed.

    Raises OSError, naming the path, for what is no regular file and for a folder that is not there.
    """
    target = path.resolve()
    if target.is_dir():
        raise IsADirectoryError(EISDIR, "is a folder; a file is wanted", str(path))
    if target.exists() and not target.is_file():
        raise OSError(EINVAL, "is no regular file", str(path))
    if not target.parent.is_dir():
        raise FileNotFoundError(2, "the folder to write to does not exist", str(path.parent))
    return target


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file by way of a draft beside it. Raises OSError, naming the path."""
    target = check_target(path)
    draft = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        draft.write_bytes(content)
        draft.replace(target)
    except OSError as error:
        raise type(error)(error.errno, error.strerror, str(path)) from error
    finally:
        draft.unlink(missing_ok=True)
