"""Each smoother of ``auto`` against brute force or a dense solution."""

import itertools
import math

import numpy as np
import pytest
import pywt
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fpt_ros.denoising import signals
from fpt_ros.denoising.offline import (
    banded,
    mixture,
    potts,
    roughness,
    sinusoids,
    steps,
    undecimated,
)
from fpt_ros.denoising.offline.noise import hampel


def trace_of_derivative(function, y, size=1e-6):
    total = 0.0
    for i in range(len(y)):
        moved = y.copy()
        moved[i] += size
        total += (function(moved)[i] - function(y)[i]) / size
    return total


# undecimated wavelets


@pytest.mark.parametrize("wavelet", ["haar", "sym8", "db10"])
@pytest.mark.parametrize("n", [16, 100, 1023])
def test_undecimated_reconstruction(wavelet, n):
    y = np.random.default_rng(1).standard_normal(n)
    bank = undecimated.bank(wavelet, n)
    np.testing.assert_allclose(bank.synthesise(bank.analyse(y)), y, atol=1e-9)


def test_undecimated_is_the_mean_over_all_shifts():
    n, level = 32, 2
    y = np.random.default_rng(2).standard_normal(n)
    doubled = np.concatenate((y, y[::-1]))
    mean = np.zeros(2 * n)
    for shift in range(4):
        bands = pywt.wavedec(np.roll(doubled, shift), "db2", mode="periodization", level=level)
        kept = [bands[0], bands[1], np.zeros_like(bands[2])]
        mean += np.roll(pywt.waverec(kept, "db2", mode="periodization"), -shift) / 4
    bank = undecimated.bank("db2", n, level)
    bands = bank.analyse(y)
    bands[0] = 0.0
    np.testing.assert_allclose(
        bank.synthesise(bands), (mean[:n] + mean[: -n - 1 : -1]) / 2, atol=1e-9
    )


def test_shrinkage_minimises_the_risk_of_its_level():
    rng = np.random.default_rng(3)
    x = rng.standard_normal(512) + np.where(np.arange(512) % 64 < 12, 3.0, 0.0)
    lambdas = np.array([[undecimated.threshold(h, 256, c) for c in undecimated.FACTORS]
                        for h in undecimated.HALVES])  # fmt: skip
    risks = {}
    for (a, h), (b, _) in itertools.product(
        enumerate(undecimated.HALVES), enumerate(undecimated.FACTORS)
    ):
        energy = sum(np.roll(x, 2 * m) ** 2 for m in range(-h, h + 1))
        q = np.minimum(lambdas[a, b] / energy, 1.0)
        slope = np.where(q < 1, -q + 2 * q * x**2 / energy, -1.0)
        risks[a, b] = float(np.mean((q * x) ** 2 + 2 * slope)) + 1.0
    shrunk = x.copy()
    _, risk, a, b = undecimated._shrink_band(shrunk, 2, np.array(undecimated.HALVES), lambdas, 1.0)
    assert (a, b) == min(risks, key=risks.get)
    assert risk == pytest.approx(risks[a, b])
    energy = sum(
        np.roll(x, 2 * m) ** 2 for m in range(-undecimated.HALVES[a], undecimated.HALVES[a] + 1)
    )
    np.testing.assert_allclose(shrunk, x * np.maximum(1 - lambdas[a, b] / energy, 0), atol=1e-12)


def test_degrees_of_freedom_of_the_shrinkage():
    y = signals.clean("doppler", 128) + signals.white_noise(128, 0.1, 4)
    _, df = undecimated.shrink(y, 0.1, "sym8")
    trace = trace_of_derivative(lambda z: undecimated.shrink(z, 0.1, "sym8")[0], y)
    assert df == pytest.approx(trace, rel=0.25)  # terms of neighbouring shifts are left out


def test_shrinkage_of_pure_noise_leaves_little():
    y = signals.white_noise(1024, 1.0, 5)
    assert np.mean(undecimated.shrink(y, 1.0)[0] ** 2) < 0.05


# roughness


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
    weight = rng.uniform(0.2, 3, n)
    inverse = np.linalg.inv(np.diag(weight) + L.T @ np.diag(1 / core.ratio) @ L)
    f, rough, doubt, trace = banded.solve(z, 1 / core.ratio, core._rows(), weight)
    np.testing.assert_allclose(f, inverse @ (weight * z), atol=1e-9)
    np.testing.assert_allclose(np.abs(rough), np.abs(L @ inverse @ (weight * z)), atol=1e-9)
    np.testing.assert_allclose(doubt, np.diag(L @ inverse @ L.T), atol=1e-9)
    assert trace == pytest.approx(np.trace(inverse * weight))


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


# piecewise constant


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
    sigma = np.full(n, noise.s)
    steps._posterior(y, present, levels, q, noise.p, sigma, noise.t, noise.m, mean, leverage)
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


# sinusoids


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


# EM


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
