"""The regressor of a tree of joints, and the effort Y Theta + K_D s, on plain numbers.

Each link is looked at from its own joint up to the base, which needs no memory: with the columns
zeta_j (angular) and mu_j (linear) of its Jacobian, its motion is (sums over the joints j that carry
it, k those between j and the link)::

    omega = sum zeta_j v_j
    alpha = sum zeta_j a_j + v_j zeta_j x (sum_k zeta_k v_k)
    acc   = sum mu_j a_j + v_j zeta_j x (mu_j v_j + 2 sum_k mu_k v_k) - gravity

C(q, q') w is that of Christoffel's symbols, for which M' - 2 C is skew-symmetric: as a product that
is the same for (q', w) and (w, q'), it is the difference of two squares, of (w + q') / 2 and of
(w - q') / 2.
"""

import math

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.plants.mujoco.model import STICKING

Three = tuple[float, float, float]
Rotation = tuple[Three, Three, Three]
Ten = tuple[float, float, float, float, float, float, float, float, float, float]

MOMENTS = ("m", "mx", "my", "mz", "Ixx", "Ixy", "Ixz", "Iyy", "Iyz", "Izz")
NUMBERS = (*MOMENTS, "armature", "viscous", "coulomb")
SIZE = len(NUMBERS)
JOINT = 8
"""Constants: n SIZE numbers, n gains K_D, three of gravity, and JOINT of each joint: its parent
(-1: the base), 1 where it turns or 0, axis, and place from its parent's joint, at q = 0."""

NOT_TURNED: Rotation = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@helper
def cross(a: Three, b: Three) -> Three:
    """A x b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@helper
def dot(a: Three, b: Three) -> float:
    """A . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@helper
def plus(a: Three, factor: float, b: Three) -> Three:
    """A + factor b."""
    return (a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2])


@helper
def into(R: Rotation, x: Three) -> Three:
    """R x."""
    return (dot(R[0], x), dot(R[1], x), dot(R[2], x))


@helper
def three(c: Vector, at: int) -> Three:
    """Three constants."""
    return (c[at], c[at + 1], c[at + 2])


@helper
def column(c: Vector, at: int, R: Rotation, rho: Three) -> tuple[Three, Three]:
    """(zeta, mu) of the joint at ``at``, in the link's axes: R turns into them, rho: from it."""
    axis = into(R, three(c, at + 2))
    if c[at + 1] != 0.0:
        return axis, cross(axis, rho)
    return (0.0, 0.0, 0.0), axis


@helper
def up(c: Vector, at: int, q: float, R: Rotation, rho: Three) -> tuple[Rotation, Three]:
    """R and rho of the joint that carries the one at ``at``, which is at q."""
    axis = three(c, at + 2)
    if c[at + 1] != 0.0:  # R times the rotation by -q
        cos, sin = math.cos(q), math.sin(q)
        R = (
            turned(R[0], axis, cos, sin),
            turned(R[1], axis, cos, sin),
            turned(R[2], axis, cos, sin),
        )
    else:
        rho = plus(rho, q, into(R, axis))
    return R, plus(rho, 1.0, into(R, three(c, at + 5)))


@helper
def turned(row: Three, axis: Three, cos: float, sin: float) -> Three:
    """A row of R, turned about the axis (Rodrigues)."""
    straight = plus((cos * row[0], cos * row[1], cos * row[2]), sin, cross(axis, row))
    return plus(straight, (1.0 - cos) * dot(axis, row), axis)


@helper
def motion(
    c: Vector,
    link: int,
    q: Vector,
    v: Vector,
    a: Vector,
    shift: Vector,
    added: float,
    sign: float,
) -> tuple[Three, Three, Three]:
    """(omega, alpha, acc) of a link in its axes at the joints' velocities (w + sign v) / 2.

    w is shift + added v. For the sign -1 neither a nor gravity takes part.
    """
    n = len(q)
    first = n * (SIZE + 1) + 3
    R, rho, j = NOT_TURNED, (0.0, 0.0, 0.0), link
    omega, alpha = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    linear, acc = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    while j >= 0:
        at = first + JOINT * j
        zeta, mu = column(c, at, R, rho)
        speed = 0.5 * (shift[j] + (added + sign) * v[j])
        alpha = plus(alpha, speed, cross(zeta, omega))
        acc = plus(acc, speed, cross(zeta, plus(plus(linear, 1.0, linear), speed, mu)))
        if sign > 0.0 and not math.isnan(a[j]):
            alpha = plus(alpha, a[j], zeta)
            acc = plus(acc, a[j], mu)
        omega = plus(omega, speed, zeta)
        linear = plus(linear, speed, mu)
        R, rho = up(c, at, q[j], R, rho)
        j = int(c[at])
    if sign > 0.0:
        acc = plus(acc, -1.0, into(R, three(c, first - 3)))
    return omega, alpha, acc


