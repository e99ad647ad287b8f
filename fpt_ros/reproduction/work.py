"""The work of one group: its runs and its pictures, in a process of its own."""

import base64
import io
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from fpt_ros.analysis import style
from fpt_ros.analysis.figures import charts
from fpt_ros.analysis.metrics import summary
from fpt_ros.errors import Diverged
from fpt_ros.loop.engine import Engine
from fpt_ros.loop.experiment import load
from fpt_ros.loop.run import Run, describe
from fpt_ros.reproduction import Case, Group, Outcome

DPI = 100


@dataclass(frozen=True)
class Picture:
    """A figure as PNG in base 64, and what to say about it."""

    title: str
    caption: str
    thesis: str
    data: str


@dataclass(frozen=True)
class Done:
    """Outcomes and pictures of a group."""

    outcomes: Mapping[str, Outcome]
    pictures: tuple[Picture, ...]


def work(group: Group, tell: Callable[[], None] = lambda: None) -> Done:
    """Make all runs of a group, and draw its pictures; ``tell`` is called after each run."""
    outcomes, kept = {}, {}
    drawn = {key for pictures in group.pictures for key in pictures.cases}
    for key, case in group.cases.items():
        run, lost = simulate(case)
        outcomes[key] = _outcome(run, lost, group)
        if key in drawn:
            kept[key] = run
        tell()
    found = []
    for pictures in group.pictures:
        runs = [kept[key] for key in pictures.cases]
        for chart in charts(runs, pictures.charts).values():
            buffer = io.BytesIO()
            with style.settings():
                chart.figure.savefig(buffer, format="png", dpi=DPI)
            data = base64.b64encode(buffer.getvalue()).decode()
            found.append(Picture(chart.title, chart.caption, chart.thesis, data))
    return Done(outcomes, tuple(found))


def simulate(case: Case) -> tuple[Run, float | None]:
    """A run, and when it was lost [s]; ``None``: it was not."""
    experiment = load(case.name, case.variant, case.settings, case.duration)
    engine, lost = Engine(experiment.loop()), None
    try:
        engine.run()
    except Diverged as error:
        lost = error.time
    reason = "" if lost is None else f"lost at {lost:g} s"
    return Run(describe(experiment, "in_process", reason), experiment.nodes, engine.topics()), lost


def _outcome(run: Run, lost: float | None, group: Group) -> Outcome:
    numbers = summary(run)
    tracking, chatter = numbers["tracking"], numbers["chatter"]
    assert isinstance(tracking, Mapping)
    tuning = {}
    topic = run.topics.get("tuning")
    if topic is not None and len(topic.stamps):
        values = topic.vectors["values"]
        for i, name in enumerate(topic.names):
            column = values[:, i]
            span = float(np.nanmin(column)), float(np.nanmax(column))
            tuning[name] = float(column[0]), float(column[-1]), *span
    probes = dict(group.probe(run)) if group.probe is not None else {}
    return Outcome(
        rms={name: each["rms_settled"] for name, each in tracking.items()},
        chatter=chatter if isinstance(chatter, float) and math.isfinite(chatter) else None,
        tuning=tuning,
        lost=lost,
        probes=probes,
    )
