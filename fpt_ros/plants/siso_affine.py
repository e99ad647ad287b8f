"""The bare iteration in one dimension (thesis, section 3.1.1): f(r) = alpha r + beta.

No dynamics: the response is the value itself, and the "model" hands r over as it is.
"""

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("x1",)

PARAMETERS = (
    Parameter("alpha", "slope of the response function", 1.0),
    Parameter("beta", "its value at 0", 1.0),
)


def coefficients(parameters: Vector) -> tuple[float, ...]:
    """(alpha, beta) as they are."""
    return tuple(parameters)


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """f(r)."""
    out[0] = c[0] * effort[0] + c[1]


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """The response wanted, handed over as it is."""
    out[0] = r[0]


PLANT = Plant(
    coordinates=COORDINATES,
    units=("",),
    effort_units=("",),
    parameters=PARAMETERS,
    coefficients=coefficients,
    response=response,
    order=0,
)

MODEL = Model(
    coordinates=COORDINATES,
    controlled=COORDINATES,
    parameters=(),
    coefficient_names=(),
    coefficients=coefficients,
    effort=effort,
)
