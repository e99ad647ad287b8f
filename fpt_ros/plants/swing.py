"""The swing: a double pendulum of which only the lower axle is driven (thesis, (4.2), (4.3)).

q1 [rad] of the upper arm from the vertical, q2 [rad] of the lower one against it. Q1 = 0: one
torque, Q2, serves two coordinates in turn (section 4.1.2; its "Q1" and "Table 4.2" are slips).
"""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("q1", "q2")

PARAMETERS = (
    Parameter("m1", "upper mass", unit="kg", above=0.0),
    Parameter("m2", "lower mass", unit="kg", above=0.0),
    Parameter("L1", "length of the upper arm", unit="m", above=0.0),
    Parameter("L2", "length of the lower arm", unit="m", above=0.0),
    Parameter("g", "gravitational acceleration", unit="m/s^2"),
)


def coefficients(parameters: Vector) -> tuple[float, ...]:
    """((m1 + m2) L1^2, m2 L2^2, m2 L1 L2, (m1 + m2) g L1, m2 g L2)."""
    m1, m2, L1, L2, g = parameters
    return (m1 + m2) * L1 * L1, m2 * L2 * L2, m2 * L1 * L2, (m1 + m2) * g * L1, m2 * g * L2


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """Accelerations caused by the torques [rad/s^2]."""
    cos, sin, low = math.cos(q[1]), math.sin(q[1]), math.sin(q[0] + q[1])
    H11, H12, H22 = c[0] + c[1] + 2.0 * c[2] * cos, c[1] + c[2] * cos, c[1]
    h1 = -c[2] * sin * v[1] * (2.0 * v[0] + v[1]) + c[3] * math.sin(q[0]) + c[4] * low
    h2 = c[2] * sin * v[0] * v[0] + c[4] * low
    b1, b2 = effort[0] - h1, effort[1] - h2
    determinant = H11 * H22 - H12 * H12
    out[0] = (H22 * b1 - H12 * b2) / determinant
    out[1] = (H11 * b2 - H12 * b1) / determinant


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """(0, Q2) for the response of the one coordinate that is controlled now.

    Q1 = 0 makes the other acceleration follow from it.
    """
    cos, sin, low = math.cos(q[1]), math.sin(q[1]), math.sin(q[0] + q[1])
    H11, H12, H22 = c[0] + c[1] + 2.0 * c[2] * cos, c[1] + c[2] * cos, c[1]
    h1 = -c[2] * sin * v[1] * (2.0 * v[0] + v[1]) + c[3] * math.sin(q[0]) + c[4] * low
    h2 = c[2] * sin * v[0] * v[0] + c[4] * low
    a1, a2 = r[0], r[1]
    if math.isnan(a2):
        a2 = -(H11 * a1 + h1) / H12
    else:
        a1 = -(H12 * a2 + h1) / H11
    out[0] = 0.0
    out[1] = H12 * a1 + H22 * a2 + h2


PLANT = Plant(
    coordinates=COORDINATES,
    units=("rad", "rad"),
    effort_units=("N m", "N m"),
    parameters=PARAMETERS,
    coefficients=coefficients,
    response=response,
)

MODEL = Model(
    coordinates=COORDINATES,
    controlled=COORDINATES,
    parameters=PARAMETERS,
    coefficient_names=("upper", "lower", "coupling", "upper_gravity", "lower_gravity"),
    coefficients=coefficients,
    effort=effort,
)
