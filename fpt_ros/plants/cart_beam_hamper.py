"""Cart, beam and hamper, all three axles driven (thesis, section 2.4, (2.23)).

The plant is that of :mod:`fpt_ros.plants.tora`. The print of (2.23) has M L^2 + Theta for H11; only
m L^2 + Theta matches the printed coefficients. The model is that of the modified adaptive
Slotine-Li controller (2.21)::

    Q = H^ r + C^ (q' + s) + g^ + K_D s,   C31 = -Theta1 sin q1 q1' the only entry of C
"""

import math
from dataclasses import replace

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, tora

PARAMETERS = tora.PARAMETERS

MODEL_PARAMETERS = (
    *PARAMETERS,
    Parameter("K_D", "gain of the combined error in the force", 100.0, minimum=0.0),
)


def coefficients(parameters: Vector) -> tuple[float, ...]:
    """(m, M, L, theta, g, K_D) -> Theta of (2.23), and K_D, which is not tuned."""
    return (*tora.coefficients(parameters[:5]), parameters[5])


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """(2.21) with r in the place of v'."""
    cos, sin = math.cos(q[0]), math.sin(q[0])
    out[0] = c[1] * r[0] + c[2] * r[1] + c[0] * cos * r[2] - c[4] * sin + c[5] * s[0]
    out[1] = c[2] * (r[0] + r[1]) + c[5] * s[1]
    out[2] = c[0] * (cos * r[0] - sin * v[0] * (v[0] + s[0])) + c[3] * r[2] + c[5] * s[2]


def regressor(c: Vector, q: Vector, v: Vector, w: Vector, a: Vector, out: MutableVector) -> None:
    """Y of Q = Y Theta: three rows of five."""
    cos, sin = math.cos(q[0]), math.sin(q[0])
    for i in range(15):
        out[i] = 0.0
    out[0], out[1], out[2], out[4] = cos * a[2], a[0], a[1], -sin
    out[7] = a[0] + a[1]
    out[10], out[13] = cos * a[0] - sin * v[0] * w[0], a[2]


def trouble(c: Vector, q: Vector) -> str:
    """H^ has to be positive definite: the iteration contracts only then."""
    coupling = c[0] * math.cos(q[0])
    margin = (c[1] - c[2]) * c[3] - coupling * coupling
    for name, value in (("theta", c[2]), ("(Theta2 - Theta3) Theta4 - (Theta1 cos q1)^2", margin)):
        if not value > 0.0:
            return (
                f"the model's inertia H^ is not positive definite: {name} = {value:g} has to be "
                "> 0 (the tuning has lost it: a larger parameter_tuner.epsilon)"
            )
    return ""


PLANT = replace(tora.PLANT, workspace=None)

MODEL = Model(
    coordinates=tora.COORDINATES,
    controlled=tora.COORDINATES,
    parameters=MODEL_PARAMETERS,
    coefficient_names=("mL", "mL2_theta", "theta", "m_M", "mgL"),
    coefficients=coefficients,
    effort=effort,
    regressor=regressor,
    rows=3,
    trouble=trouble,
)
