"""What the ladder makes of a sample that it did not expect: an impulse, a motion, or other noise.

**Two hypotheses.** A sample that the usual members miss by more than ``gate`` times what they miss
usually is an impulse, or a motion sets in. Both are kept until the next sample: members without
this one, and members with it. The next one decides: an impulse returns to where the members
without it predict, a motion does not. So an impulse leaves nothing behind but for one estimate.
What is far beyond anything expected takes two more samples to be a motion: impulses come in pairs.

**Which is believed meanwhile.** The one without it, if the sample is off by more than ``gate``
times the usual, four times what a motion was off of late, and a tenth of what it moved of late in a
sample; else the one with it. What a motion has done before is not kept back again, unless of late
most of what was doubtful were impulses (``MOTION``: the share of motions among the verdicts). Fast
filters do not bear a missing sample: where they are the likely ones, nothing is doubted that a
motion has done before, and not for longer than they remember.

**Evidence.** A sample says nothing about bandwidths while it is kept back, and little where the
fastest member is off more than usual and more than the slower ones: a motion that sets in is what
the fastest one expects, noise and impulses are not.

**Noise that grows.** Two fast members have quick medians as well (``QUICK``, ``SLOWER``). Where
these agree, as they do in white noise and not in motion, and are twice sigma, the slow medians are
lifted to them, and the evidence, which was in units of too small a sigma, shrinks.

In the memory: ``UNDECIDED`` counts the samples kept back since a fork, 0 where there is none;
``HELD``, whether the believed hypothesis is the one without them; ``SURPRISE``, how far the first
of them was off; ``DOUBTS``, odd samples in a row; ``PEAK``, the greatest surprise of a motion of
late; ``RESTLESS``, for how many samples more noise is suspected.
"""

from fpt_ros.denoising.streaming.ladder import (
    BANDWIDTH,
    COUNT,
    DOUBTS,
    EVIDENCE,
    FASTEST,
    GAP,
    HEADER,
    HELD,
    LEVEL,
    MEDIAN,
    MEMBER,
    MEMBERS,
    MOTION,
    PEAK,
    QUICK,
    RESTLESS,
    SHARED,
    SIGMA,
    SLOWER,
    SLOWEST,
    SPEED,
    SURPRISE,
    TYPICAL,
    UNDECIDED,
    hypothesis,
)
from fpt_ros.denoising.streaming.ladder_members import FEW, correct, miss, note
from fpt_ros.laws import MutableVector, Vector, helper

SETTLING, STARTING = 25.0, 20.0
"""First samples of which none is doubted; and those that the members need to find the motion."""
FADING = 0.5e-3
"""Share of the greatest surprise and speed that a sample forgets."""
BEYOND = 4.0
"""A sample is kept back beyond so many times the greatest surprise of a motion of late."""
MOVES = 0.1
"""Nor is it below this share of the greatest way in a sample of late: at low rates a motion that
sets in is off by so much."""
MOST_DOUBTS = 4.0
"""Samples in a row at most that are doubted."""
CALM = 0.5
"""Bandwidth [rad/sample] below which the members bear a missing sample."""
MOSTLY = 0.7
"""Where the share of motions among the verdicts is less, impulses are what surprises."""
VERDICT = 0.1
"""Weight of the newest verdict in that share."""
LEAST, MOST, MOST_FAST = 0.05, 1.0, 3.0
"""How near the members with the sample have to be for a motion, as a share of how near those
without it are: where all verdicts were impulses; where all were motions; and that of fast members,
for whom a sample of a motion that is dropped is the greater loss."""
UNHEARD = 10.0
"""Beyond so many times the gate it takes three samples for a motion, where filters bear that."""
ONWARD, BACK = 0.5, 0.5
"""A motion that slow members follow goes on: without the sample they are off the same way as
before, by at least this share of that, and by more than this share of the gate."""
LITTLE = 0.1
"""Share of the evidence of a sample that speaks of noise or an impulse."""
UNUSUAL, WORSE = 6.0, 2.0
"""It does so where the fastest member is off by more than so many standard deviations, and by so
many times what the slowest of the usual ones is off."""
LASTS = 4.0
"""Samples after such a one that are taken for noise as well."""
QUICKLY = 0.14
"""Relative step of the quick medians."""
RUNGS = 4
"""By so many rungs the second member with a quick median is slower than the fastest one."""
AGREE, MUCH = 2.0, 2.0
"""Quick medians agree within this ratio; and the noise is greater where they are so many sigma."""


@helper
def _copy(state: MutableVector, source: int, target: int, size: int) -> None:
    for i in range(size):
        state[target + i] = state[source + i]


