"""From a description file to MuJoCo's model of the arm, fixed at its base."""

import math
import warnings
from copy import copy
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

from fpt_ros.errors import BadInput
from fpt_ros.parameters import Parameter, Values, number, numbers, word, words
from fpt_ros.plants.mujoco.description_file import followers, locate, named, read, reason
from fpt_ros.plants.mujoco.library import bindings

FILE = Parameter(
    "file",
    "MJCF or URDF file, or the name of an arm that ships or of MuJoCo Menagerie",
    kind="str",
    live=False,
)

PARAMETERS = (
    FILE,
    Parameter("joints", "that are moved; empty: all", [], kind="strings", live=False),
    Parameter("scale", "factor of all masses, inertias, armatures", 1.0, above=0.0, live=False),
    Parameter("armature", "a further factor of the armatures", 1.0, minimum=0.0, live=False),
    Parameter(
        "flange", "site or body that carries the tool; empty: 'flange', or the last", "", live=False
    ),
    Parameter("tool", "mass at the flange", 0.0, unit="kg", minimum=0.0, live=False),
    Parameter(
        "tool_position", "its centre, from the flange", [0.0, 0.0, 0.05], unit="m", live=False
    ),
    Parameter("tool_inertia", "about each axis", 0.004, unit="kg m^2", minimum=0.0, live=False),
)
"""What plant and model have in common."""

TOOL = "fpt_ros tool"
"""The body that stands for the tool; its origin is the flange."""


class Arm(NamedTuple):
    """A compiled description, shared: a copy of ``bare`` or ``loaded`` is simulated.

    ``bare``, ``loaded``: mjModel without and with the tool, of the same sizes. Per joint: name,
    whether it turns, range of its position, largest effort (inf: none known).
    """

    bare: Any
    loaded: Any
    names: tuple[str, ...]
    turns: tuple[bool, ...]
    ranges: tuple[tuple[float, float], ...]
    limits: tuple[float, ...]


def arm(values: Values, prefix: str) -> Arm:
    """The arm that checked parameters describe; ``prefix`` is what messages call them, if anything.

    Raises:
        BadInput: the file cannot be read or does not fit, or there is no such joint or flange.
    """
    path = locate(word(values, "file"), f"{prefix}.file: ")
    position = numbers(values, "tool_position")
    if len(position) != 3:
        raise BadInput(f"{prefix}.tool_position: {len(position)} numbers given, 3 needed (x, y, z)")
    try:
        changed = path.stat().st_mtime_ns
    except OSError as error:
        raise BadInput(f"{prefix}.file: {path} cannot be read: {error.strerror}") from error
    return _compiled(
        path,
        changed,
        prefix,
        tuple(words(values, "joints")),
        number(values, "scale"),
        number(values, "armature"),
        word(values, "flange"),
        (number(values, "tool"), *position, number(values, "tool_inertia")),
    )


@lru_cache(maxsize=64)
def _compiled(
    path: Path,
    changed: int,
    prefix: str,
    joints: tuple[str, ...],
    scale: float,
    armature: float,
    flange: str,
    tool: tuple[float, ...],
) -> Arm:
    mujoco = bindings()
    where = f"{prefix}.file: {path}" if prefix else str(path)
    spec = read(path, where)
    chosen, limits = _reduce(spec, joints, where, prefix)
    spec.compiler.fusestatic = False
    _add_tool(spec, chosen, flange, prefix)
    try:
        with warnings.catch_warnings():  # of what is outdated in somebody's file
            warnings.simplefilter("ignore")
            bare = spec.compile()
    except ValueError as error:
        raise BadInput(f"{where} {reason(error)}") from error
    bare.body_mass[:] *= scale
    bare.body_inertia[:] *= scale
    bare.dof_armature[:] *= scale * armature
    flags = mujoco.mjtDisableBit
    bare.opt.disableflags |= int(flags.mjDSBL_CONTACT) | int(flags.mjDSBL_AUTORESET)
    bare.opt.integrator = int(mujoco.mjtIntegrator.mjINT_IMPLICITFAST)
    loaded = copy(bare)
    at = mujoco.mj_name2id(bare, int(mujoco.mjtObj.mjOBJ_BODY), TOOL)
    loaded.body_mass[at] = tool[0]
    loaded.body_ipos[at] = tool[1:4]
    loaded.body_inertia[at] = tool[4] if tool[0] else 0.0
    for model in (bare, loaded):
        mujoco.mj_setConst(model, mujoco.MjData(model))
    count = bare.njnt
    names = tuple(bare.joint(i).name for i in range(count))
    ranges = [
        (float(bare.jnt_range[i][0]), float(bare.jnt_range[i][1]))
        if bare.jnt_limited[i]
        else (-math.inf, math.inf)
        for i in range(count)
    ]
    turns = tuple(int(kind) == int(mujoco.mjtJoint.mjJNT_HINGE) for kind in bare.jnt_type)
    return Arm(bare, loaded, names, turns, tuple(ranges), tuple(limits[name] for name in names))


