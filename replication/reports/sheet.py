"""The sheet of a case as `coldspray sheet` prints it for a person."""

from replication.models.sheet import Row, Sheet
from replication.text import number

__all__ = ["sheet_table"]

_HEADS = ("row", "time [ns]", "initial [m/s]", "x [um]", "deceleration [m/s2]", "final [m/s]")


def sheet_table(sheet: Sheet) -> str:
    """The sheet's rows, then what the report reads off the last."""
    lines = ["".join(f"{head:>21}" if i else f"{head:>5}" for i, head in enumerate(_HEADS))]
    lines += [_sheet_row(k, row) for k, row in enumerate(sheet.rows)]
    lines += [
        "",
        f"final depth       {number(sheet.final_depth * 1e6, 8)} um",
        f"normalized depth  {number(sheet.normalized_depth, 8)}",
        f"steps             {sheet.steps}",
    ]
    return "\n".join(lines)


def _sheet_row(k: int, row: Row) -> str:
    final = "" if row.velocity_final is None else number(row.velocity_final, 9)
    values = (row.time * 1e9, row.velocity_initial, row.depth * 1e6, row.deceleration)
    return f"{k:>5}" + "".join(f"{number(v, 9):>21}" for v in values) + f"{final:>21}"
