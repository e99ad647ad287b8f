"""The arm in its posture: lines between the frames of its joints, the nominal posture behind."""

from collections.abc import Mapping

import numpy as np
from bokeh.models import ColumnDataSource, Range1d
from bokeh.plotting import figure

from fpt_ros.analysis import style
from fpt_ros.analysis.arm.film import PLANT as MUJOCO
from fpt_ros.analysis.arm.lines import GHOST, seen
from fpt_ros.analysis.arm.scene import Scene
from fpt_ros.errors import BadInput
from fpt_ros.parameters import Value, resolve
from fpt_ros.runs.run import Array
from fpt_ros.watch.robot import DEFORMER, PLANT

SIZE = 300
"""Of the drawing in pixels."""


class ArmDrawing:
    """A figure; ``names``: of the joints whose positions it is shown."""

    def __init__(self, values: Mapping[str, Value], prefix: str) -> None:
        from fpt_ros.plants.mujoco.description import PARAMETERS, arm

        known = {parameter.name for parameter in PARAMETERS}
        own = {key.removeprefix(f"{prefix}."): value for key, value in values.items()}
        given = {name: value for name, value in own.items() if name in known}
        described = arm(resolve(PARAMETERS, given, "arm"), "")
        self.names = described.names
        self._scene = Scene(described, {name: np.zeros((2, 1)) for name in self.names})
        self._low, self._high = np.full(2, np.inf), np.full(2, -np.inf)
        self.plot = figure(
            width=SIZE,
            height=SIZE,
            x_range=Range1d(start=-1.0, end=1.0),
            y_range=Range1d(start=-1.0, end=1.0),
            tools="",
            toolbar_location=None,
            title="Posture, and the nominal one behind",
            name="arm",
            outline_line_color=None,
        )
        self.plot.axis.visible = self.plot.grid.visible = False
        self._lines = [ColumnDataSource({"x": [], "y": []}) for _ in range(2)]
        looks = ((GHOST, 7), (style.COORDINATES[0], 5))
        for source, (colour, width) in zip(self._lines, looks, strict=True):
            self.plot.multi_line("x", "y", source=source, line_color=colour, line_width=width)
        self._joints = ColumnDataSource({"x": [], "y": []})
        self.plot.scatter("x", "y", source=self._joints, size=8, color=style.COORDINATES[0])

    def show(self, nominal: Mapping[str, float], real: Mapping[str, float]) -> None:
        """Positions [rad or m] by joint; of a joint without a nominal one the real one counts."""
        posture = [(nominal.get(n, real.get(n, 0.0)), real.get(n, 0.0)) for n in self.names]
        drawn = self._scene.posture(np.nan_to_num(np.array(posture)))
        ends = self._scene.ends
        bodies = sorted({end for pair in ends for end in pair})
        for source, data in zip(self._lines, drawn, strict=True):
            points = seen(self._scene, data.xpos)
            source.data = {
                "x": [[points[parent][0], points[body][0]] for body, parent in ends],
                "y": [[points[parent][1], points[body][1]] for body, parent in ends],
            }
            self._hold(points[bodies])
        self._joints.data = {"x": points[bodies, 0], "y": points[bodies, 1]}

    def _hold(self, points: Array) -> None:
        """The picture grows where the arm would leave it."""
        low, high = points.min(axis=0), points.max(axis=0)
        if (low >= self._low).all() and (high <= self._high).all():
            return
        self._low, self._high = np.minimum(low, self._low), np.maximum(high, self._high)
        middle = 0.5 * (self._low + self._high)
        half = 0.6 * float((self._high - self._low).max()) + 0.05
        for span, at in zip((self.plot.x_range, self.plot.y_range), middle, strict=True):
            span.update(start=at - half, end=at + half)


def arm_of(values: Mapping[str, Mapping[str, Value]]) -> ArmDrawing | None:
    """The drawing of a graph's arm, from its nodes' parameters; ``None``: it has none."""
    for node, word, prefix in ((PLANT, "plant", "exact"), (DEFORMER, "model", "approximate")):
        own = values.get(node, {})
        if own.get(word) == MUJOCO:
            try:
                return ArmDrawing(own, prefix)
            except (BadInput, ImportError):
                return None
    return None
