"""Make pages of the public interface from its docstrings: python docs/api.py FOLDER.

This needs pdoc: pip install '.[docs]'. The tests run the examples on the pages.
"""

import sys
from pathlib import Path

import pdoc

import replication

# pdoc shows only names that are loaded, and these are loaded when they are first used.
for name in replication.__all__:
    setattr(replication, name, getattr(replication, name))
pdoc.pdoc("replication", "reference", "spreadsheets", output_directory=Path(sys.argv[1]))
