"""Uniform periodic cubic B-spline in time (thesis: "3rd order spline functions of time", Fig. 2.2).

Knot spacing 1 s, period 12 s. It does not interpolate its control points: for amplitude A the peak
is 0.83592 A and the rms 0.47716 A.
"""

import math

from fpt_ros.disturbances import Disturbance, scales
from fpt_ros.laws import MutableVector, Vector

CONTROL_POINTS = tuple(c / 70.0 for c in (0, 30, 60, 20, -40, -70, -30, 10, 50, 40, -20, -50))


def force(constants: Vector, state: MutableVector, t: float, h: float, q: float, v: float) -> float:
    """Force at t [s]; ``frequency`` in knots per second."""
    amplitude, frequency = constants[0], constants[1]
    n = len(CONTROL_POINTS)
    knot = math.floor(frequency * t)
    s = frequency * t - knot
    c0 = CONTROL_POINTS[knot % n]
    c1 = CONTROL_POINTS[(knot + 1) % n]
    c2 = CONTROL_POINTS[(knot + 2) % n]
    c3 = CONTROL_POINTS[(knot + 3) % n]
    u = 1.0 - s
    b0, b3 = u * u * u, s * s * s
    b1 = (3.0 * s - 6.0) * s * s + 4.0
    b2 = ((-3.0 * s + 3.0) * s + 3.0) * s + 1.0
    return amplitude * (b0 * c0 + b1 * c1 + b2 * c2 + b3 * c3) / 6.0


BSPLINE = Disturbance(scales, force)
