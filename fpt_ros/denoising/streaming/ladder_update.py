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

The past is forgotten within the memory of the slower one. Of an innovation that much less counts as
rounding hides (``UNSEEN``): a filter that follows an encoder's stairs sees none between them, one
that passes them by sees that of the rounding. Estimates are the weighted means over the ladder.

**Impulses.** A sample that every member misses by more than ``gate`` sigma, by four times what has
been seen of late, and by a tenth of what it moved of late in a
sample, is kept back. If the next one is off the same way, the motion has jumped, and
both count; else it was an impulse. So what a motion has done before is not kept back again.

**Missing samples** (not finite) are bridged: the members predict, and the standard deviations
(:mod:`~fpt_ros.denoising.streaming.ladder_deviation`) grow as their covariances do.

Before the first sample the motion is taken to be at rest.
"""

import math

from fpt_ros.denoising.streaming.ladder import (
    AGAINST,
    BEFORE,
    BEST,
    COUNT,
    EACH,
    GAP,
    HEADER,
    HELD,
    KEPT,
    LAST,
    LEVEL,
    LSB,
    MEMBER,
    PEAK,
    PRICE,
    REST,
    SHARED,
    SIGMA,
    SPEED,
    UNEVEN,
    weight_of,
)
from fpt_ros.denoising.streaming.three_states import response_of
from fpt_ros.laws import MutableVector, Vector, helper

NU = 24.0
UNSEEN = 0.25
"""Share of the LSB by which an innovation may be off and say nothing: rounding hides it."""
TRACKING = 0.015
"""Relative step of the medians."""
FADING = 0.5e-3
"""Share of the greatest innovation seen that a sample forgets."""
FEW, MANY = 2**6 - 1, 2**24 - 1
"""Bits of member and place: with & machine code knows that no index is negative, and leaves out
Python's wrap-around, which took a third of the time."""
MOST_HELD = 4.0
"""Samples kept back in a row at most."""
BEYOND = 4.0
"""A sample is suspect beyond so many times the greatest innovation seen of late."""
MOVES = 0.1
"""Nor is it below this share of the greatest way in a sample of late: at low rates a motion that
sets in is off by so much."""
UNHEARD = 10.0
"""Beyond so many times of that limit three samples in a row make a jump, else two."""
SETTLING = 50.0
"""First samples, of which none is kept back."""
MOST_UNEVEN = 0.05
"""Mean distance of second differences from multiples of the LSB, in units of it; where the samples
are not rounded it is 0.25, and what looked like an LSB is none."""
ROUNDED = 1e-13
"""Second differences below this share of the samples are 0."""


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
    x = first + SHARED
    limit, seen = constants[1] * state[first + SIGMA], BEYOND * state[first + PEAK]
    limit = limit if limit > seen else seen
    seen = MOVES * state[first + SPEED]
    limit = limit if limit > seen else seen
    settled = state[first + COUNT] >= SETTLING and state[first + GAP] == 0.0
    far, held = settled and nearest > limit, state[first + HELD]
    fastest = x + members - 1
    before, now = state[fastest + 6 * members], newest - state[fastest]
    enough = 1.0 if nearest < UNHEARD * limit else 2.0
    goes_on = held >= enough and now * before > 0.5 * before * before
    if far and not goes_on and held < MOST_HELD:
        state[first + HELD] = held + 1.0
        for m in range(x, x + members):
            state[m + 6 * members] = newest - state[m]
        return True
    state[first + HELD] = 0.0
    if far and held > 0.0:
        k = HEADER
        for m in range(x, x + members):
            e = state[m + 6 * members]
            g, h, i = constants[k + 1] * e, constants[k + 2] * e, constants[k + 3] * e
            state[m] += constants[k] * e + g + h + i
            state[m + members] += g + 2.0 * h + 3.0 * i
            state[m + 2 * members] += h + 3.0 * i
            state[m + 3 * members] += i
            k += MEMBER
    state[first + PEAK] *= 1.0 - FADING
    if state[first + PEAK] < nearest:
        state[first + PEAK] = nearest
    return False


