"""A ladder of steady-state Kalman filters that needs no setting: it finds noise and bandwidth.

Each member takes the motion for an integrated Wiener process of four states (constant jerk). Its
gains depend on one number alone, the bandwidth h = (density dt^7 / sigma^2)^(1/8) [rad/sample], so
a geometric ladder of h has all filters of this kind, at any rate and in any noise.

**Noise.** In white noise of sigma, and with no motion, the innovation of member m has the variance
G_m sigma^2; a motion only adds to it. So sigma is the least over the members of median |e| / sqrt
G_m / 0.6745, and at least LSB / sqrt 12, the LSB being the least second difference seen that is
not 0 (of noise that is not rounded, nearly 0).

**Weights.** Neighbours are compared by how likely they made the innovations, z = e^2 (1 - K) /
sigma^2 being 1 on average, under a Student's t of ``NU`` degrees of freedom, of which

    log ((NU + z) / (NU + z')) is nearly 2 (z - z') / (2 NU + z + z')

The past is forgotten within the memory of the slower one. A sample equal to the one before is no
evidence: an encoder that has not moved on says nothing, for a filter that follows its stairs sees
no innovation there. Estimates are the weighted means over the ladder.

**Impulses.** A sample that every member misses by more than ``gate`` sigma, and by four times what
has been seen of late, is kept back. If the next one is off the same way, the motion has jumped, and
both count; else it was an impulse. So what a motion has done before is not kept back again.

**Missing samples** (not finite) are bridged: the members predict, and what :func:`deviation` tells
grows as their covariances do.

Before the first sample the motion is taken to be at rest.
"""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from fpt_ros.denoising.streaming import ORDER, Filter
from fpt_ros.denoising.streaming.kalman_bank import steady_gains, steady_prediction
from fpt_ros.denoising.streaming.three_states import response_of
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter, Values, integer, number

PARAMETERS = (
    Parameter("members", "filters of the ladder", 14, minimum=2, maximum=40, live=False),
    Parameter("slowest", "bandwidth of the slowest filter", 2.5e-3, unit="rad/sample", above=0.0),
    Parameter("fastest", "bandwidth of the fastest filter", 3.0, unit="rad/sample", above=0.0),
    Parameter("gate", "standard deviations beyond which it may be an impulse", 5.0, above=2.0),
)

STATES = 4
NU = 8.0
FORGOTTEN, MOST_FORGOTTEN = 0.3, 0.5
"""Share of the evidence that a sample forgets, times the bandwidth; and at most."""
TEMPERATURE = 3.0
"""Weights are exp(-evidence / 3), the evidence being -2 log likelihood."""
PRIOR = 12.0
"""Evidence that a step to the faster neighbour has to bring, times 1 - K: the noise of its
acceleration is several times as great."""
TRACKING = 0.01
"""Relative step of the medians."""
FADING = 0.5e-3
"""Share of the greatest innovation seen that a sample forgets."""
MOST_HELD = 4.0
"""Samples kept back in a row at most."""
BEYOND = 4.0
"""A sample is suspect beyond so many times the greatest innovation seen of late."""
UNHEARD = 10.0
"""Beyond so many times of that limit three samples in a row make a jump, else two."""
SETTLING = 50.0
"""First samples, of which none is kept back."""
LONGEST_GAP = 1000
"""Missing samples [1] over which the deviation grows."""
ROUNDED = 1e-13
"""Second differences below this share of the samples are 0."""

# places among the constants: shared ones, then by member four gains and these
_HEADER, _MEMBER = 4, 10
_REST, _LEVEL, _KEPT, _PRICE, _PRIOR, _BANDWIDTH = range(4, _MEMBER)
# places in the memory of a coordinate: shared ones, then vectors over the members
_LAST, _BEFORE, _LSB, _SIGMA, _PEAK, _HELD, _GAP, _COUNT, _SHARED = range(9)
_EACH = 7


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
    constants = [float(len(ladder)), number(values, "gate"), order, 1.0 / dt]
    for h, g, own, faster in zip(ladder, gains, price, [*price[1:], price[-1]], strict=True):
        rest = 1.0 - float(g[0])
        level = 1.0 / (0.6745 * math.sqrt(innovation_gain(g)))
        kept = 1.0 - min(FORGOTTEN * float(h), MOST_FORGOTTEN)
        constants += [*map(float, g), rest, level, kept, own - faster, PRIOR * rest, float(h)]
    return tuple(constants)


