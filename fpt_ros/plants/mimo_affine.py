"""The bare iteration in two dimensions (thesis, section 3.2.1): f(r) = M r + c.

No dynamics: the response is the value itself, and the "model" hands r over as it is.
"""

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("x1", "x2")

PARAMETERS = (
    Parameter("m11", "element of M", 3.832),
    Parameter("m12", "element of M", 1.819),
    Parameter("m21", "element of M", 1.819),
    Parameter("m22", "element of M", 2.168),
    Parameter("c1", "element of c", 1.0),
    Parameter("c2", "element of c", -1.0),
)


def coefficients(parameters: Vector) -> tuple[float, ...]:
    """M row by row, then c."""
    return tuple(parameters)


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """f(r)."""
    out[0] = c[0] * effort[0] + c[1] * effort[1] + c[4]
    out[1] = c[2] * effort[0] + c[3] * effort[1] + c[5]


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """The response wanted, handed over as it is."""
    out[0], out[1] = r[0], r[1]


PLANT = Plant(
    coordinates=COORDINATES,
    units=("", ""),
    effort_units=("", ""),
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
