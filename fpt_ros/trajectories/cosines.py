"""q^N(t) = offset + a (1 - cos w t) + b (1 - cos u t): two tones that begin at rest.

The nominal trajectories of sections 2.4 and 2.5, whose figures show motions of this kind.
"""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values
from fpt_ros.trajectories import Trajectory, per_coordinate, scales

PARAMETERS = (
    Parameter("offset", "where it begins, per coordinate; empty: zero", []),
    Parameter("second_amplitude", "of the second tone, per coordinate; empty: zero", []),
    Parameter(
        "second_frequency", "of the second tone, per coordinate; empty: zero", [], unit="1/s"
    ),
)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: a, w, b, u, offset; c each."""
    second = [per_coordinate(values, p.name, c) for p in PARAMETERS[1:]]
    return (*scales(values, c), *second[0], *second[1], *per_coordinate(values, "offset", c))


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """Position, velocity and acceleration of both tones."""
    c = len(out_q)
    for i in range(c):
        a, w = constants[i], constants[c + i]
        b, u = constants[2 * c + i], constants[3 * c + i]
        cos_w, cos_u = math.cos(w * t), math.cos(u * t)
        out_q[i] = constants[4 * c + i] + a * (1.0 - cos_w) + b * (1.0 - cos_u)
        out_v[i] = a * w * math.sin(w * t) + b * u * math.sin(u * t)
        out_a[i] = a * w * w * cos_w + b * u * u * cos_u


COSINES = Trajectory(prepare, nominal, PARAMETERS)