@helper
def moments(zeta: Three, mu: Three, omega: Three, alpha: Three, acc: Three) -> Ten:
    """What a joint with this column exerts on a link of this motion, for each of its moments."""
    eta = cross(zeta, omega)
    first = plus(plus(cross(mu, alpha), dot(mu, omega), omega), -dot(omega, omega), mu)
    first = plus(first, 1.0, cross(acc, zeta))
    return (
        dot(mu, acc),
        first[0],
        first[1],
        first[2],
        zeta[0] * alpha[0] + eta[0] * omega[0],
        zeta[0] * alpha[1] + zeta[1] * alpha[0] + eta[0] * omega[1] + eta[1] * omega[0],
        zeta[0] * alpha[2] + zeta[2] * alpha[0] + eta[0] * omega[2] + eta[2] * omega[0],
        zeta[1] * alpha[1] + eta[1] * omega[1],
        zeta[1] * alpha[2] + zeta[2] * alpha[1] + eta[1] * omega[2] + eta[2] * omega[1],
        zeta[2] * alpha[2] + eta[2] * omega[2],
    )


def regressor(c: Vector, q: Vector, v: Vector, w: Vector, a: Vector, out: MutableVector) -> None:
    """Y: n rows of 13 n."""
    n = len(q)
    first, width = n * (SIZE + 1) + 3, n * SIZE
    for i in range(n * width):
        out[i] = 0.0
    for link in range(n):
        omega, alpha, acc = motion(c, link, q, v, a, w, 0.0, 1.0)
        less_omega, less_alpha, less_acc = motion(c, link, q, v, a, w, 0.0, -1.0)
        R, rho, j = NOT_TURNED, (0.0, 0.0, 0.0), link
        while j >= 0:
            at = first + JOINT * j
            zeta, mu = column(c, at, R, rho)
            whole = moments(zeta, mu, omega, alpha, acc)
            less = moments(zeta, mu, less_omega, less_alpha, less_acc)
            for k in range(10):
                out[j * width + link * SIZE + k] = whole[k] - less[k]
            R, rho = up(c, at, q[j], R, rho)
            j = int(c[at])
        own = link * width + link * SIZE
        out[own + 10] = 0.0 if math.isnan(a[link]) else a[link]
        out[own + 11] = w[link]
        out[own + 12] = math.tanh(w[link] / STICKING)


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """Y Theta + K_D s, without writing Y down."""
    n = len(q)
    first = n * (SIZE + 1) + 3
    for i in range(n):
        own, speed = i * SIZE, v[i] + s[i]
        out[i] = c[own + 11] * speed + c[own + 12] * math.tanh(speed / STICKING)
        out[i] += c[n * SIZE + i] * s[i]
        if not math.isnan(r[i]):
            out[i] += c[own + 10] * r[i]
    for link in range(n):
        omega, alpha, acc = motion(c, link, q, v, r, s, 1.0, 1.0)
        less_omega, less_alpha, less_acc = motion(c, link, q, v, r, s, 1.0, -1.0)
        R, rho, j = NOT_TURNED, (0.0, 0.0, 0.0), link
        while j >= 0:
            at = first + JOINT * j
            zeta, mu = column(c, at, R, rho)
            whole = moments(zeta, mu, omega, alpha, acc)
            less = moments(zeta, mu, less_omega, less_alpha, less_acc)
            for k in range(10):
                out[j] += (whole[k] - less[k]) * c[link * SIZE + k]
            R, rho = up(c, at, q[j], R, rho)
            j = int(c[at])
