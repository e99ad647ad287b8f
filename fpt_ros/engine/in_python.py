"""The loop as the Python that it is, for laws that cannot be compiled.

Its records are the stages' own lists and views of memory, whose numbers are Python's: those of
NumPy's arrays take twice as long.
"""

import traceback
from array import array
from collections.abc import Callable, Sequence
from functools import partial
from types import TracebackType
from typing import Any

from fpt_ros.cycle import loop as cycle
from fpt_ros.cycle.loop import CycleConstants, CycleMemory, CycleRows, CycleWork
from fpt_ros.engine.types import Array
from fpt_ros.errors import RunFailed

BY_ELEMENT = " (a law reads and writes its vectors element by element, without slices)"

PIECE = 32
"""Cycles whose rows are prepared at a time; each row of a message is an object of 200 bytes.

More of them would leave the processor's cache, and Python looks for garbage among them."""

NOTHING: "memoryview[float]" = memoryview(array("d"))


def in_python(laws: tuple[Callable[..., Any], ...]) -> Callable[..., int]:
    """The loop with these laws: what Python raises ends a cycle as a NaN does."""
    loop: Callable[..., int] = cycle.run
    whole = partial(loop, *laws)

    def run(
        constants: CycleConstants, memory: CycleMemory, work: CycleWork, rows: CycleRows
    ) -> int:
        for first in range(rows.first, rows.last, PIECE):
            last = min(first + PIECE, rows.last)
            piece = _piece(rows, first, last)
            try:
                reached = whole(constants, memory, work, piece)
            except (ArithmeticError, ValueError) as error:
                return _cycle_of(error.__traceback__)
            except Exception as error:
                where = traceback.extract_tb(error.__traceback__)[-1]
                hint = BY_ELEMENT if isinstance(error, TypeError) else ""
                raise RunFailed(
                    f"cycle {_cycle_of(error.__traceback__)}: {type(error).__name__} in "
                    f"{where.filename}, line {where.lineno}: {error}{hint}"
                ) from error
            if reached < last:
                return reached
        return rows.last

    return run


def _cycle_of(trace: TracebackType | None) -> int:
    """The cycle that the loop was in when something was raised."""
    while trace is not None and trace.tb_frame.f_code is not cycle.run.__code__:
        trace = trace.tb_next
    assert trace is not None
    return int(trace.tb_frame.f_locals["k"])


def _piece(rows: CycleRows, first: int, last: int) -> CycleRows:
    """The rows of some cycles, each a view."""
    start, end = first - rows.first, last - rows.first
    parts: Any = {
        name: type(each)(*[_views(matrix, start, end) for matrix in each])
        for name, each in rows._asdict().items()
        if isinstance(each, tuple)
    }
    parts["noise"] = _views(rows.noise, start, end)  # type: ignore[arg-type]  # the engine's array
    return rows._replace(first=first, last=last, **parts)


def _views(matrix: Array, start: int, end: int) -> Sequence["memoryview[float]"]:
    n = matrix.shape[1]
    if n == 0:  # a view of memory cannot be of nothing
        return [NOTHING] * (end - start)
    flat = matrix.data.cast("B").cast("d")
    return [flat[at : at + n] for at in range(start * n, end * n, n)]
