"""Settings, and the audit that all tests share."""

import pytest
from hypothesis import settings

from reference.ledger import load
from replication.audit.audit import Audit
from replication.audit.record import Record

# No deadline: a test must not depend on the speed of the machine.
settings.register_profile("unhurried", deadline=None)
# Chosen by `pytest --hypothesis-profile thorough`.
settings.register_profile("thorough", deadline=None, max_examples=2000, derandomize=True)
settings.load_profile("unhurried")


@pytest.fixture(scope="session")
def audit() -> Audit:
    """The audit of the report, which keeps what it has judged; one for each worker."""
    return Audit(load())


@pytest.fixture(scope="session")
def record(audit: Audit) -> Record:
    """The record of the audit."""
    return audit.record()
