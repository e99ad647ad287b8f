"""Which messages belong to one cycle: matched by stamp alone, without ROS."""

from collections.abc import Sequence

from fpt_ros.cycle.stage import Input
from fpt_ros.errors import RunFailed
from fpt_ros.messages.frames import SECOND, Frame


class Matcher:
    """Keeps the latest frame of each input, and tells when those of a cycle are complete.

    In lockstep a cycle is complete when all inputs carry its stamp (``lag`` 1: that of the cycle
    acted on last). In real time the newest cycle counts, and what has a lag may be absent. No stamp
    is acted on twice.

    Attributes:
        acted: stamp of the cycle acted on last [ns], -1 before the first.
    """

    def __init__(
        self, inputs: Sequence[Input], cycle_time: int = 0, realtime: bool = False, acted: int = -1
    ) -> None:
        """``cycle_time`` [ns], by which messages of another run are known; 0: not known."""
        self.acted = acted
        self._cycle_time = cycle_time
        self._realtime = realtime
        self._lags = tuple(each.lag for each in inputs)
        self._leading = self._lags.index(0) if 0 in self._lags else 0
        self._latest: list[Frame | None] = [None] * len(self._lags)

    def take(self, index: int, frame: Frame) -> list[Frame | None] | None:
        """The frames of a cycle, one per input, if this one completes it; else ``None``.

        Raises:
            RunFailed: the cycle is of a run in lockstep that was not seen from its beginning.
        """
        if frame.stamp < self.acted and not self._realtime:
            return None  # of a run that has begun later: it must not take the place of ours
        self._latest[index] = frame
        leading = self._latest[self._leading]
        if leading is None or leading.stamp <= self.acted:
            return None
        stamp, last = leading.stamp, self.acted
        complete: list[Frame | None] = []
        for latest, lag in zip(self._latest, self._lags, strict=True):
            wanted = last if lag else stamp
            if latest is not None and latest.stamp == wanted:
                complete.append(latest)
            elif lag and (last < 0 or self._realtime):
                complete.append(None)
            else:
                return None
        due = last + self._cycle_time if last >= 0 else 0
        unknown = last >= 0 and not self._cycle_time
        if not (self._realtime or unknown) and stamp != due:
            raise under_way(stamp)
        self.acted = stamp
        return complete


def under_way(stamp: int) -> RunFailed:
    """For who comes to a run in lockstep that is not at its first cycle, but at ``stamp`` [ns]."""
    return RunFailed(
        f"a run is under way here already (t = {stamp / SECOND:g} s): use another ROS_DOMAIN_ID "
        "or --namespace"
    )
