"""A dead zone: efforts up to ``width`` do nothing, larger ones lack it."""

from fpt_ros.disturbances.actuators import ActuatorDisturbance
from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (Parameter("width", "to either side, in the unit of the effort", 1.0, minimum=0.0),)


def prepare(values: Values, first: float) -> tuple[float, ...]:
    """Constants (width,)."""
    return (number(values, "width"),)


def actuate(
    constants: Vector, state: MutableVector, dt: float, where: Indices, effort: MutableVector
) -> None:
    """Less its nearest point of the zone."""
    width = constants[0]
    for k in range(len(where)):
        i = where[k]
        effort[i] -= min(max(effort[i], -width), width)


DEAD_ZONE = ActuatorDisturbance(prepare, actuate, PARAMETERS)
