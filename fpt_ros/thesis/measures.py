"""What judges measure in a run, and the verdicts that many claims have in common."""

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from fpt_ros.analysis import motions, signals, sizes
from fpt_ros.analysis.tables import number_text, ratio_text
from fpt_ros.runs.run import Array, Run, Series
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Runs, Table, Verdict

POINTS = 8000
"""Of a motion, which is smooth from cycle to cycle, as many are enough."""

Judge = Callable[[Runs], Verdict]


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


def tuned(run: Run, name: str) -> tuple[Array, Array]:
    """Times [s] and values of something that is tuned."""
    return signals.topic(run, "tuning", "values", name)


def last(run: Run, name: str) -> float:
    """Final value of something that is tuned."""
    return float(tuned(run, name)[1][-1])


def window(run: Run, name: str, start: float, end: float) -> float:
    """Rms of something that is tuned between two times [s]."""
    time, values = tuned(run, name)
    return rms(values[(time >= start) & (time < end)])


def coefficients(run: Run) -> dict[str, tuple[float, float, float]]:
    """Tuned coefficients of the model: start, end and exact value."""
    series = run.topics["tuning"]
    return {
        name: (float(series.column("values", name)[0]), last(run, name), exact)
        for name, exact in signals.exact_coefficients(run).items()
        if name in series.names
    }


def learned(start: float, end: float, exact: float) -> float:
    """How much of a parameter's error is gone: 1 all of it, 0 nothing, negative: it grew."""
    return 1.0 - abs(end - exact) / abs(start - exact) if start != exact else 0.0


def coefficient_table(runs: Mapping[str, Run]) -> Table:
    """Start, exact value, and where each run ends, of the coefficients."""
    found = {key: coefficients(run) for key, run in runs.items()}
    first = next(iter(found.values()))
    rows = [
        (
            name,
            f"{start:.4g}",
            f"{exact:.4g}",
            *(f"{each[name][1]:.4g} ({learned(*each[name]):.0%})" for each in found.values()),
        )
        for name, (start, _, exact) in first.items()
    ]
    ends = [f"end, {key}" if len(runs) > 1 else "end" for key in found]
    return Table(("parameter", "start", "exact", *ends), tuple(rows))


def text(value: float) -> str:
    """A number as in tables; words for one that is not finite."""
    if math.isinf(value):
        return "lost"
    return number_text(value) if math.isfinite(value) else "none"


def times(before: float, after: float) -> str:
    """How much smaller or larger, to be pictured."""
    if not (math.isfinite(after) and before):
        return "lost"
    return "from lost" if math.isinf(before) else ratio_text(after / before)


def factor_text(ratio: float) -> str:
    """How many times: three digits, 7,620 rather than 7.62e+03."""
    return f"{float(f'{ratio:.3g}'):,.0f}" if 1000.0 <= ratio < 1e6 else f"{ratio:.3g}"


def listed(words: Sequence[str]) -> str:
    """``a, b and c``."""
    return " and ".join([*[", ".join(words[:-1])] * (len(words) > 1), words[-1]])


def because(held: bool, reason: str) -> str:
    """The reason for what was expected, which must not be given where it did not happen."""
    return reason if held else "The numbers do not bear it out."


def unit(run: Run, name: str) -> str:
    """`` [rad]``, or nothing."""
    found = signals.unit(run, name)
    return f" [{found}]" if found else ""


def precise(
    better: str, worse: str, factor: float, remark: str = "", beside: Sequence[str] = ()
) -> Judge:
    """Judge of: run ``better`` tracks at least ``factor`` times as precisely as ``worse``.

    ``beside``: further runs whose errors are shown.
    """

    def judge(runs: Runs) -> Verdict:
        measured: dict[str, float | str | None] = {}
        ratios = {}
        for name in signals.controlled(runs[better]):
            before, after = settled_rms(runs[worse], name), settled_rms(runs[better], name)
            ratios[name] = before / after if after > 0.0 else math.inf
            for key in (worse, better, *beside):
                label = f"{name}, rms error, {key}{unit(runs[better], name)}"
                measured[label] = sizes.finite(settled_rms(runs[key], name))
        found = listed([f"{factor_text(ratio)} ({name})" for name, ratio in ratios.items()])
        held = [ratio >= factor for ratio in ratios.values()]
        status = YES if all(held) else ONLY_IF if any(held) else NO
        reason = f"The settled error is {found} times smaller than in '{worse}'."
        return Verdict(status, measured, f"{reason} {remark}".strip())

    return judge


def follows(adaptive: str, nonadaptive: str, factor: float, remark: str = "") -> Judge:
    """Judge of: with deformation the realised response stays close to the desired one.

    The response error has to be ``factor`` times smaller than without, and smaller by as much than
    what the deformation adds.
    """

    def judge(runs: Runs) -> Verdict:
        with_it, without = (rms(response_errors(runs[key])) for key in (adaptive, nonadaptive))
        time, desired, deformed, _ = responses(runs[adaptive])
        late = signals.settled(runs[adaptive], time)
        added = rms(norms(deformed[late] - desired[late]))
        held = with_it * factor <= without, with_it * factor <= added
        status = YES if all(held) else ONLY_IF if any(held) else NO
        measured = {
            f"realised - desired, rms, {nonadaptive}": without,
            f"realised - desired, rms, {adaptive}": with_it,
            "deformed - desired, rms": added,
        }
        reason = (
            f"Realised and desired response differ {factor_text(without / with_it)} times less "
            f"than in '{nonadaptive}', while the deformed one is {factor_text(added / with_it)} "
            "times as far away."
        )
        return Verdict(status, measured, f"{reason} {remark}".strip())

    return judge
