"""Files of others: what is taken from them, and what is refused in one line."""

import sys

import pytest

from fpt_ros.errors import BadInput
from fpt_ros.parameters import resolve
from fpt_ros.plants import MODELS, PLANTS

pytest.importorskip("mujoco")

INERTIAL = """<inertial><mass value="1"/><origin xyz="0 0 .1"/>
<inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>"""


def link(name, inertial=INERTIAL):
    mesh = '<visual><geometry><mesh filename="package://none/none.stl"/></geometry></visual>'
    return f'<link name="{name}">{inertial}{mesh}</link>'


def joint(name, parent, child, kind="revolute"):
    return f"""<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>
<origin xyz="0 0 .2"/><axis xyz="0 1 0"/><dynamics damping=".5" friction=".2"/>
<limit effort="30" velocity="1" lower="-1" upper="2"/></joint>"""


URDF = f"""<robot name="r">{link("base")}{link("a")}{link("b")}{link("c")}
{joint("turn", "base", "a")}{joint("slide", "a", "b", "prismatic")}
{joint("twig", "a", "c")}</robot>"""

MJCF = """<mujoco><worldbody><body><joint name="j" {0}/><geom size=".1" mass="1"/>
</body></worldbody></mujoco>"""


def make(tmp_path, text, name="arm.urdf", kind=PLANTS, **given):
    path = tmp_path / name
    path.write_text(text)
    factory = kind["mujoco"]
    return factory.make(resolve(factory.parameters, {"file": str(path), **given}, "plant"))


def test_a_urdf_without_its_meshes(tmp_path):
    plant = make(tmp_path, URDF)
    assert plant.coordinates == ("turn", "slide", "twig")
    assert plant.units == ("rad", "m", "rad")
    assert plant.effort_units == ("N m", "N", "N m")
    assert plant.workspace(()) == ((-1.0, 2.0),) * 3
    assert plant.coefficients(())[-3:] == (30.0, 30.0, 30.0)


def test_joints_by_name_the_others_are_fixed(tmp_path):
    plant = make(tmp_path, URDF, joints=["twig", "turn"])
    assert plant.coordinates == ("turn", "twig")
    model = make(tmp_path, URDF, kind=MODELS, joints=["turn"])
    out = [0.0]
    model.effort(model.coefficients(()), [0.5], [0.0], [0.0], [0.0], out)
    assert out[0] != 0.0


def test_motors_tell_their_limits(tmp_path):
    motor = '</worldbody><actuator><motor joint="j" gear="3" ctrlrange="-2 2"/></actuator>'
    text = MJCF.format("").replace("</worldbody>", motor)
    assert make(tmp_path, text, "arm.xml").coefficients(())[-1] == 6.0


@pytest.mark.parametrize(
    ("text", "given", "wrong"),
    [
        ("", {}, "is not XML"),
        ("<robot", {}, "is not XML"),
        ("<sdf/>", {}, "neither MJCF nor URDF: it begins with <sdf>"),
        ("<mujoco><nonsense/></mujoco>", {}, "cannot be read"),
        ("<mujoco/>", {}, "has no joint that turns or slides"),
        (URDF.replace("revolute", "fixed").replace("prismatic", "fixed"), {}, "has no joint"),
        (URDF.replace(INERTIAL, ""), {}, "lacks mass or inertia"),
        (URDF, {"joints": ["elbow"]}, "no joint 'elbow', the file has turn, slide, twig"),
        (URDF, {"flange": "hand"}, "no site or body 'hand', the file has"),
        (URDF, {"torque_limit": [1.0]}, "1 numbers given, 3 needed (turn, slide, twig)"),
        (URDF, {"tool_position": [1.0]}, "1 numbers given, 3 needed (x, y, z)"),
        (MJCF.format('type="free"'), {}, "joint 'j' is free, only"),
        (MJCF.format('type="ball"'), {}, "joint 'j' is a ball"),
    ],
)
def test_what_cannot_be_used_is_refused_in_one_line(tmp_path, text, given, wrong):
    with pytest.raises(BadInput) as refused:
        make(tmp_path, text, **given)
    assert wrong in str(refused.value)
    assert "\n" not in str(refused.value)


def test_no_such_file_names_what_ships():
    factory = PLANTS["mujoco"]
    with pytest.raises(BadInput, match=r"no file 'robot\.xml', and no arm .*: iiwa, panda, ur5e"):
        factory.make(resolve(factory.parameters, {"file": "robot.xml"}, "plant"))


def test_a_robot_of_the_menagerie(tmp_path, monkeypatch):
    folder = tmp_path / "mujoco_menagerie" / "maker_arm"
    folder.mkdir(parents=True)
    for name in ("arm.xml", "scene.xml"):
        (folder / name).write_text(MJCF.format('axis="0 1 0" damping="1"'))
    monkeypatch.setenv("MUJOCO_MENAGERIE", str(folder.parent))
    factory = PLANTS["mujoco"]

    def made(file):
        return factory.make(resolve(factory.parameters, {"file": file}, "plant"))

    for name in ("maker_arm", "maker_arm/arm", "maker_arm/arm.xml"):
        assert made(name).coordinates == ("j",)
    (folder / "hand.xml").write_text(MJCF)
    with pytest.raises(BadInput, match=r"has the files arm, hand: maker_arm/FILE$"):
        made("maker_arm")
    with pytest.raises(BadInput, match=r"maker_arm/leg: maker_arm of the menagerie has the files"):
        made("maker_arm/leg")
    with pytest.raises(BadInput, match=r"no file 'other_arm'.*MUJOCO_MENAGERIE may name"):
        made("other_arm")


def test_without_mujoco_it_says_what_to_install(monkeypatch):
    from fpt_ros.plants.mujoco import library

    monkeypatch.setitem(sys.modules, "mujoco", None)
    library.bindings.cache_clear()
    with pytest.raises(BadInput, match=r"pip install 'fpt_ros\[robots\]'"):
        library.bindings()
    library.bindings.cache_clear()
