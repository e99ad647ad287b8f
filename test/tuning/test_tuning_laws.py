"""The tuning of coefficients against its equations."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.linalg import solve_continuous_lyapunov
from tuning_strategies import COORDINATES, DT, SIZE, Law, matrix, number, row, triple

from fpt_ros.tuning import COEFFICIENTS, GAIN, TUNING_LAWS, WEIGHTS
from fpt_ros.tuning.lyapunov import second_row

NOTHING = [0.0] * COORDINATES


def test_what_the_laws_tune():
    tunes = {name: TUNING_LAWS[name].tunes for name in TUNING_LAWS.names() if name != "none"}
    assert tunes.pop("gain") == GAIN
    assert tunes.pop("weights") == WEIGHTS
    assert set(tunes.values()) == {COEFFICIENTS}


@settings(deadline=None)
@given(row, row, number, st.floats(0.1, 10.0), st.floats(1e-6, 1.0))
def test_projection_is_2_11(Y, values, E, alpha, epsilon):
    found = Law("projection", rows=1, alpha=alpha, epsilon=epsilon)(values, Y, [E])
    expected = values + DT * alpha * E * Y / (Y @ Y + epsilon)
    assert found == pytest.approx(expected, rel=1e-13, abs=1e-13)


def gram_schmidt_rate(Y, E, epsilon):
    """Section 2.4.2 row by row with arrays."""
    rows, known, total = [], [], np.zeros(Y.shape[1])
    for z, a in zip(Y, E, strict=True):
        for other, b in zip(rows, known, strict=True):
            f = z @ other / (other @ other + epsilon)
            z, a = z - f * other, a - f * b
        rows.append(z)
        known.append(a)
        total = total + a * z / (z @ z + epsilon)
    return total


@settings(deadline=None)
@given(matrix, row, triple, st.floats(0.1, 5.0), st.floats(1e-3, 2.0))
def test_gram_schmidt_to_the_letter(Y, values, E, alpha, epsilon):
    found = Law("gram_schmidt", alpha=alpha, epsilon=epsilon)(values, Y, E)
    expected = values + DT * alpha * gram_schmidt_rate(Y, E, epsilon)
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-9)


@settings(deadline=None)
@given(matrix, triple)
def test_gram_schmidt_without_regularisation_is_the_least_change_that_explains_the_error(Y, E):
    """With Y^T = Q R, the columns of Q are the z_i / ||z_i||: the minimal solution of Y x = E."""
    assume(np.linalg.svd(Y, compute_uv=False).min() > 0.3)
    found = Law("gram_schmidt", alpha=1.0, epsilon=1e-14)(np.zeros(SIZE), Y, E) / DT
    assert Y @ found == pytest.approx(E, abs=1e-9)
    Q, R = np.linalg.qr(Y.T)
    assert found == pytest.approx(Q @ np.linalg.solve(R.T, E), abs=1e-9)


@settings(deadline=None)
@given(matrix, row)
def test_gram_schmidt_lets_every_known_term_decay(Y, deviation):
    """E = Y (Theta - Theta^): with the same Y each term is 1 - alpha dt times as large."""
    assume(np.linalg.svd(Y, compute_uv=False).min() > 0.3)
    E = Y @ deviation
    change = Law("gram_schmidt", alpha=2.0, epsilon=1e-14)(np.zeros(SIZE), Y, E)
    assert Y @ (deviation - change) == pytest.approx((1.0 - 2.0 * DT) * E, abs=1e-10)


def test_gram_schmidt_of_a_row_that_vanishes_or_repeats():
    Y = np.array([[1.0, 0, 0, 0, 0], [1.0, 0, 0, 0, 0], [0.0, 0, 0, 0, 0]])
    found = Law("gram_schmidt")(np.zeros(SIZE), Y, [1.0, 1.0, 5.0])
    assert np.isfinite(found).all()
    assert (found[1:] == 0.0).all()


@settings(deadline=None)
@given(matrix, row, triple, st.floats(0.005, 1.0))
def test_slotine_li_is_2_20(Y, values, S, gamma):
    tracking = [7.0] * 3 + [8.0] * 3 + S.tolist()
    found = Law("slotine_li", gamma=gamma)(values, Y, NOTHING, tracking)
    expected = values + DT / gamma * (Y.T @ S)
    assert found == pytest.approx(expected, rel=1e-12, abs=1e-12)
    law = TUNING_LAWS["slotine_li"]
    assert (law.reference, law.desired) == (True, True)


@pytest.mark.parametrize(("lam", "q"), [(10.0, 100.0), (1.0, 1.0), (3.0, 0.2), (25.0, 7.0)])
def test_the_second_row_of_p_solves_the_lyapunov_equation(lam, q):
    A = np.array([[0.0, 1.0], [-lam * lam, -2.0 * lam]])
    P = solve_continuous_lyapunov(A.T, -q * np.eye(2))
    assert second_row(lam, q) == pytest.approx(P[1], rel=1e-9)


def test_the_matrix_p_of_the_experiment():
    assert second_row(10.0, 100.0) == pytest.approx((0.5, 2.525), rel=1e-14)


@settings(deadline=None)
@given(row, row, number, number, st.floats(0.1, 10.0))
def test_lyapunov_is_2_10(Y, values, e, e_dot, R):
    assume(abs(values[0]) > 0.1)
    found = Law("lyapunov", rows=1, R=R)(values, Y, [0.0], [e, e_dot, 99.0])
    expected = values + DT * (0.5 * e + 2.525 * e_dot) * Y / (values[0] * R)
    assert found == pytest.approx(expected, rel=1e-12, abs=1e-12)
