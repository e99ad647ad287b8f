"""First order plants: (d/dt + Lambda)^2 int e = 0 (thesis (3.4))."""

from fpt_ros.laws import Vector
from fpt_ros.relaxations import Relaxation


def prescribe(
    constants: Vector, nominal: float, e: float, e_dot: float, e_integral: float
) -> float:
    """Return v'Des = v'N + 2 Lambda e + Lambda^2 int e (3.4)."""
    lam = constants[0]
    return nominal + lam * (2.0 * e + lam * e_integral)


PI = Relaxation(prescribe, order=1)
