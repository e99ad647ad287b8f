"""Pictures without OpenGL: lines between the frames of the joints."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from fpt_ros.analysis.arm.scene import AZIMUTH, ELEVATION, HEIGHT, WIDTH, Scene
from fpt_ros.runs.run import Array

REAL, GHOST, GROUND = "#0072b2", "#f0b48a", "#eef0f4"

FINER = 2
"""Drawn so many times larger, for smooth lines."""


def draw(scene: Scene) -> Iterator[NDArray[np.uint8]]:
    """A picture for each posture, (height, width, 3)."""
    for nominal, real in scene.postures():
        picture = Image.new("RGB", (FINER * WIDTH, FINER * HEIGHT), GROUND)
        pen = ImageDraw.Draw(picture)
        _arm(pen, scene, nominal, GHOST, 7)
        _arm(pen, scene, real, REAL, 5)
        yield np.asarray(picture.resize((WIDTH, HEIGHT), Image.Resampling.LANCZOS))


def _arm(pen: ImageDraw.ImageDraw, scene: Scene, data: Any, colour: str, width: int) -> None:
    points = _pixels(scene, data.xpos)
    for body, parent in scene.ends:
        pen.line([*points[parent], *points[body]], fill=colour, width=FINER * width)
    for body in dict.fromkeys(end for pair in scene.ends for end in pair):
        x, y = points[body]
        r = 0.9 * FINER * width
        pen.ellipse([x - r, y - r, x + r, y + r], fill=colour)


def seen(scene: Scene, places: Array) -> Array:
    """(N, 2) across and up [m] of points [m], seen without perspective from the camera."""
    a, e = math.radians(AZIMUTH), math.radians(ELEVATION)
    right = np.array([math.sin(a), -math.cos(a), 0.0])
    up = np.array([-math.cos(a) * math.sin(e), -math.sin(a) * math.sin(e), math.cos(e)])
    from_middle = places - scene.look_at
    return np.stack((from_middle @ right, from_middle @ up), axis=1)


def _pixels(scene: Scene, places: Array) -> Array:
    """(N, 2) of points [m]."""
    points = 1.15 * FINER * HEIGHT / scene.size * seen(scene, places)
    across, down = FINER * WIDTH / 2 + points[:, 0], FINER * HEIGHT / 2 - points[:, 1]
    return np.stack((across, down), axis=1)
