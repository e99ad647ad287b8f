"""Coloured noise: AR(1) beside the white one, told from a signal by evidence, or its probability.

Where a process with such noise beside is better than one with white noise alone, by BIC and within
the bounds below, the noise is coloured.

Where white noise alone leaves no white noise at all, as of a walk, the record is a signal with no
noise, or a slower signal in noise that is all colour. BIC is no judge of that: it has a component's
amplitude and scale cost ln n each, as if n samples told them, where those of a slow signal are told
by its few degrees of freedom (Pauler, Biometrika 85, 1998). With their cost ln df instead, kernels
being equally probable before::

    odds = sum over slow kernels of exp(-(BIC - BIC_white - k ln(n / df)) / 2)

and the estimate is the mean of both readings, weighted by their probabilities: of least expected
squared error. Jumps are no such noise: its innovations are normal.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from fpt_ros.denoising.offline import Signal
from fpt_ros.denoising.offline.gaussian_process import Process, Samples, fit
from fpt_ros.denoising.offline.kalman import UNKNOWN

CLEAR = 0.0
"""BIC by which coloured noise has to be better than white noise."""
IDLE, EVEN = 0.3, 6.0
"""Where white noise leaves so many degrees of freedom per sample to the signal, the record hardly
changes; then coloured noise is taken if it is as good to within this BIC."""
STRONG = 1.4
"""In units of the white noise beside it: weaker coloured noise has to be better than white."""
SLOW, ALONE = 0.75, 0.2
"""A coefficient above the one, and white noise beside above the other share of it, is a signal that
wanders, or jumps, in white noise."""
LOUDEST = 0.15
"""Share of the variance that coloured noise may have: more is a signal, as far as can be told."""
UNTOLD = 0.75
"""Degrees of freedom per sample from which on white noise leaves no white noise."""
POSSIBLE, LIKELY = 0.3, 0.2
"""Share of the variance that coloured noise of some probability may have (above ``LOUDEST`` it is
not more probable than the signal), and the probability below which there is none."""
NORMAL = 1.0
"""Excess kurtosis of innovations at most: of 512 normal ones it is 0 +- 0.2, of jumps above 3."""
SLOWER = "rough"
"""A slow kernel beside the two that are tried anyway."""
MOST_EXPONENT = 50.0


@dataclass(frozen=True)
class Colour:
    """AR(1) noise beside the white one.

    Attributes:
        coefficient: of one sample on the one before.
        sigma: standard deviation, unit of y.
        white: standard deviation of the white noise beside it, unit of y.
        trust: probability that it is noise, and no part of the signal.
    """

    coefficient: float
    sigma: float
    white: float
    trust: float = 1.0

    @property
    def low(self) -> float:
        """Standard deviation of the white noise that is as strong at low frequencies."""
        c = self.coefficient
        return math.hypot(self.white, self.sigma * math.sqrt((1.0 + c) / (1.0 - c)))


def colour_of(process: Process) -> Colour | None:
    """The colour of the noise of ``process``."""
    if not process.coloured:
        return None
    sigma = float(process.parts[-1, 1] * process.s)
    return Colour(_coefficient(process), sigma, process.s, process.trust)


def all_noise(process: Process) -> float:
    """Standard deviation of all noise of ``process``."""
    return process.s * (math.hypot(1.0, process.parts[-1, 1]) if process.coloured else 1.0)


def believed(samples: Samples, white: Process) -> list[Process]:
    """The processes with coloured noise that are believed, best first; empty: it is white.

    Args:
        samples: what they are fitted to.
        white: the best process with white noise alone.
    """
    kernels = [white.kernel, *(k for k in ("smooth", "smooth+tone") if k != white.kernel)][:2]
    tried = [fit(samples, kernel, True) for kernel in kernels]
    found = min(tried, key=lambda p: p.bic)
    _, df, _ = white.smooth(samples)
    sigma = float(found.parts[-1, 1])
    if _coefficient(found) > SLOW and ALONE * sigma < 1.0 < sigma:
        return []
    clear = -EVEN if df > IDLE * samples.count else CLEAR
    better = found.bic <= white.bic - CLEAR
    strong = better or sigma >= STRONG
    if found.bic <= white.bic - clear and strong and _share(samples, found) < LOUDEST:
        return [found]
    if not better and df < UNTOLD * samples.count:
        return []
    if SLOWER not in kernels:
        tried.append(fit(samples, SLOWER, True))
    return _probable(samples, white, tried)


def _probable(samples: Samples, white: Process, tried: list[Process]) -> list[Process]:
    """Those of ``tried`` that can be, with the probability that any of them is."""
    found, quiet, loud = [], 0.0, 0.0
    for process in tried:
        f, df, _ = process.smooth(samples)
        share = _share(samples, process)
        slow = df < IDLE * samples.count
        if not slow or share > POSSIBLE or process.parts[-1, 1] < STRONG:
            continue
        if _kurtosis(samples, process, f) > NORMAL:
            continue
        told = (len(process.x) - 2) * math.log(samples.count / max(df, 1.0))  # 2: of the noise
        odds = math.exp(min(-0.5 * (process.bic - white.bic - told), MOST_EXPONENT))
        if share < LOUDEST:
            quiet += odds
        else:
            loud += odds
        found.append(process)
    odds = quiet + min(loud, 1.0)
    trust = odds / (1.0 + odds)
    if trust < LIKELY:
        return []
    return sorted((replace(one, trust=trust) for one in found), key=lambda one: one.bic)


def _coefficient(process: Process) -> float:
    """Of the AR(1) noise."""
    return math.exp(-1.0 / process.parts[-1, 2])


def _share(samples: Samples, process: Process) -> float:
    """Share of the variance that is noise."""
    known = samples.relative < UNKNOWN
    return all_noise(process) ** 2 / float(np.var(samples.y[known]))


def _kurtosis(samples: Samples, process: Process, f: Signal) -> float:
    """Excess kurtosis of the innovations of the noise beside the signal ``f``."""
    noise = samples.y - f
    known = samples.relative < UNKNOWN
    new = (noise[1:] - _coefficient(process) * noise[:-1])[known[1:] & known[:-1]]
    new = new - new.mean()
    return float(np.mean(new**4) / np.mean(new**2) ** 2) - 3.0
