"""Savitzky-Golay bank with local Stein risk: chapter 6 figures, other signals, impulses."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.denoising.offline.noise import third_difference_sigma
from fpt_ros.denoising.offline.savgol import smooth
from fpt_ros.denoising.offline.savgol_bank import bank, members, robust_bank
from fpt_ros.denoising.signals import CHAPTER6, clean, rmse, spiky_noise, white_noise

SEEDS = range(10, 14)


def mean_error(f, method, noise, seeds=SEEDS):
    return float(np.mean([rmse(f, method(f + noise(seed))) for seed in seeds]))


def white_bank(y):
    return bank(y, third_difference_sigma(y))


def other_signal(name):
    t = np.arange(1024) / 1024
    if name == "two speeds":
        return np.where(t < 0.6, np.sin(2 * np.pi * 2 * t), 0.7 * np.sin(2 * np.pi * 35 * t))
    return np.tanh(40 * (t - 0.3)) + np.exp(-(((t - 0.7) / 0.01) ** 2))


@pytest.mark.parametrize("name", [*CHAPTER6, "two speeds", "step and peak"])
@pytest.mark.parametrize("sigma", [0.05, 0.2])
def test_it_is_as_good_as_the_best_fixed_filter(name, sigma):
    """Which only who knows the signal can choose: better, or within 6 %."""
    f = clean(name) if name in CHAPTER6 else other_signal(name)

    def noise(seed):
        return white_noise(1024, sigma, seed)

    best = min(
        mean_error(f, lambda y, k=k, M=M: smooth(y, M, k), noise) for k, M in members(len(f))
    )
    assert mean_error(f, white_bank, noise) < 1.06 * best


@pytest.mark.parametrize("name", CHAPTER6)
def test_impulses_are_rejected(name):
    """Section 2.4: 0.036 to 0.061 with 2 % impulses of 1 to 3 units and sigma = 0.1, 20 seeds."""
    f = clean(name)

    def noise(seed):
        return spiky_noise(1024, 0.1, seed)

    assert mean_error(f, robust_bank, noise, range(10, 30)) <= 0.061
    assert mean_error(f, white_bank, noise) > 0.1


@settings(deadline=None, max_examples=6)
@given(st.floats(-100.0, 100.0), st.floats(0.01, 100.0))
def test_shift_and_scale(shift, scale):
    y = clean("twotone", 200) + white_noise(200, 0.1, 0)
    expected = shift + scale * robust_bank(y)
    assert robust_bank(shift + scale * y) == pytest.approx(expected, abs=1e-8 * (shift**2 + scale))


@pytest.mark.parametrize("n", [3, 4, 5, 8, 30])
def test_lines_remain_however_short(n):
    line = 3.0 - 0.5 * np.arange(n)
    assert bank(line, 0.1) == pytest.approx(line, abs=1e-12)
    assert robust_bank(line) == pytest.approx(line, abs=1e-12)
