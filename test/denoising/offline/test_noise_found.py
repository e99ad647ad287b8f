"""What the noise is: its level, how it varies, the step of rounding."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.denoising import signals
from fpt_ros.denoising.offline import denoise, ebayes, quantisation, spectral_floor, undecimated
from fpt_ros.denoising.offline.noise import noise_sigma
from fpt_ros.denoising.signals import rmse, snr_db

ALL = np.ones(1024, bool)


def test_level_of_white_noise_is_the_wavelets():
    y = signals.white_noise(1024, 0.3, 1)
    assert spectral_floor.level(y) == noise_sigma(y) == pytest.approx(0.3, rel=0.08)


@pytest.mark.parametrize("period", [2.9, 4.0, 7.3])
def test_a_fast_tone_is_no_noise(period):
    y = np.sin(2 * np.pi * np.arange(1024) / period) + signals.white_noise(1024, 0.1, 2)
    assert noise_sigma(y) > 0.2
    assert spectral_floor.level(y) == pytest.approx(0.1, rel=0.25)


def test_profile_follows_the_noise():
    size = np.where(np.arange(1024) // 256 % 2, 0.5, 0.05)
    f = np.sin(2 * np.pi * 3 * np.arange(1024) / 1024)
    found = spectral_floor.profile(f + signals.white_noise(1024, 1.0, 3) * size, ALL)
    ratio = found / size / np.exp(np.mean(np.log(found / size)))
    away = np.abs(np.arange(1024)[:, None] - [256, 512, 768]).min(axis=1) > 60
    assert np.abs(np.log(ratio[away])).max() < np.log(2.2)


def test_one_level_has_no_profile():
    for seed in range(5):
        y = signals.clean("heavisine") + signals.white_noise(1024, 0.1, seed)
        np.testing.assert_array_equal(spectral_floor.profile(y, ALL), 1.0)


@settings(max_examples=40, deadline=None)
@given(st.floats(1e-6, 1e6), st.integers(-1000, 1000), st.integers(0, 100))
def test_the_step_of_rounding_is_found(step, offset, seed):
    y = np.random.default_rng(seed).standard_normal(400)
    rounded = step * (np.round(20 * y) + offset)
    assert quantisation.least_step(rounded, np.ones(400, bool)) == pytest.approx(step, rel=1e-6)


def test_what_is_not_rounded_has_no_step():
    for seed in range(20):
        y = np.random.default_rng(seed).standard_normal(300)
        assert quantisation.least_step(y, np.ones(300, bool)) == 0.0
    assert quantisation.least_step(np.array([0.0, 1.0] * 20), np.ones(40, bool)) == 0.0


def test_ebayes_shrinks_noise_and_keeps_what_is_far():
    b = ebayes.beta(np.linspace(-12, 12, 101))
    np.testing.assert_allclose(b, b[::-1])
    x = np.linspace(-12, 12, 101)
    found = ebayes.median(x, 0.05, b)
    assert np.all(np.abs(found) <= np.abs(x))
    assert found[50] == 0.0
    assert found[-1] == pytest.approx(12 - ebayes.A, abs=0.01)
    noise, _ = ebayes.shrink(signals.white_noise(1024, 1.0, 5), 1.0)
    assert np.mean(noise**2) < 0.05


def test_ebayes_is_among_the_best_shrinkages():
    f = signals.clean("blocks")
    y = f + signals.white_noise(1024, 0.2, 6)
    haar = rmse(f, ebayes.shrink(y, 0.2, "haar")[0])
    assert haar < rmse(f, undecimated.shrink(y, 0.2, "sym8")[0])


# the cases of issue 13


def test_noise_that_alternates_by_quarters():
    t = np.arange(1024) / 1024
    f = np.sin(2 * np.pi * 3 * t)
    size = np.where(np.arange(1024) // 256 % 2, 0.5, 0.05)
    y = f + size * signals.white_noise(1024, 1.0, 7)
    found = denoise(y)
    gain = snr_db(f, found.estimate) - snr_db(f, y)
    assert gain > 20.0
    assert found.noise.most / found.noise.least > 4.0


def test_a_rounded_sine_is_smoothed_and_its_step_told():
    f = np.sin(2 * np.pi * 3 * np.arange(1024) / 1024)
    step = 2.0 / 24
    y = step * np.round(f / step)
    found = denoise(y)
    assert found.noise.step == pytest.approx(step)
    assert snr_db(f, found.estimate) - snr_db(f, y) > 10.0


def test_a_record_that_nothing_explains_stays():
    y = np.random.default_rng(8).standard_normal(400).cumsum()
    y = np.where(np.arange(400) % 2, y, -y)
    found = denoise(y)
    assert np.sqrt(np.mean((found.estimate - y) ** 2)) < 0.3 * np.std(y)


def test_pywavelets_866():
    """A threshold of 0 on exact zeros is 0, not NaN."""
    step = np.repeat([0.0, 1.0], 64)
    assert np.isfinite(denoise(step, "soft_universal").estimate).all()
