"""The commands, one function each, which returns the exit status; and how they print."""

import argparse
import codecs
import gc
import json
import os
import re
import shutil
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from replication.cases import INPUTS, inputs_of, read_case
from replication.cli import COMMANDS
from replication.models.impact import Impact
from replication.reading import one_line, place, quoted, read_number
from replication.text import aligned, columns, json_text, number, numbers, quantity, rows_csv

if TYPE_CHECKING:
    from spreadsheets.verify import EngineCheck


def run_audit(options: argparse.Namespace) -> int:
    if options.schema:
        from replication.audit.record import schema

        _put_json(json_text(schema()))
        return 0
    # The audit makes little garbage; looking for it often would take a tenth of the time.
    gc.set_threshold(1_000_000)
    from replication import report
    from replication.audit.audit import audit
    from replication.error import hard_cases
    from replication.workbook import build
    from spreadsheets import emit
    from spreadsheets.safely import check_folder, write_folder

    check_folder(options.out, report.FILES)
    workbook = options.out / "workbook.xlsx"
    if workbook.exists():
        emit.check(workbook, force=options.force)
    record = audit()
    beside = {
        "workbook.xlsx": build(record=record).to_bytes(),
        "hard-cases.txt": hard_cases.text(hard_cases.record(1000, seed=1)).encode(),
    }
    written = report.contents(record, beside)
    write_folder(options.out, written)
    if options.json:
        _put_json(written["audit.json"].decode())
    elif not options.quiet:
        print(report.summary(record, _width(), _may_emphasize()), end="\n\n")
        print(f"Written to {one_line(str(options.out))}/; start with audit.html")
    return 1 if options.exit_code and record.counts.failing else 0


def run_claims(options: argparse.Namespace) -> int:
    """List the claims of the ledger, without verdicts, or prove one claim."""
    from reference.ledger import load

    ledger = load()
    claims = ledger.claims
    if options.id is None:
        record = [
            {
                **{name: getattr(claim, name) for name in ("id", "title", "unit", "kind")},
                **{name: getattr(claim.place, name) for name in ("line", "section", "cell")},
                "where": str(claim.place),
                "quote": " ".join(claim.quote.split()),
                "printed": claim.text,
            }
            for claim in claims.values()
        ]
        rows = [
            (claim.id, quantity(claim.shown, claim.unit), claim.kind, str(claim.place))
            for claim in claims.values()
        ]
        return _put(options, record, lambda: columns(rows, _width(piped=10_000)))
    if options.id in claims:
        from replication.audit.audit import Audit
        from replication.report import proof

        proven = Audit(ledger).claim(claims[options.id])
        return _put(options, proven, lambda: proof(proven, ledger, _width(), _may_emphasize()))
    from difflib import get_close_matches

    similar = ", ".join(get_close_matches(options.id[:80], list(claims), cutoff=0.4))
    hint = f"similar ones: {similar}" if similar else "`coldspray claims` lists them"
    if options.id in ledger.equations:
        hint = "it is an equation: the page of `coldspray audit` has it"
    raise ValueError(f"there is no claim {quoted(options.id)}; {hint}")


def run_power(options: argparse.Namespace) -> int:
    """Print how many misprints are noticed, by kind of entry and of edit, and which are not."""
    from reference.ledger import load
    from replication.power import power

    progress = partial(_progress, options, unit=" misprints", leave=False)
    result = power(load(), options.sample, options.seed, progress)
    table = result.table()
    lines = [
        f"{result.planted} misprints, planted one at a time; {result.invisible} cannot be noticed,",
        "as all numbers that the audit relates still agree. Of the others, in percent:",
        "",
        *aligned([table.heads, *table.rows]),
    ]
    if result.unnoticed:
        lines += ["", "Visible, and not noticed:"]
        lines += ["  {entry}: {true!r} as {text!r}".format_map(plant) for plant in result.unnoticed]
    return _put(options, result, lambda: "\n".join(lines))


