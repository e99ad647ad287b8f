"""Splines and oscillators against dense solutions."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fpt_ros.denoising import signals
from fpt_ros.denoising.offline import banded, roughness, undecimated


def differences(n, order, c=None):
    """L of the splines and, with c, of the oscillators."""
    D = np.diff(np.eye(n), order, axis=0)
    if c is None:
        return D
    return D[:-2] - c[:, None] * D[1:-1] + D[2:]


@pytest.mark.parametrize(("order", "pitch"), [(2, None), (4, None), (0, 5.0), (1, 5.0)])
def test_banded_least_squares_is_the_dense_one(order, pitch):
    n, rng = 30, np.random.default_rng(7)
    core = roughness.Roughness(order, 5.0, pitch)
    size = n - order - (0 if pitch is None else 2)
    core.ratio, core.c = rng.uniform(0.1, 9, size), rng.uniform(-2, 2, size)
    L = differences(n, order, None if pitch is None else core.c)
    z = rng.standard_normal(n)
    inverse = np.linalg.inv(np.eye(n) + L.T @ np.diag(1 / core.ratio) @ L)
    f, rough, doubt, trace = banded.solve(z, 1 / core.ratio, core._rows())
    np.testing.assert_allclose(f, inverse @ z, atol=1e-9)
    np.testing.assert_allclose(np.abs(rough), np.abs(L @ inverse @ z), atol=1e-9)
    np.testing.assert_allclose(doubt, np.diag(L @ inverse @ L.T), atol=1e-9)
    assert trace == pytest.approx(np.trace(inverse))


def test_variances_maximise_the_marginal_likelihood():
    n, sigma = 80, 0.2
    z = np.sin(np.arange(n) / 6) + sigma * np.random.default_rng(7).standard_normal(n)
    core = roughness.Roughness(2, 1e3)  # one window over everything
    for _ in range(200):
        core.smooth(z, sigma)
    D = differences(n, 2)

    def likelihood(ratio):  # of D z, which is what does not depend on the lines D passes
        covariance = ratio * np.eye(n - 2) + D @ D.T
        r = D @ z / sigma
        return -np.linalg.slogdet(covariance)[1] - r @ np.linalg.solve(covariance, r)

    found = core.ratio.mean()
    np.testing.assert_allclose(core.ratio, found, rtol=0.02)
    assert likelihood(found) > max(likelihood(0.8 * found), likelihood(1.25 * found))


@settings(max_examples=25, deadline=None)
@given(arrays(float, 3, elements=st.floats(-5, 5)))
def test_splines_pass_polynomials(c):
    y = np.polyval(c, np.linspace(-1, 1, 80))
    np.testing.assert_allclose(roughness.Roughness(3, 10.0).smooth(y, 0.1)[0], y, atol=1e-3)


@pytest.mark.parametrize(("name", "order"), [("doppler6", 0), ("chirp", 0), ("chirp", 1)])
def test_oscillators_follow_a_changing_frequency(name, order):
    f = signals.clean(name)
    y = f + signals.white_noise(1024, 0.2, 8)
    core = roughness.Roughness(order, 10.0, 10.0)
    for _ in range(4):
        found, _ = core.smooth(y, 0.2)
    assert signals.rmse(f, found) < 0.9 * signals.rmse(f, undecimated.shrink(y, 0.2)[0])


def test_a_narrow_window_keeps_lines():
    f = signals.clean("spectro")
    y = f + signals.white_noise(1024, 0.2, 8)
    narrow, wide = (roughness.Roughness(3, width).smooth(y, 0.2)[0] for width in (5.0, 1e3))
    assert signals.rmse(f, narrow) < 0.9 * signals.rmse(f, wide)


def test_degrees_of_freedom_agree_with_the_loss():
    """df = sum covariance(found, y) / sigma^2: what the risk is estimated with."""
    f, sigma = signals.clean("spectro"), 0.2
    counted, true = [], []
    for seed in range(20):
        y = f + signals.white_noise(1024, sigma, seed)
        core = roughness.Roughness(3, 5.0)
        for _ in range(4):
            found, df = core.smooth(y, sigma)
        counted.append(df)
        true.append(np.sum((found - f) * (y - f)) / sigma**2)
    assert np.mean(counted) == pytest.approx(np.mean(true), rel=0.15)


def test_without_noise_nothing_is_smoothed():
    y = np.random.default_rng(9).standard_normal(50)
    assert roughness.Roughness(2, 3.0).smooth(y, 0.0) == (pytest.approx(y), 50.0)
