"""Descriptions that ship: inverse dynamics against figures of others, and against Pinocchio."""

import json
from pathlib import Path

import numpy as np
import pytest

from fpt_ros.parameters import resolve
from fpt_ros.plants import MODELS
from fpt_ros.plants.mujoco.description_file import ARMS, shipped

pytest.importorskip("mujoco")

CASES = json.loads((Path(__file__).parent / "data" / "inverse_dynamics.json").read_text())
"""Five a robot, by mj_inverse of the MuJoCo Menagerie models, with their joint limits: where a
joint is out of its range, its torque there holds the force of the limit."""


def model_of(arm, **given):
    factory = MODELS["mujoco"]
    return factory.make(resolve(factory.parameters, {"file": arm, **given}, "model"))


def torque(model, q, v, a):
    out = [0.0] * len(q)
    model.effort(model.coefficients(()), q, v, a, [0.0] * len(q), out)
    return np.array(out)


@pytest.mark.parametrize("arm", shipped())
def test_five_motions_of_each(arm):
    import mujoco

    ranges = mujoco.MjModel.from_xml_path(str(ARMS / f"{arm}.xml")).jnt_range
    model, compared = model_of(arm), 0
    for case in CASES[arm]:
        q = np.array(case["q"])
        inside = (ranges[:, 0] < q) & (q < ranges[:, 1])
        error = torque(model, case["q"], case["v"], case["a"]) - case["torque"]
        assert np.abs(error[inside]).max() < 1e-9
        compared += int(inside.sum())
    assert compared >= 5 * len(ranges) - 6  # Panda's joints 4 and 6 are out of theirs in some


@pytest.mark.parametrize("arm", shipped())
def test_pinocchio_agrees_far_from_home_too(arm):
    pin = pytest.importorskip("pinocchio")
    theirs = pin.buildModelFromMJCF(str(ARMS / f"{arm}.xml"))
    data, model, rng = theirs.createData(), model_of(arm), np.random.default_rng(5)
    for _ in range(50):
        q, v, a = rng.uniform(-3, 3, (3, theirs.nq))
        expected = pin.rnea(theirs, data, q, v, a)
        assert np.abs(torque(model, q, v, a) - expected).max() < 1e-9


def test_scale_and_armature_are_factors():
    pin = pytest.importorskip("pinocchio")
    theirs = pin.buildModelFromMJCF(str(ARMS / "panda.xml"))
    for inertia in theirs.inertias:
        inertia.mass *= 0.5
        inertia.inertia *= 0.5
    theirs.armature *= 0.5 * 0.2
    rng, model = np.random.default_rng(6), model_of("panda", scale=0.5, armature=0.2)
    q, v, a = rng.uniform(-2, 2, (3, theirs.nq))
    expected = pin.rnea(theirs, theirs.createData(), q, v, a)
    assert np.abs(torque(model, q, v, a) - expected).max() < 1e-9


def test_a_tool_weighs_on_the_joints():
    """2 kg, 0.5 m from joint 1 of nothing but gravity: the same arm with the mass in its file."""
    pin = pytest.importorskip("pinocchio")
    theirs = pin.buildModelFromMJCF(str(ARMS / "iiwa.xml"))
    last = theirs.getJointId(theirs.names[theirs.njoints - 1])
    at = pin.SE3(np.eye(3), np.array([0.0, 0.0, 0.045 + 0.05]))
    theirs.inertias[last] += at.act(pin.Inertia(2.0, np.zeros(3), 0.004 * np.eye(3)))
    rng, model = np.random.default_rng(7), model_of("iiwa", tool=2.0)
    q, v, a = rng.uniform(-2, 2, (3, theirs.nq))
    expected = pin.rnea(theirs, theirs.createData(), q, v, a)
    assert np.abs(torque(model, q, v, a) - expected).max() < 1e-9
