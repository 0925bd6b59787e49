"""What all tests share."""

from collections.abc import Callable

import pytest
from hypothesis import settings

from replication.audit.audit import audit
from replication.audit.record import Record
from replication.cli import main

# No test may depend on how fast the machine is.
settings.register_profile("unhurried", deadline=None)
# Chosen by `pytest --hypothesis-profile thorough`.
settings.register_profile("thorough", deadline=None, max_examples=2000, derandomize=True)
settings.load_profile("unhurried")


@pytest.fixture(scope="session")
def record() -> Record:
    """The audit of the report."""
    return audit()


@pytest.fixture
def coldspray(capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str, str]]:
    """Run the command in this process: status, standard output, standard error."""

    def run(*arguments: object) -> tuple[int, str, str]:
        try:
            status = main([str(argument) for argument in arguments])
        except SystemExit as done:
            status = int(str(done.code))
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return run
