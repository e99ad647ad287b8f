"""The fuzzy supervisor on line (thesis sections 5.1.1, 5.2): it chooses the window of the fit.

A polynomial is fitted to the newest samples, as by ``savgol``; how many these are, "the parameters
of the fitting", two Mamdani experts decide at every sample (:mod:`~fpt_ros.denoising.experts`). The
windows are a ladder, and the place on it is a number: between two windows their fits are mixed.

**Noise.** sigma = median |d| / (0.6745 sqrt 20) of the third differences d of the last samples,
which do not see parabolas, nor impulses below one sample in ten.

**Motion.** A window of M samples misses a sample that it has not seen by e. In noise alone e^2 has
the mean S = sigma^2 (1 + |p|^2), p being its weights for one sample ahead. The mean of e^2 / S over
the last M samples, less that of the next narrower window, is what it misses of the motion. It is
counted in standard deviations of what noise alone makes of it. The first expert moves the place by
what the window in use misses, and by what the next wider one would.

**Impulses.** The distance of a sample is that from the nearest prediction of all windows. If the
second expert doubts it, the prediction takes its place; after two or three alike in a row the
motion has jumped, and all is believed until a prediction is within two standard deviations again.

The other two experts, of wavelet and threshold, have nothing to choose here: the newest sample
gains nothing by shrinkage (:mod:`~fpt_ros.denoising.streaming.wavelet`).

Samples are ``dt`` of :func:`prepare` apart. Before the first one the motion is taken to be at rest;
the window stays the narrowest until there are enough samples to know the noise by. A sample that is
not finite is missing: the prediction takes its place, and nothing is learnt from it.
"""

import math

from fpt_ros.denoising.experts import DOUBT, WIDTH
from fpt_ros.denoising.offline.savgol import check, kernel
from fpt_ros.denoising.streaming import ORDER, Filter
from fpt_ros.denoising.streaming.fits import fit, kernels
from fpt_ros.denoising.streaming.savgol import odd_window
from fpt_ros.denoising.streaming.supervisor import (
    HEADER,
    MEMBER,
    PLACE,
    SHARED,
    believed,
    judge,
    nearest_of,
    noise_of,
    supervise,
)
from fpt_ros.denoising.streaming.three_states import response_of
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number, numbers

PARAMETERS = (
    Parameter(
        "windows",
        "samples of the narrowest and of the widest window, odd",
        [11.0, 361.0],
        minimum=3.0,
        maximum=10_001.0,
        live=False,
    ),
    Parameter(
        "seconds",
        "length of both in time, at any rate; empty: they have `windows` samples",
        [],
        kind="floats",
        unit="s",
        above=0.0,
        live=False,
    ),
    Parameter("members", "windows of the ladder", 8, minimum=2, maximum=40, live=False),
    Parameter("degree", "degree of the polynomial", 3, minimum=1, maximum=9),
    Parameter(
        "noise_window",
        "newest samples that the noise is found from, odd",
        63,
        minimum=9,
        maximum=4095,
        live=False,
    ),
    Parameter(
        "pace",
        "windows that the supervisor goes on the ladder in a sample at most",
        0.25,
        above=0.0,
        maximum=1.0,
    ),
)


