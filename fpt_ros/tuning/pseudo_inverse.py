"""Tuning by the pseudo-inverse of Moore and Penrose, or a damped one (thesis, chapter 2).

The known term is E = Y (Theta - Theta^). Of all errors of the coefficients that explain it the
smallest one is made to decay with the rate alpha::

    Theta^' = alpha Y^T (Y Y^T + mu I)^-1 E

``moore_penrose``: mu = 0; near a singularity of Y Y^T it is inconvenient, in one there is none
(NaN, the run ends). ``damped``: mu > 0 is always defined, and distorts the solution everywhere.
Y Y^T = L L^T (Cholesky).
"""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.tuning import Seen, TuningLaw

ALPHA = Parameter("alpha", "rate at which the known part of the error decays", 1.0, unit="1/s")

MU = Parameter("mu", "what is added to the diagonal of Y Y^T", 1.0, above=0.0)


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (alpha, 0)."""
    return number(values, "alpha"), 0.0


def prepare_damped(values: Values) -> tuple[float, ...]:
    """Constants (alpha, mu)."""
    return number(values, "alpha"), number(values, "mu")


def memory(constants: Vector, size: int, rows: int, n: int) -> int:
    """Work space: L and the solution."""
    return rows * rows + rows


def update(
    constants: Vector, memory: MutableVector, dt: float, values: MutableVector, seen: Seen
) -> None:
    """One Euler step."""
    Y, error = seen.Y, seen.error
    rows, size = len(error), len(values)
    x = rows * rows
    for i in range(rows):
        for k in range(i + 1):
            total = constants[1] if i == k else 0.0
            for j in range(size):
                total += Y[i * size + j] * Y[k * size + j]
            for j in range(k):
                total -= memory[i * rows + j] * memory[k * rows + j]
            if i == k:
                memory[i * rows + i] = math.sqrt(total) if total > 0.0 else math.nan
            else:
                memory[i * rows + k] = total / memory[k * rows + k]
        total = error[i]
        for j in range(i):
            total -= memory[i * rows + j] * memory[x + j]
        memory[x + i] = total / memory[i * rows + i]
    for i in range(rows - 1, -1, -1):
        total = memory[x + i]
        for j in range(i + 1, rows):
            total -= memory[j * rows + i] * memory[x + j]
        memory[x + i] = total / memory[i * rows + i]
    for j in range(size):
        rate = 0.0
        for i in range(rows):
            rate += Y[i * size + j] * memory[x + i]
        values[j] = values[j] + dt * (constants[0] * rate)


MOORE_PENROSE = TuningLaw((ALPHA,), prepare, update, memory=memory)
DAMPED = TuningLaw((ALPHA, MU), prepare_damped, update, memory=memory)
