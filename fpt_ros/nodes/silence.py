"""The newest measurement of a deformer that may have to hold a position by that alone."""

import math
from time import monotonic

from fpt_ros.messages.frames import SECOND, JointStates


class Measured:
    """The newest measurement, with a velocity: measured, or the difference of the last two."""

    def __init__(self) -> None:
        self._newest: JointStates | None = None
        self._came = 0.0

    def take(self, frame: JointStates) -> None:
        """A message has come."""
        before = self._newest
        if before is not None and 0 < frame.stamp - before.stamp < SECOND:
            dt = (frame.stamp - before.stamp) / SECOND
            triples = zip(frame.velocity, frame.position, before.position, strict=True)
            v = [(q - past) / dt if math.isnan(x) else x for x, q, past in triples]
            frame = frame._replace(velocity=v)
        self._newest, self._came = frame, monotonic()

    def newest(self, timeout: float) -> JointStates | None:
        """The newest one; ``None``: it is older than ``timeout`` [s], or there is none."""
        return self._newest if monotonic() - self._came < timeout else None
