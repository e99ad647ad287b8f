"""Double pendulum against trajectories of RealAIGym, its energy, and its models."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from engine_runs import settled_rms, topics_of
from hypothesis import given
from hypothesis import strategies as st

from fpt_ros.integrators import INTEGRATORS
from fpt_ros.plants import MODELS, PLANTS

RECORDED = json.loads((Path(__file__).parent / "data" / "double_pendulum.json").read_text())
CONSTANTS = {
    "m1": 0.5234602302310271,
    "m2": 0.6255677234174437,
    "l1": 0.2,
    "r1": 0.2,
    "r2": 0.25569305436052964,
    "I1": 0.031887199591513114,
    "I2": 0.05086984812807257,
}
"""Design C.1, model 1.0."""

ANGLE = st.floats(-3.0, 3.0)


def numbers(**changes):
    plant = PLANTS["double_pendulum"]
    own = {p.name: p.default for p in plant.parameters} | CONSTANTS | changes
    return plant.coefficients(tuple(own[p.name] for p in plant.parameters))


@pytest.mark.parametrize("name", RECORDED["rows"])
def test_steps_of_the_public_benchmark(name):
    """Runge-Kutta of order 4, 2 ms: what its simulator wrote, under four controllers."""
    response = PLANTS[name.partition("/")[0]].response
    step, c, worst = INTEGRATORS["rk4"].over(response), numbers(), 0.0
    for q1, q2, v1, v2, tau1, tau2, *after in RECORDED["rows"][name]:
        q, v = [q1, q2], [v1, v2]
        step((), 2, 0.002, c, (tau1, tau2), q, v, [0.0] * 2, [0.0] * 20)
        worst = max(worst, np.abs(np.subtract(q + v, after)).max())
    assert worst < 1e-14


def test_without_motors_and_friction_the_energy_stays():
    c, step = numbers(), INTEGRATORS["dopri5"].over(PLANTS["double_pendulum"].response)
    p = CONSTANTS

    def energy(q, v):
        v12 = v[0] + v[1]
        kinetic = 0.5 * (p["I1"] + p["m2"] * p["l1"] ** 2) * v[0] ** 2 + 0.5 * p["I2"] * v12**2
        kinetic += p["m2"] * p["l1"] * p["r2"] * math.cos(q[1]) * v[0] * v12
        first = -p["r1"] * math.cos(q[0])
        second = -p["l1"] * math.cos(q[0]) - p["r2"] * math.cos(q[0] + q[1])
        return kinetic + 9.81 * (p["m1"] * first + p["m2"] * second)

    q, v = [2.0, -1.0], [0.5, 3.0]
    start = energy(q, v)
    for _ in range(1000):
        step((1e-10, 1e-12), 2, 0.002, c, (0.0, 0.0), q, v, [0.0] * 2, [0.0] * 34)
    assert energy(q, v) == pytest.approx(start, abs=1e-7)


@given(st.tuples(ANGLE, ANGLE), st.tuples(ANGLE, ANGLE), ANGLE)
@pytest.mark.parametrize(("robot", "joint"), [("pendubot", 0), ("acrobot", 1)])
def test_the_model_gives_the_motor_what_causes_the_response(robot, joint, q, v, wanted):
    c = numbers(b1=0.05, b2=0.03, cf1=0.1, cf2=0.02, Ir=1e-4)
    r, torque, response = [math.nan, math.nan], [0.0, 0.0], [0.0, 0.0]
    r[joint] = wanted
    MODELS[robot].effort(c, q, v, r, (0.0, 0.0), torque)
    assert torque[1 - joint] == 0.0
    PLANTS[robot].response(c, q, v, torque, response)
    assert response[joint] == pytest.approx(wanted, abs=1e-9)


@pytest.mark.parametrize(("robot", "joint"), [("pendubot", "q1"), ("acrobot", "q2")])
def test_fixed_point_transformations_make_up_for_a_wrong_model(robot, joint):
    adaptive = settled_rms(topics_of(robot), 2.0)[joint]
    assert adaptive < settled_rms(topics_of(robot, "nonadaptive"), 2.0)[joint] / 10.0
