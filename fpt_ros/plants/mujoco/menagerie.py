"""Robots of MuJoCo Menagerie by their names there, from a checkout of it.

Menagerie is a git repository, not a package: ``git clone --depth 1
https://github.com/google-deepmind/mujoco_menagerie``, and ``MUJOCO_MENAGERIE`` names the folder.
"""

import os
from pathlib import Path

from fpt_ros.errors import BadInput

FOLDER = "MUJOCO_MENAGERIE"
"""Environment variable: where the checkout is."""

SOURCE = "https://github.com/google-deepmind/mujoco_menagerie"


def found(name: str, prefix: str = "") -> Path | None:
    """The file of ``ROBOT`` or ``ROBOT/FILE``, as ``franka_emika_panda/panda``.

    ``None``: there is no checkout, or no such robot in it.

    Raises:
        BadInput: the robot has several files, or not this one; ``prefix`` begins the message.
    """
    checkout = os.environ.get(FOLDER, "")
    robot, _, file = name.partition("/")
    folder = Path(checkout).expanduser() / robot
    if not checkout or not robot or not folder.is_dir():
        return None
    files = {path.stem: path for path in folder.glob("*.xml") if not path.stem.startswith("scene")}
    chosen = file.removesuffix(".xml") or (next(iter(files)) if len(files) == 1 else "")
    if chosen not in files:
        raise BadInput(
            f"{prefix}{name}: {robot} of the menagerie has the files "
            f"{', '.join(sorted(files)) or 'none'}: {robot}/FILE"
        )
    return files[chosen].resolve()
