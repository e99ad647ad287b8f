"""The fuzzy supervisor on line, against the same by NumPy's fits and scikit-fuzzy's inference."""

import math

import numpy as np
import pytest
import skfuzzy
from filter_runs import DT, constants_of, noise, rms, run, two_sines

from fpt_ros.denoising.streaming import FILTERS, Update
from fpt_ros.denoising.streaming.fuzzy import FUZZY, ladder
from fpt_ros.denoising.streaming.supervisor import PLACE
from fpt_ros.engine import compiled
from fpt_ros.errors import BadInput

GRID = np.linspace(0.0, 1.0, 2001)
TRIANGLES = ([0.0, 0.0, 0.5], [0.0, 0.5, 1.0], [0.5, 1.0, 1.0])
WIDER, STAY, NARROWER = 2, 1, 0
WIDTH = [[WIDER, WIDER, STAY], [WIDER, STAY, NARROWER], [STAY, NARROWER, NARROWER]]
BELIEVE, DOUBT = 0, 2
IMPULSE = [[BELIEVE] * 3, [BELIEVE, 1, DOUBT], [DOUBT] * 3]


def mamdani(table, first, second):
    """Rows: the first input's set; (value, sets) are the inputs."""

    def degrees(value, sets):
        a, b, c = sets
        x = np.array([np.clip(value, a, c)])
        return [skfuzzy.trimf(x, each)[0] for each in ([a, a, b], [a, b, c], [b, c, c])]

    shape = np.zeros(len(GRID))
    for row, one in zip(table, degrees(*first), strict=True):
        for output, two in zip(row, degrees(*second), strict=True):
            cut = np.fmin(min(one, two), skfuzzy.trimf(GRID, TRIANGLES[output]))
            shape = np.fmax(shape, cut)
    return skfuzzy.defuzz(GRID, shape, "centroid")


def fit(samples, degree):
    """The polynomial through the samples, of the time from the newest one on, in samples."""
    return np.polynomial.Polynomial.fit(np.arange(1 - len(samples), 1), samples, degree)


def written_down(q, windows, degree, memory, pace):
    """Estimates, places and doubted samples, as the module's text has them."""
    healed = list(np.full(windows[-1], q[0]))
    expected = np.full(len(windows), q[0])
    rows = []  # of each window its weights for the next sample, by fitting unit samples
    for window in windows:
        rows.append([fit(unit, degree)(1.0) for unit in np.eye(window)])
    variance = np.array([1.0 + np.sum(np.square(row)) for row in rows])
    unit = np.zeros(len(windows))
    for m in range(1, len(windows)):
        common = 1.0 + np.dot(rows[m][-windows[m - 1] :], rows[m - 1])
        rho = common / math.sqrt(variance[m] * variance[m - 1])
        unit[m] = math.sqrt(windows[m] / (2.0 * (1.0 - rho * rho)))
    raw, sizes = [q[0]] * 3, []
    missed, place, share, alike, jumped = np.zeros(len(windows)), 0.0, 0.0, [], False
    out, places, doubted = np.full((len(q), 3), math.nan), [0.0], []
    for k in range(1, len(q)):
        raw = [*raw[-3:], q[k]]
        third = np.diff(raw, 3)[0]
        if np.isfinite(third):
            sizes.append(abs(third))
        known = len(sizes) >= memory
        sigma = np.median(sizes[-memory:]) / 0.6745 / math.sqrt(20.0) if known else math.nan
        prediction = np.interp(place, np.arange(len(windows)), expected)
        sample = q[k]
        if not np.isfinite(sample):
            sample = prediction
        else:
            doubt = False
            if known:
                distance = np.min(np.abs(sample - expected) / np.sqrt(variance)) / sigma
                sets = (3.0, 4.5, 6.0), (0.0, 0.05, 0.15)
                far = mamdani(IMPULSE, (distance, sets[0]), (share, sets[1])) > 0.5
                if jumped or not far:
                    alike, jumped = [], jumped and distance >= 2.0
                else:
                    miss = sample - prediction
                    alike = [*(alike if alike and miss / alike[-1] > 0.5 else []), miss]
                    jumped = len(alike) >= (2 if distance < 24.0 else 3)
                    doubt = not jumped
            share += (doubt - share) / memory
            if doubt:
                sample = prediction
                doubted.append(k)
            elif known:
                z = (sample - expected) ** 2 / variance
                z /= max(sigma**2, np.min(z))
                more = np.clip(np.diff(z), -4.0, 4.0)
                missed[1:] += (more * unit[1:] - missed[1:]) / windows[1:]
                ends = np.array([0.0, *np.clip(missed[1:], 0.0, 6.0), 6.0])
                now, wider = np.interp([place, place + 1.0], np.arange(len(ends)), ends)
                out_ = mamdani(WIDTH, (now, (0.0, 3.0, 6.0)), (wider, (0.0, 3.0, 6.0)))
                place = float(np.clip(place + 3.0 * pace * (out_ - 0.5), 0, len(windows) - 1))
        healed.append(sample)
        places.append(place)
        fits = [fit(healed[-window:], degree) for window in windows]
        expected = np.array([each(1.0) for each in fits])
        for i in range(3):
            values = [each.deriv(i)(0.0) / DT**i if i else each(0.0) for each in fits]
            out[k, i] = np.interp(place, np.arange(len(windows)), values)
    return out, np.array(places), doubted


