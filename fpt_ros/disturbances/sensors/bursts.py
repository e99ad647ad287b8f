"""Drop-outs in bursts: nothing is measured for a while (Gilbert 1960, a chain of two states).

A burst begins in a cycle with the probability dt / apart, and ends with dt / length.
"""

import math

from fpt_ros.disturbances.chance import uniform
from fpt_ros.disturbances.sensors import SensorDisturbance
from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (
    Parameter("length", "mean length of a burst", 0.02, unit="s", above=0.0),
    Parameter("apart", "mean time between two bursts", 0.5, unit="s", above=0.0),
)


def prepare(values: Values, first: float) -> tuple[float, ...]:
    """Constants (first, length, apart)."""
    return first, number(values, "length"), number(values, "apart")


def spoil(
    constants: Vector,
    state: MutableVector,
    dt: float,
    where: Indices,
    q: MutableVector,
    v: MutableVector,
) -> None:
    """NaN during a burst; state[1] is 1 then."""
    mean = constants[1] if state[1] > 0.0 else constants[2]
    if uniform(state, constants[0]) < dt / mean:
        state[1] = 1.0 - state[1]
    if state[1] > 0.0:
        for k in range(len(where)):
            q[where[k]], v[where[k]] = math.nan, math.nan


BURSTS = SensorDisturbance(prepare, spoil, PARAMETERS, lambda n: 2)
