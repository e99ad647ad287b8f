"""Recordings of any length in constant memory: their numbers, and what their figures need."""

from collections.abc import Mapping
from pathlib import Path

from fpt_ros.analysis.metrics import Metrics, Summary
from fpt_ros.analysis.outline import Outline, Outliner, in_full
from fpt_ros.analysis.performance import Performance
from fpt_ros.bags.reader import play
from fpt_ros.parameters import Values
from fpt_ros.runs.chunks import Consumer

FINE = 131_072
"""Points of a curve: of two minutes at 1 kHz every cycle can be looked at."""


def read_summary(path: Path) -> Summary:
    """The numbers of a recorded run.

    Raises:
        BadInput: as :func:`~fpt_ros.bags.reader.read_run`.
    """
    made: list[Metrics] = []

    def make(parameters: Mapping[str, Values]) -> list[Consumer]:
        made.append(Metrics(parameters))
        return [*made]

    run = play(path, make)
    return made[0].result(run.info, run.latency)


def read_outline(path: Path) -> Outline:
    """A recorded run in outline, with its numbers.

    Raises:
        BadInput: as :func:`~fpt_ros.bags.reader.read_run`.
    """
    made: list[tuple[Metrics, Performance, Outliner]] = []

    def make(parameters: Mapping[str, Values]) -> list[Consumer]:
        made.append((Metrics(parameters), Performance(parameters), Outliner(parameters, FINE)))
        return [*made[0]]

    run = play(path, make)
    metrics, performance, outliner = made[0]
    numbers = metrics.result(run.info, run.latency)
    return outliner.result(run, in_full(run, numbers, performance))
