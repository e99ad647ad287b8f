"""Model-free control, iPID (Fliess and Join 2013): an ultra-local model of each coordinate.

    q'' = F + tau / m,   tau = m (r - F^)

F is everything else, taken to be constant over a window of T seconds. Its algebraic estimate from
the velocity is a mean with the weights of a parabola (their equation for a model of first order,
by parts)::

    F^ = 6 / T^3  int_0^T  x (T - x) (q''(t - x) - tau(t - x) / m) dx

Here the window is N cycles, x in their middles, and the weights sum to 1. With N = 1 it is time
delay control. m is a factor to be chosen, no inertia that is known; it takes the place of the
model's effort.
"""

import math

from fpt_ros.compensators import Compensator, Observed, inertia
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer

PARAMETERS = (
    *inertia.PARAMETERS,
    Parameter("window", "N: cycles that F is taken from", 3, minimum=1, maximum=1000, live=False),
)


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: m times the factor, n of them, then N weights, the newest first."""
    count = integer(values, "compensator.window")
    parabola = [(k + 0.5) * (count - k - 0.5) for k in range(count)]
    whole = sum(parabola)
    return (*inertia.inertias(values, n), *(x / whole for x in parabola))


def memory(constants: Vector, n: int) -> int:
    """The last N values of F of each coordinate, the newest first, and how many there are."""
    return n * (len(constants) - n + 1)


def compensate(
    constants: Vector, memory: MutableVector, dt: float, observed: Observed, out: MutableVector
) -> None:
    """Estimate F from what there is, and take it away."""
    n = len(out)
    window = len(constants) - n
    for i in range(n):
        m, first, count = constants[i], i * window, n * window + i
        F = observed.response[i] - observed.effort[i] / m
        if not math.isnan(F):
            for k in range(window - 1, 0, -1):
                memory[first + k] = memory[first + k - 1]
            memory[first] = F
            memory[count] = min(memory[count] + 1.0, float(window))
        total, weight = 0.0, 0.0
        for k in range(int(memory[count])):
            total += constants[n + k] * memory[first + k]
            weight += constants[n + k]
        wanted = observed.desired[i]
        if weight > 0.0 and not math.isnan(wanted):
            out[i] = m * (wanted - total / weight)


MODEL_FREE = Compensator(prepare, compensate, memory, PARAMETERS)
