"""Run the code of a notebook in this process, and write its outputs: `python tests/notebook.py`.

A Jupyter kernel would be a second process with sockets, ports and an event loop of its own: slow to
start, and not on every machine. What the tour needs of it are some lines: run a cell, show what
its last line gives, keep what it prints.
"""

import ast
import base64
import io
import json
from code import InteractiveInterpreter
from collections.abc import Iterator
from contextlib import chdir, redirect_stdout
from pathlib import Path
from typing import Any
from unittest.mock import patch

Output = dict[str, Any]

TOUR = Path(__file__).parent.parent / "docs" / "tour.ipynb"


def executed(path: Path) -> Iterator[tuple[dict[str, Any], list[Output], Any]]:
    """Yield each cell of code, its outputs as a notebook stores them, and the value of its end."""
    names: dict[str, Any] = {"__name__": "__main__"}
    with chdir(path.parent):
        for cell in json.loads(path.read_text("utf-8"))["cells"]:
            if cell["cell_type"] == "code":
                printed, value = _run("".join(cell["source"]), names)
                outputs: list[Output] = []
                if printed:
                    lines = printed.splitlines(keepends=True)
                    outputs.append({"name": "stdout", "output_type": "stream", "text": lines})
                if value is not None:
                    outputs.append(_shown(value))
                yield cell, outputs, value


def _run(source: str, names: dict[str, Any]) -> tuple[str, Any]:
    """Run a cell; return what it prints, and the value of its last line, as a prompt shows it."""
    *body, last = ast.parse(source).body
    shown: list[Any] = [None]
    interpreter = _Interpreter(names)
    with redirect_stdout(io.StringIO()) as printed, patch("sys.displayhook", shown.append):
        interpreter.runcode(compile(ast.Module(body, []), "cell", "exec"))
        interpreter.runcode(compile(ast.Interactive([last]), "cell", "single"))
    return printed.getvalue(), shown[-1]


class _Interpreter(InteractiveInterpreter):
    """Python's own, except that an error in a cell is raised, not printed."""

    def showtraceback(self) -> None:
        raise


def _shown(value: Any) -> Output:
    """Return the output for a value: a figure as PNG, others as text and, if they have it, HTML."""
    from matplotlib.figure import Figure

    data: dict[str, Any] = {"text/plain": repr(value).splitlines(keepends=True)}
    if isinstance(value, Figure):
        file = io.BytesIO()
        value.savefig(file, format="png", dpi=72, bbox_inches="tight")
        data["image/png"] = base64.b64encode(file.getvalue()).decode() + "\n"
    elif hasattr(value, "_repr_html_"):
        data["text/html"] = value._repr_html_().splitlines(keepends=True)
    return {"data": data, "metadata": {}, "output_type": "display_data"}


def renew(path: Path) -> None:
    """Write the outputs of a notebook into it."""
    notebook, outputs = json.loads(path.read_text("utf-8")), executed(path)
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            _, cell["outputs"], _ = next(outputs)
    text = json.dumps(notebook, indent=1, ensure_ascii=False)
    path.write_text(f"{text}\n", "utf-8")


if __name__ == "__main__":
    import matplotlib as mpl

    mpl.use("agg")
    renew(TOUR)
