"""J dq = d without any inverse: the fixed point iteration of [49], for any Jacobian.

Its normal equation is solved by the iteration that deforms responses, a few steps a cycle from the
last cycle's dq on::

    h = J^T J dq - J^T d,   dq <- dq + [F(A ||h|| / ||J^T J|| + x*) - x*] h / ||h||

with F(x) = atanh(tanh(x + D) / 2) and the Frobenius norm of J^T J. Where J is singular the
direction that the arm cannot move in takes no part: nothing is divided by it, and a step is at most
as long as F is high.

A trajectory has the state ``STATE``. Each cycle it writes the Jacobian there, row after row from
its beginning on, and what the tip lacks at ``LACK``, then lets :func:`move` do the rest.
"""

import math

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter, Values, integer, number
from fpt_ros.transformations.atanh import fixed_point, shifted

PARAMETERS = (
    Parameter("inner_A", "gain of the iteration", -2.0),
    Parameter("inner_D", "shift of its function", 0.3),
    Parameter("inner_steps", "its steps in a cycle", 20, minimum=1, maximum=1000),
)

MEMORY = Parameter(
    "inner_memory",
    "part of the last cycle's dq that it starts from",
    1.0,
    minimum=0.0,
    maximum=1.0,
)
"""Of dq, what J does not see stays: with all of it an arm with joints to spare drifts off."""

MOST, ROWS = 8, 3
"""Joints at most, and coordinates of the tip."""

JACOBIAN = 0
Q = ROWS * MOST
STEP, RATE = Q + MOST, Q + 2 * MOST
LACK = Q + 3 * MOST
LEFT, BEGUN = LACK + ROWS, LACK + 2 * ROWS
STATE = (0.0,) * (BEGUN + 1)
"""Where J, q, dq, q', what the tip lacks and J dq less that stand; then 1 from the first cycle."""

TINY = 1e-15


def prepare(values: Values) -> tuple[float, ...]:
    """Constants A, x*, D, steps, memory."""
    D, steps = number(values, "inner_D"), float(integer(values, "inner_steps"))
    return number(values, "inner_A"), fixed_point(D), D, steps, number(values, MEMORY.name)


@helper
def begin(
    constants: Vector,
    start: int,
    state: MutableVector,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """The first cycle: at rest in the posture that stands at ``start``."""
    state[BEGUN] = 1.0
    for i in range(len(out_q)):
        state[Q + i] = out_q[i] = constants[start + i]
        state[STEP + i] = state[RATE + i] = out_v[i] = out_a[i] = 0.0


@helper
def frobenius(state: Vector, m: int, c: int) -> float:
    """||J^T J||, which is that of the m rows and columns of J J^T."""
    total = 0.0
    for r in range(m):
        for s in range(r, m):
            product = 0.0
            for i in range(c):
                product += state[r * c + i] * state[s * c + i]
            total += (1.0 if r == s else 2.0) * product * product
    return math.sqrt(total)


@helper
def improve(
    constants: Vector, at: int, state: MutableVector, m: int, size: float, h: MutableVector
) -> None:
    """One step of the iteration for dq; ``size``: that of J^T J."""
    gain, attractive, D, c = constants[at], constants[at + 1], constants[at + 2], len(h)
    for r in range(m):
        left = -state[LACK + r]
        for i in range(c):
            left += state[r * c + i] * state[STEP + i]
        state[LEFT + r] = left
    square = 0.0
    for i in range(c):
        h[i] = state[i] * state[LEFT]
        for r in range(1, m):
            h[i] += state[r * c + i] * state[LEFT + r]
        square += h[i] * h[i]
    length = math.sqrt(square)
    if length > TINY:
        step = (shifted(D, gain * length / size + attractive) - attractive) / length
        for i in range(c):
            state[STEP + i] += step * h[i]


@helper
def move(
    constants: Vector,
    at: int,
    state: MutableVector,
    m: int,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """The posture of the cycle, and its differences; the constants of ``prepare`` stand at ``at``.

    J has m rows, and a column for each number of ``out_q``.
    """
    c = len(out_q)
    size = frobenius(state, m, c)
    for i in range(c):
        state[STEP + i] *= constants[at + 4]
    for _ in range(int(constants[at + 3])):
        improve(constants, at, state, m, size, out_a)
    for i in range(c):
        state[Q + i] += state[STEP + i]
        out_q[i], out_v[i] = state[Q + i], state[STEP + i] / dt
        out_a[i] = (out_v[i] - state[RATE + i]) / dt
        state[RATE + i] = out_v[i]
