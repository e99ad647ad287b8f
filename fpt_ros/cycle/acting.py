"""What acts of an effort, and where the learning goes on: limits, take-over, anti-windup.

The iteration r_k = G(r_{k-1}, response - desired) goes on from the r that it asked for. Where the
effort for it did not act (cut at a limit, actuators off), r runs away: the error stays whatever r
is. With ``anti_windup: acted`` the r of such a cycle is, afterwards, what the model makes of the
effort that acted: r = M^-1 (Q_acted - h^), so that r and the response observed belong together.
"""

import math

from fpt_ros.cycle.deformation import DeformerConstants, DeformerMemory, DeformerWork
from fpt_ros.cycle.holding import hold, let_go
from fpt_ros.cycle.limits import ACTED, CLAMP, NO_ANTI_WINDUP, LimitWork
from fpt_ros.cycle.rows import CommandRow, Estimated, Measured
from fpt_ros.laws import Indices, MutableVector, Vector, clipped, helper
from fpt_ros.plants import Effort

DISENGAGED = -1.0
"""In the place of the time since the controller took over: it has not."""

HELD = 64
"""Cycles for which an effort sent before may still act: it came late, or a later one was lost."""


@helper
def look_back(
    effort: Effort,
    constants: DeformerConstants,
    memory: DeformerMemory,
    work: DeformerWork,
    dt: float,
    measured: Measured,
) -> None:
    """What became of the effort of the cycle before, ``dt`` [s] ago.

    One that was sent up to ``HELD`` cycles ago came late or was held, because later ones were lost:
    the law goes on from its own last r, which bears that best. Any other was limited.
    """
    limits, count = constants.limits, int(memory.cycles[0])
    lapsed = limits.timeout > 0.0 and dt > limits.timeout
    if count == 0 or lapsed:
        forget(memory, len(work.zeros))
        for i in range(len(memory.effort)):  # it has acted meanwhile
            if not (lapsed and limits.hold.holds):  # what held, it does
                memory.effort[i] = limits.safe[i] if lapsed else 0.0
        return
    if limits.windup == NO_ANTI_WINDUP:
        return
    turn = (count - 1) % constants.delay
    if was_sent(memory, count, limits.tolerance, measured):
        for i in range(len(memory.unlimited)):
            memory.unlimited[i] = memory.deformed[turn, i]
        return
    last = (count - 1) % HELD
    for i in range(len(memory.unlimited)):
        missing = memory.sent[last, i] - measured.effort[i]
        work.limits.missing[i] = 0.0 if math.isnan(missing) else missing
    q, v = memory.position, memory.velocity
    go_on_from_what_acted(effort, constants, memory, work, q, v, turn)


@helper
def was_sent(memory: DeformerMemory, count: int, tolerance: float, measured: Measured) -> bool:
    """Whether what acted was sent in one of the last cycles; what is not known counts as sent."""
    for back in range(min(count, HELD)):
        same = True
        for i in range(len(memory.unlimited)):
            away = memory.sent[(count - 1 - back) % HELD, i] - measured.effort[i]
            if abs(away) > tolerance:  # not so if NaN
                same = False
        if same:
            return True
    return False


@helper
def limit_effort(
    effort: Effort,
    constants: DeformerConstants,
    memory: DeformerMemory,
    work: DeformerWork,
    dt: float,
    estimate: Estimated,
    measured: Measured,
    out: CommandRow,
) -> None:
    """Cut the effort to what may act, and say from which r the next cycle goes on."""
    limits, missing, was_cut = constants.limits, work.limits.missing, 0
    n, turn = len(out.effort), (int(memory.cycles[0]) - 1) % constants.delay
    if limits.stopped:  # nothing is learned, and the next controlled cycle begins anew
        for i in range(n):
            out.effort[i] = limits.safe[i]
        if limits.hold.holds:
            q, v = estimate.positions, estimate.velocities
            hold(limits.hold, limits.safe, limits.effort, memory.held, q, v, out.effort)
        forget(memory, n)
        keep(memory, estimate, out)
        return
    let_go(memory.held)
    if limits.remembers:
        engage(memory, dt, measured)
    for i in range(n):
        asked = out.effort[i]
        acts = asked
        if limits.remembers:
            since, start = memory.engaged[0], memory.start[i]
            if since < limits.take_over:
                acts = start + since / limits.take_over * (acts - start)
            before = memory.effort[i] if since > 0.0 else start
            span = limits.rate[i] * (dt if since > 0.0 else 0.0)
            if limits.rate[i] < math.inf:
                acts = clipped(acts, before - span, before + span)
        acts = clipped(acts, -limits.effort[i], limits.effort[i])
        missing[i] = asked - acts
        if acts != asked:
            was_cut = 1
        out.effort[i] = acts
    if was_cut and limits.windup != NO_ANTI_WINDUP:
        q, v = estimate.positions, estimate.velocities
        go_on_from_what_acted(effort, constants, memory, work, q, v, turn)
        if limits.windup == ACTED:
            for i in range(n):
                out.accelerations[i] = memory.deformed[turn, i]
    keep(memory, estimate, out)


