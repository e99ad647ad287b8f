"""Threshold rules against MATLAB's documented values, closed forms and the brute-force risk."""

import math

import numpy as np
import pytest
import pywt
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fpt_ros.denoising import signals
from fpt_ros.denoising.offline import heursure, minimax, sureshrink, thresholding, universal
from fpt_ros.denoising.offline.noise import noise_sigma

RULES = {
    "universal": (universal.rule, 4),
    "sureshrink": (sureshrink.rule, 8),
    "heursure": (heursure.rule, 4),
    "minimax": (minimax.rule, 4),
}


def stein_risk(x, t):
    """Unbiased risk of soft thresholding N(theta, 1) samples at t (Donoho and Johnstone 1995)."""
    return len(x) - 2 * np.sum(np.abs(x) <= t) + np.sum(np.minimum(x**2, t**2))


def test_thselect_of_1000_samples():
    # MATLAB's help of thselect: 3.7169 (sqtwolog) and 2.2163 (minimaxi) for 1000 samples
    assert universal.threshold(1000) == pytest.approx(3.7169, abs=5e-5)
    assert minimax.threshold(1000) == pytest.approx(2.2163, abs=5e-5)


def test_minimax_removes_nothing_of_short_signals():
    assert minimax.threshold(32) == 0.0
    assert minimax.threshold(33) > 1.0


eighths = st.integers(-48, 48).map(lambda k: k / 8)  # their squares and roots are exact


@settings(max_examples=25, deadline=None)
@given(arrays(float, st.integers(1, 40), elements=eighths))
def test_sure_minimises_the_brute_force_risk(x):
    found = sureshrink.threshold(x)
    assert stein_risk(x, found) == pytest.approx(min(stein_risk(x, t) for t in np.abs(x)))


@settings(max_examples=25, deadline=None)
@given(st.sets(st.integers(0, 48), min_size=2), st.randoms())
def test_risk_at_every_coefficient(magnitudes, random):
    x = np.array([random.choice((-1, 1)) * k / 8 for k in magnitudes])
    squares, risk = sureshrink.risks(x)
    brute = [stein_risk(x, t) / len(x) for t in np.sqrt(squares)]
    np.testing.assert_allclose(risk, brute, atol=1e-12)


def test_risk_is_unbiased():
    rng = np.random.default_rng(1)
    theta = np.repeat([0.0, 3.0], 20000)
    x = theta + rng.standard_normal(len(theta))
    loss = np.mean((thresholding.soft(x, 1.2) - theta) ** 2)
    squares, risk = sureshrink.risks(x)
    assert risk[np.searchsorted(squares, 1.44)] == pytest.approx(loss, abs=0.02)


def test_heursure_takes_universal_for_noise_and_sure_for_strong_signals():
    noise = np.random.default_rng(2).standard_normal(512)
    assert heursure.rule(noise, 512) == universal.threshold(512)
    strong = noise + np.where(np.arange(512) % 3 == 0, 6.0, 0.0)
    assert heursure.rule(strong, 512) == sureshrink.threshold(strong) < universal.threshold(512)


def test_heursure_literally_printed_would_be_universal():
    x = np.random.default_rng(3).standard_normal(512) * 3
    eta = np.mean(x**2) - 1
    assert eta < math.log2(512) ** 1.5  # the print, without / sqrt(k)
    assert not heursure.sparse(x)


@pytest.mark.parametrize("wavelet", ["haar", "db2", "sym8", "coif3"])
@pytest.mark.parametrize("n", [16, 333, 1024])
def test_perfect_reconstruction(wavelet, n):
    y = np.random.default_rng(4).standard_normal(n)
    bands = thresholding.decompose(y, wavelet, 8)
    np.testing.assert_allclose(thresholding.compose(bands, wavelet, n), y, atol=1e-10)


def test_sigma_is_that_of_the_noise_and_ignores_impulses():
    f = signals.clean("sines")
    y = f + signals.spiky_noise(1024, 0.1, 5)
    assert noise_sigma(y) == pytest.approx(0.1, rel=0.15)


@pytest.mark.parametrize("name", RULES)
def test_lines_pass(name):
    rule, level = RULES[name]
    line = 3.0 - 0.02 * np.arange(512)
    interior = slice(150, -150)  # symmetric extension bends a line at its ends
    found = thresholding.shrink(line, rule, "sym8", min(level, 3))
    np.testing.assert_allclose(found[interior], line[interior], atol=1e-9)


@pytest.mark.parametrize("name", RULES)
@settings(max_examples=25, deadline=None)
@given(shift=st.floats(-1e3, 1e3), scale=st.floats(1e-3, 1e3))
def test_shift_and_scale(name, shift, scale):
    rule, level = RULES[name]
    y = signals.clean("blocks", 128) + signals.white_noise(128, 0.2, 6)
    found = thresholding.shrink(scale * y + shift, rule, "sym4", level)
    expected = scale * thresholding.shrink(y, rule, "sym4", level) + shift
    np.testing.assert_allclose(found, expected, atol=1e-8 * (abs(shift) + scale))


@pytest.mark.parametrize(
    ("name", "expected"),
    [("universal", 13.6), ("sureshrink", 8.3), ("heursure", 13.2), ("minimax", 10.8)],
)
def test_figures_of_the_sines(name, expected):
    f = signals.clean("sines")
    rule, level = RULES[name]
    found = [
        signals.snr_db(
            f, thresholding.shrink(f + signals.impulsive_noise(f, 0.5, seed), rule, "sym8", level)
        )
        for seed in range(10, 30)
    ]
    assert np.mean(found) == pytest.approx(expected, abs=0.3)


def test_one_sigma_for_each_level():
    y = np.repeat(np.random.default_rng(7).standard_normal(128), 8)  # noise that is not white
    one = thresholding.shrink(y, universal.rule, "haar", 4, "sln")
    each = thresholding.shrink(y, universal.rule, "haar", 4, "mln")
    np.testing.assert_allclose(one, y, atol=1e-12)  # the finest detail is 0: nothing is removed
    before, after = (pywt.wavedec(x, "haar", level=4)[1] for x in (y, each))
    assert np.sum(after**2) < 0.1 * np.sum(before**2)
