"""Undecimated wavelets against brute force."""

import itertools

import numpy as np
import pytest
import pywt

from fpt_ros.denoising import signals
from fpt_ros.denoising.offline import undecimated


def trace_of_derivative(function, y, size=1e-6):
    total = 0.0
    for i in range(len(y)):
        moved = y.copy()
        moved[i] += size
        total += (function(moved)[i] - function(y)[i]) / size
    return total


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
