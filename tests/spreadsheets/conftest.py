"""The engines, as fixtures: ``engine`` runs a test once for each, ``usable`` gives one by name."""

from __future__ import annotations

import os
from collections.abc import Callable

import pytest

from spreadsheets import engines
from spreadsheets.engines import Engine

FROM_PIP = ("ironcalc", "formualizer")
"""Required for the tests, so a missing one fails; the others come from the system."""


@pytest.fixture(scope="session")
def usable() -> Callable[[str], Engine]:
    """Return a function that gives an engine, or skips or fails the test when it is missing."""

    def find(name: str) -> Engine:
        found = engines.engine(name)
        reason = found.missing()
        if reason is None:
            return found
        if name in FROM_PIP or os.environ.get("COLDSPRAY_REQUIRE_ENGINES") == "1":
            pytest.fail(reason)
        pytest.skip(reason)

    return find


@pytest.fixture(scope="session", params=[engine.name for engine in engines.ENGINES])
def engine(request: pytest.FixtureRequest, usable: Callable[[str], Engine]) -> Engine:
    """Each engine in turn."""
    return usable(request.param)
