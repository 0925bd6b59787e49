"""Workbooks in and out: planned cell by cell, emitted, read back, recalculated and compared."""
