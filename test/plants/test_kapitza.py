"""Kapitza's pendulum: its equations against an energy, and the three readings of its law."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mechanics import derivative, exert, respond

from fpt_ros.plants.kapitza import LISTING, LITERAL, PLANT, WITH_GRAVITY

rate = st.floats(-3.0, 3.0)
angle = st.floats(-3.0, 3.0)
physical = st.tuples(
    st.floats(0.3, 5.0), st.floats(0.3, 5.0), st.floats(0.3, 2.0), st.floats(0.0, 20.0)
)
force = st.floats(-100.0, 100.0)


def energy(parameters, q, v):
    """Of the pivot and of the bob, at their positions in the plane."""
    m, M, L, g = parameters
    bob = np.array([L * math.cos(q[1]) * v[1], v[0] - L * math.sin(q[1]) * v[1]])
    kinetic = 0.5 * M * v[0] ** 2 + 0.5 * m * bob @ bob
    return kinetic + g * (M * q[0] + m * (q[0] + L * math.cos(q[1])))


@settings(deadline=None, max_examples=200)
@given(physical, st.tuples(rate, angle), st.tuples(rate, rate), force)
def test_energy_changes_by_the_power_of_the_force(parameters, q, v, drive):
    a = respond(PLANT, parameters, q, v, (drive, 0.0))
    change = derivative(lambda x, y: energy(parameters, x, y), q, v, a)
    scale = 1.0 + abs(energy(parameters, q, v)) * (1.0 + max(map(abs, a))) ** 2
    assert change == pytest.approx(drive * v[0], abs=1e-7 * scale)


@settings(deadline=None, max_examples=200)
@given(physical, st.tuples(rate, angle), st.tuples(rate, rate), force)
def test_the_response_solves_both_rows(parameters, q, v, drive):
    m, M, L, g = parameters
    a1, a2 = respond(PLANT, parameters, q, v, (drive, 0.0))
    s, c = math.sin(q[1]), math.cos(q[1])
    first = (M + m) * a1 - m * L * s * a2 - m * L * c * v[1] ** 2 + (M + m) * g
    second = -m * L * s * a1 + m * L * L * a2 - m * g * L * s
    scale = 1.0 + abs(drive) + (M + m) * (abs(a1) + g) + m * L * (1 + L) * (abs(a2) + v[1] ** 2)
    assert (first, second) == pytest.approx((drive, 0.0), abs=1e-12 * scale)


@settings(deadline=None, max_examples=200)
@given(physical, st.tuples(rate, angle), st.tuples(rate, rate), force)
def test_the_exact_model_of_4_6_inverts_the_plant(parameters, q, v, drive):
    assume(abs(math.sin(q[1])) > 0.05)
    a = respond(PLANT, parameters, q, v, (drive, 0.0))
    effort = exert(WITH_GRAVITY, parameters, q, v, (math.nan, a[1]))
    scale = 1.0 + abs(drive) + max(map(abs, a))
    assert effort == pytest.approx([drive, 0.0], abs=1e-10 * scale)


@settings(deadline=None)
@given(physical, st.tuples(rate, angle), st.tuples(rate, rate), rate)
def test_what_the_other_readings_do_differently(parameters, q, v, r):
    """The listing forgets -g; (4.7) has |q2| in the place of 1."""
    m, M, L, g = parameters
    wanted, sin = (math.nan, r), math.sin(q[1])
    listing, literal, exact = (
        exert(model, parameters, q, v, wanted)[0] for model in (LISTING, LITERAL, WITH_GRAVITY)
    )
    assert listing - exact == pytest.approx((M + m) * g, abs=1e-11 * (1 + abs(exact)))
    assume(abs(sin) > 0.05)
    difference = (M + m) * L * r * (abs(q[1]) - 1.0) / sin
    assert literal - exact == pytest.approx(difference, abs=1e-11 * (1 + abs(exact)))


@pytest.mark.parametrize("q2", [0.0, 1e-12, -1e-12, 0.02, -0.02])
def test_the_readings_are_defined_near_the_upright_position(q2):
    parameters, rest = (2.0, 1.0, 1.0, 9.81), (0.0, 0.0)
    side = -1.0 if q2 <= 0.0 else 1.0
    sin = math.sin(q2)
    listing = exert(LISTING, parameters, (0.0, q2), rest, (math.nan, 1.0))[0]
    expected = 3.0 * side / math.sin(0.05) - 2.0 * sin + 3.0 * 9.81
    assert listing == pytest.approx(expected, rel=1e-12)
    literal = exert(LITERAL, parameters, (0.0, q2), rest, (math.nan, 1.0))[0]
    ratio = 1.0 if abs(sin) < 1e-9 else abs(q2) / sin
    assert literal == pytest.approx(3.0 * (ratio - 9.81) - 2.0 * sin + 3.0 * 9.81, rel=1e-12)


def test_gain_of_the_loop_with_the_approximate_parameters():
    """q2'' follows r with 0.987 |q2| in (4.7), 0.987 to 1.2 in (4.6)."""
    exact, approximate, rest = (2.0, 1.0, 1.0, 9.81), (2.2, 1.5, 0.8, 9.81), (0.0, 0.0)

    def gain(model, q2):
        answers = [
            respond(
                PLANT, exact, (0.0, q2), rest,
                exert(model, approximate, (0.0, q2), rest, (math.nan, r)),
            )[1]
            for r in (0.0, 1.0)
        ]  # fmt: skip
        return answers[1] - answers[0]

    # (M~ + m~ - m~ sin^2) L~ / ((M + m - m sin^2) L): 2.96/3 at 0, growing with |q2|
    for q2 in (0.1, 0.3, -0.3, 0.7):
        s2 = math.sin(q2) ** 2
        expected = 0.8 * (3.7 - 2.2 * s2) / (3.0 - 2.0 * s2)
        assert gain(WITH_GRAVITY, q2) == pytest.approx(expected, rel=1e-9)
        assert 0.98 < gain(WITH_GRAVITY, q2) < 1.2
    for q2 in (1e-3, -1e-3, 0.1, 0.5):
        s2 = math.sin(q2) ** 2
        expected = 0.8 * (3.7 * abs(q2) - 2.2 * s2) / (3.0 - 2.0 * s2)
        assert gain(LITERAL, q2) == pytest.approx(expected, rel=1e-9)
    assert gain(LITERAL, 1e-4) / 1e-4 == pytest.approx(0.987, abs=1e-3)
