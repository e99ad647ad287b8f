"""The equations of TORA: (2.23) with Q3 = 0, and (3.18)."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.errors import BadInput
from fpt_ros.parameters import resolve
from fpt_ros.plants import tora

EXACT = (20.0, 30.0, 2.0, 20.0, 9.81)
APPROXIMATE = (10.0, 20.0, 2.0, 5.0, 9.81)
NO_ERROR = (0.0, 0.0, 0.0)

rate = st.floats(-3.0, 3.0)
force = st.floats(-300.0, 300.0)
# the cart cannot be driven where cos q1 = 0
angle = st.tuples(st.floats(-1.3, 1.3), st.sampled_from([0.0, math.pi])).map(sum)
physical = st.tuples(
    st.floats(1.0, 50.0),
    st.floats(1.0, 50.0),
    st.floats(0.3, 3.0),
    st.floats(0.5, 50.0),
    st.floats(0.0, 20.0),
)


def respond(parameters, q, v, effort):
    out = [math.nan] * 3
    tora.PLANT.response(tora.PLANT.coefficients(parameters), q, v, effort, out)
    return out


def mass_matrix(parameters, q1):
    m, M, L, theta, _ = parameters
    c = math.cos(q1)
    return np.array(
        [[m * L * L + theta, theta, m * L * c], [theta, theta, 0.0], [m * L * c, 0.0, m + M]]
    )


def energy(parameters, q, v):
    m, _, L, _, g = parameters
    v = np.asarray(v)
    return 0.5 * v @ mass_matrix(parameters, q[0]) @ v + m * g * L * math.cos(q[0])


def momentum(parameters, q, v):
    m, M, L, _, _ = parameters
    return (m + M) * v[2] + m * L * math.cos(q[0]) * v[0]


def derivative_along_the_motion(function, parameters, q, v, a, step=1e-5):
    """Central difference of function(q, v) along q' = v, v' = a."""
    q, v, a = map(np.asarray, (q, v, a))

    def at(s):
        return function(parameters, q + s * v + 0.5 * s * s * a, v + s * a)

    return (at(step) - at(-step)) / (2.0 * step)


def test_coefficients_are_those_printed_in_section_2_4():
    assert tora.PLANT.coefficients((10.0, 30.0, 2.0, 20.0, 10.0)) == (20.0, 60.0, 20.0, 40.0, 200.0)
    printed_initial = (50.0, 175.0, 50.0, 80.0, 400.0)  # (mL, mL^2 + theta, theta, M + m, mgL)
    assert tora.MODEL.coefficients((20.0, 60.0, 2.5, 50.0, 8.0)) == pytest.approx(printed_initial)


def test_coordinates_and_what_the_model_can_prescribe():
    assert tora.PLANT.coordinates == tora.MODEL.coordinates == ("q1", "q2", "q3")
    assert tora.MODEL.controlled == ("q2", "q3")
    assert len(tora.MODEL.coefficient_names) == len(tora.MODEL.coefficients(EXACT)) == 5
    assert tora.MODEL.regressor is None


@settings(deadline=None, max_examples=200)
@given(physical, angle, st.tuples(rate, rate, rate), st.tuples(rate, rate))
def test_an_exact_model_gets_the_response_it_asks_for(parameters, q1, v, wanted):
    q, r, effort = (q1, 0.3, -0.2), (math.nan, *wanted), [math.nan] * 3
    tora.MODEL.effort(tora.MODEL.coefficients(parameters), q, v, r, NO_ERROR, effort)
    assert effort[2] == 0.0
    response = respond(parameters, q, v, effort)
    scale = 1.0 + max(map(abs, effort))
    assert response[1:] == pytest.approx(wanted, abs=1e-11 * scale, rel=1e-9)


@settings(deadline=None, max_examples=200)
@given(physical, angle, st.tuples(rate, rate, rate), st.tuples(force, force, force))
def test_the_response_solves_2_23(parameters, q1, v, effort):
    m, _, L, _, g = parameters
    response = respond(parameters, (q1, 0.0, 0.0), v, effort)
    s = math.sin(q1)
    rest = np.array([-m * g * L * s, 0.0, -m * L * s * v[0] ** 2])
    left = mass_matrix(parameters, q1) @ response + rest
    assert left == pytest.approx(effort, rel=1e-9, abs=1e-7)


@settings(deadline=None, max_examples=100)
@given(physical, angle, st.tuples(rate, rate, rate), st.tuples(force, force, force))
def test_energy_changes_by_the_power_of_the_forces(parameters, q1, v, effort):
    q = (q1, 0.4, -0.1)
    a = respond(parameters, q, v, effort)
    power = sum(x * y for x, y in zip(effort, v, strict=True))
    change = derivative_along_the_motion(energy, parameters, q, v, a)
    scale = 1.0 + abs(energy(parameters, q, v)) * (1.0 + max(map(abs, a))) ** 2
    assert change == pytest.approx(power, abs=1e-7 * scale)


@settings(deadline=None, max_examples=100)
@given(physical, angle, st.tuples(rate, rate, rate), st.tuples(force, force))
def test_momentum_along_the_cart_is_conserved_without_a_force_on_it(parameters, q1, v, effort):
    q = (q1, 0.4, -0.1)
    a = respond(parameters, q, v, (*effort, 0.0))
    m, M, L, _, _ = parameters
    exact = (m + M) * a[2] + m * L * (math.cos(q1) * a[0] - math.sin(q1) * v[0] ** 2)
    scale = (m + M) * (1.0 + max(map(abs, a)))
    assert exact == pytest.approx(0.0, abs=1e-10 * scale)
    change = derivative_along_the_motion(momentum, parameters, q, v, a)
    assert change == pytest.approx(0.0, abs=1e-6 * scale * (1.0 + max(map(abs, a))))


@pytest.mark.parametrize("q1", [0.0, 0.3, -0.7, 1.1, 1.5])
def test_eigenvalues_of_the_response_to_a_wrong_model(q1):
    """H_red^-1 H~_red of (q3'', q2''): triangular, M~ + m~ s^2 over M + m s^2, and theta~/theta."""
    q, v = (q1, 0.0, 0.0), (0.0, 0.0, 0.0)

    def answer(q3_wanted, q2_wanted):
        effort = [0.0] * 3
        wanted = (math.nan, q2_wanted, q3_wanted)
        tora.MODEL.effort(tora.MODEL.coefficients(APPROXIMATE), q, v, wanted, NO_ERROR, effort)
        response = respond(EXACT, q, v, effort)
        return np.array([response[2], response[1]])

    matrix = np.column_stack([answer(1.0, 0.0) - answer(0, 0), answer(0.0, 1.0) - answer(0, 0)])
    s2 = math.sin(q1) ** 2
    assert matrix[0, 1] == pytest.approx(0.0, abs=1e-12)
    assert matrix[0, 0] == pytest.approx((20.0 + 10.0 * s2) / (30.0 + 20.0 * s2), rel=1e-9)
    assert matrix[1, 1] == pytest.approx(0.25, rel=1e-12)
    assert 0.6 <= matrix[0, 0] <= 2.0 / 3.0 + 1e-12


def test_gravity_drives_an_upright_beam_away():
    """The beam points up at q1 = 0: without forces it falls further, pushing the cart back."""
    a = respond(EXACT, (0.1, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    assert a[0] > 0.0
    assert a[2] < 0.0


@pytest.mark.parametrize("name", ["m", "M", "L", "theta"])
def test_masses_lengths_and_inertias_are_positive(name):
    given_values = dict(zip(("m", "M", "L", "theta", "g"), EXACT, strict=True))
    with pytest.raises(BadInput, match=rf"{name}: 0.0 is not valid, it takes a number > 0"):
        resolve(tora.PARAMETERS, {**given_values, name: 0.0}, "plant")
