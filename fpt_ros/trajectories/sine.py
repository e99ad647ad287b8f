"""q^N(t) = offset + a sin(w t + phase): the nominal motion of most experiments (section 2.2)."""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values
from fpt_ros.trajectories import Trajectory, per_coordinate, scales

PARAMETERS = (
    Parameter("offset", "middle of the motion, per coordinate; empty: zero", []),
    Parameter("phase", "angle at the start, per coordinate; empty: zero", [], unit="rad"),
)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: amplitudes, frequencies [rad/s], offsets, phases; c each."""
    own = (per_coordinate(values, name, c) for name in ("offset", "phase"))
    return (*scales(values, c), *(x for each in own for x in each))


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """Write offset + a sin(w t + phase) and its derivatives."""
    c = len(out_q)
    for i in range(c):
        a, w = constants[i], constants[c + i]
        angle = w * t + constants[3 * c + i]
        swing = a * math.sin(angle)
        out_q[i] = constants[2 * c + i] + swing
        out_v[i] = a * w * math.cos(angle)
        out_a[i] = -w * w * swing


SINE = Trajectory(prepare, nominal, PARAMETERS)
