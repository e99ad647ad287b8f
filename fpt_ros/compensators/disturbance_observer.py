"""A disturbance observer on the inverse model (Ohnishi 1987; Sariyildiz and Ohnishi 2015).

The effort that the approximate model needs for the response observed, less the effort that was
exerted, is the effort of disturbance and model error together; filtered by a first order low pass
of cut-off g [rad/s] it is taken away::

    d <- d + (1 - exp(-g dt)) (explained - effort - d),   effort <- effort - d

It has the fixed point idea in common with the transformations, but works on efforts, and its
convergence follows from g alone.
"""

import math

from fpt_ros.compensators import Compensator, Observed
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (Parameter("cutoff", "of the low pass", 100.0, unit="rad/s", above=0.0),)


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants (1 - exp(-g dt),)."""
    return (-math.expm1(-number(values, "compensator.cutoff") * dt),)


def memory(constants: Vector, n: int) -> int:
    """The estimated efforts d of disturbance and model error."""
    return n


def compensate(
    constants: Vector, memory: MutableVector, dt: float, observed: Observed, out: MutableVector
) -> None:
    """Advance d where a response is known, and take it away."""
    for i in range(len(out)):
        gap = observed.explained[i] - observed.effort[i]
        if not math.isnan(gap):
            memory[i] += constants[0] * (gap - memory[i])
        out[i] -= memory[i]


DISTURBANCE_OBSERVER = Compensator(prepare, compensate, memory, PARAMETERS)
