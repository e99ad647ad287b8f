"""The numbers of a run: tracking errors, efforts, chatter; and several runs compared."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import cast

import numpy as np

from fpt_ros.analysis import signals
from fpt_ros.runs.run import Array, Run

Summary = Mapping[str, object]
"""What :func:`summary` gives, or the same read back from JSON."""

TRACKING = ("rms_settled", "max_settled", "rms")
"""Quantities of ``tracking`` that :func:`comparison` lists, the most telling first."""

REAL_TIME = ("missed_deadlines", "latency_median_ms", "latency_p99_ms", "latency_max_ms")
"""Quantities of ``real_time`` that :func:`comparison` lists."""


def summary(run: Run) -> dict[str, object]:
    """The run's numbers as a JSON object (design, section 6).

    Lengths of time in [s], errors and efforts in the plant's units. ``tracking`` holds, for each
    controlled coordinate, rms and largest size of e = q^N - q, over all cycles and over those with
    t >= settle_time; with time sharing the turns of the others count too. ``chatter``
    is the mean of ||r_k - r_(k-1)|| over k >= 1 (section 3.2.2 of the thesis: it jumps where the
    control begins to oscillate). ``real_time`` is of a recording on the wall clock, otherwise
    ``None``: cycles that ended without their command, and latency from sensor to command [ms].
    A number that does not exist is ``None``, never NaN.
    """
    info = run.info
    cycles = len(run.topics["joint_states"].stamps) if "joint_states" in run.topics else 0
    dt = signals.parameter_number(run, "plant_simulator", "dt")
    seed = signals.parameter_number(run, "plant_simulator", "seed")
    return {
        "experiment": info.get("experiment", ""),
        "variant": info.get("variant", ""),
        "engine": info.get("engine", ""),
        "adaptive": signals.adaptive(run),
        "cycles": cycles,
        "dt": dt,
        "duration": None if dt is None else cycles * dt,
        "settle_time": signals.settle_time(run),
        "seed": None if seed is None else int(seed),
        "tracking": {name: _tracking(run, name) for name in signals.controlled(run)},
        "effort": _effort(run),
        "chatter": _chatter(run),
        "final_parameters": _final_parameters(run),
        "real_time": _real_time(run),
        "complete": info.get("complete") == "true",
        "reason": info.get("reason", ""),
    }


def rms(values: Array) -> float | None:
    """Root mean square of the numbers that are not NaN; ``None`` where there are none."""
    known = _known(values)
    if not len(known):
        return None
    # scaled, because a run that diverges ends in numbers whose squares overflow
    size = float(np.max(np.abs(known)))
    if size == 0.0 or not math.isfinite(size):
        return finite(size)
    return finite(size * math.sqrt(float(np.mean((known / size) ** 2))))


def largest(values: Array) -> float | None:
    """Largest absolute value of the numbers that are not NaN; ``None`` where there are none."""
    known = _known(values)
    return finite(float(np.max(np.abs(known)))) if len(known) else None


def _known(values: Array) -> Array:
    """The numbers that are not NaN; without a copy where all are."""
    missing = np.isnan(values)
    return values[~missing] if missing.any() else values


def finite(value: float) -> float | None:
    """The number, or ``None`` where JSON has no word for it."""
    return float(value) if math.isfinite(value) else None


def _tracking(run: Run, coordinate: str) -> dict[str, float | None]:
    motion = signals.motion(run, coordinate)
    error = motion.error
    late = error[signals.settled(run, motion.time)]
    return {
        "rms": rms(error),
        "max": largest(error),
        "rms_settled": rms(late),
        "max_settled": largest(late),
    }


def _effort(run: Run) -> dict[str, dict[str, float | None]]:
    command = run.topics.get("command")
    if command is None:
        return {}
    efforts = {name: command.column("effort", name) for name in command.names}
    return {name: {"rms": rms(e), "max": largest(e)} for name, e in efforts.items()}


def _chatter(run: Run) -> float | None:
    command = run.topics.get("command")
    if command is None:
        return None
    with np.errstate(invalid="ignore"):
        steps = np.diff(command.vectors["accelerations"], axis=0)
    missing = np.isnan(steps)
    if missing.any():
        there = ~missing.all(axis=0)
        # a coordinate that is not controlled in either cycle makes no step
        steps = np.where(missing, 0.0, steps)[:, there]
    return finite(float(np.mean(np.linalg.norm(steps, axis=1)))) if steps.size else None


def _final_parameters(run: Run) -> dict[str, float | None]:
    """What the controller believed at the end: the model's parameters, and all that was tuned."""
    tuning = run.topics.get("tuning")
    found: dict[str, float | None] = {}
    if tuning is not None and len(tuning.stamps):
        last = tuning.vectors["values"][-1]
        found = {name: finite(value) for name, value in zip(tuning.names, last, strict=True)}
    if set(found) & signals.coefficient_names(run):
        return found
    prefix = "approximate."
    own = {
        name.removeprefix(prefix): signals.parameter_number(run, "fpt_deformer", name)
        for name in run.parameters.get("fpt_deformer", {})
        if name.startswith(prefix)
    }
    return {**own, **found}


