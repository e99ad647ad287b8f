"""A path of the tip of a planar arm, solved for the joints by a fixed point iteration ([49]).

The step dq of a cycle has to satisfy J dq = x_d - x. Its normal equation is solved without any
inverse, by the iteration that deforms responses, a few steps a cycle from the last cycle's dq on::

    h = J^T J dq - J^T (x_d - x),   dq <- dq + [F(A ||h|| / ||J^T J|| + x*) - x*] h / ||h||

with F(x) = atanh(tanh(x + D) / 2). Where J is singular the direction that the arm cannot move in
takes no part: nothing is divided by it. Angles are from the link before, the first one from the
vertical that hangs down. The tip's path begins at the posture ``start``, at rest::

    x_d = x_0 + amplitude (1 - cos w t) e + across sin^2(w t) e',   e = (sin, -cos)(direction)

with amplitude and w = frequency of the first coordinate. q' and q'' are differences over a cycle.
"""

import math

from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter, Values, integer, number, numbers
from fpt_ros.trajectories import Trajectory, per_coordinate, scales
from fpt_ros.transformations.atanh import fixed_point, shifted

PARAMETERS = (
    Parameter("links", "lengths of the links; empty: ones", [], unit="m", above=0.0),
    Parameter("start", "angles at the start; empty: zero", [], unit="rad"),
    Parameter("direction", "of the path, from the vertical that hangs down", 1.0, unit="rad"),
    Parameter("across", "how far the path goes to the side", 0.0, unit="m"),
    Parameter("inner_A", "gain of the iteration", -2.0),
    Parameter("inner_D", "shift of its function", 0.3),
    Parameter("inner_steps", "its steps in a cycle", 20, minimum=1, maximum=1000),
)

MOST = 8
"""Joints at most."""

STEP, RATE = MOST, 2 * MOST
"""Where dq and q' stand in the state, behind q; then 1 from the second cycle on."""

TINY = 1e-15


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: c amplitudes, frequencies, links, starts; direction, across, A, x*, D, steps.

    Raises:
        BadInput: more joints than ``MOST``.
    """
    if c > MOST:
        raise BadInput(f"trajectory_generator.controlled: {c} joints, it takes {MOST} at most")
    links = per_coordinate(values, "links", c) if numbers(values, "links") else [1.0] * c
    own = tuple(number(values, name) for name in ("direction", "across", "inner_A"))
    D, steps = number(values, "inner_D"), float(integer(values, "inner_steps"))
    start = per_coordinate(values, "start", c)
    return (*scales(values, c), *links, *start, *own, fixed_point(D), D, steps)


@helper
def tip(constants: Vector, q: Vector, c: int, vertical: int) -> float:
    """Where the tip is: to the side, or upwards."""
    angle, total = 0.0, 0.0
    for i in range(c):
        angle += q[i]
        part = -math.cos(angle) if vertical else math.sin(angle)
        total += constants[2 * c + i] * part
    return total


@helper
def column(constants: Vector, q: Vector, c: int, joint: int, vertical: int) -> float:
    """A number of J: how fast the tip moves with a joint."""
    angle, total = 0.0, 0.0
    for i in range(c):
        angle += q[i]
        if i >= joint:
            part = math.sin(angle) if vertical else math.cos(angle)
            total += constants[2 * c + i] * part
    return total


@helper
def improve(
    constants: Vector, state: MutableVector, c: int, x: float, y: float, out: MutableVector
) -> None:
    """One step of the iteration for dq, where the tip still lacks (x, y)."""
    gain, attractive, D = constants[4 * c + 2], constants[4 * c + 3], constants[4 * c + 4]
    left_x, left_y, xx, xy, yy = -x, -y, 0.0, 0.0, 0.0
    for i in range(c):
        a, b = column(constants, state, c, i, 0), column(constants, state, c, i, 1)
        left_x += a * state[STEP + i]
        left_y += b * state[STEP + i]
        xx += a * a
        xy += a * b
        yy += b * b
    square = 0.0
    for i in range(c):
        a, b = column(constants, state, c, i, 0), column(constants, state, c, i, 1)
        out[i] = a * left_x + b * left_y
        square += out[i] * out[i]
    size = math.sqrt(square)
    frobenius = math.sqrt(xx * xx + 2.0 * xy * xy + yy * yy)  # that of J^T J is that of J J^T
    if size > TINY:
        step = (shifted(D, gain * size / frobenius + attractive) - attractive) / size
        for i in range(c):
            state[STEP + i] += step * out[i]


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
    if state[3 * MOST] == 0.0 or dt == 0.0:
        state[3 * MOST] = 1.0
        for i in range(c):
            state[i] = out_q[i] = constants[3 * c + i]
            state[STEP + i] = state[RATE + i] = out_v[i] = out_a[i] = 0.0
        return
    angle, turn = constants[4 * c], constants[c] * t
    along = constants[0] * (1.0 - math.cos(turn))
    across = constants[4 * c + 1] * math.sin(turn) * math.sin(turn)
    for i in range(c):
        out_q[i] = constants[3 * c + i]
    x = tip(constants, out_q, c, 0) + along * math.sin(angle) + across * math.cos(angle)
    y = tip(constants, out_q, c, 1) - along * math.cos(angle) + across * math.sin(angle)
    x -= tip(constants, state, c, 0)
    y -= tip(constants, state, c, 1)
    for _ in range(int(constants[4 * c + 5])):
        improve(constants, state, c, x, y, out_a)
    for i in range(c):
        state[i] += state[STEP + i]
        out_q[i], out_v[i] = state[i], state[STEP + i] / dt
        out_a[i] = (out_v[i] - state[RATE + i]) / dt
        state[RATE + i] = out_v[i]


INVERSE_KINEMATICS = Trajectory(prepare, nominal, PARAMETERS, (0.0,) * (3 * MOST + 1))
