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
joint is out of its range, its torque there holds the force of the limit, which inverse dynamics
does not."""


def model_of(arm, **given):
    factory = MODELS["mujoco"]
    return factory.make(resolve(factory.parameters, {"file": arm, **given}, "model"))


def torque(model, q, v, a):
    out = [0.0] * len(q)
    model.effort(model.coefficients(()), q, v, a, [0.0] * len(q), out)
    return np.array(out)


def limit_force(arm, q, v, a):
    """What MuJoCo's joint limits exert, their stiffness taken without armature as in the cases."""
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(ARMS / f"{arm}.xml"))
    data, armature = mujoco.MjData(model), model.dof_armature.copy()
    model.dof_armature[:] = 0.0
    mujoco.mj_setConst(model, data)
    model.dof_armature[:], model.dof_frictionloss[:] = armature, 0.0
    data.qpos[:], data.qvel[:], data.qacc[:] = q, v, a
    mujoco.mj_inverse(model, data)
    return data.qfrc_constraint.copy()


@pytest.mark.parametrize("arm", shipped())
def test_five_motions_of_each(arm):
    model, out_of_range = model_of(arm), 0
    for case in CASES[arm]:
        motion = case["q"], case["v"], case["a"]
        limits = limit_force(arm, *motion)
        error = torque(model, *motion) - limits - case["torque"]
        assert np.abs(error[limits == 0.0]).max() < 1e-9
        assert (np.abs(error) <= 1e-9 + 1e-10 * np.abs(limits)).all()  # of up to 6731 N m
        out_of_range += int((limits != 0.0).sum())
    assert out_of_range == (5 if arm == "panda" else 0)


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
