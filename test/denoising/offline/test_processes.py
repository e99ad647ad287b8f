"""Gaussian processes: Kalman recursion against dense algebra, and what evidence finds."""

import math

import numpy as np
import pytest

from fpt_ros.denoising.offline import (
    colour,
    components,
    gaussian_process,
    kalman,
    mixture,
    process_member,
)

PARTS = np.array(
    [
        [components.DECAY, 0.5, 3.0, 0.0],
        [components.MATERN3, 1.0, 5.0, 0.0],
        [components.MATERN5, 1.2, 9.0, 0.0],
        [components.OSCILLATOR, 0.7, 8.0, 3.0],
    ]
)


def covariance(part, D):
    """The kernel as textbooks print it."""
    kind, size, scale, quality = part
    if kind == components.DECAY:
        k = np.exp(-D / scale)
    elif kind == components.MATERN3:
        a = math.sqrt(3) * D / scale
        k = (1 + a) * np.exp(-a)
    elif kind == components.MATERN5:
        a = math.sqrt(5) * D / scale
        k = (1 + a + a * a / 3) * np.exp(-a)
    else:
        w, eta = 2 * math.pi / scale, math.sqrt(1 - 1 / (4 * quality**2))
        ring = np.cos(eta * w * D) + np.sin(eta * w * D) / (2 * eta * quality)
        k = np.exp(-w * D / (2 * quality)) * ring
    return size**2 * k


@pytest.mark.parametrize("even", [True, False])
@pytest.mark.parametrize("own", [[1, 1, 1, 1], [0, 1, 1, 1]])
def test_filter_and_smoother_are_the_dense_regression(even, own):
    rng, n = np.random.default_rng(1), 60
    dt = np.ones(n) if even else rng.uniform(0.5, 2, n)
    t = np.cumsum(dt)
    D = np.abs(t[:, None] - t)
    kernels = [covariance(part, D) for part in PARTS]
    signal = sum(k for k, mine in zip(kernels, own, strict=True) if mine)
    variance = np.full(n, 0.4) if even else rng.uniform(0.1, 1, n)
    variance[[7, 8, 30]] = kalman.UNKNOWN
    seen = variance < kalman.UNKNOWN
    y = 2 * rng.standard_normal(n)
    C = (sum(kernels) + np.diag(variance))[np.ix_(seen, seen)]
    square, logs = kalman.likelihood(y, variance, dt, PARTS)
    assert square == pytest.approx(y[seen] @ np.linalg.solve(C, y[seen]), rel=1e-6)
    assert logs == pytest.approx(np.linalg.slogdet(C)[1], rel=1e-6)
    mean, spread, leverage = kalman.smooth(y, variance, dt, PARTS, np.array(own, float))
    first = [k for k, mine in zip((0, 1, 3, 6), own, strict=True) if mine]
    hat = signal[:, seen] @ np.linalg.inv(C)
    np.testing.assert_allclose(mean[:, first].sum(axis=1), hat @ y[seen], atol=1e-9)
    np.testing.assert_allclose(spread, np.diag(signal - hat @ signal[seen]), atol=1e-9)
    np.testing.assert_allclose(leverage[seen], np.diag(hat[seen]), atol=1e-9)


def test_curvature_is_the_derivative_of_the_kernel():
    """The states of Matern 5/2 are value, slope, curvature."""
    rng, n = np.random.default_rng(2), 400
    dt = np.full(n, 0.05)
    t = np.cumsum(dt)
    parts = np.array([[components.MATERN5, 1.0, 4.0, 0.0]])
    y = np.sin(t) + 0.01 * rng.standard_normal(n)
    mean, _, _ = kalman.smooth(y, np.full(n, 1e-4), dt, parts, np.ones(1))
    inside = slice(40, -40)
    np.testing.assert_allclose(np.gradient(mean[:, 0], t)[inside], mean[inside, 1], atol=1e-3)
    np.testing.assert_allclose(mean[inside, 1], np.cos(t)[inside], atol=0.05)
    np.testing.assert_allclose(mean[inside, 2], -np.sin(t)[inside], atol=0.25)


def samples(y, s=1e-6):
    n = len(y)
    return gaussian_process.Samples(y - y.mean(), np.ones(n), np.ones(n), s)


