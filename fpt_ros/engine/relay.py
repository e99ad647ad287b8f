"""Giving chunks of a run to those who take them, beside the cycles that follow."""

from collections.abc import Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor

from fpt_ros.runs.chunks import Consumer
from fpt_ros.runs.run import Series


class Relay:
    """Gives chunks to consumers, one after the other.

    ``beside``: in a thread of its own, while the engine, which holds no lock of Python's, goes on
    with other buffers. At most one chunk is under way: whoever gives the next one waits for it.
    """

    def __init__(self, consumers: Sequence[Consumer], beside: bool) -> None:
        self._consumers = consumers
        self._pool = ThreadPoolExecutor(1, "consumers") if beside and consumers else None
        self._last: Future[None] | None = None

    def give(self, chunk: Mapping[str, Series]) -> None:
        """Give a chunk; what a consumer raised for the one before is raised here."""
        self.wait()
        if self._pool is None:
            self._take(chunk)
        else:
            self._last = self._pool.submit(self._take, chunk)

    def wait(self) -> None:
        """Until all that was given has been taken."""
        last, self._last = self._last, None
        if last is not None:
            last.result()

    def _take(self, chunk: Mapping[str, Series]) -> None:
        for consumer in self._consumers:
            consumer.take(chunk)
