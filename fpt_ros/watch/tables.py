"""What the nodes say on ``/diagnostics``, as a table of the page."""

import html
from collections.abc import Iterable
from time import monotonic

from fpt_ros.runs.latency import HISTOGRAM
from fpt_ros.watch.robot import Robot

LEVELS = ("ok", "warning", "error", "stale")
COLOURS = ("#047857", "#a15c00", "#b3401f", "#5b6675")

STALE = 3.0
"""Seconds after which a node that said nothing is named so."""


def diagnostics(robots: Iterable[Robot]) -> str:
    """HTML: a row a node, of all robots."""
    now = monotonic()
    rows = []
    for robot in robots:
        for node in sorted(robot.health):
            said, at = robot.health[node]
            level = 3 if now - at > STALE else min(said.level, 3)
            values = ", ".join(
                f"{key} {value}" for key, value in said.values.items() if key != HISTOGRAM
            )
            cells = (f"{robot.namespace.rstrip('/')}/{node}", said.summary, values)
            rows.append(
                f'<tr><td style="color:{COLOURS[level]}"><b>{LEVELS[level]}</b></td>'
                + "".join(f"<td>{html.escape(each)}</td>" for each in cells)
                + "</tr>"
            )
    head = "".join(f"<th>{each}</th>" for each in ("", "node", "says", "values"))
    return f"<table id='diagnostics'><tr>{head}</tr>{''.join(rows)}</table>"
