"""Sigmoid Generated Fixed Point Transformation (thesis sections 3.1 and 3.2).

Shifting the graph of g = tanh gives F(x) = atanh(tanh x - K) + D, which has two fixed points: an
attractive one x* and a repulsive one. How F moves r: :mod:`fpt_ros.transformations.sigmoid`.

Both fixed points have a closed form, D/2 +- arccosh(2 sinh D / K - cosh D) / 2, used here: the
printed x* = 0.7114269142 is an iteration stopped too early, and with it G has no fixed point at
h = 0. F is defined only where tanh x > K - 1; the guard keeps the argument from falling below the
repulsive fixed point, as section 3.3 asks.
"""

import math

from fpt_ros.errors import BadInput
from fpt_ros.laws import Vector, helper
from fpt_ros.parameters import Parameter, Values, flag, number
from fpt_ros.transformations import sigmoid
from fpt_ros.transformations.sigmoid import FIRST

PARAMETERS = (
    Parameter("K", "how far the graph of tanh is shifted down", 0.5, above=0.0, maximum=2.0),
    Parameter(
        "D", "how far the shifted graph's inverse is shifted up", 0.6, above=0.0, maximum=10.0
    ),
    Parameter("guard", "keep the argument above the repulsive fixed point", True),
)


def fixed_points(K: float, D: float) -> tuple[float, float]:
    """The attractive and the repulsive fixed point of F.

    Raises:
        BadInput: the shifted graph does not cross the diagonal.
    """
    cosh = 2.0 * math.sinh(D) / K - math.cosh(D)
    if not cosh > 1.0:
        raise BadInput(
            f"K = {K:g} and D = {D:g} give no fixed point: 2 sinh(D)/K - cosh(D) = {cosh:.4g} "
            "has to be > 1 (lower K or raise D)"
        )
    half = 0.5 * math.acosh(cosh)
    return 0.5 * D + half, 0.5 * D - half


def prepare(values: Values) -> tuple[float, ...]:
    """Own constants (K, D)."""
    K, D = number(values, "K"), number(values, "D")
    attractive, repulsive = fixed_points(K, D)
    least = repulsive if flag(values, "guard") else -math.inf
    return sigmoid.constants(values, attractive, (K, D), least)


@helper
def generator(constants: Vector, x: float) -> float:
    """F(x) = atanh(tanh x - K) + D; NaN outside its domain."""
    y = math.tanh(x) - constants[FIRST]
    return math.atanh(y) + constants[FIRST + 1] if -1.0 < y < 1.0 else math.nan


def derivative(constants: Vector, x: float) -> float:
    """F'(x) = (1 - tanh^2 x) / (1 - (tanh x - K)^2)."""
    y = math.tanh(x)
    return (1.0 - y * y) / (1.0 - (y - constants[FIRST]) * (y - constants[FIRST]))


SGFPT = sigmoid.transformation(generator, PARAMETERS, prepare, derivative)
