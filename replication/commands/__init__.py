"""The commands, one module each: HELP, `options` for its parser, `run` for its work.

Each imports what it needs when it runs, so that a light command starts fast.
"""

from types import ModuleType

from replication.commands import (
    audit,
    bench,
    check,
    claims,
    converge,
    depth,
    diff,
    history,
    sheet,
    stability,
    sweep,
    workbook,
)

__all__ = ["COMMANDS"]

COMMANDS: tuple[ModuleType, ...] = (
    audit,
    claims,
    workbook,
    sheet,
    depth,
    history,
    converge,
    stability,
    sweep,
    bench,
    check,
    diff,
)
"""In the order in which `coldspray --help` lists them."""
