"""A path of an arm's tip: against MuJoCo's own bindings, SciPy, and inverses at a singularity."""

import gc

import numpy as np
import pytest
from scipy.optimize import root

from fpt_ros.engine.engine import Engine
from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import load
from fpt_ros.trajectories import TRAJECTORIES

mujoco = pytest.importorskip("mujoco")

from fpt_ros.plants.mujoco.description_file import ARMS  # noqa: E402

DT, W = 0.001, 2.0
HOME = {
    "iiwa": [0.0, 0.6, 0.0, -1.4, 0.0, 1.0, 0.0],
    "panda": [0.0, 0.0, 0.0, -1.57079, 0.0, 1.57079, -0.7853],
    "ur5e": [-1.5708, -1.5708, 1.5708, -1.5708, -1.5708, 0.0],
}
STRETCHING = [0.0, 0.7, 0.0, -0.6, 0.0, 0.0, 0.0]


class Peer:
    """The arm in MuJoCo's bindings, and inverse kinematics as it is usually done."""

    def __init__(self, arm):
        self.model = mujoco.MjModel.from_xml_path(str(ARMS / f"{arm}.xml"))
        self.data = mujoco.MjData(self.model)
        self.names = [self.model.joint(i).name for i in range(self.model.nv)]

    def tip(self, q, offset=(0.0, 0.0, 0.0)):
        self.data.qpos[: len(q)] = q
        mujoco.mj_forward(self.model, self.data)
        flange = self.data.site("flange")
        return flange.xpos + flange.xmat.reshape(3, 3) @ offset

    def jacobian(self, q):
        self.tip(q)
        J = np.zeros((3, self.model.nv))
        mujoco.mj_jacSite(self.model, self.data, J, None, self.model.site("flange").id)
        return J

    def by_pinv(self, start, path):
        q = [np.array(start)]
        for wanted in path[1:]:
            lack = wanted - self.tip(q[-1])
            q.append(q[-1] + np.linalg.pinv(self.jacobian(q[-1])) @ lack)
        return np.array(q)


def prepared(arm, start, **values):
    law, c = TRAJECTORIES["cartesian_path"], len(start)
    own = {p.name: p.default for p in law.parameters}
    own |= {"arm.file": arm, "controlled": Peer(arm).names[:c], "start": start}
    own |= {"amplitude": [0.1] * c, "frequency": [W] * c} | values
    return law, law.prepare(own, c)


def rows(law, constants, c, cycles):
    state = list(law.state)
    for k in range(cycles):
        out = [0.0] * c, [0.0] * c, [0.0] * c
        law.nominal(constants, state, k * DT, DT if k else 0.0, *out)
        yield [list(x) for x in out]


def motion(arm, start, cycles, **values):
    found = rows(*prepared(arm, start, **values), len(start), cycles)
    return np.array(list(found)).transpose(1, 0, 2)


def path(start, cycles, direction, across=(0.0, 0.0, 0.0), amplitude=0.1):
    turn, e = W * DT * np.arange(cycles), np.array(direction)
    along = np.outer(amplitude * (1.0 - np.cos(turn)), e / np.linalg.norm(e))
    return start + along + np.outer(np.sin(turn) ** 2, across)


@pytest.mark.parametrize("arm", sorted(HOME))
def test_the_flange_is_where_it_was_asked_to_be(arm):
    """By mj_forward of a model of its own; 0.2 m, 0.05 m to the side."""
    direction, across, peer = [2.0, 0.0, 0.5], [0.0, 0.05, 0.0], Peer(arm)
    q, v, a = motion(arm, HOME[arm], 1571, direction=direction, across=across)
    wanted = path(peer.tip(HOME[arm]), 1571, direction, across)
    found = np.array([peer.tip(x) for x in q[::10]])
    assert np.linalg.norm(found - wanted[::10], axis=1).max() < 1e-5  # [m]
    assert np.linalg.norm(found[-1] - found[0]) > 0.19
    assert v[1:] == pytest.approx(np.diff(q, axis=0) / DT, abs=1e-9)
    assert np.abs(v).max() < 0.8
    assert np.abs(a).max() < 4.0


