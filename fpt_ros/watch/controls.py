"""Sliders and fields for the live parameters of a graph."""

import html
import math
from collections.abc import Callable
from typing import Any

from bokeh.layouts import column, row
from bokeh.models import CustomJSTickFormatter, LayoutDOM, TabPanel, Tabs
from bokeh.models.dom import HTML
from bokeh.models.ui.tooltips import Tooltip
from bokeh.models.widgets.inputs import Checkbox, Select, TextInput
from bokeh.models.widgets.markups import Div
from bokeh.models.widgets.sliders import Slider

from fpt_ros.errors import BadInput
from fpt_ros.experiments.parameter_file import scalar
from fpt_ros.parameters import Value
from fpt_ros.watch.robot import Live, Robot
from fpt_ros.watch.scales import Scale, scale

BOOL, INTEGER, DOUBLE, STRING = 1, 2, 3, 4
NUMBERS = (INTEGER, DOUBLE)
LISTS = (7, 8)

LONGEST = 12
"""Numbers of a list that get a slider each."""

Change = Callable[[Live, Value], None]
"""Is told what the user has chosen."""


class Controls:
    """The parameters of one robot.

    Nothing is sent that the user has not touched: what a widget tells when it is given the graph's
    own value is the value that it shows already.

    Attributes:
        root: what stands in the page.
        live: the parameters.
    """

    def __init__(self, robot: Robot, change: Change) -> None:
        self._robot, self.live = robot, robot.live
        self._rows = [_row(live, change) for live in robot.live]
        tabs = []
        for node in dict.fromkeys(live.node for live in robot.live):
            rows = [each.root for each in self._rows if each.live.node == node]
            body = column(rows, sizing_mode="stretch_width", styles=_SCROLLS)
            tabs.append(TabPanel(child=body, title=node))
        self.root: LayoutDOM = Tabs(tabs=tabs, sizing_mode="stretch_width", name="parameters")
        self.refresh()

    def refresh(self) -> None:
        """Show the values that the graph has."""
        for each in self._rows:
            value = self._robot.values.get(each.live.node, {}).get(each.live.name)
            if value is not None:
                each.show(value)


_SCROLLS: Any = {"max-height": "460px", "overflow-y": "auto"}


class _Row:
    """One parameter; ``value``: what the graph has."""

    def __init__(self, live: Live, change: Change) -> None:
        self.live, self._change = live, change
        self.value: Value | None = None
        self.root: LayoutDOM

    def show(self, value: Value) -> None:
        """The graph has this value."""
        raise NotImplementedError

    def chosen(self, value: Value) -> None:
        """The user wants this value."""
        if self.value is not None and value != self.value:
            self._change(self.live, value)

    @property
    def label(self) -> dict[str, Any]:
        """Name, and on its help what the parameter means."""
        live = self.live
        text = f"<b>{html.escape(live.name)}</b>: {html.escape(live.text)}<br>"
        tip = Tooltip(content=HTML(html=text + html.escape(live.valid)), position="left")
        return {"title": live.name, "description": tip}


def _row(live: Live, change: Change) -> _Row:
    if live.kind == BOOL:
        return _Switch(live, change)
    if live.choices:
        return _Choice(live, change)
    return _Field(live, change)


class _Switch(_Row):
    def __init__(self, live: Live, change: Change) -> None:
        super().__init__(live, change)
        self._box = Checkbox(label=live.name, name=f"{live.node}.{live.name}")
        self._box.on_change("active", lambda attr, old, new: self.chosen(bool(new)))
        self.root = row(self._box, Div(text=html.escape(live.text), styles=_SOFT))

    def show(self, value: Value) -> None:
        self.value = bool(value)
        self._box.active = self.value


class _Choice(_Row):
    def __init__(self, live: Live, change: Change) -> None:
        super().__init__(live, change)
        name = f"{live.node}.{live.name}"
        options: Any = live.choices
        self._select = Select(options=options, name=name, width=200, **self.label)
        self._select.on_change("value", lambda attr, old, new: self.chosen(str(new)))
        self.root = row(self._select)

    def show(self, value: Value) -> None:
        self.value = str(value)
        self._select.value = self.value


