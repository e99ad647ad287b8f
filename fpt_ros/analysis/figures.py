"""Figures of runs side by side: one column a run, one scale a row, as in the thesis.

The figures of section 3.2.2 (Figs 3.21-3.27) for whatever runs there are: any number of controlled
coordinates, different experiments, and runs that were cut after a few cycles.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from fpt_ros.analysis import latency_figure, motion_figures, response_figures, style
from fpt_ros.analysis.captions import CAPTIONS, thesis_figures
from fpt_ros.analysis.outline import outline
from fpt_ros.analysis.panels import Panels
from fpt_ros.runs.run import Run


@dataclass(frozen=True)
class Chart:
    """A figure and what to say about it.

    Attributes:
        name: of its files.
        title, caption: what it shows, what there is to see.
        thesis: figures of the thesis that it corresponds to; empty where there is none.
        figure: with an Agg canvas, to be saved within :func:`style.settings`.
    """

    name: str
    title: str
    caption: str
    thesis: str
    figure: Figure


def charts(runs: Sequence[Run], only: Sequence[str] = ()) -> dict[str, Chart]:
    """All figures that the runs have something for, by name, in the order of the page.

    Args:
        runs: one to about four, side by side in this order.
        only: names of figures; empty: all.

    Returns:
        Of ``tracking``, ``tracking_error``, ``phase_trajectories``, ``responses``,
        ``responses_zoom``, ``forces``, ``uncontrolled``, ``parameters`` and ``latency`` those with
        anything in them.
    """
    found = {}
    runs = [outline(run) for run in runs]
    with style.settings():
        for name, build in _BUILDERS.items():
            if only and name not in only:
                continue
            panels = build(runs)
            if panels is not None and not panels.empty:
                FigureCanvasAgg(panels.figure)
                caption = CAPTIONS[name]
                text = " ".join([caption.text, *panels.remarks])
                thesis = thesis_figures(name, runs)
                found[name] = Chart(name, caption.title, text, thesis, panels.figure)
    return found


_BUILDERS: dict[str, Callable[[Sequence[Run]], Panels | None]] = {
    "tracking": motion_figures.tracking,
    "tracking_error": motion_figures.tracking_error,
    "phase_trajectories": motion_figures.phase_trajectories,
    "responses": response_figures.responses,
    "responses_zoom": response_figures.responses_zoom,
    "forces": response_figures.forces,
    "uncontrolled": motion_figures.uncontrolled,
    "parameters": response_figures.parameters,
    "latency": latency_figure.latency,
}
