"""The plots of one figure, at their places in its grid."""

from typing import Any

from bokeh.events import DoubleTap
from bokeh.models import ColumnDataSource, CustomJS, Range1d
from bokeh.models.annotations import BoxAnnotation, Legend, LegendItem
from bokeh.models.annotations import Span as Line
from bokeh.plotting import figure

from fpt_ros.analysis import style
from fpt_ros.analysis.panel import Curve, Panel
from fpt_ros.analysis.panels import Panels
from fpt_ros.analysis.plots import parts
from fpt_ros.analysis.plots.parts import Renderer, home_range
from fpt_ros.analysis.plots.pool import Pool

INCH = 96
"""Pixels of an inch, as browsers have it."""

LEGEND = 28
"""Pixels that a legend takes above a plot."""


class Drawing:
    """The plots of one figure while they are being made.

    Args:
        panels: what they show.
        pool: has the numbers of all curves over time.
        window: of time that is shown.

    Attributes:
        rows: what the script in the page needs: of each y axis whether it follows the window, and
            the curves on it.
    """

    def __init__(self, panels: Panels, pool: Pool, window: Range1d) -> None:
        self._panels, self._pool = panels, pool
        self.window = window
        self.rows: list[dict[str, Any]] = []
        self._rows: dict[object, dict[str, Any]] = {}
        self._pointer = Line(dimension="height", line_color=parts.FRAME, line_width=1)
        self._entries = [entry.label for entry in panels.legend]
        self._kinds: dict[int, dict[str, list[Renderer]]] = {}

    def grid(self) -> list[list[figure | None]]:
        """All plots at their places; ``None`` where there is none."""
        lines, columns = self._panels.shape
        grid: list[list[figure | None]] = [[None] * columns for _ in range(lines)]
        for (name, column), panel in self._panels.taken.items():
            line, at = self._panels.place(name, column)
            grid[line][at] = self._plot(name, column, panel)
        for at, kinds in self._kinds.items():
            top = next(plot for line in grid if (plot := line[at]) is not None)
            _add_legend(top, kinds)
        return grid

    def _plot(self, name: str, column: int, panel: Panel) -> figure:
        panels = self._panels
        row = self._row(name, column, panel)
        x_range = self.window if panels.time else home_range(panel.x_span or (0.0, 1.0))
        plot = parts.empty(
            parts.Frame(
                x_range,
                row["y"],
                self._x_label(name, column, panel),
                style.spoken(panel.y_label),
                self._title(name, column, panel),
                round(INCH * panels.height),
                panels.logarithmic,
            ),
            parts.tools(panels.time, self._pointer),
        )
        if panel.shaded is not None:
            left, right = panel.shaded
            shade: dict[str, Any] = {"fill_color": parts.SHADE, "level": "underlay"}
            plot.add_layout(BoxAnnotation(left=left, right=right, **shade))
        parts.add_bars(plot, panel)
        for mark in panel.levels:
            self._know(mark.label, column, parts.add_mark(plot, mark, level=True))
        for mark in panel.marks:
            self._know(mark.label, column, parts.add_mark(plot, mark))
        lines = [
            self._curve(plot, column, row, curve)
            for curve in sorted(panel.curves, key=lambda curve: curve.style.get("zorder", 2))
        ]
        parts.add_hover(plot, lines, "time" if panels.time else style.spoken(panel.x_label))
        home = CustomJS(args={"x": x_range, "y": row["y"]}, code="x.reset(); y.reset()")
        plot.js_on_event(DoubleTap, home)
        return plot

    def _row(self, name: str, column: int, panel: Panel) -> dict[str, Any]:
        """The y axis of a panel, which others of its row may have as well."""
        key = name, self._panels.scale_of(name, column)
        if key not in self._rows:
            y = home_range(panel.y_span or (0.0, 1.0))
            row = {"y": y, "follows": self._panels.time, "curves": []}
            self._rows[key] = row
            self.rows.append(row)
        return self._rows[key]

    def _curve(self, plot: figure, column: int, row: dict[str, Any], curve: Curve) -> Renderer:
        timed = self._panels.time or curve.time is not None
        first = 0 if timed else None  # the script in the page fills it
        shown = ColumnDataSource({"x": curve.x[:first], "y": curve.y[:first]})
        line = parts.add_line(plot, shown, curve)
        if timed:
            full, columns = self._pool.of(curve)
            row["curves"].append({"full": full, "columns": columns, "shown": shown, "line": line})
        self._know(curve.label, column, line)
        return line

    def _know(self, kind: str, column: int, line: Renderer) -> None:
        """Remember a line for the legend, if its kind has an entry."""
        if kind in self._entries:
            at = column if self._panels.abreast == 1 else 0
            self._kinds.setdefault(at, {}).setdefault(kind, []).append(line)

    def _x_label(self, name: str, column: int, panel: Panel) -> str:
        if not self._panels.time:
            return style.spoken(panel.x_label)
        return "time [s]" if self._panels.lowest(name, column) else ""

    def _title(self, name: str, column: int, panel: Panel) -> str:
        """The run's name above its column, and the note."""
        top = self._panels.place(name, column)[0] == 0 and self._panels.abreast == 1
        heading = self._panels.labels[column] if top else ""
        return ": ".join(filter(None, (heading, panel.note)))


def _add_legend(top: figure, kinds: dict[str, list[Renderer]]) -> None:
    """A legend above a column that hides a kind of curve in all of its plots."""
    items = [LegendItem(label=kind, renderers=lines) for kind, lines in kinds.items()]
    legend = Legend(items=items, click_policy="hide", orientation="horizontal")
    legend.location, legend.border_line_color = "top_left", None
    legend.update(margin=0, padding=2, spacing=16)
    top.add_layout(legend, "above")
    top.height = (top.height or 0) + LEGEND
