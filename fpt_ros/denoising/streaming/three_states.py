"""What the filters share that estimate position, velocity and acceleration."""

from fpt_ros.laws import MutableVector, Vector, helper


def state_size(constants: Vector, n: int) -> int:
    """Position, velocity and acceleration of each coordinate."""
    return 3 * n


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    for c in range(len(q)):
        for i in range(3):
            state[3 * c + i] = 0.0
        state[3 * c] = q[c]


@helper
def response_of(order: float, position: float, velocity: float, acceleration: float) -> float:
    """Which of them a plant of this order answers with."""
    if order == 1.0:
        return velocity
    if order == 0.0:
        return position
    return acceleration
