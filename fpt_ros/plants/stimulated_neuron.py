"""FitzHugh-Nagumo neuron under external electrical stimulation (Thompson, Bardhan and others 1999).

    x' = x (x - 1) (1 - r x) - y + mu u,   y' = b x

x is the activation, y the recovery; a stimulus adds to x'. The response is x', of order 1. Left to
itself under (a / omega) cos(omega t) with r = 10, b = 1, a = 0.1, omega = 2 pi 0.129 it is chaotic
(Wang, Deng and Tsang 2004, Chaos, Solitons and Fractals 22; a test computes its exponent).
"""

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("x", "y")

PARAMETERS = (
    Parameter("r", "steepness of the cubic", above=0.0),
    Parameter("b", "recovery rate"),
    Parameter("mu", "gain of the control signal", above=0.0),
)


@helper
def membrane(r: float, x: float, y: float) -> float:
    """X' without stimulus and control."""
    return x * (x - 1.0) * (1.0 - r * x) - y


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """(x', y') for the control signal u."""
    out[0] = membrane(c[0], q[0], q[1]) + c[2] * effort[0]
    out[1] = c[1] * q[0]


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """Control signal u that should cause x' = r; of the stimulus it knows nothing."""
    out[0] = (r[0] - membrane(c[0], q[0], q[1])) / c[2]
    out[1] = 0.0


PLANT = Plant(
    coordinates=COORDINATES,
    units=("", ""),
    effort_units=("", ""),
    parameters=PARAMETERS,
    coefficients=tuple,
    response=response,
    order=1,
)

MODEL = Model(
    coordinates=COORDINATES,
    controlled=("x",),
    parameters=PARAMETERS,
    coefficient_names=("r", "b", "mu"),
    coefficients=tuple,
    effort=effort,
)