@helper
def keep(memory: DeformerMemory, estimate: Estimated, out: CommandRow) -> None:
    """What the next cycles need to know of this one."""
    for i in range(len(memory.effort)):
        memory.effort[i] = out.effort[i]
    last = (int(memory.cycles[0]) - 1) % HELD
    for i in range(len(memory.unlimited)):
        memory.sent[last, i] = out.effort[i]
        memory.position[i], memory.velocity[i] = estimate.positions[i], estimate.velocities[i]


@helper
def engage(memory: DeformerMemory, dt: float, measured: Measured) -> None:
    """Count the time since the controller took over, beginning with the effort that acts."""
    if memory.engaged[0] != DISENGAGED:
        memory.engaged[0] += dt
        return
    memory.engaged[0] = 0.0
    for i in range(len(memory.start)):
        memory.start[i] = measured.effort[i]
        if math.isnan(memory.start[i]):
            memory.start[i] = memory.effort[i]


@helper
def forget(memory: DeformerMemory, n: int) -> None:
    """No r is known any more: the next one is the desired response; the controller takes over."""
    for turn in range(len(memory.deformed)):
        for i in range(n):
            memory.deformed[turn, i] = math.nan
    if len(memory.engaged) > 0:
        memory.engaged[0] = DISENGAGED


@helper
def go_on_from_what_acted(
    effort: Effort,
    constants: DeformerConstants,
    memory: DeformerMemory,
    work: DeformerWork,
    q: Vector,
    v: Vector,
    turn: int,
) -> None:
    """Correct the r of a cycle at (q, v) of whose effort ``work.limits.missing`` did not act."""
    past = memory.deformed
    if constants.limits.windup == CLAMP:
        for i in range(len(memory.unlimited)):
            past[turn, i] = memory.unlimited[i]
        return
    r, where, coefficients = work.limits.probe, constants.where, constants.coefficients
    if solve(effort, coefficients, where, q, v, work.zeros, work.limits):
        c = len(where)
        for i in range(c):
            at = where[i]
            past[turn, at] = past[turn, at] - work.limits.normal[i * (c + 1) + c]
    for i in range(len(r)):
        r[i] = 0.0


@helper
def solve(
    effort: Effort,
    coefficients: Vector,
    where: Indices,
    q: Vector,
    v: Vector,
    zeros: Vector,
    work: LimitWork,
) -> int:
    """What of the response the model gives for the missing effort: least squares of J dr = missing.

    J is the model's effort for a unit of each controlled response, models being affine in it. The
    result is the last column of ``work.normal``; 0: J has no full rank.
    """
    n, c, J, A = len(q), len(where), work.jacobian, work.normal
    probe, base, column, missing = work.probe, work.base, work.column, work.missing
    for i in range(n):
        probe[i] = 0.0
    effort(coefficients, q, v, probe, zeros, base)
    for j in range(c):
        probe[where[j]] = 1.0
        effort(coefficients, q, v, probe, zeros, column)
        probe[where[j]] = 0.0
        for i in range(n):
            J[i * c + j] = column[i] - base[i]
    width = c + 1
    for j in range(c):
        for k in range(c):
            total = 0.0
            for i in range(n):
                total += J[i * c + j] * J[i * c + k]
            A[j * width + k] = total
        total = 0.0
        for i in range(n):
            total += J[i * c + j] * missing[i]
        A[j * width + c] = total
    return eliminate(A, c)


@helper
def eliminate(A: MutableVector, c: int) -> int:
    """Gauss and Jordan, with pivots, on c x (c + 1) numbers; 0: singular."""
    width = c + 1
    for j in range(c):
        pivot = j
        for k in range(j + 1, c):
            if abs(A[k * width + j]) > abs(A[pivot * width + j]):
                pivot = k
        if not abs(A[pivot * width + j]) > 0.0:
            return 0
        for k in range(width):
            kept = A[j * width + k]
            A[j * width + k] = A[pivot * width + k]
            A[pivot * width + k] = kept
        scale = A[j * width + j]
        for k in range(width):
            A[j * width + k] = A[j * width + k] / scale
        for i in range(c):
            factor = A[i * width + j]
            if i != j and factor != 0.0:
                for k in range(width):
                    A[i * width + k] = A[i * width + k] - factor * A[j * width + k]
    return 1
