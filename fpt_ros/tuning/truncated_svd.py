"""Tuning by a truncated singular value decomposition (thesis, chapter 2, [38, 39]).

Of Y = sum_k sigma_k u_k v_k^T only the sure directions are used, those with sigma_k > sigma_0::

    Theta^' = alpha sum_k (u_k . E) / sigma_k v_k

The rows of Y are turned against each other, two at a time, until all are orthogonal (Hestenes
1958, one-sided Jacobi); the same turns take E to u_k . E, and the rows are sigma_k v_k^T then.
"""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.tuning import Seen, TuningLaw
from fpt_ros.tuning.pseudo_inverse import ALPHA

PARAMETERS = (
    ALPHA,
    Parameter("sigma_0", "singular values up to it are left out", 1.0, minimum=0.0),
)

SWEEPS = 30
"""Most rounds over all pairs of rows; about five are needed."""

ORTHOGONAL = 1e-15
"""Cosine of two rows that are."""


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (alpha, sigma_0)."""
    return number(values, "alpha"), number(values, "sigma_0")


def memory(constants: Vector, size: int, rows: int, n: int) -> int:
    """Work space: the rows and their known terms."""
    return rows * (size + 1)


def update(
    constants: Vector, memory: MutableVector, dt: float, values: MutableVector, seen: Seen
) -> None:
    """One Euler step."""
    Y, error = seen.Y, seen.error
    rows, size = len(error), len(values)
    known = rows * size
    for i in range(rows * size):
        memory[i] = Y[i]
    for i in range(rows):
        memory[known + i] = error[i]
    for _ in range(SWEEPS):
        turned = 0
        for i in range(rows - 1):
            for k in range(i + 1, rows):
                turned += turn(memory, rows, size, i, k)
        if turned == 0:
            break
    least = constants[1] * constants[1]
    for i in range(rows):
        square = 0.0
        for j in range(size):
            square += memory[i * size + j] * memory[i * size + j]
        if square > least:
            factor = constants[0] * memory[known + i] / square
            for j in range(size):
                values[j] = values[j] + dt * (factor * memory[i * size + j])


def turn(memory: MutableVector, rows: int, size: int, i: int, k: int) -> int:
    """Make two rows orthogonal; 0 where they are."""
    alpha, beta, gamma = 0.0, 0.0, 0.0
    for j in range(size):
        x, y = memory[i * size + j], memory[k * size + j]
        alpha += x * x
        beta += y * y
        gamma += x * y
    if not abs(gamma) > ORTHOGONAL * math.sqrt(alpha * beta):
        return 0
    zeta = (beta - alpha) / (2.0 * gamma)
    tangent = 1.0 / (abs(zeta) + math.sqrt(1.0 + zeta * zeta))
    if zeta < 0.0:
        tangent = -tangent
    cosine = 1.0 / math.sqrt(1.0 + tangent * tangent)
    sine = cosine * tangent
    for j in range(size + 1):
        at = i * size + j if j < size else rows * size + i
        to = k * size + j if j < size else rows * size + k
        x, y = memory[at], memory[to]
        memory[at] = cosine * x - sine * y
        memory[to] = sine * x + cosine * y
    return 1


TRUNCATED_SVD = TuningLaw(PARAMETERS, prepare, update, memory=memory)
