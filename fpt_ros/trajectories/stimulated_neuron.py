"""A neuron under electrical stimulation, left to itself: the one to synchronise with.

    x' = x (x - 1) (1 - r x) - y + (a / omega) cos(omega t),   y' = b x

from (0, 0), integrated by explicit Euler over the cycles, as the plant is
(:mod:`fpt_ros.plants.stimulated_neuron`); chaotic with the defaults.
"""

import math

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.trajectories import Trajectory, scales

PARAMETERS = (
    Parameter("drive.r", "steepness of the drive's cubic", 10.0, above=0.0),
    Parameter("drive.b", "its recovery rate", 1.0),
    Parameter("drive.a", "amplitude of its stimulus, times omega", 0.1),
    Parameter("drive.f", "frequency of its stimulus, omega / 2 pi", 0.129, unit="Hz", above=0.0),
)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: amplitude and frequency (factors) of the first coordinate, r, b, a, omega."""
    first = scales(values, c)
    r, b, a, f = (number(values, p.name) for p in PARAMETERS)
    return first[0], first[c], r, b, a, 2.0 * math.pi * f


@helper
def rate(constants: Vector, x: float, y: float, t: float) -> float:
    """X' of the drive at t, in its own time."""
    omega = constants[5]
    stimulus = constants[4] / omega * math.cos(omega * t)
    return x * (x - 1.0) * (1.0 - constants[2] * x) - y + stimulus


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """X, x' and x'' at t; ``state`` is (x, y)."""
    scale, w, h = constants[0], constants[1], constants[1] * dt
    r, b, omega = constants[2], constants[3], constants[5]
    x, y = state[0], state[1]
    x, y = x + h * rate(constants, x, y, w * (t - dt)), y + h * b * x
    state[0], state[1] = x, y
    x_dot = rate(constants, x, y, w * t)
    slope = (2.0 * x - 1.0) * (1.0 - r * x) - r * x * (x - 1.0)
    second = slope * x_dot - b * x - constants[4] * math.sin(omega * w * t)
    out_q[0], out_v[0], out_a[0] = scale * x, scale * w * x_dot, scale * w * w * second


STIMULATED_NEURON = Trajectory(prepare, nominal, PARAMETERS, (0.0, 0.0))
