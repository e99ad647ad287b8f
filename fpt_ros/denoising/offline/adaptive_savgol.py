"""Adaptive multi-round smoothing (thesis section 6.2): window by the distance of extrema.

1. A first Savitzky-Golay pass shows the extrema; d_i are the lengths of the sections between them.
2. Runs of sections whose lengths stay within a factor 2 of their running mean are the parts R, with
   the mean length d_R and R_n samples.
3. The relation g of the greatest length to d_R (6.10) chooses degree k and window M of a part
   (6.11).
4. Each part is smoothed with its own, and cross-faded into its neighbours over a quarter of the
   shorter of window and part.
5. In every further round the joined lines through the extrema (6.12) are subtracted from the
   result, the rest is smoothed as in 2 to 4, and the lines are added again.
6. Optionally samples around the extrema become means with Dombi's weights (6.16).

Rules:

``literal``
    (6.10) as printed, 1/(1 + exp(-(d_max - d_R))): a difference of samples, never negative. g is
    over 0.9 as soon as it is over 2.2 samples, so nearly everything gets k = 5, M = 0.3 d_R.
``corrected``
    1/(1 + exp(-2 (d_max/d_R - 2))): a ratio. Windows are capped at a multiple of d_R, since
    0.8 R_n samples with a straight line would erase the part's own oscillation. The first pass is
    the filter of least Stein risk, and an extremum has to stand out by 2.5 sigma sqrt(c_0).
``scale``
    k = 3 and M = 1.8 d_R^(8/9) (sigma/A)^(2/9), A the half height between the part's extrema: what
    balances the cubic's bias and the noise, within a constant.

All take the rules of (6.11) without its gaps (0.89 to 0.9, 0.44 to 0.45, g = 1), and make M odd and
at least k + 2: with M = k + 1 the polynomial interpolates.

Measured, no reading of (6.11) beats the best fixed filter on all signals; ``savgol_bank`` does. And
the method is not independent of the kind of noise: it has no rejection of impulses.
"""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.signal import find_peaks

from fpt_ros.denoising.offline import Mask, Method, Signal
from fpt_ros.denoising.offline.joined_lines import joined_lines
from fpt_ros.denoising.offline.noise import third_difference_sigma
from fpt_ros.denoising.offline.savgol import DEGREE, WINDOW, check, gain, own_weights, smooth
from fpt_ros.denoising.offline.savgol_bank import members
from fpt_ros.denoising.offline.weighting import average_around
from fpt_ros.parameters import Parameter, Values, integer, number, word

PARAMETERS = (
    Parameter(
        "rules",
        "literal: as printed; corrected: relation by ratio, windows capped; scale: by amplitude",
        "corrected",
        choices=("literal", "corrected", "scale"),
    ),
    Parameter("rounds", "rounds of smoothing", 2, minimum=1, maximum=10),
    Parameter("radius", "samples around an extremum that are averaged; 0: none", 0, minimum=0),
    Parameter("exponent", "lambda of the Dombi weights", 2.0, above=0.0),
    WINDOW,
    DEGREE,
)
"""``window`` and ``degree`` are those of the first pass of the literal rules."""

CAPS = {1: 0.5, 2: 1.05, 3: 1.6, 4: 2.05, 5: 2.5}
"""Greatest window over the mean length of sections, by degree."""

PROMINENCE = 2.5
RUN = 2.0
"""Ratio to the running mean at which a new part begins."""


@dataclass(frozen=True)
class Part:
    """Samples ``begin`` <= i < ``end``, smoothed with one degree and window."""

    begin: int
    end: int
    degree: int
    window: int


def extrema(y: Signal, prominence: float = 0.0) -> NDArray[np.int64]:
    """Sample numbers of the local extrema that stand out by ``prominence``, ascending."""
    least = prominence if prominence > 0.0 else None
    maxima, _ = find_peaks(y, prominence=least)
    minima, _ = find_peaks(-y, prominence=least)
    return np.sort(np.concatenate((maxima, minima)))


def runs(lengths: NDArray[np.int64]) -> list[tuple[int, int]]:
    """Sections [first, last) of the parts: lengths within a factor ``RUN`` of the running mean."""
    found, first, total = [], 0, 0.0
    for i, length in enumerate(lengths):
        mean = total / (i - first) if i > first else float(length)
        if not mean / RUN <= length <= mean * RUN:
            found.append((first, i))
            first, total = i, 0.0
        total += float(length)
    found.append((first, len(lengths)))
    return found


def relation(longest: float, mean: float, literal: bool = False) -> float:
    """How far ``longest`` exceeds ``mean`` (6.10), in [0, 1]."""
    exponent = longest - mean if literal else 2.0 * (longest / mean - 2.0)
    return 1.0 / (1.0 + math.exp(-exponent))


