"""Whole runs for tests: of experiments, cut, and made by hand."""

from collections.abc import Mapping, Sequence
from functools import cache

import numpy as np
from engine_runs import run

from fpt_ros.experiments import experiment
from fpt_ros.messages.topics import BY_NAME
from fpt_ros.runs.run import Run, Series

Rows = Sequence[Sequence[float]]


@cache
def made(name: str, variant: str = "adaptive", duration: float | None = None) -> Run:
    """An experiment, run in process; runs are read only, so tests share them."""
    loaded = experiment.load(name, variant, duration=duration)
    info = {
        "experiment": loaded.name,
        "variant": loaded.variant,
        "engine": "in_process",
        "version": "0.1.0",
        "complete": "true",
        "reason": "",
    }
    return Run(info, loaded.nodes, run(loaded))


def cut(run: Run, cycles: int) -> Run:
    """What a recording killed after some cycles would hold."""
    topics = {
        name: Series(
            series.stamps[:cycles],
            series.names,
            {key: vector[:cycles] for key, vector in series.vectors.items()},
        )
        for name, series in run.topics.items()
    }
    return Run({**run.info, "complete": "false", "reason": "killed"}, run.parameters, topics)


def by_hand(
    topics: Mapping[str, tuple[Sequence[float], Sequence[str], Mapping[str, Rows]]],
    parameters: Mapping[str, Mapping[str, object]] | None = None,
    **info: str,
) -> Run:
    """A run of numbers: topic -> (times [s], names, vector -> rows); other vectors are zero."""
    series = {}
    for name, (times, names, given) in topics.items():
        shape = len(times), len(names)
        vectors = {
            key: np.array(given[key], dtype=float).reshape(shape)
            if key in given
            else np.zeros(shape)
            for key in BY_NAME[name].vectors
        }
        stamps = np.array([round(t * 1e9) for t in times], dtype=np.int64)
        series[name] = Series(stamps, tuple(names), vectors)
    about = {"experiment": "hand", "variant": "made", "complete": "true", **info}
    return Run(about, parameters or {}, series)  # type: ignore[arg-type]
