"""The command `coldspray`: read the command line, run one command, report what went wrong.

Each command is a module of this package, with `add_options` and `run`; what several of them share
is in `options`, `case`, `output` and `differences`. Commands import what they need when they run,
so that a light one starts fast.
"""

import io
import signal
import sys
from collections.abc import Iterator, Mapping, Sequence
from importlib import import_module
from typing import NoReturn, cast

from replication.cli.output import complain, discard
from replication.cli.parser import Command, parse_command_line

COMMAND_NAMES = (
    "audit", "claims", "workbook", "sheet", "depth", "crater", "solve", "fit", "history",
    "converge", "stability", "sweep", "bench", "check", "diff", "power",
)  # fmt: skip
"""The commands, in the order of `coldspray --help`."""


class Commands(Mapping[str, Command]):
    """The module of each command by its name, imported when it is asked for."""

    def __getitem__(self, name: str) -> Command:
        if name not in COMMAND_NAMES:
            raise KeyError(name)
        return cast(Command, import_module(f"{__name__}.{name}"))

    def __iter__(self) -> Iterator[str]:
        return iter(COMMAND_NAMES)

    def __len__(self) -> int:
        return len(COMMAND_NAMES)


COMMANDS = Commands()


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status: 0, 1 or 2.

    Each command says when it returns 1; with 2 it could not do its work. A status above 128 means,
    as for any program, that a signal ended it.
    """
    program = "coldspray"
    try:
        for stream in (sys.stdout, sys.stderr):
            if isinstance(stream, io.TextIOWrapper):
                # Escape characters that the terminal's encoding lacks; and end lines alike on all
                # systems, so that what is printed is the same bytes.
                stream.reconfigure(errors="backslashreplace", newline="\n")
        options = parse_command_line(COMMANDS, sys.argv[1:] if arguments is None else arguments)
        program += f" {options.command}"
        if arguments is None:
            _end_as_interrupted()
        status = COMMANDS[options.command].run(options)
        if sys.stdout is not None:
            sys.stdout.flush()
    except BrokenPipeError:
        discard(sys.stdout)
        return 128 + 13  # what shells report for SIGPIPE; 0 or 1 might be untrue
    except KeyboardInterrupt as interrupt:
        complain(program, "interrupted; no file is left in part")
        return 128 + (interrupt.args[0] if interrupt.args else signal.SIGINT)
    except OSError as error:
        if error.filename is None:
            discard(sys.stdout)  # writing to it failed: its disk may be full
        name, reason = error.filename2 or error.filename, error.strerror or str(error)
        complain(program, f"{name}: {reason}" if name else reason)
        return 2
    except ValueError as error:
        complain(program, str(error))
        return 2
    return status


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
