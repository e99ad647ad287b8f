"""All plots of a page, and what it has to hold for them."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from importlib.resources import files

from bokeh.document import Document
from bokeh.embed import components
from bokeh.events import DocumentReady
from bokeh.layouts import gridplot
from bokeh.model import Model
from bokeh.models import BoxZoomTool, CustomJS, Range1d
from bokeh.models.tools import ToolProxy
from bokeh.resources import Resources
from bokeh.settings import settings

from fpt_ros.analysis.panel import Curve, Span
from fpt_ros.analysis.panels import Panels
from fpt_ros.analysis.plots.drawing import Drawing
from fpt_ros.analysis.plots.parts import home_range
from fpt_ros.analysis.plots.pool import Pool

WINDOW = "window"
"""Name of the range of time that the figures have in common."""

settings.perform_document_validation = False  # the tests look at the page itself

_SCRIPT = files("fpt_ros.analysis.plots").joinpath("window.js").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Plots:
    """Scripts for the end of the page, the library first, and a place for each figure."""

    library: str
    script: str
    places: Mapping[str, str]


def plots(figures: Mapping[str, Panels]) -> Plots:
    """Plots of figures by name; those over time show one window of it."""
    if not figures:
        return Plots("", "", {})
    document, pool = Document(), Pool()
    for panels in figures.values():
        for curve in _timed(panels):
            pool.add(curve)
    pool.finish()
    whole = _span([panels for panels in figures.values() if panels.time and panels.linked])
    common = home_range(whole, name=WINDOW)
    roots: dict[str, Model] = {}
    for name, panels in figures.items():
        alone = panels.time and not panels.linked
        span = _span([panels]) if alone else whole
        drawing = Drawing(panels, pool, home_range(span, bounds="auto"))
        root = gridplot(
            drawing.grid(),
            sizing_mode="stretch_width",
            toolbar_location="right",
            toolbar_options={"logo": None},
        )
        zooms = [tool for tool in root.toolbar.tools if isinstance(tool, ToolProxy)]
        root.toolbar.active_drag = next(t for t in zooms if isinstance(t.tools[0], BoxZoomTool))
        _link(document, root, drawing, home_range(span) if alone else common)
        roots[name] = root
    with document.models.freeze():  # it looks for all references after each change otherwise
        for each in roots.values():
            document.add_root(each)
    script, places = components(roots)
    names = _Names()
    return Plots(
        Resources(mode="inline", components=["bokeh"]).render_js(),
        names.stable(script),
        {name: names.stable(place) for name, place in places.items()},
    )


class _Names:
    """Numbers in the place of Bokeh's random names, so that the same runs give the same file."""

    _random = re.compile(r"[0-9a-f]{8}(?:-[0-9a-f]{4}){3}-[0-9a-f]{12}")

    def __init__(self) -> None:
        self._known: dict[str, str] = {}

    def stable(self, text: str) -> str:
        """The text with every random name replaced, the same by the same."""
        return self._random.sub(
            lambda found: self._known.setdefault(found[0], f"plots-{len(self._known)}"), text
        )


def _timed(panels: Panels) -> Iterator[Curve]:
    """Curves of which a window of time is shown: over time, and paths."""
    for panel in panels.taken.values():
        yield from (c for c in panel.curves if panels.time or c.time is not None)


def _span(figures: Iterable[Panels]) -> Span:
    """All of the time that there is."""
    times = [curve.x for panels in figures for curve in _timed(panels)]
    first = min((float(time[0]) for time in times), default=0.0)
    last = max((float(time[-1]) for time in times), default=1.0)
    return first, last if last > first else first + 1.0


def _link(document: Document, root: Model, drawing: Drawing, common: Range1d) -> None:
    """A figure follows the common window, and moves it."""
    own = drawing.window
    given = {"common": common, "own": own, "root": root, "rows": drawing.rows}
    follow = CustomJS(args=given, code=_SCRIPT)
    move = CustomJS(
        args={"common": common, "own": own},
        code="common.setv({ start: own.start, end: own.end })",
    )
    document.js_on_event(DocumentReady, follow)
    for end in ("start", "end"):
        common.js_on_change(end, follow)
        own.js_on_change(end, move)
