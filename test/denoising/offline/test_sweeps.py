"""Sums of sweeps: found, told from noise and curves, and believed by ``auto`` where they are."""

import math

import numpy as np
import pytest

from fpt_ros.denoising.offline import denoise
from fpt_ros.denoising.offline.sweep_phase import strongest, turns
from fpt_ros.denoising.offline.sweeps import MOST, Sweeps, find
from fpt_ros.denoising.offline.whiteness import is_white

N = 512
NONE = np.empty((0, 3))


def sweep(first, at, last, n=N, begin=0.3):
    """A sinusoid whose frequency [1 / sample] is ``first``, ``at``, ``last`` at 0, n / 2, n."""
    s = np.linspace(-1.0, 1.0, n)
    slope, bend = 0.5 * (last - first), 0.5 * (first + last) - at
    turned = at * s + slope * s**2 / 2 + bend * s**3 / 3
    return np.sin(math.pi * (n - 1) * turned + begin)


def noise(seed, sigma=1.0, n=N):
    return sigma * np.random.default_rng(seed).standard_normal(n)


def gain(clean, y, estimate):
    return 10 * math.log10(np.mean((y - clean) ** 2) / np.mean((estimate - clean) ** 2))


def found(y, sigma):
    return find(y, NONE, MOST, np.ones(len(y)), sigma)


SIGNALS = {
    "a tone": [(0.1, 0.1, 0.1)],
    "up the whole band": [(0.0, 0.25, 0.5)],
    "down, and bent": [(0.4, 0.1, 0.05)],
    "beyond half the sampling rate": [(0.2, 0.45, 0.7)],
    "two that cross": [(0.05, 0.2, 0.35), (0.35, 0.2, 0.1)],
    "three, two of which begin alike": [(0.345,) * 3, (0.0, 0.0625, 0.125), (0.0, 0.125, 0.5)],
}


@pytest.mark.parametrize("parts", SIGNALS.values(), ids=SIGNALS)
@pytest.mark.parametrize("sigma", [0.1, 0.7])
def test_sweeps_are_found(parts, sigma):
    clean = sum(sweep(*part, begin=i) for i, part in enumerate(parts))
    y = clean + noise(1, sigma)
    estimate, phases = found(y, sigma)
    assert len(phases) == len(parts)
    # 1 + 5 numbers a sweep from n: the gain of least squares, half of it lost to chance at most
    assert gain(clean, y, estimate) > 10 * math.log10(N / (1 + 5 * len(parts))) - 3.0


def test_there_are_none_in_noise():
    assert not any(len(found(noise(seed), 1.0)[1]) for seed in range(60))


def test_a_curve_is_no_sweep():
    s = np.linspace(-1.0, 1.0, N)
    y = 3.0 * s**2 + np.exp(-((5 * s) ** 2)) + noise(2, 0.1)
    assert turns(strongest(y - y.mean())) < 3.0
    assert len(found(y, 0.1)[1]) == 0


def test_what_is_no_sum_of_few_sweeps_is_given_up():
    core = Sweeps()
    y = np.cumsum(noise(3)) * np.sin(0.9 * np.arange(N))
    estimate, df = core.smooth(y, 0.05)
    assert df == 1.0
    assert np.ptp(estimate) == 0.0


def test_sweeps_on_a_curve():
    s = np.linspace(-1.0, 1.0, N)
    clean = sweep(0.05, 0.2, 0.3) + 2.0 * np.exp(-((8 * (s - 0.2)) ** 2)) + s
    y = clean + noise(4, 0.2)
    assert gain(clean, y, denoise(y).estimate) > 8.0


@pytest.mark.parametrize(
    "spoil",
    [
        lambda r, n: 0.3 * r.standard_normal(n),
        lambda r, n: 0.1 * r.standard_t(3, n),
        lambda r, n: 0.1 * r.standard_normal(n) + 3.0 * (r.random(n) < 0.04),
        lambda r, n: np.where(np.arange(n) < n // 2, 0.05, 0.5) * r.standard_normal(n),
    ],
    ids=["white", "heavy tails", "impulses", "a level that varies"],
)
def test_auto_takes_them(spoil):
    clean = sweep(0.02, 0.26, 0.48)
    y = clean + spoil(np.random.default_rng(5), N)
    assert gain(clean, y, denoise(y).estimate) > 12.0


def test_the_noise_is_told_that_sweeps_had_hidden():
    parts = SIGNALS["three, two of which begin alike"]
    clean = sum(sweep(*part, begin=i) for i, part in enumerate(parts))
    result = denoise(clean + noise(10, 0.05))
    assert result.sigma == pytest.approx(0.05, rel=0.25)
    assert result.noise.impulses < 0.05


def test_it_says_so():
    y = sweep(0.02, 0.26, 0.48) + noise(9, 0.3)
    assert denoise(y).weights["sweeps"] > 0.9


def test_auto_does_not_take_one_of_many_for_all():
    # narrow bumps, which pass for impulses, and more than it finds
    t = np.arange(N) / N
    bumps = sum(h / (1 + np.abs((t - at) / 0.008)) ** 4 for at, h in ((0.2, 4), (0.4, 5), (0.7, 4)))
    clean = bumps + np.sin(math.pi * N / 2 * t**3) + np.sin(math.pi * N * t**2) + np.sin(500 * t)
    for seed in range(4):
        y = clean + noise(seed, 0.1)
        assert gain(clean, y, denoise(y).estimate) > -1.0


def test_white_noise_is_white_whatever_its_tails():
    r = np.random.default_rng(6)
    everywhere = np.ones(N, dtype=bool)
    drawn = [(r.standard_normal(N), r.laplace(size=N), r.standard_t(3, N)) for _ in range(40)]
    white = [x / np.std(x) for three in drawn for x in three]
    assert np.mean([is_white(x, everywhere) for x in white]) > 0.95
    assert not is_white(sweep(0.0, 0.25, 0.5) + 0.3 * noise(7), everywhere)
    coloured = noise(8)
    coloured[1:] += 0.7 * coloured[:-1]
    gap = everywhere.copy()
    gap[100:400] = False
    assert np.mean([is_white(np.where(gap, x, 0.0), gap) for x in white]) > 0.95
    assert not is_white(coloured, everywhere)
