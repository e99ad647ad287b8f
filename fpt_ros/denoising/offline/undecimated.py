"""Undecimated (translation invariant) wavelet with neighbour shrinkage: the method for white noise.

The mean over all shifts of the orthogonal DWT, done in the Fourier domain of the signal reflected
to 2n samples. Beyond the thesis: its rules threshold single coefficients of one shift. In level j
here, with S the sum of squares over the 2h+1 neighbours at stride 2^j (the same decimated basis,
hence uncorrelated noise), L = 2h+1 and n_j = n / 2^j::

    x (1 - lambda/S)+,    lambda = c sigma^2 (L + 2 sqrt(L ln n_j) + 2 ln n_j)

h and c are those of the least exact Stein risk of the level: with g = x_hat - x the risk is
sum(g^2 + 2 sigma^2 dg/dx) + const, where dx_hat/dx = 1 - lambda/S + 2 lambda x^2/S^2 for
S > lambda, else 0.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import pywt
import scipy.fft
from numba import njit
from numpy.typing import NDArray

from fpt_ros.denoising.offline import Mask, Method, Signal
from fpt_ros.denoising.offline.noise import noise_sigma
from fpt_ros.denoising.offline.thresholding import WAVELETS
from fpt_ros.parameters import Parameter, Values, word

HALVES = (0, 1, 2, 4)
"""Half-widths h of the neighbourhoods tried."""

FACTORS = (0.25, 0.4, 0.55, 0.7, 0.85, 1.0)
"""Factors c of the threshold tried."""

_HALVES = np.array(HALVES)


@dataclass(frozen=True)
class Bank:
    """Frequency responses of the undecimated transform of 2n periodic samples.

    Attributes:
        n: length of the signal.
        response: of the details 1 .. J and of the approximation, shape (J + 1, n + 1).
        weight: 2^-j of each, so that sum_j weight_j |response_j|^2 = 1, shape (J + 1, 1).
    """

    n: int
    response: NDArray[np.complex128]
    weight: Signal

    @property
    def levels(self) -> int:
        """Number J of details."""
        return len(self.response) - 1

    def analyse(self, y: Signal) -> Signal:
        """Undecimated coefficients, shape (J + 1, 2n)."""
        spectrum = scipy.fft.rfft(np.concatenate((y, y[::-1])))
        return np.asarray(scipy.fft.irfft(self.response * spectrum, 2 * self.n, axis=1))

    def synthesise(self, bands: Signal) -> Signal:
        """The n samples that are the mean over all shifts of the inverse DWT."""
        spectra = scipy.fft.rfft(bands, axis=1)
        spectrum = np.sum(self.weight * self.response.conj() * spectra, axis=0)
        doubled = scipy.fft.irfft(spectrum, 2 * self.n)
        return np.asarray(0.5 * (doubled[: self.n] + doubled[: self.n - 1 : -1]))


def depth(n: int) -> int:
    """Levels J = log2(n) - 3, at least 1: eight coefficients of the approximation are left."""
    return max(1, int(math.log2(n)) - 3)


@lru_cache(maxsize=16)
def bank(wavelet: str, n: int, levels: int | None = None) -> Bank:
    """The transform of n samples reflected to 2n."""
    filters = pywt.Wavelet(wavelet)
    low, high = np.asarray(filters.dec_lo), np.asarray(filters.dec_hi)
    omega = np.pi * np.arange(n + 1) / n
    taps = np.arange(len(low))
    through = np.ones(n + 1, dtype=np.complex128)
    responses, weights = [], []
    for j in range(levels or depth(n)):
        phase = np.exp(-1j * np.outer(omega * 2**j, taps))
        responses.append(through * (phase @ high))
        weights.append(2.0 ** -(j + 1))
        through = through * (phase @ low)
    responses.append(through)
    weights.append(weights[-1])
    return Bank(n, np.array(responses), np.array(weights)[:, None])


def threshold(half: int, n_j: float, factor: float = 1.0) -> float:
    """Lambda in units of sigma^2 for 2 half + 1 neighbours of n_j coefficients."""
    size, log = 2 * half + 1, math.log(max(n_j, 2.0))
    return factor * (size + 2.0 * math.sqrt(size * log) + 2.0 * log)


@njit(cache=True, fastmath=True)
def _energies(x: Signal, half: int, stride: int, out: Signal) -> None:
    """Sum of squares over the 2 half + 1 neighbours at ``stride``, periodic."""
    n = len(x)
    for i in range(n):
        out[i] = x[i] * x[i]
    for m in range(1, half + 1):
        shift = (m * stride) % n
        for i in range(n):
            before = i - shift
            after = i + shift
            if before < 0:
                before += n
            if after >= n:
                after -= n
            out[i] += x[before] * x[before] + x[after] * x[after]


@njit(cache=True, fastmath=True)
def _shrink_band(
    x: Signal, stride: int, halves: NDArray[np.int64], lambdas: Signal, variance: float
) -> tuple[float, float, int, int]:
    """Shrink ``x`` in place by the (h, lambda) of least Stein risk.

    ``lambdas``, shape (halves, factors), unit of x^2. Returns the mean derivative of the estimate,
    its mean Stein risk (unit of x^2), and the indices of what was chosen.
    """
    n = len(x)
    energy = np.empty((len(halves), n))
    best, best_h, best_c = np.inf, 0, 0
    for h in range(len(halves)):
        _energies(x, halves[h], stride, energy[h])
        for c in range(lambdas.shape[1]):
            lam = lambdas[h, c]
            risk = 0.0
            for i in range(n):
                s = energy[h, i]
                square = x[i] * x[i]
                q = lam / s if s > lam else 1.0
                if s > lam:
                    risk += square * q * q + 2.0 * variance * (2.0 * square * q / s - q)
                else:
                    risk += square - 2.0 * variance
            if risk < best:
                best, best_h, best_c = risk, h, c
    lam = lambdas[best_h, best_c]
    slope = 0.0
    for i in range(n):
        s = energy[best_h, i]
        if s > lam:
            q = lam / s
            slope += 1.0 - q + 2.0 * q * x[i] * x[i] / s
            x[i] *= 1.0 - q
        else:
            x[i] = 0.0
    return slope / n, best / n + variance, best_h, best_c


@lru_cache(maxsize=16)
def _lambdas(n: int, levels: int) -> Signal:
    """Thresholds in units of sigma^2, shape (levels, halves, factors)."""
    return np.array(
        [
            [[threshold(h, n / 2.0 ** (j + 1), c) for c in FACTORS] for h in HALVES]
            for j in range(levels)
        ]
    )


def shrink(y: Signal, sigma: float, wavelet: str = "sym8") -> tuple[Signal, float]:
    """The estimate for white noise of ``sigma``, shape (n,), and its degrees of freedom.

    The degrees of freedom are n/2^J + sum_j n 2^-j (mean derivative of level j): the trace of the
    derivative of the estimate.
    """
    n = len(y)
    transform = bank(wavelet, n)
    bands = transform.analyse(y)
    df = n / 2.0**transform.levels
    if sigma > 0.0:
        variance = sigma * sigma
        lambdas = _lambdas(n, transform.levels) * variance
        for j in range(transform.levels):
            slope, *_ = _shrink_band(bands[j], 2 ** (j + 1), _HALVES, lambdas[j], variance)
            df += n / 2.0 ** (j + 1) * slope
    else:
        df = float(n)
    return transform.synthesise(bands), min(df, float(n))


def _estimate(y: Signal, present: Mask, values: Values) -> Signal:
    return shrink(y, noise_sigma(y, present), word(values, "wavelet"))[0]


WAVELET = Parameter("wavelet", "orthogonal wavelet", "sym8", choices=WAVELETS)
UNDECIMATED = Method((WAVELET,), _estimate)
