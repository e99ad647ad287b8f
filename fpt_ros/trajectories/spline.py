"""Periodic cubic spline: the nominal trajectory of TORA (section 3.2.2: linear pieces of q''^N).

Knots every 0.5 s with the values 0, .7, 1, .7, 0, -.7, -1, -.7, 0: twice continuously
differentiable, period 4 s, close to a sine. ``frequency`` is a factor of time: 1 keeps the period.
"""

from functools import cache

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Values
from fpt_ros.trajectories import Trajectory, scales

SPACING = 0.5
VALUES = (0.0, 0.7, 1.0, 0.7, 0.0, -0.7, -1.0, -0.7, 0.0)
PERIOD = SPACING * (len(VALUES) - 1)
LAST = len(VALUES) - 2


@cache
def pieces() -> tuple[tuple[float, ...], ...]:
    """Each piece as (c0, c1, c2, c3): x = c0 + c1 s + c2 s^2 + c3 s^3, s [s] from its knot."""
    from scipy.interpolate import CubicSpline

    knots = [SPACING * i for i in range(len(VALUES))]
    spline = CubicSpline(knots, VALUES, bc_type="periodic")
    return tuple(tuple(float(c) for c in piece[::-1]) for piece in spline.c.T)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: c amplitudes, c frequencies, then the pieces, four numbers each."""
    return (*scales(values, c), *(x for piece in pieces() for x in piece))


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """Spline scaled by ``amplitude`` [unit of the coordinate], time scaled by ``frequency``."""
    c = len(out_q)
    for i in range(c):
        a, w = constants[i], constants[c + i]
        phase = w * t % PERIOD
        index = min(int(phase / SPACING), LAST)
        s = phase - index * SPACING
        at = 2 * c + 4 * index
        c0, c1, c2, c3 = constants[at], constants[at + 1], constants[at + 2], constants[at + 3]
        out_q[i] = a * (c0 + s * (c1 + s * (c2 + s * c3)))
        out_v[i] = a * w * (c1 + s * (2.0 * c2 + s * (3.0 * c3)))
        out_a[i] = a * w * w * (2.0 * c2 + s * (6.0 * c3))


SPLINE = Trajectory(prepare, nominal)