def ladder(narrowest: float, widest: float, members: int) -> list[int]:
    """Odd windows in nearly equal ratios, from the one to the other; where they coincide, fewer."""
    ratio = (widest / narrowest) ** (1.0 / (members - 1))
    return sorted({2 * round(0.5 * (narrowest * ratio**i - 1.0)) + 1 for i in range(members)})


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: what all windows share, both rule bases, then (M, 1 / (1 + |p|^2), unit, kernels).

    Shared: windows, the longest, order of the response, samples of the noise, pace. ``unit`` takes
    what is missed to standard deviations. Kernels, newest sample first: value, first and second
    derivative at the newest sample, value one sample later.
    """
    ends, memory = numbers(values, "windows"), integer(values, "noise_window")
    degree, order = integer(values, "degree"), integer(values, ORDER.name)
    if numbers(values, "seconds"):
        ends = [float(odd_window(length, dt)) for length in numbers(values, "seconds")]
    if len(ends) != 2 or not ends[0] < ends[1]:
        raise BadInput(
            f"windows = {ends} are not valid: they are the narrowest and the widest, in this order"
        )
    if memory % 2 == 0:
        raise BadInput(f"noise_window = {memory} is not valid: it takes an odd number of samples")
    if ends != [int(end) for end in ends]:
        raise BadInput(f"windows are whole numbers of samples, not {ends}")
    for end in ends:
        check(int(end), degree, least_degree=max(1, order))
    windows = ladder(ends[0], ends[1], integer(values, "members"))
    shared = (len(windows), windows[-1], order, memory)
    constants = [*map(float, shared), number(values, "pace"), *WIDTH.constants()]
    constants += DOUBT.constants()
    narrower = kernel(windows[0], degree, 0, float(windows[0]))[::-1]
    for window in windows:
        ahead = kernel(window, degree, 0, float(window))[::-1]
        variance = 1.0 + float(ahead @ ahead)
        # correlation of the two innovations; the variance of z - z' is 4 (1 - rho^2)
        rho = 1.0 + float(ahead[: len(narrower)] @ narrower)
        rho /= math.sqrt(variance * (1.0 + float(narrower @ narrower)))
        rest = 1.0 - rho * rho
        unit = math.sqrt(0.5 * window / rest) if len(ahead) > len(narrower) else 0.0
        constants += [float(window), 1.0 / variance, unit]
        constants += kernels(window, degree, dt)
        narrower = ahead
    return tuple(constants)


def _size(constants: Vector) -> int:
    members, longest, memory = int(constants[0]), int(constants[1]), int(constants[3])
    return SHARED + 2 * memory + longest + 2 * members


def state_size(constants: Vector, n: int) -> int:
    """Place of the newest sample; of each coordinate what the supervisor shares, and vectors.

    These are the sizes of the third differences in the order of time and of size, the samples, and
    of each window the next sample that it expects and what it misses.
    """
    return 1 + n * _size(constants)


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    size = _size(constants)
    members, longest = int(constants[0]), int(constants[1])
    state[0] = 0.0
    for c in range(len(q)):
        last = 1 + (c + 1) * size
        for i in range(last - size, last):
            state[i] = 0.0
        for i in range(last - longest - 2 * members, last - members):
            state[i] = q[c]
        for i in range(3):
            state[last - size + SHARED - 3 + i] = q[c]


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
    """Doubt the sample or not, weigh the windows, choose among them, fit."""
    members, longest, memory = int(constants[0]), int(constants[1]), int(constants[3])
    size = SHARED + 2 * memory + longest + 2 * members
    head = int(state[0]) + 1
    if head == longest:
        head = 0
    state[0] = float(head)
    for c in range(len(q)):
        first = 1 + c * size
        ring = first + SHARED + 2 * memory
        expected = ring + longest
        sigma = noise_of(state, first, memory, q[c])
        nearest = nearest_of(constants, state, first, q[c])
        newest = believed(constants, state, first, sigma, nearest, q[c])
        if newest == q[c] and sigma == sigma:
            judge(constants, state, first, sigma, nearest, newest)
            supervise(constants, state, first)
        state[ring + head] = newest
        place = state[first + PLACE]
        position = velocity = acceleration = 0.0
        at = HEADER
        for m in range(members):
            window = int(constants[at])
            value, rate, curvature, ahead = fit(
                constants, at + MEMBER, window, state, ring, longest, head
            )
            share = 1.0 - abs(place - m)
            if share > 0.0:
                position += share * value
                velocity += share * rate
                acceleration += share * curvature
            state[expected + m] = newest + ahead
            at += MEMBER + 4 * window
        out_q[c] = newest + position
        out_v[c] = velocity
        out_response[c] = response_of(constants[2], out_q[c], velocity, acceleration)


FUZZY = Filter(prepare, state_size, start, update, PARAMETERS)
