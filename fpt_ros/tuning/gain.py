"""Calculation of the gain in the place of its tuning (thesis (3.19), (3.20)).

    b <- beta b + ||h||,   |A| = W / (epsilon + (1 - beta) b)

so that A ||h|| stays at about W, between the two fixed points of F. (3.20) gives |A|; the sign is
that of convergence. The infinite past of (3.19) is filled with the first value. epsilon decides how
far |A| grows as the error vanishes; "small" is not to be below W / |A| at the onset of chattering.
"""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.tuning import GAIN, Seen, TuningLaw

PARAMETERS = (
    Parameter("W", "width that A ||h|| is held at", 0.16, above=0.0),
    Parameter("epsilon", "limits |A| to W / epsilon", 0.05, above=0.0),
    Parameter("beta", "forgetting factor of the response error", 0.99, above=0.0, maximum=1.0),
    Parameter("sign", "sign of A", -1.0, minimum=-1.0, maximum=1.0),
)


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (W, epsilon, beta, sign)."""
    return tuple(number(values, parameter.name) for parameter in PARAMETERS)


def memory(constants: Vector, size: int, rows: int, n: int) -> int:
    """The mean response error, and whether there has been one."""
    return 2


def update(
    constants: Vector, memory: MutableVector, dt: float, values: MutableVector, seen: Seen
) -> None:
    """The gain of this cycle, from its response error."""
    h = seen.h
    W, epsilon, beta = constants[0], constants[1], constants[2]
    square = 0.0
    for i in range(len(h)):
        square += h[i] * h[i]
    size = math.sqrt(square)
    # memory[0] is (1 - beta) b
    memory[0] = beta * memory[0] + (1.0 - beta) * size if memory[1] != 0.0 else size
    memory[1] = 1.0
    values[0] = constants[3] * W / (epsilon + memory[0])


CALCULATED = TuningLaw(
    PARAMETERS, prepare, update, tunes=GAIN, memory=memory, desired=True, signals=("mean_error",)
)
