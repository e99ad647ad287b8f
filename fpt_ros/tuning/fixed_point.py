"""Tuning by a fixed point iteration (thesis, section 2.5): MAIDRC.

The known term a = Y (Theta - Theta^) is solved for w with Y Y^T w = a by the same kind of iteration
that deforms the response; then Theta^' = alpha Y^T w::

    w <- G(w, Y Y^T w, a)   with F(x) = atanh(tanh(x + D) / 2), and A / ||Y Y^T||_F as its gain

A few steps a cycle are enough where w is kept from cycle to cycle (warm start). The thesis's gain,
not divided by the norm, converges only where the largest eigenvalue of Y Y^T is below 1.7, and it
is 7 to 262 here. The sign of alpha: the print's product of two minuses is positive.
"""

import math

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, flag, integer, number
from fpt_ros.transformations import TINY
from fpt_ros.transformations.atanh import fixed_point, shifted
from fpt_ros.tuning import Seen, TuningLaw

PARAMETERS = (
    Parameter("alpha", "rate of the tuning", 0.3, unit="1/s"),
    Parameter("inner_A", "gain of the inner iteration", -3.0),
    Parameter("inner_D", "shift of its function", 0.3),
    Parameter("inner_steps", "its steps in a cycle", 3, minimum=1, maximum=1000),
    Parameter("warm", "go on from the solution of the cycle before", True),
    Parameter("scaled", "divide the gain by the norm of Y Y^T", True),
)


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (alpha, A, steps, x*, D, warm, scaled)."""
    D = number(values, "inner_D")
    steps = float(integer(values, "inner_steps"))
    warm, scaled = float(flag(values, "warm")), float(flag(values, "scaled"))
    A = number(values, "inner_A")
    return number(values, "alpha"), A, steps, fixed_point(D), D, warm, scaled


def memory(constants: Vector, size: int, rows: int, n: int) -> int:
    """The two signals, w, and work space: Y Y^T and h."""
    return 2 + rows + rows * rows + rows


def update(
    constants: Vector, memory: MutableVector, dt: float, values: MutableVector, seen: Seen
) -> None:
    """Inner iteration, then one Euler step of the coefficients."""
    Y, error = seen.Y, seen.error
    alpha, A, attractive, D = constants[0], constants[1], constants[3], constants[4]
    rows, size = len(error), len(values)
    w, M, e = 2, 2 + rows, 2 + rows + rows * rows
    norm_M, known = 0.0, 0.0
    for i in range(rows):
        known += error[i] * error[i]
        if constants[5] == 0.0:
            memory[w + i] = 0.0
        for k in range(rows):
            product = 0.0
            for j in range(size):
                product += Y[i * size + j] * Y[k * size + j]
            memory[M + i * rows + k] = product
            norm_M += product * product
    gain = A / math.sqrt(norm_M) if constants[6] != 0.0 else A
    residual = 0.0
    steps = int(constants[2])
    for step in range(steps + 1):
        square = 0.0
        for i in range(rows):
            x = -error[i]
            for k in range(rows):
                x += memory[M + i * rows + k] * memory[w + k]
            memory[e + i] = x
            square += x * x
        residual = math.sqrt(square)
        if step < steps and residual > TINY:
            factor = (shifted(D, gain * residual + attractive) - attractive) / residual
            for i in range(rows):
                memory[w + i] += factor * memory[e + i]
    memory[0], memory[1] = math.sqrt(known), residual
    for j in range(size):
        rate = 0.0
        for i in range(rows):
            rate += Y[i * size + j] * memory[w + i]
        values[j] = values[j] + dt * (alpha * rate)


FIXED_POINT = TuningLaw(
    PARAMETERS, prepare, update, memory=memory, signals=("known_term", "inner_residual")
)
