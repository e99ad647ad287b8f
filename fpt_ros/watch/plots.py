"""The figures of the page: they follow the loop, in windows of the same seconds."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from bokeh.models import ColumnDataSource, GridBox, Range1d
from bokeh.models.annotations import Legend, LegendItem
from bokeh.plotting import figure

from fpt_ros.analysis import style
from fpt_ros.analysis.plots.parts import FRAME, GRID
from fpt_ros.watch.curves import FIGURES, Curves
from fpt_ros.watch.robot import LATENCIES, Told

HEIGHT = 190

TITLES = {
    "motion": "Motion: nominal (grey), realised",
    "error": "Tracking error, nominal minus realised",
    "response": "Response: desired, deformed (dashes), observed",
    "effort": "Effort",
    "gain": "Gain A that acts",
    "precursor": "Precursor (-1: oscillation), gain factor",
    "tuned": "Tuned coefficients, weights",
    "latency": "Latency from sensor to command [ms]",
    "missed": "Deadlines missed so far",
}

LATENCY, MISSED = "latency", "missed"


class Plots:
    """All figures; ``root`` is what stands in the page."""

    def __init__(self) -> None:
        self._window = Range1d(start=0.0, end=1.0)
        self._wall = Range1d(start=0.0, end=1.0)
        self._figures = {name: _Figure(name, self._window) for name in FIGURES}
        self._figures |= {name: _Figure(name, self._wall) for name in (LATENCY, MISSED)}
        self.root = GridBox(children=[], sizing_mode="stretch_width")

    def show(
        self,
        found: dict[str, tuple[Curves, ...]],
        joints: Sequence[str],
        span: tuple[float, float],
    ) -> None:
        """Curves of the loop, of these coordinates, in a window [s]."""
        for name, groups in found.items():
            self._figures[name].show(groups, joints)
        self._window.update(start=span[0], end=span[1])
        self._place()

    def show_latencies(self, told: Sequence[Told]) -> None:
        """Latencies and misses of the last minutes, if there are any."""
        if not told:
            for name in (LATENCY, MISSED):
                self._figures[name].is_empty = True
            return
        x = np.array([each.at - told[-1].at for each in told])
        columns = zip(*[each.latencies for each in told], strict=True)
        names = [key.removeprefix("latency ").removesuffix(" [ms]") for key in LATENCIES]
        latencies = {name: np.array(each) for name, each in zip(names, columns, strict=True)}
        missed = {"misses": np.array([float(each.misses) for each in told])}
        self._figures[LATENCY].show((Curves(x, latencies),), names)
        self._figures[MISSED].show((Curves(x, missed),), ["misses"])
        self._wall.update(start=min(x[0], -10.0), end=0.0)

    def _place(self) -> None:
        """Two in a row, those that show something."""
        plots = [each.plot for each in self._figures.values() if not each.is_empty]
        if plots != [child[0] for child in self.root.children]:
            places: Any = [(plot, at // 2, at % 2) for at, plot in enumerate(plots)]
            self.root.children = places


class _Figure:
    """One figure; its curves come and go."""

    def __init__(self, name: str, window: Range1d) -> None:
        self.plot = figure(
            height=HEIGHT,
            title=TITLES[name],
            x_range=window,
            y_range=Range1d(start=0.0, end=1.0),
            tools="",
            toolbar_location=None,
            name=name,
            outline_line_color=None,
            output_backend="canvas",
            lod_threshold=None,
            sizing_mode="stretch_width",
        )
        for axis in self.plot.axis:
            axis.axis_line_color = axis.major_tick_line_color = FRAME
            axis.minor_tick_line_color = None
        self.plot.grid.grid_line_color = GRID
        self._legend = Legend(
            orientation="horizontal",
            click_policy="hide",
            border_line_color=None,
            margin=0,
            label_text_font_size="11px",
            glyph_height=12,
            glyph_width=16,
            spacing=8,
        )
        self.plot.add_layout(self._legend, "above")
        self.is_empty = True
        self._sources: list[ColumnDataSource] = []
        self._labels: list[list[str]] = []

    def show(self, groups: tuple[Curves, ...], names: Sequence[str]) -> None:
        labels = [list(group.y) for group in groups]
        if labels != self._labels:
            self._draw(labels, names)
        for source, group in zip(self._sources, groups, strict=True):
            source.data = {"x": group.x, **group.y}
        span = style.span([y for group in groups for y in group.y.values()])
        if span is not None:
            self.plot.y_range.update(start=span[0], end=span[1])
        self.is_empty = not any(labels)

    def _draw(self, labels: list[list[str]], names: Sequence[str]) -> None:
        self._labels = labels
        self.plot.renderers = []
        self._sources = [ColumnDataSource({"x": [], **{y: [] for y in own}}) for own in labels]
        items = []
        for at, (source, own) in enumerate(zip(self._sources, labels, strict=True)):
            for i, label in enumerate(own):
                look = _look(at, len(labels), i, label, names)
                line: Any = self.plot.line("x", label, source=source, name=label, **look)
                if at == len(labels) - 1:  # the title names the others
                    items.append(LegendItem(label=label.partition(" ")[0], renderers=[line]))
        self._legend.items = items if len(items) < 14 else []


def _look(group: int, groups: int, at: int, label: str, names: Sequence[str]) -> dict[str, Any]:
    """A band behind for what is wanted, dashes for what is deformed, as in the report."""
    name = label.partition(" ")[0]
    i = list(names).index(name) if name in names else at
    colour = style.COORDINATES[i % len(style.COORDINATES)]
    if groups > 1 and group == 0:
        return {"line_color": style.WANTED, "line_width": 3.6}
    if groups == 3 and group == 1:
        return {
            "line_color": style.DEFORMED if len(names) == 1 else colour,
            "line_width": 1.3,
            "line_dash": [8, 3],
        }
    return {"line_color": colour, "line_width": 1.3}
