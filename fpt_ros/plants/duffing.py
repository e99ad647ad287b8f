"""Duffing oscillator with a negative spring, as the examples of FPTControl.jl have it.

    q'' = alpha q + delta q' + beta q^3 + u

Unstable at rest for alpha > 0. The source gives no units (krisztiankosi/Control, RFPT_SISO).
"""

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("q1",)

PARAMETERS = (
    Parameter("alpha", "linear repulsion"),
    Parameter("delta", "negative damping"),
    Parameter("beta", "cubic repulsion"),
)


@helper
def _own(c: Vector, q: float, v: float) -> float:
    """The response without any effort."""
    return (c[0] + c[2] * q * q) * q + c[1] * v


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """Acceleration q'' caused by u."""
    out[0] = _own(c, q[0], v[0]) + effort[0]


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """The u that should cause q'' = r."""
    out[0] = r[0] - _own(c, q[0], v[0])


PLANT = Plant(
    coordinates=COORDINATES,
    units=("",),
    effort_units=("",),
    parameters=PARAMETERS,
    coefficients=tuple,
    response=response,
)

MODEL = Model(
    coordinates=COORDINATES,
    controlled=COORDINATES,
    parameters=PARAMETERS,
    coefficient_names=(),
    coefficients=tuple,
    effort=effort,
)
