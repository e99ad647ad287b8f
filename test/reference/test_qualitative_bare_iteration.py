"""Classes of the bare iteration of chapter 3, and how fast it converges."""

import numpy as np
import pytest
from engine_runs import topics_of

from fpt_ros.engine.engine import Engine
from fpt_ros.errors import Diverged
from fpt_ros.experiments import experiment


def response_errors(topics):
    """h_k = f(r_{k-1}) - r_k^Des of the cycles k >= 1, controlled coordinates."""
    desired, estimate = topics["desired"], topics["state_estimate"]
    return np.column_stack(
        [
            estimate.column("accelerations", name)[1:] - desired.column("accelerations", name)[1:]
            for name in desired.names
        ]
    )


def scalar_errors(A, cycles=None, variant="adaptive"):
    """h_0, h_1, ... of f(r) = r + 1 with r^Des = -2."""
    topics = topics_of("siso_affine", variant, [f"fpt_deformer.A={A}"], duration=cycles)
    return topics["command"].column("accelerations", "x1") + 1.0 + 2.0


def first_below(errors, limit):
    return next(i for i, h in enumerate(errors) if abs(h) < limit)


@pytest.mark.parametrize(
    ("variant", "limit", "iterations"),
    [
        ("adaptive", 1e-6, 38),
        ("fast", 1e-2, 3),
        ("fast", 1e-6, 9),
        ("precursor", 1e-3, 147),
        ("precursor", 1e-6, 411),
    ],
)
def test_iterations_until_the_scalar_map_has_converged(variant, limit, iterations):
    errors = topics_of("siso_affine", variant, duration=500)["command"].column(
        "accelerations", "x1"
    )
    assert first_below(errors + 3.0, limit) == iterations


def test_first_errors_of_chaos():
    errors = topics_of("siso_affine", "chaos")["command"].column("accelerations", "x1") + 3.0
    expected = [-1.0, -0.563789, -0.128312, 0.184655, -1.2847, -0.848484]
    assert errors[:6] == pytest.approx(expected, abs=6e-5)
    assert np.std(errors[-1000:]) > 0.3


def test_chaos_is_bounded_and_sensitive():
    """r in [-4.391, -2.811] over the last 1000 of 4000; Lyapunov exponent about 0.58."""
    r = topics_of("siso_affine", "chaos", duration=4000)["command"].column("accelerations", "x1")
    assert r[-1000:].min() == pytest.approx(-4.391, abs=0.02)
    assert r[-1000:].max() == pytest.approx(-2.811, abs=0.02)
    x = -6.0 * (r + 3.0) + 0.7130913716914226
    y = np.tanh(x)
    slope = 1.0 - 6.0 * (1.0 - y * y) / (1.0 - (y - 0.5) ** 2)  # of r -> r'
    assert np.mean(np.log(np.abs(slope[500:]))) == pytest.approx(0.58, abs=0.05)


@pytest.mark.parametrize(
    ("A", "kind"),
    [
        (-1.5, "monotonic"),
        (-1.7, "alternating"),
        (-3.1, "alternating"),
        (-3.3, "period 2"),
        (-3.9, "period 2"),
        (-4.05, "period 4"),
        (-5.0, "period 3"),
        (-6.3, "bounded"),
    ],
)
def test_classes_of_the_scalar_map(A, kind):
    errors = scalar_errors(A, 4000)
    late = errors[-12:]
    if kind == "monotonic":
        reached = first_below(errors, 1e-9)
        assert (errors[:reached] < 0.0).all()
    elif kind == "alternating":
        assert abs(errors[-1]) < 1e-9
        size = first_below(errors, 1e-5)
        assert errors[size] * errors[size + 1] < 0.0
    elif kind.startswith("period"):
        period = int(kind.split()[1])
        assert late[period:] == pytest.approx(late[:-period], abs=1e-8)
        for shorter in range(1, period):
            assert np.abs(late[shorter:] - late[:-shorter]).max() > 1e-3
    else:
        assert (A * errors > -1.2623975160).all()  # in the domain of F
        assert np.abs(late[6:] - late[:6]).max() > 1e-3


def test_beyond_the_border_the_orbit_leaves_the_domain():
    with pytest.raises(Diverged, match="outside the domain of the transformation"):
        topics_of("siso_affine", settings=["fpt_deformer.A=-6.5"], duration=20_000)


def test_the_printed_sign_of_a_does_not_converge_in_two_dimensions():
    engine = Engine(experiment.load("mimo_affine", "printed_sign").loop())
    try:
        engine.run()
    except Diverged:
        return
    h = np.linalg.norm(response_errors(engine.topics()), axis=1)
    assert h[-1] > h[len(h) // 2] > 10.0


@pytest.mark.parametrize(("variant", "limits"), [("adaptive", (54, 105)), ("fast", (38, 74))])
def test_iterations_until_the_map_of_two_coordinates_has_converged(variant, limits):
    """f(r_k) is seen in cycle k + 1."""
    norms = np.linalg.norm(response_errors(topics_of("mimo_affine", variant)), axis=1)
    assert (first_below(norms, 1e-3), first_below(norms, 1e-6)) == limits
