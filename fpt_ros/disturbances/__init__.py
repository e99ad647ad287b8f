"""External forces that nobody in the loop knows, one a file."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Disturbance:
    """A force that acts beside the control effort.

    Attributes:
        force: ``force(amplitude, frequency, t)`` at t [s], in the unit of the effort.
    """

    force: Callable[[float, float, float], float]


def _none(amplitude: float, frequency: float, t: float) -> float:
    return 0.0


NONE = Disturbance(_none)
