"""Pictures of claims: the figures of reports with chosen runs, and the thesis's other ones."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fpt_ros.analysis import motion_figures, response_figures, signals, style
from fpt_ros.analysis.labels import all_names, colour_of
from fpt_ros.analysis.panels import Panels
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.runs.run import Array, Run, Series
from fpt_ros.thesis.claim import Drawn
from fpt_ros.thesis.measures import responses as response_rows
from fpt_ros.thesis.measures import thinned
from fpt_ros.thesis.setup import Runs

Draw = Callable[[Runs], Drawn | None]
Build = Callable[[Sequence[Run]], Panels | None]
Curve = tuple[Array, Array, str, style.Style]
"""x, y, legend (empty: none), and how it is drawn."""


def panels(build: Build, *keys: str, prepare: Callable[[Run], Run] = lambda run: run) -> Draw:
    """A figure of reports with these runs beside each other."""

    def draw(runs: Runs) -> Drawn | None:
        made = build([prepare(runs[key]) for key in keys])
        return None if made is None or made.empty else (made.figure, made.remarks)

    return draw


def tracking(*keys: str) -> Draw:
    """Nominal and realised motion."""
    return panels(motion_figures.tracking, *keys, prepare=thinned)


def errors(*keys: str) -> Draw:
    """Tracking errors."""
    return panels(motion_figures.tracking_error, *keys, prepare=thinned)


def phases(*keys: str) -> Draw:
    """Phase trajectories."""
    return panels(motion_figures.phase_trajectories, *keys, prepare=thinned)


def uncontrolled(*keys: str) -> Draw:
    """Coordinates that nothing prescribes."""
    return panels(motion_figures.uncontrolled, *keys, prepare=thinned)


def responses(*keys: str, first: float | None = None) -> Draw:
    """Desired, deformed and realised responses, or their beginning up to a time [s]."""
    return panels(
        response_figures.responses,
        *keys,
        prepare=lambda run: run if first is None else until(run, first),
    )


def zoomed(*keys: str, first: float | None = None) -> Draw:
    """The same about the settle time; ``first`` [s]: of the beginning of the run only."""
    return panels(
        response_figures.responses_zoom,
        *keys,
        prepare=lambda run: run if first is None else until(run, first),
    )


def forces(*keys: str) -> Draw:
    """Generalised forces."""
    return panels(response_figures.forces, *keys)


def parameters(*keys: str, names: Sequence[str] = ()) -> Draw:
    """Tuned coefficients of the model, or what else of the tuning has these names."""

    def only(run: Run) -> Run:
        wanted = names or [n for n in run.topics["tuning"].names if n in coefficients(run)]
        return with_tuning(run, wanted, {})

    return panels(response_figures.parameters, *keys, prepare=only)


def coefficients(run: Run) -> set[str]:
    """Names of the coefficients of the run's model."""
    return signals.coefficient_names(run)


def with_tuning(run: Run, names: Sequence[str], more: Mapping[str, Array]) -> Run:
    """The run with these columns of the tuning only, and some that are calculated."""
    series = run.topics["tuning"]
    columns = {name: series.column("values", name) for name in names} | dict(more)
    tuning = Series(series.stamps, tuple(columns), {"values": np.column_stack([*columns.values()])})
    return Run(run.info, run.parameters, {**run.topics, "tuning": tuning})


def until(run: Run, seconds: float) -> Run:
    """The beginning of a run."""
    topics = {}
    for name, series in run.topics.items():
        count = int(np.searchsorted(signals.seconds(run, series.stamps), seconds))
        vectors = {key: vector[:count] for key, vector in series.vectors.items()}
        topics[name] = Series(series.stamps[:count], series.names, vectors)
    return Run(run.info, run.parameters, topics)


def disturbance(*keys: str) -> Draw:
    """The force that nobody in the loop knows, over time."""

    def build(runs: Sequence[Run]) -> Panels:
        made = Panels.of(runs, ["d"])
        for name, column, run in made.cells(runs):
            time, force = disturbance_of(run)
            panel = made.take(name, column, force)
            if panel is not None:
                panel.draw(time, force, style.thin(style.COORDINATES[4]))
                panel.y_label = "disturbance force"
                made.scale(name, column, force)
        return made.finish()

    return panels(build, *keys, prepare=thinned)


def disturbance_of(run: Run) -> tuple[Array, Array]:
    """Times [s] and the disturbance, of a kind that is a function of time alone."""
    plant = PlantSimulator(run.parameters[PlantSimulator.name])
    law = plant.disturbance
    time = signals.seconds(run, run.topics["joint_states"].stamps)
    constants = plant.constants.disturbance
    return time, np.array([law.force(constants, [], t, 0.0, 0.0, 0.0) for t in time.tolist()])


def iterations(*keys: str, first: int) -> Draw:
    """Bare iterations: the first steps of r, and the size of the response error in all of them."""

    def build(runs: Sequence[Run]) -> Panels:
        names = all_names(runs, signals.controlled)
        made = Panels.of(runs, [*names, "size"], time=False)
        for name, column, run in made.cells(runs):
            _, desired, deformed, realised = response_rows(run)
            count = np.arange(len(deformed), dtype=np.float64)
            if name == "size":
                size = np.sqrt(np.sum((realised - desired) ** 2, axis=1))
                y = np.log10(np.where(size > 1e-16, size, np.nan))
                colour = style.INK
            else:
                at = signals.controlled(run).index(name)
                count, y = count[:first], deformed[:first, at]
                colour = colour_of(run, name)
            panel = made.take(name, column, y)
            if panel is None:
                continue
            if name == "size":
                panel.draw(count, y, style.thin(colour))
                panel.y_label = "response error, $\\log_{10}||h||$"
            else:
                dots: style.Style = {"linewidth": 1.0, "marker": "o", "markersize": 3}
                panel.draw(count, y, {"color": colour, **dots})
                panel.y_label = f"r of {style.symbol(name)}"
            panel.x_label = "iteration"
            made.scale(name, column, y)
            made.scale_x(name, column, count)
        return made.finish()

    return panels(build, *keys)


ASIDE = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5)}


def charts(
    *cells: tuple[str, str, str, Sequence[Curve]],
    height: float = 3.4,
    log: str = "",
    rows: int = 1,
    aside: bool = False,
) -> Drawn:
    """Plain charts beside each other: title, x label, y label and curves of each.

    ``aside``: legends stand on the right of the chart, where curves leave no room.
    """
    figure = Figure(figsize=(10.5, height), layout="constrained")
    grid = figure.subplots(rows, -(-len(cells) // rows), squeeze=False)
    for axes, (title, x_label, y_label, curves) in zip(grid.flat, cells, strict=True):
        assert isinstance(axes, Axes)
        for x, y, label, how in curves:
            axes.plot(x, y, label=label or None, **how)
        axes.set_title(title, loc="left")
        axes.set_xlabel(x_label)
        axes.set_ylabel(y_label)
        if "x" in log:
            axes.set_xscale("log")
        if "y" in log:
            axes.set_yscale("log")
        if any(label for _, _, label, _ in curves):
            axes.legend(**(ASIDE if aside else {"loc": "best"}))
    return figure, ()