def run_workbook(options: argparse.Namespace) -> int:
    """Write the workbook of the report, or of a case if one is named, and verify it if asked to."""
    from replication import workbook
    from spreadsheets import emit, engines
    from spreadsheets.safely import write_bytes
    from spreadsheets.verify import verify

    emit.check(options.output, force=options.force)
    if options.output.suffix.lower() != ".xlsx":
        raise ValueError(f"{options.output}: a workbook's name ends in .xlsx")
    given = [getattr(options, name) for name in ("case", "case_file", *INPUTS)]
    case = None if all(value is None for value in given) else _case(options)
    book = workbook.build(case, options.scheme, options.rows)
    write_bytes(options.output, book.to_bytes())
    checks = [
        verify(options.output, book.plan, book.cells, engine, long_doubles=book.rounding)
        for engine in (engines.ENGINES if options.verify else ())
    ]
    passed = all(check.passed for check in checks)
    record = {
        "file": str(options.output),
        "passed": passed if options.verify else None,
        "long_double_bound": book.rounding,
        "engines": checks,
        "warnings": book.warnings,
    }
    verified = ["", *_verified(checks, book.rounding)] if checks else []
    text = "\n".join([f"Written: {one_line(str(options.output))}", *verified])
    _put(options, record, lambda: text, warnings=book.warnings, quietly=True)
    return 0 if passed else 1


_LEGEND = """\
Cells: formulas. Rounded: those that differ in their last digits only. Either they pass through LN,
SIN, ASIN or a cube root and differ within the rounding of that chain, or the engine computes in
long doubles and they differ by at most {bound:.1e} of the largest number of their column, a proven
bound on our rounding."""


def _verified(checks: "Sequence[EngineCheck]", bound: float) -> Iterator[str]:
    """Yield a table of engines, their wrong cells, what the columns mean, and the outcome."""
    rows: list[tuple[str, ...]] = [("engine", "outcome", "seconds", "cells", "rounded", "wrong")]
    for check in checks:
        seconds = "" if check.seconds is None else f"{check.seconds:.2f}"
        counts = map(str, (check.cells, check.rounded, len(check.wrong)))
        rows.append((f"{check.engine} {check.version or ''}", check.outcome, seconds, *counts))
    yield from aligned(rows, right=True)
    for check in checks:
        wrong = [
            f"{cell.sheet}!{cell.cell}: expected {cell.expected!r}, found {cell.found!r}"
            for cell in check.wrong
        ]
        if len(wrong) > 5:  # the JSON has them all
            wrong[5:] = [f"and {len(wrong) - 5} more"]
        yield from (f"{check.engine}: {words}" for words in (check.reason, *wrong) if words)
    yield from ("", _LEGEND.format(bound=bound), "")
    ran = [check for check in checks if check.outcome != "missing"]
    good = sum(check.passed for check in ran)
    yield f"{good} of {len(ran)} engines on this machine give the values of the workbook"


def run_sheet(options: argparse.Namespace) -> int:
    from replication.error import warnings
    from replication.models.sheet import run

    sheet = run(_case(options), options.scheme)
    rows = [row._asdict() for row in sheet.rows] if options.json or options.csv else []
    doubts = list(warnings(sheet).values())
    record = {
        "inputs": inputs_of(sheet.impact),
        "scheme": sheet.scheme,
        "rows": rows,
        "final_depth": sheet.final_depth,
        "normalized_depth": sheet.normalized_depth,
        "steps": sheet.steps,
        "warnings": doubts,
    }

    def text() -> str:
        """Write the rows, and the results that the report reads from the last row."""
        heads = "row", "time [ns]", "initial [m/s]", "x [um]", "deceleration [m/s2]", "final [m/s]"
        rows = enumerate(sheet.rows)
        table = ((k, time * 1e9, v, x * 1e6, a, final) for k, (time, v, x, a, final) in rows)
        results = (
            f"final depth       {number(sheet.final_depth * 1e6, 8)} um\n"
            f"normalized depth  {number(sheet.normalized_depth, 8)}\n"
            f"steps             {sheet.steps}"
        )
        return "\n".join([*numbers(heads, table), "", results])

    return _put(options, record, text, rows, doubts)


def run_depth(options: argparse.Namespace) -> int:
    from replication.models.depth import normalized_depth

    case = _case(options)
    velocity, radius, *materials = case.motion.values()
    ratio = normalized_depth(velocity, *materials)
    depth = radius * ratio
    record = {
        "inputs": inputs_of(case),
        "depth": depth,
        "normalized_depth": ratio,
        "beyond_radius": ratio > 1,
    }
    text = (
        f"final depth       {number(depth * 1e6, 8)} um ({depth!r} m)\n"
        f"normalized depth  {number(ratio, 8)}\n"
        f"beyond radius     {'yes' if ratio > 1 else 'no'}"
    )
    return _put(options, record, lambda: text)


