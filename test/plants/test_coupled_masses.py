"""Two masses on springs: (2.29)."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mechanics import derivative, exert, power, regressor_of, respond

from fpt_ros.plants.coupled_masses import MODEL, PLANT

number = st.floats(-3.0, 3.0)
pair = st.tuples(number, number)
force = st.floats(-100.0, 100.0)
mass, stiffness, length = st.floats(0.3, 5.0), st.floats(1.0, 80.0), st.floats(0.0, 1.0)
friction = st.floats(0.0, 3.0)
physical = st.tuples(
    mass, mass, stiffness, stiffness, length, length, friction, friction, st.floats(0.0, 20.0)
)


def test_coefficients_are_those_of_the_experiment():
    exact = (2.0, 3.0, 50.0, 40.0, 0.5, 0.5, 1.0, 1.5, 9.81)
    expected = (2.0, 19.62, 50.0, 25.0, 40.0, 20.0, 1.0, 3.0, 29.43, 1.5)
    assert PLANT.coefficients(exact) == pytest.approx(expected, rel=1e-15)
    approximate = (1.5, 2.0, 40.0, 50.0, 0.6, 0.4, 2.0, 1.0, 9.81)
    expected = (1.5, 14.715, 40.0, 24.0, 50.0, 20.0, 2.0, 2.0, 19.62, 1.0)
    assert MODEL.coefficients(approximate) == pytest.approx(expected, rel=1e-15)


def energy(parameters, q, v):
    """q is downwards: heights are -q."""
    m1, m2, k1, k2, L1, L2, _, _, g = parameters
    springs = k1 * (q[0] - L1) ** 2 + k2 * (q[1] - q[0] - L2) ** 2
    return 0.5 * (m1 * v[0] ** 2 + m2 * v[1] ** 2 + springs) - g * (m1 * q[0] + m2 * q[1])


@settings(deadline=None, max_examples=200)
@given(physical, pair, pair, st.tuples(force, force))
def test_energy_changes_by_the_power_of_the_forces_less_the_dissipation(parameters, q, v, effort):
    a = respond(PLANT, parameters, q, v, effort)
    change = derivative(lambda x, y: energy(parameters, x, y), q, v, a)
    dissipation = parameters[6] * v[0] ** 2 + parameters[7] * v[1] ** 2
    scale = 1.0 + abs(energy(parameters, q, v)) * (1.0 + max(map(abs, a))) ** 2
    assert change == pytest.approx(power(effort, v) - dissipation, abs=1e-7 * scale)


@settings(deadline=None, max_examples=200)
@given(physical, pair, pair, st.tuples(force, force))
def test_an_exact_model_inverts_the_plant(parameters, q, v, effort):
    a = respond(PLANT, parameters, q, v, effort)
    assert exert(MODEL, parameters, q, v, a) == pytest.approx(effort, abs=1e-11)


@settings(deadline=None, max_examples=200)
@given(physical, pair, pair, pair)
def test_effort_is_the_regressor_times_the_coefficients(parameters, q, v, r):
    Y, theta = regressor_of(MODEL, q, v, v, r), np.array(MODEL.coefficients(parameters))
    scale = 1.0 + np.abs(Y * theta).sum()
    assert exert(MODEL, parameters, q, v, r) == pytest.approx(Y @ theta, abs=1e-14 * scale)


def test_a_model_that_lost_a_mass_says_so():
    theta = list(MODEL.coefficients((1.5, 2.0, 40.0, 50.0, 0.6, 0.4, 2.0, 1.0, 9.81)))
    assert MODEL.trouble(theta, (0.5, 1.5)) == ""
    theta[7] = -0.1
    assert "m2 = -0.1 kg has to be > 0" in MODEL.trouble(theta, (0.5, 1.5))
