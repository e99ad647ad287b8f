"""How far each topic of the loop is recorded, and whether a message is the next one."""

from collections import deque
from collections.abc import Sequence
from itertools import pairwise

from fpt_ros.cycle.matcher import under_way
from fpt_ros.errors import RunFailed
from fpt_ros.messages.frames import SECOND
from fpt_ros.messages.topics import DEPTH

MOST = 4 * DEPTH
"""Stamps that are kept before those are forgotten that no topic needs: a run may last for days."""


class RecordedCycles:
    """Message k of every loop topic carries the same stamp, or the recording is not complete.

    In real time that of the first topic, the plant's own, is of every cycle; others may miss one.

    Attributes:
        cycles: that have begun.
        newest: stamp of the newest one [ns]; 0 before the first.
        counts: messages of each topic.
    """

    def __init__(self, lockstep: bool, before: Sequence[Sequence[int]]) -> None:
        """``before``: stamps of the messages of each topic that are recorded already."""
        self._lockstep = lockstep
        self.counts = [len(each) for each in before]
        self._latest = [dict.fromkeys(each[-DEPTH:]) for each in before]
        stamps = max(before, key=len) if lockstep else before[0]
        self.cycles, self._first = len(stamps), stamps[0] if stamps else 0
        self.newest = stamps[-1] if stamps else 0
        self._shortest = min((b - a for a, b in pairwise(stamps)), default=0)
        self._kept = deque(stamps[max(0, self.done - 2) :] if lockstep else stamps[-DEPTH:])

    def is_next(self, index: int, stamp: int, name: str) -> bool:
        """Take a message of a topic, by its stamp [ns]; false: it is not one of this run, or known.

        Raises:
            RunFailed: one in front of it is missing.
        """
        count = self.counts[index]
        if self._lockstep:
            if count and stamp <= self._of(count - 1):
                return False  # not of this run: a second plant that is about to give up
            if count == 0 and stamp > 0:
                raise under_way(stamp)
            if count == self.cycles:
                self._begin(stamp)
            elif self._of(count) != stamp:
                raise RunFailed(
                    f"the recording is not complete: message {count} of {name} has the stamp "
                    f"{stamp / SECOND:.9g} s, {self._of(count) / SECOND:.9g} s was due"
                )
        else:
            latest = self._latest[index]
            if stamp in latest:
                return False  # a node that was started again has its history published again
            latest[stamp] = None
            if len(latest) > DEPTH:
                del latest[next(iter(latest))]
            if index == 0:
                self._begin(stamp)
        self.counts[index] = count + 1
        return True

    def _begin(self, stamp: int) -> None:
        """A cycle more."""
        if self.cycles:
            gap = stamp - self.newest
            self._shortest = min(gap, self._shortest) if self.cycles > 1 else gap
        else:
            self._first = stamp
        self.newest = stamp
        self.cycles += 1
        self._kept.append(stamp)
        if len(self._kept) > MOST:
            needed = self.cycles - self.done + 2 if self._lockstep else DEPTH
            while len(self._kept) > needed:
                self._kept.popleft()

    def _of(self, cycle: int) -> int:
        """Its stamp; -1: it is forgotten."""
        at = cycle - (self.cycles - len(self._kept))
        return self._kept[at] if at >= 0 else -1

    def is_unexpected(self, index: int, stamp: int) -> bool:
        """Whether this is not the stamp that follows, so that the bytes may be anything."""
        count = self.counts[index]
        if count < self.cycles:
            return self._of(count) != stamp
        return self.cycles < 2 or stamp - self.newest != self.newest - self._of(self.cycles - 2)

    @property
    def done(self) -> int:
        """Cycles recorded: of all topics in lockstep; in real time some answers may be missing."""
        return min(self.counts) if self._lockstep else self.cycles

    @property
    def until(self) -> int:
        """Stamp of the last of these [ns]."""
        return self._of(self.done - 1)

    @property
    def is_within_a_cycle(self) -> bool:
        """In lockstep: whether some topics have gone further than others."""
        return self._lockstep and len(set(self.counts)) > 1

    def saw_the_end(self, cycles: int) -> bool:
        """In real time: whether the last cycle has come, whatever is missing before it."""
        if self._lockstep or not 2 <= self.cycles < cycles:
            return False
        return self.newest - self._first >= (cycles - 1) * self._shortest > 0
