"""The page as one browser has it: it follows the loop, and what it is asked goes to the graph."""

import asyncio
import html
from collections import deque
from collections.abc import Coroutine
from time import strftime
from typing import Any

from bokeh.document import Document
from bokeh.events import DocumentReady
from bokeh.layouts import column, row
from bokeh.models import ColumnDataSource, CustomJS, LayoutDOM
from bokeh.models.widgets.buttons import Button
from bokeh.models.widgets.groups import CheckboxButtonGroup
from bokeh.models.widgets.inputs import NumericInput, Select
from bokeh.models.widgets.markups import Div

from fpt_ros.parameters import Value
from fpt_ros.watch.arm import ArmDrawing, arm_of
from fpt_ros.watch.controls import Controls
from fpt_ros.watch.curves import Wanted, curves, joints_of, measured
from fpt_ros.watch.plots import Plots
from fpt_ros.watch.robot import DEFORMER, PLANT, Live, Robot
from fpt_ros.watch.robots import Robots
from fpt_ros.watch.tables import diagnostics

PERIOD = 250
"""Milliseconds between two pictures."""

SHOWN = 4
"""Coordinates that are shown where nobody has chosen any."""

WINDOWS = ("1", "2", "5", "10", "20")
"""Seconds that can be shown."""

BUTTONS = (
    ("pause", f"{PLANT}/pause", "default"),
    ("resume", f"{PLANT}/resume", "default"),
    ("step", f"{PLANT}/step", "default"),
    ("reset", f"{PLANT}/reset", "default"),
    ("stop", f"{PLANT}/stop", "warning"),
    ("E-STOP", f"{DEFORMER}/e_stop", "danger"),
    ("release", f"{DEFORMER}/release", "default"),
)
"""Label, service, and the look of it; one whose service is not there is not shown."""

REST = 14
"""Times as long as it has drawn a picture a browser waits for the next one: it may share its cores
with the loop, and without a graphics card drawing takes a tenth of them even so."""

LONGEST_REST = 3000
"""Milliseconds: on a busy machine most of the time of drawing is waiting, which takes nothing from
anybody, and what a user asked for is answered with the next picture."""

DRAWN = f"""
const began = performance.now();
requestAnimationFrame(() => setTimeout(() => {{
  const rest = Math.min({REST} * (performance.now() - began), {LONGEST_REST});
  setTimeout(() => {{ drawn.data = sent.data }}, rest);
}}));
"""
"""In the browser: it says so when it has drawn what was sent, and rested."""

STYLE = """
<style>
  body { font-family: system-ui, "DejaVu Sans", sans-serif; margin: 12px; background: #f6f7f9; }
</style>
"""

TABLE = """
<style>
  table { border-collapse: collapse; font-size: 12px; width: 100%; }
  th, td { padding: 2px 8px; text-align: left; vertical-align: top; border-top: 1px solid #dfe3e9; }
</style>
"""


