"""q^N(t) = a sin(w t): the nominal trajectory of the van der Pol experiments (section 2.2)."""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.trajectories import Trajectory


def nominal(
    amplitude: Vector,
    frequency: Vector,
    t: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """Write a sin(w t), a w cos(w t), -a w^2 sin(w t), with w in [rad/s]."""
    for i in range(len(amplitude)):
        w = frequency[i]
        out_q[i] = amplitude[i] * math.sin(w * t)
        out_v[i] = amplitude[i] * w * math.cos(w * t)
        out_a[i] = -w * w * out_q[i]


SINE = Trajectory(nominal)