@pytest.mark.parametrize("scale", [1.0, 1e-6, -3e5])
def test_the_fit_scales_with_the_record(scale):
    rng = np.random.default_rng(3)
    y = np.sin(np.arange(300) / 15) + 0.3 * rng.standard_normal(300)
    one = gaussian_process.fit(samples(y), "smooth")
    other = gaussian_process.fit(samples(scale * y, abs(scale) * 1e-6), "smooth")
    assert other.s == pytest.approx(abs(scale) * one.s, rel=1e-3)
    assert one.s == pytest.approx(0.3, rel=0.1)
    np.testing.assert_allclose(other.parts, one.parts, rtol=1e-2)


def test_search_ends_where_the_evidence_is_flat():
    rng = np.random.default_rng(4)
    y = np.sin(np.arange(300) / 15) + 0.3 * rng.standard_normal(300)
    found = gaussian_process.fit(samples(y), "smooth")
    for k in range(len(found.x)):
        for move in (-0.2, 0.2):
            x = found.x.copy()
            x[k] += move
            parts = found.parts.copy()
            parts[0, 1:3] = np.exp(x)
            moved = gaussian_process.scaled(
                samples(y), gaussian_process.Process("smooth", parts, 1.0, 0.0, False, x)
            )
            assert moved.bic > found.bic - 0.05


@pytest.mark.parametrize("c", [0.5, 0.8])
def test_coloured_noise_is_told_from_a_smooth_signal(c):
    rng, n = np.random.default_rng(5), 800
    f = np.sin(2 * np.pi * np.arange(n) / 200) + 0.5 * np.sin(2 * np.pi * np.arange(n) / 90)
    e = np.zeros(n)
    for i in range(1, n):
        e[i] = c * e[i - 1] + 0.12 * rng.standard_normal()
    y, present = f + e, np.ones(n, bool)
    found = process_member.smooth(y, present, mixture.start(y, present), np.ones(n))
    assert found.colour is not None
    assert found.colour.coefficient == pytest.approx(c, abs=0.15)
    assert np.mean((found.fit.estimate - f) ** 2) < 0.5 * np.mean(e**2)


def smooth_motion_in_strong_colour(seed):
    """A smooth signal of variance 1, and AR(1) noise of 0.9 at 10 dB."""
    rng, n = np.random.default_rng(seed), 512
    t = np.arange(n) / n
    f = np.cos(2 * np.pi * 1.5 * t) + 0.5 * np.sin(2 * np.pi * 4 * t)
    noise = rng.standard_normal(n + 200)
    for i in range(1, len(noise)):
        noise[i] += 0.9 * noise[i - 1]
    noise = noise[200:]
    return f, f + noise * (0.316 * np.std(f) / np.std(noise))


def test_a_walk_on_a_smooth_signal_is_noise_of_some_probability():
    trusts = []
    for seed in range(12):
        f, y = smooth_motion_in_strong_colour(seed)
        present = np.ones(len(y), bool)
        found = process_member.smooth(y, present, mixture.start(y, present), np.ones(len(y)))
        if found.whole is not None:
            trusts.append(found.colour.trust)
            # if the walk is signal there is nothing to take away
            assert np.mean((found.whole - y) ** 2) < 0.1 * np.mean((y - f) ** 2)
            mean = found.whole + trusts[-1] * (found.fit.estimate - found.whole)
            assert np.mean((mean - f) ** 2) < np.mean((y - f) ** 2)
    assert trusts
    assert all(colour.LIKELY <= trust <= 1.0 for trust in trusts)


@pytest.mark.parametrize("sigma", [1e-3, 0.03])
def test_jumps_without_white_noise_are_no_colour(sigma):
    rng, n = np.random.default_rng(8), 512
    y = np.repeat(rng.standard_normal(16), 32) + sigma * rng.standard_normal(n)
    present = np.ones(n, bool)
    found = process_member.smooth(y, present, mixture.start(y, present), np.ones(n))
    assert found.colour is None


def test_white_noise_has_no_colour():
    rng, n = np.random.default_rng(6), 500
    y = np.sin(np.arange(n) / 20) + 0.3 * rng.standard_normal(n)
    present = np.ones(n, bool)
    found = process_member.smooth(y, present, mixture.start(y, present), np.ones(n))
    assert found.colour is None
    assert found.fit.noise.s == pytest.approx(0.3, rel=0.1)


def test_impulses_do_not_pull_the_process():
    rng, n = np.random.default_rng(7), 400
    f = np.sin(np.arange(n) / 20)
    y = f + 0.1 * rng.standard_normal(n)
    y[rng.integers(0, n, 12)] += 3.0
    present = np.ones(n, bool)
    found = process_member.smooth(y, present, mixture.start(y, present), np.ones(n))
    assert np.sqrt(np.mean((found.fit.estimate - f) ** 2)) < 0.05
