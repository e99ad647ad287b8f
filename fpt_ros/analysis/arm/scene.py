"""What is drawn: the arm in its postures, and where one looks from."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from fpt_ros.plants.mujoco.description import Arm
from fpt_ros.plants.mujoco.library import bindings
from fpt_ros.runs.run import Array

WIDTH, HEIGHT = 480, 360
"""Of a picture."""

AZIMUTH, ELEVATION = 125.0, -18.0
"""Where one looks from [degrees]."""


class Scene:
    """An arm and its motion.

    Attributes:
        model: of MuJoCo, with the tool.
        ends: bodies with their parents, between which there are links.
        look_at, distance: of the camera.
        size: of the arm [m].
    """

    def __init__(self, arm: Arm, motion: dict[str, Array]) -> None:
        """Take an arm, and nominal and realised positions by joint, (2, frames) each."""
        self.model, self._mujoco = arm.loaded, bindings()
        self._data = [self._mujoco.MjData(self.model) for _ in range(2)]
        self._at = [arm.names.index(name) for name in motion]
        self._motion = np.array(list(motion.values()))
        parents = self.model.body_parentid
        self.ends = [(body, int(parents[body])) for body in range(1, self.model.nbody)]
        self.ends = [(body, parent) for body, parent in self.ends if parent > 0]
        reached = np.concatenate([real.xpos[1:].copy() for _, real in self.postures(stride=5)])
        low, high = reached.min(axis=0), reached.max(axis=0)
        self.look_at = 0.5 * (low + high)
        self.size = max(float(np.linalg.norm(high - low)), 1e-3)
        self.distance = 1.05 * self.size

    def postures(self, stride: int = 1) -> Iterator[tuple[Any, Any]]:
        """MjData of the nominal and of the realised posture, for each picture."""
        for frame in range(0, self._motion.shape[2], stride):
            yield self.posture(self._motion[:, :, frame])

    def posture(self, positions: Array) -> tuple[Any, Any]:
        """MjData of the nominal and of the realised posture; (joints, 2) positions."""
        for which, data in enumerate(self._data):
            data.qpos[self._at] = positions[:, which]
            self._mujoco.mj_kinematics(self.model, data)
            self._mujoco.mj_camlight(self.model, data)
        return self._data[0], self._data[1]

    @property
    def bare(self) -> bool:
        """Whether the file has no shapes, so that links are drawn between the joints."""
        return int(self.model.ngeom) == 0
