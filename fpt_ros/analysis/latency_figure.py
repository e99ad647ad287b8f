"""The figure of a run in real time: how long commands took, and how many came too late."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

from fpt_ros.analysis import signals, style
from fpt_ros.analysis.panels import Panels
from fpt_ros.runs.latency import Latencies
from fpt_ros.runs.run import Run

ROW = "latency"

MEDIAN: style.Style = {"color": style.INK, "linewidth": 1.3, "zorder": 3}
P99: style.Style = {**MEDIAN, "linestyle": (0, (1.0, 1.5))}
DEADLINE: style.Style = {**style.DASHED, "linewidth": 1.6}

LEAST = 0.7
"""Foot of the logarithmic scale: a bin with one cycle in it can be seen."""


def latency(runs: Sequence[Run]) -> Panels | None:
    """Histogram of the latency from sensor to command, of the runs in real time."""
    runs = [run for run in runs if run.latency is not None and run.latency.total]
    if not runs:
        return None
    panels = Panels.of(runs, [ROW], 3.0, time=False)
    drawn = []
    for name, column, run in panels.cells(runs):
        late = run.latency
        assert late is not None
        axes = panels.take(name, column, np.array(late.counts, dtype=np.float64))
        assert axes is not None
        _draw(axes, late, signals.parameter_number(run, "plant_simulator", "dt"))
        panels.note(name, column, f"{late.missed} of {late.cycles} deadlines missed")
        drawn.append(axes)
    panels.finish(
        style.handle("median", MEDIAN),
        style.handle("p99", P99),
        style.handle("deadline", DEADLINE),
    )
    left, right = zip(*(axes.get_xlim() for axes in drawn), strict=True)
    top = max(axes.get_ylim()[1] for axes in drawn)
    for axes in drawn:
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlim(min(left), max(right))
        axes.set_ylim(LEAST, top)
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.xaxis.set_major_formatter(FormatStrFormatter("%g"))
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.set_xlabel("latency [ms]")
    drawn[0].set_ylabel("cycles")
    return panels


def _draw(axes: Axes, late: Latencies, deadline: float | None) -> None:
    """The bins from the first that is not empty to the last, and what stands at them."""
    used = np.flatnonzero(late.counts)
    first, last = int(used[0]), int(used[-1])
    borders = [1e3 * late.bounds(at)[0] for at in range(first, last + 1)]
    borders.append(1e3 * late.bounds(last)[1])
    counts = late.counts[first : last + 1]
    axes.stairs(counts, borders, fill=True, color=style.COORDINATES[0], alpha=0.75, baseline=LEAST)
    marks = [(1e3 * late.quantile(0.5), MEDIAN), (1e3 * late.quantile(0.99), P99)]
    if deadline is not None:
        marks.append((1e3 * deadline, DEADLINE))
    for at, line in marks:
        axes.axvline(at, **line)
    ends = [*borders, *(at for at, _ in marks)]
    axes.set_xlim(min(ends) / 1.15, max(ends) * 1.15)
    axes.set_ylim(LEAST, 2.0 * max(counts))
