"""A bank of given Kalman filters, against textbook filters with matrices."""

import math

import numpy as np
import pytest
from filter_runs import DT, bang_bang, constants_of, noise, rms, run, two_sines

from fpt_ros.denoising.streaming import Update
from fpt_ros.denoising.streaming.kalman_bank import KALMAN_BANK
from fpt_ros.denoising.streaming.steady_filter import steady_gains
from fpt_ros.engine import compiled
from fpt_ros.errors import BadInput

PRINTED = {
    (3, 1e2): [0.127383, 0.00867514, 1.47700e-4],
    (4, 1e4): [0.104340, 0.00574766, 9.27398e-5, 4.98793e-7],
    (5, 1e6): [0.0972715, 0.00497624, 7.86731e-5, 5.12485e-7, 1.25189e-9],
    (6, 1e8): [0.0959302, 0.00483647, 7.72987e-5, 5.49090e-7, 1.85461e-9, 2.50565e-12],
}
"""Chapter 5 and 6 file, section 3: gains of the scaled states at dt = sigma = 1e-3.

One of the 18 is misprinted there: the third of the five states is given as 7.86747e-5. The
recursion in 50 decimals ends at 7.867309452e-5, and so does that of
test_gains_are_the_limit_of_the_recursion.
"""


def run_given(q, sigma=1e-3, **given):
    return run(KALMAN_BANK, q, sigma=sigma, **given)


def wiener(states, density, dt):
    """Transition and process noise of the integrated Wiener process, in q, q', q'', .."""
    F = np.zeros((states, states))
    Q = np.zeros((states, states))
    for i in range(states):
        for j in range(states):
            if j >= i:
                F[i, j] = dt ** (j - i) / math.factorial(j - i)
            a, b = states - 1 - i, states - 1 - j
            Q[i, j] = density * dt ** (a + b + 1)
            Q[i, j] /= (a + b + 1) * math.factorial(a) * math.factorial(b)
    return F, Q


def iterated_gain(states, density, sigma, dt, steps=2500):
    """Gain after many steps of the textbook recursion from an uninformed start."""
    F, Q = wiener(states, density, dt)
    P = np.diag([1.0 * 10.0**i for i in range(states)])
    for _ in range(steps):
        K = P[:, 0] / (P[0, 0] + sigma**2)
        I_KC = np.eye(states)
        I_KC[:, 0] -= K
        P = F @ (I_KC @ P @ I_KC.T + sigma**2 * np.outer(K, K)) @ F.T + Q
    return P[:, 0] / (P[0, 0] + sigma**2)


def matrix_filter(q, states, density, sigma=1e-3):
    F, _ = wiener(states, density, DT)
    scale = np.array([DT**i / math.factorial(i) for i in range(states)])
    K = np.array(PRINTED[states, density]) / scale
    x = np.zeros(states)
    x[0] = q[0]
    out = np.full((len(q), 3), math.nan)
    for k in range(1, len(q)):
        x = F @ x
        x = x + K * (q[k] - x[0])
        out[k] = x[:3]
    return out


@pytest.mark.parametrize(("states", "density"), PRINTED)
def test_gains_are_the_printed_ones(states, density):
    gains = steady_gains(states, density, 1e-3, 1e-3)
    assert gains == pytest.approx(PRINTED[states, density], rel=5e-6)


@pytest.mark.parametrize(
    ("states", "density", "sigma", "dt"),
    [*((*member, 1e-3, 1e-3) for member in PRINTED), (2, 5.0, 0.01, 0.002), (4, 3.0, 0.1, 0.01)],
)
def test_gains_are_the_limit_of_the_recursion(states, density, sigma, dt):
    scale = [dt**i / math.factorial(i) for i in range(states)]
    expected = iterated_gain(states, density, sigma, dt) * scale
    assert steady_gains(states, density, sigma, dt) == pytest.approx(expected, rel=1e-7)


def test_gains_of_two_states_have_a_closed_form():
    """Alpha-beta filter: beta^2 / (1 - alpha) from the tracking index, beta = 2(2-a) - 4 sqrt(1-a).

    That form is of a process noise which is constant acceleration within each step; the white one
    here adds dt^4/12, so they agree only where the gains are small.
    """
    alpha, beta = steady_gains(2, 1e-6, 1.0, 1.0)
    assert beta == pytest.approx(2 * (2 - alpha) - 4 * math.sqrt(1 - alpha), rel=1e-3)
    assert beta**2 / (1 - alpha) == pytest.approx(1e-6, rel=2e-3)


@pytest.mark.parametrize(("states", "density"), PRINTED)
def test_one_member_is_the_matrix_filter(states, density):
    q = two_sines(1500)[0] + noise(1500)
    found = run_given(q, states=[float(states)], densities=[density], gate=1e9)
    expected = matrix_filter(q, states, density)
    size = np.nanmax(np.abs(expected), axis=0)
    assert np.nanmax(np.abs(found[:, :, 0] - expected) / size) < 5e-5  # six printed digits


def test_the_mixture_is_better_than_any_member_when_the_motion_is_of_two_kinds():
    """Smooth sines want the most states, an acceleration that jumps wants the fewest."""
    motions = [(signal(4000), noise(4000, seed=3)) for signal in (two_sines, bang_bang)]

    def errors(**given):
        out = [run_given(clean[0] + e, **given)[:, :, 0] for clean, e in motions]
        return [
            rms([x[1000:, i] - clean[i][1000:] for x, (clean, _) in zip(out, motions, strict=True)])
            for i in (1, 2)
        ]

    bank = errors()
    for states, density in PRINTED:
        member = errors(states=[float(states)], densities=[density])
        assert bank[0] < member[0]
        assert bank[1] < member[1]


