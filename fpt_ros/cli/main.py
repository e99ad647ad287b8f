"""The console script. Exit status: 2 bad input, 1 a failed run, 130 Ctrl-C."""

import gc
import signal
import sys

from fpt_ros.cli.interrupts import INTERRUPTED, at_once, complain


def main() -> None:
    """Run a command and exit."""
    gc.set_threshold(100_000)  # a start makes many objects and no garbage: 0.2 s of it
    try:
        with at_once():
            from fpt_ros.cli.app import run_command  # takes 0.2 s
        status = run_command(sys.argv[1:])
    except KeyboardInterrupt:
        status = complain("interrupted", INTERRUPTED)
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # no traceback of what is being taken down
    gc.freeze()  # else Python looks through all that NumPy, SciPy and numba hold to end: 0.4 s
    sys.exit(status)


if __name__ == "__main__":
    main()
