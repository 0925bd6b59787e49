"""The command `coldspray`. Each command imports what it needs when it runs."""

import argparse
import io
import os
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from replication.case import INPUTS, inputs_of, read_case, read_number
from replication.impact import Impact

if TYPE_CHECKING:
    from replication.workbook import Cases

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; the exit status: 0, 1 if the command promises it, 2 if it cannot work."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # What a terminal's encoding lacks is escaped, as JSON allows, not an error.
            stream.reconfigure(errors="backslashreplace")
    options = _parser().parse_args(arguments)
    try:
        status = options.run(options)
        if sys.stdout is not None:
            sys.stdout.flush()
    except BrokenPipeError:
        # The reader of a pipe has seen enough; nothing more can be said to it.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except KeyboardInterrupt:
        print(f"coldspray {options.command}: interrupted, nothing written", file=sys.stderr)
        return 130
    except (ValueError, OSError) as error:
        print(f"coldspray {options.command}: {_one_line(error)}", file=sys.stderr)
        return 2
    assert isinstance(status, int)
    return status


def _one_line(error: Exception) -> str:
    if isinstance(error, OSError) and error.strerror:
        name = error.filename2 or error.filename
        return f"{name}: {error.strerror}" if name else error.strerror
    return " ".join(str(error).split())


