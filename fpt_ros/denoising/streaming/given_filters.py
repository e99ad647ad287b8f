"""Filters of the bank that are given by hand: mixed by how likely each makes what is measured.

Each member takes the motion for an integrated Wiener process: white noise of spectral density
``densities[m]`` drives the derivative of order ``states[m]``. In the scaled states x_i = q^(i) dt^i
/ i! the transition is the Pascal matrix of small integers, applied by additions, and the gains are
constant: they come from the Riccati equation once, in :func:`prepare`.

The weights are the softmax of the members' log-likelihoods, of which the past is forgotten by a
factor a sample. A sample off the prediction by more than ``gate`` standard deviations is an impulse
and not used; after four in a row the motion has jumped, and everything is accepted until the
prediction is within two standard deviations again. A sample that is not finite is missing: the
filters predict. Before the first sample the motion is taken to be at rest; there is no gating while
this settles.

With one member this is a plain Kalman filter.
"""

import math

from fpt_ros.denoising.streaming import ORDER
from fpt_ros.denoising.streaming.steady_filter import steady_gains
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number, numbers

SIGMA, STATES, DENSITIES = 1e-3, [3.0, 4.0, 5.0, 6.0], [1e2, 1e4, 1e6, 1e8]
"""Of what is not given, where one of the three is."""

PARAMETERS = (
    Parameter(
        "sigma",
        "standard deviation of the position noise; 0: found on line, or, where states or densities "
        f"are given, {SIGMA:g}",
        0.0,
        minimum=0.0,
    ),
    Parameter(
        "states",
        "states of each filter, 3 is constant acceleration; empty: as many filters of four as are "
        "needed, found on line, or, where sigma or densities are given, 3, 4, 5 and 6",
        [],
        live=False,
    ),
    Parameter(
        "densities",
        "spectral density of the white noise that drives each filter's highest derivative; empty: "
        "1e2, 1e4, 1e6, 1e8, where sigma or states are given",
        [],
        above=0.0,
    ),
    Parameter(
        "forgetting",
        "what the log-likelihood of given filters keeps a sample",
        0.99,
        minimum=0.0,
        maximum=1.0,
    ),
    Parameter(
        "settling",
        "time without gating at the start, of given filters",
        0.8,
        unit="s",
        minimum=0.0,
    ),
)

GATE = 4.0
"""Of given filters, where none is given."""

REJECTIONS = 4
"""Consecutive rejections after which the motion is taken to have jumped."""

RECOVERED = 2.0
"""Standard deviations within which the prediction has found the motion again."""

MOST_STATES = 6

_HEADER = 8
_MEMBER = 4


def are_given(values: Values) -> bool:
    """Whether any of what makes these filters is given."""
    return any((number(values, "sigma"), numbers(values, "states"), numbers(values, "densities")))


def given(values: Values) -> tuple[float, list[float], list[float]]:
    """sigma, states and densities, with what stands for those that are not given."""
    return (
        number(values, "sigma") or SIGMA,
        numbers(values, "states") or STATES,
        numbers(values, "densities") or DENSITIES,
    )


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: what all members share, then (states, S, 1/S, log S, gains) of each.

    S is the variance of the innovation. Shared: minus the number of members, samples without
    gating, forgetting, gate^2, RECOVERED^2, 1/dt, the order of the response and its scale.
    """
    sigma, states, densities = given(values)
    gate = number(values, "gate") or GATE
    order = integer(values, ORDER.name)
    if len(states) != len(densities):
        raise BadInput(
            f"states has {len(states)} entries and densities {len(densities)}: each filter of the "
            "bank takes one of both"
        )
    constants = [
        -float(len(states)),
        float(math.ceil(number(values, "settling") / dt)),
        number(values, "forgetting"),
        gate * gate,
        RECOVERED * RECOVERED,
        1.0 / dt,
        float(order),
        (1.0, 1.0 / dt, 2.0 / (dt * dt))[order],
    ]
    least = max(2, order + 1)
    for size, density in zip(states, densities, strict=True):
        if size not in range(least, MOST_STATES + 1):
            raise BadInput(
                f"states: {size:g} is not valid, a filter takes an integer from {least} to "
                f"{MOST_STATES}"
            )
        gains = steady_gains(int(size), density, sigma, dt)
        rest = 1.0 - float(gains[0])
        if not 0.0 < rest < 1.0:
            raise BadInput(
                f"densities: with {density:g}, sigma = {sigma:g} and dt = {dt:g} s the filter of "
                f"{size:g} states takes every sample as it is, or none: another density, or give "
                "neither states, densities nor sigma"
            )
        variance = sigma * sigma / rest
        constants += [size, variance, 1.0 / variance, math.log(variance), *map(float, gains)]
    return tuple(constants)


def state_size(constants: Vector, n: int) -> int:
    """Samples so far; per coordinate and member the scaled states, log-likelihood, rejections."""
    size = 0
    at = _HEADER
    for _ in range(int(-constants[0])):
        states = int(constants[at])
        size += states + 2
        at += _MEMBER + states
    return 1 + n * size


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    state[0] = 1.0
    x = 1
    for c in range(len(q)):
        at = _HEADER
        for _ in range(int(-constants[0])):
            states = int(constants[at])
            state[x] = q[c]
            for i in range(1, states + 2):
                state[x + i] = 0.0
            x += states + 2
            at += _MEMBER + states


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
    """One step of every member, and their weighted mean."""
    members = int(-constants[0])
    forgetting, gate, recovered = constants[2], constants[3], constants[4]
    order = int(constants[6])
    gating = state[0] >= constants[1]
    if not gating:
        state[0] += 1.0
    x = 1
    for c in range(len(q)):
        first = x
        best = math.inf
        at = _HEADER
        for _ in range(members):
            states = int(constants[at])
            for i in range(states - 1):  # the Pascal matrix, by additions
                for j in range(states - 2, i - 1, -1):
                    state[x + j] += state[x + j + 1]
            innovation = q[c] - state[x]
            cost, rejected = x + states, x + states + 1
            if innovation - innovation == 0.0:  # finite
                distance = innovation * innovation * constants[at + 2]
                state[cost] = forgetting * state[cost] + constants[at + 3]
                state[cost] += distance if distance < gate else gate
                if gating and distance > gate and state[rejected] < REJECTIONS:
                    state[rejected] += 1.0
                else:
                    for i in range(states):
                        state[x + i] += constants[at + _MEMBER + i] * innovation
                    if state[rejected] < REJECTIONS or distance < recovered:
                        state[rejected] = 0.0
            if state[cost] < best:
                best = state[cost]
            x += states + 2
            at += _MEMBER + states
        total = position = velocity = response = 0.0
        x = first
        at = _HEADER
        for _ in range(members):
            states = int(constants[at])
            weight = math.exp(0.5 * (best - state[x + states]))
            total += weight
            position += weight * state[x]
            velocity += weight * state[x + 1]
            response += weight * state[x + order]
            x += states + 2
            at += _MEMBER + states
        out_q[c] = position / total
        out_v[c] = velocity / total * constants[5]
        out_response[c] = response / total * constants[7]
