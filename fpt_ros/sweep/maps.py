"""The picture of a sweep: curves over one parameter, a map over two, a basin of attraction."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure

from fpt_ros.analysis import style
from fpt_ros.errors import BadInput
from fpt_ros.runs.run import Array
from fpt_ros.sweep.job import COMPLETE
from fpt_ros.sweep.results import Table, onset, read

if TYPE_CHECKING:
    from fpt_ros.sweep.definition import Sweep

MOST = 6
"""Quantities that a map shows."""

LOST = "#c9c9d2"
"""Colour of runs that are not complete."""

MARK: style.Style = {"color": style.DEFORMED, "linewidth": 1.6, "linestyle": (0, (4.0, 1.6))}

STATES = ("plant_simulator.initial_position", "plant_simulator.initial_velocity")


def draw(
    sweep: "Sweep", parquet: Path, directory: Path
) -> tuple[tuple[float, float] | None, tuple[Path, Path]]:
    """Draw ``map.png`` and ``map.svg``.

    Returns:
        The onset of chattering, the last quiet value of the parameter and the first that
        chatters, where one was varied and there is one; the files.

    Raises:
        BadInput: they cannot be written.
    """
    axes = sweep.job.space.axes
    names = [str(axis.target) for axis in axes if axis.numeric]
    shown = _shown(sweep.job.metrics)
    table = read(parquet, [*map(str, (a.target for a in axes)), "outcome", "diverged_at", *shown])
    title = f"{sweep.experiment.about['title']}, {sweep.experiment.variant}"
    found = onset(table, names[0]) if len(axes) == 1 and names else None
    with style.settings():
        if len(axes) == 1 and names:
            picture = _curves(table, names[0], shown, found)
        elif len(axes) == 2 and len(names) == 2:
            basin = all(name.startswith(STATES) for name in names)
            picture = _heat(table, names, shown, basin)
            title += ": basin of attraction" if basin else ""
        else:
            picture = _clouds(table, [str(axis.target) for axis in axes], shown)
        picture.suptitle(style.plain(title), fontsize=11.5, fontweight="bold", x=0.02, ha="left")
        FigureCanvasAgg(picture)
        paths = directory / "map.png", directory / "map.svg"
        try:
            picture.savefig(paths[0])
            picture.savefig(paths[1], metadata={"Date": None})
        except OSError as error:
            raise BadInput(f"{directory} cannot be written: {error.strerror}") from error
    return found, paths


def _shown(metrics: Sequence[str]) -> list[str]:
    """What a map shows: settled errors and chatter first, others where these were not asked for."""
    wanted = [name for name in metrics if name.startswith("rms_settled.") or name == "chatter"]
    return (wanted or list(metrics))[:MOST]


def _good(table: Table, name: str) -> Array:
    """A metric of the complete runs, NaN for the others."""
    found: Array = np.where(table["outcome"] == COMPLETE, table[name], np.nan).astype(np.float64)
    return found


def _grid(count: int, wide: float) -> tuple[Figure, list[Axes]]:
    across = 1 if count == 1 else 2 if count < 5 else 3
    down = math.ceil(count / across)
    picture = Figure(figsize=(wide * across, 3.7 * down + 0.4), layout="constrained")
    panels = picture.subplots(down, across, squeeze=False).ravel().tolist()
    for panel in panels[count:]:
        panel.set_visible(False)
    return picture, panels[:count]


def _curves(
    table: Table, name: str, shown: Sequence[str], found: tuple[float, float] | None
) -> Figure:
    """One panel for all errors, one for the chatter, one for each other quantity."""
    errors = [metric for metric in shown if metric.startswith("rms_settled.")]
    groups = [group for group in (errors, *([m] for m in shown if m not in errors)) if group]
    picture = Figure(figsize=(9.0, 2.6 * len(groups) + 0.9), layout="constrained")
    panels = picture.subplots(len(groups), 1, sharex=True, squeeze=False).ravel().tolist()
    x = np.asarray(table[name], dtype=np.float64)
    order = np.argsort(x, kind="stable")
    lost = x[table["outcome"] != COMPLETE]
    log = x.min() * x.max() > 0.0 and abs(x).max() / abs(x).min() > 30.0 and x.min() > 0.0
    for panel, group in zip(panels, groups, strict=True):
        drawn = [(metric, _good(table, metric)[order]) for metric in group]
        for i, (metric, y) in enumerate(drawn):
            label = style.symbol(metric.partition(".")[2]) if group is errors else metric
            colour = style.COORDINATES[i % len(style.COORDINATES)]
            small = {"marker": "o", "markersize": 2.2} if len(x) <= 200 else {}
            panel.plot(x[order], y, label=label, **style.thin(colour), **small)
        if all(np.nanmin(y, initial=np.inf) > 0.0 for _, y in drawn):
            panel.set_yscale("log")
        panel.set_ylabel("settled rms error" if group is errors else group[0])
        _strip(panel, lost)
        if found is not None:
            panel.axvline(0.5 * (found[0] + found[1]), zorder=2.5, **MARK)
        if group is errors and len(errors) > 1:
            panel.legend(loc="best", ncols=3)
    if found is not None:
        panels[0].set_title(
            f"onset of chattering between {found[0]:.5g} and {found[1]:.5g}",
            loc="right",
            color=style.DEFORMED,
        )
    if len(lost):
        panels[0].set_title(f"grey marks: {len(lost)} runs not complete", loc="left")
    if log:
        panels[-1].set_xscale("log")
    panels[-1].set_xlabel(style.plain(name))
    return picture


def _strip(panel: Axes, lost: Array) -> None:
    """Marks at the foot where runs are not complete."""
    if len(lost):
        panel.plot(
            lost,
            np.full(len(lost), 0.02),
            linestyle="none",
            marker="s",
            markersize=4,
            color="#8a8a95",
            transform=panel.get_xaxis_transform(),
            clip_on=False,
        )


def _heat(table: Table, names: Sequence[str], shown: Sequence[str], basin: bool) -> Figure:
    """A map of each quantity; of initial states also when the runs were lost."""
    when = basin and not np.isnan(table["diverged_at"].astype(np.float64)).all()
    picture, panels = _grid(len(shown) + when, 5.0)
    for panel, metric in zip(panels, shown, strict=False):
        _paint(
            panel,
            table,
            names,
            _good(table, metric),
            metric + _grey(table, _good(table, metric)),
            True,
        )
    if when:
        at = table["diverged_at"].astype(np.float64)
        _paint(panels[-1], table, names, at, "time of divergence [s] (grey: settled)", False)
    return picture


def _grey(table: Table, z: Array) -> str:
    """What the grey of a map stands for."""
    if (table["outcome"] != COMPLETE).any():
        return " (grey: not complete)"
    return " (grey: the run is too short for it)" if np.isnan(z).any() else ""


def _paint(
    panel: Axes, table: Table, names: Sequence[str], z: Array, title: str, log: bool
) -> None:
    x, y = (np.asarray(table[name], dtype=np.float64) for name in names)
    known = z[np.isfinite(z)]
    norm: Normalize = Normalize()
    if log and len(known) and known.min() > 0.0 and known.max() > 3.0 * known.min():
        norm = LogNorm(known.min(), known.max())
    across, i = np.unique(x, return_inverse=True)
    down, j = np.unique(y, return_inverse=True)
    panel.set_facecolor(LOST)
    panel.grid(visible=False)
    if len(across) * len(down) == len(z) and len(across) > 1 and len(down) > 1:
        matrix = np.full((len(down), len(across)), np.nan)
        matrix[j, i] = z
        shading: Any = panel.pcolormesh(
            _edges(across), _edges(down), matrix, norm=norm, cmap="viridis", rasterized=True
        )
        for values, scale in ((across, panel.set_xscale), (down, panel.set_yscale)):
            if _geometric(values):
                scale("log")
    else:
        missing = ~np.isfinite(z)
        panel.plot(x[missing], y[missing], ".", color="#8a8a95", markersize=4, rasterized=True)
        shading = panel.scatter(
            x[~missing],
            y[~missing],
            c=z[~missing],
            norm=norm,
            cmap="viridis",
            s=14,
            rasterized=True,
        )
    picture = panel.get_figure()
    assert picture is not None
    if len(known):
        picture.colorbar(shading, ax=panel)
    panel.set_title(style.plain(title), loc="left")
    panel.set_xlabel(style.plain(names[0]))
    panel.set_ylabel(style.plain(names[1]))


def _geometric(values: Array) -> bool:
    if len(values) < 4 or values[0] <= 0.0:
        return False
    return bool(np.ptp(np.diff(np.log(values))) < 1e-6 * math.log(values[-1] / values[0]))


def _edges(centres: Array) -> Array:
    """Borders of cells around their centres."""
    if _geometric(centres):
        found: Array = np.exp(_edges_of(np.log(centres)))
        return found
    return _edges_of(centres)


def _edges_of(centres: Array) -> Array:
    inner = 0.5 * (centres[:-1] + centres[1:])
    return np.concatenate(([2.0 * centres[0] - inner[0]], inner, [2.0 * centres[-1] - inner[-1]]))


def _clouds(table: Table, names: Sequence[str], shown: Sequence[str]) -> Figure:
    """Each quantity over each parameter: what is left where there are more than two."""
    picture = Figure(figsize=(3.4 * len(names) + 0.6, 2.6 * len(shown) + 0.8), layout="constrained")
    grid = picture.subplots(len(shown), len(names), squeeze=False, sharex="col", sharey="row")
    for row, metric in enumerate(shown):
        y = _good(table, metric)
        for column, name in enumerate(names):
            panel = grid[row, column]
            panel.plot(
                table[name], y, ".", color=style.COORDINATES[0], markersize=3, rasterized=True
            )
            if np.nanmin(y, initial=np.inf) > 0.0 and not np.isnan(y).all():
                panel.set_yscale("log")
            if not column:
                panel.set_ylabel(style.plain(metric))
            if row == len(shown) - 1:
                panel.set_xlabel(style.plain(name))
    return picture
