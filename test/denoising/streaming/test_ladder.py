"""The bank at its defaults: near the best single filter without being told noise or bandwidth."""

import itertools
import math

import numpy as np
import pytest
from filter_runs import DT, bang_bang, constants_of, ended, filtered, noise, rms, steps, two_sines

from fpt_ros.denoising.streaming.kalman_bank import KALMAN_BANK
from fpt_ros.denoising.streaming.ladder import LSB as LSB_PLACE
from fpt_ros.denoising.streaming.ladder import (
    MEMBERS,
    SHARED,
    SIGMA,
    UNEVEN,
    noise_gains,
    weight_of,
)
from fpt_ros.denoising.streaming.ladder_deviation import weights
from fpt_ros.denoising.streaming.ladder_members import MOST_UNEVEN
from fpt_ros.denoising.streaming.steady_filter import steady_gains
from fpt_ros.errors import BadInput

LSB = 2 * math.pi / 2**17


def measured(motion, samples, dt, sigma):
    clean = motion(samples, dt)
    if sigma == LSB:
        return np.round(clean[0] / LSB) * LSB, clean
    return clean[0] + noise(samples, 3, sigma), clean


def ratios(rate, sigma, motion):
    """Errors of velocity and acceleration over those of the best single filter of four states."""
    samples, dt = 4 * rate, 1.0 / rate
    q, clean = measured(motion, samples, dt, sigma)
    late = slice(samples // 4, None)

    def errors(law, **given):
        out = filtered(law, q, dt, **given)
        return np.array([rms(out[late, i] - clean[i][late]) for i in (1, 2)])

    known = LSB / math.sqrt(12) if sigma == LSB else sigma
    single = [  # h = (density dt^7 / sigma^2)^(1/8)
        errors(
            KALMAN_BANK, states=[4.0], sigma=known, gate=1e9, densities=[(h**8 * known**2) / dt**7]
        )
        for h in np.geomspace(5e-3, 3.6, 12)
    ]
    return errors(KALMAN_BANK) / np.min(single, axis=0)


def test_it_is_near_the_best_single_filter_at_its_defaults():
    cells = itertools.product([100, 500], [1e-6, 1e-3, LSB], [two_sines, bang_bang])
    found = np.array([ratios(*cell) for cell in cells])
    assert np.all(found < 2.0)
    assert np.all(np.exp(np.mean(np.log(found), axis=0)) < 1.0)


def test_a_smooth_motion_at_a_low_rate_has_no_lsb():
    # the least second difference of a fast motion is far above its noise
    q = two_sines(400, 0.01)[0] + noise(400, 3, 1e-6)
    assert ended(KALMAN_BANK, q, 0.01)[1][UNEVEN] > MOST_UNEVEN
    q = np.round(q / LSB) * LSB
    assert ended(KALMAN_BANK, q, 0.01)[1][UNEVEN] < 1e-3


def test_innovation_and_acceleration_in_white_noise():
    gains = steady_gains(4, 0.3**8, 1.0, 1.0)
    x, innovations, bends = np.zeros(4), [], []
    F = np.array([[math.comb(j, i) for j in range(4)] for i in range(4)])
    for y in noise(20_000, 1, 1.0):
        x = F @ x
        innovations.append(y - x[0])
        x = x + gains * innovations[-1]
        bends.append(x[2])
    found = np.var(innovations[500:]), np.var(bends[500:])
    assert noise_gains(gains) == pytest.approx(found, rel=0.05)


def mixed_accelerations(q, **given):
    """The weighted mean over the members, of each sample, and what is estimated."""
    found = []
    for constants, state, estimate in steps(KALMAN_BANK, q, **given):
        members = int(constants[0])
        bends = state[SHARED + MEMBERS + 2 * members :][:members]
        mixed = 2.0 * np.dot(weights(constants, state, 0), bends) / DT**2
        found.append((mixed, estimate[2]))
    return np.transpose(found)


@pytest.mark.parametrize(("kept", "most"), [(0.0, 0.5), (0.7, 0.75), (0.95, 0.96), (1.0, 1.0)])
def test_accelerations_that_noise_explains_are_shrunk(kept, most):
    mixed, told = mixed_accelerations(noise(6000, 6), acceleration_kept=kept)
    assert np.all(np.abs(told) <= np.abs(mixed) * (1.0 + 1e-12))
    assert np.all(np.abs(told) >= kept * np.abs(mixed) * (1.0 - 1e-12))
    assert rms(told[3000:]) <= most * rms(mixed[3000:]) * (1.0 + 1e-12)


def test_accelerations_of_a_motion_stay():
    clean = two_sines(3000)
    mixed, told = mixed_accelerations(clean[0] + noise(3000, 6, 1e-6), acceleration_kept=0.0)
    assert rms(told[500:] - mixed[500:]) < 0.01 * rms(clean[2][500:])


@pytest.mark.parametrize("sigma", [1e-6, 1e-2])
def test_sigma_is_found(sigma):
    q = two_sines(5000)[0] + noise(5000, 4, sigma)
    assert ended(KALMAN_BANK, q)[1][SHARED + SIGMA] == pytest.approx(sigma, rel=0.25)


def test_the_step_of_an_encoder_is_found():
    q = np.round(two_sines(5000)[0] / LSB) * LSB
    assert ended(KALMAN_BANK, q)[1][LSB_PLACE] == pytest.approx(LSB, rel=1e-9)


@pytest.mark.parametrize("jump", [0.02, 1.0, 1000.0])
def test_it_finds_the_motion_again_after_a_step(jump):
    clean = two_sines(4000)
    q = clean[0] + noise(4000, seed=2)
    q[2000:] += jump
    out = filtered(KALMAN_BANK, q)
    after = slice(3000, None)
    assert rms(out[after, 0] - clean[0][after] - jump) < 1e-3
    assert rms(out[after, 2] - clean[2][after]) < 3.0


def test_missing_samples_are_bridged_with_growing_doubt():
    clean = two_sines(3000)
    q = clean[0] + noise(3000, seed=4)
    doubts = []
    for gap in (0, 5, 20, 60):
        lost = np.append(q[:2000], np.full(gap, math.nan))
        constants, state = ended(KALMAN_BANK, lost)
        doubts.append(KALMAN_BANK.deviation(constants, state, 0))
    assert np.all(np.diff(doubts, axis=0) > 0.0)
    q[2000:2060] = [math.nan, math.inf] * 30
    out = filtered(KALMAN_BANK, q)
    assert np.all(np.isfinite(out[1:]))
    assert abs(out[2059, 0] - clean[0][2059]) < 3.0 * doubts[-1][0]


def test_deviations_are_as_great_as_the_errors():
    clean = two_sines(3000)
    inside = []
    for seed in range(8):
        constants, state = ended(KALMAN_BANK, clean[0][:2000] + noise(2000, seed))
        deviations = KALMAN_BANK.deviation(constants, state, 0)
        out = filtered(KALMAN_BANK, clean[0][:2000] + noise(2000, seed))[-1]
        inside += [abs(out[i] - clean[i][1999]) < 3.0 * deviations[i] for i in range(3)]
    assert np.mean(inside) > 0.8


def test_scale_and_sign_change_nothing_else():
    q = two_sines(1500)[0] + noise(1500, 5)
    expected = filtered(KALMAN_BANK, q)
    assert np.array_equal(filtered(KALMAN_BANK, -1024.0 * q)[1:], -1024.0 * expected[1:])


def test_weights_are_nearly_exponential():
    assert weight_of(0.0) == 1.0
    assert weight_of(3.0) == pytest.approx(math.exp(-1.0), rel=0.1)
    assert weight_of(100.0) == 0.0


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        ({"slowest": 5.0}, "less than fastest"),
        ({"members": 1}, "members"),
        ({"gate": 1.0}, "gate"),
        ({"acceleration_kept": 1.5}, "acceleration_kept"),
    ],
)
def test_ladders_that_cannot_be(given, reason):
    with pytest.raises(BadInput, match=reason):
        constants_of(KALMAN_BANK, **given)
