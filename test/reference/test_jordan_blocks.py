"""(3.9) to (3.12): Jordan blocks and complex eigenvalues, against binomials written by hand."""

import math

import numpy as np
import pytest
from engine_runs import topics_of

from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import load

NEAR = 1e-7
"""Size of the first response error: the sigmoid is straight there, and 1e-12 counts as none."""

D, K = 0.6, 0.5
HALF = 0.5 * math.acosh(2.0 * math.sinh(D) / K - math.cosh(D))
Y = math.tanh(D / 2 + HALF)  # at the attractive fixed point
SLOPE = (1.0 - Y**2) / (1.0 - (Y - K) ** 2)
"""F'(x*) of F(x) = atanh(tanh x - K) + D."""


def found(variant, A, cycles):
    """Response errors h_m of the engine, from h_0 = M r_0 with r_0 small, and M."""
    desired = (1.0, -1.0, 2.0, 0.5)  # c: the solution is r = 0
    first = NEAR * np.array([0.3, 0.5, -0.4, 1.0])
    settings = (
        f"trajectory_generator.amplitude={list(desired)}",
        f"fpt_deformer.initial_response={first.tolist()}",
        f"fpt_deformer.A={A!r}",
    )
    M = np.array(
        load("affine_map", variant).nodes["plant_simulator"]["exact.matrix"], float
    ).reshape(4, 4)
    topics = topics_of("affine_map", variant, settings, float(cycles + 1))
    response = topics["state_estimate"].vectors["accelerations"][1:]
    return response - desired, M, M @ first


def assert_follows(h, expected):
    """Within 1e-4 of its size: rounding is 1e-16 of the numbers that h is a difference of."""
    size = np.linalg.norm(expected, axis=1)
    large = size > 1e-10
    assert large.sum() > 20
    off = np.linalg.norm(h - expected, axis=1)
    assert (off[large] / size[large]).max() < 1e-4


@pytest.mark.parametrize("A", [-0.5, -1.5])
def test_a_jordan_block_of_four(A):
    """h_m = sum over s of m! / (s! (m-s)!) (1 + lambda mu)^(m-s) mu^s H^s h_0 (3.11)."""
    h, M, h_0 = found("adaptive", A, 120)
    mu, lam, H = SLOPE * A, 0.3, np.eye(4, k=1)
    assert np.array_equal(M, lam * np.eye(4) + H)
    rows = []
    for m in range(len(h)):
        terms = [
            math.comb(m, s) * (1.0 + lam * mu) ** (m - s) * mu**s * np.linalg.matrix_power(H, s)
            for s in range(min(m, 3) + 1)
        ]
        rows.append(sum(terms) @ h_0)
    expected = np.array(rows)
    assert_follows(h, expected)
    size = np.linalg.norm(expected, axis=1)
    assert size.max() > 1.2 * size[0]  # it grows first, though |1 + lambda mu| < 1


@pytest.mark.parametrize("A", [-0.4, -1.2])
def test_two_complex_jordan_blocks(A):
    """The same with lambda = 0.8 + 0.6i and blocks of two: x1 + i x2 over x3 + i x4."""
    h, _, h_0 = found("complex_jordan", A, 60)
    mu, lam = SLOPE * A, 0.8 + 0.6j
    upper, lower = h_0[0] + 1j * h_0[1], h_0[2] + 1j * h_0[3]
    rows = []
    for m in range(len(h)):
        q = 1.0 + lam * mu
        above = q**m * upper + (m * q ** (m - 1) * mu * lower if m else 0.0)
        below = q**m * lower
        rows.append([above.real, above.imag, below.real, below.imag])
    assert_follows(h, np.array(rows))


def test_complex_eigenvalues():
    """By their own eigenvectors: each part turns by arg(1 + lambda mu) and shrinks by its size."""
    A = -0.5
    h, M, h_0 = found("complex", A, 60)
    values, vectors = np.linalg.eig(M)
    assert sorted(values, key=lambda z: (z.real, z.imag)) == pytest.approx(
        [0.5 - 0.8j, 0.5 + 0.8j, 1.0 - 1.0j, 1.0 + 1.0j]
    )
    parts = np.linalg.solve(vectors, h_0)
    powers = (1.0 + SLOPE * A * values) ** np.arange(len(h))[:, None]
    assert_follows(h, ((powers * parts) @ vectors.T).real)


@pytest.mark.parametrize(
    ("variant", "values"),
    [("adaptive", [0.3]), ("complex", [1 + 1j, 0.5 + 0.8j]), ("complex_jordan", [0.8 + 0.6j])],
)
def test_it_converges_up_to_the_bound_of_3_14(variant, values):
    bound = min(2.0 * z.real / abs(z) ** 2 for z in values) / SLOPE
    inside, outside = (
        np.linalg.norm(found(variant, -part * bound, 1500)[0], axis=1) for part in (0.9, 1.1)
    )
    assert inside[-1] < 1e-3 * NEAR
    assert outside[-1] > 1e2 * NEAR


def test_a_matrix_of_another_size_is_refused():
    with pytest.raises(BadInput, match=r"exact\.matrix: 3 numbers given, for an offset of 4"):
        load("affine_map", settings=["plant_simulator.exact.matrix=[1.0, 0.0, 1.0]"]).loop()
