"""A Gaussian process whose kernel, noise and hyperparameters are those of most evidence, in O(n).

The kernels are sums of a few :mod:`components`; the noise is white with a given profile,
and may have an AR(1) component beside. Hyperparameters maximise the marginal likelihood, in which
the scale s of everything is known in closed form::

    -2 ln L = N ln s^2 + sum ln S + sum e^2 / S / s^2,    s^2 = sum e^2 / S / N

with the innovations e and their variances S in units of s^2. Kernels are compared by
BIC = -2 ln L + (hyperparameters) ln N.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
import scipy.fft

from fpt_ros.denoising.offline import Signal
from fpt_ros.denoising.offline.components import DECAY, MATERN3, MATERN5, OSCILLATOR, STATES
from fpt_ros.denoising.offline.evidence import descend, parts_of
from fpt_ros.denoising.offline.kalman import UNKNOWN, likelihood, smooth

KERNELS: dict[str, tuple[float, ...]] = {
    "walk": (DECAY,),
    "rough": (MATERN3,),
    "smooth": (MATERN5,),
    "tone": (OSCILLATOR,),
    "smooth+tone": (MATERN5, OSCILLATOR),
}
"""Kinds of the components of each kernel."""

STEPS, CLOSE = 25, 0.02
"""Steps of the search at most; it ends when one gains less than this."""
MOST_COLOUR = 0.96
"""Of the AR(1) coefficient of noise: what remembers longer is a signal."""
LEAST_COLOUR = 0.2


@dataclass(frozen=True)
class Samples:
    """What a process is fitted to.

    Attributes:
        y: samples of mean about 0, shape (n,).
        relative: variance of the white noise at each, in units of s^2; ``UNKNOWN``: missing.
        dt: steps of time before each sample [mean step], shape (n,).
        least: least s, unit of y.
    """

    y: Signal
    relative: Signal
    dt: Signal
    least: float

    @property
    def count(self) -> int:
        """Samples that are not missing."""
        return int(np.count_nonzero(self.relative < UNKNOWN))


@dataclass(frozen=True)
class Process:
    """A process with its hyperparameters.

    Attributes:
        kernel: a name of ``KERNELS``.
        parts: components in units of s, shape (k, 4); the last is noise if ``coloured``.
        s: standard deviation of the white noise where the profile is 1, unit of y.
        bic: -2 ln L + (hyperparameters) ln N.
        coloured: whether the noise has an AR(1) component.
        x: logarithms of the hyperparameters, to begin from.
        trust: probability that the AR(1) component is noise, and no part of the signal.
    """

    kernel: str
    parts: Signal
    s: float
    bic: float
    coloured: bool
    x: Signal
    trust: float = 1.0

    @property
    def signal(self) -> Signal:
        """1 at the components that are the signal."""
        own = np.ones(len(self.parts))
        if self.coloured:
            own[-1] = 0.0
        return own

    def smooth(self, samples: Samples, derivative: int = 0) -> tuple[Signal, float, Signal]:
        """Posterior mean, its degrees of freedom, and its standard deviation.

        With ``derivative`` the mean is that of the first or second derivative [y / mean step^k];
        only components that have one count: all of ``smooth``.
        """
        mean, spread, leverage = smooth(
            samples.y, samples.relative, samples.dt, self.parts, self.signal
        )
        f = mean[:, self._places(derivative)].sum(axis=1)
        return f, float(leverage.sum()), self.s * np.sqrt(spread)

    def whole(self, samples: Samples) -> Signal:
        """Posterior mean of all components, that of the noise too, shape (n,)."""
        every = np.ones(len(self.parts))
        mean, _, _ = smooth(samples.y, samples.relative, samples.dt, self.parts, every)
        return np.asarray(mean[:, replace(self, coloured=False)._places(0)].sum(axis=1))

    def _places(self, derivative: int) -> list[int]:
        """Index of the state of each component of the signal that is such a derivative."""
        places, k = [], 0
        for part, own in zip(self.parts, self.signal, strict=True):
            states = STATES[float(part[0])]
            if own and derivative < states:
                places.append(k + derivative)
            k += states
        return places


def peak(y: Signal) -> float:
    """Period [samples] of the largest peak of the spectrum."""
    n = len(y)
    power = np.abs(scipy.fft.rfft((y - y.mean()) * np.hanning(n)))
    return n / max(1, int(np.argmax(power[1:])) + 1)


def refit(samples: Samples, process: Process) -> Process:
    """``process`` with hyperparameters sought from where they were."""
    found = fit(samples, process.kernel, process.coloured, process)
    return replace(found, trust=process.trust)


def scaled(samples: Samples, process: Process) -> Process:
    """``process`` with the s of these samples, all else as it was."""
    square, logs = likelihood(samples.y, samples.relative, samples.dt, process.parts)
    s = math.sqrt(max(square / samples.count, samples.least**2, 1e-300))
    cost = samples.count * math.log(s * s) + logs + square / s**2
    return replace(process, s=s, bic=cost + (len(process.x) + 1) * math.log(samples.count))


def fit(
    samples: Samples, kernel: str, coloured: bool = False, begin: Process | None = None
) -> Process:
    """The process of most evidence among those of ``kernel``."""
    n, count = len(samples.y), samples.count
    known = samples.relative < UNKNOWN
    kinds = KERNELS[kernel]
    size = float(np.std(samples.y[known]))
    ratio = math.log(max(size / max(samples.least, 1e-3 * size, 1e-300), 0.3))
    ratio = min(ratio, math.log(100.0))
    period = peak(samples.y)
    x: list[float] = []
    bounds: list[tuple[float, float]] = []
    for kind in kinds:
        if kind == OSCILLATOR:
            at = period if len(kinds) == 1 else min(period, n / 30.0)
            x += [ratio, math.log(at), 1.0]
            bounds += [(-7.0, 16.0), (math.log(2.0), math.log(4.0 * n)), (-4.0, 7.0)]
        else:
            x += [ratio, math.log(n / (5.0 if len(kinds) > 1 else 15.0))]
            bounds += [(-7.0, 16.0), (math.log(0.5), math.log(20.0 * n))]
    if coloured:
        memory = [-1.0 / math.log(c) for c in (LEAST_COLOUR, MOST_COLOUR)]
        x += [math.log(2.0), math.log(3.0)]
        bounds += [(-3.0, 6.0), (math.log(memory[0]), math.log(memory[1]))]
    if begin is not None and begin.kernel == kernel:
        x[: len(begin.x)] = list(begin.x)

    low, high = np.transpose(bounds)
    every = np.array((*kinds, DECAY) if coloured else kinds)
    best, value = descend(
        samples.y, samples.relative, samples.dt, every, np.array(x), low, high,
        count, samples.least, STEPS, CLOSE,
    )  # fmt: skip
    parts = parts_of(every, best)
    square, _ = likelihood(samples.y, samples.relative, samples.dt, parts)
    s = math.sqrt(max(square / count, samples.least**2))
    bic = float(value) + (len(best) + 1) * math.log(count)
    return Process(kernel, parts, s, bic, coloured, best)
