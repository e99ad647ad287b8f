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
    Parameter(
        "acceleration_kept",
        "share of the acceleration that is kept at least where noise explains it; of the ladder",
        0.95,
        minimum=0.0,
        maximum=1.0,
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
FOLLOWED, MOST_FOLLOWED = 0.8, 0.5
"""Weight of the newest sample in the mean square of the acceleration, over the bandwidth; and at
most."""

# places among the constants: shared ones, then by member four gains and these
HEADER, MEMBER = 5, 13
REST, LEVEL, FORGETS, PRICE, AGAINST, BANDWIDTH, SPREAD, NOISE, FOLLOWS = range(4, MEMBER)

# places in the memory of a coordinate: shared ones, then two hypotheses, the believed one first
LAST, BEFORE, LSB, UNEVEN, COUNT, GAP, SPEED, TYPICAL, SLOWEST, FASTEST = range(10)
UNDECIDED, HELD, DOUBTS, SURPRISE, PEAK, MOTION, QUICK, SLOWER, RESTLESS = range(10, 19)
POWER, LIKELY, SHARED = 19, 20, 21
# places in a hypothesis: of all members, then vectors over them, the first four of them the states
SIGMA, BEST, MEMBERS = range(3)
EVIDENCE, MEDIAN, COST, EACH = range(4, 8)


def noise_gains(gains: NDArray[np.float64]) -> tuple[float, float]:
    """Variances of the innovation and of the third state in white noise of variance 1, at rest."""
    size = len(gains)
    F = np.array([[math.comb(j, i) for j in range(size)] for i in range(size)], dtype=float)
    A, g = F - np.outer(F @ gains, np.eye(size)[0]), F @ gains  # of the prediction's error
    P = np.outer(g, g)
    for _ in range(40):  # the sum of A^k g g' A'^k, by doubling
        P, A = P + A @ P @ A.T, A @ A
    corrected = np.eye(size) - np.outer(gains, np.eye(size)[0])
    C = corrected @ P @ corrected.T + np.outer(gains, gains)
    return 1.0 + float(P[0, 0]), float(C[2, 2])


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: members, gate, order of the response, 1 / dt, kept share; then each member's.

    These are four gains, 1 - K, the factor of |e| for sigma, the share of the evidence that a
    sample forgets, the price of its innovation's variance over that of the next, the prior against
    that one, the bandwidth, the inverse of the factor for sigma, the variance of the third state in
    noise of variance 1, and the weight of the newest sample in the mean square of that state.
    """
    slowest, fastest = number(values, "slowest"), number(values, "fastest")
    if slowest >= fastest:
        raise BadInput(f"slowest = {slowest:g} is not valid: it is less than fastest, {fastest:g}")
    ladder = np.geomspace(slowest, fastest, integer(values, "members"))
    gains = [steady_gains(STATES, h ** (2 * STATES), 1.0, 1.0) for h in ladder]
    price = [-math.log1p(-float(g[0])) for g in gains]
    order = float(integer(values, ORDER.name))
    gate, kept = number(values, "gate") or GATE, number(values, "acceleration_kept")
    constants = [float(len(ladder)), gate, order, 1.0 / dt, kept]
    for h, g, own, faster in zip(ladder, gains, price, [*price[1:], price[-1]], strict=True):
        rest = 1.0 - float(g[0])
        innovation, bend = noise_gains(g)
        level = 1.0 / (0.6745 * math.sqrt(innovation))
        forgets = min(FORGOTTEN * float(h), MOST_FORGOTTEN)
        against = PRIOR * rest if h < ladder[-1] else 0.0
        constants += [*map(float, g), rest, level, forgets, own - faster, against, float(h)]
        constants += [1.0 / level, bend, min(FOLLOWED * float(h), MOST_FOLLOWED)]
    return tuple(constants)


@helper
def hypothesis(members: int) -> int:
    """Size of a hypothesis: sigma, the least cost; by member states, evidence, median, cost.

    The evidence is that for the faster neighbour; the cost, what speaks against the member, is the
    sum of it over all faster ones, less their prior, in units of -2 log likelihood. The median is
    that of |e|, over what it is in noise of sigma = 1.
    """
    return MEMBERS + EACH * members


@helper
def memory(members: int) -> int:
    """Size of what is remembered of a coordinate.

    ``LAST`` and ``BEFORE``: samples; ``LSB``, ``UNEVEN``: step of rounding, and how far second
    differences are from multiples of it; ``COUNT``, ``GAP``: samples, and missing ones in a row;
    ``SPEED``: the greatest of late, by sample; ``POWER``: mean square of the third state of late,
    which is half of the acceleration; ``LIKELY``: the likeliest member. ``SLOWEST`` to ``FASTEST``:
    the member whose innovations are usually the least, ``TYPICAL`` being their standard deviation,
    to the likeliest one, or the other way round. The others are of doubts
    (:mod:`~fpt_ros.denoising.streaming.ladder_doubts`).
    """
    return SHARED + 2 * hypothesis(members)


def state_size(constants: Vector, n: int) -> int:
    """Of each coordinate what is shared, and two hypotheses."""
    return n * memory(int(constants[0]))


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    members = int(constants[0])
    for c in range(len(q)):
        first = c * memory(members)
        for i in range(memory(members)):
            state[first + i] = 0.0
        state[first + LAST] = state[first + BEFORE] = q[c]
        state[first + MOTION] = 1.0
        x, cost = first + SHARED + MEMBERS, 0.0
        for m in range(members - 1, -1, -1):
            cost -= constants[HEADER + MEMBER * m + AGAINST]
            state[x + m] = q[c]
            state[x + m + COST * members] = cost
        state[first + SHARED + BEST] = cost


@helper
def weight_of(evidence: float) -> float:
    """Nearly exp(-evidence / TEMPERATURE); 0 from 8 temperatures on."""
    w = 1.0 - evidence * (0.125 / TEMPERATURE)
    w = w if w > 0.0 else 0.0
    w *= w
    w *= w
    return w * w
