"""The precursor observer (thesis, section 1.1, [43]), and the guard that acts on it.

Before control is lost the iteration converges with oscillations from cycle to cycle. They show in
the deformed response alone, without any model: successive steps d_k = r_k - r_{k-1} then point
against each other. The index

    p <- beta p + (1 - beta) d_k . d_{k-1} / (||d_k|| ||d_{k-1}||)

is 1 for a motion that is smooth from cycle to cycle and goes to -1 where r alternates. The guard
lowers the gain by a factor, a little every cycle, for as long as p is below ``ALARM``.
"""

import math

from fpt_ros.laws import MutableVector, Vector, helper

BETA = 0.98
"""Forgetting factor: the index looks back about 50 cycles."""

ALARM = -0.3
"""Index below which the guard acts."""

RATE = 0.005
"""Part of the gain that the guard takes away in a cycle."""


def memory_size(n: int) -> int:
    """State variables for n coordinates: p, the last r and the last step."""
    return 1 + 2 * n


@helper
def observe(memory: MutableVector, r: Vector) -> float:
    """The index after one more deformed response; NaN marks what is not controlled."""
    n = len(r)
    product, now, before = 0.0, 0.0, 0.0
    for i in range(n):
        step, last = r[i] - memory[1 + i], memory[1 + n + i]
        memory[1 + i], memory[1 + n + i] = r[i], step
        if not math.isnan(step) and not math.isnan(last):
            product += step * last
            now += step * step
            before += last * last
    size = math.sqrt(now) * math.sqrt(before)
    if size > 0.0:
        memory[0] = BETA * memory[0] + (1.0 - BETA) * (product / size)
    return memory[0]


@helper
def guarded(factor: float, index: float) -> float:
    """The factor of the gain in the next cycle."""
    return factor * (1.0 - RATE) if index < ALARM else factor