def run_history(options: argparse.Namespace) -> int:
    from replication.models.motion import history, stop_time

    case = _case(options)
    stop = stop_time(**case.motion)
    if options.times is None:
        times = [stop * (k / (options.points - 1)) for k in range(options.points)]
    else:
        times = _times(options, "times", "--points N")
    depth, velocity = [0.0] * len(times), [0.0] * len(times)
    history(times, **case.motion, depth=depth, speed=velocity)
    lists = {"time": times, "depth": depth, "velocity": velocity}
    table = list(zip(*lists.values(), strict=True))

    def text() -> str:
        heads = ("time [ns]", "x [um]", "velocity [m/s]")
        lines = numbers(heads, ((time * 1e9, x * 1e6, v) for time, x, v in table))
        return "\n".join([*lines, "", f"stop time  {number(stop * 1e9, 8)} ns"])

    record = {"inputs": inputs_of(case), **lists, "stop_time": stop}
    rows = [dict(zip(lists, row, strict=True)) for row in table] if options.csv else []
    return _put(options, record, text, rows)


def run_converge(options: argparse.Namespace) -> int:
    from replication.error.ladder import converge, ladder, step_for_digits, text

    case, scheme = _case(options), options.scheme
    if options.steps is None:
        steps = ladder(case.step, options.levels)
    else:
        steps = _times(options, "steps", "--levels N")
    record = converge(case, steps, scheme)
    record["digits"] = options.digits and step_for_digits(case, options.digits, scheme)
    warnings = (
        f"{level['step']!r} s: {doubt}" for level in record["levels"] for doubt in level["warnings"]
    )
    rows = [level | level["budget"] for level in record["levels"]]
    for row in rows:
        del row["budget"], row["warnings"]
    return _put(options, record, lambda: text(record), rows, warnings)


def run_stability(options: argparse.Namespace) -> int:
    from replication.error import hard_cases

    record = hard_cases.record(options.random, options.seed)
    return _put(options, record, lambda: hard_cases.text(record))


def run_sweep(options: argparse.Namespace) -> int:
    from replication.sweep import check_output, provenance, read_plan, write

    plan = read_plan(options.plan)
    output = options.output or Path(f"{options.plan.stem}.csv")
    check_output(output)
    if output.resolve() == options.plan.resolve():
        raise ValueError(f"{output} is the plan itself: give another -o")
    bar = _progress(options, total=plan.count, unit=" cases", unit_scale=True)
    with bar, place(str(options.plan)):
        write(plan, output, done=bar.update)
    record = {"file": str(output), "cases": plan.count, "columns": plan.columns}
    text = f"Written: {one_line(str(output))} ({plan.count} cases)"
    return _put(options, record | provenance(plan), lambda: text, quietly=True)


def run_bench(options: argparse.Namespace) -> int:
    from replication.bench.measure import CASES, bench
    from replication.bench.show import texts, write
    from spreadsheets.safely import check_folder

    names = list(dict.fromkeys(options.case or (["beta-5"] if options.quick else CASES)))
    if options.out is not None:
        check_folder(options.out, ["bench.txt"])
    repeat, limit = (1, 1.0) if options.quick else (7, 5.0)
    if options.limit is not None:
        with place("--limit"):
            limit = read_number(options.limit, "s")
    # None shows the progress bar on a terminal only.
    record = bench(names, options.repeat or repeat, limit, quiet=options.quiet or None)
    if options.out is not None:
        write(options.out, record)
    form = "json" if options.json else "csv" if options.csv else "txt"
    sys.stdout.write(texts(record)[f"bench.{form}"])
    return 0


def run_check(options: argparse.Namespace) -> int:
    """Check a workbook and print the differences; status 1 if it is not the report's sheet."""
    _check_files(options, options.file)
    from replication.check import show
    from replication.check.examination import KINDS
    from replication.check.workbook import check

    mapping = {}
    for text in options.map:
        name, _, where = text.partition("=")
        if not where:
            raise ValueError(f"--map {text[:60]!r}: give NAME=RANGE, such as depth=D8:D139")
        name = name.strip().replace("-", "_")
        if name in mapping:
            raise ValueError(f"--map {name[:40]}: it is given twice")
        mapping[name] = where.strip()
    checked = check(options.file, mapping)
    record = show.check_record(checked)
    page = partial(show.html, record, checked.differences, checked.calculation)
    return _put_found(options, record, show.text, page, partial(show.junit, kinds=KINDS))


def run_diff(options: argparse.Namespace) -> int:
    """Compare two workbooks and print the differences; status 1 if there are any."""
    _check_files(options, options.first, options.second)
    from replication.check import diff_show as show
    from replication.check.diff import KINDS, Tolerance, diff

    allowed = Tolerance(options.ulp, options.relative, options.digits)
    both = options.first, options.second
    compared = diff(*both, values_only=options.values_only, allowed=allowed)
    record = show.diff_record(compared)
    page = partial(show.html, record, compared.differences, compared.after)
    return _put_found(options, record, show.text, page, partial(show.junit, kinds=KINDS))


