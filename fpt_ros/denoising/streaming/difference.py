"""No denoising: what is measured, and a backward difference as the response.

(v_k - v_{k-1}) / dt is the acceleration that the effort of cycle k-1 caused: for a plant integrated
by explicit Euler exactly (to rounding), otherwise its mean over the cycle. For a plant of order 1
it is (q_k - q_{k-1}) / dt, for one of order 0 the value itself.
"""

from fpt_ros.denoising.streaming import Filter
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Values, integer


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants (order,)."""
    return (float(integer(values, "order")),)


def state_size(constants: Vector, n: int) -> int:
    """The last velocities, or positions where the plant is of order 1."""
    return n


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """Keep what the first difference is taken against."""
    for i in range(len(q)):
        state[i] = v[i] if constants[0] == 2.0 else q[i]


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
    """Measured motion and backward difference."""
    order = constants[0]
    for i in range(len(q)):
        x = v[i] if order == 2.0 else q[i]
        out_q[i] = q[i]
        out_v[i] = v[i]
        out_response[i] = (x - state[i]) / dt if order > 0.0 else x
        state[i] = x


DIFFERENCE = Filter(prepare, state_size, start, update)
