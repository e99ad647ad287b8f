"""No deformation: the desired response is what the model is asked for. Not adaptive."""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Values
from fpt_ros.transformations import Transformation


def prepare(values: Values) -> tuple[float, ...]:
    """A gain of 0, which every transformation has first."""
    return (0.0,)


def deform(
    constants: Vector, r: Vector, h: Vector, f: Vector, desired: Vector, out: MutableVector
) -> None:
    """R stays as it is."""
    for i in range(len(r)):
        out[i] = r[i]


def slope(constants: Vector) -> float:
    """Nothing follows the response error."""
    return 0.0


def step_limit(constants: Vector) -> float:
    """No step, so none that is too large."""
    return math.inf


NONE = Transformation((), prepare, deform, slope, step_limit, adapts=False)
