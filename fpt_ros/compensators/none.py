"""Nothing is added to the model's effort."""

from fpt_ros.compensators import Compensator, Observed
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Values


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """No constants."""
    return ()


def compensate(
    constants: Vector, memory: MutableVector, dt: float, observed: Observed, out: MutableVector
) -> None:
    """Leave the effort as it is."""


NONE = Compensator(prepare, compensate, acts=False)
