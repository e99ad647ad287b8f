"""A layout of Foxglove and Lichtblick: a tab a page, the panels of a page below each other."""

import json
from collections.abc import Sequence
from typing import Any

from fpt_ros.viewers.panels import Curve, Page, Panel

COLORS = ("#4e98e2", "#f5774d", "#5cd6a9", "#f7df71", "#a395e2")


def text(pages: Sequence[Page]) -> str:
    """The layout's file."""
    configs: dict[str, Any] = {}
    tabs = []
    for number, page in enumerate(pages):
        names = []
        for row, panel in enumerate(page.panels):
            name = f"Plot!{number}_{row}"
            configs[name] = _plot(panel)
            names.append(name)
        tabs.append({"title": page.title, "layout": _column(names)})
    configs["Tab!pages"] = {"activeTabIdx": 0, "tabs": tabs}
    layout = {
        "configById": configs,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 1},
        "layout": "Tab!pages",
    }
    return json.dumps(layout, indent=1) + "\n"


def path(curve: Curve) -> str:
    """As message paths have it: ``/desired.points[0].positions[2]``."""
    return f"{curve.topic}.{curve.field}[{curve.element}]"


def _plot(panel: Panel) -> dict[str, Any]:
    paths = [
        {
            "value": path(curve),
            "label": curve.label,
            "enabled": True,
            "timestampMethod": "receiveTime",
            "showLine": True,
            "color": color,
        }
        for curve, color in zip(panel.curves, COLORS, strict=False)
    ]
    return {
        "foxglovePanelTitle": panel.title,
        "paths": paths,
        "xAxisVal": "timestamp",
        "isSynced": True,
        "showLegend": True,
        "legendDisplay": "floating",
        "showPlotValuesInLegend": True,
        "showXAxisLabels": True,
        "showYAxisLabels": True,
        "sidebarDimension": 240,
    }


def _column(names: Sequence[str]) -> Any:
    """Nested halves, all of one height."""
    if len(names) == 1:
        return names[0]
    return {
        "direction": "column",
        "first": names[0],
        "second": _column(names[1:]),
        "splitPercentage": 100 / len(names),
    }
