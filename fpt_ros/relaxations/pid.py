"""Second order plants: (d/dt + Lambda)^3 int e = 0 (thesis (2.25), (4.11d))."""

from fpt_ros.laws import Vector
from fpt_ros.relaxations import Relaxation


def prescribe(
    constants: Vector, nominal: float, e: float, e_dot: float, e_integral: float
) -> float:
    """Return q''Des = q''N + 3 Lambda^2 e + 3 Lambda e' + Lambda^3 int e."""
    lam = constants[0]
    return nominal + lam * (lam * (3.0 * e + lam * e_integral) + 3.0 * e_dot)


PID = Relaxation(prescribe, order=2)
