"""All runs of a comparison: on all cores, into a journal from which it goes on."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from fpt_ros import __version__
from fpt_ros.compare.field import field
from fpt_ros.compare.measures import simulate, whole_of
from fpt_ros.compare.task import Plan, run_tasks
from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.sweep.definition import parameter_of
from fpt_ros.sweep.directory import open_directory
from fpt_ros.sweep.executor import Pool
from fpt_ros.sweep.journal import Journal
from fpt_ros.sweep.sweep import rows_of

DEFINITION, JOURNAL = "compare.yaml", "journal.jsonl"

TRIALS = 32
"""Runs in which a controller is tuned for a group of circumstances."""

ROOM = 10.0
"""Efforts of a tuned controller may step by so many times what the experiment's own do."""


@dataclass(frozen=True)
class Comparison:
    """What is to be done; ``definition``: what is stored, and compared when it goes on."""

    plan: Plan
    definition: Mapping[str, Any]

    @property
    def size(self) -> int:
        """Number of tasks."""
        return len(self.plan.tasks)


def define(
    name: str,
    controllers: Sequence[str],
    circumstances: Sequence[str],
    settings: Sequence[str],
    duration: float | None,
    trials: int,
    seed: int,
    limit: float | None,
    hold: Sequence[str] = (),
) -> Comparison:
    """Check what is asked for.

    Args:
        trials: of the tuning; 0: controllers are as their files say.
        limit: of the mean step of an effort; ``None``: ten times that of the experiment as it is.
        hold: parameters that are not tuned, ``NODE.PARAM``.

    Raises:
        BadInput: it cannot be done.
    """
    whole = field(name, controllers, circumstances, settings, duration)
    allowed = limit if limit is not None else ROOM * _own_step(whole.experiment)
    for name_ in hold:
        node, _, parameter = name_.partition(".")
        parameter_of(whole.experiment, node, parameter)
    plan = Plan(whole, trials, seed, allowed, tuple(hold))
    definition = {
        "experiment": whole.name,
        "controllers": [each.name for each in whole.controllers],
        "circumstances": [each.name for each in whole.circumstances],
        "set": list(settings),
        "duration": duration,
        "trials": trials,
        "seed": seed,
        "limit": allowed,
        "hold": list(hold),
        "parameters": whole.digest(),
        "version": __version__,
    }
    return Comparison(plan, definition)


def _own_step(experiment: Any) -> float:
    try:
        step = whole_of(simulate(experiment, experiment.loop()))["step"]
    except RunFailed:
        step = None
    if not step:
        raise BadInput("the experiment as it is does not run well: give the --limit of the tuning")
    return float(f"{step:.2g}")


def run(
    asked: Comparison, directory: Path, pool: Pool, progress: Callable[[int, int], None]
) -> list[dict[str, Any]]:
    """Make all tasks that are not in the directory's journal yet.

    Returns:
        The results of all tasks, in their order.

    Raises:
        BadInput: the directory is of something else.
        RunFailed: workers die again and again.
    """
    open_directory(asked.definition, directory, DEFINITION, "comparison")
    with Journal(directory / JOURNAL, asked.size, 3, 1) as journal:
        progress(journal.done, journal.lost)
        for rows in rows_of(partial(run_tasks, asked.plan), journal, pool, progress):
            journal.append(rows)
            progress(journal.done, journal.lost)
        return [row[2] for row in journal.rows()]
