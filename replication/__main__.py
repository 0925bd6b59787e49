"""The program `coldspray`, also run as `python -m replication` and `python -m coldspray`."""

import signal
import sys


def program() -> int:
    """Run the command and return its exit status; an interruption is said in one line.

    The imports take a third of a second, so that Ctrl-C may come before `main` can catch it.
    """
    try:
        from reference.signals import ENDING, postponed_signals

        with postponed_signals():  # Python may turn one that comes during an import into an error
            from replication.cli import main
        status = main()
        for number in ENDING:  # all is done and said: Python only has to end
            signal.signal(number, signal.SIG_IGN)
        return status
    except KeyboardInterrupt:
        try:
            sys.stderr.write("coldspray: interrupted; no file is left in part\n")
            sys.stderr.flush()
        except OSError:
            sys.stderr = None
        return 130


if __name__ == "__main__":
    sys.exit(program())
