"""A lag of first order: T y' + y = q, of positions and velocities alike, exact for held samples."""

import math

from fpt_ros.disturbances.sensors import SensorDisturbance
from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (Parameter("time_constant", "T of the sensor", 0.005, unit="s", above=0.0),)


def prepare(values: Values, first: float) -> tuple[float, ...]:
    """Constants (T,)."""
    return (number(values, "time_constant"),)


def start(state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest with what is there."""
    n = len(q)
    for i in range(n):
        state[i], state[n + i] = q[i], v[i]


def spoil(
    constants: Vector,
    state: MutableVector,
    dt: float,
    where: Indices,
    q: MutableVector,
    v: MutableVector,
) -> None:
    """Let y += (1 - exp(-dt / T)) (q - y); a lost sample stays lost, and does not move y."""
    n, part = len(q), 1.0 - math.exp(-dt / constants[0])
    for k in range(len(where)):
        i = where[k]
        if not math.isnan(q[i]):
            q[i] = state[i] = state[i] + part * (q[i] - state[i])
        if not math.isnan(v[i]):
            v[i] = state[n + i] = state[n + i] + part * (v[i] - state[n + i])


LAGGING = SensorDisturbance(prepare, spoil, PARAMETERS, lambda n: 2 * n, start)
