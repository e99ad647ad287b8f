"""Figures of the adaptation at work: responses, forces and tuned parameters."""

from collections.abc import Sequence

import numpy as np

from fpt_ros.analysis import signals, style
from fpt_ros.analysis.labels import all_names
from fpt_ros.analysis.legends import colour_of, realised
from fpt_ros.analysis.panels import Panels
from fpt_ros.cycle.tuned import FACTOR
from fpt_ros.runs.run import Array, Run

_Window = tuple[float, float]
"""Excerpt of a run, first and last time [s]."""


def responses(runs: Sequence[Run]) -> Panels | None:
    """Desired, deformed and realised responses over time (Fig. 3.24)."""
    return _responses(runs, [None] * len(runs))


def responses_zoom(runs: Sequence[Run]) -> Panels | None:
    """The same for half a period about the settle time (Fig. 3.25)."""
    return _responses(runs, [_excerpt(run) for run in runs])


def _excerpt(run: Run) -> _Window:
    """Half a period of the nominal motion about the settle time, inside the run [s]."""
    motions = [signals.motion(run, name) for name in signals.controlled(run)]
    end = max((float(m.time[-1]) for m in motions if len(m.time)), default=0.0)
    period = signals.period(motions)
    width = min(end, period / 2 if period is not None else end / 4)
    start = min(max(signals.settle_time(run) - width / 2, 0.0), end - width)
    return start, start + width


def _responses(runs: Sequence[Run], windows: Sequence[_Window | None]) -> Panels | None:
    rows = all_names(runs, signals.controlled)
    if not rows:
        return None
    panels = Panels.of(runs, rows, 2.7)
    for name, column, run in panels.cells(runs):
        window = windows[column]
        desired = _cut(signals.topic(run, "desired", "accelerations", name), window)
        deformed = _cut(signals.topic(run, "command", "accelerations", name), window)
        observed = _cut(signals.realised_response(run, name), window)
        axes = panels.take(name, column, desired[1])
        if axes is None:
            continue
        style.draw(axes, *desired, style.BAND)
        style.draw(axes, *observed, style.thin(colour_of(run, name)))
        style.draw(axes, *deformed, style.DASHED)
        unit = signals.unit(run, name)
        axes.set_ylabel(style.label(f"response of {style.symbol(name)}", unit, "s²"))
        curves = desired, deformed, observed
        late = [y[signals.settled(run, t)] for t, y in curves]
        settled = window is None and all(len(y) for y in late)
        panels.scale(name, column, *(late if settled else [y for _, y in curves]), robust=True)
        panels.extent(name, column, *[y for _, y in curves])
    legend = (
        style.handle("desired", style.BAND),
        style.handle("deformed", style.DASHED),
        realised(runs, rows),
    )
    return panels.finish(*legend)


def _cut(curve: tuple[Array, Array], window: _Window | None) -> tuple[Array, Array]:
    time, values = curve
    if window is None:
        return curve
    inside = (time >= window[0]) & (time <= window[1])
    return time[inside], values[inside]


def forces(runs: Sequence[Run]) -> Panels | None:
    """Generalised forces over time, of the coordinates that are driven at all."""
    rows = all_names(runs, _driven)
    if not rows:
        return None
    panels = Panels.of(runs, rows)
    for name, column, run in panels.cells(runs):
        time, effort = signals.topic(run, "command", "effort", name)
        axes = panels.take(name, column, effort)
        if axes is not None:
            style.draw(axes, time, effort, style.thin(colour_of(run, name)))
            unit = signals.effort_unit(run, name)
            axes.set_ylabel(style.label(style.symbol(name, force=True), unit))
            late = effort[signals.settled(run, time)]
            panels.scale(name, column, late if len(late) else effort, robust=True)
            panels.extent(name, column, effort)
    return panels.finish()


def _driven(run: Run) -> list[str]:
    command = run.topics.get("command")
    if command is None:
        return []
    return [name for name in command.names if np.nan_to_num(command.column("effort", name)).any()]


def _tuned(run: Run) -> list[str]:
    """What the tuner publishes, but a guard's factor only where it has done something."""
    tuning = run.topics["tuning"]
    factor = tuning.names.index(FACTOR) if FACTOR in tuning.names else None
    idle = factor is not None and bool((tuning.vectors["values"][:, factor] == 1.0).all())
    return [name for name in tuning.names if not (idle and name == FACTOR)]


def parameters(runs: Sequence[Run]) -> Panels | None:
    """Tuned parameters over time, with their exact values (Fig. 2.11)."""
    runs = [run for run in runs if "tuning" in run.topics]
    rows = all_names(runs, _tuned)
    if not rows:
        return None
    panels = Panels.of(runs, rows, 1.7)
    exact_line = {**style.DASHED, "color": style.INK}
    for name, column, run in panels.cells(runs):
        time, value = signals.topic(run, "tuning", "values", name)
        axes = panels.take(name, column, value)
        if axes is not None:
            exact = signals.exact_coefficients(run).get(name)
            shown = [value]
            if exact is not None:
                axes.axhline(exact, **exact_line)
                shown.append(np.array([exact]))
            style.draw(axes, time, value, style.thin(style.COORDINATES[0]))
            axes.set_ylabel(style.plain(name))
            panels.scale(name, column, *shown)
    return panels.finish(
        style.handle("tuned", style.thin(style.COORDINATES[0])),
        style.handle("exact", exact_line),
    )
