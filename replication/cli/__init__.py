"""The command `coldspray`: read the command line, run one command, report what went wrong.

Each command is a module of this package, with `add_options` and `run`; what several of them share
is in `options`, `case`, `output` and `differences`. Commands import what they need when they run,
so that a light one starts fast.
"""

import io
import os
import signal
import sys
from collections.abc import Mapping, Sequence
from typing import NoReturn, TextIO

from replication.cli import (
    audit,
    bench,
    check,
    claims,
    converge,
    crater,
    depth,
    diff,
    fit,
    history,
    power,
    sheet,
    solve,
    stability,
    sweep,
    workbook,
)
from replication.cli.parser import Command, parse_command_line
from replication.reading import one_line

COMMANDS: Mapping[str, Command] = {
    "audit": audit,
    "claims": claims,
    "workbook": workbook,
    "sheet": sheet,
    "depth": depth,
    "crater": crater,
    "solve": solve,
    "fit": fit,
    "history": history,
    "converge": converge,
    "stability": stability,
    "sweep": sweep,
    "bench": bench,
    "check": check,
    "diff": diff,
    "power": power,
}
"""The module of each command, in the order of `coldspray --help`."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status: 0, 1 or 2.

    Each command says when it returns 1; with 2 it could not do its work. A status above 128 means,
    as for any program, that a signal ended it.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # Escape characters that the terminal's encoding lacks.
            stream.reconfigure(errors="backslashreplace")
    program = "coldspray"
    try:
        options = parse_command_line(COMMANDS, sys.argv[1:] if arguments is None else arguments)
        program += f" {options.command}"
        if arguments is None:
            _end_as_interrupted()
        status = COMMANDS[options.command].run(options)
        if sys.stdout is not None:
            sys.stdout.flush()
    except BrokenPipeError:
        _discard(sys.stdout)
        return 128 + 13  # what shells report for SIGPIPE; 0 or 1 might be untrue
    except KeyboardInterrupt as interrupt:
        _complain(program, "interrupted; no file is left in part")
        return 128 + (interrupt.args[0] if interrupt.args else signal.SIGINT)
    except OSError as error:
        if error.filename is None:
            _discard(sys.stdout)  # writing to it failed: its disk may be full
        name, reason = error.filename2 or error.filename, error.strerror or str(error)
        _complain(program, f"{name}: {reason}" if name else reason)
        return 2
    except ValueError as error:
        _complain(program, str(error))
        return 2
    return status


def _complain(program: str, message: str) -> None:
    """Print a message to stderr. If that fails, the exit status still reports the error."""
    if sys.stderr is not None:
        try:
            print(f"{program}: {one_line(message)}", file=sys.stderr, flush=True)
        except OSError:
            _discard(sys.stderr)


def _discard(stream: TextIO | None) -> None:
    """Redirect a stream to nowhere: otherwise Python retries the failed write when it exits."""
    # A stream that a caller has put in place of Python's own is left alone.
    if stream in (sys.__stdout__, sys.__stderr__) and stream is not None:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _end_as_interrupted() -> None:
    """Let SIGTERM and SIGHUP end the program as Ctrl-C does, so that half-written files go.

    A signal that is ignored, as under `nohup`, stays ignored.
    """

    def interrupt(number: int, _: object) -> NoReturn:
        raise KeyboardInterrupt(number)

    for name in ("SIGTERM", "SIGHUP"):  # Windows has no hangup
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, interrupt)
