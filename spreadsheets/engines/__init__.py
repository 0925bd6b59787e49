"""Real spreadsheet engines, all behind one small interface.

    engine("ironcalc").recalculate(Path("workbook.xlsx"))["Sheet1"]["B7"]

An engine opens a workbook, computes every formula again and gives the values by sheet and address;
``Recalculated`` says how each kind of value comes back. Two engines come with pip (IronCalc and
formualizer), two from the system (LibreOffice and Gnumeric). The libraries behind them are imported
only when an engine is used.
"""

from spreadsheets.engines.base import Engine, EngineError, Recalculated, repairs_wrong_value
from spreadsheets.engines.formualizer import Formualizer
from spreadsheets.engines.gnumeric import Gnumeric
from spreadsheets.engines.ironcalc import IronCalc
from spreadsheets.engines.libreoffice import LibreOffice

__all__ = ["ENGINES", "Engine", "EngineError", "Recalculated", "engine", "repairs_wrong_value"]

ENGINES: tuple[Engine, ...] = (IronCalc(), Formualizer(), LibreOffice(), Gnumeric())


def engine(name: str) -> Engine:
    """Return the engine of that name; an unknown name is an EngineError."""
    for candidate in ENGINES:
        if candidate.name == name:
            return candidate
    known = ", ".join(candidate.name for candidate in ENGINES)
    raise EngineError(name, f"no such engine; known are {known}")
