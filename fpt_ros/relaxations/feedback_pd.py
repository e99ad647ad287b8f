"""PD control of second order plants: the error alone, without the nominal acceleration."""

from fpt_ros.laws import Vector
from fpt_ros.relaxations import Relaxation


def prescribe(
    constants: Vector, nominal: float, e: float, e_dot: float, e_integral: float
) -> float:
    """Return Lambda^2 e + 2 Lambda e': both poles at -Lambda for a unit mass."""
    lam = constants[0]
    return lam * lam * e + 2.0 * lam * e_dot


FEEDBACK_PD = Relaxation(prescribe, order=2)
