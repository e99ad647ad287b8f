"""Description files, MJCF or URDF, as MuJoCo reads them, and which joints they have."""

import re
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree

from fpt_ros.errors import BadInput
from fpt_ros.plants.mujoco import menagerie
from fpt_ros.plants.mujoco.library import bindings

ARMS = Path(__file__).parent / "arms"


def shipped() -> tuple[str, ...]:
    """Names of the arms that ship."""
    return tuple(sorted(path.stem for path in ARMS.glob("*.xml")))


def locate(file: str, prefix: str = "") -> Path:
    """The path of a file, of an arm that ships, or of a robot of MuJoCo Menagerie.

    Raises:
        BadInput: there is none of these; ``prefix`` is what the message begins with.
    """
    if file in shipped():
        return ARMS / f"{file}.xml"
    path = Path(file).expanduser()
    if path.is_file():
        return path.resolve()
    of_others = menagerie.found(file, prefix)
    if of_others is not None:
        return of_others
    raise BadInput(
        f"{prefix}there is no file '{file}', and no arm of this name ships: "
        f"{', '.join(shipped())} ({menagerie.FOLDER} may name a checkout of {menagerie.SOURCE})"
    )


def _parsed(text: bytes) -> ElementTree.Element:
    try:
        return ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        if "unbound prefix" not in str(error):
            raise
        # ROS does not mind prefixes that nobody has declared, as drake:acceleration
        return ElementTree.fromstring(re.sub(rb"(</?|\s)(\w+):(\w+)", rb"\1\2.\3", text))


def read(path: Path, where: str) -> Any:
    """The file as MuJoCo's MjSpec.

    Of a URDF, shapes are left out: their meshes are often not there, and inertia is given.
    """
    mujoco = bindings()
    try:
        text = path.read_bytes()
        if re.search(rb"<xacro:(include|macro|property|arg)\b", text):
            raise BadInput(
                f"{where} is a xacro file: make a URDF of it first, xacro FILE > arm.urdf"
            )
        root = _parsed(text)
        if root.tag == "robot":
            for link in root.iter("link"):
                for shape in [*link.findall("visual"), *link.findall("collision")]:
                    link.remove(shape)
            for joint in _without_room(root):
                joint.set("type", "fixed")
            return mujoco.MjSpec.from_string(ElementTree.tostring(root, encoding="unicode"))
        if root.tag != "mujoco":
            raise BadInput(f"{where} is neither MJCF nor URDF: it begins with <{root.tag}>")
        return mujoco.MjSpec.from_file(str(path))
    except ElementTree.ParseError as error:
        raise BadInput(f"{where} is not XML: {error}") from error
    except (OSError, ValueError) as error:
        raise BadInput(f"{where} cannot be read: {reason(error)}") from error


def _without_room(root: ElementTree.Element) -> list[ElementTree.Element]:
    """Joints of a URDF whose limits are equal, which MuJoCo would take for no limits."""
    found = []
    for joint in root.iter("joint"):
        limit = joint.find("limit")
        if limit is not None and joint.get("type") in ("revolute", "prismatic"):
            low, high = (float(limit.get(end, "0")) for end in ("lower", "upper"))
            if low == high:
                found.append(joint)
    return found


class Joints(NamedTuple):
    """The joints of a file: those that can be moved, and why the others cannot.

    ``home``: where the file's key frame ``home`` (or its first one) has those that can; empty.
    """

    movable: tuple[str, ...]
    others: dict[str, str]
    home: dict[str, float]


def joints_of(path: Path) -> Joints:
    """Which joints of a file can be moved, each by itself.

    Raises:
        BadInput: the file cannot be read, or closes a loop.
    """
    spec, kinds = read(path, str(path)), bindings().mjtJoint
    loops = (bindings().mjtEq.mjEQ_CONNECT, bindings().mjtEq.mjEQ_WELD)
    for each in spec.equalities:
        if each.type in loops and each.active:
            raise BadInput(
                f"{path} closes a loop between '{each.name1}' and '{each.name2}' (connect or "
                "weld): only trees of joints can be modelled"
            )
    follows = followers(spec)
    root = _parsed(path.read_bytes())
    stuck = _without_room(root) if root.tag == "robot" else []
    others = {joint.get("name", ""): "has equal limits" for joint in stuck}
    movable, posture, at = [], {}, 0
    for joint in named(spec):
        posture[joint.name] = at
        if joint.type in (kinds.mjJNT_HINGE, kinds.mjJNT_SLIDE):
            at += 1
            if joint.name in follows:
                others[joint.name] = f"follows {follows[joint.name]}"
            else:
                movable.append(joint.name)
        else:
            free = joint.type == kinds.mjJNT_FREE
            at += 7 if free else 4
            others[joint.name] = "is free" if free else "is a ball"
    keys = sorted(spec.keys, key=lambda key: key.name != "home")
    known = list(keys[0].qpos) if keys and len(keys[0].qpos) == at else []
    home = {name: float(known[posture[name]]) for name in movable if known}
    return Joints(tuple(movable), others, home)


def named(spec: Any) -> list[Any]:
    """All joints; those without a name get one."""
    for i, joint in enumerate(spec.joints):
        joint.name = joint.name or f"joint{i + 1}"
    return list(spec.joints)


def followers(spec: Any) -> dict[str, str]:
    """Joints that another one moves (mimic of a URDF, equality of an MJCF), with its name."""
    kind = bindings().mjtEq.mjEQ_JOINT
    return {each.name1: each.name2 for each in spec.equalities if each.type == kind and each.name2}


def reason(error: Exception) -> str:
    """What is wrong, in one line."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    text = "; ".join(lines[:2]).removeprefix("Error: ")
    if "mass and inertia" in text:
        place = lines[1].removeprefix("Element name ") if len(lines) > 1 else ""
        return f"lacks mass or inertia of a moving body: {place}"
    return text
