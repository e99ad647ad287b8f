"""The inner fixed point iteration against its equations."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from tuning_strategies import DT, ROWS, SIZE, Law, matrix, row, triple


def inner(M, E, w, steps, A, D, star):
    """w <- G(w, M w, E) with arrays."""
    for _ in range(steps):
        h = M @ w - E
        size = np.linalg.norm(h)
        if size > 1e-12:
            w = w + (math.atanh(0.5 * math.tanh(A * size + star + D)) - star) * h / size
    return w, float(np.linalg.norm(M @ w - E))


@settings(deadline=None)
@given(matrix, row, triple, st.integers(1, 6), st.booleans(), st.booleans(), st.floats(-3.0, -0.5))
def test_fixed_point_to_the_letter(Y, values, E, steps, warm, scaled, A):
    assume(np.linalg.norm(Y) > 0.5)
    M, star = Y @ Y.T, 0.2594563670316665
    law = Law("fixed_point", inner_steps=steps, warm=warm, scaled=scaled, inner_A=A)
    w = np.zeros(ROWS)
    for _ in range(3):
        w, residual = inner(
            M, E, w if warm else np.zeros(ROWS), steps, A / np.linalg.norm(M) if scaled else A,
            0.3, star,
        )  # fmt: skip
        expected = values + DT * 0.3 * (Y.T @ w)
        found = law(values, Y, E)
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-9)
        assert law.memory[:2] == pytest.approx([np.linalg.norm(E), residual], rel=1e-6, abs=1e-9)
    assert law.law.signals == ("known_term", "inner_residual")


@settings(deadline=None, max_examples=50)
@given(matrix, triple)
def test_the_inner_iteration_converges_to_the_solution_of_the_linear_system(Y, E):
    M = Y @ Y.T
    eigenvalues = np.linalg.eigvalsh(M)
    assume(eigenvalues[0] > 0.02 * eigenvalues[-1] > 0.02)
    law = Law("fixed_point", inner_steps=1000, alpha=1.0)
    for _ in range(3):
        found = law(np.zeros(SIZE), Y, E) / DT
    assert law.memory[1] == pytest.approx(0.0, abs=1e-9)
    assert found == pytest.approx(Y.T @ np.linalg.solve(M, E), abs=1e-6)


def test_the_printed_gain_does_not_converge_where_the_scaled_one_does():
    """Largest eigenvalue of Y Y^T above 1.68 with A = -3."""
    Y, E = np.diag([3.0, 2.0, 1.5]) @ np.eye(ROWS, SIZE), np.array([1.0, 2.0, -1.0])
    scaled, printed = (
        Law("fixed_point", inner_steps=300, scaled=scaled) for scaled in (True, False)
    )
    for law in (scaled, printed):
        law(np.zeros(SIZE), Y, E)
    assert scaled.memory[1] < 1e-9
    assert printed.memory[1] > 0.1
