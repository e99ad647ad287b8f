"""Saturation: an actuator gives no more than ``limit`` to either side."""

from fpt_ros.disturbances.actuators import ActuatorDisturbance
from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (Parameter("limit", "in the unit of the effort", 100.0, above=0.0),)


def prepare(values: Values, first: float) -> tuple[float, ...]:
    """Constants (limit,)."""
    return (number(values, "limit"),)


def actuate(
    constants: Vector, state: MutableVector, dt: float, where: Indices, effort: MutableVector
) -> None:
    """The nearest effort that it can give."""
    limit = constants[0]
    for k in range(len(where)):
        i = where[k]
        effort[i] = min(max(effort[i], -limit), limit)


SATURATION = ActuatorDisturbance(prepare, actuate, PARAMETERS)
