"""Model ``mujoco_diagonal``: constant inertias and, where it is asked for, the arm's gravity.

tau_i = m_i r_i + g_i(q). What PID (without gravity) and PD with gravity (Takegaki and Arimoto 1981)
know of an arm.
"""

import math
from dataclasses import replace

from fpt_ros.errors import BadInput
from fpt_ros.foreign import call, pointer
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, flag, numbers
from fpt_ros.plants import Factory, Model
from fpt_ros.plants.mujoco import description, model

PARAMETERS = (
    *description.PARAMETERS,
    Parameter("inertia", "m, one a joint", [], above=0.0, live=False),
    Parameter("gravity", "whether it is made up for", False, live=False),
)

GRAVITY = model.FIRST


def make(values: Values) -> Model:
    """The model of a file, without what its inertia matrix says."""
    whole = model.make({**values, "viscous": 0.0, "coulomb": 0.0})
    given, n = numbers(values, "inertia"), len(whole.coordinates)
    if len(given) != n:
        raise BadInput(
            f"approximate.inertia: {len(given)} numbers given, {n} needed "
            f"({', '.join(whole.coordinates)})"
        )
    own = float(flag(values, "gravity")), *given

    def coefficients(parameters: Vector) -> tuple[float, ...]:
        return (*whole.coefficients(parameters)[: model.FIRST], *own)

    return replace(whole, coefficients=coefficients, effort=effort)


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """The inertias' efforts, and those that hold the arm where it is."""
    n, arm, data = len(q), pointer(c[model.MODEL_AT]), pointer(c[model.DATA])
    for i in range(n):
        out[i] = 0.0
    if c[GRAVITY] != 0.0:
        call(c[model.COPY], pointer(c[model.QPOS]), q, 8 * n)
        call(c[model.COPY], pointer(c[model.QVEL]), out, 8 * n)
        call(c[model.KINEMATICS], arm, data)
        call(c[model.CENTRES], arm, data)
        call(c[model.VELOCITIES], arm, data)
        call(c[model.INVERSE], arm, data, 0, out)
    for i in range(n):
        out[i] += 0.0 if math.isnan(r[i]) else c[GRAVITY + 1 + i] * r[i]


MODEL: Factory[Model] = Factory(PARAMETERS, make)
