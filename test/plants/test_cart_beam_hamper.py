"""Cart, beam and hamper: (2.23) with all axles driven, and the model of (2.21)."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mechanics import derivative, exert, power, regressor_of, respond

from fpt_ros.plants.cart_beam_hamper import MODEL, PLANT

rate = st.floats(-3.0, 3.0)
triple = st.tuples(rate, rate, rate)
force = st.floats(-300.0, 300.0)
mass = st.floats(1.0, 50.0)
physical = st.tuples(mass, mass, st.floats(0.3, 3.0), st.floats(0.5, 50.0), st.floats(0.0, 20.0))
K_D = 100.0


def energy(parameters, q, v):
    """Of the cart, and of the hamper at the end of the massless beam, which stands up at q1 = 0."""
    m, M, L, theta, g = parameters
    hamper = np.array([v[2] + L * math.cos(q[0]) * v[0], -L * math.sin(q[0]) * v[0]])
    kinetic = M * v[2] ** 2 + m * hamper @ hamper + theta * (v[0] + v[1]) ** 2
    return 0.5 * kinetic + m * g * L * math.cos(q[0])


@settings(deadline=None, max_examples=200)
@given(physical, triple, triple, st.tuples(force, force, force))
def test_energy_changes_by_the_power_of_the_forces(parameters, q, v, effort):
    a = respond(PLANT, parameters, q, v, effort)
    change = derivative(lambda x, y: energy(parameters, x, y), q, v, a)
    scale = 1.0 + (1.0 + abs(energy(parameters, q, v))) * (1.0 + max(map(abs, a))) ** 2
    assert change == pytest.approx(power(effort, v), abs=1e-7 * scale)


@settings(deadline=None, max_examples=200)
@given(physical, triple, triple, st.tuples(force, force, force))
def test_an_exact_model_inverts_the_plant(parameters, q, v, effort):
    a = respond(PLANT, parameters, q, v, effort)
    found = exert(MODEL, (*parameters, K_D), q, v, a)
    scale = 1.0 + sum(map(abs, a)) * max(MODEL.coefficients((*parameters, K_D)))
    assert found == pytest.approx(effort, abs=1e-12 * scale)


@settings(deadline=None, max_examples=200)
@given(physical, triple, triple, triple)
def test_effort_is_the_regressor_times_the_coefficients(parameters, q, v, r):
    theta = np.array(MODEL.coefficients((*parameters, K_D)))[:5]
    Y = regressor_of(MODEL, q, v, v, r)
    scale = 1.0 + np.abs(Y * theta).sum()
    found = exert(MODEL, (*parameters, K_D), q, v, r)
    assert found == pytest.approx(Y @ theta, abs=1e-14 * scale)


@settings(deadline=None, max_examples=200)
@given(physical, triple, triple, triple, triple)
def test_the_force_of_2_21_holds_the_reference_velocity_and_the_feedback(parameters, q, v, r, s):
    """Q = Y(q, q', q' + S, v') Theta^ + K_D S."""
    theta = np.array(MODEL.coefficients((*parameters, K_D)))[:5]
    reference = [x + y for x, y in zip(v, s, strict=True)]
    Y = regressor_of(MODEL, q, v, reference, r)
    expected = Y @ theta + K_D * np.array(s)
    scale = 1.0 + np.abs(Y * theta).sum() + K_D
    found = exert(MODEL, (*parameters, K_D), q, v, r, s)
    assert found == pytest.approx(expected, abs=1e-14 * scale)


@settings(deadline=None)
@given(triple, triple, triple)
def test_the_rows_of_the_regressor_as_the_experiment_has_them(q, v, a):
    c, s = math.cos(q[0]), math.sin(q[0])
    expected = [
        [c * a[2], a[0], a[1], 0.0, -s],
        [0.0, 0.0, a[0] + a[1], 0.0, 0.0],
        [c * a[0] - s * v[0] ** 2, 0.0, 0.0, a[2], 0.0],
    ]
    assert regressor_of(MODEL, q, v, v, a) == pytest.approx(np.array(expected), abs=1e-13)


@pytest.mark.parametrize(
    ("theta", "good"),
    [
        ((20.0, 60.0, 20.0, 40.0, 200.0), True),
        ((50.0, 175.0, 50.0, 80.0, 400.0), True),
        ((20.0, 60.0, -0.1, 40.0, 200.0), False),
        ((20.0, 25.0, 20.0, 40.0, 200.0), False),
        ((20.0, 60.0, 20.0, 5.0, 200.0), False),
    ],
)
def test_trouble_is_an_inertia_that_is_not_positive_definite(theta, good):
    H = np.array(
        [[theta[1], theta[2], theta[0]], [theta[2], theta[2], 0.0], [theta[0], 0.0, theta[3]]]
    )
    assert bool(np.linalg.eigvalsh(H).min() > 0.0) is good
    assert (MODEL.trouble((*theta, K_D), (0.0, 0.0, 0.0)) == "") is good
