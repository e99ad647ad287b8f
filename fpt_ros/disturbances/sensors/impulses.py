"""Impulses: now and then a sample is wrong by up to ``size`` to either side."""

from fpt_ros.disturbances.chance import uniform
from fpt_ros.disturbances.sensors import SensorDisturbance
from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (
    Parameter("probability", "of an impulse in a sample", 0.01, minimum=0.0, maximum=1.0),
    Parameter("size", "of the largest ones, in the unit of the positions", 0.1, minimum=0.0),
    Parameter("velocity", "of the largest ones of the velocities", 1.0, minimum=0.0),
)


def prepare(values: Values, first: float) -> tuple[float, ...]:
    """Constants (first, probability, size, size of the velocity's)."""
    return first, *(number(values, parameter.name) for parameter in PARAMETERS)


def spoil(
    constants: Vector,
    state: MutableVector,
    dt: float,
    where: Indices,
    q: MutableVector,
    v: MutableVector,
) -> None:
    """Uniform in [-size, size) where a number drawn is below the probability."""
    for k in range(len(where)):
        if uniform(state, constants[0]) < constants[1]:
            q[where[k]] += constants[2] * (2.0 * uniform(state, constants[0]) - 1.0)
            v[where[k]] += constants[3] * (2.0 * uniform(state, constants[0]) - 1.0)


IMPULSES = SensorDisturbance(prepare, spoil, PARAMETERS, lambda n: 1)
