"""Semi-implicit (symplectic) Euler: q' += h q''(q, q'), then q += h q' with the new velocity.

Order 1 like explicit Euler, but without friction the energy does not drift: it stays within O(h) of
that of the start (Hairer, Lubich and Wanner 2006, Geometric Numerical Integration, I.1.2). Of a
plant of order 1 it is explicit Euler.
"""

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
                v[i] += h * a[i]
                q[i] += h * v[i]
            elif order == 1:
                q[i] += h * a[i]
                v[i] = a[i]
            else:
                q[i] = a[i]

    return integrate


SEMI_IMPLICIT_EULER = Integrator(over)
