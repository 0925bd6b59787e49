"""Settings and a fixture shared by all tests."""

import pytest
from hypothesis import settings

from replication.audit.audit import audit
from replication.audit.record import Record

# No deadline: a test must not depend on the speed of the machine.
settings.register_profile("unhurried", deadline=None)
# Chosen by `pytest --hypothesis-profile thorough`.
settings.register_profile("thorough", deadline=None, max_examples=2000, derandomize=True)
settings.load_profile("unhurried")


@pytest.fixture(scope="session")
def record() -> Record:
    """The audit of the report."""
    return audit()
