"""What the supervisor of :mod:`~fpt_ros.denoising.streaming.fuzzy` sees, and what it decides."""

import math

from fpt_ros.denoising.mamdani import SIZE, infer
from fpt_ros.denoising.offline.noise import MAD
from fpt_ros.denoising.streaming.given_filters import RECOVERED
from fpt_ros.laws import MutableVector, Vector, clipped, helper

# places among the constants: shared ones and two rule bases, then by window these and four kernels
WIDTH_RULES = 5
DOUBT_RULES = WIDTH_RULES + SIZE
HEADER = DOUBT_RULES + SIZE
MEMBER = 3
# places in the memory of a coordinate: shared ones, the last of them three samples; then vectors
PLACE, DOUBTED, IN_A_ROW, JUMPED, IMPULSES, COUNT, OLDEST, LAST = range(8)
SHARED = LAST + 3

MOST = 4.0
"""Greatest difference of e^2 / S that counts: no sample must decide alone."""

FAR = 24.0
"""Standard deviations beyond which three samples alike in a row make a jump, else two."""

LEVEL = 1.0 / (MAD * math.sqrt(20.0))
"""sigma of white noise over the median of its third differences' sizes."""


@helper
def noise_of(state: MutableVector, first: int, memory: int, newest: float) -> float:
    """Standard deviation of the noise, with the newest sample; NaN while samples are too few.

    ``memory`` third differences lie in the order of time, and behind it in that of their size.
    """
    last = first + LAST
    size = abs(newest - 3.0 * state[last] + 3.0 * state[last + 1] - state[last + 2])
    state[last + 2], state[last + 1], state[last] = state[last + 1], state[last], newest
    times = first + SHARED
    sizes = times + memory
    if size - size == 0.0:  # finite: it touches no missing sample
        oldest = int(state[first + OLDEST])
        gone = state[times + oldest]
        state[times + oldest] = size
        state[first + OLDEST] = float(oldest + 1 if oldest + 1 < memory else 0)
        if state[first + COUNT] < memory:
            state[first + COUNT] += 1.0
        i = 0
        while state[sizes + i] < gone:
            i += 1
        while i + 1 < memory and state[sizes + i + 1] < size:
            state[sizes + i] = state[sizes + i + 1]
            i += 1
        while i > 0 and state[sizes + i - 1] > size:
            state[sizes + i] = state[sizes + i - 1]
            i -= 1
        state[sizes + i] = size
    if state[first + COUNT] < memory:
        return math.nan
    return LEVEL * state[sizes + memory // 2]


@helper
def nearest_of(constants: Vector, state: MutableVector, first: int, newest: float) -> float:
    """The least e^2 / (1 + |p|^2) of all windows: as if the sample had this for its variance."""
    members, longest, memory = int(constants[0]), int(constants[1]), int(constants[3])
    expected = first + SHARED + 2 * memory + longest
    nearest = math.inf
    at = HEADER
    for m in range(members):
        e = newest - state[expected + m]
        square = e * e * constants[at + 1]
        nearest = square if square < nearest else nearest
        at += MEMBER + 4 * int(constants[at])
    return nearest


@helper
def believed(
    constants: Vector,
    state: MutableVector,
    first: int,
    sigma: float,
    nearest: float,
    newest: float,
) -> float:
    """The sample, or what is expected in its place if it is missing or the expert doubts it.

    Impulses in a row are seldom alike: on the same side, and at least half as far as the one
    before. Samples that are have jumped, and are believed until a prediction is near again.
    """
    members, longest, memory = int(constants[0]), int(constants[1]), int(constants[3])
    expected = first + SHARED + 2 * memory + longest
    place = state[first + PLACE]
    lower = int(place) if place < members - 1.0 else members - 2
    prediction = state[expected + lower]
    prediction += (place - lower) * (state[expected + lower + 1] - prediction)
    if newest - newest != 0.0:
        return prediction
    doubted = False
    if sigma > 0.0:
        distance, miss = math.sqrt(nearest) / sigma, newest - prediction
        before, in_a_row = state[first + DOUBTED], state[first + IN_A_ROW]
        state[first + DOUBTED] = state[first + IN_A_ROW] = 0.0
        if state[first + JUMPED] > 0.0:
            state[first + JUMPED] = 0.0 if distance < RECOVERED else 1.0
        elif infer(constants, DOUBT_RULES, distance, state[first + IMPULSES]) > 0.5:
            alike = miss * before > 0.5 * before * before
            enough = 1.0 if distance < FAR else 2.0
            if alike and in_a_row >= enough:
                state[first + JUMPED] = 1.0
            else:
                doubted = True
                state[first + DOUBTED] = miss
                state[first + IN_A_ROW] = in_a_row + 1.0 if alike else 1.0
        state[first + IMPULSES] += ((1.0 if doubted else 0.0) - state[first + IMPULSES]) / memory
    return prediction if doubted else newest


@helper
def judge(
    constants: Vector,
    state: MutableVector,
    first: int,
    sigma: float,
    nearest: float,
    newest: float,
) -> None:
    """What each window misses of the motion, over that of the next narrower one.

    Where all of them are farther off than noise is, the nearest one is the measure: so no window is
    blamed for noise that has grown, nor let off because the others are as bad.
    """
    members, longest, memory = int(constants[0]), int(constants[1]), int(constants[3])
    expected = first + SHARED + 2 * memory + longest
    missed = expected + members
    least = sigma * sigma
    least = nearest if nearest > least else least
    scale = 1.0 / least if least > 0.0 else 0.0
    narrower = 0.0
    at = HEADER
    for m in range(members):
        e = newest - state[expected + m]
        z = e * e * constants[at + 1] * scale
        window, unit = constants[at], constants[at + 2]
        more = clipped(z - narrower, -MOST, MOST)
        state[missed + m] += (more * unit - state[missed + m]) / window
        narrower = z
        at += MEMBER + 4 * int(window)


@helper
def supervise(constants: Vector, state: MutableVector, first: int) -> None:
    """Move the place on the ladder, as the expert says.

    The narrowest window misses nothing; beyond the widest one all is missed.
    """
    members, longest, memory = int(constants[0]), int(constants[1]), int(constants[3])
    missed = first + SHARED + 2 * memory + longest + members
    nothing, everything = constants[WIDTH_RULES], constants[WIDTH_RULES + 2]
    place = state[first + PLACE]
    lower = int(place) if place < members - 1.0 else members - 2
    share = place - lower
    below = nothing if lower == 0 else clipped(state[missed + lower], nothing, everything)
    here = clipped(state[missed + lower + 1], nothing, everything)
    above = everything
    if lower + 2 < members:
        above = clipped(state[missed + lower + 2], nothing, everything)
    in_use, wider = below + share * (here - below), here + share * (above - here)
    # the output of one rule alone is 1/6, 1/2 or 5/6
    place += 3.0 * constants[4] * (infer(constants, WIDTH_RULES, in_use, wider) - 0.5)
    state[first + PLACE] = clipped(place, 0.0, members - 1.0)
