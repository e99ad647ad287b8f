"""The loop as the Python that it is, for laws that cannot be compiled."""

import traceback
from collections.abc import Callable
from functools import partial
from typing import Any

from fpt_ros.cycle import loop as cycle
from fpt_ros.cycle.loop import CycleConstants, CycleMemory, CycleRows, CycleWork
from fpt_ros.errors import RunFailed


def in_python(laws: tuple[Callable[..., Any], ...]) -> Callable[..., int]:
    """The loop with these laws, cycle by cycle: what Python raises ends a cycle as a NaN does."""
    loop: Callable[..., int] = cycle.run
    whole = partial(loop, *laws)

    def run(
        constants: CycleConstants, memory: CycleMemory, work: CycleWork, rows: CycleRows
    ) -> int:
        for k in range(rows.first, rows.last):
            row = _row(rows, k)
            try:
                reached = whole(constants, memory, work, row)
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
        return rows.last

    return run


def _row(rows: CycleRows, cycle: int) -> CycleRows:
    """The rows of one cycle."""
    i = cycle - rows.first
    parts: Any = {
        name: type(each)(*[matrix[i : i + 1] for matrix in each])
        for name, each in rows._asdict().items()
        if isinstance(each, tuple)
    }
    noise: Any = rows.noise
    return rows._replace(first=cycle, last=cycle + 1, noise=noise[i : i + 1], **parts)