def test_a_point_beside_the_flange_is_led_as_well():
    tip, direction, peer = [0.1, -0.05, 0.2], [0.0, 1.0, 1.0], Peer("panda")
    q, _, _ = motion("panda", HOME["panda"], 600, direction=direction, tip=tip)
    wanted = path(peer.tip(HOME["panda"], tip), 600, direction)
    found = np.array([peer.tip(x, tip) for x in q[::20]])
    assert np.linalg.norm(found - wanted[::20], axis=1).max() < 1e-5


def test_a_body_in_the_middle_is_led_and_the_joints_behind_it_rest():
    direction, peer = [0.0, 1.0, 0.0], Peer("iiwa")
    values = {"direction": direction, "amplitude": [0.05] * 7, "arm.flange": "link6"}
    q, _, _ = motion("iiwa", HOME["iiwa"], 600, **values)
    peer.tip(HOME["iiwa"])
    wanted = path(peer.data.body("link6").xpos.copy(), 600, direction, amplitude=0.05)
    peer.tip(q[-1])
    assert peer.data.body("link6").xpos == pytest.approx(wanted[-1], abs=1e-5)
    assert (q[:, 5:] == HOME["iiwa"][5:]).all()


def test_three_joints_are_where_scipy_finds_them():
    """Random postures of the first three joints of the UR5e, the others at zero."""
    rng, peer, tried = np.random.default_rng(49), Peer("ur5e"), 0
    while tried < 3:
        start, direction = rng.uniform(-1.5, 1.5, 3), rng.normal(size=3)
        if np.linalg.svd(peer.jacobian(start)[:, :3])[1][2] < 0.2:
            continue
        tried += 1
        q, _, _ = motion("ur5e", list(start), 700, direction=list(direction), amplitude=[0.05] * 3)
        wanted = path(peer.tip(start), 700, direction, amplitude=0.05)[-1]
        solved = root(lambda x, there=wanted: peer.tip(x) - there, start, tol=1e-12)
        assert solved.success
        assert q[-1] == pytest.approx(solved.x, abs=1e-4)


@pytest.mark.parametrize(("memory", "bound"), [(0.0, 2e-3), (0.99, 2e-2), (1.0, 0.3)])
def test_joints_to_spare_stay_near_the_pseudoinverse(memory, bound):
    """Over a period; what is remembered of dq where J does not see it adds up."""
    direction, across, peer = [1.0, 0.0, 0.0], [0.0, 0.05, 0.0], Peer("iiwa")
    values = {"direction": direction, "across": across, "inner_memory": memory}
    q, _, _ = motion("iiwa", HOME["iiwa"], 3142, **values)
    usual = peer.by_pinv(HOME["iiwa"], path(peer.tip(HOME["iiwa"]), 3142, direction, across))
    far = np.abs(q - usual).max()
    assert bound / 10 < far < bound


def outward(peer):
    """The direction from the shoulder to the tip, and how far it is from there to the edge."""
    shoulder = np.array([0.0, 0.0, 0.36])
    reach, out = peer.tip([0.0] * 7) - shoulder, peer.tip(STRETCHING) - shoulder
    return out, np.linalg.norm(reach) - np.linalg.norm(out)


def test_at_a_singularity_the_arm_stretches_and_comes_back():
    """2 mm past the edge of reach, straight outwards: what inverses ask for there has no bound."""
    peer, amplitude = Peer("iiwa"), 0.022
    out, left = outward(peer)
    assert 2.0 * amplitude - left == pytest.approx(0.0023, abs=1e-4)
    q, v, _ = motion("iiwa", STRETCHING, 3142, direction=list(out), amplitude=[amplitude] * 7)
    wanted = path(peer.tip(STRETCHING), 3142, out, amplitude=amplitude)
    lacks = wanted - np.array([peer.tip(x) for x in q])
    far = np.linalg.norm(lacks, axis=1)
    assert far.max() < 0.01
    assert far[-1] < 1e-5
    assert np.linalg.norm(peer.tip(q[1571]) - peer.tip(STRETCHING)) > left - 1e-3
    assert np.abs(v).max() < 5.0  # [rad/s]
    Js = [peer.jacobian(x) for x in q]
    assert min(np.linalg.svd(J)[1][2] for J in Js) < 1e-4
    pairs = zip(Js, lacks / DT, strict=True)
    assert max(np.abs(np.linalg.solve(J @ J.T, x) @ J).max() for J, x in pairs) > 1e4
    by_pinv = np.abs(np.diff(peer.by_pinv(STRETCHING, wanted), axis=0)).max() / DT
    assert by_pinv > 1e3


