"""The command `coldspray`: read the command line, run one command, report what went wrong.

`options.toml` lists each command's options; `run_depth` in `commands` runs the command `depth`.
Only the options of the command in use are declared, and each command imports what it needs, so that
a light command starts fast.
"""

import argparse
import io
import os
import re
import signal
import sys
import tomllib
from collections.abc import Callable, Sequence
from importlib import resources
from pathlib import Path
from typing import Any, NoReturn, TextIO

from replication.reading import one_line, quoted

COMMANDS = tomllib.loads((resources.files(__name__) / "options.toml").read_text("utf-8"))
"""The table of each command in `options.toml`, in the order of `coldspray --help`."""
_EVERY = COMMANDS.pop("every")


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
        options = _options(sys.argv[1:] if arguments is None else arguments)
        program += f" {options.command}"
        if arguments is None:
            _end_as_interrupted()
        status = options.run(options)
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
    assert isinstance(status, int)
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


class _Parser(argparse.ArgumentParser):
    """An argument parser that reports an error in one line."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        # Take -5m/s for a number, not for an option, so that the error is about the number.
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {one_line(message)} (see {self.prog} --help)\n")

    def _print_message(self, message: str, file: Any = None) -> None:
        # argparse itself ignores a failed write, as to a full disk.
        print(message, end="", file=file or sys.stderr, flush=True)


_DASHES = re.compile(r"(-\w|--[\w-]+=)--")
"""An option with the value `--`, which argparse drops (CPython issue 59317)."""


def _options(arguments: Sequence[str]) -> argparse.Namespace:
    parser = _Parser(
        prog="coldspray",
        description="Re-run and audit W. S. de Rosset's 2006 cold-spray penetration model.",
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, takes in COMMANDS.items():
        does = takes["does"]
        command = commands.add_parser(name, help=does, description=f"{does[0].upper()}{does[1:]}.")
        if name in arguments:
            from replication.cli import commands as home

            _declare(command, takes | _EVERY | takes)  # its own come first, and prevail
            command.set_defaults(run=getattr(home, f"run_{name}"))
    for argument in arguments:
        if _DASHES.fullmatch(argument):
            parser.error(f"{quoted(argument)}: two dashes are not a value")
    options, unknown = parser.parse_known_args(arguments)
    if unknown:  # refer to the help of the command, not of `coldspray`
        commands.choices[options.command].error(f"unrecognized arguments: {' '.join(unknown)}")
    return options


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> NoReturn:
        from importlib.metadata import version

        print(f"coldspray {version('coldspray')}", flush=True)
        parser.exit(0)


def _declare(command: argparse.ArgumentParser, takes: dict[str, Any]) -> None:
    groups: dict[str, argparse._ActionsContainer] = {"": command}
    for option, entry in takes.items():
        if option == "inputs":
            _declare_inputs(command, entry)
        if option in ("does", "inputs"):
            continue
        settings = {"help": entry} if isinstance(entry, str) else dict(entry)
        either, within = settings.pop("either", ""), settings.pop("within", ())
        *names, last = option.split()
        if last.startswith("-"):
            settings["action"] = "store_true"
            names.append(last)
        else:
            settings |= {"type": _whole(*within) if last == "N" else _READERS.get(last, str)}
            settings.setdefault("metavar", last)
        if either not in groups:
            groups[either] = command.add_mutually_exclusive_group()
        groups[either].add_argument(*names, **settings)


def _declare_inputs(command: argparse.ArgumentParser, default: str) -> None:
    """Declare --case, --case-file and every input of a case."""
    from replication.cases import INPUTS

    group = command.add_argument_group(
        "the case",
        "Inputs not given are those of the named case. A resistance replaces beta and flow "
        "stress. Step and stop velocity concern the sheet. A plain number is in the unit shown; "
        'others are understood, such as "11 um", "98 ksi" and "0.2 ns".',
    )
    group.add_argument("--case", metavar="NAME", help=f"beta-5 or beta-3 (default: {default})")
    group.add_argument("--case-file", type=_path, metavar="FILE", help="TOML, table [impact]")
    for name, unit in INPUTS.items():
        meaning = name.replace("_", " ") + ("" if unit == "1" else f" [{unit}]")
        group.add_argument(f"--{name.replace('_', '-')}", metavar="X", help=meaning)


def _path(text: str) -> Path:
    """Read a path. An empty text, as from an unset variable, must not mean the current folder."""
    if not text or "\0" in text:
        raise argparse.ArgumentTypeError(f"give a path, not {quoted(text)}")
    return Path(text)


def _share(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = -1.0
    if not 0 <= number <= 1:
        raise argparse.ArgumentTypeError(f"give a number from 0 to 1, not {quoted(text)}")
    return number


def _whole(least: int = 0, most: int = 0) -> Callable[[str], int]:
    """Return a reader of whole numbers within bounds; without `most`, of up to 20 digits."""
    allowed = f"from {least:,} to {most:,}" if most else "of at most 20 digits, without a sign"

    def read(text: str) -> int:
        if re.fullmatch(r"\s*[0-9]{1,20}\s*", text) and least <= int(text) <= (most or 10**20):
            return int(text)
        raise argparse.ArgumentTypeError(f"give a whole number {allowed}, not {quoted(text)}")

    return read


_READERS = dict.fromkeys(("FILE", "DIR", "A.xlsx", "B.xlsx"), _path) | {"SHARE": _share}
