"""Sweeps: many cases by a plan from a TOML file, computed in blocks, written as CSV or Parquet."""

from replication.sweep.output import write
from replication.sweep.plan import Plan, compute
from replication.sweep.read import read_plan

__all__ = ["Plan", "compute", "read_plan", "write"]
