"""Read the command line with argparse: which command, and what its options say."""

import argparse
import re
import sys
from collections.abc import Mapping, Sequence
from typing import Any, NoReturn, Protocol

from replication.user_input import advice, one_line, quoted


class Command(Protocol):
    """What a module of a command has: `coldspray NAME` calls `run` with what `add_options` read.

    `run` returns the exit status, 0 or 1. It raises ValueError or OSError if it cannot do its work.
    """

    HELP: str
    EXAMPLE: str

    def add_options(self, parser: argparse.ArgumentParser) -> None:
        """Declare the command's arguments and options."""

    def run(self, options: argparse.Namespace) -> int:
        """Do the command's work and return its exit status."""


class Parser(argparse.ArgumentParser):
    """An argument parser that reports an error in one line, and takes an option only once."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        self.register("action", None, _Store)
        self.register("action", "store_true", _Flag)
        # Take -5m/s for a number, not for an option, so that the error is about the number.
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {one_line(message)} (see {self.prog} --help)\n")

    def _print_message(self, message: str, file: Any = None) -> None:
        # argparse itself ignores a failed write, as to a full disk.
        print(message, end="", file=file or sys.stderr, flush=True)


class _Store(argparse.Action):
    """Store an argument's value. An option that is given twice is refused, not the first forgotten.

    `action="append"` is for options that may be repeated.
    """

    is_given = False

    def __call__(self, _: Any, namespace: Any, values: Any, option_string: Any = None) -> None:
        if self.is_given and option_string:
            raise argparse.ArgumentError(self, "it is given twice")
        self.is_given = True
        setattr(namespace, self.dest, self.const if self.nargs == 0 else values)


class _Flag(_Store):
    """Store that an option without a value was given."""

    def __init__(self, option_strings: Sequence[str], dest: str, **settings: Any) -> None:
        super().__init__(option_strings, dest, nargs=0, const=True, default=False, **settings)


_OWN_OPTIONS = ("-h", "--help", "--version")
"""The options that stand without a command."""


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> NoReturn:
        from importlib.metadata import version

        print(f"coldspray {version('coldspray')}", flush=True)
        parser.exit(0)


_DASHES = re.compile(r"(-\w|--[\w-]+=)--")
"""An option with the value `--`, which argparse drops (CPython issue 59317)."""


def parse_command_line(
    commands: Mapping[str, Command], arguments: Sequence[str]
) -> argparse.Namespace:
    """Read the arguments; the result names the command and has the value of each of its options.

    Prints help or the version, or the error in one line, and then raises SystemExit. Without
    arguments it prints the help: somebody who asks for nothing is told what there is.
    """
    parser = Parser(
        prog="coldspray",
        description="Re-run and audit W. S. de Rosset's 2006 cold-spray penetration model.",
        epilog="`coldspray COMMAND --help` says what a command takes, with an example.",
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    choice = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    first = arguments[0] if arguments else ""
    for name in [first] if first in commands else commands:  # loading all of them takes longer
        command = commands[name]
        about, example = f"{command.HELP[0].upper()}{command.HELP[1:]}.", command.EXAMPLE
        own = choice.add_parser(
            name, help=command.HELP, description=about, epilog=f"example: {example}"
        )
        if name in arguments:  # declaring the options of all commands would load much
            command.add_options(own)
    if not arguments:
        parser.print_help(sys.stdout)
        parser.exit(0)
    for argument in arguments:
        if _DASHES.fullmatch(argument):
            parser.error(f"{quoted(argument)}: two dashes are not a value")
    if first not in commands and (first == "--" or not first.startswith("-")):
        parser.error(f"there is no command {quoted(first)}: {advice(first, commands)}")
    if first.startswith("-") and not any(own.startswith(first) for own in _OWN_OPTIONS):
        parser.error(f"{quoted(first)} comes before a command: begin with that, such as depth")
    options, unknown = parser.parse_known_args(arguments)
    if unknown:  # refer to the help of the command, not of `coldspray`
        own = choice.choices[options.command]
        own.error(f"unrecognized arguments: {' '.join(unknown)}{_similar(own, unknown)}")
    return options


def _similar(command: argparse.ArgumentParser, unknown: Sequence[str]) -> str:
    """Return which option was probably meant by the first unknown one."""
    given = next((text.partition("=")[0] for text in unknown if text.startswith("--")), "")
    actions = command._option_string_actions
    acts = [name for name in actions if actions[name].help is not argparse.SUPPRESS]
    known = [name for name in acts if name.startswith("--")]
    meant = advice(given, known, otherwise="") if len(given) > 2 else ""
    return f"; {meant}" if meant else ""
