"""Work beside this process: the same results and errors, whether there is a second core or not."""

import os
import signal

import pytest

from replication.processes import second_process


@pytest.fixture(params=[1, 2], ids=["one core", "two cores"])
def cores(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> int:
    monkeypatch.setattr(os, "cpu_count", lambda: request.param)
    return request.param


def test_a_second_process_only_where_there_is_a_core_for_it(cores: int) -> None:
    with second_process() as start:
        number, again = start(os.getpid), start(os.getpid)
        assert number() == again()
        assert (number() == os.getpid()) is (cores == 1)


@pytest.mark.usefixtures("cores")
def test_its_errors_are_raised_where_the_result_is_asked_for() -> None:
    with second_process() as start:
        wrong = start(int, "seven")
        with pytest.raises(ValueError, match="seven"):
            wrong()


def test_a_process_killed_from_outside_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    with (
        pytest.raises(ChildProcessError, match="killed from outside"),
        second_process() as start,
    ):
        start(signal.raise_signal, signal.SIGKILL)()
