"""A bank of steady-state Kalman filters, mixed by how likely each makes what is measured.

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
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fpt_ros.denoising.streaming import ORDER, Filter
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number, numbers

PARAMETERS = (
    Parameter("sigma", "standard deviation of the position noise", 1e-3, above=0.0),
    Parameter("states", "states of each filter: 3 is constant acceleration", [3.0, 4.0, 5.0, 6.0]),
    Parameter(
        "densities",
        "spectral density of the white noise that drives each filter's highest derivative",
        [1e2, 1e4, 1e6, 1e8],
        above=0.0,
    ),
    Parameter(
        "forgetting", "what the log-likelihood keeps a sample", 0.99, minimum=0.0, maximum=1.0
    ),
    Parameter("gate", "standard deviations beyond which a sample is an impulse", 4.0, above=2.0),
    Parameter("settling", "time without gating at the start", 0.8, unit="s", minimum=0.0),
)

REJECTIONS = 4
"""Consecutive rejections after which the motion is taken to have jumped."""

RECOVERED = 2.0
"""Standard deviations within which the prediction has found the motion again."""

MOST_STATES = 6

_HEADER = 8
_MEMBER = 4


def riccati(transition: NDArray[np.float64], noise: NDArray[np.float64]) -> NDArray[np.float64]:
    """The steady covariance of the prediction, position measured with unit variance.

    Solves P = F P F' - F P c (1 + c' P c)^-1 c' P F' + Q with c = (1, 0, ..), by doubling: step k
    is 2^k iterations of the equation at once.

    Raises:
        BadInput: no convergence in floating point.
    """
    size = len(noise)
    A, H = transition.T.copy(), noise.copy()
    G = np.zeros((size, size))
    G[0, 0] = 1.0
    for _ in range(60):
        W = np.linalg.inv(np.eye(size) + G @ H)
        step = A.T @ H @ W @ A
        A, G, H = A @ W @ A, G + A @ W @ G @ A.T, H + 0.5 * (step + step.T)
        if not np.all(np.isfinite(H)):
            break
        if np.max(np.abs(step)) <= 1e-15 * np.max(np.abs(H)):
            return H
    raise BadInput("the Riccati equation of a Kalman filter has no solution in floating point")


class Prediction(NamedTuple):
    """A steady filter in its own unit of time, where all numbers are of order one.

    ``covariance`` of the prediction, ``noise`` of a step and ``transition`` are of the states
    q^(i) unit^i / i!, position measured with unit variance; ``h`` is dt / unit.
    """

    covariance: NDArray[np.float64]
    noise: NDArray[np.float64]
    transition: NDArray[np.float64]
    h: float


def steady_prediction(states: int, density: float, sigma: float, dt: float) -> Prediction:
    """The steady filter; its unit of time is (sigma^2 dt / density)^(1/(2 states))."""
    unit = (sigma * sigma * dt / density) ** (0.5 / states)
    h = dt / unit
    order = np.arange(states)
    power = order[None, :] - order[:, None]
    choose = np.array([[math.comb(j, i) for j in range(states)] for i in range(states)])
    transition = np.where(power >= 0, choose * h ** np.maximum(power, 0), 0.0)
    factorial = np.array([math.factorial(i) for i in range(states)], dtype=float)
    back = factorial * factorial[::-1]  # i! (states - 1 - i)!
    exponent = 2 * states - 1 - order[:, None] - order[None, :]
    noise = h**exponent / (exponent * back[:, None] * back[None, :]) * h
    return Prediction(riccati(transition, noise), noise, transition, h)


def steady_gains(states: int, density: float, sigma: float, dt: float) -> NDArray[np.float64]:
    """Gains of the scaled states, by which the innovation corrects them."""
    P, _, _, h = steady_prediction(states, density, sigma, dt)
    gains: NDArray[np.float64] = P[:, 0] / (1.0 + P[0, 0]) * h ** np.arange(states)
    return gains


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: what all members share, then (states, S, 1/S, log S, gains) of each.

    S is the variance of the innovation. Shared: members, samples without gating, forgetting,
    gate^2, RECOVERED^2, 1/dt, the order of the response and its scale.
    """
    sigma, gate = number(values, "sigma"), number(values, "gate")
    states, densities = numbers(values, "states"), numbers(values, "densities")
    order = integer(values, ORDER.name)
    if not states or len(states) != len(densities):
        raise BadInput(
            f"states has {len(states)} entries and densities {len(densities)}: each filter of the "
            "bank takes one of both"
        )
    constants = [
        float(len(states)),
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
        variance = sigma * sigma / (1.0 - float(gains[0]))
        constants += [size, variance, 1.0 / variance, math.log(variance), *map(float, gains)]
    return tuple(constants)


def state_size(constants: Vector, n: int) -> int:
    """Samples so far; per coordinate and member the scaled states, log-likelihood, rejections."""
    size = 0
    at = _HEADER
    for _ in range(int(constants[0])):
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
        for _ in range(int(constants[0])):
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
    members = int(constants[0])
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


KALMAN_BANK = Filter(prepare, state_size, start, update, PARAMETERS)
