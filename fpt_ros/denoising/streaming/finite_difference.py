"""Finite differences of the position: the raw loop where only positions are measured.

Velocity and acceleration are first and second backward differences; the noise of the acceleration
is sqrt(6) sigma / dt^2.
"""

from fpt_ros.denoising.streaming import Filter
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Values


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """No constants."""
    return ()


def state_size(constants: Vector, n: int) -> int:
    """The last positions and the last velocities."""
    return 2 * n


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    n = len(q)
    for i in range(n):
        state[i], state[n + i] = q[i], 0.0


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
    for i in range(n):
        velocity = (q[i] - state[i]) / dt
        out_q[i], out_v[i] = q[i], velocity
        out_response[i] = (velocity - state[n + i]) / dt
        state[i], state[n + i] = q[i], velocity


FINITE_DIFFERENCE = Filter(prepare, state_size, start, update)
