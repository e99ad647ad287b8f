"""Model ``mujoco_linear``: an arm's inverse dynamics as a regressor times numbers to be learned.

tau = Y(q, q', w, a) Theta + K_D s. Theta holds 13 numbers a joint: of the link that it carries the
mass m, first moments m c and second moments I (xx, xy, xz, yy, yz, zz) about the joint, in axes
that are the world's at q = 0; armature, viscous and Coulomb friction. The model of Slotine and Li
(1987) for arms, with w = q' + s the reference velocity.
"""

from typing import Any

import numpy as np

from fpt_ros.errors import BadInput
from fpt_ros.parameters import Parameter, Values, number, numbers
from fpt_ros.plants import Factory, Model
from fpt_ros.plants.mujoco import description, model
from fpt_ros.plants.mujoco.library import bindings
from fpt_ros.plants.mujoco.regressor import MOMENTS, NUMBERS, effort, regressor

PARAMETERS = (
    *model.PARAMETERS,
    Parameter("K_D", "gain of the combined error in the effort, one a joint", [], minimum=0.0),
)


def make(values: Values) -> Model:
    """The model of a file.

    Raises:
        BadInput: not one gain a joint.
    """
    arm = description.arm(values, "approximate")
    n, gains = len(arm.names), numbers(values, "K_D")
    if len(gains) != n:
        raise BadInput(
            f"approximate.K_D: {len(gains)} numbers given, {n} needed ({', '.join(arm.names)})"
        )
    parents, joints, moments = _at_zero(arm.loaded)
    frictions = zip(
        arm.loaded.dof_armature,
        number(values, "viscous") * arm.loaded.dof_damping,
        number(values, "coulomb") * arm.loaded.dof_frictionloss,
        strict=True,
    )
    theta = [
        float(x) for pair in zip(moments, frictions, strict=True) for each in pair for x in each
    ]
    places = [
        (float(parent), float(turns), *axis, *(place - joints[parent][1] if parent >= 0 else place))
        for parent, turns, (axis, place) in zip(parents, arm.turns, joints, strict=True)
    ]
    fixed = [*gains, *arm.loaded.opt.gravity, *(x for each in places for x in each)]
    constants = (*theta, *map(float, fixed))
    return Model(
        coordinates=arm.names,
        controlled=arm.names,
        parameters=(),
        coefficient_names=tuple(f"{joint}.{each}" for joint in arm.names for each in NUMBERS),
        coefficients=lambda parameters: constants,
        effort=effort,
        regressor=regressor,
        rows=n,
    )


def _at_zero(arm: Any) -> tuple[list[int], list[tuple[Any, Any]], Any]:
    """Of each joint at q = 0: parent, axis and place; moments of the link that it carries."""
    mujoco = bindings()
    data = mujoco.MjData(arm)
    data.qpos[:] = 0.0
    mujoco.mj_kinematics(arm, data)
    joints = list(zip(data.xaxis.copy(), data.xanchor.copy(), strict=True))
    moments = np.zeros((len(joints), len(MOMENTS)))
    parents: list[int] = []
    carriers: list[int] = []  # by body, the joint that carries it
    for body in range(arm.nbody):
        carrier = carriers[arm.body_parentid[body]] if body else -1
        first = arm.body_jntadr[body]
        for joint in range(first, first + arm.body_jntnum[body]):
            parents.append(carrier)
            carrier = joint
        carriers.append(carrier)
        if carrier < 0:
            continue
        m, c = arm.body_mass[body], data.xipos[body] - joints[carrier][1]
        turned = data.ximat[body].reshape(3, 3)
        second = turned @ np.diag(arm.body_inertia[body]) @ turned.T
        second += m * (c @ c * np.eye(3) - np.outer(c, c))
        moments[carrier] += (m, *(m * c), *second[np.triu_indices(3)])
    return parents, joints, moments


MODEL: Factory[Model] = Factory(PARAMETERS, make)
