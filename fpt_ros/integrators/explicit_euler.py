"""Explicit Euler, as the thesis has it: q += h q', q' += h q''(q, q'), both of the start."""

from functools import cache

from fpt_ros.integrators import Integrate, Integrator
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.plants import Response


@cache
def over(response: Response) -> Integrate:
    """The law for this response."""

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
        response(coefficients, q, v, effort, a)
        for i in range(len(q)):
            if order == 2:
                q[i] += h * v[i]
                v[i] += h * a[i]
            elif order == 1:
                q[i] += h * a[i]
                v[i] = a[i]
            else:
                q[i] = a[i]

    return integrate


EXPLICIT_EULER = Integrator(over)
