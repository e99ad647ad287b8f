"""Adaptive multi-round smoothing: relation, rules, parts, and figures of section 2.4."""

import math

import numpy as np
import pytest

from fpt_ros.denoising.offline.adaptive_savgol import (
    ADAPTIVE_SAVGOL,
    adaptive,
    admissible,
    divide,
    extrema,
    relation,
    rule,
    runs,
    smooth_parts,
)
from fpt_ros.denoising.offline.savgol import smooth
from fpt_ros.denoising.signals import CHAPTER6, clean, rmse, white_noise
from fpt_ros.parameters import resolve


def mean_error(name, sigma, method, seeds=range(10, 14)):
    f = clean(name)
    return np.mean([rmse(f, method(f + white_noise(1024, sigma, seed))) for seed in seeds])


def test_the_relation_of_ratios():
    found = [relation(ratio * 17.0, 17.0) for ratio in (1, 2, 3, 4)]
    assert found == pytest.approx([0.12, 0.5, 0.88, 0.98], abs=5e-3)


def test_the_printed_relation_leaves_only_the_first_rule():
    assert relation(20.0, 20.0, literal=True) == 0.5
    assert relation(22.2, 20.0, literal=True) > 0.9
    assert relation(2000.0, 20.0, literal=True) == 1.0
    assert rule(1.0, 20.0, 100) == (5, pytest.approx(6.0))


@pytest.mark.parametrize(
    ("g", "expected"),
    [
        *((0.95, (5, 6.0)), (0.895, (4, 10.0)), (0.8, (4, 10.0)), (0.5, (3, 20.0))),
        *((0.445, (2, 50.0)), (0.3, (2, 50.0)), (0.2, (1, 80.0)), (0.0, (1, 80.0))),
    ],
)
def test_rules_without_gaps(g, expected):
    assert rule(g, 20.0, 100) == (expected[0], pytest.approx(expected[1]))


@pytest.mark.parametrize(
    ("window", "degree", "expected"),
    [(4.0, 5, 7), (4.0, 4, 7), (4.0, 3, 5), (4.0, 2, 5), (2.0, 1, 3), (9.5, 3, 11), (9.4, 3, 9)],
)
def test_windows_are_odd_and_smooth(window, degree, expected):
    assert admissible(window, degree, 1000) == expected


@pytest.mark.parametrize(("n", "expected"), [(50, 49), (51, 51)])
def test_windows_are_no_longer_than_the_record(n, expected):
    assert admissible(400.0, 3, n) == expected


def test_parts_are_runs_of_similar_sections():
    lengths = np.array([10, 14, 12, 30, 40, 35, 9, 10])
    assert runs(lengths) == [(0, 3), (3, 6), (6, 8)]


def test_extrema_have_to_stand_out():
    t = np.arange(1000) + 0.3  # off the symmetry: no two neighbours are equal
    y = np.sin(2 * np.pi * t / 250) + 0.01 * np.sin(2 * np.pi * t / 10)
    turns = np.flatnonzero(np.diff(np.sign(np.diff(y)))) + 1
    assert extrema(y).tolist() == turns.tolist()
    assert len(turns) > 8
    assert len(extrema(y, 0.1)) == 8


def test_one_part_is_the_classical_filter():
    y = white_noise(200, 1.0, 0)
    (part,) = divide(np.arange(200.0), np.array([], dtype=np.int64), "corrected", 1.0)
    assert (part.begin, part.end, part.degree) == (0, 200, 1)
    assert np.array_equal(smooth_parts(y, [part]), smooth(y, part.window, part.degree))


def test_borders_are_faded_and_the_inside_of_parts_is_not_touched():
    t = np.arange(1024)
    y = np.where(t < 500, np.sin(2 * np.pi * t / 200), np.sin(2 * np.pi * (t - 500) / 30))
    parts = divide(y, extrema(y), "corrected", 0.1)
    assert len(parts) >= 2
    out = smooth_parts(y, parts)
    for part in parts:
        fade = min(part.window, part.end - part.begin) // 4 + 1
        inside = slice(part.begin + fade, part.end - fade)
        whole = smooth(y, part.window, part.degree)
        assert np.allclose(out[inside], whole[inside], atol=1e-12)


@pytest.mark.parametrize("name", CHAPTER6)
def test_literal_rules_hardly_smooth(name):
    """Section 2.4: .029-.032 at sigma = .05, .137-.147 at .2, whatever the signal."""
    low = mean_error(name, 0.05, lambda y: adaptive(y, "literal", 1)[0])
    high = mean_error(name, 0.2, lambda y: adaptive(y, "literal", 1)[0])
    assert 0.026 < low < 0.034
    assert 0.128 < high < 0.150


def test_literal_rules_beat_the_wide_window_of_figure_6_1():
    """In 7 of the 8 cells, as is claimed: SG with k = 3, M = 35."""
    wins = sum(
        mean_error(name, sigma, lambda y: adaptive(y, "literal", 1)[0])
        < mean_error(name, sigma, lambda y: smooth(y, 35, 3))
        for name in CHAPTER6
        for sigma in (0.05, 0.2)
    )
    assert wins == 7


@pytest.mark.parametrize("name", CHAPTER6)
def test_windows_by_amplitude_are_better_than_by_rules(name):
    for sigma in (0.05, 0.2):
        by_rules = mean_error(name, sigma, lambda y: adaptive(y, "corrected", 1)[0])
        assert mean_error(name, sigma, lambda y: adaptive(y, "scale", 1)[0]) < by_rules


@pytest.mark.parametrize("rules", ["literal", "corrected", "scale"])
def test_shift_scale_and_lines(rules):
    y = clean("twotone", 300) + white_noise(300, 0.1, 0)
    result, at = adaptive(y, rules)
    scaled, same = adaptive(8.0 * y + 3.0, rules)
    assert np.array_equal(at, same)
    assert scaled == pytest.approx(8.0 * result + 3.0, abs=1e-10)
    line = 2.0 - 0.25 * np.arange(100)
    assert adaptive(line, rules)[0] == pytest.approx(line, abs=1e-10)


def test_the_method_averages_around_the_extrema_when_asked():
    y = clean("chirp", 300) + white_noise(300, 0.1, 0)
    present = np.ones(300, dtype=bool)
    plain, averaged = (
        ADAPTIVE_SAVGOL.estimate(y, present, resolve(ADAPTIVE_SAVGOL.parameters, given, "x"))
        for given in ({}, {"radius": 2})
    )
    at = adaptive(y)[1]
    assert {int(np.min(np.abs(at - i))) for i in np.flatnonzero(plain != averaged)} == {0, 1, 2}
    assert math.isfinite(float(np.sum(averaged)))


@pytest.mark.parametrize("rules", ["literal", "corrected", "scale"])
def test_the_shortest_records(rules):
    values = resolve(ADAPTIVE_SAVGOL.parameters, {"rules": rules}, "adaptive_savgol")
    n = ADAPTIVE_SAVGOL.shortest(values)
    y = white_noise(n, 1.0, 1)
    assert np.isfinite(ADAPTIVE_SAVGOL.estimate(y, np.ones(n, dtype=bool), values)).all()
