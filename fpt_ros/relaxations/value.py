"""There is nothing that could decay: a bare iteration (thesis, sections 3.1.1, 3.2.1)."""

from fpt_ros.laws import Vector
from fpt_ros.relaxations import Relaxation


def prescribe(
    constants: Vector, nominal: float, e: float, e_dot: float, e_integral: float
) -> float:
    """Return the nominal response."""
    return nominal


VALUE = Relaxation(prescribe, order=0)
