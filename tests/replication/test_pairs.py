"""`coldspray diff`: two workbooks, of which the second was made from the first by known changes."""

import json
from pathlib import Path

import pytest
from foreign.pairs import PAIRS, Pair
from running import coldspray


@pytest.mark.parametrize("pair", PAIRS, ids=lambda pair: pair.title)
def test_the_first_difference_is_where_something_was_changed(pair: Pair, tmp_path: Path) -> None:
    paths = pair.written(tmp_path)
    status, out, err = coldspray("diff", *paths, *pair.options, "--json")
    assert (status, err) == (pair.status, "")
    first = json.loads(out)["first"] or {}
    # What is within a tolerance may still change what follows from it.
    if first.get("kind") in ("formula", "value") and not pair.options and pair.changed:
        assert f"{first['sheet']}!{first['cell']}" in pair.changed
