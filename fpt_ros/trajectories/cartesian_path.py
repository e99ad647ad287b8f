"""A path of the tip of an arm from a file, MJCF or URDF, solved for the joints without inverses.

Kinematics and Jacobian are MuJoCo's, the joints move by the fixed point iteration of [49]:
:mod:`fpt_ros.trajectories.fixed_point_steps`. What is led is a point that the flange carries; its
orientation is free. The path begins at the posture ``start``, at rest::

    x_d = x_0 + amplitude (1 - cos w t) e + sin^2(w t) across,   e = direction / ||direction||

with amplitude [m] and w = frequency of the first joint, in the axes of the file's world. q' and q''
are differences over a cycle. The joints are those controlled, all others stay where the file has
them. C keeps nothing that the next cycle needs.

Where the path leaves what the arm can reach, the arm stretches, and stays so until what the tip
lacks bends it again; then it catches up, no faster than ``speed`` beyond the path's own speed.
"""

import math
from copy import copy
from dataclasses import replace
from typing import Any

from fpt_ros.errors import BadInput
from fpt_ros.foreign import call, pointer
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number, numbers, prefixed, resolve, words
from fpt_ros.plants.mujoco import description, description_file
from fpt_ros.plants.mujoco.library import bindings, functions
from fpt_ros.trajectories import Constants, Trajectory, fixed_point_steps, per_coordinate, scales
from fpt_ros.trajectories.fixed_point_steps import BEGUN, JACOBIAN, LACK, MOST, ROWS, STATE, Q

WHERE = "trajectory_generator"

ARM = prefixed("arm", (p for p in description.PARAMETERS if p.name in ("file", "flange")))

PARAMETERS = (
    *ARM,
    Parameter("tip", "the point that is led, from the flange in its axes", [0.0] * 3, unit="m"),
    Parameter("start", "posture at the start, one a joint; empty: zero", [], unit="rad, m"),
    Parameter("direction", "of the path, in the world", [0.0, 0.0, 1.0]),
    Parameter("across", "how far the path goes to the side", [0.0] * 3, unit="m"),
    Parameter("speed", "at which the tip catches up, at most", 0.2, unit="m/s", above=0.0),
    *fixed_point_steps.PARAMETERS,
    replace(fixed_point_steps.MEMORY, default=0.99),
)

KINEMATICS, CENTRES, OF_BODY, COPY, MODEL, DATA, POSITIONS, TIP, BODY = range(9)
DIRECTION, ACROSS, ORIGIN, SPEED, INNER = 9, 12, 15, 18, 19
"""Constants behind 3 c amplitudes, frequencies and starts: addresses of C, the body's number, the
path, x_0, and those of the iteration."""


def prepare(values: Values, c: int) -> Constants:
    """Constants, with a mjModel and mjData of their own.

    Raises:
        BadInput: the file cannot be read, has no such flange, or its joints are not those
            controlled; a list has the wrong length.
    """
    if c > MOST:
        raise BadInput(f"{WHERE}.controlled: {c} joints, it takes {MOST} at most")
    start, direction = per_coordinate(values, "start", c), _three(values, "direction")
    across, tip = _three(values, "across"), _three(values, "tip")
    length = math.sqrt(math.fsum(x * x for x in direction))
    if not length > 0.0:
        raise BadInput(f"{WHERE}.direction: [0.0, 0.0, 0.0] is no direction")
    model, data, body = _arm(values, tip)
    data.qpos[:] = start
    bindings().mj_kinematics(model, data)
    at, point = functions(), data.xpos[body]
    addresses = (
        *(at.kinematics, at.centres, at.jacobian, at.copy, model._address, data._address),
        *(data.qpos.ctypes.data, point.ctypes.data),
    )
    along, w = scales(values, c)[0], scales(values, c)[c]
    own = abs(w) * (abs(along) + math.sqrt(math.fsum(x * x for x in across)))
    speed = own + number(values, "speed")
    path = (*(x / length for x in direction), *across, *map(float, point), speed)
    inner = fixed_point_steps.prepare(values)
    constants = Constants(
        (*scales(values, c), *start, *map(float, addresses), float(body), *path, *inner)
    )
    constants.memory = model, data
    return constants


def _arm(values: Values, tip: list[float]) -> tuple[Any, Any, int]:
    """The arm whose joints are those controlled, and the body that stands at its tip."""
    mujoco, where = bindings(), f"{WHERE}.arm"
    names, own = words(values, "controlled"), {p.name[4:]: values[p.name] for p in ARM}
    path = description_file.locate(str(own["file"]), f"{where}.file: ")
    known = description_file.joints_of(path).movable
    if names != [name for name in known if name in names]:
        raise BadInput(
            f"{WHERE}.controlled: [{', '.join(names)}] are not joints of {path.name} in its order: "
            f"{', '.join(known)}"
        )
    given = resolve(description.PARAMETERS, {**own, "joints": names}, where)
    model = copy(description.arm(given, where).bare)
    body = mujoco.mj_name2id(model, int(mujoco.mjtObj.mjOBJ_BODY), description.TOOL)
    offset = model.body_pos[body].copy()
    mujoco.mju_rotVecQuat(offset, tip, model.body_quat[body])
    model.body_pos[body] += offset
    return model, mujoco.MjData(model), body


def _three(values: Values, name: str) -> list[float]:
    given = numbers(values, name)
    if len(given) != 3:
        raise BadInput(f"{WHERE}.{name}: {len(given)} numbers given, 3 needed (x, y, z)")
    return given


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
    k = 3 * c
    if state[BEGUN] == 0.0 or dt == 0.0:
        fixed_point_steps.begin(constants, 2 * c, state, out_q, out_v, out_a)
        return
    model, data, copied = pointer(constants[k + MODEL]), pointer(constants[k + DATA]), k + COPY
    for i in range(c):
        out_q[i] = state[Q + i]
    call(constants[copied], pointer(constants[k + POSITIONS]), out_q, 8 * c)
    call(constants[k + KINEMATICS], model, data)
    call(constants[k + CENTRES], model, data)
    call(constants[copied], state, pointer(constants[k + TIP]), 8 * ROWS)
    turn = constants[c] * t
    along, aside = constants[0] * (1.0 - math.cos(turn)), math.sin(turn) * math.sin(turn)
    square = 0.0
    for r in range(ROWS):
        there = constants[k + ORIGIN + r] + along * constants[k + DIRECTION + r]
        state[LACK + r] = there + aside * constants[k + ACROSS + r] - state[JACOBIAN + r]
        square += state[LACK + r] * state[LACK + r]
    size = math.sqrt(square)
    if size > constants[k + SPEED] * dt:
        for r in range(ROWS):
            state[LACK + r] *= constants[k + SPEED] * dt / size
    nothing, body = pointer(0.0), int(constants[k + BODY])
    call(constants[k + OF_BODY], model, data, state, nothing, body)
    fixed_point_steps.move(constants, k + INNER, state, ROWS, dt, out_q, out_v, out_a)


CARTESIAN_PATH = Trajectory(prepare, nominal, PARAMETERS, STATE, coarse=True)
