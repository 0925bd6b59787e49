"""The public interface of this project: the same names as `replication`, which has what they are.

`python -m coldspray` runs the command `coldspray`. Each name is imported when it is first used.

>>> import coldspray
>>> f"{coldspray.final_depth(**coldspray.BETA_5.motion) * 1e6:.2f} um"
'7.67 um'
"""

from typing import TYPE_CHECKING, Any

import replication
from replication import __all__ as _names

if TYPE_CHECKING:
    from replication import *  # noqa: F403 - the names that type checkers know

    __version__: str

__all__ = [*_names, "__version__"]


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        return version("coldspray")
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(replication, name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


if __name__ == "__main__":
    import sys

    from replication.__main__ import program

    sys.exit(program())
