"""The Gaussian processes as a member of ``auto``: robust, and judged by their evidence.

Kernels are fitted where no impulse is; then EM separates impulses as for the others
(:mod:`mixture`), an impulse with the probability 1 - w having the variance sigma^2 / w. The means
of all kernels are averaged with the weights exp(-BIC / 2).
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from fpt_ros.denoising.offline import Mask, Signal, mixture
from fpt_ros.denoising.offline.gaussian_process import KERNELS, Process, Samples, fit, refit, scaled
from fpt_ros.denoising.offline.kalman import UNKNOWN

ROUNDS = 3
NEAR = 12.0
"""Kernels within this BIC of the best are kept."""
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
TOLD = 0.75
"""Where white noise leaves so many degrees of freedom per sample to the signal, all noise is colour
or there is none: the likelihood does not tell which."""
NORMAL = 1.0
"""Excess kurtosis of the innovations of noise at most: that of jumps is far more."""
POSSIBLE = 0.3
"""Share of the variance that coloured noise may have that is taken with less than full weight."""
LIKELY = 0.2
"""Probability below which the record stays as it is."""
LOUDEST = 0.15
"""Share of the variance that coloured noise may have: more is a signal, as far as can be told."""


@dataclass(frozen=True)
class Colour:
    """AR(1) noise beside the white one.

    Attributes:
        coefficient: of one sample on the one before.
        sigma: standard deviation, unit of y.
        white: standard deviation of the white noise beside it, unit of y.
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


@dataclass(frozen=True)
class Smoothed:
    """What the processes found.

    Attributes:
        fit: estimate, degrees of freedom, mixture.
        kernel: that of most evidence.
        colour: of the noise; None: white.
        processes: those that were averaged, with their weights.
        samples: what they were fitted to.
        whole: estimate if the colour is a part of the signal, shape (n,); None: it is not.
    """

    fit: mixture.Fit
    kernel: str
    colour: Colour | None
    processes: tuple[tuple[Process, float], ...]
    samples: Samples
    whole: Signal | None = None


def _samples(y: Signal, w: Signal, begin: mixture.Start, dt: Signal) -> Samples:
    profile = np.broadcast_to(np.square(begin.profile), y.shape)
    relative = np.where(w > 0.05, profile / np.maximum(w, 1e-3), UNKNOWN)
    # nearly whole weights are whole: the filter is steady between impulses
    return Samples(y, np.where(w > 0.9, profile, relative), dt, begin.least)


def _coloured(samples: Samples, white: Process) -> list[Process]:
    """Kernels with AR(1) noise, where that explains the record far better."""
    kernels = [white.kernel, *(k for k in ("smooth", "smooth+tone") if k != white.kernel)][:2]
    tried = [fit(samples, kernel, True) for kernel in kernels]
    found = min(tried, key=lambda p: p.bic)
    _, df, _ = white.smooth(samples)
    clear = -EVEN if df > IDLE * samples.count else CLEAR
    coefficient, sigma = math.exp(-1.0 / found.parts[-1, 2]), float(found.parts[-1, 1])
    if coefficient > SLOW and ALONE * sigma < 1.0 < sigma:
        return []
    weak = found.bic > white.bic - CLEAR and sigma < STRONG
    if found.bic <= white.bic - clear and not weak and _share(samples, found) < LOUDEST:
        return [found]
    if df < TOLD * samples.count and found.bic > white.bic - CLEAR:
        return []
    if "rough" not in kernels:
        tried.append(fit(samples, "rough", True))
    return _perhaps(samples, white, tried)


def _share(samples: Samples, process: Process) -> float:
    """Share of the variance that is noise."""
    known = samples.relative < UNKNOWN
    return _total(process) ** 2 / float(np.var(samples.y[known]))


