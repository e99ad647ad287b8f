"""A ladder of steady-state Kalman filters that needs no setting: it finds noise and bandwidth.

Each member takes the motion for an integrated Wiener process of four states (constant jerk). Its
gains depend on one number alone, the bandwidth h = (density dt^7 / sigma^2)^(1/8) [rad/sample], so
a geometric ladder of h has all filters of this kind, at any rate and in any noise. Estimates are
the weighted means over the ladder.

:mod:`~fpt_ros.denoising.streaming.ladder_members`: the noise, and how likely each member is;
:mod:`~fpt_ros.denoising.streaming.ladder_doubts`: impulses, motions that set in, other noise.

**Missing samples** (not finite) are bridged: the members predict, and the standard deviations
(:mod:`~fpt_ros.denoising.streaming.ladder_deviation`) grow as their covariances do.

Before the first sample the motion is taken to be at rest.
"""

from fpt_ros.denoising.streaming.ladder import (
    BEST,
    COST,
    GAP,
    MEMBERS,
    SHARED,
    SPEED,
    UNDECIDED,
    hypothesis,
    memory,
    weight_of,
)
from fpt_ros.denoising.streaming.ladder_doubts import FADING, follow_noise, is_waiting, take
from fpt_ros.denoising.streaming.ladder_members import FEW, advance
from fpt_ros.denoising.streaming.three_states import response_of
from fpt_ros.laws import MutableVector, Vector

MANY = 2**24 - 1
"""Bits of a place: with & machine code knows that no index is negative (:data:`FEW`)."""


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
        first = (c * memory(members)) & MANY
        believed = first + SHARED
        newest = q[c]
        advance(state, believed, members)
        if state[first + UNDECIDED] > 0.0:
            advance(state, believed + hypothesis(members), members)
        if newest - newest != 0.0:  # not finite
            state[first + GAP] += 1.0
        else:
            undecided = state[first + UNDECIDED] > 0.0
            if not undecided or not is_waiting(constants, state, first, members, newest):
                follow_noise(constants, state, first, members, newest)
                take(constants, state, first, members, newest)
            state[first + GAP] = 0.0
        best = state[believed + BEST]
        total = position = velocity = bend = 0.0
        x = believed + MEMBERS
        for m in range(x, x + members):
            w = weight_of(state[m + COST * members] - best)
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
