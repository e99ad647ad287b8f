"""A layout of PlotJuggler, of the flat view: ``fpt export BAG --format mcap`` makes its file."""

from collections.abc import Sequence
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from fpt_ros.viewers.panels import Curve, Page, Panel

COLORS = ("#1f77b4", "#d62728", "#2ca02c", "#ff7f0e", "#9467bd")


def text(pages: Sequence[Page]) -> str:
    """The layout's file."""
    root = Element("root")
    about = {"name": "Main Window", "parent": "main_window"}
    window = SubElement(root, "tabbed_widget", about)
    for page in pages:
        tab = SubElement(window, "Tab", tab_name=page.title, containers="1")
        count = len(page.panels)
        column = SubElement(
            SubElement(tab, "Container"),
            "DockSplitter",
            orientation="-",
            count=str(count),
            sizes=";".join([f"{1 / count:.6f}"] * count),
        )
        for panel in page.panels:
            _area(column, panel)
    SubElement(window, "currentTabIndex", index="0")
    SubElement(root, "use_relative_time_offset", enabled="1")
    ElementTree.indent(root, " ")
    return "<?xml version='1.0' encoding='UTF-8'?>\n" + ElementTree.tostring(root, "unicode") + "\n"


def series(curve: Curve) -> str:
    """As PlotJuggler names what it reads of a JointState: ``/desired/flat/q3/position``."""
    topic, field = curve.flat
    return f"{topic}/{curve.name}/{field}"


def _area(column: Element, panel: Panel) -> None:
    area = SubElement(column, "DockArea", name=panel.title)
    plot = SubElement(
        area, "plot", mode="TimeSeries", style="Lines", flip_x="false", flip_y="false",
        line_width="1.0",
    )  # fmt: skip
    SubElement(plot, "limitY")
    for curve, color in zip(panel.curves, COLORS, strict=False):
        SubElement(plot, "curve", name=series(curve), color=color)
