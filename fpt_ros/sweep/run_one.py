"""One run of a sweep: from its number to its row, in whatever process."""

from collections.abc import Sequence
from time import perf_counter
from typing import cast

from fpt_ros.analysis.metrics import Metrics
from fpt_ros.cycle.stages import Loop
from fpt_ros.engine.engine import Engine
from fpt_ros.errors import BadInput, Diverged, RunFailed
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.runs.run import describe
from fpt_ros.sweep.job import COMPLETE, DIVERGED, FAILED, INVALID, Job, Row
from fpt_ros.sweep.metric import metric
from fpt_ros.sweep.point_experiments import Experiments, experiments_of


def run_chunk(job: Job, numbers: Sequence[int]) -> tuple[float, list[Row]]:
    """Seconds that it took, and the rows of some runs: what is given to a pool."""
    started = perf_counter()
    experiments = experiments_of(job)
    rows = [run_one(experiments, number) for number in numbers]
    return perf_counter() - started, rows


def run_one(experiments: Experiments, number: int) -> Row:
    """The row of one run, whatever becomes of it."""
    job = experiments.job
    point = job.space.point(number)
    outcome, at, result = COMPLETE, None, None
    reason = ""
    try:
        result = simulate(*experiments.at(point), runs=job.space.size)
        reason = str(result["reason"])
        if reason:
            outcome, at = DIVERGED, cast("float | None", result["diverged_at"])
            outcome = FAILED if at is None else DIVERGED
    except BadInput as error:
        outcome, reason = INVALID, str(error)
    except Exception as error:  # one run that fails shall not end a thousand others
        outcome, reason = FAILED, f"{type(error).__name__}: {error}"
    cycles = 0 if result is None else result["cycles"]
    metrics = [None if result is None else metric(result, name) for name in job.metrics]
    shown = [list(value) if isinstance(value, tuple) else value for value in point]
    return [number, *shown, outcome, at, reason, cycles, *metrics]


def simulate(experiment: Experiment, loop: Loop, runs: int = 1) -> dict[str, object]:
    """The summary of a run as ``fpt simulate`` gives it, and ``diverged_at`` [s].

    ``runs``: how many of its kind are made.
    """
    metrics = Metrics(experiment.nodes)
    reason, at = "", None
    try:
        Engine(loop, consumers=[metrics], runs=runs).run()
    except RunFailed as error:
        reason = str(error)
        at = error.time if isinstance(error, Diverged) else None
    info = describe(experiment, "in_process", reason)
    return {**metrics.result(info), "diverged_at": at}
