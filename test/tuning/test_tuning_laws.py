"""Every tuning law against the same thing computed with matrices."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.linalg import solve_continuous_lyapunov

from fpt_ros.parameters import resolve
from fpt_ros.tuning import COEFFICIENTS, GAIN, TUNING_LAWS, WEIGHTS, Seen
from fpt_ros.tuning.lyapunov import second_row
from fpt_ros.tuning.precursor import ALARM, BETA, RATE, guarded, memory_size, observe

DT = 1e-3
SIZE, ROWS, COORDINATES = 5, 3, 3

number = st.floats(-5.0, 5.0)
matrix = arrays(np.float64, (ROWS, SIZE), elements=number)
row = arrays(np.float64, (SIZE,), elements=number)
triple = arrays(np.float64, (ROWS,), elements=number)
NOTHING = [0.0] * COORDINATES


class Law:
    """A law with its constants and its memory."""

    def __init__(self, name, size=SIZE, rows=ROWS, n=COORDINATES, **given_values):
        self.law = TUNING_LAWS[name]
        self.constants = self.law.prepare(resolve(self.law.parameters, given_values, "test"))
        self.memory = [0.0] * self.law.memory(self.constants, size, rows, n)

    def __call__(self, values, Y=(), E=(), tracking=(), h=(), r=()):
        """The values after one cycle."""
        values = list(map(float, values))
        Y = np.ravel(Y).tolist()
        self.law.update(
            self.constants,
            self.memory,
            DT,
            values,
            Seen(Y, list(E), list(tracking), list(h), list(r)),
        )
        return np.array(values)


def test_what_the_laws_tune():
    tunes = {name: TUNING_LAWS[name].tunes for name in TUNING_LAWS.names() if name != "none"}
    assert tunes.pop("gain") == GAIN
    assert tunes.pop("weights") == WEIGHTS
    assert set(tunes.values()) == {COEFFICIENTS}


# --- modified tuning, one row


@settings(deadline=None)
@given(row, row, number, st.floats(0.1, 10.0), st.floats(1e-6, 1.0))
def test_projection_is_2_11(Y, values, E, alpha, epsilon):
    found = Law("projection", rows=1, alpha=alpha, epsilon=epsilon)(values, Y, [E])
    expected = values + DT * alpha * E * Y / (Y @ Y + epsilon)
    assert found == pytest.approx(expected, rel=1e-13, abs=1e-13)


# --- modified tuning, several rows


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


# --- Slotine and Li


@settings(deadline=None)
@given(matrix, row, triple, st.floats(0.005, 1.0))
def test_slotine_li_is_2_20(Y, values, S, gamma):
    tracking = [7.0] * 3 + [8.0] * 3 + S.tolist()
    found = Law("slotine_li", gamma=gamma)(values, Y, NOTHING, tracking)
    expected = values + DT / gamma * (Y.T @ S)
    assert found == pytest.approx(expected, rel=1e-12, abs=1e-12)
    law = TUNING_LAWS["slotine_li"]
    assert (law.reference, law.desired) == (True, True)


# --- Lyapunov


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


# --- the fixed point iteration


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


# --- the calculated gain


@settings(deadline=None)
@given(st.lists(triple, min_size=1, max_size=30), st.floats(0.5, 0.999), st.floats(1e-3, 0.1))
def test_gain_is_3_20_with_the_forgetting_sum_of_3_19(errors, beta, epsilon):
    """The infinite past is filled with the first value: b_1 = ||h_1|| / (1 - beta)."""
    law = Law("gain", size=1, rows=0, beta=beta, epsilon=epsilon)
    b = np.linalg.norm(errors[0]) / (1.0 - beta)
    for k, h in enumerate(errors):
        if k:
            b = beta * b + np.linalg.norm(h)
        (found,) = law([-1.0], h=h)
        assert found == pytest.approx(-0.16 / (epsilon + (1.0 - beta) * b), rel=1e-9)
        assert law.memory[0] == pytest.approx((1.0 - beta) * b, rel=1e-9, abs=1e-12)


def test_the_sign_of_the_gain_is_a_parameter():
    (up,), (down,) = (Law("gain", 1, 0, sign=sign)([0.0], h=[1.0]) for sign in (1.0, -1.0))
    assert up == -down == pytest.approx(0.16 / 1.05)


# --- tuned weights


def weights_by_hand(r, delay, dt, beta=0.99, up=0.5, down=50.0, least=0.1, most=10.0):
    """All weights of a run, a row a cycle, from the whole history of r (cycles x coordinates)."""
    weights, b, rows = np.ones(r.shape[1]), np.zeros(r.shape[1]), []
    for n in range(len(r)):
        if n >= 2 * delay:
            x = (r[n] - r[n - delay]) * (r[n - delay] - r[n - 2 * delay])
            b = beta * b + (1.0 - beta) * x / (np.abs(x) + 1e-12)
            shrunk, grown = weights * (1.0 - down * dt), weights * (1.0 + up * dt)
            weights = np.where(b < 0.0, np.maximum(least, shrunk), np.minimum(most, grown))
        rows.append(weights)
    return np.array(rows)


@pytest.mark.parametrize("delay", [1, 3, 10])
@pytest.mark.parametrize("seed", range(3))
def test_weights_to_the_letter(delay, seed):
    rng = np.random.default_rng(seed)
    t = np.arange(400)[:, None] * DT
    r = np.sin(t * [3.0, 40.0]) + 0.3 * rng.standard_normal((400, 2)) * [1.0, 1e-3]
    law, weights = Law("weights", size=2, rows=0, n=2, delay=delay), np.ones(2)
    expected = weights_by_hand(r, delay, DT)
    for k, each in enumerate(r):
        weights = law(weights, r=each)
        assert weights == pytest.approx(expected[k], rel=1e-12)
    assert (expected[-1] != 1.0).all()


def test_weights_grow_where_r_is_smooth_and_fall_where_it_alternates():
    law, weights = Law("weights", size=2, rows=0, n=3, delay=1), np.ones(2)
    for k in range(20_000):
        weights = law(weights, r=[0.001 * k, math.nan, (-1.0) ** k])
    assert weights.tolist() == [10.0, 0.1]


def test_weights_are_of_controlled_coordinates_only():
    """NaN marks those that are not: the others keep their order."""
    all_of_them, some = Law("weights", 2, 0, 2, delay=2), Law("weights", 2, 0, 4, delay=2)
    a, b = np.ones(2), np.ones(2)
    rng = np.random.default_rng(7)
    for x, y in rng.standard_normal((100, 2)):
        a = all_of_them(a, r=[x, y])
        b = some(b, r=[math.nan, x, math.nan, y])
        assert (a == b).all()


# --- the precursor


def index_of(r):
    """Index after each row of r (cycles x coordinates)."""
    memory = [0.0] * memory_size(r.shape[1])
    return np.array([observe(memory, each.tolist()) for each in r])


def test_the_index_of_a_smooth_and_of_an_alternating_response():
    k = np.arange(500)[:, None]
    assert index_of(0.01 * k)[-1] == pytest.approx(1.0, abs=1e-4)
    assert index_of((-1.0) ** k)[-1] == pytest.approx(-1.0, abs=1e-4)
    period_four = np.array([[0.0], [1.0], [1.0], [0.0]] * 125)
    assert abs(index_of(period_four)[-1]) < 0.1


def test_the_index_to_the_letter():
    r = np.random.default_rng(3).standard_normal((60, 3))
    d = np.diff(np.vstack([np.zeros(3), r]), axis=0)
    p, expected = 0.0, []
    for k in range(60):
        before = d[k - 1] if k else np.zeros(3)
        size = np.linalg.norm(d[k]) * np.linalg.norm(before)
        if size > 0.0:
            p = BETA * p + (1.0 - BETA) * (d[k] @ before) / size
        expected.append(p)
    assert index_of(r) == pytest.approx(np.array(expected), rel=1e-12)


def test_what_is_not_controlled_does_not_count():
    r = np.random.default_rng(4).standard_normal((60, 2))
    padded = np.column_stack([r[:, 0], np.full(60, np.nan), r[:, 1]])
    assert index_of(padded) == pytest.approx(index_of(r), abs=1e-15)


@given(st.floats(0.01, 1.0), st.floats(-1.0, 1.0))
def test_the_guard_lowers_the_gain_while_there_is_an_alarm(factor, index):
    expected = factor * (1.0 - RATE) if index < ALARM else factor
    assert guarded(factor, index) == expected
