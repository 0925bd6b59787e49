"""What is known: the report's printed numbers, and its equations to any precision.

Where things are: `report/` has the report's text and, as tables, all that is said of it: every
printed number or equation (`ledger.toml`: where it stands, what computes it, the workbook's cell),
public sources (`sources.toml`) and findings (`findings.toml`). `ledger.py` and `findings.py` read
them. `printed.py` gives the interval of what prints like a number. `formulas.py` computes a claim
by the equations that `equations.py` reads, in any of the numbers of `arithmetic.py`; `enclosure.py`
proves its range over inputs in `intervals.py`. What follows from that, verdict and explanation, is
judged in `replication/audit`: `verdict.py` and `explain.py`.
"""