def _perhaps(samples: Samples, white: Process, tried: list[Process]) -> list[Process]:
    """``coloured`` with its probability, where the record is a walk without white noise."""
    found, odds, loud = [], 0.0, 0.0
    for one in tried:
        f, df, _ = one.smooth(samples)
        share = _share(samples, one)
        if (
            share > POSSIBLE
            or df > IDLE * samples.count
            or one.parts[-1, 1] < STRONG
            or _kurtosis(samples, one, f) > NORMAL
        ):
            continue
        own = len(one.x) - 2
        cost = one.bic - white.bic - own * math.log(samples.count / max(df, 1.0))
        own_odds = math.exp(min(-0.5 * cost, 50.0))
        if share < LOUDEST:
            odds += own_odds
        else:
            loud += own_odds
        found.append(one)
    odds += min(loud, 1.0)
    trust = odds / (1.0 + odds)
    if trust < LIKELY:
        return []
    return sorted((replace(one, trust=trust) for one in found), key=lambda p: p.bic)


def _kurtosis(samples: Samples, coloured: Process, f: Signal) -> float:
    memory = math.exp(-1.0 / coloured.parts[-1, 2])
    r = samples.y - f
    known = samples.relative < UNKNOWN
    u = (r[1:] - memory * r[:-1])[known[1:] & known[:-1]]
    u = u - u.mean()
    return float(np.mean(u**4) / np.mean(u**2) ** 2) - 3.0


def smooth(
    y: Signal,
    present: Mask,
    begin: mixture.Start,
    dt: Signal,
    colour: bool = True,
    known: tuple[tuple[Process, float], ...] = (),
) -> Smoothed:
    """The robust mean of the processes.

    Args:
        y: samples, shape (n,).
        present: False where a sample is missing.
        begin: of :func:`mixture.start`.
        dt: steps of time before each sample [mean step], shape (n,).
        colour: whether coloured noise is looked for.
        known: processes to take as they are but for their scale; empty: all are fitted.
    """
    middle = float(np.mean(begin.z[present]))
    centred = y - middle
    samples = _samples(centred, (present & ~begin.outlier).astype(float), begin, dt)
    if known:
        processes = [scaled(samples, process) for process, _ in known]
    else:
        processes = sorted((fit(samples, kernel) for kernel in KERNELS), key=lambda p: p.bic)
    if colour and not known:
        processes = _coloured(samples, processes[0]) or processes
    kept = [p for p in processes if p.bic < processes[0].bic + NEAR]
    f, df = _mean(kept, samples)
    noise = mixture.first_noise(centred, f, begin, present)
    noise = replace(noise, s=max(_total(kept[0]), begin.least))
    for step in range(ROUNDS):
        w = noise.inlier(centred - f, present)
        samples = _samples(centred, w, begin, dt)
        if step == 0:
            again = scaled if known else refit
            kept = [again(samples, p) for p in kept]
        f, df = _mean(kept, samples)
        noise = mixture.next_noise(centred, f, f + w * (centred - f), w, df, present, begin, noise)
        noise = replace(noise, s=max(_total(kept[0]), begin.least))
    z = f + noise.inlier(centred - f, present) * (centred - f)
    best = min(kept, key=lambda p: p.bic)
    found = None
    if best.coloured:
        found = Colour(
            math.exp(-1.0 / best.parts[-1, 2]), float(best.parts[-1, 1] * best.s), best.s,
            best.trust,
        )
    weights = _weights(kept)
    return Smoothed(
        mixture.Fit(f + middle, z + middle, df, noise), best.kernel, found,
        tuple(zip(kept, map(float, weights), strict=True)), samples,
        None if best.trust == 1.0 else best.whole(samples) + middle,
    )  # fmt: skip


def _total(process: Process) -> float:
    """Standard deviation of all its noise."""
    return process.s * (math.hypot(1.0, process.parts[-1, 1]) if process.coloured else 1.0)


def _weights(processes: list[Process]) -> Signal:
    bic = np.array([p.bic for p in processes])
    weight = np.exp(-0.5 * (bic - bic.min()))
    return np.asarray(weight / weight.sum())


def _mean(processes: list[Process], samples: Samples) -> tuple[Signal, float]:
    total, df = np.zeros(len(samples.y)), 0.0
    for process, weight in zip(processes, _weights(processes), strict=True):
        if weight > 1e-3:
            f, own, _ = process.smooth(samples)
            total += weight * f
            df += weight * (own + len(process.x))
    return total, df
