"""Kapitza's pendulum: its pivot is driven up and down (thesis, section 4.2).

q1 [m] height of the pivot, q2 [rad] from the upright position. Only Q1 [N] drives::

    (M + m) q1'' - m L sin q2 q2'' - m L cos q2 q2'^2 + (M + m) g = Q1
    -m L sin q2 q1'' + m L^2 q2'' - m g L sin q2 = 0

((4.5) has lost its second column.) Three readings of the law that turns the response wanted, q2'',
into the pivot's acceleration: (4.7) as printed, the program listing, and (4.6).
"""

import math
from collections.abc import Callable

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("q1", "q2")

PARAMETERS = (
    Parameter("m", "mass of the pendulum", unit="kg", above=0.0),
    Parameter("M", "mass of the pivot", unit="kg", above=0.0),
    Parameter("L", "length of the pendulum", unit="m", above=0.0),
    Parameter("g", "gravitational acceleration", unit="m/s^2"),
)

ERROR_LIMIT = 0.05
"""|sin q2| below which the listing divides by this instead."""


def coefficients(parameters: Vector) -> tuple[float, ...]:
    """(m, M, L, g) as they are."""
    return tuple(parameters)


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """(q1'', q2'') caused by Q1."""
    m, M, L, g = c[0], c[1], c[2], c[3]
    cos, sin = math.cos(q[1]), math.sin(q[1])
    drive = effort[0] + m * L * cos * v[1] * v[1] - (M + m) * g + m * g * sin * sin
    out[0] = drive / (M + m - m * sin * sin)
    out[1] = (out[0] + g) * sin / L


@helper
def _effort(c: Vector, q: Vector, v: Vector, pivot: float, r: float, out: MutableVector) -> None:
    """Q1 for the pivot's acceleration and q2'' = r."""
    m, M, L, g = c[0], c[1], c[2], c[3]
    cos, sin = math.cos(q[1]), math.sin(q[1])
    out[0] = (M + m) * pivot - m * L * sin * r - m * L * cos * v[1] * v[1] + (M + m) * g
    out[1] = 0.0


@helper
def _listing(c: Vector, q: Vector, r: float) -> float:
    """The pivot's acceleration as in the thesis's listing."""
    sin = math.sin(q[1])
    if abs(sin) > ERROR_LIMIT:
        return c[2] * r / sin
    return (-c[2] if sin <= 0.0 else c[2]) * r / math.sin(ERROR_LIMIT)


def literal(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """(4.7) as printed: q1'' = L |q2| / sin q2 r - g."""
    sin = math.sin(q[1])
    ratio = abs(q[1]) / sin if abs(sin) >= 1e-9 else 1.0
    _effort(c, q, v, c[2] * ratio * r[1] - c[3], r[1], out)


def listing(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """The program listing: q1'' = L r / sin q2, without -g."""
    _effort(c, q, v, _listing(c, q, r[1]), r[1], out)


def with_gravity(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """(4.6): q1'' = L r / sin q2 - g."""
    _effort(c, q, v, _listing(c, q, r[1]) - c[3], r[1], out)


PLANT = Plant(
    coordinates=COORDINATES,
    units=("m", "rad"),
    effort_units=("N", "N m"),
    parameters=PARAMETERS,
    coefficients=coefficients,
    response=response,
)


def _model(effort: Callable[..., None]) -> Model:
    return Model(
        coordinates=COORDINATES,
        controlled=("q2",),
        parameters=PARAMETERS,
        coefficient_names=("m", "M", "L", "g"),
        coefficients=coefficients,
        effort=effort,
    )


LITERAL = _model(literal)
LISTING = _model(listing)
WITH_GRAVITY = _model(with_gravity)
