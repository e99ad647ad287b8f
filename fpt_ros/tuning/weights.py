"""Diagonal weights of the response error, tuned by a forgetting buffer (thesis, section 4.3.2).

Fluctuations in the convergence of r_i show that its weight is too big: over the learning delay
successive steps of r then have different signs. For each controlled coordinate::

    x = (r_n - r_{n-d}) (r_{n-d} - r_{n-2d}),   b <- beta b + (1 - beta) x / (|x| + tiny)
    b < 0:  weight <- max(least, weight (1 - down dt)),   else  min(most, weight (1 + up dt))
"""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number
from fpt_ros.tuning import WEIGHTS, Seen, TuningLaw

PARAMETERS = (
    Parameter("delay", "cycles of the learning delay", 10, minimum=1, maximum=1000, live=False),
    Parameter("beta", "forgetting factor of the buffer", 0.99, minimum=0.0, maximum=1.0),
    Parameter("up", "rate of growth while there are no fluctuations", 0.5, unit="1/s", minimum=0.0),
    Parameter("down", "rate of decrease while there are", 50.0, unit="1/s", minimum=0.0),
    Parameter("least", "smallest weight", 0.1, above=0.0),
    Parameter("most", "largest weight", 10.0, above=0.0),
)


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (delay, beta, up, down, least, most)."""
    rest = tuple(number(values, parameter.name) for parameter in PARAMETERS[1:])
    return (float(integer(values, "delay")), *rest)


def memory(constants: Vector, size: int, rows: int, n: int) -> int:
    """The buffers, the number of cycles, and the last 2 d + 1 deformed responses."""
    return size + 1 + n * (2 * int(constants[0]) + 1)


def update(
    constants: Vector, memory: MutableVector, dt: float, values: MutableVector, seen: Seen
) -> None:
    """One cycle, for controlled coordinates that stand in the order of r, or are all of them."""
    r = seen.r
    delay, beta = int(constants[0]), constants[1]
    n, size = len(r), len(values)
    count = int(memory[size])
    length = 2 * delay + 1
    now = size + 1 + count % length * n
    middle = size + 1 + (count - delay) % length * n
    oldest = size + 1 + (count - 2 * delay) % length * n
    for i in range(n):
        memory[now + i] = r[i]
    memory[size] = count + 1.0
    if count < 2 * delay:
        return
    at = 0
    for i in range(size):
        while math.isnan(r[at]):
            at += 1
        x = (memory[now + at] - memory[middle + at]) * (memory[middle + at] - memory[oldest + at])
        memory[i] = beta * memory[i] + (1.0 - beta) * (x / (abs(x) + 1e-12))
        if memory[i] < 0.0:
            values[i] = max(constants[4], values[i] * (1.0 - constants[3] * dt))
        else:
            values[i] = min(constants[5], values[i] * (1.0 + constants[2] * dt))
        at += 1


TUNED_WEIGHTS = TuningLaw(
    PARAMETERS, prepare, update, tunes=WEIGHTS, memory=memory, desired=True, start=1.0
)