def state_size(constants: Vector, n: int) -> int:
    """Of each coordinate what is shared; by member four states, evidence, median, innovation."""
    return n * (_SHARED + _EACH * int(constants[0]))


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    members = int(constants[0])
    size = _SHARED + _EACH * members
    for c in range(len(q)):
        first = c * size
        for i in range(size):
            state[first + i] = 0.0
        state[first + _LAST] = state[first + _BEFORE] = q[c]
        for m in range(members):
            state[first + _SHARED + m] = q[c]


@helper
def advance(state: MutableVector, x: int, members: int, newest: float) -> float:
    """All members predict (the Pascal matrix); how far the nearest is from the newest sample."""
    nearest = math.inf
    for m in range(x, x + members):
        bend, jerk = state[m + 2 * members], state[m + 3 * members]
        state[m] += state[m + members] + bend + jerk
        state[m + members] += 2.0 * bend + 3.0 * jerk
        state[m + 2 * members] = bend + 3.0 * jerk
        miss = abs(newest - state[m])
        nearest = miss if miss < nearest else nearest
    return nearest


@helper
def is_kept_back(
    constants: Vector,
    state: MutableVector,
    first: int,
    members: int,
    newest: float,
    nearest: float,
) -> bool:
    """Whether the sample is to wait for the next; one that waited counts if this is far too."""
    x = first + _SHARED
    limit, seen = constants[1] * state[first + _SIGMA], BEYOND * state[first + _PEAK]
    if limit < seen:
        limit = seen
    settled = state[first + _COUNT] >= SETTLING and state[first + _GAP] == 0.0
    far, held = settled and nearest > limit, state[first + _HELD]
    fastest = x + members - 1
    before, now = state[fastest + 6 * members], newest - state[fastest]
    enough = 1.0 if nearest < UNHEARD * limit else 2.0
    goes_on = held >= enough and now * before > 0.5 * before * before
    if far and not goes_on and held < MOST_HELD:
        state[first + _HELD] = held + 1.0
        for m in range(x, x + members):
            state[m + 6 * members] = newest - state[m]
        return True
    state[first + _HELD] = 0.0
    if far and held > 0.0:
        k = _HEADER
        for m in range(x, x + members):
            e = state[m + 6 * members]
            g, h, i = constants[k + 1] * e, constants[k + 2] * e, constants[k + 3] * e
            state[m] += constants[k] * e + g + h + i
            state[m + members] += g + 2.0 * h + 3.0 * i
            state[m + 2 * members] += h + 3.0 * i
            state[m + 3 * members] += i
            k += _MEMBER
    state[first + _PEAK] *= 1.0 - FADING
    if state[first + _PEAK] < nearest:
        state[first + _PEAK] = nearest
    return False


@helper
def correct(
    constants: Vector, state: MutableVector, first: int, members: int, newest: float
) -> None:
    """All members with the sample; the medians, and sigma."""
    x = first + _SHARED
    count = state[first + _COUNT]
    step = 2.0 / (count + 2.0)
    if step < TRACKING:
        step = TRACKING
    up, down = 1.0 + step, 1.0 - step
    floor = state[first + _LSB] / math.sqrt(12.0)
    sigma = math.inf
    k = _HEADER
    for m in range(x, x + members):
        e = newest - state[m]
        state[m] += constants[k] * e
        state[m + members] += constants[k + 1] * e
        state[m + 2 * members] += constants[k + 2] * e
        state[m + 3 * members] += constants[k + 3] * e
        state[m + 6 * members] = e
        median, level = state[m + 5 * members], abs(e) * constants[k + _LEVEL]
        median = level if median == 0.0 else median * (up if level > median else down)
        median = median if median > floor else floor
        state[m + 5 * members] = median
        sigma = median if median < sigma else sigma
        k += _MEMBER
    last, before = state[first + _LAST], state[first + _BEFORE]
    bend, lsb = abs(newest - 2.0 * last + before), state[first + _LSB]
    near = ROUNDED * (abs(newest) + abs(last) + abs(before))
    if count > 1.0 and bend > near and (lsb == 0.0 or bend < lsb):
        state[first + _LSB] = bend
    state[first + _SIGMA] = sigma
    state[first + _BEFORE] = last
    state[first + _LAST] = newest
    state[first + _COUNT] = count + 1.0


