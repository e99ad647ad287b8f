"""Nothing is tuned; the precursor observer may still watch."""

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Values
from fpt_ros.tuning import Seen, TuningLaw


def prepare(values: Values) -> tuple[float, ...]:
    """No constants."""
    return ()


def update(
    constants: Vector, memory: MutableVector, dt: float, values: MutableVector, seen: Seen
) -> None:
    """Leave everything as it is."""


NONE = TuningLaw((), prepare, update, tunes="")
