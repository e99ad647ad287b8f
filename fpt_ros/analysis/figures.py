"""Figures of runs side by side: one column a run, one scale a row, as in the thesis.

The figures of section 3.2.2 (Figs 3.21-3.27) for whatever runs there are: any number of controlled
coordinates, different experiments, and runs that were cut after a few cycles.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from fpt_ros.analysis import latency_figure, motion_figures, response_figures, spectrum_figure
from fpt_ros.analysis.captions import CAPTIONS, thesis_figures
from fpt_ros.analysis.outline import outline
from fpt_ros.analysis.panels import Panels
from fpt_ros.runs.run import Run

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Chart:
    """A figure and what to say about it.

    Attributes:
        name: of its files.
        title, caption: what it shows, what there is to see.
        thesis: figures of the thesis that it corresponds to; empty where there is none.
        panels: what is drawn.
    """

    name: str
    title: str
    caption: str
    thesis: str
    panels: Panels

    @property
    def figure(self) -> "Figure":
        """As the thesis prints it; to be saved within :func:`style.settings`."""
        return self.panels.figure


def charts(runs: Sequence[Run], only: Sequence[str] = ()) -> dict[str, Chart]:
    """All figures that the runs have something for, by name, in the order of the page.

    Args:
        runs: one to about four, side by side in this order.
        only: names of figures; empty: all.

    Returns:
        Of those in :data:`~fpt_ros.analysis.captions.CAPTIONS` all with anything in them.
    """
    found = {}
    runs = [outline(run) for run in runs]
    for name, build in _BUILDERS.items():
        if only and name not in only:
            continue
        panels = build(runs)
        if panels is not None and not panels.empty:
            caption = CAPTIONS[name]
            text = " ".join([caption.text, *panels.remarks])
            found[name] = Chart(name, caption.title, text, thesis_figures(name, runs), panels)
    return found


_BUILDERS: dict[str, Callable[[Sequence[Run]], Panels | None]] = {
    "tracking": motion_figures.tracking,
    "tracking_error": motion_figures.tracking_error,
    "errors_together": motion_figures.errors_together,
    "phase_trajectories": motion_figures.phase_trajectories,
    "responses": response_figures.responses,
    "responses_zoom": response_figures.responses_zoom,
    "forces": response_figures.forces,
    "uncontrolled": motion_figures.uncontrolled,
    "spectra": spectrum_figure.spectra,
    "parameters": response_figures.parameters,
    "latency": latency_figure.latency,
}
