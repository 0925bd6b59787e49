"""The motion without time steps: Eq. 13 separated and integrated once, over arrays of cases.

All arguments broadcast. Scalars give a scalar, NumPy arrays an array, pandas Series one matched
by label, xarray and dask arrays the like, lazily if they are lazy. Work goes in blocks that fit
the cache. Bad elements raise a ValueError that names the first by its index, or its label in a
Series (in its chunk, where a dask array is computed). What the formulas form of the inputs must
stay between 1e-250 and 1e250, as for an `Impact`.
"""

from replication.closed_form.depth import (
    depth_at_velocity,
    final_depth,
    normalized_depth,
    velocity_at_depth,
)
from replication.closed_form.history import history
from replication.closed_form.time import stop_time, time_to_depth

__all__ = [
    "depth_at_velocity",
    "final_depth",
    "history",
    "normalized_depth",
    "stop_time",
    "time_to_depth",
    "velocity_at_depth",
]
