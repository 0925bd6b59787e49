"""The audit: a verdict with its proof for every number that the report prints.

The package can itself be called: `audit()` returns the finished audit as a `Record`, with all
claims and their verdicts, the findings and the tables. It writes no files.

>>> from replication import audit
>>> print(audit().claim("depth-beta-5").verdict)
reproduced
"""

import sys
from importlib import import_module
from types import ModuleType
from typing import Any


class _Callable(ModuleType):
    """The package as a function, which pickle finds by its name like any other module."""

    def __call__(self, *arguments: Any, **options: Any) -> Any:
        from replication.audit.audit import audit

        return audit(*arguments, **options)

    def __reduce__(self) -> tuple[Any, ...]:
        return import_module, (__name__,)


sys.modules[__name__].__class__ = _Callable
