"""q^N(t) = offset + s(t) (a sin(w t + phase) + b sin(u t + phase_2)): arms from their posture.

s(t) is the quintic 10 x^3 - 15 x^4 + 6 x^5 of x = t / rise, 1 from x = 1 on, which has minimum jerk
(Flash and Hogan 1985): the motion begins at rest at the offset, and is smooth up to its
acceleration.
"""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.trajectories import Trajectory, per_coordinate, scales

PARAMETERS = (
    Parameter("offset", "where it begins, per coordinate; empty: zero", []),
    Parameter("phase", "of the first tone, per coordinate; empty: zero", [], unit="rad"),
    Parameter("second_amplitude", "of the second tone, per coordinate; empty: zero", []),
    Parameter(
        "second_frequency", "of the second tone, per coordinate; empty: zero", [], unit="1/s"
    ),
    Parameter("second_phase", "of the second tone, per coordinate; empty: zero", [], unit="rad"),
    Parameter("rise", "time in which the motion grows to its size", 2.0, unit="s", above=0.0),
)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: a, w, offset, phase, b, u, second phase, c each; then the rise [s]."""
    own = (per_coordinate(values, p.name, c) for p in PARAMETERS[:-1])
    return (*scales(values, c), *(x for each in own for x in each), number(values, "rise"))


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """Position, velocity and acceleration of s (first + second tone)."""
    c = len(out_q)
    rise = constants[7 * c]
    x = min(t / rise, 1.0)
    s = x * x * x * (10.0 + x * (6.0 * x - 15.0))
    s_v = 30.0 * x * x * (1.0 - x) * (1.0 - x) / rise
    s_a = 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x) / (rise * rise)
    for i in range(c):
        a, w, b, u = constants[i], constants[c + i], constants[4 * c + i], constants[5 * c + i]
        first, second = w * t + constants[3 * c + i], u * t + constants[6 * c + i]
        y = a * math.sin(first) + b * math.sin(second)
        y_v = a * w * math.cos(first) + b * u * math.cos(second)
        y_a = -a * w * w * math.sin(first) - b * u * u * math.sin(second)
        out_q[i] = constants[2 * c + i] + s * y
        out_v[i] = s_v * y + s * y_v
        out_a[i] = s_a * y + 2.0 * s_v * y_v + s * y_a


BLENDED_SINES = Trajectory(prepare, nominal, PARAMETERS)
