"""Piecewise constant signals by brute force and enumeration."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fpt_ros.denoising import signals
from fpt_ros.denoising.offline import mixture, potts, steps


@settings(max_examples=30, deadline=None)
@given(arrays(float, 9, elements=st.integers(-20, 20).map(float)), st.floats(0.5, 40))
def test_pelt_by_brute_force(z, penalty):
    def cost(starts):
        parts = np.split(z, starts[1:])
        return sum(np.sum((part - part.mean()) ** 2) + penalty for part in parts)

    best = min(
        cost([0, *cut]) for size in range(9) for cut in itertools.combinations(range(1, 9), size)
    )
    assert cost(potts.partition(z, penalty)) == pytest.approx(best, abs=1e-7)


def test_viterbi_by_brute_force():
    rng = np.random.default_rng(9)
    levels = np.array([0.0, 1.0, 2.0])
    for _ in range(20):
        y = rng.uniform(-1, 3, 6)

        def cost(path, y=y):
            path = np.asarray(path)
            return np.sum(np.minimum((y - path) ** 2, 0.8)) + 0.7 * np.count_nonzero(np.diff(path))

        best = min(map(cost, itertools.product(levels, repeat=6)))
        assert cost(potts._viterbi(y, levels, 0.7, 0.8)) == pytest.approx(best)


def test_posterior_by_enumeration():
    rng = np.random.default_rng(10)
    levels, q, n = np.array([-1.0, 0.2, 1.5]), 0.15, 5
    noise = mixture.Noise(0.1, 0.5, 2.0, 1.2)
    y = rng.uniform(-2, 2, n)
    present = np.array([True, True, False, True, True])
    paths = np.array(list(itertools.product(range(3), repeat=n)))
    prior = np.full(len(paths), 1 / 3)
    for i in range(1, n):
        prior *= np.where(paths[:, i] == paths[:, i - 1], 1 - q, 0) + q / 3

    def posterior(y):
        r = y - levels[paths]
        wide = math.hypot(noise.s, noise.t)
        density = 0.9 * np.exp(-0.5 * (r / noise.s) ** 2) / noise.s
        for m in (noise.m, -noise.m):
            density += 0.05 * np.exp(-0.5 * ((r - m) / wide) ** 2) / wide
        weight = prior * np.prod(np.where(present, density, 1.0), axis=1)
        return weight @ levels[paths] / weight.sum()

    mean, leverage = np.empty(n), np.empty(n)
    steps._posterior(y, present, levels, q, noise.p, noise.s, noise.t, noise.m, mean, leverage)
    np.testing.assert_allclose(mean, posterior(y), atol=1e-12)


def test_steps_hedge_where_potts_must_choose():
    f = signals.clean("blocks")
    hedged, chosen = [], []
    for seed in range(6):
        y = f + signals.white_noise(1024, 0.4, seed)
        g, _ = potts.smooth(y, 0.4)
        jumps = np.count_nonzero(np.diff(g))
        noise = mixture.Noise(1e-3, 0.4, 1.2)
        h, _ = steps.smooth(y, np.ones(1024, bool), noise, jumps)
        hedged.append(np.mean((h - f) ** 2))
        chosen.append(np.mean((g - f) ** 2))
    assert np.mean(hedged) < np.mean(chosen)
