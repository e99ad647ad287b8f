"""Wavelet shrinkage of a sliding window, against PyWavelets."""

import math

import numpy as np
import pytest
import pywt
from filter_runs import DT, constants_of, noise, rms, run, two_sines

from fpt_ros.denoising.streaming.savgol import SAVGOL
from fpt_ros.denoising.streaming.wavelet import WAVELET, WAVELETS
from fpt_ros.errors import BadInput


def reference(window, wavelet, level, sigma):
    """PyWavelets' transform, soft threshold and inverse."""
    threshold = sigma * math.sqrt(2.0 * math.log(len(window)))
    bands = pywt.wavedec(window, wavelet, mode="antireflect", level=level)
    bands[1:] = [pywt.threshold(band, threshold, "soft") for band in bands[1:]]
    return pywt.waverec(bands, wavelet, mode="antireflect")[: len(window)]


@pytest.mark.filterwarnings("ignore:Level value")
@pytest.mark.parametrize("wavelet", WAVELETS)
@pytest.mark.parametrize(("window", "level"), [(64, 2), (128, 3)])
def test_shrinkage_is_that_of_pywavelets(wavelet, window, level):
    q = np.cumsum(noise(window + 3, sigma=0.02)) + noise(window + 3, seed=1, sigma=0.02)
    given = {"wavelet": wavelet, "window": window, "level": level, "sigma": 0.02}
    for fit, degree in ((3, 2), (15, 3)):
        out = run(WAVELET, q, dt=0.1, fit=fit, degree=degree, **given)[-1, :, 0]
        x = 0.1 * np.arange(1 - fit, 1)
        shrunk = reference(q[-window:], wavelet, level, 0.02)
        p = np.polynomial.Polynomial.fit(x, shrunk[-fit:], degree)
        assert out == pytest.approx([p(0), p.deriv(1)(0), p.deriv(2)(0)], rel=1e-9, abs=1e-9)


def test_without_noise_it_is_the_fit_alone():
    q = two_sines(400)[0]
    given = {"fit": 41, "degree": 3}
    out = run(WAVELET, q, sigma=1e-300, **given)[1:]
    plain = run(SAVGOL, q, window=41, degree=3)[1:]
    for i, unit in enumerate((1.0, 1e3, 1e6)):
        assert out[256:, i] == pytest.approx(plain[256:, i], abs=1e-12 * unit)


def test_shrinkage_gains_nothing_at_the_newest_sample():
    """Section 3: with the fit after it, it is at best the Savitzky-Golay filter of that window."""
    clean = two_sines(1800)
    q = clean[0] + noise(1800)
    shrunk = run(WAVELET, q)[1000:, :, 0]
    fit = run(SAVGOL, q, window=141, degree=3)[1000:, :, 0]
    for i in range(3):
        ratio = rms(shrunk[:, i] - clean[i][1000:]) / rms(fit[:, i] - clean[i][1000:])
        assert 0.97 < ratio < 1.15


def test_rest_is_exact_and_missing_samples_do_not_spread():
    q = np.full(400, 0.3)
    q[300] = math.nan
    out = run(WAVELET, q)[1:, :, 0]
    assert out == pytest.approx(np.tile([0.3, 0.0, 0.0], (399, 1)), abs=1e-15)


def test_two_coordinates_share_their_workspace_and_nothing_else():
    a, b = two_sines(300)[0] + noise(300), 1e3 + noise(300, seed=9)
    given = {"window": 64, "fit": 31}
    both = run(WAVELET, np.column_stack([a, b]), **given)
    assert np.array_equal(both[:, :, 1], run(WAVELET, b, **given)[:, :, 0], equal_nan=True)
    assert np.array_equal(both[:, :, 0], run(WAVELET, a, **given)[:, :, 0], equal_nan=True)


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        ({"window": 200}, "a power of 2"),
        ({"fit": 257}, "it is longer"),
        ({"fit": 40}, "an odd number"),
        ({"fit": 3, "degree": 3}, "less than the window"),
        ({"window": 16, "fit": 15, "wavelet": "sym8", "level": 2}, "has fewer levels"),
        ({"wavelet": "bior2.2"}, "haar, db2"),
    ],
)
def test_transforms_that_cannot_be(given, reason):
    with pytest.raises(BadInput, match=reason):
        constants_of(WAVELET, dt=DT, **given)
