"""Second order plants: (d/dt + Lambda)^2 e = 0 (thesis, section 2.3; v' of section 2.4)."""

from fpt_ros.laws import Vector
from fpt_ros.relaxations import Relaxation


def prescribe(
    constants: Vector, nominal: float, e: float, e_dot: float, e_integral: float
) -> float:
    """Return q''Des = q''N + Lambda^2 e + 2 Lambda e'."""
    lam = constants[0]
    return nominal + lam * lam * e + 2.0 * lam * e_dot


PD = Relaxation(prescribe, order=2)
