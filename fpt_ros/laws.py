"""The types that all laws share.

A law is written on plain numbers, element by element: it reads its vectors by index, writes its
results into ``out``, and keeps what it remembers in a small ``state`` vector. Such code runs as it
stands on tuples, lists, arrays and mapped memory, gives the same bits on all of them, and can be
compiled.
"""

import math
from collections.abc import MutableSequence, Sequence

Vector = Sequence[float]
"""Numbers that are only read: one per coordinate, or a law's constants in their order."""

MutableVector = MutableSequence[float]
"""Numbers that a law writes: a result, or its state."""

NOT_CONTROLLED = math.nan
"""Marks, in a vector over all coordinates, those that nobody prescribes in this cycle."""


def norm(h: Vector) -> float:
    """Euclidean norm of a vector."""
    total = 0.0
    for x in h:
        total += x * x
    return math.sqrt(total)
