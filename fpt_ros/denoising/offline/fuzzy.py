"""The fuzzy supervisor (thesis section 5.1.1): level, rule, wavelet and window from the signal.

Four Mamdani experts (:mod:`~fpt_ros.denoising.experts`). Inputs: the SNR [dB] of the
median-filtered signal, the share e of the noise-free energy in the three finest details, the change
dv [decades] of detail energy against a sine probe, the mean kurtosis of coarse details (jumps), and
the level already chosen.

Measured, its choice of level, rule and wavelet does not beat HeurSure with 4 levels, and dv
saturates: the probe as described carries no information. ``auto`` chooses by risk instead.
"""

import math
from dataclasses import asdict, dataclass

import numpy as np
import pywt
from scipy.ndimage import median_filter

from fpt_ros.denoising.experts import LEVEL, RULE, WAVELET, WINDOW
from fpt_ros.denoising.offline import Info, Mask, Method, Signal, heursure, minimax, sureshrink
from fpt_ros.denoising.offline import universal as universal_rule
from fpt_ros.denoising.offline.improved import improved
from fpt_ros.denoising.offline.noise import noise_sigma
from fpt_ros.denoising.offline.thresholding import decompose, shrink
from fpt_ros.parameters import Parameter, Values, word

RULES = {
    "sureshrink": sureshrink.rule,
    "minimax": minimax.rule,
    "heursure": heursure.rule,
    "universal": universal_rule.rule,
}
WAVELETS = ("haar", "db2", "sym4", "sym8")


@dataclass(frozen=True)
class Choice:
    """What the four experts chose."""

    level: int
    rule: str
    wavelet: str
    window: int


def _levels(n: int) -> int:
    return max(1, int(math.log2(n)) - 3)


def snr(y: Signal, sigma: float) -> float:
    """10 log10(signal power / sigma^2) [dB], the signal's from a running median of 5.

    The median of 5 leaves sigma^2 / 3.5 of white noise.
    """
    power = float(np.var(median_filter(y, 5, mode="reflect"))) - sigma**2 / 3.5
    return 10.0 * math.log10(max(power, 1e-6 * sigma**2) / sigma**2)


def fine_share(y: Signal, sigma: float) -> float:
    """Share of the noise-free energy in the three finest db2 details, 0 to 1."""
    bands = decompose(y, "db2", min(_levels(len(y)), 8))

    def energy(band: Signal) -> float:
        clipped = np.clip(band, -4.0 * sigma, 4.0 * sigma)
        return max(float(np.sum(clipped**2)) - len(band) * sigma**2, 0.0)

    fine = sum(energy(band) for band in bands[1:][-3:])
    coarse = sum(max(float(np.sum(band**2)) - len(band) * sigma**2, 0.0) for band in bands[1:][:-3])
    base = bands[0] - bands[0].mean()
    coarse += max(float(np.sum(base**2)) - len(base) * sigma**2, 0.0)
    return fine / (fine + coarse) if fine + coarse > 0 else 0.0


def detail_change(y: Signal) -> float:
    """log10 of the detail energy of ``y`` over that of the sine probe [decades].

    The probe is a sine at the dominant bin of the median-filtered signal, of the same power.
    """
    n = len(y)
    smooth = median_filter(y, 5, mode="reflect")
    smooth = smooth - smooth.mean()
    bin_ = max(int(np.argmax(np.abs(np.fft.rfft(smooth)))), 1)
    probe = math.sqrt(2.0) * smooth.std() * np.sin(2 * np.pi * bin_ * np.arange(n) / n)
    own, reference = (
        sum(float(np.sum(band**2)) for band in decompose(x, "db2", 3)[1:]) for x in (y, probe)
    )
    if own <= 0.0:
        return 0.0
    return math.log10(own / reference) if reference > 0 else 2.0


def jumpiness(y: Signal) -> float:
    """log10(mean kurtosis of the 3 coarsest details / 3) [decades]; 0 for normal coefficients."""
    found = []
    for band in pywt.wavedec(y, "haar", level=_levels(len(y)))[1:4]:
        centred = band - band.mean()
        power = float(np.mean(centred**2))
        if power > 0:
            found.append(float(np.mean(centred**4)) / power**2)
    return math.log10(max(float(np.mean(found)) / 3.0, 1e-3)) if found else 0.0


def supervise(y: Signal, sigma: float) -> Choice:
    """The choice for ``y`` with white noise of ``sigma`` > 0."""
    deepest = _levels(len(y))
    strength, fine = snr(y, sigma), fine_share(y, sigma)
    level = round(1 + LEVEL.infer(strength, fine) * (deepest - 1))
    rule = RULE.infer(level / deepest, detail_change(y))
    wavelet = WAVELET.infer(jumpiness(y), fine)
    window = int(11 * 11 ** WINDOW.infer(strength, fine)) | 1
    return Choice(
        level,
        tuple(RULES)[min(int(4 * rule), 3)],
        WAVELETS[min(int(4 * wavelet), 3)],
        window,
    )


def _detailed(y: Signal, present: Mask, values: Values) -> tuple[Signal, Info]:
    sigma = noise_sigma(y, present)
    if sigma <= 1e-12 * float(np.ptp(y)):
        return y, {"chosen": "none: no noise"}
    choice = supervise(y, sigma)
    if word(values, "shrinkage") == "improved":
        estimate = improved(y, choice.window, choice.wavelet, detail="zero")
    else:
        estimate = shrink(y, RULES[choice.rule], choice.wavelet, choice.level)
    return estimate, asdict(choice)


def _estimate(y: Signal, present: Mask, values: Values) -> Signal:
    return _detailed(y, present, values)[0]


PARAMETERS = (
    Parameter(
        "shrinkage",
        "threshold: the chosen rule, wavelet and level; improved: loess of the chosen window",
        "threshold",
        choices=("threshold", "improved"),
    ),
)
FUZZY = Method(PARAMETERS, _estimate, lambda _: 16, _detailed)
