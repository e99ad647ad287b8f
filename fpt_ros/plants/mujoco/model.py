"""Model ``mujoco``: inverse dynamics tau = M(q) r + h(q, q') of an arm from a file.

The recursive Newton-Euler algorithm of MuJoCo (mj_rne), with the armatures, and the friction that
the model knows: none by default. Where no response is prescribed the joint is taken not to be
accelerated.
"""

import math
from copy import copy

from fpt_ros.foreign import call, pointer
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.plants import Factory, Model
from fpt_ros.plants.mujoco import description
from fpt_ros.plants.mujoco.library import bindings, functions

PARAMETERS = (
    *description.PARAMETERS,
    Parameter("viscous", "factor of viscous friction", 0.0, minimum=0.0, live=False),
    Parameter("coulomb", "factor of Coulomb friction", 0.0, minimum=0.0, live=False),
)

STICKING = 0.02
"""Velocity [rad/s, m/s] at which tanh(v / STICKING) smoothes the step of Coulomb friction."""

KINEMATICS, CENTRES, VELOCITIES, INVERSE, COPY, MODEL_AT, DATA, QPOS, QVEL, QACC = range(10)
FIRST = 10
"""Constants: addresses; then n armatures, n viscous and n Coulomb coefficients."""


def make(values: Values) -> Model:
    """The model of a file: an mjData of its own."""
    mujoco, arm = bindings(), description.arm(values, "approximate")
    model = copy(arm.loaded)
    data = mujoco.MjData(model)
    c = functions()
    constants = (
        *(c.kinematics, c.centres, c.velocities, c.inverse, c.copy, model._address, data._address),
        *(array.ctypes.data for array in (data.qpos, data.qvel, data.qacc)),
        *model.dof_armature,
        *(number(values, "viscous") * model.dof_damping),
        *(number(values, "coulomb") * model.dof_frictionloss),
    )
    kept = tuple(map(float, constants)), model, data

    def coefficients(parameters: Vector) -> tuple[float, ...]:
        return kept[0]  # and C's memory lives as long as this function

    return Model(
        coordinates=arm.names,
        controlled=arm.names,
        parameters=(),
        coefficient_names=(),
        coefficients=coefficients,
        effort=effort,
    )


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """Inverse dynamics; NaN where (q, v, r) is not finite."""
    n, model, data = len(q), pointer(c[MODEL_AT]), pointer(c[DATA])
    for i in range(n):
        out[i] = 0.0 if math.isnan(r[i]) else r[i]
    call(c[COPY], pointer(c[QPOS]), q, 8 * n)
    call(c[COPY], pointer(c[QVEL]), v, 8 * n)
    call(c[COPY], pointer(c[QACC]), out, 8 * n)
    call(c[KINEMATICS], model, data)
    call(c[CENTRES], model, data)
    call(c[VELOCITIES], model, data)
    call(c[INVERSE], model, data, 1, out)
    for i in range(n):
        acceleration = 0.0 if math.isnan(r[i]) else r[i]
        out[i] += c[FIRST + i] * acceleration + c[FIRST + n + i] * v[i]
        out[i] += c[FIRST + 2 * n + i] * math.tanh(v[i] / STICKING)


MODEL: Factory[Model] = Factory(PARAMETERS, make)
