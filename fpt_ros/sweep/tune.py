"""The search for good parameters, under limits on other quantities of the run."""

import math
import os
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, cast

from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.loop import description, parameter_file
from fpt_ros.loop.experiment import Experiment, load
from fpt_ros.parameters import Parameter, Value, Values
from fpt_ros.sweep.grid import Space, Target, parse, target
from fpt_ros.sweep.run_one import Job, experiment_at, metric, metrics_of, simulate
from fpt_ros.sweep.sweep import parameter_of

if TYPE_CHECKING:
    from optuna import Trial

HEADER = "# Tuned by fpt tune"
"""First words of the files that are written here, and so may be written again."""

WIDTH = 10.0
"""A range that is not given goes from the present value over it to the present value times it."""

LOST = 1e12
"""The score of a run that is not complete; less so where it lasted longer."""

STARTUP = 12
"""Random trials before the sampler begins to learn."""

DERIVED = frozenset(("experiment", "variant", "await_tuning"))
"""Parameters that the loader works out itself."""

OVER_FORM = "--over takes NODE.PARAM or NODE.PARAM=LOW:HIGH each, as in fpt_deformer.A=-4:-0.05"
LIMIT_FORM = "--limit takes METRIC=VALUE each, as in chatter=0.02,effort.q1=200"


