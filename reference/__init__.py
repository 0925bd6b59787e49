"""The reference: the report's printed numbers, and its equations in any precision.

`report/` has the report's text and, as TOML tables, everything that is recorded about it: each
printed number and equation (`ledger.toml`), and public sources (`sources.toml`). `ledger.py` reads
them. `printed.py` gives the interval of the values that print as a number. `equations.py` reads the
equations. `computations.py` computes claims from them in any arithmetic of `arithmetic.py`,
`derivations.py` checks that they follow from their premises. `enclosure.py` proves bounds over
ranges of inputs with the interval arithmetic of `intervals.py`, and `motion.py` computes the exact
motion. Verdicts and explanations follow in `replication/audit`: `verdict.py` and `explain.py`.
"""
