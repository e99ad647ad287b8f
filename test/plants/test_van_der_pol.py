"""The fifth order van der Pol oscillator: (2.1), (2.2), (2.3)."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.plants import van_der_pol

number = st.floats(-5.0, 5.0)
physical = st.tuples(st.floats(0.5, 20.0), *[st.floats(-50.0, 50.0)] * 5)


def test_coefficients_are_those_of_the_experiment():
    assert van_der_pol.PLANT.coefficients((10, 1, 3, 100, 1, 2)) == (10, 1, 3, 100, 1, 2)
    assert van_der_pol.MODEL.coefficients((9, 2, 3.5, 110, 0.9, 1.5)) == (9, 2, 7, 110, 0.9, 1.5)


@settings(deadline=None)
@given(physical, number, number, number)
def test_an_exact_model_gets_the_response_it_asks_for(parameters, q, v, wanted):
    theta = van_der_pol.MODEL.coefficients(parameters)
    effort, response = [math.nan], [math.nan]
    van_der_pol.MODEL.effort(theta, [q], [v], [wanted], [0.0], effort)
    van_der_pol.PLANT.response(theta, [q], [v], effort, response)
    assert response[0] == pytest.approx(wanted, rel=1e-12, abs=1e-14 * (1.0 + abs(effort[0])))


@settings(deadline=None)
@given(physical, number, number, number)
def test_effort_is_the_regressor_times_the_coefficients(parameters, q, v, wanted):
    theta = van_der_pol.MODEL.coefficients(parameters)
    effort, row = [math.nan], [math.nan] * 6
    van_der_pol.MODEL.effort(theta, [q], [v], [wanted], [0.0], effort)
    van_der_pol.MODEL.regressor((), [q], [v], [math.nan], [wanted], row)
    terms = [y * x for y, x in zip(row, theta, strict=True)]
    assert effort[0] == pytest.approx(sum(terms), abs=1e-14 * sum(map(abs, terms)))


@settings(deadline=None)
@given(physical, number, number, number)
def test_the_response_solves_2_1_as_printed(parameters, q, v, force):
    m, mu, c, k, beta, lam = parameters
    out = [math.nan]
    van_der_pol.PLANT.response(van_der_pol.PLANT.coefficients(parameters), [q], [v], [force], out)
    terms = (m * out[0], mu * q**2 * v, -mu * c * v, k * q, beta * q**3, lam * q**5)
    assert sum(terms) == pytest.approx(force, abs=1e-13 * (1.0 + sum(map(abs, terms))))


@settings(deadline=None)
@given(number, number, number)
def test_power_balance(q, v, force):
    """E = m v^2/2 + k q^2/2 + beta q^4/4 + lambda q^6/6 changes by F v less the damper's power."""
    parameters = m, mu, c, k, beta, lam = (10.0, 1.0, 3.0, 100.0, 1.0, 2.0)
    out = [math.nan]
    van_der_pol.PLANT.response(van_der_pol.PLANT.coefficients(parameters), [q], [v], [force], out)
    a = out[0]

    def energy(s):
        x, y = q + s * v + 0.5 * s * s * a, v + s * a
        return m * y**2 / 2 + k * x**2 / 2 + beta * x**4 / 4 + lam * x**6 / 6

    step = 1e-6
    change = (energy(step) - energy(-step)) / (2.0 * step)
    power = force * v - mu * (q * q - c) * v * v
    assert change == pytest.approx(power, rel=1e-6, abs=1e-5 * (1.0 + abs(energy(0.0))))


def test_the_regressor_has_as_many_columns_as_the_model_coefficients():
    model = van_der_pol.MODEL
    assert model.rows == 1
    assert len(model.coefficient_names) == 6
    assert model.controlled == model.coordinates == van_der_pol.PLANT.coordinates == ("q1",)
