"""Which messages belong to one cycle: matched by stamp alone, without ROS."""

from collections.abc import Sequence

from fpt_ros.cycle.stage import Input
from fpt_ros.errors import RunFailed
from fpt_ros.messages.frames import SECOND, Frame

RECENT = 16
"""Frames of an input that are kept in real time: answers may be late by as many cycles."""

CLOSEST = 0.25
"""Part of a cycle time that lies between two cycles at least, in real time. A robot's stamps are
never exactly of the moment of its motion; over a shorter time a velocity would show that error,
many times as large as the motion."""

WALL = 10**9 * SECOND
"""Stamps beyond it [ns] are of a clock of this century."""


class Matcher:
    """Keeps the latest frames of each input, and tells when those of a cycle are complete.

    In lockstep a cycle is complete when all inputs carry its stamp (``lag`` 1: that of the cycle
    acted on last), and :meth:`take` gives its frames. In real time the newest complete cycle
    counts, what has a lag or is optional may be absent, and :meth:`newest` gives the frames when
    the node acts. No stamp is acted on twice, in real time none closer to the last than
    ``CLOSEST``.

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
        self._waited_for = [i for i, each in enumerate(inputs) if not (each.lag or each.optional)]
        self._latest: list[Frame | None] = [None] * len(self._lags)
        self._recent: list[dict[int, Frame]] = [{} for _ in inputs]
        self._newest = acted
        self._complete: list[Frame | None] = []

    def take(self, index: int, frame: Frame) -> list[Frame | None] | None:
        """In lockstep the frames of a cycle, one per input, if this one completes it.

        Raises:
            RunFailed: the cycle is of a run in lockstep that was not seen from its beginning.
        """
        if self._realtime:
            self._keep(index, frame)
            return None
        if frame.stamp < self.acted:
            return None  # of a run that has begun later: it must not take the place of ours
        self._latest[index] = frame
        leading = self._latest[self._waited_for[0]]
        if leading is None or leading.stamp <= self.acted:
            return None
        stamp, last = leading.stamp, self.acted
        complete: list[Frame | None] = []
        for latest, lag in zip(self._latest, self._lags, strict=True):
            wanted = last if lag else stamp
            if latest is not None and latest.stamp == wanted:
                complete.append(latest)
            elif lag and last < 0:
                complete.append(None)
            else:
                return None
        due = last + self._cycle_time if last >= 0 else 0
        unknown = last >= 0 and not self._cycle_time
        if not unknown and stamp != due:
            raise under_way(stamp)
        self.acted = stamp
        return complete

    def _keep(self, index: int, frame: Frame) -> None:
        """In real time: a node that comes late for one cycle must not come late for all."""
        recent, stamp = self._recent[index], frame.stamp
        recent[stamp] = frame
        if len(recent) > RECENT:
            del recent[min(recent)]
        if stamp <= self._newest or index not in self._waited_for:
            return
        if self.acted >= 0 and stamp - self.acted < CLOSEST * self._cycle_time:
            return
        if all(stamp in self._recent[i] for i in self._waited_for):
            self._newest = stamp
            self._complete = [
                None if lag else each.get(stamp)
                for each, lag in zip(self._recent, self._lags, strict=True)
            ]

    def newest(self) -> list[Frame | None] | None:
        """In real time the frames of the newest complete cycle, which counts as acted on now.

        What has a lag is of the cycle acted on before, and of none that was left out between.
        """
        if self._newest <= self.acted:
            return None
        last, self.acted = self.acted, self._newest
        return [
            each.get(last if lag else self.acted) if frame is None else frame
            for frame, each, lag in zip(self._complete, self._recent, self._lags, strict=True)
        ]


def under_way(stamp: int) -> RunFailed:
    """For who comes to a run in lockstep that is not at its first cycle, but at ``stamp`` [ns]."""
    if stamp > WALL:
        return RunFailed(
            f"stamps are of wall time ({stamp / SECOND:.0f} s), in lockstep they begin at 0: set "
            "realtime (and robot, where a robot tells joint_states)"
        )
    return RunFailed(
        f"a run is under way here already (t = {stamp / SECOND:g} s): use another ROS_DOMAIN_ID "
        "or --namespace"
    )