def machine(q, dt=DT, law=FUZZY, **given):
    """Estimates (samples, 3) by machine code."""
    update = compiled.law(law.update, Update)
    return run(law, q, dt, np.array, update, **given)[:, :, 0]


def places(q, **given):
    """Where the supervisor is on the ladder, after every sample."""
    constants = np.array(constants_of(FUZZY, **given))
    state = np.zeros(FUZZY.state_size(constants, 1))
    FUZZY.start(constants, state, q[:1], [math.nan])
    update, found = compiled.law(FUZZY.update, Update), [0.0]
    unknown, out = np.array([math.nan]), np.zeros((3, 1))
    for each in q[1:]:
        update(constants, state, DT, np.array([each]), unknown, *out)
        found.append(float(state[1 + PLACE]))
    return np.array(found)


def test_it_is_what_its_text_says():
    """Rest, a motion that sets in, impulses, a step, missing samples, more noise."""
    t = np.maximum(np.arange(420) - 150, 0) * DT
    q = 0.2 * (1.0 - np.cos(30.0 * t)) + np.where(np.arange(420) < 330, 1.0, 8.0) * noise(420)
    q[[100, 240, 244, 247]] += [0.2, 0.1, -0.1, 0.05]
    q[[120, 121, 260]] = math.nan
    q[280:] += 0.3
    given = {"windows": [7.0, 41.0], "members": 4, "degree": 2, "noise_window": 31, "pace": 0.3}
    windows = ladder(7.0, 41.0, 4)
    assert windows == [7, 13, 23, 41]
    expected, where, doubted = written_down(q, windows, 2, 31, 0.3)
    assert {100, 240, 244, 247} <= set(doubted)
    assert [k for k in doubted if 280 <= k < 290] == [280, 281]  # then it is a step
    assert np.ptp(where) > 2.9
    assert places(q, **given) == pytest.approx(where, abs=1e-4)
    found = run(FUZZY, q, **given)[:, :, 0]
    for i in range(3):
        size = rms(expected[1:, i])
        assert found[1:, i] == pytest.approx(expected[1:, i], abs=1e-4 * size)


def test_parabolas_are_exact_at_every_place():
    t = np.arange(600) * DT
    exact = np.stack([0.3 + 2.0 * t - 4.0 * t * t, 2.0 - 8.0 * t, np.full(600, -8.0)], axis=1)
    out = machine(exact[:, 0], windows=[11.0, 61.0])
    assert out[200:] == pytest.approx(exact[200:], abs=1e-6)


