"""Wavelet shrinkage of a sliding window, and a polynomial fitted to its newest samples.

The last 2^n samples are transformed (DWT, extended by reflection at both end points so that value
and slope go on), the details are shrunk by the soft universal threshold sigma sqrt(2 ln 2^n),
(5.1), and transformed back. A polynomial fitted to the last ``fit`` samples of the result gives the
motion at the newest one.

It is there for comparison: the newest sample of a window gains nothing by shrinkage (without the
fit its error is greater than that of the measurement), and with the fit it equals ``savgol`` of the
same window, at many times the cost. Wavelets are for whole records,
:mod:`fpt_ros.denoising.offline`.

Samples are ``dt`` of :func:`prepare` apart. Before the first one the motion is taken to be at rest.
A sample that is NaN is missing: the last estimate takes its place.
"""

import math
from dataclasses import replace

import pywt

from fpt_ros.denoising.offline.savgol import check
from fpt_ros.denoising.streaming import ORDER, Filter
from fpt_ros.denoising.streaming.savgol import SECONDS, end_kernels, odd_window
from fpt_ros.denoising.streaming.three_states import response_of
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter, Values, integer, number, word

LONGEST_WINDOW = 4096
WAVELETS = ("haar", "db2", "db3", "db4", "sym4", "sym5", "sym6", "sym8", "coif1", "coif2")

PARAMETERS = (
    Parameter("sigma", "standard deviation of the position noise", 1e-3, above=0.0),
    Parameter("wavelet", "orthogonal wavelet", "sym4", choices=WAVELETS),
    Parameter(
        "window",
        "samples of the window, a power of 2",
        256,
        minimum=16,
        maximum=LONGEST_WINDOW,
        live=False,
    ),
    Parameter("level", "levels of the transform", 3, minimum=1, maximum=8, live=False),
    Parameter(
        "fit", "newest samples that the polynomial is fitted to, odd", 141, minimum=3, live=False
    ),
    Parameter("degree", "degree of the polynomial", 3, minimum=1, maximum=9),
    replace(
        SECONDS, text="length of the fit in time, at any rate; 0: `window` and `fit` are samples"
    ),
)

