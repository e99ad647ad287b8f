"""PID control of second order plants: the error alone, without the nominal acceleration."""

from fpt_ros.laws import Vector
from fpt_ros.relaxations import Relaxation


def prescribe(
    constants: Vector, nominal: float, e: float, e_dot: float, e_integral: float
) -> float:
    """Return 3 Lambda^2 e + 3 Lambda e' + Lambda^3 int e: three poles at -Lambda."""
    lam = constants[0]
    return lam * (lam * (3.0 * e + lam * e_integral) + 3.0 * e_dot)


FEEDBACK_PID = Relaxation(prescribe, order=2)
