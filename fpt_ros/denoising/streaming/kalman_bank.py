"""A bank of steady-state Kalman filters, mixed by how likely each makes what is measured.

It needs no setting: by default the filters are a ladder of bandwidths, and noise and bandwidth are
found on line (:mod:`~fpt_ros.denoising.streaming.ladder_update`). Who knows the noise, or wants one
linear filter for a loop, gives ``sigma``, ``states`` or ``densities``, and gets these filters
(:mod:`~fpt_ros.denoising.streaming.given_filters`).
"""

from fpt_ros.denoising.streaming import Filter, given_filters, ladder
from fpt_ros.denoising.streaming.given_filters import update as update_given
from fpt_ros.denoising.streaming.ladder_deviation import deviation as deviation_of_ladder
from fpt_ros.denoising.streaming.ladder_update import update as update_ladder
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

LEAST_GATE = 2.0

GATE = Parameter(
    "gate",
    "standard deviations beyond which a sample may be an impulse, more than "
    f"{LEAST_GATE:g}; 0: {ladder.GATE:g}, and {given_filters.GATE:g} of given filters",
    0.0,
    minimum=0.0,
)


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants of the ladder, whose first is above 0, or of given filters, below 0."""
    gate = number(values, GATE.name)
    if 0.0 < gate <= LEAST_GATE:
        raise BadInput(f"gate = {gate:g} is not valid: it is 0, or more than {LEAST_GATE:g}")
    if given_filters.are_given(values):
        return given_filters.prepare(values, n, dt)
    return ladder.prepare(values, n, dt)


def state_size(constants: Vector, n: int) -> int:
    """Of whichever filters they are."""
    if constants[0] > 0.0:
        return ladder.state_size(constants, n)
    return given_filters.state_size(constants, n)


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    if constants[0] > 0.0:
        ladder.start(constants, state, q, v)
    else:
        given_filters.start(constants, state, q, v)


def update(
    constants: Vector,
    state: MutableVector,
    dt: float,
    q: Vector,
    v: Vector,
    out_q: MutableVector,
    out_v: MutableVector,
    out_response: MutableVector,
) -> None:
    """One step of every filter, and their weighted mean."""
    if constants[0] > 0.0:
        update_ladder(constants, state, dt, q, v, out_q, out_v, out_response)
    else:
        update_given(constants, state, dt, q, v, out_q, out_v, out_response)


def serves(before: Vector, now: Vector) -> bool:
    """Whether both are ladders, or given filters."""
    return (before[0] > 0.0) == (now[0] > 0.0)


def deviation(constants: Vector, state: Vector, c: int) -> tuple[float, float, float] | None:
    """As the ladder knows them; given filters believe what they are given."""
    return deviation_of_ladder(constants, state, c) if constants[0] > 0.0 else None


KALMAN_BANK = Filter(
    prepare,
    state_size,
    start,
    update,
    (*given_filters.PARAMETERS, GATE, *ladder.PARAMETERS),
    serves,
    deviation,
)
