"""Figures of a comparison: errors over time, error against chatter, error over noise and delay."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from fpt_ros.analysis import style
from fpt_ros.compare.field import DELAY, NOISE, Circumstance
from fpt_ros.compare.results import Cell, Results
from fpt_ros.compare.verdicts import front

OURS = ("#d55e00", "#e69f00", "#b3401f", "#f0a36b")
THEIRS = ("#0072b2", "#009e73", "#a6558a", "#56b4e9", "#374151", "#8a9a5b", "#7b68c8", "#b4b8bf")
"""Colours of controllers with a transformation, and of the others."""

FARTHEST = 1e3
"""Times the limit of the tuning, beyond which chatter is not drawn."""

SHOWN = 8
"""Controllers that have a colour, the best ones."""


@dataclass(frozen=True)
class Chart:
    """A figure and what to say about it."""

    name: str
    title: str
    caption: str
    figure: Figure


def charts(results: Results) -> list[Chart]:
    """Those that there is something for."""
    with style.settings():
        found = [_curves(results), _fronts(results)]
        found += [_graded(results, grade) for grade in (NOISE, DELAY)]
        for chart in found:
            if chart is not None:
                FigureCanvasAgg(chart.figure)
    return [chart for chart in found if chart is not None]


def _styles(results: Results) -> dict[str, dict[str, Any]]:
    """A line of its own for each of the best controllers."""
    found: dict[str, dict[str, Any]] = {}
    taken = {True: 0, False: 0}
    for one in results.ranked:
        colours = OURS if one.family else THEIRS
        if len(found) >= SHOWN and not one.family:
            continue
        at = taken[one.family]
        if at < len(colours):
            width = 1.9 if one.family else 1.2
            found[one.name] = {"color": colours[at], "linewidth": width, "zorder": 4 + one.family}
            taken[one.family] += 1
    return found


def _curves(results: Results) -> Chart | None:
    usual = results.asked.plan.field.groups[0]
    styles = _styles(results)
    panels = [one for one in usual if any(cell.time for cell in results.of(one))]
    if not panels:
        return None
    rows = -(-len(panels) // 2)
    figure = Figure(figsize=(10.5, 1.1 + 3.0 * rows), layout="constrained")
    grid = figure.subplots(rows, min(2, len(panels)), squeeze=False)
    for axes in grid.flat[len(panels) :]:
        axes.set_axis_off()
    for axes, one in zip(grid.flat, panels, strict=False):
        for cell in results.of(one):
            errors = np.array([np.nan if x is None else x for x in cell.errors], dtype=float)
            if not np.isfinite(errors).any():
                continue
            errors[errors <= 0.0] = np.nan
            how = styles.get(cell.controller.name)
            axes.plot(
                cell.time[: len(errors)],
                errors,
                label=cell.controller.name if how else None,
                **(how or {"color": "#d5d8dd", "linewidth": 0.9, "zorder": 2}),
            )
        axes.set_yscale("log")
        axes.set_title(one.name, loc="left")
        axes.set_xlabel("time [s]")
        axes.set_ylabel(f"error, rms of all{_unit(results)}")
    _legend(figure, grid.flat[0])
    caption = (
        "Root mean square of the tracking errors of all joints, in windows. The controllers with "
        "the least errors have colours, those with a transformation warm ones; the others are grey."
    )
    return Chart("errors", "Errors over time", caption, figure)


def _fronts(results: Results) -> Chart | None:
    groups = [group[0] for group in results.asked.plan.field.groups]
    shown = [one for one in groups if one.grade != DELAY]
    styles = _styles(results)
    rows = -(-len(shown) // 2)
    figure = Figure(figsize=(10.5, 1.1 + 3.6 * rows), layout="constrained")
    grid = figure.subplots(rows, min(2, len(shown)), squeeze=False)
    for axes in grid.flat[len(shown) :]:
        axes.set_axis_off()
    for axes, one in zip(grid.flat, shown, strict=False):
        _front(axes, results, one, styles)
    _legend(figure, grid.flat[0])
    tuned = " Small dots: trials of the tuning; lines: the best of them." if results.tunings else ""
    limit = results.asked.plan.limit
    caption = (
        "Each controller's error against the mean step of its efforts from cycle to cycle: to the "
        f"lower left is better.{tuned} Dashed: {limit:.2g}, the limit of the tuning."
    )
    return Chart("pareto", "Error against chatter", caption, figure)


def _front(
    axes: Axes, results: Results, one: Circumstance, styles: dict[str, dict[str, Any]]
) -> None:
    for family, colour in ((False, THEIRS[0]), (True, OURS[0])):
        trials = [
            point
            for (name, where), tuning in results.tunings.items()
            if where == one.name and tuning.controller.family is family
            for point in tuning.trials
            if point[0] > 0.0 and point[1] > 0.0
        ]
        if trials:
            errors, steps = zip(*trials, strict=True)
            axes.plot(steps, errors, ".", color=colour, markersize=2.5, alpha=0.35, zorder=2)
            best = front(trials)
            e, s = zip(*best, strict=True)
            label = "best with a transformation" if family else "best of the others"
            axes.step(s, e, where="post", color=colour, linewidth=1.2, label=label, zorder=3)
    for cell in results.of(one):
        if not (cell.error and cell.step):
            continue
        how = styles.get(cell.controller.name, {"color": "#9aa1ab"})
        axes.plot(
            [cell.step],
            [cell.error],
            "D" if cell.controller.family else "o",
            color=how["color"],
            markersize=6,
            zorder=6,
            label=cell.controller.name if cell.controller.name in styles else None,
        )
    axes.axvline(results.asked.plan.limit, color=style.INK, linestyle=(0, (3, 3)), linewidth=0.8)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(right=min(axes.get_xlim()[1], FARTHEST * results.asked.plan.limit))
    axes.set_title(one.name, loc="left")
    axes.set_xlabel(f"mean step of an effort{_effort_unit(results)}")
    axes.set_ylabel(f"settled error, rms{_unit(results)}")


def _graded(results: Results, grade: str) -> Chart | None:
    found = [one for one in results.asked.plan.field.circumstances if one.grade == grade]
    if not found:
        return None
    styles = _styles(results)
    figure = Figure(figsize=(10.5, 4.2), layout="constrained")
    axes = figure.subplots()
    panels: Sequence[tuple[Axes, Callable[[Cell], float | None]]] = ((axes, lambda c: c.error),)
    for axes, number in panels:
        for one in results.ranked:
            cells = [results.cells[one.name, each.name] for each in found]
            points = [(c.circumstance.value, number(c)) for c in cells if number(c)]
            if one.name not in styles or not points:
                continue
            x, y = zip(*points, strict=True)
            axes.plot(x, y, marker="o", markersize=4, label=one.name, **styles[one.name])
        axes.set_yscale("log")
        axes.set_ylabel(f"settled error, rms{_unit(results)}")
    if grade == NOISE:
        axes.set_xscale("log")
        axes.set_xlabel(f"noise of the positions, standard deviation{_unit(results)}")
        title, what = "Error over noise", "noise"
    else:
        axes.set_xlabel("delay of the sensors [cycles]")
        axes.set_xticks([one.value for one in found])
        title, what = "Error over delay", "delay"
    _legend(figure, axes)
    return Chart(grade, title, f"What {what} of the sensors costs each controller.", figure)


def _legend(figure: Figure, axes: Axes) -> None:
    handles, labels = axes.get_legend_handles_labels()
    if handles:
        figure.legend(handles, labels, loc="outside lower center", ncols=5, fontsize=8.5)


def units(results: Results) -> tuple[str, str]:
    """Units of coordinates and efforts, where all have the same; empty."""
    plant = results.asked.plan.field.experiment.loop().plant.plant
    own, force = set(plant.units), set(plant.effort_units)
    return own.pop() if len(own) == 1 else "", force.pop() if len(force) == 1 else ""


def _unit(results: Results) -> str:
    unit = units(results)[0]
    return f" [{unit}]" if unit else ""


def _effort_unit(results: Results) -> str:
    unit = units(results)[1]
    return f" [{unit}]" if unit else ""
