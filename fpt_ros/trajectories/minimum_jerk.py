"""From rest to rest with the least jerk (Flash and Hogan 1985), once or to and fro.

    q^N = offset + amplitude (10 x^3 - 15 x^4 + 6 x^5),  x from 0 to 1 within 1 / frequency

``pause`` is how long it rests at either end, as a part of the time of a move.
"""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, flag, number
from fpt_ros.trajectories import Trajectory, per_coordinate, scales

PARAMETERS = (
    Parameter("offset", "where it begins, per coordinate; empty: zero", []),
    Parameter("pause", "rest before each move, in lengths of a move", 0.0, minimum=0.0),
    Parameter("to_and_fro", "come back, and begin again", True),
)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: amplitudes, moves per second, offsets, c each; pause, whether it comes back."""
    own = number(values, "pause"), float(flag(values, "to_and_fro"))
    return (*scales(values, c), *per_coordinate(values, "offset", c), *own)


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """Position, velocity and acceleration."""
    c = len(out_q)
    pause, back = constants[3 * c], constants[3 * c + 1]
    for i in range(c):
        a, w = constants[i], constants[c + i]
        move = math.floor(w * t / (1.0 + pause))
        x = w * t - move * (1.0 + pause) - pause
        returning = back > 0.0 and move % 2 == 1
        if back == 0.0 and move > 0:
            x = 1.0
        x = min(max(x, 0.0), 1.0)
        size = -a if returning else a
        out_q[i] = constants[2 * c + i] + (a if returning else 0.0)
        out_q[i] += size * x * x * x * (10.0 + x * (6.0 * x - 15.0))
        out_v[i] = size * w * 30.0 * x * x * (1.0 - x) * (1.0 - x)
        out_a[i] = size * w * w * 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x)


MINIMUM_JERK = Trajectory(prepare, nominal, PARAMETERS)
