"""The way in, ``denoise``: its default method, properties, and bad input."""

import numpy as np
import pytest
import samples
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.denoising import signals
from fpt_ros.denoising.offline import DENOISERS, denoise, windows
from fpt_ros.errors import BadInput

MINE = (
    "anytime",
    "auto",
    "fuzzy",
    "heursure",
    "improved",
    "minimax",
    "sureshrink",
    "undecimated",
    "universal",
)


def noisy(name, seed=0, n=512, rho=0.5):
    f = signals.clean(name, n)
    return f, f + signals.impulsive_noise(f, rho, seed)


def test_all_are_registered():
    assert set(MINE) <= set(DENOISERS.names())


@pytest.mark.parametrize(
    ("name", "least"),
    [("sines", 22), ("doppler", 15), ("heavisine", 18), ("bumps", 9), ("blocks", 17)],
)
def test_auto_beats_the_methods_of_the_thesis(name, least):
    rivals = ("heursure", "minimax", "sureshrink", "improved")
    gains, others = [], {rival: [] for rival in rivals}
    for seed in range(100, 103 if samples.whole else 101):
        f, y = noisy(name, seed, 1024)
        gains.append(signals.snr_db(f, denoise(y).estimate))
        for rival in rivals:
            others[rival].append(signals.snr_db(f, denoise(y, rival).estimate))
    assert np.mean(gains) > least
    assert np.mean(gains) > max(np.mean(other) for other in others.values())


@pytest.mark.parametrize(
    ("name", "kind"), [("sines", "sinusoids"), ("blocks", "steps potts"), ("bumps", "general")]
)
def test_auto_recognises_the_kind(name, kind):
    f, y = noisy(name, 1, 1024)
    result = denoise(y)
    assert sum(result.info.get(member, 0) for member in kind.split()) > 0.9
    assert result.info["impulses"] == pytest.approx(0.03, abs=0.035)
    assert signals.snr_db(f, result.estimate) > signals.SNR_BEFORE


def test_impulses_on_a_line_vanish():
    line = 2.0 - 0.01 * np.arange(300)
    y = line + signals.white_noise(300, 0.01, 6)
    y[[20, 90, 91, 250]] += [3, -2, 4, -5]
    np.testing.assert_allclose(denoise(y).estimate, line, atol=0.01)


@pytest.mark.parametrize("method", MINE)
def test_constant_signals_stay(method):
    y = np.full(64, 3.7)
    y[10:13] = np.nan
    result = denoise(y, method)
    np.testing.assert_array_equal(result.estimate, 3.7)
    assert result.sigma == 0.0


@pytest.mark.parametrize("method", MINE)
def test_lines_stay(method):
    line = 1.0 + 0.5 * np.arange(400)
    inside = slice(130, -130) if method not in ("auto", "anytime") else slice(None)
    # symmetric extension bends a line at its ends, further inside with each level
    options = {"level": 3} if method == "sureshrink" else {}
    found = denoise(line, method, **options).estimate
    np.testing.assert_allclose(found[inside], line[inside], atol=1e-3)


@settings(max_examples=8, deadline=None)
@given(scale=st.sampled_from([1e-150, 3e-4, -1.0, 7.0, 1e150]), seed=st.integers(0, 5))
def test_auto_scales(scale, seed):
    _, y = noisy("doppler", seed, 256)
    expected = denoise(y).estimate
    np.testing.assert_allclose(denoise(scale * y).estimate / scale, expected, atol=2e-2)


@pytest.mark.parametrize("name", ["blocks", "doppler", "sines"])
def test_auto_shifts(name):
    _, y = noisy(name, 2, 256)
    y = np.round(y * 2**20) / 2**20  # so that adding a power of two rounds nothing
    expected = denoise(y + 2.0**5).estimate - 2.0**5
    np.testing.assert_allclose(denoise(y - 2.0**15).estimate + 2.0**15, expected, atol=1e-9)
    # near 0 sinusoids and oscillators may do without a constant, which is worth a little
    assert signals.rmse(expected, denoise(y).estimate) < 0.07


