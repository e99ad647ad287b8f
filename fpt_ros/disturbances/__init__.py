"""External forces that nobody in the loop knows, one a file."""

from collections.abc import Callable
from dataclasses import dataclass

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.registry import Kind

Force = Callable[[Vector, MutableVector, float, float, float, float], float]
"""(constants, state, t, h, q, v) -> force"""


@dataclass(frozen=True)
class Disturbance:
    """A force on one coordinate, beside the control effort.

    Attributes:
        prepare: ``prepare(values, seed, cycles)``: checked parameters, with the prefix
            ``disturbance.``, -> constants. ``amplitude`` and ``frequency`` are parameters of every
            disturbance: factors of the force and of its time.
        force: ``force(constants, state, t, h, q, v)`` at t [s], in the unit of the effort, at the
            position q and the velocity v of its coordinate; a state is advanced by h [s].
        parameters: its own.
        state: number of state variables, zero at the start.
    """

    prepare: Callable[[Values, int, int], tuple[float, ...]]
    force: Force
    parameters: tuple[Parameter, ...] = ()
    state: int = 0


def scales(values: Values, seed: int, cycles: int) -> tuple[float, ...]:
    """Constants (amplitude, frequency)."""
    return number(values, "disturbance.amplitude"), number(values, "disturbance.frequency")


def _none(constants: Vector, state: MutableVector, t: float, h: float, q: float, v: float) -> float:
    return 0.0


NONE = Disturbance(scales, _none)

DISTURBANCES: Kind[Disturbance] = Kind(Disturbance, "disturbances")