@helper
def compare(constants: Vector, state: MutableVector, first: int, members: int) -> None:
    """The evidence of each member against its faster neighbour."""
    sigma = state[first + _SIGMA]
    scale = 1.0 / (sigma * sigma) if sigma > 0.0 else 0.0
    missed = first + _SHARED + 6 * members
    k = _HEADER
    z = state[missed] * state[missed] * constants[k + _REST] * scale
    for m in range(missed, missed + members - 1):
        e = state[m + 1]
        faster = e * e * constants[k + _MEMBER + _REST] * scale
        gained = 2.0 * (NU + 1.0) * (z - faster) / (2.0 * NU + z + faster)
        at = m - 2 * members
        state[at] = constants[k + _KEPT] * state[at] + gained + constants[k + _PRICE]
        z = faster
        k += _MEMBER


@helper
def weight_of(evidence: float) -> float:
    """Nearly exp(-evidence / TEMPERATURE); 0 from 8 temperatures on."""
    w = 1.0 - evidence * (0.125 / TEMPERATURE)
    w = w if w > 0.0 else 0.0
    w *= w
    w *= w
    return w * w


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
    rate = constants[3]
    last = _HEADER + _MEMBER * (members - 1) + _PRIOR
    for c in range(len(q)):
        first = c * (_SHARED + _EACH * members)
        x = first + _SHARED
        newest = q[c]
        nearest = advance(state, x, members, newest)
        if newest - newest != 0.0:  # not finite
            state[first + _GAP] += 1.0
            state[first + _HELD] = 0.0
        elif not is_kept_back(constants, state, first, members, newest, nearest):
            moved = newest != state[first + _LAST]
            correct(constants, state, first, members, newest)
            if moved:
                compare(constants, state, first, members)
            state[first + _GAP] = 0.0
        best = evidence = 0.0
        k = last
        for m in range(x + members - 2, x - 1, -1):
            k -= _MEMBER
            evidence += state[m + 4 * members] - constants[k]
            best = evidence if evidence < best else best
        evidence = total = position = velocity = bend = 0.0
        k = last
        for m in range(x + members - 1, x - 1, -1):
            if m < x + members - 1:
                evidence += state[m + 4 * members] - constants[k]
            w = weight_of(evidence - best)
            total += w
            position += w * state[m]
            velocity += w * state[m + members]
            bend += w * state[m + 2 * members]
            k -= _MEMBER
        out_q[c] = position / total
        out_v[c] = velocity / total * rate
        acceleration = 2.0 * bend / total * rate * rate
        out_response[c] = response_of(constants[2], out_q[c], out_v[c], acceleration)


def weights(constants: Vector, state: Vector, c: int) -> list[float]:
    """Weight of each member in the estimates of coordinate c, the slowest first."""
    members = int(constants[0])
    at = c * (_SHARED + _EACH * members) + _SHARED + 4 * members
    evidence = [0.0]
    for m in range(members - 2, -1, -1):
        prior = constants[_HEADER + _MEMBER * m + _PRIOR]
        evidence.append(evidence[-1] + state[at + m] - prior)
    best = min(evidence)
    found = [weight_of(each - best) for each in reversed(evidence)]
    return [w / math.fsum(found) for w in found]


@lru_cache(maxsize=4096)
def covariance(h: float, gap: int) -> NDArray[np.float64]:
    """Of the scaled states in noise of variance 1, ``gap`` samples after the newest one."""
    P, noise, F, _ = steady_prediction(STATES, h ** (2 * STATES), 1.0, 1.0)
    P = P - np.outer(P[:, 0], P[0]) / (1.0 + P[0, 0])
    for _ in range(gap):
        P = F @ P @ F.T + noise
    scale = h ** np.arange(STATES)
    scaled: NDArray[np.float64] = P * np.outer(scale, scale)
    return scaled


def deviation(constants: Vector, state: Vector, c: int) -> tuple[float, float, float]:
    """Standard deviations of position, velocity and response of coordinate c, as they are now.

    The variance of the mixture: the mean of the members', and their spread.
    """
    members, rate = int(constants[0]), constants[3]
    first = c * (_SHARED + _EACH * members)
    gap = min(int(state[first + _GAP]), LONGEST_GAP)
    sigma, w = state[first + _SIGMA], np.array(weights(constants, state, c))
    found = []
    for i, unit in enumerate((1.0, rate, 2.0 * rate * rate)):
        at = first + _SHARED + i * members
        x = np.array([state[at + m] for m in range(members)])
        own = [
            covariance(constants[_HEADER + _MEMBER * m + _BANDWIDTH], gap)[i, i]
            for m in range(members)
        ]
        spread = float(w @ (x - w @ x) ** 2)
        found.append(unit * math.sqrt(sigma * sigma * float(w @ np.array(own)) + spread))
    return found[0], found[1], found[int(constants[2])]


ADAPTIVE_KALMAN = Filter(prepare, state_size, start, update, PARAMETERS, deviation)
