"""TORA: cart, beam and dial with the cart not driven (thesis, section 3.2.2, (2.23) with Q3 = 0).

Coordinates: q1 [rad] beam against the cart, q2 [rad] dial, q3 [m] cart. The coefficients are those
of (2.23): Theta1 = m L, Theta2 = m L^2 + Theta, Theta3 = Theta, Theta4 = m + M, Theta5 = m g L::

    | Theta2          Theta3   Theta1 cos q1 | |q1''|   | -Theta5 sin q1       |   |Q1|
    | Theta3          Theta3   0             | |q2''| + |  0                   | = |Q2|
    | Theta1 cos q1   0        Theta4        | |q3''|   | -Theta1 sin q1 q1'^2 |   |Q3|
"""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("q1", "q2", "q3")

PARAMETERS = (
    Parameter("m", "mass of the dial", unit="kg", above=0.0),
    Parameter("M", "mass of the cart", unit="kg", above=0.0),
    Parameter("L", "length of the massless beam", unit="m", above=0.0),
    Parameter("theta", "moment of inertia of the dial about its axle", unit="kg m^2", above=0.0),
    Parameter("g", "gravitational acceleration", unit="m/s^2"),
)


def coefficients(parameters: Vector) -> tuple[float, ...]:
    """(m, M, L, theta, g) -> (m L, m L^2 + theta, theta, m + M, m g L)."""
    m, M, L, theta, g = parameters
    return m * L, m * L * L + theta, theta, m + M, m * g * L


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """Accelerations (q1'', q2'', q3'') caused by (Q1, Q2, Q3): (2.23) solved by elimination.

    Row 1 minus row 2 and row 3 hold q1'' and q3'' alone; row 2 then gives q2''.
    """
    cos, sin = math.cos(q[0]), math.sin(q[0])
    beam, cart, coupling = c[1] - c[2], c[3], c[0] * cos
    torque = effort[0] - effort[1] + c[4] * sin
    force = effort[2] + c[0] * sin * v[0] * v[0]
    determinant = beam * cart - coupling * coupling
    out[0] = (torque * cart - coupling * force) / determinant
    out[1] = effort[1] / c[2] - out[0]
    out[2] = (beam * force - coupling * torque) / determinant


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """(Q1, Q2, 0) for the responses r = (-, q2'', q3''): (3.18), q1'' eliminated by row 3.

    The term Theta (sin/cos) q1'^2 of Q2, a zero in the print, follows from the elimination. Not
    defined at cos q1 = 0, where the cart cannot be driven.
    """
    cos, sin = math.cos(q[0]), math.sin(q[0])
    coupling = c[0] * cos
    centrifugal = sin / cos * v[0] * v[0]
    out[0] = (
        (coupling - c[1] * c[3] / coupling) * r[2] + c[2] * r[1] + c[1] * centrifugal - c[4] * sin
    )
    out[1] = c[2] * (r[1] - c[3] / coupling * r[2] + centrifugal)
    out[2] = 0.0


def workspace(c: Vector) -> tuple[tuple[float, float], ...]:
    """At rest at the start, (m + M) q3' + m L cos q1 q1' = 0 is kept: |q3| <= m L / (m + M) [m]."""
    reach = c[0] / c[3]
    return (-math.inf, math.inf), (-math.inf, math.inf), (-reach, reach)


def trouble(c: Vector, q: Vector) -> str:
    """At cos q1 = 0 the beam cannot push the cart."""
    cos = math.cos(q[0])
    if abs(cos) > 0.1:
        return ""
    return (
        f"cos q1 = {cos:.3g} with q1 = {q[0]:.4g} rad: the model is singular at 0, where the beam "
        "cannot push the cart (a smaller trajectory_generator.amplitude, or |fpt_deformer.A|)"
    )


PLANT = Plant(
    coordinates=COORDINATES,
    units=("rad", "rad", "m"),
    effort_units=("N m", "N m", "N"),
    parameters=PARAMETERS,
    coefficients=coefficients,
    response=response,
    workspace=workspace,
)

MODEL = Model(
    coordinates=COORDINATES,
    controlled=("q2", "q3"),
    parameters=PARAMETERS,
    coefficient_names=("mL", "mL2_theta", "theta", "m_M", "mgL"),
    coefficients=coefficients,
    effort=effort,
    trouble=trouble,
)
