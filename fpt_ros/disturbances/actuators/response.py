"""How quickly an actuator answers: tau <- tau + part (effort - tau), once a cycle.

``part`` 1 is exact, less is sluggish, more overshoots (the torque responsiveness of RealAIGym).
"""

from fpt_ros.disturbances.actuators import ActuatorDisturbance
from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (
    Parameter("part", "of the way to the effort that is gone in a cycle", 1.0, minimum=0.0),
)


def prepare(values: Values, first: float) -> tuple[float, ...]:
    """Constants (part,)."""
    return (number(values, "part"),)


def actuate(
    constants: Vector, state: MutableVector, dt: float, where: Indices, effort: MutableVector
) -> None:
    """From rest."""
    for k in range(len(where)):
        i = where[k]
        effort[i] = state[i] = state[i] + constants[0] * (effort[i] - state[i])


RESPONSE = ActuatorDisturbance(prepare, actuate, PARAMETERS, lambda n: n)
