"""The stretched sigmoid (thesis (4.1)): F(x) = B tanh(a (x + b)) + K.

Defined everywhere, so that no response error is too large for it. How F moves r:
:mod:`fpt_ros.transformations.sigmoid`.
"""

import math

from fpt_ros.laws import Vector, helper
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.transformations import sigmoid
from fpt_ros.transformations.sigmoid import FIRST

PARAMETERS = (
    Parameter("B", "height of the sigmoid", 2.0, above=0.0),
    Parameter("a", "its steepness", 0.5, above=0.0),
    Parameter("b", "how far it is shifted to the left", 1.0),
    Parameter("K", "how far it is shifted up", 0.0),
)


def prepare(values: Values) -> tuple[float, ...]:
    """Own constants (B, a, b, K)."""
    own = tuple(number(values, parameter.name) for parameter in PARAMETERS)
    padded = (0.0,) * FIRST + own
    what = ", ".join(f"{p.name} = {x:g}" for p, x in zip(PARAMETERS, own, strict=True))
    start = own[0] + own[3]
    attractive = sigmoid.attractive_point(lambda x: generator(padded, x), start, what)
    return sigmoid.constants(values, attractive, own)


@helper
def generator(constants: Vector, x: float) -> float:
    """F(x)."""
    return (
        constants[FIRST] * math.tanh(constants[FIRST + 1] * (x + constants[FIRST + 2]))
        + constants[FIRST + 3]
    )


def derivative(constants: Vector, x: float) -> float:
    """F'(x) = a B (1 - tanh^2(a (x + b)))."""
    y = math.tanh(constants[FIRST + 1] * (x + constants[FIRST + 2]))
    return constants[FIRST] * constants[FIRST + 1] * (1.0 - y * y)


STRETCHED = sigmoid.transformation(generator, PARAMETERS, prepare, derivative)
