"""Van der Pol oscillator with a cubic spring, as the examples of FPTControl.jl have it.

    m q'' = u + mu (1 - q^2) q' - omega^2 q - alpha q^3 - lambda^5

The source writes lambda^5, a constant, where the thesis's oscillator of fifth order has lambda q^5
(krisztiankosi/Control, RFPT_SISO); kept, as it is what was run. No units.
"""

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("q1",)

PARAMETERS = (
    Parameter("m", "inertia", above=0.0),
    Parameter("mu", "excitation where |q| < 1, damping elsewhere"),
    Parameter("omega", "eigenfrequency of the linear spring"),
    Parameter("alpha", "cubic stiffness"),
    Parameter("lambda", "fifth root of a constant force"),
)


def coefficients(parameters: Vector) -> tuple[float, ...]:
    """(m, mu, omega, alpha, lambda) -> (m, mu, omega^2, alpha, lambda^5)."""
    m, mu, omega, alpha, lam = parameters
    return m, mu, omega * omega, alpha, lam * lam * lam * lam * lam


@helper
def _resistance(c: Vector, q: float, v: float) -> float:
    """The force that is to be overcome at (q, q')."""
    return -c[1] * (1.0 - q * q) * v + c[2] * q + c[3] * q * q * q + c[4]


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """Acceleration q'' caused by u."""
    out[0] = (effort[0] - _resistance(c, q[0], v[0])) / c[0]


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """The u that should cause q'' = r."""
    out[0] = c[0] * r[0] + _resistance(c, q[0], v[0])


PLANT = Plant(
    coordinates=COORDINATES,
    units=("",),
    effort_units=("",),
    parameters=PARAMETERS,
    coefficients=coefficients,
    response=response,
)

MODEL = Model(
    coordinates=COORDINATES,
    controlled=COORDINATES,
    parameters=PARAMETERS,
    coefficient_names=(),
    coefficients=coefficients,
    effort=effort,
)