@helper
def is_waiting(
    constants: Vector, state: MutableVector, first: int, members: int, newest: float
) -> bool:
    """Decide on the doubtful sample before this one, whose hypothesis is believed from now on.

    Where it takes one sample more, this one is kept back as well, and the answer is True.
    """
    believed = first + SHARED
    other = believed + hypothesis(members)
    slowest, fastest = int(state[first + SLOWEST]) & FEW, int(state[first + FASTEST]) & FEW
    held = state[first + HELD] > 0.0
    without = miss(state, believed if held else other, slowest, fastest, newest)
    with_it = miss(state, other if held else believed, slowest, members - 1, newest)
    share, surprise = state[first + MOTION], state[first + SURPRISE]
    gate = constants[1] * state[first + TYPICAL]
    now = newest - state[(believed if held else other) + MEMBERS + slowest]
    goes_on = now * surprise > ONWARD * surprise * surprise and without > BACK * gate
    h = constants[HEADER + MEMBER * fastest + BANDWIDTH]
    nearer = LEAST + ((MOST if h < CALM else MOST_FAST) - LEAST) * share
    is_motion = with_it < nearer * without and (goes_on or h > CALM)
    is_unheard = abs(surprise) > UNHEARD * gate and h < CALM
    if is_motion and held and is_unheard and state[first + UNDECIDED] == 1.0:
        state[first + UNDECIDED] = 2.0
        correct(constants, state, first, other, members, newest, 0.0)
        note(state, first, newest)
        return True
    state[first + MOTION] += VERDICT * ((1.0 if is_motion else 0.0) - share)
    if is_motion and state[first + PEAK] < abs(surprise):
        state[first + PEAK] = abs(surprise)
    if is_motion == held:
        _copy(state, other, believed, hypothesis(members))
    state[first + UNDECIDED] = 0.0
    return False


@helper
def _quick(state: MutableVector, at: int, level: float) -> float:
    """A quick median of levels, kept at a place."""
    median = state[at]
    median = level if median == 0.0 else median * (1.0 + (QUICKLY if level > median else -QUICKLY))
    state[at] = median
    return median


@helper
def follow_noise(
    constants: Vector, state: MutableVector, first: int, members: int, newest: float
) -> None:
    """Lift sigma and the medians where the noise has become another."""
    believed = first + SHARED
    x = believed + MEMBERS
    a = members - 1
    b = a - RUNGS if a > RUNGS else 0
    level = abs(newest - state[x + a]) * constants[HEADER + MEMBER * a + LEVEL]
    quick = _quick(state, first + QUICK, level)
    level = abs(newest - state[x + b]) * constants[HEADER + MEMBER * b + LEVEL]
    slower = _quick(state, first + SLOWER, level)
    least = quick if quick < slower else slower
    if slower < AGREE * quick and least > MUCH * state[believed + SIGMA]:
        smaller = state[believed + SIGMA] / least
        for m in range(x, x + members):
            state[m + EVIDENCE * members] *= smaller * smaller
            if state[m + MEDIAN * members] < least:
                state[m + MEDIAN * members] = least
        state[believed + SIGMA] = least


@helper
def _trust(
    constants: Vector, state: MutableVector, first: int, members: int, newest: float
) -> float:
    """Share of the sample that counts as evidence."""
    x = first + SHARED + MEMBERS
    a = members - 1
    off = abs(newest - state[x + a])
    slow = abs(newest - state[x + (int(state[first + SLOWEST]) & FEW)])
    usual = state[x + a + MEDIAN * members]
    level = off * constants[HEADER + MEMBER * a + LEVEL]
    is_noise = state[first + COUNT] >= SETTLING and level > UNUSUAL * usual and off > WORSE * slow
    if is_noise:
        state[first + RESTLESS] = LASTS
    elif state[first + RESTLESS] > 0.0:
        state[first + RESTLESS] -= 1.0
        is_noise = True
    return LITTLE if is_noise else 1.0


@helper
def take(constants: Vector, state: MutableVector, first: int, members: int, newest: float) -> None:
    """The sample, or both hypotheses about it."""
    believed = first + SHARED
    other = believed + hypothesis(members)
    slowest, fastest = int(state[first + SLOWEST]) & FEW, int(state[first + FASTEST]) & FEW
    nearest = miss(state, believed, slowest, fastest, newest)
    trust = _trust(constants, state, first, members, newest)
    gate, peak = constants[1] * state[first + TYPICAL], state[first + PEAK]
    state[first + PEAK] *= 1.0 - FADING
    count = state[first + COUNT]
    if STARTING <= count < SETTLING and state[first + PEAK] < nearest:
        state[first + PEAK] = nearest
    doubted = 1.0
    if state[first + MOTION] < MOSTLY:
        peak, doubted = 0.0, LITTLE
    h = constants[HEADER + MEMBER * fastest + BANDWIDTH]
    is_odd = nearest > gate and (h < CALM or nearest > peak)
    is_odd = is_odd and count >= SETTLING and state[first + GAP] == 0.0
    doubts = state[first + DOUBTS]
    state[first + DOUBTS] = doubts + 1.0 if is_odd else 0.0
    if is_odd and (doubts == 0.0 or (doubts < MOST_DOUBTS and doubts * h < 1.0)):
        _copy(state, believed, other, hypothesis(members))
        state[first + UNDECIDED] = 1.0
        ahead = newest > state[believed + MEMBERS + slowest]
        state[first + SURPRISE] = nearest if ahead else -nearest
        is_held = nearest > BEYOND * peak and nearest > MOVES * state[first + SPEED]
        is_held = is_held and doubts * h < 1.0
        state[first + HELD] = 1.0 if is_held else 0.0
        if is_held:
            correct(constants, state, first, other, members, newest, 0.0)
        else:
            correct(constants, state, first, believed, members, newest, doubted * trust)
    else:
        correct(constants, state, first, believed, members, newest, trust)
    note(state, first, newest)