class _Field(_Row):
    """A field for any value and, of numbers, a slider each."""

    def __init__(self, live: Live, change: Change) -> None:
        super().__init__(live, change)
        name = f"{live.node}.{live.name}"
        self._text = TextInput(name=name, width=170, **self.label)
        self._text.on_change("value", lambda attr, old, new: self._typed(new))
        self._sliders: list[_Slider] = []
        self._beside = column(sizing_mode="stretch_width")
        valid = Div(text=html.escape(_short(live)), styles=_SOFT, width=120)
        self.root = row(self._text, self._beside, valid, sizing_mode="stretch_width")

    def show(self, value: Value) -> None:
        self.value = list(value) if isinstance(value, list | tuple) else value
        self._text.value = _text(self.value)
        numbers = _numbers(self.live, self.value)
        if len(numbers) != len(self._sliders):
            name = f"{self.live.node}.{self.live.name}"
            self._sliders = [
                _Slider(self.live, f"slider {name} {i}", number, self._moved(i))
                for i, number in enumerate(numbers)
            ]
            self._beside.children = [each.root for each in self._sliders]
        for slider, number in zip(self._sliders, numbers, strict=True):
            slider.show(number)

    def _moved(self, at: int) -> Callable[[float], None]:
        def moved(number: float) -> None:
            whole = self.live.kind in (INTEGER, 7)
            value: Any = round(number) if whole else number
            if isinstance(self.value, list):
                value = [value if i == at else old for i, old in enumerate(self.value)]
            self.chosen(value)

        return moved

    def _typed(self, text: str) -> None:
        if self.value is None or text == _text(self.value):
            return
        if self.live.kind == STRING:
            self.chosen(text)
            return
        try:
            value: Any = scalar(text)
        except BadInput:
            value = text
        if self.live.kind == DOUBLE and type(value) is int:
            value = float(value)
        if self.live.kind == 8 and isinstance(value, list):
            value = [float(x) if type(x) is int else x for x in value]
        self.chosen(value)


class _Slider:
    """One number; in proportion or in decades."""

    def __init__(self, live: Live, name: str, value: float, moved: Callable[[float], None]) -> None:
        self._live, self._moved = live, moved
        self._scale = self._fitting(value)
        self.root = Slider(
            title=None,
            show_value=False,
            name=name,
            sizing_mode="stretch_width",
            margin=(22, 5, 5, 5),
            **self._ends(),
        )
        self.root.value = self._scale.place(value)
        # told when the handle is let go, and by nothing else
        self.root.on_change("value_throttled", lambda attr, old, new: self._let_go(new))

    def show(self, value: float) -> None:
        """The graph has this value."""
        if not math.isfinite(value):
            return
        if not self._scale.holds(value):
            self._scale = self._fitting(value)
            self.root.update(value=self._scale.place(value), **self._ends())
        self.root.value = self._scale.place(value)

    def _let_go(self, place: float) -> None:
        self._moved(self._scale.value(place))

    def _fitting(self, value: float) -> Scale:
        live = self._live
        return scale(value, live.low, live.high, whole=live.kind in (INTEGER, 7))

    def _ends(self) -> dict[str, Any]:
        own = self._scale
        code = f"return ({own.sign} * 10 ** tick).toPrecision(4)" if own.sign else "return tick"
        form = CustomJSTickFormatter(code=code)
        return {"start": own.start, "end": own.end, "step": own.step, "format": form}


_SOFT: Any = {"color": "#5b6675", "font-size": "12px", "margin-top": "20px"}


def _numbers(live: Live, value: Value) -> list[float]:
    """What gets a slider."""
    if live.kind in NUMBERS and isinstance(value, int | float):
        return [float(value)]
    if live.kind in LISTS and isinstance(value, list) and len(value) <= LONGEST:
        return [float(x) for x in value]
    return []


def _short(live: Live) -> str:
    """Range and unit."""
    return live.valid.removeprefix("a number").removeprefix("a list of numbers").strip()


def _text(value: Value) -> str:
    if isinstance(value, float):
        return f"{value:.10g}" if float(f"{value:.10g}") == value else repr(value)
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_text(x) for x in value) + "]"
    return str(value)
