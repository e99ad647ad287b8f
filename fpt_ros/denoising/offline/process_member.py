"""The Gaussian processes as a member of ``auto``: robust, and judged by their evidence.

Kernels are fitted where no impulse is; then EM separates impulses as for the others
(:mod:`mixture`), an impulse with the probability 1 - w having the variance sigma^2 / w. The means
of all kernels are averaged with the weights exp(-BIC / 2).
"""

from dataclasses import dataclass, replace

import numpy as np

from fpt_ros.denoising.offline import Mask, Signal, mixture
from fpt_ros.denoising.offline.colour import Colour, all_noise, believed, colour_of
from fpt_ros.denoising.offline.gaussian_process import KERNELS, Process, Samples, fit, refit, scaled
from fpt_ros.denoising.offline.kalman import UNKNOWN

ROUNDS = 3
NEAR = 12.0
"""Kernels within this BIC of the best are kept."""


@dataclass(frozen=True)
class Smoothed:
    """What the processes found.

    Attributes:
        fit: estimate, degrees of freedom, mixture.
        kernel: that of most evidence.
        colour: of the noise; None: white.
        processes: those that were averaged, with their weights.
        samples: what they were fitted to.
        whole: estimate if the colour were a part of the signal, shape (n,); None: it is none.
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


def smooth(
    y: Signal,
    present: Mask,
    begin: mixture.Start,
    dt: Signal,
    look: bool = True,
    known: tuple[tuple[Process, float], ...] = (),
) -> Smoothed:
    """The robust mean of the processes.

    Args:
        y: samples, shape (n,).
        present: False where a sample is missing.
        begin: of :func:`mixture.start`.
        dt: steps of time before each sample [mean step], shape (n,).
        look: whether coloured noise is looked for.
        known: processes to take as they are but for their scale; empty: all are fitted.
    """
    middle = float(np.mean(begin.z[present]))
    centred = y - middle
    samples = _samples(centred, (present & ~begin.outlier).astype(float), begin, dt)
    if known:
        processes = [scaled(samples, process) for process, _ in known]
    else:
        processes = sorted((fit(samples, kernel) for kernel in KERNELS), key=lambda p: p.bic)
    if look and not known:
        processes = believed(samples, processes[0]) or processes
    kept = [p for p in processes if p.bic < processes[0].bic + NEAR]
    f, df = _mean(kept, samples)
    noise = mixture.first_noise(centred, f, begin, present)
    noise = replace(noise, s=max(all_noise(kept[0]), begin.least))
    for step in range(ROUNDS):
        w = noise.inlier(centred - f, present)
        samples = _samples(centred, w, begin, dt)
        if step == 0:
            again = scaled if known else refit
            kept = [again(samples, p) for p in kept]
        f, df = _mean(kept, samples)
        noise = mixture.next_noise(centred, f, f + w * (centred - f), w, df, present, begin, noise)
        noise = replace(noise, s=max(all_noise(kept[0]), begin.least))
    z = f + noise.inlier(centred - f, present) * (centred - f)
    best = min(kept, key=lambda p: p.bic)
    weights = _weights(kept)
    return Smoothed(
        mixture.Fit(f + middle, z + middle, df, noise), best.kernel, colour_of(best),
        tuple(zip(kept, map(float, weights), strict=True)), samples,
        None if best.trust == 1.0 else best.whole(samples) + middle,
    )  # fmt: skip


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
