"""``auto``: the risk-based choice among a library of smoothers, each made robust by EM.

Beyond the thesis, in the place of its fuzzy supervisor (section 5.1.1). Signals differ in kind:
undecimated wavelets with neighbour shrinkage (haar, sym4, sym8), Whittaker smoothers of order 2 and
3, piecewise constant (Potts) and sums of sinusoids are all fitted, by the same EM that separates
impulses (:mod:`mixture`). With one mixture for all, the medians of theirs::

    score = -2 log likelihood + 3 df

and the estimate is their mean with the weights exp(-(score - min score) / 4).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fpt_ros.denoising.offline import (
    Info,
    Mask,
    Method,
    Signal,
    mixture,
    potts,
    sinusoids,
    undecimated,
    whittaker,
)
from fpt_ros.parameters import Values

PRICE = 3.0
"""Of a degree of freedom, in units of -2 log likelihood."""
SOFTNESS = 4.0

WAVELETS = ("haar", "sym4", "sym8")
ORDERS = (2, 3)


@dataclass(frozen=True)
class Candidate:
    """One smoother of the library, fitted."""

    name: str
    fit: mixture.Fit


def _wavelet(name: str) -> mixture.Core:
    extra = 1.5

    def core(z: Signal, sigma: float) -> tuple[Signal, float]:
        f, df = undecimated.shrink(z, sigma, name)
        return f, df + extra * undecimated.depth(len(z))

    return core


def _whittaker(order: int) -> mixture.Core:
    return lambda z, sigma: whittaker.smooth(z, sigma, order)


def library(y: Signal, present: Mask, begin: mixture.Start) -> list[Candidate]:
    """All smoothers fitted to ``y``."""
    found = []

    def add(name: str, core: mixture.Core, z: Signal | None = None) -> mixture.Fit:
        fit = mixture.fit(y, present, core, begin, z)
        found.append(Candidate(name, fit))
        return fit

    spline = add("whittaker2", _whittaker(2))
    add("whittaker3", _whittaker(3))
    for name in WAVELETS:
        add(name, _wavelet(name))
        add(name + "*", _wavelet(name), spline.z)
    add("potts", potts.smooth, potts.robust_start(y, begin.sigma))
    add("sinusoids", sinusoids.Tones().smooth)
    return found


def scores(y: Signal, present: Mask, candidates: list[Candidate]) -> Signal:
    """-2 log likelihood + 3 df of each, under one mixture."""
    median: Callable[[str], float] = lambda name: float(  # noqa: E731
        np.median([getattr(c.fit.noise, name) for c in candidates])
    )
    noise = mixture.Noise(median("p"), median("s"), median("t"))
    return np.array(
        [
            PRICE * c.fit.df - 2.0 * noise.log_likelihood((y - c.fit.estimate)[present])
            for c in candidates
        ]
    )


def supervise(y: Signal, present: Mask, values: Values) -> tuple[Signal, Info]:
    """The weighted mean of the library, and the weight of each member."""
    begin = mixture.start(y, present)
    if begin.sigma <= 1e-12 * float(np.ptp(y)):
        return begin.z, {"chosen": "none: no noise"}
    candidates = library(y, present, begin)
    score = scores(y, present, candidates)
    weight = np.exp(-(score - score.min()) / SOFTNESS)
    weight /= weight.sum()
    estimate = weight @ np.array([c.fit.estimate for c in candidates])
    shares = {
        c.name: round(float(w), 3) for c, w in zip(candidates, weight, strict=True) if w > 5e-4
    }
    return estimate, shares


def _estimate(y: Signal, present: Mask, values: Values) -> Signal:
    return supervise(y, present, values)[0]


AUTO = Method((), _estimate, detailed=supervise)