def _real_time(run: Run) -> dict[str, float | int | None] | None:
    latency = run.latency
    if latency is None:
        return None
    ms = {
        "median": latency.quantile(0.5),
        "p99": latency.quantile(0.99),
        "max": latency.largest if latency.total else math.nan,
    }
    return {
        "cycles": latency.cycles,
        "missed_deadlines": latency.missed,
        **{f"latency_{name}_ms": finite(1e3 * value) for name, value in ms.items()},
    }


@dataclass(frozen=True)
class Row:
    """One quantity of several runs.

    Attributes:
        coordinate: whose; empty for what is of all.
        quantity: ``rms_settled``, ``max_settled``, ``rms``, ``effort`` (its rms), ``chatter``, or
            one of :data:`REAL_TIME`.
        values: one a run; ``None`` where a run has none.
        ratios: each value over that of the run it is measured against (:func:`baselines`); none
            of what depends on the machine.
    """

    coordinate: str
    quantity: str
    values: tuple[float | None, ...]
    ratios: tuple[float | None, ...]


def baselines(summaries: Sequence[Summary]) -> list[int]:
    """For each run the index of the one it is measured against.

    It is the first run of the same experiment that does not adapt at all (no transformation, no
    tuner); where there is none, the first run of the same experiment.
    """
    found = []
    for one in summaries:
        same = [i for i, s in enumerate(summaries) if s["experiment"] == one["experiment"]]
        still = [i for i in same if not summaries[i].get("adaptive", True)]
        found.append((still or same)[0])
    return found


def comparison(summaries: Sequence[Summary]) -> list[Row]:
    """Runs side by side: errors and effort of each coordinate, the controlled first; chatter;
    what those in real time say of their deadlines.
    """
    rows = []
    tracked = _names(summaries, "tracking")
    for name in dict.fromkeys([*tracked, *_names(summaries, "effort")]):
        if name in tracked:
            rows += [
                _row(summaries, name, key, [_entry(s, "tracking", name, key) for s in summaries])
                for key in TRACKING
            ]
        efforts = [_entry(s, "effort", name, "rms") for s in summaries]
        if any(efforts):  # a force that is zero by construction says nothing
            rows.append(_row(summaries, name, "effort", efforts))
    chatter = [cast("float | None", s.get("chatter")) for s in summaries]
    rows.append(_row(summaries, "", "chatter", chatter))
    for key in REAL_TIME:
        values = tuple(_timing(s).get(key) for s in summaries)
        if any(value is not None for value in values):
            rows.append(Row("", key, values, (None,) * len(values)))
    return rows


def _timing(one: Summary) -> Mapping[str, float | None]:
    return cast("Mapping[str, float | None]", one.get("real_time") or {})


def _names(summaries: Sequence[Summary], part: str) -> list[str]:
    """Coordinates of all runs, each once, in the order in which they are met."""
    return list(dict.fromkeys(name for s in summaries for name in _part(s, part)))


def _part(one: Summary, part: str) -> Mapping[str, Mapping[str, float | None]]:
    return cast("Mapping[str, Mapping[str, float | None]]", one[part])


def _entry(one: Summary, part: str, name: str, key: str) -> float | None:
    return _part(one, part).get(name, {}).get(key)


def _row(summaries: Sequence[Summary], name: str, key: str, values: Sequence[float | None]) -> Row:
    against = [values[i] for i in baselines(summaries)]
    ratios = tuple(
        None if value is None or not base else finite(value / base)
        for value, base in zip(values, against, strict=True)
    )
    return Row(name, key, tuple(values), ratios)
