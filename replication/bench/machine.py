"""The machine that the times come from."""

import os
import platform
from importlib.metadata import version
from pathlib import Path

__all__ = ["machine"]

LIBRARIES = ("coldspray", "numpy", "scipy", "mpmath")


def machine() -> dict[str, str | int | None]:
    """Processor, number of cores, system, and the versions of Python and the libraries."""
    return {
        "processor": _processor(),
        "cores": os.cpu_count(),
        "system": f"{platform.system()} {platform.machine()}",
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        **{name: version(name) for name in LIBRARIES},
    }


def _processor() -> str:
    """Its model name, which Linux tells only in a file of its own."""
    file = Path("/proc/cpuinfo")
    lines = file.read_text("utf-8").splitlines() if file.exists() else []
    models = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(models, platform.processor() or platform.machine())
