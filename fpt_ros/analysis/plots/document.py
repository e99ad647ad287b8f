"""All plots of a page, and what it has to hold for them."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from importlib.resources import files

from bokeh.document import Document
from bokeh.embed import components
from bokeh.events import DocumentReady
from bokeh.layouts import gridplot
from bokeh.model import Model
from bokeh.models import CustomJS, Range1d
from bokeh.resources import Resources

from fpt_ros.analysis.panels import Curve, Panels
from fpt_ros.analysis.plots.drawing import Drawing
from fpt_ros.analysis.plots.parts import home_range
from fpt_ros.analysis.plots.pool import Pool

WINDOW = "window"
"""Name of the range of time that the figures have in common."""

_SCRIPT = files("fpt_ros.analysis.plots").joinpath("window.js").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Plots:
    """Scripts for the end of the page, the library first, and a place for each figure."""

    library: str
    script: str
    places: Mapping[str, str]


def plots(figures: Mapping[str, Panels]) -> Plots:
    """Plots of figures, at least one, by name; those over time show one window of it."""
    document, pool = Document(), Pool()
    for panels in figures.values():
        for curve in _timed(panels):
            pool.add(curve)
    pool.finish()
    common = _window([panels for panels in figures.values() if panels.time and panels.linked])
    common.name = WINDOW
    roots: dict[str, Model] = {}
    for name, panels in figures.items():
        own = panels.time and not panels.linked
        drawing = Drawing(panels, pool, _window([panels]) if own else common)
        root = roots[name] = gridplot(
            drawing.grid(),
            sizing_mode="stretch_width",
            toolbar_location="right",
            toolbar_options={"logo": None},
        )
        update = CustomJS(
            args={"range": drawing.window, "rows": drawing.rows, "root": root}, code=_SCRIPT
        )
        for end in ("start", "end"):
            drawing.window.js_on_change(end, update)
        document.js_on_event(DocumentReady, update)
        document.add_root(root)
    script, places = components(roots)
    return Plots(Resources(mode="inline", components=["bokeh"]).render_js(), script, places)


def _timed(panels: Panels) -> Iterator[Curve]:
    """Curves of which a window of time is shown: over time, and paths."""
    for panel in panels.taken.values():
        yield from (c for c in panel.curves if panels.time or c.time is not None)


def _window(figures: Iterable[Panels]) -> Range1d:
    """All of the time that there is."""
    times = [curve.x for panels in figures for curve in _timed(panels)]
    first = min((float(time[0]) for time in times), default=0.0)
    last = max((float(time[-1]) for time in times), default=1.0)
    return home_range((first, last if last > first else first + 1.0), bounds="auto")
