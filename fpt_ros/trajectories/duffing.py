"""A forced Duffing oscillator left to itself: the one that another is to synchronise with.

    q'' = -delta q' + alpha q - beta q^3 + gamma cos(omega t)

integrated by explicit Euler over the cycles, as the plant is; chaotic with the defaults
(Guckenheimer and Holmes 1983, section 2.2).
"""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.trajectories import Trajectory, scales

PARAMETERS = (
    Parameter("drive.alpha", "linear repulsion of the drive", 1.0),
    Parameter("drive.beta", "its cubic attraction", 1.0),
    Parameter("drive.delta", "its damping", 0.25),
    Parameter("drive.gamma", "its forcing", 0.3),
    Parameter("drive.omega", "frequency of the forcing", 1.0, unit="rad/s"),
)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: amplitude and frequency (factors) of the first coordinate, then the parameters."""
    first = scales(values, c)
    return first[0], first[c], *(number(values, p.name) for p in PARAMETERS)


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """Position, velocity, acceleration; ``state`` is (q, q', q'') of the latest cycle."""
    a, w, h = constants[0], constants[1], constants[1] * dt
    alpha, beta, delta = constants[2], constants[3], constants[4]
    q, v = state[0] + h * state[1], state[1] + h * state[2]
    force = constants[5] * math.cos(constants[6] * w * t)
    state[0], state[1] = q, v
    state[2] = (alpha - beta * q * q) * q - delta * v + force
    for i in range(len(out_q)):
        out_q[i], out_v[i], out_a[i] = a * q, a * w * v, a * w * w * state[2]


DUFFING = Trajectory(prepare, nominal, PARAMETERS, (0.1, 0.0, 0.0))
