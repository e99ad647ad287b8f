"""What Ctrl-C does: it raises, is collected, or ends the command at once."""

import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

INTERRUPTED = 130
"""Exit status."""


def complain(message: str, status: int) -> int:
    """Say in one line what is wrong; the exit status that goes with it."""
    print(f"fpt: {message}", file=sys.stderr, flush=True)
    return status


@contextmanager
def collected() -> Iterator[list[int]]:
    """Collect Ctrl-C instead of raising it anywhere: the engine ends between two cycles."""
    seen: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, frame: seen.append(number))
    try:
        yield seen
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def at_once(give_up: Callable[[], None] = lambda: None) -> Iterator[None]:
    """End with Ctrl-C while modules are imported or laws compiled, which swallow exceptions.

    Args:
        give_up: what has to be put in order before.
    """

    def end(number: int, frame: object) -> None:
        give_up()
        os._exit(complain("interrupted", INTERRUPTED))

    before = signal.getsignal(signal.SIGINT)
    if before is not signal.default_int_handler:  # started in the background: it does not listen
        yield
        return
    signal.signal(signal.SIGINT, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
