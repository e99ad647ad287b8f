"""Three examples of public code (krisztiankosi/Control): its figures, and loops by hand."""

import math

import numpy as np
import pytest
from engine_runs import settled_rms, topics_of


@pytest.mark.parametrize(
    ("name", "variant", "settle", "expected"),
    [
        ("duffing", "adaptive", 3.0, 1.3050437686863e-3),
        ("duffing", "nonadaptive", 3.0, 5.130310158558e-3),
        ("vdp_second_order", "adaptive", 5.0, 3.269931829209e-5),
        ("vdp_second_order", "nonadaptive", 5.0, 1.2057973074e-2),
    ],
)
def test_settled_errors_of_the_source(name, variant, settle, expected):
    assert settled_rms(topics_of(name, variant), settle)["q1"] == pytest.approx(expected, rel=3e-9)


def lorenz_by_hand(relax, cycles):
    """Errors of the Lorenz system under a prescription, without any transformation, in NumPy."""
    amplitude, rate = np.array([2.0, 3.8, 1.5]), np.array([0.5, 0.7, 0.9])
    sigma, beta, rho, dt = 5.0, 8.0 / 3.0, 40.0, 1e-3
    q, integral, errors = np.zeros(3), np.zeros(3), []
    for k in range(cycles):
        t = k * dt
        e = amplitude * np.sin(rate * t) - q
        errors.append(e)
        wanted = relax(amplitude * rate * np.cos(rate * t), e, integral)
        x, y, z = q
        model = np.array([sigma * (y - x), x * (rho - z), y - beta * z])
        exact = np.array([sigma * (y - x), x * (rho - z) - y, x * y - beta * z])
        integral = integral + dt * e
        q = q + dt * (exact + wanted - model)
    return np.array(errors)


def pi(rate, e, integral):
    return rate + 24.0 * e + 144.0 * integral


def vssm(rate, e, integral):
    return rate + 12.0 * e + 500.0 * np.tanh(12.0 * integral + e)


@pytest.mark.parametrize(("variant", "relax"), [("nonadaptive", pi), ("vssm", vssm)])
def test_lorenz_against_a_loop_by_hand(variant, relax):
    """Sliding mode of the source: K = 500, w = 1, Lambda = 12."""
    topics = topics_of("lorenz", variant, duration=6.0)
    desired, measured = topics["desired"], topics["joint_states"]
    errors = np.array(
        [desired.column("positions", i) - measured.column("position", i) for i in "xyz"]
    ).T
    assert errors == pytest.approx(lorenz_by_hand(relax, 6000), abs=1e-11)


def test_rfpt_and_sliding_mode_each_make_up_for_the_model_and_together_do_best():
    found = {
        variant: math.hypot(*settled_rms(topics_of("lorenz", variant), 5.0).values())
        for variant in ("nonadaptive", "adaptive", "vssm", "vssm_rfpt")
    }
    assert found["adaptive"] < found["nonadaptive"] / 100.0
    assert found["vssm"] < found["nonadaptive"] / 3.0
    assert found["vssm_rfpt"] < found["vssm"] / 10.0