@helper
def correct(
    constants: Vector, state: MutableVector, first: int, members: int, newest: float
) -> None:
    """All members with the sample: their medians, sigma, and what speaks against each."""
    x = first + SHARED
    count, sigma = state[first + COUNT], state[first + SIGMA]
    step = 2.0 / (count + 2.0)
    if step < TRACKING:
        step = TRACKING
    up, down = 1.0 + step, 1.0 - step
    lsb = state[first + LSB] if state[first + UNEVEN] < MOST_UNEVEN else 0.0
    floor, unseen = lsb / math.sqrt(12.0), UNSEEN * lsb
    scale = 1.0 / (sigma * sigma) if sigma > 0.0 else 0.0
    sigma = math.inf
    faster = cost = best = 0.0
    for j in range(members):  # the fastest first
        i = (members - 1 - j) & FEW
        m = x + i
        k = HEADER + MEMBER * i
        e = newest - state[m]
        size = abs(e)
        state[m] += constants[k] * e
        state[m + members] += constants[k + 1] * e
        state[m + 2 * members] += constants[k + 2] * e
        state[m + 3 * members] += constants[k + 3] * e
        state[m + 6 * members] = e
        median, level = state[m + 5 * members], size * constants[k + LEVEL]
        median = level if median == 0.0 else median * (up if level > median else down)
        median = median if median > floor else floor
        state[m + 5 * members] = median
        sigma = median if median < sigma else sigma
        size = size - unseen if size > unseen else 0.0
        z = size * size * constants[k + REST] * scale
        if j > 0:
            gained = 2.0 * (NU + 1.0) * (z - faster) / (2.0 * NU + z + faster)
            evidence = constants[k + KEPT] * state[m + 4 * members] + gained + constants[k + PRICE]
            state[m + 4 * members] = evidence
            cost += evidence - constants[k + AGAINST]
            best = cost if cost < best else best
        state[m + 7 * members] = cost
        faster = z
    last, before = state[first + LAST], state[first + BEFORE]
    bend = abs(newest - 2.0 * last + before)
    near = ROUNDED * (abs(newest) + abs(last) + abs(before))
    if count > 1.0 and bend > near:
        lsb = state[first + LSB]
        if lsb == 0.0 or bend < lsb:
            state[first + LSB] = bend
        else:
            rest = bend % lsb
            rest = rest if rest < lsb - rest else lsb - rest
            state[first + UNEVEN] += 2.0 * TRACKING * (rest / lsb - state[first + UNEVEN])
    state[first + SIGMA] = sigma
    state[first + BEST] = best
    state[first + BEFORE] = last
    state[first + LAST] = newest
    state[first + COUNT] = count + 1.0


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
    members = int(constants[0]) & FEW
    rate = constants[3]
    for c in range(len(q)):
        first = (c * (SHARED + EACH * members)) & MANY
        x = first + SHARED
        newest = q[c]
        nearest = advance(state, x, members, newest)
        if newest - newest != 0.0:  # not finite
            state[first + GAP] += 1.0
            state[first + HELD] = 0.0
        elif not is_kept_back(constants, state, first, members, newest, nearest):
            correct(constants, state, first, members, newest)
            state[first + GAP] = 0.0
        best = state[first + BEST]
        total = position = velocity = bend = 0.0
        for m in range(x, x + members):
            w = weight_of(state[m + 7 * members] - best)
            total += w
            position += w * state[m]
            velocity += w * state[m + members]
            bend += w * state[m + 2 * members]
        speed = abs(velocity / total)
        state[first + SPEED] *= 1.0 - FADING
        if state[first + SPEED] < speed:
            state[first + SPEED] = speed
        out_q[c] = position / total
        out_v[c] = velocity / total * rate
        acceleration = 2.0 * bend / total * rate * rate
        out_response[c] = response_of(constants[2], out_q[c], out_v[c], acceleration)
