"""A law to be tried, and the watched vectors that it is given."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from fpt_ros.experiments.watched import Watched

READ, KEEP, OUT = "read", "keep", "out"

Point = tuple[list[float], list[float]]
"""Position and velocity of all coordinates."""


@dataclass(frozen=True)
class Trial:
    """A law to be tried.

    Attributes:
        name: what messages call it: the parameter that chose it, its name, what it computes.
        law: the function.
        takes: names of its arguments, as its kind has them.
        calls: fresh arguments for each call.
        gives_number: it returns a number; others return nothing.
    """

    name: str
    law: Callable[..., Any]
    takes: tuple[str, ...]
    calls: Callable[[], list[tuple[Any, ...]]]
    gives_number: bool = False

    def written(self) -> list[str]:
        """Names of what it writes its results into."""
        outs = [name for name in self.takes if name.startswith("out") or name == "acted"]
        return outs or ["values"]


def read(names: str, *vectors: Sequence[float]) -> tuple[Watched, ...]:
    """Vectors that are only read."""
    return tuple(Watched(n, x, READ) for n, x in zip(names.split(), vectors, strict=True))


def keep(name: str, values: Sequence[float]) -> Watched:
    """A vector that is read and written."""
    return Watched(name, values, KEEP)


def out(name: str, size: int) -> Watched:
    """A vector that has to be written."""
    return Watched(name, [0.0] * size, OUT)


def split(names: str) -> tuple[str, ...]:
    """Names of arguments, one a word."""
    return tuple(names.split())
