"""No denoising: what is measured, and the backward difference of the velocity as the response.

(v_k - v_{k-1}) / dt is the acceleration that the effort of cycle k-1 caused: for a plant integrated
by explicit Euler exactly (to rounding), otherwise its mean over the cycle.
"""

from fpt_ros.denoising.streaming import Filter
from fpt_ros.laws import MutableVector, Vector


def state_size(n: int) -> int:
    """The last velocities."""
    return n


def start(state: MutableVector, q: Vector, v: Vector) -> None:
    """Keep the first velocities."""
    for i in range(len(v)):
        state[i] = v[i]


def update(
    state: MutableVector,
    dt: float,
    q: Vector,
    v: Vector,
    out_q: MutableVector,
    out_v: MutableVector,
    out_response: MutableVector,
) -> None:
    """Measured motion and backward difference."""
    for i in range(len(q)):
        out_q[i] = q[i]
        out_v[i] = v[i]
        out_response[i] = (v[i] - state[i]) / dt
        state[i] = v[i]


DIFFERENCE = Filter(state_size, start, update)