class Page:
    """One browser's view of the robots.

    Attributes:
        ended: it is drawn no more.
    """

    def __init__(self, document: Document, robots: Robots) -> None:
        self.ended = False
        self._robots = robots
        self._robot: Robot | None = None
        self._version = self._turn = 0
        self._has_news = False
        self._joints: tuple[str, ...] = ()
        self._arm: ArmDrawing | None = None
        self._controls: Controls | None = None
        self._told: deque[str] = deque(maxlen=6)
        self._tasks: set[asyncio.Task[Any]] = set()
        self._plots = Plots()
        self._state = Div(name="state", styles={"font-size": "15px"})
        self._messages = Div(name="messages", sizing_mode="stretch_width")
        self._table = Div(name="diagnostics", sizing_mode="stretch_width")
        self._choice = Select(title="robot", options=[], width=150, name="robot")
        self._choice.on_change("value", lambda attr, old, new: self._choose(new))
        windows: Any = list(WINDOWS)
        self._seconds = Select(title="seconds", options=windows, value="5", width=80)
        self._shown = CheckboxButtonGroup(labels=[], active=[], name="joints")
        self._cycles = NumericInput(title="cycles a step", value=1, low=1, mode="int", width=90)
        self._buttons = [self._button(*each) for each in BUTTONS]
        self._parameters = column(sizing_mode="stretch_width")
        self._drawing = column()
        self._document = document
        # no widgets: a change of one, though not visible, lays out the whole page anew
        self._sent = ColumnDataSource({"turn": [0]}, name="sent")
        self._drawn = ColumnDataSource({"turn": [0]}, name="drawn")
        drawn = CustomJS(args={"sent": self._sent, "drawn": self._drawn}, code=DRAWN)
        self._sent.js_on_change("data", drawn)
        document.js_on_event(DocumentReady, drawn)  # the first came with the page
        document.title = "fpt watch"
        document.add_root(self._layout())
        self._update()
        document.add_periodic_callback(self.update, PERIOD)

    def _layout(self) -> LayoutDOM:
        top = row(
            self._choice,
            self._seconds,
            self._cycles,
            *[button for _, button in self._buttons],
            self._state,
            sizing_mode="stretch_width",
            styles={"align-items": "end"},
        )
        left = column(
            self._shown, self._plots.root, sizing_mode="stretch_width", styles={"min-width": "0"}
        )
        right = column(self._messages, self._parameters, self._drawing, width=620)
        return column(
            Div(text=STYLE, visible=False),
            top,
            row(left, right, sizing_mode="stretch_width"),
            self._table,
            sizing_mode="stretch_width",
            tags=[self._sent],  # part of the page, not drawn
        )

    def _button(self, label: str, service: str, look: Any) -> tuple[str, Button]:
        button = Button(label=label, button_type=look, width=80, name=f"button {label}")
        button.on_click(lambda: self._press(service))
        button.visible = False
        return service, button

    def update(self) -> None:
        """The next picture, if the browser has drawn the last one: a slow one gets fewer.

        Otherwise they would queue, and what the user does would wait behind them. A tab that is
        not on the screen draws nothing and costs nothing.
        """
        if self.ended or self._drawn.data["turn"] != self._sent.data["turn"]:
            return
        self._document.hold("combine")  # one message, drawn at once
        try:
            self._update()
            self._turn += 1
            self._sent.data = {"turn": [self._turn]}
        finally:
            self._document.unhold()

    def _update(self) -> None:
        if self._has_news:
            self._has_news = False
            self._messages.text = "".join(self._told)
            if self._controls is not None:
                self._controls.refresh()  # what was refused is not shown any longer
        known = self._robots.known
        names: Any = list(known)
        if names != self._choice.options:
            self._choice.options = names
        if self._robot is None and known:
            self._choose(next(iter(known)))
        robot = self._robot
        if robot is None:
            self._state.text = "no graph is running in this ROS_DOMAIN_ID"
            return
        self._choice.value = robot.namespace
        for service, button in self._buttons:
            button.visible = service in robot.triggers
        self._cycles.visible = f"{PLANT}/step" in robot.triggers
        self._follow(robot)
        self._show(robot)
        if self._turn % 4 == 0:
            self._table.text = TABLE + diagnostics(known.values())

    def _choose(self, namespace: str) -> None:
        robot = self._robots.known.get(namespace)
        if robot is None or robot is self._robot:
            return
        self._robot, self._version, self._joints = robot, 0, ()
        self._controls = None

    def _follow(self, robot: Robot) -> None:
        """Parameters that have become known, or were changed by anybody."""
        if self._version == robot.version:
            return
        self._version = robot.version
        if self._controls is None or self._controls.live != robot.live:
            self._controls = Controls(robot, self._change)
            self._arm = arm_of(robot.values)
            self._parameters.children = [self._controls.root]
            self._drawing.children = [] if self._arm is None else [self._arm.plot]
        else:
            self._controls.refresh()

    def _show(self, robot: Robot) -> None:
        heard = robot.heard
        joints, controlled = joints_of(heard)
        if joints != self._joints:
            self._joints = joints
            chosen = controlled or joints
            self._shown.labels = list(joints)
            self._shown.active = [joints.index(name) for name in chosen[:SHOWN]]
        seconds = float(self._seconds.value)
        active = [joints[i] for i in self._shown.active if i < len(joints)]
        found = curves(heard, Wanted(active, seconds, robot.gains))
        last = heard.now
        self._plots.show(found, joints, (last - seconds, last))
        self._plots.show_latencies(list(robot.latencies))
        self._state.text = f"<b>{html.escape(robot.state())}</b>"
        if self._arm is not None and heard.last >= 0:
            nominal = {name: _newest(heard.tracks["desired"], "positions", name) for name in joints}
            topic, vector = measured(heard)
            real = {name: _newest(heard.tracks[topic], vector, name) for name in self._arm.names}
            self._arm.show(_known(nominal), _known(real))

    def _change(self, live: Live, value: Value) -> None:
        robot = self._robot
        if robot is not None:
            self._begin(self._set(robot, live, value))

    async def _set(self, robot: Robot, live: Live, value: Value) -> None:
        refused = await self._robots.set(robot, live.node, {live.name: value})
        if refused:
            self._say(f"refused: {refused}", bad=True)
        else:
            self._say(f"{live.node}.{live.name} = {value}")

    def _press(self, service: str) -> None:
        robot = self._robot
        if robot is None:
            return
        if service == f"{PLANT}/step":
            self._begin(self._call(self._robots.step(robot, int(self._cycles.value or 1))))
        else:
            self._begin(self._call(self._robots.trigger(robot, service)))

    async def _call(self, asked: Coroutine[Any, Any, tuple[bool, str]]) -> None:
        done, answer = await asked
        self._say(answer, bad=not done)

    def _begin(self, what: Coroutine[Any, Any, None]) -> None:
        task = asyncio.ensure_future(what)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def _say(self, text: str, bad: bool = False) -> None:
        """Tell it with the next picture: only then may the document be changed."""
        look = "color:#b3401f;font-weight:600" if bad else "color:#374151"
        line = f"<div style='{look}'>{strftime('%H:%M:%S')} {html.escape(text)}</div>"
        self._told.appendleft(line)
        self._has_news = True


def _newest(track: Any, vector: str, name: str) -> float:
    column = track.column(vector, name)
    return float(column[-1]) if len(column) else float("nan")


def _known(numbers: dict[str, float]) -> dict[str, float]:
    return {name: x for name, x in numbers.items() if x == x}
