"""The members of the ladder: prediction and correction, the noise, and how likely each is.

**Noise.** In white noise of sigma, and with no motion, the innovation of member m has the variance
G_m sigma^2; a motion only adds to it. So sigma is the least over the members of median |e| / sqrt
G_m / 0.6745, and at least LSB / sqrt 12, the LSB being the least second difference seen that is
not 0 (of noise that is not rounded, nearly 0).

**Weights.** Neighbours are compared by how likely they made the innovations, z = e^2 (1 - K) /
sigma^2 being 1 on average, under a Student's t of ``NU`` degrees of freedom, of which

    log ((NU + z) / (NU + z')) is nearly 2 (z - z') / (2 NU + z + z')

The past is forgotten within the memory of the slower one. Of an innovation that much less counts as
rounding hides (``UNSEEN``): a filter that follows an encoder's stairs sees none between them, one
that passes them by sees that of the rounding.
"""

import math

from fpt_ros.denoising.streaming.ladder import (
    AGAINST,
    BEFORE,
    BEST,
    COST,
    COUNT,
    EVIDENCE,
    FASTEST,
    FORGETS,
    HEADER,
    LAST,
    LEVEL,
    LIKELY,
    LSB,
    MEDIAN,
    MEMBER,
    MEMBERS,
    PRICE,
    REST,
    SIGMA,
    SLOWEST,
    SPREAD,
    TYPICAL,
    UNEVEN,
)
from fpt_ros.laws import MutableVector, Vector, helper

NU = 24.0
UNSEEN = 0.25
"""Share of the LSB by which an innovation may be off and say nothing: rounding hides it."""
TRACKING = 0.015
"""Relative step of the medians."""
FEW = 2**6 - 1
"""Bits of a member: with & machine code knows that no index is negative, and leaves out Python's
wrap-around, which took a third of the time."""
MOST_UNEVEN = 0.05
"""Mean distance of second differences from multiples of the LSB, in units of it; where the samples
are not rounded it is 0.25, and what looked like an LSB is none."""
ROUNDED = 1e-13
"""Second differences below this share of the samples are 0."""


@helper
def advance(state: MutableVector, at: int, members: int) -> None:
    """All members of the hypothesis at a place predict (the Pascal matrix)."""
    x = at + MEMBERS
    for m in range(x, x + members):
        bend, jerk = state[m + 2 * members], state[m + 3 * members]
        state[m] += state[m + members] + bend + jerk
        state[m + members] += 2.0 * bend + 3.0 * jerk
        state[m + 2 * members] = bend + 3.0 * jerk


@helper
def miss(state: MutableVector, at: int, slowest: int, fastest: int, newest: float) -> float:
    """How far the nearest of the members from slowest to fastest is from the newest sample."""
    nearest = math.inf
    x = at + MEMBERS
    for m in range(x + slowest, x + fastest + 1):
        off = abs(newest - state[m])
        nearest = off if off < nearest else nearest
    return nearest


@helper
def correct(
    constants: Vector,
    state: MutableVector,
    first: int,
    at: int,
    members: int,
    newest: float,
    trust: float,
) -> None:
    """All members with the sample: their medians, sigma, and what speaks against each.

    Args:
        constants: of :func:`~fpt_ros.denoising.streaming.ladder.prepare`.
        state: memory of all coordinates.
        first: where that of this coordinate begins.
        at: where the hypothesis begins.
        members: of the ladder.
        newest: sample.
        trust: share of the sample that counts as evidence, and lets the past be forgotten.
    """
    x = at + MEMBERS
    sigma, step = state[at + SIGMA], 2.0 / (state[first + COUNT] + 2.0)
    if step < TRACKING:
        step = TRACKING
    up, down = 1.0 + step, 1.0 - step
    lsb = state[first + LSB] if state[first + UNEVEN] < MOST_UNEVEN else 0.0
    floor, unseen = lsb / math.sqrt(12.0), UNSEEN * lsb
    scale = 1.0 / (sigma * sigma) if sigma > 0.0 else 0.0
    sigma = least = math.inf
    typical, likely = 0, members - 1
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
        median, level = state[m + MEDIAN * members], size * constants[k + LEVEL]
        median = level if median == 0.0 else median * (up if level > median else down)
        median = median if median > floor else floor
        state[m + MEDIAN * members] = median
        sigma = median if median < sigma else sigma
        spread = median * constants[k + SPREAD]
        if spread < least:
            least = spread
            typical = i
        size = size - unseen if size > unseen else 0.0
        z = size * size * constants[k + REST] * scale
        if j > 0:
            gained = 2.0 * (NU + 1.0) * (z - faster) / (2.0 * NU + z + faster)
            kept = (1.0 - trust * constants[k + FORGETS]) * state[m + EVIDENCE * members]
            evidence = kept + trust * (gained + constants[k + PRICE])
            state[m + EVIDENCE * members] = evidence
            cost += evidence - constants[k + AGAINST]
            if cost < best:
                best = cost
                likely = i
        state[m + COST * members] = cost
        faster = z
    state[at + SIGMA] = sigma
    state[at + BEST] = best
    state[first + TYPICAL] = least / 0.6745
    state[first + LIKELY] = float(likely)
    state[first + SLOWEST] = float(typical if typical < likely else likely)
    state[first + FASTEST] = float(likely if typical < likely else typical)


@helper
def note(state: MutableVector, first: int, newest: float) -> None:
    """Remember the sample, and look for a step of rounding in its second difference."""
    last, before = state[first + LAST], state[first + BEFORE]
    bend = abs(newest - 2.0 * last + before)
    near = ROUNDED * (abs(newest) + abs(last) + abs(before))
    if state[first + COUNT] > 1.0 and bend > near:
        lsb = state[first + LSB]
        if lsb == 0.0 or bend < lsb:
            state[first + LSB] = bend
        else:
            rest = bend % lsb
            rest = rest if rest < lsb - rest else lsb - rest
            state[first + UNEVEN] += 2.0 * TRACKING * (rest / lsb - state[first + UNEVEN])
    state[first + BEFORE] = last
    state[first + LAST] = newest
    state[first + COUNT] += 1.0
