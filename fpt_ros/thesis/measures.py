"""What judges measure in a run."""

import math

import numpy as np

from fpt_ros.analysis import motions, signals, sizes
from fpt_ros.runs.run import Array, Run, Series

POINTS = 8000
"""Of a motion, which is smooth from cycle to cycle, as many are enough."""


def thinned(run: Run, points: int = POINTS) -> Run:
    """The run with every k-th message only: for motions, never for responses, which may chatter."""
    topics = {}
    for name, series in run.topics.items():
        step = max(1, len(series.stamps) // points)
        vectors = {key: vector[::step] for key, vector in series.vectors.items()}
        topics[name] = Series(series.stamps[::step], series.names, vectors)
    return Run(run.info, run.parameters, topics)


def complete(run: Run) -> bool:
    """Whether it came to its end."""
    return run.info.get("complete") == "true"


def end(run: Run) -> float:
    """Time of the last message [s]."""
    return max((float(s.time[-1]) for s in run.topics.values() if len(s.stamps)), default=0.0)


def error(run: Run, name: str) -> tuple[Array, Array]:
    """Times [s] and tracking errors of a coordinate; all turns with time sharing."""
    if signals.parameter(run, "trajectory_generator", "time_sharing"):
        run = thinned(run)
    motion = motions.motion(run, name)
    return motion.time, motion.error


def rms(values: Array) -> float:
    """Root mean square; infinite where no number is left, as after a run that was lost at once."""
    found = sizes.rms(values)
    return math.inf if found is None else found


def settled_rms(run: Run, name: str) -> float:
    """Settled rms tracking error; infinite for a run that was lost."""
    if not complete(run):
        return math.inf
    time, values = error(run, name)
    return rms(values[signals.settled(run, time)])


def responses(run: Run) -> tuple[Array, Array, Array, Array]:
    """Times [s] (N-1,), and desired, deformed and realised responses (N-1, c)."""
    time = signals.seconds(run, run.topics["desired"].stamps)[:-1]
    columns: tuple[list[Array], ...] = [], [], []
    for name in signals.controlled(run):
        columns[0].append(signals.topic(run, "desired", "accelerations", name)[1][:-1])
        columns[1].append(signals.topic(run, "command", "accelerations", name)[1][:-1])
        columns[2].append(signals.realised_response(run, name)[1])
    desired, deformed, realised = (np.column_stack(each) for each in columns)
    return time, desired, deformed, realised


def response_errors(run: Run, start: float | None = None, end: float = math.inf) -> Array:
    """Norm of realised minus desired response, from ``start`` (the settle time) to ``end`` [s]."""
    time, desired, _, realised = responses(run)
    first = signals.settle_time(run) if start is None else start
    used = (time >= first - 1e-9) & (time < end - 1e-9)
    return norms(realised[used] - desired[used])


def norms(rows: Array) -> Array:
    """Norm of each row; what is NaN, not controlled, does not count."""
    with np.errstate(over="ignore", invalid="ignore"):
        return np.asarray(np.sqrt(np.nansum(rows * rows, axis=1)), dtype=np.float64)


def chatter(run: Run) -> float:
    """Mean settled step of the deformed response; infinite for a run that was lost."""
    if not complete(run):
        return math.inf
    command = run.topics["command"]
    late = signals.settled(run, signals.seconds(run, command.stamps))
    return float(np.mean(norms(np.diff(command.vectors["accelerations"][late], axis=0))))