def test_the_mixture_stays_between_its_members():
    q = two_sines(600)[0] + noise(600)
    members = [run_given(q, states=[float(s)], densities=[d])[1:, 2, 0] for s, d in PRINTED]
    bank = run_given(q)[1:, 2, 0]
    slack = 1e-9 * np.max(np.abs(bank))
    assert np.all(bank <= np.max(members, axis=0) + slack)
    assert np.all(bank >= np.min(members, axis=0) - slack)


@pytest.mark.parametrize(
    ("signal", "velocity", "response"), [(two_sines, 0.0195, 0.78), (bang_bang, 0.038, 2.40)]
)
def test_figures_of_section_3(signal, velocity, response):
    """10 s, the first dropped, 10 seeds; of bang-bang it says neither size nor period."""
    clean = signal(10_000)
    q = np.column_stack([clean[0] + noise(10_000, seed) for seed in range(10)])
    machine = compiled.law(KALMAN_BANK.update, Update)
    out = run_given(q, vector=np.array, update=machine)[1000:]
    error = [np.mean([rms(out[:, i, s] - clean[i][1000:]) for s in range(10)]) for i in (1, 2)]
    assert error[0] <= velocity
    assert error[1] <= response


def test_impulses_are_rejected():
    clean = two_sines(4000)
    q = clean[0] + noise(4000, seed=1)
    plain = run_given(q)[1000:, :, 0]
    hit = q.copy()
    at = np.random.default_rng(5).choice(np.arange(900, 4000), 60, replace=False)
    hit[at] += np.where(np.arange(60) % 2, 1.0, -1.0)
    gated = run_given(hit)[1000:, :, 0]
    open_gate = run_given(hit, gate=1e9)[1000:, :, 0]
    error = [rms(x[:, 2] - clean[2][1000:]) for x in (plain, gated, open_gate)]
    assert error[1] < 1.3 * error[0]
    assert error[2] > 30 * error[0]


@pytest.mark.parametrize("jump", [0.02, 1.0, 1000.0])
def test_the_gate_recovers_after_a_step(jump):
    clean = two_sines(5000)
    q = clean[0] + noise(5000, seed=2)
    q[2000:] += jump
    out = run_given(q)[:, :, 0]
    before = abs(out[2003, 0] - clean[0][2003])
    assert before < 0.01, "the first four samples after the step pass for impulses"
    after = slice(4000, 5000)
    assert rms(out[after, 0] - clean[0][after] - jump) < 5e-4
    assert rms(out[after, 2] - clean[2][after]) < 1.0


def test_missing_samples_are_predicted():
    clean = two_sines(3000)
    q = clean[0] + noise(3000, seed=4)
    q[2000:2010] = [math.nan, math.inf] * 5
    q[500] = math.inf
    out = run_given(q)[:, :, 0]
    assert np.all(np.isfinite(out[1:]))
    assert np.max(np.abs(out[2000:2010, 0] - clean[0][2000:2010])) < 3e-3


def test_coordinates_do_not_know_each_other():
    a, b = two_sines(300)[0] + noise(300), 1e3 + 5.0 * noise(300, seed=9)
    both = run_given(np.column_stack([a, b]))
    assert np.array_equal(both[:, :, 0], run_given(a)[:, :, 0], equal_nan=True)
    assert np.array_equal(both[:, :, 1], run_given(b)[:, :, 0], equal_nan=True)


def test_what_is_not_given_beside_what_is_has_its_default():
    q = two_sines(200)[0] + noise(200)
    states, densities = zip(*PRINTED, strict=True)
    expected = run_given(q)
    for given in ({"states": list(map(float, states))}, {"densities": list(densities)}):
        assert np.array_equal(run_given(q, sigma=0.0, **given), expected, equal_nan=True)


@pytest.mark.parametrize("order", [0, 1])
def test_response_of_plants_of_lower_order(order):
    out = run_given(two_sines(200)[0], order=order)
    assert np.array_equal(out[1:, 2], out[1:, order])


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        ({"states": [3.0]}, "each filter of the bank takes one of both"),
        ({"densities": [1.0]}, "each filter of the bank takes one of both"),
        ({"states": [2.0], "densities": [1.0]}, "an integer from 3 to 6"),
        ({"states": [3.5], "densities": [1.0]}, "an integer from 3 to 6"),
        ({"states": [7.0], "densities": [1.0]}, "an integer from 3 to 6"),
        ({"sigma": -1.0}, "sigma"),
        ({"gate": 1.0}, "gate = 1 is not valid: it is 0, or more than 2"),
        ({"densities": [0.0, 1.0, 1.0, 1.0]}, "densities"),
    ],
)
def test_banks_that_cannot_be(given, reason):
    with pytest.raises(BadInput, match=reason):
        constants_of(KALMAN_BANK, **given)


def test_a_filter_that_filters_nothing_is_refused():
    with pytest.raises(BadInput, match="dt = 10 s the filter of 4 states takes every"):
        constants_of(KALMAN_BANK, dt=10.0, sigma=1e-3)


@pytest.mark.parametrize("sigma", [1e-170, 1e200])
def test_noise_out_of_the_range_of_numbers_is_refused(sigma):
    with pytest.raises(BadInput, match="sigma = 1e"):
        constants_of(KALMAN_BANK, sigma=sigma)
