"""Motions through points given by their times: splines of degree 5, at rest at both ends.

Among all motions through the points at these times, with velocity and acceleration zero at the
first and the last one, it is that of the least integral of the squared jerk (de Boor 1963: natural
splines of odd degree). Before the first point and behind the last one the motion rests there.

Constants: c amplitudes, c frequencies, 1 where it begins anew, the number m of times, the times
[s], then for each coordinate and piece its six coefficients, of the constant term first.
"""

from collections.abc import Sequence

from fpt_ros.laws import MutableVector, Vector

DEGREE = 5


def constants_of(
    scales: tuple[float, ...],
    repeat: bool,
    times: Sequence[float],
    points: Sequence[Sequence[float]],
) -> tuple[float, ...]:
    """Constants for m ascending times [s] and the m points of each coordinate."""
    from scipy.interpolate import PPoly, make_interp_spline

    rest = [(1, 0.0), (2, 0.0)]
    pieces: list[float] = []
    for values in points:
        spline = make_interp_spline(times, values, k=DEGREE, bc_type=(rest, rest))
        polynomial = PPoly.from_spline(spline)
        inside = [i for i, x in enumerate(polynomial.x[:-1]) if polynomial.x[i + 1] > x]
        for i in inside:
            pieces += [float(x) for x in polynomial.c[::-1, i]]
    return (*scales, float(repeat), float(len(times)), *map(float, times), *pieces)


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """The points scaled by ``amplitude``, time by ``frequency``."""
    c = len(out_q)
    repeat, m, first = constants[2 * c], int(constants[2 * c + 1]), 2 * c + 2
    start, end = constants[first], constants[first + m - 1]
    for i in range(c):
        a, w = constants[i], constants[c + i]
        at = w * t
        if repeat > 0.0 and at > end:
            at = start + (at - start) % (end - start)
        moving = start <= at <= end
        at = min(max(at, start), end)
        low, high = 0, m - 1
        while high - low > 1:
            middle = (low + high) // 2
            if constants[first + middle] <= at:
                low = middle
            else:
                high = middle
        s = at - constants[first + low]
        piece = first + m + (DEGREE + 1) * (i * (m - 1) + low)
        q, v, half_a = 0.0, 0.0, 0.0
        for k in range(DEGREE, -1, -1):  # Horner's scheme for value and derivatives
            half_a = half_a * s + v
            v = v * s + q
            q = q * s + constants[piece + k]
        out_q[i] = a * q
        out_v[i] = a * w * v if moving else 0.0
        out_a[i] = a * w * w * 2.0 * half_a if moving else 0.0
