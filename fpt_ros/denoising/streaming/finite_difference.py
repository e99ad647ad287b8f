"""Finite differences of the position: the raw loop where only positions are measured.

Velocity and acceleration are first and second backward differences. A velocity is that of the
middle between two samples, so that the acceleration is taken over the distance of two middles: of
samples at unequal distances too it is exact where the acceleration is constant. Its noise is
sqrt(6) sigma / dt^2.
"""

from fpt_ros.denoising.streaming import Filter
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Values


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """No constants."""
    return ()


def state_size(constants: Vector, n: int) -> int:
    """The last positions, the last velocities, and the last distance of samples [s]."""
    return 2 * n + 1


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    n = len(q)
    for i in range(n):
        state[i], state[n + i] = q[i], 0.0
    state[2 * n] = 0.0


def update(
    constants: Vector,
    state: MutableVector,
    dt: float,
    q: Vector,
    v: Vector,
    out_q: MutableVector,
    out_v: MutableVector,
    out_response: MutableVector,
) -> None:
    """Position as it is, and its two differences."""
    n = len(q)
    before = state[2 * n] if state[2 * n] > 0.0 else dt
    middles = 0.5 * (before + dt)
    for i in range(n):
        velocity = (q[i] - state[i]) / dt
        out_q[i], out_v[i] = q[i], velocity
        out_response[i] = (velocity - state[n + i]) / middles
        state[i], state[n + i] = q[i], velocity
    state[2 * n] = dt


FINITE_DIFFERENCE = Filter(prepare, state_size, start, update)
