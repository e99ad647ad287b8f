"""Two masses that hang on springs one below the other, both driven (thesis, section 2.5, (2.29)).

Linear in Theta = (m1, m1 g, k1, k1 L1, k2, k2 L2, b1, m2, m2 g, b2)::

    m1 q1'' - m1 g + k1 q1 - k1 L1 - k2 (q2 - q1) + k2 L2 + b1 q1' = Q1
    m2 q2'' - m2 g + k2 (q2 - q1) - k2 L2 + b2 q2' = Q2

q [m] downwards from the ceiling.
"""

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("q1", "q2")

PARAMETERS = (
    Parameter("m1", "upper mass", unit="kg", above=0.0),
    Parameter("m2", "lower mass", unit="kg", above=0.0),
    Parameter("k1", "stiffness of the upper spring", unit="N/m"),
    Parameter("k2", "stiffness of the lower spring", unit="N/m"),
    Parameter("L1", "length of the upper spring at rest", unit="m"),
    Parameter("L2", "length of the lower spring at rest", unit="m"),
    Parameter("b1", "viscous friction of the upper mass", unit="N s/m"),
    Parameter("b2", "viscous friction of the lower mass", unit="N s/m"),
    Parameter("g", "gravitational acceleration", unit="m/s^2"),
)


def coefficients(parameters: Vector) -> tuple[float, ...]:
    """Physical parameters -> Theta."""
    m1, m2, k1, k2, L1, L2, b1, b2, g = parameters
    return m1, m1 * g, k1, k1 * L1, k2, k2 * L2, b1, m2, m2 * g, b2


@helper
def _rest(c: Vector, q: Vector, v: Vector, i: int) -> float:
    """Row i of (2.29) without the inertial term [N]."""
    spring = c[4] * (q[1] - q[0]) - c[5]
    if i == 0:
        return -c[1] + c[2] * q[0] - c[3] - spring + c[6] * v[0]
    return -c[8] + spring + c[9] * v[1]


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """Accelerations caused by the forces [m/s^2]."""
    out[0] = (effort[0] - _rest(c, q, v, 0)) / c[0]
    out[1] = (effort[1] - _rest(c, q, v, 1)) / c[7]


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """Forces that should cause q'' = r [N]."""
    out[0] = c[0] * r[0] + _rest(c, q, v, 0)
    out[1] = c[7] * r[1] + _rest(c, q, v, 1)


def regressor(c: Vector, q: Vector, v: Vector, w: Vector, a: Vector, out: MutableVector) -> None:
    """Y of Q = Y Theta: two rows of ten."""
    for i in range(20):
        out[i] = 0.0
    stretch = q[1] - q[0]
    out[0], out[1], out[2], out[3] = a[0], -1.0, q[0], -1.0
    out[4], out[5], out[6] = -stretch, 1.0, v[0]
    out[14], out[15] = stretch, -1.0
    out[17], out[18], out[19] = a[1], -1.0, v[1]


def trouble(c: Vector, q: Vector) -> str:
    """The masses have to be positive: they are the gains from force to response."""
    for name, mass in (("m1", c[0]), ("m2", c[7])):
        if not mass > 0.0:
            return (
                f"the model's mass {name} = {mass:g} kg has to be > 0: the tuning has lost it (a "
                "smaller parameter_tuner.alpha, or approximate masses below the exact ones)"
            )
    return ""


PLANT = Plant(
    coordinates=COORDINATES,
    units=("m", "m"),
    effort_units=("N", "N"),
    parameters=PARAMETERS,
    coefficients=coefficients,
    response=response,
)

MODEL = Model(
    coordinates=COORDINATES,
    controlled=COORDINATES,
    parameters=PARAMETERS,
    coefficient_names=("m1", "m1g", "k1", "k1L1", "k2", "k2L2", "b1", "m2", "m2g", "b2"),
    coefficients=coefficients,
    effort=effort,
    regressor=regressor,
    rows=2,
    trouble=trouble,
)
