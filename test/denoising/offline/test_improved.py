"""Robust loess against plain least squares, and the thesis's improved denoising."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.denoising import signals
from fpt_ros.denoising.offline.improved import improved
from fpt_ros.denoising.offline.loess import loess


def by_least_squares(y, q, degree, delta):
    """Local fits with numpy's least squares instead of moments."""
    n = len(y)
    found = np.empty(n)
    for i in range(n):
        near = np.arange(n)[np.argsort(np.abs(np.arange(n) - i), kind="stable")][:q]
        first = min(max(i - q // 2, 0), n - q)
        near = np.arange(first, first + q)
        h = np.max(np.abs(near - i))
        u = (near - i) / (h + 0.5)
        w = (1 - np.abs(u) ** 3) ** 3 * delta[near]
        design = np.vander(u, degree + 1, increasing=True) * np.sqrt(w)[:, None]
        found[i] = np.linalg.lstsq(design, y[near] * np.sqrt(w), rcond=None)[0][0]
    return found


@pytest.mark.parametrize("degree", [1, 2])
@pytest.mark.parametrize("q", [7, 21])
def test_plain_loess_is_local_least_squares(degree, q):
    y = np.random.default_rng(1).standard_normal(60)
    found, _ = loess(y, q, degree, passes=0)
    np.testing.assert_allclose(found, by_least_squares(y, q, degree, np.ones(60)), atol=1e-9)


def test_robust_pass_is_a_fit_with_bisquare_weights():
    y = np.sin(np.arange(80) / 9) + np.random.default_rng(2).standard_t(2, 80) * 0.1
    r = y - by_least_squares(y, 21, 2, np.ones(80))
    s = np.median(np.abs(r))
    delta = np.where(np.abs(r) < 6 * s, (1 - (r / (6 * s)) ** 2) ** 2, 0)
    found, _ = loess(y, 21, 2, passes=1)
    np.testing.assert_allclose(found, by_least_squares(y, 21, 2, delta), atol=1e-9)


@settings(max_examples=25, deadline=None)
@given(st.lists(st.floats(-10, 10), min_size=3, max_size=3), st.integers(5, 41))
def test_parabolas_pass(coefficients, q):
    y = np.polyval(coefficients, np.linspace(-1, 1, 50))
    np.testing.assert_allclose(loess(y, q)[0], y, atol=1e-8)


def test_outliers_leave_no_trace():
    line = 0.1 * np.arange(100.0)
    rng = np.random.default_rng(3)
    y = line + 0.01 * rng.standard_normal(100)
    y[[10, 47, 48, 80]] += [50, -70, 40, 60]
    assert np.max(np.abs(loess(y, 31)[0] - line)) < 0.03
    assert np.max(np.abs(loess(y, 31, passes=0)[0] - line)) > 3


def test_gain_is_the_variance_of_the_fit():
    rng = np.random.default_rng(4)
    noise = rng.standard_normal((3000, 31))
    fits = np.array([loess(y, 15, passes=0)[0] for y in noise])
    np.testing.assert_allclose(fits.var(axis=0), loess(noise[0], 15, passes=0)[1], rtol=0.12)


@settings(max_examples=25, deadline=None)
@given(shift=st.floats(-1e3, 1e3), scale=st.floats(1e-2, 1e3))
def test_shift_and_scale(shift, scale):
    f = signals.clean("sines", 256)
    y = f + signals.impulsive_noise(f, 0.5, 5)
    found = improved(scale * y + shift)
    np.testing.assert_allclose(
        found, scale * improved(y) + shift, atol=1e-3 * scale + 1e-9 * abs(shift)
    )


def mean_snr(**options):
    f = signals.clean("sines")
    noisy = (f + signals.impulsive_noise(f, 0.5, seed) for seed in range(10, 30))
    return np.mean([signals.snr_db(f, improved(y, **options)) for y in noisy])


def test_figures_of_the_sines():
    assert mean_snr() == pytest.approx(17.2, abs=0.5)
    assert mean_snr(detail="zero") == pytest.approx(19.9, abs=0.5)
    assert mean_snr(degree=1) == pytest.approx(13.2, abs=0.5)


def test_a_significant_detail_is_kept():
    i = np.arange(512)
    ripple = np.where((i > 200) & (i < 300), 0.5 * (-1.0) ** i, 0.0)
    y = ripple + signals.white_noise(512, 0.05, 6)
    lost = signals.rmse(ripple, improved(y, 15, detail="zero"))
    kept = signals.rmse(ripple, improved(y, 15, detail="significant"))
    assert kept < 0.5 * lost
