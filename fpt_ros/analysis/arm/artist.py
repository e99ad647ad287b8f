"""The process that draws: from a folder with the arm and its motion to a film and a still.

``python -m fpt_ros.analysis.arm.artist FOLDER WAY RATE``, with MUJOCO_GL set to suit.
"""

import json
import sys
from pathlib import Path

import numpy as np
from PIL import Image

from fpt_ros.analysis.arm import lines, rendered
from fpt_ros.analysis.arm.scene import Scene
from fpt_ros.parameters import resolve
from fpt_ros.plants.mujoco.description import PARAMETERS, arm

QUALITY = 70
"""Of the film's pictures."""


def main(folder: Path, way: str, rate: int) -> None:
    """Draw, and write ``film.webp`` and ``still.png`` into the folder."""
    known = {parameter.name for parameter in PARAMETERS}
    about = json.loads((folder / "arm.json").read_text())
    given = {name: value for name, value in about["exact"].items() if name in known}
    motion = dict(zip(about["joints"], np.load(folder / "motion.npy"), strict=True))
    scene = Scene(arm(resolve(PARAMETERS, given, "arm"), ""), motion)
    draw = lines.draw if way == "lines" else rendered.draw
    pictures = [Image.fromarray(pixels) for pixels in draw(scene)]
    pictures[len(pictures) // 2].save(folder / "still.png", optimize=True)
    first, *rest = pictures
    first.save(
        folder / "film.webp",
        save_all=True,
        append_images=rest,
        duration=round(1000 / rate),
        loop=0,
        quality=QUALITY,
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2], int(sys.argv[3]))
