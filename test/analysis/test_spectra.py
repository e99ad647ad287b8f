"""Spectra against scipy's Welch, and against what noise is known to be."""

import numpy as np
import pytest
from scipy.signal import welch

from fpt_ros.analysis.spectra import SEGMENT, Spectra
from fpt_ros.runs.chunks import rows
from fpt_ros.runs.run import Series

DT = 1e-3
PARAMETERS = {"plant_simulator": {"dt": DT}, "denoiser": {"method": "savgol"}}


def topics_of(before, after):
    stamps = np.arange(len(before), dtype=np.int64) * 1_000_000
    return {
        "joint_states": Series(stamps, ("q",), {"position": before[:, None]}),
        "state_estimate": Series(stamps, ("q",), {"positions": after[:, None]}),
    }


def spectrum(topics, size=10**9, parameters=PARAMETERS):
    spectra = Spectra(parameters)
    for first in range(0, len(topics["joint_states"].stamps), size):
        spectra.take({name: rows(s, first, first + size) for name, s in topics.items()})
    return spectra.result()


@pytest.fixture(scope="module")
def noisy():
    rng = np.random.default_rng(1)
    time = np.arange(40_000) * DT
    clean = np.sin(2 * np.pi * 5.0 * time)
    return topics_of(clean + 0.01 * rng.standard_normal(len(time)), clean)


def test_they_are_those_of_scipy(noisy):
    found = spectrum(noisy)["q"]
    for one, topic, vector in (
        (found.before, "joint_states", "position"),
        (found.after, "state_estimate", "positions"),
    ):
        signal = noisy[topic].column(vector, "q")
        frequency, power = welch(signal, 1 / DT, "hann", SEGMENT, detrend="constant")
        assert found.frequency == pytest.approx(frequency[1:])
        assert one == pytest.approx(np.sqrt(power[1:]), rel=1e-9, abs=1e-15)


def test_white_noise_has_its_density(noisy):
    found = spectrum(noisy)["q"]
    high = found.frequency > 50.0
    density = np.sqrt(np.mean(found.before[high] ** 2))
    assert density == pytest.approx(0.01 * np.sqrt(2 * DT), rel=0.05)
    assert found.after[high].max() < 1e-3 * density  # what a Hann window leaks


def test_they_do_not_depend_on_the_chunks(noisy):
    whole, parts = spectrum(noisy)["q"], spectrum(noisy, 777)["q"]
    assert np.array_equal(whole.before, parts.before)
    assert np.array_equal(whole.after, parts.after)


def test_a_short_run_is_one_segment_and_a_gap_is_left_out():
    short = np.sin(np.arange(100.0))
    assert len(spectrum(topics_of(short, short))["q"].before) == 50
    assert spectrum(topics_of(short[:3], short[:3])) == {}
    gap = np.sin(np.arange(3.0 * SEGMENT))
    gap[100] = np.nan
    assert np.isfinite(spectrum(topics_of(gap, gap))["q"].before).all()
    gap[::1000] = np.nan
    assert spectrum(topics_of(gap, gap)) == {}


def test_without_a_denoiser_there_are_none(noisy):
    assert spectrum(noisy, parameters={**PARAMETERS, "denoiser": {"method": "none"}}) == {}