class _Parser(argparse.ArgumentParser):
    """An argument parser that says what is wrong in one line."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message} (see {self.prog} --help)\n")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="coldspray",
        description="Re-run and audit W. S. de Rosset's 2006 cold-spray penetration model.",
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    _audit_options(_command(commands, "audit", _audit, "audit every number the report prints"))
    _claims_options(_command(commands, "claims", _claims, "list the claims, or prove one"))
    _workbook_options(_command(commands, "workbook", _workbook, "write the live workbook"))
    sheet = _command(commands, "sheet", _sheet, "the Excel scheme's rows for a case")
    depth = _command(commands, "depth", _depth, "final depth of a case, without time steps")
    converge = _command(
        commands, "converge", _converge, "error against time step, observed order, limit"
    )
    for command in (sheet, depth, converge):
        _input_options(command, "beta-5")
    for command in (sheet, converge):
        command.add_argument(
            "--scheme", metavar="NAME", default="published", help="published (default) or centered"
        )
    sheet.add_argument("--csv", action="store_true", help="print CSV")
    _converge_options(converge)
    stability = _command(
        commands, "stability", _stability, "the hard cases: sheet, closed form and reference"
    )
    _stability_options(stability)
    for command in (sheet, depth, converge, stability):
        command.add_argument("--json", action="store_true", help="print JSON")
        command.add_argument("--quiet", action="store_true", help="no warnings")
    return parser


def _converge_options(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--steps", metavar="X,X,...", help="steps, coarsest first (default: from 16 times --step)"
    )
    command.add_argument(
        "--levels",
        type=int,
        default=8,
        metavar="N",
        help="number of steps, by halves (8)",
    )
    command.add_argument(
        "--digits", type=int, metavar="N", help="also find the largest step for N correct digits"
    )


def _stability_options(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--random", type=int, default=100_000, metavar="N", help="random cases (100000)"
    )
    command.add_argument("--seed", type=int, default=1, metavar="N", help="of the random cases (1)")


def _path(text: str) -> Path:
    """A path from the command line; an unset variable must not mean this folder."""
    if not text:
        raise argparse.ArgumentTypeError("a path is wanted, not an empty text")
    return Path(text)


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> NoReturn:
        from importlib.metadata import version

        print(f"coldspray {version('coldspray')}")
        parser.exit(0)


def _command(
    commands: Any, name: str, run: Callable[[argparse.Namespace], int], help_text: str
) -> argparse.ArgumentParser:
    command: argparse.ArgumentParser = commands.add_parser(
        name, help=help_text, description=f"{help_text[0].upper()}{help_text[1:]}."
    )
    command.set_defaults(run=run)
    return command


def _audit_options(command: argparse.ArgumentParser) -> None:
    folder = Path("coldspray-audit")
    command.add_argument(
        "--out",
        type=_path,
        default=folder,
        metavar="DIR",
        help=f"default: {folder}/",
    )
    command.add_argument(
        "--exit-code", action="store_true", help="status 1 if any claim is not reproduced"
    )
    command.add_argument("--json", action="store_true", help="print audit.json instead of text")
    command.add_argument("--quiet", action="store_true", help="write the files, print nothing")


def _claims_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("id", nargs="?", metavar="ID", help="prove this claim")
    command.add_argument("--json", action="store_true", help="print JSON")


def _workbook_options(command: argparse.ArgumentParser) -> None:
    output = Path("workbook.xlsx")
    command.add_argument(
        "-o", "--output", type=_path, default=output, metavar="FILE", help=f"{output}"
    )
    command.add_argument("--quiet", action="store_true", help="do not say what was written")
    command.add_argument(
        "--verify", action="store_true", help="recalculate it in every engine; status 1 if they err"
    )
    command.add_argument("--json", action="store_true", help="with --verify: print JSON")
    _input_options(command, "the report's two cases")


def _input_options(command: argparse.ArgumentParser, default: str) -> None:
    command.add_argument("--case", metavar="NAME", help=f"beta-5 or beta-3 (default: {default})")
    command.add_argument(
        "--case-file",
        type=_path,
        metavar="FILE",
        help="TOML, table [impact]",
    )
    for name, unit in INPUTS.items():
        flag = "--" + name.replace("_", "-")
        shown = "" if unit == "1" else f" in {unit}, or with its unit"
        help_text = f"{name.replace('_', ' ')}{shown}"
        command.add_argument(flag, dest=name, metavar="X", help=help_text)


def _given(options: argparse.Namespace) -> dict[str, str]:
    values = {name: getattr(options, name) for name in INPUTS}
    return {name: value for name, value in values.items() if value is not None}


def _case(options: argparse.Namespace) -> Impact:
    name = "beta-5" if options.case is None else options.case
    return read_case(name, options.case_file, _given(options))


def _print_json(record: Any) -> None:
    from replication.reports.plain import json_text

    sys.stdout.write(json_text(record))


def _audit(options: argparse.Namespace) -> int:
    from replication.audit import Verdict, audit
    from replication.reports.files import check_folder, write_audit
    from replication.reports.records import audit_record
    from replication.reports.terminal import audit_summary

    check_folder(options.out)
    done = audit()
    record = audit_record(done)
    paths = write_audit(done, record, options.out)
    if options.json:
        _print_json(record)
    elif not options.quiet:
        print(audit_summary(done), *("", "Written:", *(f"  {path}" for path in paths)), sep="\n")
    return 1 if options.exit_code and done.with_verdict(Verdict.NOT_REPRODUCED) else 0


def _claims(options: argparse.Namespace) -> int:
    from reference.ledger import load
    from replication.reports import records, terminal

    ledger = load()
    if options.id is None:
        claims = list(ledger.claims.values())
        if options.json:
            _print_json([records.ledger_record(claim) for claim in claims])
        else:
            print(terminal.ledger_table(claims))
        return 0
    if options.id not in ledger.claims:
        raise ValueError(f"there is no claim {options.id!r}{_nearest(options.id, ledger.claims)}")
    from replication.audit import assess_claim

    assessment = assess_claim(ledger, options.id)
    if options.json:
        _print_json(records.claim_record(ledger, assessment))
    else:
        print(terminal.claim_proof(ledger, assessment))
    return 0


def _nearest(name: str, known: Any) -> str:
    from difflib import get_close_matches

    near = get_close_matches(name, known, n=3, cutoff=0.4)
    return f"; near it: {', '.join(near)}" if near else "; `coldspray claims` lists them"


def _workbook(options: argparse.Namespace) -> int:
    from replication import workbook

    own = options.case is not None or options.case_file is not None or _given(options)
    cases = {"Sheet": _case(options)} if own else workbook.REPORT
    if options.verify:
        return _verified(options, cases)
    if options.json:
        raise ValueError("--json is for what --verify finds: give both")
    workbook.write(options.output, cases)
    if not options.quiet:
        print(f"Written: {options.output}")
    return 0


def _verified(options: argparse.Namespace, cases: "Cases") -> int:
    from replication import workbook
    from replication.reports.verification import verification_record, verification_text

    checks = workbook.write_verified(options.output, cases)
    if options.json:
        _print_json(verification_record(options.output, checks))
    elif not options.quiet:
        print(f"Written: {options.output}", "", verification_text(checks), sep="\n")
    return 0 if all(check.passed for check in checks) else 1


def _warn(options: argparse.Namespace, warnings: Iterable[str]) -> None:
    if not options.quiet:
        for warning in warnings:
            print(f"coldspray {options.command}: warning: {warning}", file=sys.stderr)


def _sheet(options: argparse.Namespace) -> int:
    from replication.midpoint import run

    sheet = run(_case(options), options.scheme)
    if options.json:
        _print_json(
            {
                "inputs": inputs_of(sheet.impact),
                "scheme": sheet.scheme,
                "rows": [row._asdict() for row in sheet.rows],
                "final_depth": sheet.final_depth,
                "normalized_depth": sheet.normalized_depth,
                "steps": sheet.steps,
                "warnings": sheet.warnings,
            }
        )
        return 0
    if options.csv:
        from replication.reports.plain import rows_csv

        sys.stdout.write(rows_csv([row._asdict() for row in sheet.rows]))
    else:
        from replication.reports.sheet import sheet_table

        print(sheet_table(sheet))
    _warn(options, sheet.warnings)
    return 0


def _converge(options: argparse.Namespace) -> int:
    from replication.analysis import convergence
    from replication.reports import numerics

    case = _case(options)
    if not 2 <= options.levels <= 40:
        raise ValueError("--levels wants 2 to 40")
    if options.steps is None:
        steps = convergence.ladder(case.step, options.levels)
    else:
        steps = [read_number(text, "s") for text in options.steps.split(",")]
    found = convergence.converge(case, steps, options.scheme)
    digits = None
    if options.digits is not None:
        digits = convergence.step_for_digits(case, options.digits, options.scheme)
    if options.json:
        _print_json(numerics.convergence_record(found, digits))
    else:
        print(numerics.convergence_text(found, digits))
        _warn(options, (f"{x.step!r} s: {note}" for x in found.levels for note in x.warnings))
    return 0


def _stability(options: argparse.Namespace) -> int:
    from replication.analysis import stability
    from replication.reports import numerics

    if not 1 <= options.random <= 10_000_000 or options.seed < 0:
        raise ValueError("--random wants 1 to 10,000,000 cases, --seed zero or more")
    outcomes = [stability.outcome(case) for case in stability.HARD_CASES]
    worst = stability.worst_of(options.random, options.seed)
    if options.json:
        _print_json(numerics.stability_record(outcomes, worst))
    else:
        print(numerics.stability_text(outcomes, worst))
    return 0


def _depth(options: argparse.Namespace) -> int:
    from replication.closed_form import normalized_depth

    case = _case(options)
    ratio = float(
        normalized_depth(
            case.velocity, case.particle_density, case.target_density, case.target_resistance
        )
    )
    depth, beyond = case.radius * ratio, ratio > 1
    if options.json:
        _print_json(
            {
                "inputs": inputs_of(case),
                "depth": depth,
                "normalized_depth": ratio,
                "beyond_radius": beyond,
            }
        )
        return 0
    print(f"final depth       {depth * 1e6:.8g} um ({depth!r} m)")
    print(f"normalized depth  {ratio:.8g}")
    print(f"beyond radius     {'yes' if beyond else 'no'}")
    return 0
