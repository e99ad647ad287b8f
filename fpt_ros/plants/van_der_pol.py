"""Fifth order van der Pol oscillator (thesis, section 2.2).

From (2.1) and (2.2)::

    m q'' + mu (q^2 - c) q' + k q + beta q^3 + lambda q^5 = F

Linear in Theta = (m, mu, mu c, k, beta, lambda): F = Y(q'', q', q) Theta with
Y = (q'', q^2 q', -q', q, q^3, q^5). The thesis gives no units.
"""

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("q1",)

PARAMETERS = (
    Parameter("m", "inertia", above=0.0),
    Parameter("mu", "viscous damping where q^2 > c, excitation elsewhere"),
    Parameter("c", "border between excitation and damping"),
    Parameter("k", "linear stiffness"),
    Parameter("beta", "cubic stiffness"),
    Parameter("lambda", "quintic stiffness"),
)


def coefficients(parameters: Vector) -> tuple[float, ...]:
    """(m, mu, c, k, beta, lambda) -> Theta, which holds the product mu c (2.2)."""
    m, mu, c, k, beta, lam = parameters
    return m, mu, mu * c, k, beta, lam


@helper
def _spring_and_damper(theta: Vector, q: float, v: float) -> float:
    q2 = q * q
    damper = (theta[1] * q2 - theta[2]) * v
    return damper + (theta[3] + (theta[4] + theta[5] * q2) * q2) * q


def response(theta: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """Acceleration q'' caused by the force F (2.1)."""
    out[0] = (effort[0] - _spring_and_damper(theta, q[0], v[0])) / theta[0]


def effort(theta: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """Force F that should cause q'' = r (2.3)."""
    out[0] = theta[0] * r[0] + _spring_and_damper(theta, q[0], v[0])


def regressor(c: Vector, q: Vector, v: Vector, w: Vector, a: Vector, out: MutableVector) -> None:
    """Y = (q'', q^2 q', -q', q, q^3, q^5) (2.2), one row of six."""
    q2 = q[0] * q[0]
    out[0] = a[0]
    out[1] = q2 * v[0]
    out[2] = -v[0]
    out[3] = q[0]
    out[4] = q2 * q[0]
    out[5] = q2 * q2 * q[0]


def trouble(theta: Vector, q: Vector) -> str:
    """The inertia has to be positive: it is the gain from force to response."""
    if theta[0] > 1e-3:
        return ""
    return (
        f"the model's inertia m^ = {theta[0]:g} has to be > 0: the tuning has lost it (a smaller "
        "parameter_tuner.alpha, or less disturbance)"
    )


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
    coefficient_names=("m", "mu", "mu_c", "k", "beta", "lambda"),
    coefficients=coefficients,
    effort=effort,
    regressor=regressor,
    rows=1,
    trouble=trouble,
)
