"""Quantisation, as of an encoder: the nearest multiple of a step."""

import math

from fpt_ros.disturbances.sensors import SensorDisturbance
from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (
    Parameter("step", "of the positions; 0: none", 1e-3, minimum=0.0),
    Parameter("velocity", "step of the velocities; 0: none", 0.0, minimum=0.0),
)


def prepare(values: Values, first: float) -> tuple[float, ...]:
    """Constants (step of positions, of velocities)."""
    return number(values, "step"), number(values, "velocity")


def nearest(x: float, step: float) -> float:
    """The nearest multiple of a step, NaN of NaN."""
    if not (step > 0.0 and abs(x) < math.inf):
        return x
    return step * math.floor(x / step + 0.5)


def spoil(
    constants: Vector,
    state: MutableVector,
    dt: float,
    where: Indices,
    q: MutableVector,
    v: MutableVector,
) -> None:
    """Round both."""
    for k in range(len(where)):
        i = where[k]
        q[i], v[i] = nearest(q[i], constants[0]), nearest(v[i], constants[1])


QUANTISED = SensorDisturbance(prepare, spoil, PARAMETERS)
