"""Plans of the receding horizon: a linear model in closed form, a nonlinear one by another way."""

import math

import numpy as np
import pytest
from engine_runs import settled_rms, topics_of
from scipy.optimize import minimize

from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import load
from fpt_ros.trajectories.horizon import Horizon, moved, planned


def duffing(alpha, delta, beta):
    def acceleration(q, v, u):
        return [alpha * q[0] + delta * v[0] + beta * q[0] ** 3 + u[0]]

    return acceleration


def reference(t):
    return [0.8 * math.sin(2.0 * t)]


def test_a_linear_model_in_closed_form():
    """x_{j+1} = P x_j + p u_j, P the exponential series that RK4 has: one system of equations."""
    N, h, weight = 12, 0.05, 1e-3
    M, b = np.array([[0.0, 1.0], [0.8, 0.1]]), np.array([0.0, 1.0])
    powers = [np.linalg.matrix_power(h * M, k) / math.factorial(k) for k in range(5)]
    P = sum(powers)
    p = h * sum(powers[k] / (k + 1) for k in range(4)) @ b
    response = np.zeros((N, N))
    for j in range(N):
        column = p
        for i in range(j, N):
            response[i, j] = column[0]
            column = P @ column
    wanted = np.array([reference((j + 1) * h)[0] for j in range(N)])
    u = np.linalg.solve(response.T @ response + weight * np.eye(N), response.T @ wanted)
    _, points, efforts = planned(
        Horizon(N, h, N, weight, math.inf), duffing(0.8, 0.1, 0.0), reference, [0.0], N * h
    )
    assert np.array(efforts)[:, 0] == pytest.approx(u, abs=1e-6)
    assert np.array(points)[1:, 0] == pytest.approx(response @ u, abs=1e-8)


def test_a_nonlinear_model_by_another_optimiser():
    N, h, weight = 6, 0.1, 1e-3
    model = duffing(0.8, 0.1, 0.9)

    def cost(u):
        q, v, total = [0.5], [0.0], weight * float(u @ u)
        for j in range(N):
            q, v = moved(model, q, v, [float(u[j])], h)
            total += (q[0] - reference((j + 1) * h)[0]) ** 2
        return total

    found = minimize(cost, np.zeros(N), method="Powell", options={"xtol": 1e-8, "ftol": 1e-14})
    _, _, efforts = planned(Horizon(N, h, N, weight, math.inf), model, reference, [0.5], N * h)
    ours = np.array(efforts)[:, 0]
    assert cost(ours) <= found.fun * (1.0 + 1e-9)
    assert ours == pytest.approx(found.x, abs=2e-3)


UNTIL = 3.0
SHORT = (f"trajectory_generator.horizon.until={UNTIL}",)


def the_plan(limit):
    return planned(
        Horizon(20, 0.05, 5, 3e-4, limit), duffing(0.8, 0.1, 0.9), reference, [0.0], UNTIL
    )


def test_the_loop_follows_the_plan_and_not_its_efforts():
    _, points, efforts = the_plan(math.inf)
    topics = topics_of("receding_horizon", settings=SHORT, duration=2.5)
    nominal = topics["desired"].column("positions", "q1")
    assert nominal[::50] == pytest.approx([q[0] for q in points[:50]], abs=1e-6)
    alone = settled_rms(topics_of("receding_horizon", "nonadaptive", SHORT, 2.5), 1.0)["q1"]
    followed = settled_rms(topics, 1.0)["q1"]
    assert followed < alone / 10.0
    q, v = [0.0], [0.0]  # the efforts of the plan on the exact plant
    for k in range(50):
        q, v = moved(duffing(1.0, 0.2, 1.0), q, v, efforts[k], 0.05)
    assert abs(q[0] - points[50][0]) > 100.0 * followed


def test_a_limit_of_the_effort_is_kept():
    _, points, efforts = the_plan(1.5)
    assert max(abs(u[0]) for u in efforts) == pytest.approx(1.5, rel=1e-9)
    topics = topics_of("receding_horizon", "limited", SHORT, 2.5)
    nominal = topics["desired"].column("positions", "q1")
    assert nominal[::50] == pytest.approx([q[0] for q in points[:50]], abs=1e-5)
    assert nominal.max() < 0.7  # the reference has 0.8


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        ("horizon.model=lorenz", "lorenz has no accelerations to plan with"),
        ("horizon.model=tora", "tora has 3 coordinates, 1 are controlled"),
        ("horizon.parameters=[1.0]", r"1 given, duffing takes 3 \(alpha, delta, beta\)"),
        ("horizon.applied=21", "of a horizon of 20 steps it takes at most 20"),
        ("horizon.until=1000.0", r"20000 steps of 0.05 s, it takes 4,000 at most"),
    ],
)
def test_bad_plans_are_refused(setting, said):
    with pytest.raises(BadInput, match=said):
        load("receding_horizon", settings=[f"trajectory_generator.{setting}"]).loop()
