"""Where ``auto`` does not believe its own best model."""

import numpy as np

from fpt_ros.denoising.offline import denoise
from fpt_ros.denoising.offline.doubts import FLAT, bursts, no_rounding, stairs_of_rounding
from fpt_ros.denoising.offline.spectral_floor import flatness
from fpt_ros.denoising.signals import white_noise


def test_impulses_that_come_alone_are_impulses():
    impulse = np.zeros(400)
    impulse[[20, 60, 61, 130, 300]] = 1.0
    assert not bursts(impulse).any()


def test_three_in_a_row_are_a_signal_as_is_what_is_dense():
    impulse = np.zeros(400)
    impulse[100:103] = 1.0
    impulse[300:340:3] = 1.0
    found = bursts(impulse)
    assert found[98:105].all()
    assert found[305:335].all()
    assert not found[:80].any()
    assert not found[150:250].any()


def test_many_impulses_of_a_heavy_tail_are_no_bursts():
    rng = np.random.default_rng(2)
    heavy = (rng.random(2000) < 0.12) * 1.0
    assert np.any(heavy[:-2] + heavy[1:-1] + heavy[2:] == 3.0)
    assert not bursts(heavy).any()
    clean = np.repeat([0.0, 1.0, 0.0], 170)
    y = clean + 0.16 * rng.laplace(size=510)
    assert np.sqrt(np.mean((denoise(y).estimate - clean) ** 2)) < 0.1


def test_what_is_left_of_fast_oscillations_is_no_noise():
    t = np.arange(512) / 512
    chirp = np.sin(np.pi * t * 512 * t)  # up to half the rate and down again
    assert flatness(chirp) < FLAT < flatness(white_noise(512, 1.0, 1))
    # a tone beside it is not all of the signal
    clean = np.sin(0.6 * np.arange(512)) + chirp
    y = clean + white_noise(512, 0.1, 2)
    error = np.sqrt(np.mean((denoise(y).estimate - clean) ** 2))
    assert error < 1.1 * np.sqrt(np.mean((y - clean) ** 2))


def test_a_chirp_up_to_half_the_rate_is_not_cut_where_it_is_fast():
    t = np.arange(512) / 512
    clean = np.sin(np.pi * t * len(t) * t / 4) * np.sqrt(2)
    y = np.round(clean / 0.12) * 0.12
    error = np.sqrt(np.mean((denoise(y).estimate - clean) ** 2))
    assert error < np.sqrt(np.mean((y - clean) ** 2))


def test_what_rounding_and_impulses_do_not_explain():
    y = np.zeros(60)
    y[10] = 5.0  # an impulse
    y[20:22] = 4.0  # two
    y[30] = 1.0  # rounding
    y[45:] = 9.0
    estimate = np.where(np.arange(60) < 46, 0.0, 9.0)  # a jump, one sample late
    np.testing.assert_array_equal(np.flatnonzero(no_rounding(y, estimate, 1.0)), [45])
    fast = 3.0 * (-1.0) ** np.arange(60)
    y = fast.copy()
    y[30] += 5.0
    np.testing.assert_array_equal(np.flatnonzero(no_rounding(y, fast, 1.0)), [30])


def test_a_short_record_that_is_mostly_noise_stays():
    y = white_noise(100, 1.0, 3)
    np.testing.assert_array_equal(denoise(y).estimate, y)
    slow = np.sin(np.arange(100) / 10) + 0.1 * y
    assert not np.array_equal(denoise(slow).estimate, slow)


def test_jumps_in_white_noise_are_not_coloured_noise():
    clean = np.repeat([0.0, 2.0, -1.0, 1.0, -2.0], 100) + np.tile(np.linspace(0, 1, 100) ** 2, 5)
    y = clean + white_noise(500, 0.1, 4)
    found = denoise(y)
    assert found.noise.colour == 0.0
    assert np.sqrt(np.mean((found.estimate - clean) ** 2)) < 0.07


def test_stairs_of_rounding_are_no_steps():
    t = np.linspace(0.0, 1.0, 512)
    smooth, switch = np.sin(5.0 * t), np.sign(np.sin(40.0 * t))
    walk = np.repeat(np.cumsum(np.random.default_rng(3).choice([-1.0, 1.0], 32)), 16)
    assert stairs_of_rounding(np.round(smooth / 0.1) * 0.1, 0.1)
    assert not stairs_of_rounding(np.round(switch / 0.1) * 0.1, 0.1)
    assert not stairs_of_rounding(switch, 2.0)
    assert not stairs_of_rounding(walk, 1.0)
    assert not stairs_of_rounding(np.zeros(512), 0.1)


def test_a_walk_of_single_steps_is_one():
    left = []
    for seed in range(5):
        r = np.random.default_rng(seed)
        walk = np.repeat(np.cumsum(r.choice([-1.0, 1.0], 20)), 50)
        y = walk.copy()
        y[r.choice(1000, 30, False)] += r.choice([-4.0, -3.0, 3.0, 4.0], 30)
        left.append(np.mean((denoise(y).estimate - walk) ** 2) / np.mean((y - walk) ** 2))
    assert np.median(left) < 0.005
