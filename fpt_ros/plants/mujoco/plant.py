"""Plant ``mujoco``: an arm that integrates itself, implicitfast, with friction and joint limits.

The stage's own state is MuJoCo's full one (mjSTATE_INTEGRATION), set before and read after each
step, so that nothing that matters stays in C: several loops, a replay and a second process have the
same bits. Efforts and external forces act as generalised forces at the joints (qfrc_applied).
"""

import math
from copy import copy
from typing import Any

from fpt_ros.errors import BadInput
from fpt_ros.foreign import call, pointer
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number, numbers
from fpt_ros.plants import Factory, Plant
from fpt_ros.plants.mujoco import description
from fpt_ros.plants.mujoco.library import bindings, functions

PARAMETERS = (
    *description.PARAMETERS,
    Parameter("tool_from", "when the tool is taken up", 0.0, unit="s", minimum=0.0, live=False),
    Parameter("viscous", "factor of viscous friction", 1.0, minimum=0.0, live=False),
    Parameter("coulomb", "factor of Coulomb friction", 1.0, minimum=0.0, live=False),
    Parameter(
        "torque_limit",
        "largest effort of each joint; empty: the file's",
        [],
        above=0.0,
        live=False,
    ),
)

FAR = 1e6
"""Positions [rad, m] and velocities beyond which no arm is simulated any more."""

SET_STATE, GET_STATE, RESET, STEP, FORWARD, COPY = range(6)
BARE, BARE_DATA, LOADED, LOADED_DATA, TOOL_FROM, WHOLE, APPLIED = range(6, 13)
QPOS, QVEL, QFRC, QACC, WARM = range(13, 18)
LIMITS = 18
"""Constants: addresses of functions; of mjModel and mjData without and with the tool; when it is
taken up; which numbers make a state, and where the applied forces stand in it; addresses in the
mjData with the tool; limits of effort, one a joint."""


def make(values: Values) -> Plant:
    """The plant of a file: mjModel and mjData of its own."""
    mujoco, arm = bindings(), description.arm(values, "plant_simulator.exact")
    n = len(arm.names)
    limits = numbers(values, "torque_limit") or list(arm.limits)
    if len(limits) != n:
        raise BadInput(
            f"plant_simulator.exact.torque_limit: {len(limits)} numbers given, {n} needed "
            f"({', '.join(arm.names)})"
        )
    models = [copy(arm.bare), copy(arm.loaded)]
    for model in models:
        model.dof_damping[:] *= number(values, "viscous")
        model.dof_frictionloss[:] *= number(values, "coulomb")
    datas = [mujoco.MjData(model) for model in models]
    for data in datas:
        silence(data)
    c, bits, data = functions(), mujoco.mjtState, datas[1]
    whole = int(bits.mjSTATE_INTEGRATION)
    below = int(bits.mjSTATE_QFRC_APPLIED) - 1
    constants = (
        *(c.set_state, c.get_state, c.reset, c.step, c.forward, c.copy),
        *(models[0]._address, datas[0]._address, models[1]._address, datas[1]._address),
        number(values, "tool_from"),
        *(whole, mujoco.mj_stateSize(models[0], below)),
        *map(at, (data.qpos, data.qvel, data.qfrc_applied, data.qacc, data.qacc_warmstart)),
        *limits,
    )
    kept = tuple(map(float, constants)), models, datas

    def coefficients(parameters: Vector) -> tuple[float, ...]:
        return kept[0]  # and C's memory lives as long as this function

    def set_step(h: float) -> None:
        for model in models:
            model.opt.timestep = h

    return Plant(
        coordinates=arm.names,
        units=tuple("rad" if turns else "m" for turns in arm.turns),
        effort_units=tuple("N m" if turns else "N" for turns in arm.turns),
        parameters=(),
        coefficients=coefficients,
        response=response,
        workspace=lambda coefficients: arm.ranges,
        advance=advance,
        state=mujoco.mj_stateSize(models[0], whole),
        start=start,
        set_step=set_step,
    )


def at(array: Any) -> int:
    """Where C keeps an array of mjData."""
    return int(array.ctypes.data)


def silence(data: Any) -> None:
    """No warnings, which MuJoCo prints and writes to a file: that the arm is lost is seen here."""
    for warning in data.warning:
        warning.number = 1


def start(c: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """The state at time zero at (q, v)."""
    n = len(q)
    call(c[RESET], pointer(c[BARE]), pointer(c[BARE_DATA]))
    call(c[GET_STATE], pointer(c[BARE]), pointer(c[BARE_DATA]), state, int(c[WHOLE]))
    for i in range(n):
        state[1 + i], state[1 + n + i] = q[i], v[i]


def advance(
    c: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    effort: Vector,
    external: Vector,
    q: MutableVector,
    v: MutableVector,
    acted: MutableVector,
) -> None:
    """One step of MuJoCo, efforts cut at their limits; NaN where the arm is lost."""
    n, applied, lost = len(q), int(c[APPLIED]), False
    for i in range(n):
        limit = c[LIMITS + i]
        acted[i] = max(-limit, min(limit, effort[i]))
        state[1 + i], state[1 + n + i] = q[i], v[i]
        state[applied + i] = acted[i] + external[i]
        if not (abs(q[i]) <= FAR and abs(v[i]) <= FAR and abs(state[applied + i]) < math.inf):
            lost = True
    model, data = c[BARE], c[BARE_DATA]
    if state[0] >= c[TOOL_FROM] - 0.5 * dt:
        model, data = c[LOADED], c[LOADED_DATA]
    if not lost:
        whole = int(c[WHOLE])
        call(c[SET_STATE], pointer(model), pointer(data), state, whole)
        call(c[STEP], pointer(model), pointer(data))
        call(c[GET_STATE], pointer(model), pointer(data), state, whole)
    for i in range(n):
        q[i] = math.nan if lost else state[1 + i]
        v[i] = math.nan if lost else state[1 + n + i]


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """Accelerations with the tool, for analyses; the stage lets the arm integrate itself."""
    n, model, data = len(q), pointer(c[LOADED]), pointer(c[LOADED_DATA])
    for i in range(n):
        out[i] = 0.0
    call(c[COPY], pointer(c[WARM]), out, 8 * n)
    for i in range(n):
        out[i] = max(-c[LIMITS + i], min(c[LIMITS + i], effort[i]))
    call(c[COPY], pointer(c[QPOS]), q, 8 * n)
    call(c[COPY], pointer(c[QVEL]), v, 8 * n)
    call(c[COPY], pointer(c[QFRC]), out, 8 * n)
    call(c[FORWARD], model, data)
    call(c[COPY], out, pointer(c[QACC]), 8 * n)


PLANT: Factory[Plant] = Factory(PARAMETERS, make)
