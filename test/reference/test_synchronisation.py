"""Chaos synchronisation and model reference control, against loops written by hand in NumPy."""

import math

import independent_synchronised_neurons as neurons
import numpy as np
import pytest
from engine_runs import settled_rms, topics_of


def test_the_drive_is_a_lorenz_system_and_the_follower_becomes_it():
    topics = topics_of("synchronised_lorenz", duration=10.0)
    drive = np.array([topics["desired"].column("positions", i) for i in "xyz"]).T
    q, rows = np.ones(3), []
    for _ in range(len(drive)):
        rows.append(q)
        x, y, z = q
        q = q + 1e-3 * np.array([10.0 * (y - x), x * (28.0 - z) - y, x * y - 8.0 / 3.0 * z])
    assert drive[:3000] == pytest.approx(np.array(rows)[:3000], abs=1e-6)
    error = settled_rms(topics, 5.0)
    alone = settled_rms(topics_of("synchronised_lorenz", "nonadaptive", duration=10.0), 5.0)
    assert all(error[i] < alone[i] / 20.0 for i in "xyz")


def test_two_duffing_oscillators():
    topics = topics_of("synchronised_duffing", duration=20.0)
    drive = topics["desired"].column("positions", "q1")
    q, v, rows = 0.1, 0.0, []
    for k in range(2000):
        rows.append(q)
        a = q - q**3 - 0.25 * v + 0.3 * math.cos(1e-3 * k) if k else 0.0
        q, v = q + 1e-3 * v, v + 1e-3 * a
    assert drive[:2000] == pytest.approx(rows, abs=2e-3)
    alone = settled_rms(topics_of("synchronised_duffing", "nonadaptive", duration=20.0), 5.0)
    assert settled_rms(topics, 5.0)["q1"] < alone["q1"] / 3.0


def test_two_neurons_of_which_the_drive_is_chaotic():
    """Its exponent is 0.039 to 0.041 by a fine RK4 over 40,000 s, elsewhere; here over 1,500 s."""
    assert 0.02 < neurons.exponent(150_000, 0.01) < 0.06
    error, alone = (
        settled_rms(topics_of("synchronised_neurons", variant), 50.0)["x"]
        for variant in ("adaptive", "nonadaptive")
    )
    assert error < alone / 20.0


def by_hand(cycles):
    """Duffing with the deformed effort: U' = (1 + b) U + b K sign(h)."""
    q = v = integral = last = before_e = 0.0
    A, B, K, dt, lam = 1e-5, -1.0, 1e5, 1e-3, 3.0
    errors, U, past = [], None, None
    for k in range(cycles):
        t = k * dt
        e, e_dot = 0.4 * math.sin(5.0 * t) - q, 2.0 * math.cos(5.0 * t) - v
        integral += dt * before_e
        before_e = e
        wanted = -10.0 * math.sin(5.0 * t) + 3 * lam * e_dot + 3 * lam**2 * e + lam**3 * integral

        def reference(r, q, v):
            return r - ((0.8 + 0.9 * q * q) * q + 0.1 * v)

        needed = reference(wanted, q, v)
        if U is None:
            U = needed
        else:
            h = reference((v - last) / dt, *past) - needed
            b = B * (A * abs(h)) / (1.0 + A * abs(h))
            U = (1.0 + b) * U + b * K * math.copysign(1.0, h)
        errors.append(e)
        past, last = (q, v), v
        a = (1.0 + q * q) * q + 0.2 * v + U
        q, v = q + dt * v, v + dt * a
    return np.array(errors)


def test_model_reference_control_deforms_the_effort():
    topics = topics_of("duffing", "mrac")
    desired, measured = topics["desired"], topics["joint_states"]
    error = desired.column("positions", "q1") - measured.column("position", "q1")
    assert error == pytest.approx(by_hand(len(error)), abs=1e-9)
    assert settled_rms(topics, 3.0)["q1"] < 5.130310158558e-3 / 2.0  # without, of the source
