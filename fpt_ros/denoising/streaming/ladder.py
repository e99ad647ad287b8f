"""The ladder of Kalman filters of a bank that is given none: its filters and its memory."""

import math

import numpy as np
from numpy.typing import NDArray

from fpt_ros.denoising.streaming import ORDER
from fpt_ros.denoising.streaming.steady_filter import steady_gains
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter, Values, integer, number

PARAMETERS = (
    Parameter("members", "filters of the ladder", 18, minimum=2, maximum=40, live=False),
    Parameter("slowest", "bandwidth of its slowest filter", 3e-3, unit="rad/sample", above=0.0),
    Parameter(
        "fastest",
        "bandwidth of its fastest filter",
        3.0,
        unit="rad/sample",
        above=0.0,
        maximum=30.0,
    ),
)

GATE = 5.0
"""Where none is given."""

STATES = 4
FORGOTTEN, MOST_FORGOTTEN = 0.2, 0.5
"""Share of the evidence that a sample forgets, times the bandwidth; and at most."""
TEMPERATURE = 3.0
"""Weights are exp(-evidence / 3), the evidence being -2 log likelihood."""
PRIOR = 9.0
"""Evidence that a step to the faster neighbour has to bring, times 1 - K: the noise of its
acceleration is several times as great."""

# places among the constants: shared ones, then by member four gains and these
HEADER, MEMBER = 4, 10
REST, LEVEL, KEPT, PRICE, AGAINST, BANDWIDTH = range(4, MEMBER)
# places in the memory of a coordinate: shared ones, then vectors over the members
LAST, BEFORE, LSB, SIGMA, PEAK, HELD, GAP, COUNT, BEST, SPEED, UNEVEN, SHARED = range(12)
EACH = 8


def innovation_gain(gains: NDArray[np.float64]) -> float:
    """Variance of the innovation in white noise of variance 1, and with no motion."""
    size = len(gains)
    F = np.array([[math.comb(j, i) for j in range(size)] for i in range(size)], dtype=float)
    A, g = F - np.outer(F @ gains, np.eye(size)[0]), F @ gains  # of the prediction's error
    P = np.outer(g, g)
    for _ in range(40):  # the sum of A^k g g' A'^k, by doubling
        P, A = P + A @ P @ A.T, A @ A
    return 1.0 + float(P[0, 0])


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: members, gate, order of the response, 1 / dt; then those of each member.

    These are four gains, 1 - K, the factor of |e| for sigma, what of the evidence is kept, the
    price of its innovation's variance over that of the next, the prior against that one, and the
    bandwidth.
    """
    slowest, fastest = number(values, "slowest"), number(values, "fastest")
    if slowest >= fastest:
        raise BadInput(f"slowest = {slowest:g} is not valid: it is less than fastest, {fastest:g}")
    ladder = np.geomspace(slowest, fastest, integer(values, "members"))
    gains = [steady_gains(STATES, h ** (2 * STATES), 1.0, 1.0) for h in ladder]
    price = [-math.log1p(-float(g[0])) for g in gains]
    order = float(integer(values, ORDER.name))
    constants = [float(len(ladder)), number(values, "gate") or GATE, order, 1.0 / dt]
    for h, g, own, faster in zip(ladder, gains, price, [*price[1:], price[-1]], strict=True):
        rest = 1.0 - float(g[0])
        level = 1.0 / (0.6745 * math.sqrt(innovation_gain(g)))
        kept = 1.0 - min(FORGOTTEN * float(h), MOST_FORGOTTEN)
        against = PRIOR * rest if h < ladder[-1] else 0.0
        constants += [*map(float, g), rest, level, kept, own - faster, against, float(h)]
    return tuple(constants)


def state_size(constants: Vector, n: int) -> int:
    """Of each coordinate what is shared; by member four states, evidence, median, innovation, cost.

    The evidence is that for the faster neighbour; the cost, what speaks against the member, is the
    sum of it over all faster ones, less their prior, in units of -2 log likelihood.
    """
    return n * (SHARED + EACH * int(constants[0]))


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    members = int(constants[0])
    size = SHARED + EACH * members
    for c in range(len(q)):
        first = c * size
        for i in range(size):
            state[first + i] = 0.0
        state[first + LAST] = state[first + BEFORE] = q[c]
        cost = 0.0
        for m in range(members - 1, -1, -1):
            cost -= constants[HEADER + MEMBER * m + AGAINST]
            state[first + SHARED + m] = q[c]
            state[first + SHARED + m + 7 * members] = cost
        state[first + BEST] = cost


@helper
def weight_of(evidence: float) -> float:
    """Nearly exp(-evidence / TEMPERATURE); 0 from 8 temperatures on."""
    w = 1.0 - evidence * (0.125 / TEMPERATURE)
    w = w if w > 0.0 else 0.0
    w *= w
    w *= w
    return w * w
