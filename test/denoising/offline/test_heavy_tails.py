"""Noise whose tails fall slowly: what is gained over normal noise of the same power."""

import numpy as np
import pytest
from scipy import stats

from fpt_ros.denoising.offline import denoise, heavy_tails, mixture

WHOLE = np.ones(4000, dtype=bool)


def residuals(nu, scale=0.3, n=4000):
    return scale * np.random.default_rng(1).standard_t(nu, n)


def test_the_tail_is_found():
    found = heavy_tails.find(residuals(3.0), WHOLE, mixture.Noise(0.02, 0.35, 1.5))
    assert found.nu == 3.0
    assert found.scale == pytest.approx(0.3, rel=0.05)


def test_its_density_is_that_of_scipy():
    tail, r = heavy_tails.Tail(2.5, 0.4), residuals(3.0, n=50)
    present = np.arange(50) != 7
    expected = stats.t.logpdf(r[present], 2.5, scale=0.4).sum()
    assert tail.log_likelihood(r, present) == pytest.approx(expected)


@pytest.mark.parametrize("kind", ["normal", "impulses", "uniform"])
def test_other_noise_has_none(kind):
    rng = np.random.default_rng(2)
    r = {
        "normal": rng.standard_normal(4000),
        "impulses": rng.standard_normal(4000) + 8.0 * (rng.random(4000) < 0.03),
        "uniform": rng.uniform(-1.7, 1.7, 4000),
    }[kind]
    assert heavy_tails.find(r, WHOLE, mixture.Noise(0.03, 1.0, 2.0, 8.0)) is None


def test_a_residual_that_is_nothing_has_none():
    r = np.zeros(4000)
    r[::100] = 1.0
    assert heavy_tails.find(r, WHOLE, mixture.Noise(0.01, 1e-3, 1.0)) is None


def test_samples_as_normal_noise_would_have_made_them():
    # the Fisher information of Student's t of 3 degrees of freedom is 2 / 3 / scale^2
    r = residuals(3.0, 1.0, 100_000)
    z = heavy_tails.Tail(3.0, 1.0).normal(r, np.zeros(len(r)))
    assert np.var(z) == pytest.approx(1.5, rel=0.03)
    assert np.var(r) > 1.7 * np.var(z)
    # to first order the mean of z is that of the signal, wherever it is looked from
    near = heavy_tails.Tail(3.0, 1.0).normal(r, np.full(len(r), 0.1))
    assert abs(np.mean(near)) < 0.02


def test_a_smooth_signal_in_noise_of_heavy_tails():
    clean = np.sin(np.arange(512) / 40)
    gains = []
    for seed in range(4):
        r = np.random.default_rng(seed).standard_t(3.0, 512)
        r *= 0.3 / np.sqrt(np.mean(r**2))
        error = denoise(clean + r).estimate - clean
        gains.append(10 * np.log10(0.09 / np.mean(error**2)))
    assert np.mean(gains) > 24.1  # 23.7 without the second look
