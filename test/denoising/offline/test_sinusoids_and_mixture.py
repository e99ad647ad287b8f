"""Tones that are found exactly, and the mixture of noise and impulses."""

import math

import numpy as np
import pytest

from fpt_ros.denoising import signals
from fpt_ros.denoising.offline import mixture, roughness, sinusoids
from fpt_ros.denoising.offline.noise import hampel


@pytest.mark.parametrize("frequencies", [(3.3,), (2.3, 5.1, 9.7), (4.0, 4.9, 200.4)])
def test_tones_are_found_exactly(frequencies):
    t = np.arange(1024) / 1024
    f = sum(np.sin(2 * np.pi * v * t + k) / (k + 1) for k, v in enumerate(frequencies))
    y = 0.7 + f + signals.white_noise(1024, 1e-3, 11)
    g, omega = sinusoids.fit(y, np.empty(0))
    np.testing.assert_allclose(np.sort(omega) * 1024 / (2 * np.pi), sorted(frequencies), atol=1e-3)
    np.testing.assert_allclose(g, 0.7 + f, atol=1e-3)


def test_noise_has_few_tones():
    counts = [
        len(sinusoids.fit(signals.white_noise(1024, 1.0, seed), np.empty(0))[1])
        for seed in range(20)
    ]
    assert sum(counts) <= 4


@pytest.mark.parametrize("m", [0.0, 3.0])
def test_density_of_a_lone_residual(m):
    noise = mixture.Noise(0.05, 1.0, 4.0, m)
    r = np.array([0.0, 5.0, 0.0, -0.3, 0.0])
    wide = math.sqrt(17.0)
    density = 0.95 * np.exp(-(r**2) / 2)
    for sign in (-1, 1):
        density += 0.025 / wide * np.exp(-0.5 * ((r - sign * m) / wide) ** 2)
    expected = np.sum(np.log(density / math.sqrt(2 * math.pi)))
    present = np.ones(5, bool)
    # neighbours of the impulse have residuals of no sign: nothing is coupled
    assert noise.log_likelihood(r, present) == pytest.approx(expected, abs=1e-6)
    inlier = 0.95 * np.exp(-(r**2) / 2) / density
    np.testing.assert_allclose(noise.inlier(r, present), inlier, atol=1e-9)


def test_a_burst_of_one_sign_is_rather_signal():
    noise = mixture.Noise(0.05, 1.0, 4.0)
    present = np.ones(5, bool)
    alone = noise.inlier(np.array([0.0, 0.0, 3.2, 0.0, 0.0]), present)[2]
    burst = noise.inlier(np.array([0.0, 3.2, 3.2, 3.2, 0.0]), present)[2]
    opposite = noise.inlier(np.array([0.0, -3.2, 3.2, -3.2, 0.0]), present)[2]
    assert burst > 2 * alone
    assert opposite == pytest.approx(alone)


def test_missing_samples_count_for_nothing():
    noise = mixture.Noise(0.05, 1.0, 4.0)
    present = np.array([True, False, True])
    assert noise.inlier(np.zeros(3), present)[1] == 0.0
    both = noise.log_likelihood(np.array([0.1, 99.0, 0.2]), present)
    assert both == noise.log_likelihood(np.array([0.1, 0.0, 0.2]), present)


def test_em_finds_the_mixture():
    f = signals.clean("sines", 2048)
    rng = np.random.default_rng(12)
    hit = rng.random(2048) < 0.04
    y = f + 0.1 * rng.standard_normal(2048) + hit * rng.standard_normal(2048)
    present = np.ones(2048, bool)
    begin = mixture.start(y, present)
    fit = mixture.fit(y, present, roughness.Roughness(3, 40.0).smooth, begin)
    assert fit.noise.s == pytest.approx(0.1, rel=0.1)
    assert fit.noise.p == pytest.approx(0.04, rel=0.4)
    assert signals.rmse(f, fit.estimate) < 0.03


def test_em_finds_the_size_of_the_impulses():
    f = signals.clean("sines", 2048)
    rng = np.random.default_rng(12)
    hit = rng.choice([-1.0, 1.0], 2048) * (rng.random(2048) < 0.04)
    y = f + 0.1 * rng.standard_normal(2048) + hit * rng.normal(1.5, 0.2, 2048)
    present = np.ones(2048, bool)
    begin = mixture.start(y, present)
    noise = mixture.fit(y, present, roughness.Roughness(3, 40.0).smooth, begin).noise
    assert noise.m == pytest.approx(1.5, rel=0.05)
    assert noise.t == pytest.approx(0.2, rel=0.3)
    assert noise.p == pytest.approx(0.04, rel=0.3)


def test_hampel_takes_out_impulses_only():
    line = 0.5 * np.arange(40.0)
    y = line.copy()
    y[[5, 20, 33]] += [9, -9, 9]
    cleaned, outlier = hampel(y, 2, 0.1)
    np.testing.assert_array_equal(np.flatnonzero(outlier), [5, 20, 33])
    np.testing.assert_allclose(cleaned, line, atol=1.0)
