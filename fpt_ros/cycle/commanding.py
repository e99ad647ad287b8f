"""What stage 5 computes: the model's effort for the deformed response, what is added, what acts."""

import math

from fpt_ros.compensators import Compensate, Observed
from fpt_ros.cycle.acting import limit_effort, look_back
from fpt_ros.cycle.deformation import (
    DeformerConstants,
    DeformerMemory,
    DeformerWork,
    deform_response,
)
from fpt_ros.cycle.rows import CommandRow, Estimated, Measured, Wanted
from fpt_ros.laws import helper
from fpt_ros.plants import Effort
from fpt_ros.transformations import Deform


@helper
def compensate_effort(
    compensate: Compensate,
    effort: Effort,
    constants: DeformerConstants,
    memory: DeformerMemory,
    work: DeformerWork,
    dt: float,
    estimate: Estimated,
    desired: Wanted,
    out: CommandRow,
) -> None:
    """Add what the compensator gives to the model's effort."""
    q, v, response = estimate.positions, estimate.velocities, estimate.accelerations
    explained, wanted = work.explained, work.wanted
    n, where = len(q), constants.where
    for i in range(n):
        wanted[i], explained[i] = math.nan, math.nan
    for i in range(len(where)):
        wanted[where[i]] = desired.accelerations[i]
    known = memory.cycles[0] > 1.0
    for i in range(n):
        if math.isnan(response[i]):
            known = False  # a model would take it for no response at all
    if known:
        effort(
            constants.coefficients,
            memory.position,
            memory.velocity,
            response,
            work.zeros,
            explained,
        )
    observed = Observed(
        q,
        v,
        response,
        explained,
        memory.effort,
        wanted,
        out.accelerations,
        work.combined,
    )
    compensate(constants.compensator, memory.compensator, dt, observed, out.effort)
    for i in range(n):
        memory.position[i], memory.velocity[i], memory.effort[i] = q[i], v[i], out.effort[i]


@helper
def command_cycle(
    deform: Deform,
    effort: Effort,
    compensate: Compensate,
    constants: DeformerConstants,
    memory: DeformerMemory,
    work: DeformerWork,
    t: float,
    dt: float,
    estimate: Estimated,
    desired: Wanted,
    measured: Measured,
    out: CommandRow,
) -> None:
    """All of the stage at t [s], dt [s] after the cycle before."""
    adaptive = 1 if constants.adapts and t >= constants.adaptive_from else 0
    limits = constants.limits.acts
    if limits:
        look_back(effort, constants, memory, work, dt, measured)
    deform_response(deform, effort, constants, memory, work, adaptive, estimate, desired, out)
    if constants.compensates:
        compensate_effort(compensate, effort, constants, memory, work, dt, estimate, desired, out)
    if limits:
        limit_effort(effort, constants, memory, work, dt, estimate, measured, out)