@dataclass(frozen=True)
class Knob:
    """A parameter that is tuned, within [low, high]."""

    target: Target
    low: float
    high: float
    present: float
    whole: bool

    @property
    def log(self) -> bool:
        """Whether it is searched in equal ratios: ends of one sign that are far apart."""
        low, high = sorted((abs(self.low), abs(self.high)))
        return self.low * self.high > 0.0 and high >= 5.0 * low and not self.whole

    def suggest(self, trial: "Trial") -> Value:
        """A value for a trial."""
        name = str(self.target)
        if self.whole:
            return trial.suggest_int(name, int(self.low), int(self.high))
        if self.log:
            low, high = sorted((abs(self.low), abs(self.high)))
            size = trial.suggest_float(name, low, high, log=True)
            return math.copysign(size, self.low)
        return trial.suggest_float(name, self.low, self.high)

    def inner(self, value: float) -> float:
        """What :meth:`suggest` draws for a value."""
        return abs(value) if self.log else int(value) if self.whole else value


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
        knobs: what is tuned.
        metrics: what shall be small; of several the mean of the logarithms.
        limits: what must not be exceeded.
    """

    job: Job
    knobs: tuple[Knob, ...]
    metrics: tuple[str, ...]
    limits: Mapping[str, float]


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
    knobs = tuple(_knob(text, experiment) for text in _parts(over))
    if not knobs:
        raise BadInput(f"nothing is to be tuned: {OVER_FORM}")
    if len({str(knob.target) for knob in knobs}) < len(knobs):
        raise BadInput("--over names a parameter twice")
    axes = tuple(parse(f"{k.target}={k.low!r}:{k.high!r}:2") for k in knobs)
    job = Job(name, variant, tuple(given), duration, Space(axes), (), chosen)
    return Task(job, knobs, chosen, bounds)


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
    present = {str(knob.target): knob.present for knob in task.knobs}
    inside = all(knob.low <= knob.present <= knob.high for knob in task.knobs)
    if inside:
        study.enqueue_trial({str(k.target): k.inner(k.present) for k in task.knobs})
    before = _result(task, tuple(_typed(knob, knob.present) for knob in task.knobs))
    best, best_point, nearest = math.inf, None, math.inf
    for number in range(trials):
        trial = study.ask()
        drawn = tuple(knob.suggest(trial) for knob in task.knobs)
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
    experiment, loop = experiment_at(task.job, best_point)
    found = {str(k.target): cast("float", v) for k, v in zip(task.knobs, best_point, strict=True)}
    after = simulate(experiment, loop)
    assert before is not None
    return Result(experiment, before, after, present, found, trials)


def write_overlay(task: Task, found: Result, path: Path) -> None:
    """Write what differs from the base file as the overlay of a variant.

    Raises:
        BadInput: it cannot be written, or another file is there.
    """
    check_overlay(path)
    job = task.job
    base = load(job.name)
    changed: dict[str, dict[str, Value]] = {}
    for node, values in found.experiment.nodes.items():
        own = _different(base.nodes[node], values)
        if own:
            changed[node] = own
    metrics = ", ".join(task.metrics)
    limits = "".join(f", {name} <= {value:g}" for name, value in task.limits.items())
    note = f"{found.trials} runs for the least {metrics}{limits}"
    changed.setdefault(description.NODE, {})["shows"] = f"tuned: {note}"
    half = path.with_name(f".{path.name}")
    try:
        parameter_file.write(half, changed)
        text = half.read_text(encoding="utf-8")
        half.write_text(f"{HEADER}: {note}.\n{text}", encoding="utf-8")
        half.replace(path)
    except OSError as error:
        raise BadInput(f"--out {path} cannot be written: {error.strerror}") from error


def check_overlay(path: Path) -> None:
    """A file can be written at ``path``.

    Raises:
        BadInput: its folder does not exist or cannot be written, or a file is there that
            ``fpt tune`` has not made.
    """
    folder = path.absolute().parent
    if not folder.is_dir() or not os.access(folder, os.W_OK):
        raise BadInput(f"--out {path} cannot be written: give a folder that exists and is yours")
    if path.suffix not in (".yaml", ".yml") or path.is_dir():
        raise BadInput(f"--out {path}: give a file whose name ends in .yaml")
    if path.exists():
        try:
            ours = path.read_text(encoding="utf-8").startswith(HEADER)
        except (OSError, UnicodeDecodeError):
            ours = False
        if not ours:
            raise BadInput(f"--out {path} exists and is not of fpt tune: give another name")


def _different(base: Values, values: Values) -> dict[str, Value]:
    return {
        name: value
        for name, value in values.items()
        if name not in DERIVED and (name not in base or base[name] != value)
    }


def _parts(texts: Sequence[str]) -> list[str]:
    return [part.strip() for text in texts for part in text.split(",") if part.strip()]


def _knob(text: str, experiment: Experiment) -> Knob:
    _, equals, _ = text.partition("=")
    where = target(text.partition("=")[0], f"--over {text}: {OVER_FORM}")
    if where.index is not None:
        raise BadInput(f"--over {text}: elements of lists cannot be tuned, only numbers")
    parameter = parameter_of(experiment, where.node, where.name)
    value = experiment.nodes[where.node][where.name]
    if parameter.kind not in ("float", "int"):
        raise BadInput(f"--over {text}: {where} is no number")
    present = float(cast("float", value))
    if equals:
        axis = parse(text, random=True)
        if axis.choices or axis.log or axis.count:
            raise BadInput(f"--over {text}: {OVER_FORM}")
        low, high = sorted((axis.start, axis.stop))
        whole = parameter.kind == "int"
        for end in (low, high):
            parameter.check(int(end) if whole and end == int(end) else end, where.node)
    elif present == 0.0:
        raise BadInput(f"--over {text}: {where} is 0, so a range has to be given; {OVER_FORM}")
    else:
        low, high = sorted((present / WIDTH, present * WIDTH))
        low, high = _within(parameter, low, high)
    if not low < high:
        raise BadInput(f"--over {text}: the range is empty; {OVER_FORM}")
    return Knob(where, low, high, present, parameter.kind == "int")


def _within(parameter: Parameter, low: float, high: float) -> tuple[float, float]:
    low = max(low, parameter.minimum)
    if low <= parameter.above:
        low = math.nextafter(parameter.above, math.inf)
    high = min(high, parameter.maximum)
    if parameter.kind == "int":
        return float(math.ceil(low)), float(math.floor(high))
    return low, high


def _typed(knob: Knob, value: float) -> Value:
    return int(value) if knob.whole else value


def _result(task: Task, point: tuple[Value, ...]) -> Mapping[str, object] | None:
    """The summary of a run; ``None`` where the parameters do not go together."""
    try:
        return simulate(*experiment_at(task.job, point))
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
