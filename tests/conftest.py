"""Settings, and the audit that all tests share."""

import gc

import pytest
from hypothesis import settings

from reference.ledger import load
from replication.audit.audit import Audit
from replication.audit.record import Record

# No deadline: a test must not depend on the speed of the machine.
settings.register_profile("unhurried", deadline=None, max_examples=50)
# Chosen by `pytest --hypothesis-profile thorough`.
settings.register_profile("thorough", deadline=None, max_examples=2000, derandomize=True)
settings.load_profile("unhurried")


def pytest_collection_finish() -> None:
    """Let the garbage collector pass over the thousands of tests and libraries in memory."""
    gc.freeze()
    gc.set_threshold(50_000, 20, 10)


@pytest.fixture(scope="session")
def audit() -> Audit:
    """The audit of the report, which keeps what it has judged; one for each worker."""
    return Audit(load())


@pytest.fixture(scope="session")
def record(audit: Audit) -> Record:
    """The record of the audit."""
    return audit.record()
