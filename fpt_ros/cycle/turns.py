"""Messages of several topics in the order of events, whichever comes first."""

from collections import deque
from collections.abc import Iterator
from typing import Generic, TypeVar

Item = TypeVar("Item")


class Turns(Generic[Item]):
    """One item of each of ``n`` topics after the other, again and again.

    An item that comes before its turn waits: DDS keeps the order of a topic, and not that of
    different ones. Example::

        turns = Turns[str](2)
        turns.add(1, "b")    # nothing
        turns.add(0, "a")    # a, b
    """

    def __init__(self, n: int, done: int = 0) -> None:
        """``done``: items of all topics that have had their turn already."""
        self._waiting: list[deque[Item]] = [deque() for _ in range(n)]
        self._turn = done % n

    def add(self, topic: int, item: Item) -> Iterator[Item]:
        """Take the next item of a topic; gives those whose turn has come."""
        self._waiting[topic].append(item)
        return self._ready()

    def _ready(self) -> Iterator[Item]:
        while self._waiting[self._turn]:
            item = self._waiting[self._turn].popleft()
            self._turn = (self._turn + 1) % len(self._waiting)
            yield item

    def rest(self) -> Iterator[Item]:
        """At the end: what still waits for an item that will not come, in the same order."""
        while any(self._waiting):
            if self._waiting[self._turn]:
                yield self._waiting[self._turn].popleft()
            self._turn = (self._turn + 1) % len(self._waiting)
