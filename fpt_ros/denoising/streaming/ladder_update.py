"""A ladder of steady-state Kalman filters that needs no setting: it finds noise and bandwidth.

Each member takes the motion for an integrated Wiener process of four states (constant jerk). Its
gains depend on one number alone, the bandwidth h = (density dt^7 / sigma^2)^(1/8) [rad/sample], so
a geometric ladder of h has all filters of this kind, at any rate and in any noise. Estimates are
the weighted means over the ladder.

**The acceleration** is shrunk where noise explains it, by Wiener's factor, but to the share
``acceleration_kept`` at least: a loop that is closed with it needs its gain.

:mod:`~fpt_ros.denoising.streaming.ladder_members`: the noise, and how likely each member is;
:mod:`~fpt_ros.denoising.streaming.ladder_doubts`: impulses, motions that set in, other noise.

**Missing samples** (not finite) are bridged: the members predict, and the standard deviations
(:mod:`~fpt_ros.denoising.streaming.ladder_deviation`) grow as their covariances do.

Before the first sample the motion is taken to be at rest.
"""

from fpt_ros.denoising.streaming.ladder import (
    BEST,
    COST,
    FOLLOWS,
    GAP,
    HEADER,
    LIKELY,
    MEMBER,
    MEMBERS,
    NOISE,
    POWER,
    SHARED,
    SIGMA,
    SPEED,
    UNDECIDED,
    hypothesis,
    memory,
    weight_of,
)
from fpt_ros.denoising.streaming.ladder_doubts import FADING, follow_noise, is_waiting, take
from fpt_ros.denoising.streaming.ladder_members import FEW, advance
from fpt_ros.denoising.streaming.three_states import response_of
from fpt_ros.laws import MutableVector, Vector, helper

MANY = 2**24 - 1
"""Bits of a place: with & machine code knows that no index is negative (:data:`FEW`)."""

ERRING = 2.0
"""The acceleration is off by so many times the variance that noise gives it: the likeliest
bandwidth is where noise and lag cost about the same."""
REMEMBERED = 100.0
"""Mean square of the acceleration at most, over its square and the variance that noise gives it: a
fast motion that is over counts no more."""


@helper
def factor_of(state: MutableVector, first: int, square: float, noise: float, step: float) -> float:
    """Wiener's factor of the third state, 1 - error / power; 0 where noise may explain all of it.

    Args:
        state: memory of all coordinates.
        first: where that of this coordinate begins.
        square: of the third state.
        noise: variance that noise gives it.
        step: weight of the newest square in the mean.
    """
    power = state[first + POWER]
    power += step * (square - power)
    most = REMEMBERED * (square if square > noise else noise)
    power = power if power < most else most
    state[first + POWER] = power
    error = ERRING * noise
    return 1.0 - error / power if error < power else 0.0


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
    rate, least = constants[3], constants[4]
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
        scale = 1.0 / total
        velocity *= scale
        bend *= scale
        speed = abs(velocity)
        state[first + SPEED] *= 1.0 - FADING
        if state[first + SPEED] < speed:
            state[first + SPEED] = speed
        out_q[c] = position * scale
        out_v[c] = velocity * rate
        k = HEADER + MEMBER * (int(state[first + LIKELY]) & FEW)
        noise = constants[k + NOISE] * state[believed + SIGMA] * state[believed + SIGMA]
        factor = factor_of(state, first, bend * bend, noise, constants[k + FOLLOWS])
        bend *= factor if factor > least else least
        acceleration = 2.0 * bend * rate * rate
        out_response[c] = response_of(constants[2], out_q[c], out_v[c], acceleration)
