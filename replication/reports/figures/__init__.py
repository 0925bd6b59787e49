"""The audit's figures, one module each: NAME, TITLE, SIZE, `describe` and `plot`, of the record.

`describe` says in words what a reader of the figure sees, with its numbers. matplotlib is loaded
where one is drawn.
"""

from types import ModuleType
from typing import Any

from replication.reports.figures import comparison, convergence, figure_3, figure_5, sensitivity
from replication.reports.figures.drawing import Drawing, drawing

__all__ = ["FIGURES", "Drawing", "draw"]

FIGURES: tuple[ModuleType, ...] = (comparison, figure_3, figure_5, sensitivity, convergence)
"""In the order of the page."""


def draw(record: dict[str, Any]) -> list[Drawing]:
    """Every figure, of what `reports.records.shown_record` gives of an audit."""
    return [drawing(module, record) for module in FIGURES]
