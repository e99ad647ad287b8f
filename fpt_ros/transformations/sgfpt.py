"""Sigmoid Generated Fixed Point Transformation (thesis sections 3.1 and 3.2).

Shifting the graph of g = tanh gives F(x) = atanh(tanh x - K) + D, which has two fixed points: an
attractive one x* and a repulsive one. With the response error h::

    signed (3.1):  r' = F(A h + x*) - x* + r
    norm   (3.5):  r' = [F(A ||h|| + x*) - x*] h/||h|| + r

Both fixed points have a closed form, D/2 +- arccosh(2 sinh D / K - cosh D) / 2, used here: the
printed x* = 0.7114269142 is an iteration stopped too early, and with it G has no fixed point at
h = 0. F is defined only where tanh x > K - 1; the guard keeps the argument from falling below the
repulsive fixed point, as section 3.3 asks.
"""

import math

from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector, helper, norm
from fpt_ros.parameters import Parameter, Values, flag, number, word
from fpt_ros.transformations import FORM, TINY, Transformation

PARAMETERS = (
    Parameter("A", "gain of the response error; its sign is that of convergence", -0.1),
    Parameter("K", "how far the graph of tanh is shifted down", 0.5, above=0.0, maximum=2.0),
    Parameter(
        "D", "how far the shifted graph's inverse is shifted up", 0.6, above=0.0, maximum=10.0
    ),
    Parameter("guard", "keep the argument above the repulsive fixed point", True),
    FORM,
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
    """Constants (A, K, D, x*, least argument, 1 for the signed form or 0)."""
    A, K, D = number(values, "A"), number(values, "K"), number(values, "D")
    attractive, repulsive = fixed_points(K, D)
    least = repulsive if flag(values, "guard") else -math.inf
    return A, K, D, attractive, least, 1.0 if word(values, "form") == "signed" else 0.0


@helper
def generator(K: float, D: float, x: float) -> float:
    """F(x) = atanh(tanh x - K) + D; NaN outside its domain."""
    y = math.tanh(x) - K
    return math.atanh(y) + D if -1.0 < y < 1.0 else math.nan


def deform(constants: Vector, r: Vector, h: Vector, out: MutableVector) -> None:
    """(3.1) or (3.5)."""
    A, K, D = constants[0], constants[1], constants[2]
    attractive, least = constants[3], constants[4]
    if constants[5]:
        for i in range(len(r)):
            x = max(A * h[i] + attractive, least)
            out[i] = r[i] + (generator(K, D, x) - attractive)
        return
    size = norm(h)
    step = 0.0
    if size > TINY:
        x = max(A * size + attractive, least)
        step = (generator(K, D, x) - attractive) / size
    for i in range(len(r)):
        out[i] = r[i] + step * h[i]


def slope(constants: Vector) -> float:
    """F'(x*) = (1 - tanh^2 x*) / (1 - (tanh x* - K)^2)."""
    y = math.tanh(constants[3])
    return (1.0 - y * y) / (1.0 - (y - constants[1]) * (y - constants[1]))


def step_limit(constants: Vector) -> float:
    """x* - F(least argument): the guard's edge, or infinite without a guard."""
    if constants[4] == -math.inf:
        return math.inf
    return constants[3] - generator(constants[1], constants[2], constants[4])


SGFPT = Transformation(PARAMETERS, prepare, deform, slope, step_limit)
