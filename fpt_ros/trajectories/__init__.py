"""Nominal trajectories, one a file: functions of time with their first two derivatives."""

from collections.abc import Callable
from dataclasses import dataclass

from fpt_ros.laws import MutableVector, Vector


@dataclass(frozen=True)
class Trajectory:
    """Nominal motion of the controlled coordinates.

    Attributes:
        nominal: ``nominal(amplitude, frequency, t, out_q, out_v, out_a)`` writes position, velocity
            and acceleration of each controlled coordinate at t [s]. ``amplitude`` is in the unit of
            the coordinate; ``frequency`` multiplies time ([rad/s] for harmonic shapes).
    """

    nominal: Callable[[Vector, Vector, float, MutableVector, MutableVector, MutableVector], None]
