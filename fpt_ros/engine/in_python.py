"""The loop as the Python that it is, for laws that cannot be compiled."""

import traceback
from collections.abc import Callable
from typing import Any

from fpt_ros.cycle import loop as cycle
from fpt_ros.cycle.loop import CycleConstants, CycleMemory, CycleRows, CycleWork
from fpt_ros.errors import RunFailed


def in_python(laws: tuple[Callable[..., Any], ...]) -> Callable[..., int]:
    """The loop with these laws, cycle by cycle: what Python raises ends a cycle as a NaN does."""

    def run(
        first: int,
        last: int,
        constants: CycleConstants,
        memory: CycleMemory,
        work: CycleWork,
        rows: CycleRows,
    ) -> int:
        for k in range(first, last):
            row = _row(rows, k - first)
            try:
                reached = cycle.run(*laws, k, k + 1, constants, memory, work, row)
            except (ArithmeticError, ValueError):
                return k
            except Exception as error:
                where = traceback.extract_tb(error.__traceback__)[-1]
                raise RunFailed(
                    f"cycle {k}: {type(error).__name__} in {where.filename}, line {where.lineno}: "
                    f"{error}"
                ) from error
            if reached == k:
                return k
        return last

    return run


def _row(rows: CycleRows, i: int) -> CycleRows:
    """The rows of one cycle."""
    parts: Any = [type(each)(*[matrix[i : i + 1] for matrix in each]) for each in rows[:-1]]
    return CycleRows(*parts, rows.noise[i : i + 1])