def test_in_the_singular_posture_nothing_is_divided_by_what_is_zero():
    """Upright: outwards there is no way; sideways there is."""
    J = Peer("iiwa").jacobian([0.0] * 7)
    assert np.linalg.cond(J @ J.T) > 1e15
    q, v, _ = motion("iiwa", [0.0] * 7, 200, direction=[0.0, 0.0, 1.0])
    assert np.abs(v).max() < 1e-9
    q, v, _ = motion("iiwa", [0.0] * 7, 200, direction=[1.0, 0.0, 0.0])
    assert np.abs(v).max() < 0.2
    assert Peer("iiwa").tip(q[-1])[0] == pytest.approx(0.1 * (1 - np.cos(W * 0.199)), abs=1e-5)


@pytest.mark.parametrize("variant", ["adaptive", "singular"])
def test_compiled_it_has_the_bits_of_python(variant):
    found = []
    for compiled in (True, False):
        engine = Engine(load("iiwa_tip", variant, duration=0.3).loop(), compiled)
        gc.collect()
        engine.run()
        found.append(engine.topics())
    for topic, series in found[0].items():
        for name, vector in series.vectors.items():
            assert vector.tobytes() == found[1][topic].vectors[name].tobytes()


def test_two_arms_of_one_file_do_not_disturb_each_other():
    alone = motion("iiwa", HOME["iiwa"], 50)
    two = [prepared("iiwa", HOME["iiwa"]), prepared("iiwa", STRETCHING)]
    pairs = zip(*(rows(*each, 7, 50) for each in two), strict=True)
    first = np.array([pair[0] for pair in pairs]).transpose(1, 0, 2)
    assert first.tobytes() == alone.tobytes()


def test_the_flange_follows_with_a_wrong_model():
    """The plant has 2 kg and friction, the model half of its inertias."""
    engine = Engine(load("iiwa_tip").loop())
    engine.run()
    estimate, peer = engine.topics()["state_estimate"], Peer("iiwa")
    found = np.array([peer.tip(x) for x in estimate.vectors["positions"][::20]])
    wanted = path(peer.tip(HOME["iiwa"]), 6500, [1.0, 0.0, 0.0], [0.0, 0.05, 0.0])[::20]
    far = np.linalg.norm(found - wanted, axis=1)
    assert far.max() < 6e-4  # [m]
    assert far[125:].max() < 1e-4


REFUSED = {
    "arm.file=nowhere": "arm.file: there is no file 'nowhere'",
    "arm.file=ur5e": "not joints of ur5e.xml in its order: shoulder_pan,",
    "arm.flange=hand": "arm.flange: no site or body 'hand', the file has flange, world",
    "start=[0.1]": "start: 1 numbers given, 7 needed",
    "across=[0.1]": "across: 1 numbers given, 3 needed",
    "direction=[0.0, 0.0, 0.0]": "is no direction",
    "amplitude=[0.3, 0, 0, 0, 0, 0, 0]": "the nominal joint4 is",
}


@pytest.mark.parametrize("setting", sorted(REFUSED))
def test_what_does_not_fit_is_refused_in_one_line(setting):
    settings = ["trajectory_generator.direction=[-1.0, 0.0, 0.0]"]
    settings.append(f"trajectory_generator.{setting}")
    with pytest.raises(BadInput) as caught:
        load("iiwa_tip", settings=settings).loop()
    assert REFUSED[setting] in str(caught.value)
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith("trajectory_generator.")
