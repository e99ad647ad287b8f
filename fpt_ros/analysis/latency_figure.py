"""The figure of a run in real time: how long commands took, and how many came too late."""

from collections.abc import Sequence

import numpy as np

from fpt_ros.analysis import signals, style
from fpt_ros.analysis.panel import Bars, Mark, Panel
from fpt_ros.analysis.panels import Panels
from fpt_ros.runs.latency import Latencies
from fpt_ros.runs.run import Run

ROW = "latency"

MEDIAN: style.Style = {"color": style.INK, "linewidth": 1.3, "zorder": 3}
P99: style.Style = {**MEDIAN, "linestyle": (0, (1.0, 1.5))}
DEADLINE: style.Style = {**style.DASHED, "linewidth": 1.6}

LEAST = 0.7
"""Foot of the logarithmic scale: a bin with one cycle in it can be seen."""

MARGIN = 1.15
"""Room on both sides of the bins, as a factor."""


def latency(runs: Sequence[Run]) -> Panels | None:
    """Histogram of the latency from sensor to command, of the runs in real time."""
    runs = [run for run in runs if run.latency is not None and run.latency.total]
    if not runs:
        return None
    panels = Panels.of(runs, [ROW], 3.0, time=False, logarithmic=True)
    for name, column, run in panels.cells(runs):
        late = run.latency
        assert late is not None
        panel = panels.take(name, column, np.array(late.counts, dtype=np.float64))
        assert panel is not None
        _draw(panel, late, signals.parameter_number(run, "plant_simulator", "dt"))
        panel.note = f"{late.missed} of {late.cycles} deadlines missed"
    drawn = list(panels.taken.values())
    ends = [end for panel in drawn if panel.bars is not None for end in panel.bars.borders]
    ends += [mark.at for panel in drawn for mark in panel.marks]
    most = max(count for panel in drawn if panel.bars is not None for count in panel.bars.counts)
    for panel in drawn:
        panel.x_span = min(ends) / MARGIN, max(ends) * MARGIN
        panel.y_span = LEAST, 2.0 * most
    return panels.finish("median", "p99", "deadline")


def _draw(panel: Panel, late: Latencies, deadline: float | None) -> None:
    """The bins from the first that is not empty to the last, and what stands at them."""
    used = np.flatnonzero(late.counts)
    first, last = int(used[0]), int(used[-1])
    borders = [1e3 * late.bounds(at)[0] for at in range(first, last + 1)]
    borders.append(1e3 * late.bounds(last)[1])
    panel.bars = Bars(borders, late.counts[first : last + 1])
    panel.marks += [
        Mark(1e3 * late.quantile(0.5), MEDIAN, "median"),
        Mark(1e3 * late.quantile(0.99), P99, "p99"),
    ]
    if deadline is not None:
        panel.marks.append(Mark(1e3 * deadline, DEADLINE, "deadline"))
    panel.x_label, panel.y_label = "latency [ms]", "cycles"
