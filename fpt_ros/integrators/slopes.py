"""What Runge-Kutta methods share: the slopes of a step's stages.

Work space, in vectors of n numbers: position and velocity of the start, then for each stage the
slope of the position and that of the velocity.
"""

from collections.abc import Callable

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.plants import Response

Slopes = Callable[
    [
        int,
        int,
        float,
        int,
        Vector,
        Vector,
        MutableVector,
        MutableVector,
        MutableVector,
        MutableVector,
    ],
    None,
]
"""(first, stages, h, order, coefficients, effort, q, v, a, work)"""

START = 2
"""Vectors before the slopes of the first stage."""


def vectors(stages: int) -> int:
    """How many vectors of n numbers the work space has."""
    return START + 2 * stages


def keep_start(q: Vector, v: Vector, work: MutableVector) -> None:
    """The start of the step, into the work space."""
    n = len(q)
    for i in range(n):
        work[i], work[n + i] = q[i], v[i]


def slopes_of(response: Response, tableau: tuple[float, ...], stages: int) -> Slopes:
    """Law that evaluates the stages from ``first`` on of a tableau, row after row."""

    def slopes(
        first: int,
        last: int,
        h: float,
        order: int,
        coefficients: Vector,
        effort: Vector,
        q: MutableVector,
        v: MutableVector,
        a: MutableVector,
        work: MutableVector,
    ) -> None:
        n = len(q)
        for stage in range(first, last):
            for i in range(n):
                dq, dv = 0.0, 0.0
                for j in range(stage):
                    weight, at = tableau[stage * stages + j], (START + 2 * j) * n + i
                    dq += weight * work[at]
                    dv += weight * work[at + n]
                q[i] = work[i] + h * dq
                if order == 2:
                    v[i] = work[n + i] + h * dv
            response(coefficients, q, v, effort, a)
            for i in range(n):
                at = (START + 2 * stage) * n + i
                work[at] = v[i] if order == 2 else a[i]
                work[at + n] = a[i]

    return slopes
