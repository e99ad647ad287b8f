"""Mamdani inference against closed forms, and what the supervisor chooses."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.denoising import signals
from fpt_ros.denoising.offline import denoise, fuzzy
from fpt_ros.denoising.offline.mamdani import Rules, memberships

UNIT = (0.0, 0.5, 1.0)
ALL = "LL:{0} LM:{0} LH:{0} ML:{0} MM:{0} MH:{0} HL:{0} HM:{0} HH:{0}"


@pytest.mark.parametrize(("output", "centroid"), [("L", 1 / 6), ("M", 1 / 2), ("H", 5 / 6)])
def test_one_full_rule_gives_the_centroid_of_its_triangle(output, centroid):
    rules = Rules(UNIT, UNIT, ALL.format(output))
    assert rules.infer(0.0, 1.0) == pytest.approx(centroid, abs=1e-3)


def test_a_cut_triangle():
    # M cut at 1/2 is a trapezoid, symmetric; L cut at c has the centroid of a right trapezoid
    rules = Rules(UNIT, UNIT, ALL.format("L"))
    c = 0.5  # both inputs at 0.25: L and M at 1/2
    long, short = 0.5, 0.5 * (1 - c)
    centroid = (long**2 + long * short + short**2) / (3 * (long + short))
    assert rules.infer(0.25, 0.25) == pytest.approx(centroid, abs=1e-3)


def test_two_rules_overlap_by_their_maximum():
    rules = Rules(UNIT, UNIT, "LL:L ML:H LM:L MM:H")
    assert rules.infer(0.25, 0.25) == pytest.approx(0.5, abs=1e-3)  # L and H at 1/2: symmetric
    x = np.linspace(0, 1, 100001)
    one, two = 0.6, 0.4  # inputs 0.2: L at 0.6, M at 0.4
    shape = np.maximum(
        np.minimum(one, np.clip(1 - 2 * x, 0, 1)), np.minimum(two, np.clip(2 * x - 1, 0, 1))
    )
    assert rules.infer(0.2, 0.2) == pytest.approx(np.sum(x * shape) / np.sum(shape), abs=1e-3)


@settings(max_examples=25, deadline=None)
@given(st.floats(-100, 100))
def test_sets_add_up_to_one_and_inputs_are_clipped(value):
    degrees = memberships(value, (-5.0, 8.0, 20.0))
    assert sum(degrees.values()) == pytest.approx(1.0)
    assert degrees == memberships(min(max(value, -5.0), 20.0), (-5.0, 8.0, 20.0))


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
