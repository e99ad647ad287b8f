"""What share of the cases a loop comes through."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from fpt_ros.analysis import signals
from fpt_ros.analysis.motions import Motions
from fpt_ros.engine.engine import Engine
from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.robustness.protocol import CRITERIA, Case, cases, changed
from fpt_ros.runs.chunks import Chunk
from fpt_ros.runs.run import Run
from fpt_ros.sweep.executor import Pool


@dataclass(frozen=True)
class Result:
    """What became of a case.

    Attributes:
        case: which.
        error: settled rms error of the worst coordinate, as a part of the rms size of its nominal
            motion; infinite where control was lost.
        reason: why it did not come to its end; empty: it did.
    """

    case: Case
    error: float
    reason: str = ""


class Tracking:
    """Takes a run chunk by chunk: the settled error beside the size of the nominal motion."""

    def __init__(self, experiment: Experiment) -> None:
        self._about = Run({}, experiment.nodes, {})
        self._motions = Motions(self._about)
        self._sums: dict[str, list[float]] = {}
        self.largest_effort = 0.0

    def take(self, chunk: Chunk) -> None:
        """Take the next cycles."""
        for name, motion in self._motions.take(chunk).items():
            late = signals.first_settled(self._about, motion.time)
            nominal, error = motion.nominal[late:], motion.error[late:]
            new = [len(nominal), nominal.sum(), np.sum(nominal**2), np.sum(error**2)]
            old = self._sums.setdefault(name, [0.0] * 4)
            self._sums[name] = [a + float(b) for a, b in zip(old, new, strict=True)]
        if "command" in chunk:
            effort = chunk["command"].vectors["effort"]
            self.largest_effort = max(self.largest_effort, float(np.nanmax(np.abs(effort))))

    def error(self) -> float:
        """Of the worst coordinate; infinite where nothing has settled."""
        parts = []
        for count, total, squares, errors in self._sums.values():
            spread = squares - total * total / count if count else 0.0
            size = spread if spread > 1e-12 * squares else squares
            parts.append(math.sqrt(errors / size) if size > 0.0 else math.inf)
        worst = max(parts, default=math.inf)
        return worst if math.isfinite(worst) else math.inf


def perform(experiment: Experiment) -> tuple[float, float, str]:
    """Error, largest effort, and why the run did not come to its end."""
    tracking = Tracking(experiment)
    try:
        Engine(experiment.loop(), consumers=[tracking]).run()
    except (RunFailed, BadInput) as error:
        return math.inf, tracking.largest_effort, str(error)
    return tracking.error(), tracking.largest_effort, ""


def perform_case(experiment: Experiment, case: Case) -> Result:
    """One case, in whatever process."""
    error, _, reason = perform(changed(experiment, case))
    return Result(case, error, reason)


def results_of(
    experiment: Experiment, points: int, pool: Pool, progress: Callable[[int, int], None]
) -> list[Result]:
    """All cases of an experiment, in the order of the protocol.

    Args:
        points: cases a row.
        pool: where they are run.
        progress: is told how many are done, and of how many.

    Raises:
        BadInput: the quiet run itself is lost.
    """
    _, largest, reason = perform(experiment)
    if reason:
        raise BadInput(f"{experiment.name} {experiment.variant} is lost without any: {reason}")
    todo = list(cases(experiment, largest, points))
    calls = [pool.submit(perform_case, experiment, case) for case in todo]
    found: list[Result] = []
    for call in calls:
        progress(len(found), len(todo))
        found.append(call.result())
    progress(len(todo), len(todo))
    return found


def scores(results: Sequence[Result], tolerance: float) -> Mapping[str, float]:
    """Share of the cases of each criterion whose error is at most ``tolerance``, and their mean."""
    shares: dict[str, float] = {}
    for criterion in CRITERIA:
        errors = [each.error for each in results if each.case.criterion == criterion]
        if errors:
            shares[criterion] = sum(error <= tolerance for error in errors) / len(errors)
    return {**shares, "overall": sum(shares.values()) / len(shares)}