def _check_files(options: argparse.Namespace, *workbooks: Path) -> None:
    """Raise OSError or ValueError if --html or --junit names a file that must not be written."""
    from spreadsheets.safely import check_own, check_target

    marks = (
        (options.html, b'<meta name="generator" content="coldspray '),
        (options.junit, b'<testsuite name="coldspray '),
    )
    written = [str(check_target(file)) for file, _ in marks if file is not None]
    read = {os.path.realpath(file) for file in workbooks}  # unlike resolve(), no error for a loop
    if len({*written, *read}) < len(written) + len(read):
        raise ValueError("--html and --junit each need a file of their own, not one that is read")
    for file, mark in marks:
        if file is not None:
            check_own(file, mark)


def _put_found(
    options: argparse.Namespace,
    record: dict[str, Any],
    text: Callable[[Mapping[str, Any]], str],
    page: Callable[[], str],
    junit: Callable[[Mapping[str, Any]], str],
) -> int:
    """Write the files asked for, print the record as JSON or text, and return the exit status."""
    from spreadsheets.safely import write_bytes

    if options.html is not None:
        write_bytes(options.html, page().encode())
    if options.junit is not None:
        write_bytes(options.junit, junit(record).encode())
    _put(options, record, lambda: text(record), quietly=True)
    return 0 if record["clean"] else 1


# Shared by several commands


def _case(options: argparse.Namespace) -> Impact:
    values = {name: getattr(options, name) for name in INPUTS}
    given = {name: value for name, value in values.items() if value is not None}
    name = "beta-5" if options.case is None else options.case
    return read_case(name, options.case_file, given)


def _times(options: argparse.Namespace, name: str, counted_by: str) -> list[float]:
    """Read the times [s] that an option lists, such as "0 ns,5 ns".

    There may be as many as the option `counted_by`, which gives only their number, allows.
    """
    texts, values = [time.strip() for time in getattr(options, name).split(",")], []
    most = COMMANDS[options.command][counted_by]["within"][1]
    if len(texts) > most:
        raise ValueError(f"--{name}: give at most {most:,} values, not {len(texts):,}")
    for position, time in enumerate(texts, 1):
        with place(f"--{name}, value {position}"):
            values.append(read_number(time, "s"))
            if not 0 <= values[-1] <= 1e250:
                raise ValueError(f"{quoted(time)} is not between 0 and 1e250 s")
    return values


def _put(
    options: argparse.Namespace,
    record: Any,
    text: Callable[[], str],
    rows: Sequence[Mapping[str, Any]] = (),
    warnings: Iterable[object] = (),
    quietly: bool = False,
) -> int:
    """Print a command's result as JSON, rows of CSV or text, as asked for, and return status 0.

    Warnings go to standard error, unless `--quiet` is given; for JSON the record contains them.
    quietly: the text only reports what was done, so `--quiet` suppresses it, too.
    """
    if options.json:
        _put_json(json_text(record))
        return 0
    if "csv" in options and options.csv:
        sys.stdout.write(rows_csv(rows))
    elif not (quietly and options.quiet):
        print(text())
    for warning in () if options.quiet else warnings:
        print(one_line(f"coldspray {options.command}: warning: {warning}"), file=sys.stderr)
    return 0


def _put_json(text: str) -> None:
    """Print JSON. It is read as UTF-8, so for any other encoding of stdout use only ASCII."""
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    if codecs.lookup(encoding).name != "utf-8":
        text = re.sub("[^\\x00-\\x7f]", lambda match: json.dumps(match[0])[1:-1], text)
    sys.stdout.write(text)


def _width(piped: int = 80) -> int:
    """Return the number of columns of the terminal, or `piped` if stdout is not a terminal."""
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else piped


def _may_emphasize() -> bool:
    """Return whether bold text may be printed: on a capable terminal, without NO_COLOR."""
    is_capable = sys.stdout.isatty() and os.environ.get("TERM") != "dumb"
    return is_capable and not os.environ.get("NO_COLOR")


def _progress(options: argparse.Namespace, items: Any = None, **settings: Any) -> Any:
    """Return a progress bar, which shows nothing if quiet or without a terminal."""
    from tqdm import tqdm

    return tqdm(items, **settings, disable=options.quiet or None)  # None: unless on a terminal
