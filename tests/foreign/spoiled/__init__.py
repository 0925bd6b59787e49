"""Changes to right workbooks, by what is changed, each with what is then true."""

from foreign.edits import Case
from foreign.spoiled import arbitrary, cells, columns, given, inputs, newcomers, rows, tables

SECTIONS: dict[str, tuple[Case, ...]] = {
    "inputs": inputs.CASES,
    "cells": cells.CASES,
    "columns": columns.CASES,
    "newcomers": newcomers.CASES,
    "rows": rows.CASES,
    "tables": tables.CASES,
    "given": given.CASES,
    "arbitrary": arbitrary.CASES,
}
