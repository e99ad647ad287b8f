"""Figures of the motion: trajectories, errors, phase trajectories, and what is not controlled."""

from collections.abc import Sequence

import numpy as np

from fpt_ros.analysis import motions, signals, style
from fpt_ros.analysis.labels import all_names, colour_of, run_labels
from fpt_ros.analysis.outline import POSITION, outline
from fpt_ros.analysis.panel import Mark
from fpt_ros.analysis.panels import Panels
from fpt_ros.runs.run import Run


def tracking(runs: Sequence[Run]) -> Panels | None:
    """Nominal and realised positions over time (Fig. 3.21)."""
    outlines = [*map(outline, runs)]
    rows = all_names(outlines, signals.controlled)
    if not rows:
        return None
    panels = Panels.of(outlines, rows)
    for name, column, run in panels.cells(outlines):
        motion = run.motions.get(name, motions.NONE)
        panel = panels.take(name, column, motion.nominal)
        if panel is not None:
            panel.draw(motion.time, motion.nominal, style.BAND, "nominal")
            realised = style.thin(colour_of(run, name))
            panel.draw(motion.time, motion.position, realised, "realised")
            panel.y_label = style.label(style.symbol(name), signals.unit(run, name))
            panels.scale(name, column, motion.nominal, motion.position)
    return panels.finish("nominal", "realised")


def tracking_error(runs: Sequence[Run]) -> Panels | None:
    """Nominal minus realised position over time, one scale for all runs (Fig. 3.22)."""
    outlines = [*map(outline, runs)]
    rows = all_names(outlines, signals.controlled)
    if not rows:
        return None
    panels = Panels.of(outlines, rows)
    for name, column, run in panels.cells(outlines):
        motion = run.motions.get(name, motions.NONE)
        panel = panels.take(name, column, motion.error)
        if panel is None:
            continue
        unit = signals.unit(run, name)
        if signals.settle_time(run) > 0.0:
            panel.shaded = 0.0, min(signals.settle_time(run), float(motion.time[-1]))
        panel.levels.append(Mark(0.0, style.ZERO))
        panel.draw(motion.time, motion.error, style.thin(colour_of(run, name)))
        rms = run.settled_rms[name]
        if rms is not None:
            panel.note = f"settled rms {rms:.3g} {unit}".rstrip()
        symbol = style.symbol(name)
        panel.y_label = style.label(f"{symbol}$^{{\\,N}}-\\,${symbol}", unit)
        panels.scale(name, column, motion.error)
    return panels.finish()


def errors_together(runs: Sequence[Run]) -> Panels | None:
    """Tracking errors of several runs of one plant in the same panels."""
    outlines = [*map(outline, runs)]
    rows = all_names(outlines, signals.controlled)
    plants = {signals.parameter(run, "plant_simulator", "plant") for run in outlines}
    if not rows or len(outlines) < 2 or len(plants) > 1:
        return None
    panels = Panels(rows, ["all runs"], [""], 2.3)
    labels = run_labels(outlines)
    for name in rows:
        errors = [run.motions.get(name, motions.NONE).error for run in outlines]
        panel = panels.take(name, 0, np.concatenate(errors))
        if panel is None:
            continue
        panel.levels.append(Mark(0.0, style.ZERO))
        for at, (run, error) in enumerate(zip(outlines, errors, strict=True)):
            look = style.thin(style.COORDINATES[at % len(style.COORDINATES)])
            panel.draw(run.motions.get(name, motions.NONE).time, error, look, labels[at])
        symbol, unit = style.symbol(name), signals.unit(outlines[0], name)
        panel.y_label = style.label(f"{symbol}$^{{\\,N}}-\\,${symbol}", unit)
        panels.scale(name, 0, *errors)
    return panels.finish(*labels)


def phase_trajectories(runs: Sequence[Run]) -> Panels | None:
    """Velocity over position, nominal and realised (Fig. 3.23)."""
    outlines = [*map(outline, runs)]
    rows = all_names(outlines, signals.controlled)
    if not rows:
        return None
    panels = Panels.of(outlines, rows, 3.2, time=False)
    for name, column, run in panels.cells(outlines):
        motion = run.motions.get(name, motions.NONE)
        panel = panels.take(name, column, motion.nominal)
        if panel is not None:
            time, realised = motion.time, style.thin(colour_of(run, name))
            panel.draw(motion.nominal, motion.nominal_velocity, style.BAND, "nominal", time)
            panel.draw(motion.position, motion.velocity, realised, "realised", time)
            unit = signals.unit(run, name)
            panel.x_label = style.label(style.symbol(name), unit)
            panel.y_label = style.label(f"velocity of {style.symbol(name)}", unit, "s")
            panels.scale(name, column, motion.nominal_velocity, motion.velocity)
            panels.scale_x(name, column, motion.nominal, motion.position)
    return panels.finish("nominal", "realised")


def uncontrolled(runs: Sequence[Run]) -> Panels | None:
    """Coordinates that nothing prescribes, over time (Fig. 3.26)."""
    outlines = [*map(outline, runs)]
    rows = all_names(outlines, signals.uncontrolled)
    if not rows:
        return None
    panels = Panels.of(outlines, rows)
    for name, column, run in panels.cells(outlines):
        given = name in signals.uncontrolled(run)
        curve = run.curve(POSITION, name)
        panel = panels.take(name, column, curve.values if given else curve.values[:0])
        if panel is not None:
            panel.draw(curve.time, curve.values, style.thin(colour_of(run, name)))
            panel.y_label = style.label(style.symbol(name), signals.unit(run, name))
            panels.scale(name, column, curve.values)
    return panels.finish()
