"""Samples that are lost, each by itself, with the same probability: q and v are NaN."""

import math

from fpt_ros.disturbances.chance import uniform
from fpt_ros.disturbances.sensors import SensorDisturbance
from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, flag, number

PARAMETERS = (
    Parameter("probability", "that a sample is lost", 0.1, minimum=0.0, maximum=1.0),
    Parameter("together", "all coordinates at once, as a lost message", False),
)


def prepare(values: Values, first: float) -> tuple[float, ...]:
    """Constants (first, probability, together)."""
    return first, number(values, "probability"), float(flag(values, "together"))


def spoil(
    constants: Vector,
    state: MutableVector,
    dt: float,
    where: Indices,
    q: MutableVector,
    v: MutableVector,
) -> None:
    """NaN where a number drawn is below the probability."""
    lost = uniform(state, constants[0]) < constants[1]
    for k in range(len(where)):
        if k > 0 and constants[2] == 0.0:
            lost = uniform(state, constants[0]) < constants[1]
        if lost:
            q[where[k]], v[where[k]] = math.nan, math.nan


LOST = SensorDisturbance(prepare, spoil, PARAMETERS, lambda n: 1)
