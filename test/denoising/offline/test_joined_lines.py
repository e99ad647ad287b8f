"""Joined regression lines: hat functions against Lagrange multipliers, (6.12) and (6.13)."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.denoising.offline.joined_lines import joined_lines


def by_multipliers(y, knots):
    """The KKT equations of all (m_i, b_i) and one multiplier an inner knot."""
    n = len(y)
    at = [0, *knots, n - 1]
    sections = len(at) - 1
    size = 2 * sections
    A = np.zeros((size + sections - 1, size + sections - 1))
    right = np.zeros(len(A))
    members = [np.arange(at[i] + (i > 0), at[i + 1] + 1) for i in range(sections)]
    for i, x in enumerate(members):
        m, b = 2 * i, 2 * i + 1
        A[m, m], A[m, b], A[b, m], A[b, b] = x @ x, x.sum(), x.sum(), len(x)
        right[m], right[b] = x @ y[x], y[x].sum()
    for i, x in enumerate(at[1:-1]):
        row = size + i
        A[row, 2 * i : 2 * i + 4] = [x, 1.0, -x, -1.0]
        A[2 * i : 2 * i + 4, row] = A[row, 2 * i : 2 * i + 4]
    solution = np.linalg.solve(A, right)[:size].reshape(-1, 2)
    return np.concatenate([m * x + b for (m, b), x in zip(solution, members, strict=True)])


@pytest.mark.parametrize("knots", [[25], [10, 30], [7, 15, 22, 40, 48], []])
def test_it_is_the_solution_with_lagrange_multipliers(knots):
    y = np.random.default_rng(3).standard_normal(60).cumsum()
    found = joined_lines(y, np.array(knots, dtype=np.int64))
    assert found == pytest.approx(by_multipliers(y, knots), abs=1e-10)


@settings(deadline=None, max_examples=40)
@given(st.sets(st.integers(1, 48), max_size=20), st.integers(0, 10**6))
def test_no_other_joined_lines_are_nearer(knots, seed):
    rng = np.random.default_rng(seed)
    y = rng.standard_normal(50)
    at = np.array(sorted(knots), dtype=np.int64)
    found = joined_lines(y, at)
    corners = np.unique(np.concatenate(([0], at, [49])))
    other = np.interp(np.arange(50), corners, rng.standard_normal(len(corners)))
    assert abs((y - found) @ other) < 1e-11, "the residual is orthogonal to all of them"
    assert np.interp(np.arange(50), corners, found[corners]) == pytest.approx(found, abs=1e-12)


def test_what_is_made_of_lines_remains():
    y = np.interp(np.arange(100), [0, 20, 50, 99], [1.0, -3.0, 8.0, 0.5])
    assert joined_lines(y, np.array([20, 50])) == pytest.approx(y, abs=1e-12)
