"""The neuron: plant, model, nominal motion and observer of section 3.1.2."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mechanics import exert, respond
from scipy.integrate import solve_ivp

from fpt_ros.denoising.streaming.fitzhugh_nagumo_observer import FITZHUGH_NAGUMO_OBSERVER
from fpt_ros.plants.fitzhugh_nagumo import MODEL, PLANT
from fpt_ros.trajectories.fitzhugh_nagumo import FITZHUGH_NAGUMO

EXACT = (0.7, 12.5, 0.5, 0.5, 2.0)
IDEAL = (0.6, 11.0, 0.4, 0.3)
number = st.floats(-3.0, 3.0)
pair = st.tuples(number, number)
physical = st.tuples(number, st.floats(1.0, 20.0), number, number, st.floats(0.2, 5.0))


@settings(deadline=None)
@given(physical, pair, number)
def test_the_response_is_3_3(parameters, q, control):
    a, tau, b, stimulus, mu = parameters
    v, w = q
    expected = [v - v**3 / 3.0 - w + stimulus + mu * control, (v + a - b * w) / tau]
    found = respond(PLANT, parameters, q, (0.0, 0.0), (control, 99.0))
    assert found == pytest.approx(expected, abs=1e-13)


@settings(deadline=None)
@given(physical, pair, number)
def test_an_exact_model_inverts_the_plant(parameters, q, control):
    rate = respond(PLANT, parameters, q, (0.0, 0.0), (control, 0.0))
    assert exert(MODEL, parameters, q, (0.0, 0.0), rate) == pytest.approx([control, 0.0], abs=1e-12)


def test_the_plant_answers_with_the_first_derivative():
    assert PLANT.order == 1
    assert MODEL.controlled == ("v",)


def nominal_run(dt, cycles):
    values = {parameter.name: parameter.default for parameter in FITZHUGH_NAGUMO.parameters}
    values |= {"amplitude": [1.0], "frequency": [1.0]}
    constants, state = FITZHUGH_NAGUMO.prepare(values, 1), list(FITZHUGH_NAGUMO.state)
    rows = []
    for k in range(cycles):
        out = [math.nan], [math.nan], [math.nan]
        FITZHUGH_NAGUMO.nominal(constants, state, k * dt, dt if k else 0.0, *out)
        rows.append([each[0] for each in out])
    return np.array(rows)


def test_the_nominal_motion_is_that_of_the_ideal_neuron():
    """Euler's error against a Runge-Kutta solution halves with dt."""
    a, tau, b, stimulus = IDEAL

    def right_hand_side(t, y):
        return y[0] - y[0] ** 3 / 3.0 - y[1] + stimulus, (y[0] + a - b * y[1]) / tau

    errors = []
    for dt in (0.01, 0.005):
        count = round(20.0 / dt)
        times = np.arange(count) * dt
        exact = solve_ivp(
            right_hand_side, (0.0, 20.0), (0.0, 0.0), t_eval=times, rtol=1e-10, atol=1e-12
        )
        found = nominal_run(dt, count)
        errors.append(np.abs(found[:, 0] - exact.y[0]).max())
    assert errors[0] < 0.02
    assert errors[1] / errors[0] == pytest.approx(0.5, abs=0.03)


def test_the_nominal_rate_is_what_euler_steps_by():
    rows = nominal_run(0.01, 2000)
    assert rows[0, :2] == pytest.approx([0.0, 0.3], abs=0.0)
    assert np.diff(rows[:, 0]) / 0.01 == pytest.approx(rows[:-1, 1], abs=1e-12)
    # the second derivative is the rate's own: an Euler step of the rate misses it by O(dt)
    assert np.diff(rows[:, 1]) / 0.01 == pytest.approx(rows[:-1, 2], abs=0.04)
    fine = nominal_run(0.001, 20_000)
    assert np.diff(fine[:, 1]) / 0.001 == pytest.approx(fine[:-1, 2], abs=0.004)


def test_the_observer_integrates_the_recovery_from_the_measured_potential():
    a, tau, b, dt = 0.8, 10.0, 0.6, 0.01
    values = {"approximate.a": a, "approximate.tau": tau, "approximate.b": b}
    observer = FITZHUGH_NAGUMO_OBSERVER
    constants = observer.prepare(values, 2, dt)
    measured = 2.0 * np.sin(np.arange(500) * 0.05)
    state = [math.nan] * observer.state_size(constants, 2)
    observer.start(constants, state, [measured[0], 123.0], [0.0, 0.0])
    w = 0.0
    for before, v in pairwise(measured):
        rate = (before + a - b * w) / tau
        w += dt * rate
        out = [math.nan] * 2, [math.nan] * 2, [math.nan] * 2
        observer.update(constants, state, dt, [v, 123.0], [0.0, 0.0], *out)
        assert out[0] == pytest.approx([v, w], rel=1e-14)
        assert out[2] == pytest.approx([(v - before) / dt, rate], rel=1e-12)


def test_the_observer_finds_the_recovery_of_a_neuron_that_is_as_it_believes():
    """Its error decays with b / tau, whatever w was at the start."""
    dt, tau, b = 0.01, 12.5, 0.5
    values = {"approximate.a": 0.7, "approximate.tau": tau, "approximate.b": b}
    constants = FITZHUGH_NAGUMO_OBSERVER.prepare(values, 2, dt)
    q, state = [0.5, 0.4], [math.nan] * 2
    FITZHUGH_NAGUMO_OBSERVER.start(constants, state, q, [0.0, 0.0])
    for k in range(1, 3001):
        rate = respond(PLANT, EXACT, q, (0.0, 0.0), (0.0, 0.0))
        q = [x + dt * y for x, y in zip(q, rate, strict=True)]
        out = [math.nan] * 2, [math.nan] * 2, [math.nan] * 2
        FITZHUGH_NAGUMO_OBSERVER.update(constants, state, dt, q, [0.0, 0.0], *out)
        assert q[1] - out[0][1] == pytest.approx(0.4 * (1.0 - dt * b / tau) ** k, abs=1e-12)