def rule(g: float, mean: float, samples: int) -> tuple[int, float]:
    """Degree and window (not rounded) of a part, (6.11), from g, d_R and R_n."""
    if g > 0.9:
        return 5, 0.3 * mean
    if g > 0.75:
        return 4, 0.5 * mean
    if g > 0.45:
        return 3, mean
    if g > 0.2:
        return 2, 0.5 * samples
    return 1, 0.8 * samples


def admissible(window: float, degree: int, n: int) -> int:
    """The odd window next to ``window``, at least degree + 2 and at most n samples."""
    least = degree + 2 + (degree + 1) % 2
    nearest = math.floor(window + 0.5)
    return min(max(nearest + (nearest + 1) % 2, least), n - (n + 1) % 2)


def least_risk(y: Signal, sigma: float) -> tuple[int, int]:
    """(degree, window) of the filter with the least Stein risk over the whole signal."""

    def risk(degree: int, window: int) -> float:
        half, own = window // 2, own_weights(window, degree)
        trace = float(np.sum(own)) + (len(y) - window) * float(own[half])
        rest = y - smooth(y, window, degree)
        return float(np.sum(rest**2)) + 2.0 * sigma**2 * trace

    return min(members(len(y)), key=lambda member: risk(*member))


def divide(y: Signal, at: NDArray[np.int64], rules: str, sigma: float) -> list[Part]:
    """The parts of ``y`` between the extrema ``at``, with degree and window by ``rules``."""
    n = len(y)
    borders = np.unique(np.concatenate(([0], at, [n])))
    lengths = np.diff(borders)
    values = y[np.minimum(borders, n - 1)]
    parts = []
    for first, last in runs(lengths):
        begin, end = int(borders[first]), int(borders[last])
        mean = float(np.mean(lengths[first:last]))
        if rules == "scale":
            half_height = 0.5 * float(np.mean(np.abs(np.diff(values[first : last + 1]))))
            ratio = min(sigma / half_height, 1.0) if half_height > 0.0 else 1.0
            degree, window = 3, 1.8 * mean ** (8 / 9) * ratio ** (2 / 9)
        else:
            g = relation(float(lengths.max()), mean, literal=rules == "literal")
            degree, window = rule(g, mean, end - begin)
            if rules == "corrected":
                window = min(window, CAPS[degree] * mean)
        parts.append(Part(begin, end, degree, admissible(window, degree, n)))
    return parts


def smooth_parts(y: Signal, parts: list[Part]) -> Signal:
    """Every part smoothed with its own degree and window, cross-faded at the borders."""
    n = len(y)
    smoothed = {key: smooth(y, *key) for key in {(part.window, part.degree) for part in parts}}
    out = smoothed[parts[0].window, parts[0].degree].copy()
    samples = np.arange(n)
    for before, part in pairwise(parts):
        fade = min(min(p.window, p.end - p.begin) for p in (before, part)) / 4.0
        share = np.clip(0.5 + (samples + 0.5 - part.begin) / max(fade, 1e-9), 0.0, 1.0)
        out += share * (smoothed[part.window, part.degree] - out)
    return out


def adaptive(
    y: Signal, rules: str = "corrected", rounds: int = 2, window: int = 35, degree: int = 3
) -> tuple[Signal, NDArray[np.int64]]:
    """The smoothed signal, shape (n,), and the sample numbers of the extrema it was divided at."""
    sigma = third_difference_sigma(y)
    if rules != "literal":
        degree, window = least_risk(y, sigma)
    prominence = 0.0 if rules == "literal" else PROMINENCE * sigma * gain(window, degree) ** 0.5
    result = smooth(y, window, degree)
    at = extrema(result, prominence)
    result = smooth_parts(y, divide(result, at, rules, sigma))
    for _ in range(rounds - 1):
        at = extrema(result, prominence)
        lines = joined_lines(result, at)
        result = lines + smooth_parts(result - lines, divide(result, at, rules, sigma))
    return result, at


def _estimate(y: Signal, present: Mask, values: Values) -> Signal:
    result, at = adaptive(
        y,
        word(values, "rules"),
        integer(values, "rounds"),
        integer(values, "window"),
        integer(values, "degree"),
    )
    radius = integer(values, "radius")
    if radius:
        return average_around(result, at, radius, number(values, "exponent"))
    return result


def _shortest(values: Values) -> int:
    window = integer(values, "window")
    check(window, integer(values, "degree"))
    return window if word(values, "rules") == "literal" else 7


ADAPTIVE_SAVGOL = Method(PARAMETERS, _estimate, _shortest)
