"""Double pendulum, driven at both joints, at the first one (pendubot) or the second one (acrobot).

    M(q) q'' + C(q, q') q' - G(q) + F(q') = tau,   F_i = b_i q_i' + cf_i atan(100 q_i')

q1 is measured from the vertical that hangs down, q2 from the first link; I1 and I2 are about the
joints, Ir is the inertia of the motors behind gears of ratio gr (Wiebe et al. 2024, RealAIGym;
Tedrake, Underactuated Robotics, chapter 3). A joint without a motor ignores its effort.

The models of pendubot and acrobot prescribe the response of the joint that has a motor: the
acceleration of the other one follows from its own row (collocated partial linearisation, Spong
1994), which is solved first.
"""

import math

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Effort, Model, Plant, Response

COORDINATES = ("q1", "q2")

PARAMETERS = (
    Parameter("m1", "mass of the first link", unit="kg", above=0.0),
    Parameter("m2", "mass of the second link", unit="kg", above=0.0),
    Parameter("l1", "length of the first link", unit="m", above=0.0),
    Parameter("r1", "its centre of mass from the joint", unit="m", above=0.0),
    Parameter("r2", "centre of mass of the second link from its joint", unit="m", above=0.0),
    Parameter("I1", "inertia of the first link about its joint", unit="kg m^2", above=0.0),
    Parameter("I2", "inertia of the second link about its joint", unit="kg m^2", above=0.0),
    Parameter("g", "gravity", 9.81, unit="m/s^2"),
    Parameter("b1", "viscous friction of the first joint", 0.0, unit="N m s"),
    Parameter("b2", "viscous friction of the second joint", 0.0, unit="N m s"),
    Parameter("cf1", "Coulomb friction of the first joint", 0.0, unit="N m"),
    Parameter("cf2", "Coulomb friction of the second joint", 0.0, unit="N m"),
    Parameter("Ir", "inertia of a motor", 0.0, unit="kg m^2", minimum=0.0),
    Parameter("gr", "gear ratio", 6.0, above=0.0),
)

NAMES = ("M11", "coupling", "M22", "g1", "g2", "b1", "b2", "cf1", "cf2", "M12")


def coefficients(p: Vector) -> tuple[float, ...]:
    """What the equations of motion hold of the parameters: see ``NAMES``."""
    m1, m2, l1, r1, r2, I1, I2, g = p[:8]
    motor, ratio = p[12], p[13]
    return (
        I1 + I2 + m2 * l1 * l1 + ratio * ratio * motor + motor,
        m2 * l1 * r2,
        I2 + ratio * ratio * motor,
        g * (m1 * r1 + m2 * l1),
        g * m2 * r2,
        *p[8:12],
        I2 - ratio * motor,
    )


@helper
def row1(c: Vector, q: Vector, v: Vector) -> float:
    """C q' - G + F of the first joint."""
    turning = c[1] * math.sin(q[1])
    weight = c[3] * math.sin(q[0]) + c[4] * math.sin(q[0] + q[1])
    friction = c[5] * v[0] + c[7] * math.atan(100.0 * v[0])
    return -turning * v[1] * (2.0 * v[0] + v[1]) + weight + friction


@helper
def row2(c: Vector, q: Vector, v: Vector) -> float:
    """C q' - G + F of the second joint."""
    friction = c[6] * v[1] + c[8] * math.atan(100.0 * v[1])
    return c[1] * math.sin(q[1]) * v[0] * v[0] + c[4] * math.sin(q[0] + q[1]) + friction


def _response(first: float, second: float) -> Response:
    """Of a pendulum with motors where the numbers are 1."""

    def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
        coupling = c[1] * math.cos(q[1])
        M11, M12, M22 = c[0] + 2.0 * coupling, c[9] + coupling, c[2]
        f1 = first * effort[0] - row1(c, q, v)
        f2 = second * effort[1] - row2(c, q, v)
        determinant = M11 * M22 - M12 * M12
        out[0] = (M22 * f1 - M12 * f2) / determinant
        out[1] = (M11 * f2 - M12 * f1) / determinant

    return response


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """The torques that should cause q'' = r; a joint that nobody controls gets none."""
    coupling = c[1] * math.cos(q[1])
    M11, M12, M22 = c[0] + 2.0 * coupling, c[9] + coupling, c[2]
    b1, b2, r1, r2 = row1(c, q, v), row2(c, q, v), r[0], r[1]
    if math.isnan(r1):
        r1 = -(M12 * r2 + b1) / M11
    elif math.isnan(r2):
        r2 = -(M12 * r1 + b2) / M22
    out[0] = M11 * r1 + M12 * r2 + b1
    out[1] = M12 * r1 + M22 * r2 + b2
    if math.isnan(r[0]):
        out[0] = 0.0
    if math.isnan(r[1]):
        out[1] = 0.0


def _plant(first: float, second: float) -> Plant:
    return Plant(
        coordinates=COORDINATES,
        units=("rad", "rad"),
        effort_units=("N m", "N m"),
        parameters=PARAMETERS,
        coefficients=coefficients,
        response=_response(first, second),
    )


def _model(controlled: tuple[str, ...], law: Effort) -> Model:
    return Model(
        coordinates=COORDINATES,
        controlled=controlled,
        parameters=PARAMETERS,
        coefficient_names=(),
        coefficients=coefficients,
        effort=law,
    )


DOUBLE_PENDULUM, PENDUBOT, ACROBOT = _plant(1.0, 1.0), _plant(1.0, 0.0), _plant(0.0, 1.0)

MODEL = _model(COORDINATES, effort)
PENDUBOT_MODEL, ACROBOT_MODEL = _model(("q1",), effort), _model(("q2",), effort)
