"""The command `coldspray`: reads the command line, runs one command, says what went wrong.

What a command takes stands in `options.toml`; `run_depth` of `commands` does what `depth` is for.
Only its own options are declared, and it imports what it needs, so that a light one starts fast.
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
"""What each does and takes, in the order in which `coldspray --help` lists them."""
_EVERY = COMMANDS.pop("every")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; the exit status: 0, 1 if the command promises it, 2 if it cannot work.

    A status above 128 means, as for any program, that a signal ended it.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # Characters that a terminal's encoding lacks are escaped.
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
        _discard(sys.stdout)  # the reader of the pipe has seen enough; the status might have been 1
        return 128 + 13  # as shells report a program that SIGPIPE ended
    except KeyboardInterrupt as interrupt:
        _complain(program, "interrupted; no file is left in part")
        return 128 + (interrupt.args[0] if interrupt.args else signal.SIGINT)
    except OSError as error:
        if error.filename is None:
            _discard(sys.stdout)  # its disk may be full
        name, reason = error.filename2 or error.filename, error.strerror or str(error)
        _complain(program, f"{name}: {reason}" if name else reason)
        return 2
    except ValueError as error:
        _complain(program, str(error))
        return 2
    assert isinstance(status, int)
    return status


def _complain(program: str, message: str) -> None:
    """Tell the user, if anybody listens: the status says it, too."""
    if sys.stderr is not None:
        try:
            print(f"{program}: {one_line(message)}", file=sys.stderr, flush=True)
        except OSError:
            _discard(sys.stderr)


def _discard(stream: TextIO | None) -> None:
    """Keep Python from trying again, when it ends, to write what could not be written."""
    # Nobody has put another one in its place.
    if stream in (sys.__stdout__, sys.__stderr__) and stream is not None:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _end_as_interrupted() -> None:
    """Have SIGTERM, and the loss of the terminal, end the program as Ctrl-C does: drafts removed.

    A signal that is ignored, as after `nohup`, remains so.
    """

    def interrupt(number: int, _: object) -> NoReturn:
        raise KeyboardInterrupt(number)

    for name in ("SIGTERM", "SIGHUP"):  # Windows has no hangup
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, interrupt)


class _Parser(argparse.ArgumentParser):
    """An argument parser that says what is wrong in one line."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        # A value such as -5m/s is no option, either: it is refused as what it is.
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {one_line(message)} (see {self.prog} --help)\n")

    def _print_message(self, message: str, file: Any = None) -> None:
        # argparse itself would ignore a full disk.
        print(message, end="", file=file or sys.stderr, flush=True)


_DASHES = re.compile(r"(-\w|--[\w-]+=)--")
"""Two dashes as an option's value: argparse drops them (CPython issue 59317)."""


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

            _declare(command, takes | _EVERY | takes)  # its own first
            command.set_defaults(run=getattr(home, f"run_{name}"))
    for argument in arguments:
        if _DASHES.fullmatch(argument):
            parser.error(f"{quoted(argument)}: two dashes are no value")
    options, unknown = parser.parse_known_args(arguments)
    if unknown:  # said by the command, whose help lists what it knows
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
    """--case, --case-file and every input of a case."""
    from replication.cases import INPUTS

    group = command.add_argument_group(
        "the case",
        "Inputs not given are the named case's; a resistance replaces beta and flow stress. "
        "Step and stop velocity are those of the sheet. A plain number is in the unit "
        'shown; others are understood, such as "11 um", "98 ksi" and "0.2 ns".',
    )
    group.add_argument("--case", metavar="NAME", help=f"beta-5 or beta-3 (default: {default})")
    group.add_argument("--case-file", type=_path, metavar="FILE", help="TOML, table [impact]")
    for name, unit in INPUTS.items():
        meaning = name.replace("_", " ") + ("" if unit == "1" else f" [{unit}]")
        group.add_argument(f"--{name.replace('_', '-')}", metavar="X", help=meaning)


def _path(text: str) -> Path:
    """A path from the command line; the empty text of an unset variable is not this folder."""
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
    """A reader of whole numbers within bounds, if the command itself does not bound them."""
    which = f"from {least:,} to {most:,}" if most else "of at most 20 digits, without a sign"

    def read(text: str) -> int:
        if re.fullmatch(r"\s*[0-9]{1,20}\s*", text) and least <= int(text) <= (most or 10**20):
            return int(text)
        raise argparse.ArgumentTypeError(f"give a whole number {which}, not {quoted(text)}")

    return read


_READERS = dict.fromkeys(("FILE", "DIR", "A.xlsx", "B.xlsx"), _path) | {"SHARE": _share}