def test_white_noise_without_impulses():
    f = signals.clean("chirp")
    y = f + signals.white_noise(1024, 0.2, 3)
    result = denoise(y)
    assert signals.rmse(f, result.estimate) < 0.065
    assert result.sigma == pytest.approx(0.2, rel=0.1)


def test_long_records_go_in_windows(monkeypatch):
    f = signals.clean("sines", 1024)
    y = f + signals.white_noise(1024, 0.2, 4)
    monkeypatch.setattr(windows, "LONGEST", 600)
    monkeypatch.setattr(windows, "WINDOW", 400)
    monkeypatch.setattr(windows, "OVERLAP", 60)
    pieces = windows.pieces(1024)
    covered = np.zeros(1024)
    for a, b in pieces:
        covered[a:b] += 1
    assert covered.min() >= 1
    assert pieces[0][0] == 0
    assert pieces[-1][1] == 1024
    seen = []
    result = denoise(y, report=lambda done, total: seen.append((done, total)))
    assert result.info["pieces"] == len(pieces)
    assert [done for done, _ in seen] == [b for _, b in pieces]
    assert {total for _, total in seen} == {1024}
    assert signals.rmse(f, result.estimate) < 0.07
    assert result.noise.sigma == pytest.approx(0.2, rel=0.15)


@pytest.mark.parametrize("method", MINE)
@pytest.mark.parametrize("n", [16, 17, 40])
def test_short_records(method, n):
    y = np.sin(np.arange(n)) + signals.white_noise(n, 0.1, 5)
    assert np.isfinite(denoise(y, method).estimate).all()


@pytest.mark.parametrize(
    ("y", "words"),
    [
        ([], "empty"),
        ([np.nan] * 5, "all 5 samples"),
        ([1.0, np.inf, 2.0, -np.inf], "infinite at 2 samples, first at index 1"),
        (np.zeros((3, 4)), "one dimension"),
        (["a", "b"], "real numbers"),
        ([1j, 2.0], "real numbers"),
    ],
)
def test_bad_signals(y, words):
    with pytest.raises(BadInput, match=words) as caught:
        denoise(y)
    assert "\n" not in str(caught.value)


def test_too_short_says_how_many_are_needed():
    with pytest.raises(BadInput, match="auto needs at least 16 samples, the signal has 5"):
        denoise(np.arange(5.0))
    y = np.arange(20.0)
    y[3:9] = np.nan
    with pytest.raises(BadInput, match="has 14 beside 6 missing"):
        denoise(y)


def test_unknown_names_list_the_valid_ones():
    with pytest.raises(BadInput, match=r"'magic' is none of the denoisers: .*auto.*heursure"):
        denoise(np.arange(50.0), "magic")
    with pytest.raises(BadInput, match=r"'sym99' is not valid, it takes one of haar.*sym8"):
        denoise(np.arange(50.0), "heursure", wavelet="sym99")
    with pytest.raises(BadInput, match="heursure has no parameter 'depth': it has level"):
        denoise(np.arange(50.0), "heursure", depth=3)


def test_the_input_is_not_changed():
    y = np.arange(40.0)
    y[5] = np.nan
    before = y.copy()
    denoise(y)
    np.testing.assert_array_equal(y, before)


def test_snr_before_is_exact_and_names_are_checked():
    f, y = noisy("bumps", 7)
    assert signals.snr_db(f, y) == pytest.approx(2.2294, abs=1e-10)
    assert f.std() == pytest.approx(0.62521)
    with pytest.raises(BadInput, match="none of the test signals: sines"):
        signals.clean("sinus")


@pytest.mark.parametrize("seed", [1, 2, 4])
def test_impulses_are_told_from_the_samples_beside_jumps(seed):
    rng, n = np.random.default_rng(seed), 512
    saw = (7 * np.arange(n) / n + 0.1) % 1 - 0.5
    saw = saw / np.std(saw)
    impulse = rng.random(n) < 0.04
    y = saw + 0.18 * rng.standard_normal(n) + 2.5 * impulse * rng.choice([-1.0, 1.0], n)
    assert signals.snr_db(saw, denoise(y).estimate) - signals.snr_db(saw, y) > 12.0
