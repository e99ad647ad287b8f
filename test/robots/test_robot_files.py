"""``fpt robot``: an experiment for arms that nobody here has made."""

from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from command import forked_fpt, forked_fpt_json
from trees import tree

from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import available, load
from fpt_ros.robots.robot import try_out, write_experiment
from fpt_ros.robots.survey import survey

pytest.importorskip("mujoco")

OWN = {  # chosen by hand for the arms that ship
    "plant_simulator": ("exact.tool", "exact.tool_inertia", "exact.torque_limit"),
    "fpt_deformer": ("A", "scale"),
    "recorder": ("experiment", "variant", "title"),
}


@pytest.mark.parametrize("arm", ["ur5e", "iiwa"])
def test_what_it_writes_is_what_ships(arm, tmp_path):
    """The files of ur5e and iiwa, which were not made from panda's, in every other parameter."""
    written = write_experiment(arm, tmp_path)
    assert {path.stem.partition(".")[2] or "adaptive" for path in written.files} == set(
        available()["panda"]
    )
    for variant in available()[arm]:
        theirs, ours = load(arm, variant), load(str(written.files[0]), variant)
        for node, values in theirs.nodes.items():
            for name, value in values.items():
                made = ours.nodes[node][name]
                if name in OWN.get(node, ()):
                    continue
                if name.endswith(("inertia", "K_D")):  # over other postures
                    assert np.allclose(made, value, rtol=0.1), (variant, name)
                elif isinstance(value, list) and value and isinstance(value[0], float):
                    assert np.allclose(made, value, atol=2e-5), (variant, node, name)
                else:
                    assert made == value, (variant, node, name)


@pytest.mark.parametrize("seed", range(3))
def test_a_tree_at_random_is_controlled(seed, tmp_path):
    path = tmp_path / "a.tree.urdf"
    path.write_text(tree(seed))
    written = write_experiment(str(path), tmp_path / "out")
    about = written.numbers.about
    assert sorted(about.arm.names) == [f"joint {i}/{'ab'[i % 2]}" for i in (0, 1, 2, 4, 6)]
    assert about.fixed == {"joint 5/b": "follows joint 0/a"}
    for (low, high), home, reach in zip(about.arm.ranges, about.home, about.reach, strict=True):
        assert low < home - reach < home + reach < high
    found = try_out(written)
    assert found["adaptive"] < 0.05 * found["computed_torque"]


ROBOTS = [
    ("gymnasium", "envs/mujoco/assets/pusher.xml", 7, "r_wrist_roll_joint"),
    ("gymnasium", "envs/mujoco/assets/hopper.xml", 6, "foot_joint"),
    ("gymnasium", "envs/mujoco/assets/ant.xml", 8, "ankle_4"),
    ("gymnasium", "envs/mujoco/assets/humanoid.xml", 17, "left_elbow"),
    ("gymnasium", "envs/mujoco/assets/walker2d_v5.xml", 9, "foot_left_joint"),
    ("jvrc_description", "urdf/jvrc1.urdf", 34, "R_UTHUMB"),
]


@pytest.mark.parametrize(("package", "file", "joints", "name"), ROBOTS)
def test_robots_of_others(package, file, joints, name, tmp_path):
    spec = find_spec(package)
    if spec is None:
        pytest.skip(f"{package} is not installed")
    path = Path(spec.submodule_search_locations[0]) / file
    moved = ()
    if file.endswith("pusher.xml"):  # the arm, not what it pushes
        moved = [each for each in survey(str(path)).arm.names if each.startswith("r_")]
    written = write_experiment(str(path), tmp_path, moved)
    names = written.numbers.about.arm.names
    assert len(names) == joints
    assert name in names
    found = try_out(written)
    assert found["adaptive"] < 0.1 * found["computed_torque"]


def test_the_command_prints_what_it_found(tmp_path):
    path = tmp_path / "my arm.urdf"
    path.write_text(tree(0))
    done = forked_fpt("robot", path, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "joint 'joint 5/b' follows joint 0/a: it is fixed" in done.stdout
    assert "fpt simulate my_arm/my_arm.yaml" in done.stdout
    again = forked_fpt_json("robot", path, "--payload", 0.5, "--joints", "joint 0/a", cwd=tmp_path)
    assert again["payload"] == 0.5
    assert [joint["name"] for joint in again["joints"]] == ["joint 0/a"]
    run = forked_fpt_json("simulate", "my_arm/my_arm.yaml", "--variant", "pid", cwd=tmp_path)
    assert run["complete"]
    assert list(run["tracking"]) == ["joint 0/a"]


LINK = """<link name="{0}"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>"""
ARM = """<robot name="r"><link name="base"/>{link}
<joint name="j" type="{kind}"><parent link="base"/><child link="a"/>
<limit lower="{low}" upper="1" effort="9" velocity="1"/></joint></robot>"""


LOOP = """<mujoco><worldbody>
<body name="a"><joint/><geom size=".1" mass="1"/></body>
<body name="b"><joint/><geom size=".1" mass="1"/></body></worldbody>
<equality><connect body1="a" body2="b" anchor="0 0 0"/></equality></mujoco>"""


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        (ARM.format(link='<link name="a"/>', kind="revolute", low=-1), "lacks mass or inertia"),
        (ARM.format(link=LINK.format("a"), kind="fixed", low=-1), "has no joint that turns"),
        (ARM.format(link=LINK.format("a"), kind="revolute", low=1), "has no joint that turns"),
        ('<robot xmlns:xacro="x"><xacro:include filename="y"/></robot>', "is a xacro file"),
        ("nothing", "is not XML"),
        (LOOP, "closes a loop between 'a' and 'b'"),
    ],
)
def test_what_cannot_be_used_is_refused_in_one_line(text, wrong, tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(text)
    with pytest.raises(BadInput) as refused:
        write_experiment(str(path), tmp_path / "out")
    assert wrong in str(refused.value)
    assert "\n" not in str(refused.value)
    assert not (tmp_path / "out").exists()


def test_files_of_somebody_else_stay(tmp_path):
    (tmp_path / "panda.yaml").write_text("mine")
    with pytest.raises(BadInput, match=r"panda\.yaml is not of fpt robot"):
        write_experiment("panda", tmp_path)
    assert (tmp_path / "panda.yaml").read_text() == "mine"


def test_prefixes_that_nobody_has_declared(tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(
        ARM.format(link=LINK.format("a"), kind="revolute", low=-1).replace(
            "<limit ", '<limit drake:acceleration="2" '
        )
    )
    assert survey(str(path)).arm.names == ("j",)


def test_a_limit_that_cannot_hold_the_arm_is_left_out_and_said(tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(tree(0).replace('effort="500"', 'effort="0.01"'))
    written = write_experiment(str(path), tmp_path / "out")
    assert any(
        "limit of effort of joint 0/a (0.01) is left out" in n for n in written.numbers.motion.notes
    )
    assert try_out(written)["adaptive"] is not None
