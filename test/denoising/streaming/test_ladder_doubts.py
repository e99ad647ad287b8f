"""What the bank at its defaults makes of impulses, of motions that set in, and of other noise."""

import numpy as np
import pytest
from filter_runs import ended, filtered, noise, rms, two_sines

from fpt_ros.denoising.streaming.kalman_bank import KALMAN_BANK
from fpt_ros.denoising.streaming.ladder import MOTION
from fpt_ros.denoising.streaming.ladder_doubts import MOSTLY

SIGMA = 1e-4
SAMPLES = 6000


def errors(q, clean, where=slice(1000, None), **given):
    """Rms errors of velocity and acceleration."""
    out = filtered(KALMAN_BANK, q, **given)
    return np.array([rms((out[:, i] - clean[i])[where]) for i in (1, 2)])


def impulses(share, size, seed):
    random = np.random.default_rng(seed)
    return (random.random(SAMPLES) < share) * random.uniform(-size, size, SAMPLES)


def in_rows(length, size):
    """Rows of equal impulses, one in 200 samples or so."""
    hit = np.zeros(SAMPLES)
    at = np.random.default_rng(2).choice(np.arange(100, SAMPLES, 20), SAMPLES // 200, replace=False)
    for k in range(length):
        hit[at + k] = size
    return hit


@pytest.mark.parametrize(
    ("hit", "ratio"),
    [
        (impulses(0.02, 500.0 * SIGMA, 1), 1.2),
        (impulses(0.02, 30.0 * SIGMA, 2), 1.2),
        (impulses(0.05, 0.05, 3), 1.8),
        (impulses(0.005, 1e4 * SIGMA, 4), 1.2),
        (in_rows(1, 0.05), 1.2),
        (in_rows(2, 0.05), 1.2),
    ],
    ids=["all sizes", "small", "many", "huge", "single", "pairs"],
)
def test_impulses_leave_nothing_behind(hit, ratio):
    clean = two_sines(SAMPLES)
    for seed in range(3):
        q = clean[0] + noise(SAMPLES, seed, SIGMA)
        assert np.all(errors(q + hit, clean) < ratio * errors(q, clean))
    assert np.all(errors(q + hit, clean, gate=1e9) > 10.0 * errors(q, clean))


def test_the_bank_learns_that_impulses_are_what_surprises():
    clean = two_sines(SAMPLES)[0] + noise(SAMPLES, 1, SIGMA)
    share = [
        ended(KALMAN_BANK, clean + hit)[1][MOTION] for hit in (np.zeros(SAMPLES), in_rows(1, 0.05))
    ]
    assert share[1] < MOSTLY < share[0]


def test_a_record_that_begins_at_full_speed_does_not_open_the_gate():
    t = np.arange(SAMPLES) * 1e-3
    clean = np.stack([5.0 * t, np.full(SAMPLES, 5.0), np.zeros(SAMPLES)])
    q = clean[0] + noise(SAMPLES, 1, SIGMA)
    assert np.all(errors(q + in_rows(1, 0.02), clean) < 1.3 * errors(q, clean))


@pytest.mark.parametrize("factor", [3.0, 30.0, 300.0])
def test_noise_that_grows_is_no_motion(factor):
    clean = two_sines(SAMPLES)
    level = np.where(np.arange(SAMPLES) < 3000, 1.0, factor)
    later = slice(3050, None)
    for seed in range(4):
        z = noise(SAMPLES, seed, 1e-5)
        grown = errors(clean[0] + level * z, clean, later)
        assert np.all(grown < 1.2 * errors(clean[0] + factor * z, clean, later))


def test_a_motion_that_sets_in_is_no_impulse():
    dt = 0.01
    once = two_sines(100, dt)[0]
    q = np.concatenate((once, np.full(200, once[-1]), once[::-1]))
    v = np.gradient(q, dt)
    a = np.gradient(v, dt)
    q += noise(400, 1, 1e-6)
    gated, free = (filtered(KALMAN_BANK, q, dt, gate=gate) for gate in (5.0, 1e9))
    for i, clean in ((1, v), (2, a)):
        assert rms(gated[50:, i] - clean[50:]) <= rms(free[50:, i] - clean[50:])
    # what it has seen once it does not doubt again
    assert np.array_equal(gated[301:], free[301:])


def test_impulses_are_kept_back():
    clean = two_sines(4000)
    q = clean[0] + noise(4000, seed=1)
    hit = q.copy()
    at = np.random.default_rng(5).choice(np.arange(900, 4000), 60, replace=False)
    hit[at] += np.where(np.arange(60) % 2, 1.0, -1.0)
    error = [
        rms(filtered(KALMAN_BANK, each, gate=gate)[1000:, 2] - clean[2][1000:])
        for each, gate in ((q, 5.0), (hit, 5.0), (hit, 1e9))
    ]
    assert error[1] < 1.2 * error[0]
    assert error[2] > 1000 * error[0]