def _reduce(
    spec: Any, joints: tuple[str, ...], where: str, prefix: str
) -> tuple[list[Any], dict[str, float]]:
    """Keep the joints that are moved, and nothing that acts on them; their limits of effort."""
    mujoco = bindings()
    kinds = mujoco.mjtJoint
    single, follows = [], followers(spec)
    for joint in named(spec):
        leader = follows.get(joint.name)
        if leader and (joint.name in joints or not joints):
            raise BadInput(
                f"{where}: joint '{joint.name}' follows '{leader}' and cannot be moved by itself: "
                "name those that are moved in 'joints', the others are fixed"
            )
        if joint.type in (kinds.mjJNT_HINGE, kinds.mjJNT_SLIDE):
            single.append(joint)
        elif joint.name in joints or not joints:
            kind = "free" if joint.type == kinds.mjJNT_FREE else "a ball"
            raise BadInput(
                f"{where}: joint '{joint.name}' is {kind}, only joints that turn or slide about "
                "one axis can be moved: name these in 'joints', the others are fixed"
            )
    names = [joint.name for joint in single]
    if not single:
        raise BadInput(f"{where} has no joint that turns or slides")
    for name in joints:
        if name not in names:
            raise BadInput(f"{prefix}.joints: no joint '{name}', the file has {', '.join(names)}")
    limits = {joint.name: _limit_of(joint, spec) for joint in single}
    for part in (spec.actuators, spec.sensors, spec.keys):
        for each in list(part):
            spec.delete(each)
    moved = [joint for joint in single if not joints or joint.name in joints]
    kept = {joint.name for joint in moved}
    fixed = [joint for joint in spec.joints if joint.name not in kept]
    gone = {joint.name for joint in fixed}
    for each in list(spec.equalities):
        couples = each.type == mujoco.mjtEq.mjEQ_JOINT
        of_tendons = fixed and each.type == mujoco.mjtEq.mjEQ_TENDON
        if of_tendons or (couples and {each.name1, each.name2} & gone):
            spec.delete(each)
    for tendon in list(spec.tendons) if fixed else ():
        spec.delete(tendon)
    for joint in fixed:
        spec.delete(joint)
    return moved, limits


def _limit_of(joint: Any, spec: Any) -> float:
    """The largest effort: of the joint, of its motor, or of its actuator's force."""
    if joint.actfrcrange[1] > joint.actfrcrange[0]:
        return float(joint.actfrcrange[1])
    for actuator in spec.actuators:
        if actuator.target == joint.name:
            gear = abs(float(actuator.gear[0]))
            if actuator.forcerange[1] > actuator.forcerange[0]:
                return gear * float(actuator.forcerange[1])
            motor = not any(actuator.biasprm) and actuator.gainprm[0] == 1.0
            if motor and actuator.ctrlrange[1] > actuator.ctrlrange[0]:
                return gear * float(actuator.ctrlrange[1])
    return math.inf


def _add_tool(spec: Any, moved: list[Any], flange: str, prefix: str) -> None:
    """A body without mass where the tool will be."""
    site = spec.site(flange or "flange") or (None if flange else spec.site("attachment_site"))
    if site is not None:
        body, position, turn = site.parent, site.pos, site.quat
    else:
        body = spec.body(flange) if flange else moved[-1].parent
        position, turn = [0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]
    if body is None:
        known = ", ".join(each.name for each in [*spec.sites, *spec.bodies] if each.name)
        raise BadInput(f"{prefix}.flange: no site or body '{flange}', the file has {known}")
    tool = body.add_body(name=TOOL, pos=position, quat=turn)
    tool.mass, tool.inertia, tool.explicitinertial = 0.0, [0.0, 0.0, 0.0], True
