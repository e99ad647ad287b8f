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
from fpt_ros.denoising.offline import mixture, potts, sinusoids, steps, undecimated, whittaker
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


def test_wiener_with_the_truth_as_pilot_beats_the_shrinkage():
    f = signals.clean("doppler")
    y = f + signals.white_noise(1024, 0.2, 6)
    first = undecimated.shrink(y, 0.2)[0]
    ideal = undecimated.wiener(y, 0.2, f, "sym8")[0]
    second = undecimated.wiener(y, 0.2, first, "db10")[0]
    assert signals.rmse(f, ideal) < signals.rmse(f, second) < signals.rmse(f, first)


# Whittaker


@pytest.mark.parametrize("order", [2, 3])
def test_whittaker_is_the_dense_solution(order):
    n, sigma = 60, 0.2
    z = np.sin(np.arange(n) / 6) + sigma * np.random.default_rng(7).standard_normal(n)
    D = np.diff(np.eye(n), order, axis=0)
    best = None
    for penalty in whittaker.GRID[order]:
        H = np.linalg.inv(np.eye(n) + penalty * D.T @ D)
        cp = np.sum((z - H @ z) ** 2) + 2 * sigma**2 * np.trace(H)
        if best is None or cp < best[0]:
            best = cp, H
    f, df = whittaker.smooth(z, sigma, order)
    np.testing.assert_allclose(f, best[1] @ z, atol=1e-6)
    assert df == pytest.approx(np.trace(best[1]) + 1, abs=1e-5)


@pytest.mark.parametrize("order", [2, 3])
def test_leverages_are_the_diagonal_of_the_hat_matrix(order):
    family = whittaker.smoothers(25, order)
    D = np.diff(np.eye(25), order, axis=0)
    for penalty, leverage in zip(whittaker.GRID[order], family.leverages, strict=True):
        if penalty < 1e4:
            H = np.linalg.inv(np.eye(25) + penalty * D.T @ D)
            np.testing.assert_allclose(leverage, np.diag(H), atol=1e-7)


@settings(max_examples=25, deadline=None)
@given(arrays(float, 3, elements=st.floats(-5, 5)))
def test_whittaker_passes_polynomials(c):
    t = np.linspace(-1, 1, 80)
    y = np.polyval(c, t)
    np.testing.assert_allclose(whittaker.smooth(y, 0.1, 3)[0], y, atol=1e-3)
    np.testing.assert_allclose(whittaker.smooth_locally(y, 0.1, 3)[0], y, atol=1e-3)


def test_a_local_penalty_follows_a_changing_frequency():
    f = signals.clean("doppler6")
    y = f + signals.white_noise(1024, 0.1, 8)
    one = whittaker.smooth(y, 0.1, 2)[0]
    assert signals.rmse(f, whittaker.smooth_locally(y, 0.1, 2)[0]) < 0.75 * signals.rmse(f, one)


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
    noise = mixture.Noise(0.1, 0.5, 2.0)
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
        density += 0.1 * np.exp(-0.5 * (r / wide) ** 2) / wide
        weight = prior * np.prod(np.where(present, density, 1.0), axis=1)
        return weight @ levels[paths] / weight.sum()

    mean, leverage = np.empty(n), np.empty(n)
    steps._posterior(y, present, levels, q, noise.p, noise.s, noise.t, mean, leverage)
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


def test_density_of_a_lone_residual():
    noise = mixture.Noise(0.05, 1.0, 4.0)
    r = np.array([0.0, 5.0, 0.0, -0.3, 0.0])
    wide = math.sqrt(17.0)
    density = 0.95 * np.exp(-(r**2) / 2) + 0.05 / wide * np.exp(-0.5 * (r / wide) ** 2)
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
    fit = mixture.fit(y, present, lambda z, s: whittaker.smooth(z, s, 2), begin)
    assert fit.noise.s == pytest.approx(0.1, rel=0.1)
    assert fit.noise.p == pytest.approx(0.04, rel=0.4)
    assert signals.rmse(f, fit.estimate) < 0.03


def test_hampel_takes_out_impulses_only():
    line = 0.5 * np.arange(40.0)
    y = line.copy()
    y[[5, 20, 33]] += [9, -9, 9]
    cleaned, outlier = hampel(y, 2, 0.1)
    np.testing.assert_array_equal(np.flatnonzero(outlier), [5, 20, 33])
    np.testing.assert_allclose(cleaned, line, atol=1.0)
