"""Figures of the adaptation at work: responses, forces and tuned parameters."""

from collections.abc import Sequence

import numpy as np

from fpt_ros.analysis import signals, style
from fpt_ros.analysis.labels import all_names, colour_of
from fpt_ros.analysis.outline import (
    DEFORMED,
    DESIRED,
    EFFORT,
    REALISED,
    TUNED,
    Curve,
    Outline,
    outline,
)
from fpt_ros.analysis.panel import Mark
from fpt_ros.analysis.panels import Panels
from fpt_ros.analysis.thinner import Window
from fpt_ros.cycle.tuned import FACTOR
from fpt_ros.runs.run import Array, Run


def responses(runs: Sequence[Run]) -> Panels | None:
    """Desired, deformed and realised responses over time (Fig. 3.24)."""
    return _responses([outline(run) for run in runs], [None] * len(runs))


def responses_zoom(runs: Sequence[Run]) -> Panels | None:
    """The same for half a period about the settle time (Fig. 3.25)."""
    outlines = [outline(run) for run in runs]
    panels = _responses(outlines, [_excerpt(run) for run in outlines])
    if panels is not None:
        panels.linked = False
    return panels


def _excerpt(run: Outline) -> Window:
    """Half a period of the nominal motion about the settle time, inside the run."""
    end = max((float(m.time[-1]) for m in run.motions.values() if len(m.time)), default=0.0)
    width = min(end, run.period / 2 if run.period is not None else end / 4)
    start = min(max(signals.settle_time(run) - width / 2, 0.0), end - width)
    return Window(start, start + width)


def _responses(runs: Sequence[Outline], windows: Sequence[Window | None]) -> Panels | None:
    rows = all_names(runs, signals.controlled)
    if not rows:
        return None
    panels = Panels.of(runs, rows, 2.7)
    for name, column, run in panels.cells(runs):
        window = windows[column]
        desired, deformed, observed = curves = (
            run.curve(DESIRED, name, window),
            run.curve(DEFORMED, name, window),
            run.curve(REALISED, name, window),
        )
        panel = panels.take(name, column, desired.values)
        if panel is None:
            continue
        realised = style.thin(colour_of(run, name))
        panel.draw(desired.time, desired.values, style.BAND, "desired")
        panel.draw(observed.time, observed.values, realised, "realised")
        panel.draw(deformed.time, deformed.values, style.DASHED, "deformed")
        unit = signals.unit(run, name)
        panel.y_label = style.label(f"response of {style.symbol(name)}", unit, "s²")
        late = [_settled(run, curve) for curve in curves]
        settled = window is None and all(len(y) for y in late)
        bulk = late if settled else [curve.typical[1] for curve in curves]
        panels.scale(name, column, *bulk, robust=True)
        panels.extent(name, column, *[curve.values for curve in curves])
    return panels.finish("desired", "deformed", "realised")


def _settled(run: Outline, curve: Curve) -> Array:
    """Typical numbers of a curve from the settle time on."""
    time, values = curve.typical
    return values[signals.settled(run, time)]


def forces(runs: Sequence[Run]) -> Panels | None:
    """Generalised forces over time, of the coordinates that are driven at all."""
    outlines = [outline(run) for run in runs]
    rows = all_names(outlines, _driven)
    if not rows:
        return None
    panels = Panels.of(outlines, rows)
    for name, column, run in panels.cells(outlines):
        curve = run.curve(EFFORT, name)
        panel = panels.take(name, column, curve.values)
        if panel is not None:
            panel.draw(curve.time, curve.values, style.thin(colour_of(run, name)))
            unit = signals.effort_unit(run, name)
            panel.y_label = style.label(style.symbol(name, force=True), unit)
            late = _settled(run, curve)
            panels.scale(name, column, late if len(late) else curve.typical[1], robust=True)
            panels.extent(name, column, curve.values)
    return panels.finish()


def _driven(run: Outline) -> list[str]:
    names = run.topics["command"].names if "command" in run.topics else ()
    return [name for name in names if np.nan_to_num(run.curve(EFFORT, name).values).any()]


def _tuned(run: Outline) -> list[str]:
    """What the tuner publishes, but a guard's factor only where it has done something."""
    idle = bool((run.curve(TUNED, FACTOR).values == 1.0).all())
    return [name for name in run.topics["tuning"].names if not (idle and name == FACTOR)]


def parameters(runs: Sequence[Run]) -> Panels | None:
    """Tuned parameters over time, with their exact values (Fig. 2.11)."""
    outlines = [outline(run) for run in runs if "tuning" in run.topics]
    rows = all_names(outlines, _tuned)
    if not rows:
        return None
    panels = Panels.of(outlines, rows, 1.7)
    exact_line = {**style.DASHED, "color": style.INK}
    tuned_line = style.thin(style.COORDINATES[0])
    for name, column, run in panels.cells(outlines):
        curve = run.curve(TUNED, name)
        panel = panels.take(name, column, curve.values)
        if panel is not None:
            exact = signals.exact_coefficients(run).get(name)
            shown = [curve.values]
            if exact is not None:
                panel.levels.append(Mark(exact, exact_line, "exact"))
                shown.append(np.array([exact]))
            panel.draw(curve.time, curve.values, tuned_line, "tuned")
            panel.y_label = style.plain(name)
            panels.scale(name, column, *shown)
    return panels.finish("tuned", "exact")
