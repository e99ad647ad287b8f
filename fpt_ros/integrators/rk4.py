"""The classical Runge-Kutta method of order 4 (Kutta 1901): four responses a step."""

from functools import cache

from fpt_ros.integrators import Integrate, Integrator
from fpt_ros.integrators.slopes import START, keep_start, slopes_of, vectors
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.plants import Response

STAGES = 4

TABLEAU = (
    *(0.0, 0.0, 0.0, 0.0),
    *(0.5, 0.0, 0.0, 0.0),
    *(0.0, 0.5, 0.0, 0.0),
    *(0.0, 0.0, 1.0, 0.0),
)

WEIGHTS = (1.0, 2.0, 2.0, 1.0)
"""Of the slopes, in sixths."""


@cache
def over(response: Response) -> Integrate:
    """The law for this response."""
    slopes = slopes_of(response, TABLEAU, STAGES)

    def integrate(
        constants: Vector,
        order: int,
        h: float,
        coefficients: Vector,
        effort: Vector,
        q: MutableVector,
        v: MutableVector,
        a: MutableVector,
        work: MutableVector,
    ) -> None:
        n = len(q)
        if order == 0:
            response(coefficients, q, v, effort, a)
            for i in range(n):
                q[i] = a[i]
            return
        keep_start(q, v, work)
        slopes(0, STAGES, h, order, coefficients, effort, q, v, a, work)
        for i in range(n):
            dq, dv = 0.0, 0.0
            for stage in range(STAGES):
                at = (START + 2 * stage) * n + i
                dq += WEIGHTS[stage] * work[at]
                dv += WEIGHTS[stage] * work[at + n]
            q[i] = work[i] + h * (dq / 6.0)
            v[i] = work[n + i] + h * (dv / 6.0) if order == 2 else dq / 6.0

    return integrate


RK4 = Integrator(over, vectors=vectors(STAGES))
