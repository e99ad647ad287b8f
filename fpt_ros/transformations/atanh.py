"""The function of thesis (2.25) and (4.4): F(x) = atanh(tanh(x + D) / 2).

The print of (4.4) has "a tanh", and the bracket of /2 is misplaced: only this reading has an
attractive fixed point and is defined everywhere. How F moves r:
:mod:`fpt_ros.transformations.sigmoid`.
"""

import math

from fpt_ros.laws import Vector, helper
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.transformations import sigmoid
from fpt_ros.transformations.sigmoid import FIRST

PARAMETERS = (Parameter("D", "how far the function is shifted to the left", 0.3),)


def fixed_point(D: float) -> float:
    """x* with tanh(x* + D) = 2 tanh x*: the only fixed point, attractive."""
    return sigmoid.attractive_point(lambda x: shifted(D, x), 0.5 * D, f"D = {D:g}")


def prepare(values: Values) -> tuple[float, ...]:
    """Own constants (D,)."""
    D = number(values, "D")
    return sigmoid.constants(values, fixed_point(D), (D,))


@helper
def shifted(D: float, x: float) -> float:
    """F(x) = atanh(tanh(x + D) / 2)."""
    return math.atanh(0.5 * math.tanh(x + D))


@helper
def generator(constants: Vector, x: float) -> float:
    """F(x)."""
    return shifted(constants[FIRST], x)


def derivative(constants: Vector, x: float) -> float:
    """F'(x) = (1 - y^2) / 2 / (1 - y^2 / 4), y = tanh(x + D)."""
    y = math.tanh(x + constants[FIRST])
    return 0.5 * (1.0 - y * y) / (1.0 - 0.25 * y * y)


ATANH = sigmoid.transformation(generator, PARAMETERS, prepare, derivative)
