"""What the supervisor of whole signals chooses."""

import numpy as np
import pytest

from fpt_ros.denoising import signals
from fpt_ros.denoising.offline import denoise, fuzzy


def test_noisier_signals_get_more_levels_and_wider_windows():
    f = signals.clean("sines")
    choices = []
    for sigma in (0.02, 0.6):
        y = f + signals.white_noise(1024, sigma, 1)
        choices.append(fuzzy.supervise(y, sigma))
    assert choices[0].level < choices[1].level
    assert choices[0].window < choices[1].window
    assert all(choice.window % 2 == 1 and 11 <= choice.window <= 121 for choice in choices)


def test_inputs_measure_what_they_say():
    f = signals.clean("sines")
    y = f + signals.white_noise(1024, 0.2, 2)
    assert fuzzy.snr(y, 0.2) == pytest.approx(10 * np.log10(f.var() / 0.04), abs=0.7)
    assert fuzzy.fine_share(y, 0.2) < 0.05
    fast = np.sin(np.pi * 0.8 * np.arange(1024)) + signals.white_noise(1024, 0.2, 2)
    assert fuzzy.fine_share(fast, 0.2) > 0.8
    noise = np.random.default_rng(3).standard_normal(1024)
    assert fuzzy.jumpiness(signals.clean("blocks")) > fuzzy.jumpiness(noise) + 0.1


def test_the_result_names_the_choice_and_denoises():
    f = signals.clean("sines")
    result = denoise(f + signals.impulsive_noise(f, 0.5, 3), "fuzzy")
    assert {"level", "rule", "wavelet", "window"} <= set(result.info)
    assert signals.snr_db(f, result.estimate) > 11