_HEADER = 6


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: window, levels, taps, fit, threshold, order of the response; low-pass; kernels.

    The low-pass is that of the synthesis; orthogonality gives the other three filters.
    """
    window, level, fit = integer(values, "window"), integer(values, "level"), integer(values, "fit")
    degree, order = integer(values, "degree"), integer(values, ORDER.name)
    seconds = number(values, SECONDS.name)
    if seconds > 0.0:  # of the fit; the window is at least as long
        fit = odd_window(seconds, dt)
        window = max(16, 2 ** math.ceil(math.log2(fit)))
        if window > LONGEST_WINDOW:
            raise BadInput(
                f"seconds = {seconds:g} has a window of {window} samples at {1 / dt:g} Hz: at most "
                f"{LONGEST_WINDOW}"
            )
    low = pywt.Wavelet(word(values, "wavelet")).rec_lo
    if window & (window - 1):
        raise BadInput(f"window = {window} is not valid: it takes a power of 2")
    check(fit, degree, least_degree=max(1, order))
    if fit > window:
        raise BadInput(f"fit = {fit} is not valid for a window of {window} samples: it is longer")
    shortest = window
    for _ in range(level):
        if shortest < len(low):
            raise BadInput(
                f"level = {level} is not valid: a window of {window} samples has fewer levels with "
                f"{len(low)} taps"
            )
        shortest = (shortest + len(low) - 1) // 2
    threshold = number(values, "sigma") * math.sqrt(2.0 * math.log(window))
    header = (float(window), float(level), float(len(low)), float(fit), threshold, float(order))
    return (*header, *map(float, low), *end_kernels(fit, degree, dt))


def state_size(constants: Vector, n: int) -> int:
    """Place of the oldest sample, rings, room for one extended signal and for all bands."""
    window, level, taps = int(constants[0]), int(constants[1]), int(constants[2])
    return 1 + n * (1 + window) + 2 * (window + 2 * taps) + (window + level * taps)


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    window = int(constants[0])
    state[0] = 0.0
    for c in range(len(q)):
        for i in range(1 + window):
            state[1 + c * (1 + window) + i] = q[c]


@helper
def analyse(
    state: MutableVector, source: int, length: int, low: int, high: int, filters: Vector, taps: int
) -> int:
    """One level of the DWT of ``state[source : source + length]``.

    ``filters`` begin at ``_HEADER`` with the low-pass of the synthesis. Approximation and details
    are written from ``low`` and ``high`` on; taps - 1 places before and behind the signal are used.
    Returns the length of both.
    """
    last = source + length - 1
    for i in range(1, taps):
        state[source - i] = 2.0 * state[source] - state[source + i]
        state[last + i] = 2.0 * state[last] - state[last - i]
    count = (length + taps - 1) // 2
    for o in range(count):
        begin = source + 2 * o + 2 - taps
        smooth = detail = 0.0
        sign = 1.0
        for j in range(taps):
            smooth += filters[_HEADER + j] * state[begin + j]
            detail += sign * filters[_HEADER + taps - 1 - j] * state[begin + j]
            sign = -sign
        state[low + o] = smooth
        state[high + o] = detail
    return count


@helper
def shrink(state: MutableVector, begin: int, count: int, threshold: float) -> None:
    """Soft threshold: sign(x) max(|x| - threshold, 0)."""
    for i in range(begin, begin + count):
        x = state[i]
        if x > threshold:
            state[i] = x - threshold
        elif x < -threshold:
            state[i] = x + threshold
        elif x == x:
            state[i] = 0.0


@helper
def synthesise(
    state: MutableVector, low: int, high: int, target: int, length: int, filters: Vector, taps: int
) -> None:
    """The ``length`` samples from ``target`` on that have these approximation and details."""
    for i in range(length):
        value = 0.0
        o = i // 2
        j = i + taps - 2 - 2 * o
        while j >= 0:
            value += filters[_HEADER + j] * state[low + o]
            mirrored = filters[_HEADER + taps - 1 - j] * state[high + o]
            value += mirrored if j % 2 == 0 else -mirrored
            o += 1
            j -= 2
        state[target + i] = value


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
    """Transform, shrink, transform back, fit."""
    window, level, taps = int(constants[0]), int(constants[1]), int(constants[2])
    fit, threshold, order = int(constants[3]), constants[4], constants[5]
    head = int(state[0])
    room = window + 2 * taps
    spare = 1 + len(q) * (1 + window) + taps
    bands = spare + 2 * room - taps
    for c in range(len(q)):
        ring = 2 + c * (1 + window)
        newest = q[c]
        if newest != newest:
            newest = state[ring - 1]
        state[ring + head] = newest
        k = spare
        for i in range(ring + head + 1, ring + window):
            state[k] = state[i] - newest
            k += 1
        for i in range(ring, ring + head + 1):
            state[k] = state[i] - newest
            k += 1
        source, target, high, length = spare, spare + room, bands, window
        for _ in range(level):
            count = analyse(state, source, length, target, high, constants, taps)
            shrink(state, high, count, threshold)
            source, target = target, source
            high += count
            length = count
        for j in range(level - 1, -1, -1):
            high -= length
            length = window
            for _ in range(j):
                length = (length + taps - 1) // 2
            synthesise(state, source, high, target, length, constants, taps)
            source, target = target, source
        position = velocity = acceleration = 0.0
        k = _HEADER + taps
        for i in range(source + window - fit, source + window):
            position += constants[k] * state[i]
            velocity += constants[k + fit] * state[i]
            acceleration += constants[k + 2 * fit] * state[i]
            k += 1
        state[ring - 1] = out_q[c] = newest + position
        out_v[c] = velocity
        out_response[c] = response_of(order, out_q[c], velocity, acceleration)
    state[0] = float(head + 1 if head + 1 < window else 0)


WAVELET = Filter(prepare, state_size, start, update, PARAMETERS)