def test_more_noise_widens_the_window_and_motion_narrows_it():
    slow = two_sines(1500)[0]
    quiet, loud = (places(slow + noise(1500, 1, sigma))[500:].mean() for sigma in (1e-5, 1e-3))
    assert quiet + 1.0 < loud
    at = np.arange(1500) * DT
    moves = places(np.where(at < 1.0, 0.0, np.sin(25.0 * (at - 1.0))) + noise(1500, 2))
    assert moves[900:1000].min() > 4.0
    assert moves[1100:1300].max() < 3.0


def errors(law, clean, q, **given):
    out = machine(q, law=law, **given)[1000:]
    return np.array([rms(out[:, i] - clean[i][1000:]) for i in (1, 2)])


def test_where_it_wins_and_where_it_loses():
    clean = two_sines(6000)
    steady = clean[0] + noise(6000, 3)
    level = np.where(np.arange(6000) // 1500 % 2, 1e-3, 3e-5)
    changing = clean[0] + level * noise(6000, 4, 1.0)
    hit = steady.copy()
    hit[np.random.default_rng(5).random(6000) < 0.02] += 0.1
    fixed = FILTERS["savgol"]
    adaptive = FILTERS["kalman_bank"]
    # against one fixed window, at three levels of noise; and in impulses
    for sigma, ratio in ((1e-5, 0.25), (1e-3, 1.3), (1e-2, 0.75)):
        q = clean[0] + noise(6000, 6, sigma)
        assert np.all(errors(FUZZY, clean, q) < ratio * errors(fixed, clean, q))
    assert np.all(errors(FUZZY, clean, hit) < 1.3 * errors(FUZZY, clean, steady))
    assert np.all(errors(fixed, clean, hit) > 5.0 * errors(FUZZY, clean, hit))
    # it loses to the ladder of Kalman filters in steady noise, and wins nothing by its changes
    assert np.all(errors(adaptive, clean, changing) < errors(FUZZY, clean, changing))
    assert np.all(errors(adaptive, clean, steady) < errors(FUZZY, clean, steady))
    # it has to find out what the fixed window happens to suit
    assert np.all(errors(fixed, clean, changing) < errors(FUZZY, clean, changing))


def test_rest_is_exact_and_missing_samples_are_bridged():
    q = np.full(400, 0.3)
    q[[200, 300]] = math.nan, math.inf
    out = machine(q)[1:]
    assert out == pytest.approx(np.tile([0.3, 0.0, 0.0], (399, 1)), abs=1e-13)
    clean = two_sines(2500)
    lost = clean[0] + noise(2500, 7)
    lost[np.random.default_rng(8).random(2500) < 0.2] = math.nan
    lost[0] = clean[0][0]
    out = machine(lost)
    assert np.all(np.isfinite(out[1:]))
    assert rms(out[1000:, 0] - clean[0][1000:]) < 1e-3


def test_seconds_are_windows_at_any_rate():
    q = noise(300, 9)
    by_time = machine(q, 2e-3, seconds=[0.03, 0.1])
    assert np.array_equal(by_time, machine(q, 2e-3, windows=[15.0, 49.0]), equal_nan=True)


def test_two_coordinates_have_nothing_in_common():
    a, b = two_sines(500)[0] + noise(500), 1e3 + noise(500, seed=9)
    both = run(FUZZY, np.column_stack([a, b]), windows=[7.0, 61.0], noise_window=31)
    for i, alone in enumerate((a, b)):
        single = run(FUZZY, alone, windows=[7.0, 61.0], noise_window=31)[:, :, 0]
        assert np.array_equal(both[:, :, i], single, equal_nan=True)


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        ({"windows": [41.0, 11.0]}, "in this order"),
        ({"windows": [11.0]}, "the narrowest and the widest"),
        ({"windows": [11.0, 40.0]}, "an odd number"),
        ({"windows": [11.5, 41.0]}, "whole numbers"),
        ({"windows": [3.0, 41.0]}, "less than the window"),
        ({"seconds": [0.01, 20.0]}, "at most 10001"),
        ({"noise_window": 30}, "noise_window = 30"),
        ({"degree": 1}, "at least 2"),
    ],
)
def test_ladders_that_cannot_be(given, reason):
    with pytest.raises(BadInput, match=reason):
        constants_of(FUZZY, **given)
