"""What an experiment has to know of an arm: posture, room, inertias, weight."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fpt_ros.errors import BadInput
from fpt_ros.parameters import Value, resolve
from fpt_ros.plants.mujoco.description import PARAMETERS, Arm, arm
from fpt_ros.plants.mujoco.description_file import joints_of, locate, shipped
from fpt_ros.plants.mujoco.library import bindings
from fpt_ros.runs.run import Array

POSTURES = 200
"""Postures over which inertias are averaged."""

AROUND = 0.7
"""How far they are from the home posture [rad, m]."""

REACH, SLIDE_REACH = 0.5, 0.1
"""Largest nominal deviation from the home posture [rad, m]."""

DAMPED = 10.0
"""A joint whose damping takes its speed so many times within a cycle of 1 ms is left out."""

MARGIN = 0.9
"""Part of the room towards a limit that the motion uses."""


@dataclass(frozen=True)
class Survey:
    """An arm as its file describes it, n joints.

    Attributes:
        file: path, or the name of an arm that ships.
        name: a word for it.
        arm: compiled, without a payload.
        home: posture about which it moves [rad, m].
        reach: largest deviation from it that has room [rad, m].
        inertia: mean diagonal of the inertia matrix [kg m^2, kg].
        mass: of all that moves [kg].
        fixed: joints that are not moved, and why.
    """

    file: str
    name: str
    arm: Arm
    home: tuple[float, ...]
    reach: tuple[float, ...]
    inertia: tuple[float, ...]
    mass: float
    fixed: dict[str, str]


def survey(file: str, joints: Sequence[str] = ()) -> Survey:
    """Look at an arm.

    Args:
        file: MJCF or URDF, or the name of an arm that ships.
        joints: that are moved; empty: all that can be, each by itself.

    Raises:
        BadInput: the file cannot be read, or has nothing that could be moved.
    """
    path = locate(file)
    found = joints_of(path)
    if not found.movable:
        raise BadInput(f"{path} has no joint that turns or slides")
    unknown = [name for name in joints if name not in found.movable]
    if unknown:
        why = found.others.get(unknown[0], "")
        raise BadInput(
            f"--joints: joint '{unknown[0]}' {why}; {path} has {', '.join(found.movable)}"
            if why
            else f"--joints: no joint '{unknown[0]}', {path} has {', '.join(found.movable)}"
        )
    name = file if file in shipped() else str(path)
    fixed = {
        each: "is not among --joints" for each in found.movable if joints and each not in joints
    }
    compiled = loaded(name, [each for each in found.movable if each not in fixed])
    if not joints:
        stiff = _damped(compiled)
        fixed |= stiff
        compiled = loaded(name, [each for each in compiled.names if each not in stiff])
    moved = compiled.names
    home, reach = _posture(compiled, found.home)
    return Survey(
        file=name,
        name="".join(c if c.isalnum() else "_" for c in path.stem),
        arm=compiled,
        home=tuple(home.tolist()),
        reach=tuple(reach.tolist()),
        inertia=tuple(mean_inertia(name, moved, tuple(home), 0.0).tolist()),
        mass=_moving_mass(compiled.bare),
        fixed={**found.others, **fixed},
    )


def _damped(compiled: Arm) -> dict[str, str]:
    """Joints that follow a force no further than their damping lets them, unless all are so."""
    model, mujoco = compiled.bare, bindings()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    found, column = {}, np.zeros(model.nv)
    for i, name in enumerate(compiled.names):
        mujoco.mj_mulM(model, data, column, np.eye(model.nv)[i])
        damping = float(model.dof_damping[i])
        if damping * 1e-3 > DAMPED * column[i]:
            found[name] = f"has a damping of {damping:g} on an inertia of {column[i]:.2g}"
    return found if len(found) < model.nv else {}


def _posture(compiled: Arm, key: dict[str, float]) -> tuple[Array, Array]:
    """The home posture, and how far the motion may go from it.

    The file's own key frame; else zero, but away from limits, where they leave room.
    """
    home, reach = [], []
    for name, turns, (low, high) in zip(
        compiled.names, compiled.turns, compiled.ranges, strict=True
    ):
        wanted = (REACH if turns else SLIDE_REACH) / MARGIN
        room = min(wanted, 0.5 * (high - low))
        at = min(max(key.get(name, 0.0), low + room), high - room)
        home.append(round(at, 5))
        reach.append(MARGIN * room)
    return np.array(home), np.array(reach)


def tool_inertia(mass: float) -> float:
    """Of a payload about its own centre [kg m^2]: a ball of 0.07 m."""
    return float(f"{0.002 * mass:.3g}")


def loaded(file: str, joints: Sequence[str], payload: float = 0.0) -> Arm:
    """The arm with a payload at the flange [kg]."""
    tool: dict[str, Value] = {"tool": payload, "tool_inertia": tool_inertia(payload)}
    given = {"file": file, "joints": list(joints), **tool}
    return arm(resolve(PARAMETERS, given, file), "")


def mean_inertia(file: str, joints: Sequence[str], home: Sequence[float], payload: float) -> Array:
    """(n,) mean diagonal of the inertia matrix about a posture, with a payload at the flange."""
    compiled, mujoco = loaded(file, joints, payload), bindings()
    model = compiled.loaded
    data, rng = mujoco.MjData(model), np.random.default_rng(0)
    low, high = np.array(compiled.ranges).T
    total, unit, column = np.zeros(model.nv), np.eye(model.nv), np.zeros(model.nv)
    for _ in range(POSTURES):
        data.qpos[:] = np.clip(home + rng.uniform(-AROUND, AROUND, model.nv), low, high)
        mujoco.mj_forward(model, data)
        for i in range(model.nv):
            mujoco.mj_mulM(model, data, column, unit[i])
            total[i] += column[i]
    return total / POSTURES


def _moving_mass(model: Any) -> float:
    """Of the bodies that a joint moves."""
    moving = np.zeros(model.nbody, dtype=bool)
    for body in range(1, model.nbody):
        moving[body] = model.body_dofnum[body] > 0 or moving[model.body_parentid[body]]
    return float(model.body_mass[moving].sum())
