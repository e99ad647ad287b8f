"""The types that all laws share.

A law is written on plain numbers, element by element: it reads its vectors by index, writes its
results into ``out``, and keeps what it remembers in a small ``state`` vector. Such code runs as it
stands on tuples, lists, arrays and mapped memory, gives the same bits on all of them, and is
compiled as it stands by :mod:`fpt_ros.engine.compiled`. So it uses no slices, no ``**``, no
allocation, and raises nothing: where it is not defined it writes NaN, and the stage says what is
wrong.

The aliases below are the only types that a law's signature may hold, beside numbers and records
(``NamedTuple`` classes made of the same). The types of machine code are derived from them.
"""

import math
from collections.abc import Callable, MutableSequence, Sequence
from typing import Annotated, Any, Protocol, TypeVar, overload

Vector = Sequence[float]
"""Numbers that are only read: one per coordinate, or a law's constants in their order."""

MutableVector = MutableSequence[float]
"""Numbers that a law writes: a result, or its state."""

Indices = Sequence[int]
"""Places of coordinates in a vector."""

Switch = Annotated[int, "switch"]
"""A whole number of a stage's constants that chooses between ways, yes or no for example.

A specialised loop holds the ways that are chosen and no others (:mod:`fpt_ros.engine.switches`)."""


class Matrix(Protocol):
    """Rows of numbers: ``m[row, column]`` is read and written, ``m[row]`` is a vector."""

    @overload
    def __getitem__(self, at: tuple[int, int], /) -> float: ...

    @overload
    def __getitem__(self, at: int, /) -> MutableVector: ...

    def __setitem__(self, at: tuple[int, int], value: float, /) -> None:
        """Write a number."""

    def __len__(self) -> int:
        """Number of rows."""


NOT_CONTROLLED = math.nan
"""Marks, in a vector over all coordinates, those that nobody prescribes in this cycle."""

Function = TypeVar("Function", bound=Callable[..., Any])

HELPERS: list[Callable[..., Any]] = []
"""Plain functions that laws call, in the order of their definition; see :func:`helper`."""


def helper(function: Function) -> Function:
    """Mark a function that laws may call: it is compiled with them. It stays what it is."""
    HELPERS.append(function)
    return function


@helper
def clipped(x: float, lowest: float, highest: float) -> float:
    """The number nearest to x within the bounds; NaN stays."""
    if x > highest:
        return highest
    return lowest if x < lowest else x


@helper
def norm(h: Vector) -> float:
    """Euclidean norm of a vector."""
    total = 0.0
    for x in h:
        total += x * x
    return math.sqrt(total)
