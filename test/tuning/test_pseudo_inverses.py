"""Tuning by pseudo-inverses against NumPy's, and full matrices R, Q and Gamma against SciPy's."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import solve_continuous_lyapunov

from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import load
from fpt_ros.tuning import TUNING_LAWS, Seen

DT = 0.01
SHAPES = st.integers(1, 4).flatmap(lambda r: st.tuples(st.just(r), st.integers(r, 9)))


def changed(method, Y, error, tracking=(), **values):
    """The change of Theta in a cycle, per time."""
    law = TUNING_LAWS[method]
    own = {p.name: p.default for p in law.parameters} | values
    rows, size = Y.shape
    constants = law.prepare(own)
    theta = [1.0] * size
    memory = [0.0] * law.memory(constants, size, rows, rows)
    seen = Seen(Y.ravel().tolist(), list(error), list(tracking), [], [])
    law.update(constants, memory, DT, theta, seen)
    return (np.array(theta) - 1.0) / DT


def drawn(shape, seed):
    random = np.random.default_rng(seed)
    return random.normal(size=shape), random.normal(size=shape[0])


@given(SHAPES, st.integers(0, 1000))
def test_moore_penrose_is_numpys_pinv(shape, seed):
    Y, a = drawn(shape, seed)
    found = changed("moore_penrose", Y, a, alpha=2.0)
    assert found == pytest.approx(2.0 * np.linalg.pinv(Y) @ a, rel=1e-6, abs=1e-7)


@given(SHAPES, st.integers(0, 1000), st.floats(1e-3, 10.0))
def test_damped_is_tikhonovs(shape, seed, mu):
    Y, a = drawn(shape, seed)
    expected = Y.T @ np.linalg.solve(Y @ Y.T + mu * np.eye(shape[0]), a)
    assert changed("damped", Y, a, mu=mu) == pytest.approx(expected, rel=1e-8, abs=1e-9)


@given(SHAPES, st.integers(0, 1000), st.floats(0.01, 3.0))
def test_truncated_svd_leaves_out_what_is_not_sure(shape, seed, least):
    Y, a = drawn(shape, seed)
    U, sigma, V = np.linalg.svd(Y, full_matrices=False)
    expected = sum(
        (u @ a) / s * v for u, s, v in zip(U.T, sigma, V, strict=True) if s > least
    ) + np.zeros(shape[1])
    found = changed("truncated_svd", Y, a, sigma_0=least)
    assert found == pytest.approx(expected, rel=1e-8, abs=1e-9)


def test_at_a_singularity_one_has_no_answer_and_the_others_do():
    Y, a = np.array([[1.0, 2.0, 0.0], [2.0, 4.0, 0.0]]), np.array([1.0, 2.0])
    assert np.isnan(changed("moore_penrose", Y, a)).all()
    least = np.linalg.pinv(Y) @ a
    assert changed("truncated_svd", Y, a, sigma_0=1e-3) == pytest.approx(least)
    assert changed("damped", Y, a, mu=1e-6) == pytest.approx(least, abs=1e-6)
    assert changed("gram_schmidt", Y, a, epsilon=1e-9) == pytest.approx(least, abs=1e-6)


def test_with_independent_rows_gram_schmidt_gives_the_pseudo_inverse_too():
    """For the given known term, without a complete generalised inverse (thesis, chapter 2)."""
    Y, a = drawn((3, 8), 7)
    found = changed("gram_schmidt", Y, a, epsilon=1e-12)
    assert found == pytest.approx(np.linalg.pinv(Y) @ a, rel=1e-8)


MATRIX = [3.0, 0.5, 0.1, 0.5, 2.0, 0.2, 0.1, 0.2, 1.0]


def test_lyapunov_with_full_matrices():
    Y, e, Q, lam = np.array([[1.0, -2.0, 0.5]]), (0.3, -0.1, 0.0), [5.0, 1.0, 1.0, 2.0], 4.0
    A = np.array([[0.0, 1.0], [-(lam**2), -2.0 * lam]])
    P = solve_continuous_lyapunov(A.T, -np.reshape(Q, (2, 2)))
    assert pytest.approx(-np.reshape(Q, (2, 2))) == A.T @ P + P @ A
    expected = np.linalg.solve(np.reshape(MATRIX, (3, 3)), Y[0]) * (P[1] @ e[:2])
    found = changed("lyapunov", Y, [0.0], e, relaxation=lam, Q_matrix=Q, R_matrix=MATRIX)
    assert found == pytest.approx(expected, rel=1e-9)


def test_matrices_that_are_multiples_of_the_identity_are_the_scalars():
    Y, e = np.array([[1.0, -2.0, 0.5]]), (0.3, -0.1, 0.0)
    scalar = changed("lyapunov", Y, [0.0], e, R=2.0, Q=7.0)
    matrix = changed(
        "lyapunov",
        Y,
        [0.0],
        e,
        R_matrix=(2.0 * np.eye(3)).ravel().tolist(),
        Q_matrix=[7.0, 0.0, 0.0, 7.0],
    )
    assert matrix == pytest.approx(scalar, rel=1e-12)


def test_slotine_li_with_a_full_gamma():
    Y, _ = drawn((2, 3), 3)
    s = np.array([0.4, -0.7])
    expected = np.linalg.solve(np.reshape(MATRIX, (3, 3)), Y.T @ s)
    found = changed("slotine_li", Y, [0.0, 0.0], (0, 0, 0, 0, *s), gamma_matrix=MATRIX)
    assert found == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ("R_matrix=[1.0, 2.0]", "2 numbers are no square matrix"),
        ("R_matrix=[1.0]", "1 numbers given, 36 needed for the 6"),
        ("Q_matrix=[1.0, 0.0, 0.0, -1.0]", "least eigenvalue is -1"),
        ("Q_matrix=[1.0, 0.5, 0.0, 1.0]", "not symmetric"),
    ],
)
def test_other_matrices_are_refused(setting, message):
    with pytest.raises(BadInput, match=message):
        load("vdp_aidc", settings=[f"parameter_tuner.{setting}"])
