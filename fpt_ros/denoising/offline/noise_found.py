"""What the noise of a record is: its level and how that varies, its colour, the step of rounding.

In this order: the step (:mod:`quantisation`), impulses (:func:`mixture.start`), the profile of the
level (:mod:`spectral_floor`), and the colour, for which Gaussian processes with white noise compete
against the same with AR(1) noise beside (:mod:`colour`).

Members that know white noise alone see coloured noise as white noise that is as strong at low
frequencies, where a signal is: sigma sqrt((1 + c) / (1 - c)) for the coefficient c.
"""

from dataclasses import dataclass, replace

import numpy as np

from fpt_ros.denoising.offline import Mask, Noise, Signal, mixture, process_member, quantisation
from fpt_ros.denoising.offline.gaussian_process import Process
from fpt_ros.denoising.offline.spectral_floor import profile


@dataclass(frozen=True)
class Beginning:
    """What all members begin with.

    Attributes:
        begin: the record without impulses, and the level of its noise.
        process: what the Gaussian processes found on the way.
        step: of rounding, unit of y; 0: none.
    """

    begin: mixture.Start
    process: process_member.Smoothed
    step: float

    def at_level(self, sigma: float) -> "Beginning":
        """The same where the noise turned out to be of another level."""
        return replace(self, begin=replace(self.begin, sigma=sigma))

    def noise(self, impulses: float) -> Noise:
        """The noise in the words of the result, given the share of impulses."""
        colour = self.process.colour
        size = np.atleast_1d(self.begin.sigma / self.begin.inflation * self.begin.profile)
        return Noise(
            float(np.exp(np.mean(np.log(size)))), float(size.min()), float(size.max()), self.step,
            impulses, 0.0 if colour is None else colour.coefficient,
        )  # fmt: skip


def find(
    y: Signal,
    present: Mask,
    dt: Signal,
    known: tuple[tuple[Process, float], ...] = (),
    step: float | None = None,
) -> Beginning:
    """The noise of ``y``.

    Args:
        y: samples, shape (n,); missing ones filled.
        present: False where a sample is missing.
        dt: steps of time before each sample [mean step], shape (n,).
        known: processes that were found in other parts of the record, to begin from.
        step: of rounding, where that is known.
    """
    step = quantisation.least_step(y, present) if step is None else step
    begin = mixture.start(y, present, step)
    coarse = begin.sigma < step
    even = bool(np.all(dt == 1.0))
    if even and not coarse:
        shape = profile(begin.z, present, begin.least)
        if shape.max() > shape.min():
            begin = mixture.varying(y, present, begin, shape)
    process = process_member.smooth(y, present, begin, dt, even and not coarse, known)
    if process.colour is not None:
        inflation = max(1.0, process.colour.low / begin.sigma)
        begin = replace(begin, sigma=begin.sigma * inflation, inflation=inflation)
    return Beginning(begin, process, step)
