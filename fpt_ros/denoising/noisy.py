"""A test signal under one draw of noise, by a word: ``test:sines,rho=0.5,seed=10``."""

from dataclasses import dataclass, replace

import numpy as np

from fpt_ros.denoising.signals import (
    CHAPTER5,
    CHAPTER6,
    SNR_BEFORE,
    Signal,
    clean,
    impulsive_noise,
    spiky_noise,
    white_noise,
)
from fpt_ros.errors import BadInput

PREFIX = "test:"
EXAMPLE = f"{PREFIX}sines,rho=0.5,seed=10"


@dataclass(frozen=True)
class Noisy:
    """A test signal and its noise.

    Attributes:
        signal: a name of :mod:`~fpt_ros.denoising.signals`.
        seed: of the noise.
        rho: share of impulses of the noise power; of the signals of chapter 5.
        snr: before denoising [dB]; of chapter 5, and the default is that of Table 5.1.
        sigma: standard deviation of white noise; of the signals of chapter 6.
        spikes: 1: impulses of 1 to 3 units in 2 % of the samples besides; of chapter 6.
        missing: share of the samples that are missing, at random.
        n: number of samples.
    """

    signal: str
    seed: int = 10
    rho: float = 0.5
    snr: float = SNR_BEFORE
    sigma: float = 0.05
    spikes: int = 0
    missing: float = 0.0
    n: int = 1024

    def clean(self) -> Signal:
        """The signal, shape (n,)."""
        return clean(self.signal, self.n)

    def samples(self) -> Signal:
        """Signal and noise, shape (n,), NaN where a sample is missing."""
        f = self.clean()
        if self.signal in CHAPTER5:
            y = f + impulsive_noise(f, self.rho, self.seed, snr_before=self.snr)
        else:
            draw = spiky_noise if self.spikes else white_noise
            y = f + draw(self.n, self.sigma, self.seed)
        hidden = np.random.default_rng((self.seed, 1)).random(self.n) < self.missing
        return np.where(hidden, np.nan, y)

    def with_seed(self, seed: int) -> "Noisy":
        """Another draw of the same noise."""
        return replace(self, seed=seed)

    def text(self, seed: str = "") -> str:
        """The word for it; ``seed``: what to write in the place of the number."""
        words = [f"{PREFIX}{self.signal}"]
        if self.signal in CHAPTER5:
            words += [f"rho={self.rho:g}", *[f"snr={self.snr:g}"] * (self.snr != SNR_BEFORE)]
        else:
            words += [f"sigma={self.sigma:g}", *["spikes=1"] * self.spikes]
        words += [f"missing={self.missing:g}"] * (self.missing > 0.0)
        words += [f"n={self.n}"] * (self.n != 1024)
        return ",".join([*words, f"seed={seed or self.seed}"])


LIMITS = {
    "seed": (0, 2**63),
    "rho": (0.0, 1.0),
    "snr": (-100.0, 200.0),
    "sigma": (0.0, 1e6),
    "spikes": (0, 1),
    "missing": (0.0, 0.9),
    "n": (2, 10**8),
}
"""Of what can be given; whole numbers where the limits are."""


def parse(text: str) -> Noisy:
    """The noisy signal that a word is for.

    Raises:
        BadInput: no such signal, or something unknown or out of its range after the name.
    """
    name, *pairs = text.removeprefix(PREFIX).split(",")
    if name not in (*CHAPTER5, *CHAPTER6):
        raise BadInput(f"{text}: test signals are {', '.join((*CHAPTER5, *CHAPTER6))}")
    own = ("rho", "snr") if name in CHAPTER5 else ("sigma", "spikes")
    given: dict[str, float] = {}
    for pair in pairs:
        key, _, value = pair.partition("=")
        if key not in (*own, "seed", "missing", "n"):
            names = ", ".join((*own, "seed", "missing", "n"))
            raise BadInput(f"{text}: {name} takes {names}, as in {EXAMPLE}")
        low, high = LIMITS[key]
        try:
            given[key] = type(low)(value)
        except ValueError:
            raise BadInput(f"{text}: {key}={value} is not a {_kind(low)}") from None
        if not low <= given[key] <= high:
            raise BadInput(f"{text}: {key} lies between {low} and {high}")
    return Noisy(name, **given)  # type: ignore[arg-type]  # of the types of their limits


def _kind(limit: float) -> str:
    return "whole number" if isinstance(limit, int) else "number"
