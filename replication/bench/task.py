"""`Task`: one thing to time."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

__all__ = ["MEASURES", "Measure", "Task"]

Measure = Literal["depth", "history"]
MEASURES: tuple[Measure, ...] = ("depth", "history")


@dataclass(frozen=True, slots=True)
class Task:
    """A method at a setting: what to time, and how far off its answer is.

    `measure` is "depth" (relative error of the final depth) or "history" (worst error of the depth
    at the case's times, relative to the final one); `error` turns what `run` returns into it. A run
    does `cases` cases at once.
    """

    method: str
    setting: str
    measure: Measure
    run: Callable[[], Any]
    error: Callable[[Any], float]
    cases: int = 1
