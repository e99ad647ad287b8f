"""FitzHugh-Nagumo neuron: potential v and recovery variable w (thesis, section 3.1.2, (3.3)).

    v' = v - v^3 / 3 - w + I + mu u,   w' = (v + a - b w) / tau

The response is v', of order 1; a disturbance adds to the control signal u.
"""

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("v", "w")

PARAMETERS = (
    Parameter("a", "recovery offset"),
    Parameter("tau", "recovery time constant", above=0.0),
    Parameter("b", "recovery rate"),
    Parameter("I", "stimulus"),
    Parameter("mu", "gain of the control signal", above=0.0),
)


def coefficients(parameters: Vector) -> tuple[float, ...]:
    """(a, tau, b, I, mu) as they are."""
    return tuple(parameters)


@helper
def _uncontrolled(c: Vector, q: Vector) -> float:
    """V' without control."""
    return q[0] - q[0] * q[0] * q[0] / 3.0 - q[1] + c[3]


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """(v', w') for the control signal u."""
    out[0] = _uncontrolled(c, q) + c[4] * effort[0]
    out[1] = (q[0] + c[0] - c[2] * q[1]) / c[1]


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """Control signal u that should cause v' = r."""
    out[0] = (r[0] - _uncontrolled(c, q)) / c[4]
    out[1] = 0.0


PLANT = Plant(
    coordinates=COORDINATES,
    units=("", ""),
    effort_units=("", ""),
    parameters=PARAMETERS,
    coefficients=coefficients,
    response=response,
    order=1,
)

MODEL = Model(
    coordinates=COORDINATES,
    controlled=("v",),
    parameters=PARAMETERS,
    coefficient_names=("a", "tau", "b", "I", "mu"),
    coefficients=coefficients,
    effort=effort,
)
