"""How far each topic of the loop is recorded, and whether a message is the next one."""

from array import array
from collections.abc import Sequence
from itertools import pairwise

from fpt_ros.cycle.matcher import under_way
from fpt_ros.errors import RunFailed
from fpt_ros.messages.frames import SECOND
from fpt_ros.messages.topics import DEPTH


class RecordedCycles:
    """Message k of every loop topic carries the same stamp, or the recording is not complete.

    In real time that of the first topic, the plant's own, is of every cycle; others may miss one.

    Attributes:
        stamps: of the cycles [ns].
        counts: messages of each topic.
    """

    def __init__(self, lockstep: bool, before: Sequence[Sequence[int]]) -> None:
        """``before``: stamps of the messages of each topic that are recorded already."""
        self._lockstep = lockstep
        self.counts = [len(each) for each in before]
        self.stamps = array("q", max(before, key=len) if lockstep else before[0])
        self._latest = [dict.fromkeys(each[-DEPTH:]) for each in before]

    def is_next(self, index: int, stamp: int, name: str) -> bool:
        """Take a message of a topic, by its stamp [ns]; false: it is not one of this run, or known.

        Raises:
            RunFailed: one in front of it is missing.
        """
        stamps, count = self.stamps, self.counts[index]
        if self._lockstep:
            if count and stamp <= stamps[count - 1]:
                return False  # not of this run: a second plant that is about to give up
            if count == 0 and stamp > 0:
                raise under_way(stamp)
            if count == len(stamps):
                stamps.append(stamp)
            elif stamps[count] != stamp:
                raise RunFailed(
                    f"the recording is not complete: message {count} of {name} has the stamp "
                    f"{stamp / SECOND:.9g} s, {stamps[count] / SECOND:.9g} s was due"
                )
        else:
            latest = self._latest[index]
            if stamp in latest:
                return False  # a node that was started again has its history published again
            latest[stamp] = None
            if len(latest) > DEPTH:
                del latest[next(iter(latest))]
            if index == 0:
                stamps.append(stamp)
        self.counts[index] = count + 1
        return True

    def is_unexpected(self, index: int, stamp: int) -> bool:
        """Whether this is not the stamp that follows, so that the bytes may be anything."""
        stamps, count = self.stamps, self.counts[index]
        if count < len(stamps):
            return stamps[count] != stamp
        return len(stamps) < 2 or stamp - stamps[-1] != stamps[-1] - stamps[-2]

    @property
    def done(self) -> int:
        """Cycles recorded: of all topics in lockstep; in real time some answers may be missing."""
        return min(self.counts) if self._lockstep else len(self.stamps)

    @property
    def is_within_a_cycle(self) -> bool:
        """In lockstep: whether some topics have gone further than others."""
        return self._lockstep and len(set(self.counts)) > 1

    def saw_the_end(self, cycles: int) -> bool:
        """In real time: whether the last cycle has come, whatever is missing before it."""
        stamps = self.stamps
        if self._lockstep or not 2 <= len(stamps) < cycles:
            return False
        shortest = min(b - a for a, b in pairwise(stamps))
        return stamps[-1] - stamps[0] >= (cycles - 1) * shortest > 0
