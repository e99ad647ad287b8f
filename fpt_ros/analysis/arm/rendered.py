"""Pictures by MuJoCo's own renderer, on OpenGL."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fpt_ros.analysis.arm.scene import AZIMUTH, ELEVATION, HEIGHT, WIDTH, Scene
from fpt_ros.plants.mujoco.library import bindings

REAL, GHOST = (0.0, 0.447, 0.698, 1.0), (0.95, 0.45, 0.1, 0.4)
"""Colours of links without shapes, and of the nominal motion."""

GROUND = (0.93, 0.94, 0.96)
"""Colour of the background."""

THICKNESS = 0.02
"""Of a link without shape, as a part of the arm's size."""


def draw(scene: Scene) -> Iterator[NDArray[np.uint8]]:
    """A picture for each posture, (height, width, 3)."""
    mujoco = bindings()
    scene.model.vis.global_.offwidth = max(int(scene.model.vis.global_.offwidth), WIDTH)
    scene.model.vis.global_.offheight = max(int(scene.model.vis.global_.offheight), HEIGHT)
    scene.model.vis.headlight.ambient[:], scene.model.vis.headlight.diffuse[:] = 0.45, 0.6
    camera, options = mujoco.MjvCamera(), mujoco.MjvOption()
    camera.lookat[:], camera.distance = scene.look_at, scene.distance
    camera.azimuth, camera.elevation = AZIMUTH, ELEVATION
    with mujoco.Renderer(scene.model, HEIGHT, WIDTH) as renderer:
        for nominal, real in scene.postures():
            renderer.update_scene(real, camera, options)
            drawn = renderer.scene
            drawn.flags[int(mujoco.mjtRndFlag.mjRND_SHADOW)] = 0  # half of the time
            drawn.flags[int(mujoco.mjtRndFlag.mjRND_REFLECTION)] = 0
            _links(scene, drawn, real, REAL)
            first = drawn.ngeom
            if not scene.bare:
                every = int(mujoco.mjtCatBit.mjCAT_ALL)
                mujoco.mjv_addGeoms(
                    scene.model, nominal, options, mujoco.MjvPerturb(), every, drawn
                )
                for at in range(first, drawn.ngeom):
                    drawn.geoms[at].rgba = GHOST
                    drawn.geoms[at].matid = -1
                    drawn.geoms[at].emission = 0.6
            _links(scene, drawn, nominal, GHOST)
            pixels = renderer.render()
            pixels[(pixels == 0).all(axis=2)] = np.array(GROUND) * 255
            yield pixels


def _links(scene: Scene, drawn: Any, data: Any, colour: tuple[float, ...]) -> None:
    """Capsules between the joints of an arm without shapes."""
    if not scene.bare:
        return
    mujoco = bindings()
    kind = mujoco.mjtGeom.mjGEOM_CAPSULE
    for body, parent in scene.ends:
        if drawn.ngeom >= drawn.maxgeom:
            return
        geom = drawn.geoms[drawn.ngeom]
        mujoco.mjv_initGeom(
            geom, kind, np.zeros(3), np.zeros(3), np.eye(3).ravel(), np.array(colour, np.float32)
        )
        ends = data.xpos[parent], data.xpos[body]
        mujoco.mjv_connector(geom, kind, THICKNESS * scene.size, *ends)
        drawn.ngeom += 1
