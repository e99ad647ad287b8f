"""What stage 5 learns: the deformed response, and the model's effort for it."""

import math
from typing import NamedTuple

from fpt_ros.cycle.limits import LimitConstants, LimitWork
from fpt_ros.cycle.rows import CommandRow, Estimated, Tuned, Wanted
from fpt_ros.cycle.tuned import A_COEFFICIENT, A_WEIGHT, TunedPlaces
from fpt_ros.laws import Indices, Matrix, MutableVector, Switch, Vector, helper
from fpt_ros.plants import Effort
from fpt_ros.transformations import Deform


class DeformerConstants(NamedTuple):
    """What holds in a cycle; a tuner changes the first three in place.

    ``transformation``: its constants, A in force first; ``coefficients`` of the model; ``weights``
    of the response errors (c). ``gain``: A as it is without a tuner; ``tuned``: where a message of
    the tuner has what. ``where``: places of the controlled coordinates; ``initial``: deformed
    response of the first cycle, or empty; ``delay``: cycles from a deformed response to the one
    that goes on from it, ``late`` of them because sensors are; ``hold``: learning hold [cycles];
    ``adapts``: whether there is a transformation; ``adaptive_from`` [s].
    """

    transformation: MutableVector
    coefficients: MutableVector
    weights: MutableVector
    gain: float
    tuned: TunedPlaces
    where: Indices
    initial: Vector
    delay: int
    late: int
    hold: int
    adapts: Switch
    adaptive_from: float
    compensator: Vector
    compensates: Switch
    limits: LimitConstants


class DeformerMemory(NamedTuple):
    """The number of cycles, and rings of the last d deformed and observed responses (d x n).

    For a compensator and for limits: motion and effort of the cycle before (n each). For a
    compensator: its memory. For limits: ring of the last efforts sent; r of the last cycle that was
    not limited; the effort from which the controller takes over (n each); how long ago it did [s].
    The position that is held (n), NaN where none is.
    """

    cycles: MutableVector
    deformed: Matrix
    observed: Matrix
    compensator: MutableVector
    position: MutableVector
    velocity: MutableVector
    effort: MutableVector
    sent: Matrix
    unlimited: MutableVector
    start: MutableVector
    engaged: MutableVector
    held: MutableVector


class DeformerWork(NamedTuple):
    """Of the controlled coordinates (c): r, h, f and the transformation's result; then n each.

    ``combined``: s; ``explained``: see :class:`~fpt_ros.compensators.Observed`; ``wanted``: the
    desired response; ``zeros``.
    """

    r: MutableVector
    h: MutableVector
    f: MutableVector
    out: MutableVector
    combined: MutableVector
    explained: MutableVector
    wanted: MutableVector
    zeros: MutableVector
    limits: LimitWork


@helper
def apply_tuning(constants: DeformerConstants, tuning: Tuned) -> None:
    """Put a tuner's values, and the factor of the gain, into force."""
    tuned, values, a = constants.tuned, tuning.values, constants.gain
    for i in range(tuned.size):
        value = values[tuned.first + i]
        if tuned.kind == A_COEFFICIENT:
            constants.coefficients[i] = value
        elif tuned.kind == A_WEIGHT:
            constants.weights[i] = value
        else:
            a = value
    if tuned.factor >= 0:
        a = a * values[tuned.factor]
    constants.transformation[0] = a


@helper
def deform_response(
    deform: Deform,
    effort: Effort,
    constants: DeformerConstants,
    memory: DeformerMemory,
    work: DeformerWork,
    adaptive: int,
    estimate: Estimated,
    desired: Wanted,
    out: CommandRow,
) -> None:
    """r_k = G(r_{k-d}, response to r_{k-d} - desired_k), and the model's effort for it.

    A coordinate that is controlled anew gets the desired response itself. Where the filter shows r
    (``estimate.deformed`` is not NaN), the step is made from that instead of from r_{k-d}. Where
    the response is not known (NaN, a lost sample), r stays.
    """
    past, seen, delay, hold = memory.deformed, memory.observed, constants.delay, constants.hold
    r, h, f, target, combined = work.r, work.h, work.f, work.out, work.combined
    wanted, s, where, initial = (
        desired.accelerations,
        desired.combined_error,
        constants.where,
        constants.initial,
    )
    response, shown, weights = estimate.accelerations, estimate.deformed, constants.weights
    out_r = out.accelerations
    n, c = len(out_r), len(r)
    count = int(memory.cycles[0])
    memory.cycles[0] = count + 1.0
    turn = count % delay if delay > 1 else 0
    then = turn + 1 + constants.late
    then = then if then < delay else then - delay
    for i in range(n):
        seen[turn, i] = response[i]
        combined[i] = 0.0
        out_r[i] = math.nan
    held = hold > 1 and count % hold != 0
    for i in range(c):
        at, before = where[i], past[turn, where[i]]
        r[i], h[i], f[i] = wanted[i], 0.0, wanted[i]
        if adaptive and not math.isnan(before) and not math.isnan(wanted[i]):
            known = not math.isnan(seen[then, at])
            r[i] = before if math.isnan(shown[at]) or not known else shown[at]
            if known and not held:
                f[i] = seen[then, at]
                h[i] = weights[i] * (f[i] - wanted[i])
        if not math.isnan(wanted[i]):
            combined[at] = s[i]
    if adaptive:
        deform(constants.transformation, r, h, f, wanted, target)
    for i in range(c):
        at = where[i]
        if count == 0 and len(initial) > 0:
            out_r[at] = initial[i]
        elif math.isnan(wanted[i]) or math.isnan(past[turn, at]) or not adaptive:
            out_r[at] = wanted[i]
        else:
            out_r[at] = r[i] if held else target[i]
    for i in range(n):
        past[turn, i] = out_r[i]
    q, v = estimate.positions, estimate.velocities
    effort(constants.coefficients, q, v, out_r, combined, out.effort)
