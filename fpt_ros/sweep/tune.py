"""The search for good parameters, under limits on other quantities of the run."""

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import cast

from fpt_ros.cycle.stages import Loop
from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.experiments.experiment import Experiment, load
from fpt_ros.parameters import Value
from fpt_ros.sweep.grid import Space, parse
from fpt_ros.sweep.job import Job
from fpt_ros.sweep.metric import metric, metrics_of
from fpt_ros.sweep.point_experiments import experiments_of
from fpt_ros.sweep.run_one import simulate
from fpt_ros.sweep.tuned_parameter import OVER_FORM, TunedParameter, read_tuned_parameter

LOST = 1e12
"""The score of a run that is not complete; less so where it lasted longer."""

STARTUP = 12
"""Random trials before the sampler begins to learn."""

LIMIT_FORM = "--limit takes METRIC=VALUE each, as in chatter=0.02,effort.q1=200"


@dataclass(frozen=True)
class Result:
    """What was found.

    Attributes:
        experiment: with the parameters that were found.
        before, after: the summaries of the run as it was and as it is now.
        present, found: values of the parameters.
        trials: number of runs.
    """

    experiment: Experiment
    before: Mapping[str, object]
    after: Mapping[str, object]
    present: Mapping[str, float]
    found: Mapping[str, float]
    trials: int


@dataclass(frozen=True)
class Task:
    """A search whose definition has been checked.

    Attributes:
        job: how an experiment is made from values.
        parameters: what is tuned.
        metrics: what shall be small; of several the mean of the logarithms.
        limits: what must not be exceeded.
        simulate: makes a run and gives its summary.
    """

    job: Job
    parameters: tuple[TunedParameter, ...]
    metrics: tuple[str, ...]
    limits: Mapping[str, float]
    simulate: Callable[[Experiment, Loop], Mapping[str, object]] = simulate


def define(
    name: str,
    variant: str,
    given: Sequence[str],
    duration: float | None,
    over: Sequence[str],
    metrics: Sequence[str],
    limits: Sequence[str],
) -> Task:
    """Check what is asked for.

    Raises:
        BadInput: an unknown parameter or metric, a range or a limit that is none.
    """
    experiment = load(name, variant, given, duration)
    loop = experiment.loop()
    chosen = metrics_of(loop, metrics)
    bounds: dict[str, float] = {}
    for text in _parts(limits):
        of, equals, number = text.partition("=")
        try:
            value = float(number)
        except ValueError:
            equals, value = "", 0.0
        if not (equals and math.isfinite(value) and value > 0.0):
            raise BadInput(f"--limit {text}: {LIMIT_FORM}")
        bounds.update(dict.fromkeys(metrics_of(loop, [of.strip()]), value))
    parameters = tuple(read_tuned_parameter(text, experiment) for text in _parts(over))
    if not parameters:
        raise BadInput(f"nothing is to be tuned: {OVER_FORM}")
    if len({str(p.target) for p in parameters}) < len(parameters):
        raise BadInput("--over names a parameter twice")
    axes = tuple(parse(f"{p.target}={p.low!r}:{p.high!r}:2") for p in parameters)
    job = Job(name, variant, tuple(given), duration, Space(axes), (), chosen)
    return Task(job, parameters, chosen, bounds)


def search(task: Task, trials: int, seed: int, progress: Callable[[int, float], None]) -> Result:
    """The best of a number of runs (TPE, with the limits as constraints).

    The present values are tried first, so that the result is never worse where these are within
    the limits. The same seed gives the same result.

    Raises:
        RunFailed: no run was complete and within the limits.
    """
    import optuna

    optuna.logging.set_verbosity(optuna.logging.ERROR)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", optuna.exceptions.ExperimentalWarning)
        sampler = optuna.samplers.TPESampler(seed=seed, multivariate=True, n_startup_trials=STARTUP)
    study = optuna.create_study(sampler=sampler)
    present = {str(p.target): p.present for p in task.parameters}
    inside = all(
        parameter.low <= parameter.present <= parameter.high for parameter in task.parameters
    )
    if inside:
        study.enqueue_trial({str(p.target): p.inner(p.present) for p in task.parameters})
    before = _result(task, tuple(_typed(p, p.present) for p in task.parameters))
    best, best_point, nearest = math.inf, None, math.inf
    for number in range(trials):
        trial = study.ask()
        drawn = tuple(p.suggest(trial) for p in task.parameters)
        result = _result(task, drawn)
        score = _score(task, result)
        excess = {name: _excess(result, name, top) for name, top in task.limits.items()}
        for name, value in excess.items():
            trial.set_constraint(name, value)
        study.tell(trial, score)
        worst = max(excess.values(), default=0.0)
        if _complete(result):
            nearest = min(nearest, worst)
            if worst <= 0.0 and score < best:
                best, best_point = score, drawn
        progress(number + 1, best)
    if best_point is None:
        raise RunFailed(_nothing(task, trials, nearest))
    experiment, loop = experiments_of(task.job).at(best_point)
    found = {
        str(k.target): cast("float", v) for k, v in zip(task.parameters, best_point, strict=True)
    }
    after = task.simulate(experiment, loop)
    assert before is not None
    return Result(experiment, before, after, present, found, trials)


def _parts(texts: Sequence[str]) -> list[str]:
    return [part.strip() for text in texts for part in text.split(",") if part.strip()]


def _typed(parameter: TunedParameter, value: float) -> Value:
    return int(value) if parameter.whole else value


def _result(task: Task, point: tuple[Value, ...]) -> Mapping[str, object] | None:
    """The summary of a run; ``None`` where the parameters do not go together."""
    try:
        return task.simulate(*experiments_of(task.job).at(point))
    except BadInput:
        return None


def _complete(result: Mapping[str, object] | None) -> bool:
    return result is not None and not result["reason"]


def _score(task: Task, result: Mapping[str, object] | None) -> float:
    if result is None:
        return 2.0 * LOST
    if not _complete(result):
        cycles = cast("int", result["cycles"])
        return LOST * (1.0 + 1.0 / (1.0 + cycles))
    found = [metric(result, name) for name in task.metrics]
    if any(value is None for value in found):
        return LOST
    return sum(math.log(max(cast("float", v), 1e-300)) for v in found) / len(found)


def _excess(result: Mapping[str, object] | None, name: str, bound: float) -> float:
    """By what part a limit is exceeded; 0 or less: it is not."""
    value = metric(result, name) if result is not None and _complete(result) else None
    return 1e6 if value is None else value / bound - 1.0


def _nothing(task: Task, trials: int, nearest: float) -> str:
    if not task.limits or math.isinf(nearest):
        return f"none of {trials} runs was complete: give other ranges with --over"
    limits = ", ".join(f"{name} <= {value:g}" for name, value in task.limits.items())
    return (
        f"none of {trials} runs is within {limits}: the nearest is {100.0 * nearest:.3g} % over; "
        "allow more, or give other ranges or more --trials"
    )
