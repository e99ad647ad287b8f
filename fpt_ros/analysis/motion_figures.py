"""Figures of the motion: trajectories, errors, phase trajectories, and what is not controlled."""

from collections.abc import Sequence

from fpt_ros.analysis import motions, signals, style
from fpt_ros.analysis.labels import all_names
from fpt_ros.analysis.legends import colour_of, followed
from fpt_ros.analysis.outline import POSITION, outline
from fpt_ros.analysis.panels import Panels
from fpt_ros.runs.run import Run


def tracking(runs: Sequence[Run]) -> Panels | None:
    """Nominal and realised positions over time (Fig. 3.21)."""
    rows = all_names(runs, signals.controlled)
    if not rows:
        return None
    panels = Panels.of(runs, rows)
    for name, column, run in panels.cells([*map(outline, runs)]):
        motion = run.motions.get(name, motions.NONE)
        axes = panels.take(name, column, motion.nominal)
        if axes is not None:
            style.draw(axes, motion.time, motion.nominal, style.BAND)
            style.draw(axes, motion.time, motion.position, style.thin(colour_of(run, name)))
            axes.set_ylabel(style.label(style.symbol(name), signals.unit(run, name)))
            panels.scale(name, column, motion.nominal, motion.position)
    return panels.finish(*followed(runs, rows))


def tracking_error(runs: Sequence[Run]) -> Panels | None:
    """Nominal minus realised position over time, one scale for all runs (Fig. 3.22)."""
    rows = all_names(runs, signals.controlled)
    if not rows:
        return None
    panels = Panels.of(runs, rows)
    for name, column, run in panels.cells([*map(outline, runs)]):
        motion = run.motions.get(name, motions.NONE)
        axes = panels.take(name, column, motion.error)
        if axes is None:
            continue
        unit = signals.unit(run, name)
        if signals.settle_time(run) > 0.0:
            end = min(signals.settle_time(run), float(motion.time[-1]))
            axes.axvspan(0.0, end, color="#f3f4f6", zorder=0)
        axes.axhline(0.0, color=style.INK, linewidth=0.7, zorder=1)
        style.draw(axes, motion.time, motion.error, style.thin(colour_of(run, name)))
        rms = run.settled_rms[name]
        if rms is not None:
            panels.note(name, column, f"settled rms {rms:.3g} {unit}".rstrip())
        symbol = style.symbol(name)
        axes.set_ylabel(style.label(f"{symbol}$^{{\\,N}}-\\,${symbol}", unit))
        panels.scale(name, column, motion.error)
    return panels.finish()


def phase_trajectories(runs: Sequence[Run]) -> Panels | None:
    """Velocity over position, nominal and realised (Fig. 3.23)."""
    rows = all_names(runs, signals.controlled)
    if not rows:
        return None
    panels = Panels.of(runs, rows, 3.2, time=False)
    for name, column, run in panels.cells([*map(outline, runs)]):
        motion = run.motions.get(name, motions.NONE)
        axes = panels.take(name, column, motion.nominal)
        if axes is not None:
            nominal, unit = style.BAND, signals.unit(run, name)
            style.draw(axes, motion.nominal, motion.nominal_velocity, nominal, phase=True)
            realised = style.thin(colour_of(run, name))
            style.draw(axes, motion.position, motion.velocity, realised, phase=True)
            axes.set_xlabel(style.label(style.symbol(name), unit))
            axes.set_ylabel(style.label(f"velocity of {style.symbol(name)}", unit, "s"))
            panels.scale(name, column, motion.nominal_velocity, motion.velocity)
            panels.scale_x(name, column, motion.nominal, motion.position)
    return panels.finish(*followed(runs, rows))


def uncontrolled(runs: Sequence[Run]) -> Panels | None:
    """Coordinates that nothing prescribes, over time (Fig. 3.26)."""
    rows = all_names(runs, signals.uncontrolled)
    if not rows:
        return None
    panels = Panels.of(runs, rows)
    for name, column, run in panels.cells([*map(outline, runs)]):
        given = name in signals.uncontrolled(run)
        curve = run.curve(POSITION, name)
        axes = panels.take(name, column, curve.values if given else curve.values[:0])
        if axes is not None:
            style.draw(axes, curve.time, curve.values, style.thin(colour_of(run, name)))
            axes.set_ylabel(style.label(style.symbol(name), signals.unit(run, name)))
            panels.scale(name, column, curve.values)
    return panels.finish()
