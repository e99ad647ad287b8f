"""Commands that are lost in bursts: the last one that came acts on (Gilbert 1960).

A burst begins in a cycle with the probability dt / apart, and ends with dt / length.
"""

from fpt_ros.disturbances.actuators import ActuatorDisturbance
from fpt_ros.disturbances.chance import uniform
from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (
    Parameter("length", "mean length of a burst", 0.02, unit="s", above=0.0),
    Parameter("apart", "mean time between two bursts", 0.5, unit="s", above=0.0),
)


def prepare(values: Values, first: float) -> tuple[float, ...]:
    """Constants (first, length, apart)."""
    return first, number(values, "length"), number(values, "apart")


def actuate(
    constants: Vector, state: MutableVector, dt: float, where: Indices, effort: MutableVector
) -> None:
    """state: of chance, 1 during a burst, the efforts that came last."""
    mean = constants[1] if state[1] > 0.0 else constants[2]
    if uniform(state, constants[0]) < dt / mean:
        state[1] = 1.0 - state[1]
    for k in range(len(where)):
        i = where[k]
        if state[1] > 0.0:
            effort[i] = state[2 + i]
        else:
            state[2 + i] = effort[i]


DROPOUTS = ActuatorDisturbance(prepare, actuate, PARAMETERS, lambda n: 2 + n)
