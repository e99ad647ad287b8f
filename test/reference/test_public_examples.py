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


@pytest.mark.parametrize(
    ("variant", "expected", "within"),
    [
        ("adaptive", (4.033692315781e-3, 7.299010127312e-3, 1.712081858980e-3), 1e-11),
        ("nonadaptive", (1.498760961, 2.293033578, 0.0988599258), 1e-8),
        ("vssm_rfpt", (9.7e-5, None, None), 2e-3),
    ],
)
def test_the_lorenz_system(variant, expected, within):
    found = settled_rms(topics_of("lorenz", variant), 5.0)
    for joint, one in zip("xyz", expected, strict=True):
        assert one is None or found[joint] == pytest.approx(one, rel=within)


def lorenz_by_hand(cycles):
    """Errors of the source's program (sliding mode, a model without two terms) in NumPy."""
    amplitude, rate = np.array([2.0, 3.8, 1.5]), np.array([0.5, 0.7, 0.9])
    sigma, beta, rho, dt = 5.0, 8.0 / 3.0, 40.0, 1e-3
    q, integral, errors = np.zeros(3), np.zeros(3), []
    for k in range(cycles):
        t = k * dt
        e = amplitude * np.sin(rate * t) - q
        errors.append(e)
        wanted = amplitude * rate * np.cos(rate * t) + 12.0 * e
        wanted += 500.0 * np.tanh(12.0 * integral + e)
        x, y, z = q
        model = np.array([sigma * (y - x), x * (rho - z), y - beta * z])
        exact = np.array([sigma * (y - x), x * (rho - z) - y, x * y - beta * z])
        integral = integral + dt * e
        q = q + dt * (exact + wanted - model)
    return np.array(errors)


def test_lorenz_against_the_program_of_the_source():
    topics = topics_of("lorenz", "public_code", duration=6.0)
    desired, measured = topics["desired"], topics["joint_states"]
    errors = np.array(
        [desired.column("positions", i) - measured.column("position", i) for i in "xyz"]
    ).T
    assert errors == pytest.approx(lorenz_by_hand(6000), abs=1e-11)


def test_rfpt_and_sliding_mode_each_make_up_for_the_model_and_together_do_best():
    found = {
        variant: math.hypot(*settled_rms(topics_of("lorenz", variant), 5.0).values())
        for variant in ("nonadaptive", "adaptive", "vssm", "vssm_rfpt")
    }
    assert found["adaptive"] < found["nonadaptive"] / 100.0
    assert found["vssm"] < found["nonadaptive"] / 40.0
    assert found["vssm_rfpt"] < min(found["vssm"], found["adaptive"]) / 40.0
