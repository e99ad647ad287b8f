"""q^N(t) = offset + a sin(w t): the nominal trajectory of most experiments (section 2.2, ...)."""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values
from fpt_ros.trajectories import Trajectory, per_coordinate, scales

PARAMETERS = (Parameter("offset", "middle of the motion, per coordinate; empty: zero", []),)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: amplitudes, frequencies [rad/s], offsets; c each."""
    return (*scales(values, c), *per_coordinate(values, "offset", c))


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """Write offset + a sin(w t), a w cos(w t), -a w^2 sin(w t)."""
    c = len(out_q)
    for i in range(c):
        a, w = constants[i], constants[c + i]
        swing = a * math.sin(w * t)
        out_q[i] = constants[2 * c + i] + swing
        out_v[i] = a * w * math.cos(w * t)
        out_a[i] = -w * w * swing


SINE = Trajectory(prepare, nominal, PARAMETERS)
