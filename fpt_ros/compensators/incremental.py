"""Incremental nonlinear dynamic inversion, INDI (Sieberling, Chu and Mulder 2010).

Time delay control with the inertia of the approximate model in the place of a constant one: the
effort of the cycle before, and what the model says that the change of the response costs::

    tau_k = tau_{k-1} + [M(q_k) r_k + h_k] - [M(q_{k-1}) response_k + h_{k-1}]
"""

import math

from fpt_ros.compensators import Compensator, Observed
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Values


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """No constants."""
    return ()


def compensate(
    constants: Vector, memory: MutableVector, dt: float, observed: Observed, out: MutableVector
) -> None:
    """The effort of the cycle before, and the model's for the difference."""
    for i in range(len(out)):
        step = out[i] - observed.explained[i]
        if not math.isnan(step):
            out[i] = observed.effort[i] + step


INCREMENTAL = Compensator(prepare, compensate)
