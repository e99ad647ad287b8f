"""Panels as a figure of matplotlib, in the layout of the thesis."""

import io
from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.legend_handler import HandlerTuple
from matplotlib.ticker import FormatStrFormatter, LogLocator, MaxNLocator, NullFormatter

from fpt_ros.analysis import style
from fpt_ros.analysis.panel import Panel
from fpt_ros.analysis.panels import Panels

SHADE = "#f3f4f6"

NO_DATE: dict[str, dict[str, Any]] = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
"""The same runs give the same file."""


def figure(panels: Panels) -> Figure:
    """The figure of finished panels, with an Agg canvas."""
    with style.settings():
        return _Grid(panels).figure


def encoded(drawn: Figure, formats: Sequence[str]) -> dict[str, bytes]:
    """A figure as files of formats that matplotlib knows."""
    files = {}
    with style.settings():
        for kind in formats:
            buffer = io.BytesIO()
            drawn.savefig(buffer, format=kind, metadata=NO_DATE.get(kind))
            files[kind] = buffer.getvalue()
            drawn.set_layout_engine("none")  # found once is enough
    return files


class _Grid:
    """The axes of one figure while it is being drawn."""

    def __init__(self, panels: Panels) -> None:
        self._panels = panels
        lines, columns = panels.shape
        width = {1: 8.0, 2: 10.5}.get(columns, 3.9 * columns)
        if columns == 1 and not panels.time:
            width = 5.6
        self.figure = Figure(figsize=(width, panels.height * lines + 0.9), layout="constrained")
        FigureCanvasAgg(self.figure)
        self._axes = self.figure.subplots(lines, columns, squeeze=False)
        for (name, column), panel in panels.taken.items():
            self._draw(self._at(*panels.place(name, column)), panel)
        self._headings()
        self._outer_labels()
        self.figure.align_ylabels()
        if panels.legend:
            self._legend()

    def _at(self, line: int, column: int) -> Axes:
        axes = self._axes[line][column]
        assert isinstance(axes, Axes)
        return axes

    def _draw(self, axes: Axes, panel: Panel) -> None:
        if panel.shaded is not None:
            axes.axvspan(*panel.shaded, color=SHADE, zorder=0)
        for level in panel.levels:
            axes.axhline(level.at, **level.style)
        for curve in panel.curves:
            style.draw(axes, curve.x, curve.y, curve.style, phase=curve.time is not None)
        foot = panel.y_span[0] if panel.y_span is not None else 0.0
        if panel.bars is not None:
            counts, borders = panel.bars.counts, panel.bars.borders
            look: style.Style = {"color": style.COORDINATES[0], "alpha": 0.75}
            axes.stairs(counts, borders, fill=True, baseline=foot, **look)
        axes.set_xlabel(panel.x_label)
        axes.set_ylabel(panel.y_label)
        if panel.note:
            axes.set_title(panel.note, loc="right", fontweight="normal", color=style.INK)
        if self._panels.logarithmic:
            axes.set_xscale("log")
            axes.set_yscale("log")
        if panel.x_span is not None:
            axes.set_xlim(*panel.x_span)
        if panel.y_span is not None:
            axes.set_ylim(*panel.y_span)
        low, high = axes.get_xlim()
        for mark in panel.marks:
            if low <= mark.at <= high:
                axes.axvline(mark.at, **mark.style)

    def _headings(self) -> None:
        panels = self._panels
        used = {panels.place(*cell) for cell in panels.taken}
        lines, columns = panels.shape
        for line in range(lines):
            for column in range(columns):
                if (line, column) not in used:
                    self._at(line, column).set_axis_off()
        labels = [style.plain(label) for label in panels.labels]
        if panels.abreast > 1:
            self._at(0, 0).set_title(labels[0], loc="left", pad=9)
            return
        noted = any(panel.note for (row, _), panel in panels.taken.items() if row == panels.rows[0])
        for column, label in enumerate(labels):
            # one line higher where a note stands above the panel
            heading = f"{label}\n" if noted else label
            self._at(0, column).set_title(heading, loc="left", pad=6)
            for line, name in enumerate(panels.rows):
                if (name, column) not in panels.taken:
                    text = f"{style.symbol(name)}: no such curve"
                    where = self._at(line, column)
                    where.text(0.5, 0.5, text, ha="center", color=style.WANTED)

    def _outer_labels(self) -> None:
        """Time at the lowest panels only, y labels at the first of each group only."""
        panels = self._panels
        for name, column in panels.taken:
            axes = self._at(*panels.place(name, column))
            if not panels.first_of_group(name, column):
                axes.set_ylabel("")
            if not panels.first_of_scale(name, column):
                axes.tick_params(labelleft=False)
            if panels.logarithmic:
                axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
                axes.xaxis.set_major_formatter(FormatStrFormatter("%g"))
                axes.xaxis.set_minor_formatter(NullFormatter())
                continue
            axes.xaxis.set_major_locator(MaxNLocator(7, steps=[1, 2, 4, 5, 10]))
            if panels.time and panels.lowest(name, column):
                axes.set_xlabel("time [s]")
            elif panels.time:
                axes.tick_params(labelbottom=False)

    def _legend(self) -> None:
        handles: list[Any] = []  # matplotlib's stubs do not know tuples of them
        for entry in self._panels.legend:
            lines = tuple(style.handle(entry.label, look) for look in entry.styles)
            handles.append(lines if len(lines) > 1 else lines[0])
        self.figure.legend(
            handles,
            [style.plain(entry.label) for entry in self._panels.legend],
            loc="outside upper center",
            ncols=len(handles),
            handler_map={tuple: HandlerTuple(ndivide=None, pad=0.3)},
        )
