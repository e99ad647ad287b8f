"""Giving chunks of a run to those who take them, beside the cycles that follow."""

from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor

from fpt_ros.runs.chunks import Chunk, Consumer


class Relay:
    """Gives chunks to consumers, one after the other.

    ``beside``: in a thread of its own, while the engine, which holds no lock of Python's, goes on
    with other buffers. At most one chunk is under way: whoever gives the next one waits for it.
    """

    def __init__(self, consumers: Sequence[Consumer], beside: bool) -> None:
        self._consumers = consumers
        self._pool = ThreadPoolExecutor(1, "consumers") if beside and consumers else None
        self._last: Future[None] | None = None

    def give(self, make: Callable[[], Chunk]) -> None:
        """Give a chunk, made where it is taken; what the one before raised is raised here."""
        self.wait()
        if self._pool is not None:
            self._last = self._pool.submit(self._take, make)
        elif self._consumers:
            self._take(make)

    def wait(self) -> None:
        """Until all that was given has been taken."""
        last, self._last = self._last, None
        if last is not None:
            last.result()

    def _take(self, make: Callable[[], Chunk]) -> None:
        chunk = make()
        for consumer in self._consumers:
            consumer.take(chunk)
