"""The audit: a verdict with its proof for every number that the report prints.

`replication.audit` names a function to users, and this package: so it can be called.

>>> from replication import audit
>>> print(audit().claim("depth-beta-5").verdict)
reproduced
"""

import sys
from types import ModuleType
from typing import Any


class _Callable(ModuleType):
    def __call__(self, *arguments: Any, **options: Any) -> Any:
        from replication.audit.audit import audit

        return audit(*arguments, **options)


sys.modules[__name__].__class__ = _Callable
