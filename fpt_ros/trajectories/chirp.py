"""q^N(t) = offset + a sin(phase(t)): a sine whose frequency rises linearly, then stays.

phase' = w + (u - w) t / T  up to t = T, then u
"""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.trajectories import Trajectory, per_coordinate, scales

PARAMETERS = (
    Parameter("offset", "middle of the motion, per coordinate; empty: zero", []),
    Parameter("phase", "angle at the start, per coordinate; empty: zero", [], unit="rad"),
    Parameter("last_frequency", "u, per coordinate; empty: ten times the first", [], unit="1/s"),
    Parameter("sweep", "T, in which the frequency goes from the one to the other", 10.0, above=0.0),
)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: a, w, offset, phase, u, c each; then T [s]."""
    amplitude, first = scales(values, c)[:c], scales(values, c)[c:]
    last = per_coordinate(values, "last_frequency", c)
    if not any(last):
        last = [10.0 * w for w in first]
    own = (per_coordinate(values, name, c) for name in ("offset", "phase"))
    middle = tuple(x for each in own for x in each)
    return (*amplitude, *first, *middle, *last, number(values, "sweep"))


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
    end = constants[5 * c]
    s = min(t, end)
    for i in range(c):
        a, w, u = constants[i], constants[c + i], constants[4 * c + i]
        growth = (u - w) / end
        rate = w + growth * s
        angle = constants[3 * c + i] + s * (w + 0.5 * growth * s) + u * (t - s)
        sine, cosine = math.sin(angle), math.cos(angle)
        out_q[i] = constants[2 * c + i] + a * sine
        out_v[i] = a * rate * cosine
        out_a[i] = -a * rate * rate * sine + (a * growth * cosine if t < end else 0.0)


CHIRP = Trajectory(prepare, nominal, PARAMETERS)
