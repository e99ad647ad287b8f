"""Samples that are lost or cannot be true, healed in the loop (thesis, section 5.1.1, on line).

In the place of such a sample the filter is shown where the motion must be by now: what it found
in the cycle before, moved on by its own response. The response that comes out is not an answer of
the plant, so it is published as unknown (NaN), for as long as the sample is doubtful and ``pause``
cycles more: the deformation and the tuning learn nothing then, and go on from where they were.
``filter`` leaves the gap to a filter that goes on without samples.
"""

import math
from typing import NamedTuple

from fpt_ros.laws import Matrix, MutableVector, Switch, Vector, helper
from fpt_ros.parameters import Parameter, Values, integer, number, word

HEALING = Parameter(
    "healing.kind",
    "what stands for a sample that is lost; not given, predict where the plant's sensors are "
    "disturbed",
    "none",
    choices=("none", "hold", "predict", "filter"),
    live=False,
)

HEALING_OF_LOSSES = "predict"
"""Chosen for an experiment whose sensors are disturbed and that says nothing of healing."""

PARAMETERS = (
    HEALING,
    Parameter(
        "healing.limit",
        "how far from the prediction a position is not believed; 0: all are",
        0.0,
        minimum=0.0,
    ),
    Parameter(
        "healing.most",
        "samples in a row that are not believed; the next one is, unless it is lost",
        50,
        minimum=1,
        live=False,
    ),
    Parameter(
        "healing.pause", "cycles after a healed sample without learning", 0, minimum=0, live=False
    ),
)

POSITION, VELOCITY, RESPONSE, IN_A_ROW, GAP, DOUBT, HAS_VELOCITY = range(7)
"""Rows of the memory: the last estimate, healed samples in a row, those before this good one,
cycles of doubt that are left, whether velocities are measured."""

ROWS = 7


class HealingConstants(NamedTuple):
    """Fixed: whether anything is healed, and how, and the parameters.

    ``predicts``: moved on, not held; ``fills``: shown to the filter, not left to it as missing.
    """

    heals: Switch
    predicts: Switch
    fills: Switch
    limit: float
    most: float
    pause: float
    order: Switch


def constants_of(values: Values) -> HealingConstants:
    """Of checked parameters of the denoiser."""
    kind = word(values, HEALING.name)
    return HealingConstants(
        heals=int(kind != "none"),
        predicts=int(kind != "hold"),
        fills=int(kind != "filter"),
        limit=number(values, "healing.limit"),
        most=float(integer(values, "healing.most")),
        pause=float(integer(values, "healing.pause")),
        order=integer(values, "order"),
    )


def start(memory: Matrix, q: Vector, v: Vector) -> None:
    """The first sample, which is believed."""
    for i in range(len(q)):
        has_velocity = not math.isnan(v[i])
        memory[POSITION, i], memory[RESPONSE, i] = q[i], 0.0
        memory[VELOCITY, i] = v[i] if has_velocity else 0.0
        memory[HAS_VELOCITY, i] = 1.0 if has_velocity else 0.0


@helper
def heal(
    constants: HealingConstants,
    memory: Matrix,
    dt: float,
    q: Vector,
    v: Vector,
    out_q: MutableVector,
    out_v: MutableVector,
) -> None:
    """The sample as the filter is to see it."""
    for i in range(len(q)):
        expected_q, expected_v = memory[POSITION, i], memory[VELOCITY, i]
        if constants.predicts:
            response = memory[RESPONSE, i]
            if constants.order == 2:
                expected_q += dt * (expected_v + 0.5 * dt * response)
                expected_v += dt * response
            elif constants.order == 1:
                expected_q += dt * response
        lost = math.isnan(q[i])
        if constants.limit > 0.0 and memory[IN_A_ROW, i] < constants.most:
            lost = lost or abs(q[i] - expected_q) > constants.limit
        if lost:
            out_q[i], out_v[i] = expected_q, math.nan
            if not constants.fills:
                out_q[i] = math.nan
            elif memory[HAS_VELOCITY, i] > 0.0:
                out_v[i] = expected_v
            memory[IN_A_ROW, i] += 1.0
            memory[GAP, i] = 0.0
            memory[DOUBT, i] = constants.pause + 1.0
        else:
            out_q[i], out_v[i] = q[i], v[i]
            memory[GAP, i] = memory[IN_A_ROW, i]
            memory[IN_A_ROW, i] = 0.0


@helper
def keep_estimate(
    constants: HealingConstants, memory: Matrix, q: Vector, v: Vector, response: MutableVector
) -> None:
    """Remember what the filter found; while there is doubt the response is not known.

    Behind a gap a difference holds all that the prediction lacked, as if it were of one cycle: it
    is spread over the cycles of the gap, in which r was held, so that it is their mean response.
    """
    for i in range(len(q)):
        memory[POSITION, i] = q[i]
        memory[VELOCITY, i] = v[i]
        if memory[DOUBT, i] > 0.0:
            memory[DOUBT, i] -= 1.0
            response[i] = math.nan
        else:
            before = memory[RESPONSE, i] if constants.predicts else 0.0
            if memory[GAP, i] > 0.0:
                response[i] = before + (response[i] - before) / (memory[GAP, i] + 1.0)
            memory[RESPONSE, i] = response[i]
