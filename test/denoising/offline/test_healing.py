"""Missing samples: periods, rehearsal, and what each filler does exactly."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fpt_ros.denoising import signals
from fpt_ros.denoising.offline import denoise, healing

N = 512
masks = arrays(bool, 60).filter(lambda present: present.sum() >= 4)


def random_mask(share, seed, n=N):
    return np.random.default_rng(seed).random(n) > share


def gaps(width, count, seed, n=N):
    present = np.ones(n, bool)
    for first in np.random.default_rng(seed).integers(0, n - width, count):
        present[first : first + width] = False
    return present


def error(filler, f, y, present):
    return np.sqrt(np.mean((filler(np.where(present, y, 0.0), present) - f)[~present] ** 2))


@settings(max_examples=25, deadline=None)
@given(masks)
def test_nearest_by_brute_force(present):
    y = np.random.default_rng(1).standard_normal(60)
    known = np.flatnonzero(present)
    brute = [y[known[np.argmin(np.abs(known - i))]] for i in range(60)]
    np.testing.assert_array_equal(healing.nearest(np.where(present, y, 0.0), present), brute)


@settings(max_examples=25, deadline=None)
@given(masks)
def test_present_samples_stay(present):
    y = np.random.default_rng(2).standard_normal(60)
    for name, filler in healing.fillers(y, present).items():
        np.testing.assert_array_equal(filler(y, present)[present], y[present], err_msg=name)


@settings(max_examples=25, deadline=None)
@given(masks, st.floats(-10, 10), st.floats(-10, 10))
def test_lines_are_healed_exactly_between_known_samples(present, slope, offset):
    line = slope * np.arange(60.0) + offset
    known = np.flatnonzero(present)
    inside = slice(known[0], known[-1] + 1)
    for filler in (healing.linear, healing.pchip):
        np.testing.assert_allclose(
            filler(np.where(present, line, 0.0), present)[inside], line[inside], atol=1e-8
        )
    spline = healing.whittaker(np.where(present, line, 0.0), present, 1.0)
    np.testing.assert_allclose(spline, line, atol=1e-5)


@pytest.mark.parametrize("length", [37, 64])
def test_period_is_found_through_gaps(length):
    i = np.arange(N)
    y = np.sin(2 * np.pi * i / length) + 0.5 * np.cos(4 * np.pi * i / length)
    lag, correlation = healing.period(y, gaps(20, 6, 3))
    assert lag == length
    assert correlation > 0.95


def test_noise_has_no_period():
    y = np.random.default_rng(4).standard_normal(N)
    present = random_mask(0.2, 5)
    _, correlation = healing.period(y, present)
    assert correlation < healing.ACCEPT
    filled = healing.periodic(np.where(present, y, 0.0), present)
    np.testing.assert_array_equal(filled, healing.nearest(np.where(present, y, 0.0), present))


def test_a_period_bridges_gaps_that_lines_cannot():
    i = np.arange(N)
    f = np.sin(2 * np.pi * i / 64) + 0.5 * np.sin(2 * np.pi * i / 32 + 1)
    y = f + 0.03 * np.random.default_rng(6).standard_normal(N)
    present = gaps(24, 5, 7)
    assert error(healing.periodic, f, y, present) < 0.05 < error(healing.linear, f, y, present)
    name, _ = healing.rehearse(np.where(present, y, 0.0), present)
    assert name == "periodic"


def test_the_rehearsal_is_safe_where_the_period_is_false():
    f = signals.clean("sines", N)
    y = f + 0.03 * np.random.default_rng(8).standard_normal(N)
    present = random_mask(0.1, 9)
    rehearsed = error(healing.heal, f, y, present)
    assert rehearsed < 0.03
    assert error(healing.periodic, f, y, present) > 5 * rehearsed


def test_the_trial_hides_known_samples_only():
    present = gaps(10, 3, 10)
    hidden = healing.trial(present, 17)
    assert not np.any(hidden & ~present)
    assert hidden.sum() > 0


def test_healed_samples_are_marked_and_denoised():
    f = signals.clean("sines")
    y = f + signals.white_noise(1024, 0.1, 11)
    missing = ~random_mask(0.1, 12, 1024)
    y[missing] = np.nan
    result = denoise(y)
    np.testing.assert_array_equal(result.healed, missing)
    assert signals.rmse(f[missing], result.estimate[missing]) < 0.05


def test_anytime_returns_what_is_present():
    y = np.array([1.0, np.nan, 3.0, 4.0, np.nan])
    result = denoise(y, "anytime")
    np.testing.assert_allclose(result.estimate, [1, 2, 3, 4, result.estimate[-1]])
    assert np.isfinite(result.estimate).all()
