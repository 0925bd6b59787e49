"""Make the pages of the public interface from its docstrings: python docs/api.py FOLDER.

Needs pdoc: pip install '.[docs]'. The examples on the pages are run by the tests.
"""

import sys
from pathlib import Path

import pdoc

import replication

# Public names are loaded when they are first used; pdoc shows only what is loaded.
for name in replication.__all__:
    setattr(replication, name, getattr(replication, name))
pdoc.pdoc("replication", "reference", "spreadsheets", output_directory=Path(sys.argv[1]))
