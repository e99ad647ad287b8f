"""Abstract rotations (Csanadi, Galambos, Tar, Gyorok and Serester 2018): steps without a sigmoid.

Observed response f, desired response and r are lifted onto a sphere of radius R in one dimension
more, a = (f, sqrt(R^2 - |f|^2)), b and c likewise. The rotation of the plane of a and b that would
take a to b turns c by the part A of its angle::

    u = a / R,  v = unit(b - (u.b) u),  phi = A angle(a, b)
    c' = c + sin phi (v (u.c) - u (v.c)) + (cos phi - 1) (u (u.c) + v (v.c))

r' is c' without its last number, so |r'| <= R by construction, and for responses far below R it is
r - A h. Larger ones are taken as if they were of size R. Weights of the response error do nothing.
"""

import math

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.transformations import TINY, Transformation

PARAMETERS = (
    Parameter("A", "part of the angle by which r is turned: lambda of the source", 0.5),
    Parameter("R", "radius of the sphere, larger than the responses", 1e4, above=0.0),
)


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (A, R)."""
    return number(values, "A"), number(values, "R")


@helper
def shrunk(x: Vector, radius: float) -> float:
    """Factor that brings a vector into the ball."""
    square = 0.0
    for each in x:
        square += each * each
    size = math.sqrt(square)
    return radius / size if size > radius else 1.0


@helper
def height(x: Vector, factor: float, radius: float) -> float:
    """The last number of the lifted vector."""
    square = radius * radius
    for each in x:
        square -= factor * factor * each * each
    return math.sqrt(max(square, 0.0))


def deform(
    constants: Vector, r: Vector, h: Vector, f: Vector, desired: Vector, out: MutableVector
) -> None:
    """The turned r; where f is the desired response, r itself."""
    gain, radius = constants[0], constants[1]
    n, error = len(r), 0.0
    for i in range(n):
        error += h[i] * h[i]
    s_a, s_b, s_c = shrunk(f, radius), shrunk(desired, radius), shrunk(r, radius)
    a_last, b_last, c_last = (
        height(f, s_a, radius),
        height(desired, s_b, radius),
        height(r, s_c, radius),
    )
    # b = cosine a + radius sine v; the difference b - a is taken first, as both are close
    along = a_last * (b_last - a_last)
    for i in range(n):
        along += s_a * f[i] * (s_b * desired[i] - s_a * f[i])
    cosine = 1.0 + along / (radius * radius)
    square = (b_last - cosine * a_last) * (b_last - cosine * a_last)
    for i in range(n):
        across = s_b * desired[i] - cosine * s_a * f[i]
        square += across * across
    size = math.sqrt(square)
    if not (size > TINY and math.sqrt(error) > TINY):
        for i in range(n):
            out[i] = r[i]
        return
    phi = gain * math.atan2(size / radius, cosine)
    u_c = a_last * c_last / radius
    v_c = (b_last - cosine * a_last) / size * c_last
    for i in range(n):
        c = s_c * r[i]
        u_c += s_a * f[i] / radius * c
        v_c += (s_b * desired[i] - cosine * s_a * f[i]) / size * c
    half = math.sin(0.5 * phi)
    sine, less = math.sin(phi), -2.0 * half * half
    for i in range(n):
        u, v = s_a * f[i] / radius, (s_b * desired[i] - cosine * s_a * f[i]) / size
        out[i] = s_c * r[i] + sine * (v * u_c - u * v_c) + less * (u * u_c + v * v_c)


def slope(constants: Vector) -> float:
    """Of r' = r - A h, for |h| << R."""
    return -1.0


def step_limit(constants: Vector) -> float:
    """R: no r' is longer."""
    return constants[1]


ROTATION = Transformation(PARAMETERS, prepare, deform, slope, step_limit)
