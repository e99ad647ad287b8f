"""The newest measurement of a deformer that may have to hold a position by that alone."""

from time import monotonic

from fpt_ros.cycle.holding import with_velocity
from fpt_ros.messages.frames import JointStates


class Measured:
    """The newest measurement, with a velocity: measured, or the difference of the last two."""

    def __init__(self) -> None:
        self._newest: JointStates | None = None
        self._came = 0.0

    def take(self, frame: JointStates) -> None:
        """A message has come."""
        self._newest, self._came = with_velocity(frame, self._newest), monotonic()

    def newest(self, timeout: float) -> JointStates | None:
        """The newest one; ``None``: it is older than ``timeout`` [s], or there is none."""
        return self._newest if monotonic() - self._came < timeout else None
