"""Incremental nonlinear dynamic inversion, INDI (Sieberling, Chu and Mulder 2010).

Time delay control with the inertia of the approximate model in the place of a constant one: the
effort of the cycle before, and what the model says that the change of the response costs::

    tau_k = tau_{k-1} + [M(q_k) r_k + h_k] - [M(q_{k-1}) response_k + h_{k-1}]

Where a response is lost, the effort stays.
"""

import math

from fpt_ros.compensators import Compensator, Observed
from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Values


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """No constants."""
    return ()


def memory(constants: Vector, n: int) -> int:
    """Whether a response of each coordinate has been known."""
    return n


@helper
def go_on(
    memory: MutableVector, i: int, step: float, observed: Observed, out: MutableVector
) -> None:
    """The effort of the cycle before and a step, NaN where the response is not known."""
    if not math.isnan(step):
        memory[i] = 1.0
        out[i] = observed.effort[i] + step
    elif memory[i] != 0.0 and not math.isnan(observed.desired[i]):
        out[i] = observed.effort[i]


def compensate(
    constants: Vector, memory: MutableVector, dt: float, observed: Observed, out: MutableVector
) -> None:
    """The effort of the cycle before, and the model's for the difference."""
    for i in range(len(out)):
        go_on(memory, i, out[i] - observed.explained[i], observed, out)


INCREMENTAL = Compensator(prepare, compensate, memory)
