"""What a plot is made of, in the look of the printed figures."""

import html
from dataclasses import dataclass
from typing import Any, TypeAlias

from bokeh.models import (
    BoxZoomTool,
    ColumnDataSource,
    CrosshairTool,
    HoverTool,
    PanTool,
    Range1d,
    ResetTool,
    SaveTool,
    Tool,
    WheelZoomTool,
)
from bokeh.models.annotations import Span as Line
from bokeh.models.renderers import GlyphRenderer
from bokeh.plotting import figure

from fpt_ros.analysis import style
from fpt_ros.analysis.panel import Curve, Mark, Panel, Span

Renderer: TypeAlias = "GlyphRenderer[Any]"

SHADE = "#f3f4f6"
GRID = "#e5e7eb"
FRAME = "#9ca3af"


@dataclass(frozen=True)
class Frame:
    """Axes of a plot; ``height`` in pixels."""

    x_range: Range1d
    y_range: Range1d
    x_label: str
    y_label: str
    title: str
    height: int
    logarithmic: bool


def home_range(home: Span, **more: Any) -> Range1d:
    """A range that comes back to where it begins."""
    low, high = home
    return Range1d(start=low, end=high, reset_start=low, reset_end=high, **more)


def empty(frame: Frame, tools: list[Tool]) -> figure:
    """A plot with nothing in it yet."""
    plot = figure(
        height=frame.height,
        x_range=frame.x_range,
        y_range=frame.y_range,
        x_axis_type="log" if frame.logarithmic else "linear",
        y_axis_type="log" if frame.logarithmic else "linear",
        x_axis_label=frame.x_label,
        y_axis_label=frame.y_label,
        title=frame.title,
        tools=tools,
        outline_line_color=None,
    )
    plot.toolbar.active_drag = next(tool for tool in tools if isinstance(tool, BoxZoomTool))
    for axis in plot.axis:
        axis.axis_label_text_font_style = "normal"
        axis.axis_line_color = axis.major_tick_line_color = FRAME
        axis.minor_tick_line_color = None
    plot.grid.grid_line_color = GRID
    return plot


def tools(time: bool, pointer: Line) -> list[Tool]:
    """Zoom and pan, in time alone where x is time; there a line that follows the mouse."""
    if not time:
        wheel = WheelZoomTool(modifiers={"ctrl": True})
        return [BoxZoomTool(), PanTool(), wheel, ResetTool(), SaveTool()]
    return [
        BoxZoomTool(dimensions="width"),
        PanTool(dimensions="width"),
        WheelZoomTool(dimensions="width", modifiers={"ctrl": True}),
        ResetTool(),
        SaveTool(),
        CrosshairTool(overlay=pointer),
    ]


def add_line(plot: figure, source: ColumnDataSource, curve: Curve) -> Renderer:
    """A curve whose points are the columns x and y of a source."""
    name = html.escape(curve.label) or "value"
    return plot.line("x", "y", source=source, name=name, **_look(curve.style))


def add_mark(plot: figure, mark: Mark, level: bool = False) -> Renderer:
    """A line across the plot that says what it is where the mouse is on it."""
    look = _look(mark.style)
    line: Renderer = plot.hspan(y=mark.at, **look) if level else plot.vspan(x=mark.at, **look)
    if mark.text:
        # no word of it is a template's: $name and @column
        text = html.escape(mark.text).replace("$", "&#36;").replace("@", "&#64;")
        plot.add_tools(HoverTool(renderers=[line], tooltips=text, visible=False))
    return line


def add_bars(plot: figure, panel: Panel) -> None:
    """A histogram of latencies, where the panel has one."""
    if panel.bars is None:
        return
    borders = panel.bars.borders
    bars = plot.quad(
        left="left",
        right="right",
        top="top",
        bottom=panel.y_span[0] if panel.y_span else 0.0,
        source=ColumnDataSource(
            {"left": borders[:-1], "right": borders[1:], "top": panel.bars.counts}
        ),
        color=style.COORDINATES[0],
        alpha=0.75,
    )
    tip = "@left{%.3g} to @right{%.3g} ms: @top cycles"
    _hover(plot, [bars], tip, "mouse", "left", "right")


def add_hover(plot: figure, lines: list[Renderer], along: str) -> None:
    """The numbers of curves under the mouse; ``along`` is what x is called."""
    if not lines:
        return
    mode, unit = ("vline", " s") if along == "time" else ("mouse", "")
    _hover(plot, lines, f"$name @y{{%.6g}} at {along} @x{{%.9g}}{unit}", mode, "x", "y")


def _hover(plot: figure, lines: list[Renderer], tip: str, mode: str, *numbers: str) -> None:
    given: dict[str, Any] = {
        "tooltips": f'<div style="font-size: 12px">{tip}</div>',
        "formatters": {f"@{name}": "printf" for name in numbers},
        "mode": mode,
    }
    plot.add_tools(HoverTool(renderers=[*lines], visible=False, **given))


def _look(line: style.Style) -> dict[str, Any]:
    """A style of matplotlib as Bokeh has it, whose dashes are in pixels."""
    width = line["linewidth"]
    dash = line.get("linestyle", (0, ()))[1]
    return {
        "line_color": line["color"],
        "line_width": width,
        "line_dash": [max(1, round(1.5 * part * width)) for part in dash],
        "line_join": "round",
    }
