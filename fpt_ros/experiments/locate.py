"""Where the package's data files are: source tree, colcon workspace or pip installation."""

import os
import sys
from functools import cache
from pathlib import Path

from fpt_ros.errors import BadInput


@cache
def share_directory() -> Path:
    """The folder that holds ``config/`` and ``launch/``.

    Raises:
        BadInput: the package is not installed.
    """
    prefixes = [Path(p) for p in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if p]
    candidates = [
        Path(__file__).parents[2],
        *(prefix / "share" / "fpt_ros" for prefix in (*prefixes, Path(sys.prefix))),
    ]
    for folder in candidates:
        if (folder / "package.xml").is_file() and (folder / "config").is_dir():
            return folder
    raise BadInput("the config folder of fpt_ros is not installed: run make setup or colcon build")


def config_directory() -> Path:
    """The folder of the experiments' parameter files."""
    return share_directory() / "config"
