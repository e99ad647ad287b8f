"""Plant ``mujoco``: against MuJoCo's own bindings, in Python, and in a second process."""

import hashlib
import subprocess
import sys
from array import array
from pathlib import Path

import numpy as np
import pytest

from fpt_ros.parameters import resolve
from fpt_ros.plants import PLANTS
from fpt_ros.plants.mujoco.description_file import ARMS

mujoco = pytest.importorskip("mujoco")

HERE = Path(__file__).parent
H = 1e-3
HOME = [0.0, 0.0, 0.0, -1.57079, 0.0, 1.57079, -0.7853]


class Arm:
    """The plant as its stage holds it."""

    def __init__(self, file="panda", q=HOME, **given):
        factory = PLANTS["mujoco"]
        self.plant = factory.make(resolve(factory.parameters, {"file": file, **given}, "plant"))
        self.plant.set_step(H)
        self.c = self.plant.coefficients(())
        self.q, self.v = array("d", q), array("d", [0.0] * len(q))
        self.acted = array("d", [0.0] * len(q))
        self.state = array("d", [0.0] * self.plant.state)
        self.plant.start(self.c, self.state, self.q, self.v)

    def step(self, effort, external=None):
        external = external or [0.0] * len(effort)
        given = self.state, 0.0, H, effort, external, self.q, self.v, self.acted
        self.plant.advance(self.c, *given)


def efforts(k):
    return [10.0 * np.sin(0.01 * k + i) for i in range(7)]


def test_the_same_bits_as_the_bindings():
    model = mujoco.MjModel.from_xml_path(str(ARMS / "panda.xml"))
    data = mujoco.MjData(model)
    data.qpos[:] = HOME
    arm = Arm()
    for k in range(300):
        data.qfrc_applied[:] = efforts(k)
        mujoco.mj_step(model, data)
        arm.step(efforts(k))
    assert arm.q.tobytes() == data.qpos.tobytes()
    assert arm.v.tobytes() == data.qvel.tobytes()


def test_two_arms_of_one_file_do_not_disturb_each_other():
    alone, first, second = Arm(), Arm(), Arm(tool=5.0)
    for k in range(100):
        alone.step(efforts(k))
    for k in range(100):
        first.step(efforts(k))
        second.step(efforts(k + 50))
    assert first.q.tobytes() == alone.q.tobytes()
    assert second.q.tobytes() != alone.q.tobytes()


def test_a_state_put_back_goes_on_with_the_same_bits():
    arm = Arm()
    for k in range(50):
        arm.step(efforts(k))
    kept = bytes(arm.state), bytes(arm.q), bytes(arm.v)
    for k in range(50, 100):
        arm.step(efforts(k))
    other = Arm()
    for mine, saved in zip((other.state, other.q, other.v), kept, strict=True):
        mine[:] = array("d", saved)
    for k in range(50, 100):
        other.step(efforts(k))
    assert other.state.tobytes() == arm.state.tobytes()


DIGEST = """
from test_plant import Arm, digest
print(digest(Arm()))
"""


def digest(arm):
    for k in range(200):
        arm.step(efforts(k))
    return hashlib.sha256(arm.state.tobytes()).hexdigest()


def test_a_second_process_has_the_same_bits():
    ran = subprocess.run(
        [sys.executable, "-c", DIGEST], capture_output=True, text=True, cwd=HERE, check=True
    )
    assert ran.stdout.strip() == digest(Arm())


def test_effort_is_cut_and_told_as_it_acted():
    arm = Arm(torque_limit=[5.0] * 7)
    arm.step([100.0, -100.0, 1.0, 0.0, 5.0, -5.0, 4.0])
    assert list(arm.acted) == [5.0, -5.0, 1.0, 0.0, 5.0, -5.0, 4.0]
    ours, theirs = Arm(torque_limit=[5.0] * 7), Arm()
    ours.step([100.0] * 7)
    theirs.step([5.0] * 7)
    assert ours.v.tobytes() == theirs.v.tobytes()


def test_a_disturbance_is_not_cut():
    ours, theirs = Arm(torque_limit=[5.0] * 7), Arm()
    ours.step([5.0] * 7, [3.0] * 7)
    theirs.step([8.0] * 7)
    assert ours.v.tobytes() == theirs.v.tobytes()
    assert list(ours.acted) == [5.0] * 7


def test_the_tool_is_taken_up_at_its_time():
    bare, late, loaded = Arm(), Arm(tool=2.0, tool_from=0.01), Arm(tool=2.0)
    for k in range(10):
        bare.step(efforts(k))
        late.step(efforts(k))
        loaded.step(efforts(k))
    assert late.q.tobytes() == bare.q.tobytes() != loaded.q.tobytes()
    bare.step(efforts(10))
    late.step(efforts(10))
    assert late.v.tobytes() != bare.v.tobytes()


def test_a_lost_arm_is_nan_and_leaves_no_log(tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    for wrong in (np.nan, 1e9):
        arm = Arm()
        arm.v[2] = wrong
        arm.step([0.0] * 7)
        assert np.isnan(arm.q).all()
    arm = Arm(torque_limit=[1e15] * 7)
    for _ in range(20):
        arm.step([1e14] * 7)
    assert not np.isfinite(arm.q).all()
    assert list(tmp_path.iterdir()) == []
    assert capfd.readouterr() == ("", "")


def test_its_response_is_the_acceleration_of_a_short_step():
    arm = Arm(tool=2.0)
    out = array("d", [0.0] * 7)
    arm.plant.response(arm.c, arm.q, arm.v, [5.0] * 7, out)
    short = Arm(tool=2.0)
    short.plant.set_step(1e-6)
    short.plant.advance(
        short.c, short.state, 0.0, 1e-6, [5.0] * 7, [0.0] * 7, short.q, short.v, short.acted
    )
    assert np.array(short.v) / 1e-6 == pytest.approx(np.array(out), rel=1e-3, abs=1e-3)
