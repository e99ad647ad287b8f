"""One controller in one group of circumstances: tuned there if asked for, then shown."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any, cast

from fpt_ros.analysis.sizes import finite
from fpt_ros.compare.field import Circumstance, Controller, Field, variant
from fpt_ros.compare.measures import simulate, simulate_and_show, whole_of
from fpt_ros.compare.tuned import task_of
from fpt_ros.cycle.stages import Loop
from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.sweep.grid import target
from fpt_ros.sweep.job import COMPLETE, DIVERGED, FAILED, INVALID, Row
from fpt_ros.sweep.tune import search

SEEDS = 3
"""Runs of a circumstance with noise."""

OTHER_SEED = 1000
"""Between the seeds that are shown and that on which controllers are tuned."""


@dataclass(frozen=True)
class Plan:
    """All that a process has to know: the field, and what is done in it.

    Attributes:
        trials: of the search for good settings; 0: none.
        seed: of the first run that is shown, and of the search.
        limit: of the mean step of an effort, for the search.
        hold: parameters that the search leaves alone, ``NODE.PARAM``.
    """

    field: Field
    trials: int
    seed: int
    limit: float
    hold: tuple[str, ...] = ()

    @property
    def tasks(self) -> list[tuple[Controller, tuple[Circumstance, ...]]]:
        """By their number."""
        return [(each, group) for group in self.field.groups for each in self.field.controllers]


def run_tasks(plan: Plan, numbers: Sequence[int]) -> tuple[float, list[Row]]:
    """Seconds that it took, and a row for each task: number, what became of it, the results."""
    started = perf_counter()
    rows: list[Row] = []
    for number in numbers:
        results = run_task(plan, number)
        lost = [one["outcome"] for one in results["runs"].values() if one["outcome"] != COMPLETE]
        rows.append([number, lost[0] if lost else COMPLETE, _for_json(results)])
    return perf_counter() - started, rows


def _for_json(value: Any) -> Any:
    """The same with ``None`` for numbers that JSON has no word for: a run that is lost has some."""
    if isinstance(value, dict):
        return {key: _for_json(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_for_json(each) for each in value]
    return finite(value) if isinstance(value, float) else value


def run_task(plan: Plan, number: int) -> dict[str, Any]:
    """What JSON can hold of a task: ``runs`` by circumstance, ``tuning`` or ``None``."""
    controller, group = plan.tasks[number]
    tuning: dict[str, Any] | None = None
    if plan.trials:
        tuning = _tune(plan, controller, group[0])
    more = _settings(tuning, plan, controller, group[0])
    runs = {one.name: _shown(plan, controller, one, more) for one in group}
    return {"controller": controller.name, "tuning": tuning, "runs": runs}


def _shown(
    plan: Plan, controller: Controller, one: Circumstance, settings: tuple[str, ...]
) -> dict[str, Any]:
    """The numbers of a controller under a circumstance, over some seeds where there is noise."""
    try:
        seeds = range(plan.seed, plan.seed + (SEEDS if one.noisy else 1))
        experiments = [
            plan.field.load(controller, one, *settings, f"plant_simulator.seed={seed}")
            for seed in seeds
        ]
        results = [simulate_and_show(each) for each in experiments]
    except BadInput as error:
        return {"outcome": INVALID, "reason": str(error)}
    except Exception as error:  # one run that fails shall not end all others
        return {"outcome": FAILED, "reason": f"{type(error).__name__}: {error}"}
    lost = next((result for result in results if result["reason"]), None)
    shown = lost or results[0]
    time, errors = cast("tuple[list[float], list[float | None]]", shown["curve"])
    at = shown["diverged_at"]
    outcome = COMPLETE if lost is None else FAILED if at is None else DIVERGED
    return {
        "outcome": outcome,
        "reason": shown["reason"],
        "diverged_at": at,
        **{key: _over(results, key) for key in ("error", "max", "effort", "step", "cut")},
        "deviation": shown["deviation"],
        "cost": min(cast("float", result["cost"]) for result in results),
        "time": time,
        "errors": errors,
    }


def _over(results: Sequence[Mapping[str, object]], key: str) -> float | None:
    """One number of several runs: root mean square, or the largest."""
    found = [whole_of(result)[key] for result in results]
    known = [value for value in found if value is not None]
    if len(known) < len(found):
        return None
    if key == "max":
        return max(known)
    return math.hypot(*known) / math.sqrt(len(known))


def _tune(plan: Plan, controller: Controller, one: Circumstance) -> dict[str, Any] | None:
    """Search on a seed that is not shown: ``found``, ``before`` and ``trials`` (error, step)."""
    field = plan.field
    seed = f"plant_simulator.seed={plan.seed + OTHER_SEED}"
    try:
        experiment = field.load(controller, one, seed)
    except BadInput:
        return None
    settings = (*field.settings, *one.settings, seed)
    whole = variant(controller, one)
    task = task_of(field.name, whole, settings, field.duration, experiment, plan.limit, plan.hold)
    if not task.parameters:
        return None
    points: list[tuple[float, float]] = []

    def look(experiment: Experiment, loop: Loop) -> Mapping[str, object]:
        result = simulate(experiment, loop)
        error, step = whole_of(result)["error"], whole_of(result)["step"]
        if not result["reason"] and error and step:
            points.append((_short(error), _short(step)))
        return result

    present = {str(each.target): each.present for each in task.parameters}
    ranges = {str(each.target): [each.low, each.high] for each in task.parameters}
    about = {"before": present, "ranges": ranges, "trials": points, "limit": plan.limit}
    try:
        found = search(replace(task, simulate=look), plan.trials, plan.seed, lambda *done: None)
    except RunFailed as error:
        return {**about, "found": {}, "reason": str(error)}
    values = {name: float(f"{value:.6g}") for name, value in found.found.items()}
    return {**about, "found": values, "reason": ""}


def _settings(
    tuning: dict[str, Any] | None, plan: Plan, controller: Controller, one: Circumstance
) -> tuple[str, ...]:
    """What was found, as ``--set`` takes it: elements of lists within their lists."""
    if not tuning or not tuning["found"]:
        return ()
    nodes = plan.field.load(controller, one).nodes
    whole: dict[str, Any] = {}
    for name, value in tuning["found"].items():
        at = target(name, name)
        if at.index is None:
            whole[at.parameter] = value
        else:
            default = list(cast("list[float]", nodes[at.node][at.name]))
            whole.setdefault(at.parameter, default)[at.index] = value
    return tuple(f"{name}={json.dumps(value)}" for name, value in whole.items())


def _short(value: float) -> float:
    return float(f"{value:.4g}")
