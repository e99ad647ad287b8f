"""A constant: what the bare iterations of sections 3.1.1 and 3.2.1 are to reach."""

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.trajectories import Trajectory, scales


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """Write the amplitude; it does not move."""
    for i in range(len(out_q)):
        out_q[i] = constants[i]
        out_v[i] = 0.0
        out_a[i] = 0.0


CONSTANT = Trajectory(scales, nominal)
