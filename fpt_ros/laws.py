"""The types that all laws share.

A law is written on plain numbers, element by element: it reads its vectors by index, writes its
results into ``out``, and keeps what it remembers in a small ``state`` vector. Such code runs as it
stands on tuples, lists, arrays and mapped memory, gives the same bits on all of them, and is
compiled as it stands by :mod:`fpt_ros.engine.compiled`. So it uses no slices, no ``**``, no
allocation, and raises nothing: where it is not defined it writes NaN, and the stage says what is
wrong.
"""

import math
from array import array
from collections.abc import Callable, MutableSequence, Sequence
from typing import Any, TypeVar, cast

Vector = Sequence[float]
"""Numbers that are only read: one per coordinate, or a law's constants in their order."""

MutableVector = MutableSequence[float]
"""Numbers that a law writes: a result, or its state."""

NOT_CONTROLLED = math.nan
"""Marks, in a vector over all coordinates, those that nobody prescribes in this cycle."""

# Signatures of compiled functions are words, a letter an argument and the result last: v vector,
# f number, i integer, w vector of integers, m matrix, - nothing.

Function = TypeVar("Function", bound=Callable[..., Any])

HELPERS: list[Callable[..., Any]] = []
"""Plain functions that laws call, in the order of their definition; see :func:`helper`."""


def helper(function: Function) -> Function:
    """Mark a function that laws may call: it is compiled with them. It stays what it is."""
    HELPERS.append(function)
    return function


def part(state: "array[float]", start: int, end: int | None = None) -> MutableVector:
    """Some of the numbers of a state, to be read and written where they stand."""
    return cast(MutableVector, memoryview(state)[start:end])


@helper
def norm(h: Vector) -> float:
    """Euclidean norm of a vector."""
    total = 0.0
    for x in h:
        total += x * x
    return math.sqrt(total)
