"""The threshold rules (5.1) to (5.4) as the thesis prints them, misprints and all."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fpt_ros.denoising.offline import Signal, heursure, minimax, sureshrink, universal
from fpt_ros.denoising.offline.thresholding import Rule, compose, decompose, soft

WAVELET = "sym8"


@dataclass(frozen=True)
class Printed:
    """A rule.

    Attributes:
        method: the denoiser that has it corrected.
        level: of the decomposition, that of Table 5.1.
        printed: ``printed(x, y, sigma)``: threshold of a detail x of y.
        corrected: the same rule corrected, in units of sigma.
    """

    method: str
    level: int
    printed: Callable[[Signal, Signal, float], float]
    corrected: Rule

    def denoise(self, y: Signal) -> Signal:
        """The estimate by the rule as printed, shape (n,)."""
        approximation, *details = decompose(y, WAVELET, self.level)
        noise = sigma(details[-1])
        shrunk = [soft(x, self.printed(x, y, noise)) for x in details]
        return compose([approximation, *shrunk], WAVELET, len(y))


def sigma(finest: Signal) -> float:
    """``median(omega_j) / 0.6745``, without an absolute value: about 0 of any symmetric band."""
    return abs(float(np.median(finest))) / 0.6745


def _universal(x: Signal, y: Signal, noise: float) -> float:
    return noise * math.sqrt(2.0) * math.log(len(y))


def _sure(x: Signal, y: Signal, noise: float) -> float:
    """(5.2), with the standard deviation of the noisy signal."""
    squares, n = np.sort(x**2), len(x)
    i = np.arange(1, n + 1)
    risk = np.abs(n - 2 * i + (n - i) * squares + np.sum(squares**2)) / n
    return float(np.std(y)) * math.sqrt(risk.min())


def _heursure(x: Signal, y: Signal, noise: float) -> float:
    k = len(x)
    square = float(np.sum((x / noise) ** 2))
    bound = noise * universal.threshold(k)
    return bound if (square - k) / k <= math.log2(k) ** 1.5 else min(bound, _sure(x, y, noise))


def _minimax(x: Signal, y: Signal, noise: float) -> float:
    return noise * (0.3936 + 0.1829 * len(y))


RULES = {
    "universal (5.1)": Printed("universal", 4, _universal, universal.rule),
    "SureShrink (5.2)": Printed("sureshrink", 8, _sure, sureshrink.rule),
    "HeurSure (5.3)": Printed("heursure", 4, _heursure, heursure.rule),
    "minimax (5.4)": Printed("minimax", 4, _minimax, minimax.rule),
}
