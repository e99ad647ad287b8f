"""Periodic cubic spline: the nominal trajectory of TORA (section 3.2.2: linear pieces of q''^N).

Knots every 0.5 s with the values 0, .7, 1, .7, 0, -.7, -1, -.7, 0: twice continuously
differentiable, period 4 s, close to a sine. ``frequency`` is a factor of time: 1 keeps the period.
"""

from functools import cache

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.trajectories import Trajectory

SPACING = 0.5
VALUES = (0.0, 0.7, 1.0, 0.7, 0.0, -0.7, -1.0, -0.7, 0.0)
PERIOD = SPACING * (len(VALUES) - 1)


@cache
def pieces() -> tuple[tuple[float, ...], ...]:
    """Each piece as (c0, c1, c2, c3): x = c0 + c1 s + c2 s^2 + c3 s^3, s [s] from its knot."""
    from scipy.interpolate import CubicSpline

    knots = [SPACING * i for i in range(len(VALUES))]
    spline = CubicSpline(knots, VALUES, bc_type="periodic")
    return tuple(tuple(float(c) for c in piece[::-1]) for piece in spline.c.T)


def nominal(
    amplitude: Vector,
    frequency: Vector,
    t: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """Spline scaled by ``amplitude`` [unit of the coordinate], time scaled by ``frequency``."""
    cubics = pieces()
    for i in range(len(amplitude)):
        a, w = amplitude[i], frequency[i]
        phase = w * t % PERIOD
        index = min(int(phase / SPACING), len(cubics) - 1)
        s = phase - index * SPACING
        c0, c1, c2, c3 = cubics[index]
        out_q[i] = a * (c0 + s * (c1 + s * (c2 + s * c3)))
        out_v[i] = a * w * (c1 + s * (2.0 * c2 + s * (3.0 * c3)))
        out_a[i] = a * w * w * (2.0 * c2 + s * (6.0 * c3))


SPLINE = Trajectory(nominal)
