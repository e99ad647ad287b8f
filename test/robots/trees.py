"""Robots at random: branched trees of links with all kinds of joints, as URDF."""

import numpy as np


def tree(seed, joints=7):
    """A robot that hangs from its base; links get lighter outwards.

    Every third joint slides, the fourth is fixed, the sixth mimics the first, others turn; some
    have no limits, some friction, and each hangs on any link before it.
    """
    rng = np.random.default_rng(seed)
    links, parts, first = ["base"], [], ""
    for i in range(joints):
        parent = links[int(rng.integers(max(0, len(links) - 3), len(links)))]
        link, name = f"link{i}", f"joint {i}/{'ab'[i % 2]}"
        kind = "fixed" if i == 3 else "prismatic" if i % 3 == 2 else "revolute"
        kind = "continuous" if i == 4 else kind
        low, high = sorted(rng.uniform(-2.0, 2.0, 2))
        more = f'<limit lower="{low}" upper="{high + 0.3}" effort="500" velocity="1"/>'
        more += f'<dynamics damping="{rng.uniform(0, 2)}" friction="{rng.uniform(0, 1)}"/>'
        more += f'<mimic joint="{first}"/>' if i == 5 else ""
        first = first or name
        axis = rng.normal(size=3)
        parts.append(
            f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{link}"/>'
            f'<origin xyz="{_row(rng.uniform(-0.2, 0.2, 3))}" rpy="{_row(rng.uniform(-1, 1, 3))}"/>'
            f'<axis xyz="{_row(axis / np.linalg.norm(axis))}"/>{more}</joint>'
        )
        links.append(link)
    bodies = [_link(name, 4.0 * 0.7**i, rng) for i, name in enumerate(links)]
    return f'<robot name="tree">{"".join(bodies)}{"".join(parts)}</robot>'


def _link(name, mass, rng):
    a, b, c = mass * rng.uniform(0.01, 0.02, 3)
    return (
        f'<link name="{name}"><inertial><mass value="{mass}"/>'
        f'<origin xyz="{_row(rng.uniform(-0.1, 0.1, 3))}"/>'
        f'<inertia ixx="{a}" iyy="{b}" izz="{c}" ixy="0" ixz="0" iyz="0"/></inertial></link>'
    )


def _row(numbers):
    return " ".join(f"{x:.6f}" for x in numbers)
