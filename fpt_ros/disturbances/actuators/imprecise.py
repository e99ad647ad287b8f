"""An actuator whose gain is wrong, with noise: factor effort + sigma z, z normal, one a cycle."""

from fpt_ros.disturbances.actuators import ActuatorDisturbance
from fpt_ros.disturbances.chance import normal
from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (
    Parameter("factor", "of the effort commanded", 1.0, minimum=0.0),
    Parameter("sigma", "standard deviation of the noise, in the unit of the effort", 0.0),
)


def prepare(values: Values, first: float) -> tuple[float, ...]:
    """Constants (first, factor, sigma)."""
    return first, number(values, "factor"), number(values, "sigma")


def actuate(
    constants: Vector, state: MutableVector, dt: float, where: Indices, effort: MutableVector
) -> None:
    """Both, of each coordinate by itself."""
    for k in range(len(where)):
        i = where[k]
        effort[i] = constants[1] * effort[i] + constants[2] * normal(state, constants[0])


IMPRECISE = ActuatorDisturbance(prepare, actuate, PARAMETERS, lambda n: 1)
