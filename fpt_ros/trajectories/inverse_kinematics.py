"""A path of the tip of a planar arm, solved for the joints by a fixed point iteration ([49]).

The step dq of a cycle has to satisfy J dq = x_d - x: :mod:`fpt_ros.trajectories.fixed_point_steps`.
Angles are from the link before, the first one from the vertical that hangs down. The tip's path
begins at the posture ``start``, at rest::

    x_d = x_0 + amplitude (1 - cos w t) e + across sin^2(w t) e',   e = (sin, -cos)(direction)

with amplitude and w = frequency of the first coordinate. q' and q'' are differences over a cycle.
Arms from a file, in space: :mod:`fpt_ros.trajectories.cartesian_path`.
"""

import math

from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter, Values, number, numbers
from fpt_ros.trajectories import Trajectory, fixed_point_steps, per_coordinate, scales
from fpt_ros.trajectories.fixed_point_steps import BEGUN, LACK, MOST, STATE, Q

PARAMETERS = (
    Parameter("links", "lengths of the links; empty: ones", [], unit="m", above=0.0),
    Parameter("start", "angles at the start; empty: zero", [], unit="rad"),
    Parameter("direction", "of the path, from the vertical that hangs down", 1.0, unit="rad"),
    Parameter("across", "how far the path goes to the side", 0.0, unit="m"),
    *fixed_point_steps.PARAMETERS,
    fixed_point_steps.MEMORY,
)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: c amplitudes, frequencies, links, starts; direction, across; of the iteration.

    Raises:
        BadInput: more joints than ``MOST``.
    """
    if c > MOST:
        raise BadInput(f"trajectory_generator.controlled: {c} joints, it takes {MOST} at most")
    links = per_coordinate(values, "links", c) if numbers(values, "links") else [1.0] * c
    start, path = per_coordinate(values, "start", c), (number(values, "direction"),)
    inner = fixed_point_steps.prepare(values)
    return (*scales(values, c), *links, *start, *path, number(values, "across"), *inner)


@helper
def tip(constants: Vector, q: Vector, at: int, c: int, vertical: int) -> float:
    """Where the tip is, to the side or upwards, with the c angles that stand at ``at``."""
    angle, total = 0.0, 0.0
    for i in range(c):
        angle += q[at + i]
        part = -math.cos(angle) if vertical else math.sin(angle)
        total += constants[2 * c + i] * part
    return total


@helper
def column(constants: Vector, q: Vector, at: int, c: int, joint: int, vertical: int) -> float:
    """A number of J: how fast the tip moves with a joint."""
    angle, total = 0.0, 0.0
    for i in range(c):
        angle += q[at + i]
        if i >= joint:
            part = math.sin(angle) if vertical else math.cos(angle)
            total += constants[2 * c + i] * part
    return total


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """The posture of the cycle, and its differences."""
    c = len(out_q)
    if state[BEGUN] == 0.0 or dt == 0.0:
        fixed_point_steps.begin(constants, 3 * c, state, out_q, out_v, out_a)
        return
    angle, turn = constants[4 * c], constants[c] * t
    along = constants[0] * (1.0 - math.cos(turn))
    across = constants[4 * c + 1] * math.sin(turn) * math.sin(turn)
    x = tip(constants, constants, 3 * c, c, 0) + along * math.sin(angle) + across * math.cos(angle)
    y = tip(constants, constants, 3 * c, c, 1) - along * math.cos(angle) + across * math.sin(angle)
    state[LACK] = x - tip(constants, state, Q, c, 0)
    state[LACK + 1] = y - tip(constants, state, Q, c, 1)
    for i in range(c):
        state[i] = column(constants, state, Q, c, i, 0)
        state[c + i] = column(constants, state, Q, c, i, 1)
    fixed_point_steps.move(constants, 4 * c + 2, state, 2, dt, out_q, out_v, out_a)


INVERSE_KINEMATICS = Trajectory(prepare, nominal, PARAMETERS, STATE)
